"""What other programs are known to get wrong, one test for each failure.

A slider-crank in line divides by zero; angles by the arc cosine lose half their digits at 180°;
positions found each from the last drift away. (Tolerances that are lengths: see test_sizes.py.)
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.motion.cycle import cycle
from tests.stress.cases import FourBar, SliderCrank, assert_near, assert_within, held, held_batch
from tests.stress.closed import EPS


def test_the_slider_crank_in_line_goes_round():
    """A whole turn through both places in line: every row there, and none of them NaN."""
    found = cycle(SliderCrank().mechanism())
    assert found.path.whole and found.path.returns and not found.singulars
    assert len(found.at) == 360 and not len(found.left_out)
    assert found.witnessed.agrees.all()
    held_batch(SliderCrank(), np.arange(0.0, 360.0, 15.0))


@pytest.mark.parametrize("case", [FourBar(), SliderCrank(), SliderCrank(bars=("1", "3", "1/2"))])
@pytest.mark.parametrize("beside", [0, 4, 8, 12, 16])
@pytest.mark.parametrize("sign", [1, -1])
def test_no_digit_is_lost_at_180_degrees(case, beside, sign):
    """The arc cosine of -1 + 1e-16 is wrong by 1e-8: here no angle is ever taken."""
    off = Fraction(sign, 10**beside) if beside else Fraction(0)
    here = replace(case, at=str(180 + off))
    solution, truth = held(here), here.truth()
    for name, true in truth.points.items():
        point = solution.points[name]
        for found, exact, scale in (
            (point.position, true.place, 4),
            (point.velocity, true.velocity, 1),
            (point.acceleration, true.acceleration, 2),
        ):
            assert_near(f"{name} at 180°", found, exact, 32 * EPS * scale)


def test_the_error_of_a_position_does_not_grow_with_their_number():
    """Every row is found from its own angle: the last of 36 000 is as good as the first."""
    many = cycle(FourBar().mechanism(), steps=36_000)
    few = cycle(FourBar().mechanism(), steps=36)
    for name in ("A", "B"):
        for what in ("position", "velocity", "acceleration"):
            long, short = (getattr(each.solution.points[name], what) for each in (many, few))
            assert (long[::1000] == short).all()
    for row in (0, 1, 17_999, 35_998, 35_999):
        assert_within(many.solution, FourBar().standing(float(many.at[row])).truth(), row)
