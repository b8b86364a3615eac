"""Machines and frames at rest, from books of statics: each a small scene.

A frame is a mechanism whose support is a driver; its balance is then the reaction of that support.
We have the printed answers from FOSSEE's Python Textbook Companions, not the figures. Where a
layout is not in the companion's lines, the docstring says how we read it.
"""

from __future__ import annotations

import math

from tests.textbook.book import IN, LB, TENTHS, WITNESSED, Held, exactly, rounds_to, within

METRES = 'units = { length = "m", angle = "deg", speed = "rad/s" }\n'
SINE, COSINE = math.sin(math.radians(60)), math.cos(math.radians(60))


# --- R. C. Hibbeler, A. Gupta, Engineering Mechanics: Statics and Dynamics -----------------------

CANTILEVER = """
[frame]
A = [0, 0]
[links.1]
A-B = 0.3
A-C = 0.7
B = "on A-C"
[[loads]]
at = "B"
link = 1
force = ["-52*5/13", "-52*12/13"]
[[loads]]
at = "C"
link = 1
force = ["30*cos(60)", "-30*sin(60)"]
[[drivers]]
turn = 1
angle = 0
speed = 0
"""


def test_hibbeler_5_9_fixed_end_of_a_wrench():
    """Page 177: 52 N (5-12-13) and 30 N at 60°. A_x = 5.00 N, A_y = 74.0 N, M_A = 32.6 N·m."""
    held = Held(METRES + CANTILEVER)
    pin = held.on("A", 1)
    assert rounds_to(pin.real, "5.0")
    assert rounds_to(pin.imag, "74.0")
    assert rounds_to(held.moment(), "32.6")
    assert exactly(pin, 5 + (48 + 30 * SINE) * 1j)
    assert exactly(held.moment(), 48 * 0.3 + 30 * SINE * 0.7)


TWO_FORCE = """
[frame]
A = [0, 0]
G = [0, "3*sin(60)"]
[links.1]
A-B = 3
[links.2]
B-C = 4
B-M = 2
M = "on B-C"
[links.3]
C = [0, 0]
slides = { on = 0, through = "G", angle = 0 }
[[loads]]
at = "M"
link = 2
force = [0, -2000]
[[drivers]]
slide = 3
position = "4 + 3*cos(60)"
speed = 0
[branches]
B = "left of A-C"
"""


def test_hibbeler_6_14_bar_of_two_forces():
    """Page 241: C_x = 577 N, C_y = 1000 N. The pin C is a driven block here, which takes both."""
    held = Held(METRES + TWO_FORCE)
    assert rounds_to(abs(held.force(3)), "577")
    assert rounds_to(held.on("3-0", 3).imag, "1000")
    assert exactly(abs(held.force(3)), 1000 / math.tan(math.radians(60)))
    assert exactly(abs(held.on("A", 1)), 1000 / SINE)


COMPOUND = """
[frame]
A = [0, 0]
[links.1]
A-P = 2
A-B = 4
P = "on A-B"
[links.2]
B-Q = 1
B-C = 2
Q = "on B-C"
[links.3]
C = [0, 0]
slides = { on = 0, through = "A", angle = 0 }
[[loads]]
at = "P"
link = 1
force = [-6, -8]
[[loads]]
at = "Q"
link = 2
force = [0, -8]
[[drivers]]
turn = 1
angle = 0
speed = 0
[branches]
3 = "forward"
"""


def test_hibbeler_6_15_compound_beam():
    """Page 242: 10 kN and 4 kN/m over 2 m. A = (6, 12) kN, M_A = 32 kN·m, B = (0, 4), C_y = 4 kN.

    In kilonewtons.
    """
    held = Held(METRES + COMPOUND)
    assert exactly(held.on("A", 1), 6 + 12j)
    assert exactly(held.moment(), 32)
    assert exactly(held.on("B", 2), 4j)
    assert exactly(held.on("3-0", 3), 4j)


POST = """
[frame]
W = [0, 0]
[links.1]
A = [0, 0]
slides = { on = 0, through = "W", angle = 90 }
[links.2]
A-B = 0.4
A-C = 2
A-D = 2.8
B = "on A-C"
C = "on A-D"
[links.3]
D = [0, 0]
slides = { on = 0, through = "W", angle = 90 }
[links.4]
C-E = 1.6
C-F = 2
E = "on C-F"
[links.5]
B-E = "1.6*sqrt(2)"
[[loads]]
at = "F"
link = 4
force = [0, -981]
[[drivers]]
slide = 1
position = 0
speed = 0
[branches]
3 = "forward"
E = "right of B-C"
"""


def test_hibbeler_6_16_frame_with_a_strut():
    """Page 243: 100 kg, 2 m off a post of 2.8 m; a strut at 45° meets the arm 1.6 m from the post.

    D_x = 700.7 N, F_B = 1734 N, C_x = 1226 N, C_y = -245 N. The pin A is a driven block. The height
    of C on the post is ours.
    """
    held = Held(METRES + POST)
    assert rounds_to(abs(held.on("3-0", 3)), "700.7")
    assert exactly(held.force(1), 981j)
    assert exactly(abs(held.on("B", 5)), 981 * 2 / (1.6 * math.sin(math.radians(45))))
    pin = held.on("C", 2)
    assert within(abs(pin.real), 1226.3, 1e-3)
    assert within(abs(pin.imag), 245.3, 1e-3)


LEVER = """
[frame]
W = [0, 0]
D = [0.4, 0.7]
[links.1]
A = [0, 0]
slides = { on = 0, through = "W", angle = 90 }
[links.2]
A = [0, 0]
B = [0.2, 0.5]
C = [0.1, 0.7]
[links.3]
B-D = "0.2*sqrt(2)"
[[loads]]
at = "C"
link = 2
force = [400, 0]
[[drivers]]
slide = 1
position = 0
speed = 0
[branches]
B = "left of A-D"
"""


def test_hibbeler_5_11_lever_on_a_short_link():
    """Page 181: 400 N, a link at 45°, three lines through one point. F_A = 1.07, F = 1.32 kN.

    The point where the lines meet is (0.4, 0.7) m from A; where the link is pinned is ours.
    """
    held = Held(METRES + LEVER)
    pin = held.on("A", 2)
    assert rounds_to(abs(pin) / 1000, "1.07")
    assert rounds_to(abs(held.on("B", 3)) / 1000, "1.32")
    assert exactly(pin, (16 + 28j) / 3 * 100)


LINKAGE = """
gravity = true
[frame]
A = [0, 0]
[links.1]
A-S = 0.5
A-B = 1
S = "on A-B"
mass = 10
centre = "S"
[links.2]
B-T = 0.5
B-C = 1
T = "on B-C"
mass = 10
centre = "T"
[links.3]
C = [0, 0]
slides = { on = 0, through = "A", angle = 0 }
[[loads]]
at = "C"
link = 3
force = [-25, 0]
[[drivers]]
turn = 1
angle = "$ANGLE"
speed = 0
[branches]
3 = "forward"
"""


def test_hibbeler_11_1_angle_of_two_bars_in_equilibrium():
    """Page 418: two bars of 1 m and 10 kg, and 25 N at the roller. Printed 63.0°.

    The exact angle has the tangent 98.1/50: no moment is needed there.
    """
    exact = math.degrees(math.atan(98.1 / 50))
    off = {
        angle: Held(METRES + LINKAGE.replace('"$ANGLE"', repr(angle))).moment()
        for angle in (62.95, 63.05, exact)
    }
    assert off[62.95] > 0 > off[63.05]
    assert abs(off[exact]) < WITNESSED * 98.1


# --- F. P. Beer, E. R. Johnston et al., Vector Mechanics for Engineers ---------------------------

ACE = """
[frame]
W = [0, 0]
[links.1]
A = [0, 0]
slides = { on = 0, through = "W", angle = 90 }
[links.2]
A = [0, 220]
C = [0, 0]
E = [100, -80]
[links.3]
B = [0, 60]
C = [0, 0]
P = [100, 0]
D = [250, 0]
[links.4]
D-E = 170
[links.5]
B = [0, 0]
slides = { on = 0, through = "W", angle = 90 }
[[loads]]
at = "P"
link = 3
force = [0, -480]
[[drivers]]
slide = 1
position = 500
speed = 0
[branches]
2 = "closure 1"
"""


def test_beer_6_4_frame_with_a_link():
    """Page 319: A_y = 480 N, B = 300 N, F_DE = 561 N in compression, C = (795, 216) N.

    Millimetres. The layout follows from the arms 60, 80, 100, 150 and 160 mm in the equations.
    """
    held = Held('units = { length = "mm", angle = "deg", speed = "rad/s" }\n' + ACE)
    assert exactly(held.force(1), 480j)
    assert exactly(held.on("5-0", 5), 300)
    assert rounds_to(abs(held.on("D", 4)), "561")
    pin = held.on("C", 3)
    assert rounds_to(pin.real, "-795")
    assert rounds_to(pin.imag, "216")


TABLE = """
[frame]
E = [0, 0]
H = [3.2, 0]
[links.1]
E-D = 0.7
E-B = 1.4
D = "on E-B"
[links.2]
G-D = 0.7
G-C = 1.4
D = "on G-C"
[links.3]
G = [0, 0]
slides = { on = 0, through = "E", angle = 0 }
[links.4]
C = [0, 0]
P = [0.5, 0.2]
[links.5]
B = [0, 0]
slides = { on = 4, through = "C", angle = 0 }
[links.6]
H = [0, 0]
[links.7]
D = [0, 0]
slides = { on = 6, through = "H", angle = 0 }
[[loads]]
at = "P"
link = 4
force = [0, -4905]
[[drivers]]
slide = 7
against = 6
position = "sqrt(0.7**2 + 3.2**2 - 2*0.7*3.2*cos(60))"
speed = 0
[branches]
D = "right of H-E"
3 = "forward"
5 = "forward"
"""


def test_beer_10_3_hydraulic_lift():
    """Page 501: a crate of 1000 kg on two scissors, a = 0.70 m, L = 3.20 m, 60°. Printed 5.16 kN.

    F = W·S/L·cot θ with S the length of the cylinder, wherever the crate stands.
    """
    held = Held(METRES + TABLE)
    assert rounds_to(abs(held.force(7)) / 1000, "5.16")
    length = math.sqrt(0.7**2 + 3.2**2 - 2 * 0.7 * 3.2 * COSINE)
    assert exactly(abs(held.force(7)), 9810 * length / 3.2 * COSINE / SINE)


# --- T. Bevan, The Theory of Machines ------------------------------------------------------------

STEAM = """
units = {{ length = "in", angle = "deg", speed = "rev/min" }}
[frame]
O = [0, 0]
[links.1]
O-C = 12
[links.2]
C-P = 60
[links.3]
P = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
at = "P"
link = 3
force = [{force}, 0]
[[drivers]]
turn = 1
angle = 40
speed = 0
[branches]
3 = "forward"
"""


def test_bevan_12_3_torque_of_a_steam_engine():
    """Page 415: bore 9 in, rod 2 in, 160 and 32 lb/in², stroke 24 in, l = 60 in, 40°.

    Printed 6110 lb·ft, with sin 2θ/2n for the rod. The exact arm is r sin(θ + φ)/cos φ.
    """
    piston, rod = (math.pi / 4 * d**2 for d in (9, 2))
    force = (piston * (160 - 32) + rod * 32) * LB
    held = Held(STEAM.format(force=-force))
    assert within(abs(held.moment()) / (LB * 12 * IN), 6110, TENTHS)
    theta = math.radians(40)
    phi = math.asin(math.sin(theta) / 5)
    assert exactly(held.moment(), -force * 12 * IN * math.sin(theta + phi) / math.cos(phi))


GOVERNOR = """
units = {{ length = "in", angle = "deg", speed = "rad/s" }}
[frame]
A = [0, 0]
G = [1.5, 0]
[links.1]
A-B = 12
[links.2]
B-C = 12
[links.3]
C = [0, 0]
slides = {{ on = 0, through = "G", angle = -90 }}
[[loads]]
at = "B"
link = 1
force = [{pull}, {weight}]
[[loads]]
at = "C"
link = 3
force = [0, {sleeve}]
[[drivers]]
turn = 1
angle = {angle}
speed = 0
[branches]
3 = "forward"
"""


def governor(radius: float, speed: float) -> Held:
    """Half a Porter governor: arms of 12 in, ball 15 lb, sleeve 120 lb, lower pivot at 1.5 in.

    Bevan's g is 35 230 in·(rev/min)².
    """
    pull = 15 / 35230 * speed**2 * radius
    angle = -math.degrees(math.acos(radius / 12))
    values = {"pull": pull * LB, "weight": -15 * LB, "sleeve": -60 * LB, "angle": repr(angle)}
    return Held(GOVERNOR.format(**values))


def test_bevan_13_1_porter_governor():
    """Page 459. Printed 201.7 rev/min at 10 in and 176.2 rev/min at 8 in: no moment is needed."""
    for radius, speed in ((10, 201.7), (8, 176.2)):
        off = governor(radius, speed).moment()
        step = governor(radius, speed + 0.1).moment() - off
        assert abs(off) <= abs(step), "the speed of equilibrium is within a tenth of the print"
