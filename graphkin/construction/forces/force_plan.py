"""The plan of forces as steps after those of the motion, from the last group to the first.

Sources: I. I. Artobolevsky, Theory of Mechanisms and Machines, kinetostatics of Assur groups; R. L.
Norton, Design of Machinery, chapter 11.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import count
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.construction.core.bases import crank_tip
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import DriverForce, PairForce, Part, Plane, Program
from graphkin.construction.core.quantities import BALANCING_FORCE, BALANCING_MOMENT, PAIR_REACTION
from graphkin.construction.core.vocabulary import along_bar
from graphkin.construction.forces.belt_force import belt_strands
from graphkin.construction.forces.lever import LeverPlan
from graphkin.construction.forces.line_force import (
    along_line,
    foot_on_line,
    in_order,
    meeting,
    pressure,
)
from graphkin.construction.forces.loads import (
    STRANDS,
    LinkForce,
    PassedReaction,
    applied,
    link_pair,
    loads_of,
    opposite,
    sub,
)
from graphkin.construction.forces.moments import (
    Moments,
    balance_of,
    balancing_moment,
    moments_about,
    on_guide,
    tangential,
)
from graphkin.construction.forces.polygon import (
    PART,
    REACTION,
    ClosingSide,
    Polygon,
    SideDirection,
    normal_to_guide,
    side_between,
)
from graphkin.construction.forces.tooth_force import pitch_of, pitch_on, pressure_angle, rack, tooth
from graphkin.scene.findings import natural
from graphkin.scene.model import FRAME, Belt, Driver, Scene, Wheel
from graphkin.structure.groups import (
    CamFollower,
    Crank,
    Cylinder,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    Stretched,
    Train,
    other_of,
)
from graphkin.structure.pairs import Contact, Joint, Pin, PinLine, Sliding, pairs


def undrawn(scene: Scene, groups: Sequence[Group]) -> Group | None:
    """The last group whose forces are not drawn; None where all are."""
    return next((each for each in reversed(groups) if not is_drawn(scene, each)), None)


def is_drawn(scene: Scene, group: Group) -> bool:
    """Whether the forces of a group are drawn."""
    match group:
        case Dyad():
            pairs = (*group.outer, group.inner)
            return all(is_plain(scene, pair) for pair in pairs)
        case Crank():
            return True
        case CamFollower(dyad=dyad):
            follower = follower_of(scene, dyad)
            single = scene.cams[follower].conjugate is None
            return single and is_plain(scene, outer_of(dyad, follower))
        case Stretched(cylinders=cylinders, dyad=dyad):
            slides = (each.slide for each in cylinders)
            return isinstance(dyad.inner, Pin) and all(
                is_plain(scene, pair) for pair in (*slides, *group.outer)
            )
        case Geared(link=link, pair=pair, contact=contact):
            belt = contact.rolling.belt
            if belt is not None and (belt.tension is None or not isinstance(pair, Pin)):
                return False
            if isinstance(pair, Pin):
                wheel = contact.track if contact.links[0] != link else contact.wheel
                return wheel is not None and wheel.centre == pair.place
            return contact.track is None and contact.links[1] == link and is_plain(scene, pair)
        case Train(wheel=wheel, pivot=pivot, centre=centre, contacts=both):
            return all(
                contact.rolling.belt is None
                and contact.track is not None
                and not contact.wheel_of(wheel).inside
                and contact.wheel_of(wheel).centre == centre.place
                and facing(contact, wheel).centre == pivot.place
                for contact in both
            )
        case Higher():
            return coupled(scene, group) is not None
        case Driven(link=link, pair=Contact() as contact):
            loose = contact.track is None and contact.arm is None
            return loose and contact.links[0] == link and contact.rolling.belt is None
        case Driven(pair=pair):
            return is_plain(scene, pair)
    return False


class Arm(NamedTuple):
    """A link, or a cylinder of two, from an outer pair to an inner pin: of a dyad, or of a coupler.

    The reaction in the outer pair acts on link ``near``, that in the inner pin on link ``far``.
    """

    near: str
    far: str
    outer: Joint
    inner: Pin

    @property
    def links(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys((self.near, self.far)))

    @property
    def words(self) -> str:
        """Its links in a sentence about one link."""
        return " + ".join(self.links)


def coupled(scene: Scene, group: Higher) -> tuple[str, tuple[Arm, Arm, Arm]] | None:
    """The coupler of a group of class III and order 3 with its arms; None for any other group."""
    if group.order != (3, 3) or len(group.links) != 4 or group.wheels:
        return None
    joints = [pair for pair in pairs(scene) if any(link in group.links for link in pair.links)]
    inside = [pair for pair in joints if all(link in group.links for link in pair.links)]
    count = Counter(link for pair in inside for link in pair.links)
    coupler = next((link for link in group.links if count[link] == len(inside) == 3), None)
    if coupler is None or not all(isinstance(pair, Pin) for pair in inside):
        return None
    arms = []
    for pair in inside:
        assert isinstance(pair, Pin)
        (link,) = (each for each in pair.links if each != coupler)
        outer = [e for e in joints if link in e.links and e not in inside]
        if len(outer) != 1 or not is_plain(scene, outer[0]):
            return None
        arms.append(Arm(link, link, outer[0], pair))
    return coupler, (arms[0], arms[1], arms[2])


def is_plain(scene: Scene, pair: Joint) -> bool:
    """Whether a pair is a pin, or the only guide of a block."""
    if isinstance(pair, Pin):
        return True
    if not isinstance(pair, Sliding) or isinstance(pair, PinLine):
        return False
    return len(scene.link(pair.block).slides) == 1


def force_program(scene: Scene, motion: Program, groups: Sequence[Group]) -> Program:
    """The program of a motion with the plan of forces after it. All groups are drawn ones."""
    pen = Pen.resumed(scene, motion)
    plan = ForcePlan(pen)
    plan.write(groups)
    return replace(pen.program(), reactions=tuple(plan.reactions), balances=tuple(plan.balances))


class CamPair(NamedTuple):
    """A follower with its cam, and the normal of their contact."""

    links: tuple[str, str]

    @property
    def name(self) -> str:
        """The name of its reaction."""
        return "-".join(self.links)


class StrandPair(NamedTuple):
    """A wheel and the one from which a strand of its belt comes: left or right."""

    links: tuple[str, str]
    strand: str

    @property
    def name(self) -> str:
        """The name of its reaction."""
        return "-".join((*self.links, self.strand))


Forcing = Joint | CamPair | StrandPair
"""What transmits a force between two links."""


class ForcePlan:
    """The plan of forces while it is drawn: what acts on each link so far."""

    def __init__(self, pen: Pen) -> None:
        assert pen.scene.forces is not None
        self.pen = pen
        self.arms = (f"h_{number}" for number in count(1))
        with pen.calls_for("loads"):
            self.acting = loads_of(pen, pen.scene.forces, self.arms)
        self.acting[FRAME] = []
        self.loads = {link: tuple(some) for link, some in self.acting.items()}
        self.links: tuple[str, ...] = ()
        self.polygons = count(1)
        self.reactions: list[PairForce] = []
        self.balances: list[DriverForce] = []

    def write(self, groups: Sequence[Group]) -> None:
        """Draw every group, then the lever of a mechanism with one driver."""
        driving: list[tuple[Crank | Driven | Cylinder, int]] = []
        for group in reversed(groups):
            self.links = group.links
            match group:
                case Dyad(inner=Pin() as inner):
                    self.by_inner_pin(group.type, *self.arms_of(group, inner))
                case Dyad():
                    self.by_inner_slide(group)
                case CamFollower():
                    self.lifted(group)
                case Stretched():
                    driving += self.stretched(group)
                case Higher():
                    self.class_three(group)
                case Train():
                    self.train(group)
                case Geared(pair=Pin()):
                    self.geared(group)
                case Geared():
                    self.on_rack(group)
                case Crank():
                    driving.append((group, self.crank(group)))
                case Driven():
                    driving.append((group, self.driven(group)))
        if len(driving) == 1:
            self.lever(*driving[0])

    # --- names and reactions ---------------------------------------------------------------------

    def new_polygon(self, links: Sequence[str], kind: str) -> Polygon:
        return Polygon(self.pen, next(self.polygons), links, kind)

    def partner(self, pair: Forcing, link: str) -> str:
        """The other link of a pair."""
        first, second = pair.links
        return second if link == first else first

    def name(self, pair: Forcing, link: str, part: str = "") -> str:
        """The symbol of the reaction on a link in a pair, and of its part."""
        index = link_pair(self.partner(pair, link), link)
        prime = STRANDS[pair.strand][0] if isinstance(pair, StrandPair) else ""
        return f"R{prime}_{index}" + (f"^{part}" if part else "")

    def guide(self, pair: Joint) -> int:
        """The step of a guide."""
        assert isinstance(pair, Sliding)
        return self.pen.the("guide", pair.block)

    def way_across(self, pair: Sliding) -> SideDirection:
        """The direction normal to a guide."""
        return SideDirection(guide=self.guide(pair), block=pair.block)

    @property
    def on_group(self) -> Iterator[LinkForce]:
        """The forces so far on the links of the group that is drawn."""
        return (each for link in self.links for each in self.acting[link])

    def enter(
        self, pair: Forcing, link: str, force: int, place: int, couple: int | None = None
    ) -> None:
        """Enter the reaction on a link among the results."""
        links = link, self.partner(pair, link)
        if isinstance(pair, Pin):
            found = PairForce(pair.place, links, None, force, place)
        elif isinstance(pair, Sliding):
            about = self.pen.the("position", self.pen.scene.link(pair.block).points[0])
            name = "-".join(pair.links)
            found = PairForce(name, links, pair.block, force, place, about, couple)
        else:
            name = "-".join(pair.links) if isinstance(pair, Contact) else pair.name
            found = PairForce(name, links, pair.links[0], force, place)
        self.reactions.append(found)

    def give(
        self,
        pair: Forcing,
        link: str,
        force: int,
        place: int,
        at: str = "",
        couple: int | None = None,
    ) -> None:
        """Enter the reaction on a link, drawn on the mechanism, and pass its opposite on."""
        self.enter(pair, link, force, place, couple)
        if self.partner(pair, link) == FRAME:
            applied(self.pen, LinkForce(self.name(pair, link), REACTION, force, place, at=at))
            return
        self.pass_on(pair, link, force, place, at)

    def pass_on(self, pair: Forcing, link: str, force: int, place: int, at: str = "") -> None:
        """Pass the opposite of the reaction on a link to the other link of the pair."""
        pen, other = self.pen, self.partner(pair, link)
        back = pen.make(PassedReaction(name=self.name(pair, other), force=self.back(force))).force
        passed = LinkForce(self.name(pair, other), REACTION, back, place, at=at)
        self.acting[other].append(applied(pen, passed))

    def back(self, step: int) -> int:
        """The opposite of a force or a couple."""
        with self.pen.on(Part.FORCE, Plane.NUMBERS):
            return self.pen.draw(opposite, step)

    def about(self, point: str, *links: str) -> Moments:
        """The moments of all forces on some links about a point."""
        acting = [each for link in links for each in self.acting[link]]
        return moments_about(self.pen, self.pen.the("position", point), point, acting, self.arms)

    # --- arms ------------------------------------------------------------------------------------

    def across(self, arm: Arm, moments: Moments) -> int | None:
        """The part of an outer reaction across the arm; None where there is none."""
        if not isinstance(arm.outer, Pin) or not moments.terms:
            return None
        name, ends = self.name(arm.outer, arm.near, "t"), (arm.outer.place, arm.inner.place)
        return tangential(self.pen, name, arm.words, ends, moments)

    def lay_across(self, polygon: Polygon, arm: Arm, across: int | None) -> int:
        """Lay off the part of an outer reaction across its arm, if there is one; its end."""
        if across is None:
            return polygon.last
        return polygon.lay(self.name(arm.outer, arm.near, "t"), PART, across)

    def along(self, arm: Arm, across: int | None) -> ClosingSide:
        """The part of an outer reaction along its arm; all of it where none is across."""
        part, look = ("", REACTION) if across is None else ("n", PART)
        return ClosingSide(self.name(arm.outer, arm.near, part), self.way(arm), look, arm.words)

    def way(self, arm: Arm) -> SideDirection:
        """The direction of the side along an arm."""
        pair = arm.outer
        if isinstance(pair, Pin):
            return SideDirection((pair.place, arm.inner.place))
        assert isinstance(pair, Sliding)
        return SideDirection(guide=self.guide(pair), block=pair.block)

    def whole(self, polygon: Polygon, arm: Arm, across: int | None, ends: tuple[int, int]) -> int:
        """The outer reaction of an arm, the sum of its parts if it has two."""
        name = self.name(arm.outer, arm.near)
        parts = () if across is None else (f"{name}^n", f"{name}^t")
        return polygon.reaction(name, *ends, whole=parts, drawn=bool(parts))

    # --- dyads -----------------------------------------------------------------------------------

    def arms_of(self, group: Dyad, inner: Pin) -> tuple[Arm, Arm]:
        """The arms of a dyad; one with an outer pin comes first."""
        one, other = (Arm(link, link, outer_of(group, link), inner) for link in group.links)
        swapped = isinstance(one.outer, Sliding) and not isinstance(other.outer, Sliding)
        return (other, one) if swapped else (one, other)

    def by_inner_pin(self, kind: str, one: Arm, other: Arm) -> tuple[int, int]:
        """RRR, RRP, PRP: parts across bars, the polygon of both links, places on guides.

        Gives the forces of both arms in the inner pin, each on its own arm.
        """
        inner = one.inner
        moments = {arm: self.about(inner.place, *arm.links) for arm in (one, other)}
        across = {arm: self.across(arm, moments[arm]) for arm in (one, other)}
        polygon = self.new_polygon((*one.links, *other.links), kind)
        first = self.lay_across(polygon, one, across[one])
        for link in one.links:
            polygon.lay_all(self.acting[link])
        middle = polygon.last
        for link in other.links:
            polygon.lay_all(self.acting[link])
        second = polygon.last
        self.lay_across(polygon, other, across[other])
        corner = polygon.close(*(self.along(arm, across[arm]) for arm in (one, other))).corner
        ends = {one: (corner, first), other: (second, corner)}
        forces = {arm: self.whole(polygon, arm, across[arm], ends[arm]) for arm in (one, other)}
        met = Pin(inner.point, (one.far, other.far))
        between = polygon.reaction(self.name(met, one.far), middle, corner, first=one.far)
        self.enter(met, one.far, between, self.pen.the("position", inner.place))
        for arm in (one, other):
            self.settle(arm.outer, arm.near, forces[arm], moments[arm])
        return between, self.back(between)

    def settle(self, pair: Joint, link: str, force: int, moments: Moments) -> None:
        """Enter an outer reaction at its pin, or at its place on a guide by moments."""
        if isinstance(pair, Pin):
            self.at_pin(pair, link, force)
            return
        name, guide = self.name(pair, link), self.guide(pair)
        place, couple = on_guide(self.pen, name, link, guide, force, moments, self.on_group)
        self.give(pair, link, force, place, couple=couple)
        self.turn(pair, link, couple)

    def turn(self, pair: Joint, link: str, couple: int | None, *, both: bool = False) -> None:
        """Pass the couple of a guide on a link to the other one, and enter it on ``both``."""
        other = self.partner(pair, link)
        if couple is None:
            return
        index = link_pair(other, link)
        if both:
            self.acting[link].append(LinkForce(f"M_{index}", REACTION, couple=couple))
        if other != FRAME:
            passed = LinkForce(f"M_{link_pair(link, other)}", REACTION, couple=self.back(couple))
            self.acting[other].append(passed)

    def at_pin(self, pair: Pin, link: str, force: int) -> None:
        """Enter the reaction in a pin."""
        self.give(pair, link, force, self.pen.the("position", pair.place), pair.place)

    def by_inner_slide(self, group: Dyad) -> None:
        """RPR, RPP: the force normal to the inner guide, then the polygon of each link."""
        inner = group.inner
        assert isinstance(inner, Sliding)
        one, other = group.links
        if isinstance(outer_of(group, one), Sliding):
            one, other = other, one
        first, second = outer_of(group, one), outer_of(group, other)
        if isinstance(first, Pin) and isinstance(second, Sliding):
            self.on_two_guides(group, inner, (one, first), (other, second))
        elif isinstance(first, Pin) and isinstance(second, Pin):
            self.between_pins(group, inner, (one, first), (other, second))

    def between_pins(
        self, group: Dyad, inner: Sliding, near: tuple[str, Pin], far: tuple[str, Pin]
    ) -> None:
        """RPR: the force of the guide by moments about the far pin, then both polygons.

        The near link is the one whose loads pass through its pin, if there is one.
        """
        pen = self.pen
        if self.has_moments(*near) and not self.has_moments(*far):
            near, far = far, near
        others, own = (self.about(pin.place, link) for link, pin in (near, far))
        one, other = near[0], far[0]
        name, guide = self.name(inner, one), self.guide(inner)
        force = pressure(pen, name, next(self.arms), (other, inner.block), guide, own, others)
        place, couple = on_guide(pen, name, one, guide, force, others, self.on_group)
        self.pressed(inner, one, force, place, couple)
        self.turn(inner, one, couple, both=True)
        for link, pin in (far, near):
            polygon = self.closed_at(group.type, link, pin)
        self.read_off(name, polygon)

    def read_off(self, name: str, polygon: Polygon) -> None:
        """Let a force that moments gave be read off as a side of a polygon."""
        with self.pen.on(Part.FORCE, Plane.NUMBERS):
            side = self.pen.draw(side_between, *polygon.ends[name])
        self.pen.want(PAIR_REACTION.target, name, side)

    def closed_at(self, kind: str, link: str, pin: Pin) -> Polygon:
        """The polygon of one link, which the reaction in its pin closes."""
        polygon = self.new_polygon((link,), kind)
        last = polygon.lay_all(self.acting[link])
        force = polygon.reaction(self.name(pin, link), last, polygon.start, closes=True)
        self.at_pin(pin, link, force)
        return polygon

    def has_moments(self, link: str, pin: Pin) -> bool:
        """Whether a force on a link acts elsewhere than at a pin."""
        place = self.pen.the("position", pin.place)
        return any(each.couple is not None or each.place != place for each in self.acting[link])

    def pressed(
        self, pair: Forcing, link: str, force: int, place: int, couple: int | None = None
    ) -> None:
        """Enter the force of a guide, wheel or cam on one link, and its opposite on the other."""
        self.acting[link].append(LinkForce(self.name(pair, link), REACTION, force, place))
        self.give(pair, link, force, place, couple=couple)

    def on_two_guides(
        self, group: Dyad, inner: Sliding, near: tuple[str, Pin], far: tuple[str, Sliding]
    ) -> None:
        """RPP: the polygon of the link on two guides, then that of the link with a pin."""
        pen, (one, pair), (other, outer) = self.pen, near, far
        polygon = self.new_polygon((other,), group.type)
        last = polygon.lay_all(self.acting[other])
        sides = [
            ClosingSide(self.name(each, other), self.way_across(each)) for each in (inner, outer)
        ]
        corner = polygon.close(*sides).corner
        pushed = polygon.reaction(sides[0].name, corner, polygon.start, drawn=False)
        outward = polygon.reaction(sides[1].name, last, corner, drawn=False)
        back, moments = self.back(pushed), self.about(pair.place, one)
        name, guide = self.name(inner, one), self.guide(inner)
        place, couple = on_guide(pen, name, one, guide, back, moments, self.on_group)
        self.pressed(inner, one, back, place, couple)
        self.turn(inner, one, couple, both=True)
        rest = moments_about(pen, place, pair.place, self.acting[other], self.arms)
        self.settle(outer, other, outward, rest)
        self.closed_at(group.type, one, pair)

    # --- cylinders -------------------------------------------------------------------------------

    def stretched(self, group: Stretched) -> list[tuple[Cylinder, int]]:
        """A dyad with cylinders, each as one bar; then the force of the driver in each cylinder."""
        dyad, inner, cylinders = group.dyad, group.dyad.inner, group.cylinders
        assert isinstance(inner, Pin)
        held = {each.far: (each.near, each.pin) for each in cylinders}
        near = {link: held.get(link, (link, outer_of(dyad, link))) for link in dyad.links}
        one, other = (Arm(near[link][0], link, near[link][1], inner) for link in dyad.links)
        forces = dict(zip(dyad.links, self.by_inner_pin(dyad.type, one, other), strict=True))
        order = sorted(cylinders, key=lambda each: dyad.links.index(each.far))
        return [(each, self.pushing(each, inner, forces[each.far])) for each in order]

    def pushing(self, cylinder: Cylinder, inner: Pin, between: int) -> int:
        """The driver's force along a cylinder and the normal one, from the polygon of the rod."""
        pen, pair, rod = self.pen, cylinder.slide, cylinder.far
        met = Pin(inner.point, (rod, self.partner(inner, rod)))
        pin = LinkForce(
            self.name(met, rod), REACTION, between, pen.the("position", inner.place), at=inner.place
        )
        self.acting[rod].append(pin)
        push, force, moments = self.along_and_across(rod, pair, "cylinder")
        name, guide = self.name(pair, rod), self.guide(pair)
        place, couple = on_guide(pen, name, rod, guide, force, moments, self.on_group)
        self.enter(pair, rod, force, place, couple)
        self.drive(cylinder.driver, rod, push, turns=False)
        return push

    def along_and_across(self, link: str, pair: Joint, kind: str) -> tuple[int, int, Moments]:
        """The polygon of a driven link: its driver's force along the guide, and the normal one.

        The moments are those of its loads about its block's first point.
        """
        pen = self.pen
        assert isinstance(pair, Sliding)
        point = pen.scene.link(pair.block).points[0]
        moments = self.about(point, link)
        polygon = self.new_polygon((link,), kind)
        last = polygon.lay_all(self.acting[link])
        across = ClosingSide(self.name(pair, link), self.way_across(pair))
        along = ClosingSide("F_" + sub("b", link), across.way._replace(along=True), "balance")
        corner = polygon.close(along, across).corner
        quantity = BALANCING_FORCE.target
        push = polygon.reaction(along.name, corner, polygon.start, drawn=False, quantity=quantity)
        force = polygon.reaction(across.name, last, corner, drawn=False)
        applied(pen, LinkForce(along.name, "balance", push, pen.the("position", point), at=point))
        return push, force, moments

    # --- cams ------------------------------------------------------------------------------------

    def lifted(self, group: CamFollower) -> None:
        """A follower: the force of the cam along the normal, and that of its guide or pin."""
        pen, dyad = self.pen, group.dyad
        link = follower_of(pen.scene, dyad)
        cam = pen.scene.cams[link]
        pair = CamPair((link, cam.on))
        centre = pen.the("position", cam.centre)
        if isinstance(dyad.inner, Pin):
            place, way = pen.the("position", cam.point), SideDirection((cam.centre, cam.point))
        else:
            assert isinstance(dyad.inner, Sliding)
            way = self.way_across(dyad.inner)
            with pen.on(Part.FORCE, Plane.MECHANISM):
                place = pen.draw(foot_on_line, centre, self.guide(dyad.inner))
        name, outer = self.name(pair, link), outer_of(dyad, link)
        if isinstance(outer, Pin):
            with pen.on(Part.FORCE, Plane.MECHANISM):
                line = (
                    pen.draw(along_bar, place, centre, place)
                    if way.guide is None
                    else pen.draw(normal_to_guide, place, way.guide)
                )
            moments = self.about(outer.place, link)
            links = (link,)
            force = along_line(
                pen, name, next(self.arms), links, line, place, moments, way, cam=True
            )
            self.pressed(pair, link, force, place)
            self.read_off(name, self.closed_at("", link, outer))
            return
        polygon = self.new_polygon((link,), "")
        last = polygon.lay_all(self.acting[link])
        assert isinstance(outer, Sliding)
        across = ClosingSide(self.name(outer, link), self.way_across(outer))
        corner = polygon.close(ClosingSide(name, way), across, cam=True).corner
        force = polygon.reaction(name, corner, polygon.start, drawn=False)
        held = polygon.reaction(across.name, last, corner, drawn=False)
        self.pressed(pair, link, force, place)
        point = pen.scene.link(outer.block).points[0]
        self.settle(outer, link, held, self.about(point, link))

    # --- wheels ----------------------------------------------------------------------------------

    def geared(self, group: Geared) -> None:
        """A wheel on a pivot: the force of the other wheel or rack by moments, then its polygon."""
        pen, link, contact, pin = self.pen, group.link, group.contact, group.pair
        assert isinstance(pin, Pin)
        other = self.partner(contact, link)
        moments = self.about(pin.place, link)
        if contact.rolling.belt is not None:
            self.belted(link, contact, contact.rolling.belt, pin, moments)
            return
        if contact.track is None:
            inside, angle = False, pressure_angle(contact.wheel)
            pitch = pitch_on(pen, moments.about, pen.the("track", contact.links[0]))
        else:
            wheels = contact.wheel_of(link), contact.wheel_of(other)
            inside, angle = wheels[0].inside, pressure_angle(*wheels)
            pitch = pitch_of(pen, moments.about, wheels)
        name = self.name(contact, link)
        found = tooth(pen, name, link, pitch, angle, moments, outward=inside)
        self.pressed(contact, link, found.force, pitch)
        self.read_off(name, self.closed_at("", link, pin))

    def belted(self, link: str, contact: Contact, belt: Belt, pin: Pin, moments: Moments) -> None:
        """A wheel on a pivot: the forces of both strands of its belt, then its polygon.

        Strands are left or right as seen from the wheel that the scene names with the belt.
        """
        other = self.partner(contact, link)
        sense = 1 if link == contact.links[0] or belt.crossed else -1
        pairs = {each: StrandPair(contact.links, each) for each in STRANDS}
        names = {each: self.name(pair, link) for each, pair in pairs.items()}
        wheels = contact.wheel_of(link), contact.wheel_of(other)
        for each, found in [*belt_strands(self.pen, link, names, wheels, belt, moments, sense)]:
            own = LinkForce(names[each], REACTION, found.force, found.edge)
            self.acting[link].append(applied(self.pen, own))
            self.enter(pairs[each], link, found.force, found.edge)
            if other != FRAME:
                self.pass_on(pairs[each], link, found.force, found.end)
        polygon = self.closed_at("", link, pin)
        for name in names.values():
            self.read_off(name, polygon)

    def train(self, group: Train) -> None:
        """A wheel between two known wheels, on an arm about their centre.

        Both contacts, the centre of the wheel and the pivot of the arm lie on one line. The moment
        of the arm gives the part of the force on the wheel across that line. The moments of the
        wheel about one contact then give the force at the other one.
        """
        pen, wheel, arm = self.pen, group.wheel, group.arm
        centre, pivot = group.centre, group.pivot
        first, last = group.contacts
        place = pen.the("position", centre.place)
        bar_ends, part = (centre.place, pivot.place), self.name(centre, arm, "t")
        own = self.about(pivot.place, arm)
        acting = [*self.acting[wheel]]
        if own.terms:
            pushed = self.back(tangential(pen, part, arm, bar_ends, own))
            acting.append(LinkForce(self.name(centre, wheel, "t"), PART, pushed, place))
        pitches, angles = [], []
        for contact in group.contacts:
            wheels = contact.wheel_of(wheel), contact.wheel_of(self.partner(contact, wheel))
            pitches.append(pitch_of(pen, place, wheels))
            angles.append(pressure_angle(*wheels))
        about = moments_about(pen, pitches[0], first.letter, acting, self.arms)
        name, ends = self.name(last, wheel), (first.letter, last.letter)
        found = tooth(
            pen,
            name,
            wheel,
            pitches[1],
            angles[1],
            about,
            outward=pushes_outward(pen.scene, group),
            across=ends,
        )
        self.pressed(last, wheel, found.force, pitches[1])
        moments, other = self.about(centre.place, wheel), self.name(first, wheel)
        force = tooth(pen, other, wheel, pitches[0], angles[0], moments, outward=False).force
        self.pressed(first, wheel, force, pitches[0])
        polygon = self.closed_at("", wheel, centre)
        self.read_off(name, polygon)
        self.read_off(other, polygon)
        self.closed_at("", arm, pivot)

    def on_rack(self, group: Geared) -> None:
        """A rack on a guide: the line of action and the guide's normal close its polygon."""
        pen, link, contact, pair = self.pen, group.link, group.contact, group.pair
        polygon = self.new_polygon((link,), "")
        polygon.lay_all(self.acting[link])
        centre = pen.the("position", contact.wheel.centre)
        angle, name = pressure_angle(contact.wheel), self.name(contact, link)
        assert isinstance(pair, Sliding)
        track, guide = pen.the("track", contact.links[0]), (self.guide(pair), pair.block)
        found = rack(pen, polygon, name, link, angle, centre, track, guide)
        self.read_off(name, polygon)
        held = polygon.reaction(self.name(pair, link), polygon.last, polygon.start, closes=True)
        self.pressed(contact, link, found.force, found.pitch)
        point = pen.scene.link(pair.block).points[0]
        self.settle(pair, link, held, self.about(point, link))

    # --- class III -------------------------------------------------------------------------------

    def class_three(self, group: Higher) -> None:
        """A coupler with three arms: parts across them, one along by moments, then the polygon.

        The moments of the whole group are taken about the point in which the lines of two arms meet
        (Assur's point), so that only the part along the third arm is unknown.
        """
        pen = self.pen
        found = coupled(pen.scene, group)
        assert found is not None
        coupler, arms = found
        moments = {arm: self.about(arm.inner.place, arm.near) for arm in arms}
        lines = {arm: self.line_of(arm) for arm in arms}
        one, other, third = (arms[k] for k in in_order(pen, [lines[arm] for arm in arms]))
        across = {arm: self.across(arm, moments[arm]) for arm in arms}
        first, second = (pen.the("position", arm.inner.place) for arm in (one, other))
        special = meeting(pen, lines[one], lines[other], (first, second))
        acting = [each for link in (coupler, *(a.near for a in arms)) for each in self.acting[link]]
        for arm in arms:
            if (step := across[arm]) is not None:
                assert isinstance(arm.outer, Pin)
                place = pen.the("position", arm.outer.place)
                acting.append(LinkForce(self.name(arm.outer, arm.near, "t"), PART, step, place))
            elif isinstance(arm.outer, Sliding) and moments[arm].terms:
                couple = moments[arm].balanced(pen, balancing_moment)
                index = link_pair(self.partner(arm.outer, arm.near), arm.near)
                acting.append(LinkForce(f"M_{index}", REACTION, couple=couple))
        letter = pen.steps[special].name
        every = moments_about(pen, special, letter, acting, self.arms)
        sides = {arm: self.along(arm, across[arm]) for arm in arms}
        through, way = pen.the("position", third.inner.place), sides[third].way
        links, name = tuple(sorted(group.links, key=natural)), sides[third].name
        along = along_line(pen, name, next(self.arms), links, lines[third], through, every, way)
        polygon = self.new_polygon(links, "III")
        first = self.lay_across(polygon, one, across[one])
        for link in (one.near, coupler, third.near):
            polygon.lay_all(self.acting[link])
        before = polygon.last
        self.lay_across(polygon, third, across[third])
        after = polygon.lay(name, sides[third].look, along)
        second = polygon.lay_all(self.acting[other.near])
        self.lay_across(polygon, other, across[other])
        corner = polygon.close(sides[one], sides[other]).corner
        ends = {one: (corner, first), other: (second, corner), third: (before, after)}
        for arm in (one, other, third):
            force = self.whole(polygon, arm, across[arm], ends[arm])
            self.settle(arm.outer, arm.near, force, moments[arm])
            self.held_at(arm, force)

    def held_at(self, arm: Arm, force: int) -> None:
        """The polygon of an arm, which the reaction in its inner pin closes."""
        polygon, link = self.new_polygon((arm.near,), ""), arm.near
        polygon.lay_all(self.acting[link])
        last = polygon.lay(self.name(arm.outer, link), REACTION, force)
        inner = polygon.reaction(self.name(arm.inner, link), last, polygon.start, closes=True)
        self.enter(arm.inner, link, inner, self.pen.the("position", arm.inner.place))

    def line_of(self, arm: Arm) -> int:
        """The line of the force in an arm: along the bar, or normal to the guide of a block."""
        pen, start = self.pen, self.pen.the("position", arm.inner.place)
        with pen.on(Part.FORCE, Plane.MECHANISM):
            if isinstance(arm.outer, Pin):
                return pen.draw(along_bar, start, start, pen.the("position", arm.outer.place))
            return pen.draw(normal_to_guide, start, self.guide(arm.outer))

    # --- drivers ---------------------------------------------------------------------------------

    def drive(self, driver: Driver, link: str, step: int, *, turns: bool) -> None:
        """Enter the balance of a driver on a link, and pass its opposite to the link it turns."""
        sense = 1 if driver.link == link else -1
        name = ("M_" if turns else "F_") + sub("b", link)
        self.balances.append(
            DriverForce(self.pen.scene.driver_name(driver), link, name, step, turns, sense)
        )

    def crank(self, group: Crank) -> int:
        """The balancing moment of a crank, and the reaction in its pivot."""
        pen, link, against = self.pen, group.link, other_of(group.driver, group.link)
        moments = self.about(group.pivot, link)
        name = "M_" + sub("b", link)
        moment = balance_of(pen, name, link, moments)
        pen.want(BALANCING_MOMENT.target, name, moment)
        self.drive(group.driver, link, moment, turns=True)
        if against != FRAME:
            passed = LinkForce(f"{name},{against}", "balance", couple=self.back(moment))
            self.acting[against].append(passed)
        self.closed_at("crank", link, Pin(group.pivot, (group.base, link)))
        return moment

    def driven(self, group: Driven) -> int:
        """The balancing force of a driven link along its guide or track, and the reaction there."""
        link, pair = group.link, group.pair
        if isinstance(pair, Contact):
            push, moments = self.rolled(link, pair)
        else:
            push, force, moments = self.along_and_across(link, pair, "slide")
        self.drive(group.driver, link, push, turns=False)
        against = other_of(group.driver, link)
        if against != FRAME:
            name = f"F_{sub('b', link)},{against}"
            passed = LinkForce(name, "balance", self.back(push), moments.about, at=moments.letter)
            self.acting[against].append(passed)
        if not isinstance(pair, Contact):
            self.settle(pair, link, force, moments)
        return push

    def rolled(self, link: str, contact: Contact) -> tuple[int, Moments]:
        """A driven wheel on its track: the force along the track in the contact by moments.

        The track's normal and the driver's force along it then close the polygon. The moments are
        those of the loads about the wheel's centre, at which the driver pushes.
        """
        pen, centre = self.pen, contact.wheel.centre
        moments, track = self.about(centre, link), pen.the("track", contact.links[0])
        pitch = pitch_on(pen, moments.about, track)
        whole, push = self.name(contact, link), "F_" + sub("b", link)
        polygon, ends = self.new_polygon((link,), "roll"), (contact.letter, centre)
        parts = (f"{whole}^n", f"{whole}^t") if moments.terms else ()
        first = polygon.start
        if parts:
            across = tangential(pen, parts[1], link, ends, moments, pitch)
            first = polygon.lay(parts[1], PART, across)
        last = polygon.lay_all(self.acting[link])
        way = SideDirection(guide=track, block=link)
        held = ClosingSide(parts[0], way, PART) if parts else ClosingSide(whole, way)
        corner = polygon.close(held, ClosingSide(push, way._replace(along=True), "balance")).corner
        force = polygon.reaction(whole, corner, first, whole=parts, drawn=bool(parts))
        quantity = BALANCING_FORCE.target
        given = polygon.reaction(push, last, corner, drawn=False, quantity=quantity)
        applied(pen, LinkForce(push, "balance", given, moments.about, at=centre))
        self.give(contact, link, force, pitch)
        return given, moments

    # --- the lever -------------------------------------------------------------------------------

    def lever(self, group: Crank | Driven | Cylinder, other: int) -> None:
        """The lever with every load; none where the driven point is at rest for all parameters."""
        pen, numbers = self.pen, (f"H_{number}" for number in count(1))
        tip, turns = self.driven_point(group), isinstance(group, Crank)
        by_rate = tip is None and isinstance(group, Crank) and group.driver.against == FRAME
        if not (tip or by_rate) or group.driver.speed.is_zero():
            return
        plan = LeverPlan(pen)
        masses = pen.scene.forces.masses if pen.scene.forces is not None else {}
        for link, some in self.loads.items():
            for each in some:
                if each.couple is not None:
                    plan.couple(link, each)
                    continue
                assert each.place is not None
                if each.at:
                    turned = plan.image(each.at)
                else:
                    turned = plan.moved(link, each.name, masses[link].centre, each.place)
                if turned != plan.pole:
                    plan.put(each, turned, next(numbers))
        link = group.far if isinstance(group, Cylinder) else group.link
        if tip is None:
            plan.by_rate("M_" + sub("b", link), link, other)
            return
        ends = (group.pivot, tip) if isinstance(group, Crank) else (tip, tip)
        names = "F_b" if turns else "F_" + sub("b", link), "M_" + sub("b", link)
        plan.balance(names, ends, other, turns=turns)

    def driven_point(self, group: Crank | Driven | Cylinder) -> str | None:
        """The point whose velocity against the frame is that of the driver; None without one."""
        pen = self.pen
        if isinstance(group, Cylinder):
            foot, (_, on) = group.foot.point, group.pin.links
            rests = on == FRAME or group.pin.place in pen.scene.frame.points
            return foot if rests and pen.has("velocity", foot) else None
        if other_of(group.driver, group.link) != FRAME:
            return None
        if isinstance(group, Crank):
            return crank_tip(pen.scene, group)
        if isinstance(group.pair, Contact):
            return group.pair.wheel.centre
        assert isinstance(group.pair, Sliding)
        return pen.scene.link(group.pair.block).points[0]


def facing(contact: Contact, link: str) -> Wheel:
    """The wheel that a link's wheel touches."""
    first, second = contact.links
    return contact.wheel_of(second if link == first else first)


def pushes_outward(scene: Scene, group: Train) -> bool:
    """Whether the teeth at the last contact push the wheel away from its first contact.

    The places of both contacts count from the wheel's centre, away from the arm's pivot.
    """
    places = []
    for contact in group.contacts:
        radius = contact.wheel_of(group.wheel).radius
        assert radius is not None
        sign = 1 if facing(contact, group.wheel).inside else -1
        places.append(sign * float(radius.si(scene.values)))
    one, other = places
    return (one - other) * -other < 0


def follower_of(scene: Scene, dyad: Dyad) -> str:
    """The follower of a cam among the links of its dyad."""
    return next(link for link in dyad.links if link in scene.cams)


def outer_of(group: Dyad, link: str) -> Joint:
    """The outer pair of one link of a dyad."""
    return group.left if link in group.left.links else group.right
