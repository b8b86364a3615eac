"""A sweep split where the motion ends or may change its closure; each piece has constant signs.

A cycle is followed from where the scene stands, forth and back, from one change point to the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import floor, lcm, pi, sqrt

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.program import Target
from graphkin.construction.higher_class.following import FollowedClosure
from graphkin.motion.change_points import beyond
from graphkin.motion.closures_followed import carried, carried_about, numbers_between
from graphkin.motion.course import Branches, Course, Reals
from graphkin.motion.driving import GRID, TURN
from graphkin.motion.ends import Event, next_event
from graphkin.motion.refine import TOUCH
from graphkin.motion.sweep import Sweep
from graphkin.motion.turns_counted import Turned
from graphkin.motion.turns_followed import led
from graphkin.numbers.arithmetic import phase
from graphkin.text.errors import ClosureError, Problem, SceneError

ALIKE = 1e-8
"""Degrees within which two places are one."""
BACK = 1e-6
"""Miss after a whole turn, in parts of the mechanism's size, with which it has come back."""
MOST_PIECES = 400
"""Pieces into which change points may part a range."""
FEWER = 360
"""Positions of a sweep at which a group of higher class is sought that does not close where the
scene is drawn."""
MOST_TURNS = 24
"""Turns of the driver, forth and back, through which a motion that wheels carry on is followed."""
MOST_WAYS = 200
"""How many turns, or ways of a slide, a motion is followed from where the scene stands."""


class Piece(Struct, frozen=True):
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


class Path(Struct, frozen=True):
    """The ranges of a sweep, the one in which the scene stands first.

    ``whole`` tells that the first range goes all the way round; ``returns`` that the closures are
    then those of the start again.
    """

    ranges: tuple[Range, ...]
    whole: bool
    returns: bool

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """All pieces, range by range."""
        return tuple(piece for found in self.ranges for piece in found)

    @property
    def spans(self) -> tuple[tuple[float, float], ...]:
        """Where each range begins and ends."""
        return tuple((found[0].low.at, found[-1].high.at) for found in self.ranges)


def reachable_ranges(sweep: Sweep, branches: Branches | None = None) -> Path:
    """The reachable ranges of a sweep, from where the scene stands and with its closures.

    ``branches`` overrides them. Ranges that cannot be reached from there come after it, with the
    same closures picked. Raises ClosureError where nothing closes at all.
    """
    course = Course(sweep, sweep.original.branches if branches is None else branches)
    ranges: list[Range] = []
    refuse_far(sweep)
    if course.closers and (start := beside_touch(course, sweep.stands)) is not None:
        found, whole, returns = from_start(carried_about(course, start), start)
        return shown(sweep, Path((in_numbers(found),), whole, returns))
    course = led(course, sweep.stands, sweep.start)
    count = FEWER if course.closers else GRID
    grid = sweep.low + (np.arange(count) + 0.5) * ((sweep.high - sweep.low) / count)
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
    return shown(sweep, Path(tuple(map(in_numbers, ranges)), whole, returns))


def shown(sweep: Sweep, path: Path) -> Path:
    """The part of a path that lies in the window; raises ClosureError where there is none."""
    if sweep.whole:
        return path
    ranges = tuple(found for found in (within(sweep, each) for each in path.ranges) if found)
    if ranges:
        return replace(path, ranges=ranges)
    spans = [f"{low:.10g} to {high:.10g}" for low, high in path.spans]
    raise ClosureError(
        Problem(
            "--from, --to",
            f"it closes nowhere from {sweep.low:.10g} to {sweep.high:.10g} {sweep.unit}",
            "a window that the driver reaches",
            f"it closes from {', from '.join(spans)} {sweep.unit}",
        )
    )


def within(sweep: Sweep, found: Range) -> Range:
    """The pieces of a range that lie in the window, cut at its ends."""
    pieces = []
    for piece in found:
        low, high = piece.low, piece.high
        low = Event("window", sweep.low) if low.at < sweep.low else low
        high = Event("window", sweep.high) if high.at > sweep.high else high
        if low.at < high.at:
            pieces.append(replace(piece, low=low, high=high))
    return tuple(pieces)


def refuse_far(sweep: Sweep) -> None:
    """A motion is followed from where the scene stands, so far and no farther."""
    ends = min(sweep.low, sweep.start), max(sweep.high, sweep.start)
    ways = (ends[1] - ends[0]) / sweep.usual
    if ways > MOST_WAYS:
        unit = sweep.unit
        most = f"at most {MOST_WAYS * sweep.usual:.6g} {unit}"
        found = f"{sweep.low:.10g} to {sweep.high:.10g} {unit}, followed from {sweep.start:.6g}"
        hint = "give a window that is narrower, or nearer to where the scene stands"
        raise SceneError(Problem("--from, --to", found, most, hint))


def in_numbers(found: Range) -> Range:
    """The pieces of a range, parted where the closure of a group has a new number."""
    pieces = list[Piece]()
    for piece in found:
        if not piece.course.closures:
            pieces.append(piece)
            continue
        parts = numbers_between(piece.course, piece.low.at, piece.high.at)
        starts = [piece.low, *(Event("number", at) for at, _ in parts[1:])]
        ends = [*starts[1:], piece.high]
        courses = (course for _, course in parts)
        pieces += [Piece(*each) for each in zip(starts, ends, courses, strict=True)]
    return tuple(pieces)


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
    low, high, half = found[0].low.at, found[-1].high.at, float(grid[1] - grid[0])
    whole = sweep.what == "turn" and sweep.whole
    turns = [k * TURN for k in range(-2, 3)] if whole else [0.0]
    passed = np.zeros(len(grid), dtype=bool)
    for turn in turns:
        passed |= (low - half <= grid + turn) & (grid + turn <= high + half)
    return passed


def from_start(course: Course, start: float) -> tuple[Range, bool, bool]:
    """The range through one position: its pieces, whether it goes round, and then returns.

    Round about is told from 0 to 360 degrees, or from the last whole turn before a position that
    does not come back. Where wheels stand otherwise after a turn, a dead point may lie turns away.
    """
    sweep = course.sweep
    if not sweep.whole:
        return both_ways(course, start, max(sweep.high, start), min(sweep.low, start)), False, False
    far = MOST_TURNS * TURN if wheels(course) else TURN
    ahead = marched(course, start, start + TURN)
    if ahead[-1].high.kind == "window":
        if dict(ahead[-1].branches) != dict(course.branches):
            return ahead, True, False
        if max(misses(ahead, start, start + TURN).values()) <= BACK:  # wheels need not be back
            return counted_from_nought(ahead, start), True, True
        far = TURN * (turns_back(ahead, start) or MOST_TURNS)
    if ahead[-1].high.kind == marched(course, start, start + far)[-1].high.kind == "window":
        last = TURN * floor(start / TURN)
        found = both_ways(course, start, last + TURN, last)
        goes_round = found[0].low.kind == found[-1].high.kind == "window"
        return (found if goes_round else ahead), True, False
    found = both_ways(course, start, start + far, start - far)
    if found[0].low.at > TURN / 2 and not sweep.scene.near:  # easier to read as one about nought
        return from_start(course, start - TURN)
    return found, False, False


def both_ways(course: Course, start: float, high: float, low: float) -> Range:
    """The pieces about one position, forth and back, each as far as the motion goes."""
    return joined_at(marched(course, start, low), marched(course, start, high))


def joined_at(before: Sequence[Piece], after: Sequence[Piece]) -> Range:
    """Pieces before and after one place, at which the last and the first are one."""
    end, start = before[-1].course.turned, after[0].course
    turned = start.turned if end is None else end.joined(start.turned)
    course = start.along(turned=turned, closures=ways_joined(before[-1].course, start))
    joined = replace(after[0], low=before[-1].low, course=course)
    return (*before[:-1], joined, *after[1:])


def ways_joined(before: Course, after: Course) -> tuple[FollowedClosure, ...]:
    """The ways of groups of higher class on both sides of one place."""
    every = range(len(after.closures))
    turns = [[one.turns for one in after.group(k).trying.unknowns] for k in every]
    ways = zip(before.closures, after.closures, turns, strict=True)
    return tuple(first.joined(second, turning) for first, second, turning in ways)


def wheels(course: Course) -> list[str]:
    """The links whose whole turns count."""
    return [of for what, of in course.program.targets if what == "turned"]


def turns_back(pieces: Range, start: float) -> int | None:
    """After how many turns of the driver wheels would stand as before, by their angles after one.

    None for more than are followed.
    """
    first, last = pieces[0].course, pieces[-1].course
    count = lcm(*(gone(first, last, link, start) for link in wheels(first)))
    return count if count <= MOST_TURNS else None


def gone(first: Course, last: Course, link: str, start: float) -> int:
    """The least number of turns of the driver after which a link would stand as before."""
    axes = [
        course.columns(np.array([at]), [("axis", link)])["axis", link][0]
        for course, at in ((first, start), (last, start + TURN))
    ]
    share = phase(complex(axes[1] / axes[0])) / (2 * pi)
    near = Fraction(share).limit_denominator(MOST_TURNS)
    return near.denominator if abs(float(near) - share) < BACK else MOST_TURNS + 1


def misses(pieces: Range, start: float, stop: float) -> dict[Target, float]:
    """By how much points and links stand otherwise at the end of some pieces than at their start.

    In parts of the mechanism's size, and as the size of the change of a unit axis.
    """
    first, last = pieces[0].course, pieces[-1].course
    targets = [t for t in first.program.targets if t[0] in ("position", "axis")]
    before = first.columns(np.array([start]), targets)
    after = last.columns(np.array([stop]), targets)
    places = np.array([before[t][0] for t in targets if t[0] == "position"])
    size = float(np.abs(places - places.mean()).max())
    units = {"position": size, "axis": 1.0}
    return {t: float(abs(before[t][0] - after[t][0])) / units[t[0]] for t in targets}


def counted_from_nought(pieces: Range, start: float) -> Range:
    """The pieces of a whole turn that comes back, from 0 to 360 degrees instead of the start's."""
    gone = gone_in(pieces, start)
    turns = floor(start / TURN)
    pieces = tuple(turned_back(piece, turns, gone) for piece in pieces)
    before: list[Piece] = []
    after: list[Piece] = []
    for piece in pieces:
        low, high = piece.low, piece.high
        if low.at < TURN - ALIKE < TURN + ALIKE < high.at:
            before.append(replace(piece, high=Event("window", TURN)))
            back = turned_back(piece, 1, gone)
            after.append(replace(back, low=Event("window", 0.0)))
        elif low.at < TURN - ALIKE:
            before.append(piece)
        else:
            after.append(turned_back(piece, 1, gone))
    return joined_at(after, before) if after else pieces


def gone_in(pieces: Range, start: float) -> dict[str, float]:
    """By how many degrees links go in a whole turn after which all stands as before."""
    course = pieces[-1].course
    if course.turned is None:
        return {}
    ends = pieces[0].course.angles(start), course.angles(start + TURN)
    return {link: TURN * round((ends[1][link] - angle) / TURN) for link, angle in ends[0].items()}


def turned_back(piece: Piece, turns: int, gone: dict[str, float]) -> Piece:
    """A piece some turns earlier, after each of which all stands as before."""
    if not turns:
        return piece
    low, high = (
        replace(event, at=max(event.at - turns * TURN, 0.0) if turns > 0 else event.at)
        for event in (piece.low, piece.high)
    )
    turned = piece.course.turned
    if turned is not None:
        turned = turned.moved(-turns * TURN, {link: -turns * by for link, by in gone.items()})
    closures = tuple(way.moved(-turns * TURN) for way in piece.course.closures)
    return Piece(low, high, piece.course.along(turned=turned, closures=closures))


def marched(course: Course, start: float, stop: float) -> Range:
    """The pieces from one position to another, or to the dead point before it, in rising order."""
    forward = stop >= start
    pieces: list[Piece] = []
    here = Event("window", start)
    while len(pieces) < MOST_PIECES:
        course = carried(course, here.at, stop)
        event = next_event(course, here.at, stop)
        low, high = (here, event) if forward else (event, here)
        pieces.append(Piece(low, high, course))
        if event.kind != "change":
            return tuple(pieces) if forward else tuple(reversed(pieces))
        course = beyond(course, event, 1 if forward else -1)
        here = event
    found = f"more than {MOST_PIECES} change points from {start:.6g} to {stop:.6g}"
    raise ClosureError(Problem("the cycle", found, "fewer", "show less with --from and --to"))


def through(pieces: Sequence[Piece]) -> Turned | None:
    """Near which angles links count on the pieces of a range, one after the other.

    None where none counts.
    """
    found: Turned | None = None
    for piece in pieces:
        if (turned := piece.course.turned) is not None:
            part = turned.within(piece.low.at, piece.high.at)
            found = part if found is None else found.joined(part)
    return found
