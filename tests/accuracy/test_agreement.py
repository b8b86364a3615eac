"""Doubles one by one, doubles in a batch and certified balls agree on every scene that we ship."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphkin.accuracy.comparison import (
    answers_of,
    ground_of,
    places_around,
    reference_of,
    sizeable,
)
from graphkin.accuracy.methods import found_singly
from graphkin.mechanism import load
from graphkin.numbers.kinds import ball_kind, decimal_kind
from tests.accuracy.agreement import agreement, contained
from tests.chosen import FOLDER, HALVES

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
WHICH = ["pump", *(str(FOLDER / f"{name}.toml") for name in HALVES[1])]
POSITIONS = 4
TIGHT, TWICE = 1e4, 1e7
"""A ball of 53 bits may be so many times the bound of a double, and where two links are tried."""


def reference(name: str, count: int = POSITIONS):
    ground = ground_of(load(name).scene)
    return reference_of(
        places_around(ground, count),
        answers_of(ground.sweep.scene, ground.piece.course.program),
    )


@pytest.mark.parametrize("name", WHICH, ids=lambda name: Path(name).stem)
def test_doubles_keep_to_their_bound_and_every_ball_holds_the_truth(name):
    found = agreement(reference(name))
    assert found.bound < 1e-10
    assert found.single < 1
    assert found.batch < 1
    assert found.contained == found.answers
    assert found.tightness < (TWICE if "plates" in name else TIGHT)


@pytest.mark.parametrize("name", ["pump", str(SCENES / "gears-planet.toml")])
@pytest.mark.parametrize("bits", [53, 106, 400])
def test_balls_of_any_size_hold_the_reference(name, bits):
    sure = reference(name)
    balls = found_singly(sure, ball_kind(bits))
    every = len(sure.answers.every) * POSITIONS
    assert contained(balls, sure) == (every, every)


def test_the_reference_holds_decimals_of_two_hundred_digits():
    # another library, another kind of arithmetic, the same program
    sure = reference("pump")
    missed = sure.missed(found_singly(sure, decimal_kind(200)))
    assert (missed <= 4 * sure.radii + 1e-195).all()


def test_a_double_beside_the_truth_would_be_seen():
    sure = reference("pump")
    found = [dict(each) for each in found_singly(sure, decimal_kind(30))]
    place = next(iter(sure.answers.targets[0]))
    found[0][place] = complex(found[0][place]) + 1e-6
    assert sure.missed(found)[0, 0] == pytest.approx(1e-6, rel=1e-6)


@pytest.mark.parametrize("times", [1e-3, 1e3])
def test_the_scale_of_an_acceleration_that_is_nearly_zero_grows_with_the_mechanism(times):
    """Lengths, speeds and accelerations of a mechanism so many times as large, at the same ω."""
    sizes = np.array([[0.2, 3.0, 1e-9], [0.2, 3.0, 40.0]])
    assert sizeable(times * sizes) == pytest.approx(times * sizeable(sizes), rel=1e-12)
    assert sizeable(sizes)[0, 2] > 1e-3
