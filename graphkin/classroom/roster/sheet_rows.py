"""A row of a table, from whatever file it comes, and how large a table may be."""

from __future__ import annotations

from msgspec import Struct

from graphkin.text.errors import Problem, RosterError

MOST_ROWS, MOST_COLUMNS, LONGEST = 200_000, 1000, 4000
"""Rows that are not empty, columns, and characters of one cell."""
MOST_CELLS, LAST_ROW = 2_000_000, 1 << 20
"""Cells of a table, rows times columns; the last row that a spreadsheet has."""


class SheetRow(Struct, frozen=True):
    """One row: its line in the file, or its row in the sheet, and its cells by column.

    ``numbers`` are the columns of cells that are numbers in the file, without zeros before them;
    ``broken`` is the line at which the fault begins where the cells may be in wrong columns, or 0.
    """

    line: int
    cells: tuple[str, ...]
    numbers: frozenset[int] = frozenset()
    broken: int = 0


def too_large(name: str, found: str) -> RosterError:
    """The error for a table beyond the limits, told as soon as it is found to be."""
    expected = f"at most {MOST_ROWS} rows, {MOST_COLUMNS} columns, {MOST_CELLS} cells in all"
    return RosterError(Problem(name, found, expected))
