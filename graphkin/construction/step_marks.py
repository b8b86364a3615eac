"""The marks of steps: each value of the trace placed on the page, under its action's own look."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphkin.construction.core.kind import construction
from graphkin.construction.core.paper_canvas import draw_part
from graphkin.construction.core.plan_marks import (
    put_arrow,
)
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.plot import Plot
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.higher_class.misclosure_marks import put_gaps
from graphkin.construction.higher_class.trial_marks import (
    put_divided,
    put_trial,
    put_trial_line,
    raise_trials,
)

Put = Callable[[Plot, int, Step, Any], None]


def draw_mechanism_steps(plot: Plot, *, found: bool) -> None:
    """Put down the steps on the mechanism: those that found its points, or all the others."""
    for number, step, value in plot.drawing.mechanism_steps():
        if (step.part is Part.POSITION) is found:
            put_step(plot, number, step, value)


def draw_plan_steps(plot: Plot) -> None:
    """Put down every step of the plan, in order."""
    for number, step, value in plot.drawing.steps(plot.drawing.plane):
        put_step(plot, number, step, value)
    put_gaps(plot)
    raise_trials(plot)


def put_step(plot: Plot, number: int, step: Step, value: Any) -> None:
    """Put down one step in the look of its action, if it has one."""
    kind = construction(step)
    if kind is not None:
        draw_part(plot, number, step, kind)
    key = step.action.key if step.action else "given"
    plane = Plane.MECHANISM if step.plane is Plane.MECHANISM else Plane.NUMBERS
    put = PUTS.get((plane, key)) if kind is None else None
    if number in plot.drawing.tags:
        put = put_trial
    elif plan_vector(step):
        put = put_arrow
    if put:
        put(plot, number, step, value)


PUTS: dict[
    tuple[Plane, str], Put
] = {  # the look of each action on the mechanism, and on a plan (NUMBERS)
    (Plane.NUMBERS, "between"): put_divided,
    (Plane.NUMBERS, "line-through"): put_trial_line,
}
