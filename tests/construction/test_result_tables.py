"""The tables of a sheet: within their field, what stands in a cell clear of its lines."""

from __future__ import annotations

import pytest

from graphkin.construction.result_tables import tables
from graphkin.drawing.areas import TABLES
from graphkin.drawing.marks import Text, reach
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawings

WHICH = [(name, None) for name in CHOSEN] + [("pump", n) for n in (1, 9)]


@pytest.mark.parametrize("empty", [False, True])
@pytest.mark.parametrize(("name", "n"), WHICH)
def test_tables_stand_within_their_field(name, n, empty):
    for drawing in drawings(name, n):
        for mark in tables(drawing, TABLES, empty=empty):
            left, top, right, bottom = reach(mark)
            assert TABLES[0] - 1e-6 <= left and TABLES[1] - 1e-6 <= top
            assert right <= TABLES[2] + 0.6 and bottom <= TABLES[3] + 1e-6


@pytest.mark.parametrize(("name", "n"), [("pump", 9), ("oscillating-slide", None)])
def test_signs_above_letters_keep_clear_of_the_lines_of_their_cell(name, n):
    _, drawing = drawings(name, n)
    marks = tables(drawing, TABLES, empty=False)
    ruled = [mark for mark in marks if mark.cls == "panel" and mark.y1 == mark.y2]
    raised = [m for m in marks if isinstance(m, Text) and "^" in m.markup and "_" in m.markup]
    assert raised
    for mark in raised:
        _, top, _, bottom = reach(mark)
        lines = [line.y1 for line in ruled if line.x1 < mark.x < line.x2]
        assert min(top - y for y in lines if y < mark.y) > 0.5
        assert min(y - bottom for y in lines if y > mark.y) > 0.5


def test_a_value_next_to_nothing_has_two_digits_and_leaves_the_lettering_large():
    _, drawing = drawings("stephenson-1", None)
    marks = [mark for mark in tables(drawing, TABLES, empty=False) if isinstance(mark, Text)]
    assert [mark.markup for mark in marks if "·10" in mark.markup] == ["1.1·10⁻⁸"]
    assert {mark.height for mark in marks if mark.name} == {2.5}
