"""Scale factors: kL from the preferred scales, kv and ka so that the right triangle holds.

The drawing is as large as its fields allow. ka = kv²/kL always, because the right-triangle trick
needs it; with one turning driver kv = omega·kL, so that its bar and its velocity are drawn alike.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import floor, log10

from msgspec import Struct

from graphkin.text.errors import PageError, Problem

STEPS = (1.0, 2.0, 5.0)
"""First digits of preferred scales."""
FINE = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)
"""First digits of scale factors that are round enough where the preferred ones lie far apart."""
NARROW = 45.0
"""Least width of a plan in mm, so that its caption has room above it."""


class Scales(Struct, frozen=True):
    """kL (real over drawn), kv (m/s per metre of paper), ka (m/s² per metre of paper).

    ``seconds`` is kL/kv. ``from_driver``: kv follows from the one crank that drives, so that a
    student can find it; ``times`` so much larger than the crank says. ``triangles``: those that may
    give way to a larger mechanism are drawn, else computed. ``apart``: a scene states ka by itself,
    this is the root of kL/ka, and no triangle holds; 0 where ka = kv²/kL.
    """

    kL: float  # noqa: N815
    seconds: float
    from_driver: bool = True
    triangles: bool = True
    times: float = 1.0
    apart: float = 0.0

    @property
    def kv(self) -> float:
        """Velocity that one metre of paper stands for."""
        return self.kL / self.seconds

    @property
    def ka(self) -> float:
        """Acceleration that one metre of paper stands for: kv²/kL, unless stated apart."""
        return self.kL / (self.apart or self.seconds) ** 2

    def as_crank(self, kind: str) -> bool:
        """Whether a sheet's plan draws the vector of the crank's pin as long as the crank."""
        return self.from_driver and self.times == 1 and self.pace(kind) == self.seconds

    def pace(self, kind: str) -> float:
        """The seconds in which a sheet draws velocities as ways, and accelerations in twos."""
        return self.apart or self.seconds if kind == "acceleration" else self.seconds

    def metres(self, kind: str) -> float:
        """Metres of the mechanism that are drawn as long as one unit of a sheet's plan."""
        return self.pace(kind) ** (2 if kind == "acceleration" else 1)

    @property
    def words(self) -> str:
        """The scale as a drawing writes it, 1:5 or 2:1."""
        return ratio(self.kL)


def ratio(kL: float) -> str:
    """A scale as a drawing writes it, 1:5 or 2:1."""
    return f"1:{digits(kL)}" if kL >= 1 else f"{digits(1 / kL)}:1"


def digits(number: float) -> str:
    """A round number in digits, never as a power of ten."""
    return f"{number:.12f}".rstrip("0").rstrip(".") if number < 1 else f"{number:.12g}"


class Extent(Struct, frozen=True):
    """The upright box that a set of points takes up, in metres of the mechanism."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From bottom to top."""
        return self.top - self.bottom

    @property
    def middle(self) -> complex:
        """Its middle."""
        return complex(self.left + self.right, self.bottom + self.top) / 2

    def grown(self, points: Iterable[complex]) -> Extent:
        """The box that also holds some more points."""
        return extent_of([*points, complex(self.left, self.bottom), complex(self.right, self.top)])


def extent_of(points: Sequence[complex]) -> Extent:
    """The upright box around points; the origin where there are none."""
    xs, ys = [p.real for p in points or [0j]], [p.imag for p in points or [0j]]
    return Extent(min(xs), min(ys), max(xs), max(ys))


def preferred(smallest: float, digits: Sequence[float] = STEPS) -> Iterator[float]:
    """The preferred numbers 1, 2, 5 times a power of ten, upwards from one not less than given."""
    power = floor(log10(smallest)) if smallest > 0 else 0
    while True:
        for step in digits:
            number = step * 10.0**power if power >= 0 else step / 10.0**-power
            if number >= smallest * (1 - 1e-12):
                yield number
        power += 1


def fitting_scale(needs: Sequence[tuple[Extent, Extent]], width: float, height: float) -> float:
    """The smallest preferred kL at which mechanism and plan stand side by side on every sheet.

    ``needs`` holds, for each sheet, the extents of its mechanism and of its plan drawn at the
    mechanism's scale; the room's width and height are in mm. A plan takes up NARROW at least.
    """
    across = max((mechanism.width + plan.width) / width for mechanism, plan in needs)
    beside = max(mechanism.width for mechanism, _ in needs) / (width - NARROW)
    down = max(max(mechanism.height, plan.height) for mechanism, plan in needs) / height
    least = 1000 * max(across, beside, down)
    if not least > 0:
        raise PageError(Problem("scale", "the mechanism has no extent", "points apart"))
    return next(preferred(least))


def kept_scale(stated: float, least: float) -> float:
    """The scale that a scene asks for. Raises PageError when the drawing needs a larger kL."""
    if stated < least * (1 - 1e-12):
        raise PageError(
            Problem(
                "sheet.scale",
                f"does not fit: at {ratio(stated)} the drawing leaves its fields",
                f"{ratio(least)} or smaller",
                f"write scale = {digits(least)}, or leave it out",
            )
        )
    return stated
