"""Vector equations on calculation pages: vectors marked as such, and what is known below them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from graphkin.construction.core.relation import Term, VectorEquation
from graphkin.drawing.glyphs import advance
from graphkin.drawing.marks import LineMark, Mark, Polyline, Text
from graphkin.drawing.richtext import TextRun, extent, laid
from graphkin.text import Words

LETTER, NOTE = 2.5, 1.8
"""Heights of symbols and of what is known of them, in mm."""
UNDER, BETWEEN, BELOW = 1.7, 0.6, 5.3
"""The first line below a symbol, the distance of two, and the baseline of its note, in mm: a power
in the note stays clear of both lines."""
OVER, RAISED, BEYOND, HEAD = 3.2, 4.0, 0.35, 0.5
"""Where the arrow above a vector stands, and above one with a superscript, of which it stays clear,
how far it reaches beyond its letter, its head, in mm."""
APART, SPACE = 1.6, 1.2
"""Least room between notes, and what stands between signs besides, in mm."""
DEPTH, UNDERLINED = 5.2, 2.0
"""How much deeper than others a line with notes is, and one that is underlined alone, in mm."""


def depth(equation: VectorEquation, *, solved: bool) -> float:
    """How much deeper than others the line of an equation is, in mm."""
    terms = (equation.whole, *chain(*equation.sums))
    if not solved:
        return 0.0
    return DEPTH if any(term.note for term in terms) else UNDERLINED


def equation_lines(equation: VectorEquation, room: float, *, solved: bool) -> list[VectorEquation]:
    """An equation in as many lines as it needs: one, or one for each sum."""
    if width(equation, solved=solved) <= room or len(equation.sums) < 2:
        return [equation]
    first, *rest = equation.sums
    nothing = Term("")
    return [
        VectorEquation(equation.whole, (first,)),
        *(VectorEquation(nothing, (s,)) for s in rest),
    ]


def width(equation: VectorEquation, *, solved: bool) -> float:
    """How wide an equation is, in mm."""
    return max(x + wide for x, wide, _, _ in placed(equation, 0.0, solved=solved))


def placed(
    equation: VectorEquation, x: float, *, solved: bool
) -> Iterator[tuple[float, float, str, Term | None]]:
    """Where each sign and each vector begins, how wide it is, and its markup."""
    signs: list[tuple[str, Term | None]] = [(equation.whole.symbol, equation.whole)]
    for terms in equation.sums:
        for i, term in enumerate(terms):
            signs += [("+" if i else "=", None), (term.symbol, term)]
    for markup, vector in signs:
        if not markup:
            x += 3 * SPACE
            continue
        own = extent(markup, LETTER)[0]
        said = vector.note if vector and solved else ""
        wide = max(own, extent(said, NOTE)[0] + APART if said else 0.0)
        yield x + (wide - own) / 2, own, markup, vector
        x += wide + SPACE


def equation_marks(
    equation: VectorEquation, x: float, y: float, words: Words, *, solved: bool
) -> list[Mark]:
    """An equation with its baseline's start at a place; solved with underlines and notes."""
    marks: list[Mark] = []
    for left, wide, markup, term in placed(equation, x, solved=solved):
        marks.append(Text(left, y, markup, "caption equation", LETTER))
        if term is None:
            continue
        marks += vector_mark(left, y, laid(markup, LETTER)[0], words("calculation.vector_mark"))
        if not solved:
            continue
        for i in range(term.known):
            low = y + UNDER + i * BETWEEN
            marks.append(LineMark(left, low, left + wide, low, "panel", "known"))
        if term.note:
            at = left + wide / 2
            marks.append(
                Text(at, y + BELOW, term.note, "caption equation", NOTE, "middle", "known")
            )
    return marks


def vector_mark(x: float, y: float, runs: Sequence[TextRun], kind: str) -> Iterator[Mark]:
    """The arrow, or the bar, above the letter of a vector, the first of its runs."""
    letter, *scripts = runs
    y -= RAISED if any(run.y < 0 for run in scripts) else OVER
    end = x + advance(letter.text, letter.italic) * letter.size + BEYOND
    yield LineMark(x, y, end, y, "panel", "vector")
    if kind == "arrow":
        head = ((end - HEAD, y - HEAD / 2), (end, y), (end - HEAD, y + HEAD / 2))
        yield Polyline(head, "panel", "vector")
