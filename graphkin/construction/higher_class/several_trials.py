"""Groups in which several links are tried at once: where all that was cut fits again.

Cells of a grid in which no misfit can vanish are left out as soon as the links tried so far tell
it. What is found in the others is a closure. One may be missed where misfits grow by all their
range within a cell, or that all but merges with another: completeness says whether that is ruled
out.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, partial
from typing import Any, NamedTuple

from graphkin.construction.core.batch import Ready, run_moving
from graphkin.construction.higher_class.closure_solver import Closures, Trying, sign_table
from graphkin.numbers.arithmetic import batch_kind
from graphkin.numbers.arrays import np
from graphkin.numbers.common_roots import (
    Array,
    Cells,
    common_roots,
    corners_of,
    joined,
    may_vanish,
    roots_beside,
    steps_of,
)

ACROSS = {2: 120, 3: 32, 4: 12}
"""Steps of the grid along each unknown, by how many are tried before any misfit tells anything."""
FEWER = 60
"""Steps along each where two of more do."""
TOGETHER = 64
"""Elements that are closed at once."""
MOST = 1_000_000
"""Places at which cells are looked at together."""
MIDDLE, WIDER = 0.9, 2.0
"""A misfit ranges as far as this share of its values, in the middle, so many times over at most:
where lines are all but parallel it grows without bound, and no cell would ever be left out."""
TRACES = 40
"""Places to both sides of a closure at which a locus is drawn."""
TRACED = 0.02
"""How far they lie apart, in radians or parts of the way that is tried."""
TRACING = 4
"""Steps of Newton's method for each."""


class SeveralTrials(Trying, frozen=True, dict=True):
    """A trial of several links at once, and where it fits: trial values are rows of an array."""

    def loci(self, known: Sequence[Any], value: Sequence[Any]) -> list[Any]:
        """Where the traced points go beside a closure while the outermost link is tried, those
        within closed each time: (N,) each, as far as they close."""
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
        """Trial values at which all groups within close, that of the outermost as it is."""
        inner = self.unknowns[1:]

        def missed(row: Array, share: Array) -> Array:
            here = [array[row] for array in known]
            found = self.found(here, np.column_stack([tried[row, :1], share]), signs[row])
            return np.stack([found[one.misfit] for one in inner], axis=1)

        share, every = tried[:, 1:].copy(), np.arange(len(tried))
        for _ in range(TRACING):
            share = share + steps_of(missed, every, share, missed(every, share))
        return np.column_stack([tried[:, :1], share])

    def closed_beside(self, known: Sequence[Any], tried: Array, signs: Array) -> Array:
        """Trial values at which all closes beside some (K, n), by Newton's method.

        NaN where it does not come to rest.
        """

        def missed(row: Array, share: Array) -> Array:
            found = self.found([array[row] for array in known], share, signs[row])
            return np.stack([found[one.misfit] for one in self.unknowns], axis=1)

        return roots_beside(missed, tried)

    def row_of(self, value: Sequence[Any]) -> Array:
        """A closure as numbers: trial values, signs, the sine of crossing."""
        return np.array([*map(float, (*self.numbers(value), *value[len(self.unknowns) :]))])

    def together(self, known: Sequence[Any], size: int) -> int:
        """How many elements are closed at once."""
        return TOGETHER

    def work(self, known: Sequence[Any]) -> int:
        """How many steps run where everything that closes is sought on known values, at least."""
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
        touching = np.zeros(row.size, dtype=bool)
        return self.ordered(known, size, owner[row], tried, signs[row], touching)

    def grid_of_shares(self) -> tuple[Array, Array]:
        """Where the shares of each unknown begin, and how far they go."""
        start, way = np.array([one.shares for one in self.unknowns], dtype=float).T
        return start, way

    # --- cells in which all may vanish -----------------------------------------------------------

    @cached_property
    def looked_at(self) -> Ready:
        """What gives the misfits, and what the dyads are drawn of."""
        drawn = (arg for choice in self.choices if choice for arg in choice[2])
        return self.readied((*(one.misfit for one in self.unknowns), *drawn))

    @cached_property
    def stages(self) -> tuple[GridStage, ...]:
        """What each further unknown lets one look at, from the outermost inwards."""
        steps = [one.tried for one in self.unknowns]

        def least(number: int) -> int:
            """With how many unknowns a step can be run."""
            behind = {*self.program.behind((number,))}
            return max((k for k, tried in enumerate(steps, 1) if tried in behind), default=1)

        reaches = [(each[1], each[2]) for each in self.choices if each is not None]
        found, known = list[GridStage](), set[int]()
        for count in range(1, len(steps) + 1):
            misfits = [k for k, one in enumerate(self.unknowns) if least(one.misfit) == count]
            within = [each for each in reaches if max(map(least, each[1])) == count]
            keep = (
                *(self.unknowns[k].misfit for k in misfits),
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
        """How many unknowns have to be tried before any misfit tells anything."""
        return next(k for k, stage in enumerate(self.stages, 1) if stage.misfits)

    @property
    def across(self) -> int:
        """Steps of the grid along each unknown."""
        return ACROSS[self.dense] if self.dense > 2 or len(self.unknowns) == 2 else FEWER

    def cells(self, known: Sequence[Any], scale: Array) -> tuple[Cells, Array]:
        """The cells of the grid in which all misfits may vanish on known scalars, each by its row
        of signs and the number of its steps along each unknown, and how far each misfit ranges.
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
        """Cells (C, k) with each step along one more unknown, and each set of signs that it asks:
        what is found at their corners.
        """
        size, across = place.shape[1], self.across
        start, way = self.grid_of_shares()
        corners = (place[:, None, :] + corners_of(size)).reshape(len(row) * 2**size, size)
        code = np.repeat(row, 2**size)
        for k in range(size):
            code = code * (across + 1) + corners[:, k]
        _, first, which = np.unique(code, return_index=True, return_inverse=True)
        own, nodes = np.repeat(row, 2**size)[first], corners[first]
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
            misfits = [trace.values[self.unknowns[k].misfit] for k in stage.misfits]
            reaches = [
                factor
                for far, args in stage.reaches
                for factor in far(*(trace.values[arg] for arg in args))
            ]
            misfits, reaches = (
                [np.broadcast_to(each, shape) for each in some] for some in (misfits, reaches)
            )
        return Corners(row, place, codes, which.reshape(len(row), 2**size), shape, misfits, reaches)


class GridStage(NamedTuple):
    """What one further unknown lets one look at: the program for it, the unknowns whose misfits
    it tells, how far dyads reach, and the signs on which these depend."""

    ready: Ready
    misfits: tuple[int, ...]
    reaches: tuple[tuple[Any, tuple[int, ...]], ...]
    signs: tuple[int, ...]


class Corners(NamedTuple):
    """Cells (C, k), their rows, and what is found where they are taken along one more unknown.

    ``misfits`` and ``reaches`` are those at nodes, for sets of signs and for places along that
    unknown: arrays of a ``shape``; ``which`` has the nodes of each cell (C, 2^k), and ``codes``
    what each set of signs adds to a row.
    """

    row: Array
    place: Array
    codes: Array
    which: Array
    shape: tuple[int, ...]
    misfits: list[Array]
    reaches: list[Array]

    @property
    def spans(self) -> list[Array]:
        """The least value of each misfit, where the middle ones begin and end, and the largest; NaN
        without any."""
        shares = (0.0, (1 - MIDDLE) / 2, (1 + MIDDLE) / 2, 1.0)
        finite = (each[np.isfinite(each)] for each in self.misfits)
        return [np.quantile(x, shares) if x.size else np.full(len(shares), np.nan) for x in finite]

    def kept(self, ranges: Array, side: Array) -> tuple[Array, Array]:
        """The cells along one more unknown in which all misfits may vanish: rows and places."""
        cells = len(self.row), self.shape[1], self.shape[2] - 1
        keep = np.ones(cells, dtype=bool)
        if self.misfits or self.reaches:
            finite = np.full(self.shape, bool(self.misfits))
            for each in self.misfits:
                finite = finite & np.isfinite(each)
            ends = [self.ends(np.where(finite, each, np.nan)) for each in self.misfits]
            whole = self.over(np.logical_and, finite)
            some = self.over(np.logical_or, finite)
            keep = may_vanish(ends, [*map(self.ends, self.reaches)], some, whole, ranges, side)
        cell, code, step = np.nonzero(keep)
        codes = self.row[cell] + np.broadcast_to(self.codes, self.shape[1])[code]
        return codes, np.column_stack([self.place[cell], step])

    def ends(self, value: Array) -> tuple[Array, Array]:
        """The least and the largest at the corners of each cell."""
        return self.over(np.fmin, value), self.over(np.fmax, value)

    def over(self, both: Any, value: Array) -> Array:
        """What all corners of each cell make of a value."""
        value = both(value[..., :-1], value[..., 1:])
        found = value[self.which[:, 0]]
        for nodes in self.which.T[1:]:
            found = both(found, value[nodes])
        return found


# --- where all misfits vanish --------------------------------------------------------------------


class DrawnChain:
    """What is looked at, of rows (K,) at shares (K, n): each row has its element and its signs."""

    def __init__(
        self, trying: SeveralTrials, known: Sequence[Any], owner: Array, signs: Array, scales: Array
    ) -> None:
        self.trying, self.owner, self.signs, self.scales = trying, owner, signs, scales
        self.known = [array[:1] if (array == array[0]).all() else array for array in known]

    def trials(self, row: Array, share: Array) -> tuple[list[Array], Array, Array]:
        """What is known, what is tried and the signs."""
        owner = self.owner[row]
        here = [array if len(array) == 1 else array[owner] for array in self.known]
        return here, self.trying.valued(share, self.scales[owner]), self.signs[row]

    def missed(self, row: Array, share: Array) -> Array:
        """The misfits (K, n)."""
        return self.trying.misfits(*self.trials(row, share))

    def reach(self, k: int, row: Array, share: Array) -> Array:
        """How far the dyad of a sign can be drawn (K,)."""
        return self.trying.drawable(k, *self.trials(row, share))

    def at(self, row: Array, share: Array) -> tuple[list[Array], list[Array]]:
        """Each misfit, and each factor of how far dyads can be drawn, in order: (K,) each."""
        found = self.trying.run(self.trying.looked_at, *self.trials(row, share))
        choices = [choice for choice in self.trying.choices if choice is not None]
        misfits = [found[one.misfit] for one in self.trying.unknowns]
        with np.errstate(all="ignore"):
            reaches = [
                factor for _, far, args in choices for factor in far(*(found[arg] for arg in args))
            ]
        count = len(row)
        return (
            [np.broadcast_to(each, count) for each in misfits],
            [np.broadcast_to(each, count) for each in reaches],
        )
