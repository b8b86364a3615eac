"""Blocks, guides and slots on the mechanism; those of the frame are hatched.

The side of each fixed pivot's pin on which its ground is drawn: the side with most room.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from itertools import combinations
from math import hypot, sqrt

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.paper_canvas import inside
from graphkin.construction.links.link_shapes import (
    ALIKE,
    BEYOND,
    REACH,
    Rail,
    is_swivel,
    places_of,
    rails_of,
    seat,
    swivelling,
)
from graphkin.drawing.field import XY, Field, Rect, clipped
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import LineMark, Mark, reach
from graphkin.drawing.symbols import (
    BLOCK,
    HATCH,
    HIP,
    PIN,
    PIVOT,
    SLOT,
    STRIP,
    TALL,
    across,
    block,
    rails,
    slot,
    slot_ground,
    weld,
)
from graphkin.numbers.arithmetic import Real, larger, pick, smaller
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME

Segment = tuple[complex, complex]
Ground = tuple[complex, float]
"""The unit vector from a fixed pivot to its ground, and the height of its triangle in mm."""

HALFWAY = sqrt(0.5)
WAYS = {
    -1j: 0.0,
    1 + 0j: 0.4,
    -1 + 0j: 0.4,
    1j: 0.8,
    HALFWAY * (1 - 1j): 1.2,
    HALFWAY * (-1 - 1j): 1.2,
    HALFWAY * (1 + 1j): 1.6,
    HALFWAY * (-1 + 1j): 1.6,
}
"""The directions of a ground from its pin, and the cost of each, in mm of clearance."""
AIR = 2.5
"""Required clearance of a ground from the marks at its pin, in mm."""
RAIL = BLOCK[1] / 2 + HATCH
"""Half the width of a guide of the frame, in mm."""
SAME = 1e-6
"""Distance of two places, in sizes of the mechanism, at which they are the same."""
RAY = 17.0
"""Drawn length, from its pin, of the axis from which a crank's angle is measured, in mm."""
NEAR = hypot(TALL + HATCH / 2, STRIP + HIP * (TALL - PIVOT)) + AIR
"""Distance from its pin within which a mark may collide with the ground, in mm."""
RAISED = 1.0
"""Cost of a tall ground, in mm of clearance: a bar past the pin would cross its triangle."""


def ground_ways(drawing: Drawing, mm: float) -> dict[str, complex]:
    """The direction from each fixed pivot to its ground."""
    return {name: way for name, (way, _) in grounds_of(drawing, mm).items()}


def grounds_of(drawing: Drawing, mm: float) -> dict[str, Ground]:
    """The ground of each fixed pivot, kept while the mechanism moves.

    ``mm`` is the millimetres of paper for a metre.
    """
    still = drawing.choosing
    if mm not in still.grounds:
        still.grounds[mm] = chosen(still, mm)
    return still.grounds[mm]


def chosen(drawing: Drawing, mm: float) -> dict[str, Ground]:
    """The ground of each pivot with most room; down and low among equals."""
    drawn, found = [*segments(drawing, mm)], {}
    for name, here in pivots(drawing).items():
        lines = (((p - here) * mm, (q - here) * mm) for p, q in drawn)
        near = [line for line in lines if away_from(0j, line) < NEAR]
        heights = {TALL: 0.0} if is_covered(drawing, here, mm) else {PIVOT: 0.0, TALL: RAISED}
        costs = {
            (way, height): cost + raised + crowding(near, way, height)
            for height, raised in heights.items()
            for way, cost in WAYS.items()
        }
        found[name] = min(costs, key=costs.__getitem__)
    return found


def pivots(drawing: Drawing) -> dict[str, complex]:
    """The points of the frame that moving links share."""
    moving = {point for link in drawing.scene.links.values() for point in link.points}
    return {
        name: drawing.positions[name]
        for name in drawing.scene.fixed_points
        if name in moving and name in drawing.positions
    }


def is_covered(drawing: Drawing, here: complex, mm: float) -> bool:
    """Whether a block turns about a pivot's pin, judged at the position where places are chosen."""
    return any(abs(place - here) * mm < PIN for place in swivelling(drawing.choosing))


def segments(drawing: Drawing, mm: float) -> Iterator[Segment]:
    """The bars, sides of plates, guides, and axes from which crank angles are measured."""
    for link in drawing.scene.links:
        yield from combinations(places_of(drawing, link), 2)
    for rail in rails_of(drawing):
        if rail.owner == FRAME:
            for mark in rail.marks:
                low, high = (rail.at(mark + side * REACH / mm) for side in (-1, 1))
                for aside in (-RAIL, 0.0, RAIL):
                    yield low + 1j * rail.along * aside / mm, high + 1j * rail.along * aside / mm
        else:
            ends = [mark + side * BEYOND / mm for mark in rail.marks for side in (-1, 1)]
            ends += [rail.along_of(place) for place in places_of(drawing, rail.owner)]
            yield rail.at(min(ends)), rail.at(max(ends))
    for driver in drawing.scene.drivers:
        start = (driver.of or drawing.scene.links[driver.link].points)[0]
        base = drawing.standing.axis(driver.against)
        if driver.kind == "turn" and base is not None and start in drawing.positions:
            yield drawing.positions[start], drawing.positions[start] + base * RAY / mm


def crowding(near: Sequence[Segment], way: complex, height: float) -> float:
    """The clearance that a ground lacks from lines near its pin, in mm."""
    middle, half = way * (height + HATCH / 2), 1j * way * (STRIP + HIP * (height - PIVOT))
    ground = middle - half, middle + half
    return sum(max(0.0, AIR - apart(ground, line)) for line in near)


def apart(one: Segment, other: Segment) -> float:
    """The distance between two segments; less than zero where they cross."""
    (a, b), (c, d) = one, other
    sides = cross(b - a, c - a) * cross(b - a, d - a), cross(d - c, a - c) * cross(d - c, b - c)
    if max(sides) < 0:
        return -AIR
    return min(
        *(away_from(place, one) for place in other), *(away_from(place, other) for place in one)
    )


def away_from(place: complex, line: Segment) -> float:
    """The distance of a place from a segment."""
    start, along = line[0] - place, line[1] - line[0]
    square = abs(along) ** 2
    share = min(max(-dot(start, along) / square, 0.0), 1.0) if square else 0.0
    return abs(start + share * along)


LEAST = 7.0
"""Half the length of a guide in a narrow space, in mm."""
AWAY = 8.0
"""Distance of a frame guide from the middle of a fixed pivot, in mm."""
STROKE = 13.0
"""Half the length of a drawn slot, in mm."""
CLEAR = 4.0
"""Distance from a slot's end to a pin of its bar, in mm."""


def draw_frame_guides(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the hatched sides of the frame's guides and slots, and the blocks between them."""
    for _, marks in frame_guides(drawing, field):
        board.marks += marks
    for guideway in drawing.standing.guideways:
        slide = guideway.slide
        if slide.on == FRAME and not slide.pin and not slide.rollers:
            here, way = field(seat(drawing, guideway)), field.way(guideway.along)
            board.marks.append(block(here, way, guideway.block, "slider"))


def between_rails(drawing: Drawing, name: str) -> bool:
    """Whether a pin is that of a block between the hatched sides of a guide of the frame.

    It is judged at the position where places are chosen.
    """
    still = drawing.choosing
    return any(
        way.slide.on == FRAME
        and not (way.slide.pin or way.slide.rollers)
        and abs(seat(still, way) - still.positions[name]) < still.reach * SAME
        for way in still.standing.guideways
    )


def frame_guides(drawing: Drawing, field: Field) -> Iterator[tuple[list[str], list[Mark]]]:
    """The drawn parts of the frame's guides and slots, each with the names of its blocks."""
    for rail in rails_of(drawing):
        if rail.owner != FRAME:
            continue
        at, way = field(rail.zero), field.way(rail.along)
        parts = [clear_of_pivots(drawing, field, rail, mark * field.mm) for mark in rail.marks]
        for low, high in merged(parts):
            own = zip(rail.blocks, parts, strict=True)
            about = [name for name, part in own if low <= part[0] and part[1] <= high]
            yield about, list(within(rails(at, way, low, high), field.rect))
        for coordinate, name in rail.slots:
            low, high = coordinate * field.mm - STROKE, coordinate * field.mm + STROKE
            ground = within(slot_ground(at, way, low, high), field.rect)
            yield [name], [*ground, slot(at, way, low, high, name)]


def clear_of_pivots(drawing: Drawing, field: Field, rail: Rail, middle: Real) -> tuple[Real, Real]:
    """The part of a guide about a block, in mm, shortened at a fixed pivot."""
    low, high, (x, y) = middle - REACH, middle + REACH, field(rail.zero)
    u, v = field.way(rail.along)
    for name, ground in ground_ways(drawing, field.mm).items():
        at = field(drawing.positions[name])
        dx, dy = at[0] - x + PIVOT / 2 * ground.real, at[1] - y - PIVOT / 2 * ground.imag
        along, aside = dx * u + dy * v, dy * u - dx * v
        if abs(aside) < AWAY:
            beyond = along > middle
            shorter = larger(smaller(high, along - AWAY), middle + LEAST)
            later = smaller(larger(low, along + AWAY), middle - LEAST)
            low, high = pick(beyond, low, later), pick(beyond, shorter, high)
    return low, high


def merged(parts: Iterable[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    """The drawn parts of a guide, with overlapping ones merged."""
    ends = sorted(parts)
    while ends:
        low, high = ends.pop(0)
        while ends and ends[0][0] < high + 2:
            high = max(high, ends.pop(0)[1])
        yield low, high


def draw_guide_bars(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the bars and slots of moving links on which blocks slide, fixed to their links."""
    for rail in rails_of(drawing):
        if rail.owner != FRAME:
            board.marks += within(guide_bar(drawing, field, rail), field.rect)


def guide_bar(drawing: Drawing, field: Field, rail: Rail) -> Iterator[Mark]:
    """One line of a moving link: its bar, the corner where it joins the link, its slots."""
    places = places_of(drawing, rail.owner)
    near = ALIKE * drawing.standing.size
    on = [rail.along_of(p) for p in places if abs(cross(rail.along, p - rail.zero)) < near]
    slots = [slot_ends(field, coordinate, on) for coordinate, _ in rail.slots]
    pads = [BEYOND / field.mm if on or rail.slots else REACH / field.mm] * len(rail.marks)
    ends = [*on, *(end for part in slots for end in part)]
    for mark, pad in zip(rail.marks, pads, strict=True):
        ends += [mark - pad, mark + pad]
    if not on and places:
        yield from joint(field, rail, min(places, key=lambda p: off(rail, p, ends)), ends)
    low, high = reduce(smaller, ends), reduce(larger, ends)
    yield LineMark(*field(rail.at(low)), *field(rail.at(high)), "guide-bar", rail.owner)
    at, way = field(rail.zero), field.way(rail.along)
    for low, high in slots:
        yield slot(at, way, low * field.mm, high * field.mm, rail.owner)


def slot_ends(field: Field, coordinate: float, on: list[float]) -> tuple[float, float]:
    """The part of a bar that a slot takes: about its pin, clear of the bar's own points."""
    low, high = coordinate - STROKE / field.mm, coordinate + STROKE / field.mm
    clear, least = CLEAR / field.mm, 2 * SLOT / field.mm
    for point in on:
        is_before = (low - clear < point) & (point < coordinate - least)
        is_after = (coordinate + least < point) & (point < high + clear)
        low, high = pick(is_before, point + clear, low), pick(is_after, point - clear, high)
    return smaller(low, coordinate), larger(high, coordinate)


def off(rail: Rail, point: complex, ends: list[float]) -> float:
    """The distance of a point from the drawn part of a line."""
    return abs(point - rail.at(nearest(rail.along_of(point), ends)))


def nearest(coordinate: float, ends: list[float]) -> float:
    """The coordinate on the drawn part of a line that is nearest to a given one."""
    beyond = larger(coordinate, reduce(smaller, ends))
    return smaller(beyond, reduce(larger, ends))  # type: ignore[no-any-return]


def joint(field: Field, rail: Rail, point: complex, ends: list[float]) -> Iterator[Mark]:
    """The arm from a link's point to its guide, and the filled corner between the two."""
    coordinate = rail.along_of(point)
    middle = (reduce(smaller, ends) + reduce(larger, ends)) / 2
    is_far = abs(coordinate - middle) * field.mm > 4 * REACH
    coordinate = pick(is_far, nearest(coordinate, ends), coordinate)
    ends.append(coordinate)
    foot, here = field(rail.at(coordinate)), field(point)
    yield LineMark(*here, *foot, "guide-bar", rail.owner)
    if abs(point - rail.at(coordinate)) * field.mm > BLOCK[1]:
        inward = (reduce(smaller, ends) + reduce(larger, ends)) / 2 - coordinate
        way = field.way(rail.along * pick(inward >= 0, 1, -1))
        yield weld(foot, way, field.way(point - rail.at(coordinate)), rail.owner)


def draw_blocks(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the blocks that slide on moving links, each with an arm to its point if needed."""
    for way in drawing.standing.guideways:
        if way.slide.on == FRAME or way.slide.pin or way.slide.rollers:
            continue
        swivel = is_swivel(drawing, way.slide)
        owner = way.slide.on if swivel else way.block
        middle = seat(drawing, way)
        own = drawing.positions[drawing.scene.link(owner).points[0]]
        here, point, along = field(middle), field(own), field.way(way.along)
        if abs(own - middle) * field.mm > BLOCK[1] / 2:
            board.marks.append(LineMark(*here, *point, "guide-bar", owner))
        board.marks.append(block(here, along, owner))


def covered(loci: Sequence[Mark], marks: Sequence[Mark]) -> list[Mark]:
    """The lines and arcs of steps near a block, which the block would hide in the middle."""
    blocks = [reach(mark) for mark in marks if mark.cls in ("block", "slider")]
    return [m for m in loci if m.step is not None and any(overlap(reach(m), b) for b in blocks)]


def overlap(one: Rect, other: Rect) -> bool:
    """Whether two upright boxes overlap or touch."""
    across = one[0] <= other[2] and other[0] <= one[2]
    return across and one[1] <= other[3] and other[1] <= one[3]


def within(marks: Iterable[Mark], rect: Rect) -> Iterator[Mark]:
    """Marks clipped inside a field; strokes of hatching are kept whole or dropped."""
    inner = inside(rect)
    for mark in marks:
        if not isinstance(mark, LineMark):
            yield mark
            continue
        ends = (mark.x1, mark.y1), (mark.x2, mark.y2)
        part = clipped(*ends, inner)
        if part and (part == ends or mark.cls != "ground"):
            (x1, y1), (x2, y2) = part
            yield replace(mark, x1=x1, y1=y1, x2=x2, y2=y2)


def number_side(drawing: Drawing, field: Field, link: str) -> tuple[XY, XY] | None:
    """The side of a link's rectangle or slot pin at which its number is drawn."""
    for way in drawing.standing.guideways:
        owner = way.slide.on if is_swivel(drawing, way.slide) else way.block
        if owner == link:
            here, along = field(seat(drawing, way)), field.way(way.along)
            half = SLOT if way.slide.pin else BLOCK[1] / 2
            return across(here, along, -3, -half), across(here, along, 3, -half)
    return None
