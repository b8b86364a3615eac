"""Mechanisms made at random through a whole cycle: each point goes as its velocities say.

``python -m tests.chance.moving 60 SEED`` moves many more.
"""

import pytest

from tests.chance.moving import faults, moved
from tests.chosen import EVERY

SEEN = {
    8200000: "a row at which a cam's law makes velocities jump",
    922004: "a link past half a turn, whose wheel's block the program counts instead",
    8800615: "a row so near a dead point that differences of positions err",
}
"""Seeds of a longer run whose cycle was once wrong, and what is special there."""
LONG = {
    8801115: "a closure beside a flat dyad, about which steps swing",
    8801345: "rows of a group of class IV that lost digits",
    8800025: "a driver that rolls, beside which a trial must not be too small",
}
"""The same, where a cycle takes seconds: ``EVERY=1`` alone."""
SEEDS = (*range(700102, 700107), 700109, 700112, *SEEN, *(LONG if EVERY else ()))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_whole_cycle_is_a_motion(seed):
    found = moved(seed)
    assert found is not None
    assert faults(found) == []
