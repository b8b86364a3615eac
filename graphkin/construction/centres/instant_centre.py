"""Instantaneous centres of links, and acceleration poles; all may lie at infinity.

A centre lies where the normals to two velocities cross. For two parallel velocities it is where the
line through their tips meets the bar of their points. The centre of two links is a pin, a guide's
at infinity, or where two lines of centres meet: the centres of three links lie on one line
(Kennedy, Aronhold). Every centre is a Ratio, start + shift/size. The acceleration pole follows from
a triangle similar to the one in the plan (Mehmke).
"""

from __future__ import annotations

from abc import abstractmethod
from cmath import phase
from collections.abc import Iterator, Mapping
from math import degrees
from typing import Any, ClassVar

from graphkin.construction.core.bases import Base
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import (
    Canvas,
    Construction,
    SaidInParts,
    Sentence,
    construction,
    together,
)
from graphkin.construction.core.palette import (
    CUTS,
    JOIN,
    PERPENDICULAR,
    POLE,
    Move,
    bar_and_images,
    point_and_arrow,
    two,
)
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane, is_set_on
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.vocabulary import Action, action, meet
from graphkin.construction.plan import omega_of
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real, at, pick
from graphkin.numbers.plane import Circle, Line, Ratio, cross, crossing_sine, dot
from graphkin.scene.link_points import is_under, lettered
from graphkin.scene.model import FRAME

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


@action("pin-centre")
def pin_centre(pin: Point) -> Ratio:
    """The centre of two links at their pin, or at the contact point of a wheel and its track."""
    return Ratio(pin, 0 * pin, 1.0)


@action("guide-centre")
def guide_centre(point: Point, guide: Line) -> Ratio:
    """The centre of a block and its guide: at infinity, perpendicular to the guide."""
    return Ratio(point, 1j * guide.along, 0.0)


@action("relative-centre")
def relative_centre(
    p: Point, image_p: Point, omega_p: Real, q: Point, image_q: Point, omega_q: Real
) -> Ratio:
    """The point of two links with one velocity on both: p + i·(v_p - v_q at p)/(ω_p - ω_q).

    p is a point of the first link, q one of the second. The error is 8·eps of the larger distance.
    """
    there = image_q + 1j * (p - q) * omega_q
    return Ratio(p, 1j * (image_p - there), omega_p - omega_q)


@action("kennedy-line", move=Move(JOIN, two))
def kennedy_line(a: Ratio, b: Ratio) -> Line:
    """The line of two centres of three links, on which the third lies (Kennedy, Aronhold).

    It is anchored at the centre nearer to its own start, never at infinity. For two centres at
    infinity the direction is zero: their line lies at infinity.
    """
    nearer = abs(a.shift) * abs(b.size) <= abs(b.shift) * abs(a.size)
    start, shift, size = (pick(nearer, x, y) for x, y in zip(a, b, strict=True))
    along = (b.start - a.start) * a.size * b.size + b.shift * a.size - a.shift * b.size
    return Line(start + shift / size, along)


@action("kennedy-meet", margin=crossing_sine, move=CUTS)
def kennedy_meet(m: Line, n: Line) -> Ratio:
    """The centre of two links, where two lines of centres meet."""
    return meet_anywhere(m, n)


@action("kennedy-endless")
def kennedy_endless(line: Line) -> Ratio:
    """The centre at infinity on a line of centres; the other line lies wholly at infinity."""
    return Ratio(line.point, line.along, 0.0)


@action("normals-meet", margin=crossing_sine)
def normals_meet(m: Line, n: Line) -> Ratio:
    """The instantaneous centre, where the normals to two velocities meet (Chasles)."""
    return meet_anywhere(m, n)


# --- the constructions ---------------------------------------------------------------------------


class LineOfCentres(LineToCentre, frozen=True, kw_only=True):
    """The line of two centres, by their letters and the steps that hold them."""

    reasons: ClassVar[Mapping[str, str]] = {"line": "why.kennedy"}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line of centres"}

    letters: tuple[str, str]
    ends: tuple[int, int]

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause with both centres; a centre at infinity is named last."""
        places = [drawing.place(drawing.trace.values[end]) for end in self.ends]
        m, n = map(symbol, self.letters if places[0] is not None else self.letters[::-1])
        return drawing.words(f"step.kennedy-line{'-far' if None in places else ''}", m=m, n=n)

    def places(self, drawing: Drawing) -> Places:
        """The centres that do not lie at infinity."""
        values = drawing.trace.values
        places = zip(self.letters, (drawing.place(values[end]) for end in self.ends), strict=True)
        return {letter: place for letter, place in places if place is not None}


class PairCentre(Centre, frozen=True, kw_only=True):
    """The centre of two links, ``first`` and ``link``, in the order of the scene."""

    first: str

    def title(self, role: str) -> str:
        """The name in a report: its link, and the other link where that is not the frame."""
        against = "" if self.first == FRAME else f" against link {self.first}"
        return super().title(role) + against if role == "found" else ""

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with both links."""
        return super().fields(drawing) | {"j": escape(self.first)}


class PinCentre(PairCentre, frozen=True, kw_only=True):
    """A pin of two links."""

    key: ClassVar[str] = "pin-centre"
    reasons: ClassVar[Mapping[str, str]] = {"found": "why.pin"}

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw a ring around the pin."""
        canvas.ring(canvas.value(self.found).start)


class GuideCentre(PairCentre, frozen=True, kw_only=True):
    """The centre of a ``block`` and its guide."""

    key: ClassVar[str] = "guide-centre"

    block: str

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw a ray towards the centre at infinity."""
        value = canvas.value(self.found)
        text = far_words(canvas.drawing, self.value(canvas.drawing), self.name, self.point)
        canvas.away(value.start, way_to(value), text)

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the guide by its block."""
        return super().fields(drawing) | {"g": escape(self.block)}


class RelativeCentre(PairCentre, frozen=True, kw_only=True):
    """The centre of two links by their velocities; by hand where two lines of centres meet.

    ``touching`` links have it at their contact point. ``belted`` links have it where the strands of
    their belt meet the line of centres. ``aside``: no line is drawn from its point.
    """

    key: ClassVar[str] = "relative-centre"

    touching: bool = False
    belted: bool = False
    aside: bool = False

    def same(self, drawing: Drawing) -> int | None:
        """The step of the instantaneous centre on this sheet that coincides with this centre."""
        if FRAME not in (self.first, self.link):
            return None
        link = self.link if self.first == FRAME else self.first
        number = drawing.trace.program.targets.get(("centre", link), self.found)
        return None if number == self.found or number not in drawing.trace.values else number

    def equal(self, drawing: Drawing) -> str:
        """The letter of the coinciding instantaneous centre; empty where there is none."""
        same = self.same(drawing)
        return "" if same is None else drawing.lettered(same)

    def mark_far(self, canvas: Canvas) -> None:
        """Mark a far centre; if it has another letter already, only that the two are equal."""
        drawing, value = canvas.drawing, self.value(canvas.drawing)
        way, same = way_to(value), self.equal(drawing)
        if drawing.is_everywhere(value) or not way or not same:
            super().mark_far(canvas)
            return
        text = f"{drawing.symbol(self.name)} = {same}"
        canvas.away(value.start, way, text, ray=self.needs_ray(canvas), headed=False)

    def needs_ray(self, canvas: Canvas) -> bool:
        """Whether a ray is necessary: also where the lines do not begin at its point."""
        return self.aside or super().needs_ray(canvas)

    def sentence_key(self, drawing: Drawing) -> str:
        """The key by the way its lines meet, or by its special case."""
        if not self.is_by_hand(drawing):
            known = "belt" if self.belted else "touch" if self.touching else ""
            suffix = self.oddity(drawing) or known
            return f"{self.key}-{suffix}" if suffix else self.key
        if len(self.ways) == 1:
            return "kennedy-endless"
        if odd := self.oddity(drawing):
            return f"{self.key}-{odd}"
        if not isinstance(self.ways[0], LineOfCentres):
            return "normals-meet"
        return "kennedy-meet-again" if self.equal(drawing) else "kennedy-meet"

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the letter by which the centre is known already."""
        return super().fields(drawing) | {"same": self.equal(drawing)}

    def crossed(self, drawing: Drawing) -> str:
        """The centre with the two lines of centres that meet in it, as I₁₃ (I₁₂I₂₃, I₁₄I₃₄).

        Empty where two such lines do not meet, or meet at infinity.
        """
        lines = [line for line in self.ways if isinstance(line, LineOfCentres)]
        if len(lines) != 2 or not self.is_by_hand(drawing) or self.oddity(drawing):
            return ""
        pairs = ("".join(map(symbol, line.letters)) for line in lines)
        same, name = self.equal(drawing), drawing.symbol(self.name)
        called = f"{name} = {same}" if same else name
        return f"{called} ({drawing.words('list_mark').join(pairs)})"


def with_centres_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The centres known at once in one sentence, and the centres by two lines in another.

    Of the latter, the first has a full sentence, and so has each with unusual lines.
    """
    steps, words = drawing.trace.program.steps, drawing.words
    kinds = [(said, construction(steps[said.step])) for said in found if said.step >= 0]
    at_once = [said for said, kind in kinds if isinstance(kind, PinCentre | GuideCentre)]
    crossed = [
        (said, markup)
        for said, kind in kinds
        if isinstance(kind, RelativeCentre) and (markup := kind.crossed(drawing))
    ]
    if at_once:
        guided = any(isinstance(kind, GuideCentre) for _, kind in kinds)
        listed = words("list_mark").join(said.markup for said in at_once)
        markup = words(f"step.centres-{'guided' if guided else 'pinned'}", list=listed)
        found = together(found, at_once, markup)
    if len(crossed) > 2:
        listed = words("list_mark").join(markup for _, markup in crossed[1:])
        some = [said for said, _ in crossed[1:]]
        found = together(found, some, words("step.centres-crossed", list=listed))
    return found


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
