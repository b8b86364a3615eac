"""Sheets follow what is asked: no plan of accelerations where only velocities are, and back."""

from __future__ import annotations

import pytest

from graphkin.handout import hand_out, scales, targets_of
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Ask
from graphkin.steps.program import Part, Plane
from graphkin.steps.solution import Solution
from tests.effects.scope import FILES, accelerations, asking, counted, shipped, velocities

BEYOND = (Part.ACCELERATION, Part.NORMAL, Part.POLE)


@pytest.mark.parametrize("name", ["pump", "oscillating-slide", "gears-rack", "centrodes-cardan"])
def test_velocities_alone_give_no_acceleration_sheet_and_run_no_acceleration(name, monkeypatch):
    shipped_too = Ask(velocity=shipped(name).scene.ask.velocity)
    mechanism = asking(name, shipped_too._replace(centrodes=shipped(name).scene.ask.centrodes))
    assert mechanism.program
    with counted(monkeypatch) as ran:
        handed = hand_out(mechanism, language="en")
    assert [sheet.kind for sheet in handed] == ["velocity", "calculation"]
    assert ran
    assert not [s for s in ran if s.part in BEYOND or s.plane is Plane.ACCELERATIONS]


def test_accelerations_alone_give_no_velocity_sheet():
    handed = hand_out(asking("pump", Ask(acceleration=("D",))), language="en")
    assert [sheet.kind for sheet in handed] == ["acceleration", "calculation"]


def test_the_witness_of_a_sheet_judges_what_it_shows(monkeypatch):
    """Where everything stands, and of the rest what is asked."""
    judged: list[Solution] = []
    witness = Mechanism.witness

    def noted(self: Mechanism, solution: Solution):
        judged.append(solution)
        return witness(self, solution)

    monkeypatch.setattr(Mechanism, "witness", noted)
    hand_out(asking("pump", Ask(velocity=("B",))), language="en")
    (solution,) = judged
    standing = {name for name, p in solution.points.items() if p.position is not None}
    assert standing == {*"ABCD", "O1", "O2"}
    assert solution.points["B"].velocity is not None
    assert solution.points["D"].velocity is None
    assert all(p.acceleration is None for p in solution.points.values())


@pytest.mark.parametrize("name", FILES)
def test_nothing_of_an_acceleration_is_drawn_for_a_velocity(name):
    mechanism = velocities(name)
    program = mechanism.program
    needed = program.needed(targets_of(mechanism, "velocity"), by_hand=True)
    drawn = [program.steps[number] for number in needed]
    assert not [step for step in drawn if step.part in BEYOND]
    assert targets_of(mechanism, "acceleration") == ()
    assert targets_of(accelerations(name), "velocity") == ()


def test_the_scale_of_velocities_does_not_hang_on_accelerations(monkeypatch):
    mechanism = velocities("excavator-absolute")
    assert mechanism.program
    with counted(monkeypatch) as ran:
        scales(mechanism)
    assert not [s for s in ran if s.part in BEYOND]
