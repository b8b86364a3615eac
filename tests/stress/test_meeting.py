"""Does it close? Decided exactly, apart from the construction; the wrong formulas fail it."""

from __future__ import annotations

from fractions import Fraction
from math import inf, nextafter

import flint
import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from graphkin.diagnosis.assembly_failure import clearance, gap_of, meet, stated_loci
from graphkin.numbers.exact import Exact, IrrationalError, root
from graphkin.numbers.plane import Circle, Line, circle_meets_circle
from graphkin.text.errors import ClosureError
from tests.construction.test_primitives import MANY
from tests.mechanisms import directions, log_scaled, signs
from tests.stress.cases import Case, FourBar, SliderCrank, commanded, statuses

TANGENT = 1000
"""Pairs of circles at tangency that are decided."""


# --- two circles and a distance ------------------------------------------------------------------


@st.composite
def tangents(draw):
    """Radii of 1e-6 to 1 and a distance within four neighbours of their sum or difference."""
    r, t = draw(log_scaled(1e-6, 1)), draw(log_scaled(1e-6, 1))
    d = r + t if draw(st.booleans()) else abs(r - t)
    towards = draw(signs()) * inf
    for _ in range(draw(st.integers(0, 4))):
        d = nextafter(d, towards)
    return r, t, max(d, nextafter(0, 1))


def true_sign(r: float, t: float, d: float) -> int:
    """1 where circles cross, 0 where they touch, -1 where they miss, by fractions."""
    R, T, D = Fraction(r), Fraction(t), Fraction(d)
    least = min((R + T) ** 2 - D**2, D**2 - (R - T) ** 2)
    return (least > 0) - (least < 0)


def by_fractions(r: float, t: float, d: float) -> int:
    """As the project decides it."""
    return meet(Circle(0j, r), Circle(complex(d), t))


def decided(decide, sample) -> bool:
    """Whether a decision is the true one."""
    return decide(*sample) == true_sign(*sample)


@settings(MANY, max_examples=TANGENT)
@given(tangents())
def test_none_of_a_thousand_tangencies_is_misjudged(sample):
    assert decided(by_fractions, sample)


@MANY
@given(tangents(), directions(), directions())
def test_circles_anywhere_in_the_plane_are_decided_by_their_own_numbers(sample, place, way):
    """Centres are complex floats; their distance, seldom one, is never rounded."""
    r, t, d = sample
    m, n = Circle(place, r), Circle(place + d * way, t)
    gap = Exact.of(n.centre) - Exact.of(m.centre)
    with mpmath.workdps(120):
        distance = mpmath.sqrt(mpmath.mpf(gap.square().numerator) / gap.square().denominator)
        apart = max(distance - mpmath.mpf(r) - t, abs(mpmath.mpf(r) - t) - distance)
        assert meet(m, n) == meet(n, m) == (apart < 0) - (apart > 0)
        found = clearance(m, n)
        assert abs(found - apart) <= 4 * 2.0**-52 * abs(apart)


@MANY
@given(tangents())
def test_where_circles_do_not_meet_no_crossing_is_constructed(sample):
    """The construction raises, or finds a point where its rounded loci touch, and no NaN."""
    r, t, d = sample
    try:
        found = circle_meets_circle(Circle(0j, r), Circle(complex(d), t), 1)
    except (ValueError, ZeroDivisionError):
        return
    miss = clearance(Circle(0j, r), Circle(complex(d), t))
    assert miss <= 4 * 2.0**-52 * (r + t + d)
    assert abs(found) == abs(found)


@pytest.mark.parametrize(("radii", "gap"), [((1, 2), 2), ((3, 4), -2), ((9, 1), 3)])
def test_the_gap_of_two_circles_is_told_in_balls(radii, gap):
    """Of centres 3-4-5 apart: beside, across and within one another."""
    first, second = (flint.acb(3, 1), flint.acb(6, 5))
    found = gap_of(Circle(first, flint.arb(radii[0])), Circle(second, flint.arb(radii[1])))
    assert float(found) == gap


# --- a line and a circle -------------------------------------------------------------------------


@st.composite
def grazing(draw):
    """A line that passes a circle's centre at its radius, or at a neighbour of it."""
    radius, way = draw(log_scaled(1e-6, 1e3)), draw(directions())
    start = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    height = radius
    for _ in range(draw(st.integers(0, 3))):
        height = nextafter(height, draw(signs()) * inf)
    centre = start + draw(log_scaled(1e-3, 1e3)) * way + 1j * way * height
    return Line(start, way * draw(log_scaled(1e-3, 1e3))), Circle(centre, radius)


def line_within(decide, sample) -> bool:
    """Whether a line's meeting with a circle is judged as 120 digits judge it."""
    line, circle = sample
    with mpmath.workdps(120):
        u, gap = mpmath.mpc(line.along), mpmath.mpc(circle.centre) - mpmath.mpc(line.point)
        miss = abs((u.conjugate() * gap).imag) / abs(u) - circle.radius
        return decide(line, circle) == (miss < 0) - (miss > 0)


@MANY
@given(grazing())
def test_a_line_that_grazes_a_circle_is_judged_rightly(sample):
    assert line_within(meet, sample)
    assert meet(*sample) == meet(*sample[::-1])
    assert (clearance(*sample) < 0) == (meet(*sample) > 0)


# --- the numbers that a scene states -------------------------------------------------------------

TOUCHING: list[Case] = [
    FourBar(bars=("1/10", "1/10", "2/10", "4/10"), at="0"),
    FourBar(bars=("1/10", "3/10", "4/10", "8/10"), at="0"),
    FourBar(bars=("1/10", "7/10", "1/10", "7/10"), at="180"),
    FourBar(bars=("1/3", "1/7", "1", "31/21"), at="0"),
    SliderCrank(bars=("1/10", "3/10", "4/10"), at="90"),
    SliderCrank(bars=("2/10", "1/10", "1/10"), at="90"),
]
"""Dyads that touch in decimals; in doubles they miss, touch or cross."""


def nudged(case: Case, by: Fraction) -> Case:
    """The same with a coupler or rod a little longer."""
    crank, rod, *rest = case.bars
    return replace(case, bars=(crank, str(Fraction(rod) + by), *rest))


def sense(case: Case) -> int:
    """1 where a longer coupler makes the case close, -1 where it opens it."""
    try:
        nudged(case, Fraction(1, 10**6)).truth()
    except ValueError:
        return -1
    return 1


@pytest.mark.parametrize("case", TOUCHING)
def test_what_touches_in_decimals_is_a_dead_point_whatever_doubles_say(case):
    with pytest.raises(ClosureError, match="dead point") as raised:
        case.mechanism().solve()
    assert "miss" not in str(raised.value)
    assert "the driver's speed determines no other" in str(raised.value)


@pytest.mark.parametrize("case", TOUCHING)
@pytest.mark.parametrize("power", [9, 12, 15, 18, 30])
def test_what_misses_by_a_hair_is_said_to_miss_by_just_that(case, power):
    """1e-30 m is no more than rounding to a double, and still it does not close."""
    hair = Fraction(-sense(case), 10**power)
    with pytest.raises(ClosureError, match="miss") as raised:
        nudged(case, hair).mechanism().solve()
    told = float(str(raised.value).split(" by ")[1].split(" m;")[0])
    assert told == pytest.approx(10.0**-power, rel=1e-3)


@pytest.mark.parametrize("case", TOUCHING)
@pytest.mark.parametrize("power", [6, 9])
def test_what_crosses_by_a_hair_closes(case, power):
    found = nudged(case, Fraction(sense(case), 10**power)).mechanism().solve()
    assert 0 < found.margin < 1


@pytest.mark.parametrize("case", TOUCHING)
def test_what_crosses_by_less_than_rounding_is_refused_as_a_dead_point(case):
    """Doubles hold no digit of its velocity, so that none is told."""
    with pytest.raises(ClosureError, match="dead point"):
        nudged(case, Fraction(sense(case), 10**20)).mechanism().solve()


@pytest.mark.parametrize("case", TOUCHING[::2])
def test_the_commands_on_loci_that_touch(case, tmp_path):
    for by in (Fraction(0), Fraction(-sense(case), 10**15)):
        said = commanded(nudged(case, by), tmp_path, ["check", "solve", "json", "sheet"])
        assert set(statuses(said).values()) == {2}


def test_what_hangs_on_a_crossing_or_an_oblique_crank_is_not_stated():
    """Only rational loci are decided by the scene; the others by what was found in doubles."""
    program = FourBar(at="60").mechanism().program
    crossing = program.targets["position", "B"]
    scene = FourBar(at="60").mechanism().scene
    assert stated_loci(program, crossing, scene.values) is None
    scene = FourBar(at="90").mechanism().scene
    first, second = stated_loci(program, crossing, {**scene.values})
    assert (first.radius, second.radius) == (Exact.of(3), Exact.of(2))
    assert first.centre == Exact.of(1j)


def test_rational_numbers_never_round():
    third = Exact.of(Fraction(1, 3))
    assert third + third + third == Exact.of(1)
    assert (third * 3j).conjugate() / 1j == Exact.of(-1)
    assert 1 - third == Exact.of(Fraction(2, 3))
    assert 1 / (third * 1j) == Exact.of(-3j)
    assert abs(Exact.of(3 + 4j)) == Exact.of(5)
    assert root(Fraction(9, 16)) == Fraction(3, 4)
    for value in (Fraction(2), Fraction(1, 3)):
        with pytest.raises(IrrationalError):
            root(value)
    with pytest.raises(IrrationalError):
        third * None
