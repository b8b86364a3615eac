"""The positions of a mechanism over its motion: equal steps of the driver, and dead points.

Places come from one batch in the closures that hold there. The plans of each position are
constructed by hand, and the vector loops check every position before anything is drawn.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import degrees, floor, log10
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.construction.core.component import as_drawn
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import PLACES, Target
from graphkin.construction.core.quantities import (
    QUANTITIES,
    SHEETS,
    MotionQuantity,
    names_asked,
)
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import FAIR, Verdict
from graphkin.documents.scaling import natural_seconds, targets_of, the_crank
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.course import Reals
from graphkin.motion.cycle import Cycle, columns_at, cycle_at
from graphkin.motion.driving import TURN
from graphkin.motion.equal_positions import Start, equal_places, sense_of
from graphkin.motion.follower_limits import Follower, followers, is_to_and_fro
from graphkin.motion.pieces import reachable_ranges
from graphkin.motion.sweep import sweep_of
from graphkin.scene.link_points import lettered, point_of
from graphkin.scene.model import StatedPositions
from graphkin.scene.quantity import Quantity, shortest
from graphkin.scene.requests import FEWEST_STEPS, MOST_STEPS
from graphkin.structure.groups import ROMAN
from graphkin.text import Words
from graphkin.text.errors import GraphkinError, Problem, SceneError, WitnessError, message

SAMPLES = 360
"""Places on the path of a point."""
ALIKE = 1e-6
"""Distance of two places of the driver, as a share of its range, below which they are one."""
MOVED = ("position", "slide")
"""Targets of a batch of positions that move with the driver."""
BELOW = 1e-3
"""Degrees below its low limit at which the angle of a link still counts from there."""


class Position(Struct, frozen=True):
    """The mechanism at one place u of its driver: degrees, metres or seconds.

    ``name`` is its number, or a Roman numeral for a dead point between the numbered positions.
    ``also`` is the numeral of a dead point at a numbered position. ``plans`` are its plans by kind;
    there are none at a dead point of the driver, where velocities have no bound.
    """

    name: str
    at: float
    alone: Drawing
    plans: Mapping[str, Drawing]
    also: str = ""


class PositionSet(Struct, frozen=True, dict=True):
    """The numbered positions of a motion, its dead points, and the follower whose stroke is shown.

    ``dead`` are the dead points between the numbered positions. ``strong`` is the number of the
    position that is drawn strongly, and ``difference`` the largest of the residual check.
    """

    cycle: Cycle
    wanted: StatedPositions
    numbered: tuple[Position, ...]
    dead: tuple[Position, ...]
    strong: int
    follower: Follower | None
    difference: float

    @property
    def every(self) -> tuple[Position, ...]:
        """The numbered positions, then the dead points."""
        return (*self.numbered, *self.dead)

    @property
    def shown(self) -> Position:
        """The position that is drawn strongly."""
        return self.numbered[self.strong]

    def planned(self, kind: str) -> list[Position]:
        """The numbered positions that have a plan of a kind on the sheets."""
        chosen = self.wanted.accelerations if kind == SHEETS[1] else None
        numbers = range(len(self.numbered)) if chosen is None else chosen
        return [p for i in numbers if kind in (p := self.numbered[i]).plans]

    @property
    def is_bounded(self) -> bool:
        """Whether the driver has no dead point, next to which rates grow without bound."""
        pieces = self.cycle.path.ranges[0]
        return "dead" not in (pieces[0].low.kind, pieces[-1].high.kind)

    @cached_property
    def planned_places(self) -> Reals:
        """The places of the driver with plans; a turn ends at the place where it begins."""
        places = [each.at for each in self.numbered if each.plans]
        if is_whole(self.cycle):
            places.append(places[0] + sense_of(self.cycle) * self.cycle.path.period)
        return np.array(places)

    @cached_property
    def moving(self) -> tuple[str, ...]:
        """The points of links that move, in the order of the scene."""
        places = np.array([[*each.alone.positions.values()] for each in self.numbered])
        size = self.shown.alone.reach
        return tuple(
            name
            for name, path in zip(self.shown.alone.positions, places.T, strict=True)
            if np.abs(path - path[0]).max() > ALIKE * size
            and name not in self.cycle.scene.cam_centres
        )

    @cached_property
    def paths(self) -> Mapping[str, tuple[complex, ...]]:
        """The path of every moving point over the range, closed if the motion recurs."""
        low, high = self.cycle.ranges[0]
        angles = np.linspace(0, np.pi, SAMPLES + 1)
        whole = is_whole(self.cycle)
        at = np.linspace(low, high, SAMPLES + 1)
        at = at if whole else (low + high) / 2 - (high - low) / 2 * np.cos(angles)
        targets = [("position", name) for name in self.moving]
        found = columns_at(self.cycle.sweep, self.cycle.path, at, targets, near=0.0).columns
        rows = {name: found["position", name] for name in self.moving}
        known = {name: row[np.isfinite(row)] for name, row in rows.items()}
        return {name: tuple(complex(z) for z in row) for name, row in known.items()}


def is_whole(cycle: Cycle) -> bool:
    """Whether the driver turns fully and the motion then recurs."""
    return cycle.path.whole and cycle.path.returns


def positions_of(mechanism: Mechanism, words: Words) -> PositionSet:
    """The positions that a scene states, each with its plans, checked by the vector loops.

    Raises SceneError for numbers of positions that do not exist, and for a start without a dead
    point. Raises WitnessError where the independent route disagrees.
    """
    wanted = mechanism.scene.positions
    targets = [t for t in mechanism.program.targets if t[0] in MOVED]
    targets += rates_of(mechanism)
    sweep = sweep_of(mechanism.scene)
    path = reachable_ranges(sweep)
    middle = np.array([sum(path.spans[0]) / 2])
    moved = cycle_at(mechanism, sweep, path, middle, tuple(targets))
    at = equal_places(moved, count_of(mechanism), start_of(mechanism), "positions.start")
    refuse_numbers(wanted, len(at))
    few = moved.along(at)
    travel = next(filter(is_to_and_fro, reversed(followers(moved))), None)
    ends = dead_places(moved, travel)
    named = {nearest: name for name, nearest in also_at(at, ends, moved)}
    between = [(name, u) for name, u in ends if name not in named.values()]
    difference = checked(few)
    places = [(str(i), float(u)) for i, u in enumerate(at)]
    planned = set(np.round(few.at[few.solution.margin >= FAIR], 9))
    found = drawn(moved, [*places, *between], words)
    seconds = pace_of(mechanism)
    numbered = tuple(
        Position(
            *(name, u, alone, plans_at(moved, u, seconds, words) if round(u, 9) in planned else {}),
            also=named.get(i, ""),
        )
        for i, ((name, u), alone) in enumerate(zip(places, found, strict=False))
    )
    dead = tuple(
        Position(name, u, alone, {})
        for (name, u), alone in zip(between, found[len(places) :], strict=True)
    )
    own = moved.path.found_at(moved.sweep.at_scene, float(at.min()), float(at.max()))
    nearest = int(np.abs(at - own).argmin())
    strong = nearest if wanted.strong is None else wanted.strong
    return PositionSet(moved, wanted, numbered, dead, strong, travel, difference)


def rates_of(mechanism: Mechanism) -> list[Target]:
    """The velocities and accelerations that the plans of a scene answer."""
    every = dict.fromkeys(t for kind in SHEETS for t in targets_of(mechanism, kind))
    rates = {q.target for q in QUANTITIES if q.kind in SHEETS and q.sort in ("vector", "number")}
    return [target for target in every if target[0] in rates]


def count_of(mechanism: Mechanism) -> int:
    """The number of equal steps. Raises SceneError where a formula gives no allowed number."""
    count = mechanism.scene.positions.count
    if isinstance(count, int):
        return count
    value = count.number(mechanism.scene.values)
    if value != int(value) or not FEWEST_STEPS <= value <= MOST_STEPS:
        expected = message(
            "a whole number from {least} to {most}", least=FEWEST_STEPS, most=MOST_STEPS
        )
        found = message("{text} gives {value}", text=count.text, value=shortest(value))
        raise SceneError.at("positions.count", found, expected)
    return int(value)


def start_of(mechanism: Mechanism) -> Start | float:
    """The place from which positions are counted: a word, or a u."""
    start = mechanism.scene.positions.start
    if not isinstance(start, Quantity):
        return start
    number = float(start.si(mechanism.scene.values))
    return degrees(number) if start.unit in ("deg", "rad") else number


def refuse_numbers(wanted: StatedPositions, count: int) -> None:
    """Raise SceneError for numbers of positions that do not exist."""
    stated = {"positions.strong": wanted.strong}
    stated |= {f"positions.accelerations[{i}]": n for i, n in enumerate(wanted.accelerations or ())}
    wrong = [(place, n) for place, n in stated.items() if n is not None and n >= count]
    if wrong:
        most = message("0 to {most}", most=count - 1)
        raise SceneError(
            Problem(place, message("there is no position {number}", number=number), most)
            for place, number in wrong
        )


def dead_places(moved: Cycle, travel: Follower | None) -> list[tuple[str, float]]:
    """The dead points of the driver in the range, and the limits of a follower, with numerals."""
    pieces = moved.path.ranges[0]
    own = [end.at for end in (pieces[0].low, pieces[-1].high) if end.kind == "dead"]
    limits = [] if travel is None else [travel.low, travel.high]
    ends = [*own, *(each.at for each in limits if not each.edge)]
    apart = ALIKE * (moved.ranges[0][1] - moved.ranges[0][0])
    every: list[float] = []
    for u in sorted(ends):
        if not every or u - every[-1] > apart:
            every.append(u)
    return list(zip(ROMAN[1:], every, strict=False))


def also_at(
    at: Reals, ends: Iterable[tuple[str, float]], moved: Cycle
) -> Iterator[tuple[str, int]]:
    """The dead points that are numbered positions, with the indices of these."""
    apart = ALIKE * (moved.ranges[0][1] - moved.ranges[0][0])
    for name, u in ends:
        shifts = moved.path.shifts(u)
        off = np.min([np.abs(np.asarray(at) - u - shift) for shift in shifts], axis=0)
        if off.min() <= apart:
            yield name, int(off.argmin())


def checked(few: Cycle) -> float:
    """The largest difference of the residual check. Raises WitnessError where it disagrees."""
    found = few.witnessed
    if found.refused:
        raise WitnessError.at("positions", message("the vector loops cannot check them"))
    fair = few.solution.margin >= FAIR
    if not (found.agrees | ~fair).all():
        place = f"positions[{int(np.flatnonzero(~found.agrees & fair)[0])}]"
        difference = f"{found.largest:.1e}"
        wrong = message(
            "construction and vector loops differ by {difference}", difference=difference
        )
        raise WitnessError.at(place, wrong, hint=message("no sheet is handed out"))
    known = found.difference[fair & np.isfinite(found.difference)]
    return float(known.max(initial=0.0))


def pace_of(mechanism: Mechanism) -> float:
    """The time in s in which vectors are as long as the crank, or as large as the mechanism."""
    crank = the_crank(mechanism)
    return 1 / crank if crank else natural_seconds(mechanism)


def drawn(moved: Cycle, places: Sequence[tuple[str, float]], words: Words) -> list[Drawing]:
    """The mechanism at each place without plans, dead points included, from one batch a piece."""
    found: dict[int, Drawing] = {}
    nobody = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    held = [moved.piece_at(u) for _, u in places]
    for piece in moved.path.ranges[0]:
        rows = [i for i, (own, _) in enumerate(held) if own is piece]
        if not rows:
            continue
        at = np.array([held[i][1] for i in rows])
        targets = [t for t in piece.course.program.targets if t[0] in (*MOVED, *PLACES)]
        trace = piece.course.run(at, targets)
        for k, i in enumerate(rows):
            values = {n: entry(value, k) for n, value in trace.values.items()}
            alone = Trace(piece.course.program, values, {})
            scene = piece.course.standing(float(at[k]))
            found[i] = Drawing("velocity", scene, alone, Scales(1.0, 1.0), nobody, words)
    return [found[i] for i in range(len(places))]


def entry(value: Any, k: int) -> Any:
    """One entry of an array, or of each part of a line or a circle; any other value as it is."""
    if isinstance(value, np.ndarray) and value.shape:
        return value[k].item()
    return type(value)(*(entry(part, k) for part in value)) if isinstance(value, tuple) else value


def plans_at(moved: Cycle, place: float, seconds: float, words: Words) -> dict[str, Drawing]:
    """The plans that the scene asks for at a place, each constructed by hand."""
    mechanism = moved.mechanism_at(place)
    scales = Scales(1.0, seconds, of_crank=float(the_crank(moved.mechanism) > 0), triangles=False)
    nobody = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    kinds = {kind: targets_of(mechanism, kind) for kind in SHEETS}
    found: dict[str, Drawing] = {}
    try:
        for kind, targets in kinds.items():
            if targets:
                trace = mechanism.trace(targets, by_hand=True, seconds=seconds, aside=False)
                own = as_drawn(trace, triangles=False)
                found[kind] = Drawing(kind, mechanism.scene, own, scales, nobody, words)
    except GraphkinError:
        return {}
    return found


def numbers_of(found: PositionSet) -> list[str]:
    """The places of the driver at the numbered positions and the dead points, as printed."""
    words, sweep = found.shown.alone.words, found.cycle.sweep
    if sweep.what == "turn":
        period = found.cycle.path.period if is_whole(found.cycle) else 0.0
        return [words.fixed(p.at % period if period else p.at, 1) for p in found.every]
    factor = found.shown.alone.length(1.0) if sweep.is_length else 1.0
    return [words.decimal(f"{p.at * factor:.4g}") for p in found.every]


class ValueRow(Struct, frozen=True):
    """A row of values below the positions, with its symbol and unit; None where there is none."""

    head: str
    values: Sequence[float | None]

    def written(self, words: Words, digits: int) -> list[str]:
        """The values with as many decimals as give the largest some digits."""
        largest = max((abs(each) for each in self.values if each is not None), default=0.0)
        places = max(digits - 1 - floor(log10(largest)), 0) if largest else 0
        return ["–" if each is None else words.fixed(each, places) for each in self.values]


def travel_row(found: PositionSet) -> list[ValueRow]:
    """The way of the follower from its low limit at every position, if it moves to and fro."""
    travel, drawing = found.follower, found.shown.alone
    if travel is None:
        return []
    some = [each.alone for each in found.every]
    if travel.line is not None:
        start, tip = travel.line
        lines = (each.positions[tip] - each.positions[start] for each in some)
        ways = [(degrees(phase(line)) - travel.low.value + BELOW) % TURN - BELOW for line in lines]
        return [ValueRow(f"{drawing.symbol(f'ψ_{travel.name}')} (°)", ways)]
    guides = [
        guide.coordinate
        for each in some
        for guide in each.standing.guideways
        if guide.block == travel.name
    ]
    if len(guides) < len(some):
        return []
    ways = [drawing.length(float(each) - travel.low.value) for each in guides]
    unit = drawing.words.spelled(drawing.scene.units["length"])
    head = f"{drawing.symbol(f's_{travel.name}')} ({unit})"
    return [ValueRow(head, ways)]


def plan_rows(found: PositionSet, kind: str) -> Iterator[ValueRow]:
    """The sizes of the vectors and rates asked of a kind of plan, at every numbered position."""
    plans = [each.plans.get(kind) for each in found.numbered]
    drawing, scene = next(filter(None, plans)), found.cycle.scene
    for quantity in (drawing.vector, drawing.rate):
        for name in names_asked(scene.ask, quantity):
            own = point_of(scene, name) if quantity is drawing.vector else name
            values = [None if plan is None else value_in(plan, quantity, own) for plan in plans]
            sign = drawing.symbol(f"{quantity.letter}_{lettered(own)}")
            head = f"{sign} ({drawing.words.unit(quantity.caret_unit)})"
            yield ValueRow(head, values)


def value_in(drawing: Drawing, quantity: MotionQuantity, of: str) -> float | None:
    """The size of a vector, or a rate with its sign, in one plan."""
    if quantity is drawing.rate:
        return drawing.turning(of)
    value = drawing.trace.value(quantity.target, of)
    return None if value is None else abs(value)


def at_position(name: str, number: str) -> str:
    """The name of a point or a link at a numbered position: A_3, and A_1,3 for A_1."""
    return f"{name}{',' if '_' in name else '_'}{number}"
