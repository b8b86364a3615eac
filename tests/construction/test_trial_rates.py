"""The rates of trial plans, where they are chosen and at other places of the driver."""

from __future__ import annotations

import pytest

from graphkin.construction.core.kind import constructions
from graphkin.construction.higher_class.closure_solver import run_settled
from graphkin.construction.higher_class.trial_rates import enlarged, followed_rates, spread_of
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.mechanism import Mechanism, load
from graphkin.motion.course import Course
from graphkin.motion.sweep import sweep_of
from tests.chosen import FOLDER


def standing(at: float) -> Mechanism:
    """The rapid return with its crank at an angle."""
    scene = load(FOLDER / "rapid-return.toml").scene
    return Mechanism(Course(sweep_of(scene), scene.branches).standing(at))


def ran(mechanism: Mechanism, rates):
    """All values by some rates."""
    program = mechanism.program
    return run_settled(
        mechanism.scene, program, program.needed(program.targets), overrides=dict(rates)
    ).values


@pytest.mark.parametrize("at", [75, 120, 200, 300.8, 330])
def test_trial_plans_that_follow_the_driver_keep_their_size_beside_the_right_one(at):
    """At 300.8° the rates that were chosen at 60° would draw a plan 96 times the right one."""
    chosen, there = standing(60), standing(at)
    drawn, found = ran(chosen, chosen.trial_rates), ran(there, chosen.trial_rates)
    rates = followed_rates(
        there.program, drawn, chosen.trial_rates, lambda rates: ran(there, rates)
    )
    here = {number: rates[number] for number in chosen.trial_rates}
    velocities, _ = constructions(there.program, TwoTrials)
    first, second = (here[number] for number in velocities.rates)
    spread = spread_of(there.program, found, velocities)
    assert enlarged(spread, first, second) < 2
    kept = enlarged(spread, *(chosen.trial_rates[number] for number in velocities.rates))
    assert at != 300.8 or kept > 90
    # both plans lie about the right one as they do where they were chosen, and lead to the same
    before = spread_of(chosen.program, drawn, next(constructions(chosen.program, TwoTrials)))
    one, two = (chosen.trial_rates[number] for number in velocities.rates)
    shares = [(before.rate - one) / (two - one), (spread.rate - first) / (second - first)]
    assert shares[1] == pytest.approx(shares[0])
    assert ran(there, rates)[velocities.share] == pytest.approx(shares[1])


def test_where_they_were_chosen_they_are_as_chosen():
    chosen = standing(60)
    rates = followed_rates(
        chosen.program,
        ran(chosen, chosen.trial_rates),
        chosen.trial_rates,
        lambda rates: ran(chosen, rates),
    )
    assert rates == pytest.approx(dict(chosen.trial_rates))


@pytest.mark.parametrize("at", [152, 248, 338])
def test_a_link_at_rest_in_a_trial_is_tried_where_that_would_be_far_from_the_right_plan(at):
    """At 338° the lever that is at rest (ε = 0) at 35° would draw a plan 17 times the right one."""
    chosen, there = standing(35), standing(at)
    drawn, found = ran(chosen, chosen.trial_rates), ran(there, chosen.trial_rates)
    rates = followed_rates(
        there.program, drawn, chosen.trial_rates, lambda rates: ran(there, rates)
    )
    _, accelerations = constructions(there.program, TwoTrials)
    first, second = accelerations.rates
    assert chosen.trial_rates[first] == 0
    spread = spread_of(there.program, found, accelerations)
    assert enlarged(spread, rates[first], rates[second]) < 3
    assert at != 338 or enlarged(spread, 0.0, rates[second]) > 17
    right = ran(there, chosen.trial_rates)[accelerations.share]
    assert spread.rate == pytest.approx(
        chosen.trial_rates[first] + right * (chosen.trial_rates[second] - chosen.trial_rates[first])
    )
