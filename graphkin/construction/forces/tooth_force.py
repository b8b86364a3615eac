"""The force between two wheels, or a wheel and its rack, along the line of action.

Teeth push along a line at the pressure angle to the common tangent, so that they also push the
wheels apart. Plain wheels carry a force along the tangent alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.relation import Relation, figure
from graphkin.construction.core.vocabulary import action
from graphkin.construction.forces.moments import ForceByMoments, Moments, arm, moment_sum
from graphkin.construction.forces.polygon import (
    REACTION,
    DrawnSide,
    InPolygon,
    KnownSide,
    Polygon,
    SideDirection,
    draw_sides,
    of_side,
    read_side,
    sides_words,
)
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import Line, dot
from graphkin.scene.model import Wheel

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
