"""Closed forms in 60 digits on the very numbers that a scene states, and the bounds of errors.

Nothing here is shared with the construction or with the loops: circles meet by the law of cosines,
and velocities and accelerations follow from the components along the bars.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, NamedTuple

import mpmath
from msgspec import Struct

EPS = 2.0**-52
DIGITS = 90


class Moving(NamedTuple):
    """A point's position, velocity and acceleration, complex, in many digits."""

    place: Any
    velocity: Any
    acceleration: Any


class Turning(NamedTuple):
    """A link's angular velocity and acceleration."""

    omega: Any
    epsilon: Any


class Motion(Struct, frozen=True):
    """What is true of a mechanism in one position, and what its errors are measured by.

    ``sine`` is that of its flattest crossing, ``largest`` and ``least`` its lengths (m).
    """

    points: Mapping[str, Moving]
    links: Mapping[str, Turning]
    sine: float
    largest: float
    least: float

    def bounds(self) -> tuple[float, float, float]:
        """Errors allowed of places, velocities and accelerations: the 1-2-3 law.

        Conditioning decides: 1/s, 1/s², 1/s³ of the largest of each kind, times the ratio of the
        lengths, and what the coordinates themselves cost far from the origin.
        """
        far = max(float(abs(p.place)) for p in self.points.values())
        coarse = EPS * max(far, self.largest) / self.least
        fastest = max(float(abs(p.velocity)) for p in self.points.values())
        hardest = max(float(abs(p.acceleration)) for p in self.points.values())
        omega = max(float(abs(link.omega)) for link in self.links.values())
        natural = max(hardest, omega**2 * self.largest, fastest**2 / self.largest)
        s = self.sine
        place = 8 * EPS * (self.largest / s + far)
        speed = 16 * coarse / s**2 * max(fastest, omega * self.least)
        return place, speed, 64 * coarse / s**3 * natural


def number(text: str) -> Any:
    """An exact decimal or fraction in many digits."""
    whole = Fraction(text)
    return mpmath.mpf(whole.numerator) / whole.denominator


def fixed(x: Any, y: Any = 0) -> Moving:
    """A point at rest."""
    return Moving(mpmath.mpc(x, y), mpmath.mpc(0), mpmath.mpc(0))


def cranked(pivot: Moving, length: Any, degrees: Any, omega: Any, epsilon: Any = 0) -> Moving:
    """The end of a bar that turns about a fixed pivot: Euler and Rivals."""
    arm = length * mpmath.expjpi(degrees / 180)
    return Moving(pivot.place + arm, 1j * omega * arm, (1j * epsilon - omega**2) * arm)


def dot(u: Any, v: Any) -> Any:
    """Scalar product."""
    return u.real * v.real + u.imag * v.imag


def cross(u: Any, v: Any) -> Any:
    """Signed area of the parallelogram of two vectors."""
    return u.real * v.imag - u.imag * v.real


def two_bars(p: Moving, q: Moving, l: Any, r: Any, side: int) -> tuple[Moving, Any]:  # noqa: E741
    """The pin of two bars, to the left (side 1) or right of the way from p to q, and its sine."""
    way = q.place - p.place
    d = abs(way)
    along = (d * d + (l - r) * (l + r)) / (2 * d)
    square = (l - along) * (l + along)
    if square < 0:
        raise ValueError("the arcs miss each other")
    x = p.place + (along + side * 1j * mpmath.sqrt(square)) * way / d
    u, w = x - p.place, x - q.place
    v = solved(u, w, dot(p.velocity, u), dot(q.velocity, w))
    pulls = (
        dot(end.acceleration, bar) - abs(v - end.velocity) ** 2 for end, bar in ((p, u), (q, w))
    )
    return Moving(x, v, solved(u, w, *pulls)), abs(cross(u, w)) / (l * r)


def bar_on_guide(p: Moving, l: Any, at: Any, way: int) -> tuple[Moving, Any]:  # noqa: E741
    """The end of a bar on a guide along x through (0, at), ahead or behind; with its sine."""
    height = at - p.place.imag
    half = mpmath.sqrt((l - height) * (l + height))
    x = mpmath.mpc(p.place.real + way * half, at)
    u, along = x - p.place, mpmath.mpc(0, 1)
    v = solved(u, along, dot(p.velocity, u), 0)
    a = solved(u, along, dot(p.acceleration, u) - abs(v - p.velocity) ** 2, 0)
    return Moving(x, v, a), half / l


def solved(u: Any, w: Any, along_u: Any, along_w: Any) -> Any:
    """The vector with given scalar products with two others; at rest where they are parallel."""
    area = cross(u, w)
    return 1j * (along_w * u - along_u * w) / area if area else mpmath.mpc(0)


def turning(p: Moving, q: Moving) -> Turning:
    """How the line of two points turns."""
    bar = q.place - p.place
    quick, push = (q.velocity - p.velocity) / bar, (q.acceleration - p.acceleration) / bar
    return Turning(quick.imag, push.imag - 2 * quick.real * quick.imag)


def seen_from(pivot: Moving, pin: Moving) -> tuple[Turning, Any, Any, Any]:
    """A guide through a fixed pivot and a pin: its turning, and the pin's way, speed and rate."""
    z = pin.place - pivot.place
    r, u = abs(z), z / abs(z)
    quick, push = pin.velocity / u, pin.acceleration / u
    omega = quick.imag / r
    epsilon = (push.imag - 2 * quick.real * omega) / r
    return Turning(omega, epsilon), r, quick.real, push.real + r * omega**2
