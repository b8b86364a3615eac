"""Guides in the plane: their lines, where lines cross, and links set at a coordinate on them.

A driver or the closure of a group gives the coordinate, on a guide or on a track. Parallel bars
give a link the direction of a known one.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import degrees
from typing import ClassVar

from graphkin.construction.core.crossings import is_found_by_closing
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Construction
from graphkin.construction.core.naming import (
    angle_symbol,
    drawn_amount,
    nearest_side,
    place,
    way_of,
)
from graphkin.construction.core.palette import MARK_OFF, Move, one_and_length
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Drive, OwnStep, Part, Plane, Step
from graphkin.construction.core.vocabulary import across, action, along_bar, difference, meet, ray
from graphkin.construction.links.link_shapes import local_place
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.link_points import is_under
from graphkin.scene.model import FRAME, Apart, At, GuideOrTrack, OnLine, Slide
from graphkin.structure.groups import KeptParallel
from graphkin.structure.pairs import PinLine, Sliding
from graphkin.structure.turning import guide_on

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
    pin: Point, first: Point, offset: Real, end: Point, here: Point, along: Point, where: Real
) -> Point:
    """The vector from a pin of the link with the guide to a pin of the block, in the guide's axes.

    ``pin`` and ``first`` belong to the block. ``end`` belongs to the other link, whose guide runs
    from ``here`` the way ``along``. ``where`` is the block's coordinate.
    """
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


class CarriedDirection(Construction, frozen=True, kw_only=True):
    """A direction given in a ``link``'s own axes, in the plane."""

    pencil: ClassVar[Mapping[str, ByHand]] = {"turn": ByHand.TURNED}

    link: str
    turn: OwnStep


class CarriedPlace(Construction, frozen=True, kw_only=True):
    """A place on a ``link``, other than one of its points, in the plane."""

    pencil: ClassVar[Mapping[str, ByHand]] = {"place": ByHand.LAID_OFF}

    link: str
    place: OwnStep


def axis(pen: Pen, link: str) -> int:
    """The direction of a link's x axis: known from its group, or from two of its points."""
    if not pen.has("axis", link):
        base = pen.bases[link]
        assert base.end is not None and not is_under(base.end)
        ends = [pen.the("position", point) for point in (base.start, base.end)]
        here = [local_place(pen, link, point) for point in (base.start, base.end)]
        with pen.on(Part.POSITION, Plane.NUMBERS):
            pen.want("axis", link, pen.draw(axis_of, *ends, *here))
    return pen.the("axis", link)


def direction_on(pen: Pen, link: str, direction: int) -> int:
    """A direction given in a link's own axes, in the plane."""
    if link == FRAME:
        return direction
    turn = pen.draw(direction_on_link, axis(pen, link), direction)
    return pen.make(CarriedDirection(link=link, turn=turn)).turn


def local_line(pen: Pen, slide: GuideOrTrack, on: str) -> tuple[int, int]:
    """A point of a guide or track, and the way ahead along it, in the axes of their link."""
    along = slide.along if isinstance(slide, Slide) else None
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        if along is not None:
            start, end = (local_place(pen, on, point) for point in along)
            return start, pen.draw(way_between, start, end)
        through = slide.through
        assert through is not None
        if isinstance(through, str):
            start = local_place(pen, on, through)
        else:
            start = pen.given("point", *through)
        return start, pen.given("direction", slide.angle)


def guide_line(pen: Pen, slide: GuideOrTrack, on: str, name: str) -> int:
    """Draw a guide or track of a known link, in the plane; its point is the zero of coordinates."""
    along = slide.along if isinstance(slide, Slide) else None
    if along is not None:
        return guide_along(pen, name, along)
    through = slide.through
    assert through is not None
    turn = direction_on(pen, on, pen.given("direction", slide.angle))
    if isinstance(through, str):
        start, p = pen.the("position", through), through
    else:
        start, p = point_on(pen, on, pen.given("point", *through)), ""
    return guide_at(pen, name, (start, p), turn)


def point_on(pen: Pen, link: str, local: int) -> int:
    """A point given by coordinates on a link, in the plane."""
    if link == FRAME:
        return local
    start = pen.bases[link].start
    where = pen.the("position", start), axis(pen, link), local_place(pen, link, start)
    place = pen.draw(point_on_link, *where, local)
    return pen.make(CarriedPlace(link=link, place=place)).place


def known_guide(pen: Pen, pair: Sliding, sought: str = "") -> int:
    """The line of a guide in the plane, from the link that carries it.

    If that link is the one ``sought``, the line is drawn from the block on it.
    """
    key = ("guide", *pair.links)
    if key not in pen.shared:
        block, on = pair.links
        with pen.on(Part.POSITION, Plane.MECHANISM):
            if on != sought:
                line = guide_line(pen, pair.slide, on, block)
            else:
                first = pen.the("position", pen.scene.link(block).points[0])
                offset = pen.given("length", pair.slide.offset)
                line = guide_through(pen, block, first, axis(pen, block), offset)
        pen.shared[key] = line
    return pen.shared[key]


def standing_guide(pen: Pen, pair: Sliding) -> int:
    """The line of a guide whose link is placed, from the zero of its block's coordinates."""
    key = ("standing", *pair.links)
    if key not in pen.shared:
        with pen.on(Part.POSITION, Plane.NUMBERS):
            pen.shared[key] = guide_line(pen, pair.slide, pair.links[1], pair.block)
    return pen.shared[key]


def path_of(pen: Pen, pair: Sliding, link: str, point: str) -> int:
    """The line on which a point of ``link`` moves, by a slide with a known link.

    This also sets the link's axis: links that slide on one another turn together.
    """
    line = known_guide(pen, pair, link)
    key = ("path", *pair.links, point)
    if key not in pen.shared:
        with pen.on(Part.POSITION, Plane.MECHANISM):
            if pair.block == link:
                pen.shared[key] = path_of_block(pen, pair, line, point)
            else:
                pen.shared[key] = path_of_carrier(pen, pair, line, point)
    return pen.shared[key]


def path_of_block(pen: Pen, pair: Sliding, line: int, point: str) -> int:
    """The parallel to a guide on which a point of a block moves."""
    block = pair.block
    first = pen.scene.link(block).points[0]
    if not pen.has("axis", block):
        with pen.on(Part.POSITION, Plane.NUMBERS):
            pen.want("axis", block, pen.draw(axis_along, line))
    if pair.slide.offset.number(pen.scene.values) != 0:
        line = shift_guide(pen, block, line, pen.given("length", pair.slide.offset))
    if not is_level(pen, block, point):
        ends = local_place(pen, block, first), local_place(pen, block, point)
        line = shift_guide(pen, block, line, pen.draw(across, *ends))
    return line


def path_of_carrier(pen: Pen, pair: Sliding, line: int, point: str) -> int:
    """The parallel to a guide on which a point of the link that carries the guide moves."""
    carrier = pair.links[1]
    guide = local_line(pen, pair.slide, carrier)
    if not pen.has("axis", carrier):
        with pen.on(Part.POSITION, Plane.NUMBERS):
            origin = pen.given("origin")
            found = pen.draw(axis_by_guide, axis(pen, pair.block), origin, guide[1])
            pen.want("axis", carrier, found)
    if lies_on(pair.slide, point):
        return line
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        beside = beside_guide_of(pen, carrier, point, guide)
    return shift_guide(pen, pair.block, line, beside)


def beside_guide_of(pen: Pen, link: str, point: str, guide: tuple[int, int]) -> int:
    """The distance of a link's point to the left of a guide on the link, a place and a way."""
    return pen.draw(beside_guide, local_place(pen, link, point), *guide)


def lies_on(slide: Slide, point: str) -> bool:
    """Whether the scene makes a guide pass through a point."""
    return point == slide.through or point in (slide.along or ())


def is_level(pen: Pen, block: str, point: str) -> bool:
    """Whether the scene makes a block's point as far from its guide as its first point."""
    values, link = pen.scene.values, pen.scene.link(block)
    heights: dict[str, Fraction | None] = {}
    for placing in link.placings:
        match placing:
            case At(place, _, y):
                heights[place] = y.number(values)
            case Apart(place, start, _):
                heights[place] = heights[start]
            case OnLine(place, start, end, _, _) if heights[start] == heights[end]:
                heights[place] = heights[start]
            case _:
                heights[placing.point] = None
    first = heights[link.points[0]]
    return point == link.points[0] or (first is not None and heights[point] == first)


def height_of(pen: Pen, pair: Sliding, pins: dict[str, str]) -> int | None:
    """The distance of the block's pin to the left of the guide's own pin, across the guide.

    None where the scene makes the guide pass through both.
    """
    block, carrier = pair.links
    on_block, on_carrier = pins[block], pins[carrier]
    first = pen.scene.link(block).points[0]
    straight = pair.slide.offset.number(pen.scene.values) == 0 and is_level(pen, block, on_block)
    if straight and lies_on(pair.slide, on_carrier):
        return None
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        here = pen.draw(across, local_place(pen, block, first), local_place(pen, block, on_block))
        there = beside_guide_of(pen, carrier, on_carrier, local_line(pen, pair.slide, carrier))
        offset = pen.given("length", pair.slide.offset)
        return pen.draw(gap, offset, here, there)


def height_between(pen: Pen, line: PinLine) -> int | None:
    """The distance of the pin ahead to the left of the line through the other pin, on the rail.

    None where the scene makes one guide pass through both.
    """
    ahead, behind = line.slides
    point = next(iter(shared_points(ahead, behind)), None)
    ends = zip((ahead, behind), line.pins, strict=True)
    if point is not None and all(is_through(pen, pair, pin) for pair, pin in ends):
        return None
    point = point or pen.scene.link(line.rail).points[0]
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        there, here = (
            height_over(pen, pair, pin, line.rail, point)
            for pair, pin in zip((ahead, behind), line.pins, strict=True)
        )
        if are_opposed(pen, line):
            there = pen.draw(difference, pen.given("zero"), there)
        return pen.draw(difference, there, here)


def shared_points(one: Sliding, other: Sliding) -> list[str]:
    """The points of one link through which the scene makes two of its guides pass."""
    if one.links[1] != other.links[1]:
        return []
    names = (one.slide.through, *(one.slide.along or ()))
    return [name for name in names if isinstance(name, str) and lies_on(other.slide, name)]


def is_through(pen: Pen, pair: Sliding, pin: str) -> bool:
    """Whether a guide passes through its block's pin, which is the block's first point."""
    level = pair.slide.offset.number(pen.scene.values) == 0
    return level and pin == pen.scene.link(pair.block).points[0]


def height_over(pen: Pen, pair: Sliding, pin: str, rail: str, point: str) -> int:
    """The distance of a pin to the left of a point of the rail, across the guide between them."""
    block, carrier = pair.links
    first = local_place(pen, block, pen.scene.link(block).points[0])
    guide, offset = local_line(pen, pair.slide, carrier), pen.given("length", pair.slide.offset)
    if carrier == rail:
        here = pen.draw(across, first, local_place(pen, block, pin))
        return pen.draw(gap, offset, here, beside_guide_of(pen, rail, point, guide))
    there = beside_guide_of(pen, carrier, pin, guide)
    lower = pen.draw(across, first, local_place(pen, block, point))
    return pen.draw(difference, there, pen.draw(gap, lower, offset, pen.given("zero")))


def are_opposed(pen: Pen, line: PinLine) -> bool:
    """Whether the two guides of a link have opposite senses in the scene."""
    one, other = (guide_on(pen.scene, line.rail, p.block, p.slide) for p in line.slides)
    return bool(dot(one, other) < 0)


def turned_with(pen: Pen, pair: Sliding, known: str) -> None:
    """Set the axis of the other link of a slide, from the axis of one of them."""
    block, carrier = pair.links
    other = carrier if known == block else block
    if pen.has("axis", other):
        return
    _, along = local_line(pen, pair.slide, carrier)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        line = pen.given("origin"), along
        if other == carrier:
            found = pen.draw(axis_by_guide, axis(pen, block), *line)
        else:
            found = pen.draw(axis_with_guide, axis(pen, carrier), *line)
        pen.want("axis", other, found)


@action("set-at", move=Move(MARK_OFF, one_and_length))
def set_at(line: Line, coordinate: Real) -> Point:
    """The point of a guide at a coordinate."""
    return line.point + line.along * (coordinate / abs(line.along))


@action("set-back")
def set_back(line: Line, coordinate: Real, here: Point, through: Point, axis: Point) -> Point:
    """A point of the link that carries a guide, from the position of the block on it."""
    zero = line.point - line.along * (coordinate / abs(line.along))
    return zero + axis * (here - through)


class SetByCoordinate(Construction, frozen=True, kw_only=True):
    """The ``point`` of a ``link`` at the coordinate ``where`` of its ``path`` on a link ``on``."""

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.set_at"}
    lines_before: ClassVar[tuple[str, ...]] = ("path",)

    link: str
    on: str
    path: int
    where: int
    point: OwnStep

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point by its coordinate.

        Where a group's closure gives the coordinate, the sentence gives distance and side from the
        zero.
        """
        name = drawing.lettered(self.point)
        if not is_found_by_closing(drawing.trace.program.steps[self.where]):
            return drawing.words("step.set-at", name=name, what=self.coordinate(drawing))
        size = float(drawing.trace.values[self.where])
        paths = drawing.scene.links[self.link].paths
        path = next(path for path in paths if path.on == self.on)
        zero = path.along[0] if isinstance(path, Slide) and path.along else path.through
        assert zero is not None
        side = nearest_side(drawing.trace.values[self.path].along * (-1 if size < 0 else 1))
        return drawing.words(
            "step.set-at-found",
            name=name,
            what=drawn_amount(drawing, abs(size)),
            side=drawing.words(f"page.{side}"),
            zero=place(drawing, path.on, zero, on_paper=True),
        )

    def coordinate(self, drawing: Drawing) -> str:
        """The coordinate, by the letter of the driver that gives it, or as drawn."""
        amount = drawn_amount(drawing, float(drawing.trace.values[self.where]))
        drive = drawing.trace.program.steps[self.where].of
        if not isinstance(drive, Drive) or drive.position != self.where:
            return amount
        return f"{angle_symbol(drawing.scene, drawing.scene.drivers[drive.driver])} ({amount})"


class CarrierSetByCoordinate(SetByCoordinate, frozen=True, kw_only=True):
    """A ``point`` of the ``link`` that carries a guide, from the position of the block on it."""

    lines_before: ClassVar[tuple[str, ...]] = ()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point by the coordinate of the block."""
        name = drawing.lettered(self.point)
        what = self.coordinate(drawing)
        return drawing.words("step.set-back", name=name, k=escape(self.link), what=what)


def set_point(pen: Pen, name: str, pair: tuple[str, str], path: int, where: int) -> int:
    """Draw a point of the first link of a pair, at a coordinate of its path on the other."""
    point = pen.draw(set_at, path, where, name=name)
    link, on = pair
    pen.make(SetByCoordinate(link=link, on=on, path=path, where=where, point=point))
    return point


def set_carrier(
    pen: Pen, name: str, pair: tuple[str, str], zero: int, where: int, *ends: int
) -> int:
    """Draw a point of a link that carries a guide; ``zero`` is the guide through its block."""
    point = pen.draw(set_back, zero, where, *ends, name=name)
    link, on = pair
    pen.make(CarrierSetByCoordinate(link=link, on=on, path=zero, where=where, point=point))
    return point


# --- links that parallel bars keep parallel to a known link ---------------------------------------


class KeptDirection(Construction, frozen=True, kw_only=True):
    """The direction of a ``link`` that ``bars`` keep parallel to the link ``lead``."""

    reasons: ClassVar[Mapping[str, str]] = {"turn": "why.parallel"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"turn": ByHand.TURNED}
    titled: ClassVar[str] = "the direction of link {link}"

    link: str
    lead: str
    bars: tuple[str, ...]
    turn: OwnStep

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence that names the bars and the link to which they keep it parallel."""
        if role != "turn":
            return ""
        words = drawing.words
        listed = words("list_mark").join(map(escape, self.bars))
        key = "step.kept-still" if self.lead == FRAME else "step.kept-parallel"
        return words(key, k=escape(self.link), lead=escape(self.lead), list=listed)


def keep_parallel(pen: Pen, group: KeptParallel) -> None:
    """Draw the direction of the link, from set to set of bars."""
    here = group.lead
    if not pen.turns(here):
        pen.shifting |= {group.link}
    turn = pen.given("one") if here == FRAME else axis(pen, here)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        for each in group.sets:
            near, far = each.links if each.links[0] == here else each.links[::-1]
            for link, draw in ((near, axis_with_guide), (far, axis_by_guide)):
                ends = (local_place(pen, link, point) for point in each.line_on(link))
                turn = pen.draw(draw, turn, *ends)
            here = far
    pen.make(KeptDirection(link=group.link, lead=group.lead, bars=group.bars, turn=turn))
    pen.want("axis", group.link, turn)
