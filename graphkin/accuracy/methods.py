"""The methods compared: floats, batches, decimals and balls on the same steps, and two others."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib.util import find_spec
from math import log10
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.accuracy.comparison import Found, Reference, radii_of, rows_of
from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.quantities import BY_TARGET, KINDS, MOTION
from graphkin.construction.core.run import StepFailed, run, run_blocks
from graphkin.construction.core.solution import gathered
from graphkin.construction.core.timing import Clock, Stopwatch, Timing, Work
from graphkin.construction.tape.emitted import BatchRunner, Way
from graphkin.loops.closing_groups import counted_in_order
from graphkin.loops.equations import equations
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton import newton, ratios_at
from graphkin.loops.rigid_bodies import Reals
from graphkin.loops.witness import started
from graphkin.motion.sweep import names
from graphkin.numbers.arithmetic import FLOAT, Kind
from graphkin.numbers.kinds import array_kind, ball_kind, decimal_kind
from graphkin.scene.model import Scene
from graphkin.text.errors import GraphkinError

DIGITS = (15, 30, 60, 120)
BITS = (53, 106, 212, 400)
FEW = 1_000
"""The most variants of a batch with a group of higher class, because each is a search."""


class Effort(Struct, frozen=True):
    """The extent of a study: positions compared, rounds of a time, variants of a batch.

    ``timed`` is the number of positions at which decimals and balls are timed. ``drawn`` is the
    number of positions towards a dead point at which a drawing is predicted.

    ``least`` is the least time of a round and ``patience`` the most time for all rounds of one
    method, in seconds. ``groups`` and ``each`` divide the way to a dead point.
    """

    places: int = 32
    rounds: int = 25
    variants: int = 20_000
    least: float = 2e-3
    patience: float = 4.0
    groups: int = 24
    each: int = 8
    timed: int = 8
    drawn: int = 12
    compiled: bool = True

    def watch(self, clock: Clock, say: Callable[[str], None]) -> Stopwatch:
        return Stopwatch(self.rounds, self.least, self.patience, clock=clock, say=say)


QUICK = Effort(
    places=6,
    rounds=3,
    variants=64,
    least=0,
    patience=0.2,
    groups=14,
    each=4,
    timed=1,
    drawn=4,
    compiled=False,
)
"""A few positions with hardly any timing: to try the command, and for its tests."""


class MethodRow(Struct, frozen=True):
    """A method: its largest errors as shares of the largest of each quantity, and its time.

    An error is None for a quantity that the method does not give, infinite if the method fails at
    some position. ``variants`` is the number of positions of one run. ``certified`` marks errors
    that the method itself proves, so that they are radii. ``time`` is that of one position, in
    seconds, None if the method is not timed.
    """

    family: str
    method: str
    errors: tuple[float | None, float | None, float | None]
    time: Timing | None
    variants: int = 1
    certified: bool = False
    note: str = ""


class Method(Struct, frozen=True):
    """A row without its time, and the work on ``positions`` positions that is to be timed."""

    row: MethodRow
    work: Work | None = None
    positions: int = 1


def own_methods(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Every kind of number with the same program, one position after the other or in batches."""
    yield one_by_one(reference, effort, FLOAT, "float64", "float64, one by one")
    yield from batches(reference, effort)
    for digits in DIGITS:
        name = f"mpmath, {digits} digits"
        yield one_by_one(reference, effort, decimal_kind(digits), "mpmath", name)
    for bits in BITS:
        kind, name = ball_kind(bits), f"Arb, {bits} bits"
        yield one_by_one(reference, effort, kind, "Arb", name, certified=True)


def one_by_one(
    reference: Reference,
    effort: Effort,
    kind: Kind,
    family: str,
    name: str,
    *,
    certified: bool = False,
) -> Method:
    """A method that computes one position after the other."""
    found = found_singly(reference, kind)
    missed = radii_in(found, reference) if certified else reference.missed(found)
    some = afforded(reference, kind, effort)

    def work() -> None:
        for number in some:
            singly(reference, kind, number)

    row = MethodRow(family, name, reference.relative(missed), None, 1, certified)
    return Method(row, work, len(some))


def afforded(reference: Reference, kind: Kind, effort: Effort) -> Sequence[int]:
    """The positions that are timed: all, or evenly spread ones if each takes long.

    For decimals and balls the effort sets their number, and a quarter of it if each is a search.
    """
    count = len(reference.places.at)
    if reference.places.course.is_searched:
        count = count if kind is FLOAT else min(count, max(1, effort.timed // 4))
    elif kind is not FLOAT:
        count = min(count, effort.timed)
    return [n * len(reference.places.at) // count for n in range(count)]


def singly(reference: Reference, kind: Kind, number: int) -> Found | None:
    """The answers at one position in a kind of number; None if a step cannot be drawn."""
    program, answers = reference.places.course.program, reference.answers
    try:
        with kind.working():
            values = reference.exact_values[number]
            trace = run(program, reference.needed, values, kind)
    except (StepFailed, GraphkinError):
        return None
    return {target: trace.values[program.targets[target]] for target in answers.every}


def found_singly(reference: Reference, kind: Kind) -> list[Found]:
    """The answers at every position in a kind of number; empty where a step cannot be drawn."""
    return [singly(reference, kind, n) or {} for n in range(len(reference.places.at))]


def radii_in(found: Sequence[Found], reference: Reference) -> Any:
    """The radii that balls claim at every position, (P, 3); infinite where there is none."""
    nowhere = [np.inf] * 3
    return np.array([radii_of(each, reference.answers) if each else nowhere for each in found])


def batches(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Arrays of three precisions; doubles by steps, by emitted numpy code, and compiled."""
    ways: dict[Way, str] = {"steps": "by steps", "numpy": "emitted numpy", "numba": "compiled"}
    for way, words in ways.items():
        if way == "numba" and (not effort.compiled or find_spec("numba") is None):
            continue
        if way == "steps" or can_be_emitted(reference):
            yield batch(reference, effort, "float64", way, f"float64 batch, {words}")
    for kind in ("float32", "longdouble"):
        yield batch(reference, effort, kind, "steps", f"{kind} batch, by steps")


def variants_of(reference: Reference, effort: Effort) -> int:
    """The number of variants of a batch: fewer if each is a search."""
    most = FEW if reference.places.course.is_searched else effort.variants
    wanted = min(effort.variants, most)
    return max(wanted, len(reference.places.at))


def batch(reference: Reference, effort: Effort, kind: str, way: Way, name: str) -> Method:
    """A method that computes many positions at once; the reference's positions are repeated."""
    count, positions = variants_of(reference, effort), len(reference.places.at)
    values = reference.places.repeated(count)
    work = batch_work(reference.places.course.program, reference.answers.every, values, kind, way)
    columns = {t: head_of(v, positions) for t, v in work().items()}
    missed = reference.missed(rows_of(columns, positions))
    row = MethodRow(kind, name, reference.relative(missed), None, count)
    return Method(row, work, count)


def head_of(value: Any, count: int) -> Any:
    """The first values of an array; a value that all share is unchanged."""
    return value[:count] if getattr(value, "shape", ()) else value


def batch_work(
    program: Program, targets: Sequence[Target], values: dict[str, Any], kind: str, way: Way
) -> Callable[[], dict[Target, Any]]:
    """The work that runs targets on arrays of values in a kind of number and a way."""
    needed = program.needed(targets)
    keep = [program.targets[target] for target in targets]
    press = BatchRunner(program)

    def work() -> dict[Target, Any]:
        with np.errstate(all="ignore"):
            if kind == "float64":
                trace = press.run(needed, values, keep, way=way)
            else:
                trace = run_blocks(program, needed, values, array_kind(kind), keep)
        return {target: trace.values[program.targets[target]] for target in targets}

    return work


def can_be_emitted(reference: Reference) -> bool:
    """Whether the program can be emitted as source code."""
    from graphkin.construction.tape.emitted import BatchRequest

    program, answers = reference.places.course.program, reference.answers
    keep = [program.targets[target] for target in answers.every]
    order = BatchRequest(reference.needed, reference.places.values, keep, False, {})
    return BatchRunner(program).emitted(order) is not None


# --- two other methods: Newton's method on the loop equations, and differences --------------------


TOLERANCES = (1e-3, 1e-6, 1e-12)
STEPS = (1e-2, 1e-4, 1e-6)
WARM = 1e-2
"""The distance of Newton's starting point before its position, in natural times."""
MOST = 2_000
"""The most variants of a batch for Newton's method, because each needs several matrices."""

NOTHING = (None, None, None)
"""The errors of a method that gives no answers."""

Values = Mapping[str, Any]


def plain(number: float) -> str:
    """A power of ten as a table writes it: 1e-3."""
    return f"1e{round(log10(number))}"


def other_methods(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Newton's method to three tolerances, and central differences with three steps."""
    yield from newton_rows(reference, effort)
    yield from difference_rows(reference, effort)


def natural_time(scene: Scene, values: Values, length: float) -> float:
    """The shortest time in which a driver turns by a radian or slides by a length.

    For a driver at rest it follows from the acceleration; 0 if no driver moves.
    """
    rates = [0.0]
    for number, driver in enumerate(scene.drivers, 1):
        size = 1.0 if driver.kind == "turn" else length
        _, speed, push = (np.abs(np.asarray(values[name], float)) for name in names(number))
        rates += [float(speed.max() / size), float(np.sqrt(push.max() / size))]
    return 1 / max(rates) if max(rates) > 0 else 0.0


def moved(scene: Scene, values: Values, time: float) -> dict[str, Any]:
    """The values after a time, every driver moved by its speed and acceleration."""
    found = dict(values)
    for number, driver in enumerate(scene.drivers, 1):
        name, rate, push = names(number)
        way = values[rate] * time + values[push] * time**2 / 2
        found[name] = values[name] + (np.degrees(way) if driver.kind == "turn" else way)
    return found


def in_floats(values: Values) -> dict[str, Any]:
    """Values as doubles and arrays of doubles."""
    return {n: v if hasattr(v, "shape") else float(v) for n, v in values.items()}


def newton_rows(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Newton's method to each tolerance; without errors where it cannot solve the loops."""
    count = min(variants_of(reference, effort), MOST)
    for tolerance in TOLERANCES:
        name = f"Newton, to {plain(tolerance)}"
        try:
            work = newton_work(reference, count, tolerance)
            columns = work()
        except (GraphkinError, np.linalg.LinAlgError) as error:
            note = str(error).partition(";")[0]
            yield Method(MethodRow("Newton", name, NOTHING, None, count, note=note))
            continue
        positions = len(reference.places.at)
        found = rows_of({t: v[:positions] for t, v in columns.items()}, positions)
        errors = reference.relative(reference.missed(found))
        yield Method(MethodRow("Newton", name, errors, None, count), work, count)


def newton_work(
    reference: Reference, count: int, tolerance: float
) -> Callable[[], dict[Target, Any]]:
    """The work that closes the loops from a neighbouring position and derives the motion."""
    places = reference.places
    scene, values = places.course.scene, in_floats(places.repeated(count))
    time = natural_time(scene, values, float(reference.scales[0])) or 0.0
    start = start_before(reference, scene, moved(scene, values, -WARM * time))
    loops = counted_in_order(equations(scene, values))

    def work() -> dict[Target, Any]:
        with np.errstate(all="ignore"):
            unknowns, _ = newton(loops, start, settled=tolerance)
            ratios = ratios_at(loops, unknowns)
            speed, push = loops.drives.speed, loops.drives.acceleration
            rates = ratios.rates(speed)
            motion = Motion.of(loops, unknowns, rates, ratios.accelerations(speed, push))
        return columns_of(motion, reference)

    return work


def start_before(reference: Reference, scene: Scene, before: Values) -> Reals:
    """The unknowns of the neighbouring positions, from the construction there."""
    program = reference.places.course.program
    needed = program.needed(program.answers)
    positions = [t for t in program.answers if t[0] in ("position", "slide")]
    keep = [program.targets[target] for target in positions]
    with np.errstate(all="ignore"):
        trace = BatchRunner(program).run(needed, before, keep, way="steps")
    loops = counted_in_order(equations(scene, before))
    return started(scene, loops, gathered(trace, scene.links))[0]


def columns_of(motion: Motion, reference: Reference) -> dict[Target, Any]:
    """The answers as arrays, from the motion that the loops give."""
    found: dict[Target, Any] = {}
    for targets in reference.answers.targets:
        for what, name in targets:
            place = KINDS.index(BY_TARGET[what].kind)
            if what in MOTION:
                found[what, name] = motion.point(name)[place]
            elif (guide := motion.loops.guide_index(name)) is not None:
                found[what, name] = motion.slide(guide)[place]
    return found


def difference_rows(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Central differences of positions, if anything moves."""
    places = reference.places
    scene = places.course.scene
    count = variants_of(reference, effort)
    values = in_floats(places.repeated(count))
    natural = natural_time(scene, values, float(reference.scales[0]))
    way: Way = "numpy" if can_be_emitted(reference) else "steps"
    for share in STEPS:
        name = f"central differences, h = {plain(share)}"
        if natural == 0:
            note = "every driver is at rest: there is nothing to difference"
            yield Method(MethodRow("differences", name, NOTHING, None, count, note=note))
            continue
        work = difference_work(reference, values, share * natural, way)
        columns = {target: head_of(v, len(places.at)) for target, v in work().items()}
        missed = reference.missed(rows_of(columns, len(places.at)))
        _, velocity, acceleration = reference.relative(missed)
        row = MethodRow("differences", name, (None, velocity, acceleration), None, count)
        yield Method(row, work, count)


def difference_work(
    reference: Reference, values: Values, time: float, way: Way
) -> Callable[[], dict[Target, Any]]:
    """The work that computes the positions before, now and after, and their differences."""
    places, answers = reference.places, reference.answers
    program, scene = places.course.program, places.course.scene
    targets = answers.targets[0]
    runs = [
        batch_work(program, targets, moved(scene, values, t), "float64", way)
        for t in (-time, 0.0, time)
    ]

    def work() -> dict[Target, Any]:
        before, now, after = (run() for run in runs)
        found = dict(now)
        for place, speed, push in zip(targets, *answers.targets[1:], strict=True):
            found[speed] = (after[place] - before[place]) / (2 * time)
            found[push] = (after[place] - 2 * now[place] + before[place]) / time**2
        return found

    return work
