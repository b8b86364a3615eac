"""Expressions as a lecturer writes them ("30 + 2*n"), read into a small tree and never executed.

Python's own parser gives the shape; only numbers, names, + - * / **, a leading minus, brackets and
four functions are let through, and every number keeps the digits it was written with.
"""

from __future__ import annotations

import ast
import re
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from itertools import pairwise
from threading import Lock
from typing import NoReturn

from msgspec import Struct

from graphkin.scene.findings import shown, visible
from graphkin.text.errors import Hint, Mend

FUNCTIONS = ("sqrt", "sin", "cos", "tan")
"""Functions of one number; sine, cosine and tangent take degrees."""
CONSTANT = "pi"
TIME = "t"
RESERVED = frozenset((*FUNCTIONS, CONSTANT, TIME))
"""Names that no parameter may have."""

ONE_AT_A_TIME = Lock()
"""Python's parser is entered by one thread at a time, though requests to the studio come at once:
two may end with "AST constructor recursion depth mismatch" on Python 3.11.7."""
LONGEST = 500
DEEPEST = 60
WIDEST = 1000
"""Largest number of bits above or below the fraction bar of a number."""
FARTHEST = 60
"""Largest power of ten of a number as written."""
DIGITS = 60
HEAVIEST = 2000
"""Largest number of parts of a law of time and of its first derivative."""

UNITS = ("degrees", "degree", "deg", "°", "rad", "grad", "rpm", "mm", "cm", "dm", "in", "m", "s")
RATES = ("mm/s", "cm/s", "m/s", "in/s", "rev/min", "rot/min", "rad/s", "deg/s", "°/s")
MEASURED = rf"(?as)(.*[\w.)\s])((?<![A-Za-z_])(?:{'|'.join((*RATES, *UNITS))})|°)"
"""A number or an expression with a unit behind it."""
MARKS = "_.+-*/() \t\r\n"
JUXTAPOSED = r"(?a)(?<![A-Za-z0-9_.])(?>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*[A-Za-z_(]"
DECIMAL = frozenset("0123456789.eE+-")
"""The signs of a decimal number."""
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**", ast.Mod: "mod"}
REST = r"\bmod\b"
"""The sign of a rest: ``number mod 30``."""


class UnreadableError(ValueError):
    """An expression or a number that cannot be read: what was found, and a hint."""

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
    """The negative of what follows."""

    inner: Tree


class Pair(Struct, frozen=True):
    """Two parts joined by one of + - * / ** or mod, the rest of a division."""

    sign: str
    left: Tree
    right: Tree


class Call(Struct, frozen=True):
    """A function of one number; the angle of a sine is in degrees."""

    function: str
    inner: Tree


Tree = Number | Name | Minus | Pair | Call


def parse(text: str, *, counting: bool = False) -> Tree:
    """The tree of an expression; UnreadableError says what could not be read.

    ``counting`` lets rests in (``number mod 30``), which only exact numbers have.
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
    """How to write a number that has a unit behind it; empty where it has none."""
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
    """Refuse characters and shapes that no expression has, each with the way to write it."""
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
    """Whether a letter or a bracket stands right after a figure, as it may in a name, too."""
    bare = "".join(text.split())
    return any(
        (one.isdigit() or one == ".") and (after == "(" or after.isidentifier())
        for one, after in pairwise(bare)
    )


def convert(node: ast.expr, text: str, depth: int) -> Tree:
    """Our tree for a part of Python's, if it is on the short list of what is allowed."""
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
    """Say which part of an expression is not allowed."""
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
    """The exact value of a whole number, refused when it has too many digits."""
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
