"""Textbook mechanisms against their closed forms, and derivatives against central differences."""

from __future__ import annotations

import cmath

import mpmath
import pytest

from tests.loops.differences import agree, central, degrees, unit
from tests.scene_files import scene_text


def shaper(q):
    a = unit(q) * 6 / 5
    reach = a + 3j
    b = -3j + 7 * reach / abs(reach)
    rise = mpmath.mpf(7) / 2 - mpmath.im(b)
    c = b + mpmath.sqrt(4 - rise**2) + 1j * rise
    return {"A": a, "B": b, "C": c, "reach": mpmath.mpc(abs(reach)), "turn": reach / abs(reach)}


def test_slotted_lever_with_coriolis(read, solved):
    found = solved(read(scene_text("loops/shaper")), A=1 + 0.6j, B=1.9 + 3.7j, C=3.9 + 3.5j)
    expected = central(shaper, [(mpmath.pi / 6, 6, 2)])
    reach, turn = expected.pop("reach"), expected.pop("turn")
    agree(found.motion, expected)
    slide = found.motion.slide(0)
    for mine, exact in zip(slide[:3], reach, strict=True):
        assert mine[0] == pytest.approx(exact.real, rel=1e-12)
    omega = (turn[1] / (1j * turn[0])).real
    assert found.motion.omega[0, 3] == pytest.approx(omega, rel=1e-12)
    assert abs(slide.coriolis[0] - 2j * omega * reach[1] * turn[0]) < 1e-12
    carried = found.motion.point("A@3").acceleration[0]
    relative = slide.acceleration[0] * turn[0]
    whole = found.motion.point("A").acceleration[0]
    assert abs(carried + slide.coriolis[0] + relative - whole) < 1e-12


def test_class_three_rapid_return(read, solved):
    """Three slides at once, against the closure written out by hand and solved in 50 digits."""

    def position(q):
        def closure(s, low, along, angle):
            bar = unit(angle)
            slot = 1j * low + s * bar - unit(q)
            end = 1j * low + 6 * bar - (-2 + 2j) - along * unit(20 * mpmath.pi / 180)
            return [mpmath.re(slot), mpmath.im(slot), mpmath.re(end), mpmath.im(end)]

        _, low, _, angle = mpmath.findroot(closure, (3.2, -2.5, 3.8, 1.31), tol=1e-90)
        return {"P": mpmath.mpc(0, low), "Q": 1j * low + 6 * unit(angle)}

    expected = central(position, [(degrees(35), 3, 1)])
    start = {name: quantities[0] + 0.1 for name, quantities in expected.items()}
    agree(solved(read(scene_text("loops/rapid-return-3")), **start).motion, expected, 1e-11)


def five_bar(p, q):
    b, d = 2 * unit(p), 4 + 2 * unit(q)
    half = (d - b) / 2
    return {"C": b + half + 1j * half / abs(half) * mpmath.sqrt(9 - abs(half) ** 2)}


def test_five_bar_with_two_drivers(read, solved):
    found = solved(read(scene_text("loops/five-bar")), C=2 + 4j)
    one, two = degrees(100), degrees(60)
    agree(found.motion, central(five_bar, [(one, 2, -1), (two, -1, 3)]))
    ratios = found.ratios
    swapped = ratios.acceleration.transpose(0, 1, 3, 2)
    assert abs(ratios.acceleration - swapped).max() < 1e-14
    for d, (laws, column) in enumerate(
        [([(one, 1, 0), (two, 0, 0)], 0), ([(one, 0, 0), (two, 1, 0)], 1)]
    ):
        ratio = central(five_bar, laws)["C"][1]
        arms = 3 * cmath.exp(1j * found.unknowns[0, 1])
        crank = 2 * cmath.exp(1j * one) if d == 0 else 0
        tau = ratios.velocity[0, :, column]
        assert abs(1j * (crank + arms * tau[1]) - ratio) < 1e-13


def test_an_arm_by_absolute_and_by_relative_angles(read, solved):
    """The excavator's two sets of angles give one motion."""
    arm = """
[frame]
O = [0, 0]
[links.1]
O-A = 2
[links.2]
A-B = 1
[[drivers]]
turn = 1
angle = 40
speed = 1
acceleration = 2
[[drivers]]
turn = 2
{}
"""
    absolute = arm.format("angle = -25\nspeed = 4\nacceleration = -1")
    relative = arm.format("against = 1\nangle = -65\nspeed = 3\nacceleration = -3")
    one, other = (solved(read(text)).motion.point("B") for text in (absolute, relative))
    for mine, its in zip(one, other, strict=True):
        assert abs(mine[0] - its[0]) < 1e-14
