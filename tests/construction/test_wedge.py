"""A wedge: a link that only slides, on two links that only slide themselves."""

from math import radians, tan

import pytest

from tests.mechanisms import mechanism_of

WEDGE = """
[frame]
O = [0, 0]
G = [0.15, 0]
[links.1]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[links.2]
B = [0, 0]
C = [0.02, 0.01]
slides = [{{ on = 0, through = "G", angle = 90 }}, {{ on = 1, through = "A", angle = {slope} }}]
[[drivers]]
slide = 1
position = 0.04
speed = -0.1
acceleration = 0.03
"""


@pytest.mark.parametrize("slope", [-40, 8, 20, 55])
def test_a_wedge_rises_by_the_slope_of_the_other(slope):
    """y = (x_G - x_A) tan β, and so its rates; nothing turns, so that C moves as B does."""
    mechanism = mechanism_of(WEDGE.format(slope=slope))
    solution = mechanism.solve()
    b, c, rise = solution.points["B"], solution.points["C"], tan(radians(slope))
    assert b.position == pytest.approx(0.15 + 1j * 0.11 * rise, rel=1e-14)
    assert b.velocity == pytest.approx(0.1j * rise, rel=1e-13)
    assert b.acceleration == pytest.approx(-0.03j * rise, rel=1e-13)
    assert (c.velocity, c.acceleration) == (b.velocity, b.acceleration)
    assert solution.links["2"].omega == 0
    assert mechanism.witness(solution).largest_difference <= 1e-13
