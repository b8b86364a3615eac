"""Whether a group closes in no other way than those found: proved, or left open.

All trial values of a cell run through the program of the trial at once, in discs that surely hold
every value and slope. A cell whose misfits surely do not all vanish has no closure. About each
closure that was found lies a box in which there surely is one, and no other. A cell that is neither
is divided; where the work comes to its bound with cells left, others may exist.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from typing import Any, NamedTuple

from graphkin.construction.core.run import run_moving
from graphkin.construction.core.vocabulary import meet
from graphkin.construction.higher_class.closure_solver import Closures, Trying, sign_table
from graphkin.numbers.arithmetic import np
from graphkin.numbers.discs import ROUNDED, Enclosure, disc_kind
from graphkin.numbers.plane import cross

Array = Any
GRID = {1: 256, 2: 40}
"""Cells along each unknown to begin with, by how many are tried; more are not asked."""
WORK = 20_000_000
"""Steps that run in cells before the proof is given up: about one second."""
TOGETHER = 4096
"""Cells that are looked at together."""
FEW, PARTS = 200, 8
"""So few cells are divided into so many parts along one unknown, more of them into two."""
WIDEST, BOXES = 0.4, 40
"""Half the side of the widest box about a closure (rad), and how many are tried, each half as
wide as the one before."""
AWAY = 1e6
"""Points farther away than this, in parts of the largest length known, are not looked at."""


GUIDE = -pi / 2 + 1 / AWAY, pi - 2 / AWAY
"""Where the shares of a guide begin and how far they go: as far away."""


class Looked(NamedTuple):
    """What cells hold: the misfits in their middles (n, K) and how unsure they are, those all over
    the cells, their slopes (n, n, K), and whether nothing can be drawn or closed there at all."""

    middle: Array
    unsure: Array
    value: Array
    radius: Array
    rises: Array
    spread: Array
    empty: Array


class Proof:
    """The proof of one trial on known scalars."""

    def __init__(self, trying: Trying, known: Sequence[Any]) -> None:
        self.trying, self.size = trying, len(trying.unknowns)
        self.known = known
        self.scale = trying.scales([np.atleast_1d(each) for each in known], 1)[0]
        self.largest = max((float(abs(each)) for each in known), default=1.0)
        program = trying.program
        self.misfits = [one.misfit for one in trying.unknowns]
        self.facing = [one.facing for one in trying.unknowns if one.facing is not None]
        steps = program.steps
        self.lines = [
            steps[n].args
            for n in program.behind(self.misfits)
            if (action := steps[n].action) is not None and action.value is meet.value
        ]
        keep = (*self.misfits, *self.facing, *(arg for args in self.lines for arg in args))
        self.ready = trying.readied(keep)
        self.work = 0

    def looked(self, signs: Array, middle: Array, half: Array) -> Looked:
        """What cells (K, n) with some signs (K, k) hold."""
        count, size = middle.shape
        self.work += 2 * count * len(self.ready.moving)
        overrides: dict[int, Any] = {}
        nothing = np.zeros((size, 1))
        for number, value in zip(self.trying.inputs, self.known, strict=True):
            exact = np.atleast_1d(np.asarray(value, dtype=type(value)))
            overrides[number] = Enclosure(exact, ROUNDED * abs(exact), nothing, nothing)
        for k, one in enumerate(self.trying.unknowns):
            rises = np.zeros((size, 2 * count))
            rises[k] = 1.0
            place, side = np.tile(middle[:, k], 2), np.append(half[:, k], np.zeros(count))
            angle = Enclosure(place, side, rises, np.zeros((size, 2 * count)))
            turned_by = angle if one.turns else self.scale[k] * (angle.sin() / angle.cos())
            overrides[one.tried] = one.value(turned_by)
        for k, number in enumerate(self.trying.signs):
            overrides[number] = np.tile(signs[:, k], 2)
        with np.errstate(all="ignore"):
            trace = run_moving(self.ready, self.trying.values, disc_kind(), overrides=overrides)
            found = [whole(trace.values[n], size, 2 * count) for n in self.misfits]
            value, radius = (np.array([getattr(f, p) for f in found]) for p in ("middle", "radius"))
            rises, spread = (np.array([getattr(f, p) for f in found]) for p in ("rises", "spread"))
            empty = np.isnan(value[:, :count]).any(axis=0)
            for n in self.facing:
                ahead = whole(trace.values[n], size, 2 * count)
                empty |= (ahead.middle + ahead.radius < 0)[:count]
            for first, second in self.lines:
                m, n_ = trace.values[first], trace.values[second]
                area = abs(cross(m.along, n_.along))
                apart = abs(cross(n_.point - m.point, n_.along))
                nearest = (apart.middle - apart.radius) / (area.middle + area.radius)
                far = np.broadcast_to(nearest > AWAY * self.largest, 2 * count)
                empty |= far[:count]
        return Looked(
            value[:, count:],
            radius[:, count:],
            value[:, :count],
            radius[:, :count],
            rises[:, :, :count],
            spread[:, :, :count],
            empty,
        )

    def boxes(self, signs: Array, place: Array) -> Array:
        """Half the side of a box about each closure in which there is one, and no other; zero where
        none is proved."""
        count = len(place)
        half = np.repeat(WIDEST * 0.5 ** np.arange(BOXES), count)
        sides = np.tile(half[:, None], self.size)
        seen = self.looked(np.tile(signs, (BOXES, 1)), np.tile(place, (BOXES, 1)), sides)
        with np.errstate(all="ignore"):
            way, off, grown = preconditioned(seen)
            most = abs(way).T + off.T + (grown * half[:, None, None]).sum(axis=2)
            good = (most < half[:, None]).all(axis=1) & (grown.sum(axis=2) < 1).all(axis=1)
        good &= ~seen.empty
        found = np.where(good, half, 0.0).reshape(BOXES, count)
        return found.max(axis=0, initial=0.0)

    def holds_no_other(self, closures: Closures) -> bool:
        """Whether some closures are surely all."""
        rows = closures.whole[closures.whole[:, 0] == 0]
        place, signs, _ = self.trying.split(rows[:, 1:])
        turns = [one.turns for one in self.trying.unknowns]
        place = np.where(turns, place, np.arctan(place / self.scale))
        if closures.merging[closures.whole[:, 0] == 0].any():
            return False
        boxes = self.boxes(signs, place) if len(rows) else np.empty(0)
        if not (boxes > 0).all():
            return False
        for k in range(len(rows)):
            others = np.arange(len(rows)) != k
            same = (signs == signs[k]).all(axis=1) & others
            if (within(place[k], place[same]) <= boxes[same]).any():
                return False
        return self.excludes_all(signs, place, boxes)

    def excludes_all(self, signs: Array, place: Array, boxes: Array) -> bool:
        """Whether all cells outside some boxes are surely without closures."""
        rows = sign_table(len(self.trying.signs))
        table = np.array(rows, dtype=float).reshape(len(rows), len(self.trying.signs))
        unknowns = self.trying.unknowns
        start, way = np.array([one.shares if one.turns else GUIDE for one in unknowns]).T
        across = GRID[self.size]
        steps = np.stack(np.meshgrid(*[np.arange(across)] * self.size, indexing="ij"), axis=-1)
        nodes = start + (steps.reshape(-1, self.size) + 0.5) * (way / across)
        row = np.repeat(np.arange(len(table)), len(nodes))
        middle = np.tile(nodes, (len(table), 1))
        # a little wider than their share, so that rounding leaves no gap between two
        half = np.tile(way / across / 2 * (1 + 1e-9), (len(middle), 1))
        while len(row):
            part, rest = slice(0, TOGETHER), slice(TOGETHER, None)
            if self.work > WORK:
                return False
            here = row[part], middle[part], half[part]
            seen = self.looked(table[here[0]], here[1], here[2])
            left = ~self.excluded(seen, here[2])
            for k in range(len(boxes)):
                mine = (table[here[0]] == signs[k]).all(axis=1)
                far = abs(turned(here[1] - place[k])) + here[2]
                left &= ~(mine & (far <= boxes[k]).all(axis=1))
            few = left.sum() + len(row[rest]) <= FEW
            cells = here[0][left], here[1][left], here[2][left]
            new = divided(*cells, seen.rises[:, :, left], few)
            row, middle, half = (
                np.concatenate([one, other[rest]])
                for one, other in zip(new, (row, middle, half), strict=True)
            )
            if len(half) and half.min() < 1e-13:
                return False
        return True

    def excluded(self, seen: Looked, half: Array) -> Array:
        """Which cells surely have no closure."""
        with np.errstate(all="ignore"):
            gone = seen.empty | (abs(seen.value) > seen.radius).any(axis=0)
            reach = ((abs(seen.rises) + seen.spread) * half.T[None]).sum(axis=1)
            gone |= (abs(seen.middle) > seen.unsure + reach).any(axis=0)
            way, off, grown = preconditioned(seen)
            reach = (grown * half[:, None, :]).sum(axis=2) + half
            gone |= (off.T + reach < abs(way).T).any(axis=1)
        return np.asarray(gone)


def preconditioned(seen: Looked) -> tuple[Array, Array, Array]:
    """Misfits multiplied by the inverse of their slopes: their values in the middle (n, K), how
    unsure these are, and by how much their slopes differ from those of the unknowns (K, n, n)."""
    rises = np.moveaxis(seen.rises, -1, 0)
    spread = np.moveaxis(seen.spread, -1, 0)
    good = np.isfinite(rises).all(axis=(1, 2)) & np.isfinite(spread).all(axis=(1, 2))
    good &= abs(np.linalg.det(np.where(good[:, None, None], rises, 0.0))) > 1e-200
    eye = np.eye(rises.shape[1])
    inverse = np.linalg.inv(np.where(good[:, None, None], rises, eye))
    size = abs(inverse)
    way = np.einsum("kij,jk->ik", inverse, seen.middle)
    off = np.einsum("kij,jk->ik", size, seen.unsure + ROUNDED * abs(seen.middle))
    grown = size @ (spread + 4 * ROUNDED * abs(rises)) + abs(inverse @ rises - eye)
    grown = np.where(good[:, None, None], grown, np.nan)
    return way, off, grown


def divided(row: Array, middle: Array, half: Array, rises: Array, few: bool) -> tuple[Any, ...]:
    """Cells divided along the unknown that moves their misfits most."""
    count = PARTS if few else 2
    with np.errstate(all="ignore"):
        moved = (abs(rises) / np.nanmax(abs(rises), axis=1, keepdims=True)).sum(axis=0).T * half
    moved = np.where(np.isfinite(moved).all(axis=1)[:, None], moved, half)
    along = moved.argmax(axis=1)
    sides, every = half.copy(), np.arange(len(row))
    sides[every, along] /= count
    sides = np.repeat(sides, count, axis=0)
    places = np.repeat(middle, count, axis=0)
    steps = np.tile(2 * np.arange(count) + 1 - count, len(row))
    every, along = np.arange(len(places)), np.repeat(along, count)
    places[every, along] += steps * sides[every, along]
    sides *= 1 + 1e-12
    return np.repeat(row, count), places, sides


def whole(disc: Any, size: int, count: int) -> Enclosure:
    """A disc of each cell."""
    return Enclosure(
        np.broadcast_to(disc.middle, count),
        np.broadcast_to(disc.radius, count),
        np.broadcast_to(disc.rises, (size, count)),
        np.broadcast_to(disc.spread, (size, count)),
    )


def turned(angle: Array) -> Array:
    """Angles within half a turn of zero."""
    return angle - 2 * np.pi * np.rint(angle / (2 * np.pi))


def within(place: Array, others: Array) -> Array:
    """How far places (K, n) lie from one, along the unknown along which they are farthest."""
    return abs(turned(others - place)).max(axis=1, initial=0.0)


def is_complete(trying: Trying, known: Sequence[Any]) -> bool:
    """Whether the closures that are found on known floats are surely all, as far as points lie
    within a million times the largest length known."""
    if len(trying.unknowns) not in GRID or any(one.rim is not None for one in trying.unknowns):
        return False
    return Proof(trying, known).holds_no_other(trying.closures_of(known))
