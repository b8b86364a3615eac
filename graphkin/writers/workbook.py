"""Tables as the sheets of an XLSX workbook; the same tables give the same bytes."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping, Sequence
from math import isinf
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from graphkin.text.errors import PageError, message
from graphkin.text.tables import Cell

MADE = b"2000-01-01T00:00:00Z"
"""The time that a workbook states, so that it does not depend on the clock."""
TIMES = re.compile(rb"(<dcterms:(?:created|modified)[^>]*>)[^<]*")
WIDEST = 24
"""The widest column, in characters."""


class Computed(str):
    """A formula that the program of the workbook computes, with its equals sign."""


def workbook(tables: Mapping[str, Sequence[Sequence[Cell]]]) -> bytes:
    """A workbook with a sheet for each table, by its name; the first row is the head.

    Numbers keep 16 digits. A text is a text, whatever it begins with, unless it is ``Computed``.

    Raises PageError if openpyxl is not installed.
    """
    try:
        from openpyxl import Workbook
        from openpyxl.styles import Font
        from openpyxl.utils import get_column_letter
    except ImportError:
        hint = message("install it: pip install 'graphkin[class]'")
        raise PageError.at("xlsx", message("needs openpyxl"), hint=hint) from None
    book = Workbook()
    book.remove(book.active)
    for name, rows in tables.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append([held(cell) for cell in row])
            for own, cell in zip(row, sheet[sheet.max_row], strict=False):
                if cell.data_type == "f" and not isinstance(own, Computed):
                    cell.data_type = "s"
        for column, head in enumerate(rows[0], 1):
            sheet.cell(1, column).font = Font(bold=True)
            wide = min(len(str(head)) + 4, WIDEST)
            sheet.column_dimensions[get_column_letter(column)].width = wide
        sheet.freeze_panes = "B2"
    out = io.BytesIO()
    book.save(out)
    return without_clock(out.getvalue())


def held(cell: Cell) -> Cell:
    """A cell as a workbook holds it: infinity is a text."""
    return str(cell) if isinstance(cell, float) and isinf(cell) else cell


def without_clock(data: bytes) -> bytes:
    """The archive of a workbook without times that depend on when it was written."""
    out = io.BytesIO()
    with ZipFile(io.BytesIO(data)) as old, ZipFile(out, "w", ZIP_DEFLATED) as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "docProps/core.xml":
                content = TIMES.sub(rb"\g<1>" + MADE, content)
            info = ZipInfo(name)
            info.compress_type = ZIP_DEFLATED
            new.writestr(info, content)
    return out.getvalue()
