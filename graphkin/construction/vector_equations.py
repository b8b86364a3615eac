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
from graphkin.construction.core.relation import Relation, chained
from graphkin.construction.velocity.relative_motion import stated


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
    return joined(list(found.values()))


def joined(found: list[tuple[str, Relation]]) -> list[tuple[str, Relation]]:
    """The same with the equations for one vector chained, where the last of them stands."""
    last = {r.equation.whole.symbol: i for i, (_, r) in enumerate(found) if r.equation}
    chains = {
        each.whole.symbol: each for each in chained([r.equation for _, r in found if r.equation])
    }
    rest: list[tuple[str, Relation]] = []
    for i, (taken, relation) in enumerate(found):
        if relation.equation is None:
            rest.append((taken, relation))
        elif last[name := relation.equation.whole.symbol] == i:
            rest.append((taken, stated(chains[name])))
    return rest


def is_laid_off(drawing: Drawing, step: Step) -> bool:
    """True for a component that was not found by the plan but computed and laid off."""
    kind = sign_of(step)
    if kind in ("ν", "c"):
        return True
    tip = drawing.trace.program.steps[step.args[1]]
    return kind == "τ" and tip.role == "image" and isinstance(construction(tip), TurnedAcceleration)
