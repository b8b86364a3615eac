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


class Jerks(Struct, frozen=True, eq=False):
    """The jerks of all points (N, points), m/s³, with the bounds of their errors."""

    found: Complexes
    bound: Reals


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
        omega, epsilon = motion.omega[:, owners], motion.epsilon[:, owners]
        twist = spin[:, loops.turning_of_link][:, owners]
        swing = 1j * twist - 3 * omega * epsilon - 1j * omega**3
        found = origin[:, owners] + swing * motion.heading[:, owners] * arms
        return Jerks(found, bounds(solved, rates, seconds, thirds, jacobian))


def bounds(
    solved: LoopSolution, rates: Reals, seconds: Reals, thirds: Reals, jacobian: Reals
) -> Reals:
    """The bounds of the jerks of all points, as those of accelerations are found: (N, points)."""
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
    jerk = jerk + found.longer.sum(loads(led(loops, found.position.inverse, jerk, linear)))
    return jerk[:, points_from(loops) :]


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
