"""The text of check on the true mobility: what the rank says, and why the count differs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import islice
from math import pi

from msgspec.structs import replace

from graphkin.construction.core.solution import gathered
from graphkin.loops.freedom import true_mobility
from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.scene.quantity import SI, exact
from graphkin.structure.driver_count import count
from graphkin.structure.groups import Tie
from graphkin.text.errors import GraphkinError, StructureError
from graphkin.text.plain_table import listed

Places = Mapping[str, complex]
TOLD = 10
"""Idle links and pairs that are told; each of them is a count of its own."""
NUDGE = Fraction(1, 50)
"""How far the drivers are moved to leave a singular position, in radians or longest bars."""


class Rank:
    """The true mobility of a mechanism at its position, and in words what it tells of the count.

    Raises ClosureError where the position does not close, and StructureError where the vector
    loops do not cover a pair.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism, self.scene = mechanism, mechanism.scene
        self.places = places_of(mechanism)
        self.ties = [group for group in mechanism.groups if isinstance(group, Tie)]
        self.here = true_mobility(self.scene, self.places)
        self.counted = count(self.scene).mobility
        self.moving = self.here
        if self.here > self.counted:
            self.moving = min(self.here, nearby(mechanism, self.places) or self.here)

    def lines(self) -> Iterator[str]:
        """The true mobility, and why it is another than the count's."""
        if self.here == self.counted:
            yield f"{self.here}, true mobility by the rank of the constraints, as the count says"
            return
        yield f"{self.here}, true mobility by the rank of the constraints"
        if self.here > self.moving:
            yield f"singular position: beside it the constraints leave {self.moving}"
        if self.moving > self.counted:
            yield from self.idle_lines(self.moving - self.counted)

    def idle_lines(self, surplus: int) -> Iterator[str]:
        """Which constraints take a freedom that others have taken already."""
        many = "one constraint is" if surplus == 1 else f"{surplus} constraints are"
        yield f"{surplus} more than the count: {many} idle, taking what others take already"
        found = list(islice(self.idle(), TOLD + 1))
        if not found:
            return
        first, *others = found[:TOLD]
        if len(found) > TOLD:
            others.append("others")
        also = f" (or {listed(others)})" if others else ""
        right = ", and the count is right" if surplus == 1 else ""
        yield f"without {first}{also} the motion is the same{right}"

    def idle(self) -> Iterator[str]:
        """What can be taken away without another freedom, what the groups found idle first."""
        ties = [tie.link for tie in self.ties]
        for link in (*ties, *(name for name in self.scene.links if name not in ties)):
            if spare(self.scene, link) and self.same_without(without_link(self.scene, link)):
                yield f"link {link}"
        for name, part in parts_without(self.scene):
            if self.same_without(part):
                yield name

    def same_without(self, part: Scene) -> bool:
        """Whether a part of the mechanism moves as the whole, though the count allows it more."""
        try:
            more = count(part).mobility > self.counted
            return more and true_mobility(part, self.places) == self.here
        except StructureError:
            return False


def places_of(mechanism: Mechanism) -> dict[str, complex]:
    """Where the points stand (m); no velocity is constructed for it."""
    positions = [target for target in mechanism.program.targets if target[0] == "position"]
    points = gathered(mechanism.trace(positions)).points.items()
    return {name: motion.position for name, motion in points if motion.position is not None}


def nearby(mechanism: Mechanism, places: Places) -> int | None:
    """True mobility with the drivers moved a little; None where that cannot be constructed."""
    spread = [abs(p - q) for p in places.values() for q in places.values()]
    for sense in (1, -1):
        moved = Mechanism(nudged(mechanism.scene, sense, max(spread, default=1.0)))
        try:
            return true_mobility(moved.scene, places_of(moved))
        except GraphkinError:
            continue
    return None


def nudged(scene: Scene, sense: int, size: float) -> Scene:
    """The scene with every driver a little further, each by another amount."""
    drivers = []
    for number, driver in enumerate(scene.drivers, 1):
        whole = 1.0 if driver.kind == "turn" else size
        drivers.append(further(scene, driver, float(NUDGE) * sense * number * whole))
    return replace(scene, drivers=tuple(drivers))


def further(scene: Scene, driver: Driver, step: float) -> Driver:
    """A driver at a position that is so much (rad, m) further on."""
    position = driver.position
    factor, of_pi = SI[position.unit]
    written = Fraction(step) / factor / (Fraction(pi) if of_pi else 1)
    value = Fraction(position.number(scene.values)) + written
    return replace(driver, position=exact(value, position.unit, position.place))


def spare(scene: Scene, name: str) -> bool:
    """Whether a link could be left out: no driver moves it, and it leads nothing."""
    driven = {end for driver in scene.drivers for end in (driver.link, driver.against)}
    links = scene.links.values()
    carriers = {path.on for link in links for path in link.paths}
    return name not in driven | carriers | {FRAME}


def without_link(scene: Scene, name: str) -> Scene:
    """The mechanism without a link, for counting only: no drivers."""
    links = {other: link for other, link in scene.links.items() if other != name}
    return replace(scene, links=links, drivers=())


def parts_without(scene: Scene) -> Iterator[tuple[str, Scene]]:
    """The mechanism without one of a link's wheels' tracks, or a block's further guides."""
    for link in scene.links.values():
        for path in link.spare_paths:
            links = {**scene.links, link.name: link.without(path)}
            yield path.named(link.name), replace(scene, links=links, drivers=())
