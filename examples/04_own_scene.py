"""Own scenes: four mechanisms from .toml files, and an engine held against a printed answer.

Run it with ``python examples/04_own_scene.py``; the scenes lie beside it in ``scenes/``.
"""

from __future__ import annotations

from pathlib import Path

import graphkin
from graphkin.mechanism import Mechanism
from graphkin.structure.groups import Crank, Dyad

SCENES = Path(__file__).resolve().parent / "scenes"
NAMES = ("offset-slider-crank", "crank-rocker", "six-bar", "engine")


def structure(mechanism: Mechanism) -> str:
    """The groups in the order of construction: crank 1, RRR of 2 and 3."""
    words = []
    for group in mechanism.groups:
        if isinstance(group, Crank):
            words.append(f"crank {group.link}")
        elif isinstance(group, Dyad):
            words.append(f"{group.type} of {' and '.join(group.links)}")
    return ", ".join(words)


def print_scene(name: str) -> None:
    """What a scene is made of, and what it asks."""
    mechanism = graphkin.load(SCENES / f"{name}.toml")
    motion = mechanism.solve(asked=True)
    print(f"{mechanism.scene.title}: {structure(mechanism)}")
    for point in mechanism.scene.ask.velocity:
        print(f"  v_{point} = {abs(motion.points[point].velocity):8.4f} m/s")
    for point in mechanism.scene.ask.acceleration:
        print(f"  a_{point} = {abs(motion.points[point].acceleration):8.4f} m/s²")
    for link in mechanism.scene.ask.omega:
        print(f"  ω_{link} = {motion.links[link].omega:+8.4f} rad/s")
    for link in mechanism.scene.ask.epsilon:
        print(f"  ε_{link} = {motion.links[link].epsilon:+8.4f} rad/s²")
    print(f"  vector loops agree: {mechanism.witness(motion).agrees}\n")


def print_textbook() -> None:
    """The engine beside what the book prints, whose author read it from a drawing."""
    motion = graphkin.load(SCENES / "engine.toml").solve()
    rows = (
        ("v_D, m/s", abs(motion.points["D"].velocity), 4.1),
        ("a_D, m/s²", abs(motion.points["D"].acceleration), 117.0),
        ("ω_AB, rad/s", motion.links["2"].omega, 5.67),
        ("ε_AB, rad/s²", motion.links["2"].epsilon, -171.67),
    )
    print("Khurmi and Gupta, Theory of Machines, example 8.1 (counter-clockwise is positive)")
    print(f"  {'quantity':13} {'ours':>9} {'printed':>9} {'difference':>11}")
    for quantity, ours, printed in rows:
        off = abs(ours - printed) / abs(ours)
        print(f"  {quantity:13} {ours:9.4f} {printed:9.2f} {off:10.1%}")


def main() -> None:
    """All scenes, then the comparison."""
    for name in NAMES:
        print_scene(name)
    print_textbook()


if __name__ == "__main__":
    main()
