"""Ranges that lie about nought, from either side of it."""

import pytest

from graphkin.motion.cycle import cycle
from tests.mechanisms import mechanism_of

TRIPLE_ROCKER = """
[frame]
O = [0, 0]
Q = [0.06, 0]
[links.1]
Q-B = 0.06
[links.2]
O-A = 0.18
[links.4]
B-A = 0.08
[[drivers]]
turn = 1
angle = {angle}
speed = 3
[branches]
A = "left of O-B"
"""


@pytest.mark.parametrize("angle", [-60, -20, -5, 20, 340])
def test_a_rocker_that_swings_about_nought_is_followed_from_anywhere(angle):
    """B is 0.12·cos(φ/2) from O and at least 0.18 - 0.08: cos(φ/2) = 5/6 at the ends."""
    found = cycle(mechanism_of(TRIPLE_ROCKER.format(angle=angle)), steps=36)
    (low, high), *rest = found.ranges
    assert not rest
    assert (low, high) == pytest.approx((-67.11461952384143, 67.11461952384143), abs=1e-9)
