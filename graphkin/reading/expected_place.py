"""Where a point is expected, as the cloud of its drawings tells."""

from __future__ import annotations

from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.reading.drawn_ink import PAPER
from graphkin.reading.line_crossings import LinesCrossing

CLOSE, ROOM, WIDEST = 0.7, 0.3, 10.0
"""Least half width of the window for a point, what is added to its cloud's, and the most, in mm."""


class ExpectedPlace(Struct, frozen=True):
    """Where a point is expected: the middle of a cloud (complex mm), and its covariance."""

    middle: complex
    spread: Any

    @property
    def reach(self) -> float:
        """Half the width of the window in which it is looked for."""
        wide = 3 * float(np.sqrt(max(np.linalg.eigvalsh(self.spread)[-1], 0.0)))
        return min(max(wide, CLOSE) + ROOM, WIDEST)

    @property
    def radius(self) -> float:
        """Within so many mm of the middle 95 of 100 drawings have it."""
        return 2.4477 * float(np.sqrt(np.trace(self.spread) / 2))

    def away(self, place: complex, error: Any) -> float:
        """The squared distance of a place in deviations of both."""
        off = np.array([(place - self.middle).real, (place - self.middle).imag])
        return float(off @ np.linalg.solve(self.spread + error, off))

    def weighed(self, found: LinesCrossing) -> complex:
        """A place that fits, drawn to what is expected as far as its lines leave it open."""
        off = np.array([(found.place - self.middle).real, (found.place - self.middle).imag])
        share = np.linalg.solve(self.spread + found.error, off)
        return self.middle + complex(*(self.spread @ share))

    def narrowed(self, cloud: Any, found: LinesCrossing, errors: Any) -> Any:
        """A cloud that fits, each of its places drawn to what was found as ``weighed`` does; the
        standard errors (count, 2) are what the lines leave open.
        """
        lines = np.linalg.cholesky(found.error) @ errors.T
        seen = np.array([[found.place.real], [found.place.imag]]) + lines
        off = seen - np.stack([cloud.real, cloud.imag])
        shift = self.spread @ np.linalg.solve(self.spread + found.error, off)
        return cloud + shift[0] + 1j * shift[1]


def expected(cloud: Any) -> ExpectedPlace:
    """What a cloud expects."""
    cloud = np.atleast_1d(np.asarray(cloud, dtype=complex))
    cloud = cloud[np.isfinite(cloud)]
    if not len(cloud):
        return ExpectedPlace(complex("nan"), np.eye(2))
    middle = complex(np.median(cloud.real), np.median(cloud.imag))
    off = cloud - middle
    near = off[abs(off) <= np.percentile(abs(off), 98)]
    if len(near) < 8:
        return ExpectedPlace(middle, np.eye(2) * PAPER**2)
    spread = np.cov(np.stack([near.real, near.imag])) * 1.08 + np.eye(2) * PAPER**2
    return ExpectedPlace(middle, spread)
