"""Lines of guides in the plane, the parallels on which points move, and guides that turn."""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping, Sequence
from math import degrees
from typing import ClassVar

from graphkin.construction.core.crossings import is_found_by_closing
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import drawn_amount, nearest_side, way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Step
from graphkin.construction.core.vocabulary import action, along_bar, meet, ray
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, cross, dot

# --- the rotation of a link ----------------------------------------------------------------------


@action("axis")
def axis_of(p: Point, q: Point, here: Point, there: Point) -> Point:
    """Direction of a link's x axis from two of its points, in the plane and in its own axes."""
    turn = (q - p) / (there - here)
    return turn / abs(turn)


@action("axis")
def direction_on_link(axis: Point, direction: Point) -> Point:
    """A direction given in a link's own axes, in the plane."""
    return axis * direction


@action("axis")
def turned_back(axis: Point, direction: Point) -> Point:
    """The axis of the link in which a direction of the plane has the given direction."""
    return axis * direction.conjugate()


@action("axis")
def axis_along(line: Line) -> Point:
    """The direction of a guide as a unit vector: the x axis of a block on it."""
    return line.along / abs(line.along)


@action("axis")
def axis_by_guide(axis: Point, here: Point, there: Point) -> Point:
    """The x axis of a link of which a line, given in its own axes, lies along a known axis."""
    line = there - here
    return axis * (line.conjugate() / abs(line))


@action("axis")
def axis_with_guide(axis: Point, here: Point, there: Point) -> Point:
    """The x axis of a block, from the axis of the link that carries its guide."""
    line = there - here
    return axis * (line / abs(line))


@action("way")
def way_between(here: Point, there: Point) -> Point:
    return there - here


@action("beside")
def point_on_link(start: Point, axis: Point, here: Point, there: Point) -> Point:
    """A point of a link, from the position of one of its points and its axis."""
    return start + axis * (there - here)


@action("beside-guide")
def beside_guide(point: Point, through: Point, along: Point) -> Real:
    """The distance of a point of a link to the left of the link's guide, in the link's axes."""
    return cross(along, point - through) / abs(along)


@action("gap")
def gap(offset: Real, here: Real, there: Real) -> Real:
    """The distance of one pin to the left of the parallel to the guide through the other pin."""
    return offset + here - there


@action("stretch")
def stretch(
    pin: Point, first: Point, offset: Real, end: Point, here: Point, there: Point, where: Real
) -> Point:
    """The vector from a pin of the link with the guide to a pin of the block, in the guide's axes.

    ``pin`` and ``first`` belong to the block. ``end`` belongs to the other link, whose guide runs
    from ``here`` towards ``there``. ``where`` is the block's coordinate.
    """
    along = there - here
    return at(where, offset) + (pin - first) - (end - here) * (along.conjugate() / abs(along))


@action("length")
def length_of(way: Point) -> Real:
    """The length of a vector."""
    return abs(way)


@action("axis")
def axis_stretched(from_pin: Point, to_pin: Point, way: Point) -> Point:
    """Direction of a guide from two pins and the vector between them in the guide's axes."""
    turn = (to_pin - from_pin) / way
    return turn / abs(turn)


@action("guide-back")
def guide_back(first: Point, axis: Point, offset: Real) -> Line:
    """The line of a guide from the block on it; the block is its offset to the left of the line."""
    return Line(first - 1j * axis * offset, axis)


@action("shifted")
def shifted(line: Line, offset: Real) -> Line:
    """The parallel to a line at a distance to its left."""
    return Line(line.point + 1j * line.along * (offset / abs(line.along)), line.along)


class GuideLine(Construction, frozen=True, kw_only=True):
    """The ``line`` of the guide of a ``block``, through the point ``start`` if it has a name."""

    between: ClassVar[tuple[str, ...]] = ("start",)
    guided: ClassVar[str] = "block"

    block: str
    start: str
    line: OwnStep

    def line_name(self, steps: Sequence[Step], role: str) -> str:
        """The line by the point that it passes through, or by its block."""
        return f"the line through {self.start}" if self.start else f"guide {self.block}"

    def path_name(self, drawing: Drawing) -> str:
        """The words for the guide of its block."""
        return way_of(drawing, self.block)

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the line; the only guide of a scene needs no name.

        For a link found with its group, the clause gives the angle.
        """
        links, steps = drawing.scene.links, drawing.trace.program.steps
        direction = steps[self.line].args[-1]
        if self.start and any(
            is_found_by_closing(steps[each]) for each in (direction, *steps[direction].args)
        ):
            return found_at_angle(drawing, self.block, self.start, self.line)
        if sum(len(link.paths) for link in links.values()) == 1 and links[self.block].slides:
            return drawing.words("step.guide")
        return drawing.words("step.guide-named", guide=way_of(drawing, self.block))


def found_at_angle(drawing: Drawing, block: str, point: str, line: int) -> str:
    """The clause for a guide through a point, at the angle found with a group."""
    angle = drawing.words.fixed(degrees(phase(drawing.trace.values[line].along)), 1)
    fields = {"q": symbol(point), "guide": way_of(drawing, block)}
    return drawing.words("step.guide-back-found", angle=angle, **fields)


class GuideAlongBar(GuideLine, frozen=True, kw_only=True):
    """The ``line`` along a bar that is already placed."""

    def line_name(self, steps: Sequence[Step], role: str) -> str:
        """Empty: the bar is not a line of its own."""
        return ""


class GuideThroughBlock(Construction, frozen=True, kw_only=True):
    """The ``line`` of a guide through its ``block``, which already has its ``axis``."""

    guided: ClassVar[str] = "block"

    block: str
    axis: int
    line: OwnStep

    def path_name(self, drawing: Drawing) -> str:
        """The words for the guide of its block."""
        return way_of(drawing, self.block)

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the line through the block, with its angle if found with a group."""
        point = drawing.scene.links[self.block].points[0]
        if is_found_by_closing(drawing.trace.program.steps[self.axis]):
            return found_at_angle(drawing, self.block, point, self.line)
        fields = {"q": symbol(point), "guide": way_of(drawing, self.block)}
        return drawing.words("step.guide-back", **fields)


class ShiftedGuide(Construction, frozen=True, kw_only=True):
    """The parallel ``line`` to the line ``guide`` of a ``block``, on which a point moves."""

    lines_before: ClassVar[tuple[str, ...]] = ("guide",)
    guided: ClassVar[str] = "block"

    block: str
    guide: int
    line: OwnStep

    def path_name(self, drawing: Drawing) -> str:
        """The words for the parallel to the guide of its block."""
        return drawing.words("turn.beside", guide=way_of(drawing, self.block))

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the parallel, by its drawn offset and the side."""
        guide, line = (drawing.trace.values[number] for number in (self.guide, self.line))
        across = 1j * guide.along / abs(guide.along)
        offset = float(dot(across, line.point - guide.point))
        way = drawing.words(f"page.to_{nearest_side(across * (-1 if offset < 0 else 1))}")
        drawn = drawn_amount(drawing, abs(offset))
        return drawing.words("step.shifted", drawn=drawn, way=way)


class GuidesMeet(Construction, frozen=True, kw_only=True):
    """The ``point`` called ``name``, where the lines ``one`` and ``other`` of guides meet."""

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.guides"}
    lines_before: ClassVar[tuple[str, ...]] = ("one", "other")

    name: str
    one: int
    other: int
    point: OwnStep

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing of the two lines."""
        return drawing.words("step.meet", name=symbol(self.name))


def guide_at(pen: Pen, block: str, through: tuple[int, str], direction: int) -> int:
    """Draw the line of a guide through a point, given as a step and a name, in a direction."""
    start, name = through
    line = pen.draw(ray, start, direction)
    pen.make(GuideLine(block=block, start=name, line=line))
    return line


def guide_along(pen: Pen, block: str, bar: tuple[str, str]) -> int:
    """Draw the line of a guide along a bar, from the bar's first point."""
    start, end = (pen.the("position", point) for point in bar)
    line = pen.draw(along_bar, start, start, end)
    pen.make(GuideAlongBar(block=block, start=bar[0], line=line))
    return line


def guide_through(pen: Pen, block: str, first: int, axis: int, offset: int) -> int:
    """Draw the line of a guide from the block on it."""
    line = pen.draw(guide_back, first, axis, offset)
    pen.make(GuideThroughBlock(block=block, axis=axis, line=line))
    return line


def shift_guide(pen: Pen, block: str, guide: int, offset: int) -> int:
    """Draw the parallel to the line of a guide at an offset."""
    line = pen.draw(shifted, guide, offset)
    pen.make(ShiftedGuide(block=block, guide=guide, line=line))
    return line


def cross_guides(pen: Pen, name: str, one: int, other: int) -> int:
    """Draw the point in which the lines of two guides meet."""
    point = pen.draw(meet, one, other, name=name)
    pen.make(GuidesMeet(name=name, one=one, other=other, point=point))
    return point
