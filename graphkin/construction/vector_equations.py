"""The vector equations of a plan: motions about pins and along guides, and what is given.

What is not crossed in the plan but computed and laid off stands with its numbers.
"""

from __future__ import annotations

from graphkin.construction.acceleration.turned_acceleration import TurnedAcceleration
from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Step
from graphkin.construction.core.relation import Relation


def of_equations(drawing: Drawing) -> list[tuple[str, Relation]]:
    """The equations of a plan in the order of drawing, each once, with the rate that it takes."""
    found: dict[str, tuple[str, Relation]] = {}
    for number, step, _ in drawing.steps(drawing.plane):
        if (plan := auxiliary_plan(drawing, number)) and plan.repeats:
            continue
        kind = construction(step)
        for relation in kind.equations(drawing, step.role) if kind else ():
            taken = kind.rate_taken(drawing, step.role) if kind and relation.symbols else ""
            found.setdefault(relation.left + relation.symbols, (taken, relation))
    return list(found.values())


def is_laid_off(drawing: Drawing, step: Step) -> bool:
    """True for a component that was not found by the plan but computed and laid off."""
    kind = sign_of(step)
    if kind in ("ν", "c"):
        return True
    tip = drawing.trace.program.steps[step.args[1]]
    return kind == "τ" and tip.role == "image" and isinstance(construction(tip), TurnedAcceleration)
