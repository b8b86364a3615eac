"""Places of a sweep in words: angles, lengths and times as a cycle tells them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.scene.quantity import SI

if TYPE_CHECKING:
    from graphkin.motion.sweep import Sweep

NOTHING = 1e-12
"""A length, in the scene's unit, that is rounding."""


def at_words(sweep: Sweep, at: float, name: bool = True) -> str:
    """A place of the sweep, such as φ = 28.955°."""
    head = f"{sweep.coordinate.letter} = " if name else ""
    if sweep.what == "turn":
        return f"{head}{at:.3f}°".replace("-0.000°", "0.000°")
    if sweep.what == "time":
        return f"{head}{short(at)} s"
    return head + length_words(sweep, at)


def length_words(sweep: Sweep, value: float) -> str:
    """A length in the scene's unit."""
    unit = sweep.original.units["length"]
    size = value / float(SI[unit][0])
    return f"{short(size if abs(size) > NOTHING else 0.0)} {unit}"


def short(value: float) -> str:
    """A number with at most six digits."""
    return f"{value + 0.0:.6g}"
