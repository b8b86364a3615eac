"""Where a mechanism closes: why a step fails, by how much, and for which driver positions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from graphkin.errors import ClosureError, GraphkinError, Problem
from graphkin.scene.model import Driver, Scene
from graphkin.scene.quantity import LENGTHS, shortest
from graphkin.steps.closing import Closer, ClosingError, needed_of, sign_table
from graphkin.steps.program import Part, Program, Step
from graphkin.steps.run import StepFailed, miss

if TYPE_CHECKING:
    from graphkin.motion.course import Course

HALVINGS = 20
"""How often the last step at the end of a range is halved."""
TOUCH = 1e-9
"""Share of its loci by which a crossing may be missed that only touches, but for rounding."""
DEAD = "at this dead point the driver's speed determines no other: change the driver's position"
MOST = 3
"""Drivers told with their ranges."""
FREE = {
    (False, False): "{0} to {1} {2}",
    (True, False): "up to {1} {2}",
    (False, True): "{0} {2} and more",
    (True, True): "of any size",
}
"""Words for a range of a sliding driver, by whether it reaches below and above what was tried."""
Range = tuple[float, float]


# --- why a step fails ----------------------------------------------------------------------------


def does_not_close(
    scene: Scene, program: Program, needed: Sequence[int], failed: StepFailed
) -> ClosureError:
    """The error for a step that cannot be drawn: which, by how much, and where it could be."""
    step = failed.step
    if isinstance(failed.__cause__, ClosingError):
        return ClosureError(no_such_closure(scene, failed, failed.__cause__))
    letters = "-".join(step.says[key] for key in ("p", "q") if key in step.says)
    what = " of ".join(part for part in (step.part.value, step.name or letters) if part)
    early = step.part in (Part.SHAPE, Part.POSITION)
    return ClosureError(
        Problem(
            what,
            f"{sought(step)} cannot be found: {why(program, failed)}",
            "two different points" if falls(step) else "loci that cross",
            where_it_closes(scene) if early else DEAD,
        )
    )


def sought(step: Step) -> str:
    """What a step was to find."""
    if falls(step):
        return f"the direction of link {step.says['k']}"
    return step.name or "a value"


def falls(step: Step) -> bool:
    """Whether a step looks for the direction from one point to another, which fall together."""
    return step.action is not None and step.action.key == "swing-through"


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
        "graphkin check lists them, with where each puts the links",
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


def why(program: Program, failed: StepFailed) -> str:
    """Words for what hinders a step: loci that miss each other, or parallel lines."""
    step = failed.step
    key = step.action.key if step.action else ""
    if key == "swing-through":
        return f"{step.says['q']} falls on {step.says['p']}, so that any direction would do"
    if key == "swing":
        return f"{step.says['q']} stands nearer to {step.says['p']} than the guide passes it"
    missed = miss(step, failed.args_found)
    if missed is None or missed < TOUCH * size(failed.args_found):
        return in_line(program, failed.number)
    loci = "the arcs miss each other" if "q" in step.says else "the arc misses the guide"
    return f"{loci} by {millimetres(missed)}"


def size(loci: tuple[Any, ...]) -> float:
    """The largest radius of some loci (m)."""
    return max((float(each.radius) for each in loci if hasattr(each, "radius")), default=0.0)


def millimetres(length: float) -> str:
    """A length (m) in mm, with four digits."""
    return f"{shortest(float(f'{1e3 * length:.4g}'))} mm"


# --- which lines are parallel or in line ---------------------------------------------------------


def in_line(program: Program, number: int, nearly: str = "") -> str:
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
    if key.startswith(("close", "part", "share")) and "list" in says:
        verb = "nearly meet" if nearly else "meet"
        return f"two closures of links {says['list']} {verb}"
    return parallel(program, step, nearly)


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
    places = [f"{driver_words(driver)} at {stands(scene, driver)}" for driver in causes[:MOST]]
    words = in_line(program, number, "nearly ")
    return f"{words}: move {' or '.join(places)} away" if places else words


def driver_words(driver: Driver) -> str:
    """A driver in short, as it is written: turn = 1."""
    return f"{driver.kind} = {driver.link}"


def stands(scene: Scene, driver: Driver) -> str:
    """A driver's position as the scene has it, with its unit."""
    number = float(driver.position.number(scene.values))
    unit = driver.position.unit
    return f"{number:.10g}°" if unit == "deg" else f"{number:.10g} {unit}"


# --- for which positions of a driver it closes ---------------------------------------------------


def where_it_closes(scene: Scene) -> str:
    """Words for the positions of each driver at which every position can be drawn."""
    known = [
        (driver, reached_words(scene, closing_ranges(scene, n), n))
        for n, driver in enumerate(scene.drivers[:MOST], 1)
    ]
    if len(scene.drivers) == 1:
        ((driver, words),) = known
        if words:
            return (
                f"it closes for driver {'angles' if driver.kind == 'turn' else 'positions'} {words}"
            )
        noun = "angle" if driver.kind == "turn" else "position"
        return f"it closes for no {noun} of the driver: check the lengths"
    told = [f"{driver_words(driver)} from {words}" for driver, words in known if words]
    if not told:
        return "no driver alone can close it: check lengths, sides and the drivers' positions"
    return f"the other drivers as they stand, it closes for {'; or for '.join(told)}"


def reached_words(scene: Scene, found: Sequence[Range], number: int = 1) -> str:
    """The ranges of one driver, counted from 1, in the scene's units; empty where there are none.

    Ranges of angles are told in order of their first angle from -180 to 180 degrees.
    """
    if scene.drivers[number - 1].kind == "turn":
        turned = sorted(
            (low - turn, high - turn) for low, high in found for turn in [360 * (high > 360)]
        )
        return ", ".join(f"{low:.2f}° to {high:.2f}°" for low, high in turned)
    from graphkin.motion.sweep import sweep_of

    sweep, unit = sweep_of(scene, driver=number), scene.units["length"]
    words = []
    for low, high in found:
        first, last = (f"{end / float(LENGTHS[unit]):.6g}" for end in (low, high))
        free = low <= sweep.low + sweep.grid_step, high >= sweep.high - sweep.grid_step
        form = FREE[free]
        words.append(form.format(first, last, unit))
    return ", ".join(words)


def closing_ranges(scene: Scene, number: int = 1) -> list[Range]:
    """The ranges of a driver's position (degrees or m) for which all positions can be drawn.

    The closures are those that the scene picks, the other drivers stand. One turn is looked at, or
    as far as all lengths together reach; [(0, 360)] is a whole turn.
    """
    import numpy as np

    from graphkin.motion.course import Course
    from graphkin.motion.sweep import GRID, TURN, sweep_of

    sweep = sweep_of(scene, driver=number)
    course = Course(sweep, scene.branches)
    start = 0.0 if sweep.whole else sweep.low
    step = sweep.grid_step
    grid = start + np.arange(GRID + (not sweep.whole)) * step
    try:
        closed = course.closes(grid)
    except GraphkinError:
        return []
    if closed.all():
        return [(0.0, TURN)] if sweep.whole else [(float(grid[0]), float(grid[-1]))]
    if not closed.any():
        return []
    if not sweep.whole:
        closed = np.concatenate([[False], closed, [False]])
        grid = np.concatenate([[grid[0] - step], grid, [grid[-1] + step]])
    starts = np.flatnonzero(closed & ~np.roll(closed, 1))
    ends = np.flatnonzero(closed & ~np.roll(closed, -1))
    if ends[0] < starts[0]:
        ends = np.roll(ends, -1)
    lows, highs = refined(course, grid[starts], -step), refined(course, grid[ends], step)
    pairs = [(float(low), float(high)) for low, high in zip(lows, highs, strict=True)]
    return sorted((low - (TURN if high < low else 0), high) for low, high in pairs)


def refined(course: Course, at: Any, step: float) -> Any:
    """The ends of closing ranges, each between a position that closes and one a step further."""
    closing, size = at, step
    for _ in range(HALVINGS):
        size /= 2
        further = closing + size
        closing = closing + size * course.closes(further % 360 if course.sweep.whole else further)
    return closing
