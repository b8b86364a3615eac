"""One closure of a group followed along the motion, without a new search for the others.

The last positions predict the next one, and Newton's method leads from the prediction to a closure.
A step is accepted only if the closure is close to the prediction. Where the closure meets another
one, the driver turns back along the path; that fold is the extreme point of a smooth curve.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any, Literal, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.higher_class.closure_solver import HIDDEN, Closures, Trying
from graphkin.construction.higher_class.several_trials import SeveralTrials
from graphkin.numbers.arithmetic import np, phase
from graphkin.numbers.common_roots import roots_beside

Reals = Any
End = Literal["open", "fold", "stop"]
"""How a path ends: it goes on, it meets another closure, or nothing closes beyond."""

FIRST, LONGEST = 1e-6, 1 / 90
"""The first and the longest step, as fractions of the usual range of the driver."""
LEAST, ENOUGH = 1e-3, 1e-10
"""The step below which a fold or a leap is tried, and the step below which the path ends."""
NEAR, SURE, FAR, MOST = 0.05, 1e-7, 0.05, 0.7
"""Limits on a closure's distance from its prediction, and on a link's step.

``NEAR`` is a fraction of the links' step, ``SURE`` allows for rounding and ``FAR`` is in radians.
The step of a link is at most ``MOST`` radians.
"""
START = 1e-2
"""The first step of a link, in radians, for which there is no prediction."""
GOOD, GROW, SHRINK = 0.01, 2.0, 4.0
"""The error, as a fraction of the step, below which steps grow; their growth and shrinkage."""
LEAPS = (3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2)
"""Steps that pass a crossing of two closures, as fractions of the usual range."""
LEAP_NEAR = 0.01
"""As ``NEAR``, for such a step."""
ORDER = 4
"""Number of places in a prediction, and in an interpolation along a path."""
LOOK_BACK = 60
"""Number of last places from which those of a prediction are chosen."""
MOST_PLACES = 50_000
"""The most steps that are tried along one path."""
ON_FOLD, ROUNDS = 9, 3
"""Number of places near a fold that locate it, and number of times they are moved closer to it."""
TURN_BACK = 0.7
"""How far ahead a fold is searched for, in radians."""
BETWEEN = 0.3
"""Largest distance from an interpolated closure, as a fraction of its neighbours' distance."""
MERGED = 1e-4
"""Sine of crossing below which the numbers of two closures that meet are open."""
SHORT = 4
"""Steps that lead from the places of a path to one between."""
AT_FOLD = 1e-7
"""Fraction of the path near a fold in which the interpolation is used without refinement."""


class Place(NamedTuple):
    """One place of a path: u, trial values (n,), signs (k,) of dyads, angles (L,) of links."""

    at: float
    tried: Reals
    signs: Reals
    angles: Reals

    @property
    def state(self) -> Reals:
        """The trial values followed by the angles."""
        return np.concatenate([self.tried, self.angles])


class GroupOnWay(Struct, frozen=True, dict=True):
    """A group of a moving mechanism; ``known`` gives its known values, as arrays, at u (N,).

    ``usual`` is the driver's usual range, by which steps are measured.
    """

    trying: Trying
    known: Callable[[Reals], list[Reals]]
    usual: float

    # --- one closure, followed -------------------------------------------------------------------

    def begun(self, at: float, number: int) -> Reals | None:
        """The row of the closure with a given number at u; None where there is none."""
        known = [array[0].item() for array in self.known(np.array([at]))]
        with np.errstate(all="ignore"):
            row = self.trying.closures_of(known).picked(number)[0][1:]
        return None if np.isnan(row).any() else row

    def followed(
        self,
        row: Reals,
        start: float,
        stop: float,
        seen: Callable[[float, Reals], None] = lambda at, row: None,
        longest: float = LONGEST,
    ) -> FollowedClosure:
        """The path of a closure from one place to another, or as far as it goes.

        A step is at most ``longest`` usual ranges. ``seen`` is called for each place, in order,
        with the values that close the group there.
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
                step = min(step * (GROW if miss < GOOD else 1.0), longest * self.usual)
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
        """The next place of a path, and its error relative to the step; None if not certain.

        A dyad that is stretched flat on the way continues with its other sign.
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
        """A place beyond a crossing of two closures, where no ordinary step comes close enough."""
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
        """The places from the last one to the fold with another closure; None if none is near.

        One of the trial values is the parameter of this part of the path. As a function of it, u
        has its extreme at the fold. A group at rest, or one that turns round, is at none.
        """
        if len(found) < ORDER:
            return None
        count = len(found[-1].tried)
        last = found[-1]
        step = (found[-1].tried - found[-2].tried) / size[:count]
        lead = int(abs(step).argmax())
        s, u = np.array([(place.tried[lead], place.at) for place in found[-3:]]).T
        if not (np.diff(s) * np.sign(step[lead]) > SURE * size[lead]).all():
            return None
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
        """Rows (K, 1 + n) of u and closed trial values, with the value ``lead`` fixed."""
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
        """Trial values (K, n) of closures near given ones, and the angles of the links (K, L).

        NaN where Newton's method does not lead to a closure.
        """
        known = self.known(at)
        with np.errstate(all="ignore"):
            found = self.trying.closed_beside(known, tried, signs)
            return found, self.angles(self.trying.found(known, found, signs))

    def drawn(self, at: Reals, tried: Reals, signs: Reals) -> Reals:
        with np.errstate(all="ignore"):
            return self.angles(self.trying.found(self.known(at), tried, signs))

    def angles(self, found: dict[int, Any]) -> Reals:
        """The angles of the links (K, L) among results; NaN where a link faces the wrong way."""
        angles = np.stack([phase(found[n]) for n in self.trying.axes], axis=1)
        for one in self.trying.unknowns:
            if one.facing is not None:
                angles[~(found[one.facing] > 0)] = np.nan
        return angles

    def sizes(self, at: Reals) -> Reals:
        """The units of trial values and angles: a radian, or the range of a tried coordinate."""
        scale = self.trying.scales(self.known(at), 1)[0]
        return np.concatenate([scale, np.ones(len(self.trying.axes))])

    # --- all closures, and their numbers ---------------------------------------------------------

    def closures(self, at: Reals) -> Closures:
        """All closures at each u, in the order of their numbers."""
        with np.errstate(all="ignore"):
            return self.trying.every(self.known(at), len(at))

    @cached_property
    def searched(self) -> dict[float, Reals]:
        """The closures at each u that was searched."""
        return {}

    def every(self, at: Reals) -> list[Reals]:
        """The closures at each u, in rows (M, n + k + 1); no u is searched twice."""
        new = np.array([each for each in dict.fromkeys(at.tolist()) if each not in self.searched])
        if new.size:
            found = self.closures(new)
            self.searched.update((each, found.of(n)) for n, each in enumerate(new.tolist()))
        return [self.searched[each] for each in at.tolist()]

    def numbers(self, way: FollowedClosure, at: Reals) -> Reals:
        """The number of a followed closure at each u; 0 where rounding leaves it open."""
        rows = way.rows(self, at)
        every = zip(self.every(at), rows, strict=True)
        return np.array([self.number(closures, row) for closures, row in every], dtype=int)

    def met(self, low: float, high: float) -> float | None:
        """The u at which two closures meet that exist at only one of two places.

        None where the counts do not differ by two.
        """
        first, last = self.every(np.array([low, high]))
        here, there = (low, high) if len(first) > len(last) else (high, low)
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
        """The number of a row among all closures (M, n + k + 1) at one place; 0 if uncertain."""
        if not len(every) or not row[-1] > MERGED:
            return 0
        away = self.apart(every, row)
        best = int(away.argmin())
        others = np.delete(away, best)
        return best + 1 if away[best] < min(SURE * 10, others.min(initial=np.inf)) else 0

    def paired_at(self, low: float, high: float) -> PairedClosures | None:
        """All closures at two u, each of the first (M, n) paired with the nearest of the second.

        None where they do not match one to one with the same signs.
        """
        first, second = self.every(np.array([low, high]))
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
        return PairedClosures((low, high), before, after, signs)

    def numbers_led(self, pairs: PairedClosures, way: FollowedClosure, at: Reals) -> Reals | None:
        """As ``numbers``, from closures interpolated between two places; None if uncertain."""
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
        """The distances of closures (M, ...) from another, in trial values and signs."""
        (tried, signs, _), (other, turned, _) = self.trying.split(every), self.trying.split(row)
        way = abs(tried - other)
        turning = np.array([one.turns for one in self.trying.unknowns])
        round_ = np.minimum(way % (2 * np.pi), -way % (2 * np.pi))
        far = np.where(turning, round_, way).max(axis=-1)
        return far + np.where((signs != turned).any(axis=-1), 1.0, 0.0)


class PairedClosures(NamedTuple):
    """All closures of a group at two u: trial values (M, n) at both, and common signs (M, k)."""

    at: tuple[float, float]
    first: Reals
    last: Reals
    signs: Reals


class FollowedClosure(Struct, frozen=True, eq=False):
    """One closure of a group at rising u (N,): trial values (N, n), signs of the dyads (N, k).

    ``ends`` says how the path ends below and above.
    """

    at: Reals
    tried: Reals
    signs: Reals
    ends: tuple[End, End] = ("open", "open")

    @property
    def width(self) -> int:
        """The number of values that close the group: trial values and signs."""
        return int(self.tried.shape[1] + self.signs.shape[1])

    def within(self, low: float, high: float) -> FollowedClosure:
        """The part of the path between two u, with the next places beyond both."""
        first = max(int(np.searchsorted(self.at, low, side="right")) - 1, 0)
        last = min(int(np.searchsorted(self.at, high)) + 1, len(self.at))
        ends: tuple[End, End] = (
            "open" if first else self.ends[0],
            self.ends[1] if last == len(self.at) else "open",
        )
        part = slice(first, last)
        return FollowedClosure(self.at[part], self.tried[part], self.signs[part], ends)

    def moved(self, by: float) -> FollowedClosure:
        """The same path with all places shifted."""
        return replace(self, at=self.at + by)

    def joined(self, other: FollowedClosure, turning: Sequence[bool]) -> FollowedClosure:
        """This path with the places of another that follow; angles continue without a jump."""
        before = self.at < other.at[0]
        at = np.append(self.at[before], other.at)
        tried = np.concatenate([self.tried[before], other.tried])
        some = np.array(turning)
        tried[:, some] = np.unwrap(tried[:, some], axis=0)
        signs = np.concatenate([self.signs[before], other.signs])
        return FollowedClosure(at, tried, signs, (self.ends[0], other.ends[1]))

    def row_at(self, end: float) -> Reals:
        """The values that close the group at a place of the path; the sine is a placeholder, 1."""
        n = int(np.searchsorted(self.at, end))
        return np.array([*self.tried[n], *self.signs[n], 1.0])

    def covers(self, at: Reals) -> Reals:
        """A mask of the u that lie on the path."""
        return (self.at[0] <= at) & (at <= self.at[-1])

    def lost(self, at: Reals) -> Reals:
        """A mask of the u beyond an end at which the path ends for good."""
        low, high = (end != "open" for end in self.ends)
        return (low & (at < self.at[0])) | (high & (at > self.at[-1]))

    def end_between(self, low: float, high: float) -> tuple[float, End] | None:
        """The u and the kind of a final end between two places; None if there is none."""
        for end, at in zip(self.ends, (float(self.at[0]), float(self.at[-1])), strict=True):
            if end != "open" and low <= at <= high:
                return at, end
        return None

    def closed(
        self, group: GroupOnWay, number: int, at: Reals, known: Sequence[Reals], lost: Reals
    ) -> tuple[Any, ...]:
        """The values that close the group at each u (K,), as its solver gives them; else NaN.

        Where the path was not followed, the closure with the given number is searched for, unless
        the position is ``lost``.
        """
        rows = self.rows(group, at, known)
        rest = np.flatnonzero(~self.covers(at) & ~lost)
        if rest.size:
            sought = np.array(group.closures(at[rest]).sure(number))
            rows[rest] = sought[:, 1:]
        return group.trying.parts(np.column_stack([np.arange(len(rows)), rows]))

    def rows(self, group: GroupOnWay, at: Reals, known: Sequence[Reals] | None = None) -> Reals:
        """The rows (K, n + k + 1) at each u, closed from the interpolation between places.

        NaN off the path, and where rounding leaves open which closure it is.
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
        """The rows (K, n + k + 1) where Newton's method fails.

        Near a fold, the interpolation is used. Elsewhere, the nearest of all closures is taken; NaN
        where that is not certain. Where several links are tried, a search costs a hundredfold, and
        the path is followed again from the place before.
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
        if trying.several:
            for k in rest:
                over = self.over_flat(group, float(at[k]), between[k], int(after[k]))
                rows[k] = self.reached(group, float(at[k]), int(after[k])) if over is None else over
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

    def over_flat(self, group: GroupOnWay, at: float, between: Reals, after: int) -> Reals | None:
        """The row (n + k + 1) at one u where a dyad is stretched flat between two places.

        None where none of their signs differ, or where nothing closes nearby.
        """
        signs, trying = self.signs[after - 1], group.trying
        if not isinstance(trying, SeveralTrials) or (signs == self.signs[after]).all():
            return None
        room = abs(self.tried[after] - self.tried[after - 1]).max() * BETWEEN + SURE
        known = group.known(np.array([at]))
        with np.errstate(all="ignore"):
            found = trying.closed_over_flat(known, between, signs, room)
            if found is None:
                return None
            sine = trying.sines(known, *(each[None] for each in found))
        return np.concatenate([*found, sine]) if sine[0] > HIDDEN else None

    def reached(self, group: GroupOnWay, at: float, after: int) -> Reals:
        """The row (n + k + 1) at one u, by short steps from the places before; NaN where lost."""
        trying, some = group.trying, slice(max(after - ORDER, 0), after)
        with np.errstate(all="ignore"):
            angles = group.drawn(self.at[some], self.tried[some], self.signs[some])
        columns = self.at[some], self.tried[some], self.signs[some], np.unwrap(angles, axis=0)
        found = [Place(*each) for each in zip(*columns, strict=True)]
        size = group.sizes(np.array([at]))
        for each in np.linspace(found[-1].at, at, SHORT + 1)[1:]:
            place, _ = group.step_to(float(each), found, size, NEAR)
            if place is None:
                return np.full(self.width + 1, np.nan)
            found.append(place)
        tried, signs = found[-1].tried[None], found[-1].signs[None]
        with np.errstate(all="ignore"):
            sine = trying.sines(group.known(np.array([at])), tried, signs)
        return np.concatenate([tried[0], signs[0], np.where(sine > HIDDEN, sine, np.nan)])

    def between(self, at: Reals, after: Reals) -> Reals:
        """The trial values (K, n) at some u, by the polynomial through the nearest places.

        ``after`` is the index of the first place beyond each u. Near a fold the path behaves like a
        square root, so the polynomial uses another parameter.
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
        """A parameter of the path in which the trial values are smooth up to the folds."""
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
    """All sets of signs with one or two signs reversed."""
    some = [(k,) for k in range(len(signs))] + [*combinations(range(len(signs)), 2)]
    return np.array([[-s if k in turned else s for k, s in enumerate(signs)] for turned in some])


def wrapped(angle: Reals) -> Reals:
    """Angles reduced to half a turn either side of zero."""
    return (angle + np.pi) % (2 * np.pi) - np.pi
