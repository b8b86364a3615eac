"""Reactions and the balance at every position of a cycle, with the lever as their check."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.core.kind import constructions
from graphkin.construction.core.program import Target
from graphkin.construction.core.run import run_batch
from graphkin.construction.forces.force_plan import force_program, undrawn
from graphkin.construction.forces.force_words import is_asked
from graphkin.construction.forces.lever import LeverBalance
from graphkin.motion.course import Reals
from graphkin.motion.pieces import Piece
from graphkin.numbers.arithmetic import batch_kind
from graphkin.scene.forces import Forces


class ForcesAlong(Struct, frozen=True, eq=False):
    """The asked forces (N) and moments (N·m) at every position (N,), by their targets.

    ``difference`` is that of the balance by Zhukovsky's lever from the one by the polygons, as a
    share of the larger one; None without a lever.
    """

    values: Mapping[Target, Any]
    difference: Any = None


def forces_along(
    pieces: Sequence[Piece], numbers: Reals, at: Reals, given: Forces
) -> ForcesAlong | None:
    """The forces that a scene asks at places ``at`` (N,), each in the piece of its number from 1.

    None where the forces of a group are not drawn.
    """
    values: dict[Target, Any] = {}
    difference: Any = None
    for number, piece in enumerate(pieces, 1):
        rows, course = np.flatnonzero(numbers == number), piece.course
        if undrawn(course.scene, course.groups) is not None:
            return None
        program = force_program(course.scene, course.program, course.groups)
        asked = [target for target in program.targets if is_asked(course.scene, given, target)]
        levers = [*constructions(program, LeverBalance)]
        keep = [program.targets[target] for target in asked]
        keep += [n for each in levers for n in (of_lever(each), each.other)]
        steps = program.behind(keep)
        with np.errstate(all="ignore"):
            trace = run_batch(program, steps, course.values(at[rows]), batch_kind(), keep)
        for target in asked:
            found = np.broadcast_to(trace.values[program.targets[target]], len(rows))
            values.setdefault(target, np.full(len(at), np.nan, found.dtype))[rows] = found
        for each in levers:
            one, other = (trace.values[n] for n in (of_lever(each), each.other))
            largest = np.maximum(abs(one), abs(other))
            off = abs(one - other) / np.where(largest > 0, largest, 1.0)
            difference = np.full(len(at), np.nan) if difference is None else difference
            difference[rows] = off
    return ForcesAlong(values, difference)


def of_lever(balance: LeverBalance) -> int:
    """The step of a balance by the lever: the moment of a crank, or the force on a block."""
    number = balance.force if balance.moment is None else balance.moment
    assert number is not None
    return number
