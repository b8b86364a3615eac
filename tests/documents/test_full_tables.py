"""Tables of many rows fit above the title block, or one line tells why none do."""

from itertools import pairwise

import numpy as np
import pytest
import shapely

from graphkin.construction.result_tables import slide_rows, tables, turning_rows, vector_rows
from graphkin.documents.calculation import calculation
from graphkin.documents.sheet import sheet
from graphkin.drawing.columns import HEIGHT, SMALL, ColumnTable, Look, laid_out
from graphkin.drawing.field import A3
from graphkin.drawing.marks import LineMark, Mark, Text, reach
from graphkin.drawing.symbol_markup import symbol
from graphkin.text.errors import PageError
from graphkin.text.tables import Row
from tests.chosen import SPOKEN
from tests.documents.full_scenes import DYADS, NAMED, STAR, drawings_from
from tests.documents.sheet_tools import collisions, outside

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
def test_long_tables_stand_above_the_title_block_with_every_row(name, language, empty):
    for drawing in drawings_from(FULL[name], language):
        marks = tables(drawing, A3.tables, empty=empty)
        boxes = [reach(mark) for mark in marks]
        assert min(box[0] for box in boxes) >= A3.tables[0] - 0.2
        assert max(box[2] for box in boxes) <= A3.tables[2] + 0.2
        assert max(box[3] for box in boxes) <= A3.tables[3] + 0.2
        assert not cut(marks)
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


@pytest.mark.parametrize("spare", [0.0, 0.2, -0.2])
def test_letters_are_large_where_the_widest_text_fits_its_column(spare):
    """With 0.7 mm to both sides and no more; where there is less they are small."""
    for text in ("3,8", "12,345", "*v*_{D}", "1·10^{–3}"):
        table = ColumnTable((1.0,), Row(("a",)), rows := (Row((text,)),), rows)
        width = table.breadth(0, HEIGHT) + 1.4 + spare
        assert table.letters(Look(9.0, 3.0, 1.0), [width]) == (HEIGHT if spare >= 0 else SMALL)


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
        assert not cut(tables(drawing, A3.tables, empty=False))
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
    assert {symbol(f"Q{prime}_Q_left") for prime in "″‴⁗"} <= labels
    assert {symbol(f"Q{prime}_Q_leftB12") for prime in "″‴⁗"} <= labels
    assert symbol("Q⁗_Q_left") == r"*Q*_{Q\_left}^{IV}"
    assert all("⁗" not in m.markup for m in page.marks if isinstance(m, Text))
