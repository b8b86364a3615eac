"""The shape of each link in its own axes, from the lengths, angles and sides in the scene.

Nothing is drawn here: the shapes give the ratios by which a plate's point follows from two others.
"""

from __future__ import annotations

from graphkin.construction.core.bases import Base
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action, distance, in_proportion, lay_off
from graphkin.construction.guides.rails import places_of
from graphkin.construction.links.dyad_by_arcs import arcs_meet, compass
from graphkin.numbers.arithmetic import Point, Real, phase
from graphkin.numbers.plane import cross
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
    Triangle,
    lengths_of,
)


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
