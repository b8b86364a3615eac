"""Forces of moving bodies and linkages from books of dynamics: each a small scene.

A book that asks for an acceleration under given forces is turned round: its acceleration is the
driver's, and no balance may be left. We have the printed answers from FOSSEE's Python Textbook
Companions; those of Norton from memory, see there.
"""

from __future__ import annotations

import math

from tests.textbook.book import FT, IN, LB, TENTHS, Held, exactly, rounds_to, within

METRES = 'units = { length = "m", angle = "deg", speed = "rad/s" }\n'
INCHES = 'units = { length = "in", angle = "deg", speed = "rad/s" }\n'
BLOB, POUND_INCH = LB / IN, LB * IN
"""Kilograms in a lb·s²/in, and newton metres in a lb·in."""


# --- R. L. Norton, Design of Machinery, chapter 11 -----------------------------------------------

SINGLE = f"""
[frame]
O = [0, 0]
[links.2]
O-P = 10
O-S = 5
S = "on O-P"
mass = {0.01 * BLOB!r}
centre = "S"
inertia = {0.08 * POUND_INCH!r}
[[loads]]
at = "P"
link = 2
force = [{40 * LB!r}, 0]
[[drivers]]
turn = 2
angle = 30
speed = 20
acceleration = 15
"""


def test_norton_11_1_single_link():
    """Data and answers from memory: F_12 = (-57.67, -9.39) lb, T_12 = 204.72 lb·in.

    The book rounds a_G to 2001 in/s² at 208°, so that the moment is 0.1 % off.
    """
    held = Held(INCHES + SINGLE)
    pin = held.on("O", 2) / LB
    assert within(pin.real, -57.67, TENTHS)
    assert within(pin.imag, -9.39, 0.01)
    assert within(held.moment(2) / POUND_INCH, 204.72, TENTHS)
    a = 5 * complex(-(20**2), 15) * complex(math.cos(math.pi / 6), math.sin(math.pi / 6))
    assert exactly(pin, 0.01 * a - 40)
    assert exactly(held.moment(2) / POUND_INCH, 40 * 5 + (0.08 + 0.01 * 25) * 15)


FOUR_BAR = f"""
[frame]
O2 = [0, 0]
O4 = [19, 0]
[links.2]
O2-A = 5
S2 = {{ from = "O2", length = 3, angle = 30 }}
mass = {0.004 * BLOB!r}
centre = "S2"
inertia = {0.4 * POUND_INCH!r}
[links.3]
A-B = 15
S3 = {{ from = "A", length = 9, angle = 45 }}
P = {{ from = "S3", length = 3, angle = 100 }}
mass = {0.020 * BLOB!r}
centre = "S3"
inertia = {1.5 * POUND_INCH!r}
[links.4]
O4-B = 10
S4 = {{ from = "O4", length = 5, angle = 0 }}
mass = {0.015 * BLOB!r}
centre = "S4"
inertia = {0.8 * POUND_INCH!r}
[[loads]]
at = "P"
link = 3
force = ["80*cos(330)*{LB!r}", "80*sin(330)*{LB!r}"]
[[loads]]
link = 4
moment = {120 * POUND_INCH!r}
[[drivers]]
turn = 2
angle = 60
speed = 25
acceleration = -40
[branches]
B = "left of A-O4"
"""


def test_norton_11_3_four_bar():
    """Data and answers from memory; that nine numbers agree to their last digits vouches for them.

    T_12 = 243.23 lb·in, F_12 = (-117.65, -107.84), F_43 = (1.34, -87.43), F_14 = (-20.23, 77.71)
    lb; a_G = 1878.84, 3646.1 and 1416.8 in/s².
    """
    held = Held(INCHES + FOUR_BAR)
    assert rounds_to(held.moment(2) / POUND_INCH, "243.23")
    printed = {("O2", 2): ("-117.65", "-107.84"), ("B", 4): ("1.34", "-87.43")}
    printed["O4", 4] = "-20.23", "77.71"
    for (name, link), (x, y) in printed.items():
        force = held.on(name, link) / LB
        assert rounds_to(force.real, x)
        assert rounds_to(force.imag, y)
    points = held.solution.points
    for point, size in (("S2", "1878.84"), ("S3", "3646.1"), ("S4", "1416.8")):
        assert rounds_to(abs(points[point].acceleration) / IN, size)


# --- R. C. Hibbeler, A. Gupta, chapter 17 --------------------------------------------------------

ROD = """
gravity = true
[frame]
O = [0, 0]
[links.1]
O-E = 3
O-S = 1.5
S = "on O-E"
mass = 20
centre = "S"
inertia = 15
[[loads]]
link = 1
moment = -60
[[drivers]]
turn = 1
angle = 0
speed = -5
acceleration = "-354.3/60"
"""


def test_hibbeler_17_10_rod_about_its_end():
    """Page 743: 20 kg, 3 m, level, 5 rad/s, 60 N·m. O_n = 750 N, O_t = 19.05 N, 5.9 rad/s²."""
    held = Held(METRES + ROD)
    assert abs(held.moment()) < 1e-12 * 354
    pin = held.on("O", 1)
    assert rounds_to(-pin.real, "750")
    assert rounds_to(pin.imag, "19.05")
    assert exactly(pin, -750 + (20 * 9.81 - 20 * 1.5 * 354.3 / 60) * 1j)


SPOOL = """
gravity = true
[frame]
R = [0, 0]
[links.1]
C-P = 0.2
wheel = { centre = "C", radius = 0.5 }
rolls = { on = 0, through = "R", angle = 90, side = "right", start = { 1 = 0 } }
mass = 8
centre = "C"
inertia = "8*0.35**2"
[[loads]]
at = "P"
link = 1
force = [0, 100]
[[drivers]]
roll = 1
position = 0
speed = 0
acceleration = "$RATE"
"""


def spool(alpha: float) -> Held:
    return Held(METRES + SPOOL.replace('"$RATE"', repr(0.5 * alpha)))


def test_hibbeler_17_14_spool_on_two_cords():
    """Page 754: 8 kg, k = 0.35 m; 100 N on 0.2 m, another cord on 0.5 m. α = 10.3 rad/s².

    The cord of 0.5 m is a track here, up which the spool rolls; its pull is the force along it.
    """
    assert spool(10.25).force().imag < 0 < spool(10.35).force().imag
    alpha = (100 * 0.7 - 8 * 9.81 * 0.5) / (8 * 0.35**2 + 8 * 0.5**2)
    held = spool(alpha)
    assert abs(held.force()) < 1e-10
    assert exactly(held.on("1-0", 1), (8 * 9.81 - 100 + 8 * 0.5 * alpha) * 1j)
    assert exactly(held.on("1-0", 1), (20 - 8 * 0.35**2 * alpha) / 0.5 * 1j)


WHEEL = """
gravity = true
[frame]
R = [0, 0]
[links.1]
O-G = 0.1
wheel = { centre = "O", radius = 0.25 }
rolls = { on = 0, through = "R", angle = 0, start = { 1 = 0 } }
mass = 30
centre = "G"
inertia = "30*0.15**2"
[[drivers]]
roll = 1
position = 0
speed = 0
acceleration = "$RATE"
"""


def test_hibbeler_17_17_wheel_with_its_mass_beside_the_axle():
    """Page 757: 30 kg, k_G = 0.15 m, G level with the axle, 0.1 m off; from rest. 10.3 rad/s²."""
    rolled = {a: Held(METRES + WHEEL.replace('"$RATE"', repr(0.25 * a))) for a in (10.25, 10.35)}
    assert rolled[10.25].force().real < 0 < rolled[10.35].force().real
    alpha = 30 * 9.81 * 0.1 / (30 * 0.15**2 + 30 * (0.25**2 + 0.1**2))
    held = Held(METRES + WHEEL.replace('"$RATE"', repr(0.25 * alpha)))
    assert abs(held.force()) < 1e-10
    assert exactly(held.on("1-0", 1), 30 * 0.25 * alpha + 30 * (9.81 - 0.1 * alpha) * 1j)


# --- J. L. Meriam, L. G. Kraige, Engineering Mechanics: Dynamics, chapter 6 ----------------------

LIFTED = """
gravity = true
[frame]
C = [0, 0]
D = [0, 1.8]
[links.1]
C-A = 1.5
[links.2]
A-S = 1.2
A-B = 1.8
S = "on A-B"
mass = 150
centre = "S"
[links.3]
D-B = 1.5
[[drivers]]
turn = 1
angle = 30
speed = "$SPEED"
acceleration = "$RATE"
[branches]
B = "right of A-D"
"""


def test_meriam_6_2_bar_lifted_by_parallel_links():
    """Page 423: 150 kg, a couple of 5 kN·m on AC, from rest at 0°. Printed 2.14 kN in DB at 30°."""
    theta, push = math.pi / 6, 5000 / 1.5 / 150
    speed = math.sqrt(2 * (push * theta - 9.81 * math.sin(theta)) / 1.5)
    rate = (push - 9.81 * math.cos(theta)) / 1.5
    text = LIFTED.replace('"$SPEED"', repr(speed)).replace('"$RATE"', repr(rate))
    held = Held(METRES + text)
    assert rounds_to(abs(held.on("D", 3)) / 1000, "2.14")
    assert exactly(held.moment(), 5000)


PENDULUM = """
gravity = true
[frame]
O = [0, 0]
[links.1]
O-G = 0.25
mass = 7.5
centre = "G"
inertia = "7.5*(0.295**2 - 0.25**2)"
[[drivers]]
turn = 1
angle = -60
speed = "$SPEED"
acceleration = "$RATE"
"""


def test_meriam_6_4_pendulum():
    """Page 433: 7.5 kg, 250 mm, k_O = 295 mm, from level, at 60°. O_t = 10.37 N, O = 155.6 N."""
    rate = 0.25 * 9.81 / 0.295**2
    speed = math.sqrt(2 * rate * math.sin(math.radians(60)))
    text = PENDULUM.replace('"$SPEED"', repr(-speed)).replace('"$RATE"', repr(-rate / 2))
    held = Held(METRES + text)
    assert abs(held.moment()) < 1e-12 * 20
    pin, way = held.on("O", 1), complex(0.5, -math.sqrt(0.75))
    across = (way.conjugate() * pin).imag
    assert within(abs(pin), 155.6, TENTHS)
    assert within(across, 10.37, TENTHS)
    assert exactly(across, 7.5 * (9.81 - 0.25 * rate) / 2)


CABLE = """
gravity = true
[frame]
R = [0, 0]
[links.1]
C-P = 0.15
wheel = { centre = "C", radius = 0.45 }
rolls = { on = 0, through = "R", angle = 0, start = { 1 = -90 } }
mass = 70
centre = "C"
inertia = "70*0.25**2"
[[loads]]
at = "P"
link = 1
force = ["$PULL", 0]
[[drivers]]
roll = 1
position = 0
speed = 0
acceleration = "-0.45*2.5"
"""


def test_meriam_6_6_spool_on_a_cable():
    """Page 447: 70 kg, k = 250 mm, rims of 150 and 450 mm, α = 2.5 rad/s². T = 154.6, F = 75.8 N.

    F - T = -m·a and r·F - r_i·T = J·α.
    """
    mass, inertia, rim, inner, alpha = 70, 70 * 0.25**2, 0.45, 0.15, 2.5
    pull = (rim * mass * rim * alpha + inertia * alpha) / (rim - inner)
    held = Held(METRES + CABLE.replace('"$PULL"', repr(-pull)))
    assert abs(held.force()) < 1e-10
    contact = held.on("1-0", 1)
    assert rounds_to(pull, "154.6")
    assert rounds_to(contact.real, "75.8")
    assert exactly(contact.imag, 70 * 9.81)


SLOTS = f"""
gravity = [0, {-32.2 * FT!r}]
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[links.2]
A-G = {2 * FT!r}
A-B = {4 * FT!r}
G = "on A-B"
mass = {60 * LB / 32.2 / FT!r}
centre = "G"
inertia = {60 * LB / 32.2 / FT * (4 * FT) ** 2 / 12!r}
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 90 }}
[[loads]]
at = "A"
link = 1
force = [{30 * LB!r}, 0]
[[drivers]]
slide = 1
position = "-2*0.3048"
speed = 0
acceleration = "$RATE"
[branches]
3 = "forward"
"""


def test_meriam_6_7_bar_in_two_slots():
    """Page 448: 60 lb, 4 ft, 30° off the vertical, 30 lb. A = 68.2, B = 15.74 lb, α = 4.42 rad/s².

    α = (F·l·cos θ - W·(l/2)·sin θ)/(m·l²/3), about the instant centre.
    """
    sine, cosine = math.sin(math.pi / 6), math.cos(math.pi / 6)
    alpha = (30 * 4 * cosine - 60 * 2 * sine) / (60 / 32.2 * 16 / 3)
    held = Held(METRES + SLOTS.replace('"$RATE"', repr(4 * cosine * alpha * FT)))
    assert rounds_to(alpha, "4.42")
    assert exactly(held.solution.links["2"].epsilon, alpha)
    assert abs(held.force()) < 1e-9
    assert rounds_to(held.on("1-0", 1).imag / LB, "68.2")
    assert rounds_to(-held.on("3-0", 3).real / LB, "15.74")


# --- W. G. McLean, E. W. Nelson, Engineering Mechanics (Schaum), chapter 16 ----------------------

ROLLER = f"""
gravity = [0, {-32.2 * FT!r}]
[frame]
R = [0, 0]
[links.1]
C = [0, 0]
wheel = {{ centre = "C", radius = {1.25 * FT!r} }}
rolls = {{ on = 0, through = "R", angle = -25 }}
mass = {600 * LB / 32.2 / FT!r}
centre = "C"
inertia = {600 * LB / 32.2 / FT * (1.25 * FT) ** 2 / 2!r}
[[drivers]]
roll = 1
position = 0
speed = 0
acceleration = "$RATE"
"""


def test_mclean_16_2_cylinder_down_a_plane():
    """Page 335: 600 lb, 30 in, 25°. F = 84.4 lb, a = 9.06 ft/s², with sin 25° = 0.422.

    a = (2/3)·g·sin θ, F = W·sin θ/3.
    """
    sine, cosine = math.sin(math.radians(25)), math.cos(math.radians(25))
    held = Held(METRES + ROLLER.replace('"$RATE"', repr(2 / 3 * 32.2 * sine * FT)))
    assert abs(held.force()) < 1e-9
    contact = held.on("1-0", 1) / LB * complex(cosine, sine)
    assert within(-contact.real, 84.4, TENTHS)
    assert within(2 / 3 * 32.2 * sine, 9.06, TENTHS)
    assert exactly(contact, complex(-600 * sine / 3, 600 * cosine))
