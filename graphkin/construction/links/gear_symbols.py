"""Gears, rings and racks: pitch lines chain-dotted, teeth where they mesh, after ISO 2203."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Sequence
from math import ceil, cos, degrees, pi, radians, sin, sqrt
from typing import NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import Disc, Touch
from graphkin.drawing.field import XY, Field
from graphkin.drawing.marks import CircleMark, LineMark, Mark, polygon
from graphkin.drawing.symbols import UPRIGHT, across, hatched
from graphkin.scene.model import FRAME

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
    half = 2 * sqrt(mine.module / max(bend, 1 / (1000 * mine.radius)))
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
