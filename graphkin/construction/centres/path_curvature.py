"""The centre of curvature of the path of a point, from its velocity and its acceleration.

By hand, the velocity set at the point is the height of a right triangle whose long side lies on the
normal to the path: the component of the acceleration along the normal, on one side of the point,
and the radius of curvature on the other. Their product is the square of the velocity.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from graphkin.construction.centres.instant_centre import (
    Centre,
    LineToCentre,
    Places,
    VelocityNormal,
    meet_anywhere,
    normals_at,
)
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import Slip, constructions
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
from graphkin.numbers.arithmetic import Point, Real
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
