"""Your turn in a real browser: by mouse, finger and keys, from nothing but what the page shows."""

from __future__ import annotations

import math
import random
import re
from pathlib import Path
from typing import Any

import pytest

from graphkin.mechanism import load
from graphkin.text import LANGUAGES, words
from graphkin.web.protocol import telling
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import step_page
from graphkin.web.your_turn import your_turn
from tests.browser.opening import PAINTED, Opened, barred
from tests.browser.test_page import DESKTOP, PHONE
from tests.browser.turning_hand import TurningHand
from tests.chosen import EVERY
from tests.documents.sheet_tools import mechanism_named

SCENES = {
    "pump": lambda: load("pump"),
    "slotted-lever": lambda: load("slotted-lever"),
    "stephenson-3-crank": lambda: mechanism_named("stephenson-3-crank"),
}
"""Bars and a slider, a slotted lever with Coriolis, a group of class III."""
if EVERY:
    SCENES["gears-ring"] = lambda: mechanism_named("gears-ring")  # a planet in a ring
SHAPES = ("desktop", "phone") if EVERY else ("phone",)
WINDOWS = ((390, 844), (360, 640), (844, 390))
"""Sizes of a phone's window."""
EN = words("en")
CENTRE = """letter => {
  const sheet = document.querySelector('.sheet:not([hidden])');
  const named = [...sheet.querySelectorAll(`circle[data-name='${letter}']`)];
  const { x, y, width, height } = named.at(-1).getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}"""
SEEN = """name => [...document.querySelectorAll(`.sheet:not([hidden]) [data-name='${name}']`)]
  .filter(mark => mark.checkVisibility({ visibilityProperty: true })).length"""
DRAW = """([action, inputs, which]) => {
  const called = button => (button.getAttribute('aria-label') ?? button.textContent).trim();
  const button = [...document.querySelectorAll('button')].find(each => called(each) === action);
  if (button.getAttribute('aria-pressed') === 'false') button.click();
  inputs.forEach((wanted, place) => {
    const list = document.querySelectorAll('#inputs select')[place];
    const offered = [...list.options].find(each => wanted === (which === null ? each.label.trim() :
      each.value));
    if (!offered) throw new Error(`${wanted} is not offered`);
    list.value = offered.value;
    list.dispatchEvent(new Event('change', { bubbles: true }));
  });
  document.querySelector('#turn-draw').click();
  const choices = document.querySelector('#which'), told = which !== null;
  if (told && choices.checkVisibility()) choices.querySelectorAll('button')[which].click();
  return document.querySelector('#turn-say').innerText;
}"""
"""A move by the lists, at once: a mouse, a finger and keys are tried one by one below. What it is
drawn from is told by its words, or by its key where it is told which of two places is taken."""
LIT = "[...document.querySelectorAll('.halo > *')].map(mark => mark.outerHTML).join()"
"""All that is lit on the drawings, and the lines and points that a turn lays over them."""
KNOWN = """() => [...document.querySelectorAll('#results tr[data-found]:not(.unknown)')]
  .map(row => row.dataset.row)"""
COVERED = """() => {
  const [svg] = [...document.querySelectorAll('.sheet:not([hidden]) .view > svg')].slice(-1);
  const seen = mark => !mark.matches('.later,.void,[visibility],.hushed,.leader');
  const box = mark => mark.getBoundingClientRect(), matrix = svg.getScreenCTM();
  const ends = line => ['1', '2'].map(end =>
    new DOMPoint(...['x', 'y'].map(axis => line.getAttribute(axis + end))).matrixTransform(matrix));
  const within = ({ x, y }, b, slack) => x > b.left + slack && x < b.right - slack &&
    y > b.top + 4 * slack && y < b.bottom - 4 * slack; // letters do not fill the height of a line
  const on = (line, b) => {
    const [p, q] = ends(line), places = Array.from({ length: 801 }, (_, i) => i / 800);
    return places.some(t => within({ x: p.x + t * (q.x - p.x), y: p.y + t * (q.y - p.y) }, b, 1));
  };
  const meets = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom - 8 &&
    b.top < a.bottom - 8;
  const lines = [...svg.querySelectorAll('line')].filter(seen);
  const texts = [...svg.querySelectorAll('text')].filter(seen);
  return [...svg.querySelectorAll('text.open')].map(own => [own.textContent,
    lines.filter(line => on(line, box(own))).length,
    texts.filter(text => text !== own && meets(box(text), box(own))).length]);
}"""
"""Of each name of an open line how many lines and names it lies on."""
WIDER = """() => ['#stops', '#values', '#palette', '#turn-keys', '#dock', 'html']
  .map(name => document.querySelector(name))
  .filter(part => part.scrollWidth > part.clientWidth + 1).map(part => part.id)"""
"""The parts of a page that scroll sideways."""
LATER = "document.querySelectorAll('.sheet:not([hidden]) .later').length"


@pytest.fixture(scope="module")
def pages(tmp_path_factory) -> Path:
    """A folder with the pages of the scenes."""
    folder = tmp_path_factory.mktemp("turns")
    for name, loaded in SCENES.items():
        (folder / f"{name}.html").write_text(step_page(loaded(), "en"), encoding="utf-8")
    return folder


def begun(opened: Opened, pages: Path, name: str, step: int | str, **options: Any) -> Any:
    """A page on which the reader draws from a step on."""
    page = opened(pages / f"{name}.html", f"#step={step}", **(options or DESKTOP))
    page.locator("#turn").click()
    page.locator("#turn-panel").wait_for()
    page.evaluate(PAINTED)
    again = page.locator("#turn-again")
    while again.is_visible():  # a turn that was left: sure, and again
        again.click()
        page.evaluate(PAINTED)
    return page


def said(page: Any) -> str:
    """What the page says."""
    return page.locator("#turn-say").inner_text()


def why(page: Any) -> str:
    """Why that is so, or why the last step is drawn as it is."""
    return page.locator("#turn-sentence").inner_text()


def point(page: Any, at: tuple[float, float]) -> None:
    """Point at a place of the window, until the page has shown what it shows there."""
    page.mouse.move(*at)
    page.evaluate(PAINTED)


def take(page: Any, action: str) -> None:
    """Choose an action."""
    button = page.get_by_role("button", name=EN(f"turn.action.{action}"), exact=True)
    if button.get_attribute("aria-pressed") == "false":
        button.click()


def by_lists(page: Any, action: str, *inputs: str) -> str:
    """Draw by the lists, and hear what the page says of it."""
    heard: str = page.evaluate(DRAW, [EN(f"turn.action.{action}"), list(inputs), None])
    return heard


def at(page: Any, *letters: str) -> tuple[float, float]:
    """The place of a point on the screen, or the middle of two."""
    places = [page.evaluate(CENTRE, letter) for letter in letters]
    x, y = (sum(axis) / len(places) for axis in zip(*places, strict=True))
    return x, y


def by_mouse(page: Any, action: str, *inputs: tuple[str, ...]) -> str:
    """Draw by pointing at points and bars, and hear what the page says of it."""
    take(page, action)
    for letters in inputs:
        page.mouse.click(*at(page, *letters))
    return said(page)


# --- the pump's velocity plan ---------------------------------------------------------------------


def test_the_velocity_plan_of_the_pump_by_right_choices(kept: Opened, pages: Path):
    page = begun(kept, pages, "pump", 5)
    assert page.evaluate(SEEN, "a") == 0
    by_lists(page, "lay_off", "o", "vA")
    assert said(page) == EN("turn.say.which")
    page.locator("#which button").first.click()
    assert said(page) == "a: right."
    assert page.evaluate(SEEN, "a") > 0
    assert by_lists(page, "perpendicular", "a", "AB") == "⊥ AB (a): right."
    ends = page.locator(".sheet:not([hidden]) line[data-of='48']").first
    assert not ends.is_visible()  # a line does not show where the point on it lies
    assert by_lists(page, "perpendicular", "o", "O2B") == "⊥ O2B (o): right."
    assert page.evaluate(SEEN, "b") == 0
    assert by_lists(page, "cut", "⊥ AB (a)", "⊥ O2B (o)").startswith("b: right.")
    assert page.evaluate(SEEN, "b") > 0
    assert ends.is_visible()
    assert page.locator(".sheet:not([hidden]) line.open").count() == 0
    assert "meet at b" in page.locator("#turn-sentence").inner_text()
    by_lists(page, "perpendicular", "a", "AC")
    by_lists(page, "perpendicular", "b", "BC")
    assert by_lists(page, "cut", "⊥ AC (a)", "⊥ BC (b)") == "c: right."
    by_lists(page, "perpendicular", "c", "CD")
    by_lists(page, "parallel", "o", "guide 5")
    told = by_lists(page, "cut", "⊥ CD (c)", "∥ guide 5 (o)")
    assert told.startswith("d: right. Velocities: all drawn.")
    by_lists(page, "perpendicular", "A", "vA")
    by_lists(page, "perpendicular", "B", "vB")
    assert by_lists(page, "cut", "⊥ vA (A)", "⊥ vB (B)") == "I3: right. Centres: all drawn."
    assert by_lists(page, "transfer", "vA", "A") == "vA: right."
    assert page.locator("#sheet-0").is_visible()
    assert by_lists(page, "transfer", "vD", "D").startswith("vD: right.")
    assert page.locator("#sheet-1").is_visible()
    page.locator("#turn-sheet").click()
    assert page.evaluate(LATER) == 0
    page.locator("#turn-score").click()
    told = page.locator("#score p").inner_text()
    assert "Alone: 15; with a hint: 0; drawn by the page: 0. Wrong turns: 0." in told


def test_a_wrong_choice_is_told_why_in_one_line(kept: Opened, pages: Path):
    page = begun(kept, pages, "pump", "6&x=80")  # it begins at the drawn position
    page.locator("#turn-score").click()
    counts = page.locator("#score p")  # it stays open, and counts at once
    assert "Alone: 0;" in counts.inner_text() and "Wrong turns: 0." in counts.inner_text()
    told = by_mouse(page, "perpendicular", ("a",), ("O2", "B"))
    assert told == "vBA is perpendicular to AB, not to O2B."
    assert "Wrong turns: 1." in counts.inner_text()
    told = by_lists(page, "perpendicular", "o", "AB")
    assert told.startswith("A line through o is right only where the other end of AB is at rest.")
    assert re.search(r"AB would (stretch|shorten) by [\d.]+ m/s\.$", told)
    assert "relative to A, B can move only perpendicular to it" in why(page)
    told = by_lists(page, "parallel", "a", "guide 5")
    assert told.startswith("The parallel to guide 5 is drawn through o, not through a.")
    assert re.search(r"The block would leave its guide by [\d.]+ m/s\.$", told)
    assert why(page) == "relative to guide 5 its block can move only along it"
    page.locator("#inputs select").first.select_option(label="o")
    assert said(page) == "Parallel: through o, to …"
    assert why(page) == ""
    by_lists(page, "perpendicular", "a", "AB")
    assert by_lists(page, "perpendicular", "a", "AB") == "⊥ AB (a) is drawn already."
    assert why(page) == ""
    assert "Alone: 1;" in counts.inner_text() and "Wrong turns: 3." in counts.inner_text()
    assert "wrong turns: 3" in page.locator("#score li").inner_text()


def test_another_order_and_another_way_are_right(kept: Opened, pages: Path):
    page = begun(kept, pages, "pump", 6)
    assert by_lists(page, "parallel", "o", "guide 5") == "∥ guide 5 (o): right."
    by_lists(page, "perpendicular", "o", "O2B")
    by_lists(page, "perpendicular", "a", "AB")
    by_lists(page, "cut", "∥ guide 5 (o)", "⊥ AB (a)")
    assert page.evaluate(SEEN, "d") == 0
    assert by_lists(page, "cut", "⊥ O2B (o)", "⊥ AB (a)").startswith("b: right.")
    assert by_lists(page, "similar", "a", "b", "C") == "c: right."  # no perpendiculars
    assert by_lists(page, "perpendicular", "C", "vC").startswith("A line of your own")
    by_lists(page, "perpendicular", "A", "vA")
    assert by_lists(page, "cut", "⊥ vA (A)", "⊥ vC (C)") == "I3: right. Centres: all drawn."


def test_a_hint_lights_where_a_step_starts(kept: Opened, pages: Path):
    page = begun(kept, pages, "pump", 6)
    hint = page.locator("#hint")
    hint.click()
    assert said(page) == "Does vBA lie along AB, or perpendicular to it?"
    assert why(page) == ""
    hint.click()
    assert said(page) == "b: the next action is “Perpendicular”."
    assert page.locator(".sheet:not([hidden]) .halo .new").count() == 0
    hint.click()
    assert said(page) == "Perpendicular: through a, to AB"
    assert page.locator(".sheet:not([hidden]) .halo .new").count() == 2
    by_lists(page, "perpendicular", "a", "AB")
    assert page.locator(".sheet:not([hidden]) line.open").count() == 1
    page.locator("#draw-it").click()
    assert page.locator(".sheet:not([hidden]) line.open").count() == 2
    page.locator("#turn-score").click()
    assert page.locator("#score li").all_inner_texts() == [
        "⊥ AB (a): with a hint",
        "⊥ O2B (o): drawn by the page",
    ]


def test_keys_alone_draw(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", "#step=6", **DESKTOP)
    page.locator("#turn").focus()
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.dataset.action") == "perpendicular"
    page.keyboard.press("Enter")
    while not page.evaluate("document.activeElement.matches('#inputs select')"):
        page.keyboard.press("Tab")
    page.keyboard.press("a")  # A
    page.keyboard.press("a")
    page.keyboard.press("Tab")
    page.keyboard.type("AB")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert said(page) == "⊥ AB (a): right."
    assert page.evaluate("document.activeElement.dataset.action") == "perpendicular"
    page.keyboard.press("ArrowRight")  # goes to no other step
    assert page.locator("#turn-panel").is_visible()
    assert page.evaluate(SEEN, "b") == 0


def test_pointing_at_marks_tells_nothing_of_the_next_step(kept: Opened, pages: Path):
    """What is lit is the turn's own, whatever has been pointed at; at the end it is nothing."""
    page = begun(kept, pages, "pump", 5)
    assert page.evaluate(LIT) == ""
    for _ in range(13):
        before = page.evaluate(LIT)
        for place in (at(page, "A"), at(page, "B"), (3.0, 3.0)):
            point(page, place)
            assert page.evaluate(LIT) == before
        page.locator("#draw-it").click()
    assert "I3" in said(page)
    point(page, at(page, "A"))
    point(page, (3.0, 3.0))
    assert page.evaluate(LIT) == ""


def test_both_candidates_stay_until_one_is_chosen(kept: Opened, pages: Path):
    page = begun(kept, pages, "pump", 5)
    by_lists(page, "lay_off", "o", "vA")
    asked = page.evaluate(LIT)
    assert page.locator(".sheet:not([hidden]) text.ghost").all_text_contents() == ["1", "2"]
    point(page, at(page, "B"))
    page.mouse.click(*at(page, "B"))
    point(page, (3.0, 3.0))
    assert page.evaluate(LIT) == asked
    assert page.locator("#which button").count() == 2
    page.locator("#which button").nth(1).click()
    assert said(page) == "vA points the other way: ω1 is counter-clockwise."
    assert page.evaluate(SEEN, "a") == 0


def test_nothing_stays_lit_of_a_mechanism_that_was_moved_before(opened: Opened, pages: Path):
    """The driver goes back as a turn begins; what was marked is not marked again as it rests."""
    page = opened(pages / "pump.html", "#step=19", stopped=True, **DESKTOP)
    page.locator("#driver").fill("70")
    assert page.locator(".halo > *").count() > 0
    page.locator("#turn").click()
    page.clock.run_for(2000)
    assert page.locator(".halo > *").count() == 0


def test_a_turn_that_was_left_goes_on(opened: Opened, pages: Path):
    """With the same steps, wherever the page has been meanwhile, until one begins again."""
    page = begun(opened, pages, "pump", 6)
    assert not page.locator("#turn-again").is_visible()
    page.locator("#turn-end").click()
    assert page.locator("#turn").get_attribute("title") == EN("turn.begin")  # nothing to lose
    page.locator("#turn").click()
    by_lists(page, "perpendicular", "a", "AB")
    by_lists(page, "parallel", "a", "guide 5")
    page.locator("#turn-score").click()
    count, score = (page.locator(name).inner_text() for name in ("#turn-count", "#score"))
    page.locator("#turn-end").click()
    assert page.locator("#count").inner_text() == "Step 6 of 42"  # where it began
    assert page.evaluate(SEEN, "a") > 0
    assert page.locator("#turn").get_attribute("title") == EN("turn.resume")
    page.keyboard.press("End")
    page.locator("#turn").click()
    assert page.locator("#turn-count").inner_text() == count
    assert page.locator("#score").inner_text() == score
    assert page.evaluate(SEEN, "b") == 0
    by_lists(page, "perpendicular", "o", "O2B")
    assert by_lists(page, "cut", "⊥ AB (a)", "⊥ O2B (o)").startswith("b: right.")
    page.locator("#turn-end").click()
    assert page.locator("#count").inner_text() == "Step 42 of 42"
    page.locator('[data-stop="5"]').first.click()
    page.locator("#turn").click()
    page.locator("#turn-again").dblclick()
    assert page.evaluate(SEEN, "a") == 0
    assert by_lists(page, "lay_off", "o", "vA") == EN("turn.say.which")


def test_a_turn_outlives_its_page(opened: Opened, pages: Path):
    """It goes on after a reload, and in another tab; only who presses twice throws it away."""
    page = begun(opened, pages, "pump", 5)
    by_lists(page, "lay_off", "o", "vA")
    page.locator("#which button").first.click()
    by_lists(page, "perpendicular", "o", "AB")  # a wrong turn
    page.locator("#hint").click()
    by_lists(page, "perpendicular", "a", "AB")
    by_lists(page, "parallel", "a", "guide 5")
    page.locator("#turn-score").click()
    count, score = (page.locator(name).inner_text() for name in ("#turn-count", "#score"))
    page.reload()
    assert page.locator("#turn-panel").is_visible()
    page.locator("#turn-score").click()
    assert page.locator("#turn-count").inner_text() == count
    assert page.locator("#score").inner_text() == score
    assert by_lists(page, "perpendicular", "a", "AB") == "⊥ AB (a) is drawn already."
    page.locator("#turn-end").click()
    other = page.context.new_page()
    other.goto(page.url)
    assert not other.locator("#turn-panel").is_visible()
    assert other.locator("#turn").get_attribute("title") == EN("turn.resume")
    other.locator("#turn").click()
    by_lists(other, "perpendicular", "o", "O2B")
    assert by_lists(other, "cut", "⊥ AB (a)", "⊥ O2B (o)").startswith("b: right.")
    again = other.locator("#turn-again")
    again.click()
    assert said(other) == EN("turn.say.sure")
    assert other.evaluate(SEEN, "b") > 0
    other.locator("#hint").click()  # no answer to that
    again.click()
    assert other.evaluate(SEEN, "b") > 0
    again.click()
    assert other.evaluate(SEEN, "b") == 0
    other.reload()
    assert other.locator("#turn").get_attribute("title") == EN("turn.begin")
    other.close()


def test_a_line_of_ones_own_outlives_the_page(opened: Opened, pages: Path):
    page = begun(opened, pages, "pump", 12)
    assert by_lists(page, "perpendicular", "C", "vC").startswith("A line of your own")
    page.reload()
    assert page.locator(".sheet:not([hidden]) line.own").count() == 1
    by_lists(page, "perpendicular", "A", "vA")
    assert by_lists(page, "cut", "⊥ vA (A)", "⊥ vC (C)").startswith("I3: right.")


def test_what_a_move_finds_is_told(kept: Opened, pages: Path):
    """Its size and its length, and in the tables; nothing that is still sought."""
    page = begun(kept, pages, "pump", 10)
    known = ["v_A", "v_B", "v_BA", "v_C", "v_CA", "v_CB", "ω1", "ω2", "ω3"]
    assert page.evaluate(KNOWN) == known
    by_lists(page, "perpendicular", "c", "CD")
    by_lists(page, "parallel", "o", "guide 5")
    assert page.evaluate(KNOWN) == known
    by_lists(page, "cut", "⊥ CD (c)", "∥ guide 5 (o)")
    assert {*page.evaluate(KNOWN)} == {*known, "v_D", "v_DC", "ω4"}
    told = page.locator("#turn-sentence .found").all_inner_texts()
    assert "vD = 3.827 m/s (od = 49.38 mm)" in told
    assert "ω4 = 30.75 rad/s, clockwise" in told


@pytest.mark.parametrize("shape", SHAPES)
def test_the_palette_stays_where_it_is(kept: Opened, pages: Path, shape: str):
    """Whatever is said and sought: a press of the same place is a press of the same button."""
    page = begun(kept, pages, "pump", 5, **(DESKTOP if shape == "desktop" else PHONE))
    tops = set()
    for _ in range(9):
        for action in ("perpendicular", "cut"):
            page.evaluate(f"document.querySelector('[data-action={action}]').click()")
            tops.add(page.locator("#palette").bounding_box()["y"])
        page.evaluate("document.querySelector('#draw-it').click()")
        tops.add(page.locator("#palette").bounding_box()["y"])
    assert len(tops) == 1


@pytest.mark.parametrize(
    ("name", "step", "lines"),
    [
        ("pump", 5, ["⊥ AB", "⊥ O2B"]),
        ("stephenson-3-crank", 34, ["⊥ AB", "⊥ O2B"]),
        ("slotted-lever", 21, ["⊥ O2A", "∥ guide 2"]),
        ("gears-ring", 10, ["⊥ OS", "⊥ T2S"]),
    ][: 4 if EVERY else 2],
)
def test_the_names_of_open_lines_lie_on_nothing(
    opened: Opened, pages: Path, name: str, step: int, lines: list[str]
):
    page = begun(opened, pages, name, step)
    names = page.locator(".sheet:not([hidden]) text.open")
    while names.count() < len(lines):
        page.locator("#draw-it").click()
        page.evaluate(PAINTED)
    assert page.evaluate(COVERED) == [[one, 0, 0] for one in lines]


@pytest.mark.parametrize("language", LANGUAGES if EVERY else ["it"])
def test_nothing_scrolls_sideways_on_a_phone(opened: Opened, tmp_path: Path, language: str):
    """Where there is no room for buttons the parts of the work stand in a list."""
    path = tmp_path / "pump.html"
    path.write_text(step_page(load("pump"), language), encoding="utf-8")
    page = opened(path, "#step=42")
    for width, height in WINDOWS[0 if EVERY else 1 :]:
        page.set_viewport_size({"width": width, "height": height})
        page.keyboard.press("End")
        assert page.evaluate(WIDER) == []
        page.locator("#stops select").select_option(index=2)
        assert page.evaluate("Number(document.getElementById('step').value)") == 5
        page.locator("#turn").click()
        page.locator("#draw-it").click()
        assert page.evaluate(WIDER) == []
        page.evaluate("document.querySelector('[data-action=cut]').click()")
        assert page.evaluate(WIDER) == []
        page.locator("#turn-end").click()


NO_ROOM = """new Promise(done => {
  for (const svg of document.querySelectorAll(".sheet svg"))
    for (const side of ["width", "height", "min-width", "min-height"])
      svg.style.setProperty(side, "0", "important");
  dispatchEvent(new Event("resize"));
  requestAnimationFrame(() => requestAnimationFrame(done));
})"""
BOXES = """[...document.querySelectorAll(".sheet svg")].map(
  svg => [svg.clientWidth, svg.clientHeight, svg.getAttribute("viewBox")])"""


def test_a_field_without_any_room_has_a_box_all_the_same(opened: Opened, tmp_path: Path):
    """While a window is resized a field may have no size for a moment."""
    path = tmp_path / "pump.html"
    path.write_text(step_page(load("pump"), "en"), encoding="utf-8")
    page = opened(path, "#step=42", **DESKTOP)
    page.evaluate(NO_ROOM)
    fields = page.evaluate(BOXES)
    assert fields
    for width, height, box in fields:
        assert (width, height) == (0, 0)
        assert all(math.isfinite(float(part)) for part in box.split())


def test_a_plan_that_the_page_draws_is_said_to_be_given(opened: Opened, tmp_path: Path):
    path = tmp_path / "kutzbach.html"
    path.write_text(step_page(mechanism_named("gears-kutzbach"), "en"), encoding="utf-8")
    page = opened(path, "#step=4", **DESKTOP)
    page.locator("#turn").click()
    assert EN("turn.say.kutzbach") in page.locator("#turn-say").inner_text()


@pytest.mark.parametrize("way", ["mouse", "touch"] if EVERY else ["touch"])
def test_the_velocity_plan_of_the_pump_by_one_hand(kept: Opened, pages: Path, way: str):
    """Each move by mouse up to the second point, by finger on a phone to the first: all right, none
    by help."""
    sheets = screen_sheets(load("pump"), "en")
    turn = your_turn(sheets, telling(sheets))
    moves = sorted(turn.moves.values(), key=lambda move: (move.at, move.step))
    page = begun(kept, pages, "pump", 5, **(PHONE if way == "touch" else DESKTOP))
    assert "Sought: a (oa = vA)" in page.locator("#turn-count").inner_text()
    hand = TurningHand(page, sheets, turn, way)
    hand.done |= {move.step for move in moves if move.at < 5}
    last, point_ = (11, "d") if EVERY else (7, "b") if way == "mouse" else (5, "a")
    for move in moves:
        if 5 <= move.at <= last:
            assert "right." in hand.draw(move), move
    assert page.evaluate(SEEN, point_) > 0


def test_a_guide_that_is_still_to_be_used_is_drawn(kept: Opened, pages: Path):
    """The ray at the crank's angle: a length is laid off on it by a click."""
    page = begun(kept, pages, "pump", 1)
    rays = page.locator("#sheet-0 line.open")
    assert rays.count() == 1
    sheets = screen_sheets(load("pump"), "en")
    turn = your_turn(sheets, telling(sheets))
    first = min(turn.moves.values(), key=lambda move: (move.at, move.step))
    assert TurningHand(page, sheets, turn, "mouse").draw(first) == "A: right."
    assert rays.count() == 0


# --- every kind of scene --------------------------------------------------------------------------


@pytest.mark.parametrize("name", SCENES if EVERY else [*SCENES][1:])
def test_each_scene_from_its_first_step_in_any_order(kept: Opened, pages: Path, name: str):
    """All that the record holds, in an order of chance that it allows, draws all that there is."""
    page = begun(kept, pages, name, 1)
    sheets = screen_sheets(SCENES[name](), "en")
    turn, chance = your_turn(sheets, telling(sheets)), random.Random(name)
    moves, done = turn.moves, set[int]()
    while len(done) < len(moves):
        ready = [step for step in moves if step not in done and done.issuperset(moves[step].needs)]
        step = chance.choice(ready)
        action = EN(f"turn.action.{moves[step].action}")
        inputs = [turn.picks[key].by or key for key in moves[step].inputs]
        for which in (0, 1):
            heard = page.evaluate(DRAW, [action, inputs, which])
            if "right." in heard:
                break
        drawn = ("right.", "is drawn already.", EN("turn.say.complete"))
        assert any(answer in heard for answer in drawn), (step, heard)
        done.add(step)
    assert page.locator("#turn-count").inner_text() == ""
    assert page.locator("#score").is_visible()
    assert page.locator("#results .unknown").count() == 0
    for _ in range(2):
        assert page.evaluate(LATER) == 0
        page.locator("#turn-sheet").click()


@pytest.mark.parametrize("shape", SHAPES)
def test_axe_finds_nothing_against_the_turn(kept: Opened, pages: Path, shape: str):
    """While the page says why: a phone shows that or the inputs of an action."""
    page = begun(kept, pages, "pump", 6, **(DESKTOP if shape == "desktop" else PHONE))
    if EVERY:
        take(page, "cut")
        page.evaluate("Promise.allSettled(document.getAnimations().map((each) => each.finished))")
        assert not barred(page)
    page.locator("#draw-it").click()
    assert page.locator("#turn-sentence").is_visible() and why(page)
    page.evaluate("Promise.allSettled(document.getAnimations().map((each) => each.finished))")
    assert not barred(page)
