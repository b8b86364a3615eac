"""Ruled tables arranged in columns, with row heights and lettering chosen to fit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.drawing.field import Rect
from graphkin.drawing.marks import LineMark, Mark, Text, box
from graphkin.drawing.richtext import extent
from graphkin.text.errors import PageError, Problem, message
from graphkin.text.tables import Row

HEIGHT, SMALL = 2.5, 1.8
"""Letter heights in mm: the preferred one and the least."""
PAD = 1.4
"""Least horizontal padding of a cell, both sides together, in mm."""
BETWEEN, APART = 3, 0.6
"""Space between adjacent tables, in mm, and between stacked tables, in rows."""


class Look(NamedTuple):
    """The row height, the baseline's depth below the row's upper line (mm), and the width factor.

    ``large``: this look is used only with large letters.
    """

    row: float
    base: float
    part: float
    large: bool = False

    @property
    def letters(self) -> tuple[float, ...]:
        """The letter heights to try."""
        return (HEIGHT, SMALL) if self.part >= 1 else (SMALL,)


WIDENED = ((1.0, True), (1.15, True), (1.3, True), (1.0, False))
"""Width factors to try with large letters, before small ones."""
HIGH = (
    *(Look(5.0, 3.55, *how) for how in WIDENED if how[1]),
    *(Look(5.6, 3.7, *how) for how in WIDENED if how[1]),
    Look(5.0, 3.55, 1.0),
)
"""Looks of tables with marks above letters, where space permits.

Indices of indices fit below them in higher rows.
"""
LOOKS = (
    *(Look(4.7, 3.2, *how) for how in WIDENED),
    *(Look(row, row - 1.15, 0.72) for row in (4.7, 4.2, 3.8)),
)
"""Looks of tables, from ample space to less and less."""
BY_HAND = tuple(Look(row, row / 2 + 1.0, *how) for row in (7.0, 6.0, 5.0) for how in WIDENED)
"""Looks of tables to be filled in by hand, where space permits."""
NUMBER = re.compile(r"(\(?[−<\s\d]+)(.*)", re.DOTALL)
"""A number in a cell: the part before its decimal mark, and the rest."""


class ColumnTable(Struct, frozen=True):
    """A table of a head and rows, with the least widths of its columns in mm.

    - ``among``: all rows of a table that is split into blocks, which share one look.
    - ``beside``: the table goes next to a table of one block, and below a table of several blocks
      where a whole row stays free.
    - ``numbers``: the columns of numbers, aligned at their decimal marks.
    """

    widths: tuple[float, ...]
    head: Row
    rows: tuple[Row, ...]
    among: tuple[Row, ...] = ()
    beside: bool = False
    numbers: tuple[int, ...] = ()

    @property
    def lines(self) -> int:
        """The number of rows, including the head."""
        return len(self.rows) + 1

    def blocks(self, room: int) -> list[ColumnTable]:
        """The table split into blocks of at most ``room`` rows, which share one look."""
        starts = range(0, len(self.rows), room)
        return [replace(self, rows=self.rows[i : i + room], among=self.rows) for i in starts]

    def columns(self, look: Look) -> tuple[float, ...]:
        """The column widths: the given ones, else space shared evenly, else what the text needs."""
        given = tuple(look.part * width for width in self.widths)
        for height in look.letters:
            needs = self.needs(height)
            left = (sum(given) - sum(needs)) / len(given)
            if all(need + PAD <= width for need, width in zip(needs, given, strict=True)):
                return given
            if left >= PAD:
                return tuple(need + left for need in needs)
        return tuple(max(need + PAD, width) for need, width in zip(needs, given, strict=True))

    def needs(self, height: float) -> list[float]:
        """The widest text of each column in mm."""
        return [
            max(extent(name, SMALL)[0], self.breadth(i, height))
            for i, name in enumerate(self.head.cells)
        ]

    def breadth(self, column: int, height: float) -> float:
        """The width of a column's texts in mm; numbers are aligned at their decimal marks."""
        texts = tuple(row.cells[column] for row in self.among)
        return breadth_of(texts, height, aligned=column in self.numbers)

    def marked(self, column: int, height: float) -> float:
        """The distance in mm of the decimal marks to the left of the column's middle."""
        sides = [around_mark(row.cells[column], height) for row in self.among]
        return (max(b for _, b in sides) - max(a for a, _ in sides)) / 2

    def lettering(self, look: Look) -> float:
        """The letter height of the rows."""
        return self.letters(look, self.columns(look))

    def letters(self, look: Look, widths: Sequence[float]) -> float:
        """The letter height at which every cell fits its column and its row."""
        if look.letters[0] != HEIGHT:
            return look.letters[0]
        for i, width in enumerate(widths):
            below = max(extent(row.cells[i], HEIGHT)[2] for row in self.among)
            wide = self.breadth(i, HEIGHT) > width - PAD + 1e-9
            if wide or below > look.row - look.base - 0.1:
                return SMALL
        return look.letters[0]

    def marks(self, x: float, y: float, look: Look) -> list[Mark]:
        """The ruled table with its top-left corner at (x, y)."""
        widths, row = self.columns(look), look.row
        total, height = sum(widths), row * self.lines
        marks: list[Mark] = [box(x, y, total, row, "shade")]
        for i in range(self.lines + 1):
            marks.append(LineMark(x, y + i * row, x + total, y + i * row, "panel"))
        left = x
        for width in (*widths, 0.0):
            marks.append(LineMark(left, y, left, y + height, "panel"))
            left += width
        marks += heads(x, y + look.base, widths, self.head)
        letters = self.letters(look, widths)
        for i, each in enumerate(self.rows, 1):
            marks += self.cells(x, y + i * row + look.base, widths, each, letters)
        return marks

    def cells(
        self, x: float, baseline: float, widths: Sequence[float], row: Row, height: float
    ) -> Iterator[Mark]:
        """The texts of one row: numbers aligned at their decimal marks, others centred."""
        for i, (width, markup) in enumerate(zip(widths, row.cells, strict=True)):
            middle = x + width / 2
            x += width
            if markup and i in self.numbers:
                at = middle - self.marked(i, height) - around_mark(markup, height)[0]
                yield Text(at, baseline, markup, "table", height, "start", row.name)
            elif markup:
                yield Text(middle, baseline, markup, "table", height, "middle", row.name)


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
    """The small texts of a head, each in the middle of its column."""
    for width, markup in zip(widths, row.cells, strict=True):
        if markup:
            yield Text(x + width / 2, baseline, markup, "table", SMALL, "middle", row.name)
        x += width


def laid_out(tables: Sequence[ColumnTable], rect: Rect, *, by_hand: bool = False) -> list[Mark]:
    """The tables in a rectangle, as large as they fit; ``by_hand`` leaves space to write.

    Raises PageError where no look fits.
    """
    left, top, right, low = rect
    for look in looks_of(tables, by_hand=by_hand):
        columns = in_columns(tables, (low - top) / look.row)
        wide = [max(sum(table.columns(look)) for table in column) for column in columns]
        if sum(wide) + BETWEEN * (len(wide) - 1) > right - left + 1e-9:
            continue
        if look.large and any(table.lettering(look) == SMALL for c in columns for table in c):
            continue
        return [*side_by_side(columns, wide, left, top, look)]
    raise PageError(no_room(tables, right - left))


def on_sheets(
    tables: Sequence[ColumnTable], first: Rect, others: Rect, *, by_hand: bool = False
) -> list[list[Mark]]:
    """The tables on as many sheets as they need, each sheet with its rectangle.

    Letters are the largest possible; columns to be filled in by hand are the widest. A table that
    does not fit continues below its repeated head. Raises PageError where a table is wider than a
    sheet.
    """
    looks = looks_of(tables, by_hand=by_hand)
    look = max(looks, key=lambda each: each.part) if by_hand else looks[0]
    left, _, right, low = others
    sheets: list[list[Mark]] = []
    rest = list(tables)
    while rest:
        top = others[1] if sheets else first[1]
        columns = in_columns(rest, (low - top) / look.row)
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
    """The looks to try, the preferred first; ``by_hand`` puts looks with space to write first."""
    raised = any("^" in row.cells[0] for table in tables for row in table.rows)
    return (*(BY_HAND if by_hand else ()), *(HIGH if raised else ()), *LOOKS)


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
            y += (table.lines + APART) * look.row


def in_columns(tables: Sequence[ColumnTable], lines: float) -> list[list[ColumnTable]]:
    """The tables arranged in columns of ``lines`` lines; long tables are split into blocks."""
    columns: list[list[ColumnTable]] = []
    for table in tables:
        room = lines - (1 - APART if table.beside else 0)
        for block in table.blocks(max(int(lines) - 1, 1)):
            free = (
                column
                for column in reversed([] if table.beside and len(columns) == 1 else columns)
                if sum(above.lines + APART for above in column) + block.lines <= room
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
        (extent(row.cells[i], SMALL)[0], row.name)
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
