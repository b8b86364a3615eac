"""Numbers of any kind with their rates: what a step makes of moving values, it makes with its rate.

A program runs on these numbers as on others. The rate of a result is exact, to the digits of the
kind: the chain rule, one operation at a time (Griewank and Walther 2008, forward mode).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphkin.numbers.arithmetic import at, below, phase, pick, sqrt, turn_by


class Moving:  # noqa: PLW1641
    """A number ``now`` and its ``rate``, both real or both complex, of one kind."""

    __slots__ = ("now", "rate")
    __array_ufunc__ = None

    def __init__(self, now: Any, rate: Any) -> None:
        self.now, self.rate = now, rate

    # --- arithmetic ------------------------------------------------------------------------------

    def __add__(self, other: Any) -> Moving:
        other = moving(other)
        return Moving(self.now + other.now, self.rate + other.rate)

    __radd__ = __add__

    def __neg__(self) -> Moving:
        return Moving(-self.now, -self.rate)

    def __pos__(self) -> Moving:
        return self

    def __sub__(self, other: Any) -> Moving:
        return self + -moving(other)

    def __rsub__(self, other: Any) -> Moving:
        return moving(other) + -self

    def __mul__(self, other: Any) -> Moving:
        other = moving(other)
        return Moving(self.now * other.now, self.rate * other.now + self.now * other.rate)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Moving:
        other = moving(other)
        found = self.now / other.now
        return Moving(found, (self.rate - found * other.rate) / other.now)

    def __rtruediv__(self, other: Any) -> Moving:
        return moving(other) / self

    def __pow__(self, power: int) -> Moving:
        found = self
        for _ in range(power - 1):
            found = found * self
        return found

    def __abs__(self) -> Moving:
        size = abs(self.now)
        along = self.now.real * self.rate.real + self.now.imag * self.rate.imag
        return Moving(size, along / pick(size == 0, size + 1.0, size))

    def __mod__(self, other: Any) -> Moving:
        return Moving(self.now % other, self.rate)

    def conjugate(self) -> Moving:
        """Its mirror image."""
        return Moving(self.now.conjugate(), self.rate.conjugate())

    @property
    def real(self) -> Moving:
        """Its real part."""
        return Moving(self.now.real, self.rate.real)

    @property
    def imag(self) -> Moving:
        """Its imaginary part."""
        return Moving(self.now.imag, self.rate.imag)

    # --- functions -------------------------------------------------------------------------------

    def sqrt(self) -> Moving:
        """The root of a real number."""
        root = sqrt(self.now)
        return Moving(root, self.rate / (2 * root))

    def arg(self) -> Moving:
        """The angle of a direction in radians."""
        return Moving(phase(self.now), (self.rate / self.now).imag)

    def turn(self) -> Moving:
        """The unit vector at an angle in radians."""
        way = turn_by(self.now)
        return Moving(way, 1j * way * self.rate)

    def joined(self, imag: Any) -> Moving:
        """The complex number with this real part."""
        other = moving(imag)
        return Moving(at(self.now, other.now), at(self.rate, other.rate))

    def cos(self) -> Moving:
        """The cosine of an angle in radians."""
        return self.turn().real

    def sin(self) -> Moving:
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

    def both(self, other: Any, choose: Callable[[Any, Any], Any]) -> Moving:
        """A choice between two numbers, made for the numbers and for their rates."""
        other = moving(other)
        return Moving(choose(self.now, other.now), choose(self.rate, other.rate))


def moving(value: Any) -> Moving:
    """A number with its rate; a number without one is at rest."""
    return value if isinstance(value, Moving) else Moving(value, 0.0)


def now(value: Any) -> Any:
    """A number without its rate."""
    return value.now if isinstance(value, Moving) else value


def with_rate(value: Any, rate: Any) -> Any:
    """A value with its rate: a number, or a line, circle or other tuple part by part."""
    if isinstance(value, tuple):
        parts = [with_rate(*pair) for pair in zip(value, rate, strict=True)]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return Moving(value, rate)


def rate_of(value: Any) -> Any:
    """The rate of a value, a plain tuple for a line or another tuple; zero of what is at rest."""
    if isinstance(value, tuple):
        return tuple(rate_of(part) for part in value)
    return value.rate if isinstance(value, Moving) else value * 0.0


