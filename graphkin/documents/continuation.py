"""The continuation sheets: data, sentences and tables that do not fit next to the drawings.

They also hold plans with the names of auxiliary points.
"""

from __future__ import annotations

from collections.abc import Iterator, Set

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.layout import Layout, centre, lay_out, spans
from graphkin.construction.result_tables import tables, tables_on_sheets
from graphkin.documents.listing import in_columns, on_sheets
from graphkin.documents.sheet import (
    HEADING,
    Moved,
    asked_words,
    construction_head,
    members,
    pages_of,
    plan_enlarged,
    right_board,
    title_block,
    title_line,
)
from graphkin.drawing.field import ABOVE, MARGIN, Field, Rect, SheetPaper
from graphkin.drawing.marks import Mark, Page, Text, reach
from graphkin.drawing.richtext import extent, flowed, narrow_words
from graphkin.text.errors import PageError, Problem, message

LEADING = 4.6
"""Distance of the lines of data in mm."""
GAP, HEAD = 8.0, 6.0
"""Room above and below the heading of a part, in mm."""
INSIDE = 3.0
"""Clearance of tables and sentence numbers from the centring mark at the left, in mm."""
TIMES = (2.0, 1.5, 1.25, 1.0)
"""Possible enlargements of a plan that is drawn again."""
LEAST = 60.0
"""Least room below the data in which tables that need more sheets begin, in mm."""


def rest(drawing: Drawing, view: str, moved: Set[Moved], said: int = 0) -> list[list[Mark]]:
    """The continuation sheets: one, or as many as the remaining parts need.

    The first ``said`` sentences are left out. Raises PageError where a sentence or a row of a table
    is longer than a sheet is wide.
    """
    if Moved.AUXILIARY in moved:
        return with_trials(drawing, rest(drawing, view, moved - {Moved.AUXILIARY}, said))
    if not moved:
        return []
    try:
        return [one_sheet(drawing, view, moved, said)]
    except PageError:
        others = moved - {Moved.CONSTRUCTION}
    try:
        sheets = [one_sheet(drawing, view, others, said)] if others else []
    except PageError:
        sheets = [*data_and_tables(drawing, view, others)]
    if Moved.CONSTRUCTION not in moved:
        return sheets
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    top, paper = y + GAP, drawing.paper
    left: Rect = (x + INSIDE, top + HEAD, paper.marked[0], paper.below[3] - 3.5)
    right: Rect = (paper.second, top + HEAD, paper.fields[2], low_of(paper))
    head = [*head, construction_head(drawing, x, top)]
    return [*sheets, *([*head, *marks] for marks in on_sheets(drawing, [left, right], said))]


def with_trials(drawing: Drawing, sheets: list[list[Mark]]) -> list[list[Mark]]:
    """The sheets with the plan next to the words of the last sheet, or on a sheet of its own.

    The plan is drawn as large as possible, with the names of its auxiliary points.
    """
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    top, paper = y + GAP, drawing.paper
    beside: Rect = (paper.second, top + HEAD, paper.fields[2], low_of(paper))
    last = sheets[-1] if sheets else head
    is_free = all(reach(mark)[2] < beside[0] or reach(mark)[3] < top for mark in last)
    marks = plan_with_trials(drawing, beside) if sheets and is_free else []
    if marks:
        return [*sheets[:-1], [*last, *marks]]
    left = beside[0] if paper.is_parted else x
    return [*sheets, [*head, *plan_with_trials(drawing, (left, *beside[1:]))]]


def plan_with_trials(drawing: Drawing, rect: Rect) -> list[Mark]:
    """The plan in a field, with the letters of its points; empty where it has no room."""
    layout, box, mm = lay_out(drawing), drawing.plan_extent(), 1000 / drawing.scales.kL
    room = rect[2] - rect[0] - 2 * MARGIN, rect[3] - rect[1] - 2 * ABOVE
    times = min(
        side / size for side, size in zip(room, (box.width * mm, box.height * mm), strict=True)
    )
    fits = next((each for each in TIMES if each <= times), None)
    if fits is None:
        return []
    plan = Field(rect, layout.plan.mm * fits, layout.plan.middle, centre(rect))
    large = Layout(layout.mechanism, plan, {})
    board = right_board(drawing, replace(large, spans=spans(drawing, large)), "key")
    board.marks = [mark for mark in board.marks if mark.name != HEADING]
    board.labels = [label for label in board.labels if not label.spare]
    return [*plan_enlarged(drawing, rect, fits), *board.finish()]


def data_and_tables(drawing: Drawing, view: str, moved: Set[Moved]) -> Iterator[list[Mark]]:
    """The sheets of data too long for one sheet, and of tables, which begin below the data."""
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    paper, low = drawing.paper, low_of(drawing.paper)
    room = int((low - y) / LEADING) + 1
    lines = continued_lines(drawing, view, moved, x)
    pages = [
        [Text(x, y + i * LEADING, line, "caption", 2.5, name="data") for i, line in enumerate(part)]
        for part in (lines[i : i + room] for i in range(0, len(lines), room))
    ]
    if Moved.TABLES not in moved:
        yield from ([*head, *part] for part in pages)
        return
    yield from ([*head, *part] for part in pages[:-1])
    last = pages[-1] if pages else []
    top = y + len(last) * LEADING + GAP
    if top > low - LEAST:
        yield [*head, *last]
        last, top = [], y + GAP
    left = x + INSIDE
    right = paper.left[2]
    rects: tuple[Rect, Rect] = (left, top, right, low), (left, y + GAP, right, low)
    for marks in tables_on_sheets(drawing, *rects, empty=view == "task"):
        yield [*head, *last, *marks]
        last = []


def continued_lines(drawing: Drawing, view: str, moved: Set[Moved], x: float) -> list[str]:
    """The moved data, requests and links, in lines across a sheet from a place on."""
    words, width, lines = drawing.words, drawing.paper.left[2] - x - 3, list[str]()
    if Moved.DATA in moved:
        first, *others = given(drawing, solved=view != "task", laws=True)
        lines += flowed([f"{words('page.data')}: {first}", *others], "; ", width, 2.5)
    if Moved.ASKED in moved:
        first, *others = asked_words(drawing)
        lines += flowed([f"{words('page.asked')}: {first}", *others], "; ", width, 2.5)
    if Moved.MEMBERS in moved:
        lines.append(members(drawing))
    return [
        part
        for line in lines
        for part in ([line] if extent(line, 2.5)[0] <= width else cut(line, width))
    ]


def cut(line: str, width: float) -> list[str]:
    """A line divided between words into lines of a width in mm."""
    return flowed(narrow_words(line, width, 2.5), " ", width, 2.5)


def one_sheet(drawing: Drawing, view: str, moved: Set[Moved], said: int) -> list[Mark]:
    """The content of a single continuation sheet. Raises PageError where it does not fit."""
    marks, x, y = title_line(drawing, drawing.words("page.continued"))
    paper, low = drawing.paper, low_of(drawing.paper)
    if lines := continued_lines(drawing, view, moved, x):
        for line in lines:
            marks.append(Text(x, y, line, "caption", 2.5, name="data"))
            y += LEADING
        if y > low + LEADING:
            found = message("does not fit: {count} lines of data", count=len(lines))
            raise PageError(Problem("data", found, message("data for one sheet")))
    top = y + GAP
    right: Rect = (paper.second, top, paper.fields[2], low)
    if Moved.CONSTRUCTION in moved:
        left: Rect = (x + INSIDE, top + HEAD, paper.marked[0], paper.below[3] - 3.5)
        beside = [] if Moved.TABLES in moved else [(right[0], left[1], *right[2:])]
        marks.append(construction_head(drawing, x, top))
        marks += in_columns(drawing, [left, *beside], said)
    if Moved.TABLES in moved:
        alone = Moved.CONSTRUCTION not in moved
        own: Rect = (x + INSIDE, top, paper.left[2], low) if alone else right
        marks += tables(drawing, own, empty=view == "task")
    return marks


def low_of(paper: SheetPaper) -> float:
    """The lower end of the right column, above the title block, in mm."""
    return paper.title_block[1] - 4


def as_pages(drawing: Drawing, view: str, number: str, marks: list[Mark]) -> tuple[Page, ...]:
    """The marks in the frame of a sheet."""
    return pages_of(drawing, title_block(drawing, view, number), marks)
