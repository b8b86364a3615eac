"""The places of a sweep and the pieces of a cycle in words: which closures are stated where."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from graphkin.scene.model import Closure
from graphkin.scene.quantity import SI

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle
    from graphkin.motion.pieces import Piece
    from graphkin.motion.sweep import Sweep

NOTHING = 1e-12
"""A length, in the scene's unit, that is rounding."""


def at_words(sweep: Sweep, at: float, name: bool = True) -> str:
    """A place of the sweep, such as φ = 28.955°."""
    head = f"{sweep.coordinate.letter} = " if name else ""
    if sweep.what == "turn":
        return f"{head}{at:.3f}°".replace("-0.000°", "0.000°")
    if sweep.what == "time":
        return f"{head}{short(at)} s"
    return head + length_words(sweep, at)


def length_words(sweep: Sweep, value: float) -> str:
    """A length in the scene's unit."""
    unit = sweep.original.units["length"]
    size = value / float(SI[unit][0])
    return f"{short(size if abs(size) > NOTHING else 0.0)} {unit}"


def short(value: float) -> str:
    """A number with at most six digits."""
    return f"{value + 0.0:.6g}"


def pieces_words(cycle: Cycle) -> tuple[str, list[str]]:
    """The label and the lines about the pieces; none where there is but one."""
    pieces = cycle.pieces
    if any(piece.low.kind == "number" for piece in pieces):
        return "closures", list(number_words(cycle, pieces))
    if len(pieces) == 1:
        return "pieces", []
    lines = []
    for piece in pieces:
        signs = [f"{name} {branch}" for name, branch in piece.branches.items()]
        span = span_words(cycle, piece.low.at, piece.high.at)
        lines.append(f"{span}: {', '.join(signs) or 'nothing to pick'}")
    return "pieces", lines


def number_words(cycle: Cycle, pieces: Sequence[Piece]) -> Iterator[str]:
    """The numbers that the closures of groups of higher class have along their one motion.

    Pieces of the same numbers that follow one another are one line; too short ones have none.
    """
    yield "one motion through the whole range; to stand in it, write in [branches]"
    for numbers, run in groupby(pieces, numbered):
        part = list(run)
        low, high = part[0].low.at, part[-1].high.at
        if not is_short(cycle, low, high):
            stated = ", ".join(f'{name} = "closure {number}"' for name, number in numbers)
            yield f"{span_words(cycle, low, high)}: {stated}"


def numbered(piece: Piece) -> tuple[tuple[str, int], ...]:
    """The links whose closures are numbered on a piece, and their numbers."""
    found = piece.branches.items()
    return tuple((name, b.number) for name, b in found if isinstance(b, Closure))


def is_short(cycle: Cycle, low: float, high: float) -> bool:
    """Whether two places are told by the same figures."""
    return at_words(cycle.sweep, low) == at_words(cycle.sweep, high)


def span_words(cycle: Cycle, low: float, high: float) -> str:
    """A part of the sweep."""
    ends = (at_words(cycle.sweep, end, name=False) for end in (low, high))
    return f"{cycle.sweep.coordinate.letter} from {' to '.join(ends)}"
