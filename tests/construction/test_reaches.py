"""How far what an action draws can be drawn: the signs of its factors say whether it can."""

import cmath

import numpy as np
import pytest

from graphkin.construction.guides.swung_guide import swing
from graphkin.construction.links.dyad_by_arcs import arc_cuts_line, arcs_meet
from graphkin.construction.links.rolled_turn import counted_near
from graphkin.numbers.plane import Circle, Line


@pytest.mark.parametrize("radius", [0.4, 0.6, 1.9, 2.1, 3.4, 3.6])
def test_arcs_reach_each_other_just_where_they_meet(radius):
    m, n = Circle(0j, radius), Circle(2 + 0j, 1.5)
    assert (min(arcs_meet.reaches(m, n)) > 0) == is_drawn(arcs_meet, m, n, 1)


@pytest.mark.parametrize("height", [-2.1, -1.9, 0.0, 1.9, 2.1])
def test_an_arc_reaches_a_line_just_where_it_cuts_it(height):
    line, circle = Line(height * 1j, 3 + 0j), Circle(1 + 0j, 2.0)
    assert (min(arc_cuts_line.reaches(line, circle)) > 0) == is_drawn(
        arc_cuts_line, line, circle, 1
    )


def test_a_pin_nearer_than_the_height_of_its_guide_is_not_reached():
    for height in (4.9, -4.9, 5.1, -5.1):
        guide = 0j, 3 + 4j, height
        assert (min(swing.reaches(*guide)) > 0) == is_drawn(swing, *guide, 1, 1.0)


def is_drawn(draw, *args):
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
