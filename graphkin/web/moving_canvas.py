"""How the marks of constructions follow on a moving page: the same drawing in traced numbers.

The field of a moving page, in which paper's symbols are drawn as marks in traced numbers.

A symbol starts at a place and extends along a direction. A pose carries the parts at constant
distances, so that a page holds the pose and the distances rather than each corner.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import pi
from typing import Any, NamedTuple

from msgspec import Struct, field

from graphkin.construction.centres.instant_centre import PARALLEL
from graphkin.construction.core.component import TriangleComponent
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import BEYOND, SWEEP, Layout
from graphkin.construction.core.naming import NEAR as SHORTEST
from graphkin.construction.core.naming import TINY
from graphkin.construction.core.paper_canvas import BEYOND_TIPS, STRAIGHT, above_foot
from graphkin.construction.core.paper_canvas import FAR as ENDLESS
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.tape.traced import TracedNumber
from graphkin.drawing.field import XY, Carried, Field
from graphkin.drawing.marks import Mark
from graphkin.drawing.symbols import SHORT
from graphkin.numbers.arithmetic import larger, pick, smaller
from graphkin.numbers.plane import Circle, Ratio, cross, dot
from graphkin.web.field_binder import Binding, FieldBinder, Record, only_at_start
from graphkin.web.moving_sheet import BodyPose, is_one, place_of, unit

Ends = tuple[Any, Any]
FULL, NEAR, FAR, LAST = 0, 1, 2, 3
"""The parts of a construction line: all, before its first point, after its last point, its end."""
SQUARE, ROOMY = 2.0, 6.0
"""Side of a right-angle mark, and the least side of a triangle that has room for one, in mm."""
ALIKE = 1e-6
"""Distance in mm within which two places of the page count as one."""


class Stroke(Struct, frozen=True):
    """How the marks drawn together follow: the mark, its label, and the head of a vector."""

    mark: Binding
    label: Binding = only_at_start
    head: Binding = only_at_start
    is_vector: bool = False


class MovingCanvas(Struct, frozen=True):
    """The strokes of one step on a moving field, evaluated only where they are drawn.

    ``loci`` are the strokes that draw a line beyond the points on it, the near one first.
    """

    binder: FieldBinder
    layout: Layout
    number: int
    strokes: list[Stroke] = field(default_factory=list)
    loci: list[Stroke] = field(default_factory=list)

    @property
    def drawing(self) -> Drawing:
        """The sheet at the scene's position."""
        return self.binder.places.drawing

    @property
    def step(self) -> Step:
        return self.drawing.trace.program.steps[self.number]

    @property
    def mm(self) -> float:
        """Millimetres of paper per unit of the field."""
        return self.binder.field.mm

    def value(self, number: int) -> Any:
        return self.binder.places.values[number]

    def size(self, way: Any) -> Any:
        """The drawn length of a displacement of the mechanism, in mm."""
        return abs(self.binder.tape.lifted(way)) * self.binder.field.mm

    def put(
        self, mark: Callable[[], Binding], label: Callable[[], Binding] = lambda: only_at_start
    ) -> Stroke:
        """A stroke whose bindings are evaluated at their first use."""
        self.strokes.append(Stroke(once(mark), once(label)))
        return self.strokes[-1]

    @property
    def seen(self) -> Any:
        """The excess of a triangle on the mechanism over the least size that is drawn, in mm.

        None for a step that belongs to no such triangle.
        """
        kind = construction(self.step)
        if not isinstance(kind, TriangleComponent) or self.step.plane is not Plane.MECHANISM:
            return None
        return kind.room(self)

    def while_seen(self, shown: Any) -> Any:
        """A condition combined with the condition of the triangle that the stroke belongs to."""
        seen = self.seen
        return shown if seen is None else smaller(shown, seen)

    def within(self, point: Any) -> Any:
        """How far inside the rectangle of the field's growth a point lies, less 2 mm, in mm."""
        left, top, right, bottom = self.binder.room
        place = self.binder.page(point)
        x, y = place.real, place.imag
        across = smaller(x - left, right - x)
        return smaller(across, smaller(y - top, bottom - y)) - 2.0 + ALIKE

    # --- on the mechanism ----------------------------------------------------------------------

    def vector(self, name: str, look: str, tail: Any, tip: Any) -> None:
        """Draw a vector between two moving points; a centre's vector holds as drawn only."""
        if isinstance(self.value(self.number), Ratio):
            self.put(lambda: only_at_start)
            return
        binder = self.binder
        self.strokes.append(
            Stroke(
                once(lambda: binder.between(tail, tip, shown=self.seen)),
                once(lambda: self.beside_vector(tail, tip)),
                once(lambda: binder.head(tail, tip, self.seen)),
                is_vector=True,
            )
        )

    def beside_vector(self, tail: Any, tip: Any) -> Binding:
        """Bind the label of a vector, which shows while the vector is long enough to be named."""
        tail, tip = (self.binder.page(end) for end in (tail, tip))
        pose = BodyPose((tail + tip) * 0.5, unit(tip - tail))
        return self.binder.beside(pose, self.while_seen(abs(tip - tail) - TINY))

    def point(self, name: str, at: Any) -> None:
        """Draw a small point."""
        self.put(*[lambda: self.binder.at(at, self.seen)] * 2)

    def segment(self, start: Any, end: Any) -> None:
        """Draw a thin line between two moving points."""
        self.put(lambda: self.binder.between(start, end, shown=self.seen))

    def line(self, look: str = "", name: str | None = None) -> bool:
        """Draw the step's own line."""
        self.put(lambda: self.part(FULL))
        return True

    def line_beyond(self) -> None:
        """Draw the step's own line while it extends beyond its own two points."""
        self.put(lambda: self.part(FULL, is_beyond=True))

    def line_end(self, name: str) -> None:
        """Draw the end of the step's own line."""
        self.put(lambda: self.part(LAST))

    def part(self, which: int, *, is_beyond: bool = False) -> Binding:
        """Bind a part of the step's own line, clipped where the field can grow no further."""
        binder, line, number = self.binder, self.value(self.number), self.number
        origin = binder.page(line.point)
        way = binder.places.way(number).conjugate()
        low, high = binder.places.span(number, self.mm)
        shown = self.while_seen(high - low - (2 * BEYOND + TINY)) if is_beyond else self.seen
        tape, rect = binder.tape, binder.rect(above_foot(binder.room))
        return lambda _: [
            "s",
            binder.condition(shown),
            *map(tape.point, (origin, way)),
            *map(tape.number, (low, high)),
            which,
            rect,
        ]

    def arc(self, name: str) -> None:
        """Draw the arc that is the step's own value."""
        self.put(self.arc_on_points)

    def arc_on_points(self) -> Binding:
        """Bind the part of the step's own circle that holds the points found on it."""
        circle = self.value(self.number)
        span = self.binder.places.arc_span(self.number, self.mm)
        return self.binder.arc(circle.centre, circle.radius, span)

    def swing(self, centre: Any, end: Any) -> None:
        """Draw the arc along which a point was carried about a centre."""
        self.put(lambda: self.arc_about(centre, end, SWEEP / 2))

    def opening(self, name: str, centre: Any, end: Any) -> None:
        """Draw the part of the arc about a centre that finds a point on it."""
        self.put(lambda: self.arc_about(centre, end, SWEEP))

    def arc_about(self, centre: Any, end: Any, sweep: float) -> Binding:
        """Bind an arc about a centre through ``end``, extended by ``sweep`` mm to both sides."""
        way, degrees = self.binder.tape.lifted(end - centre), 180 / pi
        radius = abs(way)
        bearing = way.imag.do("atan2", way.real) * degrees
        half = smaller(degrees * sweep / (radius * self.mm), 60.0)
        span = bearing - half, bearing + half
        return self.binder.arc(centre, radius, span, radius * self.mm - SHORT)

    def right_angle(self, toward: Any) -> None:
        """Draw the mark of a right angle at the start of the step's line."""
        self.put(lambda: self.square(toward))

    def square(self, toward: Any) -> Binding:
        """Bind the mark of a right angle at the corner of a triangle on the mechanism."""
        binder = self.binder
        corner, pivot = binder.page(self.value(self.number).point), binder.page(toward)
        first = unit(pivot - corner)
        low, high = binder.places.span(self.number, self.mm)
        along = binder.places.way(self.number).conjugate()
        second = along * pick(-low > high, -1.0, 1.0)
        places = [corner + SQUARE * way for way in (first, first + second, second)]
        return binder.corners(places, self.while_seen(abs(pivot - corner) - ROOMY))

    # --- plans -------------------------------------------------------------------------------

    def locus(self, name: str, text: str) -> None:
        """Draw the step's own line beyond the points on it, in two strokes."""
        self.loci.append(self.put(lambda: self.part(NEAR), self.beside_locus))
        self.loci.append(self.put(lambda: self.part(FAR), self.beside_locus))

    def beside_locus(self) -> Binding:
        """Bind the label next to the far end of a construction line; of equal ends the high one."""
        low, high = self.binder.places.span(self.number, self.mm)
        way = self.binder.places.way(self.number).conjugate()
        end = pick(abs(low) < abs(high) + ALIKE, high, low)
        origin = self.binder.page(self.value(self.number).point)
        return self.binder.beside(BodyPose(origin + way * end, way))

    @property
    def undrawn(self) -> Stroke | None:
        """The far end of a line that is too short for two strokes at the scene's position."""
        if not self.loci or self.number in self.drawing.auxiliary:
            return None
        low, high = self.layout.spans[self.number]
        return self.loci[-1] if high - low <= 2 * BEYOND + TINY else None

    def image(self) -> None:
        """Draw the step's own point."""
        self.point("", self.value(self.number))

    def pole(self) -> None:
        """Draw the pole, which does not move."""
        self.image()

    def side(self, start: Any, end: Any) -> None:
        """Draw a side of the image of a link."""
        self.leg("", "", start, end)

    def image_aside(self) -> None:
        """Draw the point of an auxiliary plan."""
        self.image()

    def leg(self, name: str, look: str, start: Any, end: Any) -> None:
        """Draw a thin line between two moving points while they are apart."""
        self.put(lambda: self.joining(start, end))

    def joining(self, start: Any, end: Any) -> Binding:
        """Bind a line between two points while they are apart."""
        start, end = map(self.binder.tape.lifted, (start, end))
        return self.binder.between(start, end, shown=self.size(end - start) - SHORTEST)

    def stretch(self, name: str, look: str, at: Any, along: Any, low: Any, high: Any) -> None:
        """Draw a thin line along a line through a point, from one distance to another."""
        self.put(lambda: self.joining(at + along * low, at + along * high))

    def through(self, first: Any, second: Any, third: Any) -> None:
        """Draw the line through two points as far as a third, slightly beyond them all."""
        self.put(lambda: self.around(*map(self.binder.tape.lifted, (first, second, third))))

    def around(self, first: Any, last: Any, third: Any) -> Binding:
        """Bind the line of ``through`` while its first two points are apart."""
        lift = self.binder.tape.lifted
        way = unit(last - first)
        low = high = lift(0.0)
        for point in (last, third):
            along = dot(point - first, way)
            low, high = smaller(low, along), larger(high, along)
        beyond = BEYOND / 2 / self.mm
        ends = first + way * (low - beyond), first + way * (high + beyond)
        return self.binder.between(*ends, shown=self.size(last - first) - SHORTEST)

    # --- centres -----------------------------------------------------------------------------

    def centre(self, value: Ratio) -> bool:
        """Draw a moving centre, which shows where the field has room for it."""
        self.put(*[lambda: self.in_room(place_of(value))] * 2)
        return True

    def in_room(self, place: Any) -> Binding:
        """Bind a point that shows where the field has room for it."""
        return self.binder.at(place, self.within(place))

    def ring(self, at: Any) -> None:
        """Draw the ring around a pin."""
        self.put(lambda: self.binder.at(at), lambda: self.in_room(at))

    def spot(self, at: Any) -> None:
        """Draw a small point, which shows where the field has room for it."""
        self.put(lambda: self.in_room(at), lambda: self.binder.at(at))

    def dimension(self, name: str, start: Any, end: Any) -> None:
        """Draw a dimension line between two moving points."""
        self.put(lambda: self.joining(start, end), lambda: self.beside_vector(start, end))

    def circle(self, circle: Circle, look: str) -> None:
        """Draw a circle while it is neither a point nor straight."""
        self.put(lambda: self.around_centre(circle))

    def around_centre(self, circle: Circle) -> Binding:
        """Bind the part of a circle that lies in the rectangle that the field can grow to."""
        binder = self.binder
        size = binder.tape.lifted(circle.radius) * self.mm
        centre = binder.page(circle.centre)
        rect = binder.rect(above_foot(binder.room))
        shown = smaller(size - TINY, STRAIGHT - size)
        return lambda _: [
            "i",
            binder.condition(shown),
            binder.tape.point(centre),
            binder.tape.number(size),
            rect,
        ]

    def away(
        self, start: Any, way: Any, text: str, *, ray: bool = True, headed: bool = True
    ) -> None:
        """Draw the ray towards a point at infinity."""
        self.put(lambda: self.endless(start, way))

    def endless(self, start: Any, way: Any) -> Binding:
        """Bind the ray towards a point at infinity."""
        start, way = map(self.binder.tape.lifted, (start, way))
        end = start + unit(way) * (ENDLESS / self.mm)
        return self.binder.between(start, end, above_foot(self.binder.room))

    def through_tips(self, one: Ends, other: Ends) -> None:
        """Draw the line through the tips of two vectors while the vectors are parallel."""
        self.put(lambda: self.tips(one, other))

    def tips(self, *vectors: Ends) -> Binding:
        """Bind the line of ``through_tips``."""
        lift = self.binder.tape.lifted
        ways = [lift(way) for _, way in vectors]
        first, last = (lift(tail) + way for (tail, _), way in zip(vectors, ways, strict=True))
        on = unit(last - first) * (BEYOND_TIPS / self.mm)
        shown = PARALLEL - abs(cross(*map(unit, ways)))
        room = above_foot(self.binder.room)
        return self.binder.between(first - on, last + on, room, shown)

    def holds(self, place: Any) -> bool:
        """Draw every place; the page cuts what is beyond its field."""
        return True

    def note(self, text: str, lead: str = "") -> None:
        """Ignore a note, which holds for the drawn position alone."""


def once(made: Callable[[], Binding]) -> Binding:
    """A binding that is evaluated when a mark first asks for it."""
    found = cache(made)

    def bound(mark: Mark) -> Record | None:
        return found()(mark)

    return bound


class Local(NamedTuple):
    """A place of the page in the axes of the pose that carries it."""

    pose: BodyPose
    at: complex

    @property
    def on_page(self) -> Any:
        return self.pose.origin + self.pose.way * self.at if self.at else self.pose.origin


class MovingCoordinate(TracedNumber):
    """A coordinate of a place that a pose carries."""

    __slots__ = ("local",)

    def __init__(self, number: TracedNumber, local: Local) -> None:
        super().__init__(number.graph, number.node)
        self.local = local


class MovingPlace(Carried):
    """A place on a moving page."""

    local: Local

    def __new__(cls, local: Local) -> MovingPlace:
        """The place with both its coordinates."""
        at = local.on_page
        found = super().__new__(
            cls, (MovingCoordinate(at.real, local), MovingCoordinate(at.imag, local))
        )
        found.local = local
        return found

    def toward(self, end: XY) -> tuple[Any, XY]:
        """The distance to another place of the page, and the unit direction towards it."""
        assert isinstance(end, MovingPlace)
        way = self.local.pose.way
        across = end.local.on_page - self.local.on_page
        if not is_one(way, end.local.pose.way):
            return abs(across), MovingWay(across / abs(across))
        along = dot(across, way)
        return (along, MovingWay(way)) if along > 0 else (-along, MovingWay(way, -1))

    def across(self, way: XY, along: Any, aside: Any) -> XY:
        """The place ``along`` a unit direction from this one and ``aside`` to its right."""
        pose, here = self.local
        way = (
            way
            if isinstance(way, MovingWay)
            else MovingWay(pose.way.of_constant(1.0) * complex(*way))
        )
        if not is_one(pose.way, way.way):
            pose, here = BodyPose(self.local.on_page, way.way), 0j
        if isinstance(along, TracedNumber):
            pose, along = BodyPose(pose.origin + way.way * (along * way.sense), way.way), 0.0
        if isinstance(aside, TracedNumber):
            pose, aside = BodyPose(pose.origin + way.way * (aside * (1j * way.sense)), way.way), 0.0
        return MovingPlace(Local(pose, here + way.sense * complex(along, aside)))


class MovingWay(tuple[Any, Any]):
    """A unit direction of a moving page: a traced direction or its opposite."""

    way: TracedNumber
    sense: int

    def __new__(cls, way: TracedNumber, sense: int = 1) -> MovingWay:
        """The direction with both its components."""
        found = super().__new__(cls, (way.real * sense, way.imag * sense))
        found.way, found.sense = way, sense
        return found


class MovingField(Field, frozen=True):
    """A field of a moving page."""

    binder: FieldBinder

    def __call__(self, point: Any) -> XY:
        """The place on the page of a traced point of the drawing."""
        upright = self.binder.tape.lifted(1 + 0j)
        return MovingPlace(Local(BodyPose(self.binder.page(point), upright), 0j))

    def way(self, vector: Any) -> XY:
        """The unit direction on the page of a direction of the drawing."""
        way = self.binder.tape.lifted(vector)
        return MovingWay((way / abs(way)).conjugate())
