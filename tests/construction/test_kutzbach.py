"""Kutzbach's plan of gear trains: tips on rays, speeds by Willis, answers of books, refusals."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations
from pathlib import Path
from random import Random

import pytest

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.vocabulary import action
from graphkin.construction.rolling import kutzbach
from graphkin.construction.rolling.kutzbach import LadderPoint, LadderRay, SpeedPole, SpeedRead
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.kinds import ball_kind
from graphkin.scene.read_scene import read_text
from tests.scene_files import scene_text
from tests.textbook.book import within

FOLDER = Path(__file__).parents[2] / "examples" / "scenes"
TRAINS = ("gears-ring", "gears-simpson", "gears-ravigneaux", "gears-pair")
HEAD = """
graphkin = 1
title = "Train"
units = { length = "mm", angle = "deg", speed = "rad/s" }
module = 2
"""
PLAN = '\n[sheet]\nplan = "kutzbach"\n'


def train(text: str) -> Mechanism:
    """The mechanism of a train with the plan."""
    return Mechanism(read_text(HEAD + text + PLAN, "train"))


@cache
def example(name: str) -> Mechanism:
    """A shipped train, with the plan."""
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    return Mechanism(read_text(text + PLAN, name))


def speeds(mechanism: Mechanism) -> dict[str, float]:
    """What each link cuts off on the line of speeds, over what is cut off at 1 rad/s."""
    found = mechanism.trace(by_hand=True)
    (scale,) = constructions(found.program, SpeedPole)
    reads = list(constructions(found.program, SpeedRead))
    start, pole = (found.values[number] for number in (scale.start, scale.pole))
    unit = start - pole
    turner = found.program.steps[reads[0].parallel]
    assert turner.args[0] == scale.pole
    return {
        read.link: ((found.values[read.cut] - start) / (1j * unit)).real / pace(mechanism)
        for read in reads
    }


def pace(mechanism: Mechanism) -> float:
    """The time by which lengths are laid off in the plan: that of the turning driver."""
    driver = next(d for d in mechanism.scene.drivers if not d.speed.is_zero())
    return float(1 / abs(driver.speed.si(mechanism.scene.values)))


@pytest.mark.parametrize("name", TRAINS)
def test_every_link_cuts_off_its_angular_velocity(name):
    mechanism = example(name)
    links = mechanism.solve().links
    for link, cut in speeds(mechanism).items():
        assert within(cut, links[link].omega, 1e-12), link


@pytest.mark.parametrize("name", (*TRAINS, "gears-kutzbach"))
def test_speeds_are_read_as_far_from_their_pole_as_the_smallest_wheel_is_large(name):
    """The line of speeds stands off by its radius, in the time of the driver."""
    mechanism = example(name) if name in TRAINS else load(FOLDER / f"{name}.toml")
    found, scene = mechanism.trace(by_hand=True), mechanism.scene
    (scale,) = constructions(found.program, SpeedPole)
    wheels = [wheel for link in (scene.frame, *scene.links.values()) for wheel in link.wheels]
    least = min(float(wheel.radius.si(scene.values)) for wheel in wheels)
    off = abs(found.values[scale.start] - found.values[scale.pole])
    assert off == pytest.approx(least / pace(mechanism))
    rim = found.value("position", scale.p) - found.value("position", scale.q)
    assert abs(rim) == pytest.approx(least)


ON_FIXED_PINS = """
[frame]
O = [0, 0]
P = [PLACE, 0]
Q = [PAST, 0]
[links.1]
P = [0, 0]
wheel = { centre = "P", teeth = 30 }
rolls = { on = 2 }
[links.2]
O = [0, 0]
wheel = { centre = "O", teeth = TEETH }
[links.3]
Q = [0, 0]
wheel = { centre = "Q", teeth = 20 }
rolls = { on = 1 }
[[drivers]]
turn = 1
angle = 0
speed = 10
[ask]
omega = [2, 3]
"""


@pytest.mark.parametrize(
    ("teeth", "place", "inside", "speed"), [(40, 70, False, -7.5), (80, 50, True, 3.75)]
)
def test_wheels_about_fixed_pins_have_speeds_as_their_teeth(teeth, place, inside, speed):
    """In a ring the pitch point lies beyond the pinion; the smallest wheel is in the last mesh."""
    ring = f"teeth = {teeth}, inside = true" if inside else f"teeth = {teeth}"
    text = ON_FIXED_PINS.replace("teeth = TEETH", ring).replace("PLACE", str(place))
    mechanism = train(text.replace("PAST", str(place + 50)))
    assert speeds(mechanism) == pytest.approx({"1": 10, "2": speed, "3": -15})
    found = mechanism.trace(by_hand=True)
    (scale,) = constructions(found.program, SpeedPole)
    rim = found.value("position", scale.p) - found.value("position", scale.q)
    assert abs(rim) == pytest.approx(0.02)


@pytest.mark.parametrize("name", TRAINS)
def test_the_tips_of_all_points_of_a_link_lie_on_its_ray(name):
    """Also those through which it was not drawn: pitch points, and centres on axes and arms."""
    found = example(name).trace(by_hand=True)
    tips = {p.point: p.tip for p in constructions(found.program, LadderPoint) if p.tip is not None}
    rays = list(constructions(found.program, LadderRay))
    assert rays
    shared = 0
    for number in tips.values():
        tip = found.values[number]
        on = [r for r in rays if abs(off(found.values[r.ray], tip)) < 1e-12 * abs(tip)]
        shared += len(on) > 1
        assert on
    assert shared  # in pitch points two rays meet


def off(line, point) -> float:
    """How far a point lies beside a line."""
    return ((point - line.point) / line.along).imag * abs(line.along)


@pytest.mark.parametrize("seed", range(20))
def test_the_speeds_of_a_planetary_gear_are_those_of_willis(seed):
    """(ω_sun - ω_arm)/(ω_ring - ω_arm) = -z_ring/z_sun, with arm and ring driven."""
    random = Random(seed)
    sun, planet = random.randint(12, 40), random.randint(12, 40)
    ring, arm, second = sun + 2 * planet, random.choice([-7, -2, 3, 11]), random.randint(1, 9)
    teeth = {"sun": sun, "planet": planet, "ring": ring, "arm": sun + planet}
    speed = {"turned": random.uniform(0, 360), "speed": arm, "second": second}
    mechanism = train(scene_text("construction/planetary-gear", **teeth, **speed))
    found = speeds(mechanism)
    expected = arm - Fraction(ring, sun) * (second - arm)
    assert within(found["sun"], float(expected), 1e-12)
    assert within(found["planet"], float(arm + Fraction(ring, planet) * (second - arm)), 1e-12)


def test_fixed_axes_out_of_line_are_unfolded():
    """A train whose centres make a corner: i = (20/30)·(40/25), each pitch point on one axis."""
    mechanism = train(scene_text("construction/gears-round-a-corner"))
    found = speeds(mechanism)
    assert within(found["2"], -4.0, 1e-13)
    assert within(found["3"], 6.4, 1e-13)
    trace = mechanism.trace(by_hand=True)
    feet = {p.point: trace.values[p.foot] for p in constructions(trace.program, LadderPoint)}
    way = feet["C"] - feet["B"]
    for one, other in combinations(feet.values(), 2):
        assert abs(((other - one) / way).imag) < 1e-12


def test_the_book_s_epicyclic_gear():
    """R. S. Khurmi, J. K. Gupta, Theory of Machines, example 13.6: 58.5 and 46.8 rev/min."""
    links, turn = load(FOLDER / "gears-kutzbach.toml").solve().links, 3.141592653589793 / 30
    assert within(links["C"].omega, 58.5 * turn, 1e-12)
    assert within(links["B"].omega, -46.8 * turn, 1e-12)


def test_the_drawn_speeds_are_proved():
    """In balls of 200 bits the rate read off the line of speeds overlaps that of the link."""
    mechanism = example("gears-ravigneaux")
    trace = mechanism.trace(by_hand=True, kind=ball_kind(200))
    reads = [r for r in constructions(trace.program, SpeedRead) if r.rate is not None]
    assert len(reads) == 4
    for read in reads:
        assert trace.values[read.rate].overlaps(trace.values[read.read])


def test_a_wrong_speed_is_seen(monkeypatch):
    """The law above is none that any drawing passes."""
    wrong = kutzbach.tip_over.value
    monkeypatch.setattr(
        kutzbach, "tip_over", action("ladder-tip")(lambda *known: wrong(*known[:-1], -known[-1]))
    )
    mechanism = example.__wrapped__("gears-ring")
    omega = mechanism.solve().links["2"].omega
    assert not within(speeds(mechanism)["2"], omega, 1e-3)
