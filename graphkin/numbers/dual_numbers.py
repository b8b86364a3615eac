"""Numbers of any kind with their rates: what a step makes of moving values, it makes with its rate.

A program runs on these numbers as on others. The rate of a result is exact, to the digits of the
kind: the chain rule, one operation at a time (Griewank and Walther 2008, forward mode).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphkin.numbers.arithmetic import at, below, phase, pick, sqrt, turn_by


class Dual:  # noqa: PLW1641
    """A number ``now`` and its ``rate``, both real or both complex, of one kind."""

    __slots__ = ("now", "rate")
    __array_ufunc__ = None

    def __init__(self, now: Any, rate: Any) -> None:
        self.now, self.rate = now, rate

    # --- arithmetic ------------------------------------------------------------------------------

    def __add__(self, other: Any) -> Dual:
        other = dual(other)
        return Dual(self.now + other.now, self.rate + other.rate)

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return Dual(-self.now, -self.rate)

    def __pos__(self) -> Dual:
        return self

    def __sub__(self, other: Any) -> Dual:
        return self + -dual(other)

    def __rsub__(self, other: Any) -> Dual:
        return dual(other) + -self

    def __mul__(self, other: Any) -> Dual:
        other = dual(other)
        return Dual(self.now * other.now, self.rate * other.now + self.now * other.rate)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Dual:
        other = dual(other)
        found = self.now / other.now
        return Dual(found, (self.rate - found * other.rate) / other.now)

    def __rtruediv__(self, other: Any) -> Dual:
        return dual(other) / self

    def __pow__(self, power: int) -> Dual:
        found = self
        for _ in range(power - 1):
            found = found * self
        return found

    def __abs__(self) -> Dual:
        size = abs(self.now)
        along = self.now.real * self.rate.real + self.now.imag * self.rate.imag
        return Dual(size, along / pick(size == 0, size + 1.0, size))

    def __mod__(self, other: Any) -> Dual:
        return Dual(self.now % other, self.rate)

    def conjugate(self) -> Dual:
        """Its mirror image."""
        return Dual(self.now.conjugate(), self.rate.conjugate())

    @property
    def real(self) -> Dual:
        """Its real part."""
        return Dual(self.now.real, self.rate.real)

    @property
    def imag(self) -> Dual:
        """Its imaginary part."""
        return Dual(self.now.imag, self.rate.imag)

    # --- functions -------------------------------------------------------------------------------

    def sqrt(self) -> Dual:
        """The root of a real number."""
        root = sqrt(self.now)
        return Dual(root, self.rate / (2 * root))

    def arg(self) -> Dual:
        """The angle of a direction in radians."""
        return Dual(phase(self.now), (self.rate / self.now).imag)

    def turn(self) -> Dual:
        """The unit vector at an angle in radians."""
        way = turn_by(self.now)
        return Dual(way, 1j * way * self.rate)

    def joined(self, imag: Any) -> Dual:
        """The complex number with this real part."""
        other = dual(imag)
        return Dual(at(self.now, other.now), at(self.rate, other.rate))

    def cos(self) -> Dual:
        """The cosine of an angle in radians."""
        return self.turn().real

    def sin(self) -> Dual:
        """The sine of an angle in radians."""
        return self.turn().imag

    # --- comparisons and choices -----------------------------------------------------------------

    def __lt__(self, other: Any) -> Any:
        return self.now < now(other)

    def __le__(self, other: Any) -> Any:
        return self.now <= now(other)

    def __gt__(self, other: Any) -> Any:
        return self.now > now(other)

    def __ge__(self, other: Any) -> Any:
        return self.now >= now(other)

    def __eq__(self, other: object) -> Any:
        return self.now == now(other)

    def __ne__(self, other: object) -> Any:
        return self.now != now(other)

    def below(self, other: Any) -> Any:
        """Whether it is smaller than another number."""
        return below(self.now, now(other))

    def both(self, other: Any, choose: Callable[[Any, Any], Any]) -> Dual:
        """A choice between two numbers, made for the numbers and for their rates."""
        other = dual(other)
        return Dual(choose(self.now, other.now), choose(self.rate, other.rate))


def dual(value: Any) -> Dual:
    """A number with its rate; a number without one is at rest."""
    return value if isinstance(value, Dual) else Dual(value, 0.0)


def now(value: Any) -> Any:
    """A number without its rate."""
    return value.now if isinstance(value, Dual) else value


def with_rate(value: Any, rate: Any) -> Any:
    """A value with its rate: a number, or a line, circle or other tuple part by part."""
    if isinstance(value, tuple):
        parts = [with_rate(*pair) for pair in zip(value, rate, strict=True)]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return Dual(value, rate)


def at_rest(value: Any) -> Any:
    """A value with the rate zero: traced numbers and dual ones do not mix."""
    if isinstance(value, tuple):
        parts = [at_rest(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return Dual(value, 0.0)


def rate_of(value: Any) -> Any:
    """The rate of a value, a plain tuple for a line or another tuple; zero of what is at rest."""
    if isinstance(value, tuple):
        return tuple(rate_of(part) for part in value)
    return value.rate if isinstance(value, Dual) else value * 0.0
