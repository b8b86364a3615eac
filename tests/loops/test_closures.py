"""Groups from the joints alone, and the closures of a group of higher class in their order."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.accuracy.certified import Certifier
from graphkin.loops.assemble import assembled, closures, moved_by, settled_of
from graphkin.loops.closing_groups import groups
from graphkin.loops.equations import equations
from graphkin.loops.newton import gap, newton, scaled
from graphkin.loops.witness import compare
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Closure
from tests.loops.loops_alone import as_solution
from tests.scene_files import scene_text

RAPID_RETURN = scene_text("loops/rapid-return-2")


def residual(theta):
    """Height of the lever's end over its guide, the lever through the crank pin at 35 degrees."""
    q = math.radians(35)
    low = math.sin(q) - math.cos(q) * math.tan(theta)
    x, y = 6 * math.cos(theta), low + 6 * math.sin(theta)
    return (y - 2) - (x + 2) * math.tan(math.radians(20))


def roots():
    """Angles of the lever from 0 to 360 degrees, by a scan and bisection."""
    found, steps = [], 7200
    for i in range(steps):
        a, b = 2 * math.pi * i / steps, 2 * math.pi * (i + 1) / steps
        if residual(a) * residual(b) < 0 and abs(residual(a)) < 1:
            for _ in range(60):
                middle = (a + b) / 2
                a, b = (a, middle) if residual(a) * residual(middle) <= 0 else (middle, b)
            found.append((a + b) / 2)
    return found


def test_groups_of_the_pump(sheet):
    scene = sheet("pump", n=7)
    found = groups(scene, equations(scene))
    assert [set(group.links) for group in found] == [{"2", "3"}, {"4", "5"}]
    assert all(group.is_dyad for group in found)


def test_a_group_of_class_three_and_the_dyad_behind_it(read):
    scene = read(RAPID_RETURN)
    found = groups(scene, equations(scene))
    assert [set(group.links) for group in found] == [{"2", "3", "4", "5"}, {"6", "7"}]
    assert [group.is_dyad for group in found] == [False, True]


@pytest.mark.parametrize("number", range(1, len(roots()) + 1))
def test_closures_are_counted_by_the_angle_of_the_lever(number, read, solved):
    theta = roots()[number - 1]
    q = math.radians(35)
    low = complex(0, math.sin(q) - math.cos(q) * math.tan(theta))
    bar = complex(math.cos(theta), math.sin(theta))
    end = low + 6 * bar
    assert abs(4 - end.imag) < 12
    rod = complex(math.sqrt(144 - (4 - end.imag) ** 2), 4 - end.imag)
    scene = read(RAPID_RETURN)
    start = {"A": complex(math.cos(q), math.sin(q)), "P": low, "Q": end, "R": end + rod}
    solution = as_solution(solved(scene, **start))
    stated = replace(scene, branches={**scene.branches, "2": Closure(number)})
    assert compare(stated, solution).agrees
    other = replace(scene, branches={**scene.branches, "2": Closure(number % 4 + 1)})
    verdict = compare(other, solution)
    assert verdict.branches == ("2",)
    assert not verdict.agrees


def test_the_lever_has_several_closures():
    assert len(roots()) in (2, 4)


CLASS_III = scene_text("loops/class-iii")
DEAD_POINT = Fraction("101.48486907497565")
"""The driver's angle at which the fourth and fifth of the six closures meet, in degrees."""


@pytest.mark.parametrize("beyond", [5, 9, 12])
def test_half_closed_positions_are_no_closures(beyond, read):
    """Beside the dead point of two closures loops nearly close all around them; the sixth is sound.

    At 1e-12 degrees rounding hides whether the two are one: the sixth may then be the fifth.
    """
    angle = DEAD_POINT + Fraction(1, 10**beyond)
    scene = read(CLASS_III.replace("ANGLE", f"{angle.numerator}/{angle.denominator}"))
    verdict = compare(scene, Mechanism(scene).solve())
    assert verdict.branches == ()
    assert verdict.agrees


@pytest.mark.parametrize("beyond", [5, 13])
def test_digits_are_those_of_the_closure_that_has_the_number(beyond, read):
    """At 1e-13 degrees doubles see five closures: the fifth of theirs is the sixth in truth."""
    angle = DEAD_POINT + Fraction(1, 10**beyond)
    text = CLASS_III.replace("ANGLE", f"{angle.numerator}/{angle.denominator}")
    mechanism = Mechanism(read(text.replace("closure 6", "closure 5")))
    place = Certifier.of(mechanism).run(128).trace.value("position", "A")
    found = mechanism.trace([("position", "A")]).value("position", "A")
    ball = complex(float(place.real.mid()), float(place.imag.mid()))
    assert ball.imag > 0 > solved_at(read, text).imag
    assert abs(ball - found) < 1e-6


def solved_at(read, text: str) -> complex:
    """Where A stands in the sixth closure."""
    return Mechanism(read(text)).trace([("position", "A")]).value("position", "A")


@pytest.mark.parametrize("off", [1e-5, 1e-8, 1e-11])
def test_a_nearly_closed_position_is_led_on_to_the_closure(off, read):
    """However far the unknowns of its group are off: none is lost, all end where they closed."""
    scene = read(CLASS_III.replace("ANGLE", "102"))
    part = equations(scene)
    (group,) = groups(scene, part)
    moving = moved_by(part, group)
    found = closures(part, assembled(scene, part), group)
    pushed = found + off * moving * np.cos(np.arange(found.size)).reshape(found.shape)
    assert len(found) > 1
    assert settled_of(part, pushed, moving) == pytest.approx(found, abs=1e-9)


def test_each_of_many_starts_goes_its_own_way(read):
    """Each comes as far in four steps of Newton's method as it does alone, the first as any."""
    scene = read(RAPID_RETURN)
    loops = equations(scene)
    thrown = np.random.default_rng(3).uniform(-3, 3, (6, loops.unknown_count))
    found, _ = newton(loops, thrown, most=4)
    assert np.abs(found - thrown).max(axis=1).min() > 0.1
    for start, end in zip(thrown, found, strict=True):
        alone, _ = newton(loops, start[None], most=4)
        assert end == pytest.approx(alone[0], abs=1e-6)


def test_a_step_is_no_longer_than_half_a_radian_and_keeps_its_direction(read):
    """Held against one solved for itself; one that is shorter stays as long as it is."""
    loops = equations(read(RAPID_RETURN))
    thrown = np.random.default_rng(3).uniform(-3, 3, (40, loops.unknown_count))
    ends = newton(loops, thrown)[0]
    near = ends[np.abs(scaled(loops, ends)[0]).max(axis=1) < 1e-9] + 1e-3
    for start in (thrown, near):
        residual, jacobian = scaled(loops, start)
        step = -np.linalg.solve(jacobian, residual[:, :, None])[:, :, 0]
        length = np.abs(step).max(axis=1)[:, None]
        assert (length.min() > 0.5) == (start is thrown)
        moved = (newton(loops, start, most=1)[0] - start) / loops.columns
        assert moved == pytest.approx(step * np.minimum(1, 0.5 / length), abs=1e-9)


def test_how_far_a_driver_is_off_is_measured_on_the_longest_bar(read):
    """A crank of 40 m a tenth of a radian beyond its angle: its end is 4 m off along its arc."""
    crank = "frame.O = [0, 0]\nlinks.1.O-A = 40\n[[drivers]]\nturn = 1\nangle = 30\nspeed = 1\n"
    loops = equations(read(crank))
    beyond = np.array([[math.radians(30) + 0.1]])
    assert gap(loops, beyond) == pytest.approx([4.0])
    assert gap(loops, beyond - 0.1) == pytest.approx([0], abs=1e-15)


STRETCHED = """
[frame]
O = [0, 0]
G = ["3 - 1/10^BEYOND", 0]
[links.1]
O-A = 1
[links.2]
A-B = 1
[links.3]
G-B = 1
[[drivers]]
turn = 1
angle = 0
speed = 1
[branches]
B = "left of A-G"
"""


@pytest.mark.parametrize(("beyond", "told"), [(12, True), (14, False), (15, False)])
def test_beside_a_dead_point_neither_side_is_refused_where_rounding_hides_which(beyond, told, read):
    """A coupler and a rocker in line up to 1e-n m: B stands √10⁻ⁿ m aside, as far as ε/√10⁻ⁿ."""
    scene = read(STRETCHED.replace("10^BEYOND", str(10**beyond)))
    solution = Mechanism(scene).solve()
    assert solution.points["B"].position.imag == pytest.approx(10 ** (-beyond / 2), rel=0.1)
    other = replace(scene, branches={"B": replace(scene.branches["B"], side=-1)})
    assert compare(scene, solution).branches == ()
    assert compare(other, solution).branches == (("B",) if told else ())
