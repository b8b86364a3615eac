"""How the marks of steps follow: each is drawn from values, so the same values draw it again."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import hypot, pi
from typing import Any

from graphkin.construction.centres.instant_centre import PARALLEL
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import BEYOND, SWEEP
from graphkin.construction.core.paper_canvas import BEYOND_TIPS, STRAIGHT
from graphkin.construction.core.paper_canvas import FAR as ENDLESS
from graphkin.construction.core.plot import above_foot
from graphkin.construction.core.program import Plane
from graphkin.construction.core.too_short import NEAR as SHORTEST
from graphkin.construction.core.too_short import TINY
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline
from graphkin.drawing.style import AUXILIARY, VECTORS
from graphkin.drawing.symbols import SHORT
from graphkin.numbers.arithmetic import pick, smaller
from graphkin.numbers.plane import Circle as Round
from graphkin.numbers.plane import Line as Carrier
from graphkin.numbers.plane import Vector, cross
from graphkin.web.body_pose import unit
from graphkin.web.field_binder import Binding, only_at_start
from graphkin.web.visible_steps import ALIKE, VisibleSteps

FULL, NEAR, FAR, LAST = 0, 1, 2, 3
"""The parts of a construction line: all of it, before its first point, after its last, its end."""
BEYOND_BOTH = ("square-to", "parallel-to", "along-bar")
"""The lines of a plan of which only the parts beyond their points are drawn."""
SQUARE, ROOMY = 2.0, 6.0
"""Side of the mark of a right angle, and of a triangle that has room for one, in mm."""


class Steps(VisibleSteps, frozen=True, dict=True):
    """How the marks of the steps of one field follow."""

    def binding(self, mark: Mark) -> Binding | None:
        """How a mark of a step follows; None where none of its values gives it."""
        number = mark.step
        assert number is not None
        if isinstance(mark, CircleMark):
            return self.circle(number, mark)
        if isinstance(mark, Arc):
            return self.arc(number)
        if isinstance(mark, Polyline):
            return self.polygon(number, mark)
        if isinstance(mark, LineMark):
            return self.line(number, mark)
        return None

    def circle(self, number: int, mark: CircleMark) -> Binding:
        """A point, a pole or a centre; a centre shows where its field has room for it."""
        part = self.part_of(number)
        if part.stands is None:
            return self.binder.at(self.value(number), self.seen(number))
        return self.binder.at(part.place, self.within(part.place) if part.is_cut else None)

    @cached_property
    def ends(self) -> dict[int, tuple[Any, Any]]:
        """The tails and tips of vectors that are set on the mechanism by steps that are points."""
        found = {}
        for number, _, value in self.binder.places.drawing.steps(Plane.MECHANISM):
            if isinstance(value, complex) and (ends := self.part_of(number).ends) is not None:
                found[number] = ends
        return found

    def vector(self, number: int) -> tuple[Any, Any] | None:
        """Tail and tip of the vector of a step, if it has one."""
        value = self.value(number)
        if isinstance(value, Vector):
            return value.tail, value.tip
        return self.ends.get(number)

    def arc(self, number: int) -> Binding | None:
        """A compass arc about the points on it, or the one that turns a length over."""
        if (swung := self.part_of(number).swung) is not None:
            return self.arc_about(*swung, SWEEP / 2)
        if isinstance(kind := construction(self.step(number)), ClosedGroup):
            drawing, spots = self.binder.places.drawing, self.binder.places.spots
            centre, pin = kind.ends_of_bar(drawing)
            return self.arc_about(spots[centre], spots[pin], SWEEP)
        value = self.value(number)
        if not isinstance(value, Round):
            return None
        span = self.binder.places.arc_span(number, self.binder.field.mm)
        return self.binder.arc(value.centre, value.radius, span)

    def arc_about(self, tail: Any, tip: Any, sweep: float) -> Binding:
        """An arc about a centre through a point, so many mm of it on both sides of that."""
        way, mm, degrees = self.binder.tape.lifted(tip - tail), self.binder.field.mm, 180 / pi
        radius = abs(way)
        bearing = way.imag.do("atan2", way.real) * degrees
        half = smaller(degrees * sweep / (radius * mm), 60.0)
        return self.binder.arc(tail, radius, (bearing - half, bearing + half), radius * mm - SHORT)

    def polygon(self, number: int, mark: Polyline) -> Binding | None:
        """An arrowhead, the mark of a right angle, or a circle."""
        ends = self.vector(number)
        cls = mark.cls.split()[0]
        if cls == "arrowhead":
            return only_at_start if ends is None else self.binder.head(*ends, self.seen(number))
        if cls == "square-mark":
            return self.square(number)
        value = self.value(number)
        if isinstance(value, Round):
            mm, lift = self.binder.field.mm, self.binder.tape.lifted
            size = lift(value.radius) * mm
            centre = self.binder.page(value.centre)
            rect = self.binder.rect(above_foot(self.binder.room))
            shown = smaller(size - TINY, STRAIGHT - size)
            tape = self.binder.tape
            return lambda _: [
                "i",
                self.binder.condition(shown),
                tape.point(centre),
                tape.number(size),
                rect,
            ]
        return None

    def square(self, number: int) -> Binding | None:
        """The mark of a right angle at the corner of a triangle on the mechanism."""
        value, other = self.value(number), self.part_of(number).faces
        if other is None:
            return None
        binder = self.binder
        corner, pivot = binder.page(value.point), binder.page(other)
        first = unit(pivot - corner)
        low, high = binder.places.span(number, binder.field.mm)
        along = binder.places.way(number).conjugate()
        second = along * pick(-low > high, -1.0, 1.0)
        places = [corner + SQUARE * way for way in (first, first + second, second)]
        large, seen = abs(pivot - corner) - ROOMY, self.seen(number)
        return binder.corners(places, large if seen is None else smaller(large, seen))

    # --- lines ---------------------------------------------------------------------------------

    def line(self, number: int, mark: LineMark) -> Binding | None:
        """A vector, a part of a construction line, or a leg of a triangle."""
        ends, cls = self.vector(number), mark.cls.split()[0]
        if ends is not None and cls in VECTORS:
            return self.binder.between(*ends, shown=self.seen(number))
        if cls == "centre":
            return self.circle(number, CircleMark(0, 0, 1, ""))
        if cls == "ray" and (part := self.part_of(number)).tips is not None:
            return self.tips(*part.tips)
        if cls == "ray" and part.endless is not None:
            return self.endless(*part.endless)
        for start, end in self.legs(number):
            if self.is_at(mark, start, end):
                is_leg = cls in AUXILIARY or self.key(number) == "similar-point"
                shown = self.apart(end, start) - SHORTEST if is_leg else self.seen(number)
                return self.binder.between(start, end, shown=shown)
        if isinstance(self.drawn(number), Carrier) and number in self.layout.spans:
            return self.part(number, self.which(number, mark))
        return None

    def endless(self, start: Any, way: Any) -> Binding:
        """The ray to what lies at infinity."""
        start, way = map(self.binder.tape.lifted, (start, way))
        end = start + unit(way) * (ENDLESS / self.binder.field.mm)
        return self.binder.between(start, end, above_foot(self.binder.room))

    def tips(self, *vectors: tuple[Any, Any]) -> Binding:
        """The line through the tips of two vectors, while these are parallel."""
        lift = self.binder.tape.lifted
        ways = [lift(way) for _, way in vectors]
        first, last = (lift(tail) + way for (tail, _), way in zip(vectors, ways, strict=True))
        on = unit(last - first) * (BEYOND_TIPS / self.binder.field.mm)
        shown = PARALLEL - abs(cross(*map(unit, ways)))
        room = above_foot(self.binder.room)
        return self.binder.between(first - on, last + on, room, shown)

    def is_at(self, mark: LineMark, start: Any, end: Any) -> bool:
        """Whether a line was drawn between two places."""
        now = self.binder.tape.now
        x0, y0 = self.binder.field(complex(now(start)))
        x1, y1 = self.binder.field(complex(now(end)))
        return max(hypot(x0 - mark.x1, y0 - mark.y1), hypot(x1 - mark.x2, y1 - mark.y2)) < ALIKE

    def legs(self, number: int) -> Iterator[tuple[Any, Any]]:
        """The lines between two points that a step may be drawn with."""
        tape = self.binder.tape
        for leg in self.part_of(number).legs:
            start, end = leg()
            yield tape.lifted(start), tape.lifted(end)

    def is_short(self, mark: LineMark) -> bool:
        """Whether a mark is all there is of a line of which only the ends are drawn elsewhere."""
        number = mark.step
        if number is None or self.key(number) not in BEYOND_BOTH:
            return False
        if number in self.binder.places.drawing.auxiliary or number not in self.layout.spans:
            return False
        low, high = self.layout.spans[number]
        return mark.cls == "construction" and high - low <= 2 * BEYOND + TINY

    def part(self, number: int, which: int) -> Binding:
        """A part of a construction line, cut at the edge of what its field can grow to."""
        binder, line = self.binder, self.value(number)
        origin = binder.page(line.point)
        way = binder.places.way(number).conjugate()
        low, high = binder.places.span(number, binder.field.mm)
        shown = self.seen(number)
        if self.part_of(number).is_beyond:
            span = high - low - (2 * BEYOND + TINY)
            shown = span if shown is None else smaller(span, shown)
        tape, rect = binder.tape, binder.rect(above_foot(binder.room))
        return lambda _: [
            "s",
            binder.condition(shown),
            *map(tape.point, (origin, way)),
            *map(tape.number, (low, high)),
            which,
            rect,
        ]

    def which(self, number: int, mark: LineMark) -> int:
        """Which part of its line a mark is."""
        if self.part_of(number).is_end:
            return LAST
        if self.key(number) not in BEYOND_BOTH or number in self.binder.places.drawing.auxiliary:
            return FULL
        low, high = self.layout.spans[number]
        if high - low <= 2 * BEYOND + TINY:
            return NEAR
        value = self.drawn(number)
        x, y = self.binder.field(value.point)
        u, v = self.binder.field.way(value.along)
        middle = ((mark.x1 + mark.x2) / 2 - x) * u + ((mark.y1 + mark.y2) / 2 - y) * v
        is_low = abs(middle - low) < abs(middle - high)
        return NEAR if is_low == (abs(low) < abs(high)) else FAR
