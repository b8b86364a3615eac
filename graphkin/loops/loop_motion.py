"""Position and motion from the loops: of links, of points on them, of blocks on their guides."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from msgspec import Struct

from graphkin.loops.equations import Equations
from graphkin.loops.rigid_bodies import Complexes, Guide, Reals
from graphkin.scene.link_points import ends_of
from graphkin.text.errors import StructureError, message

Spot = tuple[str, int, str]
"""A guide, by its block, its number on the block, and whether it is a track."""


class Pose(Struct, frozen=True, eq=False):
    """The angle of every link's x axis (radians) and the coordinate on every guide (m)."""

    angles: Mapping[str, float]
    coordinates: Mapping[Spot, float]


def spot(guide: Guide) -> Spot:
    """The key of a guide."""
    return guide.block, guide.number, guide.moved_by


def setting_of(loops: Equations, n: int) -> dict[str, Any]:
    """The parameter values of one setting of a batch, or of a single scene."""
    values = loops.numbers.values
    return {name: v[n].item() if hasattr(v, "shape") else v for name, v in values.items()}


def lean(loops: Equations, link: str, setting: int = 0) -> float:
    """Angle (radians) of a link's x axis relative to its turning."""
    return float(loops.numbers.reals(loops.turned.angle[link])[setting])


def pose_of(loops: Equations, row: Reals, setting: int = 0) -> Pose:
    """The pose given by the unknowns (K + m,) of one setting."""
    angles = np.concatenate([[0.0], row[: loops.turning_count]])
    slid = row[loops.turning_count :]
    return Pose(
        {
            link: float(angles[loops.turned.of[link]]) + lean(loops, link, setting)
            for link in loops.links
        },
        {spot(guide): float(s) for guide, s in zip(loops.guides, slid, strict=True)},
    )


def unknowns_of(loops: Equations, pose: Pose) -> Reals:
    """The unknowns (1, K + m) of a pose of one scene; zero where the pose gives no value."""
    row = np.zeros((1, loops.unknown_count))
    for link, angle in pose.angles.items():
        k = loops.turned.of.get(link, 0)
        if k:
            row[0, k - 1] = angle - lean(loops, link)
    for j, guide in enumerate(loops.guides):
        row[0, loops.turning_count + j] = pose.coordinates.get(spot(guide), 0.0)
    return row


class PlaceMotion(NamedTuple):
    """Position (m), velocity (m/s) and acceleration (m/s²) of a point, each of shape (N,).

    The same structure holds the bounds of their errors.
    """

    place: Complexes
    velocity: Complexes
    acceleration: Complexes


class SlideRates(NamedTuple):
    """Coordinate (m), speed (m/s), acceleration (m/s²) along the guide, and Coriolis vector.

    The same structure holds the bounds of their errors; the bound of the vector is a magnitude.
    """

    position: Reals
    speed: Reals
    acceleration: Reals
    coriolis: Complexes | Reals


class Motion(Struct, frozen=True, eq=False):
    """Motion of every link, shape (N, links): of its origin, its angle and its heading.

    ``heading`` is the unit vector of the link's x axis. ``omega`` (rad/s) and ``epsilon`` (rad/s²)
    are positive counter-clockwise. ``points`` (N, points) holds all named points in the order of
    ``names``. ``slides`` holds (s, ṡ, s̈) of every guide, shape (3, N, m).
    """

    loops: Equations
    index: Mapping[str, int]
    origin: PlaceMotion
    heading: Complexes
    omega: Reals
    epsilon: Reals
    names: Mapping[str, int]
    points: PlaceMotion
    slides: Reals

    @classmethod
    def of(cls, loops: Equations, unknowns: Reals, rates: Reals, seconds: Reals | None) -> Motion:
        """The motion from the unknowns φ and their two time derivatives, (N, unknowns).

        Without the second derivatives all accelerations are NaN.
        """
        chains, links = loops.chains, len(loops.links)
        linear = chains.at(unknowns)
        (angle, s), (turn, slid) = map(chains.split, (unknowns, rates))
        which = loops.turning_of_link
        heading, omega = np.exp(1j * angle)[:, which] * loops.leans, turn[:, which]
        owners, arms = loops.owners
        arm = heading[:, owners] * arms
        swung = 1j * omega[:, owners] * arm
        place = linear.place[:, :links] + loops.home[:, None]
        velocity = linear.turned @ (1j * turn[:, 1:, None]) + linear.along @ slid[:, :, None]
        velocity = velocity[:, :links, 0]
        if seconds is None:
            thrust, epsilon = np.full_like(s, np.nan), np.full_like(omega, np.nan)
            acceleration = np.full_like(velocity, np.nan)
            pushed = np.full_like(swung, np.nan)
        else:
            spin, thrust = chains.split(seconds)
            along = linear.turned @ (1j * spin[:, 1:, None]) + linear.along @ thrust[:, :, None]
            acceleration = (along[:, :, 0] + chains.second(linear, rates, rates))[:, :links]
            epsilon = spin[:, which]
            swing = (1j * epsilon[:, owners] - omega[:, owners] ** 2) * arm
            pushed = acceleration[:, owners] + swing
        points = PlaceMotion(place[:, owners] + arm, velocity[:, owners] + swung, pushed)
        return cls(
            loops=loops,
            index=loops.link_index,
            origin=PlaceMotion(place, velocity, acceleration),
            heading=heading,
            omega=omega,
            epsilon=epsilon,
            names=loops.point_index,
            points=points,
            slides=np.stack([s, slid, thrust]),
        )

    def carried(self, link: str, place: Complexes) -> PlaceMotion:
        """Motion of the point of a link that is at a given place (Galileo, Rivals)."""
        i = self.index[link]
        start, velocity, acceleration = (row[:, i] for row in self.origin)
        arm = place - start
        omega, epsilon = self.omega[:, i], self.epsilon[:, i]
        return PlaceMotion(
            place, velocity + 1j * omega * arm, acceleration + (1j * epsilon - omega**2) * arm
        )

    def place(self, name: str) -> Complexes:
        """Position of a named point."""
        return np.asarray(self.points.place[:, self.names[name]])

    def point(self, name: str) -> PlaceMotion:
        """Motion of a point; ``A@3`` is the point of link 3 under A.

        Raises StructureError for an unknown point.
        """
        point, carrier = ends_of(name)
        if point not in self.names or (carrier and carrier not in self.index):
            known = ", ".join(self.names)
            raise StructureError.at(
                "points",
                message("no link has the point {name}", name=name),
                message("one of {names}", names=known),
            )
        p = self.names[point]
        if carrier:
            return self.carried(carrier, self.points.place[:, p])
        return PlaceMotion(*(row[:, p] for row in self.points))

    def slide(self, j: int) -> SlideRates:
        """Motion of a block along guide j; the Coriolis vector is 2 ω of the guide × v_rel."""
        guide = self.loops.guides[j]
        i = self.index[guide.on]
        position, speed, acceleration = self.slides[:, :, j]
        coriolis = 2j * self.omega[:, i] * speed * self.heading[:, i] * guide.along
        return SlideRates(position, speed, acceleration, coriolis)
