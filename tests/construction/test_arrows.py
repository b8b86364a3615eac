"""Every relative velocity that a right triangle starts from is an arrow of the velocity plan."""

from __future__ import annotations

import pytest

from graphkin.construction.core.program import ContactName, Plane
from tests.chance.checking import case
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import mechanism_named

LABS = ("pump", "pump-collinear", "slotted-lever", "offset-slider-crank")
SEEDS = range(60)
"""Mechanisms made at random, a quarter of them with trials."""


def keyed(program, key):
    """The steps of an action."""
    return [step for step in program.steps if step.action and step.action.key == key]


def not_drawn(program):
    """The relative velocities that a triangle starts from and the velocity plan does not show."""
    drawn = {frozenset(s.args) for s in keyed(program, "join") if s.plane is Plane.VELOCITIES}
    missing = set()
    for step in keyed(program, "set-velocity"):
        _, pivot, pin, *_ = step.args
        poles = {number for number in (pivot, pin) if program.steps[number].name == "o"}
        if pivot != pin and not poles and {pivot, pin} not in drawn:
            missing.add(step.of.index)
    return missing


@pytest.mark.parametrize("name", [*LABS, *CHOSEN])
def test_right_triangles_start_from_what_the_velocity_plan_shows(name):
    assert not not_drawn(mechanism_named(name, 7 if name in LABS else None).program)


def test_so_they_do_in_groups_that_take_two_trials():
    made = {seed: found.mechanism.program for seed in SEEDS if (found := case(seed))}
    tried = {seed for seed, program in made.items() if keyed(program, "share")}
    assert len(tried) > 10
    assert not {seed: missing for seed in tried if (missing := not_drawn(made[seed]))}


@pytest.mark.parametrize(
    ("name", "symbols"),
    [
        ("gears-planet", {"v_QP", "v_QT", "v_TP"}),
        ("stephenson-2-binary", {"v_BA", "v_DC", "v_DE"}),
        ("stephenson-2-ternary", {"v_EC", "v_ED"}),
        ("stephenson-3-crank", {"v_CB"}),
    ],
)
def test_the_velocity_plan_shows_contacts_and_bars_within_trials(name, symbols):
    steps = mechanism_named(name).program.steps
    arrows = [s for s in steps if s.arrow and s.plane is Plane.VELOCITIES]
    assert symbols <= {arrow.of.symbol for arrow in arrows}
    ends = [steps[number].name for arrow in arrows for number in arrow.args]
    assert not any(end.endswith(("¹", "²")) for end in ends)


def fallen(program, number):
    """The image on which that of a point of a link that only shifts falls."""
    step = program.steps[number]
    return step.args[0] if step.action and step.action.key == "alike" else number


def both_ways(program):
    """The relative velocities that stand in the plan in both senses."""
    arrows = [step for step in keyed(program, "join") if step.plane is Plane.VELOCITIES]
    drawn = {tuple(fallen(program, end) for end in step.args): step for step in arrows}
    poles = {number for number, step in enumerate(program.steps) if step.name == "o"}
    return {
        step.of.symbol
        for (tail, tip), step in drawn.items()
        if not {tail, tip} & poles and (tip, tail) in drawn
    }


@pytest.mark.parametrize("name", [*LABS, *CHOSEN])
def test_no_segment_of_the_velocity_plan_is_drawn_in_both_senses(name):
    assert not both_ways(mechanism_named(name, 7 if name in LABS else None).program)


def test_nor_is_one_in_mechanisms_made_at_random_but_for_that_of_a_point_of_contact():
    """Against the wheel's centre that is the centre's along the track, and each is told."""
    made = {seed: found.mechanism.program for seed in SEEDS if (found := case(seed))}
    found = {seed: symbols for seed, program in made.items() if (symbols := both_ways(program))}
    assert found == {36: {"v_P5P5,2", "v_TP5"}}


def small(name):
    """The name of an image, or of a point in an index, as bare small letters."""
    return name.replace("_v", "").replace("_", "").replace(",", "").lower()


@pytest.mark.parametrize("name", CHOSEN)
def test_the_ends_of_a_relative_velocity_bear_the_letters_of_its_index(name):
    """But for the pole, on which what is fixed falls, and for contacts that plates carry."""
    program = mechanism_named(name).program
    points = {of for _, of in program.targets if isinstance(of, ContactName)}
    contacts = {small(point) for point in points}
    for step in keyed(program, "join"):
        letters = {small(step.of.q), small(step.of.p)}
        if step.plane is Plane.VELOCITIES and step.of.p and not letters & contacts:
            ends = {small(program.steps[end].name) for end in step.args}
            assert "o" in ends or ends == letters, step.of.symbol
