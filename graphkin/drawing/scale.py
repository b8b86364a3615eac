"""Scale factors: kL from the preferred scales, and how much larger the plans are drawn.

On the mechanism a velocity is set as its way in some time, an acceleration as twice its way in it,
so that each velocity is the mean proportional of its bar and its component; with one turning
driver that time is 1/omega and the velocity of the crank's pin is as long as the crank. The plans
are drawn m and m′ times as large.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import takewhile
from math import floor, hypot, isclose, log10

from msgspec import Struct

from graphkin.numbers.arithmetic import Point, Real, larger, smaller

STEPS = (1.0, 2.0, 5.0)
"""First digits of preferred numbers."""
ENLARGED, REDUCED = (1.0, 2.0, 2.5, 4.0, 5.0), (1.0, 1.5, 2.0, 2.5, 4.0, 5.0, 7.5)
"""First digits of kL for scales above 2:1 and from there on: ISO 5455, GOST 2.302, and 4:3."""

TWICE = 0.5
"""kL of a drawing twice as large as its mechanism."""


class Scales(Struct, frozen=True):
    """kL (real over drawn), kv (m/s per metre of paper), ka (m/s² per metre of paper).

    ``seconds`` is the time in which velocities are set on the mechanism as ways. The velocity plan
    is drawn ``larger`` times as large, the acceleration plan ``larger_still`` times: m and m′.
    ``of_crank``: how many times as long as the crank the velocity of its pin is set there, 0 where
    no crank says it. ``triangles``: those that may give way to a larger mechanism are drawn, else
    computed.
    """

    kL: float
    seconds: float
    larger: float = 1.0
    larger_still: float = 1.0
    of_crank: float = 0.0
    triangles: bool = True

    @property
    def kv(self) -> float:
        """Velocity that one metre of paper stands for."""
        return self.kL / (self.seconds * self.larger)

    @property
    def ka(self) -> float:
        """Acceleration that one metre of paper stands for."""
        return self.kL / (self.seconds**2 * self.larger_still)

    def times(self, kind: str) -> float:
        """How many times as large as on the mechanism a sheet's plan draws its vectors."""
        return self.larger_still if kind == "acceleration" else self.larger

    def of_bar(self, kind: str) -> float:
        """How many times as long as the crank a sheet's plan draws the vector of its pin.

        0 where no crank says it.
        """
        return self.times(kind) * self.of_crank ** (2 if kind == "acceleration" else 1)

    def pace(self, kind: str) -> float:
        """Metres of the mechanism that one unit of a sheet's vectors is set on it as."""
        return self.seconds ** (2 if kind == "acceleration" else 1)

    def metres(self, kind: str) -> float:
        """Metres of the mechanism that are drawn as long as one unit of a sheet's plan."""
        return self.pace(kind) * self.times(kind)

    @property
    def words(self) -> str:
        """The scale as a drawing writes it, 1:5 or 2:1."""
        return ratio(self.kL)


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


def digits(number: float) -> str:
    """A round number in digits, never as a power of ten."""
    return f"{number:.12f}".rstrip("0").rstrip(".") if number < 1 else f"{number:.12g}"


class Extent(Struct, frozen=True):
    """The upright box that a set of points takes up, in metres of the mechanism.

    Of many variants the boxes, each side an array.
    """

    left: Real
    bottom: Real
    right: Real
    top: Real

    @property
    def sides(self) -> tuple[Real, Real, Real, Real]:
        """Left, bottom, right and top."""
        return self.left, self.bottom, self.right, self.top

    @property
    def width(self) -> Real:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> Real:
        """From bottom to top."""
        return self.top - self.bottom

    @property
    def diagonal(self) -> float:
        """From corner to corner."""
        return float(hypot(self.width, self.height))

    @property
    def middle(self) -> complex:
        """Its middle."""
        return complex(self.left + self.right, self.bottom + self.top) / 2

    def joined(self, other: Extent) -> Extent:
        """The box that holds this one and another."""
        return Extent(
            smaller(self.left, other.left),
            smaller(self.bottom, other.bottom),
            larger(self.right, other.right),
            larger(self.top, other.top),
        )

    def about(self, point: Point) -> Extent:
        """The box that also holds a point; the same where that is NaN."""
        return Extent(
            smaller(point.real, self.left),
            smaller(point.imag, self.bottom),
            larger(self.right, point.real),
            larger(self.top, point.imag),
        )

    def grown(self, points: Iterable[complex]) -> Extent:
        """The box that also holds some more points."""
        return extent_of([*points, complex(self.left, self.bottom), complex(self.right, self.top)])


def extent_of(points: Sequence[complex]) -> Extent:
    """The upright box around points; the origin where there are none."""
    xs, ys = [p.real for p in points or [0j]], [p.imag for p in points or [0j]]
    return Extent(min(xs), min(ys), max(xs), max(ys))


def preferred_scales(smallest: float) -> Iterator[float]:
    """The kL of preferred scales, upwards from one not less than given."""
    yield from takewhile(lambda kL: kL < TWICE, preferred(smallest, ENLARGED))
    yield from preferred(max(smallest, TWICE), REDUCED)


def preferred(smallest: float, digits: Sequence[float] = STEPS) -> Iterator[float]:
    """The preferred numbers 1, 2, 5 times a power of ten, upwards from one not less than given."""
    power = floor(log10(smallest)) if smallest > 0 else 0
    while True:
        for step in digits:
            number = step * 10.0**power if power >= 0 else step / 10.0**-power
            if number >= smallest * (1 - 1e-12):
                yield number
        power += 1
