"""Numbers of many digits: flint's balls, of which only the middles are looked at."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import mpmath
from flint import acb, arb, ctx

DIGITS = 50
"""Digits of the exact numbers."""


@contextmanager
def in_many_digits() -> Iterator[None]:
    """Within this all is reckoned to so many digits."""
    with ctx.workdps(DIGITS), mpmath.workdps(DIGITS):
        yield


def real(number: float | str) -> Any:
    """The very number that a scene writes; what is not exact costs digits wherever it comes in."""
    return arb(number if isinstance(number, str) else repr(number)).mid()


def radians(angle: Any) -> Any:
    """An angle of degrees."""
    return angle * arb.pi() / 180


def unit(angle: Any) -> Any:
    """A unit vector at an angle."""
    sine, cosine = angle.sin_cos()
    return acb(cosine, sine)


def angle_of(vector: Any) -> Any:
    """The angle of a vector; a ball about the negative axis would have every half turn."""
    if vector.real < 0:
        half = arb.pi() if vector.imag.mid() >= 0 else -arb.pi()
        return (-vector).arg() + half
    return vector.arg()
