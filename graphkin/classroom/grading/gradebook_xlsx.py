"""A gradebook export as CSV, and the lecturer's own as XLSX: only the cells of the marks change.

They are written as numbers into the XML of their sheet. All else stays as it is, macros too; only
the results that the file kept of formulas are left out, to be computed anew. The same marks give
the same bytes: the times in the file stay those of the export.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Mapping
from copy import copy
from fractions import Fraction
from pathlib import Path
from xml.parsers.expat import ExpatError

from graphkin.classroom.grading.gradebook import (
    Cell,
    CsvGradebook,
    Gradebook,
    GradebookError,
    mark_text,
)
from graphkin.classroom.roster.sheet_rows import MOST_CELLS, too_large
from graphkin.classroom.roster.spreadsheets import bytes_of, separator_of
from graphkin.classroom.roster.xlsx import cell_text, full_rows, open_sheet, opened, unreadable
from graphkin.text.errors import Problem, RosterError

BOMS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be"}


def read_gradebook(path: Path) -> Gradebook:
    """An export as it stands, CSV or XLSX. Raises GradebookError where it is no table."""
    data = bytes_of(path)
    if data.startswith(START):
        return read_workbook(data, path.name)
    bom = next((mark for mark in BOMS if data.startswith(mark)), b"")
    coding = BOMS.get(bom, "utf-8").removesuffix("-sig")
    try:
        text = data[len(bom) :].decode(coding)
    except UnicodeDecodeError:
        text, coding = data.decode("cp1250", "surrogateescape"), "cp1250"
    separator = separator_of(text)
    rows, ends = split(text, separator, path.name)
    if len(rows) < 2:
        raise GradebookError(Problem(path.name, "has no row below its head", "a gradebook"))
    return CsvGradebook(path.name, rows, ends, separator, coding, bom)


def split(
    text: str, separator: str, name: str
) -> tuple[tuple[tuple[Cell, ...], ...], tuple[str, ...]]:
    """The rows of cells of a text with their line ends; quotes and blanks stay as they are.

    Raises GradebookError for a quote that is never closed, or as soon as there are too many cells.
    """
    piece = re.compile(
        rf'([^\S\r\n{separator}]*+"[^"]*+(?:""[^"]*+)*+"|)([^\r\n{separator}]*+)'
        rf"({separator}|\r\n|\r|\n|\Z)"
    )
    rows: list[tuple[Cell, ...]] = []
    ends: list[str] = []
    row: list[Cell] = []
    for count, found in enumerate(piece.finditer(text), 1):
        quoted, rest, end = found.groups("")
        if count > MOST_CELLS:
            raise GradebookError(too_large(name, f"more than {MOST_CELLS} cells").problems)
        if not quoted and rest.lstrip().startswith('"'):
            place = f"{name}, row {len(rows) + 1}"
            raise GradebookError(
                Problem(place, "a quote that is opened and never closed", 'a closing "')
            )
        if end or row or quoted or rest:
            row.append(cell(quoted + rest))
        if end != separator and row:
            rows.append(tuple(row))
            ends.append(end)
            row = []
        if not end:
            break
    return tuple(rows), tuple(ends)


def cell(raw: str) -> Cell:
    """A cell from its characters."""
    bare = raw.strip()
    if len(bare) >= 2 and bare[0] == bare[-1] == '"':
        return Cell(raw, bare[1:-1].replace('""', '"').strip())
    return Cell(raw, bare)


START = b"PK\x03\x04"
"""The first bytes of an XLSX, which is a ZIP file."""
WORKBOOK = re.compile(r"xl/workbook[0-9]*\.xml")
"""The part of the file that says how formulas are computed."""


class Workbook(Gradebook, frozen=True):
    """An export as XLSX: its file, and the cells of the sheet that was open last.

    A row that holds nothing has no cells. ``formulas`` are the places of formulas, by line and
    column from 0; ``sheet`` and ``sheets`` the parts of the file that hold this and all sheets.
    """

    data: bytes
    formulas: frozenset[tuple[int, int]]
    sheet: str
    sheets: tuple[str, ...]

    def filled(self, column: int, marks: Mapping[int, Fraction]) -> bytes:
        """Its bytes with the marks. Raises GradebookError where they would replace formulas."""
        wrong = [line for line in marks if (line, column) in self.formulas]
        if wrong:
            where = f"{self.name}, row {wrong[0] + 1}"
            text = f'"{self.rows[0][column].text}" holds a formula'
            hint = "name another one with --column"
            raise GradebookError(Problem(where, text, "a column for points", hint))
        numbers = {
            (line + 1, column + 1): mark_text(mark, comma=False) for line, mark in marks.items()
        }
        try:
            return with_cells(self, numbers)
        except (ExpatError, ValueError) as error:
            raise GradebookError(unreadable(self.name).problems) from error


def read_workbook(data: bytes, name: str) -> Workbook:
    """An export as it stands. Raises GradebookError where it is no table."""
    rows: list[tuple[Cell, ...]] = []
    formulas: set[tuple[int, int]] = set()
    try:
        with opened(data, name, data_only=False) as book:
            sheet = open_sheet(book)
            for number, cells in full_rows(sheet, name):
                rows += [()] * (number - 1 - len(rows))
                formulas |= {(len(rows), i) for i, c in enumerate(cells) if c.data_type == "f"}
                rows.append(tuple(Cell(text, text.strip()) for text in map(cell_text, cells)))
            parts = tuple(each._worksheet_path for each in book.worksheets)
            part = sheet._worksheet_path
    except RosterError as error:
        raise GradebookError(error.problems) from error
    if not rows or not rows[0]:
        raise GradebookError(Problem(name, "has nothing in its first row", "the names of columns"))
    if len(rows) < 2:
        raise GradebookError(Problem(name, "has no row below its head", "a gradebook"))
    return Workbook(name, tuple(rows), data, frozenset(formulas), part, parts)


def with_cells(book: Workbook, numbers: Mapping[tuple[int, int], str]) -> bytes:
    """The file with numbers in cells of its sheet; all parts that need not change are copied."""
    from graphkin.classroom.grading.sheet_xml import computed_anew, with_numbers

    found = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(book.data)) as packed, zipfile.ZipFile(found, "w") as again:
        changed: dict[str, bytes] = {}
        for name in book.sheets if numbers else ():
            xml = packed.read(name)
            new = with_numbers(xml, numbers if name == book.sheet else {})
            changed |= {name: new} if new != xml else {}
        if changed.keys() - {book.sheet} or (changed and book.formulas):
            main = filter(WORKBOOK.fullmatch, packed.namelist())
            changed |= {name: computed_anew(packed.read(name)) for name in main}
        for part in packed.infolist():
            content = packed.read(part)
            again.writestr(copy(part), changed.get(part.filename, content), part.compress_type)
    return found.getvalue()
