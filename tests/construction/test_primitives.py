"""Rounding of the primitives: each within its bound, against 60 digits on the same numbers.

eps = 2^-52, s = sine of the angle at which the loci cross. The generators are scaled by
logarithms, for the errors lie where sizes differ by powers of ten and lines cross flatly.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.errors import UnsatisfiedAssumption

from graphkin.construction import normal_component
from graphkin.construction.centres.instant_centre import acceleration_pole, instant_centre
from graphkin.construction.core import vocabulary
from graphkin.construction.links import dyad_by_arcs
from graphkin.construction.velocity.relative_motion import square_to
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.plane import (
    Circle,
    Line,
    circle_meets_circle,
    line_meets_circle,
    line_meets_line,
)
from tests.mechanisms import directions, log_scaled, signs

EPS = 2.0**-52
MANY = settings(max_examples=75, deadline=None, derandomize=True, database=None)


def mpc(z: complex) -> Any:
    """A point in 60 digits."""
    return mpmath.mpc(z)


def cross(u, v):
    """Signed area in 60 digits."""
    return u.real * v.imag - u.imag * v.real


def dot(u, v):
    """Scalar product in 60 digits."""
    return u.real * v.real + u.imag * v.imag


def exactly(function: Callable) -> Callable:
    """Reckon with 60 digits."""

    def in_sixty_digits(*args):
        with mpmath.workdps(60):
            return function(*args)

    in_sixty_digits.__doc__ = function.__doc__
    return in_sixty_digits


def offsets() -> st.SearchStrategy[complex]:
    """Where the drawing lies: at the origin, or up to 1e8 away."""
    far = st.builds(lambda size, way: size * way, log_scaled(1, 1e8), directions())
    return st.just(0j) | far


# --- line and line -------------------------------------------------------------------------------


@st.composite
def two_lines(draw):
    """Two lines crossing at 1e-12 to 1 radian, their anchors up to 1e6 away from the crossing."""
    way = draw(directions())
    lean = draw(log_scaled(1e-12, 1)) * draw(signs())
    crossing = draw(offsets())
    near, far = draw(log_scaled(1e-6, 1)) * draw(signs()), draw(log_scaled(1e-3, 1)) * draw(signs())
    sizes = draw(log_scaled(1e-6, 1e6)), draw(log_scaled(1e-6, 1e6))
    other = way * rect(1, lean)
    return Line(crossing + near * way, sizes[0] * way), Line(
        crossing + far * other, sizes[1] * other
    )


@exactly
def lines_within(meet: Callable, lines: tuple[Line, Line]) -> bool:
    """Error at most 4·eps·(L/s + abs X), L the gap of the anchors and the shorter step."""
    m, n = lines
    p, u, q, v = mpc(m.point), mpc(m.along), mpc(n.point), mpc(n.along)
    area = cross(u, v)
    if area == 0 or p == q:
        raise UnsatisfiedAssumption
    exact = p + u * cross(q - p, v) / area
    sine = abs(area) / (abs(u) * abs(v))
    length = abs(q - p) + min(abs(exact - p), abs(exact - q))
    return abs(mpc(meet(m, n)) - exact) <= 4 * EPS * (length / sine + abs(exact))


@MANY
@given(two_lines())
def test_lines_meet_within_4_eps_of_length_over_sine(lines):
    assert lines_within(line_meets_line, lines)


@MANY
@given(two_lines())
def test_the_margin_of_a_crossing_is_its_sine(lines):
    m, n = lines
    with mpmath.workdps(60):
        u, v = mpc(m.along), mpc(n.along)
        sine = abs(cross(u, v)) / (abs(u) * abs(v))
        assert abs(vocabulary.meet.margin(m, n) - sine) <= 4 * EPS


# --- circle and circle ---------------------------------------------------------------------------


@st.composite
def two_circles(draw):
    """Radii 1e-6 to 1 of one another, crossing at 1e-12 to 1 radian or anywhere up to square."""
    small, large = draw(log_scaled(1e-6, 1)), draw(log_scaled(0.1, 10))
    radii = (small * large, large) if draw(st.booleans()) else (large, small * large)
    flat = draw(log_scaled(1e-12, 1))
    angle = flat if draw(st.booleans()) else mpmath.pi - flat
    with mpmath.workdps(30):
        square = radii[0] ** 2 + radii[1] ** 2 - 2 * radii[0] * radii[1] * mpmath.cos(angle)
        distance = float(mpmath.sqrt(abs(square)))
    centre = draw(offsets())
    other = centre + distance * draw(directions())
    assume(other != centre)
    return Circle(centre, radii[0]), Circle(other, radii[1]), draw(signs())


def touching(r, t, d) -> bool:
    """Whether two circles touch as nearly as their distance can be written."""
    return min(r + t - d, d - abs(r - t)) <= 4 * EPS * (r + t + d)


@exactly
def circles_within(meet: Callable, sample: tuple[Circle, Circle, int]) -> bool:
    """Error at most 4·eps·((r1+r2+d)/s + abs X); below s = 1e-6, half of sqrt(eps)·L."""
    m, n, side = sample
    p, q, r, t = mpc(m.centre), mpc(n.centre), mpmath.mpf(m.radius), mpmath.mpf(n.radius)
    d = abs(q - p)
    product = (d + r + t) * (d + r - t) * (d - r + t) * (r + t - d)
    if product <= 0:
        raise UnsatisfiedAssumption
    height = mpmath.sqrt(product) / (2 * d)
    along = (d * d + (r - t) * (r + t)) / (2 * d)
    exact = p + (along + side * 1j * height) * (q - p) / d
    sine = mpmath.sqrt(product) / (2 * r * t)
    length = r + t + d
    try:
        found = mpc(meet(m, n, side))
    except ValueError:
        return touching(r, t, d)
    bound = 4 * EPS * (length / sine + abs(exact))
    if sine < 1e-6:
        bound = min(bound, mpmath.sqrt(EPS) / 2 * length + 4 * EPS * abs(exact))
    return abs(found - exact) <= bound


@MANY
@given(two_circles())
def test_circles_meet_within_4_eps_of_lengths_over_sine(sample):
    assert circles_within(circle_meets_circle, sample)


@MANY
@given(two_circles())
def test_the_margin_of_two_arcs_is_the_sine_of_their_crossing(sample):
    """To 16·eps·(r1+r2+d)/(r·s), r the smaller radius."""
    m, n, side = sample
    with mpmath.workdps(60):
        d = abs(mpc(n.centre) - mpc(m.centre))
        r, t = mpmath.mpf(m.radius), mpmath.mpf(n.radius)
        product = (d + r + t) * (d + r - t) * (d - r + t) * (r + t - d)
        assume(product > 0 and not touching(r, t, d))
        sine = mpmath.sqrt(product) / (2 * r * t)
        found = dyad_by_arcs.arcs_meet.margin(m, n, side)
        smaller = min(r, t)
        assert abs(found - sine) <= 16 * EPS * ((r + t + d) / smaller / sine)


# --- line and circle -----------------------------------------------------------------------------


@st.composite
def line_and_circle(draw):
    """The line passes the centre at up to a radius less 1e-12 of it; anchor near or far."""
    radius, way = draw(log_scaled(1e-6, 10)), draw(directions())
    height = 1 - draw(log_scaled(1e-12, 1)) if draw(st.booleans()) else draw(log_scaled(1e-12, 1))
    away = draw(log_scaled(1e-6, 1e2)) * draw(signs())
    centre = draw(offsets())
    start = centre + (away + 1j * height * radius * draw(signs())) * way
    return Line(start, way * draw(log_scaled(1e-6, 1e6))), Circle(centre, radius), draw(signs())


@exactly
def cut_within(cut: Callable, sample: tuple[Line, Circle, int]) -> bool:
    """Error at most 8·eps·((r + PC)/s + abs X)."""
    line, circle, way = sample
    p, u = mpc(line.point), mpc(line.along)
    c, r = mpc(circle.centre), mpmath.mpf(circle.radius)
    unit = u / abs(u)
    along, height = dot(unit, c - p), cross(unit, c - p)
    square = (r - height) * (r + height)
    if square <= 0:
        raise UnsatisfiedAssumption
    exact = p + (along + way * mpmath.sqrt(square)) * unit
    sine = mpmath.sqrt(square) / r
    try:
        found = mpc(cut(line, circle, way))
    except ValueError:
        return sine < 1e-6
    return abs(found - exact) <= 8 * EPS * ((r + abs(c - p)) / sine + abs(exact))


@MANY
@given(line_and_circle())
def test_a_line_cuts_a_circle_within_8_eps_of_lengths_over_sine(sample):
    assert cut_within(line_meets_circle, sample)


# --- point of a plate ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Plate:
    """Three points of a link, the last near its line or not, and the images of the first two."""

    points: tuple[complex, complex, complex]
    images: tuple[complex, complex]


@st.composite
def plates(draw):
    """Points beside the line by 1e-12 to 1, images anywhere."""
    base = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    beside = draw(log_scaled(1e-12, 1)) * draw(signs())
    part = draw(log_scaled(1e-3, 1e3)) * draw(signs())
    first = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    image = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    # The image of the base is square to the base, as it is in every velocity plan.
    second = image + 1j * base * draw(log_scaled(1e-3, 1e3)) * draw(signs())
    return Plate((first, first + base, first + base * part * complex(1, beside)), (image, second))


@exactly
def plate_within(construct: Callable, plate: Plate) -> bool:
    """Error at most 8·eps·(abs c + abs(b - a)·AC/AB)."""
    (p, q, r), (a, b) = map(mpc, plate.points), map(mpc, plate.images)
    exact = a + (b - a) * (r - p) / (q - p)
    bound = 8 * EPS * (abs(exact) + abs(b - a) * abs(r - p) / abs(q - p))
    try:
        found = mpc(construct(plate))
    except ZeroDivisionError:
        return False
    return abs(found - exact) <= bound


def by_similarity(plate: Plate) -> complex:
    """As the plans do it."""
    ratio = vocabulary.in_proportion(*plate.points)
    return vocabulary.similar_point(*plate.images, ratio)


@MANY
@given(plates())
def test_a_plate_point_is_similar_within_8_eps_also_beside_the_line(plate):
    assert plate_within(by_similarity, plate)


# --- normal component ----------------------------------------------------------------------------


@st.composite
def spokes(draw):
    """A bar and the velocity of its end: from slow to fast, and of any order of magnitude."""
    way = draw(directions())
    if draw(st.booleans()):
        bar = draw(log_scaled(1e-6, 1e6)) * way
        return bar, draw(log_scaled(1e-8, 1e2)) * 1j * bar
    length, normal = draw(log_scaled(1e-200, 1e200)), draw(log_scaled(1e-200, 1e200))
    return length * way, length**0.5 * normal**0.5 * 1j * way


@exactly
def normal_within(normal: Callable, spoke: tuple[complex, complex]) -> bool:
    """Relative error at most 2·eps, and as much again where lengths are of coordinates."""
    bar, speed = mpc(spoke[0]), mpc(spoke[1])
    exact = -bar * (abs(speed) / abs(bar)) ** 2
    try:
        found = normal(0j, spoke[0], 0j, spoke[1])
    except (OverflowError, ZeroDivisionError):
        return False
    straight = bar.imag == 0 and speed.real == 0
    return abs(mpc(found) - exact) <= (2 if straight else 4) * EPS * abs(exact)


@MANY
@given(spokes())
def test_the_normal_component_is_right_to_2_eps(spoke):
    assert normal_within(normal_component.normal, spoke)


# --- acceleration pole ---------------------------------------------------------------------------


@st.composite
def accelerations(draw):
    """A bar with the accelerations of its ends, nearly equal at times: the pole is far away."""
    p = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    bar = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    first = draw(log_scaled(1e-3, 1e3)) * draw(directions())
    apart = draw(log_scaled(1e-12, 1e3)) * draw(directions())
    assume(first + apart != first)
    return p, p + bar, first, first + apart


@exactly
def pole_within(pole: Callable, sample: tuple[complex, ...]) -> bool:
    """The inverse distance of the pole is right to 4·eps, relatively."""
    p, q, a, b = map(mpc, sample)
    exact = (b - a) / (-a * (q - p))
    inverse = pole(*sample)
    return abs(mpc(inverse) - exact) <= 4 * EPS * abs(exact)


def inverse_of_ratio(p: complex, q: complex, a: complex, b: complex) -> complex:
    """One over the way to the pole, from the two parts that are kept apart."""
    pole = acceleration_pole(0j, p, q, a, b)
    return pole.size / pole.shift


@MANY
@given(accelerations())
def test_the_inverse_distance_of_the_acceleration_pole_is_right_to_4_eps(sample):
    assert pole_within(inverse_of_ratio, sample)


def test_a_pole_and_a_centre_at_infinity_keep_their_direction():
    """All points alike in motion: no division, and the way to the centre is square to it."""
    pole = acceleration_pole(0j, 0j, 2 + 0j, 3j, 3j)
    assert (pole.size, pole.shift) == (0, -6j)
    centre = instant_centre(0j, 0j, 2 + 0j, 3 + 0j, 3 + 0j)
    assert (centre.size, centre.shift) == (0, 12j)


# --- four-bar as a whole: the 1-2-3 law ----------------------------------------------------------


@st.composite
def flat_dyads(draw):
    """A dyad RRR crossing at 1e-4 to 1, the velocities and accelerations of its ends."""
    lean = draw(log_scaled(1e-4, 1)) * draw(signs())
    sizes = draw(log_scaled(1e-2, 1)), draw(log_scaled(1e-2, 1))
    way = draw(directions())
    inner = draw(log_scaled(1e-2, 1)) * draw(directions())
    ends = inner + sizes[0] * way, inner + sizes[1] * way * rect(1, lean)
    moves = [draw(log_scaled(1e-2, 1)) * draw(directions()) for _ in range(4)]
    return (*ends, inner, *moves)


@exactly
def dyad_within(sample: tuple[complex, ...]) -> tuple[bool, bool]:
    """Velocity to 4·eps·(L/lmin)/s², acceleration to 8·eps·(L/lmin)/s³, normwise."""
    p, q, x, v, w, a, b = sample
    square, meet = square_to, vocabulary.meet
    image = meet(square(v, p, x), square(w, q, x))
    corners = (
        (start + normal_component.normal(end, x, image_end, image))
        for start, end, image_end in ((a, p, v), (b, q, w))
    )
    lines = [square(c, end, x) for c, end in zip(corners, (p, q), strict=True)]
    second = meet(*lines)
    P, Q, X, V, W, A, B = map(mpc, sample)
    u, t = X - P, X - Q
    area = cross(u, t)
    # v·u and v·t are known, so are a·u and a·t: the same 2×2 for both.
    solve = exact_solution(u, t, area)
    exact = solve(dot(V, u), dot(W, t))
    rest = (dot(A, u) - abs(exact - V) ** 2, dot(B, t) - abs(exact - W) ** 2)
    exact_second = solve(*rest)
    lengths = abs(u), abs(t), abs(Q - P)
    sine = abs(area) / (abs(u) * abs(t))
    ratio = max(lengths) / min(abs(u), abs(t))
    speed = max(abs(V), abs(W), abs(exact))
    pull = max(abs(A), abs(B), abs(exact_second), speed**2 / min(abs(u), abs(t)))
    return (
        abs(mpc(image) - exact) <= 4 * EPS * ratio / sine**2 * speed,
        abs(mpc(second) - exact_second) <= 8 * EPS * ratio / sine**3 * pull,
    )


def exact_solution(u, t, area):
    """The vector with given scalar products with two others."""
    return lambda along_u, along_t: 1j * (along_t * u - along_u * t) / area


@MANY
@given(flat_dyads())
def test_errors_of_a_flat_dyad_grow_as_the_square_and_the_cube_of_one_over_the_sine(sample):
    assert dyad_within(sample) == (True, True)


# --- directions ----------------------------------------------------------------------------------


@st.composite
def turned(draw):
    """Exact degrees: a small or a large part of a turn beside whole quarters, and many turns."""
    beside = Fraction(draw(log_scaled(1e-12, 45))) * draw(signs())
    quarters = draw(st.integers(-4, 4)) + 4 * draw(st.integers(-1000, 1000))
    return 90 * quarters + beside


@MANY
@given(turned())
def test_each_coordinate_of_a_direction_is_right_to_2_eps_also_beside_the_axes(degrees):
    with mpmath.workdps(80):
        exact = mpmath.expjpi(mpmath.mpf(degrees.numerator) / degrees.denominator / 180)
        found = FLOAT.direction(degrees)
        for mine, true in ((found.real, exact.real), (found.imag, exact.imag)):
            assert abs(mpmath.mpf(mine) - true) <= 2 * EPS * abs(true)
