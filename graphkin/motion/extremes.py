"""Extremes over a motion: least and largest values, and the positions of the driver there.

The values are sampled, and each bracket that may hold an extreme is narrowed on the construction
itself: by the sign of the derivative, and by the values where they jump or have a corner.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import ceil, inf
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import (
    BY_TARGET,
    EPSILON,
    JERK,
    OMEGA,
    ORDERS,
    QUANTITIES,
    SHEETS,
    MotionQuantity,
    names_asked,
)
from graphkin.motion.course import PLACES, Flags, Reals
from graphkin.motion.cycle import Cycle, columns_at
from graphkin.motion.driving import TURN, reach_of
from graphkin.motion.ends import End, last_closing
from graphkin.motion.events import once_round
from graphkin.motion.pieces import ALIKE

FINE = 720
"""Samples in a turn of the driver, and in a range of a slide or of the time."""
FEWEST = 180
"""The fewest samples in a piece."""
PARTS = 16
"""Parts into which a bracket is cut at once."""
ROUNDS = 9
"""Times a bracket is cut: a degree becomes less than 1e-10 degrees."""
BESIDE = (1e-6, 1e-8)
"""Distances before a dead point, as shares of the range, that show whether a value is bounded."""
GROWS = 3.0
"""Ratio of the values there from which on a value grows without bound; 10 and more if it does."""
AMBIGUOUS = 5e-4
"""Distance from change points, as a share of a full sweep, within which accelerations are lost."""
ACROSS = np.array([-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0])
"""Places about a change point, in that distance: a polynomial through them gives what is lost."""
STEP = 1e-3
"""Step of central differences: radians, the range of a slide or of the time taken as a turn."""
SAME = 1e-9
"""Share of the largest size within which two extremes are equal."""
ROUNDED = 1e-6
"""The same beside change points, where fewer digits are sure."""
LEVEL = 1e-12
"""Share of the largest size within which a value stays the same."""
STILL = 4e-15
"""Share of the largest size by which it may leave a level at the ends of that level."""
PLACED = 1e-8
"""Share of the range within which a place is zero."""
FOLDED = 1e-6
"""Share of the range within which a place is at a change point."""
WITHIN = 1e-9
"""Distance from the edge of a window, as a share of it, at which a value is one from inside."""
JUMPS = 1e-4
"""Share of the largest size by which only a jump changes a value in that distance."""
MOST = 100.0
"""The largest size, in median sizes; beyond, a value is about to grow without bound."""
RATE_OF: Mapping[str, str] = {
    "velocity": "acceleration",
    OMEGA: EPSILON,
    "slide speed": "slide acceleration",
}
"""The target that is the derivative of another by a driver that moves at speed 1."""

Columns = Mapping[Target, Any]


class Measure(Struct, frozen=True):
    """A number that a motion takes through its values: its name, owner, label and unit.

    ``value`` gives it (N,) from the columns of ``targets``. ``slope`` gives the sign of its
    derivative from the columns of ``rates`` for a driver at speed 1; None takes differences.
    ``smooth`` is a rising function that rounds off the corners of a size or an acute angle. What
    is small against the ``usual`` size may be rounding. ``least_allowed`` and ``most_allowed`` are
    customary limits.
    """

    name: str
    of: str
    label: str
    unit: str
    targets: tuple[Target, ...]
    value: Callable[[Columns], Reals]
    rates: tuple[Target, ...] = ()
    slope: Callable[[Columns], Reals] | None = None
    smooth: Callable[[Reals], Reals] | None = None
    usual: float = 0.0
    least_allowed: float | None = None
    most_allowed: float | None = None


class Reached(Struct, frozen=True):
    """Where an extreme is: from one u to another, which are equal but for a value that stays.

    ``end`` says that the range ends there: at a dead point, or at the edge of a window.
    """

    at: float
    until: float
    end: End | None = None


class Extreme(Struct, frozen=True):
    """A least or largest value and where it is; infinite where it grows without bound."""

    value: float
    places: tuple[Reached, ...]


class Extremes(Struct, frozen=True):
    """The least and the largest value of a measure in one range of the driver."""

    measure: Measure
    least: Extreme
    largest: Extreme

    @property
    def limit(self) -> float | None:
        """The customary limit of the value."""
        least = self.measure.least_allowed
        return self.measure.most_allowed if least is None else least

    @property
    def keeps_limit(self) -> bool:
        """Whether the value keeps its customary limits everywhere."""
        least, most = self.measure.least_allowed, self.measure.most_allowed
        slack = SAME * TURN
        return (least is None or self.least.value >= least - slack) and (
            most is None or self.largest.value <= most + slack
        )

    @property
    def is_constant(self) -> bool:
        """Whether the value stays the same in the whole range."""
        return self.least == self.largest


def asked_measures(cycle: Cycle) -> Iterator[Measure]:
    """The velocities and accelerations, of points, links and blocks, that the scene asks for.

    A vector is measured by its size. Positions of blocks are left to the followers.
    """
    known = cycle.path.ranges[0][0].course.program.targets
    reach = reach_of(cycle.scene)
    pace = 0.0
    if (driver := cycle.sweep.driver) is not None:
        pace = abs(float(driver.speed.si(cycle.scene.values)))
        pace = pace if driver.kind == "turn" else pace / reach
    for quantity in QUANTITIES:
        if quantity.kind in (*SHEETS, JERK) and not quantity.is_place:
            for name in dict.fromkeys(names_asked(cycle.scene.ask, quantity)):
                if (quantity.target, name) in known:
                    usual = pace ** ORDERS.index(quantity.kind)
                    usual *= 1.0 if quantity.whose == "links" else reach
                    yield measure_of(quantity, name, known, usual)


def measure_of(
    quantity: MotionQuantity, name: str, known: Mapping[Target, int], usual: float
) -> Measure:
    """The measure of one quantity of a point, a link or a block."""
    target, rate = (quantity.target, name), (RATE_OF.get(quantity.target, ""), name)
    symbol = f"{quantity.letter}_{name}"
    if quantity.whose == "slides":
        symbol = f"{quantity.letter} of block {name}"
    size = quantity.sort == "vector"

    def value(columns: Columns) -> Reals:
        return np.abs(columns[target]) if size else np.asarray(columns[target], float)

    def slope(columns: Columns) -> Reals:
        if size:
            return np.real(np.conj(columns[target]) * columns[rate])
        return np.asarray(columns[rate])

    exact = rate in known and BY_TARGET[rate[0]].sort == quantity.sort
    return Measure(
        quantity.words,
        name,
        f"|{symbol}|" if size else symbol,
        quantity.unit,
        (target,),
        value,
        (target, rate) if exact else (),
        slope if exact else None,
        np.square if size else None,
        usual,
    )


def extremes(cycle: Cycle, measures: Sequence[Measure], number: int = 0) -> tuple[Extremes, ...]:
    """The extremes, in one range counted from 0, of every measure that has values.

    All measures are run together, so that many take as many constructions as one.
    """
    if not measures:
        return ()
    search = Search(cycle, tuple(measures), number)
    return tuple(found for found in search.all() if found is not None)


class TopBracket(Struct):
    """A bracket (low, high) about a sample at which a measure times ``sign`` is locally largest."""

    measure: int
    sign: int
    low: float
    middle: float
    high: float


class Search:
    """The search for the extremes of some measures in one range of the driver."""

    def __init__(self, cycle: Cycle, measures: tuple[Measure, ...], number: int) -> None:
        self.cycle, self.measures = cycle, measures
        pieces = cycle.path.ranges[number]
        self.changes = {
            end.at for piece in pieces for end in (piece.low, piece.high) if end.kind == "change"
        }
        self.same = ROUNDED if self.changes else SAME
        self.low, self.high = pieces[0].low, pieces[-1].high
        self.span = self.high.at - self.low.at
        self.closed = cycle.path.whole and cycle.path.returns and number == 0
        turns = cycle.sweep.what == "turn"
        self.step = STEP * (1 / cycle.sweep.per_unit if turns else self.span / (2 * np.pi))
        self.at = np.unique(np.concatenate([self.samples(piece) for piece in pieces]))
        self.apart = float(np.median(np.diff(self.at)))

    def samples(self, piece: Any) -> Reals:
        """The samples of a piece, denser towards its singular ends."""
        low, high = piece.low.at, piece.high.at
        fine = FINE / 2 if piece.course.is_searched else FINE
        share = (high - low) / TURN if self.cycle.sweep.what == "turn" else 1.0
        count = max(ceil(fine * share), FEWEST) + 1
        singular = [end.kind not in ("window", "flat") for end in (piece.low, piece.high)]
        if not any(singular):
            return np.linspace(low, high, count)
        even = low + (high - low) * (0.5 - 0.5 * np.cos(np.pi * np.linspace(0, 1, count)))
        even = even[singular[0] : len(even) - singular[1]]
        ends = [low + share * self.span for share in (0, *BESIDE) if singular[0]]
        ends += [high - share * self.span for share in (0, *BESIDE) if singular[1]]
        return np.append(even, [u for u in ends if low <= u <= high])

    def values(self, at: Reals) -> list[Reals]:
        """Every measure at some u."""
        targets = dict.fromkeys(target for each in self.measures for target in each.targets)
        with np.errstate(all="ignore"):
            columns = self.columns(at, tuple(targets))
            return [each.value(columns) for each in self.measures]

    def columns(self, at: Reals, targets: Sequence[Target], geometric: bool = False) -> Columns:
        """Some targets at some u, next to singular places, too.

        Rounding decides what is constructed beside a change point. The motion passes it smoothly,
        so the values there come from a polynomial through those on both sides.
        """
        columns = self.constructed(at, targets, geometric)
        for event in self.changes:
            apart = AMBIGUOUS * self.cycle.sweep.usual
            away = [(at + way - event) / apart for way in self.cycle.path.shifts(at)]
            nearest = np.min(np.abs(away), axis=0)
            lost = nearest < 1
            if not lost.any():
                continue
            share = np.choose(np.argmin(np.abs(away), axis=0), away)[lost]
            beside = self.constructed(event + ACROSS * apart, targets, geometric)
            for target, value in beside.items():
                row = np.array(np.broadcast_to(columns[target], at.shape))
                row[lost] = lagrange(ACROSS, share) @ np.broadcast_to(value, ACROSS.shape)
                columns[target] = row
        return columns

    def constructed(
        self, at: Reals, targets: Sequence[Target], geometric: bool
    ) -> dict[Target, Any]:
        """Some targets at some u, as the construction gives them."""
        sweep, path = self.cycle.sweep, self.cycle.path
        return dict(columns_at(sweep, path, at, targets, geometric=geometric, near=0.0).columns)

    def all(self) -> Iterator[Extremes | None]:
        """The extremes of every measure, in their order; None for one without values."""
        rows = self.one_sided(self.values(self.at))
        singular = np.isin(self.at, [e.at for e in (self.low, self.high) if e.kind == "dead"])
        for n, measure in enumerate(self.measures):
            if not all(target[0] in PLACES for target in measure.targets):
                rows[n] = np.where(singular, np.nan, rows[n])
        brackets = [
            bracket
            for n, row in enumerate(rows)
            for sign in (-1, 1)
            for bracket in self.brackets(n, row, sign)
        ]
        tops = self.narrowed(brackets)
        for n, row in enumerate(rows):
            known = np.isfinite(row)
            if not known.any():
                yield None
                continue
            both = []
            for sign in (-1, 1):
                own = [k for k, b in enumerate(brackets) if (b.measure, b.sign) == (n, sign)]
                both.append(self.extreme(n, row, sign, [tops[k] for k in own]))
            scale = max(size_of(row), self.measures[n].usual)
            if both[1].value - both[0].value <= self.same * scale:
                low = float(np.median(row[known]))
                low = 0.0 if abs(low) <= self.same * scale else low
                all_along = Extreme(low, (Reached(self.low.at, self.high.at),))
                both = [all_along, all_along]
            yield Extremes(self.measures[n], *both)

    def one_sided(self, rows: Sequence[Reals]) -> list[Reals]:
        """The rows with the values that jump at the edge of a window as they are inside it."""
        found = [np.array(row) for row in rows]
        for end, place, way in ((self.low, 0, 1), (self.high, -1, -1)):
            if end.kind != "window" or self.closed:
                continue
            inside = self.values(np.array([end.at + way * WITHIN * self.span]))
            for row, near in zip(found, inside, strict=True):
                if abs(row[place] - near[0]) > JUMPS * np.abs(row[np.isfinite(row)]).max(initial=0):
                    row[place] = near[0]
        return found

    # --- where an extreme may lie -----------------------------------------------------------------

    def unbounded(self, row: Reals, sign: int) -> list[float]:
        """The dead points towards which a measure times ``sign`` grows without bound."""
        found = []
        usual = float(np.nanmedian(np.abs(row)))
        for end, way in ((self.low, 1), (self.high, -1)):
            if end.kind != "dead":
                continue
            outer, inner = (self.near(row, end.at + way * share * self.span) for share in BESIDE)
            if sign * inner > max(GROWS * abs(outer), 10 * usual):
                found.append(end.at)
        return found

    def near(self, row: Reals, at: float) -> float:
        """The value of the sample next to a u."""
        return float(row[int(np.abs(self.at - at).argmin())])

    def brackets(self, n: int, row: Reals, sign: int) -> Iterator[TopBracket]:
        """The brackets in which a measure may be largest (``sign`` 1) or least (-1)."""
        known = np.isfinite(row)
        at, top = self.at[known], sign * row[known]
        if len(at) < 3 or np.ptp(top) <= LEVEL * np.abs(top).max() or self.unbounded(row, sign):
            return
        if self.closed:
            period = self.cycle.path.period
            if at[-1] - at[0] > period - ALIKE:
                at, top = at[:-1], top[:-1]
            at = np.concatenate([[at[-1] - period], at, [at[0] + period]])
            top = np.concatenate([top[-1:], top, top[:1]])
        middle, before, after = top[1:-1], top[:-2], top[2:]
        gain = np.maximum(middle - before, middle - after)
        level = (middle == before) & (middle == after)
        local = (middle >= before) & (middle >= after) & ~level & (middle + gain >= top.max())
        for k in np.flatnonzero(local) + 1:
            yield TopBracket(n, sign, float(at[k - 1]), float(at[k]), float(at[k + 1]))

    # --- narrowing --------------------------------------------------------------------------------

    def narrowed(self, brackets: Sequence[TopBracket]) -> list[tuple[float, float]]:
        """The place and the value of the extreme in every bracket.

        Values that fall back behind the sample jump or have a corner: those are narrowed by value.
        """
        if not brackets:
            return []
        owner = np.array([each.measure for each in brackets])
        sign = np.array([each.sign for each in brackets])
        low, middle, high = np.array([(b.low, b.middle, b.high) for b in brackets]).T
        exact = np.array([self.measures[n].slope is not None for n in owner])
        at = middle.copy()
        for some, slope in ((exact, self.slopes), (~exact, self.differences)):
            if some.any():
                at[some] = by_slope(slope, owner[some], sign[some], low[some], high[some])
        value, sample = self.own(at, owner), self.own(middle, owner)
        behind = ~(sign * value >= sign * sample)
        if behind.any():
            mine = owner[behind], sign[behind]
            at[behind] = self.by_value(*mine, low[behind], middle[behind], high[behind])
            value[behind] = self.own(at[behind], owner[behind])
        return list(zip(at.tolist(), value.tolist(), strict=True))

    def own(self, at: Reals, owner: Any) -> Reals:
        """The value of measure ``owner[i]`` at u[i]."""
        rows = self.values(at)
        return np.array([rows[n][k] for k, n in enumerate(owner)])

    def slopes(self, at: Reals, owner: Any) -> Reals:
        """The derivative of measure ``owner[i]`` at u[i], but for a positive factor."""
        targets = dict.fromkeys(t for n in set(owner.tolist()) for t in self.measures[n].rates)
        with np.errstate(all="ignore"):
            columns = self.columns(at, tuple(targets), geometric=True)
        found = np.empty(len(at))
        for n in set(owner.tolist()):
            slope = self.measures[n].slope
            assert slope is not None
            found[owner == n] = slope(columns)[owner == n]
        return found * self.pace(owner)

    def pace(self, owner: Any) -> Reals:
        """The sign of the driver's speed, for measures that it turns round; 1 for sizes."""
        if not self.cycle.sweep.runs_backwards:
            return np.ones(len(owner))
        return np.array([-1.0 if self.measures[n].smooth is None else 1.0 for n in owner])

    def differences(self, at: Reals, owner: Any) -> Reals:
        """Central differences of fourth order of measure ``owner[i]`` at u[i]."""
        room = np.full(len(at), self.step)
        if not self.closed:
            ends = np.minimum(at - self.low.at, self.high.at - at)
            room = np.clip(np.minimum(room, ends / 3), 0, None)
        shifts = np.array([-2.0, -1.0, 1.0, 2.0])
        places = (at[:, None] + room[:, None] * shifts).ravel()
        found = self.own(places, np.repeat(owner, 4)).reshape(-1, 4)
        for n in set(owner.tolist()):
            if (smooth := self.measures[n].smooth) is not None:
                found[owner == n] = smooth(found[owner == n])
        return np.asarray(found @ np.array([1.0, -8.0, 8.0, -1.0]))

    def by_value(self, owner: Any, sign: Any, low: Reals, middle: Reals, high: Reals) -> Reals:
        """The largest of each measure times ``sign`` in brackets, by its values alone."""
        share = np.linspace(0, 1, PARTS + 1)
        best = middle.copy()
        for _ in range(ROUNDS + 3):
            places = low[:, None] + (high - low)[:, None] * share
            places = np.sort(np.concatenate([places, best[:, None]], axis=1), axis=1)
            flat = self.own(places.ravel(), np.repeat(owner, PARTS + 2)).reshape(places.shape)
            top = np.where(np.isfinite(flat), flat * sign[:, None], -inf)
            k, rows = top.argmax(axis=1), np.arange(len(owner))
            best = places[rows, k]
            low = places[rows, np.maximum(k - 1, 0)]
            high = places[rows, np.minimum(k + 1, PARTS + 1)]
        return best

    # --- the extreme of one measure ---------------------------------------------------------------

    def extreme(
        self, n: int, row: Reals, sign: int, tops: Sequence[tuple[float, float]]
    ) -> Extreme:
        """The largest (``sign`` 1) or least value: of the samples, and of the tops in brackets."""
        if infinite := self.unbounded(row, sign):
            return Extreme(sign * inf, tuple(Reached(u, u, "dead") for u in infinite))
        known = np.isfinite(row)
        at, top, size = self.at[known], sign * row[known], size_of(row)
        scale = max(size, self.measures[n].usual)
        best = max([float(top.max()), *(sign * value for _, value in tops)])
        equal = best - self.same * scale
        found = self.levels(n, sign, at, np.where(top >= best - LEVEL * size, top, -inf), size)
        for u, value in tops:
            if sign * value >= equal and not any(self.covers(each, u) for each in found):
                found.append(Reached(u, u))
        if not self.closed:
            for u, value, end in ((at[0], top[0], self.low), (at[-1], top[-1], self.high)):
                if value >= equal and not any(self.covers(each, u) for each in found):
                    kind: End = "dead" if end.kind == "dead" else "window"
                    found.append(Reached(end.at, end.at, kind))
        if not found:
            u = float(at[top.argmax()])
            found.append(Reached(u, u))
        value = 0.0 if abs(best) <= SAME * scale else sign * best
        return Extreme(value, self.once(found))

    def covers(self, found: Reached, at: float) -> bool:
        """Whether a place holds a u, or one a circle away."""
        shifts = self.cycle.path.shifts(at) if self.closed else [0.0]
        return any(found.at - ALIKE <= at + way <= found.until + ALIKE for way in shifts)

    def levels(self, n: int, sign: int, at: Reals, top: Reals, scale: float) -> list[Reached]:
        """The stretches of three samples and more on which a measure stays the same.

        ``top`` is the measure times ``sign`` there, and minus infinity elsewhere.
        """
        edges = np.flatnonzero(np.diff(np.concatenate([[0], np.isfinite(top).astype(int), [0]])))
        found = []
        for first, after in zip(edges[::2], edges[1::2], strict=True):
            if after - first < 3:
                continue
            least = float(np.median(top[first:after])) - STILL * scale
            inside = first + np.flatnonzero(top[first:after] >= least)
            begin, end = int(inside[0]), int(inside[-1])

            def stays(u: Reals, least: float = least) -> Flags:
                return np.asarray(sign * self.values(u)[n] >= least)

            low, high = float(at[begin]), float(at[end])
            low = last_closing(stays, low, float(at[begin - 1])) if begin else low
            high = last_closing(stays, high, float(at[end + 1])) if end + 1 < len(at) else high
            found.append(Reached(low, high))
        if self.closed and len(found) > 1 and found[0].at == at[0] and found[-1].until == at[-1]:
            period = self.cycle.path.period
            found = [*found[1:-1], Reached(found[-1].at, found[0].until + period)]
        return found

    def once(self, found: Sequence[Reached]) -> tuple[Reached, ...]:
        """The places in order, each once, those of a driver that turns fully from 0 on."""
        kept: dict[float, Reached] = {}
        for each in map(self.single, found):
            at = once_round(self.cycle.path, each.at)
            at = next((u for u in self.changes if abs(at - u) <= FOLDED * self.span), at)
            least = PLACED * self.span
            at = 0.0 if abs(at) <= least or (self.closed and self.span - at <= least) else at
            kept.setdefault(round(at, 6), Reached(at, each.until + at - each.at, each.end))
        return tuple(kept[key] for key in sorted(kept))

    def single(self, found: Reached) -> Reached:
        """The place itself, or the middle of one that is shorter than the samples are apart.

        If it holds a change point, next to which samples are denser, this is the middle.
        """
        if found.until - found.at >= self.apart:
            return found
        round_it = (self.cycle.path.found_at(u, found.at, found.until) for u in self.changes)
        inside = (u for u in round_it if found.at <= u <= found.until)
        at = next(inside, (found.at + found.until) / 2)
        return Reached(at, at, found.end)


def size_of(row: Reals) -> float:
    """The largest size of a row, without what is about to grow without bound."""
    sizes = np.abs(row[np.isfinite(row)])
    largest, usual = float(sizes.max()), float(np.median(sizes))
    return min(largest, MOST * usual) if usual else largest


def lagrange(nodes: Reals, at: Reals) -> Reals:
    """The weights (N, M) of the values at M nodes in the polynomial through them, at N places."""
    apart = nodes[:, None] - nodes
    np.fill_diagonal(apart, 1.0)
    away = at[:, None, None] - nodes
    ways = np.where(np.eye(len(nodes), dtype=bool), 1.0, away / apart)
    return np.asarray(np.prod(ways, axis=-1))


def by_slope(
    slope: Callable[[Reals, Any], Reals], owner: Any, sign: Any, low: Reals, high: Reals
) -> Reals:
    """Where a derivative times ``sign`` falls through zero in each bracket.

    Every bracket is cut into parts at once, as it rises at ``low`` and falls at ``high``.
    """
    inner = np.arange(1, PARTS) / PARTS
    for _ in range(ROUNDS):
        places = low[:, None] + (high - low)[:, None] * inner
        found = slope(places.ravel(), np.repeat(owner, PARTS - 1)).reshape(places.shape)
        falls = ~(found * sign[:, None] > 0)
        k = np.where(falls.any(axis=1), falls.argmax(axis=1), PARTS - 1)
        whole = np.concatenate([low[:, None], places, high[:, None]], axis=1)
        rows = np.arange(len(low))
        low, high = whole[rows, k], whole[rows, k + 1]
    return np.asarray((low + high) / 2)
