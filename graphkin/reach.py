"""Why a step cannot be drawn, by how much it misses, and what lies in line at a dead point."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphkin.errors import ClosureError, Problem
from graphkin.ranges import MOST, driver_words, where_it_closes
from graphkin.scene.model import Driver, Scene
from graphkin.scene.quantity import shortest
from graphkin.steps.program import Part, Program, Step
from graphkin.steps.run import StepFailed, miss
from graphkin.steps.trying import Closer, ClosingError, needed_of, sign_table

TOUCH = 1e-9
"""Share of its loci by which a crossing may be missed that only touches, but for rounding."""
DEAD = "at this dead point the driver's speed determines no other: change the driver's position"


# --- why a step fails ----------------------------------------------------------------------------


def does_not_close(
    scene: Scene, program: Program, needed: Sequence[int], failed: StepFailed
) -> ClosureError:
    """The error for a step that cannot be drawn: which, by how much, and where it could be."""
    step = failed.step
    if isinstance(failed.__cause__, ClosingError):
        return ClosureError(no_such_closure(scene, failed, failed.__cause__))
    if falls(step):
        return ClosureError(no_direction(step))
    early = step.part in (Part.SHAPE, Part.POSITION)
    what = " of ".join(part for part in (step.part.value, sought(program, failed)) if part)
    return ClosureError(
        Problem(
            what,
            f"{step.name or 'a value'} cannot be found: {why(scene, program, failed)}",
            "loci that cross",
            where_it_closes(scene) if early else DEAD,
        )
    )


def sought(program: Program, failed: StepFailed) -> str:
    """What a step was to find: its letter, else the points or the links that it is about."""
    step = failed.step
    if step.action is not None and step.action.key == "share":
        return f"links {', '.join(closed_by(program, failed.number))}"
    return step.name or "-".join(step.says[key] for key in ("p", "q") if key in step.says)


def falls(step: Step) -> bool:
    """Whether a step looks for the direction from one point to another, which fall together."""
    return step.action is not None and step.action.key == "swing-through"


def no_direction(step: Step) -> Problem:
    """The problem of a slot through a pivot on which the pin in the slot has come to stand."""
    says = step.says
    return Problem(
        f"position of link {says['k']}",
        f"{says['q']} falls on {says['p']}, so that the guide through both may have any direction",
        f"{says['q']} and {says['p']} apart",
        f"move the driver, or give the guide an offset from {says['p']}",
    )


def no_such_closure(scene: Scene, failed: StepFailed, error: ClosingError) -> Problem:
    """The problem of a group of higher class that does not close, or not in so many ways."""
    links = failed.step.says["list"]
    if not error.ways:
        found = f"links {links} do not close{least_miss(failed)}"
        return Problem("position", found, "loci that cross", where_it_closes(scene))
    ways = "1 way" if error.ways == 1 else f"{error.ways} ways"
    return Problem(
        f"branches.{branch_of(scene, links)}",
        f"links {links} close in {ways} here, closure {error.asked} is asked",
        '"closure 1"' if error.ways == 1 else f'"closure 1" to "closure {error.ways}"',
        f"graphkin check lists them; with closure {error.asked} {where_it_closes(scene)}",
    )


def branch_of(scene: Scene, links: str) -> str:
    """The link under which the closure of some links is written."""
    names = links.split(", ")
    return next((name for name in names if name in scene.branches), names[0])


def least_miss(failed: StepFailed) -> str:
    """By how much a group of higher class fails to close, at the trial that comes nearest."""
    import numpy as np

    action = failed.step.action
    assert action is not None and isinstance(action.value, Closer)
    trying = action.value.trying
    if trying.facing is not None:
        return ""
    known = [np.atleast_1d(value) for value in failed.args_found]
    tried = trying.grid(known, 1).ravel()
    here = [np.repeat(array, len(tried)) for array in known]
    least = np.inf
    for signs in sign_table(len(trying.signs)):
        rows = np.broadcast_to(np.array(signs, dtype=float), (len(tried), len(signs)))
        missed = np.abs(trying.misfits(here, tried, rows))
        least = np.nanmin(missed, initial=least)
    if not np.isfinite(least):
        return ", wherever the first of them is tried"
    return f": they miss each other by {millimetres(least)}"


def why(scene: Scene, program: Program, failed: StepFailed) -> str:
    """Words for what hinders a step: loci that miss each other, or parallel lines."""
    step = failed.step
    key = step.action.key if step.action else ""
    if key == "swing":
        return f"{step.says['q']} stands nearer to {step.says['p']} than the guide passes it"
    missed = miss(step, failed.args_found)
    if missed is None:
        return in_line(scene, program, failed.number)
    if missed < TOUCH * size(failed.args_found):
        return f"{in_line(scene, program, failed.number)}, a dead point"
    loci = "the arcs miss each other" if "q" in step.says else "the arc misses the guide"
    return f"{loci} by {millimetres(missed)}"


def size(loci: tuple[Any, ...]) -> float:
    """The largest radius of some loci (m)."""
    return max((float(each.radius) for each in loci if hasattr(each, "radius")), default=0.0)


def millimetres(length: float) -> str:
    """A length (m) in mm, with four digits."""
    return f"{shortest(float(f'{1e3 * length:.4g}'))} mm"


# --- which lines are parallel or in line ---------------------------------------------------------


def in_line(scene: Scene, program: Program, number: int, nearly: str = "") -> str:
    """Which bars and guides are in line, parallel or square where a crossing fails or is flat.

    ``nearly`` is put before these words where the crossing is flat only.
    """
    step = program.steps[number]
    key = step.action.key if step.action else ""
    says, pin = step.says, step.name
    if key == "arcs-meet" and pin and "q" in says:
        return f"{says['p']}{pin} and {says['q']}{pin} are {nearly}in line"
    if key == "arc-cuts-line" and pin and "p" in says:
        return f"{says['p']}{pin} is {nearly}square to {guide_under(program, step)}"
    if key == "swing":
        return f"{says['p']}{says['q']} is {nearly}square to the guide of {says['g']}"
    if key.startswith(("close", "part", "share")) and (links := closed_by(program, number)):
        bars = arms(scene, links)
        if bars:
            return f"the lines {', '.join(bars[:-1])} and {bars[-1]} {nearly}meet in one point"
        return f"two closures of links {', '.join(links)} {nearly}meet"
    return parallel(program, step, nearly)


def closed_by(program: Program, number: int) -> list[str]:
    """The links of the group of higher class that a step helps to close."""
    for earlier in reversed(needed_of(program, (number,))):
        says = program.steps[earlier].says
        if "list" in says:
            return says["list"].split(", ")
    return []


def arms(scene: Scene, links: Sequence[str]) -> list[str]:
    """The three bars that hold the middle link of a group of class III; empty for other groups.

    That link can move although the driver stands where the three lines meet in one point.
    """
    for middle in links:
        points = set(scene.links[middle].points)
        bars = [scene.links[name].points for name in links if name != middle]
        if len(bars) == 3 and all(len(bar) == 2 and len(points & {*bar}) == 1 for bar in bars):
            return ["".join(bar) for bar in bars]
    return []


def parallel(program: Program, step: Step, nearly: str = "") -> str:
    """Which lines of the mechanism are parallel, or square to one another, when a crossing fails.

    Perpendiculars to two bars are parallel when the bars are.
    """
    lines = [program.steps[arg] for arg in step.args]
    unnamed = f"its two lines are {nearly}parallel"
    if len(lines) != 2 or any(line.action is None for line in lines):
        return unnamed
    (first, square), (second, other) = (line_words(program, line) for line in lines)
    if not first or not second:
        return unnamed
    how = "parallel" if square == other else "perpendicular to each other"
    return f"{first} and {second} are {nearly}{how}"


def line_words(program: Program, line: Step) -> tuple[str, bool]:
    """The bar or guide that a line of a plan hangs on, and whether it is drawn square to it."""
    key = line.action.key if line.action else ""
    says = line.says
    if key == "square-to" and "q" in says:
        return f"{says['p']}{says['q']}", True
    if key == "along-bar" and "q" in says:
        return f"{says['p']}{says['q']}", False
    if "g" in says:
        return f"the guide of {says['g']}", False
    if key == "shifted":
        return line_words(program, program.steps[line.args[0]])
    return "", False


def guide_under(program: Program, step: Step) -> str:
    """The guide on which a step seeks its point, from the words of the lines before it."""
    for arg in step.args:
        words, _ = line_words(program, program.steps[arg])
        if words:
            return words
    return "its guide"


def beside_dead_point(scene: Scene, program: Program, number: int) -> str:
    """What is nearly in line where a crossing is flat, and which driver positions to leave."""
    drivers = zip(scene.drivers, program.drives, strict=False)
    needed = set(needed_of(program, (number,)))
    causes = [driver for driver, drive in drivers if drive.position in needed]
    places = [f"{driver_words(driver)} from {stands(scene, driver)}" for driver in causes[:MOST]]
    words = in_line(scene, program, number, "nearly ")
    return f"{words}: move {' or '.join(places)} to another position" if places else words


def stands(scene: Scene, driver: Driver) -> str:
    """A driver's position as the scene has it, with its unit."""
    number = float(driver.position.number(scene.values))
    unit = driver.position.unit
    return f"{number:.10g}°" if unit == "deg" else f"{number:.10g} {unit}"
