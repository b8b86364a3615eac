"""Numbers of a scene as read: the unit, the place and the value of each are checked."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Rational, Real

from msgspec.structs import replace

from graphkin.scene.expression import FARTHEST, TIME, Number, UnreadableError, decimal, integer
from graphkin.scene.findings import Findings, listed, nearest, shown
from graphkin.scene.quantity import Quantity, exact, expression
from graphkin.text.errors import NO_WORDS, Hint, SceneError, message, verbatim

Pair = tuple[Quantity, Quantity]
LARGEST = 10**FARTHEST


class FloatText(str):
    """A TOML float kept as it was written, so that 0.1 is exactly one tenth."""

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
    """The reader of one scene's numbers, with its units, parameters and findings."""

    def __init__(
        self, findings: Findings, units: Mapping[str, str], values: Mapping[str, Fraction]
    ) -> None:
        self.findings = findings
        self.units = units
        self.values = values

    def number(
        self, place: str, raw: object, unit: str = "", *, positive: bool = False, law: bool = False
    ) -> Quantity:
        """A number in a unit; ``law`` allows the time ``t``.

        A number that cannot be read is noted as a problem and replaced by 1.
        """
        try:
            read = quantity(raw, unit, place)
        except UnreadableError as error:
            found = message("nothing") if raw is None else error.found
            self.findings.add(
                place, found, message("a number or an expression in quotes"), error.hint
            )
            return exact(1, unit, place)
        if self.knows_names(read, law) and self.exists(read, positive):
            return read
        return exact(1, unit, place)

    def mechanical(self, unit: str) -> str:
        """A unit of forces or masses as the scene writes it: lbf·in for N·m."""
        if self.units.get("force", "N") == "N":
            return unit
        for si, own in (("m", self.units["length"]), ("N", self.units["force"]), ("kg", "lb")):
            unit = unit.replace(si, own)
        return unit

    def length(self, place: str, raw: object, *, positive: bool = False) -> Quantity:
        """A length in the scene's unit."""
        return self.number(place, raw, self.units["length"], positive=positive)

    def angle(self, place: str, raw: object) -> Quantity:
        """An angle in the scene's unit."""
        return self.number(place, raw, self.units["angle"])

    def point(self, place: str, raw: object) -> Pair:
        """Two coordinates, from ``[x, y]``."""
        if not isinstance(raw, list) or len(raw) != 2:
            self.findings.add(place, shown(raw), message("two coordinates [x, y]"))
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
        number = message("a number in {unit}", unit=read.unit) if read.unit else message("a number")
        for name in unknown:
            self.findings.add(
                read.place,
                message(
                    "{text} uses {name}, which is no parameter", text=shown(read.text), name=name
                ),
                message("{number}, or an expression with {known}", number=number, known=known)
                if known
                else number,
                nearest(name, names),
            )
        if TIME not in used:
            return not unknown
        if not law:
            self.findings.add(
                read.place,
                message("{text} uses the time t", text=shown(read.text)),
                message("t only in a driver's angle or position"),
            )
        elif TIME not in self.values:
            self.findings.add(
                read.place,
                message("{text} uses the time t, and the scene has no time", text=shown(read.text)),
                message("time = … (in s) at the top of the file"),
            )
        return law and not unknown and TIME in self.values

    def exists(self, read: Quantity, positive: bool = False, hint: Hint = NO_WORDS) -> bool:
        """Whether a quantity has a value in range, and a positive one where required."""
        try:
            value = read.number(self.values)
        except SceneError as error:
            self.findings.extend(replace(problem, hint=hint) for problem in error.problems)
            return False
        tiny = positive and 0 < value * LARGEST < 1
        if tiny or abs(value) > LARGEST:
            found = message("{text} is out of range", text=shown(read.text))
            expected = message("a number between 1e-{farthest} and 1e{farthest}", farthest=FARTHEST)
            self.findings.add(read.place, found, expected, hint)
            return False
        if positive and value <= 0:
            found = verbatim(read.written(self.values))
            if found != read.text:
                found = message("{text} is {found}", text=shown(read.text), found=found)
            self.findings.add(read.place, found, message("a number above 0"))
            return False
        return True
