"""Guides that move: where a link is turned to, and where a block leads a point.

Axes are unit complex numbers: the direction of a link's x axis, or of a guide, in the plane.
"""

from __future__ import annotations

from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, cross

# --- the turning of a link -----------------------------------------------------------------------


@action("axis")
def axis_of(p: Point, q: Point, here: Point, there: Point) -> Point:
    """Direction of a link's x axis from two of its points, in the plane and in its own axes."""
    turn = (q - p) / (there - here)
    return turn / abs(turn)


@action("axis")
def turned(axis: Point, direction: Point) -> Point:
    """A direction of a link's own axes, in the plane."""
    return axis * direction


@action("axis")
def turned_back(axis: Point, direction: Point) -> Point:
    """The axis of the link in which a direction of the plane lies as given."""
    return axis * direction.conjugate()


@action("axis")
def axis_along(line: Line) -> Point:
    """The direction of a guide as a unit vector: the x axis of a block on it."""
    return line.along / abs(line.along)


@action("axis")
def axis_by_guide(axis: Point, here: Point, there: Point) -> Point:
    """The x axis of a link of which a line, given in its own axes, lies along a known axis."""
    line = there - here
    return axis * (line.conjugate() / abs(line))


@action("axis")
def axis_with_guide(axis: Point, here: Point, there: Point) -> Point:
    """The x axis of a block from that of the link that carries its guide."""
    line = there - here
    return axis * (line / abs(line))


@action("way")
def way_between(here: Point, there: Point) -> Point:
    """The way from one point to another."""
    return there - here


@action("beside")
def placed(start: Point, axis: Point, here: Point, there: Point) -> Point:
    """A point of a link that stands at one of its points and is turned to its axis."""
    return start + axis * (there - here)


@action("beside-guide")
def beside_guide(point: Point, through: Point, along: Point) -> Real:
    """How far a point of a link lies to the left of a guide of the link, in the link's axes."""
    return cross(along, point - through) / abs(along)


@action("gap")
def gap(offset: Real, here: Real, there: Real) -> Real:
    """How far to the left of the parallel to the guide through one pin the other pin stands."""
    return offset + here - there


@action("stretch")
def stretch(
    pin: Point, first: Point, offset: Real, end: Point, here: Point, there: Point, where: Real
) -> Point:
    """From a pin of the link with the guide to one of the block, in the axes of the guide.

    ``pin`` and ``first`` are the block's, ``end`` is the other link's, whose guide runs from
    ``here`` towards ``there``; ``where`` is the block's coordinate.
    """
    along = there - here
    return at(where, offset) + (pin - first) - (end - here) * (along.conjugate() / abs(along))


@action("length")
def length_of(way: Point) -> Real:
    """The length of a way."""
    return abs(way)


@action("axis")
def axis_stretched(from_pin: Point, to_pin: Point, way: Point) -> Point:
    """Direction of a guide from two pins and the way between them in the guide's axes."""
    turn = (to_pin - from_pin) / way
    return turn / abs(turn)
