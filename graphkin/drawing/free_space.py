"""Free space for a disc in a field, as near as possible to its subject (mm)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from itertools import islice
from math import inf
from typing import NamedTuple

import numpy as np

from graphkin.drawing.clearance import Blots, pieces_of
from graphkin.drawing.field import XY, Rect
from graphkin.drawing.marks import Mark, Text, reach, style_class
from graphkin.drawing.shapes import (
    Array,
    distance,
    joined,
    overlap,
    rectangles,
    segments,
    separation,
    where,
)

GRID = 5.0
"""Distance of the tried places, in mm."""
ABREAST = 64
"""Places of boxes that are compared with nearby marks at once."""
TOGETHER = 16
"""Places that are compared with all marks at once."""
INNER = ((0.7, 0.7), (0.95, 0.3), (0.3, 0.95))
"""Half the sides of rectangles in a disc of radius 1."""
BLOT = 2.0
"""Size of the grid cells that quickly exclude places, in mm."""
CLEAR = 0.5
"""Distance of the line to a disc from lettering, links' numbers and centres, in mm."""
APART = ("number", "centre", "centre-line")
"""The classes of marks that the line to a disc avoids.

They are circles about a link's number or name and about a centre or pole, axes, and lines of
guides.
"""
MOST = 240
"""The most places, nearest first, searched for one whose line crosses no text or centre."""


class FreeDisc(NamedTuple):
    """The middle of a free disc, and whether the line to it crosses no text or centre."""

    at: XY
    in_sight: bool


class Space:
    """The marks of a field, prepared for the search for free discs."""

    def __init__(self, marks: Sequence[Mark], rect: Rect) -> None:
        self.rect = rect
        self.drawn = pieces_of(marks)
        self.lines = segments(self.drawn)
        self.texts = rectangles(
            [reach(mark) for mark in marks if isinstance(mark, Text) or style_class(mark) in APART]
        )

    @cached_property
    def blots(self) -> Blots:
        """Marks along all lines, which quickly exclude most places of discs."""
        return Blots(self.drawn, self.rect, 0.0, BLOT)

    def first(self, places: Iterable[XY], half: XY, air: float) -> XY | None:
        """The first place in the field where a box has ``air`` around it, or None.

        ``half`` are half the sides of the box. Places are generated only as they are examined.
        """
        drawn, coming = joined(self.lines, self.texts), iter(places)
        grown = drawn.boxes(air)
        left, top, right, bottom = self.rect
        while some := [*islice(coming, ABREAST)]:
            x, y = np.array(some, dtype=np.float64).T
            wide, high = (np.full(len(x), side) for side in half)
            inside = (x - wide >= left + air) & (x + wide <= right - air)
            inside &= (y - high >= top + air) & (y + high <= bottom - air)
            lows, highs = ((x - wide).min(), (y - high).min()), ((x + wide).max(), (y + high).max())
            near = drawn.take(where(overlap(np.array([*lows, *highs])[:, None], grown)))
            apart = distance(x, y, wide, high, near.upright())
            free = where(inside & (apart.min(axis=0, initial=inf) > air))
            if len(free):
                return some[int(free[0])]
        return None

    def take(self, box: Rect) -> None:
        """Keep a rectangle free of discs from now on."""
        self.texts = joined(self.texts, rectangles([box]))

    def disc(self, near: XY, room: float) -> FreeDisc | None:
        """The free disc of radius ``room`` nearest to a place, or None.

        A disc in sight of the place is preferred.
        """
        x, y = self._likely(near, room)
        texts, zero = self.texts.upright(), np.zeros(1)
        drawn = joined(self.lines, self.texts).upright()
        hidden: FreeDisc | None = None
        for start in range(0, len(x), TOGETHER):
            u, v = x[start : start + TOGETHER], y[start : start + TOGETHER]
            free = where(distance(u, v, zero, zero, drawn).min(axis=0, initial=inf) > room)
            places = [*zip(u.take(free).tolist(), v.take(free).tolist(), strict=True)]
            if places:
                ways = segments([(*near, *at) for at in places])
                apart = separation(texts.x, texts.y, texts.ex, texts.ey, ways)
                in_sight = apart.min(axis=0, initial=CLEAR) >= CLEAR
                for at, seen in zip(places, in_sight.tolist(), strict=True):
                    if seen:
                        return FreeDisc(at, True)
                hidden = hidden or FreeDisc(places[0], False)
            if hidden and start >= MOST:
                break
        return hidden

    def _likely(self, near: XY, room: float) -> tuple[Array, Array]:
        """The grid places where the middle of a free disc may be, nearest first."""
        xs, ys = (
            np.arange(self.rect[i] + room, self.rect[i + 2] - room, GRID, dtype=np.float64)
            for i in (0, 1)
        )
        x, y = (row.reshape(-1) for row in np.meshgrid(xs, ys))
        order = np.argsort(np.hypot(x - near[0], y - near[1]), kind="stable")
        x, y = x.take(order), y.take(order)
        for wide, high in INNER:
            likely = where(~self.blots.hit(x, y, wide * room, high * room))
            x, y = x.take(likely), y.take(likely)
        return x, y
