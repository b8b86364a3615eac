"""Running a program on one scene: values and margins; a step that cannot be drawn raises."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program, Step
from graphkin.numbers.arithmetic import FLOAT, Kind, np
from graphkin.numbers.plane import Line, Ratio

Values = Mapping[str, Any]
Hook = Callable[[int, Step, Any], Any]


class StepFailed(Exception):
    """A step that cannot be drawn on one scene, with the values of its inputs."""

    def __init__(self, number: int, step: Step, args: tuple[Any, ...]) -> None:
        self.number, self.step, self.args_found = number, step, args
        super().__init__(f"step {number} cannot be drawn")


class Trace(Struct, frozen=True):
    """The value of each executed step, and the margin of each crossing among them."""

    program: Program
    values: Mapping[int, Any]
    margins: Mapping[int, Any]

    def value(self, quantity: str, of: str) -> Any:
        """The value of a target; None where it was not executed."""
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

    ``hook`` may replace each value as it is found, as a drawing error does. ``overrides`` gives
    values to use in place of a step's own. ``by_hand`` lets composite steps take the value found by
    hand. ``begun`` is an earlier trace with the same values, at another scale of velocities or for
    other targets. Its values are kept where they do not depend on that scale.

    A step that only the construction by hand uses may be impossible, such as the normal to a
    velocity that is zero. This step and all that would follow from it are left out. Raises
    StepFailed at any other impossible step.
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
    """The value of one step on one scene; its margin is added to ``margins``.

    Raises StepFailed.
    """
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
    """A value as a number of a kind: constants enter as Python's own numbers."""
    if kind.own is None:
        return value
    if isinstance(value, tuple):
        parts = (as_of(kind, part) for part in value)
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return kind.own(value) if isinstance(value, complex | float) else value


def not_a_way(along: Any) -> bool:
    """Whether a direction is zero, and so no direction; False for arrays."""
    return not hasattr(along, "shape") and along == 0


# --- running a program on arrays: shared values once, the rest in blocks -------------------------


BLOCK = 2048
"""Number of variants run at once: few enough for the values of a step to fit in the cache."""


class Ready(Struct, frozen=True):
    """A program prepared for arrays.

    It holds the values and margins that all variants share, and the steps that vary, each with the
    steps whose values are dropped after it. ``keep`` are the steps whose values are kept.
    """

    program: Program
    values: Mapping[int, Any]
    margins: Mapping[int, Any]
    moving: tuple[tuple[int, tuple[int, ...]], ...]
    keep: frozenset[int]


def run_batch(
    program: Program,
    needed: Sequence[int],
    values: Values,
    kind: Kind,
    keep: Sequence[int],
    *,
    margins: bool = False,
    overrides: Mapping[int, Any] | None = None,
) -> Trace:
    """Run the needed steps on arrays; only the values in ``keep`` outlive their last use.

    A value that cannot be drawn becomes NaN. The caller wraps the call in numpy's errstate.
    """
    overrides = overrides or {}
    single = kind.shared or FLOAT
    ready = made_ready(program, needed, values, keep, frozenset(overrides), single)
    return run_moving(ready, values, kind, margins=margins, overrides=overrides)


def run_blocks(
    program: Program,
    needed: Sequence[int],
    values: Values,
    kind: Kind,
    keep: Sequence[int],
    *,
    margins: bool = False,
) -> Trace:
    """Run as run_batch does, one block at a time, into arrays of the whole length."""
    size = max((len(value) for value in values.values() if is_array(value)), default=1)
    ready = made_ready(program, needed, values, keep, single=kind.shared or FLOAT)
    found: dict[int, Any] = {}
    sines: dict[int, Any] = {}
    for start in range(0, max(size, 1), BLOCK):
        part = slice(start, start + BLOCK)
        here = {name: v[part] if is_array(v) else v for name, v in values.items()}
        block = run_moving(ready, here, kind, margins=margins)
        for whole, parts in ((found, block.values), (sines, block.margins)):
            for number, value in parts.items():
                if number not in whole:
                    whole[number] = room_for(value, size)
                put(value, whole[number], part)
    return Trace(program, found, sines)


def made_ready(
    program: Program,
    needed: Sequence[int],
    values: Values,
    keep: Sequence[int],
    overridden: frozenset[int] = frozenset(),
    single: Kind = FLOAT,
) -> Ready:
    """Split the needed steps: those that depend on an array vary, the others are computed here.

    ``single`` is the kind of number for values that all variants share.
    """
    arrays = {name for name, value in values.items() if is_array(value)}
    shared: dict[int, Any] = {}
    sines: dict[int, Any] = {}
    moving: list[int] = []
    for number in needed:
        step = program.steps[number]
        varies = step.given is not None and not arrays.isdisjoint(step.given.uses())
        if number in overridden or varies or not shared.keys() >= set(step.args):
            moving.append(number)
            continue
        try:
            shared[number] = evaluate(step, number, shared, values, single, sines)
        except StepFailed:
            shared[number] = sines[number] = math.nan
    kept = frozenset(keep)
    return Ready(program, shared, sines, schedule(program, moving, kept), kept)


def schedule(
    program: Program, moving: Sequence[int], keep: frozenset[int]
) -> tuple[tuple[int, tuple[int, ...]], ...]:
    """Each varying step with the varying steps whose values are dropped after it."""
    last = {number: number for number in moving}
    for number in moving:
        last |= {arg: number for arg in program.steps[number].args if arg in last}
    dying: dict[int, list[int]] = {}
    for number, end in last.items():
        if number not in keep:
            dying.setdefault(end, []).append(number)
    return tuple((number, tuple(dying.get(number, ()))) for number in moving)


def run_moving(
    ready: Ready,
    values: Values,
    kind: Kind,
    *,
    margins: bool = False,
    overrides: Mapping[int, Any] | None = None,
) -> Trace:
    """Run one block: the steps that depend on an array, with the shared values computed before."""
    found = {number: as_of(kind, value) for number, value in ready.values.items()}
    sines = dict(ready.margins) if margins else {}
    overrides = overrides or {}
    for number, dying in ready.moving:
        step = ready.program.steps[number]
        if number in overrides:
            found[number] = overrides[number]
        elif step.given is not None:
            found[number] = step.given.value(values, kind)
        else:
            assert step.action is not None
            args = (*(found[arg] for arg in step.args), *step.extra)
            found[number] = step.action.value(*args)
            if margins and step.action.margin is not None:
                sines[number] = step.action.margin(*args)
        for dead in dying:
            del found[dead]
    return Trace(ready.program, {n: found[n] for n in found if n in ready.keep}, sines)


def is_array(value: Any) -> bool:
    """Whether a value holds one number for each variant."""
    return hasattr(value, "shape")


def room_for(value: Any, size: int) -> Any:
    """Arrays of the whole length for a block's value; a shared value stays as it is."""
    if isinstance(value, Ratio):
        return Ratio(*(room_for(part, size) for part in value))
    return np.empty(size, value.dtype) if isinstance(value, np.ndarray) else value


def put(value: Any, whole: Any, part: slice) -> None:
    """Copy a block's value to its place."""
    if isinstance(value, Ratio):
        for mine, room in zip(value, whole, strict=True):
            put(mine, room, part)
    elif isinstance(whole, np.ndarray):
        whole[part] = value
