"""Where a group closes along a motion: sought near the places on both sides."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.higher_class.closure_solver import (
    HIDDEN,
    Closures,
    ClosureSolver,
    Trying,
)
from graphkin.construction.higher_class.several_trials import SeveralTrials

Reals = np.ndarray[Any, np.dtype[Any]]

NEAR = 0.3
"""How far a closure may lie from where it is sought, in parts of the way between its neighbours."""
CUBIC = 4
"""Places through which the way of what is tried is laid."""


class FollowedClosures(Struct, frozen=True, eq=False):
    """One closure at rising u (N,), in rows (N, n) as its solver splits them."""

    at: Reals
    rows: Reals

    def within(self, low: float, high: float) -> FollowedClosures:
        """The part from one u to another, with the next places beyond both."""
        first = max(int(np.searchsorted(self.at, low, side="right")) - 1, 0)
        last = int(np.searchsorted(self.at, high)) + 1
        return FollowedClosures(self.at[first:last], self.rows[first:last])

    def moved(self, by: float) -> FollowedClosures:
        """The same closures at other places."""
        return FollowedClosures(self.at + by, self.rows)

    def joined(self, other: FollowedClosures | None) -> FollowedClosures:
        """With the places of another that follow on these."""
        if other is None:
            return self
        before = self.at < other.at[0]
        both = zip((self.at[before], self.rows[before]), (other.at, other.rows), strict=True)
        return FollowedClosures(*(np.concatenate(part) for part in both))

    def closed(self, solver: ClosureSolver, known: list[Reals], at: Reals) -> tuple[Any, ...]:
        """What closes the group at each u (K,), as its solver gives it.

        Where it is not sure, every closure is sought, and that of the number taken.
        """
        trying = solver.trying
        assert isinstance(trying, SeveralTrials)
        rows = self.beside(trying, known, at)
        closed = np.column_stack([np.arange(len(rows)), rows])
        found = [np.array(part) for part in trying.parts(closed)]
        rest = np.flatnonzero(np.isnan(rows[:, 0]))
        if rest.size:
            again = trying.closed([array[rest] for array in known], solver.number)
            for whole, part in zip(found, again, strict=True):
                whole[rest] = part
        return tuple(found)

    def beside(self, trying: SeveralTrials, known: list[Reals], at: Reals) -> Reals:
        """The rows (K, n) at each u, by Newton's method from between the places on both sides.

        NaN where it may lead to another closure.
        """
        count = len(self.at)
        rows = np.full((len(at), self.rows.shape[1]), np.nan)
        which = np.flatnonzero((self.at[0] <= at) & (at <= self.at[-1]) & (count > 1))
        if not which.size:
            return rows
        after = np.clip(np.searchsorted(self.at, at[which]), 1, count - 1)
        turning = [one.turns for one in trying.unknowns]
        led, every, _ = trying.split(self.rows)
        led, signs = led.copy(), every[after - 1]
        led[:, turning] = np.unwrap(led[:, turning], axis=0)
        between, way = interpolated(self.at, led, at[which], after), led[after] - led[after - 1]
        here = [array[which] for array in known]
        tried = trying.closed_beside(here, between, signs)
        sine = trying.sines(here, tried, signs)
        sure = abs(tried - between).max(axis=1) <= NEAR * abs(way).max(axis=1)
        sure &= (signs == every[after]).all(axis=1) & (sine > HIDDEN)
        rows[which[sure]] = np.column_stack([tried, signs, sine])[sure]
        return rows


def interpolated(at: Reals, rows: Reals, wanted: Reals, after: Reals) -> Reals:
    """Rows (K, n) at wanted places by the polynomial through the four nearest ones, or all.

    ``after`` is the number of the first place beyond each.
    """
    some = min(CUBIC, len(at))
    first = np.clip(after - CUBIC // 2, 0, len(at) - some)
    which = first[:, None] + np.arange(some)
    places, found = at[which], np.zeros((len(wanted), rows.shape[1]))
    for k in range(some):
        others = np.delete(places, k, axis=1)
        weight = ((wanted[:, None] - others) / (places[:, k, None] - others)).prod(axis=1)
        found += weight[:, None] * rows[which[:, k]]
    return found


def paired(
    trying: SeveralTrials, at: tuple[float, float], first: Reals, second: Reals
) -> list[FollowedClosures]:
    """The closures at two u, each of the first (M, n) with the nearest one of the second.

    None are given where they do not match one to one, with the same signs.
    """
    if len(first) != len(second):
        return []
    (before, signs, _), (after, others, _) = trying.split(first), trying.split(second)
    way = abs(after - before[:, None])
    turning = np.array([one.turns for one in trying.unknowns])
    way = np.where(turning, np.minimum(way % (2 * np.pi), -way % (2 * np.pi)), way).max(axis=2)
    alike = (others == signs[:, None]).all(axis=2)
    nearest = np.where(alike, way, np.inf).argmin(axis=1)
    count = np.arange(len(first))
    if sorted(nearest) != [*count] or not alike[count, nearest].all():
        return []
    pairs = zip(first, second[nearest], strict=True)
    return [FollowedClosures(np.array(at), np.array(pair)) for pair in pairs]


def closed_on(
    every: Sequence[FollowedClosures], trying: Trying, known: list[Reals], at: Reals
) -> Closures | None:
    """All closures at each u, numbered anew, from where each is on both sides.

    None without any such, or where one is not sure.
    """
    if not every:
        return None
    assert isinstance(trying, SeveralTrials)
    rows = np.concatenate([one.beside(trying, known, at) for one in every])
    if np.isnan(rows).any():
        return None
    owner, touching = np.tile(np.arange(len(at)), len(every)), np.zeros(len(rows), dtype=bool)
    tried, signs, _ = trying.split(rows)
    return trying.ordered(known, len(at), owner, tried, signs, touching)
