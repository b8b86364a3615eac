"""Sheets follow what is asked: no plan of accelerations where only velocities are, and back."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from graphkin.construction.core.program import SPEEDS, Part, Plane
from graphkin.construction.core.solution import Solution
from graphkin.documents.sheet_documents import hand_out, targets_of
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Ask
from tests.chosen import CHOSEN
from tests.diagnosis.scope import accelerations, asking, counted, shipped, untouched

BEYOND = (Part.ACCELERATION, Part.NORMAL, Part.POLE)


@pytest.mark.parametrize("name", ["pump", "oscillating-slide", "gears-rack", "centrodes-cardan"])
def test_velocities_alone_give_no_acceleration_sheet_and_run_no_acceleration(name, monkeypatch):
    shipped_too = Ask(velocity=shipped(name).scene.ask.velocity)
    ask = replace(shipped_too, centrodes=shipped(name).scene.ask.centrodes)
    mechanism = untouched(asking(name, ask))
    assert mechanism.program
    # Only the proof that the motion behind centrodes has no jump takes accelerations.
    monkeypatch.setattr("graphkin.motion.cycle.refuse_jumps", lambda found: None)
    with counted(monkeypatch) as ran:
        handed = hand_out(mechanism, language="en")
    assert [sheet.kind for sheet in handed] == ["velocity", "calculation"]
    assert ran
    assert not [s for s in ran if s.part in BEYOND or s.plane is Plane.ACCELERATIONS]


@pytest.mark.parametrize("name", ["pump", *CHOSEN])
def test_whatever_velocity_an_acceleration_needs_is_drawn_and_no_other(name):
    """But for a line of speeds, which is of velocities alone, and the velocities of forces."""
    mechanism = accelerations(name)
    program = mechanism.program
    first, then = (targets_of(mechanism, kind) for kind in ("velocity", "acceleration"))
    first = tuple(target for target in first if target[0] != SPEEDS)
    taken, drawn = (
        {n for n in program.needed(targets) if program.steps[n].plane is Plane.VELOCITIES}
        for targets in (then, first)
    )
    forced = mechanism.scene.forces is not None
    assert drawn == taken or not first or (forced and drawn > taken)
    assert first or all(not program.steps[n].args for n in taken)


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
