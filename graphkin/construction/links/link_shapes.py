"""The shape of each link in its own axes, from the lengths, angles and sides in the scene.

Nothing is drawn here: the shapes give the ratios by which a plate's point follows from two others.

The straight lines of links on which blocks and pins slide, and the positions of the blocks.
"""

from __future__ import annotations

from msgspec import Struct, field

from graphkin.construction.core.bases import Base
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import Guideway
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action, distance, in_proportion, lay_off
from graphkin.construction.links.dyad_by_arcs import arcs_meet, compass
from graphkin.numbers.arithmetic import Point, Real, phase
from graphkin.numbers.plane import cross, dot
from graphkin.scene.link_points import is_under
from graphkin.scene.model import (
    FRAME,
    Angled,
    Apart,
    At,
    Link,
    OnLine,
    Placing,
    Polar,
    Slide,
    Triangle,
    lengths_of,
)

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


@action("step-along")
def step_along(start: Point, first: Point, second: Point, length: Real, sense: int) -> Point:
    """A point at a distance from ``start``, in the direction from ``first`` to ``second``.

    ``sense`` is -1 for the opposite direction.
    """
    way = second - first
    return start + way * (sense * length / abs(way))


@action("polar")
def polar(start: Point, direction: Point, length: Real) -> Point:
    """A point at a distance from another in a given direction."""
    return start + direction * length


@action("angled")
def angled(vertex: Point, arm: Point, turn: Point, length: Real) -> Point:
    """A point at a distance from the vertex, turned from an arm of the angle."""
    way = arm - vertex
    return vertex + way * turn * (length / abs(way))


@action("beside")
def brought_back(start: Point, point: Point, axis: Point, here: Point) -> Point:
    """A point in its link's axes, from the positions of it and of another point."""
    return here + (point - start) * axis.conjugate()


def local_place(pen: Pen, link: str, point: str) -> int:
    """Position of a point in its link's axes; the first call places all points of the link."""
    if link not in pen.placed:
        placed = pen.placed[link] = {}
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            for placing in pen.scene.link(link).placings:
                placed[placing.point] = place(pen, placing, placed)
    if point not in pen.placed[link]:
        pen.placed[link][point] = place_found(pen, link, point)
    return pen.placed[link][point]


def place_found(pen: Pen, link: str, point: str) -> int:
    """The local position of a point placed by a cam's law, from its position in the plane.

    In the bar of an equivalent linkage, the axis runs from the centre of curvature to the roller's
    centre.
    """
    if link in pen.scene.cam_links:
        points = pen.scene.link(link).points
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            if point == points[0]:
                return pen.given("origin")
            length = pen.draw(distance, *(pen.the("position", p) for p in points))
            return pen.draw(lay_off, pen.given("origin"), length)
    if link == FRAME:
        return pen.the("position", point)
    start = pen.bases[link].start
    ends, here = pen.both("position", start, point), local_place(pen, link, start)
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        return pen.draw(brought_back, *ends, pen.the("axis", link), here)


def ratio_of(pen: Pen, base: Base, point: str) -> int:
    """(C - A)/(B - A) for a point C of a link on its base AB.

    If the end of the base is not the link's own point, the ratio is computed from positions in the
    plane.
    """
    assert base.end is not None
    key = ("ratio", base.link, base.start, base.end, point)
    if key not in pen.shared:
        names = base.start, base.end, point
        own = not is_under(base.end)
        places = [
            local_place(pen, base.link, name) if own else pen.the("position", name)
            for name in names
        ]
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            pen.draw_shared(key, in_proportion, *places)
    return pen.shared[key]


def bar_length(pen: Pen, link: str, p: str, q: str) -> int:
    """Length of a bar: from the scene where it is given, else from the shape."""
    for placing in pen.scene.link(link).placings:
        for first, second, quantity in lengths_of(placing):
            if {first, second} == {p, q}:
                return pen.given("length", quantity, name=p + q)
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        return pen.draw(distance, local_place(pen, link, p), local_place(pen, link, q))


def place(pen: Pen, placing: Placing, placed: dict[str, int], name: str = "") -> int:
    """One point of a link in its own axes, from the points placed before it."""
    match placing:
        case At(_, x, y):
            return pen.given("point", x, y, name=name)
        case Apart(_, start, length):
            return pen.draw(lay_off, placed[start], pen.given("length", length), name=name)
        case Polar(_, start, length, angle):
            turn = pen.given("direction", angle)
            distance = pen.given("length", length)
            return pen.draw(polar, placed[start], turn, distance, name=name)
        case Triangle(_, first, second, from_first, from_second, side):
            near = pen.draw(compass, placed[first], pen.given("length", from_first))
            far = pen.draw(compass, placed[second], pen.given("length", from_second))
            return pen.draw(arcs_meet, near, far, extra=(side,), name=name)
        case OnLine(_, first, second, start, length, sense):
            ends = (placed[start], placed[first], placed[second])
            length_step = pen.given("length", length)
            return pen.draw(step_along, *ends, length_step, extra=(sense,), name=name)
        case Angled(_, vertex, arm, length, angle):
            corner = (placed[vertex], placed[arm])
            turn = pen.given("direction", angle)
            return pen.draw(angled, *corner, turn, pen.given("length", length), name=name)


# --- bodies of links: bars whose points lie in line, plates around the others ---------------------


FLAT = 1e-6
"""Distance from a bar within which a point counts as on it, as a fraction of the bar's length."""


def farthest(places: list[complex]) -> tuple[complex, complex]:
    """The two places that are farthest apart."""
    return max(
        ((p, q) for i, p in enumerate(places) for q in places[i + 1 :]),
        key=lambda ends: abs(ends[1] - ends[0]),
    )


def corners_of(drawing: Drawing, link: Link) -> list[complex] | None:
    """The corners of a plate in order around it; None for a bar, whose points lie in line."""
    places = places_of(drawing, link.name)
    if len(places) < 3 or is_all_wheel(drawing, link.name):
        return None
    first, last = farthest(places)
    along = last - first
    if all(abs(cross(along, p - first)) <= FLAT * abs(along) ** 2 for p in places):
        return None
    around = hull(places)
    start = min(range(len(around)), key=lambda i: phase(around[i] - sum(around) / len(around)))
    return around[start:] + around[:start]


def is_all_wheel(drawing: Drawing, link: str) -> bool:
    """Whether all points of a link lie on one of its wheels, so that it needs no bar or plate."""
    places = places_of(drawing, link)
    return any(
        all(abs(place - disc.centre) <= disc.radius * (1 + 1e-6) for place in places)
        for disc in drawing.standing.discs
        if disc.link == link and not disc.wheel.inside
    )


def hull(places: list[complex], flat: float = FLAT) -> list[complex]:
    """The corners of the convex hull of places, in order around it.

    Corners nearly in line with others are left out (``flat``, as a fraction of the size); two
    corners remain where all places lie in line.
    """
    ordered = sorted(places, key=lambda p: (p.real, p.imag))
    ordered = [p for i, p in enumerate(ordered) if not i or p != ordered[i - 1]]
    least = flat * max(abs(p - ordered[0]) for p in ordered) ** 2
    around: list[complex] = []
    for half in (ordered, ordered[::-1]):
        chain: list[complex] = []
        for p in half:
            while len(chain) > 1 and cross(chain[-1] - chain[-2], p - chain[-1]) <= least:
                chain.pop()
            chain.append(p)
        around += chain[:-1]
    return around
