"""How guides and blocks follow: each mark is told by making it again as paper does."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphkin.arithmetic import larger, smaller
from graphkin.paper.bodies import Guideway
from graphkin.paper.drawing import Drawing
from graphkin.paper.marks import Circle, Line, Mark, Polyline
from graphkin.paper.slides import (
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
from graphkin.paper.symbols import BLOCK, block, rails, slot
from graphkin.plane import cross, dot
from graphkin.scene.model import FRAME
from graphkin.screen.binding import SPACING, Bench, Binding, Told, still
from graphkin.screen.edges import of_edges
from graphkin.screen.poses import Pose
from graphkin.screen.rolling import of_touch, of_wheel

NEAR = 1e-9
"""Metres or millimetres that are rounding."""


def told(bench: Bench) -> Told:
    """The bindings of what stands for guides, blocks, wheels and profiles."""
    found = of_edges(bench)
    for disc in bench.places.drawing.standing.discs:
        found.update(of_wheel(bench, disc))
    for touch in bench.places.drawing.standing.touches:
        found.update(of_touch(bench, touch))
    for rail in rails_of(bench.places.drawing):
        found.update(of_frame_rail(bench, rail) if rail.owner == FRAME else of_rail(bench, rail))
    for way in bench.places.drawing.standing.guideways:
        found.update(of_block(bench, way))
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


def line_of(bench: Bench, rail: Rail) -> tuple[Any, Any]:
    """The zero and the direction of a rail while it moves."""
    places = bench.places
    return places.carried(rail.owner, rail.zero), places.turned(rail.owner, rail.along)


def coordinates(bench: Bench, rail: Rail, *, pins: bool) -> list[tuple[Any, float]]:
    """Where what slides on a rail stands along it while it moves, and where it was drawn."""
    places, found = bench.places, []
    zero, along = line_of(bench, rail)
    for way, drawn in ways_on(places.drawing, rail, pins=pins):
        place = places.positions[places.drawing.scene.links[way.block].points[0]]
        place = place if pins else places.seat(way)
        found.append((dot(place - zero, along), drawn))
    return found


def of_frame_rail(bench: Bench, rail: Rail) -> Told:
    """A guide of the frame: its drawn part goes along with its block, its strokes stay."""
    drawing, field = bench.places.drawing, bench.field
    at, way = field(rail.zero), field.way(rail.along)
    found: Told = {}
    known = coordinates(bench, rail, pins=False)
    parts = {clear_of_pivots(drawing, field, rail, d * field.mm): m for m, d in known}
    drawn = list(merged(parts))
    for low, high in drawn:
        marks = list(within(rails(at, way, low, high), field.rect))
        if (low, high) in parts:
            moving = parts[low, high] * field.mm
            now = float(bench.shelf.now(moving))
            span = clear_of_pivots(drawing, field, rail, moving)
            found.update(of_sides(bench, rail, marks, span, moving - now))
    for moved, middle in coordinates(bench, rail, pins=True):
        name = next(name for c, name in rail.slots if abs(c - middle) < NEAR)
        ends = middle * field.mm - STROKE, middle * field.mm + STROKE
        mark = slot(at, way, *ends, name)
        found[mark] = stretched(bench, Pose(rail.zero, rail.along), ends, moved * field.mm)
    return found


def of_sides(
    bench: Bench, rail: Rail, marks: list[Mark], span: tuple[Any, Any], moved: Any
) -> Iterator[tuple[Mark, Binding]]:
    """Both sides of a guide of the frame, and the strokes outside them."""
    at, way = complex(*bench.field(rail.zero)), complex(*bench.field.way(rail.along))
    half, rect = BLOCK[1] / 2, bench.room
    rest = moved - (moved * (1 / SPACING)).do("round") * SPACING
    strokes = bench.on(Pose(at + way * (moved - rest), bench.shelf.lifted(1 + 0j)))
    for mark in marks:
        if isinstance(mark, Line) and mark.cls == "guide":
            side = ((complex(mark.x1, mark.y1) - at) * way.conjugate()).imag
            ends = [at + way * (end + 1j * (half if side > 0 else -half)) for end in span]
            first, last = ends if side > 0 else ends[::-1]
            yield mark, bench.joining(first, last, rect)
        else:
            yield mark, strokes


def stretched(bench: Bench, pose: Pose, ends: tuple[float, float], at: Any) -> Binding:
    """A slot of a body, drawn longer where its pin goes beyond it; ``ends`` are in mm."""
    low, high = smaller(at, ends[0]), larger(at, ends[1])
    page = bench.pose(pose)
    poses = [Pose(page.origin + page.way * end, page.way) for end in (high, low)]
    if all(bench.is_constant(part) for each in poses for part in each):
        return still

    def bound(mark: Mark) -> list[Any]:
        assert isinstance(mark, Polyline)
        half = len(mark.points) // 2
        found: list[Any] = ["x", -1]
        for i, point in enumerate(mark.points):
            dot_ = Circle(*point, 1.0, "")
            found += bench.rigid(dot_, poses[0 if i < half else 1], None)[2:]
        return found

    return bound


def of_rail(bench: Bench, rail: Rail) -> Told:
    """A line of a moving link on which blocks slide: as long as they need it, with its slots."""
    places, field = bench.places, bench.field
    drawing, mm = places.drawing, field.mm
    near = 1e-6 * drawing.standing.size
    owned = places_of(drawing, rail.owner)
    on = [rail.along_of(p) for p in owned if abs(cross(rail.along, p - rail.zero)) < near]
    zero, along = line_of(bench, rail)
    carried = bench.carried_by(places.pose(rail.owner))
    found: Told = {}
    ends: list[Any] = [bench.shelf.lifted(c) for c in on]
    slots = []
    for moved, drawn in coordinates(bench, rail, pins=True):
        low, high = slot_ends(field, drawn, on)
        ends += [smaller(moved, low), larger(moved, high)]
        mark = slot(field(rail.zero), field.way(rail.along), low * mm, high * mm, rail.owner)
        slots.append((mark, stretched(bench, Pose(zero, along), (low * mm, high * mm), moved * mm)))
    pad = BEYOND / mm if on or rail.slots else REACH / mm
    for moved, _ in coordinates(bench, rail, pins=False):
        ends += [moved - pad, moved + pad]
    whole = list(within(guide_bar(drawing, field, rail), field.rect))
    bars = [mark for mark in whole if isinstance(mark, Line)]
    now = [float(bench.shelf.now(end)) for end in ends]
    ends += [bench.shelf.lifted(c) for c in joined(bench, rail, owned, on, now)]
    low, high = ends[0], ends[0]
    for end in ends[1:]:
        low, high = smaller(low, end), larger(high, end)
    for mark in whole:
        found[mark] = carried
    if bars:
        found[bars[-1]] = bench.between(zero + along * low, zero + along * high, bench.room)
    return found | dict(slots)


def joined(
    bench: Bench, rail: Rail, owned: list[complex], on: list[float], now: list[float]
) -> list[float]:
    """Where an arm from the link meets its line, if the line is drawn as far as there."""
    if on or not owned:
        return []
    low, high = min(now), max(now)

    def off(point: complex) -> float:
        return abs(point - rail.at(min(max(rail.along_of(point), low), high)))

    coordinate = rail.along_of(min(owned, key=off))
    far = abs(coordinate - (low + high) / 2) * bench.field.mm
    return [] if far > 4 * REACH else [coordinate]


def of_block(bench: Bench, way: Guideway) -> Told:
    """A block with the arm to its point."""
    if way.slide.pin:
        return {}
    places, field = bench.places, bench.field
    drawing, along = places.drawing, places.along(way)
    middle, moving = seat(drawing, way), places.seat(way)
    here, turned = field(middle), field.way(way.along)
    carried = bench.carried_by(Pose(moving, along))
    if way.slide.on == FRAME:
        return {block(here, turned, way.block, "slider"): carried}
    owner = way.slide.on if is_swivel(drawing, way.slide) else way.block
    name = drawing.scene.link(owner).points[0]
    own = drawing.positions[name]
    arm = Line(*here, *field(own), "guide-bar", owner)
    return {
        arm: bench.between(moving, places.positions[name]),
        block(here, turned, owner): carried,
    }
