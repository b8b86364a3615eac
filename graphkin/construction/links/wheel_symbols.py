"""Wheels, gears with their teeth, racks and tracks, in the manner of ISO 2203, and profiles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from math import ceil, cos, degrees, pi, radians, sin
from typing import Any, NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import APART, Disc, Touch
from graphkin.construction.core.paper_canvas import draw_line
from graphkin.construction.guides.slide_symbols import within
from graphkin.construction.links.link_shapes import ALIKE, REACH, is_all_wheel, places_of, seat
from graphkin.drawing.field import MARGIN, XY, Field
from graphkin.drawing.labels import FieldContent, Label
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, polygon
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import UPRIGHT, across, hatched
from graphkin.numbers.arithmetic import Real, at, larger, phase, pick, smaller, sqrt
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME, Link, Profile, of_one_size
from graphkin.scene.phrases import place_of
from graphkin.text.errors import PageError, Problem, message

RIM = 2.4
"""Width of a ring without teeth, in mm."""
CONTACT = 0.6
"""Radius of the mark of a contact, in mm."""
TOUCHED = "contact"
"""The class of the mark of a contact."""
SPARE = 60.0
"""The farthest that a track is extended towards the zero of its coordinate, in mm."""


def draw_wheels(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the wheels, the largest below."""
    for disc in drawing.standing.discs:
        board.marks += wheel(drawing, field, disc)


def draw_tracks(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the straight tracks on which wheels roll."""
    for _, marks in straight_tracks(drawing, field):
        board.marks += marks


def straight_tracks(drawing: Drawing, field: Field) -> Iterator[tuple[Touch, list[Mark]]]:
    """The marks of each straight track, with the contact of its wheel."""
    for touch in drawing.standing.touches:
        if touch.zero is not None:
            yield touch, list(within(track(drawing, field, touch), field.rect))


def draw_track_line(board: FieldContent, drawing: Drawing, field: Field, link: Link) -> None:
    """Draw the line of a straight track of the frame across the field, chain-dotted."""
    standing = drawing.standing
    for rolling in link.rolls:
        zero = standing.carried(FRAME, rolling.through) if rolling.on == FRAME else None
        if zero is not None and rolling.angle is not None:
            along = complex(rolling.angle.direction(drawing.scene.values))
            draw_line(board, field, (zero, along), f"track {link.name}")


def draw_fixed_wheels(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the wheels of the frame, hatched and without teeth, as on the task sheet."""
    for disc in drawing.standing.discs:
        if disc.link == FRAME:
            centre, radius = field(disc.centre), disc.radius * field.mm
            ground = hatching(centre, radius, outward=disc.wheel.inside)
            board.marks.append(CircleMark(*centre, radius, "wheel", FRAME))
            board.marks += within(ground, field.rect)


def draw_touches(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the spokes that show the rotation of wheels, and the marks of their contacts."""
    for disc in drawing.standing.discs:
        board.marks += spokes(drawing, field, disc)
    for touch in drawing.standing.touches:
        board.marks += within(strands(field, touch), field.rect)
        if touch.other is not None and is_parallel(touch, touch.other):
            continue
        here, name = field(touch.at), drawing.standing.name_at(touch.at)
        board.marks.append(CircleMark(*here, CONTACT, TOUCHED, touch.disc.link))
        if name:
            board.labels.append(
                Label(symbol(name), "", here, 2.5, name, priority=1, radius=CONTACT)
            )


def is_parallel(touch: Touch, other: Disc) -> bool:
    """Whether the strands of a belt are parallel, so that they do not meet."""
    belt = touch.belt
    return belt is not None and not belt.crossed and of_one_size(touch.disc.wheel, other.wheel)


def strands(field: Field, touch: Touch) -> Iterator[Mark]:
    """The strands of a belt, common tangents of its wheels; open ones are produced."""
    belt, other = touch.belt, touch.other
    if belt is None or other is None:
        return
    apart = other.centre - touch.disc.centre
    lean = (touch.disc.radius + belt.sense * other.radius) / abs(apart)
    rise, along = sqrt(1 - lean * lean), apart / abs(apart)
    for side in (1, -1):
        normal = along * at(lean, side * rise)
        start = touch.disc.centre + touch.disc.radius * normal
        end = other.centre - belt.sense * other.radius * normal
        yield LineMark(*field(start), *field(end), "belt", touch.disc.link)
        if not belt.crossed and not is_parallel(touch, other):
            nearer = start if touch.disc.radius < other.radius else end
            yield LineMark(*field(nearer), *field(touch.at), "locus", touch.disc.link)


def wheel(drawing: Drawing, field: Field, disc: Disc) -> Iterator[Mark]:
    """The marks of one wheel: a disc, a ring, or a gear with its pitch circle."""
    centre, radius, name = field(disc.centre), disc.radius * field.mm, disc.link
    fixed, ring = disc.link == FRAME, disc.wheel.inside
    if disc.module:
        yield from gear(drawing, field, disc)
    elif ring:
        yield CircleMark(*centre, radius, "wheel", name)
        if not fixed:
            yield CircleMark(*centre, radius + RIM, "wheel", name)
    else:
        yield CircleMark(*centre, radius, "wheel" if fixed else "disc", name)
    if fixed:
        edge = disc.outer * field.mm if ring else (disc.radius - ROOT * disc.module) * field.mm
        yield from within(hatching(centre, edge, outward=ring), field.rect)


def hatching(centre: XY, radius: float, *, outward: bool) -> Iterator[Mark]:
    """Short strokes around a circle of the frame."""
    count = max(8, int(2 * pi * radius / 2.4))
    for i in range(count):
        here, there = 2 * pi * i / count, 2 * pi * (i + 0.8) / count
        far = radius + (2 if outward else -2)
        yield LineMark(*polar(centre, radius, here), *polar(centre, max(far, 0.1), there), "ground")


def spokes(drawing: Drawing, field: Field, disc: Disc) -> Iterator[Mark]:
    """A radius to each point on the wheel, or along its x axis, to show the wheel's angle."""
    if disc.link == FRAME or disc.wheel.inside:
        return
    ends = [p for p in places_of(drawing, disc.link) if p != disc.centre]
    axis = drawing.standing.axis(disc.link)
    if not ends and axis is not None:
        ends = [disc.centre + (disc.radius - ROOT * disc.module) * axis]
    if is_all_wheel(drawing, disc.link) or len(ends) == 1:
        for end in ends:
            yield LineMark(*field(disc.centre), *field(end), "spoke", disc.link)


def track(drawing: Drawing, field: Field, touch: Touch) -> Iterator[Mark]:
    """The marks of a straight track: hatched on the frame, a bar on a link, or a rack."""
    low, high = track_ends(drawing, field, touch)
    on, side = touch.on, touch.side
    at, way = field(touch.at), field.way(touch.along)
    bars = [(low, high)]
    if touch.disc.module:
        ends = rack_ends(drawing, field, touch, low, high)
        bars = [(low, ends[0]), (ends[1], high)]
        low, high = ends
    for start, end in bars if on != FRAME else ():
        if start < end:
            yield LineMark(*across(at, way, start, 0), *across(at, way, end, 0), "guide-bar", on)
    if touch.disc.module:
        yield from rack(field, touch, low, high)
    elif on == FRAME:
        first, last = across(at, way, low, 0), across(at, way, high, 0)
        yield from hatched(*((first, last) if side > 0 else (last, first)))
    if on != FRAME:
        yield from arm_to_track(drawing, field, touch, low, high)


def track_ends(drawing: Drawing, field: Field, touch: Touch) -> tuple[float, float]:
    """The drawn part of a straight track, in mm from the contact."""
    assert touch.zero is not None
    half = max(REACH, 0.8 * touch.disc.radius * field.mm)
    zero = dot(touch.zero - touch.at, touch.along) * field.mm
    ends = [-half, half, *seats(drawing, field, touch)]
    is_near = (abs(zero) < SPARE) | isinstance(touch.rolling.through, str)
    ends += [pick(is_near, zero - 4, -half), pick(is_near, zero + 4, half)]
    if touch.on != FRAME:
        near = ALIKE * drawing.standing.size + 2.5 * touch.disc.module
        for place in places_of(drawing, touch.on):
            if abs(cross(touch.along, place - touch.at)) < near:
                ends.append(dot(place - touch.at, touch.along) * field.mm)
    return reduce(smaller, ends), reduce(larger, ends)


def seats(drawing: Drawing, field: Field, touch: Touch) -> list[float]:
    """The positions of the blocks of a track's link along the track, in mm from the contact."""
    return [
        dot(seat(drawing, way) - touch.at, touch.along) * field.mm
        for way in drawing.standing.guideways
        if way.block == touch.on and way.slide.on == FRAME
    ]


def rack_ends(
    drawing: Drawing, field: Field, touch: Touch, low: float, high: float
) -> tuple[float, float]:
    """The part of a track with the body of a rack: clear of the guides of its link."""
    full = teeth_beside(touch) * pi * touch.disc.module * field.mm + BASE
    low, high = smaller(low, -full), larger(high, full)
    for place in seats(drawing, field, touch):
        is_ahead = place > 0
        high = pick(is_ahead, smaller(high, place - REACH - 2), high)
        low = pick(is_ahead, low, larger(low, place + REACH + 2))
    return low, high


def arm_to_track(
    drawing: Drawing, field: Field, touch: Touch, low: float, high: float
) -> Iterator[Mark]:
    """The arm from a link's nearest point to its track, where the track misses all points."""
    places = places_of(drawing, touch.on)
    if not places:
        return
    thick = 2.5 * touch.disc.module * field.mm

    def foot(place: complex) -> Real:
        return smaller(larger(dot(place - touch.at, touch.along) * field.mm, low), high)

    side = touch.side
    aside = side * (ROOT * touch.disc.module * field.mm + BASE) if touch.disc.module else 0.0

    def gap(place: complex) -> Real:
        there = touch.at + (foot(place) - 1j * aside) / field.mm * touch.along
        return abs(place - there) * field.mm

    nearest = min(places, key=gap)
    if gap(nearest) > max(thick + BASE, 0.5):
        there = across(field(touch.at), field.way(touch.along), foot(nearest), aside)
        yield LineMark(*field(nearest), *there, "guide-bar", touch.on)


def number_beside(drawing: Drawing, field: Field, link: Link) -> tuple[XY, XY] | None:
    """The part of a link's first wheel at which its number is drawn."""
    for disc in drawing.standing.discs:
        if disc.sign == link.name:
            return part_of_rim(drawing, field, disc)
    return None


def part_of_rim(drawing: Drawing, field: Field, disc: Disc) -> tuple[XY, XY]:
    """The part of a wheel's rim at which a number is drawn, away from the wheel's contacts."""
    away = free_side(drawing, disc)
    centre, radius = field(disc.centre), disc.outer * field.mm
    return polar(centre, radius, away - 0.2), polar(centre, radius, away + 0.2)


def free_side(drawing: Drawing, disc: Disc) -> float:
    """A direction (radians) from a wheel's centre, away from its contacts."""
    ways = [
        (touch.at - disc.centre) / abs(touch.at - disc.centre)
        for touch in drawing.standing.touches
        if disc in (touch.disc, touch.other)
    ]
    total = sum(ways)
    if not ways or abs(total) < 0.1:
        return (phase(ways[0]) + pi / 2) if ways else 0.75 * pi
    return float(phase(-total)) + 0.5


def touching_points(drawing: Drawing, link: Link) -> list[str]:
    """The points at which the wheels of a link touch their tracks."""
    touches = [touch for touch in drawing.standing.touches if touch.disc.link == link.name]
    return [drawing.standing.name_at(touch.at) for touch in touches]


HALF = MARGIN
"""Drawn length of a profile to each side of its contact, in mm, where there is room."""
WIDEST = 60.0
"""Largest half-angle of a profile about its centre, in degrees."""
ALL_ROUND = 180.0
"""Half-angle of a whole circle, in degrees."""


class Edge(NamedTuple):
    """A profile of a link in the plane."""

    link: str
    profile: Profile
    centre: complex
    contact: complex

    @property
    def arm(self) -> complex:
        """The vector from its centre to the point on it."""
        return self.contact - self.centre

    def half(self, free: Real, values: Mapping[str, Any]) -> Real:
        """Half the profile's arc in degrees: as given, or ``free`` up to a limit."""
        if self.profile.arc is None:
            return smaller(free, WIDEST)
        return degrees(float(self.profile.arc.si(values))) / 2


def draw_edges(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the profiles of all links. Raises PageError where a profile has no radius."""
    for link in (drawing.scene.frame, *drawing.scene.links.values()):
        for edge in edges_of(link, drawing.positions):
            if abs(edge.arm) <= APART * drawing.standing.size:
                raise PageError(without_radius(edge))
            board.marks.append(edge_arc(drawing, field, edge))


def edges_of(link: Link, places: Mapping[str, complex]) -> Iterator[Edge]:
    """The profiles of a link whose points are placed."""
    for profile in link.profiles:
        if profile.about in places and profile.through in places:
            yield Edge(link.name, profile, places[profile.about], places[profile.through])


def without_radius(edge: Edge) -> Problem:
    """The problem of a profile whose centre lies on it."""
    about, through = edge.profile.about, edge.profile.through
    found = message("{about} and {through} coincide", about=about, through=through)
    hint = message("change the position, or leave the profile out")
    return Problem(f"{place_of(edge.link)}.profiles", found, message("an arc with a radius"), hint)


def edge_arc(drawing: Drawing, field: Field, edge: Edge) -> Arc | CircleMark:
    """The arc of a profile about its contact, with the given length, or its whole circle."""
    radius = abs(edge.arm) * field.mm
    middle = phase(edge.arm) * (180 / pi)
    half = edge.half(degrees(HALF) / radius, drawing.scene.values)
    if half >= ALL_ROUND:
        return CircleMark(*field(edge.centre), radius, "profile", edge.link)
    ends = middle - half, middle + half
    return Arc(*field(edge.centre), radius, *ends, "profile", edge.link)


FEW, MANY = 2, 12
"""Least and most teeth drawn on either side of a pitch point."""
FEWEST = 14
"""Number of teeth up to which all teeth of a wheel are drawn."""
FINE = 0.5
"""Module below which a wheel is drawn without teeth, in mm of paper."""
ROOT = 1.25
"""Depth of a tooth below the pitch line, in modules; its height above is one module."""
FOOT, TOP = 0.28, 0.10
"""Half the width of a tooth at its root and at its top, as fractions of the pitch."""
BASE = 3.2
"""Width of a rack below its teeth, in mm."""


def polar(centre: XY, radius: float, angle: float) -> XY:
    """The place at an angle (radians, counter-clockwise on paper) and a distance from a centre."""
    return across(centre, UPRIGHT, radius * cos(angle), -radius * sin(angle))


def gear(drawing: Drawing, field: Field, disc: Disc) -> Iterator[Mark]:
    """Draw a gear: its tip circle with teeth where it meshes, and its pitch circle chain-dotted."""
    centre, radius, name = field(disc.centre), disc.radius * field.mm, disc.link
    ring, module = disc.wheel.inside, disc.module * field.mm
    corners = outline(disc, meshes(drawing, disc), radius, module)
    points = tuple(polar(centre, r, angle) for r, angle in corners)
    open_ = ring or disc.link == FRAME
    yield polygon(points, "gear" if open_ else "gear-disc", name)
    if ring:
        yield CircleMark(*centre, disc.outer * field.mm, "gear", name)
    yield CircleMark(*centre, radius, "pitch", name)


class Mesh(NamedTuple):
    """A mesh of a gear: its direction (radians), and the shift of its teeth.

    The shift is 0 for a tooth in that direction and 0.5 for a gap. ``shown`` teeth are drawn on
    either side of that place, as far as the tips overlap.
    """

    way: float
    shift: float
    shown: int


def meshes(drawing: Drawing, disc: Disc) -> list[Mesh]:
    """The meshes of a gear with other gears or with racks."""
    found = []
    for touch in drawing.standing.touches:
        if disc in (touch.disc, touch.other):
            way = touch.at - disc.centre
            if (
                touch.belt is None
                and touch.disc.module
                and (touch.other is None or touch.other.module)
            ):
                shift = 0.0 if disc is touch.disc else 0.5
                found.append(Mesh(phase(way), shift, overlapping(touch)))
    return found


def overlapping(touch: Touch) -> int:
    """The number of teeth on either side of the pitch point where two gears' tips overlap."""
    mine, other = touch.disc, touch.other
    bend = 1 / mine.radius
    if other is not None:
        inside = mine.wheel.inside or other.wheel.inside
        bend = abs(bend - 1 / other.radius) if inside else bend + 1 / other.radius
    half: float = 2 * sqrt(mine.module / max(bend, 1 / (1000 * mine.radius)))
    return min(max(FEW, ceil(half / (pi * mine.module) + 0.5)), MANY)


def outline(
    disc: Disc, found: Sequence[Mesh], radius: float, module: float
) -> Iterator[tuple[float, float]]:
    """The outline of a gear as (radius in mm, angle): teeth at meshes, elsewhere the tip circle."""
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
    """The middle angles of the teeth that are drawn, from 0 to a full turn."""
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


def teeth_beside(touch: Touch) -> int:
    """The number of pitches of a rack's teeth drawn on either side of its pitch point."""
    return overlapping(touch) + 1


def rack(field: Field, touch: Touch, low: float, high: float) -> Iterator[Mark]:
    """Draw a rack: its outline with teeth about the pitch point, its pitch line chain-dotted."""
    module, side = touch.disc.module * field.mm, touch.side
    at, way, name = field(touch.at), field.way(touch.along), touch.on
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
    yield LineMark(*across(at, way, low, 0), *across(at, way, high, 0), "pitch", name)
    if name == FRAME:
        first, last = across(at, way, low, back), across(at, way, high, back)
        yield from hatched(*((first, last) if side > 0 else (last, first)))
