"""The instantaneous centre of a link against the frame: where the normals to velocities cross.

Of two parallel velocities the line through the tips meets the bar of their points in it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.centres.centre import (
    Centre,
    Places,
    VelocityNormal,
    centre_name,
    normals_at,
    two_points,
)
from graphkin.construction.centres.relative_centre import RelativeCentre, relative_centre
from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import NOISE
from graphkin.construction.core.kind import construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action, meet
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Ratio, cross, dot
from graphkin.scene.model import FRAME

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing

PARALLEL = 1e-6
"""Sine of the angle below which two velocities are parallel."""


@action("instant-centre")
def instant_centre(o: Point, p: Point, q: Point, image_p: Point, image_q: Point) -> Ratio:
    """The point of a link without velocity: p + i·v/omega, at infinity in translation."""
    bar = q - p
    return Ratio(p, 1j * (image_p - o) * dot(bar, bar), cross(bar, image_q - image_p))


# --- what it is ----------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class InstantCentre(Centre):
    """The centre of a link by the velocities of its points ``point`` and ``other``: the steps of
    their ``places``, of their ``images``, and of the pole ``o`` of the plan.
    """

    key: ClassVar[str] = "instant-centre"
    reasons: ClassVar[Mapping[str, str]] = {"found": "why.centre"}

    other: str
    o: int
    places: tuple[int, int]
    images: tuple[int, int]

    def marks(self, canvas: Canvas, role: str) -> None:
        """The centre, with the line through the tips of two parallel velocities."""
        if role == "found":
            self.mark_tips(canvas)
        super().marks(canvas, role)

    def mark_tips(self, canvas: Canvas) -> None:
        """The line through the tips of two parallel velocities, and those not drawn elsewhere."""
        drawing, pole = canvas.drawing, canvas.value(self.o)
        drawn = {step.args[:3] for _, step, _ in drawing.mechanism_steps() if step.arrow}
        vectors = []
        for name, (place, image) in self.parallel(drawing).items():
            tail = canvas.value(place)
            way = drawing.at_scale(Plane.VELOCITIES, canvas.value(image) - pole)
            vectors.append((tail, way))
            if (place, self.o, image) not in drawn:
                canvas.vector(f"v_{name}", drawing.kind, tail, tail + way)
        if vectors:
            canvas.through_tips(*vectors)

    def lines_to(self, drawing: Drawing) -> list[Places]:
        """From each of its two points."""
        return [{point: drawing.standing.spot(point)} for point in (self.point, self.other)]

    def oddity(self, drawing: Drawing) -> str:
        """Whether the normals do not cross: it is a point at rest, or on the line of the tips."""
        odd = super().oddity(drawing)
        if odd or self.crossing is None or self.is_by_hand(drawing):
            return odd
        return "still" if self.resting(drawing) else "tips"

    def resting(self, drawing: Drawing) -> str:
        """The first of its points that is at rest; nothing where none is."""
        values, least = drawing.trace.values, NOISE * (drawing.largest or 1.0)
        ends = zip((self.point, self.other), self.images, strict=True)
        still = (name for name, image in ends if abs(values[image] - values[self.o]) <= least)
        return next(still, "")

    def parallel(self, drawing: Drawing) -> dict[str, tuple[int, int]]:
        """The points by whose parallel velocities it is found: the steps of place and image.

        None where the perpendiculars cross, and where one of the points is at rest.
        """
        values = drawing.trace.values
        if self.oddity(drawing) != "tips":
            return {}
        ways = [values[image] - values[self.o] for image in self.images]
        if abs(cross(*ways)) > PARALLEL * abs(ways[0]) * abs(ways[1]):
            return {}
        ends = zip(self.places, self.images, strict=True)
        return dict(zip((self.point, self.other), ends, strict=True))

    def sentence_key(self, drawing: Drawing) -> str:
        """By what is odd about it; a fixed pin needs no lines."""
        if odd := self.oddity(drawing):
            return f"{self.key}-{odd}"
        return self.key if self.crossing is not None else f"{self.key}-pivot"

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """Its points, and the one at rest."""
        ends = {"q": symbol(self.other), "bar": bar(self.point, self.other)}
        return super().fields(drawing) | ends | {"rest": symbol(self.resting(drawing))}


def set_before(drawing: Drawing) -> Mapping[int, int]:
    """The velocities that are set on the mechanism to find a centre, each with its centre."""
    ends = {
        pair: number
        for number, step, _ in drawing.mechanism_steps()
        if isinstance(centre := construction(step), InstantCentre) and centre.found == number
        for pair in centre.parallel(drawing).values()
    }
    return {
        number: ends[step.args[0], step.args[2]]
        for number, step, _ in drawing.mechanism_steps()
        if step.action is not None and step.action.key == "set-on"
        if (step.args[0], step.args[2]) in ends
    }


# --- planning it ---------------------------------------------------------------------------------


def draw_centre(pen: Pen, base: Base) -> None:
    """The instantaneous centre of a link: where the normals to two velocities cross (Chasles)."""
    points = two_points(pen, base)
    if points is None:
        by_turning(pen, base)
        return
    o, name = pen.pole(Plane.VELOCITIES), centre_name("I", base.link)
    p, q = (pen.the("position", point) for point in points)
    a, b = (pen.the("velocity", point) for point in points)
    with pen.on(Part.CENTRE, Plane.MECHANISM):
        crossing, normals = None, tuple[VelocityNormal, ...]()
        if o not in (a, b):
            with pen.hands_way():
                normals = normals_at(pen, points, o)
                crossing = pen.draw(meet, *(normal.line for normal in normals))
        found = pen.draw(instant_centre, o, p, q, a, b, name=name, by_hand=crossing)
    pen.make(
        InstantCentre(
            name=name,
            link=base.link,
            point=points[0],
            other=points[1],
            o=o,
            places=(p, q),
            images=(a, b),
            ways=normals,
            crossing=crossing,
            found=found,
        )
    )
    pen.want("centre", base.link, found)


def by_turning(pen: Pen, base: Base) -> None:
    """The centre of a link of which one point is known, and how it turns: with its guide."""
    if not pen.has("omega", base.link) or not pen.has("velocity", base.start):
        return
    o, zero = pen.pole(Plane.VELOCITIES), pen.given("nought")
    ends = [pen.the(what, base.start) for what in ("position", "velocity")]
    with pen.on(Part.CENTRE, Plane.MECHANISM):
        turning = pen.the("omega", base.link)
        name = centre_name("I", base.link)
        found = pen.draw(relative_centre, *ends, turning, o, o, zero, name=name)
    pen.make(RelativeCentre(name=name, first=FRAME, link=base.link, point=base.start, found=found))
    pen.want("centre", base.link, found)
