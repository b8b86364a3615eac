"""Tables as they are written: CSV by the csv module, no text that a spreadsheet would run."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence

NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?", re.ASCII)
RUNS = ("=", "+", "-", "@", "\t", "\r", "\n")
"""First signs at which a spreadsheet takes a cell for a formula."""


def safe(cell: object) -> str:
    """A cell that no spreadsheet runs: a text that looks like a formula gets a ' before it.

    What is a number stays one, -5 too.
    """
    text = str(cell)
    runs = isinstance(cell, str) and text.startswith(RUNS) and not NUMBER.fullmatch(text)
    return f"'{text}" if runs else text


def csv_text(rows: Iterable[Sequence[object]], separator: str = ",") -> str:
    """The text of a CSV file, a line for each row; None is an empty cell."""
    lines = io.StringIO(newline="")
    writer = csv.writer(lines, delimiter=separator, lineterminator="\r\n")
    for row in rows:
        writer.writerow(["" if cell is None else safe(cell) for cell in row])
    return lines.getvalue()
