"""The list of sentences: as far apart as there is room, no signs of its lines touch."""

from __future__ import annotations

from itertools import pairwise

import pytest

from graphkin.documents import listing
from graphkin.documents.listing import listed
from graphkin.documents.sheet import sheet_heading
from graphkin.drawing.field import A3
from graphkin.drawing.richtext import are_clear, extent
from graphkin.text.errors import PageError
from tests.documents.sheet_tools import drawings

LEFT, TOP, BOTTOM = A3.below[0] + 2, A3.below[1] + 10.5, A3.below[3] - 3.5


def list_of(drawing):
    return listed(drawing, LEFT, TOP, A3.tables[0] - LEFT - 5, BOTTOM)


@pytest.mark.parametrize(("kind", "least"), [(0, 5.6), (1, 4.5)])
def test_where_there_is_room_lines_stand_farther_apart(kind, least):
    rows = sorted({mark.y for mark in list_of(drawings("pump", 3)[kind])})
    assert rows[1] - rows[0] >= least - 1e-9


def test_lines_that_would_touch_are_not_clear_of_each_other():
    assert are_clear(["o _{p}", "o ^{2}"], 2.5, 5.6)
    assert not are_clear(["o _{p}", "o ^{2}"], 2.5, 4.0)
    assert are_clear(["o _{p} o o", "o o o o ^{2}"], 2.5, 4.0)


def test_lines_of_long_data_stand_apart():
    """An index of one line is no stroke over a capital of the next."""
    (drawing, *_) = drawings("plates-coupled")
    found = (mark for mark in sheet_heading(drawing)[0] if mark.name == "data")
    data = [mark for mark in found if mark.cls != "table"]
    assert len(data) > 2
    for above, below in pairwise(data):
        foot = above.y + extent("*O*_{1}", above.height)[2]
        assert below.y + extent("T", below.height)[1] - foot > 0.1


def test_lines_whose_signs_touch_go_to_another_sheet(monkeypatch):
    (drawing, _) = drawings("pump", 3)
    assert {mark.height for mark in list_of(drawing)} == {listing.HEIGHT}
    monkeypatch.setattr(listing, "are_clear", lambda *_: False)
    with pytest.raises(PageError):
        list_of(drawing)
