"""The other points of a link once its base stands: by two arcs, in line, or by its axis."""

from __future__ import annotations

from graphkin.construction.core.bases import Base
from graphkin.construction.core.pen import Pen, Says
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import (
    arcs_meet,
    compass,
    mark_off,
    similar_point,
    step_along,
)
from graphkin.construction.guides.guides import axis
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.links.placed_point import place_point
from graphkin.numbers.plane import Line, crossing_sine

CLEAR_CROSSING = 0.342
"""Sine of 20 degrees: below it a plate point is found by similarity, not by two flat lines."""
IN_LINE = 1e-9
"""How far beside its line, in parts of its distance, a plate point still counts as on it."""


def arc(pen: Pen, shapes: LinkShapes, link: str, centre: str, point: str) -> int:
    """The arc on which a point of a bar lies about its other end."""
    length = shapes.length(link, centre, point)
    return pen.draw(compass, pen.the("position", centre), length, p=centre, q=point)


def plate_points(pen: Pen, shapes: LinkShapes, base: Base) -> None:
    """The other points of a link: by hand two arcs, in value the figure similar to the link."""
    for point in base.others:
        if pen.has("position", point):
            continue
        if base.end is None or "@" in base.end:
            found = set_by_axis(pen, shapes, base, point)
        else:
            ends = pen.the("position", base.start), pen.the("position", base.end)
            ratio = shapes.ratio(base.link, base.start, base.end, point)
            by_hand = hands_way(pen, shapes, base, point)
            with pen.on(Part.POSITION, Plane.MECHANISM):
                says: Says = {"p": base.start, "q": base.end, "r": point}
                found = pen.draw(similar_point, *ends, ratio, name=point, by_hand=by_hand, **says)
        pen.want("position", point, found)


def set_by_axis(pen: Pen, shapes: LinkShapes, base: Base, point: str) -> int:
    """A point of a link that is turned to its axis already; on its own guide it is laid off."""
    line = pen.shared.get(("swing", base.link))
    with pen.on(Part.POSITION, Plane.MECHANISM):
        if line is not None and runs_along(pen, base, point):
            length = shapes.length(base.link, base.start, point)
            return pen.draw(mark_off, line, length, name=point, p=base.start, q=point)
        here = (pen.the("position", base.start), axis(pen, shapes, base.link))
        ends = shapes.local(base.link, base.start), shapes.local(base.link, point)
        return place_point(pen, base.link, (base.start, point), *here, *ends)


def runs_along(pen: Pen, base: Base, point: str) -> bool:
    """Whether a guide is written along the way from a link's pivot to one of its points."""
    for link in pen.scene.links.values():
        for slide in link.slides:
            if slide.on == base.link and slide.along == (base.start, point):
                return True
    return False


def hands_way(pen: Pen, shapes: LinkShapes, base: Base, point: str) -> int | None:
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


def two_arcs(pen: Pen, shapes: LinkShapes, base: Base, point: str) -> int:
    """The hand's way to a plate point: an arc about each end of the base."""
    assert base.end is not None
    side = 1 if pen.peek(shapes.ratio(base.link, base.start, base.end, point)).imag > 0 else -1
    with pen.on(Part.POSITION, Plane.MECHANISM), pen.hands_way():
        near = arc(pen, shapes, base.link, base.start, point)
        far = arc(pen, shapes, base.link, base.end, point)
        return pen.draw(arcs_meet, near, far, extra=(side,), p=base.start, q=base.end)


def crosses_well(pen: Pen, ratio: int) -> bool:
    """True when the two bars to a plate point cross at an angle that a hand can draw."""
    value = pen.peek(ratio)
    if value in (None, 0, 1):
        return False
    return bool(crossing_sine(Line(0j, value), Line(1 + 0j, value - 1)) >= CLEAR_CROSSING)
