"""What lies in line, parallel or square where a crossing fails or is flat, in words."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.kind import ClosesGroup, construction
from graphkin.construction.core.program import Program, Step
from graphkin.diagnosis.ranges import MOST
from graphkin.scene.model import Driver, Scene
from graphkin.structure.driver_count import driver_name


def in_line(scene: Scene, program: Program, number: int, nearly: str = "") -> str:
    """Which bars and guides are in line, parallel or square where a crossing fails or is flat.

    ``nearly`` is put before these words where the crossing is flat only.
    """
    step = program.steps[number]
    kind = step.of
    if isinstance(kind, Determined) and (words := kind.in_line(program.steps, nearly)):
        return words
    if links := closed_by(step):
        bars = arms(scene, links)
        if bars:
            return f"the lines {', '.join(bars[:-1])} and {bars[-1]} {nearly}meet in one point"
        return f"two closures of links {', '.join(links)} {nearly}meet"
    return parallel(program, step, nearly)


def closed_by(step: Step) -> tuple[str, ...]:
    """The links of the group of higher class that a step helps to close."""
    kind = construction(step)
    return kind.closes if isinstance(kind, ClosesGroup) else ()


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
    (first, square), (second, other) = (line_words(line) for line in lines)
    if not first or not second:
        return unnamed
    how = "parallel" if square == other else "perpendicular to each other"
    return f"{first} and {second} are {nearly}{how}"


def line_words(line: Step) -> tuple[str, bool]:
    """The bar or guide that a line of a plan hangs on, and whether it is drawn square to it."""
    kind = construction(line)
    runs = kind.runs if kind is not None else None
    return (runs.what, runs.square) if runs is not None else ("", False)


def beside_dead_point(scene: Scene, program: Program, number: int) -> str:
    """What is nearly in line where a crossing is flat, and which driver positions to leave."""
    drivers = zip(scene.drivers, program.drives, strict=False)
    needed = set(program.behind((number,)))
    causes = [driver for driver, drive in drivers if drive.position in needed]
    places = [f"{driver_name(driver)} from {stands(scene, driver)}" for driver in causes[:MOST]]
    words = in_line(scene, program, number, "nearly ")
    return f"{words}: move {' or '.join(places)} to another position" if places else words


def stands(scene: Scene, driver: Driver) -> str:
    """A driver's position as the scene has it, with its unit."""
    number = float(driver.position.number(scene.values))
    unit = driver.position.unit
    return f"{number:.10g}°" if unit == "deg" else f"{number:.10g} {unit}"
