"""Running a program on one scene: every value and margin; what cannot be drawn raises."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program, Step
from graphkin.numbers.arithmetic import Kind
from graphkin.numbers.plane import Line

Values = Mapping[str, Any]
Hook = Callable[[int, Step, Any], Any]


class StepFailed(Exception):
    """A step that cannot be drawn on one scene, with the values it was to be drawn from."""

    def __init__(self, number: int, step: Step, args: tuple[Any, ...]) -> None:
        self.number, self.step, self.args_found = number, step, args
        super().__init__(f"step {number} cannot be drawn")


class Trace(Struct, frozen=True):
    """The value of each step that was run, and the margin of each crossing among them."""

    program: Program
    values: Mapping[int, Any]
    margins: Mapping[int, Any]

    def value(self, quantity: str, of: str) -> Any:
        """The value of a target, or None where it was not run."""
        return self.values.get(self.program.targets.get((quantity, of), -1))


def run(
    program: Program,
    needed: Sequence[int],
    values: Values,
    kind: Kind,
    *,
    hook: Hook | None = None,
    overrides: Mapping[int, Any] | None = None,
    by_hand: bool = False,
    begun: Trace | None = None,
) -> Trace:
    """Run the needed steps on one scene, with a margin for every crossing.

    ``hook`` may replace each value as it comes (a pencil's error); ``overrides`` gives values to
    use in place of a step's own; ``by_hand`` lets composite steps take the hand's value.
    A step that only the hand's way uses and that cannot be drawn here (the normal to a velocity
    that is nought) is left out, and what would follow from it. Raises StepFailed at any other.
    What was ``begun`` with the same values, at another scale of velocities or for other targets, is
    kept where it does not depend on that scale.
    """
    found: dict[int, Any] = {}
    margins: dict[int, Any] = {}
    overrides = overrides or {}
    anew = {-1 if program.seconds is None else program.seconds}
    for number in needed:
        step = program.steps[number]
        if begun is not None and number not in anew:
            if not anew.isdisjoint(step.args):
                anew.add(number)
            elif number in begun.values:
                found[number] = begun.values[number]
                if number in begun.margins:
                    margins[number] = begun.margins[number]
                continue
        if number in overrides:
            value = overrides[number]
        elif by_hand and step.by_hand is not None and step.by_hand in found:
            value = found[step.by_hand]
        elif step.hand and not found.keys() >= set(step.args):
            continue
        else:
            try:
                value = evaluate(step, number, found, values, kind, margins)
            except StepFailed:
                if step.hand:
                    continue
                raise
        found[number] = hook(number, step, value) if hook else value
    return Trace(program, found, margins)


def evaluate(
    step: Step,
    number: int,
    found: Mapping[int, Any],
    values: Values,
    kind: Kind,
    margins: dict[int, Any],
) -> Any:
    """Value of one step on one scene; its margin is put beside it. Raises StepFailed."""
    if step.given is not None:
        return as_of(kind, step.given.value(values, kind))
    assert step.action is not None
    args = (*(found[arg] for arg in step.args), *step.extra)
    try:
        value = step.action.value(*args)
        if step.action.margin is not None:
            margins[number] = step.action.margin(*args)
    except (ZeroDivisionError, ValueError, OverflowError) as reason:
        raise StepFailed(number, step, args) from reason
    if not kind.sound(value) or (isinstance(value, Line) and not_a_way(value.along)):
        raise StepFailed(number, step, args)
    return as_of(kind, value)


def as_of(kind: Kind, value: Any) -> Any:
    """A value as one of a kind: constants enter as Python's own numbers."""
    if kind.own is None:
        return value
    if isinstance(value, tuple):
        parts = (as_of(kind, part) for part in value)
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return kind.own(value) if isinstance(value, complex | float) else value


def not_a_way(along: Any) -> bool:
    """Whether a direction is nought, and so none; of an array it is not asked."""
    return not hasattr(along, "shape") and along == 0
