"""Relations of the calculation: symbols, figures put in, result with its unit and sense; and
vector equations as the school writes them, with what is known of each vector below it.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import floor, isclose, log10

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.quantities import OnPaper
from graphkin.text import Words
from graphkin.text.markup import saying


class Term(Struct, frozen=True):
    """A vector under its ``symbol``: of its size and direction, how many are ``known``, and how,
    before the equation is solved that it stands in.
    """

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

    def joined_to(self, before: VectorEquation) -> VectorEquation:
        """It and one for the same vector as one; or with what is known of a summand put in."""
        if before.whole.symbol == self.whole.symbol:
            whole = max(before.whole, self.whole, key=lambda term: term.known)
            if before.whole.known and self.whole.known and before.whole.note != self.whole.note:
                whole = Term(whole.symbol, 1, f"{before.whole.note}, {self.whole.note}")
            return VectorEquation(whole, before.sums + self.sums)
        return VectorEquation(self.whole, tuple(map(before.put_into, self.sums)))

    def put_into(self, terms: tuple[Term, ...]) -> tuple[Term, ...]:
        """A sum with what is known of this vector in its place: its own sum, or how it lies."""
        own = self.sums[0] if self.sums else (self.whole,)
        symbol = self.whole.symbol
        return tuple(each for t in terms for each in (own if t.symbol == symbol else (t,)))


DIGITS = 5
"""Significant digits of figures put in, so that results of four digits follow from them."""
MORE = 4
"""How many digits more than those are tried where the result does not follow from them."""
FINE = 6
"""The same of rates put into sums, whose digits may cancel."""


class Relation(Struct, frozen=True):
    """left = symbols = figures = result unit, remark; ``more`` are further words after ``left``.

    ``equals``: what stands before a result, nothing where it is said in words. ``over``: the ends
    of the lengths that it takes. ``blank``: what a form has for a result that is no single number,
    and how it is counted. ``equation``: the vector equation that it is. ``given``: it is chosen, so
    that a form states it. ``takes``: the symbol of what is found in the plan, or of the rate, from
    which it follows. ``turns``: its result is a rate of turning, for whose sense a form has room.
    ``reason``: the key of why it holds, where the construction of its step does not say.
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


def answer(drawing: Drawing, value: float) -> str:
    """A number as it comes out of a relation."""
    return drawing.words.significant(value, 4)


def put_in(
    drawing: Drawing,
    result: str,
    worth: Callable[..., float],
    *values: float,
    told: Callable[[Drawing, float], str] = answer,
) -> tuple[str, ...]:
    """Numbers as they are put into a relation: so many digits that its result follows from them.

    ``worth`` is what a pocket calculator makes of them, ``told`` how that is written.
    """
    for digits in range(DIGITS, DIGITS + MORE):
        rounded_off = (float(f"{value:.{digits - 1}e}") for value in values)
        if told(drawing, worth(*rounded_off)) == result:
            break
    return tuple(figure(drawing, value, digits) for value in values)


def within(drawing: Drawing, value: float) -> str:
    """A number after a sign: in brackets if it is negative."""
    return bracketed(figure(drawing, value, FINE))


def bracketed(number: str) -> str:
    """A printed number after a sign: in brackets where it is negative."""
    return f"({number})" if number.startswith("−") else number


UNSEEN = 0.1
"""A length on paper below this, in mm, is a point's: next to nothing."""


def value_of(words: Words, size: float, length: OnPaper) -> str:
    """The value of a vector that is so many mm long; in two digits where it is next to nothing."""
    return words.significant(size, 2 if length < UNSEEN else 4)


def ruler_places(millimetres: OnPaper) -> int:
    """Decimals of a drawn length that is set with a ruler: 0.1 mm, below 1 mm two digits."""
    return max(1 - floor(log10(millimetres)), 1) if millimetres else 1


def laid_off(drawing: Drawing, millimetres: float) -> str:
    """A length to be laid off, as the sheet's sentence has it: to 0.01 mm, or finer if tiny."""
    return drawing.words.fixed(millimetres, max(ruler_places(OnPaper(millimetres)), 2))


def as_read(drawing: Drawing, millimetres: OnPaper, scale: float) -> tuple[str, str]:
    """A drawn length times what a millimetre stands for, and its value: that on the sheet.

    The length is told to 0.1 mm, or in as many digits more as that value follows from.
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
    """Length of a bar in metres."""
    return abs(drawing.standing.spot(q) - drawing.standing.spot(p))


def rounded_figure(value: float) -> float:
    """A number as large as its figure: what a reader who takes the figure computes from."""
    return float(f"{value:.{DIGITS - 1}e}")


def squared(figures: str) -> str:
    """The square of a figure that is put in; a power of ten is squared with the rest."""
    return f"({figures})^2" if "·" in figures else f"{figures}^2"


# --- lengths at another scale than that of a plan ----------------------------------------------


def set_length(drawing: Drawing, vector: str) -> str:
    """A velocity as it is set on the mechanism: one m-th of its segment in the plan."""
    return divided(drawing, vector, drawing.scales.larger)


def twice_set(drawing: Drawing, segment: str) -> str:
    """Twice a segment of the plan as it is set on the mechanism: 2·ab, 2·ab/5, or ab itself."""
    if drawing.scales.larger == 2:
        return segment
    return set_length(drawing, saying(f"2·{segment}", segment))


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
