"""Dead points and change points: where a motion ends or may change its closure.

At a dead point the sine of a crossing falls to zero like a square root, and nothing closes beyond.
At a change point the sine touches zero. Its square is smooth at both, and continues below zero.

Root finding for the ends, contacts and reversals of a motion, to the last digit, vectorised.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from msgspec import Struct

from graphkin.motion.course import Course, Reals, closing_columns
from graphkin.motion.driving import GRID
from graphkin.numbers.plane import Line

HALVINGS = 70
"""Halvings after which the ends of a grid bracket are neighbouring doubles."""
CUT = 16
"""Parts into which the interval up to the last closing position is cut at once."""
AROUND = np.array([-4.5, -3.5, -2.5, -1.5, 1.5, 2.5, 3.5, 4.5])
"""Sample offsets, in steps, of a squared margin about a place where it may touch zero."""
BESIDE = (0.25, 0.75)
"""Shares at which a bracket is cut if the function is NaN in its middle."""
TOUCH = 1e-12
"""Square of a sine that counts as zero: it is rounding, or a gap too narrow to pass."""


def last_closing(closes: Callable[[Reals], Any], inside: float, outside: float) -> float:
    """The last u that closes, between one that closes and one that does not.

    The interval is cut into parts, all tried at once, until no double lies between.
    """
    for _ in range(HALVINGS):
        between = np.unique(np.linspace(inside, outside, CUT + 1)[1:-1])
        between = between[(between != inside) & (between != outside)]
        if not between.size:
            break
        between = between if outside > inside else between[::-1]
        failing = np.flatnonzero(~np.asarray(closes(between), dtype=bool))
        first = int(failing[0]) if failing.size else len(between)
        inside = float(between[first - 1]) if first else inside
        outside = float(between[first]) if first < len(between) else outside
    return inside


def crossings_of_zero(
    value: Callable[[Reals], Reals], low: Reals, high: Reals, enough: float = 0.0
) -> Reals:
    """The sign change of a function in each bracket, by halving, all brackets at once.

    ``value`` takes u (N,) and returns the function of bracket i at u[i]. Brackets narrower than
    ``enough`` are left alone. If the function is NaN in the middle, the bracket is cut to either
    side of it. If it is NaN there, too, the bracket's lower end is returned, where it is known.
    """
    at_low = value(low)
    blind = np.zeros(len(low), dtype=bool)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        wide = (middle != low) & (middle != high) & (high - low >= enough) & ~blind
        if not wide.any():
            break
        found = value(middle)
        for share in BESIDE:
            if not (unknown := wide & np.isnan(found)).any():
                break
            middle = np.where(unknown, low + share * (high - low), middle)
            found = np.where(unknown, value(middle), found)
        blind |= wide & np.isnan(found)
        same = np.sign(found) == np.sign(at_low)
        wide &= ~blind
        low, high = np.where(wide & same, middle, low), np.where(wide & ~same, middle, high)
    return np.where(blind, low, (low + high) / 2)


def least_square(offsets: Reals, margins: Reals) -> tuple[float, float] | None:
    """The minimum of a squared margin near zero and its place, from samples around it.

    The square is smooth where the margin has a corner, and continues below zero where nothing
    closes. None where it has no minimum among the samples.
    """
    if not np.isfinite(margins).all():
        return None
    square = np.polynomial.Polynomial.fit(offsets, margins**2, len(offsets) - 1)
    roots = square.deriv().roots()
    near = [float(r.real) for r in roots if abs(r.imag) < 1e-6 and abs(r.real) < abs(offsets).max()]
    if not near:
        return None
    best = min(near, key=lambda r: float(square(r)))
    return best, float(square(best))


def touching(offsets: Reals, margins: Reals) -> float | None:
    """The place where a margin touches zero, or None.

    With its sign reversed beyond that place, the margin is smooth.
    """
    signed = np.polynomial.Polynomial.fit(offsets, np.sign(offsets) * margins, len(offsets) - 1)
    roots = [float(r.real) for r in signed.roots() if abs(r.imag) < 1e-9]
    inside = [r for r in roots if abs(r) < 1.5]
    return min(inside, key=abs) if inside else None


End = Literal["dead", "change", "number", "window", "flat"]
SUSPECT = 0.3
"""Sine of a crossing below which a minimum is examined."""
OPEN = 0.01
"""Sine of a crossing above which it does not touch zero, whatever the samples predict.

Where a cam's law changes its acceleration suddenly, the centre of curvature jumps.
"""
WIDE = 3
"""Grid steps between the samples that locate a change point."""
FEWEST = 64
"""The fewest positions at which events are searched for in a window."""
WITHIN = 4
"""Grid steps by which the parts of a long interval overlap."""
PAST = 2
"""Positions beyond the end of a window that are examined."""
BESIDE_FOLD = 1e-6
"""Distance before a group's end at which closing is checked, as a share of a grid step."""
BESIDE_END = 4e-10
"""Distance beyond such an end at which failures are checked, as a share of the usual sweep."""
SOUGHT = 16 * TOUCH
"""TOUCH for closed groups of higher class, whose sines come from differences."""
NARROW = 2
"""The most consecutive grid positions that do not close at a single change point."""


class Event(Struct, frozen=True):
    """The end of a piece: a dead or change point, with the steps whose loci touch there.

    At a ``number`` the closure continues smoothly under another number. A ``flat`` event lies
    within a group whose closure is followed; the motion continues, and no piece ends. ``beyond``
    is, for a dead point, a u at which nothing closes. ``free``: nothing stops the driver beyond
    this end of the window.
    """

    kind: End
    at: float
    steps: tuple[int, ...] = ()
    beyond: float | None = None
    free: bool = False


def next_event(course: Course, start: float, stop: float) -> Event:
    """The first dead point or change point before ``stop``; the window's end if there is none.

    A long interval is searched in parts that overlap a little.
    """
    step = course.sweep.grid_step
    here, way = start, 1.0 if stop > start else -1.0
    while abs(stop - here) > 1.5 * GRID * step:
        middle = here + way * GRID * step
        event = event_between(course, here, middle)
        if event.kind != "window":
            return event
        here = middle - way * WITHIN * step
    return event_between(course, here, stop)


def event_between(course: Course, start: float, stop: float) -> Event:
    """The first dead point or change point in a short interval, or its end if there is none.

    In a window the search extends a little past the end, because a change point shows from both
    sides.
    """
    if start == stop:
        return Event("window", stop)
    step = course.sweep.grid_step
    least = 1 if course.sweep.whole else FEWEST
    count = max(int(np.ceil(abs(stop - start) / step)), least)
    grid = np.linspace(start, stop, count + 1)
    each, step = (stop - start) / count, min(step, abs(stop - start) / count)
    if not course.sweep.whole:
        grid = np.append(grid, stop + each * np.arange(1, PAST + 1))
    margins = course.margins(grid)
    margins[:, 0] = np.where(np.isfinite(margins[:, 0]), margins[:, 0], 0.0)
    closed = closing_columns(margins)
    closed[0] = True
    end = first_end(course, grid, closed)
    last = len(grid) if end is None else end + 1
    for k in suspects(margins[:, :last], closed[:last]):
        event = looked_at(course, grid, k)
        if event is None or event.kind == "flat":
            continue
        if abs(event.at - start) > 0.01 * step:
            return event if abs(event.at - start) <= abs(stop - start) else Event("window", stop)
    if end is None or abs(grid[end] - start) >= abs(stop - start):
        return Event("window", stop)
    return dead(course, float(grid[end]), float(grid[end + 1]))


def first_end(course: Course, grid: Reals, closed: np.ndarray) -> int | None:
    """The last grid position that closes before a dead point; change points are passed.

    A short gap with closing positions on both sides is left to ``suspects``.
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
    """Whether loci only touch at a grid position that does not close."""
    event = looked_at(course, grid, k)
    return event is not None and event.kind in ("change", "flat")


def suspects(margins: Reals, closed: np.ndarray) -> list[int]:
    """Grid positions near which a crossing may touch zero, in order."""
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
    """The event near a grid position: a change point, a narrow gap, or None."""
    step = float(grid[1] - grid[0])
    centre = float(grid[k])
    touch = SOUGHT if course.closures else TOUCH
    inner = course.within_groups if course.closures else frozenset[int]()
    known: dict[int, tuple[float, float]] = {}
    for _ in range(2):
        samples = course.margins(centre + AROUND * step)[:-1]
        lows = {n: least_square(AROUND, row) for n, row in enumerate(samples)}
        known = {n: low for n, low in lows.items() if low is not None and low[1] < touch}
        if not known:
            return None
        known = {n: low for n, low in known.items() if course.crossings[n] not in inner}
        if not known:  # the followed closure knows its own end
            return Event("flat", centre)
        first = min(known, key=lambda n: known[n][1])
        centre += known[first][0] * step
    if course.margins(np.array([centre]))[first, 0] > OPEN:
        return None
    if known[first][1] < -touch:
        return dead(course, centre - 2 * step, centre)
    at = centre + touch_of(course, centre, step, first)
    steps = tuple(course.crossings[n] for n in sorted(known))
    if runs_away(course, steps[0], at - step):
        return Event("dead", at, steps, at)
    return Event("change", at, steps)


def touch_of(course: Course, centre: float, step: float, row: int) -> float:
    """The offset at which a margin touches zero, from distant samples with more certain digits."""
    for wide in (WIDE * step, step):
        samples = course.margins(centre + AROUND * wide)[row]
        shift = touching(AROUND, samples) if np.isfinite(samples).all() else None
        if shift is not None:
            return shift * wide
    return 0.0


def runs_away(course: Course, number: int, at: float) -> bool:
    """Whether a step crosses two straight lines, which meet at infinity when parallel."""
    loci = course.loci(number, at)
    return len(loci) == 2 and all(isinstance(locus, Line) for locus in loci)


def just_before(at: float, inside: float) -> Reals:
    """A u just before another, on the side of ``inside``."""
    return np.array([at + (inside - at) * BESIDE_FOLD])


def dead(course: Course, inside: float, outside: float) -> Event:
    """The dead point between a position that closes and one that does not."""
    for each in course.closures:
        end = each.end_between(min(inside, outside), max(inside, outside))
        if end is None or not course.closes(just_before(end[0], inside))[0]:
            continue
        at, kind = end
        way = 1.0 if outside > inside else -1.0
        beyond = at + way * BESIDE_END * course.sweep.usual
        steps = () if kind == "fold" else before_groups(course, beyond)
        return Event("dead", at, steps, beyond)
    last = last_closing(course.closes, inside, outside)
    way = 1.0 if outside > inside else -1.0
    past = last + way * max(1e-9 * course.sweep.grid_step, 8 * float(np.spacing(abs(last))))
    last = last_closing(course.is_placed, last, past)
    return Event("dead", last, tuple(failing(course, past)[:1]), past)


def failing(course: Course, at: float) -> list[int]:
    """The crossings that do not exist at a given u, in order."""
    lost = ~np.isfinite(course.margins(np.array([at]))[:-1, 0])
    return [course.crossings[n] for n in np.flatnonzero(lost)]


def before_groups(course: Course, at: float) -> tuple[int, ...]:
    """The first crossing that fails at a given u, if it precedes all groups of higher class."""
    return tuple(n for n in failing(course, at)[:1] if n < course.closers[0])
