"""Guides that move: where a link is turned to, and where a block leads a point.

Axes are unit complex numbers: the direction of a link's x axis, or of a guide, in the plane.
"""

from __future__ import annotations

from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real, at, pick, sqrt
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


@action("guide-back")
def guide_back(first: Point, axis: Point, offset: Real) -> Line:
    """The line of a guide from the block on it: the block stands its offset to the left."""
    return Line(first - 1j * axis * offset, axis)


@action("beside-guide")
def beside_guide(point: Point, through: Point, along: Point) -> Real:
    """How far a point of a link lies to the left of a guide of the link, in the link's axes."""
    return cross(along, point - through) / abs(along)


@action("gap")
def gap(offset: Real, here: Real, there: Real) -> Real:
    """How far to the left of the parallel to the guide through one pin the other pin stands."""
    return offset + here - there


# --- a bar through a swivelling block ------------------------------------------------------------


def swing_margin(pivot: Point, pin: Point, height: Real, way: int, size: float) -> Real:
    """Cosine of the angle between the guide and the line of its two pins.

    Pins much nearer to one another than the mechanism is large (``size``) tell the direction as
    badly as a flat crossing: it is then that of the foot and the size.
    """
    bar = abs(pin - pivot)
    return sqrt((bar - height) * (bar + height)) / pick(bar < size, size, bar)


@action("swing", margin=swing_margin)
def swing(pivot: Point, pin: Point, height: Real, way: int, size: float) -> Point:
    """Direction of a guide that turns about a pivot and keeps a pin at a height to its left.

    The pin lies ahead of the pivot (way +1) or behind it (-1); nearer than the height it raises.
    """
    line = pin - pivot
    bar = abs(line)
    foot = way * sqrt((bar - height) * (bar + height))
    return line / bar * (at(foot, -height) / bar)


def through_margin(pivot: Point, pin: Point, way: int, size: float) -> Real:
    """Distance of the pins over the size of the mechanism, where it is less: else 1."""
    bar = abs(pin - pivot)
    return bar / pick(bar < size, size, bar)


@action("swing-through", margin=through_margin)
def swing_through(pivot: Point, pin: Point, way: int, size: float) -> Point:
    """Direction of a guide whose line passes through both pins: from the pivot to the pin, or back.

    The pin on the pivot raises: any direction would do.
    """
    line = way * (pin - pivot)
    return line / abs(line)


@action("middle")
def middle(p: Point, q: Point) -> Point:
    """The point halfway between two."""
    return (p + q) / 2


@action("half")
def half(p: Point, q: Point) -> Real:
    """Half the distance of two points: the radius of Thales's circle on them."""
    return abs(q - p) / 2


@action("size")
def size(height: Real) -> Real:
    """The height without its sign: the radius of the circle that the guide touches."""
    return abs(height)


@action("from-foot")
def from_foot(foot: Point, pin: Point, way: int) -> Point:
    """Direction of the tangent from its foot to the pin."""
    line = way * (pin - foot)
    return line / abs(line)


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


# --- a driven slide ------------------------------------------------------------------------------


@action("set-at")
def set_at(line: Line, coordinate: Real) -> Point:
    """The point of a guide at a coordinate."""
    return line.point + line.along * (coordinate / abs(line.along))


@action("set-back")
def set_back(line: Line, coordinate: Real, here: Point, through: Point, axis: Point) -> Point:
    """A point of the link that carries a guide, from where its block stands on it."""
    zero = line.point - line.along * (coordinate / abs(line.along))
    return zero + axis * (here - through)


@action("driven-slide")
def driven_slide(start: Point, line: Line, speed: Real, way: int) -> Point:
    """From a point of a plan the given speed, or acceleration, along a guide or back."""
    return start + line.along * (way * speed / abs(line.along))
