"""The laws of cams written anew, in any precision: how far a follower is lifted at an angle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import mpmath

MOTIONS: dict[str, Callable[[Any], Any]] = {
    "harmonic": lambda u: (1 - mpmath.cos(mpmath.pi * u)) / 2,
    "cycloidal": lambda u: u - mpmath.sin(2 * mpmath.pi * u) / (2 * mpmath.pi),
    "parabolic": lambda u: 2 * u**2 if u < 0.5 else 1 - 2 * (1 - u) ** 2,
    "3-4-5": lambda u: u**3 * (10 - 15 * u + 6 * u**2),
    "4-5-6-7": lambda u: u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3),
    "uniform": lambda u: u,
}
"""The displacement over the rise, by the part of the piece that is passed."""


def lifted(pieces: Sequence[tuple[Any, Any, str]], angle: Any) -> Any:
    """The lift at an angle of the law (radians), however many turns it counts."""
    at = mpmath.degrees(angle)
    at -= 360 * mpmath.floor(at / 360)
    begun, height = mpmath.mpf(0), mpmath.mpf(0)
    for end, rise, motion in pieces:
        if at < end:
            return height + rise * MOTIONS[motion]((at - begun) / (end - begun))
        begun, height = mpmath.mpf(end), height + rise
    return height
