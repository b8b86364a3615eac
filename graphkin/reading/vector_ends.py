"""Where the vectors of a plan end: their arrowheads and the last of their strokes.

Lines that cross at a point say where it should be. Only the end of its vector says where the
student put it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.reading.drawn_ink import COVERED, PITCH, DrawnInk

BARBS = np.radians([13.0, 17.0, 22.0, 28.0])
"""Angles between an arrowhead's sides and its shaft."""
SIDES = np.arange(1.5, 3.0, 0.15)
"""Distances in mm from an arrowhead's tip at which both its sides are examined."""
BARE = np.arange(4.0, 5.6, 0.2)
"""Distances in mm behind a tip at which only the shaft is drawn."""
ASIDE = 0.55
"""How far beside the bare shaft nothing is drawn, in mm."""
HEADED, CLEARLY = 0.6, 0.3
"""The least share of an arrowhead that is drawn; how much clearer one head is than another."""
NEAR = 1.4
"""An end this close to a point, in mm, is at the point."""
SHORTEST = 9.0
"""Vectors shorter than this, in mm, have heads too small to be read."""
NEAREST, FARTHEST = 0.3, 1.9
"""The shares of a vector's length between which its head is searched for."""
REACHED = 0.8
"""The drawn share of a vector's line up to a head that belongs to the vector."""
FREE = 4.0
"""Heads this close to another point, in mm, may belong to that point."""
RING, PIECE, HELD = 0.9, 2.1, 0.55
"""A stroke stops at a point, or reaches it, by the PIECE beyond RING; both mm.

HELD is the share of that piece that is drawn or empty.
"""


class VectorEnd(Struct, frozen=True):
    """What the end of a vector says of the point there.

    - ``head``: where its arrowhead is, if that is clearly elsewhere.
    - ``reversed``: its head is at its tail.
    - ``runs_on``, ``stops_short``: its stroke goes on beyond the point, or ends before it.
    """

    head: complex | None = None
    reversed: bool = False
    runs_on: bool = False
    stops_short: bool = False

    @property
    def is_there(self) -> bool:
        """Whether nothing speaks against an end at the point."""
        return self == VectorEnd()

    @property
    def is_wrong(self) -> bool:
        """Whether the end says that the vector is wrong."""
        return self.head is not None or self.reversed


def heads(ink: DrawnInk, places: Any, way: complex, pale: float = COVERED) -> Any:
    """The drawn share of an arrowhead with its tip at each place, pointing along ``way``.

    The weaker of both sides counts, less what is drawn beside the shaft behind the head. Ink darker
    than ``pale`` counts as drawn.
    """
    best = np.zeros(len(places))
    for barb in BARBS:
        sides = []
        for turn in (np.exp(1j * barb), np.exp(-1j * barb)):
            dark, known = ink.at(places[:, None] - way * SIDES * turn)
            seen = np.maximum(known.sum(axis=1), 1)
            enough = known.mean(axis=1) > 0.5
            sides.append(((dark > pale) * known).sum(axis=1) / seen * enough)
        best = np.maximum(best, np.minimum(*sides))
    bare = [
        (ink.at(places[:, None] - way * (BARE + side * ASIDE))[0] > pale).mean(axis=1)
        for side in (1j, -1j)
    ]
    return best - np.minimum(*bare)


def vector_end(
    ink: DrawnInk, tail: complex, tip: complex, others: list[complex], *, along_line: bool
) -> VectorEnd:
    """What the end of a vector from a tail says of the point at its tip.

    ``others`` are the places of the other points. With ``along_line``, a construction line is drawn
    along the vector, so that only the head shows where the vector ends.
    """
    long = abs(tip - tail)
    if not long >= SHORTEST:
        return VectorEnd()
    way = (tip - tail) / long
    along = np.arange(max(NEAREST * long, 5.0), FARTHEST * long + PITCH, PITCH)
    places = tail + along * way
    share = heads(ink, places, way)
    at_tip = abs(along - long) <= NEAR
    here = float(share[at_tip].max())
    free = ~at_tip
    for other in others:
        free &= abs(places - other) > FREE
    there, head = np.where(free, share, -1.0), None
    best = int(there.argmax())
    if there[best] >= HEADED and there[best] > here + CLEARLY:
        place = complex(places[best])
        if ink.cover(tail, place, 0.4, hidden=1.0) >= REACHED:
            head = place
    ways = np.arange(-NEAR, NEAR, PITCH)
    back = float(heads(ink, tail + ways * way, -way).max())
    turned = back >= HEADED and back > here + CLEARLY and all(abs(o - tail) > FREE for o in others)
    runs_on = short = False
    if not along_line:
        ahead = [((o - tail) / way) for o in others]
        shared = any(z.real > long + NEAR and abs(z.imag) < 0.04 * z.real for z in ahead)
        runs_on = not shared and drawn(ink, tip, way) >= HELD
        short = drawn(ink, tip, -way) < 1 - HELD
    return VectorEnd(head, turned, runs_on, short)


def drawn(ink: DrawnInk, tip: complex, way: complex) -> float:
    """The drawn share of a short piece from beside a point along a direction."""
    along = np.arange(RING, RING + PIECE, PITCH)
    across = np.arange(-0.3, 0.31, 0.15)
    dark, known = ink.at(tip + way * (along[:, None] + 1j * across))
    here = known[:, len(across) // 2] > 0
    if here.mean() < 0.5:
        return 0.5
    return float((dark.max(axis=1) > COVERED)[here].mean())
