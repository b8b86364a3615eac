"""The witness: agreement of the right, and every kind of wrong found out."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.construction.core.quantities import PointMotion
from graphkin.construction.core.solution import Solution
from graphkin.loops import newton
from graphkin.loops.witness import compare
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.kinds import ball_kind
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Closure
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import StructureError, WitnessError
from tests.documents.sheet_tools import mechanism_named
from tests.loops.loops_alone import as_solution, by_loops
from tests.scene_files import scene_text


@pytest.fixture
def pump(sheet, solved, pump_start):
    scene = sheet("pump", n=7)
    return scene, as_solution(solved(scene, **pump_start))


def moved(solution, point, **changes):
    """The solution with one point's motion changed."""
    return replace(
        solution, points={**solution.points, point: replace(solution.points[point], **changes)}
    )


def test_agreement(pump):
    verdict = compare(*pump)
    assert verdict.agrees
    assert verdict.largest_difference < 1e-14
    assert verdict.residual < 1e-15
    assert verdict.moved < 1e-15
    assert verdict.branches == ()
    assert verdict.limit == 1e-9


def test_only_what_is_present_is_compared(pump):
    scene, solution = pump
    points = {name: PointMotion(solution.points[name].position) for name in "ABD"}
    bare = Solution(points, {"3": replace(solution.links["3"], instant_centre=None)}, {}, 0.5)
    assert compare(scene, bare).agrees


@pytest.mark.parametrize("point", ["A", "B", "C", "D"])
@pytest.mark.parametrize("quantity", ["velocity", "acceleration"])
def test_a_millionth_is_caught(point, quantity, pump):
    scene, solution = pump
    value = getattr(solution.points[point], quantity)
    verdict = compare(scene, moved(solution, point, **{quantity: value * (1 + 1e-6)}))
    assert not verdict.agrees
    assert verdict.quantity == f"points.{point}.{quantity}"
    assert 1e-8 < verdict.largest_difference < 2e-6


def test_a_wrong_position_is_caught(pump):
    scene, solution = pump
    verdict = compare(scene, moved(solution, "C", position=solution.points["C"].position + 1e-6))
    assert not verdict.agrees
    assert verdict.quantity == "points.C.position"
    assert 1e-7 < verdict.residual < 2e-6
    assert 1e-8 < verdict.moved < 2e-6


@pytest.mark.parametrize("quantity", ["omega", "epsilon"])
def test_a_wrong_link_is_caught(quantity, pump):
    scene, solution = pump
    wrong = replace(solution.links["4"], **{quantity: -getattr(solution.links["4"], quantity)})
    verdict = compare(scene, replace(solution, links={**solution.links, "4": wrong}))
    assert not verdict.agrees
    assert verdict.quantity == f"links.4.{quantity}"


@pytest.mark.parametrize("centre", ["instant_centre", "acceleration_pole"])
def test_a_wrong_centre_is_caught(centre, pump):
    scene, solution = pump
    ratio = getattr(solution.links["3"], centre)
    wrong = Ratio(ratio.start, ratio.shift * (1 + 1e-6), ratio.size)
    links = {**solution.links, "3": replace(solution.links["3"], **{centre: wrong})}
    verdict = compare(scene, replace(solution, links=links))
    assert not verdict.agrees
    assert verdict.quantity == f"links.3.{centre}"


def test_a_solution_without_a_number_does_not_agree(pump):
    scene, solution = pump
    verdict = compare(scene, moved(solution, "D", velocity=complex("nan")))
    assert not verdict.agrees
    assert verdict.quantity == "points.D.velocity"


@pytest.mark.parametrize(
    ("start", "broken"),
    [
        ({"B": 0.25 - 0.15j, "C": 0.3 + 0.1j, "D": 0.45 + 0j}, {"B"}),
        ({"D": -0.06 + 0j}, {"5"}),
    ],
)
def test_a_wrong_branch_is_caught(start, broken, sheet, solved, pump_start):
    scene = sheet("pump", n=7)
    found = solved(scene, **{**pump_start, **start})
    verdict = compare(scene, as_solution(found))
    assert verdict.largest_difference < 1e-12
    assert set(verdict.branches) == broken
    assert not verdict.agrees


SHAPER = scene_text("loops/shaper-2")
RIGHT = {"A": 1 + 0.6j, "B": 1.9 + 3.7j, "C": 3.9 + 3.5j}


def test_coriolis_and_slides_are_held(read, solved):
    scene = read(SHAPER)
    solution = as_solution(solved(scene, **RIGHT))
    assert compare(scene, solution).agrees
    for name, share in (("position", 1), ("speed", 1), ("acceleration", 1), ("coriolis", -1j)):
        slide = solution.slides["2"]
        wrong = replace(slide, **{name: getattr(slide, name) * (share + 1e-6)})
        verdict = compare(scene, replace(solution, slides={**solution.slides, "2": wrong}))
        assert not verdict.agrees
        assert verdict.quantity == f"slides.2.{name}"


def test_the_point_of_a_guide_under_a_block_is_held(read, solved):
    scene = read(SHAPER)
    found = solved(scene, **RIGHT)
    solution = as_solution(found)
    under = found.motion.point("A@3")
    point = PointMotion(*(row[0].item() for row in under))
    assert compare(scene, replace(solution, points={**solution.points, "A@3": point})).agrees
    rider = replace(point, velocity=solution.points["A"].velocity)
    verdict = compare(scene, replace(solution, points={**solution.points, "A@3": rider}))
    assert verdict.quantity == "points.A@3.velocity"
    assert not verdict.agrees


@pytest.mark.parametrize(
    ("start", "broken"),
    [
        ({"B": -1.9 - 9.7j, "C": 0j, "_2": -3.8 + 0j, "_5": 0j}, None),
        ({"C": 0.1 + 3.5j}, ("5",)),
    ],
)
def test_the_other_closure_of_a_slide(start, broken, read, solved):
    """Backwards the lever points down and the ram cannot follow; the ram has its own two."""
    scene = read(SHAPER)
    start = {**RIGHT, **start}
    if broken is None:
        with pytest.raises(WitnessError, match="do not close"):
            solved(scene, **start)
        return
    assert compare(scene, as_solution(solved(scene, **start))).branches == broken


def test_a_backward_block_on_a_swinging_guide(read, solved):
    lever = SHAPER.partition("[links.4]")[0] + SHAPER[SHAPER.index("[[drivers]]") :]
    forward = read(lever.replace('5 = "forward"\n', ""))
    found = solved(forward, A=1 + 0.6j, B=-1.9 - 9.7j, _2=-3.8 + 0j)
    assert found.motion.slide(0).position[0] < 0
    assert compare(forward, as_solution(found)).branches == ("2",)
    backward = read(lever.replace('5 = "forward"\n', "").replace("forward", "backward"))
    assert compare(backward, as_solution(found)).agrees


def test_a_mechanism_at_rest_is_compared_absolutely(read, solved):
    scene = read(SHAPER.replace("speed = 6", "speed = 0"))
    solution = as_solution(solved(scene, **RIGHT))
    assert compare(scene, solution).agrees
    assert not compare(scene, moved(solution, "B", velocity=1e-6 + 0j)).agrees


DEAD = """
[frame]
O = [0, 0]
[links.1]
O-A = 1
[links.2]
A-B = 0.5
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[drivers]]
{}
"""


@pytest.mark.parametrize(
    ("driver", "start"),
    [
        ("turn = 1\nangle = 30\nspeed = 1", {"A": 0.75**0.5 + 0.5j, "B": 0.75**0.5 + 0j}),
        ("turn = 1\nangle = 30\nspeed = 1", {"A": 0.8 + 0.5j, "B": 1.1 + 0j}),
        ("slide = 3\nposition = 1.5\nspeed = 1", {"A": 1 + 0j, "B": 1.5 + 0j}),
    ],
)
def test_a_singular_position_is_named(driver, start, read, solved):
    """The rod square to the guide with the crank driving, in line with it with the slider."""
    with pytest.raises(WitnessError, match=r"singular position.*depends on the driver"):
        solved(read(DEAD.format(driver)), **start)


def test_too_few_drivers_are_named(read, solved):
    scene = read(DEAD.format("slide = 3\nposition = 1\nspeed = 1"))
    with pytest.raises(StructureError, match="1 more driver"):
        solved(replace(scene, drivers=()), B=1 + 0j)


def test_far_from_the_origin_nothing_is_lost(read, solved):
    """Velocities and their comparison count from the mechanism, not from a far origin."""
    far = SHAPER.replace("[0, 0]\nO2 = [0, -3]", "[4096, -8192]\nO2 = [4096, -8195]")
    far = far.replace("through = [0, 3.5]", "through = [4096, -8188.5]")
    home = 4096 - 8192j
    near = solved(read(SHAPER), **RIGHT)
    there = solved(read(far), **{name: z + home for name, z in RIGHT.items()})
    for mine, its in zip(near.motion.points[1:], there.motion.points[1:], strict=True):
        assert abs(mine - its).max() < 1e-12 * abs(mine).max()
    assert compare(read(far), as_solution(there)).agrees


WHEELS = scene_text("loops/wheels")


def test_wheels_are_held(read):
    scene = read(WHEELS)
    solution = by_loops(scene)
    assert compare(scene, solution).agrees
    touch = solution.centres["sun-planet"]
    pitch = touch.start + touch.shift / touch.size
    assert pitch == pytest.approx(solution.points["P"].position * 0.6 / 0.9)
    for name in ("planet", "roller"):
        for quantity in ("omega", "epsilon"):
            value = getattr(solution.links[name], quantity)
            wrong = replace(solution.links[name], **{quantity: value * (1 + 1e-6)})
            verdict = compare(scene, replace(solution, links={**solution.links, name: wrong}))
            assert verdict.quantity == f"links.{name}.{quantity}"
            assert not verdict.agrees


def test_a_wheel_a_tooth_out_is_caught(read):
    """The rim point of the planet turned by the thousandth of a turn, everything else as it was."""
    scene = read(WHEELS)
    solution = by_loops(scene)
    centre, rim = (solution.points[name].position for name in "PQ")
    turned = centre + (rim - centre) * np.exp(2e-3j * np.pi)
    verdict = compare(scene, moved(solution, "Q", position=complex(turned)))
    assert not verdict.agrees
    assert verdict.residual > 1e-4


def test_a_roller_in_its_other_closure_is_caught(read):
    scene = read(WHEELS)
    backward = by_loops(read(WHEELS.replace("forward", "backward")))
    assert compare(scene, backward).branches == ("roller",)


@pytest.mark.parametrize("pair", ["sun-planet", "arm-planet", "planet-roller"])
def test_a_wrong_relative_centre_is_caught(pair, read):
    scene = read(WHEELS)
    solution = by_loops(scene)
    ratio = solution.centres[pair]
    wrong = Ratio(ratio.start + 1e-6, ratio.shift, ratio.size)
    verdict = compare(scene, replace(solution, centres={**solution.centres, pair: wrong}))
    assert verdict.quantity == f"centres.{pair}"
    assert not verdict.agrees


def test_inflection_poles_are_held(pump):
    """Points of the circle on the centre and the pole move straight for an instant."""
    scene, solution = pump
    for name, link in by_loops(scene).links.items():
        if name in ("1", "2", "5"):
            continue
        pole, centre = (
            each.start + each.shift / each.size
            for each in (link.inflection_pole, link.instant_centre)
        )
        at = PointMotion((pole + centre) / 2 + 1j * (pole - centre) / 2)
        turn, epsilon = 1j * link.omega, link.epsilon
        ratio = link.acceleration_pole
        still = ratio.start + ratio.shift / ratio.size
        velocity = turn * (at.position - centre)
        acceleration = (1j * epsilon + turn**2) * (at.position - still)
        across = (velocity.conjugate() * acceleration).imag
        assert abs(across) < 1e-9 * abs(velocity) * abs(acceleration)
        held = replace(solution.links[name], inflection_pole=link.inflection_pole)
        assert compare(scene, replace(solution, links={**solution.links, name: held})).agrees
        wrong = replace(held, inflection_pole=link.inflection_pole._replace(start=pole))
        verdict = compare(scene, replace(solution, links={**solution.links, name: wrong}))
        assert verdict.quantity == f"links.{name}.inflection_pole"


def test_closures_of_a_group_of_class_three_are_counted_unless_told_not_to():
    """The vector loops agree with each closure; that it is the stated one only counting tells."""
    mechanism = mechanism_named("stephenson-3-crank")
    ((name, stated),) = mechanism.scene.branches.items()
    assert isinstance(stated, Closure)
    other = replace(mechanism.scene, branches={name: Closure(stated.number + 1)})
    solution = mechanism.solve()
    assert compare(other, solution, numbered=False).agrees
    assert compare(other, solution).branches == (name,)
    assert compare(mechanism.scene, solution).agrees


LAWS = {
    "sum": ("deg", "18000*t + 2*sin(36000*t + 10.7)"),
    "sine of a product": ("deg", "90 + 40*sin(36000*pi*t)"),
    "radians": ("rad", "1800*t + 0.2"),
    "multiple of pi": ("rad", "1800*pi*t + sqrt(2)"),
    "difference": ("deg", "40 + 5*((t + sqrt(2))**3 - t**3)/t**2"),
}


@pytest.mark.parametrize("time", [0.3, 100.3, 1e4, 1e6])
@pytest.mark.parametrize("law", LAWS)
def test_no_digit_is_claimed_that_the_value_of_a_law_of_time_has_lost(law, time):
    unit, text = LAWS[law]
    text = scene_text("loops/law-of-time", unit=unit, law=text, time=time)
    mechanism = Mechanism(read_text(text, "law", None, {}))
    solution, kind = mechanism.solve(), ball_kind(300)
    balls, digits = mechanism.trace(kind=kind), mechanism.witness(solution).digits
    for quantity in ("position", "velocity", "acceleration"):
        for name in "AB":
            ball = balls.value(quantity, name)
            sure = complex(float(ball.real.mid()), float(ball.imag.mid()))
            error = abs(getattr(solution.points[name], quantity) - sure) / abs(sure)
            assert error <= 10.0 ** -digits.get(quantity, 0), (name, quantity)
    if law in ("sum", "radians"):  # and no more are given up than the phase has taken
        assert digits["position"] >= 11 - np.log10(max(1800 * time, 1))


@pytest.mark.parametrize("name", ["cam-tangent", "oldham", "bar-on-drive-roller"])
def test_a_link_that_its_driver_turns_evenly_does_not_accelerate_in_the_loops(name):
    """Elimination alone leaves it the rounding of the other equations, and costs two digits."""
    mechanism = load(f"examples/scenes/{name}.toml")
    solution = mechanism.solve()
    motion = mechanism.check.examine(solution).solved.motion
    (driver,) = mechanism.scene.drivers
    k = motion.index[driver.link]
    assert abs(motion.epsilon[0, k]) <= 1e-24 * motion.omega[0, k] ** 2
    assert mechanism.witness(solution).digits["acceleration"] >= 12


@pytest.mark.parametrize("name", ["cylinders-two", "gears-rack", "belts-arm"])
def test_the_check_of_what_is_asked_searches_no_closure(name):
    """The lengths of driven cylinders, and how far wheels have turned, lead to every angle."""
    mechanism = mechanism_named(name)
    found = mechanism.check.examine(mechanism.solve(asked=True))
    assert found.guessed == ()


def test_wheels_are_put_in_order_once(monkeypatch):
    """Further checks of one mechanism solve for the positions alone."""
    mechanism = mechanism_named("gears-rack")
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    monkeypatch.setattr(newton, "stages", None)
    monkeypatch.setattr(newton, "settles", None)
    assert mechanism.witness(solution).agrees
