"""The way of groups of class III and higher through the range of the driver.

A group is followed from where the scene stands, so that a page knows near which value to look at
each place. Where a dyad of the group is stretched on the way, it goes on with its other side.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

from msgspec import Struct

from graphkin.web.page_driver import LEAST, PARTS, Reach
from graphkin.web.traced_closings import Solver, State, TracedClosing

HALVED = 18
"""How often the way to the next position is halved before the range ends there."""
FAR = 0.09
"""A tried value that leaps so far, in radians or parts of its size, is of another closure."""
HALVINGS = 60
"""How often an interval is halved."""
BESIDE_END = 1e-6
"""So near to the end of the way, in parts of a step, a place is the end."""
NEAR = 1e-4
"""How near to the last value that can be tried, in radians or parts of its size, a dyad is taken
for stretched."""
PARTED = (64, 16, 4)
"""The parts of a step by which a dyad is then taken over to its other side."""
FINEST, COARSEST, TRIED = 1e-7, 0.3, 240
"""Roots of the distances from the last value that are tried there, and how many."""
SHARES = (0.0, -1.0, 1.0, -0.25, 0.25, -4.0, 4.0)
"""Where the last value that can be tried is looked for, in parts of such a distance."""


class TrackedBranch(Struct, frozen=True):
    """The way of groups from where the scene stands: positions of the driver, what closes there."""

    at: tuple[float, ...] = ()
    states: tuple[State, ...] = ()


def around(
    solve: Solver,
    start: float,
    window: tuple[float, float],
    *,
    turning: bool,
) -> tuple[Reach, TrackedBranch] | None:
    """The range about the start, and the way through it; None where it is a mere place."""
    low, high = window
    up = followed(solve, start, high)
    if turning and up.at[-1] == high and returns(solve, up):
        turn = high - start
        first = turn * math.floor(start / turn)
        return Reach(first, first + turn, True), up
    down = followed(solve, start, low)
    at, states = (*down.at[:0:-1], *up.at), (*down.states[:0:-1], *up.states)
    if at[-1] - at[0] <= LEAST * (high - low):
        return None
    return Reach(at[0], at[-1], False), TrackedBranch(at, states)


def followed(solve: Solver, start: float, end: float) -> TrackedBranch:
    """The way from the start as far as the end, or as far as the groups close."""
    first = tuple(number for each in solve.closings for number in each.drawn)
    at, states = [start], [solve(start, first) or first]
    step, halved = (end - start) / PARTS, 0
    while at[-1] != end:
        place = at[-1] + step / 2**halved
        place = end if (end - place) / step < BESIDE_END else place
        guess = extrapolated(at, states, place)
        found = solve(place, guess)
        if found is None or leaps(solve, guess, found):
            if halved < HALVED:
                halved += 1
                continue
            over = taken_over(solve, at, states, step)
            if over is None:
                break
            place, found = over
        at.append(place)
        states.append(found)
        halved = max(0, halved - 1)
    return TrackedBranch(tuple(at), tuple(states))


def taken_over(
    solve: Solver, at: Sequence[float], states: Sequence[State], step: float
) -> tuple[float, State] | None:
    """A place a little farther where a dyad that is stretched here stands on its other side.

    There is a last value that can be tried; the misfit goes with the root of the distance from it.
    """
    for k, (place, each) in enumerate(solve.placed()):
        if each.count > 1:
            if over := turned_over(solve, at, states, step, place, each):
                return over
            continue
        if last_value(solve.missed(k, at[-1], list(states[-1])), states[-1][place], each) is None:
            continue
        for sign in range(place + 1, place + len(each.names)):
            turned = list(states[-1])
            turned[sign] = -turned[sign]
            for part in PARTED:
                there = at[-1] + step / part
                gone = extrapolated(at, states, there)[place]
                found = rooted(solve.missed(k, there, turned), gone, each)
                if found is not None:
                    turned[place] = found
                    return there, tuple(turned)
    return None


def turned_over(
    solve: Solver,
    at: Sequence[float],
    states: Sequence[State],
    step: float,
    place: int,
    each: TracedClosing,
) -> tuple[float, State] | None:
    """The same of a group in which several links are tried: one sign after the other is turned."""
    for sign in range(place + each.count, place + len(each.names)):
        for part in PARTED:
            there = at[-1] + step / part
            turned = list(extrapolated(at, states, there))
            turned[sign] = -states[-1][sign]
            found = solve(there, tuple(turned))
            if found is not None and not leaps(solve, tuple(turned), found):
                return there, found
    return None


def last_value(
    missed: Callable[[float], Any], near: float, each: TracedClosing, wide: float = NEAR
) -> tuple[float, float] | None:
    """The last value near another that can be tried, and the sense in which others lie."""
    inside = [near + wide * each.size * share for share in SHARES]
    known = [value for value in inside if drawn(missed, value)]
    for first in known:
        for other in inside:
            if not drawn(missed, other):
                good, bad = first, other
                for _ in range(HALVINGS):
                    middle = (good + bad) / 2
                    good, bad = (middle, bad) if drawn(missed, middle) else (good, middle)
                return good, 1.0 if first > other else -1.0
    return None


def drawn(missed: Callable[[float], Any], value: float) -> bool:
    """Whether a group can be drawn at a value that is tried."""
    try:
        return math.isfinite(missed(value)[0])
    except (ValueError, ZeroDivisionError, OverflowError):
        return False


def rooted(missed: Callable[[float], Any], near: float, each: TracedClosing) -> float | None:
    """The closure nearest to the last value that can be tried, near another; None without one."""
    edge = last_value(missed, near, each, 100 * NEAR)
    if edge is None:
        return None
    last, sense = edge
    ratio = (COARSEST / FINEST) ** (1 / TRIED)
    roots = [0.0, *(FINEST * ratio**k for k in range(TRIED + 1))]
    values = [last + sense * each.size * root * root for root in roots]
    for near_edge, farther in pairwise(values):
        if not drawn(missed, farther):
            return None
        if missed(near_edge)[0] * missed(farther)[0] <= 0:
            found = halved_between(missed, near_edge, farther)
            return found if missed(found)[1] > 0 else None
    return None


def halved_between(missed: Callable[[float], Any], low: float, high: float) -> float:
    """Where a misfit vanishes between two values at which it has two signs."""
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        same = missed(low)[0] * missed(middle)[0] > 0
        low, high = (middle, high) if same else (low, middle)
    return low


def extrapolated(at: Sequence[float], states: Sequence[State], place: float) -> State:
    """The state at a further place if it went on as before."""
    if len(at) < 2:
        return states[-1]
    part = (place - at[-1]) / (at[-1] - at[-2])
    pairs = zip(states[-2], states[-1], strict=True)
    return tuple(b if a == -b else b + part * (b - a) for a, b in pairs)


def leaps(solve: Solver, guess: State, found: State) -> bool:
    """Whether a closure found is not the one that was followed."""
    return any(
        abs(guess[i + k] - found[i + k]) > FAR * size
        for i, each in solve.placed()
        for k, size in enumerate(each.sizes)
    )


def returns(solve: Solver, way: TrackedBranch) -> bool:
    """Whether groups are at the end of a turn what they were at its beginning."""
    first, last = way.states[0], way.states[-1]
    for place, each in solve.placed():
        for k, (turning, size) in enumerate(zip(each.turns, each.sizes, strict=True)):
            apart = last[place + k] - first[place + k]
            turns = 2 * math.pi * round(apart / (2 * math.pi)) if turning else 0.0
            if abs(apart - turns) > 1e-6 * size:
                return False
    return True
