"""The QR square: what stands on the page is the symbol, white around it, and it can be read."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pypdfium2 as pdfium
import pytest
import zxingcpp as reader
from hypothesis import given, settings
from hypothesis import strategies as st

from graphkin.classroom.printing.personal import (
    SIDE,
    boxes,
    corners_of_text,
    corners_on,
    modules,
    overlap,
    rectangles,
    stamped,
)
from graphkin.drawing.field import A3, A4_AREA
from graphkin.drawing.frame import TitleBlock, page_frame, sheet_frame
from graphkin.drawing.marks import LineMark, Page, Polyline, Text, reach
from graphkin.writers.pdf import write_pdf

CODE = "TZHG6MXPZY"
GRID = st.lists(st.lists(st.booleans(), min_size=7, max_size=7), min_size=1, max_size=9)
SHEET = Page(420, 297, sheet_frame(TitleBlock(title="Task")))
A4 = Page(210, 297, page_frame(("a", "b"), ("c", "d")))


def cells(rows):
    return {(x, y) for y, row in enumerate(rows) for x, dark in enumerate(row) if dark}


@given(GRID)
def test_rectangles_cover_each_dark_module_once_and_nothing_else(rows):
    covered = [
        (x, y)
        for left, top, width, height in rectangles(rows)
        for x in range(left, left + width)
        for y in range(top, top + height)
    ]
    assert len(covered) == len(set(covered))
    assert set(covered) == cells(rows)


def test_ten_signs_of_base_32_take_the_smallest_symbol_at_its_best_correction():
    import segno

    rows = modules(CODE)
    assert len(rows) == 21
    again = segno.make(CODE, version=1, error="h", micro=False)
    assert tuple(tuple(map(bool, row)) for row in again.matrix) == rows


def stamp(page):
    """The box that what stamping added takes up."""
    added = stamped(page, CODE).marks[len(page.marks) :]
    lefts, tops, rights, bottoms = zip(*(reach(mark) for mark in added), strict=True)
    return min(lefts), min(tops), max(rights), max(bottoms)


@pytest.mark.parametrize("closed", [False, True])
def test_an_outline_takes_up_its_sides_and_nothing_within(closed):
    corners = ((0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 30.0))
    sides = [*pairwise(corners), *([(corners[3], corners[0])] * closed)]
    found = [*boxes(Polyline(corners, "ink", closed=closed))]
    assert found == [reach(LineMark(*one, *other, "ink")) for one, other in sides]
    assert not any(overlap(box, (10, 10, 30, 20)) for box in found)


@pytest.mark.parametrize(("page", "area"), [(SHEET, A3.area), (A4, A4_AREA)])
def test_four_modules_around_the_square_stay_white(page, area):
    left, top, right, bottom = stamp(page)
    margin = SIDE / 21 * 4  # ISO/IEC 18004, 6.3.8
    quiet = (left - margin, top - margin, right + margin, bottom + margin)
    assert not [m for m in page.marks for box in boxes(m) if overlap(quiet, box)]
    assert area[0] < quiet[0] and area[1] < quiet[1] and quiet[2] < area[2] and quiet[3] < area[3]
    assert (right - left, bottom - top) == (pytest.approx(SIDE), pytest.approx(SIDE))


@settings(max_examples=20)
@given(st.lists(st.tuples(st.floats(25, 195), st.floats(25, 270)), max_size=40))
def test_the_square_gives_way_to_what_stands_there_or_stays_away(places):
    texts = tuple(Text(x, y, "ab", "caption") for x, y in places if x < 185)
    page = Page(210, 297, (*A4.marks, *texts))
    added = stamped(page, CODE).marks[len(page.marks) :]
    for mark in added:
        assert not [m for m in texts if overlap(reach(mark), reach(m))]


def test_the_square_on_a_printed_page_can_be_read():
    data = write_pdf([stamped(SHEET, CODE)])
    document = pdfium.PdfDocument(data)
    picture = document[0].render(scale=150 / 72).to_numpy()
    document.close()
    (read,) = reader.read_barcodes(picture)
    assert read.text == CODE
    assert read.format == reader.BarcodeFormat.QRCode


def test_places_of_the_square_lie_4_mm_apart_in_all_the_room_there_is():
    """On A4 from the right upper corner down, on A3 from beside the title block up; each then
    further to the left, with its white margin and a millimetre within the area at first."""
    margin = 3.0
    beside = (*A3.below[:2], A3.title_block[0], A3.title_block[3])
    for places, area, down in (
        ([*corners_of_text(A4, margin)], A4_AREA, 4.0),
        ([*corners_on(A3, margin)], beside, -4.0),
    ):
        left, top, right, bottom = area
        columns = [*dict.fromkeys(x for x, _ in places)]
        rows = [y for x, y in places if x == columns[0]]
        assert places == [(x, y) for x in columns for y in rows]
        assert columns[0] == right - SIDE - margin - 1
        assert rows[0] == (top + margin + 1 if down > 0 else bottom - SIDE - margin - 1)
        assert np.diff(columns) == pytest.approx(-4.0) and np.diff(rows) == pytest.approx(down)
        assert left + margin < columns[-1] <= left + margin + 4
        if down > 0:
            assert bottom - SIDE - margin - 4 <= rows[-1] < bottom - SIDE - margin
        else:
            assert top + margin < rows[-1] <= top + margin + 4
