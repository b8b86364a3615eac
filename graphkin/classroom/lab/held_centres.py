"""Centres and poles of many variants that their sheets hold, as arrays, by the layout's rules."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from typing import Any

from graphkin.classroom.lab.drawing_extents import VariantSheet
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.drawn_scene import ENDLESS
from graphkin.construction.core.layout import held_beside, room_below
from graphkin.construction.core.paper_canvas import WITHIN
from graphkin.construction.core.program import Part, Plane
from graphkin.drawing.areas import AREA
from graphkin.drawing.scale import Extent, Scales
from graphkin.numbers.arithmetic import larger
from graphkin.numbers.arrays import np
from graphkin.numbers.plane import Ratio

PARTS = {"velocity": Part.CENTRE, "acceleration": Part.POLE}
Array = Any


def held(
    sheets: Sequence[VariantSheet], sheet: VariantSheet, form: Sequence[Item], scales: Scales
) -> Iterator[tuple[str, Array]]:
    """Whether the mechanism's field holds each place of the form on a sheet; scales are arrays."""
    asked = [item for item in form if item.what == "place"]
    targets = sheet.trace.program.targets
    places = {
        item.field: sheet.trace.values[number]
        for item in asked
        if (number := targets.get((item.quantity, item.of), -1)) in sheet.trace.values
        and sheet.trace.program.steps[number].part is PARTS[sheet.kind]
    }
    if not places:
        return
    mm = 1000 / scales.kL
    plans = (each.plan_box.width * mm * scales.times(each.kind) for each in sheets)
    box = reduce(Extent.joined, (each.mechanism_box for each in sheets))
    poles = (place for each in sheets for place in poles_of(each))
    field = held_beside(box, poles, mm, reduce(larger, plans))
    left, bottom, right, top = field.box.sides
    height, room = (top - bottom) * mm, AREA[3] - AREA[1]
    lift = room_below(height) + height / 2 - room / 2
    for name, value in places.items():
        point = placed(sheet, value)
        x = (point.real - (left + right) / 2) * mm
        y = (point.imag - (bottom + top) / 2) * mm + lift
        yield name, (abs(x) <= field.width / 2 - WITHIN) & (abs(y) <= room / 2 - WITHIN)


def poles_of(sheet: VariantSheet) -> Iterator[Array]:
    """The centres or poles on a sheet."""
    for step, value in sheet.steps(Plane.MECHANISM):
        if step.part is PARTS[sheet.kind] and isinstance(value, Ratio):
            yield placed(sheet, value)


def placed(sheet: VariantSheet, value: Ratio) -> Array:
    """The point of a centre or pole; NaN at infinity, or as far away as makes no odds."""
    with np.errstate(all="ignore"):
        near = np.abs(value.size) * ENDLESS * sheet.reach > np.abs(value.shift)
        return np.where(near, value.start + value.shift / value.size, np.nan + 0j)
