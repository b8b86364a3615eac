"""Rational numbers: points and numbers of a scene without rounding."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt
from typing import Any

from msgspec import Struct

from graphkin.numbers.arithmetic import Kind, nearest_quarter, quarter_turns


class IrrationalError(ArithmeticError):
    """A value that is not rational, so that fractions cannot represent it."""


class Exact(Struct, frozen=True):
    """A point or a number with rational coordinates."""

    real: Fraction
    imag: Fraction = Fraction(0)

    @classmethod
    def of(cls, value: Any) -> Exact:
        """A number of any rational kind, unchanged. Raises IrrationalError for pi and the like."""
        if isinstance(value, Exact):
            return value
        if isinstance(value, complex):
            return cls(Fraction(value.real), Fraction(value.imag))
        if isinstance(value, int | float | Fraction):
            return cls(Fraction(value))
        raise IrrationalError(f"{value} is no rational number")

    def __add__(self, other: Any) -> Exact:
        other = Exact.of(other)
        return Exact(self.real + other.real, self.imag + other.imag)

    __radd__ = __add__

    def __neg__(self) -> Exact:
        return Exact(-self.real, -self.imag)

    def __sub__(self, other: Any) -> Exact:
        return self + -Exact.of(other)

    def __rsub__(self, other: Any) -> Exact:
        return Exact.of(other) - self

    def __mul__(self, other: Any) -> Exact:
        other = Exact.of(other)
        return Exact(
            self.real * other.real - self.imag * other.imag,
            self.real * other.imag + self.imag * other.real,
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Exact:
        other = Exact.of(other)
        square = other.square()
        return self * Exact(other.real / square, -other.imag / square)

    def __rtruediv__(self, other: Any) -> Exact:
        return Exact.of(other).__truediv__(self)

    def __abs__(self) -> Exact:
        return Exact(root(self.square()))

    def conjugate(self) -> Exact:
        """The complex conjugate."""
        return Exact(self.real, -self.imag)

    def square(self) -> Fraction:
        """The square of the absolute value."""
        return self.real**2 + self.imag**2


def root(square: Fraction) -> Fraction:
    """The square root of a fraction. Raises IrrationalError if it is irrational."""
    top, bottom = isqrt(square.numerator), isqrt(square.denominator)
    if top**2 != square.numerator or bottom**2 != square.denominator:
        raise IrrationalError(f"the root of {square} is no rational number")
    return Fraction(top, bottom)


class Rational(Kind, frozen=True):
    """Rational numbers: the values of a scene as written, before any rounding."""

    def direction(self, degrees: Any) -> Exact:
        """Unit vector at whole quarter turns. Raises IrrationalError at other angles."""
        quarter = nearest_quarter(degrees)
        if degrees != 90 * quarter:
            raise IrrationalError(f"the direction of {degrees} degrees")
        return Exact.of(complex(quarter_turns(quarter)))

    def radians(self, angle: Any) -> Exact:
        """Unit vector at the angle zero. Raises IrrationalError at other angles."""
        if angle != Exact.of(0):
            raise IrrationalError(f"the direction of {angle} radians")
        return Exact.of(1)


def irrational(value: Any, *others: Any, **named: Any) -> Any:
    """A function with irrational values."""
    raise IrrationalError(f"a function of {value}")


class Pi:
    """An irrational number; every result with it is irrational, too."""

    __neg__ = __abs__ = __lt__ = irrational
    __add__ = __sub__ = __mul__ = __truediv__ = __pow__ = irrational
    __radd__ = __rsub__ = __rmul__ = __rtruediv__ = __rpow__ = irrational


RATIONAL = Rational("rational", Exact.of, Pi(), irrational, irrational, irrational)
