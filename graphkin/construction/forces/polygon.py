"""Polygons of forces: sides laid off one after the other, and the sides that close them.

The polygon of a dyad begins with the part of the first outer reaction across its bar and ends with
that of the second one. Lines along both bars, or normal to guides, through its start and its end
meet where the polygon closes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import ClassVar, NamedTuple

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Construction, Slip
from graphkin.construction.core.naming import TINY, way_of
from graphkin.construction.core.palette import (
    PARALLEL,
    PERPENDICULAR,
    ErrorPicks,
    KnownError,
    Move,
    two,
)
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane, Step
from graphkin.construction.core.quantities import PAIR_REACTION, in_mm
from graphkin.construction.core.relation import Relation, as_read
from graphkin.construction.core.vocabulary import action, along_bar, join, lay_off, meet
from graphkin.construction.forces.loads import LinkForce, drawn_force, force_amount, newtons
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line
from graphkin.text import COMMA

PART = "reaction-part"
"""The style of the parts of reactions along and across bars."""
REACTION = "reaction"
"""The style of reactions."""


@action("force-start")
def force_start() -> Point:
    """The start of a polygon of forces."""
    return 0j


@action("normal-to-guide", move=Move(PERPENDICULAR, two, in_plan=True))
def normal_to_guide(start: Point, guide: Line) -> Line:
    """The perpendicular to a guide through a point of the polygon."""
    return Line(start, 1j * guide.along)


@action("along-guide", move=Move(PARALLEL, two, in_plan=True))
def along_guide(start: Point, guide: Line) -> Line:
    """The parallel to a guide through a point of the polygon."""
    return Line(start, guide.along)


@action("side-between")
def side_between(tail: Point, tip: Point) -> Point:
    """The force from one point of the polygon to another."""
    return tip - tail


class KnownSide(NamedTuple):
    """A known side of a polygon: its symbol, and the step of its force."""

    name: str
    force: int


class SideDirection(NamedTuple):
    """The direction of a closing side: along the bar between two pins, or by a block's guide.

    ``guide`` is the step of the guide and ``block`` its block; ``along`` says that the side is
    parallel to the guide, for the force of a driver.
    """

    ends: tuple[str, str] = ("", "")
    guide: int | None = None
    block: str = ""
    along: bool = False

    def words(self, drawing: Drawing) -> str:
        """The direction as markup: ∥ AB, ⊥ guide 5."""
        if self.guide is None:
            return f"∥ {bar(*self.ends)}"
        return f"{'∥' if self.along else '⊥'} {way_of(drawing, self.block)}"


class ClosingSide(NamedTuple):
    """A side of known direction that closes a polygon: its symbol, its direction and its style.

    ``bar`` is the link, or the cylinder, along which it acts where that one carries no loads.
    """

    name: str
    way: SideDirection
    look: str = REACTION
    bar: str = ""


class DrawnSide(NamedTuple):
    """A side of a polygon as it is drawn: its symbol, its style, and its ends."""

    name: str
    look: str
    tail: int
    tip: int


class InPolygon(Construction, frozen=True, kw_only=True):
    """A construction in the polygon with the number ``polygon``, in the order of the work."""

    polygon: int

    def sides_at(self, role: str) -> tuple[DrawnSide, ...]:
        """The sides that are drawn with the step of a role."""
        return ()


class PolygonStart(InPolygon, frozen=True, kw_only=True):
    """The start of the polygon of some ``links``."""

    links: tuple[str, ...]
    kind: str
    start: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the start as a circle with its number."""
        canvas.pole()


class PolygonSide(InPolygon, frozen=True, kw_only=True):
    """A known force laid off from the last point of a polygon."""

    pencil: ClassVar[Mapping[str, ByHand]] = {"corner": ByHand.LAID_OFF}

    name: str
    look: str
    start: int
    force: int
    corner: OwnStep

    def vector_to(self, role: str) -> str:
        """The force."""
        return symbol(self.name)

    def sides_at(self, role: str) -> tuple[DrawnSide, ...]:
        """The force."""
        return (DrawnSide(self.name, self.look, self.start, self.corner),)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the force, unless it is zero."""
        if canvas.drawing.settled(abs(canvas.value(self.force))):
            draw_sides(canvas, self.sides_at(role))


class ClosedByLines(InPolygon, frozen=True, kw_only=True):
    """A polygon closed by two sides of known direction, whose lines meet.

    ``bars`` are the links, or cylinders, along which both sides act where they carry no loads.
    ``cam`` says that the first side is the force of a cam.

    ``first`` is the symbol of the side along the line through the polygon's start, ``last`` that of
    the side along the line through its end. ``sides`` are all known sides, in order. ``looks`` are
    the styles of both closing sides.
    """

    reasons: ClassVar[Mapping[str, str]] = {"corner": "why.force_polygon"}
    lines: ClassVar[Mapping[str, str]] = {"one": "the side {first}", "other": "the side {last}"}
    titled: ClassVar[str] = "the polygon of {kind}"
    slips: ClassVar[Mapping[str, Slip]] = {
        "reaction_along_guide": Slip(
            1,
            "serious",
            ("one", "other"),
            normal_to_guide,
            lambda kind, line, get: Line(line.point, 1j * line.along),
        )
    }

    kind: str
    links: tuple[str, ...]
    first: str
    last: str
    looks: tuple[str, str]
    ways: tuple[SideDirection, SideDirection]
    sides: tuple[KnownSide, ...]
    start: int
    end: int
    one: OwnStep
    other: OwnStep
    corner: OwnStep
    bars: tuple[str, str]
    cam: bool = False

    def vector_to(self, role: str) -> str:
        """The side along a line; at the corner the side that ends there."""
        return symbol(self.first if role == "one" else self.last)

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """The side of a block along its guide, or across the bar along which it acts."""
        for line, way in zip((self.one, self.other), self.ways, strict=True):
            start, *ends = steps[line].args
            if way.guide is None:
                given = picks.point_or_line(start), picks.bar(*ends)
                yield KnownError("turn.wrong.across_bar", line, PERPENDICULAR, given)
            elif not way.along:
                given = picks.point_or_line(start), picks.point_or_line(ends[0])
                yield KnownError("turn.wrong.along_guide", line, PARALLEL, given)

    def sides_at(self, role: str) -> tuple[DrawnSide, ...]:
        """Both closing sides, where their lines meet."""
        if role != "corner":
            return ()
        last = DrawnSide(self.last, self.looks[1], self.end, self.corner)
        return last, DrawnSide(self.first, self.looks[0], self.corner, self.start)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw both lines, and where they meet both closing sides."""
        draw_sides(canvas, self.sides_at(role))
        if role != "corner":
            way = self.ways[0 if role == "one" else 1]
            canvas.locus("", way.words(canvas.drawing))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The instruction: the sides in order, and the lines that close the polygon."""
        if role != "corner":
            return ""
        said = drawing.words(
            "step.force-polygon" if sides_words(drawing, self.sides) else "step.force-polygon-none",
            n=str(self.polygon),
            k=links_words(drawing, self.links),
            sides=sides_words(drawing, self.sides),
            one=self.ways[0].words(drawing),
            other=self.ways[1].words(drawing),
            first=read_side(drawing, self.first, self.start, self.corner),
            last=read_side(drawing, self.last, self.end, self.corner),
        )
        before = [*self.two_force(drawing)]
        if self.cam:
            fields = {"r": symbol(self.first), "way": self.ways[0].words(drawing)}
            before.append(drawing.words("step.force-cam", **fields))
        return drawing.words.clauses([*before, said])

    def two_force(self, drawing: Drawing) -> Iterator[str]:
        """The links without loads between their pins, whose reactions lie along them."""
        both = zip((self.first, self.last), self.ways, self.bars, strict=True)
        for name, way, link in both:
            if link and way.guide is None and "^" not in name and self.sides:
                b = symbol(way.ends[1])
                fields = {"k": escape(link), "b": b, "r": symbol(name), "bar": bar(*way.ends)}
                yield drawing.words("step.force-two", **fields)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sides read off."""
        if role == "corner":
            yield of_side(drawing, self.first, self.start, self.corner)
            yield of_side(drawing, self.last, self.end, self.corner)


class ClosingReaction(InPolygon, frozen=True, kw_only=True):
    """A reaction that leads from one point of a polygon to another: ``force``, and its arrow.

    ``whole`` are the symbols of its two parts where it is their sum. ``sides`` are the known sides
    of a polygon that it closes alone. An inner reaction begins where the loads of the link
    ``first`` end, by default the first of the polygon.
    """

    reasons: ClassVar[Mapping[str, str]] = {"arrow": "why.force_closing"}

    name: str
    links: tuple[str, ...]
    tail: int
    tip: int
    force: OwnStep
    arrow: OwnStep
    whole: tuple[str, ...] = ()
    sides: tuple[KnownSide, ...] = ()
    closes: bool = False
    first: str = ""

    def sides_at(self, role: str) -> tuple[DrawnSide, ...]:
        """The reaction."""
        side = DrawnSide(self.name, REACTION, self.tail, self.tip)
        return (side,) if role == "arrow" else ()

    def marks(self, canvas: Canvas, role: str) -> None:
        draw_sides(canvas, self.sides_at(role))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sum of its parts, or the side that closes the polygon."""
        if role != "arrow":
            return ""
        fields = {
            "n": str(self.polygon),
            "one": escape(self.first or self.links[0]),
            "k": links_words(drawing, self.links),
            "r": symbol(self.name),
            "read": read_side(drawing, self.name, self.tail, self.tip),
            "sides": sides_words(drawing, self.sides),
            "parts": " + ".join(symbol(name) for name in self.whole),
        }
        key = "step.force-sum" if self.whole else "step.force-inner"
        if self.closes:
            sides = fields["sides"]
            key = "step.force-closes" if sides else "step.force-closes-none"
        return drawing.words(key, **fields)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The reaction read off."""
        if role == "arrow":
            yield of_side(drawing, self.name, self.tail, self.tip)


def draw_sides(canvas: Canvas, sides: Iterable[DrawnSide]) -> None:
    """Draw sides of a polygon."""
    for each in sides:
        draw_side(canvas, each)


def draw_side(canvas: Canvas, side: DrawnSide) -> None:
    """Draw a side of a polygon; a note says that it is too short to be seen."""
    name, tail, tip = side.name, canvas.value(side.tail), canvas.value(side.tip)
    if canvas.size(tip - tail) >= TINY:
        canvas.vector(name, side.look, tail, tip)
        return
    drawing, words = canvas.drawing, canvas.drawing.words
    if not (size := drawing.settled(abs(tip - tail))):
        canvas.note(words("page.zero", name=symbol(name)))
        return
    length = in_mm(words, drawn_force(drawing, size))
    canvas.note(words("page.tiny", name=symbol(name), length=length), words("page.too_short"))


def links_words(drawing: Drawing, links: Sequence[str]) -> str:
    """Links in words: link 3, links 2 and 3."""
    names = drawing.words("list_mark").join(map(escape, links))
    key = "one_link" if len(links) == 1 else "many_links"
    return drawing.words(f"calculation.{key}", links=names)


def sides_words(drawing: Drawing, sides: Sequence[KnownSide]) -> str:
    """The symbols of the sides that are not zero, in order."""
    values = drawing.trace.values
    shown = (each.name for each in sides if drawing.settled(abs(values[each.force])))
    return COMMA.join(map(symbol, shown))


def side_size(drawing: Drawing, tail: int, tip: int) -> float:
    """The magnitude of a side in N; zero for rounding."""
    values = drawing.trace.values
    return drawing.settled(abs(values[tip] - values[tail]))


def read_side(drawing: Drawing, name: str, tail: int, tip: int) -> str:
    """A side as read off: R_03 = 123 N (24.6 mm)."""
    size = side_size(drawing, tail, tip)
    return f"{symbol(name)} = {newtons(drawing, size)} ({force_amount(drawing, size)})"


def of_side(drawing: Drawing, name: str, tail: int, tip: int) -> Relation:
    """A side as a relation: scale factor times drawn length."""
    size = side_size(drawing, tail, tip)
    read = as_read(drawing, drawn_force(drawing, size), drawing.scales.kF / 1000)
    return Relation(symbol(name), "", *read, "N", drawing.words("calculation.force_measured"))


# --- writing their steps -------------------------------------------------------------------------


class Polygon:
    """A polygon while it is drawn: its number, its last point, and its sides so far."""

    def __init__(self, pen: Pen, number: int, links: Sequence[str], kind: str) -> None:
        self.pen, self.number, self.links = pen, number, tuple(links)
        with pen.on(Part.FORCE, Plane.FORCES):
            self.start = self.last = pen.draw(force_start, name=f"{number}")
        record = PolygonStart(polygon=number, links=self.links, kind=kind, start=self.start)
        pen.make(record)
        self.kind = kind
        self.sides: list[KnownSide] = []
        self.ends: dict[str, tuple[int, int]] = {}

    def put(self, name: str, force: int) -> int:
        """Lay off a force that a construction of its own marks; its end."""
        start = self.last
        with self.pen.on(Part.FORCE, Plane.FORCES):
            corner = self.pen.draw(lay_off, start, force)
        self.sides.append(KnownSide(name, force))
        self.ends[name] = start, corner
        self.last = corner
        return corner

    def lay(self, name: str, look: str, force: int) -> int:
        """Lay off a force; its end."""
        start = self.last
        corner = self.put(name, force)
        self.pen.make(
            PolygonSide(
                polygon=self.number, name=name, look=look, start=start, force=force, corner=corner
            )
        )
        return corner

    def lay_all(self, acting: Sequence[LinkForce]) -> int:
        """Lay off the loads of a link; the end of the last one."""
        for each in acting:
            if each.force is not None:
                self.lay(each.name, each.look, each.force)
        return self.last

    def line(self, start: int, way: SideDirection) -> int:
        """A line through a point of the polygon."""
        pen = self.pen
        with pen.on(Part.FORCE, Plane.FORCES):
            if way.guide is None:
                p, q = (pen.the("position", point) for point in way.ends)
                return pen.draw(along_bar, start, p, q)
            return pen.draw(along_guide if way.along else normal_to_guide, start, way.guide)

    def close(self, first: ClosingSide, last: ClosingSide, *, cam: bool = False) -> ClosedByLines:
        """Close the polygon by two sides: one through its start, and one through its end."""
        one, other = self.line(self.start, first.way), self.line(self.last, last.way)
        with self.pen.on(Part.FORCE, Plane.FORCES):
            corner = self.pen.draw(meet, one, other)
        return self.pen.make(
            ClosedByLines(
                polygon=self.number,
                kind=self.kind,
                links=self.links,
                first=first.name,
                last=last.name,
                looks=(first.look, last.look),
                ways=(first.way, last.way),
                sides=tuple(self.sides),
                start=self.start,
                end=self.last,
                one=one,
                other=other,
                corner=corner,
                bars=(first.bar, last.bar),
                cam=cam,
            )
        )

    def reaction(
        self,
        name: str,
        tail: int,
        tip: int,
        *,
        whole: tuple[str, ...] = (),
        closes: bool = False,
        drawn: bool = True,
        first: str = "",
        quantity: str = PAIR_REACTION.target,
    ) -> int:
        """The force from one point of the polygon to another, with its arrow: a ``quantity``."""
        pen = self.pen
        with pen.on(Part.FORCE, Plane.NUMBERS):
            force = pen.draw(side_between, tail, tip)
        pen.want(quantity, name, force)
        if not drawn:
            return force
        with pen.on(Part.FORCE, Plane.FORCES):
            arrow = pen.draw(join, tail, tip)
        record = ClosingReaction(
            polygon=self.number,
            name=name,
            links=self.links,
            tail=tail,
            tip=tip,
            force=force,
            arrow=arrow,
            whole=whole,
            sides=tuple(self.sides) if closes else (),
            closes=closes,
            first=first,
        )
        return pen.make(record).force
