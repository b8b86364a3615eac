"""Points and lines of the plane as complex numbers, and primitives with bounded errors.

Each primitive keeps its coordinates local to the figure and its error within the bound in its
docstring (eps = 2^-52, s = sine of the angle of crossing, L = the largest length involved).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from graphkin.numbers.arithmetic import Point, Real, at, either, is_disc, pick, sqrt


class Line(NamedTuple):
    """The straight line through ``point`` along ``along`` (any length but zero)."""

    point: Point
    along: Point


class Circle(NamedTuple):
    """The circle, or the compass setting, of a centre and a radius."""

    centre: Point
    radius: Real


class Vector(NamedTuple):
    """A drawn arrow from its tail to its tip."""

    tail: Point
    tip: Point


class Ratio(NamedTuple):
    """The point ``start + shift / size``.

    Its parts are kept separate because ``size`` may vanish: the point is then far away in the
    direction of ``shift``.
    """

    start: Point
    shift: Point
    size: Point


def by_parts(work: Callable[..., Any], *values: Any) -> Any:
    """A value of the first one's type, a line or another tuple, computed part by part."""
    parts = [work(*each) for each in zip(*values, strict=True)]
    return type(values[0])(*parts) if hasattr(values[0], "_fields") else tuple(parts)


def cross(u: Point, v: Point) -> Real:
    """Signed area of the parallelogram of two vectors, positive for v to the left of u."""
    return u.real * v.imag - u.imag * v.real


def dot(u: Point, v: Point) -> Real:
    """Scalar product of two vectors."""
    return u.real * v.real + u.imag * v.imag


def line_meets_line(m: Line, n: Line) -> Point:
    """Intersection of two lines, measured from the nearer anchor.

    Error at most 4·eps·(L/s + abs X). Parallel lines raise ZeroDivisionError on a scalar.
    """
    gap = n.point - m.point
    area = cross(m.along, n.along)
    on_m = cross(gap, n.along) / area * m.along
    on_n = cross(gap, m.along) / area * n.along
    nearer = abs(on_m) <= abs(on_n)
    return either(nearer, m.point + on_m, n.point + on_n)


def crossing_sine(m: Line, n: Line) -> Real:
    """Sine of the angle at which two lines cross; 0 when they are parallel."""
    return abs(cross(m.along, n.along)) / (abs(m.along) * abs(n.along))


def in_order(a: Real, b: Real) -> tuple[Real, Real]:
    """Two numbers, the smaller first; discs as they come, for only rounding asks their order."""
    if not isinstance(a, float) and (is_disc(a) or is_disc(b)):
        return a, b
    return pick(a <= b, a, b), pick(a <= b, b, a)


def no_larger(a: Real, b: Real) -> Any:
    """Whether a number is not larger; true of discs that leave it open: any answer is right."""
    found = a <= b
    if isinstance(found, bool):
        return found
    return found >= 0.5 if is_disc(a) or is_disc(b) else found


def triangle_area(a: Real, b: Real, c: Real) -> Real:
    """Area of the triangle with three given sides.

    Kahan, "Miscalculating Area and Angles of a Needle-like Triangle" (2014). An impossible triangle
    raises ValueError on a scalar.
    """
    b, a = in_order(a, b)
    c, largest = in_order(a, c)
    low, middle = in_order(b, c)
    gap = largest - middle
    return 0.25 * sqrt(
        (largest + (middle + low)) * (low - gap) * (low + gap) * (largest + (middle - low))
    )


def circle_meets_circle(m: Circle, n: Circle, side: int) -> Point:
    """Intersection of two circles, left (side +1) or right (-1) of the line from m to n.

    Error at most 4·eps·((r1 + r2 + d)/s + abs X). Circles that do not meet raise ValueError.
    """
    axis = n.centre - m.centre
    distance = abs(axis)
    unit = axis / distance
    height = 2 * triangle_area(m.radius, n.radius, distance) / distance
    difference = (m.radius - n.radius) * (m.radius + n.radius) / distance
    smaller = no_larger(m.radius, n.radius)
    centre = pick(smaller, m.centre, n.centre)
    along = pick(smaller, distance + difference, difference - distance) / 2
    return centre + at(along, side * height) * unit


def circles_sine(m: Circle, n: Circle) -> Real:
    """Sine of the angle at which two circles cross; 0 when they touch."""
    distance = abs(n.centre - m.centre)
    return 2 * triangle_area(m.radius, n.radius, distance) / (m.radius * n.radius)


def line_meets_circle(line: Line, circle: Circle, way: int) -> Point:
    """Intersection of a line and a circle, the farther along the line (way +1) or the nearer (-1).

    Error at most 8·eps·((r + PC)/s + abs X). A line that misses the circle raises ValueError.
    """
    unit = line.along / abs(line.along)
    offset = (circle.centre - line.point) * unit.conjugate()
    half = sqrt((circle.radius - offset.imag) * (circle.radius + offset.imag))
    return line.point + (offset.real + way * half) * unit


def line_circle_sine(line: Line, circle: Circle) -> Real:
    """Sine of the angle at which a line cuts a circle; 0 when it touches."""
    unit = line.along / abs(line.along)
    height = ((circle.centre - line.point) * unit.conjugate()).imag
    return sqrt((circle.radius - height) * (circle.radius + height)) / circle.radius
