"""Groups of class III and higher on a moving page: the cut is closed anew at every position.

The page's script finds the values near those known from branch tracking.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.run import made_ready, run_moving
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.tape_outputs import TapeOutputs
from graphkin.construction.tape.traced import TracedNumber, traced_kind
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import Path, Piece
from graphkin.numbers.arithmetic import np
from graphkin.numbers.common_roots import solved
from graphkin.web.page_driver import LEAST, PARTS, PageDriver, Reach

STEP = 1e-6
"""Step of the difference quotients, in radians or parts of the tried length."""
State = tuple[float, ...]
"""A state that closes the groups: the tried values in radians or metres, and the dyads' signs."""


class TracedClosing(Struct, frozen=True):
    """A step that closes a group: its inputs hold the tried values and the signs of its dyads.

    ``drawn`` are the inputs at the scene's position; ``misfits`` has one misclosure for each tried
    link. ``facing`` must be positive; ``sine`` is the sine of the crossing angle of the two loci;
    ``links`` are the links of the group.
    """

    names: tuple[str, ...]
    turns: tuple[bool, ...]
    drawn: State
    misfits: tuple[TracedNumber, ...]
    facing: TracedNumber
    sine: TracedNumber
    links: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of links that are tried."""
        return len(self.turns)

    @property
    def sizes(self) -> tuple[float, ...]:
        """The unit of each tried value: one radian, or a length."""
        pairs = zip(self.turns, self.drawn, strict=False)
        return tuple(1.0 if turns else max(abs(value), 1e-3) for turns, value in pairs)

    @property
    def size(self) -> float:
        """The unit of the first tried value."""
        return self.sizes[0]

    @property
    def outputs(self) -> tuple[int, ...]:
        """The nodes of its misfits, then of the number that must be positive."""
        return (*(each.node for each in self.misfits), self.facing.node)


def names_of(number: int, closer: Any) -> tuple[str, ...]:
    """The inputs of a step that closes a group; no parameter has such a name."""
    more = (f"tried {number} within {k}" for k in range(1, len(closer.trying.unknowns)))
    signs = (f"tried {number} sign {k}" for k in range(len(closer.trying.signs)))
    return (f"tried {number}", *more, *signs)


def drawn_state(closer: Any, drawn: Sequence[Any]) -> State:
    """The tried values at the scene's position, in radians or metres, and the signs."""
    count = len(closer.trying.unknowns)
    return tuple(map(float, (*closer.trying.numbers(drawn), *drawn[count:-1])))


def tried(names: Sequence[str], graph: Graph, closer: Any) -> tuple[Any, ...]:
    """The traced value of a closing step: tried values, signs, and a placeholder for the sine."""
    numbers = [TracedNumber(graph, graph.input(name)) for name in names]
    unknowns = closer.trying.unknowns
    pairs = zip(unknowns, numbers[: len(unknowns)], strict=True)
    kind = traced_kind()
    values = (kind.radians(each) if one.turns else each for one, each in pairs)
    return (*values, *numbers[len(unknowns) :], 1.0)


def closing(
    names: tuple[str, ...],
    tape: TapeOutputs,
    closer: Any,
    known: Sequence[Any],
    drawn: Sequence[Any],
    links: tuple[str, ...],
) -> TracedClosing:
    """The closing of a group, traced on the known values."""
    trying, lift, state = closer.trying, tape.lifted, drawn_state(closer, drawn)
    numbers = [TracedNumber(tape.graph, tape.graph.input(name)) for name in names]
    unknowns = trying.unknowns
    tried, signs = numbers[: len(unknowns)], numbers[len(unknowns) :]
    here = result(trying, known, tried, signs)
    facings = [lift(here[one.facing]) for one in unknowns if one.facing is not None]
    facing = lift(1.0) if not facings else facings[0]
    for each in facings[1:]:
        facing = facing.do("min", each)
    misfits = tuple(lift(here[one.misfit]) for one in unknowns)
    turns = tuple(one.turns for one in unknowns)
    own = TracedClosing(names, turns, state, misfits, facing, lift(1.0), links)
    return replace(own, sine=crossing_sine(own, tape, closer, known, tried, signs))


def crossing_sine(
    own: TracedClosing,
    tape: TapeOutputs,
    closer: Any,
    known: Sequence[Any],
    tried: Sequence[TracedNumber],
    signs: Sequence[TracedNumber],
) -> TracedNumber:
    """The least sine of the angles between a locus and the cut path, with the inner cuts closed."""
    trying, lift = closer.trying, tape.lifted
    unknowns, sides = trying.unknowns, range(own.count)
    misfits, loci = [], []
    for k, size in enumerate(own.sizes):
        low, high = (
            result(trying, known, [*tried[:k], at, *tried[k + 1 :]], signs)
            for at in (tried[k] - STEP * size, tried[k] + STEP * size)
        )
        misfits.append([high[one.misfit] - low[one.misfit] for one in unknowns])
        loci.append([high[one.locus] - low[one.locus] for one in unknowns])
    least = lift(1.0)
    for k in sides:
        inner = [i for i in sides if i > k]
        rows = [[misfits[j][i] for j in inner] for i in inner]
        led = solved(rows, [-misfits[k][i] for i in inner]) if inner else []
        across, way = misfits[k][k], loci[k][k]
        for j, share in zip(inner, led, strict=True):
            across, way = across + share * misfits[j][k], way + share * loci[j][k]
        least = (abs(lift(across)) / abs(lift(way))).do("min", least)
    return least


def result(
    trying: Any, known: Sequence[Any], at: Sequence[Any], signs: Sequence[Any]
) -> Mapping[int, Any]:
    """The results for tried values, in traced numbers."""
    kind = traced_kind()
    overrides = dict(zip(trying.inputs, known, strict=True))
    for one, each in zip(trying.unknowns, at, strict=True):
        overrides[one.tried] = kind.radians(each) if one.turns else each
    overrides |= dict(zip(trying.signs, signs, strict=True))
    needed = trying.program.behind(trying.results)
    ready = made_ready(trying.program, needed, trying.values, trying.results, frozenset(overrides))
    return run_moving(ready, trying.values, kind, overrides=overrides).values


# --- the course of groups of class III and higher through the range of the driver -----------------


CUT, ROUNDS = 16, 6
"""Parts into which a step is divided, and the rounds of division, until a dyad changes its sign."""
BESIDE = (256, 64, 16, 4)
"""The parts of a step at which positions lie next to a stretched dyad."""


class TrackedBranch(Struct, frozen=True):
    """The course of groups from the scene's position: driver positions and closing states."""

    at: tuple[float, ...] = ()
    states: tuple[State, ...] = ()


def around(
    path: Path, driven: PageDriver, start: float, closings: Sequence[TracedClosing]
) -> tuple[Reach, TrackedBranch] | None:
    """The range around the driver's position, and the course through it; None for one position.

    ``start`` is the position in the path, which may differ by whole turns.
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
    """Positions on a piece, with the states that close the groups there."""
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
    """Positions on both sides of a sign change of a dyad between ``low`` and ``high``."""
    for _ in range(ROUNDS):
        at = np.linspace(low, high, CUT + 1)
        turned = signs(at)
        other = (turned != turned[0]).any(axis=1) & np.isfinite(turned).all(axis=1)
        n = int(other.argmax())
        low, high = float(at[n - 1]), float(at[n])
    for part in BESIDE:
        yield low - step / part
        yield high + step / part
