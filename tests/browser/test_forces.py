"""The page of a scene's forces: it draws itself, and a student draws the polygons on it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from graphkin.mechanism import load
from graphkin.text import words
from graphkin.web.protocol import telling
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.web.step_page import force_sheet
from graphkin.web.your_turn import PaletteMove, YourTurn, your_turn
from tests.browser.drawing_hand import DrawingHand, TypingHand
from tests.browser.opening import Opened, barred
from tests.chosen import by_turns
from tests.running import Run

SCENES = Path(__file__).resolve().parents[1] / "scenes" / "forces"
NAMES = ("gas-engine", "four-bar", "ram")
EN = words("en")


def page_of(run: Run, folder: Path, name: str) -> Path:
    """The page of the forces of a scene, as a lecturer makes it."""
    told = ("--view", "key", "--format", "html", "--lang", "en")
    result = run("sheet", SCENES / f"{name}.toml", "-o", folder, *told)
    assert result.exit_code == 0, result.output
    return folder / f"{name}-force-key.html"


def turn_of(name: str) -> tuple[list[ScreenSheet], YourTurn, list[PaletteMove]]:
    """The sheet of forces of a scene, its turn, and its moves in their order."""
    sheets = [force_sheet(load(str(SCENES / f"{name}.toml")).spoken("en").measured, "en")]
    turn = your_turn(sheets, telling(sheets))
    return sheets, turn, sorted(turn.moves.values(), key=lambda move: (move.at, move.step))


@pytest.mark.parametrize("name", NAMES)
def test_the_polygons_of_forces_draw_themselves(
    opened: Opened, run: Run, tmp_path: Path, name: str
):
    page = opened(page_of(run, tmp_path, name), "#step=1", reduced_motion="reduce")
    sides = page.locator(".view svg .reaction:not(.later,.void,[data-aside])")
    before, count = sides.count(), page.locator("#steps li").count()
    page.keyboard.press("End")
    assert page.locator("#count").inner_text() == f"Step {count} of {count}"
    assert sides.count() > before
    assert not barred(page)


@pytest.mark.parametrize(("name", "hand"), by_turns(NAMES, [DrawingHand, TypingHand]))
def test_a_student_draws_every_polygon(
    opened: Opened, run: Run, tmp_path: Path, name: str, hand: Any
):
    """Each move is right at once, by mouse and by keys, in the place of its own polygon."""
    sheets, turn, moves = turn_of(name)
    page = opened(page_of(run, tmp_path, name), f"#step={moves[0].at - 1}")
    page.locator("#turn").click()
    own = hand(page, sheets, turn)
    assert {pick.name for pick in turn.picks.values() if pick.kind == "vector"} == {
        turn.picks[move.inputs[1]].name for move in moves if move.action == "lay_off"
    }
    for move in moves:
        said = own.draw(move)
        assert "right." in said or EN("turn.say.complete") in said, (move, said)
    assert page.locator("#turn-count").inner_text() == ""


def test_a_wrong_side_of_a_polygon_is_answered(opened: Opened, run: Run, tmp_path: Path):
    """A reaction across the bar along which it acts, and a block pressed along its guide."""
    sheets, turn, moves = turn_of("gas-engine")
    page = opened(page_of(run, tmp_path, "gas-engine"), "#step=7")
    page.locator("#turn").click()
    hand = TypingHand(page, sheets, turn)
    for move in moves:
        wrong = turn.errors.get(move.step, ())
        for key, action, inputs in wrong:
            other = replace(move, action=action, inputs=inputs)
            said = hand.by_pointer(other)
            assert said.startswith(EN.sentences[key].partition("{")[0]), (other, said)
        assert len(wrong) == (move.action in ("parallel", "perpendicular"))
        hand.draw(move)
