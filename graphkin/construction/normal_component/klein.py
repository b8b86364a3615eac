"""Klein's construction for a slider-crank whose crank turns at a constant speed.

Take the crank itself as its velocity turned by 90°. Then every turned velocity lies on the
mechanism: the slider's is perpendicular to its guide. The slider's velocity about the crank pin
lies along the rod. One circle has that last velocity as its radius, another has the rod as its
diameter. Their common chord cuts off the normal component on the rod, and the slider's acceleration
on the parallel to its guide.

Source: F. Klein's construction, as in Theory of Machines by R. S. Khurmi and J. K. Gupta, ch. 15.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any, ClassVar

from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import Measured
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Wording
from graphkin.construction.core.naming import rate_symbol
from graphkin.construction.core.palette import NUMBERS, PaletteAction
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.relation import figure
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.normal_component.normal_component import (
    PICKED,
    PRIMES,
    SCRIPT,
    NormalComponent,
    bar_line,
    bare,
    normal_component,
)
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real, smaller
from graphkin.numbers.plane import Circle, Line, circles_sine, dot, line_meets_line
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME
from graphkin.structure.groups import other_of
from graphkin.structure.pairs import Joint, Pin, Sliding
from graphkin.text.errors import Problem, StructureError, message
from graphkin.text.markup import AND

# --- its value, and the steps by hand ------------------------------------------------------------


@action("square-to-guide")
def square_to_guide(centre: Point, guide: Line) -> Line:
    """The perpendicular to the guide through the centre of the crank."""
    return Line(centre, 1j * guide.along)


@action("circle-through")
def circle_through(centre: Point, point: Point) -> Circle:
    """The circle about a point through another point."""
    return Circle(centre, abs(point - centre))


@action("circle-on-diameter")
def circle_on_diameter(p: Point, q: Point) -> Circle:
    """The circle whose diameter is the segment between two points (Thales)."""
    return Circle((p + q) / 2, abs(q - p) / 2)


@action("common-chord", margin=circles_sine)
def common_chord(m: Circle, n: Circle) -> Line:
    """The line through the two points where circles meet: their radical axis."""
    way = n.centre - m.centre
    square = dot(way, way)
    share = (square + m.radius * m.radius - n.radius * n.radius) / (2 * square)
    return Line(m.centre + way * share, 1j * way)


@action("chord-cuts-guide")
def chord_cuts_guide(chord: Line, centre: Point, guide: Line) -> Point:
    """The point where the chord cuts the parallel to the guide through the centre of the crank."""
    return line_meets_line(chord, Line(centre, guide.along))


@action("klein-by-hand")
def klein_by_hand(pin: Point, foot: Point, omega: Real) -> Point:
    """The normal component read off the rod: omega squared times the vector from foot to pin."""
    return omega * omega * (pin - foot)


# --- the component -------------------------------------------------------------------------------


class KleinComponent(NormalComponent, frozen=True, kw_only=True):
    """a_ν = v²/l of the slider's pin ``q`` about the crank pin ``p``, by the common chord.

    The perpendicular ``across`` to the guide at the ``centre`` of the crank cuts the ``line`` of
    the rod in ``corner``. One circle, ``around`` the crank pin, passes through that corner; the
    other is ``over`` the rod. Their ``chord`` cuts the rod in ``foot`` and the parallel to the
    guide in ``whole``.
    """

    gives: ClassVar[tuple[str, ...]] = (
        "across",
        "line",
        "corner",
        "around",
        "over",
        "chord",
        "foot",
        "whole",
        "read",
        "vector",
    )
    reasons: ClassVar[Mapping[str, str]] = {"corner": "why.klein", "foot": "why.chord"}
    lines: ClassVar[Mapping[str, str]] = {
        "line": "{p}{q}",
        "across": "⊥ to the guide at {o}",
        "chord": "the common chord",
    }
    lettered: ClassVar[tuple[str, ...]] = ("corner", "foot", "whole")
    palette: ClassVar[PaletteAction] = PaletteAction(
        "klein", PICKED, SCRIPT, plane=NUMBERS, said_as="triangle", typed=("klein",)
    )
    titled: ClassVar[str] = "Klein's construction for {q} about {p}"

    o: str
    centre: int
    omega: int
    across: int | None = None
    corner: int | None = None
    around: int | None = None
    over: int | None = None
    chord: int | None = None
    foot: int | None = None
    whole: int | None = None

    def symbols(self) -> Mapping[str, str]:
        """The centre of the crank, and the pins."""
        return {**super().symbols(), "o": symbol(self.o)}

    # --- drawing it ------------------------------------------------------------------------------

    def sides(self, canvas: Canvas | Measured) -> Iterator[Any]:
        """The turned velocity, and the piece of the rod that the chord cuts off."""
        assert self.corner is not None and self.foot is not None
        pivot = canvas.value(self.pivot)
        yield canvas.value(self.corner) - pivot
        yield canvas.value(self.foot) - pivot

    def room(self, canvas: Canvas | Measured) -> Any:
        """The smaller of the triangle's margin and the overlap of both circles, in mm."""
        assert self.corner is not None
        pivot, pin, corner = map(canvas.value, (self.pivot, self.pin, self.corner))
        return smaller(super().room(canvas), canvas.size(pin - pivot) - canvas.size(corner - pivot))

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the turned velocities, both circles, and the points on their chord."""
        assert self.whole is not None
        value, drawing = canvas.value, canvas.drawing
        match role:
            case "across" | "chord":
                canvas.line()
            case "line":
                canvas.line_beyond()
            case "around" | "over":
                canvas.circle(value(getattr(self, role)), "construction")
            case "corner" | "foot":
                canvas.point(self.letter(drawing, role), value(getattr(self, role)))
            case "whole":
                canvas.segment(value(self.centre), value(self.whole))
                canvas.point(self.letter(drawing, role), value(self.whole))

    def letter(self, drawing: Drawing, role: str) -> str:
        """The letter of a corner; for the chord, the letter of its foot."""
        return super().letter(drawing, "foot" if role == "chord" else role)

    def shown_between(self) -> tuple[int | None, ...]:
        """The piece of the rod that the chord cuts off."""
        return self.foot, self.pivot

    # --- its sentences ---------------------------------------------------------------------------

    def drawing_words(self, drawing: Drawing, fields: Mapping[str, str], *, first: bool) -> Wording:
        """The construction in full, each time."""
        markup = AND.join(markup for _, markup in self.in_parts(drawing))
        return Wording("ν by chord", markup)

    def parts_of_sentence(self, drawing: Drawing) -> Iterator[tuple[int, str]]:
        """The instruction in parts: the turned velocities, both circles, their common chord."""
        drawn = self.corner is not None and self.is_drawn(drawing)
        yield from self.in_parts(drawing) if drawn else super().parts_of_sentence(drawing)

    def in_parts(self, drawing: Drawing) -> Iterator[tuple[int, str]]:
        """The instruction in parts, where the construction is drawn."""
        assert self.corner is not None and self.over is not None and self.vector is not None
        fields = {**self.symbols(), "v": symbol(self.speed), "a": self.symbol(drawing)}
        fields["w"] = symbol(f"v_{self.q}")
        fields["omega"] = rate_symbol(drawing, self.omega)
        fields |= self.corner_symbols(drawing, *self.lettered)
        times = drawing.scales.of_bar("acceleration")  # scale against that of the circles
        larger = drawing.words("step.klein-larger", m=figure(drawing, times))
        fields["more"] = "" if times == 1 else larger
        yield self.corner, drawing.words("step.klein", **fields)
        yield self.over, drawing.words("step.klein-circles", **fields)
        yield self.vector, drawing.words("step.klein-chord", **fields)

    def section(self, drawing: Drawing) -> str:
        return "normals_klein"


# --- writing its steps ---------------------------------------------------------------------------


def crank_of(pen: Pen, sides: list[tuple[Joint, str]]) -> Base | None:
    """The crank of a slider-crank to which Klein's construction applies; None for other dyads.

    The crank turns at a constant speed about a fixed pivot, and the slider moves on a fixed guide.
    """
    pins = [pair.point for pair, _ in sides if isinstance(pair, Pin)]
    on = [pair.links[1] for pair, _ in sides if isinstance(pair, Sliding)]
    if len(pins) != 1 or on != [FRAME]:
        return None
    for driver in pen.scene.drivers:
        steady = driver.kind == "turn" and driver.acceleration.number(pen.scene.values) == 0
        if steady and {driver.link, other_of(driver, driver.link)} - {driver.link} == {FRAME}:
            base = pen.bases[driver.link]
            fixed = base.start in pen.scene.frame.points
            if fixed and pins[0] in (base.end, *base.others):
                return base
    return None


def klein_component(pen: Pen, crank: Base, sides: list[tuple[Joint, str]], pin: str) -> int:
    """The normal component of the slider's pin about the crank pin, by Klein's construction."""
    (pivot,) = (pair.point for pair, _ in sides if isinstance(pair, Pin))
    (slide,) = (pair for pair, _ in sides if isinstance(pair, Sliding))
    places = pen.the("position", pivot), pen.the("position", pin)
    centre, omega = pen.the("position", crank.start), pen.the(OMEGA, crank.link)
    guide, point = known_guide(pen, slide), bare(letter(pin))

    def drawn(index: str) -> dict[str, int]:
        names = [f"{point}{primes}_{index}" for primes in PRIMES]
        with pen.hands_way():
            across = pen.draw(square_to_guide, centre, guide)
            line = pen.draw(bar_line, *places)
            corner = pen.draw(meet, across, line, name=names[0])
            around = pen.draw(circle_through, places[0], corner)
            over = pen.draw(circle_on_diameter, *places)
            chord = pen.draw(common_chord, around, over)
            foot = pen.draw(meet, chord, line, name=names[1])
            whole = pen.arrow(chord_cuts_guide, chord, centre, guide, name=names[2])
            with pen.on(Part.NORMAL, Plane.NUMBERS):
                read = pen.draw(klein_by_hand, places[0], foot, omega)
        own = (across, line, corner, around, over, chord, foot, whole, read)
        return dict(zip(KleinComponent.gives, own, strict=False))

    kind = partial(KleinComponent, o=lettered(crank.start), centre=centre, omega=omega)
    return normal_component(pen, pivot, pin, kind, drawn)


def component_in_dyad(pen: Pen, sides: list[tuple[Joint, str]], pivot: str, pin: str) -> int:
    """The normal component of a pin about a pivot of its dyad, by the scene's method."""
    crank = crank_of(pen, sides)
    if crank is None:
        return normal_component(pen, pivot, pin)
    return klein_component(pen, crank, sides, pin)


def refuse_unused(pen: Pen) -> None:
    """Raise StructureError where a scene asks for Klein's construction but has no place for it."""
    used = any(isinstance(step.of, KleinComponent) for step in pen.steps)
    if not used:
        problem = Problem(
            "sheet.method",
            message("no slider-crank for Klein's construction"),
            message(
                "a crank with a constant speed about a fixed pivot, and a rod from it to a "
                "block on a fixed guide"
            ),
            message("leave method out for right triangles"),
        )
        raise StructureError([problem])
