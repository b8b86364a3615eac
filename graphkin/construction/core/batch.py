"""Running a program on arrays: what all variants share once, the rest a block at a time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.core.program import Program
from graphkin.construction.core.run import StepFailed, Trace, Values, as_of, evaluate
from graphkin.numbers.arithmetic import FLOAT, Kind
from graphkin.numbers.arrays import np
from graphkin.numbers.plane import Ratio

BLOCK = 2048
"""Variants run at once: few enough that the values of a step stay in the processor's cache."""


class Ready(Struct, frozen=True):
    """A program made ready for arrays: values and margins that all variants share, the steps that
    they do not, each with the steps whose values die after it, and the steps to be kept."""

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

    What cannot be drawn becomes NaN; the caller wraps the call in numpy's errstate.
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
    """As run_batch, a block at a time, each put at its place in arrays of the whole length."""
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
    """Part the needed steps: those that hang on an array move, the others are worked out here.

    ``single`` is the kind of what all variants share.
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
    """Each moving step with the moving steps whose values die after it."""
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
    """One block: the steps that hang on an array, beside what was worked out beforehand."""
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
    """Arrays of the whole length for what a block gives; what all variants share stays alone."""
    if isinstance(value, Ratio):
        return Ratio(*(room_for(part, size) for part in value))
    return np.empty(size, value.dtype) if isinstance(value, np.ndarray) else value


def put(value: Any, whole: Any, part: slice) -> None:
    """Put what a block gives at its place."""
    if isinstance(value, Ratio):
        for mine, room in zip(value, whole, strict=True):
            put(mine, room, part)
    elif isinstance(whole, np.ndarray):
        whole[part] = value
