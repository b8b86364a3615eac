"""Root finding for the ends, contacts and reversals of a motion, to the last digit, vectorised."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

HALVINGS = 70
"""Halvings after which the ends of a grid bracket are neighbouring doubles."""
CUT = 16
"""Parts into which the interval up to the last closing position is cut at once."""
AROUND = np.array([-4.5, -3.5, -2.5, -1.5, 1.5, 2.5, 3.5, 4.5])
"""Sample offsets, in steps, of a squared margin about a place where it may touch zero."""
BESIDE = (0.25, 0.75)
"""Shares at which a bracket is cut if the function is NaN in its middle."""
TOUCH = 1e-12
"""Square of a sine that counts as zero: it is rounding, or a gap too narrow to pass."""

Reals = np.ndarray[Any, np.dtype[Any]]


def last_closing(closes: Callable[[Reals], Any], inside: float, outside: float) -> float:
    """The last u that closes, between one that closes and one that does not.

    The interval is cut into parts, all tried at once, until no double lies between.
    """
    for _ in range(HALVINGS):
        between = np.unique(np.linspace(inside, outside, CUT + 1)[1:-1])
        between = between[(between != inside) & (between != outside)]
        if not between.size:
            break
        between = between if outside > inside else between[::-1]
        failing = np.flatnonzero(~np.asarray(closes(between), dtype=bool))
        first = int(failing[0]) if failing.size else len(between)
        inside = float(between[first - 1]) if first else inside
        outside = float(between[first]) if first < len(between) else outside
    return inside


def crossings_of_zero(
    value: Callable[[Reals], Reals], low: Reals, high: Reals, enough: float = 0.0
) -> Reals:
    """The sign change of a function in each bracket, by halving, all brackets at once.

    ``value`` takes u (N,) and returns the function of bracket i at u[i]. Brackets narrower than
    ``enough`` are left alone. If the function is NaN in the middle, the bracket is cut to either
    side of it. If it is NaN there, too, the bracket's lower end is returned, where it is known.
    """
    at_low = value(low)
    blind = np.zeros(len(low), dtype=bool)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        wide = (middle != low) & (middle != high) & (high - low >= enough) & ~blind
        if not wide.any():
            break
        found = value(middle)
        for share in BESIDE:
            if not (unknown := wide & np.isnan(found)).any():
                break
            middle = np.where(unknown, low + share * (high - low), middle)
            found = np.where(unknown, value(middle), found)
        blind |= wide & np.isnan(found)
        same = np.sign(found) == np.sign(at_low)
        wide &= ~blind
        low, high = np.where(wide & same, middle, low), np.where(wide & ~same, middle, high)
    return np.where(blind, low, (low + high) / 2)


def least_square(offsets: Reals, margins: Reals) -> tuple[float, float] | None:
    """The minimum of a squared margin near zero and its place, from samples around it.

    The square is smooth where the margin has a corner, and continues below zero where nothing
    closes. None where it has no minimum among the samples.
    """
    if not np.isfinite(margins).all():
        return None
    square = np.polynomial.Polynomial.fit(offsets, margins**2, len(offsets) - 1)
    roots = square.deriv().roots()
    near = [float(r.real) for r in roots if abs(r.imag) < 1e-6 and abs(r.real) < abs(offsets).max()]
    if not near:
        return None
    best = min(near, key=lambda r: float(square(r)))
    return best, float(square(best))


def touching(offsets: Reals, margins: Reals) -> float | None:
    """The place where a margin touches zero, or None.

    With its sign reversed beyond that place, the margin is smooth.
    """
    signed = np.polynomial.Polynomial.fit(offsets, np.sign(offsets) * margins, len(offsets) - 1)
    roots = [float(r.real) for r in signed.roots() if abs(r.imag) < 1e-9]
    inside = [r for r in roots if abs(r) < 1.5]
    return min(inside, key=abs) if inside else None
