"""A full turn of the driver, or its reachable ranges, as arrays.

Reactions and the balance at every position of a cycle, with the lever as their check.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct, field

from graphkin.construction.core.kind import PlacesLink, construction, constructions
from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import EPSILON, KINDS, OMEGA
from graphkin.construction.core.run import Trace, run_batch
from graphkin.construction.core.solution import Solution, gathered, row_of, rows_of
from graphkin.construction.forces.force_plan import force_program, undrawn
from graphkin.construction.forces.lever import LeverBalance
from graphkin.construction.forces.loads import is_asked
from graphkin.motion.course import Flags, Reals, spread
from graphkin.motion.driving import TURN
from graphkin.motion.events import Singular, singulars
from graphkin.motion.pieces import Path, Piece, reachable_ranges
from graphkin.motion.sweep import Sweep, name_of, sweep_of
from graphkin.numbers.arithmetic import batch_kind
from graphkin.numbers.plane import Ratio
from graphkin.scene.forces import Forces
from graphkin.scene.link_points import is_under
from graphkin.scene.model import FRAME, Branch, Scene
from graphkin.scene.quantity import LENGTHS
from graphkin.text.errors import (
    ClosureError,
    GraphkinError,
    Problem,
    SceneError,
    WitnessError,
    both,
    joined,
    message,
)

if TYPE_CHECKING:
    from graphkin.construction.core.cam_profiles import CamProfile
    from graphkin.mechanism import Mechanism

BESIDE = 1e-6
"""Distance from a singular position (degrees, mm or ms) within which a row has no values."""
SHARE = 1e-3
"""The largest such distance as a share of the window."""
LISTED = 6
"""The most ranges listed in a message."""
NUMBERED = 4
"""Rows of a cycle in which the residual check numbers closures."""
HELD = 1e-6
"""Distance beyond a piece, as a share of the range, at which a position still counts to it."""
FOLLOWED = 720
"""Parts of a range in which links are followed that the program does not count."""
FULL = 10_000_000
"""The most values of a cycle: rows times quantities in each."""
ROUNDED = 1e-7
"""Rounding error of positions, as a share of the mechanism; it is largest near dead points."""
ROUNDINGS = 16
"""Roundings of u by which a position may be off."""
COARSE = 1e-4
"""Bound, as a share of the mechanism, above which positions between two rows are examined."""
PARTS = 16
"""Parts into which a step is cut if a point disagrees with its velocities there."""
ROUNDS = 6
"""Times a step is cut; a motion that is only fast agrees with its velocities in parts so small."""

MOMENT = 1e-3
"""Grid steps near a change point in which nothing may be known."""


class Witnessed(Struct, frozen=True, eq=False):
    """The residual check of every row: its difference (N,), and whether it agrees.

    ``refused`` gives the reason if the check is not possible. ``unsure`` names the quantities that
    have no certain digit in some rows, with those rows (N,).
    """

    difference: Reals
    agrees: Flags
    refused: str = ""
    unsure: Mapping[str, Flags] = field(default_factory=dict)

    @property
    def largest(self) -> float:
        """The largest difference among the rows with a check; NaN without any."""
        known = self.difference[np.isfinite(self.difference)]
        return float(known.max()) if known.size else float("nan")


class Cycle(Struct, frozen=True, eq=False, dict=True):
    """The motion of a mechanism over a turn of its driver or its reachable ranges.

    ``at`` (N,) is u of every row: the driver's position (degrees, metres) or the time (s).
    ``piece`` (N,) numbers the pieces of constant signs from 1. ``solution`` holds the motion of
    points, links and slides as arrays (N,) in SI. ``margins`` holds the sine of each crossing, by
    the point or link that it gives. ``left_out`` are the requested positions without a row.
    ``targets`` are the targets run for each row, None for all.
    """

    mechanism: Mechanism
    sweep: Sweep
    path: Path
    at: Reals
    piece: np.ndarray[Any, np.dtype[np.int_]]
    solution: Solution
    margins: Mapping[str, Reals]
    left_out: Reals
    targets: tuple[Target, ...] | None = None

    @property
    def scene(self) -> Scene:
        """The scene as read."""
        return self.mechanism.scene

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """All pieces, range by range, in the order of the rows' numbers."""
        return self.path.pieces

    @property
    def ranges(self) -> tuple[tuple[float, float], ...]:
        """The reachable ranges of u, the scene's first."""
        return self.path.spans

    @cached_property
    def singulars(self) -> tuple[Singular, ...]:
        """Dead points and change points, with words."""
        return singulars(self.path)

    @cached_property
    def witnessed(self) -> Witnessed:
        """The residual check of every row against the vector loops."""
        return witnessed(self)

    @cached_property
    def sure(self) -> Solution:
        """The motion of every row, with NaN for each quantity that has no certain digit there."""
        from graphkin.loops.differences import sure_of

        return sure_of(self.solution, witnessed(self, numbered=False).unsure)

    @cached_property
    def profiles(self) -> Mapping[str, CamProfile]:
        """The cams by their followers, at every position, whichever driver moves them."""
        found: dict[str, CamProfile] = {}
        if self.scene.cams:
            from graphkin.construction.core.cam_profiles import CamProfile

            for follower, cam in self.scene.cams.items():
                given = self.slid(cam.on) if cam.slides else self.turned(cam.on)
                if cam.carrier != FRAME:
                    given = given - (0 if cam.slides else self.turned(cam.carrier))
                found[follower] = CamProfile(self.scene, follower, given=given)
        return found

    @cached_property
    def forces(self) -> ForcesAlong | None:
        """The reactions and the balance that the scene asks, at every position."""
        if self.scene.forces is None or not self.scene.forces.asked:
            return None
        return forces_along(self.pieces, self.piece, self.at, self.scene.forces)

    def slid(self, block: str) -> Reals:
        """The coordinate (m) of a block on its first guide at every position: (N,)."""
        target = "slide", block
        return np.asarray(columns_at(self.sweep, self.path, self.at, [target]).columns[target])

    def turned(self, link: str) -> Reals:
        """The angle (radians) of a link's x axis at every position: (N,)."""
        if link == FRAME:
            return np.zeros(len(self.at))
        driver = self.scene.drivers[(self.sweep.number or 1) - 1]
        swept = self.sweep.what == "turn" and driver.link == link
        if swept and driver.against == FRAME and driver.of is None:
            return np.radians(self.at)
        target = "axis", link
        axes = columns_at(self.sweep, self.path, self.at, [target]).columns[target]
        return np.asarray(np.angle(axes))

    def piece_at(self, place: float) -> tuple[Piece, float]:
        """The piece of the scene's range that holds a u, and that u within the piece."""
        slack = HELD * (self.ranges[0][1] - self.ranges[0][0])
        for piece in self.path.ranges[0]:
            for shift in self.path.shifts(place):
                u = place + shift
                if piece.low.at - slack <= u <= piece.high.at + slack:
                    return piece, min(max(u, piece.low.at), piece.high.at)
        raise ValueError(place)

    def mechanism_at(self, place: float) -> Mechanism:
        """The mechanism at a u of the scene's range."""
        piece, within = self.piece_at(place)
        return piece.course.mechanism(within)

    def along(self, at: Sequence[float] | Reals) -> Cycle:
        """The cycle at other values of u, without those that have no motion."""
        rows = np.asarray(at, float)
        return cycle_at(self.mechanism, self.sweep, self.path, rows, self.targets)


def cycle(
    mechanism: Mechanism,
    *,
    driver: int | None = None,
    steps: int = 360,
    low: float | None = None,
    high: float | None = None,
    branches: Mapping[str, Branch] | None = None,
    targets: Iterable[Target] | None = None,
) -> Cycle:
    """A full turn of a driver, or its reachable ranges, or a span of time, as arrays.

    A single driver moves through its positions at its stated speed and acceleration. Of several
    drivers, number ``driver`` moves while the others are at rest. Without ``driver``, several
    drivers, or one with a law of time, move with the time.

    ``steps`` divides a turn, a range or the span. ``low`` and ``high`` (degrees, metres, seconds)
    bound it. ``branches`` selects other closures to start with. ``targets`` restricts the work to
    what they need. Raises SceneError for a driver that does not exist, ClosureError where nothing
    closes, and WitnessError where something jumps from one row to the next.
    """
    sweep = sweep_of(mechanism.scene, driver=driver, low=low, high=high)
    refuse_steps(mechanism, sweep, steps)
    path = reachable_ranges(sweep, branches)
    refuse_steps(mechanism, sweep, steps, path.turns)
    wanted = None if targets is None else tuple(targets)
    found = cycle_at(mechanism, sweep, path, places(sweep, path, steps), targets=wanted)
    if not len(found.at):
        raise ClosureError(no_rows(sweep, path, steps))
    refuse_jumps(found)
    return found


def refuse_steps(mechanism: Mechanism, sweep: Sweep, steps: int, turns: int = 1) -> None:
    """Raise SceneError for steps that are too many, or too small for doubles.

    ``turns`` are the turns of the driver's circle.
    """
    most = FULL // max(len(mechanism.program.answers), 1) // max(turns, 1)
    if not 1 <= steps <= most:
        found = message(
            "{steps} steps of {count} quantities", steps=steps, count=len(mechanism.program.answers)
        )
        raise SceneError.at(
            "--steps", found, message("1 to {most} steps for this mechanism", most=most)
        )
    least = 4 * float(np.spacing(max(abs(sweep.low), abs(sweep.high))))
    if (step := (sweep.high - sweep.low) / steps) < least:
        found = message(
            "{low:.17g} to {high:.17g} in {steps} steps of {step:.1e} {unit}",
            low=sweep.low,
            high=sweep.high,
            steps=steps,
            step=step,
            unit=sweep.unit,
        )
        hint = message("show more, or in fewer steps")
        raise SceneError.at(
            "--from, --to", found, message("steps of at least {least:.1e}", least=least), hint
        )


def no_rows(sweep: Sweep, path: Path, steps: int) -> Problem:
    """The problem of steps that all miss the ranges, or of a driver without room to move.

    A driver has no room where a dead point lies on both sides.
    """
    known = path.spans
    some = both(
        message("from {low:.10g} to {high:.10g}", low=low, high=high)
        for low, high in known[:LISTED]
    )
    ends = joined(" ", (some, sweep.unit))
    if len(known) > LISTED:
        more = len(known) - LISTED
        ends = message("{ends} and in {count} more ranges", ends=ends, count=more)
    if max(high - low for low, high in known) > (sweep.high - sweep.low) / (1000 * steps):
        found = message(
            "it closes {ends}, where none of {steps} steps falls", ends=ends, steps=steps
        )
        return Problem(
            "--steps",
            found,
            message("smaller steps"),
            message("ask for more, or for a smaller window"),
        )
    return Problem(
        message("the cycle"),
        message("it closes {ends} only, where nothing moves", ends=ends),
        message("positions that are not singular"),
        message("change the lengths: at this dead point everything is in line"),
    )


def places(sweep: Sweep, path: Path, steps: int) -> Reals:
    """The values of u of the rows, in equal steps.

    There are ``steps`` in each turn of the driver's circle, from zero, in a stated window of angles
    or seconds, or in a range between its ends. A full turn that does not recur has a row at its
    end, too.
    """
    if sweep.whole:
        if path.whole and not path.returns:
            return path.ranges[0][0].low.at + np.arange(steps + 1) * (TURN / steps)
        turns = max(path.turns, 1)
        even = np.arange(steps * turns) * (TURN / steps)
        if path.whole:
            return even
        ends = np.floor(np.array(path.spans) / TURN)
        every = np.arange(ends.min() * steps, (ends.max() + 1) * steps) * (TURN / steps)
        parts = [every[(low <= every) & (every <= high)] for low, high in path.spans]
        missing = even[~closing(even, np.concatenate(parts), turns * TURN)]
        return np.concatenate([*parts, missing])
    if sweep.stated and sweep.what in ("turn", "time"):
        return np.linspace(sweep.low, sweep.high, steps + 1)
    return np.concatenate([np.linspace(low, high, steps + 1) for low, high in path.spans])


def closing(even: Reals, found: Reals, circle: float) -> Flags:
    """Which positions of the driver's circle are among those found, whole circles aside."""
    have = np.round(found % circle, 9) % circle
    return np.isin(np.round(even, 9), have)


def cycle_at(
    mechanism: Mechanism,
    sweep: Sweep,
    path: Path,
    at: Reals,
    targets: tuple[Target, ...] | None = None,
) -> Cycle:
    """The rows of a cycle: each position is run with the closures of its piece, in batches."""
    found = columns_at(sweep, path, at, targets)
    moves = found.piece > 0
    for value in found.columns.values():
        moves &= np.ones(len(at), bool) if isinstance(value, Ratio) else np.isfinite(value)
    program = path.ranges[0][0].course.program
    values = {program.targets[t]: row_of(v, moves) for t, v in found.columns.items()}
    motion = gathered(Trace(program, values, {}), mechanism.scene.links)
    margins = {name: row[moves] for name, row in found.margins.items()}
    smallest = np.min([np.ones(moves.sum()), *margins.values()], axis=0)
    solution = Solution(motion.points, motion.links, motion.slides, smallest)
    left_out = np.sort(at[~moves])
    rows = at[moves], found.piece[moves]
    return Cycle(mechanism, sweep, path, *rows, solution, margins, left_out, targets)


class Columns(Struct, frozen=True, eq=False):
    """Values by target and margins by pin for each u (N,), NaN where there is no piece."""

    piece: np.ndarray[Any, np.dtype[np.int_]]
    columns: Mapping[Target, Any]
    margins: Mapping[str, Reals]


def columns_at(
    sweep: Sweep,
    path: Path,
    at: Reals,
    targets: Sequence[Target] | None = None,
    *,
    geometric: bool = False,
    near: float | None = None,
) -> Columns:
    """Run every u with the closures of its piece, except within ``near`` of singular ends.

    With ``near`` zero, the dead points themselves have positions.
    """
    usual = BESIDE if sweep.what in ("turn", "time") else BESIDE / 1000
    usual = min(usual, SHARE * (sweep.high - sweep.low))
    which, within = assigned(path, at, usual if near is None else near)
    columns: dict[Target, Any] = {}
    margins: dict[str, Reals] = {}
    for number, piece in enumerate(path.pieces, 1):
        rows = np.flatnonzero(which == number)
        if not rows.size:
            continue
        trace = piece.course.run(within[rows], targets, geometric=geometric)
        for target in targets or piece.course.program.answers:
            value = spread(trace.value(*target), len(rows))
            if value is not None:
                columns[target] = placed(columns.get(target), value, rows, len(at))
        for n, margin in trace.margins.items():
            step = piece.course.program.steps[n]
            kind = construction(step)
            name = step.name or (kind.found_link if isinstance(kind, PlacesLink) else "")
            if n in piece.course.crossings and name:
                margins.setdefault(name, np.full(len(at), np.nan))[rows] = margin
    for target in targets or ():
        columns.setdefault(target, np.full(len(at), np.nan))
    return Columns(which, columns, margins)


def assigned(path: Path, at: Reals, near: float) -> tuple[Any, Reals]:
    """The piece of each u, from 1 (0 where there is none), and the equivalent u within that piece.

    A u outside all pieces belongs to a piece some whole circles of the driver away.
    """
    which = np.zeros(len(at), dtype=int)
    within = at.copy()
    for turn, (number, piece) in product(path.shifts(at), enumerate(path.pieces, 1)):
        place = at + turn
        inside = (which == 0) & piece.holds(place)
        for end in (piece.low, piece.high):
            if end.kind in ("dead", "change"):
                inside &= np.abs(place - end.at) >= near
            elif end.kind == "number":
                inside &= np.abs(place - end.at) >= BESIDE / 10
        which[inside], within[inside] = number, place[inside]
    return which, within


def placed(whole: Any, value: Any, rows: Any, count: int) -> Any:
    """Insert values at their rows into an array of full length, created if needed."""
    if isinstance(value, Ratio):
        parts = whole or (None, None, None)
        return Ratio(*(placed(w, v, rows, count) for w, v in zip(parts, value, strict=True)))
    if whole is None:
        whole = np.full(count, np.nan, dtype=value.dtype)
    elif whole.dtype != value.dtype:
        whole = whole.astype(np.result_type(whole, value))
    whole[rows] = value
    return whole


def witnessed(found: Cycle, *, numbered: bool = True) -> Witnessed:
    """The residual check of each piece against the vector loops, with the piece's own closures.

    Without ``numbered``, closure numbers are not checked; they take most of the time. They are
    checked in ``NUMBERED`` rows, and in at least one row of each piece, on which the closure is
    followed.
    """
    from graphkin.loops.witness import examine

    count = len(found.at)
    difference, agrees = np.full(count, np.nan), np.zeros(count, dtype=bool)
    unsure: dict[str, Flags] = {}
    turns = turns_left_open(found)
    for number, piece in enumerate(found.pieces, 1):
        rows = found.piece == number
        if not rows.any():
            continue
        course = piece.course
        try:
            examined = examine(
                course.scene,
                rows_of(found.solution, rows),
                course.values(found.at[rows]) | {n: turn[rows] for n, turn in turns.items()},
                numbered=max(NUMBERED // len(found.pieces), 1) if numbered else 0,
            )
        except GraphkinError as error:
            return Witnessed(difference, agrees, str(error))
        difference[rows], agrees[rows] = examined.worst, examined.agrees
        for name, lost in examined.unsure.items():
            unsure.setdefault(name, np.zeros(count, dtype=bool))[rows] = lost
    return Witnessed(difference, agrees, unsure=unsure)


def turns_left_open(found: Cycle) -> dict[str, Reals]:
    """The turned angles (degrees) (N,) of links that count for the scene, not for the program.

    The program may count another link in their place. Their axes are followed from the scene's
    position, or from the beginning of a range that the motion does not reach from there.
    """
    sweep, targets = found.sweep, found.path.ranges[0][0].course.program.targets
    near = sweep.scene.values
    links = [m for m in found.scene.links if name_of(m) in near and ("turned", m) not in targets]
    wanted = [("axis", link) for link in links if ("axis", link) in targets]
    turns: dict[str, Reals] = {name_of(link): np.zeros(len(found.at)) for _, link in wanted}
    for low, high in found.ranges if wanted else ():
        rows = np.flatnonzero((low <= found.at) & (found.at <= high))
        start = sweep.start if low <= sweep.start <= high else low
        at = np.unique([*np.linspace(low, high, FOLLOWED + 1), *found.at[rows], start])
        columns = columns_at(sweep, found.path, at, wanted).columns
        known = np.all([np.isfinite(columns[target]) for target in wanted], axis=0)
        at = at[known]
        for target in wanted if at.size else ():
            angle = np.degrees(np.unwrap(np.angle(columns[target][known])))
            first = angle[np.abs(at - start).argmin()]
            angle += TURN * np.round((float(near[name_of(target[1])]) - first) / TURN)
            turns[name_of(target[1])][rows] = np.interp(found.at[rows], at, angle)
    return turns


class ForcesAlong(Struct, frozen=True, eq=False):
    """The asked forces (N) and moments (N·m) at every position (N,), by their targets.

    ``difference`` is that of the balance by Zhukovsky's lever from the one by the polygons, as a
    share of the larger one; None without a lever.
    """

    values: Mapping[Target, Any]
    difference: Any = None


def forces_along(
    pieces: Sequence[Piece], numbers: Reals, at: Reals, given: Forces
) -> ForcesAlong | None:
    """The forces that a scene asks at places ``at`` (N,), each in the piece of its number from 1.

    None where the forces of a group are not drawn.
    """
    values: dict[Target, Any] = {}
    difference: Any = None
    for number, piece in enumerate(pieces, 1):
        rows, course = np.flatnonzero(numbers == number), piece.course
        if undrawn(course.scene, course.groups) is not None:
            return None
        program = force_program(course.scene, course.program, course.groups)
        asked = [target for target in program.targets if is_asked(course.scene, given, target)]
        levers = [*constructions(program, LeverBalance)]
        keep = [program.targets[target] for target in asked]
        keep += [n for each in levers for n in (of_lever(each), each.other)]
        steps = program.behind(keep)
        with np.errstate(all="ignore"):
            trace = run_batch(program, steps, course.values(at[rows]), batch_kind(), keep)
        for target in asked:
            found = np.broadcast_to(trace.values[program.targets[target]], len(rows))
            values.setdefault(target, np.full(len(at), np.nan, found.dtype))[rows] = found
        for each in levers:
            one, other = (trace.values[n] for n in (of_lever(each), each.other))
            largest = np.maximum(abs(one), abs(other))
            off = abs(one - other) / np.where(largest > 0, largest, 1.0)
            difference = np.full(len(at), np.nan) if difference is None else difference
            difference[rows] = off
    return ForcesAlong(values, difference)


def of_lever(balance: LeverBalance) -> int:
    """The step of a balance by the lever: the moment of a crank, or the force on a block."""
    number = balance.force if balance.moment is None else balance.moment
    assert number is not None
    return number


# --- jumps: rows between which a point moves otherwise than its velocities say -------------------


class Jump(Struct, frozen=True):
    """Two neighbouring rows between which a point or a wheel disagrees with its rates.

    ``low`` and ``high`` are u. ``of`` is the point, or the link of the wheel where it ``turns``.
    ``way`` is the distance it moves, ``led`` the distance given by the mean of its rates (m,
    degrees).
    """

    low: float
    high: float
    of: str
    turns: bool
    way: float
    led: float


class PlacesAndRates(Struct, frozen=True, eq=False):
    """Positions with their first and second derivatives by u in SI: (K, N) at ``at`` (N,).

    A wheel is represented by a point of the unit circle. ``size`` (K, 1) is the scale of each.
    """

    at: Reals
    place: Any
    rate: Any
    bend: Any
    size: Any

    def rows(self, kept: Any) -> PlacesAndRates:
        """Some of the rows."""
        place, rate, bend = (each[:, kept] for each in (self.place, self.rate, self.bend))
        return PlacesAndRates(self.at[kept], place, rate, bend, self.size)


class CycleTracker:
    """The points and wheels that a cycle moves, and their motion.

    ``names`` are points and, as axes, links of wheels that have only one point. Points where links
    touch and centres of curvature are left out, because they are other points a moment later.
    """

    def __init__(self, cycle: Cycle) -> None:
        self.cycle = cycle
        targets, scene = cycle.path.ranges[0][0].course.program.targets, cycle.scene
        self.names: list[tuple[str, str]] = []
        self.targets: list[Sequence[Target]] = []
        kinds: Mapping[str, Sequence[str]] = {"position": KINDS, "turned": ("axis", OMEGA, EPSILON)}
        for what, of in targets:
            wanted = [(kind, of) for kind in kinds.get(what, ())]
            if what == "position":
                free = not is_under(of) and of not in scene.cam_centres
            else:
                free = of in scene.links and len(scene.links[of].points) < 2
            if wanted and free and targets.keys() >= set(wanted):
                self.names.append((wanted[0][0], of))
                self.targets.append(wanted)
        self.size = np.ones((len(self.names), 1))

    def between(self, at: Reals) -> PlacesAndRates:
        """The motion at some values of u, without those that have no motion."""
        cycle, wanted = self.cycle, [target for each in self.targets for target in each]
        columns = columns_at(cycle.sweep, cycle.path, at, wanted, geometric=True).columns
        found = [[columns[target] for target in each] for each in self.targets]
        place, rate, bend = (np.array(each, complex) for each in zip(*found, strict=True))
        turns = np.array([what == "axis" for what, _ in self.names])
        bend[turns] = (1j * bend - rate**2)[turns] * place[turns]
        rate[turns] = 1j * rate[turns] * place[turns]
        known = np.isfinite(place + rate + bend).all(axis=0)
        return PlacesAndRates(at, place, rate, bend, self.size).rows(known)

    def at_rows(self, rows: Any) -> PlacesAndRates:
        """The motion at some rows of the cycle, from its own solution where that is complete."""
        cycle, at = self.cycle, self.cycle.at[rows]
        driver, values = cycle.sweep.driver, cycle.scene.values
        speed = 1.0 if driver is None else float(driver.speed.si(values))
        push = 0.0 if driver is None else float(driver.acceleration.si(values))
        points = [cycle.solution.points.get(of) for _, of in self.names]
        kept: list[list[Any]] = [[getattr(each, kind, None) for kind in KINDS] for each in points]
        if not speed or any(value is None for each in kept for value in each):
            return self.between(at)
        whole = cycle.at.shape
        every = np.array([[np.broadcast_to(v, whole)[rows] for v in each] for each in kept])
        place, velocity, acceleration = np.moveaxis(every, 1, 0)
        rate = velocity / speed
        return PlacesAndRates(at, place, rate, (acceleration - rate * push) / speed**2, self.size)

    def sized(self, found: PlacesAndRates) -> None:
        """Set the size of the mechanism, from its positions in all rows."""
        points = np.array([what == "position" for what, _ in self.names])
        places = found.place[points]
        self.size[points] = np.abs(places - places.mean()).max(initial=0.0) or 1.0


def refuse_jumps(cycle: Cycle) -> None:
    """Raise WitnessError for a cycle that is no motion, with its first jump."""
    found = jumps(cycle)
    if not found:
        return
    first, unit = found[0], "deg" if found[0].turns else cycle.scene.units["length"]
    size = 1.0 if first.turns else float(LENGTHS[unit])
    raise WitnessError.at(
        message("the cycle"),
        message(
            "{what} jumps between {low:.6g} and {high:.6g} {unit}",
            what=message("link {on}", on=first.of) if first.turns else first.of,
            low=first.low,
            high=first.high,
            unit=cycle.sweep.unit,
        ),
        message("a motion"),
        message(
            "it moves {way:.4g} {unit} there, and its velocity gives {led:.4g} {unit}",
            way=first.way / size,
            led=first.led / size,
            unit=unit,
        ),
    )


def jumps(cycle: Cycle) -> tuple[Jump, ...]:
    """The pairs of neighbouring rows between which something jumps, in the order of the rows."""
    followed = CycleTracker(cycle)
    if not followed.names or len(cycle.at) < 2:
        return ()
    followed.sized(followed.at_rows(np.arange(len(cycle.at))))
    found: list[Jump] = []
    first, unit = 1, cycle.sweep.per_unit
    for number, pieces in enumerate(cycle.path.ranges):
        inside = np.flatnonzero((first <= cycle.piece) & (cycle.piece < first + len(pieces)))
        first += len(pieces)
        rows = followed.at_rows(inside[np.argsort(cycle.at[inside], kind="stable")])
        if number == 0 and cycle.path.whole and cycle.path.returns:
            rows = closed_by(rows, cycle.path.period)
        missed, bound = missing(rows, unit)
        doubtful = (missed > bound) | (bound > COARSE * rows.size)
        for k in np.flatnonzero(doubtful.any(axis=0)):
            pair = rows.rows(np.array([k, k + 1]))
            if leaps(followed, pair):
                found.append(jump_at(pair, followed.names, unit))
    return tuple(found)


def closed_by(rows: PlacesAndRates, period: float) -> PlacesAndRates:
    """The rows of a full circle, with the first row repeated one circle later."""
    found = rows.rows(np.append(np.arange(len(rows.at)), 0))
    at = np.append(rows.at, rows.at[0] + period)
    return PlacesAndRates(at, found.place, found.rate, found.bend, rows.size)


def leaps(followed: CycleTracker, pair: PlacesAndRates, rounds: int = ROUNDS) -> bool:
    """Whether something jumps between two rows, however finely the interval is cut.

    An interval without known motion is accepted, if it is longer than the moment of a change point.
    """
    sweep = followed.cycle.sweep
    inner = followed.between(np.linspace(pair.at[0], pair.at[1], PARTS + 1)[1:-1])
    if not len(inner.at):
        return bool(np.ptp(pair.at) < MOMENT * abs(sweep.grid_step))
    here = stacked(pair.rows([0]), inner, pair.rows([1]))
    over = np.flatnonzero(np.greater(*missing(here, sweep.per_unit)).any(axis=0))
    if not over.size or rounds == 1:
        return bool(over.size)
    return any(leaps(followed, here.rows([k, k + 1]), rounds - 1) for k in over)


def stacked(*parts: PlacesAndRates) -> PlacesAndRates:
    """The rows of several parts, one after another."""
    at = np.concatenate([each.at for each in parts])
    place, rate, bend = (
        np.concatenate(each, axis=1)
        for each in zip(*((p.place, p.rate, p.bend) for p in parts), strict=True)
    )
    return PlacesAndRates(at, place, rate, bend, parts[0].size)


def missing(rows: PlacesAndRates, unit: float) -> tuple[Any, Any]:
    """The deviation of each step from the mean of its rates, and its bound: (K, N - 1).

    ``unit`` is one unit of u in SI. The trapezoidal rule errs by at most an eighth of the squared
    step times the change of the second derivative: a twelfth for an even change, an eighth for a
    sudden one. The change is the largest of three consecutive steps, because it may reverse within
    one. Some roundings of u itself count where points are fast and steps tiny.
    """
    step = np.diff(rows.at) * unit
    led = (rows.rate[:, 1:] + rows.rate[:, :-1]) / 2 * step
    change = np.pad(np.abs(np.diff(rows.bend, axis=1)), ((0, 0), (1, 1)))
    change = np.maximum(np.maximum(change[:, :-2], change[:, 1:-1]), change[:, 2:])
    rounded = ROUNDINGS * np.spacing(np.maximum(abs(rows.at[1:]), abs(rows.at[:-1]))) * unit
    fastest = np.maximum(abs(rows.rate[:, 1:]), abs(rows.rate[:, :-1]))
    bound = step**2 / 8 * change + ROUNDED * rows.size + rounded * fastest
    return np.abs(np.diff(rows.place, axis=1) - led), bound


def jump_at(pair: PlacesAndRates, names: Sequence[tuple[str, str]], unit: float) -> Jump:
    """The largest jump between two rows, relative to size."""
    missed, _ = missing(pair, unit)
    worst = int((missed / pair.size)[:, 0].argmax())
    what, of = names[worst]
    way = abs(pair.place[worst, 1] - pair.place[worst, 0])
    led = abs(pair.rate[worst].sum()) / 2 * (pair.at[1] - pair.at[0]) * unit
    if what == "axis":
        way, led = np.degrees(2 * np.arcsin(min(way / 2, 1.0))), np.degrees(led)
    return Jump(float(pair.at[0]), float(pair.at[1]), of, what == "axis", float(way), float(led))
