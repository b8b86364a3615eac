"""Groups of class III and higher on a page that moves: what was cut is closed anew at every place.

Near a value that is known (passage.py), the secant finds it in a page as it does here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct

from graphkin.construction.core.batch import made_ready, run_moving
from graphkin.construction.tape.emit import LOOP, value
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.tape_outputs import TapeOutputs
from graphkin.construction.tape.traced import TracedNumber
from graphkin.construction.tape.tracer import traced_kind
from graphkin.numbers.arithmetic import phase

TRIES = 24
"""Steps along the secant, at most."""
STEP = 1e-6
"""How far off the second trial lies, in radians or parts of the tried length."""
CLOSED = 1e-9
"""Parts of the mechanism by which a closed group may miss."""
State = tuple[float, ...]
"""What closes the groups: for each what it tries, in radians or metres, and its dyads' signs."""


class TracedClosing(Struct, frozen=True):
    """A step that closes a group: the inputs that hold what it tries and the signs of its dyads,
    these where the scene stands, and by how much it misses.

    ``facing`` must be positive; ``sine`` is that of the crossing of the two loci.
    """

    names: tuple[str, ...]
    turns: bool
    drawn: State
    misfit: TracedNumber
    facing: TracedNumber
    sine: TracedNumber

    @property
    def size(self) -> float:
        """What the tried value is measured by: a radian, or a length."""
        return 1.0 if self.turns else max(abs(self.drawn[0]), 1e-3)


def names_of(number: int, drawn: Sequence[Any]) -> tuple[str, ...]:
    """The inputs of a step that closes a group; no parameter is called so."""
    return (f"tried {number}", *(f"tried {number} sign {k}" for k in range(len(drawn) - 2)))


def drawn_state(closer: Any, drawn: Sequence[Any]) -> State:
    """The tried value where the scene stands, in radians or metres, and the signs."""
    first = phase(complex(drawn[0])) if closer.trying.turns else drawn[0]
    return (float(first), *(float(sign) for sign in drawn[1:-1]))


def tried(names: Sequence[str], graph: Graph, closer: Any) -> tuple[Any, ...]:
    """The value of such a step for a traced trial: what it tries, the signs, no sine yet."""
    first, *signs = (TracedNumber(graph, graph.input(name)) for name in names)
    return (traced_kind().radians(first) if closer.trying.turns else first, *signs, 1.0)


def closing(
    names: tuple[str, ...],
    tape: TapeOutputs,
    closer: Any,
    known: Sequence[Any],
    drawn: Sequence[Any],
) -> TracedClosing:
    """What closes a group, traced on what is known."""
    trying, lift, state = closer.trying, tape.lifted, drawn_state(closer, drawn)
    first, *signs = (TracedNumber(tape.graph, tape.graph.input(name)) for name in names)
    step = STEP * (1 if trying.turns else max(abs(state[0]), 1e-3))
    here, before, after = (trial(trying, known, first + away, signs) for away in (0.0, -step, step))
    across = abs(lift(after[trying.misfit] - before[trying.misfit]))
    way = abs(lift(after[trying.locus] - before[trying.locus]))
    sine = (across / way).do("min", lift(1.0))
    facing = lift(1.0 if trying.facing is None else here[trying.facing])
    return TracedClosing(names, trying.turns, state, lift(here[trying.misfit]), facing, sine)


def trial(trying: Any, known: Sequence[Any], at: Any, signs: Sequence[Any]) -> Mapping[int, Any]:
    """The results of a trial for traced numbers."""
    kind = traced_kind()
    overrides = dict(zip(trying.inputs, known, strict=True))
    overrides[trying.tried] = kind.radians(at) if trying.turns else at
    overrides |= dict(zip(trying.signs, signs, strict=True))
    needed = trying.program.behind(trying.results)
    ready = made_ready(trying.program, needed, trying.values, trying.results, frozenset(overrides))
    return run_moving(ready, trying.values, kind, overrides=overrides).values


# --- one place -----------------------------------------------------------------------------------


class Solver(Struct, frozen=True):
    """What closes all groups, one after the other, near given values; ``size`` is the mechanism's.

    ``misses`` give the misfit and what must be positive, of the driver's place, a state, and the
    angles that ``near`` gives for the place.
    """

    closings: Sequence[TracedClosing]
    misses: Sequence[Callable[..., tuple[float, float]]]
    near: Callable[[float], Mapping[str, Any]]
    size: float

    def __call__(self, at: float, near: State) -> State | None:
        """The state in which the groups close; None where one does not."""
        found = list(near)
        for k, (place, each) in enumerate(self.placed()):
            good = closed_near(self.missed(k, at, found), found[place], STEP * each.size, self.size)
            if good is None:
                return None
            found[place] = good
        return tuple(found)

    def placed(self) -> Iterator[tuple[int, TracedClosing]]:
        """Each group with the place of what it tries."""
        place = 0
        for each in self.closings:
            yield place, each
            place += len(each.names)

    def missed(self, k: int, at: float, state: list[float]) -> Callable[[float], Any]:
        """The misfit of a group by what it tries; it stays in the state."""
        place = [place for place, _ in self.placed()][k]
        near = [float(angle) for angle in self.near(at).values()]

        def missed(value: float) -> tuple[float, float]:
            state[place] = value
            return self.misses[k](at, *state, *near)

        return missed


def solver(
    graph: Graph,
    driver: str,
    closings: Sequence[TracedClosing],
    counting: Iterable[str],
    near: Callable[[float], Mapping[str, Any]],
    size: float,
) -> Solver:
    """What closes all groups of a graph; ``near`` gives the inputs ``counting`` at a place."""
    names = [driver, *(name for each in closings for name in each.names), *counting]
    misses = [function(graph, names, (each.misfit.node, each.facing.node)) for each in closings]
    return Solver(closings, misses, near, size)


def closed_near(
    miss: Callable[[float], tuple[float, float]], start: float, step: float, size: float
) -> float | None:
    """Where a misfit vanishes near a start; None where it does not, or where it faces wrongly."""
    for way in (step, -step):
        try:
            found = secant(miss, start, way)
            after, facing = miss(found)
        except (ValueError, ZeroDivisionError, OverflowError):
            continue
        if abs(after) < CLOSED * size and facing > 0:
            return found
    return None


def secant(miss: Callable[[float], tuple[float, float]], start: float, step: float) -> float:
    """The last step along the secant through two trials."""
    old, new = start + step, start
    before, after = miss(old)[0], miss(new)[0]
    for _ in range(TRIES):
        if after in (0, before):
            break
        old, new, before = new, new - after * (new - old) / (after - before), after
        after = miss(new)[0]
        if abs(new - old) < 1e-15 * max(1.0, abs(new)):
            break
    return new


def function(graph: Graph, names: Sequence[str], outputs: Sequence[int]) -> Callable[..., Any]:
    """Some nodes as a function of single numbers, the inputs in the order of their names."""
    places = {name: f"a{i}" for i, name in enumerate(names)}
    lines = [f"def found({', '.join(places.values())}):"]
    for number in graph.needed(outputs):
        node = graph.nodes[number]
        if node.op == "input":
            lines.append(f"    v{number} = {places[node.name]}")
        elif node.op != "number":
            args = (value(graph, arg) for arg in node.args)
            lines.append(f"    v{number} = {LOOP[node.op].format(*args)}")
    lines.append(f"    return {', '.join(value(graph, output) for output in outputs)}")
    known: dict[str, Any] = {**vars(math), "rint": round, "sin45": math.sin}
    exec(compile("\n".join(lines), "<emitted for a closing>", "exec"), known)
    emitted: Callable[..., Any] = known["found"]
    return emitted
