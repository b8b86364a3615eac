"""Expressions as a lecturer writes them ("30 + 2*n"), read into a small tree and never executed.

Python's own parser gives the structure. Only numbers, names, + - * / **, a leading minus, brackets
and four functions are accepted. Every number keeps the digits it was written with.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from itertools import pairwise
from math import isqrt
from threading import Lock
from typing import Any, NoReturn

from msgspec import Struct

from graphkin.numbers.arithmetic import Kind, np
from graphkin.scene.findings import shown, visible
from graphkin.text.errors import Hint, Mend

FUNCTIONS = ("sqrt", "sin", "cos", "tan")
"""Functions of one number; sine, cosine and tangent take degrees."""
CONSTANT = "pi"
TIME = "t"
RESERVED = frozenset((*FUNCTIONS, CONSTANT, TIME))
"""Names that no parameter may have."""

ONE_AT_A_TIME = Lock()
"""Lock for Python's parser, because requests to the studio arrive in several threads.

Two threads at once may cause "AST constructor recursion depth mismatch" on Python 3.11.7.
"""
LONGEST = 500
DEEPEST = 60
WIDEST = 1000
"""The most bits above or below the fraction bar of a number."""
FARTHEST = 60
"""The largest power of ten of a number as written."""
DIGITS = 60
HEAVIEST = 2000
"""The most parts of a law of time and of its first derivative."""

UNITS = ("degrees", "degree", "deg", "°", "rad", "grad", "rpm", "mm", "cm", "dm", "in", "m", "s")
RATES = ("mm/s", "cm/s", "m/s", "in/s", "rev/min", "rot/min", "rad/s", "deg/s", "°/s")
MEASURED = rf"(?as)(.*[\w.)\s])((?<![A-Za-z_])(?:{'|'.join((*RATES, *UNITS))})|°)"
"""A number or an expression followed by a unit."""
MARKS = "_.+-*/() \t\r\n"
JUXTAPOSED = r"(?a)(?<![A-Za-z0-9_.])(?>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*[A-Za-z_(]"
DECIMAL = frozenset("0123456789.eE+-")
"""The characters of a decimal number."""
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**", ast.Mod: "mod"}
REST = r"\bmod\b"
"""The operator of a remainder: ``number mod 30``."""


class UnreadableError(ValueError):
    """An unreadable expression or number: what was found, and a hint."""

    def __init__(self, found: str, hint: Hint = "") -> None:
        super().__init__(found)
        self.found = found
        self.hint = hint


class Number(Struct, frozen=True):
    """An exact number."""

    value: Fraction


class Name(Struct, frozen=True):
    """A parameter, the time ``t`` or ``pi``."""

    name: str


class Minus(Struct, frozen=True):
    """The negative of an expression."""

    inner: Tree


class Pair(Struct, frozen=True):
    """Two parts joined by one of + - * / ** or mod, the remainder of a division."""

    sign: str
    left: Tree
    right: Tree


class Call(Struct, frozen=True):
    """A function of one number; the angle of a sine is in degrees."""

    function: str
    inner: Tree


Tree = Number | Name | Minus | Pair | Call


def parse(text: str, *, counting: bool = False) -> Tree:
    """The tree of an expression. Raises UnreadableError with the part that could not be read.

    ``counting`` accepts remainders (``number mod 30``), which only exact numbers have.
    """
    if len(text) > LONGEST:
        raise UnreadableError(f"an expression of {len(text)} characters", f"at most {LONGEST}")
    flat = " ".join(text.split())
    if "mod" in text and re.search(REST, text):
        if not counting:
            raise UnreadableError('"mod" in an expression', "only formulas of a lab.toml have it")
        refuse_foreign(re.sub(REST, "*", text))
        flat = re.sub(REST, "%", flat)
    else:
        refuse_foreign(text)
    try:
        with ONE_AT_A_TIME:
            body = ast.parse(flat, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise UnreadableError(f"{shown(' '.join(text.split()))} is not an expression") from None
    return convert(body, flat, 0)


def unit_hint(text: str) -> Hint:
    """A hint for a number followed by a unit; empty for other texts."""
    bare = text.strip()
    measured = re.fullmatch(MEASURED, bare) if bare.endswith((*RATES, *UNITS)) else None
    rest = measured[1].strip() if measured else ""
    if not measured or not rest or rest[-1] in "+-*/(":
        return ""
    hint = f"the unit is stated once in units: write {rest}"
    if len(measured[2]) > 1 or measured[2] == "°":
        return Mend(bare, rest, hint)
    return f"{hint}; a product has its *"


def refuse_foreign(text: str) -> None:
    """Raise UnreadableError for characters and forms that no expression has, with a correction."""
    hint = unit_hint(text)
    if hint:
        raise UnreadableError(f"{shown(text.strip())} has a unit", hint)
    foreign = next((c for c in text if not (c.isascii() and c.isalnum()) and c not in MARKS), "")
    if foreign:
        hints: dict[str, Hint] = {
            "^": Mend("^", "**", "write a power as **"),
            ",": Mend(",", ".", "write a decimal point"),
            "°": Mend("°", "", "leave out °"),
        }
        raise UnreadableError(f"'{visible(foreign)}' in an expression", hints.get(foreign, ""))
    if not text.strip():
        raise UnreadableError("an empty expression")
    joined = re.search(JUXTAPOSED, text) if runs_on(text) else None
    if joined:
        hint = (
            "write plain digits"
            if joined.group()[-1] in "_xXoObBjJ"
            else "write a product with *: 2*n"
        )
        raise UnreadableError(f'"{joined.group()}" in an expression', hint)


def runs_on(text: str) -> bool:
    """Whether a letter or a bracket follows a digit directly; a name may contain this, too."""
    bare = "".join(text.split())
    return any(
        (one.isdigit() or one == ".") and (after == "(" or after.isidentifier())
        for one, after in pairwise(bare)
    )


def convert(node: ast.expr, text: str, depth: int) -> Tree:
    """The tree of a part of Python's tree, if it is allowed."""
    if depth > DEEPEST:
        raise UnreadableError(f"an expression nested more than {DEEPEST} deep")
    match node:
        case ast.Constant():
            return Number(decimal(text[node.col_offset : node.end_col_offset]))
        case ast.Name(id=name):
            return Name(name)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return Minus(convert(inner, text, depth + 1))
        case ast.UnaryOp(op=ast.UAdd(), operand=inner):
            return convert(inner, text, depth + 1)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in SIGNS:
            sign = SIGNS[type(op)]
            return Pair(sign, convert(left, text, depth + 1), convert(right, text, depth + 1))
        case ast.Call(func=ast.Name(id=name), args=[inner], keywords=[]) if name in FUNCTIONS:
            return Call(name, convert(inner, text, depth + 1))
    return refuse(node, text)


def refuse(node: ast.expr, text: str) -> NoReturn:
    """Raise UnreadableError that names the part of an expression that is not allowed."""
    part = visible(text[node.col_offset : node.end_col_offset]).replace("%", "mod")
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        raise UnreadableError(
            f'"{part}" in an expression', f"functions of one number are {', '.join(FUNCTIONS)}"
        )
    raise UnreadableError(
        f'"{part}" in an expression', "it may hold + - * / **, brackets and functions"
    )


def decimal(text: str) -> Fraction:
    """The exact value of a decimal number as written; underscores, nan and inf are refused."""
    try:
        if not DECIMAL.issuperset(text):
            raise InvalidOperation
        number = Decimal(text)
    except InvalidOperation:
        raise UnreadableError(f"{text[:40]} is not a finite decimal number") from None
    if len(number.as_tuple().digits) > DIGITS:
        raise UnreadableError(f"a number of more than {DIGITS} digits")
    if number and abs(number.adjusted()) > FARTHEST:
        raise UnreadableError(
            f"{text[:40]} is out of range", f"numbers lie between 1e-{FARTHEST} and 1e{FARTHEST}"
        )
    return Fraction(number) if number else Fraction(0)


def integer(value: int) -> Fraction:
    """The exact value of a whole number. Raises UnreadableError if it has too many digits."""
    if value.bit_length() > FARTHEST * 10 // 3:
        raise UnreadableError("a whole number with too many digits", f"at most 1e{FARTHEST}")
    return Fraction(value)


def size(tree: Tree) -> int:
    """Number of parts of an expression."""
    match tree:
        case Number() | Name():
            return 1
        case Minus(inner) | Call(_, inner):
            return 1 + size(inner)
        case Pair(_, left, right):
            return 1 + size(left) + size(right)


def names(tree: Tree) -> frozenset[str]:
    """The names in an expression: parameters and the time, but not ``pi``."""
    match tree:
        case Number():
            return frozenset()
        case Name(name):
            return frozenset((name,)) - {CONSTANT}
        case Minus(inner) | Call(_, inner):
            return names(inner)
        case Pair(_, left, right):
            return names(left) | names(right)


# --- the value and the derivative of an expression: exact where possible, else of a kind ----------


LARGEST_POWER = 64
SINES = {0: 0, 30: 1, 90: 2, 150: 1, 180: 0, 210: -1, 270: -2, 330: -1}
"""Twice the sine of each whole angle whose sine is rational."""
TANGENTS = {0: 0, 45: 1, 135: -1}


class EvaluationError(ArithmeticError):
    """A value that does not exist or is too large: what was found, and what was expected."""


BOUNDLESS = "a number that grows without bound", "a number between 1e-60 and 1e60"
NO_QUOTIENT = "division by zero", "a divisor that is not 0"
NO_ROOT = "the square root of a negative number", "0 or more under the root"


def evaluate(tree: Tree, values: Mapping[str, Any], kind: Kind) -> Any:
    """The value of a tree: a Fraction for rational operations only, otherwise of the kind."""
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
    """A parameter as used in a computation: an exact Fraction, or an array of the kind."""
    if isinstance(value, int):
        return Fraction(value)
    return kind.number(value) if hasattr(value, "shape") else value


def joined(sign: str, left: Any, right: Any, kind: Kind) -> Any:
    """Sum, difference, product, quotient, remainder or power, exact where both numbers are."""
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
    """An exact number converted to the kind; anything else unchanged."""
    return kind.number(value) if isinstance(value, Fraction) else value


def quotient(left: Any, right: Any) -> Any:
    """Left over right; division by zero raises on one scene and is masked in a batch."""
    if not hasattr(right, "shape") and right == 0:
        raise EvaluationError(*NO_QUOTIENT)
    return left / right


def bounded(value: Fraction) -> Fraction:
    """An exact number. Raises EvaluationError if it has too many bits."""
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
    """Sine, cosine or tangent where it is rational; otherwise None."""
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
    """Square root, exact for squares of rationals. Raises EvaluationError for a negative number."""
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
"""The largest relative error of one operation in doubles; a function has up to four of these."""


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
    """A number in doubles with its error; an exact number acquires one by the conversion."""
    if not isinstance(value, Fraction):
        return value, error
    near = kind.number(value)
    return near, UNIT * abs(near)


def joined_error(sign: str, left: tuple[Any, Any], right: tuple[Any, Any], value: Any) -> Any:
    """The error of two joined numbers, from their errors."""
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
    """The error of a root, or of a sine, cosine or tangent of degrees."""
    if function == "sqrt":
        return error / (2 * abs(value) + (value == 0)) + UNIT * abs(value)
    turned = error / 57 + 4 * UNIT
    return turned * (1 + value * value) if function == "tan" else turned


NOUGHT = Number(Fraction(0))
ONE = Number(Fraction(1))
DEGREE = Pair("/", Name(CONSTANT), Number(Fraction(180)))


def differentiated(tree: Tree, name: str) -> Tree:
    """The tree of the derivative by a name. Raises EvaluationError for a name in an exponent."""
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
    """Derivative of a power whose exponent does not contain the name."""
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
    """Derivative of a function by its own argument, with angles in degrees."""
    if function == "sqrt":
        return Pair("/", Number(Fraction(1, 2)), Call("sqrt", inner))
    if function == "sin":
        return times(Call("cos", inner), DEGREE)
    if function == "cos":
        return times(Number(Fraction(-1)), times(Call("sin", inner), DEGREE))
    square = Pair("**", Call("tan", inner), Number(Fraction(2)))
    return times(Pair("+", ONE, square), DEGREE)


def plus(sign: str, left: Tree, right: Tree) -> Tree:
    """A sum or a difference without zero terms."""
    if right == NOUGHT:
        return left
    if left == NOUGHT:
        return right if sign == "+" else Minus(right)
    return Pair(sign, left, right)


def times(left: Tree, right: Tree) -> Tree:
    """A product without factors of zero and one."""
    if NOUGHT in (left, right):
        return NOUGHT
    if left == ONE:
        return right
    return left if right == ONE else Pair("*", left, right)
