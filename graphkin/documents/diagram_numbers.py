"""The numbers behind the diagrams of a motion: exact courses, and values at the positions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.documents.positions import PositionSet
from graphkin.motion.course import Reals
from graphkin.motion.cycle import columns_at
from graphkin.motion.driving import stated_motion
from graphkin.motion.follower_limits import Mover, followers, movers_of

FINE = 720
"""Places of an exact course."""
STEP = 1e-3
"""Step of differences for the derivatives in a forecast, as a share of the interval."""
AGREE = 0.02
"""Share of a third derivative within which both of its differences must agree."""
ROUNDED = 1e-6
"""Share of the largest first derivative below which a third derivative is rounding."""
FEWEST = 4
"""The fewest positions with plans from which a diagram is differentiated."""
CALM = 6.0
"""The largest value drawn, in medians of the size; beyond it a rate grows without bound."""


class FollowerMotion(Struct, frozen=True, dict=True):
    """The motion of the follower of the diagrams: its place, speed and acceleration over u.

    ``pace`` is the rate of u in its own unit per second, in rad/s, m/s or 1; ``push`` the rate of
    that. Angles of a link are in radians.
    """

    found: PositionSet
    mover: Mover
    pace: float
    push: float

    @property
    def is_link(self) -> bool:
        """Whether the follower is a link that swings, not a block."""
        return self.mover.line is not None

    @property
    def kinds(self) -> tuple[str, str, str]:
        """The symbols of place, speed and acceleration."""
        return ("ψ", "ω", "ε") if self.is_link else ("s", "v", "a")

    @property
    def at(self) -> Reals:
        """The places u of the numbered positions with plans; a turn ends where it begins."""
        return self.found.planned_places

    @property
    def step(self) -> float:
        """The interval between positions, in rad, m or s, below zero where u falls."""
        return float(self.at[1] - self.at[0]) * self.found.cycle.sweep.per_unit

    def columns(
        self, at: Reals, targets: Sequence[Target], *, geometric: bool = False
    ) -> list[Reals]:
        """Some targets at places u."""
        cycle = self.found.cycle
        found = columns_at(cycle.sweep, cycle.path, at, targets, geometric=geometric).columns
        return [found[target] for target in targets]

    def place(self, at: Reals) -> Reals:
        """The coordinate (m), or the turned angle (rad), at places u in order."""
        cycle = self.found.cycle
        found = columns_at(cycle.sweep, cycle.path, at, self.mover.where, near=0.0).columns
        own = self.mover.place(found)
        return np.radians(own) if self.is_link else np.asarray(own)

    def rates(self, at: Reals) -> list[Reals]:
        """Speed and acceleration in SI at places u."""
        return self.columns(at, self.targets)

    def derivatives(self, at: Reals) -> list[Reals]:
        """The first four derivatives of the place by u, in SI, the last two by differences."""
        away = STEP * self.step / self.found.cycle.sweep.per_unit
        first, second = self.columns(at, self.targets, geometric=True)
        before, after = (
            self.columns(at + side * away, self.targets, geometric=True)[1] for side in (-1, 1)
        )
        wide = STEP * self.step
        return [
            first,
            second,
            (after - before) / (2 * wide),
            (after - 2 * second + before) / wide**2,
        ]

    def third(self, at: Reals) -> Reals:
        """The third derivative of the place by time, in SI, NaN where the acceleration jumps.

        It is the difference of s″, and must agree with the second difference of s′.
        """
        away = STEP * self.step / self.found.cycle.sweep.per_unit
        before, here, after = (
            self.columns(at + side * away, self.targets, geometric=True) for side in (-1, 0, 1)
        )
        wide = STEP * self.step
        by_second = (after[1] - before[1]) / (2 * wide)
        by_first = (after[0] - 2 * here[0] + before[0]) / wide**2
        size = np.nanmax(np.abs(by_second), initial=0.0)
        noise = ROUNDED * np.nanmax(np.abs(here[0]), initial=0.0)
        apart = AGREE * np.maximum(np.abs(by_second), AGREE * size) + noise
        own = np.where(np.abs(by_second - by_first) <= apart, by_second, np.nan)
        own = np.where(np.abs(own) <= noise, 0.0, own)
        return np.asarray(own * self.pace**3 + 3 * self.pace * self.push * here[1])

    def advantage(self, at: Reals) -> Reals:
        """The mechanical advantage: the rate of the driver over that of the follower, without loss.

        For a block and a turning driver it is the force in N that 1 N·m moves.
        """
        with np.errstate(divide="ignore"):
            return np.asarray(np.abs(self.pace / self.rates(at)[0]))

    @property
    def targets(self) -> tuple[Target, Target]:
        """The targets of speed and acceleration."""
        name = self.mover.name
        if self.is_link:
            return (OMEGA, name), (EPSILON, name)
        return ("slide speed", name), ("slide acceleration", name)

    @property
    def is_uniform(self) -> bool:
        """Whether its speed is in proportion to that of the driver, but for rounding."""
        first, second = self.columns(self.fine, self.targets, geometric=True)
        within = abs(self.fine[-1] - self.fine[0]) * self.found.cycle.sweep.per_unit
        change = np.nanmax(np.abs(second), initial=0.0) * within
        return bool(change <= ROUNDED * np.nanmax(np.abs(first), initial=0.0))

    @cached_property
    def fine(self) -> Reals:
        """Many places u from the first position to the last."""
        return np.linspace(self.at[0], self.at[-1], FINE + 1)


def motion_of(found: PositionSet) -> FollowerMotion | None:
    """The follower whose stroke the sheet of positions shows, or the last one that turns fully.

    Of those that turn, one that is not uniform is preferred. None where no link on the frame and no
    block follows, and where the driver is at rest.
    """
    movers = {mover.name: mover for mover in movers_of(found.cycle)}
    some = [found.follower] if found.follower else [*reversed(followers(found.cycle))]
    pace, push, sweep = 1.0, 0.0, found.cycle.sweep
    if sweep.driver is not None:
        _, speed, rise = stated_motion(sweep.driver, sweep.original)
        pace, push = float(speed), float(rise)
    if pace == 0 or len(found.planned_places) < FEWEST:
        return None
    every = [FollowerMotion(found, movers[e.name], pace, push) for e in some if e.name in movers]
    return next((each for each in every if not each.is_uniform), next(iter(every), None))


def calm(found: PositionSet, values: Reals) -> float:
    """The largest size of values that a diagram shows, in which rates may grow without bound."""
    sizes = np.abs(values[np.isfinite(values)])
    most = float(sizes.max(initial=0.0))
    return most if found.is_bounded else min(most, CALM * float(np.median(sizes)))
