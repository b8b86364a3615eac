"""The first sheet of an XLSX file as rows of texts, numbers as they would be typed."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from datetime import date, datetime
from typing import TYPE_CHECKING, Any

from graphkin.errors import Problem
from graphkin.roster.errors import RosterError

if TYPE_CHECKING:
    from graphkin.roster.tables import Row

LARGEST = 256 * 1024 * 1024
"""Bytes of an XLSX unpacked; more is a bomb."""
PADDED = re.compile(r"0+")
"""A number format that shows leading zeros: 0000."""


def xlsx_rows(data: bytes, name: str) -> Iterator[Row]:
    """The rows of the sheet that was open last; leading zeros that its format shows are kept."""
    from graphkin.roster.tables import MOST_COLUMNS, MOST_ROWS, Row

    book = opened(data, name, read_only=True, data_only=True)
    try:
        rows = open_sheet(book).iter_rows(max_row=MOST_ROWS + 2, max_col=MOST_COLUMNS + 1)
        for number, cells in enumerate(rows, 1):
            bare = frozenset(i for i, cell in enumerate(cells) if is_bare(cell))
            yield Row(number, tuple(map(cell_text, cells)), bare)
    except RosterError:
        raise
    except Exception as error:
        raise unreadable(name) from error
    finally:
        book.close()


def open_sheet(book: Any) -> Any:
    """The sheet that was open last."""
    return book.active if book.active is not None else book.worksheets[0]


def opened(data: bytes, name: str, **how: bool) -> Any:
    """The workbook, opened as openpyxl is told how to.

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
        return load_workbook(io.BytesIO(data), **how)
    except RosterError:
        raise
    except Exception as error:
        raise unreadable(name) from error


def refuse_bomb(data: bytes, name: str) -> None:
    """Raise RosterError where a file is far larger unpacked; BadZipFile where it is no ZIP."""
    with zipfile.ZipFile(io.BytesIO(data)) as packed:
        size = sum(part.file_size for part in packed.infolist())
    if size > LARGEST:
        raise RosterError(Problem(name, "is far larger unpacked", f"{LARGEST >> 20} MiB"))


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
