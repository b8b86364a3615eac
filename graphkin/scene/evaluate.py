"""The value and the derivative of an expression: exact while it can be, then of a kind."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import isqrt
from typing import Any

from graphkin.numbers.arithmetic import Kind
from graphkin.numbers.arrays import np
from graphkin.scene.expression import (
    CONSTANT,
    WIDEST,
    Call,
    Minus,
    Name,
    Number,
    Pair,
    Tree,
    names,
)

LARGEST_POWER = 64
SINES = {0: 0, 30: 1, 90: 2, 150: 1, 180: 0, 210: -1, 270: -2, 330: -1}
"""Twice the sine of each whole angle whose sine is rational."""
TANGENTS = {0: 0, 45: 1, 135: -1}


class EvaluationError(ArithmeticError):
    """A value that does not exist or grows without bound: what is found, and what expected."""


BOUNDLESS = "a number that grows without bound", "a number between 1e-60 and 1e60"
NO_QUOTIENT = "division by zero", "a divisor that is not 0"
NO_ROOT = "the square root of a negative number", "0 or more under the root"


def evaluate(tree: Tree, values: Mapping[str, Any], kind: Kind) -> Any:
    """Value of a tree: a Fraction as long as only rational operations meet, else of the kind."""
    match tree:
        case Number(value):
            return value
        case Name(name):
            return kind.pi if name == CONSTANT else entered(values[name], kind)
        case Minus(inner):
            return -evaluate(inner, values, kind)
        case Pair(sign, left, right):
            return joined(sign, evaluate(left, values, kind), evaluate(right, values, kind), kind)
        case Call(function, inner):
            return called(function, evaluate(inner, values, kind), kind)


def entered(value: Any, kind: Kind) -> Any:
    """A parameter as it enters a reckoning: exact as a Fraction, an array as the kind has it."""
    if isinstance(value, int):
        return Fraction(value)
    return kind.number(value) if hasattr(value, "shape") else value


def joined(sign: str, left: Any, right: Any, kind: Kind) -> Any:
    """Sum, difference, product, quotient, rest or power of two numbers, exact where both are."""
    if sign == "**":
        return power(left, right, kind)
    exact = isinstance(left, Fraction) and isinstance(right, Fraction)
    if not exact:
        left, right = inexact(left, kind), inexact(right, kind)
    match sign:
        case "+":
            found = left + right
        case "-":
            found = left - right
        case "*":
            found = left * right
        case "/":
            found = quotient(left, right)
        case _ if exact:
            found = left - right * (quotient(left, right) // 1)
        case _:
            raise EvaluationError(
                "the rest of a number that is not rational", "whole numbers, decimals or fractions"
            )
    return bounded(found) if exact else found


def inexact(value: Any, kind: Kind) -> Any:
    """An exact number as the kind has it; anything else as it is."""
    return kind.number(value) if isinstance(value, Fraction) else value


def quotient(left: Any, right: Any) -> Any:
    """Left over right; over nought it raises on one scene and is masked in a batch."""
    if not hasattr(right, "shape") and right == 0:
        raise EvaluationError(*NO_QUOTIENT)
    return left / right


def bounded(value: Fraction) -> Fraction:
    """An exact number, refused when it has grown beyond sense."""
    if max(value.numerator.bit_length(), value.denominator.bit_length()) > WIDEST:
        raise EvaluationError(*BOUNDLESS)
    return value


def power(base: Any, exponent: Any, kind: Kind) -> Any:
    """Base to an exponent of at most 64; whole powers of exact numbers stay exact."""
    if not hasattr(exponent, "shape") and abs(exponent) > LARGEST_POWER:
        expected = f"an exponent from -{LARGEST_POWER} to {LARGEST_POWER}"
        raise EvaluationError(f"an exponent above {LARGEST_POWER}", expected)
    if isinstance(exponent, Fraction) and exponent.denominator == 1:
        whole = int(exponent)
        if whole < 0:
            return quotient(Fraction(1), power(base, -exponent, kind))
        return bounded(base**whole) if isinstance(base, Fraction) else base**whole
    if not hasattr(base, "shape") and not hasattr(exponent, "shape"):
        if base < 0:
            raise EvaluationError(
                "a broken power of a negative number", "a whole exponent, or a base of 0 or more"
            )
        if base == 0 and exponent < 0:
            raise EvaluationError(*NO_QUOTIENT)
    return inexact(base, kind) ** inexact(exponent, kind)


def called(function: str, value: Any, kind: Kind) -> Any:
    """Square root, sine, cosine or tangent; angles in degrees, reduced exactly where exact."""
    if function == "sqrt":
        return root(value, kind)
    if isinstance(value, Fraction):
        rational = rational_ratio(function, value)
        if rational is not None:
            return rational
    if not isinstance(value, Fraction | float) and not hasattr(value, "shape"):
        value = value * (kind.pi / 180)
        sine, cosine = kind.sin(value), kind.cos(value)
    else:
        way = kind.direction(value)
        sine, cosine = way.imag, way.real
    if function == "tan":
        return quotient(sine, cosine)
    return sine if function == "sin" else cosine


def rational_ratio(function: str, degrees: Fraction) -> Fraction | None:
    """Sine, cosine or tangent where it is rational; None where it is not."""
    if degrees.denominator != 1:
        return None
    whole = int(degrees)
    if function == "tan":
        if whole % 180 == 90:
            raise EvaluationError(
                "the tangent of a right angle", "an angle that is no odd multiple of 90°"
            )
        tangent = TANGENTS.get(whole % 180)
        return None if tangent is None else Fraction(tangent)
    doubled = SINES.get((whole + 90 if function == "cos" else whole) % 360)
    return None if doubled is None else Fraction(doubled, 2)


def root(value: Any, kind: Kind) -> Any:
    """Square root; exact for squares of rationals; of a negative number EvaluationError."""
    if isinstance(value, Fraction):
        if value < 0:
            raise EvaluationError(*NO_ROOT)
        above, below = isqrt(value.numerator), isqrt(value.denominator)
        if above * above == value.numerator and below * below == value.denominator:
            return Fraction(above, below)
        return kind.sqrt(kind.number(value))
    if not hasattr(value, "shape") and value < 0:
        raise EvaluationError(*NO_ROOT)
    return kind.sqrt(value)


UNIT = 2.0**-53
"""Share of itself by which one operation in doubles is off at most; a function by up to four."""


def with_error(tree: Tree, values: Mapping[str, Any], kind: Kind) -> tuple[Any, Any]:
    """The value of a tree in doubles, and a bound of its error; 0 as long as it is exact.

    Errors add up to first order. Arrays among the values count as exact.
    """
    match tree:
        case Number() | Name():
            value = evaluate(tree, values, kind)
            return value, UNIT * value if tree == Name(CONSTANT) else 0
        case Minus(inner):
            value, error = with_error(inner, values, kind)
            return -value, error
        case Pair(sign, first, second):
            left, right = with_error(first, values, kind), with_error(second, values, kind)
            value = joined(sign, left[0], right[0], kind)
            if isinstance(value, Fraction):
                return value, 0
            return value, joined_error(sign, rounded(*left, kind), rounded(*right, kind), value)
        case Call(function, inner):
            argument, error = with_error(inner, values, kind)
            value = called(function, argument, kind)
            if isinstance(value, Fraction):
                return value, 0
            return value, called_error(function, error, value)


def rounded(value: Any, error: Any, kind: Kind) -> tuple[Any, Any]:
    """A number in doubles with its error, which an exact one has from then on."""
    if not isinstance(value, Fraction):
        return value, error
    near = kind.number(value)
    return near, UNIT * abs(near)


def joined_error(sign: str, left: tuple[Any, Any], right: tuple[Any, Any], value: Any) -> Any:
    """The error of two numbers joined, from theirs."""
    (a, off_a), (b, off_b) = left, right
    own = UNIT * abs(value)
    match sign:
        case "+" | "-":
            return off_a + off_b + own
        case "*":
            return abs(a) * off_b + abs(b) * off_a + own
        case "/":
            return (off_a + abs(value) * off_b) / abs(b) + own
    sized = abs(a) + (a == 0)
    grown = abs(b) * off_a / sized + abs(np.log(sized)) * off_b
    return abs(value) * grown + (4 + abs(b)) * own


def called_error(function: str, error: Any, value: Any) -> Any:
    """The error of a root or of a sine, cosine or tangent of degrees, from that of the argument."""
    if function == "sqrt":
        return error / (2 * abs(value) + (value == 0)) + UNIT * abs(value)
    turned = error / 57 + 4 * UNIT
    return turned * (1 + value * value) if function == "tan" else turned


NOUGHT = Number(Fraction(0))
ONE = Number(Fraction(1))
DEGREE = Pair("/", Name(CONSTANT), Number(Fraction(180)))


def differentiated(tree: Tree, name: str) -> Tree:
    """The tree of the derivative by a name; EvaluationError when an exponent holds the name."""
    match tree:
        case Number():
            return NOUGHT
        case Name(own):
            return ONE if own == name else NOUGHT
        case Minus(inner):
            return times(Number(Fraction(-1)), differentiated(inner, name))
        case Pair("+" | "-" as sign, left, right):
            return plus(sign, differentiated(left, name), differentiated(right, name))
        case Pair("*", left, right):
            one = times(differentiated(left, name), right)
            return plus("+", one, times(left, differentiated(right, name)))
        case Pair("/", left, right):
            return quotient_rule(left, right, name)
        case Pair(_, base, exponent):
            return power_rule(base, exponent, name)
        case Call(function, inner):
            return times(slope(function, inner), differentiated(inner, name))


def quotient_rule(left: Tree, right: Tree, name: str) -> Tree:
    """Derivative of left over right."""
    above, below = differentiated(left, name), differentiated(right, name)
    first = NOUGHT if above == NOUGHT else Pair("/", above, right)
    if below == NOUGHT:
        return first
    return plus("-", first, Pair("/", times(left, below), Pair("*", right, right)))


def power_rule(base: Tree, exponent: Tree, name: str) -> Tree:
    """Derivative of a power whose exponent does not hold the name."""
    if name in names(exponent):
        raise EvaluationError(f"an exponent that holds {name}", f"an exponent without {name}")
    inner = differentiated(base, name)
    if NOUGHT in (exponent, inner):
        return NOUGHT
    if exponent == ONE:
        return inner
    less = Number(exponent.value - 1) if isinstance(exponent, Number) else Pair("-", exponent, ONE)
    return times(times(exponent, Pair("**", base, less)), inner)


def slope(function: str, inner: Tree) -> Tree:
    """Derivative of a function by its own argument, angles in degrees."""
    if function == "sqrt":
        return Pair("/", Number(Fraction(1, 2)), Call("sqrt", inner))
    if function == "sin":
        return times(Call("cos", inner), DEGREE)
    if function == "cos":
        return times(Number(Fraction(-1)), times(Call("sin", inner), DEGREE))
    square = Pair("**", Call("tan", inner), Number(Fraction(2)))
    return times(Pair("+", ONE, square), DEGREE)


def plus(sign: str, left: Tree, right: Tree) -> Tree:
    """A sum or a difference without idle noughts."""
    if right == NOUGHT:
        return left
    if left == NOUGHT:
        return right if sign == "+" else Minus(right)
    return Pair(sign, left, right)


def times(left: Tree, right: Tree) -> Tree:
    """A product without idle noughts and ones."""
    if NOUGHT in (left, right):
        return NOUGHT
    if left == ONE:
        return right
    return left if right == ONE else Pair("*", left, right)
