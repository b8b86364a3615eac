"""Forces with a closed form: each test derives the formula that it states. Gear trains of Khurmi.

Where no book is named, the problem is the common property of textbooks, and its formula a
derivation by moments, virtual work or d'Alembert. Each is also held to fifty digits.
"""

from __future__ import annotations

import cmath
import math

import pytest

from tests.scene_files import scene_text
from tests.textbook.book import Held, exactly, within

METRES = 'units = { length = "m", angle = "deg", speed = "rad/s" }\n'
G = 9.81


def unit(degrees: float) -> complex:
    return cmath.rect(1, math.radians(degrees))


# --- static force analysis -----------------------------------------------------------------------

TOGGLE = """
[frame]
O = [0, 0]
[links.1]
O-A = 0.3
[links.2]
A-B = 0.3
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
at = "A"
link = 1
force = [0, -100]
[[drivers]]
slide = 3
position = "0.6*cos({alpha})"
speed = 0
[branches]
A = "left of O-B"
"""


@pytest.mark.parametrize("alpha", [1, 5, 20, 45, 80])
def test_a_toggle_press_multiplies_by_half_the_cotangent(alpha):
    """Q = P/(2·tan α): from P·δy = Q·δx with y = l·sin α, x = 2·l·cos α."""
    held = Held(METRES + TOGGLE.format(alpha=alpha))
    assert exactly(held.force(3), -100 / (2 * math.tan(math.radians(alpha))))


FOUR_BAR = """
[frame]
A = [0, 0]
D = [0.5, 0]
[links.1]
A-B = 0.15
[links.2]
B-C = 0.45
[links.3]
D-C = 0.3
[[loads]]
link = 3
moment = 80
[[drivers]]
turn = 1
angle = {angle}
speed = 0
[branches]
C = "left of B-D"
"""


@pytest.mark.parametrize("angle", [20, 100, 200, 290])
def test_torques_of_a_four_bar_are_as_the_distances_of_its_relative_centre(angle):
    """M1 = -M3·ω3/ω1 and ω3/ω1 = AI/DI, where the coupler's line cuts the frame's at I."""
    held = Held(METRES + FOUR_BAR.format(angle=angle))
    points = {name: each.position for name, each in held.solution.points.items()}
    along = points["C"] - points["B"]
    cut = points["B"].real - points["B"].imag * along.real / along.imag
    assert exactly(held.moment(), -80 * cut / (cut - 0.5))
    coupler = held.on("B", 2)
    assert exactly((coupler.conjugate() * along).imag, 0, largest=abs(coupler * along))


BELL_CRANK = """
[frame]
O = [0, 0]
V = [-0.12, 0]
H = [0, 0.2]
[links.1]
O-A = 0.12
A-O-B = -90
O-B = 0.2
[links.2]
A = [0, 0]
slides = {{ on = 3, through = "S", angle = 90 }}
[links.3]
S = [0, 0]
slides = {{ on = 0, through = "V", angle = 90 }}
[[loads]]
at = "B"
link = 1
force = [70, 0]
[[drivers]]
slide = 3
position = {height}
speed = 0
[branches]
2 = "forward"
"""


@pytest.mark.parametrize("height", [0.0, 0.03, -0.05])
def test_a_bell_crank_carries_as_its_arms_are(height):
    """S·a·cos β = F·b·cos β: the sleeve of a Hartnell governor, whatever the angle β.

    Arms a = 120 mm level and b = 200 mm upright, square to one another, turned by β together.
    """
    held = Held(METRES + BELL_CRANK.format(height=height))
    assert exactly(abs(held.force(3)), 70 * 0.2 / 0.12)


YOKE = """
[frame]
O = [0, 0]
[links.1]
O-A = 0.05
[links.2]
A = [0, 0]
slides = {{ on = 3, through = "S", angle = 90 }}
[links.3]
S = [0, 0]
mass = 6
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
at = "S"
link = 3
force = [-40, 0]
[[drivers]]
turn = 1
angle = {angle}
speed = 30
[branches]
"""


@pytest.mark.parametrize("angle", [15, 110, 250])
def test_a_scotch_yoke_has_one_harmonic(angle):
    """The yoke at r·cos θ: N = F - m·r·ω²·cos θ on its slot; M = -N·r·sin θ on the crank."""
    held = Held(METRES + YOKE.format(angle=angle))
    push = 40 - 6 * 0.05 * 30**2 * math.cos(math.radians(angle))
    assert exactly(held.on("2-3", 3), push)
    assert exactly(held.moment(), -push * 0.05 * math.sin(math.radians(angle)))


LEVER = """
[frame]
O = [0, 0]
C = [0, -0.3]
[links.1]
O-A = 0.1
[links.2]
A = [0, 0]
slides = {{ on = 3, through = "C", angle = 0 }}
[links.3]
C = [0, 0]
E = [0.5, 0]
[[loads]]
link = 3
moment = 120
[[drivers]]
turn = 1
angle = {angle}
speed = 0
[branches]
2 = "forward"
"""


@pytest.mark.parametrize("angle", [0, 40, 190, 300])
def test_the_block_of_a_slotted_lever_presses_with_the_moment_over_its_distance(angle):
    """N = M3/CA square to the lever, and M1 = -M3·r·(r + d·sin θ)/CA² for the pivot d below."""
    held = Held(METRES + LEVER.format(angle=angle))
    arm = 0.1 * unit(angle) + 0.3j
    assert exactly(abs(held.on("2-3", 3)), 120 / abs(arm))
    sine = math.sin(math.radians(angle))
    assert exactly(held.moment(), -120 * 0.1 * (0.1 + 0.3 * sine) / abs(arm) ** 2)


SCISSORS = """
[frame]
O = [0, 0]
[links.1]
O-M = 0.8
O-B = 1.6
M = "on O-B"
[links.2]
A-M = 0.8
A-C = 1.6
M = "on A-C"
[links.3]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[links.4]
C = [0, 0]
W = [{where}, 0.1]
[links.5]
B = [0, 0]
slides = {{ on = 4, through = "C", angle = 0 }}
[[loads]]
at = "W"
link = 4
force = [0, -3000]
[[drivers]]
slide = 3
position = "1.6*cos({angle})"
speed = 0
[branches]
M = "left of O-A"
5 = "forward"
"""


@pytest.mark.parametrize("where", [0.1, 0.6, 1.2])
@pytest.mark.parametrize("angle", [15, 50])
def test_a_scissor_lift_is_pushed_by_the_cotangent(angle, where):
    """F = W·cot α wherever the load stands: y = L·sin α, x = L·cos α."""
    held = Held(METRES + SCISSORS.format(angle=angle, where=where))
    assert exactly(held.force(3), -3000 / math.tan(math.radians(angle)))


LADDER = """
gravity = true
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[links.2]
A-G = 1
A-B = 2
G = "on A-B"
mass = 12
centre = "G"
inertia = 4
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 90 }}
[[drivers]]
slide = 1
position = "2*cos({angle})"
speed = 0
[branches]
3 = "forward"
"""


@pytest.mark.parametrize("angle", [20, 45, 75])
def test_a_ladder_at_a_wall_is_held_by_half_its_weight_times_the_cotangent(angle):
    """H = (W/2)·cot α on the floor and the wall, W on the floor."""
    held = Held(METRES + LADDER.format(angle=angle))
    side = 12 * G / 2 / math.tan(math.radians(angle))
    assert exactly(held.force(1), -side)
    assert exactly(held.on("3-0", 3), side)
    assert exactly(held.on("1-0", 1), 12j * G)


ROBERVAL = """
[frame]
O = [0, 0]
Q = [0, -0.2]
[links.1]
O-A = 0.3
O-B = 0.3
A-O-B = 180
[links.2]
C-Q = 0.3
[links.3]
A-C = 0.2
P = {{ from = "A", length = {out}, angle = 75 }}
[[loads]]
at = "P"
link = 3
force = [0, -50]
[[loads]]
at = "B"
link = 1
force = [0, -50]
[[drivers]]
turn = 1
angle = 12
speed = 0
[branches]
C = "left of A-Q"
"""


@pytest.mark.parametrize("out", [0.05, 0.4, 2])
def test_a_roberval_balance_weighs_alike_wherever_the_load_stands(out):
    """The pan moves without turning: equal weights balance, however far out one stands."""
    held = Held(METRES + ROBERVAL.format(out=out))
    assert abs(held.moment()) < 1e-10 * 50
    points = {name: each.position for name, each in held.solution.points.items()}
    assert exactly(points["A"] - points["C"], 0.2j)


BOOM = """
gravity = true
[frame]
O = [0, 0]
H = [1, -0.5]
[links.boom]
O-D = 2
O-E = 5
D = "on O-E"
[links.barrel]
H = [0, 0]
[links.rod]
D = [0, 0]
slides = {{ on = "barrel", through = "H", angle = 0 }}
[[loads]]
at = "E"
link = "boom"
force = [0, -8000]
[[drivers]]
slide = "rod"
against = "barrel"
position = "{length!r}"
speed = 0
[branches]
D = "right of H-O"
"""


@pytest.mark.parametrize("angle", [5, 40, 65])
def test_the_cylinder_of_a_boom_pushes_with_the_moment_over_its_arm(angle):
    """F = W·x/h with h the distance of the cylinder's line from the boom's pivot."""
    d, foot = 2 * unit(angle), 1 - 0.5j
    length = abs(d - foot)
    held = Held(METRES + BOOM.format(length=length))
    arm = abs((foot.conjugate() * (d - foot)).imag) / length
    assert exactly(abs(held.force("rod")), 8000 * 5 * math.cos(math.radians(angle)) / arm)


# --- trains of wheels ----------------------------------------------------------------------------

IDLER = """
module = 4
[frame]
O1 = [0, 0]
O2 = [100, 0]
O3 = [220, 0]
[links.1]
O1-A = 30
wheel = { centre = "O1", teeth = 20 }
[links.2]
O2-B = 30
wheel = { centre = "O2", teeth = 30 }
rolls = { on = 1, start = { 1 = 0, 2 = 0 } }
[links.3]
O3-C = 30
wheel = { centre = "O3", teeth = 30 }
rolls = { on = 2, start = { 2 = 0, 3 = 0 } }
[[loads]]
link = 3
moment = 24
[[drivers]]
turn = 1
angle = 10
speed = 0
"""


def test_the_pin_of_an_idler_carries_twice_the_tangential_force():
    """F_t = M3/r3 on both sides of an idler in line; what the teeth push along the line cancels."""
    held = Held('units = { length = "mm", angle = "deg", speed = "rad/s" }\n' + IDLER)
    assert exactly(abs(held.on("O2", 2)), 2 * 24 / 0.06)
    assert exactly(held.on("O2", 2).real, 0, largest=800)
    assert exactly(held.moment(), -24 * 20 / 30)


EPICYCLIC = """
module = 3
[frame]
O = [0, 0]
[links.sun]
O-S = 20
wheel = { centre = "O", teeth = 16 }
[links.arm]
O-P = 60
[links.planet]
P-Q = 30
wheel = { centre = "P", teeth = 24 }
rolls = [{ on = "sun" }, { on = "ring" }]
[links.ring]
O-R = 90
wheel = { centre = "O", teeth = 64, inside = true }
[[loads]]
link = "arm"
moment = -500
[[drivers]]
turn = "sun"
angle = 0
speed = 5
[[drivers]]
turn = "ring"
angle = 0
speed = 0
"""


def test_khurmi_13_20_torque_that_holds_the_annulus():
    """Page 465: sun of 16 teeth, annulus of 64, 100 N·m on the sun. Printed 400 N·m.

    The arm gives 100·5 N·m, which is the load here.
    """
    held = Held('units = { length = "mm", angle = "deg", speed = "rad/s" }\n' + EPICYCLIC)
    assert exactly(held.solution.links["arm"].omega, 1)
    assert exactly(held.moment("sun"), 100)
    assert exactly(held.moment("ring"), 400)


COMPOUND = """
module = 3
[frame]
O = [0, 0]
[links.A]
O-S = 20
wheel = { centre = "O", teeth = 15 }
[links.arm]
O-P = 52.5
[links.BC]
P-Q = 20
wheels = [{ centre = "P", teeth = 20 }, { centre = "P", teeth = 15 }]
rolls = [{ on = "A" }, { on = "E" }]
[links.E]
O-R = 90
wheel = { centre = "O", teeth = 55, inside = true }
[links.D]
O-T = 80
wheel = { centre = "O", teeth = 50, inside = true }
rolls = { on = "BC" }
[[loads]]
link = "D"
moment = "$LOAD"
[[drivers]]
turn = "A"
angle = 0
speed = 1000
[[drivers]]
turn = "E"
angle = 0
speed = 0
"""


def test_khurmi_13_19_torque_of_the_machine_shaft():
    """Page 463: A 15, B 20, C 15, D 50, E 55 fixed, 100 N·m. Printed 2692 N·m at 37.15 rev/min.

    The book rounds the arm's 214.3 rev/min to 214. Exactly, D turns at 37.5 rev/min.
    """
    exact = 100 * 1000 / 37.5
    assert within(exact, 2692, 0.01)
    text = COMPOUND.replace('"$LOAD"', repr(-exact))
    held = Held('units = { length = "mm", angle = "deg", speed = "rev/min" }\n' + text)
    assert exactly(held.solution.links["D"].omega, 37.5 * math.pi / 30)
    assert exactly(held.moment("A"), 100)
    assert exactly(held.moment("E"), exact - 100)


# --- inertia forces ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "state", [(20, 50, 0, 0, 0, 0), (-30, 100, 3, -7, 0, 0), (110, -60, -2, 5, 11, -13)]
)
def test_craig_6_7_torques_of_an_arm_of_two_links(state):
    """J. J. Craig, Introduction to Robotics, section 6.7: two links with masses at their ends."""
    q1, q2, u1, u2, a1, a2 = state
    arm = scene_text("laws/arm-of-two-links", q1=q1, q2=q2, u1=u1, u2=u2, a1=a1, a2=a2)
    held = Held(METRES + arm)
    m1, m2, l1, l2 = 3, 2, 0.7, 0.4
    one, other = math.radians(q1), math.radians(q2)
    c1, c2, s2, c12 = math.cos(one), math.cos(other), math.sin(other), math.cos(one + other)
    end = m2 * l2**2 * (a1 + a2) + m2 * l2 * G * c12
    second = end + m2 * l1 * l2 * (c2 * a1 + s2 * u1**2)
    first = end + m2 * l1 * l2 * (c2 * (2 * a1 + a2) - s2 * u2**2 - 2 * s2 * u1 * u2)
    first += (m1 + m2) * l1 * (l1 * a1 + G * c1)
    assert exactly(held.moment(1), first)
    assert exactly(held.moment(2), second)


FLYWHEEL = """
gravity = true
[frame]
O = [0, 0]
[links.1]
O-S = 0.04
mass = 25
centre = "S"
inertia = 0.9
[[drivers]]
turn = 1
angle = {angle}
speed = 18
acceleration = 7
"""


@pytest.mark.parametrize("angle", [0, 65, 170])
def test_a_flywheel_off_its_axis_shakes_and_needs_its_moment(angle):
    """M = (J + m·e²)·ε + m·g·e·cos φ; the bearing carries m·(a - g)."""
    held = Held(METRES + FLYWHEEL.format(angle=angle))
    cosine = math.cos(math.radians(angle))
    assert exactly(held.moment(), (0.9 + 25 * 0.04**2) * 7 + 25 * G * 0.04 * cosine)
    assert exactly(held.on("O", 1), 25 * (0.04 * complex(-(18**2), 7) * unit(angle) + 1j * G))


ROD = """
gravity = true
[frame]
O = [0, 0]
[links.1]
O-C = 0.1
[links.2]
C-D = {d}
C-G = 0.15
C-P = 0.25
D = "on C-P"
G = "on C-P"
{masses}
[links.3]
P = [0, 0]
mass = {piston}
slides = {{ on = 0, through = "O", angle = 0 }}
{load}
[[drivers]]
turn = 1
angle = {angle}
speed = 90
[branches]
3 = "forward"
"""


@pytest.mark.parametrize("angle", [25, 130, 300])
def test_khurmi_15_18_a_rod_as_two_masses_and_a_couple(angle):
    """Page 550: 2 kg, l = 250 mm, G at 100 mm from the gudgeon pin, k = 110 mm.

    Printed: 1.1 kg at the gudgeon pin and 0.9 kg 121 mm beyond G are equivalent; with the second
    mass at the crank pin, a couple m·(l1·l3 - k²)·α is missing, 133.4 N·m for 23 000 rad/s².
    """
    k, l1, l3 = 0.110, 0.100, 0.150
    l2 = k**2 / l1
    at_pin, beyond = 2 * l2 / (l1 + l2), 2 * l1 / (l1 + l2)
    assert within(at_pin, 1.1, 0.01)
    assert within(beyond, 0.9, 0.01)
    rod = f'mass = 2\ncentre = "G"\ninertia = {2 * k**2!r}'
    whole = Held(METRES + ROD.format(d=0.05, masses=rod, piston=0, load="", angle=angle))

    point = f'mass = {beyond!r}\ncentre = "D"'
    two = Held(METRES + ROD.format(d=l3 - l2, masses=point, piston=at_pin, load="", angle=angle))
    assert exactly(two.moment(), whole.moment())
    assert exactly(two.on("O", 1), whole.on("O", 1))

    alpha = whole.solution.links["2"].epsilon
    couple = 2 * (l1 * l3 - k**2) * alpha
    assert within(2 * (l1 * l3 - k**2) * 23000, 133.4, 1e-3)
    ends = f'mass = {2 * l1 / 0.25!r}\ncentre = "C"'
    load = f"[[loads]]\nlink = 2\nmoment = {couple!r}"
    pins = Held(
        METRES + ROD.format(d=0.05, masses=ends, piston=2 * l3 / 0.25, load=load, angle=angle)
    )
    assert exactly(pins.moment(), whole.moment())
    assert exactly(pins.on("O", 1), whole.on("O", 1))


HUB = """
gravity = true
[frame]
R = [0, 0]
[links.1]
C-P = 0.3
wheel = { centre = "C", radius = 0.3 }
rolls = { on = 0, through = "R", angle = 0, start = { 1 = 0 } }
mass = 40
centre = "C"
inertia = 1.3
[[drivers]]
roll = 1
position = 0.2
speed = 3
acceleration = 2.5
"""


def test_a_rolling_wheel_weighs_more_by_its_inertia():
    """P = (m + J/r²)·a at the axle; the track takes J·a/r² backwards, and the weight."""
    held = Held(METRES + HUB)
    assert exactly(held.force(), (40 + 1.3 / 0.3**2) * 2.5)
    assert exactly(held.on("1-0", 1), complex(-1.3 * 2.5 / 0.3**2, 40 * G))


BLOCK = """
[frame]
O = [0, 0]
[links.1]
B = [0, 0]
T = [0.2, 0.5]
mass = 10
centre = "T"
slides = { on = 0, through = "O", angle = 0 }
[[loads]]
at = "T"
link = 1
force = [0, -90]
[[drivers]]
slide = 1
position = 0
speed = 0
acceleration = 4
"""


def test_the_reaction_of_a_guide_passes_where_its_moments_are_zero():
    """A block pushed at B with its mass at (x, y) from there: the guide pushes at x + m·a·y/N."""
    held = Held(METRES + BLOCK)
    assert exactly(held.force(), 40)
    assert exactly(held.on("1-0", 1), 90j)
    assert exactly(held.place("1-0"), 0.2 + (-40 * 0.5) / 90)
