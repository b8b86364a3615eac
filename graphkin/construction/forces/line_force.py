"""Forces whose lines of action are known: their sizes by moments about a point.

The force of a cam acts along the common normal. The force in an outer pin of a group of class III
acts along its bar, once the part across the bar is known; moments are taken about the point in
which the lines of two other bars meet (Assur's point). The force between two links that slide
along each other is normal to their guide.

Teeth push along a line at the pressure angle to the common tangent, so that they also push the
wheels apart. Plain wheels carry a force along the tangent alone. The strands of a belt pull along
common tangents of its wheels: the moments of the loads of a wheel about its centre give the
difference of both tensions. The scene states what fixes them: the tension of the slack strand, the
mean of both, or their ratio.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import combinations
from typing import Any, ClassVar, NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Canvas, Construction, Slip
from graphkin.construction.core.naming import way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure, put_in
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.forces.loads import STRANDS, force_amount, newtons, sub
from graphkin.construction.forces.moments import (
    SEEN,
    ForceByMoments,
    Moments,
    arm,
    moment_sum,
    of_moments,
    right_angle,
    sums_of,
)
from graphkin.construction.forces.polygon import (
    REACTION,
    DrawnSide,
    InPolygon,
    KnownSide,
    Polygon,
    SideDirection,
    draw_sides,
    links_words,
    of_side,
    read_side,
    sides_words,
)
from graphkin.drawing.symbol_markup import bar, escape, of_wheel, symbol
from graphkin.numbers.arithmetic import Point, Real, at, pick, sqrt
from graphkin.numbers.plane import Line, cross, crossing_sine, dot
from graphkin.scene.model import TENSIONS, Belt, Scene, Wheel

LETTERS = ("W", "Z", "N", "W0", "Z0", "N0")
"""The names of Assur's point, the first of which is free."""


@action("foot-on-line")
def foot_on_line(point: Point, line: Line) -> Point:
    """The foot of the perpendicular from a point to a line."""
    return arm.value(point, line.point, line.along)


@action("line-force")
def line_force(about: Point, foot: Point, line: Line, *rest: Any) -> Point:
    """The force along a line that balances the moments about a point with its foot on the line."""
    unit = line.along / abs(line.along)
    return -moment_sum(about, rest) / cross(foot - about, unit) * unit


class ForceOnLine(ForceByMoments, frozen=True, kw_only=True):
    """A force along a known line through a point, with its arm called ``number``.

    ``through`` is the step of the point, ``foot`` is the end of the arm on the line.
    """

    number: str
    through: int
    foot: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line as far as the foot, and the arm with its dimension."""
        about, through, foot = map(canvas.value, (self.moments.about, self.through, self.foot))
        if role != "foot" or canvas.size(foot - about) <= SEEN or not canvas.holds(about):
            return
        canvas.leg(self.name, "ray", through, foot)
        canvas.dimension(self.number, about, foot)
        along = foot - through
        way = along if canvas.size(along) > SEEN else 1j * (about - foot)
        right_angle(canvas, foot, about, way)

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The distance of the line."""
        return [(symbol(self.number), self.reach(drawing, self.foot))]


class LineForce(ForceOnLine, frozen=True, kw_only=True):
    """The force ``name`` on some ``links`` along a line, whose direction is the ``way``.

    ``cam`` says that the line is the common normal of a cam and its follower.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_line"}
    none: ClassVar[str] = "step.force-line-none"

    links: tuple[str, ...]
    way: SideDirection
    cam: bool

    def sentence_key(self, drawing: Drawing) -> str:
        return "step.force-normal" if self.cam else "step.force-line"

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The links, the line and the arm."""
        links, way = links_words(drawing, self.links), self.way.words(drawing)
        return {**super().fields(drawing), "k": links, "way": way, "h": symbol(self.number)}


class AssurPoint(Construction, frozen=True, kw_only=True):
    """The point of a group of class III in which the lines of two of its arms meet."""

    one: int
    other: int
    starts: tuple[int, int]
    point: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw both lines as far as the point."""
        point = canvas.value(self.point)
        if canvas.holds(point):
            for start in self.starts:
                canvas.leg("", "ray", canvas.value(start), point)
            canvas.image()


def in_order(pen: Pen, lines: Sequence[int]) -> tuple[int, int, int]:
    """The numbers of three lines, first the two that cross at the largest angle in the scene."""
    shown = [pen.peek(line) for line in lines]
    if any(line is None for line in shown):
        return 0, 1, 2
    both = max(combinations(range(3), 2), key=lambda e: crossing_sine(shown[e[0]], shown[e[1]]))
    (last,) = {0, 1, 2} - {*both}
    return both[0], both[1], last


def meeting(pen: Pen, one: int, other: int, starts: tuple[int, int]) -> int:
    """The point in which the lines of two arms meet."""
    name = next(letter for letter in LETTERS if letter not in pen.scene.points)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        point = pen.draw(meet, one, other, name=name)
    return pen.make(AssurPoint(one=one, other=other, starts=starts, point=point)).point


def along_line(
    pen: Pen,
    name: str,
    number: str,
    links: tuple[str, ...],
    line: int,
    through: int,
    moments: Moments,
    way: SideDirection,
    *,
    cam: bool = False,
) -> int:
    """The force along the step of a line that balances moments; its step."""
    with pen.on(Part.FORCE, Plane.MECHANISM):
        end = pen.draw(foot_on_line, moments.about, line)
    force = moments.balanced(pen, line_force, end, line)
    found = LineForce(
        name=name,
        number=number,
        links=links,
        way=way,
        cam=cam,
        moments=moments,
        through=through,
        foot=end,
        force=force,
    )
    return pen.make(found).force


# --- the force of a guide, normal to it -----------------------------------------------------------


@action("pressure-arm")
def pressure_arm(about: Point, place: Point, guide: Line) -> Point:
    """The foot of the perpendicular from a pin to the normal of a guide at a place."""
    return arm.value(about, place, 1j * guide.along)


@action("slide-pressure")
def slide_pressure(far: Point, foot: Point, guide: Line, near: Point, *rest: Any) -> Point:
    """The force of a guide that balances the moments of both its links.

    ``foot`` is the foot of ``far`` on the normal through ``near``. The inputs of the moments of the
    link at far come first, then those of the link at near. The numbers of pairs of both follow, and
    last the number of inputs of the first.
    """
    *terms, pairs, others, first = rest
    normal = 1j * guide.along / abs(guide.along)
    total = moment_sum(far, (*terms[: int(first)], pairs))
    total = total + moment_sum(near, (*terms[int(first) :], others))
    return total / cross(foot - far, normal) * normal


class SlidePressure(ForceOnLine, frozen=True, kw_only=True):
    """The force ``name`` on the link at ``near`` from the ``link`` at ``far``, normal to a guide.

    ``moments`` are those of the link at far about its pin, ``others`` those of the link at near,
    about the pin ``through`` which the normal is drawn.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_pressure"}
    none: ClassVar[str] = "step.force-pressure-none"

    link: str
    block: str
    others: Moments

    def sentence_key(self, drawing: Drawing) -> str:
        both = self.others.shown(drawing)
        return "step.force-pressure-both" if both else "step.force-pressure"

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The link, both pins, the arm and the guide."""
        return {
            **super().fields(drawing),
            "k": escape(self.link),
            "far": symbol(self.moments.letter),
            "near": symbol(self.others.letter),
            "h": symbol(self.number),
            "guide": way_of(drawing, self.block),
        }


def pressure(
    pen: Pen,
    name: str,
    number: str,
    names: tuple[str, str],
    guide: int,
    own: Moments,
    others: Moments,
) -> int:
    """The force of a guide on the near link; ``names`` are the far link and the block."""
    link, block = names
    with pen.on(Part.FORCE, Plane.MECHANISM):
        foot = pen.draw(pressure_arm, own.about, others.about, guide)
    first, second = own.steps, others.steps
    with pen.on(Part.FORCE, Plane.NUMBERS):
        force = pen.draw(
            slide_pressure,
            *(own.about, foot, guide, others.about),
            *first,
            *second,
            extra=(*own.extra, *others.extra, float(len(first))),
        )
    found = SlidePressure(
        name=name,
        number=number,
        link=link,
        block=block,
        moments=own,
        others=others,
        through=others.about,
        foot=foot,
        force=force,
    )
    return pen.make(found).force


# --- the force between two wheels, or a wheel and its rack ----------------------------------------


PRESSURE = 20
"""The pressure angle of teeth in degrees: ISO 53."""


@action("pitch-point")
def pitch_point(centre: Point, other: Point, own: Real, on: Real, inside: int, ring: int) -> Point:
    """The point of contact of two wheels; ``inside`` and ``ring`` are -1 for a ring, else 1."""
    return centre + (other - centre) * (inside * own / (inside * own + ring * on))


@action("tooth-force")
def tooth_force(centre: Point, pitch: Point, *rest: Any) -> Point:
    """The force at the pitch point that balances the moments of a wheel about its centre.

    ``rest`` holds the inputs of the moments and the number of pairs, then the tangent of the
    pressure angle with the sense in which teeth push the wheel: 1 towards its centre.
    """
    *terms, pairs, slant = rest
    radius = abs(centre - pitch)
    inward = (centre - pitch) / radius
    along = moment_sum(centre, (*terms, pairs)) / radius
    return along * (1j * inward) + pick(along < 0, -along, along) * (slant * inward)


@action("track-pitch-point")
def track_pitch_point(centre: Point, track: Line) -> Point:
    """The point at which a wheel touches a straight track."""
    return arm.value(centre, track.point, track.along)


@action("rack-force")
def rack_force(centre: Point, pitch: Point, guide: Line, end: Point, slant: float) -> Point:
    """The force at the pitch point that holds a rack against loads, whose polygon has an ``end``.

    ``slant`` is the tangent of the pressure angle. Teeth push the rack away from the wheel.
    """
    away = (pitch - centre) / abs(pitch - centre)
    load, along = dot(end, guide.along), 1j * away
    first = -load / dot(along, guide.along)
    one = first * 0 + 1
    way = along + pick(first < 0, -one, one) * (slant * away)
    return -load / dot(way, guide.along) * way


class RackForce(InPolygon, frozen=True, kw_only=True):
    """The force ``name`` on a rack from its wheel: its line of action meets the guide's normal.

    ``pitch`` is the point of contact, ``sides`` are the loads of the rack.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_closing"}

    name: str
    link: str
    angle: int
    way: SideDirection
    sides: tuple[KnownSide, ...]
    centre: int
    start: int
    pitch: OwnStep
    force: OwnStep
    corner: OwnStep

    def sides_at(self, role: str) -> tuple[DrawnSide, ...]:
        """The force."""
        side = DrawnSide(self.name, REACTION, self.start, self.corner)
        return (side,) if role == "corner" else ()

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the radius of the pitch point, and the force in the polygon."""
        draw_sides(canvas, self.sides_at(role))
        if role == "pitch":
            canvas.leg(self.name, "ray", canvas.value(self.centre), canvas.value(self.pitch))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sides in order, and the line of action that closes the polygon with the normal."""
        if role != "corner":
            return ""
        sides = sides_words(drawing, self.sides)
        size = drawing.settled(abs(drawing.trace.values[self.force]))
        return drawing.words(
            ("step.force-rack" if self.angle else "step.force-rack-rim")
            if sides and size
            else "step.force-rack-none",
            n=str(self.polygon),
            k=escape(self.link),
            sides=sides,
            angle=f"{self.angle}°",
            guide=self.way.words(drawing),
            r=symbol(self.name),
            read=read_side(drawing, self.name, self.start, self.corner),
        )

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The force read off."""
        if role == "corner":
            yield of_side(drawing, self.name, self.start, self.corner)


class ToothForce(ForceByMoments, frozen=True, kw_only=True):
    """The force ``name`` on a ``link`` from the wheel of another, at their ``pitch`` point.

    ``moments`` are those of the link's loads about its centre, or about its other contact if
    ``across`` names both contacts. ``angle`` is the pressure angle in degrees, 0 for plain wheels.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_tooth"}
    none: ClassVar[str] = "step.force-tooth-none"

    link: str
    angle: int
    pitch: OwnStep
    across: tuple[str, str] = ("", "")

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the radius of the pitch point."""
        if role == "pitch":
            centre, pitch = canvas.value(self.moments.about), canvas.value(self.pitch)
            canvas.leg(self.name, "ray", centre, pitch)

    def sentence_key(self, drawing: Drawing) -> str:
        return "step.force-tooth" if self.angle else "step.force-rim"

    def fields(self, drawing: Drawing) -> Mapping[str, str]:
        """The link, and the angle of the line of action."""
        own = {"k": escape(self.link), "angle": f"{self.angle}°"}
        return {**super().fields(drawing), **own}

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The base radius."""
        radius = bar(*self.across) if self.across[0] else f"*r*_{{{escape(self.link)}}}"
        factors = [(radius, self.reach(drawing, self.pitch))]
        if self.angle:
            cosine = math.cos(math.radians(self.angle))
            factors.append((f"cos {self.angle}°", figure(drawing, cosine)))
        return factors

    def over(self, drawing: Drawing) -> str:
        """All factors of the arm."""
        return self.below(drawing)[0]


def pressure_angle(*wheels: Wheel | None) -> int:
    """The pressure angle of two wheels, or of a wheel and its rack; 0 without teeth."""
    return PRESSURE if any(w is not None and w.teeth is not None for w in wheels) else 0


def pitch_of(pen: Pen, about: int, wheels: tuple[Wheel, Wheel]) -> int:
    """The point of contact of a wheel about a point with another one."""
    with pen.on(Part.FORCE, Plane.NUMBERS):
        radii = [pen.given("number", each.radius, name=f"radius {each.centre}") for each in wheels]
    inside, ring = (-1 if each.inside else 1 for each in wheels)
    far = pen.the("position", wheels[1].centre)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        return pen.draw(pitch_point, about, far, *radii, extra=(inside, ring))


def pitch_on(pen: Pen, about: int, track: int) -> int:
    """The point of contact of a wheel about a point with a straight track."""
    with pen.on(Part.FORCE, Plane.MECHANISM):
        return pen.draw(track_pitch_point, about, track)


def tooth(
    pen: Pen,
    name: str,
    link: str,
    pitch: int,
    angle: int,
    moments: Moments,
    *,
    outward: bool,
    across: tuple[str, str] = ("", ""),
) -> ToothForce:
    """The force on a wheel at its ``pitch`` point from its moments about its centre.

    Teeth push the wheel ``outward`` from the point of the moments, or towards it.
    """
    slant = (-1 if outward else 1) * math.tan(math.radians(angle))
    force = moments.balanced(pen, tooth_force, pitch, extra=(slant,))
    found = ToothForce(
        name=name, link=link, angle=angle, moments=moments, pitch=pitch, force=force, across=across
    )
    return pen.make(found)


def rack(
    pen: Pen,
    polygon: Polygon,
    name: str,
    link: str,
    angle: int,
    centre: int,
    track: int,
    guide: tuple[int, str],
) -> RackForce:
    """The force on a rack, laid off at the end of the polygon of its loads."""
    pitch, end = pitch_on(pen, centre, track), polygon.last
    sides = tuple(polygon.sides)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        inputs = centre, pitch, guide[0], end
        force = pen.draw(rack_force, *inputs, extra=(math.tan(math.radians(angle)),))
    corner = polygon.put(name, force)
    found = RackForce(
        polygon=polygon.number,
        name=name,
        link=link,
        angle=angle,
        way=SideDirection(guide=guide[0], block=guide[1]),
        sides=sides,
        centre=centre,
        start=end,
        pitch=pitch,
        force=force,
        corner=corner,
    )
    return pen.make(found)


# --- the forces in the two strands of a belt ------------------------------------------------------


STATED = {"slack": "T_min", "pretension": "T_0", "ratio": "q"}
"""The symbol of what a scene states of a belt's tensions."""
RULES = tuple(TENSIONS)
FORMULAS = {
    "slack": ("{t} + {u}", "{t}"),
    "pretension": ("{t} + {u}/2", "{t} − {u}/2"),
    "ratio": ("{t}·{u}/({t} − 1)", "{u}/({t} − 1)"),
}
"""The tensions of the tight and of the slack strand from a stated number and their difference."""


@action("strand-edge")
def strand_edge(centre: Point, other: Point, own: Real, on: Real, sense: int, side: int) -> Point:
    """The point at which a strand leaves a wheel; ``sense`` is +1 for a crossed belt, else -1."""
    apart = abs(other - centre)
    lean = (own + sense * on) / apart
    rise = sqrt(1 - lean * lean)
    return centre + at(lean, side * rise) * (own / apart * (other - centre))


@action("strand-end")
def strand_end(centre: Point, other: Point, own: Real, on: Real, edge: Point, sense: int) -> Point:
    """The point at which a strand that leaves a wheel at an edge reaches the other wheel."""
    return other - sense * on / own * (edge - centre)


@action("strand-force")
def strand_force(centre: Point, edge: Point, number: Real, *rest: Any) -> Point:
    """The force of a strand on a wheel, which holds the moments about its centre with the other.

    ``rest`` holds the inputs of the moments and the number of pairs, then the strand's side and the
    place in RULES of the rule that ``number`` belongs to.
    """
    *terms, pairs, side, rule = rest
    arm = edge - centre
    more = side * moment_sum(centre, (*terms, pairs)) / abs(arm)
    return tension(more, number, RULES[int(rule)]) * (-1j * side * arm / abs(arm))


def tension(more: Real, number: Real, rule: str) -> Real:
    """The tension of a strand that carries ``more`` than the other.

    A loose strand raises ValueError; in a batch it is NaN.
    """
    if rule == "pretension":
        found = number + more / 2
        return found + 0 * sqrt(found)
    if rule == "slack":
        return number + pick(more > 0, more, 0 * more)
    return pick(more > 0, number * more, -more) / (number - 1)


def swapped(kind: BeltStrand, force: Any, get: Callable[[int], Any]) -> Any:
    """The force of a strand with the tension of the other one."""
    return -strand_force.value(*kind.inputs(get), -kind.side, RULES.index(kind.rule))


def of_other(kind: BeltStrand, force: Any, get: Callable[[int], Any]) -> Any:
    """The force of a strand where the stated tension was given to the wrong strand.

    The slack one's was given to the tight one, or the mean of both to the slack one. A ratio
    belongs to neither.
    """
    centre, edge, number, *terms = kind.inputs(get)
    more = kind.side * moment_sum(centre, terms) / abs(edge - centre)
    wrong = {
        "slack": number - pick(more < 0, -more, 0 * more),
        "pretension": tension(more, number, "slack"),
    }
    right = tension(more, number, kind.rule)
    share = wrong.get(kind.rule, right) / pick(right == 0, 1.0, right)
    return force * share


class BeltStrand(ForceByMoments, frozen=True, kw_only=True):
    """The force ``name`` of a strand on a ``link`` from the wheel of another, at its ``edge``.

    ``sign`` is the label of the wheel, and ``side`` is +1 for its left strand, -1 for the right.
    ``first`` is the name and the step of the left strand, at the right one. ``stated`` is the
    symbol of ``number``, which ``rule`` explains.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_belt"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "strands_swapped": Slip(1, "moderate", ("force",), taken=swapped),
        "tension_of_other_strand": Slip(1, "moderate", ("force",), taken=of_other),
    }
    none: ClassVar[str] = "step.force-belt-none"

    link: str
    sign: str
    side: int
    rule: str
    stated: str
    number: int
    edge: OwnStep
    first: tuple[str, int] | None = None

    def inputs(self, get: Callable[[int], Any]) -> tuple[Any, ...]:
        """The values from which its force follows, without its side and its rule."""
        steps = self.moments.about, self.edge, self.number, *self.moments.steps
        return (*map(get, steps), *self.moments.extra)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the radius to the point at which the strand leaves the wheel."""
        if role == "edge":
            centre, edge = canvas.value(self.moments.about), canvas.value(self.edge)
            canvas.leg(self.name, "ray", centre, edge)

    def sentence_key(self, drawing: Drawing) -> str:
        return "step.force-belt"

    @property
    def formulas(self) -> tuple[str, str]:
        """Both tensions in terms of the stated number and the difference, the tight one first."""
        return FORMULAS[self.rule]

    def put(self, formula: str) -> str:
        """A formula in symbols."""
        return formula.format(t=symbol(self.stated), u=self.rim_force)

    def in_order(self, drawing: Drawing) -> list[tuple[str, float]]:
        """The symbols and the tensions of both strands, the tight one first."""
        assert self.first is not None
        both = [
            (symbol(name), drawing.settled(abs(drawing.trace.values[step])))
            for name, step in (self.first, (self.name, self.force))
        ]
        return sorted(both, key=lambda each: -each[1])

    def difference(self, drawing: Drawing) -> float:
        """The difference of both tensions in N; zero for rounding."""
        edge, about = (drawing.trace.values[n] for n in (self.edge, self.moments.about))
        return drawing.settled(abs(self.moments.total(drawing)) / float(abs(edge - about)))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The difference of both strands and what fixes them, at the second one."""
        if role != "force" or self.first is None:
            return ""
        (tight, most), (slack, least) = self.in_order(drawing)
        difference = self.difference(drawing)
        fields = {
            **self.symbols(),
            "k": escape(self.link),
            "u": self.rim_force,
            "tight": tight,
            "slack": slack,
            "below": self.below(drawing)[0],
            "sum": sums_of(drawing, self.moments)[0],
            "size": newtons(drawing, difference),
            "more": self.put(self.formulas[0]),
            "less": self.put(self.formulas[1]),
            "most": f"{newtons(drawing, most)} ({force_amount(drawing, most)})",
            "least": f"{newtons(drawing, least)} ({force_amount(drawing, least)})",
        }
        return drawing.words(self.sentence_key(drawing) if difference else self.none, **fields)

    @property
    def rim_force(self) -> str:
        """The symbol of the difference of both tensions."""
        return symbol("U_" + sub("", self.link).removeprefix(","))

    def arm(self, drawing: Drawing) -> Sequence[tuple[str, str]]:
        """The radius of the wheel."""
        return [(of_wheel("r", self.sign), self.reach(drawing, self.edge))]

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The difference of both tensions from the moments, then each tension."""
        if role != "force" or self.first is None:
            return
        difference = self.difference(drawing)
        if difference:
            yield of_moments(
                (self.rim_force, answer(drawing, difference), "N"),
                symbol(self.moments.letter),
                sums_of(drawing, self.moments),
                self.below(drawing),
                by=self.over(drawing),
            )
        number = float(drawing.trace.values[self.number])
        sides = zip(self.in_order(drawing), self.formulas, (1, -1), strict=True)
        for (name, size), formula, more in sides:
            result, worth = answer(drawing, size), partial(self.worth, more)
            t, u = put_in(drawing, result, worth, number, difference)
            yield Relation(name, self.put(formula), formula.format(t=t, u=u), result, "N")

    def worth(self, more: int, number: float, difference: float) -> float:
        """A tension from the stated number and the difference: of the tight strand for +1."""
        return float(tension(more * difference, number, self.rule))


# --- writing their steps -------------------------------------------------------------------------


def belt_letter(scene: Scene, belt: Belt) -> str:
    """The symbol of what a scene states of a belt's tensions; belts are numbered if many."""
    assert belt.tension is not None
    every = (each.belt for _, each in scene.belts)
    stated = [each for each in every if each is not None and each.tension is not None]
    letter = STATED[belt.tension.key]
    if len(stated) == 1:
        return letter
    number = 1 + next(k for k, each in enumerate(stated) if each is belt)
    return f"{letter},{number}" if "_" in letter else f"{letter}_{number}"


class StrandPlace(NamedTuple):
    """A strand's force on a wheel, and the points at which it leaves both wheels."""

    force: int
    edge: int
    end: int


def belt_strands(
    pen: Pen,
    link: str,
    names: Mapping[str, str],
    wheels: tuple[Wheel, Wheel],
    belt: Belt,
    moments: Moments,
    sense: int,
) -> Iterator[tuple[str, StrandPlace]]:
    """The forces of both strands on the wheel of a link, by their names in STRANDS.

    ``sense`` is -1 where left and right are those seen from the other wheel.
    """
    assert belt.tension is not None
    key, stated = belt.tension.key, belt_letter(pen.scene, belt)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        radii = [pen.given("number", each.radius, name=f"radius {each.centre}") for each in wheels]
        number = pen.given("number", belt.tension.number, name=f"tension {stated}")
    centres = moments.about, pen.the("position", wheels[1].centre)
    first: tuple[str, int] | None = None
    for strand, (_, seen) in STRANDS.items():
        side = sense * seen
        with pen.on(Part.FORCE, Plane.MECHANISM):
            edge = pen.draw(strand_edge, *centres, *radii, extra=(belt.sense, side))
            end = pen.draw(strand_end, *centres, *radii, edge, extra=(belt.sense,))
        fixed = float(side), float(RULES.index(key))
        force = moments.balanced(pen, strand_force, edge, number, extra=fixed)
        found = BeltStrand(
            name=names[strand],
            link=link,
            sign=pen.scene.link(link).wheel_sign(wheels[0]),
            side=side,
            rule=key,
            stated=stated,
            number=number,
            moments=moments,
            edge=edge,
            force=force,
            first=first,
        )
        first = found.name, pen.make(found).force
        yield strand, StrandPlace(force, edge, end)
