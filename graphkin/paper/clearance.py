"""How far labels are from what is drawn on a page, and what their places cost (mm)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
Box = tuple[float, float, float, float]
TINY = 1e-9  # mm
NOWHERE = 1e9  # mm, where that is which has no place

PAD = 0.6  # mm between a label and a taken box, a point, a leader or a label above or below it
BESIDE = 1.2  # mm between labels side by side, so that they do not read as one
OWN = 0.4  # mm within which a drawn line is taken for the subject itself
ROOM = 1.4  # mm of air around a label beyond which more is no better
LEADER = 2.5  # what a leader costs; all costs are in mm of distance
CROSSING = 0.9  # a line that a leader crosses
SKIRT = 2.5  # a line that a leader runs along
AIR = 0.7  # each mm of air that is missing
OFF_MIDDLE = 4.0  # a segment's label at the segment's end

# Kinds of shapes; how far (mm) each should be beyond a label's own subject, and the cost of each
# mm that is missing, for the labels of points and of segments.
LINE, BOX, DOT, CORE = range(4)
MARGIN = np.array([[0.3, -NOWHERE, 1.5, 0.3], [0.8, -NOWHERE, 1.5, 2.0]])
WEIGHT = np.array([[0.4, 0.0, 1.5, 0.5], [1.1, 0.0, 0.7, 1.5]])


class Shapes(NamedTuple):
    """Segments, points and upright rectangles in one form, lengths in mm."""

    x: Array  # centre
    y: Array
    ex: Array  # half extents
    ey: Array
    nx: Array  # unit normal of a segment, zero for the others
    ny: Array
    slack: Array  # takes the test across the normal out where there is none

    def take(self, which: Index | Mask) -> Shapes:
        """Return some of the shapes."""
        return Shapes(*(column[which] for column in self))

    def upright(self) -> Shapes:
        """Return the shapes as columns, for arrays with a row for each."""
        return Shapes(*(column[:, None] for column in self))


def segments(ends: ArrayLike) -> Shapes:
    """Return segments given as rows x0, y0, x1, y1 in mm; one without length is a point."""
    x0, y0, x1, y1 = np.asarray(ends, dtype=np.float64).reshape(-1, 4).T
    dx, dy = x1 - x0, y1 - y0
    length = np.sqrt(dx * dx + dy * dy)
    none = length < TINY
    scale = np.where(none, 0.0, 1.0 / np.where(none, 1.0, length))
    slack = np.where(none, NOWHERE, 0.0)
    half = np.abs(dx) / 2, np.abs(dy) / 2
    return Shapes((x0 + x1) / 2, (y0 + y1) / 2, *half, -dy * scale, dx * scale, slack)


def rectangles(boxes: ArrayLike) -> Shapes:
    """Return rectangles given as rows xmin, ymin, xmax, ymax in mm."""
    x0, y0, x1, y1 = np.asarray(boxes, dtype=np.float64).reshape(-1, 4).T
    zero = np.zeros_like(x0)
    half = np.abs(x1 - x0) / 2, np.abs(y1 - y0) / 2
    return Shapes((x0 + x1) / 2, (y0 + y1) / 2, *half, zero, zero, zero + NOWHERE)


def joined(*parts: Shapes) -> Shapes:
    """Return the shapes of several sets as one set."""
    return Shapes(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def separation(x: Array, y: Array, hx: Array, hy: Array, other: Shapes) -> Array:
    """Return a length in mm never above the distance of boxes from shapes, below 0 if they meet.

    The boxes have centre x, y and half extents hx, hy; all arguments broadcast. It is the largest
    gap along x, along y or across a segment: short of the distance only between corners.
    """
    dx, dy = other.x - x, other.y - y
    across = other.nx * dx
    across += other.ny * dy
    np.abs(across, out=across)
    across -= hx * np.abs(other.nx) + hy * np.abs(other.ny) + other.slack
    np.maximum(across, np.abs(dx) - (other.ex + hx), out=across)
    return np.maximum(across, np.abs(dy) - (other.ey + hy), out=across)


def distance(x: Array, y: Array, hx: Array, hy: Array, other: Shapes) -> Array:
    """Return the same as `separation`, but the distance itself at the corners too."""
    dx = np.maximum(np.abs(other.x - x) - (other.ex + hx), 0.0)
    dy = np.maximum(np.abs(other.y - y) - (other.ey + hy), 0.0)
    return np.asarray(np.maximum(np.sqrt(dx * dx + dy * dy), separation(x, y, hx, hy, other)))


def meetings(one: Array, other: Array) -> tuple[Mask, Array]:
    """Return where segments cross and the cosines between them; rows x0, y0, x1, y1 broadcast."""
    ux, uy = one[..., 2] - one[..., 0], one[..., 3] - one[..., 1]
    vx, vy = other[..., 2] - other[..., 0], other[..., 3] - other[..., 1]
    gx, gy = other[..., 0] - one[..., 0], other[..., 1] - one[..., 1]
    turn = ux * vy - uy * vx
    size, sign = np.abs(turn), np.sign(turn)
    s, t = (gx * vy - gy * vx) * sign, (gx * uy - gy * ux) * sign
    hit = (size > 0) & (s >= 0) & (s <= size) & (t >= 0) & (t <= size)
    lengths = np.sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy))
    return hit, (ux * vx + uy * vy) / np.maximum(lengths, TINY)


class Subjects(NamedTuple):
    """The subjects of labels and the labels' sizes as arrays, a row for each; mm."""

    ends: Array  # x0, y0, x1, y1
    half: Array  # half extents of the label
    gap: Array
    radius: Array
    lean: Array  # preferred direction times the cost of a place square to it
    line: Mask  # the subject is a segment, not a point

    def take(self, which: Index) -> Subjects:
        """Return some of the subjects."""
        ends, half, gap, radius, lean = (column[which] for column in self[:5])
        return Subjects(ends, half, gap, radius, lean, self.line[which])


class Tries(NamedTuple):
    """Candidate places, a row for each subject and a column for each candidate; mm."""

    centre: Array  # of the label, (n, k, 2)
    toward: Array  # unit direction from the subject to the label, (n, k, 2)
    root: Array  # the place on the subject that is meant, (n, k, 2)


class Places(NamedTuple):
    """The places that are open, a row for each; a leader NOWHERE is none; mm."""

    label: Index
    x: Array  # centre
    y: Array
    hx: Array  # half extents of the label
    hy: Array
    cost: Array
    leader: Array  # x0, y0 at the label, x1, y1 at the subject


class Clashes:
    """Which places rule each other out, found when first asked for."""

    def __init__(self, places: Places) -> None:
        self.places = places
        self.led = np.flatnonzero(places.leader[:, 0] < NOWHERE)
        self.path = segments(places.leader[self.led])
        self.known: dict[int, Mask] = {}

    def of(self, k: int) -> Mask:
        """Return which places the place k rules out if a label sits there."""
        if k not in self.known:
            self.known[k] = self._found(k)
        return self.known[k]

    def _found(self, k: int) -> Mask:
        """Compare a place with all others."""
        label, x, y, hx, hy, _, leader = self.places
        clash = np.abs(x - x[k]) < hx + (hx[k] + BESIDE)
        clash &= np.abs(y - y[k]) < hy + (hy[k] + PAD)
        if len(self.led):
            clash[self.led] |= separation(x[k], y[k], hx[k], hy[k], self.path) < PAD
            if leader[k, 0] < NOWHERE:
                clash |= separation(x, y, hx, hy, segments(leader[k])) < PAD
                clash[self.led] |= meetings(leader[k], leader[self.led])[0]
        return np.asarray(clash & (label != label[k]))


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
        start, end = subjects.ends[:, :2], subjects.ends[:, 2:]
        core = np.concatenate([start + (end - start) / 6, end - (end - start) / 6], axis=1)
        self.subjects, self.field = subjects, field
        self.ends = np.concatenate([drawn, taken, core])
        if not np.isfinite(self.ends).all():
            raise ValueError("a line, a box or a subject of a label is not finite")
        self.shapes = joined(segments(drawn), rectangles(taken), segments(core))
        kinds = [np.full(len(drawn), LINE), np.full(len(taken), BOX)]
        self.kind = np.concatenate([*kinds, np.where(subjects.line, CORE, DOT)])
        keep = np.where(subjects.line, -NOWHERE, subjects.radius + PAD)
        clear = np.broadcast_to(np.asarray(stroke, dtype=np.float64), len(drawn))
        self.clear = np.concatenate([clear, np.full(len(taken), PAD), keep])
        self.reach = np.maximum(self.clear, np.where(self.kind < DOT, ROOM, 2 * ROOM))

    def places(self, which: Index, some: Tries, led: bool) -> Places:
        """Return the free ones among the candidates of some labels, with leaders or without."""
        subjects = self.subjects.take(which)
        (x, y), (hx, hy) = np.moveaxis(some.centre, 2, 0), subjects.half.T[:, :, None]
        own = distance(x, y, hx, hy, segments(subjects.ends).upright())
        own -= subjects.radius[:, None]
        pairs = self._pairs(subjects, some)
        row, near = pairs.row, self.shapes.take(pairs.shape).upright()
        apart = separation(x[row], y[row], hx[row], hy[row], near)
        itself = pairs.shape == which[row] + len(self.kind) - len(self.subjects.gap)
        hard = np.where(itself, -NOWHERE, self.clear[pairs.shape])
        free = ~np.logical_or.reduceat(apart < hard[:, None], pairs.start)
        free &= (x - hx >= self.field[0]) & (x + hx <= self.field[2])
        free &= (y - hy >= self.field[1]) & (y + hy <= self.field[3])
        free &= own >= subjects.gap[:, None] - TINY
        leader = _leaders(some, subjects) if led else np.full((*x.shape, 4), NOWHERE)
        cost = np.where(free, distance_cost(some, own, subjects), np.inf)
        if led:
            for i, part in enumerate(np.split(np.arange(len(row)), pairs.start[1:])):
                toll = self._toll(leader[i, free[i]], pairs.shape[part], pairs.own[part])
                cost[i, free[i]] += toll
        else:
            cost += self._doubt(subjects, own, apart, pairs)
        at = np.nonzero(np.isfinite(cost))
        hx, hy = subjects.half[at[0]].T
        return Places(which[at[0]], x[at], y[at], hx, hy, cost[at], leader[at])

    def _pairs(self, subjects: Subjects, some: Tries) -> Pairs:
        """Return the shapes near the places of each label; each has its own subject at least."""
        ends = np.concatenate([some.centre, some.root], axis=1)
        low, high = ends.min(axis=1), ends.max(axis=1)
        (x, y), (hx, hy) = (low + high).T / 2, (high - low).T / 2 + subjects.half.T
        apart = separation(x[:, None], y[:, None], hx[:, None], hy[:, None], self.shapes)
        row, shape = np.nonzero(apart <= self.reach)
        start = np.searchsorted(row, np.arange(len(x)))
        return Pairs(row, shape, self._own(subjects, row, shape), start)

    def _own(self, subjects: Subjects, row: Index, shape: Index) -> Mask:
        """Return which shapes run through a whole subject or are a part of it."""
        zero = np.zeros(len(row))
        near, mine = self.shapes.take(shape), segments(subjects.ends[row])
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
        return np.asarray(doubt * (1.0 + doubt / 5.0) + AIR * (ROOM - air))

    def _toll(self, leader: Array, shape: Index, own: Mask) -> Array:
        """Return what leaders cost: lines crossed or skirted; infinite across a box or a point."""
        near, kind, zero = self.shapes.take(shape), self.kind[shape], np.zeros(1)
        hit, cosine = meetings(leader[:, None], self.ends[shape])
        middle, root = (leader[:, :2] + leader[:, 2:])[..., None] / 2, leader[:, 2:, None]
        beside = separation(middle[:, 0], middle[:, 1], zero, zero, near) < 2 * OWN
        toll = np.where(hit & ~own, CROSSING * (1.0 + 2.0 * cosine * cosine), 0.0)
        toll += np.where((np.abs(cosine) > 0.94) & (beside | own), SKIRT, 0.0)
        toll[:, (kind == BOX) | (kind == DOT)] = 0.0
        solid = np.where((kind == LINE) | own, -NOWHERE, self.clear[shape] - PAD / 2)
        path = segments(leader).upright()
        through = separation(near.x, near.y, near.ex, near.ey, path) < solid
        away = separation(root[:, 0], root[:, 1], zero, zero, near) > solid
        toll[through & away] = np.inf
        return np.asarray(LEADER + toll.sum(axis=1))


def distance_cost(some: Tries, own: Array, subjects: Subjects) -> Array:
    """Return what places cost by their distance, side and shift along a segment alone."""
    lean = subjects.lean[:, None, :]
    size = np.sqrt((lean * lean).sum(-1))
    start, end = subjects.ends[:, None, :2], subjects.ends[:, None, 2:]
    off = np.abs(some.root - (start + end) / 2).sum(-1)
    span = np.maximum(np.abs(end - start).sum(-1), 10.0)
    cost = own - subjects.gap[:, None] + size - (some.toward * lean).sum(-1)
    return np.asarray(cost + OFF_MIDDLE * (off / span) ** 2)


def _leaders(some: Tries, subjects: Subjects) -> Array:
    """Return leaders from 0.5 mm off the labels' boxes, aimed at their centres, to the subjects."""
    way = some.root - some.centre
    length = np.sqrt((way * way).sum(-1, keepdims=True)).clip(TINY)
    root = some.root - way / length * subjects.radius[:, None, None]
    share = (subjects.half[:, None] + 0.5) / np.abs(way).clip(TINY)
    start = some.centre + way * share.min(axis=-1, keepdims=True)
    return np.concatenate([start, root], axis=-1)
