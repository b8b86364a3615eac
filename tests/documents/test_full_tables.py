"""Tables of many rows fit above the title block, or one line tells why none do."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from msgspec.structs import replace

from graphkin.construction.result_tables import (
    slide_rows,
    tables_on_sheets,
    turning_rows,
    vector_rows,
)
from graphkin.documents.calculation import calculation
from graphkin.documents.sheet import Moved, sheet, writing
from graphkin.documents.sheet_documents import drawn_sheets
from graphkin.drawing.columns import ColumnTable, Look, laid_out
from graphkin.drawing.field import A3
from graphkin.drawing.marks import LineMark, Mark, Polyline, Text, reach
from graphkin.drawing.symbol_markup import symbol
from graphkin.text import words
from graphkin.text.errors import PageError
from graphkin.text.tables import Row
from tests.chosen import SPOKEN
from tests.documents.full_scenes import DYADS, NAMED, STAR, drawings_from
from tests.documents.sheet_tools import collisions, drawings, outside

FULL = {"star": STAR, "dyads": DYADS}


def cut(marks: list[Mark]) -> list[str]:
    """Texts that a line of their table crosses."""
    lines = [shapely.LineString([(m.x1, m.y1), (m.x2, m.y2)]) for m in marks if type(m) is LineMark]
    return [
        mark.markup
        for mark in marks
        if isinstance(mark, Text) and any(shapely.box(*reach(mark)).intersects(x) for x in lines)
    ]


@pytest.mark.parametrize(
    ("name", "language", "empty"),
    [("star", "ro", False), ("star", "en", True), ("dyads", "it", False), ("dyads", "ro", True)],
)
def test_long_tables_stand_in_their_place_with_every_row(name, language, empty):
    """On as many sheets as rows with letters of 2.5 mm need."""
    place = (A3.fields[0], A3.fields[1], A3.fields[2], A3.tables[3])
    for drawing in drawings_from(FULL[name], language):
        sheets = tables_on_sheets(drawing, place, place, empty=empty)
        for own in sheets:
            boxes = [reach(mark) for mark in own]
            assert min(box[0] for box in boxes) >= place[0] - 0.2
            assert max(box[2] for box in boxes) <= place[2] + 0.2
            assert max(box[3] for box in boxes) <= place[3] + 0.2
            assert not cut(own)
        marks = [mark for own in sheets for mark in own]
        assert {mark.height for mark in marks if isinstance(mark, Text)} == {2.5}
        rows = [f(drawing, empty=empty) for f in (vector_rows, turning_rows, slide_rows)]
        shown = [mark.name for mark in marks if isinstance(mark, Text)]
        assert {row.name for some in rows for row in some} <= {*shown}


def test_a_table_that_nothing_makes_fit_is_refused_in_one_line():
    rows = tuple(Row((f"*v*_{i}", "", "1,00", "2,000"), f"v_{i}") for i in range(100))
    with pytest.raises(PageError) as caught:
        laid_out([ColumnTable((13, 13, 13, 13), Row(("a", "b", "mm", "m/s")), rows)], A3.tables)
    assert str(caught.value) == (
        "tables: does not fit: 100 rows are too many for the 178 mm above the title block; "
        "expected fewer rows; "
        "ask for fewer velocities, accelerations or links on one sheet, or split the scene"
    )


def test_a_name_too_long_for_every_table_is_told():
    name = "Q" * 120
    rows = (Row((f"*v*_{{{name}}}", "", "1,00", "2,000"), f"v_{name}"),)
    with pytest.raises(PageError, match=r"does not fit: v_Q+ is [0-9]+ mm long in the smallest"):
        laid_out([ColumnTable((13, 13, 13, 13), Row(("a", "b", "mm", "m/s")), rows)], A3.tables)


def test_a_row_has_room_for_the_indices_of_its_letters():
    table = ColumnTable((20.0,), Row(("a",)), rows := (Row(("*v*_{D}",)),), rows)
    assert table.fits(Look(4.7, 3.2, 1.0)) and not table.fits(Look(4.7, 4.2, 1.0))


def test_rows_to_fill_in_are_seven_millimetres_high_on_every_sheet():
    """What does not fit at that height goes to another sheet."""
    for name, n in (("pump", 7), ("watt-1", None)):
        for document in drawn_sheets(drawings(name, n), "task"):
            marks = [mark for page in document.pages for mark in page.marks]
            cells = sorted((m.y, m.name) for m in marks if isinstance(m, Text) and m.cls == "table")
            rows = sorted({y for y, name in cells if name[:2] in ("v_", "a_")})
            assert len(rows) > 3
            assert min(low - high for high, low in pairwise(rows)) >= 7 - 1e-9


@pytest.mark.parametrize("wished", [1.0, *np.arange(8.0, 13.0, 0.25), 20.0])
def test_texts_stand_clear_of_the_lines_between_columns(wished):
    """By 0.7 mm at least, whatever widths are wished; what is left of these is shared evenly."""
    rows = tuple(Row(texts) for texts in (("*v*_{D}", "12,345", "3"), ("n", "–1·10^{–3}", "44")))
    table = ColumnTable((wished,) * 3, Row(("vector", "mm", "m/s")), rows, rows)
    marks = table.marks(10.0, 10.0, Look(9.0, 6.0, 1.0))
    rules = sorted({m.x1 for m in marks if isinstance(m, LineMark) and m.x1 == m.x2})
    texts = [reach(mark) for mark in marks if isinstance(mark, Text)]
    free = []
    for left, right in pairwise(rules):
        inside = [box for box in texts if left < (box[0] + box[2]) / 2 < right]
        assert len(inside) == 3
        free.append(min(min(box[0] - left, right - box[2]) for box in inside))
    assert min(free) >= 0.69
    needed = right - rules[0] - 2 * sum(free)
    if 3 * wished > needed + 4.2:
        assert rules[-1] - rules[0] == pytest.approx(3 * wished)


# --- Names of eight letters and more, and names with an index of their own -----------------------


LONG = NAMED.format(crank="Crankpin", rocker="Rockerpin")
INDEXED = NAMED.format(crank="B12", rocker="Q_left")
LONGER = NAMED.format(crank="Crank_pin_moving", rocker="Rocker_pin_moving")


@pytest.mark.parametrize("language", SPOKEN)
@pytest.mark.parametrize("text", [LONG, LONGER], ids=["long", "longer"])
def test_long_names_cross_no_line_of_a_table(text, language):
    for drawing in drawings_from(text, language):
        for marks in tables_on_sheets(drawing, A3.fields, A3.fields, empty=False):
            assert not cut(marks)
        page = sheet(drawing, "key", "1/2")[0]
        page.check()
        assert not collisions(page.marks)
        assert not outside(page.marks)


def test_a_name_too_long_to_be_drawn_is_told_in_one_line():
    drawings = drawings_from(NAMED.format(crank="C" * 40, rocker="R" * 40))
    told = "does not fit: C{40}R{40} =; expected a shorter relation; shorten the names"
    with pytest.raises(PageError, match=told):
        calculation(drawings, "key")


def test_the_letters_of_a_triangle_leave_the_index_of_a_point_to_their_own():
    """Beside Q with the index left stand Q″, Q‴ and the fourth with its numeral, as beside B2."""
    _, drawing = drawings_from(INDEXED)
    page = sheet(drawing, "key", "1/2")[0]
    labels = {m.markup for m in page.marks if isinstance(m, Text) and m.cls.startswith("label")}
    own = {symbol(f"Q{prime}_{of}") for prime in "″‴⁗" for of in ("Q_left", "Q_leftB12")}
    assert len(own & labels) >= 5  # one has no place near its point
    assert symbol("Q⁗_Q_left") == r"*Q*_{Q\_left}^{IV}"
    assert all("⁗" not in m.markup for m in page.marks if isinstance(m, Text))


@pytest.mark.parametrize(
    ("name", "language"),
    [("shaper", "fr"), ("watt-1", "ru"), ("six-bar", "ru"), ("rapid-return-slider", "ru")],
)
def test_tables_take_width_of_the_sentences_before_they_leave_a_key(name, language):
    for drawing in drawings(name, None):
        told = replace(drawing, words=words(language))
        written = writing(told, "key")
        assert Moved.TABLES not in written.moved
        boxes = [reach(m) for m in written.foot if reach(m)[1] < A3.tables[3]]
        shades = [reach(m) for m in written.foot if isinstance(m, Polyline) and m.cls == "shade"]
        edge = min(box[0] for box in shades)
        assert all(box[2] < edge for box in boxes if box[0] < edge - 1)
