"""How the motion changes when the mechanism is made larger, driven faster, turned or mirrored."""

from __future__ import annotations

from cmath import rect

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from msgspec.structs import replace

from graphkin.construction.core.program import Plane
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.plane import Ratio, Vector
from graphkin.scene.quantity import exact
from tests.chosen import FOLDER
from tests.mechanisms import LAW, SHIPPED, angles, log_scaled, mechanisms, shipped, signs

CLOSE = 1e-9
POWERS = st.sampled_from((2.0, 0.5, 8.0, 2.0**-10, 2.0**20))
"""Factors by which floating point multiplies without rounding, so that a law holds exactly."""


class Motion:
    """Every quantity of a solved mechanism, by kind and name."""

    def __init__(self, mechanism: Mechanism) -> None:
        solution = mechanism.solve()
        points, links = solution.points.items(), solution.links.items()
        self.positions = {name: p.position for name, p in points}
        self.velocities = {name: p.velocity for name, p in points}
        self.accelerations = {name: p.acceleration for name, p in points}
        self.omegas = {name: link.omega for name, link in links}
        self.epsilons = {name: link.epsilon for name, link in links}


def assert_equal(found, expected, change, size=None) -> None:
    """The quantities are those of another mechanism, changed; exactly when no size is given."""
    for name, value in expected.items():
        if size is None:
            assert found[name] == change(value), name
        else:
            assert abs(found[name] - change(value)) <= CLOSE * size, name


def largest(values) -> float:
    """The largest magnitude among some quantities."""
    return max(abs(value) for value in values.values())


def drawn(mechanism: Mechanism) -> dict[int, object]:
    """Every point and arrow as drawn, in metres of the mechanism at kv = ω·kL, ka = ω²·kL."""
    trace = mechanism.trace(by_hand=True)
    seconds = trace.values[trace.program.seconds]
    powers = {Plane.MECHANISM: 0, Plane.VELOCITIES: 1, Plane.ACCELERATIONS: 2}
    found: dict[int, object] = {}
    for number, value in trace.values.items():
        step = trace.program.steps[number]
        if step.plane is Plane.NUMBERS or isinstance(value, float | Ratio):
            continue
        scale = seconds ** powers[step.plane]
        if isinstance(value, complex):
            found[number] = value * scale
        elif isinstance(value, Vector):
            found[number] = value.tail * scale, value.tip * scale
    return found


@LAW
@given(mechanisms(), POWERS)
def test_a_crank_k_times_as_fast_gives_k_times_the_velocities_k_squared_the_accelerations(made, k):
    """Exactly so, with ε growing as k² where there is any."""
    slow, fast = Motion(made.mechanism()), Motion(made.sped(k).mechanism())
    assert fast.positions == slow.positions
    assert_equal(fast.velocities, slow.velocities, lambda v: k * v)
    assert_equal(fast.omegas, slow.omegas, lambda omega: k * omega)
    assert_equal(fast.accelerations, slow.accelerations, lambda a: k * k * a)
    assert_equal(fast.epsilons, slow.epsilons, lambda epsilon: k * k * epsilon)


@LAW
@given(mechanisms(), log_scaled(1e-3, 1e3), signs())
def test_the_same_for_any_k_also_backwards(made, size, sign):
    """Turned backwards, the velocities change their sense and the accelerations do not."""
    k = size * sign
    slow, fast = Motion(made.mechanism()), Motion(made.sped(k).mechanism())
    speed, most = size * largest(slow.velocities), size**2 * largest(slow.accelerations)
    assert_equal(fast.velocities, slow.velocities, lambda v: k * v, speed)
    assert_equal(fast.accelerations, slow.accelerations, lambda a: k * k * a, most)


def faster(name: str, k: int, **accelerations: int) -> Mechanism:
    """An example with its drivers k times as fast, their accelerations growing with the square, or
    as given."""
    scene = load(str(FOLDER / f"{name}.toml")).scene
    drivers = []
    for driver in scene.drivers:
        speed, push = driver.speed, driver.acceleration
        more = accelerations.get("acceleration", push.number({}) * k**2)
        changed = exact(speed.number({}) * k, speed.unit), exact(more, push.unit)
        drivers.append(replace(driver, speed=changed[0], acceleration=changed[1]))
    return Mechanism(replace(scene, drivers=tuple(drivers)))


HIGHER = ("platform-3rpr", "platform-six", "wheel-in-ring-rod", "stephenson-3-crank")
"""Groups of higher class that drivers within them or before them move."""


@pytest.mark.parametrize("name", HIGHER)
@pytest.mark.parametrize("k", [10**3, 10**6, 10**9])
def test_drivers_in_a_group_of_higher_class_may_be_of_any_speed(name, k):
    slow, fast = Motion(faster(name, 1)), Motion(faster(name, k))
    speed, most = k * largest(slow.velocities), k**2 * largest(slow.accelerations)
    for found, expected, power, size in (
        (fast.velocities, slow.velocities, k, speed),
        (fast.accelerations, slow.accelerations, k**2, most),
    ):
        for point, value in expected.items():
            assert abs(found[point] - power * value) <= 1e-12 * size, point


@pytest.mark.parametrize("name", HIGHER)
def test_an_acceleration_far_larger_than_the_speeds_loses_no_digit(name):
    """Of accelerations a thousand million times as large the part by speeds is rounding."""
    least, most = (Motion(faster(name, 1, acceleration=10**n)) for n in (15, 18))
    size = largest(most.accelerations)
    for point, value in least.accelerations.items():
        assert abs(most.accelerations[point] - 1000 * value) <= 1e-9 * size, point


@LAW
@given(mechanisms(steady=True), POWERS)
def test_at_constant_speed_the_drawn_plans_do_not_change_at_all_with_the_speed(made, k):
    assume(len(made.drivers) == 1)
    assert drawn(made.sped(k).mechanism()) == drawn(made.mechanism())


@pytest.mark.parametrize("name", SHIPPED)
def test_the_crank_pins_image_is_drawn_as_long_as_the_crank(name):
    for n in range(1, 31):
        mechanism = shipped(name, n)
        marks, targets = drawn(mechanism), mechanism.program.targets
        for quantity in ("velocity", "acceleration"):
            assert abs(marks[targets[quantity, "A"]]) == pytest.approx(0.3, rel=1e-15)


@LAW
@given(mechanisms(), POWERS)
def test_a_mechanism_k_times_as_large_has_k_times_the_motion_and_the_same_omegas(made, k):
    small, large = Motion(made.mechanism()), Motion(made.scaled(k).mechanism())
    assert large.omegas == small.omegas
    assert large.epsilons == small.epsilons
    assert_equal(large.positions, small.positions, lambda p: k * p)
    assert_equal(large.velocities, small.velocities, lambda v: k * v)
    assert_equal(large.accelerations, small.accelerations, lambda a: k * a)


@LAW
@given(mechanisms(), angles(-180, 180))
def test_a_mechanism_turned_as_a_whole_moves_as_before_turned(made, angle):
    unit = rect(1, angle)
    before, after = Motion(made.mechanism()), Motion(made.turned(unit).mechanism())
    assert_moved(before, after, lambda u: unit * u, 1)


@LAW
@given(mechanisms())
def test_the_image_in_a_mirror_turns_the_other_way(made):
    before, after = Motion(made.mechanism()), Motion(made.mirrored().mechanism())
    assert_moved(before, after, complex.conjugate, -1)


@LAW
@given(mechanisms(), st.sampled_from((1 + 0j, -3 - 40j, 500j)))
def test_where_the_origin_lies_does_not_matter(made, way):
    by = way * max(abs(place) for place in made.places.values())
    before, after = Motion(made.mechanism()), Motion(made.shifted(by).mechanism())
    assert_moved(before, after, lambda u: u, 1, by)


def assert_moved(before: Motion, after: Motion, way, sense: int, by: complex = 0j) -> None:
    """Vectors are carried along by ``way``; angular quantities keep or change their sense."""
    speed, most = largest(before.velocities), largest(before.accelerations)
    omega, epsilon = largest(before.omegas), largest(before.epsilons)
    epsilon = max(epsilon, omega**2)
    length = largest(before.positions) + abs(by)
    assert_equal(after.positions, before.positions, lambda p: way(complex(p)) + by, length)
    assert_equal(after.velocities, before.velocities, lambda v: way(complex(v)), speed)
    assert_equal(after.accelerations, before.accelerations, lambda a: way(complex(a)), most)
    assert_equal(after.omegas, before.omegas, lambda turning: sense * turning, omega)
    assert_equal(after.epsilons, before.epsilons, lambda twist: sense * twist, epsilon)
