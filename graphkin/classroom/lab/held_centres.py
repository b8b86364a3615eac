"""Centres and poles of many variants that their sheets hold, as arrays; see core.layout."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from graphkin.classroom.lab.drawing_extents import VariantSheet
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.lab.variant_scales import Scaling
from graphkin.construction.core.drawn_scene import ENDLESS
from graphkin.construction.core.layout import GROUND, POLES
from graphkin.construction.core.program import Part, Plane
from graphkin.drawing.areas import ABOVE, AREA, HEIGHT, LEAST_FIELD, MARGIN
from graphkin.numbers.plane import Ratio

PARTS = {"velocity": Part.CENTRE, "acceleration": Part.POLE}
EDGE = 2.0
"""How far from the edge of its field a centre must lie to be marked in it, in mm."""
Array = Any
Sides = tuple[Array, ...]
"""Left, bottom, right and top."""


def held(
    sheets: Sequence[VariantSheet], sheet: VariantSheet, form: Sequence[Item], scales: Scaling
) -> Iterator[tuple[str, Array]]:
    """Whether the mechanism's field holds each place of the form on a sheet."""
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
    (left, bottom, right, top), width = field_of(sheets, scales, mm)
    lift = raised((top - bottom) * mm)
    for name, value in places.items():
        point = placed(sheet, value)
        x = (point.real - (left + right) / 2) * mm
        y = (point.imag - (bottom + top) / 2) * mm + lift
        room = (AREA[3] - AREA[1]) / 2
        yield name, (abs(x) <= width / 2 - EDGE) & (abs(y) <= room - EDGE)


def field_of(sheets: Sequence[VariantSheet], scales: Scaling, mm: Array) -> tuple[Sides, Array]:
    """The box of the mechanism with its centres and poles, and the width of its field; in layout
    placed is the same.
    """
    import numpy as np

    every = [each.mechanism_box for each in sheets]
    sides: Sides = (
        np.min([box.left for box in every], axis=0),
        np.min([box.bottom for box in every], axis=0),
        np.max([box.right for box in every], axis=0),
        np.max([box.top for box in every], axis=0),
    )
    plans = [each.plan_box.width * mm * scales.times(each.kind) for each in sheets]
    whole = AREA[2] - AREA[0]
    most = whole - np.maximum(np.max(plans, axis=0) + 2 * MARGIN, LEAST_FIELD)
    most = np.maximum(most, LEAST_FIELD)
    own = (sides[2] - sides[0]) * mm + 2 * MARGIN
    sides = grown(sheets, sides, mm, most)
    width = np.maximum(own, (sides[2] - sides[0]) * mm + POLES)
    return sides, np.minimum(np.maximum(width, LEAST_FIELD), most)


def grown(sheets: Sequence[VariantSheet], sides: Sides, mm: Array, width: Array) -> Sides:
    """The box of the mechanism, grown by each centre and pole for which a field has room."""
    import numpy as np

    room = width - POLES, AREA[3] - AREA[1] - POLES
    for sheet in sheets:
        for step, value in sheet.steps(Plane.MECHANISM):
            if step.part is not PARTS[sheet.kind] or not isinstance(value, Ratio):
                continue
            point = placed(sheet, value)
            left, bottom = np.fmin(sides[0], point.real), np.fmin(sides[1], point.imag)
            right, top = np.fmax(sides[2], point.real), np.fmax(sides[3], point.imag)
            fits = ((right - left) * mm <= room[0]) & ((top - bottom) * mm <= room[1])
            wider = zip((left, bottom, right, top), sides, strict=True)
            sides = tuple(np.where(fits, new, old) for new, old in wider)
    return sides


def placed(sheet: VariantSheet, value: Ratio) -> Array:
    """The point of a centre or pole; NaN at infinity, or as far away as makes no odds."""
    import numpy as np

    with np.errstate(all="ignore"):
        near = np.abs(value.size) * ENDLESS * sheet.reach > np.abs(value.shift)
        return np.where(near, value.start + value.shift / value.size, np.nan + 0j)


def raised(height: Array) -> Array:
    """How far above the middle of its field the middle of a drawing stands; as layout raised."""
    import numpy as np

    spare = np.maximum(HEIGHT - height, 0.0)
    below = ABOVE + np.maximum(spare / 2, np.minimum(spare, GROUND - ABOVE))
    return below + height / 2 - (AREA[3] - AREA[1]) / 2
