"""The differences between a solution and the loops, relative to scales, with rounding bounds.

Jerks from the loops, differentiated once more: J·φ⃛ = q⃛ - 3f″(φ̇, φ̈) - f‴(φ̇, φ̇, φ̇).

Only a witness of jerks needs them. Their bounds grow like 1/s⁴ with the sine s of a flat crossing.
"""

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
    JERK,
    OF_POINTS,
    OF_SLIDES,
    ORDERS,
    QUANTITIES,
    RATES,
    MotionQuantity,
    motion_value,
)
from graphkin.construction.core.solution import UNKNOWN, Solution
from graphkin.loops.equations import Equations, Lift, equations
from graphkin.loops.loop_motion import Motion, RateBounds, Rounding, led, loads, straight, touching
from graphkin.loops.newton import LoopSolution, solve_each
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.numbers.plane import Ratio, dot
from graphkin.scene.link_points import ends_of
from graphkin.scene.model import FRAME, Scene
from graphkin.text.errors import WitnessError, message


class Jerks(Struct, frozen=True, eq=False):
    """The jerks of all points (N, points), m/s³, with the bounds of their errors.

    ``origin`` (N, links) are those of the links' origins, ``swing`` the factors that an arm takes.
    """

    solved: LoopSolution
    found: Complexes
    origin: Complexes
    swing: Complexes
    bound: Reals
    origin_bound: Reals
    swing_bound: Reals

    def point(self, name: str) -> tuple[Complexes, Reals]:
        """The jerk of a point with its bound, (N,); ``A@3`` is the point of link 3 under A."""
        motion, bounds = self.solved.motion, self.solved.rounding
        point, carrier = ends_of(name)
        p = motion.names[point]
        if not carrier:
            return self.found[:, p], self.bound[:, p]
        i = motion.index[carrier]
        arm = motion.points.place[:, p] - motion.origin.place[:, i]
        off = bounds.points.place[:, p] + bounds.origin.place[:, i]
        swing, more = self.swing[:, i], self.swing_bound[:, i]
        bound = self.origin_bound[:, i] + off * abs(swing) + (abs(arm) + off) * more
        return self.origin[:, i] + swing * arm, bound


def jerks(solved: LoopSolution) -> Jerks:
    """The jerks of all points of solved loops."""
    loops, unknowns, chains = solved.loops, solved.unknowns, solved.loops.chains
    rates = solved.ratios.rates(loops.drives.speed)
    seconds = solved.ratios.accelerations(loops.drives.speed, loops.drives.acceleration)
    with np.errstate(all="ignore"):
        linear = chains.at(unknowns)
        jacobian = loops.scaled_jacobian(linear)
        right = -3 * loops.second(linear, rates, seconds) - loops.third(linear, rates)
        right[:, right.shape[1] - len(loops.drives.turns) :] += loops.drives.jerk
        thirds = solve_each(jacobian, (right / loops.rows)[:, :, None])[:, :, 0] * loops.columns
        spin, slid = chains.split(thirds)
        origin = (linear.turned @ (1j * spin[:, 1:, None]) + linear.along @ slid[:, :, None])[
            ..., 0
        ]
        origin += 3 * chains.second(linear, rates, seconds) + chains.third(linear, rates)
        motion, (owners, arms) = solved.motion, loops.owners
        twist = spin[:, loops.turning_of_link]
        swing = 1j * twist - 3 * motion.omega * motion.epsilon - 1j * motion.omega**3
        found = origin[:, owners] + swing[:, owners] * motion.heading[:, owners] * arms
        own = bounds(solved, rates, seconds, thirds, jacobian)
        return Jerks(solved, found, origin, swing, *own)


def bounds(
    solved: LoopSolution, rates: Reals, seconds: Reals, thirds: Reals, jacobian: Reals
) -> tuple[Reals, Reals, Reals]:
    """The error bounds of the jerks of all points and origins, and of the rates that turn links.

    They are found as those of accelerations are: (N, points) and twice (N, links).
    """
    loops, unknowns = solved.loops, solved.unknowns
    found = RateBounds.of(solved.motion, unknowns, rates, seconds, jacobian)
    rows, places = found.position.rows, found.position.places
    speed, push = loads(rates), loads(seconds)
    carried = rows.carried_thrice(speed, push, loads(thirds))
    none = np.zeros_like(speed)
    more = rows.carried_thrice(speed + found.slower, push + found.later, none)
    more -= rows.carried_thrice(speed, push, none)
    jerk = found.moved.sum(carried) + found.longer.sum(more)
    linear = straight(loops, thirds) + touching(loops, carried, places)
    first = len(loops.slips.links)
    for lift in loops.drives.lifts:
        linear[:, first + lift.row] += lifted(lift, found, unknowns, rates, seconds, thirds)
    linear[:, first:] += loops.drives.errors[3]
    latest = loads(led(loops, found.position.inverse, jerk, linear))
    jerk = jerk + found.longer.sum(latest)
    motion, missed = solved.motion, solved.rounding
    omega, epsilon = abs(motion.omega), abs(motion.epsilon)
    swing = latest[:, loops.turning_of_link] + (omega + missed.omega) ** 3 - omega**3
    swing += 3 * (omega * missed.epsilon + epsilon * missed.omega + missed.omega * missed.epsilon)
    return jerk[:, points_from(loops) :], jerk[:, : len(loops.links)], swing


def points_from(loops: Equations) -> int:
    """The number of chains before those to the points."""
    return len(loops.links) + len(loops.closing)


def lifted(
    lift: Lift, found: RateBounds, unknowns: Reals, rates: Reals, seconds: Reals, thirds: Reals
) -> Reals:
    """The contribution of errors of a cam's angle and its rates to its follower's jerk: (N,)."""
    shaken, own = unknowns.copy(), lift.way != 0
    shaken[:, own] += found.position.off[:, own] * lift.way[own]
    here, there = lift.at(unknowns), lift.at(shaken)
    curve, bent = lift.third(unknowns), lift.third(shaken)
    turn, twist = abs(lift.of(rates)), abs(lift.of(seconds))
    slower = lift.of(found.slower[:, 1:], abs(lift.way))
    later = lift.of(found.later[:, 1:], abs(lift.way))
    added = abs(there.rate - here.rate) * abs(lift.of(thirds))
    added += 3 * abs(there.bend - here.bend) * turn * twist + abs(bent - curve) * turn**3
    more = abs(here.bend) * (slower * twist + turn * later + slower * later)
    return np.asarray(added + 3 * more + abs(curve) * ((turn + slower) ** 3 - turn**3))


class Sizes(Protocol):
    """Largest magnitude of each kind of quantity in the scene, shape (N,)."""

    @property
    def length(self) -> Reals:
        """In metres."""

    @property
    def speed(self) -> Reals:
        """In metres per second."""

    @property
    def acceleration(self) -> Reals:
        """In metres per second squared."""

    @property
    def omega(self) -> Reals:
        """In radians per second."""


class MotionField(Struct, frozen=True, eq=False):
    """The motion z ↦ motion + turn·(z - start) of a link's points, and the bounds of its errors."""

    start: Complexes
    motion: Complexes
    turn: Any
    misplaced: Reals
    missed: Reals
    missed_turn: Reals


class Left(Struct, frozen=True, eq=False):
    """The residual of a value in the loops, its bound, and the size of the terms that cancel.

    For a centre, the residual is the motion left at that point.
    """

    found: Reals
    bound: Reals
    size: Reals

    def over(self, scale: Reals) -> Left:
        """The residual, bound and size divided by a scale."""
        return Left(self.found / scale, self.bound / scale, self.size / scale)


def left_at_centre(solved: LoopSolution, name: str, centre: Ratio, scales: Sizes) -> Left:
    """The residual at a link's centre relative to the frame, or of two links such as 2-4."""
    first, second = name.split("-") if "-" in name else (FRAME, name)
    return off_centre(solved, centre, first, second, scales)


def left_at_pole(solved: LoopSolution, name: str, pole: Ratio, scales: Sizes) -> Left:
    """The residual at the acceleration pole of a link."""
    left = left_at(pole, accelerations_of(solved, name), scales.length)
    return left.over(scales.acceleration)


def left_at_inflection(solved: LoopSolution, name: str, pole: Ratio, scales: Sizes) -> Left:
    """The residual at the inflection pole of a link."""
    left = left_at(pole, bends_of(solved, name), scales.length)
    return left.over(scales.acceleration * scales.omega)


def off_centre(solved: LoopSolution, centre: Ratio, first: str, second: str, scales: Sizes) -> Left:
    """The relative velocity of two links at their centre, divided by the scale of speeds."""
    field = velocities_of(solved, first, second)
    left = left_at(centre, field, scales.length)
    aside, bound = off_ray(centre, field, scales.length)
    return Left(np.hypot(left.found, aside), left.bound + bound, left.size).over(scales.speed)


def velocities_of(solved: LoopSolution, first: str, second: str) -> MotionField:
    """The velocities of the second link's points relative to the first."""
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
    """The field that vanishes at the inflection pole, (aω - εv)/ω³ from the link's origin.

    The points of the inflection circle, which contains that pole and the instantaneous centre I,
    have no acceleration normal to their velocity. With r measured from I this means r² = r·a_I/ω²:
    a circle through I and I + a_I/ω².
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


def left_at_curvature(solved: LoopSolution, name: str, centre: Ratio, scales: Sizes) -> Left:
    """The residual at the centre of curvature of a point's path, relative to its terms.

    The distance of a point P from a fixed point Ω keeps its first two derivatives zero only at the
    centre of curvature: v·(Ω - P) = 0 and v² = a·(Ω - P). The centre comes from a motion with such
    errors, so the errors count twice.
    """
    place, v, a = solved.motion.point(name)
    misplaced, slower, later = solved.rounding.point(name)
    size = np.asarray(centre.size)
    way = (centre.start - place) * size + centre.shift
    near, far, speed, push = abs(size), abs(way), abs(v), abs(a)
    across, along = speed * (far + near * scales.length), speed**2 * near + push * far
    parts = (
        (abs(dot(v, way)), slower * far + speed * near * misplaced, across),
        (
            abs(speed**2 * size - dot(a, way)),
            2 * speed * slower * near + later * far + push * near * misplaced,
            along,
        ),
    )
    relative = [(left / or_one(whole), 2 * bound / or_one(whole)) for left, bound, whole in parts]
    found, bound = (np.hypot(*each) for each in zip(*relative, strict=True))
    return Left(np.asarray(found), np.asarray(bound), np.ones_like(found))


def left_at(centre: Ratio, field: MotionField, length: Reals) -> Left:
    """The residual motion at a centre, shape (N,).

    Far away, the residual is divided by the distance in lengths of the mechanism. A centre near
    infinity is thus compared by its inverse distance. Where the centre is undefined (0/0), the
    whole motion must vanish. The centre itself comes from a motion with such errors, so the errors
    count twice.
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
    """The distance of a centre from the ray normal to the velocity (Chasles), and its bound.

    It is scaled as in ``left_at``. It checks the direction of a centre at infinity, unless the
    centre's size is complex.
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
"""Share of its natural size below which a scale is not used."""
LOST = 0.1
"""Error bound, as a share of the quantity, above which no digit of the quantity is certain."""
LEAST_LIMIT = 1e-9
"""Difference that is always within the limit."""
MOST_DIGITS = 15
"""Digits of a double."""
KINDS_OF = {each.attribute: each.kind for each in (*OF_POINTS, *RATES, *OF_SLIDES)}
"""The kind of derivative of each quantity; centres have none."""


class Differences(Struct, frozen=True, eq=False, dict=True):
    """Differences by the ``names`` of their quantities, with error bounds and sizes.

    All are divided by their scales and have shape (Q, N).
    """

    names: tuple[str, ...]
    found: Reals
    bound: Reals
    size: Reals

    @cached_property
    def sure(self) -> Flags:
        """Where at least one digit of the quantity is certain."""
        return np.asarray(~(share(self.bound, self.size) > LOST))

    @cached_property
    def judged(self) -> Flags:
        """Where the difference is compared: where a digit is certain, or it is NaN."""
        return np.asarray(self.sure | np.isnan(self.found))

    @cached_property
    def limit(self) -> Reals:
        """The largest difference within the limit."""
        return np.maximum(LEAST_LIMIT, self.bound)


def share(bound: Reals, size: Reals) -> Reals:
    """A bound as a share of the quantity, which counts as at least ``FLOOR``."""
    return np.asarray(bound / np.maximum(size, FLOOR))


class Magnitudes(Struct, frozen=True, eq=False):
    """Largest magnitude of each kind of quantity, of those with a certain digit: shape (N,)."""

    length: Reals
    speed: Reals
    acceleration: Reals
    omega: Reals
    epsilon: Reals

    @classmethod
    def of(cls, motion: Motion, bounds: Rounding, length: Reals) -> Magnitudes:
        """The magnitudes in the loops; a quantity that is zero throughout has scale 1."""
        points, errors = motion.points, bounds.points
        slides = np.stack(
            [largest(*pair) for pair in zip(motion.slides, bounds.slides, strict=True)]
        )
        speed = np.maximum(largest(points.velocity, errors.velocity), slides[1])
        pushed = np.maximum(largest(points.acceleration, errors.acceleration), slides[2])
        omega = largest(motion.omega, bounds.omega)
        epsilon = largest(motion.epsilon, bounds.epsilon)
        bar = motion.loops.size  # |independent of how far a rack or a block has moved
        natural = np.maximum(speed**2 / bar, omega**2 * bar)
        fastest = np.maximum(speed, FLOOR * omega * bar)
        turning = np.maximum(omega, FLOOR * speed / bar)
        most = np.maximum(pushed, FLOOR * np.maximum(natural, epsilon * bar))
        twist = np.maximum(epsilon, FLOOR * np.maximum(natural, pushed) / bar)
        return cls(length, *map(or_one, (fastest, most, turning, twist)))


def largest(values: Reals | Complexes, bounds: Reals) -> Reals:
    """The largest magnitude in each row with a certain digit; zero where there is none."""
    sizes = np.abs(values)
    return np.asarray(np.where(bounds > LOST * sizes, 0.0, sizes).max(axis=1, initial=0.0))


def or_one(scale: Reals) -> Reals:
    """A scale to divide by; 1 where everything is at rest, so that differences stay absolute."""
    return np.where(scale == 0, 1.0, scale)


def differing(solved: LoopSolution, solution: Solution, scales: Magnitudes) -> Differences:
    """The differences between a solution and the loops, by the quantity's name.

    Raises WitnessError for a quantity that has no independent route.
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
"""The quantity of the centres of two links, which a solution holds separately."""


def held(solution: Solution) -> Iterator[tuple[MotionQuantity, Mapping[str, Any]]]:
    """Every quantity that a solution holds, with its values by point, link or block.

    Of two ways to one quantity, the first with known values counts.
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
    """The path of a quantity in a solution."""
    if quantity is PAIRS and "-" in name:
        return f"centres.{name}"
    return f"{quantity.whose}.{name}.{quantity.attribute}"


def unwitnessed(quantity: MotionQuantity, name: str) -> WitnessError:
    """The error for a quantity that has no route independent of its construction."""
    return WitnessError.at(
        path_of(quantity, name),
        message("no independent route gives this quantity"),
        message(
            "a route of {target} among the routes of the independent check", target=quantity.target
        ),
    )


Route = Callable[[LoopSolution, Mapping[str, Any], "Magnitudes"], Left]
"""The residuals of a quantity's values, by name, in the loops: (N, values) each."""


def apart(
    solved: LoopSolution, ours: Mapping[str, Any], theirs: Any, bound: Reals, scale: Reals
) -> Left:
    """The differences of values from the loops, divided by their scale."""
    own, scale = solved.loops.numbers.columns(list(ours.values()), theirs.dtype), scale[:, None]
    return Left(abs(own - theirs) / scale, bound / scale, abs(theirs) / scale)


def of_points(order: int, scale: str) -> Route:
    """The route to a position, a velocity or an acceleration of points."""

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


def of_jerks(solved: LoopSolution, ours: Mapping[str, Any], scales: Magnitudes) -> Left:
    """The route to the jerk of points: the loops differentiated once more."""
    every, bar = jerks(solved), solved.loops.size
    natural = scales.acceleration * np.maximum(scales.omega, scales.speed / bar)
    scale = or_one(np.maximum(largest(every.found, every.bound), FLOOR * natural))
    theirs, bound = (np.stack(each, axis=1) for each in zip(*map(every.point, ours), strict=True))
    return apart(solved, ours, theirs, bound, scale)


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
    """The first guide of a block. Raises WitnessError where the loops have none."""
    found = solved.loops.guide_index(block)
    if found is None:
        raise WitnessError.at(
            f"slides.{block}",
            message("the vector loops know no guide of this block"),
            message("a guide"),
        )
    return found


def of_centres(left: Callable[[LoopSolution, str, Any, Magnitudes], Left]) -> Route:
    """The route to centres: the motion left at each of them, which should vanish."""

    def route(solved: LoopSolution, ours: Mapping[str, Any], scales: Magnitudes) -> Left:
        every = [left(solved, name, centre, scales) for name, centre in ours.items()]
        return Left(*(np.stack([getattr(e, part) for e in every], axis=1) for part in PARTS))

    return route


ROUTES: dict[str, Route] = {
    "position": of_points(0, "length"),
    "velocity": of_points(1, "speed"),
    "acceleration": of_points(2, "acceleration"),
    JERK: of_jerks,
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
    "curvature": of_centres(left_at_curvature),
}
"""The independent route to each quantity, by its target; quantities without one are refused."""


def digits_of(differences: Differences) -> dict[str, int]:
    """The number of certain significant digits of positions, velocities and accelerations.

    It is the smaller of the digits left by rounding in the loops and those in which both routes
    agree. A value below a thousandth of the largest of its kind counts as that thousandth.
    """
    found: dict[str, int] = {}
    apart = np.fmax(differences.bound, differences.found)[:, 0]
    shares = share(apart, differences.size[:, 0]).tolist()
    for name, off in zip(differences.names, shares, strict=True):
        kind = KINDS_OF.get(name.rpartition(".")[2])
        if kind is not None:
            found[kind] = min(found.get(kind, MOST_DIGITS), sure_digits(off))
    return {kind: found[kind] for kind in ORDERS if kind in found}


def sure_digits(share: float) -> int:
    """The number of certain digits of a value with the given relative error."""
    if not share <= LOST:
        return 0
    return min(MOST_DIGITS, int(-np.log10(max(share, 1e-99))))


def sure_of(solution: Solution, unsure: Mapping[str, Any]) -> Solution:
    """The solution with NaN for every quantity, by its path, that has no certain digit.

    In a batch of N, each path has flags (N,), and only the marked variants become NaN.
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
    """NaN in place of a value, or of the marked rows of an array."""
    if isinstance(value, Ratio):
        return Ratio(*(lost(part + 0j, where) for part in value))
    gone = UNKNOWN if np.iscomplexobj(value) else nan
    return gone if where is True else np.where(where, gone, value)


def evenness(scene: Scene) -> float:
    """The shortest vector of the loops, or arm of a wheel, as a share of the longest."""
    loops = equations(scene)
    sizes = [abs(loops.chains.fixed).ravel(), abs(loops.slips.rows).ravel()]
    lengths = np.concatenate([part[part > 0] for part in sizes])
    return float(lengths.min() / lengths.max()) if lengths.size else 1.0
