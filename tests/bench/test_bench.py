"""What is measured is the same thing: the plain formulas give the program's numbers."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
import pytest

from graphkin.mechanism import load
from tests.bench import pump_by_formulas as formulas
from tests.bench.chain import exponent
from tests.bench.four_bar_in_c import compiled
from tests.bench.linkages import SCENES, peer
from tests.bench.linkages_by_formulas import in_blocks
from tests.bench.motion import Turn, turn_of


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


def peers() -> list[str]:
    """The linkages, where the peer library and its compiler are installed."""
    return list(SCENES) if find_spec("pylinkage") and find_spec("numba") else []


def by_rows(turn: Turn) -> np.ndarray:
    """Pins by six by positions, as the formulas give them."""
    found = turn.emitted("numpy").values
    values = iter([found[number] for number in turn.keep])
    pins = zip(values, values, values, strict=True)
    return np.array([[part for v in pin for part in (v.real, v.imag)] for pin in pins])


@pytest.mark.parametrize("name", SCENES)
def test_linkages_in_closed_form_are_the_same_work(name):
    turn = turn_of(name, 3600)
    np.testing.assert_allclose(in_blocks(name, turn.degrees), by_rows(turn), rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", peers())
def test_the_peer_library_does_the_same_work(name):
    run, pins = peer(name, 3600)
    every = np.concatenate(run(), axis=2)[:, list(pins)].transpose(1, 2, 0)
    np.testing.assert_allclose(every, by_rows(turn_of(name, 3600)), rtol=0, atol=1e-6)


def test_the_loop_in_c_does_the_same_work(tmp_path):
    loop, turn = compiled(tmp_path), turn_of("four-bar", 3600)
    if loop is None:
        pytest.skip("no compiler")
    found = loop(turn.degrees).T.reshape(2, 6, -1)
    np.testing.assert_allclose(found, by_rows(turn), rtol=0, atol=1e-9)


def test_the_exponent_of_a_square_is_two():
    assert exponent((2, 20, 50, 200), [1.0, 4.0, 25.0, 400.0]) == pytest.approx(2)
