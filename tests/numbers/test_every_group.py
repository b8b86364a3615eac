"""Every group on arrays, by source and in decimals: all that the labs and scenes can be asked.

Doubles one by one and balls are held to their bounds in tests/accuracy/test_agreement.py.

What a kind owes is measured in 100 digits: every number that a step gives is moved by a relative
unit, to any side, and by so much as an answer moves it may be off in the units of the kind.
"""

from __future__ import annotations

import random
import sys
from functools import cache
from typing import Any

import numpy as np
import pytest

from graphkin.construction.core.run import run
from graphkin.construction.higher_class.closure_solver import ClosureSolver
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.arithmetic import is_decimal
from graphkin.numbers.kinds import decimal_kind
from graphkin.numbers.plane import Ratio
from tests.chosen import CHOSEN, FOLDER
from tests.numbers import number_kinds as nk

NAMES = tuple(dict.fromkeys(("pump", "rapid-return", "stephenson-3-crank", *CHOSEN)))
MOVES = 6
"""Runs with moved numbers; the largest move of an answer counts."""
ROUNDINGS = 4
"""Units of its moves by which an answer may be off: a step rounds more than once."""
ENDLESS = 1e9
"""Metres beyond which a centre counts as at infinity and is not compared."""
UNTOLD = 1e12
"""Units by which an answer moves that hangs on rounding alone: a centre nearly at infinity."""


@cache
def mechanism(name: str) -> Mechanism:
    return load(name if name == "pump" else FOLDER / f"{name}.toml")


@cache
def work(name: str) -> nk.Work:
    """All that a mechanism can be asked."""
    program = mechanism(name).program
    wanted = tuple(dict.fromkeys(program.targets[target] for target in program.answers))
    return nk.Work(program, wanted, mechanism(name).scene.values)


@cache
def of_higher_class(name: str) -> bool:
    """Whether a group is closed by trials, which are made on arrays of doubles."""
    steps = mechanism(name).program.steps
    return any(step.action and isinstance(step.action.value, ClosureSolver) for step in steps)


def moved(value: Any, chance: random.Random) -> Any:
    """A decimal moved by a relative unit to some side; what is put together of some, part by part;
    numbers of Python's, which are exact, stay."""
    if isinstance(value, tuple):
        parts = [moved(part, chance) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    if not is_decimal(value):
        return value
    sides = [chance.choice((-1, 1)) * nk.REFERENCE.number(nk.NUDGE) for _ in "xy"]
    if not hasattr(value, "_mpc_"):
        return value * (1 + sides[0])
    return value.context.mpc(value.real * (1 + sides[0]), value.imag * (1 + sides[1]))


def points_of(values: list[Any]) -> list[Any]:
    """Values with the point of each centre in the place of its ratio; None at infinity."""
    return [place(value) if isinstance(value, Ratio) else value for value in values]


def place(ratio: Ratio) -> Any:
    size = abs(ratio.size)
    if np.ndim(size) == 0 and not size > 0:
        return None
    with np.errstate(all="ignore"):
        return ratio.start + ratio.shift / ratio.size


@cache
def owed(name: str) -> tuple[list[Any], list[float]]:
    """The reference values, None where an answer is not compared, and by how much each moves."""
    what = work(name)
    true = points_of(nk.by_one(what, nk.REFERENCE, {}))
    moves = [0.0] * len(true)
    for seed in range(MOVES):
        chance = random.Random(f"{name} {seed}")
        with nk.REFERENCE.working():
            trace = run(
                what.program,
                what.needed,
                what.values,
                nk.REFERENCE,
                hook=lambda number, step, value: moved(value, chance),  # noqa: B023
            )
        found = points_of([trace.values[number] for number in what.wanted])
        for i, (now, before) in enumerate(zip(found, true, strict=True)):
            if now is None or before is None:
                true[i] = None
            else:
                moves[i] = max(moves[i], float(abs(now - before) / nk.REFERENCE.number(nk.NUDGE)))
    context = nk.REFERENCE.pi.context
    told = [
        t is not None and abs(t) < ENDLESS and m < UNTOLD * (1 + abs(t))
        for t, m in zip(true, moves, strict=True)
    ]
    return [context.mpc(t) if known else None for t, known in zip(true, told, strict=True)], moves


def held(name: str, found: list[Any], unit: float) -> None:
    """Hold every answer to what its kind owes."""
    reference, moves = owed(name)
    for value, true, move in zip(points_of(found), reference, moves, strict=True):
        if true is not None:
            assert nk.far(value, true) <= ROUNDINGS * unit * (move + float(abs(true)))


every_mechanism = pytest.mark.parametrize("name", NAMES)


def test_the_groups_are_there():
    assert len(NAMES) > 12
    assert sum(of_higher_class(name) for name in NAMES) >= 4


@every_mechanism
def test_most_answers_are_compared(name):
    reference, _ = owed(name)
    assert sum(true is not None for true in reference) >= 0.8 * len(reference)


@pytest.mark.parametrize("kind", nk.ARRAYS)
@every_mechanism
def test_a_mechanism_on_arrays_keeps_their_type(name, kind):
    found = nk.by_array(work(name), kind, driven(name, kind))
    for value in found:
        for part in value if isinstance(value, tuple) else (value,):
            assert nk.is_of(part, kind)
    held(name, found, nk.UNITS[kind])


def driven(name: str, kind: str) -> dict[int, Any]:
    """The motions of all drivers as arrays of equal variants; the rest is shared."""
    from graphkin.numbers.kinds import array_kind

    what, numbers, found = work(name), array_kind(kind), {}
    for drive in what.program.drives:
        for number in (drive.position, drive.speed, drive.acceleration, drive.angle):
            step = what.program.steps[number] if number is not None else None
            if step is not None and step.given is not None:
                value = step.given.value(what.values, numbers)
                letter = nk.LETTERS[kind][np.iscomplexobj(value)]
                found[number] = np.full(nk.COPIES, np.asarray(value), dtype=letter)
    return found


@pytest.mark.parametrize("name", [name for name in NAMES if not of_higher_class(name)])
def test_a_mechanism_in_emitted_source(name):
    """Closing a group by trials is not straight, so no source is written for it."""
    found = nk.by_source(work(name), driven(name, "float64"))
    held(name, found, nk.UNITS["float64"])


@pytest.mark.parametrize("digits", nk.DIGITS)
@every_mechanism
def test_a_mechanism_in_decimals(name, digits, monkeypatch):
    owed(name)
    if not of_higher_class(name):
        monkeypatch.setitem(sys.modules, "numpy", None)
    found = nk.by_one(work(name), decimal_kind(digits), {})
    monkeypatch.undo()
    held(name, found, 10.0**-digits)
