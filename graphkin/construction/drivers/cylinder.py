"""A driven cylinder as the bar of a dyad: as long as its driver says, its end slides at a rate."""

from __future__ import annotations

from graphkin.construction.acceleration import acceleration
from graphkin.construction.core.arrows import slide_arrow, velocity_arrows
from graphkin.construction.core.bases import under
from graphkin.construction.core.pen import Pen, image, letter, second_image
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.drivers.driven_slide import slide_image
from graphkin.construction.guides.guide_actions import (
    axis_by_guide,
    axis_stretched,
    length_of,
    stretch,
)
from graphkin.construction.guides.guide_line import guide_at
from graphkin.construction.guides.guides import local_line
from graphkin.construction.guides.sliding import component_between
from graphkin.construction.links import position
from graphkin.construction.links.compass_arc import draw_arc
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.velocity import velocity
from graphkin.structure.groups import Stretched
from graphkin.structure.pairs import Pin


def place(pen: Pen, shapes: LinkShapes, group: Stretched) -> None:
    """The far pin of the cylinder on an arc as long as it is, then the line of its guide."""
    assert isinstance(group.dyad.inner, Pin)
    near, far = group.pin.point, group.dyad.inner.point
    block, carrier = group.slide.links
    pins = {group.near: near, group.dyad.links[0]: far}
    way = way_between_pins(pen, shapes, group, pins)
    start = pen.the("position", near)
    pen.want("position", under(near, group.dyad.links[0]), start)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            length = pen.draw(length_of, way)
        arc = draw_arc(pen, (near, far), start, length)
    position.dyad_on(pen, shapes, group.dyad, arc)
    places = [pen.the("position", pins[link]) for link in (carrier, block)]
    ends = local_line(pen, shapes, group.slide.slide, carrier)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        turn = pen.draw(axis_stretched, *places, way)
        pen.want("axis", block, turn)
        pen.want("axis", carrier, pen.draw(axis_by_guide, turn, *ends))
    with pen.on(Part.POSITION, Plane.MECHANISM):
        line = guide_at(pen, block, (start, near), turn)
    pen.shared["guide", *group.slide.links] = line


def way_between_pins(pen: Pen, shapes: LinkShapes, group: Stretched, pins: dict[str, str]) -> int:
    """The way from the pin of the link with the guide to that of the block, along the guide."""
    block, carrier = group.slide.links
    first = pen.scene.link(block).points[0]
    here = shapes.local(block, pins[block]), shapes.local(block, first)
    end = shapes.local(carrier, pins[carrier])
    ends = local_line(pen, shapes, group.slide.slide, carrier)
    where = pen.drive(group.driver).position
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        offset = pen.given("length", group.slide.slide.offset)
        return pen.draw(stretch, *here, offset, end, *ends, where)


def move(pen: Pen, shapes: LinkShapes, group: Stretched) -> None:
    """Image of the far link's point under the near pin: the given speed along the guide."""
    foot, way = foot_of(group)
    point = group.pin.point
    start, line = pen.the("velocity", point), pen.shared["guide", *group.slide.links]
    speed = pen.drive(group.driver).speed
    steps, block = (start, line, speed), group.slide.block
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        found = slide_image(pen, letter(foot), block, steps, name=image(foot), way=way)
    pen.want("velocity", foot, found)
    velocity_arrows(pen, foot, point)
    velocity.dyad(pen, shapes, group.dyad)


def accelerate(pen: Pen, shapes: LinkShapes, group: Stretched) -> None:
    """Second image of that point: the given acceleration along the guide that turns."""
    foot, way = foot_of(group)
    point, far = group.pin.point, group.dyad.links[0]
    start, line = pen.the("acceleration", point), pen.shared["guide", *group.slide.links]
    rate = pen.drive(group.driver).acceleration
    images = pen.the("velocity", point), pen.the("velocity", foot)
    corner = component_between(pen, far, images, point, group.slide.block)
    steps, block = (corner, line, rate), group.slide.block
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        name = second_image(foot)
        with pen.calls_for(acceleration.sliding_effect(pen, rate)):
            found = slide_image(
                pen, letter(foot), block, steps, name=name, way=way, told_from=start
            )
        slide_arrow(pen, corner, found, far, point)
    pen.want("acceleration", foot, found)
    acceleration.dyad(pen, shapes, group.dyad)


def foot_of(group: Stretched) -> tuple[str, int]:
    """The far link's point under the near pin, and the sense in which the driver moves it."""
    far = group.dyad.links[0]
    return under(group.pin.point, far), 1 if far == group.slide.block else -1
