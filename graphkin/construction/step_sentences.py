"""The words of single steps: which sentence an action takes, and what fills its gaps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_pairs import SWINGS
from graphkin.construction.core.kind import construction
from graphkin.construction.core.naming import beyond
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.sentence_fields import fields_of
from graphkin.drawing.symbol_markup import symbol

LINES = (
    "compass",
    "ray",
    "along-bar",
    "shifted",
    "guide-back",
    "line-through",
)
"""Actions that are said within the sentence of the point that they help to find."""
FOLLOWING = ("shifted",)
"""Those of them that begin where another one ended."""
WHOLE = (
    "arm",
    "set-back",
)
"""Actions whose own sentence says all that the hand does."""


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
    if step.action.key in WHOLE:
        return phrase(drawing, step, step.name, step)
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
    if step.plane is not plane or is_lever(drawing, number):
        return
    if step.action.key in FOLLOWING:
        for arg in step.args:
            yield from clauses(drawing, arg, plane)
    yield phrase(drawing, step, step.name, step)


def is_lever(drawing: Drawing, number: int) -> bool:
    """True for the line of a lever that a sentence of its own has laid through a pin."""
    steps = drawing.trace.program.steps
    actions = (steps[arg].action for arg in steps[number].args)
    return any(action is not None and action.key in SWINGS for action in actions)


def phrase(drawing: Drawing, step: Step, name: str, words_of: Step) -> str:
    """The words of one step with the symbols of its names."""
    says = {**words_of.says, **step.says}
    fields = fields_of(drawing, step, says)
    key = key_of(drawing, step, fields)
    return drawing.words(f"step.{key}", **{"name": symbol(name), **fields})


# --- which sentence ------------------------------------------------------------------------------


def key_of(drawing: Drawing, step: Step, fields: Mapping[str, str]) -> str:
    """The key of the sentence of a step."""
    assert step.action is not None
    key = step.action.key
    return mechanism_key(drawing, step, key, fields) if step.plane is Plane.MECHANISM else key


def mechanism_key(drawing: Drawing, step: Step, key: str, fields: Mapping[str, str]) -> str:
    """The key of the sentence of a step that draws the mechanism."""
    scene, steps = drawing.scene, drawing.trace.program.steps
    if key in ("ray", "along-bar") and "g" in step.says:
        ways = sum(len(link.paths) for link in scene.links.values())
        return "guide" if ways == 1 and scene.links[step.says["g"]].slides else "guide-named"
    if key == "ray" and "line" in fields:
        return "ray-produced" if "produced" in fields else "ray-against"
    if key == "guide-back" and is_tried(steps[step.args[1]]):
        return "guide-back-found"
    if key == "mark-off" and is_lever(drawing, step.args[0]):
        return "mark-off-lever"
    if key == "step-along" and beyond(drawing, step):
        return "step-along-beyond"
    if key in ("set-at", "arm") and is_tried(steps[step.args[1]]):
        return f"{key}-found"
    return f"{key}.say" if key == "arcs-meet" else key


def is_tried(step: Step) -> bool:
    """True for a value that the closing of a group has found."""
    return step.action is not None and step.action.key == "part"
