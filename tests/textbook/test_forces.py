"""Forces of reciprocating engines, R. S. Khurmi, J. K. Gupta, Theory of Machines, chapter 15.

Two are from B. K. Sarkar's book of the same title, chapter 5.

The book prints the reactions for the piston effort, which it finds with an approximate acceleration
of the piston. The piston effort is the load here, so that only the equilibrium is compared. We know
the printed answers from quotations of the book and from FOSSEE's Python Textbook Companions. It
works with three figures.
"""

from __future__ import annotations

import math

from graphkin.construction.core.solution import by_name
from tests.textbook.book import DRAWN, Held, exactly, mechanism, within

ROUNDED = 0.003
"""Share of itself by which three figures round."""
ENGINE = """
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
[frame]
O = [0, 0]
[links.1]
O-C = {r}
[links.2]
C-P = {l}
[links.3]
P = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
at = "P"
link = 3
force = [{effort}, 0]
[[drivers]]
turn = 1
angle = {angle}
speed = 0
[branches]
3 = "forward"
"""


def piston_effort(gas: float, mass: float, speed: float, r: float, n: float, angle: float) -> float:
    """The gas force less the book's m r ω² (cos θ + cos 2θ / n); r in m, speed in rev/min."""
    omega, theta = speed * math.pi / 30, math.radians(angle)
    return gas - mass * r * omega**2 * (math.cos(theta) + math.cos(2 * theta) / n)


def test_khurmi_15_7_thrust_crank_pin_and_moment():
    """r = 300 mm, l = 1.2 m, bore 0.5 m, 250 kg, 0.35 N/mm², 60°, 250 rev/min.

    Printed: thrust in the rod 50.62 kN, tangential force on the crank pin 48.28 kN, turning moment
    14.484 kN·m.
    """
    effort = piston_effort(0.35e6 * math.pi / 4 * 0.5**2, 250, 250, 0.3, 4, 60)
    given = ENGINE.format(r=300, l=1200, effort=-effort, angle=60)
    found, verdict = mechanism(given).forces()
    assert verdict.agrees
    thrust = next(e.force for e in by_name(found, "C")["C"] if e.link == "1")
    crank = complex(math.cos(math.pi / 3), math.sin(math.pi / 3))
    assert within(abs(thrust) / 1000, 50.62, ROUNDED)
    assert within(abs((thrust * crank.conjugate()).imag) / 1000, 48.28, ROUNDED)
    (balance,) = found.balance
    assert within(abs(balance.moment) / 1000, 14.484, ROUNDED)


def test_khurmi_steam_engine_moment_and_thrust_on_the_bearings():
    """r = 200 mm, l = 0.6 m, bore 250 mm, rod 50 mm, 60 kg, 550 and 70 kN/m², 45°, 120 rev/min.

    Printed: turning moment 3920 N·m, thrust on the bearings 11.96 kN. The thrust on the bearings is
    the part of the rod's force along the crank.
    """
    piston, rod = (math.pi / 4 * d**2 for d in (0.25, 0.05))
    effort = piston_effort(550e3 * piston - 70e3 * (piston - rod), 60, 120, 0.2, 3, 45)
    given = ENGINE.format(r=200, l=600, effort=-effort, angle=45)
    found, verdict = mechanism(given).forces()
    assert verdict.agrees
    (balance,) = found.balance
    thrust = next(e.force for e in by_name(found, "O")["O"] if e.link == "1")
    crank = complex(math.cos(math.pi / 4), math.sin(math.pi / 4))
    assert within(abs((thrust * crank.conjugate()).real) / 1000, 11.96, ROUNDED)
    assert within(abs(balance.moment), 3920, ROUNDED)


def thrust_in_rod(found) -> complex:
    """The force of the connecting rod on the piston."""
    return next(e.force for e in by_name(found, "P")["P"] if e.link == "3")


def test_khurmi_vertical_steam_engine_effective_turning_moment():
    """Bore 300 mm, stroke 450 mm, 200 rev/min, 225 kg, rod 50 mm, l = 1.2 m, 125° from the top.

    Steam 30 kN/m² above the piston, 1.5 kN/m² below. Printed: 3021.6 N·m.
    """
    piston, rod = (math.pi / 4 * d**2 for d in (0.3, 0.05))
    gas = 30e3 * piston - 1.5e3 * (piston - rod) + 225 * 9.81
    effort = piston_effort(gas, 225, 200, 0.225, 1.2 / 0.225, 125)
    found, verdict = mechanism(ENGINE.format(r=225, l=1200, effort=-effort, angle=125)).forces()
    assert verdict.agrees
    (balance,) = found.balance
    assert within(abs(balance.moment), 3021.6, ROUNDED)


def test_khurmi_petrol_engine_gudgeon_pin_and_cylinder_walls():
    """Bore 100 mm, stroke 120 mm, l = 250 mm, 1.1 kg, 2000 rev/min, 20° from the top, 700 kN/m².

    Printed: load on the gudgeon pin 2265 N, thrust on the cylinder walls 185.5 N.
    """
    gas = 700e3 * math.pi / 4 * 0.1**2 + 1.1 * 9.81
    effort = piston_effort(gas, 1.1, 2000, 0.06, 250 / 60, 20)
    found, verdict = mechanism(ENGINE.format(r=60, l=250, effort=-effort, angle=20)).forces()
    assert verdict.agrees
    assert within(abs(thrust_in_rod(found)), 2265, ROUNDED)
    (guide,) = by_name(found, "3").values()
    assert within(abs(guide[0].force), 185.5, ROUNDED)


def test_khurmi_15_7_pressure_on_the_slide_bars():
    """The engine above. Printed: 10.96 kN."""
    effort = piston_effort(0.35e6 * math.pi / 4 * 0.5**2, 250, 250, 0.3, 4, 60)
    found, _ = mechanism(ENGINE.format(r=300, l=1200, effort=-effort, angle=60)).forces()
    (guide,) = by_name(found, "3").values()
    assert within(abs(guide[0].force) / 1000, 10.96, ROUNDED)


def reaction_of(gas_less_inertia: float, r: float, rod: float, angle: float) -> Held:
    """The engine at rest under a piston effort (N) towards the crank; mm and degrees."""
    return Held(ENGINE.format(r=r, l=rod, effort=-gas_less_inertia, angle=angle))


def along_crank(held: Held, angle: float) -> float:
    """The part of the rod's force on the crank along it: the thrust on the bearings."""
    crank = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    return abs((held.on("O", 1) * crank.conjugate()).real)


def test_khurmi_15_9_petrol_engine():
    """Page 534: 80 mm, r = 50, l = 200 mm, 1 kg, 0.7 N/mm², 1800 rev/min, 33° (measured).

    Printed 1866 N in the rod, 254 N on the cylinder. The piston has its mass here; its exact
    acceleration is not the book's r ω² (cos θ + cos 2θ/n), and the effort is a small difference.
    """
    gas = 0.7e6 * math.pi / 4 * 0.08**2
    text = ENGINE.format(r=50, l=200, effort=-gas, angle=33).replace("speed = 0", "speed = 1800")
    held = Held(text.replace("[links.3]\n", "[links.3]\nmass = 1\n"))
    assert within(abs(held.on("P", 3)), 1866, 0.01)
    assert within(abs(held.on("3-0", 3)), 254, 0.01)
    theta, omega = math.radians(33), 1800 * math.pi / 30
    root = math.sqrt(16 - math.sin(theta) ** 2)
    bend = (math.cos(2 * theta) * root**2 + (math.sin(2 * theta) / 2) ** 2) / root**3
    effort = gas - 0.05 * omega**2 * (math.cos(theta) + bend)
    assert exactly(abs(held.on("3-0", 3)), effort * math.sin(theta) / root)


def test_khurmi_15_10_steam_engine_with_friction():
    """Page 536: 300 mm, r = 300 mm, n = 4.5, 180 kg at 36 m/s², 0.5 N/mm², 600 N, 30°.

    Printed 22.9 kN on the bearings and 5.06 kN·m.
    """
    held = reaction_of(0.5e6 * math.pi / 4 * 0.3**2 - 180 * 36 - 600, 300, 1350, 30)
    assert within(along_crank(held, 30) / 1000, 22.9, ROUNDED)
    assert within(abs(held.moment()) / 1000, 5.06, ROUNDED)


def test_khurmi_15_13_diesel_engine():
    """Page 540: 300 and 500 mm, n = 4.5, 280 kg, 180 rev/min, 45°, 2.2 N/mm² over 0.1.

    Printed 109.5 kN across the crank, 79.44 kN on the bearings, 27.38 kN·m.
    """
    gas = (2.2 - 0.1) * 1e6 * math.pi / 4 * 0.3**2 + 280 * 9.81
    held = reaction_of(piston_effort(gas, 280, 180, 0.25, 4.5, 45), 250, 1125, 45)
    assert within(abs(held.moment()) / 250, 109.501, ROUNDED)
    assert within(along_crank(held, 45) / 1000, 79.438, ROUNDED)
    assert within(abs(held.moment()) / 1000, 27.38, ROUNDED)


def test_khurmi_15_14_vertical_steam_engine():
    """Page 542: 240 and 360 mm, l = 0.6 m, 160 kg, 300 rev/min, 75°, cut off at a third.

    Printed 5778 N·m; the steam expands with p·v constant to the stroke x at 75°.
    """
    x = 0.18 * (1 - math.cos(math.radians(75)) + math.sin(math.radians(75)) ** 2 * 0.18 / 1.2)
    pressure = 9.03e5 * 0.36 / 3 / x - 0.28e5
    gas = pressure * math.pi / 4 * 0.24**2 + 160 * 9.81 - 500
    held = reaction_of(piston_effort(gas, 160, 300, 0.18, 0.6 / 0.18, 75), 180, 600, 75)
    assert within(abs(held.moment()), 5778, ROUNDED)


def test_sarkar_5_6_horizontal_steam_engine():
    """B. K. Sarkar, Theory of Machines, page 165: 250 mm, rod 50 mm, n = 3, r = 200 mm, 40°.

    5.8 and 0.5 bar. Printed 4233.8 N·m and 16 321 N on the bearings.
    """
    gas = math.pi / 4 * (0.25**2 * 5.8e5 - (0.25**2 - 0.05**2) * 0.5e5)
    held = reaction_of(gas, 200, 600, 40)
    assert within(abs(held.moment()), 4233.8, ROUNDED)
    assert within(along_crank(held, 40), 16321.0, ROUNDED)


def test_sarkar_5_4_petrol_engine():
    """Page 162: 100 and 120 mm, l = 250 mm, 1.2 kg, 1800 rev/min, 25°, 680 kN/m².

    Printed 2652.9 N on the gudgeon pin, 269.1 N on the walls.
    """
    gas = 680e3 * math.pi / 4 * 0.1**2 + 1.2 * 9.81
    held = reaction_of(piston_effort(gas, 1.2, 1800, 0.06, 250 / 60, 25), 60, 250, 25)
    assert within(abs(held.on("P", 3)), 2652.9, ROUNDED)
    assert within(abs(held.on("3-0", 3)), 269.1, ROUNDED)


WITH_ROD = """
{gravity}
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
[frame]
O = [0, 0]
[links.1]
O-C = {r}
[links.2]
C-P = {l}
C-G = {g}
G = "on C-P"
mass = {rod}
centre = "G"
inertia = {inertia}
[links.3]
P = [0, 0]
mass = {piston}
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
at = "P"
link = 3
force = [{gas}, 0]
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
[branches]
3 = "forward"
"""


def with_rod(gravity: str = "", gas: float = 0.0, **given: float) -> Held:
    """An engine whose rod has a mass and an inertia."""
    return Held(WITH_ROD.format(gravity=gravity, gas=gas, **given))


def test_khurmi_15_19_inertia_force_of_a_rod():
    """Page 554: r = 125, l = 500 mm, G at 275 mm from P, 60 kg, k = 150 mm, 600 rev/min, 45°.

    Printed 24.4 kN, by measurement; it is what the rod alone makes the frame carry.
    """
    held = with_rod(
        r=125, l=500, g=225, rod=60, inertia=60 * 0.15**2, piston=0, angle=45, speed=600
    )
    shaking = held.on("O", 0) + held.on("3-0", 0)
    assert within(abs(shaking) / 1000, 24.4, DRAWN)
    assert exactly(shaking, -60 * held.solution.points["G"].acceleration)


def test_khurmi_15_20_torque_of_a_gas_engine():
    """Page 555: stroke 600, l = 1500, G at 500 mm from C, k = 650 mm, 300 and 250 kg, 125 rev/min.

    Horizontal, 30°. Printed 3840 N·m, with r ω² (cos θ + cos 2θ/n) and the rod's two masses.
    """
    held = with_rod(
        "gravity = true",
        r=300,
        l=1500,
        g=500,
        rod=250,
        inertia=250 * 0.65**2,
        piston=300,
        angle=30,
        speed=125,
    )
    assert within(held.moment(), 3840, ROUNDED)


def test_khurmi_15_21_inertia_torque_of_a_rod():
    """Page 558: stroke 110, l = 250, G at 75 mm from C, 1.25 kg, k = 94 mm, 1200 rev/min, 40°.

    Vertical, above the crank. Printed 12.7 N·m, partly by measurement.
    """
    held = with_rod(
        "gravity = [-9.81, 0]",
        r=55,
        l=250,
        g=75,
        rod=1.25,
        inertia=1.25 * 0.094**2,
        piston=0,
        angle=40,
        speed=1200,
    )
    assert within(held.moment(), 12.696, DRAWN)
