"""Number kinds: the behaviour of a float, a numpy batch or another kind at a root, choice or sine.

Steps and plans are written once, in complex numbers, and do not depend on the kind. Plus, minus,
times, over, ``abs``, ``.real``, ``.imag`` and ``.conjugate()`` work alike for Python's ``complex``,
numpy's arrays, decimals of any length and balls. The differences are in this module. The kinds
other than Python's float are made in ``kinds``.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from fractions import Fraction
from types import ModuleType
from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

__all__ = ["np"]

if TYPE_CHECKING:
    import numpy as np
else:

    class LateNumpy(ModuleType):
        """A stand-in for numpy that loads it on first use."""

        def __getattr__(self, name: str) -> Any:
            """Load numpy and return one attribute of it."""
            import numpy

            value = getattr(numpy, name)
            setattr(self, name, value)
            return value

    np = LateNumpy("numpy")


# --- number kinds ---------------------------------------------------------------------------------


Real = Any
"""A real number of some kind: float, or an array of floats."""
Point = Any
"""A point or a vector of the plane as a complex number of some kind."""

QUARTERS = (1, 1j, -1, -1j)


class Kind(Struct, frozen=True):
    """One kind of number: conversion of exact numbers to it, and its functions of an angle.

    ``sound`` says whether a value can be drawn, where an impossible value does not raise.
    ``working`` is the context of a run, such as a precision. ``shared`` is the kind of values
    common to all variants of a batch, None for Python's float. ``own`` converts a Python number to
    the kind, where the two cannot be mixed.
    """

    name: str
    number: Callable[[Any], Real]
    pi: Any
    cos: Callable[[Real], Real]
    sin: Callable[[Real], Real]
    sqrt: Callable[[Real], Real]
    sound: Callable[[Any], bool] = field(default=lambda value: True)
    working: Callable[[], AbstractContextManager[Any]] = nullcontext
    shared: Kind | None = None
    own: Callable[[complex | float], Any] | None = None

    def direction(self, degrees: Any) -> Point:
        """Unit vector at an angle in degrees, reduced exactly: 90 gives i without rounding."""
        quarter = nearest_quarter(degrees)
        rest = self.number(degrees - 90 * quarter) * (self.pi / 180)
        return self.radians(rest) * quarter_turns(quarter)

    def radians(self, angle: Real) -> Point:
        """Unit vector at an angle in radians."""
        return at(self.cos(angle), self.sin(angle))


def nearest_quarter(degrees: Any) -> Any:
    """The nearest whole number of quarter turns to an exact angle, or to each of an array."""
    if hasattr(degrees, "shape"):
        return np.rint(degrees / 90)
    return math.floor(Fraction(degrees) / 90 + Fraction(1, 2))


def quarter_turns(quarter: Any) -> Any:
    """The power of i that turns by ``quarter`` quarter turns, exactly."""
    if hasattr(quarter, "shape"):
        left = quarter - 4 * np.rint(quarter / 4)
        size = abs(left)
        return (1 - size) + 1j * (left * (2 - size))
    return QUARTERS[quarter % 4]


def is_finite(value: Any) -> bool:
    """False for a float or a complex number that is infinite or NaN."""
    return not isinstance(value, complex | float) or cmath.isfinite(value)


FLOAT = Kind("float", float, math.pi, math.cos, math.sin, math.sqrt, is_finite)
"""Python's double precision numbers: one scene, errors raised, no imports."""


def batch_kind() -> Kind:
    """Arrays of numpy doubles, for many variants at once; impossible values become NaN."""

    def number(exact: Any) -> Any:
        return np.asarray(exact, dtype=float) if hasattr(exact, "shape") else float(exact)

    return Kind("batch", number, math.pi, np.cos, np.sin, np.sqrt)


def at(x: Real, y: Real) -> Point:
    """The point with two coordinates."""
    if isinstance(x, float) and isinstance(y, float):
        return complex(x, y)
    if is_dual(x):
        return x.joined(y)
    for part in (x, y):
        if is_ball(part):
            from flint import acb

            return acb(x, y)
    return x + 1j * y


def is_decimal(value: Any) -> bool:
    """Whether a number is one of mpmath's, real or complex."""
    return hasattr(value, "context")


def is_ball(value: Any) -> bool:
    """Whether a number is a ball, real or complex."""
    return hasattr(value, "rel_accuracy_bits")


def is_disc(value: Any) -> bool:
    """Whether a number is a disc with slopes, real or complex."""
    return hasattr(value, "rises")


def is_formal(value: Any) -> bool:
    """Whether a number is a polynomial in letters."""
    return hasattr(value, "terms")


def is_dual(value: Any) -> bool:
    """Whether a number is moving: a number with its rate, real or complex."""
    return hasattr(value, "joined")


def sqrt(x: Real) -> Real:
    """Square root; a negative number raises ValueError, a negative element of a batch gives NaN.

    A ball that contains negative numbers gives a ball that is not finite.
    """
    if isinstance(x, float):
        return math.sqrt(x)
    if is_decimal(x):
        if x < 0:
            raise ValueError("the square root of a negative number")
        return x.context.sqrt(x)
    if is_ball(x) or is_formal(x) or is_disc(x) or is_dual(x):
        return x.sqrt()
    return np.sqrt(x)


def phase(z: Point) -> Real:
    """Angle of a direction in radians, from -pi to pi."""
    if isinstance(z, complex):
        return cmath.phase(z)
    if is_decimal(z):
        return z.context.arg(z)
    if is_ball(z) or is_formal(z) or is_disc(z) or is_dual(z):
        return z.arg()
    return np.angle(z)


def turn_by(angle: Real) -> Point:
    """Unit vector at an angle in radians."""
    if isinstance(angle, float):
        return complex(math.cos(angle), math.sin(angle))
    if is_decimal(angle):
        return angle.context.expj(angle)
    if is_ball(angle):
        return at(angle.cos(), angle.sin())
    if is_formal(angle) or is_disc(angle) or is_dual(angle):
        return angle.turn()
    return np.cos(angle) + 1j * np.sin(angle)


def pick(condition: Any, yes: Any, no: Any) -> Any:
    """One of two values by a condition, element by element in a batch."""
    if isinstance(condition, bool):
        return yes if condition else no
    if is_dual(yes):
        return yes.both(no, lambda one, other: pick(condition, one, other))
    if is_dual(no):
        return no.both(yes, lambda other, one: pick(condition, one, other))
    if is_disc(yes):
        return yes.picked(condition, no)
    if is_disc(no):
        return no.picked(1.0 - np.asarray(condition, dtype=float), yes)
    return np.where(condition, yes, no)


def modulo(x: Real, period: Any) -> Real:
    """A number less whole periods, from 0 to below the period."""
    if is_ball(x):
        return x - period * (x / period).floor()
    return x % period


def below(a: Real, b: Real) -> Any:
    """Whether a number is smaller than another. Raises ValueError where a ball leaves that open."""
    if is_dual(a):
        return a.below(b)
    if is_ball(a) and not (a < b or a >= b):
        raise ValueError("the ball does not tell which number is smaller")
    return a < b


def either(condition: Any, one: Point, other: Point) -> Point:
    """One of two ways to the same point, by a condition; for balls, the intersection of both."""
    if is_ball(one):
        from flint import acb

        x, y = one.real.intersection(other.real), one.imag.intersection(other.imag)
        return acb(x, y)
    if is_formal(one):
        return one.simpler(other)
    if is_dual(one):
        return one.both(other, lambda a, b: either(condition, a, b))
    if is_disc(one):
        return one.tighter(other)
    return pick(condition, one, other)


def least(a: Real, b: Real) -> Real:
    """The smaller of two numbers, element by element in a batch; NaN where either is."""
    return pick(a < b, a, pick(a == a, b, a))  # noqa: PLR0124


def smaller(a: Real, b: Real) -> Real:
    """The smaller of two numbers that are not NaN, in fewer steps than ``least``."""
    return pick(a <= b, a, b)


def larger(a: Real, b: Real) -> Real:
    """The larger of two numbers that are not NaN."""
    return pick(a <= b, b, a)
