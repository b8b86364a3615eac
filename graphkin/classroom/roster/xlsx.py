"""The first sheet of an XLSX file as rows of texts, numbers as they would be typed."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from datetime import date, datetime
from typing import IO, Any
from warnings import catch_warnings, simplefilter

from graphkin.classroom.roster.sheet_rows import LAST_ROW, MOST_CELLS, SheetRow, too_large
from graphkin.text.errors import GraphkinError, Problem, RosterError

LARGEST, MOST_ELEMENTS = 64 * 1024 * 1024, 1_000_000
"""Bytes and XML elements of an XLSX unpacked; more is a bomb. A cell with a number has two."""
BLOCK = 1 << 20
PADDED = re.compile(r"0+")
"""A number format that shows leading zeros: 0000."""


def xlsx_rows(data: bytes, name: str) -> Iterator[SheetRow]:
    """The rows of the sheet that was open last; leading zeros that its format shows are kept."""
    with opened(data, name, data_only=True) as book:
        for number, cells in full_rows(open_sheet(book), name):
            bare = frozenset(i for i, cell in enumerate(cells) if is_bare(cell))
            yield SheetRow(number, tuple(map(cell_text, cells)), bare)


def open_sheet(book: Any) -> Any:
    """The sheet that was open last."""
    return book.active if book.active is not None else book.worksheets[0]


def full_rows(sheet: Any, name: str) -> Iterator[tuple[int, Sequence[Any]]]:
    """The rows of a sheet that hold something, each with its number, which counts from 1.

    Cells are those as far as the last of the row. Raises RosterError as soon as there are too many.
    """
    sheet.reset_dimensions()  # what a file says of its size may be anything
    count = 0
    for number, cells in enumerate(sheet.iter_rows(), 1):
        count += len(cells)
        if number > LAST_ROW or count > MOST_CELLS:
            raise too_large(name, f"{number} rows, and {count} cells as far as there")
        if any(cell.value not in (None, "") for cell in cells):
            yield number, cells


@contextmanager
def opened(data: bytes, name: str, *, data_only: bool) -> Iterator[Any]:
    """The workbook, opened for reading row by row: values, or the formulas that give them.

    Raises RosterError where openpyxl is missing, or the file is no workbook.
    """
    try:
        from openpyxl import load_workbook
    except ImportError:
        hint = "or install it: pip install 'graphkin[class]'"
        found = "is an XLSX file, and openpyxl, which reads those, is not installed"
        raise RosterError(Problem(name, found, "the table saved as CSV UTF-8", hint)) from None
    try:
        refuse_bomb(data, name)
        with catch_warnings():  # openpyxl names what it does not read: it is not written either
            simplefilter("ignore")
            book = load_workbook(
                io.BytesIO(data), read_only=True, data_only=data_only, keep_links=False
            )
            with closing(book):
                yield book
    except GraphkinError:
        raise
    except Exception as error:
        raise unreadable(name) from error


def refuse_bomb(data: bytes, name: str) -> None:
    """Raise RosterError where a file is far larger unpacked; BadZipFile where it is no ZIP."""
    expected = f"at most {LARGEST >> 20} MiB and {MOST_ELEMENTS} XML elements"
    with zipfile.ZipFile(io.BytesIO(data)) as packed:
        size = sum(part.file_size for part in packed.infolist())
        if size > LARGEST:
            raise RosterError(Problem(name, "is far larger unpacked", expected))
        elements = sum(map(elements_of, map(packed.open, packed.infolist())))
    if elements > MOST_ELEMENTS:
        raise RosterError(Problem(name, f"holds about {elements} XML elements", expected))


def elements_of(part: IO[bytes]) -> int:
    """About how many elements a part has, if it is XML: its tags that close none."""
    blocks = iter(lambda: part.read(BLOCK), b"")
    return sum(block.count(b"<") - block.count(b"</") for block in blocks)


def unreadable(name: str) -> RosterError:
    """The error for a file that is no workbook."""
    hint = "open it in a spreadsheet and save it again, or as CSV UTF-8"
    return RosterError(Problem(name, "cannot be read as XLSX", "a workbook", hint))


def is_bare(cell: Any) -> bool:
    """Whether a cell is a number that shows no zeros before it: 0041 would be 41."""
    number = isinstance(cell.value, int | float) and not isinstance(cell.value, bool)
    return number and not PADDED.fullmatch(getattr(cell, "number_format", "") or "")


def cell_text(cell: Any) -> str:
    """A cell as it would be typed: whole numbers without a point, zeros before them as shown."""
    value = cell.value
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        value = int(value)
    if isinstance(value, int):
        shown = getattr(cell, "number_format", "") or ""
        zeros = len(shown) if PADDED.fullmatch(shown) else 0
        return f"{value:0{zeros}d}" if zeros else str(value)
    if isinstance(value, datetime | date):
        return value.isoformat()
    return repr(value) if isinstance(value, float) else str(value)
