"""Rational numbers: points and numbers that no operation rounds, as a scene states them."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt
from typing import Any

from msgspec import Struct

from graphkin.numbers.arithmetic import Kind, nearest_quarter, quarter_turns


class IrrationalError(ArithmeticError):
    """A value that is no rational number, so that it cannot be reckoned with fractions."""


class Exact(Struct, frozen=True):
    """A point or a number with rational coordinates, which no operation rounds."""

    real: Fraction
    imag: Fraction = Fraction(0)

    @classmethod
    def of(cls, value: Any) -> Exact:
        """A number of any rational kind as it is; IrrationalError for pi and the like."""
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
        """The mirror image in the real axis."""
        return Exact(self.real, -self.imag)

    def square(self) -> Fraction:
        """The square of the distance from nought."""
        return self.real**2 + self.imag**2


def root(square: Fraction) -> Fraction:
    """The square root of a fraction; IrrationalError where it is none."""
    top, bottom = isqrt(square.numerator), isqrt(square.denominator)
    if top**2 != square.numerator or bottom**2 != square.denominator:
        raise IrrationalError(f"the root of {square} is no rational number")
    return Fraction(top, bottom)


class Rational(Kind, frozen=True):
    """Rational numbers: what a scene states as it is written, before anything is rounded."""

    def direction(self, degrees: Any) -> Exact:
        """Unit vector at whole quarters of a turn; IrrationalError at other angles."""
        quarter = nearest_quarter(degrees)
        if degrees != 90 * quarter:
            raise IrrationalError(f"the direction of {degrees} degrees")
        return Exact.of(complex(quarter_turns(quarter)))

    def radians(self, angle: Any) -> Exact:
        """Unit vector at the angle nought."""
        if angle != Exact.of(0):
            raise IrrationalError(f"the direction of {angle} radians")
        return Exact.of(1)


def irrational(value: Any, *others: Any, **named: Any) -> Any:
    """A function whose values are not rational."""
    raise IrrationalError(f"a function of {value}")


class Pi:
    """A number that is no fraction: neither is what is reckoned with it."""

    __neg__ = __abs__ = __lt__ = irrational
    __add__ = __sub__ = __mul__ = __truediv__ = __pow__ = irrational
    __radd__ = __rsub__ = __rmul__ = __rtruediv__ = __rpow__ = irrational


RATIONAL = Rational("rational", Exact.of, Pi(), irrational, irrational, irrational)
