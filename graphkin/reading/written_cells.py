"""The cells of a sheet's own tables: where they are on the page, and which were written into."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from msgspec import Struct

from graphkin.construction.result_tables import WRITTEN
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import LineMark, Page


class WrittenCell(Struct, frozen=True):
    """A cell with handwriting: its table, what its row is about, the row's number, and what it is.

    Its place in the record of a photograph is the number of its cut-out.
    """

    table: str
    name: str
    row: int
    what: Literal["segment", "value", "sense"]


def blank_cells(page: Page) -> Iterator[tuple[WrittenCell, Rect]]:
    """The cells of a task page that a hand fills in, with their places in mm."""
    for mark in page.marks:
        if isinstance(mark, LineMark) and mark.row is not None:
            row, top = mark.row, mark.y1 - mark.row.height
            for column, what in WRITTEN.get(row.table, {}).items():
                if column + 1 < len(row.edges):
                    left, right = (mark.x1 + row.edges[i] for i in (column, column + 1))
                    cell = WrittenCell(row.table, row.name, row.number, what)
                    yield cell, (left, top, right, mark.y1)


def cut_out_name(name: str, number: int) -> str:
    """The file name of a cut-out in the folder of readings."""
    return f"{name}.cell-{number}.jpg"
