"""Jerks by the chain rule over the steps, against closed forms, the loops, and other routes."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.loops import differences
from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.motion.extremes import all_extremes
from graphkin.numbers.kinds import decimal_kind
from graphkin.scene.quantity import exact
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.chosen import FOLDER

CHOSEN = (
    *("shaper", "cam-roller", "cam-flat", "cam-lever", "cam-plate", "geneva-wheel", "plates-ring"),
    *("gears-planet", "excavator-relative", "roller", "wheel-in-ring-rod", "belts-arm", "oldham"),
    *("platform-3rpr", "jumper", "oscillating-slide", "stephenson-3", "cam-rocker", "trammel"),
)
CRANK = """graphkin = 1
title = "slider-crank"
units = {{ length = "m", angle = "{unit}", speed = "rad/s" }}
{time}
[frame]
O = [0, 0]
[links.1]
O-A = 0.05
[links.2]
A-B = 0.2
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[drivers]]
turn = 1
angle = {angle}
{rest}
[branches]
3 = "forward"
[ask]
jerk = ["A", "B"]
"""
DIGITS = 50


def jerking(mechanism: Mechanism) -> Mechanism:
    """The same mechanism, asked for the jerk of every point of a link."""
    scene = mechanism.scene
    points = dict.fromkeys(p for link in scene.links.values() for p in link.points)
    asked = tuple(p for p in points if p not in scene.cam_centres)
    return Mechanism(replace(scene, ask=replace(scene.ask, jerk=asked)))


def example(name: str) -> Mechanism:
    return load(FOLDER / f"{name}.toml")


def mechanism_of(text: str) -> Mechanism:
    return Mechanism(read_text(text, "slider-crank", None, {}))


@pytest.mark.parametrize("name", CHOSEN)
def test_the_loops_differentiated_once_more_agree_with_the_steps(name):
    mechanism = jerking(example(name))
    solution = mechanism.solve()
    verdict = mechanism.witness(solution, numbered=False)
    assert verdict.agrees, (verdict.quantity, verdict.largest_difference)
    assert any(point.jerk for point in solution.points.values())
    assert verdict.digits["jerk"] >= 4


@pytest.mark.parametrize("angle", [0, 30, 75, 180, 290])
def test_fifty_digits_agree_with_a_closed_form_differentiated_thrice(angle):
    """B is at r·cos φ + sqrt(l² - r²·sin² φ); mpmath differentiates that by its own route."""
    mechanism = mechanism_of(CRANK.format(unit="deg", time="", angle=angle, rest="speed = 7"))
    found = mechanism.trace([("jerk", "B")], kind=decimal_kind(DIGITS)).value("jerk", "B")
    with mpmath.workdps(4 * DIGITS):
        r, rod = mpmath.mpf("0.05"), mpmath.mpf("0.2")

        def place(t: mpmath.mpf) -> mpmath.mpf:
            phi = mpmath.radians(angle) + 7 * t
            return r * mpmath.cos(phi) + mpmath.sqrt(rod**2 - (r * mpmath.sin(phi)) ** 2)

        third = mpmath.diff(place, 0, 3)
        assert abs(found.real - third) < mpmath.mpf(10) ** (4 - DIGITS) * (1 + abs(third))
        assert abs(found.imag) < mpmath.mpf(10) ** (4 - DIGITS)


@pytest.mark.parametrize("name", ["shaper", "cam-roller", "stephenson-2-binary", "rapid-return"])
def test_fifty_digits_agree_with_differences_of_positions(name):
    """Third differences of positions alone, in 150 digits, along the driver's own motion."""
    mechanism = jerking(example(name))
    scene = mechanism.scene
    (driver,) = scene.drivers
    kind, step = decimal_kind(3 * DIGITS), Fraction(1, 10**14)
    assert driver.acceleration.is_zero()
    assert driver.kind == "turn"
    points = [p for p in scene.ask.jerk if p not in scene.frame.points]
    turned = driver.position.number(scene.values) * (1 if driver.position.unit == "deg" else 0)
    weights = {-3: 1, -2: -8, -1: 13, 1: -13, 2: 8, 3: -1}
    sums: dict[str, object] = dict.fromkeys(points, 0)
    for k, weight in weights.items():
        at = exact(Fraction(turned) + k * step, "deg")
        moved = Mechanism(replace(scene, drivers=(replace(driver, position=at),)))
        trace = moved.trace([("position", p) for p in points], kind=kind)
        sums = {p: sums[p] + weight * trace.value("position", p) for p in points}
    trace = mechanism.trace([("jerk", p) for p in points], kind=kind)
    context = kind.pi.context
    radians = context.mpf(step.numerator) / step.denominator * kind.pi / 180
    pace = driver.speed.si(scene.values_in(kind), kind) / radians
    for point in points:
        expected, found = sums[point] * pace**3 / 8, trace.value("jerk", point)
        assert abs(found - expected) < 1e-24 * (1 + abs(expected)), point


@pytest.mark.parametrize("name", ["crank-rocker", "cam-plate", "gears-ring", "plates-coupled"])
def test_a_batch_is_the_same_as_one_scene_after_another(name):
    """The batch runs on emitted source; the single scene on Python's own numbers."""
    mechanism = jerking(example(name))
    found = cycle(mechanism, steps=8)
    place, row = mechanism.solve(), int(np.argmin(np.abs(found.at - found.at[0])))
    own = Mechanism(found.path.ranges[0][0].course.standing(float(found.at[row])))
    expected = own.solve()
    for point in mechanism.scene.ask.jerk:
        one, many = expected.points[point].jerk, found.solution.points[point].jerk
        value = np.broadcast_to(many, found.at.shape)[row]
        assert value == pytest.approx(one, rel=1e-7, abs=1e-7), point
    assert place.points.keys() == found.solution.points.keys()


def test_a_law_of_time_gives_its_third_derivative():
    """φ = t³ at t = 1: the crank's pin has j = r(iφ⃛ - 3φ̇φ̈ - iφ̇³)e^{iφ}."""
    text = CRANK.format(unit="rad", time="time = 1", angle='"t**3"', rest="")
    mechanism = mechanism_of(text)
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    turn = np.exp(1j)
    expected = 0.05 * (6j - 3 * 3 * 6 - 27j) * turn
    assert solution.points["A"].jerk == pytest.approx(expected, rel=1e-13)


def test_an_accelerated_driver_has_no_jerk_of_its_own():
    text = CRANK.format(unit="deg", time="", angle=0, rest="speed = 3\nacceleration = 2")
    found = mechanism_of(text).solve().points["A"].jerk
    assert found == pytest.approx(0.05 * (-3 * 3 * 2 - 27j), rel=1e-13)


def test_a_steady_crank_pin_keeps_its_jerk_and_the_piston_has_extremes():
    mechanism = mechanism_of(CRANK.format(unit="deg", time="", angle=0, rest="speed = 7"))
    ((*found,),) = all_extremes(cycle(mechanism, steps=24))
    jerks = {each.measure.of: each for each in found if each.measure.name == "jerk"}
    assert jerks["A"].is_constant
    assert jerks["A"].largest.value == pytest.approx(0.05 * 7**3)
    assert jerks["B"].least.value == 0
    assert [p.at for p in jerks["B"].least.places] == pytest.approx([0, 180], abs=1e-6)


def test_a_wrong_jerk_is_refused(monkeypatch):
    mechanism = jerking(example("shaper"))
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    original = differences.jerks

    def off(solved):
        found = original(solved)
        return replace(found, found=found.found * (1 + 1e-6))

    monkeypatch.setattr(differences, "jerks", off)
    verdict = mechanism.witness(solution)
    assert not verdict.agrees
    assert verdict.quantity.endswith("jerk")


@pytest.mark.parametrize("name", ["shaper", "geneva-wheel", "oscillating-slide"])
def test_the_jerk_under_a_point_is_that_of_a_point_fixed_to_the_link(name):
    """A rigid body has j = j_O + (iε̇ - 3ωε - iω³)·r; ε̇ is taken from neighbouring positions."""
    mechanism = example(name)
    under = next(p for p in mechanism.scene.ask.velocity if "@" in p)
    point, link = under.split("@")
    scene = mechanism.scene
    origin = scene.links[link].points[0]
    assert origin in scene.fixed_points
    asked = replace(scene.ask, jerk=(under,), epsilon=(link,), velocity=(under, point))
    (driver,) = scene.drivers
    rate = float(driver.speed.si(scene.values))

    def at(turn: float):
        here = float(driver.position.number(scene.values))
        moved = replace(driver, position=replace(exact(here + turn), unit="deg"))
        return Mechanism(replace(scene, ask=asked, drivers=(moved,))).solve()

    here = at(0.0)
    step = 0.01
    epsilons = [at(k * step).links[link].epsilon for k in (-2, -1, 1, 2)]
    twist = np.dot(epsilons, [1, -8, 8, -1]) / (12 * np.radians(step)) * rate
    motion = here.links[link]
    arm = here.points[point].position - here.points[origin].position
    swing = 1j * twist - 3 * motion.omega * motion.epsilon - 1j * motion.omega**3
    assert here.points[under].jerk == pytest.approx(swing * arm, rel=1e-7)
    own = Mechanism(replace(scene, ask=asked))
    assert own.witness(own.solve()).agrees


def test_a_wrong_jerk_under_a_point_is_refused(monkeypatch):
    scene = example("shaper").scene
    mechanism = Mechanism(replace(scene, ask=replace(scene.ask, jerk=("A@3",))))
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    original = differences.jerks

    def off(solved):
        found = original(solved)
        return replace(found, swing=found.swing * (1 + 1e-6))

    monkeypatch.setattr(differences, "jerks", off)
    assert mechanism.witness(solution).quantity == "points.A@3.jerk"


@pytest.mark.parametrize(("name", "wrong"), [("cam-roller", "K")])
def test_points_of_no_link_have_no_jerk(name, wrong):
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    with pytest.raises(SceneError, match=r"ask\.jerk"):
        mechanism_of(text.replace("[ask]", f'[ask]\njerk = ["{wrong}"]'))
