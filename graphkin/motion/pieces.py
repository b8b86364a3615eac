"""A sweep split where the motion ends or may change its closure; each piece has constant signs.

Numerical facts behind it: at a dead point the sine of a crossing falls to nought as a square root
and nothing closes beyond; at a change point it touches nought. There the closure that the motion
takes follows by prediction from the velocity: neither the nearest position nor the same side does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import product
from math import sqrt
from typing import Literal

import numpy as np

from graphkin.errors import ClosureError, GraphkinError, Problem
from graphkin.motion.course import Branches, Course, Reals
from graphkin.motion.numbered import (
    Node,
    Numbered,
    changes,
    nodes,
    numbered,
    same_place,
)
from graphkin.motion.refine import AROUND, TOUCH, last_closing, least_square, touching
from graphkin.motion.sweep import GRID, TURN, Sweep
from graphkin.plane import Line
from graphkin.scene.model import Branch, Closure, Side

End = Literal["dead", "change", "number", "window"]
MOST_CLOSURES = 8
"""Closures of one group of higher class that are tried beyond a change point."""
ALIKE = 1e-8
"""Degrees within which two places are one."""
MOST_PIECES = 400
SUSPECT = 0.3
"""Sine of a crossing below which a minimum is looked at more closely."""
AHEAD = 0.25
"""Steps of the grid on each side of a change point between which the motion is predicted."""
WIDE = 3
"""Steps of the grid between the samples from which a change point is found."""
NARROW = 2
"""Positions of the grid in a row that do not close, and may be one change point."""


@dataclass(frozen=True, slots=True)
class Event:
    """Where a piece ends: a dead point or a change point with the steps whose loci touch there.

    At a ``number`` the closure goes on smoothly under another number. ``beyond`` is a u at which
    nothing closes, for a dead point.
    """

    kind: End
    at: float
    steps: tuple[int, ...] = ()
    beyond: float | None = None


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
        free &= ~here if here.any() else False
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
    turns = (-TURN, 0.0, TURN) if sweep.what == "turn" and sweep.whole else (0.0,)
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


def next_event(course: Course, start: float, stop: float) -> Event:
    """The first dead point or change point on the way; the window's end if there is none."""
    step = course.sweep.grid_step
    count = max(int(np.ceil(abs(stop - start) / step)), 1)
    grid = np.linspace(start, stop, count + 1)
    if start == stop:
        return Event("window", stop)
    margins = course.margins(grid)
    margins[:, 0] = np.where(np.isfinite(margins[:, 0]), margins[:, 0], 0.0)
    closed = np.array(np.isfinite(margins).all(axis=0))
    closed[0] = True
    end = first_end(course, grid, closed)
    last = len(grid) if end is None else end + 1
    for k in suspects(margins[:, :last], closed[:last]):
        event = looked_at(course, grid, k)
        if event is not None and abs(event.at - start) > 0.01 * step:
            return event
    if end is None:
        return Event("window", stop)
    return dead(course, float(grid[end]), float(grid[end + 1]))


def first_end(course: Course, grid: Reals, closed: np.ndarray) -> int | None:
    """The last position of the grid that closes before a dead point; a change point is passed.

    A short run that does not close, with a closing position on both sides, is left to ``suspects``.
    """
    gaps = np.flatnonzero(~closed)
    k = 0
    while k < len(gaps):
        first = int(gaps[k])
        length = 1
        while k + length < len(gaps) and gaps[k + length] == first + length:
            length += 1
        past = first + length
        at_end = past >= len(grid)
        if length > NARROW or (at_end and not is_touch(course, grid, first)):
            return first - 1
        if not at_end and not is_touch(course, grid, first + length // 2):
            return first - 1
        k += length
    return None


def is_touch(course: Course, grid: Reals, k: int) -> bool:
    """Whether a position of the grid that does not close is one where loci only touch."""
    event = looked_at(course, grid, k)
    return event is not None and event.kind == "change"


def suspects(margins: Reals, closed: np.ndarray) -> list[int]:
    """Positions of the grid near which a crossing may touch nought, in order."""
    found: set[int] = set()
    rows = margins[:-1]
    if rows.shape[1] > 2:
        middle, before, after = rows[:, 1:-1], rows[:, :-2], rows[:, 2:]
        with np.errstate(invalid="ignore"):
            low = (middle < SUSPECT) & (middle <= before) & (middle <= after)
            square = middle**2
            bend = before**2 + after**2 - 2 * square
            slope = (after**2 - before**2) / 2
            vertex = square - slope**2 / np.where(bend > 0, 2 * bend, np.inf)
            near = vertex < 0.3 * np.maximum(square, bend) + TOUCH
        found.update(int(k) + 1 for k in np.flatnonzero((low & near).any(axis=0)))
    gaps = np.flatnonzero(~closed)
    found.update(int(k) for k in gaps if k > 0)
    return sorted(found)


def looked_at(course: Course, grid: Reals, k: int) -> Event | None:
    """What happens near a position of the grid: a change point, a narrow gap, or nothing."""
    step = float(grid[1] - grid[0])
    centre = float(grid[k])
    known: dict[int, tuple[float, float]] = {}
    for _ in range(2):
        samples = course.margins(centre + AROUND * step)[:-1]
        lows = {n: least_square(AROUND, row) for n, row in enumerate(samples)}
        known = {n: low for n, low in lows.items() if low is not None and low[1] < TOUCH}
        if not known:
            return None
        first = min(known, key=lambda n: known[n][1])
        centre += known[first][0] * step
    if known[first][1] < -TOUCH:
        return dead(course, centre - 2 * step, centre)
    at = centre + touch_of(course, centre, step, first)
    steps = tuple(course.crossings[n] for n in sorted(known))
    if runs_away(course, steps[0], at - step):
        return Event("dead", at, steps, at)
    return Event("change", at, steps)


def touch_of(course: Course, centre: float, step: float, row: int) -> float:
    """How far from a place a margin touches nought; from afar, where its digits are sure."""
    for wide in (WIDE * step, step):
        samples = course.margins(centre + AROUND * wide)[row]
        shift = touching(AROUND, samples) if np.isfinite(samples).all() else None
        if shift is not None:
            return shift * wide
    return 0.0


def runs_away(course: Course, number: int, at: float) -> bool:
    """Whether a step crosses two straight lines: their crossing is at infinity when parallel."""
    loci = course.loci(number, at)
    return len(loci) == 2 and all(isinstance(locus, Line) for locus in loci)


def dead(course: Course, inside: float, outside: float) -> Event:
    """The dead point between a position that closes and one that does not."""
    last = last_closing(course.closes, inside, outside)
    way = 1.0 if outside > inside else -1.0
    past = last + way * max(1e-9 * course.sweep.grid_step, 8 * float(np.spacing(abs(last))))
    failing = np.flatnonzero(~np.isfinite(course.margins(np.array([past]))[:-1, 0]))
    steps = (course.crossings[failing[0]],) if failing.size else ()
    return Event("dead", last, steps, past)


def beyond(course: Course, event: Event, way: int) -> Course:
    """The course past a change point: the closures whose positions the velocity predicts.

    Each closure that hangs on a touching step is tried both ways, a numbered one by its numbers.
    """
    step = AHEAD * abs(course.sweep.grid_step)
    before, after = event.at - way * step, event.at + way * step
    targets = [t for t in course.program.targets if t[0] == "position"]
    predicted = predict(course, before, after)
    best, least = course, np.inf
    for branches in choices(course, event):
        other = Course(course.sweep, branches, after)
        try:
            found = other.columns(np.array([after]), targets)
        except GraphkinError:  # an idle link that does not fit this closure
            continue
        miss = max(abs(complex(found[t][0]) - predicted[t]) for t in targets)
        if miss < least:
            best, least = other, miss
    return best


def predict(course: Course, before: float, after: float) -> Mapping[tuple[str, str], complex]:
    """Where every point will stand, from its position, velocity and acceleration by u before."""
    way = (after - before) * course.sweep.per_unit
    targets = course.program.targets
    names = [of for what, of in targets if what == "position"]
    quantities = ("position", "velocity", "acceleration")
    wanted = [(what, of) for what in quantities for of in names if (what, of) in targets]
    found = course.columns(np.array([before]), wanted, geometric=True)
    return {
        ("position", of): sum(
            complex(found[what, of][0]) * factor
            for what, factor in zip(quantities, (1.0, way, way * way / 2), strict=True)
            if (what, of) in found
        )
        for of in names
    }


def choices(course: Course, event: Event) -> list[Branches]:
    """Every set of closures that differs only where loci touch at a change point."""
    touched = set(event.steps)
    options: dict[str, list[Branch]] = {}
    for name, branch in course.branches.items():
        others = others_of(branch)
        if not touched.isdisjoint(course.picks(name, others[0])):
            options[name] = [branch, *others]
    return [
        {**course.branches, **dict(zip(options, picked, strict=True))}
        for picked in product(*options.values())
    ]


def others_of(branch: Branch) -> list[Branch]:
    """The other closures of a group: the other side or way, or all other numbers."""
    if isinstance(branch, Side):
        return [branch._replace(side=-branch.side)]
    if isinstance(branch, Closure):
        numbers = range(1, MOST_CLOSURES + 1)
        return [Closure(number) for number in numbers if number != branch.number]
    return [branch._replace(way=-branch.way)]
