"""The marks of steps: each value of the trace placed on the page."""

from __future__ import annotations

from typing import Any

from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.core.paper_canvas import (
    PaperCanvas,
    Plot,
    draw_part,
    put_arrow,
    raise_points_aside,
)
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.segments import is_foot_drawn
from graphkin.construction.higher_class.closed_group import ClosedGroup


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
