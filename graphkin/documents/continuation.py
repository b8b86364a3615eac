"""The sheets on which goes on what has no room beside the drawings: data, sentences, tables, and
auxiliary points with their names."""

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
    page_title,
    plan_enlarged,
    right_board,
    title_block,
    title_line,
)
from graphkin.drawing.field import A3_TITLE_BLOCK, ABOVE, AREA, BELOW, MARGIN, MARKED, Field, Rect
from graphkin.drawing.frame import sheet_frame
from graphkin.drawing.marks import Mark, Page, Text, reach
from graphkin.drawing.richtext import extent, flowed, narrow_words
from graphkin.text.errors import PageError, Problem

LEADING = 4.6
"""Distance of the lines of data in mm."""
GAP, HEAD = 8.0, 6.0
"""Room above the heading of a part, and below it, in mm."""
INSIDE = 3.0
"""How far tables and numbers of sentences stay clear of the centring mark at the left, in mm."""
MIDDLE = MARKED[0]
"""Where the left column ends, clear of the centring mark, in mm."""
LOW = A3_TITLE_BLOCK[1] - 4
"""Where the right column ends, above the title block, in mm."""
TIMES = (2.0, 1.5, 1.25, 1.0)
"""How many times as large as on its sheet a plan may be that is drawn again."""
LEAST = 60.0
"""Room below the data in which tables begin that go on to more sheets, in mm."""


def rest(drawing: Drawing, view: str, moved: Set[Moved], said: int = 0) -> list[list[Mark]]:
    """What is on the sheets that go on: one, or where it has no room there as many as it takes.

    So many sentences as are said before are left out there.
    Raises PageError where a sentence or a row of a table is longer than a sheet is wide.
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
    top, low = y + GAP, BELOW[3] - 3.5
    left: Rect = (x + INSIDE, top + HEAD, MIDDLE, low)
    right: Rect = (MIDDLE + 6, top + HEAD, AREA[2], LOW)
    head = [*head, construction_head(drawing, x, top)]
    return [*sheets, *([*head, *marks] for marks in on_sheets(drawing, [left, right], said))]


def with_trials(drawing: Drawing, sheets: list[list[Mark]]) -> list[list[Mark]]:
    """The sheets with the plan beside the words of the last, or on a sheet of its own.

    It is drawn again as large as there is room for, and its auxiliary points have names.
    """
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    top = y + GAP
    beside: Rect = (MIDDLE + 6, top + HEAD, AREA[2], LOW)
    last = sheets[-1] if sheets else head
    is_free = all(reach(mark)[2] < beside[0] or reach(mark)[3] < top for mark in last)
    marks = plan_with_trials(drawing, beside) if sheets and is_free else []
    if marks:
        return [*sheets[:-1], [*last, *marks]]
    return [*sheets, [*head, *plan_with_trials(drawing, (x, *beside[1:]))]]


def plan_with_trials(drawing: Drawing, rect: Rect) -> list[Mark]:
    """The plan in a field, with the letters of its points; nothing where it has no room."""
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
    """The sheets of data that have no room on one, and of tables, which begin below the data."""
    head, x, y = title_line(drawing, drawing.words("page.continued"))
    room = int((LOW - y) / LEADING) + 1
    lines = told_lines(drawing, view, moved, x)
    parts = [lines[i : i + room] for i in range(0, len(lines), room)]
    told = [
        [Text(x, y + i * LEADING, line, "caption", 2.5, name="data") for i, line in enumerate(part)]
        for part in parts
    ]
    if Moved.TABLES not in moved:
        yield from ([*head, *part] for part in told)
        return
    yield from ([*head, *part] for part in told[:-1])
    last = told[-1] if told else []
    top = y + len(last) * LEADING + GAP
    if top > LOW - LEAST:
        yield [*head, *last]
        last, top = [], y + GAP
    left = x + INSIDE
    rects: tuple[Rect, Rect] = (left, top, AREA[2], LOW), (left, y + GAP, AREA[2], LOW)
    for marks in tables_on_sheets(drawing, *rects, empty=view == "task"):
        yield [*head, *last, *marks]
        last = []


def told_lines(drawing: Drawing, view: str, moved: Set[Moved], x: float) -> list[str]:
    """The data, what is asked and what the links are, so far as they are moved, in lines across a
    sheet from a place on."""
    words, width, lines = drawing.words, AREA[2] - x - 3, list[str]()
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
    """A line that is too long in lines of a width in mm, between words."""
    return flowed(narrow_words(line, width, 2.5), " ", width, 2.5)


def one_sheet(drawing: Drawing, view: str, moved: Set[Moved], said: int) -> list[Mark]:
    """What is on a sheet that goes on alone. Raises PageError where not even it holds the rest."""
    marks, x, y = title_line(drawing, drawing.words("page.continued"))
    if lines := told_lines(drawing, view, moved, x):
        for line in lines:
            marks.append(Text(x, y, line, "caption", 2.5, name="data"))
            y += LEADING
        if y > LOW + LEADING:
            found = f"does not fit: {len(lines)} lines of data"
            raise PageError(Problem("data", found, "data for one sheet"))
    top = y + GAP
    right: Rect = (MIDDLE + 6, top, AREA[2], LOW)
    if Moved.CONSTRUCTION in moved:
        left: Rect = (x + INSIDE, top + HEAD, MIDDLE, BELOW[3] - 3.5)
        beside = [] if Moved.TABLES in moved else [(right[0], left[1], *right[2:])]
        marks.append(construction_head(drawing, x, top))
        marks += in_columns(drawing, [left, *beside], said)
    if Moved.TABLES in moved:
        alone = Moved.CONSTRUCTION not in moved
        own = (x + INSIDE, *right[1:]) if alone else right
        marks += tables(drawing, own, empty=view == "task")
    return marks


def as_page(drawing: Drawing, view: str, number: str, marks: list[Mark]) -> Page:
    """The marks in the frame of a sheet."""
    frame = sheet_frame(title_block(drawing, view, number))
    return Page(420, 297, (*frame, *marks), page_title(drawing), drawing.words.language)
