"""Wheels, gears, rings, racks and tracks on the mechanism, in the manner of ISO 2203."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Sequence
from math import ceil, cos, degrees, hypot, pi, radians, sin, sqrt
from typing import NamedTuple

from graphkin.paper.drawing import Drawing
from graphkin.paper.field import XY, Field
from graphkin.paper.labels import Board, Label
from graphkin.paper.marks import Circle, Line, Mark, polygon
from graphkin.paper.slides import ALIKE, REACH, places_of, seat, within
from graphkin.paper.standing import Disc, Touch
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import across, hatched
from graphkin.plane import cross, dot
from graphkin.scene.model import FRAME, Link

FEW, MANY = 2, 12
"""Least and most teeth drawn on either side of a pitch point."""
FEWEST = 14
"""A wheel with so few teeth gets them all."""
FINE = 0.5
"""Modules smaller than this, in mm of paper, are drawn without teeth."""
ROOT = 1.25
"""Depth of a tooth below the pitch line, in modules; above it is one."""
FOOT, TOP = 0.31, 0.14
"""Half the width of a tooth at its root and at its top, in parts of the pitch."""
RIM = 2.4
"""Width of a ring without teeth, in mm."""
CONTACT = 0.6
"""Radius of the mark of a contact, in mm."""
BASE = 3.2
"""Width of a rack below its teeth, in mm."""
SPARE = 60.0
"""The farthest that a track is drawn on towards where it counts from, in mm."""


def draw_wheels(board: Board, drawing: Drawing, field: Field) -> None:
    """The wheels, the largest below."""
    for disc in drawing.standing.discs:
        board.marks += wheel(drawing, field, disc)


def draw_tracks(board: Board, drawing: Drawing, field: Field) -> None:
    """The straight tracks that wheels roll on."""
    for touch in drawing.standing.touches:
        if touch.zero is not None:
            board.marks += within(track(drawing, field, touch), field.rect)


def draw_fixed_wheels(board: Board, drawing: Drawing, field: Field) -> None:
    """The wheels of the frame without their teeth, which the task sheet shows, too."""
    for disc in drawing.standing.discs:
        if disc.link == FRAME:
            board.marks.append(Circle(*field(disc.centre), disc.radius * field.mm, "wheel", FRAME))


def draw_contacts(board: Board, drawing: Drawing, field: Field) -> None:
    """The spokes that show how far wheels have turned, and the marks of their contacts."""
    for disc in drawing.standing.discs:
        board.marks += spokes(drawing, field, disc)
    for touch in drawing.standing.touches:
        at, name = field(touch.at), drawing.standing.name_at(touch.at)
        board.marks.append(Circle(*at, CONTACT, "contact", touch.disc.link))
        if name:
            board.labels.append(Label(symbol(name), "", at, 2.5, name, priority=1, radius=CONTACT))


def wheel(drawing: Drawing, field: Field, disc: Disc) -> Iterator[Mark]:
    """One wheel: a disc, a ring, or a gear with its pitch circle."""
    centre, radius, name = field(disc.centre), disc.radius * field.mm, disc.link
    fixed, ring = disc.link == FRAME, disc.wheel.inside
    if disc.module:
        yield from gear(drawing, field, disc)
    elif ring:
        yield Circle(*centre, radius, "wheel", name)
        if not fixed:
            yield Circle(*centre, radius + RIM, "wheel", name)
    else:
        yield Circle(*centre, radius, "wheel" if fixed else "disc", name)
    if fixed:
        edge = disc.outer * field.mm if ring else root_of(disc, field)
        yield from within(hatching(centre, edge, outward=ring), field.rect)


def root_of(disc: Disc, field: Field) -> float:
    """Radius of the circle that the teeth of a wheel stand on, in mm; of a plain wheel its rim."""
    return (disc.radius - ROOT * disc.module) * field.mm


def hatching(centre: XY, radius: float, *, outward: bool) -> Iterator[Mark]:
    """Short strokes around a circle of the frame."""
    count = max(8, int(2 * pi * radius / 2.4))
    for i in range(count):
        here, there = 2 * pi * i / count, 2 * pi * (i + 0.8) / count
        far = radius + (2 if outward else -2)
        yield Line(*polar(centre, radius, here), *polar(centre, max(far, 0.1), there), "ground")


def polar(centre: XY, radius: float, angle: float) -> XY:
    """The place at an angle (radians, counter-clockwise on paper) and a distance from a centre."""
    return centre[0] + radius * cos(angle), centre[1] - radius * sin(angle)


def gear(drawing: Drawing, field: Field, disc: Disc) -> Iterator[Mark]:
    """A gear: its tip circle with teeth where it meshes, and its pitch circle chain-dotted."""
    centre, radius, name = field(disc.centre), disc.radius * field.mm, disc.link
    ring, module = disc.wheel.inside, disc.module * field.mm
    corners = outline(disc, meshes(drawing, disc), radius, module)
    points = tuple(polar(centre, r, angle) for r, angle in corners)
    open_ = ring or disc.link == FRAME
    yield polygon(points, "gear" if open_ else "gear-disc", name)
    if ring:
        yield Circle(*centre, disc.outer * field.mm, "gear", name)
    yield Circle(*centre, radius, "pitch", name)


class Mesh(NamedTuple):
    """Where a gear meshes: the direction (radians), 0 for a tooth there or 0.5 for a gap.

    ``shown`` teeth are drawn on either side of that place, as far as the tips overlap.
    """

    way: float
    shift: float
    shown: int


def meshes(drawing: Drawing, disc: Disc) -> list[Mesh]:
    """Where a gear meshes with others or with racks."""
    found = []
    for touch in drawing.standing.touches:
        if disc in (touch.disc, touch.other):
            way = touch.at - disc.centre
            if touch.disc.module and (touch.other is None or touch.other.module):
                shift = 0.0 if disc is touch.disc else 0.5
                found.append(Mesh(phase(way), shift, overlapping(touch)))
    return found


def overlapping(touch: Touch) -> int:
    """How many teeth on either side of the pitch point lie where two gears' tips overlap."""
    mine, other = touch.disc, touch.other
    bend = 1 / mine.radius
    if other is not None:
        inside = mine.wheel.inside or other.wheel.inside
        bend = abs(bend - 1 / other.radius) if inside else bend + 1 / other.radius
    half = 2 * sqrt(mine.module / max(bend, 1 / (1000 * mine.radius)))
    return min(max(FEW, ceil(half / (pi * mine.module) + 0.5)), MANY)


def outline(
    disc: Disc, found: Sequence[Mesh], radius: float, module: float
) -> Iterator[tuple[float, float]]:
    """The outline of a gear as (radius in mm, angle): teeth at its meshes, elsewhere its tips."""
    inward = -1 if disc.wheel.inside else 1
    tip, root = radius + inward * module, radius - inward * ROOT * module
    count = round(2 * disc.radius / disc.module)
    pitch = 2 * pi / count
    toothed = teeth_at(found, pitch, count) if module >= FINE else []
    if not toothed:
        yield from ((tip, radians(a)) for a in range(0, 360, 4))
        return
    for i, middle in enumerate(toothed):
        for part, r in ((-FOOT, root), (-TOP, tip), (TOP, tip), (FOOT, root)):
            yield r, middle + part * pitch
        following = toothed[(i + 1) % len(toothed)]
        gap = (following - middle) % (2 * pi) or 2 * pi
        if gap > 1.5 * pitch:
            start, end = middle + 0.5 * pitch, middle + gap - 0.5 * pitch
            steps = max(2, int(degrees(end - start) / 4))
            yield from ((tip, start + (end - start) * k / steps) for k in range(steps + 1))


def teeth_at(found: Sequence[Mesh], pitch: float, count: int) -> list[float]:
    """The middles of the teeth that are drawn, from 0 to a full turn."""
    if not found:
        return []
    if count <= FEWEST or sum(2 * mesh.shown + 3 for mesh in found) >= count:
        way, shift, _ = found[0]
        return sorted((way + (i + shift) * pitch) % (2 * pi) for i in range(count))
    middles: list[float] = []
    for way, shift, shown in found:
        for i in range(-shown - (1 if shift else 0), shown + 1):
            middle = (way + (i + shift) * pitch) % (2 * pi)
            apart = (abs((middle - other + pi) % (2 * pi) - pi) for other in middles)
            if all(gap > 0.9 * pitch for gap in apart):
                middles.append(middle)
    return sorted(middles)


def spokes(drawing: Drawing, field: Field, disc: Disc) -> Iterator[Mark]:
    """A radius to each point on the wheel, or along its x axis: they show how far it has turned."""
    if disc.link == FRAME or disc.wheel.inside:
        return
    ends = [p for p in places_of(drawing, disc.link) if p != disc.centre]
    axis = drawing.standing.axis(disc.link)
    if not ends and axis is not None:
        ends = [disc.centre + (disc.radius - ROOT * disc.module) * axis]
    if is_all_wheel(drawing, disc.link) or len(ends) == 1:
        for end in ends:
            yield Line(*field(disc.centre), *field(end), "spoke", disc.link)


def is_all_wheel(drawing: Drawing, link: str) -> bool:
    """True for a link whose points all lie on one of its wheels: it needs no bar or plate."""
    places = places_of(drawing, link)
    return any(
        all(abs(place - disc.centre) <= disc.radius * (1 + 1e-6) for place in places)
        for disc in drawing.standing.discs
        if disc.link == link and not disc.wheel.inside
    )


def track(drawing: Drawing, field: Field, touch: Touch) -> Iterator[Mark]:
    """A straight track: hatched if it is of the frame, a bar of its link if not; a rack's teeth."""
    low, high = track_ends(drawing, field, touch)
    side = touch.rolling.side
    at, way = field(touch.at), field.way(touch.along)
    start, end = across(at, way, low, 0), across(at, way, high, 0)
    if touch.rolling.on != FRAME:
        yield Line(*start, *end, "guide-bar", touch.rolling.on)
    elif not touch.disc.module:
        yield from hatched(*((start, end) if side > 0 else (end, start)))
    if touch.disc.module:
        low, high = rack_ends(drawing, field, touch, low, high)
        yield from rack(field, touch, low, high)
    if touch.rolling.on != FRAME:
        yield from arm_to_track(drawing, field, touch, low, high)


def track_ends(drawing: Drawing, field: Field, touch: Touch) -> tuple[float, float]:
    """The drawn part of a straight track, in mm from the contact."""
    assert touch.zero is not None
    half = max(REACH, 0.8 * touch.disc.radius * field.mm)
    zero = dot(touch.zero - touch.at, touch.along) * field.mm
    ends = [-half, half, *seats(drawing, field, touch)]
    if abs(zero) < SPARE or isinstance(touch.rolling.through, str):
        ends += [zero - 4, zero + 4]
    if touch.rolling.on != FRAME:
        near = ALIKE * drawing.standing.size + 2.5 * touch.disc.module
        for place in places_of(drawing, touch.rolling.on):
            if abs(cross(touch.along, place - touch.at)) < near:
                ends.append(dot(place - touch.at, touch.along) * field.mm)
    return min(ends), max(ends)


def seats(drawing: Drawing, field: Field, touch: Touch) -> list[float]:
    """Where the blocks of a track's link stand on it, in mm from the contact."""
    return [
        dot(seat(drawing, way) - touch.at, touch.along) * field.mm
        for way in drawing.standing.guideways
        if way.block == touch.rolling.on and way.slide.on == FRAME
    ]


def rack_ends(
    drawing: Drawing, field: Field, touch: Touch, low: float, high: float
) -> tuple[float, float]:
    """The part of a track that has the body of a rack: clear of the guides of its link."""
    full = teeth_beside(touch) * pi * touch.disc.module * field.mm + BASE
    low, high = min(low, -full), max(high, full)
    for place in seats(drawing, field, touch):
        if place > 0:
            high = min(high, place - REACH - 2)
        else:
            low = max(low, place + REACH + 2)
    return low, high


def teeth_beside(touch: Touch) -> int:
    """How many pitches of a rack's teeth are drawn on either side of its pitch point."""
    return overlapping(touch) + 1


def rack(field: Field, touch: Touch, low: float, high: float) -> Iterator[Mark]:
    """A rack: its outline with teeth about the pitch point, its pitch line chain-dotted."""
    module, side = touch.disc.module * field.mm, touch.rolling.side
    at, way, name = field(touch.at), field.way(touch.along), touch.rolling.on
    pitch, tip, root = pi * module, -side * module, side * ROOT * module
    count = min(teeth_beside(touch), int((min(-low, high) - 0.2) / pitch))
    corners = []
    if module >= FINE and count > 0:
        corners += [(-count * pitch, tip), (-count * pitch, root)]
        for i in range(-count, count):
            middle = (i + 0.5) * pitch
            for part, aside in ((-FOOT, root), (-TOP, tip), (TOP, tip), (FOOT, root)):
                corners.append((middle + part * pitch, aside))
        corners += [(count * pitch, root), (count * pitch, tip)]
    back = root + side * BASE
    corners = [(low, tip), *corners, (high, tip), (high, back), (low, back)]
    yield polygon(tuple(across(at, way, *c) for c in corners), "gear-disc", name)
    yield Line(*across(at, way, low, 0), *across(at, way, high, 0), "pitch", name)
    if name == FRAME:
        first, last = across(at, way, low, back), across(at, way, high, back)
        yield from hatched(*((first, last) if side > 0 else (last, first)))


def arm_to_track(
    drawing: Drawing, field: Field, touch: Touch, low: float, high: float
) -> Iterator[Mark]:
    """The arm from a link's nearest point to its track, where the track misses all of them."""
    places = places_of(drawing, touch.rolling.on)
    if not places:
        return
    thick = 2.5 * touch.disc.module * field.mm

    def foot(place: complex) -> float:
        return min(max(float(dot(place - touch.at, touch.along)) * field.mm, low), high)

    at, way = field(touch.at), field.way(touch.along)
    side = touch.rolling.side
    aside = side * (ROOT * touch.disc.module * field.mm + BASE) if touch.disc.module else 0.0

    def gap(place: complex) -> float:
        here, there = field(place), across(at, way, foot(place), aside)
        return hypot(here[0] - there[0], here[1] - there[1])

    nearest = min(places, key=gap)
    if gap(nearest) > max(thick + BASE, 0.5):
        there = across(at, way, foot(nearest), aside)
        yield Line(*field(nearest), *there, "guide-bar", touch.rolling.on)


def number_beside(drawing: Drawing, field: Field, link: Link) -> tuple[XY, XY] | None:
    """The part of a wheel's rim at which its link's number stands."""
    for disc in drawing.standing.discs:
        if disc.link == link.name:
            away = free_side(drawing, disc)
            centre, radius = field(disc.centre), disc.outer * field.mm
            return polar(centre, radius, away - 0.2), polar(centre, radius, away + 0.2)
    return None


def free_side(drawing: Drawing, disc: Disc) -> float:
    """A direction (radians) from a wheel's centre that leads away from what it touches."""
    ways = [
        (touch.at - disc.centre) / abs(touch.at - disc.centre)
        for touch in drawing.standing.touches
        if disc in (touch.disc, touch.other)
    ]
    total = sum(ways)
    if not ways or abs(total) < 0.1:
        return (phase(ways[0]) + pi / 2) if ways else 0.75 * pi
    return phase(-total) + 0.5
