"""Marks put into free room last: senses of links' rotation, the axes, the scale of a plan.

Each is left out where there is no room for it; senses are then given in words.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, product
from math import cos, floor, hypot, log10, radians, sin
from typing import NamedTuple

from numpy import arange

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import has_plan, scale_of
from graphkin.construction.core.naming import sense as sense_word
from graphkin.construction.drivers.driver_symbols import pivot_of
from graphkin.construction.links.link_shapes import places_of
from graphkin.construction.links.mechanism_symbols import SHARES, Body, body_of, within
from graphkin.construction.result_tables import turning_links
from graphkin.drawing.field import XY, Field, Rect
from graphkin.drawing.free_space import Space
from graphkin.drawing.marks import LineMark, Mark, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.symbol_markup import escape
from graphkin.drawing.symbols import head, turned_arrow
from graphkin.scene.model import FRAME

ROUND, OPEN = 3.4, 230.0
"""Least radius of a turning arrow in mm, and the angle in degrees at which it ends or begins."""
TINY, BESIDE = 2.2, 0.8
"""Radius of an arrow with its letter next to it, and the gap between them, in mm."""
RINGS, WAYS = (0.0, 4.5, 6.0, 8.0, 10.0, 12.5, 15.0, 18.0, 21.0, 25.0), 16
"""Distances from a link, in mm, and number of directions in which its arrow is tried."""
AIR = 1.0
"""Clearance of a turning arrow from everything else, in mm."""
NEAR, FARTHER = 0.1, 3.0
"""Extra distances of an arrow from its bar, in mm: the least, and one where there is room."""
APART = 3.0
"""Clearance of the axes and of a scale, in mm."""
AXIS = 9.0
"""Length of the arrows of the axes in mm."""
LONGEST, TICK = 45.0, 1.5
"""The longest bar of a scale, and the height of its ticks, in mm."""
STEPS = {1: 2, 2: 2, 5: 5}
"""Number of parts of a bar, by the first digit of its length."""
HEIGHT = 2.5
"""Height of their lettering in mm."""


def mechanism_signs(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The senses of links' rotation and the axes, in a field that is otherwise complete."""
    space = Space(marks, field.rect)
    return [*senses(drawing, field, space), *axes(space)]


def plan_signs(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The scale of the plan, in a field that is otherwise complete."""
    return [*plan_scale(drawing, Space(marks, field.rect))] if has_plan(drawing) else []


def senses(drawing: Drawing, field: Field, space: Space) -> Iterator[Mark]:
    """A turning arrow about ω or ε at each link whose rate the sheet gives.

    Arrows are tried next to the bars and in the plates first, with driven links last. An arrow
    without room there is placed where there is room around the link; a long letter then goes next
    to a smaller arrow. A sense without any room is written at the foot of the field.
    """
    driven = {driver.link for driver in drawing.scene.drivers if driver.kind == "turn"}
    shown = known_from_drivers(drawing)
    rates = {
        (link, name): rate
        for link, value in turning_links(drawing)
        if value and link not in shown
        for name, rate in drawing.turnings(link).items()
    }
    bodies = {name: body_of(drawing, field, link) for name, link in drawing.scene.links.items()}
    left = []
    for name, symbol in sorted(rates, key=lambda each: each[0] in driven):
        body, sign = bodies[name], sign_of(drawing, symbol)
        at = None
        if body is not None:
            wheels = wheels_of_others(drawing, field, name)
            beside = places_beside(body, sign.radius + AIR)
            near = (place for place in beside if is_beside(complex(*place), wheels))
            at = space.first(near, (0.0, 0.0), sign.radius + AIR)
        if at is None:
            left.append((name, symbol))
        else:
            yield from sign.put(space, at, rates[name, symbol])
    lost = []
    for name, symbol in left:
        body = bodies[name]
        whole = sign_of(drawing, symbol)
        sides = () if body is None else tuple(places_beside(body, whole.radius + AIR))
        for sign in dict.fromkeys((whole, whole.aside)):
            around = places_around(drawing, field, name, bodies)
            at = space.first(chain(around, sides), sign.half, AIR)
            if at is not None:
                yield from sign.put(space, at, rates[name, symbol])
                break
        else:
            lost.append((name, symbol))
    yield from at_foot(drawing, space, {each[1]: rates[each] for each in lost})


def known_from_drivers(drawing: Drawing) -> set[str]:
    """The links whose rate the arrow of their driver shows.

    These are links on the velocity sheet that turn relative to the frame.
    """
    return {
        driver.link
        for driver in drawing.scene.drivers
        if drawing.kind == "velocity"
        and driver.kind == "turn"
        and driver.against == FRAME
        and pivot_of(drawing, driver) in drawing.positions
    }


class Sign(NamedTuple):
    """A turning arrow with the letter of a rate in it, or next to it where it is ``apart``."""

    text: str
    kind: str
    radius: float
    apart: float = 0.0

    @property
    def aside(self) -> Sign:
        """The sign with its letter next to a small arrow, where that saves room."""
        width = extent(self.text, HEIGHT)[0]
        return self if self.radius <= ROUND else Sign(self.text, self.kind, TINY, width)

    @property
    def half(self) -> XY:
        """Half the sides of the box that it occupies."""
        return self.radius + (self.apart + BESIDE) / 2 if self.apart else self.radius, self.radius

    def put(self, space: Space, at: XY, rate: float) -> Iterator[Mark]:
        """Its marks centred at a place, which is then occupied."""
        (wide, high), (x, y) = self.half, at
        space.take((x - wide, y - high, x + wide, y + high))
        yield from sense((x - wide + self.radius, y), self.radius, rate, self.kind)
        width, top, bottom = extent(self.text, HEIGHT)
        start = x + wide - width if self.apart else x - width / 2
        yield Text(start, y - (top + bottom) / 2, self.text, f"label {self.kind}", HEIGHT)


def sign_of(drawing: Drawing, name: str) -> Sign:
    """The arrow of what turns a link, by its name, with its letter inside."""
    text = drawing.symbol(name)
    width, top, bottom = extent(text, HEIGHT)
    return Sign(text, drawing.kind, max(ROUND, hypot(width, bottom - top) / 2 + 0.7))


def places_around(
    drawing: Drawing, field: Field, name: str, bodies: Mapping[str, Body | None]
) -> Iterator[XY]:
    """Places around a link, the nearest first, outside all other plates and wheels."""
    body = bodies[name]
    anchors = [complex(*field(place)) for place in places_of(drawing, name)]
    discs = [disc for disc in drawing.standing.discs if disc.link == name]
    anchors += [complex(*field(disc.centre)) for disc in discs]
    if body is not None:
        anchors += [p + share * (q - p) for share, (p, q) in product(SHARES, body.sides)]
    others = [each for other, each in bodies.items() if each is not None and other != name]
    wheels = wheels_of_others(drawing, field, name)
    for far, anchor, nth in product(RINGS, dict.fromkeys(anchors), range(WAYS)):
        place = anchor + rect(far, radians(360 / WAYS * nth))
        if is_beside(place, wheels) and not any(other.holds(place) for other in others):
            yield place.real, place.imag


def wheels_of_others(drawing: Drawing, field: Field, name: str) -> list[tuple[complex, float]]:
    """The centres and radii of all other links' wheels, except rings."""
    return [
        (complex(*field(disc.centre)), disc.outer * field.mm)
        for disc in drawing.standing.discs
        if disc.link != name and not disc.wheel.inside
    ]


def is_beside(place: complex, wheels: Sequence[tuple[complex, float]]) -> bool:
    """Whether a place is outside some wheels."""
    return all(abs(place - centre) > radius for centre, radius in wheels)


def at_foot(drawing: Drawing, space: Space, rates: Mapping[str, float]) -> Iterator[Mark]:
    """The senses without room, in words, in one line as low in the field as possible."""
    if not rates:
        return
    words = drawing.words
    colon = words("colon")
    said = (f"{drawing.symbol(n)}{colon}{sense_word(words, r)}" for n, r in rates.items())
    caption = words.clauses(said)
    width, top, bottom = extent(caption, HEIGHT)
    half = width / 2, (bottom - top) / 2
    (left, high, right, low), air = space.rect, AIR + 0.1
    xs = arange(left + half[0] + air, right - half[0] - air, 5.0).tolist()
    ys = arange(low - half[1] - air, high + half[1] + air, -5.0).tolist()
    at = space.first(((x, y) for y in ys for x in xs), half, AIR)
    if at is not None:
        x, y = at[0] - half[0], at[1] - (top + bottom) / 2
        space.take((x, at[1] - half[1], x + width, at[1] + half[1]))
        yield Text(x, y, caption, "caption", HEIGHT, name="senses")


def places_beside(body: Body, off: float) -> Iterator[XY]:
    """Places along a bar on both sides, from its middle on; in a plate the inside comes first."""
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
    """An open circle with an arrowhead, counter-clockwise for a positive rate."""
    end, back = (OPEN, -(2 * OPEN - 180)) if rate > 0 else (180 - OPEN, 2 * OPEN - 180)
    way = cos(radians(end)), -sin(radians(end))
    yield from turned_arrow(at, radius, way, (end, back), f"sense {kind}")


def axes(space: Space) -> Iterator[Mark]:
    """The directions of x and y in a free corner."""
    half = AXIS / 2 + 1.5
    at = space.first(corners(space.rect, half, half), (half, half), APART)
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
    length, unit = value / k, escape(words.unit(drawing.unit))
    beyond = extent(unit, HEIGHT)[0] + 3
    half = (length + beyond) / 2 + 1, 3.0
    at = space.first(corners(space.rect, *half), half, APART)
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
    """The largest number 1, 2 or 5 times a power of ten up to a value, with its first digit."""
    power = floor(log10(most))
    first = max(digit for digit in STEPS if digit * 10.0**power <= most * (1 + 1e-9))
    return float(f"{first}e{power}"), first


def corners(rect: Rect, wide: float, high: float) -> Iterator[XY]:
    """The middles of boxes in the corners of a field, lower ones first, then in between."""
    left, top, right, bottom = rect
    low, far = left + wide + APART + 1, right - wide - APART - 1
    for y in (bottom - high - APART - 1, top + high + APART + 1):
        for x in (low, far, (low + far) / 2):
            yield x, y
