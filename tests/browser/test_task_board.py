"""The board of a task page: a plan drawn by keys and by mouse, kept, handed in and graded."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest

from graphkin.construction.board import BETWEEN, Board, BoardGiven, board_given, replayed
from graphkin.drawing.field import Field
from graphkin.mechanism import load
from graphkin.numbers.plane import Line
from graphkin.scene import scene_files
from graphkin.text import words
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from tests.browser.opening import Opened, barred
from tests.browser.test_form import class_folder, page_of, save
from tests.running import Run
from tests.web.drawn_logs import PUMP, VELOCITIES
from tests.web.drawn_logs import RING as GEARS

TYPED = """
ray O1 44
off O1 44 60
A
arc A AB
arc O2 O2B
x /2
B
arc A AC
arc B BC
x /1
C
arc C CD
cut CD 5 /1
D
perp o O1A
off o O1A 150 /1
a
perp a AB
o O2B
x
b
perp a AC
b BC
x
c
perp c CD
par o 5
x
d
"""
"""The pump's position and velocity plan as they are typed; after a stroke the result to take."""
RO = words("ro")
RING_SCENE = Path(__file__).parents[2] / "examples" / "scenes" / "gears-ring.toml"
RING = """
ray O φ
off O φ OP
P
off O φ 60
T1
ray P -20
off P -20 PQ
Q
off O φ 20
T2
ray O 40
off O 40 OS
S
perp o OP
off o OP 60 /1
p
perp p PQ
perp o T1Q
x
q
div p o P T1 T2
t2
perp o OS
perp t2 T2S
x
s
"""
"""The gears in a fixed ring: the contact of planet and sun divides the image of a diameter."""
MOST_PRESSES = 250
"""The most key presses for the plan."""
MOST_CLICKS = 60
"""The most clicks for the position and the plan."""
SCREEN = """([side, x, y]) => {
  const svg = document.querySelectorAll(".sheet:not([hidden]) .view > svg")[side];
  const place = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
  return [place.x, place.y];
}"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A class folder of the pump with the task pages of two students."""
    return class_folder("pump", tmp_path_factory.mktemp("task-board"))


def fresh(opened: Opened, path: Path, **options: Any) -> Any:
    """A page on which nothing is drawn yet."""
    page = opened(path, **options)
    page.evaluate("localStorage.clear()")
    page.reload()
    return page


NOTHING = {
    "par O1 5\npar O2 5": "parallel",
    "arc O1 5\narc O2 5": "unmet",
    "arc O1 5\npar o 5": "apart",
}
"""Two lines or arcs that do not cross, and the key of the reason."""


@pytest.mark.parametrize("lines", NOTHING)
def test_the_board_says_why_nothing_can_be_drawn(opened: Opened, folder: Path, lines: str):
    page = fresh(opened, page_of(folder))
    typed(page, lines)
    page.locator("[data-action=cut]").click()
    for place, key in enumerate(("own1", "own2")):
        page.locator("#inputs select").nth(place).select_option(value=key)
    page.locator("#turn-draw").click()
    assert page.locator("#turn-say").inner_text().endswith(f". {RO(f'board.{NOTHING[lines]}')}")
    assert log_of(page).count(BETWEEN) == 1


def test_a_ray_is_followed_from_its_start_in_its_own_direction(opened: Opened, folder: Path):
    """A length on it is laid off at once; from another point, or along a line, there are two."""
    page = fresh(opened, page_of(folder))
    for lines, asks in (
        ("ray O1 230\noff O1 230 60", False),
        ("A\noff A 230 60", True),
        ("par O2 5\noff O2 5 60", True),
    ):
        page.keyboard.press("Escape")
        typed(page, lines)
        assert page.locator("#which").is_visible() == asks
    assert log_of(page) == "ray 0:O1 230deg|off 0:O1 1 60mm|name 2 0:A|par 0:O2 g:5"


def test_a_line_that_draws_nothing_is_told_why(opened: Opened, folder: Path):
    page = fresh(opened, page_of(folder))
    say = page.locator("#turn-say")
    for line, key, fields in (
        ("perp foo AB", "unread", {"text": "foo"}),
        ("perp a AB", "undrawn", {"name": "a"}),
        ("sim a o C", "undrawn", {"name": "a"}),
    ):
        typed(page, line)
        assert say.inner_text() == RO(f"turn.say.{key}", **fields)
    typed(page, "perp o O1")
    assert say.inner_text().startswith(RO("turn.say.unfit"))


def test_a_saved_drawing_is_told(opened: Opened, folder: Path, tmp_path: Path):
    page = fresh(opened, page_of(folder))
    typed(page, "ray O1 44\noff O1 44 60\nA")
    save(page, tmp_path)
    told = page.locator("form.answers .status").inner_text()
    fields = page.locator("form.answers [name]:not([type=hidden])").count()
    said = {"file": "0042-answers.csv", "moves": 3, "count": 0, "all": fields}
    assert told == RO("answers.saved_drawn", **said)


WRITTEN = 500
"""Milliseconds in which a busy browser passes what a page keeps on to the page that is reloaded."""


def log_of(page: Any) -> str:
    """The moves that the form holds."""
    return page.locator("form.answers [name=drawing]").input_value()


def typed(page: Any, lines: str = TYPED) -> int:
    """Type moves; the number of key presses."""
    presses = 0
    field = page.locator("#turn-typed")
    for line in lines.strip().splitlines():
        text, _, which = line.partition(" /")
        field.fill(text)
        field.press("Enter")
        presses += len(text) + 1
        if which:
            page.keyboard.press(which)
            presses += 1
    return presses


def graded(run: Run, folder: Path, answers: Path, report: Path) -> dict[str, str]:
    """The row of the first student in the marks of some answers."""
    run("grade", folder, answers, "-o", report, "--as-it-is", "--format", "html")
    with (report / "marks.csv").open(encoding="utf-8-sig", newline="") as file:
        return {row["id"]: row for row in csv.DictReader(file)}["0042"]


class MouseHand:
    """Draws a log by mouse: an action, then each thing at its place on the screen."""

    def __init__(self, page: Any, sheets: list[ScreenSheet]) -> None:
        self.page, self.sheets = page, sheets
        self.given: BoardGiven = board_given([sheet.drawing for sheet in sheets])
        self.board, self.clicks = Board(self.given), 0

    def draw(self, log: str) -> None:
        """Draw each move of a log."""
        for move in log.split(BETWEEN):
            words = move.split()
            which = int(words.pop()[1:]) if words[-1].startswith("/") else 0
            self.move(words, which)
            self.board.move(move.split())

    def move(self, words: list[str], which: int) -> None:
        """Draw one move: a name by its letter, a crossing where it is, the rest by its action."""
        action, *keys = words
        if action == "name":
            letter = self.page.locator("#letters button").nth(self.letters(keys[1]))
            self.press(letter)
        elif action == "cut":
            board = Board(self.given)
            board.own, board.moves = dict(self.board.own), self.board.moves
            board.move([*words, f"/{which}"])
            self.click(board.own[str(board.moves)].value, board.thing(keys[0]).plane)
        else:
            button = self.page.locator(f"#palette [data-action={ACTIONS[action]}]")
            if button.get_attribute("aria-pressed") != "true":
                self.press(button)
            for key in keys:
                self.take(key)
            if self.page.locator("#which button").count():
                self.press(self.page.locator("#which button").nth(which))

    def letters(self, key: str) -> int:
        """The place of a letter among those that are offered."""
        plane = self.given.letters[key].plane
        free = [k for k, each in self.given.letters.items() if each.plane == plane]
        return [k for k in free if k not in self.board.named].index(key)

    def take(self, key: str) -> None:
        """Take one thing: a point, a line or bar, a stated length, or a typed number."""
        thing = self.board.thing(key)
        if thing.kind in ("length", "angle", "rate"):
            if key in self.given.things:
                kinds = ("length", "angle")
                stated = [k for k, each in self.given.things.items() if each.kind in kinds]
                self.press(self.page.locator("#chips button").nth(stated.index(key)))
                return
            number = self.page.locator("#turn-form input")
            number.fill(key.rstrip("mdegra"))
            number.press("Enter")
        elif thing.on:
            ends = [self.board.value_of(end) for end in thing.on]
            self.click(0.4 * ends[0] + 0.6 * ends[1], thing.plane)
        elif isinstance(thing.value, Line):
            along = thing.value.along / abs(thing.value.along)
            self.click(
                thing.value.point + 47 * self.given.millimetre[thing.plane] * along, thing.plane
            )
        else:
            self.click(thing.value, thing.plane)

    def click(self, value: complex, plane: int) -> None:
        """Click at a place of a drawing."""
        layout = self.sheets[max(plane - 1, 0)].layout
        field: Field = layout.plan if plane else layout.mechanism
        x, y = self.page.evaluate(SCREEN, [1 if plane else 0, *field(value)])
        self.page.mouse.click(x, y)
        self.clicks += 1

    def press(self, button: Any) -> None:
        """Click on a button."""
        button.click()
        self.clicks += 1


ACTIONS = {"ray": "ray", "off": "set_off", "perp": "perpendicular", "par": "parallel",
           "arc": "compass"}  # fmt: skip


def test_the_velocity_plan_by_keys_is_handed_in_and_marked(
    opened: Opened, folder: Path, run: Run, tmp_path: Path
):
    page = fresh(opened, page_of(folder))
    presses = typed(page)
    assert log_of(page) == VELOCITIES
    assert presses <= MOST_PRESSES
    answers = tmp_path / "answers"
    answers.mkdir()
    save(page, answers)
    row = graded(run, folder, answers, tmp_path / "report")
    assert row["v_D_mm why"] == "right"
    assert row["a_D_mm why"] == "blank"
    told = (tmp_path / "report" / "feedback" / "0042.html").read_text(encoding="utf-8")
    assert told.count('stroke="#087a2c"') == 12  # four points on both sheets, and four images
    assert 'stroke="#c21807"' not in told


def test_the_velocity_plan_by_mouse_is_the_same_drawing(opened: Opened, folder: Path):
    page = fresh(opened, page_of(folder), viewport={"width": 1366, "height": 900})
    page.locator("#desk").evaluate("desk => desk.scrollIntoView()")
    hand = MouseHand(page, screen_sheets(load("pump", n=7).measured, "ro", "task"))
    hand.draw(VELOCITIES)
    drawn, right = (replayed(hand.given, log) for log in (log_of(page), VELOCITIES))
    assert drawn.named.keys() == right.named.keys()
    for letter in right.named:
        assert abs(drawn.value_of(letter) - right.value_of(letter)) < 1e-9
    assert hand.clicks <= MOST_CLICKS


def test_a_mistake_is_red_and_what_follows_from_it_green(folder: Path, run: Run, tmp_path: Path):
    log = VELOCITIES.replace("150mm", "140mm")
    answers = tmp_path / "answers"
    answers.mkdir()
    (answers / "0042-answers.csv").write_text(f"field,value\nid,0042\ndrawing,{log}\n", "utf-8")
    row = graded(run, folder, answers, tmp_path / "report")
    assert row["v_D_mm why"].startswith(("follows", "right"))
    told = (tmp_path / "report" / "feedback" / "0042.html").read_text(encoding="utf-8")
    assert told.count('r="2.20" stroke="#c21807"') == 1  # a alone


WRONG = {
    "along_bar": VELOCITIES.replace("perp 16 A-B", "par 16 A-B"),
    "pole": VELOCITIES.replace("perp 16 A-B", "perp 1: A-B"),
    "mirrored": VELOCITIES.replace("perp 16 A-C|perp 20 B-C", "perp 20 A-C|perp 16 B-C"),
    "across_guide": VELOCITIES.replace("par 1: g:5", "perp 1: g:5"),
    "normal_forgotten": PUMP.replace("perp 37 A-B", "perp 31 A-B"),
    "normal_turned": PUMP.replace("lay 31 36", "lay 31 36 /1"),
    "tangential_along_bar": PUMP.replace("perp 37 A-B", "par 37 A-B"),
}
"""Wrong constructions by the key of the sentence that names each; the last three are of b′."""


@pytest.mark.parametrize("key", WRONG)
def test_a_wrong_construction_is_named(folder: Path, run: Run, tmp_path: Path, key: str):
    """Its sentence follows the remark on its point; what is found from that point follows."""
    answers = tmp_path / "answers"
    answers.mkdir()
    text = f"field,value\nid,0042\ndrawing,{WRONG[key]}\n"
    (answers / "0042-answers.csv").write_text(text, "utf-8")
    graded(run, folder, answers, tmp_path / "report")
    told = (tmp_path / "report" / "feedback" / "0042.html").read_text(encoding="utf-8")
    told = re.sub("<[^>]+>", "", told)
    parts = [re.split(r"\{\w+\}", RO.sentences[f"turn.wrong.{each}"]) for each in WRONG]
    found = [re.search(".{1,9}".join(map(re.escape, each)), told) is not None for each in parts]
    assert [each for each, is_said in zip(WRONG, found, strict=True) if is_said] == [key]
    assert told.count(RO.sentences["marked.wrong"].rpartition("} ")[2]) == 1


def test_both_plans_earn_what_they_would_on_paper(folder: Path, run: Run, tmp_path: Path):
    answers = tmp_path / "answers"
    answers.mkdir()
    (answers / "0042-answers.csv").write_text(f"field,value\nid,0042\ndrawing,{PUMP}\n", "utf-8")
    row = graded(run, folder, answers, tmp_path / "report")
    assert (row["v_D_mm why"], row["a_D_mm why"]) == ("right", "right")


def test_a_log_of_nobody_waits_and_harms_no_one(folder: Path, run: Run, tmp_path: Path):
    answers = tmp_path / "answers"
    answers.mkdir()
    for who, log in (("0042", "evil 0:O1"), ("0043", "perp 1: O1-A|" * 3)):
        text = f"field,value\nid,{who}\nomega_3,27.6\ndrawing,{log}\n"
        (answers / f"{who}-answers.csv").write_text(text, "utf-8")
    result = run("grade", folder, answers, "-o", tmp_path / "report", "--as-it-is")
    assert result.exit_code == 1
    assert "cannot be drawn from its move 1 on" in result.output
    row = graded(run, folder, answers, tmp_path / "again")
    assert row["omega_3 why"] in ("right", "wrong")
    assert row["v_D_mm why"] == "unreadable"


def test_what_is_drawn_is_kept_taken_back_and_drawn_again(opened: Opened, folder: Path):
    page = fresh(opened, page_of(folder, "0043"))
    typed(page, "ray O1 48\noff O1 48 60\nA\narc A AB")
    whole = log_of(page)
    page.wait_for_timeout(WRITTEN)
    page.reload()
    assert log_of(page) == whole
    page.locator("body").press("Control+z")
    assert log_of(page) == whole.rpartition(BETWEEN)[0]
    page.locator("#turn-redo").click()
    assert log_of(page) == whole
    page.locator("#turn-again").click()
    assert log_of(page) == whole  # it asks first
    page.locator("#turn-again").click()
    assert log_of(page) == ""
    page.locator("#turn-undo").click()
    assert log_of(page) == whole


def test_the_page_is_open_to_everybody(opened: Opened, folder: Path):
    page = fresh(opened, page_of(folder))
    assert not barred(page)


def test_a_lab_may_let_its_page_say_what_is_right(opened: Opened, run: Run, tmp_path: Path):
    """A point within the cell of the key is right; one 5 mm off is not; other labs say nothing."""
    lab = tmp_path / "pump"
    copytree(scene_files.folder("pump"), lab)
    with (lab / "lab.toml").open("a", encoding="utf-8") as file:
        file.write("\n[marking]\nsays_right = true\n")
    run("sheet", lab, "-o", tmp_path, "--view", "task", "--format", "html", "--lang", "en")
    page = fresh(opened, tmp_path / "pump-task.html")
    say = page.locator("#turn-say")
    typed(page, "ray O1 44\noff O1 44 55\nA")
    say.filter(has_text="A is not at its place.").wait_for()
    page.locator("#turn-undo").click()
    typed(page, "off O1 44 60.4\nA")
    say.filter(has_text="A: right.").wait_for()


SIZES = {"desktop": (1366, 768), "tablet": (820, 1180), "phone": (390, 844)}
PLACES = """() => ["#given", "#asked", ".scales", ".fields"].map(one =>
  document.querySelector(`main.task ${one}`).getBoundingClientRect().bottom + scrollY)"""
"""The lower edges of what is given, of what is asked for, of the scales, the first fields."""


@pytest.mark.parametrize("size", SIZES)
def test_the_question_is_read_before_the_board(opened: Opened, folder: Path, size: str):
    """The quantities of both plans stand above the fields; on a desktop, on the first screen."""
    width, height = SIZES[size]
    page = opened(page_of(folder), viewport={"width": width, "height": height})
    given, asked, scales, fields = page.evaluate(PLACES)
    assert asked < scales < fields and given < scales
    assert size != "desktop" or asked < height / 2
    told = page.locator("#asked").inner_text()
    spoken = load("pump").spoken("ro").scene.ask
    assert RO("ask.velocity", list="D") in told and RO("ask.acceleration", list="D") in told
    assert spoken.velocity == spoken.acceleration == ("D",)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_a_planetary_gear_is_drawn_to_its_end_by_keys(opened: Opened, run: Run, tmp_path: Path):
    run("sheet", RING_SCENE, "-o", tmp_path, "--view", "task", "--format", "html", "--lang", "en")
    page = fresh(opened, tmp_path / "gears-ring-task.html")
    typed(page, RING)
    (log,) = page.evaluate("Object.values(localStorage)")
    given = board_given(
        [each.drawing for each in screen_sheets(load(str(RING_SCENE)), "en", "task")]
    )
    drawn, right = (replayed(given, one) for one in (log, GEARS))
    assert drawn.named.keys() == right.named.keys()
    for letter in right.named:
        assert abs(drawn.value_of(letter) - right.value_of(letter)) < 1e-9


def test_a_drawing_without_a_form_is_saved_and_opened(opened: Opened, run: Run, tmp_path: Path):
    """It is a table as the answers of a lab are; what it replaces can be had back."""
    run("sheet", RING_SCENE, "-o", tmp_path, "--view", "task", "--format", "html", "--lang", "en")
    task = tmp_path / "gears-ring-task.html"
    page = fresh(opened, task)
    typed(page, RING)
    (log,) = page.evaluate("Object.values(localStorage)")
    with page.expect_download(timeout=5000) as saved:
        page.locator("#drawing-save").click()
    file = tmp_path / saved.value.suggested_filename
    saved.value.save_as(file)
    assert file.name == f"{task.stem}-drawing.csv"
    with file.open(newline="", encoding="utf-8") as rows:
        assert [*csv.reader(rows)] == [["field", "value"], ["drawing", log]]
    other = fresh(opened, task)
    typed(other, "ray O 50")
    (before,) = other.evaluate("Object.values(localStorage)")
    other.locator("#drawing-file").set_input_files(file)
    said = other.locator("#turn-say")
    moves = log.count(BETWEEN) + 1
    opened_words = words("en")("board.opened", file=file.name, number=moves)
    said.filter(has_text=opened_words).wait_for(timeout=5000)
    assert other.evaluate("Object.values(localStorage)") == [log]
    other.locator("#turn-undo").click()
    assert other.evaluate("Object.values(localStorage)") == [before]
    (tmp_path / "empty.csv").write_text("field,value\r\n", encoding="utf-8")
    other.locator("#drawing-file").set_input_files(tmp_path / "empty.csv")
    said.filter(has_text=words("en")("board.no_drawing", file="empty.csv")).wait_for(timeout=5000)
    assert other.evaluate("Object.values(localStorage)") == [before]


@pytest.mark.parametrize(("school", "pole"), [("german", "Pv"), ("russian", "p")])
def test_the_hint_on_typing_signs_the_pole_as_its_page(
    opened: Opened, run: Run, tmp_path: Path, school: str, pole: str
):
    """What it says can be typed, and so can the usual letter."""
    house = f'graphkin = 1\n[signs]\nset = "{school}"\n'
    (tmp_path / "house.toml").write_text(house, encoding="utf-8")
    args = ["--view", "task", "--format", "html", "--lang", "en", "-o", tmp_path]
    result = run("sheet", "pump", "--house", tmp_path / "house.toml", *args)
    assert result.exit_code == 0, result.output
    page = fresh(opened, next(tmp_path.glob("*.html")))
    assert f"off {pole} AB" in page.locator("#turn-say").inner_text()
    for number, sign in enumerate((pole, "o"), 1):
        page.locator("#turn-typed").fill(f"ray {sign} {30 * number}")
        page.keyboard.press("Enter")
        assert "nothing here is called" not in page.locator("#turn-say").inner_text()
        assert page.evaluate("Object.values(localStorage)[0]").count("ray") == number


def test_typing_is_spoken_of_where_it_is_possible(opened: Opened, folder: Path):
    by_keys = RO("board.by_keys", pole="o")
    desk = fresh(opened, page_of(folder)).locator("#turn-say").inner_text()
    phone = fresh(opened, page_of(folder), has_touch=True, is_mobile=True)
    assert desk == f"{RO('board.begin')} {by_keys}"
    assert phone.locator("#turn-say").inner_text() == RO("board.begin")
