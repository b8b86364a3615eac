"""The straight pieces that stand for marks where labels and details look for free places."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import chain
from math import acos, ceil, cos, degrees, radians, sin

import numpy as np

from graphkin.drawing.field import XY
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline
from graphkin.drawing.shapes import Array

SAGITTA = 0.05
"""How far the chords that stand for an arc may leave it, in mm."""


def pieces_of(marks: Iterable[Mark]) -> Array:
    """The straight pieces of marks, a row x0, y0, x1, y1 for each."""
    found = [piece for mark in marks for piece in segments(mark)]
    return np.fromiter(chain.from_iterable(found), np.float64, 4 * len(found)).reshape(-1, 4)


def segments(mark: Mark) -> Sequence[tuple[float, float, float, float]]:
    """The straight pieces of a mark, for labels to keep clear of; arcs as short chords."""
    if isinstance(mark, LineMark):
        return [(mark.x1, mark.y1, mark.x2, mark.y2)]
    if isinstance(mark, Polyline):
        points = [*mark.points, mark.points[0]] if mark.closed else list(mark.points)
        return chained(points)
    if isinstance(mark, CircleMark):
        return arc_chords(mark.cx, mark.cy, mark.r, 0, 360)
    if isinstance(mark, Arc):
        return arc_chords(mark.cx, mark.cy, mark.r, mark.start, mark.end)
    return []


def chained(points: Sequence[XY]) -> list[tuple[float, float, float, float]]:
    """The segments between points that follow one another."""
    return [(*points[i], *points[i + 1]) for i in range(len(points) - 1)]


@lru_cache(maxsize=4096)
def arc_chords(
    x: float, y: float, r: float, start: float, end: float
) -> tuple[tuple[float, float, float, float], ...]:
    """Chords of an arc, so short that they leave it by less than a twentieth of a millimetre."""
    widest = 2 * degrees(acos(max(1 - SAGITTA / r, 0.5))) if r > 0 else 120.0
    count = max(2, ceil(abs(end - start) / widest))
    angles = (radians(start + (end - start) * i / count) for i in range(count + 1))
    return tuple(chained([(x + r * cos(a), y - r * sin(a)) for a in angles]))
