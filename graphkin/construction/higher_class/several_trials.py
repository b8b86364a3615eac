"""Groups in which several links are tried at once: where all that was cut fits again.

Cells of a grid in which no misfit can vanish are left out, the others halved a few times; Newton's
method closes in from each that is left. What this finds is a closure. One may be missed whose
dyads can be drawn only within less than a step of the grid, or that all but merges with another.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, partial
from itertools import product
from typing import Any, NamedTuple

from graphkin.construction.core.batch import Ready, made_ready, run_moving
from graphkin.construction.higher_class.closure_solver import Closures, Trying, sign_table
from graphkin.construction.higher_class.trial import FAR
from graphkin.numbers.arithmetic import batch_kind, phase

ACROSS = {2: 120, 3: 32, 4: 12}
"""Steps of the grid along each unknown, by how many are tried before any misfit tells anything."""
FEWER = 60
"""Steps along each where two of more do."""
TOGETHER = 64
"""Elements that are closed at once."""
MOST = 1_000_000
"""Places at which cells are looked at together."""
HALVED = 4
"""How often cells of two unknowns are halved; those of more are too many."""
SLACK = 0.5
"""By how much a misfit may vanish beyond what it is at a cell's corners, in parts of its range
there: what curves it."""
AT_EDGE = 2.0
"""The same where a corner cannot be drawn: beside a flat dyad the misfit grows like a root."""
BENT = 0.5
"""The same in parts of its range all round, for the square of a cell's side in radians."""
CELLS = 40_000
"""Cells looked at together."""
ROUNDS = 20
"""Steps of Newton's method at most."""
HOPEFUL = 7
"""The step before which those are left out that miss by too much still."""
LEFT = 1e-3
"""What they may miss by then, in parts of the ranges of misfits; where two closures merge each step
halves the way that is left."""
NEAR = 64.0
"""How far it may lead from where it starts, in halves of a cell."""
BESIDE = 12.0
"""How far in v beside a flat dyad, in parts of what half a cell makes of it."""
STARTS = (0.1, 0.6)
"""Where it starts in v, on the side of the dyad's sign."""
CLUSTERED = 3
"""The step before which those are left out that come to one place."""
ONE_PLACE = 1e-5
"""Shares that differ less are those of one place then."""
SHORTER = 8
"""How often a step is halved that leads beyond what can be drawn, or no nearer."""
STEP = 1e-6
"""Half the step of the differences that give slopes, in radians or shares of a way."""
FLAT = 3.0
"""How far from a flat dyad a cell may lie that is looked at beside it, in parts of its size."""
LEADING = 5
"""Steps along the secant that find the share for a v."""
STILL = 1e-10
"""A step so small that Newton's method has come to rest, in radians or shares of a way."""
TRACES = 40
"""Places to both sides of a closure at which a locus is drawn."""
TRACED = 0.02
"""How far they lie apart, in radians or parts of the way that is tried."""
TRACING = 4
"""Steps of Newton's method for each."""
CLOSED = 1e-9
"""Misfit left at a closure at most, in parts of its range all round."""

Array = Any
Misses = Callable[[Array, Array], Array]
"""The misfits (K, n) of rows (K,) at shares (K, n)."""
Reach = Callable[[Array, Array], Array]
"""How far a dyad can be drawn (K,): positive where it can; NaN where one before it cannot."""


class SeveralTrials(Trying, frozen=True, dict=True):
    """A trial of several links at once, and where it fits: trial values are rows of an array."""

    def loci(self, known: Sequence[Any], value: Sequence[Any]) -> list[Any]:
        """Where the traced points go beside a closure while the outermost link is tried, those
        within closed each time: (N,) each, as far as they close."""
        import numpy as np

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
        import numpy as np

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
        import numpy as np

        def missed(row: Array, share: Array) -> Array:
            found = self.found([array[row] for array in known], share, signs[row])
            return np.stack([found[one.misfit] for one in self.unknowns], axis=1)

        share, left = tried.copy(), np.arange(len(tried))
        for _ in range(ROUNDS):
            way = steps_of(missed, left, share[left], missed(left, share[left]))
            share[left] += way
            left = left[~(abs(way) < STILL).all(axis=1) & np.isfinite(way).all(axis=1)]
            if not left.size:
                break
        share[left] = np.nan
        return share

    def row_of(self, value: Sequence[Any]) -> Array:
        """A closure as numbers: trial values, signs, the sine of crossing."""
        import numpy as np

        tried, rest = value[: len(self.unknowns)], value[len(self.unknowns) :]
        angles = (
            phase(complex(each)) if one.turns else float(each)
            for one, each in zip(self.unknowns, tried, strict=True)
        )
        return np.array([*angles, *map(float, rest)])

    def together(self, known: Sequence[Any], size: int) -> int:
        """How many elements are closed at once."""
        return TOGETHER

    def work(self, known: Sequence[Any]) -> int:
        """How many steps run where everything that closes is sought on known values, at least."""
        places = (self.across + 1) ** self.dense
        return int(places * 2 ** len(self.signs) * len(self.ready.moving))

    def closures(self, known: Sequence[Any]) -> Closures:
        """Every closure of every element of known values, in the order of their numbers."""
        import numpy as np

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
        cells, half = narrowed(chain, cells, half, ranges)
        start = drawn_places(chain.missed, cells, half)
        fits = [closed_in(chain.missed, cells.row, start, NEAR * half, ranges)]
        for k, choice in enumerate(self.choices):
            if choice is not None:
                bit = 1 << (len(self.signs) - 1 - k)
                flat = FlatDyad(chain.missed, partial(chain.reach, k), bit)
                fits += flat.fits(cells, half, ranges)
        row, share = (np.concatenate(column) for column in zip(*fits, strict=True))
        tried = self.valued(share, scales[owner[row]])
        touching = np.zeros(row.size, dtype=bool)
        return self.ordered(known, size, owner[row], tried, signs[row], touching)

    def grid_of_shares(self) -> tuple[Array, Array]:
        """Where the shares of each unknown begin, and how far they go."""
        import numpy as np

        ends = [
            (0.123e-3, 2 * np.pi) if one.turns else (-FAR, 2 * FAR) if one.rim is None else (-1, 2)
            for one in self.unknowns
        ]
        start, way = np.array(ends, dtype=float).T
        return start, way

    def scales(self, known: Sequence[Any], size: int) -> Array:
        """What the trial values of each element are measured by, a column for each unknown."""
        import numpy as np

        return np.stack(
            [
                np.broadcast_to(1.0 if one.reach is None else self.at_start(known, one.reach), size)
                for one in self.unknowns
            ],
            axis=1,
        )

    def valued(self, share: Array, scale: Array) -> Array:
        """Trial values from shares: angles, and coordinates along guides and tracks."""
        import numpy as np

        guided = [not one.turns and one.rim is None for one in self.unknowns]
        return scale * np.where(guided, np.tan(np.where(guided, share, 0.0)), share)

    # --- cells in which all may vanish -----------------------------------------------------------

    def readied(self, keep: tuple[int, ...]) -> Ready:
        """The part of the program that gives some steps, made ready for arrays."""
        needed = self.program.behind(keep)
        return made_ready(self.program, needed, self.values, keep, self.outside)

    @cached_property
    def missing(self) -> Ready:
        """What gives the misfits."""
        return self.readied(tuple(one.misfit for one in self.unknowns))

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
        import numpy as np

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
                ends = np.fmin.reduce(spans[:, 0]), np.fmax.reduce(spans[:, 1])
                ranges[misfit] = ends[1] - ends[0]
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
        import numpy as np

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
            share = start[k] + steps * (way[k] / across)
            guided = not one.turns and one.rim is None
            value = scale[k] * (np.tan(share) if guided else share)
            overrides[one.tried] = np.exp(1j * value) if one.turns else value
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
            reaches = [far(*(trace.values[arg] for arg in args)) for far, args in stage.reaches]
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
    def spans(self) -> list[tuple[float, float]]:
        """The least and the largest value of each misfit; NaN without any."""
        import numpy as np

        return [
            (np.fmin.reduce(each, axis=None), np.fmax.reduce(each, axis=None))
            if each.size
            else (np.nan, np.nan)
            for each in self.misfits
        ]

    def kept(self, ranges: Array, side: Array) -> tuple[Array, Array]:
        """The cells along one more unknown in which all misfits may vanish: rows and places."""
        import numpy as np

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
        import numpy as np

        return self.over(np.fmin, value), self.over(np.fmax, value)

    def over(self, both: Any, value: Array) -> Array:
        """What all corners of each cell make of a value."""
        value = both(value[..., :-1], value[..., 1:])
        found = value[self.which[:, 0]]
        for nodes in self.which.T[1:]:
            found = both(found, value[nodes])
        return found


# --- where all misfits vanish --------------------------------------------------------------------


class Cells(NamedTuple):
    """Boxes of shares: whose each is (C,), its middle (C, n)."""

    row: Array
    middle: Array


def joined(cells: Sequence[Cells]) -> Cells:
    """Some cells after others."""
    import numpy as np

    return Cells(*(np.concatenate(column) for column in zip(*cells, strict=True)))


class DrawnChain:
    """What is looked at, of rows (K,) at shares (K, n): each row has its element and its signs."""

    def __init__(
        self, trying: SeveralTrials, known: Sequence[Any], owner: Array, signs: Array, scales: Array
    ) -> None:
        self.trying, self.owner, self.signs, self.scales = trying, owner, signs, scales
        self.known = [array[:1] if (array == array[0]).all() else array for array in known]

    def run(self, ready: Ready, row: Array, share: Array) -> Mapping[int, Any]:
        """What a program gives."""
        import numpy as np

        owner = self.owner[row]
        here = [array if len(array) == 1 else array[owner] for array in self.known]
        tried = self.trying.valued(share, self.scales[owner])
        overrides = self.trying.overrides(here, tried, self.signs[row])
        with np.errstate(all="ignore"):
            kind = batch_kind()
            return run_moving(ready, self.trying.values, kind, overrides=overrides).values

    def missed(self, row: Array, share: Array) -> Array:
        """The misfits (K, n)."""
        import numpy as np

        found = self.run(self.trying.missing, row, share)
        misfits = (found[one.misfit] for one in self.trying.unknowns)
        return np.stack([np.broadcast_to(each, len(row)) for each in misfits], axis=1)

    def reach(self, k: int, row: Array, share: Array) -> Array:
        """How far the dyad of a sign can be drawn (K,)."""
        import numpy as np

        choice = self.trying.choices[k]
        assert choice is not None
        ready, far, args = choice
        found = self.run(ready, row, share)
        with np.errstate(all="ignore"):
            return np.broadcast_to(far(*(found[arg] for arg in args)), len(row))

    def at(self, row: Array, share: Array) -> tuple[list[Array], list[Array]]:
        """Each misfit, and how far each dyad can be drawn, in their order: (K,) each."""
        import numpy as np

        found = self.run(self.trying.looked_at, row, share)
        choices = [choice for choice in self.trying.choices if choice is not None]
        misfits = [found[one.misfit] for one in self.trying.unknowns]
        with np.errstate(all="ignore"):
            reaches = [far(*(found[arg] for arg in args)) for _, far, args in choices]
        count = len(row)
        return (
            [np.broadcast_to(each, count) for each in misfits],
            [np.broadcast_to(each, count) for each in reaches],
        )


def narrowed(chain: DrawnChain, cells: Cells, half: Array, ranges: Array) -> tuple[Cells, Array]:
    """Small parts of cells in which all misfits of a row may vanish, and half their sides (n,)."""
    for _ in range(HALVED if len(half) == 2 else 0):
        parts = range(0, len(cells.row), CELLS)
        some = (Cells(cells.row[k : k + CELLS], cells.middle[k : k + CELLS]) for k in parts)
        cells = joined([halved(chain, each, half, ranges) for each in some] or [cells])
        half = half / 2
    return cells, half


def corners_of(size: int) -> Array:
    """The corners of a cell, of shares nought and one."""
    import numpy as np

    return np.array([*product((0, 1), repeat=size)])


def may_vanish(
    misfits: Sequence[tuple[Array, Array]],
    reaches: Sequence[tuple[Array, Array]],
    some: Array,
    whole: Array,
    ranges: Array,
    side: Array,
) -> Array:
    """Of which cells all misfits may vanish within: from the least and the largest at the corners,
    or where no corner can be drawn from how far dyads are from that.

    ``some`` and ``whole`` tell whether some corners, or all, can be drawn; ``ranges`` how far
    misfits range.
    """
    import numpy as np

    bent = np.where(whole, BENT * side.max() ** 2, np.sqrt(side.max()))
    slack, crossed, drawn = np.where(whole, SLACK, AT_EDGE), some, ~some
    with np.errstate(all="ignore"):
        for (low, high), most in zip(misfits, np.moveaxis(ranges, -1, 0), strict=True):
            more = (high - low) * slack + bent * most
            crossed = crossed & (low - more <= 0) & (high + more >= 0)
            drawn = drawn & np.isfinite(most)
        for low, high in reaches:
            drawn = drawn & ~(high + (high - low) * SLACK < 0)
    found: Array = crossed | drawn
    return found


def halved(chain: DrawnChain, cells: Cells, half: Array, ranges: Array) -> Cells:
    """The halves, in each direction, of cells in which all misfits may vanish."""
    import numpy as np

    size = len(half)
    nodes = np.array([*product((-1, 0, 1), repeat=size)])
    places = (cells.middle[:, None, :] + nodes * half).reshape(-1, size)
    found = chain.at(np.repeat(cells.row, len(nodes)), places)
    value, reach = (np.array(each).reshape(len(each), len(cells.row), len(nodes)) for each in found)
    finite = np.isfinite(value).all(axis=0)
    value = np.where(finite, value, np.nan)
    strides, parts = 3 ** np.arange(size)[::-1], list[Cells]()
    for first in corners_of(size):
        at = (first + corners_of(size)) @ strides
        some, whole = finite[:, at].any(axis=1), finite[:, at].all(axis=1)
        misfits, reaches = (
            [(np.fmin.reduce(each[:, at], 1), np.fmax.reduce(each[:, at], 1)) for each in every]
            for every in (value, reach)
        )
        keep = may_vanish(misfits, reaches, some, whole, ranges[cells.row], half)
        parts.append(Cells(cells.row[keep], cells.middle[keep] + (first - 0.5) * half))
    return joined(parts)


def closed_in(
    missed: Misses, row: Array, start: Array, near: Array, ranges: Array
) -> tuple[Array, Array]:
    """Where Newton's method comes to rest from starts (K, n), no farther than ``near`` (n,): rows
    and shares.

    Steps are halved that lead beyond what can be drawn, or no nearer.
    """
    import numpy as np

    share, value = start.copy(), missed(row, start)
    which = np.flatnonzero(np.isfinite(value).all(axis=1))
    found = [np.empty(0, dtype=int)]
    for turn in range(ROUNDS):
        if turn == HOPEFUL:
            which = which[far(value[which], ranges[row[which]]) < LEFT]
        if not which.size:
            break
        way = steps_of(missed, row[which], share[which], value[which])
        aim = share[which] + way
        good = np.isfinite(aim).all(axis=1) & (abs(aim - start[which]) <= near).all(axis=1)
        which, way = which[good], way[good]
        which, way = apart(row, share, which, way) if turn == CLUSTERED else (which, way)
        rest = (abs(way) < STILL).all(axis=1)
        share[which[rest]] += way[rest]
        found.append(which[rest])
        which, way = which[~rest], way[~rest]
        scale, waiting = ranges[row[which]], np.ones(which.size, dtype=bool)
        for shorter in range(SHORTER):
            left = np.flatnonzero(waiting)
            if not left.size:
                break
            trial = share[which[left]] + way[left] / 2**shorter
            there = missed(row[which[left]], trial)
            nearer = far(there, scale[left]) < far(value[which[left]], scale[left])
            took = left[nearer]
            share[which[took]], value[which[took]] = trial[nearer], there[nearer]
            waiting[took] = False
        still = which[waiting]
        found.append(still[far(value[still], ranges[row[still]]) < CLOSED])
        which = which[~waiting]
    every = np.concatenate(found)
    every = every[far(value[every], ranges[row[every]]) < CLOSED]
    return row[every], share[every]


def apart(row: Array, share: Array, which: Array, way: Array) -> tuple[Array, Array]:
    """Of those that all but stand at one place only one, with the steps of each."""
    import numpy as np

    place = np.round((share[which] + way) / ONE_PLACE)
    _, first = np.unique(np.column_stack([row[which], place]), axis=0, return_index=True)
    return which[first], way[first]


def drawn_places(missed: Misses, cells: Cells, half: Array) -> Array:
    """A place of each cell that can be drawn: its middle, else a corner."""
    import numpy as np

    share = cells.middle.copy()
    lost = np.arange(len(share))
    for corner in np.array([[0] * len(half), *product((-1, 1), repeat=len(half))]):
        share[lost] = cells.middle[lost] + corner * half
        lost = lost[~np.isfinite(missed(cells.row[lost], share[lost])).all(axis=1)]
        if not lost.size:
            break
    return share


class FlatDyad(NamedTuple):
    """Beside the places where the dyad of one sign is stretched flat: its two signs meet there.

    With v, the root of how far it can be drawn, taken with its sign, in place of the share that
    moves it most, misfits run smoothly through the flat dyad. ``bit`` is that of its sign in rows.
    """

    missed: Misses
    reach: Reach
    bit: int

    def fits(self, cells: Cells, half: Array, ranges: Array) -> list[tuple[Array, Array]]:
        """The fits near cells that the dyad does not reach all over: rows and shares."""
        import numpy as np

        here = self.reach(cells.row, cells.middle)
        slopes = np.empty(cells.middle.shape)
        for j, side in enumerate(half):
            away = np.where(np.arange(len(half)) == j, side, 0.0)
            low, high = (self.reach(cells.row, cells.middle + way * away) for way in (-1, 1))
            slopes[:, j] = (high - low) / (2 * side)
        size = abs(slopes * half)
        with np.errstate(all="ignore"):
            near = abs(here) < FLAT * size.sum(axis=1)
        most = size.argmax(axis=1)
        found = list[tuple[Array, Array]]()
        for j in range(len(half)):
            mine = np.flatnonzero(near & (most == j))
            if mine.size:
                some = Cells(cells.row[mine], cells.middle[mine])
                found.append(self.fits_beside(j, some, slopes[mine, j], half, ranges))
        return found

    def fits_beside(
        self, j: int, cells: Cells, slope: Array, half: Array, ranges: Array
    ) -> tuple[Array, Array]:
        """The fits near cells with v in place of a share whose ``slope`` of the reach is known."""
        import numpy as np

        row, middle = cells
        scale, plain = np.sqrt(abs(slope) * half[j]), row & ~self.bit

        def placed(which: Array, share: Array) -> tuple[Array, Array]:
            v, at, rise = share[:, j] * scale[which], share.copy(), slope[which]
            at[:, j], own = middle[which, j], plain[which]
            here = self.reach(own, at)
            for _ in range(LEADING):
                way = (v * v - here) / rise
                at[:, j] += way
                before, here = here, self.reach(own, at)
                moved = (way != 0) & np.isfinite(here) & (here != before)
                rise = np.where(moved, (here - before) / np.where(way == 0, 1.0, way), rise)
            return np.where(v < 0, own | self.bit, own), at

        def missed(which: Array, share: Array) -> Array:
            return self.missed(*placed(which, share))

        near = NEAR * half
        near[j] = BESIDE
        start = np.tile(middle, (len(STARTS), 1))
        start[:, j] = np.repeat(STARTS, row.size) * np.tile(
            np.where(row & self.bit, -1, 1), len(STARTS)
        )
        which, share = closed_in(
            missed, np.tile(np.arange(row.size), len(STARTS)), start, near, ranges[row]
        )
        return placed(which, share)


def far(value: Array, scale: Array) -> Array:
    """How large misfits are, in parts of their ranges; infinite without a value."""
    import numpy as np

    size = np.sqrt(((value / scale) ** 2).sum(axis=1))
    return np.where(np.isfinite(size), size, np.inf)


def steps_of(missed: Misses, row: Array, share: Array, value: Array) -> Array:
    """The steps of Newton's method; NaN where there is no slope."""
    import numpy as np

    size = share.shape[1]
    slope = np.empty((len(row), size, size))
    for k in range(size):
        away = np.where(np.arange(size) == k, STEP, 0.0)
        there, way = missed(row, share + away), np.full(len(row), STEP)
        lost = ~np.isfinite(there).all(axis=1)
        there[lost], way[lost] = missed(row[lost], share[lost] - away), -STEP
        slope[:, :, k] = (there - value) / way[:, None]
    finite: Array = np.isfinite(slope).all(axis=(1, 2))
    area: Array = np.linalg.det(np.where(finite[:, None, None], slope, 0))
    good: Array = finite & (area != 0)
    slope = np.where(good[:, None, None], slope, np.eye(size))
    found = np.linalg.solve(slope, -value[..., None])[..., 0]
    return np.where(good[:, None], found, np.nan)
