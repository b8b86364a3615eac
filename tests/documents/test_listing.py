"""The list of sentences: as far apart as there is room, no signs of its lines touch."""

from __future__ import annotations

from itertools import pairwise

import pytest

from graphkin.documents import listing
from graphkin.documents.listing import listed
from graphkin.documents.sheet import heading
from graphkin.drawing.areas import BELOW, MARKED, TABLES
from graphkin.drawing.glyphs import advance, ink
from graphkin.drawing.richtext import are_clear, extent, laid
from graphkin.text import LANGUAGES
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawings

WHICH = [(name, None) for name in CHOSEN] + [("pump", n) for n in (3, 28)]
LEFT, TOP, BOTTOM = BELOW[0] + 2, BELOW[1] + 10.5, BELOW[3] - 3.5


def list_of(drawing):
    return listed(drawing, LEFT, TOP, TABLES[0] - LEFT - 5, BOTTOM)


def inked(mark):
    """The box of each sign of a text on the page."""
    for run in laid(mark.markup, mark.height)[0]:
        x = mark.x + run.x
        for sign in run.text:
            wide, found = advance(sign, run.italic) * run.size, ink(sign, run.italic)
            if found:
                low, high = (mark.y + run.y - end * run.size for end in found)
                yield x, x + wide, high, low
            x += wide


def touching(above, below):
    return [
        (one, other)
        for one in inked(above)
        for other in inked(below)
        if one[0] < other[1] and other[0] < one[1] and one[3] > other[2]
    ]


@pytest.mark.parametrize(("name", "n"), WHICH)
def test_no_sign_of_a_line_touches_one_of_the_next(name, n):
    for drawing in drawings(name, n, LANGUAGES[len(name) % 3]):
        said = [mark for mark in list_of(drawing) if mark.anchor == "start"]
        for above, below in pairwise(said):
            assert not touching(above, below), (above.markup, below.markup)
        data = [mark for mark in heading(drawing) if mark.name == "data"]
        for above, below in pairwise(data):
            assert not touching(above, below), (above.markup, below.markup)


@pytest.mark.parametrize(("name", "n"), WHICH)
def test_lines_of_the_list_keep_clear_of_the_centring_mark(name, n):
    for drawing in drawings(name, n):
        for mark in list_of(drawing):
            assert mark.y <= BOTTOM + 1e-9
            if mark.anchor == "start" and mark.y > MARKED[1]:
                assert mark.x + extent(mark.markup, mark.height)[0] <= MARKED[0] + 1e-9


@pytest.mark.parametrize(("kind", "least"), [(0, 5.6), (1, 4.5)])
def test_where_there_is_room_lines_stand_farther_apart(kind, least):
    rows = sorted({mark.y for mark in list_of(drawings("pump", 3)[kind])})
    assert rows[1] - rows[0] >= least - 1e-9


def test_lines_that_would_touch_are_not_clear_of_each_other():
    assert are_clear(["o _{p}", "o ^{2}"], 2.5, 5.6)
    assert not are_clear(["o _{p}", "o ^{2}"], 2.5, 4.0)
    assert are_clear(["o _{p} o o", "o o o o ^{2}"], 2.5, 4.0)


def test_lines_of_small_data_stand_apart():
    """An index of one line is no stroke over a capital of the next."""
    (drawing, *_) = drawings("gears-rack")
    data = [mark for mark in heading(drawing) if mark.name == "data"]
    assert {mark.height for mark in data} == {1.8}
    for above, below in pairwise(data):
        foot = above.y + extent("*O*_{1}", above.height)[2]
        assert below.y + extent("T", below.height)[1] - foot > 0.7


def test_small_lines_stay_where_even_their_signs_touch(monkeypatch):
    (drawing, _) = drawings("pump", 3)
    monkeypatch.setattr(listing, "are_clear", lambda *_: False)
    assert {mark.height for mark in list_of(drawing)} == {listing.LOOKS[-1][0]}
