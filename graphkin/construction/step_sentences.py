"""The words of single steps: which sentence an action takes, and what fills its gaps."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.sentence_fields import fields_of
from graphkin.drawing.symbol_markup import symbol

LINES = ("line-through",)
"""Actions that are said within the sentence of the point that they help to find."""


def point_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """Through what lines a point is found, and how they find it."""
    kind = construction(step)
    if kind is not None:
        before = kind.said_before(drawing, step.role)
        parts = [clause for arg in before for clause in clauses(drawing, arg, step.plane)]
        return "; ".join([*parts, kind.point_sentence(drawing, step.role)])
    by_hand = step.by_hand is not None and step.by_hand in drawing.trace.values
    last = drawing.trace.program.steps[step.by_hand] if by_hand and step.by_hand else step
    assert step.action is not None
    parts = [clause for arg in last.args for clause in clauses(drawing, arg, last.plane)]
    parts.append(phrase(drawing, last, step.name, step))
    return "; ".join(parts)


def clauses(drawing: Drawing, number: int, plane: Plane) -> Iterator[str]:
    """The clause of a line or an arc of a drawing, after that of the vector laid off before it."""
    step = drawing.trace.program.steps[number]
    kind = construction(step)
    if kind is not None:
        if step.plane is plane and (said := kind.clause(drawing, step.role)):
            for before in kind.said_before(drawing, step.role):
                yield from clauses(drawing, before, plane)
            yield said
        return
    if step.action is None or step.action.key not in LINES or step.name:
        return
    if step.plane is not plane:
        return
    yield phrase(drawing, step, step.name, step)


def phrase(drawing: Drawing, step: Step, name: str, words_of: Step) -> str:
    """The words of one step with the symbols of its names."""
    assert step.action is not None
    fields = fields_of(drawing, {**words_of.says, **step.says})
    return drawing.words(f"step.{step.action.key}", **{"name": symbol(name), **fields})
