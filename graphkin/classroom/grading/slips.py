"""Slips by name: known mistakes, and the value that each field then takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees, isnan, pi
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil.pencil import Paper
from graphkin.classroom.grading.standard import Standard
from graphkin.classroom.lab.items import motion_of
from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.core.quantities import OMEGA, RATES
from graphkin.construction.registry import SLIPPING
from graphkin.construction.velocity.turning_of_link import TurningOfLink
from graphkin.numbers.arithmetic import turn_by
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Driver
from graphkin.structure.groups import Crank

RATIOS = {
    "rpm_as_rad": 30 / pi,
    "turns_as_rad": 1 / (2 * pi),
}
"""The factor on a crank's speed where rev/min, or rev/s, are taken for rad/s."""
AS_RPM = pi / 30
"""The factor on a crank's speed where rad/s are taken for rev/min."""
UNITS_TAKEN = (*RATIOS, "rad_as_rpm")
"""The slips in a speed's unit."""


class Slip(Struct, frozen=True):
    """A slip by name, and the value of each field that it changes.

    ``whole`` says that the slip is in the construction and changes everything that follows.
    """

    name: str
    whole: bool
    values: Mapping[str, float]


def unit_ratios(standard: Standard) -> Mapping[str, float]:
    """The factor on a crank's speed for each slip in its unit."""
    in_turns = standard.mechanism.scene.units.get("speed") == "rev/min"
    return RATIOS if in_turns else {"rad_as_rpm": AS_RPM}


def differs(standard: Standard, field: str, value: float) -> bool:
    """Whether a value differs from the key by more than the tolerance; False for NaN."""
    if isnan(value):
        return False
    item, right = standard.by_field[field].item, standard.key[field]
    if item.what == "sense":
        return value != 0 and value == -right
    return abs(item.off(value, right)) > standard.tolerance[field].value


# --- slips of single fields: what a wrong scale, unit or formula makes of the right drawing -------


OTHER = {"ν": "τ", "τ": "ν"}
"""The component mistaken for another."""
POWERS = (10.0, 100.0, 1000.0, 0.1, 0.01, 0.001)


def of_fields(standard: Standard) -> Iterator[Slip]:
    """Slips of single fields: wrong scales, units and formulas.

    There is one slip for each way of making it, with all fields in which it can be made so.
    """
    gathered: dict[tuple[str, str], dict[str, float]] = {}
    for probe in standard.layout.probes:
        field = probe.item.field
        for name, way, value in of_field(standard, field):
            if differs(standard, field, value):
                gathered.setdefault((name, way), {})[field] = value
    for (name, _), values in gathered.items():
        yield Slip(name, False, values)


Way = tuple[str, str, float]
"""A slip of a field: its name, the way in which it is made, and the value of the field."""


def of_field(standard: Standard, field: str) -> Iterator[Way]:
    """The slips of one field."""
    item, right = standard.by_field[field].item, standard.key[field]
    if item.what == "sense":
        if right:
            yield "sense_reversed", "", -right
        return
    if item.what == "place":
        yield from of_place(standard, field)
        return
    if item.what == "segment":
        yield from of_segment(standard, field)
    else:
        is_rate = motion_of(item) in RATES
        yield from of_rate(standard, field) if is_rate else of_vector(standard, field)
        yield from of_unit(standard, field)
    for power in POWERS:
        yield "power_of_ten", f"{power:g}", right * power
    yield from swapped(standard, field)


def of_segment(standard: Standard, field: str) -> Iterator[Way]:
    """A length not measured on paper: in the plan's units, or of the real thing."""
    probe, paper = standard.by_field[field], standard.paper
    own = paper.millimetre(probe.plane)
    length = standard.key[field]
    yield "scale_missing", "", length * own
    yield "drawn_in_full", "", length * paper.mechanism


def of_vector(standard: Standard, field: str) -> Iterator[Way]:
    """A velocity or acceleration from the right segment by a wrong factor, or by none."""
    probe, paper = standard.by_field[field], standard.paper
    right = abs(standard.key[field])
    length = right / paper.millimetre(probe.plane)
    yield "scale_missing", "", length
    scales = (paper.mechanism, paper.velocities, paper.accelerations)
    for way, factor in zip(("lengths", "velocities", "accelerations"), scales, strict=True):
        yield "wrong_scale", way, length * factor / 1000
    yield "wrong_scale", "without lengths", right / paper.mechanism
    yield "wrong_scale", "lengths twice", right * paper.mechanism


def of_rate(standard: Standard, field: str) -> Iterator[Way]:
    """A rate with the bar measured on paper, from the wrong vector, or in the wrong unit."""
    right, number = abs(standard.key[field]), standard.by_field[field].step
    yield "length_not_scaled", "", right * standard.paper.mechanism
    yield "wrong_scale", "without lengths", right / standard.paper.mechanism
    yield from rates_of(standard, number)
    if standard.by_field[field].item.quantity == OMEGA:
        yield "rate_in_degrees", "", degrees(right)
        yield "rate_in_turns", "", right * 30 / pi


def of_unit(standard: Standard, field: str) -> Iterator[Way]:
    """A velocity or acceleration from a driver's speed in the wrong unit, in this field only.

    Accelerations scale with the square of the speed, or with the speed where only one factor is
    wrong.
    """
    right, plane = abs(standard.key[field]), standard.by_field[field].plane
    for name, ratio in unit_ratios(standard).items():
        yield name, "once", right * ratio
        squared = plane is Plane.ACCELERATIONS
        yield name, "squared", right * (ratio**2 if squared else ratio)


def rates_of(standard: Standard, number: int) -> Iterator[Way]:
    """Rates computed from another vector than the one perpendicular to the bar."""
    step, values = standard.mechanism.program.steps[number], standard.exact.trace.values
    if not isinstance(step.of, TurningOfLink):
        return
    p, q, tail, tip = (values[arg] for arg in step.args)
    bar = abs(q - p)
    if step.of.quantity == OMEGA:
        yield "absolute_for_relative", "tip", abs(tip) / bar
        yield "absolute_for_relative", "tail", abs(tail) / bar
    else:
        whole = (tip - tail) / (q - p)
        yield "normal_for_tangential", "", abs(whole.real)
        yield "whole_for_tangential", "", abs(whole)


def of_place(standard: Standard, field: str) -> Iterator[Way]:
    """A coordinate of the other axis, or with the opposite sign."""
    item = standard.by_field[field].item
    other = item.beside("place", "y" if item.axis == "x" else "x")
    if other in standard.key:
        yield "axes_swapped", "", standard.key[other]
    yield "opposite", "", -standard.key[field]


def swapped(standard: Standard, field: str) -> Iterator[Way]:
    """The component along the bar in place of the one perpendicular to it, or the reverse."""
    item = standard.by_field[field].item
    if item.vector is None or item.vector.sign not in OTHER:
        return
    other = replace(item.vector, sign=OTHER[item.vector.sign]).symbol
    for each in standard.items:
        if each.what == item.what and each.vector is not None and each.vector.symbol == other:
            yield "swapped", "", standard.key[each.field]


# --- slips of the whole construction --------------------------------------------------------------


def constructions(standard: Standard) -> Iterator[Slip]:
    """Slips after which everything is constructed correctly from something wrong."""
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
    """A driver's speed in the wrong unit or sense, its angle misread, no acceleration."""
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
    """The scale factors that follow from a crank ``ratio`` times as fast; its plan keeps its size.

    Where the crank does not set them, they stay as stated on the sheet.
    """
    paper = standard.paper
    if not standard.scales.of_crank:
        return paper
    return Paper(paper.mechanism, paper.velocities * ratio, paper.accelerations * ratio**2)


def in_degrees(standard: Standard, every: list[tuple[Driver, Any]]) -> dict[int, Any]:
    """The directions of cranks whose angle in degrees was taken for radians in a cosine."""
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
    """Cranks drawn twice or half as long: a diameter for a radius, or the reverse."""
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
    """A pin drawn at the other intersection of the arcs."""
    program = standard.mechanism.program
    for number in standard.layout.needed:
        step = program.steps[number]
        mirrored = isinstance(step.of, Determined) and step.of.has_mirror
        if mirrored and step.extra:
            other = replace(step, extra=tuple(-sign for sign in step.extra))
            steps = (*program.steps[:number], other, *program.steps[number + 1 :])
            yield "other_side", standard.told({}, replace(program, steps=steps))


def of_components(standard: Standard) -> Iterator[tuple[str, dict[str, float]]]:
    """Components left out or laid off in the wrong direction, and centres on the wrong side."""
    values, steps = standard.exact.trace.values, standard.mechanism.program.steps
    for kind in reversed(SLIPPING):
        found = [n for n in standard.layout.needed if is_result(steps[n], kind)]
        for name, times in kind.slips.items() if found else ():
            yield name, standard.told({n: times_as_far(values[n], times) for n in found})


def is_result(step: Step, kind: type[Construction]) -> bool:
    """Whether a step is the result of a kind of construction: its component, or its centre."""
    return isinstance(step.of, kind) and step.role in ("vector", "found")


def times_as_far(value: Any, times: complex) -> Any:
    """A component times a number; a centre so many times as far from where it is counted."""
    return value._replace(shift=times * value.shift) if isinstance(value, Ratio) else times * value
