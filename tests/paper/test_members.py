"""A task says what the links are, so that it can be drawn without a figure."""

from __future__ import annotations

import pytest

from graphkin.handout import drawings_of, hand_out, language_of, proved
from graphkin.paper.members import members
from graphkin.paper.richtext import plain
from graphkin.scaling import shown
from tests.paper.sheet_tools import mechanism_named, texts

LABS = ("pump", "slotted-lever")


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("pump", "Links: 1 = O1A, 2 = O2B, 3 = ABC, 4 = CD, 5 = block D"),
        ("slotted-lever", "Links: 1 = O1A, 2 = block A, 3 = O2B, 4 = BC, 5 = block C"),
        ("gears-ring", "Links: 1 = OP, 2 = wheel PQ, 3 = wheel OS"),
    ],
)
def test_links_are_told_by_their_points(name, told):
    mechanism = mechanism_named(name, 7) if name in LABS else mechanism_named(name)
    verdict = proved(mechanism, shown(mechanism))
    drawing = drawings_of(mechanism, verdict, language_of(mechanism, "en"))[0]
    assert plain(members(drawing)) == told


def test_a_task_tells_them_and_a_key_need_not():
    for view, times in (("task", 1), ("key", 0)):
        pages = hand_out(mechanism_named("pump", 7), view, "en")[0].pages
        assert sum("Links:" in text.markup for text in texts(pages)) == times
