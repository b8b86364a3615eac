"""Mechanisms made at random through a whole cycle: each point goes as its velocities say.

``python -m tests.chance.moving 60 SEED`` moves many more.
"""

import pytest

from tests.chance.moving import faults, moved

SEEN = {922004: "a link past half a turn, whose wheel's block the program counts instead"}
"""Seeds of a longer run whose cycle was once wrong, and what is special there."""


@pytest.mark.parametrize("seed", [*range(700102, 700107), 700109, 700112, *SEEN])
def test_a_whole_cycle_is_a_motion(seed):
    found = moved(seed)
    assert found is not None
    assert faults(found) == []
