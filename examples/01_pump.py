"""One student's pump: solved, read as a table, and held against vector loops.

Run it with ``python examples/01_pump.py``.
"""

from __future__ import annotations

import graphkin
from graphkin.construction.core.solution import Solution

STUDENT = 7


def sense(value: float) -> str:
    """The sense of an angular value; counter-clockwise is positive."""
    if value == 0:
        return ""
    return "counter-clockwise" if value > 0 else "clockwise"


def print_piston(motion: Solution) -> None:
    """The piston D moves along the x axis, so the real parts say it all."""
    piston = motion.points["D"]
    for symbol, value, unit in (
        ("x_D", piston.position, "m"),
        ("v_D", piston.velocity, "m/s"),
        ("a_D", piston.acceleration, "m/s²"),
    ):
        way = "right" if value.real > 0 else "left"
        print(f"{symbol} = {abs(value.real):8.4f} {unit:5} to the {way}")


def print_links(motion: Solution) -> None:
    """Angular velocity and acceleration of every link, with their senses."""
    print(f"\n{'link':4} {'ω, rad/s':>9} {'sense':18} {'ε, rad/s²':>10} sense")
    for name, link in sorted(motion.links.items()):
        row = f"{name:4} {abs(link.omega):9.4f} {sense(link.omega):18}"
        print(f"{row} {abs(link.epsilon):10.4f} {sense(link.epsilon)}".rstrip())


def main() -> None:
    """Solve, print, compare."""
    pump = graphkin.load("pump", n=STUDENT)
    motion = pump.solve()
    print(f"{pump.scene.title}, student {STUDENT}\n")
    print_piston(motion)
    print_links(motion)

    # The witness solves the closure equations by Newton's method and shares nothing with the
    # construction but the scene.
    verdict = pump.witness(motion)
    print(f"\nvector loops agree: {verdict.agrees}")
    print(f"largest relative difference {verdict.largest_difference:.1e} at {verdict.quantity}")


if __name__ == "__main__":
    main()
