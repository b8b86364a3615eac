"""Centres and poles held against the motion that is left there, which should vanish.

With it come its bound, by the errors of the motion, and the motion that cancels there.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from msgspec import Struct

from graphkin.loops.newton import LoopSolution
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME


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
