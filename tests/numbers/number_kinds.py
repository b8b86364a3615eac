"""The number kinds side by side: how each runs a program on given inputs, and what it owes.

The reference is a run in decimals of 100 digits. A kind with the rounding unit eps owes each value
to within C·eps·(size + condition), where the condition is by how much the value moves when all
that enters moves by its own relative unit.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.program import Given, Program
from graphkin.construction.core.run import StepFailed, as_of, run, run_batch
from graphkin.construction.tape.emitted import BatchRunner
from graphkin.numbers.arithmetic import Kind, at, is_ball
from graphkin.numbers.kinds import array_kind, decimal_kind
from graphkin.scene.quantity import exact

REFERENCE = decimal_kind(100)
NUDGE = Fraction(1, 10**40)
"""Relative change of what enters, to measure conditions."""
COPIES = 3
"""Equal variants of an array."""
BITS = (106, 212)
DIGITS = (30, 60)
ARRAYS = ("float32", "float64", "longdouble")
UNITS = {"float": 2.0**-52, "float64": 2.0**-52, "float32": 2.0**-23}
UNITS |= {"longdouble": float(np.finfo(np.longdouble).eps)}
LETTERS = {"float32": "fF", "float64": "dD", "longdouble": "gG"}
"""Numpy's letters of the reals and of the complex numbers of each kind of array."""

Inputs = Mapping[int, tuple[Fraction, ...]]
"""Real numbers, or points by two coordinates, in place of steps."""


class Work(Struct, frozen=True):
    """What is run: a program, the steps that are wanted, and values of the scene."""

    program: Program
    wanted: tuple[int, ...]
    values: Mapping[str, Any]

    @property
    def needed(self) -> tuple[int, ...]:
        """The steps that the wanted ones need."""
        names = {("step", str(n)): n for n in self.wanted}
        return Program(self.program.steps, names).needed(names)


def entered(parts: Sequence[Fraction], kind: Kind) -> Any:
    """A real number or a point of a kind."""
    numbers = [kind.number(part) for part in parts]
    value = numbers[0] if len(numbers) == 1 else at(*numbers)
    return as_of(kind, value)


def by_one(work: Work, kind: Kind, inputs: Inputs) -> list[Any]:
    """The wanted values of a run on one scene; raises StepFailed."""
    with kind.working():
        given = {number: entered(parts, kind) for number, parts in inputs.items()}
        found = run(work.program, work.needed, work.values, kind, overrides=given)
    return [found.values[number] for number in work.wanted]


def arrays_of(name: str, inputs: Inputs) -> dict[int, Any]:
    """Inputs as arrays of equal variants."""
    kind, found = array_kind(name), {}
    for number, parts in inputs.items():
        letter = LETTERS[name][1 if len(parts) == 2 else 0]
        found[number] = np.full(COPIES, np.asarray(entered(parts, kind)), dtype=letter)
    return found


def with_shared(work: Work, inputs: Inputs) -> Work:
    """The same work with some inputs stated once for all variants, as a scene states them."""
    steps = list(work.program.steps)
    for number, parts in inputs.items():
        given = Given("point" if len(parts) == 2 else "number", tuple(map(exact, parts)))
        steps[number] = replace(steps[number], given=given)
    return replace(work, program=replace(work.program, steps=tuple(steps)))


def by_array(work: Work, name: str, given: Mapping[int, Any]) -> list[Any]:
    """The wanted values of a run on arrays in place of steps."""
    kind = array_kind(name)
    with np.errstate(all="ignore"):
        found = run_batch(
            work.program, work.needed, work.values, kind, work.wanted, overrides=given
        )
    return [found.values[number] for number in work.wanted]


def is_of(value: Any, kind: str) -> bool:
    """Whether a value has the type of a kind of array; one that all share may be Python's own."""
    if isinstance(value, float | complex) and (kind == "float64" or not hasattr(value, "dtype")):
        return True
    return value.dtype.char in LETTERS[kind]


def by_source(work: Work, given: Mapping[int, Any]) -> list[Any]:
    """The wanted values of emitted source on arrays in place of steps."""
    press = BatchRunner(work.program)
    with np.errstate(all="ignore"):
        found = press.run(work.needed, work.values, work.wanted, overrides=given, way="numpy")
    assert None not in press.kept.values(), "cannot be traced"
    return [found.values[number] for number in work.wanted]


def drawn(work: Work, kind: Kind, inputs: Inputs) -> list[Any] | None:
    """As by_one; None where a step cannot be drawn."""
    try:
        return by_one(work, kind, inputs)
    except StepFailed:
        return None


def far(value: Any, reference: Any) -> float:
    """How far a value lies from the reference; of an array its farthest element."""
    if isinstance(value, np.ndarray):
        return max((far(item, reference) for item in value.ravel()), default=0.0)
    exact_value = decimal_of(value) if isinstance(value, np.generic) else value
    gap = abs(REFERENCE.pi.context.mpc(exact_value) - reference)
    return float(gap) if gap == gap else np.inf  # noqa: PLR0124


def decimal_of(value: Any) -> Any:
    """A number of numpy's as a decimal, without loss."""
    parts = []
    for part in (value.real, value.imag):
        near = float(part)
        rest = float(part - type(part)(near)) if np.isfinite(part) else 0.0
        parts.append(REFERENCE.pi.context.mpf(near) + rest)
    return REFERENCE.pi.context.mpc(*parts)


def conditions(
    solve: Callable[[Inputs], list[Any] | None], inputs: Inputs, reference: list[Any]
) -> list[float] | None:
    """By how much each value moves, in all, per relative unit of each number that enters."""
    total = [0.0] * len(reference)
    for number, parts in inputs.items():
        for k in range(len(parts)):
            moved = list(parts)
            moved[k] = parts[k] * (1 + NUDGE)
            found = solve({**inputs, number: tuple(moved)})
            if found is None:
                return None
            for i, (now, before) in enumerate(zip(found, reference, strict=True)):
                total[i] += float(abs(now - before) / (REFERENCE.number(NUDGE)))
    return total


def contains(ball: Any, reference: Any, slack: Fraction = Fraction(1, 10**85)) -> bool:
    """Whether a ball, real or complex, holds a decimal that is itself good to within a slack."""
    parts = ((ball.real, reference.real), (ball.imag, reference.imag)) if is_point(ball) else None
    for part, true in parts or ((ball, reference.real),):
        middle, radius = fraction(part.mid()), fraction(part.rad())
        gap = abs(middle - fraction_of_decimal(true))
        if gap > radius + slack * (1 + abs(middle)):
            return False
    return True


def is_point(value: Any) -> bool:
    """Whether a ball is one of the plane."""
    return type(value).__name__ == "acb"


def fraction(number: Any) -> Fraction:
    """A ball without width as a fraction."""
    mantissa, exponent = (int(part) for part in number.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


def fraction_of_decimal(number: Any) -> Fraction:
    """A decimal of mpmath as a fraction."""
    sign, mantissa, exponent, _ = number._mpf_
    return Fraction((-1) ** sign * int(mantissa)) * Fraction(2) ** int(exponent)


def width(ball: Any) -> float:
    """The radius of a ball."""
    return max(
        float(part.rad()) for part in ((ball.real, ball.imag) if is_point(ball) else (ball,))
    )


def as_ball(value: Any) -> Any:
    """A number of Python's as a ball of its own."""
    from flint import acb

    return value if is_ball(value) else acb(value)
