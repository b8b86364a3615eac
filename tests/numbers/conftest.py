"""Mechanisms that several of these tests need."""

from __future__ import annotations

import pytest

from graphkin.mechanism import Mechanism
from tests.cli.conftest import run
from tests.mechanisms import mechanism_of

__all__ = ["run", "touching"]

TOUCHING = """
[parameters]
a = { value = 40, min = 0, max = 90, step = 1 }
[frame]
O = [0, 0]
P = { from = "O", length = 3, angle = "a" }
[links.1]
O-A = 1
[links.2]
A-B = 1
[links.3]
P-B = 1
[[drivers]]
turn = 1
angle = "a"
speed = 1
[branches]
B = "left of A-P"
"""


@pytest.fixture
def touching() -> Mechanism:
    """A crank that points at a pivot, as far from it as two bars together are long."""
    return mechanism_of(TOUCHING)
