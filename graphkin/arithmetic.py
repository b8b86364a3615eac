"""Number kinds: what a float, a numpy batch or any later kind does at a root, a choice or a sine.

Steps and plans are written once, in complex numbers, and never ask which kind they run on: plus,
minus, times, over, ``abs``, ``.real``, ``.imag`` and ``.conjugate()`` mean the same for Python's
``complex`` and for numpy arrays. What differs lives here.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

Real = Any
"""A real number of some kind: float, or an array of floats."""
Point = Any
"""A point or a vector of the plane as a complex number of some kind."""

QUARTERS = (1, 1j, -1, -1j)


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of number: how exact numbers enter it, and its functions of an angle."""

    name: str
    number: Callable[[Any], Real]
    pi: Any
    cos: Callable[[Real], Real]
    sin: Callable[[Real], Real]
    sqrt: Callable[[Real], Real]

    def direction(self, degrees: Any) -> Point:
        """Unit vector at an angle in degrees, reduced exactly: 90 gives i, not nearly i."""
        quarter = nearest_quarter(degrees)
        rest = self.number(degrees - 90 * quarter) * (self.pi / 180)
        return self.radians(rest) * quarter_turns(quarter)

    def radians(self, angle: Real) -> Point:
        """Unit vector at an angle in radians."""
        return self.cos(angle) + 1j * self.sin(angle)


def nearest_quarter(degrees: Any) -> Any:
    """Whole number of quarter turns nearest to an exact angle, or to each of an array of them."""
    if hasattr(degrees, "shape"):
        import numpy as np

        return np.rint(degrees / 90)
    return math.floor(Fraction(degrees) / 90 + Fraction(1, 2))


def quarter_turns(quarter: Any) -> Any:
    """The power of i that turns by so many quarters, exactly."""
    if hasattr(quarter, "shape"):
        import numpy as np

        left = quarter - 4 * np.rint(quarter / 4)
        size = abs(left)
        return (1 - size) + 1j * (left * (2 - size))
    return QUARTERS[quarter % 4]


FLOAT = Kind("float", float, math.pi, math.cos, math.sin, math.sqrt)
"""Python's own double precision numbers: one scene, raised errors, nothing imported."""


def batch_kind() -> Kind:
    """Arrays of numpy doubles: many variants at once; what cannot be drawn becomes NaN."""
    import numpy as np

    def number(exact: Any) -> Any:
        return np.asarray(exact, dtype=float) if hasattr(exact, "shape") else float(exact)

    return Kind("batch", number, math.pi, np.cos, np.sin, np.sqrt)


def sqrt(x: Real) -> Real:
    """Square root; a negative float raises ValueError, a negative element of a batch gives NaN."""
    if isinstance(x, float):
        return math.sqrt(x)
    import numpy as np

    return np.sqrt(x)


def phase(z: Point) -> Real:
    """Angle of a direction in radians, from -pi to pi."""
    if isinstance(z, complex):
        return cmath.phase(z)
    import numpy as np

    return np.angle(z)


def turn_by(angle: Real) -> Point:
    """Unit vector at an angle in radians."""
    if isinstance(angle, float):
        return complex(math.cos(angle), math.sin(angle))
    import numpy as np

    return np.cos(angle) + 1j * np.sin(angle)


def pick(condition: Any, yes: Any, no: Any) -> Any:
    """One of two values by a condition, element by element in a batch."""
    if isinstance(condition, bool):
        return yes if condition else no
    import numpy as np

    return np.where(condition, yes, no)


def least(a: Real, b: Real) -> Real:
    """The smaller of two numbers, element by element in a batch; NaN where either is."""
    return pick(a < b, a, pick(a == a, b, a))  # noqa: PLR0124


def is_finite(z: Any) -> bool:
    """True when a scalar has neither a NaN nor an infinite part."""
    return cmath.isfinite(z)
