"""Position and motion from the loops, and bounds of the rounding error of each quantity.

A drawn or computed position satisfies the loop equations to some units of their terms, f(φ) = r.
Its error is at most abs(J⁻¹)·abs(r). Each element of J⁻¹ holds the product of the crossings between
an equation and an unknown: 1/s for every sine s. The equations of the rates, J·φ̇ = b and J·φ̈ = c,
are satisfied likewise, with vectors that the error of the position has turned: 1/s² and 1/s³. All
sums are of magnitudes, so that no bound depends on errors that cancel.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.loops.equations import UNIT, Equations
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
    """Position (m), velocity (m/s) and acceleration (m/s²) of a point, each of shape (N,)."""

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


AGAIN = 4
"""Factor on the first-order error of a position that is nearly singular."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]
Indices = np.ndarray[Any, np.dtype[np.intp]]


class PlaceBound(NamedTuple):
    """Error bounds of a position (m), a velocity (m/s), an acceleration (m/s²): (N, …)."""

    place: Reals
    velocity: Reals
    acceleration: Reals


class Vectors(Struct, frozen=True, eq=False):
    """Magnitudes of the vectors in rows of chains: ``every`` (N, R, 1 + U).

    The columns are the turnings, the frame's first, then 1 for each slide in the chain.
    ``turned_by`` (1 + U,) are the turnings of all columns, ``count`` is the number of turnings, and
    ``twice`` (1 + U,) is 2 for slides. Loads on the vectors, such as errors or rates of unknowns,
    are magnitudes (N, 1 + U), 0 for the frame.
    """

    every: Reals
    turned_by: Indices
    twice: Reals
    count: int

    def sum(self, loads: Reals) -> Reals:
        """The longest sum of the vectors times their loads, for any directions: (N, R)."""
        return np.asarray((self.every @ loads[:, :, None])[:, :, 0])

    def ends(self) -> Reals:
        """The largest error of the ends of the chains, by what turns: (N, R)."""
        return np.asarray(self.every[:, :, : self.count].sum(axis=-1))

    def bent(self, off: Reals) -> Reals:
        """The second-order change of the rows for an error of the unknowns: half f″ twice."""
        return self.sum(off * off[:, self.turned_by] * (self.twice / 2))

    def moved(self, off: Reals, places: Reals) -> Vectors:
        """The movement of the vectors' tips, with the rounding of the ``places`` (N, K + 1)."""
        shaken = self.every * (off[:, None, self.turned_by] + UNIT)
        turned = shaken[:, :, : self.count]
        turned += np.where(self.every[:, :, : self.count] > 0, places[:, None, :], 0)
        for j in range(self.count, len(self.twice)):
            turned[:, :, self.turned_by[j]] += self.every[:, :, j] * off[:, None, j]
        return replace(self, every=shaken)

    def plus(self, other: Vectors) -> Vectors:
        """The vectors, each longer by another."""
        return replace(self, every=self.every + other.every)

    def carried(self, rate: Reals, second: Reals) -> Reals:
        """The loads of accelerations on the vectors: by the second derivatives and by the rates."""
        return np.asarray(second + self.twice * rate * rate[:, self.turned_by])

    def carried_thrice(self, rate: Reals, second: Reals, third: Reals) -> Reals:
        """The loads of jerks on the vectors: by the third derivatives, and by the lower ones.

        3θ̇θ̈ + θ̇³ for what turns, 3(ṡθ̈ + s̈θ̇) + 3ṡθ̇² for slides.
        """
        turn, twist = rate[:, self.turned_by], second[:, self.turned_by]
        mixed = 1.5 * self.twice * (rate * twist + second * turn)
        return np.asarray(third + mixed + (2 * self.twice - 1) * rate * turn**2)

    def carried_more(self, rate: Reals, more: Reals) -> Reals:
        """The growth of the parts by the rates for an error ``more`` of the rates."""
        held, extra = rate[:, self.turned_by], more[:, self.turned_by]
        return np.asarray(self.twice * (rate * extra + more * (held + extra)))


class Rounding(Struct, frozen=True, eq=False):
    """Bounds of the errors of a motion, structured like the motion: SI units, shape (N, …).

    ``angles`` (N, K + 1) are those of the turnings. ``regular`` (N,) marks positions far enough
    from every singular one that their rates are known.
    """

    motion: Motion
    angles: Reals
    origin: PlaceBound
    omega: Reals
    epsilon: Reals
    points: PlaceBound
    slides: Reals
    regular: Flags

    @property
    def loops(self) -> Equations:
        return self.motion.loops

    def point(self, name: str) -> PlaceBound:
        """The bounds of a point; ``A@3`` is the point of link 3 under A."""
        point, carrier = ends_of(name)
        p = self.motion.names[point]
        if carrier:
            return self.carried(carrier, self.motion.points.place[:, p], self.points.place[:, p])
        return PlaceBound(*(row[:, p] for row in self.points))

    def carried(self, link: str, place: Complexes, error: Reals | float = 0.0) -> PlaceBound:
        """The bounds of the point of a link at a given place, which has an error of its own."""
        i = self.motion.index[link]
        start, velocity, acceleration = (row[:, i] for row in self.origin)
        arm, off = abs(place - self.motion.origin.place[:, i]), start + error
        omega, epsilon = abs(self.motion.omega[:, i]), abs(self.motion.epsilon[:, i])
        turn, twist = self.omega[:, i], self.epsilon[:, i]
        return PlaceBound(
            np.asarray(error),
            velocity + off * omega + (arm + off) * turn,
            acceleration
            + off * (epsilon + omega**2)
            + (arm + off) * (twist + turn * (2 * omega + turn)),
        )

    def slide(self, j: int) -> SlideRates:
        """The bounds of a block along guide j."""
        guide = self.loops.guides[j]
        i = self.motion.index[guide.on]
        heading = self.angles[:, self.loops.turned.of[guide.on]]
        omega, speed = abs(self.motion.omega[:, i]), abs(self.motion.slides[1, :, j])
        position, rate, thrust = self.slides[:, :, j]
        product = speed * (self.omega[:, i] + omega * heading) + (omega + self.omega[:, i]) * rate
        return SlideRates(position, rate, thrust, 2 * (product + UNIT * omega * speed))


class PositionBounds(Struct, frozen=True, eq=False):
    """The certainty of a position: ``off`` (N, K + m) bounds the errors of its unknowns.

    ``regular`` marks the unknowns that the equations determine to first order. ``places`` are the
    roundings of coordinates by turning, and ``inverse`` the magnitudes of J⁻¹.
    """

    loops: Equations
    rows: Vectors
    places: Reals
    inverse: Reals
    off: Reals
    regular: Flags

    @classmethod
    def of(cls, loops: Equations, unknowns: Reals) -> PositionBounds:
        """The bounds at a closed position."""
        still, jacobian = np.zeros_like(unknowns), loops.scaled_jacobian(loops.chains.at(unknowns))
        return cls.about(Motion.of(loops, unknowns, still, None), unknowns, jacobian)

    @classmethod
    def about(cls, motion: Motion, unknowns: Reals, jacobian: Reals) -> PositionBounds:
        """The bounds from a motion at a position and the scaled Jacobian (N, equations, K + m).

        They hold the first-order error and the curvature of the loops within it.
        """
        loops, inverse = motion.loops, abs_inverse(motion.loops, jacobian)
        rows, places = vectors_of(loops, unknowns), places_of(motion)
        shaken = rows.moved(loads(np.zeros_like(unknowns)), places).ends()
        first = led(loops, inverse, shaken, straight(loops, unknowns) + loops.whole_turns)
        bent = led(loops, inverse, 4 * rows.bent(loads(first)))
        regular = bent <= first
        off = np.where(regular, first + bent, AGAIN * first)
        return cls(loops, rows, places, inverse, off, regular)

    @property
    def lost(self) -> Reals:
        """The bounds as used for rates: an unknown that is not regular may have any value."""
        return np.where(self.regular, self.off, np.maximum(self.off, self.loops.columns))


def loads(values: Reals) -> Reals:
    """Magnitudes of unknowns or their derivatives, with the frame's first: (N, 1 + U)."""
    found = np.zeros((len(values), values.shape[1] + 1))
    np.abs(values, out=found[:, 1:])
    return found


def led(loops: Equations, inverse: Reals, missed: Reals, linear: Reals | None = None) -> Reals:
    """The errors of the unknowns for given residuals of the rows and the linear equations."""
    links = len(loops.links)
    closed = missed[:, links : links + len(loops.closing)]
    if linear is None:
        linear = np.zeros((len(missed), len(loops.slips.links) + len(loops.drives.turns)))
    every = np.concatenate([closed, closed, linear], axis=1)
    return np.asarray((inverse @ every[:, :, None])[:, :, 0])


class RateBounds(Struct, frozen=True, eq=False):
    """The bounds of a motion in the unknowns and in the ends of all chains.

    ``off``, ``slower`` and ``later`` (N, 1 + K + m) bound the unknowns and their two derivatives,
    ``place``, ``velocity`` and ``acceleration`` (N, R) the chains. ``moved`` are the vectors that
    the error of the position adds, ``longer`` all of them.
    """

    position: PositionBounds
    moved: Vectors
    longer: Vectors
    off: Reals
    slower: Reals
    later: Reals
    place: Reals
    velocity: Reals
    acceleration: Reals

    @classmethod
    def of(
        cls, motion: Motion, unknowns: Reals, rates: Reals, seconds: Reals | None, jacobian: Reals
    ) -> RateBounds:
        """The bounds at a position, as ``rounding`` takes it."""
        loops = motion.loops
        found = PositionBounds.about(motion, unknowns, jacobian)
        rows, places, inverse = found.rows, found.places, found.inverse
        off, speed = loads(found.off), loads(rates)
        place = rows.moved(off, places).ends() + places[:, :1]
        moved = rows.moved(loads(found.lost), places)
        velocity = moved.sum(speed)
        linear = straight(loops, rates) + touching(loops, speed, places)
        linear += lifted(loops, unknowns, found.off, (rates, None, None))
        linear[:, len(loops.slips.links) :] += loops.drives.errors[1]
        less = led(loops, inverse, velocity, linear)
        slower, longer = loads(less), rows.plus(moved)
        velocity = velocity + longer.sum(slower)
        later, acceleration = np.full_like(slower, np.nan), np.full_like(velocity, np.nan)
        if seconds is not None:
            carried = rows.carried(speed, loads(seconds))
            acceleration = moved.sum(carried) + longer.sum(rows.carried_more(speed, slower))
            linear = straight(loops, seconds) + touching(loops, carried, places)
            linear += lifted(loops, unknowns, found.off, (rates, seconds, less))
            linear[:, len(loops.slips.links) :] += loops.drives.errors[2]
            later = loads(led(loops, inverse, acceleration, linear))
            acceleration = acceleration + longer.sum(later)
        return cls(found, moved, longer, off, slower, later, place, velocity, acceleration)


def rounding(
    motion: Motion, unknowns: Reals, rates: Reals, seconds: Reals | None, jacobian: Reals
) -> Rounding:
    """The bounds of a motion, from the unknowns and their derivatives, (N, K + m) each.

    ``jacobian`` is the one there, with each equation and unknown divided by its own size. Without
    ``seconds``, the bounds of all accelerations are NaN.
    """
    loops = motion.loops
    links, points = len(loops.links), len(loops.links) + len(loops.closing)
    with np.errstate(all="ignore"):
        found = RateBounds.of(motion, unknowns, rates, seconds, jacobian)
    rows, off, slower, later = found.position.rows, found.off, found.slower, found.later
    places = found.position.places
    which, turnings = loops.turning_of_link, rows.count
    every = PlaceBound(found.place, found.velocity, found.acceleration)
    slid = off[:, turnings:] + 2 * places[:, rows.turned_by[turnings:]]
    return Rounding(
        motion=motion,
        angles=off[:, :turnings],
        origin=PlaceBound(*(row[:, :links] for row in every)),
        omega=slower[:, which],
        epsilon=later[:, which],
        points=PlaceBound(*(row[:, points:] for row in every)),
        slides=np.stack([slid, slower[:, turnings:], later[:, turnings:]]),
        regular=np.asarray(found.position.regular.all(axis=1)),
    )


def vectors_of(loops: Equations, unknowns: Reals) -> Vectors:
    """The vectors of the chains to every link, of those that close, and of those to every point."""
    fixed, count = loops.magnitudes, loops.turned.count
    every = np.array(np.broadcast_to(fixed, (len(unknowns), *fixed.shape[1:])))
    for j, k in enumerate(loops.chains.carrier):
        every[:, :, k] += every[:, :, count + j] * abs(unknowns[:, None, count - 1 + j])
    return Vectors(every, loops.turned_by, loops.twice, count)


def places_of(motion: Motion) -> Reals:
    """The rounding of coordinates on each turning, which count from the origin."""
    far = abs(np.concatenate([motion.origin.place, motion.points.place], axis=1))
    carried = np.where(motion.loops.carries, far[:, None, :], 0.0)
    return np.asarray(UNIT * carried.max(axis=2, initial=0.0))


def straight(loops: Equations, values: Reals) -> Reals:
    """The rounding of the equations linear in unknowns, or in their rates: (N, R + D)."""
    return np.asarray(UNIT * (loops.linear_sizes @ abs(values)[:, :, None])[:, :, 0])


def touching(loops: Equations, loaded: Reals, places: Reals) -> Reals:
    """The rounding that contact points of wheels add to the rates of those equations."""
    found = np.zeros((len(places), len(loops.slips.links) + len(loops.drives.turns)))
    if loops.slips.links:
        turned = (abs(loops.slips.rows) > 0)[:, :, : loops.turning_count]
        shaken = loaded[:, 1 : loops.turned.count] * places[:, 1:]
        found[:, : len(loops.slips.links)] = (turned @ shaken[:, :, None])[:, :, 0]
    return found


def lifted(
    loops: Equations, unknowns: Reals, off: Reals, motion: tuple[Reals, Reals | None, Reals | None]
) -> Reals:
    """The contribution of errors ``off`` of cams' angles to their followers' rates: (N, R + D).

    The contribution to the first rates comes from the rates of the unknowns. That to the second
    rates comes from these, the second rates and the bounds of the first.
    """
    found = np.zeros((len(unknowns), len(loops.slips.links) + len(loops.drives.turns)))
    rates, seconds, slower = motion
    for lift in loops.drives.lifts:
        shaken, own = unknowns.copy(), lift.way != 0
        shaken[:, own] += off[:, own] * lift.way[own]
        here, there = lift.at(unknowns), lift.at(shaken)
        slope, turn = abs(there.rate - here.rate), abs(lift.of(rates))
        added = slope * turn
        if seconds is not None and slower is not None:
            added = slope * abs(lift.of(seconds)) + abs(there.bend - here.bend) * turn**2
            added += 2 * abs(here.bend) * turn * lift.of(slower, abs(lift.way))
        found[:, len(loops.slips.links) + lift.row] = added
    return found


def abs_inverse(loops: Equations, scaled: Reals) -> Reals:
    """Magnitudes of the elements of J⁻¹ (N, unknowns, equations); infinite where J is singular.

    ``scaled`` is J with each equation and unknown divided by its own size. For more equations than
    unknowns, the inverse is that by least squares.
    """
    columns, rows = loops.columns, loops.rows
    found = np.full((len(scaled), scaled.shape[2], scaled.shape[1]), np.inf)
    finite = np.isfinite(scaled).all(axis=(1, 2))
    if scaled.shape[1] == scaled.shape[2]:
        left, right = scaled[finite], np.eye(scaled.shape[1])
    else:
        turn, left = np.linalg.qr(scaled[finite])
        right = np.swapaxes(turn, 1, 2)
    found[finite] = inverted(left, right)
    return np.asarray(abs(found) * columns[:, :, None] / rows[:, None, :])


def inverted(left: Reals, right: Reals) -> Reals:
    """Solutions of stacks of equations; infinite where the left side is exactly singular."""
    right = np.broadcast_to(right, (len(left), *right.shape[-2:]))
    try:
        return np.asarray(np.linalg.solve(left, right))
    except np.linalg.LinAlgError:
        if len(left) == 1:
            return np.full(right.shape, np.inf)
        return np.concatenate(
            [inverted(left[n : n + 1], right[n : n + 1]) for n in range(len(left))]
        )
