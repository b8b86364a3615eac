"""Wheels, gears and racks against closed forms, and against central differences in 50 digits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from graphkin.loops.assemble import assemble
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
