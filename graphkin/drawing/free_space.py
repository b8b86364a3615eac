"""Where on a field there is room for a disc, as near as possible to what it belongs to (mm)."""

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
"""Distance of the places tried, in mm."""
ABREAST = 64
"""Places of boxes that are compared with what is drawn about them at one go."""
TOGETHER = 16
"""Places that are compared with all that is drawn at one go."""
INNER = ((0.7, 0.7), (0.95, 0.3), (0.3, 0.95))
"""Half the sides of rectangles in a disc of radius 1."""
BLOT = 2.0
"""Size of the cells in which marks are counted to rule places out at a glance, in mm."""
CLEAR = 0.5
"""How far the line to a disc stays from lettering, links' numbers and centres, in mm."""
APART = ("number", "centre", "centre-line")
"""The classes of circles about a link's number or name, and about a centre or a pole, and of axes
and lines of guides: what the line to a disc stays clear of."""
MOST = 240
"""Places, nearest first, among which one is sought to which a line crosses no text or centre."""


class FreeDisc(NamedTuple):
    """The middle of a free disc, and whether the line to it crosses no text or centre."""

    at: XY
    in_sight: bool


class Space:
    """What stands in a field, made ready for looking for free discs."""

    def __init__(self, marks: Sequence[Mark], rect: Rect) -> None:
        self.rect = rect
        self.drawn = pieces_of(marks)
        self.lines = segments(self.drawn)
        self.texts = rectangles(
            [reach(mark) for mark in marks if isinstance(mark, Text) or style_class(mark) in APART]
        )

    @cached_property
    def blots(self) -> Blots:
        """Marks along what is drawn, which rule most places of discs out at a glance."""
        return Blots(self.drawn, self.rect, 0.0, BLOT)

    def first(self, places: Iterable[XY], half: XY, air: float) -> XY | None:
        """The first place in the field where a box has so much air around it; None where none has.

        ``half`` are half the sides of the box. No more places are made than are looked at.
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
        """The free disc of radius ``room`` as near as possible to a place; None if there is none.

        One in sight of the place goes before others.
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
        """The places of a grid where the middle of a free disc may be, nearest first."""
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
