"""A sweep split where the motion ends or may change its closure; each piece has constant signs.

A cycle is followed in both directions from the scene's position, from one change point to the next.

The motion beyond a change point: it takes the closure that its velocity predicts.

Neither the nearest position nor the same side would be correct.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from math import ceil, floor, isfinite

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import KINDS
from graphkin.construction.higher_class.following import FollowedClosure
from graphkin.motion.closures_followed import carried, carried_about, numbers_between
from graphkin.motion.course import Branches, Course, Reals
from graphkin.motion.driving import GRID, TURN, reach_of
from graphkin.motion.ends import Event, next_event
from graphkin.motion.sweep import Sweep, Turned
from graphkin.motion.turns_followed import (
    BACK,
    MOST_TURNS,
    TooManyPositionsError,
    led,
    led_round,
    misses,
    turns_after,
    turns_back,
    wheels,
)
from graphkin.scene.link_points import is_under
from graphkin.scene.model import Branch, Closure, Side
from graphkin.text.errors import ClosureError, GraphkinError, SceneError, joined, message

MOST_BEYOND = 8
"""The most closures of a higher-class group that are tried beyond a change point."""
AHEAD = 0.25
"""Grid steps on each side of a change point between which the motion is predicted."""


def beyond(course: Course, event: Event, way: int) -> Course:
    """The course past a change point: the closures whose positions the velocity predicts.

    Each closure that depends on a touching step is tried both ways, a numbered one by its numbers.
    """
    step = AHEAD * abs(course.sweep.grid_step)
    before, after = event.at - way * step, event.at + way * step
    targets = followed(course)
    predicted = predict(course, before, after)
    best, least = course, np.inf
    for branches in choices(course, event):
        other = replace(course, branches=branches, here=after)
        try:
            found = other.columns(np.array([after]), targets)
        except GraphkinError:  # an idle link that does not fit this closure
            continue
        miss = max(abs(complex(found[t][0]) - predicted[t]) for t in targets)
        if miss < least:
            best, least = other, miss
    return best


def followed(course: Course) -> list[Target]:
    """The position targets of points of links.

    Contact points are left out: a moment later they are other points of the links, and they have no
    velocity of their own.
    """
    targets = course.program.targets
    own = [(what, of) for what, of in targets if what == "position" and not is_under(of)]
    return [(what, of) for what, of in own if ("velocity", of) in targets]


def predict(course: Course, before: float, after: float) -> Mapping[Target, complex]:
    """The predicted position of every point, from its position, velocity and acceleration by u."""
    way = (after - before) * course.sweep.per_unit
    targets = course.program.targets
    names = [of for _, of in followed(course)]
    wanted = [(what, of) for what in KINDS for of in names if (what, of) in targets]
    found = course.columns(np.array([before]), wanted, geometric=True)
    return {
        ("position", of): sum(
            complex(found[what, of][0]) * factor
            for what, factor in zip(KINDS, (1.0, way, way * way / 2), strict=True)
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
        return [replace(branch, side=-branch.side)]
    if isinstance(branch, Closure):
        numbers = range(1, MOST_BEYOND + 1)
        return [Closure(number) for number in numbers if number != branch.number]
    return [replace(branch, way=-branch.way)]


ALIKE = 1e-8
"""Degrees within which two positions count as one."""
BESIDE = 1e-3
"""Sine of a crossing below which a change point may lie within a step of the grid."""
SAME = 1e-9
"""Relative difference of two sines that counts as rounding."""
MOST_PIECES = 400
"""The most pieces into which change points may divide a range."""
MOST_CLOSURES = 4
"""Periods of the wheels after which closures swapped at change points may have swapped back."""
FEWER = 360
"""Positions of a sweep at which closures of a higher-class group are searched for.

This search serves a group that does not close where the scene is drawn.
"""
FEWEST = 72
"""FEWER where several links are tried at once, because each search then costs a hundredfold."""
COARSE = 1 / 12
"""The longest step, in turns, where it is only asked whether a motion ends."""
MOST_WAYS = 200
"""The most turns, or slide lengths, over which a motion is followed."""


class Piece(Struct, frozen=True):
    """A part of a sweep, low to high, with constant signs, and the event at each end."""

    low: Event
    high: Event
    course: Course

    @property
    def branches(self) -> Branches:
        """The closures selected on this piece, as [branches] states them."""
        return self.course.branches

    def holds(self, at: Reals) -> np.ndarray:
        """Which u lie within the piece, ends included."""
        return (self.low.at <= at) & (at <= self.high.at)


Range = tuple[Piece, ...]
"""Pieces that join at change points, between two dead points or all the way round."""


class Path(Struct, frozen=True):
    """The ranges of a sweep; the range that contains the scene's position is the first.

    ``whole`` means that the first range goes all the way round. ``returns`` means that the
    mechanism then has its initial position again. ``turns`` is the number of whole driver turns
    after which the same ranges recur: the driver's circle. It is 0 for a window, and where few
    turns do not bring the wheels back. ``searched`` is the number of positions at which a group of
    higher class was searched for ranges, 0 where none was.
    """

    ranges: tuple[Range, ...]
    whole: bool
    returns: bool
    turns: int = 0
    searched: int = 0

    @property
    def pieces(self) -> tuple[Piece, ...]:
        return tuple(piece for found in self.ranges for piece in found)

    @property
    def spans(self) -> tuple[tuple[float, float], ...]:
        """The start and end of each range."""
        return tuple((found[0].low.at, found[-1].high.at) for found in self.ranges)

    @property
    def period(self) -> float:
        """The driver's circle in degrees; 0 without one."""
        return self.turns * TURN

    def shifts(self, at: Reals | float) -> list[float]:
        """The shifts round the circle that bring positions onto the ranges, smallest first."""
        if not self.turns or not np.size(at):
            return [0.0]
        low, high = min(low for low, _ in self.spans), max(high for _, high in self.spans)
        first = floor((low - float(np.max(at))) / self.period)
        last = ceil((high - float(np.min(at))) / self.period)
        return sorted((k * self.period for k in range(first, last + 1)), key=abs)

    def found_at(self, at: float, low: float, high: float) -> float:
        """A position shifted round the circle to between two others, or unshifted."""
        every = (at + shift for shift in self.shifts(at))
        return next((place for place in every if low <= place <= high), at)


def range_about(sweep: Sweep, at: float | None = None) -> Path | None:
    """The range of a mechanism with followed closures that contains a given u, or the scene's.

    The closures have no numbers along it. None where nothing closes in that position.
    """
    course = Course(sweep, sweep.original.branches)
    start = beside_touch(course, sweep.at_scene if at is None else at)
    if start is None:
        return None
    turns = turns_back(led(course, sweep.at_scene, sweep.start), sweep.start) if sweep.whole else 0
    return from_start(carried_about(course, start), start, turns)


def reachable_ranges(sweep: Sweep, branches: Branches | None = None) -> Path:
    """The reachable ranges of a sweep, from the scene's position and with its closures.

    ``branches`` overrides the closures. Ranges that the motion cannot reach from there follow, with
    the same closures selected. For a driver that turns, the whole circle is examined: as many turns
    as bring the wheels back. Raises ClosureError where the mechanism closes nowhere.
    """
    course = Course(sweep, sweep.original.branches if branches is None else branches)
    refuse_far(sweep)
    near = led(course, sweep.at_scene, sweep.start)
    turns = turns_back(near, sweep.start) if sweep.whole else 0
    if course.closers and (start := beside_touch(course, sweep.at_scene)) is not None:
        return shown(sweep, from_start(carried_about(course, start), start, turns))
    course = led_round(near, sweep.start, sweep.start + turns * TURN) if turns > 1 else near
    start = beside_touch(course, sweep.start)
    first = Path((), False, False, turns)
    if start is not None:
        first = from_start(course, start, turns)
        if first.whole:
            return shown(sweep, first)
    ranges = [*first.ranges, *others(course, first)]
    if not ranges:
        raise ClosureError.at(
            message("the cycle"),
            message("it closes for no position of the driver"),
            message("lengths that can be assembled"),
            message("graphkin check shows what is wrong"),
        )
    searched = positions_searched(course, first) if course.closers else 0
    return shown(sweep, replace(first, ranges=tuple(ranges), searched=searched))


def others(course: Course, first: Path) -> list[Range]:
    """The ranges that the motion does not reach from the scene's position, in order."""
    sweep, count = course.sweep, positions_searched(course, first)
    step = (sweep.high - sweep.low) * max(first.turns, 1) / count
    grid = sweep.low + (np.arange(count) + 0.5) * step
    free = course.closes(grid)
    for found in first.ranges:
        free &= ~covered(first, found, grid)
    ranges: list[Range] = []
    while free.any():
        path = from_start(course, seed(grid, free), first.turns)
        ranges += path.ranges
        here = covered(first, path.ranges[0], grid)
        if path.whole or not (free & here).any():
            break
        free &= ~here
    return sorted(ranges, key=lambda found: found[0].low.at) if first.turns else ranges


def positions_searched(course: Course, first: Path) -> int:
    """The number of positions at which other ranges are sought."""
    each = (FEWEST if course.tries_several else FEWER) if course.closers else GRID
    return each * max(first.turns, 1)


def shown(sweep: Sweep, path: Path) -> Path:
    """The part of a path that lies in the window, with its closures numbered.

    A slide that nothing stops is shown as far to each side as the mechanism is large, without a
    stated window. Raises ClosureError where no part lies there.
    """
    if sweep.whole:
        return replace(path, ranges=tuple(map(in_numbers, path.ranges)))
    reach = reach_of(sweep.original) if sweep.is_length else 0.0
    far = reach if sweep.stated else min(reach, extent(path.ranges[0], sweep.start) or reach)
    found = (within(sweep, each, 2 * reach, far) for each in path.ranges)
    ranges = tuple(in_numbers(each) for each in found if each)
    if ranges:
        return replace(path, ranges=ranges)
    spans = joined(
        ", ",
        (message("from {low:.10g} to {high:.10g}", low=low, high=high) for low, high in path.spans),
    )
    raise ClosureError.at(
        "--from, --to",
        message(
            "it closes nowhere from {low:.10g} to {high:.10g} {unit}",
            low=sweep.low,
            high=sweep.high,
            unit=sweep.unit,
        ),
        message("a window that the driver reaches"),
        message("it closes {spans} {unit}", spans=spans, unit=sweep.unit),
    )


def within(sweep: Sweep, found: Range, enough: float, far: float) -> Range:
    """The pieces of a range that lie in the window, cut at its ends.

    Where nothing stops a slide ``enough`` from its start, nothing stops it at all. Such an end is
    cut ``far`` from the start, unless the window is stated.
    """
    low, high = (
        Event("window", at, free=bool(enough) and abs(at - sweep.start) >= enough)
        for at in (sweep.low, sweep.high)
    )
    if low.free and not sweep.stated and found[0].low.at <= low.at:
        low = replace(low, at=sweep.start - far)
    if high.free and not sweep.stated and found[-1].high.at >= high.at:
        high = replace(high, at=sweep.start + far)
    pieces = []
    for piece in found:
        first = low if is_beyond(piece.low, low.at - piece.low.at) else piece.low
        last = high if is_beyond(piece.high, piece.high.at - high.at) else piece.high
        if first.at < last.at:
            pieces.append(replace(piece, low=first, high=last))
    return tuple(pieces)


def is_beyond(end: Event, by: float) -> bool:
    """Whether an end lies beyond that of the window, or is this end."""
    return by > 0 or (by == 0 and end.kind == "window")


def extent(found: Range, start: float) -> float:
    """How far apart the points of a mechanism are (m), at the place of a range nearest a start."""
    piece = next((each for each in found if each.holds(np.array(start))), found[0])
    at = np.array([min(max(start, piece.low.at), piece.high.at)])
    targets = piece.course.program.targets
    wanted = [(what, of) for what, of in targets if what == "position" and not is_under(of)]
    places = np.array([place[0] for place in piece.course.columns(at, wanted).values()])
    return float(np.nanmax(np.abs(places[:, None] - places[None, :]), initial=0.0))


def refuse_far(sweep: Sweep) -> None:
    """Raise SceneError if the window is too far to follow the motion from the scene's position."""
    ends = min(sweep.low, sweep.start), max(sweep.high, sweep.start)
    ways = (ends[1] - ends[0]) / sweep.usual
    if ways > MOST_WAYS:
        unit = sweep.unit
        most = message("at most {most:.6g} {unit}", most=MOST_WAYS * sweep.usual, unit=unit)
        found = message(
            "{low:.10g} to {high:.10g} {unit}, followed from {start:.6g}",
            low=sweep.low,
            high=sweep.high,
            unit=unit,
            start=sweep.start,
        )
        hint = message("give a window that is narrower, or nearer to the position of the scene")
        raise SceneError.at("--from, --to", found, most, hint)


def in_numbers(found: Range) -> Range:
    """The pieces of a range, split where the closure of a group gets a new number."""
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
    """The start, moved by half a grid step where loci almost touch; None where nothing closes.

    The move goes to the side on which the start lies, because the scene's closures hold there.
    """
    half = course.sweep.grid_step / 2
    here, ahead, behind = course.margins(start + half * np.array([0, 1, -1])).T
    if np.isfinite(here).all() and here.min() > BESIDE:
        return start
    for side, sines, others in ((half, ahead, behind), (-half, behind, ahead)):
        if np.isfinite(sines).all() and not sines.min() < (1 - SAME) * others.min():
            return start + side
    return start if np.isfinite(here).all() else None


def seed(grid: Reals, free: np.ndarray) -> float:
    """The middle of the first run of positions that are not yet covered."""
    first = int(np.argmax(free))
    after = np.flatnonzero(~free[first:])
    last = first + (int(after[0]) if after.size else len(free) - first) - 1
    return float((grid[first] + grid[last]) / 2)


def covered(path: Path, found: Range, grid: Reals) -> np.ndarray:
    """Which grid positions lie in a range, round the driver's circle."""
    low, high, half = found[0].low.at, found[-1].high.at, float(grid[1] - grid[0])
    passed = np.zeros(len(grid), dtype=bool)
    for shift in replace(path, ranges=(found,)).shifts(grid):
        passed |= (low - half <= grid + shift) & (grid + shift <= high + half)
    return passed


def from_start(course: Course, start: float, turns: int) -> Path:
    """The range through one position; ``turns`` of the driver bring the wheels back.

    A motion that comes back is given from 0 degrees to the end of its circle. A motion that goes on
    without coming back is given for one turn, from the last whole turn before the position. Where
    the wheels' period is unknown, a dead point may lie many turns away. With a group of higher
    class, it is sought there only where the followed closure ends; the other side is given for one
    turn.
    """
    sweep = course.sweep
    if not sweep.whole:
        found = both_ways(course, start, max(sweep.high, start), min(sweep.low, start))
        return Path((found,), False, False)
    first = max(turns, 1)
    far = (turns or MOST_TURNS) * TURN if wheels(course) else TURN
    ahead = marched(course, start, start + first * TURN)
    if goes_on(ahead):
        for count in counts(ahead, course, start, first):
            way = ahead if count == first else marched(course, start, start + count * TURN)
            if comes_back(way, course, start, start + count * TURN):
                return Path((counted_from_zero(way, start, count * TURN),), True, True, count)
    on, back = (far if turns or ends_within(course, start, way) else TURN for way in (far, -far))
    if goes_on(ahead) and on >= back and goes_on(marched(course, start, start + on)):
        last = TURN * floor(start / TURN)
        found = both_ways(course, start, last + TURN, last)
        if found[0].low.kind != "window" or not goes_on(found):
            found = marched(course, start, start + TURN)
        return Path((found,), True, False)
    found = both_ways(course, start, start + on, start - back)
    period = turns * TURN
    gone = gone_in(course, course, sweep.start, period)
    return Path((about_zero(found, period, gone),), False, False, turns)


def ends_within(course: Course, start: float, way: float) -> bool:
    """Whether a motion may end within a way from one u, as far as followed closures show.

    Without a group of higher class it may: each position is cheap.
    """
    if not course.closers or abs(way) <= TURN:
        return True
    closures = carried(course, start, start + way, COARSE).closures
    return any(each.lost(np.array([start + way]))[0] for each in closures)


def goes_on(found: Range) -> bool:
    """Whether no dead point ends a motion."""
    return found[-1].high.kind == "window"


def counts(ahead: Range, course: Course, start: float, turns: int) -> list[int]:
    """The numbers of turns after which a motion, followed through ``turns``, may come back."""
    found = list[int]()
    if dict(ahead[-1].branches) == dict(course.branches):
        found = [turns * turns_after(ahead[0].course, start, ahead[-1].course, turns)]
    if not found:
        found = [turns * count for count in range(2, MOST_CLOSURES + 1)]
    return [count for count in found if 0 < count <= MOST_TURNS]


def comes_back(found: Range, course: Course, start: float, stop: float) -> bool:
    """Whether the motion reaches ``stop`` and everything is there as at ``start``."""
    if not goes_on(found) or dict(found[-1].branches) != dict(course.branches):
        return False
    return max(misses(found[0].course, start, found[-1].course, stop).values()) <= BACK


def about_zero(found: Range, period: float, gone: dict[str, float]) -> Range:
    """A range between dead points, shifted round the driver's circle to contain 0.

    If it cannot contain 0, it is shifted so that it begins nearest to 0.
    """
    if not period:
        return found
    low, high = found[0].low.at, found[-1].high.at
    turns = floor(high / period)
    if turns * period <= low:  # |the range does not contain the start of the circle
        turns = ceil(low / period - 0.5)
    return tuple(turned_back(piece, turns, period, gone) for piece in found)


def both_ways(course: Course, start: float, high: float, low: float) -> Range:
    """The pieces about one position in both directions, as far as the motion goes."""
    return joined_at(marched(course, start, low), marched(course, start, high))


def joined_at(before: Sequence[Piece], after: Sequence[Piece]) -> Range:
    """Pieces before and after one position, with the two pieces at that position merged."""
    end, start = before[-1].course.turned, after[0].course
    turned = start.turned if end is None else end.joined(start.turned)
    course = start.along(turned=turned, closures=ways_joined(before[-1].course, start))
    joined = replace(after[0], low=before[-1].low, course=course)
    return (*before[:-1], joined, *after[1:])


def ways_joined(before: Course, after: Course) -> tuple[FollowedClosure, ...]:
    """The followed closures of higher-class groups, joined from both sides of one position."""
    every = range(len(after.closures))
    turns = [[one.turns for one in after.group(k).trying.unknowns] for k in every]
    ways = zip(before.closures, after.closures, turns, strict=True)
    return tuple(first.joined(second, turning) for first, second, turning in ways)


def counted_from_zero(pieces: Range, start: float, period: float) -> Range:
    """The pieces of a recurring circle, rearranged to run from 0 degrees to the circle's end."""
    gone = gone_in(pieces[0].course, pieces[-1].course, start, period)
    turns = floor(start / period)
    pieces = tuple(turned_back(piece, turns, period, gone) for piece in pieces)
    before: list[Piece] = []
    after: list[Piece] = []
    for piece in pieces:
        low, high = piece.low, piece.high
        if low.at < period - ALIKE < period + ALIKE < high.at:
            before.append(replace(piece, high=Event("window", period)))
            back = turned_back(piece, 1, period, gone)
            after.append(replace(back, low=Event("window", 0.0)))
        elif low.at < period - ALIKE:
            before.append(piece)
        else:
            back = turned_back(piece, 1, period, gone)
            after.append(replace(back, low=replace(back.low, at=max(back.low.at, 0.0))))
    return joined_at(after, before) if after else pieces


def gone_in(first: Course, last: Course, start: float, period: float) -> dict[str, float]:
    """By how many degrees each link turns in one circle of the driver, in whole turns."""
    if last.turned is None:
        return {}
    before, after = first.angles(start), last.angles(start + period)
    way = {link: after[link] - angle for link, angle in before.items()}
    return {link: TURN * round(each / TURN) if isfinite(each) else 0 for link, each in way.items()}


def turned_back(piece: Piece, turns: int, period: float, gone: dict[str, float]) -> Piece:
    """A piece shifted back by some circles of the driver, each of which restores all positions."""
    if not turns:
        return piece
    by = turns * period
    turned = piece.course.turned
    if turned is not None:
        turned = turned.moved(-by, {link: -turns * way for link, way in gone.items()})
    closures = tuple(way.moved(-by) for way in piece.course.closures)
    low, high = (replace(event, at=event.at - by) for event in (piece.low, piece.high))
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
    found = message(
        "more than {most} change points from {start:.6g} to {stop:.6g}",
        most=MOST_PIECES,
        start=start,
        stop=stop,
    )
    raise TooManyPositionsError.at(
        message("the cycle"), found, message("fewer"), message("show less with --from and --to")
    )


def strangers(path: Path) -> tuple[str, ...]:
    """The links that differ after a whole turn of the driver, in the order written."""
    pieces = path.ranges[0]
    first, start = pieces[0], pieces[0].low.at
    last = next((p for p in pieces if p.low.at <= start + TURN <= p.high.at), pieces[-1])
    missed = misses(first.course, start, last.course, start + TURN)
    links = first.course.scene.links
    return tuple(link for link in links if missed.get(("axis", link), 0.0) > BACK)


def through(pieces: Sequence[Piece]) -> Turned | None:
    """The angles near which links are counted on the pieces of a range, joined in order.

    None where no link is counted.
    """
    found: Turned | None = None
    for piece in pieces:
        if (turned := piece.course.turned) is not None:
            part = turned.within(piece.low.at, piece.high.at)
            found = part if found is None else found.joined(part)
    return found
