"""Groups of class III and higher on a page that moves: what was cut is closed anew at every place.

Near values that are known (branch_tracking) the page's own script finds them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.batch import made_ready, run_moving
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.tape_outputs import TapeOutputs
from graphkin.construction.tape.traced import TracedNumber
from graphkin.construction.tape.tracer import traced_kind
from graphkin.numbers.refined_roots import solved

STEP = 1e-6
"""How far off the second value lies, in radians or parts of the tried length."""
State = tuple[float, ...]
"""What closes the groups: for each what it tries, in radians or metres, and its dyads' signs."""


class TracedClosing(Struct, frozen=True):
    """A step that closes a group: the inputs that hold what it tries and the signs of its dyads,
    these where the scene stands, and by how much it misses, one misfit for each link tried.

    ``facing`` must be positive; ``sine`` is that of the crossing of the two loci; ``links`` are
    those of the group.
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
        """How many links are tried."""
        return len(self.turns)

    @property
    def sizes(self) -> tuple[float, ...]:
        """What the tried values are measured by: a radian, or a length."""
        pairs = zip(self.turns, self.drawn, strict=False)
        return tuple(1.0 if turns else max(abs(value), 1e-3) for turns, value in pairs)

    @property
    def size(self) -> float:
        """What the first of them is measured by."""
        return self.sizes[0]

    @property
    def outputs(self) -> tuple[int, ...]:
        """The nodes of its misfits, and of what must be positive."""
        return (*(each.node for each in self.misfits), self.facing.node)


def names_of(number: int, closer: Any) -> tuple[str, ...]:
    """The inputs of a step that closes a group; no parameter is called so."""
    more = (f"tried {number} within {k}" for k in range(1, len(closer.trying.unknowns)))
    signs = (f"tried {number} sign {k}" for k in range(len(closer.trying.signs)))
    return (f"tried {number}", *more, *signs)


def drawn_state(closer: Any, drawn: Sequence[Any]) -> State:
    """The tried values where the scene stands, in radians or metres, and the signs."""
    count = len(closer.trying.unknowns)
    return tuple(map(float, (*closer.trying.numbers(drawn), *drawn[count:-1])))


def tried(names: Sequence[str], graph: Graph, closer: Any) -> tuple[Any, ...]:
    """The value of such a step for traced numbers: what is tried, the signs, no sine yet."""
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
    """What closes a group, traced on what is known."""
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
    """The least sine of the angles at which a locus crosses what was cut, those within closed."""
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
    """The results of what is tried, for traced numbers."""
    kind = traced_kind()
    overrides = dict(zip(trying.inputs, known, strict=True))
    for one, each in zip(trying.unknowns, at, strict=True):
        overrides[one.tried] = kind.radians(each) if one.turns else each
    overrides |= dict(zip(trying.signs, signs, strict=True))
    needed = trying.program.behind(trying.results)
    ready = made_ready(trying.program, needed, trying.values, trying.results, frozenset(overrides))
    return run_moving(ready, trying.values, kind, overrides=overrides).values
