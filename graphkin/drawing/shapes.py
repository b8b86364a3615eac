"""Shapes on a page and their distances (mm)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
Box = tuple[float, float, float, float]
SHY = 0.8  # mm before its end within which a leader does not cross its subject
TINY = 1e-9  # mm
NOWHERE = 1e9  # mm, the place of a missing leader

SHORT = 1.5  # mm, total length below which lines may be merged
LOOSE = 0.06  # mm by which a merged line may miss the others
HAIR = np.array([-1e-3, -1e-3, 1e-3, 1e-3], dtype=np.float32)[:, None, None]
"""More than single precision loses on a page, in mm, for the sides of a box."""
TOGETHER = 16  # boxes that are first compared with others as one

NO_INDEX: Index = np.empty(0, dtype=np.intp)


class Shapes(NamedTuple):
    """Segments, points and upright rectangles in one form, lengths in mm."""

    x: Array  # centre
    y: Array
    ex: Array  # half extents
    ey: Array
    nx: Array  # unit normal of a segment, zero for the others
    ny: Array
    slack: Array  # disables the test across the normal for other shapes

    def take(self, which: Index) -> Shapes:
        """Return some of the shapes."""
        return Shapes(*np.array(self).take(which, axis=1))

    def boxes(self, more: Array | float = 0.0) -> Array:
        """Return boxes around the shapes as rows left, top, right, bottom, enlarged by some mm."""
        wide, high = self.ex + more, self.ey + more
        return np.array([self.x - wide, self.y - high, self.x + wide, self.y + high])

    def upright(self) -> Shapes:
        """Return the shapes as columns, for arrays with one row per shape."""
        return Shapes(*(column[:, None] for column in self))


def segments(ends: ArrayLike) -> Shapes:
    """Return segments given as rows x0, y0, x1, y1 in mm; one of zero length is a point."""
    x0, y0, x1, y1 = np.asarray(ends, dtype=np.float64).reshape(-1, 4).T
    dx, dy = x1 - x0, y1 - y0
    length = np.sqrt(dx * dx + dy * dy)
    none = length < TINY
    scale = np.where(none, 0.0, 1.0 / np.where(none, 1.0, length))
    slack = np.where(none, NOWHERE, 0.0)
    half = np.abs(dx) / 2, np.abs(dy) / 2
    return Shapes((x0 + x1) / 2, (y0 + y1) / 2, *half, -dy * scale, dx * scale, slack)


def merged(lines: Array, clear: Array) -> tuple[Array, Array]:
    """Return chains of tiny lines as fewer ones, each with more clearance to compensate; mm."""
    loose = np.zeros(len(lines))
    for _ in range(3):
        first, off = _joints(lines, clear, loose)
        if not len(first):
            break
        lines, loose = lines.copy(), loose.copy()
        lines[first, 2:], loose[first] = lines[first + 1, 2:], off[first]
        rest = np.ones(len(lines), dtype=np.bool_)
        rest[first + 1] = False
        lines, loose, clear = lines[rest], loose[rest], clear[rest]
    return lines, clear + loose


def _joints(lines: Array, clear: Array, loose: Array) -> tuple[Index, Array]:
    """Return which lines can be merged with the next, and the deviation (mm) of the result."""
    linked = (lines[:-1, 2:] == lines[1:, :2]).all(axis=1) & (clear[:-1] == clear[1:])
    (cx, cy), (lx, ly) = (lines[1:, 2:] - lines[:-1, :2]).T, (lines[:-1, 2:] - lines[:-1, :2]).T
    size, along = np.sqrt(cx * cx + cy * cy), lx * cx + ly * cy
    off = np.abs(lx * cy - ly * cx) / np.maximum(size, TINY) + np.maximum(loose[:-1], loose[1:])
    place = np.arange(len(linked))
    nth = place - np.maximum.accumulate(np.where(linked, 0, place + 1))
    linked &= (size > TINY) & (size < SHORT) & (off <= LOOSE)
    linked &= (along >= 0) & (along <= size * size)
    return where(linked & (nth % 2 == 0)), off


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
    """Return a lower bound in mm of the distance of boxes from shapes, negative if they meet.

    The boxes have centre x, y and half extents hx, hy; all arguments broadcast. The bound is the
    largest gap along x, along y or across a segment. It is below the distance only between corners.
    """
    dx, dy = other.x - x, other.y - y
    across = other.nx * dx
    across += other.ny * dy
    np.abs(across, out=across)
    across -= hx * np.abs(other.nx) + hy * np.abs(other.ny) + other.slack
    np.maximum(across, np.abs(dx) - (other.ex + hx), out=across)
    return np.maximum(across, np.abs(dy) - (other.ey + hy), out=across)


def met(boxes: ArrayLike, lines: Shapes) -> Index:
    """Return the number of segments that run into each box: rows xmin, ymin, xmax, ymax in mm."""
    x, y, hx, hy = rectangles(boxes).upright()[:4]
    return np.asarray((separation(x, y, hx, hy, lines) < 0).sum(axis=1))


def distance(x: Array, y: Array, hx: Array, hy: Array, other: Shapes) -> Array:
    """Return the same as `separation`, but with the true distance at corners."""
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


def struck(leaders: Array, lines: Array) -> Index:
    """Return how many lines each leader crosses before its subject."""
    way = leaders[:, 2:] - leaders[:, :2]
    length = np.maximum(np.hypot(way[:, 0], way[:, 1]), TINY)
    share = np.maximum(1.0 - SHY / length, 0.0)[:, None]
    short = np.concatenate([leaders[:, :2], leaders[:, :2] + share * way], axis=1)
    return np.asarray(crossings(short[:, None], lines).sum(axis=1))


def where(mask: Mask) -> Index:
    """Return the indices of true elements, like flatnonzero() but in a third of its time."""
    return mask.reshape(-1).nonzero()[0]


def pairs_of(mask: Mask) -> tuple[Index, Index]:
    """Return the rows and columns of true elements, like nonzero() but much faster."""
    at, across = where(mask), max(1, mask.shape[1])
    row = at // across
    return row, at - row * across


def meeting(one: Array, other: Array) -> tuple[Index, Index]:
    """Return which upright boxes of two sets meet, as numbers in each set, but for a hair.

    Both are given as rows left, top, right, bottom in mm. Consecutive boxes of the first set should
    be neighbours, because the others are first compared with hulls of several at a time.
    """
    count, short = one.shape[1], -one.shape[1] % TOGETHER
    if not count:
        return NO_INDEX, NO_INDEX
    whole = np.concatenate([one, one[:, -1:].repeat(short, axis=1)], axis=1) if short else one
    sides = whole.astype(np.float32).reshape(4, -1, TOGETHER) + HAIR
    hull = np.concatenate([sides[:2].min(axis=2), sides[2:].max(axis=2)])
    far = other.astype(np.float32)
    some, second = pairs_of(overlap(hull[:, :, None], far))
    each = far.take(second, axis=1).repeat(TOGETHER, axis=1).reshape(4, -1, TOGETHER)
    pair, nth = pairs_of(overlap(sides.take(some, axis=1), each))
    first, second = some.take(pair) * TOGETHER + nth, second.take(pair)
    if short:
        real = where(first < count)
        first, second = first.take(real), second.take(real)
    return first, second


def overlap(one: NDArray[Any], other: NDArray[Any]) -> Mask:
    """Return which upright boxes overlap; rows left, top, right, bottom broadcast."""
    met = one[0] <= other[2]
    met &= other[0] <= one[2]
    met &= one[1] <= other[3]
    met &= other[1] <= one[3]
    return np.asarray(met)
