"""A driven cylinder as a bar of a dyad: the driver gives its length and its rate of change."""

from __future__ import annotations

from graphkin.construction.core.pen import (
    Pen,
    image,
    letter,
    second_image,
    slide_arrow,
    velocity_arrows,
)
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.drivers.driven_slide import slide_image
from graphkin.construction.group_images import GroupImages, end_on_driven, sliding_effect
from graphkin.construction.guides.guides import (
    axis_by_guide,
    axis_stretched,
    guide_at,
    known_guide,
    length_of,
    local_line,
    stretch,
)
from graphkin.construction.links import position
from graphkin.construction.links.dyad_by_arcs import draw_arc
from graphkin.construction.links.link_shapes import local_place
from graphkin.construction.plan import ACCELERATION, VELOCITY
from graphkin.structure.groups import Cylinder, Stretched
from graphkin.structure.pairs import Pin


def place(pen: Pen, group: Stretched) -> None:
    """Place the far pin on the arc of each cylinder's length, then the lines of the guides."""
    ways = [way_between_pins(pen, each, inner_pin(group)) for each in group.cylinders]
    arcs = [
        arc_of_cylinder(pen, each, inner_pin(group), way)
        for each, way in zip(group.cylinders, ways, strict=True)
    ]
    if len(arcs) == 2:
        position.two_arcs(pen, group.dyad, *arcs)
    else:
        position.dyad_on(pen, group.dyad, *arcs)
    for each, way in zip(group.cylinders, ways, strict=True):
        turn_to_pins(pen, each, inner_pin(group), way)


def inner_pin(group: Stretched) -> str:
    """The pin that joins the two bars of the dyad."""
    assert isinstance(group.dyad.inner, Pin)
    return group.dyad.inner.point


def arc_of_cylinder(pen: Pen, cylinder: Cylinder, far: str, way: int) -> int:
    """The arc about the known pin, with the distance between the pins as its radius."""
    near = cylinder.pin.point
    start = place_foot(pen, cylinder)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            length = pen.draw(length_of, way)
        return draw_arc(pen, (near, far), start, length)


def place_foot(pen: Pen, cylinder: Cylinder) -> int:
    """The far link's point that coincides with the known pin."""
    foot = cylinder.foot.point
    if not pen.has("position", foot):
        pen.want("position", foot, pen.the("position", cylinder.pin.point))
    return pen.the("position", foot)


def turn_to_pins(pen: Pen, cylinder: Cylinder, far: str, way: int) -> None:
    """Turn both links of a cylinder to the line of its pins, and draw the line of its guide."""
    near, (block, carrier) = cylinder.pin.point, cylinder.slide.links
    pins = {cylinder.near: near, cylinder.far: far}
    places = [pen.the("position", pins[link]) for link in (carrier, block)]
    _, along = local_line(pen, cylinder.slide.slide, carrier)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        turn = pen.draw(axis_stretched, *places, way)
        pen.want("axis", block, turn)
        pen.want("axis", carrier, pen.draw(axis_by_guide, turn, pen.given("origin"), along))
    with pen.on(Part.POSITION, Plane.MECHANISM):
        line = guide_at(pen, block, (pen.the("position", near), near), turn)
    pen.shared["guide", *cylinder.slide.links] = line
    pen.shared["through pin", *cylinder.slide.links] = line


def way_between_pins(pen: Pen, cylinder: Cylinder, far: str) -> int:
    """The vector from the pin of the link with the guide to the block's pin, along the guide."""
    block, carrier = cylinder.slide.links
    pins = {cylinder.near: cylinder.pin.point, cylinder.far: far}
    first = pen.scene.link(block).points[0]
    here = local_place(pen, block, pins[block]), local_place(pen, block, first)
    end = local_place(pen, carrier, pins[carrier])
    guide = local_line(pen, cylinder.slide.slide, carrier)
    where = pen.drive(cylinder.driver).position
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        offset = pen.given("length", cylinder.slide.slide.offset)
        return pen.draw(stretch, *here, offset, end, *guide, where)


def move(images: GroupImages, pen: Pen, group: Stretched) -> None:
    """Draw a plan: the given motion of each cylinder along its guide, then the dyad."""
    move_one = move_foot if images.plan is VELOCITY else accelerate_foot
    for each in group.cylinders:
        move_one(pen, each)
    images.dyad(pen, group.dyad)


def move_foot(pen: Pen, cylinder: Cylinder) -> None:
    """Draw the image of the far link's point under the near pin, by the given speed."""
    point, foot, block = cylinder.pin.point, cylinder.foot.point, cylinder.slide.block
    start, line = pen.the("velocity", point), known_guide(pen, cylinder.slide)
    steps = start, line, pen.drive(cylinder.driver).speed
    place_foot(pen, cylinder)
    with VELOCITY.drawn(pen):
        name, way = image(foot), sense_of(cylinder)
        found = slide_image(pen, letter(foot), block, steps, name=name, way=way)
    pen.want("velocity", foot, found)
    velocity_arrows(pen, foot, point)


def accelerate_foot(pen: Pen, cylinder: Cylinder) -> None:
    """Draw the second image of that point, by the given acceleration along the turning guide."""
    point, foot, block = cylinder.pin.point, cylinder.foot.point, cylinder.slide.block
    line = known_guide(pen, cylinder.slide)
    rate = pen.drive(cylinder.driver).acceleration
    images = pen.the("velocity", point), pen.the("velocity", foot)
    index = letter(foot) + letter(point)
    corner = end_on_driven(pen, cylinder.far, images, point, block, index)
    with ACCELERATION.drawn(pen):
        steps = corner, line, rate
        name, way = second_image(foot), sense_of(cylinder)
        with pen.calls_for(sliding_effect(pen, rate)):
            found = slide_image(pen, letter(foot), block, steps, name=name, way=way)
        slide_arrow(pen, corner, found, cylinder.far, point, index=index)
    pen.want("acceleration", foot, found)


def sense_of(cylinder: Cylinder) -> int:
    """The sense in which the driver moves the far link: +1 along the guide, -1 against it."""
    return 1 if cylinder.far == cylinder.slide.block else -1
