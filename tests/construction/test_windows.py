"""Where a trial can be drawn: windows narrower than the grid, and places close to their ends."""

import cmath

import numpy as np
import pytest

from graphkin.construction.higher_class.trial import (
    Windows,
    arcs_reach,
    line_reached,
    narrowed,
    swing_reached,
)
from graphkin.construction.links.counted_turn import counted_near
from graphkin.numbers.plane import Circle, Line, circle_meets_circle, line_meets_circle
from graphkin.numbers.roots import roots

GRID = np.linspace(0, 10, 101)[None, :]


def parts(reaches):
    """The windows of one function on the grid."""
    return narrowed(lambda _, place: reaches(place), Windows(np.array([0]), GRID))


@pytest.mark.parametrize("width", [1.0, 1e-2, 1e-4])
def test_a_window_narrower_than_the_grid_is_found_from_end_to_end(width):
    found = parts(lambda x: (width / 2) ** 2 - (x - 3.14) ** 2)
    assert found.places[:, [0, -1]] == pytest.approx(
        np.array([[3.14 - width / 2, 3.14 + width / 2]]), abs=1e-9 * max(width, 1e-3)
    )


def test_what_can_be_drawn_everywhere_keeps_its_grid():
    assert parts(lambda x: x + 1).places == pytest.approx(GRID)


def test_what_can_be_drawn_nowhere_has_no_window():
    assert len(parts(lambda x: -x - 1).owner) == 0


def test_a_root_close_beside_the_end_of_a_window_is_found():
    """sqrt(x - 3.141) - 1e-4 vanishes 1e-8 after the place where it begins."""
    windows = parts(lambda x: x - 3.141)
    with np.errstate(invalid="ignore"):
        _, place = roots(lambda _, x: np.sqrt(x - 3.141) - 1e-4, windows.places)
    assert place == pytest.approx([3.141 + 1e-8], abs=1e-13)


@pytest.mark.parametrize("radius", [0.4, 0.6, 1.9, 2.1, 3.4, 3.6])
def test_arcs_reach_each_other_just_where_they_meet(radius):
    m, n = Circle(0j, radius), Circle(2 + 0j, 1.5)
    assert (arcs_reach(m, n) > 0) == meets(circle_meets_circle, m, n, 1)


@pytest.mark.parametrize("height", [-2.1, -1.9, 0.0, 1.9, 2.1])
def test_an_arc_reaches_a_line_just_where_it_cuts_it(height):
    line, circle = Line(height * 1j, 3 + 0j), Circle(1 + 0j, 2.0)
    assert (line_reached(line, circle) > 0) == meets(line_meets_circle, line, circle, 1)


def test_a_pin_nearer_than_the_height_of_its_guide_is_not_reached():
    assert swing_reached(0j, 3 + 4j, 4.9) > 0 > swing_reached(0j, 3 + 4j, -5.1)


def meets(draw, *args):
    """Whether something can be drawn."""
    try:
        draw(*args)
    except ValueError:
        return False
    return True


@pytest.mark.parametrize("off", [0.0, 1e-16, -1e-16, 1e-12, -1e-12])
def test_half_a_turn_is_ahead_whatever_rounding_says(off):
    """The whole turns of wheels are counted from it."""
    axis = cmath.rect(1, cmath.pi) * complex(1, off)
    assert counted_near(axis, 1 + 0j, 0.0) == pytest.approx(cmath.pi)
    assert counted_near(np.array([axis]), 1 + 0j, 0.0) == pytest.approx(cmath.pi)
