"""Points of a trial plan that fall together with all that they are drawn from."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import NAUGHT, drawn_between


def fallen_on(drawing: Drawing, number: int) -> str:
    """The point on which one of a trial falls with all that it is drawn from; nothing for none.

    Lines through one point, and figures without size, are not to be drawn. One that moves as
    another does says so itself.
    """
    step = drawing.trace.program.steps[number]
    if step.action is not None and step.action.key == "alike":
        return ""
    before = list(drawn_from(drawing, number))
    apart = (drawn_between(drawing, other, number, step.plane) for other in before)
    if not before or any(size >= NAUGHT for size in apart):
        return ""
    known = [other for other in before if other not in drawing.tags]
    if known:
        return drawing.trace.program.steps[known[0]].name
    return fallen_on(drawing, before[0]) or drawing.trace.program.steps[before[0]].name


def drawn_from(drawing: Drawing, number: int) -> Iterator[int]:
    """The steps of the named points of the plan from which a step is drawn."""
    steps = drawing.trace.program.steps
    for arg in steps[number].args:
        if steps[arg].plane is drawing.plane:
            yield from [arg] if steps[arg].name else drawn_from(drawing, arg)
