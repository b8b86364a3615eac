"""The vector equations of a plan: motions about pins and along guides, and given motions.

A vector that is computed and laid off, not found by a crossing, is given with its value.
"""

from __future__ import annotations

from graphkin.construction.acceleration.turned_acceleration import TurnedAcceleration
from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivenVector, construction
from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Step
from graphkin.construction.core.relation import Relation, VectorEquation
from graphkin.construction.velocity.relative_motion import as_relation


def of_equations(drawing: Drawing) -> list[tuple[str, Relation]]:
    """The equations of a plan in drawing order, each once, with the rate that it uses."""
    found: dict[object, tuple[str, Relation]] = {}
    for number, step, _ in drawing.steps(drawing.plane):
        if (plan := auxiliary_plan(drawing, number)) and plan.repeats:
            continue
        kind = construction(step)
        for relation in kind.equations(drawing, step.role) if kind else ():
            taken = ""
            if isinstance(kind, GivenVector) and relation.symbols:
                taken = kind.rate_taken(drawing, step.role)
            said = relation.equation or relation.left + relation.symbols
            found.setdefault(said, (taken, relation))
    return joined(list(found.values()))


def joined(found: list[tuple[str, Relation]]) -> list[tuple[str, Relation]]:
    """The list with the equations for one vector merged, at the place of the last one.

    Equations for the same vector are chained. An equation for a summand of a known vector is
    substituted.
    """
    rest: dict[str, tuple[str, Relation]] = {}
    for taken, relation in found:
        equation = relation.equation
        if equation is None:
            rest[relation.left + relation.symbols] = taken, relation
            continue
        for name in unknown_in(equation):
            _, before = rest.pop(name, ("", None))
            if before is not None and before.equation is not None:
                equation = equation.joined_to(before.equation)
        is_known = equation.whole.known == 2 and bool(equation.sums)
        rest[equation.markup if is_known else equation.whole.symbol] = taken, as_relation(equation)
    return list(rest.values())


def unknown_in(equation: VectorEquation) -> list[str]:
    """The vectors of points that an equation helps to find: the whole vector, or a summand."""
    found = [term.symbol for terms in equation.sums for term in terms if not term.known]
    return found if equation.whole.known == 2 else [equation.whole.symbol, *found]


def is_laid_off(drawing: Drawing, step: Step) -> bool:
    """Whether a component was computed and laid off, not found by the plan."""
    kind = sign_of(step)
    if kind in ("ν", "c"):
        return True
    tip = drawing.trace.program.steps[step.args[1]]
    return kind == "τ" and tip.role == "image" and isinstance(construction(tip), TurnedAcceleration)
