"""A gradebook export as CSV, read as it stands: separator, quotes, blanks and ends of lines."""

from __future__ import annotations

import csv
from pathlib import Path

from graphkin.errors import Problem
from graphkin.grading.gradebook import Cell, Gradebook, GradebookError
from graphkin.roster.tables import SEPARATORS, bytes_of

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
    first = text.partition("\n")[0]
    separator = max(
        SEPARATORS,
        key=lambda sign: (len(next(csv.reader([first], delimiter=sign), [])), sign == ","),
    )
    rows, ends = split(text, separator, path.name)
    if len(rows) < 2:
        raise GradebookError(Problem(path.name, "has no row below its head", "a gradebook"))
    return Gradebook(path.name, rows, ends, separator, coding, bom)


def split(
    text: str, separator: str, name: str
) -> tuple[tuple[tuple[Cell, ...], ...], tuple[str, ...]]:
    """The rows of cells of a text with their line ends; quotes and blanks stay as they are."""
    rows: list[tuple[Cell, ...]] = []
    ends: list[str] = []
    row: list[Cell] = []
    start = at = 0
    quoted = False
    while at < len(text):
        sign = text[at]
        if sign == '"' and (quoted or not text[start:at].strip()):
            quoted = not quoted
        elif not quoted and sign == separator:
            row.append(cell(text[start:at]))
            start = at + 1
        elif not quoted and sign in "\r\n":
            end = "\r\n" if text[at : at + 2] == "\r\n" else sign
            rows.append((*row, cell(text[start:at])))
            ends.append(end)
            row, at = [], at + len(end) - 1
            start = at + 1
        at += 1
    if quoted:
        found = "a quote that is opened and never closed"
        raise GradebookError(Problem(f"{name}, row {len(rows) + 1}", found, 'a closing "'))
    if row or start < len(text):
        rows.append((*row, cell(text[start:])))
        ends.append("")
    return tuple(rows), tuple(ends)


def cell(raw: str) -> Cell:
    """A cell from its characters."""
    bare = raw.strip()
    if len(bare) >= 2 and bare[0] == bare[-1] == '"':
        return Cell(raw, bare[1:-1].replace('""', '"').strip())
    return Cell(raw, bare)
