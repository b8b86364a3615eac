"""The place of the drawings on a sheet, and the drawn length of construction lines and arcs."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import reduce
from math import degrees
from typing import Any, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import JoinsPoints, construction
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.drawing.field import ABOVE, LEAST_FIELD, MARGIN, Field, Rect, SheetPaper
from graphkin.drawing.scale import Extent
from graphkin.numbers.arithmetic import Point, Real, larger, pick, smaller
from graphkin.numbers.plane import Circle, Line, Ratio
from graphkin.text.errors import PageError, message

BEYOND = 7.0
"""How far a construction line is drawn beyond the last point on it, in mm."""
POLES = 1.4 * MARGIN
"""Margin for centres and poles, both sides together, in mm."""
SPARE = 40.0
"""Surplus width in mm that the plan's field keeps before it shares with the mechanism's field."""
GROUND = 15.0
"""Room below a mechanism for the ground of its pivots and one line of notes, in mm."""
FAR = 100.0
"""A place this many mechanism sizes away lies beyond the edge of every field."""
SWEEP = 7.0
"""Half the length of a drawn compass arc, in mm."""

Spans = Mapping[int, tuple[float, float]]


class Layout(Struct, frozen=True):
    """The two fields, and the drawn part of each line (mm from its anchor) or arc (degrees)."""

    mechanism: Field
    plan: Field
    spans: Spans

    def field(self, step: Step) -> Field:
        """The field in which a step is drawn."""
        return self.mechanism if step.plane is Plane.MECHANISM else self.plan


def lay_out(drawing: Drawing) -> Layout:
    """Mechanism and plan side by side, with the mechanism where it is on all sheets."""
    if drawing.fields is not None:
        own: Layout = drawing.fields
        return own
    mechanism = drawing.stand or mechanism_field([drawing])
    rect = drawing.paper.beside(mechanism.rect)
    metres, plan = drawing.scales.metres(drawing.kind), drawing.plan_extent()
    mm = mechanism.mm * metres
    fields = Layout(mechanism, Field(rect, mm, plan.middle / metres, centre(rect)), {})
    return Layout(fields.mechanism, fields.plan, spans(drawing, fields))


def mechanism_field(drawings: Sequence[Drawing]) -> Field:
    """The field of the mechanism on all its sheets, with poles and centres where there is room.

    The field is as wide as necessary. The plans have the rest, as long as it is not much wider than
    they need. Raises PageError where the plans lack room.
    """
    mm = 1000 / drawings[0].scales.kL
    box = reduce(Extent.joined, (each.mechanism_extent() for each in drawings))
    plan = max(each.plan_extent().width for each in drawings) * mm
    paper = drawings[0].paper
    refuse_wide(paper, box.width * mm, plan)
    poles = (place for each in drawings for place in poles_of(each))
    held = held_beside(paper, box, poles, mm, plan)
    left, top, _, low = paper.fields
    rect = (left, top, left + held.width, low)
    return Field(rect, mm, held.box.middle, raised(paper, rect, held.box.height * mm))


class Held(NamedTuple):
    """The bounding box of a mechanism's field, with its poles and centres, and its width (mm)."""

    box: Extent
    width: Real


def held_beside(
    paper: SheetPaper, box: Extent, poles: Iterable[Point], mm: Real, plan: Real
) -> Held:
    """The contents of a mechanism's field next to a plan of width ``plan`` (mm).

    The numbers may be arrays with one entry for each sheet.
    """
    if paper.is_parted:
        own = paper.left[2] - paper.left[0]
        return Held(with_poles(paper, box, poles, mm, own), own)
    whole = paper.fields[2] - paper.fields[0]
    most = larger(whole - larger(plan + 2 * MARGIN, LEAST_FIELD), LEAST_FIELD)
    wider = with_poles(paper, box, poles, mm, most)
    needed = larger(box.width * mm + 2 * MARGIN, wider.width * mm + POLES)
    width = smaller(larger(needed, LEAST_FIELD), most)
    return Held(wider, width + larger(most - width - SPARE, 0.0) / 2)


def with_poles(
    paper: SheetPaper, box: Extent, poles: Iterable[Point], mm: Real, width: Real
) -> Extent:
    """The box of the mechanism, grown by each centre and pole for which the field has room."""
    across, upright = width - POLES, paper.upright + 2 * ABOVE - POLES
    for pole in poles:
        grown = box.about(pole)
        fits = (grown.width * mm <= across) & (grown.height * mm <= upright)
        sides = zip(grown.sides, box.sides, strict=True)
        box = Extent(*(pick(fits, new, old) for new, old in sides))
    return box


def refuse_wide(paper: SheetPaper, mechanism: float, plan: float) -> None:
    """Raise PageError where a sheet is too narrow for both drawings; widths in mm."""
    spare = paper.room_beside(mechanism) - plan
    if spare < -1e-6:
        raise PageError.at(
            "sheet",
            message(
                "does not fit: the drawings are {spare:.0f} mm wider than the sheet", spare=-spare
            ),
            message("a larger kL"),
            message("leave [sheet] scale out, or give a larger number"),
        )


def centre(rect: Rect) -> tuple[float, float]:
    return (rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2


def raised(paper: SheetPaper, rect: Rect, height: float) -> tuple[float, float]:
    """The middle of a drawing in a field, with the room below that its foot needs."""
    return centre(rect)[0], rect[3] - room_below(paper, height) - height / 2


def room_below(paper: SheetPaper, height: Real) -> Real:
    """The room between a drawing and the foot of its field, in mm: half of the spare height.

    Fixed pivots need this room for their ground, and notes need it too, so the foot gets room
    first.
    """
    spare = larger(paper.upright - height, 0.0)
    return ABOVE + larger(spare / 2, smaller(spare, GROUND - ABOVE))


def spare_height(drawing: Drawing) -> float:
    """How far the upper edges of both fields can be lowered, in mm; on leaves, of the left one.

    The highest drawing then has only the room ABOVE over it.
    """
    layout, metres = lay_out(drawing), drawing.scales.metres(drawing.kind)
    field = layout.mechanism
    tops = [field(complex(0.0, drawing.mechanism_extent().top))[1]]
    tops += [field(pole)[1] for pole in poles_of(drawing) if field.holds(pole)]
    if not drawing.paper.is_parted:
        tops += [layout.plan(complex(0.0, drawing.plan_extent().top / metres))[1]]
    return max(min(tops) - ABOVE - drawing.paper.fields[1], 0.0)


def lowered(paper: SheetPaper, layout: Layout, more: float) -> Layout:
    """The same drawings in fields whose upper edges are ``more`` mm lower; on leaves, the left one.

    The data are above it alone.
    """
    if not more:
        return layout

    def less(field: Field) -> Field:
        left, top, right, low = field.rect
        return replace(field, rect=(left, top + more, right, low))

    plan = layout.plan if paper.is_parted else less(layout.plan)
    return replace(layout, mechanism=less(layout.mechanism), plan=plan)


def poles_of(drawing: Drawing) -> Iterator[Point]:
    """The centres and poles of a sheet, except those at infinity."""
    for _, step, value in drawing.on_mechanism:
        if step.part in (Part.CENTRE, Part.POLE) and isinstance(value, Ratio):
            point = drawing.place(value)
            if point is not None:
                yield point


def spans(drawing: Drawing, fields: Layout) -> dict[int, tuple[float, float]]:
    """The drawn part of each line and arc: the points on it, and a little beyond."""
    found: dict[int, tuple[float, float]] = {}
    for number, step, value in drawing.steps(Plane.MECHANISM, drawing.plane):
        mm = fields.field(step).mm
        points = points_on(drawing, number)
        if isinstance(value, Line):
            points += far_points(drawing, number, value)
            found[number] = line_span(value, points, mm)
        elif isinstance(value, Circle) and points:
            found[number] = arc_span(value, points, mm)
    return found


def points_on(drawing: Drawing, number: int) -> list[complex]:
    """The points that were found on a line or an arc, and those that it joins."""
    points: list[Any] = []
    for child in drawing.children.get(number, ()):
        value: Any = drawing.trace.values[drawing.results.get(child, child)]
        points.append(drawing.place(value) if isinstance(value, Ratio) else value)
    for arg in joined_points(drawing, number):
        value = drawing.trace.values[arg]
        points.append(drawing.place(value) if isinstance(value, Ratio) else value)
    return [point for point in points if isinstance(point, complex)]


def joined_points(drawing: Drawing, number: int) -> list[int]:
    """The steps of the centres, or of other points, that a line joins."""
    step, values = drawing.trace.program.steps[number], drawing.trace.values
    if not isinstance(values[number], Line):
        return []
    kind = construction(step)
    joins = isinstance(kind, JoinsPoints) and step.role in kind.joins
    return [arg for arg in step.args if joins or isinstance(values[arg], Ratio)]


def far_points(drawing: Drawing, number: int, line: Line) -> list[complex]:
    """A distant point along each ray to a centre at infinity.

    With it the ray reaches the edge of its field.
    """
    found = []
    for _, step, value in drawing.on_mechanism:
        if step.part is not Part.CENTRE or step.by_hand is None or not isinstance(value, Ratio):
            continue
        if number not in drawing.trace.program.steps[step.by_hand].args:
            continue
        if drawing.place(value) is None and not drawing.is_everywhere(value):
            way = value.shift / value.size if value.size else value.shift
            found.append(line.point + way / abs(way) * FAR * drawing.reach)
    return found


def line_span(line: Line, points: Sequence[complex], mm: float) -> tuple[float, float]:
    """The part of a line from its anchor to the points on it, in mm, extended at both ends."""
    unit = line.along / abs(line.along)
    along = [0.0, *(((p - line.point) * unit.conjugate()).real * mm for p in points)]
    return min(along) - BEYOND, max(along) + BEYOND


def arc_span(circle: Circle, points: Sequence[complex], mm: float) -> tuple[float, float]:
    """The part of a circle around the points on it, in degrees."""
    half = min(degrees(SWEEP / (circle.radius * mm)), 60.0)
    angles = [degrees(phase(point - circle.centre)) for point in points]
    return min(angles) - half, max(angles) + half
