"""Symbols of kinematics on paper (ISO 3952 practice): arrows, pins, pivots, guides, angles."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, takewhile
from math import atan2, cos, degrees, hypot, radians, sin

from graphkin.drawing.field import XY, Carried
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline, polygon
from graphkin.drawing.style import BRIEF
from graphkin.numbers.arithmetic import pick

HEAD, SHARE = 3.2, 0.4
"""Length of an arrowhead in mm, and of a short vector's arrowhead as a share of the vector."""
SHORT, SHAFTED = 2.0 - 1e-6, 6.0
"""Vectors shorter than SHORT, in mm, have no head; those shorter than SHAFTED, a thin shaft.

A vector as long as a crank of 2 mm has a head, however it is rounded.
"""
HALF, BLUNT, LEAST = 0.25, 0.5, 0.6
"""Half the width of a head as a share of its length; the most for a small head; least, in mm."""
PIN = 1.1
"""Radius of a pin in mm."""
FIXED = 1.3
"""Radius of a pin of the frame in mm."""
FREE = 0.8
"""Radius of the mark of a point that joins no links, in mm."""
HINGE = 0.9
"""How much wider each further circle of a multiple hinge is, in mm."""
PIVOT = 5.6
"""Height of a fixed pivot's triangle in mm."""
TALL = 9.5
"""Height of the triangle of a fixed pivot about which a block turns, in mm."""
HIP = 4 / 7
"""Half the width of a pivot's triangle, as a share of its height."""
STRIP, HATCH = 5.2, 2.0
"""Half the length of the hatched line below a pivot, and the depth of hatching, in mm."""
SQUARE = 2.0
"""Side of the mark of a right angle in mm."""
BLOCK = (11.0, 6.4)
"""Length and width of a block in mm."""
SLOT = 1.75
"""Half the width of a slot in mm."""
ROUND = 10
"""Chords of a slot's round end."""
ROUNDED = 1e-6
"""Strokes of hatching by which a length may be short, but for rounding."""
UPRIGHT = (1.0, 0.0)
"""The direction to the right on the page."""
WELD = 2.4
"""Side of the filled corner between two rigidly joined bars, in mm."""


def arrow(tail: XY, tip: XY, cls: str, name: str, step: int | None = None) -> Iterator[Mark]:
    """A vector: one line from tail to tip, then its head."""
    length = distance(tail, tip)
    yield LineMark(*tail, *tip, cls if length >= SHAFTED else f"{cls} {BRIEF}", name, step)
    if length >= SHORT:
        yield head(tail, tip, cls, name, step)


def head(tail: XY, tip: XY, cls: str, name: str = "", step: int | None = None) -> Mark:
    """An arrowhead at the tip, wider than any shaft; a page that moves computes the head itself."""
    if isinstance(tail, Carried):
        return polygon((tip, tail), f"arrowhead {cls.split(maxsplit=1)[0]}", name, step)
    length = hypot(tip[0] - tail[0], tip[1] - tail[1])
    size = min(HEAD, SHARE * length)
    u, v = (tip[0] - tail[0]) / length, (tip[1] - tail[1]) / length
    back = tip[0] - size * u, tip[1] - size * v
    half = max(HALF * size, min(BLUNT * size, LEAST))
    corners = (
        tip,
        (back[0] - half * v, back[1] + half * u),
        (back[0] + half * v, back[1] - half * u),
    )
    return polygon(corners, f"arrowhead {cls.split(maxsplit=1)[0]}", name, step)


def pin(at: XY, name: str, radius: float = PIN) -> Mark:
    """A turning pair: a small open circle."""
    return CircleMark(*at, radius, "pin", name)


def hatched(start: XY, end: XY, *, spacing: float = 2.2, depth: float = HATCH) -> Iterator[Mark]:
    """A line of the frame with hatching on its right-hand side, from start to end (y down)."""
    length, way = toward(start, end)
    yield LineMark(*start, *end, "guide")
    for i in takewhile(lambda i: i + 1 <= length / spacing + ROUNDED, count()):
        foot = across(start, way, (i + 0.8) * spacing, 0)
        yield LineMark(*foot, *across(foot, way, -depth, depth), "ground")


def pivot_ground(at: XY, way: XY, height: float = PIVOT) -> Iterator[Mark]:
    """The triangle on a hatched line that carries a pin of the frame, in direction ``way``."""
    half = HIP * height
    feet = (across(at, way, height, side * half) for side in (1, -1))
    yield polygon((at, *feet), "fixed-pivot")
    left, right = (across(at, way, height, side * (half + STRIP - HIP * PIVOT)) for side in (1, -1))
    yield from hatched(left, right)


def legs(at: XY, way: XY, height: float) -> Iterator[Mark]:
    """Both sides of a pivot's triangle redrawn thin, where a block in front covers them."""
    for half in (HIP * height, -HIP * height):
        yield LineMark(*at, *across(at, way, height, half), "ground")


def distance(start: XY, end: XY) -> float:
    """The distance between two places."""
    if isinstance(start, Carried):
        return start.toward(end)[0]  # type: ignore[no-any-return]
    return hypot(end[0] - start[0], end[1] - start[1])


def toward(start: XY, end: XY) -> tuple[float, XY]:
    """The distance between two places, and the unit direction from the first to the second."""
    if isinstance(start, Carried):
        return start.toward(end)
    length = distance(start, end)
    return length, ((end[0] - start[0]) / length, (end[1] - start[1]) / length)


def across(at: XY, way: XY, along: float, aside: float) -> XY:
    """The place ``along`` a unit direction of the page and ``aside`` to its right."""
    if isinstance(at, Carried):
        return at.across(way, along, aside)
    return at[0] + along * way[0] - aside * way[1], at[1] + along * way[1] + aside * way[0]


def rails(at: XY, way: XY, low: float, high: float) -> Iterator[Mark]:
    """The two sides of a guide of the frame, hatched outside, from ``low`` to ``high`` along it."""
    half = BLOCK[1] / 2
    yield from hatched(across(at, way, low, half), across(at, way, high, half))
    yield from hatched(across(at, way, high, -half), across(at, way, low, -half))


def block(at: XY, way: XY, name: str, cls: str = "block") -> Mark:
    """A sliding block: a rectangle turned along its guide; on the frame its class is slider."""
    a, b = BLOCK[0] / 2, BLOCK[1] / 2
    corners = ((-a, -b), (a, -b), (a, b), (-a, b))
    return polygon(tuple(across(at, way, *corner) for corner in corners), cls, name)


def slot(at: XY, way: XY, low: float, high: float, name: str) -> Mark:
    """A straight slot: two parallel lines with round ends, from ``low`` to ``high`` along it."""
    corners = []
    for end, start in ((high, -90), (low, 90)):
        middle = across(at, way, end, 0)
        for i in range(ROUND + 1):
            turn = radians(start + 180 * i / ROUND)
            corners.append(across(middle, way, SLOT * cos(turn), SLOT * sin(turn)))
    return polygon(tuple(corners), "slot", name)


def slot_ground(at: XY, way: XY, low: float, high: float) -> Iterator[Mark]:
    """Hatching next to both sides of a slot that is cut in the frame."""
    for first, last, side in ((low, high, SLOT), (high, low, -SLOT)):
        marks = hatched(across(at, way, first, side), across(at, way, last, side))
        yield from (mark for mark in marks if mark.cls == "ground")


def weld(corner: XY, first: XY, second: XY, name: str) -> Mark:
    """The filled corner that joins two bars rigidly; directions are unit vectors on the page."""
    ends = (across(corner, way, WELD, 0) for way in (first, second))
    return polygon((corner, *ends), "weld", name)


def turned_arrow(
    centre: XY, radius: float, way: XY, end: tuple[float, float], cls: str
) -> Iterator[Mark]:
    """An arc with an arrowhead at its end, for a sense of rotation.

    ``way`` is the direction from the centre to the arc's end. ``end`` is the angle there, and the
    angle from the end back to the arc's beginning, in degrees.
    """
    angle, back = end
    yield Arc(*centre, radius, angle + back, angle, cls)
    yield sense_head(centre, radius, way, pick(back > 0, 1, -1), cls)


def sense_head(centre: XY, radius: float, way: XY, side: float, cls: str) -> Mark:
    """The head of a turning arrow at the end of ``way``, along the arc's last chord.

    ``side`` is 1 where the arc comes from greater angles, -1 where it comes from smaller ones.
    """
    before = 2.2 / radius
    x0, y0 = radius * cos(before), radius * sin(before)
    length, half = hypot(radius - x0, y0), 0.45
    u, v = (radius - x0) / length, side * y0 / length
    corners = (
        (radius, 0.0),
        (x0 - half * v, half * u - side * y0),
        (x0 + half * v, -side * y0 - half * u),
    )
    return polygon(tuple(across(centre, way, *c) for c in corners), f"arrowhead {cls}")


def square_mark(corner: XY, first: XY, second: XY, step: int | None) -> Mark:
    """The small square that marks a right angle; the directions are unit vectors on the page."""
    (x, y), (a, b), (c, d), size = corner, first, second, SQUARE
    points = (
        (x + size * a, y + size * b),
        (x + size * (a + c), y + size * (b + d)),
        (x + size * c, y + size * d),
    )
    return Polyline(points, "square-mark", "", step)


def bearing(way: XY) -> float:
    """The angle of a direction on the page in degrees, counter-clockwise as seen on paper."""
    return degrees(atan2(-way[1], way[0]))
