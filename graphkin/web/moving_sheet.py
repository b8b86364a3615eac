"""One moving sheet: its bodies, and the drawn length of its lines and arcs.

The traced pose of a moving body: one of its points and a direction.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import ENDLESS, NOISE, Drawing
from graphkin.construction.core.layout import BEYOND, FAR, SWEEP, joined_points
from graphkin.construction.core.program import Part
from graphkin.construction.core.run import Trace
from graphkin.construction.tape.emitted import TapeOutputs
from graphkin.numbers.arithmetic import larger, np, pick, smaller
from graphkin.numbers.plane import Circle, Ratio, dot


class BodyPose(NamedTuple):
    """The pose of a body: one of its points and a unit direction that turns with it."""

    origin: Any
    way: Any

    def is_same(self, other: BodyPose) -> bool:
        """Whether both are the same pose at every position."""
        return is_one(self.origin, other.origin) and is_one(self.way, other.way)


def is_one(one: Any, other: Any) -> bool:
    """Whether two traced points or directions are the same at every position."""
    return bool((one.node, one.imag.node) == (other.node, other.imag.node))


def unit(way: Any) -> Any:
    return way / abs(way)


class MovingSheet(Struct, frozen=True, dict=True):
    """One moving sheet: its drawing, and the traced values of its steps."""

    drawing: Drawing
    trace: Trace
    tape: TapeOutputs

    @property
    def values(self) -> Mapping[int, Any]:
        return self.trace.values

    @cached_property
    def moving(self) -> Drawing:
        """The drawing in traced numbers."""
        return replace(self.drawing, trace=self.trace, chosen=self.drawing)

    @property
    def spots(self) -> Mapping[str, Any]:
        """The place of every point of the drawing, by its letter."""
        return self.moving.standing.places

    def pose(self, link: str) -> BodyPose | None:
        """The pose of a link; None where no direction of the link is known."""
        points = self.drawing.scene.link(link).points
        places = [p for name, p in self.moving.positions.items() if name in points]
        with self.tape.choosing():
            way = self.moving.standing.axis(link)
        if way is None or not places:
            return None
        return BodyPose(self.tape.lifted(places[0]), self.tape.lifted(way))

    def turn_of(self, link: str) -> Any:
        """The rotation of a link since the drawn position, as a unit vector."""
        with self.tape.choosing():
            way = self.moving.standing.axis(link)
        return self.tape.lifted(
            1 + 0j if way is None else way * complex(self.tape.now(way)).conjugate()
        )

    def points_on(self, number: int) -> list[int]:
        """The steps whose points a line or an arc must reach, as in the layout."""
        drawing, drawn = self.drawing, self.drawing.trace.values
        numbers = [drawing.results.get(c, c) for c in drawing.children.get(number, ())]
        numbers += joined_points(drawing, number)
        return [each for each in numbers if isinstance(drawn[each], complex | Ratio)]

    def reached(self, number: int, point: int, mm: float) -> Any:
        """The distance along a line to a point on it, in mm."""
        line, way, value = self.values[number], self.way(number), self.values[point]
        if not isinstance(value, Ratio):
            return dot(self.tape.lifted(value) - line.point, way) * mm
        start, shift, size = (self.tape.lifted(part) for part in value)
        reach, zero = self.drawing.reach, self.tape.lifted(0.0)
        far, step = zero, self.drawing.trace.program.steps[point]
        steps = self.drawing.trace.program.steps
        if step.part is Part.CENTRE and step.by_hand and number in steps[step.by_hand].args:
            ahead = pick(abs(size) == 0, shift, shift * size.conjugate())
            far = dot(unit(ahead), way) * (FAR * reach * mm)
        near = abs(size) * (ENDLESS * reach) > abs(shift)
        here = dot(place_of(Ratio(start, shift, size)) - line.point, way) * mm
        least = NOISE * (self.drawing.largest or 1.0)
        everywhere = (abs(size) <= least) & (abs(shift) <= least * reach)
        return pick(everywhere, zero, pick(near, here, far))

    @cached_property
    def ways(self) -> dict[int, Any]:
        """The directions of lines, filled as they are needed."""
        return {}

    def way(self, number: int) -> Any:
        """The unit direction of a line."""
        if number not in self.ways:
            self.ways[number] = unit(self.tape.lifted(self.values[number].along))
        return self.ways[number]

    @cached_property
    def spans(self) -> dict[int, tuple[Any, Any]]:
        """The drawn parts of lines, filled as they are needed."""
        return {}

    def span(self, number: int, mm: float) -> tuple[Any, Any]:
        """The drawn part of a line in mm from its own point, as in the layout."""
        if number not in self.spans:
            self.spans[number] = self.span_of(number, mm)
        return self.spans[number]

    def span_of(self, number: int, mm: float) -> tuple[Any, Any]:
        """Compute the drawn part of a line."""
        low = high = self.tape.lifted(0.0)
        for point in self.points_on(number):
            along = self.reached(number, point, mm)
            low, high = smaller(low, along), larger(high, along)
        return low - BEYOND, high + BEYOND

    def arc_span(self, number: int, mm: float) -> tuple[Any, Any]:
        """The drawn part of an arc in degrees, as in the layout."""
        circle: Circle = self.values[number]
        degrees = 180 / np.pi
        half = smaller(degrees * SWEEP / (self.tape.lifted(circle.radius) * mm), 60.0)
        low = high = None
        for point in self.points_on(number):
            way = self.tape.lifted(self.values[point] - circle.centre)
            angle = way.imag.do("atan2", way.real) * degrees
            low = angle if low is None else smaller(low, angle)
            high = angle if high is None else larger(high, angle)
        assert low is not None and high is not None
        return low - half, high + half


def place_of(centre: Ratio) -> Any:
    """The point of a centre or pole."""
    return centre.start + centre.shift / centre.size
