"""Numbers of a scene as they are read: each with its unit, its place and its value checked."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Rational, Real

from msgspec.structs import replace

from graphkin.scene.expression import FARTHEST, TIME, Number, UnreadableError, decimal, integer
from graphkin.scene.findings import Findings, listed, nearest, shown
from graphkin.scene.quantity import Quantity, exact, expression
from graphkin.text.errors import Hint, SceneError

Pair = tuple[Quantity, Quantity]
LARGEST = 10**FARTHEST


class FloatText(str):
    """A TOML float kept as written, so that 0.1 is one tenth."""

    __slots__ = ()


def quantity(raw: object, unit: str, place: str) -> Quantity:
    """A raw value as a quantity. Raises UnreadableError if it is no number and no expression."""
    if isinstance(raw, bool):
        raise UnreadableError(shown(raw))
    if isinstance(raw, Integral):
        whole = integer(int(raw))
        return Quantity(str(whole), Number(whole), unit, place)
    if isinstance(raw, FloatText):
        written = raw.replace("_", "")
        return Quantity(written, Number(decimal(written)), unit, place)
    if isinstance(raw, str):
        return expression(raw, unit, place)
    if isinstance(raw, Rational):
        return exact(Fraction(int(raw.numerator), int(raw.denominator)), unit, place)
    if isinstance(raw, Real | Decimal):
        return Quantity(str(raw), Number(decimal(str(raw))), unit, place)
    raise UnreadableError(shown(raw))


class Measures:
    """The reader for the numbers of one scene, with its units, parameters and findings."""

    def __init__(
        self, findings: Findings, units: Mapping[str, str], values: Mapping[str, Fraction]
    ) -> None:
        self.findings = findings
        self.units = units
        self.values = values

    def number(
        self, place: str, raw: object, unit: str = "", *, positive: bool = False, law: bool = False
    ) -> Quantity:
        """A number in a unit; ``law`` permits ``t``. An invalid number is recorded and 1 used."""
        try:
            read = quantity(raw, unit, place)
        except UnreadableError as error:
            found = "nothing" if raw is None else error.found
            self.findings.add(place, found, "a number or an expression in quotes", error.hint)
            return exact(1, unit, place)
        if self.knows_names(read, law) and self.exists(read, positive):
            return read
        return exact(1, unit, place)

    def length(self, place: str, raw: object, *, positive: bool = False) -> Quantity:
        """A length in the scene's unit."""
        return self.number(place, raw, self.units["length"], positive=positive)

    def angle(self, place: str, raw: object) -> Quantity:
        """An angle in the scene's unit."""
        return self.number(place, raw, self.units["angle"])

    def point(self, place: str, raw: object) -> Pair:
        """Two coordinates ``[x, y]``."""
        if not isinstance(raw, list) or len(raw) != 2:
            self.findings.add(place, shown(raw), "two coordinates [x, y]")
            raw = [1, 1]
        return self.length(f"{place}[0]", raw[0]), self.length(f"{place}[1]", raw[1])

    def knows_names(self, read: Quantity, law: bool) -> bool:
        """Whether each name in a quantity is a parameter, or ``t`` in a law of time."""
        used = read.uses()
        if not used:
            return True
        unknown = sorted(used - self.values.keys() - {TIME})
        names = [key for key in self.values if key != TIME]
        known = listed(names)
        number = f"a number in {read.unit}" if read.unit else "a number"
        for name in unknown:
            self.findings.add(
                read.place,
                f"{shown(read.text)} uses {name}, which is no parameter",
                f"{number}, or an expression with {known}" if known else number,
                nearest(name, names),
            )
        if TIME not in used:
            return not unknown
        if not law:
            self.findings.add(
                read.place,
                f"{shown(read.text)} uses the time t",
                "t only in a driver's angle or position",
            )
        elif TIME not in self.values:
            self.findings.add(
                read.place,
                f"{shown(read.text)} uses the time t, and the scene has no time",
                "time = … (in s) at the top of the file",
            )
        return law and not unknown and TIME in self.values

    def exists(self, read: Quantity, positive: bool = False, hint: Hint = "") -> bool:
        """Whether a quantity has a value now, and a positive one where required."""
        try:
            value = read.number(self.values)
        except SceneError as error:
            self.findings.extend(replace(problem, hint=hint) for problem in error.problems)
            return False
        tiny = positive and 0 < value * LARGEST < 1
        if tiny or abs(value) > LARGEST:
            found = f"{shown(read.text)} is out of range"
            expected = f"a number between 1e-{FARTHEST} and 1e{FARTHEST}"
            self.findings.add(read.place, found, expected, hint)
            return False
        if positive and value <= 0:
            found = read.written(self.values)
            if found != read.text:
                found = f"{shown(read.text)} is {found}"
            self.findings.add(read.place, found, "a number above 0")
            return False
        return True
