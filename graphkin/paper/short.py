"""What is too short to be drawn: one rule for marks, sentences, tables and what follows from it."""

from __future__ import annotations

from graphkin.paper.desk import TINY
from graphkin.paper.drawing import Drawing
from graphkin.paper.naming import scale_of
from graphkin.paper.relation import length_of
from graphkin.steps.program import Plane

NEARLY_NOUGHT = "≈ 0"
"""How a value is shown that follows from a length which no hand can draw."""


def is_short(drawing: Drawing, size: float, plane: Plane) -> bool:
    """True for a vector of a plan, by its magnitude, that is too short to be drawn."""
    return bool(1000 * abs(size) / scale_of(drawing, plane) < TINY)


def hardly_turns(drawing: Drawing, link: str) -> bool:
    """True for a link whose turning follows from a vector that is too short to be drawn."""
    key = "omega" if drawing.kind == "velocity" else "epsilon"
    number = drawing.trace.program.targets[key, link]
    step = drawing.trace.program.steps[number]
    if step.action is None or step.action.key != key:
        return False
    size = drawing.trace.values[number] * length_of(drawing, step.says["p"], step.says["q"])
    return is_short(drawing, size, drawing.plane)
