"""The normal component of a point that turns about another: v²/l, by the right triangle.

The velocity is set at its pin. The perpendicular at its tip to the line from the pivot cuts the
bar. The velocity is the height of the resulting right triangle. It is therefore the mean
proportional of the bar and the piece that the perpendicular cuts off (lab, figure 4).

Klein's construction for a slider-crank whose crank turns at a constant speed.

Take the crank itself as its velocity turned by 90°. Then every turned velocity lies on the
mechanism: the slider's is perpendicular to its guide. The slider's velocity about the crank pin
lies along the rod. One circle has that last velocity as its radius, another has the rod as its
diameter. Their common chord cuts off the normal component on the rod, and the slider's acceleration
on the parallel to its guide.

Source: F. Klein's construction, as in Theory of Machines by R. S. Khurmi and J. K. Gupta, ch. 15.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, ClassVar

from msgspec import Struct

from graphkin.construction.core.bases import Base
from graphkin.construction.core.component import (
    LaidOff,
    Measured,
    OwnSizes,
    Size,
    TriangleComponent,
    component_ending_at,
)
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Canvas,
    Sentence,
    Slip,
    Wording,
    in_one,
    together,
)
from graphkin.construction.core.naming import laid_off_words, letter_at, plan_amount, rate_symbol
from graphkin.construction.core.palette import (
    NUMBERS,
    PERPENDICULAR,
    ErrorPicks,
    KnownError,
    PaletteAction,
    Picks,
    normal_towards,
)
from graphkin.construction.core.pen import (
    Pen,
    about,
    acceleration_arrow,
    against,
    component_arrow,
    letter,
    relative_arrow,
)
from graphkin.construction.core.program import Effect, OwnStep, Part, Plane, Step
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.relation import (
    Relation,
    answer,
    figure,
    laid_times,
    length_of,
    put_in,
    set_length,
    squared,
)
from graphkin.construction.core.vocabulary import action, lay_off, meet, perpendicular_at, set_way
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.plan import ACCELERATION
from graphkin.construction.velocity.relative_motion import (
    PerpendicularThrough,
    forgotten,
    square_to,
)
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real, smaller
from graphkin.numbers.plane import Circle, Line, circles_sine, dot, line_meets_line
from graphkin.scene.link_points import is_under, lettered
from graphkin.scene.model import FRAME, Scene
from graphkin.scene.requests import KLEIN
from graphkin.structure.groups import other_of
from graphkin.structure.pairs import Joint, Pin, Sliding
from graphkin.text import COMMA, saying
from graphkin.text.errors import Problem, StructureError, message

# --- its value, and the steps by hand ------------------------------------------------------------


@action("normal")
def normal(pivot: Point, pin: Point, image_pivot: Point, image_pin: Point) -> Point:
    """The normal component of a pin's acceleration about a pivot: v·(v/l), inwards (Rivals).

    The product is taken in this order so that no square overflows; 4·eps relative error.
    """
    bar = pivot - pin
    length = abs(bar)
    speed = abs(image_pin - image_pivot)
    return bar * (speed * (speed / length) / length)


@action("bar-line")
def bar_line(pivot: Point, pin: Point) -> Line:
    """The line of a bar, extended beyond the pin."""
    return Line(pin, pin - pivot)


@action("turn-over")
def turn_over(point: Point, about: Point) -> Point:
    """A point turned by 180 degrees about another."""
    return about + (about - point)


@action("normal-by-hand")
def normal_by_hand(pin: Point, end: Point, seconds: Point) -> Point:
    """The normal component read off the triangle: the segment from the pin."""
    return (end - pin) / (seconds * seconds)


# --- the component -------------------------------------------------------------------------------

PICKED = (("at", ("point",)), ("on", ("bar",)), ("velocity", ("arrow",)))
"""The inputs of its action on a page: the pin, the bar, and the velocity about the other end."""
PRIMES = ("″", "‴", "⁗")
"""The primes that the letter of the pin has at each corner of its triangle."""
SCRIPT = "normal"
"""The function of the page's script that gives v²/l."""


class NormalComponent(TriangleComponent, frozen=True, kw_only=True):
    """a_ν = v²/l of a point ``q`` about ``p``, and the right triangle that gives it.

    It follows from the places and images of both points. The velocity set at the pin ends in
    ``tip``. The line of the bar, ``line``, cuts the perpendicular ``edge`` at the tip in ``cut``.
    Turned by 180° about the pin, the cut becomes ``end``.
    """

    sign: ClassVar[str] = "ν"
    look: ClassVar[str] = "normal"
    effect: ClassVar[Effect] = "normal components"
    limited: ClassVar[str] = TriangleComponent.drawn_in
    laid_off_key: ClassVar[str] = ""
    laid_off_reason: ClassVar[str] = "why.normal"
    reasons: ClassVar[Mapping[str, str]] = {"cut": "why.height", "end": "why.over"}
    lines: ClassVar[Mapping[str, str]] = {"line": "{p}{q}", "edge": "⊥ at {tip}"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"tip": ByHand.LAID_OFF}
    lettered: ClassVar[tuple[str, ...]] = ("tip", "cut", "end")
    slips: ClassVar[Mapping[str, Slip]] = {
        "normal_missing": Slip(0, "serious"),
        "normal_reversed": Slip(-1, "moderate"),
    }
    forgotten: ClassVar[str] = "turn.wrong.normal_forgotten"
    turned: ClassVar[str] = "turn.wrong.normal_turned"
    palette: ClassVar[PaletteAction] = PaletteAction(
        "triangle", PICKED, SCRIPT, plane=NUMBERS, typed=("△", "tri"), draw=normal_towards
    )
    titled: ClassVar[str] = "the right triangle of {q} about {p}"

    p: str
    q: str
    v: str
    pivot: int
    pin: int
    pivot_image: int
    pin_image: int
    tip: OwnStep | None = None
    edge: OwnStep | None = None
    line: OwnStep | None = None
    cut: OwnStep | None = None
    end: OwnStep | None = None

    @property
    def speed(self) -> str:
        """The name of the velocity from which it follows."""
        return f"v_{self.v}"

    def symbols(self) -> Mapping[str, str]:
        """The pivot, the pin and their bar."""
        return {"p": symbol(self.p), "q": symbol(self.q), "bar": bar(self.p, self.q)}

    @classmethod
    def cause(cls, scene: Scene) -> str:
        """The phrase that points which move about others need a normal component."""
        return "points that move about others need a normal component"

    def corner_letter(self, role: str) -> str:
        """The letter of the pin with the primes of the corner."""
        primes = dict(zip(self.lettered, PRIMES, strict=True))
        return bare(self.q) + primes[role] if role in primes else ""

    # --- drawing it ------------------------------------------------------------------------------

    def sides(self, canvas: Canvas | Measured) -> Iterator[Any]:
        """The velocity, and the component itself."""
        assert self.tip is not None and self.end is not None
        pin = canvas.value(self.pin)
        yield canvas.value(self.tip) - pin
        yield canvas.value(self.end) - pin

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the velocity at the pin, the perpendicular at its tip, and the piece cut off."""
        assert self.tip is not None and self.cut is not None and self.end is not None
        value, pin = canvas.value, canvas.value(self.pin)
        pivot = value(self.pivot)
        match role:
            case "tip":
                canvas.vector(self.speed, "relative-velocity", pin, value(self.tip))
                canvas.point(self.letter(canvas.drawing, role), value(self.tip))
            case "edge":
                canvas.segment(pivot, value(self.tip))
                canvas.line()
                canvas.right_angle(pivot)
            case "line":
                canvas.line_beyond()
            case "cut":
                canvas.point(self.letter(canvas.drawing, role), value(self.cut))
            case "end":
                canvas.swing(pin, value(self.end))
                canvas.vector(self.name, self.look, pin, value(self.end))
                canvas.point(self.letter(canvas.drawing, role), value(self.end))

    # --- its sentences ---------------------------------------------------------------------------

    def formula(self, drawing: Drawing) -> str:
        """v²/l, as markup."""
        speed = symbol(self.speed)
        return saying(f"{speed}^2/{bar(self.p, self.q)}", speed)

    def sentence(self, drawing: Drawing, *, first: bool) -> Wording:
        """The instruction: its right triangle in full first, later its source or its value."""
        if self.is_left_out(drawing):
            return Wording("short", self.left_out(drawing))
        size = self.size(drawing)
        fields = {**self.symbols(), "v": symbol(self.speed), "a": self.symbol(drawing)}
        if not drawing.settled(size):
            return Wording("ν none", drawing.words("step.normal-none", **fields))
        if self.is_hidden(drawing):
            drawn = plan_amount(drawing, Plane.ACCELERATIONS, size)
            by_number = drawing.words("step.normal-computed", drawn=drawn, **fields)
            return Wording("ν by number", by_number)
        return self.drawing_words(drawing, fields, first=first)

    def drawing_words(self, drawing: Drawing, fields: Mapping[str, str], *, first: bool) -> Wording:
        """How it is drawn; only its source where another triangle is described in full."""
        if not first:
            return Wording("ν", drawing.words("step.normal-again", **fields))
        cut, over = self.in_full(drawing, "step.normal-over")
        return Wording("ν1", drawing.words.clauses((cut, over)))

    def in_full(self, drawing: Drawing, over: str) -> tuple[str, str]:
        """The instruction for its right triangle in two parts: up to the cut, and the half turn.

        ``over`` is the key of the second part.
        """
        speed = symbol(self.speed)
        fields = {
            **self.symbols(),
            **self.corner_symbols(drawing, *self.lettered),
            "a": self.symbol(drawing),
            "set": set_length(drawing, speed),
            "more": laid_times(drawing),
        }
        return drawing.words("step.normal-cut", **fields), drawing.words(over, **fields)

    def parts_of_sentence(self, drawing: Drawing) -> Iterator[tuple[int, str]]:
        """The instruction in two parts: the velocity and the cut, then the half turn."""
        if self.cut is None or self.vector is None or not self.is_drawn(drawing):
            yield from super().parts_of_sentence(drawing)
            return
        cut, over = self.in_full(drawing, "step.normal-over-apart")
        yield self.cut, cut
        yield self.vector, over

    def stands_at(self, drawing: Drawing) -> int | None:
        """The pin, where its triangle is drawn."""
        return None if self.is_hidden(drawing) else self.pin

    def picked_from(self, picks: Picks) -> tuple[str | None, ...]:
        """The pin, the bar, and the velocity of the pin about the bar's other end."""
        bar, arrow = picks.bar(self.pivot, self.pin), picks.arrow(self.pivot_image, self.pin_image)
        return picks.point_or_line(self.pin), bar, arrow

    def shown_between(self) -> tuple[int | None, ...]:
        """The pin and the end of the component."""
        return self.pin, self.end

    def section(self, drawing: Drawing) -> str:
        return "normals" if self.read in drawing.trace.values else "normals_computed"

    def relation(self, drawing: Drawing) -> Relation:
        """The square of the relative velocity over the bar, and its drawn length."""
        length, size = length_of(drawing, self.p, self.q), drawing.settled(self.size(drawing))
        speed, result = (size * length) ** 0.5, answer(drawing, size)
        v, over = put_in(drawing, result, lambda v, over: v * v / over, speed, length)
        return Relation(
            self.symbol(drawing),
            f"{symbol(self.speed)}^2/{bar(self.p, self.q)}",
            f"{squared(v)}/{over}",
            result,
            "m/s^2",
            laid_off_words(drawing, "laid_off", size, p=symbol(self.p), q=symbol(self.q)),
            over=((self.p, self.q),),
        )

    # --- marking students' work ------------------------------------------------------------------

    @property
    def ends(self) -> tuple[int, int, int, int]:
        """The places and images of both points, which also give ω of their link."""
        return self.pivot, self.pin, self.pivot_image, self.pin_image

    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """v²/l and ω²·l from the student's own values."""
        bar = own.length(self.pivot, self.pin)
        for v in own.vectors(self.pivot_image, self.pin_image):
            yield Size((v, v), v.size**2 / bar, bar)
        for omega in own.turnings_over(self.ends):
            yield Size((omega, omega), omega.size**2 * bar, bar)

    def proportions(self, values: Mapping[int, Any], seconds: Any) -> Iterator[tuple[str, Any]]:
        """v/l of its right triangle."""
        p, q, tail, tip = (values[end] for end in self.ends)
        yield self.speed, abs(tip - tail) * seconds / abs(q - p)

    def power_of(self, args: tuple[int, ...]) -> int:
        """2 for the rate of its own link, because it grows with the square; otherwise 0."""
        return 2 if args == self.ends else 0


# --- writing its steps ---------------------------------------------------------------------------


def normal_component(
    pen: Pen,
    pivot: str,
    pin: str,
    kind: Callable[..., NormalComponent] = NormalComponent,
    drawn: Callable[[str], dict[str, int]] | None = None,
) -> int:
    """The normal component of a pin about a pivot; by hand the right triangle on the mechanism.

    For another ``kind`` of construction, ``drawn`` draws its steps from the index.
    """
    key = ("normal", pivot, pin)
    if key in pen.shared:
        return pen.shared[key]
    places = pen.the("position", pivot), pen.the("position", pin)
    images = pen.the("velocity", pivot), pen.the("velocity", pin)
    relative_arrow(pen, pin, pivot)
    index = about(pen, pin, pivot)
    with pen.on(Part.NORMAL, Plane.MECHANISM), pen.calls_for("normal components"):
        own = drawn(index) if drawn else right_triangle(pen, places, images, letter(pin), index)
    with pen.on(Part.NORMAL, Plane.NUMBERS), pen.calls_for("normal components"):
        name = f"a_{index}^ν"
        vector = pen.draw_shared(key, normal, *places, *images, name=name, by_hand=own["read"])
    pen.make(
        kind(
            index=index,
            p=letter(pivot),
            q=letter(pin),
            v=against(pen, pin, pivot),
            pivot=places[0],
            pin=places[1],
            pivot_image=images[0],
            pin_image=images[1],
            vector=vector,
            **own,
        )
    )
    return vector


def right_triangle(
    pen: Pen, places: tuple[int, int], images: tuple[int, int], point: str, index: str
) -> dict[str, int]:
    """The triangle: velocity at the pin, perpendicular at its tip, cut, half turn (figure 4)."""
    seconds = pen.seconds()
    pivot, pin = places
    names = [f"{bare(point)}{prime}_{index}" for prime in PRIMES]
    with pen.hands_way():
        tip = pen.draw(set_way, pin, *images, seconds, name=names[0])
        edge = pen.draw(perpendicular_at, tip, pivot)
        line = pen.draw(bar_line, pivot, pin)
        cut = pen.draw(meet, edge, line, name=names[1])
        end = pen.draw(turn_over, cut, pin, name=names[2])
        with pen.on(Part.NORMAL, Plane.NUMBERS):
            read = pen.draw(normal_by_hand, pin, end, seconds)
    return {"tip": tip, "edge": edge, "line": line, "cut": cut, "end": end, "read": read}


def bare(point: str) -> str:
    """The letter of a point without its index: B for B, B2 and B_left."""
    return point.partition(",")[0].partition("_")[0].rstrip("0123456789")


def lay_off_normal(pen: Pen, pivot: str, pin: str, vector: int) -> int:
    """The normal component laid off from the pivot's acceleration image, parallel to the bar."""
    start, component = pen.the("acceleration", pivot), pen.steps[vector].of
    assert isinstance(component, NormalComponent)
    with pen.calls_for("normal components"):
        end = pen.draw(lay_off, start, vector)
    pen.make(LaidOff(component=component, start=start, corner=end))
    component_arrow(pen, start, end, "ν", pin, pivot)
    return end


# --- several in one sentence ---------------------------------------------------------------------


def with_normals_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The list with the right triangles after the first merged into one sentence.

    That sentence follows the first triangle, which is described in full. Components too short to be
    drawn are listed at its end. Those that come before any triangle have a sentence of their own,
    because the plan is drawn without them there.
    """
    short = [sentence for sentence in found if sentence.name == "short"]
    too_short = drawing.words("step.too-short", list=COMMA.join(s.markup for s in short))
    first = next((said for said in found if said.name in ("ν", "ν1", "short")), None)
    if first in short:
        found, short = together(found, short, too_short), []
    found = [sentence for sentence in found if sentence not in short]
    rest = [sentence for sentence in found if sentence.name == "ν"]
    kept = [sentence for sentence in found if sentence.name != "ν"]
    place = next((i for i, sentence in enumerate(kept) if sentence.name == "ν1"), None)
    if rest:
        place = found.index(rest[0]) if place is None else place + 1
        tail = drawing.words("step.normals-again", list=COMMA.join(s.markup for s in rest))
        found = [*kept[:place], in_one(rest, "ν", tail), *kept[place:]]
    if short and place is not None:
        said = found[place]
        found[place] = in_one(
            [said, *short], said.name, drawing.words.clauses((said.markup, too_short))
        )
    return found


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
    across: OwnStep | None = None
    corner: OwnStep | None = None
    around: OwnStep | None = None
    over: OwnStep | None = None
    chord: OwnStep | None = None
    foot: OwnStep | None = None
    whole: OwnStep | None = None

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
        markup = drawing.words.clauses(markup for _, markup in self.in_parts(drawing))
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
        fields["more"] = "" if times == 1 or drawing.lengths != "drawn" else larger
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
        circles = {"around": around, "over": over, "chord": chord, "foot": foot, "whole": whole}
        return {"across": across, "line": line, "corner": corner, **circles, "read": read}

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


class TangentialDirection(PerpendicularThrough, frozen=True, kw_only=True):
    """The ``line`` along which the tangential component of a pin about a pivot lies."""

    reasons: ClassVar[Mapping[str, str]] = {"line": "why.tangential"}
    along_bar: ClassVar[str] = "turn.wrong.tangential_along_bar"

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause: through the normal component's end, or its start if it is too short."""
        fields = {"vector": drawing.symbol(f"a_{self.index}^τ"), **self.symbols()}
        laid = component_ending_at(drawing.trace.program, self.start)
        if laid is not None and laid.is_short(drawing):
            start = drawing.lettered(laid.start)
            return drawing.words("step.square-to", s=start, **fields)
        foot = drawing.symbol(letter_at(drawing, self.start))
        return drawing.words(f"step.square-to-{'foot' if foot else 'end'}", s=foot, **fields)

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line without the normal component, along the bar, or from the pole."""
        if before := forgotten(picks, steps, self.start):
            _, *ends = steps[self.line].args
            key, start = before
            yield KnownError(key, self.line, PERPENDICULAR, (start, picks.bar(*ends)))
        yield from super().errors(picks, steps)


def tangential_direction(pen: Pen, pivot: str, pin: str, corner: int) -> int:
    """The perpendicular to a bar through the end of its normal component."""
    ends = pen.the("position", pivot), pen.the("position", pin)
    with pen.calls_for("tangential components"):
        line = pen.draw(square_to, corner, *ends)
    names = {
        "p": letter(pivot),
        "q": letter(pin),
        "index": about(pen, pin, pivot),
        "whole": lettered(pin),
        "base": lettered(pivot),
    }
    pen.make(TangentialDirection(**names, start=corner, line=line))
    return line


class BarAcceleration(Struct, frozen=True):
    """The line that a bar to a known ``pivot`` gives for the acceleration of a ``point``."""

    pivot: str
    point: str

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> int:
        """The known normal component, drawn by the method that the scene asks for in a dyad."""
        if sides is None or pen.scene.sheet.method != KLEIN:
            return normal_component(pen, self.pivot, self.point)

        return component_in_dyad(pen, sides, self.pivot, self.point)

    def end(self, pen: Pen, vector: int | None) -> int:
        """The end of the known part in the plan."""
        assert vector is not None
        return lay_off_normal(pen, self.pivot, self.point, vector)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The known end, and the line of the rest."""
        end = self.end(pen, vector)
        return end, tangential_direction(pen, self.pivot, self.point, end)

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Draw the arrow of the rest."""
        component_arrow(pen, end, found, "τ", self.point, self.pivot)

    def finish(self, pen: Pen) -> None:
        """Draw the arrow from the pole."""
        if not is_under(self.point):
            acceleration_arrow(pen, self.point)


def known_and_free(pen: Pen, pivot: str, pin: str) -> tuple[int, int]:
    """The end of the known part of a pin's acceleration about a pivot, and the line of the rest."""
    vector = normal_component(pen, pivot, pin)
    with ACCELERATION.drawn(pen):
        end = lay_off_normal(pen, pivot, pin, vector)
        return end, tangential_direction(pen, pivot, pin, end)


def refuse_unused_method(pen: Pen) -> None:
    """Raise StructureError where the scene's method for components applies to none of them."""
    if pen.scene.sheet.method == KLEIN:
        refuse_unused(pen)
