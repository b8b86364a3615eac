"""Trial plans as a hand wants them: round numbers, beside the right plan, told apart from it."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.program import Step, sign_of
from graphkin.construction.higher_class.closure_solver import run_settled
from graphkin.construction.higher_class.divided_point import DividedPoint
from graphkin.construction.higher_class.trial_rates import enlarged, followed_rates, spread_of
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.mechanism import Mechanism, load
from graphkin.motion.course import Course
from graphkin.motion.sweep import sweep_of
from graphkin.numbers.plane import Vector
from graphkin.scene.read_scene import read_text
from tests.chosen import EVERY, FOLDER

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
HIGHER = (
    "rapid-return",
    "rod-and-wheel",
    "stephenson-2-binary",
    "stephenson-2-ternary",
    "stephenson-3-crank",
)
"""The example scenes with a group of class III or more."""


@cache
def mechanism(name: str) -> Mechanism:
    """An example scene, read once."""
    return load(SCENES / f"{name}.toml")


def is_called(step: Step, key: str) -> bool:
    """Whether a step's action bears a name."""
    return step.action is not None and step.action.key == key


@pytest.fixture(params=HIGHER)
def higher(request) -> Mechanism:
    return mechanism(request.param)


def shares(some: Mechanism) -> list[tuple[int, Step]]:
    """The steps that say where between its trials a right plan lies."""
    return [(n, s) for n, s in enumerate(some.program.steps) if is_called(s, "share")]


def test_the_right_plan_does_not_hang_on_what_is_tried(higher):
    """Two plans missed in proportion give the right one, whichever two they are."""
    plain, by_hand = higher.trace(), higher.trace(by_hand=True)
    for target, number in higher.program.targets.items():
        if target[0] in ("velocity", "acceleration", "omega", "epsilon"):
            one, two = plain.values[number], by_hand.values[number]
            assert abs(one - two) <= 1e-9 * max(abs(one), 1.0), target


def components(some: Mechanism, signs: str) -> dict[str, Vector]:
    """The arrows of the components in the right plan, under their symbols."""
    trace = some.trace(by_hand=True)
    return {
        step.name: trace.values[number]
        for number, step in enumerate(some.program.steps)
        if step.arrow and number in trace.values and (sign_of(step) or "-") in signs
    }


def assert_square(one: Vector, other: Vector, symbol: str) -> None:
    """Two arrows stand square to each other."""
    first, second = one.tip - one.tail, other.tip - other.tail
    size = max(abs(first), abs(second))
    assert abs((first * second.conjugate()).real) <= 1e-9 * size * size, symbol


@pytest.mark.parametrize("name", HIGHER)
def test_the_right_plan_has_its_normal_and_tangential_components(name):
    """Between two points of a bar stand the normal component and then the tangential one."""
    arrows = components(mechanism(name), "ντ")
    tangential = [name for name in arrows if name.endswith("τ")]
    assert len(tangential) > 1
    for component in tangential:
        normal, other = arrows[component[:-1] + "ν"], arrows[component]
        assert abs(normal.tip - other.tail) < 1e-9
        assert_square(normal, other, component)


def test_the_share_is_measured_where_a_crossing_finds_a_point(higher):
    """The hand's way and the gaps give the same share.

    There is no crossing for a given sliding speed, nor for a bar that moves with both its ends.
    """
    trace, steps = higher.trace(by_hand=True), higher.program.steps
    unmeasured = higher.scene.name in ("rod-and-wheel", "stephenson-2-binary")
    assert all((step.by_hand is None) is unmeasured for _, step in shares(higher))
    measured = [(step.by_hand, number) for number, step in shares(higher) if step.by_hand]
    for by_hand, number in measured:
        assert is_called(steps[by_hand], "share-on-line")
        one, two = trace.values[by_hand], trace.values[number]
        assert abs(one - two) < 1e-9 * max(abs(two), 1.0)


@pytest.mark.parametrize("angle", [85, 91.85, 95, 291.85] if EVERY else [91.85, 95])
def test_trials_stay_beside_a_plan_of_a_group_that_hardly_holds(angle):
    """Where two guides all but meet in the centre of a lever, no point of a trial lies farther from
    its right place than half as far again as the whole plan reaches."""
    text = (SCENES / "rapid-return.toml").read_text().replace("angle = 35", f"angle = {angle}")
    some = Mechanism(read_text(text, "rapid-return", None, {}))
    steps, values = some.program.steps, some.trace(by_hand=True).values
    for number, step in enumerate(steps):
        if is_called(step, "share"):
            points = [d for d in constructions(some.program, DividedPoint) if d.share == number]
            whole = max(abs(values[d.value]) for d in points)
            ends = [(d, end) for d in points for end in (d.first, d.second)]
            assert all(abs(values[end] - values[d.value]) < 1.5 * whole for d, end in ends)
            way = max(abs(values[d.second] - values[d.first]) for d in points)
            assert way > 0.3 * whole, "the trials of some point stand well apart"


# --- The rates of trial plans, where they are chosen and at other places of the drive ------------


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
