"""Every relative velocity that a right triangle starts from is an arrow of the velocity plan."""

from __future__ import annotations

import pytest

from graphkin.steps.program import Plane
from tests.paper.sheet_tools import SCENES, mechanism_named

LABS = ("pump", "pump-collinear", "slotted-lever", "offset-slider-crank")
WITHIN_TRIALS = {
    "stephenson-2-binary": {"BA", "DC", "DE"},
    "stephenson-2-ternary": {"EC", "ED"},
    "stephenson-3-crank": {"CB"},
}
"""Known gaps: no arrow is drawn within a trial, and these triangles are first needed there."""


def keyed(program, key):
    """The steps of an action."""
    return [step for step in program.steps if step.action and step.action.key == key]


@pytest.mark.parametrize("name", [*LABS, *SCENES])
def test_right_triangles_start_from_what_the_velocity_plan_shows(name):
    program = mechanism_named(name, 7 if name in LABS else None).program
    drawn = {frozenset(s.args) for s in keyed(program, "join") if s.plane is Plane.VELOCITIES}
    missing = set()
    for step in keyed(program, "set-velocity"):
        _, pivot, pin, *_ = step.args
        poles = {number for number in (pivot, pin) if program.steps[number].name == "o"}
        if pivot != pin and not poles and {pivot, pin} not in drawn:
            missing.add(step.says["i"])
    assert missing == WITHIN_TRIALS.get(name, set())


def test_the_planet_shows_the_velocities_of_its_contact():
    steps = mechanism_named("gears-planet").program.steps
    symbols = {s.says.get("symbol") for s in steps if s.arrow and s.plane is Plane.VELOCITIES}
    assert {"v_QP", "v_QT3", "v_T3P"} <= symbols
