"""Every difference between a solution and the loops, over its scale, and what rounding allows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from math import nan
from typing import Any, Protocol

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.quantities import (
    BY_TARGET,
    KINDS,
    OF_POINTS,
    OF_SLIDES,
    QUANTITIES,
    RATES,
    MotionQuantity,
    motion_value,
)
from graphkin.construction.core.solution import UNKNOWN, Solution
from graphkin.loops.equations import equations
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton import LoopSolution
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.loops.rounding import Rounding
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME, Scene
from graphkin.text.errors import Problem, WitnessError


class Sizes(Protocol):
    """Largest magnitude of each kind of quantity in the scene, shape (N,)."""

    @property
    def length(self) -> Reals:
        """Metres."""

    @property
    def speed(self) -> Reals:
        """Metres per second."""

    @property
    def acceleration(self) -> Reals:
        """Metres per second squared."""

    @property
    def omega(self) -> Reals:
        """Radians per second."""


class MotionField(Struct, frozen=True, eq=False):
    """The motion z ↦ motion + turn·(z - start) of a link's points, and the bounds of its errors."""

    start: Complexes
    motion: Complexes
    turn: Any
    misplaced: Reals
    missed: Reals
    missed_turn: Reals


class Left(Struct, frozen=True, eq=False):
    """What is left between a value and the loops, its bound, and the size of what cancels there.

    At a centre that is the motion left there.
    """

    found: Reals
    bound: Reals
    size: Reals

    def over(self, scale: Reals) -> Left:
        """All of them over a scale."""
        return Left(self.found / scale, self.bound / scale, self.size / scale)


def left_at_centre(solved: LoopSolution, name: str, centre: Ratio, scales: Sizes) -> Left:
    """What is left at the centre of a link against the frame, or of two links such as 2-4."""
    first, second = name.split("-") if "-" in name else (FRAME, name)
    return off_centre(solved, centre, first, second, scales)


def left_at_pole(solved: LoopSolution, name: str, pole: Ratio, scales: Sizes) -> Left:
    """What is left at the acceleration pole of a link."""
    left = left_at(pole, accelerations_of(solved, name), scales.length)
    return left.over(scales.acceleration)


def left_at_inflection(solved: LoopSolution, name: str, pole: Ratio, scales: Sizes) -> Left:
    """What is left at the inflection pole of a link."""
    left = left_at(pole, bends_of(solved, name), scales.length)
    return left.over(scales.acceleration * scales.omega)


def off_centre(solved: LoopSolution, centre: Ratio, first: str, second: str, scales: Sizes) -> Left:
    """Velocity of the second link against the first at their centre, over the scale of speeds."""
    field = velocities_of(solved, first, second)
    left = left_at(centre, field, scales.length)
    aside, bound = off_ray(centre, field, scales.length)
    return Left(np.hypot(left.found, aside), left.bound + bound, left.size).over(scales.speed)


def velocities_of(solved: LoopSolution, first: str, second: str) -> MotionField:
    """The velocities of the second link's points against the first."""
    motion, bounds = solved.motion, solved.rounding
    i, j = motion.index[first], motion.index[second]
    start, velocity, _ = (row[:, j] for row in motion.origin)
    misplaced, missed, _ = (row[:, j] for row in bounds.origin)
    slip = velocity - motion.carried(first, start).velocity
    missed = missed + bounds.carried(first, start, misplaced).velocity
    omega = motion.omega[:, j] - motion.omega[:, i]
    return MotionField(
        start, slip, 1j * omega, misplaced, missed, bounds.omega[:, i] + bounds.omega[:, j]
    )


def accelerations_of(solved: LoopSolution, name: str) -> MotionField:
    """The accelerations of a link's points."""
    motion, bounds = solved.motion, solved.rounding
    i = motion.index[name]
    omega, turn = abs(motion.omega[:, i]), bounds.omega[:, i]
    return MotionField(
        motion.origin.place[:, i],
        motion.origin.acceleration[:, i],
        1j * motion.epsilon[:, i] - motion.omega[:, i] ** 2,
        bounds.origin.place[:, i],
        bounds.origin.acceleration[:, i],
        bounds.epsilon[:, i] + turn * (2 * omega + turn),
    )


def bends_of(solved: LoopSolution, name: str) -> MotionField:
    """What vanishes at the inflection pole, (aω - εv)/ω³ away from the link's origin.

    The points of the circle on it and the instantaneous centre have no acceleration across their
    velocity: with r from the centre I that is r² = r·a_I/ω², a circle through I and I + a_I/ω².
    """
    motion, bounds = solved.motion, solved.rounding
    i = motion.index[name]
    start, velocity, acceleration = (row[:, i] for row in motion.origin)
    misplaced, slower, later = (row[:, i] for row in bounds.origin)
    omega, epsilon = motion.omega[:, i], motion.epsilon[:, i]
    turn, twist = bounds.omega[:, i], bounds.epsilon[:, i]
    away = acceleration * omega - epsilon * velocity
    missed = later * (abs(omega) + turn) + abs(acceleration) * turn
    missed = missed + slower * (abs(epsilon) + twist) + abs(velocity) * twist
    return MotionField(
        start, -away, omega**3, misplaced, missed, (abs(omega) + turn) ** 3 - abs(omega) ** 3
    )


def left_at(centre: Ratio, field: MotionField, length: Reals) -> Left:
    """What motion is left at a centre, shape (N,).

    Far away it is divided by the distance in lengths of the mechanism, so that a centre near
    infinity is held to its inverse distance. Where nothing is stated (0/0) all must be at rest.
    The centre itself was made of a motion with such errors, so that they count twice.
    """
    way = (centre.start - field.start) * centre.size + centre.shift
    near, far = abs(np.asarray(centre.size)), abs(way)
    weight = near + far / length
    turn = np.asarray(abs(field.turn), dtype=np.float64)

    def total(motion: Reals, turning: Reals) -> Reals:
        whole = motion + turning * length
        return np.asarray(np.where(weight == 0, whole, (motion * near + turning * far) / weight))

    size = total(np.asarray(abs(field.motion), dtype=np.float64), turn)
    left = abs(field.motion * centre.size + field.turn * way)
    found = np.where(weight == 0, size, left / weight)
    bound = 2 * total(np.asarray(field.missed + turn * field.misplaced), field.missed_turn)
    return Left(np.asarray(found), bound, size)


def off_ray(centre: Ratio, field: MotionField, length: Reals) -> tuple[Reals, Reals]:
    """How far a centre lies off the ray perpendicular to the velocity (Chasles), and its bound.

    As in ``left_at``. This holds the direction of a centre at infinity; a complex size leaves
    that open.
    """
    way = (centre.start - field.start) * centre.size + centre.shift
    near, far = abs(np.asarray(centre.size)), abs(way) / length
    weight = near + far
    aside = abs((np.conj(way) * 1j * field.motion).imag) / length
    bound = 2 * (far * field.missed + near * abs(field.motion) * field.misplaced / length)
    known = (weight > 0) & np.isreal(centre.size)
    weight = np.where(weight > 0, weight, 1)
    aside, bound = (np.asarray(np.where(known, each / weight, 0.0)) for each in (aside, bound))
    return aside, bound


# --- every difference between a solution and the loops --------------------------------------------


Flags = np.ndarray[Any, np.dtype[np.bool_]]
FLOOR = 1e-3
"""Share of its natural size below which a scale is not taken seriously."""
LOST = 0.1
"""Bound of an error, as a share of the quantity, from which no digit of it is sure."""
LEAST_LIMIT = 1e-9
"""Difference that is always allowed."""
MOST_DIGITS = 15
"""Digits that a double has."""
KINDS_OF = {each.attribute: each.kind for each in (*OF_POINTS, *RATES, *OF_SLIDES)}
"""Of which derivative each quantity is; centres have none."""


class Differences(Struct, frozen=True, eq=False, dict=True):
    """Differences by the ``names`` of their quantities, the bounds of their errors, and the sizes
    of the quantities, all over their scales: each of shape (Q, N).
    """

    names: tuple[str, ...]
    found: Reals
    bound: Reals
    size: Reals

    @cached_property
    def sure(self) -> Flags:
        """Where some digit of the quantity is sure."""
        return np.asarray(~(share(self.bound, self.size) > LOST))

    @cached_property
    def judged(self) -> Flags:
        """Where the difference is judged: not where both routes know nothing; NaN is."""
        return np.asarray(self.sure | np.isnan(self.found))

    @cached_property
    def limit(self) -> Reals:
        """The largest difference that is allowed."""
        return np.maximum(LEAST_LIMIT, self.bound)


def share(bound: Reals, size: Reals) -> Reals:
    """A bound as a share of the quantity; of a small one, as that of a thousandth."""
    return np.asarray(bound / np.maximum(size, FLOOR))


class Magnitudes(Struct, frozen=True, eq=False):
    """Largest magnitude of each kind of quantity in the scene that is sure, shape (N,)."""

    length: Reals
    speed: Reals
    acceleration: Reals
    omega: Reals
    epsilon: Reals

    @classmethod
    def of(cls, motion: Motion, bounds: Rounding, length: Reals) -> Magnitudes:
        """Measured on the loops; a quantity that is zero throughout has scale 1."""
        points, errors = motion.points, bounds.points
        slides = np.stack(
            [largest(*pair) for pair in zip(motion.slides, bounds.slides, strict=True)]
        )
        speed = np.maximum(largest(points.velocity, errors.velocity), slides[1])
        pushed = np.maximum(largest(points.acceleration, errors.acceleration), slides[2])
        omega = largest(motion.omega, bounds.omega)
        epsilon = largest(motion.epsilon, bounds.epsilon)
        bar = motion.loops.size  # however far away a rack or a block has come
        natural = np.maximum(speed**2 / bar, omega**2 * bar)
        fastest = np.maximum(speed, FLOOR * omega * bar)
        turning = np.maximum(omega, FLOOR * speed / bar)
        most = np.maximum(pushed, FLOOR * np.maximum(natural, epsilon * bar))
        twist = np.maximum(epsilon, FLOOR * np.maximum(natural, pushed) / bar)
        return cls(length, *map(or_one, (fastest, most, turning, twist)))


def largest(values: Reals | Complexes, bounds: Reals) -> Reals:
    """The largest magnitude in each row of which some digit is sure; zero where there is none."""
    sizes = np.abs(values)
    return np.asarray(np.where(bounds > LOST * sizes, 0.0, sizes).max(axis=1, initial=0.0))


def or_one(scale: Reals) -> Reals:
    """A scale to divide by: 1 where all is at rest, so that differences stay absolute."""
    return np.where(scale == 0, 1.0, scale)


def differing(solved: LoopSolution, solution: Solution, scales: Magnitudes) -> Differences:
    """Every difference between what a solution holds and the loops, by the quantity's name.

    Raises WitnessError for a quantity that no independent route gives.
    """
    names: list[str] = []
    every: list[Left] = []
    for quantity, values in held(solution):
        route = ROUTES.get(quantity.target)
        if route is None:
            raise unwitnessed(quantity, next(iter(values)))
        names += [path_of(quantity, name) for name in values]
        every.append(route(solved, values, scales))
    if not names:
        return Differences((), *np.zeros((3, 0, len(scales.length))))
    columns = (np.concatenate([getattr(each, part) for each in every], axis=1) for part in PARTS)
    return Differences(tuple(names), *(np.ascontiguousarray(column.T) for column in columns))


PARTS = Left.__struct_fields__
PAIRS = BY_TARGET["centre"]
"""The quantity of the centres of two links, which a solution holds apart."""


def held(solution: Solution) -> Iterator[tuple[MotionQuantity, Mapping[str, Any]]]:
    """Every quantity of which a solution holds anything, with its values by points, links, blocks.

    Of two ways to one quantity it holds the first that is known.
    """
    first = {(each.whose, each.attribute): each for each in reversed(QUANTITIES)}
    for quantity in reversed(first.values()):
        motions = getattr(solution, quantity.whose)
        values = {name: motion_value(motion, quantity) for name, motion in motions.items()}
        if known := {name: value for name, value in values.items() if value is not None}:
            yield quantity, known
    if solution.centres:
        yield PAIRS, solution.centres


def path_of(quantity: MotionQuantity, name: str) -> str:
    """Where a solution holds a quantity."""
    if quantity is PAIRS and "-" in name:
        return f"centres.{name}"
    return f"{quantity.whose}.{name}.{quantity.attribute}"


def unwitnessed(quantity: MotionQuantity, name: str) -> WitnessError:
    """The refusal of a quantity that nothing independent of its construction gives."""
    return WitnessError(
        Problem(
            path_of(quantity, name),
            "no independent route gives this quantity",
            f"a route of {quantity.target} among the routes of the independent check",
        )
    )


Route = Callable[[LoopSolution, Mapping[str, Any], "Magnitudes"], Left]
"""What is left between the values of a quantity, by name, and the loops: (N, values) each."""


def apart(
    solved: LoopSolution, ours: Mapping[str, Any], theirs: Any, bound: Reals, scale: Reals
) -> Left:
    """The differences of values from what the loops give, over their scale."""
    own, scale = solved.loops.numbers.columns(list(ours.values()), theirs.dtype), scale[:, None]
    return Left(abs(own - theirs) / scale, bound / scale, abs(theirs) / scale)


def of_points(order: int, scale: str) -> Route:
    """The route to a place, a velocity or an acceleration of points."""

    def route(solved: LoopSolution, ours: Mapping[str, Any], scales: Magnitudes) -> Left:
        motion, bounds = solved.motion, solved.rounding
        if motion.names.keys() >= ours.keys():
            which = [motion.names[name] for name in ours]
            theirs, bound = motion.points[order][:, which], bounds.points[order][:, which]
        else:
            theirs = np.stack([motion.point(name)[order] for name in ours], axis=1)
            bound = np.stack([bounds.point(name)[order] for name in ours], axis=1)
        return apart(solved, ours, theirs, bound, getattr(scales, scale))

    return route


def of_links(rate: str) -> Route:
    """The route to ω or ε of links."""

    def route(solved: LoopSolution, ours: Mapping[str, Any], scales: Magnitudes) -> Left:
        which = [solved.motion.index[name] for name in ours]
        theirs, bound = getattr(solved.motion, rate), getattr(solved.rounding, rate)
        return apart(solved, ours, theirs[:, which], bound[:, which], getattr(scales, rate))

    return route


def of_slides(part: str, scale: str) -> Route:
    """The route to the motion of blocks along their guides."""

    def route(solved: LoopSolution, ours: Mapping[str, Any], scales: Magnitudes) -> Left:
        guides = [guide_of(solved, name) for name in ours]
        theirs, bound = (
            np.stack([getattr(each.slide(j), part) for j in guides], axis=1)
            for each in (solved.motion, solved.rounding)
        )
        return apart(solved, ours, theirs, bound, getattr(scales, scale))

    return route


def guide_of(solved: LoopSolution, block: str) -> int:
    """The guide that a block names first. Raises WitnessError where the loops have none."""
    found = solved.loops.guide_index(block)
    if found is None:
        raise WitnessError(
            Problem(f"slides.{block}", "the vector loops know no guide of this block", "a guide")
        )
    return found


def of_centres(left: Callable[[LoopSolution, str, Any, Magnitudes], Left]) -> Route:
    """The route to centres: what is left of the motion at each, which should vanish."""

    def route(solved: LoopSolution, ours: Mapping[str, Any], scales: Magnitudes) -> Left:
        every = [left(solved, name, centre, scales) for name, centre in ours.items()]
        return Left(*(np.stack([getattr(e, part) for e in every], axis=1) for part in PARTS))

    return route


ROUTES: dict[str, Route] = {
    "position": of_points(0, "length"),
    "velocity": of_points(1, "speed"),
    "acceleration": of_points(2, "acceleration"),
    "omega": of_links("omega"),
    "epsilon": of_links("epsilon"),
    "slide": of_slides("position", "length"),
    "slide speed": of_slides("speed", "speed"),
    "slide acceleration": of_slides("acceleration", "acceleration"),
    "coriolis": of_slides("coriolis", "acceleration"),
    "centre": of_centres(left_at_centre),
    "inflection centre": of_centres(left_at_centre),
    "pole": of_centres(left_at_pole),
    "inflection": of_centres(left_at_inflection),
}
"""The independent route to each quantity, by its target: what has none here is refused."""


def digits_of(differences: Differences) -> dict[str, int]:
    """How many significant digits are sure of every position, velocity and acceleration.

    As many as rounding leaves the loops, and no more than those in which both routes agree. Of one
    smaller than a thousandth of the largest of its kind, digits of that thousandth.
    """
    found: dict[str, int] = {}
    apart = np.fmax(differences.bound, differences.found)[:, 0]
    shares = share(apart, differences.size[:, 0]).tolist()
    for name, off in zip(differences.names, shares, strict=True):
        kind = KINDS_OF.get(name.rpartition(".")[2])
        if kind is not None:
            found[kind] = min(found.get(kind, MOST_DIGITS), sure_digits(off))
    return {kind: found[kind] for kind in KINDS if kind in found}


def sure_digits(share: float) -> int:
    """How many digits are sure of what may be off by a share of itself."""
    if not share <= LOST:
        return 0
    return min(MOST_DIGITS, int(-np.log10(max(share, 1e-99))))


def sure_of(solution: Solution, unsure: Mapping[str, Any]) -> Solution:
    """The solution with NaN for every quantity of which no digit is sure, by its path.

    Of a batch of N each path has flags (N,), and only the variants that they mark are lost.
    """
    parts: dict[str, dict[str, Any]] = {}
    for path, where in unsure.items():
        part, name, *key = path.split(".")
        motions = parts.setdefault(part, dict(getattr(solution, part)))
        found = getattr(motions[name], key[0]) if key else motions[name]
        without = lost(found, where)
        motions[name] = replace(motions[name], **{key[0]: without}) if key else without
    return replace(solution, **parts)


def lost(value: Any, where: Any = True) -> Any:
    """What stands for a value of which no digit is sure, or for some rows of an array."""
    if isinstance(value, Ratio):
        return Ratio(*(lost(part + 0j, where) for part in value))
    gone = UNKNOWN if np.iscomplexobj(value) else nan
    return gone if where is True else np.where(where, gone, value)


def evenness(scene: Scene) -> float:
    """The shortest vector of the loops and arm of a wheel, in parts of the longest."""
    loops = equations(scene)
    sizes = [abs(loops.chains.fixed).ravel(), abs(loops.slips.rows).ravel()]
    lengths = np.concatenate([part[part > 0] for part in sizes])
    return float(lengths.min() / lengths.max()) if lengths.size else 1.0
