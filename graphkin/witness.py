"""The witness: a solution held against vector loops that share nothing with its construction.

Disagreement is the absolute difference over the largest magnitude of that quantity in the scene.
A scale never falls below a thousandth of what the other quantities make of it (v ≈ ω·L and so on),
so that the rounding of a quantity that is nought everywhere is not taken for a difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphkin.loops.bodies import Complexes, Reals
from graphkin.loops.closures import closure_number, other_closure, turned_side
from graphkin.loops.equations import equations
from graphkin.loops.groups import Group, groups
from graphkin.loops.motion import Motion
from graphkin.loops.solve import LoopSolution, solve
from graphkin.plane import Ratio
from graphkin.scene.model import Closure, Scene, Side, Way
from graphkin.steps.solution import Solution, Verdict

LEAST_LIMIT = 1e-9
EPS = 2.0**-52
FLOOR = 1e-3
"""Share of its natural size below which a scale is not taken seriously."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]
Differences = dict[str, Reals]


def compare(scene: Scene, solution: Solution, values: Mapping[str, Any] | None = None) -> Verdict:
    """Hold one solution against the vector loops, starting Newton's method at its positions.

    Raises WitnessError where the loops do not close or are singular, StructureError where the
    scene has pairs that they do not cover.
    """
    examined = examine(scene, solution, values)
    difference, quantity = examined.largest(0)
    limit = float(examined.limit[0])
    broken = tuple(name for name, holds in examined.branches.items() if not holds[0])
    report = examined.solved.report
    return Verdict(
        agrees=bool(examined.agrees[0]),
        largest_difference=difference,
        quantity=quantity,
        limit=limit,
        residual=float(report.residual[0]),
        moved=float(report.moved[0]),
        branches=broken,
    )


def compare_batch(
    scene: Scene, solution: Solution, values: Mapping[str, Any]
) -> tuple[Reals, Flags]:
    """Largest difference of each of N settings, and whether it and the branches agree: (N,), (N,).

    A setting that either route could not solve has NaN and does not agree.
    """
    examined = examine(scene, solution, values)
    return examined.worst, examined.agrees


@dataclass(frozen=True, slots=True, eq=False)
class Examined:
    """Both routes side by side: differences and branch conditions by name, each of shape (N,)."""

    solved: LoopSolution
    differences: Differences
    branches: Mapping[str, Flags]
    limit: Reals

    @property
    def worst(self) -> Reals:
        """The largest difference of each setting; NaN where any is unknown."""
        if not self.differences:
            return np.where(self.solved.report.good, 0.0, np.nan)
        return np.asarray(np.stack(list(self.differences.values())).max(axis=0))

    @property
    def agrees(self) -> Flags:
        """Where every difference is within the limit and every branch as stated."""
        agrees = (self.worst <= self.limit) & np.isfinite(self.limit)
        for holds in self.branches.values():
            agrees = agrees & holds
        return np.asarray(agrees & self.solved.report.good)

    def largest(self, row: int) -> tuple[float, str]:
        """The largest difference of one setting, and the quantity where it was found."""
        found = [(float(each[row]), name) for name, each in self.differences.items()]
        return max(found, key=lambda pair: (np.isnan(pair[0]), pair[0]), default=(0.0, ""))


def examine(scene: Scene, solution: Solution, values: Mapping[str, Any] | None) -> Examined:
    """Solve the loops from the solution's positions and compare all that the solution holds."""
    loops = equations(scene, values)
    places = {name: p.position for name, p in solution.points.items() if p.position is not None}
    slides = {name: s.position for name, s in solution.slides.items() if s.position is not None}
    named = {name: place for name, place in places.items() if "@" not in name}
    solved = solve(loops, named, slides)
    with np.errstate(all="ignore"):
        extent = breadth(solved.motion)
        margin = np.abs(loops.numbers.reals(solution.margin))
        slack = 64 * EPS * (extent / loops.least) / margin**3
        differences = differing(solved, solution, extent)
        branches = branch_conditions(scene, solved.motion)
    return Examined(solved, differences, branches, np.maximum(LEAST_LIMIT, slack))


def breadth(motion: Motion) -> Reals:
    """Largest distance between two points of the mechanism (m), shape (N,)."""
    places = motion.points.place
    return or_one(np.abs(places[:, :, None] - places[:, None, :]).max(axis=(1, 2)))


@dataclass(frozen=True, slots=True, eq=False)
class Scales:
    """Largest magnitude of each kind of quantity in the scene, shape (N,)."""

    length: Reals
    speed: Reals
    acceleration: Reals
    omega: Reals
    epsilon: Reals

    @classmethod
    def of(cls, motion: Motion, length: Reals) -> Scales:
        """Measured on the loops; a quantity that is nought throughout has scale 1."""
        slides = np.abs(motion.slides).max(axis=2, initial=0)
        speed = np.maximum(np.abs(motion.points.velocity).max(axis=1), slides[1])
        pushed = np.maximum(np.abs(motion.points.acceleration).max(axis=1), slides[2])
        omega, epsilon = np.abs(motion.omega).max(axis=1), np.abs(motion.epsilon).max(axis=1)
        natural = np.maximum(speed**2 / length, omega**2 * length)
        fastest = np.maximum(speed, FLOOR * omega * length)
        turning = np.maximum(omega, FLOOR * speed / length)
        most = np.maximum(pushed, FLOOR * np.maximum(natural, epsilon * length))
        twist = np.maximum(epsilon, FLOOR * np.maximum(natural, pushed) / length)
        return cls(length, *map(or_one, (fastest, most, turning, twist)))


def or_one(scale: Reals) -> Reals:
    """A scale to divide by: 1 where all is at rest, so that differences stay absolute."""
    return np.where(scale == 0, 1.0, scale)


def differing(solved: LoopSolution, solution: Solution, extent: Reals) -> Differences:
    """Every difference that can be taken, over its scale, by the quantity's name."""
    scales = Scales.of(solved.motion, extent)
    pairs = (
        *of_points(solved.motion, solution, scales),
        *of_links(solved.motion, solution, scales),
        *of_slides(solved, solution, scales),
    )
    count = solved.loops.numbers.count
    compared = {
        name: np.broadcast_to(np.abs(np.asarray(ours) - theirs) / scale, (count,))
        for name, ours, theirs, scale in pairs
        if ours is not None
    }
    return compared | dict(of_centres(solved.motion, solution, scales))


Pairs = Iterator[tuple[str, Any, Reals | Complexes, Reals]]


def of_points(motion: Motion, solution: Solution, scales: Scales) -> Pairs:
    """Position, velocity and acceleration of every point, ours and the loops'."""
    for name, point in solution.points.items():
        place, velocity, acceleration = motion.point(name)
        yield f"points.{name}.position", point.position, place, scales.length
        yield f"points.{name}.velocity", point.velocity, velocity, scales.speed
        yield f"points.{name}.acceleration", point.acceleration, acceleration, scales.acceleration


def of_links(motion: Motion, solution: Solution, scales: Scales) -> Pairs:
    """ω and ε of every link, ours and the loops'."""
    for name, link in solution.links.items():
        i = motion.index[name]
        yield f"links.{name}.omega", link.omega, motion.omega[:, i], scales.omega
        yield f"links.{name}.epsilon", link.epsilon, motion.epsilon[:, i], scales.epsilon


def of_slides(solved: LoopSolution, solution: Solution, scales: Scales) -> Pairs:
    """Coordinate, speed, acceleration and Coriolis vector of every block, ours and the loops'."""
    for name, slide in solution.slides.items():
        j = solved.loops.guide_index(name)
        if j is None:
            continue
        s, speed, acceleration, coriolis = solved.motion.slide(j)
        yield f"slides.{name}.position", slide.position, s, scales.length
        yield f"slides.{name}.speed", slide.speed, speed, scales.speed
        yield f"slides.{name}.acceleration", slide.acceleration, acceleration, scales.acceleration
        yield f"slides.{name}.coriolis", slide.coriolis, coriolis, scales.acceleration


def of_centres(motion: Motion, solution: Solution, scales: Scales) -> Iterator[tuple[str, Reals]]:
    """Velocity at the instantaneous centres and acceleration at the poles, which should vanish."""
    for name, link in solution.links.items():
        i = motion.index[name]
        omega, epsilon = motion.omega[:, i], motion.epsilon[:, i]
        start, velocity, acceleration = (row[:, i] for row in motion.origin)
        if link.instant_centre is not None:
            centre = link.instant_centre
            left = left_at(centre, start, velocity, 1j * omega, scales.length)
            aside = off_ray(centre, start, velocity, scales.length)
            yield f"links.{name}.instant_centre", np.hypot(left, aside) / scales.speed
        if link.acceleration_pole is not None:
            turn = 1j * epsilon - omega**2
            left = left_at(link.acceleration_pole, start, acceleration, turn, scales.length)
            yield f"links.{name}.acceleration_pole", left / scales.acceleration


def left_at(centre: Ratio, start: Complexes, motion: Complexes, turn: Any, length: Reals) -> Reals:
    """What motion is left at a centre, with z ↦ motion + turn·(z - start) the link's, shape (N,).

    Far away it is divided by the distance in lengths of the mechanism, so that a centre near
    infinity is held to its inverse distance. Where nothing is stated (0/0) all must be at rest.
    """
    way = (centre.start - start) * centre.size + centre.shift
    weight = abs(np.asarray(centre.size)) + abs(way) / length
    left = abs(motion * centre.size + turn * way)
    return np.asarray(np.where(weight == 0, abs(motion) + abs(turn) * length, left / weight))


def off_ray(centre: Ratio, start: Complexes, velocity: Complexes, length: Reals) -> Reals:
    """How far a centre lies off the ray square to the velocity (Chasles), as in ``left_at``.

    This holds the direction of a centre at infinity; a complex size leaves that open.
    """
    way = (centre.start - start) * centre.size + centre.shift
    weight = abs(np.asarray(centre.size)) + abs(way) / length
    aside = abs((np.conj(way) * 1j * velocity).imag) / length
    known = (weight > 0) & np.isreal(centre.size)
    return np.asarray(np.where(known, aside / np.where(weight > 0, weight, 1), 0.0))


def branch_conditions(scene: Scene, motion: Motion) -> dict[str, Flags]:
    """Which of the stated sides, ways and closures hold in the position that the loops found.

    The number of a closure is verified on one scene only, not in a batch.
    """
    found: dict[str, Flags] = {}
    stated = scene.branches.items()
    sides_only = all(isinstance(branch, Side) for _, branch in stated)
    known = [] if sides_only else groups(scene, motion.loops)
    for name, branch in stated:
        group = next((each for each in known if name in each.links), None)
        if isinstance(branch, Side):
            side = turned_side(motion, branch.first, branch.second, name)
            found[name] = np.asarray(branch.side * side > -LEAST_LIMIT)
        elif isinstance(branch, Way) and group is not None:
            found[name] = way_holds(branch, motion, group)
        elif isinstance(branch, Closure) and group is not None and motion.loops.numbers.single:
            number = closure_number(scene, motion, group)
            found[name] = np.array([number == branch.number])
    return found


def way_holds(branch: Way, motion: Motion, group: Group) -> Flags:
    """Whether the slide of a dyad stands the stated way; with two slides there is one closure."""
    if len(group.slides) > 1:
        return np.full(motion.loops.numbers.count, group.is_dyad)
    stands, other = other_closure(motion.loops, motion, group)
    return np.asarray(branch.way * (stands - other) > -LEAST_LIMIT * motion.loops.size)
