"""The travel of followers: limits of rockers and blocks, dwells, swing, stroke and time ratio.

The strokes, swings and time ratios that a scene asks for follow from the dead positions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import ceil
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import OMEGA, STROKE, SWING, TIME_RATIO
from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle, columns_at, cycle_at
from graphkin.motion.driving import TURN
from graphkin.motion.ends import crossings_of_zero
from graphkin.motion.pieces import ALIKE, Range, reachable_ranges
from graphkin.motion.sweep import sweep_of
from graphkin.motion.turns_followed import BACK
from graphkin.scene.model import Link, Scene
from graphkin.text.errors import Problem, SceneError, message

if TYPE_CHECKING:
    from graphkin.mechanism import Mechanism

FINE = 3600
"""Positions in each piece, and in each of its turns, at which a follower's sense is examined."""
FEWER = 360
"""FINE for groups of higher class, where each position requires a search."""
ENOUGH = 1e-9
"""Precision, in u, of their limits."""
NOTHING = 1e-9
"""Share of the largest speed below which a follower may be about to reverse."""
REST = 1e-15
"""Share of the largest speed below which a follower is at rest."""
NEAR = 0.1
"""Degrees about a dwell within which a limit counts as the one at the dwell."""
APART = 1e-4
"""Distance (degrees, or 0.1 mm) from singular positions at which a speed's sign is reliable."""


class Limit(Struct, frozen=True):
    """A reversal of a follower: u, and its angle (degrees) or coordinate (m) there.

    ``edge`` means that it does not reverse: the window ends there, and the follower may go further.
    """

    at: float
    value: float
    edge: bool = False


class Dwell(Struct, frozen=True):
    """A rest of a follower while the driver moves: from one u to another, and its value."""

    start: float
    end: float
    value: float


class Follower(Struct, frozen=True):
    """The swing of a link or the stroke of a block within one range of the driver.

    ``low`` and ``high`` are its extreme values, at a limit, a dead point or the edge of a window.
    ``line`` is the line (from, to) whose angle is given. ``full`` means that a link turns all the
    way round. ``rising`` and ``falling`` are the driver angles (degrees, u increasing) from the low
    limit to the high one and back, without ``dwells``. They are set only for two limits in the
    driver's circle.
    """

    name: str
    line: tuple[str, str] | None
    limits: tuple[Limit, ...]
    low: Limit
    high: Limit
    full: bool
    rising: float | None
    falling: float | None = None
    dwells: tuple[Dwell, ...] = ()

    @property
    def strokes(self) -> tuple[float, float] | None:
        """The driver angles of the slower and of the faster stroke."""
        if self.rising is None or self.falling is None:
            return None
        return max(self.rising, self.falling), min(self.rising, self.falling)

    @property
    def time_ratio(self) -> float | None:
        """The slower stroke over the faster, for a driver at constant speed."""
        return None if self.strokes is None else self.strokes[0] / self.strokes[1]

    @property
    def extent(self) -> float:
        """The total swing (degrees) or stroke (m)."""
        return self.high.value - self.low.value


class Mover(Struct, frozen=True):
    """A link or block whose travel is examined: its line, and targets of its position and speed."""

    name: str
    line: tuple[str, str] | None
    where: tuple[Target, ...]
    speed: Target

    def place(self, columns: Mapping[Target, Reals]) -> Reals:
        """The angle of its line (degrees), or its coordinate (m), from the columns of ``where``."""
        if self.line is None:
            return columns[self.where[0]]
        start, end = (columns[target] for target in self.where)
        return np.asarray(np.degrees(np.unwrap(np.angle(end - start))))


def followers(cycle: Cycle, number: int = 0) -> tuple[Follower, ...]:
    """The travel, in one range, of the links pinned to the frame and of the blocks, if not driven.

    ``number`` counts the ranges from 0, the range of the scene. All followers are run together, so
    that many take as many constructions as one.
    """
    movers = tuple(movers_of(cycle))
    if not movers:
        return ()
    pieces = cycle.path.ranges[number]
    at = samples(pieces)
    again = coming_back(cycle, movers, number)
    enough = ENOUGH if any(piece.course.is_searched for piece in pieces) else 0.0
    rates = values(cycle, at, [mover.speed for mover in movers], moving=True)
    turns = turning_places(cycle, movers, at, rates, again, enough)
    rests = [resting(cycle, each, at, rates[each.speed], enough) for each in movers]
    for n, closed in enumerate(again):
        if closed:
            over = turns[n] >= ends(pieces)[1] - ALIKE
            begun = np.maximum(turns[n] - circle(cycle), pieces[0].low.at)
            turns[n] = np.sort(np.where(over, begun, turns[n]))
    own = [np.unique([*turns[n], *np.ravel(rests[n])]) for n in range(len(movers))]
    every = np.unique(np.concatenate([ends(pieces), at, *own]))
    columns = values(cycle, every, [target for mover in movers for target in mover.where])
    found = []
    for n, mover in enumerate(movers):
        rows = np.searchsorted(every, np.unique(np.concatenate([ends(pieces), at, own[n]])))
        where = mover.place({target: columns[target][rows] for target in mover.where})
        places = every[rows], where
        found.append(follower(cycle, number, mover, places, turns[n], rests[n], again[n]))
    return tuple(each for each in found if each is not None)


def circle(cycle: Cycle) -> float:
    """The degrees of the driver after which everything recurs."""
    return cycle.path.period or TURN


def movers_of(cycle: Cycle) -> Iterator[Mover]:
    """The links pinned to the frame, and the blocks, that no driver moves.

    Links that stand for the contact of a wheel or a cam are no followers.
    """
    scene = cycle.scene
    left_out = {driver.link for driver in scene.drivers} | scene.unseen
    left_out |= {cam.link for cam in scene.cams.values()}
    targets = cycle.path.ranges[0][0].course.program.targets
    for name, link in cycle.scene.links.items():
        if name in left_out:
            continue
        if ("slide", name) in targets and ("slide speed", name) in targets:
            yield Mover(name, None, (("slide", name),), ("slide speed", name))
        elif (line := swinging_line(cycle.scene, link)) and (OMEGA, name) in targets:
            start, end = line
            yield Mover(name, line, (("position", start), ("position", end)), (OMEGA, name))


def swinging_line(scene: Scene, link: Link) -> tuple[str, str] | None:
    """The line of a link pinned to the frame, from its fixed pivot to its next point."""
    fixed = next((p for p in link.points if p in scene.fixed_points), None)
    if fixed is None or link.slides:
        return None
    other = next((p for p in link.points if p != fixed), None)
    return None if other is None else (fixed, other)


def values(
    cycle: Cycle, at: Reals, targets: Sequence[Target], *, moving: bool = False
) -> Mapping[Target, Reals]:
    """Targets at positions of the path, dead points included; rates are by u."""
    return columns_at(cycle.sweep, cycle.path, at, targets, geometric=moving, near=0.0).columns


def follower(
    cycle: Cycle,
    number: int,
    mover: Mover,
    places: tuple[Reals, Reals],
    turns: Reals,
    rests: Sequence[tuple[float, float]],
    again: bool,
) -> Follower | None:
    """The travel of one follower, from its ``places`` by u, ``turns`` and ``rests``.

    ``again`` means that the follower recurs after the driver's circle. None for a follower at rest.
    """
    name, line = mover.name, mover.line
    every, where = places
    known = np.isfinite(where)
    every, where = every[known], where[known]
    if not where.size or np.ptp(where) <= NOTHING * max(1.0, float(np.abs(where).max())):
        return None
    if line is not None:
        turned = TURN * np.floor((where.min() + TURN / 2) / TURN)
        where = where - turned
    edges = () if again else edges_of(cycle.path.ranges[number])
    low, high = (extreme(every, where, turns, edges, sign) for sign in (-1, 1))
    limits = tuple(Limit(float(u), float(where[np.searchsorted(every, u)])) for u in turns)
    dwells = tuple(Dwell(*rest, float(where[np.searchsorted(every, rest[0])])) for rest in rests)
    around = abs(float(where[-1] - where[0])) > TURN / 2
    full = line is not None and whole(cycle, number) and around
    strokes: tuple[float | None, float | None] = None, None
    if again and not full and len(limits) == 2:
        left = [left_at(limit.at, dwells) for limit in (low, high)]
        strokes = (high.at - left[0]) % circle(cycle), (low.at - left[1]) % circle(cycle)
    return Follower(name, line, limits, low, high, full, *strokes, dwells)


def left_at(at: float, dwells: Sequence[Dwell]) -> float:
    """The u at which a follower leaves a limit: the end of a dwell there, or the limit."""
    near = (each.end for each in dwells if each.start - NEAR <= at <= each.end + NEAR)
    return next(near, at)


def edges_of(pieces: Range) -> tuple[float, ...]:
    """The ends of a range at which only the window ends, not the motion."""
    both = pieces[0].low, pieces[-1].high
    return tuple(event.at for event in both if event.kind == "window")


def extreme(at: Reals, where: Reals, turns: Reals, edges: Sequence[float], sign: int) -> Limit:
    """The highest (sign +1) or lowest value; at a limit, if that is equal to any other value."""
    best = int((sign * where).argmax())
    slack = NOTHING * max(float(np.ptp(where)), NOTHING)
    for u in turns:
        k = int(np.searchsorted(at, u))
        if sign * where[k] >= sign * where[best] - slack:
            return Limit(float(at[k]), float(where[k]))
    return Limit(float(at[best]), float(where[best]), float(at[best]) in edges)


def whole(cycle: Cycle, number: int) -> bool:
    """Whether a range goes all the way round."""
    return cycle.path.whole and number == 0


def coming_back(cycle: Cycle, movers: Sequence[Mover], number: int) -> list[bool]:
    """Which followers recur, in position and speed, after the driver's circle; wheels may not."""
    if cycle.path.returns or not whole(cycle, number):
        return [whole(cycle, number) for _ in movers]
    bounds = ends(cycle.path.ranges[number])
    columns = values(cycle, bounds, [target for mover in movers for target in mover.where])
    speeds = values(cycle, bounds, [mover.speed for mover in movers], moving=True)
    both = [(mover.place(columns), speeds[mover.speed]) for mover in movers]
    return [
        all(abs(b - a) <= BACK * max(1.0, abs(a), abs(b)) for a, b in (place, speed))
        for place, speed in both
    ]


def samples(pieces: Range) -> Reals:
    """Positions within the pieces of a range, at a small distance from singular ones."""
    parts = []
    for piece in pieces:
        low, high = piece.low.at, piece.high.at
        low += 0.0 if piece.low.kind == "window" else APART
        high -= 0.0 if piece.high.kind == "window" else APART
        if low < high:
            turns = max(ceil((high - low) / TURN), 1) if piece.course.sweep.what == "turn" else 1
            fine = (FEWER if piece.course.is_searched else FINE) * turns
            parts.append(np.linspace(low, high, fine + 1))
    return np.concatenate(parts) if parts else np.array([pieces[0].low.at])


def ends(pieces: Range) -> Reals:
    return np.array([pieces[0].low.at, pieces[-1].high.at])


def turning_places(
    cycle: Cycle,
    movers: Sequence[Mover],
    at: Reals,
    rates: Mapping[Target, Reals],
    again: Sequence[bool],
    enough: float,
) -> list[Reals]:
    """The reversals of each follower; those ``again`` are examined round the circle.

    ``rates`` are their speeds at the positions. The brackets of all followers are halved together.
    """
    targets = [mover.speed for mover in movers]
    most, brackets = [], []
    for target, closed in zip(targets, again, strict=True):
        most.append(float(np.nanmax(np.abs(rates[target]), initial=0.0)))
        brackets.append(changing(at, rates[target], most[-1], circle(cycle) if closed else 0.0))
    owner = np.repeat(np.arange(len(movers)), [len(low) for low, _ in brackets])

    def speed(u: Reals) -> Reals:
        within = np.where(u > at[-1], np.maximum(u - circle(cycle), at[0]), u) if any(again) else u
        every = values(cycle, within, targets, moving=True)
        return np.array([every[targets[n]][k] for k, n in enumerate(owner)])

    if not owner.size:
        return [at[:0] for _ in movers]
    low, high = (np.concatenate(side) for side in zip(*brackets, strict=True))
    found = crossings_of_zero(speed, low, high, enough)
    sure = np.abs(speed(found)) < np.array(most)[owner]
    return [found[sure & (owner == n)] for n in range(len(movers))]


def resting(
    cycle: Cycle, mover: Mover, at: Reals, rate: Reals, enough: float
) -> list[tuple[float, float]]:
    """The intervals in which a follower is at rest.

    For a driver that turns fully, the last interval may end in the next circle.
    """
    most = float(np.nanmax(np.abs(rate), initial=0.0))
    if most <= NOTHING:
        return []

    def moves(speed: Reals) -> Reals:
        return np.where(np.abs(speed) > REST * most, 1.0, -1.0)

    still = np.concatenate([[False], np.isfinite(rate) & (moves(rate) < 0), [False]])
    first = np.flatnonzero(still[1:-1] & ~still[:-2])
    last = np.flatnonzero(still[1:-1] & ~still[2:])
    first, last = first[first < last], last[first < last]
    inner = np.append(first[first > 0], last[last < len(at) - 1])
    outer = np.append(first[first > 0] - 1, last[last < len(at) - 1] + 1)
    place = at.copy()
    if inner.size:
        speed = mover.speed
        place[inner] = crossings_of_zero(
            lambda u: moves(values(cycle, u, [speed], moving=True)[speed]),
            np.minimum(at[inner], at[outer]),
            np.maximum(at[inner], at[outer]),
            max(enough, ENOUGH),
        )
    rests = list(zip(place[first].tolist(), place[last].tolist(), strict=True))
    if cycle.path.returns and len(rests) > 1 and first[0] == 0 and last[-1] == len(at) - 1:
        (_, end), *rests, (start, _) = rests
        rests.append((start, end + circle(cycle)))
    return rests


def changing(at: Reals, rate: Reals, most: float, after: float) -> tuple[Reals, Reals]:
    """The brackets (low, high) in which a speed of at ``most`` that size changes its sign.

    ``after`` is the circle after which the speed recurs, or 0.
    """
    if most <= NOTHING:
        return at[:0], at[:0]
    moving = np.where(np.abs(rate) <= NOTHING * most, 0.0, rate)
    kept = np.flatnonzero(np.isfinite(moving) & (moving != 0))
    places, signs = at[kept], np.sign(moving[kept])
    if after and kept.size:
        places, signs = np.append(places, places[0] + after), np.append(signs, signs[0])
    turned = np.flatnonzero(signs[1:] != signs[:-1])
    return places[turned], places[turned + 1]


# --- what a scene asks for of followers, from the dead positions ----------------------------------


class Travel(Struct, frozen=True):
    """What one request gives: its value, the follower, and the mechanism at both dead positions.

    A stroke is in m, a swing in degrees; the time ratio is the slower stroke over the faster.
    """

    value: float
    follower: Follower
    ends: tuple[Mechanism, Mechanism]


def travels(mechanism: Mechanism) -> Mapping[Target, Travel]:
    """The travel of each follower that [ask] names, over the range of the scene.

    Raises SceneError for all links that do not move to and fro or have no time ratio.
    """
    ask = mechanism.scene.ask
    if not (ask.strokes or ask.time_ratios):
        return {}
    moved = whole_motion(mechanism)
    known = {each.name: each for each in followers(moved) if is_to_and_fro(each)}
    found: dict[Target, Travel] = {}
    problems: list[Problem] = []
    for place, names in (("strokes", ask.strokes), ("time_ratios", ask.time_ratios)):
        for i, name in enumerate(names):
            own = known.get(name)
            if own is None:
                wrong = message("link {name} does not move to and fro", name=name)
                wanted = message("a block, or a link on the frame that swings")
                problems.append(Problem(f"ask.{place}[{i}]", wrong, wanted))
            elif place == "strokes":
                quantity = STROKE if own.line is None else SWING
                found[quantity.target, name] = Travel(own.extent, own, ends_of(moved, own))
            elif own.time_ratio is None:
                wrong = message("link {name} has no time ratio", name=name)
                wanted = message("a driver that turns fully, and one stroke each way in its turn")
                problems.append(Problem(f"ask.{place}[{i}]", wrong, wanted))
            else:
                ratio = Travel(own.time_ratio, own, ends_of(moved, own))
                found[TIME_RATIO.target, name] = ratio
    if problems:
        raise SceneError(problems)
    return found


def whole_motion(mechanism: Mechanism) -> Cycle:
    """The motion over the range of the scene, with one row in its middle."""
    sweep = sweep_of(mechanism.scene)
    path = reachable_ranges(sweep)
    return cycle_at(mechanism, sweep, path, np.array([sum(path.spans[0]) / 2]), ())


def is_to_and_fro(travel: Follower) -> bool:
    """Whether a follower moves to and fro: a block, or a link that never turns fully."""
    return not travel.full and (travel.line is None or travel.extent < TURN)


def ends_of(moved: Cycle, travel: Follower) -> tuple[Mechanism, Mechanism]:
    """The mechanism at the low and at the high limit of a follower."""
    low, high = (moved.mechanism_at(limit.at) for limit in (travel.low, travel.high))
    return low, high
