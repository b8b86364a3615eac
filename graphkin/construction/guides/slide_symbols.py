"""Blocks, guides and slots on the mechanism; those of the frame are hatched."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.paper_canvas import inside
from graphkin.construction.guides.pivot_grounds import ground_ways
from graphkin.construction.guides.rails import (
    ALIKE,
    BEYOND,
    REACH,
    Rail,
    is_swivel,
    places_of,
    rails_of,
    seat,
)
from graphkin.drawing.field import XY, Field, Rect, clipped
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import LineMark, Mark, reach
from graphkin.drawing.symbols import (
    BLOCK,
    PIVOT,
    SLOT,
    across,
    block,
    rails,
    slot,
    slot_ground,
    weld,
)
from graphkin.numbers.arithmetic import Real, larger, pick, smaller
from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME

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
