"""Slips by name: what every field would be if a student went wrong in one known way.

A slip of the whole construction is computed truly: the program is run again with that one step
wrong, such as the Coriolis component turned round. A slip of one field is what a wrong scale, unit
or formula makes of the right drawing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import degrees, isnan, pi
from typing import Any

from graphkin.arithmetic import turn_by
from graphkin.grading.standard import Standard
from graphkin.pencil.marks import Paper
from graphkin.scene.model import Driver
from graphkin.steps.program import Program
from graphkin.structure.groups import Crank

RATIOS = {
    "rpm_as_rad": 30 / pi,
    "turns_as_rad": 1 / (2 * pi),
}
"""How many times too fast a crank turns whose rev/min, or rev/s, are taken for rad/s."""
AS_RPM = pi / 30
"""The same where rad/s are taken for rev/min."""
POWERS = (10.0, 100.0, 1000.0, 0.1, 0.01, 0.001)
REFLECTED = ("arcs-meet", "arc-cuts-line")
NAMES = (
    "rpm_as_rad",
    "turns_as_rad",
    "rad_as_rpm",
    "degrees_as_radians",
    "angle_clockwise",
    "driver_reversed",
    "driver_acceleration_missing",
    "diameter_for_radius",
    "radius_for_diameter",
    "other_side",
    "coriolis_missing",
    "coriolis_reversed",
    "normal_missing",
    "normal_reversed",
    "sense_reversed",
    "wrong_scale",
    "scale_missing",
    "length_not_scaled",
    "power_of_ten",
    "drawn_in_full",
    "swapped",
    "normal_for_tangential",
    "whole_for_tangential",
    "absolute_for_relative",
    "rate_in_degrees",
    "rate_in_turns",
    "axes_swapped",
    "opposite",
)
"""All slips, in the order in which equally good ones are named."""


@dataclass(frozen=True, slots=True)
class Slip:
    """A slip by name, and what each field that it changes would then be.

    ``whole`` tells that it is one of the construction, which goes through all that follows.
    """

    name: str
    whole: bool
    values: Mapping[str, float]


def slips(standard: Standard) -> tuple[Slip, ...]:
    """Every slip that changes a field of a variant."""
    return (*constructions(standard), *of_fields(standard))


# --- slips of the whole construction ----------------------------------------------------------


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
    in_turns = standard.mechanism.scene.units.get("speed") == "rev/min"
    ratios = RATIOS if in_turns else {"rad_as_rpm": AS_RPM}
    for name, ratio in ratios.items() if known else ():
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
    """The scale factors that follow from a crank as many times faster: its plan stays the same."""
    paper = standard.paper
    if not getattr(standard.scales, "from_driver", True):
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
    from graphkin.plans.links import crank_tip

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
    for number in standard.needed:
        step = program.steps[number]
        key = step.action.key if step.action is not None else ""
        if key in REFLECTED and step.extra and step.name and not step.hand:
            other = replace(step, extra=tuple(-sign for sign in step.extra))
            steps = (*program.steps[:number], other, *program.steps[number + 1 :])
            yield "other_side", standard.told({}, replaced(program, steps))


def replaced(program: Program, steps: tuple[Any, ...]) -> Program:
    """A program with other steps."""
    return replace(program, steps=steps)


def of_components(standard: Standard) -> Iterator[tuple[str, dict[str, float]]]:
    """Coriolis or normal components left out, or laid off the wrong way round."""
    values = standard.exact.trace.values
    steps = standard.mechanism.program.steps
    for kind in ("coriolis", "normal"):
        found = [
            n
            for n in standard.needed
            if steps[n].action is not None and getattr(steps[n].action, "key", "") == kind
        ]
        if found:
            yield f"{kind}_missing", standard.told(dict.fromkeys(found, 0j))
            yield f"{kind}_reversed", standard.told({n: -values[n] for n in found})


# --- slips of one field -----------------------------------------------------------------------


def of_fields(standard: Standard) -> Iterator[Slip]:
    """What wrong scales, units and formulas make of single fields."""
    gathered: dict[str, list[dict[str, float]]] = {}
    for probe in standard.probes:
        for name, value in of_field(standard, probe.item.field):
            if differs(standard, probe.item.field, value):
                room = gathered.setdefault(name, [])
                free = next((each for each in room if probe.item.field not in each), None)
                if free is None:
                    room.append({probe.item.field: value})
                else:
                    free[probe.item.field] = value
    for name, alternatives in gathered.items():
        for values in alternatives:
            yield Slip(name, False, values)


def of_field(standard: Standard, field: str) -> Iterator[tuple[str, float]]:
    """The slips of one field: name and what it would be."""
    item, right = standard.by_field[field].item, standard.key[field]
    if item.what == "sense":
        if right:
            yield "sense_reversed", -right
        return
    if item.what == "place":
        yield from of_place(standard, field)
        return
    if item.what == "segment":
        yield from of_segment(standard, field)
    elif item.unit.startswith("rad"):
        yield from of_rate(standard, field)
    else:
        yield from of_vector(standard, field)
    for power in POWERS:
        yield "power_of_ten", right * power
    yield from swapped(standard, field)


def of_segment(standard: Standard, field: str) -> Iterator[tuple[str, float]]:
    """A length that is not measured on paper: of the other plan's scale, or of the real thing."""
    probe, paper = standard.by_field[field], standard.paper
    own = paper.millimetre(probe.plane)
    length = standard.key[field]
    yield "scale_missing", length * own
    yield "drawn_in_full", length * paper.mechanism


def of_vector(standard: Standard, field: str) -> Iterator[tuple[str, float]]:
    """A velocity or acceleration from the right segment by a wrong factor, or by none."""
    probe, paper = standard.by_field[field], standard.paper
    length = abs(standard.key[field]) / paper.millimetre(probe.plane)
    yield "scale_missing", length
    for factor in (paper.mechanism, paper.velocities, paper.accelerations):
        yield "wrong_scale", length * factor / 1000


def of_rate(standard: Standard, field: str) -> Iterator[tuple[str, float]]:
    """A rate over a bar measured on paper, of the wrong vector, or in the wrong unit."""
    right, number = abs(standard.key[field]), standard.by_field[field].step
    yield "length_not_scaled", right * standard.paper.mechanism
    yield "wrong_scale", right / standard.paper.mechanism
    yield from rates_of(standard, number)
    if standard.by_field[field].item.quantity == "omega":
        yield "rate_in_degrees", degrees(right)
        yield "rate_in_turns", right * 30 / pi


def rates_of(standard: Standard, number: int) -> Iterator[tuple[str, float]]:
    """Rates that are reckoned from another vector than the one that is square to the bar."""
    step, values = standard.mechanism.program.steps[number], standard.exact.trace.values
    if len(step.args) != 4 or step.action is None:
        return
    p, q, tail, tip = (values[arg] for arg in step.args)
    bar = abs(q - p)
    if step.action.key == "omega":
        yield "absolute_for_relative", abs(tip) / bar
        yield "absolute_for_relative", abs(tail) / bar
    elif step.action.key == "epsilon":
        whole = (tip - tail) / (q - p)
        yield "normal_for_tangential", abs(whole.real)
        yield "whole_for_tangential", abs(whole)


def of_place(standard: Standard, field: str) -> Iterator[tuple[str, float]]:
    """A coordinate of the other axis, or counted the other way."""
    other = (
        field.replace("_x_mm", "_y_mm")
        if field.endswith("_x_mm")
        else field.replace("_y_mm", "_x_mm")
    )
    if other in standard.key:
        yield "axes_swapped", standard.key[other]
    yield "opposite", -standard.key[field]


def swapped(standard: Standard, field: str) -> Iterator[tuple[str, float]]:
    """The normal component in the place of the tangential one, and the other way round."""
    for this, that in (("_nu", "_tau"), ("_tau", "_nu")):
        stem, found, tail = field.rpartition(this)
        if found and tail in ("", "_mm") and f"{stem}{that}{tail}" in standard.key:
            yield "swapped", standard.key[f"{stem}{that}{tail}"]


def differs(standard: Standard, field: str, value: float) -> bool:
    """Whether a field is told otherwise than by the key, by more than it may be off."""
    if isnan(value):
        return False
    item, right = standard.by_field[field].item, standard.key[field]
    if item.what == "sense":
        return value != 0 and value == -right
    allowed = standard.tolerance[field].value
    if item.what == "place":
        return abs(value - right) > allowed
    return abs(abs(value) - abs(right)) > allowed
