"""The calculation, on A4 or Letter: relations with number, symbols, figures, result and sense.

The relations of a calculation as a LaTeX document, for a script.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, takewhile

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import parameters
from graphkin.construction.core.relation import Relation, Term, VectorEquation
from graphkin.documents.relations import answers, in_results, relations, travel_words
from graphkin.documents.sheet import title_of
from graphkin.drawing.field import A4_AREA, A4_SIZE, text_page
from graphkin.drawing.frame import on_page, page_frame
from graphkin.drawing.marks import LineMark, Mark, Page, Polyline, Text, box
from graphkin.drawing.richtext import (
    PRIMES,
    TextRun,
    advance,
    extent,
    flowed,
    laid,
    narrow_words,
    pieces,
    plain,
    words_of,
)
from graphkin.drawing.symbol_markup import escape
from graphkin.text import Words
from graphkin.text.errors import PageError, message
from graphkin.writers.latex import formula_of, head, latex, maths
from graphkin.writers.latex import words as text_of

EQUATION_LETTER, NOTE = 2.5, 2.5
"""Heights of symbols and of the notes on what is known of them, in mm."""
UNDER, BETWEEN, BELOW = 1.7, 0.6, 5.9
"""Distances in mm: first line below a symbol, spacing of two lines, and baseline of the note.

They keep a power in the note clear of both lines.
"""
OVER, RAISED, BEYOND, HEAD = 3.2, 4.0, 0.35, 0.5
"""Arrows above vectors, in mm: height, height above a superscript, overhang, length of the head."""
APART, SPACE = 1.6, 1.2
"""Least room between notes, and space between symbols, in mm."""
DEPTH, UNDERLINED = 5.8, 2.0
"""Extra depth of a line with notes, and of a line with underlines only, in mm."""


def depth(equation: VectorEquation, *, solved: bool) -> float:
    """The extra depth of the line of an equation, in mm."""
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
    """The width of an equation, in mm."""
    return max(x + wide for x, wide, _, _ in placed(equation, 0.0, solved=solved))


def placed(
    equation: VectorEquation, x: float, *, solved: bool
) -> Iterator[tuple[float, float, str, Term | None]]:
    """The start, width and markup of each sign and vector of an equation, with its term."""
    signs: list[tuple[str, Term | None]] = [(equation.whole.symbol, equation.whole)]
    for terms in equation.sums:
        for i, term in enumerate(terms):
            signs += [("+" if i else "=", None), (term.symbol, term)]
    for markup, vector in signs:
        if not markup:
            x += 3 * SPACE
            continue
        own = extent(markup, EQUATION_LETTER)[0]
        said = vector.note if vector and solved else ""
        wide = max(own, extent(said, NOTE)[0] + APART if said else 0.0)
        yield x + (wide - own) / 2, own, markup, vector
        x += wide + SPACE


def equation_marks(
    equation: VectorEquation, x: float, y: float, words: Words, *, solved: bool
) -> list[Mark]:
    """An equation whose baseline starts at a place; with underlines and notes if solved."""
    marks: list[Mark] = []
    for left, wide, markup, term in placed(equation, x, solved=solved):
        marks.append(Text(left, y, markup, "caption equation", EQUATION_LETTER))
        if term is None:
            continue
        marks += vector_mark(
            left, y, laid(markup, EQUATION_LETTER)[0], words("calculation.vector_mark")
        )
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
    """The arrow or the bar above the letter of a vector, which is the first of its runs."""
    letter, *scripts = runs
    y -= RAISED if any(run.y < 0 for run in scripts) else OVER
    end = x + advance(letter.text, letter.italic) * letter.size + BEYOND
    yield LineMark(x, y, end, y, "panel", "vector")
    if kind == "arrow":
        head = ((end - HEAD, y - HEAD / 2), (end, y), (end - HEAD, y + HEAD / 2))
        yield Polyline(head, "panel", "vector")


# --- the A4 calculation pages ---------------------------------------------------------------------


LETTER = 2.5
LINE, GAP = 5.5, 3.0
"""Least distance of lines, and the extra distance above a heading, in mm."""
SOLVED, BY_HAND = (6.0,), (7.5, 7.0, 6.5, 6.0)
"""Distances of lines, solved and to be filled in; a wider one must not need more pages."""
LEFT, RIGHT = A4_AREA[0] + 4, A4_AREA[2] - 4
INDENT = 3.0
"""Indent of lines below their heading, in mm."""
ROOM = RIGHT - LEFT - INDENT
"""The width of these lines, in mm."""
TOP, BOTTOM = A4_AREA[1] + 8, A4_AREA[3] - 4
HALF = A4_SIZE[1] / 2
"""A page whose last line is higher is less than half full, in mm."""
SHORT = 3
"""The most lines of a section that stays with its heading."""
EVEN = 0.75
"""Least height of a page's lines in that of the fullest page, except on the last page."""
DOT = ". "
BLANK = DOT * 13 + DOT[0]
"""The least room to write in, on the form to be filled in."""
FIRST = "velocities"
"""The section whose heading explains the marks of vector equations."""
NUMBER = 12.0
"""Width kept free at the right for the relation's number, in mm."""


class CalculationRow(Struct, frozen=True):
    """A line of the page: a heading, a legend, a numbered relation, or a vector equation.

    ``depth`` is the extra depth of the line in mm. A frame is drawn around ``boxed`` lines.
    """

    markup: str
    number: str = ""
    heading: bool = False
    legend: bool = False
    equation: VectorEquation | None = None
    boxed: bool = False
    depth: float = 0.0


NOTHING: Mapping[str, str] = {}


def calculation(
    drawings: Sequence[Drawing], view: str, computed: Mapping[str, str] = NOTHING
) -> tuple[Page, ...]:
    """The calculation pages of the drawn sheets, solved or to be filled in.

    ``computed`` gives, by symbol, the reason why a quantity is computed instead of measured.
    """
    rows = list(all_rows(drawings, computed, solved=view == "key"))
    bottom = BOTTOM - text_page(drawings[0].paper.name).shorter
    pages = laid_out(rows, solved=view == "key", bottom=bottom)
    return tuple(
        page_of(drawings[0], page, view, f"{i}/{len(pages)}") for i, page in enumerate(pages, 1)
    )


def all_rows(
    drawings: Sequence[Drawing], computed: Mapping[str, str], *, solved: bool
) -> Iterator[CalculationRow]:
    """All lines in order, with the relations numbered."""
    number = 0
    for section, found in relations(drawings, solved=solved):
        if not found:
            continue
        words = drawings[0].words
        yield CalculationRow(words(f"calculation.{section}"), heading=True)
        for legend in legends(drawings, section, found, solved=solved):
            for line in flowed(words_of(legend), "", ROOM, LETTER):
                yield CalculationRow(line, legend=True)
        for relation in found:
            if relation.equation and relation.equation.sums:
                for part in equation_lines(relation.equation, ROOM, solved=solved):
                    deep = depth(part, solved=solved)
                    yield CalculationRow(part.markup, equation=part, depth=deep)
                continue
            number += bool(relation.result)
            tag = f"({number})" if relation.result else ""
            hint = computed.get(relation.left, "") if relation.result else ""
            yield from broken(relation, tag, drawings[0], hint, solved=solved)
    if solved:
        yield from boxed_answers(drawings)


def boxed_answers(drawings: Sequence[Drawing]) -> Iterator[CalculationRow]:
    """All results that the scene asks for, together."""
    found = [
        " ".join(in_results(drawing, each).parts(solved=True))
        for drawing in drawings
        for each in answers(drawing)
    ]
    if found:
        yield CalculationRow(drawings[0].words("calculation.answers"), heading=True, boxed=True)
        mark, room = drawings[0].words("clause_mark").rstrip(), ROOM - INDENT
        marked = [*(f"{each}{mark}" for each in found[:-1]), found[-1]]
        for line in flowed(narrowed(marked, room), "", room, LETTER):
            yield CalculationRow(line, boxed=True)


def narrowed(parts: Sequence[str], room: float) -> list[str]:
    """The parts of a line; one wider than the room as its words."""
    return [
        piece
        for part in parts
        for piece in (
            narrow_words(part, room, LETTER) if extent(part, LETTER)[0] > room else [part]
        )
    ]


def legends(
    drawings: Sequence[Drawing], section: str, found: Sequence[Relation], *, solved: bool
) -> Iterator[str]:
    """The sentences below a heading: how solved lines are read, and what travel a task asks for."""
    words = drawings[0].words
    if section == "travel" and not solved:
        yield words.clauses(travel_words(drawings[0]))
    if section != FIRST or not solved:
        return
    yield words("calculation.readings")
    if any(relation.equation for relation in found):
        yield words("calculation.underlined")
        if any(drawing.auxiliary for drawing in drawings):
            yield words("calculation.tried")


def broken(
    relation: Relation, tag: str, drawing: Drawing, hint: str = "", *, solved: bool
) -> Iterator[CalculationRow]:
    """A relation in as many lines as needed, its number on the last one, a hint after it."""
    room = RIGHT - LEFT - NUMBER
    parts = narrowed(relation.parts(solved=solved), room)
    if relation.blank and not solved:
        parts = [*parts[:-1], f"{parts[-1]} {relation.blank[0]}", *relation.blank[1:]]
    elif relation.result and not (solved or relation.given):
        parts = [*parts[:-1], f"{parts[-1]} {BLANK} {relation.unit}".rstrip()]
        if relation.turns:
            parts.append(f"({drawing.words('table.sense')}{drawing.words('colon')}{BLANK})")
    parts += [f"({hint})"] if hint else []
    lines = flowed(parts, "", room, LETTER)
    for i, line in enumerate(lines):
        if extent(line, LETTER)[0] > room:
            raise PageError.at(
                "calculation",
                message("does not fit: {line}", line=plain(line)),
                message("a shorter relation"),
                message("shorten the names of the points"),
            )
        written = line if solved else dotted(line, room)
        yield CalculationRow(written, tag if i == len(lines) - 1 else "")


def dotted(line: str, room: float) -> str:
    """A line whose first blank is extended to the room available."""
    more = int((room - extent(line, LETTER)[0]) / extent(DOT + DOT, LETTER)[0] * 2)
    return line.replace(BLANK, DOT * max(more, 0) + BLANK, 1)


def laid_out(
    rows: Sequence[CalculationRow], *, solved: bool, bottom: float = BOTTOM
) -> list[list[tuple[float, CalculationRow]]]:
    """The lines on as few pages as possible, balanced between the pages.

    Pages begin with a heading where that needs no extra page and leaves none but the last less
    than half full, or much emptier than another. Lines are spaced as widely as the number of pages
    allows.
    """
    count = len(paged(rows, LINE, bottom))
    some = SOLVED if solved else BY_HAND
    line = next((line for line in some if len(paged(rows, line, bottom)) == count), LINE)

    def held(low: float, *, whole: bool) -> list[list[tuple[float, CalculationRow]]] | None:
        pages = paged(rows, line, low, whole=whole)
        parted = whole and not all(page[0][1].heading for page in pages)
        return None if parted or len(pages) > count else pages

    def balanced(
        found: list[list[tuple[float, CalculationRow]]], *, whole: bool
    ) -> list[list[tuple[float, CalculationRow]]]:
        low, high = TOP, bottom
        while count > 1 and high - low > LINE:
            middle = (low + high) / 2
            less = held(middle, whole=whole)
            low, high, found = (low, middle, less) if less else (middle, high, found)
        return found

    if whole := held(bottom, whole=True):
        pages = balanced(whole, whole=True)
        ends = [page[-1][0] for page in pages]
        least = max(HALF, TOP + EVEN * (max(ends) - TOP))
        if all(end > least for end in ends[:-1]):
            return pages
    return balanced(paged(rows, line, bottom), whole=False)


def paged(
    rows: Sequence[CalculationRow], line: float, bottom: float, *, whole: bool = False
) -> list[list[tuple[float, CalculationRow]]]:
    """The lines with their places, page by page; no heading and no single line ends a page.

    With ``whole``, the lines below a heading stay on its page if one page holds them.
    """
    pages: list[list[tuple[float, CalculationRow]]] = [[]]
    y = TOP
    for i, row in enumerate(rows):
        page = pages[-1]
        step = line + (GAP if row.heading and page else 0) + (page[-1][1].depth if page else 0)
        below = sum(line + each.depth for each in kept_with(rows, i, whole=whole))
        if page and y + step + below + row.depth > bottom:
            pages.append([])
            page, y, step = pages[-1], TOP, line
        y = y + step if page else y
        page.append((y, row))
    return pages


def kept_with(rows: Sequence[CalculationRow], i: int, *, whole: bool) -> Sequence[CalculationRow]:
    """The lines after a line that stay on its page: no page has a single line of a section."""
    rest = [*takewhile(lambda each: not each.heading, rows[i + 1 :])]
    if rows[i].heading:
        return rest if whole or len(rest) <= SHORT else rest[:2]
    return rest if len(rest) == 1 else ()


def page_of(
    drawing: Drawing, rows: Sequence[tuple[float, CalculationRow]], view: str, number: str
) -> Page:
    """One page."""
    words = drawing.words
    title = words.clauses([escape(title_of(drawing)), *parameters(drawing.scene, words)])
    name = words("sheet.document_calculation", view=words(f"sheet.{view}"))
    sheet = drawing.scene.sheet
    made, whose = escape(sheet.author), escape(sheet.student)
    if view == "task" or whose or not made:
        made = f"{words('block.creator')}{words('colon')}{made}" if made else ""
        foot = whose or words("page.student"), "   ".join(filter(None, (made, number)))
    else:
        foot = made, number
    boxed: list[float] = []
    page = text_page(drawing.paper.name)
    marks: list[Mark] = [*page_frame((title, name), foot, drawing.scene.house.header, page)]
    for y, row in rows:
        look = "caption equation" if row.legend else "caption answer" if row.boxed else "caption"
        if row.heading:
            marks.append(Text(LEFT, y, row.markup, look, 3.5))
            continue
        if row.equation:
            marks += equation_marks(row.equation, LEFT + INDENT, y, words, solved=view == "key")
            continue
        if row.boxed:
            boxed.append(y)
        marks.append(Text(LEFT + INDENT, y, row.markup, look, LETTER))
        if row.number:
            marks.append(Text(RIGHT, y, row.number, "caption", LETTER, "end"))
    if boxed:
        high, low = boxed[0] - LINE + APART, boxed[-1] + APART
        marks.append(box(LEFT, high, RIGHT - LEFT, low - high, "panel answer"))
    return on_page(page, marks, f"{title_of(drawing)} – {name}", words.language)


ARROWS = {"arrow": r"\vec", "bar": r"\overline"}
"""The marks of vectors by their names in the words."""


def calculation_tex(drawings: Sequence[Drawing], view: str) -> str:
    """The calculation of a mechanism: sections of numbered relations and vector equations.

    A task has room in place of the results.
    """
    words = drawings[0].words
    lines = [
        head("article", "a4paper,10pt", words.language),
        r"\setlength{\parindent}{0pt}",
        r"\setlength{\parskip}{4pt}",
        r"\begin{document}",
        f"\\section*{{{text_of(title_of(drawings[0]))}}}",
        *written(drawings, solved=view == "key"),
        r"\end{document}",
    ]
    return "\n".join(lines) + "\n"


def written(drawings: Sequence[Drawing], *, solved: bool) -> Iterator[str]:
    """The sections with their relations, numbered as on the calculation page."""
    words, number = drawings[0].words, 0
    for section, found in relations(drawings, solved=solved):
        if not found:
            continue
        yield f"\\subsection*{{{latex(words(f'calculation.{section}'))}}}"
        for legend in legends(drawings, section, found, solved=solved):
            yield f"\\emph{{{latex(legend)}}}\n"
        for relation in found:
            if relation.equation and relation.equation.sums:
                yield equation(relation.equation, words, solved=solved)
                continue
            number += bool(relation.result)
            yield line(relation, number, solved=solved)


def line(relation: Relation, number: int, *, solved: bool) -> str:
    """A relation in a paragraph, its number at the right."""
    said = " ".join(latex(part) for part in relation.parts(solved=solved))
    if not relation.result:
        return f"{said}\n"
    open_ = not (solved or relation.given)
    room = f" \\dotfill\\ {latex(relation.unit)}\\quad" if open_ else r" \hfill "
    return f"{said}{room}({number})\n"


def equation(found: VectorEquation, words: Words, *, solved: bool) -> str:
    """A vector equation; what is known of each vector is below it if solved."""
    mark = ARROWS[words("calculation.vector_mark")]
    sums = (" + ".join(vector(term, mark, solved) for term in terms) for terms in found.sums)
    return f"\\[{' = '.join((vector(found.whole, mark, solved), *sums))}\\]\n"


def vector(term: Term, mark: str, solved: bool) -> str:
    """A vector with its arrow or bar, underlined once for each part that is known."""
    letter, *scripts = pieces(term.symbol)
    bare = letter.text.rstrip(PRIMES)
    rest = [letter._replace(text=letter.text[len(bare) :]), *scripts]
    said = f"{mark}{{{maths_of(bare)}}}{formula_of(rest)}"
    if not solved:
        return said
    for _ in range(term.known):
        said = f"\\underline{{{said}}}"
    return f"\\underset{{{maths(term.note)}}}{{{said}}}" if term.note else said


def maths_of(letter: str) -> str:
    """The italic letter of a vector as LaTeX mathematics."""
    return maths(f"*{letter}*")
