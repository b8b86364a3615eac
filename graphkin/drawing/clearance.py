"""The distances of labels from the drawing on a page, and the costs of their places; mm.

The candidate places of labels, and which of them exclude each other; lengths in mm.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property, lru_cache
from itertools import chain, pairwise
from math import acos, ceil, cos, degrees, radians, sin
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphkin.drawing.field import XY
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline
from graphkin.drawing.shapes import (
    HAIR,
    NOWHERE,
    TINY,
    Array,
    Box,
    Index,
    Mask,
    crossings,
    distance,
    joined,
    meeting,
    merged,
    overlap,
    pairs_of,
    rectangles,
    segments,
    separation,
    struck,
    where,
)

PAD = 0.6  # mm between a label and a box, point, leader or label above or below it
BESIDE = 1.2  # mm between adjacent labels in one line, so that they do not read as one
APART = HAIR[:, :, 0] + np.array([-BESIDE, -PAD, BESIDE, PAD], dtype=np.float32)[:, None]
WIDER = HAIR[:, :, 0] + np.array([-PAD, -PAD, PAD, PAD], dtype=np.float32)[:, None]


AT_ONCE = 512  # places compared with all others at once, to bound the memory used


class OpenPlaces(NamedTuple):
    """The candidate places, one row each, in mm; a leader NOWHERE means no leader."""

    label: Index
    x: Array  # centre
    y: Array
    hx: Array  # half extents of the label
    hy: Array
    cost: Array
    leader: Array  # x0, y0 at the label, x1, y1 at the subject

    def take(self, which: Index) -> OpenPlaces:
        """Return a selection of the places."""
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
    """Which places exclude each other."""

    def __init__(self) -> None:
        self.places = NO_PLACES
        self.table = np.zeros((0, 0), dtype=np.bool_)
        self.kept: list[int] = []

    def add(self, more: OpenPlaces) -> None:
        """Add places; the earlier ones keep their numbers."""
        self.places = self.places.joined(more)

    def rows(self) -> list[int]:
        """Return for each place the others that it excludes if a label is put there, as a bit mask.

        Places added since the last call are compared with all others here. Bits between places of
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
        """Find leaders that run into labels or cross other leaders, for places from ``old`` on.

        ``led`` are the numbers of the places with a leader.
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
        """Return the pairs, of a place and one with a leader, that are not yet known to clash."""
        other, label = led.take(nth), self.places.label
        known = self.table[np.maximum(one, other), np.minimum(one, other)]
        rest = where(~known & (label.take(one) != label.take(other)))
        return one.take(rest), nth.take(rest)


CELL = 0.8  # mm, cell size of the grid that excludes places quickly
OFF_MIDDLE = 4.0  # cost of a label at its segment's end; all costs are in mm of distance


class Subjects(NamedTuple):
    """The subjects of labels and the labels' sizes as arrays, one row per label; mm."""

    ends: Array  # x0, y0, x1, y1
    half: Array  # half extents of the label
    gap: Array
    radius: Array
    lean: Array  # preferred direction times the cost of a place perpendicular to it
    line: Mask  # the subject is a segment, not a point
    spare: Mask  # the label has no place rather than a leader across a strong line

    def take(self, which: Index) -> Subjects:
        """Return a selection of the subjects."""
        ends, half, gap, radius, lean = (column[which] for column in self[:5])
        return Subjects(ends, half, gap, radius, lean, self.line[which], self.spare[which])


class Tries(NamedTuple):
    """Candidate places, one row per subject and one column per candidate; mm."""

    x: Array  # centre of the label
    y: Array
    toward_x: Array  # unit direction from the subject to the label
    toward_y: Array
    root_x: Array  # the place on the subject that the label refers to
    root_y: Array


def tries(subjects: Subjects, near: Array, far: Array | None = None) -> Tries:
    """Return candidates at the distances ``near`` beyond the gap or, if given, at ``far``, in mm.

    The far ones are on rings around a point or around three places of a segment. The near ones are
    on rings around a point, or along both sides of the middle two thirds of a segment.
    """
    line = subjects.line
    if line.all():
        return _by_segments(subjects, near, far)
    if not line.any():
        return _by_points(subjects, near, far)
    points = _by_points(subjects.take(where(~line)), near, far)
    lines = _by_segments(subjects.take(where(line)), near, far)
    order = np.argsort(np.argsort(line, kind="stable"))
    both = zip(points, lines, strict=True)
    return Tries(*(np.concatenate(pair)[order] for pair in both))


def _by_points(subjects: Subjects, near: Array, far: Array | None) -> Tries:
    """Return candidates around points; mm."""
    x, y = subjects.ends.T[:2, :, None]
    return _rings(subjects, x, y, 0.0, *((20, near) if far is None else (36, far)))


def _by_segments(subjects: Subjects, near: Array, far: Array | None) -> Tries:
    """Return candidates at segments; mm."""
    start, end = subjects.ends.T[:2, :, None], subjects.ends.T[2:, :, None]
    if far is not None:
        x, y = start + (end - start) * np.array([0.5, 0.3, 0.7])
        return _rings(subjects, x, y, 0.0, 12, far)
    extent = np.minimum(np.abs(end - start) / 2, 3.0)
    x, y = (start + end) / 2
    both = zip(_sides(subjects, 7, near), _rings(subjects, x, y, extent, 24, near[:1]), strict=True)
    return Tries(*(np.concatenate(pair, axis=1) for pair in both))


@lru_cache(maxsize=8)
def _directions(angles: int, roots: int) -> Array:
    """Return unit vectors as rows x and y; each root gets its own interleaved directions."""
    turn = (np.arange(angles) * roots + np.arange(roots)[:, None]) * (2 * np.pi / angles / roots)
    return np.array([np.cos(turn), np.sin(turn)]).reshape(2, -1)


def _rings(
    subjects: Subjects, x: Array, y: Array, extent: Array | float, angles: int, steps: Array
) -> Tries:
    """Return places on rings around roots at x, y (n, a), each of half extent (2, n, 1); mm.

    The label's box slides around the root. An outward push restores the part of the gap that the
    sliding takes away next to the box's edges.
    """
    u = _directions(angles, x.shape[1])[:, None, :]
    reach = subjects.half.T[:, :, None] + extent
    slide = np.minimum(np.maximum(u * np.sqrt(2), -1), 1) * reach
    gap = (subjects.gap + subjects.radius)[:, None, None] + steps[:, None]
    short, along = (np.abs(slide) - reach)[:, :, None], np.abs(u)[:, :, None]
    edge = np.maximum(short + gap * along, 0.0)
    push = gap * gap / np.maximum(np.sqrt(edge[0] * edge[0] + edge[1] * edge[1]), TINY)
    roots = np.array([x, y]).repeat(angles, axis=2)
    centre = (roots + slide)[:, :, None] + push * u[:, :, None]
    return _flat(centre, u[:, :, None], roots[:, :, None])


def _sides(subjects: Subjects, count: int, steps: Array) -> Tries:
    """Return places along both sides of the middle two thirds of segments; mm."""
    x0, y0, x1, y1 = subjects.ends.T
    along = np.array([x1 - x0, y1 - y0])
    unit = along / np.maximum(np.sqrt((along * along).sum(axis=0)), TINY)
    normal = np.array([-unit[1], unit[0]])[:, :, None] * np.repeat([1.0, -1.0], count)
    support = (np.abs(unit[::-1]) * subjects.half.T).sum(axis=0)
    off = (support + subjects.gap)[:, None, None] + steps[:, None]
    share = np.tile(np.linspace(1 / 6, 5 / 6, count), 2)
    root = np.array([x0, y0])[:, :, None] + along[:, :, None] * share
    root, normal = root[:, :, None], normal[:, :, None]
    return _flat(root + normal * off, normal, root)


def _flat(*fields: Array) -> Tries:
    """Return the candidates of grids (2, n, steps, roots)."""
    whole = np.empty((len(fields), *fields[0].shape))
    for part, field in zip(whole, fields, strict=True):
        part[:] = field
    return Tries(*whole.reshape(2 * len(fields), whole.shape[2], -1))


def distance_cost(some: Tries, own: Array, subjects: Subjects) -> Array:
    """Return the cost of places from their distance, side and shift along a segment only."""
    (lean_x, lean_y), (x0, y0, x1, y1) = subjects.lean.T[:, :, None], subjects.ends.T[:, :, None]
    cost = own - subjects.gap[:, None] + np.sqrt(lean_x * lean_x + lean_y * lean_y)
    cost -= some.toward_x * lean_x + some.toward_y * lean_y
    off = np.abs(some.root_x - (x0 + x1) / 2) + np.abs(some.root_y - (y0 + y1) / 2)
    off /= np.maximum(np.abs(x1 - x0) + np.abs(y1 - y0), 10.0)
    cost += OFF_MIDDLE * off * off
    return np.asarray(cost)


class Blots:
    """Sample points along lines, counted on a grid, that exclude most occupied places quickly."""

    def __init__(self, lines: Array, field: Box, pad: float, cell: float = CELL) -> None:
        """Prepare for boxes in a field that must be ``pad`` mm clear of the lines.

        The grid's cells are at least ``cell`` mm wide.
        """
        self.pad, self.x, self.y = pad, field[0], field[1]
        wide, high = max(0.0, field[2] - field[0]), max(0.0, field[3] - field[1])
        self.cell = max(cell, wide / 600, high / 600)
        self.across, self.down = int(wide / self.cell) + 1, int(high / self.cell) + 1
        start, step = lines[:, :2].T, (lines[:, 2:] - lines[:, :2]).T
        count = np.ceil(np.abs(step).max(axis=0, initial=0.0) / self.cell).clip(1, 1000).astype(int)
        which = np.repeat(np.arange(len(lines)), count)
        share = (np.arange(len(which)) - (np.cumsum(count) - count)[which] + 0.5) / count[which]
        x, y = start.take(which, axis=1) + share * step.take(which, axis=1)
        x, y = x - self.x, y - self.y
        inside = (x >= 0) & (x < wide) & (y >= 0) & (y < high)
        width = self.across + 1
        row, column = ((at[inside] / self.cell).astype(int) + 1 for at in (y, x))
        marks = np.bincount(row * width + column, minlength=(self.down + 1) * width)
        self.below = marks.astype(np.int32).reshape(-1, width).cumsum(axis=1, dtype=np.int32)
        for above, row in pairwise(self.below):  # much faster than a sum along columns
            np.add(row, above, out=row)

    def hit(self, x: Array, y: Array, hx: Array | float, hy: Array | float) -> Mask:
        """Return which boxes are certainly too near to a line."""
        wide, high = hx + self.pad, hy + self.pad
        left, right = self._cells(x - wide - self.x, x + wide - self.x, self.across)
        top, bottom = self._cells(y - high - self.y, y + high - self.y, self.down)
        width, below = self.across + 1, self.below.reshape(-1)
        top, bottom = top * width, bottom * width
        count = below.take(bottom + right) - below.take(bottom + left)
        count += below.take(top + left) - below.take(top + right)
        return np.asarray(count > 0)

    def _cells(self, low: Array, high: Array, most: int) -> tuple[Index, Index]:
        """Return the first cells entirely beyond ``low``, and the cells of ``high``."""
        first = np.minimum(np.maximum(np.ceil(low / self.cell), 0), most).astype(np.intp)
        return first, np.maximum(first, np.minimum(high / self.cell, most).astype(np.intp))


# --- the distances of labels from the drawing, and the costs of their places (mm) -----------------


OWN = 0.4  # mm within which a drawn line counts as the subject itself
ROOM = 1.4  # mm of free space around a label beyond which more is no improvement
LEADER = np.array([6.0, 3.7])  # cost of a leader to a point and to a segment; costs are in mm
CROSSING = 0.9  # cost of a line that a leader crosses
STRONG = 30.0  # extra cost if that line is a link, a guide or a vector
LONGEST = 15.0  # mm, of a leader
SKIRT = 2.5  # cost of a line that a leader runs along
ASTRAY = 4.0  # cost of a label FAR_OFF from its segment and nearer to another, LONG one
FAR_OFF, LONG = 2.5, 24.0  # mm; FAR_OFF is beyond the gap
BEYOND = 8.0  # cost of another line between a label and its segment
SLANT = 0.34  # sine of the angle to a line below which a leader runs along it
AIR = 0.7  # cost per mm of missing free space
PART = 2048  # candidates compared with the drawing at once; a multiple of TOGETHER
FEW = 8  # up to this many labels, candidates are compared with the drawing directly

# Kinds of shapes. MARGIN: how much farther (mm) than a label's own subject each kind should be.
# WEIGHT: the cost per missing mm. Rows: the labels of points, then those of segments.
LINE, BOX, DOT, CORE = range(4)
MARGIN = np.array([[0.3, -NOWHERE, 1.5, 0.3], [0.8, -NOWHERE, 1.5, 2.0]])
WEIGHT = np.array([[0.4, 0.0, 2.5, 0.5], [2.0, 0.0, 0.7, 1.5]])


class Open(NamedTuple):
    """Candidates that are not excluded yet, one row each; mm."""

    label: Index
    x: Array  # centre
    y: Array
    hx: Array  # half extents of the label
    hy: Array
    cost: Array
    own: Array  # distance from the label's own subject
    root_x: Array  # the place on the subject that the label refers to
    root_y: Array

    def take(self, which: Index) -> Open:
        """Return a selection of the candidates."""
        return Open(self.label.take(which), *np.array(self[1:]).take(which, axis=1))

    def boxes(self, more: Array | float = 0.0) -> Array:
        """Return the labels' boxes as rows left, top, right, bottom, widened by a length in mm."""
        wide, high = self.hx + more, self.hy + more
        return np.array([self.x - wide, self.y - high, self.x + wide, self.y + high])

    def leaders(self, radius: Array) -> Array:
        """Return leaders to the subjects from 0.5 mm off the labels' boxes, aimed at the centres.

        They end at circles of a radius in mm; the columns are x0, y0, x1, y1.
        """
        way_x, way_y = self.root_x - self.x, self.root_y - self.y
        length = np.maximum(np.sqrt(way_x * way_x + way_y * way_y), TINY)
        share_x = (self.hx + 0.5) / np.maximum(np.abs(way_x), TINY)
        share = np.minimum(share_x, (self.hy + 0.5) / np.maximum(np.abs(way_y), TINY))
        back = radius / length
        ends = self.root_x - way_x * back, self.root_y - way_y * back
        return np.array([self.x + way_x * share, self.y + way_y * share, *ends]).T.copy()


def in_parts(work: Callable[[Open], NDArray[Any]], some: Open) -> NDArray[Any]:
    """The results of ``work`` for candidates, computed in parts to bound the memory used."""
    if len(some.label) <= PART:
        return work(some)
    every = np.arange(len(some.label))
    parts = (every[start : start + PART] for start in range(0, len(every), PART))
    return np.concatenate([work(some.take(part)) for part in parts])


class Clearance:
    """The shapes that labels must keep clear of, and the costs of their places."""

    def __init__(
        self,
        subjects: Subjects,
        lines: ArrayLike,
        boxes: ArrayLike,
        field: ArrayLike,
        stroke: ArrayLike,
        strong: ArrayLike = (),
    ) -> None:
        """Prepare for labels that stay in a common field, or each in its own.

        Raises ValueError where a line, a box or a subject is not finite.
        """
        drawn, taken = (np.asarray(a, dtype=np.float64).reshape(-1, 4) for a in (lines, boxes))
        if not all(np.isfinite(ends).all() for ends in (drawn, taken, subjects.ends)):
            raise ValueError("a line, a box or a subject of a label is not finite")
        clear = np.broadcast_to(np.asarray(stroke, dtype=np.float64), len(drawn))
        drawn, clear = merged(drawn, clear)
        start, end = subjects.ends[:, :2], subjects.ends[:, 2:]
        core = np.concatenate([start + (end - start) / 6, end - (end - start) / 6], axis=1)
        self.subjects = subjects
        self.strong = np.asarray(strong, dtype=np.float64).reshape(-1, 4)
        self.field = np.broadcast_to(np.asarray(field, dtype=np.float64), (len(start), 4))
        self.sides = np.concatenate([drawn, taken, core]).T.copy()
        self.shapes = joined(segments(drawn), rectangles(taken), segments(core))
        kinds = [np.full(len(drawn), LINE), np.full(len(taken), BOX)]
        self.kind = np.concatenate([*kinds, np.where(subjects.line, CORE, DOT)])
        self.first = len(drawn) + len(taken)  # number of the first of the labels' own subjects
        self.long = (np.hypot(self.shapes.ex, self.shapes.ey) > LONG / 2) & (self.kind != BOX)
        keep = np.where(subjects.line, -NOWHERE, subjects.radius + PAD)
        self.clear = np.concatenate([clear, np.full(len(taken), PAD), keep])
        self.own = self._owned()
        self.drawn, self.pad = drawn, 0.7 * float(clear.min(initial=PAD))

    @cached_property
    def blots(self) -> Blots:
        """Samples along the drawing, which quickly exclude most candidates of many labels."""
        low, high = self.field[:, :2].min(axis=0), self.field[:, 2:].max(axis=0)
        whole = float(low[0]), float(low[1]), float(high[0]), float(high[1])
        return Blots(self.drawn, whole, self.pad)

    def near(self, some: Open) -> OpenPlaces:
        """Return candidates as places without a leader."""
        leader = np.full((len(some.label), 4), NOWHERE)
        return OpenPlaces(*some[:5], some.cost + in_parts(self._doubt, some), leader)

    def led(self, some: Open) -> OpenPlaces:
        """Return candidates as places with a leader that meets no box and no other point.

        The costs of crossing lines or running along them are added.
        """
        leader = some.leaders(self.subjects.radius.take(some.label))
        toll = LEADER[self.subjects.line.take(some.label).astype(int)] + self._toll(some, leader)
        places = OpenPlaces(*some[:5], some.cost + toll, leader)
        return places.take(where(np.isfinite(toll)))

    def open(self, which: Index, some: Tries, first: Index, last: Index) -> Open:
        """Return the free candidates of labels.

        For each label, its candidates from ``first`` to before ``last`` are examined, by increasing
        cost.
        """
        subjects = self.subjects.take(which)
        x, y, (hx, hy) = some.x, some.y, subjects.half.T[:, :, None]
        own = distance(x, y, hx, hy, segments(subjects.ends).upright())
        own -= subjects.radius[:, None]
        free = own >= subjects.gap[:, None] - TINY
        left, top, right, bottom = self.field[which].T[:, :, None]
        free &= (x - hx >= left) & (x + hx <= right)
        free &= (y - hy >= top) & (y + hy <= bottom)
        if len(self.subjects.gap) > FEW:
            free &= ~self.blots.hit(x, y, hx, hy)
        cost = np.where(free, distance_cost(some, own, subjects), np.inf)
        order = np.argsort(cost, axis=1, kind="stable")
        order += np.arange(len(which))[:, None] * cost.shape[1]
        rank = np.arange(cost.shape[1])
        at = order[(rank >= first[:, None]) & (rank < last[:, None])]
        at = at.take(where(np.isfinite(cost.take(at))))
        row = at // cost.shape[1]
        columns = (column.take(at) for column in (cost, own, some.root_x, some.root_y))
        wide, high = subjects.half[row].T
        found = Open(which[row], x.take(at), y.take(at), wide, high, *columns)
        return found.take(where(in_parts(self._clear_of_all, found)))

    def _clear_of_all(self, some: Open) -> Mask:
        """Return which candidates are as far from all shapes as they must be."""
        clear = self.clear
        place, shape = meeting(some.boxes(), self.shapes.boxes(clear))
        other = where(shape != some.label.take(place) + self.first)
        place, shape = place.take(other), shape.take(other)
        near = where(self._apart(some, place, shape) < clear.take(shape))
        free = np.ones(len(some.label), dtype=np.bool_)
        free[place.take(near)] = False
        return free

    def _apart(self, some: Open, place: Index, shape: Index) -> Array:
        """Return the distances between candidates and shapes, one pair per row."""
        x, y, hx, hy = (column.take(place) for column in some[1:5])
        return separation(x, y, hx, hy, self.shapes.take(shape))

    def _owned(self) -> Mask:
        """Return which shapes (columns) run through a label's whole subject or are part of it."""
        ends, wide = self.subjects.ends, self.subjects.radius + OWN
        low, high = np.minimum(ends[:, :2], ends[:, 2:]).T, np.maximum(ends[:, :2], ends[:, 2:]).T
        label, shape = meeting(np.concatenate([low - wide, high + wide]), self.shapes.boxes(0.0))
        zero = np.zeros(len(label))
        near, mine = self.shapes.take(shape), segments(ends).take(label)
        tips, ends = ends[label].T, self.sides.take(shape, axis=1)
        through = [separation(tips[k], tips[k + 1], zero, zero, near) for k in (0, 2)]
        part = [separation(ends[k], ends[k + 1], zero, zero, mine) for k in (0, 2)]
        own = (np.maximum(*part) <= OWN) & (self.kind[shape] != BOX)
        own |= np.maximum(*through) <= wide[label]
        table = np.zeros((len(wide), len(self.kind)), dtype=np.bool_)
        table[label[own], shape[own]] = True
        return table

    def _is_own(self, label: Index, shape: Index) -> Mask:
        """Return which shapes are a label's own subject, one pair per row."""
        return np.asarray(self.own.take(label * len(self.kind) + shape))

    def _doubt(self, some: Open) -> Array:
        """Return the costs of places where a label is ambiguous or cramped."""
        far = np.maximum(ROOM, some.own)
        more = np.maximum(MARGIN.max(axis=0), 0.0).take(self.kind)
        place, shape = meeting(some.boxes(far), self.shapes.boxes(more))
        apart, label = self._apart(some, place, shape), some.label.take(place)
        near = apart < far.take(place) + more.take(shape)
        other = where(near & ~self._is_own(label, shape))
        place, shape, label = place.take(other), shape.take(other), label.take(other)
        apart = apart.take(other)
        own, line = some.own.take(place), self.subjects.line.take(label)
        kind = self.kind.take(shape) + len(MARGIN[0]) * line
        doubt, air = np.zeros(len(some.own)), np.full(len(some.own), ROOM)
        np.maximum.at(doubt, place, (own + MARGIN.take(kind) - apart) * WEIGHT.take(kind))
        np.minimum.at(air, place, np.maximum(apart, 0.0))
        nearer = where((apart < own) & line)
        place, shape = place.take(nearer), shape.take(nearer)
        astray, beyond = np.zeros((2, len(some.own)), dtype=np.bool_)
        astray[place.take(where(self.long.take(shape)))] = True
        astray &= some.own > self.subjects.gap.take(some.label) + FAR_OFF
        beyond[place.take(where(self._between(some, place, shape)))] = True
        doubt += doubt * doubt / 5.0
        return np.asarray(doubt + AIR * (ROOM - air) + ASTRAY * astray + BEYOND * beyond)

    def _between(self, some: Open, place: Index, shape: Index) -> Mask:
        """Return which lines run between a label and its subject, one pair per row."""
        x, y, root_x, root_y = (
            column.take(place) for column in (some.x, some.y, some.root_x, some.root_y)
        )
        ways = np.array([x, y, root_x, root_y]).T
        crossed = crossings(ways, self.sides.take(shape, axis=1).T)
        return np.asarray(crossed & (self.kind.take(shape) != BOX))

    def _toll(self, some: Open, leader: Array) -> Array:
        """Return the costs of leaders that cross or follow lines.

        They are infinite at a box or a point, for a leader that is too long, and where that of a
        spare label crosses a strong line.
        """
        columns = leader.T.copy()
        x0, y0, x1, y1 = columns
        ways = np.minimum(x0, x1), np.minimum(y0, y1), np.maximum(x0, x1), np.maximum(y0, y1)
        wide = np.maximum(self.clear - PAD / 2, 2 * OWN)
        place, shape = meeting(np.array(ways), self.shapes.boxes(wide))
        path = columns.take(place, axis=1)
        off = self._off(path, shape)
        near = (off[0] * off[1] <= 0) | (np.abs(off).min(axis=0) <= wide.take(shape))
        near = where(near)
        place, shape = place.take(near), shape.take(near)
        path, off = path.take(near, axis=1), off.take(near, axis=1)
        own, kind = self._is_own(some.label.take(place), shape), self.kind.take(shape)
        line = (kind == LINE) | (kind == CORE)
        toll = np.where(line, self._brush(path, shape, off, own), 0.0)
        limit = self.clear.take(shape) - PAD / 2
        which = where((kind != LINE) & ~own & (limit > 0))
        path, solid = path.take(which, axis=1), self.shapes.take(shape.take(which))
        limit, zero = limit.take(which), np.zeros(1)
        hit = separation(solid.x, solid.y, solid.ex, solid.ey, segments(path.T)) < limit
        hit &= separation(path[2], path[3], zero, zero, solid) > limit
        toll[which.take(where(hit))] = np.inf
        crossed, spare = struck(leader, self.strong), self.subjects.spare.take(some.label)
        every = np.bincount(place, toll, len(leader)) + STRONG * crossed
        every[where(spare & (crossed > 0))] = np.inf
        every[where(np.hypot(columns[2] - columns[0], columns[3] - columns[1]) > LONGEST)] = np.inf
        return np.asarray(every, dtype=np.float64)

    def _off(self, path: Array, shape: Index) -> Array:
        """Return the signed distances in mm of both ends of leaders from shapes.

        ``path`` has the leaders' x0, y0, x1, y1 as rows.
        """
        near = self.shapes
        x, y, nx, ny = (column.take(shape) for column in (near.x, near.y, near.nx, near.ny))
        x0, y0, x1, y1 = path
        return np.array([nx * (x0 - x) + ny * (y0 - y), nx * (x1 - x) + ny * (y1 - y)])

    def _brush(self, path: Array, shape: Index, off: Array, own: Mask) -> Array:
        """Return the costs of leaders that cross or run along these lines, one line per leader."""
        x0, y0, x1, y1 = path
        length = np.maximum(np.sqrt((x1 - x0) ** 2 + (y1 - y0) ** 2), TINY)
        sine = (off[1] - off[0]) / length
        toll = np.zeros(len(shape))
        cross = where((off[0] * off[1] <= 0) & ~own)
        ends = self.sides.take(shape.take(cross), axis=1)
        cross = cross.take(where(crossings(path.take(cross, axis=1).T, ends.T)))
        across = sine.take(cross)
        toll[cross] = CROSSING * (3.0 - 2.0 * across * across)
        beside = (np.abs(sine) < SLANT) & (self.shapes.slack.take(shape) == 0)
        along = where(beside & (own | (np.abs(off[0] + off[1]) < 4 * OWN)))
        near, zero = self.shapes.take(shape.take(along)), np.zeros(1)
        x, y = (x0 + x1).take(along) / 2, (y0 + y1).take(along) / 2
        skirts = own.take(along) | (separation(x, y, zero, zero, near) < 2 * OWN)
        toll[along.take(where(skirts))] += SKIRT
        return np.asarray(toll)


# --- marks as straight pieces, for the search for free places of labels and details ---------------


SAGITTA = 0.05
"""The largest distance of an arc from the chords that replace it, in mm."""


def pieces_of(marks: Iterable[Mark]) -> Array:
    """The straight pieces of marks, as rows x0, y0, x1, y1."""
    found = [piece for mark in marks for piece in chords_of(mark)]
    return np.fromiter(chain.from_iterable(found), np.float64, 4 * len(found)).reshape(-1, 4)


def chords_of(mark: Mark) -> Sequence[tuple[float, float, float, float]]:
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
    """The chords between consecutive points."""
    return [(*points[i], *points[i + 1]) for i in range(len(points) - 1)]


@lru_cache(maxsize=4096)
def arc_chords(
    x: float, y: float, r: float, start: float, end: float
) -> tuple[tuple[float, float, float, float], ...]:
    """Chords of an arc, short enough to be within SAGITTA of it."""
    widest = 2 * degrees(acos(max(1 - SAGITTA / r, 0.5))) if r > 0 else 120.0
    count = max(2, ceil(abs(end - start) / widest))
    angles = (radians(start + (end - start) * i / count) for i in range(count + 1))
    return tuple(chained([(x + r * cos(a), y - r * sin(a)) for a in angles]))
