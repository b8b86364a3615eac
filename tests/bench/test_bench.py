"""What is measured is the same thing: the plain formulas give the program's numbers."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.mechanism import load
from tests.bench import pump_by_formulas as formulas


def named(solution) -> dict[str, object]:
    """The quantities of a solution under the names of the plain formulas."""
    found: dict[str, object] = {}
    for point in "ABCD":
        motion = solution.points[point]
        found[point], found[f"v_{point}"] = motion.position, motion.velocity
        found[f"a_{point}"] = motion.acceleration
    for link in "1234":
        motion = solution.links[link]
        found[f"omega_{link}"], found[f"epsilon_{link}"] = motion.omega, motion.epsilon
        centre, pole = motion.instant_centre, motion.acceleration_pole
        found[f"I_{link}"], found[f"J_{link}"] = centre.shift / centre.size, pole.shift / pole.size
    return found


@pytest.mark.parametrize("n", [1, 7, 30])
def test_the_plain_function_gives_the_programs_numbers(n):
    expected = named(load("pump", n=n).solve())
    for name, value in formulas.one(n).items():
        assert value == pytest.approx(expected[name], rel=1e-11, abs=1e-11), name


@pytest.mark.parametrize("many", [formulas.many, formulas.many_in_blocks])
def test_plain_numpy_gives_the_programs_numbers(many):
    n = np.linspace(1, 30, 5000)
    expected = named(load("pump").batch(n=n))
    for name, values in many(n).items():
        np.testing.assert_allclose(values, expected[name], rtol=1e-9, atol=1e-9, err_msg=name)
