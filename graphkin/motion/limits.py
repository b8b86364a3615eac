"""How far the followers go: limits of rockers and blocks, swing, stroke and time ratio."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle, columns_at
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import ALIKE, BACK, Piece, Range
from graphkin.motion.refine import crossings_of_nought
from graphkin.scene.model import Closure, Link, Scene
from graphkin.steps.program import Target

FINE = 3600
"""Places in each piece at which the sense of a follower is looked at."""
FEWER = 360
"""The same for groups of higher class, each place of which is a search."""
ENOUGH = 1e-9
"""To how much of u their limits are then found."""
NOTHING = 1e-9
"""Share of the largest speed below which a follower stands still."""
APART = 1e-4
"""How far from a singular place (in degrees, or tenths of mm) a sense of motion is trusted."""


@dataclass(frozen=True, slots=True)
class Limit:
    """Where a follower turns round: u, and its angle (degrees) or coordinate (m) there."""

    at: float
    value: float


@dataclass(frozen=True, slots=True)
class Follower:
    """How far a link swings or a block slides within one range of the driver.

    ``low`` and ``high`` are its extreme places, at a limit or at the end of the range; ``line`` is
    the line (from, to) whose angle is meant; ``full`` tells that a link turns all the way round.
    ``time_ratio`` is the slower over the faster stroke of a driver that turns evenly, where there
    are just two limits in a whole turn.
    """

    name: str
    what: Literal["swing", "stroke"]
    line: tuple[str, str] | None
    limits: tuple[Limit, ...]
    low: Limit
    high: Limit
    full: bool
    time_ratio: float | None

    @property
    def extent(self) -> float:
        """The whole swing (degrees) or stroke (m)."""
        return self.high.value - self.low.value


Value = Callable[[Reals], Reals]


def followers(cycle: Cycle, number: int = 0) -> tuple[Follower, ...]:
    """Every link pinned to the frame, and every block, that no driver moves, in one range.

    ``number`` counts the ranges from 0, the one of the scene.
    """
    found = []
    driven = {driver.link for driver in cycle.scene.drivers}
    targets = cycle.path.ranges[0][0].course.program.targets
    for name, link in cycle.scene.links.items():
        if name in driven:
            continue
        if ("slide", name) in targets and ("slide speed", name) in targets:
            found.append(sliding(cycle, name, number))
        elif (line := swinging_line(cycle.scene, link)) and ("omega", name) in targets:
            found.append(swinging(cycle, name, line, number))
    return tuple(each for each in found if each is not None)


def swinging_line(scene: Scene, link: Link) -> tuple[str, str] | None:
    """The line of a link pinned to the frame, from its fixed pivot to its next point."""
    fixed = next((p for p in link.points if p in scene.frame.points), None)
    if fixed is None or link.slides:
        return None
    other = next((p for p in link.points if p != fixed), None)
    return None if other is None else (fixed, other)


def sliding(cycle: Cycle, name: str, number: int) -> Follower | None:
    """Stroke of a block."""

    def place(at: Reals) -> Reals:
        return values(cycle, at, [("slide", name)])[0]

    def speed(at: Reals) -> Reals:
        return values(cycle, at, [("slide speed", name)], moving=True)[0]

    return follower(cycle, number, name, None, place, speed)


def swinging(cycle: Cycle, name: str, line: tuple[str, str], number: int) -> Follower | None:
    """Swing of a link about its fixed pivot."""

    def angle(at: Reals) -> Reals:
        start, end = values(cycle, at, [("position", point) for point in line])
        return np.asarray(np.degrees(np.unwrap(np.angle(end - start))))

    def speed(at: Reals) -> Reals:
        return values(cycle, at, [("omega", name)], moving=True)[0]

    return follower(cycle, number, name, line, angle, speed)


def values(cycle: Cycle, at: Reals, targets: list[Target], *, moving: bool = False) -> list[Reals]:
    """Targets at places of the path; rates by the driver's position, not beside dead points."""
    found = columns_at(cycle.sweep, cycle.path, at, targets, geometric=moving, near=0.0)
    return [found.columns[target] for target in targets]


def follower(
    cycle: Cycle,
    number: int,
    name: str,
    line: tuple[str, str] | None,
    place: Value,
    speed: Value,
) -> Follower | None:
    """The limits of one follower in one range; None for one that stands still throughout."""
    pieces = cycle.path.ranges[number]
    at = samples(pieces)
    again = whole(cycle, number) and comes_back(cycle, pieces, place, speed)
    past = at[-1] + APART * np.arange(2, 4) if again else at[:0]
    enough = ENOUGH if any(searched(piece) for piece in pieces) else 0.0
    turns = refined(np.append(at, past), speed, enough)
    if again:
        over = turns >= ends(pieces)[1] - ALIKE
        turns = np.sort(np.where(over, np.maximum(turns - TURN, pieces[0].low.at), turns))
    every = np.unique(np.concatenate([ends(pieces), at, turns]))
    where = place(every)
    known = np.isfinite(where)
    every, where = every[known], where[known]
    if not where.size or np.ptp(where) <= NOTHING * max(1.0, float(np.abs(where).max())):
        return None
    if line is not None:
        turned = TURN * np.floor((where.min() + TURN / 2) / TURN)
        where = where - turned
    low, high = (extreme(every, where, turns, sign) for sign in (-1, 1))
    limits = tuple(Limit(float(u), float(where[np.searchsorted(every, u)])) for u in turns)
    around = abs(float(where[-1] - where[0])) > TURN / 2
    full = line is not None and whole(cycle, number) and around
    return Follower(
        name,
        "stroke" if line is None else "swing",
        line,
        limits,
        low,
        high,
        full,
        time_ratio(cycle, limits) if again and not full else None,
    )


def extreme(at: Reals, where: Reals, turns: Reals, sign: int) -> Limit:
    """The highest (sign +1) or lowest place, at a limit where one is as far as any other place."""
    best = int((sign * where).argmax())
    slack = NOTHING * max(float(np.ptp(where)), NOTHING)
    for u in turns:
        k = int(np.searchsorted(at, u))
        if sign * where[k] >= sign * where[best] - slack:
            best = k
            break
    return Limit(float(at[best]), float(where[best]))


def whole(cycle: Cycle, number: int) -> bool:
    """Whether a range goes all the way round."""
    return cycle.path.whole and number == 0


def comes_back(cycle: Cycle, pieces: Range, place: Value, speed: Value) -> bool:
    """Whether a follower stands and moves after a whole turn as before; wheels may not."""
    if cycle.path.returns:
        return True
    both = [np.asarray(value(ends(pieces))) for value in (place, speed)]
    return all(abs(b - a) <= BACK * max(1.0, abs(a), abs(b)) for a, b in both)


def samples(pieces: Range) -> Reals:
    """Places within the pieces of a range, a little away from its singular places."""
    parts = []
    for piece in pieces:
        low, high = piece.low.at, piece.high.at
        low += 0.0 if piece.low.kind == "window" else APART
        high -= 0.0 if piece.high.kind == "window" else APART
        if low < high:
            fine = FEWER if searched(piece) else FINE
            parts.append(np.linspace(low, high, fine + 1))
    return np.concatenate(parts) if parts else np.array([pieces[0].low.at])


def searched(piece: Piece) -> bool:
    """Whether a piece has a group of higher class."""
    return any(isinstance(each, Closure) for each in piece.branches.values())


def ends(pieces: Range) -> Reals:
    """Both ends of a range."""
    return np.array([pieces[0].low.at, pieces[-1].high.at])


def refined(at: Reals, speed: Value, enough: float) -> Reals:
    """Where a speed changes its sense, to the last digits."""
    rate = speed(at)
    most = np.nanmax(np.abs(rate), initial=0.0)
    moving = np.where(np.abs(rate) <= NOTHING * most, 0.0, rate)
    if most <= NOTHING:
        return np.array([])
    kept = np.flatnonzero(np.isfinite(moving) & (moving != 0))
    turned = np.flatnonzero(np.sign(moving[kept[1:]]) != np.sign(moving[kept[:-1]]))
    low, high = at[kept[turned]], at[kept[turned + 1]]
    if not low.size:
        return np.array([])
    found = crossings_of_nought(speed, low, high, enough)
    return np.asarray(found[np.abs(speed(found)) < most])


def time_ratio(cycle: Cycle, limits: tuple[Limit, ...]) -> float | None:
    """Angle of the driver for the slower stroke over that for the faster one."""
    if len(limits) != 2:
        return None
    first = (limits[1].at - limits[0].at) % TURN
    return max(first, TURN - first) / min(first, TURN - first)
