"""The cycle sampled for curves: closely everywhere, more closely towards dead points."""

from __future__ import annotations

import numpy as np
from msgspec import Struct

from graphkin.construction.core.solution import Solution
from graphkin.motion.cycle import Cycle
from graphkin.scene.model import Scene
from graphkin.scene.quantity import SI

Reals = np.ndarray[tuple[int], np.dtype[np.float64]]

FINE = 720
"""Places in a piece or a whole turn."""
END = 3e-4
"""Share of a piece that is left out at an end where rates grow without bound."""


class Sampled(Struct, frozen=True, eq=False):
    """The motion at close places u, in rising order within each range.

    ``breaks`` are the numbers of rows before which a new range begins.
    """

    cycle: Cycle
    breaks: tuple[int, ...]

    @property
    def at(self) -> Reals:
        """u of every row."""
        return self.cycle.at

    @property
    def solution(self) -> Solution:
        """The motion in every row, as far as digits are sure."""
        return self.cycle.sure

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self.cycle.scene

    def broken(self, values: np.ndarray) -> np.ndarray:
        """Values with NaN between ranges, so that no line is drawn there."""
        array = np.broadcast_to(np.asarray(values), self.at.shape)
        array = array.astype(complex if np.iscomplexobj(array) else float)
        return np.insert(array, list(self.breaks), np.nan)

    @property
    def title(self) -> str:
        """The title of the scene with its parameters as set."""
        values = self.scene.values
        settings = [
            f"{name} = {float(values[name]):.6g}"
            for name in self.scene.parameters
            if name in values
        ]
        return ", ".join([self.scene.title, *settings])

    @property
    def length_unit(self) -> str:
        """The scene's unit of length."""
        return self.scene.units["length"]

    @property
    def per_length(self) -> float:
        """What turns metres into the scene's unit of length."""
        return 1 / float(SI[self.length_unit][0])


def sampled(cycle: Cycle, fine: int = FINE) -> Sampled:
    """A cycle at places fit for curves."""
    rows, breaks, count = [], [], 0
    for pieces in cycle.path.ranges:
        parts = []
        for piece in pieces:
            low, high = piece.low.at, piece.high.at
            if {piece.low.kind, piece.high.kind} <= {"window", "number"}:
                parts.append(np.linspace(low, high, fine + 1))
                continue
            share = np.linspace(END if piece.low.kind in ("dead", "change") else 0, 1, fine + 1)
            share = share * (1 - END) if piece.high.kind in ("dead", "change") else share
            ease = 0.5 - 0.5 * np.cos(np.pi * share)
            parts.append(low + (high - low) * ease)
        found = np.concatenate(parts)
        if count:
            breaks.append(count)
        rows.append(found)
        count += len(found)
    at = np.concatenate(rows)
    fine_cycle = cycle.along(at)
    if len(fine_cycle.at) != len(at):
        kept = np.isin(at, fine_cycle.at)
        before = np.concatenate([[0], np.cumsum(kept)])
        breaks = [int(before[b]) for b in breaks]
    return Sampled(fine_cycle, tuple(breaks))


def moving_points(scene: Scene, solution: Solution) -> list[str]:
    """The points asked, else all that are neither fixed nor on a driven link alone."""
    asked = dict.fromkeys((*scene.ask.velocity, *scene.ask.acceleration))
    known = [name for name in asked if name in solution.points]
    if known:
        return known
    driven = {driver.link for driver in scene.drivers}
    found = dict.fromkeys(
        point
        for name, link in scene.links.items()
        if name not in driven
        for point in link.points
        if point not in scene.fixed_points and point in solution.points
    )
    return list(found)


def turning_links(scene: Scene, solution: Solution) -> list[str]:
    """The links asked, else all that turn and are not driven evenly."""
    asked = dict.fromkeys((*scene.ask.omega, *scene.ask.epsilon))
    known = [name for name in asked if name in solution.links]
    if known:
        return known
    driven = {driver.link for driver in scene.drivers}
    return [
        name
        for name, motion in solution.links.items()
        if name not in driven and motion.omega is not None and np.any(motion.omega)
    ]
