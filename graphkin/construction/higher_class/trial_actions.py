"""What the plans of a group of class III or higher draw: the misfit of a trial, and two trials."""

from __future__ import annotations

from typing import Any

from graphkin.construction.core.vocabulary import action
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line, Vector, cross, dot


@action("part", margin=lambda closing, place: closing[-1])
def part(closing: tuple[Any, ...], place: int) -> Any:
    """One of the values that close a group: the tried one, or a dyad's sign."""
    return closing[place]


@action("excess")
def excess(p: Point, q: Point, length: Real) -> Real:
    """By how much two points stand farther apart than a bar is long."""
    return abs(q - p) - length


@action("from-to")
def from_to(p: Point, q: Point) -> Point:
    """The way from one point to another."""
    return q - p


@action("on-line")
def on_line(line: Line, point: Point) -> Point:
    """A point in the axes of a line: how far along it, and how far to its left."""
    return (point - line.point) * line.along.conjugate() / abs(line.along)


@action("beside-line")
def beside_line(line: Line, point: Point) -> Real:
    """How far a point stands to the left of a line."""
    return cross(line.along, point - line.point) / abs(line.along)


@action("less")
def less(a: Real, b: Real) -> Real:
    """What a number has too much."""
    return a - b


@action("sine-between")
def sine_between(axis: Point, other: Point) -> Real:
    """Sine of the angle from one direction to another; nought where they agree or are opposed."""
    return cross(other, axis)


@action("cosine-between")
def cosine_between(axis: Point, other: Point) -> Real:
    """Cosine of the angle between two directions: positive where they agree."""
    return dot(other, axis)


@action("far")
def far(p: Point, *others: Point) -> Real:
    """How far some points lie from a point in the mean."""
    total: Real = 0.0
    for other in others:
        total = total + abs(other - p)
    return total / len(others)


@action("share")
def share(first: Real, second: Real) -> Real:
    """Where between two trials the misfit vanishes: it grows in proportion."""
    return first / (first - second)


@action("share-on-line")
def share_on_line(first: Point, second: Point, found: Point) -> Real:
    """The same share as it is measured on the line of the two trials of a point."""
    way = second - first
    return dot(way, found - first) / dot(way, way)


@action("inverse")
def inverse(seconds: Real) -> Real:
    """The rate of one radian in a time."""
    return 1 / seconds


@action("product")
def product(a: Real, b: Real) -> Real:
    """The product of two numbers."""
    return a * b


@action("reach")
def reach(line: Line, *rest: Any) -> Real:
    """How far from a line's own point the bars of a group allow: ``rest`` are so many lengths,
    then the known points, then how many lengths there are."""
    *values, count = rest
    total: Real = 0.0
    for length in values[:count]:
        total = total + abs(length)
    for place in values[count:]:
        total = total + abs(place - line.point)
    return 1.01 * total


@action("to-corner")
def along_component(start: Point, tip: Point, component: Point) -> Vector:
    """The first leg of a way from one point of a plan to another: a component laid off."""
    return Vector(start, start + component)


@action("from-corner")
def after_component(start: Point, tip: Point, component: Point) -> Vector:
    """The last leg of a way between two points of a plan, from the end of a component laid off."""
    return Vector(start + component, tip)


@action("to-corner")
def along_way(start: Point, tip: Point, foot: Point, corner: Point) -> Vector:
    """The first leg of such a way: as long as the one from a foot to a corner elsewhere."""
    return Vector(start, start + (corner - foot))


@action("from-corner")
def after_way(start: Point, tip: Point, foot: Point, corner: Point) -> Vector:
    """The last leg of such a way."""
    return Vector(start + (corner - foot), tip)


@action("to-corner")
def before_component(start: Point, tip: Point, component: Point) -> Vector:
    """The first leg of a way whose last one is a component, laid off backwards from its tip."""
    return Vector(start, tip - component)


@action("from-corner")
def last_component(start: Point, tip: Point, component: Point) -> Vector:
    """A component as the last leg of a way between two points of a plan."""
    return Vector(tip - component, tip)
