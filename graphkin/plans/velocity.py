"""The velocity plan: perpendiculars and parallels through known images, and their crossings."""

from __future__ import annotations

from graphkin.plans.links import Base, crank_tip
from graphkin.plans.pen import Pen, Says, image
from graphkin.plans.position import crosses_well
from graphkin.plans.shape import Shapes
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    alike,
    join,
    meet,
    omega,
    parallel_to,
    part_along,
    set_on,
    similar_point,
    square_to,
    turned_velocity,
)
from graphkin.structure.graph import Pin, Sliding
from graphkin.structure.groups import Crank, Dyad


def frame(pen: Pen) -> None:
    """All fixed points have their image in the pole o."""
    for point in pen.scene.frame.points:
        pen.want("velocity", point, pen.pole(Plane.VELOCITIES))


def crank(pen: Pen, group: Crank) -> None:
    """Image of a driven tip: omega times the bar, square to it, in the sense of omega."""
    pivot, tip = group.pivot, crank_tip(pen.scene, group)
    speed = pen.given("number", group.driver.speed, name="omega")
    pen.want("omega", group.link, speed)
    ends = pen.the("position", pivot), pen.the("position", tip)
    start = pen.the("velocity", pivot)
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        found = pen.draw(
            turned_velocity,
            start,
            *ends,
            speed,
            name=image(tip),
            p=pivot,
            q=tip,
            s=named(pen, start),
        )
    pen.want("velocity", tip, found)
    arrow_to(pen, tip, pivot)


def dyad(pen: Pen, group: Dyad) -> None:
    """Image of an inner pin: each relative velocity is square to its bar, or along the guide."""
    assert isinstance(group.left, Pin) and isinstance(group.inner, Pin)
    left, pin = group.left.point, group.inner.point
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        near = square(pen, left, pin)
        if isinstance(group.right, Pin):
            far = square(pen, group.right.point, pin)
        else:
            far = along_guide(pen, group.right, Plane.VELOCITIES)
        found = pen.draw(meet, near, far, name=image(pin))
    pen.want("velocity", pin, found)
    arrow_to(pen, pin, left)
    if isinstance(group.right, Pin):
        arrow_to(pen, pin, group.right.point)
    else:
        arrow_to(pen, pin, None)


def square(pen: Pen, pivot: str, pin: str) -> int:
    """Through the image of one end of a bar the perpendicular to the bar."""
    start = pen.the("velocity", pivot)
    ends = pen.the("position", pivot), pen.the("position", pin)
    return pen.draw(square_to, start, *ends, s=named(pen, start), p=pivot, q=pin)


def along_guide(pen: Pen, pair: Sliding, plane: Plane) -> int:
    """Through the pole of a plan the parallel to a guide of the frame."""
    start = pen.pole(plane)
    return pen.draw(parallel_to, start, pen.guides[pair.block], s=named(pen, start), g=pair.block)


def sliding(pen: Pen, base: Base) -> None:
    """Speed and acceleration of a block along its guide; on the frame nothing turns it."""
    if base.end is not None:
        return
    guide = pen.guides[base.link]
    for quantity in ("omega", "epsilon"):
        pen.want(quantity, base.link, pen.given("nought"))
    for quantity, result, plane in (
        ("velocity", "slide speed", Plane.VELOCITIES),
        ("acceleration", "slide acceleration", Plane.ACCELERATIONS),
    ):
        o = pen.pole(plane)
        with pen.on(Part.RESULT, Plane.NUMBERS):
            pen.want(
                result, base.link, pen.draw(part_along, guide, o, pen.the(quantity, base.start))
            )


def plate_points(pen: Pen, shapes: Shapes, base: Base) -> None:
    """Images of the other points of a link: the triangle abc is similar to ABC, turned 90°."""
    if base.end is None:
        block_points(pen, base)
        return
    ends = pen.the("velocity", base.start), pen.the("velocity", base.end)
    for point in base.others:
        if pen.has("velocity", point):
            continue
        ratio = shapes.ratio(base.link, base.start, base.end, point)
        by_hand = None
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            if crosses_well(pen, shapes, base, point):
                with pen.hands_way():
                    lines = square(pen, base.start, point), square(pen, base.end, point)
                    by_hand = pen.draw(meet, *lines)
            says: Says = {"p": base.start, "q": base.end, "r": point}
            found = pen.draw(
                similar_point, *ends, ratio, name=image(point), by_hand=by_hand, **says
            )
        pen.want("velocity", point, found)
        arrow_to(pen, point, base.start)
        arrow_to(pen, point, base.end)


def block_points(pen: Pen, base: Base) -> None:
    """All points of a block on a fixed guide have one image."""
    for point in base.others:
        if not pen.has("velocity", point):
            start = pen.the("velocity", base.start)
            with pen.on(Part.VELOCITY, Plane.VELOCITIES):
                found = pen.draw(alike, start, name=image(point), p=base.start, q=point)
            pen.want("velocity", point, found)
            arrow_to(pen, point, None)


def turning(pen: Pen, base: Base) -> None:
    """Angular velocity of a link: relative velocity over length, with its sense."""
    if base.end is None or pen.has("omega", base.link):
        return
    ends = [
        pen.the(what, point)
        for what in ("position", "velocity")
        for point in (base.start, base.end)
    ]
    with pen.on(Part.RESULT, Plane.NUMBERS):
        found = pen.draw(omega, *ends, name=base.link, p=base.start, q=base.end)
    pen.want("omega", base.link, found)


def arrow_to(pen: Pen, pin: str, pivot: str | None) -> None:
    """The arrows of a plan to an image: the absolute velocity, and the one relative to a pivot."""
    o = pen.pole(Plane.VELOCITIES)
    tip = pen.the("velocity", pin)
    starts = {o: (f"v_{pin}", "")}
    if pivot is not None and pen.the("velocity", pivot) != o:
        starts[pen.the("velocity", pivot)] = (f"v_{pin}{pivot}", pivot)
    with pen.on(Part.VELOCITY, Plane.VELOCITIES):
        for start, (symbol, about) in starts.items():
            name = named(pen, start) + image(pin)
            if not any(step.arrow and step.name == name for step in pen.steps):
                pen.arrow(join, start, tip, name=name, symbol=symbol, q=pin, p=about)


def set_on_mechanism(pen: Pen, point: str) -> None:
    """The absolute velocity of a point, set on the mechanism."""
    o = pen.pole(Plane.VELOCITIES)
    ends = pen.the("position", point), o, pen.the("velocity", point)
    with pen.on(Part.VELOCITY, Plane.MECHANISM):
        seconds = pen.seconds()
        pen.arrow(set_on, *ends, seconds, name=f"v_{point}", symbol=f"v_{point}")


def named(pen: Pen, number: int) -> str:
    """Name of the point of a plan that a step carries."""
    return pen.steps[number].name
