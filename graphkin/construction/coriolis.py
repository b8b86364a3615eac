"""The Coriolis component of a sliding motion on a turning link: 2·ω × v, by two similar triangles.

The guide turns about its pivot, and twice the relative velocity turns with it. So 2v is set at the
guide's pivot, with a triangle similar to that of a guide's point and its velocity.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import takewhile
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import (
    LaidOff,
    Measured,
    OwnSizes,
    Size,
    TriangleComponent,
)
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import ByHand, Slip, Wording, construction
from graphkin.construction.core.naming import (
    NAUGHT,
    laid_off_words,
    plan_amount,
    rate_symbol,
    vector_of,
    way_of,
)
from graphkin.construction.core.palette import NUMBERS, PaletteAction, Picks
from graphkin.construction.core.pen import PRIME, Pen, has_arrow, letter
from graphkin.construction.core.program import (
    Effect,
    OwnStep,
    Part,
    Plane,
    PlanVector,
    foot_of,
    plan_vector,
)
from graphkin.construction.core.relation import (
    Relation,
    answer,
    figure,
    inverse,
    laid_times,
    put_in,
    set_length,
    twice_set,
)
from graphkin.construction.core.vocabulary import (
    action,
    join,
    lay_back,
    lay_off,
    meet,
    perpendicular_at,
    set_way,
)
from graphkin.construction.plan import omega_of
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line, cross
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.turning import turns
from graphkin.text import COMMA, NOTHING, saying

CORNERS = ("ef", "gh", "rs", "xy")
"""Letters for the corners of the triangle similar to the guide's."""

# --- its value, and the steps by hand ------------------------------------------------------------


@action("coriolis")
def coriolis(omega: Real, image_under: Point, image: Point) -> Point:
    """The Coriolis acceleration: 2·omega times the relative velocity, turned 90° with omega."""
    return 2j * (image - image_under) * omega


@action("coriolis-base")
def coriolis_base(pivot: Point, image_under: Point, image: Point, seconds: Real) -> Point:
    """Twice the relative velocity, set at the pivot of the guide, in the scale of the plan."""
    return pivot + 2 * (image - image_under) * seconds


@action("coriolis-ray")
def coriolis_ray(base: Point, pivot: Point, pin: Point, tip: Point) -> Line:
    """The line from the pivot at the same angle to the base as the tip's line has to the bar."""
    return Line(pivot, (base - pivot) * ((tip - pivot) / (pin - pivot)))


@action("coriolis-by-hand")
def coriolis_by_hand(base: Point, top: Point, seconds: Real) -> Point:
    """The Coriolis acceleration read off the similar triangle, in the scale of the plan."""
    return (top - base) / (seconds * seconds)


# --- the component -------------------------------------------------------------------------------


class CoriolisComponent(TriangleComponent, frozen=True, kw_only=True):
    """a_c = 2·ω × v_r of a ``point`` that slides on a ``guide``, and the triangles that give it.

    ``omega`` is the rate of the guide. ``tail`` and ``tip`` are the images of the point under the
    sliding point and of the sliding point itself. The triangles have a corner at the guide's
    ``pivot``. ``velocity`` is the tip of the velocity of the guide's point ``pin`` about the pivot,
    and ``foot`` is the tip of 2v. The lines ``edge`` and ``lean`` meet in ``top``.
    """

    sign: ClassVar[str] = "c"
    look: ClassVar[str] = "coriolis"
    effect: ClassVar[Effect] = "Coriolis"
    laid_off_key: ClassVar[str] = "coriolis"
    laid_off_reason: ClassVar[str] = "why.coriolis"
    follows: ClassVar[bool] = True
    gives_way: ClassVar[bool] = True
    reasons: ClassVar[Mapping[str, str]] = {"foot": "why.coriolis", "top": "why.triangles"}
    lines: ClassVar[Mapping[str, str]] = {"lean": "the leaning line", "edge": "⊥ at {foot}"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(("velocity", "foot"), ByHand.LAID_OFF)
    slips: ClassVar[Mapping[str, Slip]] = {
        "coriolis_missing": Slip(0, "serious"),
        "coriolis_reversed": Slip(-1, "moderate"),
        "coriolis_halved": Slip(0.5, "moderate"),
    }
    forgotten: ClassVar[str] = "turn.wrong.coriolis_forgotten"
    turned: ClassVar[str] = "turn.wrong.coriolis_turned"
    palette: ClassVar[PaletteAction] = PaletteAction(
        "coriolis",
        (("rate", ("rate",)), ("velocity", ("arrow",))),
        "(rate, velocity) => [scaled(quarter(value_of(velocity)), 2 * value_of(rate))]",
        plane=NUMBERS,
        typed=("cor",),
        draw=lambda things, rate, velocity: [
            2j * things.value_of(rate) * things.value_of(velocity)
        ],
    )
    titled: ClassVar[str] = "the Coriolis triangles of {pin_name} about {pivot_name}"

    guide: str
    block: str
    point: str
    omega: int
    tail: int
    tip: int
    pivot_name: str = ""
    pin_name: str = ""
    own_letters: str = ""
    pivot: int | None = None
    pin: int | None = None
    velocity: OwnStep | None = None
    foot: OwnStep | None = None
    edge: OwnStep | None = None
    lean: OwnStep | None = None
    top: OwnStep | None = None

    def speed(self, drawing: Drawing) -> str:
        """The name of the velocity along the guide from which it follows, as in its plan."""
        arrow = drawing.joins.get((self.tail, self.tip))
        vector = plan_vector(arrow) if arrow else None
        return vector.symbol if vector else f"v_{self.index}"

    def corner_letter(self, role: str) -> str:
        """One of two letters that no point has."""
        return dict(zip(("foot", "top"), self.own_letters, strict=False)).get(role, "")

    def symbols(self) -> Mapping[str, str]:
        """The guide, and the point that slides on it."""
        return {"k": self.guide, "q": symbol(self.point)}

    @classmethod
    def cause(cls, scene: Scene) -> str:
        """The guides on links that may turn."""
        return guides_words(moving_guides(scene))

    @classmethod
    def absence(cls, scene: Scene) -> str:
        """Why no guide turns; empty where one does."""
        return "" if moving_guides(scene) else no_moving_guide(scene)

    # --- drawing it ------------------------------------------------------------------------------

    def sides(self, canvas: Canvas | Measured) -> Iterator[Any]:
        """The component itself, and twice the relative velocity."""
        assert self.foot is not None and self.top is not None and self.pivot is not None
        foot, top, pivot = map(canvas.value, (self.foot, self.top, self.pivot))
        yield top - foot
        yield foot - pivot

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the velocity of the guide's point, 2v at the pivot, and the resulting triangle."""
        assert self.pivot is not None and self.pin is not None and self.velocity is not None
        assert self.foot is not None and self.top is not None
        drawing, value = canvas.drawing, canvas.value
        pivot = value(self.pivot)
        match role:
            case "velocity" if not self.is_shown_before(drawing):
                fixed = self.pivot_name in drawing.scene.frame.points
                name = f"v_{self.pin_name}" + ("" if fixed else self.pivot_name)
                canvas.vector(name, "relative-velocity", value(self.pin), value(self.velocity))
            case "foot":
                twice = f"2{self.speed(drawing)}"
                canvas.vector(twice, "relative-velocity", pivot, value(self.foot))
                canvas.point(self.letter(drawing, role), value(self.foot))
            case "edge":
                if canvas.line():
                    canvas.right_angle(pivot)
            case "lean":
                canvas.segment(pivot, value(self.velocity))
                canvas.line()
            case "top":
                canvas.vector(self.name, self.look, value(self.foot), value(self.top))
                canvas.point(self.letter(drawing, role), value(self.top))

    def same_velocity(self, drawing: Drawing) -> Iterator[tuple[int, TriangleComponent]]:
        """The triangles that set the same velocity at the same pin, with the step that sets it."""
        assert self.velocity is not None
        step = drawing.trace.program.steps[self.velocity]
        for number, other, _ in drawing.on_mechanism:
            if number == self.velocity or other.action is not step.action:
                continue
            kind = construction(other)
            if other.args != step.args or not isinstance(kind, TriangleComponent):
                continue
            if isinstance(kind, CoriolisComponent) or not kind.is_hidden(drawing):
                yield number, kind

    def is_shown_before(self, drawing: Drawing) -> bool:
        """Whether another kind's triangle, or an earlier Coriolis one, shows the velocity."""
        assert self.velocity is not None
        number, kind = next(self.same_velocity(drawing.choosing), (None, None))
        if number is None:
            return False
        return number < self.velocity or not isinstance(kind, CoriolisComponent)

    # --- its sentences ---------------------------------------------------------------------------

    def formula(self, drawing: Drawing) -> str:
        """2·ω·v, as markup."""
        speed = symbol(self.speed(drawing))
        return saying(f"2{rate_symbol(drawing, self.omega)}·{speed}", speed)

    def sentence(self, drawing: Drawing, *, first: bool) -> Wording:
        """The instruction: its triangles in full first, later only its source or value."""
        if self.is_left_out(drawing):
            return Wording("short", self.left_out(drawing))
        fields = self.fields(drawing)
        if drawing.settled(self.size(drawing)) == 0:
            return Wording(self.sign, drawing.words("step.coriolis-none", **fields))
        if not self.is_drawn(drawing):
            return Wording(self.sign, drawing.words("step.coriolis-computed", **fields))
        if not first and self.stands_as_before(drawing):
            return Wording(self.sign, drawing.words("step.coriolis-again", **fields))
        return Wording(self.sign, drawing.words.clauses(self.in_full(drawing, "step.coriolis-top")))

    def stands_as_before(self, drawing: Drawing) -> bool:
        """Whether the last drawn triangles have the same pivot and pin."""
        earlier = list(takewhile(lambda each: each is not self, drawn(drawing)))
        last = earlier[-1]
        return (last.pivot_name, last.pin_name) == (self.pivot_name, self.pin_name)

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The symbols and lengths that its sentences use."""
        segment = NOTHING.join(drawing.lettered(end) for end in (self.tail, self.tip))
        speed = symbol(self.speed(drawing))
        return {
            "a": self.symbol(drawing),
            "v": speed,
            "two": saying(f"2·{speed}", speed),
            "segment": twice_set(drawing, segment),
            "shorter": self.why_set(drawing),
            "why": self.why_computed(drawing),
            "zero": COMMA.join(self.zeros(drawing)),
            "omega": rate_symbol(drawing, self.omega),
            "drawn": plan_amount(drawing, Plane.ACCELERATIONS, self.size(drawing)),
        }

    def why_set(self, drawing: Drawing) -> str:
        """Why 2v is not as long as in the velocity plan; empty where it is."""
        m = drawing.scales.larger
        if m == 1:
            return ""
        if m > 1:
            return drawing.words("step.coriolis-shorter", m=figure(drawing, m))
        return drawing.words("step.coriolis-longer", m=inverse(drawing, m))

    def why_computed(self, drawing: Drawing) -> str:
        """The remark that the scale leaves no room for its triangles; empty where drawn."""
        if self.read is None or self.read in drawing.trace.values:
            return ""
        return drawing.words("step.coriolis-no-room")

    def zeros(self, drawing: Drawing) -> Iterator[str]:
        """The factors that are zero.

        If neither is exactly zero, the factor closer to zero counts.
        """
        values = drawing.trace.values
        slid = abs(values[self.tip] - values[self.tail]) / (
            drawing.longest(Plane.VELOCITIES) or 1.0
        )
        turned = drawing.rate_size(self.omega) / (drawing.fastest or 1.0)
        least = max(NOISE, min(slid, turned))
        if slid <= least:
            yield f"{symbol(self.speed(drawing))} = 0"
        if turned <= least:
            yield f"{rate_symbol(drawing, self.omega)} = 0"

    def in_full(self, drawing: Drawing, top: str) -> tuple[str, str]:
        """The instruction for its triangles in two parts: the perpendicular, and what cuts it.

        ``top`` is the key of the second part.
        """
        corners = self.corner_symbols(drawing, "foot", "top")
        fields = self.fields(drawing) | {
            "p": symbol(self.pivot_name),
            "q": symbol(self.pin_name),
            "bar": bar(self.pivot_name, self.pin_name),
            "e": corners["foot"],
            "f": corners["top"],
            "more": laid_times(drawing),
        }
        line = self.leaning_line(drawing, fields)
        foot = drawing.words("step.coriolis-foot", **fields)
        return foot, drawing.words(top, line=line, **fields)

    def parts_of_sentence(self, drawing: Drawing) -> Iterator[tuple[int, str]]:
        """The instruction in two parts: 2v with the perpendicular, and the line that cuts it."""
        if self.edge is None or self.vector is None or not self.is_drawn(drawing):
            yield from super().parts_of_sentence(drawing)
            return
        foot, top = self.in_full(drawing, "step.coriolis-top-apart")
        yield self.edge, foot
        yield self.vector, top

    def laid_alone(self, drawing: Drawing, **fields: str) -> str:
        """The sentence that the rest from its end is the acceleration along the guide."""
        guide = way_of(drawing, self.block)
        return drawing.words("step.coriolis-laid", guide=guide, **fields)

    def leaning_line(self, drawing: Drawing, fields: Mapping[str, str]) -> str:
        """The words for the line that cuts the perpendicular.

        Where every 2v lies on its guide, the line leads to the tip of the velocity itself.
        """
        assert self.velocity is not None
        _, start, end, _ = drawing.trace.program.steps[self.velocity].args
        w = set_length(drawing, vector_of(drawing, start, end, symbol(f"v_{self.pin_name}")))
        if not all(each.is_along(drawing) for each in drawn(drawing)):
            return drawing.words("step.coriolis-line", w=w, **fields)
        right = self.triangle_before(drawing)
        if right is None:
            return drawing.words("step.coriolis-line-tip", w=w, **fields)
        tip = right.corner_symbols(drawing, "tip")
        return drawing.words("step.coriolis-line-letter", **tip, **fields)

    def triangle_before(self, drawing: Drawing) -> TriangleComponent | None:
        """The earlier triangle of another kind whose tip is on the leaning line, or None."""
        assert self.velocity is not None
        for number, kind in self.same_velocity(drawing):
            if number < self.velocity and not isinstance(kind, CoriolisComponent):
                return kind
        return None

    def is_along(self, drawing: Drawing) -> bool:
        """Whether twice its relative velocity, set at the pivot, lies on the line of the guide."""
        assert self.foot is not None and self.pivot is not None and self.pin is not None
        values = drawing.trace.values
        foot, pivot, pin = values[self.foot], values[self.pivot], values[self.pin]
        beside = abs(cross(pin - pivot, foot - pivot)) / abs(pin - pivot)
        return bool(1000 * beside < NAUGHT * drawing.scales.kL)

    def picked_from(self, picks: Picks) -> tuple[str | None, ...]:
        """The angular velocity of the guide, and the relative velocity."""
        arrow = picks.arrow(self.tail, self.tip, symbol(f"v_{self.index}"))
        return picks.rate(self.omega), arrow

    def shown_between(self) -> tuple[int | None, ...]:
        """The side of the triangle from which it is read off."""
        return self.foot, self.top

    def section(self, drawing: Drawing) -> str:
        return "coriolis_components"

    def relation(self, drawing: Drawing) -> Relation:
        """Twice the angular velocity of the guide times the relative velocity."""
        values = drawing.trace.values
        omega = drawing.rate_size(self.omega)
        speed = abs(values[self.tip] - values[self.tail])
        rate, v = rate_symbol(drawing, self.omega), symbol(self.speed(drawing))
        size = drawing.settled(2 * omega * speed)
        result = answer(drawing, size)
        figures = put_in(drawing, result, lambda w, v: 2 * w * v, omega, speed)
        return Relation(
            self.symbol(drawing),
            f"2·{rate}·{v}",
            f"2·{'·'.join(figures)}",
            result,
            "m/s^2",
            laid_off_words(drawing, "quarter", size, v=v, omega=rate),
        )

    # --- marking students' work ------------------------------------------------------------------

    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """2·ω·v from the student's own values."""
        for omega in own.turnings(self.omega):
            for v in own.slidings(self.tail, self.tip):
                yield Size((omega, v), 2 * omega.size * v.size, float("inf"))

    def power_of(self, args: tuple[int, ...]) -> int:
        """1 for the speed along its guide, of which it is a multiple; otherwise 0."""
        return 1 if args[1:] == (self.tail, self.tip) else 0

    def as_measured(self, found: Mapping[int, Any], key: Mapping[int, Any]) -> Any:
        """2·ω·v from the student's velocities, even where these do not lie along the guide."""
        assert self.vector is not None
        if not key[self.vector]:
            return None
        slid = abs(found[self.tip] - found[self.tail]) / abs(key[self.tip] - key[self.tail])
        return found[self.omega] / key[self.omega] * slid * key[self.vector]


def drawn(drawing: Drawing) -> Iterator[CoriolisComponent]:
    """The Coriolis components whose leaning line is drawn on a sheet."""
    for number, step, _ in drawing.on_mechanism:
        kind = construction(step)
        if isinstance(kind, CoriolisComponent) and kind.lean == number:
            yield kind


# --- reasons -------------------------------------------------------------------------------------


def guides_words(blocks: list[str]) -> str:
    """The phrase for the guides on links that may turn."""
    if len(blocks) > 1:
        return f"the guides of {', '.join(blocks)} are on links that may turn"
    return f"the guide of {''.join(blocks)} is on a link that may turn"


def moving_guides(scene: Scene) -> list[str]:
    """The blocks whose guide is on a link that may turn."""
    return [
        link.name
        for link in scene.links.values()
        if any(slide.on != FRAME and turns(scene, slide.on) for slide in link.slides)
    ]


def no_moving_guide(scene: Scene) -> str:
    """The reason why nothing slides on a turning link."""
    fixed = [link.name for link in scene.links.values() if link.slides]
    if not fixed:
        return "no link slides"
    if len(fixed) > 1:
        return f"the guides of {', '.join(fixed)} do not turn"
    return f"the guide of {fixed[0]} does not turn"


# --- writing its steps ---------------------------------------------------------------------------


def coriolis_of(
    pen: Pen, link: str, tail: int, tip: int, point: str, block: str, *, index: str = ""
) -> int:
    """The Coriolis acceleration of a relative velocity (tail to tip in the plan) on a turning link.

    ``point`` is the sliding point, ``block`` the sliding link. ``index`` is the index of the
    velocity; by default the point is taken relative to the link's point under it.
    """
    key = ("coriolis", link, tail, tip)
    if key not in pen.shared:
        index = index or letter(point) + letter(under(point, link))
        with pen.calls_for("Coriolis"):
            triangles = similar_triangles(pen, link, tail, tip, point, index)
            read = triangles.get("read")
            with pen.on(Part.NORMAL, Plane.NUMBERS):
                rate = omega_of(pen, link)
                name = f"a_{index}^c"
                vector = pen.draw(coriolis, rate, tail, tip, name=name, by_hand=read)
        found = CoriolisComponent(
            index=index,
            guide=link,
            block=block,
            point=point,
            omega=rate,
            tail=tail,
            tip=tip,
            vector=vector,
            **triangles,
        )
        pen.shared[key] = vector
        pen.make(found)
    return pen.shared[key]


def similar_triangles(
    pen: Pen, link: str, tail: int, tip: int, point: str, index: str
) -> dict[str, Any]:
    """The steps by hand: twice the relative velocity at the pivot, and the similar triangle.

    Empty where no two points of the guide determine its rotation.
    """
    owner = pen.turner(link)
    if owner is None or pen.bases[owner].end is None:
        return {}
    base = pen.bases[owner]
    assert base.end is not None
    ends = base.start, base.end
    if has_arrow(pen, pen.the("velocity", base.end), pen.the("velocity", base.start)):
        ends = base.end, base.start  # the plan draws the velocity of the other point about this one
    pivot, pin = (pen.the("position", name) for name in ends)
    images = [pen.the("velocity", name) for name in ends]
    seconds = pen.seconds()
    both = corners(pen.scene)
    first, second = (f"{corner}_{index}" for corner in both)
    tip_name = f"{letter(point)}{PRIME}_c{index}"
    with pen.hands_way():
        with pen.on(Part.NORMAL, Plane.MECHANISM):
            velocity = pen.draw(set_way, pin, *images, seconds, name=tip_name)
            foot = pen.draw(coriolis_base, pivot, tail, tip, seconds, name=first)
            edge = pen.draw(perpendicular_at, foot, pivot)
            lean = pen.draw(coriolis_ray, foot, pivot, pin, velocity)
            top = pen.draw(meet, edge, lean, name=second)
        with pen.on(Part.NORMAL, Plane.NUMBERS):
            read = pen.draw(coriolis_by_hand, foot, top, seconds)
    return {
        "pivot_name": letter(ends[0]),
        "pin_name": letter(ends[1]),
        "own_letters": both,
        "pivot": pivot,
        "pin": pin,
        "velocity": velocity,
        "foot": foot,
        "edge": edge,
        "lean": lean,
        "top": top,
        "read": read,
    }


def corners(scene: Scene) -> str:
    """The letters of the triangle's corners: e and f, or others where points have these."""
    points = {name[0].lower() for name in scene.points}
    return next((pair for pair in CORNERS if not points & {*pair}), CORNERS[0])


def end_of(pen: Pen, start: int, vector: int, *, back: bool = False) -> int:
    """The end of the component laid off from a point, or ``back`` from it, with its arrow."""
    component = pen.steps[vector].of
    assert isinstance(component, CoriolisComponent)
    key = ("laid off", start, vector)
    if back or key not in pen.shared:
        with pen.calls_for("Coriolis"):
            pen.shared[key] = pen.draw(lay_back if back else lay_off, start, vector)
        corner = pen.shared[key]
        pen.make(LaidOff(component=component, start=start, corner=corner, back=back))
    corner = pen.shared[key]
    name, ends = component.name, (corner, start) if back else (start, corner)
    if name not in pen.arrows:
        sign, foot = component.sign, foot_of(component.sign, component.index)
        arrow = PlanVector("a", component.index, component.point, sign=sign, foot=foot, back=back)
        pen.vector(join, *ends, of=arrow)
    return corner
