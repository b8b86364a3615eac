"""The closing of a group of higher class in a drawing: the exact closure follows its drawn pins.

By hand a locus is crossed with what was cut. In a drawing whose known pins are off, the crossing
moves: Newton's method follows it from the exact closure on the same branch. Its own error is that
of the mark put where the locus crosses.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphkin.construction.higher_class.closure_solver import ClosureSolver, Trying
from graphkin.numbers.arithmetic import phase

ROUNDS = 6
"""Steps of Newton's method; errors of a drawing are small, so that three would do."""
SMALL = 1e-6
"""Half the step of the difference that gives its slope, in radians or in parts of the reach."""


def followed(
    closer: ClosureSolver, exact: Any, known: Sequence[Any], shift: Any
) -> tuple[Any, ...]:
    """The closure (tried value, signs, sine) for drawn known values, one for each drawing.

    ``shift`` (m) is how far what was cut is missed: the error of the mark at the crossing.
    """
    import numpy as np

    trying = closer.trying
    first, *signs, sine = exact
    rows = np.broadcast_to(np.array(signs, dtype=float), (len(shift), len(signs)))
    args = [np.broadcast_to(value, len(shift)) for value in known]
    start = phase(complex(first)) if trying.turns else float(first)
    tried = np.full(len(shift), start)
    step = SMALL * (1.0 if trying.turns else max(abs(start), 1e-3))
    for _ in range(ROUNDS):
        low, here, high = (misfit(trying, args, tried + way, rows) for way in (-step, 0, step))
        with np.errstate(all="ignore"):
            tried = tried - (here - shift) / ((high - low) / (2 * step))
    value = np.exp(1j * tried) if trying.turns else tried
    return (value, *signs, sine)


def misfit(trying: Trying, known: Sequence[Any], tried: Any, rows: Any) -> Any:
    """By how many metres the group does not close."""
    return trying.misfits(known, tried, rows)
