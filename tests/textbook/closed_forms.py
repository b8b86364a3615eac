"""Closed forms of the mechanisms that textbooks work with, by trigonometry alone.

A motion is (position, velocity, acceleration): complex for a point, real for an angle or a length.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

Moving = tuple[complex, complex, complex]
Turning = tuple[float, float, float]


class Dyad(NamedTuple):
    """A dyad RRR: its inner pin and its two bars' angles."""

    pin: Moving
    left: Turning
    right: Turning


class Rod(NamedTuple):
    """A rod whose end slides on a straight guide: the rod's angle, and the end's coordinate."""

    angle: Turning
    slide: Turning


class Polar(NamedTuple):
    """A moving point seen from the origin: its distance and its angle."""

    radius: Turning
    angle: Turning


def fixed(place: complex) -> Moving:
    """A point at rest."""
    return place, 0j, 0j


def turned(angle: Turning, length: float) -> Moving:
    """The end of a bar seen from its start: Euler and Rivals."""
    theta, omega, epsilon = angle
    arm = length * cmath.exp(1j * theta)
    return arm, 1j * omega * arm, (1j * epsilon - omega**2) * arm


def added(first: Moving, second: Moving) -> Moving:
    """The sum of two motions."""
    (p, v, a), (q, w, b) = first, second
    return p + q, v + w, a + b


def less(first: Moving, second: Moving) -> Moving:
    """The first motion seen from the second."""
    return added(first, tuple(-z for z in second))


def degrees(angle: float, omega: float = 0.0, epsilon: float = 0.0) -> Turning:
    """A turning motion, its angle given in degrees."""
    return math.radians(angle), omega, epsilon


def polar(point: Moving) -> Polar:
    """Distance and angle: a/z = r̈/r - ω² + i(ε + 2 ω ṙ/r)."""
    z, v, a = point
    radius, ratio, second = abs(z), v / z, a / z
    speed, omega = radius * ratio.real, ratio.imag
    epsilon = second.imag - 2 * omega * ratio.real
    return Polar(
        (radius, speed, radius * (second.real + omega**2)), (cmath.phase(z), omega, epsilon)
    )


def rod_on_guide(pin: Moving, length: float, guide: float = 0.0, way: int = 1) -> Rod:
    """A rod from a moving pin to a guide through the origin at an angle, its end ahead or behind.

    The height of the pin over the guide is what the rod must lose: y + l sin φ = 0.
    """
    (x, y), (vx, vy), (ax, ay) = ((z.real, z.imag) for z in rotated(pin, -guide))
    sine, cosine = -y / length, way * math.sqrt(1 - (y / length) ** 2)
    omega = -vy / (length * cosine)
    epsilon = (-ay / length + sine * omega**2) / cosine
    slide = (
        x + length * cosine,
        vx - length * sine * omega,
        ax - length * (cosine * omega**2 + sine * epsilon),
    )
    return Rod((math.atan2(sine, cosine) + guide, omega, epsilon), slide)


def rotated(point: Moving, angle: float) -> Moving:
    """A motion in axes turned by an angle the other way."""
    p, v, a = (z * cmath.exp(1j * angle) for z in point)
    return p, v, a


def dyad(start: Moving, left: float, right: float, end: Moving, side: int) -> Dyad:
    """Bars ``left`` from ``start`` and ``right`` from ``end`` that meet; side +1 left of start-end.

    The angle at the start by the law of cosines; ω and ε by the components of v and a along the
    other bar, to which that bar's own turning contributes nothing.
    """
    base = less(end, start)
    span = abs(base[0])
    corner = side * math.acos((left**2 + span**2 - right**2) / (2 * left * span))
    first = left * cmath.exp(1j * (cmath.phase(base[0]) + corner))
    second = first - base[0]
    cross = (first.conjugate() * second).imag
    one = (base[1].conjugate() * second).real / cross
    two = (base[1].conjugate() * first).real / cross
    known = base[2] + one**2 * first - two**2 * second
    one_epsilon = (known.conjugate() * second).real / cross
    two_epsilon = (known.conjugate() * first).real / cross
    bar = (cmath.phase(first), one, one_epsilon)
    return Dyad(added(start, turned(bar, left)), bar, (cmath.phase(second), two, two_epsilon))
