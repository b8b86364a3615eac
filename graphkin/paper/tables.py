"""Tables of a sheet: what is read off the plans, and the angular values with their senses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphkin.paper.areas import Rect
from graphkin.paper.drawing import Drawing
from graphkin.paper.marks import Line, Mark, Text, box
from graphkin.paper.naming import segment_of
from graphkin.paper.richtext import extent
from graphkin.paper.symbolic import symbol
from graphkin.plane import Vector
from graphkin.text import Words

ROW = 4.7
HEIGHT, SMALL = 2.5, 1.8


@dataclass(frozen=True, slots=True)
class Row:
    """A row of markup cells."""

    cells: tuple[str, ...]
    name: str = ""


def vectors(drawing: Drawing) -> list[tuple[str, str, float, float]]:
    """The vectors of the plan: symbol, segment, drawn length (mm), true magnitude (SI)."""
    scale = drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka
    found = []
    for _, step, value in drawing.steps(drawing.plane):
        if step.arrow and isinstance(value, Vector):
            size = drawing.settled(abs(value.tip - value.tail))
            segment = segment_of(drawing, step)
            found.append((step.says["symbol"], segment, 1000 * size / scale, size))
    return found


def vector_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for each vector of the plan; the values left out on a task sheet."""
    words = drawing.words
    rows = []
    for name, segment, length, size in vectors(drawing):
        values = ("", "") if empty else (words.fixed(length, 2), words.significant(size))
        rows.append(Row((symbol(name), segment, *values), name))
    return rows


def turning_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for each angular velocity or acceleration, with its sense."""
    letter = "ω" if drawing.kind == "velocity" else "ε"
    words = drawing.words
    rows = []
    for link in drawing.scene.links:
        value = drawing.turning(link)
        if value is None:
            continue
        cells = ("", "") if empty else (words.significant(abs(value)), sense(words, value))
        rows.append(Row((symbol(f"{letter}_{link}"), *cells), f"{letter}{link}"))
    return rows


def sense(words: Words, value: Any) -> str:
    """The word for the sense of an angular value; nothing for nought."""
    if value == 0:
        return ""
    return words("page.anticlockwise" if value > 0 else "page.clockwise")


def table(
    x: float, y: float, widths: Sequence[float], head: Row, rows: Sequence[Row]
) -> list[Mark]:
    """A ruled table with its top-left corner at (x, y); widths of columns in mm."""
    marks: list[Mark] = []
    total, height = sum(widths), ROW * (len(rows) + 1)
    marks.append(box(x, y, total, ROW, "shade"))
    for i in range(len(rows) + 2):
        marks.append(Line(x, y + i * ROW, x + total, y + i * ROW, "panel"))
    left = x
    for width in (*widths, 0.0):
        marks.append(Line(left, y, left, y + height, "panel"))
        left += width
    marks += cells(x, y + 3.55, widths, head, size_for(widths, [head]))
    height = size_for(widths, rows)
    for i, row in enumerate(rows, 1):
        marks += cells(x, y + i * ROW + 3.55, widths, row, height)
    return marks


def size_for(widths: Sequence[float], rows: Sequence[Row]) -> float:
    """The lettering in which every cell of some rows fits its column."""
    fits = all(
        extent(markup, HEIGHT)[0] <= width - 1
        for row in rows
        for width, markup in zip(widths, row.cells, strict=True)
    )
    return HEIGHT if fits else SMALL


def cells(
    x: float, baseline: float, widths: Sequence[float], row: Row, height: float
) -> list[Mark]:
    """The texts of one row, each in the middle of its column."""
    marks: list[Mark] = []
    for width, markup in zip(widths, row.cells, strict=True):
        if markup:
            marks.append(Text(x + width / 2, baseline, markup, "table", height, "middle", row.name))
        x += width
    return marks


def tables(drawing: Drawing, rect: Rect, *, empty: bool) -> list[Mark]:
    """The vectors in one or two blocks, the angular values in a block of their own."""
    words = drawing.words
    unit = words(f"table.{drawing.kind}")
    head = Row((words("table.symbol"), words("table.segment"), words("table.millimetres"), unit))
    spin = "omega" if drawing.kind == "velocity" else "epsilon"
    turn_head = Row((words("table.symbol"), words(f"table.{spin}"), words("table.sense")))
    rows, turns = vector_rows(drawing, empty=empty), turning_rows(drawing, empty=empty)
    room = int((rect[3] - rect[1]) / ROW) - 1
    blocks = [rows[i : i + room] for i in range(0, len(rows), room)]
    marks: list[Mark] = []
    x = rect[0]
    for block in blocks:
        marks += table(x, rect[1], (14, 14, 12, 16), head, block)
        x += 56 + 3
    left = room - len(blocks[-1]) - 1 if blocks else room
    below = len(blocks) > 1 and left > len(turns)
    top = rect[1] + ROW * (len(blocks[-1]) + 1.6) if below else rect[1]
    marks += table(x - 59 if below else x, top, (13, 14, 33), turn_head, turns) if turns else []
    return marks
