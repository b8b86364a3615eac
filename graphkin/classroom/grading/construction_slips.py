"""Slips of the whole construction: it is run again with one step wrong, all else rightly drawn.

So a component that is turned round shows in every field that hangs on it, and only there.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import Any

from msgspec.structs import replace

from graphkin.accuracy.pencil.pencil_marks import Paper
from graphkin.classroom.grading.slips import Slip, differs, unit_ratios
from graphkin.classroom.grading.standard import Standard
from graphkin.construction.core.component import component_of
from graphkin.construction.core.crossings import Determined
from graphkin.construction.registry import COMPONENTS
from graphkin.numbers.arithmetic import turn_by
from graphkin.scene.model import Driver
from graphkin.structure.groups import Crank


def constructions(standard: Standard) -> Iterator[Slip]:
    """Slips after which everything is constructed rightly from something wrong."""
    for name, told in (
        *of_drivers(standard),
        *of_cranks(standard),
        *of_sides(standard),
        *of_components(standard),
    ):
        changed = {field: value for field, value in told.items() if differs(standard, field, value)}
        if changed:
            yield Slip(name, True, changed)


def of_drivers(standard: Standard) -> Iterator[tuple[str, dict[str, float]]]:
    """A driver's speed in the wrong unit or sense, its angle misread, its acceleration left out."""
    program, values = standard.mechanism.program, standard.exact.trace.values
    every = list(zip(standard.mechanism.scene.drivers, program.drives, strict=True))
    turning = [drive for driver, drive in every if driver.kind == "turn"]
    known = [drive for drive in turning if drive.speed in values]
    for name, ratio in unit_ratios(standard).items() if known else ():
        faster = {drive.speed: values[drive.speed] * ratio for drive in known}
        yield name, standard.told(faster, paper=scaled(standard, ratio))
    if known:
        yield "driver_reversed", standard.told({d.speed: -values[d.speed] for d in known})
    placed = [drive for drive in turning if drive.position in values]
    if placed:
        yield (
            "angle_clockwise",
            standard.told({d.position: values[d.position].conjugate() for d in placed}),
        )
        yield "degrees_as_radians", standard.told(in_degrees(standard, every))
    hastened = [d for _, d in every if values.get(d.acceleration)]
    if hastened:
        nothing = {drive.acceleration: 0.0 for drive in hastened}
        yield "driver_acceleration_missing", standard.told(nothing)


def scaled(standard: Standard, ratio: float) -> Paper:
    """The scale factors that follow from a crank as many times faster: its plan stays the same.

    Where no crank says them, they stay as the sheet states them.
    """
    paper = standard.paper
    if not standard.scales.of_crank:
        return paper
    return Paper(paper.mechanism, paper.velocities * ratio, paper.accelerations * ratio**2)


def in_degrees(standard: Standard, every: list[tuple[Driver, Any]]) -> dict[int, Any]:
    """The directions of cranks whose angle in degrees was given to a cosine in radians."""
    values = standard.mechanism.scene.values
    found: dict[int, Any] = {}
    for driver, drive in every:
        if driver.kind == "turn" and standard.mechanism.scene.units.get("angle") == "deg":
            angle = degrees(float(driver.position.si(values)))
            found[drive.position] = turn_by(angle)
            if drive.angle is not None:
                found[drive.angle] = angle
    return found


def of_cranks(standard: Standard) -> Iterator[tuple[str, dict[str, float]]]:
    """Cranks drawn twice as long, or half: a diameter for a radius."""
    program, values = standard.mechanism.program, standard.exact.trace.values
    from graphkin.construction.core.bases import crank_tip

    tips: dict[int, tuple[Any, Any]] = {}
    for group in standard.mechanism.groups:
        tip = crank_tip(standard.mechanism.scene, group) if isinstance(group, Crank) else None
        number = program.targets.get(("position", tip or ""), -1)
        if isinstance(group, Crank) and number in values:
            tips[number] = values[program.targets["position", group.pivot]], values[number]
    for name, ratio in (("diameter_for_radius", 2.0), ("radius_for_diameter", 0.5)):
        if tips:
            longer = {n: pivot + ratio * (tip - pivot) for n, (pivot, tip) in tips.items()}
            yield name, standard.told(longer)


def of_sides(standard: Standard) -> Iterator[tuple[str, dict[str, float]]]:
    """A pin drawn where the arcs meet on the other side."""
    program = standard.mechanism.program
    for number in standard.layout.needed:
        step = program.steps[number]
        mirrored = isinstance(step.of, Determined) and step.of.has_mirror
        if mirrored and step.extra:
            other = replace(step, extra=tuple(-sign for sign in step.extra))
            steps = (*program.steps[:number], other, *program.steps[number + 1 :])
            yield "other_side", standard.told({}, replace(program, steps=steps))


def of_components(standard: Standard) -> Iterator[tuple[str, dict[str, float]]]:
    """Components left out, or laid off the wrong way round."""
    values, program = standard.exact.trace.values, standard.mechanism.program
    for kind in reversed(COMPONENTS):
        found = [n for n in standard.layout.needed if isinstance(component_of(program, n), kind)]
        for name, times in kind.slips.items() if found else ():
            yield name, standard.told({n: times * values[n] for n in found})
