"""What is compared, at which positions, and how far methods are from the reference."""

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
from graphkin.text.errors import ClosureError, GraphkinError, Problem, WitnessError

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


# --- what is compared -----------------------------------------------------------------------------


BITS = 640
"""Bits of the reference: some two hundred more than any method has."""
ROOM = 64
"""Further bits for the differences."""
STILL = 1e-3
"""Share of v²/L below which the largest acceleration is not taken seriously as a scale."""

Found = Mapping[Target, Any]
"""Values by target, of one position."""


class ComparedTargets(Struct, frozen=True):
    """The targets that are compared, for each of position, velocity and acceleration."""

    targets: tuple[tuple[Target, ...], ...]

    @property
    def every(self) -> tuple[Target, ...]:
        """All of them."""
        return tuple(target for some in self.targets for target in some)


def answers_of(scene: Scene, program: Program) -> ComparedTargets:
    """All named points and blocks that have all three quantities.

    Equivalent linkages of cams are left out: other routes know nothing of them.
    A point of one link under another's (A@3) is left out: it is another one at every instant, so
    that its velocity is not the derivative of a position.
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
    """Certified answers at every position, and what errors are counted in.

    ``sizes`` and ``radii`` have the shape (P, 3): largest distance of two points, largest speed,
    largest acceleration, and the largest radius of a ball of each. ``sines`` (P,) are those of the
    flattest crossing of the positions. ``places`` are those that could be certified, ``kept`` their
    numbers among those that were asked.
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

        Each is an upper bound: the reference's own radius is in it. NaN where an answer is missing.
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
        """The largest of each quantity over all positions (3,); 1 for what is nought throughout."""
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
    """Sizes (…, 3) to divide by: an acceleration beside v²/L counts at least a little of that."""
    length, speed, acceleration = (size[..., n] for n in range(3))
    length = np.where(length > 0, length, 1.0)
    acceleration = np.maximum(acceleration, STILL * speed**2 / length)
    stacked = np.stack([length, speed, acceleration], axis=-1)
    return np.where(stacked > 0, stacked, 1.0)


def reference_of(
    places: ComparedPositions, answers: ComparedTargets, bits: int = BITS
) -> Reference:
    """The answers in balls; positions where a ball does not tell the step are left out.

    Raises WitnessError where none is left.
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
        raise WitnessError(
            Problem(
                "reference",
                f"no position near the scene's own can be certified with {bits} bits",
                "a position that is not singular within such a ball",
            )
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
    """The radius of a ball, of a complex one that of the circle about its box; inf for no ball."""
    if not is_ball(value):
        return 0.0
    if not value.is_finite():
        return float("inf")
    parts = (value,) if is_real_ball(value) else (value.real, value.imag)
    return float(np.hypot.reduce([float(part.rad()) for part in parts]))


def error(value: Any, sure: Any) -> float:
    """The most by which a number can differ from what a ball holds; NaN for no number."""
    ball = None if value is None else as_ball(value)
    if ball is None:
        return float("nan")
    return float(abs(ball - sure).upper())


def as_ball(value: Any) -> Any:
    """A number of any kind, exactly; None for one that is not finite."""
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
    """The values of single positions from arrays, or from what all positions share."""
    arrays = {
        target: v if getattr(v, "shape", ()) else np.full(count, v) for target, v in columns.items()
    }
    return [{target: array[n] for target, array in arrays.items()} for n in range(count)]
