"""The board of "your turn": drawn by dragging, by typing, taken back, and wrong in known ways."""

from __future__ import annotations

import re
from pathlib import Path
from statistics import median
from typing import Any

import pytest

from graphkin.mechanism import load
from graphkin.text import words
from graphkin.web.protocol import telling
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from graphkin.web.step_page import step_page
from graphkin.web.your_turn import PaletteMove, YourTurn, your_turn
from tests.browser.drawing_hand import DrawingHand, TypingHand
from tests.browser.opening import PAINTED, Opened
from tests.browser.test_page import PHONE
from tests.browser.test_your_turn import begun as begun_at
from tests.browser.test_your_turn import said

EN = words("en")
FROM = 5
"""The step of the pump from which its plans are drawn."""


@pytest.fixture(scope="module")
def pump(tmp_path_factory) -> Path:
    """The page of the pump, with that of the slotted lever beside it."""
    folder = tmp_path_factory.mktemp("board")
    for name in ("slotted-lever", "pump"):
        path = folder / f"{name}.html"
        path.write_text(step_page(load(name), "en"), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def moves() -> tuple[list[ScreenSheet], YourTurn, list[PaletteMove]]:
    """The sheets of the pump, its turn, and the moves of both plans in their order."""
    sheets = screen_sheets(load("pump"), "en")
    turn = your_turn(sheets, telling(sheets))
    own = sorted(turn.moves.values(), key=lambda move: (move.at, move.step))
    return sheets, turn, [move for move in own if move.at >= FROM]


def is_right(said: str) -> bool:
    """Whether that is the answer to a right move."""
    return "right." in said or EN("turn.say.complete") in said


def begun(opened: Opened, path: Path, step: int = FROM) -> Any:
    """A page on which the student draws from a step on."""
    return begun_at(opened, path.parent, path.stem, step)


def test_both_plans_of_the_pump_in_sixty_presses_of_the_mouse(opened: Opened, pump: Path, moves):
    """39 moves, each right at once: a drag from one thing to the next, a click on a crossing."""
    sheets, turn, own = moves
    page = begun(opened, pump)
    hand = DrawingHand(page, sheets, turn)
    hand.done |= {move.step for move in turn.moves.values() if move.at < FROM}
    counts = {}
    for move in own:
        assert is_right(hand.draw(move)), (move, hand.said)
        counts[move.at] = hand.presses
    assert page.locator("#turn-count").inner_text() == ""
    print(len(own), counts[11], hand.presses)
    assert counts[11] <= 13
    assert hand.presses <= 62


def test_both_plans_of_the_pump_in_250_keys(opened: Opened, pump: Path, moves):
    sheets, turn, own = moves
    page = begun(opened, pump)
    hand = TypingHand(page, sheets, turn)
    for move in own:
        assert is_right(hand.draw(move)), (move, hand.said)
    assert page.locator("#turn-count").inner_text() == ""
    print(sum(hand.presses), median(hand.presses), hand.presses)
    assert sum(hand.presses) <= 250
    assert median(hand.presses) <= 6


def test_a_digit_of_a_typed_line_is_no_choice(kept: Opened, pump: Path):
    """While a line is being written, 1 and 2 belong to it; on an empty line they choose."""
    page = begun(kept, pump)
    typed(page, "o vA")
    assert page.locator("#which button").count() == 2
    page.keyboard.type("A1")
    assert page.locator("#turn-typed").input_value() == "A1"
    assert page.locator("#which button").count() == 2
    page.keyboard.press("Backspace")
    page.keyboard.press("Backspace")
    page.keyboard.press("1")
    assert is_right(said(page))


GLASS = """() => {
  const box = document.querySelector(".magnifier"), { bottom } = box.getBoundingClientRect();
  const svg = box.firstChild, { x, y, width, height } = svg.viewBox.baseVal;
  const fields = document.querySelectorAll(".sheet:not([hidden]) .view:not(.magnifier) > svg");
  const own = fields[1].getScreenCTM();
  const { x: u, y: v } = new DOMPoint(x + width / 2, y + height / 2).matrixTransform(own);
  const count = what => box.querySelectorAll(what).length, times = svg.getScreenCTM().a / own.a;
  return { bottom, middle: [u, v], times, lit: count(".aims .lit"), ids: count("[id]") };
}"""
"""The lower edge of the magnifier, the place and the size that it shows, and what is lit in it."""


def test_a_held_finger_has_a_magnifier(kept: Opened, pump: Path):
    """Above the finger, about its place, with what would be taken; a tap or a mouse needs none."""
    page = begun_at(kept, pump.parent, pump.stem, FROM + 1, **PHONE)
    pole = page.locator(".sheet:not([hidden]) .view > svg circle.pole").bounding_box()
    at = {"x": pole["x"] + pole["width"] / 2, "y": pole["y"] + pole["height"] / 2}
    finger = page.context.new_cdp_session(page)

    def touch(kind: str, *points: dict[str, float]) -> None:
        finger.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": [*points]})

    glass = page.locator(".magnifier")
    touch("Start", at)
    glass.wait_for()
    for place in (at, {"x": at["x"] - 40, "y": at["y"] - 30}):
        touch("Move", place)
        page.evaluate(PAINTED)
        found = page.evaluate(GLASS)
        assert found["middle"] == pytest.approx([place["x"], place["y"]], abs=1.5)
        assert found["bottom"] < place["y"] - 20
        assert found["times"] == pytest.approx(2.5, rel=0.02)
        assert found["lit"] >= 1 and found["ids"] == 0
    touch("End")
    glass.wait_for(state="detached")
    touch("Start", at)
    touch("End")
    page.mouse.move(at["x"], at["y"])
    page.mouse.down()
    page.mouse.move(at["x"] + 30, at["y"])
    assert glass.count() == 0
    page.mouse.up()


# --- levels ---------------------------------------------------------------------------------------


SHORT = ("o vA", "1", "perp AB a", "O2Bo", "x", "sim abC", "perp CDc", "par o5", "x")
"""The velocity plan of the pump in the fewest moves: c by similarity, without its two lines."""
LONG = (*SHORT[:5], "perp AC a", "BC b", "x", *SHORT[6:])


def levels(page: Any) -> list[str]:
    """What is said of each level."""
    return [text.split(": ", 1)[1] for text in page.locator("#levels .unseen").all_inner_texts()]


def test_levels_count_moves_against_the_fewest_known(kept: Opened, pump: Path):
    page = begun(kept, pump)
    assert levels(page)[:2] == [
        "0 of 3 stars. Moves: 0; fewest known: 4.",
        "0 of 3 stars. Moves: 0; fewest known: 8.",
    ]
    assert typed(page, *SHORT[:5]).endswith("is complete: moves 4, fewest known 4.")
    typed(page, SHORT[5])
    assert "belong to one rigid link" in page.locator("#turn-sentence").inner_text()
    assert "both lines meet" not in page.locator("#turn-sentence").inner_text()
    assert typed(page, *SHORT[6:]).endswith("Velocity plan is complete: moves 8, fewest known 8.")
    assert levels(page)[:2] == [
        "3 of 3 stars. Moves: 4; fewest known: 4.",
        "3 of 3 stars. Moves: 8; fewest known: 8.",
    ]


def test_what_the_page_alone_has_drawn_earns_no_star(kept: Opened, pump: Path):
    page = begun(kept, pump)
    button = page.locator("#draw-it")
    while button.is_enabled() and not levels(page)[0].endswith("Moves: 4; fewest known: 4."):
        button.click()
    assert levels(page)[0] == "0 of 3 stars. Moves: 4; fewest known: 4."


def test_a_longer_way_and_a_wrong_turn_cost_a_star_each(kept: Opened, pump: Path):
    page = begun(kept, pump)
    typed(page, *LONG[:2], "par AB a", *LONG[2:])
    assert levels(page)[:2] == [
        "2 of 3 stars. Moves: 4; fewest known: 4.",
        "1 of 3 stars. Moves: 10; fewest known: 8.",
    ]


# --- taking back, and keeping ---------------------------------------------------------------------


def typed(page: Any, *lines: str) -> str:
    """Type some moves, and hear what the page says of the last."""
    for line in lines:
        page.keyboard.type(line)
        if not line.isdigit():  # a digit chooses one of two
            page.keyboard.press("Enter")
    return str(page.locator("#turn-say").inner_text())


def drawn(page: Any) -> str:
    """All that a turn has drawn and still seeks."""
    shown = page.evaluate("""() => [...document.querySelectorAll('.sheet:not([hidden]) [data-of]')]
        .filter(mark => mark.checkVisibility({ visibilityProperty: true }))
        .map(mark => mark.id).join()""")
    return f"{shown} {page.locator('#turn-count').inner_text()}"


def test_each_move_can_be_taken_back_and_drawn_again_also_after_a_reload(kept: Opened, pump: Path):
    page = begun(kept, pump, 6)
    states = [drawn(page)]
    for line in ("perp AB a", "perp O2B o", "x", "perp AC a"):
        assert "right." in typed(page, line)
        states.append(drawn(page))
    assert len({*states}) == len(states)
    undo, redo = page.locator("#turn-undo"), page.locator("#turn-redo")
    page.keyboard.press("Control+z")
    undo.click()
    assert drawn(page) == states[2]
    page.reload()
    assert drawn(page) == states[2]
    redo.click()
    assert drawn(page) == states[3]
    for state in states[2::-1]:
        undo.click()
        assert drawn(page) == state
    assert undo.is_disabled()
    page.keyboard.press("Control+y")
    assert drawn(page) == states[1]
    assert typed(page, "par o5").endswith("right.")
    assert redo.is_disabled()


def test_a_step_that_the_page_drew_stays_counted_when_it_is_taken_back(kept: Opened, pump: Path):
    page = begun(kept, pump, 6)
    page.locator("#draw-it").click()
    page.locator("#turn-undo").click()
    assert typed(page, "perp AB a").endswith("right.")
    page.locator("#turn-score").click()
    assert page.locator("#score li").all_inner_texts() == ["⊥ AB (a): drawn by the page"]


def test_what_a_click_would_take_is_lit_before(kept: Opened, pump: Path):
    """And what would come is dashed; nothing is taken by pointing."""
    page = begun(kept, pump, 6)
    before = drawn(page)
    page.locator("[data-action=perpendicular]").click()
    a, bar = (page.evaluate(PLACE, names) for names in (["a"], ["A", "B"]))
    page.mouse.move(*a)
    page.evaluate(PAINTED)
    assert page.locator(".aims .lit").count() == 1
    assert page.locator(".aims line.would").count() == 0
    page.mouse.click(*a)
    page.mouse.move(*bar)
    page.evaluate(PAINTED)
    page.locator(".aims line.would").wait_for(state="attached")
    assert page.locator(".aims text.would").text_content() == "⊥ AB (a)"
    assert drawn(page) == before
    page.mouse.move(3, 3)
    page.evaluate(PAINTED)
    assert page.locator(".aims > *").count() == 0


def test_a_drag_that_is_let_go_over_nothing_takes_nothing(kept: Opened, pump: Path):
    page = begun(kept, pump, 6)
    before = drawn(page)
    page.locator("[data-action=perpendicular]").click()
    x, y = page.evaluate(PLACE, ["a"])
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 90, y + 5, steps=3)
    page.evaluate(PAINTED)
    assert page.locator(".aims .band").count() == 1
    page.mouse.up()
    assert drawn(page) == before
    assert page.locator("#inputs select").first.input_value() == ""


PLACE = """letters => {
  const sheet = document.querySelector('.sheet:not([hidden])');
  const ends = letters.map(letter => {
    const { x, y, width, height } =
      [...sheet.querySelectorAll(`circle[data-name='${letter}']`)].at(-1).getBoundingClientRect();
    return [x + width / 2, y + height / 2];
  });
  return [0, 1].map(axis => ends.reduce((sum, end) => sum + end[axis], 0) / ends.length);
}"""
"""The middle of some points in the window."""


# --- wrong constructions --------------------------------------------------------------------------


WRONG = {
    "par o O1A": (5, [], "O1A keeps its length, so vA cannot lie along it", ""),
    "par o O2B": (6, ["perp O2B o"], "O2B keeps its length, so vB cannot", ""),
    "perp o'O1A": (18, [], "leaves out the normal component along O1A", ""),
    "par AB a": (6, ["perp O2B o"], "AB keeps its length", "AB would (stretch|shorten) by"),
    "perp AB o": (6, [], "right only where the other end of AB is at rest", "AB would"),
    "perp AC b": (8, [], "mirror image", "AC would (stretch|shorten) by"),
    "perp BC a": (8, [], "mirror image", "BC would (stretch|shorten) by"),
    "perp o5": (10, ["perp CD c"], "along its guide", "The block would leave its guide by"),
    "perp a'AB": (29, [], "leaves out the normal component", "AB would stretch by"),
    "par nBA AB": (29, ["a'aBAn", "1"], "perpendicular to AB, not along it", ""),
    "perp o'AB": (29, [], "right only where the other end of AB is at rest", "AB would"),
}
"""Wrong lines: the step at which each is drawn, the moves before it, its cause, its consequence."""


@pytest.mark.parametrize("line", WRONG)
def test_a_wrong_line_is_answered_with_what_would_come_of_it(opened: Opened, pump: Path, line: str):
    """In red on the drawing, until the next move, and without a word of what is not drawn."""
    step, before, cause, comes = WRONG[line]
    page = begun(opened, pump, step)
    typed(page, *before)
    known = drawn(page)
    said = typed(page, line)
    assert cause in said
    assert re.search(comes, said)
    assert page.locator(".sheet:not([hidden]) .halo line.wrong").count() == 1
    assert drawn(page) == known
    page.locator("#hint").click()
    assert page.locator(".halo .wrong").count() == 0


UNREAD = {
    "foo": "Nothing here is called “foo”.",
    "perp b' AB": "b′ is not drawn yet.",
    "sim a b C": "b is not drawn yet.",
    "perp o D": "The action cannot start from these. Perpendicular: through …, to …",
    "x": "Crossing: line or arc …, and …",
    "perp A CD": "What is sought now lies in another drawing: Velocity plan.",
    "par o AB": "o is the image of neither end of AB.",
    "par o CD": "o is the image of neither end of CD.",
}
"""Lines that draw nothing or lead nowhere at the second step of the plan, and what each lacks."""


def test_what_a_typed_line_lacks_is_named(kept: Opened, pump: Path):
    page = begun(kept, pump, 6)
    for line, lacks in UNREAD.items():
        assert typed(page, line).startswith(lacks)
        page.keyboard.press("Escape")
        assert page.locator("#turn-sentence").inner_text() == ""


def test_a_crossing_is_of_right_lines_before_ones_own(opened: Opened, pump: Path):
    """Also where a line of one's own, on which a normal component lies, is drawn between them."""
    page = begun(opened, pump, 29)
    assert typed(page, "par a'AB").endswith("nBA lies on it.")
    typed(page, "lay a'aBAn", "1", "perp nBA AB", "lay o'aBn", "1", "perp nB O2B")
    assert typed(page, "x").startswith("b′: right.")


def test_the_sheet_that_is_drawn_on_stays(kept: Opened, pump: Path):
    """A right move on the acceleration sheet keeps it, though the velocity sheet is not whole."""
    page = begun(kept, pump, 12)
    typed(page, "lay o'aA", "1", "tri B AB vBA")
    assert page.locator("#sheet-1").is_visible()


TURNED = {
    "pump": (29, "a'aBAn", "21", "The normal component points towards the centre of rotation."),
    "slotted-lever": (23, "a'aAA3c", "12", "The Coriolis component points as"),
}
"""Components laid off backwards: the step at which each is due, its line, digits, the answer."""


@pytest.mark.parametrize("name", TURNED)
def test_a_component_laid_off_backwards_is_answered(kept: Opened, pump: Path, name: str):
    step, line, (wrong, right), answer = TURNED[name]
    page = begun(kept, pump.with_stem(name), step)
    said = typed(page, line, wrong)
    assert "points the other way" in said
    assert answer in said
    assert typed(page, line, right).endswith("right.")


def test_coriolis_forgotten_is_answered(kept: Opened, pump: Path):
    page = begun(kept, pump.with_stem("slotted-lever"), 23)
    said = typed(page, "par a' guide 2")
    assert "leaves out the Coriolis component" in said
    assert re.search(r"The block would leave its guide by [\d.]+ m/s²\.$", said)
