"""Centres of motion, which may lie at infinity: their marks and sentences, near and far."""

from __future__ import annotations

from abc import abstractmethod
from cmath import phase
from collections.abc import Mapping
from math import degrees
from typing import Any, ClassVar

from graphkin.construction.core.bases import Base
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.palette import PERPENDICULAR, Move, point_and_arrow
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.vocabulary import Action, action, meet
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Circle, Line, Ratio, cross
from graphkin.scene.link_points import is_under, lettered

Places = dict[str, complex]
"""Places on a line by name."""


# --- the lines that lead to a centre -------------------------------------------------------------


@action("velocity-normal", move=Move(PERPENDICULAR, point_and_arrow))
def velocity_normal(point: Point, o: Point, image: Point) -> Line:
    """The perpendicular to the velocity of a point, through that point (Chasles)."""
    return Line(point, 1j * (image - o))


def meet_anywhere(m: Line, n: Line) -> Ratio:
    """The point where two lines meet, at infinity where they are parallel."""
    gap = n.point - m.point
    return Ratio(m.point, cross(gap, n.along) * m.along, cross(m.along, n.along))


class LineToCentre(Construction, frozen=True, kw_only=True):
    """A line on which a centre lies."""

    line: OwnStep

    @property
    def name(self) -> str:
        """The name of its mark."""
        return ""

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line as far as the centre."""
        canvas.line("ray", self.name)

    def places(self, drawing: Drawing) -> Places:
        """The places through which the line is drawn, without those at infinity."""
        return {}


class VelocityNormal(LineToCentre, frozen=True, kw_only=True):
    """The perpendicular to the velocity of a ``point``.

    ``place``, ``pole`` and ``image`` are the steps of the point, of the plan's pole and of its
    image.
    """

    lines: ClassVar[Mapping[str, str]] = {"line": "⊥ velocity of {point}"}

    point: str
    place: int
    pole: int
    image: int

    @property
    def name(self) -> str:
        return self.point

    @property
    def square_to(self) -> tuple[int, int, int]:
        """The pin, and the pole and the image that its velocity joins in the plan."""
        return self.place, self.pole, self.image

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the perpendicular to the velocity at the point."""
        name = lettered(self.point)
        fields = {"p": drawing.symbol(name), "v": symbol(f"v_{name}")}
        return drawing.words("step.velocity-normal", **fields)

    def places(self, drawing: Drawing) -> Places:
        """The point."""
        own = drawing.trace.program.steps[self.place].name
        return {lettered(own or self.point): drawing.trace.values[self.place]}


# --- the constructions ---------------------------------------------------------------------------


class Centre(Construction, frozen=True, kw_only=True):
    """A place of a link, or of a point's path, that may lie at infinity, with its letter.

    It is a Ratio that starts at ``point``. ``found`` is its numerically stable value. ``crossing``
    is the place found by hand, where its ``ways`` meet.
    """

    key: ClassVar[str]
    called: ClassVar[str] = "the centre of link"

    name: str
    link: str = ""
    point: str
    found: OwnStep
    crossing: OwnStep | None = None
    ways: tuple[LineToCentre, ...] = ()

    def title(self, role: str) -> str:
        """The name of the centre in a report."""
        return f"{self.called} {self.link}" if role == "found" else ""

    def symbols(self) -> Mapping[str, str]:
        """The centre, the point from which it is found, and its link."""
        return {
            "name": symbol(self.name),
            "p": symbol(lettered(self.point)),
            "k": escape(self.link),
        }

    def is_by_hand(self, drawing: Drawing) -> bool:
        """Whether the lines that lead to it meet on a sheet."""
        return self.crossing in drawing.trace.values

    def value(self, drawing: Drawing) -> Ratio:
        """Its place on a sheet."""
        found: Ratio = drawing.trace.values[self.found]
        return found

    # --- drawing it ------------------------------------------------------------------------------

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw its circle and cross; off the field, its direction and distance."""
        if role == "found" and not canvas.centre(canvas.value(self.found)):
            self.mark_far(canvas)

    def mark_far(self, canvas: Canvas) -> None:
        """Write its name and distance where a ray to it leaves the field."""
        mark_away(canvas, self.value(canvas.drawing), self.name, self.point, self.needs_ray(canvas))

    def needs_ray(self, canvas: Canvas) -> bool:
        """Whether a ray is necessary because no line is drawn from its point to the centre."""
        return not self.is_by_hand(canvas.drawing)

    def lines_to(self, drawing: Drawing) -> list[Places]:
        """For each line to the centre, the places on it by name, the farthest first.

        Empty where one of the lines passes through no place, or the centre lies at infinity.
        """
        point = drawing.place(self.value(drawing))
        if point is None or not self.is_by_hand(drawing):
            return []
        every = [line.places(drawing) for line in self.ways]
        ordered = [sorted(each.items(), key=lambda item: -abs(item[1] - point)) for each in every]
        return [dict(each) for each in ordered] if all(every) else []

    def around(self, drawing: Drawing) -> tuple[str, Circle] | None:
        """The circle on which it lies, after its style; None for most centres."""
        return None

    # --- its sentences ---------------------------------------------------------------------------

    def oddity(self, drawing: Drawing) -> str:
        """The special case of a centre: "everywhere", or "far" for infinity; empty for others."""
        value = self.value(drawing)
        if drawing.is_everywhere(value):
            return "everywhere"
        return "far" if drawing.place(value) is None else ""

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The lines that lead to it."""
        return tuple(way.line for way in self.ways) if self.is_by_hand(drawing) else ()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence on how its lines find it, or on where it is."""
        return drawing.words(f"step.{self.sentence_key(drawing)}", **self.fields(drawing))

    def sentence_key(self, drawing: Drawing) -> str:
        """The key of the sentence about the centre itself."""
        return self.key

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of that sentence."""
        return dict(self.symbols())


class TwoPointCentre(Centre, frozen=True, kw_only=True):
    """A centre that follows from the motion of two points of its link, ``point`` and ``other``.

    ``o``, ``places`` and ``images`` are the steps of the plan's pole and of both points.
    """

    letter: ClassVar[str]
    quantity: ClassVar[str]
    part: ClassVar[Part]
    plane: ClassVar[Plane]
    action: ClassVar[Action]

    other: str = ""
    o: int | None = None
    places: tuple[int, ...] = ()
    images: tuple[int, ...] = ()

    def lines_to(self, drawing: Drawing) -> list[Places]:
        """One line from each of its two points."""
        points = (self.point, self.other) if self.other else ()
        return [{name: drawing.standing.spot(name)} for name in map(lettered, points)]

    def oddity(self, drawing: Drawing) -> str:
        """The special case, also "still": it is a point of the bar that no lines lead to."""
        lost = self.crossing is not None and not self.is_by_hand(drawing)
        return super().oddity(drawing) or ("still" if lost else "")

    def sentence_key(self, drawing: Drawing) -> str:
        """The key by its special case; a fixed pin needs no lines."""
        how = "" if self.crossing is not None else "pivot" if self.other else "turned"
        suffix = self.oddity(drawing) or how
        return f"{self.key}-{suffix}" if suffix else self.key

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with both points."""
        p, q = lettered(self.point), lettered(self.other)
        return super().fields(drawing) | ({"q": symbol(q), "bar": bar(p, q)} if q else {})

    @classmethod
    @abstractmethod
    def lines_at(cls, pen: Pen, points: tuple[str, str], o: int) -> tuple[LineToCentre, ...]:
        """The lines at the two points that meet in it."""

    @classmethod
    def draw(cls, pen: Pen, base: Base, points: tuple[str, str]) -> int:
        """Draw it, with the construction by hand where neither point is a fixed pin."""
        o, name = pen.pole(cls.plane), centre_name(cls.letter, base.link)
        places = tuple(pen.the("position", point) for point in points)
        images = tuple(pen.the(cls.quantity, point) for point in points)
        with pen.on(cls.part, Plane.MECHANISM):
            crossing, ways = None, tuple[LineToCentre, ...]()
            if o not in images:
                with pen.hands_way():
                    ways = cls.lines_at(pen, points, o)
                    crossing = pen.draw(meet, *(way.line for way in ways))
            ends = o, *places, *images
            found = pen.draw(cls.action, *ends, name=name, by_hand=crossing)
        kind = cls(
            name=name,
            link=base.link,
            point=points[0],
            other=points[1],
            o=o,
            places=places,
            images=images,
            ways=ways,
            crossing=crossing,
            found=found,
        )
        return pen.make(kind).found


# --- off the field -------------------------------------------------------------------------------


def mark_away(canvas: Canvas, value: Ratio, name: str, point: str, ray: bool) -> None:
    """Mark a centre off its field: name, direction and distance where a ray leaves the field.

    Nothing where every point is a centre: the sentence of the link says so.
    """
    way = way_to(value)
    if not canvas.drawing.is_everywhere(value) and way:
        text = far_words(canvas.drawing, value, name, point)
        canvas.away(value.start, way, text, ray=ray)


def way_to(value: Ratio) -> Any:
    """The vector to a centre, or only its direction where the centre lies at infinity."""
    return value.shift / value.size if value.size else value.shift


def far_words(drawing: Drawing, value: Ratio, name: str, point: str) -> str:
    """The words for a centre that lies off the sheet or at infinity."""
    words, way = drawing.words, way_to(value)
    angle = words.fixed(degrees(phase(way)) % 360, 1)
    fields = {"name": drawing.symbol(name), "p": symbol(lettered(point)), "angle": angle}
    if drawing.place(value) is None:
        return words("page.centre_at_infinity", **fields)
    fields["unit"] = drawing.scene.units["length"]
    away = words.significant(drawing.length(abs(way)), 4)
    return words("page.far_centre", distance=away, **fields)


# --- writing its steps ---------------------------------------------------------------------------


def centre_name(letter: str, link: str) -> str:
    """The name of a centre: J3 for a numbered link, J_rod for a link with a name."""
    return letter + (link if link.isdigit() else f"_{link}")


def known_points(pen: Pen, base: Base) -> list[str]:
    """The constructed points of a link, its own points before those under others.

    A contact point comes last, because the normal at a wheel's contact passes through the wheel's
    centre. The centre gives the same line.
    """
    points = [base.start, *([base.end] if base.end else []), *base.others]
    if base.link not in pen.scene.cam_links:  # in a dwell it is the cam's pivot
        points = [point for point in points if point not in pen.scene.cam_centres]
    moving = ("position", "velocity", "acceleration")
    known = [p for p in dict.fromkeys(points) if all(pen.has(what, p) for what in moving)]
    return sorted(known, key=is_under)


def two_points(pen: Pen, base: Base) -> tuple[str, str] | None:
    """Two constructed points of a link that turns; None for a link with one, or in translation."""
    known = known_points(pen, base)
    return (known[0], known[1]) if len(known) > 1 and pen.turns(base.link) else None


def normals_at(pen: Pen, points: tuple[str, ...], o: int) -> tuple[VelocityNormal, ...]:
    """The perpendiculars to the velocities of some points; ``o`` is the pole of the plan."""
    found = []
    for point in points:
        place, image = pen.the("position", point), pen.the("velocity", point)
        line = pen.draw(velocity_normal, place, o, image)
        normal = VelocityNormal(point=point, place=place, pole=o, image=image, line=line)
        found.append(pen.make(normal))
    return tuple(found)
