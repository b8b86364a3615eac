"""The map from mm of paper to pixels: a camera's perspective, its lens, and the paper's bending.

The unevenness of the paper is a smooth shift of its places before the camera sees them. It consists
of products of Legendre polynomials, kept small, and smaller for higher degrees.
"""

from __future__ import annotations

from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.reading.paper_ripple import Ripple

MIDDLE, HALF = (210.0, 148.5), 210.0
"""The middle of an A3 sheet and half its width, in mm: the unit of places on the paper."""
FLAT = 148.5 / 210.0
DEGREE = 5
"""Highest degree of the paper's bending."""
BENDS = tuple((i, j) for i, j in product(range(DEGREE + 1), repeat=2) if 2 <= i + j <= DEGREE)
"""The degrees across and down of each bending term."""
TILTS, LENS, PLAIN = slice(6, 8), 8, 9
"""Indices of the parameters: eight of the perspective, one of the lens, then the bending."""
COUNT = PLAIN + 2 * len(BENDS)


class PaperMap(Struct, frozen=True, dict=True):
    """A map from paper to a picture of a given size: its parameters, and the paper's ripples."""

    width: int
    height: int
    parameters: tuple[float, ...]
    ripple: Ripple | None = None

    @cached_property
    def array(self) -> Any:
        """The parameters as an array."""
        return np.array(self.parameters)

    def __call__(self, places: Any) -> Any:
        """The pixels of places in mm, both along the last axis; pixel (0, 0) is a centre."""
        if self.ripple is not None:
            places = places + self.ripple(places)
        return pixels_of(self.array, places, self.width, self.height)

    def scale(self, place: Any) -> float:
        """Pixels per mm about a place, the geometric mean of both directions."""
        across, along = self.ways(np.asarray(place, dtype=float))
        return float(np.sqrt(abs(across[0] * along[1] - across[1] * along[0])))

    def ways(self, places: Any) -> tuple[Any, Any]:
        """The shift in pixels per mm to the right and per mm down, about some places."""
        right, down = np.array([0.5, 0.0]), np.array([0.0, 0.5])
        return self(places + right) - self(places - right), self(places + down) - self(
            places - down
        )


def pixels_of(parameters: Any, places: Any, width: int, height: int) -> Any:
    """The pixels of places, for some parameters."""
    u = (places[..., 0] - MIDDLE[0]) / HALF
    v = (places[..., 1] - MIDDLE[1]) / HALF
    if np.any(parameters[PLAIN:]):
        shift = bendings(u, v) @ parameters[PLAIN:].reshape(len(BENDS), 2)
        u, v = u + shift[..., 0], v + shift[..., 1]
    return seen_at(parameters, u, v, width, height)


def seen_at(parameters: Any, u: Any, v: Any, width: int, height: int) -> Any:
    """The pixels of places of the bent paper, in its own unit: perspective and lens."""
    a, b, c, d, e, f, g, h = parameters[:8]
    depth = g * u + h * v + 1
    with np.errstate(all="ignore"):
        x, y = (a * u + b * v + c) / depth, (d * u + e * v + f) / depth
        bulge = 1 + parameters[LENS] * (x * x + y * y)
    half = np.hypot(width, height) / 2
    middle = (width - 1) / 2, (height - 1) / 2
    return np.stack([x * bulge * half + middle[0], y * bulge * half + middle[1]], axis=-1)


def bendings(u: Any, v: Any) -> Any:
    """Each bending term at some places."""
    across, down = legendre(u), legendre(v / FLAT)
    return np.stack([across[i] * down[j] for i, j in BENDS], axis=-1)


def legendre(x: Any) -> list[Any]:
    """Legendre polynomials at some places; beyond the sheet they are constant."""
    x = np.clip(x, -1.05, 1.05)
    found = [np.ones_like(x), x]
    for n in range(1, DEGREE):
        found.append(((2 * n + 1) * x * found[n] - n * found[n - 1]) / (n + 1))
    return found


def prior(bent: float) -> Any:
    """The expected size of each parameter; ``bent`` is the simplest bending, in mm."""
    found = np.full(COUNT, 10.0)
    found[TILTS] = 0.25
    found[LENS] = 0.1
    falling = [bent / HALF * 0.4 ** (i + j - 2) for i, j in BENDS]
    found[PLAIN:] = np.repeat(falling, 2)
    return found
