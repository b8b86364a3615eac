"""The segments of a plan by their letters: images, and the feet of components that are laid off."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Step
from graphkin.construction.core.too_short import is_short
from graphkin.construction.core.vocabulary import join
from graphkin.drawing.symbol_markup import symbol


def segment_of(drawing: Drawing, step: Step) -> str:
    """The segment of a plan that an arrow joins, by its letters; nothing where an end has none."""
    vector = plan_vector(step)
    ends = [told(drawing, end, step) for end in vector.ends if end] if vector else []
    if step.action is join:
        ends = [letter_at(drawing, number) for number in step.args]
        if vector and vector.foot:
            ends[0 if vector.back else 1] = vector.foot
    return "".join(symbol(end) for end in ends) if all(ends) else ""


def letter_at(drawing: Drawing, number: int) -> str:
    """The letter of a point of a plan; the foot of a component that is not drawn bears that of the
    point from which it is laid off."""
    steps = drawing.trace.program.steps
    if steps[number].name or number not in drawing.feet:
        return steps[number].name
    arrow = drawing.feet[number]
    vector = plan_vector(steps[arrow])
    assert vector is not None
    if is_foot_drawn(drawing, arrow):
        return vector.foot
    return letter_at(drawing, steps[arrow].args[1 if vector.back else 0])


def told(drawing: Drawing, letter: str, own: Step) -> str:
    """A letter at an end of a leg: that of a foot which is not drawn is the other of its leg."""
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
