"""A cycle held to its own velocities: from row to row every point goes as far as these lead it."""

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
"""What positions may be off by rounding, in parts of the mechanism; beside dead points most."""
COARSE = 1e-4
"""A bound in parts of the mechanism above which places between two rows are looked at."""
PARTS = 16
"""Parts into which a step is cut in which a point goes otherwise than its velocities say."""
ROUNDS = 6
"""How often it is cut: a motion that is only fast goes as they say in parts so small."""

MOMENT = 1e-3
"""Steps of the grid in which a change point may leave nothing known."""


class Jump(Struct, frozen=True):
    """Two neighbouring rows between which a point, or a wheel, goes otherwise than its rates say.

    ``low`` and ``high`` are u; ``of`` is the point, or the link of the wheel where it ``turns``;
    ``way`` is how far it goes, ``led`` how far the mean of its rates leads it (m, degrees).
    """

    low: float
    high: float
    of: str
    turns: bool
    way: float
    led: float


class PlacesAndRates(Struct, frozen=True, eq=False):
    """Places with their first and second derivatives by u in SI: (K, N) at ``at`` (N,).

    A wheel is a point of the circle of radius 1. ``size`` (K, 1) is what each is large against.
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
    """What a cycle moves, and how it moves there.

    ``names`` are points and, as axes, the links of wheels that have one point only. Where links
    touch is another point of theirs a moment later, and so is a centre of curvature.
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
        """How they move at some places, those left out that have no motion."""
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
        """How they move at some rows of the cycle, by its own solution where that says all."""
        cycle, at = self.cycle, self.cycle.at[rows]
        driver, values = cycle.sweep.driver, cycle.scene.values
        speed = 1.0 if driver is None else float(driver.speed.si(values))
        push = 0.0 if driver is None else float(driver.acceleration.si(values))
        points = [cycle.solution.points.get(of) for _, of in self.names]
        told: list[list[Any]] = [[getattr(each, kind, None) for kind in KINDS] for each in points]
        if not speed or any(value is None for each in told for value in each):
            return self.between(at)
        whole = cycle.at.shape
        every = np.array([[np.broadcast_to(v, whole)[rows] for v in each] for each in told])
        place, velocity, acceleration = np.moveaxis(every, 1, 0)
        rate = velocity / speed
        return PlacesAndRates(at, place, rate, (acceleration - rate * push) / speed**2, self.size)

    def sized(self, found: PlacesAndRates) -> None:
        """Say how large the mechanism is, by where it stands in all rows."""
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
    """The rows of a whole circle with the first once more, a circle on."""
    found = rows.rows(np.append(np.arange(len(rows.at)), 0))
    at = np.append(rows.at, rows.at[0] + period)
    return PlacesAndRates(at, found.place, found.rate, found.bend, rows.size)


def leaps(followed: CycleTracker, pair: PlacesAndRates, rounds: int = ROUNDS) -> bool:
    """Whether something jumps between two rows: however finely the way is cut, in a part of it.

    A way of which nothing is known is passed, but for the moment in which a closure may change.
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
    """Rows one after the other."""
    at = np.concatenate([each.at for each in parts])
    place, rate, bend = (
        np.concatenate(each, axis=1)
        for each in zip(*((p.place, p.rate, p.bend) for p in parts), strict=True)
    )
    return PlacesAndRates(at, place, rate, bend, parts[0].size)


def missing(rows: PlacesAndRates, unit: float) -> tuple[Any, Any]:
    """By how much each goes otherwise from row to row than half the sum of its rates leads it, and
    how much that may be: (K, N - 1). ``unit`` is what one of u is in SI.

    The trapezoid misses an eighth of the square of the step times the change of the second
    derivative at most: a twelfth where that changes evenly, an eighth where it changes at once. The
    change is the largest of three steps in a row, as within one it may turn back.
    """
    step = np.diff(rows.at) * unit
    led = (rows.rate[:, 1:] + rows.rate[:, :-1]) / 2 * step
    change = np.pad(np.abs(np.diff(rows.bend, axis=1)), ((0, 0), (1, 1)))
    change = np.maximum(np.maximum(change[:, :-2], change[:, 1:-1]), change[:, 2:])
    bound = step**2 / 8 * change + ROUNDED * rows.size
    return np.abs(np.diff(rows.place, axis=1) - led), bound


def jump_at(pair: PlacesAndRates, names: Sequence[tuple[str, str]], unit: float) -> Jump:
    """What jumps farthest between two rows, in parts of its size."""
    missed, _ = missing(pair, unit)
    worst = int((missed / pair.size)[:, 0].argmax())
    what, of = names[worst]
    way = abs(pair.place[worst, 1] - pair.place[worst, 0])
    led = abs(pair.rate[worst].sum()) / 2 * (pair.at[1] - pair.at[0]) * unit
    if what == "axis":
        way, led = np.degrees(2 * np.arcsin(min(way / 2, 1.0))), np.degrees(led)
    return Jump(float(pair.at[0]), float(pair.at[1]), of, what == "axis", float(way), float(led))
