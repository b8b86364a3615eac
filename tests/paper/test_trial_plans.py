"""Trial plans as a hand wants them: round numbers, beside the right plan, told apart from it."""

from __future__ import annotations

from functools import cache
from math import log10
from pathlib import Path

import pytest

from graphkin.mechanism import Mechanism, load
from graphkin.plane import Vector
from graphkin.plans.trial_rates import ROUND, tried_by
from graphkin.steps.program import Part, Plane, Step

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
HIGHER = (
    "rapid-return",
    "rod-and-wheel",
    "stephenson-2-binary",
    "stephenson-2-ternary",
    "stephenson-3-crank",
)
"""The example scenes with a group of class III or more."""
PLANES = {Part.VELOCITY: Plane.VELOCITIES, Part.ACCELERATION: Plane.ACCELERATIONS}


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


def test_there_is_a_pair_of_trials_for_each_plan(higher):
    assert [step.part for _, step in shares(higher)] == [Part.VELOCITY, Part.ACCELERATION]


def test_both_trials_are_nought_or_a_round_number(higher):
    for rate in higher.trial_rates.values():
        if rate:
            digits = abs(rate) / 10.0 ** (log10(abs(rate)) // 1)
            assert any(abs(digits - digit) < 1e-9 for digit in ROUND), rate


def test_the_right_plan_does_not_hang_on_what_is_tried(higher):
    """Two plans missed in proportion give the right one, whichever two they are."""
    plain, by_hand = higher.trace(), higher.trace(by_hand=True)
    for target, number in higher.program.targets.items():
        if target[0] in ("velocity", "acceleration", "omega", "epsilon"):
            one, two = plain.values[number], by_hand.values[number]
            assert abs(one - two) <= 1e-9 * max(abs(one), 1.0), target


def test_a_solution_is_reckoned_with_the_driver_s_own_rate_and_nought(higher):
    """On paper alone the trials are round: batches need no answer before they begin."""
    trace = higher.trace()
    for _, step in shares(higher):
        first, second = (trace.values[number] for number in tried_by(step))
        assert first == 0
        assert second not in higher.trial_rates.values()


def test_the_trials_take_up_little_more_room_than_the_right_plan(higher):
    trace = higher.trace(by_hand=True)
    steps = higher.program.steps
    for number, share in shares(higher):
        points = [
            (trace.values[n], *(trace.values[arg] for arg in step.args[:2]))
            for n, step in enumerate(steps)
            if is_called(step, "between")
            and step.args[2] == number
            and step.plane is PLANES[share.part]
        ]
        whole = max(abs(right) for right, _, _ in points)
        assert max(abs(tried) for _, *trials in points for tried in trials) < 1.6 * whole
        assert max(abs(one - two) for _, one, two in points) > 0.25 * whole


def components(some: Mechanism, signs: str) -> dict[str, Vector]:
    """The arrows of the components in the right plan, under their symbols."""
    trace = some.trace(by_hand=True)
    return {
        step.name: trace.values[number]
        for number, step in enumerate(some.program.steps)
        if step.arrow and number in trace.values and step.says.get("kind", "-") in signs
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
    tangential = [symbol for symbol in arrows if symbol.endswith("τ")]
    assert len(tangential) > 1
    for symbol in tangential:
        normal, other = arrows[symbol[:-1] + "ν"], arrows[symbol]
        assert abs(normal.tip - other.tail) < 1e-9
        assert_square(normal, other, symbol)


@pytest.mark.parametrize(
    ("name", "slides"), [("rapid-return", {"PP2", "AA3"}), ("rod-and-wheel", {"BB1"})]
)
def test_the_right_plan_has_the_coriolis_component_of_each_slide_and_what_is_left(name, slides):
    """A slide's acceleration is that of the guide's point, Coriolis and what is along the guide."""
    arrows = components(mechanism(name), "cr")
    assert set(arrows) == {f"a_{index}^{sign}" for index in slides for sign in "cr"}
    for index in slides:
        coriolis, left = arrows[f"a_{index}^c"], arrows[f"a_{index}^r"]
        joined = (left.tip == coriolis.tail, coriolis.tip == left.tail)
        assert any(joined), index
        assert_square(coriolis, left, index)


def test_an_arrow_brings_the_point_under_a_sliding_one_and_no_other_point():
    """Through p′_2 the way leads to p′; who asks for P alone gets no q′."""
    some = load(SCENES / "rapid-return.toml")
    program = some.program
    needed = program.needed([("acceleration", "P")], by_hand=True)
    names = {program.steps[number].name for number in needed}
    assert "p′_2" in names
    assert "q′" not in names


def test_a_relative_velocity_on_a_guide_is_an_arrow_along_it():
    """From the point of the guide to the sliding one: what the table gives as the slide's speed."""
    some = mechanism("rapid-return")
    trace = some.trace(by_hand=True)
    steps = some.program.steps
    arrows = {
        s.says["symbol"]: trace.values[n]
        for n, s in enumerate(steps)
        if s.arrow and n in trace.values
    }
    places = [trace.value("position", point) for point in "PQ"]
    speed = some.solve().slides["2"].speed
    for symbol in ("v_PP2", "v_AA3"):
        way = arrows[symbol].tip - arrows[symbol].tail
        along = way / (places[1] - places[0]) * abs(places[1] - places[0])
        assert abs(along.imag) < 1e-9 * abs(way)
        assert abs(abs(along.real) - abs(speed)) < 1e-9 * abs(speed)
