"""Wrong lines of the slotted lever's acceleration plan, named from the log of a drawing."""

from __future__ import annotations

import pytest

from graphkin.accuracy.pencil import Pencil
from graphkin.construction.board import board_given, replayed
from graphkin.mechanism import load
from graphkin.reading.board_drawing import NOWHERE, JudgedSheet, judged
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.text import words
from graphkin.web.screen_sheets import screen_sheets
from tests.web.drawn_logs import LEVER

EN = words("en")
WRONG = {
    "coriolis_forgotten": ("par 30 4", "par 24 4"),
    "coriolis_turned": ("lay 24 29 /1", "lay 24 29"),
    "normal_forgotten": ("perp 27 O2-A", "perp 2: O2-A"),
    "normal_turned": ("lay 2: 26", "lay 2: 26 /1"),
}
"""The key of each sentence, a move of the right drawing, and the wrong move in its place."""


def sheets(log: str) -> list[JudgedSheet]:
    """The judged sheets of a drawing of the lab with its own data."""
    drawings = [
        each.drawing for each in screen_sheets(load("slotted-lever").measured, "en", "task")
    ]
    board = replayed(board_given(drawings), log)
    return [judged(LetteredSheet(each, NOWHERE), board, Pencil()) for each in drawings]


@pytest.mark.parametrize("key", WRONG)
def test_a_wrong_line_is_named_once_at_the_point_found_on_it(key: str):
    """What follows from that point is not wrong, and a line is named by one mistake alone."""
    log = LEVER.replace(*WRONG[key])
    assert log != LEVER
    velocities, accelerations = sheets(log)
    assert not velocities.whys
    [(step, said)] = accelerations.whys.items()
    wrong = [point.step for point in accelerations.points if point.verdict == "wrong"]
    assert wrong == [step]
    along = EN.sentences[f"turn.wrong.{key}"].partition("{along}")[0]
    assert len(said) == 1 and said[0].startswith(along)


def test_a_right_drawing_has_no_wrong_line():
    assert not any(each.whys for each in sheets(LEVER))
