"""The plan of forces as steps after those of the motion, from the last group to the first.

Sources: I. I. Artobolevsky, Theory of Mechanisms and Machines, kinetostatics of Assur groups; R. L.
Norton, Design of Machinery, chapter 11.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count

from graphkin.construction.core.bases import crank_tip
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane, Program
from graphkin.construction.core.quantities import (
    BALANCING_FORCE,
    BALANCING_MOMENT,
    PAIR_REACTION,
)
from graphkin.construction.forces.balance import balance_of
from graphkin.construction.forces.force_words import link_pair, sub
from graphkin.construction.forces.lever import LeverPlan
from graphkin.construction.forces.loads import LinkForce, applied, loads_of, opposite
from graphkin.construction.forces.moments import (
    Moments,
    couple_on_guide,
    moments_about,
    place_on_guide,
    tangential,
)
from graphkin.construction.forces.polygon import (
    PART,
    REACTION,
    Polygon,
    SideDirection,
    side_between,
)
from graphkin.construction.forces.slide_pressure import pressure
from graphkin.construction.forces.tooth_force import tooth
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.groups import Crank, Driven, Dyad, Group
from graphkin.structure.pairs import Joint, Pin, PinLine, Sliding
from graphkin.structure.wheel_groups import Geared, other_of


def undrawn(scene: Scene, groups: Sequence[Group]) -> Group | None:
    """The last group whose forces are not drawn; None where all are."""
    return next((each for each in reversed(groups) if not is_drawn(scene, each)), None)


def is_drawn(scene: Scene, group: Group) -> bool:
    """Whether the forces of a group are drawn."""
    match group:
        case Dyad():
            pairs = (*group.outer, group.inner)
            return all(is_plain(scene, pair) for pair in pairs)
        case Crank(driver=driver, link=link):
            return other_of(driver, link) == FRAME
        case Geared(link=link, pair=Pin() as pin, contact=contact):
            on_frame = FRAME in pin.links and contact.arm == FRAME
            both = contact.track is not None and contact.rolling.belt is None
            return on_frame and both and contact.wheel_of(link).centre == pin.place
        case Driven(driver=driver, link=link, pair=pair):
            return other_of(driver, link) == FRAME and is_plain(scene, pair)
    return False


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
    ForcePlan(pen).write(groups)
    return pen.program()


class ForcePlan:
    """The plan of forces while it is drawn: what acts on each link so far."""

    def __init__(self, pen: Pen) -> None:
        assert pen.scene.forces is not None
        self.pen = pen
        self.arms = (f"h_{number}" for number in count(1))
        self.acting = loads_of(pen, pen.scene.forces, self.arms)
        self.loads = {link: tuple(some) for link, some in self.acting.items()}
        self.polygons = count(1)

    def write(self, groups: Sequence[Group]) -> None:
        """Draw every group, then the lever of a mechanism with one driver."""
        balances: list[tuple[Crank | Driven, int]] = []
        for group in reversed(groups):
            match group:
                case Dyad(inner=Pin()):
                    self.by_inner_pin(group)
                case Dyad():
                    self.by_inner_slide(group)
                case Geared():
                    self.geared(group)
                case Crank():
                    balances.append((group, self.crank(group)))
                case Driven():
                    balances.append((group, self.driven(group)))
        if len(balances) == 1:
            self.lever(*balances[0])

    # --- names and reactions ---------------------------------------------------------------------

    def new_polygon(self, links: Sequence[str], kind: str) -> Polygon:
        """The next polygon."""
        return Polygon(self.pen, next(self.polygons), links, kind)

    def partner(self, pair: Joint, link: str) -> str:
        """The other link of a pair."""
        first, second = pair.links
        return second if link == first else first

    def name(self, pair: Joint, link: str, part: str = "") -> str:
        """The symbol of the reaction on a link in a pair, and of its part."""
        index = link_pair(self.partner(pair, link), link)
        return f"R_{index}" + (f"^{part}" if part else "")

    def guide(self, pair: Joint) -> int:
        """The step of a guide."""
        assert isinstance(pair, Sliding)
        return self.pen.the("guide", pair.block)

    def give(self, pair: Joint, link: str, force: int, place: int, at: str = "") -> None:
        """Enter the reaction on a link, drawn on the mechanism, and pass its opposite on."""
        pen, other = self.pen, self.partner(pair, link)
        if other == FRAME:
            applied(pen, LinkForce(self.name(pair, link), REACTION, force, place, at=at))
            return
        with pen.on(Part.FORCE, Plane.NUMBERS):
            back = pen.draw(opposite, force)
        passed = LinkForce(self.name(pair, other), REACTION, back, place, at=at)
        self.acting[other].append(applied(pen, passed))

    # --- dyads -----------------------------------------------------------------------------------

    def by_inner_pin(self, group: Dyad) -> None:
        """RRR, RRP, PRP: parts across bars, the polygon of both links, places on guides."""
        pen, inner = self.pen, group.inner
        assert isinstance(inner, Pin)
        one, other = group.links
        outer = {link: outer_of(group, link) for link in group.links}
        if isinstance(outer[one], Sliding) and not isinstance(outer[other], Sliding):
            one, other = other, one
        pin = pen.the("position", inner.place)
        moments = {
            link: moments_about(pen, pin, inner.place, self.acting[link], self.arms)
            for link in (one, other)
        }
        across = {}
        for link in (one, other):
            pair = outer[link]
            if isinstance(pair, Pin) and moments[link].terms:
                name, ends = self.name(pair, link, "t"), (pair.place, inner.place)
                across[link] = tangential(pen, name, link, ends, moments[link])
        polygon = self.new_polygon((one, other), group.type)
        first = polygon.start
        if one in across:
            first = polygon.lay(self.name(outer[one], one, "t"), PART, across[one])
        middle = polygon.lay_all(self.acting[one])
        second = polygon.lay_all(self.acting[other])
        if other in across:
            polygon.lay(self.name(outer[other], other, "t"), PART, across[other])
        parts = {
            link: self.name(outer[link], link, "n" if link in across else "")
            for link in (one, other)
        }
        looks = {link: PART if link in across else REACTION for link in (one, other)}
        closed = polygon.close(
            (parts[one], parts[other]),
            (self.way(outer[one], inner), self.way(outer[other], inner)),
            (looks[one], looks[other]),
        )
        corner = closed.corner
        forces = {}
        for link, tail, tip in ((one, corner, first), (other, second, corner)):
            name = self.name(outer[link], link)
            whole = (f"{name}^n", f"{name}^t") if link in across else ()
            forces[link] = polygon.reaction(name, tail, tip, whole=whole, drawn=bool(whole))
        polygon.reaction(self.name(inner, one), middle, corner)
        for link in (one, other):
            self.settle(outer[link], link, forces[link], moments[link])

    def settle(self, pair: Joint, link: str, force: int, moments: Moments) -> None:
        """Enter an outer reaction at its pin, or at its place on a guide by moments."""
        if isinstance(pair, Pin):
            self.at_pin(pair, link, force)
            return
        name, guide = self.name(pair, link), self.guide(pair)
        place = place_on_guide(self.pen, name, f"x_{link}", link, guide, force, moments)
        self.give(pair, link, force, place)
        self.turn(pair, link, couple_on_guide(self.pen, guide, force, moments))

    def turn(self, pair: Joint, link: str, couple: int | None, *, both: bool = False) -> None:
        """Pass the couple of a guide on a link to the other one, and enter it on ``both``."""
        other = self.partner(pair, link)
        if couple is None:
            return
        index = link_pair(other, link)
        if both:
            self.acting[link].append(LinkForce(f"M_{index}", REACTION, couple=couple))
        if other != FRAME:
            with self.pen.on(Part.FORCE, Plane.NUMBERS):
                back = self.pen.draw(opposite, couple)
            passed = LinkForce(f"M_{link_pair(link, other)}", REACTION, couple=back)
            self.acting[other].append(passed)

    def at_pin(self, pair: Pin, link: str, force: int) -> None:
        """Enter the reaction in a pin."""
        self.give(pair, link, force, self.pen.the("position", pair.place), pair.place)

    def way(self, pair: Joint, inner: Pin) -> SideDirection:
        """The direction of a closing side."""
        if isinstance(pair, Pin):
            return SideDirection((pair.place, inner.place))
        assert isinstance(pair, Sliding)
        return SideDirection(guide=self.guide(pair), block=pair.block)

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
        others, own = (
            moments_about(
                pen, pen.the("position", pin.place), pin.place, self.acting[link], self.arms
            )
            for link, pin in (near, far)
        )
        one, other = near[0], far[0]
        name, guide = self.name(inner, one), self.guide(inner)
        force = pressure(pen, name, next(self.arms), (other, inner.block), guide, own, others)
        place = place_on_guide(pen, name, f"x_{one}", one, guide, force, others)
        self.pressed(inner, one, other, force, place)
        self.turn(inner, one, couple_on_guide(pen, guide, force, others), both=True)
        for link, pin in (far, near):
            polygon = self.closed_at(group.type, link, pin)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            pen.want(PAIR_REACTION.target, name, pen.draw(side_between, *polygon.ends[name]))

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

    def pressed(self, inner: Joint, one: str, other: str, force: int, place: int) -> None:
        """Enter the force of a guide or wheel on one link, and its opposite on the other."""
        pen = self.pen
        with pen.on(Part.FORCE, Plane.NUMBERS):
            back = pen.draw(opposite, force)
        self.acting[one].append(LinkForce(self.name(inner, one), REACTION, force, place))
        passed = LinkForce(self.name(inner, other), REACTION, back, place)
        self.acting[other].append(applied(pen, passed))

    def on_two_guides(
        self, group: Dyad, inner: Sliding, near: tuple[str, Pin], far: tuple[str, Sliding]
    ) -> None:
        """RPP: the polygon of the link on two guides, then that of the link with a pin."""
        pen, (one, pair), (other, outer) = self.pen, near, far
        polygon = self.new_polygon((other,), group.type)
        last = polygon.lay_all(self.acting[other])
        names = self.name(inner, other), self.name(outer, other)
        guides = self.guide(inner), self.guide(outer)
        ways = (
            SideDirection(guide=guides[0], block=inner.block),
            SideDirection(guide=guides[1], block=outer.block),
        )
        closed = polygon.close(names, ways, (REACTION, REACTION))
        pushed = polygon.reaction(names[0], closed.corner, polygon.start, drawn=False)
        outward = polygon.reaction(names[1], last, closed.corner, drawn=False)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            back = pen.draw(opposite, pushed)
        pin = pen.the("position", pair.place)
        moments = moments_about(pen, pin, pair.place, self.acting[one], self.arms)
        name = self.name(inner, one)
        place = place_on_guide(pen, name, f"x_{one}", one, guides[0], back, moments)
        self.pressed(inner, one, other, back, place)
        self.turn(inner, one, couple_on_guide(pen, guides[0], back, moments), both=True)
        rest = moments_about(pen, place, pair.place, self.acting[other], self.arms)
        self.settle(outer, other, outward, rest)
        self.closed_at(group.type, one, pair)

    # --- wheels ----------------------------------------------------------------------------------

    def geared(self, group: Geared) -> None:
        """A wheel on a fixed pivot: the force of the other wheel by moments, then its polygon."""
        pen, link, contact, pin = self.pen, group.link, group.contact, group.pair
        assert isinstance(pin, Pin)
        other = self.partner(contact, link)
        pivot = pen.the("position", pin.place)
        moments = moments_about(pen, pivot, pin.place, self.acting[link], self.arms)
        wheels = contact.wheel_of(link), contact.wheel_of(other)
        found = tooth(pen, self.name(contact, link), link, wheels, moments)
        self.pressed(contact, link, other, found.force, found.pitch)
        polygon = self.closed_at("", link, pin)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            side = pen.draw(side_between, *polygon.ends[found.name])
        pen.want(PAIR_REACTION.target, found.name, side)

    # --- drivers ---------------------------------------------------------------------------------

    def crank(self, group: Crank) -> int:
        """The balancing moment of a crank, and the reaction in its pivot."""
        pen, link = self.pen, group.link
        pivot = pen.the("position", group.pivot)
        moments = moments_about(pen, pivot, group.pivot, self.acting[link], self.arms)
        name = "M_" + sub("b", link)
        moment = balance_of(pen, name, link, moments)
        pen.want(BALANCING_MOMENT.target, name, moment)
        self.closed_at("crank", link, Pin(group.pivot, (group.base, link)))
        return moment

    def driven(self, group: Driven) -> int:
        """The balancing force of a driven block along its guide, and the reaction of the guide."""
        pen, link, pair = self.pen, group.link, group.pair
        assert isinstance(pair, Sliding)
        guide, point = self.guide(pair), pen.scene.link(pair.block).points[0]
        pin = pen.the("position", point)
        moments = moments_about(pen, pin, point, self.acting[link], self.arms)
        polygon = self.new_polygon((link,), "slide")
        last = polygon.lay_all(self.acting[link])
        ways = (
            SideDirection(guide=guide, block=pair.block, along=True),
            SideDirection(guide=guide, block=pair.block),
        )
        names = "F_" + sub("b", link), self.name(pair, link)
        closed = polygon.close(names, ways, ("balance", REACTION))
        push = polygon.reaction(
            names[0],
            closed.corner,
            polygon.start,
            drawn=False,
            quantity=BALANCING_FORCE.target,
        )
        force = polygon.reaction(names[1], last, closed.corner, drawn=False)
        applied(pen, LinkForce(names[0], "balance", push, pin, at=point))
        self.settle(pair, link, force, moments)
        return push

    # --- the lever -------------------------------------------------------------------------------

    def lever(self, group: Crank | Driven, other: int) -> None:
        """The lever with every load; none where the driven point is at rest for all parameters."""
        pen, numbers = self.pen, (f"H_{number}" for number in count(1))
        tip = crank_tip(pen.scene, group) if isinstance(group, Crank) else group_point(pen, group)
        if tip is None or group.driver.speed.is_zero():
            return
        plan = LeverPlan(pen)
        forces, couples = [], []
        masses = pen.scene.forces.masses if pen.scene.forces is not None else {}
        for link, some in self.loads.items():
            for each in some:
                if each.couple is not None:
                    couples.append(plan.couple(link, each))
                    continue
                assert each.place is not None
                if each.at:
                    turned = plan.image(each.at)
                else:
                    turned = plan.moved(link, each.name, masses[link].centre, each.place)
                if turned != plan.pole:
                    forces.append(plan.put(each, turned, next(numbers)))
        turns = isinstance(group, Crank)
        ends = (group.pivot, tip) if isinstance(group, Crank) else (tip, tip)
        names = "F_b" if turns else "F_" + sub("b", group.link), "M_" + sub("b", group.link)
        plan.balance(names, ends, forces, couples, other, turns=turns)


def group_point(pen: Pen, group: Driven) -> str:
    """The point of a driven block."""
    assert isinstance(group.pair, Sliding)
    return pen.scene.link(group.pair.block).points[0]


def outer_of(group: Dyad, link: str) -> Joint:
    """The outer pair of one link of a dyad."""
    return group.left if link in group.left.links else group.right
