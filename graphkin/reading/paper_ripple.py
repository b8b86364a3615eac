"""What a smooth map leaves of the paper's ripples: how far off lines and crosses of it lie.

Between them it is what a random field with the same length and height would most likely have
(Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, eqs. 2.23, 2.24, 5.12); its
deviation there is the map's.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.drawing.field import AREA

LENGTH = 17.0
"""Over so many mm ripples are alike: their waves are 45 mm long and longer."""
EVERY = 3
"""Of the places of lines, 3 mm apart, so many are one."""
ACROSS, CROSSED = 0.05, 0.04
"""Standard deviations of a line across and of a cross that were measured, in mm."""
LEAST = 0.01
"""Height of a field of ripples at least, in mm."""
STRAY, TRIED = 4.0, 3
"""What lies so many deviations off what all others tell is left out, as often at most."""
PITCH, BEGIN, COUNT = 4.0, (0.0, 0.0), (106, 76)
"""Where the field is kept: places so many mm apart from the sheet's corner on, across and down."""
TOLD = 12.0
"""How far apart the places in the fields are at which its deviation is told, in mm."""


class Ripple(Struct, frozen=True):
    """How far (mm) places of the paper lie off a smooth map, and the deviation in the fields."""

    field: Any
    deviation: float

    def __call__(self, places: Any) -> Any:
        """How far some places (mm) lie off, from the four about each."""
        steps = (places - np.array(BEGIN)) / PITCH
        most = np.array(COUNT) - 1.001
        steps = np.clip(steps, 0, most)
        low = steps.astype(int)
        (x, y), (i, j) = np.moveaxis(steps - low, -1, 0)[..., None], np.moveaxis(low, -1, 0)
        field = self.field
        above = field[j, i] * (1 - x) + field[j, i + 1] * x
        return above * (1 - y) + (field[j + 1, i] * (1 - x) + field[j + 1, i + 1] * x) * y


class Offsets(Struct, frozen=True):
    """How far (mm) places of paper lie off a map along directions, and how well each is known."""

    places: Any
    ways: Any
    off: Any
    errors: Any

    def some(self, which: Any) -> Offsets:
        """Those that are picked."""
        return Offsets(self.places[which], self.ways[which], self.off[which], self.errors[which])


def ripple_of(lines: Offsets, crosses: Offsets) -> Ripple:
    """The ripples that lines and crosses tell, without those that stray from all others."""
    lines = lines.some(slice(None, None, EVERY))
    parts = zip(*((o.places, o.ways, o.off, o.errors) for o in (lines, crosses)), strict=True)
    known = Offsets(*(np.concatenate(part) for part in parts))
    seen = crosses if len(crosses.off) else lines
    height = np.sqrt(max(spread(seen.off) ** 2 - float(np.median(seen.errors**2)), LEAST**2))
    for left in reversed(range(TRIED)):
        inverse = np.linalg.inv(covariance(known, height))
        weights = inverse @ known.off
        alone = np.diag(inverse)
        stray = abs(weights) > STRAY * np.sqrt(alone)
        if not (left and stray.any()):
            break
        known = known.some(~stray)
    xs, ys = (BEGIN[k] + np.arange(COUNT[k]) * PITCH for k in range(2))
    across = likeness(xs[:, None] - known.places[:, 0])
    down = likeness(ys[:, None] - known.places[:, 1])
    field = height**2 * np.stack(
        [(down * (weights * known.ways[:, k])) @ across.T for k in range(2)], axis=-1
    )
    return Ripple(field, deviation(known, inverse, height))


def spread(off: Any) -> float:
    """The standard deviation of offsets, whatever some of them are."""
    return 1.4826 * float(np.median(abs(off))) if len(off) else 0.0


def likeness(apart: Any) -> Any:
    """How alike ripples are so many mm apart along one axis."""
    return np.exp(-((apart / LENGTH) ** 2) / 2)


def covariance(known: Offsets, height: float) -> Any:
    """The covariance of what was measured."""
    (x, y), (u, v) = known.places.T, known.ways.T
    alike = likeness(x[:, None] - x) * likeness(y[:, None] - y)
    return height**2 * alike * (np.outer(u, u) + np.outer(v, v)) + np.diag(known.errors**2)


def deviation(known: Offsets, inverse: Any, height: float) -> float:
    """The standard deviation along each axis that is left of a field, on average of the fields."""
    left, top, right, bottom = AREA
    xs, ys = np.arange(left, right, TOLD), np.arange(top, bottom, TOLD)
    places = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
    x, y = known.places.T
    alike = likeness(places[:, :1] - x) * likeness(places[:, 1:] - y) * height**2
    told = [((alike * way) @ inverse * (alike * way)).sum(axis=1) for way in known.ways.T]
    return float(np.sqrt(np.mean(np.clip(height**2 - np.array(told), 0, None))))
