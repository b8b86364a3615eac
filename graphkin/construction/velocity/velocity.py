"""The velocity plan: perpendiculars and parallels through known images, and their crossings."""

from __future__ import annotations

from graphkin.construction.core.arrows import arrow_between, velocity_arrows
from graphkin.construction.core.bases import Base, crank_tip, sides_of
from graphkin.construction.core.pen import Pen, image, letter
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.vocabulary import difference, join, part_along
from graphkin.construction.guides.coincident_points import image_under, omega_of, source_of
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.links.plate_points import crosses_well
from graphkin.construction.velocity.image_of_link import (
    crossed_image,
    image_of_link,
    translated_image,
)
from graphkin.construction.velocity.lines_through import parallel_through, perpendicular_through
from graphkin.construction.velocity.turned_velocity import turned_image
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.structure.groups import Crank, Driven, Dyad, Spun, other_of
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading, Pin, Sliding

# --- driven links --------------------------------------------------------------------------------


def crank(pen: Pen, shapes: LinkShapes, group: Crank) -> None:
    """Image of a driven tip: omega times the bar, square to it, in the sense of omega."""
    pivot, tip = group.pivot, crank_tip(pen.scene, group)
    speed = pen.drive(group.driver).speed
    pen.want(OMEGA, group.link, driven_rate(pen, group, OMEGA, speed))
    if tip is not None:
        turn_tip(pen, group.link, pivot, tip)


def driven_rate(pen: Pen, group: Crank | Spun, quantity: str, given: int) -> int:
    """Angular velocity or acceleration of a driven link: the given one, on top of the other's."""
    against = other_of(group.driver, group.link)
    if not pen.turns(against):
        return given if group.driver.link == group.link else turned_round(pen, given)
    from graphkin.construction.drivers.summed_rate import summed_rate

    rate = omega_of(pen, against, quantity)
    with pen.on(Part.RESULT, Plane.NUMBERS):
        return summed_rate(pen, group.driver, group.link, rate, given)


def turned_round(pen: Pen, given: int) -> int:
    """A given rate of the frame against a link, as the link's own."""
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        return pen.draw(difference, pen.given("nought"), given)


def turn_tip(pen: Pen, link: str, pivot: str, tip: str) -> None:
    """Image of a point of a link whose angular velocity is known, from that of its pivot."""
    ends = pen.the("position", pivot), pen.the("position", tip)
    start = pen.the("velocity", pivot)
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        found = turned_image(pen, link, (pivot, tip), start, ends, name=image(tip))
    pen.want("velocity", tip, found)
    velocity_arrows(pen, tip, pivot)


def driven(pen: Pen, shapes: LinkShapes, group: Driven) -> None:
    """Image of a driven slider, or of a driven wheel's centre: the given speed on its guide."""
    speed = led_by(group.pair).driven(pen, group.driver, "speed")
    slide_on(pen, shapes, group.pair, group.link, speed)


def slide_on(pen: Pen, shapes: LinkShapes, pair: Leading, link: str, speed: int) -> None:
    """Image of the point of a link that is led at a speed along its line."""
    from graphkin.construction.drivers.driven_slide import slide_image

    point, known = pen.bases[link].start, partner(pair, link)
    way = 1 if pair.links[0] == link else -1
    led = led_by(pair)
    line = led.direction(pen, shapes)
    start = image_under(pen, known, point)
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        steps = start, line, speed
        found = slide_image(pen, point, pair.links[0], steps, name=image(point), way=way)
    pen.want("velocity", point, found)
    velocity_arrows(pen, point, None)
    slide_arrow(pen, pair, link, point)
    led.touch(pen)


# --- dyads and ties ------------------------------------------------------------------------------


def dyad(pen: Pen, shapes: LinkShapes, group: Dyad) -> None:
    """Image of the point that closes a dyad: each relative velocity has its known direction."""
    cross(pen, shapes, *sides_of(pen.bases, group))


def cross(
    pen: Pen, shapes: LinkShapes, name: str, point: str, sides: list[tuple[Joint, str]]
) -> None:
    """The image of a point where the lines meet that two pairs leave it free on."""
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        lines = [ray(pen, shapes, *side, name, point) for side in sides]
        found = crossed_image(pen, *lines, name=image(name), of=name)
    pen.want("velocity", name, found)
    for pair, link in sides:
        velocity_arrows(pen, name, source(pair, name))
        if isinstance(pair, Sliding) and not is_under(name):
            slide_arrow(pen, pair, link, name)
        if not isinstance(pair, Pin):
            led_by(pair).touch(pen)


def source(pair: Joint, point: str) -> str | None:
    """The point about which a pair leaves a point free, or the pin over the point of a guide."""
    if isinstance(pair, Pin):
        return pair.point
    return ends_of(point)[0] if is_under(point) else None


def ray(pen: Pen, shapes: LinkShapes, pair: Joint, link: str, name: str, point: str) -> int:
    """The line on which a pair of a link leaves the image of a point free."""
    if isinstance(pair, Pin):
        return perpendicular_through(pen, pair.point, name)
    line, known = led_by(pair).direction(pen, shapes), partner(pair, link)
    own = known in pen.bases and pen.bases[known].start == point and pen.has("velocity", point)
    start = pen.the("velocity", point) if own else image_under(pen, known, point)
    return parallel_through(pen, start, line, pair.links[0])


# --- the rest of a link --------------------------------------------------------------------------


def plate_points(pen: Pen, shapes: LinkShapes, base: Base) -> None:
    """Images of the other points of a link: the triangle abc is similar to ABC, turned 90°."""
    if base.end is None:
        led_points(pen, base)
        return
    ends = pen.the("velocity", base.start), pen.the("velocity", base.end)
    for point in base.others:
        if pen.has("velocity", point):
            continue
        ratio = shapes.ratio_of(base, point)
        hand = None
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            if crosses_well(pen, ratio):
                with pen.hands_way():
                    lines = (
                        perpendicular_through(pen, base.start, point),
                        perpendicular_through(pen, base.end, point),
                    )
                    hand = crossed_image(pen, *lines)
            letters = letter(base.start), letter(base.end), point
            images = *ends, ratio
            found = image_of_link(pen, images, letters, name=image(point), hand=hand)
        pen.want("velocity", point, found)
        velocity_arrows(pen, point, base.start)
        if base.end in pen.scene.link(base.link).points:
            velocity_arrows(pen, point, base.end)


def led_points(pen: Pen, base: Base) -> None:
    """The other points of a link that turns with its guide; where it only shifts, one image."""
    for point in base.others:
        if pen.has("velocity", point):
            continue
        if pen.turns(base.link):
            omega_of(pen, base.link)
            turn_tip(pen, base.link, base.start, point)
            continue
        start = pen.the("velocity", base.start)
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            found = translated_image(pen, start, (base.start, point), image(point))
        pen.want("velocity", point, found)
        velocity_arrows(pen, point, None)


def sliding(pen: Pen, shapes: LinkShapes, block: str) -> None:
    """Speed of a block along its guide."""
    pair = pen.first_slide(block)
    first = pen.scene.link(block).points[0]
    start = image_under(pen, pair.links[1], first)
    with pen.on(Part.RESULT, Plane.NUMBERS):
        guide = known_guide(pen, shapes, pair)
        found = pen.draw(part_along, guide, start, pen.the("velocity", first))
    pen.want("slide speed", block, found)
    slide_arrow(pen, pair, block, first)


# --- arrows --------------------------------------------------------------------------------------


def slide_arrow(pen: Pen, pair: Joint, link: str, point: str) -> None:
    """The arrow of a relative velocity along a guide that moves.

    Of one that only shifts, so that no component of an acceleration comes of it, that of the guide
    along the block suffices.
    """
    known, o = partner(pair, link), pen.pole(Plane.VELOCITIES)
    start, tip = image_under(pen, known, point), pen.the("velocity", point)
    told = not pen.turns(known) and tip != o and is_joined(pen, tip, start)
    if start not in (o, tip) and not told:
        arrow_between(pen, start, tip, point, letter(under(point, known)))


def is_joined(pen: Pen, tail: int, tip: int) -> bool:
    """Whether an arrow leads from one image to another, or between others on which they fall."""
    ends = source_of(pen, tail), source_of(pen, tip)
    arrows = (step.args for step in pen.steps if step.arrow and step.action is join)
    return any((source_of(pen, start), source_of(pen, end)) == ends for start, end in arrows)
