"""The centre of curvature of the path of a point, from its velocity and its acceleration.

By hand, the velocity set at the point is the height of a right triangle whose long side lies on the
normal to the path: the component of the acceleration along the normal, on one side of the point,
and the radius of curvature on the other. Their product is the square of the velocity.

The points of the inflection circle of a link are at inflections of their paths. By hand, a point of
the circle is laid off on each of two rays to the instantaneous centre. The perpendiculars at both
points meet in the pole of the circle (Thales).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
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
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import Canvas, Slip, constructions
from graphkin.construction.core.naming import drawn_amount, drawn_in, scale_of
from graphkin.construction.core.palette import (
    MECHANISM,
    DrawnThings,
    Move,
    PaletteAction,
    Picked,
    Picks,
)
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.relation import (
    Relation,
    answer,
    as_read,
    divided,
    figure,
    laid_times,
    put_in,
    set_length,
    squared,
)
from graphkin.construction.core.vocabulary import action, perpendicular_at
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import Circle, Line, Ratio, cross, crossing_sine, dot

# --- its value, and the steps by hand ------------------------------------------------------------


def curvature_of(things: DrawnThings, p: str, velocity: str, acceleration: str) -> list[complex]:
    """The centre of curvature of the path of a point with a velocity and an acceleration."""
    v, a = things.value_of(velocity), things.value_of(acceleration)
    across = cross(v, a)
    return [things.value_of(p) + 1j * v * dot(v, v) / across] if across else []


CURVATURE = PaletteAction(
    "curvature",
    (("at", ("point",)), ("velocity", ("arrow",)), ("acceleration", ("arrow",))),
    """(p, velocity, acceleration) => {
      const [v, a] = [value_of(velocity), value_of(acceleration)];
      return [plus(value_of(p), scaled(quarter(v), dot(v, v) / cross(v, a)))];
    }""",
    plane=MECHANISM,
    typed=("curv",),
    draw=curvature_of,
)


def point_and_arrows(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """A point, its velocity and its acceleration."""
    point, o, image, second_o, second = args
    return picks.point_or_line(point), picks.arrow(o, image), picks.arrow(second_o, second)


@action("curvature-centre", move=Move(CURVATURE, point_and_arrows, at_once=True))
def curvature_centre(
    point: Point, o: Point, image: Point, second_o: Point, second_image: Point
) -> Ratio:
    """P + i·v·v²/(v×a): at the distance v²/a_n along the normal, on the side of the acceleration.

    At infinity where the acceleration has no component across the path. Undefined, 0/0, at rest.
    """
    velocity = image - o
    turned = cross(velocity, second_image - second_o)
    return Ratio(point, 1j * velocity * dot(velocity, velocity), turned)


@action("curvature-tip")
def curvature_tip(normal: Line, o: Point, image: Point, seconds: Real) -> Point:
    """The tip of the velocity set where the normal to the path has its point; none at rest."""
    return normal.point + (image - o) * seconds


@action("curvature-foot")
def curvature_foot(
    point: Point, normal: Line, second_o: Point, second_image: Point, seconds: Real
) -> Point:
    """The component of the acceleration along the normal, laid off against its sense."""
    unit = normal.along / abs(normal.along)
    return point - unit * (dot(unit, second_image - second_o) * seconds * seconds)


@action("curvature-meet", margin=crossing_sine)
def curvature_meet(normal: Line, edge: Line) -> Ratio:
    """The centre of curvature, where the perpendicular at the tip meets the normal."""
    return meet_anywhere(normal, edge)


@action("osculating-circle")
def osculating_circle(point: Point, centre: Ratio) -> Circle:
    """The circle through a point of a path about its centre of curvature."""
    middle = centre.start + centre.shift / centre.size
    return Circle(middle, abs(middle - point))


# --- the constructions ---------------------------------------------------------------------------


class CurvatureEdge(LineToCentre, frozen=True, kw_only=True):
    """The perpendicular at the ``tip`` of a velocity to the line from the ``foot`` to that tip.

    The foot is the end of the component of the acceleration on the ``normal`` to the path.
    """

    lines: ClassVar[Mapping[str, str]] = {"line": "⊥ at {tip}"}

    normal: VelocityNormal
    tip: OwnStep
    foot: OwnStep

    def symbols(self) -> Mapping[str, str]:
        """The point, its velocity and its acceleration."""
        p = letter(self.normal.point)
        return {"p": symbol(p), "v": symbol(f"v_{p}"), "a": symbol(f"a_{p}")}

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the velocity at the point, the foot, or the right angle between them."""
        tip, foot = canvas.value(self.tip), canvas.value(self.foot)
        if role == "line":
            canvas.segment(foot, tip)
            super().marks(canvas, role)
            canvas.right_angle(foot)
            return
        if role == "tip":
            name = f"v_{letter(self.normal.point)}"
            canvas.vector(name, "relative-velocity", canvas.value(self.normal.place), tip)
        canvas.spot(canvas.value(getattr(self, role)))

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The normal on which the foot is laid off."""
        return (self.normal.line,) if role == "foot" else ()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the velocity set at the point, or for the component laid off."""
        values, known = drawing.trace.values, self.symbols()
        component = abs(values[self.foot] - values[self.normal.place])
        fields = {
            **known,
            "name": drawing.lettered(getattr(self, role)),
            "set": set_length(drawing, known["v"]),
            "laid": divided(drawing, known["a"], drawing.scales.larger_still),
            "drawn": drawn_amount(drawing, component),
        }
        said = [drawing.words(f"step.curvature-{role}", **fields)]
        if role == "foot" and self.explains_scales(drawing):
            fields["scales"] = scales_of_triangle(drawing)
            said.append(drawing.words("step.curvature-scales", **fields))
        return drawing.words.clauses(said)

    def explains_scales(self, drawing: Drawing) -> bool:
        """Whether it is the first on a sheet whose plans are larger than its vectors."""
        edges = constructions(drawing.trace.program, CurvatureEdge)
        scales, drawn = drawing.scales, drawing.trace.values
        first = next(each.foot for each in edges if each.foot in drawn)
        return (scales.larger, scales.larger_still) != (1, 1) and self.foot == first

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the perpendicular at the tip."""
        names = [drawing.trace.program.steps[each].name for each in (self.foot, self.tip)]
        return drawing.words("step.curvature-edge", tip=drawing.symbol(names[1]), side=bar(*names))

    def places(self, drawing: Drawing) -> Places:
        return {drawing.trace.program.steps[self.tip].name: drawing.trace.values[self.tip]}


def scales_of_triangle(drawing: Drawing) -> str:
    """The condition that makes v²/a a length of the mechanism: (5·kv)² = kL·3·ka."""
    m = drawing.scales.larger
    enlarged = "*k*_v" if m == 1 else f"{figure(drawing, m)}·*k*_v"
    return drawing.in_signs(f"{squared(enlarged)} = *k*_L·{laid_times(drawing)}*k*_a")


class PathCentre(Centre, frozen=True, kw_only=True):
    """The centre of curvature of the path of ``point``, with the osculating ``circle``.

    ``place``, ``pole``, ``image``, ``second_pole`` and ``second_image`` are the steps of the point,
    of the poles of both plans and of its images. The ``ways`` are the normal to the path and the
    perpendicular at the tip of the velocity.
    """

    reasons: ClassVar[Mapping[str, str]] = {"found": "why.curvature"}
    slips: ClassVar[Mapping[str, Slip]] = {"curvature_reversed": Slip(-1, "moderate")}
    key: ClassVar[str] = "curvature-centre"
    called: ClassVar[str] = "the centre of curvature of the path of"
    look: ClassVar[str] = "inflection"

    place: int
    pole: int
    image: int
    second_pole: int
    second_image: int
    circle: OwnStep

    def title(self, role: str) -> str:
        """The name of the centre in a report."""
        return f"{self.called} {self.point}" if role == "found" else ""

    def symbols(self) -> Mapping[str, str]:
        """The centre, its point, and the velocity and acceleration of the point."""
        p = letter(self.point)
        names = {"name": self.name, "p": p, "v": f"v_{p}", "a": f"a_{p}"}
        return {key: symbol(name) for key, name in names.items()}

    def velocity(self, drawing: Drawing) -> complex:
        """The velocity of the point."""
        values = drawing.trace.values
        return complex(values[self.image] - values[self.pole])

    def component(self, drawing: Drawing) -> float:
        """The magnitude of the acceleration along the normal; zero for rounding, and at rest."""
        values, velocity = drawing.trace.values, self.velocity(drawing)
        across = cross(velocity, values[self.second_image] - values[self.second_pole])
        return drawing.settled(abs(across / velocity)) if velocity else 0.0

    # --- drawing it ------------------------------------------------------------------------------

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the centre, or the circle about it."""
        if role == "circle":
            canvas.circle(canvas.value(self.circle), self.look)
        else:
            super().marks(canvas, role)

    def mark_far(self, canvas: Canvas) -> None:
        """Mark a far centre; of a straight path and of a point at rest the sentence says all."""
        if not self.oddity(canvas.drawing):
            super().mark_far(canvas)

    # --- its sentences and relations -------------------------------------------------------------

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The perpendicular at the tip; the foot has the normal before it."""
        return super().said_before(drawing, role)[-1:]

    def oddity(self, drawing: Drawing) -> str:
        """The special case: "rest" without a velocity, "straight" without a centre."""
        least = NOISE * (drawing.longest(Plane.VELOCITIES) or 1.0)
        if abs(self.velocity(drawing)) <= least:
            return "rest"
        return "straight" if drawing.place(self.value(drawing)) is None else ""

    def sentence_key(self, drawing: Drawing) -> str:
        """The key by its special case."""
        odd = self.oddity(drawing)
        return f"{self.key}-{odd}" if odd else self.key

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for the centre after that of the perpendicular."""
        if role != "found" or self.sentence_key(drawing) != self.key:
            return ""
        return drawing.words("step.curvature-centre-apart", **self.fields(drawing))

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The component as measured in the plan, and v²/a_n, the radius of curvature."""
        if role != "found" or self.oddity(drawing):
            return
        words, p, size = drawing.words, letter(self.point), self.component(drawing)
        across, speed = drawing.symbol(f"a_{p}^ν"), abs(self.velocity(drawing))
        measured = drawn_in(drawing, Plane.ACCELERATIONS, size)
        read = as_read(drawing, measured, scale_of(drawing, Plane.ACCELERATIONS) / 1000)
        remark = words("calculation.across_path", a=symbol(f"a_{p}"), v=symbol(f"v_{p}"))
        yield Relation(across, "", *read, "m/s^2", remark)
        result = answer(drawing, speed * speed / size)
        v, over = put_in(drawing, result, lambda v, over: v * v / over, speed, size)
        drawn = drawn_amount(drawing, speed * speed / size)
        yield Relation(
            symbol(f"ρ_{p}"),
            f"{symbol(f'v_{p}')}^2/{across}",
            f"{v}^2/{over}",
            result,
            "m",
            words(
                "calculation.radius_drawn", bar=symbol(p) + drawing.symbol(self.name), drawn=drawn
            ),
        )


# --- writing its steps ---------------------------------------------------------------------------


def draw_curvature(pen: Pen, point: str) -> None:
    """Draw the centre of curvature of the path of a point that has been constructed."""
    place, image, second = (
        pen.the(what, point) for what in ("position", "velocity", "acceleration")
    )
    o, second_o = pen.pole(Plane.VELOCITIES), pen.pole(Plane.ACCELERATIONS)
    p, seconds = letter(point), pen.seconds()
    with pen.on(Part.POLE, Plane.MECHANISM):
        with pen.hands_way():
            (normal,) = normals_at(pen, (point,), o)
            tip = pen.draw(curvature_tip, normal.line, o, image, seconds, name=f"{p}_t")
            foot = pen.draw(
                curvature_foot, place, normal.line, second_o, second, seconds, name=f"{p}_n"
            )
            line = pen.draw(perpendicular_at, tip, foot)
            crossing = pen.draw(curvature_meet, normal.line, line)
        ends = place, o, image, second_o, second
        found = pen.draw(curvature_centre, *ends, name=f"Ω_{p}", by_hand=crossing)
        circle = pen.arrow(osculating_circle, place, found, name=f"osculating {point}")
    edge = pen.make(CurvatureEdge(normal=normal, tip=tip, foot=foot, line=line))
    pen.make(
        PathCentre(
            name=f"Ω_{p}",
            point=point,
            ways=(normal, edge),
            crossing=crossing,
            found=found,
            circle=circle,
            place=place,
            pole=o,
            image=image,
            second_pole=second_o,
            second_image=second,
        )
    )
    pen.want("curvature", point, found)


# --- the inflection circle of a link --------------------------------------------------------------


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
