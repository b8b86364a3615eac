"""The laws of cams written anew, in any precision: how far a follower is lifted at an angle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import mpmath


def trapezoid(u: Any) -> Any:
    """The modified trapezoid: f″ a quarter of a sine, constant, a quarter of a cosine."""
    if u > 0.5:
        return 1 - trapezoid(1 - u)
    most, pi = 8 * mpmath.pi / (2 + mpmath.pi), mpmath.pi
    begun = most / (4 * pi)
    if u < 0.125:
        return begun * (u - mpmath.sin(4 * pi * u) / (4 * pi))
    first = begun * (mpmath.mpf(1) / 8 - 1 / (4 * pi))
    if u < 0.375:
        past = u - mpmath.mpf(1) / 8
        return first + begun * past + most * past**2 / 2
    second = first + begun / 4 + most / 32
    past = u - mpmath.mpf(3) / 8
    return (
        second + (begun + most / 4) * past + most * (1 - mpmath.cos(4 * pi * past)) / (4 * pi) ** 2
    )


def sine(u: Any) -> Any:
    """The modified sine: f″ a sine of a short wave at both ends, of a long one between them."""
    if u > 0.875:
        return 1 - sine(1 - u)
    pi = mpmath.pi
    begun = pi / (4 + pi)
    if u < 0.125:
        return begun * (u - mpmath.sin(4 * pi * u) / (4 * pi))
    long = 9 * begun / (4 * pi) * mpmath.sin((4 * pi * u + pi) / 3)
    return 2 / (4 + pi) + begun * u - long


MOTIONS: dict[str, Callable[[Any], Any]] = {
    "harmonic": lambda u: (1 - mpmath.cos(mpmath.pi * u)) / 2,
    "cycloidal": lambda u: u - mpmath.sin(2 * mpmath.pi * u) / (2 * mpmath.pi),
    "parabolic": lambda u: 2 * u**2 if u < 0.5 else 1 - 2 * (1 - u) ** 2,
    "3-4-5": lambda u: u**3 * (10 - 15 * u + 6 * u**2),
    "4-5-6-7": lambda u: u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3),
    "uniform": lambda u: u,
    "modified trapezoid": trapezoid,
    "modified sine": sine,
}
"""The displacement over the rise, by the part of the piece that is passed."""


def lifted(pieces: Sequence[tuple[Any, Any, str]], angle: Any) -> Any:
    """The lift at an angle of the law (radians), however many turns it counts."""
    at = mpmath.degrees(angle)
    at -= 360 * mpmath.floor(at / 360)
    return splined(pieces, at) if not pieces[0][2] else raised(pieces, at)


def raised(pieces: Sequence[tuple[Any, Any, str]], at: Any) -> Any:
    """The lift where a law has come to ``at``, piece after piece; none before, the last after."""
    begun, height = mpmath.mpf(0), mpmath.mpf(0)
    if at < 0:
        return height
    for end, rise, motion in pieces:
        if at < end:
            return height + rise * MOTIONS[motion]((at - begun) / (end - begun))
        begun, height = mpmath.mpf(end), height + rise
    return height


def splined(points: Sequence[tuple[Any, Any, str]], at: Any) -> Any:
    """The periodic cubic spline through points of a turn, by its second derivatives at these."""
    spots = [mpmath.mpf(angle) for angle, *_ in points]
    lifts = [mpmath.mpf(lift) for _, lift, _ in points]
    count = len(spots)
    gaps = [b - a for a, b in pairwise([*spots, spots[0] + 360])]
    slopes = [(lifts[(k + 1) % count] - lifts[k]) / gaps[k] for k in range(count)]
    matrix, right = mpmath.zeros(count), mpmath.zeros(count, 1)
    for k in range(count):
        matrix[k, k - 1 if k else count - 1] += gaps[k - 1]
        matrix[k, k] += 2 * (gaps[k - 1] + gaps[k])
        matrix[k, (k + 1) % count] += gaps[k]
        right[k] = 6 * (slopes[k] - slopes[k - 1])
    bends = mpmath.lu_solve(matrix, right)
    k = max(number for number in range(count) if spots[number] <= at)
    gap, past, here, there = gaps[k], at - spots[k], bends[k], bends[(k + 1) % count]
    slope = slopes[k] - gap * (2 * here + there) / 6
    return lifts[k] + past * (slope + past * (here / 2 + past * (there - here) / (6 * gap)))
