"""A plan without its construction: vectors, and points with their letters."""

from __future__ import annotations

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.paper_canvas import Plot
from graphkin.construction.core.program import Step
from graphkin.construction.step_marks import draw_plan_steps
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark, style_class
from graphkin.drawing.scale import Extent, extent_of
from graphkin.drawing.style import VECTORS
from graphkin.numbers.plane import Vector

SHOWN = (*VECTORS, "relative-acceleration", "arrowhead", "point", "pole")
"""The first classes of the marks of a plan that are shown; construction lines are not."""


class Free(dict[int, tuple[float, float]]):
    """Spans of construction lines that are not shown: zero for each line."""

    def __missing__(self, number: int) -> tuple[float, float]:
        return 0.0, 0.0


def is_point(step: Step) -> bool:
    """Whether a step gives a point of the plan itself, not a point drawn aside."""
    return bool(step.name) and step.aside is None


def is_shown(drawing: Drawing, mark: Mark) -> bool:
    """Whether a mark of a plan is a vector or a point of the plan itself."""
    steps = drawing.trace.program.steps
    aside = mark.step is not None and steps[mark.step].aside is not None
    return style_class(mark) in SHOWN and not aside


def plan_box(drawing: Drawing) -> Extent:
    """The box of a plan in its own unit, pole included."""
    points = [0j]
    for _, step, value in drawing.steps(drawing.plane):
        if isinstance(value, Vector) and step.arrow:
            points += [value.tail, value.tip]
        elif is_point(step) and isinstance(value, complex):
            points.append(value)
    return extent_of(points)


def bare_plan(drawing: Drawing, field: Field) -> FieldContent:
    """The vectors and points of a plan in a field, with the letters of its points alone."""
    board = FieldContent(field.rect)
    draw_plan_steps(Plot(board, field, drawing, Layout(field, field, Free())))
    board.marks = [mark for mark in board.marks if is_shown(drawing, mark)]
    points = {step.name for _, step, _ in drawing.steps(drawing.plane) if is_point(step)}
    lettered = [board.labels[i] for i in board.lettered]
    letters = [[x for x in each.letters if x.name in points] for each in lettered]
    board.labels = [
        each.of_letters((replace(some[0], joint=""), *some[1:]))
        for each, some in zip(lettered, letters, strict=True)
        if some
    ]
    board.notes = []
    return board
