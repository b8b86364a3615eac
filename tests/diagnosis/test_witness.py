"""The independent route looks at what is asked and no further, and still judges it."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.construction.core.quantities import PointMotion
from graphkin.construction.core.solution import Solution, gathered
from graphkin.loops.equations import Equations
from graphkin.loops.witness import examine
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Ask
from tests.chosen import CHOSEN
from tests.diagnosis.scope import asking, shipped, velocities

EVERY = pytest.mark.parametrize("name", ["pump", *CHOSEN])
SLOW = {"close", "share"}


def of_higher_class(mechanism: Mechanism) -> bool:
    """Whether a group of higher class is among the groups: its closures take long to number."""
    return any(step.action and step.action.key in SLOW for step in mechanism.program.steps)


def looked_at(mechanism: Mechanism, solution: Solution) -> set[str]:
    """The links whose loops are closed for a solution."""
    return set(examine(mechanism.scene, solution, None).solved.loops.links) - {"0"}


@EVERY
def test_what_is_asked_is_judged_alone(name):
    """Each asked quantity for itself, with what its own construction needs."""
    mechanism = shipped(name)
    targets = list(dict.fromkeys(mechanism.asked()))
    for target in targets[:1] if of_higher_class(mechanism) else targets:
        verdict = mechanism.witness(gathered(mechanism.trace([target])))
        assert verdict.agrees, (target, verdict)


@EVERY
def test_velocities_are_judged_without_accelerations(name, monkeypatch):
    mechanism = velocities(name)
    solution = mechanism.solve(asked=True)

    def refuse(self, *args):
        raise AssertionError("the equations are derived twice")

    monkeypatch.setattr(Equations, "second", refuse)
    assert mechanism.witness(solution).agrees
    with pytest.raises(AssertionError):
        mechanism.witness(mechanism.solve())


def test_a_crank_is_judged_without_what_it_drives():
    alone = asking("pump", Ask(velocity=("A",)))
    solution = alone.solve(asked=True)
    assert looked_at(alone, solution) == {"1"}
    assert looked_at(alone, alone.solve()) == {"1", "2", "3", "4", "5"}
    verdict = alone.witness(solution)
    assert verdict.agrees
    assert verdict.guessed == ()


def test_the_first_loop_is_judged_without_the_second():
    alone = asking("pump", Ask(omega=("3",)))
    assert looked_at(alone, alone.solve(asked=True)) == {"1", "2", "3"}


def test_the_witness_of_a_part_still_finds_what_is_wrong():
    """A velocity that is a millionth out is told, and so is a pin on the wrong side."""
    alone = asking("pump", Ask(omega=("3",)))
    right = alone.solve(asked=True)
    pin = right.points["B"]
    wrong = {**right.points, "B": replace(pin, velocity=pin.velocity * (1 + 1e-6))}
    verdict = alone.witness(Solution(wrong, right.links, margin=right.margin))
    assert not verdict.agrees
    assert verdict.quantity == "points.B.velocity"
    mirrored = {
        point: PointMotion(motion.position and motion.position.conjugate())
        for point, motion in right.points.items()
    }
    verdict = alone.witness(Solution(mirrored, {}, margin=right.margin))
    assert not verdict.agrees


def test_a_part_is_judged_in_a_batch_too():
    alone = asking("pump", Ask(omega=("3",)))
    n = np.linspace(1, 30, 5)
    solution = alone.batch(asked=True, n=n)
    found = examine(alone.scene, solution, {"n": n})
    worst, agrees = found.worst, found.agrees
    assert agrees.all()
    assert (worst < 1e-9).all()
