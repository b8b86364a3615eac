"""Pins of different names that a closure puts on one place, in words."""

from __future__ import annotations

from itertools import combinations

from graphkin.construction.core.run import Trace
from graphkin.scene.known_names import named
from graphkin.scene.model import Scene
from graphkin.structure.pairs import sharers
from graphkin.text.plain_table import listed

NEAR = 1e-9
"""Pins nearer to one another than this, in parts of the largest distance, lie on one place."""


def fallen_together(scene: Scene, trace: Trace) -> list[str]:
    """A sentence for each two pins that fall together though no link keeps them so.

    A closure in which they do is seldom the one that is meant, for a bar then lies on another; two
    names for what is one pin would leave its links apart.
    """
    places = pin_places(scene, trace)
    size = max((abs(p - q) for p, q in combinations(places.values(), 2)), default=0.0)
    return [
        sentence(scene, one, other)
        for one, other in combinations(places, 2)
        if abs(places[one] - places[other]) <= NEAR * size and not kept(scene, one, other)
    ]


def pin_places(scene: Scene, trace: Trace) -> dict[str, complex]:
    """Where the points stand that join links."""
    pins = [point for point, links in sharers(scene).items() if len(links) > 1]
    found = {pin: trace.value("position", pin) for pin in pins}
    return {pin: complex(place) for pin, place in found.items() if place is not None}


def kept(scene: Scene, one: str, other: str) -> bool:
    """Whether one link has both points."""
    every = (scene.frame, *scene.links.values())
    return any(one in link.points and other in link.points for link in every)


def sentence(scene: Scene, one: str, other: str) -> str:
    """That two pins fall together, with their links, and what to do."""
    owners = sharers(scene)
    who = [f"{pin} of {listed(map(named, owners[pin]))}" for pin in (one, other)]
    return (
        f"{who[0]} falls on {who[1]} in this closure; "
        "if that is not meant, take another closure or another position of the driver"
    )
