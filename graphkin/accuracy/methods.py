"""The program's own ways: Python floats, batches, decimals and balls, all on the same steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from importlib.util import find_spec
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.accuracy.compared_answers import Found, Reference, radii_of, rows_of
from graphkin.accuracy.effort import Effort
from graphkin.construction.core.batch import run_blocks
from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.run import StepFailed, run
from graphkin.construction.core.timing import Timing, Work
from graphkin.construction.tape.batch_runner import BatchRunner, Way
from graphkin.numbers.arithmetic import FLOAT, Kind
from graphkin.numbers.kinds import array_kind, ball_kind, decimal_kind
from graphkin.text.errors import GraphkinError

DIGITS = (15, 30, 60, 120)
BITS = (53, 106, 212, 400)
FEW = 1_000
"""Variants of a batch with a group of higher class, each of which is a search."""


class MethodRow(Struct, frozen=True):
    """A method: its largest errors in parts of the largest of each quantity, and its time.

    An error is None for what a method does not give, inf where it fails at some position.
    ``variants`` are the positions of one run; ``certified`` marks errors that the method itself
    proves, so that they are radii; ``time`` is of one position, in seconds, None where the method
    is not timed. ``key`` is the short name on pictures.
    """

    family: str
    method: str
    key: str
    errors: tuple[float | None, float | None, float | None]
    time: Timing | None
    variants: int = 1
    certified: bool = False
    note: str = ""


class Method(Struct, frozen=True):
    """A row still without its time, and the work on so many positions that is to be timed."""

    row: MethodRow
    work: Work | None = None
    positions: int = 1


def own_methods(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Every kind of number on the same program, one position after the other or in batches."""
    yield one_by_one(reference, effort, FLOAT, "float64", "float64, one by one", "one by one")
    yield from batches(reference, effort)
    for digits in DIGITS:
        name = f"mpmath, {digits} digits"
        yield one_by_one(
            reference, effort, decimal_kind(digits), "mpmath", name, f"{digits} digits"
        )
    for bits in BITS:
        kind, name = ball_kind(bits), f"Arb, {bits} bits"
        yield one_by_one(reference, effort, kind, "Arb", name, f"{bits} bits", certified=True)


def one_by_one(
    reference: Reference,
    effort: Effort,
    kind: Kind,
    family: str,
    name: str,
    key: str,
    *,
    certified: bool = False,
) -> Method:
    """A method that takes one position after the other."""
    found = found_singly(reference, kind)
    missed = radii_in(found, reference) if certified else reference.missed(found)
    some = afforded(reference, kind, effort)

    def work() -> None:
        for number in some:
            singly(reference, kind, number)

    row = MethodRow(family, name, key, reference.relative(missed), None, 1, certified)
    return Method(row, work, len(some))


def afforded(reference: Reference, kind: Kind, effort: Effort) -> Sequence[int]:
    """The positions that are timed: all, or evenly spread ones where each takes long.

    Of decimals and balls as many as the effort says, a quarter of them where each is a search.
    """
    count = len(reference.places.at)
    if reference.places.course.is_searched:
        count = count if kind is FLOAT else min(count, max(1, effort.timed // 4))
    elif kind is not FLOAT:
        count = min(count, effort.timed)
    return [n * len(reference.places.at) // count for n in range(count)]


def singly(reference: Reference, kind: Kind, number: int) -> Found | None:
    """The answers at one position in a kind; None where a step cannot be drawn."""
    program, answers = reference.places.course.program, reference.answers
    try:
        with kind.working():
            values = reference.exact_values[number]
            trace = run(program, reference.needed, values, kind)
    except (StepFailed, GraphkinError):
        return None
    return {target: trace.values[program.targets[target]] for target in answers.every}


def found_singly(reference: Reference, kind: Kind) -> list[Found]:
    """The answers at every position in a kind; none where a step cannot be drawn."""
    return [singly(reference, kind, n) or {} for n in range(len(reference.places.at))]


def radii_in(found: Sequence[Found], reference: Reference) -> Any:
    """The radii that balls claim at every position, (P, 3); inf where there is none."""
    nowhere = [np.inf] * 3
    return np.array([radii_of(each, reference.answers) if each else nowhere for each in found])


def batches(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Arrays of three lengths; doubles by steps, by emitted numpy, and compiled."""
    ways: list[tuple[str, Way, str, str]] = [
        ("float64", "steps", "float64 batch, by steps", "batch, by steps"),
        ("float64", "numpy", "float64 batch, emitted numpy", "batch, emitted"),
        ("float64", "numba", "float64 batch, compiled", "batch, compiled"),
    ]
    for kind, way, name, key in ways:
        if way == "numba" and (not effort.compiled or find_spec("numba") is None):
            continue
        if way == "steps" or can_be_emitted(reference):
            yield batch(reference, effort, kind, way, name, key)
    for kind in ("float32", "longdouble"):
        yield batch(reference, effort, kind, "steps", f"{kind} batch, by steps", f"{kind} batch")


def variants_of(reference: Reference, effort: Effort) -> int:
    """How many variants a batch has: fewer where each is a search."""
    most = FEW if reference.places.course.is_searched else effort.variants
    wanted = min(effort.variants, most)
    return max(wanted, len(reference.places.at))


def batch(reference: Reference, effort: Effort, kind: str, way: Way, name: str, key: str) -> Method:
    """A method that takes many positions at once; those of the reference come over and over."""
    count, positions = variants_of(reference, effort), len(reference.places.at)
    values = reference.places.repeated(count)
    work = batch_work(reference.places.course.program, reference.answers.every, values, kind, way)
    columns = {t: head_of(v, positions) for t, v in work().items()}
    missed = reference.missed(rows_of(columns, positions))
    row = MethodRow(kind, name, key, reference.relative(missed), None, count)
    return Method(row, work, count)


def head_of(value: Any, count: int) -> Any:
    """The first values of an array; what all share as it is."""
    return value[:count] if getattr(value, "shape", ()) else value


def batch_work(
    program: Program, targets: Sequence[Target], values: dict[str, Any], kind: str, way: Way
) -> Callable[[], dict[Target, Any]]:
    """What runs the targets on arrays of values in a kind and a way, and gives them by name."""
    needed = program.needed(targets)
    keep = [program.targets[target] for target in targets]
    press = BatchRunner(program)

    def work() -> dict[Target, Any]:
        with np.errstate(all="ignore"):
            if kind == "float64":
                trace = press.run(needed, values, keep, way=way)
            else:
                trace = run_blocks(program, needed, values, array_kind(kind), keep)
        return {target: trace.values[program.targets[target]] for target in targets}

    return work


def can_be_emitted(reference: Reference) -> bool:
    """Whether source can follow the program."""
    from graphkin.construction.tape.batch_runner import BatchRequest

    program, answers = reference.places.course.program, reference.answers
    keep = [program.targets[target] for target in answers.every]
    order = BatchRequest(reference.needed, reference.places.values, keep, False, {})
    return BatchRunner(program).emitted(order) is not None
