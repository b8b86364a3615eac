"""The segments of a plan by their letters, and the rule for what is too short to be drawn."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import drawn_in
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.vocabulary import join
from graphkin.text.markup import NOTHING

TINY = 0.5
"""Vectors shorter than this, in mm, are named at the foot of their field."""
NEAR = 0.3
"""A thin line shorter than this, in mm, between two points of a plan is not drawn."""


def is_short(drawing: Drawing, size: float, plane: Plane) -> bool:
    """Whether a vector of a plan with this magnitude is too short to be drawn."""
    return drawn_in(drawing, plane, abs(size)) < TINY


def laid_off_words(drawing: Drawing, key: str, size: float, **fields: str) -> str:
    """The words for how a computed vector is laid off, and its length, or that it is too short.

    Empty for a vector that is zero.
    """
    if size == 0:
        return ""
    short = "_short" if is_short(drawing, size, drawing.plane) else ""
    drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, size))
    return drawing.words(f"calculation.{key}{short}", drawn=drawn, **fields)


def segment_of(drawing: Drawing, step: Step) -> str:
    """The segment of a plan under an arrow, by its letters; empty where an end has no letter."""
    vector = plan_vector(step)
    ends = [letter_at_end(drawing, end, step) for end in vector.ends if end] if vector else []
    if step.action is join:
        ends = [letter_at(drawing, number) for number in step.args]
        if vector and vector.foot:
            ends[0 if vector.back else 1] = vector.foot
    return NOTHING.join(drawing.symbol(end) for end in ends) if all(ends) else ""


def letter_at(drawing: Drawing, number: int) -> str:
    """The letter of a point of a plan.

    The foot of a component too short to be drawn has the letter of the component's start.
    """
    steps = drawing.trace.program.steps
    if steps[number].name or number not in drawing.feet:
        return steps[number].name
    arrow = drawing.feet[number]
    vector = plan_vector(steps[arrow])
    assert vector is not None
    if is_foot_drawn(drawing, arrow):
        return vector.foot
    return letter_at(drawing, steps[arrow].args[1 if vector.back else 0])


def letter_at_end(drawing: Drawing, letter: str, own: Step) -> str:
    """The letter at an end of a segment; for a foot not drawn, the letter of the other end."""
    for number, step, _ in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if step is own or vector is None or vector.foot != letter or letter not in vector.ends:
            continue
        if not is_foot_drawn(drawing, number):
            return vector.ends[0 if letter == vector.ends[1] else 1]
    return letter


def is_foot_drawn(drawing: Drawing, arrow: int) -> bool:
    """Whether a component is long enough for its foot to be marked in the plan."""
    value = drawing.trace.values[arrow]
    return not is_short(drawing, abs(value.tip - value.tail), drawing.plane)
