"""The acceleration plan: what is known laid off, perpendiculars and parallels, their crossings."""

from __future__ import annotations

from msgspec import Struct

from graphkin.construction.acceleration.tangential_direction import RoundPivot, known_and_free
from graphkin.construction.acceleration.turned_acceleration import accelerated, turned_image
from graphkin.construction.core.arrows import acceleration_arrow, component_arrow, slide_arrow
from graphkin.construction.core.bases import Base, crank_tip, sides_of
from graphkin.construction.core.pen import Pen, letter, second_image
from graphkin.construction.core.program import Effect, Part, Plane
from graphkin.construction.core.quantities import EPSILON
from graphkin.construction.guides.coincident_points import omega_of
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.guides.sliding import lay_off_component, turning_component
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.links.plate_points import crosses_well
from graphkin.construction.velocity.image_of_link import (
    crossed_image,
    image_of_link,
    translated_image,
)
from graphkin.construction.velocity.lines_through import parallel_through
from graphkin.construction.velocity.velocity import driven_rate
from graphkin.scene.link_points import is_under
from graphkin.structure.groups import Crank, Driven, Dyad, other_of
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading, Pin


def crank(pen: Pen, shapes: LinkShapes, group: Crank) -> None:
    """Acceleration of a driven tip: from tip to pivot, and square to the bar if it speeds up."""
    tip, driver = crank_tip(pen.scene, group), group.driver
    rate = pen.drive(driver).acceleration
    pen.want(EPSILON, group.link, driven_rate(pen, group, EPSILON, rate))
    if tip is not None:
        steady = driver.acceleration.is_zero() and not pen.turns(other_of(driver, group.link))
        turn_tip(pen, group.link, group.pivot, tip, steady=steady)


def turn_tip(pen: Pen, link: str, pivot: str, tip: str, *, steady: bool = False) -> None:
    """Second image of a point of a link whose rates are known, from that of its pivot."""
    start, points = pen.the("acceleration", pivot), (pivot, tip)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        name = second_image(tip)
        found = turned_image(pen, link, points, start, name=name, steady=steady)
    pen.want("acceleration", tip, found)
    acceleration_arrow(pen, tip)


def driven(pen: Pen, shapes: LinkShapes, group: Driven) -> None:
    """Second image of a driven slider or wheel: along its guide from what is known of it."""
    rate = led_by(group.pair).driven(pen, group.driver, "acceleration")
    slide_on(pen, shapes, group.pair, group.link, rate)


def slide_on(pen: Pen, shapes: LinkShapes, pair: Leading, link: str, rate: int) -> None:
    """Second image of the point of a link that is led along its line at a rate."""
    from graphkin.construction.drivers.driven_slide import slide_image

    point, known = pen.bases[link].start, partner(pair, link)
    way = 1 if pair.links[0] == link else -1
    line = led_by(pair).direction(pen, shapes)
    vector = turning_component(pen, pair, link, point, point)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        corner = lay_off_component(pen, pair, link, point, point, vector)
        name, steps = second_image(point), (corner, line, rate)
        with pen.calls_for(sliding_effect(pen, rate)):
            found = slide_image(pen, point, pair.links[0], steps, name=name, way=way)
        slide_arrow(pen, corner, found, known, point)
    pen.want("acceleration", point, found)
    acceleration_arrow(pen, point)
    led_by(pair).second_touch(pen)


def sliding_effect(pen: Pen, rate: int) -> Effect | None:
    """A component along a guide is a driver's where that is accelerated."""
    return Effect.DRIVER if accelerated(pen, rate) else None


def dyad(pen: Pen, shapes: LinkShapes, group: Dyad) -> None:
    """Second image of the point that closes a dyad: known components laid off, others crossed."""
    cross(pen, shapes, *sides_of(pen.bases, group))


def cross(
    pen: Pen, shapes: LinkShapes, name: str, point: str, sides: list[tuple[Joint, str]]
) -> None:
    """The second image of a point from the lines on which two pairs leave it free."""
    bound = [
        RoundPivot(pair.point, name) if isinstance(pair, Pin) else Led(pair, link, name, point)
        for pair, link in sides
    ]
    vectors = [each.component_in_dyad(pen, shapes, sides) for each in bound]
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        lines: list[int] = []
        corners: list[int] = []
        for each, vector in zip(bound, vectors, strict=True):
            corners.append(each.end(pen, vector))
            lines.append(each.line(pen, shapes, corners[-1]))
        found = crossed_image(pen, *lines, name=second_image(name), of=name)
        for each, corner in zip(bound, corners, strict=True):
            each.arrow(pen, corner, found)
    pen.want("acceleration", name, found)
    if not is_under(name):
        acceleration_arrow(pen, name)
    for each in bound:
        each.touch(pen)


class Led(Struct, frozen=True):
    """What a pair says of the acceleration of the point ``name`` that it leads against ``link``.

    It lies at ``point``, which is another where that of a guide's link under a block's is sought.
    """

    pair: Leading
    link: str
    name: str
    point: str

    def component_in_dyad(
        self, pen: Pen, shapes: LinkShapes, sides: list[tuple[Joint, str]]
    ) -> int | None:
        """The component that its guide's turning gives it; None where that does not turn."""
        return turning_component(pen, self.pair, self.link, self.name, self.point)

    def end(self, pen: Pen, vector: int | None) -> int:
        """Where the known part ends in the plan."""
        return lay_off_component(pen, self.pair, self.link, self.name, self.point, vector)

    def line(self, pen: Pen, shapes: LinkShapes, corner: int) -> int:
        """The line of the rest, parallel to the guide."""
        along = led_by(self.pair).direction(pen, shapes)
        return parallel_through(pen, corner, along, self.pair.links[0])

    def arrow(self, pen: Pen, corner: int, found: int) -> None:
        """The arrow of the rest."""
        if is_under(self.name):
            slide_arrow(pen, found, corner, self.link, self.point)
        else:
            slide_arrow(pen, corner, found, partner(self.pair, self.link), self.point)

    def touch(self, pen: Pen) -> None:
        """The second image of the point where it touches."""
        led_by(self.pair).second_touch(pen)


# --- the rest of a link --------------------------------------------------------------------------


def plate_points(pen: Pen, shapes: LinkShapes, base: Base) -> None:
    """Second images of the other points of a link, similar to the link (Mehmke)."""
    if base.end is None:
        led_points(pen, base)
        return
    ends = pen.the("acceleration", base.start), pen.the("acceleration", base.end)
    for point in base.others:
        if pen.has("acceleration", point):
            continue
        hand: int | None = None
        corners: dict[str, int] = {}
        ratio = shapes.ratio_of(base, point)
        if crosses_well(pen, ratio):
            hand, corners = two_perpendiculars(pen, base, point)
        letters = letter(base.start), letter(base.end), point
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            images = *ends, ratio
            found = image_of_link(pen, images, letters, name=second_image(point), hand=hand)
            for pivot, corner in corners.items():
                component_arrow(pen, corner, found, "τ", point, pivot)
        pen.want("acceleration", point, found)
        acceleration_arrow(pen, point)


def led_points(pen: Pen, base: Base) -> None:
    """The other points of a link that turns with its guide; where it only shifts, one image."""
    for point in base.others:
        if pen.has("acceleration", point):
            continue
        if pen.turns(base.link):
            omega_of(pen, base.link), omega_of(pen, base.link, EPSILON)
            steady = pen.is_nought(pen.the(EPSILON, base.link))
            turn_tip(pen, base.link, base.start, point, steady=steady)
            continue
        start = pen.the("acceleration", base.start)
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            found = translated_image(pen, start, (base.start, point), second_image(point))
        pen.want("acceleration", point, found)
        acceleration_arrow(pen, point)


def two_perpendiculars(pen: Pen, base: Base, point: str) -> tuple[int, dict[str, int]]:
    """The hand's way to a plate point: normal and perpendicular about each end of the base."""
    assert base.end is not None
    lines: list[int] = []
    corners: dict[str, int] = {}
    with pen.hands_way():
        for pivot in (base.start, base.end):
            corners[pivot], line = known_and_free(pen, pivot, point)
            lines.append(line)
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            return crossed_image(pen, *lines), corners
