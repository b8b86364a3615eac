"""Two other ways to the same answers: Newton's method on the loop equations, and differences.

Newton's method starts warm, from a neighbouring position, and then has the velocities and
accelerations from the derived equations; differences know positions alone, those before and after.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import log10
from typing import Any

import numpy as np

from graphkin.accuracy.compared_answers import Reference, rows_of
from graphkin.accuracy.effort import Effort
from graphkin.accuracy.methods import (
    Method,
    MethodRow,
    batch_work,
    can_be_emitted,
    head_of,
    variants_of,
)
from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import BY_TARGET, KINDS, MOTION
from graphkin.construction.core.solution import gathered
from graphkin.construction.tape.batch_runner import BatchRunner, Way
from graphkin.loops.closing_groups import counted_in_order
from graphkin.loops.equations import equations
from graphkin.loops.loop_motion import Motion
from graphkin.loops.newton import newton, ratios_at
from graphkin.loops.rigid_bodies import Reals
from graphkin.loops.rounding import Rounding
from graphkin.loops.witness.examine import started
from graphkin.motion.sweep import names
from graphkin.scene.model import Scene
from graphkin.text.errors import GraphkinError

TOLERANCES = (1e-3, 1e-6, 1e-12)
STEPS = (1e-2, 1e-4, 1e-6)
WARM = 1e-2
"""How long before its position Newton's method starts, in natural times."""
MOST = 2_000
"""Variants of a batch that Newton's method takes: each is some matrices."""

NOTHING = (None, None, None)
"""The errors of a method that gives none."""

Values = Mapping[str, Any]


def plain(number: float) -> str:
    """A power of ten as a table writes it: 1e-3."""
    return f"1e{round(log10(number))}"


def power(number: float) -> str:
    """A power of ten as a picture writes it."""
    return f"$10^{{{round(log10(number))}}}$"


def other_methods(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Newton's method to three tolerances, and central differences with three steps."""
    yield from newton_rows(reference, effort)
    yield from difference_rows(reference, effort)


def natural_time(scene: Scene, values: Values, length: float) -> float:
    """The time in which a driver turns by a radian or slides by a length, the shortest there is.

    From rest it is that of the acceleration; 0 where every driver stands.
    """
    rates = [0.0]
    for number, driver in enumerate(scene.drivers, 1):
        size = 1.0 if driver.kind == "turn" else length
        _, speed, push = (np.abs(np.asarray(values[name], float)) for name in names(number))
        rates += [float(speed.max() / size), float(np.sqrt(push.max() / size))]
    return 1 / max(rates) if max(rates) > 0 else 0.0


def moved(scene: Scene, values: Values, time: float) -> dict[str, Any]:
    """The values a time later, every driver moved by its speed and acceleration."""
    found = dict(values)
    for number, driver in enumerate(scene.drivers, 1):
        name, rate, push = names(number)
        way = values[rate] * time + values[push] * time**2 / 2
        found[name] = values[name] + (np.degrees(way) if driver.kind == "turn" else way)
    return found


def in_floats(values: Values) -> dict[str, Any]:
    """Values as doubles and arrays of them."""
    return {n: v if hasattr(v, "shape") else float(v) for n, v in values.items()}


def newton_rows(reference: Reference, effort: Effort) -> Iterator[Method]:
    """Newton's method to each tolerance; where the loops are not solvable so, it gives none."""
    count = min(variants_of(reference, effort), MOST)
    for tolerance in TOLERANCES:
        name, key = f"Newton, to {plain(tolerance)}", f"to {power(tolerance)}"
        try:
            work = newton_work(reference, count, tolerance)
            columns = work()
        except (GraphkinError, np.linalg.LinAlgError) as error:
            note = str(error).partition(";")[0]
            yield Method(MethodRow("Newton", name, key, NOTHING, None, count, note=note))
            continue
        positions = len(reference.places.at)
        found = rows_of({t: v[:positions] for t, v in columns.items()}, positions)
        errors = reference.relative(reference.missed(found))
        yield Method(MethodRow("Newton", name, key, errors, None, count), work, count)


def newton_work(
    reference: Reference, count: int, tolerance: float
) -> Callable[[], dict[Target, Any]]:
    """What closes the loops from a neighbouring position and derives them, for many variants."""
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


def columns_of(motion: Motion | Rounding, reference: Reference) -> dict[Target, Any]:
    """The answers as arrays, from the motion that the loops give, or their bounds."""
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
    """Central differences of positions, where anything moves."""
    places = reference.places
    scene = places.course.scene
    count = variants_of(reference, effort)
    values = in_floats(places.repeated(count))
    natural = natural_time(scene, values, float(reference.scales[0]))
    way: Way = "numpy" if can_be_emitted(reference) else "steps"
    for share in STEPS:
        name, key = f"central differences, h = {plain(share)}", f"h = {power(share)}"
        if natural == 0:
            note = "every driver stands still: there is nothing to differ"
            yield Method(MethodRow("differences", name, key, NOTHING, None, count, note=note))
            continue
        work = difference_work(reference, values, share * natural, way)
        columns = {target: head_of(v, len(places.at)) for target, v in work().items()}
        missed = reference.missed(rows_of(columns, len(places.at)))
        _, velocity, acceleration = reference.relative(missed)
        row = MethodRow("differences", name, key, (None, velocity, acceleration), None, count)
        yield Method(row, work, count)


def difference_work(
    reference: Reference, values: Values, time: float, way: Way
) -> Callable[[], dict[Target, Any]]:
    """What takes the positions before, now and after, and their differences."""
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
