"""Everything on the page follows from the text: drawings, numbers, margins, verdict, mistakes."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from threading import Thread

import pytest

from graphkin.construction.core.solution import Verdict
from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.link_points import lettered
from graphkin.scene.read_scene import read_text
from graphkin.studio.panels import Memory, StaleError, around
from graphkin.text import LANGUAGES
from graphkin.text.errors import WitnessError
from tests.chosen import FOLDER, by_turns
from tests.scene_files import scene_text
from tests.studio.pump import PUMP, desk_in, line_with, ordered, seen, svgs

SINGULAR = scene_text("studio/singular")


def rows(html: str) -> list[list[str]]:
    """The cells of the bodies of all tables, as plain text."""
    found = []
    for row in re.findall(r"<tr[^>]*>(.*?)</tr>", html):
        cells = re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row)
        found.append([unescape(re.sub(r"<[^>]+>", "", cell)) for cell in cells])
    return found


def test_the_numbers_are_those_of_the_solution():
    found = seen(settings={"n": "12", "gone": "5"})
    assert not found["problems"], "a slider that the text has no longer is dropped"
    motion = load("pump", n=12).solve()
    told = {row[0]: row for row in rows(found["results"])}
    assert float(told["vD"][3]) == pytest.approx(abs(motion.points["D"].velocity), rel=1e-3)
    assert float(told["aD"][3]) == pytest.approx(abs(motion.points["D"].acceleration), rel=1e-3)
    assert float(told["ω3"][1]) == pytest.approx(abs(motion.links["3"].omega), rel=1e-3)
    centre = motion.links["3"].instant_centre
    place = centre.start + centre.shift / centre.size
    said = [float(cell.replace("−", "-")) for cell in told["I3"][1:]]
    assert said == pytest.approx([100 * place.real, 100 * place.imag], rel=1e-3)
    assert found["verdict"]["agrees"]


CRANK, WHEEL = (
    (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    for name in ("slider-crank", "geneva-dwell")
)
NEAR = CRANK.replace('angle = "angle"', "angle = 0.2").replace(", offset = 30", "")
"""A piston on the line of its crank, near its dead point; the wheel dwells."""


@pytest.mark.parametrize(
    ("language", "text"), [("ro", NEAR), ("en", WHEEL), ("it", PUMP)], ids=["near", "wheel", "pump"]
)
def test_what_is_asked_and_cannot_be_read_off_is_told_as_sheets_tell_it(language, text):
    told = [
        unescape(re.sub(r"<[^>]+>", "", note)).replace("_", "")
        for note in re.findall('<p class="note">(.*)</p>', seen(text, language=language)["results"])
    ]
    sheets = hand_out(Mechanism(read_text(text, "scene")), language=language)
    assert told == [note.replace("_", "") for part in sheets for note in part.unread]
    assert bool(told) == (text is not PUMP)


@pytest.mark.parametrize(("name", "language"), by_turns(scene_files.names(), LANGUAGES))
def test_every_lab_is_seen_in_every_language(name, language):
    text = (scene_files.shelf() / name / "scene.toml").read_text(encoding="utf-8")
    from graphkin.studio.look import Sight, look

    found = look(Sight(text, name, language), Memory(), lambda: None)
    assert not found["problems"]
    assert set(svgs(found)) == {"mechanism", "velocity", "acceleration"}
    assert f'lang="{language}"' in svgs(found)["velocity"]
    assert "{" not in found["results"] + found["margins"] + found["verdict"]["words"]


def test_every_mistake_is_told_and_sliders_stay_where_the_text_can_be_read():
    text = PUMP.replace("A-B = 40", "A-X = 40").replace('velocity = ["D"]', 'velocity = ["Q"]')
    found = seen(text)
    assert len(found["problems"]) == 2
    assert "panels" not in found
    apart = seen(PUMP.replace("O2-B = 30", "O2-B = 3"))
    assert [slider["name"] for slider in apart["sliders"]] == ["n"]
    (problem,) = apart["problems"]
    assert "arcs miss each other" in problem["found"]
    assert problem["line"] == line_with('B = "right')


def test_a_nearly_singular_position_is_shown_with_a_warning():
    found = seen(SINGULAR)
    assert any("flattest crossing" in problem["found"] for problem in found["problems"])
    assert seen(SINGULAR, settings={"h": "240"})["problems"] == []


HOSTILE = "<img src=x onerror=alert(1)>\"'&</script><script>alert(2)</script>"


def test_hostile_titles_and_notes_are_nothing_but_text():
    written = HOSTILE.replace("\\", "").replace('"', '\\"')
    text = PUMP.replace('en = "Pump mechanism"', f'en = "{written}"')
    text = text.replace("[sheet]", f'[notes]\nen = "{written}"\n[sheet]\nowner = "{written}"')
    found = seen(text)
    assert found["title"] == HOSTILE
    markup = [*svgs(found).values(), found["results"], found["margins"]]
    markup += [panel["caption"] for panel in found["panels"]]
    for each in markup:
        assert "<script" not in each
        assert "<img" not in each
        assert "onerror=" not in each


def test_an_expression_is_never_evaluated_as_code(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for evil in ("__import__('os').mkdir('evil')", "open('evil','w')", "().__class__", "exec('1')"):
        found = seen(PUMP.replace("C-D = 20", f'C-D = "{evil}"'))
        assert found["problems"][0]["line"] == line_with("C-D = 20")
        assert seen(settings={"n": evil})["problems"]
    assert not list(tmp_path.iterdir())


def test_only_the_newest_move_is_computed(tmp_path):
    session = desk_in(tmp_path)
    assert "panels" in session.look(ordered(number=5, quick=True))
    assert session.look(ordered(number=3, quick=True)) == {"stale": True, "number": 3}
    assert "panels" in session.look(ordered(number=1, tab="another page", quick=True))


def test_what_is_being_drawn_ends_when_something_newer_is_asked_for(tmp_path):
    session = desk_in(tmp_path)
    from graphkin.studio.look import Sight, look

    calls = []

    def newer() -> None:
        calls.append(1)
        session.arrived("a", 2)
        session.still_wanted("a", 1)

    with pytest.raises(StaleError):
        look(Sight(PUMP, "pump", "en"), Memory(), newer)
    assert len(calls) == 1


def test_a_route_that_does_not_agree_is_said_aloud_and_nothing_is_handed_out(monkeypatch):
    def doubting(self, solution, **_):
        return Verdict(False, 0.25, "velocity of D", 1e-9, 0.0, 0.0, ("B",))

    monkeypatch.setattr(Mechanism, "witness", doubting)
    verdict = seen()["verdict"]
    assert not verdict["agrees"]
    assert "0.25" in verdict["words"]
    assert "velocity of D" in verdict["words"]
    assert 'B = "right of A-O2"' in verdict["words"]
    with pytest.raises(WitnessError):
        hand_out(load("pump"))


WATT = (Path(__file__).parents[2] / "examples/scenes/watt-1.toml").read_text(encoding="utf-8")
"""A mechanism whose sheets are of several scales over a turn."""
TURN = ("60", "90", "150", "240", "330", "60")


def test_the_frame_holds_what_is_drawn_and_never_shrinks_while_a_slider_moves():
    memory = Memory()
    before = frame_of(svgs(seen(WATT, memory, settings={"angle": TURN[0]}))["mechanism"])
    for at in TURN:
        svg = svgs(seen(WATT, memory, settings={"angle": at}, quick=True))["mechanism"]
        left, top, right, bottom = frame = frame_of(svg)
        for x, y in ends_of(svg, "link"):
            assert left < x < right, at
            assert top < y < bottom, at
        assert around(frame, before) == frame
        before = frame


ENDS = ("x1", "y1", "x2", "y2")


def ends_of(svg: str, cls: str, name: str = '[^"]*') -> list[tuple[float, float]]:
    """The ends of the lines of a class in a picture."""
    lines = re.findall(rf'<line class="{cls}" data-name="{name}"[^>]*>', svg)
    numbers = [[float(line.split(f' {at}="')[1].split('"')[0]) for at in ENDS] for line in lines]
    return [end for x1, y1, x2, y2 in numbers for end in ((x1, y1), (x2, y2))]


def frame_of(svg: str) -> tuple[float, float, float, float]:
    """The edges of a picture."""
    left, top, width, height = map(float, re.search(r'viewBox="([^"]*)"', svg)[1].split())
    return left, top, left + width, top + height


def test_who_waits_for_a_drawing_goes_when_something_newer_is_asked_for(tmp_path):
    session, answers = desk_in(tmp_path), []
    waiting = Thread(target=lambda: answers.append(session.look(ordered(number=1))))
    with session.drawing():
        waiting.start()
        session.arrived("a", 2)
        waiting.join()
    assert answers == [{"stale": True, "number": 1}]


def test_a_move_is_seen_as_if_it_were_the_first_look():
    """The construction of a text is written once: what a value of a slider makes impossible is
    told all the same, and what is drawn has the same numbers."""
    text = scene_files.examples()["gears-pair"].read_text("utf-8")
    text = text.replace('O2 = ["2.5*(z1 + z2)", 0]', "O2 = [160, 0]")
    memory = Memory()
    assert not seen(text, memory)["problems"]
    for moves in ({"z1": "20"}, {"z1": "24", "angle": "75"}):
        moved = seen(text, memory, quick=True, settings=moves)
        fresh = seen(text, settings=moves)
        assert moved["problems"] == fresh["problems"]
        assert bool(moved["problems"]) == (moves["z1"] == "20")
        both = [[row[-1] for row in rows(each.get("results", ""))] for each in (moved, fresh)]
        assert both[0] == both[1]


def places_in(text: str) -> dict[str, list[str]]:
    """The rows of centres and poles of a text, by the names of the places."""
    told = seen(text)["results"].partition("Centres and poles")[2]
    return {row[0].replace("_", ""): row[1:] for row in rows(told)[1:]}


def test_every_place_that_is_asked_has_a_row_with_its_coordinates():
    """Cardan's bar: the circle of inflections passes through the crossing of the guides, W."""
    text = scene_text("studio/everything-asked")
    ask = read_text(text, "own", None, {}).ask
    wanted = {f"I{name}" for name in (*ask.centres, *ask.pairs)}
    wanted |= {f"J{name}" for name in ask.poles} | {f"W{name}" for name in ask.inflection}
    wanted |= {f"Ω{lettered(name)}" for name in ask.curvature}
    travel = {"quantity", "ψ3", "H5", "K5"}  # a table of its own, with one value in a row
    assert {*places_in(text)} - travel == wanted
    bar = (FOLDER / "inflection-cardan.toml").read_text(encoding="utf-8")
    assert places_in(bar) == {"W2": ["0", "0"]}


def test_asked_strokes_and_time_ratios_are_among_the_results():
    """A link without a stroke is a mistake at its place in the text."""
    text = Path(scene_files.find("slotted-lever")).read_text(encoding="utf-8")
    text = text.replace("[ask]", "[ask]\nstrokes = [3, 5]\ntime_ratios = [5]")
    found = seen(text)
    assert not found["problems"]
    told = {row[0]: row[1:] for row in rows(found["results"])}
    assert told["ψ3"] == ["47.16°"]
    assert told["H5"] == ["0.4960 m"]
    assert told["K5"] == ["1.710"]
    (wrong,) = seen(text.replace("strokes = [3, 5]", "strokes = [3, 1]"))["problems"]
    assert "ask.strokes[1]" in str(wrong)
    assert "link 1 does not move to and fro" in str(wrong)
