"""Centres and poles of many variants that their sheets hold, as arrays; see core.layout."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from graphkin.classroom.lab.drawing_extents import VariantSheet
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.drawn_scene import ENDLESS
from graphkin.construction.core.layout import LEAST, LEAST_FIELD
from graphkin.construction.core.program import Part, Plane
from graphkin.drawing.areas import AREA, HEIGHT, MARGIN, WIDTH
from graphkin.numbers.plane import Ratio

PARTS = {"velocity": Part.CENTRE, "acceleration": Part.POLE}
EDGE = 2.0
"""How far from the edge of its field a centre must lie to be marked in it, in mm."""
Array = Any


def held(sheet: VariantSheet, form: Sequence[Item], kL: Array) -> Iterator[tuple[str, Array]]:
    """Whether the mechanism's field on its sheet holds each place of the form."""
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
    mm = 1000 / kL
    width = shared_width(sheet, mm)
    left, bottom, right, top = grown(sheet, mm, width)
    excess = (top - bottom) * mm - HEIGHT
    for name, value in places.items():
        point = placed(sheet, value)
        x = (point.real - (left + right) / 2) * mm
        y = (point.imag - (bottom + top) / 2) * mm + positive(excess) / 2
        room = (AREA[3] - AREA[1]) / 2
        yield name, (abs(x) <= width / 2 - EDGE) & (abs(y) <= room - EDGE)


def shared_width(sheet: VariantSheet, mm: Array) -> Array:
    """Width of the mechanism's field: each drawing gets what it needs and half of what is left."""
    import numpy as np

    mechanism, plan = sheet.mechanism_box.width * mm, sheet.plan_box.width * mm
    fair = mechanism + 2 * MARGIN + (WIDTH - mechanism - plan) * 0.5
    whole = AREA[2] - AREA[0]
    shared = np.minimum(fair, np.maximum(whole - LEAST, mechanism + 2 * MARGIN))
    return np.minimum(np.maximum(shared, LEAST_FIELD), whole - LEAST_FIELD)


def grown(sheet: VariantSheet, mm: Array, width: Array) -> tuple[Array, Array, Array, Array]:
    """The box of the mechanism, grown by each centre and pole for which the field has room."""
    import numpy as np

    box = sheet.mechanism_box
    sides = box.left, box.bottom, box.right, box.top
    room = width - 1.4 * MARGIN, AREA[3] - AREA[1] - 1.4 * MARGIN
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


def positive(value: Array) -> Array:
    """What of a number is above nought."""
    import numpy as np

    return np.maximum(value, 0.0)
