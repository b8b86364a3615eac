"""Tables as records, and their renderers as aligned text and as comma-separated values.

The renderer for pages is ``tables_html`` in writers/templates.py.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from msgspec import Struct

DIGITS = 6
NOISE = 1e-12
"""Share of the largest magnitude of its kind below which a printed number is rounding."""

Cell = str | float | None


class Row(Struct, frozen=True):
    """A row of cells in markup; ``name`` says what the row is about."""

    cells: tuple[str, ...]
    name: str = ""


class CellTable(Struct, frozen=True):
    """A table of cells in markup: its heads, its rows, and its caption.

    ``kind`` is the class of the table on a page. ``marks`` are the attributes of each row there; an
    attribute that is True has no value.
    """

    heads: tuple[str, ...]
    rows: Sequence[Row]
    caption: str = ""
    kind: str = ""
    marks: Sequence[Mapping[str, str | bool]] = ()

    def lines(self, plain: Callable[[str], str] = str) -> list[str]:
        """The table as aligned text; ``plain`` takes the markup out of a cell."""
        return table(list(map(plain, self.heads)), [[*map(plain, r.cells)] for r in self.rows])


def number(value: float) -> str:
    """A number with six significant digits, never minus zero."""
    if value == 0:
        return "0"
    return f"{value:#.{DIGITS}g}".rstrip(".")


def cleaned(value: float, largest: float) -> float:
    """The value, or zero where it is rounding relative to the largest of its kind."""
    return 0.0 if abs(value) <= NOISE * largest else value


def table(heads: Sequence[str], rows: Iterable[Sequence[Cell]]) -> list[str]:
    """Lines of a table: numbers aligned at their decimal points, texts at the left."""
    body = [tuple(row) for row in rows]
    columns = [column(head, [row[i] for row in body]) for i, head in enumerate(heads)]
    return ["  ".join(cells).rstrip() for cells in zip(*columns, strict=True)]


def column(head: str, cells: Sequence[Cell]) -> list[str]:
    """One column, its head first, all of one width."""
    if any(isinstance(cell, float) for cell in cells):
        texts = at_the_point(["–" if cell is None else worded(cell) for cell in cells])
        width = max(map(len, [head, *texts]))
        return [text.rjust(width) for text in [head, *texts]]
    plain = [head, *("–" if cell is None else str(cell) for cell in cells)]
    width = max(map(len, plain))
    return [text.ljust(width) for text in plain]


def worded(cell: Cell) -> str:
    """The text of a cell."""
    return number(cell) if isinstance(cell, float) else str(cell)


def at_the_point(texts: Sequence[str]) -> list[str]:
    """Numbers padded on the right so that their decimal points are aligned."""
    tails = [len(text) - (text.find(".") if "." in text else len(text)) for text in texts]
    most = max(tails, default=0)
    return [text + " " * (most - tail) for text, tail in zip(texts, tails, strict=True)]


def labelled(label: str, lines: Sequence[str], width: int = 11) -> list[str]:
    """Lines with a label before the first and the others indented."""
    width = max(width, len(label) + 1)
    return [f"{label if i == 0 else '':<{width}}{line}".rstrip() for i, line in enumerate(lines)]


Say = Callable[[str], None]
"""Receives progress in words, during work that takes seconds."""


def listed(names: Iterable[str], most: int = 12) -> str:
    """Names with commas and a final ``and``; a long list is cut, with the number left out."""
    known = list(names)
    if len(known) > most:
        known = [*known[:most], f"{len(known) - most} more"]
    return " and ".join([", ".join(known[:-1]), known[-1]]) if len(known) > 1 else "".join(known)


# --- comma-separated values -----------------------------------------------------------------------


NUMBER = r"[+-]?(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)(?:[eE][+-]?[0-9]+)?"
RUNS = r"""^(?=\s*[=+\-@＝＋－＠]|[\t\r\n])|([;\t\r\n][\s"]*)(?=[=+\-@＝＋－＠])"""
"""The places where a spreadsheet reads what follows as a formula.

They are the beginning of a text, and any end of a cell for a spreadsheet that expects semicolons or
tabs between cells.
"""
QUOTED = r'[",;\t\r\n]'
"""The signs that require quotes: some spreadsheet ends a cell at each of them."""


def safe(cell: object) -> str:
    """A cell that no spreadsheet runs: a text that looks like a formula gets a leading '.

    A number stays a number, including -5.
    """
    text = str(cell)
    if not isinstance(cell, str) or re.fullmatch(NUMBER, text):
        return text
    return re.sub(RUNS, r"\1'", text)


def csv_text(rows: Iterable[Sequence[object]], end: str = "\r\n") -> str:
    """The text of a CSV file, a line for each row; None is an empty cell."""
    return "".join(
        ",".join("" if cell is None else quoted(safe(cell)) for cell in row) + end for row in rows
    )


def quoted(text: str) -> str:
    """A cell, in quotes if it needs them."""
    return '"' + text.replace('"', '""') + '"' if re.search(QUOTED, text) else text
