"""How far the followers go: limits of rockers and blocks, swing, stroke and time ratio."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import OMEGA
from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle, columns_at
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import ALIKE, BACK, Range
from graphkin.motion.refine import crossings_of_nought
from graphkin.scene.model import Link, Scene

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


class Limit(Struct, frozen=True):
    """Where a follower turns round: u, and its angle (degrees) or coordinate (m) there."""

    at: float
    value: float


class Follower(Struct, frozen=True):
    """How far a link swings or a block slides within one range of the driver.

    ``low`` and ``high`` are its extreme places, at a limit or at the end of the range; ``line`` is
    the line (from, to) whose angle is meant; ``full`` tells that a link turns all the way round.
    ``rising`` is the angle (degrees, u growing) that the driver takes from the low to the high
    limit, where there are just two in a whole turn.
    """

    name: str
    line: tuple[str, str] | None
    limits: tuple[Limit, ...]
    low: Limit
    high: Limit
    full: bool
    rising: float | None

    @property
    def time_ratio(self) -> float | None:
        """The slower over the faster stroke of a driver that turns evenly."""
        if self.rising is None:
            return None
        strokes = self.rising, TURN - self.rising
        return max(strokes) / min(strokes)

    @property
    def extent(self) -> float:
        """The whole swing (degrees) or stroke (m)."""
        return self.high.value - self.low.value


class Mover(Struct, frozen=True):
    """A link or block whose way is asked: its line, and the targets of its place and its speed."""

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
    """Every link pinned to the frame, and every block, that no driver moves, in one range.

    ``number`` counts the ranges from 0, the one of the scene. All followers are run together, so
    that the mechanism is constructed as often for many as for one.
    """
    movers = tuple(movers_of(cycle))
    if not movers:
        return ()
    pieces = cycle.path.ranges[number]
    at = samples(pieces)
    again = coming_back(cycle, movers, number)
    enough = ENOUGH if any(piece.course.is_searched for piece in pieces) else 0.0
    past = at[-1] + APART * np.arange(2, 4) if any(again) else at[:0]
    turns = turning_places(cycle, movers, np.append(at, past), at[-1], again, enough)
    for n, closed in enumerate(again):
        if closed:
            over = turns[n] >= ends(pieces)[1] - ALIKE
            begun = np.maximum(turns[n] - TURN, pieces[0].low.at)
            turns[n] = np.sort(np.where(over, begun, turns[n]))
    every = np.unique(np.concatenate([ends(pieces), at, *turns]))
    columns = values(cycle, every, [target for mover in movers for target in mover.where])
    found = []
    for mover, own, closed in zip(movers, turns, again, strict=True):
        rows = np.searchsorted(every, np.unique(np.concatenate([ends(pieces), at, own])))
        where = mover.place({target: columns[target][rows] for target in mover.where})
        found.append(follower(cycle, number, mover, every[rows], where, own, closed))
    return tuple(each for each in found if each is not None)


def movers_of(cycle: Cycle) -> Iterator[Mover]:
    """Every link pinned to the frame, and every block, that no driver moves."""
    driven = {driver.link for driver in cycle.scene.drivers}
    targets = cycle.path.ranges[0][0].course.program.targets
    for name, link in cycle.scene.links.items():
        if name in driven:
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
    """Targets at places of the path; rates by the driver's position, not beside dead points."""
    return columns_at(cycle.sweep, cycle.path, at, targets, geometric=moving, near=0.0).columns


def follower(
    cycle: Cycle,
    number: int,
    mover: Mover,
    every: Reals,
    where: Reals,
    turns: Reals,
    again: bool,
) -> Follower | None:
    """How far one follower goes, by its places ``where`` at ``every`` u, the ``turns`` among them.

    ``again`` tells that it comes back after a whole turn. None for one that stands still.
    """
    name, line = mover.name, mover.line
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
        line,
        limits,
        low,
        high,
        full,
        (high.at - low.at) % TURN if again and not full and len(limits) == 2 else None,
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


def coming_back(cycle: Cycle, movers: Sequence[Mover], number: int) -> list[bool]:
    """Which followers stand and move after a whole turn as before; wheels may not."""
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
    """Places within the pieces of a range, a little away from its singular places."""
    parts = []
    for piece in pieces:
        low, high = piece.low.at, piece.high.at
        low += 0.0 if piece.low.kind == "window" else APART
        high -= 0.0 if piece.high.kind == "window" else APART
        if low < high:
            fine = FEWER if piece.course.is_searched else FINE
            parts.append(np.linspace(low, high, fine + 1))
    return np.concatenate(parts) if parts else np.array([pieces[0].low.at])


def ends(pieces: Range) -> Reals:
    """Both ends of a range."""
    return np.array([pieces[0].low.at, pieces[-1].high.at])


def turning_places(
    cycle: Cycle,
    movers: Sequence[Mover],
    at: Reals,
    last: float,
    again: Sequence[bool],
    enough: float,
) -> list[Reals]:
    """Where the speed of each follower changes its sense; after ``last`` only of those ``again``.

    The brackets of all followers are halved together.
    """
    targets = [mover.speed for mover in movers]
    rates = values(cycle, at, targets, moving=True)
    inside = at <= last
    most, brackets = [], []
    for target, closed in zip(targets, again, strict=True):
        rows = np.flatnonzero(inside | closed)
        most.append(float(np.nanmax(np.abs(rates[target][rows]), initial=0.0)))
        brackets.append(changing(at[rows], rates[target][rows], most[-1]))
    owner = np.repeat(np.arange(len(movers)), [len(low) for low, _ in brackets])

    def speed(u: Reals) -> Reals:
        every = values(cycle, u, targets, moving=True)
        return np.array([every[targets[n]][k] for k, n in enumerate(owner)])

    if not owner.size:
        return [at[:0] for _ in movers]
    low, high = (np.concatenate(side) for side in zip(*brackets, strict=True))
    found = crossings_of_nought(speed, low, high, enough)
    sure = np.abs(speed(found)) < np.array(most)[owner]
    return [found[sure & (owner == n)] for n in range(len(movers))]


def changing(at: Reals, rate: Reals, most: float) -> tuple[Reals, Reals]:
    """The brackets (low, high) in which a speed of at ``most`` so much changes its sense."""
    if most <= NOTHING:
        return at[:0], at[:0]
    moving = np.where(np.abs(rate) <= NOTHING * most, 0.0, rate)
    kept = np.flatnonzero(np.isfinite(moving) & (moving != 0))
    turned = np.flatnonzero(np.sign(moving[kept[1:]]) != np.sign(moving[kept[:-1]]))
    return at[kept[turned]], at[kept[turned + 1]]
