"""Tables as they are written: CSV that any spreadsheet reads alike, no text that one would run."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?", re.ASCII)
RUNS = re.compile(r"""^(?=\s*[=+\-@＝＋－＠]|[\t\r\n])|([;\t\r\n][\s"]*)(?=[=+\-@＝＋－＠])""")
"""Where a spreadsheet takes what follows for a formula: at the beginning of a text, and behind what
ends a cell for one that expects semicolons or tabs between cells.
"""
QUOTED = re.compile(r'[",;\t\r\n]')
"""What a cell in quotes holds: signs at which some spreadsheet ends a cell."""


def safe(cell: object) -> str:
    """A cell that no spreadsheet runs: in a text, what looks like a formula gets a ' before it.

    What is a number stays one, -5 too.
    """
    text = str(cell)
    if not isinstance(cell, str) or NUMBER.fullmatch(text):
        return text
    return RUNS.sub(r"\1'", text)


def csv_text(rows: Iterable[Sequence[object]]) -> str:
    """The text of a CSV file, a line for each row; None is an empty cell."""
    return "".join(
        ",".join("" if cell is None else quoted(safe(cell)) for cell in row) + "\r\n"
        for row in rows
    )


def quoted(text: str) -> str:
    """A cell in quotes where it must be."""
    return '"' + text.replace('"', '""') + '"' if QUOTED.search(text) else text
