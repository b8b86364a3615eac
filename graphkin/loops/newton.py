"""Newton's method on the loop equations, velocity and acceleration ratios, and the motion.

From f(φ, q) = 0 follow the velocity ratios τ_d = ∂φ/∂q_d = -J⁻¹ ∂f/∂q_d. A second derivative gives
∂τ_d/∂q_e = -J⁻¹ f″(τ_d, τ_e). Then φ̇ = Σ τ_d q̇_d and φ̈ = Σ τ_d q̈_d + Σ (∂τ_d/∂q_e) q̇_d q̇_e.
One scene is a batch of one: the first axis of every array is the N settings.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.loops.closing_groups import Mask, moved_by, stages
from graphkin.loops.equations import UNIT, Equations, Linear
from graphkin.loops.loop_motion import Motion, Rounding, rounding, straight
from graphkin.loops.no_slip import within_half_a_turn
from graphkin.loops.rigid_bodies import Complexes, Reals
from graphkin.scene.model import FRAME
from graphkin.text.errors import NO_WORDS, StructureError, WitnessError, message

LOOSE = 1e-9
"""Share of a unit direction below which the linear equations determine an unknown."""


def settled(loops: Equations, read: Reals, determined: Mask) -> tuple[Reals, Mask]:
    """The unknowns (N, K + m) read off positions, with their full turns, and which are now known.

    The linear equations add to the unknowns that are known.
    """
    if not loops.slips.counted:
        return read, determined
    values, determined, known = read.copy(), determined.copy(), np.zeros_like(determined)
    for part in parts_in_order(loops):
        settle(loops, values, determined, known, part)
    settle(loops, values, determined, known, np.ones_like(determined))
    return values, determined


@lru_cache(maxsize=64)
def parts_in_order(loops: Equations) -> tuple[Mask, ...]:
    """The unknowns of each group, in the order in which the groups become known."""
    return tuple(moved_by(loops, group) for group in stages(loops.scene, loops))


def settle(loops: Equations, values: Reals, determined: Mask, known: Mask, part: Mask) -> None:
    """Settle one group's unknowns: first by linear equations, then counted from their start."""
    turning = np.arange(len(part)) < loops.turning_count
    beyond = ~(known | part)
    known |= part & determined & ~turning & ~unrolled(loops, part.tobytes())
    while (free := part & ~known).any():
        straight, solved = solved_straight(loops, np.where(free, 0, values), free, known)
        if solved.any():
            full = 2 * np.pi * np.rint((straight - values) / (2 * np.pi))
            led = np.where(determined & turning, values + full, straight)
            values[:, solved] = led[:, solved]
            determined |= solved
            known |= solved
            continue
        if not (ready := free & determined & turning).any():
            known |= free
            return
        within = np.abs(np.nan_to_num(loops.slips.rows[0][:, beyond])).max(1, initial=0) == 0
        k = min(np.flatnonzero(ready).tolist(), key=lambda k: precedence(loops, k, within))
        values[:, k] = counted(loops, values, k)
        known[k] = True


@lru_cache(maxsize=64)
def unrolled(loops: Equations, part_bytes: bytes) -> Mask:
    """The coordinates along a group's bars that touch a wheel known before the group.

    A wheel's coordinate on its track is the distance it has rolled, also on a known track that
    guides a bar. Where a bar touches its wheel follows from the bar's angle. That angle is counted
    within half a turn, like an angle that only pins determine.
    """
    part, of = np.frombuffer(part_bytes, dtype=np.bool_), loops.turned.of
    found = np.zeros_like(part)
    free = {int(k) + 1 for k in np.flatnonzero(part[: loops.turning_count])}
    tracks = [(of[g.block], of[g.on]) for g in loops.guides if not g.turns_alike]
    led = {wheel for wheel, track in tracks if track not in free}
    for j, guide in enumerate(loops.guides):
        wheel, bar = of[guide.block], of[guide.on]
        known = wheel not in free or wheel in led
        found[loops.turning_count + j] = not guide.turns_alike and known and bar in free
    return found


def precedence(loops: Equations, k: int, within: Mask) -> tuple[bool, float]:
    """The sort key for which of several angles tied by wheels is counted first.

    Arms come first, then the largest wheel. ``within`` marks the wheel contacts between links of
    the group and known ones.
    """
    links, rows = loops.slips.links, loops.slips.rows[0]
    arms = {loops.turned.of[each[-1]] for each, near in zip(links, within, strict=True) if near}
    return k + 1 not in arms, -float(np.abs(rows[within, k]).max(initial=0))


def solved_straight(loops: Equations, values: Reals, free: Mask, known: Mask) -> tuple[Reals, Mask]:
    """The free unknowns by the linear equations alone, and which of them these determine.

    ``values`` holds the known unknowns, and zero for the free ones. Equations that contain other
    unknowns are left out.
    """
    ready, solved, inverse = straight_part(loops, free.tobytes(), known.tobytes())
    found = values.copy()
    if solved.any():
        found = values - (inverse @ loops.linear(values)[:, ready, None])[:, :, 0]
    return found, solved


@lru_cache(maxsize=64)
def straight_part(
    loops: Equations, free_bytes: bytes, known_bytes: bytes
) -> tuple[Mask, Mask, Reals]:
    """The linear equations that hold free and known unknowns alone, which of the free ones they
    determine, and the inverse that leads from their gaps to these, where there are any.
    """
    free, known = (np.frombuffer(each, dtype=np.bool_) for each in (free_bytes, known_bytes))
    scale = np.where(free, loops.columns, 0.0)
    every = np.nan_to_num(loops.linear_rows)
    others = np.abs(every[:, :, ~(known | free)])
    ready = others.max(axis=(0, 2), initial=0) == 0
    waits = np.concatenate([loops.slips.waits, loops.drives.waits])
    ready &= waits[:, ~known].max(axis=1, initial=0) == 0
    rows = every[:, ready] * scale[:, None, :]
    solved = free & settles(rows[0])
    if solved.any():
        rows = np.asarray(np.linalg.pinv(rows) * scale[:, :, None])
    return np.asarray(ready), solved, rows


def settles(rows: Reals) -> Mask:
    """The unknowns that linear equations (R, U) determine: those zero throughout the null space."""
    _, sizes, directions = np.linalg.svd(rows)
    rank = int(np.count_nonzero(sizes > LOOSE * sizes.max(initial=0)))
    left = np.abs(directions[rank:]).max(axis=0, initial=0)
    return np.asarray(left < LOOSE)


def counted(loops: Equations, values: Reals, k: int) -> Reals:
    """The angle of turning unknown k, counted within half a turn of its start: shape (N,)."""
    angle = values[:, k]
    start = loops.slips.counted.get(k + 1)
    return angle if start is None else within_half_a_turn(angle, start)


def counted_freely(loops: Equations, values: Reals, moving: Mask) -> Reals:
    """The unknowns with those angles counted that only closed chains contain."""
    found = values.copy()
    tied = np.abs(np.nan_to_num(loops.linear_rows)).max(axis=(0, 1), initial=0) > 0
    for k in np.flatnonzero(moving & ~tied):
        if k < loops.turning_count:
            found[:, k] = counted(loops, found, int(k))
    return found


def as_meant(loops: Equations, values: Reals, moving: Mask) -> Mask:
    """Where the full turns of a closed group are those that its position implies: (N,)."""
    found = values.copy()
    settle(loops, found, np.ones_like(moving), ~moving, moving)
    return np.asarray(np.abs(found - values).max(axis=1, initial=0) < 1)


Places = Mapping[str, Complexes]


class Start(Struct, frozen=True, eq=False):
    """Unknowns (N, K + m) to start from; the positions give those of ``determined`` (K + m,)."""

    unknowns: Reals
    determined: Mask


def start_values(
    loops: Equations, places: Mapping[str, object], slides: Mapping[str, object]
) -> Start:
    """Unknowns from positions of points (m) and slide coordinates by block (m).

    An angle comes from the longest known bar of its turning, else from a known block on its guide,
    else from a driver. The angle then gives further points of its links. Where wheels depend on an
    angle, its full turns are counted as the scene states. What no position determines is zero.
    """
    numbers = loops.numbers
    read = numbers.columns(list(places.values())) - loops.home[:, None]
    known = {name: read[:, n] for n, name in enumerate(places)}
    frame = {name: numbers.complexes(z) for name, z in loops.bodies[FRAME].items()}
    known = {**known, **frame}
    driven = {g.block: driven_coordinate(loops, j) for j, g in enumerate(loops.guides) if g.first}
    given = {block: numbers.reals(s) for block, s in driven.items() if s is not None}
    given |= {name: numbers.reals(s) for name, s in slides.items()}
    turn: dict[int, Complexes] = {0: numbers.complexes(1)}
    guessed: set[int] = set()
    while len(turn) < loops.turned.count:
        seen = len(turn), len(known)
        turn |= turns_of_bars(loops, known, turn)
        turn |= turns_of_drivers(loops, turn)
        turn |= turns_of_blocks(loops, known, given, turn, guessed)
        known = {**points_on_links(loops, known, turn), **known}
        if seen == (len(turn), len(known)):
            break
    turns = numbers.columns([turn.get(k, 1.0) for k in range(1, loops.turned.count)])
    coordinates = [slide_start(loops, j, known, given, turn) for j in range(len(loops.guides))]
    slid = numbers.columns([0.0 if s is None else s for s in coordinates], float)
    determined = [k in turn and k not in guessed for k in range(1, loops.turned.count)]
    determined += [s is not None for s in coordinates]
    unknowns = np.concatenate([np.angle(turns), slid], axis=1)
    return Start(*settled(loops, unknowns, np.array(determined, dtype=np.bool_)))


def driven_coordinate(loops: Equations, j: int) -> Reals | None:
    """The coordinate on guide j that a driver gives, or None."""
    column = loops.drives.selects[:, loops.turning_count + j]
    lifted = [lift.row for lift in loops.drives.lifts]
    found = [d for d in np.flatnonzero(column) if d not in lifted]
    return loops.drives.aim[:, found[0]].real if found else None


def turns_of_bars(
    loops: Equations, known: Places, turn: Mapping[int, Complexes]
) -> dict[int, Complexes]:
    """e^{iθ} of the turnings that have two known points on one link, from the longest such bar."""
    bars = {k: bar for k, bar in loops.longest_bars.items() if k not in turn}
    if not known.keys() >= {end for first, second, _ in bars.values() for end in (first, second)}:
        bars = {k: bar for k, bar in loops.bars_among(known).items() if k not in turn}
    return {k: (known[second] - known[first]) / way for k, (first, second, way) in bars.items()}


def turns_of_blocks(
    loops: Equations,
    known: Places,
    given: Mapping[str, Reals],
    turn: Mapping[int, Complexes],
    guessed: set[int],
) -> dict[int, Complexes]:
    """e^{iθ} of guides for which a point of the link and the block on the guide are known.

    Without a given slide coordinate, the block is taken to be on the positive side and the turning
    is added to ``guessed``.
    """
    found: dict[int, Complexes] = {}
    for guide in loops.guides:
        turning, body = loops.turned.of[guide.on], loops.bodies[guide.on]
        base = next((name for name in body if name in known), None)
        if turning in turn or turning in found or base is None or guide.point not in known:
            continue
        bar = known[guide.point] - known[base]
        foot = guide.through - body[base] + 1j * guide.offset * guide.along
        level = foot * np.conj(guide.along)
        if guide.first and guide.block in given:
            reach = given[guide.block]
        else:
            reach = np.sqrt(np.maximum(abs(bar) ** 2 - np.imag(level) ** 2, 0)) - np.real(level)
        arm = (foot + reach * guide.along) * loops.turned.lean[guide.on]
        if np.all(abs(arm) > 0):
            found[turning] = bar / arm
            if not (guide.first and guide.block in given):
                guessed.add(turning)
    return found


def turns_of_drivers(loops: Equations, turn: Mapping[int, Complexes]) -> dict[int, Complexes]:
    """e^{iθ} of a turning that a driver turns against a known one."""
    found: dict[int, Complexes] = {}
    lifted = [lift.row for lift in loops.drives.lifts]
    for d, row in enumerate(loops.drives.selects):
        raised = [int(k) + 1 for k in np.flatnonzero(row[: loops.turning_count] > 0)]
        lowered = [int(k) + 1 for k in np.flatnonzero(row[: loops.turning_count] < 0)]
        base = lowered[0] if lowered else 0
        if d in lifted or not loops.drives.turns[d] or not raised or raised[0] in turn:
            continue
        if base in turn or base in found:
            against = turn[base] if base in turn else found[base]
            found[raised[0]] = against * loops.drives.aim[:, d] / loops.drives.lean[:, d]
    return found


def points_on_links(
    loops: Equations, known: Places, turn: Mapping[int, Complexes]
) -> dict[str, Complexes]:
    """Every point of the links that have a known angle and a known point."""
    found: dict[str, Complexes] = {}
    for link, body in loops.bodies.items():
        base = next((name for name in body if name in known), None)
        turning = loops.turned.of[link]
        if base is None or turning not in turn or body.keys() <= known.keys():
            continue
        heading = turn[turning] / abs(turn[turning]) * loops.turned.lean[link]
        for name, arm in body.items():
            found[name] = known[base] + heading * (arm - body[base])
    return found


def slide_start(
    loops: Equations,
    j: int,
    known: Places,
    given: Mapping[str, Reals],
    turn: Mapping[int, Complexes],
) -> Reals | None:
    """The coordinate on guide j, from its zero, or None where nothing gives it."""
    guide = loops.guides[j]
    body = loops.bodies[guide.on]
    base = next((name for name in body if name in known), None)
    turning = loops.turned.of[guide.on]
    if guide.first and guide.block in given:
        return given[guide.block]
    if guide.point not in known or turning not in turn or (base is None and guide.on != FRAME):
        return driven_coordinate(loops, j)
    heading = turn[turning] / abs(turn[turning]) * loops.turned.lean[guide.on]
    origin = known[base] - heading * body[base] if base is not None else 0
    way = known[guide.point] - origin - heading * guide.through
    return np.asarray((way / (heading * guide.along)).real)


# --- Newton's method, velocity and acceleration ratios, and the motion ----------------------------


ITERATIONS = 60
SETTLED = 1e-12
"""Step, in the sizes of the unknowns, after which the next one would be rounding."""
NEAR = 1e-6
"""Step below which further steps that no longer shrink are rounding too."""
AT_REST = 1e-13
"""Closure error, in the sizes of the equations, of a mechanism closed to rounding.

A long step from there only shows that J is singular.
"""
LONGEST = 0.5
"""Longest single step, in radians or the sizes of slides."""
CLOSED = 1e-9
"""Closure error, in the sizes of the equations, at which a mechanism counts as closed."""
ROUNDED = 4
"""Roundings of an equation's terms within which its residual may lie."""

Flags = np.ndarray[Any, np.dtype[np.bool_]]


class Report(Struct, frozen=True, eq=False):
    """The course of Newton's method; arrays of shape (N,).

    ``residual`` is the closure error (m) before the first iteration and ``remains`` the error after
    the last. ``moved`` (m) is the largest change of an unknown. Angles are measured on the longest
    bar. ``closed`` marks the settings that closed. ``good`` marks those whose position no rounding
    can make singular.
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
        """The rates φ̇ from the drivers' speeds (N, D)."""
        return np.asarray(np.einsum("nud,nd->nu", self.velocity, speed))

    def accelerations(self, speed: Reals, acceleration: Reals) -> Reals:
        """The second derivatives φ̈ from the drivers' speeds and accelerations (N, D)."""
        steady = np.einsum("nude,nd,ne->nu", self.acceleration, speed, speed)
        return np.asarray(steady + np.einsum("nud,nd->nu", self.velocity, acceleration))


class LoopSolution(Struct, frozen=True, eq=False):
    """The solved loop equations: unknowns φ (N, unknowns), ratios, motion, bounds and report."""

    loops: Equations
    unknowns: Reals
    ratios: Ratios
    motion: Motion
    rounding: Rounding
    report: Report


def solve(
    loops: Equations, places: Mapping[str, object], slides: Mapping[str, object] | None = None
) -> LoopSolution:
    """Close the loops from given positions of points (m) and find the motion.

    ``slides`` may give slide coordinates (m) by block. Raises StructureError when there are too few
    drivers. Raises WitnessError when a single scene does not close or is singular; a batch holds
    NaN there.
    """
    refuse_undriven(loops)
    with np.errstate(all="ignore"):
        start = start_values(loops, places, slides or {})
    return closed_from(loops, start.unknowns)


def closed_from(
    loops: Equations, start: Reals, *, accelerations: bool = True, singular: bool = False
) -> LoopSolution:
    """Close the loops from unknowns (N, K + m) and find the motion; raises as ``solve`` does.

    Without ``accelerations`` the motion's accelerations are NaN, and the equations are
    differentiated only once. With ``singular``, positions in which no rate is certain are accepted;
    the bounds then show it.
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

    Only the unknowns in ``moving`` change; without it, all do. Least squares serves where there are
    more equations than unknowns. Returns the unknowns and the number of iterations, at ``most`` so
    many. A step shorter than ``settled`` is the last. Starts of one setting that have settled are
    not iterated further.
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
    """The Newton step (N, moving) of the moving unknowns, from the equations that contain them."""
    part = jacobian[:, :, moving]
    rows = np.flatnonzero((part != 0).any(axis=(0, 2)))
    return linear_solve(part[:, rows], residual[:, rows, None])[:, :, 0]


def scaled(loops: Equations, unknowns: Reals, linear: Linear | None = None) -> tuple[Reals, Reals]:
    """Residual (N, e) and Jacobian (N, e, u), each equation and unknown divided by its size.

    ``linear`` are the vectors at these unknowns, where the caller has them.
    """
    linear = loops.chains.at(unknowns) if linear is None else linear
    return loops.residual(linear, unknowns) / loops.rows, loops.scaled_jacobian(linear)


def largest(rows: Reals) -> Reals:
    return np.asarray(np.abs(rows).max(axis=1, initial=0.0))


def linear_solve(matrix: Reals, right: Reals) -> Reals:
    """Solve stacks of linear equations, by least squares if overdetermined or singular.

    Shapes (N, e, u) and (N, e, R) give (N, u, R). Settings with a NaN stay NaN. Equations with zero
    coefficients in all settings are left out.
    """
    finite = finite_rows(matrix) & finite_rows(right)
    determined = matrix[finite].any(axis=(0, 2))
    if np.count_nonzero(determined) == matrix.shape[2]:
        matrix, right = matrix[:, determined], right[:, determined]
    matrix = np.where(finite[:, None, None], matrix, np.eye(*matrix.shape[1:]))
    right = np.where(finite[:, None, None], right, np.nan)
    if matrix.shape[1] == matrix.shape[2]:
        try:
            return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
        except np.linalg.LinAlgError:
            pass
    return np.asarray(np.linalg.pinv(matrix) @ right)


def solve_each(matrix: Reals, right: Reals) -> Reals:
    """Solve as ``linear_solve`` does, so that each equation holds to the rounding of its own terms.

    Elimination mixes the equations, and a link at rest would turn by the rounding of the others.
    One correction by what remains ends that: R. D. Skeel, Mathematics of Computation 35 (1980).
    """
    found = linear_solve(matrix, right)
    return np.asarray(found + linear_solve(matrix, right - matrix @ found))


def finite_rows(stack: Reals) -> Flags:
    """Where every number in a matrix of a stack is finite."""
    if len(stack) == 1:
        return np.array([np.isfinite(stack).all()])
    return np.asarray(np.isfinite(stack).all(axis=(1, 2)))


def open_at_most(loops: Equations, unknowns: Reals) -> Reals:
    """The largest residual of each equation of a closed mechanism, in its own size: (N, e).

    Angles of many turns and paths of many lengths leave rounding in the equations of wheels and
    drivers. The rounding of angles leaves some in the closed chains.
    """
    linear = ROUNDED * (straight(loops, unknowns) + loops.whole_turns)
    links, count = len(loops.links), loops.turned.count
    turned = loops.magnitudes[:, links : links + len(loops.closing), 1:count]
    chains = UNIT * (turned @ abs(unknowns[:, : count - 1, None]))[:, :, 0]
    opened = np.concatenate([chains, chains, linear], axis=1) / loops.rows
    return np.maximum(CLOSED, opened)


def gap(loops: Equations, unknowns: Reals) -> Reals:
    """The largest closure error (m), with drivers' angles measured on the longest bar: (N,)."""
    return widest_gap(loops, loops.residual(loops.chains.at(unknowns), unknowns))


def widest_gap(loops: Equations, missed: Reals) -> Reals:
    """The largest closure error (m) from the residuals ``missed``: (N,)."""
    turns = np.zeros(missed.shape[1], dtype=np.bool_)
    turns[len(turns) - len(loops.drives.turns) :] = loops.drives.turns
    return largest(missed * np.where(turns, loops.size[:, None], 1))


def ratios_at(loops: Equations, unknowns: Reals, *, accelerations: bool = True) -> Ratios:
    """Velocity ratios τ_d and acceleration ratios ∂τ_d/∂q_e at a closed position.

    Without ``accelerations`` the acceleration ratios are NaN.
    """
    linear = loops.chains.at(unknowns)
    jacobian = loops.scaled_jacobian(linear)
    return ratios_about(loops, linear, jacobian, accelerations=accelerations)


def ratios_about(
    loops: Equations, linear: Linear, jacobian: Reals, *, accelerations: bool
) -> Ratios:
    """The ratios from the vectors at a position and the scaled Jacobian.

    Each equation and unknown is divided by its own size, so that metres do not swamp radians.
    """
    units, sizes = loops.columns[:, :, None], loops.rows[:, :, None]
    count, rows, columns = jacobian.shape
    drivers = len(loops.drives.turns)
    by_driver = np.zeros((count, rows, drivers))
    by_driver[:, rows - drivers :, :] = -np.eye(drivers)
    velocity = -solve_each(jacobian, by_driver / sizes) * units
    if not accelerations:
        return Ratios(velocity, np.full((count, columns, drivers, drivers), np.nan))
    curved = [
        loops.second(linear, velocity[:, :, d], velocity[:, :, e])
        for d in range(drivers)
        for e in range(drivers)
    ]
    if not curved:
        return Ratios(velocity, np.zeros((count, columns, 0, 0)))
    acceleration = -solve_each(jacobian, np.stack(curved, axis=-1) / sizes) * units
    return Ratios(velocity, acceleration.reshape(count, columns, drivers, drivers))


def refuse_undriven(loops: Equations) -> None:
    """Raise StructureError if there are fewer equations than unknowns."""
    missing = loops.unknown_count - loops.equation_count
    if missing > 0:
        raise StructureError.at(
            "drivers",
            message(
                "{unknown_count} unknowns but only {equation_count} loop and driver equations",
                unknown_count=loops.unknown_count,
                equation_count=loops.equation_count,
            ),
            message("1 more driver" if missing == 1 else "{missing} more drivers", missing=missing),
        )


def refuse_failure(loops: Equations, unknowns: Reals, report: Report) -> None:
    """Raise WitnessError if one scene has no motion, because it does not close or is singular."""
    if report.good[0]:
        return
    if not report.closed[0]:
        spare = loops.equation_count - loops.unknown_count
        hint = message(
            "equations beyond the unknowns ({spare}) must be met, too: what is "
            "over-constrained closes only with lengths that fit",
            spare=spare,
        )
        raise WitnessError.at(
            "loops",
            message(
                "the loops do not close: after {iterations} iterations {remains:.3g} m "
                "remain open, most at {place}",
                iterations=report.iterations,
                remains=report.remains[0],
                place=widest(loops, unknowns),
            ),
            message("lengths and driver positions for which the mechanism can be assembled"),
            hint if spare > 0 else NO_WORDS,
        )
    raise WitnessError.at(
        "loops",
        message("singular position, or so near to one that rounding hides the difference"),
        message("a position in which the drivers' speeds determine all others"),
        message(
            "which positions are singular depends on the driver: drive another link or move on"
        ),
    )


def widest(loops: Equations, unknowns: Reals) -> str:
    """The place that is farthest from closing: a joint, a contact of wheels, or a driver."""
    gaps = np.abs(scaled(loops, unknowns)[0][0])
    chains = len(loops.closing)
    joints = np.hypot(gaps[:chains], gaps[chains : 2 * chains])
    drivers = [
        message("driver {number}", number=number)
        for number in range(1, len(loops.drives.turns) + 1)
    ]
    every = np.concatenate([joints, gaps[2 * chains :]])
    words = [*loops.closing, *loops.slips.words, *drivers]
    return words[int(np.argmax(np.nan_to_num(every, nan=np.inf)))]
