"""Groups in which several links are tried at once: where all that was cut fits again.

Cells of a grid in which no misfit can vanish are left out, the others halved a few times; Newton's
method closes in from each that is left. What this finds is a closure. One may be missed whose
dyads can be drawn only within less than a step of the grid, or that all but merges with another.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, NamedTuple

from graphkin.construction.higher_class.closure_solver import Closures, Trying, sign_table
from graphkin.construction.higher_class.trial import FAR
from graphkin.numbers.arithmetic import phase

ACROSS = {2: 120, 3: 32}
"""Steps of the grid along each of so many unknowns."""
FEWEST = 12
"""Steps along each of more."""
HALVED = 4
"""How often cells are halved."""
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
NEAR = 64.0
"""How far it may lead from where it starts, in halves of a cell."""
BESIDE = 12.0
"""How far in v beside a flat dyad, in parts of what half a cell makes of it."""
STARTS = (0.1, 0.6)
"""Where it starts in v, on the side of the dyad's sign."""
CLUSTERED = 3
"""The step before which those are left out that come to one place."""
TOGETHER = 1e-5
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

    @property
    def across(self) -> int:
        """Steps of the grid along each unknown."""
        return ACROSS.get(len(self.unknowns), FEWEST)

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

        inner = self.inner

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
        import numpy as np

        tried, rest = value[: len(self.unknowns)], value[len(self.unknowns) :]
        angles = (
            phase(complex(each)) if one.turns else float(each)
            for one, each in zip(self.unknowns, tried, strict=True)
        )
        return np.array([*angles, *map(float, rest)])

    def places(self, known: Sequence[Any], size: int) -> int:
        """At how many places each element is tried."""
        return int((self.across + 1) ** len(self.unknowns))

    def work(self, known: Sequence[Any]) -> int:
        """How many steps run where everything that closes is sought on known values, at least."""
        return int(self.places(known, 1) * 2 ** len(self.signs) * len(self.ready.moving))

    def closures(self, known: Sequence[Any]) -> Closures:
        """Every closure of every element of known values, in the order of their numbers."""
        import numpy as np

        size = len(known[0]) if known else 1
        table = np.array(sign_table(len(self.signs)), dtype=float).reshape(-1, len(self.signs))
        owner = np.repeat(np.arange(size), len(table))
        signs = np.tile(table, (size, 1))
        scales = self.scales(known, size)

        def missed(row: Array, share: Array) -> Array:
            here = [array[owner[row]] for array in known]
            found = self.found(here, self.valued(share, scales[owner[row]]), signs[row])
            return np.stack([found[one.misfit] for one in self.unknowns], axis=1)

        choices = [k for k, choice in enumerate(self.choices) if choice is not None]
        reaches = [self.reaching(k, known, owner, scales, signs) for k in choices]
        chain = DrawnChain(missed, reaches)
        cells, half, ranges = candidates(chain, len(owner), *self.grid_of_shares())
        start = drawn_places(missed, cells, half)
        found = [closed_in(missed, cells.row, start, NEAR * half, ranges)]
        for k, reach in zip(choices, reaches, strict=True):
            bit = 1 << (len(self.signs) - 1 - k)
            found += FlatDyad(missed, reach, bit).fits(cells, half, ranges)
        row, share = (np.concatenate(column) for column in zip(*found, strict=True))
        tried = self.valued(share, scales[owner[row]])
        touching = np.zeros(row.size, dtype=bool)
        return self.ordered(known, size, owner[row], tried, signs[row], touching)

    def reaching(
        self, k: int, known: Sequence[Any], owner: Array, scales: Array, signs: Array
    ) -> Reach:
        """How far the dyad of a sign can be drawn (K,), of rows (K,) at shares (K, n)."""

        def reach(row: Array, share: Array) -> Array:
            here = [array[owner[row]] for array in known]
            tried = self.valued(share, scales[owner[row]])
            return self.drawable(k, here, tried, signs[row, :k])

        return reach

    def grid_of_shares(self) -> tuple[Array, Array, int]:
        """Where the shares of each unknown begin, how far they go, and how many steps they take."""
        import numpy as np

        ends = [
            (0.123e-3, 2 * np.pi) if one.turns else (-FAR, 2 * FAR) if one.rim is None else (-1, 2)
            for one in self.unknowns
        ]
        start, way = np.array(ends, dtype=float).T
        return start, way, self.across

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

    def sines(self, known: Sequence[Any], tried: Any, signs: Any) -> Any:
        """The least sine of the angles at which a locus crosses what was cut, while all groups
        within are closed, by a small step each way."""
        import numpy as np

        size = len(self.unknowns)
        step = STEP * np.where(
            [one.turns for one in self.unknowns], 1.0, np.maximum(abs(tried), 1e-3)
        )
        misfits, ways = (
            np.zeros((len(tried), size, size)),
            np.zeros((len(tried), size, size), complex),
        )
        here = self.found(known, tried, signs)
        for k in range(size):
            away = np.zeros_like(tried)
            away[:, k] = step[:, k]
            low, high = (self.found(known, tried + way * away, signs) for way in (-1, 1))
            for i, one in enumerate(self.unknowns):
                for slopes, n in ((misfits, one.misfit), (ways, one.locus)):
                    ends = [np.where(np.isfinite(end[n]), end[n], here[n]) for end in (low, high)]
                    slopes[:, i, k] = (ends[1] - ends[0]) / (2 * step[:, k])
        return crossing_sines(misfits, ways)


def crossing_sines(misfits: Array, ways: Array) -> Array:
    """The least sine of the crossings of each row, from slopes (K, n, n) of misfits and loci.

    An unknown moves while those within close; slopes without a value count as a sine of zero.
    """
    import numpy as np

    count, size, _ = misfits.shape
    least = np.ones(count)
    with np.errstate(all="ignore"):
        for k in range(size):
            way = np.zeros((count, size))
            way[:, k] = 1
            if k + 1 < size:
                inner = misfits[:, k + 1 :, k + 1 :]
                good = np.isfinite(inner).all(axis=(1, 2)) & (
                    abs(np.linalg.det(np.where(np.isfinite(inner), inner, 0))) > 0
                )
                inner = np.where(good[:, None, None], inner, np.eye(size - k - 1))
                led = np.linalg.solve(inner, -misfits[:, k + 1 :, k, None])[..., 0]
                way[:, k + 1 :] = np.where(good[:, None], led, np.nan)
            across = abs((misfits[:, k] * way).sum(axis=1))
            sine = np.minimum(across / abs((ways[:, k] * way).sum(axis=1)), 1.0)
            least = np.minimum(least, np.where(np.isfinite(sine), sine, 0.0))
    return least


# --- where all misfits vanish --------------------------------------------------------------------


class Cells(NamedTuple):
    """Boxes of shares: whose each is (C,), its middle (C, n)."""

    row: Array
    middle: Array


def joined(cells: Sequence[Cells]) -> Cells:
    """Some cells after others."""
    import numpy as np

    return Cells(*(np.concatenate(column) for column in zip(*cells, strict=True)))


class DrawnChain(NamedTuple):
    """What is looked at in a cell: misfits, and how far each dyad can be drawn, in order."""

    missed: Misses
    reaches: Sequence[Reach]

    def at(self, row: Array, share: Array) -> tuple[Array, Array]:
        """Both at places (K, n): misfits (K, n), reaches (K, dyads)."""
        import numpy as np

        reaches = [reach(row, share) for reach in self.reaches]
        return self.missed(row, share), np.stack([np.zeros(len(row)), *reaches], axis=1)


def candidates(
    chain: DrawnChain, rows: int, start: Array, way: Array, steps: int
) -> tuple[Cells, Array, Array]:
    """Small cells in which all misfits of a row may vanish, half their sides (n,), and how far each
    misfit of a row ranges (rows, n).

    Shares begin at a start and go so far, in so many steps.
    """
    import numpy as np

    size, side = len(start), way / steps
    lattice = start + np.array([*product(range(steps + 1), repeat=size)]) * side
    found, ranges = list[Cells](), np.empty((rows, size))
    strides = (steps + 1) ** np.arange(size)[::-1]
    first = np.array([*product(range(steps), repeat=size)])
    corners = (first[:, None, :] + corners_of(size)) @ strides
    for row in range(rows):
        value, reach = chain.at(np.full(len(lattice), row), lattice)
        ranges[row] = spread(value)
        keep = may_vanish(value[corners], reach[corners], ranges[row], side)
        found.append(Cells(np.full(keep.sum(), row), start + (first[keep] + 0.5) * side))
    cells, half = joined(found), side / 2
    for _ in range(HALVED):
        parts = range(0, len(cells.row), CELLS)
        some = (Cells(cells.row[k : k + CELLS], cells.middle[k : k + CELLS]) for k in parts)
        cells = joined([halved(chain, each, half, ranges) for each in some] or [cells])
        half = half / 2
    return cells, half, ranges


def corners_of(size: int) -> Array:
    """The corners of a cell, of shares nought and one."""
    import numpy as np

    return np.array([*product((0, 1), repeat=size)])


def spread(value: Array) -> Array:
    """The range of each misfit over places (K, n); NaN where it has no value anywhere."""
    import numpy as np

    if not np.isfinite(value).all(axis=1).any():
        return np.full(value.shape[1], np.nan)
    return np.nanmax(value, axis=0) - np.nanmin(value, axis=0)


def may_vanish(value: Array, reach: Array, ranges: Array, side: Array) -> Array:
    """Of which cells all misfits may vanish within: from those at the corners (C, 2^n, n), or where
    no corner can be drawn from how far dyads are from that (C, 2^n, dyads)."""
    import numpy as np

    finite = np.isfinite(value).all(axis=2)
    low, high = ends(np.where(finite[..., None], value, np.nan))
    edge = ~finite.all(axis=1)
    with np.errstate(all="ignore"):
        more = (high - low) * np.where(edge, AT_EDGE, SLACK)[:, None]
        bent = np.where(edge, np.sqrt(side.max()), BENT * side.max() ** 2)
        more = more + bent[:, None] * ranges
        crossed = ((low - more <= 0) & (high + more >= 0)).all(axis=1)
        low, high = ends(reach)
        drawn = ~(high + (high - low) * SLACK < 0).any(axis=1)
    return np.where(finite.any(axis=1), crossed, drawn & np.isfinite(ranges).all(axis=-1))


def ends(value: Array) -> tuple[Array, Array]:
    """The least and the largest of the corners (C, K); NaN where none has a value."""
    import numpy as np

    there = np.isfinite(value)
    low = np.where(there, value, np.inf).min(axis=1)
    high = np.where(there, value, -np.inf).max(axis=1)
    return np.where(low <= high, low, np.nan), np.where(low <= high, high, np.nan)


def halved(chain: DrawnChain, cells: Cells, half: Array, ranges: Array) -> Cells:
    """The halves, in each direction, of cells in which all misfits may vanish."""
    import numpy as np

    size = len(half)
    nodes = np.array([*product((-1, 0, 1), repeat=size)])
    places = (cells.middle[:, None, :] + nodes * half).reshape(-1, size)
    found = chain.at(np.repeat(cells.row, len(nodes)), places)
    value, reach = (each.reshape(len(cells.row), len(nodes), -1) for each in found)
    strides, parts = 3 ** np.arange(size)[::-1], list[Cells]()
    for first in corners_of(size):
        at = (first + corners_of(size)) @ strides
        keep = may_vanish(value[:, at], reach[:, at], ranges[cells.row], half)
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

    place = np.round((share[which] + way) / TOGETHER)
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
