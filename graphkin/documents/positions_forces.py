"""The forces of all positions: each polygon in a sheet of its own, all at one scale, and a table.

Each position has its plan of forces constructed, and checked by the equations of equilibrium.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import ceil, degrees

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.paper_canvas import PaperCanvas, Plot, draw_part
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import (
    BALANCING_MOMENT,
    BY_TARGET,
    FORCE,
    FORCES,
)
from graphkin.construction.core.relation import figure
from graphkin.construction.forces.force_drawing import ForceDrawing, ForceLayout
from graphkin.construction.forces.loads import ByTable, is_asked
from graphkin.construction.forces.polygon import InPolygon, PolygonStart
from graphkin.construction.step_marks import Free, is_shown
from graphkin.documents.force_fields import proved_forces, title_of
from graphkin.documents.positions import Position, PositionSet, ValueRow
from graphkin.documents.positions_plans import (
    SCALE,
    PlanGrid,
    caption_scale,
    grid_for,
    in_cells,
    usual,
    without,
)
from graphkin.documents.positions_sheet import (
    document,
    field_on,
    foot_line,
    framed,
    heading,
    headline,
    places_table,
    proof,
)
from graphkin.documents.sheet import title_of as title_of_mechanism
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import LineMark, Mark, Page, Text, box
from graphkin.drawing.richtext import extent
from graphkin.drawing.scale import DIGITS, Extent, preferred
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbol_markup import symbol
from graphkin.motion.driving import TURN

ROW, FIRST, WIDTH, GAP = 6.5, 24.0, 26.0, 8.0
"""Height of a row of the table, widths of its number and of a value, and a gap, in mm."""
LETTERS, BASE = 3.5, 4.6
"""Height of its letters, and of their base line below the top of a row, in mm."""


class ForcedPosition(Struct, frozen=True):
    """A position with the plan of its forces."""

    position: Position
    drawing: ForceDrawing


class Polygons(Struct, frozen=True):
    """One polygon in all positions that have it, with its boxes and their grid."""

    number: int
    some: tuple[ForcedPosition, ...]
    boxes: tuple[Extent, ...]
    grid: PlanGrid


def force_pages(found: PositionSet) -> Iterator[Callable[[str], Page]]:
    """The sheets of the polygons, then that of the asked forces, each waiting for its number.

    Raises as ``proved_forces`` does.
    """
    every = [*forced(found)]
    if not every:
        return
    sheets = [*polygons_of(found, every)]
    if sheets:
        kF = next(preferred(1 / min(each.grid.most for each in sheets), DIGITS))
        for each in sheets:
            yield partial(polygon_page, found, each, kF)
    for rows in parts(found, every):
        yield partial(table_page, found, every, rows)


def forced(found: PositionSet) -> Iterator[ForcedPosition]:
    """The positions that have plans, with the plan of their forces."""
    for each in found.numbered:
        for plan in [*each.plans.values()][:1]:
            mechanism = found.cycle.mechanism_at(each.at)
            yield ForcedPosition(each, proved_forces(mechanism, plan))


def worst(every: Sequence[ForcedPosition]) -> float:
    """The largest difference of polygons, equations of equilibrium and levers."""
    return max(each.drawing.verdict.largest_difference for each in every)


# --- polygons ------------------------------------------------------------------------------------


def polygons_of(found: PositionSet, every: Sequence[ForcedPosition]) -> Iterator[Polygons]:
    """Each polygon of the plans in order, with the positions where it has a size."""
    for number in sorted({n for each in every for n in each.drawing.extents.polygons}):
        own = [e for e in every if number in e.drawing.extents.polygons]
        boxes = [each.drawing.extents.polygons[number] for each in own]
        if any(each.diagonal for each in boxes):
            grid = grid_for(field_on(found), boxes, usual(boxes))
            yield Polygons(number, tuple(own), tuple(boxes), grid)


def polygon_page(found: PositionSet, sheet: Polygons, kF: float, number: str) -> Page:
    """The sheet of one polygon in all positions, at kF in N/mm."""
    drawings = [
        replace(each.drawing, scales=replace(each.drawing.scales, kF=1000 * kF))
        for each in sheet.some
    ]
    plans = zip((each.position for each in sheet.some), drawings, sheet.boxes, strict=True)
    marks = in_cells(found, [*plans], sheet.grid, 1 / kF, partial(bare_polygon, sheet.number))
    drawing, words = drawings[0], drawings[0].words
    name = words("sheet.force_plans")
    starts = constructions(drawing.trace.program, PolygonStart)
    start = next(each for each in starts if each.polygon == sheet.number)
    scaled = any(mark.name.startswith(f"{SCALE}_") for mark in marks)
    poles = words("positions.own_starts_scaled" if scaled else "positions.own_starts")
    said = words("page.force_heading", k=figure(drawing, kF))
    whole: list[Mark] = [
        *heading(found, drawing, name),
        *headline(found, f"{title_of(drawing, start)};  {said};  {poles}"),
        *marks,
        *foot_line(found),
        *places_table(found, found.numbered, [*without(found)]),
        *proof(found, "page.forces_verified", worst(sheet.some)),
    ]
    title = f"{name} – {title_of_mechanism(drawing)}"
    return framed(drawing, number, document(drawing, FORCE), caption_scale(drawing), whole, title)


def bare_polygon(polygon: int, drawing: ForceDrawing, field: Field) -> FieldContent:
    """The sides of a polygon in a field with their letters, without the lines that close it."""
    board = FieldContent(field.rect)
    plot = Plot(board, field, drawing, ForceLayout(field, field, Free(), {polygon: field}))
    for number, step, _ in drawing.steps(Plane.FORCES):
        kind = construction(step)
        if isinstance(kind, InPolygon) and kind.polygon == polygon:
            draw_part(PaperCanvas(plot, number), kind)
    board.marks = [mark for mark in board.marks if is_shown(drawing, mark)]
    board.labels = [label for label in board.labels if label.cls in VECTORS]
    board.notes = []
    return board


# --- the table -----------------------------------------------------------------------------------


def value_rows(every: Sequence[ForcedPosition]) -> Iterator[ValueRow]:
    """The loads of tables, the asked forces by size and direction, the balancing moments."""
    first = every[0].drawing
    given = first.scene.forces
    assert given is not None
    for table in constructions(first.trace.program, ByTable):
        loads = [each.drawing.by_table[table.name] for each in every]
        yield ValueRow(f"{symbol(table.name)} ({first.words.unit(table.unit)})", loads)
    asked = [t for t in first.trace.program.targets if is_asked(first.scene, given, t)]
    for target in sorted(asked, key=lambda each: FORCES.index(BY_TARGET[each[0]])):
        quantity, name = BY_TARGET[target[0]], first.symbol(target[1])
        values = [each.drawing.trace.value(*target) for each in every]
        sizes = [sized(*each) for each in zip(every, values, strict=True)]
        yield ValueRow(f"{name} ({first.words.unit(quantity.unit)})", sizes)
        if quantity is not BALANCING_MOMENT:
            ways = [
                round(degrees(phase(value)), 6) % TURN if value is not None and size else None
                for value, size in zip(values, sizes, strict=True)
            ]
            yield ValueRow(f"∠{name} (°)", ways)


def sized(each: ForcedPosition, value: complex | float | None) -> float | None:
    """The magnitude of a force, or a moment with its sign; zero for rounding."""
    drawing = each.drawing
    if value is None:
        return None
    if isinstance(value, complex):
        return drawing.settled(abs(value))
    return float(value) if drawing.settled(abs(value) / drawing.reach) else 0.0


def parts(found: PositionSet, every: Sequence[ForcedPosition]) -> Iterator[tuple[ValueRow, ...]]:
    """The rows of values for each sheet of the table: as many as have room beside one another."""
    left, _, right, _ = field_on(found)
    blocks = ceil(len(every) / most_rows(found))
    per = max(int(((right - left) / blocks - FIRST - 2 * GAP) / WIDTH), 1)
    rows = [*value_rows(every)]
    for i in range(0, len(rows), per):
        yield tuple(rows[i : i + per])


def most_rows(found: PositionSet) -> int:
    """The most positions below one another in the table."""
    _, top, _, low = field_on(found)
    return int((low - top - 4 * GAP) / ROW) - 1


def table_page(
    found: PositionSet, every: Sequence[ForcedPosition], rows: Sequence[ValueRow], number: str
) -> Page:
    """The sheet with the table of the asked forces by position."""
    drawing, words = every[0].drawing, every[0].drawing.words
    name = words("sheet.force_table")
    whole: list[Mark] = [
        *heading(found, drawing, name),
        *headline(found, words("positions.force_signs")),
        *force_table(found, every, rows),
        *foot_line(found),
        *places_table(found, found.numbered, [*without(found)]),
        *proof(found, "page.forces_verified", worst(every)),
    ]
    title = f"{name} – {title_of_mechanism(drawing)}"
    return framed(drawing, number, document(drawing, FORCE), "–", whole, title)


def force_table(
    found: PositionSet, every: Sequence[ForcedPosition], rows: Sequence[ValueRow]
) -> Iterator[Mark]:
    """The asked forces in columns, a row for each position, in as many blocks as it takes."""
    words, most = found.shown.alone.words, most_rows(found)
    left, top, _, _ = field_on(found)
    numbers = [each.position.name for each in every]
    columns: list[tuple[str, list[str], float]] = [(words("positions.number"), numbers, FIRST)]
    for row in rows:
        columns.append((row.head, row.written(words, 4), WIDTH))
    whole = sum(width for *_, width in columns)
    for block, begin in enumerate(range(0, len(every), most)):
        x, y = left + GAP + block * (whole + GAP), top + 2 * GAP
        some = slice(begin, begin + most)
        low = y + ROW * (len(columns[0][1][some]) + 1)
        yield box(x, y, whole, ROW, "shade")
        for i in range(len(columns[0][1][some]) + 2):
            yield LineMark(x, y + i * ROW, x + whole, y + i * ROW, "panel")
        yield LineMark(x, y, x, low, "panel")
        for head, texts, width in columns:
            for i, text in enumerate((head, *texts[some])):
                height = min(LETTERS, LETTERS * (width - 2) / extent(text, LETTERS)[0])
                yield Text(
                    x + width / 2, y + i * ROW + BASE, text, "table", height, "middle", "forces"
                )
            x += width
            yield LineMark(x, y, x, low, "panel")
