"""Names of eight letters and more, and names with an index of their own."""

import pytest

from graphkin.construction.result_tables import tables
from graphkin.documents.calculation import calculation
from graphkin.documents.sheet import sheet
from graphkin.drawing.areas import TABLES
from graphkin.drawing.marks import Text
from graphkin.drawing.symbol_markup import symbol
from graphkin.text.errors import PageError
from tests.chosen import SPOKEN
from tests.documents.full_scenes import NAMED, drawings_from
from tests.documents.sheet_tools import collisions, outside
from tests.documents.test_full_tables import cut

LONG = NAMED.format(crank="Crankpin", rocker="Rockerpin")
INDEXED = NAMED.format(crank="B12", rocker="Q_left")
LONGER = NAMED.format(crank="Crank_pin_moving", rocker="Rocker_pin_moving")


@pytest.mark.parametrize("language", SPOKEN)
@pytest.mark.parametrize("text", [LONG, LONGER], ids=["long", "longer"])
def test_long_names_cross_no_line_of_a_table(text, language):
    for drawing in drawings_from(text, language):
        assert not cut(tables(drawing, TABLES, empty=False))
        page = sheet(drawing, "key", "1/2")
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
    page = sheet(drawing, "key", "1/2")
    labels = {m.markup for m in page.marks if isinstance(m, Text) and m.cls.startswith("label")}
    assert {symbol(f"Q{prime}_Q_left") for prime in "″‴⁗"} <= labels
    assert {symbol(f"Q{prime}_Q_leftB12") for prime in "″‴⁗"} <= labels
    assert symbol("Q⁗_Q_left") == r"*Q*_{Q\_left}^{IV}"
    assert all("⁗" not in m.markup for m in page.marks if isinstance(m, Text))
