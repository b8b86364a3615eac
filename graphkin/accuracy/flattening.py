"""Errors while a crossing grows flat: the driver runs towards a dead point, and digits are lost.

An error of position is counted in the largest distance L of two points, one of velocity in the
largest speed v there, one of acceleration in v²/L, what the fastest point would have on a circle
as large as the mechanism. So counted they grow as 1/s, 1/s² and 1/s³ with the sine s of crossing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from msgspec import Struct

from graphkin.accuracy.compared_answers import ComparedTargets, Reference, reference_of, rows_of
from graphkin.accuracy.compared_positions import Approach
from graphkin.accuracy.methods import batch_work
from graphkin.motion.course import Reals

LAW = (-1.0, -2.0, -3.0)
"""The slopes of the three errors."""
UNIT = {"float64": 2.0**-52, "float32": 2.0**-23}
"""Relative distance of neighbouring numbers of each kind."""
TAKES_HOLD = 0.2
"""Sine of crossing from which the law is seen."""
ABOVE = 10.0
"""A slope is measured down to so many times the root of the unit, where nothing is left."""
FALLEN = 0.1
"""A crossing whose sine falls to less than so much of its largest grows flat."""
LOST = 0.1
"""An error from which it is no longer one of rounding, but an answer lost."""


class Flattening(Struct, frozen=True, eq=False):
    """Errors (G, 3) in groups of equal sines (G,), by kind of number; NaN where a kind fails.

    ``reference`` are the positions. ``roots`` (G,) are the roots of the distances from the end, in
    parts of the farthest: at a dead point a sine falls as they do.
    """

    approach: Approach
    reference: Reference
    sines: Reals
    roots: Reals
    errors: Mapping[str, Reals]

    @property
    def falls(self) -> bool:
        """Whether the flattest crossing really grows flat at the end.

        A group of higher class may reach its dead point without that.
        """
        return bool(self.sines.min() < FALLEN * self.sines.max())

    @property
    def measure(self) -> Reals:
        """Against what errors are shown and slopes measured: the sine, or else the root (G,)."""
        return self.sines if self.falls else self.roots

    def slopes(self, kind: str) -> tuple[float | None, ...]:
        """The slope of each error of a kind over the sine, in logarithms; None where unknown."""
        least = ABOVE * UNIT[kind] ** 0.5
        return tuple(slope(self.measure, self.errors[kind][:, n], least) for n in range(3))


def flattened(approach: Approach, answers: ComparedTargets) -> Flattening:
    """The errors of doubles and of single precision on the way to a dead point."""
    reference = reference_of(approach.places, answers)
    group = np.asarray(approach.group)[list(reference.kept)]
    program, count = approach.places.course.program, len(reference.places.at)
    values = reference.places.repeated(count)
    errors = {}
    for kind in UNIT:
        columns = batch_work(program, answers.every, values, kind, "steps")()
        missed = reference.missed(rows_of(columns, count))
        errors[kind] = in_groups(missed / units_of(reference.sizes), group)
    sines = in_groups(reference.sines[:, None], group, np.median)[:, 0]
    roots = in_groups(roots_of(approach, reference)[:, None], group, np.median)[:, 0]
    return Flattening(approach, reference, sines, roots, errors)


def roots_of(approach: Approach, reference: Reference) -> Reals:
    """The root of each position's distance from the end, in parts of the farthest; 1 without."""
    if approach.goal is None:
        return np.ones(len(reference.places.at))
    far = np.abs(approach.places.at - approach.goal)
    return np.asarray(np.sqrt(far[list(reference.kept)] / far.max()))


def units_of(sizes: Reals) -> Reals:
    """Largest distance L, largest speed v, and v²/L of each position, (P, 3)."""
    length, speed = sizes[:, 0], sizes[:, 1]
    units = np.stack([length, speed, speed**2 / np.where(length > 0, length, 1)], axis=1)
    return np.where(units > 0, units, 1.0)


def in_groups(rows: Reals, group: Reals, of: Callable[..., Reals] = np.max) -> Reals:
    """One row for each group: the largest, or what else is made of its rows."""
    return np.array([of(rows[group == each], axis=0) for each in np.unique(group)])


def slope(sines: Reals, errors: Reals, least: float) -> float | None:
    """The slope of errors over sines above the least, in logarithms; None for too few."""
    sure = (sines > least) & (sines < TAKES_HOLD) & (errors > 0) & (errors < LOST)
    if np.count_nonzero(sure) < 4 or np.ptp(np.log10(sines[sure])) < 1:
        return None
    return float(np.polyfit(np.log10(sines[sure]), np.log10(errors[sure]), 1)[0])
