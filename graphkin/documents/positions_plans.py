"""The plans of all positions at one scale: each from its own pole, or all from one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import ceil
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import centre
from graphkin.construction.core.naming import scale_of
from graphkin.construction.core.paper_canvas import EDGE, above_foot, clipped_path
from graphkin.construction.core.quantities import FORCE
from graphkin.construction.core.relation import figure
from graphkin.construction.step_marks import bare_plan, is_point
from graphkin.documents.composing import STILL_LARGER
from graphkin.documents.diagram_numbers import calm
from graphkin.documents.positions import (
    SAMPLES,
    Position,
    PositionSet,
    at_position,
    is_whole,
    numbers_of,
    plan_rows,
)
from graphkin.documents.positions_sheet import (
    MANY,
    document,
    field_on,
    foot_line,
    framed,
    heading,
    headline,
    placed,
    places_table,
    proof,
    touching,
)
from graphkin.documents.sheet import title_of
from graphkin.drawing.field import Field, Rect, clipped
from graphkin.drawing.labels import FieldContent, Label
from graphkin.drawing.marks import (
    CircleMark,
    LineMark,
    Mark,
    Page,
    SharedLetter,
    Text,
    style_class,
)
from graphkin.drawing.richtext import extent
from graphkin.drawing.scale import Extent, Scales, extent_of, preferred
from graphkin.drawing.style import BRIEF, COMPONENTS
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import PIN
from graphkin.motion.cycle import columns_at
from graphkin.numbers.plane import Vector
from graphkin.scene.link_points import lettered

NAMES = {"velocity": "sheet.velocity_plans", "acceleration": "sheet.acceleration_plans"}
"""The keys of the names of these sheets."""
HODOGRAPHS = {"velocity": "positions.hodographs_v", "acceleration": "positions.hodographs_a"}
"""The keys of the captions of hodographs."""
SIDE, ABOVE, BELOW = 8.0, 10.0, 6.0
"""Room around a plan in its cell for letters, and above it for its number, in mm."""
SCALE = "scale"
"""The name of the scale of a plan that is drawn smaller than the others."""
GROWN, ALONE = 3.0, 1.5
"""The largest plan that decides the scale of all, in median plans, and in plans of the next size.
"""
LEAST = 28.0
"""Least width and height of a cell in mm."""
DOT, SMALL = 0.7, 0.5
"""Radius of a point of a plan, and of a numbered one, in mm."""


def plan_page(found: PositionSet, kind: str, kL: float, number: str) -> Page:
    """The sheet of the plans of one kind, which some positions have."""
    some = found.planned(kind)
    one = found.wanted.one_pole
    make = from_one_pole if one else from_own_poles
    scales, marks = make(found, some, kind, kL)
    drawing = replace(some[0].plans[kind], scales=scales)
    words = drawing.words
    name = words(NAMES[kind])
    whole: list[Mark] = [
        *heading(found, drawing, name),
        *caption(found, drawing, poles_said(marks, one=one)),
        *marks,
        *foot_line(found),
        *places_table(
            *(found, found.numbered),
            [
                *without_plan(found, kind),
                *components(drawing, marks),
                *exceptions(found, drawing, marks),
            ],
            [*plan_rows(found, kind)],
        ),
        *proof(found),
    ]
    return framed(
        drawing,
        number,
        document(drawing, kind),
        caption_scale(drawing),
        whole,
        f"{name} – {title_of(drawing)}",
    )


def caption_scale(drawing: Drawing) -> str:
    """The entry of the title block for the scale: that of the plan."""
    return scale_text(drawing, 1.0)


SCALES = {"velocity": ("v", "(m/s)/mm"), "acceleration": ("a", "(m/s^2)/mm"), FORCE: ("F", "N/mm")}
"""The index of the scale factor of each kind of plan, and its unit."""


def scale_text(drawing: Drawing, coarser: float) -> str:
    """The scale factor of a plan that is drawn some times smaller than the others."""
    k = figure(drawing, coarser * scale_of(drawing, drawing.plane) / 1000)
    return f"{k} {drawing.words.unit(SCALES[drawing.kind][1])}"


def poles_said(marks: Sequence[Mark], *, one: bool) -> str:
    """The key of what the caption says on poles: one, or many at one scale or at some."""
    if one:
        return "positions.one_pole"
    scaled = any(mark.name.startswith(f"{SCALE}_") for mark in marks)
    return "positions.own_poles_scaled" if scaled else "positions.own_poles"


def caption(found: PositionSet, drawing: Drawing, poles: str) -> Iterator[Mark]:
    """The caption of the field: the scale of the plans, and where their poles are."""
    words = drawing.words
    k = figure(drawing, scale_of(drawing, drawing.plane) / 1000)
    said = words(f"page.{drawing.kind}_heading", k=k)
    yield from headline(found, f"{said};  {words(poles)}")


def without_plan(found: PositionSet, kind: str) -> Iterator[str]:
    """What the sheet says of positions without a plan."""
    words = found.shown.alone.words
    some = {each.name for each in found.planned(kind)}
    asked = [e.name for e in found.numbered if e.plans and e.name not in some]
    yield from without(found)
    if asked:
        yield words("positions.not_asked", list=words("list_mark").join(asked))


def components(drawing: Drawing, marks: Sequence[Mark]) -> Iterator[str]:
    """The patterns of the lines of those components that the plans have."""
    drawn = {style_class(mark) for mark in marks}
    said = [kind.pattern for kind in COMPONENTS if kind.look in drawn]
    if said:
        yield drawing.words.clauses(map(drawing.words, said))


def without(found: PositionSet) -> Iterator[str]:
    """What a sheet says of positions that have no plan."""
    words = found.shown.alone.words
    if some := [each.name for each in found.numbered if not each.plans]:
        yield words("positions.without", list=words("list_mark").join(some))


def exceptions(found: PositionSet, drawing: Drawing, marks: Sequence[Mark]) -> Iterator[str]:
    """What the sheet says of vectors that are cut off."""
    left, top, right, _ = rect = field_on(found)
    edge = left + EDGE, top + EDGE, right - EDGE, above_foot(rect)[3]
    ends = [(m.x2, m.y2) for m in marks if isinstance(m, LineMark) and BRIEF in m.cls]
    if any(abs(at[i % 2] - side) < 1e-6 for at in ends for i, side in enumerate(edge)):
        yield drawing.words("positions.cut_off")


# --- the scale of all plans -----------------------------------------------------------------------


def rates(scales: Scales, kind: str) -> float:
    """Millimetres for one unit of a plan."""
    return 1000 / scales.kL * scales.metres(kind)


def fitted(found: PositionSet, kind: str, kL: float, most: float) -> Scales:
    """The scale factors of the largest plans, of at most some mm for one unit of the plan.

    With a crank the plans follow its rule; otherwise the factor is a round number.
    """
    base = found.planned(kind)[0].plans[kind].scales
    if base.of_crank:
        alone = rates(replace(base, kL=kL), kind)
        times = next(
            (m for m in sorted({*STILL_LARGER, *FINER}, reverse=True) if m * alone <= most),
            most / alone,
        )
        larger = {"larger": times} if kind == "velocity" else {"larger_still": times}
        return replace(base, kL=kL, **larger)
    factor = next(preferred(1 / most))
    seconds = kL / (1000 * factor)
    own = seconds if kind == "velocity" else seconds**0.5
    return Scales(kL, own, triangles=False)


FINER = (0.01, 0.005, 0.002, 0.001)
"""Further factors for plans with very long vectors."""


def box_of_plan(drawing: Drawing) -> Extent:
    """The box of a plan in its own unit, pole included, without auxiliary plans."""
    points, aside = [0j], drawing.auxiliary
    for number, step, value in drawing.steps(drawing.plane):
        if number in aside or step.aside is not None:
            continue
        if isinstance(value, Vector) and step.arrow:
            points += [value.tail, value.tip]
        elif is_point(step) and isinstance(value, complex):
            points.append(value)
    return extent_of(points)


# --- each plan from its own pole ------------------------------------------------------------------


class PlanGrid(Struct, frozen=True):
    """A division of a field into cells: columns, rows, and mm for one unit of the plans."""

    rect: Rect
    columns: int
    rows: int
    most: float

    @property
    def cell_size(self) -> tuple[float, float]:
        """The width and the height of a cell, in mm."""
        left, top, right, low = self.rect
        return (right - left) / self.columns, (low - top) / self.rows

    def coarser(self, box: Extent, mm: float) -> float:
        """How many times smaller a plan must be drawn than the usual ones: 1, 2, 5, 10 …"""
        wide, high = self.cell_size
        across, upright = wide - 2 * SIDE, high - ABOVE - BELOW
        return next(preferred(max(box.width * mm / across, box.height * mm / upright, 1.0)))

    def cell(self, index: int) -> Rect:
        """The cell of a plan, row by row."""
        row, column = divmod(index, self.columns)
        wide, high = self.cell_size
        left, top = self.rect[0] + column * wide, self.rect[1] + row * high
        return left, top, left + wide, top + high


def usual(boxes: Sequence[Extent]) -> list[Extent]:
    """The plans that decide the scale: not those that grow without bound next to a dead point.

    A single plan does not make all others small, either.
    """
    sizes = sorted(box.diagonal for box in boxes)
    most = GROWN * float(np.median(sizes))
    if len(sizes) > 2 and ALONE * sizes[-2] < sizes[-1]:
        most = min(most, sizes[-2])
    return [box for box in boxes if box.diagonal <= most] or list(boxes)


def grid_for(
    rect: Rect, boxes: Sequence[Extent], deciding: Sequence[Extent] | None = None
) -> PlanGrid:
    """The division in which the largest of the deciding plans is drawn largest."""
    some = boxes if deciding is None else deciding
    found = []
    for columns in range(1, len(boxes) + 1):
        rows = ceil(len(boxes) / columns)
        grid = PlanGrid(rect, columns, rows, 1.0)
        wide, high = grid.cell_size
        if min(wide, high) < LEAST:
            continue
        sides = [
            room / size
            for box in some
            for room, size in (
                (wide - 2 * SIDE, box.width),
                (high - ABOVE - BELOW, box.height),
            )
            if size > 0
        ]
        found.append(replace(grid, most=min(sides, default=1.0)))
    return max(found, key=lambda grid: grid.most)


def from_own_poles(
    found: PositionSet, some: Sequence[Position], kind: str, kL: float
) -> tuple[Scales, list[Mark]]:
    """The plans in a grid, each from its own pole with the letters of its points."""
    boxes = [box_of_plan(each.plans[kind]) for each in some]
    grid = grid_for(field_on(found), boxes, usual(boxes))
    scales = fitted(found, kind, kL, grid.most)
    plans = [replace(each.plans[kind], scales=scales) for each in some]
    mm = rates(scales, kind)
    return scales, in_cells(found, [*zip(some, plans, boxes, strict=True)], grid, mm, bare_plan)


def in_cells(
    found: PositionSet,
    plans: Sequence[tuple[Position, Drawing, Extent]],
    grid: PlanGrid,
    mm: float,
    drawn: Callable[[Any, Field], FieldContent],
) -> list[Mark]:
    """The plans of some positions in a grid, each with its number, at mm for one of their unit."""
    numbers = dict(zip((e.name for e in found.every), numbers_of(found), strict=True))
    marks: list[Mark] = [*lines(grid, len(plans))]
    for index, (each, drawing, box) in enumerate(plans):
        left, top, right, low = rect = grid.cell(index)
        middle = (left + right) / 2, (top + ABOVE + low - BELOW) / 2
        coarser = grid.coarser(box, mm)
        board = drawn(drawing, Field(rect, mm / coarser, box.middle, middle))
        board.labels = [replace(label, height=2.5) for label in board.labels]
        more = coarser_scale(drawing, coarser) if coarser > 1 else ""
        board.marks += number_of(found, each, rect, numbers[each.name], more)
        marks += (
            replace(mark, name=" ".join(at_position(n, each.name) for n in mark.name.split()))
            for mark in board.finish()
        )
    return marks


def lines(grid: PlanGrid, count: int) -> Iterator[Mark]:
    """The lines between the cells that hold a plan."""
    for index in range(count):
        left, top, right, low = grid.cell(index)
        if (index + 1) % grid.columns and index + 1 < count:
            yield LineMark(right, top + 1, right, low - 1, "panel")
        if index >= grid.columns:
            yield LineMark(left + 1, top, right - 1, top, "panel")


def coarser_scale(drawing: Drawing, coarser: float) -> str:
    """The scale factor of a plan that is drawn smaller than the others."""
    return f"*k*_{SCALES[drawing.kind][0]} = {scale_text(drawing, coarser)}"


def number_of(
    found: PositionSet, each: Position, rect: Rect, place: str, more: str
) -> Iterator[Mark]:
    """The number of a plan's position, with the place of the driver, and its own scale."""
    sweep = found.cycle.sweep
    own = "s" if sweep.driver is None else sweep.original.units["length"]
    unit = "°" if sweep.what == "turn" else f" {found.shown.alone.words.spelled(own)}"
    yield Text(rect[0] + 3, rect[1] + 6, each.name, "caption", 3.5, name="number")
    beside = rect[0] + 5 + extent(each.name, 3.5)[0]
    yield Text(beside, rect[1] + 6, f"{place}{unit}", "caption", 2.5, name="place")
    if more:
        yield Text(rect[0] + 3, rect[1] + 10.5, more, "caption", 2.5, name=SCALE)


# --- all plans from one pole ----------------------------------------------------------------------


def points_of(drawing: Drawing) -> dict[str, complex]:
    """The points of a plan by their letters, without the pole."""
    return {
        step.name: complex(value)
        for _, step, value in drawing.steps(drawing.plane)
        if is_point(step) and isinstance(value, complex) and step.name != drawing.pole
    }


def from_one_pole(
    found: PositionSet, some: Sequence[Position], kind: str, kL: float
) -> tuple[Scales, list[Mark]]:
    """The plans from one pole: the strong one whole, of the others the vectors to their points.

    The numbered tips lie on the hodographs.
    """
    strong = next((each for each in some if each.name == found.shown.name), some[0])
    points = {each.name: points_of(each.plans[kind]) for each in some}
    curves = hodographs(found, kind)
    boxes = usual([box_of_plan(each.plans[kind]) for each in some])
    box = extent_of([corner for each in boxes for corner in corners(each)])
    left, top, right, low = rect = field_on(found)
    wide, high = right - left - 4 * SIDE, low - top - 2 * ABOVE
    scales = fitted(found, kind, kL, min(wide / (box.width or 1), high / (box.height or 1)))
    field = Field(rect, rates(scales, kind), box.middle, centre(rect))
    board = FieldContent(rect)
    for name, curve in curves.items():
        on_page = [field(place) for place in curve]
        board.marks += clipped_path(on_page, rect, "trajectory", f"hodograph {name}")
    pole = field(0j)
    for each in (each for each in some if each.name != strong.name):
        for name, tip in points[each.name].items():
            if part := clipped(pole, field(tip), above_foot(rect)):
                own = f"{kind} {BRIEF}", at_position(name, each.name)
                board.marks.append(LineMark(*part[0], *part[1], *own))
    whole = bare_plan(replace(strong.plans[kind], scales=scales), field)
    board.marks += whole.marks
    pole_name = strong.plans[kind].pole
    board.labels += [numbered(label, strong.name, pole_name) for label in whole.labels]
    height = 1.8 if len(some) >= MANY else 2.5
    others = [each for each in some if each.name != strong.name]
    numbers: list[Label] = []
    for name in points[strong.name]:
        pins = [
            (e, field(points[e.name][name]))
            for e in others
            if name in points[e.name] and field.holds(points[e.name][name], EDGE)
        ]
        look = f"point {kind}"
        board.marks += [CircleMark(*at, SMALL, look, at_position(name, e.name)) for e, at in pins]
        for group in touching(pins, 2 * DOT):
            each, at = group[len(group) // 2]
            text = ", ".join(e.name for e, _ in group)
            named = " ".join(at_position(name, e.name) for e, _ in group)
            away = way(pole, at)
            numbers.append(Label(text, kind, at, height, named, away=away, radius=SMALL))
    letters = [*placed(board, [], board.labels)]
    return scales, [*board.marks, *letters, *placed(board, letters, numbers)]


def corners(box: Extent) -> tuple[complex, complex]:
    return complex(box.left, box.bottom), complex(box.right, box.top)


def numbered(label: Label, number: str, pole: str) -> Label:
    """The label of the strong plan's points with their number; the pole has none."""
    letters = tuple(
        each
        if each.name == pole
        else SharedLetter(name := at_position(each.name, number), symbol(name), each.joint)
        for each in label.letters
    )
    return replace(label.of_letters(letters), priority=3)


def way(start: tuple[float, float], end: tuple[float, float]) -> tuple[float, float] | None:
    """The unit direction from one place to another; None if they are one."""
    far = ((end[0] - start[0]) ** 2 + (end[1] - start[1]) ** 2) ** 0.5
    return None if far < DOT else ((end[0] - start[0]) / far, (end[1] - start[1]) / far)


def hodographs(found: PositionSet, kind: str) -> dict[str, tuple[complex, ...]]:
    """The hodographs of the asked points: the tips of their vectors from one pole.

    A vector that keeps its line has none. Where all asked ones do, the other points of the plan are
    drawn, without those whose vectors keep their length.
    """
    asked = getattr(found.cycle.scene.ask, kind)
    known = found.cycle.path.ranges[0][0].course.program.targets
    targets = [(own, name) for own, name in known if own == kind]
    at = [each.at for each in found.planned(kind)]
    low, high = found.cycle.ranges[0] if is_whole(found.cycle) else (min(at), max(at))
    some = np.linspace(low, high, 2 * SAMPLES + 1)
    columns = columns_at(found.cycle.sweep, found.cycle.path, some, targets).columns
    rows = {name: row[np.isfinite(row)] for (_, name), row in columns.items()}
    turning = {name: row for name, row in rows.items() if leaves_its_line(row)}
    chosen = [name for name in asked if name in turning] or [
        name for name, row in turning.items() if np.ptp(np.abs(row)) > SEEN * np.max(np.abs(row))
    ]
    return {name: tuple(map(complex, turning[name])) for name in chosen}


SEEN = 0.01
"""The share of the largest vector that is seen on a hodograph."""


def leaves_its_line(tips: NDArray[np.complex128]) -> bool:
    """Whether vectors from one pole point along more than one line."""
    if not tips.size:
        return False
    largest = tips[np.argmax(np.abs(tips))]
    return bool(np.max(np.abs((tips * largest.conjugate()).imag)) > SEEN * abs(largest) ** 2)


# --- the hodograph of each asked point ------------------------------------------------------------


def hodograph_page(found: PositionSet, kind: str, kL: float, number: str) -> Page:
    """The hodographs of the asked points for one kind of vector, each from its own pole."""
    some, curves = found.planned(kind), hodographs(found, kind)
    tips = {
        point: [(each, complex(each.plans[kind].trace.value(kind, point))) for each in some]
        for point in curves
    }
    for point, curve in curves.items():
        most = calm(found, np.array(curve))
        tips[point] = [(each, tip) for each, tip in tips[point] if abs(tip) <= most]
        curves[point] = tuple(tip for tip in curve if abs(tip) <= most)
    boxes = [extent_of([0j, *curves[point], *(z for _, z in tips[point])]) for point in curves]
    grid = grid_for(field_on(found), boxes)
    scales = fitted(found, kind, kL, grid.most)
    drawing = replace(some[0].plans[kind], scales=scales)
    words = drawing.words
    marks: list[Mark] = [*lines(grid, len(curves))]
    for index, ((point, curve), box) in enumerate(zip(curves.items(), boxes, strict=True)):
        left, top, right, low = rect = grid.cell(index)
        middle = (left + right) / 2, (top + ABOVE + low - BELOW) / 2
        field = Field(rect, rates(scales, kind), box.middle, middle)
        marks += hodograph(drawing, field, point, curve, tips[point])
    name = words("sheet.hodographs")
    whole: list[Mark] = [
        *heading(found, drawing, name),
        *hodograph_caption(found, drawing),
        *marks,
        *foot_line(found),
        *places_table(found, found.numbered, []),
        *proof(found),
    ]
    title = f"{name} – {title_of(drawing)}"
    return framed(drawing, number, name, caption_scale(drawing), whole, title)


def hodograph_caption(found: PositionSet, drawing: Drawing) -> Iterator[Mark]:
    """The caption of the field: the scale of the vectors."""
    k = figure(drawing, scale_of(drawing, drawing.plane) / 1000)
    said = drawing.words(HODOGRAPHS[drawing.kind], k=k)
    yield from headline(found, said)


def hodograph(
    drawing: Drawing,
    field: Field,
    point: str,
    curve: Sequence[complex],
    tips: Sequence[tuple[Position, complex]],
) -> Iterator[Mark]:
    """The hodograph of one point: the curve, the vectors from the pole, numbers at their tips."""
    kind, letter = drawing.kind, drawing.vector.letter
    board = FieldContent(field.rect)
    on_page = [field(place) for place in curve]
    board.marks += clipped_path(on_page, field.rect, "trajectory", f"hodograph {point}")
    pole, pins = field(0j), [(each, field(tip)) for each, tip in tips]
    for each, at in pins:
        name = at_position(f"{letter}_{lettered(point)}", each.name)
        board.marks.append(LineMark(*pole, *at, f"{kind} {BRIEF}", name))
        board.marks.append(CircleMark(*at, SMALL, f"point {kind}", name))
    board.marks.append(CircleMark(*pole, PIN, f"pole {kind}", f"pole {point}"))
    head = symbol(f"{letter}_{lettered(point)}")
    board.marks.append(
        Text(field.rect[0] + 3, field.rect[1] + 6, head, "caption", 3.5, name=f"hodograph {point}")
    )
    numbers = [
        Label(
            ", ".join(each.name for each, _ in group),
            kind,
            group[len(group) // 2][1],
            1.8 if len(tips) >= MANY else 2.5,
            " ".join(at_position(f"{letter}_{lettered(point)}", each.name) for each, _ in group),
            away=way(pole, group[len(group) // 2][1]),
            radius=SMALL,
        )
        for group in touching(pins, 2 * DOT)
    ]
    yield from board.marks
    yield from placed(board, [], numbers)
