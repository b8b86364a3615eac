"""The lecturer's own gradebook as XLSX, filled in: only the cells of the marks change.

Formats, formulas and other sheets stay; marks are written as numbers. The same marks give the same
bytes: the times in the file stay those of the export.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from graphkin.errors import Problem
from graphkin.grading.gradebook import Cell, Filled, GradebookError, filled, places
from graphkin.grading.gradebook_csv import read_gradebook
from graphkin.roster.errors import RosterError
from graphkin.roster.tables import MOST_COLUMNS, MOST_ROWS, bytes_of
from graphkin.roster.xlsx import cell_text, open_sheet, opened

START = b"PK\x03\x04"
"""The first bytes of an XLSX, which is a ZIP file."""
CORE, MODIFIED = "docProps/core.xml", re.compile(rb"(<dcterms:modified[^>]*>)[^<]*")
DATE = (1980, 1, 1, 0, 0, 0)
"""The time of every file within, the earliest that a ZIP can tell."""


def filled_gradebook(
    path: Path,
    marks: Mapping[str, Fraction],
    column: str | None = None,
    ids: Collection[str] = (),
) -> Filled:
    """An export, CSV or XLSX, with the marks in a column. Raises GradebookError."""
    data = bytes_of(path)
    if data.startswith(START):
        return filled_workbook(read_workbook(data, path.name), marks, column, ids)
    return filled(read_gradebook(path), marks, column, ids)


@dataclass(frozen=True)
class Workbook:
    """An export as XLSX: its file, and the cells of the sheet that was open last."""

    name: str
    data: bytes
    rows: tuple[tuple[Cell, ...], ...]


def read_workbook(data: bytes, name: str) -> Workbook:
    """An export as it stands. Raises GradebookError where it is no table."""
    sheet = open_sheet(to_change(data, name))
    if sheet.max_row > MOST_ROWS or sheet.max_column > MOST_COLUMNS:
        found = f"{sheet.max_row} rows, {sheet.max_column} columns"
        expected = f"at most {MOST_ROWS} rows, {MOST_COLUMNS} columns"
        raise GradebookError(Problem(name, found, expected))
    rows = tuple(
        tuple(Cell(text, text.strip()) for text in map(cell_text, cells))
        for cells in sheet.iter_rows()
    )
    if len(rows) < 2:
        raise GradebookError(Problem(name, "has no row below its head", "a gradebook"))
    return Workbook(name, data, rows)


def to_change(data: bytes, name: str) -> Any:
    """The workbook, to be changed. Raises GradebookError where it cannot be read."""
    try:
        return opened(data, name)
    except RosterError as error:
        raise GradebookError(error.problems) from error


def filled_workbook(
    book: Workbook,
    marks: Mapping[str, Fraction],
    column: str | None = None,
    ids: Collection[str] = (),
) -> Filled:
    """The workbook with the marks in a column. Raises GradebookError where that cannot be told."""
    found = places(book, marks, column, ids)
    workbook = to_change(book.data, book.name)
    sheet = open_sheet(workbook)
    for line, who in found.lines.items():
        mark = round(marks[who], 2)
        whole = mark.denominator == 1
        sheet.cell(line + 1, found.column + 1).value = int(mark) if whole else float(mark)
    written = io.BytesIO()
    workbook.save(written)
    data = with_times_of(book.data, written.getvalue())
    return Filled(data, found.head, len(found.lines), found.absent, found.worth, found.replaced)


def with_times_of(before: bytes, after: bytes) -> bytes:
    """A workbook with the time of its last change as in another, and no times of files."""
    with zipfile.ZipFile(io.BytesIO(before)) as packed:
        core = packed.read(CORE) if CORE in packed.namelist() else b""
    was = MODIFIED.search(core)
    time = was[0].rpartition(b">")[2] if was else b"1980-01-01T00:00:00Z"
    found = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(after)) as packed,
        zipfile.ZipFile(found, "w", zipfile.ZIP_DEFLATED) as again,
    ):
        for name in packed.namelist():
            content = packed.read(name)
            if name == CORE:
                content = MODIFIED.sub(rb"\g<1>" + time, content)
            again.writestr(zipfile.ZipInfo(name, DATE), content, zipfile.ZIP_DEFLATED)
    return found.getvalue()
