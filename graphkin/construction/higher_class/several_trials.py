"""Groups in which several links are tried at once until all cuts fit.

Cells of a grid in which no misfit can vanish are dropped as soon as the links tried so far show
this. The closures are found in the remaining cells. Misfits are multiplied by what
has a zero at their poles. The search may miss a closure where a misfit takes all its range within
one cell, or one that nearly merges with another. The module completeness says whether that is ruled
out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property, partial
from typing import Any, NamedTuple

from graphkin.construction.core.run import Ready, run_moving
from graphkin.construction.core.vocabulary import meet
from graphkin.construction.higher_class.closure_solver import Closures, Trying, sign_table
from graphkin.numbers.arithmetic import batch_kind, np
from graphkin.numbers.common_roots import (
    CLOSED,
    Array,
    Cells,
    FlatDyad,
    common_roots,
    corners_of,
    joined,
    may_vanish,
    steps_of,
)
from graphkin.numbers.plane import cross

ACROSS = {2: 120, 3: 32, 4: 12}
"""Grid steps along each unknown, by the number of unknowns tried before a misfit is known."""
FEWER = 60
"""Grid steps along each unknown where the first two of more than two give a misfit."""
TOGETHER = 64
"""Number of elements that are closed at once."""
MOST = 1_000_000
"""Number of places at which cells are examined together."""
MIDDLE, WIDER = 0.9, 2.0
"""The middle fraction of a misfit's values, and the largest multiple of it taken as the range.

Near parallel lines a misfit grows without bound; without this limit no cell would be dropped.
"""
BESIDE = 1e-7
"""How far from where the search found it a closure may be, in radians or parts of its range."""
TRACES = 40
"""Number of places on each side of a closure at which a locus is drawn."""
TRACED = 0.02
"""Spacing of these places, in radians or as a fraction of the tried range."""
TRACING = 4
"""Steps of Newton's method for each place."""


class SeveralTrials(Trying, frozen=True, dict=True):
    """A trial of several links at once; trial values are rows of an array."""

    def loci(self, known: Sequence[Any], value: Sequence[Any]) -> list[Any]:
        """The loci of the traced points near a closure while the outermost link is tried.

        The groups within are closed each time. Arrays (N,) each, as far as they close.
        """
        start = self.row_of(value)
        size, traced = len(self.unknowns), self.traced
        here = [np.broadcast_to(np.atleast_1d(each), 2) for each in known]
        signs = np.tile(start[size:-1], (2, 1))
        tried = np.tile(start[:size], (2, 1))
        ways = np.array([-1.0, 1.0])
        places: list[list[list[Any]]] = [[], []]
        step = TRACED * np.where(self.unknowns[0].turns, 1.0, self.scales(here, 2)[:, 0])
        rise = np.zeros((2, size))
        rise[:, 0] = 1.0
        for _ in range(TRACES + 1):
            found = self.found(here, tried, signs)
            for side in range(2):
                places[side].append([found[number][side] for number in traced])
            before = tried
            tried = self.closed_within(here, tried + ways[:, None] * step[:, None] * rise, signs)
            rise = (tried - before) / (ways * step)[:, None]
        back, on = (np.array(each).T for each in places)
        return [np.concatenate([b[:0:-1], o]) for b, o in zip(back, on, strict=True)]

    def closed_within(self, known: Sequence[Any], tried: Array, signs: Array) -> Array:
        """Trial values at which all groups within close, with that of the outermost kept."""
        inner = self.unknowns[1:]

        def missed(row: Array, share: Array) -> Array:
            here = [array[row] for array in known]
            found = self.found(here, np.column_stack([tried[row, :1], share]), signs[row])
            return np.stack([found[one.misfit] for one in inner], axis=1)

        share, every = tried[:, 1:].copy(), np.arange(len(tried))
        for _ in range(TRACING):
            share = share + steps_of(missed, every, share, missed(every, share))
        return np.column_stack([tried[:, :1], share])

    def row_of(self, value: Sequence[Any]) -> Array:
        """A closure as numbers: trial values, signs, the sine of crossing."""
        return np.array([*map(float, (*self.numbers(value), *value[len(self.unknowns) :]))])

    def together(self, known: Sequence[Any], size: int) -> int:
        return TOGETHER

    def work(self, known: Sequence[Any]) -> int:
        """A lower bound on the number of steps run in a search for all closures on known values."""
        places = (self.across + 1) ** self.dense
        return int(places * 2 ** len(self.signs) * len(self.ready.moving))

    def closures(self, known: Sequence[Any]) -> Closures:
        """Every closure of every element of known values, in the order of their numbers."""
        size = len(known[0]) if known else 1
        rows = sign_table(len(self.signs))
        table = np.array(rows, dtype=float).reshape(len(rows), len(self.signs))
        owner = np.repeat(np.arange(size), len(table))
        signs = np.tile(table, (size, 1))
        scales = self.scales(known, size)
        found, ranges = list[Cells](), np.empty((size, len(self.unknowns)))
        for each in range(size):
            here = [array[each] for array in known]
            cells, ranges[each] = self.cells(here, scales[each])
            found.append(Cells(each * len(table) + cells.row, cells.middle))
        cells, ranges = joined(found), np.repeat(ranges, len(table), axis=0)
        start, way = self.grid_of_shares()
        half = way / self.across / 2
        cells = Cells(cells.row, start + (cells.middle + 0.5) * 2 * half)
        chain = DrawnChain(self, known, owner, signs, scales)
        edges = [
            (partial(chain.reach, k), 1 << (len(self.signs) - 1 - k))
            for k, choice in enumerate(self.choices)
            if choice is not None
        ]
        row, share = common_roots(chain.missed, chain.at, edges, cells, half, ranges)
        tried = self.valued(share, scales[owner[row]])
        here = [array[owner[row]] for array in known]
        tried = self.settled_beside(here, tried, signs[row], scales[owner[row]], ranges[row])
        row, tried = row[np.isfinite(tried[:, 0])], tried[np.isfinite(tried[:, 0])]
        touching = np.zeros(row.size, dtype=bool)
        return self.ordered(known, size, owner[row], tried, signs[row], touching)

    def settled_beside(
        self, known: Sequence[Any], tried: Array, signs: Array, scales: Array, ranges: Array
    ) -> Array:
        """Trial values (K, n) with all their digits; NaN where a misfit has a pole instead.

        Where two closures merge, or a dyad is flat, Newton's method does not tell; what the search
        found is then kept.
        """
        with np.errstate(all="ignore"):
            misfits = self.misfits(known, tried, signs)
            closed = (abs(misfits) < CLOSED * ranges).all(axis=1)
            found = self.closed_beside(known, tried, signs)
            near = (abs(found - tried) < BESIDE * scales).all(axis=1)
        return np.where(near[:, None], found, np.where(closed[:, None], tried, np.nan))

    def closed_over_flat(
        self, known: Sequence[Any], tried: Array, signs: Array, room: float
    ) -> tuple[Array, Array] | None:
        """The trial values (n,) and signs (k,) that close near given ones where a dyad is flat.

        Either sign of the dyad may hold there. None where nothing closes within ``room``.
        """
        rows = sign_table(len(self.signs))
        table, first = np.array(rows, dtype=float), [array[0] for array in known]

        def here(row: Array, share: Array) -> tuple[list[Array], Array, Array]:
            return [array[:1] for array in known], share, table[row]

        cells = Cells(np.array([rows.index(tuple(signs))]), tried[None])
        half, size = np.full(len(tried), room), max(map(abs, first))
        ranges = np.full((len(table), len(tried)), size)
        found = list[tuple[Array, Array]]()
        for k, choice in enumerate(self.choices):
            if choice is not None:
                reach = partial(lambda k, *each: self.drawable(k, *here(*each)), k)
                bit = 1 << (len(self.signs) - 1 - k)
                dyad = FlatDyad(lambda *each: self.misfits(*here(*each)), reach, bit)
                found += dyad.fits(cells, half, ranges)
        if not found:
            return None
        code, share = (np.concatenate(column) for column in zip(*found, strict=True))
        away = abs(share - tried).max(axis=1)
        if not away.size or not away.min() <= room:
            return None
        return share[away.argmin()], table[code[away.argmin()]]

    def grid_of_shares(self) -> tuple[Array, Array]:
        """The start and the range of the shares of each unknown."""
        start, way = np.array([one.shares for one in self.unknowns], dtype=float).T
        return start, way

    # --- misfits without poles -------------------------------------------------------------------

    @cached_property
    def lines(self) -> tuple[tuple[tuple[int, ...], ...], ...]:
        """For each unknown: the pairs of lines that cross before its misfit is known."""
        steps = self.program.steps
        return tuple(
            tuple(
                steps[n].args
                for n in self.program.behind((one.misfit,))
                if (action := steps[n].action) is not None and action.value is meet.value
            )
            for one in self.unknowns
        )

    def keep(self, k: int) -> tuple[int, ...]:
        """The steps from which the misfit of an unknown without its poles is known."""
        return (self.unknowns[k].misfit, *(n for pair in self.lines[k] for n in pair))

    @cached_property
    def looked_at(self) -> Ready:
        """The program for the misfits and for the values from which the dyads are drawn."""
        drawn = (arg for choice in self.choices if choice for arg in choice[2])
        return self.readied((*self.smooth.keep, *drawn))

    @cached_property
    def smooth(self) -> Ready:
        """The program for the misfits without their poles."""
        return self.readied(tuple(n for k, _ in enumerate(self.unknowns) for n in self.keep(k)))

    def without_poles(self, k: int, found: Mapping[int, Any]) -> Any:
        """The misfit of an unknown, times the sines at which lines cross before it.

        A misfit has a pole where such lines are parallel; beside it, it may vanish within far less
        than a cell.
        """
        misfit = found[self.unknowns[k].misfit]
        for one, other in self.lines[k]:
            first, second = found[one].along, found[other].along
            misfit = misfit * cross(first, second) / (abs(first) * abs(second))
        return misfit

    # --- cells in which all misfits may vanish ---------------------------------------------------

    @cached_property
    def stages(self) -> tuple[GridStage, ...]:
        """What each further unknown determines, from the outermost inwards."""
        steps = [one.tried for one in self.unknowns]

        def least(number: int) -> int:
            """The number of unknowns that a step depends on."""
            behind = {*self.program.behind((number,))}
            return max((k for k, tried in enumerate(steps, 1) if tried in behind), default=1)

        reaches = [(each[1], each[2]) for each in self.choices if each is not None]
        found, known = list[GridStage](), set[int]()
        for count in range(1, len(steps) + 1):
            misfits = [k for k, one in enumerate(self.unknowns) if least(one.misfit) == count]
            within = [each for each in reaches if max(map(least, each[1])) == count]
            keep = (
                *(n for k in misfits for n in self.keep(k)),
                *(arg for _, args in within for arg in args),
            )
            needed = self.program.behind(keep)
            last = count == len(steps)
            new = [k for k, n in enumerate(self.signs) if (last or n in needed) and k not in known]
            known |= {*new}
            found.append(GridStage(self.readied(keep), tuple(misfits), tuple(within), tuple(new)))
        return tuple(found)

    @cached_property
    def dense(self) -> int:
        """The number of unknowns that must be tried before any misfit is known."""
        return next(k for k, stage in enumerate(self.stages, 1) if stage.misfits)

    @property
    def across(self) -> int:
        """Grid steps along each unknown."""
        return ACROSS[self.dense] if self.dense > 2 or len(self.unknowns) == 2 else FEWER

    def cells(self, known: Sequence[Any], scale: Array) -> tuple[Cells, Array]:
        """The grid cells in which all misfits may vanish on known scalars, and each misfit's range.

        A cell has its row of signs and its step number along each unknown.
        """
        row, place = np.zeros(1, dtype=int), np.empty((1, 0), dtype=int)
        ranges = np.zeros(len(self.unknowns))
        for stage in self.stages:
            count = 2 ** len(stage.signs)
            chunk = max(1, MOST // ((self.across + 1) * count))
            parts = [
                self.extended(stage, known, scale, row[k : k + chunk], place[k : k + chunk])
                for k in range(0, len(row), chunk)
            ] or [self.extended(stage, known, scale, row, place)]
            for k, misfit in enumerate(stage.misfits):
                spans = np.array([part.spans[k] for part in parts])
                low, least = np.fmin.reduce(spans[:, :2])
                most, high = np.fmax.reduce(spans[:, 2:])
                ranges[misfit] = np.fmin(high - low, WIDER * (most - least))
            ranges = np.where(np.isfinite(ranges), ranges, max(map(abs, known)))
            side = self.grid_of_shares()[1] / self.across
            kept = [part.kept(ranges[[*stage.misfits]], side) for part in parts]
            row, place = (np.concatenate(column) for column in zip(*kept, strict=True))
        return Cells(row, place), ranges

    def extended(
        self, stage: GridStage, known: Sequence[Any], scale: Array, row: Array, place: Array
    ) -> Corners:
        """Extend cells (C, k) by each step along one more unknown, and by each set of new signs.

        Returns the values at the corners of the cells.
        """
        size, across = place.shape[1], self.across
        start, way = self.grid_of_shares()
        corners = (place[:, None, :] + corners_of(size)).reshape(len(row) * 2**size, size)
        code = np.repeat(row, 2**size)
        for k in range(size):
            code = code * (across + 1) + corners[:, k]
        _, first, which = np.unique(code, return_index=True, return_inverse=True)
        own, nodes = np.repeat(row, 2**size)[first], corners[first]
        beside = [
            nodes_beside(code[first], nodes[:, k], (across + 1) ** (size - 1 - k), across)
            for k in range(size)
        ]
        new = np.arange(2 ** len(stage.signs))
        overrides: dict[int, Any] = dict(zip(self.inputs, known, strict=True))
        for k, one in enumerate(self.unknowns[: size + 1]):
            steps = nodes[:, k, None, None] if k < size else np.arange(across + 1)
            value = one.valued(start[k] + steps * (way[k] / across), scale[k])
            overrides[one.tried] = one.value(value)
        for k, number in enumerate(self.signs):
            bit = 1 << (len(self.signs) - 1 - k)
            if k in stage.signs:
                place_of_bit = len(stage.signs) - 1 - stage.signs.index(k)
                negative = ((new >> place_of_bit & 1) > 0)[:, None]
            else:
                negative = ((own & bit) > 0)[:, None, None]
            overrides[number] = np.where(negative, -1.0, 1.0)
        codes = sum(
            (new >> (len(stage.signs) - 1 - n) & 1) << (len(self.signs) - 1 - k)
            for n, k in enumerate(stage.signs)
        )
        with np.errstate(all="ignore"):
            trace = run_moving(stage.ready, self.values, batch_kind(), overrides=overrides)
            shape = len(first), len(new), across + 1
            misfits = [self.without_poles(k, trace.values) for k in stage.misfits]
            reaches = [
                factor
                for far, args in stage.reaches
                for factor in far(*(trace.values[arg] for arg in args))
            ]
            misfits, reaches = (
                [np.broadcast_to(each, shape) for each in some] for some in (misfits, reaches)
            )
        which = which.reshape(len(row), 2**size)
        return Corners(row, place, codes, which, beside, shape, misfits, reaches)


def nodes_beside(code: Array, place: Array, stride: int, across: int) -> tuple[Array, Array]:
    """The nodes before and after each one along an unknown; itself where either is missing.

    ``code`` are the rising numbers of the nodes (N,), ``stride`` is what a step adds to them, and
    ``place`` their steps from 0 to ``across`` along that unknown.
    """
    own, within = np.arange(len(code)), (place > 0) & (place < across)
    sides = [code + way * stride for way in (-1, 1)]
    found = [np.searchsorted(code, side).clip(0, len(code) - 1) for side in sides]
    for each, side in zip(found, sides, strict=True):
        within &= code[each] == side
    before, after = (np.where(within, each, own) for each in found)
    return before, after


class GridStage(NamedTuple):
    """The quantities that one further unknown determines.

    They are the program for them, the unknowns whose misfits are known, the reaches of dyads, and
    the signs on which these depend.
    """

    ready: Ready
    misfits: tuple[int, ...]
    reaches: tuple[tuple[Any, tuple[int, ...]], ...]
    signs: tuple[int, ...]


class Corners(NamedTuple):
    """Cells (C, k), their rows, and the values at their corners along one more unknown.

    ``misfits`` and ``reaches`` are arrays of a ``shape``: nodes, sets of signs, and places along
    that unknown. ``which`` has the nodes of each cell (C, 2^k), ``beside`` those
    before and after each node along each unknown, and ``codes`` the number that each set of signs
    adds to a row.
    """

    row: Array
    place: Array
    codes: Array
    which: Array
    beside: list[tuple[Array, Array]]
    shape: tuple[int, ...]
    misfits: list[Array]
    reaches: list[Array]

    @property
    def spans(self) -> list[Array]:
        """Least, start of middle, end of middle and largest value of each misfit, or NaN."""
        shares = (0.0, (1 - MIDDLE) / 2, (1 + MIDDLE) / 2, 1.0)
        finite = (each[np.isfinite(each)] for each in self.misfits)
        return [np.quantile(x, shares) if x.size else np.full(len(shares), np.nan) for x in finite]

    def kept(self, ranges: Array, side: Array) -> tuple[Array, Array]:
        """The cells, with one more unknown, in which all misfits may vanish: rows and places."""
        cells = len(self.row), self.shape[1], self.shape[2] - 1
        keep = np.ones(cells, dtype=bool)
        if self.misfits or self.reaches:
            finite = np.full(self.shape, bool(self.misfits))
            for each in self.misfits:
                finite = finite & np.isfinite(each)
            drawn = [np.where(finite, each, np.nan) for each in self.misfits]
            ends = [(*self.ends(each), self.bending(each)) for each in drawn]
            whole = self.over(np.logical_and, finite)
            some = self.over(np.logical_or, finite)
            reaches = [(*self.ends(each), self.edges(each)) for each in self.reaches]
            keep = may_vanish(ends, reaches, some, whole, ranges, side)
        cell, code, step = np.nonzero(keep)
        codes = self.row[cell] + np.broadcast_to(self.codes, self.shape[1])[code]
        return codes, np.column_stack([self.place[cell], step])

    def ends(self, value: Array) -> tuple[Array, Array]:
        """The least and the largest value at the corners of each cell."""
        return self.over(np.fmin, value), self.over(np.fmax, value)

    def edges(self, reach: Array) -> Array:
        """The largest size of a reach for cells at whose corners it is unknown, otherwise zero."""
        known = self.over(np.logical_and, np.isfinite(reach))
        return np.where(known, 0.0, np.fmax.reduce(abs(reach), axis=None, initial=0.0))

    def bending(self, value: Array) -> Array:
        """The largest sum of second differences at the corners of each cell; unknown ones are 0."""
        found = np.zeros(value.shape)
        second = abs(np.diff(value, 2))
        found[..., 1:-1] += np.where(np.isfinite(second), second, 0.0)
        for before, after in self.beside:
            second = abs(value[before] - 2 * value + value[after])
            found += np.where(np.isfinite(second), second, 0.0)
        return self.over(np.fmax, found)

    def over(self, both: Any, value: Array) -> Array:
        """Combine a value over all corners of each cell with the function ``both``."""
        value = both(value[..., :-1], value[..., 1:])
        found = value[self.which[:, 0]]
        for nodes in self.which.T[1:]:
            found = both(found, value[nodes])
        return found


# --- where all misfits vanish --------------------------------------------------------------------


class DrawnChain:
    """The quantities of rows (K,) at shares (K, n); each row has its element and its signs."""

    def __init__(
        self, trying: SeveralTrials, known: Sequence[Any], owner: Array, signs: Array, scales: Array
    ) -> None:
        self.trying, self.owner, self.signs, self.scales = trying, owner, signs, scales
        self.known = [array[:1] if (array == array[0]).all() else array for array in known]

    def trials(self, row: Array, share: Array) -> tuple[list[Array], Array, Array]:
        """The known values, the trial values and the signs."""
        owner = self.owner[row]
        here = [array if len(array) == 1 else array[owner] for array in self.known]
        return here, self.trying.valued(share, self.scales[owner]), self.signs[row]

    def missed(self, row: Array, share: Array) -> Array:
        """The misfits without poles (K, n)."""
        found = self.trying.run(self.trying.smooth, *self.trials(row, share))
        with np.errstate(all="ignore"):
            return np.stack([*self.misfits(found, len(row))], axis=1)

    def misfits(self, found: Mapping[int, Any], count: int) -> Iterator[Array]:
        """Each misfit without poles (K,) among results."""
        for k in range(len(self.trying.unknowns)):
            yield np.broadcast_to(self.trying.without_poles(k, found), count)

    def reach(self, k: int, row: Array, share: Array) -> Array:
        """How far the dyad of a sign is drawable (K,): positive where it can be drawn."""
        return self.trying.drawable(k, *self.trials(row, share))

    def at(self, row: Array, share: Array) -> tuple[list[Array], list[Array]]:
        """Each misfit, and each factor of how far a dyad is drawable, in their order: (K,) each."""
        found = self.trying.run(self.trying.looked_at, *self.trials(row, share))
        choices = [choice for choice in self.trying.choices if choice is not None]
        with np.errstate(all="ignore"):
            misfits = [*self.misfits(found, len(row))]
            reaches = [
                factor for _, far, args in choices for factor in far(*(found[arg] for arg in args))
            ]
        return misfits, [np.broadcast_to(each, len(row)) for each in reaches]
