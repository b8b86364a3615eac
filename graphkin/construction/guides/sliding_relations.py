"""The relations of what is asked of blocks on their guides."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.component import laid_off as component_laid_off
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import vector_of
from graphkin.construction.core.relation import Relation, answer
from graphkin.construction.result_tables import slid, slide_sense
from graphkin.drawing.symbol_markup import symbol


def of_slides(drawing: Drawing) -> Iterator[Relation]:
    """The motion of each block that is asked: the vector of the plan along its guide, its sense."""
    what, unit = drawing.sliding.target, drawing.sliding.caret_unit
    for block, name, value in slid(drawing):
        size = drawing.settled(abs(value))
        remark = slide_sense(drawing, block, value) if size else ""
        vector = along_guide(drawing, drawing.trace.program.targets[what, block])
        yield Relation(name, vector, "", answer(drawing, size), unit, remark)


def along_guide(drawing: Drawing, number: int) -> str:
    """Markup of the vector of the plan that is the motion of a block along its guide."""
    program = drawing.trace.program
    _, tail, tip = program.steps[number].args
    laid = component_laid_off(program, tail)
    if laid is not None and laid.component.follows:
        return symbol(f"a_{laid.component.index}^r")  # it may be drawn from the other end
    return vector_of(drawing, tail, tip)
