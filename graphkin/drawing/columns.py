"""Ruled tables arranged in columns, with row heights and lettering chosen to fit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import accumulate
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.drawing.field import Rect
from graphkin.drawing.marks import LineMark, Mark, RuledRow, Text, box
from graphkin.drawing.richtext import extent
from graphkin.text.errors import PageError, Problem, message
from graphkin.text.tables import Row

HEIGHT = 2.5
"""Height of the letters in mm."""
PAD = 1.4
"""Least horizontal padding of a cell, both sides together, in mm."""
BETWEEN, APART = 3, 0.45
"""Space between adjacent tables, in mm, and between stacked tables, in rows."""


class Look(NamedTuple):
    """The height of rows, the depth of their baselines in them (mm), and the width factor."""

    row: float
    base: float
    part: float
    head: float = 0.0
    """The height of the head; 0 for that of a row."""

    @property
    def top(self) -> float:
        """The height of the head, in rows."""
        return self.head / self.row if self.head else 1.0


PARTS = (1.0, 0.72, 0.5)
"""Factors on the widths of columns, from ample space to less and less."""
HIGH = tuple(Look(*high, part) for high in ((4.9, 3.8), (5.3, 3.8), (5.6, 3.9)) for part in PARTS)
"""Looks of tables with marks above letters.

Indices of indices fit below them in higher rows.
"""
LOOKS = tuple(Look(*low, part) for low in ((4.7, 3.2), (5.3, 3.5), (4.2, 3.0)) for part in PARTS)
"""Looks of tables, from ample space to less and less."""
BY_HAND = tuple(Look(7.0, 4.5, part, 5.3) for part in (1.45, 1.3, 1.15, 1.0, 0.95, 0.9))
"""Looks of tables to be filled in by hand."""
NUMBER = re.compile(r"(\(?[−<\s\d]+)(.*)", re.DOTALL)
"""A number in a cell: the part before its decimal mark, and the rest."""


class ColumnTable(Struct, frozen=True):
    """A table of a head and rows, with the least widths of its columns in mm.

    - ``among``: all rows of a table that is split into blocks, which share one look.
    - ``beside``: the table goes next to a table of one block, and below one of several blocks.
    - ``numbers``: the columns of numbers, aligned at their decimal marks.
    - ``kind``: what the table holds, for those who look for its rows on a page.
    """

    widths: tuple[float, ...]
    head: Row
    rows: tuple[Row, ...]
    among: tuple[Row, ...] = ()
    beside: bool = False
    numbers: tuple[int, ...] = ()
    kind: str = ""

    def lines(self, look: Look) -> float:
        """The height in rows of a look, including the head."""
        return len(self.rows) + look.top

    def blocks(self, room: int) -> list[ColumnTable]:
        """The table split into blocks of at most ``room`` rows, which share one look."""
        starts = range(0, len(self.rows), room)
        return [replace(self, rows=self.rows[i : i + room], among=self.rows) for i in starts]

    def columns(self, look: Look) -> tuple[float, ...]:
        """The column widths: the given ones, else space shared evenly, else what the text needs.

        Columns to write in share the space among themselves.
        """
        given = tuple(look.part * width for width in self.widths)
        needs = self.needs
        left = (sum(given) - sum(needs)) / len(given)
        if all(need + PAD <= width for need, width in zip(needs, given, strict=True)):
            return given
        if left >= PAD:
            blank = [not any(row.cells[i] for row in self.among) for i in range(len(needs))]
            more = (left - PAD) * len(needs) / (sum(blank) or len(needs))
            each = zip(needs, blank, strict=True)
            return tuple(n + PAD + (more if b or not any(blank) else 0.0) for n, b in each)
        return tuple(max(need + PAD, width) for need, width in zip(needs, given, strict=True))

    @property
    def needs(self) -> list[float]:
        """The widest text of each column in mm."""
        heads = (extent(name, HEIGHT)[0] for name in self.head.cells)
        return [max(head, self.breadth(i)) for i, head in enumerate(heads)]

    def breadth(self, column: int) -> float:
        """The width of a column's texts in mm; numbers are aligned at their decimal marks."""
        texts = tuple(row.cells[column] for row in self.among)
        return breadth_of(texts, HEIGHT, aligned=column in self.numbers)

    def marked(self, column: int) -> float:
        """The distance in mm of the decimal marks to the left of the column's middle."""
        sides = [around_mark(row.cells[column], HEIGHT) for row in self.among]
        return (max(b for _, b in sides) - max(a for a, _ in sides)) / 2

    def fits(self, look: Look) -> bool:
        """Whether all letters have their height in the rows of a look."""
        cells = (cell for row in (self.head, *self.rows, *self.among) for cell in row.cells)
        _, tops, lows = zip(*(extent(cell, HEIGHT) for cell in cells), strict=True)
        return bool(-min(tops) <= look.base - 0.1 and max(lows) <= look.row - look.base - 0.1)

    def marks(self, x: float, y: float, look: Look) -> list[Mark]:
        """The ruled table with its top-left corner at (x, y)."""
        widths, row = self.columns(look), look.row
        total, head, height = sum(widths), row * look.top, row * self.lines(look)
        marks: list[Mark] = [box(x, y, total, head, "shade")]
        marks += (LineMark(x, top, x + total, top, "panel") for top in (y, y + head))
        edges = tuple(accumulate(widths, initial=0.0))
        for i, each in enumerate(self.rows, 1):
            ruled = RuledRow(self.kind, each.name, i, row, edges)
            low = y + head + i * row
            marks.append(LineMark(x, low, x + total, low, "panel", row=ruled))
        left = x
        for width in (*widths, 0.0):
            marks.append(LineMark(left, y, left, y + height, "panel"))
            left += width
        marks += heads(x, y + (look.base if not look.head else head / 2 + 1.25), widths, self.head)
        for i, each in enumerate(self.rows):
            marks += self.cells(x, y + head + i * row + look.base, widths, each)
        return marks

    def cells(self, x: float, baseline: float, widths: Sequence[float], row: Row) -> Iterator[Mark]:
        """The texts of one row: numbers aligned at their decimal marks, others centred."""
        for i, (width, markup) in enumerate(zip(widths, row.cells, strict=True)):
            middle = x + width / 2
            x += width
            if markup and i in self.numbers:
                at = middle - self.marked(i) - around_mark(markup, HEIGHT)[0]
                yield Text(at, baseline, markup, "table", HEIGHT, "start", row.name)
            elif markup:
                yield Text(middle, baseline, markup, "table", HEIGHT, "middle", row.name)


@lru_cache(maxsize=256)
def breadth_of(texts: tuple[str, ...], height: float, *, aligned: bool) -> float:
    """The width of stacked texts in mm, centred or aligned at their decimal marks."""
    if not aligned:
        return max((extent(text, height)[0] for text in texts), default=0.0)
    sides = [around_mark(text, height) for text in texts]
    return max((a for a, _ in sides), default=0.0) + max((b for _, b in sides), default=0.0)


def around_mark(markup: str, height: float) -> tuple[float, float]:
    """The widths in mm of a number left of its decimal mark, and of the rest."""
    found = NUMBER.match(markup)
    if found is None:
        return 0.0, extent(markup, height)[0]
    whole = extent(markup, height)[0]
    left = extent(found[1], height)[0]
    return left, whole - left


def heads(x: float, baseline: float, widths: Sequence[float], row: Row) -> Iterator[Mark]:
    """The texts of a head, each in the middle of its column."""
    for width, markup in zip(widths, row.cells, strict=True):
        if markup:
            yield Text(x + width / 2, baseline, markup, "table", HEIGHT, "middle", row.name)
        x += width


def laid_out(
    tables: Sequence[ColumnTable], rect: Rect, *, by_hand: bool = False, corner: float = 0.0
) -> list[Mark]:
    """The tables in a rectangle, as large as they fit; ``by_hand`` leaves space to write.

    A square of side ``corner`` (mm) at the lower right stays free. Raises PageError where no look
    fits.
    """
    left, top, right, low = rect
    for look in looks_of(tables, by_hand=by_hand):
        columns = in_columns(tables, look, low - top)
        wide = [max(sum(table.columns(look)) for table in column) for column in columns]
        ends = [left + sum(wide[: n + 1]) + BETWEEN * n for n in range(len(wide))]
        if ends and ends[-1] > right + 1e-9:
            continue
        feet = (top + look.row * filled(column, look) for column in columns)
        beyond = (end > right - corner + 1e-9 for end in ends)
        if any(aside and foot > low - corner for aside, foot in zip(beyond, feet, strict=True)):
            continue
        if not all(table.fits(look) for table in tables):
            continue
        return [*side_by_side(columns, wide, left, top, look)]
    raise PageError(no_room(tables, right - left))


def on_sheets(
    tables: Sequence[ColumnTable], first: Rect, others: Rect, *, by_hand: bool = False
) -> list[list[Mark]]:
    """The tables on as many sheets as they need, each sheet with its rectangle.

    A table that does not fit continues below its repeated head. Raises PageError where a table is
    wider than a sheet.
    """
    looks = looks_of(tables, by_hand=by_hand)
    look = next((each for each in looks if all(table.fits(each) for table in tables)), looks[0])
    left, _, right, low = others
    sheets: list[list[Mark]] = []
    rest = list(tables)
    while rest:
        top = others[1] if sheets else first[1]
        columns = in_columns(rest, look, low - top)
        wide = [max(sum(table.columns(look)) for table in column) for column in columns]
        ends = [sum(wide[: n + 1]) + BETWEEN * n for n in range(len(wide))]
        held = sum(end <= right - left + 1e-9 for end in ends)
        if not held:
            raise PageError(no_room(tables, right - left))
        sheets.append([*side_by_side(columns[:held], wide, left, top, look)])
        rest = rejoined(table for column in columns[held:] for table in column)
    return sheets


def rejoined(blocks: Iterable[ColumnTable]) -> list[ColumnTable]:
    """The tables of a list of blocks; consecutive blocks of one table are joined again."""
    found: list[ColumnTable] = []
    for block in blocks:
        if found and found[-1].among is block.among:
            found[-1] = replace(found[-1], rows=found[-1].rows + block.rows)
        else:
            found.append(replace(block, beside=False))
    return found


def looks_of(tables: Sequence[ColumnTable], *, by_hand: bool) -> tuple[Look, ...]:
    """The looks to try, the preferred first; those ``by_hand`` have space to write."""
    raised = any("^" in cell for t in tables for row in (t.head, *t.rows) for cell in row.cells)
    return BY_HAND if by_hand else (*(HIGH if raised else ()), *LOOKS)


def side_by_side(
    columns: Sequence[Sequence[ColumnTable]],
    wide: Sequence[float],
    left: float,
    top: float,
    look: Look,
) -> Iterator[Mark]:
    """Adjacent columns of tables, with widths ``wide``, starting at (left, top)."""
    for nth, column in enumerate(columns):
        x, y = left + sum(wide[:nth]) + BETWEEN * nth, top
        for table in column:
            yield from table.marks(x, y, look)
            y += (table.lines(look) + APART) * look.row


def filled(column: Sequence[ColumnTable], look: Look) -> float:
    """The height of stacked tables in rows of a look."""
    return sum(table.lines(look) for table in column) + APART * (len(column) - 1)


def in_columns(tables: Sequence[ColumnTable], look: Look, height: float) -> list[list[ColumnTable]]:
    """The tables arranged in columns of a height in mm; long tables are split into blocks."""
    columns: list[list[ColumnTable]] = []
    lines = height / look.row + 1e-9
    for table in tables:
        for block in table.blocks(max(int(lines - look.top), 1)):
            free = (
                column
                for column in reversed([] if table.beside and len(columns) == 1 else columns)
                if filled(column, look) + APART + block.lines(look) <= lines
            )
            column = next(free, None)
            if column is None:
                columns.append([block])
            else:
                column.append(block)
    return columns


def no_room(tables: Sequence[ColumnTable], width: float) -> Problem:
    """The problem of tables that are too large: a name is too long, or there are too many rows."""
    widest, name = max(
        (extent(row.cells[i], HEIGHT)[0], row.name)
        for table in tables
        for row in table.rows
        for i in range(len(row.cells) - 2)
    )
    if widest > tables[0].widths[0]:
        found = message(
            "does not fit: {name} is {widest:.0f} mm long in the smallest lettering",
            name=name,
            widest=widest,
        )
        expected = message("about {width:.0f} mm", width=tables[0].widths[0])
        return Problem("tables", found, expected, message("shorten the names of its points"))
    rows = sum(len(table.rows) for table in tables)
    found = message(
        "does not fit: {rows} rows are too many for the {width:.0f} mm above the title block",
        rows=rows,
        width=width,
    )
    hint = message(
        "ask for fewer velocities, accelerations or links on one sheet, or split the scene"
    )
    return Problem("tables", found, message("fewer rows"), hint)
