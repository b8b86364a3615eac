"""Kutzbach's plan of a gear train: its velocities over an axis, and its speeds from one pole.

Beside the velocity plan an axis is drawn, on which the centres and pitch points of the wheels stand
as far apart as on the mechanism; the lines on which they lie are folded on to it. Square to it the
velocity of each is laid off. The tips of one link lie on one line, its ray, whose slope is its
angular velocity: parallels to the rays through one pole cut the line of speeds in proportion.

Source: K. Kutzbach, Mehrgliedrige Radgetriebe und ihre Gesetze, Maschinenbau 6 (1927); as in
G. Niemann and H. Winter, Maschinenelemente II, on epicyclic gears.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Construction,
    GivesRate,
    JoinsPoints,
    Sentence,
    construction,
    together,
)
from graphkin.construction.core.naming import plan_amount, scale_of
from graphkin.construction.core.program import Plane
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.style import CHAIN_LINES
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line, dot
from graphkin.text.markup import AND, NOTHING

PLAN = "kutzbach"
"""What a scene writes as [sheet] plan."""
BEGINNING = "turn.say.kutzbach"
"""What a page says of it before a student draws it."""


# --- the steps -----------------------------------------------------------------------------------


@action("ladder-axis")
def axis_through(o: Point, p: Point, q: Point) -> Line:
    """Through the pole the parallel to the line of centres."""
    return Line(o, q - p)


@action("ladder-foot")
def foot_beyond(before: Point, axis: Line, p: Point, q: Point, seconds: Real, side: int) -> Point:
    """On the axis, as far from another foot as two points of the mechanism are apart."""
    return before + axis.along / abs(axis.along) * (side * abs(q - p) / seconds)


@action("ladder-tip")
def tip_over(
    foot: Point, axis: Line, p: Point, q: Point, o: Point, velocity: Point, side: int
) -> Point:
    """Square to the axis the velocity of a point, which is square to its line from p to q."""
    square = 1j * (q - p) / abs(q - p) * side
    return foot + 1j * axis.along / abs(axis.along) * dot(square, velocity - o)


@action("ladder-ray")
def ray_through(first: Point, last: Point, *others: Point) -> Line:
    """The line through the tips of two points of a link, on which those of its others lie too."""
    return Line(first, last - first)


@action("ladder-speeds")
def line_of_speeds(start: Point, axis: Line) -> Line:
    """Square to the axis the line on which speeds are cut off."""
    return Line(start, 1j * axis.along)


@action("ladder-parallel")
def parallel_to_ray(pole: Point, ray: Line) -> Line:
    """Through the pole of speeds the parallel to a ray."""
    return Line(pole, ray.along)


@action("ladder-speed")
def speed_cut(
    start: Point, axis: Line, cut: Point, p: Point, q: Point, seconds: Real, pole: Point
) -> Real:
    """The angular velocity that a cut tells: its distance from the axis over that of the pole."""
    along = axis.along / abs(axis.along)
    return dot(1j * along, cut - start) / (dot(along, start - pole) * seconds)


@action("ladder-kept")
def kept(omega: Real) -> Real:
    """The angular velocity of a link, as its ray tells it too."""
    return omega


# --- what they are -------------------------------------------------------------------------------


class LadderAxis(Construction, frozen=True, kw_only=True):
    """The ``axis``, parallel to the line of centres ``p`` and ``q``, and the first foot on it."""

    gives: ClassVar[tuple[str, ...]] = ("axis", "start")
    reasons: ClassVar[Mapping[str, str]] = {"start": "why.ladder_axis"}
    lines: ClassVar[Mapping[str, str]] = {"axis": "the axis"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"start": ByHand.LAID_OFF}

    p: str
    q: str
    name: str
    axis: int
    start: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """The axis as a chain line, with its first foot."""
        if role == "axis":
            canvas.line(CHAIN_LINES, "")
        else:
            canvas.image()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How the axis lies, and what stands on it."""
        fields = {"bar": bar(self.p, self.q), "p": symbol(self.p), "name": symbol(self.name)}
        return drawing.words("step.ladder-axis", **fields)


class LadderPoint(Construction, frozen=True, kw_only=True):
    """The ``foot`` of a point on the axis, and the ``tip`` of its velocity square to that.

    ``before`` is the foot from which it is laid off; a fixed point is its own tip.
    """

    gives: ClassVar[tuple[str, ...]] = ("foot", "tip")
    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.ladder_tip"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(
        (
            "foot",
            "tip",
        ),
        ByHand.LAID_OFF,
    )

    point: str
    before: int
    velocity: int | None
    foot: int
    tip: int | None

    def marks(self, canvas: Canvas, role: str) -> None:
        """The point; over its foot the velocity."""
        if role == "tip":
            canvas.leg("", "ordinate", canvas.value(self.foot), canvas.value(self.tip or 0))
        canvas.image()

    def drawn(self, drawing: Drawing, start: int, end: int) -> str:
        """How long a way of the plan is drawn, by its letters."""
        values = drawing.trace.values
        letters = drawing.lettered(start) + drawing.lettered(end)
        way = drawing.settled(abs(values[end] - values[start]))
        return f"{letters} = {plan_amount(drawing, Plane.VELOCITIES, way)}"

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How long the way to it is drawn, and the velocity over it."""
        if role == "foot":
            drawn = self.drawn(drawing, self.before, self.foot)
            return drawing.words("step.ladder-foot", p=symbol(self.point), drawn=drawn)
        assert self.tip is not None
        drawn = self.drawn(drawing, self.foot, self.tip)
        return drawing.words("step.ladder-tip", v=symbol(f"v_{self.point}"), drawn=drawn)


class LadderRay(JoinsPoints, frozen=True, kw_only=True):
    """The ``ray`` of a ``link`` through the tips ``first`` and ``last`` of two of its points."""

    gives: ClassVar[tuple[str, ...]] = ("ray",)
    reasons: ClassVar[Mapping[str, str]] = {"ray": "why.ladder_ray"}
    lines: ClassVar[Mapping[str, str]] = {"ray": "the ray of link {link}"}
    joins: ClassVar[frozenset[str]] = frozenset({"ray"})

    link: str
    first: int
    last: int
    ray: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """The ray, with the link that it is of along it."""
        canvas.leg("", "construction", canvas.value(self.first), canvas.value(self.last))
        canvas.locus("", escape(self.link))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """Through which tips it goes."""
        ends = (drawing.lettered(n) for n in (self.first, self.last))
        fields = dict(zip("ab", ends, strict=True))
        return drawing.words("step.ladder-ray", k=escape(self.link), **fields)


class SpeedPole(Construction, frozen=True, kw_only=True):
    """The ``pole`` of speeds on the axis, and the ``line`` of speeds through ``start``.

    They stand as far apart as ``p`` and ``q``, the centre and the rim of a wheel.
    """

    gives: ClassVar[tuple[str, ...]] = ("pole", "start", "line")
    reasons: ClassVar[Mapping[str, str]] = {"start": "why.ladder_scale"}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line of speeds"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(
        (
            "pole",
            "start",
        ),
        ByHand.LAID_OFF,
    )

    p: str
    q: str
    pole: int
    start: int
    line: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Both points, and the line."""
        if role == "line":
            canvas.line()
        else:
            canvas.image()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How far apart both stand; the pole is free."""
        values = drawing.trace.values
        pole, start = (drawing.lettered(n) for n in (self.pole, self.start))
        if role == "pole":
            return drawing.words("step.ladder-pole", pole=pole)
        way = abs(values[self.start] - values[self.pole])
        drawn = plan_amount(drawing, Plane.VELOCITIES, way)
        return drawing.words("step.ladder-speeds", pole=pole, name=start, drawn=drawn)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The scale of speeds: that of velocities over the length that the pole's distance is."""
        if role == "line":
            scale, length = scale_of(drawing, Plane.VELOCITIES) / 1000, self.length(drawing)
            figures = f"{figure(drawing, scale)}/{figure(drawing, length)}"
            whole = f"*k*_v/{bar(self.p, self.q)}"
            result, unit = answer(drawing, scale / length), "(rad/s)/mm"
            yield Relation("*k*_n", whole, figures, result, unit, over=((self.p, self.q),))

    def length(self, drawing: Drawing) -> float:
        """The distance of the wheel's centre from its rim, in metres."""
        standing = drawing.standing
        return abs(standing.spot(self.q) - standing.spot(self.p))


class SpeedRead(GivesRate, frozen=True, kw_only=True):
    """The speed of a ``link``: the ``cut`` of the ``parallel`` to its ray with the line of speeds.

    ``rate`` is its angular velocity, ``read`` the same by the drawing; of a driven link neither.
    """

    gives: ClassVar[tuple[str, ...]] = ("parallel", "cut", "read", "rate")
    reasons: ClassVar[Mapping[str, str]] = {"cut": "why.ladder_speed"}
    lines: ClassVar[Mapping[str, str]] = {"parallel": "the parallel to the ray of link {link}"}

    link: str
    scale: SpeedPole
    parallel: int
    cut: int
    read: int | None = None
    rate: int | None = None

    def marks(self, canvas: Canvas, role: str) -> None:
        """The parallel from the pole to the point that it cuts off."""
        if role == "cut":
            pole = canvas.value(self.scale.pole)
            canvas.leg("", "construction", pole, canvas.value(self.cut))
            canvas.image()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """What the parallel cuts off."""
        pole, name = (drawing.lettered(number) for number in (self.scale.pole, self.cut))
        return drawing.words("step.ladder-speed", pole=pole, name=name, k=escape(self.link))

    def rate_relation(self, drawing: Drawing, link: str, tail: tuple[str, str, str]) -> Relation:
        """The scale of speeds times what the parallel cuts off."""
        values = drawing.trace.values
        start, cut = (drawing.lettered(number) for number in (self.scale.start, self.cut))
        scale = scale_of(drawing, Plane.VELOCITIES) / 1000 / self.scale.length(drawing)
        drawn = abs(float(values[self.rate or 0])) / scale
        figures = f"{figure(drawing, scale)}·{drawing.words.fixed(drawn, 2)}"
        return Relation(symbol(f"ω_{link}"), f"*k*_n·{start}{cut}", figures, *tail)


# --- saying it -----------------------------------------------------------------------------------

GROUPS = {"foot": LadderPoint, "tip": LadderPoint, "ray": LadderRay, "cut": SpeedRead}
"""The roles whose steps are told in one sentence, and whose they are."""


def with_ladder_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The points of the axis said in one sentence, and the velocities over it, the rays, what the
    parallels cut off."""
    steps = drawing.trace.program.steps
    for role, kind in GROUPS.items():
        own = [
            said
            for said in found
            if said.step >= 0 and steps[said.step].role == role
            if isinstance(construction(steps[said.step]), kind)
        ]
        if len(own) > 1:
            told = AND.join(short(drawing, said.step) for said in own)
            found = together(found, own, drawing.words(f"step.ladder-{role}s", list=told))
    return found


def short(drawing: Drawing, number: int) -> str:
    """What is said of one of several steps of a kind, after what is said of all."""
    steps = drawing.trace.program.steps
    kind, name = construction(steps[number]), drawing.lettered(number)
    match kind:
        case LadderPoint() if steps[number].role == "foot":
            return f"{kind.drawn(drawing, kind.before, number)}"
        case LadderPoint(velocity=velocity) if velocity is not None:
            return f"{kind.drawn(drawing, kind.foot, number)} ({symbol(f'v_{kind.point}')})"
        case LadderRay():
            ends = NOTHING.join(drawing.lettered(end) for end in (kind.first, kind.last))
            return f"{escape(kind.link)}: {ends}"
        case SpeedRead():
            return f"{escape(kind.link)}: {name}"
    raise TypeError(f"{kind} is told alone")
