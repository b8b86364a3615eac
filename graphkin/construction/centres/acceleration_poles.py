"""The acceleration pole of a link, from a triangle similar to the one in the plan (Mehmke)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from graphkin.construction.centres.centre import (
    LineToCentre,
    TwoPointCentre,
    centre_name,
    two_points,
)
from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.palette import POLE, Move, bar_and_images
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import EPSILON
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.plan import omega_of
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, Ratio


@action("pole-ray")
def pole_ray(corner: Point, other: Point, o: Point, image: Point, image_other: Point) -> Line:
    """The ray at one end of a bar at the angle that the plan shows between image and pole."""
    return Line(corner, (other - corner) * ((o - image) / (image_other - image)))


@action("acceleration-pole", move=Move(POLE, bar_and_images, at_once=True))
def acceleration_pole(o: Point, p: Point, q: Point, image_p: Point, image_q: Point) -> Ratio:
    """The point of a link without acceleration, J - p : q - p = o - p' : q' - p' (Mehmke)."""
    return Ratio(p, (o - image_p) * (q - p), image_q - image_p)


@action("acceleration-pole")
def turned_pole(p: Point, image: Point, omega: Real, epsilon: Real) -> Ratio:
    """The point of a link without acceleration, from one acceleration and the link's rates."""
    return Ratio(p, image, at(omega * omega, -epsilon))


# --- the constructions ---------------------------------------------------------------------------


class PoleRay(LineToCentre, frozen=True, kw_only=True):
    """The ray at one end of a bar, ``point``, at the angle that the plan shows at its image."""

    lines: ClassVar[Mapping[str, str]] = {"line": "the ray at {point}"}

    point: str
    other: str

    @property
    def name(self) -> str:
        return self.point + self.other


class AccelerationPole(TwoPointCentre, frozen=True, kw_only=True):
    """The pole of a link by the accelerations of two points: a triangle similar to o′a′b′ (Mehmke).

    Without an ``other`` point it follows from the rates of the link.
    """

    key: ClassVar[str] = "acceleration-pole"
    called: ClassVar[str] = "the acceleration pole of link"
    reasons: ClassVar[Mapping[str, str]] = {"found": "why.pole"}
    letter: ClassVar[str] = "J"
    quantity: ClassVar[str] = "acceleration"
    part: ClassVar[Part] = Part.POLE
    plane: ClassVar[Plane] = Plane.ACCELERATIONS
    action: ClassVar[Action] = acceleration_pole

    @classmethod
    def lines_at(cls, pen: Pen, points: tuple[str, str], o: int) -> tuple[LineToCentre, ...]:
        """The ray of the plan's angle at each end of the bar."""
        rays = []
        for p, q in (points, points[::-1]):
            ends = *(pen.the("position", point) for point in (p, q)), o
            images = (pen.the("acceleration", point) for point in (p, q))
            line = pen.draw(pole_ray, *ends, *images)
            rays.append(pen.make(PoleRay(point=p, other=q, line=line)))
        return tuple(rays)

    def mark_far(self, canvas: Canvas) -> None:
        """Mark a far pole; at infinity only a note says that all points accelerate equally."""
        drawing, value = canvas.drawing, self.value(canvas.drawing)
        if drawing.place(value) is not None:
            super().mark_far(canvas)
        elif not drawing.is_everywhere(value):
            fields = {"name": drawing.symbol(self.name), "k": self.link}
            canvas.note(drawing.words("page.pole_at_infinity", **fields))

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the image of the bar in the plan."""
        images = dict(zip("ab", (drawing.lettered(each) for each in self.images), strict=False))
        figure = drawing.symbol(drawing.pole) + "".join(images.values())
        return super().fields(drawing) | images | {"figure": figure}


# --- writing its steps ---------------------------------------------------------------------------


def draw_pole(pen: Pen, base: Base) -> None:
    """Draw the acceleration pole of a link, from two of its points or from its rates."""
    points = two_points(pen, base)
    if points is not None:
        pen.want("pole", base.link, AccelerationPole.draw(pen, base, points))
    elif pen.turns(base.link) and pen.has("acceleration", base.start):
        pen.want("pole", base.link, by_turning(pen, base))


def by_turning(pen: Pen, base: Base) -> int:
    """The pole of a turning link with one known point, from its ω and ε."""
    ends = [pen.the(what, base.start) for what in ("position", "acceleration")]
    rates = omega_of(pen, base.link), omega_of(pen, base.link, EPSILON)
    name = centre_name("J", base.link)
    with pen.on(Part.POLE, Plane.MECHANISM):
        found = pen.draw(turned_pole, *ends, *rates, name=name)
    kind = AccelerationPole(name=name, link=base.link, point=base.start, found=found)
    return pen.make(kind).found
