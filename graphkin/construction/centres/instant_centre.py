"""The instantaneous centre of a link against the frame: where the normals to velocities cross.

For two parallel velocities it is where the line through their tips meets the bar of their points.

The acceleration pole of a link, from a triangle similar to the one in the plan (Mehmke).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from graphkin.construction.centres.centre import (
    LineToCentre,
    TwoPointCentre,
    centre_name,
    normals_at,
    two_points,
)
from graphkin.construction.centres.relative_centre import RelativeCentre, relative_centre
from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import SaidInParts, construction
from graphkin.construction.core.palette import POLE, Move, bar_and_images
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane, is_set_on
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.plan import omega_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, Ratio, cross, dot
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME

PARALLEL = 1e-6
"""Sine of the angle below which two velocities count as parallel."""


@action("instant-centre")
def instant_centre(o: Point, p: Point, q: Point, image_p: Point, image_q: Point) -> Ratio:
    """The point of a link without velocity: p + i·v/omega, at infinity in translation."""
    bar = q - p
    return Ratio(p, 1j * (image_p - o) * dot(bar, bar), cross(bar, image_q - image_p))


# --- the construction ----------------------------------------------------------------------------


class InstantCentre(TwoPointCentre, SaidInParts, frozen=True, kw_only=True):
    """The centre of a link where the normals to the velocities of two points cross (Chasles)."""

    key: ClassVar[str] = "instant-centre"
    reasons: ClassVar[Mapping[str, str]] = {"found": "why.centre"}
    letter: ClassVar[str] = "I"
    quantity: ClassVar[str] = "velocity"
    part: ClassVar[Part] = Part.CENTRE
    plane: ClassVar[Plane] = Plane.VELOCITIES
    action: ClassVar[Action] = instant_centre

    @classmethod
    def lines_at(cls, pen: Pen, points: tuple[str, str], o: int) -> tuple[LineToCentre, ...]:
        """The normals to the velocities of both points."""
        return normals_at(pen, points, o)

    @property
    def pole(self) -> int:
        """The step of the pole of the velocity plan."""
        assert self.o is not None
        return self.o

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the centre, with the line through the tips of two parallel velocities."""
        if role == "found":
            self.mark_tips(canvas)
        super().marks(canvas, role)

    def mark_tips(self, canvas: Canvas) -> None:
        """Draw the line through the tips of two parallel velocities, and missing velocities."""
        drawing, pole = canvas.drawing, canvas.value(self.pole)
        drawn = {step.args[:3] for _, step, _ in drawing.on_mechanism if step.arrow}
        vectors = []
        for name, (place, image) in self.parallel(drawing).items():
            tail = canvas.value(place)
            way = drawing.at_scale(Plane.VELOCITIES, canvas.value(image) - pole)
            vectors.append((tail, way))
            if (place, self.pole, image) not in drawn:
                canvas.vector(f"v_{name}", drawing.kind, tail, tail + way)
        if vectors:
            canvas.through_tips(*vectors)

    def oddity(self, drawing: Drawing) -> str:
        """The special case: also "tips", for parallel velocities of which neither is zero."""
        odd = super().oddity(drawing)
        return "tips" if odd == "still" and not self.resting(drawing) else odd

    def resting(self, drawing: Drawing) -> str:
        """The first of its points that is at rest; empty where there is none."""
        values, least = drawing.trace.values, NOISE * (drawing.largest or 1.0)
        ends = zip((self.point, self.other), self.images, strict=True)
        still = (name for name, image in ends if abs(values[image] - values[self.pole]) <= least)
        return next(still, "")

    def parallel(self, drawing: Drawing) -> dict[str, tuple[int, int]]:
        """The points with the parallel velocities that find it, by the steps of place and image.

        Empty where the perpendiculars cross, and where one of the points is at rest.
        """
        values = drawing.trace.values
        if self.oddity(drawing) != "tips":
            return {}
        ways = [values[image] - values[self.pole] for image in self.images]
        if abs(cross(*ways)) > PARALLEL * abs(ways[0]) * abs(ways[1]):
            return {}
        ends = zip(self.places, self.images, strict=True)
        return dict(zip((self.point, self.other), ends, strict=True))

    def sentence_parts(self, drawing: Drawing, role: str) -> Iterator[tuple[int, str]]:
        """The sentences for parallel velocities: perpendiculars, vectors, line through their tips.

        Both perpendiculars lie on one line. Empty where the velocities are not parallel.
        """
        parallel, arrows = self.parallel(drawing), arrows_set_on(drawing)
        if role != "found" or not all(ends in arrows for ends in parallel.values()):
            return
        known = self.fields(drawing)
        for way in self.ways if parallel else ():
            yield way.line, way.clause(drawing, "line")
        keys = "step.instant-centre-tips-first", "step.instant-centre-tips-second"
        for key, (name, ends) in zip(keys, parallel.items(), strict=False):
            yield arrows[ends], drawing.words(key, **known, v=symbol(f"v_{lettered(name)}"))
        if parallel:
            yield self.found, drawing.words("step.instant-centre-tips-apart", **known)

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the point at rest."""
        return super().fields(drawing) | {"rest": drawing.symbol(lettered(self.resting(drawing)))}


def set_before(drawing: Drawing) -> Mapping[int, int]:
    """The velocities set on the mechanism to find a centre, each with its centre."""
    ends = {
        pair: number
        for number, step, _ in drawing.on_mechanism
        if isinstance(centre := construction(step), InstantCentre) and centre.found == number
        for pair in centre.parallel(drawing).values()
    }
    arrows = arrows_set_on(drawing)
    return {arrows[pair]: number for pair, number in ends.items() if pair in arrows}


def arrows_set_on(drawing: Drawing) -> dict[tuple[int, int], int]:
    """The steps of velocities set on the mechanism, by the steps of place and image."""
    return {
        (step.args[0], step.args[2]): number
        for number, step, _ in drawing.on_mechanism
        if is_set_on(step) and step.part is Part.VELOCITY
    }


# --- writing its steps ---------------------------------------------------------------------------


def draw_centre(pen: Pen, base: Base) -> None:
    """Draw the instantaneous centre of a link, from two of its points or from its rate."""
    points = two_points(pen, base)
    if points is not None:
        pen.want("centre", base.link, InstantCentre.draw(pen, base, points))
    elif pen.has(OMEGA, base.link) and pen.has("velocity", base.start):
        pen.want("centre", base.link, by_turning(pen, base))


def by_turning(pen: Pen, base: Base) -> int:
    """The centre of a link with one known point, from its rate, which its guide gives."""
    o, zero, name = pen.pole(Plane.VELOCITIES), pen.given("zero"), centre_name("I", base.link)
    ends = [pen.the(what, base.start) for what in ("position", "velocity")]
    with pen.on(Part.CENTRE, Plane.MECHANISM):
        turning = pen.the(OMEGA, base.link)
        found = pen.draw(relative_centre, *ends, turning, o, o, zero, name=name)
    kind = RelativeCentre(name=name, first=FRAME, link=base.link, point=base.start, found=found)
    return pen.make(kind).found


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
        pen.want("pole", base.link, pole_by_turning(pen, base))


def pole_by_turning(pen: Pen, base: Base) -> int:
    """The pole of a turning link with one known point, from its ω and ε."""
    ends = [pen.the(what, base.start) for what in ("position", "acceleration")]
    rates = omega_of(pen, base.link), omega_of(pen, base.link, EPSILON)
    name = centre_name("J", base.link)
    with pen.on(Part.POLE, Plane.MECHANISM):
        found = pen.draw(turned_pole, *ends, *rates, name=name)
    kind = AccelerationPole(name=name, link=base.link, point=base.start, found=found)
    return pen.make(kind).found
