"""The places that are open to labels, and which of them rule each other out (mm)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphkin.paper.shapes import (
    NOWHERE,
    Array,
    Index,
    Mask,
    crossings,
    meeting,
    segments,
    separation,
    where,
)

PAD = 0.6  # mm between a label and a taken box, a point, a leader or a label above or below it
BESIDE = 1.2  # mm between labels side by side, so that they do not read as one
APART = np.array([-BESIDE, -PAD, BESIDE, PAD])[:, None]
WIDER = np.array([-PAD, -PAD, PAD, PAD])[:, None]


class Places(NamedTuple):
    """The places that are open, a row for each; a leader NOWHERE is none; mm."""

    label: Index
    x: Array  # centre
    y: Array
    hx: Array  # half extents of the label
    hy: Array
    cost: Array
    leader: Array  # x0, y0 at the label, x1, y1 at the subject

    def take(self, which: Index) -> Places:
        """Return some of the places."""
        x, y, hx, hy, cost = np.array(self[1:6]).take(which, axis=1)
        return Places(self.label.take(which), x, y, hx, hy, cost, self.leader.take(which, axis=0))

    def joined(self, more: Places) -> Places:
        """Return these places and then more."""
        both = (np.concatenate(pair) for pair in zip(self[1:], more[1:], strict=True))
        return Places(np.concatenate([self.label, more.label]), *both)


NONE = np.empty(0)
NO_PLACES = Places(np.empty(0, dtype=np.intp), NONE, NONE, NONE, NONE, NONE, np.empty((0, 4)))


class Clashes:
    """Which places rule each other out."""

    def __init__(self) -> None:
        self.places = NO_PLACES
        self.table = np.zeros((0, 0), dtype=np.bool_)
        self.kept: list[int] = []

    def add(self, more: Places) -> None:
        """Add places; those there were keep their numbers."""
        self.places = self.places.joined(more)

    def rows(self) -> list[int]:
        """Return for each place which others it rules out if a label sits there: bits of a number.

        Places that were added since this was done last are now compared with all others.
        """
        count, old = len(self.places.label), len(self.kept)
        if old < count:
            self.table, table = np.zeros((count, count), dtype=np.bool_), self.table
            self.table[:old, :old] = table
            self._compare(old)
            data = np.packbits(self.table, axis=1, bitorder="little").tobytes()
            size = -(-count // 8)
            starts = range(0, len(data), size)
            self.kept = [int.from_bytes(data[k : k + size], "little") for k in starts]
        return self.kept

    def _compare(self, old: int) -> None:
        """Compare the places from a number on with all."""
        label, x, y, hx, hy, _, leader = self.places
        if label.min() == label.max():
            return
        box = np.array([x - hx, y - hy, x + hx, y + hy])
        self._compare_boxes(box, old)
        led = where(leader[:, 0] < NOWHERE)
        if len(led):
            self._compare_leaders(box, led, old)

    def _compare_boxes(self, box: Array, old: int) -> None:
        """Find the labels that come too near to each other: those from a number on to all."""
        one, other = meeting(box[:, old:] + APART, box)
        one, other = self._of_two(one + old, other, other < one + old)
        _, x, y, hx, hy, *_ = self.places
        near = np.abs(x.take(one) - x.take(other)) < hx.take(one) + hx.take(other) + BESIDE
        near &= np.abs(y.take(one) - y.take(other)) < hy.take(one) + hy.take(other) + PAD
        self._note(one, other, near)

    def _compare_leaders(self, box: Array, led: Index, old: int) -> None:
        """Find the leaders that run into labels or cross: those of places from a number on to all.

        ``led`` are the places with a leader.
        """
        leader = self.places.leader
        path = segments(leader)
        way, new = path.take(led).boxes(), int(np.searchsorted(led, old))
        fresh = meeting(box[:, old:] + WIDER, way)
        late = meeting(box[:, :old] + WIDER, way[:, new:])
        one = np.concatenate([fresh[0] + old, late[0]])
        other = led.take(np.concatenate([fresh[1], late[1] + new]))
        one, other = self._of_two(one, other)
        x, y, hx, hy = (column.take(one) for column in self.places[1:5])
        self._note(one, other, separation(x, y, hx, hy, path.take(other)) < PAD)
        one, other = meeting(way[:, new:], way)
        one, other = self._of_two(led.take(one + new), led.take(other), other < one + new)
        crossed = crossings(leader.take(one, axis=0), leader.take(other, axis=0))
        self._note(one, other, crossed)

    def _of_two(self, one: Index, other: Index, some: Mask | bool = True) -> tuple[Index, Index]:
        """Return the pairs, or some of them, that are places of two labels."""
        label = self.places.label
        at = where((label.take(one) != label.take(other)) & some)
        return one.take(at), other.take(at)

    def _note(self, one: Index, other: Index, clash: Mask) -> None:
        """Note that these pairs of places rule each other out."""
        at = where(clash)
        one, other = one.take(at), other.take(at)
        self.table[one, other] = self.table[other, one] = True
