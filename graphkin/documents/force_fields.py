"""The fields of a sheet of forces: where polygons and lever lie, and what is drawn in them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import combinations, pairwise
from math import isfinite
from typing import Any, NamedTuple

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.layout import Layout, centre, line_span, points_on
from graphkin.construction.core.paper_canvas import PaperCanvas, Plot, draw_part
from graphkin.construction.core.program import Plane
from graphkin.construction.core.relation import figure
from graphkin.construction.forces.force_drawing import ForceDrawing, ForceExtents, ForceLayout
from graphkin.construction.forces.lever import LeverPole
from graphkin.construction.forces.polygon import InPolygon, PolygonStart, links_words
from graphkin.drawing.field import Field, Rect
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import LineMark, Text
from graphkin.drawing.richtext import extent, flowed, words_of
from graphkin.drawing.scale import DIGITS, Extent, preferred
from graphkin.numbers.arithmetic import larger, np, pick, smaller
from graphkin.numbers.plane import Line
from graphkin.text.errors import PageError, Problem, message

SIDE, TOP, LOW = 13.0, 13.0, 10.0
"""Room beside, above and below a polygon for its lines and labels, in mm; its caption is above."""
LEAST = 50.0
"""Least width of a field in mm, for its caption."""
LEVER = 52.0
"""The size in mm for which room is made for the lever."""
LEVER_SIDE = 16.0
"""Room around the lever in mm, for the arrows of forces."""
SMALL = 2.5
"""Height of the captions in mm."""
SPAN = 1e9
"""The most times by which a scale factor exceeds the one of the largest force on a whole field."""
ROUNDING = 1e-12
"""The share by which a preferred number may be below the least one."""


class FieldNeed(NamedTuple):
    """A field to be placed: the size of its drawing in N, or in mm where it is ``fixed``.

    Sizes are arrays for many variants.
    """

    wide: Any
    high: Any
    fixed: bool = False

    def width(self, mm: float) -> Any:
        """The width of the field at a scale in mm/N."""
        side = LEVER_SIDE if self.fixed else SIDE
        return larger(self.wide * (1 if self.fixed else mm) + 2 * side, LEAST)

    def height(self, mm: float) -> Any:
        """The height of the field at a scale in mm/N."""
        return self.high * (1 if self.fixed else mm) + (2 * LEVER_SIDE if self.fixed else TOP + LOW)


Rows = tuple[tuple[int, ...], ...]
"""The cells of each row."""


def laid_out(drawing: ForceDrawing, mechanism: Field) -> ForceDrawing:
    """The drawing with its scale factors and fields, beside the mechanism's field.

    Raises PageError where the fields have no room.
    """
    rect = drawing.paper.beside(mechanism.rect)
    boxes, lever = drawing.extents
    cells = cells_of(drawing.extents)
    kF, rows = found(cells, rect)
    fields = placed(cells, rows, rect, 1 / kF)
    polygons = {
        number: field_of(box, part, 1 / kF, (TOP - LOW) / 2)
        for (number, box), part in zip(boxes.items(), fields, strict=False)
    }
    scales = replace(drawing.scales, kF=1000 * kF)
    own = None
    if lever is not None:
        part = fields[-1]
        room = part[2] - part[0] - 2 * LEVER_SIDE, part[3] - part[1] - 2 * LEVER_SIDE
        sizes = (lever.width / room[0], lever.height / room[1])
        k = next(preferred(max(sizes), DIGITS))
        own = field_of(lever, part, 1 / k, 2.0)
        scales = replace(scales, k_lever=1000 * k)
    found_at = ForceLayout(mechanism, Field(rect, 1.0, 0j, centre(rect)), {}, polygons, own)
    fixed = replace(drawing, scales=scales, fields=found_at)
    return replace(fixed, fields=replace(found_at, spans=spans_of(fixed)))


def cells_of(extents: ForceExtents) -> list[FieldNeed]:
    """The needs of polygons and lever; arrays where the extents are those of many variants."""
    cells = [FieldNeed(box.width, box.height) for box in extents.polygons.values()]
    lever = extents.lever
    if lever is not None:
        size = larger(lever.width, lever.height)
        whole = LEVER / pick(size == 0, 1.0, size)
        cells.append(FieldNeed(lever.width * whole, lever.height * whole, fixed=True))
    return cells


def field_of(box: Extent, rect: Rect, mm: float, lower: float) -> Field:
    """The field of a drawing in the middle of a rectangle, ``lower`` by some mm."""
    x, y = centre(rect)
    return Field(rect, mm, box.middle, (x, y + lower))


def found(cells: Sequence[FieldNeed], rect: Rect) -> tuple[float, Rows]:
    """The smallest preferred kF in N/mm at which all cells have room, and their rows.

    Raises PageError where they have none.
    """
    wide, high = rect[2] - rect[0], rect[3] - rect[1]
    kF = float(smallest(cells, np.array([wide]), high)[0])
    if isfinite(kF):
        return kF, max(
            arrangements(len(cells)), key=lambda rows: slack(cells, rows, wide, high, 1 / kF)
        )
    raise PageError(
        Problem(
            "sheet",
            message(
                "does not fit: {count} polygons of forces beside the mechanism", count=len(cells)
            ),
            message("a smaller mechanism"),
            message("write a larger scale under [sheet]"),
        )
    )


def smallest(cells: Sequence[FieldNeed], wide: Any, high: float) -> Any:
    """The smallest preferred kF in N/mm of many variants; NaN where the cells have no room.

    The needs of cells, and the widths for them, are arrays.
    """
    sizes = [larger(cell.wide, cell.high) for cell in cells if not cell.fixed]
    largest = np.broadcast_to(reduce(larger, sizes, 0.0), np.shape(wide))
    least = np.where(largest > 0, largest / high, 1.0)
    kF, waiting = np.full(np.shape(wide), np.nan), np.isfinite(least)
    most = SPAN * max(least[waiting], default=0.0)
    for each in preferred(min(least[waiting], default=1.0), DIGITS):
        if each > most or not waiting.any():
            return kF
        free = (slack(cells, rows, wide, high, 1 / each) for rows in arrangements(len(cells)))
        fits = waiting & (each >= least * (1 - ROUNDING)) & (reduce(larger, free) >= 0)
        kF[fits] = each
        waiting = waiting & ~fits
    return kF


def slack(cells: Sequence[FieldNeed], rows: Rows, wide: Any, high: float, mm: float) -> Any:
    """The least share of free room of an arrangement; negative where it does not fit."""
    across = [1 - sum(cells[i].width(mm) for i in row) / wide for row in rows]
    heights = (reduce(larger, (cells[i].height(mm) for i in row)) for row in rows)
    return reduce(smaller, across, 1 - sum(heights) / high)


def arrangements(count: int) -> Iterator[Rows]:
    """The ways to put cells in order into at most three rows."""
    for rows in range(1, min(3, count) + 1):
        for cuts in combinations(range(1, count), rows - 1):
            yield tuple(tuple(range(a, b)) for a, b in pairwise((0, *cuts, count)))


def placed(cells: Sequence[FieldNeed], rows: Rows, rect: Rect, mm: float) -> list[Rect]:
    """The rectangle of each cell; rows and cells share the free room in equal parts."""
    left, top, right, low = rect
    heights = [max(cells[i].height(mm) for i in row) for row in rows]
    more = (low - top - sum(heights)) / len(rows)
    fields: list[Rect] = []
    y = top
    for row, height in zip(rows, heights, strict=True):
        widths = [cells[i].width(mm) for i in row]
        spare = (right - left - sum(widths)) / len(row)
        x = left
        for width in widths:
            fields.append((x, y, x + width + spare, y + height + more))
            x += width + spare
        y += height + more
    return fields


def spans_of(drawing: ForceDrawing) -> Mapping[int, tuple[float, float]]:
    """The drawn part of each line of a polygon, in mm."""
    return {
        number: line_span(value, points_on(drawing, number), 1000 / drawing.scales.kF)
        for number, _, value in drawing.steps(Plane.FORCES)
        if isinstance(value, Line)
    }


# --- drawing in them -----------------------------------------------------------------------------


def draw_fields(board: FieldContent, drawing: Drawing, layout: Layout, view: str) -> None:
    """Draw the polygons and the lever with their captions; a task has their starts alone."""
    assert isinstance(drawing, ForceDrawing) and isinstance(layout, ForceLayout)
    starts = {each.polygon: each for each in constructions(drawing.trace.program, PolygonStart)}
    for number, own in layout.polygons.items():
        caption(board, own.rect, title_of(drawing, starts[number]))
    if layout.lever is not None:
        k = ". . . . ." if view == "task" else figure(drawing, drawing.scales.k_lever / 1000)
        caption(board, layout.lever.rect, drawing.words("page.lever_heading", k=k))
    for number, step, _ in drawing.steps(Plane.FORCES, Plane.LEVER):
        kind = construction(step)
        field: Field | None = layout.lever
        if isinstance(kind, InPolygon):
            field = layout.polygons[kind.polygon]
        if kind is None or field is None:
            continue
        if view == "task" and not isinstance(kind, PolygonStart | LeverPole):
            continue
        draw_part(PaperCanvas(Plot(board, field, drawing, layout), number), kind)
    board.marks += dividers([each.rect for each in rects_of(layout)], board.rect)


def rects_of(layout: ForceLayout) -> list[Field]:
    """All fields of polygons and lever."""
    return [*layout.polygons.values(), *([layout.lever] if layout.lever is not None else [])]


def title_of(drawing: ForceDrawing, start: PolygonStart) -> str:
    """The caption of a polygon: its number, and its links."""
    kind = f" ({start.kind})" if start.kind.isupper() else ""
    links = links_words(drawing, start.links)
    return drawing.words("page.polygon_heading", n=str(start.polygon), links=links + kind)


def caption(board: FieldContent, rect: Rect, said: str) -> None:
    """The caption of a field, at its upper left corner, in as many lines as it needs."""
    x, y = rect[0] + 3, rect[1] + 5
    for line in flowed(words_of(said), "", rect[2] - x - 1, SMALL):
        board.marks.append(Text(x, y, line, "caption", SMALL, name="field-caption"))
        board.taken.append((x - 1, y - 3.5, x + extent(line, SMALL)[0] + 1, y + 1.5))
        y += 1.4 * SMALL


def dividers(rects: Sequence[Rect], whole: Rect) -> Iterator[LineMark]:
    """The lines between fields."""
    for left, top, right, low in rects:
        if right < whole[2] - 1:
            yield LineMark(right, top + 2, right, low - 2, "panel", "field-border")
        if low < whole[3] - 1:
            yield LineMark(left + 2, low, right - 2, low, "panel", "field-border")
