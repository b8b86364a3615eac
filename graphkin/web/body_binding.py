"""How guides and blocks follow: each mark is told by making it again as paper does."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphkin.construction.core.bodies import Guideway
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.guides.slide_symbols import (
    BEYOND,
    REACH,
    STROKE,
    Rail,
    clear_of_pivots,
    guide_bar,
    is_swivel,
    merged,
    places_of,
    rails_of,
    seat,
    slot_ends,
    within,
)
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Polyline
from graphkin.drawing.symbols import BLOCK, block, rails, slot
from graphkin.numbers.arithmetic import larger, smaller
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME
from graphkin.web.field_binder import SPACING, Binding, FieldBinder, Told, still
from graphkin.web.profile_binding import of_edges
from graphkin.web.traced_poses import BodyPose
from graphkin.web.wheel_binding import of_touch, of_wheel

NEAR = 1e-9
"""Metres or millimetres that are rounding."""


def told(binder: FieldBinder) -> Told:
    """The bindings of what stands for guides, blocks, wheels and profiles."""
    found = of_edges(binder)
    for disc in binder.places.drawing.standing.discs:
        found.update(of_wheel(binder, disc))
    for touch in binder.places.drawing.standing.touches:
        found.update(of_touch(binder, touch))
    for rail in rails_of(binder.places.drawing):
        found.update(of_frame_rail(binder, rail) if rail.owner == FRAME else of_rail(binder, rail))
    for way in binder.places.drawing.standing.guideways:
        found.update(of_block(binder, way))
    return found


# --- guides --------------------------------------------------------------------------------------


def ways_on(drawing: Drawing, rail: Rail, *, pins: bool) -> list[tuple[Guideway, float]]:
    """The sliding pairs of a rail, each with its coordinate along it, in metres."""
    near, found = 1e-6 * drawing.standing.size, []
    for way in drawing.standing.guideways:
        owner = way.block if is_swivel(drawing, way.slide) else way.slide.on
        if owner == rail.owner and bool(way.slide.pin) is pins:
            place = way.at if pins else seat(drawing, way)
            if abs(cross(rail.along, place - rail.zero)) < near:
                found.append((way, rail.along_of(place)))
    return found


def line_of(binder: FieldBinder, rail: Rail) -> tuple[Any, Any]:
    """The zero and the direction of a rail while it moves."""
    places = binder.places
    return places.carried(rail.owner, rail.zero), places.turned(rail.owner, rail.along)


def coordinates(binder: FieldBinder, rail: Rail, *, pins: bool) -> list[tuple[Any, float]]:
    """Where what slides on a rail stands along it while it moves, and where it was drawn."""
    places, found = binder.places, []
    zero, along = line_of(binder, rail)
    for way, drawn in ways_on(places.drawing, rail, pins=pins):
        place = places.positions[places.drawing.scene.links[way.block].points[0]]
        place = place if pins else places.seat(way)
        found.append((dot(place - zero, along), drawn))
    return found


def of_frame_rail(binder: FieldBinder, rail: Rail) -> Told:
    """A guide of the frame: its drawn part goes along with its block, its strokes stay."""
    drawing, field = binder.places.drawing, binder.field
    at, way = field(rail.zero), field.way(rail.along)
    found: Told = {}
    known = coordinates(binder, rail, pins=False)
    parts = {clear_of_pivots(drawing, field, rail, d * field.mm): m for m, d in known}
    drawn = list(merged(parts))
    for low, high in drawn:
        marks = list(within(rails(at, way, low, high), field.rect))
        if (low, high) in parts:
            moving = parts[low, high] * field.mm
            now = float(binder.tape.now(moving))
            span = clear_of_pivots(drawing, field, rail, moving)
            found.update(of_sides(binder, rail, marks, span, moving - now))
    for moved, middle in coordinates(binder, rail, pins=True):
        name = next(name for c, name in rail.slots if abs(c - middle) < NEAR)
        ends = middle * field.mm - STROKE, middle * field.mm + STROKE
        mark = slot(at, way, *ends, name)
        found[mark] = stretched(binder, BodyPose(rail.zero, rail.along), ends, moved * field.mm)
    return found


def of_sides(
    binder: FieldBinder, rail: Rail, marks: list[Mark], span: tuple[Any, Any], moved: Any
) -> Iterator[tuple[Mark, Binding]]:
    """Both sides of a guide of the frame, and the strokes outside them."""
    at, way = complex(*binder.field(rail.zero)), complex(*binder.field.way(rail.along))
    half, rect = BLOCK[1] / 2, binder.room
    rest = moved - (moved * (1 / SPACING)).do("round") * SPACING
    strokes = binder.on(BodyPose(at + way * (moved - rest), binder.tape.lifted(1 + 0j)))
    for mark in marks:
        if isinstance(mark, LineMark) and mark.cls == "guide":
            side = ((complex(mark.x1, mark.y1) - at) * way.conjugate()).imag
            ends = [at + way * (end + 1j * (half if side > 0 else -half)) for end in span]
            first, last = ends if side > 0 else ends[::-1]
            yield mark, binder.joining(first, last, rect)
        else:
            yield mark, strokes


def stretched(binder: FieldBinder, pose: BodyPose, ends: tuple[float, float], at: Any) -> Binding:
    """A slot of a body, drawn longer where its pin goes beyond it; ``ends`` are in mm."""
    low, high = smaller(at, ends[0]), larger(at, ends[1])
    page = binder.pose(pose)
    poses = [BodyPose(page.origin + page.way * end, page.way) for end in (high, low)]
    if all(binder.is_constant(part) for each in poses for part in each):
        return still

    def bound(mark: Mark) -> list[Any]:
        assert isinstance(mark, Polyline)
        half = len(mark.points) // 2
        found: list[Any] = ["x", -1]
        for i, point in enumerate(mark.points):
            dot_ = CircleMark(*point, 1.0, "")
            found += binder.rigid(dot_, poses[0 if i < half else 1], None)[2:]
        return found

    return bound


def of_rail(binder: FieldBinder, rail: Rail) -> Told:
    """A line of a moving link on which blocks slide: as long as they need it, with its slots."""
    places, field = binder.places, binder.field
    drawing, mm = places.drawing, field.mm
    near = 1e-6 * drawing.standing.size
    owned = places_of(drawing, rail.owner)
    on = [rail.along_of(p) for p in owned if abs(cross(rail.along, p - rail.zero)) < near]
    zero, along = line_of(binder, rail)
    carried = binder.carried_by(places.pose(rail.owner))
    found: Told = {}
    ends: list[Any] = [binder.tape.lifted(c) for c in on]
    slots = []
    for moved, drawn in coordinates(binder, rail, pins=True):
        low, high = slot_ends(field, drawn, on)
        ends += [smaller(moved, low), larger(moved, high)]
        mark = slot(field(rail.zero), field.way(rail.along), low * mm, high * mm, rail.owner)
        slots.append(
            (mark, stretched(binder, BodyPose(zero, along), (low * mm, high * mm), moved * mm))
        )
    pad = BEYOND / mm if on or rail.slots else REACH / mm
    for moved, _ in coordinates(binder, rail, pins=False):
        ends += [moved - pad, moved + pad]
    whole = list(within(guide_bar(drawing, field, rail), field.rect))
    bars = [mark for mark in whole if isinstance(mark, LineMark)]
    now = [float(binder.tape.now(end)) for end in ends]
    ends += [binder.tape.lifted(c) for c in joined(binder, rail, owned, on, now)]
    low, high = ends[0], ends[0]
    for end in ends[1:]:
        low, high = smaller(low, end), larger(high, end)
    for mark in whole:
        found[mark] = carried
    if bars:
        found[bars[-1]] = binder.between(zero + along * low, zero + along * high, binder.room)
    return found | dict(slots)


def joined(
    binder: FieldBinder, rail: Rail, owned: list[complex], on: list[float], now: list[float]
) -> list[float]:
    """Where an arm from the link meets its line, if the line is drawn as far as there."""
    if on or not owned:
        return []
    low, high = min(now), max(now)

    def off(point: complex) -> float:
        return abs(point - rail.at(min(max(rail.along_of(point), low), high)))

    coordinate = rail.along_of(min(owned, key=off))
    far = abs(coordinate - (low + high) / 2) * binder.field.mm
    return [] if far > 4 * REACH else [coordinate]


def of_block(binder: FieldBinder, way: Guideway) -> Told:
    """A block with the arm to its point."""
    if way.slide.pin:
        return {}
    places, field = binder.places, binder.field
    drawing, along = places.drawing, places.along(way)
    middle, moving = seat(drawing, way), places.seat(way)
    here, turned = field(middle), field.way(way.along)
    carried = binder.carried_by(BodyPose(moving, along))
    if way.slide.on == FRAME:
        return {block(here, turned, way.block, "slider"): carried}
    owner = way.slide.on if is_swivel(drawing, way.slide) else way.block
    name = drawing.scene.link(owner).points[0]
    own = drawing.positions[name]
    arm = LineMark(*here, *field(own), "guide-bar", owner)
    return {
        arm: binder.between(moving, places.positions[name]),
        block(here, turned, owner): carried,
    }
