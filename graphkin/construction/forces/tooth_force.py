"""The force between two wheels on fixed pivots: along the line of action, by moments of one wheel.

Teeth push along a line at the pressure angle to the common tangent, so that they also push the
wheels apart. Plain wheels carry a force along the tangent alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import action
from graphkin.construction.forces.force_words import force_amount, newtons
from graphkin.construction.forces.moments import Moments, moment_sum, of_moments
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point, Real, pick
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


class ToothForce(Construction, frozen=True, kw_only=True):
    """The force ``name`` on a ``link`` from the wheel of another, at their ``pitch`` point.

    ``moments`` are those of the link's loads about its centre. ``angle`` is the pressure angle in
    degrees, 0 for plain wheels.
    """

    gives: ClassVar[tuple[str, ...]] = ("pitch", "force")
    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_tooth"}

    name: str
    link: str
    angle: int
    moments: Moments
    pitch: int
    force: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the radius of the pitch point."""
        if role == "pitch":
            centre, pitch = canvas.value(self.moments.about), canvas.value(self.pitch)
            canvas.leg(self.name, "ray", centre, pitch)

    def symbols(self) -> Mapping[str, str]:
        """The centre of the wheel."""
        return {"b": symbol(self.moments.letter)}

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The symbols and numbers that its sentence uses."""
        size = drawing.settled(abs(drawing.trace.values[self.force]))
        return {
            "k": escape(self.link),
            "b": symbol(self.moments.letter),
            "r": symbol(self.name),
            "angle": f"{self.angle}°",
            "below": self.below(drawing),
            "sum": self.joined(drawing),
            "size": newtons(drawing, size),
            "drawn": force_amount(drawing, size),
        }

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The moment equation, and the size of the force on its line of action."""
        if role != "force":
            return ""
        key = "step.force-tooth" if self.angle else "step.force-rim"
        if not drawing.settled(abs(drawing.trace.values[self.force])):
            key = "step.force-tooth-none"
        return drawing.words(key, **self.fields(drawing))

    def joined(self, drawing: Drawing, *, figures: bool = False) -> str:
        """The sum of moments, positive as a whole."""
        total = sum(moment for _, moment, _, _ in self.moments.values(drawing))
        said = self.moments.figures if figures else self.moments.symbols
        return said(drawing, turned=total < 0)

    def below(self, drawing: Drawing) -> str:
        """The arm of the force in symbols: the base radius, in metres beside couples."""
        radius = f"*r*_{{{escape(self.link)}}}"
        parts = [radius, *([f"cos {self.angle}°"] if self.angle else [])]
        parts += ["*k*_L"] if self.moments.in_metres(drawing) else []
        return f"({'·'.join(parts)})" if len(parts) > 1 else radius

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sum of moments divided by the arm of the line of action."""
        values = drawing.trace.values
        size = drawing.settled(abs(values[self.force]))
        if role != "force" or not size:
            return
        drawn = drawing.on_paper(abs(values[self.pitch] - values[self.moments.about]))
        put = [figure(drawing, drawn)]
        put += [figure(drawing, math.cos(math.radians(self.angle)))] if self.angle else []
        if self.moments.in_metres(drawing):
            put.append(figure(drawing, drawing.scales.kL / 1000))
        yield of_moments(
            (symbol(self.name), answer(drawing, size), "N"),
            symbol(self.moments.letter),
            (self.joined(drawing), self.joined(drawing, figures=True)),
            (self.below(drawing), f"({'·'.join(put)})" if len(put) > 1 else put[0]),
            by=self.below(drawing),
        )


def tooth(
    pen: Pen, name: str, link: str, wheels: tuple[Wheel, Wheel], moments: Moments
) -> ToothForce:
    """The force between two wheels: on the first, which turns on a link's pivot."""
    own, other = wheels
    angle = PRESSURE if own.teeth is not None or other.teeth is not None else 0
    with pen.on(Part.FORCE, Plane.NUMBERS):
        radii = [pen.given("number", each.radius, name=f"radius {each.centre}") for each in wheels]
    inside, ring = (-1 if each.inside else 1 for each in wheels)
    far = pen.the("position", other.centre)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        pitch = pen.draw(pitch_point, moments.about, far, *radii, extra=(inside, ring))
    slant = inside * math.tan(math.radians(angle))
    with pen.on(Part.FORCE, Plane.NUMBERS):
        force = pen.draw(
            tooth_force, moments.about, pitch, *moments.steps, extra=(*moments.extra, slant)
        )
    found = ToothForce(name=name, link=link, angle=angle, moments=moments, pitch=pitch, force=force)
    return pen.make(found)
