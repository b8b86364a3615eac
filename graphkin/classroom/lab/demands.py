"""What the drawings of many variants demand of a hand: angles, segments, triangles, as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from graphkin.classroom.lab.drawing_extents import VariantSheet
from graphkin.classroom.lab.items import arrow_steps
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.component import component_of
from graphkin.construction.core.crossings import is_drawn, letter_of
from graphkin.construction.core.program import Part
from graphkin.construction.core.quantities import BY_TARGET, RATES
from graphkin.numbers.arrays import np
from graphkin.numbers.plane import Vector

Array = Any


def crossing_angles(sheet: VariantSheet) -> Iterator[tuple[str, Array]]:
    """The angle in degrees at which lines cross for each point that answers hang on.

    What only the hand's way of a plate or a triangle needs has another way, or its own limit.
    """
    program = sheet.trace.program
    for number, sine in sheet.trace.margins.items():
        step = program.steps[number]
        if step.hand or step.part in (Part.CENTRE, Part.POLE) or not is_drawn(step, 1.0):
            continue
        angle = np.degrees(np.arcsin(np.clip(sine, 0.0, 1.0)))
        yield letter_of(program, number) or f"step {number}", angle


def segment_lengths(
    sheet: VariantSheet, form: Sequence[Item], scale: Array
) -> Iterator[tuple[str, Array]]:
    """How long, in mm, the segment is that each field of the form is measured by, on its sheet."""
    for item in form:
        size = measured(sheet, item)
        if size is not None:
            yield item.field, 1000 * np.abs(size) / scale


def measured(sheet: VariantSheet, item: Item) -> Array | None:
    """The vector of a plan by which a field is measured; None where this sheet has none.

    A rate is read by the relative velocity, or its tangential acceleration, over the bar.
    """
    trace, program = sheet.trace, sheet.trace.program
    quantity = BY_TARGET.get(item.quantity)
    twin = quantity is None or quantity.sort == "vector"
    if item.what in ("sense", "place") or (item.what == "value" and twin):
        return None
    if quantity is None:
        value = trace.values.get(arrow_steps(program).get(item.of, -1))
        return value.tip - value.tail if isinstance(value, Vector) else None
    number = program.targets.get((item.quantity, item.of), -1)
    if number not in trace.values or sheet.kind != quantity.kind:
        return None
    if quantity not in RATES:
        return trace.values[number]
    args = program.steps[number].args
    if len(args) != 4:
        return None
    return trace.values[number] * abs(trace.values[args[1]] - trace.values[args[0]])


def triangle_ratios(sheet: VariantSheet) -> Iterator[tuple[str, Array]]:
    """v/l of each triangle that is drawn for a component, at the sheet's scale."""
    program, values = sheet.trace.program, sheet.trace.values
    for number in values:
        kind = component_of(program, number)
        if kind is not None and not program.steps[number].hand and kind.read in values:
            yield from kind.proportions(values, sheet.seconds)


def ray_angles(sheet: VariantSheet, form: Sequence[Item]) -> Iterator[tuple[str, Array]]:
    """The angle in degrees at which the rays to each centre or pole of the form cross."""
    program, margins = sheet.trace.program, sheet.trace.margins
    for item in form:
        number = program.targets.get((item.quantity, item.of), -1)
        if item.what != "place" or number not in sheet.trace.values:
            continue
        sine = margins.get(program.steps[number].by_hand or -1)
        if sine is not None:
            yield item.field, np.degrees(np.arcsin(np.clip(sine, 0.0, 1.0)))
