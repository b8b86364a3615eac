"""Masses and loads at random on any mechanism."""

from __future__ import annotations

import random

from msgspec.structs import replace

from graphkin.mechanism import Mechanism
from graphkin.scene.forces import Forces, Load, Mass
from graphkin.scene.quantity import Quantity, exact


def loaded(mechanism: Mechanism, rng: random.Random) -> Mechanism:
    """The mechanism with a mass on most links, gravity, a force and a moment."""
    scene = mechanism.scene
    masses = {}
    for name, link in scene.links.items():
        if rng.random() < 0.8:
            inertia = number(rng, 0.01, 2, "kg·m²") if rng.random() < 0.8 else None
            centre = rng.choice(link.points)
            masses[name] = Mass(number(rng, 0.1, 9, "kg"), centre, inertia)
    on, turned = rng.choice([*scene.links.values()]), rng.choice([*scene.links])
    force = number(rng, -900, 900, "N"), number(rng, -900, 900, "N")
    loads = (
        Load(on.name, rng.choice(on.points), force, None),
        Load(turned, "", None, number(rng, -90, 90, "N·m")),
    )
    gravity = exact(0, "m/s²"), exact("-9.81", "m/s²")
    return Mechanism(replace(scene, forces=Forces(masses, gravity, loads, balance=True)))


def number(rng: random.Random, low: float, high: float, unit: str) -> Quantity:
    """A quantity of three digits."""
    return exact(f"{rng.uniform(low, high):.3f}", unit)
