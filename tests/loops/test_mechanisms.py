"""Textbook mechanisms against their closed forms, and derivatives against central differences."""

from __future__ import annotations

import cmath
import math

import mpmath
import pytest

from tests.scene_files import scene_text

FOUR_BAR = """
[frame]
A = [0, 0]
D = [4, 0]
[links.1]
A-B = 1.5
[links.2]
B-C = 3.5
[links.3]
D-C = 3
[[drivers]]
turn = 1
angle = {angle}
speed = 2
acceleration = 3
[branches]
C = "left of B-D"
"""


@pytest.mark.parametrize("angle", [10, 75, 140, 200, 300])
@pytest.mark.parametrize("start", [1 + 3j, 3 - 3j])
def test_four_bar_velocity_ratios(angle, start, read, solved):
    found = solved(read(FOUR_BAR.format(angle=angle)), C=start)
    q, (theta_2, theta_3) = math.radians(angle), found.unknowns[0, 1:]
    sine = math.sin(theta_2 - theta_3)
    tau = found.ratios.velocity[0, :, 0]
    assert tau[1] == pytest.approx(-(1.5 / 3.5) * math.sin(q - theta_3) / sine, rel=1e-12)
    assert tau[2] == pytest.approx(-(1.5 / 3) * math.sin(q - theta_2) / sine, rel=1e-12)


SLIDER_CRANK = """
[frame]
O = [0, 0]
[links.1]
O-A = 1
[links.2]
A-B = 3
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0, offset = 0.4 }}
[[drivers]]
{driver}
[branches]
3 = "forward"
"""


@pytest.mark.parametrize("angle", [15, 100, 222])
def test_slider_crank_driven_by_the_crank(angle, read, solved):
    scene = read(SLIDER_CRANK.format(driver=f"turn = 1\nangle = {angle}\nspeed = 5"))
    found = solved(scene, B=3 + 0.4j)
    q = math.radians(angle)
    rod = math.asin((0.4 - math.sin(q)) / 3)
    assert found.motion.slide(0).speed[0] == pytest.approx(-5 * math.sin(q - rod) / math.cos(rod))
    place, velocity, _ = found.motion.point("B")
    assert place[0].imag == pytest.approx(0.4, rel=1e-15)
    assert velocity[0].imag == pytest.approx(0, abs=1e-14)


def test_slider_crank_driven_by_the_slider(read, solved):
    scene = read(SLIDER_CRANK.format(driver="slide = 3\nposition = 3.1\nspeed = 0.7"))
    found = solved(scene, A=1 + 0j, B=3.1 + 0.4j)
    q, rod = found.unknowns[0, :2]
    expected = 0.7 * math.cos(rod) / -math.sin(q - rod)
    assert found.motion.omega[0, 1] == pytest.approx(expected, rel=1e-12)


def unit(angle):
    return mpmath.mpc(mpmath.cos(angle), mpmath.sin(angle))


def central(position, values, speeds, accelerations):
    """Velocity and acceleration of every point of a position solution, by central differences."""
    with mpmath.workdps(50):
        h = mpmath.mpf(10) ** -15
        laws = list(zip(values, speeds, accelerations, strict=True))
        then = [
            position(*(q + w * k * h + e * (k * h) ** 2 / 2 for q, w, e in laws))
            for k in (-1, 0, 1)
        ]
        return {
            name: (
                complex(z),
                complex((then[2][name] - then[0][name]) / (2 * h)),
                complex((then[2][name] - 2 * z + then[0][name]) / h**2),
            )
            for name, z in then[1].items()
        }


def agree(motion, expected, tolerance=1e-12):
    for name, quantities in expected.items():
        for found, exact in zip(motion.point(name), quantities, strict=True):
            assert abs(found[0] - exact) <= tolerance * max(1, abs(exact)), name


def shaper(q):
    a = unit(q) * 6 / 5
    reach = a + 3j
    b = -3j + 7 * reach / abs(reach)
    rise = mpmath.mpf(7) / 2 - mpmath.im(b)
    c = b + mpmath.sqrt(4 - rise**2) + 1j * rise
    return {"A": a, "B": b, "C": c, "reach": mpmath.mpc(abs(reach)), "turn": reach / abs(reach)}


def test_slotted_lever_with_coriolis(read, solved):
    found = solved(read(scene_text("loops/shaper")), A=1 + 0.6j, B=1.9 + 3.7j, C=3.9 + 3.5j)
    expected = central(shaper, [mpmath.pi / 6], [6], [2])
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


def test_bar_through_a_swivelling_block(read, solved):
    """b = sqrt(c² + d² + a² + 2a(d sinθ - c cosθ)) with C = (c, -d) from A."""
    motion = solved(read(scene_text("loops/crank-slot")), B=0.6 + 0.8j).motion
    b = motion.slide(0).position[0]
    theta = math.radians(50)
    closed = math.sqrt(9 + 1 + 1 + 2 * (math.sin(theta) - 3 * math.cos(theta)))
    assert b == pytest.approx(closed, rel=1e-14)

    def position(q):
        crank = unit(q)
        way = 3 - 1j - crank
        return {"B": crank, "E": crank + 5 * way / abs(way)}

    agree(motion, central(position, [50 * mpmath.pi / 180], [2], [0]))


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

    expected = central(position, [35 * mpmath.pi / 180], [3], [1])
    start = {name: quantities[0] + 0.1 for name, quantities in expected.items()}
    agree(solved(read(scene_text("loops/rapid-return-3")), **start).motion, expected, 1e-11)


def five_bar(p, q):
    b, d = 2 * unit(p), 4 + 2 * unit(q)
    half = (d - b) / 2
    return {"C": b + half + 1j * half / abs(half) * mpmath.sqrt(9 - abs(half) ** 2)}


def test_five_bar_with_two_drivers(read, solved):
    found = solved(read(scene_text("loops/five-bar")), C=2 + 4j)
    values = [100 * mpmath.pi / 180, mpmath.pi / 3]
    agree(found.motion, central(five_bar, values, [2, -1], [-1, 3]))
    ratios = found.ratios
    swapped = ratios.acceleration.transpose(0, 1, 3, 2)
    assert abs(ratios.acceleration - swapped).max() < 1e-14
    for d, (speed, column) in enumerate([([1, 0], 0), ([0, 1], 1)]):
        ratio = central(five_bar, values, speed, [0, 0])["C"][1]
        arms = 3 * cmath.exp(1j * found.unknowns[0, 1])
        crank = 2 * cmath.exp(1j * values[0]) if d == 0 else 0
        tau = ratios.velocity[0, :, column]
        assert abs(1j * (crank + arms * tau[1]) - ratio) < 1e-13


def test_eight_links_with_a_moving_slide(read, solved):
    start = {"B": 2 + 2j, "C": 3 + 2j, "D": 7 + 4j, "E": 10 + 4j}
    motion = solved(read(scene_text("loops/eight-links-1")), **start).motion
    omega = dict(zip(motion.index, motion.omega[0], strict=True))
    assert omega["5"] == pytest.approx(-1 / 2, rel=1e-12)
    assert omega["7"] == pytest.approx(1 / 6, rel=1e-12)
    assert omega["8"] == pytest.approx(1 / 2, rel=1e-12)
    assert abs(motion.point("B@4").velocity[0] - 2j) < 1e-13
    assert abs(motion.point("D").velocity[0] - 1) < 1e-13


def test_eight_links_with_a_swivelling_guide(read, solved):
    start = {"A": 0j, "C": 10 + 5j, "D": 16 + 9j, "E": 18 + 11j}
    motion = solved(read(scene_text("loops/eight-links-2")), **start).motion
    omega = dict(zip(motion.index, motion.omega[0], strict=True))
    assert omega["3"] == omega["4"] == pytest.approx(1 / 15, rel=1e-12)
    assert omega["7"] == pytest.approx(0, abs=1e-14)
    assert omega["8"] == pytest.approx(-1 / 30, rel=1e-12)
    assert abs(motion.point("B@3").velocity[0] - (0.8 + 0.4j)) < 1e-13
    for name in "DE":
        assert abs(motion.point(name).velocity[0]) == pytest.approx(1 / 15, rel=1e-12)


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
