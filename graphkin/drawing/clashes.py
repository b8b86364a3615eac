"""The open places of labels, and which of them exclude each other (mm)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing.shapes import (
    HAIR,
    NOWHERE,
    Array,
    Index,
    crossings,
    overlap,
    pairs_of,
    segments,
    separation,
    where,
)

PAD = 0.6  # mm between a label and a taken box, a point, a leader or a label above or below it
BESIDE = 1.2  # mm between labels side by side, so that they do not read as one
APART = HAIR[:, :, 0] + np.array([-BESIDE, -PAD, BESIDE, PAD], dtype=np.float32)[:, None]
WIDER = HAIR[:, :, 0] + np.array([-PAD, -PAD, PAD, PAD], dtype=np.float32)[:, None]


AT_ONCE = 512  # places compared with all others at once, which bounds the memory


class OpenPlaces(NamedTuple):
    """The open places, one per row; a leader at NOWHERE is none; mm."""

    label: Index
    x: Array  # centre
    y: Array
    hx: Array  # half extents of the label
    hy: Array
    cost: Array
    leader: Array  # x0, y0 at the label, x1, y1 at the subject

    def take(self, which: Index) -> OpenPlaces:
        """Return some of the places."""
        x, y, hx, hy, cost = np.array(self[1:6]).take(which, axis=1)
        return OpenPlaces(
            self.label.take(which), x, y, hx, hy, cost, self.leader.take(which, axis=0)
        )

    def joined(self, more: OpenPlaces) -> OpenPlaces:
        """Return these places followed by more."""
        both = (np.concatenate(pair) for pair in zip(self[1:], more[1:], strict=True))
        return OpenPlaces(np.concatenate([self.label, more.label]), *both)


NONE = np.empty(0)
NO_PLACES = OpenPlaces(np.empty(0, dtype=np.intp), NONE, NONE, NONE, NONE, NONE, np.empty((0, 4)))


class Clashes:
    """The places that exclude each other."""

    def __init__(self) -> None:
        self.places = NO_PLACES
        self.table = np.zeros((0, 0), dtype=np.bool_)
        self.kept: list[int] = []

    def add(self, more: OpenPlaces) -> None:
        """Add places; existing ones keep their numbers."""
        self.places = self.places.joined(more)

    def rows(self) -> list[int]:
        """Return for each place the places it excludes for other labels, as bits of a number.

        Places added since the last call are now compared with all others. Entries between places of
        the same label have no meaning.
        """
        count, old = len(self.places.label), len(self.kept)
        if old < count:
            self.table, table = np.zeros((count, count), dtype=np.bool_), self.table
            self.table[:old, :old] = table
            for start in range(old, count, AT_ONCE):
                self._compare(old, start, min(start + AT_ONCE, count))
            data = np.packbits(self.table, axis=1, bitorder="little").tobytes()
            size = -(-count // 8)
            starts = range(0, len(data), size)
            self.kept = [int.from_bytes(data[k : k + size], "little") for k in starts]
        return self.kept

    def _compare(self, new: int, old: int, end: int) -> None:
        """Compare the places from ``old`` to ``end`` with all places before ``end``.

        Those from ``new`` on are compared in both directions, as if all were compared at once.
        """
        places = self.places.take(np.arange(end)) if end < len(self.places.label) else self.places
        _, x, y, hx, hy, _, leader = places
        box = np.array([x - hx, y - hy, x + hx, y + hy]).astype(np.float32)
        self.table[old:end, :end] = overlap((box[:, old:] + APART)[:, :, None], box)
        if new < old:
            back = overlap((box[:, new:old] + APART)[:, :, None], box[:, old:])
            self.table[old:end, new:old] |= back.T
        led = where(leader[:, 0] < NOWHERE)
        if len(led):
            self._compare_leaders(box, led, old)
        fresh = self.table[old:end, old:end]
        fresh |= fresh.T
        self.table[:old, old:end] = self.table[old:end, :old].T

    def _compare_leaders(self, box: NDArray[np.float32], led: Index, old: int) -> None:
        """Find the leaders that run into labels or cross, between new places and all places.

        ``led`` are the places with a leader.
        """
        path, leader = segments(self.places.leader.take(led, axis=0)), self.places.leader
        way, new = path.boxes().astype(np.float32), int(np.searchsorted(led, old))
        wide = (box + WIDER)[:, :, None]
        fresh = pairs_of(overlap(wide[:, old:], way))
        late = pairs_of(overlap(wide[:, :old], way[:, new:]))
        one = np.concatenate([fresh[0] + old, late[0]])
        nth = np.concatenate([fresh[1], late[1] + new])
        one, nth = self._undecided(one, led, nth)
        x, y, hx, hy = (column.take(one) for column in self.places[1:5])
        near = where(separation(x, y, hx, hy, path.take(nth)) < PAD)
        one, other = one.take(near), led.take(nth.take(near))
        self.table[np.maximum(one, other), np.minimum(one, other)] = True
        both = overlap(way[:, new:, None] + HAIR, way)
        both &= led[new:, None] > led
        one, nth = pairs_of(both)
        one, nth = self._undecided(led.take(one + new), led, nth)
        other = led.take(nth)
        crossed = crossings(leader.take(one, axis=0), leader.take(other, axis=0))
        self.table[one, other] |= crossed

    def _undecided(self, one: Index, led: Index, nth: Index) -> tuple[Index, Index]:
        """Return the pairs of places and places with leaders that are not known to clash."""
        other, label = led.take(nth), self.places.label
        known = self.table[np.maximum(one, other), np.minimum(one, other)]
        rest = where(~known & (label.take(one) != label.take(other)))
        return one.take(rest), nth.take(rest)
