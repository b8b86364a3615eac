"""Slips of single fields: what a wrong scale, unit or formula makes of the right drawing."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, pi

from msgspec.structs import replace

from graphkin.classroom.grading.slips import Slip, differs, unit_ratios
from graphkin.classroom.grading.standard import Standard
from graphkin.classroom.lab.items import motion_of
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import OMEGA, RATES
from graphkin.construction.velocity.turning_of_link import TurningOfLink

OTHER = {"ν": "τ", "τ": "ν"}
"""The component that is taken for another."""
POWERS = (10.0, 100.0, 1000.0, 0.1, 0.01, 0.001)


def of_fields(standard: Standard) -> Iterator[Slip]:
    """What wrong scales, units and formulas make of single fields: one slip for each way in which
    it can be made, with all fields in which it can be made so.
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
"""A slip of a field: its name, the way in which it is made, and what the field would be."""


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
    """A length that is not measured on paper: of the other plan's scale, or of the real thing."""
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
    """A rate over a bar measured on paper, of the wrong vector, or in the wrong unit."""
    right, number = abs(standard.key[field]), standard.by_field[field].step
    yield "length_not_scaled", "", right * standard.paper.mechanism
    yield "wrong_scale", "without lengths", right / standard.paper.mechanism
    yield from rates_of(standard, number)
    if standard.by_field[field].item.quantity == OMEGA:
        yield "rate_in_degrees", "", degrees(right)
        yield "rate_in_turns", "", right * 30 / pi


def of_unit(standard: Standard, field: str) -> Iterator[Way]:
    """A velocity or acceleration after a driver's speed in the wrong unit, only in this field.

    Accelerations go with the square of the speed, or with the speed where only one factor is wrong.
    """
    right, plane = abs(standard.key[field]), standard.by_field[field].plane
    for name, ratio in unit_ratios(standard).items():
        yield name, "once", right * ratio
        squared = plane is Plane.ACCELERATIONS
        yield name, "squared", right * (ratio**2 if squared else ratio)


def rates_of(standard: Standard, number: int) -> Iterator[Way]:
    """Rates that are reckoned from another vector than the one that is square to the bar."""
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
    """A coordinate of the other axis, or counted the other way."""
    item = standard.by_field[field].item
    other = item.beside("place", "y" if item.axis == "x" else "x")
    if other in standard.key:
        yield "axes_swapped", "", standard.key[other]
    yield "opposite", "", -standard.key[field]


def swapped(standard: Standard, field: str) -> Iterator[Way]:
    """The component along the bar in the place of that across it, and the other way round."""
    item = standard.by_field[field].item
    if item.vector is None or item.vector.sign not in OTHER:
        return
    other = replace(item.vector, sign=OTHER[item.vector.sign]).symbol
    for each in standard.items:
        if each.what == item.what and each.vector is not None and each.vector.symbol == other:
            yield "swapped", "", standard.key[each.field]
