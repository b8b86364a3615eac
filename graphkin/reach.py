"""Where a mechanism closes: why a step fails, by how much, and for which driver angles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphkin.arithmetic import batch_kind
from graphkin.errors import ClosureError, Problem
from graphkin.scene.model import Scene
from graphkin.scene.quantity import shortest
from graphkin.steps.batch import run_batch
from graphkin.steps.closing import ClosingError
from graphkin.steps.program import Part, Program, Step
from graphkin.steps.run import StepFailed, miss

HALVINGS = 20
"""How often the last step at the end of a range is halved."""
SAMPLES = 7200
"""Driver angles tried in one turn: every twentieth of a degree."""
DEAD = "at this dead point the driver's speed determines no other: change the driver's position"


def does_not_close(
    scene: Scene, program: Program, needed: Sequence[int], failed: StepFailed
) -> ClosureError:
    """The error for a step that cannot be drawn: which, by how much, and where it could be."""
    step = failed.step
    letters = "-".join(step.says[key] for key in ("p", "q") if key in step.says)
    what = " of ".join(part for part in (step.part.value, step.name or letters) if part)
    early = step.part in (Part.SHAPE, Part.POSITION)
    if isinstance(failed.__cause__, ClosingError):
        return ClosureError(no_such_closure(scene, program, needed, failed.__cause__, step))
    return ClosureError(
        Problem(
            what,
            f"{step.name or 'a value'} cannot be found: {why(program, failed)}",
            "loci that cross",
            where_it_closes(scene, program, needed) if early else DEAD,
        )
    )


def no_such_closure(
    scene: Scene, program: Program, needed: Sequence[int], error: ClosingError, step: Step
) -> Problem:
    """The problem of a group of higher class that does not close, or not in so many ways."""
    links = step.says["list"]
    if not error.ways:
        found = f"links {links} do not close"
        return Problem("position", found, "loci that cross", where_it_closes(scene, program, needed))
    ways = "1 way" if error.ways == 1 else f"{error.ways} ways"
    return Problem(
        "branches",
        f"links {links} close in {ways} here, closure {error.asked} is asked",
        '"closure 1"' if error.ways == 1 else f'"closure 1" to "closure {error.ways}"',
        "graphkin check lists them, with where each puts the links",
    )


def why(program: Program, failed: StepFailed) -> str:
    """Words for what hinders a step: loci that miss each other, or parallel lines."""
    step = failed.step
    key = step.action.key if step.action else ""
    if key == "swing-through":
        return f"{step.says['q']} falls on {step.says['p']}, so that any direction would do"
    if key == "swing":
        return f"{step.says['q']} stands nearer to {step.says['p']} than the guide passes it"
    missed = miss(step, failed.args_found)
    if missed is None:
        return parallel(program, step)
    loci = "the arcs miss each other" if "q" in step.says else "the arc misses the guide"
    return f"{loci} by {shortest(float(f'{1e3 * missed:.4g}'))} mm"


def parallel(program: Program, step: Step) -> str:
    """Which lines of the mechanism are parallel, or square to one another, when a crossing fails.

    Perpendiculars to two bars are parallel when the bars are.
    """
    lines = [program.steps[arg] for arg in step.args]
    if len(lines) != 2 or any(line.action is None for line in lines):
        return "its two lines are parallel"
    (first, square), (second, other) = (line_words(line) for line in lines)
    if not first or not second:
        return "its two lines are parallel"
    how = "parallel" if square == other else "perpendicular to each other"
    return f"{first} and {second} are {how}"


def line_words(line: Step) -> tuple[str, bool]:
    """The bar or guide that a line of a plan hangs on, and whether it is drawn square to it."""
    key = line.action.key if line.action else ""
    says = line.says
    if key == "square-to":
        return f"{says['p']}{says['q']}", True
    if key == "along-bar" and "q" in says:
        return f"{says['p']}{says['q']}", False
    if "g" in says:
        return f"the guide of {says['g']}", False
    return "", False


def where_it_closes(scene: Scene, program: Program, needed: Sequence[int]) -> str:
    """Words for the driver angles at which every position can be drawn."""
    turning = [driver for driver in scene.drivers if driver.kind == "turn"]
    if len(turning) != 1:
        return "check lengths, sides and the drivers' positions"
    ranges = closing_ranges(program, needed, scene)
    if not ranges:
        return "it closes for no angle of the driver: check the lengths"
    words = ", ".join(f"{low:.2f}° to {high:.2f}°" for low, high in ranges)
    return f"it closes for driver angles {words}"


def closing_ranges(
    program: Program, needed: Sequence[int], scene: Scene
) -> list[tuple[float, float]]:
    """The ranges of the driver's angle (degrees) for which all positions can be drawn.

    A range over 0° begins with a negative angle.
    """
    import numpy as np

    degrees = np.arange(SAMPLES) * (360 / SAMPLES)
    closed = closes_at(program, needed, scene, degrees)
    if closed.all():
        return [(0.0, 360.0)]
    if not closed.any():
        return []
    starts = np.flatnonzero(closed & ~np.roll(closed, 1))
    ends = np.flatnonzero(closed & ~np.roll(closed, -1))
    if ends[0] < starts[0]:
        ends = np.roll(ends, -1)
    lows = refined(program, needed, scene, degrees[starts], -360 / SAMPLES)
    highs = refined(program, needed, scene, degrees[ends], 360 / SAMPLES)
    return sorted(
        (float(low - (360 if high < low else 0)), float(high))
        for low, high in zip(lows, highs, strict=True)
    )


def refined(
    program: Program, needed: Sequence[int], scene: Scene, degrees: Any, step: float
) -> Any:
    """The ends of closing ranges, each between an angle that closes and one a step further."""
    closing, size = degrees, step
    for _ in range(HALVINGS):
        size /= 2
        further = closing + size
        closed = closes_at(program, needed, scene, further % 360)
        closing = closing + size * closed
    return closing


def closes_at(program: Program, needed: Sequence[int], scene: Scene, degrees: Any) -> Any:
    """Whether all positions can be drawn, for each of an array of driver angles in degrees."""
    import numpy as np

    kind = batch_kind()
    early = (Part.SHAPE, Part.POSITION)
    steps = [n for n in needed if program.steps[n].part in early and not program.steps[n].hand]
    angle = {n: kind.direction(degrees) for n in steps if program.steps[n].name == "phi"}
    with np.errstate(all="ignore"):
        trace = run_batch(program, steps, dict(scene.values), kind, steps, overrides=angle)
    closed = np.ones(len(degrees), dtype=bool)
    for value in trace.values.values():
        if isinstance(value, np.ndarray):
            closed &= np.isfinite(value)
    return closed
