"""One plan, group by group: images where lines cross, and images by known rates.

Lines are perpendicular to bars or parallel to guides. In the acceleration plan they start at the
ends of the known components: on a turning guide these are the acceleration of the point underneath
and the Coriolis component. The other points of a link follow by similarity.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, overload

from msgspec import Struct

from graphkin.construction.core.bases import Base, crank_tip, sides_of
from graphkin.construction.core.component import LaidOff
from graphkin.construction.core.pen import (
    Pen,
    acceleration_arrow,
    arrow_between,
    letter,
    slide_arrow,
    velocity_arrows,
)
from graphkin.construction.core.program import Effect, Part, Plane, Step
from graphkin.construction.core.quantities import SLIDING
from graphkin.construction.core.vocabulary import difference, join, part_along
from graphkin.construction.guides.guides import axis, known_guide, local_line, path_of
from graphkin.construction.links.link_shapes import local_place, ratio_of
from graphkin.construction.links.plate_points import crosses_well
from graphkin.construction.normal_component import BarAcceleration
from graphkin.construction.plan import ACCELERATION, VELOCITY, Plan, omega_of
from graphkin.construction.velocity.image_of_link import (
    crossed_image,
    image_of_link,
    image_under,
    source_of,
    translated_image,
)
from graphkin.construction.velocity.relative_motion import parallel_through, perpendicular_through
from graphkin.construction.velocity.turned_vectors import accelerated
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.scene.model import Driver
from graphkin.structure.groups import (
    CamFollower,
    Crank,
    Driven,
    Dyad,
    KeptParallel,
    OnTwoPins,
    Spun,
    Tie,
    other_of,
)
from graphkin.structure.pairs import Joint, Leading, Pin, Sliding, partner

if TYPE_CHECKING:
    from graphkin.construction.coriolis import CoriolisComponent
    from graphkin.construction.rolling.wheel_images import LedWheel
    from graphkin.structure.pairs import Contact


class LedBlock(Struct, frozen=True):
    """A block on the guide of a known link, or the link of a guide on a known block."""

    pair: Sliding

    def line(self, pen: Pen) -> int:
        return known_guide(pen, self.pair)

    def path(self, pen: Pen, link: str, point: str) -> int:
        """The line on which a point of the link moves."""
        return path_of(pen, self.pair, link, point)

    def direction(self, pen: Pen) -> int:
        """A line along which the link moves relative to the known one."""
        return known_guide(pen, self.pair)

    def driven(self, pen: Pen, driver: Driver, which: str) -> int:
        """The driver's position, speed or acceleration along the guide."""
        return int(getattr(pen.drive(driver), which))

    def set_at(self, pen: Pen, link: str, where: int) -> None:
        """Place the link, its guided point at a coordinate of the guide; set its axis."""
        from graphkin.construction.guides.guides import set_carrier, set_point

        pair, point = self.pair, pen.bases[link].start
        sides = link, partner(pair, link)
        pen.leads[link] = sides[1]
        line = path_of(pen, pair, link, point)
        with pen.on(Part.POSITION, Plane.MECHANISM):
            if pair.block == link:
                found = set_point(pen, point, sides, line, where)
            else:
                zero = known_guide(pen, pair, link)
                through = local_line(pen, pair.slide, link)[0]
                ends = local_place(pen, link, point), through, axis(pen, link)
                found = set_carrier(pen, point, sides, zero, where, *ends)
        pen.want("position", point, found)

    def finish(self, pen: Pen) -> None:
        """Do nothing: the link needs no more steps once its guided point is placed."""

    def touch(self, pen: Pen, plan: Plan) -> None:
        """Do nothing: a block has no rolling contact."""

    def rim(self, pen: Pen) -> int | None:
        """None: no radius relates its rotation to its coordinate."""
        return None


@overload
def led_by(pair: Contact) -> LedWheel: ...
@overload
def led_by(pair: Leading) -> LedBlock | LedWheel: ...
def led_by(pair: Leading) -> LedBlock | LedWheel:
    """The construction of a pair with a known link, in each drawing."""
    if isinstance(pair, Sliding):
        return LedBlock(pair)
    from graphkin.construction.rolling.wheel_images import LedWheel

    return LedWheel(pair)


class GuideAcceleration(Struct, frozen=True):
    """The line that a guiding pair gives for the acceleration of the point ``name`` of ``link``.

    The point lies at ``point``. The two differ where the unknown is the point of the guide's link
    under a block's point (name A@3, point A).
    """

    pair: Leading
    link: str
    name: str
    point: str

    @property
    def known(self) -> str:
        return partner(self.pair, self.link)

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> int | None:
        """The Coriolis component that a turning guide causes; None where the guide does not turn.

        For a point under a pin it uses the relative velocity of the pin. Otherwise it uses the
        velocity of the point relative to the link on which the point slides.
        """
        if not is_under(self.name) and not pen.turns(self.known):
            return None
        from graphkin.construction.coriolis import coriolis_of

        if is_under(self.name):
            link, tail = self.link, pen.the("velocity", self.name)
        else:
            link, tail = self.known, image_under(pen, self.known, self.point, VELOCITY)
        tip = pen.the("velocity", self.point)
        return coriolis_of(pen, link, tail, tip, self.point, self.pair.links[0])

    def end(self, pen: Pen, vector: int | None) -> int:
        """The end of the known part in the plan: the component laid off from the point underneath.

        If that point is unknown, the component is laid off backwards from the sliding point.
        """
        if vector is None:
            return image_under(pen, self.known, self.point, ACCELERATION)
        from graphkin.construction.coriolis import end_of

        if is_under(self.name):
            return end_of(pen, pen.the("acceleration", self.point), vector, back=True)
        return end_of(pen, image_under(pen, self.known, self.point, ACCELERATION), vector)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The known end, and the line of the rest, parallel to the guide."""
        end = self.end(pen, vector)
        along = led_by(self.pair).direction(pen)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Draw the arrow of the rest."""
        if is_under(self.name):
            slide_arrow(pen, found, end, self.link, self.point)
        else:
            slide_arrow(pen, end, found, self.known, self.point)

    def laid_beside(self, pen: Pen, vector: int, found: int) -> int:
        """The end of the component of a block whose image is known; draws the arrow of the rest."""
        pen.want("coriolis", self.link, vector)
        with ACCELERATION.drawn(pen):
            end = self.end(pen, vector)
            self.rest(pen, end, found)
        return end

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """Draw the arrow from the pole, and the contact point."""
        if not is_under(self.name):
            acceleration_arrow(pen, self.name)
        led_by(self.pair).touch(pen, ACCELERATION)


def end_on_driven(
    pen: Pen, link: str, images: tuple[int, int], point: str, block: str, index: str
) -> int:
    """The end of the known part for a link that a driver slides along another, from a known pin.

    ``images`` are the velocity images of the ``point`` and of the link's own point there.
    """
    from graphkin.construction.coriolis import coriolis_of, end_of

    vector = coriolis_of(pen, link, *images, point, block, index=index)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        return end_of(pen, pen.the("acceleration", point), vector)


def slid(step: Step) -> tuple[LaidOff, CoriolisComponent] | None:
    """The Coriolis component that a step lays off; None for other steps."""
    from graphkin.construction.coriolis import CoriolisComponent

    laid = step.of
    if not isinstance(laid, LaidOff) or not isinstance(laid.component, CoriolisComponent):
        return None
    return laid, laid.component


class BoundVelocity(Struct, frozen=True):
    """The line on which a pair with a known link puts the image of a point."""

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> None:
        """None: no part of the velocity is known beforehand."""

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Nothing: the arrows follow once the image is found."""


class BarVelocity(BoundVelocity, frozen=True):
    """The line that a bar to a known ``pivot`` gives for the velocity of a ``point``."""

    pivot: str
    point: str

    def end(self, pen: Pen, vector: int | None) -> int:
        """The image of the pivot."""
        return pen.the("velocity", self.pivot)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The image of the pivot, and the perpendicular to the bar through it."""
        return self.end(pen, vector), perpendicular_through(pen, self.pivot, self.point)

    def finish(self, pen: Pen) -> None:
        """Draw the arrow from the pole, and the arrow from the pivot's image."""
        velocity_arrows(pen, self.point, self.pivot)


class GuideVelocity(BoundVelocity, frozen=True):
    """The line that a guiding pair gives for the velocity of the point ``name`` of ``link``.

    The point lies at ``point``. The two differ where the unknown is the point of the guide's link
    under a block's point.
    """

    pair: Leading
    link: str
    name: str
    point: str

    def end(self, pen: Pen, vector: int | None) -> int:
        """The image of the point underneath; if that one is unknown, of the point above it."""
        known, point = partner(self.pair, self.link), self.point
        own = known in pen.bases and pen.bases[known].start == point and pen.has("velocity", point)
        return pen.the("velocity", point) if own else image_under(pen, known, point, VELOCITY)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The known image, and the parallel to the guide through it."""
        along = led_by(self.pair).direction(pen)
        end = self.end(pen, vector)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """Draw the arrow from the pole, the arrow along the guide, and the contact point."""
        velocity_arrows(pen, self.name, ends_of(self.name)[0] if is_under(self.name) else None)
        if driven or (isinstance(self.pair, Sliding) and not is_under(self.name)):
            slide_velocity_arrow(pen, self.pair, self.link, self.name)
        led_by(self.pair).touch(pen, VELOCITY)


def slide_velocity_arrow(pen: Pen, pair: Joint, link: str, point: str) -> None:
    """Draw the arrow of a relative velocity along a moving guide.

    A translating guide causes no acceleration component. Then an arrow in the other direction, of
    the guide along the block, is enough.
    """
    known, o = partner(pair, link), pen.pole(Plane.VELOCITIES)
    start, tip = image_under(pen, known, point, VELOCITY), pen.the("velocity", point)
    is_seen = not pen.turns(known) and tip != o and arrow_joins(pen, tip, start)
    if start not in (o, tip) and not is_seen:
        arrow_between(pen, start, tip, point, letter(under(point, known)))


def arrow_joins(pen: Pen, tail: int, tip: int) -> bool:
    """Whether an arrow joins two images, or two images that coincide with them."""
    ends = source_of(pen, tail), source_of(pen, tip)
    arrows = (step.args for step in pen.steps if step.arrow and step.action is join)
    return any((source_of(pen, start), source_of(pen, end)) == ends for start, end in arrows)


Sides = list[tuple[Joint, str]]
"""Two pairs that each leave a point free on a line, with the links that they hold."""


class GroupImages(Struct, frozen=True):
    """Draws a ``plan``, from the lines that a ``bar`` and a ``guide`` or track give for a point."""

    plan: Plan
    bar: Callable[[str, str], BarVelocity | BarAcceleration]
    guide: Callable[[Leading, str, str, str], GuideVelocity | GuideAcceleration]

    # --- driven links ----------------------------------------------------------------------------

    def crank(self, pen: Pen, group: Crank) -> None:
        """Draw the image of a driven tip, from the given rate and its sense."""
        driver, link, tip = group.driver, group.link, crank_tip(pen.scene, group)
        self.turn_driven(pen, group)
        if tip is not None:
            steady = driver.acceleration.is_zero() and not pen.turns(other_of(driver, link))
            self.plan.turn(pen, link, group.pivot, tip, steady=steady, along=group.pivot)

    def turn_driven(self, pen: Pen, group: Crank | Spun) -> None:
        """Write the rate of a driven link: the given rate plus that of its counterpart."""
        driver, link, rate = group.driver, group.link, self.plan.rate
        found: int = getattr(pen.drive(driver), self.plan.given)
        against = other_of(driver, link)
        if pen.turns(against):
            from graphkin.construction.plan import summed_rate

            other = omega_of(pen, against, rate)
            with pen.on(Part.RESULT, Plane.NUMBERS):
                found = summed_rate(pen, driver, link, other, found)
        elif driver.link != link:
            with pen.on(Part.SHAPE, Plane.NUMBERS):
                found = pen.draw(difference, pen.given("zero"), found)
        pen.want(rate, link, found)

    def driven(self, pen: Pen, group: Driven) -> None:
        """Draw the image of a driven slider or wheel centre, along its guide as given."""
        given = led_by(group.pair).driven(pen, group.driver, self.plan.given)
        self.slide_on(pen, group.pair, group.link, given)

    def slide_on(self, pen: Pen, pair: Leading, link: str, given: int) -> None:
        """Draw the image of a guided point, along its line with a given or tried value."""
        from graphkin.construction.drivers.driven_slide import slide_image

        plan, point = self.plan, pen.bases[link].start
        led = self.guide(pair, link, point, point)
        way = 1 if pair.links[0] == link else -1
        line = led_by(pair).direction(pen)
        vector = led.component(pen)
        with plan.drawn(pen):
            start, name = led.end(pen, vector), plan.named(point)
            with pen.calls_for(sliding_effect(pen, given)):
                steps = start, line, given
                found = slide_image(pen, point, pair.links[0], steps, name=name, way=way)
            led.rest(pen, start, found)
        pen.want(plan.quantity, point, found)
        led.finish(pen, driven=True)

    def known_end(self, pen: Pen, pair: Leading, link: str, point: str) -> int:
        """The end of the known part of the motion of a point that a pair guides, in the plan."""
        led = self.guide(pair, link, point, point)
        return led.end(pen, led.component(pen))

    def sliding(self, pen: Pen, block: str) -> None:
        """Write the motion of a block along its guide, with the Coriolis component."""
        plan, pair, point = self.plan, pen.first_slide(block), pen.scene.link(block).points[0]
        start = image_under(pen, pair.links[1], point, plan)
        guide, end = known_guide(pen, pair), pen.the(plan.quantity, point)
        led = self.guide(pair, block, point, point)
        vector = led.component(pen)
        if vector is not None and isinstance(led, GuideAcceleration):
            start = led.laid_beside(pen, vector, end)
        with pen.on(Part.RESULT, Plane.NUMBERS):
            found = pen.draw(part_along, guide, start, end)
        pen.want(SLIDING[plan.quantity].target, block, found)
        if plan is VELOCITY:
            slide_velocity_arrow(pen, pair, block, point)

    # --- dyads and ties --------------------------------------------------------------------------

    def dyad(self, pen: Pen, group: Dyad) -> None:
        """Draw the image of the point that closes a dyad.

        Two pins guided by one link turn with it and need nothing.
        """
        if isinstance(group, OnTwoPins) and group.inner.on is not None:
            return
        self.cross(pen, *sides_of(pen.bases, group))

    def follower(self, pen: Pen, group: CamFollower) -> None:
        """Draw the image of a cam's follower: that of the equivalent linkage."""
        self.dyad(pen, group.dyad)

    def kept(self, pen: Pen, group: KeptParallel) -> None:
        """Draw nothing: the pin's image is known; the other points turn with the known link."""

    def tie(self, pen: Pen, group: Tie) -> None:
        """Draw the image of a link on two guides; a link between two pins needs none."""
        if isinstance(group.first, Sliding):
            point, link = pen.bases[group.link].start, group.link
            self.cross(pen, point, point, [(group.first, link), (group.second, link)])

    def cross(self, pen: Pen, name: str, point: str, sides: Sides) -> None:
        """Draw the image of a point where the lines of two pairs meet."""
        plan = self.plan
        bound = [
            self.bar(pair.point, name)
            if isinstance(pair, Pin)
            else self.guide(pair, link, name, point)
            for pair, link in sides
        ]
        vectors = [each.component(pen, sides) for each in bound]
        with plan.drawn(pen):
            pairs = zip(bound, vectors, strict=True)
            lines = [each.line(pen, vector) for each, vector in pairs]
            crossing = (line for _, line in lines)
            found = crossed_image(pen, *crossing, name=plan.named(name), of=name)
            for each, (end, _) in zip(bound, lines, strict=True):
                each.rest(pen, end, found)
        pen.want(plan.quantity, name, found)
        for each in bound:
            each.finish(pen)

    # --- the rest of a link ----------------------------------------------------------------------

    def plate_points(self, pen: Pen, base: Base) -> None:
        """Draw the images of a link's other points: their figure is similar to it (Mehmke)."""
        if base.end is None:
            self.led_points(pen, base)
            return
        plan = self.plan
        pivots = base.start, base.end
        for point in base.others:
            if pen.has(plan.quantity, point):
                continue
            ratio, hand, ends = ratio_of(pen, base, point), None, list[int]()
            bars = [self.bar(pivot, point) for pivot in pivots]
            if crosses_well(pen, ratio):
                with pen.hands_way():
                    hand, ends = self.two_lines(pen, bars)
            letters = letter(base.start), letter(base.end), point
            with plan.drawn(pen):
                images = *pen.both(plan.quantity, *pivots), ratio
                found = image_of_link(pen, images, letters, name=plan.named(point), hand=hand)
                for bar, end in zip(bars, ends, strict=False):
                    bar.rest(pen, end, found)
            plan.settle(pen, point, found, base.start)
            swings = pen.the(plan.quantity, base.start) == pen.pole(plan.plane)
            if base.end in pen.scene.link(base.link).points and (hand is not None or not swings):
                plan.arrows(pen, point, base.end)

    def two_lines(
        self, pen: Pen, bars: Sequence[BarVelocity | BarAcceleration]
    ) -> tuple[int, list[int]]:
        """The image of a plate point by hand, where the lines of two bars cross."""
        lines = []
        for bar in bars:
            vector = bar.component(pen)
            with self.plan.drawn(pen):
                lines.append(bar.line(pen, vector))
        with self.plan.drawn(pen):
            return crossed_image(pen, *(line for _, line in lines)), [end for end, _ in lines]

    def led_points(self, pen: Pen, base: Base) -> None:
        """Draw the other points of a link that turns with its guide, or only translates."""
        plan = self.plan
        for point in base.others:
            if pen.has(plan.quantity, point):
                continue
            if pen.turns(base.link):
                steady = plan.is_steady(pen, base.link)
                plan.turn(pen, base.link, base.start, point, steady=steady, along=base.start)
                continue
            start, names = pen.the(plan.quantity, base.start), (base.start, point)
            with plan.drawn(pen):
                found = translated_image(pen, start, names, plan.named(point))
            plan.settle(pen, point, found)


def sliding_effect(pen: Pen, given: int) -> Effect | None:
    """The effect of a component along a guide: a driver's, where that one is accelerated."""
    return "driver acceleration" if accelerated(pen, given) else None


VELOCITIES = GroupImages(VELOCITY, BarVelocity, GuideVelocity)
ACCELERATIONS = GroupImages(ACCELERATION, BarAcceleration, GuideAcceleration)
