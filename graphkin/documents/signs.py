"""What is put into free room at last: senses of links' turning, the axes, the scale of a plan.

Each is left out where there is no room for it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, floor, hypot, log10, radians, sin

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import has_plan, scale_of
from graphkin.construction.links.link_numbers import SHARES, Body, body_of, within
from graphkin.drawing.areas import Rect
from graphkin.drawing.field import XY, Field
from graphkin.drawing.free_space import Space
from graphkin.drawing.marks import LineMark, Mark, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.drawing.symbols import head, turned_arrow

ROUND, OPEN = 3.4, 230.0
"""Least radius of a turning arrow in mm, and the angle in degrees at which it ends or begins."""
AIR = 1.0
"""How far a turning arrow stays from all else, in mm."""
NEAR, FARTHER = 0.1, 3.0
"""How much farther from its bar it stands, in mm: as little as can be, or where there is room."""
APART = 3.0
"""The same of the axes and of a scale, in mm."""
AXIS = 9.0
"""Length of the arrows of the axes in mm."""
LONGEST, TICK = 45.0, 1.5
"""The longest bar of a scale, and how high its ticks are, in mm."""
STEPS = {1: 2, 2: 2, 5: 5}
"""Into how many parts a bar is divided, by the first digit of its length."""
HEIGHT = 2.5
"""Height of their lettering in mm."""


def mechanism_signs(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The senses of links' turning and the axes, in the field in which all else is placed."""
    space = Space(marks, field.rect)
    return [*senses(drawing, field, space), *axes(space)]


def plan_signs(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The scale of the plan, in the field in which all else is placed."""
    return [*plan_scale(drawing, Space(marks, field.rect))] if has_plan(drawing) else []


def senses(drawing: Drawing, field: Field, space: Space) -> Iterator[Mark]:
    """A turning arrow about ω or ε beside each link whose rate the sheet finds."""
    driven = {driver.link for driver in drawing.scene.drivers if driver.kind == "turn"}
    for name, link in drawing.scene.links.items():
        rate, body = drawing.turning(name), body_of(drawing, field, link)
        if not rate or body is None or name in driven:
            continue
        text = symbol(f"{drawing.rate.letter}_{name}")
        width, top, bottom = extent(text, HEIGHT)
        radius = max(ROUND, hypot(width, bottom - top) / 2 + 0.7)
        at = space.first([*places_beside(body, radius + AIR)], (0.0, 0.0), radius + AIR)
        if at is not None:
            space.take((at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius))
            yield from sense(at, radius, rate, drawing.kind)
            x, y = at[0] - width / 2, at[1] - (top + bottom) / 2
            yield Text(x, y, text, f"label {drawing.kind}", HEIGHT)


def places_beside(body: Body, off: float) -> Iterator[XY]:
    """Places along a bar on both sides, from its middle on; of a plate first those inside."""
    if body.corners:
        middle = sum(body.corners) / len(body.corners)
        inside = sorted(within(body.corners), key=lambda place: abs(place - middle))
        yield from ((place.real, place.imag) for place in inside)
    for share in SHARES:
        for start, end in body.sides:
            middle, aside = start + share * (end - start), 1j * (end - start) / abs(end - start)
            for far in (off + NEAR, -off - NEAR, off + FARTHER, -off - FARTHER):
                yield (middle + far * aside).real, (middle + far * aside).imag


def sense(at: XY, radius: float, rate: float, kind: str) -> Iterator[Mark]:
    """An open circle with an arrowhead, counter-clockwise for a rate above zero."""
    end, back = (OPEN, -(2 * OPEN - 180)) if rate > 0 else (180 - OPEN, 2 * OPEN - 180)
    way = cos(radians(end)), -sin(radians(end))
    yield from turned_arrow(at, radius, way, (end, back), f"sense {kind}")


def axes(space: Space) -> Iterator[Mark]:
    """The directions of x and y in a free corner."""
    half = AXIS / 2 + 1.5
    at = space.first([*corners(space.rect, half, half)], (half, half), APART)
    if at is None:
        return
    x, y = at[0] - AXIS / 2, at[1] + AXIS / 2
    for name, tip in (("x", (x + AXIS, y)), ("y", (x, y - AXIS))):
        yield LineMark(x, y, *tip, "dimension", "axes")
        yield head((x, y), tip, "dimension", "axes")
        aside = -1.0 if name == "x" else 1.5
        yield Text(tip[0] + 1.0, tip[1] + aside, f"*{name}*", "caption", HEIGHT, name="axes")


def plan_scale(drawing: Drawing, space: Space) -> Iterator[Mark]:
    """The bar of a plan's scale in a free corner, with a round value at its end."""
    words, k = drawing.words, scale_of(drawing, drawing.plane) / 1000
    value, first = round_below(LONGEST * k)
    length, unit = value / k, escape(drawing.vector.unit)
    beyond = extent(unit, HEIGHT)[0] + 3
    half = (length + beyond) / 2 + 1, 3.0
    at = space.first([*corners(space.rect, *half)], half, APART)
    if at is None:
        return
    x, y = at[0] - half[0] + 1, at[1] + 2.5
    yield LineMark(x, y, x + length, y, "dimension", "scale")
    parts = STEPS[first]
    numbers = [words.decimal(f"{value * i / parts:g}") for i in range(parts + 1)]
    wide = max(extent(number, HEIGHT)[0] for number in numbers)
    for i, number in enumerate(numbers):
        along = x + length * i / parts
        yield LineMark(along, y, along, y - TICK, "dimension", "scale")
        if i in (0, parts) or wide + APART / 2 < length / parts:
            yield Text(along, y - TICK - 0.8, number, "caption", HEIGHT, "middle", "scale")
    after = x + length + extent(numbers[-1], HEIGHT)[0] / 2 + 1
    yield Text(after, y - TICK - 0.8, unit, "caption", HEIGHT, name="scale")


def round_below(most: float) -> tuple[float, int]:
    """The largest of 1, 2, 5 times a power of ten up to a value, with its first digit."""
    power = floor(log10(most))
    first = max(digit for digit in STEPS if digit * 10.0**power <= most * (1 + 1e-9))
    return float(f"{first}e{power}"), first


def corners(rect: Rect, wide: float, high: float) -> Iterator[XY]:
    """The middles of boxes in the corners of a field, the lower ones first, then between these."""
    left, top, right, bottom = rect
    low, far = left + wide + APART + 1, right - wide - APART - 1
    for y in (bottom - high - APART - 1, top + high + APART + 1):
        for x in (low, far, (low + far) / 2):
            yield x, y
