"""A run in doubles: where rounding leaves open how many closures a group has, balls decide."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.program import Program, Step
from graphkin.construction.core.run import StepFailed, Trace, run
from graphkin.construction.higher_class.closure_solver import MergingError, Trying, closer_of
from graphkin.construction.higher_class.merging import merged
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.kinds import ball_kind, in_doubles
from graphkin.scene.model import Scene

BITS = (128, 256, 512, 1024)
"""Bits of the balls that are asked one after the other."""


def run_settled(
    scene: Scene,
    program: Program,
    needed: Sequence[int],
    *,
    overrides: Mapping[int, Any] | None = None,
    begun: Trace | None = None,
) -> Trace:
    """As run, in doubles. Raises StepFailed, of MergingError where balls do not decide either."""
    while True:
        try:
            return run(program, needed, scene.values, FLOAT, overrides=overrides, begun=begun)
        except StepFailed as failed:
            if not isinstance(failed.__cause__, MergingError):
                raise
            if not newly_settled(scene, program, failed):
                raise


def ways(scene: Scene, program: Program, number: int, known: Sequence[Any]) -> int:
    """In how many ways a step closes its group on known floats; how many of them are sure to come
    before two that merge, where balls do not decide whether these have."""
    step = program.steps[number]
    trying = trying_of(step)
    closures = trying.closures_of(known)
    sure = closures.before(0)
    if closures.merging_at(sure + 1) is None:
        return sure
    settle(scene, program, step, tuple(known))
    found = trying.settled[tuple(known)]
    return sure if found is None else len(found)


def trying_of(step: Step) -> Trying:
    """The trial by which a step closes a group."""
    closer = closer_of(step)
    assert closer is not None
    return closer.trying


def newly_settled(scene: Scene, program: Program, failed: StepFailed) -> bool:
    """Whether balls now tell the closures of a group and were not asked before."""
    known, settled = failed.args_found, trying_of(failed.step).settled
    if known in settled:
        return False
    settle(scene, program, failed.step, known)
    return settled[known] is not None


def settle(scene: Scene, program: Program, step: Step, known: tuple[Any, ...]) -> None:
    """Let the trial of a step keep what balls tell of its closures on known floats."""
    trying = trying_of(step)
    closures, found = trying.closures_of(known), None
    before = replace(program, targets={("", str(n)): n for n in step.args})
    needed = before.needed(before.targets)
    for bits in () if trying.several else BITS:
        kind = ball_kind(bits)
        with kind.working():
            try:
                values = run(before, needed, scene.values_in(kind), kind).values
                found = merged(trying, [values[n] for n in step.args], closures, kind)
                break
            except (StepFailed, ValueError):
                continue
    trying.settled[known] = (
        None
        if found is None
        else [
            trying.polished(known, (0, in_doubles(one.tried), *one.signs, in_doubles(one.sine)))
            for one in found
        ]
    )
