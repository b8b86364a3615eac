"""Newton's method on the loop equations, velocity and acceleration ratios, and the motion.

From f(φ, q) = 0 follow the velocity ratios τ_d = ∂φ/∂q_d = -J⁻¹ ∂f/∂q_d and, derived once more,
∂τ_d/∂q_e = -J⁻¹ f″(τ_d, τ_e); then φ̇ = Σ τ_d q̇_d and φ̈ = Σ τ_d q̈_d + Σ (∂τ_d/∂q_e) q̇_d q̇_e.
One scene is a batch of one: all arrays carry the N settings first.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.loops.closing_groups import Mask
from graphkin.loops.equations import UNIT, Equations, Linear
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton_start import start_values
from graphkin.loops.rigid_bodies import Reals
from graphkin.loops.rounding import Rounding, rounding, straight
from graphkin.text.errors import Problem, StructureError, WitnessError

ITERATIONS = 60
SETTLED = 1e-12
"""A step of Newton's method, in the sizes of the unknowns, after which the next is rounding."""
NEAR = 1e-6
"""A step below which steps that no longer shrink are rounding too."""
AT_REST = 1e-13
"""Closure error, in the sizes of the equations, at which a longer step than that only shows that
J is singular."""
LONGEST = 0.5
"""Longest step taken at once, in radians or the sizes of slides."""
CLOSED = 1e-9
"""Closure error, in the sizes of the equations, at which a mechanism counts as closed."""
ROUNDED = 4
"""Roundings of an equation's terms by which it may be open."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]


class Report(Struct, frozen=True, eq=False):
    """How Newton's method went; arrays of shape (N,).

    ``residual`` is the closure error (m) before the first iteration, ``remains`` after the last;
    ``moved`` (m) the farthest that an unknown went; angles are measured on the longest bar.
    ``closed`` marks the settings that closed, ``good`` those that did so in a position that no
    rounding can make singular.
    """

    residual: Reals
    remains: Reals
    moved: Reals
    iterations: int
    closed: Flags
    good: Flags


class Ratios(Struct, frozen=True, eq=False):
    """Velocity ratios τ (N, unknowns, D) and their derivatives ∂τ_d/∂q_e (N, unknowns, D, D)."""

    velocity: Reals
    acceleration: Reals

    def rates(self, speed: Reals) -> Reals:
        """φ̇ from the drivers' speeds (N, D)."""
        return np.asarray(np.einsum("nud,nd->nu", self.velocity, speed))

    def accelerations(self, speed: Reals, acceleration: Reals) -> Reals:
        """φ̈ from the drivers' speeds and accelerations (N, D)."""
        steady = np.einsum("nude,nd,ne->nu", self.acceleration, speed, speed)
        return np.asarray(steady + np.einsum("nud,nd->nu", self.velocity, acceleration))


class LoopSolution(Struct, frozen=True, eq=False):
    """The loop equations solved: unknowns φ (N, unknowns), ratios, motion, bounds and report."""

    loops: Equations
    unknowns: Reals
    ratios: Ratios
    motion: Motion
    rounding: Rounding
    report: Report


def solve(
    loops: Equations,
    places: Mapping[str, object],
    slides: Mapping[str, object] | None = None,
) -> LoopSolution:
    """Close the loops from given positions of points (m) and find the motion.

    ``slides`` may give slide coordinates (m) by block. Raises StructureError when the drivers are
    too few, WitnessError when one scene does not close or is singular; a batch gives NaN there.
    """
    refuse_undriven(loops)
    with np.errstate(all="ignore"):
        start = start_values(loops, places, slides or {})
    return closed_from(loops, start.unknowns)


def closed_from(
    loops: Equations, start: Reals, *, accelerations: bool = True, singular: bool = False
) -> LoopSolution:
    """Close the loops from unknowns (N, K + m) and find the motion; raises as ``solve`` does.

    Without ``accelerations`` those of the motion are NaN, and the equations are derived only once.
    With ``singular`` positions count in which no rate is sure, which the bounds then show.
    """
    refuse_undriven(loops)
    with np.errstate(all="ignore"):
        found, iterations = newton(loops, start)
        linear = loops.chains.at(found)
        missed, jacobian = loops.residual(linear, found), loops.scaled_jacobian(linear)
        open_now = np.abs(missed / loops.rows)
        closed = np.asarray((open_now < open_at_most(loops, found)).all(axis=1))
        ratios = ratios_about(loops, linear, jacobian, accelerations=accelerations)
        rates, seconds = ratios.rates(loops.drives.speed), None
        if accelerations:
            seconds = ratios.accelerations(loops.drives.speed, loops.drives.acceleration)
        motion = Motion.of(loops, found, rates, seconds)
        bounds = rounding(motion, found, rates, seconds, jacobian)
        good = closed & (bounds.regular | singular)
        moved = largest((found - start) / loops.columns) * loops.size
        before, remains = gap(loops, start), widest_gap(loops, missed)
        report = Report(before, remains, moved, iterations, closed, good)
        if loops.numbers.single:
            refuse_failure(loops, found, report)
        if good.all():
            return LoopSolution(loops, found, ratios, motion, bounds, report)
        unknowns, rates = (np.where(good[:, None], values, np.nan) for values in (found, rates))
        seconds = None if seconds is None else np.where(good[:, None], seconds, np.nan)
        motion = Motion.of(loops, unknowns, rates, seconds)
    return LoopSolution(loops, unknowns, ratios, motion, bounds, report)


def newton(
    loops: Equations,
    start: Reals,
    moving: Mask | None = None,
    most: int = ITERATIONS,
    settled: float = SETTLED,
) -> tuple[Reals, int]:
    """Newton–Raphson from the start values; steps longer than ``LONGEST`` are shortened to it.

    Only the unknowns ``moving`` change, all of them without it; more equations than unknowns are
    met by least squares. Gives the unknowns and the number of iterations, of which there are at
    ``most`` so many; a step shorter than ``settled`` is the last. Of many starts in one setting
    those that have settled are left alone.
    """
    unknowns, done = start.copy(), np.zeros(len(start), dtype=np.bool_)
    columns = np.ones(start.shape[1], dtype=np.bool_) if moving is None else moving
    before, some = np.full(len(start), np.inf), np.arange(len(start))
    iterations = 0
    while iterations < most and not done.all():
        if loops.numbers.single:
            some = np.flatnonzero(~done)
        residual, jacobian = scaled(loops, unknowns[some])
        step = np.zeros_like(unknowns[some])
        step[:, columns] = -moving_step(residual, jacobian, columns)
        length = largest(step)
        end = done[some] | ~np.isfinite(length)
        end |= (length > 0.9 * before[some]) & (before[some] < NEAR)
        end |= (largest(residual) < AT_REST) & (length > NEAR)
        shortened = step * np.minimum(1, LONGEST / np.maximum(length, LONGEST))[:, None]
        moved = unknowns[some] + shortened * loops.columns
        unknowns[some] = np.where(end[:, None], unknowns[some], moved)
        done[some] = end | (length < settled)
        before[some], iterations = length, iterations + 1
    return unknowns, iterations


def moving_step(residual: Reals, jacobian: Reals, moving: Mask) -> Reals:
    """How far the unknowns that move are off (N, moving), by the equations in which they stand."""
    part = jacobian[:, :, moving]
    rows = np.flatnonzero((part != 0).any(axis=(0, 2)))
    return linear_solve(part[:, rows], residual[:, rows, None])[:, :, 0]


def scaled(loops: Equations, unknowns: Reals, linear: Linear | None = None) -> tuple[Reals, Reals]:
    """Residual (N, e) and Jacobian (N, e, u), each equation and unknown over its own size.

    ``linear`` are the vectors there, where they are known.
    """
    linear = loops.chains.at(unknowns) if linear is None else linear
    return loops.residual(linear, unknowns) / loops.rows, loops.scaled_jacobian(linear)


def largest(rows: Reals) -> Reals:
    """Largest magnitude in each row."""
    return np.asarray(np.abs(rows).max(axis=1, initial=0.0))


def linear_solve(matrix: Reals, right: Reals) -> Reals:
    """Solve stacks of equations; least squares where there are more than unknowns, or singular.

    Shapes (N, e, u) and (N, e, R) give (N, u, R); settings with a NaN stay NaN. Equations that have
    none of the unknowns in any setting tell nothing.
    """
    finite = finite_rows(matrix) & finite_rows(right)
    told = matrix[finite].any(axis=(0, 2))
    if np.count_nonzero(told) == matrix.shape[2]:
        matrix, right = matrix[:, told], right[:, told]
    matrix = np.where(finite[:, None, None], matrix, np.eye(*matrix.shape[1:]))
    right = np.where(finite[:, None, None], right, np.nan)
    if matrix.shape[1] == matrix.shape[2]:
        try:
            return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
        except np.linalg.LinAlgError:
            pass
    return np.asarray(np.linalg.pinv(matrix) @ right)


def finite_rows(stack: Reals) -> Flags:
    """Where every number of a matrix of a stack is finite."""
    if len(stack) == 1:
        return np.array([np.isfinite(stack).all()])
    return np.asarray(np.isfinite(stack).all(axis=(1, 2)))


def open_at_most(loops: Equations, unknowns: Reals) -> Reals:
    """How far each equation of a closed mechanism may be open, in its own size: (N, e).

    Angles of many turns, and ways of many lengths, leave those of wheels and drivers open by their
    own rounding, and closed chains by that of their angles.
    """
    linear = ROUNDED * (straight(loops, unknowns) + loops.whole_turns)
    links, count = len(loops.links), loops.turned.count
    turned = loops.magnitudes[:, links : links + len(loops.closing), 1:count]
    chains = UNIT * (turned @ abs(unknowns[:, : count - 1, None]))[:, :, 0]
    opened = np.concatenate([chains, chains, linear], axis=1) / loops.rows
    return np.maximum(CLOSED, opened)


def gap(loops: Equations, unknowns: Reals) -> Reals:
    """The largest closure error (m), angles of drivers measured on the longest bar: (N,)."""
    return widest_gap(loops, loops.residual(loops.chains.at(unknowns), unknowns))


def widest_gap(loops: Equations, missed: Reals) -> Reals:
    """The same from what the equations are missed by: (N,)."""
    turns = np.zeros(missed.shape[1], dtype=np.bool_)
    turns[len(turns) - len(loops.drives.turns) :] = loops.drives.turns
    return largest(missed * np.where(turns, loops.size[:, None], 1))


def ratios_at(loops: Equations, unknowns: Reals, *, accelerations: bool = True) -> Ratios:
    """Velocity ratios τ_d and acceleration ratios ∂τ_d/∂q_e at a closed position, or those NaN."""
    linear = loops.chains.at(unknowns)
    jacobian = loops.scaled_jacobian(linear)
    return ratios_about(loops, linear, jacobian, accelerations=accelerations)


def ratios_about(
    loops: Equations, linear: Linear, jacobian: Reals, *, accelerations: bool
) -> Ratios:
    """The same from the vectors in that position and the scaled Jacobian.

    Each equation and unknown is counted in its own size, so that metres do not drown radians.
    """
    units, sizes = loops.columns[:, :, None], loops.rows[:, :, None]
    count, rows, columns = jacobian.shape
    drivers = len(loops.drives.turns)
    by_driver = np.zeros((count, rows, drivers))
    by_driver[:, rows - drivers :, :] = -np.eye(drivers)
    velocity = -linear_solve(jacobian, by_driver / sizes) * units
    if not accelerations:
        return Ratios(velocity, np.full((count, columns, drivers, drivers), np.nan))
    curved = [
        loops.second(linear, velocity[:, :, d], velocity[:, :, e])
        for d in range(drivers)
        for e in range(drivers)
    ]
    if not curved:
        return Ratios(velocity, np.zeros((count, columns, 0, 0)))
    acceleration = -linear_solve(jacobian, np.stack(curved, axis=-1) / sizes) * units
    return Ratios(velocity, acceleration.reshape(count, columns, drivers, drivers))


def refuse_undriven(loops: Equations) -> None:
    """There must be as many equations as unknowns, or more where some are idle."""
    missing = loops.unknown_count - loops.equation_count
    if missing > 0:
        raise StructureError(
            Problem(
                "drivers",
                f"{loops.unknown_count} unknowns but only {loops.equation_count} loop and driver "
                "equations",
                f"{missing} more driver{'s' if missing > 1 else ''}",
            )
        )


def refuse_failure(loops: Equations, unknowns: Reals, report: Report) -> None:
    """Say why one scene has no motion: it does not close, or its position is singular."""
    if report.good[0]:
        return
    if not report.closed[0]:
        spare = loops.equation_count - loops.unknown_count
        hint = (
            f"equations beyond the unknowns ({spare}) must be met, too: what is over-constrained "
            "closes only with lengths that fit"
        )
        raise WitnessError(
            Problem(
                "loops",
                f"the loops do not close: after {report.iterations} iterations "
                f"{report.remains[0]:.3g} m remain open, most at {widest(loops, unknowns)}",
                "lengths and driver positions for which the mechanism can be assembled",
                hint if spare > 0 else "",
            )
        )
    raise WitnessError(
        Problem(
            "loops",
            "singular position, or so near to one that rounding hides the difference",
            "a position in which the drivers' speeds determine all others",
            "which positions are singular depends on the driver: drive another link or move on",
        )
    )


def widest(loops: Equations, unknowns: Reals) -> str:
    """What is farthest from closing: a joint, a place where wheels touch, or a driver."""
    gaps = np.abs(scaled(loops, unknowns)[0][0])
    chains = len(loops.closing)
    joints = np.hypot(gaps[:chains], gaps[chains : 2 * chains])
    drivers = [f"driver {number}" for number in range(1, len(loops.drives.turns) + 1)]
    every = np.concatenate([joints, gaps[2 * chains :]])
    words = [*loops.closing, *loops.slips.words, *drivers]
    return words[int(np.argmax(np.nan_to_num(every, nan=np.inf)))]
