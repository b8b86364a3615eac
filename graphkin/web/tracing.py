"""The construction of a page's sheets, traced once with the driver's place as its input.

Groups of higher class close on the page by Newton's steps from the closings traced here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from functools import cached_property
from itertools import pairwise
from math import floor, pi
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import CLOSE, Program, Step
from graphkin.construction.core.run import Trace, made_ready, run_moving
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.construction.higher_class.trial_rates import followed_rates
from graphkin.construction.links.rolled_turn import counted_link
from graphkin.construction.tape.emitted import TapeOutputs
from graphkin.construction.tape.graph import Graph
from graphkin.construction.tape.traced import TracedNumber, traced_kind
from graphkin.mechanism import Mechanism
from graphkin.motion.course import Reals
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import Path, Piece, reachable_ranges, through
from graphkin.motion.sweep import Sweep, Turned, name_of, sweep_of
from graphkin.numbers.arithmetic import np, pick
from graphkin.numbers.common_roots import solved
from graphkin.scene.model import Branch, Closure, Scene, Side, quantities_within
from graphkin.web.frames import MOST_TURNS
from graphkin.web.page_driver import INPUT, LEAST, PARTS, PageDriver, Reach, reach_of, window

MOST_ROUND = 2
"""Circles of the driver on each side of its range through which a page knows the closures."""
SLACK = 1e-6
"""Tolerance on a bar's length at closure, in parts of the mechanism's size."""


def form(step: Step) -> tuple[object, ...]:
    """What steps have in common that differ in their numbers alone."""
    action = step.action if closer_of(step) is None else CLOSE
    return action, step.args, len(step.extra)


def sides(scene: Scene, piece: Piece) -> dict[str, Branch]:
    """The closures of a piece, but for numbered ones: those are followed, whatever their number."""
    own = {name: each for name, each in piece.branches.items() if not isinstance(each, Closure)}
    return {**scene.branches, **own}


def turned_over(scene: Scene, piece: Piece) -> Iterator[tuple[float, Set[str]]]:
    """Where a piece begins, and each place in it where drawn points change their side.

    With each place come the points that lie from there on the other side than the scene says. Bars
    that keep a link parallel are drawn by crossings, whose side changes where all is in line.
    """
    low, high = piece.low.at, piece.high.at
    drawn = {n: s for n, s in scene.branches.items() if isinstance(s, Side)}
    free = {name: side for name, side in drawn.items() if name not in piece.branches}

    def signs(places: Reals) -> Reals:
        points = {*free, *(each for side in free.values() for each in (side.first, side.second))}
        trace = piece.course.run(places, [("position", point) for point in points])
        at = {point: trace.value("position", point) for point in points}
        turned = [
            s.side * ((at[s.second] - at[s.first]).conjugate() * (at[name] - at[s.first])).imag
            for name, s in free.items()
        ]
        on_each = [np.broadcast_to(each, places.shape) for each in turned]
        return np.asarray(np.sign(np.stack(on_each, axis=1)))

    if not free:
        yield low, frozenset()
        return
    count = math.ceil((high - low) / (piece.course.sweep.usual / PARTS))
    places = np.linspace(low, high, count + 1)[:-1] + (high - low) / (2 * count)
    found = signs(places)
    over = [frozenset(np.array([*free])[row < 0].tolist()) for row in found]
    yield low, over[0]
    for n in np.flatnonzero((np.diff(found, axis=0) != 0).any(axis=1)).tolist():
        yield next(beside(signs, float(places[n]), float(places[n + 1]), 0.0)), over[n + 1]


def on_other_side(steps: Sequence[Step], points: Set[str]) -> Iterator[Step]:
    """The steps, with some points at the other one of the two crossings."""
    for step in steps:
        crossed = step.name in points and step.extra in ((1,), (-1,))
        yield replace(step, extra=(-step.extra[0],)) if crossed else step


class Tracing(Struct, frozen=True, dict=True):
    """The traced steps of a mechanism; each sheet reuses the steps that earlier sheets have traced.

    ``margins`` are the sines of all crossings. ``closings`` are the closings of groups of higher
    class. ``counting`` are the links whose whole turns are followed, by their inputs.
    """

    mechanism: Mechanism
    driven: PageDriver
    graph: Graph = field(default_factory=Graph)
    done: dict[int, Any] = field(default_factory=dict)
    margins: dict[int, Any] = field(default_factory=dict)
    closings: list[TracedClosing] = field(default_factory=list)
    counting: dict[str, str] = field(default_factory=dict)

    @cached_property
    def x(self) -> TracedNumber:
        """The driver's place, in the unit of the driver."""
        return TracedNumber(self.graph, self.graph.input(INPUT))

    @cached_property
    def tape(self) -> TapeOutputs:
        starts = {figure.name: figure.start for figure in self.driven.figures}
        return TapeOutputs(self.graph, {INPUT: self.driven.start, **starts})

    @cached_property
    def known(self) -> dict[str, Any]:
        """The scene's parameters, traced if they can be changed, and the offsets of drivers."""
        led: dict[str, Any] = dict(self.mechanism.scene.values)
        for each in self.driven.figures:
            led[each.parameter or each.name] = TracedNumber(self.graph, self.graph.input(each.name))
        return led

    @property
    def inputs(self) -> dict[str, int]:
        """The index of each input: driver, tried values, counting angles, figures."""
        names = [INPUT, *(name for each in self.closings for name in each.names)]
        return {
            name: place
            for place, name in enumerate((*names, *self.fixed_inputs(self.driven.start)))
        }

    def sided(self, program: Program) -> Program:
        """The program, with the closures that the motion takes beyond its change points.

        The number that selects the side of a step then depends on the driver's place. Where another
        closure is constructed by other steps, the page keeps the one that is drawn.
        """
        scene = self.mechanism.scene
        every = [(sides(scene, piece), piece) for piece in self.path.ranges[0]]
        parts = [(own, *part) for own, piece in every for part in turned_over(scene, piece)]
        if all((own, over) == (parts[0][0], parts[0][2]) for own, _, over in parts):
            return program
        turns = range(-MOST_ROUND, MOST_ROUND + 1) if self.path.whole else (0,)
        starts = [turn * self.path.period + low for turn in turns for _, low, _ in parts]
        along = [
            [*on_other_side(Mechanism(replace(scene, branches=own)).program.steps, over)]
            for own, _, over in parts
        ]
        if len({tuple(map(form, steps)) for steps in along}) > 1:
            return program
        steps = list(program.steps)
        for n, same in enumerate(zip(*along, strict=True)):
            extra = same[0].extra
            if all(step.extra == extra for step in same):
                continue
            for k, start in enumerate(starts[1:], 1):
                before = self.x < start / self.driven.metres
                pairs = zip(extra, same[k % len(parts)].extra, strict=True)
                extra = tuple(pick(before, *pair) for pair in pairs)
            steps[n] = replace(steps[n], extra=extra)
        return replace(program, steps=tuple(steps))

    def traced(self, drawn: Trace) -> Trace:
        """The steps that were run for a sheet, traced. Raises UntraceableError."""
        program, values = self.sided(drawn.program), self.known
        scaled = dict(self.mechanism.trial_rates)
        if program.seconds is not None and program.seconds in drawn.values:
            scaled[program.seconds] = drawn.values[program.seconds]
        own = {after for number in scaled for after in program.descendants(number)}
        shared = {n: value for n, value in self.done.items() if n not in own}
        overrides = scaled | self.closers(drawn) | shared
        overrides |= self.driven.overrides(program, self.x, values) | self.trace_counted(drawn)
        overrides = {n: value for n, value in overrides.items() if n in drawn.values}
        needed = sorted(drawn.values)
        overrides |= self.tried_rates(drawn, needed, overrides)
        ready = made_ready(program, needed, values, needed, frozenset(overrides))
        trace = run_moving(ready, values, traced_kind(), margins=True, overrides=overrides)
        self.done.update(trace.values)
        self.margins.update(trace.margins)
        self.add_closings(drawn, trace)
        return trace

    def tried_rates(
        self, drawn: Trace, needed: Sequence[int], overrides: Mapping[int, Any]
    ) -> dict[int, Any]:
        """The trial rates, traced so that their plans keep their size next to the right plan."""
        chosen = {n: v for n, v in self.mechanism.trial_rates.items() if n in drawn.values}
        if not chosen:
            return {}

        def run(rates: Mapping[int, Any]) -> Mapping[int, Any]:
            led = {**overrides, **rates}
            ready = made_ready(drawn.program, needed, self.known, needed, frozenset(led))
            return run_moving(ready, self.known, traced_kind(), overrides=led).values

        return followed_rates(drawn.program, drawn.values, chosen, run)

    # --- links that only their pins turn ---------------------------------------------------------

    @cached_property
    def sweep(self) -> Sweep:
        """The sweep of the driver, as far as the page shows."""
        if self.driven.what != "time":
            return sweep_of(self.mechanism.scene, driver=self.driven.number)
        low, high = window(self.driven)
        return sweep_of(self.mechanism.scene, low=low, high=high)

    @cached_property
    def path(self) -> Path:
        """The ranges of the driver, with the branches followed on them."""
        return reachable_ranges(self.sweep)

    @cached_property
    def turned(self) -> Turned | None:
        """The angles turned by these links, with positions in the driver's unit."""
        turned = through(self.path.ranges[0])
        return None if turned is None else Turned(turned.at / self.driven.metres, turned.near)

    def trace_counted(self, drawn: Trace) -> dict[int, Any]:
        """The steps that hold the angles near which these links count, traced."""
        found: dict[int, Any] = {}
        for number in drawn.values:
            step = drawn.program.steps[number]
            link = counted_link(step)
            if link is None or self.turned is None or link not in self.turned.near:
                continue
            name = name_of(link)
            self.counting[name] = link
            self.tape.inputs |= self.counting_angles(self.driven.start)
            angle = TracedNumber(self.graph, self.graph.input(name))
            _, heading, near = step.args
            found |= {heading: traced_kind().direction(angle), near: angle * (pi / 180)}
        return found

    def counting_angles(self, at: Any) -> dict[str, Any]:
        """The angles near which links count their turns at driver positions, by input."""
        every = self.turned.values(at) if self.counting and self.turned is not None else {}
        return {name: every[name] for name in self.counting}

    def fixed_inputs(self, at: Any) -> dict[str, Any]:
        """The inputs that no closing sets: counting angles and figures as drawn."""
        return {
            **self.counting_angles(at),
            **{each.name: at * 0 + each.start for each in self.driven.figures},
        }

    # --- groups of higher class ----------------------------------------------------------------

    def closers(self, drawn: Trace) -> dict[int, Any]:
        """The steps that close groups, with traced inputs in their place."""
        found = {}
        for number, closer in closing_steps(drawn):
            names = names_of(number, closer)
            state = drawn_state(closer, drawn.values[number])
            self.tape.inputs.update(zip(names, state, strict=True))
            found[number] = tried(names, self.graph, closer)
        return found

    def add_closings(self, drawn: Trace, trace: Trace) -> None:
        """Add the closings of groups that no earlier sheet has, traced on the known values."""
        steps = trace.program.steps
        for number, closer in closing_steps(drawn):
            names = names_of(number, closer)
            if any(each.names == names for each in self.closings):
                continue
            known = [trace.values[arg] for arg in steps[number].args]
            kind = construction(steps[number])
            assert isinstance(kind, ClosedGroup)
            state = drawn.values[number]
            each = closing(names, self.tape, closer, known, state, kind.closes)
            self.closings.append(each)
            parts = (later for later in trace.values if number in steps[later].args)
            self.margins.update({n: each.sine for n in parts if steps[n].extra[0] < each.count})

    # --- the range -----------------------------------------------------------------------------

    def closed(self, trace: Trace, size: float) -> list[int]:
        """The outputs that are finite where the mechanism closes.

        They are the places of all points, and for each bar the square root of its remaining
        tolerance of length, which idle links may exceed.
        """
        places = {
            of: self.tape.lifted(trace.values[number])
            for (quantity, of), number in trace.program.targets.items()
            if quantity == "position" and number in trace.values
        }
        found: set[int] = set()
        for point in places.values():
            if self.moves(point):
                first = self.tape.point(point)
                found |= {first, first + 1}
        scene = self.mechanism.scene
        changed = {each.parameter for each in self.driven.figures}
        for link in scene.links.values():
            if any(changed & quantity.uses() for quantity in quantities_within(link.placings)):
                continue  # the figures set the lengths of its bars
            kept = (name for name in link.points if name not in scene.cam_centres)
            points = [places[name] for name in kept if name in places]
            for point in points[1:]:
                length = abs(point - points[0])
                if self.moves(length):
                    off = abs(length - float(self.tape.now(length)))
                    found.add(self.tape.number((SLACK * size - off).do("sqrt")))
        return sorted(found)

    def moves(self, value: TracedNumber) -> bool:
        """Whether a number or point is not constant."""
        nodes = (value.node, value.imag.node)
        return any(self.graph.constant(node) is None for node in nodes)

    def reached(self, closed: Sequence[int]) -> tuple[Reach, TrackedBranch] | None:
        """The range and the course of the groups through it; None where nothing moves."""
        if self.closings:
            return around(self.path, self.driven, self.sweep.start, self.closings)
        outputs = [self.tape.outputs[i] for i in closed]
        reach = reach_of(self.driven, self.graph, outputs, self.fixed_inputs)
        if reach is not None and self.sweep.whole and self.path.whole:
            first, turns = TURN * floor(self.driven.start / TURN), self.path.turns
            back = 1 <= turns <= MOST_TURNS
            reach = Reach(first, first + TURN * (turns if back else 1), back)
        elif reach is not None and self.driven.what != "time":
            low, high = (end / self.driven.metres for end in self.path.spans[0])
            reach = Reach(max(reach.low, low), min(reach.high, high), False)
        return None if reach is None else (reach, TrackedBranch())


def closing_steps(trace: Trace) -> Iterator[tuple[int, Any]]:
    """The steps that close groups of higher class, in order, each with its closer."""
    for number in sorted(trace.values):
        closer = closer_of(trace.program.steps[number])
        if closer is not None:
            yield number, closer


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
