"""Centres and poles held against the motion that is left there, which should vanish."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np

from graphkin.loops.bodies import Complexes, Reals
from graphkin.loops.motion import Motion
from graphkin.plane import Ratio
from graphkin.steps.solution import Solution


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


Found = Iterator[tuple[str, Reals]]


def centre_differences(motion: Motion, solution: Solution, scales: Sizes) -> Found:
    """What is left at every centre, acceleration pole and inflection pole of a solution."""
    for name, link in solution.links.items():
        i = motion.index[name]
        omega, epsilon = motion.omega[:, i], motion.epsilon[:, i]
        start, _, acceleration = (row[:, i] for row in motion.origin)
        if link.instant_centre is not None:
            yield (
                f"links.{name}.instant_centre",
                off_centre(motion, link.instant_centre, "0", name, scales),
            )
        if link.acceleration_pole is not None:
            turn = 1j * epsilon - omega**2
            left = left_at(link.acceleration_pole, start, acceleration, turn, scales.length)
            yield f"links.{name}.acceleration_pole", left / scales.acceleration
        if link.inflection_pole is not None:
            yield (
                f"links.{name}.inflection_pole",
                off_inflection(motion, link.inflection_pole, name, scales),
            )
    for pair, centre in solution.centres.items():
        first, second = pair.split("-")
        yield f"centres.{pair}", off_centre(motion, centre, first, second, scales)


def off_centre(motion: Motion, centre: Ratio, first: str, second: str, scales: Sizes) -> Reals:
    """Velocity of the second link against the first at their centre, over the scale of speeds."""
    i, j = motion.index[first], motion.index[second]
    start, velocity, _ = (row[:, j] for row in motion.origin)
    slip = velocity - motion.carried(first, start).velocity
    omega = motion.omega[:, j] - motion.omega[:, i]
    left = left_at(centre, start, slip, 1j * omega, scales.length)
    aside = off_ray(centre, start, slip, scales.length)
    return np.asarray(np.hypot(left, aside) / scales.speed)


def off_inflection(motion: Motion, pole: Ratio, name: str, scales: Sizes) -> Reals:
    """How far a point is from the inflection pole, (aω - εv)/ω³ away from the link's origin.

    The points of the circle on it and the instantaneous centre have no acceleration across their
    velocity: with r from the centre I that is r² = r·a_I/ω², a circle through I and I + a_I/ω².
    Both far away they are held to their inverse distance.
    """
    i = motion.index[name]
    start, velocity, acceleration = (row[:, i] for row in motion.origin)
    omega, epsilon = motion.omega[:, i], motion.epsilon[:, i]
    away = acceleration * omega - epsilon * velocity
    way = (pole.start - start) * pole.size + pole.shift
    weight = np.hypot(abs(np.asarray(pole.size)), abs(way) / scales.length)
    left = abs(way * omega**3 - away * pole.size) / np.where(weight > 0, weight, 1)
    return np.asarray(left / (scales.acceleration * scales.omega))


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
