"""Every difference between a solution and the loops, over its scale."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphkin.loops.bodies import Complexes, Reals
from graphkin.loops.motion import Motion
from graphkin.loops.solve import LoopSolution
from graphkin.steps.solution import Solution
from graphkin.witness.centres import centre_differences

FLOOR = 1e-3
"""Share of its natural size below which a scale is not taken seriously."""

Differences = dict[str, Reals]


@dataclass(frozen=True, slots=True, eq=False)
class Scales:
    """Largest magnitude of each kind of quantity in the scene, shape (N,)."""

    length: Reals
    speed: Reals
    acceleration: Reals
    omega: Reals
    epsilon: Reals

    @classmethod
    def of(cls, motion: Motion, length: Reals, floor: Reals | float = FLOOR) -> Scales:
        """Measured on the loops; a quantity that is nought throughout has scale 1."""
        slides = np.abs(motion.slides).max(axis=2, initial=0)
        speed = np.maximum(np.abs(motion.points.velocity).max(axis=1), slides[1])
        pushed = np.maximum(np.abs(motion.points.acceleration).max(axis=1), slides[2])
        omega, epsilon = np.abs(motion.omega).max(axis=1), np.abs(motion.epsilon).max(axis=1)
        natural = np.maximum(speed**2 / length, omega**2 * length)
        fastest = np.maximum(speed, floor * omega * length)
        turning = np.maximum(omega, floor * speed / length)
        most = np.maximum(pushed, floor * np.maximum(natural, epsilon * length))
        twist = np.maximum(epsilon, floor * np.maximum(natural, pushed) / length)
        return cls(length, *map(or_one, (fastest, most, turning, twist)))


def or_one(scale: Reals) -> Reals:
    """A scale to divide by: 1 where all is at rest, so that differences stay absolute."""
    return np.where(scale == 0, 1.0, scale)


def differing(
    solved: LoopSolution, solution: Solution, extent: Reals, rounding: Reals | float = 0.0
) -> Differences:
    """Every difference that can be taken, over its scale, by the quantity's name.

    ``rounding`` is the share of the limit that rounding alone accounts for. It goes with what the
    other quantities make of a quantity, also of one that is nought: so does then its scale.
    """
    scales = Scales.of(solved.motion, extent, np.maximum(FLOOR, rounding))
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
    return compared | dict(centre_differences(solved.motion, solution, scales))


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
