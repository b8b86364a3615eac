"""Expressions such as "30 + 2*n", parsed into a small tree and never executed as Python.

Python's parser gives the structure. Only numbers, names, + - * / **, a leading minus, brackets and
four functions are allowed. Every number keeps the digits with which it was written.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from itertools import pairwise
from keyword import kwlist
from math import isqrt
from threading import Lock
from typing import Any, NoReturn

from msgspec import Struct

from graphkin.numbers.arithmetic import Kind, np
from graphkin.scene.findings import shown, visible
from graphkin.text.errors import NO_WORDS, Hint, Mend, Message, message

FUNCTIONS = ("sqrt", "sin", "cos", "tan")
"""Functions of one number; sine, cosine and tangent take degrees."""
CONSTANT = "pi"
TIME = "t"
RESERVED = frozenset((*FUNCTIONS, CONSTANT, TIME, *kwlist))
"""Names that no parameter may have."""

ONE_AT_A_TIME = Lock()
"""Lets one thread at a time into Python's parser; requests to the studio run in parallel.

Two threads at once may fail with "AST constructor recursion depth mismatch" on Python 3.11.7.
"""
LONGEST = 500
DEEPEST = 60
WIDEST = 1000
"""The most bits in the numerator or denominator of a number."""
FARTHEST = 60
"""The largest power of ten of a written number."""
DIGITS = 60
HEAVIEST = 2000
"""The most parts of a law of time and of its first derivative."""

UNITS = (
    "degrees",
    "degree",
    "deg",
    "°",
    "rad",
    "grad",
    "rpm",
    "mm",
    "cm",
    "dm",
    "in",
    "ft",
    "m",
    "s",
)
RATES = ("mm/s", "cm/s", "m/s", "in/s", "ft/s", "rev/min", "rot/min", "rad/s", "deg/s", "°/s")
MEASURED = rf"(?as)(.*[\w.)\s])((?<![A-Za-z_])(?:{'|'.join((*RATES, *UNITS))})|°)"
"""A number or an expression followed by a unit."""
MARKS = "_.+-*/() \t\r\n"
JUXTAPOSED = r"(?a)(?<![A-Za-z0-9_.])(?>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*[A-Za-z_(]"
DECIMAL = frozenset("0123456789.eE+-")
"""The characters of a decimal number."""
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**", ast.Mod: "mod"}
REST = r"\bmod\b"
"""The remainder operator: ``number mod 30``."""


class UnreadableError(ValueError):
    """An expression or a number that cannot be read: what was found, and a hint."""

    def __init__(self, found: Message, hint: Hint = NO_WORDS) -> None:
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
    """Two parts joined by + - * / ** or mod, the remainder of a division."""

    sign: str
    left: Tree
    right: Tree


class Call(Struct, frozen=True):
    """A function of one number; angles are in degrees."""

    function: str
    inner: Tree


Tree = Number | Name | Minus | Pair | Call


def parse(text: str, *, counting: bool = False) -> Tree:
    """The tree of an expression. Raises UnreadableError for what cannot be read.

    ``counting`` allows remainders (``number mod 30``), which exist only for exact numbers.
    """
    if len(text) > LONGEST:
        raise UnreadableError(
            message("an expression of {count} characters", count=len(text)),
            message("at most {most}", most=LONGEST),
        )
    flat = " ".join(text.split())
    if "mod" in text and re.search(REST, text):
        if not counting:
            raise UnreadableError(
                message('"mod" in an expression'), message("only formulas of a lab.toml have it")
            )
        refuse_foreign(re.sub(REST, "*", text))
        flat = re.sub(REST, "%", flat)
    else:
        refuse_foreign(text)
    try:
        with ONE_AT_A_TIME:
            body = ast.parse(flat, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise UnreadableError(
            message("{split} is not an expression", split=shown(" ".join(text.split())))
        ) from None
    return convert(body, flat, 0)


def unit_hint(text: str) -> Hint:
    """How to write a number that is followed by a unit; "" where there is no unit."""
    bare = text.strip()
    measured = re.fullmatch(MEASURED, bare) if bare.endswith((*RATES, *UNITS)) else None
    rest = measured[1].strip() if measured else ""
    if not measured or not rest or rest[-1] in "+-*/(":
        return NO_WORDS
    hint = message("the unit is stated once in units: write {rest}", rest=rest)
    if len(measured[2]) > 1 or measured[2] == "°":
        return Mend(bare, rest, hint)
    return message("{hint}; a product has its *", hint=hint)


def refuse_foreign(text: str) -> None:
    """Refuse characters and forms that no expression has, each with a hint on how to write it."""
    hint = unit_hint(text)
    if hint:
        raise UnreadableError(message("{strip} has a unit", strip=shown(text.strip())), hint)
    foreign = next((c for c in text if not (c.isascii() and c.isalnum()) and c not in MARKS), "")
    if foreign:
        hints: dict[str, Hint] = {
            "^": Mend("^", "**", message("write a power as **")),
            ",": Mend(",", ".", message("write a decimal point")),
            "°": Mend("°", "", message("leave out °")),
        }
        raise UnreadableError(
            message("'{foreign}' in an expression", foreign=visible(foreign)),
            hints.get(foreign, NO_WORDS),
        )
    if not text.strip():
        raise UnreadableError(message("an empty expression"))
    joined = re.search(JUXTAPOSED, text) if runs_on(text) else None
    if joined:
        hint = (
            message("write plain digits")
            if joined.group()[-1] in "_xXoObBjJ"
            else message("write a product with *: 2*n")
        )
        raise UnreadableError(message('"{part}" in an expression', part=joined.group()), hint)


def runs_on(text: str) -> bool:
    """Whether a letter or bracket directly follows a digit or decimal point, even in a name."""
    bare = "".join(text.split())
    return any(
        (one.isdigit() or one == ".") and (after == "(" or after.isidentifier())
        for one, after in pairwise(bare)
    )


def convert(node: ast.expr, text: str, depth: int) -> Tree:
    """The tree for a node of Python's syntax tree. Raises UnreadableError if it is not allowed."""
    if depth > DEEPEST:
        raise UnreadableError(
            message("an expression nested more than {deepest} deep", deepest=DEEPEST)
        )
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
    """Raise UnreadableError with the part of an expression that is not allowed."""
    part = visible(text[node.col_offset : node.end_col_offset]).replace("%", "mod")
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        raise UnreadableError(
            message('"{part}" in an expression', part=part),
            message("functions of one number are {functions}", functions=", ".join(FUNCTIONS)),
        )
    raise UnreadableError(
        message('"{part}" in an expression', part=part),
        message("it may hold + - * / **, brackets and functions"),
    )


def decimal(text: str) -> Fraction:
    """The exact value of a decimal number as written; underscores, nan and inf are refused."""
    try:
        if not DECIMAL.issuperset(text):
            raise InvalidOperation
        number = Decimal(text)
    except InvalidOperation:
        raise UnreadableError(
            message("{text} is not a finite decimal number", text=text[:40])
        ) from None
    if len(number.as_tuple().digits) > DIGITS:
        raise UnreadableError(message("a number of more than {digits} digits", digits=DIGITS))
    if number and abs(number.adjusted()) > FARTHEST:
        raise UnreadableError(
            message("{text} is out of range", text=text[:40]),
            message("numbers lie between 1e-{farthest} and 1e{farthest}", farthest=FARTHEST),
        )
    return Fraction(number) if number else Fraction(0)


def integer(value: int) -> Fraction:
    """The exact value of a whole number, refused when it has too many digits."""
    if value.bit_length() > FARTHEST * 10 // 3:
        raise UnreadableError(
            message("a whole number with too many digits"),
            message("at most 1e{farthest}", farthest=FARTHEST),
        )
    return Fraction(value)


def size(tree: Tree) -> int:
    """The number of parts of an expression."""
    match tree:
        case Number() | Name():
            return 1
        case Minus(inner) | Call(_, inner):
            return 1 + size(inner)
        case Pair(_, left, right):
            return 1 + size(left) + size(right)


def names(tree: Tree) -> frozenset[str]:
    """Names used in an expression: parameters and the time, but not ``pi``."""
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
"""Twice the sine of each whole angle in degrees whose sine is rational."""
TANGENTS = {0: 0, 45: 1, 135: -1}


class EvaluationError(ArithmeticError):
    """A value that does not exist or is unbounded: what was found, and what was expected."""


BOUNDLESS = message("a number that grows without bound"), message("a number between 1e-60 and 1e60")
NO_QUOTIENT = message("division by zero"), message("a divisor that is not 0")
NO_ROOT = message("the square root of a negative number"), message("0 or more under the root")


def evaluate(tree: Tree, values: Mapping[str, Any], kind: Kind) -> Any:
    """The value of a tree: a Fraction after rational operations only, else a number of the kind."""
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
    """A parameter ready for computing: an integer as a Fraction, an array converted to the kind."""
    if isinstance(value, int):
        return Fraction(value)
    return kind.number(value) if hasattr(value, "shape") else value


def joined(sign: str, left: Any, right: Any, kind: Kind) -> Any:
    """The result of a binary operation, exact where both numbers are."""
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
                message("the rest of a number that is not rational"),
                message("whole numbers, decimals or fractions"),
            )
    return bounded(found) if exact else found


def inexact(value: Any, kind: Kind) -> Any:
    """An exact number converted to the kind; any other value unchanged."""
    return kind.number(value) if isinstance(value, Fraction) else value


def quotient(left: Any, right: Any) -> Any:
    """Left divided by right; division by zero raises on one scene and is masked in a batch."""
    if not hasattr(right, "shape") and right == 0:
        raise EvaluationError(*NO_QUOTIENT)
    return left / right


def bounded(value: Fraction) -> Fraction:
    """An exact number, refused when its numerator or denominator is too large."""
    if max(value.numerator.bit_length(), value.denominator.bit_length()) > WIDEST:
        raise EvaluationError(*BOUNDLESS)
    return value


def power(base: Any, exponent: Any, kind: Kind) -> Any:
    """A power with an exponent of at most 64; whole powers of exact numbers stay exact."""
    if not hasattr(exponent, "shape") and abs(exponent) > LARGEST_POWER:
        expected = message(
            "an exponent from -{largest_power} to {largest_power}", largest_power=LARGEST_POWER
        )
        raise EvaluationError(
            message("an exponent above {largest_power}", largest_power=LARGEST_POWER), expected
        )
    if isinstance(exponent, Fraction) and exponent.denominator == 1:
        whole = int(exponent)
        if whole < 0:
            return quotient(Fraction(1), power(base, -exponent, kind))
        return bounded(base**whole) if isinstance(base, Fraction) else base**whole
    if not hasattr(base, "shape") and not hasattr(exponent, "shape"):
        if base < 0:
            raise EvaluationError(
                message("a broken power of a negative number"),
                message("a whole exponent, or a base of 0 or more"),
            )
        if base == 0 and exponent < 0:
            raise EvaluationError(*NO_QUOTIENT)
    return inexact(base, kind) ** inexact(exponent, kind)


def called(function: str, value: Any, kind: Kind) -> Any:
    """A square root, sine, cosine or tangent; angles are in degrees, exact where possible."""
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
    """The sine, cosine or tangent where it is rational, else None."""
    if degrees.denominator != 1:
        return None
    whole = int(degrees)
    if function == "tan":
        if whole % 180 == 90:
            raise EvaluationError(
                message("the tangent of a right angle"),
                message("an angle that is no odd multiple of 90°"),
            )
        tangent = TANGENTS.get(whole % 180)
        return None if tangent is None else Fraction(tangent)
    doubled = SINES.get((whole + 90 if function == "cos" else whole) % 360)
    return None if doubled is None else Fraction(doubled, 2)


def root(value: Any, kind: Kind) -> Any:
    """The square root, exact for squares of rationals. Raises EvaluationError below zero."""
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
"""Largest relative error of one operation in doubles; a function may be off by up to four."""


def with_error(tree: Tree, values: Mapping[str, Any], kind: Kind) -> tuple[Any, Any]:
    """The value of a tree in doubles, and a bound on its error; the bound is 0 for exact values.

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
    """A number in doubles with its error; an exact number gets a rounding error here."""
    if not isinstance(value, Fraction):
        return value, error
    near = kind.number(value)
    return near, UNIT * abs(near)


def joined_error(sign: str, left: tuple[Any, Any], right: tuple[Any, Any], value: Any) -> Any:
    """The error of a binary operation, from the errors of its operands."""
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
    """The error of a root, sine, cosine or tangent, from its argument's error in degrees."""
    if function == "sqrt":
        return error / (2 * abs(value) + (value == 0)) + UNIT * abs(value)
    turned = error / 57 + 4 * UNIT
    return turned * (1 + value * value) if function == "tan" else turned


NOUGHT = Number(Fraction(0))
ONE = Number(Fraction(1))
DEGREE = Pair("/", Name(CONSTANT), Number(Fraction(180)))


def differentiated(tree: Tree, name: str) -> Tree:
    """The derivative by a name. Raises EvaluationError when an exponent contains the name."""
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
    above, below = differentiated(left, name), differentiated(right, name)
    first = NOUGHT if above == NOUGHT else Pair("/", above, right)
    if below == NOUGHT:
        return first
    return plus("-", first, Pair("/", times(left, below), Pair("*", right, right)))


def power_rule(base: Tree, exponent: Tree, name: str) -> Tree:
    """The derivative of a power. Raises EvaluationError when the exponent contains the name."""
    if name in names(exponent):
        raise EvaluationError(
            message("an exponent that holds {name}", name=name),
            message("an exponent without {name}", name=name),
        )
    inner = differentiated(base, name)
    if NOUGHT in (exponent, inner):
        return NOUGHT
    if exponent == ONE:
        return inner
    less = Number(exponent.value - 1) if isinstance(exponent, Number) else Pair("-", exponent, ONE)
    return times(times(exponent, Pair("**", base, less)), inner)


def slope(function: str, inner: Tree) -> Tree:
    """The derivative of a function by its own argument, with angles in degrees."""
    if function == "sqrt":
        return Pair("/", Number(Fraction(1, 2)), Call("sqrt", inner))
    if function == "sin":
        return times(Call("cos", inner), DEGREE)
    if function == "cos":
        return times(Number(Fraction(-1)), times(Call("sin", inner), DEGREE))
    square = Pair("**", Call("tan", inner), Number(Fraction(2)))
    return times(Pair("+", ONE, square), DEGREE)


def plus(sign: str, left: Tree, right: Tree) -> Tree:
    """A sum or a difference, without zero terms."""
    if right == NOUGHT:
        return left
    if left == NOUGHT:
        return right if sign == "+" else Minus(right)
    return Pair(sign, left, right)


def times(left: Tree, right: Tree) -> Tree:
    """A product, without zero or unit factors."""
    if NOUGHT in (left, right):
        return NOUGHT
    if left == ONE:
        return right
    return left if right == ONE else Pair("*", left, right)
