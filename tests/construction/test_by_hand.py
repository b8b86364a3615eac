"""Law of the two faces: what a hand draws is what the composite step says."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given, settings

from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.solution import gathered
from graphkin.mechanism import load
from graphkin.numbers.plane import Ratio
from tests.mechanisms import LAW, SHIPPED, mechanism_of, mechanisms, shipped
from tests.scene_files import scene_text

CLOSE = 1e-9


def slider_crank(angle: float, speed: float, acceleration: float):
    """A slider-crank at an angle of its crank."""
    values = {"angle": angle, "speed": speed, "acceleration": acceleration}
    return mechanism_of(scene_text("construction/slider-crank-speeding-up", **values))


def largest(trace, plane: Plane) -> float:
    """The greatest distance of two points of one drawing."""
    spots = [
        value
        for number, value in trace.values.items()
        if trace.program.steps[number].plane is plane and isinstance(value, complex)
        if not trace.program.steps[number].hand
    ]
    return max(abs(p - q) for p, q in combinations(spots, 2))


def assert_hand_and_value_agree(mechanism) -> set[Part]:
    """Every composite step whose hand's way could be drawn; gives the parts in which one was."""
    trace = mechanism.trace(by_hand=True)
    seconds = trace.values.get(mechanism.program.seconds, 1.0)
    lengths = largest(trace, Plane.MECHANISM)
    pulls = max(largest(trace, Plane.ACCELERATIONS), lengths / seconds**2)
    sizes = {
        Part.POSITION: lengths,
        Part.VELOCITY: largest(trace, Plane.VELOCITIES),
        Part.NORMAL: pulls,
        Part.ACCELERATION: pulls,
    }
    seen = set()
    for number, value in trace.values.items():
        step = mechanism.program.steps[number]
        if step.by_hand is None or step.by_hand not in trace.values:
            continue
        seen.add(step.part)
        drawn = trace.values[step.by_hand]
        if isinstance(value, Ratio):
            slack = lengths / trace.margins[step.by_hand] + abs(drawn - value.start)
            left = (drawn - value.start) * value.size - value.shift
            assert abs(left) <= CLOSE * slack * abs(value.size) / trace.margins[step.by_hand]
        else:
            assert abs(drawn - value) <= CLOSE * sizes[step.part], step
    return seen


@settings(LAW, max_examples=40)
@given(mechanisms())
def test_the_hands_way_and_the_value_of_every_composite_step_agree(made):
    assert_hand_and_value_agree(made.mechanism())


def test_where_c_lies_on_ab_no_two_perpendiculars_are_drawn():
    """They would be one line: the similarity theorem alone gives c and c′."""
    for n in range(1, 31):
        mechanism = shipped("pump-collinear", n)
        program = mechanism.program
        for quantity in ("velocity", "acceleration"):
            step = program.steps[program.targets[quantity, "C"]]
            assert (step.action.key, step.by_hand) == ("similar-point", None)
        place = program.steps[program.targets["position", "C"]]
        assert program.steps[place.by_hand].action.key == "step-along"
        assert Part.NORMAL in assert_hand_and_value_agree(mechanism)


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("scale", [0.5, 1.0, 3.0])
def test_the_right_triangle_gives_the_normal_component_at_any_scale_with_ka_kv_squared_over_kl(
    name, scale
):
    mechanism = shipped(name, 7)
    omega = mechanism.solve().links["1"].omega
    trace = mechanism.trace(by_hand=True, seconds=scale / omega)
    steps = mechanism.program.steps
    normals = [n for n in trace.values if steps[n].by_hand and steps[n].part is Part.NORMAL]
    assert len(normals) >= 3
    for number in normals:
        drawn = trace.values[steps[number].by_hand]
        assert drawn == pytest.approx(trace.values[number], rel=1e-12)


def test_the_right_triangle_is_figure_4_of_the_lab():
    """Velocity square to the bar, square corner at its tip, turned over about the pin."""
    mechanism = shipped("pump", 7)
    trace = mechanism.trace(by_hand=True)
    value = {mechanism.program.steps[n].name: v for n, v in trace.values.items()}
    a, b = value["A"], value["B"]
    tip, cut, end = value["B″_BA"], value["B‴_BA"], value["B⁗_BA"]
    assert abs(((tip - b) / (b - a)).real) < 1e-14
    assert abs(((cut - tip) / (tip - a)).real) < 1e-14
    assert abs(((cut - b) / (b - a)).imag) < 1e-14
    assert ((cut - b) / (b - a)).real > 0
    assert end - b == pytest.approx(b - cut)
    assert abs(tip - b) ** 2 == pytest.approx(abs(b - a) * abs(cut - b))


@pytest.mark.parametrize("angle", [0, 90, 180, 270])
@pytest.mark.parametrize("acceleration", [0, 3])
def test_where_a_hand_cannot_draw_the_value_stands_alone(angle, acceleration):
    """Dead points, where v_B = 0, and instants of translation: no crossing of normals there."""
    mechanism = slider_crank(angle, 2, acceleration)
    trace = mechanism.trace(by_hand=True)
    assert_hand_and_value_agree(mechanism)
    centre = trace.value("centre", "2")
    b, velocity = trace.value("position", "B"), trace.value("velocity", "B")
    if angle in (0, 180):
        assert abs(velocity) < 1e-15
        assert centre.start + centre.shift / centre.size == pytest.approx(b)
    else:
        assert (centre.size, abs(trace.value("omega", "2"))) == (0, 0)
        assert centre.shift.real == 0


@pytest.mark.parametrize("acceleration", [0, 3])
def test_a_crank_momentarily_at_rest_is_drawn_at_the_scale_one(acceleration):
    mechanism = slider_crank(40, 0, acceleration)
    trace = mechanism.trace(by_hand=True)
    assert trace.values[mechanism.program.seconds] == 1.0
    assert trace.value("velocity", "B") == 0
    assert (trace.value("acceleration", "B") == 0) == (acceleration == 0)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_flat_crossing_that_only_the_hand_uses_does_not_count_for_the_margin(name):
    flatter = 0
    for n in range(1, 31):
        mechanism = shipped(name, n)
        trace = mechanism.trace(by_hand=True)
        assert gathered(trace, ()).margin == mechanism.solve().margin
        flatter += min(trace.margins.values()) < mechanism.solve().margin
    assert flatter


@pytest.mark.parametrize("name", SHIPPED)
def test_what_was_run_before_changes_nothing(name):
    """For other targets, and at another scale at which velocities are set on the mechanism."""
    mechanism, other = load(name, n=7), load(name, n=7)
    mechanism.trace(mechanism.asked())
    mechanism.trace(by_hand=True, seconds=0.02)
    again, fresh = (each.trace(by_hand=True, seconds=0.3) for each in (mechanism, other))
    assert again.values == fresh.values
    assert again.margins == fresh.margins
