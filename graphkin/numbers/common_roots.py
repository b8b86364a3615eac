"""Common roots of n functions of n numbers: cells are narrowed, then Newton's method converges.

``Misses`` gives the functions of rows at places: which rows (K,), where (K, n), their values (K,
n), NaN where they are undefined. ``Reach`` is the distance from the boundary of one definition,
positive inside. Cells in which no function can vanish are left out, and the others are halved a few
times. Newton's method starts from each remaining cell.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, NamedTuple

from graphkin.numbers.arithmetic import is_ball, np
from graphkin.numbers.kinds import middle

HALVED = 4
"""Halvings of cells with two unknowns; cells with more unknowns are too many."""
SLACK = 0.5
"""Slack of a misfit inside a cell beyond its corner values, as a share of their range.

The slack allows for curvature.
"""
AT_EDGE = 2.0
"""SLACK where a corner cannot be drawn: near a flat dyad the misfit grows like a square root."""
BENT = 0.5
"""Further slack as a share of the whole range, for the square of a cell's side in radians."""
BENDING = 0.25
"""Slack as a share of the second differences at the corners; an eighth is what a parabola needs."""
ROOT = 2.0
"""BENT where a corner cannot be drawn, for the square root of that side.

The drawable corners may all be on the flat dyad, and then do not show how the misfit grows away
from it.
"""
CELLS = 40_000
"""Cells examined together."""
ROUNDS = 20
"""The most steps of Newton's method."""
HOPEFUL = 7
"""The step before which starts with too large a misfit are dropped."""
LEFT = 1e-3
"""The misfit allowed by then, as a share of the misfits' ranges.

Where two closures merge, each step only halves the distance left.
"""
NEAR = 64.0
"""The largest distance from the start, in half cells."""
BESIDE = 12.0
"""The largest v near a flat dyad, relative to the v of half a cell."""
STARTS = (0.1, 0.6)
"""The starts in v, on the side of the dyad's sign."""
CLUSTERED = 3
"""The step before which starts that converge to one place are merged."""
ONE_PLACE = 1e-5
"""Difference of shares below which they are one place then."""
SHORTER = 8
"""Halvings of a step that leaves the drawable range or does not come nearer."""
FEW = 1000
"""So few places cost as much together as one alone."""
STEP = 1e-6
"""Half the step of the differences for slopes, in radians or shares of a way."""
NARROW = 1e-8
"""STEP beside a root: where one link hardly turns and others turn far, misfits bend within STEP."""
FLAT = 3.0
"""Distance of a cell from a flat dyad, in cell sizes, up to which it is examined there."""
LEADING = 5
"""Secant steps that find the share for a v."""
ROUNDED = 1e-14
"""Step below which such a share is found, but for rounding."""
STILL = 1e-10
"""Step at which Newton's method has converged, in radians or shares of a way."""
SETTLED = 1e-14
"""The step that would come next at a limit, by how much steps shrink."""
ROUNDING = 64 * 2.0**-52
"""The misfit at a limit, as a share of its slopes times the trial values."""
CLOSED = 1e-9
"""The largest misfit at a closure, as a share of its whole range."""

Array = Any
Misses = Callable[[Array, Array], Array]
"""The misfits (K, n) of rows (K,) at shares (K, n)."""
Reach = Callable[[Array, Array], Array]
"""The reach of a dyad (K,): positive where it can be drawn, NaN where an earlier dyad cannot."""
Looked = Callable[[Array, Array], tuple[Sequence[Array], Sequence[Array]]]
"""Each misfit of rows (K,) at shares (K, n), and the reach of each dyad: (K,) each."""


class Cells(NamedTuple):
    """Boxes of shares: the row of each (C,) and its middle (C, n)."""

    row: Array
    middle: Array


def joined(cells: Sequence[Cells]) -> Cells:
    return Cells(*(np.concatenate(column) for column in zip(*cells, strict=True)))


def common_roots(
    missed: Misses,
    looked: Looked,
    edges: Sequence[tuple[Reach, int]],
    cells: Cells,
    half: Array,
    ranges: Array,
) -> tuple[Array, Array]:
    """The places in or near cells at which all misfits of a row vanish: rows (K,), shares (K, n).

    ``half`` are half the sides of the cells (n,), and ``ranges`` the ranges of each row's misfits
    (R, n). ``edges`` are the dyads that may be stretched flat, each with the bit of its sign in
    rows.
    """
    cells, half = narrowed(looked, cells, half, ranges)
    start = drawn_places(missed, cells, half)
    fits = [closed_in(missed, cells.row, start, NEAR * half, ranges)]
    for reach, bit in edges:
        fits += FlatDyad(missed, reach, bit).fits(cells, half, ranges)
    row, share = (np.concatenate(column) for column in zip(*fits, strict=True))
    return row, share


def narrowed(looked: Looked, cells: Cells, half: Array, ranges: Array) -> tuple[Cells, Array]:
    """Small parts of cells in which all misfits of a row may vanish, and half their sides (n,)."""
    for _ in range(HALVED if len(half) == 2 else 0):
        parts = range(0, len(cells.row), CELLS)
        some = (Cells(cells.row[k : k + CELLS], cells.middle[k : k + CELLS]) for k in parts)
        cells = joined([halved(looked, each, half, ranges) for each in some] or [cells])
        half = half / 2
    return cells, half


def corners_of(size: int) -> Array:
    """The corners of a cell, with coordinates zero and one."""
    return np.array([*product((0, 1), repeat=size)])


def may_vanish(
    misfits: Sequence[tuple[Array, Array, Array]],
    reaches: Sequence[tuple[Array, Array, Array]],
    some: Array,
    whole: Array,
    ranges: Array,
    side: Array,
) -> Array:
    """The cells in which all misfits may vanish.

    The test uses the least and largest values at the corners and how far a misfit bends between
    them, or the dyads' reaches where no corner can be drawn. Where a reach is unknown at a corner,
    with its largest size as the third number, it may change like a square root. ``some`` and
    ``whole`` mark cells of which some or all corners can be drawn. ``ranges`` are the ranges of the
    misfits.
    """
    bent = np.where(whole, BENT * side.max() ** 2, ROOT * np.sqrt(side.max()))
    slack, crossed, drawn = np.where(whole, SLACK, AT_EDGE), some, ~some
    with np.errstate(all="ignore"):
        for (low, high, bend), most in zip(misfits, np.moveaxis(ranges, -1, 0), strict=True):
            more = (high - low) * slack + bent * most + BENDING * bend
            crossed = crossed & (low - more <= 0) & (high + more >= 0)
            drawn = drawn & np.isfinite(most)
        for low, high, edge in reaches:
            more = (high - low) * SLACK + edge * ROOT * np.sqrt(side.max())
            drawn = drawn & ~(high + more < 0)
    found: Array = crossed | drawn
    return found


def halved(looked: Looked, cells: Cells, half: Array, ranges: Array) -> Cells:
    """The halves, in each direction, of cells in which all misfits may vanish."""
    size = len(half)
    nodes = np.array([*product((-1, 0, 1), repeat=size)])
    places = (cells.middle[:, None, :] + nodes * half).reshape(-1, size)
    found = looked(np.repeat(cells.row, len(nodes)), places)
    value, reach = (np.array(each).reshape(len(each), len(cells.row), len(nodes)) for each in found)
    finite = np.isfinite(value).all(axis=0)
    value = np.where(finite, value, np.nan)
    strides, parts = 3 ** np.arange(size)[::-1], list[Cells]()
    bends = [bending(each, size) for each in value]
    most = [np.fmax.reduce(abs(each), axis=None, initial=0.0) for each in reach]
    for first in corners_of(size):
        at = (first + corners_of(size)) @ strides
        some, whole = finite[:, at].any(axis=1), finite[:, at].all(axis=1)
        ends = [(np.fmin.reduce(each[:, at], 1), np.fmax.reduce(each[:, at], 1)) for each in value]
        reaches = [
            (
                np.fmin.reduce(each[:, at], 1),
                np.fmax.reduce(each[:, at], 1),
                np.where(unknown[:, at].any(axis=1), edge, 0.0),
            )
            for each, unknown, edge in zip(reach, np.isnan(reach), most, strict=True)
        ]
        misfits = [(*each, bend) for each, bend in zip(ends, bends, strict=True)]
        keep = may_vanish(misfits, reaches, some, whole, ranges[cells.row], half)
        parts.append(Cells(cells.row[keep], cells.middle[keep] + (first - 0.5) * half))
    return joined(parts)


def bending(value: Array, size: int) -> Array:
    """The sum of the largest second differences along each unknown on 3^n nodes (C, 3^n)."""
    cube = value.reshape(-1, *[3] * size)
    found = np.zeros(len(cube))
    for axis in range(1, size + 1):
        second = abs(np.diff(cube, 2, axis=axis)).reshape(len(cube), -1)
        found += np.fmax.reduce(second, axis=1, initial=0.0)
    return found


def closed_in(
    missed: Misses, row: Array, start: Array, near: Array, ranges: Array
) -> tuple[Array, Array]:
    """The limits of Newton's method from starts (K, n), within ``near`` (n,): rows and shares.

    Steps that leave the drawable range, or do not come nearer, are halved.
    """
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
        parts = 0.5 ** np.arange(SHORTER)
        while parts.size and (left := np.flatnonzero(waiting)).size:
            count = max(1, FEW // left.size)
            some, parts = parts[:count], parts[count:]
            aim = share[which[left]] + way[left] * some[:, None, None]
            count = len(aim)
            there = missed(np.tile(row[which[left]], count), aim.reshape(-1, aim.shape[-1]))
            off = far(there, np.tile(scale[left], (count, 1))).reshape(count, -1)
            nearer = off < far(value[which[left]], scale[left])
            first = nearer.argmax(axis=0), np.arange(left.size)
            took = nearer.any(axis=0)
            share[which[left[took]]] = aim[first][took]
            value[which[left[took]]] = there.reshape(aim.shape)[first][took]
            waiting[left[took]] = False
        still = which[waiting]
        found.append(still[far(value[still], ranges[row[still]]) < CLOSED])
        which = which[~waiting]
    every = np.concatenate(found)
    every = every[far(value[every], ranges[row[every]]) < CLOSED]
    return row[every], share[every]


def roots_beside(missed: Misses, start: Array) -> Array:
    """The limits of Newton's method from starts (K, n); NaN where it does not converge.

    A short step alone is no limit: beside a flat dyad misfits grow like a square root, and steps
    may swing from side to side of the root.
    """
    share, left, last = start.copy(), np.arange(len(start)), np.ones(len(start))
    for turn in range(ROUNDS):
        way, rounded = steps_about(missed, left, share[left])
        size = abs(way).max(axis=1, initial=0.0)
        shrunk = size / last[left] if turn else 1.0
        share[left] += way
        last[left] = size
        closed = (size < STILL) & (rounded | (shrunk * size < SETTLED))
        left = left[~closed & np.isfinite(size)]
        if not left.size:
            return share
    share[left] = np.nan
    return share


def steps_about(missed: Misses, row: Array, share: Array) -> tuple[Array, Array]:
    """The steps of Newton's method, and where what is left is only rounding.

    Slopes come from both sides; from one side at an edge.
    """
    size = share.shape[1]
    away = NARROW * np.vstack([np.zeros(size), np.eye(size), -np.eye(size)])
    value = missed_beside(missed, row, share, away)
    slope = np.moveaxis(value[1 : size + 1] - value[size + 1 :], 0, -1) / (2 * NARROW)
    way = solutions(slope, -value[0])
    grain = (abs(slope) * np.maximum(abs(share), 1.0)[:, None]).sum(axis=2)
    rounded = (abs(value[0]) <= ROUNDING * grain).all(axis=1)
    edge = np.isnan(way).any(axis=1) & np.isfinite(value[0]).all(axis=1)
    if edge.any():
        way[edge] = steps_of(missed, row[edge], share[edge], value[0, edge])
    return way, rounded


def missed_beside(missed: Misses, row: Array, share: Array, away: Array) -> Array:
    """The misfits (A, K, n) at each of the offsets ``away`` (A, n) from shares (K, n)."""
    places = (share + away[:, None]).reshape(-1, share.shape[1])
    return missed(np.tile(row, len(away)), places).reshape(len(away), *share.shape)


def apart(row: Array, share: Array, which: Array, way: Array) -> tuple[Array, Array]:
    """One of each group of starts that are almost at one place, with the step of each."""
    place = np.round((share[which] + way) / ONE_PLACE)
    _, first = np.unique(np.column_stack([row[which], place]), axis=0, return_index=True)
    return which[first], way[first]


def drawn_places(missed: Misses, cells: Cells, half: Array) -> Array:
    """A drawable place of each cell: its middle, otherwise a corner."""
    share = cells.middle.copy()
    lost = np.arange(len(share))
    for corner in np.array([[0] * len(half), *product((-1, 1), repeat=len(half))]):
        share[lost] = cells.middle[lost] + corner * half
        lost = lost[~np.isfinite(missed(cells.row[lost], share[lost])).all(axis=1)]
        if not lost.size:
            break
    return share


class FlatDyad(NamedTuple):
    """The neighbourhood of places where the dyad of one sign is stretched flat and its signs meet.

    The share that changes the reach most is replaced by v, the signed square root of the reach.
    Misfits are then smooth through the flat dyad. ``bit`` is that of the dyad's sign in rows.
    """

    missed: Misses
    reach: Reach
    bit: int

    def fits(self, cells: Cells, half: Array, ranges: Array) -> list[tuple[Array, Array]]:
        """The roots near cells that are partly out of the dyad's reach: rows and shares."""
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
        """The roots near cells, with v in place of a share with a known ``slope`` of the reach."""
        row, middle = cells
        scale, plain = np.sqrt(abs(slope) * half[j]), row & ~self.bit

        def placed(which: Array, share: Array) -> tuple[Array, Array]:
            v, at, rise = share[:, j] * scale[which], share.copy(), slope[which]
            at[:, j], own = middle[which, j], plain[which]
            here = self.reach(own, at)
            for _ in range(LEADING):
                way = (v * v - here) / rise
                if not (abs(way) > ROUNDED).any():
                    break
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
    """The size of misfits relative to their ranges; infinite without a value."""
    size = np.sqrt(((value / scale) ** 2).sum(axis=1))
    return np.where(np.isfinite(size), size, np.inf)


def steps_of(missed: Misses, row: Array, share: Array, value: Array) -> Array:
    """The steps of Newton's method; NaN where there is no slope."""
    size = share.shape[1]
    slope = np.empty((len(row), size, size))
    for k in range(size):
        away = np.where(np.arange(size) == k, STEP, 0.0)
        there, way = missed(row, share + away), np.full(len(row), STEP)
        lost = ~np.isfinite(there).all(axis=1)
        if lost.any():
            there[lost], way[lost] = missed(row[lost], share[lost] - away), -STEP
        slope[:, :, k] = (there - value) / way[:, None]
    return solutions(slope, -value)


def solutions(slopes: Array, right: Array) -> Array:
    """The solutions (K, n) of linear equations with slopes (K, n, n) and right sides (K, n).

    NaN where slopes are NaN or singular.
    """
    good: Array = np.isfinite(slopes).all(axis=(1, 2))
    good &= np.linalg.det(np.where(good[:, None, None], slopes, 0.0)) != 0
    slopes = np.where(good[:, None, None], slopes, np.eye(slopes.shape[1]))
    found = np.linalg.solve(slopes, right[..., None])[..., 0]
    return np.where(good[:, None], found, np.nan)


# --- roots near roots in doubles, in numbers of any other kind ------------------------------------


Misfit = Callable[[Any], Any]
Misfits = Callable[[Sequence[Any]], Sequence[Any]]
Rows = Sequence[Sequence[Any]]

APART = 2.0**-30
"""Distance of the second place from the double, in radians or relative to its size."""
LEAST = 4 * 1024
"""The power of a half that is the least width of a proof's interval."""
MOST_SECANTS = 40
"""The most secant steps."""
WIDENED = 100
"""The most times a proof's interval is widened."""
WIDER = 1.25
"""The factor of each widening."""
ARRAY_STEPS = 2
"""Steps for arrays; each adds as many digits as the first double had."""
REFINING_ROUNDS = 60
"""The most steps of Newton's method."""
PIECES = (1, 16, 128, 1024, 4096)
"""Numbers of parts, in turn, into which a face is cut; balls on smaller parts are tighter."""
DOUBLED = 3
"""How many times a box is doubled before its proof is abandoned."""


def by_secant(misfit: Misfit, start: Any, step: Any) -> Any:
    """The root of a misfit near a start, iterated until the misfit stops decreasing.

    The second place is a ``step`` away.
    """
    old, new = start, start + step
    before, after = misfit(old), misfit(new)
    if abs(before) < abs(after):
        old, new, before, after = new, old, after, before
    for _ in range(MOST_SECANTS):
        if after in (0, before):
            return new
        aim = middle(new - after * (new - old) / (after - before))
        value = misfit(aim)
        if not abs(value) < abs(after):
            return new
        old, new, before, after = new, aim, after, value
    return new


def by_secants(misfit: Misfit, start: Any, turns: bool) -> Any:
    """``by_secant`` for an array; each step adds as many digits as the first double had."""
    old, new = start + APART * (1 if turns else np.maximum(abs(start), APART)), start
    before, after = misfit(old), misfit(new)
    for _ in range(ARRAY_STEPS):
        flat = after == before
        aim = np.where(flat, new, new - after * (new - old) / np.where(flat, 1, after - before))
        old, new, before, after = new, aim, after, misfit(aim)
    return new


def proved(misfit: Misfit, near: Any, step: Any) -> Any:
    """The ball about a value that surely contains a root, because the misfit changes sign.

    Between the ends the misfit is continuous, because it is finite on the whole ball.
    """
    from flint import arb

    slope = (misfit(near + step) - misfit(near - step)) / (2 * step)
    width = abs(misfit(near)).upper() / abs(slope).lower()
    if not width.is_finite():
        raise ValueError("the ball does not tell how the locus crosses")
    for _ in range(WIDENED):
        ball = arb(near, width.upper())
        ends = misfit(near - width), misfit(near + width)
        if (ends[0] < 0 and ends[1] > 0) or (ends[0] > 0 and ends[1] < 0):
            if bool(misfit(ball).is_finite()):
                return ball
            break
        width = WIDER * width + arb(2) ** -LEAST
    raise ValueError("the ball does not tell whether the group closes")


# --- of several functions -----------------------------------------------------------------------


def determinant(rows: Rows) -> Any:
    """The determinant of a few rows, by its first row."""
    if not rows:
        return 1
    total: Any = 0
    for k, head in enumerate(rows[0]):
        rest = [[*row[:k], *row[k + 1 :]] for row in rows[1:]]
        total = total + (-1) ** k * head * determinant(rest)
    return total


def solved(rows: Rows, right: Sequence[Any]) -> list[Any]:
    """The solution of a few linear equations (Cramer's rule)."""
    whole = determinant(rows)
    sides = range(len(rows))
    with_right = (
        [[*row[:k], end, *row[k + 1 :]] for row, end in zip(rows, right, strict=True)]
        for k in sides
    )
    return [determinant(each) / whole for each in with_right]


def slopes(
    misfits: Misfits, here: Sequence[Any], value: Sequence[Any], steps: Sequence[Any]
) -> Rows:
    """The slope of each misfit by each unknown: rows of differences."""
    columns = []
    for k, step in enumerate(steps):
        there = misfits([*here[:k], here[k] + step, *here[k + 1 :]])
        columns.append([(b - a) / step for a, b in zip(value, there, strict=True)])
    return [*zip(*columns, strict=True)]


def size_of(value: Any) -> Any:
    """The unit of a step: a radian, or the value itself."""
    return abs(value) or 1


def by_newton(misfits: Misfits, start: Sequence[Any]) -> list[Any]:
    """The common root of all misfits near a start, iterated until they stop decreasing.

    Differences are as wide as the last step. In the end they are only rounding. They may then have
    no solution (ZeroDivisionError), or reach a place without misfits (ValueError); both end the
    search.
    """
    here, steps = [*start], [size_of(each) * APART for each in start]
    value = misfits(here)
    for _ in range(REFINING_ROUNDS):
        if not any(value):
            break
        rows = slopes(misfits, here, value, steps)
        try:
            way = solved(rows, [-each for each in value])
            aim = [middle(each + step) for each, step in zip(here, way, strict=True)]
            there = misfits(aim)
        except (ZeroDivisionError, ValueError):
            break
        if not sum(map(abs, there)) < sum(map(abs, value)):
            break
        here, value = aim, there
        steps = [middle(step) or old for step, old in zip(way, steps, strict=True)]
    return here


def by_newton_arrays(misfits: Misfits, start: Sequence[Any]) -> list[Any]:
    """``by_newton`` for arrays."""
    here = [*start]
    for _ in range(ARRAY_STEPS):
        value, steps = misfits(here), [size * APART for size in map(abs, here)]
        way = solved(slopes(misfits, here, value, steps), [-each for each in value])
        here = [each + step for each, step in zip(here, way, strict=True)]
    return here


def proved_together(misfits: Misfits, middles: Misfits, near: Sequence[Any]) -> list[Any]:
    """The balls about values in which all misfits surely vanish, by Miranda's theorem."""
    from flint import arb

    sides = range(len(near))
    value = misfits(near)
    steps = [size_of(each) * APART for each in near]
    rows = slopes(middles, near, middles(near), steps)
    inverse = [*zip(*(solved(rows, [int(i == k) for i in sides]) for k in sides), strict=True)]
    inverse = [tuple(middle(each) for each in row) for row in inverse]

    def grown(tried: Sequence[Any]) -> list[Any]:
        """The combinations of misfits that each grow along one unknown."""
        found = misfits(tried)
        return [sum(a * g for a, g in zip(row, found, strict=True)) for row in inverse]

    tiny = arb(2) ** -LEAST
    widths = [
        2 * sum((abs(a) * abs(g).upper() for a, g in zip(row, value, strict=True)), tiny).upper()
        for row in inverse
    ]
    if not all(width.is_finite() for width in widths):
        raise ValueError("the ball does not tell how the loci cross")
    widest = max(widths, key=float)
    widths = [widest * size_of(each).upper() if is_ball(each) else widest for each in near]
    widths = [4 * width for width in widths]
    for _ in range(DOUBLED):
        box = [arb(each, width.upper()) for each, width in zip(near, widths, strict=True)]
        if all(has_two_signs(grown, near, widths, k) for k in sides):
            if all(bool(each.is_finite()) for each in misfits(box)):
                return box
            break
        widths = [2 * width for width in widths]
    raise ValueError("the ball does not tell whether the group closes")


def has_two_signs(grown: Any, near: Sequence[Any], widths: Sequence[Any], k: int) -> bool:
    """Whether a combination is surely negative on one face of a box and positive on the other."""
    from flint import arb

    others = [i for i in range(len(near)) if i != k]
    for parts in PIECES:
        pieces, good = max(1, round(parts ** (1 / len(others)))), True
        for place in product(range(pieces), repeat=len(others)):
            tried = [*near]
            for i, part in zip(others, place, strict=True):
                share = arb(2 * part + 1 - pieces) / pieces
                tried[i] = arb((near[i] + share * widths[i]).mid(), (widths[i] / pieces).upper())
            for way in (-1, 1):
                tried[k] = near[k] + way * widths[k]
                if not way * grown(tried)[k] > 0:
                    good = False
                    break
            if not good:
                break
        if good:
            return True
    return False
