"""The field's symbols on paper (ISO 3952 practice): arrows, pins, pivots, guides, angles."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, cos, degrees, hypot, radians, sin

from graphkin.paper.field import XY
from graphkin.paper.marks import Arc, Circle, Line, Mark, Polyline, polygon

VECTORS = ("velocity", "relative-velocity", "acceleration", "normal", "tangential", "coriolis")
"""The classes of lines that are vectors."""
HEAD = 3.2
"""Length of an arrowhead in mm; short vectors get smaller ones, below SHORT none."""
SHORT = 2.0
PIN = 1.1
BLOCK = (11.0, 6.4)


def arrow(tail: XY, tip: XY, cls: str, name: str, step: int | None = None) -> Iterator[Mark]:
    """A vector as one line from tail to tip, its head apart."""
    length = hypot(tip[0] - tail[0], tip[1] - tail[1])
    yield Line(*tail, *tip, cls, name, step)
    if length >= SHORT:
        yield head(tail, tip, cls, name, step)


def head(tail: XY, tip: XY, cls: str, name: str = "", step: int | None = None) -> Mark:
    """An arrowhead at the tip, at most 0.4 of the vector long."""
    length = hypot(tip[0] - tail[0], tip[1] - tail[1])
    size = min(HEAD, 0.4 * length)
    u, v = (tip[0] - tail[0]) / length, (tip[1] - tail[1]) / length
    back, half = (tip[0] - size * u, tip[1] - size * v), 0.17 * size
    corners = (
        tip,
        (back[0] - half * v, back[1] + half * u),
        (back[0] + half * v, back[1] - half * u),
    )
    return polygon(corners, f"arrowhead {cls.split(maxsplit=1)[0]}", name, step)


def pin(at: XY, name: str) -> Mark:
    """A turning pair: a small open circle."""
    return Circle(*at, PIN, "pin", name)


def hatched(start: XY, end: XY, *, spacing: float = 2.2, depth: float = 2.0) -> Iterator[Mark]:
    """A line of the frame with hatching on its right-hand side as one walks along it (y down)."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    u, v = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    yield Line(*start, *end, "guide")
    for i in range(int(length / spacing)):
        x, y = start[0] + (i + 0.8) * spacing * u, start[1] + (i + 0.8) * spacing * v
        yield Line(x, y, x - depth * (u + v), y - depth * (v - u), "ground")


def fixed_pivot(at: XY, name: str) -> Iterator[Mark]:
    """A pin on the ground: a triangle on a hatched line, the pin's circle at its top."""
    x, y = at
    yield polygon((at, (x - 3.2, y + 5.6), (x + 3.2, y + 5.6)), "fixed-pivot")
    yield from hatched((x - 5.2, y + 5.6), (x + 5.2, y + 5.6))
    yield Circle(x, y, PIN + 0.2, "pin", name)


def block_on_guide(at: XY, way: XY, length: float, name: str) -> Iterator[Mark]:
    """A block between the two hatched sides of its guide."""
    u, v = way
    half = BLOCK[1] / 2

    def place(along: float, across: float) -> XY:
        return at[0] + along * u - across * v, at[1] + along * v + across * u

    yield from hatched(place(-length, half), place(length, half))
    yield from hatched(place(length, -half), place(-length, -half))
    a, b = BLOCK[0] / 2, half
    yield polygon((place(-a, -b), place(a, -b), place(a, b), place(-a, b)), "slider", name)


def turned_arrow(centre: XY, radius: float, start: float, end: float, cls: str) -> Iterator[Mark]:
    """An arc with an arrowhead at its end, for a sense of turning; angles in degrees."""
    yield Arc(*centre, radius, start, end, cls)
    sign = 1 if end > start else -1
    before = radians(end - sign * degrees(2.2 / radius))
    tip = radians(end)
    yield sense_head(centre, radius, before, tip, cls)


def sense_head(centre: XY, radius: float, before: float, tip: float, cls: str) -> Mark:
    """The head of a turning arrow, along the chord of its last part."""
    ends = [(centre[0] + radius * cos(t), centre[1] - radius * sin(t)) for t in (before, tip)]
    (x0, y0), (x1, y1) = ends
    length = hypot(x1 - x0, y1 - y0)
    u, v = (x1 - x0) / length, (y1 - y0) / length
    half = 0.45
    corners = ((x1, y1), (x0 - half * v, y0 + half * u), (x0 + half * v, y0 - half * u))
    return polygon(corners, f"arrowhead {cls}")


def square_mark(corner: XY, first: XY, second: XY, step: int | None, size: float = 2.0) -> Mark:
    """The small square that marks a right angle; the ways are unit vectors on the page."""
    (x, y), (a, b), (c, d) = corner, first, second
    points = (
        (x + size * a, y + size * b),
        (x + size * (a + c), y + size * (b + d)),
        (x + size * c, y + size * d),
    )
    return Polyline(points, "square-mark", "", step)


def bearing(way: XY) -> float:
    """The angle in degrees, counter-clockwise on paper, of a way on the page."""
    return degrees(atan2(-way[1], way[0]))
