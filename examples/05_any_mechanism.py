"""Other mechanisms: a slotted lever, a planetary gear, a group of class III, and a whole cycle.

Run it with ``python examples/05_any_mechanism.py``; the scenes lie beside it in ``scenes/``.
"""

from __future__ import annotations

from math import asin, degrees, pi
from pathlib import Path

import graphkin
from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.structure.driver_count import count

SCENES = Path(__file__).resolve().parent / "scenes"


def load(name: str) -> Mechanism:
    """The mechanism of a shipped scene."""
    return graphkin.load(SCENES / f"{name}.toml")


def print_slotted_lever() -> None:
    """The block's motion on the lever, and the Coriolis acceleration that comes with it."""
    slide = load("oscillating-slide").solve().slides["2"]
    print("Oscillating slide: the block on the lever")
    print(f"  position     {1e3 * slide.position:8.2f} mm from the pivot")
    print(f"  speed        {slide.speed:8.4f} m/s")
    print(f"  Coriolis     {abs(slide.coriolis):8.4f} m/s²")


def print_planetary_gear() -> None:
    """The train ratios of a planetary gear whose ring stands (Willis)."""
    links = load("gears-ring").solve().links
    arm = links["1"].omega
    print("Planetary gear, driven by its arm")
    for link, name in (("2", "planet"), ("3", "sun")):
        turning = links[link].omega
        print(f"  {name:12} {turning * 30 / pi:8.2f} rev/min, {turning / arm:+.0f} times the arm")


def print_class_three() -> None:
    """A coupler on three bars: what the count says, and what the coupler does."""
    mechanism = load("stephenson-3-crank")
    coupler = mechanism.solve().links["3"]
    print(f"Coupler on three bars: {count(mechanism.scene).words}")
    for group in mechanism.groups:
        print(f"  {group.title}: links {', '.join(group.links)}")
    print(f"  coupler      {coupler.omega:+8.4f} rad/s, {coupler.epsilon:+8.3f} rad/s²")


def print_cycle() -> None:
    """How far a crank-rocker's output swings in one turn of its crank."""
    mechanism = load("four-bar-crank-rocker")
    found = cycle(mechanism, steps=720)
    speeds = found.solution.links["3"].omega
    print(f"Crank-rocker: {len(found.at)} positions of one turn")
    print(f"  the rocker's ω goes from {speeds.min():.4f} to {speeds.max():.4f} rad/s")
    at = found.at[abs(speeds).argmin()]
    print(f"  and it turns back near φ = {at:.1f}°")
    print(f"  flattest crossing {degrees(asin(found.solution.margin.min())):.1f}°")


def main() -> None:
    """All of them, one after the other."""
    print_slotted_lever()
    print_planetary_gear()
    print_class_three()
    print_cycle()


if __name__ == "__main__":
    main()
