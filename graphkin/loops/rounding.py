"""How far rounding may lead each quantity from the truth, whoever solves the equations in doubles.

Drawn or computed, a position meets the loop equations to some units of their terms, f(φ) = r, and
is off by at most abs(J⁻¹)·abs(r): each element of J⁻¹ holds the product of the crossings on the way
from an equation to an unknown, 1/s for every sine s. The equations of the rates, J·φ̇ = b and
J·φ̈ = c, are met likewise, by vectors that the error of the position has turned: 1/s² and 1/s³.
All sums are of magnitudes, so that no bound depends on errors that cancel.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.loops.equations import Equations
from graphkin.loops.loop_motion import Motion, SlideRates
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.scene.link_points import ends_of

UNIT = 4 * 2.0**-52
"""Share of its terms by which a sound computation in doubles misses an equation at most."""
AGAIN = 4
"""How many times the first-order error a position may be off where it is nearly singular."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]


class PlaceBound(NamedTuple):
    """Bounds of the errors of a place (m), a velocity (m/s) and an acceleration (m/s²): (N, …)."""

    place: Reals
    velocity: Reals
    acceleration: Reals


class Loads(Struct, frozen=True, eq=False):
    """Magnitudes for every turning, the frame's first (N, K + 1), and for every slide (N, m)."""

    turned: Reals
    slid: Reals


class Vectors(Struct, frozen=True, eq=False):
    """Magnitudes of vectors in rows of chains: ``turned`` (N, R, K + 1) by turning, and ``along``
    (N, R, m), which is 1 where a slide is passed; ``carrier`` (m,) are the turnings of the slides.
    """

    turned: Reals
    along: Reals
    carrier: np.ndarray[Any, np.dtype[np.intp]]

    def sum(self, loads: Loads) -> Reals:
        """The longest sum of the vectors times their loads, whatever their directions: (N, R)."""
        turned = self.turned @ loads.turned[:, :, None] + self.along @ loads.slid[:, :, None]
        return np.asarray(turned[:, :, 0])

    def bent(self, off: Loads) -> Reals:
        """The second-order change of the rows when the unknowns are off: half f″ twice."""
        held = off.turned[:, self.carrier]
        return self.sum(Loads(off.turned**2 / 2, off.slid * held))

    def moved(self, off: Loads, places: Reals) -> Vectors:
        """How far the tips of the vectors move, with the rounding of the ``places`` (N, K + 1)."""
        shaken = self.turned * (off.turned[:, None, :] + UNIT)
        shaken += np.where(self.turned > 0, places[:, None, :], 0)
        for j, k in enumerate(self.carrier):
            shaken[:, :, k] += self.along[:, :, j] * off.slid[:, None, j]
        along = self.along * (off.turned[:, None, self.carrier] + UNIT)
        return Vectors(shaken, along, self.carrier)

    def plus(self, other: Vectors) -> Vectors:
        """Every vector longer by another."""
        return Vectors(self.turned + other.turned, self.along + other.along, self.carrier)

    def carried(self, rate: Loads, second: Loads) -> Loads:
        """What accelerations load the vectors with: by the second derivatives, and by the rates."""
        held = 2 * rate.turned[:, self.carrier]
        return Loads(second.turned + rate.turned**2, second.slid + rate.slid * held)

    def carried_more(self, rate: Loads, more: Loads) -> Loads:
        """How much the parts by the rates grow when these are off by ``more``."""
        held, extra = rate.turned[:, self.carrier], more.turned[:, self.carrier]
        sliding = 2 * (rate.slid * extra + more.slid * (held + extra))
        return Loads(more.turned * (2 * rate.turned + more.turned), sliding)


class Rounding(Struct, frozen=True, eq=False):
    """Bounds of the errors of a motion, laid out as it is: SI units, each of shape (N, …).

    ``angles`` (N, K + 1) are those of the turnings. ``regular`` (N,) tells where the position is
    so far from every singular one that its rates are known at all.
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
        """The equations of the motion."""
        return self.motion.loops

    def point(self, name: str) -> PlaceBound:
        """Of a point; ``A@3`` is the point of link 3 under A."""
        point, carrier = ends_of(name)
        p = self.motion.names[point]
        if carrier:
            return self.carried(carrier, self.motion.points.place[:, p], self.points.place[:, p])
        return PlaceBound(*(row[:, p] for row in self.points))

    def carried(self, link: str, place: Complexes, error: Reals | float = 0.0) -> PlaceBound:
        """Of the point of a link that stands at a place, which has an error of its own."""
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
        """Of a block along guide j."""
        guide = self.loops.guides[j]
        i = self.motion.index[guide.on]
        heading = self.angles[:, self.loops.turned.of[guide.on]]
        omega, speed = abs(self.motion.omega[:, i]), abs(self.motion.slides[1, :, j])
        position, rate, thrust = self.slides[:, :, j]
        product = speed * (self.omega[:, i] + omega * heading) + (omega + self.omega[:, i]) * rate
        return SlideRates(position, rate, thrust, 2 * (product + UNIT * omega * speed))


class PositionBounds(Struct, frozen=True, eq=False):
    """How sure a position is: ``off`` (N, K + m) bounds the errors of its unknowns.

    ``regular`` marks the unknowns that the equations determine to first order; ``places`` are
    the roundings of coordinates by turning, ``inverse`` the magnitudes of J⁻¹.
    """

    loops: Equations
    rows: Vectors
    places: Reals
    inverse: Reals
    off: Reals
    regular: Flags

    @classmethod
    def of(cls, loops: Equations, unknowns: Reals) -> PositionBounds:
        """Bounded at a closed position."""
        still, jacobian = np.zeros_like(unknowns), loops.scaled_jacobian(loops.chains.at(unknowns))
        return cls.about(Motion.of(loops, unknowns, still, still), unknowns, jacobian)

    @classmethod
    def about(cls, motion: Motion, unknowns: Reals, jacobian: Reals) -> PositionBounds:
        """The same, from a motion there and the scaled Jacobian (N, equations, K + m)."""
        still, inverse = np.zeros_like(unknowns), abs_inverse(motion.loops, jacobian)
        vectors, places = vectors_of(motion, unknowns), places_of(motion)
        return cls(motion.loops, vectors, places, inverse, still, still == 0).bounded(unknowns)

    def bounded(self, unknowns: Reals) -> PositionBounds:
        """With the bounds: to first order, and by how much the loops bend within that."""
        loops, rows = self.loops, self.rows
        shaken = rows.moved(self.split(self.off), self.places).turned.sum(axis=-1)
        first = self.led(shaken, straight(loops, unknowns) + whole_turns(loops))
        bent = self.led(4 * rows.bent(self.split(first)))
        regular = bent <= first
        return replace(self, off=np.where(regular, first + bent, AGAIN * first), regular=regular)

    def led(self, missed: Reals, linear: Reals | None = None) -> Reals:
        """How far unknowns are off when the rows, and the linear equations, miss so much."""
        loops, links = self.loops, len(self.loops.links)
        closed = missed[:, links : links + len(loops.closing)]
        if linear is None:
            linear = np.zeros((len(missed), len(loops.slips.links) + len(loops.drives.turns)))
        every = np.concatenate([closed, closed, linear], axis=1)
        return np.asarray((self.inverse @ every[:, :, None])[:, :, 0])

    def split(self, values: Reals) -> Loads:
        """Magnitudes of unknowns or their derivatives by turning and by slide."""
        return Loads(*(abs(part) for part in self.loops.chains.split(values)))

    @property
    def lost(self) -> Reals:
        """The bounds as rates see them: an unknown that is not regular may stand anywhere."""
        return np.where(self.regular, self.off, np.maximum(self.off, self.loops.columns))


def rounding(
    loops: Equations, unknowns: Reals, rates: Reals, seconds: Reals, jacobian: Reals
) -> Rounding:
    """The bounds at a position found, from the unknowns and their derivatives, (N, K + m) each, and
    the Jacobian there with each equation and unknown over its own size.
    """
    motion = Motion.of(loops, unknowns, rates, seconds)
    links, points = len(loops.links), len(loops.links) + len(loops.closing)
    with np.errstate(all="ignore"):
        found = PositionBounds.about(motion, unknowns, jacobian)
        rows, places, split = found.rows, found.places, found.split
        off, speed, thrust = split(found.off), split(rates), split(seconds)
        moved = rows.moved(split(found.lost), places)
        longer = rows.plus(moved)
        velocity = moved.sum(speed)
        linear = straight(loops, rates) + touching(loops, speed, places)
        linear += lifted(loops, unknowns, found.off, (rates, None, None))
        less = found.led(velocity, linear)
        slower = split(less)
        carried = rows.carried(speed, thrust)
        acceleration = moved.sum(carried) + longer.sum(rows.carried_more(speed, slower))
        linear = straight(loops, seconds) + touching(loops, carried, places)
        linear += lifted(loops, unknowns, found.off, (rates, seconds, less))
        later = split(found.led(acceleration, linear))
        every = PlaceBound(
            rows.moved(off, places).turned.sum(axis=-1) + places[:, :1],
            velocity + longer.sum(slower),
            acceleration + longer.sum(later),
        )
    which = [loops.turned.of[link] for link in loops.links]
    return Rounding(
        motion=motion,
        angles=off.turned,
        origin=PlaceBound(*(row[:, :links] for row in every)),
        omega=slower.turned[:, which],
        epsilon=later.turned[:, which],
        points=PlaceBound(*(row[:, points:] for row in every)),
        slides=np.stack([off.slid + 2 * places[:, rows.carrier], slower.slid, later.slid]),
        regular=np.asarray(found.regular.all(axis=1)),
    )


def vectors_of(motion: Motion, unknowns: Reals) -> Vectors:
    """The vectors of the chains to every link, of those that close, and of those to every point."""
    loops = motion.loops
    chains = loops.chains
    _, slides = chains.split(unknowns)
    count = len(unknowns)
    turned = np.array(np.broadcast_to(abs(chains.fixed), (count, *chains.fixed.shape[1:])))
    along = np.array(np.broadcast_to(abs(chains.slid), (count, *chains.slid.shape)))
    for j, k in enumerate(chains.carrier):
        turned[:, :, k] += along[:, :, j] * abs(slides[:, None, j])
    owners, arms = loops.owners
    reaching = turned[:, owners]
    for p, owner in enumerate(owners):
        reaching[:, p, loops.turned.of[loops.links[owner]]] += abs(arms[:, p])
    turned = np.concatenate([turned, reaching], axis=1)
    along = np.concatenate([along, along[:, owners]], axis=1)
    return Vectors(np.asarray(turned, dtype=np.float64), along, chains.carrier)


def places_of(motion: Motion) -> Reals:
    """The rounding of the coordinates of what each turning carries, which count from the origin."""
    loops = motion.loops
    far = np.zeros((len(motion.heading), loops.turned.count))
    for link, body in loops.bodies.items():
        k, i = loops.turned.of[link], motion.index[link]
        far[:, k] = np.maximum(far[:, k], abs(motion.origin.place[:, i]))
        for point in body:
            p = motion.names.get(point)
            if p is not None:
                far[:, k] = np.maximum(far[:, k], abs(motion.points.place[:, p]))
    return UNIT * far


def straight(loops: Equations, values: Reals) -> Reals:
    """The rounding of the equations that are linear in unknowns, or in their rates: (N, R + D)."""
    terms = abs(loops.linear_rows()) @ abs(values)[:, :, None]
    return np.asarray(UNIT * terms[:, :, 0])


def touching(loops: Equations, loads: Loads, places: Reals) -> Reals:
    """What the rounding of the points where wheels touch adds to the rates of those equations."""
    turned = (abs(loops.slips.rows) > 0)[:, :, : loops.turning_count]
    slips = (turned @ (loads.turned * places)[:, 1:, None])[:, :, 0]
    return np.concatenate([slips, np.zeros((len(slips), len(loops.drives.turns)))], axis=1)


def lifted(
    loops: Equations, unknowns: Reals, off: Reals, motion: tuple[Reals, Reals | None, Reals | None]
) -> Reals:
    """What the errors ``off`` of cams' angles add to the rates of their followers: (N, R + D).

    To the first ones by the rates of the unknowns; to the second with these, the second ones and
    the bounds of the first.
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


def whole_turns(loops: Equations) -> Reals:
    """What rounding adds to those equations where angles count from a start, or from a quarter."""
    drives = np.where(loops.drives.turns, UNIT, 0.0)
    shape = (loops.numbers.count, len(loops.drives.turns))
    slips = np.broadcast_to(UNIT * abs(loops.slips.constant), (shape[0], len(loops.slips.links)))
    return np.concatenate([slips, np.broadcast_to(drives, shape)], axis=1)


def abs_inverse(loops: Equations, scaled: Reals) -> Reals:
    """Magnitudes of the elements of J⁻¹ (N, unknowns, equations); infinite where J has none.

    It is given ``scaled``, each equation and unknown over its own size. Where there are more
    equations than unknowns, the inverse is that by least squares.
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
