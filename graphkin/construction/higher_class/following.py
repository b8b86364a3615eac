"""One closure of a group followed along the motion, without looking for the others again.

The last places say where it will be next, and Newton's method leads from there to where the group
closes. A step is taken only if it leads close to the prediction. Where the closure meets another
one, the driver turns back along it: that place is found as the farthest one of a smooth curve.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import Any, Literal, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.higher_class.closure_solver import HIDDEN, Closures, Trying
from graphkin.numbers.arithmetic import np, phase
from graphkin.numbers.common_roots import roots_beside

Reals = Any
End = Literal["open", "fold", "stop"]
"""How a way ends: it goes on, it meets another closure, or nothing closes beyond."""

FIRST, LONGEST = 1e-6, 1 / 90
"""The first step and the longest one, in parts of the usual way."""
LEAST, ENOUGH = 1e-3, 1e-10
"""The step below which a fold or a leap is tried, and the one below which the way ends."""
NEAR, SURE, FAR, MOST = 0.05, 1e-7, 0.05, 0.7
"""How far from its prediction a closure may lie: in parts of the step of the links, by rounding, in
radians. The step of a link in radians is ``MOST`` at most."""
START = 1e-2
"""The first step of a link, in radians, which nothing predicts."""
GOOD, GROW, SHRINK = 0.01, 2.0, 4.0
"""A miss, in parts of the step, after which the next step grows; how steps grow and shrink."""
LEAPS = (3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2)
"""Steps with which a place is passed at which two closures cross, in parts of the usual way."""
LEAP_NEAR = 0.01
"""As NEAR, for such a step."""
ORDER = 4
"""Places from which the next one is predicted, and between which a way is interpolated."""
LOOK_BACK = 60
"""Last places among which these are looked for."""
MOST_PLACES = 50_000
"""Steps tried along one way."""
ON_FOLD, ROUNDS = 9, 3
"""Places beside a fold from which it is found, and how often they are laid closer to it."""
TURN_BACK = 0.7
"""How far ahead a fold is looked for, in radians."""
BETWEEN = 0.3
"""How far a closure may lie from its interpolation, in parts of the way between its neighbours."""
MERGED = 1e-4
"""Sine of crossing below which it is open which of two closures that meet has a number."""
AT_FOLD = 1e-7
"""How near to a fold, in parts of the way, the interpolation holds by itself."""


class Place(NamedTuple):
    """One place of a way: u, what is tried (n,), the dyads' signs (k,), the links' angles (L,)."""

    at: float
    tried: Reals
    signs: Reals
    angles: Reals

    @property
    def state(self) -> Reals:
        """What is tried, and the angles."""
        return np.concatenate([self.tried, self.angles])


class GroupOnWay(Struct, frozen=True, dict=True):
    """A group of a mechanism that moves: ``known`` gives what it is drawn from, arrays at u (N,).

    ``usual`` is the way that the driver usually goes, by which steps are measured.
    """

    trying: Trying
    known: Callable[[Reals], list[Reals]]
    usual: float

    # --- one closure, followed -------------------------------------------------------------------

    def begun(self, at: float, number: int) -> Reals | None:
        """The row of the closure of a number at a place; None where it has none."""
        row = self.closures(np.array([at])).picked(number)[0][1:]
        return None if np.isnan(row).any() else row

    def followed(
        self,
        row: Reals,
        start: float,
        stop: float,
        seen: Callable[[float, Reals], None] = lambda at, row: None,
    ) -> FollowedClosure:
        """The way of a closure from one place to another, or as far as it goes.

        ``seen`` learns of each place, in order, with what closes the group there.
        """
        tried, signs, _ = self.trying.split(row)
        here, way = np.array([start]), 1.0 if stop > start else -1.0
        size = self.sizes(here)
        found = [Place(start, tried, signs, self.drawn(here, tried[None], signs[None])[0])]
        end: End = "open"
        step = FIRST * self.usual
        for _ in range(MOST_PLACES):
            if found[-1].at == stop:
                break
            left = abs(stop - found[-1].at)
            target = stop if left <= step * 1.01 else found[-1].at + way * step
            place, miss = self.step_to(target, found, size, NEAR)
            if place is not None:
                found.append(place)
                seen(place.at, np.append(place.tried, place.signs))
                step = min(step * (GROW if miss < GOOD else 1.0), LONGEST * self.usual)
                continue
            step = abs(target - found[-1].at) / SHRINK
            if step > LEAST * self.usual:
                continue
            if (places := self.fold(found, way, size)) is not None:
                found, end = [*found, *places], "fold"
                break
            if (over := self.leap(found, stop, size)) is not None:
                found.append(over)
                seen(over.at, np.append(over.tried, over.signs))
                step = FIRST * self.usual
            elif step < ENOUGH * self.usual:
                end = "stop"
                break
        else:
            end = "stop"
        ends: tuple[End, End] = ("open", end) if way > 0 else (end, "open")
        found.sort(key=lambda place: place.at)
        at, tried, signs, _ = (np.array(column) for column in zip(*found, strict=True))
        return FollowedClosure(at, tried, signs, ends)

    def step_to(
        self, at: float, found: Sequence[Place], size: Reals, near: float
    ) -> tuple[Place | None, float]:
        """The next place of a way, and its miss in parts of the step; None where it is not sure.

        A dyad that is stretched on the way goes on with its other sign.
        """
        last = found[-1]
        guess = predicted(found, at)
        count = len(last.tried)
        for signs in (last.signs[None], turned_signs(last.signs)):
            if not len(signs):
                continue
            here = np.full(len(signs), at)
            tried, angles = self.closed(here, np.tile(guess[:count], (len(signs), 1)), signs)
            angles = guess[count:] + wrapped(angles - guess[count:])
            states = np.concatenate([tried, angles], axis=1)
            missed = (abs(states - guess) / size).max(axis=1)
            moved = (abs(states - last.state) / size).max(axis=1)
            least = START if len(found) == 1 else np.minimum(near * moved, FAR)
            good = (missed <= np.maximum(least, SURE)) & (moved <= MOST)
            if good.any():
                n = int(np.where(good, missed, np.inf).argmin())
                share = float(missed[n] / max(moved[n], SURE)) if len(found) > 1 else 0.0
                return Place(at, tried[n], signs[n], angles[n]), share
        return None, np.inf

    def leap(self, found: Sequence[Place], stop: float, size: Reals) -> Place | None:
        """A place beyond one at which two closures cross: there no step leads near enough."""
        if len(found) < ORDER:
            return None
        way = np.sign(stop - found[-1].at)
        for part in LEAPS:
            at = found[-1].at + way * part * self.usual
            if (stop - at) * way < 0:
                return None
            place, _ = self.step_to(at, found, size, LEAP_NEAR)
            if place is not None:
                return place
        return None

    def fold(self, found: Sequence[Place], way: float, size: Reals) -> list[Place] | None:
        """The places from the last one to where the way meets another closure; None where none is
        near.

        One of the tried values leads there, and u follows it: it is farthest at the fold.
        """
        if len(found) < ORDER:
            return None
        count = len(found[-1].tried)
        last = found[-1]
        step = (found[-1].tried - found[-2].tried) / size[:count]
        lead = int(abs(step).argmax())
        s, u = np.array([(place.tried[lead], place.at) for place in found[-3:]]).T
        bend = np.polynomial.Polynomial.fit(s, u, 2)
        peak = bend.deriv().roots()
        if not len(peak) or bend.deriv(2)(s[-1]) * way >= 0:
            return None
        ahead = float(peak[0].real) - s[-1]
        if ahead * (s[-1] - s[-2]) <= 0 or abs(ahead) > TURN_BACK * size[lead]:
            return None
        unit = self.usual / (2 * np.pi)
        laid = np.cos(np.pi * (np.arange(ON_FOLD) + 0.5) / ON_FOLD)[::-1]
        centre, half = s[-1] + ahead, abs(ahead)
        columns = np.array([[p.at, *p.tried] for p in found[-3:]])
        fits = [np.polynomial.Polynomial.fit(s, column, 2) for column in columns.T]
        first: Reals = None
        for _ in range(ROUNDS):
            places = centre + half * laid
            start = np.column_stack([fit(places) for fit in fits])
            start[:, 1 + lead] = places
            closed = self.closed_led(start, lead, last.signs, unit, size[:count])
            if not np.isfinite(closed).all():
                return None
            fits = [np.polynomial.Polynomial.fit(places, c, ON_FOLD - 2) for c in closed.T]
            first = closed if first is None else first
            roots = fits[0].deriv().roots()
            inside = [r.real for r in roots if abs(r.imag) < 1e-6 * half]
            inside = [r for r in inside if abs(r - centre) < half]
            if not inside:
                return None
            centre, half = min(inside, key=lambda r: -way * fits[0](r)), half / 8
        end = np.array([fit(centre) for fit in fits])
        between = first[((first[:, 1 + lead] - s[-1]) * np.sign(ahead) > 0)]
        between = between[(end[1 + lead] - between[:, 1 + lead]) * np.sign(ahead) > 0]
        rows = np.array([*between, end])
        rows = rows[np.argsort((rows[:, 1 + lead] - s[-1]) * np.sign(ahead))]
        if (np.diff(np.append(last.at, rows[:, 0])) * way <= 0).any():
            return None
        signs = np.tile(last.signs, (len(rows), 1))
        angles = self.drawn(rows[:, 0], rows[:, 1:], signs)
        return [Place(r[0], r[1:], last.signs, a) for r, a in zip(rows, angles, strict=True)]

    def closed_led(self, start: Reals, lead: int, signs: Reals, unit: float, size: Reals) -> Reals:
        """Rows (K, 1 + n) of u and what is tried, in which all closes while one value leads."""
        free = [k for k in range(start.shape[1]) if k != 1 + lead]
        scale = np.array([unit, *size])[free]

        def missed(row: Reals, share: Reals) -> Reals:
            whole = start[row].copy()
            whole[:, free] = share * scale
            known, rows = self.known(whole[:, 0]), np.tile(signs, (len(row), 1))
            return self.trying.misfits(known, whole[:, 1:], rows)

        found = start.copy()
        with np.errstate(all="ignore"):
            found[:, free] = roots_beside(missed, start[:, free] / scale) * scale
        return found

    def closed(self, at: Reals, tried: Reals, signs: Reals) -> tuple[Reals, Reals]:
        """What is tried (K, n) beside some values, where all closes, and the links' angles (K, L).

        NaN where Newton's method does not lead to a closure.
        """
        known = self.known(at)
        with np.errstate(all="ignore"):
            found = self.trying.closed_beside(known, tried, signs)
            return found, self.angles(self.trying.found(known, found, signs))

    def drawn(self, at: Reals, tried: Reals, signs: Reals) -> Reals:
        """The angles of the links (K, L)."""
        with np.errstate(all="ignore"):
            return self.angles(self.trying.found(self.known(at), tried, signs))

    def angles(self, found: dict[int, Any]) -> Reals:
        """The angles of the links (K, L) among results; NaN where one faces the wrong way."""
        angles = np.stack([phase(found[n]) for n in self.trying.axes], axis=1)
        for one in self.trying.unknowns:
            if one.facing is not None:
                angles[~(found[one.facing] > 0)] = np.nan
        return angles

    def sizes(self, at: Reals) -> Reals:
        """What tried values and angles are measured by: a radian, or how far a link is tried."""
        scale = self.trying.scales(self.known(at), 1)[0]
        return np.concatenate([scale, np.ones(len(self.trying.axes))])

    # --- all closures, and their numbers ---------------------------------------------------------

    def closures(self, at: Reals) -> Closures:
        """All closures at each u, in the order of their numbers."""
        with np.errstate(all="ignore"):
            return self.trying.every(self.known(at), len(at))

    def numbers(self, way: FollowedClosure, at: Reals) -> Reals:
        """The number of a followed closure at each u; 0 where rounding leaves it open."""
        rows = way.rows(self, at)
        every = self.closures(at)
        return np.array([self.number(every.of(n), row) for n, row in enumerate(rows)])

    def met(self, at: tuple[float, float], first: Reals, last: Reals) -> float | None:
        """Where two closures meet that there are at one of two places and not at the other; None
        where not just two are left over.

        The closures at both are given in rows (M, ...).
        """
        here, there = at if len(first) > len(last) else at[::-1]
        more, fewer = (first, last) if len(first) > len(last) else (last, first)
        if len(more) != len(fewer) + 2:
            return None
        away = np.array([self.apart(fewer, row) for row in more]).reshape(len(more), -1)
        lone = away.min(axis=1, initial=np.inf).argsort()[::-1]
        for row in more[lone[:2]]:
            way = self.followed(row, here, there)
            if "fold" in way.ends:
                return float(way.at[-1 if there > here else 0])
        return None

    def number(self, every: Reals, row: Reals) -> int:
        """Which of all closures (M, n + k + 1) at one place a row is, counted from one."""
        if not len(every) or not row[-1] > MERGED:
            return 0
        away = self.apart(every, row)
        best = int(away.argmin())
        others = np.delete(away, best)
        return best + 1 if away[best] < min(SURE * 10, others.min(initial=np.inf)) else 0

    def paired(self, at: tuple[float, float], first: Reals, second: Reals) -> PairedClosures | None:
        """All closures at two u, each of the first (M, n) with the nearest one of the second.

        None where they do not match one to one, with the same signs.
        """
        if len(first) != len(second) or not len(first):
            return None
        away = np.array([self.apart(second, row) for row in first])
        nearest = away.argmin(axis=1)
        if sorted(nearest) != [*range(len(first))] or not (away.min(axis=1) < MOST).all():
            return None
        (before, signs, _), (after, _, _) = self.trying.split(first), self.trying.split(second)
        after = after[nearest]
        turning = np.array([one.turns for one in self.trying.unknowns])
        after = np.where(turning, before + wrapped(after - before), after)
        return PairedClosures(at, before, after, signs)

    def numbers_led(self, pairs: PairedClosures, way: FollowedClosure, at: Reals) -> Reals | None:
        """As numbers, from all closures as they lead on between two places; None where one of them
        is not sure."""
        count, places = len(pairs.first), len(at)
        share = np.tile((at - pairs.at[0]) / (pairs.at[1] - pairs.at[0]), count)[:, None]
        owner, which = np.tile(np.arange(places), count), np.repeat(np.arange(count), places)
        step = pairs.last[which] - pairs.first[which]
        start, signs = pairs.first[which] + step * share, pairs.signs[which]
        known = self.known(at)
        with np.errstate(all="ignore"):
            tried = self.trying.closed_beside([array[owner] for array in known], start, signs)
            sure = abs(tried - start).max(axis=1) <= BETWEEN * abs(step).max(axis=1) + SURE
            if not sure.all():
                return None
            touching = np.zeros(len(tried), dtype=bool)
            every = self.trying.ordered(known, places, owner, tried, signs, touching)
        rows = way.rows(self, at)
        return np.array([self.number(every.of(n), row) for n, row in enumerate(rows)])

    def apart(self, every: Reals, row: Reals) -> Reals:
        """How far closures in rows (M, ...) are from another: in what is tried, and in signs."""
        (tried, signs, _), (other, turned, _) = self.trying.split(every), self.trying.split(row)
        way = abs(tried - other)
        turning = np.array([one.turns for one in self.trying.unknowns])
        round_ = np.minimum(way % (2 * np.pi), -way % (2 * np.pi))
        far = np.where(turning, round_, way).max(axis=-1)
        return far + np.where((signs != turned).any(axis=-1), 1.0, 0.0)


class PairedClosures(NamedTuple):
    """All closures of a group at two u: what is tried (M, n) at the first and the last, and the
    signs (M, k) at both."""

    at: tuple[float, float]
    first: Reals
    last: Reals
    signs: Reals


class FollowedClosure(Struct, frozen=True, eq=False):
    """One closure of a group at rising u (N,): what is tried (N, n), the dyads' signs (N, k).

    ``ends`` says how the way ends below and above.
    """

    at: Reals
    tried: Reals
    signs: Reals
    ends: tuple[End, End] = ("open", "open")

    @property
    def width(self) -> int:
        """How many numbers close the group: what is tried, and the signs."""
        return int(self.tried.shape[1] + self.signs.shape[1])

    def within(self, low: float, high: float) -> FollowedClosure:
        """The part from one u to another, with the next places beyond both."""
        first = max(int(np.searchsorted(self.at, low, side="right")) - 1, 0)
        last = min(int(np.searchsorted(self.at, high)) + 1, len(self.at))
        ends: tuple[End, End] = (
            "open" if first else self.ends[0],
            self.ends[1] if last == len(self.at) else "open",
        )
        part = slice(first, last)
        return FollowedClosure(self.at[part], self.tried[part], self.signs[part], ends)

    def moved(self, by: float) -> FollowedClosure:
        """The same way at other places."""
        return replace(self, at=self.at + by)

    def joined(self, other: FollowedClosure, turning: Sequence[bool]) -> FollowedClosure:
        """With the places of another that follow on these; angles go on without a leap."""
        before = self.at < other.at[0]
        at = np.append(self.at[before], other.at)
        tried = np.concatenate([self.tried[before], other.tried])
        some = np.array(turning)
        tried[:, some] = np.unwrap(tried[:, some], axis=0)
        signs = np.concatenate([self.signs[before], other.signs])
        return FollowedClosure(at, tried, signs, (self.ends[0], other.ends[1]))

    def row_at(self, end: float) -> Reals:
        """What closes the group at one of the places of the way; its sine is not told."""
        n = int(np.searchsorted(self.at, end))
        return np.array([*self.tried[n], *self.signs[n], 1.0])

    def covers(self, at: Reals) -> Reals:
        """Which u lie on the way."""
        return (self.at[0] <= at) & (at <= self.at[-1])

    def lost(self, at: Reals) -> Reals:
        """Which u lie beyond an end at which the way ends for good."""
        low, high = (end != "open" for end in self.ends)
        return (low & (at < self.at[0])) | (high & (at > self.at[-1]))

    def end_between(self, low: float, high: float) -> tuple[float, End] | None:
        """Where, and how, the way ends for good between two places; None where it does not."""
        for end, at in zip(self.ends, (float(self.at[0]), float(self.at[-1])), strict=True):
            if end != "open" and low <= at <= high:
                return at, end
        return None

    def closed(
        self, group: GroupOnWay, number: int, at: Reals, known: Sequence[Reals]
    ) -> tuple[Any, ...]:
        """What closes the group at each u (K,), as its solver gives it; NaN where it does not.

        Where the way was not followed, the closure of a number is sought.
        """
        rows = self.rows(group, at, known)
        rest = np.flatnonzero(~self.covers(at) & ~self.lost(at))
        if rest.size:
            sought = np.array(group.closures(at[rest]).sure(number))
            rows[rest] = sought[:, 1:]
        return group.trying.parts(np.column_stack([np.arange(len(rows)), rows]))

    def rows(self, group: GroupOnWay, at: Reals, known: Sequence[Reals] | None = None) -> Reals:
        """The rows (K, n + k + 1) at each u, closed from between the places on both sides.

        NaN off the way, and where rounding leaves open which closure it is.
        """
        trying, count = group.trying, self.tried.shape[1]
        rows = np.full((len(at), count + self.signs.shape[1] + 1), np.nan)
        which = np.flatnonzero(self.covers(at) & (len(self.at) > 1))
        if not which.size:
            return rows
        here = at[which]
        after = np.clip(np.searchsorted(self.at, here), 1, len(self.at) - 1)
        between = self.between(here, after)
        room = BETWEEN * abs(self.tried[after] - self.tried[after - 1]).max(axis=1) + SURE
        known = group.known(here) if known is None else [array[which] for array in known]
        left = np.arange(len(here))
        turns = (self.signs[after] != self.signs[after - 1]).any(axis=1)
        for side in (self.signs[after - 1], self.signs[after]):
            some, signs = [array[left] for array in known], side[left]
            with np.errstate(all="ignore"):
                tried = trying.closed_beside(some, between[left], signs)
                sine = trying.sines(some, tried, signs)
                sure = abs(tried - between[left]).max(axis=1) <= room[left]
            sure &= sine > HIDDEN
            rows[which[left[sure]]] = np.column_stack([tried, signs, sine])[sure]
            left = left[~sure]
            again = left[turns[left]]
            if not again.size:
                break
            left = again
        lost = np.flatnonzero(np.isnan(rows[which, 0]))
        if lost.size:
            rows[which[lost]] = self.beside_ends(group, here[lost], between[lost], after[lost])
        return rows

    def beside_ends(self, group: GroupOnWay, at: Reals, between: Reals, after: Reals) -> Reals:
        """The rows (K, n + k + 1) where Newton's method does not tell: at a fold the interpolation
        holds, elsewhere the nearest of all closures is taken; NaN where that is not sure.
        """
        trying, count = group.trying, self.tried.shape[1]
        rows = np.full((len(at), count + self.signs.shape[1] + 1), np.nan)
        span, near = self.at[-1] - self.at[0], np.zeros(len(at), dtype=bool)
        for end, place in zip(self.ends, (self.at[0], self.at[-1]), strict=True):
            near |= (end == "fold") & (abs(at - place) <= AT_FOLD * span)
        signs = self.signs[after]
        with np.errstate(all="ignore"):
            sine = trying.sines(group.known(at), between, signs)
        rows[near] = np.column_stack([between, signs, sine])[near]
        rest = np.flatnonzero(~near)
        if not rest.size or len(self.at) < ORDER:
            return rows
        every = group.closures(at[rest])
        for n, k in enumerate(rest):
            found = every.of(n)
            way = abs(self.tried[after[k]] - self.tried[after[k] - 1]).max() * BETWEEN + SURE
            for signs in (self.signs[after[k] - 1], self.signs[after[k]]):
                away = group.apart(found, np.array([*between[k], *signs, 1.0]))
                if len(away) and away.min() <= way and found[away.argmin(), -1] > HIDDEN:
                    rows[k] = found[away.argmin()]
                    break
        return rows

    def between(self, at: Reals, after: Reals) -> Reals:
        """What is tried (K, n) at some u, by the polynomial through the nearest places.

        ``after`` is the number of the first place beyond each. Towards a fold the way goes like a
        root, so that it is laid through the places in another measure.
        """
        places, wanted = self.even(self.at), self.even(at)
        some = min(ORDER, len(places))
        first = np.clip(after - ORDER // 2, 0, len(places) - some)
        which = first[:, None] + np.arange(some)
        near, found = places[which], np.zeros((len(at), self.tried.shape[1]))
        for k in range(some):
            others = np.delete(near, k, axis=1)
            weight = ((wanted[:, None] - others) / (near[:, k, None] - others)).prod(axis=1)
            found += weight[:, None] * self.tried[which[:, k]]
        return found

    def even(self, at: Reals) -> Reals:
        """A measure of the way in which what is tried goes smoothly, up to its folds."""
        low, high = (end == "fold" for end in self.ends)
        below, above = np.maximum(at - self.at[0], 0), np.maximum(self.at[-1] - at, 0)
        if low and high:
            return np.arctan2(np.sqrt(below), np.sqrt(above))
        if low or high:
            return np.sqrt(below) if low else -np.sqrt(above)
        return at


def predicted(found: Sequence[Place], at: float) -> Reals:
    """The state at a further place, by the polynomial through the last ones."""
    way = abs(at - found[-1].at)
    last = [found[-1]]
    for place in reversed(found[-LOOK_BACK:]):
        if abs(place.at - last[-1].at) >= way / 3:
            last.append(place)
        if len(last) == ORDER:
            break
    total = np.zeros(len(found[-1].tried) + len(found[-1].angles))
    for i, place in enumerate(last):
        others = [other.at for k, other in enumerate(last) if k != i]
        weight = np.prod([(at - other) / (place.at - other) for other in others])
        total = total + weight * place.state
    return total


def turned_signs(signs: Reals) -> Reals:
    """All sets of signs in which one or two are turned."""
    some = [(k,) for k in range(len(signs))] + [*combinations(range(len(signs)), 2)]
    return np.array([[-s if k in turned else s for k, s in enumerate(signs)] for turned in some])


def wrapped(angle: Reals) -> Reals:
    """Angles within half a turn of nought."""
    return (angle + np.pi) % (2 * np.pi) - np.pi
