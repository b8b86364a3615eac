"""Tables as spreadsheets write them: CSV with any usual separator, or the first sheet of an XLSX.

Nothing is guessed that could shift a column: what a file breaks is told by its row, all at once.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from graphkin.classroom.roster.roster_errors import RosterError
from graphkin.classroom.roster.sheet_rows import (
    LAST_ROW,
    LONGEST,
    MOST_CELLS,
    MOST_COLUMNS,
    MOST_ROWS,
    SheetRow,
    too_large,
)
from graphkin.scene.file_limits import file_bytes
from graphkin.scene.findings import Findings, visible
from graphkin.text.errors import Problem

LARGEST = 16 * 1024 * 1024
"""Bytes of a table."""
SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs"}
ROW = re.compile(r", row (\d+)")
"""How a problem names its row."""
ZIP, OLD_EXCEL = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"
"""First bytes of an XLSX, which is a ZIP file, and of an XLS."""


class Spreadsheet(Struct, frozen=True):
    """A table: the name of its file, its head, its rows; cells are texts without blanks around.

    ``separator`` is what stands between the cells; a tab for XLSX.
    """

    name: str
    head: tuple[str, ...]
    rows: tuple[SheetRow, ...]
    separator: str = ","

    def place(self, row: SheetRow, column: str = "") -> str:
        """Where something is, as errors say it: roster.csv, row 14, column "id"."""
        words = f"{self.name}, row {row.line}"
        return f'{words}, column "{visible(column)}"' if column else words


class TableProblems(Findings):
    """Problems of a table, gathered so that all are told at once."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name

    def stop(self) -> None:
        """Raise RosterError when anything was found, in the order of the rows."""
        if self.problems:
            raise RosterError(sorted(self.problems, key=row_of))


def row_of(problem: Problem) -> int:
    """The row that a problem names; nought for one of the whole table."""
    found = ROW.search(problem.place)
    return int(found[1]) if found else 0


def read_sheet(
    path: Path, heads: Sequence[str] = (), told: TableProblems | None = None
) -> Spreadsheet:
    """The table in a CSV or XLSX file; RosterError with every row that cannot be read.

    ``heads`` are names of columns that help to tell the separator. Cells are normalised (NFC).
    Rows that cannot be read are left out and noted in ``told``, if there is one: the caller finds
    the other problems, and then stops.
    """
    return sheet_in(bytes_of(Path(path)), Path(path).name, heads, told)


def sheet_in(
    data: bytes, name: str, heads: Sequence[str] = (), told: TableProblems | None = None
) -> Spreadsheet:
    """The same of the bytes of a file, by the name that errors give it."""
    own, told = told is None, told or TableProblems(name)
    rows: Iterable[SheetRow]
    if data.startswith(OLD_EXCEL):
        hint = "save it as .xlsx or as CSV UTF-8"
        raise RosterError(Problem(name, "is an old Excel file (.xls)", "CSV or XLSX", hint))
    if data.startswith(ZIP):
        from graphkin.classroom.roster.xlsx import xlsx_rows

        rows, separator = list(xlsx_rows(data, name)), "\t"
    else:
        text = text_of(data, name)
        separator = separator_of(text, heads)
        rows = csv_rows(text, separator, told)
    sheet = sheet_of(name, rows, separator, told)
    if own:
        told.stop()
    return sheet


def bytes_of(path: Path) -> bytes:
    """The bytes of a file. Raises RosterError where there are none, or too many."""
    try:
        data = file_bytes(path, LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "cannot be opened"
        raise RosterError(Problem(str(path), f"the table cannot be read: {reason}")) from None
    if len(data) > LARGEST:
        raise RosterError(Problem(path.name, "is too large", f"at most {LARGEST >> 20} MiB"))
    return data


def text_of(data: bytes, name: str) -> str:
    """The text of a CSV file: UTF-8 with or without a byte order mark, or UTF-16 with one."""
    wide = data.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        text = data.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        row = data.count(b"\n", 0, error.start) + 1
        found = f"the byte 0x{data[error.start]:02x} is not UTF-8"
        hint = "in the spreadsheet, save as CSV UTF-8"
        raise RosterError(
            Problem(f"{name}, row {row}", found, "a text saved as UTF-8", hint)
        ) from None
    if "\0" in text:
        row = text.count("\n", 0, text.index("\0")) + 1
        hint = "save the table again as CSV UTF-8"
        raise RosterError(Problem(f"{name}, row {row}", "a NUL character", "a text", hint))
    return text


def separator_of(text: str, heads: Sequence[str] = ()) -> str:
    """What stands between the cells, by the head: the sign that makes most known columns of it."""
    first = next((line for line in io.StringIO(text, newline="") if line.strip(" ,;\t\r\n")), "")
    first = first[: csv.field_size_limit()]
    known = {folded(head) for head in heads}

    def worth(separator: str) -> tuple[int, int]:
        cells = next(csv.reader([first], delimiter=separator), [])
        return sum(bool(cell) and folded(cell) in known for cell in cells), len(cells)

    return max(SEPARATORS, key=worth)


def csv_rows(text: str, separator: str, told: TableProblems) -> Iterator[SheetRow]:
    """The rows of a CSV text by the lines on which they begin; what is broken is noted."""
    lines = io.StringIO(text, newline="")
    reader = csv.reader(lines, delimiter=separator, strict=True)
    begins = 1
    while True:
        try:
            cells = next(reader, None)
        except csv.Error as error:
            told.add(f"{told.name}, row {begins}", *broken(str(error)))
            return
        if cells is None:
            return
        if reader.line_num > LAST_ROW:
            raise too_large(told.name, f"more than {LAST_ROW} lines")
        if reader.line_num > begins and any("\n" in c or "\r" in c for c in cells):
            found = f"a cell goes on to row {reader.line_num}"
            hint = "is a closing quote missing?"
            told.add(f"{told.name}, row {begins}", found, "a cell on one row", hint)
        yield SheetRow(begins, tuple(cells))
        begins = reader.line_num + 1


def broken(message: str) -> tuple[str, str, str]:
    """What the reader of CSV says, in words that help: found, expected, hint."""
    if "unexpected end" in message:
        return "a quote that is opened and never closed", 'a closing "', "the rest is not read"
    if "expected after" in message:
        hint = 'a quote within quotes is written twice: "Ann ""Nan"" Lee"'
        return "a quote in the middle of a quoted cell", "the end of the cell after it", hint
    if "field larger" in message:
        return "a cell that is too long", f"at most {LONGEST} characters", "is a quote missing?"
    return f"cannot be read: {message}", "", ""


def sheet_of(
    name: str, rows: Iterable[SheetRow], separator: str, told: TableProblems
) -> Spreadsheet:
    """A table of rows: the first that is not empty is its head, empty ones are left out."""
    body = (row for row in map(tidied, rows) if row.cells)
    head = next(body, None)
    if head is None:
        told.stop()
        raise RosterError(
            Problem(name, "the table is empty", "a head, then a row for each student")
        )
    width = len(head.cells)
    if width > MOST_COLUMNS:
        raise too_large(name, f"{width} columns")
    twice = repeated([folded(cell) for cell in head.cells if cell])
    for i, cell in enumerate(head.cells):
        refuse_hidden(told, f"{name}, row {head.line}, column {i + 1}", cell)
        if folded(cell) in twice:
            told.add(f"{name}, row {head.line}", f'two columns are called "{visible(cell)}"', "one")
            twice.discard(folded(cell))
    rows_found = []
    for count, row in enumerate(body, 1):
        if count > MOST_ROWS or count * width > MOST_CELLS:
            raise too_large(name, f"more than {count - 1} rows of {width} columns")
        cells = row.cells
        if len(cells) > width:
            words = f"{len(cells)} cells, and the head has {width}"
            hint = f"a cell that holds {SEPARATORS[separator]} is written in quotes"
            told.add(f"{name}, row {row.line}", words, f"at most {width}", hint)
            continue
        for i, cell in enumerate(cells):
            refuse_hidden(told, f'{name}, row {row.line}, column "{visible(head.cells[i])}"', cell)
        whole = cells + ("",) * (width - len(cells))
        rows_found.append(SheetRow(row.line, whole, row.numbers))
    return Spreadsheet(name, head.cells, tuple(rows_found), separator)


def tidied(row: SheetRow) -> SheetRow:
    """A row of tidy cells, without the empty ones at its end."""
    cells = [tidy(cell) for cell in row.cells]
    while cells and not cells[-1]:
        cells.pop()
    return SheetRow(row.line, tuple(cells), row.numbers)


def tidy(cell: str) -> str:
    """A cell without blanks around it, in composed letters (NFC)."""
    return unicodedata.normalize("NFC", cell.strip().strip("\ufeff").strip())


def repeated(names: Sequence[str]) -> set[str]:
    """The names that stand there more than once."""
    return {name for name in names if names.count(name) > 1}


def refuse_hidden(told: TableProblems, place: str, cell: str) -> None:
    """Note a cell with control or bidirectional characters, or one too long."""
    if len(cell) > LONGEST:
        told.add(place, f"{len(cell)} characters", f"at most {LONGEST}")
        return
    for character in cell:
        if character not in "\n\r\t" and unicodedata.category(character) in ("Cc", "Cf", "Cs"):
            told.add(place, f"the control character {character!a}", "printable text")
            return


def folded(head: str) -> str:
    """The name of a column as it is compared: no case, no accents, no blanks or signs."""
    apart = unicodedata.normalize("NFKD", head.strip().strip("\ufeff"))
    return "".join(c for c in apart.casefold() if c.isalnum())


def columns(sheet: Spreadsheet, names: Mapping[str, Sequence[str]]) -> dict[str, int]:
    """Which column holds what, by the names that each may bear in any language."""
    known = {folded(name): what for what, every in names.items() for name in (what, *every)}
    found: dict[str, int] = {}
    for i, cell in enumerate(sheet.head):
        what = known.get(folded(cell)) if folded(cell) else None
        if what is not None:
            found.setdefault(what, i)
    return found
