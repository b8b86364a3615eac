"""Forces in the strands of belts, held to formulas, to all equations and to fifty digits."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from graphkin.construction.core.solution import ForceSolution
from graphkin.construction.forces.force_plan import undrawn
from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError, StructureError
from tests.chosen import FOLDER
from tests.laws.exact_forces import far_from_exact
from tests.laws.force_routes import differences, loaded
from tests.mechanisms import mechanism_of

BELT = """
[frame]
O1 = [0, 0]
O2 = [0.5, 0]
[links.1]
O1-A = 0.04
wheel = {{ centre = "O1", radius = 0.06 }}
[links.2]
O2-B = 0.05
wheel = {{ centre = "O2", radius = 0.15 }}
belt = {{ on = 1, {belt} }}
[[loads]]
link = 2
moment = {moment}
[[drivers]]
turn = 1
angle = 0
speed = 100
[ask]
reactions = ["O2", 2]
balance = true
"""
CLOSE = 1e-12


def of(belt: str, moment: float = -45) -> ForceSolution:
    found, verdict = mechanism_of(BELT.format(belt=belt, moment=moment)).forces()
    assert verdict.agrees and verdict.constructed
    return found


def strands(found: ForceSolution) -> tuple[complex, complex]:
    """The forces of the left and of the right strand on wheel 2, seen towards wheel 1."""
    named = {(each.name, each.link): each.force for each in found.reactions}
    return named["2-1-left", "2"], named["2-1-right", "2"]


@pytest.mark.parametrize("moment", [-45, 45])
@pytest.mark.parametrize(
    ("rule", "tight", "slack"),
    [("slack = 80", 380, 80), ("pretension = 500", 650, 350), ("ratio = 4", 400, 100)],
)
@pytest.mark.parametrize("crossed", [False, True])
def test_the_rule_and_the_moment_give_both_tensions(rule, tight, slack, crossed, moment):
    """M/r = 45/0.15 = 300 N is their difference; the strands lean by sin β = (r_2 ∓ r_1)/a."""
    belt = rule + (", crossed = true" if crossed else "")
    left, right = strands(of(belt, moment))
    # towards wheel 1 the left strand is the lower one; its pull turns wheel 2 clockwise
    expected = (tight, slack) if moment > 0 else (slack, tight)
    assert [abs(left), abs(right)] == pytest.approx(expected, rel=CLOSE)
    lean = math.asin((150 + (60 if crossed else -60)) / 500)
    for force, side in ((left, 1), (right, -1)):
        assert math.isclose(force.real, -abs(force) * math.cos(lean), rel_tol=CLOSE)
        assert math.isclose(force.imag, side * abs(force) * math.sin(lean), rel_tol=CLOSE)


@pytest.mark.parametrize("crossed", [False, True])
def test_the_driver_holds_the_moment_by_the_radii(crossed):
    (balance,) = of(f"slack = 80, crossed = {str(crossed).lower()}").balance
    assert math.isclose(balance.moment, (-1 if crossed else 1) * 45 * 60 / 150, rel_tol=CLOSE)


def test_a_belt_without_a_load_carries_its_pretension():
    left, right = strands(of("pretension = 500", 0))
    assert [abs(left), abs(right)] == pytest.approx([500, 500], rel=CLOSE)


BELTED = ("belts-arm", "belts-crossed", "belts-dynamo", "belts-equal", "geared-five-bar")
"""Scenes of the gallery with belts; their tensions are chosen at random."""


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", BELTED)
def test_strands_are_those_of_the_equations_and_of_fifty_digits(name, seed):
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    made = loaded(Mechanism(read_text(text, name, None, {})), random.Random(seed))
    assert undrawn(made.scene, made.laid[0]) is None
    assert max(differences(made)) < 1e-9
    assert far_from_exact(made) < CLOSE


def test_both_strands_are_asked_by_their_wheel():
    """Fields of a lab, explain and the task follow from what is asked."""
    mechanism = mechanism_of(BELT.format(belt="ratio = 4", moment=-45)).with_forces
    assert {name for quantity, name in mechanism.asked() if name.startswith("R")} == {
        "R′_12",
        "R″_12",
        "R_02",
    }


def test_a_strand_that_would_push_is_refused():
    with pytest.raises(StructureError) as caught:
        of("pretension = 100")
    assert "push with 50 N" in str(caught.value)


def test_a_loose_belt_has_no_forces_along_a_turn():
    """A moment of 45 N·m over a part of the turn alone takes 300 N beside twice 100 N."""
    text = BELT.format(belt="pretension = 100", moment="[[0, 0], [90, -45], [180, 0]]")
    forces = cycle(mechanism_of(text), steps=12).forces
    pulls = next(each for (_, name), each in forces.values.items() if name == "R″_12")
    loose = np.isnan(pulls)
    assert loose.any() and not loose.all()


def test_a_belt_without_a_tension_is_refused():
    with pytest.raises(StructureError) as caught:
        of("crossed = true")
    assert "slack, pretension or ratio" in str(caught.value)


@pytest.mark.parametrize(
    ("belt", "said"),
    [
        ("slack = -3", 'belt.slack: "-3"; expected a number not below 0'),
        ("ratio = 1", 'belt.ratio: "1"; expected a number above 1'),
        ("slack = 1, ratio = 2", "one of slack, pretension, ratio"),
    ],
)
def test_a_wrong_tension_is_named(belt, said):
    with pytest.raises(SceneError) as caught:
        mechanism_of(BELT.format(belt=belt, moment=1))
    assert said in str(caught.value)
