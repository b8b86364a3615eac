"""The quantities and positions of a comparison, and the errors against a certified reference."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any, Literal, NamedTuple

import numpy as np
from msgspec import Struct

from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.quantities import KINDS, SLIDING
from graphkin.construction.core.run import StepFailed, run
from graphkin.motion.course import Course, Reals
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import Path, Piece, reachable_ranges
from graphkin.motion.sweep import Sweep, inputs, sweep_of
from graphkin.numbers.arithmetic import is_ball, is_decimal
from graphkin.numbers.kinds import ball_kind, is_real_ball
from graphkin.scene.link_points import is_under
from graphkin.scene.model import Scene
from graphkin.structure.pairs import is_in_scene
from graphkin.text.errors import ClosureError, GraphkinError, WitnessError, message

AROUND = {"turn": 60.0}
"""The distance, in degrees, that a turning driver is moved from the scene's position."""
SHARE = 0.25
"""The same for a driver along a line, and for the time: a share of its range."""
TRIED = 240
"""The number of positions tried to each side."""
STEEP = 0.1
"""The sine of crossing below which a position belongs to the picture of dead points."""
FIRST = 0.3
"""The share of the way from the scene to the end of its range at which the approach begins."""
ULPS = 64
"""The least distance from the end of an approach, in units in the last place."""
SURELY = 1e-8
"""The distance of the last positions at change points, as a share of the first distance.

At a change point a sine falls as the distance and not as its root. The share also holds where an
end is known only to few digits.
"""
APART = 0.2
"""The spread of the positions of one distance, as a share of that distance."""

End = Literal["dead", "change", "range"]


class ComparedPositions(Struct, frozen=True, eq=False):
    """Positions that one choice of closures reaches, with every driver's motion there.

    ``at`` (P,) is the driver's position in degrees or metres, or the time in seconds. ``values``
    holds arrays (P,) for inputs that differ between positions, exact numbers for the others.
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
        """The values as arrays of length ``count``, with the positions repeated."""
        return {
            name: np.resize(value, count) if hasattr(value, "shape") else value
            for name, value in self.values.items()
        }


def exact(value: Any, number: int) -> Any:
    """The exact value at one position."""
    if hasattr(value, "shape"):
        return Fraction(float(value[number]))
    return Fraction(value) if isinstance(value, float) else value


class Ground(Struct, frozen=True, eq=False):
    """A scene's sweep with its reachable ranges, and the scene's own place on it."""

    sweep: Sweep
    path: Path
    centre: float

    @property
    def piece(self) -> Piece:
        """The piece of the range that contains the scene's place, or the nearest piece."""
        return min(self.path.ranges[0], key=lambda piece: outside(piece, self.centre))


def ground_of(scene: Scene) -> Ground:
    """The sweep of a scene; raises ClosureError if the scene does not close."""
    sweep = sweep_of(scene)
    centre = sweep.at_scene
    path = reachable_ranges(sweep)
    low, high = path.spans[0]
    if sweep.what == "turn":
        centre += TURN * round(((low + high) / 2 - centre) / TURN)
    return Ground(sweep, path, min(max(centre, low), high))


def outside(piece: Piece, place: float) -> float:
    """The distance of a place from a piece; zero within it."""
    return max(piece.low.at - place, place - piece.high.at, 0.0)


def placed(course: Course, at: Reals, *, single: bool = True) -> ComparedPositions:
    """Positions at given places of a course; ``single`` rounds all that moves to float32."""
    rounded = np.float32(at).astype(float) if single else np.asarray(at, dtype=float)
    values = course.values(rounded)
    if single:
        values |= {name: in_single(values[name]) for name in inputs(course.scene)}
    return ComparedPositions(course, rounded, values)


def in_single(value: Any) -> Any:
    """The single-precision number next to a double, as a double again."""
    near = np.float32(value).astype(float)
    return near if hasattr(value, "shape") else float(near)


def places_around(ground: Ground, count: int) -> ComparedPositions:
    """Evenly spread positions around the scene's own, where no crossing is flat.

    They lie within 60 degrees or a quarter of the range to each side, and within the piece of the
    range that has the scene's closures. Every crossing keeps a sine of 0.1, or half its own.
    """
    piece, centre = ground.piece, ground.centre
    wide = piece.high.at - piece.low.at
    far = AROUND.get(ground.sweep.what, SHARE * wide)
    low, high = max(piece.low.at, centre - far), min(piece.high.at, centre + far)
    ends = [walked(piece.course, centre, end) for end in (low, high)]
    first, last = ends if ends[0] < ends[1] else (low, high)
    return placed(piece.course, first + (np.arange(count) + 0.5) * (last - first) / count)


def walked(course: Course, start: float, end: float) -> float:
    """The farthest place from ``start`` towards ``end`` before a crossing is too flat."""
    way = np.linspace(start, end, TRIED + 1)
    sines = np.asarray(course.margins(way).min(axis=0))
    least = min(STEEP, sines[0] / 2) if np.isfinite(sines[0]) else STEEP
    bad = np.flatnonzero(~(sines[1:] >= least))
    return float(way[bad[0]] if bad.size else way[-1])


class Approach(Struct, frozen=True, eq=False):
    """Positions on the way to a dead point or change point, in groups of equal distance.

    ``end`` is the kind of end; "range" means neither, and the positions cover the range. ``goal``
    is the place of the end on the sweep, or None.
    """

    places: ComparedPositions
    group: Any
    end: End
    goal: float | None


def approach(ground: Ground, groups: int, each: int, share: float = 0.0) -> Approach:
    """The way to the nearest dead point of the scene's range, or else to a change point.

    The distances decrease evenly in their logarithm, down to a ``share`` of the first or to the
    last digits of a double. Raises ClosureError if the driver cannot move.
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
        raise ClosureError.at(
            "accuracy", message("the driver cannot move"), message("a range to move in")
        )
    count = groups * each
    at = low + (np.arange(count) + 0.5) * (high - low) / count
    return Approach(placed(piece.course, at, single=False), np.arange(count), "range", None)


class EndSearch(NamedTuple):
    """A piece with the end to approach, the sense away from it, and the share at which to stop."""

    piece: Piece
    goal: float
    sense: float
    share: float


def towards(way: EndSearch, groups: int, each: int, kind: End) -> Approach:
    """Places of a piece at ever smaller distances from its end, ``each`` at every distance."""
    piece, goal = way.piece, way.goal
    far = FIRST * (piece.high.at - piece.low.at)
    share = max(way.share, SURELY if kind == "change" or piece.course.is_searched else 0.0)
    near = max(ULPS * float(np.spacing(abs(goal) + far)), share * far)
    distance = np.geomspace(far, near, groups)
    spread = 1 - APART * np.arange(each) / each
    at = goal + way.sense * (distance[:, None] * spread).ravel()
    group = np.repeat(np.arange(groups), each)
    return Approach(placed(piece.course, at, single=False), group, kind, goal)


# --- what is compared -----------------------------------------------------------------------------


BITS = 640
"""The bits of the reference, some two hundred more than any method has."""
ROOM = 64
"""Further bits for the differences."""
STILL = 1e-3
"""The share of v²/L below which the largest acceleration is too small to be a scale."""

Found = Mapping[Target, Any]
"""Values by target, of one position."""


class ComparedTargets(Struct, frozen=True):
    """The targets that are compared, for each of position, velocity and acceleration."""

    targets: tuple[tuple[Target, ...], ...]

    @property
    def every(self) -> tuple[Target, ...]:
        return tuple(target for some in self.targets for target in some)


def answers_of(scene: Scene, program: Program) -> ComparedTargets:
    """All named points and blocks that have all three quantities.

    Equivalent linkages of cams are left out, because other methods do not have them. A point of one
    link under another's (A@3) is left out too: it is a different point at every instant, so that
    its velocity is not the derivative of a position.
    """
    known = program.targets
    found: list[tuple[Target, ...]] = []
    theirs = [SLIDING[kind].target for kind in KINDS]
    points = [p for p in of_all(known, KINDS) if p not in scene.cam_centres]
    blocks = [b for b in of_all(known, theirs) if b not in scene.cam_links]
    for mine, other in zip(KINDS, theirs, strict=True):
        found.append((*((mine, p) for p in points), *((other, b) for b in blocks)))
    return ComparedTargets(tuple(found))


def of_all(known: Mapping[Target, int], quantities: Sequence[str]) -> list[str]:
    """The names that have each of some quantities."""
    names = dict.fromkeys(of for quantity, of in known if quantity == quantities[0])
    return [
        name
        for name in names
        if is_in_scene(name)
        and not is_under(name)
        and all((quantity, name) in known for quantity in quantities)
    ]


class Reference(Struct, frozen=True, eq=False, dict=True):
    """Certified answers at every position, and the scales of their errors.

    ``sizes`` and ``radii`` have the shape (P, 3): the largest distance of two points, the largest
    speed and the largest acceleration, and the largest radius of a ball of each. ``sines`` (P,) are
    those of the flattest crossing. ``places`` are the positions that could be certified, ``kept``
    their indices among the requested ones.
    """

    places: ComparedPositions
    answers: ComparedTargets
    found: Sequence[Found]
    sizes: Reals
    radii: Reals
    sines: Reals
    kept: tuple[int, ...]

    @cached_property
    def needed(self) -> tuple[int, ...]:
        """The steps that all answers need."""
        return self.places.course.program.needed(self.answers.every)

    @cached_property
    def exact_values(self) -> list[dict[str, Any]]:
        """The values of every position as exact numbers."""
        return [self.places.exactly(number) for number in range(len(self.places.at))]

    def missed(self, found: Sequence[Found]) -> Reals:
        """The largest error of each quantity at each position, (P, 3).

        Each is an upper bound, including the reference's own radius. NaN where an answer is
        missing.
        """
        from flint import ctx

        pairs = list(zip(found, self.found, strict=True))
        with ctx.workprec(BITS + ROOM):
            rows = [
                [
                    np.max([error(each.get(t), sure[t]) for t in some], initial=0.0)
                    for some in self.answers.targets
                ]
                for each, sure in pairs
            ]
        return np.array(rows)

    @property
    def scales(self) -> Reals:
        """The largest of each quantity over all positions (3,); 1 for one that is always zero."""
        return sizeable(self.sizes.max(axis=0))

    @property
    def radius(self) -> float:
        """The largest radius of the reference over the largest of its quantity."""
        return float((self.radii.max(axis=0) / self.scales).max())

    def relative(self, missed: Reals) -> tuple[float, float, float]:
        """The largest error of each quantity over all positions and its scale; inf for failures."""
        worst = np.nan_to_num((missed / self.scales).max(axis=0), nan=np.inf, posinf=np.inf)
        return float(worst[0]), float(worst[1]), float(worst[2])


def sizeable(size: Reals) -> Reals:
    """Sizes (…, 3) to divide by: at least STILL·v²/L for an acceleration, and never zero."""
    length, speed, acceleration = (size[..., n] for n in range(3))
    length = np.where(length > 0, length, 1.0)
    acceleration = np.maximum(acceleration, STILL * speed**2 / length)
    stacked = np.stack([length, speed, acceleration], axis=-1)
    return np.where(stacked > 0, stacked, 1.0)


def reference_of(
    places: ComparedPositions, answers: ComparedTargets, bits: int = BITS
) -> Reference:
    """The answers in balls; positions where a ball cannot decide a step are left out.

    Raises WitnessError if no position is left.
    """
    program = places.course.program
    needed = program.needed(answers.every)
    kind = ball_kind(bits)
    crossings = set(places.course.crossings)
    found: list[Found] = []
    sines: list[float] = []
    kept: list[int] = []
    for number in range(len(places.at)):
        try:
            with kind.working():
                trace = run(program, needed, places.exactly(number), kind)
        except (StepFailed, GraphkinError):
            continue
        found.append({target: trace.values[program.targets[target]] for target in answers.every})
        margins = [nearly(m) for n, m in trace.margins.items() if n in crossings]
        sines.append(min(margins, default=1.0))
        kept.append(number)
    if not found:
        raise WitnessError.at(
            "reference",
            message(
                "no position near the scene's own can be certified with {bits} bits", bits=bits
            ),
            message("a position that is not singular within such a ball"),
        )
    sizes = np.array([sizes_of(each, answers) for each in found])
    radii = np.array([radii_of(each, answers) for each in found])
    some = places.some(kept)
    return Reference(some, answers, found, sizes, radii, np.array(sines), tuple(kept))


def nearly(ball: Any) -> float:
    """The double next to the middle of a ball, or to any real number."""
    return float(ball.mid()) if is_ball(ball) else float(ball)


def size(value: Any) -> float:
    """The magnitude of a number of any kind, as a double."""
    return nearly(abs(value))


def sizes_of(found: Found, answers: ComparedTargets) -> list[float]:
    """Largest distance of two points, largest speed, largest acceleration of one position."""
    places = [found[t] for t in answers.targets[0] if t[0] == "position"]
    spread = max((size(p - q) for p, q in combinations(places, 2)), default=0.0)
    rest = [max((size(found[t]) for t in some), default=0.0) for some in answers.targets[1:]]
    return [spread or max((size(p) for p in places), default=0.0), *rest]


def radii_of(found: Found, answers: ComparedTargets) -> list[float]:
    """The largest radius among the balls of each quantity."""
    return [max((radius(found[t]) for t in some), default=0.0) for some in answers.targets]


def radius(value: Any) -> float:
    """The radius of a ball; the circumscribed radius for a complex one; zero if not a ball.

    A ball that is not finite has an infinite radius.
    """
    if not is_ball(value):
        return 0.0
    if not value.is_finite():
        return float("inf")
    parts = (value,) if is_real_ball(value) else (value.real, value.imag)
    return float(np.hypot.reduce([float(part.rad()) for part in parts]))


def error(value: Any, sure: Any) -> float:
    """The largest possible difference of a number from the value in a ball; NaN for no number."""
    ball = None if value is None else as_ball(value)
    if ball is None:
        return float("nan")
    return float(abs(ball - sure).upper())


def as_ball(value: Any) -> Any:
    """A number of any kind as an exact ball; None if it is not finite."""
    from flint import acb, arb, fmpq

    if is_ball(value):
        return value.mid() if is_real_ball(value) else acb(value.real.mid(), value.imag.mid())
    if is_decimal(value) and hasattr(value, "imag") and type(value).__name__ == "mpc":
        return acb(as_ball(value.real), as_ball(value.imag))
    if is_decimal(value):
        if not value.context.isfinite(value):
            return None
        mantissa, exponent = value.man_exp
        return (-1 if value < 0 else 1) * arb(int(mantissa)) * arb(2) ** int(exponent)
    if not np.isfinite(value):
        return None
    if np.iscomplexobj(value):
        return acb(as_ball(value.real), as_ball(value.imag))
    whole = Fraction(*value.as_integer_ratio())
    return arb(fmpq(whole.numerator, whole.denominator))


def rows_of(columns: Mapping[Target, Any], count: int) -> list[Found]:
    """The values of single positions, from arrays or from values that all positions share."""
    arrays = {
        target: v if getattr(v, "shape", ()) else np.full(count, v) for target, v in columns.items()
    }
    return [{target: array[n] for target, array in arrays.items()} for n in range(count)]
