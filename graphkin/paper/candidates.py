"""Shapes on a page, how far apart they are, and where labels might sit among them (mm)."""

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

SHORT = 1.5  # mm, lines shorter than this together may be taken for one
LOOSE = 0.06  # mm by which such a one may miss the others
CELL = 0.8  # mm, of the grid that rules places out at a glance
OFF_MIDDLE = 4.0  # cost of a segment's label at the segment's end; all costs are in mm of distance


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


def merged(lines: Array, clear: Array) -> tuple[Array, Array]:
    """Return chains of tiny lines as fewer ones, each with more clearance to make up for it; mm."""
    loose = np.zeros(len(lines))
    for _ in range(3):
        first, off = _joints(lines, clear, loose)
        lines, loose = lines.copy(), loose.copy()
        lines[first, 2:], loose[first] = lines[first + 1, 2:], off[first]
        rest = np.ones(len(lines), dtype=np.bool_)
        rest[first + 1] = False
        lines, loose, clear = lines[rest], loose[rest], clear[rest]
    return lines, clear + loose


def _joints(lines: Array, clear: Array, loose: Array) -> tuple[Index, Array]:
    """Return which lines can be one with the next, and how far (mm) that one misses the two."""
    linked = (lines[:-1, 2:] == lines[1:, :2]).all(axis=1) & (clear[:-1] == clear[1:])
    (cx, cy), (lx, ly) = (lines[1:, 2:] - lines[:-1, :2]).T, (lines[:-1, 2:] - lines[:-1, :2]).T
    size, along = np.sqrt(cx * cx + cy * cy), lx * cx + ly * cy
    off = np.abs(lx * cy - ly * cx) / size.clip(TINY) + np.maximum(loose[:-1], loose[1:])
    place = np.arange(len(linked))
    nth = place - np.maximum.accumulate(np.where(linked, 0, place + 1))
    linked &= (size > TINY) & (size < SHORT) & (off <= LOOSE)
    linked &= (along >= 0) & (along <= size * size)
    return np.flatnonzero(linked & (nth % 2 == 0)), off


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


def met(boxes: ArrayLike, lines: Shapes) -> int:
    """Return how many times segments run into boxes given as rows xmin, ymin, xmax, ymax in mm."""
    x, y, hx, hy = rectangles(boxes).upright()[:4]
    return int((separation(x, y, hx, hy, lines) < 0).sum())


def distance(x: Array, y: Array, hx: Array, hy: Array, other: Shapes) -> Array:
    """Return the same as `separation`, but the distance itself at the corners too."""
    dx = np.maximum(np.abs(other.x - x) - (other.ex + hx), 0.0)
    dy = np.maximum(np.abs(other.y - y) - (other.ey + hy), 0.0)
    return np.asarray(np.maximum(np.sqrt(dx * dx + dy * dy), separation(x, y, hx, hy, other)))


def crossings(one: Array, other: Array) -> Mask:
    """Return where segments cross or touch; rows x0, y0, x1, y1 broadcast."""
    ux, uy = one[..., 2] - one[..., 0], one[..., 3] - one[..., 1]
    vx, vy = other[..., 2] - other[..., 0], other[..., 3] - other[..., 1]
    gx, gy = other[..., 0] - one[..., 0], other[..., 1] - one[..., 1]
    turn = ux * vy - uy * vx
    size, sign = np.abs(turn), np.sign(turn)
    s, t = (gx * vy - gy * vx) * sign, (gx * uy - gy * ux) * sign
    return np.asarray(
        (size > 0) & (np.minimum(s, t) >= 0) & (np.maximum(s, t) <= size), dtype=np.bool_
    )


def cosines(one: Array, other: Array) -> Array:
    """Return the cosines between segments; rows x0, y0, x1, y1."""
    ux, uy = one[:, 2] - one[:, 0], one[:, 3] - one[:, 1]
    vx, vy = other[:, 2] - other[:, 0], other[:, 3] - other[:, 1]
    lengths = np.sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy))
    return np.asarray((ux * vx + uy * vy) / np.maximum(lengths, TINY))


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


def tries(subjects: Subjects, near: Array, far: Array | None = None) -> Tries:
    """Return candidates at the distances ``near`` beyond the gap or, if given, at ``far``, in mm.

    The far ones lie on rings around a point or three places of a segment; the near ones on rings
    around a point or along both sides of the middle two thirds of a segment.
    """
    line = subjects.line
    if line.all():
        return _by_segments(subjects, near, far)
    if not line.any():
        return _by_points(subjects, near, far)
    points = _by_points(subjects.take(np.flatnonzero(~line)), near, far)
    lines = _by_segments(subjects.take(np.flatnonzero(line)), near, far)
    order = np.argsort(np.argsort(line, kind="stable"))
    both = zip(points, lines, strict=True)
    return Tries(*(np.concatenate(pair)[order] for pair in both))


def _by_points(subjects: Subjects, near: Array, far: Array | None) -> Tries:
    """Return candidates around points; mm."""
    root = subjects.ends[:, None, :2]
    return _rings(subjects, root, 0.0, *((20, near) if far is None else (36, far)))


def _by_segments(subjects: Subjects, near: Array, far: Array | None) -> Tries:
    """Return candidates at segments; mm."""
    start, end = subjects.ends[:, None, :2], subjects.ends[:, None, 2:]
    if far is not None:
        roots = start + (end - start) * np.array([0.5, 0.3, 0.7])[:, None]
        return _rings(subjects, roots, 0.0, 12, far)
    extent = np.minimum(np.abs(end - start)[:, 0] / 2, 3.0)
    ring = _rings(subjects, (start + end) / 2, extent, 24, near[:1])
    both = zip(_sides(subjects, 7, near), ring, strict=True)
    return Tries(*(np.concatenate(pair, axis=1) for pair in both))


def _rings(
    subjects: Subjects, root: Array, extent: Array | float, angles: int, steps: Array
) -> Tries:
    """Return places around roots (n, a, 2), each as wide as a half extent (n, 2); mm.

    Each root has its own share of the directions. The label's box slides around the root, and a
    push makes good what the sliding loses of the gap beside the box's edges.
    """
    roots = root.shape[1]
    turn = (np.arange(angles) * roots + np.arange(roots)[:, None]) * (2 * np.pi / angles / roots)
    u = np.stack([np.cos(turn), np.sin(turn)], axis=-1)[:, :, None, :]
    reach = (subjects.half + extent)[:, None, None, None, :]
    slide = np.clip(u * np.sqrt(2), -1, 1) * reach
    gap = (subjects.gap + subjects.radius)[:, None, None, None, None] + steps[:, None]
    edge = np.maximum(np.abs(slide) - reach + gap * np.abs(u), 0.0)
    push = gap * gap / np.sqrt((edge * edge).sum(-1, keepdims=True)).clip(TINY)
    centre = root[:, :, None, None, :] + slide + push * u
    return _flat(centre, u, root[:, :, None, None, :])


def _sides(subjects: Subjects, count: int, steps: Array) -> Tries:
    """Return places along both sides of the middle two thirds of segments; mm."""
    start, along = subjects.ends[:, None, :2], (subjects.ends[:, 2:] - subjects.ends[:, :2])
    unit = along / np.sqrt((along * along).sum(-1, keepdims=True)).clip(TINY)
    normal = np.stack([-unit[:, 1], unit[:, 0]], axis=-1)[:, None] * [[1.0], [-1.0]]
    support = (np.abs(normal) * subjects.half[:, None]).sum(-1)[:, :, None]
    off = (support + subjects.gap[:, None, None] + steps)[:, None, :, :, None]
    root = start + along[:, None] * np.linspace(1 / 6, 5 / 6, count)[:, None]
    root, normal = root[:, :, None, None], normal[:, None, :, None]
    return _flat(root + normal * off, normal, root)


def _flat(*fields: Array) -> Tries:
    """Return the candidates of a grid whose first axis is the subject."""
    shape = fields[0].shape
    return Tries(*(np.broadcast_to(f, shape).reshape(shape[0], -1, 2) for f in fields))


def distance_cost(some: Tries, own: Array, subjects: Subjects) -> Array:
    """Return what places cost by their distance, side and shift along a segment alone."""
    lean = subjects.lean[:, None, :]
    size = np.sqrt((lean * lean).sum(-1))
    start, end = subjects.ends[:, None, :2], subjects.ends[:, None, 2:]
    off = np.abs(some.root - (start + end) / 2).sum(-1)
    span = np.maximum(np.abs(end - start).sum(-1), 10.0)
    cost = own - subjects.gap[:, None] + size - (some.toward * lean).sum(-1)
    return np.asarray(cost + OFF_MIDDLE * (off / span) ** 2)


def leaders(some: Tries, subjects: Subjects) -> Array:
    """Return leaders from 0.5 mm off the labels' boxes, aimed at their centres, to the subjects."""
    way = some.root - some.centre
    length = np.sqrt((way * way).sum(-1, keepdims=True)).clip(TINY)
    root = some.root - way / length * subjects.radius[:, None, None]
    share = (subjects.half[:, None] + 0.5) / np.abs(way).clip(TINY)
    start = some.centre + way * share.min(axis=-1, keepdims=True)
    return np.concatenate([start, root], axis=-1)


class Blots:
    """Marks along lines, counted over a grid, that rule most of the taken places out at once."""

    def __init__(self, lines: Array, field: Box, pad: float) -> None:
        """Prepare for boxes in a field that shall be clear of the lines by ``pad`` mm."""
        self.pad, self.x, self.y = pad, field[0], field[1]
        wide, high = max(0.0, field[2] - field[0]), max(0.0, field[3] - field[1])
        self.cell = max(CELL, wide / 600, high / 600)
        self.across, self.down = int(wide / self.cell) + 1, int(high / self.cell) + 1
        step = lines[:, 2:] - lines[:, :2]
        count = np.ceil(np.abs(step).max(axis=1, initial=0.0) / self.cell).clip(1, 1000).astype(int)
        which = np.repeat(np.arange(len(lines)), count)
        share = (np.arange(len(which)) - (np.cumsum(count) - count)[which] + 0.5) / count[which]
        at = lines[which, :2] + share[:, None] * step[which] - field[:2]
        at = at[((at >= 0) & (at < (wide, high))).all(axis=1)]
        row, column = np.floor(at.T[::-1] / self.cell).astype(int)
        width = self.across + 1
        marks = np.bincount((row + 1) * width + column + 1, minlength=(self.down + 1) * width)
        table = marks.astype(np.int32).reshape(-1, width)
        self.below = table.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32)

    def hit(self, x: Array, y: Array, hx: Array, hy: Array) -> Mask:
        """Return which boxes are surely nearer to a line than they should be."""
        wide, high = hx + self.pad, hy + self.pad
        left = np.ceil((x - wide - self.x) / self.cell).clip(0, self.across).astype(np.intp)
        right = np.floor((x + wide - self.x) / self.cell).clip(0, self.across).astype(np.intp)
        top = np.ceil((y - high - self.y) / self.cell).clip(0, self.down).astype(np.intp)
        bottom = np.floor((y + high - self.y) / self.cell).clip(0, self.down).astype(np.intp)
        right, bottom = np.maximum(left, right), np.maximum(top, bottom)
        below = self.below
        return np.asarray(
            below[bottom, right] - below[top, right] - below[bottom, left] + below[top, left] > 0
        )
