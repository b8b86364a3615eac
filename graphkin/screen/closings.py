"""Groups of class III and higher on a page that moves: what was cut is closed anew at every place.

A group is followed from where the scene stands, so that a page knows near which value to look;
there the secant finds it in the page as it does here. The signs of the group's dyads stay those of
the scene: where one is stretched on the way, the range ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from graphkin.arithmetic import phase
from graphkin.screen.driven import PARTS, Reach
from graphkin.screen.shelf import Shelf
from graphkin.steps.batch import made_ready, run_moving
from graphkin.steps.emit import LOOP, value
from graphkin.steps.graph import Graph
from graphkin.steps.traced import Number
from graphkin.steps.tracer import traced_kind
from graphkin.steps.trial import needed_of

TRIES = 24
"""Steps along the secant, at most."""
STEP = 1e-6
"""How far off the second trial lies, in radians or parts of the tried length."""
CLOSED = 1e-9
"""Parts of the mechanism by which a closed group may miss."""
HALVED = 18
"""How often the way to the next position is halved before the range ends there."""
FAR = 0.09
"""A tried value that leaps so far, in radians or parts of its size, is of another closure."""
LEAPS = (512, 128, 32, 8)
"""The parts of a step by which a dyad is taken over the place where it is stretched."""

SHARES = (1.0, 2.0, 4.0, 0.0, -1.0)
"""Where beyond it is then looked for, in parts of the way that it would have gone."""

State = tuple[float, ...]
"""What closes the groups: for each what it tries, and the signs of its dyads."""
Solve = Callable[[float, State], State | None]


@dataclass(frozen=True)
class Closing:
    """A step that closes a group: the input that holds what it tries, this where the scene stands,
    and by how much it misses.

    ``facing`` must be positive; ``sine`` is that of the crossing of the two loci.
    """

    name: str
    turns: bool
    drawn: float
    misfit: Number
    facing: Number
    sine: Number

    @property
    def size(self) -> float:
        """What the tried value is measured by: a radian, or a length."""
        return 1.0 if self.turns else max(abs(self.drawn), 1e-3)


def name_of(number: int) -> str:
    """The input of a step that closes a group; no parameter is called so."""
    return f"tried {number}"


def drawn_value(closer: Any, drawn: Sequence[Any]) -> float:
    """The tried value where the scene stands, in radians or metres."""
    return float(phase(complex(drawn[0])) if closer.trying.turns else drawn[0])


def tried(name: str, graph: Graph, closer: Any, drawn: Sequence[Any]) -> tuple[Any, ...]:
    """The value of such a step for a traced trial: what it tries, the signs, no sine yet."""
    first = Number(graph, graph.input(name))
    signs = (float(sign) for sign in drawn[1:-1])
    return (traced_kind().radians(first) if closer.trying.turns else first, *signs, 1.0)


def closing(
    name: str, shelf: Shelf, closer: Any, known: Sequence[Any], drawn: Sequence[Any]
) -> Closing:
    """What closes a group, traced on what is known."""
    trying, lift, at = closer.trying, shelf.lifted, drawn_value(closer, drawn)
    first = Number(shelf.graph, shelf.graph.input(name))
    signs = [float(sign) for sign in drawn[1:-1]]
    step = STEP * (1 if trying.turns else max(abs(at), 1e-3))
    here, before, after = (trial(trying, known, first + away, signs) for away in (0.0, -step, step))
    across = abs(lift(after[trying.misfit] - before[trying.misfit]))
    way = abs(lift(after[trying.locus] - before[trying.locus]))
    sine = (across / way).do("min", lift(1.0))
    facing = lift(1.0 if trying.facing is None else here[trying.facing])
    return Closing(name, trying.turns, at, lift(here[trying.misfit]), facing, sine)


def trial(trying: Any, known: Sequence[Any], at: Any, signs: Sequence[Any]) -> Mapping[int, Any]:
    """The results of a trial for traced numbers."""
    kind = traced_kind()
    overrides = dict(zip(trying.inputs, known, strict=True))
    overrides[trying.tried] = kind.radians(at) if trying.turns else at
    overrides |= dict(zip(trying.signs, signs, strict=True))
    needed = needed_of(trying.program, trying.results)
    ready = made_ready(trying.program, needed, trying.values, trying.results, frozenset(overrides))
    return run_moving(ready, trying.values, kind, overrides=overrides).values


# --- one place -----------------------------------------------------------------------------------


def solver(graph: Graph, driver: str, closings: Sequence[Closing], size: float) -> Solve:
    """What closes all groups, one after the other, near given values; None where one does not.

    ``size`` is that of the mechanism.
    """
    names = [driver, *(each.name for each in closings)]
    misses = [function(graph, names, (each.misfit.node, each.facing.node)) for each in closings]

    def solve(at: float, near: State) -> State | None:
        found = list(near)
        for place, (each, miss) in enumerate(zip(closings, misses, strict=True)):

            def missed(tried: float, place: int = place, miss: Any = miss) -> tuple[float, float]:
                found[place] = tried
                result: tuple[float, float] = miss(at, *found)
                return result

            good = closed_near(missed, found[place], STEP * each.size, size)
            if good is None:
                return None
            found[place] = good
        return tuple(found)

    return solve


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


# --- the way through a range ---------------------------------------------------------------------


@dataclass(frozen=True)
class Course:
    """The way of groups from where the scene stands: positions of the driver, what closes there."""

    at: tuple[float, ...] = ()
    states: tuple[State, ...] = ()


def around(
    solve: Solve,
    closings: Sequence[Closing],
    start: float,
    window: tuple[float, float],
    *,
    turning: bool,
) -> tuple[Reach, Course] | None:
    """The range about the start, and the way through it; None where it is a mere place."""
    low, high = window
    up = followed(solve, closings, start, high)
    if turning and up.at[-1] == high and returns(closings, up):
        turn = high - start
        first = turn * math.floor(start / turn)
        return Reach(first, first + turn, True), up
    down = followed(solve, closings, start, low)
    at, states = (*down.at[:0:-1], *up.at), (*down.states[:0:-1], *up.states)
    if at[-1] - at[0] < 1e-6 * max(1.0, abs(at[-1])):
        return None
    return Reach(at[0], at[-1], False), Course(at, states)


def followed(solve: Solve, closings: Sequence[Closing], start: float, end: float) -> Course:
    """The way from the start as far as the end, or as far as the groups close."""
    first = tuple(each.drawn for each in closings)
    at, states = [start], [solve(start, first) or first]
    step, halved = (end - start) / PARTS, 0
    while abs(end - at[-1]) > 1e-9 * abs(end - start) and halved <= HALVED:
        place = at[-1] + step / 2**halved
        place = end if (end - place) * step < 0 else place
        guess = extrapolated(at, states, place)
        found = solve(place, guess)
        if found is None or leaps(closings, guess, found):
            halved += 1
            continue
        at.append(place)
        states.append(found)
        halved = max(0, halved - 1)
    return Course(tuple(at), tuple(states))


def extrapolated(at: Sequence[float], states: Sequence[State], place: float) -> State:
    """The state at a further place if it went on as before."""
    if len(at) < 2:
        return states[-1]
    part = (place - at[-1]) / (at[-1] - at[-2])
    return tuple(b + part * (b - a) for a, b in zip(states[-2], states[-1], strict=True))


def leaps(closings: Sequence[Closing], guess: State, found: State) -> bool:
    """Whether a closure found is not the one that was followed."""
    both = zip(closings, guess, found, strict=True)
    return any(abs(a - b) > FAR * each.size for each, a, b in both)


def returns(closings: Sequence[Closing], way: Course) -> bool:
    """Whether groups are at the end of a turn what they were at its beginning."""
    for each, a, b in zip(closings, way.states[0], way.states[-1], strict=True):
        turns = 2 * math.pi * round((b - a) / (2 * math.pi)) if each.turns else 0.0
        if abs(b - a - turns) > 1e-6 * each.size:
            return False
    return True
