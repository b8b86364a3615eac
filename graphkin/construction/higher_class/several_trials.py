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
ROUNDS = 40
"""Steps of Newton's method at most."""
SHORTER = 8
"""How often a step is halved that leads beyond what can be drawn, or no nearer."""
STEP = 1e-6
"""Half the step of the differences that give slopes, in radians or shares of a way."""
STILL = 1e-10
"""A step so small that Newton's method has come to rest, in radians or shares of a way."""
CLOSED = 1e-9
"""Misfit left at a closure at most, in parts of its range all round."""

Array = Any
Misses = Callable[[Array, Array], Array]
"""The misfits (K, n) of rows (K,) at shares (K, n)."""


class SeveralTrials(Trying, frozen=True, dict=True):
    """A trial of several links at once, and where it fits: trial values are rows of an array."""

    @property
    def across(self) -> int:
        """Steps of the grid along each unknown."""
        return ACROSS.get(len(self.unknowns), FEWEST)

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

        row, share = fits(missed, len(owner), *self.grid_of_shares())
        tried = self.valued(share, scales[owner[row]])
        touching = np.zeros(row.size, dtype=bool)
        return self.ordered(known, size, owner[row], tried, signs[row], touching)

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
        step = STEP * np.where([one.turns for one in self.unknowns], 1.0, np.maximum(abs(tried), 1e-3))
        misfits, ways = np.zeros((len(tried), size, size)), np.zeros((len(tried), size, size), complex)
        for k in range(size):
            away = np.zeros_like(tried)
            away[:, k] = step[:, k]
            low, high = (self.found(known, tried + way * away, signs) for way in (-1, 1))
            for i, one in enumerate(self.unknowns):
                misfits[:, i, k] = (high[one.misfit] - low[one.misfit]) / (2 * step[:, k])
                ways[:, i, k] = (high[one.locus] - low[one.locus]) / (2 * step[:, k])
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
                good = np.isfinite(inner).all(axis=(1, 2)) & (abs(np.linalg.det(np.where(np.isfinite(inner), inner, 0))) > 0)
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


def fits(missed: Misses, rows: int, start: Array, way: Array, steps: int) -> tuple[Array, Array]:
    """Every place at which all misfits of a row vanish, as far as the grid shows: row and shares.

    A place may be found more than once.
    """
    import numpy as np

    size = len(start)
    side = way / steps
    lattice = start + np.array([*product(range(steps + 1), repeat=size)]) * side
    found, ranges = list[Cells](), np.empty((rows, size))
    corners = np.array([*product((0, 1), repeat=size)])
    strides = (steps + 1) ** np.arange(size)[::-1]
    first = np.array([*product(range(steps), repeat=size)])
    for row in range(rows):
        value = missed(np.full(len(lattice), row), lattice)
        ranges[row] = spread(value)
        at = value[(first[:, None, :] + corners) @ strides]
        keep = may_vanish(at, ranges[row], side)
        found.append(Cells(np.full(keep.sum(), row), start + (first[keep] + 0.5) * side))
    cells = Cells(*(np.concatenate(column) for column in zip(*found, strict=True)))
    half = side / 2
    for _ in range(HALVED):
        parts = [
            halved(missed, Cells(cells.row[k : k + CELLS], cells.middle[k : k + CELLS]), half, ranges)
            for k in range(0, len(cells.row), CELLS)
        ]
        if not parts:
            break
        cells = Cells(*(np.concatenate(column) for column in zip(*parts, strict=True)))
        half = half / 2
    return closed_in(missed, cells, half, ranges)


def spread(value: Array) -> Array:
    """The range of each misfit over places (K, n); NaN where it has no value anywhere."""
    import numpy as np

    if not np.isfinite(value).all(axis=1).any():
        return np.full(value.shape[1], np.nan)
    return np.nanmax(value, axis=0) - np.nanmin(value, axis=0)


def may_vanish(at: Array, ranges: Array, side: Array) -> Array:
    """Of which cells all misfits may vanish within, from what they are at the corners (C, 2^n, n).

    A cell of which no corner can be drawn is left out.
    """
    import numpy as np

    finite = np.isfinite(at).all(axis=2)
    there = finite.any(axis=1)
    low = np.min(np.where(finite[..., None], at, np.inf), axis=1)
    high = np.max(np.where(finite[..., None], at, -np.inf), axis=1)
    edge = ~finite.all(axis=1)
    with np.errstate(all="ignore"):
        more = (high - low) * np.where(edge, AT_EDGE, SLACK)[:, None]
        more = more + np.where(edge, np.sqrt(side.max()), BENT * side.max() ** 2)[:, None] * ranges
        return there & ((low - more <= 0) & (high + more >= 0)).all(axis=1)


def halved(missed: Misses, cells: Cells, half: Array, ranges: Array) -> Cells:
    """The halves, in each direction, of cells in which all misfits may vanish."""
    import numpy as np

    size = len(half)
    nodes = np.array([*product((-1, 0, 1), repeat=size)])
    places = cells.middle[:, None, :] + nodes * half
    row = np.repeat(cells.row, len(nodes))
    value = missed(row, places.reshape(-1, size)).reshape(len(cells.row), len(nodes), size)
    strides = 3 ** np.arange(size)[::-1]
    corners = np.array([*product((0, 1), repeat=size)])
    found = list[Cells]()
    for first in corners:
        at = value[:, (first + corners) @ strides]
        keep = may_vanish(at, ranges[cells.row], half)
        middle = cells.middle + (first - 0.5) * half
        found.append(Cells(cells.row[keep], middle[keep]))
    return Cells(*(np.concatenate(column) for column in zip(*found, strict=True)))


def closed_in(missed: Misses, cells: Cells, half: Array, ranges: Array) -> tuple[Array, Array]:
    """Where Newton's method comes to rest from cells: rows and shares.

    Steps are halved that lead beyond what can be drawn, or no nearer.
    """
    import numpy as np

    row, share = cells.row, cells.middle.copy()
    if not row.size:
        return row, share
    value = missed(row, share)
    corners = np.array([*product((-1, 1), repeat=len(half))])
    for corner in corners:
        lost = ~np.isfinite(value).all(axis=1)
        share[lost] = cells.middle[lost] + corner * half
        value[lost] = missed(row[lost], share[lost])
    good = np.isfinite(value).all(axis=1)
    row, share, value = row[good], share[good], value[good]
    scale = ranges[row]
    rest = np.zeros(row.size, dtype=bool)
    for _ in range(ROUNDS):
        if not (live := np.flatnonzero(~rest)).size:
            break
        way = steps_of(missed, row[live], share[live], value[live])
        moved = np.zeros(live.size, dtype=bool)
        for shorter in range(SHORTER):
            left = np.flatnonzero(~moved & np.isfinite(way).all(axis=1))
            if not left.size:
                break
            trial = share[live[left]] + way[left] / 2**shorter
            found = missed(row[live[left]], trial)
            nearer = far(found, scale[live[left]]) < far(value[live[left]], scale[live[left]])
            small = (abs(way[left]) < STILL).all(axis=1)
            take = left[nearer]
            share[live[take]], value[live[take]] = trial[nearer], found[nearer]
            moved[take] = True
            moved[left[small]] = True
        small = np.isfinite(way).all(axis=1) & (abs(way) < STILL).all(axis=1)
        stopped = ~moved | small
        rest[live[stopped]] = True
        share[live[~moved & ~small]] = np.nan
    good = np.isfinite(share).all(axis=1) & (far(value, scale) < CLOSED)
    return row[good], share[good]


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
        away = np.zeros(size)
        away[k] = STEP
        low, high = missed(row, share - away), missed(row, share + away)
        slope[:, :, k] = np.where(
            np.isfinite(high) & np.isfinite(low),
            (high - low) / (2 * STEP),
            np.where(np.isfinite(high), (high - value) / STEP, (value - low) / STEP),
        )
    good = np.isfinite(slope).all(axis=(1, 2))
    good &= abs(np.linalg.det(np.where(good[:, None, None], slope, 0))) > 0
    slope = np.where(good[:, None, None], slope, np.eye(size))
    found = np.linalg.solve(slope, -value[..., None])[..., 0]
    return np.where(good[:, None], found, np.nan)
