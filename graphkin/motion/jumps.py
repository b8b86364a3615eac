"""Jumps in a cycle: rows between which a point moves otherwise than its velocities say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import EPSILON, KINDS, OMEGA
from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle, columns_at
from graphkin.scene.link_points import is_under

ROUNDED = 1e-7
"""Rounding error of positions, as a share of the mechanism; it is largest near dead points."""
COARSE = 1e-4
"""Bound, as a share of the mechanism, above which positions between two rows are examined."""
PARTS = 16
"""Parts into which a step is cut if a point disagrees with its velocities there."""
ROUNDS = 6
"""Times a step is cut; a motion that is only fast agrees with its velocities in parts so small."""

MOMENT = 1e-3
"""Grid steps near a change point in which nothing may be known."""


class Jump(Struct, frozen=True):
    """Two neighbouring rows between which a point or a wheel disagrees with its rates.

    ``low`` and ``high`` are u. ``of`` is the point, or the link of the wheel where it ``turns``.
    ``way`` is the distance it moves, ``led`` the distance given by the mean of its rates (m,
    degrees).
    """

    low: float
    high: float
    of: str
    turns: bool
    way: float
    led: float


class PlacesAndRates(Struct, frozen=True, eq=False):
    """Positions with their first and second derivatives by u in SI: (K, N) at ``at`` (N,).

    A wheel is represented by a point of the unit circle. ``size`` (K, 1) is the scale of each.
    """

    at: Reals
    place: Any
    rate: Any
    bend: Any
    size: Any

    def rows(self, kept: Any) -> PlacesAndRates:
        """Some of the rows."""
        place, rate, bend = (each[:, kept] for each in (self.place, self.rate, self.bend))
        return PlacesAndRates(self.at[kept], place, rate, bend, self.size)


class CycleTracker:
    """The points and wheels that a cycle moves, and their motion.

    ``names`` are points and, as axes, links of wheels that have only one point. Points where links
    touch and centres of curvature are left out, because they are other points a moment later.
    """

    def __init__(self, cycle: Cycle) -> None:
        self.cycle = cycle
        targets, scene = cycle.path.ranges[0][0].course.program.targets, cycle.scene
        self.names: list[tuple[str, str]] = []
        self.targets: list[Sequence[Target]] = []
        kinds: Mapping[str, Sequence[str]] = {"position": KINDS, "turned": ("axis", OMEGA, EPSILON)}
        for what, of in targets:
            wanted = [(kind, of) for kind in kinds.get(what, ())]
            if what == "position":
                free = not is_under(of) and of not in scene.cam_centres
            else:
                free = of in scene.links and len(scene.links[of].points) < 2
            if wanted and free and targets.keys() >= set(wanted):
                self.names.append((wanted[0][0], of))
                self.targets.append(wanted)
        self.size = np.ones((len(self.names), 1))

    def between(self, at: Reals) -> PlacesAndRates:
        """The motion at some values of u, without those that have no motion."""
        cycle, wanted = self.cycle, [target for each in self.targets for target in each]
        columns = columns_at(cycle.sweep, cycle.path, at, wanted, geometric=True).columns
        found = [[columns[target] for target in each] for each in self.targets]
        place, rate, bend = (np.array(each, complex) for each in zip(*found, strict=True))
        turns = np.array([what == "axis" for what, _ in self.names])
        bend[turns] = (1j * bend - rate**2)[turns] * place[turns]
        rate[turns] = 1j * rate[turns] * place[turns]
        known = np.isfinite(place + rate + bend).all(axis=0)
        return PlacesAndRates(at, place, rate, bend, self.size).rows(known)

    def at_rows(self, rows: Any) -> PlacesAndRates:
        """The motion at some rows of the cycle, from its own solution where that is complete."""
        cycle, at = self.cycle, self.cycle.at[rows]
        driver, values = cycle.sweep.driver, cycle.scene.values
        speed = 1.0 if driver is None else float(driver.speed.si(values))
        push = 0.0 if driver is None else float(driver.acceleration.si(values))
        points = [cycle.solution.points.get(of) for _, of in self.names]
        kept: list[list[Any]] = [[getattr(each, kind, None) for kind in KINDS] for each in points]
        if not speed or any(value is None for each in kept for value in each):
            return self.between(at)
        whole = cycle.at.shape
        every = np.array([[np.broadcast_to(v, whole)[rows] for v in each] for each in kept])
        place, velocity, acceleration = np.moveaxis(every, 1, 0)
        rate = velocity / speed
        return PlacesAndRates(at, place, rate, (acceleration - rate * push) / speed**2, self.size)

    def sized(self, found: PlacesAndRates) -> None:
        """Set the size of the mechanism, from its positions in all rows."""
        points = np.array([what == "position" for what, _ in self.names])
        places = found.place[points]
        self.size[points] = np.abs(places - places.mean()).max(initial=0.0) or 1.0


def jumps(cycle: Cycle) -> tuple[Jump, ...]:
    """The pairs of neighbouring rows between which something jumps, in the order of the rows."""
    followed = CycleTracker(cycle)
    if not followed.names or len(cycle.at) < 2:
        return ()
    followed.sized(followed.at_rows(np.arange(len(cycle.at))))
    found: list[Jump] = []
    first, unit = 1, cycle.sweep.per_unit
    for number, pieces in enumerate(cycle.path.ranges):
        inside = np.flatnonzero((first <= cycle.piece) & (cycle.piece < first + len(pieces)))
        first += len(pieces)
        rows = followed.at_rows(inside[np.argsort(cycle.at[inside], kind="stable")])
        if number == 0 and cycle.path.whole and cycle.path.returns:
            rows = closed_by(rows, cycle.path.period)
        missed, bound = missing(rows, unit)
        doubtful = (missed > bound) | (bound > COARSE * rows.size)
        for k in np.flatnonzero(doubtful.any(axis=0)):
            pair = rows.rows(np.array([k, k + 1]))
            if leaps(followed, pair):
                found.append(jump_at(pair, followed.names, unit))
    return tuple(found)


def closed_by(rows: PlacesAndRates, period: float) -> PlacesAndRates:
    """The rows of a full circle, with the first row repeated one circle later."""
    found = rows.rows(np.append(np.arange(len(rows.at)), 0))
    at = np.append(rows.at, rows.at[0] + period)
    return PlacesAndRates(at, found.place, found.rate, found.bend, rows.size)


def leaps(followed: CycleTracker, pair: PlacesAndRates, rounds: int = ROUNDS) -> bool:
    """Whether something jumps between two rows, however finely the interval is cut.

    An interval without known motion is accepted, if it is longer than the moment of a change point.
    """
    sweep = followed.cycle.sweep
    inner = followed.between(np.linspace(pair.at[0], pair.at[1], PARTS + 1)[1:-1])
    if not len(inner.at):
        return bool(np.ptp(pair.at) < MOMENT * abs(sweep.grid_step))
    here = joined(pair.rows([0]), inner, pair.rows([1]))
    over = np.flatnonzero(np.greater(*missing(here, sweep.per_unit)).any(axis=0))
    if not over.size or rounds == 1:
        return bool(over.size)
    return any(leaps(followed, here.rows([k, k + 1]), rounds - 1) for k in over)


def joined(*parts: PlacesAndRates) -> PlacesAndRates:
    """The rows of several parts, one after another."""
    at = np.concatenate([each.at for each in parts])
    place, rate, bend = (
        np.concatenate(each, axis=1)
        for each in zip(*((p.place, p.rate, p.bend) for p in parts), strict=True)
    )
    return PlacesAndRates(at, place, rate, bend, parts[0].size)


def missing(rows: PlacesAndRates, unit: float) -> tuple[Any, Any]:
    """The deviation of each step from the mean of its rates, and its bound: (K, N - 1).

    ``unit`` is one unit of u in SI. The trapezoidal rule errs by at most an eighth of the squared
    step times the change of the second derivative: a twelfth for an even change, an eighth for a
    sudden one. The change is the largest of three consecutive steps, because it may reverse within
    one.
    """
    step = np.diff(rows.at) * unit
    led = (rows.rate[:, 1:] + rows.rate[:, :-1]) / 2 * step
    change = np.pad(np.abs(np.diff(rows.bend, axis=1)), ((0, 0), (1, 1)))
    change = np.maximum(np.maximum(change[:, :-2], change[:, 1:-1]), change[:, 2:])
    bound = step**2 / 8 * change + ROUNDED * rows.size
    return np.abs(np.diff(rows.place, axis=1) - led), bound


def jump_at(pair: PlacesAndRates, names: Sequence[tuple[str, str]], unit: float) -> Jump:
    """The largest jump between two rows, relative to size."""
    missed, _ = missing(pair, unit)
    worst = int((missed / pair.size)[:, 0].argmax())
    what, of = names[worst]
    way = abs(pair.place[worst, 1] - pair.place[worst, 0])
    led = abs(pair.rate[worst].sum()) / 2 * (pair.at[1] - pair.at[0]) * unit
    if what == "axis":
        way, led = np.degrees(2 * np.arcsin(min(way / 2, 1.0))), np.degrees(led)
    return Jump(float(pair.at[0]), float(pair.at[1]), of, what == "axis", float(way), float(led))
