"""A number of a scene, exact and in its written unit until it is converted to a numeric kind."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Context, Decimal
from fractions import Fraction
from functools import lru_cache
from typing import Any

from msgspec import Struct

from graphkin.numbers.arithmetic import FLOAT, Kind, Point, Real, np
from graphkin.scene.expression import (
    BOUNDLESS,
    HEAVIEST,
    TIME,
    UNIT,
    EvaluationError,
    Minus,
    Number,
    Pair,
    Tree,
    differentiated,
    evaluate,
    names,
    parse,
    size,
    with_error,
)
from graphkin.scene.findings import shown
from graphkin.text import IMPERIAL
from graphkin.text.errors import Message, Problem, SceneError, message

LENGTHS = {
    "mm": Fraction(1, 1000),
    "cm": Fraction(1, 100),
    "m": Fraction(1),
    "in": Fraction(254, 10000),
    "ft": Fraction(3048, 10000),
}
METRES = {unit: float(size) for unit, size in LENGTHS.items()}
"""Metres in each unit in which a scene may write lengths: exact, and as numbers."""
POUND = Fraction("0.45359237")
"""A pound in kilograms."""
STANDARD_GRAVITY = Fraction("9.80665")
"""The acceleration in m/s² at which a pound weighs a pound-force."""
FORCES = {"N": Fraction(1), "lbf": POUND * STANDARD_GRAVITY}
MASSES = {"kg": Fraction(1), "lb": POUND}
"""The units of forces in newtons, and of masses in kilograms."""
IN = "|"
"""The sign between a unit of length and the unit in which it is computed, other than metres."""
TURNS = {"rad": (Fraction(1), False), "deg": (Fraction(1, 180), True)}


def si_factors() -> dict[str, tuple[Fraction, bool]]:
    """The size of each unit of motion in metres, radians and seconds, and whether pi multiplies it.

    A unit such as mm|in is computed in inches, not in metres.
    """
    bases = {unit: (factor, False) for unit, factor in LENGTHS.items()} | TURNS
    for base, metres in LENGTHS.items():
        bases |= {f"{unit}{IN}{base}": (each / metres, False) for unit, each in LENGTHS.items()}
    rates = {f"{unit}/{s}": each for s in ("s", "s²", "s³") for unit, each in bases.items()}
    others = dict.fromkeys(("", "s"), (Fraction(1), False))
    return bases | rates | others | {"rev/min": (Fraction(1, 30), True)}


@lru_cache(maxsize=1)
def mechanical_factors() -> dict[str, tuple[Fraction, bool]]:
    """The size of each unit of forces, moments, masses, inertias and stiffnesses.

    A unit such as kg|in is computed in the coherent system of inches and pounds-force.
    """
    found: dict[str, Fraction] = {}
    for base, metre in LENGTHS.items():
        tag, newton = "" if base == "m" else f"{IN}{base}", force_in(base)
        for force, one in FORCES.items():
            found[f"{force}{tag}"] = one / newton
            for length, own in LENGTHS.items():
                found[f"{force}{tag}·{length}"] = one * own / (newton * metre)
                found[f"{force}{tag}/{length}"] = one / own * metre / newton
        for mass, one in MASSES.items():
            found[f"{mass}{tag}"] = one * metre / newton
            for length, own in LENGTHS.items():
                found[f"{mass}{tag}·{length}²"] = one * own**2 / (metre * newton)
    return {unit: (size, False) for unit, size in found.items()}


def force_in(base: str) -> Fraction:
    """The unit of forces in newtons that goes with a unit of lengths."""
    return FORCES["lbf" if base in IMPERIAL else "N"]


SI = si_factors()
"""The sizes of the units of motion, which every scene has."""


def has_size(unit: str) -> bool:
    """Whether a text is a unit of motion or of mechanics, whose size is known."""
    return unit in SI or unit in mechanical_factors()


def size_in_si(unit: str) -> tuple[Fraction, bool]:
    """The size of a unit of motion or of mechanics in SI units, and whether pi multiplies it."""
    return SI[unit] if unit in SI else mechanical_factors()[unit]


SHOWN = 12
"""Significant digits of a non-terminating decimal."""
ENDING = 17
"""Significant digits up to which a terminating decimal is written in full."""


class Quantity(Struct, frozen=True, eq=False):
    """A number as written, perhaps an expression in parameters, with its unit.

    ``place`` is the key from which it was read, for errors; equality ignores it.
    """

    text: str
    tree: Tree
    unit: str = ""
    place: str = ""

    @property
    def key(self) -> tuple[object, ...]:
        """The fields that equality compares."""
        return self.text, self.tree, self.unit

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self.key == other.key

    def __hash__(self) -> int:
        return hash((self.text, self.unit))

    @property
    def written_unit(self) -> str:
        """The unit as written, in whatever unit it is computed."""
        return plain_unit(self.unit)

    def uses(self) -> frozenset[str]:
        """The names of its parameters, with ``t`` if it is a law of time."""
        return names(self.tree)

    def is_zero(self) -> bool:
        """Whether it is zero for all values of the parameters."""
        return not self.uses() and self.number({}) == 0

    def number(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Real:
        """The value in the written unit: a Fraction while exact, else a number of the kind.

        Raises SceneError where the value does not exist; an array has NaN or inf there instead.
        """
        if isinstance(self.tree, Number):
            return self.tree.value
        try:
            value = reckoned(self.tree, values, kind)
        except EvaluationError as error:
            raise SceneError(self.problem(values, *error.args)) from None
        except OverflowError:
            raise SceneError(self.problem(values, *BOUNDLESS)) from None
        except KeyError as error:
            found = message("no value for {name}", name=error.args[0])
            raise SceneError(self.problem(values, found, message("a value of each name"))) from None
        if isinstance(value, float) and not math.isfinite(value):
            raise SceneError(self.problem(values, *BOUNDLESS))
        return value

    def si(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Real:
        """The value in metres, radians and seconds, exact up to a final conversion to the kind."""
        factor, of_pi = size_in_si(self.unit)
        value = self.number(values, kind)
        if isinstance(value, Fraction):
            real = kind.number(value * factor)
        elif factor.numerator == 1:
            real = value / kind.number(factor.denominator)
        else:
            real = value * kind.number(factor)
        return real * kind.pi if of_pi else real

    def direction(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Point:
        """The unit vector at this angle; whole quarter turns in degrees are exact."""
        value = self.number(values, kind)
        if self.unit == "rad":
            return kind.radians(kind.number(value) if isinstance(value, Fraction) else value)
        if isinstance(value, Fraction | float) or hasattr(value, "shape"):
            return kind.direction(value)
        return kind.radians(value * (kind.pi / 180))

    def error(self, values: Mapping[str, Any], kind: Kind = FLOAT) -> Real:
        """A bound on the error of ``si`` or ``direction`` from operations in doubles.

        In metres, radians and seconds. The last few roundings, which are relative to the value or
        to a turn, are left out.
        """
        try:
            value, error = with_error(self.tree, values, kind)
        except ArithmeticError:
            return 0.0
        if self.unit == "rad" and isinstance(value, Fraction):
            error = UNIT * abs(kind.number(value))
        factor, of_pi = size_in_si(self.unit)
        return error * float(factor) * (kind.pi if of_pi else 1)

    def written(self, values: Mapping[str, Any]) -> str:
        """The value as a sheet prints it: ``44``, ``0.25``; 12 digits if it does not terminate."""
        return shortest(self.number(values))

    def derivative(self, name: str) -> Quantity:
        """The exact derivative by a name; by the time ``t``, the unit becomes per second."""
        if size(self.tree) > HEAVIEST:
            found = message("a derivative of too many parts")
            raise SceneError(self.problem({}, found, message("a shorter law")))
        try:
            tree = differentiated(self.tree, name)
        except EvaluationError as error:
            raise SceneError(self.problem({}, *error.args)) from None
        unit = per_second(self.unit) if name == TIME else self.unit
        return Quantity(f"d({self.text})/d{name}", tree, unit, self.place)

    def negative(self) -> Quantity:
        """The negative of the number."""
        return Quantity(f"-({self.text})", Minus(self.tree), self.unit, self.place)

    def less(self, number: int) -> Quantity:
        """The number minus a whole number in its unit."""
        tree = Pair("-", self.tree, Number(Fraction(number)))
        return Quantity(f"({self.text}) - {number}", tree, self.unit, self.place)

    def problem(self, values: Mapping[str, Any], what: Message, expected: Message) -> Problem:
        """The problem of this number, with the parameter values used."""
        known = [f"{name} = {values[name]}" for name in sorted(self.uses()) if name in values]
        found = message("{text} gives {what}", text=shown(self.text), what=what)
        if known:
            found = message("{gives} with {known}", gives=found, known=", ".join(known))
        return Problem(self.place, found, expected)


def plain_unit(unit: str) -> str:
    """A unit without the unit in which it is computed."""
    return re.sub(rf"\{IN}[a-z]+", "", unit)


def in_unit(unit: str, base: str) -> str:
    """A unit as computed in another unit of length; one without length, force or mass unchanged."""
    plain = plain_unit(unit)
    first = re.match("[A-Za-z]*", plain)
    assert first is not None
    if first[0] not in {*LENGTHS, *FORCES, *MASSES}:
        return unit
    return plain if base == "m" else f"{first[0]}{IN}{base}{plain[first.end() :]}"


def reckoned(tree: Tree, values: Mapping[str, Any], kind: Kind) -> Any:
    """The value of a tree; in a batch, undefined values are masked without a warning."""
    if not any(hasattr(value, "shape") for value in values.values()):
        return evaluate(tree, values, kind)
    with np.errstate(all="ignore"):
        return evaluate(tree, values, kind)


def per_second(unit: str) -> str:
    """The unit of a time derivative: deg, deg/s, deg/s², deg/s³. Raises SceneError beyond."""
    rate = f"{unit}²" if unit.endswith("/s") else f"{unit}/s"
    rate = f"{unit[:-1]}³" if unit.endswith("/s²") else rate
    if rate not in SI:
        raise SceneError.at(
            "", message("no unit for the derivative of a number in {value}", value=unit or "1")
        )
    return rate


def exact(value: int | Fraction, unit: str = "", place: str = "") -> Quantity:
    """A quantity with an exact value."""
    number = Fraction(value)
    return Quantity(shortest(number), Number(number), unit, place)


def expression(text: str, unit: str = "", place: str = "", *, counting: bool = False) -> Quantity:
    """A quantity from an expression as written. Raises UnreadableError if it cannot be read.

    ``counting`` allows remainders: ``number mod 30``.
    """
    return Quantity(text, parse(text, counting=counting), unit, place)


def combined(sign: str, one: Quantity, other: Quantity) -> Quantity:
    """Two quantities joined by an operation, in the unit of the first."""
    text = f"({one.text}) {sign} ({other.text})"
    return Quantity(text, Pair(sign, one.tree, other.tree), one.unit, one.place)


def shortest(value: Real) -> str:
    """The shortest decimal text of a number: all digits up to 17 if it terminates, else 12."""
    if isinstance(value, Fraction):
        top, bottom = Decimal(value.numerator), Decimal(value.denominator)
        full = Context(prec=ENDING).divide(top, bottom)
        ends = Fraction(full) == value
    else:
        full, ends = Decimal(float(value)), False
    number = (full if ends else Context(prec=SHOWN).plus(full)).normalize(Context(prec=ENDING))
    if not number:
        return "0"
    return f"{number:f}" if -6 <= number.adjusted() < 15 else f"{number:e}"
