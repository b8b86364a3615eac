"""Lines, circles and where they meet; points are complex numbers, in mm, *y* upwards."""

from __future__ import annotations

import math
from dataclasses import dataclass

APART = 1e-6
"""How far apart, in mm, two points stand through which a line can be drawn."""


class DefectError(Exception):
    """What cannot be drawn with what is printed."""


@dataclass(frozen=True)
class Line:
    """A line through a point along a unit vector."""

    point: complex
    along: complex

    @classmethod
    def of(cls, point: complex, along: complex) -> Line:
        if abs(along) < APART:
            raise DefectError("a line without a direction")
        return cls(point, along / abs(along))


@dataclass(frozen=True)
class Circle:
    """A circle about a centre."""

    centre: complex
    radius: float


def cross(one: complex, two: complex) -> float:
    return (one.conjugate() * two).imag


def dot(one: complex, two: complex) -> float:
    return (one.conjugate() * two).real


def crossings(one: Line | Circle, two: Line | Circle) -> list[complex]:
    """The points that two lines, a line and a circle, or two circles have in common."""
    if isinstance(one, Line) and isinstance(two, Line):
        square = cross(one.along, two.along)
        if abs(square) < 1e-9:
            raise DefectError("the lines are parallel")
        return [one.point + one.along * cross(two.point - one.point, two.along) / square]
    if isinstance(one, Circle) and isinstance(two, Circle):
        between = two.centre - one.centre
        apart = abs(between)
        to_chord = (apart**2 + one.radius**2 - two.radius**2) / (2 * apart)
        foot = one.centre + between / apart * to_chord
        chord = Line.of(foot, between * 1j)
        return crossings(chord, one)
    line, circle = (one, two) if isinstance(one, Line) else (two, one)
    assert isinstance(line, Line) and isinstance(circle, Circle)
    foot = line.point + line.along * dot(line.along, circle.centre - line.point)
    rest = circle.radius**2 - abs(foot - circle.centre) ** 2
    if rest < -1e-6:
        raise DefectError("the arc does not reach the line")
    half = math.sqrt(max(rest, 0.0)) * line.along
    return [foot + half, foot - half]
