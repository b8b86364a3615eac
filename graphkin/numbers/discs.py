"""Arrays of discs that surely hold a value, each with the discs that hold its slopes.

A disc is a middle and a radius (Rump 1999, midpoint-radius arithmetic): all trial values of a cell
run through a program at once, and the value of every step at each of them lies in its disc. The
slopes along each unknown are carried forward with it. Rounding is added to every radius.

Where a value is surely not defined the middle is NaN; where nothing is known the radius is infinite
or NaN.
"""

from __future__ import annotations

import math
from typing import Any

from graphkin.numbers.arithmetic import Kind, np

Array = Any
ROUNDED = 8 * 2.0**-52
"""What rounding may add to one operation, in parts of its size: complex ones round a few times."""
TINY = 1e-290
"""What it may add to numbers near the smallest."""
ZERO = 1e-60
"""What may be this near zero is not divided by."""


class Enclosure:
    """Values (K,) in discs, real or complex, and their slopes (n, K) along n unknowns."""

    __slots__ = ("middle", "radius", "rises", "spread")
    __array_ufunc__ = None

    def __init__(self, middle: Array, radius: Array, rises: Array, spread: Array) -> None:
        self.middle, self.radius = middle, radius
        self.rises, self.spread = rises, spread

    # --- arithmetic ------------------------------------------------------------------------------

    def __add__(self, other: Any) -> Enclosure:
        other = like(other, self)
        middle, rises = self.middle + other.middle, self.rises + other.rises
        return Enclosure(
            middle,
            rounded(self.radius + other.radius, middle),
            rises,
            rounded(self.spread + other.spread, rises),
        )

    __radd__ = __add__

    def __neg__(self) -> Enclosure:
        return Enclosure(-self.middle, self.radius, -self.rises, self.spread)

    def __sub__(self, other: Any) -> Enclosure:
        return self + -like(other, self)

    def __rsub__(self, other: Any) -> Enclosure:
        return like(other, self) + -self

    def __mul__(self, other: Any) -> Enclosure:
        other = like(other, self)
        middle, radius = times(self.middle, self.radius, other.middle, other.radius)
        first, more = times(self.rises, self.spread, other.middle, other.radius)
        second, most = times(self.middle, self.radius, other.rises, other.spread)
        return Enclosure(
            middle, radius, first + second, rounded(more + most, abs(first) + abs(second))
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Enclosure:
        return self * like(other, self).inverse()

    def __rtruediv__(self, other: Any) -> Enclosure:
        return like(other, self) * self.inverse()

    def __pow__(self, power: int) -> Enclosure:
        assert power == 2, "only squares are drawn"
        return self * self

    def inverse(self) -> Enclosure:
        """One over it; nothing is known where it may be zero."""
        size = abs(self.middle)
        clear = size > self.radius * (1 + ROUNDED) + ZERO
        least = np.where(clear, (size - self.radius) * (size + self.radius), 1.0)
        middle = np.where(clear, self.middle.conjugate() / least, 0.0 * self.middle)
        radius = np.where(clear, rounded(self.radius / least, middle), np.inf)
        square = times(middle, radius, middle, radius)
        rises, spread = times(-self.rises, self.spread, *square)
        return Enclosure(middle, radius, rises, spread)

    def __abs__(self) -> Enclosure:
        size = abs(self.middle)
        clear = size > self.radius * (1 + ROUNDED) + ZERO
        near = np.where(clear, size, 1.0)
        if np.iscomplexobj(self.middle):
            way, off = self.middle.conjugate() / near, 2 * self.radius / near
        else:
            way, off = np.sign(self.middle), 0.0 * self.radius
        way, off = np.where(clear, way, 0.0), np.where(clear, np.minimum(off, 2.0), 1.0)
        rises, spread = times(way, rounded(off, way), self.rises, self.spread)
        return Enclosure(size, rounded(self.radius, size), rises.real, spread)

    def conjugate(self) -> Enclosure:
        """Its mirror image."""
        return Enclosure(self.middle.conjugate(), self.radius, self.rises.conjugate(), self.spread)

    @property
    def real(self) -> Enclosure:
        """Its real part."""
        return Enclosure(self.middle.real, self.radius, self.rises.real, self.spread)

    @property
    def imag(self) -> Enclosure:
        """Its imaginary part."""
        return Enclosure(self.middle.imag, self.radius, self.rises.imag, self.spread)

    # --- functions -------------------------------------------------------------------------------

    def sqrt(self) -> Enclosure:
        """The root of a real one, of what of it is not negative; its slope is not known at zero."""
        low, high = self.middle - self.radius, self.middle + self.radius
        grain = ROUNDED * (abs(self.middle) + self.radius) + TINY
        low, high = low - grain, high + grain
        above = np.sqrt(np.where(high < 0, np.nan, high))
        below = np.sqrt(np.maximum(np.where(np.isfinite(low), low, 0.0), 0.0))
        known = np.isfinite(self.radius) | np.isnan(above)
        middle = np.where(known, (above + below) / 2, 0.0)
        radius = np.where(known, rounded((above - below) / 2, above), np.inf)
        root = Enclosure(middle, radius, 0 * self.rises, 0 * self.spread)
        half = 0.5 * root.inverse()
        rises, spread = times(self.rises, self.spread, half.middle, half.radius)
        return Enclosure(middle, radius, rises, spread)

    def turn(self) -> Enclosure:
        """The unit vector at an angle in radians."""
        middle = np.cos(self.middle) + 1j * np.sin(self.middle)
        radius = rounded(np.minimum(self.radius, 2.0), middle)
        rises, spread = times(1j * middle, radius, self.rises, self.spread)
        return Enclosure(middle, radius, rises, spread)

    def arg(self) -> Enclosure:
        """The angle of a direction in radians; nothing is known where it may be half a turn."""
        size, x, y = abs(self.middle), self.middle.real, self.middle.imag
        reach = self.radius * (1 + ROUNDED) + ROUNDED * size + ZERO
        clear = (size > reach) & ((x > reach) | (abs(y) > reach))
        near = np.where(clear, size, 1.0)
        middle = np.where(clear, np.angle(self.middle), 0.0 * size)
        radius = np.where(clear, rounded(np.arcsin(np.minimum(reach / near, 1.0)), middle), np.inf)
        whole = self.inverse()
        rises, spread = times(whole.middle, whole.radius, self.rises, self.spread)
        return Enclosure(middle, radius, rises.imag, spread)

    def cos(self) -> Enclosure:
        """The cosine of an angle in radians."""
        return self.turn().real

    def sin(self) -> Enclosure:
        """The sine of an angle in radians."""
        return self.turn().imag

    # --- comparisons -----------------------------------------------------------------------------

    def __le__(self, other: Any) -> Array:
        """One where it surely is not larger, zero where it surely is, a half where neither."""
        other = like(other, self)
        yes = self.middle + self.radius <= other.middle - other.radius
        no = self.middle - self.radius > other.middle + other.radius
        return np.where(yes, 1.0, np.where(no, 0.0, 0.5))

    def __ge__(self, other: Any) -> Array:
        return like(other, self) <= self

    def __lt__(self, other: Any) -> Array:
        return 1.0 - (like(other, self) <= self)

    def __gt__(self, other: Any) -> Array:
        return 1.0 - (self <= other)

    # --- two ways to one value -------------------------------------------------------------------

    def tighter(self, other: Enclosure) -> Enclosure:
        """Of two discs of the same value the smaller one, of each element."""
        return self.where(~(other.radius < self.radius), other)

    def where(self, condition: Array, other: Enclosure) -> Enclosure:
        """This where a condition holds, elsewhere the other."""
        pairs = ((getattr(self, part), getattr(other, part)) for part in Enclosure.__slots__)
        return Enclosure(*(np.where(condition, one, two) for one, two in pairs))

    def picked(self, condition: Array, other: Any) -> Enclosure:
        """This where a condition holds, elsewhere the other; both where it is not sure."""
        other, sure = like(other, self), np.asarray(condition, dtype=float)
        return self.hull(other).where(sure == 0.5, self.where(sure > 0.5, other))

    def hull(self, other: Enclosure) -> Enclosure:
        """A disc that holds what both do; slopes are not known, for there may be a jump."""
        middle = (self.middle + other.middle) / 2
        radius = abs(self.middle - other.middle) / 2 + np.maximum(self.radius, other.radius)
        rises = 0 * (self.rises + other.rises)
        return Enclosure(middle, rounded(radius, middle), rises, np.inf + abs(rises))


def like(value: Any, disc: Enclosure) -> Enclosure:
    """A value that does not move as a disc of as many slopes."""
    if isinstance(value, Enclosure):
        return value
    middle = np.asarray(value)
    middle = middle if middle.dtype.kind == "c" else middle.astype(float)
    size = disc.rises.shape[:1] + (1,) * max(1, middle.ndim)
    nothing = np.zeros(size)
    return Enclosure(np.atleast_1d(middle), np.zeros(1), nothing, nothing)


def rounded(radius: Array, middle: Array) -> Array:
    """A radius with what rounding may add, its own and that of its middle."""
    return radius * (1 + ROUNDED) + (ROUNDED * abs(middle) + TINY)


def times(one: Array, first: Array, two: Array, second: Array) -> tuple[Array, Array]:
    """The product of two discs."""
    middle = one * two
    radius = abs(one) * second + first * (abs(two) + second)
    return middle, rounded(radius, middle)


def disc_kind() -> Kind:
    """Discs with slopes: what all trial values of a cell make."""
    return Kind("disc", float, math.pi, Enclosure.cos, Enclosure.sin, Enclosure.sqrt)
