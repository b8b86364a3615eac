"""The points of a link: turned about its pivot, or on its base by two arcs, in line, by its axis.

A link is turned to the angle of a driver, or to an angle at which a group closes.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Mapping
from math import degrees
from typing import Any, ClassVar

from msgspec.structs import replace

from graphkin.construction.core.bases import Base
from graphkin.construction.core.crossings import is_found_by_closing
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Canvas,
    Construction,
    Sentence,
    construction,
    constructions,
    together,
)
from graphkin.construction.core.naming import angle_symbol, axis_of, nearest_side
from graphkin.construction.core.palette import MARK_OFF, Move, one_and_length
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.quantities import in_degrees
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import action, ray, similar_point
from graphkin.construction.guides.guides import axis_by_guide, point_on_link
from graphkin.construction.links.dyad_by_arcs import arcs_meet, draw_arc, side_words, stated_bar
from graphkin.construction.links.link_shapes import bar_length, local_place, ratio_of, step_along
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line, cross, crossing_sine, dot
from graphkin.scene.link_points import is_under, lettered
from graphkin.scene.model import FRAME, OnLine

UNTURNED = 0.05
"""Rotation of a wheel, in degrees, below which it is drawn as at the start."""


class PlacedPoint(Construction, frozen=True, kw_only=True):
    """A ``point`` of a ``link``, laid off from its point ``start`` at the link's angle."""

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.placed"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"point": ByHand.LAID_OFF}
    between: ClassVar[tuple[str, ...]] = ("start", "name")
    laid_at: ClassVar[str] = "point"

    link: str
    start: str
    name: str
    point: OwnStep

    def turned(self, drawing: Drawing) -> float | None:
        """The degrees by which its wheel has turned the link; None where no wheel turns it."""
        from graphkin.construction.links.rolled_turn import rolled_turn

        kind = rolled_turn(drawing, self.link)
        return None if kind is None else kind.since(drawing)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point, by its distance and its direction in the plane."""
        words, spot = drawing.words, drawing.standing.spot
        fields = {
            "name": symbol(self.name),
            "p": symbol(self.start),
            "g": escape(self.link),
            "bar": bar(self.start, self.name),
            "angle": words.fixed(degrees(phase(spot(self.name) - spot(self.start))), 1),
        }
        turned = self.turned(drawing)
        if self.link in drawing.scene.unseen:
            wheel, _ = drawing.scene.keepers[self.link]
            return words("step.beside-led", **fields | {"g": escape(wheel)})
        if slides := drawing.scene.links[self.link].slides:
            way, guide = spot(self.name) - spot(self.start), drawing.standing.direction(slides[0])
            if guide and abs(cross(guide, way)) < NOISE * drawing.reach:
                way_words = words(f"page.to_{nearest_side(way)}")
                return words("step.beside-along", way=way_words, **fields)
            return words("step.beside", **fields)
        if turned is None:
            return words("step.beside-turned", **fields)
        return words("step.beside-rolled", turned=words.fixed(turned, 1), **fields)

    def is_turned(self, drawing: Drawing) -> bool:
        """Whether its sentence says by how much its wheel has turned the link."""
        if self.point not in drawing.trace.values or self.link in drawing.scene.unseen:
            return False
        turned = self.turned(drawing)
        slides = drawing.scene.links[self.link].slides
        return turned is not None and abs(turned) >= UNTURNED and not slides


def of_rolled_turns(drawing: Drawing) -> Iterator[Relation]:
    """The relations for the wheel rotations that sentences give, and for those behind them."""
    from graphkin.construction.links.rolled_turn import rolled_turn

    stated: dict[str, float] = {}
    for each in constructions(drawing.trace.program, PlacedPoint):
        kind = rolled_turn(drawing, each.link) if each.is_turned(drawing) else None
        if kind is not None and kind.link not in stated:
            yield from kind.relations(drawing, stated)


def with_starts_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The sentences, with one for all points of each wheel that has not turned from the start."""
    steps = drawing.trace.program.steps
    alike: dict[tuple[str, str], list[Sentence]] = {}
    for said in found:
        kind = construction(steps[said.step]) if said.step >= 0 else None
        if isinstance(kind, PlacedPoint):
            turned = kind.turned(drawing)
            if turned is not None and abs(turned) < UNTURNED:
                alike.setdefault((kind.link, kind.start), []).append(said)
    for (link, start), some in alike.items():
        names = drawing.words("list_mark").join(drawing.lettered(said.step) for said in some)
        fields = {"g": escape(link), "p": symbol(start), "list": names}
        found = together(found, some, drawing.words("step.beside-start", **fields))
    return found


def place_point(pen: Pen, link: str, start: str, name: str) -> int:
    """Draw a point of a link, from its point ``start`` and its axis."""
    ends = local_place(pen, link, start), local_place(pen, link, name)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        here = pen.the("position", start), pen.the("axis", link)
        point = pen.draw(point_on_link, *here, *ends, name=name)
    pen.make(PlacedPoint(link=link, start=start, name=name, point=point))
    return pen.want("position", name, point)


CLEAR_CROSSING = 0.342
"""Sine of 20 degrees; below it a plate point is found by similarity, not by two flat lines."""
IN_LINE = 1e-9
"""Distance of a plate point from its line that counts as zero, relative to its distance."""


# --- constructions -------------------------------------------------------------------------------


class PlatePoint(Construction, frozen=True, kw_only=True):
    """A ``point`` of a link, called ``name``, on its base from ``start`` to ``end``.

    Its value comes from the figure similar to the link; by hand, the point is the ``corner``.
    """

    pencil: ClassVar[Mapping[str, ByHand]] = {"point": ByHand.LAID_OFF}
    between: ClassVar[tuple[str, ...]] = ("start", "end", "name")

    start: str
    end: str
    name: str
    point: OwnStep
    corner: OwnStep | None = None

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason, where the point is found by hand."""
        return "why.arcs" if role == "point" and self.corner is not None else ""

    def symbols(self) -> Mapping[str, str]:
        """The symbols of the ends of the base."""
        return {"p": symbol(lettered(self.start)), "q": symbol(lettered(self.end))}

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the construction by hand, or for the similarity where there is none."""
        if self.corner in drawing.trace.values:
            return self.by_hand(drawing)
        name, third = symbol(self.name), symbol(self.name)
        base, figure = (symbol(self.start) + symbol(self.end), bar(self.start, self.end))
        figures = {"image": base + third, "figure": figure + third}
        return drawing.words("step.similar-point", name=name, **figures)

    def by_hand(self, drawing: Drawing) -> str:
        """The sentence for the construction by hand."""
        return ""


class PlatePointByArcs(PlatePoint, frozen=True, kw_only=True):
    """A point of a plate in which the arcs ``near`` and ``far`` about the ends of its base meet."""

    near: int
    far: int

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """Both arcs, which come before the point."""
        return (self.near, self.far) if self.corner in drawing.trace.values else ()

    def by_hand(self, drawing: Drawing) -> str:
        """The sentence for the crossing of the arcs, with its side of the base."""
        assert self.corner is not None
        side = side_words(drawing, self.corner, self.name, (self.start, self.end))
        return drawing.words("step.arcs-meet.say", name=symbol(self.name), side=side)


class PointInLine(PlatePoint, frozen=True, kw_only=True):
    """A point on the line of its base, laid off from its start by a ``length``."""

    laid_at: ClassVar[str] = "corner"

    length: int

    def by_hand(self, drawing: Drawing) -> str:
        """The sentence for the distance laid off, beyond an end on the bar produced."""
        p, q, name = map(symbol, self.points)
        laid = stated_bar(drawing, (self.start, self.name), self.length)
        fields = {"bar": bar(self.start, self.end), "laid": laid, "name": name}
        start, end, point = map(drawing.standing.spot, self.points)
        way = end - start
        share = dot(way, point - start) / dot(way, way)
        if 0 <= share <= 1:
            return drawing.words("step.step-along", **fields)
        return drawing.words("step.step-along-beyond", start=p if share < 0 else q, **fields)


class PointOnLever(Construction, frozen=True, kw_only=True):
    """A ``point`` called ``name``, laid off from the pivot ``start`` on the line of a lever."""

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.on_lever"}
    between: ClassVar[tuple[str, ...]] = ("start", "name")
    laid_at: ClassVar[str] = "point"

    start: str
    name: str
    point: OwnStep

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point by its distance."""
        name = symbol(self.name)
        return drawing.words("step.mark-off-lever", p=symbol(self.start), q=name, name=name)


# --- drawing -------------------------------------------------------------------------------------


def arc(pen: Pen, link: str, centre: str, point: str) -> int:
    """Draw the arc about the other end of a bar on which a point of the bar lies."""
    length = bar_length(pen, link, centre, point)
    return draw_arc(pen, (centre, point), pen.the("position", centre), length)


def plate_points(pen: Pen, base: Base) -> None:
    """Draw the other points of a link: by hand two arcs, in value a similar figure."""
    for point in base.others:
        if pen.has("position", point):
            continue
        if point in pen.scene.cam_centres:
            if pen.scene.cams[pen.scene.cam_centres[point]].carrier != FRAME:
                continue  # comes with the follower, whose carrier may be placed later
            from graphkin.construction.cams.cam_centre import curvature_centre

            found = curvature_centre(pen, point)
        elif base.end is None or is_under(base.end):
            found = set_by_axis(pen, base, point)
        else:
            found = set_by_base(pen, base, point)
        pen.want("position", point, found)


def set_by_axis(pen: Pen, base: Base, name: str) -> int:
    """Draw a point of a link that already has its axis; a point on its own guide is laid off.

    Once a point lies on the guide that turned the link, the others follow from it and the pivot.
    """
    line = pen.shared.get(("swing", base.link))
    on_guide, sense = guide_point(pen, base, line) if line is not None else (None, 1)
    if line is not None and name == on_guide:
        with pen.on(Part.POSITION, Plane.MECHANISM):
            length, back = (
                bar_length(pen, base.link, base.start, name),
                (sense,) if sense < 0 else (),
            )
            point = pen.draw(mark_off, line, length, extra=back, name=name)
        pen.make(PointOnLever(start=base.start, name=name, point=point))
        return point
    if on_guide is not None:
        if not pen.has("position", on_guide):
            pen.want("position", on_guide, set_by_axis(pen, base, on_guide))
        return set_by_base(pen, Base(base.link, base.start, on_guide, ()), name)
    return place_point(pen, base.link, base.start, name)


def guide_point(pen: Pen, base: Base, line: int) -> tuple[str | None, int]:
    """The other point in the definition of the guide that turned a link, and a sense.

    The sense is 1 if the guide runs from the pivot to that point, and -1 if it runs to the pivot.
    The point is None where no guide is defined through the pivot.
    """
    from graphkin.construction.guides.swung_guide import SwungGuide

    guide = pen.steps[line].of
    assert isinstance(guide, SwungGuide)
    for slide in pen.scene.links[guide.block].slides:
        if slide.on == base.link and slide.along is not None and base.start in slide.along:
            first, second = slide.along
            return (second, 1) if first == base.start else (first, -1)
    return None, 1


def set_by_base(pen: Pen, base: Base, name: str) -> int:
    """Draw a point of a link on its base: by hand an arc about each end, or a distance in line."""
    base = own_line(pen, base, name)
    assert base.end is not None
    ends = pen.the("position", base.start), pen.the("position", base.end)
    ratio = ratio_of(pen, base, name)
    own: dict[str, Any] = {"start": base.start, "end": base.end, "name": name}
    value = pen.peek(ratio)
    if not value:
        return similar_on(pen, PlatePoint(**own, point=0), *ends, ratio)
    if abs(value.imag) <= IN_LINE * abs(value):
        length = bar_length(pen, base.link, base.start, name)
        with pen.on(Part.POSITION, Plane.MECHANISM), pen.hands_way():
            sense = 1 if value.real > 0 else -1
            corner = pen.draw(step_along, ends[0], *ends, length, extra=(sense,))
        return similar_on(
            pen, PointInLine(**own, point=0, corner=corner, length=length), *ends, ratio
        )
    with pen.on(Part.POSITION, Plane.MECHANISM), pen.hands_way():
        near = arc(pen, base.link, base.start, name)
        far = arc(pen, base.link, base.end, name)
        corner = pen.draw(arcs_meet, near, far, extra=(1 if value.imag > 0 else -1,))
    by_arcs = PlatePointByArcs(**own, point=0, corner=corner, near=near, far=far)
    return similar_on(pen, by_arcs, *ends, ratio)


def own_line(pen: Pen, base: Base, name: str) -> Base:
    """The two points that define a point's line, once they are placed; otherwise the base.

    About the ends of the base, two arcs may meet flat where the line needs no arcs.
    """
    for placing in pen.scene.link(base.link).placings:
        if placing.point == name and isinstance(placing, OnLine):
            ends = {placing.first, placing.second}
            if ends != {base.start, base.end} and all(pen.has("position", end) for end in ends):
                (other,) = ends - {placing.start}
                return Base(base.link, placing.start, other, ())
    return base


def similar_on(pen: Pen, kind: PlatePoint, start: int, end: int, ratio: int) -> int:
    """The value of a plate's point: the third point of the figure similar to the link."""
    with pen.on(Part.POSITION, Plane.MECHANISM):
        point = pen.draw(similar_point, start, end, ratio, name=kind.name, by_hand=kind.corner)
    pen.make(replace(kind, point=point))
    return point


def crosses_well(pen: Pen, ratio: int) -> bool:
    """Whether the two bars to a plate point cross at an angle that can be drawn by hand."""
    value = pen.peek(ratio)
    if value in (None, 0, 1):
        return False
    return bool(crossing_sine(Line(0j, value), Line(1 + 0j, value - 1)) >= CLEAR_CROSSING)


# --- links turned about a pivot -------------------------------------------------------------------


@action("mark-off", move=Move(MARK_OFF, one_and_length))
def mark_off(line: Line, length: Real, sense: int = 1) -> Point:
    """The point at a given distance along a line, or back (sense -1)."""
    length = length if sense > 0 else -length
    return line.point + line.along * (length / abs(line.along))


@action("arm")
def arm(pivot: Point, direction: Point, start: Point, end: Point, base: Point, tip: Point) -> Point:
    """A point of a turning link, from the direction of one of its lines (start to end)."""
    line = end - start
    return pivot + direction * (tip - base) * (abs(line) / line)


@action("arm")
def arm_by_axis(pivot: Point, direction: Point, base: Point, tip: Point) -> Point:
    """A point of a turning link, from the direction of the link's own x axis."""
    return pivot + direction * (tip - base)


class DrivenCrank(Construction, frozen=True, kw_only=True):
    """A bar of a driven ``link`` from its ``pivot`` to its ``tip``, called ``name``.

    The bar is laid off on the ``line`` at the driver's angle.
    """

    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.crank"}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line through {pivot}"}
    between: ClassVar[tuple[str, ...]] = ("pivot", "name")
    laid_at: ClassVar[str] = "tip"

    link: str
    pivot: str
    name: str
    line: OwnStep
    tip: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the end of the line, beyond the bar."""
        if role == "line":
            canvas.line_end(self.pivot)

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The line, which comes before the tip."""
        return (self.line,) if role == "tip" else ()

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the line at its angle to the frame's axis, or to a line of a moving link.

        Where the pivot ends that link's bar, the line is measured from the bar produced.
        """
        scene, words = drawing.scene, drawing.words
        driver = next(d for d in scene.drivers if d.link == self.link)
        size = in_degrees(scene, words, driver.position)
        angle = angle_symbol(scene, driver) + (f" = {size}" if size else "")
        fields = {"p": symbol(self.pivot), "angle": angle}
        if driver.against == FRAME:
            return words("step.ray", **fields)
        other = scene.links[driver.against]
        line = axis_of(drawing, other)
        ends = other.points[1:2] == (self.pivot,) and line == bar(*other.points[:2])
        return words("step.ray-produced" if ends else "step.ray-against", line=line, **fields)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that lays off the bar."""
        p, name = symbol(self.pivot), symbol(self.name)
        return drawing.words("step.mark-off", p=p, q=name, name=name)


class TurnedLink(Construction, frozen=True, kw_only=True):
    """The ``tip``, called ``name``, of a ``link`` turned about its ``pivot`` to ``turn``."""

    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.turned_link"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"tip": ByHand.LAID_OFF}
    between: ClassVar[tuple[str, ...]] = ("pivot", "name")
    laid_at: ClassVar[str] = "tip"

    link: str
    pivot: str
    name: str
    turn: int
    tip: OwnStep

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the tip by its angle, or by the bar's angle if found with a group."""
        words, spot = drawing.words, drawing.standing.spot
        fields = {"p": symbol(self.pivot), "name": symbol(self.name)}
        if not is_found_by_closing(drawing.trace.program.steps[self.turn]):
            return words("step.arm", k=escape(self.link), **fields)
        angle = words.fixed(degrees(phase(spot(self.name) - spot(self.pivot))), 1)
        return words("step.arm-found", bar=bar(self.pivot, self.name), angle=angle, **fields)


def turn_about(
    pen: Pen, link: str, ends: tuple[str, str | None], line: tuple[str, ...], turn: int
) -> None:
    """Place a link at its pivot so that one of its lines has a given direction.

    With an empty ``line``, the direction is that of the link's x axis.
    """
    pivot, tip = ends
    start = pen.the("position", pivot)
    if not line:
        pen.want("axis", link, turn)
    if tip is None:
        if line:
            here = [local_place(pen, link, point) for point in line]
            pen.want("axis", link, pen.draw(axis_by_guide, turn, *here))
        return
    if line == (pivot, tip):
        way = pen.draw(ray, start, turn)
        found = pen.draw(mark_off, way, bar_length(pen, link, pivot, tip), name=tip)
        pen.make(DrivenCrank(link=link, pivot=pivot, name=tip, line=way, tip=found))
    else:
        locals_ = [local_place(pen, link, point) for point in (*line, pivot, tip)]
        found = pen.draw(arm if line else arm_by_axis, start, turn, *locals_, name=tip)
        pen.make(TurnedLink(link=link, pivot=pivot, name=tip, turn=turn, tip=found))
    pen.want("position", tip, found)
