"""Tables of a sheet: what is read off the plans, and the angular values with their senses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from graphkin.paper.areas import Rect
from graphkin.paper.drawing import Drawing
from graphkin.paper.marks import Line, Mark, Text, box
from graphkin.paper.naming import scale_of, segment_of, way_of
from graphkin.paper.richtext import escape, extent, flowed
from graphkin.paper.short import NEARLY_NOUGHT, hardly_turns, is_short
from graphkin.paper.symbolic import symbol
from graphkin.plane import Vector
from graphkin.text import Words

ROW, BASE = 4.7, 3.4
"""Height of a row, and how far below its upper line the letters stand, in mm."""
HEIGHT, SMALL = 2.5, 1.8
VECTORS, TURNS, SLID = (13.5, 13.5, 13, 16), (13, 14, 33), (12.5, 12, 31.5)
"""Widths of the columns of the tables, in mm."""
LEADING = 2.9
"""Distance of the lines that say what is computed, in mm."""
PAD = 1.4
"""Least room beside the letters of a cell, both sides together, in mm."""
BETWEEN, APART = 3, 0.6
"""Room between tables beside one another, in mm, and below one another, in rows."""


@dataclass(frozen=True, slots=True)
class Row:
    """A row of markup cells."""

    cells: tuple[str, ...]
    name: str = ""


def vectors(drawing: Drawing) -> list[tuple[str, str, float, float]]:
    """The vectors of the plan: symbol, segment, drawn length (mm), true magnitude (SI)."""
    scale = scale_of(drawing, drawing.plane)
    found = []
    for _, step, value in drawing.steps(drawing.plane):
        if step.arrow and isinstance(value, Vector):
            size = drawing.settled(abs(value.tip - value.tail))
            segment = segment_of(drawing, step)
            found.append((step.says["symbol"], segment, 1000 * size / scale, size))
    return found


def vector_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for each vector of the plan; the values left out on a task sheet.

    A length stands in brackets where it is not measured: the vector is computed. What is too short
    to be drawn is nearly nought.
    """
    words = drawing.words
    rows = []
    for name, segment, length, size in vectors(drawing):
        measured = words.fixed(length, 2)
        drawn = f"({measured})" if symbol(name) in drawing.computed else measured
        values = (drawn, words.significant(size))
        if empty:
            values = ("", "")
        elif size and is_short(drawing, size, drawing.plane):
            values = (NEARLY_NOUGHT, NEARLY_NOUGHT)
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
        cells = (words.significant(abs(value)), sense(words, value))
        if empty:
            cells = ("", "")
        elif value and hardly_turns(drawing, link):
            cells = (NEARLY_NOUGHT, "")
        rows.append(Row((symbol(f"{letter}_{link}"), *cells), f"{letter}{link}"))
    return rows


def slide_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for the motion of each block that is asked along its guide."""
    words = drawing.words
    rows = []
    for block, name, value in slid(drawing):
        cells = ("", "")
        if not empty:
            size = drawing.settled(abs(value))
            cells = (words.significant(size), slide_sense(drawing, block, value) if size else "")
            if size and is_short(drawing, size, drawing.plane):
                cells = (NEARLY_NOUGHT, "")
        rows.append(Row((name, *cells), f"slide {block}"))
    return rows


def slid(drawing: Drawing) -> Iterator[tuple[str, str, float]]:
    """What is asked of blocks on this sheet: block, symbol, and value along the guide."""
    velocity = drawing.kind == "velocity"
    what, letter = ("slide speed", "v") if velocity else ("slide acceleration", "a")
    for block in drawing.scene.ask.slides:
        value = drawing.trace.value(what, block)
        if value is not None:
            on = drawing.scene.links[block].slides[0].on
            yield block, f"*{letter}*_{{{escape(block)}/{escape(on)}}}", float(value)


def slide_sense(drawing: Drawing, block: str, value: float) -> str:
    """The words for the sense of a motion along a guide."""
    key = "forward" if value > 0 else "backward"
    return drawing.words(f"calculation.{key}", guide=way_of(drawing, block))


def sense(words: Words, value: Any) -> str:
    """The word for the sense of an angular value; nothing for nought."""
    if value == 0:
        return ""
    return words("page.anticlockwise" if value > 0 else "page.clockwise")


def table(
    x: float,
    y: float,
    widths: Sequence[float],
    head: Row,
    rows: Sequence[Row],
    among: Sequence[Row] = (),
) -> list[Mark]:
    """A ruled table with its top-left corner at (x, y); widths of columns in mm.

    ``among`` are all rows of a table that stands in blocks, which look alike.
    """
    widths = shared(widths, head, among or rows)
    letters = size_for(widths, among or rows)
    marks: list[Mark] = []
    total, height = sum(widths), ROW * (len(rows) + 1)
    marks.append(box(x, y, total, ROW, "shade"))
    for i in range(len(rows) + 2):
        marks.append(Line(x, y + i * ROW, x + total, y + i * ROW, "panel"))
    left = x
    for width in (*widths, 0.0):
        marks.append(Line(left, y, left, y + height, "panel"))
        left += width
    marks += cells(x, y + BASE, widths, head, SMALL)
    for i, row in enumerate(rows, 1):
        marks += cells(x, y + i * ROW + BASE, widths, row, letters)
    return marks


def shared(widths: Sequence[float], head: Row, rows: Sequence[Row]) -> tuple[float, ...]:
    """Widths of columns with the same sum, in which the room beside the cells is shared evenly.

    The given ones where every cell has room enough in them, or where not even all together have.
    """
    needs = [
        max(extent(name, SMALL)[0], *(extent(row.cells[i], HEIGHT)[0] for row in rows))
        for i, name in enumerate(head.cells)
    ]
    left = (sum(widths) - sum(needs)) / len(widths)
    enough = all(need + PAD <= width for need, width in zip(needs, widths, strict=True))
    return tuple(widths) if enough or left < PAD else tuple(need + left for need in needs)


def size_for(widths: Sequence[float], rows: Sequence[Row]) -> float:
    """The lettering in which every cell of some rows fits its column and its row."""
    for row in rows:
        for width, markup in zip(widths, row.cells, strict=True):
            across, _, below = extent(markup, HEIGHT)
            if across > width - PAD + 1e-9 or below > ROW - BASE - 0.1:
                return SMALL
    return HEIGHT


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
    """The vectors in one or two blocks, then the angular values, then what slides."""
    words = drawing.words
    unit = words(f"table.{drawing.kind}")
    head = Row((words("table.symbol"), words("table.segment"), words("table.millimetres"), unit))
    spin = "omega" if drawing.kind == "velocity" else "epsilon"
    turn_head = Row((words("table.symbol"), words(f"table.{spin}"), words("table.sense")))
    slide_head = Row((words("table.symbol"), unit, words("table.sense")))
    rows, turns = vector_rows(drawing, empty=empty), turning_rows(drawing, empty=empty)
    sliding = slide_rows(drawing, empty=empty)
    note = reasons(drawing, [*rows, *turns, *sliding], rect)
    low = rect[3] - LEADING * len(note)
    room = int((low - rect[1]) / ROW) - 1
    blocks = [rows[i : i + room] for i in range(0, len(rows), room)]
    marks: list[Mark] = [*note]
    x = rect[0]
    for block in blocks:
        marks += table(x, rect[1], VECTORS, head, block, rows)
        x += sum(VECTORS) + BETWEEN
    used = float(len(blocks[-1]) + 1 if blocks else room + 1)
    below = len(blocks) > 1 and room - used > len(turns)
    if below or not turns:
        x, used = x - sum(VECTORS) - BETWEEN, used + APART
    else:
        used = 0.0
    if turns:
        marks += table(x, rect[1] + used * ROW, TURNS, turn_head, turns)
        used += len(turns) + 1 + APART
    if not sliding:
        return marks
    if (used + len(sliding) + 1) * ROW > low - rect[1]:
        if below:
            x, used = x + sum(TURNS) + BETWEEN, 0.0
        else:
            x, used = x - sum(VECTORS) - BETWEEN, len(blocks[-1]) + 1 + APART
    return [*marks, *table(x, rect[1] + used * ROW, SLID, slide_head, sliding)]


def reasons(drawing: Drawing, rows: Sequence[Row], rect: Rect) -> list[Mark]:
    """What is computed instead of measured, and why, in small lines below the tables."""
    names: dict[str, list[str]] = {}
    for row in rows:
        why = drawing.computed.get(row.cells[0])
        if why:
            names.setdefault(why, []).append(row.cells[0])
    mark = drawing.words("list_mark")
    said = [f"{mark.join(dict.fromkeys(found))}: {why}" for why, found in names.items()]
    lines = flowed(said, "; ", rect[2] - rect[0], SMALL)
    first = rect[3] - LEADING * (len(lines) - 1)
    return [
        Text(rect[0], first + LEADING * i, line, "caption", SMALL, name="computed")
        for i, line in enumerate(lines)
    ]
