"""Numbers stay exact, in written units, until a number kind converts them."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from graphkin.numbers.arithmetic import Kind, batch_kind
from graphkin.scene.expression import EvaluationError, UnreadableError, rational_ratio
from graphkin.scene.measures import quantity
from graphkin.scene.quantity import Quantity, exact, expression
from graphkin.text.errors import SceneError

SEVEN = {"n": Fraction(7)}
DIGITS = Kind(
    "digits",
    lambda value: mpmath.mpf(value.numerator) / value.denominator,
    mpmath.pi,
    mpmath.cos,
    mpmath.sin,
    mpmath.sqrt,
)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("30 + 2*n", 44),
        ("0.1 + 0.2", Fraction(3, 10)),
        ("0.12345678901234567890123", Fraction("0.12345678901234567890123")),
        ("1e-3", Fraction(1, 1000)),
        (" 2.5e+1 ", 25),
        (".5", Fraction(1, 2)),
        ("-2**2", -4),
        ("2**-1", Fraction(1, 2)),
        ("2**3**2", 512),
        ("-(n - 10)/3", 1),
        ("+n", 7),
        ("1 - 2 - 3", -4),
        ("12/4/3", 1),
        ("sqrt(9/16)", Fraction(3, 4)),
        ("sin(30) + cos(60) + tan(45)", 2),
        ("sin(-90)", -1),
        ("cos(180*n)", -1),
        ("tan(135)", -1),
        ("n**0", 1),
        ("( 30\n + 2*n )", 44),
    ],
)
def test_rational_expressions_are_exact(text: str, value: Fraction) -> None:
    number = expression(text).number(SEVEN)
    assert isinstance(number, Fraction)
    assert number == value


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("pi", math.pi),
        ("2*pi", 2 * math.pi),
        ("sqrt(2)", math.sqrt(2)),
        ("sin(10*n)", math.sin(math.radians(70))),
        ("cos(n)", math.cos(math.radians(7))),
        ("tan(n/2)", math.tan(math.radians(3.5))),
        ("n**0.5", math.sqrt(7)),
        ("2**(1/2) - sqrt(2)", 0.0),
        ("pi**2", math.pi**2),
        ("sin(sqrt(2))", math.sin(math.radians(math.sqrt(2)))),
    ],
)
def test_other_expressions_are_floats(text: str, value: float) -> None:
    assert expression(text).number(SEVEN) == pytest.approx(value, rel=1e-15, abs=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("44", "cm", 0.44),
        ("1", "in", 0.0254),
        ("250", "mm", 0.25),
        ("3", "m", 3.0),
        ("180", "deg", math.pi),
        ("2", "rad", 2.0),
        ("30", "rev/min", math.pi),
        ("370", "rev/min", 370 * math.pi / 30),
        ("5", "rad/s", 5.0),
        ("5", "rad/s²", 5.0),
        ("20", "mm/s", 0.02),
        ("20", "cm/s²", 0.2),
        ("90", "deg/s", math.pi / 2),
        ("2", "s", 2.0),
        ("sqrt(2)", "cm", math.sqrt(2) / 100),
        ("10*sqrt(2)", "in", 0.254 * math.sqrt(2)),
    ],
)
def test_si_is_metres_radians_and_seconds(text: str, unit: str, value: float) -> None:
    assert expression(text, unit).si({}) == pytest.approx(value, rel=4e-16)


def test_a_right_angle_is_exactly_a_quarter_turn() -> None:
    assert expression("90", "deg").direction({}) == 1j
    assert expression("-90 + 360*3", "deg").direction({}) == -1j
    assert expression("25.7*n + 0.1", "deg").direction(SEVEN) == -1
    assert expression("pi/2", "rad").direction({}) == pytest.approx(1j)
    assert expression("1", "rad").direction({}) == pytest.approx(complex(math.cos(1), math.sin(1)))
    assert expression("sqrt(2)", "deg").direction({}).imag == math.sin(math.radians(math.sqrt(2)))


def test_sixty_digits_come_from_the_same_tree() -> None:
    with mpmath.workdps(60):
        third = expression("n/3 + sin(40)", "cm").si(SEVEN, DIGITS)
        known = (mpmath.mpf(7) / 3 + mpmath.sin(mpmath.radians(40))) / 100
        assert abs(third - known) < mpmath.mpf(10) ** -58
        root = expression("sqrt(sin(40*sqrt(2)))").number({}, DIGITS)
        known = mpmath.sqrt(mpmath.sin(mpmath.radians(40 * mpmath.sqrt(2))))
        assert abs(root - known) < mpmath.mpf(10) ** -58
        way = expression("40*sqrt(2)", "deg").direction({}, DIGITS)
        assert abs(way - mpmath.expjpi(40 * mpmath.sqrt(2) / 180)) < mpmath.mpf(10) ** -58


@pytest.mark.parametrize(
    "text",
    ["30 + 2*n", "n/3", "1/n", "sqrt(n)", "sin(n) + cos(2*n)*tan(n)", "n**2 - 2**-n", "pi*n", "-n"],
)
def test_a_batch_agrees_with_each_scene(text: str) -> None:
    quantity = expression(text, "deg")
    many = np.arange(1, 31)
    batch = quantity.si({"n": many}, batch_kind())
    ways = quantity.direction({"n": many}, batch_kind())
    for value, each, way in zip(many, batch, ways, strict=True):
        one = {"n": Fraction(int(value))}
        assert each == pytest.approx(quantity.si(one), rel=1e-14)
        assert way == pytest.approx(quantity.direction(one), rel=1e-13)


def test_a_batch_masks_what_does_not_exist() -> None:
    many = {"n": np.array([6, 7, 8])}
    assert np.isfinite(expression("1/(n - 7)").number(many, batch_kind())).tolist() == [1, 0, 1]
    assert np.isnan(expression("sqrt(n - 7)").number(many, batch_kind())).tolist() == [1, 0, 0]
    assert expression("2*3").si(many, batch_kind()) == 6


def test_a_quantity_knows_what_it_uses() -> None:
    assert expression("30 + 2*n - pi*sin(m)").uses() == {"n", "m"}
    assert exact(0).is_zero() and expression("1 - 1").is_zero()
    assert not expression("n - n").is_zero()
    assert expression("30 + 2*n").written(SEVEN) == "44"
    assert expression("n", place="here") == expression("n", place="there")
    assert expression("30").negative().number({}) == -30


@pytest.mark.parametrize(
    ("text", "gives"),
    [
        ("9**9**9", "an exponent above 64"),
        ("2**(10**9)", "an exponent above 64"),
        ("((2**64)**64)**64", "a number that grows without bound"),
        ("10**(-65)", "an exponent above 64"),
        ("(pi**64)**64", "a number that grows without bound"),
        ("((pi*n)**64)**64", "a number that grows without bound with n = 7"),
        ("*".join(["(pi*n)**64"] * 4), "a number that grows without bound with n = 7"),
        ("1/0", "division by zero"),
        ("1/(n - 7)", "division by zero with n = 7"),
        ("0**-1", "division by zero"),
        ("sqrt(-1)", "the square root of a negative number"),
        ("sqrt(-pi)", "the square root of a negative number"),
        ("(-2)**0.5", "a broken power of a negative number"),
        ("(-pi)**0.5", "a broken power of a negative number"),
        ("tan(90)", "the tangent of a right angle"),
        ("tan(-270)", "the tangent of a right angle"),
        ("m + 1", "no value for m"),
    ],
)
def test_what_has_no_value_is_a_scene_error(text: str, gives: str) -> None:
    with pytest.raises(SceneError) as caught:
        expression(text, "cm", "links.1.A-B").number(SEVEN)
    (problem,) = caught.value.problems
    assert problem.place == "links.1.A-B"
    assert problem.found == f'"{text}" gives {gives}'
    assert problem.expected


@pytest.mark.parametrize(
    "text",
    [
        "",
        "  ",
        "__import__('os')",
        "().__class__",
        "n.real",
        "n[0]",
        "[1]",
        "lambda: 1",
        "1 if n else 2",
        "n == 7",
        "n and 1",
        "~1",
        "not n",
        "7 // 2",
        "7 % 2",
        "sqrt",
        "abs(n)(1)",
        "exec(n)",
        "sin(1, 2)",
        "sin(x=1)",
        "sin()",
        "1_000",
        "0x10",
        "1j",
        "010",
        "nan(1)",
        "2n",
        "2(n)",
        "2 n",
        "n^2",
        "1,5",
        "30°",
        "１２",
        "True",
        "None",
        "1e999",
        "1e-999",
        "1e99999999999999999999",
        "1" * 61,
        "n +",
        "1;2",
        "n := 1",
        "-" * 400 + "1",
        "(" * 240 + "1" + ")" * 240,
        "1+" * 200 + "1",
        "1" * 501,
        "n\x00",
        "\\u0031",
    ],
)
def test_nothing_but_sums_is_read(text: str) -> None:
    with pytest.raises((UnreadableError, SceneError)):
        expression(text).number({})


def test_derivatives_keep_their_units() -> None:
    law = expression("10*t", "deg")
    assert law.derivative("t").unit == "deg/s"
    assert law.derivative("t").derivative("t").unit == "deg/s²"
    assert expression("n**2", "cm").derivative("n").unit == "cm"
    assert law.derivative("t").si({"t": Fraction(0)}) == pytest.approx(math.pi / 18)
    assert expression("5*t**2", "cm").derivative("t").si({"t": Fraction(2)}) == 0.2


def test_the_tree_is_reckoned_again_for_each_setting() -> None:
    quantity: Quantity = expression("n/2")
    assert [quantity.number({"n": Fraction(n)}) for n in (1, 2)] == [Fraction(1, 2), 1]


@pytest.mark.parametrize(
    ("raw", "value"),
    [
        (np.int64(7), 7),
        (np.uint8(7), 7),
        (np.float64(0.1), Fraction(1, 10)),
        (np.float32(0.1), Fraction(1, 10)),
        (0.1, Fraction(1, 10)),
        (Fraction(1, 3), Fraction(1, 3)),
    ],
)
def test_numbers_of_every_kind_are_taken_exactly(raw: object, value: Fraction) -> None:
    assert quantity(raw, "", "here").number({}) == value


@pytest.mark.parametrize("function", ["sin", "cos", "tan"])
def test_ratios_of_whole_degrees_are_exact_where_niven_says_that_they_are_rational(function):
    """Sines 0, ±1/2, ±1; tangents 0, ±1 (Niven, Irrational Numbers, corollary 3.12)."""
    rational = (0, 1) if function == "tan" else (0, 0.5, 1)
    for degrees in range(-400, 401):
        if function == "tan" and degrees % 180 == 90:
            with pytest.raises(EvaluationError, match="right angle"):
                rational_ratio(function, Fraction(degrees))
            continue
        value = getattr(math, function)(math.radians(degrees))
        found = rational_ratio(function, Fraction(degrees))
        near = any(abs(abs(value) - each) < 1e-12 for each in rational)
        assert (found is not None) == near
        assert found is None or abs(found - value) < 1e-12
    assert rational_ratio(function, Fraction(1, 2)) is None
