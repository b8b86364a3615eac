"""Forces of reciprocating engines, R. S. Khurmi, J. K. Gupta, Theory of Machines, chapter 15.

The book prints the reactions for the piston effort, which it finds with an approximate acceleration
of the piston. The piston effort is the load here, so that only the equilibrium is compared. We know
the printed answers from quotations of the book, which works with three figures.
"""

from __future__ import annotations

import math

from graphkin.construction.reactions import by_name
from tests.textbook.book import mechanism, within

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
