"""A feedback page for each student, for the browser and on paper, in the language of the lab."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.feedback_rows import (
    COLUMNS,
    HEADS,
    FeedbackRow,
    decision_words,
    points_words,
    rows,
    safe,
)
from graphkin.classroom.grading.graded import Graded
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.classroom.printing.personal import printable_name
from graphkin.construction.core.given_data import set_parameters
from graphkin.drawing.areas import A4_AREA, A4_SIZE
from graphkin.drawing.frame import page_frame
from graphkin.drawing.marks import LineMark, Mark, Page, Text
from graphkin.drawing.richtext import extent, flowed, plain, words_of
from graphkin.drawing.symbol_markup import escape
from graphkin.scene.model import Scene
from graphkin.text import Words
from graphkin.writers.templates import from_template

LEFT, RIGHT = A4_AREA[0] + 4, A4_AREA[2] - 4
TOP, BOTTOM = A4_AREA[1] + 10, A4_AREA[3] - 5
WIDTHS = (26.0, 34.5, 34.5, 28.2, 19.0, 29.8)
"""Widths of the columns, in mm; a sense in words has room in the second and the third alike."""
LETTER, SMALL = 2.5, 1.8
LEADING, ROOM = 4.2, 2.6
"""Distance of lines, and the room below a field, in mm."""
INDENT = 4.0


def feedback_html(
    graded: Graded, title: str, rubric: Rubric, words: Words, scene: Scene | None = None
) -> str:
    """The page of one student for a browser; who handed in nothing is not told what was right.

    ``scene`` tells what the parameters are of; without it they stand by their names.
    """
    page = from_template(
        "classroom/templates/feedback.html",
        words=words,
        title=title,
        student=graded.taker.student,
        settings=settings_words(graded, words, scene),
        total=total(graded, words) if is_shown(graded) else "",
        notes=notes(graded, words),
        names=[words(HEADS[name]) for name in COLUMNS],
        rows=rows(graded, words),
        right=words("feedback.right"),
        how=how(rubric, words),
    )
    return f"{page}\n"


def is_shown(graded: Graded) -> bool:
    """Whether a student sees marks: there are some, and they are not held."""
    return graded.is_marked and not graded.held


def total(graded: Graded, words: Words) -> str:
    """The sum of the points in words; what still waits is left out of both."""
    earned, points = (points_words(each, words) for each in (graded.earned, graded.decided))
    text = words("feedback.total", earned=earned, points=points)
    if not graded.pending:
        return text
    waiting, every = (points_words(each, words) for each in (graded.pending, graded.points))
    return f"{text}, {words('feedback.waiting', pending=waiting, all=every)}"


def notes(graded: Graded, words: Words) -> list[str]:
    """What is said of the whole form: that there is none, what was decided, what waits."""
    told = [decision_words(graded.decision, words)] if graded.decision is not None else []
    if not graded.is_marked:
        return [words("feedback.absent"), *told]
    if graded.held:
        return [words("feedback.held"), *told]
    waiting = [mark.item for mark in graded.marks if mark.points and mark.waits]
    if not waiting or not graded.pending:
        return told
    fields = ", ".join(
        f"{item.symbol} ({words('table.sense')})" if item.what == "sense" else item.symbol
        for item in waiting
    )
    pending = points_words(graded.pending, words)
    return [*told, words("feedback.pending", pending=pending, fields=fields)]


def settings_words(graded: Graded, words: Words, scene: Scene | None) -> str:
    """The data of a student's variant as markup, as the sheets tell them."""
    settings = graded.taker.settings
    if scene is None:
        told = [f"{escape(name)} = {words.decimal(value)}" for name, value in settings.items()]
        return "; ".join(told)
    exact = {name: Fraction(value) for name, value in settings.items()}
    own = replace(scene, values={**scene.values, **exact})
    return "; ".join(set_parameters(own, words, settings))


def how(rubric: Rubric, words: Words) -> str:
    """What a tolerance is."""
    amounts = {"point": rubric.point, "line": rubric.line, "ruler": rubric.ruler}
    return words(
        "feedback.how", **{name: words.decimal(f"{value:g}") for name, value in amounts.items()}
    )


# --- on paper -----------------------------------------------------------------------------------


class Spacing(Struct, frozen=True):
    """Distances of a page, in mm: from a field's cells to its reason, and the room below it."""

    line: float
    room: float


SPACINGS = (Spacing(3.4, 2.6), Spacing(3.3, 1.9), Spacing(3.1, 1.7))
"""From wide to narrow: the first that fits one page is taken, else the first."""


def feedback_pages(
    graded: Graded, title: str, rubric: Rubric, words: Words, scene: Scene | None = None
) -> tuple[Page, ...]:
    """The pages of one student on A4, one wherever that can be."""
    settings = settings_words(graded, words, scene)
    tried = (list(paged(blocks(graded, rubric, words, settings, by))) for by in SPACINGS)
    bodies = next((found for found in tried if len(found) == 1), None)
    bodies = bodies or list(paged(blocks(graded, rubric, words, settings, SPACINGS[0])))
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
    """A student's name and group, or the id, as on the sheets, as markup."""
    return escape(printable_name(graded.taker.student))


def fitting(markup: str) -> str:
    """A markup of a head or foot, cut where it is too long."""
    return markup if extent(markup, LETTER)[0] <= 105 else shortened(markup, 105, LETTER)


Block = tuple[float, list[Mark]]
"""The height of something that stays together, and its marks from a height of nought."""


def blocks(
    graded: Graded, rubric: Rubric, words: Words, settings: str, spacing: Spacing
) -> Iterator[Block]:
    """What stands on the pages, from top to bottom."""
    yield text_block(name_of(graded), 3.5)
    if settings:
        yield text_block(settings, LETTER)
    if is_shown(graded):
        yield text_block(total(graded, words), 3.5)
    for note in notes(graded, words):
        yield text_block(note, LETTER)
    if not is_shown(graded):
        return
    told = rows(graded, words)
    if told:
        yield head_block(words)
    for row in told:
        yield row_block(row, spacing, words("feedback.right"))
    yield text_block(how(rubric, words), SMALL)


def text_block(markup: str, height: float) -> Block:
    """A paragraph."""
    lines = flowed(list(pieces(markup, RIGHT - LEFT, height)), " ", RIGHT - LEFT, height)
    leading = LEADING * max(height / LETTER, 0.85)
    marks: list[Mark] = [
        Text(LEFT, (i + 1) * leading, line, "caption", height) for i, line in enumerate(lines)
    ]
    return len(lines) * leading + ROOM, marks


def pieces(markup: str, width: float, height: float) -> Iterator[str]:
    """The words of a markup; one that is wider than a line in pieces that are not."""
    for word in words_of(markup):
        if extent(word, height)[0] <= width:
            yield word
            continue
        piece = ""
        for sign in map(escape, plain(word)):
            if piece and extent(piece + sign, height)[0] > width:
                yield piece
                piece = ""
            piece += sign
        yield piece


def head_block(words: Words) -> Block:
    """The heads of the columns, over a line."""
    marks: list[Mark] = columns([words(HEADS[name]) for name in COLUMNS], LEADING)
    marks.append(LineMark(LEFT, LEADING + 1.6, RIGHT, LEADING + 1.6, "border"))
    return LEADING + ROOM + 0.8, marks


def row_block(row: FeedbackRow, spacing: Spacing, right: str) -> Block:
    """A field: its cells, and below them why; that it is right and no more beside its points."""
    marks: list[Mark] = columns(row.cells, LEADING)
    room = RIGHT - LEFT - INDENT
    why: Sequence[str] = ()
    if row.why == right:
        before = RIGHT - 2.5 - extent(row.cells[-1], LETTER)[0]
        marks.append(Text(before, LEADING, right, "caption", SMALL, "end"))
    else:
        why = flowed(list(pieces(row.why, room, SMALL)), " ", room, SMALL)
    y = LEADING
    for line in why:
        y += spacing.line
        marks.append(Text(LEFT + INDENT, y, line, "caption", SMALL))
    below = min(1.6, spacing.room - 0.6)
    marks.append(LineMark(LEFT, y + below, RIGHT, y + below, "panel"))
    return y + spacing.room, marks


def columns(texts: Sequence[str], y: float) -> list[Mark]:
    """Texts in their columns, the first from the left, the others to the right edge of theirs."""
    marks: list[Mark] = []
    x = LEFT
    for i, (text, width) in enumerate(zip(texts, WIDTHS, strict=True)):
        if text:
            height = LETTER if extent(text, LETTER)[0] <= width - 1 else SMALL
            fits = extent(text, height)[0] <= width - 1
            shown = text if fits else shortened(text, width - 1, SMALL)
            if i == 0:
                marks.append(Text(x, y, shown, "table", height))
            else:
                marks.append(Text(x + width - 1, y, shown, "table", height, "end"))
        x += width
    return marks


def shortened(markup: str, width: float, height: float) -> str:
    """A plain markup cut to a width in a lettering."""
    text = plain(markup)
    while text and extent(escape(text) + "…", height)[0] > width:
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
    assert isinstance(mark, LineMark)
    return replace(mark, y1=mark.y1 + by, y2=mark.y2 + by)
