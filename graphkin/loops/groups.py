"""Which links close together: the groups, taken from the joints alone, in order of knowing.

The smallest sets of links that their joints among themselves and to known links just determine
have 3 degrees of freedom a link and 2 constraints a joint: 2 links and 3 joints (a dyad), 4 and 6,
6 and 9.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import comb

from graphkin.loops.equations import Equations
from graphkin.scene.model import FRAME, Scene

SIZES = (2, 4, 6)
MOST = 20_000
"""Sets of links that are looked through for a group of higher class."""


@dataclass(frozen=True, slots=True)
class Joint:
    """A pair: a pin by its point, or a slide by its number, between two links."""

    links: tuple[str, str]
    pin: str = ""
    slide: int = -1


@dataclass(frozen=True, slots=True)
class Group:
    """Links that close together, the joints between them and those to links known before."""

    links: tuple[str, ...]
    inner: tuple[Joint, ...]
    outer: tuple[Joint, ...]
    known: frozenset[str]

    @property
    def slides(self) -> tuple[Joint, ...]:
        """Its sliding joints."""
        return tuple(joint for joint in (*self.inner, *self.outer) if joint.slide >= 0)

    @property
    def is_dyad(self) -> bool:
        """Two links, with one joint between them and one from each outwards."""
        ends = [joint for joint in self.outer if self.links[0] in joint.links]
        return len(self.links) == 2 and len(self.inner) == 1 and len(ends) == 1


def groups(scene: Scene, loops: Equations) -> list[Group]:
    """The groups, in the order in which frame and drivers make one after the other known."""
    known, found = frozenset({FRAME}), list[Group]()
    every = joints(loops)
    while True:
        driven = {
            driver.link
            for driver in scene.drivers
            if driver.link not in known
            and driver.against in known
            and between({driver.link}, known, every)
        }
        group = None if driven else ready(loops, known, every)
        if group is not None:
            found.append(group)
            driven = set(group.links)
        if not driven:
            return found
        known |= driven


def joints(loops: Equations) -> tuple[Joint, ...]:
    """Every two links that share a point or a guide."""
    bodies = loops.bodies
    pins = [
        Joint((p, q), pin=point)
        for p, q in combinations(bodies, 2)
        for point in bodies[p]
        if point in bodies[q]
    ]
    slides = [Joint((guide.block, guide.on), slide=j) for j, guide in enumerate(loops.guides)]
    return (*pins, *slides)


def ready(loops: Equations, known: frozenset[str], every: tuple[Joint, ...]) -> Group | None:
    """The smallest group that the known links determine, as written first."""
    unknown = [link for link in loops.links if link not in known]
    pairs = dict.fromkeys(joint.links for joint in every if known.isdisjoint(joint.links))
    for size in SIZES:
        if comb(len(unknown), size) > MOST and size > 2:
            return None
        for links in pairs if size == 2 else combinations(unknown, size):
            outer = between(set(links), known, every)
            inner = among(set(links), every, {joint.pin for joint in outer})
            if 2 * (len(inner) + len(outer)) == 3 * size:
                return Group(links, inner, outer, known)
    return None


def between(links: set[str], others: frozenset[str], every: tuple[Joint, ...]) -> tuple[Joint, ...]:
    """The joints from links to others; a pin that several of the others share counts once."""
    found: dict[tuple[str, str, int], Joint] = {}
    for joint in every:
        for mine, other in (joint.links, joint.links[::-1]):
            if mine in links and other in others:
                found.setdefault((mine, joint.pin, joint.slide), joint)
    return tuple(found.values())


def among(links: set[str], every: tuple[Joint, ...], met: set[str]) -> tuple[Joint, ...]:
    """The joints within a set of links, pins that join it to others left out.

    A pin of k of its links counts k - 1 times.
    """
    inside = [j for j in every if links >= set(j.links) and (not j.pin or j.pin not in met)]
    first = {joint.pin: joint.links[0] for joint in reversed(inside) if joint.pin}
    return tuple(j for j in inside if not j.pin or first[j.pin] in j.links)
