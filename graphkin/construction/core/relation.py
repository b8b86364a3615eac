"""Relations and vector equations of the calculation.

A relation has symbols, inserted values and a result with its unit and sense. A vector equation is
written as in class, with the known parts of each vector below it.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import floor, isclose, log10

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.quantities import OnPaper
from graphkin.text import Words, saying


class Term(Struct, frozen=True):
    """A vector by its ``symbol``, with what is known of it before the equation is solved.

    ``known`` counts the known ones of magnitude and direction; ``note`` says what they are.
    """

    symbol: str
    known: int = 0
    note: str = ""


class VectorEquation(Struct, frozen=True):
    """A vector as one or more ``sums`` of others, or alone with what is known of it."""

    whole: Term
    sums: tuple[tuple[Term, ...], ...] = ()

    @property
    def markup(self) -> str:
        """The equation in one line, without what is known."""
        sums = (" + ".join(term.symbol for term in terms) for terms in self.sums)
        return " = ".join((self.whole.symbol, *sums))

    def joined_to(self, before: VectorEquation) -> VectorEquation:
        """This equation joined to an earlier one.

        Two equations for the same vector become one. Otherwise the earlier one is substituted for
        its summand.
        """
        if before.whole.symbol == self.whole.symbol:
            whole = max(before.whole, self.whole, key=lambda term: term.known)
            if before.whole.known and self.whole.known and before.whole.note != self.whole.note:
                whole = Term(whole.symbol, 1, f"{before.whole.note}, {self.whole.note}")
            return VectorEquation(whole, before.sums + self.sums)
        return VectorEquation(self.whole, tuple(map(before.put_into, self.sums)))

    def put_into(self, terms: tuple[Term, ...]) -> tuple[Term, ...]:
        """A sum with this vector replaced by its own sum, or by its known parts."""
        own = self.sums[0] if self.sums else (self.whole,)
        symbol = self.whole.symbol
        return tuple(each for t in terms for each in (own if t.symbol == symbol else (t,)))


DIGITS = 5
"""Significant digits of inserted values, so that results of four digits follow from them."""
MORE = 4
"""Number of further digits tried where the result does not follow from those."""
FINE = 6
"""Significant digits of rates in sums, whose digits may cancel."""


ROOM = ". . . . . . . ."
"""Room to write a number in, where a form has room for more than one."""


class Relation(Struct, frozen=True):
    """left = symbols = figures = result unit, remark; ``more`` holds further words after ``left``.

    ``equals``: the sign before a result, empty where words say it. ``over``: the ends of the
    lengths used. ``blank``: what a form offers for a result that is not a single number, and how it
    is counted. ``equation``: the vector equation, if it is one. ``given``: the value is chosen, so
    a form states it. ``takes``: the symbol of the quantity from the plan, or of the rate, from
    which it follows. ``turns``: the result is an angular rate, for whose sense a form has room.
    ``reason``: the key of the reason, where the construction of its step gives none.
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
    takes: str = ""
    turns: bool = False
    reason: str = ""

    def parts(self, *, solved: bool) -> list[str]:
        """The pieces between which the line may be broken."""
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
    """A number as inserted in a relation, without trailing zeros."""
    text = drawing.words.significant(value, digits)
    mark = drawing.words("decimal_mark")
    return text.rstrip("0").rstrip(mark) if mark in text and "·" not in text else text


def answer(drawing: Drawing, value: float) -> str:
    """A number as the result of a relation."""
    return drawing.words.significant(value, 4)


def put_in(
    drawing: Drawing,
    result: str,
    worth: Callable[..., float],
    *values: float,
    shown_as: Callable[[Drawing, float], str] = answer,
) -> tuple[str, ...]:
    """Numbers as inserted in a relation, with enough digits that the result follows from them.

    ``worth`` computes the result as a pocket calculator does, ``shown_as`` prints it.
    """
    for digits in range(DIGITS, DIGITS + MORE):
        rounded_off = (float(f"{value:.{digits - 1}e}") for value in values)
        if shown_as(drawing, worth(*rounded_off)) == result:
            break
    return tuple(figure(drawing, value, digits) for value in values)


def within(drawing: Drawing, value: float) -> str:
    """A number after an operator: in brackets if it is negative."""
    return bracketed(figure(drawing, value, FINE))


def bracketed(number: str) -> str:
    """A printed number after an operator: in brackets if it is negative."""
    return f"({number})" if number.startswith("−") else number


UNSEEN = 0.1
"""A length on paper below this, in mm, is next to nothing."""


def value_of(words: Words, size: float, length: OnPaper) -> str:
    """The value of a vector with a drawn length in mm; in two digits where it is tiny."""
    return words.significant(size, 2 if length < UNSEEN else 4)


def ruler_places(millimetres: OnPaper) -> int:
    """Decimals of a drawn length set with a ruler: 0.1 mm, below 1 mm two digits."""
    return max(1 - floor(log10(millimetres)), 1) if millimetres else 1


def length_laid_off(drawing: Drawing, millimetres: float) -> str:
    """A length to be laid off, as the sheet prints it: to 0.01 mm, or finer if tiny."""
    return drawing.words.fixed(millimetres, max(ruler_places(OnPaper(millimetres)), 2))


def as_read(drawing: Drawing, millimetres: OnPaper, scale: float) -> tuple[str, str]:
    """A drawn length times the scale per millimetre, and the resulting value of the sheet.

    The length is printed to 0.1 mm, or with as many more digits as the value needs.
    """
    if not millimetres:
        return f"{figure(drawing, scale)}·0", "0"
    value = value_of(drawing.words, scale * millimetres, millimetres)
    first = ruler_places(millimetres)
    places = next(
        (
            some
            for some in range(first, first + DIGITS)
            if value
            == value_of(
                drawing.words, rounded_figure(scale) * round(millimetres, some), millimetres
            )
        ),
        first + 2,
    )
    return f"{figure(drawing, scale)}·{drawing.words.fixed(millimetres, places)}", value


def drawn_length(drawing: Drawing, millimetres: OnPaper) -> str:
    """A drawn length, to a thousandth of a millimetre or five digits."""
    return figure(drawing, millimetres if millimetres < 10 else round(millimetres, 3))


def length_of(drawing: Drawing, p: str, q: str) -> float:
    """The length of a bar in metres."""
    return abs(drawing.standing.spot(q) - drawing.standing.spot(p))


def rounded_figure(value: float) -> float:
    """A number rounded to its printed digits, as a reader would use it."""
    return float(f"{value:.{DIGITS - 1}e}")


def squared(figures: str) -> str:
    """The square of an inserted value; a power of ten is squared with the rest."""
    return f"({figures})^2" if "·" in figures else f"{figures}^2"


# --- lengths at a scale other than that of a plan ------------------------------------------------


def set_length(drawing: Drawing, vector: str) -> str:
    """A velocity as set on the mechanism: one m-th of its segment in the plan."""
    return divided(drawing, vector, drawing.scales.larger)


def twice_set(drawing: Drawing, segment: str) -> str:
    """Twice a segment of the plan as set on the mechanism: 2·ab, 2·ab/5, or ab itself."""
    if drawing.scales.larger == 2:
        return segment
    return set_length(drawing, saying(f"2·{segment}", segment))


def laid_times(drawing: Drawing) -> str:
    """The factor before a length of the mechanism that is laid off m′ times in the plan."""
    times = drawing.scales.larger_still
    return "" if times == 1 else f"{figure(drawing, times)}·"


def divided(drawing: Drawing, what: str, times: float) -> str:
    """A length divided by a number, or multiplied where that is below one, as markup."""
    if times == 1:
        return what
    larger = f"{what}/{figure(drawing, times)}", f"{inverse(drawing, times)}·{what}"
    return saying(larger[times < 1], what)


def inverse(drawing: Drawing, times: float) -> str:
    """The inverse of a number as printed: 4/3 where its decimal does not end."""
    part = Fraction(1 / times).limit_denominator(9)
    if part.denominator % 3 == 0 and isclose(part, 1 / times, rel_tol=1e-9):
        return str(part)
    return figure(drawing, 1 / times)


def beside_plan(drawing: Drawing, kind: str) -> str:
    """The scale of vectors on the mechanism relative to the plan; empty where they are equal."""
    times = drawing.scales.times(kind)
    if times == 1:
        return ""
    if times > 1:
        return drawing.words("page.shorter", m=figure(drawing, times))
    return drawing.words("page.longer", m=inverse(drawing, times))
