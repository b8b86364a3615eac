"""Where vectors lie along one another, each name stands where no other covers its vector."""

import pytest

from graphkin.drawing.labels import Label, at_bare_stretches
from graphkin.drawing.marks import CircleMark, LineMark
from graphkin.drawing.symbol_markup import symbol
from tests.documents.sheet_tools import drawn


def along(name: str, low: float, high: float, aside: float = 0.0) -> LineMark:
    """A vector from one distance to another on a slanting line, or so far aside of it, in mm."""
    ends = [(0.6 * at - 0.8 * aside, 0.8 * at + 0.6 * aside) for at in (low, high)]
    return LineMark(*ends[0], *ends[1], "velocity", name)


def stretch(own: LineMark, *others: LineMark) -> tuple[float, float]:
    """From where to where on its line the name of a vector stands, beside some others."""
    label = Label("v", "velocity", ((own.x1, own.y1), (own.x2, own.y2)), name=own.name)
    (found,) = at_bare_stretches([label], [own, *others])
    first, last = found.subject
    return tuple(0.6 * x + 0.8 * y for x, y in (first, last))


@pytest.mark.parametrize(
    ("others", "expected"),
    [
        ([], (0, 100)),
        ([along("b", 0, 55)], (55, 100)),  # o to b₁ on the way from o to a
        ([along("b", 40, 130)], (0, 40)),
        ([along("b", 20, 40), along("c", 35, 60)], (60, 100)),
        ([along("b", 60, 30)], (60, 100)),  # it points the other way
        ([along("b", 0, 100)], (0, 100)),  # nothing is bare
        ([along("b", 0, 100), along("c", 0, 55)], (55, 100)),  # two names stand at one stretch
        ([along("b", 0, 95)], (0, 100)),  # too little is
        ([along("b", 0, 55, aside=2)], (0, 100)),  # it lies beside
        ([along("b", -30, 0)], (0, 100)),  # it ends where this one begins
    ],
    ids=str,
)
def test_the_name_stands_at_the_longest_stretch_that_is_bare(others, expected):
    assert stretch(along("a", 0, 100), *others) == pytest.approx(expected, abs=1e-9)


def test_on_the_cam_at_rest_the_speed_of_the_arm_is_named_beyond_that_below_the_roller():
    page = drawn("cam-fixed", None, "velocity")
    circles = [mark for mark in page.marks["plan"] if isinstance(mark, CircleMark)]
    under, tip = (next(m.cx for m in circles if m.name == name) for name in ("b_1", "a"))
    label = next(x.text for x in page.labels("plan") if x.text.markup == symbol("v_A"))
    assert min(under, tip) < label.x < max(under, tip)
