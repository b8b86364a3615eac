"""Scale factors: kL from the preferred scales, and the enlargement of the plans.

On the mechanism, a velocity is drawn as its distance in some time, and an acceleration as twice its
distance in that time. Each velocity is then the mean proportional of its bar and its component.
With one turning driver that time is 1/omega, and the velocity of the crank's pin is as long as the
crank. The plans are drawn m and m′ times as large.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import islice, takewhile
from math import floor, hypot, isclose, log10

from msgspec import Struct

from graphkin.numbers.arithmetic import Point, Real, larger, smaller

STEPS = (1.0, 2.0, 5.0)
"""First digits of preferred numbers."""
DIGITS = (1.0, 2.0, 2.5, 4.0, 5.0)
"""First digits of kL of the preferred scales: those of ISO 5455, and 2.5 and 4 of GOST 2.302."""


class Scales(Struct, frozen=True):
    """kL (real over drawn), kv (m/s per metre of paper), ka (m/s² per metre of paper).

    - ``seconds``: the time whose distances represent velocities on the mechanism.
    - ``larger``, ``larger_still``: the enlargements m of the velocity plan and m′ of the
      acceleration plan.
    - ``of_crank``: the length of the crank pin's velocity on the mechanism, in lengths of the
      crank; 0 where no crank gives it.
    - ``metre``: the unit of lengths in metres; kL, kv and ka are in this unit.
    - ``triangles``: optional triangles are drawn; they are computed instead where the space is
      needed for a larger mechanism.
    - ``kF`` (N per metre of paper) and ``k_lever`` (m/s per metre of paper): the scale factors of
      polygons of forces and of Zhukovsky's lever, where these are drawn.
    """

    kL: float
    seconds: float
    larger: float = 1.0
    larger_still: float = 1.0
    of_crank: float = 0.0
    triangles: bool = True
    kF: float = 0.0
    k_lever: float = 0.0
    metre: float = 1.0

    @property
    def kv(self) -> float:
        """The velocity in m/s that one metre of paper represents."""
        return self.kL / (self.seconds * self.larger)

    @property
    def ka(self) -> float:
        """The acceleration in m/s² that one metre of paper represents."""
        return self.kL / (self.seconds**2 * self.larger_still)

    def times(self, kind: str) -> float:
        """The enlargement of a sheet's plan, relative to vectors on the mechanism."""
        return self.larger_still if kind == "acceleration" else self.larger

    def of_bar(self, kind: str) -> float:
        """The length of the crank pin's vector in a sheet's plan, in lengths of the crank.

        0 where no crank gives it.
        """
        return self.times(kind) * self.of_crank ** (2 if kind == "acceleration" else 1)

    def pace(self, kind: str) -> float:
        """The metres of the mechanism that represent one unit of a sheet's vectors on it."""
        return self.seconds ** (2 if kind == "acceleration" else 1)

    def metres(self, kind: str) -> float:
        """The metres of the mechanism drawn as long as one unit of a sheet's plan."""
        return self.pace(kind) * self.times(kind)

    @property
    def words(self) -> str:
        """The scale as a drawing writes it, 1:5 or 2:1."""
        return ratio(self.kL * self.metre)


def ratio(kL: float) -> str:
    """A scale as a drawing writes it, 1:5, 2:1 or 4:3."""
    if kL >= 1:
        return f"1:{digits(kL)}"
    whole = Fraction(1 / kL).limit_denominator(3)
    return (
        f"{whole.numerator}:{whole.denominator}"
        if isclose(whole * kL, 1)
        else f"{digits(1 / kL)}:1"
    )


def is_standard(kL: float) -> bool:
    """Whether ISO 5455 has a scale: 1, 2 or 5 times a power of ten, reduced or enlarged."""
    return any(isclose(number, kL) for number in islice(preferred(kL * (1 - 1e-9)), 1))


def digits(number: float) -> str:
    """A round number in digits, never as a power of ten."""
    return f"{number:.12f}".rstrip("0").rstrip(".") if number < 1 else f"{number:.12g}"


class Extent(Struct, frozen=True):
    """The upright bounding box of a set of points, in metres of the mechanism.

    For many variants, each side is an array.
    """

    left: Real
    bottom: Real
    right: Real
    top: Real

    @property
    def sides(self) -> tuple[Real, Real, Real, Real]:
        return self.left, self.bottom, self.right, self.top

    @property
    def width(self) -> Real:
        return self.right - self.left

    @property
    def height(self) -> Real:
        return self.top - self.bottom

    @property
    def diagonal(self) -> float:
        return float(hypot(self.width, self.height))

    @property
    def middle(self) -> complex:
        return complex(self.left + self.right, self.bottom + self.top) / 2

    def joined(self, other: Extent) -> Extent:
        """The box that contains this one and another."""
        return Extent(
            smaller(self.left, other.left),
            smaller(self.bottom, other.bottom),
            larger(self.right, other.right),
            larger(self.top, other.top),
        )

    def about(self, point: Point) -> Extent:
        """The box that also contains a point; unchanged where the point is NaN."""
        return Extent(
            smaller(point.real, self.left),
            smaller(point.imag, self.bottom),
            larger(self.right, point.real),
            larger(self.top, point.imag),
        )

    def grown(self, points: Iterable[complex]) -> Extent:
        """The box that also contains some more points."""
        return extent_of([*points, complex(self.left, self.bottom), complex(self.right, self.top)])


def extent_of(points: Sequence[complex]) -> Extent:
    """The upright box around points; the origin where there are none."""
    xs, ys = [p.real for p in points or [0j]], [p.imag for p in points or [0j]]
    return Extent(min(xs), min(ys), max(xs), max(ys))


def preferred_scales(smallest: float, steps: Sequence[float] = ()) -> Iterator[float]:
    """The kL of preferred scales in increasing order, from the first not below ``smallest``.

    ``steps`` are the first digits n of a school's scales 1:n and n:1.
    """
    if steps:
        enlarged = sorted(1.0 if step == 1 else 10 / step for step in steps)
        yield from takewhile(lambda kL: kL < 1 - 1e-9, preferred(smallest, enlarged))
        yield from preferred(max(smallest, 1.0), sorted(steps))
        return
    yield from preferred(smallest, DIGITS)


def preferred(smallest: float, digits: Sequence[float] = STEPS) -> Iterator[float]:
    """The numbers 1, 2, 5 times powers of ten in increasing order, from ``smallest`` on."""
    power = floor(log10(smallest)) if smallest > 0 else 0
    while True:
        for step in digits:
            number = step * 10.0**power if power >= 0 else step / 10.0**-power
            if number >= smallest * (1 - 1e-12):
                yield number
        power += 1
