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
from graphkin.construction.forces.balance import balance_of
from graphkin.construction.forces.force_words import link_pair
from graphkin.construction.forces.lever import LeverPlan
from graphkin.construction.forces.loads import Acting, applied, loads_of, opposite
from graphkin.construction.forces.moments import (
    moments_about,
    place_on_guide,
    tangential,
)
from graphkin.construction.forces.polygon import PART, REACTION, Polygon, Way
from graphkin.construction.forces.slide_pressure import pressure
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.groups import Crank, Driven, Dyad, Group
from graphkin.structure.pairs import Joint, Pin, PinLine, Sliding
from graphkin.structure.wheel_groups import other_of
from graphkin.text.errors import Message


def undrawn(scene: Scene, groups: Sequence[Group]) -> Message | str | None:
    """The title of the first group whose forces are not drawn; None where all are."""
    return next((each.title for each in reversed(groups) if not is_drawn(scene, each)), None)


def is_drawn(scene: Scene, group: Group) -> bool:
    """Whether the forces of a group are drawn."""
    match group:
        case Dyad():
            pairs = (*group.outer, group.inner)
            return all(is_plain(scene, pair) for pair in pairs)
        case Crank(driver=driver, link=link):
            return other_of(driver, link) == FRAME and not scene.link(link).wheels
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
        balances = []
        for group in reversed(groups):
            match group:
                case Dyad(inner=Pin()):
                    self.by_inner_pin(group)
                case Dyad():
                    self.by_inner_slide(group)
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
            applied(pen, Acting(self.name(pair, link), REACTION, force, place, at=at))
            return
        with pen.on(Part.FORCE, Plane.NUMBERS):
            back = pen.draw(opposite, force)
        passed = Acting(self.name(pair, other), REACTION, back, place, at=at)
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
        across = {
            link: tangential(
                pen,
                self.name(outer[link], link, "t"),
                link,
                (outer[link].place, inner.place),
                moments[link],
            )
            for link in (one, other)
            if isinstance(outer[link], Pin) and moments[link].terms
        }
        polygon = self.new_polygon((one, other), group.type)
        first = polygon.start
        if one in across:
            first = polygon.lay(self.name(outer[one], one, "t"), PART, across[one])
        middle = polygon.lay_all(self.acting[one])
        second = polygon.lay_all(self.acting[other])
        if other in across:
            polygon.lay(self.name(outer[other], other, "t"), PART, across[other])
        parts = tuple(
            self.name(outer[link], link, "n" if link in across else "") for link in (one, other)
        )
        ways = tuple(self.way(outer[link], inner) for link in (one, other))
        looks = tuple(PART if link in across else REACTION for link in (one, other))
        closed = polygon.close(*parts, ways, looks)  # type: ignore[arg-type]
        corner = closed.corner
        forces = {}
        for link, tail, tip in ((one, corner, first), (other, second, corner)):
            name = self.name(outer[link], link)
            whole = (f"{name}^n", f"{name}^t") if link in across else ()
            forces[link] = polygon.reaction(name, tail, tip, whole=whole, drawn=bool(whole))
        polygon.reaction(self.name(inner, one), middle, corner)
        for link in (one, other):
            self.settle(outer[link], link, forces[link], pin, moments[link])

    def settle(self, pair: Joint, link: str, force: int, pin: int, moments: object) -> None:
        """Enter an outer reaction at its pin, or at its place on a guide."""
        if isinstance(pair, Pin):
            self.give(pair, link, force, self.pen.the("position", pair.place), pair.place)
            return
        name, guide = self.name(pair, link), self.guide(pair)
        number = f"x_{link}"
        place = place_on_guide(self.pen, name, number, link, guide, force, moments)  # type: ignore[arg-type]
        self.give(pair, link, force, place)

    def way(self, pair: Joint, inner: Pin) -> Way:
        """The direction of a closing side."""
        if isinstance(pair, Pin):
            return Way((pair.place, inner.place))
        assert isinstance(pair, Sliding)
        return Way(guide=self.guide(pair), block=pair.block)

    def by_inner_slide(self, group: Dyad) -> None:
        """RPR, RPP: the force normal to the inner guide, then the polygon of each link."""
        inner = group.inner
        assert isinstance(inner, Sliding)
        outer = {link: outer_of(group, link) for link in group.links}
        one, other = group.links
        if isinstance(outer[one], Sliding):
            one, other = other, one
        if isinstance(outer[other], Sliding):
            self.on_two_guides(group, one, other)
            return
        pen = self.pen
        pins = {link: pen.the("position", outer[link].place) for link in group.links}  # type: ignore[union-attr]
        if self.has_moments(one, pins[one]) and not self.has_moments(other, pins[other]):
            one, other = other, one
        near, far = (
            moments_about(pen, pins[link], outer[link].place, self.acting[link], self.arms)  # type: ignore[union-attr]
            for link in (one, other)
        )
        name, guide = self.name(inner, one), self.guide(inner)
        force = pressure(pen, name, next(self.arms), (other, inner.block), guide, far, near)
        place = place_on_guide(pen, name, f"x_{one}", one, guide, force, near)
        self.pressed(inner, one, other, force, place)
        for link in (other, one):
            polygon = self.new_polygon((link,), group.type)
            last = polygon.lay_all(self.acting[link])
            reaction = polygon.reaction(
                self.name(outer[link], link), last, polygon.start, closes=True
            )
            self.settle(outer[link], link, reaction, 0, None)

    def has_moments(self, link: str, pin: int) -> bool:
        """Whether a force on a link acts elsewhere than at a pin."""
        return any(each.couple is not None or each.place != pin for each in self.acting[link])

    def pressed(self, inner: Sliding, one: str, other: str, force: int, place: int) -> None:
        """Enter the force of a guide on one link, and its opposite on the other."""
        pen = self.pen
        with pen.on(Part.FORCE, Plane.NUMBERS):
            back = pen.draw(opposite, force)
        self.acting[one].append(Acting(self.name(inner, one), REACTION, force, place))
        passed = Acting(self.name(inner, other), REACTION, back, place)
        self.acting[other].append(applied(pen, passed))

    def on_two_guides(self, group: Dyad, one: str, other: str) -> None:
        """RPP: the polygon of the link on two guides, then that of the link with a pin."""
        pen, inner = self.pen, group.inner
        assert isinstance(inner, Sliding)
        outer = {link: outer_of(group, link) for link in group.links}
        polygon = self.new_polygon((other,), group.type)
        last = polygon.lay_all(self.acting[other])
        names = self.name(inner, other), self.name(outer[other], other)
        guides = self.guide(inner), self.guide(outer[other])
        ways = (
            Way(guide=guides[0], block=inner.block),
            Way(guide=guides[1], block=outer[other].block),  # type: ignore[union-attr]
        )
        closed = polygon.close(*names, ways, (REACTION, REACTION))
        pushed = polygon.reaction(names[0], closed.corner, polygon.start, drawn=False)
        outward = polygon.reaction(names[1], last, closed.corner, drawn=False)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            back = pen.draw(opposite, pushed)
        pin = pen.the("position", outer[one].place)  # type: ignore[union-attr]
        letter = outer[one].place  # type: ignore[union-attr]
        near = moments_about(pen, pin, letter, self.acting[one], self.arms)
        place = place_on_guide(pen, self.name(inner, one), f"x_{one}", one, guides[0], back, near)
        self.pressed(inner, one, other, back, place)
        rest = moments_about(pen, place, letter, self.acting[other], self.arms)
        at = place_on_guide(pen, names[1], f"x_{other}", other, guides[1], outward, rest)
        self.give(outer[other], other, outward, at)
        polygon = self.new_polygon((one,), group.type)
        last = polygon.lay_all(self.acting[one])
        reaction = polygon.reaction(self.name(outer[one], one), last, polygon.start, closes=True)
        self.settle(outer[one], one, reaction, 0, None)

    # --- drivers ---------------------------------------------------------------------------------

    def crank(self, group: Crank) -> int:
        """The balancing moment of a crank, and the reaction in its pivot."""
        pen, link = self.pen, group.link
        pivot = pen.the("position", group.pivot)
        moments = moments_about(pen, pivot, group.pivot, self.acting[link], self.arms)
        moment = balance_of(pen, f"M_b{link}", link, moments)
        polygon = self.new_polygon((link,), "crank")
        last = polygon.lay_all(self.acting[link])
        pair = Pin(group.pivot, (FRAME, link))
        force = polygon.reaction(self.name(pair, link), last, polygon.start, closes=True)
        self.give(pair, link, force, pivot, group.pivot)
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
        ways = Way(guide=guide, block=pair.block, along=True), Way(guide=guide, block=pair.block)
        names = f"F_b{link}", self.name(pair, link)
        closed = polygon.close(*names, ways, ("balance", REACTION))
        push = polygon.reaction(names[0], closed.corner, polygon.start, drawn=False)
        force = polygon.reaction(names[1], last, closed.corner, drawn=False)
        applied(pen, Acting(names[0], "balance", push, pin, at=point))
        self.settle(pair, link, force, pin, moments)
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
        names = f"F_b{'' if turns else group.link}", f"M_b{group.link}"
        plan.balance(names, ends, forces, couples, other, turns=turns)


def group_point(pen: Pen, group: Driven) -> str:
    """The point of a driven block."""
    assert isinstance(group.pair, Sliding)
    return pen.scene.link(group.pair.block).points[0]


def outer_of(group: Dyad, link: str) -> Joint:
    """The outer pair of one link of a dyad."""
    return group.left if link in group.left.links else group.right
