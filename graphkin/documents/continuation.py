"""The sheet on which goes on what has no room beside the drawings: data, sentences, tables."""

from __future__ import annotations

from collections.abc import Set

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.result_tables import tables
from graphkin.documents.listing import in_columns
from graphkin.documents.sheet import (
    Moved,
    construction_head,
    page_title,
    title_block,
    title_line,
)
from graphkin.drawing.areas import A3_TITLE_BLOCK, AREA, BELOW, MARKED, Rect
from graphkin.drawing.frame import sheet_frame
from graphkin.drawing.marks import Mark, Page, Text
from graphkin.drawing.richtext import flowed

LEADING = 4.6
"""Distance of the lines of data in mm."""
GAP, HEAD = 8.0, 6.0
"""Room above the heading of a part, and below it, in mm."""
INSIDE = 3.0
"""How far the numbers of sentences stay clear of the centring mark at the left, in mm."""
MIDDLE = MARKED[0]
"""Where the left column ends, clear of the centring mark, in mm."""


def continuation(drawing: Drawing, view: str, number: str, moved: Set[Moved], said: int = 0) -> Page:
    """The sheet that goes on, behind so many sentences. Raises PageError where it is full."""
    marks, x, y = title_line(drawing, drawing.words("page.continued"))
    if Moved.DATA in moved:
        pieces = given(drawing, solved=view != "task")
        pieces[0] = f"{drawing.words('page.data')}: {pieces[0]}"
        for line in flowed(pieces, "; ", AREA[2] - x - 3, 2.5):
            marks.append(Text(x, y, line, "caption", 2.5, name="data"))
            y += LEADING
    top = y + GAP
    right: Rect = (MIDDLE + 6, top, AREA[2], A3_TITLE_BLOCK[1] - 4)
    if Moved.CONSTRUCTION in moved:
        left: Rect = (x + INSIDE, top + HEAD, MIDDLE, BELOW[3] - 3.5)
        beside = [] if Moved.TABLES in moved else [(right[0], left[1], *right[2:])]
        marks.append(construction_head(drawing, x, top))
        marks += in_columns(drawing, [left, *beside], said)
    if Moved.TABLES in moved:
        alone = Moved.CONSTRUCTION not in moved
        marks += tables(drawing, (x, *right[1:]) if alone else right, empty=view == "task")
    return as_page(drawing, view, number, marks)


def as_page(drawing: Drawing, view: str, number: str, marks: list[Mark]) -> Page:
    """The marks in the frame of a sheet."""
    frame = sheet_frame(title_block(drawing, view, number))
    return Page(420, 297, (*frame, *marks), page_title(drawing), drawing.words.language)
