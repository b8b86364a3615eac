"""The acceleration pole of a link: on a bar the triangle similar to that of the plan (Mehmke)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.centres.centre import (
    Centre,
    LineToCentre,
    Places,
    centre_name,
    two_points,
)
from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.pen import Pen, named
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.guides.coincident_points import omega_of
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, Ratio

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing


@action("pole-ray")
def pole_ray(corner: Point, other: Point, o: Point, image: Point, image_other: Point) -> Line:
    """At one end of a bar the angle that the plan shows at its image, between image and pole."""
    return Line(corner, (other - corner) * ((o - image) / (image_other - image)))


@action("acceleration-pole")
def acceleration_pole(o: Point, p: Point, q: Point, image_p: Point, image_q: Point) -> Ratio:
    """The point of a link without acceleration, J - p : q - p = o - p' : q' - p' (Mehmke)."""
    return Ratio(p, (o - image_p) * (q - p), image_q - image_p)


@action("acceleration-pole")
def turned_pole(p: Point, image: Point, omega: Real, epsilon: Real) -> Ratio:
    """The point of a link without acceleration from one point's and the link's turning."""
    return Ratio(p, image, at(omega * omega, -epsilon))


# --- what it is ----------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class PoleRay(LineToCentre):
    """At an end of a bar, ``point``, the angle that the plan shows at its image."""

    lines: ClassVar[Mapping[str, str]] = {"line": "the ray at {point}"}

    point: str
    other: str

    @property
    def name(self) -> str:
        """The bar, beginning with its own end."""
        return self.point + self.other

    def clause(self, drawing: Drawing, role: str = "") -> str:
        """Nothing: the sentence of the pole tells of the angles."""
        return ""


@dataclass(frozen=True, kw_only=True)
class AccelerationPole(Centre):
    """The pole of a link by the accelerations of two points, their images ``image`` and
    ``other_image`` in the plan; by one point's and the link's turning where ``other`` is empty.
    """

    key: ClassVar[str] = "acceleration-pole"
    called: ClassVar[str] = "the acceleration pole of link"
    reasons: ClassVar[Mapping[str, str]] = {"found": "why.pole"}

    other: str = ""
    image: str = ""
    other_image: str = ""

    def mark_far(self, canvas: Canvas) -> None:
        """At infinity only a note: all points of the link accelerate alike."""
        drawing, value = canvas.drawing, self.value(canvas.drawing)
        if drawing.place(value) is not None:
            super().mark_far(canvas)
        elif not drawing.is_everywhere(value):
            fields = {"name": symbol(self.name), "k": self.link}
            canvas.note(drawing.words("page.pole_at_infinity", **fields))

    def lines_to(self, drawing: Drawing) -> list[Places]:
        """From each of the two points."""
        points = (self.point, self.other) if self.other else ()
        return [{point: drawing.standing.spot(point)} for point in points]

    def oddity(self, drawing: Drawing) -> str:
        """Also that it is a point of the bar, from which no ray leads."""
        odd = super().oddity(drawing)
        lost = self.crossing is not None and not self.is_by_hand(drawing)
        return odd or ("still" if lost else "")

    def sentence_key(self, drawing: Drawing) -> str:
        """By what is odd about it; a fixed pin needs no triangle."""
        how = "" if self.crossing is not None else "pivot" if self.other else "turned"
        suffix = self.oddity(drawing) or how
        return f"{self.key}-{suffix}" if suffix else self.key

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The bar and its image in the plan."""
        found = super().fields(drawing)
        if self.other:
            a, b = symbol(self.image), symbol(self.other_image)
            figure = symbol(drawing.pole) + a + b
            found |= {"q": symbol(self.other), "bar": bar(self.point, self.other)}
            found |= {"a": a, "b": b, "figure": figure}
        return found


# --- planning it ---------------------------------------------------------------------------------


def draw_pole(pen: Pen, base: Base) -> None:
    """The acceleration pole of a link: on base AB a triangle similar to o′a′b′ (Mehmke)."""
    points = two_points(pen, base)
    if points is None:
        by_turning(pen, base)
        return
    o, name = pen.pole(Plane.ACCELERATIONS), centre_name("J", base.link)
    p, q = (pen.the("position", point) for point in points)
    a, b = (pen.the("acceleration", point) for point in points)
    with pen.on(Part.POLE, Plane.MECHANISM):
        crossing, rays = None, tuple[PoleRay, ...]()
        if o not in (a, b):
            with pen.hands_way():
                rays = (
                    ray_at(pen, points, (p, q, o, a, b)),
                    ray_at(pen, points[::-1], (q, p, o, b, a)),
                )
                crossing = pen.draw(meet, *(ray.line for ray in rays))
        found = pen.draw(acceleration_pole, o, p, q, a, b, name=name, by_hand=crossing)
    pen.make(
        AccelerationPole(
            name=name,
            link=base.link,
            point=points[0],
            other=points[1],
            image=named(pen, a),
            other_image=named(pen, b),
            ways=rays,
            crossing=crossing,
            found=found,
        )
    )
    pen.want("pole", base.link, found)


def ray_at(pen: Pen, bar: tuple[str, ...], ends: tuple[int, ...]) -> PoleRay:
    """The plan's angle at an image, set at the first end of a bar."""
    line = pen.draw(pole_ray, *ends)
    return pen.make(PoleRay(point=bar[0], other=bar[1], line=line))


def by_turning(pen: Pen, base: Base) -> None:
    """The pole of a link that turns and of which one point is known: by its ω and ε."""
    if not pen.turns(base.link) or not pen.has("acceleration", base.start):
        return
    ends = [pen.the(what, base.start) for what in ("position", "acceleration")]
    rates = omega_of(pen, base.link), omega_of(pen, base.link, "epsilon")
    with pen.on(Part.POLE, Plane.MECHANISM):
        name = centre_name("J", base.link)
        found = pen.draw(turned_pole, *ends, *rates, name=name)
    pen.make(AccelerationPole(name=name, link=base.link, point=base.start, found=found))
    pen.want("pole", base.link, found)
