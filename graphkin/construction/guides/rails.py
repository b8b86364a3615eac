"""The straight lines of links on which blocks and pins slide, and the positions of the blocks."""

from __future__ import annotations

from msgspec import Struct, field

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import Guideway
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import cross, dot
from graphkin.scene.model import FRAME, Slide

REACH = 15.0
"""Half the length of a drawn guide, in mm."""
BEYOND = 10.5
"""Drawn length of a bar beyond the middle of a block on it, in mm."""
ALIKE = 1e-6
"""Lines closer than this, as a fraction of the mechanism's size, are one."""


class Rail(Struct):
    """A straight line of one link on which blocks slide, with the positions of the blocks and pins.

    ``marks`` are coordinates of ``blocks`` along the line, in metres from ``zero``; ``slots`` are
    coordinates and names of pins.
    """

    owner: str
    zero: complex
    along: complex
    marks: list[float] = field(default_factory=list)
    blocks: list[str] = field(default_factory=list)
    slots: list[tuple[float, str]] = field(default_factory=list)

    def holds(self, owner: str, point: complex, along: complex, near: float) -> bool:
        """Whether a line of a link is this one."""
        return (
            owner == self.owner
            and abs(cross(self.along, along)) < ALIKE
            and abs(cross(self.along, point - self.zero)) < near
        )

    def at(self, coordinate: float) -> complex:
        """The place at a distance along the line."""
        return self.zero + coordinate * self.along

    def along_of(self, point: complex) -> float:
        """The coordinate of a point along the line."""
        return dot(point - self.zero, self.along)  # type: ignore[no-any-return]


def is_swivel(drawing: Drawing, slide: Slide) -> bool:
    """Whether the guide is a block that only turns about its one point, on a sliding bar."""
    if slide.on == FRAME or slide.pin:
        return False
    scene = drawing.scene
    carrier = scene.links[slide.on]
    served = [s for link in scene.links.values() for s in link.slides if s.on == slide.on]
    alone = carrier.points == (slide.through,) and not carrier.slides and not carrier.wheels
    return alone and len(served) == 1


def rails_of(drawing: Drawing) -> list[Rail]:
    """The guides of all links, those on one line of one link together; no guides with rollers."""
    found: list[Rail] = []
    near = ALIKE * drawing.standing.size
    for way in (each for each in drawing.standing.guideways if not each.slide.rollers):
        swivel = is_swivel(drawing, way.slide)
        owner = way.block if swivel else way.slide.on
        start = way.at if swivel or owner == FRAME else way.zero
        rail = next((r for r in found if r.holds(owner, start, way.along, near)), None)
        if rail is None:
            rail = Rail(owner, start, way.along)
            found.append(rail)
        if way.slide.pin:
            rail.slots.append((rail.along_of(way.at), way.block))
        else:
            rail.marks.append(rail.along_of(seat(drawing, way)))
            rail.blocks.append(way.block)
    return found


def seat(drawing: Drawing, way: Guideway) -> Point:
    """The position of the middle of a sliding pair's rectangle."""
    if way.slide.on == FRAME:
        return drawing.standing.beside_wheels(way)
    if not is_swivel(drawing, way.slide):
        return way.foot
    pivot = drawing.positions[drawing.scene.links[way.slide.on].points[0]]
    return way.at + dot(pivot - way.at, way.along) * way.along


def swivelling(drawing: Drawing) -> list[complex]:
    """The positions of the rectangles that are drawn on moving links."""
    ways = drawing.standing.guideways
    return [seat(drawing, w) for w in ways if w.slide.on != FRAME and not w.slide.pin]


def places_of(drawing: Drawing, link: str) -> list[complex]:
    """The positions of a link's points, except the centres of its hollows."""
    own, places = drawing.scene.link(link), drawing.positions
    return [places[p] for p in own.points if p in places and not own.is_hollow_about(p)]
