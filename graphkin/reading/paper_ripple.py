"""The paper's ripples: the offsets of printed lines and crosses that a smooth map leaves.

Between the measured places the ripple is the most likely value of a Gaussian random field with the
same length scale and height (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006,
eqs. 2.23, 2.24, 5.12). The field's standard deviation is that of the map.
"""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.drawing.field import A3, SheetPaper

LENGTH = 17.0
"""Length scale of the ripples, in mm: their waves are 45 mm long and longer."""
EVERY = 3
"""Only one in so many places of lines is used; the places are 3 mm apart."""
ACROSS, CROSSED = 0.05, 0.04
"""Standard deviations of a measured line, across it, and of a measured cross, in mm."""
LEAST = 0.01
"""Least height of a field of ripples, in mm."""
STRAY, TRIED = 4.0, 3
"""A measurement this many deviations from its prediction is dropped; the most rounds of this."""
PITCH = 4.0
"""Spacing of the grid of the field in mm; the grid begins at the corner of the sheet."""
SPACING = 12.0
"""Spacing in mm of the places in the fields at which the deviation is averaged."""


class Ripple(Struct, frozen=True):
    """Offsets (mm) of places of paper from a smooth map, and the deviation in the fields."""

    field: Any
    deviation: float

    def __call__(self, places: Any) -> Any:
        """Offsets of some places (mm), interpolated between the four nearest grid places."""
        steps = places / PITCH
        most = np.array(self.field.shape[1::-1]) - 1.001
        steps = np.clip(steps, 0, most)
        low = steps.astype(int)
        (x, y), (i, j) = np.moveaxis(steps - low, -1, 0)[..., None], np.moveaxis(low, -1, 0)
        field = self.field
        above = field[j, i] * (1 - x) + field[j, i + 1] * x
        return above * (1 - y) + (field[j + 1, i] * (1 - x) + field[j + 1, i + 1] * x) * y


class Offsets(Struct, frozen=True):
    """Offsets (mm) of places of paper from a map along directions, and the error of each."""

    places: Any
    ways: Any
    off: Any
    errors: Any

    def some(self, which: Any) -> Offsets:
        return Offsets(self.places[which], self.ways[which], self.off[which], self.errors[which])


def ripple_of(lines: Offsets, crosses: Offsets, paper: SheetPaper = A3) -> Ripple:
    """The ripples measured by lines and crosses, without outliers."""
    lines = lines.some(slice(None, None, EVERY))
    parts = zip(*((o.places, o.ways, o.off, o.errors) for o in (lines, crosses)), strict=True)
    known = Offsets(*(np.concatenate(part) for part in parts))
    seen = crosses if len(crosses.off) else lines
    height = np.sqrt(max(spread(seen.off) ** 2 - float(np.median(seen.errors**2)), LEAST**2))
    inverse = np.linalg.inv(covariance(known, height))
    for left in reversed(range(TRIED)):
        weights = inverse @ known.off
        alone = np.diag(inverse)
        stray = abs(weights) > STRAY * np.sqrt(alone)
        if not (left and stray.any()):
            break
        known, inverse = known.some(~stray), without(inverse, stray)
    xs, ys = (np.arange(ceil(side / PITCH) + 1) * PITCH for side in (paper.width, paper.height))
    across = likeness(xs[:, None] - known.places[:, 0])
    down = likeness(ys[:, None] - known.places[:, 1])
    field = height**2 * np.stack(
        [(down * (weights * known.ways[:, k])) @ across.T for k in range(2)], axis=-1
    )
    return Ripple(field, deviation(known, inverse, height, paper))


def without(inverse: Any, some: Any) -> Any:
    """The inverse of a matrix without some of its rows and columns, from the inverse of the whole.

    Horn and Johnson, Matrix Analysis, 2nd ed. 2013, section 0.7.3.
    """
    beside = inverse[np.ix_(~some, some)]
    return inverse[np.ix_(~some, ~some)] - beside @ np.linalg.solve(
        inverse[np.ix_(some, some)], beside.T
    )


def spread(off: Any) -> float:
    """The standard deviation of offsets, from their median, so that outliers do not matter."""
    return 1.4826 * float(np.median(abs(off))) if len(off) else 0.0


def likeness(apart: Any) -> Any:
    """The correlation of ripples a given distance in mm apart along one axis."""
    return np.exp(-((apart / LENGTH) ** 2) / 2)


def covariance(known: Offsets, height: float) -> Any:
    """The covariance of the measurements."""
    (x, y), (u, v) = known.places.T, known.ways.T
    alike = likeness(x[:, None] - x) * likeness(y[:, None] - y)
    return height**2 * alike * (np.outer(u, u) + np.outer(v, v)) + np.diag(known.errors**2)


def deviation(known: Offsets, inverse: Any, height: float, paper: SheetPaper) -> float:
    """The field's remaining standard deviation along each axis, averaged over the fields."""
    left, top, right, bottom = paper.fields
    xs, ys = np.arange(left, right, SPACING), np.arange(top, bottom, SPACING)
    places = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
    x, y = known.places.T
    alike = likeness(places[:, :1] - x) * likeness(places[:, 1:] - y) * height**2
    explained = [((alike * way) @ inverse * (alike * way)).sum(axis=1) for way in known.ways.T]
    return float(np.sqrt(np.mean(np.clip(height**2 - np.array(explained), 0, None))))
