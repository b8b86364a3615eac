"""Decomposition into driven links and Assur groups, in an order in which each can be constructed.

Assur: a mechanism is its frame and drivers, to which groups of links without freedom of their own
are joined one after the other. The smallest, two links and three pairs, is the dyad.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from graphkin.errors import Problem, StructureError
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.structure.graph import Pair, Pin, Sliding, pairs_between, sharers
from graphkin.structure.mobility import count


@dataclass(frozen=True, slots=True)
class Crank:
    """A link that a driver turns about a pin whose motion is known."""

    driver: Driver
    link: str
    pivot: str


@dataclass(frozen=True, slots=True)
class Dyad:
    """Two links and three pairs: each link joined to what is known, and to the other."""

    links: tuple[str, str]
    left: Pair
    inner: Pair
    right: Pair

    @property
    def type(self) -> str:
        """R for a pin and P for a slide, from one outer pair over the inner to the other."""
        return "".join("R" if isinstance(pair, Pin) else "P" for pair in self._pairs())

    def _pairs(self) -> tuple[Pair, Pair, Pair]:
        return self.left, self.inner, self.right


@dataclass(frozen=True, slots=True)
class Unresolved:
    """What is left when no driver and no dyad applies: a group of class III or higher."""

    links: tuple[str, ...]


Group = Crank | Dyad | Unresolved


def decompose(scene: Scene) -> tuple[Group, ...]:
    """The groups in order of construction. Raises StructureError for wrong numbers of drivers."""
    refuse_wrong_drivers(scene)
    known = frozenset({FRAME})
    waiting = list(scene.drivers)
    groups: list[Group] = []
    while len(known) <= len(scene.links):
        group = next_crank(scene, known, waiting) or next_dyad(scene, known)
        if group is None:
            groups.append(Unresolved(tuple(name for name in scene.links if name not in known)))
            break
        groups.append(group)
        if isinstance(group, Crank):
            waiting.remove(group.driver)
        known |= {group.link} if isinstance(group, Crank) else set(group.links)
    return tuple(groups)


def refuse_wrong_drivers(scene: Scene) -> None:
    """Raise StructureError unless there are as many drivers as the count leaves freedoms."""
    freedoms, drivers = count(scene).mobility, len(scene.drivers)
    if freedoms == drivers:
        return
    noun = "freedom" if freedoms == 1 else "freedoms"
    hint = "add a driver" if freedoms > drivers else "take a driver away"
    if freedoms > drivers and (loose := lone_points(scene)):
        hint += f", or a pin is missing: only one link has the points {', '.join(loose)}"
    raise StructureError(
        Problem(
            "drivers",
            f"{drivers} given, but the count 3·{count(scene).moving} - "
            f"2·{count(scene).pairs} leaves {freedoms} {noun}",
            "as many drivers as freedoms",
            hint,
        )
    )


def lone_points(scene: Scene) -> list[str]:
    """The points that only one link has, each with its link."""
    owners = sharers(scene)
    return [f"{point} ({links[0]})" for point, links in owners.items() if len(links) == 1]


def next_crank(scene: Scene, known: frozenset[str], waiting: list[Driver]) -> Crank | None:
    """The first driven link, as written, that turns about a pin of a known link."""
    for driver in waiting:
        if driver.kind != "turn" or driver.link in known or driver.against not in known:
            continue
        for pair in pairs_between(scene, driver.link, known):
            if isinstance(pair, Pin):
                return Crank(driver, driver.link, pair.point)
    return None


def next_dyad(scene: Scene, known: frozenset[str]) -> Dyad | None:
    """The first two unknown links, as written, that together close on known ones."""
    unknown = [name for name in scene.links if name not in known]
    for first, second in combinations(unknown, 2):
        between = pairs_between(scene, first, frozenset({second}))
        inner = [pair for pair in between if not is_known_pin(scene, pair, known)]
        left = pairs_between(scene, first, known)
        right = pairs_between(scene, second, known)
        if len(inner) == len(left) == len(right) == 1:
            return in_order(Dyad((first, second), left[0], inner[0], right[0]))
    return None


def is_known_pin(scene: Scene, pair: Pair, known: frozenset[str]) -> bool:
    """Whether a pin stands already: links that meet there hang on it, not on one another."""
    return isinstance(pair, Pin) and not known.isdisjoint(sharers(scene)[pair.point])


def in_order(dyad: Dyad) -> Dyad:
    """The dyad read from its moving pin: RRP rather than PRR, the driver's side first."""
    turned = Dyad((dyad.links[1], dyad.links[0]), dyad.right, dyad.inner, dyad.left)
    if isinstance(dyad.left, Sliding) and isinstance(dyad.right, Pin):
        return turned
    both = isinstance(dyad.left, Pin) and isinstance(dyad.right, Pin)
    if both and FRAME in dyad.left.links and FRAME not in dyad.right.links:
        return turned
    return dyad
