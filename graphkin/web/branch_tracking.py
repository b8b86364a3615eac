"""The way of groups of class III and higher through the range of the driver, as a page knows it.

The motion follows each group from where the scene is drawn. A page gets places of that way, near
which it closes the groups anew; where a dyad is stretched on the way they lie closer together.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from msgspec import Struct

from graphkin.motion.driving import TURN
from graphkin.motion.pieces import Path, Piece
from graphkin.numbers.arrays import np
from graphkin.web.page_driver import LEAST, PARTS, PageDriver, Reach
from graphkin.web.traced_closings import State, TracedClosing

CUT, ROUNDS = 16, 6
"""Parts into which a step is cut, again and again, at whose ends a dyad has its two signs."""
BESIDE = (256, 64, 16, 4)
"""The parts of a step by which places lie beside a stretched dyad."""


class TrackedBranch(Struct, frozen=True):
    """The way of groups from where the scene stands: positions of the driver, what closes there."""

    at: tuple[float, ...] = ()
    states: tuple[State, ...] = ()


def around(
    path: Path, driven: PageDriver, start: float, closings: Sequence[TracedClosing]
) -> tuple[Reach, TrackedBranch] | None:
    """The range about the driver's place, and the way through it; None where it is a mere place.

    ``start`` is that place in the path, which may lie whole turns apart.
    """
    pieces = path.ranges[0]
    course = pieces[0].course
    if pieces[-1].high.at - pieces[0].low.at <= LEAST * course.sweep.usual:
        return None
    groups = [course.closed_links.index(each.links) for each in closings]
    places = [place for piece in pieces for place in sampled(piece, groups)]
    known = {round(at, 12): (at, state) for at, state in places}
    turn = driven.what == "turn"
    shift = TURN * round((driven.start - start) / TURN) if turn else 0.0
    found = [(at / driven.metres + shift, state) for at, state in sorted(known.values())]
    way = TrackedBranch(*(tuple(column) for column in zip(*found, strict=True)))
    if turn and path.whole and path.returns:
        first = TURN * math.floor(driven.start / TURN)
        return Reach(first, first + TURN, True), way
    return Reach(way.at[0], way.at[-1], False), way


def sampled(piece: Piece, groups: Sequence[int]) -> Iterator[tuple[float, State]]:
    """Places on a piece, with what closes the groups there."""
    course, low, high = piece.course, piece.low.at, piece.high.at
    step, ways = course.sweep.usual / PARTS, [course.closures[k] for k in groups]
    is_sign = [k >= way.tried.shape[1] for way in ways for k in range(way.width)]

    def rows(at: Any) -> Any:
        every = [way.rows(course.group(k), at) for k, way in zip(groups, ways, strict=True)]
        return np.concatenate([each[:, :-1] for each in every], axis=1)

    def signs(at: Any) -> Any:
        return rows(at)[:, is_sign]

    count = max(math.ceil((high - low) / step), 1)
    nodes = np.concatenate([way.at for way in ways])
    nodes = nodes[(low <= nodes) & (nodes <= high)]
    at = np.unique(np.concatenate([np.linspace(low, high, count + 1), nodes]))
    turned = signs(at)
    sure = np.flatnonzero(np.isfinite(turned).all(axis=1))
    more = [
        place
        for n, k in pairwise(sure)
        if (turned[n] != turned[k]).any()
        for place in beside(signs, float(at[n]), float(at[k]), step)
    ]
    at = np.unique(np.append(at, [place for place in more if low <= place <= high]))
    for place, row in zip(at.tolist(), rows(at), strict=True):
        if np.isfinite(row).all():
            yield place, tuple(map(float, row))


def beside(signs: Callable[[Any], Any], low: float, high: float, step: float) -> Iterator[float]:
    """Places on both sides of where the sign of a dyad changes between two."""
    for _ in range(ROUNDS):
        at = np.linspace(low, high, CUT + 1)
        turned = signs(at)
        other = (turned != turned[0]).any(axis=1) & np.isfinite(turned).all(axis=1)
        n = int(other.argmax())
        low, high = float(at[n - 1]), float(at[n])
    for part in BESIDE:
        yield low - step / part
        yield high + step / part
