"""How far labels are from what is drawn on a page, and what their places cost (mm)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from graphkin.paper.candidates import (
    NOWHERE,
    TINY,
    Array,
    Blots,
    Box,
    Index,
    Mask,
    Shapes,
    Subjects,
    Tries,
    cosines,
    crossings,
    distance,
    distance_cost,
    joined,
    leaders,
    merged,
    rectangles,
    segments,
    separation,
)

AHEAD = 4  # how many places of a label are compared with all others at one go
PAD = 0.6  # mm between a label and a taken box, a point, a leader or a label above or below it
BESIDE = 1.2  # mm between labels side by side, so that they do not read as one
APART = np.array([[BESIDE], [PAD]])
OWN = 0.4  # mm within which a drawn line is taken for the subject itself
ROOM = 1.4  # mm of air around a label beyond which more is no better
LEADER = np.array([6.0, 3.7])  # what one costs to a point and to a segment; costs are in mm
CROSSING = 0.9  # a line that a leader crosses
SKIRT = 2.5  # a line that a leader runs along
ASTRAY = 4.0  # a label further than FAR_OFF from its segment and nearer to another of length LONG
FAR_OFF, LONG = 2.5, 24.0  # mm; the first is beyond the gap
AIR = 0.7  # each mm of air that is missing

# Kinds of shapes; how far (mm) each should be beyond a label's own subject, and the cost of each
# mm that is missing, for the labels of points and of segments.
LINE, BOX, DOT, CORE = range(4)
MARGIN = np.array([[0.3, -NOWHERE, 1.5, 0.3], [0.8, -NOWHERE, 1.5, 2.0]])
WEIGHT = np.array([[0.4, 0.0, 1.5, 0.5], [1.1, 0.0, 0.7, 1.5]])


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
        return Places(self.label[which], *(column[which] for column in self[1:]))

    def joined(self, more: Places) -> Places:
        """Return these places and then more."""
        both = (np.concatenate(pair) for pair in zip(self[1:], more[1:], strict=True))
        return Places(np.concatenate([self.label, more.label]), *both)


NONE = np.empty(0)
NO_PLACES = Places(np.empty(0, dtype=np.intp), NONE, NONE, NONE, NONE, NONE, np.empty((0, 4)))


class Clashes:
    """Which places rule each other out, found when first asked for."""

    def __init__(self) -> None:
        self.places = NO_PLACES
        self.known: dict[int, Mask] = {}

    def add(self, more: Places) -> None:
        """Add places; those there were keep their numbers."""
        old, self.places = len(self.places.label), self.places.joined(more)
        leader = self.places.leader
        self.led, self.path = leader[:, 0] < NOWHERE, np.stack(segments(leader))
        self.box = np.stack(self.places[1:5])
        middle, half = self.box[:2], self.box[2:]
        end = np.where(self.led, leader.T[2:], middle)
        self.low, self.high = np.minimum(middle - half, end), np.maximum(middle + half, end) + APART
        grown = self._found(np.fromiter(self.known, dtype=np.intp), old)
        for k, row in zip(self.known, grown, strict=True):
            self.known[k] = np.concatenate([self.known[k], row])

    def of(self, k: int) -> Mask:
        """Return which places the place k rules out if a label sits there."""
        if k not in self.known:
            same = np.flatnonzero(self.places.label[k : k + AHEAD] == self.places.label[k])
            self.find(j for j in (same + k).tolist() if j not in self.known)
        return self.known[k]

    def find(self, which: Iterable[int]) -> None:
        """Compare some places with all others, at one go."""
        ks = np.fromiter(which, dtype=np.intp)
        self.known.update(zip(ks.tolist(), self._found(ks, 0), strict=True))

    def _found(self, ks: Index, start: int) -> Mask:
        """Compare some places with those from a number on: first their extents, then the rest."""
        label, (left, top), (right, bottom) = self.places.label, self.low, self.high
        near = left[start:] < right[ks, None]
        near &= left[ks, None] < right[start:]
        near &= top[start:] < bottom[ks, None]
        near &= top[ks, None] < bottom[start:]
        near &= label[start:] != label[ks, None]
        at = np.flatnonzero(near)
        row, there = np.divmod(at, near.shape[1]) if len(at) else (at, at)
        near.reshape(-1)[at] = self._meet(ks[row], there + start)
        return np.asarray(near)

    def _meet(self, one: Index, other: Index) -> Mask:
        """Return which pairs of places meet: their boxes, a box and a leader, or two leaders."""
        here, there = self.box.take(one, axis=1), self.box.take(other, axis=1)
        inside = np.abs(here[:2] - there[:2]) < here[2:] + there[2:] + APART
        clash = np.asarray(inside[0] & inside[1])
        led, back = np.flatnonzero(self.led[other]), np.flatnonzero(self.led[one])
        if len(led) or len(back):
            x, y, hx, hy = self.box.take(np.concatenate([one[led], other[back]]), axis=1)
            ways = Shapes(*self.path.take(np.concatenate([other[led], one[back]]), axis=1))
            clash[np.concatenate([led, back])[separation(x, y, hx, hy, ways) < PAD]] = True
            both = led[self.led[one[led]]]
            leader = self.places.leader
            clash[both] |= crossings(leader[one[both]], leader[other[both]])
        return clash


class Pairs(NamedTuple):
    """Which shapes are near the places of which label, sorted by label."""

    row: Index
    shape: Index
    own: Mask  # the shape is the subject or runs through it
    start: Index  # where each row begins


class Page:
    """What labels must keep clear of, and what each place costs."""

    def __init__(
        self, subjects: Subjects, lines: ArrayLike, boxes: ArrayLike, field: Box, stroke: ArrayLike
    ) -> None:
        drawn, taken = (np.asarray(a, dtype=np.float64).reshape(-1, 4) for a in (lines, boxes))
        if not all(np.isfinite(ends).all() for ends in (drawn, taken, subjects.ends)):
            raise ValueError("a line, a box or a subject of a label is not finite")
        clear = np.broadcast_to(np.asarray(stroke, dtype=np.float64), len(drawn))
        drawn, clear = merged(drawn, clear)
        start, end = subjects.ends[:, :2], subjects.ends[:, 2:]
        core = np.concatenate([start + (end - start) / 6, end - (end - start) / 6], axis=1)
        self.subjects, self.field = subjects, field
        self.ends = np.concatenate([drawn, taken, core])
        self.shapes = joined(segments(drawn), rectangles(taken), segments(core))
        kinds = [np.full(len(drawn), LINE), np.full(len(taken), BOX)]
        self.kind = np.concatenate([*kinds, np.where(subjects.line, CORE, DOT)])
        self.long = (np.hypot(self.shapes.ex, self.shapes.ey) > LONG / 2) & (self.kind != BOX)
        keep = np.where(subjects.line, -NOWHERE, subjects.radius + PAD)
        self.clear = np.concatenate([clear, np.full(len(taken), PAD), keep])
        self.blots = Blots(drawn, field, 0.7 * float(clear.min(initial=PAD)))
        self.reach = np.maximum(self.clear, np.where(self.kind < DOT, ROOM, 2 * ROOM))

    def places(self, which: Index, some: Tries, span: slice, led: bool) -> Places:
        """Return the free ones among the candidates of some labels, with leaders or without."""
        which, some, own, cost = self._promising(which, some, span)
        if not len(which):
            return NO_PLACES
        subjects = self.subjects.take(which)
        (x, y), (hx, hy) = np.moveaxis(some.centre, 2, 0), subjects.half.T[:, :, None]
        pairs = self._pairs(subjects, some)
        row, near = pairs.row, self.shapes.take(pairs.shape).upright()
        apart = separation(x[row], y[row], hx[row], hy[row], near)
        itself = pairs.shape == which[row] + len(self.kind) - len(self.subjects.gap)
        hard = np.where(itself, -NOWHERE, self.clear[pairs.shape])
        cost[np.logical_or.reduceat(apart < hard[:, None], pairs.start)] = np.inf
        if led:
            leader = leaders(some, subjects)
            cost += LEADER[subjects.line.astype(int), None]
            cost += self._toll(leader, cost < np.inf, pairs)
        else:
            leader = np.full((*x.shape, 4), NOWHERE)
            cost += self._doubt(subjects, own, apart, pairs)
        at = np.nonzero(cost < np.inf)
        hx, hy = subjects.half[at[0]].T
        return Places(which[at[0]], x[at], y[at], hx, hy, cost[at], leader[at])

    def _promising(
        self, which: Index, some: Tries, span: slice
    ) -> tuple[Index, Tries, Array, Array]:
        """Return labels, their nearest candidates, not surely taken, how far these are, the cost.

        A label without any is left out; one with few has infinite costs at the end of its row.
        """
        subjects = self.subjects.take(which)
        (x, y), (hx, hy) = np.moveaxis(some.centre, 2, 0), subjects.half.T[:, :, None]
        own = distance(x, y, hx, hy, segments(subjects.ends).upright())
        own -= subjects.radius[:, None]
        free = own >= subjects.gap[:, None] - TINY
        free &= (x - hx >= self.field[0]) & (x + hx <= self.field[2])
        free &= (y - hy >= self.field[1]) & (y + hy <= self.field[3])
        free &= ~self.blots.hit(x, y, hx, hy)
        cost = np.where(free, distance_cost(some, own, subjects), np.inf)
        count = free.sum(axis=1) - span.start
        left = np.flatnonzero(count > 0)
        rows, last = left[:, None], span.start + count.max()
        order = np.argsort(cost, axis=1, kind="stable")[left, span.start : min(span.stop, last)]
        order = np.where(np.isfinite(cost[rows, order]), order, order[:, :1])
        kept = Tries(*(column[rows, order] for column in some))
        cost, own = cost[rows, order], own[rows, order]
        cost[np.arange(order.shape[1]) >= count[rows]] = np.inf
        return which[left], kept, own, cost

    def _pairs(self, subjects: Subjects, some: Tries) -> Pairs:
        """Return the shapes near the places of each label; each has its own subject at least."""
        ends = np.concatenate([some.centre, some.root], axis=1)
        low, high = ends.min(axis=1), ends.max(axis=1)
        (x, y), (hx, hy) = (low + high).T / 2, (high - low).T / 2 + subjects.half.T
        near, reach = self.shapes, self.reach
        close = np.abs(x[:, None] - near.x) <= hx[:, None] + (near.ex + reach)
        close &= np.abs(y[:, None] - near.y) <= hy[:, None] + (near.ey + reach)
        row, shape = close.nonzero()
        apart = separation(x[row], y[row], hx[row], hy[row], near.take(shape)) <= reach[shape]
        row, shape = row[apart], shape[apart]
        start = np.searchsorted(row, np.arange(len(x)))
        return Pairs(row, shape, self._own(subjects, row, shape), start)

    def _own(self, subjects: Subjects, row: Index, shape: Index) -> Mask:
        """Return which shapes run through a whole subject or are a part of it."""
        zero = np.zeros(len(row))
        near, mine = self.shapes.take(shape), segments(subjects.ends).take(row)
        tips, ends = subjects.ends[row].T, self.ends[shape].T
        through = [separation(tips[k], tips[k + 1], zero, zero, near) for k in (0, 2)]
        part = [separation(ends[k], ends[k + 1], zero, zero, mine) for k in (0, 2)]
        inside = (np.maximum(*part) <= OWN) & (self.kind[shape] != BOX)
        return np.asarray((np.maximum(*through) <= subjects.radius[row] + OWN) | inside)

    def _doubt(self, subjects: Subjects, own: Array, apart: Array, pairs: Pairs) -> Array:
        """Return what places cost where a label may seem to name something else, or is cramped."""
        kind = subjects.line[pairs.row].astype(int), self.kind[pairs.shape]
        weight = np.where(pairs.own, 0.0, WEIGHT[kind])[:, None]
        short = (own[pairs.row] + MARGIN[kind][:, None] - apart) * weight
        doubt = np.maximum.reduceat(short, pairs.start).clip(0.0)
        room = np.where(pairs.own[:, None], ROOM, apart)
        air = np.minimum.reduceat(room, pairs.start).clip(0.0, ROOM)
        astray = ASTRAY * self._astray(subjects, own, apart, pairs)
        return np.asarray(doubt * (1.0 + doubt / 5.0) + AIR * (ROOM - air) + astray)

    def _astray(self, subjects: Subjects, own: Array, apart: Array, pairs: Pairs) -> Mask:
        """Return where a label is far from its own segment and nearer to another long one."""
        other = ~pairs.own & subjects.line[pairs.row] & self.long[pairs.shape]
        nearer = (apart < own[pairs.row]) & other[:, None]
        far = own > subjects.gap[:, None] + FAR_OFF
        return np.asarray(np.logical_or.reduceat(nearer, pairs.start) & far)

    def _toll(self, leader: Array, free: Mask, pairs: Pairs) -> Array:
        """Return what leaders cost: lines crossed or skirted; infinite across a box or a point."""
        kind = self.kind[pairs.shape]
        solid = np.where((kind == LINE) | pairs.own, -NOWHERE, self.clear[pairs.shape] - PAD / 2)
        at = _close(leader, free, pairs.row, self.shapes.take(pairs.shape), solid)
        toll = np.zeros(len(at[0]))
        path, shape = leader[pairs.row[at[0]], at[1]], pairs.shape[at[0]]
        which = np.flatnonzero((kind[at[0]] == LINE) | (kind[at[0]] == CORE))
        own = pairs.own[at[0][which]]
        toll[which] = self._brush(path[which], shape[which], own)
        which = np.flatnonzero(solid[at[0]] > 0)
        some, zero, near = path[which], np.zeros(1), self.shapes.take(shape[which])
        limit = solid[at[0][which]]
        hit = separation(near.x, near.y, near.ex, near.ey, segments(some)) < limit
        hit &= separation(some[:, 2], some[:, 3], zero, zero, near) > limit
        toll[which[hit]] = np.inf
        flat = np.bincount(pairs.row[at[0]] * free.shape[1] + at[1], toll, free.size)
        return np.asarray(flat, dtype=np.float64).reshape(free.shape)

    def _brush(self, path: Array, shape: Index, own: Mask) -> Array:
        """Return what it costs that leaders cross or run along these lines, a line for each."""
        line, zero = self.ends[shape], np.zeros(1)
        cosine, middle = cosines(path, line), (path[:, :2] + path[:, 2:]).T / 2
        toll = CROSSING * (1.0 + 2.0 * cosine * cosine) * (crossings(path, line) & ~own)
        along = np.flatnonzero(np.abs(cosine) > 0.94)
        near = self.shapes.take(shape[along])
        beside = separation(middle[0, along], middle[1, along], zero, zero, near) < 2 * OWN
        toll[along] += SKIRT * (beside | own[along])
        return np.asarray(toll)


def _close(
    leader: Array, free: Mask, row: Index, near: Shapes, solid: Array
) -> tuple[Index, Index]:
    """Return which pairs and columns have a leader that comes near the shape of the pair."""
    (ax, ay, bx, by), wide = np.moveaxis(leader, 2, 0), np.maximum(solid, 2 * OWN)
    left, right = (near.x - near.ex - wide)[:, None], (near.x + near.ex + wide)[:, None]
    top, bottom = (near.y - near.ey - wide)[:, None], (near.y + near.ey + wide)[:, None]
    close = np.maximum(ax, bx)[row] >= left
    close &= np.where(free, np.minimum(ax, bx), NOWHERE)[row] <= right
    close &= np.maximum(ay, by)[row] >= top
    close &= np.minimum(ay, by)[row] <= bottom
    return np.divmod(np.flatnonzero(close), close.shape[1])
