"""The marks of one moment of a motion: the mechanism and its plans, and what their letters name.

Nothing of the construction is among them, and nothing that is placed by what stands around it at
this moment alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.plot import Plot
from graphkin.construction.core.program import Step
from graphkin.construction.drivers.driver_symbols import draw_drivers
from graphkin.construction.links.mechanism_symbols import (
    draw_bars,
    draw_ground,
    draw_pins,
    draw_plates,
)
from graphkin.construction.step_marks import draw_plan_steps
from graphkin.drawing.areas import Rect
from graphkin.drawing.field import Field, clipped
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Polyline, reach, style_class
from graphkin.drawing.scale import Extent, extent_of
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.plane import Vector
from graphkin.web.fixed_parts import travelling
from graphkin.web.moving_labels import FrameView, PointLetter

SHOWN = (*VECTORS, "relative-acceleration", "arrowhead", "point", "pole")
"""The first class of the marks of a plan that are shown, without what constructs them."""
MOST = 4
"""Points by which the letter of another may be led, at most."""


def mechanism_seen(drawing: Drawing, field: Field) -> FrameView:
    """Bars, plates, pins and ground, and the points with their letters."""
    board, away_with = FieldContent(field.rect), travelling(drawing, field)
    draw_plates(board, drawing, field)
    draw_ground(board, drawing, field)
    draw_bars(board, drawing, field)
    draw_pins(board, drawing, field)
    marks = [mark for mark in board.marks if mark not in away_with]
    places = {name: field(place) for name, place in drawing.positions.items()}
    letters = {name: PointLetter(symbol(name)) for name in places}
    return FrameView(letters, places, marks, {name: linked(drawing, name) for name in places})


def driver_marks(drawing: Drawing, field: Field) -> list[Mark]:
    """The angle or the way of each driver and its sense, without the number of one position."""
    if drawing.kind != "velocity":
        return []
    board = FieldContent(field.rect)
    draw_drivers(board, drawing, field)
    return list(board.marks)


def linked(drawing: Drawing, name: str) -> tuple[str, ...]:
    """The points of the links of a point that moves, except itself."""
    scene = drawing.scene
    if name in scene.fixed_points:
        return ()
    links = [link for link in scene.links.values() if name in link.points]
    others = dict.fromkeys(other for link in links for other in link.points if other != name)
    return tuple(other for other in others if other in drawing.positions)[:MOST]


def plan_seen(drawing: Drawing, field: Field) -> FrameView:
    """The vectors and points of a plan, without what constructs them, and its letters."""
    board = FieldContent(field.rect)
    draw_plan_steps(Plot(board, field, drawing, Layout(field, field, Free())))
    marks = [mark for mark in board.marks if is_shown(drawing, mark)]
    parts = {mark.step: mark.part for mark in board.marks if isinstance(mark, CircleMark)}
    letters, places = dict[str, PointLetter](), {}
    for number, step, value in drawing.steps(drawing.plane):
        if is_point(step) and isinstance(value, complex):
            own = number, parts.get(number, 0)
            letters[step.name] = PointLetter(symbol(step.name), drawing.kind, *own)
            places[step.name] = field(value)
    return FrameView(
        letters, places, marks, {name: joined(drawing, name, letters) for name in letters}
    )


def joined(drawing: Drawing, name: str, letters: dict[str, PointLetter]) -> tuple[str, ...]:
    """The points of a plan that a vector joins with one of them, the pole first."""
    steps = drawing.trace.program.steps
    ends = [(steps[tail].name, steps[tip].name) for tail, tip in drawing.joins]
    found = {a if b == name else b for a, b in ends if name in (a, b)} & letters.keys()
    return tuple(sorted(found - {name}, key=lambda each: (each != drawing.pole, each))[:MOST])


class Free(dict[int, tuple[float, float]]):
    """Spans of construction lines that are not shown."""

    def __missing__(self, number: int) -> tuple[float, float]:
        return 0.0, 0.0


def is_point(step: Step) -> bool:
    """Whether a step gives a point of the plan itself, not of one that is drawn aside."""
    return bool(step.name) and step.aside is None


def is_shown(drawing: Drawing, mark: Mark) -> bool:
    """Whether a mark of a plan is a vector or a point of the plan itself."""
    steps = drawing.trace.program.steps
    aside = mark.step is not None and steps[mark.step].aside is not None
    return style_class(mark) in SHOWN and not aside


def plan_box(drawing: Drawing) -> Extent:
    """The box of a plan in its own unit, its pole with it."""
    points = [0j]
    for _, step, value in drawing.steps(drawing.plane):
        if isinstance(value, Vector) and step.arrow:
            points += [value.tail, value.tip]
        elif is_point(step) and isinstance(value, complex):
            points.append(value)
    return extent_of(points)


def cut(marks: Sequence[Mark], rect: Rect) -> Iterator[Mark]:
    """What of the marks of a plan lies in its pane: lines up to its edge, all else if within."""
    left, top, right, bottom = rect
    for mark in marks:
        if isinstance(mark, LineMark):
            if part := clipped((mark.x1, mark.y1), (mark.x2, mark.y2), rect):
                (x1, y1), (x2, y2) = part
                yield replace(mark, x1=x1, y1=y1, x2=x2, y2=y2)
            continue
        low, high = reach(mark)[:2], reach(mark)[2:]
        if isinstance(mark, Polyline):
            low = high = mark.points[0]
        if left <= low[0] and top <= low[1] and high[0] <= right and high[1] <= bottom:
            yield mark
