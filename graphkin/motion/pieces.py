"""A sweep split where the motion ends or may change its closure; each piece has constant signs.

A cycle is followed from where the scene stands, forth and back, from one change point to the next.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from graphkin.errors import ClosureError, Problem
from graphkin.motion.change import beyond
from graphkin.motion.course import Branches, Course, Reals
from graphkin.motion.driving import GRID, TURN
from graphkin.motion.ends import Event, next_event
from graphkin.motion.numbered import (
    Node,
    Numbered,
    changes,
    nodes,
    numbered,
    same_place,
)
from graphkin.motion.refine import TOUCH
from graphkin.motion.sweep import Sweep

ALIKE = 1e-8
"""Degrees within which two places are one."""
MOST_PIECES = 400


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a sweep, low to high, on which all signs stay, and how it ends on both sides."""

    low: Event
    high: Event
    course: Course

    @property
    def branches(self) -> Branches:
        """The closures picked on this piece, as [branches] states them."""
        return self.course.branches

    def holds(self, at: Reals) -> np.ndarray:
        """Which u lie within, ends included."""
        return (self.low.at <= at) & (at <= self.high.at)


Range = tuple[Piece, ...]
"""Pieces that join at change points, between two dead points, or all the way round."""


@dataclass(frozen=True, slots=True)
class Path:
    """The ranges of a sweep, the one in which the scene stands first.

    ``whole`` tells that the first range goes all the way round; ``returns`` that the closures are
    then those of the start again.
    """

    ranges: tuple[Range, ...]
    whole: bool
    returns: bool


def followed(sweep: Sweep, branches: Branches | None = None) -> Path:
    """The reachable ranges of a sweep, from where the scene stands and with its closures.

    ``branches`` overrides them. Ranges that cannot be reached from there come after it, with the
    same closures picked. Raises ClosureError where nothing closes at all.
    """
    course = Course(sweep, sweep.original.branches if branches is None else branches)
    ranges: list[Range] = []
    if (group := numbered(course)) is not None and course.closes(np.array([sweep.start]))[0]:
        return numbered_path(group, sweep.start)
    grid = sweep.low + (np.arange(GRID) + 0.5) * sweep.grid_step
    free = course.closes(grid)
    whole = returns = False
    start = beside_touch(course, sweep.start)
    if start is not None:
        found, whole, returns = from_start(course, start)
        ranges.append(found)
        free &= ~covered(sweep, found, grid)
    while not whole and free.any():
        found, _, _ = from_start(course, seed(grid, free))
        ranges.append(found)
        here = covered(sweep, found, grid)
        if not (free & here).any():
            break
        free &= ~here
    if not ranges:
        raise ClosureError(
            Problem(
                "the cycle",
                "it closes for no position of the driver",
                "lengths that can be assembled",
                "graphkin check shows what is wrong",
            )
        )
    return Path(tuple(ranges), whole, returns)


def numbered_path(group: Numbered, start: float) -> Path:
    """The range of a group of higher class through one position, followed by its motion."""
    sweep = group.course.sweep
    far = (start + TURN, start - TURN) if sweep.whole else (sweep.high, sweep.low)
    ahead, end = nodes(group, start, max(far[0], start))
    high = Event("dead" if end.dead else "window", end.at, (), end.beyond if end.dead else None)
    upward = cut(group, ahead, Event("window", start), high)
    if sweep.whole and not end.dead:
        returns = same_place(ahead[0], ahead[-1])
        return Path((counted_from_nought(upward) if returns else upward,), True, returns)
    behind, end = nodes(group, start, min(far[1], start))
    low = Event("dead" if end.dead else "window", end.at, (), end.beyond if end.dead else None)
    downward = tuple(reversed(cut(group, behind, Event("window", start), low)))
    turned = tuple(replace(piece, low=piece.high, high=piece.low) for piece in downward)
    joined = replace(upward[0], low=turned[-1].low)
    return Path(((*turned[:-1], joined, *upward[1:]),), False, False)


def cut(group: Numbered, found: list[Node], start: Event, end: Event) -> Range:
    """The pieces of one number each, on the way from the first node to the last."""
    marks = changes(group, found)
    numbers = [found[0].number, *(number for _, _, number in marks)]
    firsts = [start, *(Event("number", at) for _, at, _ in marks)]
    lasts = [*(Event("number", at) for at, _, _ in marks), end]
    return tuple(
        Piece(first, last, group.with_number(number, (first.at + last.at) / 2))
        for number, first, last in zip(numbers, firsts, lasts, strict=True)
    )


def beside_touch(course: Course, start: float) -> float | None:
    """The start, or half a step past it where loci touch; None where nothing closes."""
    past = start + course.sweep.grid_step / 2
    here, ahead = course.margins(np.array([start, past])).T
    if np.isfinite(here).all() and here.min() > sqrt(TOUCH):
        return start
    if np.isfinite(ahead).all():
        return past
    return start if np.isfinite(here).all() else None


def seed(grid: Reals, free: np.ndarray) -> float:
    """The middle of the first run of positions that are not yet covered."""
    first = int(np.argmax(free))
    after = np.flatnonzero(~free[first:])
    last = first + (int(after[0]) if after.size else len(free) - first) - 1
    return float((grid[first] + grid[last]) / 2)


def covered(sweep: Sweep, found: Range, grid: Reals) -> np.ndarray:
    """Which positions of the grid a range passes, whole turns apart."""
    low, high, half = found[0].low.at, found[-1].high.at, sweep.grid_step
    whole = sweep.what == "turn" and sweep.whole
    turns = [k * TURN for k in range(-2, 3)] if whole else [0.0]
    passed = np.zeros(len(grid), dtype=bool)
    for turn in turns:
        passed |= (low - half <= grid + turn) & (grid + turn <= high + half)
    return passed


def from_start(course: Course, start: float) -> tuple[Range, bool, bool]:
    """The range through one position: its pieces, whether it goes round, and then returns."""
    sweep = course.sweep
    if sweep.whole:
        ahead = marched(course, start, start + TURN)
        if ahead[-1].high.kind == "window":
            returns = dict(ahead[-1].branches) == dict(course.branches)
            return (counted_from_nought(ahead) if returns else ahead), True, returns
        behind = marched(course, start, start - TURN)
        if behind[0].low.at > TURN / 2:  # easier to read as a range about nought
            return from_start(course, start - TURN)
    else:
        ahead = marched(course, start, max(sweep.high, start))
        behind = marched(course, start, min(sweep.low, start))
    joined = replace(ahead[0], low=behind[-1].low)
    return (*behind[:-1], joined, *ahead[1:]), False, False


def counted_from_nought(pieces: Range) -> Range:
    """The pieces of a whole turn that comes back, from 0 to 360 degrees instead of the start's."""
    before: list[Piece] = []
    after: list[Piece] = []
    for piece in pieces:
        low, high = piece.low, piece.high
        if low.at < TURN - ALIKE < TURN + ALIKE < high.at:
            before.append(replace(piece, high=Event("window", TURN)))
            after.append(Piece(Event("window", 0.0), turned_back(high), piece.course))
        elif low.at < TURN - ALIKE:
            before.append(piece)
        else:
            after.append(replace(piece, low=turned_back(low), high=turned_back(high)))
    if not after:
        return pieces
    joined = replace(before[0], low=after[-1].low)
    return (*after[:-1], joined, *before[1:])


def turned_back(event: Event) -> Event:
    """An event one turn earlier."""
    return replace(event, at=max(event.at - TURN, 0.0))


def marched(course: Course, start: float, stop: float) -> Range:
    """The pieces from one position to another, or to the dead point before it, in rising order."""
    forward = stop >= start
    pieces: list[Piece] = []
    here = Event("window", start)
    while len(pieces) < MOST_PIECES:
        event = next_event(course, here.at, stop)
        low, high = (here, event) if forward else (event, here)
        pieces.append(Piece(low, high, course))
        if event.kind != "change":
            break
        course = beyond(course, event, 1 if forward else -1)
        here = event
    return tuple(pieces) if forward else tuple(reversed(pieces))
