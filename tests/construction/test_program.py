"""The straight line of steps: what is needed, what follows from what, batches and failures."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphkin.construction.core.program import Part
from graphkin.construction.core.run import StepFailed, made_ready, run, run_batch
from graphkin.numbers.arithmetic import FLOAT, batch_kind, least
from graphkin.numbers.plane import Ratio
from graphkin.text.errors import ClosureError
from tests.mechanisms import LAW, SHIPPED, mechanism_of, mechanisms, shipped
from tests.scene_files import scene_text

EARLY = {Part.SHAPE, Part.POSITION}


def keys(program, numbers) -> set[str]:
    """The actions of some steps."""
    return {program.steps[n].action.key for n in numbers if program.steps[n].action}


def same(one, other) -> bool:
    """Whether two values of a step are equal to the last bit."""
    return one == other


# --- only what is asked --------------------------------------------------------------------------


@settings(LAW, max_examples=40)
@given(mechanisms(), st.data())
def test_a_slice_runs_only_earlier_steps_and_gives_the_same_values(made, data):
    mechanism = made.mechanism()
    program, whole = mechanism.program, mechanism.trace()
    target = data.draw(st.sampled_from(sorted(program.answers)))
    trace = mechanism.trace([target])
    assert set(trace.values) == set(program.needed([target]))
    for number, value in trace.values.items():
        assert same(value, whole.values[number])
        assert all(arg < number for arg in program.steps[number].args)


@settings(LAW, max_examples=25)
@given(mechanisms(most=2), st.data())
def test_no_needed_step_can_be_spared(made, data):
    mechanism = made.mechanism()
    program = mechanism.program
    target = data.draw(st.sampled_from(sorted(program.answers)))
    needed = program.needed([target])
    for spared in needed:
        rest = [number for number in needed if number != spared]
        try:
            trace = run(program, rest, mechanism.scene.values, FLOAT)
        except KeyError:
            continue
        assert trace.value(*target) is None


@pytest.mark.parametrize("name", SHIPPED)
def test_a_velocity_needs_no_step_of_the_accelerations(name):
    program = shipped(name, 7).program
    needed = program.needed([("velocity", "D"), ("omega", "4")])
    parts = {program.steps[number].part for number in needed}
    assert parts <= EARLY | {Part.VELOCITY, Part.RESULT}
    assert {"normal", "centripetal", "lay-off", "epsilon"}.isdisjoint(
        keys(program, (n for n in needed if program.steps[n].part not in EARLY))
    )


@pytest.mark.parametrize("name", SHIPPED)
def test_a_position_needs_no_velocity_and_the_rocker_no_piston(name):
    program = shipped(name, 7).program
    parts = {program.steps[n].part for n in program.needed([("position", "D")])}
    assert parts <= EARLY
    names = {program.steps[n].name for n in program.needed([("acceleration", "B")])}
    assert names.isdisjoint({"C", "D", "c", "d", "c′", "d′"})


def test_arrows_are_drawn_only_between_points_that_are_there():
    program = shipped("pump", 7).program
    needed = program.needed([("velocity", "B")], by_hand=True)
    arrows = {program.steps[n].name for n in needed if program.steps[n].arrow}
    assert arrows == {"oa", "ob", "ab", "v_A"}
    assert "v_A" not in {program.steps[n].name for n in program.needed([("velocity", "B")])}


# --- what follows from what ----------------------------------------------------------------------


def test_a_hook_sees_every_step_in_order_and_may_leave_it():
    mechanism = shipped("pump", 7)
    program, seen = mechanism.program, []
    needed = program.needed(program.answers)

    def look(number, step, value):
        assert step is program.steps[number]
        seen.append(number)
        return value

    trace = run(program, needed, mechanism.scene.values, FLOAT, hook=look)
    assert seen == list(needed)
    assert trace == mechanism.trace()


def test_the_students_own_point_is_followed_through():
    """A point put in place of ours: all that follows is drawn from it."""
    mechanism = shipped("pump", 7)
    program = mechanism.program
    number = program.targets["velocity", "B"]
    own = mechanism.trace().values[number] + (0.3 - 0.2j)
    needed = program.needed(program.answers)
    trace = run(program, needed, mechanism.scene.values, FLOAT, overrides={number: own})
    whole = mechanism.trace()
    assert trace.values[number] == own
    for other in needed:
        follows = other in program.descendants(number)
        assert follows == (not same(trace.values[other], whole.values[other]))


@pytest.mark.parametrize("name", SHIPPED)
def test_the_hand_may_lead(name):
    """Composite steps taken by the hand's own value come to the same motion."""
    mechanism = shipped(name, 7)
    program = mechanism.program
    needed = program.needed(program.answers, by_hand=True)
    drawn = run(program, needed, mechanism.scene.values, FLOAT, by_hand=True)
    for target in (("velocity", "D"), ("acceleration", "D"), ("epsilon", "4")):
        assert drawn.value(*target) == pytest.approx(mechanism.trace().value(*target), rel=1e-12)


# --- batches -------------------------------------------------------------------------------------


def flattened(solution):
    """Every number of a solution by its place."""
    for kind in ("points", "links", "slides"):
        for name, motion in getattr(solution, kind).items():
            for quantity in motion.__slots__:
                value = getattr(motion, quantity)
                parts = value if isinstance(value, Ratio) else (value,)
                for part, number in enumerate(parts):
                    if number is not None:
                        yield (kind, name, quantity, part), number
    yield ("margin",), solution.margin


@pytest.mark.parametrize("name", SHIPPED)
def test_a_batch_of_all_students_equals_each_one(name):
    numbers = np.arange(1, 31)
    batch = dict(flattened(shipped(name, 1).batch(n=numbers)))
    largest = {place: np.abs(values).max() for place, values in batch.items()}
    for n in numbers:
        one = dict(flattened(shipped(name, int(n)).solve()))
        assert one.keys() == batch.keys()
        for place, value in one.items():
            found = np.broadcast_to(batch[place], 30)[n - 1]
            assert abs(found - value) <= 1e-13 * largest[place], place


@pytest.mark.parametrize("size", [1, 2047, 2048, 2049, 5000])
def test_where_the_blocks_of_a_batch_end_does_not_show(size):
    angles = np.linspace(1, 30, size)
    whole = shipped("pump", 1).batch(n=angles).points["D"].acceleration
    parts = [shipped("pump", 1).batch(n=part) for part in np.array_split(angles, 3) if part.size]
    assert whole.shape == (size,)
    joined = np.concatenate([part.points["D"].acceleration for part in parts])
    np.testing.assert_allclose(whole, joined, rtol=0, atol=1e-13 * np.abs(whole).max())


RODS = scene_text("construction/two-cranks")


LATER = scene_text("construction/rod-drawn-last")
LATER_BRANCH = '[branches]\n7 = "forward"'
"""A long rod on the other crank, which crosses well and is drawn last."""


def test_a_variant_that_does_not_close_is_nan_and_its_neighbours_are_right():
    """Rods of 1 do not reach the guide from a crank of 2: only they are masked."""
    rods = np.array([3.0, 1.0, 2.5, 1.999, 4.0])
    mechanism = mechanism_of(RODS.replace("[links.4]", LATER).replace("[branches]", LATER_BRANCH))
    batch = mechanism.batch(rod=rods)
    closes = rods > 2
    assert (np.isfinite(batch.margin) == closes).all()
    for quantity in ("position", "velocity", "acceleration"):
        values = getattr(batch.points["B"], quantity)
        assert (np.isfinite(values) == closes).all()
    assert (np.isfinite(batch.links["2"].omega) == closes).all()
    for rod, here in zip(rods[closes], np.flatnonzero(closes), strict=True):
        one = mechanism_of(RODS, rod=float(rod)).solve()
        assert batch.margin[here] == pytest.approx(one.margin, rel=1e-13)
        for point in ("A", "B", "C"):
            for quantity in ("position", "velocity", "acceleration"):
                values = np.broadcast_to(getattr(batch.points[point], quantity), rods.shape)
                expected = getattr(one.points[point], quantity)
                assert values[here] == pytest.approx(expected, rel=1e-13)


@settings(LAW, max_examples=25)
@given(mechanisms(most=2))
def test_no_value_outlives_its_last_use(made):
    """Nor does it die before: what is alive after a step is what is still to be used or kept."""
    program = mechanism_of(made.text(moving=True)).program
    needed, keep = program.needed(program.answers), set(program.targets.values())
    values = {"h": np.zeros(3)}
    ready = made_ready(program, needed, values, sorted(keep))
    moving = [number for number, _ in ready.moving]
    assert set(moving).isdisjoint(ready.values)
    assert set(moving) | set(ready.values) == set(needed)
    alive: set[int] = set()
    for position, (number, dying) in enumerate(ready.moving):
        alive.add(number)
        alive.difference_update(dying)
        to_come = moving[position + 1 :]
        used = {arg for later in to_come for arg in program.steps[later].args}
        assert alive == set(moving[: position + 1]) & (used | keep)


def test_what_hangs_on_no_array_is_worked_out_once():
    """Another speed of the crank moves no point: the positions are shared, the plans are not."""
    text = RODS.replace("rod = 3", "rod = 3\nomega = 1").replace("speed = 1", 'speed = "omega"')
    mechanism = mechanism_of(text)
    omega = np.array([1.0, 2.0, -3.0])
    batch, one = mechanism.batch(omega=omega), mechanism.solve()
    assert batch.points["B"].position == one.points["B"].position
    np.testing.assert_allclose(batch.points["B"].velocity, omega * one.points["B"].velocity)
    np.testing.assert_allclose(
        batch.points["B"].acceleration, omega**2 * one.points["B"].acceleration
    )


def test_a_position_that_no_variant_closes_is_nan_for_all():
    text = RODS.replace("rod = 3", "rod = 1\nomega = 1").replace("speed = 1", 'speed = "omega"')
    batch = mechanism_of(text).batch(omega=np.array([1.0, 2.0]))
    assert np.isnan(batch.points["B"].position)
    assert np.isnan(batch.points["B"].velocity).all()
    assert np.isfinite(batch.points["A"].velocity).all()
    assert np.isnan(batch.margin).all()


def test_a_batch_run_ends_with_what_was_to_be_kept_and_nothing_else():
    mechanism = shipped("pump", 7)
    program = mechanism.program
    needed = program.needed([("acceleration", "D")])
    keep = [program.targets["acceleration", "D"], program.targets["velocity", "B"]]
    values = {"n": np.arange(1.0, 31.0)}
    trace = run_batch(program, needed, values, batch_kind(), keep)
    assert set(trace.values) == set(keep)
    assert trace.margins == {}


def test_the_margin_is_the_sine_of_the_flattest_crossing():
    """The transmission angle of each dyad, in position and in both plans."""
    for name in SHIPPED:
        for n in range(1, 31):
            solution = shipped(name, n).solve()
            p = {point: motion.position for point, motion in solution.points.items()}
            at_b = ((p["B"] - p["A"]) / (p["B"] - p["O2"])).conjugate()
            sines = abs(at_b.imag) / abs(at_b), abs((p["D"] - p["C"]).real) / 0.2
            assert solution.margin == pytest.approx(min(sines), rel=1e-12)


@pytest.mark.parametrize("kind", [float, lambda x: np.array([x, x])])
def test_the_smaller_of_two_numbers_is_unknown_where_one_is(kind):
    nan = float("nan")
    for a, b, smaller in ((1, 2, 1), (2, 1, 1), (nan, 1, nan), (1, nan, nan), (nan, nan, nan)):
        np.testing.assert_array_equal(least(kind(a), kind(b)), kind(smaller))


# --- failures ------------------------------------------------------------------------------------


def test_the_closing_ranges_are_those_of_trigonometry():
    """|r sin(phi)| <= l: up to asin(l/r), to the digits that are printed."""
    text = scene_text("construction/slider-crank").replace("O-A = 1", "O-A = 5")
    with pytest.raises(ClosureError) as caught:
        mechanism_of(text.replace("angle = 60", "angle = 100")).solve()
    words, limit = str(caught.value), np.degrees(np.arcsin(3 / 5))
    assert not re.search(r"None|[{}\[\]]|nan|\(\)|  ", words), words
    assert isinstance(caught.value.__cause__, StepFailed)
    found = [float(number) for number in re.findall(r"(-?[\d.]+)°", words)]
    exact = [-limit, limit, 180 - limit, 180 + limit]
    assert np.abs(np.array(found) - exact).max() <= 0.005
