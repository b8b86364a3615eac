"""The moments of a motion that an animation shows, each constructed anew.

The moments begin at the scene's position and follow the sense of the driver's speed, so that every
point moves as its velocity says. A full turn is shown once round; a range between dead points or a
time is shown from end to end; then the animation repeats. Near a dead point a driver at constant
speed makes velocities and accelerations grow without bound, so the animation stops short of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.quantities import SHEETS
from graphkin.construction.core.solution import UNPROVED
from graphkin.documents.scaling import drawing, natural_seconds, targets_of
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.driving import TURN
from graphkin.numbers.arithmetic import np
from graphkin.scene.expression import TIME
from graphkin.text import Words
from graphkin.text.errors import GraphkinError, Problem, SceneError, message

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle
    from graphkin.motion.pieces import Piece

FRAMES = 72
"""Pictures for a full turn or for a time; a range has half as many."""
MOST_TURNS = 4
"""Largest number of turns in a cycle that are all shown; of a longer cycle one turn is shown."""
GROWN = 3.0
"""Limit of rates near a dead point, in medians of the motion; the animation ends beyond it."""
LEAST, LITTLE = 4, 1e-4
"""Least number of moments of a motion, and the least part of the sweep that counts as a motion."""


class Frame(Struct, frozen=True):
    """The mechanism at one place of its driver (degrees, metres) or at one time (s).

    ``drawings`` are the plans that the scene asks for, by kind; ``alone`` is the position without
    any plan.
    """

    at: float
    drawings: dict[str, Drawing]
    alone: Drawing


class FrameSequence(Struct, frozen=True):
    """The moments of an animation in ascending order, and the order in which they are shown.

    The scene's own position is shown first if it lies in the range. The animation shows ``low`` to
    ``high``, a part of the full range ``reached``.
    """

    cycle: Cycle
    moments: tuple[Frame, ...]
    order: tuple[int, ...]
    low: float
    high: float
    reached: tuple[float, float]

    @property
    def shortened(self) -> bool:
        """Whether the animation ends short of the ends of the range."""
        slack = 1e-6 * (self.reached[1] - self.reached[0])
        return self.low > self.reached[0] + slack or self.high < self.reached[1] - slack


def motion(cycle: Cycle, words: Words, frames: int = FRAMES) -> FrameSequence:
    """The moments of a cycle, constructed one by one in the assembly mode that holds there.

    Raises SceneError where nothing can move.
    """
    reached = cycle.ranges[0]
    if reached[1] - reached[0] < LITTLE * (cycle.sweep.high - cycle.sweep.low):
        raise SceneError(at_rest(cycle))
    low, high = shown_range(cycle)
    places, order = (
        in_order(round_about(cycle, frames))
        if goes_round(cycle) and cycle.path.returns
        else end_to_end(cycle, low, high, frames)
    )
    order = order if not cycle.sweep.runs_backwards else [*order[:1], *order[:0:-1]]
    found = [moment_at(cycle, place, words) for place in places]
    kept = [i for i, moment in enumerate(found) if moment is not None]
    if len(kept) < LEAST:
        raise SceneError(at_rest(cycle))
    numbers = {old: new for new, old in enumerate(kept)}
    some = [moment for moment in found if moment is not None]
    shown = tuple(numbers[i] for i in order if i in numbers)
    start = some[shown[0]].alone
    moments = tuple(replace(m, alone=replace(m.alone, chosen=start)) for m in some)
    return FrameSequence(cycle, moments, shown, low, high, reached)


def at_rest(cycle: Cycle) -> Problem:
    """The problem of a driver that has no range to move in."""
    low, high = cycle.ranges[0]
    found = message(
        "closes from {low:.6g} to {high:.6g} {unit}, too little to be moved",
        low=low,
        high=high,
        unit=cycle.sweep.unit,
    )
    return Problem(
        message("the animation"),
        found,
        message("a driver that moves"),
        message("graphkin check shows the range"),
    )


def in_order(places: list[float]) -> tuple[list[float], list[int]]:
    return places, list(range(len(places)))


def round_about(cycle: Cycle, frames: int) -> list[float]:
    """The driver's places over its full cycle from the scene's position, ``frames`` for each turn.

    A cycle of many turns is cut to its first turn.
    """
    turns = cycle.path.turns if cycle.path.turns <= MOST_TURNS else 1
    return [cycle.sweep.start + TURN * i / frames for i in range(turns * frames)]


def goes_round(cycle: Cycle) -> bool:
    """Whether the driver turns fully."""
    return cycle.sweep.whole and cycle.path.whole


def end_to_end(cycle: Cycle, low: float, high: float, frames: int) -> tuple[list[float], list[int]]:
    """The places of a range, a time, or a turn that does not close, and the order to show them in.

    They run from the scene's position to the end, then from the beginning.
    """
    start = min(max(place_in(cycle, low, high), low), high)
    once = cycle.sweep.what == "time" or goes_round(cycle)
    step = (high - low) / frames * (1 if once else 2)
    below, above = (max(round(way / step), 1) for way in (start - low, high - start))
    below, above = (below if start > low else 0), (above if high > start else 0)
    places = [low + (start - low) * i / below for i in range(below)]
    places += [start + (high - start) * i / above for i in range(above)]
    places.append(high)
    return places, [*range(below, len(places)), *range(below)]


def place_in(cycle: Cycle, low: float, high: float) -> float:
    """The scene's position in a range, up to whole turns; for a time, the drawing's time."""
    start = cycle.sweep.start
    if cycle.sweep.what == "time":
        return float(cycle.scene.values.get(TIME, start))
    return cycle.path.found_at(start, low, high)


def shown_range(cycle: Cycle) -> tuple[float, float]:
    """The range of the scene, cut where rates grow without bound towards a dead point."""
    pieces = cycle.path.ranges[0]
    low, high = pieces[0].low.at, pieces[-1].high.at
    rows = (cycle.piece <= len(pieces)) & (cycle.piece > 0)
    at = cycle.at[rows]
    if len(at) < LEAST:
        return low, high
    grown = np.zeros(len(at))
    for name in SHEETS:
        rates = [getattr(point, name) for point in cycle.solution.points.values()]
        sizes = [np.abs(np.broadcast_to(r, len(rows))[rows]) for r in rates if r is not None]
        largest = np.max(sizes, axis=0) if sizes else grown
        usual = float(np.median(largest))
        grown = np.maximum(grown, largest / usual if usual > 0 else 0)
    calm, middle = grown <= GROWN, place_in(cycle, low, high)
    inner = at[~calm & (at < middle)], at[~calm & (at > middle)]
    if pieces[0].low.kind == "dead" and inner[0].size:
        low = float(at[at > inner[0].max()].min(initial=middle))
    if pieces[-1].high.kind == "dead" and inner[1].size:
        high = float(at[at < inner[1].min()].max(initial=middle))
    if not low < high:  # rates are already too large at the scene's position
        low, high = pieces[0].low.at, pieces[-1].high.at
    return clear_of_ends(cycle, low, high)


def clear_of_ends(cycle: Cycle, low: float, high: float) -> tuple[float, float]:
    """A range without its dead points, where a construction may have no intersection."""
    pieces = cycle.path.ranges[0]
    room = 1e-3 * (pieces[-1].high.at - pieces[0].low.at)
    first, last = pieces[0].low, pieces[-1].high
    low = max(low, first.at + room) if first.kind == "dead" else low
    high = min(high, last.at - room) if last.kind == "dead" else high
    return low, high


def moment_at(cycle: Cycle, place: float, words: Words) -> Frame | None:
    """The construction at one place; None outside the range or where a step cannot be drawn."""
    piece, within = piece_at(cycle, place)
    if piece is None:
        return None
    mechanism = piece.course.mechanism(within)
    try:
        scales = Scales(1.0, natural_seconds(mechanism), triangles=False)
        drawings = {
            kind: made(mechanism, kind, targets, scales, words)
            for kind in SHEETS
            if (targets := targets_of(mechanism, kind))
        }
        positions = [t for t in mechanism.program.targets if t[0] == "position"]
        alone = made(mechanism, "velocity", positions, scales, words)
    except GraphkinError:
        return None
    return Frame(place, drawings, alone)


def made(
    mechanism: Mechanism, kind: str, targets: Sequence[Any], scales: Scales, words: Words
) -> Drawing:
    """The drawing of one plan."""
    return drawing(mechanism, kind, tuple(targets), scales, UNPROVED, words)


def piece_at(cycle: Cycle, place: float) -> tuple[Piece | None, float]:
    """The piece that holds a place, up to whole turns, and the place within that piece."""
    for piece in cycle.path.ranges[0]:
        for turn in cycle.path.shifts(place):
            if piece.low.at <= place + turn <= piece.high.at:
                return piece, place + turn
    return None, place
