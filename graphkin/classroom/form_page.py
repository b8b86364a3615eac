"""The answer form of a lab for a web page: a student fills it in and saves the file to grade.

The form sends nothing anywhere and contains nothing of the key. The browser keeps what was typed,
and a button saves it as the CSV file that ``graphkin grade`` reads. The markup contains no scripts
and no styles: the page adds both where its security policy allows them.

The A4 form for answers: a row for every field of a lab, with room to write its value.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import groupby
from math import ceil

from msgspec import Struct

from graphkin.classroom.grading.answer_numbers import (
    BLANKS,
    LARGEST_ANSWER,
    LETTERS,
    LONGEST,
    MISTYPED,
    NUMBER,
    RAISED,
    RUSSIAN,
    UNITS,
)
from graphkin.classroom.lab.items import items as fields_of
from graphkin.classroom.lab.items import motion_of
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.personal import SIDE, square
from graphkin.construction.core.quantities import BY_TARGET, CLOCKWISE, FORCE, SHEETS, STROKE
from graphkin.drawing.field import A4_AREA, A4_PAGE, TextPage
from graphkin.drawing.frame import on_page, page_frame
from graphkin.drawing.marks import LineMark, Mark, Page, Text, box
from graphkin.drawing.richtext import extent, flowed, words_of
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.web.offline_page import FORM, bundled, part
from graphkin.web.step_page import Form
from graphkin.writers.templates import from_template

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
    return what, escape(item.field), hint, words.spelled(item.unit), written


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


class Identity(Struct, frozen=True):
    """The student a form belongs to: the id from the class list, and the name shown with the id.

    Without an id, the student types one in. ``stem`` begins the name of the saved file. ``memory``
    identifies this form among those that the same browser stores; their addresses distinguish
    copies of one form.
    """

    stem: str
    memory: str
    id: str = ""
    name: str = ""


KINDS = {"segment": "answers.measured", "value": "answers.computed", "place": "answers.placed"}
"""The key of the sentence next to the symbol, for each kind of field."""
TURNING, ALONG = ("ccw", "cw"), ("forward", "backward")
"""The senses of a turning link and of a block as the file writes them, the positive one first."""
SAID = (
    "answers.saved",
    "answers.saved_drawn",
    "answers.empty",
    "answers.unread",
    "answers.no_number",
    "answers.no_unit",
    "answers.too_large",
    "answers.no_sense",
    "answers.no_id",
    "answers.opened",
    "answers.other",
    "answers.no_file",
    "answers.strange",
    "answers.replace",
    "answers.sure",
    "answers.cleared",
    "answers.kept",
    "answers.lost",
)
"""The keys of the sentences that the script shows."""
LARGEST = 200
"""The number of characters a field accepts. A longer number gets a message and is not cut."""


def form_fragment(
    items: Sequence[Item],
    points: Mapping[str, Fraction],
    compute: Collection[str],
    words: Words,
    identity: Identity,
    pivot: str = "",
    *,
    says_right: bool = False,
) -> Form:
    """The form, its styles and its script: a labelled field for every item.

    Fields in ``compute`` are marked as computed. ``points`` are shown where the rubric gives any.
    ``pivot`` is the first fixed point, from which places are measured. With ``says_right`` the
    board of its page tells when a point is right.
    """
    sheets = []
    for sheet in (*SHEETS, FORCE, STROKE.kind):
        alike = groupby((item for item in items if motion_of(item).kind == sheet), kind_of)
        groups = [
            [field(item, points.get(item.field), item.field in compute, words) for item in own]
            for _, own in alike
        ]
        sheets += [(words(f"sheet.{sheet}"), groups)] if groups else []
    body = from_template(
        "classroom/templates/form.html",
        settings=json.dumps(settings(items, words, identity), ensure_ascii=False),
        advice=advice(items, words, pivot),
        identity=identity,
        largest=LARGEST,
        sheets=sheets,
        words=words,
    )
    return Form(body, part("form.css"), bundled(FORM), says_right)


def settings(items: Sequence[Item], words: Words, identity: Identity) -> dict[str, object]:
    """The settings of the script: the form's owner, how it reads numbers, and its sentences."""
    return {
        "id": identity.id,
        "stem": identity.stem,
        "memory": identity.memory,
        "separator": ";" if words("decimal_mark") == "," else ",",
        "number": in_javascript(NUMBER.pattern),
        "mistyped": MISTYPED.pattern,
        "raised": {chr(sign): chr(plain) for sign, plain in RAISED.items()},
        "russian": RUSSIAN,
        "letters": LETTERS,
        "blanks": BLANKS,
        "longest": LONGEST,
        "largest": LARGEST_ANSWER,
        "units": {unit: UNITS.get(unit, {unit: 1}) for unit in sorted({i.unit for i in items})},
        "sense": words("table.sense"),
        "words": {key.partition(".")[2]: words.sentences[key] for key in SAID},
    }


def kind_of(item: Item) -> tuple[str, str]:
    """The key by which fields are grouped on the form: the quantity, and its point or link."""
    return item.quantity, item.of


class FormField(Struct, frozen=True):
    """One field of the form: its item, label, hint, points, and the senses to choose from."""

    item: Item
    said: str
    hint: str
    worth: str
    senses: tuple[tuple[str, str], ...]


def field(item: Item, worth: Fraction | None, computed: bool, words: Words) -> FormField:
    """The field that asks for an item."""
    asks_sense, turning = item.what == "sense", item.quantity in CLOCKWISE
    keys = ("anticlockwise", "clockwise") if turning else ("forward", "backward")
    return FormField(
        item,
        words("table.sense") if asks_sense else words(KINDS[item.what]),
        why(item, words) if computed else "",
        f"{words('form.points')}{words('colon')}{words.decimal(f'{float(worth):.4g}')}"
        if worth
        else "",
        tuple(zip(TURNING if turning else ALONG, keys, strict=True)) if asks_sense else (),
    )


def lab_form(mechanism: Mechanism, lab: Lab, words: Words, identity: Identity) -> Form:
    """The form of a lab for its scene with the current data, not assigned to any student."""
    fields, points = fields_of(mechanism, lab), lab.rubric.points
    pivot, says_right = first_pivot(mechanism), lab.rubric.says_right
    return form_fragment(fields, points, (), words, identity, pivot, says_right=says_right)


def first_pivot(mechanism: Mechanism) -> str:
    """The fixed point from which places are measured; empty if the scene has none."""
    return next(iter(mechanism.scene.frame.points), "")


def in_javascript(pattern: str) -> str:
    """A regular expression with the named groups, and references to them, of JavaScript."""
    return re.sub(r"\(\?P=(\w+)\)", r"\\k<\1>", pattern.replace("(?P<", "(?<"))
