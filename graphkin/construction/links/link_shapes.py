"""The shape of each link in its own axes, from the lengths, angles and sides that the scene says.

Nothing here is drawn: it gives the ratios by which a point of a plate follows from two others.
"""

from __future__ import annotations

from graphkin.construction.core.bases import Base
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action, distance, in_proportion, lay_off
from graphkin.construction.links.dyad_by_arcs import arcs_meet, compass
from graphkin.numbers.arithmetic import Point, Real
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

Placed = dict[str, int]


@action("step-along")
def step_along(start: Point, first: Point, second: Point, length: Real, sense: int) -> Point:
    """A point at a distance from ``start`` the way from ``first`` to ``second``, or back."""
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
    """A point in its link's axes, from where it and another stand."""
    return here + (point - start) * axis.conjugate()


class LinkShapes:
    """Local positions of the points of each link, written down when first asked for."""

    def __init__(self, pen: Pen) -> None:
        self.pen = pen
        self.placed: dict[str, Placed] = {}
        self.ratios: dict[tuple[str, str, str, str], int] = {}

    def local(self, link: str, point: str) -> int:
        """Position of a point in its link's axes."""
        if link not in self.placed:
            with self.pen.on(Part.SHAPE, Plane.NUMBERS):
                self.placed[link] = place_all(self.pen, self.pen.scene.link(link))
        if point not in self.placed[link]:
            self.placed[link][point] = self.found(link, point)
        return self.placed[link][point]

    def found(self, link: str, point: str) -> int:
        """The local position of a point that a cam's law sets, from where it stands.

        In the bar of an equivalent linkage the axis leads from the centre to the roller's.
        """
        if link in self.pen.scene.cam_links:
            points = self.pen.scene.link(link).points
            with self.pen.on(Part.SHAPE, Plane.NUMBERS):
                if point == points[0]:
                    return self.pen.given("origin")
                length = self.pen.draw(distance, *(self.pen.the("position", p) for p in points))
                return self.pen.draw(lay_off, self.pen.given("origin"), length)
        if link == FRAME:
            return self.pen.the("position", point)
        start = self.pen.bases[link].start
        ends = (self.pen.the("position", each) for each in (start, point))
        here = self.local(link, start)
        with self.pen.on(Part.SHAPE, Plane.NUMBERS):
            return self.pen.draw(brought_back, *ends, self.pen.the("axis", link), here)

    def ratio(self, link: str, base: str, end: str, point: str) -> int:
        """(C - A)/(B - A) of three points of a link."""
        key = (link, base, end, point)
        if key not in self.ratios:
            locals_ = [self.local(link, name) for name in (base, end, point)]
            with self.pen.on(Part.SHAPE, Plane.NUMBERS):
                self.ratios[key] = self.pen.draw(in_proportion, *locals_)
        return self.ratios[key]

    def ratio_of(self, base: Base, point: str) -> int:
        """The ratio of a point of a link on its base; from places where the base is not its own."""
        assert base.end is not None
        if not is_under(base.end):
            return self.ratio(base.link, base.start, base.end, point)
        key = (base.link, base.start, base.end, point)
        if key not in self.ratios:
            places = [self.pen.the("position", name) for name in (base.start, base.end, point)]
            with self.pen.on(Part.SHAPE, Plane.NUMBERS):
                self.ratios[key] = self.pen.draw(in_proportion, *places)
        return self.ratios[key]

    def length(self, link: str, p: str, q: str) -> int:
        """Length of a bar: as the scene gives it where it does, else from the shape."""
        for placing in self.pen.scene.link(link).placings:
            for first, second, quantity in lengths_of(placing):
                if {first, second} == {p, q}:
                    return self.pen.given("length", quantity, name=p + q)
        with self.pen.on(Part.SHAPE, Plane.NUMBERS):
            return self.pen.draw(distance, self.local(link, p), self.local(link, q))


def place_all(pen: Pen, link: Link) -> Placed:
    """Every point of a link in its own axes."""
    placed: Placed = {}
    for placing in link.placings:
        placed[placing.point] = place(pen, placing, placed)
    return placed


def place(pen: Pen, placing: Placing, placed: Placed, name: str = "") -> int:
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
