"""Wheels, gears and racks against closed forms, and against central differences in 50 digits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from graphkin.loops.assemble import assemble
from graphkin.loops.freedom import true_mobility
from graphkin.text.errors import WitnessError
from tests.loops.differences import agree, central, degrees, unit
from tests.scene_files import scene_text

ROLLER = """
[frame]
O = [0.5, 1]
[links.1]
C = [0, 0]
Q = {{ from = "C", length = 0.2, angle = 40 }}
wheel = {{ centre = "C", radius = 0.25 }}
rolls = {{ on = 0, through = "O", angle = 30, side = "{side}", start = {{ 1 = 70 }} }}
[[drivers]]
{driver}
"""


def cycloid(side):
    """Centre and rim point: the contact at O + s·d, the wheel turned by -side·s/r."""

    def place(s):
        d = unit(degrees(30))
        centre = mpmath.mpc(0.5, 1) + s * d + side * 0.25j * d
        turned = degrees(70) - side * s / mpmath.mpf(0.25)
        return {"C": centre, "Q": centre + mpmath.mpf("0.2") * unit(turned + degrees(40))}

    return place


@pytest.mark.parametrize(("side", "sign"), [("left", 1), ("right", -1)])
def test_a_wheel_on_a_rail_draws_a_cycloid(side, sign, read):
    driver = "roll = 1\nposition = 3.3\nspeed = 2\nacceleration = -5"
    motion = assemble(read(ROLLER.format(side=side, driver=driver))).motion
    expected = central(cycloid(sign), [(mpmath.mpf("3.3"), 2, -5)])
    agree(motion, expected)
    touch = 0.5 + 1j + 3.3 * complex(unit(degrees(30)))
    contact = motion.carried("1", np.array([touch]))
    assert abs(contact.velocity[0]) < 1e-13
    towards = (expected["C"][0] - touch) / 0.25
    across = (np.conj(towards) * contact.acceleration[0]).real
    assert across == pytest.approx(2**2 / 0.25)
    assert motion.omega[0, 1] == pytest.approx(-sign * 2 / 0.25)


@pytest.mark.parametrize("turned", [-620, -10, 70, 400, 790])
def test_a_driven_wheel_rolls_as_far_as_its_angle_is_written(turned, read):
    """Full turns count: the angle is the driver's own, counted from the start of 70 degrees."""
    driver = f"turn = 1\nangle = {turned}\nspeed = -3\nacceleration = 1"
    motion = assemble(read(ROLLER.format(side="left", driver=driver))).motion
    rolled = (degrees(70) - degrees(turned)) / 4
    laws = [(rolled, mpmath.mpf(3) / 4, -mpmath.mpf(1) / 4)]
    agree(motion, central(cycloid(1), laws))
    assert motion.slide(0).position[0] == pytest.approx(float(rolled))


def test_two_drivers_that_both_roll_one_wheel(read):
    """Consistent, they are one too many but no error; at odds they are named."""
    driver = "roll = 1\nposition = {}\nspeed = 2\n[[drivers]]\nturn = 1\nangle = 0\nspeed = -8"
    fits = math.radians(70) / 4
    found = assemble(read(ROLLER.format(side="left", driver=driver.format(fits))))
    assert found.motion.slide(0).speed[0] == pytest.approx(2)
    with pytest.raises(WitnessError, match="close"):
        assemble(read(ROLLER.format(side="left", driver=driver.format(1))))


PLATES = scene_text("loops/plates")


def test_a_roller_between_two_plates(read):
    """v_O = (v_U + v_L)/2 and ω = (v_L - v_U)/2r; one of the two distances is idle."""
    scene = read(PLATES)
    motion = assemble(scene).motion
    wheel = motion.index["wheel"]
    assert motion.point("C").velocity[0] == pytest.approx((5 - 2) / 2)
    assert motion.point("C").acceleration[0] == pytest.approx((7 + 1) / 2)
    assert motion.omega[0, wheel] == pytest.approx((-2 - 5) / (2 * 0.5))
    assert motion.epsilon[0, wheel] == pytest.approx((1 - 7) / (2 * 0.5))
    assert motion.point("C").place[0].imag == pytest.approx(0.5)
    assert true_mobility(scene, {"C": motion.point("C").place[0], "L": 0.3, "U": -0.1 + 1j}) == 2
    assert true_mobility(scene) == 2


PLANET = """
[frame]
O = [0, 0]
{ring}
[links.sun]
O = [0, 0]
wheel = {{ centre = "O", radius = 0.6 }}
[links.arm]
O-P = {arm}
[links.planet]
P = [0, 0]
Q = [0.3, 0]
wheel = {{ centre = "P", radius = 0.3 }}
rolls = [{{ on = "sun", start = {{ arm = 10, sun = -20, planet = 35 }} }}{more}]
{links}
[[drivers]]
turn = "sun"
angle = {sun}
speed = -50
acceleration = 3
{driver}
"""
ARM = '[[drivers]]\nturn = "arm"\nangle = 760\nspeed = 100\nacceleration = -7\n'


def test_a_planet_on_an_arm(read):
    """Willis: r_p (ω_p - ω_a) = -r_s (ω_s - ω_a), angles as written counted from the start."""
    text = PLANET.format(ring="", arm=0.9, more="", links="", sun=-415, driver=ARM)
    motion = assemble(read(text)).motion

    def place(sun, arm):
        centre = mpmath.mpf("0.9") * unit(arm)
        led = degrees(35 - 10) + (arm - degrees(0))
        led -= 2 * (sun - arm - degrees(-20 - 10))
        return {"P": centre, "Q": centre + mpmath.mpf("0.3") * unit(led)}

    laws = [(degrees(-415), -50, 3), (degrees(760), 100, -7)]
    agree(motion, central(place, laws), 1e-11)
    assert motion.omega[0, motion.index["planet"]] == pytest.approx(100 - 2 * (-50 - 100))


def test_planet_sun_and_fixed_ring(read):
    """ω_arm = ω_sun r_s/(2(r_s + r_p)); the planet turns, relative to the arm, against the ring."""
    ring = 'wheel = { centre = "O", radius = 1.2, inside = true }'
    text = PLANET.format(
        ring=ring, arm=0.9, more=", { on = 0 }", links="", sun=5000, driver=""
    ).replace("start = { arm = 10, sun = -20, planet = 35 }", "start = {}")
    motion = assemble(read(text)).motion
    omega = dict(zip(motion.index, motion.omega[0], strict=True))
    assert omega["arm"] == pytest.approx(-50 * 0.6 / (2 * 0.9))
    assert omega["planet"] == pytest.approx(-omega["arm"] * 0.9 / 0.3)
    arm = math.radians(5000) / 3
    assert abs(motion.point("P").place[0] - 0.9 * np.exp(1j * arm)) < 1e-12


def test_compound_wheels_touch_by_the_pair_that_fits(read):
    """A stepped idler: 0.2 on 0.4, 0.5 on 0.1: ω_out = ω_in·(0.4/0.2)·(0.5/0.1)."""
    scene = read(scene_text("loops/compound-wheels"))
    motion = assemble(scene).motion
    omega = dict(zip(motion.index, motion.omega[0], strict=True))
    assert omega["idler"] == pytest.approx(-6)
    assert omega["out"] == pytest.approx(30)
    turned = math.radians(200 * 10)
    assert abs(motion.point("T").place[0] - 1.2 - 0.05 * np.exp(1j * turned)) < 1e-12


def test_a_stepped_wheel_rolls_on_the_one_at_the_height_at_which_a_guide_keeps_it(read):
    """0.3 is written first, but the axle is kept 0.2 over the track."""
    motion = assemble(read(scene_text("loops/stepped-wheel"))).motion
    omega, epsilon = (
        dict(zip(motion.index, row[0], strict=True)) for row in (motion.omega, motion.epsilon)
    )
    assert omega["2"] == pytest.approx(-2 / 0.2)
    assert epsilon["2"] == pytest.approx(-1 / 0.2)
    rim = 0.5 + 0.2j + 0.2 * np.exp(-1j * 0.5 / 0.2)
    assert abs(motion.point("P").place[0] - rim) < 1e-12


RACK = """
[frame]
O = [0, 0]
G = [0, -0.5]
[links.wheel]
O = [0, 0]
T = [0.1, 0.2]
wheel = {{ centre = "O", radius = 0.5 }}
rolls = {{ on = "rack", through = "R", angle = 0 }}
[links.rack]
R = [0, 0]
slides = {{ on = 0, through = "G", angle = 0 }}
[[drivers]]
{driver}
"""


@pytest.mark.parametrize(
    "driver",
    [
        'slide = "rack"\nposition = 2\nspeed = 1.5\nacceleration = -2',
        'turn = "wheel"\nangle = "360/pi*2"\nspeed = 3\nacceleration = -4',
    ],
)
def test_rack_and_pinion_driven_from_either_side(driver, read):
    """The rack goes to the right with the wheel turning left: its top runs under the centre."""
    scene = read(RACK.format(driver=driver))
    motion = assemble(scene).motion
    assert motion.point("R").place[0] == pytest.approx(2 - 0.5j)
    assert motion.point("R").velocity[0] == pytest.approx(1.5)
    assert motion.point("R").acceleration[0] == pytest.approx(-2)
    i = motion.index["wheel"]
    assert motion.omega[0, i] == pytest.approx(3)
    assert motion.epsilon[0, i] == pytest.approx(-4)
    expected = (0.1 + 0.2j) * np.exp(4j)
    assert abs(motion.point("T").place[0] - expected) < 1e-12
    assert true_mobility(scene) == 1


ROD_AND_WHEEL = scene_text("loops/rod-and-wheel")


def rod_and_wheel(guess):
    """The wheel rolled by s so that its pin B is at the distance q of A, in 50 digits."""

    def rolled(s):
        centre = mpmath.mpc(s, mpmath.mpf(8) / 10)
        turned = degrees(20) - s / (mpmath.mpf(8) / 10)
        return centre, centre + mpmath.mpc(5, 1) / 10 * unit(turned)

    def place(q):
        s = mpmath.findroot(lambda s: abs(rolled(s)[1] - 2j) - q, guess, tol=1e-80)
        centre, pin = rolled(s)
        return {"C": centre, "B": pin}

    return place


def test_a_rod_of_driven_length_on_a_rolling_wheel(read):
    """Every place within the rod's reach, however far the wheel must roll to it."""

    def gap(s):
        pin = s + 0.8j + (0.5 + 0.1j) * np.exp(1j * (math.radians(20) - s / 0.8))
        return abs(pin - 2j) - 2.5

    found = set()
    for number in range(1, 20):
        try:
            motion = assemble(read(ROD_AND_WHEEL.replace("NUMBER", str(number)))).motion
        except WitnessError:
            break
        s = motion.point("C").place[0].real
        assert abs(gap(s)) < 1e-12
        found.add(round(s, 9))
        laws = [(mpmath.mpf(5) / 2, mpmath.mpf("0.7"), mpmath.mpf("-1.3"))]
        agree(motion, central(rod_and_wheel(s), laws), 1e-10)
    signs = np.sign(gap(np.linspace(-4, 4, 8001)))
    assert len(found) == np.count_nonzero(signs[1:] != signs[:-1]) > 0


def test_a_wheel_in_a_bowl_without_an_arm(read):
    """The centre runs on a circle of R - r; with γ its direction, ω = -γ̇ (R - r)/r."""
    scene = read(scene_text("loops/wheel-in-a-bowl"))
    motion = assemble(scene).motion

    def place(turned):
        centre = mpmath.mpf(3) / 4 * unit(-turned / 3)
        return {"P": centre, "Q": centre + mpmath.mpf("0.2") * unit(turned)}

    agree(motion, central(place, [(degrees(100), 6, 2)]))


def test_a_batch_of_wheels_equals_its_scalars(read):
    text = "[parameters]\nq = 1\n" + PLANET.format(
        ring="", arm=0.9, more="", links="", sun='"40*q"', driver=ARM
    )
    q = np.array([-9.0, 0.5, 13.0])
    batch = assemble(read(text), {"q": q}).motion
    for n, each in enumerate(q):
        one = assemble(read(text, q=each)).motion
        for many, single in zip(batch.point("Q"), one.point("Q"), strict=True):
            assert abs(many[n] - single[0]) <= 1e-12 * max(1, abs(single[0]))
