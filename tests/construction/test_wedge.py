"""A wedge: a link that only slides, on two links that only slide themselves."""

from math import radians, tan

import pytest

from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text


@pytest.mark.parametrize("slope", [-40, 8, 20, 55])
def test_a_wedge_rises_by_the_slope_of_the_other(slope):
    """y = (x_G - x_A) tan β, and so its rates; nothing turns, so that C moves as B does."""
    mechanism = mechanism_of(scene_text("construction/wedge", slope=slope))
    solution = mechanism.solve()
    b, c, rise = solution.points["B"], solution.points["C"], tan(radians(slope))
    assert b.position == pytest.approx(0.15 + 1j * 0.11 * rise, rel=1e-14)
    assert b.velocity == pytest.approx(0.1j * rise, rel=1e-13)
    assert b.acceleration == pytest.approx(-0.03j * rise, rel=1e-13)
    assert (c.velocity, c.acceleration) == (b.velocity, b.acceleration)
    assert solution.links["2"].omega == 0
    assert mechanism.witness(solution).largest_difference <= 1e-13
