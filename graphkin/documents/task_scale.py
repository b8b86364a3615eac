"""The scale at which a task's plan is to be drawn: the rule that the crank gives, or a value."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.naming import has_plan
from graphkin.construction.core.program import Plane
from graphkin.construction.core.relation import figure
from graphkin.construction.drivers.driver_relations import driven_bars, plan_scales
from graphkin.construction.velocity.turned_velocity import TurnedVelocity
from graphkin.drawing.symbol_markup import bar, symbol


def plan_at(drawing: Drawing) -> str:
    """At which scale the plan of a task is to be drawn, as a sentence; nothing without a plan."""
    if not has_plan(drawing):
        return ""
    return drawing.words("task.plan", rule=", ".join(rules(drawing)))


def rules(drawing: Drawing) -> Iterator[str]:
    """The scale of a plan: how the crank says it, with what is as long as what, or its value.

    A plan without the velocity of a pin of the crank has nothing that is as long as the crank.
    """
    scales, first = drawing.scales, drawing.kind == "velocity"
    kv, ka = plan_scales(drawing)
    rule = kv if first else ka
    m = figure(drawing, scales.of_bar(drawing.kind))
    yield f"{rule.left} = {rule.symbols or f'{rule.result} {rule.unit}'}"
    if first and scales.of_crank:
        for p, q in islice(driven_bars(drawing, drawing.scene.drivers[0]), 1):
            times = "" if m == "1" else f"{m}·"
            yield f"{segment(drawing, q)} = {times}{bar(p, q)}/*k*_L"


def segment(drawing: Drawing, pin: str) -> str:
    """The velocity of the crank's pin in the plan, by the letters of its ends."""
    for _, step, _ in drawing.steps(Plane.VELOCITIES):
        kind = construction(step)
        if isinstance(kind, TurnedVelocity) and kind.q == pin:
            return symbol(drawing.pole) + symbol(step.name)
    raise KeyError(pin)
