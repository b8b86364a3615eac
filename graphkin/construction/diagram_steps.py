"""Graphical differentiation and integration of a diagram by chords, tangents and rays, in mm.

A chord and the ray through the pole parallel to it have one slope. With the pole at a distance H
before the axis of ordinates, the ray cuts off H times that slope. The rate at the middle of an
interval follows to an error of h²/24 times the third derivative. A tangent gives the rate at its
own point. A curve drawn through points has there the slope between the neighbours, to h²/6.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from msgspec import Struct

from graphkin.drawing.field import XY

CHORD, SECOND = 1 / 24, 1 / 12
"""The share of h² in the error of a rate by one chord, and of a second rate by three ordinates."""
TANGENT, SECOND_TANGENT = 1 / 6, 1 / 3
"""The same by tangents to a curve through the ordinates, and to the curve that they give."""
HALF = 0.4
"""Half the length of a tangent, as a share of the interval."""


class ChordRay(Struct, frozen=True):
    """One step: a chord, the end of the parallel ray through the pole, and the point that follows.

    Places are measured from the origin of their own diagram, y upwards. A ray runs from the pole
    (-H, 0) to its ``end`` on the axis of ordinates.
    """

    first: XY
    last: XY
    end: XY
    found: XY


def differentiated(points: Sequence[XY], distance: float) -> list[ChordRay]:
    """The rate in the middle of each interval, from chords and a pole at a distance H."""
    found = []
    for (x, y), (u, v) in pairwise(points):
        height = distance * (v - y) / (u - x)
        found.append(ChordRay((x, y), (u, v), (0.0, height), ((x + u) / 2, height)))
    return found


def by_tangents(points: Sequence[XY], distance: float, *, closed: bool = False) -> list[ChordRay]:
    """The rate at each point, from tangents to the curve through the points.

    The ends have a tangent only where the diagram is ``closed``: where it begins anew at its end.
    """
    around = [*points]
    if closed:
        across, up = points[-1][0] - points[0][0], points[-1][1] - points[0][1]
        around.insert(0, (points[-2][0] - across, points[-2][1] - up))
        around.append((points[1][0] + across, points[1][1] + up))
    found = []
    for (x, y), (u, v), (a, b) in zip(around, around[1:], around[2:], strict=False):
        slope, half = (b - y) / (a - x), HALF * (a - x) / 2
        ends = (u - half, v - half * slope), (u + half, v + half * slope)
        found.append(ChordRay(*ends, (0.0, distance * slope), (u, distance * slope)))
    return found


def integrated(
    places: Sequence[float], ordinates: Sequence[float], distance: float, start: float
) -> list[ChordRay]:
    """The string polygon over some intervals, from the mean ordinate in each.

    ``places`` are the ends of the intervals. Each string is parallel to the ray from the pole to
    its ordinate on the axis; the polygon begins at ``start``.
    """
    found, low = [], start
    for (x, u), height in zip(pairwise(places), ordinates, strict=True):
        high = low + height / distance * (u - x)
        found.append(ChordRay((x, low), (u, high), (0.0, height), (u, high)))
        low = high
    return found


def smooth(points: Sequence[XY], chords: int = 12) -> list[XY]:
    """A smooth curve through points with rising x: at each the slope between its neighbours."""
    last = len(points) - 1
    around = [(points[max(i - 1, 0)], points[min(i + 1, last)]) for i in range(last + 1)]
    slopes = [(v - y) / (u - x) for (x, y), (u, v) in around]
    found = [points[0]]
    for i, ((x, y), (u, v)) in enumerate(pairwise(points)):
        width = u - x
        for k in range(1, chords + 1):
            t = k / chords
            bend = (1 - t) * slopes[i] - t * slopes[i + 1] - (1 - 2 * t) * (v - y) / width
            found.append((x + width * t, y + t * (v - y) + t * (1 - t) * width * bend))
    return found
