"""The plans tell the truth about motion: velocities and accelerations are rates of change.

No formula of kinematics is used here: the mechanism is moved a little, forth and back, and what
the construction says of it at the middle is held against how it has moved.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from graphkin.mechanism import Mechanism
from tests.mechanisms import LAW, SHIPPED, mechanism_of, mechanisms, shipped

STEPS = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
RATES = np.array([1, -8, 0, 8, -1]) / 12
"""Weights of the five-point derivative, whose error is of the fourth order."""
CLOSE = 1e-6


def rate(values, step):
    """Derivative at the middle of five values."""
    return np.sum(RATES * values) / step


def assert_rates_of_change(solution, step: float) -> None:
    """Velocities are the rates of positions, accelerations of velocities, ε of ω."""
    points, links = solution.points.values(), solution.links.values()
    speed = max(abs(p.velocity).max() for p in points if np.ndim(p.velocity))
    size = max(abs(p.acceleration).max() for p in points if np.ndim(p.acceleration))
    for point in points:
        if np.ndim(point.velocity):
            velocity, acceleration = rate(point.position, step), rate(point.velocity, step)
            assert abs(velocity - point.velocity[2]) <= CLOSE * speed
            assert abs(acceleration - point.acceleration[2]) <= CLOSE * size
    twist = max(abs(np.broadcast_to(link.epsilon, 5)).max() for link in links)
    square = max(abs(np.broadcast_to(link.omega, 5)).max() for link in links) ** 2
    for link in links:
        if np.ndim(link.omega):
            epsilon = rate(link.omega, step)
            found = np.broadcast_to(link.epsilon, 5)[2]
            assert abs(epsilon - found) <= CLOSE * max(twist, square)
    for slide in solution.slides.values():
        assert abs(rate(slide.position, step) - slide.speed[2]) <= CLOSE * speed
        assert abs(rate(slide.speed, step) - slide.acceleration[2]) <= CLOSE * size


def moved(mechanism: Mechanism, fastest: float):
    """A mechanism written with ``h`` at five moments, a thousandth of a radian apart."""
    step = 1e-3 / fastest
    return mechanism.batch(h=step * STEPS), step


@LAW
@given(mechanisms(spread=0.4, cross_at=40, most=2))
def test_velocities_and_accelerations_are_the_rates_of_positions_and_velocities(made):
    fastest = max(abs(driver.speed) for driver in made.drivers)
    assert_rates_of_change(*moved(mechanism_of(made.text(moving=True)), fastest))


@pytest.mark.parametrize("n", [1, 7, 19, 30])
@pytest.mark.parametrize("name", SHIPPED)
def test_the_same_of_the_pump_while_its_crank_turns(name, n):
    scene = shipped(name, n).scene
    source = Path(scene.source).read_text(encoding="utf-8")
    source = source.replace("[parameters]", "[parameters]\nh = 0")
    source = source.replace('angle = "30 + 2*n"', 'angle = "30 + 2*n + 6*(300 + 10*n)*h"')
    from graphkin.scene.read_scene import read_text

    mechanism = Mechanism(read_text(source, name, None, {"n": n}))
    assert_rates_of_change(*moved(mechanism, 40))
