"""Where labels might sit around what they name, and a quick look at what is taken (mm)."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphkin.drawing.shapes import TINY, Array, Box, Index, Mask, where

CELL = 0.8  # mm, of the grid that rules places out at a glance
OFF_MIDDLE = 4.0  # cost of a segment's label at the segment's end; all costs are in mm of distance


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

    x: Array  # centre of the label
    y: Array
    toward_x: Array  # unit direction from the subject to the label
    toward_y: Array
    root_x: Array  # the place on the subject that is meant
    root_y: Array


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
    """Return unit vectors as rows x and y: for each root its own share of the directions."""
    turn = (np.arange(angles) * roots + np.arange(roots)[:, None]) * (2 * np.pi / angles / roots)
    return np.array([np.cos(turn), np.sin(turn)]).reshape(2, -1)


def _rings(
    subjects: Subjects, x: Array, y: Array, extent: Array | float, angles: int, steps: Array
) -> Tries:
    """Return places around roots at x, y (n, a), each as wide as a half extent (2, n, 1); mm.

    The label's box slides around the root, and a push makes good what the sliding loses of the
    gap beside the box's edges.
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
    """Return what places cost by their distance, side and shift along a segment alone."""
    (lean_x, lean_y), (x0, y0, x1, y1) = subjects.lean.T[:, :, None], subjects.ends.T[:, :, None]
    cost = own - subjects.gap[:, None] + np.sqrt(lean_x * lean_x + lean_y * lean_y)
    cost -= some.toward_x * lean_x + some.toward_y * lean_y
    off = np.abs(some.root_x - (x0 + x1) / 2) + np.abs(some.root_y - (y0 + y1) / 2)
    off /= np.maximum(np.abs(x1 - x0) + np.abs(y1 - y0), 10.0)
    cost += OFF_MIDDLE * off * off
    return np.asarray(cost)


class Blots:
    """Marks along lines, counted over a grid, that rule most of the taken places out at once."""

    def __init__(self, lines: Array, field: Box, pad: float, cell: float = CELL) -> None:
        """Prepare for boxes in a field that shall be clear of the lines by ``pad`` mm.

        The grid's cells are ``cell`` mm wide at least.
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
        """Return which boxes are surely nearer to a line than they should be."""
        wide, high = hx + self.pad, hy + self.pad
        left, right = self._cells(x - wide - self.x, x + wide - self.x, self.across)
        top, bottom = self._cells(y - high - self.y, y + high - self.y, self.down)
        width, below = self.across + 1, self.below.reshape(-1)
        top, bottom = top * width, bottom * width
        count = below.take(bottom + right) - below.take(bottom + left)
        count += below.take(top + left) - below.take(top + right)
        return np.asarray(count > 0)

    def _cells(self, low: Array, high: Array, most: int) -> tuple[Index, Index]:
        """Return the first cells wholly beyond some places and those where others lie."""
        first = np.minimum(np.maximum(np.ceil(low / self.cell), 0), most).astype(np.intp)
        return first, np.maximum(first, np.minimum(high / self.cell, most).astype(np.intp))
