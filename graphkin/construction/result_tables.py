"""The tables of a sheet: values read off the plans, and angular values with their senses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Literal

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import drawn_in, segment_of, sense, way_of
from graphkin.construction.core.program import plan_vector
from graphkin.construction.core.quantities import (
    FORCE,
    RATES,
    OnPaper,
    in_millimetres,
    in_mm,
    names_asked,
)
from graphkin.construction.core.relation import value_of
from graphkin.drawing.columns import HEIGHT, ColumnTable, laid_out, on_sheets
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import flowed
from graphkin.drawing.symbol_markup import escape
from graphkin.numbers.plane import Vector
from graphkin.text.tables import CellTable, Row

WIDTHS = {"vectors": (13.5, 13.5, 13, 16), "turns": (13, 14, 33), "slides": (12.5, 12, 31.5)}
WIDTHS |= {"sides": (13.5, 13, 16), "balance": (20, 30, 20), "arms": (13, 13)}
"""Widths of the columns of each table on paper, in mm."""
NUMBERS = {"vectors": (2, 3), "turns": (1,), "slides": (1,)}
NUMBERS |= {"sides": (1, 2), "balance": (1, 2), "arms": (1,)}
"""The columns of numbers of each table; those before them name the row."""
WRITTEN: Mapping[str, Mapping[int, Literal["segment", "value", "sense"]]] = {
    "vectors": {2: "segment", 3: "value"},
    "turns": {1: "value", 2: "sense"},
    "slides": {1: "value", 2: "sense"},
    "sides": {1: "segment", 2: "value"},
}
"""What a hand writes into the columns of each table of a task sheet."""
LEGIBLE = 2.0
"""Least length in mm of a vector that is read off a plan: an error of 0.5 mm is a quarter of it."""
COMPUTED = "computed"
"""The name of the notes on computed values."""
LEADING = 3.9
"""Line spacing of the notes on computed values, in mm."""


def vectors(drawing: Drawing) -> list[tuple[str, str, OnPaper, float]]:
    """The vectors of the plan: symbol, segment, drawn length (mm), true magnitude (SI)."""
    found = []
    for _, step, value in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if vector is not None and isinstance(value, Vector):
            size = drawing.settled(abs(value.tip - value.tail))
            segment = segment_of(drawing, step)
            length = drawn_in(drawing, drawing.plane, size)
            found.append((vector.symbol, segment, length, size))
    return found


def unread(drawing: Drawing, named: Callable[[str], str] = str) -> Iterator[str]:
    """Messages for requested quantities that cannot be read off: too short in the plan, or zero.

    Quantities that the sheet itself marks as computed are left out. ``named`` formats a name, for
    example v_B.
    """
    words, ask = drawing.words, drawing.scene.ask
    targets = drawing.trace.program.targets
    images = {targets.get((drawing.kind, name)) for name in getattr(ask, drawing.kind)}
    short, still = {}, {}
    for _, step, value in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if vector is None or vector.p or vector.sign or step.args[-1] not in images:
            continue
        size = drawing.settled(abs(value.tip - value.tail))
        length = drawn_in(drawing, drawing.plane, size)
        if size == 0:
            still[vector.symbol] = named(vector.symbol)
        elif length < LEGIBLE and drawing.symbol(vector.symbol) not in drawing.computed:
            short[vector.symbol] = f"{named(vector.symbol)} ({in_millimetres(words, length)})"
    for link in getattr(ask, drawing.rate.target):
        if drawing.turning(link) == 0:
            still[link] = named(f"{drawing.rate.letter}_{link}")
    sheet, least = words(f"sheet.{drawing.kind}"), words.decimal(f"{LEGIBLE:g}")
    for key, names in (("sheet.too_short", short), ("sheet.at_rest", still)):
        if names:
            listed = words("list_mark").join(names.values())
            yield words(key, sheet=sheet, least=least, list=listed)


def vector_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for each vector of the plan; values are left out on a task sheet.

    A length in brackets is not measured: its vector is computed.
    """
    words = drawing.words
    rows = []
    for name, segment, length, size in vectors(drawing):
        measured = in_mm(words, length)
        drawn = f"({measured})" if drawing.symbol(name) in drawing.computed else measured
        values = ("", "") if empty else (drawn, value_of(words, size, length))
        rows.append(Row((drawing.symbol(name), segment, *values), name))
    return rows


def turning_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for each angular velocity or acceleration, with its sense."""
    letter, words = drawing.rate.letter, drawing.words
    rows = []
    for link, value in turning_links(drawing):
        cells = ("", "") if empty else (words.significant(abs(value)), sense(words, value))
        rows.append(Row((drawing.symbol(f"{letter}_{link}"), *cells), turning_name(letter, link)))
    return rows


def turning_name(letter: str, link: str) -> str:
    """The name of the row of an angular velocity or acceleration."""
    return f"{letter}{link}"


def slide_name(block: str) -> str:
    """The name of the row of a block's motion along its guide."""
    return f"slide {block}"


def turning_links(drawing: Drawing) -> Iterator[tuple[str, float]]:
    """The links whose angular velocity or acceleration a sheet shows, with its value."""
    scene = drawing.scene
    for link in scene.links:
        if link in scene.unseen and link not in names_asked(scene.ask, *RATES):
            continue
        value = drawing.turning(link)
        if value is not None:
            yield link, value


def slide_rows(drawing: Drawing, *, empty: bool) -> list[Row]:
    """One row for the requested motion of each block along its guide."""
    words = drawing.words
    rows = []
    for block, name, value in slides_asked(drawing):
        cells = ("", "")
        if not empty:
            size = drawing.settled(abs(value))
            cells = (words.significant(size), slide_sense(drawing, block, value) if size else "")
        rows.append(Row((name, *cells), slide_name(block)))
    return rows


def slides_asked(drawing: Drawing) -> Iterator[tuple[str, str, float]]:
    """The requested motions of blocks on this sheet: block, symbol, and value along the guide."""
    what, letter = drawing.sliding.target, drawing.sliding.letter
    for block in drawing.scene.ask.slides:
        value = drawing.trace.value(what, block)
        if value is not None:
            on = drawing.scene.links[block].slides[0].on
            yield block, f"*{letter}*_{{{escape(block)}/{escape(on)}}}", float(value)


def slide_sense(drawing: Drawing, block: str, value: float) -> str:
    """The words for the sense of a motion along a guide."""
    key = "forward" if value > 0 else "backward"
    return drawing.words(f"calculation.{key}", guide=way_of(drawing, block))


def tables(drawing: Drawing, rect: Rect, *, empty: bool, spare: float = 0.0) -> list[Mark]:
    """The marks of all tables: vectors in one or more blocks, then angular values, then blocks.

    ``spare`` is a height in mm that they leave free above their notes.
    """
    some = column_tables(drawing, empty=empty)
    note = reasons(drawing, [row for table in some for row in table.rows], rect)
    low = rect[3] - LEADING * len(note) - spare
    corner = drawing.paper.code if empty else 0.0
    return [*note, *laid_out(some, (*rect[:3], low), by_hand=empty, corner=corner)]


def tables_on_sheets(
    drawing: Drawing, first: Rect, others: Rect, *, empty: bool
) -> list[list[Mark]]:
    """The marks of the tables on as many sheets as they need; notes are on the last sheet."""
    some = column_tables(drawing, empty=empty)
    note = reasons(drawing, [row for table in some for row in table.rows], others)
    low = others[3] - LEADING * len(note)
    *sheets, last = on_sheets(some, first, (*others[:3], low), by_hand=empty)
    return [*sheets, [*last, *note]]


def result_tables(drawing: Drawing, *, empty: bool) -> list[CellTable]:
    """The tables of a sheet that have rows: vectors, turning of links, sliding of blocks."""
    if drawing.kind == FORCE:
        from graphkin.construction.forces.force_drawing import force_tables

        return force_tables(drawing, empty=empty)
    words = drawing.words
    symbol_head, sense_head = words("table.symbol"), words("table.sense")
    unit, turning = words(f"table.{drawing.kind}"), words(f"table.{drawing.rate.target}")
    measured = words("table.segment"), words("table.millimetres")
    every = (
        ((symbol_head, *measured, unit), vector_rows, "vectors"),
        ((symbol_head, turning, sense_head), turning_rows, "turns"),
        ((symbol_head, unit, sense_head), slide_rows, "slides"),
    )
    found = (CellTable(heads, rows(drawing, empty=empty), kind=kind) for heads, rows, kind in every)
    return [table for table in found if table.rows]


def column_tables(drawing: Drawing, *, empty: bool) -> list[ColumnTable]:
    """The tables of a sheet, as paper rules them; a key of forces has its arms, too."""
    every = result_tables(drawing, empty=empty)
    if drawing.kind == FORCE and not empty:
        from graphkin.construction.forces.force_drawing import arm_table

        every += [table] if (table := arm_table(drawing)).rows else []
    return [
        ColumnTable(
            WIDTHS[table.kind][: len(table.heads)],
            Row(table.heads),
            tuple(table.rows),
            beside=table.kind == "turns",
            numbers=tuple(i for i in NUMBERS[table.kind] if i < len(table.heads)),
            kind=table.kind,
        )
        for table in every
    ]


def reasons(drawing: Drawing, rows: Sequence[Row], rect: Rect) -> list[Mark]:
    """Notes in small print below the tables: which values are computed, and why."""
    names: dict[str, list[str]] = {}
    for row in rows:
        why = drawing.computed.get(row.cells[0])
        if why:
            names.setdefault(why, []).append(row.cells[0])
    mark, colon = drawing.words("list_mark"), drawing.words("colon")
    said = [f"{mark.join(dict.fromkeys(found))}{colon}{why}" for why, found in names.items()]
    lines = flowed(said, drawing.words("clause_mark"), rect[2] - rect[0], HEIGHT)
    first = rect[3] - LEADING * (len(lines) - 1)
    return [
        Text(rect[0], first + LEADING * i, line, "caption", HEIGHT, name=COMPUTED)
        for i, line in enumerate(lines)
    ]
