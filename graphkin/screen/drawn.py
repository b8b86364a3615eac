"""How the marks of steps follow: each is drawn from values, so the same values draw it again."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import hypot, pi
from typing import Any

from graphkin.arithmetic import larger, pick, smaller
from graphkin.paper.centre import FAR as ENDLESS
from graphkin.paper.centre import STRAIGHT
from graphkin.paper.closing import ends_of_bar
from graphkin.paper.desk import TINY, above_foot
from graphkin.paper.images import undrawn_sides
from graphkin.paper.layout import BEYOND, SWEEP
from graphkin.paper.marks import Arc, Circle, Line, Mark, Polyline
from graphkin.paper.style import VECTORS
from graphkin.paper.symbols import SHORT
from graphkin.paper.tips import BEYOND as BEYOND_TIPS
from graphkin.paper.tips import PARALLEL, parallel_velocities
from graphkin.paper.trial_gaps import gap_lines
from graphkin.paper.trial_marks import NEAR as SHORTEST
from graphkin.paper.trial_marks import leg_start
from graphkin.plane import Circle as Round
from graphkin.plane import Line as Carrier
from graphkin.plane import Ratio, Vector, cross, dot
from graphkin.screen.binding import Binding, only_at_start
from graphkin.screen.places import place_of
from graphkin.screen.poses import unit
from graphkin.screen.visible import ALIKE, Seen
from graphkin.steps.program import Plane

FULL, NEAR, FAR, LAST = 0, 1, 2, 3
"""The parts of a construction line: all of it, before its first point, after its last, its end."""
BEYOND_BOTH = ("square-to", "parallel-to", "along-bar")
"""The lines of a plan of which only the parts beyond their points are drawn."""
SQUARE, ROOMY = 2.0, 6.0
"""Side of the mark of a right angle, and of a triangle that has room for one, in mm."""


class Steps(Seen):
    """How the marks of the steps of one field follow."""

    def binding(self, mark: Mark) -> Binding | None:
        """How a mark of a step follows; None where none of its values gives it."""
        number = mark.step
        assert number is not None
        if isinstance(mark, Circle):
            return self.circle(number, mark)
        if isinstance(mark, Arc):
            return self.arc(number)
        if isinstance(mark, Polyline):
            return self.polygon(number, mark)
        if isinstance(mark, Line):
            return self.line(number, mark)
        return None

    def circle(self, number: int, mark: Circle) -> Binding:
        """A point, a pole or a centre; a centre shows where its field has room for it."""
        value = self.value(number)
        if not isinstance(value, Ratio):
            is_inflection = self.key(number) == "inflection-point"
            return self.bench.at(value, self.within(value) if is_inflection else self.seen(number))
        if self.key(number) == "pin-centre":
            return self.bench.at(value.start)
        return self.bench.at(place_of(value), self.within(place_of(value)))

    @cached_property
    def ends(self) -> dict[int, tuple[Any, Any]]:
        """The tails and tips of vectors that are set on the mechanism by steps that are points."""
        found = {}
        for number, _, value in self.bench.places.drawing.steps(Plane.MECHANISM):
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
        if self.key(number) == "close":
            drawing, spots = self.bench.places.drawing, self.bench.places.spots
            centre, pin = ends_of_bar(drawing, number, self.step(number))
            return self.arc_about(spots[centre], spots[pin], SWEEP)
        value = self.value(number)
        if not isinstance(value, Round):
            return None
        span = self.bench.places.arc_span(number, self.bench.field.mm)
        return self.bench.arc(value.centre, value.radius, span)

    def arc_about(self, tail: Any, tip: Any, sweep: float) -> Binding:
        """An arc about a centre through a point, so many mm of it on both sides of that."""
        way, mm, degrees = self.bench.shelf.lifted(tip - tail), self.bench.field.mm, 180 / pi
        radius = abs(way)
        bearing = way.imag.do("atan2", way.real) * degrees
        half = smaller(degrees * sweep / (radius * mm), 60.0)
        return self.bench.arc(tail, radius, (bearing - half, bearing + half), radius * mm - SHORT)

    def polygon(self, number: int, mark: Polyline) -> Binding | None:
        """An arrowhead, the mark of a right angle, or the inflection circle."""
        ends = self.vector(number)
        cls = mark.cls.split()[0]
        if cls == "arrowhead":
            return only_at_start if ends is None else self.bench.head(*ends, self.seen(number))
        if cls == "square-mark":
            return self.square(number)
        value = self.value(number)
        if isinstance(value, Round):
            mm, lift = self.bench.field.mm, self.bench.shelf.lifted
            size = lift(value.radius) * mm
            centre = self.bench.page(value.centre)
            rect = self.bench.rect(above_foot(self.bench.room))
            shown = smaller(size - TINY, STRAIGHT - size)
            shelf = self.bench.shelf
            return lambda _: [
                "i",
                self.bench.condition(shown),
                shelf.point(centre),
                shelf.number(size),
                rect,
            ]
        return None

    def square(self, number: int) -> Binding | None:
        """The mark of a right angle at the corner of a triangle on the mechanism."""
        value, other = self.value(number), self.part_of(number).faces
        if other is None:
            return None
        bench = self.bench
        corner, pivot = bench.page(value.point), bench.page(other)
        first = unit(pivot - corner)
        low, high = bench.places.span(number, bench.field.mm)
        along = bench.places.way(number).conjugate()
        second = along * pick(-low > high, -1.0, 1.0)
        places = [corner + SQUARE * way for way in (first, first + second, second)]
        large, seen = abs(pivot - corner) - ROOMY, self.seen(number)
        return bench.corners(places, large if seen is None else smaller(large, seen))

    # --- lines ---------------------------------------------------------------------------------

    def line(self, number: int, mark: Line) -> Binding | None:
        """A vector, a part of a construction line, or a leg of a triangle."""
        ends, cls = self.vector(number), mark.cls.split()[0]
        if ends is not None and cls in VECTORS:
            return self.bench.between(*ends, shown=self.seen(number))
        if cls == "centre":
            return self.circle(number, Circle(0, 0, 1, ""))
        if self.key(number) == "instant-centre" and cls == "ray":
            return self.tips(number)
        if self.key(number) == "guide-centre":
            return self.endless(number)
        for start, end in self.legs(number):
            if self.is_at(mark, start, end):
                is_leg = cls in ("trial", "trial-line") or self.key(number) == "similar-point"
                shown = self.apart(end, start) - SHORTEST if is_leg else self.seen(number)
                return self.bench.between(start, end, shown=shown)
        if isinstance(self.drawn(number), Carrier) and number in self.layout.spans:
            return self.part(number, self.which(number, mark))
        return None

    def endless(self, number: int) -> Binding:
        """The ray to the centre of a block and its guide, which lies at infinity."""
        start, way, _ = map(self.bench.shelf.lifted, self.value(number))
        end = start + unit(way) * (ENDLESS / self.bench.field.mm)
        return self.bench.between(start, end, above_foot(self.bench.room))

    def tips(self, number: int) -> Binding | None:
        """The line through the tips of two velocities, while these are parallel."""
        drawing, step, lift = self.bench.places.drawing, self.step(number), self.bench.shelf.lifted
        pole, scale = self.value(step.args[0]), drawing.at_scale(Plane.VELOCITIES, 1)
        found = parallel_velocities(drawing, step).values()
        if not found:
            return None
        ways = [lift(self.value(image) - pole) * scale for _, image in found]
        tips = [lift(self.value(place)) + way for (place, _), way in zip(found, ways, strict=True)]
        on = unit(tips[1] - tips[0]) * (BEYOND_TIPS / self.bench.field.mm)
        shown = PARALLEL - abs(cross(unit(ways[0]), unit(ways[1])))
        room = above_foot(self.bench.room)
        return self.bench.between(tips[0] - on, tips[1] + on, room, shown)

    def is_at(self, mark: Line, start: Any, end: Any) -> bool:
        """Whether a line was drawn between two places."""
        now = self.bench.shelf.now
        x0, y0 = self.bench.field(complex(now(start)))
        x1, y1 = self.bench.field(complex(now(end)))
        return max(hypot(x0 - mark.x1, y0 - mark.y1), hypot(x1 - mark.x2, y1 - mark.y2)) < ALIKE

    def legs(self, number: int) -> Iterator[tuple[Any, Any]]:
        """The lines between two points that a step may be drawn with."""
        value, step, shelf = self.value(number), self.step(number), self.bench.shelf
        for start, end in self.part_of(number).legs:
            yield shelf.lifted(start), shelf.lifted(end)
        if isinstance(value, Carrier):
            return
        drawing = self.bench.places.drawing
        if number in drawing.tags and leg_start(self.desk, step) is not None:
            yield shelf.lifted(self.value(step.args[0])), shelf.lifted(value)
        if self.key(number) == "between":
            yield self.divided(number)
        for _, tail, tip in gap_lines(number, step, self.lifted, self.bench.field.mm):
            yield tail, tip
        if self.key(number) == "similar-point":
            for one, other in undrawn_sides(drawing, number, step):
                yield shelf.lifted(self.value(one)), shelf.lifted(self.value(other))

    def lifted(self, number: int) -> Any:
        """The value of a step as a traced number; a line as it is."""
        value = self.value(number)
        return value if isinstance(value, Carrier) else self.bench.shelf.lifted(value)

    def divided(self, number: int) -> tuple[Any, Any]:
        """The line through the two trials of a point, as far as the right one and a little more."""
        lift = self.bench.shelf.lifted
        first, last = (lift(self.value(arg)) for arg in self.step(number).args[:2])
        way = unit(last - first)
        low = high = lift(0.0)
        for point in (last, lift(self.value(number))):
            along = dot(point - first, way)
            low, high = smaller(low, along), larger(high, along)
        beyond = BEYOND / 2 / self.bench.field.mm
        return first + way * (low - beyond), first + way * (high + beyond)

    def is_short(self, mark: Line) -> bool:
        """Whether a mark is all there is of a line of which only the ends are drawn elsewhere."""
        number = mark.step
        if number is None or self.key(number) not in BEYOND_BOTH:
            return False
        if number in self.bench.places.drawing.tags or number not in self.layout.spans:
            return False
        low, high = self.layout.spans[number]
        return mark.cls == "construction" and high - low <= 2 * BEYOND + TINY

    def part(self, number: int, which: int) -> Binding:
        """A part of a construction line, cut at the edge of what its field can grow to."""
        bench, line = self.bench, self.value(number)
        origin = bench.page(line.point)
        way = bench.places.way(number).conjugate()
        low, high = bench.places.span(number, bench.field.mm)
        shown = self.seen(number)
        if self.part_of(number).is_beyond:
            span = high - low - (2 * BEYOND + TINY)
            shown = span if shown is None else smaller(span, shown)
        shelf, rect = bench.shelf, bench.rect(above_foot(bench.room))
        return lambda _: [
            "s",
            bench.condition(shown),
            *map(shelf.point, (origin, way)),
            *map(shelf.number, (low, high)),
            which,
            rect,
        ]

    def which(self, number: int, mark: Line) -> int:
        """Which part of its line a mark is."""
        if self.key(number) == "ray":
            return LAST
        if self.key(number) not in BEYOND_BOTH or number in self.bench.places.drawing.tags:
            return FULL
        low, high = self.layout.spans[number]
        if high - low <= 2 * BEYOND + TINY:
            return NEAR
        value = self.drawn(number)
        x, y = self.bench.field(value.point)
        u, v = self.bench.field.way(value.along)
        middle = ((mark.x1 + mark.x2) / 2 - x) * u + ((mark.y1 + mark.y2) / 2 - y) * v
        is_low = abs(middle - low) < abs(middle - high)
        return NEAR if is_low == (abs(low) < abs(high)) else FAR
