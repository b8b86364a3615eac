"""The mechanism to scale, by compass and ruler: cranks by their angle, dyads by two arcs."""

from __future__ import annotations

from graphkin.plane import Line, crossing_sine
from graphkin.plans.links import Base, crank_tip, side_of, way_of
from graphkin.plans.pen import Pen, Says
from graphkin.plans.shape import Shapes, place
from graphkin.scene.model import Apart, Link, Slide
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    across,
    along_bar,
    arc_cuts_line,
    arcs_meet,
    arm,
    arm_by_axis,
    beside,
    compass,
    coordinate,
    mark_off,
    ray,
    shifted,
    similar_point,
    step_along,
)
from graphkin.structure.graph import Pin, Sliding
from graphkin.structure.groups import Crank, Dyad

CLEAR_CROSSING = 0.342
"""Sine of 20 degrees: below it a plate point is found by similarity, not by two flat lines."""


IN_LINE = 1e-9
"""How far beside its line, in parts of its distance, a plate point still counts as on it."""


def frame(pen: Pen) -> None:
    """Mark the fixed points."""
    placed: dict[str, int] = {}
    with pen.on(Part.POSITION, Plane.MECHANISM):
        for placing in pen.scene.frame.placings:
            placed[placing.point] = place(pen, placing, placed, name=placing.point)
            pen.want("position", placing.point, placed[placing.point])


def crank(pen: Pen, shapes: Shapes, group: Crank) -> None:
    """The tip of a driven bar: the line at the driver's angle, and the bar laid off on it."""
    pivot, tip = group.pivot, crank_tip(pen.scene, group)
    line = group.driver.of or axis_line(pen.scene.link(group.link))
    turn = pen.given("direction", group.driver.position, name="phi")
    start = pen.the("position", pivot)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        if line == (pivot, tip):
            way = pen.draw(ray, start, turn, p=pivot, k=group.link)
            length = shapes.length(group.link, pivot, tip)
            found = pen.draw(mark_off, way, length, name=tip, p=pivot, q=tip)
        else:
            locals_ = [shapes.local(group.link, point) for point in (*line, pivot, tip)]
            turned = arm if line else arm_by_axis
            says: Says = {"p": pivot, "q": tip, "k": group.link}
            found = pen.draw(turned, start, turn, *locals_, name=tip, **says)
    pen.want("position", tip, found)


def axis_line(link: Link) -> tuple[str, ...]:
    """The two points along the x axis of a link given by lengths; none when it has its own axes."""
    return link.points[:2] if any(isinstance(each, Apart) for each in link.placings) else ()


def dyad(pen: Pen, shapes: Shapes, group: Dyad) -> None:
    """The inner pin of a dyad: two arcs, or an arc and the line that the guide keeps it on."""
    assert isinstance(group.left, Pin) and isinstance(group.inner, Pin)
    left, pin = group.left.point, group.inner.point
    with pen.on(Part.POSITION, Plane.MECHANISM):
        near = arc(pen, shapes, group.links[0], left, pin)
        if isinstance(group.right, Pin):
            right = group.right.point
            far = arc(pen, shapes, group.links[1], right, pin)
            side = side_of(pen.scene, group)
            found = pen.draw(arcs_meet, near, far, name=pin, extra=(side,), p=left, q=right)
        else:
            way = way_of(pen.scene, group)
            path = guide_of(pen, shapes, group.right, pin)
            found = pen.draw(arc_cuts_line, path, near, name=pin, extra=(way,), p=left)
    pen.want("position", pin, found)


def arc(pen: Pen, shapes: Shapes, link: str, centre: str, point: str) -> int:
    """The arc on which a point of a bar lies about its other end."""
    length = shapes.length(link, centre, point)
    return pen.draw(compass, pen.the("position", centre), length, p=centre, q=point)


def guide_of(pen: Pen, shapes: Shapes, pair: Sliding, pin: str) -> int:
    """The line that a guide of the frame keeps a point of its block on."""
    block = pen.scene.link(pair.block)
    line = guide_line(pen, pair.slide, block.name)
    if pair.slide.offset.number(pen.scene.values) != 0:
        line = pen.draw(shifted, line, pen.given("length", pair.slide.offset), p=block.name)
    if pin != block.points[0]:
        ends = shapes.local(block.name, block.points[0]), shapes.local(block.name, pin)
        line = pen.draw(shifted, line, pen.draw(across, *ends), p=block.name)
    pen.guides[block.name] = line
    return line


def guide_line(pen: Pen, slide: Slide, block: str) -> int:
    """The guide itself, through a point at an angle or along two points of the frame."""
    if slide.along is not None:
        start, end = (pen.the("position", point) for point in slide.along)
        return pen.draw(along_bar, start, start, end, p=slide.along[0], g=block)
    if isinstance(slide.through, str):
        start, through = pen.the("position", slide.through), slide.through
    else:
        assert slide.through is not None
        start, through = pen.given("point", *slide.through), ""
    return pen.draw(ray, start, pen.given("direction", slide.angle), p=through, g=block)


def plate_points(pen: Pen, shapes: Shapes, base: Base) -> None:
    """The other points of a link: by hand two arcs, in value the figure similar to the link."""
    if base.end is None:
        block_points(pen, shapes, base)
        return
    ends = pen.the("position", base.start), pen.the("position", base.end)
    for point in base.others:
        if pen.has("position", point):
            continue
        ratio = shapes.ratio(base.link, base.start, base.end, point)
        by_hand = hands_way(pen, shapes, base, point)
        with pen.on(Part.POSITION, Plane.MECHANISM):
            says: Says = {"p": base.start, "q": base.end, "r": point}
            found = pen.draw(similar_point, *ends, ratio, name=point, by_hand=by_hand, **says)
        pen.want("position", point, found)


def block_points(pen: Pen, shapes: Shapes, base: Base) -> None:
    """The other points of a block, and the coordinate of its first along the guide."""
    line, start = pen.guides[base.link], pen.the("position", base.start)
    for point in base.others:
        ends = shapes.local(base.link, base.start), shapes.local(base.link, point)
        with pen.on(Part.POSITION, Plane.MECHANISM):
            says: Says = {"p": base.start, "g": base.link}
            found = pen.draw(beside, line, start, *ends, name=point, **says)
        pen.want("position", point, found)
    first = pen.the("position", pen.scene.link(base.link).points[0])
    with pen.on(Part.RESULT, Plane.NUMBERS):
        pen.want("slide", base.link, pen.draw(coordinate, line, first))


def hands_way(pen: Pen, shapes: Shapes, base: Base, point: str) -> int | None:
    """An arc about each end of the base; on its own line the distance is laid off."""
    assert base.end is not None
    ratio = pen.peek(shapes.ratio(base.link, base.start, base.end, point))
    if ratio is None or ratio == 0:
        return None
    if abs(ratio.imag) > IN_LINE * abs(ratio):
        return two_arcs(pen, shapes, base, point)
    start, end = pen.the("position", base.start), pen.the("position", base.end)
    length = shapes.length(base.link, base.start, point)
    sense = 1 if ratio.real > 0 else -1
    with pen.on(Part.POSITION, Plane.MECHANISM), pen.hands_way():
        says: Says = {"p": base.start, "q": base.end, "r": point}
        return pen.draw(step_along, start, start, end, length, extra=(sense,), **says)


def two_arcs(pen: Pen, shapes: Shapes, base: Base, point: str) -> int:
    """The hand's way to a plate point: an arc about each end of the base."""
    assert base.end is not None
    side = 1 if pen.peek(shapes.ratio(base.link, base.start, base.end, point)).imag > 0 else -1
    with pen.on(Part.POSITION, Plane.MECHANISM), pen.hands_way():
        near = arc(pen, shapes, base.link, base.start, point)
        far = arc(pen, shapes, base.link, base.end, point)
        return pen.draw(arcs_meet, near, far, extra=(side,), p=base.start, q=base.end)


def crosses_well(pen: Pen, shapes: Shapes, base: Base, point: str) -> bool:
    """True when the two bars to a plate point cross at an angle that a hand can draw."""
    assert base.end is not None
    ratio = pen.peek(shapes.ratio(base.link, base.start, base.end, point))
    if ratio in (None, 0, 1):
        return False
    return bool(crossing_sine(Line(0j, ratio), Line(1 + 0j, ratio - 1)) >= CLEAR_CROSSING)
