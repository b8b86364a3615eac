"""The positions at which methods are compared: around the scene's own, or on the way to an end.

Every method gets the very same numbers: each driver's position, speed and acceleration as doubles
that single precision holds too, so that an error tells of the reckoning and not of what enters.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Literal, NamedTuple

import numpy as np
from msgspec import Struct

from graphkin.motion.course import Course, Reals
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import Path, Piece, reachable_ranges
from graphkin.motion.sweep import Sweep, inputs, sweep_of
from graphkin.scene.model import Scene
from graphkin.text.errors import ClosureError, Problem

AROUND = {"turn": 60.0}
"""How far to both sides of the scene's own position a driver is moved: degrees."""
SHARE = 0.25
"""The same for a driver along a line, and for the time: a share of its range."""
TRIED = 240
"""Positions tried on the way to both sides."""
STEEP = 0.1
"""Sine of crossing below which a position belongs to the picture of dead points."""
FIRST = 0.3
"""Share of the way from the scene to the end of its range at which the approach begins."""
ULPS = 64
"""Units in the last place of a driver's position that are left at the end of an approach."""
SURELY = 1e-8
"""The distance of the last positions, in parts of that of the first, at change points, where a sine
falls as the distance and not as its root, and where an end is known to few digits."""
APART = 0.2
"""How far the positions of one distance lie apart, as a share of that distance."""

End = Literal["dead", "change", "range"]


class ComparedPositions(Struct, frozen=True, eq=False):
    """Positions that one choice of closures reaches, with every driver's motion there.

    ``at`` (P,) is the driver's position in degrees or metres, or the time in seconds; ``values``
    holds arrays (P,) for what differs between them, exact numbers for what does not.
    """

    course: Course
    at: Reals
    values: Mapping[str, Any]

    def exactly(self, number: int) -> dict[str, Any]:
        """The values of one position as exact numbers."""
        return {name: exact(value, number) for name, value in self.values.items()}

    def some(self, rows: Any) -> ComparedPositions:
        """Some of the positions, by their numbers."""
        cut = {n: v[rows] if hasattr(v, "shape") else v for n, v in self.values.items()}
        return ComparedPositions(self.course, self.at[rows], cut)

    def repeated(self, count: int) -> dict[str, Any]:
        """The values as arrays of a length, the positions over and over."""
        return {
            name: np.resize(value, count) if hasattr(value, "shape") else value
            for name, value in self.values.items()
        }


def exact(value: Any, number: int) -> Any:
    """The exact number that a value of one position is."""
    if hasattr(value, "shape"):
        return Fraction(float(value[number]))
    return Fraction(value) if isinstance(value, float) else value


class Ground(Struct, frozen=True, eq=False):
    """A scene's sweep with its reachable ranges, and where on it the scene stands."""

    sweep: Sweep
    path: Path
    centre: float

    @property
    def piece(self) -> Piece:
        """The piece of the scene's own range in which it stands, or the nearest."""
        return min(self.path.ranges[0], key=lambda piece: outside(piece, self.centre))


def ground_of(scene: Scene) -> Ground:
    """Where a scene can move; raises ClosureError where it closes nowhere."""
    sweep = sweep_of(scene)
    centre = sweep.stands
    path = reachable_ranges(sweep)
    low, high = path.spans[0]
    if sweep.what == "turn":
        centre += TURN * round(((low + high) / 2 - centre) / TURN)
    return Ground(sweep, path, min(max(centre, low), high))


def outside(piece: Piece, place: float) -> float:
    """How far a place lies from a piece; nought within it."""
    return max(piece.low.at - place, place - piece.high.at, 0.0)


def placed(course: Course, at: Reals, *, single: bool = True) -> ComparedPositions:
    """Positions at given places of a course; ``single`` rounds all that moves to float32."""
    rounded = np.float32(at).astype(float) if single else np.asarray(at, dtype=float)
    values = course.values(rounded)
    if single:
        values |= {name: in_single(values[name]) for name in inputs(course.scene)}
    return ComparedPositions(course, rounded, values)


def in_single(value: Any) -> Any:
    """The number of single precision next to a double, as a double again."""
    near = np.float32(value).astype(float)
    return near if hasattr(value, "shape") else float(near)


def places_around(ground: Ground, count: int) -> ComparedPositions:
    """Evenly spread positions around the scene's own, where no crossing is flat.

    Within 60 degrees or a quarter of the range to both sides, within the piece of the range that
    has the scene's closures, as far as every crossing keeps a sine of 0.1, or half its own.
    """
    piece, centre = ground.piece, ground.centre
    wide = piece.high.at - piece.low.at
    far = AROUND.get(ground.sweep.what, SHARE * wide)
    low, high = max(piece.low.at, centre - far), min(piece.high.at, centre + far)
    ends = [walked(piece.course, centre, end) for end in (low, high)]
    first, last = ends if ends[0] < ends[1] else (low, high)
    return placed(piece.course, first + (np.arange(count) + 0.5) * (last - first) / count)


def walked(course: Course, start: float, end: float) -> float:
    """How far one can go from a start to an end before a crossing is too flat."""
    way = np.linspace(start, end, TRIED + 1)
    sines = np.asarray(course.margins(way).min(axis=0))
    least = min(STEEP, sines[0] / 2) if np.isfinite(sines[0]) else STEEP
    bad = np.flatnonzero(~(sines[1:] >= least))
    return float(way[bad[0]] if bad.size else way[-1])


class Approach(Struct, frozen=True, eq=False):
    """Positions on the way to a dead point or change point, in groups of equal distance.

    ``end`` says to what; "range" where there is neither, and the places run through the range.
    ``goal`` is its place on the sweep, None without one.
    """

    places: ComparedPositions
    group: Any
    end: End
    goal: float | None


def approach(ground: Ground, groups: int, each: int, share: float = 0.0) -> Approach:
    """The way to the nearest dead point of the scene's range, or else to a change point.

    The distances fall evenly in their logarithm down to a ``share`` of the first of them, or to
    the last digits of a double. Raises ClosureError where the driver cannot move.
    """
    kinds: tuple[End, ...] = ("dead", "change")
    for kind in kinds:
        ends = [
            (abs(event.at - ground.centre), event.at, way, piece)
            for piece in ground.path.ranges[0]
            for event, way in ((piece.low, 1.0), (piece.high, -1.0))
            if event.kind == kind
        ]
        if ends:
            _, goal, way, piece = min(ends, key=lambda each: each[:3])
            return towards(EndSearch(piece, goal, way, share), groups, each, kind)
    piece = ground.piece
    low, high = piece.low.at, piece.high.at
    if not low < high:
        raise ClosureError(Problem("accuracy", "the driver cannot move", "a range to move in"))
    count = groups * each
    at = low + (np.arange(count) + 0.5) * (high - low) / count
    return Approach(placed(piece.course, at, single=False), np.arange(count), "range", None)


class EndSearch(NamedTuple):
    """A piece with the end that is sought, the sense away from it, and where to stop."""

    piece: Piece
    goal: float
    sense: float
    share: float


def towards(way: EndSearch, groups: int, each: int, kind: End) -> Approach:
    """Places of a piece at ever smaller distances from its end, so many at each."""
    piece, goal = way.piece, way.goal
    far = FIRST * (piece.high.at - piece.low.at)
    share = max(way.share, SURELY if kind == "change" or piece.course.is_searched else 0.0)
    near = max(ULPS * float(np.spacing(abs(goal) + far)), share * far)
    distance = np.geomspace(far, near, groups)
    spread = 1 - APART * np.arange(each) / each
    at = goal + way.sense * (distance[:, None] * spread).ravel()
    group = np.repeat(np.arange(groups), each)
    return Approach(placed(piece.course, at, single=False), group, kind, goal)
