"""The primitives' last bounds with their teeth: dyads and directions, and the wrong ways to them.

The others have theirs in tests/construction/test_primitives.py, the decision whether loci meet has
its own in test_meeting.py. A test that the wrong formula passes is not a test.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import mpmath
from hypothesis import given
from hypothesis import strategies as st

from graphkin.construction.core import vocabulary
from graphkin.construction.velocity import lines_through
from graphkin.numbers.arithmetic import FLOAT
from tests.construction.test_primitives import (
    EPS,
    MANY,
    cross,
    dot,
    exactly,
    flat_dyads,
    mpc,
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
    lines = lines_through.square_to(v, 0j, u), lines_through.square_to(w, 0j, t)
    return vocabulary.meet(*lines)


@MANY
@given(flat_dyads())
def test_the_pin_of_a_dyad_moves_as_its_perpendiculars_say(sample):
    assert velocity_within(by_perpendiculars, sample)


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


@MANY
@given(turned())
def test_a_direction_is_right_to_2_eps_beside_every_quarter(degrees):
    assert direction_within(FLOAT.direction, degrees)
