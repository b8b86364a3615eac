"""Single steps: their marks on the page, their sentences, and plans without a construction."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import SaidInParts, auxiliary_plan, construction, constructions
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.naming import is_foot_drawn
from graphkin.construction.core.paper_canvas import (
    PaperCanvas,
    Plot,
    draw_part,
    put_arrow,
    raise_points_aside,
)
from graphkin.construction.core.program import Part, Plane, Step, plan_vector
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark, style_class
from graphkin.drawing.scale import Extent, extent_of
from graphkin.drawing.style import VECTORS
from graphkin.numbers.plane import Vector


def draw_mechanism_steps(plot: Plot, *, found: bool) -> None:
    """Draw the steps on the mechanism: those that found its points, or all the others."""
    for number, step, value in plot.drawing.on_mechanism:
        if (step.part is Part.POSITION) is found:
            put_step(plot, number, step, value)


def draw_closing_arcs(plot: Plot) -> None:
    """Draw the arcs that cut the loci where groups of class III close."""
    trace = plot.drawing.trace
    for kind in constructions(trace.program, ClosedGroup):
        if kind.closing in trace.values:
            draw_part(PaperCanvas(plot, kind.closing), kind)


def draw_plan_steps(plot: Plot) -> None:
    """Draw every step of the plan, in order."""
    for number, step, value in plot.drawing.steps(plot.drawing.plane):
        put_step(plot, number, step, value)
    for number, step, _ in plot.drawing.steps(Plane.NUMBERS):
        kind = construction(step)
        if kind is not None and step.part is Part(plot.drawing.kind):
            draw_part(PaperCanvas(plot, number), kind)
    raise_points_aside(plot)


def put_step(plot: Plot, number: int, step: Step, value: Any) -> None:
    """Draw one step: as part of its construction, of an auxiliary plan, or as an arrow."""
    kind, plan = construction(step), auxiliary_plan(plot.drawing, number)
    canvas = PaperCanvas(plot, number)
    if kind is not None:
        draw_part(canvas, kind)
    if plan is not None:
        plan.marks(canvas, number)
    elif vector := plan_vector(step):
        put_arrow(plot, number, step, value)
        next(canvas.strokes)
        if vector.foot and is_foot_drawn(plot.drawing.choosing, number):
            canvas.foot(vector.foot, value.tail if vector.back else value.tip)


def point_sentence(drawing: Drawing, step: Step) -> str:
    """The sentence with the lines through which a point is found, and how they find it."""
    kind = construction(step)
    assert kind is not None
    before = kind.said_before(drawing, step.role)
    parts = [clause for arg in before for clause in clauses(drawing, arg, step.plane)]
    return drawing.words.clauses([*parts, kind.point_sentence(drawing, step.role)])


def point_parts(drawing: Drawing, number: int) -> Iterator[tuple[int, str]]:
    """The sentences line by line, each with the step that ends it; the point comes last.

    A single sentence where the point and its lines cannot be separated.
    """
    step = drawing.trace.program.steps[number]
    kind = construction(step)
    assert kind is not None
    if isinstance(kind, SaidInParts) and (parts := [*kind.sentence_parts(drawing, step.role)]):
        yield from parts
        return
    apart = kind.point_apart(drawing, step.role)
    if not apart:
        yield number, point_sentence(drawing, step)
        return
    for arg in kind.said_before(drawing, step.role):
        if said := drawing.words.clauses(clauses(drawing, arg, step.plane)):
            yield arg, said
    yield number, apart


def clauses(drawing: Drawing, number: int, plane: Plane) -> Iterator[str]:
    """The clauses of a line or an arc in a drawing, after the vector laid off before it."""
    step = drawing.trace.program.steps[number]
    kind = construction(step)
    if kind is not None and step.plane is plane and (said := kind.clause(drawing, step.role)):
        for before in kind.said_before(drawing, step.role):
            yield from clauses(drawing, before, plane)
        yield said


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
