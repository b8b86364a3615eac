"""The marks of the similar triangles that give a Coriolis component on the mechanism."""

from __future__ import annotations

from typing import Any

from graphkin.paper.desk import Desk, line_ends
from graphkin.paper.field import XY
from graphkin.paper.labels import Label
from graphkin.paper.letters import is_coriolis, letter_on, no_base, no_triangle
from graphkin.paper.marks import Circle, Line
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import square_mark
from graphkin.paper.triangle import set_vector
from graphkin.steps.program import Step
from graphkin.steps.run import Trace

SIDE = 6.0
"""Shortest side of a triangle, in mm, at whose corner a right angle is marked."""


def without_triangles(trace: Trace, *keys: str) -> Trace:
    """A trace without the steps that only the triangles of some components need.

    These are Coriolis components unless others are named.
    """
    steps = trace.program.steps
    left = dict(trace.values)
    keys = keys or ("coriolis",)
    waiting = [s.by_hand for s in steps if s.action and s.action.key in keys and s.by_hand]
    while waiting:
        number = waiting.pop()
        used = any(number in steps[other].args for other in left)
        if number in left and steps[number].hand and not used:
            del left[number]
            waiting += steps[number].args
    return Trace(trace.program, left, trace.margins)


def put_lever_velocity(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The velocity of a lever's pin about its pivot, unless a right triangle shows it already."""
    if shown_before(desk, number, step) is not None or no_base(desk.drawing, number, desk.field.mm):
        return
    says, fixed = step.says, desk.drawing.scene.frame.points
    name = "v_" + says["q"] + ("" if says["p"] in fixed else says["p"])
    set_vector(desk, number, name, desk.drawing.standing.spot(says["q"]), value)


def shown_before(desk: Desk, number: int, step: Step) -> int | None:
    """The step of a right triangle that sets the same velocity at the same pin."""
    for earlier, other, _ in desk.drawing.mechanism_steps():
        if earlier != number and other.action is step.action and other.args == step.args:
            if not is_coriolis(other) and no_triangle(desk.drawing, other, desk.field.mm):
                continue
            return earlier if earlier < number or not is_coriolis(other) else None
    return None


def put_base(desk: Desk, number: int, step: Step, value: Any) -> None:
    """Twice the relative velocity, set at the pivot of the guide, and e at its tip."""
    if no_base(desk.drawing, number, desk.field.mm):
        return
    pivot = desk.drawing.trace.values[step.args[0]]
    set_vector(desk, number, "2v_" + step.says["i"], pivot, value)
    name_corner(desk, number, step, desk.field(value))


def put_square(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The perpendicular at e, as far as f."""
    ends = line_ends(desk, number, value)
    if no_base(desk.drawing, number, desk.field.mm) or ends is None:
        return
    desk.board.marks.append(Line(*ends[0], *ends[1], "construction", step.name, number))
    corner = desk.field(value.point)
    pivot = desk.field(desk.drawing.trace.values[step.args[1]])
    back = abs(complex(pivot[0] - corner[0], pivot[1] - corner[1]))
    if back > SIDE:
        first = ((pivot[0] - corner[0]) / back, (pivot[1] - corner[1]) / back)
        low, high = desk.layout.spans[number]
        sense = -1 if -low > high else 1
        u, v = desk.field.way(value.along)
        desk.board.marks.append(square_mark(corner, first, (sense * u, sense * v), number))


def put_lean(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The two lines through the pivot that lean alike: to the tip on the bar, and through f."""
    if no_base(desk.drawing, number, desk.field.mm):
        return
    ends = line_ends(desk, number, value)
    pivot, tip = (desk.field(desk.drawing.trace.values[step.args[i]]) for i in (1, 3))
    desk.board.marks.append(Line(*pivot, *tip, "construction", step.name, number))
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "construction", step.name, number))


def put_component(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The Coriolis component, from e to f."""
    if no_base(desk.drawing, number, desk.field.mm):
        return
    edge = desk.drawing.trace.program.steps[step.args[0]]
    base = desk.drawing.trace.values[edge.args[0]]
    set_vector(desk, number, f"a_{step.says['i']}^c", base, value, "coriolis")
    name_corner(desk, number, step, desk.field(value))


def name_corner(desk: Desk, number: int, step: Step, at: XY) -> None:
    """The small letter of a corner: e or f, with its index where there are several triangles."""
    name = letter_on(desk.drawing, step, desk.field.mm)
    desk.board.marks.append(Circle(*at, 0.5, "point construction", step.name, number))
    desk.board.labels.append(
        Label(symbol(name), "construction", at, 2.5, step.name, number, radius=0.5)
    )
