"""The A4 form for answers: a row for every field of a lab, with room to write its value."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from math import ceil

from graphkin.classroom.lab.items import motion_of
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.printing.personal import SIDE, square
from graphkin.construction.core.quantities import BY_TARGET
from graphkin.drawing.field import A4_AREA, A4_PAGE, TextPage
from graphkin.drawing.frame import on_page, page_frame
from graphkin.drawing.marks import LineMark, Mark, Page, Text, box
from graphkin.drawing.richtext import extent, flowed, words_of
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.text import Words

LEFT, RIGHT, TOP, BOTTOM = A4_AREA[0] + 4, A4_AREA[2] - 4, A4_AREA[1] + 4, A4_AREA[3] - 4
ROW, MOST_ROW = 7.0, 9.0
"""The least height of a row for handwriting, and the greatest where there is room, in mm."""
HEAD = SIDE + 14.0
"""The height of the head with the QR code and the text next to it, in mm."""
BESIDE = RIGHT - LEFT - SIDE - 8.0
"""The width for the name next to the QR code, in mm."""
WIDTHS = (34.0, 40.0, 58.0, 22.0, 18.0)
"""The widths of the columns quantity, name of the field, answer, unit and points, in mm."""
LETTER, SMALL, LEADING = 2.5, 1.8, 4.0
"""Heights of letters, the small ones for what is too long for its cell, and distance of lines."""


def form(
    items: Sequence[Item],
    points: Mapping[str, Fraction],
    compute: Collection[str],
    words: Words,
    header: tuple[str, str],
    owner: tuple[str, str],
    pivot: str = "",
    school: Sequence[str] = (),
    paper: TextPage = A4_PAGE,
) -> tuple[Page, ...]:
    """The pages of a form: its fields in order, those in ``compute`` marked as computed.

    ``header`` is markup for the left and right of the head, ``owner`` the student's name and opaque
    code. ``pivot`` is the first fixed point, from which places are measured. Points are shown where
    the rubric gives any, with their sum. ``school`` are the lines of a school's header.
    """
    if not items:
        return ()
    said = advice(items, words, pivot)
    rows = [row(item, points, compute, words) for item in items]
    if total := sum((points[item.field] for item in items if item.field in points), Fraction()):
        rows.append(("", "", "", words("form.total"), worth_words(total, words)))
    height = row_height(len(rows), paper)
    room = rows_within(height, paper)
    parts = [rows[i : i + room] for i in range(0, len(rows), room)]
    return tuple(
        page_of(part, words, header, owner, f"{i}/{len(parts)}", said, height, school, paper)
        for i, part in enumerate(parts, 1)
    )


def rows_within(height: float, paper: TextPage = A4_PAGE) -> int:
    """The number of rows of a height that fit on a page below the head of its table."""
    return int((BOTTOM - paper.shorter - TOP - HEAD) / height + 1e-9) - 1


def row_height(count: int, paper: TextPage = A4_PAGE) -> float:
    """The height of a row, in mm: that for handwriting, or more where the page has room."""
    pages = ceil(count / rows_within(ROW, paper))
    room = (BOTTOM - paper.shorter - TOP - HEAD) / (ceil(count / pages) + 1)
    return max(ROW, min(room, MOST_ROW))


def advice(items: Sequence[Item], words: Words, pivot: str) -> tuple[str, ...]:
    """Instructions, as markup, on writing numbers, senses and places, for the kinds in the form."""
    kinds = {item.what for item in items}
    senses = {BY_TARGET[item.quantity].whose for item in items if item.what == "sense"}
    said = [words("form.numbers")]
    if senses - {"slides"}:
        said.append(words("form.senses"))
    if "slides" in senses:
        said.append(words("form.slides"))
    if "place" in kinds:
        said.append(words("form.places", pivot=symbol(pivot)))
    return tuple(said)


def row(
    item: Item, points: Mapping[str, Fraction], compute: Collection[str], words: Words
) -> tuple[str, ...]:
    """The cells of a field: symbol, name, a hint if it is computed, unit and points."""
    what = f"{item.symbol}, {words('table.sense')}" if item.what == "sense" else item.symbol
    hint = why(item, words) if item.field in compute else ""
    worth = points.get(item.field)
    written = worth_words(worth, words) if worth is not None else ""
    return what, escape(item.field), hint, item.unit, written


def worth_words(points: Fraction, words: Words) -> str:
    """Points with four significant digits at most."""
    return words.decimal(f"{float(points):.4g}")


def why(item: Item, words: Words) -> str:
    """Why a field is computed instead of measured."""
    return words("form.compute_place" if item.what == "place" else "form.compute")


def quantity_of(item: Item) -> str:
    """The symbol of a field's quantity in the calculation: J₃ for its coordinates."""
    if item.what != "place":
        return item.symbol
    return symbol(f"{motion_of(item).letter}_{item.of}")


def page_of(
    rows: Sequence[tuple[str, ...]],
    words: Words,
    header: tuple[str, str],
    owner: tuple[str, str],
    number: str,
    said: Sequence[str],
    height: float,
    school: Sequence[str],
    paper: TextPage,
) -> Page:
    """One page."""
    name, code = owner
    foot = escape(f"{name}   {code}"), number
    marks: list[Mark] = [*page_frame(header, foot, school, paper)]
    marks += square(code, RIGHT - SIDE - 1, TOP + 1)
    letters = next((h for h in (3.5, 2.5) if extent(escape(name), h)[0] <= BESIDE), SMALL)
    marks.append(Text(LEFT, TOP + 7, escape(name), "caption", letters, name="owner"))
    marks.append(Text(LEFT, TOP + 13.5, escape(code), "caption", 3.5, name="code"))
    lines = [line for each in said for line in flowed(words_of(each), " ", BESIDE, LETTER)]
    for i, line in enumerate(lines):
        marks.append(Text(LEFT, TOP + 18.5 + LEADING * i, line, "caption", LETTER))
    names = ("table.symbol", "form.field", "form.answer", "form.unit", "form.points")
    marks += table(TOP + HEAD, [tuple(words(key) for key in names), *rows], height)
    return on_page(paper, marks, f"{words('form.title')} – {code}", words.language)


def table(top: float, rows: Sequence[tuple[str, ...]], height: float) -> Iterator[Mark]:
    """A ruled table across the page, its first row the head; a hint is at the right of its cell."""
    width, low = sum(WIDTHS), top + len(rows) * height
    yield box(LEFT, top, width, height, "shade")
    for i in range(len(rows) + 1):
        yield LineMark(LEFT, top + i * height, LEFT + width, top + i * height, "panel")
    x = LEFT
    for column, across in enumerate((*WIDTHS, 0.0)):
        yield LineMark(x, top, x, low, "panel")
        for i, cells in enumerate(rows):
            base = top + (i + 1) * height - 2.3
            if column < len(cells) and cells[column]:
                yield cell(cells[column], x, across, base, hint=i and column == 2)
        x += across


def cell(markup: str, x: float, width: float, base: float, *, hint: int | bool) -> Text:
    """The text of a cell, in lettering that fits."""
    wide = extent(markup, LETTER)[0] > width - 2
    height = SMALL if wide or hint else LETTER
    if hint:
        return Text(x + width - 1.5, base, markup, "caption", height, "end", "hint")
    return Text(x + 1.5, base, markup, "caption", height)
