"""The fields of a sheet of forces: where polygons and lever lie, and what is drawn in them.

The sheet of forces of a mechanism, verified before it is drawn.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import combinations, pairwise
from math import isfinite
from typing import Any, NamedTuple

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.layout import Layout, centre, line_span, mechanism_field, points_on
from graphkin.construction.core.paper_canvas import PaperCanvas, Plot, draw_part
from graphkin.construction.core.program import Part, Plane, Target
from graphkin.construction.core.quantities import FORCE, SHEETS
from graphkin.construction.core.relation import figure
from graphkin.construction.core.run import Trace, run
from graphkin.construction.core.solution import UNPROVED, ForceSolution
from graphkin.construction.forces.force_drawing import ForceDrawing, ForceExtents, ForceLayout
from graphkin.construction.forces.force_plan import undrawn
from graphkin.construction.forces.lever import LeverPole
from graphkin.construction.forces.loads import AppliedForce
from graphkin.construction.forces.polygon import PolygonStart, links_words
from graphkin.documents.scaling import curves_drawn, drawing, targets_of
from graphkin.drawing.field import Field, Rect
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import LineMark, Text
from graphkin.drawing.richtext import extent, flowed, words_of
from graphkin.drawing.scale import DIGITS, Extent, Scales, preferred
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT, larger, np, pick, smaller
from graphkin.numbers.plane import Line
from graphkin.scene.model import joined_words, link_words
from graphkin.scene.quantity import LENGTHS, force_in
from graphkin.structure.groups import Group
from graphkin.text import words
from graphkin.text.errors import PageError, Problem, StructureError, WitnessError, message

SIDE, TOP, LOW = 13.0, 13.0, 10.0
"""Room beside, above and below a polygon for its lines and labels, in mm; its caption is above."""
LEAST, NARROW = 50.0, 40.0
"""Least width of a field in mm, for its caption; and where the fields have no room otherwise."""
LEVER, LOW_LEVER = 52.0, 30.0
"""The size in mm for which room is made for the lever, likewise."""
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
    least: float = LEAST

    @property
    def narrow(self) -> FieldNeed:
        """The same where fields have no room otherwise: less for captions and for the lever."""
        share = LOW_LEVER / LEVER if self.fixed else 1.0
        return FieldNeed(self.wide * share, self.high * share, self.fixed, NARROW)

    def width(self, mm: float) -> Any:
        """The width of the field at a scale in mm/N."""
        side = LEVER_SIDE if self.fixed else SIDE
        return larger(self.wide * (1 if self.fixed else mm) + 2 * side, self.least)

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
    kF, cells, rows = found(cells_of(drawing.extents), rect)
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


def found(cells: Sequence[FieldNeed], rect: Rect) -> tuple[float, Sequence[FieldNeed], Rows]:
    """The smallest preferred kF in N/mm at which all cells have room; the cells, and their rows.

    Raises PageError where they have none.
    """
    wide, high = rect[2] - rect[0], rect[3] - rect[1]
    for some in (cells, [each.narrow for each in cells]):
        kF = float(of_cells(some, np.array([wide]), high)[0])
        if isfinite(kF):
            every = arrangements(len(some))
            return kF, some, max(every, key=lambda rows: slack(some, rows, wide, high, 1 / kF))
    raise PageError.at(
        "sheet",
        message("does not fit: {count} polygons of forces beside the mechanism", count=len(cells)),
        message("a smaller mechanism"),
        message("write a larger scale under [sheet]"),
    )


def smallest(cells: Sequence[FieldNeed], wide: Any, high: float) -> Any:
    """The smallest preferred kF in N/mm of many variants; NaN where the cells have no room.

    The needs of cells, and the widths for them, are arrays. Cells are narrow where they must be.
    """
    kF = of_cells(cells, wide, high)
    if np.isfinite(kF).all():
        return kF
    return np.where(np.isfinite(kF), kF, of_cells([e.narrow for e in cells], wide, high))


def of_cells(cells: Sequence[FieldNeed], wide: Any, high: float) -> Any:
    """The smallest preferred kF at which cells have room as they are."""
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
        k = figure(drawing, drawing.scales.k_lever / 1000)
        caption(board, layout.lever.rect, drawing.words("page.lever_heading", k=k))
    for number, step, _ in drawing.steps(Plane.FORCES, Plane.LEVER):
        kind = construction(step)
        if kind is None or (step.plane is Plane.LEVER and layout.lever is None):
            continue
        if view == "task" and not isinstance(kind, PolygonStart | LeverPole):
            continue
        plot = Plot(board, layout.field(step), drawing, layout)
        draw_part(PaperCanvas(plot, number), kind)
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


HELD = 1e-9
"""Difference, as a share of the largest force, up to which two routes agree."""


def force_drawing(mechanism: Mechanism, drawings: Sequence[Drawing]) -> ForceDrawing:
    """The drawing of the forces, with the mechanism at its place on the other sheets.

    Raises as ``proved_forces`` does.
    """
    drawing = proved_forces(mechanism, drawings[0])
    return laid_out(drawing, drawings[0].stand or mechanism_field(drawings))


def proved_forces(mechanism: Mechanism, first: Drawing) -> ForceDrawing:
    """The drawing of the forces without its fields, in words and scales of another drawing.

    Raises StructureError for forces that equilibrium does not determine, and for a group whose
    forces are not drawn yet, and WitnessError where the polygons, the equations of equilibrium and
    the lever disagree.
    """
    by_forces = mechanism.forces()
    assert by_forces is not None
    group = undrawn(mechanism.scene, mechanism.laid[0])
    if group is not None:
        raise StructureError(not_drawn(group))
    found, verdict = by_forces
    drawing = unplaced(mechanism, first)
    worst = max(verdict.largest_difference, abs(verdict.power), *differences(drawing, found))
    if worst > HELD:
        raise WitnessError.at(
            "loads",
            message(
                "polygons and equations of equilibrium differ by {difference}",
                difference=f"{worst:.1e}",
            ),
            message("at most {limit:.1e}", limit=HELD),
            message("no sheet is handed out"),
        )
    return replace(drawing, verdict=replace(first.verdict, largest_difference=worst))


def unplaced(mechanism: Mechanism, first: Drawing) -> ForceDrawing:
    """The drawing of the forces without its fields, not proved."""
    own = FORCE, mechanism.scene, traced(mechanism), first.scales, first.verdict, first.words
    return ForceDrawing(*own, again=True, computed={})


def force_scales(mechanism: Mechanism, chosen: Scales) -> Scales:
    """The scale factors of the sheets, ``chosen`` without forces, with those of the forces.

    Those of forces are round in the unit of results.
    """
    printed = mechanism.measured
    base, own = mechanism.scene.base, printed.scene.base
    metre, newton = float(LENGTHS[own] / LENGTHS[base]), float(force_in(own) / force_in(base))
    in_results = replace(chosen, kL=chosen.kL / metre, metre=chosen.metre * metre)
    curves = curves_drawn(printed)
    drawings = [
        drawing(printed, kind, found, in_results, UNPROVED, words("en"), curves)
        for kind in SHEETS
        if (found := targets_of(printed, kind))
    ]
    found_at = laid_out(unplaced(printed, drawings[0]), mechanism_field(drawings)).scales
    return replace(chosen, kF=found_at.kF * newton, k_lever=found_at.k_lever * metre)


def with_force_plan(
    mechanism: Mechanism, chosen: Scales
) -> tuple[Mechanism, Scales, tuple[Target, ...]]:
    """The mechanism with its plan of forces, its scale factors, and what the scene asks of both.

    Without forces that are asked and drawn, it is the mechanism as it is.
    """
    forces, whole, asked = mechanism.scene.forces, mechanism.with_forces, mechanism.asked()
    if forces is None or not forces.asked or whole is mechanism:
        return mechanism, chosen, asked
    return whole, force_scales(mechanism, chosen), whole.asked()


def not_drawn(group: Group) -> Problem:
    """The problem of a group whose forces are not drawn, with a hint where its numbers are."""
    first, *others = group.links
    links = joined_words(group.links) if others else link_words(first)
    return Problem(
        "loads",
        message(
            "the forces of {links} ({what}) are not drawn yet",
            links=links,
            what=group.title,
        ),
        message(
            "dyads, cylinders, cams, wheels on pivots, racks, groups of class III, driven links"
        ),
        message(
            "graphkin solve gives their numbers, checked by virtual power; the other sheets are "
            "drawn without reactions and balance in [ask]"
        ),
    )


def traced(mechanism: Mechanism) -> Trace:
    """The values of the plan of forces, and of everything that it needs."""
    scene = mechanism.scene
    program = mechanism.with_forces.program
    own = [number for number, step in enumerate(program.steps) if step.part is Part.FORCE]
    placed = [n for target, n in program.targets.items() if is_place(target)]
    return run(program, program.behind([*own, *placed]), scene.values, FLOAT)


def is_place(target: Target) -> bool:
    """Whether the drawing of the mechanism needs a target."""
    return target[0] in ("position", "axis", "guide", "track", "rolled")


def differences(drawing: ForceDrawing, found: ForceSolution) -> Iterator[float]:
    """The differences of drawn reactions from those of the solution, and of the lever's balance.

    The solution has one force on each link in a pin. That of one link on a pin of three links is
    drawn as the opposite of the force on it.
    """
    values, size = drawing.trace.values, drawing.natural
    forces = [sign * each.force for each in found.reactions for sign in (1, -1)]
    largest = max([size, *map(abs, forces)], default=0.0) or 1.0
    drawn = {
        step.of.name: values[step.of.force]
        for _, step, _ in drawing.on_mechanism
        if isinstance(step.of, AppliedForce) and step.of.look == "reaction"
    }
    for force in drawn.values():
        yield min((abs(force - each) for each in forces), default=0.0) / largest
    for each in drawing.lever_balances():
        yield each.difference(drawing) if each.size(drawing) else 0.0
