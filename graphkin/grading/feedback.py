"""A feedback page for each student, for the browser and on paper, in the language of the lab."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape as escaped

from graphkin.grading.html import feedback_table, marked_up, page
from graphkin.grading.model import Graded
from graphkin.grading.rows import COLUMNS, HEADS, Row, known_sign, points_words, rows, safe
from graphkin.lab.model import Rubric
from graphkin.paper.areas import A4_AREA, A4_SIZE
from graphkin.paper.frame import page_frame
from graphkin.paper.marks import Line, Mark, Page, Text
from graphkin.paper.richtext import escape, extent, flowed, plain, words_of
from graphkin.text import Words

LEFT, RIGHT = A4_AREA[0] + 4, A4_AREA[2] - 4
TOP, BOTTOM = A4_AREA[1] + 10, A4_AREA[3] - 5
WIDTHS = (32.0, 34.0, 30.0, 28.0, 24.0, 24.0)
"""Widths of the columns, in mm."""
LETTER, SMALL = 2.5, 1.8
LEADING, ROOM = 4.2, 2.6
"""Distance of lines, and the room below a field, in mm."""
INDENT = 4.0


def feedback_html(graded: Graded, title: str, rubric: Rubric, words: Words) -> str:
    """The page of one student for a browser."""
    student = graded.taker.student
    heads = {key: words(key) for key in HEADS.values()}
    body = [f"<h1>{escaped(words('feedback.title'))}</h1>", f"<p>{escaped(title)}<br>"]
    body.append(f"{escaped(' – '.join(filter(None, (student.name or student.id, student.group))))}")
    body.append(f"<br>{escaped(settings_words(graded, words))}</p>")
    body.append(f'<p class="total">{escaped(total(graded, words))}</p>')
    if not graded.present:
        body.append(f"<p>{escaped(words('feedback.absent'))}</p>")
    body += feedback_table(rows(graded, words), heads)
    body.append(f'<p class="small">{marked_up(how(rubric, words))}</p>')
    return page(f"{title} – {student.name or student.id}", words.language, body)


def total(graded: Graded, words: Words) -> str:
    """The sum of the points in words."""
    earned, points = (points_words(each, words) for each in (graded.earned, graded.points))
    return words("feedback.total", earned=earned, points=points)


def settings_words(graded: Graded, words: Words) -> str:
    """The data of a student's variant."""
    settings = graded.taker.settings.items()
    return "; ".join(f"{name} = {words.decimal(value)}" for name, value in settings)


def how(rubric: Rubric, words: Words) -> str:
    """What a tolerance is."""
    amounts = {"point": rubric.point, "line": rubric.line, "ruler": rubric.ruler}
    return words(
        "feedback.how", **{name: words.decimal(f"{value:g}") for name, value in amounts.items()}
    )


# --- on paper -----------------------------------------------------------------------------------


def feedback_pages(graded: Graded, title: str, rubric: Rubric, words: Words) -> tuple[Page, ...]:
    """The pages of one student on A4."""
    bodies = list(paged(blocks(graded, rubric, words)))
    name = name_of(graded)
    return tuple(
        Page(
            *A4_SIZE,
            (
                *page_frame(
                    (fitting(escape(safe(title))), words("feedback.title")),
                    (fitting(name), f"{number}/{len(bodies)}"),
                ),
                *marks,
            ),
            f"{title} – {graded.taker.student.name or graded.taker.student.id}",
            words.language,
        )
        for number, marks in enumerate(bodies, 1)
    )


def name_of(graded: Graded) -> str:
    """A student's name and group, or the id, as markup with only signs that the lettering has."""
    student = graded.taker.student
    text = ", ".join(filter(None, (student.name or student.id, student.group)))
    return escape("".join(sign if known_sign(sign) else "?" for sign in text))


def fitting(markup: str) -> str:
    """A markup of a head or foot, cut where it is too long."""
    return markup if extent(markup, LETTER)[0] <= 105 else markup[:60].rstrip("\\") + "…"


Block = tuple[float, list[Mark]]
"""The height of something that stays together, and its marks from a height of nought."""


def blocks(graded: Graded, rubric: Rubric, words: Words) -> Iterator[Block]:
    """What stands on the pages, from top to bottom."""
    yield text_block(name_of(graded), 3.5)
    settings = escape(settings_words(graded, words))
    if settings:
        yield text_block(settings, LETTER)
    yield text_block(words("feedback.total", **totals(graded, words)), 3.5)
    if not graded.present:
        yield text_block(words("feedback.absent"), LETTER)
    yield head_block(words)
    for row in rows(graded, words):
        yield row_block(row)
    yield text_block(how(rubric, words), SMALL)


def totals(graded: Graded, words: Words) -> dict[str, str]:
    """The fields of the sum of the points."""
    return {
        "earned": points_words(graded.earned, words),
        "points": points_words(graded.points, words),
    }


def text_block(markup: str, height: float) -> Block:
    """A paragraph."""
    lines = flowed(words_of(markup), " ", RIGHT - LEFT, height)
    leading = LEADING * max(height / LETTER, 0.85)
    marks: list[Mark] = [
        Text(LEFT, (i + 1) * leading, line, "caption", height) for i, line in enumerate(lines)
    ]
    return len(lines) * leading + ROOM, marks


def head_block(words: Words) -> Block:
    """The heads of the columns, over a line."""
    marks: list[Mark] = columns([words(HEADS[name]) for name in COLUMNS], LEADING)
    marks.append(Line(LEFT, LEADING + 1.6, RIGHT, LEADING + 1.6, "border"))
    return LEADING + ROOM + 0.8, marks


def row_block(row: Row) -> Block:
    """A field: its cells, and below them why."""
    marks: list[Mark] = columns(row.cells, LEADING)
    why = flowed(words_of(row.why), " ", RIGHT - LEFT - INDENT, SMALL)
    y = LEADING
    for line in why:
        y += 3.4
        marks.append(Text(LEFT + INDENT, y, line, "caption", SMALL))
    marks.append(Line(LEFT, y + 1.6, RIGHT, y + 1.6, "panel"))
    return y + ROOM, marks


def columns(texts: Sequence[str], y: float) -> list[Mark]:
    """Texts in their columns, the first from the left, the others to the right edge of theirs."""
    marks: list[Mark] = []
    x = LEFT
    for i, (text, width) in enumerate(zip(texts, WIDTHS, strict=True)):
        if text:
            height = LETTER if extent(text, LETTER)[0] <= width - 1 else SMALL
            shown = text if extent(text, height)[0] <= width - 1 else shortened(text, width - 1)
            anchor = ("start", x) if i == 0 else ("end", x + width - 1)
            marks.append(Text(anchor[1], y, shown, "table", height, anchor[0]))  # type: ignore[arg-type]
        x += width
    return marks


def shortened(markup: str, width: float) -> str:
    """A plain markup cut to a width in small lettering."""
    text = plain(markup)
    while text and extent(escape(text) + "…", SMALL)[0] > width:
        text = text[:-1]
    return escape(text) + "…"


def paged(blocks: Iterator[Block]) -> Iterator[list[Mark]]:
    """The marks of each page."""
    page: list[Mark] = []
    y = TOP
    for height, marks in blocks:
        if page and y + height > BOTTOM:
            yield page
            page, y = [], TOP
        page += [lowered(mark, y) for mark in marks]
        y += height
    yield page


def lowered(mark: Mark, by: float) -> Mark:
    """A mark moved down the page."""
    if isinstance(mark, Text):
        return replace(mark, y=mark.y + by)
    assert isinstance(mark, Line)
    return replace(mark, y1=mark.y1 + by, y2=mark.y2 + by)
