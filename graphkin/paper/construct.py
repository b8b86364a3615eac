"""The marks of steps: each value of the trace placed on the page, under its action's own look."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphkin.construction.kind import construction
from graphkin.paper.canvas import draw_part
from graphkin.paper.centre import (
    put_centre,
    put_circle_point,
    put_inflection_circle,
    put_named_centre,
    put_ray,
)
from graphkin.paper.desk import Desk
from graphkin.paper.images import put_similar
from graphkin.paper.plan import put_arc, put_arrow, put_driver_ray, put_line, put_point, put_pole
from graphkin.paper.trial_gaps import put_gaps
from graphkin.paper.trial_marks import put_divided, put_trial, put_trial_line, raise_trials
from graphkin.steps.program import Part, Plane, Step

Put = Callable[[Desk, int, Step, Any], None]


def draw_mechanism_steps(desk: Desk, *, found: bool) -> None:
    """Put down the steps on the mechanism: those that found its points, or all the others."""
    for number, step, value in desk.drawing.mechanism_steps():
        if (step.part is Part.POSITION) is found:
            put_step(desk, number, step, value)


def draw_plan_steps(desk: Desk) -> None:
    """Put down every step of the plan, in order."""
    for number, step, value in desk.drawing.steps(desk.drawing.plane):
        put_step(desk, number, step, value)
    put_gaps(desk)
    raise_trials(desk)


def put_step(desk: Desk, number: int, step: Step, value: Any) -> None:
    """Put down one step in the look of its action, if it has one."""
    kind = construction(step)
    if kind is not None and step.plane is Plane.MECHANISM:
        draw_part(desk, number, step, kind)
        return
    key = step.action.key if step.action else "given"
    plane = Plane.MECHANISM if step.plane is Plane.MECHANISM else Plane.NUMBERS
    put = PUTS.get((plane, key))
    if number in desk.drawing.tags and put is not put_similar:
        put = put_trial
    if put:
        put(desk, number, step, value)


PUTS: dict[
    tuple[Plane, str], Put
] = {  # the look of each action on the mechanism, and on a plan (NUMBERS)
    (Plane.MECHANISM, "compass"): put_arc,
    (Plane.MECHANISM, "ray"): put_driver_ray,
    (Plane.MECHANISM, "set-on"): put_arrow,
    (Plane.MECHANISM, "set-on-twice"): put_arrow,
    (Plane.MECHANISM, "velocity-normal"): put_ray,
    (Plane.MECHANISM, "pole-ray"): put_ray,
    (Plane.MECHANISM, "instant-centre"): put_centre,
    (Plane.MECHANISM, "acceleration-pole"): put_centre,
    (Plane.MECHANISM, "pin-centre"): put_named_centre,
    (Plane.MECHANISM, "guide-centre"): put_centre,
    (Plane.MECHANISM, "relative-centre"): put_centre,
    (Plane.MECHANISM, "kennedy-line"): put_ray,
    (Plane.MECHANISM, "normals-meet"): put_centre,
    (Plane.MECHANISM, "inflection-point"): put_circle_point,
    (Plane.MECHANISM, "inflection-square"): put_ray,
    (Plane.MECHANISM, "inflection-pole"): put_centre,
    (Plane.MECHANISM, "inflection-circle"): put_inflection_circle,
    (Plane.NUMBERS, "pole"): put_pole,
    (Plane.NUMBERS, "square-to"): put_line,
    (Plane.NUMBERS, "parallel-to"): put_line,
    (Plane.NUMBERS, "join"): put_arrow,
    (Plane.NUMBERS, "to-corner"): put_arrow,
    (Plane.NUMBERS, "from-corner"): put_arrow,
    (Plane.NUMBERS, "turned-velocity"): put_point,
    (Plane.NUMBERS, "meet"): put_point,
    (Plane.NUMBERS, "similar-point"): put_similar,
    (Plane.NUMBERS, "alike"): put_point,
    (Plane.NUMBERS, "centripetal"): put_point,
    (Plane.NUMBERS, "driven-tangential"): put_point,
    (Plane.NUMBERS, "driven-slide"): put_point,
    (Plane.NUMBERS, "lay-off"): put_point,
    (Plane.NUMBERS, "between"): put_divided,
    (Plane.NUMBERS, "line-through"): put_trial_line,
    (Plane.NUMBERS, "along-bar"): put_line,
}
