"""The sentences of single steps: how a point is found, and through which lines."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import SaidInParts, construction
from graphkin.construction.core.program import Plane, Step
from graphkin.text.markup import AND


def point_sentence(drawing: Drawing, step: Step) -> str:
    """The sentence with the lines through which a point is found, and how they find it."""
    kind = construction(step)
    assert kind is not None
    before = kind.said_before(drawing, step.role)
    parts = [clause for arg in before for clause in clauses(drawing, arg, step.plane)]
    return AND.join([*parts, kind.point_sentence(drawing, step.role)])


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
        if said := AND.join(clauses(drawing, arg, step.plane)):
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
