"""The map from millimetres of paper to pixels: perspective, lens distortion and bent paper.

The bending of the paper is a smooth shift of its places before the camera sees them. It is a sum of
products of Legendre polynomials, with priors that keep higher degrees smaller. A sheet that was
folded in four has creases across its middle, where the shift turns: each quarter has its own map,
and the quarters meet at the creases. Half the width of the sheet is the unit of paper places.

The paper's ripples: the offsets of printed lines and crosses that a smooth map leaves.

Between the measured places the ripple is the most likely value of a Gaussian random field with the
same length scale and height (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006,
eqs. 2.23, 2.24, 5.12). The field's standard deviation is that of the map.
"""

from __future__ import annotations

from functools import cached_property
from itertools import product
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


RAISED = 8.0
"""Expected size of the shift at the edge of a folded sheet, in mm."""
DEGREE = 5
"""Highest degree of the bending polynomials."""
BENDS = tuple((i, j) for i, j in product(range(DEGREE + 1), repeat=2) if 2 <= i + j <= DEGREE)
"""The degrees across and down of each bending polynomial."""
TILTS, LENS, PLAIN = slice(6, 8), 8, 9
"""Positions in the parameters: eight for perspective, one for the lens, then those of bending."""
CREASES = 7
"""The functions of places that have a crease across the middle of the sheet, or down it."""
CREASED = PLAIN + 2 * len(BENDS)
"""Position of the parameters of creases."""
COUNT = CREASED + 2 * CREASES


class PaperMap(Struct, frozen=True, dict=True):
    """The map from paper to a picture of a given size: its parameters and the paper's ripples."""

    width: int
    height: int
    parameters: tuple[float, ...]
    ripple: Ripple | None = None
    paper: SheetPaper = A3

    @cached_property
    def array(self) -> Any:
        return np.array(self.parameters)

    def __call__(self, places: Any) -> Any:
        """The pixels of places in mm, coordinates in the last axis; (0, 0) is a pixel's centre."""
        if self.ripple is not None:
            places = places + self.ripple(places)
        return pixels_of(self.array, places, self.width, self.height, self.paper)

    def scale(self, place: Any) -> float:
        """Pixels per mm near a place: the geometric mean of both directions."""
        across, along = self.ways(np.asarray(place, dtype=float))
        return float(np.sqrt(abs(across[0] * along[1] - across[1] * along[0])))

    def ways(self, places: Any) -> tuple[Any, Any]:
        """The pixel shifts for one mm to the right and one mm down, near some places."""
        right, down = np.array([0.5, 0.0]), np.array([0.0, 0.5])
        return self(places + right) - self(places - right), self(places + down) - self(
            places - down
        )


def units(places: Any, paper: SheetPaper) -> tuple[Any, Any]:
    """Places in units of half the width, from the middle of the sheet."""
    x, y = paper.middle
    return (places[..., 0] - x) / paper.half, (places[..., 1] - y) / paper.half


def pixels_of(parameters: Any, places: Any, width: int, height: int, paper: SheetPaper = A3) -> Any:
    """The pixels of places, for given parameters."""
    (u, v), flat = units(places, paper), paper.middle[1] / paper.half
    shift = np.zeros(2)
    if np.any(parameters[PLAIN:CREASED]):
        shift = bendings(u, v, flat) @ parameters[PLAIN:CREASED].reshape(len(BENDS), 2)
    if np.any(parameters[CREASED:]):
        shift = shift + creasings(u, v, flat) @ parameters[CREASED:].reshape(CREASES, 2)
    if shift.any():
        u, v = u + shift[..., 0], v + shift[..., 1]
    return seen_at(parameters, u, v, width, height)


def seen_at(parameters: Any, u: Any, v: Any, width: int, height: int) -> Any:
    """The pixels of places of the bent paper, in units of half the width: perspective and lens."""
    a, b, c, d, e, f, g, h = parameters[:8]
    depth = g * u + h * v + 1
    with np.errstate(all="ignore"):
        x, y = (a * u + b * v + c) / depth, (d * u + e * v + f) / depth
        bulge = 1 + parameters[LENS] * (x * x + y * y)
    half = np.hypot(width, height) / 2
    middle = (width - 1) / 2, (height - 1) / 2
    return np.stack([x * bulge * half + middle[0], y * bulge * half + middle[1]], axis=-1)


FLAT = A3.middle[1] / A3.half
"""The height of an A3 sheet over its width."""


def bendings(u: Any, v: Any, flat: float = FLAT) -> Any:
    """The value of each bending polynomial at some places."""
    across, down = legendre(u), legendre(v / flat)
    return np.stack([across[i] * down[j] for i, j in BENDS], axis=-1)


def creasings(u: Any, v: Any, flat: float = FLAT) -> Any:
    """The value of each function with a crease at some places: raised sides, and how they look."""
    v = v / flat
    across, down = abs(u), abs(v)
    every = (across, down, across * u, across * v, down * u, down * v, across * down)
    return np.stack(every, axis=-1)


def legendre(x: Any) -> list[Any]:
    """The Legendre polynomials at some places; x is clipped just outside the sheet."""
    x = np.clip(x, -1.05, 1.05)
    found = [np.ones_like(x), x]
    for n in range(1, DEGREE):
        found.append(((2 * n + 1) * x * found[n] - n * found[n - 1]) / (n + 1))
    return found


def prior(bent: float, half: float = A3.half) -> Any:
    """The expected size of each parameter; ``bent`` is the size of the simplest bending, in mm."""
    found = np.full(COUNT, 10.0)
    found[TILTS] = 0.25
    found[LENS] = 0.1
    falling = [bent / half * 0.4 ** (i + j - 2) for i, j in BENDS]
    found[PLAIN:CREASED] = np.repeat(falling, 2)
    found[CREASED:] = RAISED / half
    return found
