"""The small letters of triangles on the mechanism: with an index only where there are several."""

from __future__ import annotations

from graphkin.paper.desk import TINY
from graphkin.paper.drawing import Drawing, triangle_of
from graphkin.steps.program import Part, Plane, Step

SIDES = ("set-velocity", "turn-over")
"""The actions that give the two sides of a right triangle which begin at its pin."""


def is_coriolis(step: Step) -> bool:
    """True for a step on the mechanism that belongs to a Coriolis component."""
    return "k" in step.says and "i" in step.says


def letter_on(drawing: Drawing, step: Step, mm: float) -> str:
    """The name of a triangle's point as the drawing has it: b″, or b″_BA beside another b″.

    ``mm`` are those of the drawing to a metre of the mechanism.
    """
    if step.part is not Part.NORMAL or step.plane is not Plane.MECHANISM:
        return step.name
    base = step.name.partition("_")[0]
    same = [number for number, other in drawing.normals if other.name.partition("_")[0] == base]
    if is_coriolis(step):
        same = [number for number in same if not no_base(drawing, number, mm)]
    else:
        steps = drawing.trace.program.steps
        same = [number for number in same if not no_triangle(drawing, steps[number], mm)]
    return base if len(same) == 1 else step.name


def no_triangle(drawing: Drawing, step: Step, mm: float) -> bool:
    """True when the velocity, or the component, of a right triangle is too short to be drawn.

    By what the triangle is drawn from: the velocities of its pivot and its pin, and their bar.
    """
    tip = drawing.trace.program.steps[ends_of(drawing, step)[0]]
    pin, start, end, seconds = (drawing.trace.values[arg] for arg in tip.args)
    velocity = abs(end - start) * seconds
    component = velocity * velocity / abs(pin - drawing.standing.spot(step.says["p"]))
    return bool(min(velocity, component) * mm < TINY)


def is_undrawn(drawing: Drawing, number: int) -> bool:
    """True for a step of a triangle on the mechanism that is too short to be drawn."""
    step, mm = drawing.trace.program.steps[number], 1000 / drawing.scales.kL
    if step.part is not Part.NORMAL or step.plane is not Plane.MECHANISM:
        return False
    return no_base(drawing, number, mm) if is_coriolis(step) else no_triangle(drawing, step, mm)


def ends_of(drawing: Drawing, step: Step) -> list[int]:
    """The tips of the velocity and of the component of the right triangle that a step is of."""
    return [
        number
        for number, other in drawing.triangles[triangle_of(step)]
        if other.action is not None and other.action.key in SIDES and not is_coriolis(other)
    ]


def no_base(drawing: Drawing, number: int, mm: float) -> bool:
    """True when twice the relative velocity, or the component, is too short to be seen."""
    steps, values = drawing.trace.program.steps, drawing.trace.values
    for user in sorted(drawing.trace.program.descendants(number)):
        step = steps[user]
        if step.action is not None and step.action.key == "coriolis-by-hand":
            if user not in values:
                return True
            base, top = (values[arg] for arg in step.args[:2])
            pivot = values[steps[steps[step.args[1]].args[1]].args[1]]
            shortest = min(abs(top - base), abs(base - pivot))
            return bool(shortest * mm < TINY)
    return False
