"""Kutzbach's plan of a gear train: its velocities over an axis, and its speeds from one pole.

The axis is drawn next to the velocity plan. On the axis, the centres and pitch points of the wheels
are as far apart as on the mechanism; lines through them are folded onto the axis. The velocity of
each point is drawn perpendicular to the axis. The tips of one link lie on one line, its ray, whose
slope is the angular velocity. Parallels to the rays through one pole cut the line of speeds in
proportion to the angular velocities.

Source: K. Kutzbach, Mehrgliedrige Radgetriebe und ihre Gesetze, Maschinenbau 6 (1927); as in G.
Niemann and H. Winter, Maschinenelemente II, on epicyclic gears.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar, NamedTuple

from graphkin.construction.core.bases import contact_name
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
from graphkin.construction.core.pen import Pen, image
from graphkin.construction.core.program import SPEEDS, OwnStep, Part, Plane
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.plan import VELOCITY
from graphkin.construction.velocity.image_of_link import image_under
from graphkin.drawing.style import CHAIN_LINES
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line, dot
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.pairs import Contact, contacts
from graphkin.text import NOTHING
from graphkin.text.errors import NO_WORDS, Message, Problem, StructureError, message

PLAN = "kutzbach"
"""The value of [sheet] plan that asks for this plan."""
BEGINNING = "turn.say.kutzbach"
"""The key of the words on a page before a student draws the plan."""


# --- values --------------------------------------------------------------------------------------


@action("ladder-axis")
def axis_through(o: Point, p: Point, q: Point) -> Line:
    """The parallel to the line of centres through the pole."""
    return Line(o, q - p)


@action("ladder-foot")
def foot_beyond(before: Point, axis: Line, p: Point, q: Point, seconds: Real, side: int) -> Point:
    """A point on the axis, at the distance of two points of the mechanism from another foot."""
    return before + axis.along / abs(axis.along) * (side * abs(q - p) / seconds)


@action("ladder-tip")
def tip_over(
    foot: Point, axis: Line, p: Point, q: Point, o: Point, velocity: Point, side: int
) -> Point:
    """The tip of a point's velocity, perpendicular to the axis over the point's foot.

    The velocity itself is perpendicular to the line from ``p`` to ``q``.
    """
    square = 1j * (q - p) / abs(q - p) * side
    return foot + 1j * axis.along / abs(axis.along) * dot(square, velocity - o)


@action("ladder-ray")
def ray_through(first: Point, last: Point, *others: Point) -> Line:
    """The line through the tips of two points of a link, on which its other tips also lie."""
    return Line(first, last - first)


@action("ladder-speeds")
def line_of_speeds(start: Point, axis: Line) -> Line:
    """The line perpendicular to the axis on which speeds are cut off."""
    return Line(start, 1j * axis.along)


@action("ladder-parallel")
def parallel_to_ray(pole: Point, ray: Line) -> Line:
    """The parallel to a ray through the pole of speeds."""
    return Line(pole, ray.along)


@action("ladder-speed")
def speed_cut(
    start: Point, axis: Line, cut: Point, p: Point, q: Point, seconds: Real, pole: Point
) -> Real:
    """The angular velocity at a cut: its distance from the axis over the pole's distance."""
    along = axis.along / abs(axis.along)
    return dot(1j * along, cut - start) / (dot(along, start - pole) * seconds)


@action("ladder-kept")
def kept(omega: Real) -> Real:
    """The angular velocity of a link, unchanged; its ray gives the same value."""
    return omega


# --- constructions -------------------------------------------------------------------------------


class LadderAxis(Construction, frozen=True, kw_only=True):
    """The ``axis``, parallel to the line of centres ``p`` and ``q``, and the first foot on it."""

    reasons: ClassVar[Mapping[str, str]] = {"start": "why.ladder_axis"}
    lines: ClassVar[Mapping[str, str]] = {"axis": "the axis"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"start": ByHand.LAID_OFF}

    p: str
    q: str
    name: str
    axis: OwnStep
    start: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the axis as a chain line, with its first foot."""
        if role == "axis":
            canvas.line(CHAIN_LINES, "")
        else:
            canvas.image()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the direction of the axis and the points on it."""
        fields = {
            "bar": bar(self.p, self.q),
            "p": symbol(self.p),
            "name": drawing.symbol(self.name),
        }
        return drawing.words("step.ladder-axis", **fields)


class LadderPoint(Construction, frozen=True, kw_only=True):
    """The ``foot`` of a point on the axis, and over it the ``tip`` of the point's velocity.

    ``before`` is the foot from which it is laid off. A fixed point has no ``tip``: its foot is its
    tip.
    """

    reasons: ClassVar[Mapping[str, str]] = {"tip": "why.ladder_tip"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(("foot", "tip"), ByHand.LAID_OFF)

    point: str
    before: int
    velocity: int | None
    foot: OwnStep
    tip: OwnStep | None

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the point, and its velocity over its foot."""
        if role == "tip":
            canvas.leg("", "ordinate", canvas.value(self.foot), canvas.value(self.tip or 0))
        canvas.image()

    def drawn(self, drawing: Drawing, start: int, end: int) -> str:
        """The letters and the drawn length of a vector of the plan."""
        values = drawing.trace.values
        letters = drawing.lettered(start) + drawing.lettered(end)
        way = drawing.settled(abs(values[end] - values[start]))
        return f"{letters} = {plan_amount(drawing, Plane.VELOCITIES, way)}"

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the drawn distance to the foot, or for the velocity over it."""
        if role == "foot":
            drawn = self.drawn(drawing, self.before, self.foot)
            return drawing.words("step.ladder-foot", p=symbol(self.point), drawn=drawn)
        assert self.tip is not None
        drawn = self.drawn(drawing, self.foot, self.tip)
        return drawing.words("step.ladder-tip", v=symbol(f"v_{self.point}"), drawn=drawn)


class LadderRay(JoinsPoints, frozen=True, kw_only=True):
    """The ``ray`` of a ``link`` through the tips ``first`` and ``last`` of two of its points."""

    reasons: ClassVar[Mapping[str, str]] = {"ray": "why.ladder_ray"}
    lines: ClassVar[Mapping[str, str]] = {"ray": "the ray of link {link}"}
    joins: ClassVar[frozenset[str]] = frozenset({"ray"})

    link: str
    first: int
    last: int
    ray: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the ray, labelled with its link."""
        canvas.leg("", "construction", canvas.value(self.first), canvas.value(self.last))
        canvas.locus("", escape(self.link))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence for the tips through which the ray passes."""
        ends = (drawing.lettered(n) for n in (self.first, self.last))
        fields = dict(zip("ab", ends, strict=True))
        return drawing.words("step.ladder-ray", k=escape(self.link), **fields)


class SpeedPole(Construction, frozen=True, kw_only=True):
    """The ``pole`` of speeds on the axis, and the ``line`` of speeds through ``start``.

    Their distance is that of ``p`` and ``q``, the centre and the rim of a wheel.
    """

    reasons: ClassVar[Mapping[str, str]] = {"start": "why.ladder_scale"}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line of speeds"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(("pole", "start"), ByHand.LAID_OFF)

    p: str
    q: str
    pole: OwnStep
    start: OwnStep
    line: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw both points, and the line."""
        if role == "line":
            canvas.line()
        else:
            canvas.image()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentences for the pole, which is free, and for the distance of the line from it."""
        values = drawing.trace.values
        pole, start = (drawing.lettered(n) for n in (self.pole, self.start))
        if role == "pole":
            return drawing.words("step.ladder-pole", pole=pole)
        way = abs(values[self.start] - values[self.pole])
        drawn = plan_amount(drawing, Plane.VELOCITIES, way)
        return drawing.words("step.ladder-speeds", pole=pole, name=start, drawn=drawn)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The scale of speeds: the scale of velocities over the length between pole and line."""
        if role == "line":
            scale, length = scale_of(drawing, Plane.VELOCITIES) / 1000, self.length(drawing)
            figures = f"{figure(drawing, scale)}/{figure(drawing, length)}"
            whole = drawing.in_signs(f"*k*_v/{bar(self.p, self.q)}")
            result, unit = answer(drawing, scale / length), "(rad/s)/mm"
            name = drawing.in_signs("*k*_n")
            yield Relation(name, whole, figures, result, unit, over=((self.p, self.q),))

    def length(self, drawing: Drawing) -> float:
        """The distance of the wheel's centre from its rim, in metres."""
        standing = drawing.standing
        return abs(standing.spot(self.q) - standing.spot(self.p))


class SpeedRead(GivesRate, frozen=True, kw_only=True):
    """The speed of a ``link``: the ``cut`` of the ``parallel`` to its ray with the line of speeds.

    ``rate`` is its angular velocity and ``read`` the same value from the drawing; a driven link has
    neither.
    """

    reasons: ClassVar[Mapping[str, str]] = {"cut": "why.ladder_speed"}
    lines: ClassVar[Mapping[str, str]] = {"parallel": "the parallel to the ray of link {link}"}

    link: str
    scale: SpeedPole
    parallel: OwnStep
    cut: OwnStep
    read: OwnStep | None = None
    rate: OwnStep | None = None

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the parallel from the pole to the point that it cuts off."""
        if role == "cut":
            pole = canvas.value(self.scale.pole)
            canvas.leg("", "construction", pole, canvas.value(self.cut))
            canvas.image()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point that the parallel cuts off."""
        pole, name = (drawing.lettered(number) for number in (self.scale.pole, self.cut))
        return drawing.words("step.ladder-speed", pole=pole, name=name, k=escape(self.link))

    def rate_relation(self, drawing: Drawing, link: str, tail: tuple[str, str, str]) -> Relation:
        """The relation: the scale of speeds times the length that the parallel cuts off."""
        values = drawing.trace.values
        start, cut = (drawing.lettered(number) for number in (self.scale.start, self.cut))
        scale = scale_of(drawing, Plane.VELOCITIES) / 1000 / self.scale.length(drawing)
        drawn = abs(float(values[self.rate or 0])) / scale
        figures = f"{figure(drawing, scale)}·{drawing.words.fixed(drawn, 2)}"
        return Relation(
            symbol(f"ω_{link}"), drawing.in_signs(f"*k*_n·{start}{cut}"), figures, *tail
        )


# --- sentences -----------------------------------------------------------------------------------

GROUPS = {"foot": LadderPoint, "tip": LadderPoint, "ray": LadderRay, "cut": SpeedRead}
"""The roles whose steps share one sentence, and their constructions."""


def with_ladder_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The sentences, with one each for all feet, all tips, all rays and all cuts."""
    steps = drawing.trace.program.steps
    for role, kind in GROUPS.items():
        own = [
            said
            for said in found
            if said.step >= 0 and steps[said.step].role == role
            if isinstance(construction(steps[said.step]), kind)
        ]
        if len(own) > 1:
            listed = drawing.words.clauses(short(drawing, said.step) for said in own)
            found = together(found, own, drawing.words(f"step.ladder-{role}s", list=listed))
    return found


def short(drawing: Drawing, number: int) -> str:
    """The words for one of several steps of a kind, after the words that they share."""
    steps = drawing.trace.program.steps
    kind, name = construction(steps[number]), drawing.lettered(number)
    match kind:
        case LadderPoint() if steps[number].role == "foot":
            return f"{kind.drawn(drawing, kind.before, number)}"
        case LadderPoint(velocity=velocity) if velocity is not None:
            return f"{kind.drawn(drawing, kind.foot, number)} ({symbol(f'v_{kind.point}')})"
        case LadderRay():
            ends = NOTHING.join(drawing.lettered(end) for end in (kind.first, kind.last))
            return f"{escape(kind.link)}{drawing.words('colon')}{ends}"
        case SpeedRead():
            return f"{escape(kind.link)}{drawing.words('colon')}{name}"
    raise TypeError(f"{kind} is listed alone")


# --- drawing: the wheels in the plan, and their positions on its axis -----------------------------


BESIDE = 0.2
"""Space from the velocity plan to the axis, and between the plans, as a fraction of the axis."""


class OnAxis(NamedTuple):
    """A point on the axis: its foot, its tip, and its coordinate at the scene's own numbers."""

    foot: int
    tip: int
    at: float


class Ladder:
    """Draws the plan of a train whose wheels turn about fixed centres, or on arms about these."""

    def __init__(self, pen: Pen) -> None:
        self.pen, self.scene = pen, pen.scene
        self.meshes = [
            each
            for each in contacts(pen.scene)
            if each.track is not None and each.rolling.belt is None and each.arm is not None
        ]
        self.centres: dict[str, OnAxis] = {}
        self.on: dict[str, list[OnAxis]] = {}
        self.axis, self.seconds = 0, 0

    # --- points ----------------------------------------------------------------------------------

    def refusal(self) -> Message:
        """The reason why a scene has no such plan; empty where it has one."""
        if any(each not in self.meshes for each in contacts(self.scene)):
            return message("a belt, a rack or a rolling wheel belongs to it")
        if not self.meshes:
            return message("no wheels touch")
        if self.turner() is None:
            return message("no driver turns with a speed")
        for point in self.moving():
            if self.arm_of(point) is None:
                return message("no arm about a fixed pin carries {point}", point=point)
        return NO_WORDS

    def turner(self) -> Driver | None:
        """The first driver that turns a link at a speed other than zero."""
        for driver in self.scene.drivers:
            if driver.kind == "turn" and not driver.speed.is_zero():
                return driver
        return None

    def moving(self) -> list[str]:
        """The centres of wheels that move."""
        found = dict.fromkeys(centre for each in self.meshes for centre in centres_of(each))
        return [centre for centre in found if centre not in self.scene.frame.points]

    def fixed(self) -> list[str]:
        """The fixed centres of wheels, and the fixed pins of arms, in the order of the frame."""
        every = (centre for each in self.meshes for centre in centres_of(each))
        arms = (arm[1] for centre in self.moving() if (arm := self.arm_of(centre)))
        found = {*every, *arms}
        return [point for point in self.scene.frame.points if point in found]

    def arm_of(self, centre: str) -> tuple[str, str] | None:
        """The link that carries a moving centre about a fixed pin, and that pin."""
        for link in self.scene.links.values():
            if centre in link.points and not any(w.centre == centre for w in link.wheels):
                pins = [point for point in link.points if point in self.scene.frame.points]
                if pins:
                    return link.name, pins[0]
        return None

    def spot(self, point: str) -> complex:
        """The position of a point at the scene's own numbers."""
        return complex(self.pen.peek(self.pen.the("position", point)))

    # --- steps -----------------------------------------------------------------------------------

    def draw(self) -> None:
        """Draw the axis, its points, the rays, the pole of speeds and the cuts of the parallels."""
        pen, driver = self.pen, self.turner()
        assert driver is not None
        with pen.on(Part.SHAPE, Plane.NUMBERS):
            self.seconds = pen.given("seconds", driver.speed)
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            self.begin()
            self.place_fixed()
            for centre in self.moving():
                self.place_moving(centre)
            for contact in self.meshes:
                self.place_contact(contact)
            rays = {link: self.ray(link) for link in self.scene.links if link in self.on}
            pole = self.speed_pole()
            for link, ray in rays.items():
                self.speed(link, ray, pole)

    def begin(self) -> None:
        """Draw the axis along the first line of centres, and the first fixed centre on it."""
        pen, first = self.pen, self.fixed()[0]
        every = dict.fromkeys(c for each in self.meshes for c in centres_of(each))
        other = next(centre for centre in (*every, *self.moving()) if centre != first)
        ends = pen.the("position", first), pen.the("position", other)
        o = pen.pole(Plane.VELOCITIES)
        self.axis = pen.draw(axis_through, o, *ends)
        extra = (BESIDE,)
        start = pen.draw(
            foot_beyond, o, self.axis, *ends, self.seconds, extra=extra, name=foot_name(first)
        )
        names = {"p": first, "q": other, "name": foot_name(first)}
        pen.make(LadderAxis(**names, axis=self.axis, start=start))
        self.centres[first] = OnAxis(start, start, 0.0)

    def place_fixed(self) -> None:
        """Draw the other fixed centres, each beyond a touching centre or beyond the first."""
        waiting = [centre for centre in self.fixed() if centre not in self.centres]
        while waiting:
            known, centre = next(self.reached(waiting), (next(iter(self.centres)), waiting[0]))
            self.put(centre, known, (known, centre), 1, moves=False)
            waiting.remove(centre)

    def reached(self, waiting: list[str]) -> Iterator[tuple[str, str]]:
        """The centres on the axis, with waiting centres whose wheels touch theirs."""
        for contact in self.meshes:
            for known, centre in (centres_of(contact), centres_of(contact)[::-1]):
                if known in self.centres and centre in waiting:
                    yield known, centre

    def place_moving(self, centre: str) -> None:
        """Draw the centre of a planet, at the arm's length from the pin of its arm."""
        arm = self.arm_of(centre)
        assert arm is not None
        link, pin = arm
        self.put(centre, pin, (pin, centre), 1, moves=True)
        self.carry(link, self.centres[pin], self.centres[centre])
        for wheel in self.wheels_about(centre):
            self.carry(wheel, self.centres[centre])

    def place_contact(self, contact: Contact) -> None:
        """Draw a pitch point in line with a fixed centre; other pitch points are left out."""
        fixed = [c for c in centres_of(contact) if c in self.scene.frame.points]
        if not fixed:
            return
        first = fixed[0]
        other = next(centre for centre in centres_of(contact) if centre != first)
        name = contact_name(contact)
        there, way = self.spot(name) - self.spot(first), self.spot(other) - self.spot(first)
        side = 1 if self.centres[other].at > self.centres[first].at else -1
        side *= 1 if dot(there, way) > 0 else -1
        self.put(name, first, (first, name), side, moves=True)
        for link in contact.links:
            own = contact.wheel_of(link).centre
            if link != FRAME:
                self.carry(link, self.centres[own], self.centres[name])

    def put(self, point: str, before: str, line: tuple[str, str], side: int, moves: bool) -> None:
        """Draw a point on the axis, and its velocity over it."""
        pen, start = self.pen, self.centres[before]
        ends = tuple(pen.the("position", end) for end in line)
        args = start.foot, self.axis, *ends, self.seconds
        foot = pen.draw(foot_beyond, *args, extra=(side,), name=foot_name(point))
        tip, velocity, o = None, None, pen.pole(Plane.VELOCITIES)
        if moves:
            velocity = self.velocity(point)
            known = foot, self.axis, *ends, o, velocity
            tip = pen.draw(tip_over, *known, extra=(side,), name=f"{image(point)}_x")
        pen.make(
            LadderPoint(point=str(point), before=start.foot, velocity=velocity, foot=foot, tip=tip)
        )
        at = start.at + side * abs(self.spot(line[1]) - self.spot(line[0]))
        self.centres[point] = OnAxis(foot, foot if tip is None else tip, at)

    def velocity(self, point: str) -> int:
        """The image of a point; for a pitch point, the image of either wheel's point."""
        if self.pen.has("velocity", point):
            return self.pen.the("velocity", point)
        links = next(c.links for c in self.meshes if contact_name(c) == point)
        for link in links:
            if self.pen.has("velocity", under(point, link)):
                return self.pen.the("velocity", under(point, link))
        return image_under(self.pen, links[1], point, VELOCITY)

    def wheels_about(self, centre: str) -> list[str]:
        """The links whose wheels turn about a moving centre."""
        links = self.scene.links.values()
        return [link.name for link in links if any(w.centre == centre for w in link.wheels)]

    def carry(self, link: str, *points: OnAxis) -> None:
        """Add points to those that a link carries, each once."""
        own = self.on.setdefault(link, [])
        own += [point for point in points if point not in own]

    def ray(self, link: str) -> int:
        """Draw the ray of a link through the two of its tips that are farthest apart."""
        own = sorted(self.on[link], key=lambda each: each.at)
        if len(own) < 2 or own[-1].at - own[0].at == 0:
            raise StructureError(
                problem(
                    message(
                        "link {link} touches no wheel about a fixed centre, so that it has no ray",
                        link=link,
                    )
                )
            )
        ends = own[0].tip, own[-1].tip
        ray = self.pen.draw(ray_through, *ends, *(each.tip for each in own[1:-1]))
        return self.pen.make(LadderRay(link=link, first=ends[0], last=ends[1], ray=ray)).ray

    def speed_pole(self) -> SpeedPole:
        """Draw the pole of speeds beyond the last point, and the line of speeds.

        Their distance is the radius of the smallest wheel.
        """
        pen, contact = self.pen, min(self.meshes, key=self.smallest)
        far = max(self.centres.values(), key=lambda each: each.at)
        near = next(name for name, each in self.centres.items() if each.at == 0)
        end = next(name for name, each in self.centres.items() if each is far)
        span = tuple(pen.the("position", point) for point in (near, end))
        aside = far.foot, self.axis, *span, self.seconds
        pole = pen.draw(foot_beyond, *aside, extra=(BESIDE,), name=self.free_letter())
        p, q = min(centres_of(contact), key=lambda c: self.rim(c, contact)), contact_name(contact)
        width = tuple(pen.the("position", point) for point in (p, q))
        start = pen.draw(foot_beyond, pole, self.axis, *width, self.seconds, extra=(1,), name="n_0")
        line = pen.draw(line_of_speeds, start, self.axis)
        return pen.make(SpeedPole(p=p, q=str(q), pole=pole, start=start, line=line))

    def free_letter(self) -> str:
        """The letter of the pole of speeds, which no point of the scene has."""
        links = (self.scene.frame, *self.scene.links.values())
        taken = {point for link in links for point in link.points}
        return next(letter for letter in ("S", "H", "Z", "Sn") if letter not in taken)

    def rim(self, centre: str, contact: Contact) -> float:
        """The distance of a centre from a pitch point."""
        return abs(self.spot(contact_name(contact)) - self.spot(centre))

    def smallest(self, contact: Contact) -> float:
        """The radius of the smaller of two wheels that touch."""
        return min(self.rim(centre, contact) for centre in centres_of(contact))

    def speed(self, link: str, ray: int, scale: SpeedPole) -> None:
        """Draw the point of a link on the line of speeds, and its angular velocity from it."""
        pen = self.pen
        parallel = pen.draw(parallel_to_ray, scale.pole, ray)
        cut = pen.draw(meet, parallel, scale.line, name=f"n_{link}")
        pen.want(SPEEDS, link, cut)
        read = rate = None
        known = pen.the(OMEGA, link) if pen.has(OMEGA, link) else None
        if known is not None and pen.steps[known].args:
            with pen.on(Part.RESULT, Plane.NUMBERS):
                ends = tuple(pen.the("position", point) for point in (scale.p, scale.q))
                with pen.hands_way():
                    args = scale.start, self.axis, cut, *ends, self.seconds, scale.pole
                    read = pen.draw(speed_cut, *args)
                rate = pen.draw(kept, known, name=link, by_hand=read)
            pen.want(OMEGA, link, rate)
        pen.make(
            SpeedRead(link=link, scale=scale, parallel=parallel, cut=cut, read=read, rate=rate)
        )


def centres_of(contact: Contact) -> tuple[str, str]:
    """The centres of two wheels that touch."""
    assert contact.track is not None
    return contact.wheel.centre, contact.track.centre


def foot_name(point: str) -> str:
    """The letter of a point on the axis."""
    return f"{point}_x"


def problem(found: Message) -> Problem:
    """The problem of a scene that has no such plan."""
    expected = message("wheels that touch, about fixed pins or on arms about these")
    return Problem(
        "sheet.plan", found, expected, message("leave plan out for the velocity plan alone")
    )


def draw_ladder(pen: Pen) -> None:
    """Draw Kutzbach's plan if the scene asks for it.

    Raises StructureError where it cannot be drawn.
    """
    if pen.scene.sheet.plan != PLAN:
        return
    ladder = Ladder(pen)
    if refused := ladder.refusal():
        raise StructureError(problem(refused))
    ladder.draw()
