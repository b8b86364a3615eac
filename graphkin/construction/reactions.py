"""Reactions in pairs and balancing forces, group by group from the last to the first.

The tangential part of a dyad's reaction follows from moments, the rest from the closed polygon of
forces (Artobolevsky, Theory of Mechanisms and Machines). Inertia forces make this equilibrium
(d'Alembert). All values are in SI units; moments are counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from msgspec import Struct

from graphkin.construction.core.link_poses import LinkPoses
from graphkin.construction.core.solution import Solution
from graphkin.numbers.plane import cross, dot
from graphkin.scene.forces import Forces
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.structure.groups import Crank, Driven, Dyad, Group
from graphkin.structure.pairs import Joint, Pin, PinLine, Sliding
from graphkin.structure.wheel_groups import other_of
from graphkin.text.errors import Message, Problem, StructureError, message

FLAT = 1e-12
"""Sine below which the two last sides of a polygon of forces do not cross."""


class Wrench(NamedTuple):
    """A force, and the moment of a system of forces about the origin of the scene."""

    force: complex
    moment: float

    def about(self, place: complex) -> float:
        """The moment about a place."""
        return float(self.moment - cross(place, self.force))

    def __neg__(self) -> Wrench:
        return Wrench(-self.force, -self.moment)

    def plus(self, other: Wrench) -> Wrench:
        """Both systems of forces together."""
        return Wrench(self.force + other.force, self.moment + other.moment)


NOTHING = Wrench(0j, 0.0)


def force_at(place: complex, force: complex, couple: float = 0.0) -> Wrench:
    """One force at a place, with a couple."""
    return Wrench(force, cross(place, force) + couple)


class PairReaction(Struct, frozen=True):
    """The force on a link in a pin or guide, and its moment about the pin or the block's point.

    ``name`` is the pin's point, or the block or wheel with the link on which it slides or rolls,
    such as 5-0.
    ``block`` is that block or wheel, None for a pin. ``at`` is a point on the line of the force;
    None where a guide carries a couple alone.
    """

    name: str
    link: str
    force: complex
    moment: float
    at: complex | None
    block: str | None = None


class Balance(Struct, frozen=True):
    """The force (N) or the moment (N·m) of a driver on its link that keeps the given motion.

    ``link`` is the driver's name: the driven link, or 1-2 where several drivers move link 1.
    """

    link: str
    force: complex | None = None
    moment: float | None = None


class ForceSolution(Struct, frozen=True):
    """Every reaction, and the balance of each driver.

    In a pin of several links each entry is the force on one link from all others there.
    """

    reactions: tuple[PairReaction, ...]
    balance: tuple[Balance, ...]


def given_loads(scene: Scene, forces: Forces, solution: Solution) -> dict[str, Wrench]:
    """The loads of each link: weight, inertia force and moment, and the loads of the scene."""
    values = scene.values
    found = dict.fromkeys(scene.links, NOTHING)

    def add(link: str, wrench: Wrench) -> None:
        found[link] = found[link].plus(wrench)

    given = forces.gravity
    falls = 0j if given is None else complex(*(float(q.si(values)) for q in given))
    for link, each in forces.masses.items():
        centre, mass = solution.points[each.centre], float(each.mass.si(values))
        assert centre.position is not None and centre.acceleration is not None
        inertia = 0.0 if each.inertia is None else float(each.inertia.si(values))
        couple = -inertia * float(solution.links[link].epsilon or 0.0)
        add(link, force_at(centre.position, mass * (falls - centre.acceleration), couple))
    for load in forces.loads:
        couple = 0.0 if load.moment is None else float(load.moment.si(values))
        if load.force is None:
            add(load.link, Wrench(0j, couple))
            continue
        place = solution.points[load.at].position
        assert place is not None
        add(load.link, force_at(place, complex(*(float(q.si(values)) for q in load.force)), couple))
    return found


class Standing(Struct):
    """The mechanism in its position, with what acts on each link so far."""

    poses: LinkPoses
    acting: dict[str, Wrench]
    carried: dict[tuple[str, str], Wrench]
    """The reaction in each pair on each of its links."""
    pairs: dict[str, Pin | Sliding]
    """Each pair by the name of its reaction."""

    def pin(self, point: str) -> complex:
        """The place of a pin."""
        return self.poses.positions[point]

    def guide(self, pair: Sliding) -> tuple[complex, complex]:
        """The place of a block, and the unit vector of its guide."""
        way = self.poses.guideway(self.poses.scene.link(pair.block), pair.slide)
        if way is None:
            raise not_constructed(message("the guide of block {block}", block=pair.block))
        return way.at, way.along

    def settle(self, joint: Joint, link: str, on: Wrench) -> None:
        """Enter a reaction on a link of a pair, and the opposite one on the other link."""
        assert isinstance(joint, Pin | Sliding)
        first, second = joint.links
        other = second if link == first else first
        name = joint.place if isinstance(joint, Pin) else "-".join(joint.links)
        self.pairs[name] = joint
        for each, wrench in ((link, on), (other, -on)):
            before = self.carried.get((name, each), NOTHING)
            self.carried[name, each] = before.plus(wrench)
        if other != FRAME:
            self.acting[other] = self.acting[other].plus(-on)


class NotConstructedError(StructureError):
    """A group whose reactions have no construction."""


def not_constructed(what: Message | str) -> NotConstructedError:
    """The error for a group whose reactions have no construction."""
    return NotConstructedError(
        Problem(
            "loads",
            message("the reactions of {what} are not constructed", what=what),
            message("driven cranks and slides, and dyads with pins and slides"),
        )
    )


def construct(
    scene: Scene, forces: Forces, groups: Sequence[Group], solution: Solution, poses: LinkPoses
) -> ForceSolution:
    """The reactions in all pairs, from the last group to the first, and the balance of drivers.

    Raises StructureError for a group without a construction, and where two lines of a polygon do
    not cross.
    """
    standing = Standing(poses, given_loads(scene, forces, solution), {}, {})
    balance = []
    for group in reversed(groups):
        match group:
            case Dyad(inner=Pin()):
                by_moments_about_inner_pin(standing, group)
            case Dyad(inner=Sliding()) if not isinstance(group.inner, PinLine):
                by_slide_between(standing, group)
            case Crank():
                balance.append(crank_balance(standing, group))
            case Driven(pair=Sliding()):
                balance.append(slide_balance(standing, group))
            case _:
                raise not_constructed(group.title)
    return ForceSolution(tuple(listed_reactions(standing)), tuple(reversed(balance)))


def listed_reactions(standing: Standing) -> Iterator[PairReaction]:
    """The reactions by pair and link, with the place of those of guides."""
    for (name, link), wrench in standing.carried.items():
        pair = standing.pairs[name]
        if isinstance(pair, Pin):
            yield PairReaction(name, link, wrench.force, 0.0, standing.pin(pair.place))
            continue
        place, along = standing.guide(pair)
        moment, normal = wrench.about(place), dot(wrench.force, 1j * along)
        at = place + moment / normal * along if normal else None
        yield PairReaction(name, link, wrench.force, moment, at, pair.block)


def outer_of(group: Dyad, link: str) -> Joint:
    """The outer pair of one link of a dyad."""
    return group.left if link in group.left.links else group.right


def by_moments_about_inner_pin(standing: Standing, group: Dyad) -> None:
    """Reactions of a dyad whose links a pin joins: RRR, RRP, PRP.

    Moments of each link about the inner pin give the part of its outer reaction across the bar, or
    the place of a guide's reaction. The polygon of both links gives the parts along the bars and
    normal to the guides.
    """
    inner = group.inner
    assert isinstance(inner, Pin)
    pin = standing.pin(inner.place)
    known: dict[str, Wrench] = {}
    ways: dict[str, complex] = {}
    for link in group.links:
        outer, moment = outer_of(group, link), -standing.acting[link].about(pin)
        if isinstance(outer, Pin):
            bar = standing.pin(outer.place) - pin
            ways[link] = bar / abs(bar)
            known[link] = force_at(pin + bar, moment / abs(bar) * 1j * ways[link])
        elif isinstance(outer, Sliding):
            ways[link] = 1j * standing.guide(outer)[1]
            known[link] = Wrench(0j, moment)
        else:
            raise not_constructed(group.title)
    one, other = group.links
    total = sum((standing.acting[e].force + known[e].force for e in group.links), start=0j)
    sides = closing_sides(-total, ways[one], ways[other], group.title)
    for link, side in zip(group.links, sides, strict=True):
        known[link] = known[link].plus(force_at(pin, side * ways[link]))
        standing.settle(outer_of(group, link), link, known[link])
    first = -standing.acting[one].plus(known[one])
    enter_inner(standing, inner, one, first)


def by_slide_between(standing: Standing, group: Dyad) -> None:
    """Reactions of a dyad whose links slide along each other: RPR, RPP.

    The reaction in the slide is normal to its guide. Moments of each link about its pin give size
    and place of that reaction; a link without a pin closes a polygon of two directions.
    """
    inner = group.inner
    assert isinstance(inner, Sliding)
    one, other = group.links
    pins = {link: outer_of(group, link) for link in group.links}
    if isinstance(pins[one], Sliding):
        one, other = other, one
    first, second = pins[one], pins[other]
    normal = 1j * standing.guide(inner)[1]
    if not isinstance(first, Pin) or not isinstance(second, Pin | Sliding):
        raise not_constructed(group.title)
    pivot, load, far = standing.pin(first.place), standing.acting[one], standing.acting[other]
    about = -load.about(pivot)
    if isinstance(second, Pin):
        end = standing.pin(second.place)
        arm = cross(pivot - end, normal)
        if abs(arm) <= FLAT * abs(pivot - end):
            raise flat_polygon(group.title)
        size = (far.about(end) - about) / arm
    else:
        across = 1j * standing.guide(second)[1]
        _, back = closing_sides(-far.force, across, -normal, group.title)
        size = back
    force = size * normal
    pressed = Wrench(force, about + cross(pivot, force))
    standing.settle(first, one, force_at(pivot, -(load.force + force)))
    enter_inner(standing, inner, one, pressed)
    rest = -far.plus(-pressed)
    standing.settle(second, other, rest)


def enter_inner(standing: Standing, inner: Joint, link: str, on: Wrench) -> None:
    """Enter the reaction in an inner pair; both its links are already in equilibrium."""
    before = dict(standing.acting)
    standing.settle(inner, link, on)
    standing.acting.update(before)


def closing_sides(
    total: complex, way: complex, other: complex, title: Message | str
) -> tuple[float, float]:
    """The two last sides of a polygon of forces, along two directions that add up to a vector."""
    sine = cross(way, other)
    if abs(sine) <= FLAT:
        raise flat_polygon(title)
    return cross(total, other) / sine, cross(way, total) / sine


def flat_polygon(title: Message | str) -> StructureError:
    """The error for a position in which a group cannot carry its loads."""
    return StructureError(
        Problem(
            "loads",
            message("the polygon of forces of {title} does not close", title=title),
            message("a position away from the dead point"),
        )
    )


def crank_balance(standing: Standing, group: Crank) -> Balance:
    """The balancing moment of a driven crank, and the reaction in its pin."""
    link, pivot = group.link, standing.pin(group.pivot)
    acting, against = standing.acting[link], other_of(group.driver, link)
    moment = -acting.about(pivot)
    if against != FRAME:
        standing.acting[against] = standing.acting[against].plus(Wrench(0j, -moment))
    standing.settle(Pin(group.pivot, (group.base, link)), link, force_at(pivot, -acting.force))
    return Balance(
        standing.poses.scene.driver_name(group.driver), moment=moment * sense_of(group.driver, link)
    )


def slide_balance(standing: Standing, group: Driven) -> Balance:
    """The balancing force of a driven block along its guide, and the reaction of the guide."""
    pair, link = group.pair, group.link
    assert isinstance(pair, Sliding)
    place, along = standing.guide(pair)
    acting, against = standing.acting[link], other_of(group.driver, link)
    push = force_at(place, -dot(acting.force, along) * along)
    standing.settle(pair, link, -acting.plus(push))
    if against != FRAME:
        standing.acting[against] = standing.acting[against].plus(-push)
    return Balance(
        standing.poses.scene.driver_name(group.driver),
        force=push.force * sense_of(group.driver, link),
    )


def sense_of(driver: Driver, link: str) -> int:
    """+1 where a group's link is the driver's own, -1 where it is the other one."""
    return 1 if driver.link == link else -1


def by_name(found: ForceSolution, name: str) -> Mapping[str, tuple[PairReaction, ...]]:
    """The reactions that a name asks for: a pin, or all guides and contacts of a link."""
    some: dict[str, tuple[PairReaction, ...]] = {}
    for each in found.reactions:
        if name == (each.block or each.name):
            some[each.name] = (*some.get(each.name, ()), each)
    return some
