"""The primitives' last bounds with their teeth: dyads and directions, and the wrong ways to them.

The others have theirs in tests/construction/test_primitives.py, the decision whether loci meet has
its own in test_meeting.py. A test that the wrong formula passes is not a test.
"""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Callable
from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.construction.core import vocabulary
from graphkin.construction.links import compass_arc, dyad_by_arcs
from graphkin.construction.velocity import perpendicular_through
from graphkin.numbers.arithmetic import FLOAT
from tests.construction.test_primitives import (
    EPS,
    MANY,
    cross,
    dot,
    exactly,
    flat_dyads,
    mpc,
    teeth,
)
from tests.mechanisms import log_scaled, signs

# --- the velocity of a dyad: the 2×2 of its bars -------------------------------------------------

Solve = Callable[[complex, complex, complex, complex], complex]
"""From two bars and the velocities of their outer ends the velocity of the pin."""


@exactly
def velocity_within(solve: Solve, sample: tuple[complex, ...]) -> bool:
    """Normwise to 4·eps·(L/lmin)/s²."""
    p, q, x, v, w, _, _ = sample
    u, t = mpc(x) - mpc(p), mpc(x) - mpc(q)
    area = cross(u, t)
    exact = 1j * (dot(mpc(w), t) * u - dot(mpc(v), u) * t) / area
    lengths = abs(u), abs(t)
    sine = abs(area) / (lengths[0] * lengths[1])
    ratio = max(*lengths, abs(mpc(q) - mpc(p))) / min(lengths)
    bound = 4 * EPS * ratio / sine**2 * max(abs(mpc(v)), abs(mpc(w)), abs(exact))
    return abs(mpc(solve(x - p, x - q, v, w)) - exact) <= bound


def by_perpendiculars(u: complex, t: complex, v: complex, w: complex) -> complex:
    """As the plan is drawn: square to each bar through the image of its outer end."""
    lines = perpendicular_through.square_to(v, 0j, u), perpendicular_through.square_to(w, 0j, t)
    return vocabulary.meet(*lines)


def by_least_squares(u: complex, t: complex, v: complex, w: complex) -> complex:
    """Textbook: the normal equations, whose condition is the square of that of the bars."""
    rows, right = (u, t), (dot(v, u), dot(w, t))
    a = sum(bar.real**2 for bar in rows)
    b = sum(bar.real * bar.imag for bar in rows)
    c = sum(bar.imag**2 for bar in rows)
    x = sum(bar.real * value for bar, value in zip(rows, right, strict=True))
    y = sum(bar.imag * value for bar, value in zip(rows, right, strict=True))
    det = a * c - b * b
    return complex((c * x - b * y) / det, (a * y - b * x) / det) if det else 0j


def by_differences(u: complex, t: complex, v: complex, w: complex) -> complex:
    """Textbook: positions a little later and earlier, from arcs, over twice the time."""
    h = 1e-6 * min(abs(u), abs(t))
    side = 1 if cross(t - u, t) * 1 > 0 else -1
    places = []
    for time in (h, -h):
        p, q = v * time - u, w * time - t
        try:
            m, n = compass_arc.compass(p, abs(u)), compass_arc.compass(q, abs(t))
            found = [dyad_by_arcs.arcs_meet(m, n, way) for way in (side, -side)]
        except (ValueError, ZeroDivisionError):
            return 0j
        places.append(min(found, key=abs))
    return (places[0] - places[1]) / (2 * h)


@MANY
@given(flat_dyads())
def test_the_pin_of_a_dyad_moves_as_its_perpendiculars_say(sample):
    assert velocity_within(by_perpendiculars, sample)


@pytest.mark.parametrize("wrong", [by_least_squares, by_differences])
def test_normal_equations_and_differences_fail_that_bound(wrong):
    teeth(flat_dyads(), lambda sample: velocity_within(wrong, sample))


# --- directions ----------------------------------------------------------------------------------


@st.composite
def turned(draw):
    """Exact degrees: a small or a large part of a turn beside whole quarters, and many turns."""
    beside = Fraction(draw(log_scaled(1e-12, 45))) * draw(signs())
    quarters = draw(st.integers(-4, 4)) + 4 * draw(st.integers(-1000, 1000))
    return 90 * quarters + beside


def direction_within(way: Callable[[Fraction], complex], degrees: Fraction) -> bool:
    """Each coordinate of a direction is right to 2·eps of itself, also beside the axes."""
    with mpmath.workdps(80):
        exact = mpmath.expjpi(mpmath.mpf(degrees.numerator) / degrees.denominator / 180)
        found = way(degrees)
        pairs = ((found.real, exact.real), (found.imag, exact.imag))
        return all(abs(mpmath.mpf(mine) - true) <= 2 * EPS * abs(true) for mine, true in pairs)


def by_radians(degrees: Fraction) -> complex:
    """Textbook: sine and cosine of the degrees times pi over 180, rounded before."""
    return rect(1, math.radians(float(degrees)))


@MANY
@given(turned())
def test_a_direction_is_right_to_2_eps_beside_every_quarter(degrees):
    assert direction_within(FLOAT.direction, degrees)


def test_radians_rounded_before_fail_that():
    teeth(turned(), lambda degrees: direction_within(by_radians, degrees))
