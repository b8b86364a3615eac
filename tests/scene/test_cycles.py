"""Whole turns that leave all wheels as they stand, and gears after very many of them."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction

import pytest

from graphkin.scene.wheels import cycle
from tests.mechanisms import mechanism_of, scene_of

EPS = 2.0**-52
TRAIN = """
[frame]
O1 = [0, 0]
O2 = [5, 0]
O3 = [12, 0]
[links.1]
O1-A = 1
wheel = {{ centre = "O1", radius = 2 }}
[links.2]
O2-B = 1
wheel = {{ centre = "O2", radius = 3 }}
rolls = {{ on = 1, start = {{ 1 = 10 }} }}
[links.3]
O3-C = 1
wheel = {{ centre = "O3", radius = 4 }}
rolls = {{ on = 2 }}
[[drivers]]
turn = 1
angle = "{angle}"
speed = 1
"""


@pytest.mark.parametrize("turns", [0, 7, 1001, 10**6, -(10**9), 10**14 + 1])
def test_a_train_stands_right_after_any_number_of_turns(turns):
    """Of the wheel r3 the angle is (φ - 10)·r1/r3, in fractions: within 64·ε·L/l = 64·ε·12."""
    angle = Fraction(333, 10) + 360 * turns
    found = mechanism_of(TRAIN.format(angle=f"333/10 + 360*({turns})"))
    solution = found.solve()
    last = (angle - 10) * Fraction(2, 4) % 360
    expected = 12 + cmath.rect(1, math.radians(last))
    assert abs(solution.points["C"].position - expected) < 64 * EPS * 12
    assert abs(solution.points["C"].velocity - 0.5j * (expected - 12)) < 64 * EPS * 12
    verdict = found.witness(solution)
    assert verdict.agrees
    assert verdict.largest_difference < 1e-12


def test_a_cycle_is_as_many_turns_as_bring_every_wheel_back():
    assert cycle(scene_of(TRAIN.format(angle=0))) == (3 * 2) * (4 * 3)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("radius = 4", 'radius = "4*k"'),
        ("radius = 4", 'radius = "sqrt(16 + 1e-30)"'),
    ],
)
def test_no_turns_are_taken_off_where_no_cycle_is_sure(old, new):
    text = TRAIN.format(angle=0).replace(old, new) + "[parameters]\nk = 1\n"
    assert cycle(scene_of(text)) is None
