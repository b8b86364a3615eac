"""The inflection circle of a link, whose points are at inflections of their paths, and its pole.

By hand, a point of the circle is laid off on each of two rays to the instantaneous centre. The
perpendiculars at both points meet in the pole (Thales).
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from typing import ClassVar

from graphkin.construction.centres.instant_centre import (
    Centre,
    LineToCentre,
    Places,
    VelocityNormal,
    centre_name,
    far_words,
    known_points,
    mark_away,
    meet_anywhere,
    normals_at,
    normals_meet,
    relative_centre,
    two_points,
)
from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import drawn_amount
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import Circle, Line, Ratio, cross, crossing_sine, dot

FLAT = 1e-3
"""Sine of the flattest crossing of two rays used to find an inflection pole by hand."""

# --- its value, and the steps by hand ------------------------------------------------------------


@action("inflection-pole")
def inflection_pole(
    p: Point, image_p: Point, second_image_p: Point, omega: Real, epsilon: Real
) -> Ratio:
    """W = I + a_I/ω², opposite to the centre I on the circle of points whose paths are straight.

    For the point of the link at r from I the velocity is i·ω·r and the acceleration is a_I + (i·ε -
    ω²)·r. They are parallel where r·a_I = ω²·r², on the circle of diameter a_I/ω². For any point P
    of the link, I = P + i·v_P/ω, and ε drops out of I: W = P + (a_P - ε·v_P/ω)/ω².
    """
    size = pick(omega == 0, 1.0, omega)
    return Ratio(
        p, (omega * second_image_p - epsilon * image_p) / size, omega * omega * omega / size
    )


@action("inflection-point")
def inflection_point(
    point: Point, ray: Line, second_image: Point, p: Point, q: Point, ip: Point, iq: Point
) -> Point:
    """The point at the distance a_n/ω² along the ray to the instantaneous centre.

    a_n is the component of the point's acceleration along the ray. ω is the relative velocity of
    the base PQ over its length. The ray meets the inflection circle there, since a_n = ω² times the
    distance to that circle on every ray (Euler, Savary).
    """
    unit = ray.along / abs(ray.along)
    turning = abs(iq - ip) / abs(q - p)
    return point + unit * (dot(unit, second_image) / (turning * turning))


@action("inflection-square")
def inflection_square(point: Point, image: Point) -> Line:
    """The perpendicular to its ray through a point of the inflection circle (Thales)."""
    return Line(point, image)


@action("inflection-meet", margin=crossing_sine)
def inflection_meet(m: Line, n: Line) -> Ratio:
    """The inflection pole, where the perpendiculars to two rays meet."""
    return meet_anywhere(m, n)


@action("inflection-circle")
def inflection_circle(p: Point, image_p: Point, omega: Real, pole: Ratio) -> Circle:
    """The circle whose diameter joins the instantaneous centre p + i·v/ω to the inflection pole."""
    centre, far = p + 1j * image_p / omega, pole.start + pole.shift / pole.size
    return Circle((centre + far) / 2, abs(far - centre) / 2)


# --- the constructions ---------------------------------------------------------------------------


class InflectionPoint(LineToCentre, frozen=True, kw_only=True):
    """A point of the circle, ``found`` on the ray at ``ray.point``, and the perpendicular there."""

    reasons: ClassVar[Mapping[str, str]] = {"found": "why.inflection"}

    letter: str
    link: str
    ray: VelocityNormal
    found: OwnStep

    @property
    def name(self) -> str:
        return self.ray.point

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the point, or the perpendicular."""
        if role == "found":
            canvas.spot(canvas.value(self.found))
        else:
            super().marks(canvas, role)

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The ray on which the point is laid off."""
        return (self.ray.line,) if role == "found" else ()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the length laid off on the ray."""
        values = drawing.trace.values
        return drawing.words(
            "step.inflection-point",
            name=drawing.symbol(self.letter),
            p=drawing.symbol(self.name),
            a=symbol(f"a_{self.name}"),
            omega=symbol(f"ω_{self.link}"),
            drawn=drawn_amount(drawing, abs(values[self.found] - values[self.ray.place])),
        )

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the perpendicular at the point."""
        fields = {"w": drawing.symbol(self.letter), "p": drawing.symbol(self.name)}
        return drawing.words("step.inflection-square", **fields)

    def places(self, drawing: Drawing) -> Places:
        return {self.letter: drawing.trace.values[self.found]}


class InflectionCircle(Centre, frozen=True, kw_only=True):
    """The circle whose diameter joins the instantaneous centre to its pole, which is ``found``.

    ``ways`` are two points of the circle with their perpendiculars; their rays meet in ``centre``.
    ``opposite`` is the numerically stable value of that centre. ``pinned``: the link turns about a
    fixed pin.
    """

    reasons: ClassVar[Mapping[str, str]] = {"found": "why.inflection_circle"}
    key: ClassVar[str] = "inflection-pole"
    called: ClassVar[str] = "the inflection pole of link"
    look: ClassVar[str] = "inflection"

    circle: OwnStep
    opposite: OwnStep
    centre: OwnStep | None = None
    centre_letter: str
    pinned: bool

    def title(self, role: str) -> str:
        """The name of the pole, or of the centre where its rays meet, in a report."""
        return f"{Centre.called} {self.link}" if role == "centre" else super().title(role)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the centre, the pole, and the circle through both."""
        match role:
            case "centre":
                assert self.centre is not None
                value = canvas.value(self.centre)
                if not canvas.centre(value):
                    mark_away(canvas, value, self.centre_letter, self.rays[0].point, ray=True)
            case "circle":
                canvas.circle(canvas.value(self.circle), self.look)
            case _:
                super().marks(canvas, role)

    @property
    def rays(self) -> tuple[VelocityNormal, ...]:
        """The rays to the instantaneous centre on which the points of the circle are laid off."""
        return tuple(way.ray for way in self.ways if isinstance(way, InflectionPoint))

    def mark_far(self, canvas: Canvas) -> None:
        """Write a note only; for a pole at infinity the sentence says everything."""
        drawing, value = canvas.drawing, self.value(canvas.drawing)
        if not self.oddity(drawing):
            canvas.note(far_words(drawing, value, self.name, self.point))

    def around(self, drawing: Drawing) -> tuple[str, Circle] | None:
        """The circle itself, after its style."""
        value = drawing.trace.values.get(self.circle)
        return None if value is None else (self.look, value)

    def sentence_key(self, drawing: Drawing) -> str:
        """The key by its special case; about a fixed pin the pole is that pin."""
        if odd := self.oddity(drawing):
            return f"{self.key}-{odd}"
        if self.is_by_hand(drawing):
            return "inflection-meet"
        return f"{self.key}-pin" if self.pinned else self.key

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for the pole and the circle, after both perpendiculars."""
        if role != "found" or self.sentence_key(drawing) != "inflection-meet":
            return ""
        return drawing.words("step.inflection-meet-apart", **self.fields(drawing))

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the instantaneous centre and the rate of the link."""
        names = {"i": symbol(self.centre_letter), "omega": symbol(f"ω_{self.link}")}
        return super().fields(drawing) | names


# --- writing its steps ---------------------------------------------------------------------------


def draw_circle(pen: Pen, base: Base) -> None:
    """Draw the inflection pole W of a link, and the circle through I and W."""
    points = two_points(pen, base)
    if points is None:
        return
    place, image, second = (
        pen.the(what, base.start) for what in ("position", "velocity", "acceleration")
    )
    turning, o = pen.the(OMEGA, base.link), pen.pole(Plane.VELOCITIES)
    names = {"name": centre_name("W", base.link), "centre_letter": centre_name("I", base.link)}
    with pen.on(Part.POLE, Plane.MECHANISM):
        centre, crossing, ways = None, None, tuple[InflectionPoint, ...]()
        if chosen := squarest_rays(pen, known_points(pen, base)):
            with pen.hands_way():
                rays = normals_at(pen, chosen, o)
                lines = (ray.line for ray in rays)
                centre = pen.arrow(normals_meet, *lines, name=names["centre_letter"])
                ways = tuple(point_on(pen, base.link, ray, rays) for ray in rays)
                crossing = pen.draw(inflection_meet, *(way.line for way in ways))
        rates = turning, pen.the(EPSILON, base.link)
        ends = place, image, second, *rates
        found = pen.draw(inflection_pole, *ends, name=names["name"], by_hand=crossing)
        called = f"inflection {base.link}"
        circle = pen.arrow(inflection_circle, place, image, turning, found, name=called)
        zero = pen.given("zero")
        opposite = pen.draw(relative_centre, place, image, turning, o, o, zero)
    pen.make(
        InflectionCircle(
            link=base.link,
            point=base.start,
            ways=ways,
            centre=centre,
            crossing=crossing,
            found=found,
            circle=circle,
            opposite=opposite,
            pinned=image == o,
            **names,
        )
    )
    pen.want("inflection", base.link, found)
    pen.want("inflection centre", base.link, opposite)


def squarest_rays(pen: Pen, points: list[str]) -> tuple[str, str] | None:
    """The two points whose rays to the instantaneous centre cross closest to a right angle.

    None where no two rays cross: a link on a fixed pin has that pin as its circle.
    """
    ways = {}
    for point in points:
        velocity = pen.peek(pen.the("velocity", point))
        if velocity:
            ways[point] = velocity / abs(velocity)
    if pen.pole(Plane.VELOCITIES) in (pen.the("velocity", point) for point in points):
        return None
    pairs = [(abs(cross(ways[p], ways[q])), p, q) for p, q in combinations(ways, 2)]
    sine, *pair = max(pairs, key=lambda found: found[0], default=(0.0, "", ""))
    return (pair[0], pair[1]) if sine > FLAT else None


def point_on(
    pen: Pen, link: str, ray: VelocityNormal, base: tuple[VelocityNormal, ...]
) -> InflectionPoint:
    """A point of the circle on a ray, and the perpendicular there; the base gives the rotation."""
    ends = *(each.place for each in base), *(each.image for each in base)
    letter = f"{ray.point}_w"
    second = pen.the("acceleration", ray.point)
    found = pen.draw(inflection_point, ray.place, ray.line, second, *ends, name=letter)
    line = pen.draw(inflection_square, found, ray.image)
    return pen.make(InflectionPoint(letter=letter, link=link, ray=ray, found=found, line=line))
