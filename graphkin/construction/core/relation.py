"""Relations of the calculation: symbols, figures put in, result with its unit and sense; and
vector equations as the school writes them, with what is known of each vector below it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import ceil, floor, isclose, log10

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.quantities import OnPaper
from graphkin.text.markup import saying


class Term(Struct, frozen=True):
    """A vector under its ``symbol``: of its size and direction, how many are ``known``, and how."""

    symbol: str
    known: int = 0
    note: str = ""


class VectorEquation(Struct, frozen=True):
    """A vector that is one or more ``sums`` of others; without any, what is known of it alone."""

    whole: Term
    sums: tuple[tuple[Term, ...], ...] = ()

    @property
    def markup(self) -> str:
        """It in one line, without what is known."""
        sums = (" + ".join(term.symbol for term in terms) for terms in self.sums)
        return " = ".join((self.whole.symbol, *sums))


def chained(equations: Sequence[VectorEquation]) -> list[VectorEquation]:
    """Those for one vector as one, where the first of them stands."""
    found: dict[str, VectorEquation] = {}
    for each in equations:
        before = found.get(each.whole.symbol)
        if before is None:
            found[each.whole.symbol] = each
            continue
        whole = max(before.whole, each.whole, key=lambda term: term.known)
        found[each.whole.symbol] = VectorEquation(whole, before.sums + each.sums)
    return list(found.values())


DIGITS = 5
"""Significant digits of figures put in, so that results of four digits follow from them."""
FINE = 6
"""The same of rates put into sums, whose digits may cancel."""


class Relation(Struct, frozen=True):
    """left = symbols = figures = result unit, remark; ``more`` are further words after ``left``.

    ``equals``: what stands before a result, nothing where it is said in words. ``over``: the ends
    of the lengths that it takes. ``blank``: what a form has for a result that is no single number,
    and how it is counted. ``equation``: the vector equation that it is. ``given``: it is chosen, so
    that a form states it.
    """

    left: str
    symbols: str = ""
    figures: str = ""
    result: str = ""
    unit: str = ""
    remark: str = ""
    more: tuple[str, ...] = ()
    equals: str = "="
    over: tuple[tuple[str, str], ...] = ()
    blank: tuple[str, ...] = ()
    equation: VectorEquation | None = None
    given: bool = False

    def parts(self, *, solved: bool) -> list[str]:
        """The pieces between which a line may be broken."""
        pieces = [self.left, *self.more]
        if self.symbols:
            pieces.append(f"= {self.symbols}")
        if not self.result:
            return pieces
        if not solved and not self.given:
            return [*pieces, "="]
        if self.figures:
            pieces.append(f"= {self.figures}")
        space = "" if self.unit == "°" else " "
        pieces.append(f"{self.equals} {self.result}{space}{self.unit}".strip())
        if self.remark:
            pieces.append(f"({self.remark})")
        return pieces


def figure(drawing: Drawing, value: float, digits: int = DIGITS) -> str:
    """A number as it is put into a relation, without noughts at its end."""
    text = drawing.words.significant(value, digits)
    mark = drawing.words("decimal_mark")
    return text.rstrip("0").rstrip(mark) if mark in text and "·" not in text else text


def within(drawing: Drawing, value: float) -> str:
    """A number after a sign: in brackets if it is negative."""
    text = figure(drawing, value, FINE)
    return f"({text})" if value < 0 else text


def answer(drawing: Drawing, value: float) -> str:
    """A number as it comes out of a relation."""
    return drawing.words.significant(value, 4)


POWERS = 1e6
"""From which size numbers are written by powers of ten."""


class RulerReading(Struct, frozen=True):
    """A drawn length as it is told to be read: to 0.1 mm, one below 1 mm in two digits."""

    millimetres: float
    unit: float

    def figures(self, drawing: Drawing) -> str:
        """The length as it is printed."""
        return drawing.words.fixed(self.millimetres, -round(log10(self.unit)))

    def times(self, drawing: Drawing, scale: float) -> tuple[str, str]:
        """It times a scale factor, and what that gives, in as many digits as it carries; a number
        that is written without a power of ten to its units."""
        value = rounded(scale) * self.millimetres
        last = ceil(log10(scale * self.unit / 2))
        last = last if value >= POWERS else min(last, 0)
        value = round(value, -last)
        if not value:
            return f"{figure(drawing, scale)}·0", "0"
        told = drawing.words.significant(value, max(floor(log10(value)) - last + 1, 1))
        return f"{figure(drawing, scale)}·{self.figures(drawing)}", told


def reading(millimetres: OnPaper) -> RulerReading:
    """How a drawn length is told."""
    unit = 10.0 ** min(floor(log10(millimetres)) - 1, -1) if millimetres else 0.1
    return RulerReading(round(millimetres / unit) * unit, unit)


def drawn_length(drawing: Drawing, millimetres: OnPaper) -> str:
    """A drawn length, to a thousandth of a millimetre or five digits."""
    return figure(drawing, millimetres if millimetres < 10 else round(millimetres, 3))


def length_of(drawing: Drawing, p: str, q: str) -> float:
    """Length of a bar in metres."""
    return abs(drawing.standing.spot(q) - drawing.standing.spot(p))


def rounded(value: float) -> float:
    """A number as large as its figure: what a reader who takes the figure computes from."""
    return float(f"{value:.{DIGITS - 1}e}")


def squared(figures: str) -> str:
    """The square of a figure that is put in; a power of ten is squared with the rest."""
    return f"({figures})^2" if "·" in figures else f"{figures}^2"


# --- lengths at another scale than that of a plan ----------------------------------------------


def set_length(drawing: Drawing, vector: str) -> str:
    """A velocity as it is set on the mechanism: one m-th of its segment in the plan."""
    return divided(drawing, vector, drawing.scales.larger)


def twice_set(drawing: Drawing, vector: str) -> str:
    """Twice a velocity as it is set on the mechanism."""
    times = 2 / drawing.scales.larger
    if times == 1:
        return vector
    short = f"{times:.4g}" == f"{times:.2g}"
    if short:
        return saying(f"{figure(drawing, times)}·{vector}", vector)
    return set_length(drawing, saying(f"2·{vector}", vector))


def laid_times(drawing: Drawing) -> str:
    """What stands before a length of the mechanism that is laid off m′ times in the plan."""
    times = drawing.scales.larger_still
    return "" if times == 1 else f"{figure(drawing, times)}·"


def divided(drawing: Drawing, what: str, times: float) -> str:
    """Markup of a length divided by a number, or multiplied where that is below one."""
    if times == 1:
        return what
    larger = f"{what}/{figure(drawing, times)}", f"{inverse(drawing, times)}·{what}"
    return saying(larger[times < 1], what)


def inverse(drawing: Drawing, times: float) -> str:
    """One by a number as it is told: 4/3 where the decimal of it does not end."""
    part = Fraction(1 / times).limit_denominator(9)
    if part.denominator % 3 == 0 and isclose(part, 1 / times, rel_tol=1e-9):
        return str(part)
    return figure(drawing, 1 / times)


def beside_plan(drawing: Drawing, kind: str) -> str:
    """How long vectors on the mechanism are beside a plan's; nothing where they are alike."""
    times = drawing.scales.times(kind)
    if times == 1:
        return ""
    if times > 1:
        return drawing.words("page.shorter", m=figure(drawing, times))
    return drawing.words("page.longer", m=inverse(drawing, times))
