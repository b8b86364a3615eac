"""A gradebook export as CSV, read as it stands: separator, quotes, blanks and ends of lines."""

from __future__ import annotations

import re
from pathlib import Path

from graphkin.classroom.grading.gradebook import Cell, Gradebook, GradebookError
from graphkin.classroom.roster.sheet_rows import MOST_CELLS, too_large
from graphkin.classroom.roster.spreadsheets import bytes_of, separator_of
from graphkin.text.errors import Problem

BOMS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be"}


def read_gradebook(path: Path) -> Gradebook:
    """An export as it stands. Raises GradebookError where it is no table."""
    data = bytes_of(path)
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
    return Gradebook(path.name, rows, ends, separator, coding, bom)


def split(
    text: str, separator: str, name: str
) -> tuple[tuple[tuple[Cell, ...], ...], tuple[str, ...]]:
    """The rows of cells of a text with their line ends; quotes and blanks stay as they are.

    Raises GradebookError for a quote that is never closed, or as soon as there are too many cells.
    """
    piece = re.compile(
        rf'([^\S\r\n{separator}]*+"[^"]*+(?:""[^"]*+)*+")?+([^\r\n{separator}]*+)'
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
