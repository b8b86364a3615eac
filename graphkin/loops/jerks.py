"""Jerks from the loops, differentiated once more: J·φ⃛ = q⃛ - 3f″(φ̇, φ̈) - f‴(φ̇, φ̇, φ̇).

Only a witness of jerks needs them. Their bounds grow like 1/s⁴ with the sine s of a flat crossing.
"""

from __future__ import annotations

import numpy as np
from msgspec import Struct

from graphkin.loops.equations import Equations, Lift
from graphkin.loops.newton import LoopSolution, linear_solve
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.loops.rounding import RateBounds, led, loads, straight, touching
from graphkin.scene.link_points import ends_of


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
        thirds = linear_solve(jacobian, (right / loops.rows)[:, :, None])[:, :, 0] * loops.columns
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
    """The bounds of the jerks of all points and origins, and of what swings their arms.

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
