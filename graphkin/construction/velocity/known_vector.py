"""Vectors of points that are known where an equation takes them, and how they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.construction.core.kind import construction
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vector_equation import Term, VectorEquation
from graphkin.drawing.symbol_markup import symbol

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing


def known(drawing: Drawing, point: str) -> Term:
    """The vector of a point that is known: with direction and size where a driver gives them."""
    program = drawing.trace.program
    number = program.targets.get((drawing.kind, point))
    kind = construction(program.steps[number]) if number is not None else None
    note = kind.known_by(drawing) if kind is not None else ""
    return Term(symbol(f"{drawing.vector.letter}_{point}"), 2, note)


def joined(*notes: str) -> str:
    """Notes with a comma between them."""
    return ", ".join(filter(None, notes))


def stated(equation: VectorEquation) -> Relation:
    """A relation that is a vector equation."""
    alone = equation.whole if not equation.sums else None
    left = f"{alone.symbol} {alone.note}" if alone else equation.markup
    return Relation(left, equation=equation)
