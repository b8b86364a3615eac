"""The marks of steps: each value of the trace placed on the page, under its action's own look."""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import degrees, hypot
from typing import Any

from graphkin.paper.areas import Rect
from graphkin.paper.drawing import Drawing, place_of
from graphkin.paper.field import XY, Field, clipped
from graphkin.paper.labels import Board, Label
from graphkin.paper.layout import BEYOND, SWEEP, Layout
from graphkin.paper.marks import Arc, Circle, Line
from graphkin.paper.symbolic import bar, symbol
from graphkin.paper.symbols import PIN, SHORT, arrow, bearing, head, square_mark
from graphkin.plane import Ratio
from graphkin.steps.program import Part, Plane, Step

DOT = 0.7
"""Radius of a point of a plan in mm."""


@dataclass(frozen=True)
class Desk:
    """Where steps of one drawing are put down: board, field, and the sheet's material."""

    board: Board
    field: Field
    drawing: Drawing
    layout: Layout

    @property
    def colour(self) -> str:
        """The class that colours this sheet's plan."""
        return self.drawing.kind


TINY = 0.5
"""Vectors shorter than this, in mm, are named at the foot of their field."""
ENDLESS = 1e9
"""A centre this many millimetres of paper away counts as at infinity."""
LAST = 20.0
"""How much of a ray to a far centre its name belongs to, in mm."""
FOOT = 6.5
"""Height kept free of construction lines at the foot of a field, in mm."""
FAR = 2000.0
"""Longer than any way on a page, in mm."""

Put = Callable[[Desk, int, Step, Any], None]


def draw_mechanism_steps(desk: Desk, *, found: bool) -> None:
    """Put down the steps on the mechanism: those that found its points, or all the others."""
    for number, step, value in desk.drawing.mechanism_steps():
        if (step.part is Part.POSITION) is found:
            put_step(desk, number, step, value)


def draw_plan_steps(desk: Desk) -> None:
    """Put down every step of the plan, in order."""
    for number, step, value in desk.drawing.steps(desk.drawing.plane):
        put_step(desk, number, step, value)


def put_step(desk: Desk, number: int, step: Step, value: Any) -> None:
    """Put down one step in the look of its action, if it has one."""
    key = step.action.key if step.action else "given"
    plane = Plane.MECHANISM if step.plane is Plane.MECHANISM else Plane.NUMBERS
    put = PUTS.get((plane, key))
    if put:
        put(desk, number, step, value)


def put_line(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A construction line, as far as the layout says, with what it is to its bar."""
    ends = line_ends(desk, number, value)
    if ends is None:
        return
    name = line_name(step)
    desk.board.marks.append(Line(*ends[0], *ends[1], "construction", name, number))
    markup = line_label(desk, step)
    if markup:
        desk.board.labels.append(
            Label(markup, "construction", ends, 1.8, name, number, priority=-1)
        )


def line_ends(desk: Desk, number: int, value: Any) -> tuple[XY, XY] | None:
    """Both ends of the drawn part of a line, within its field."""
    low, high = desk.layout.spans[number]
    unit = value.along / abs(value.along) / desk.field.mm
    start, end = desk.field(value.point + low * unit), desk.field(value.point + high * unit)
    return clipped(start, end, above_foot(desk.field.rect))


def line_name(step: Step) -> str:
    """Name of a construction line: what it is drawn through and what it is square to."""
    key = step.action.key if step.action else ""
    sign = {"square-to": "⊥", "parallel-to": "∥"}.get(key, "")
    return sign + step.says.get("p", step.says.get("g", "")) + step.says.get("q", "")


def line_label(desk: Desk, step: Step) -> str:
    """What is written along a construction line of a plan."""
    key = step.action.key if step.action else ""
    if key == "square-to":
        return f"⊥ {bar(step.says['p'], step.says['q'])}"
    if key == "parallel-to":
        return f"∥ {desk.drawing.words('page.guide_of', g=step.says['g'])}"
    return ""


def put_arc(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The part of a compass arc that finds a point."""
    if number not in desk.layout.spans:
        return
    name = step.says["p"] + step.says["q"]
    centre, radius = desk.field(value.centre), value.radius * desk.field.mm
    span = desk.layout.spans[number]
    desk.board.marks.append(Arc(*centre, radius, *span, "compass", name, number))


def put_point(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A named point of a plan."""
    if step.name:
        at = desk.field(value)
        desk.board.marks.append(Circle(*at, DOT, f"point {desk.colour}", step.name, number))
        name_point(desk, number, step, at, DOT)


def put_pole(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The pole of a plan."""
    at = desk.field(value)
    desk.board.marks.append(Circle(*at, PIN, f"pole {desk.colour}", step.name, number))
    name_point(desk, number, step, at, PIN)


def name_point(desk: Desk, number: int, step: Step, at: XY, radius: float) -> None:
    """The letter of a point; points that fall together share one label, o ≡ a."""
    board = desk.board
    for i, (x, y) in board.lettered.items():
        if hypot(x - at[0], y - at[1]) < TINY:
            label = board.labels[i]
            together = f"{label.markup} ≡ {symbol(step.name)}"
            board.labels[i] = replace(label, markup=together, name=f"{label.name} {step.name}")
            return
    board.lettered[len(board.labels)] = at
    letter = symbol(step.name)
    board.labels.append(
        Label(letter, desk.colour, at, 3.5, step.name, number, priority=2, radius=radius)
    )


def put_arrow(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A vector with its symbol; a very short one without head, named at the end of a leader."""
    tail, tip = desk.field(value.tail), desk.field(value.tip)
    length = hypot(tip[0] - tail[0], tip[1] - tail[1])
    cls = arrow_class(step, desk)
    if length > 0:
        desk.board.marks += arrow(tail, tip, cls, step.name, number)
    if length < TINY:
        note_tiny(desk, symbol(step.says["symbol"]), length)
        return
    name, short = symbol(step.says["symbol"]), length < SHORT
    subject = middle(tail, tip) if short else (tail, tip)
    desk.board.labels.append(
        Label(name, cls, subject, 2.5, step.name, number, priority=1, led=short)
    )


def middle(tail: XY, tip: XY) -> XY:
    """The middle of a vector."""
    return (tail[0] + tip[0]) / 2, (tail[1] + tip[1]) / 2


def note_tiny(desk: Desk, name: str, length: float) -> None:
    """Name a vector that is too short to be seen at the foot of its field."""
    drawn = desk.drawing.words.fixed(length, 2)
    note = desk.drawing.words("page.tiny", name=name, length=drawn)
    if note not in desk.board.notes:
        desk.board.notes.append(note)


def arrow_class(step: Step, desk: Desk) -> str:
    """The look of a vector: normal and tangential components, relative and absolute ones."""
    kind = {"ν": "normal", "τ": "tangential"}.get(step.says.get("kind", ""))
    if kind:
        return kind
    relative = len(step.says["symbol"].partition("_")[2]) > 1 and step.name[0] != desk.drawing.pole
    starts_at_pole = step.name.startswith(desk.drawing.pole) or step.plane is Plane.MECHANISM
    return f"relative-{desk.colour}" if relative and not starts_at_pole else desk.colour


# --- the right triangle on the mechanism ---------------------------------------------------------


def put_triangle_velocity(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The relative velocity set at its pin, and b″ at its tip."""
    if is_tiny(desk, step, value):
        return
    tail, tip = desk.field(desk.drawing.positions[step.says["q"]]), desk.field(value)
    name = "v_" + step.says["i"]
    desk.board.marks += arrow(tail, tip, "relative-velocity", name, number)
    desk.board.labels.append(
        Label(symbol(name), "relative-velocity", (tail, tip), 2.5, name, number)
    )
    put_construction_point(desk, number, step, value)


def is_tiny(desk: Desk, step: Step, tip: complex) -> bool:
    """True when a right triangle is too small to be seen: its velocity is hardly any."""
    return abs(tip - desk.drawing.positions[step.says["q"]]) * desk.field.mm < TINY


def put_triangle_edge(desk: Desk, number: int, step: Step, value: Any) -> None:
    """From the pivot to b″, and at b″ square to it as far as the bar's line."""
    if is_tiny(desk, step, value.point):
        return
    pivot = desk.field(desk.drawing.positions[step.says["p"]])
    corner = desk.field(value.point)
    desk.board.marks.append(Line(*pivot, *corner, "construction", step.name, number))
    ends = line_ends(desk, number, value)
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "construction", step.name, number))
    back = hypot(pivot[0] - corner[0], pivot[1] - corner[1])
    if back > 6:
        first = ((pivot[0] - corner[0]) / back, (pivot[1] - corner[1]) / back)
        second = desk.field.way(value.along)
        low, high = desk.layout.spans[number]
        if -low > high:
            second = (-second[0], -second[1])
        desk.board.marks.append(square_mark(corner, first, second, number))


def put_bar_line(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The bar produced beyond its pin, as far as the right triangle needs it."""
    low, high = desk.layout.spans[number]
    if high - low < 2 * BEYOND + TINY:
        return
    ends = line_ends(desk, number, value)
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "construction", step.name, number))


def put_turned(desk: Desk, number: int, step: Step, value: Any) -> None:
    """b‴ turned over into b⁗, and the normal component from the pin to b⁗."""
    pin = desk.drawing.positions[step.says["q"]]
    at, end = desk.field(pin), desk.field(value)
    radius = hypot(end[0] - at[0], end[1] - at[1])
    name = f"a_{step.says['i']}^ν"
    if radius > SHORT:
        way = bearing((end[0] - at[0], end[1] - at[1]))
        half = min(degrees(SWEEP / radius / 2), 60.0)
        span = (way - half, way + half)
        desk.board.marks.append(Arc(*at, radius, *span, "compass", step.name, number))
    if radius > 0:
        desk.board.marks += arrow(at, end, "normal", name, number)
    if radius < TINY:
        note_tiny(desk, symbol(name), radius)
        return
    short = radius < SHORT
    subject = middle(at, end) if short else (at, end)
    desk.board.labels.append(Label(symbol(name), "normal", subject, 2.5, name, number, led=short))
    put_construction_point(desk, number, step, value)


def put_construction_point(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A small named point of the right triangle, unless it falls on its pin."""
    at = desk.field(value)
    if abs(value - desk.drawing.positions[step.says["q"]]) * desk.field.mm < TINY:
        return
    name = short_name(desk, step)
    desk.board.marks.append(Circle(*at, 0.5, "point construction", step.name, number))
    desk.board.labels.append(
        Label(symbol(name), "construction", at, 1.8, step.name, number, radius=0.5)
    )


def short_name(desk: Desk, step: Step) -> str:
    """The name of a triangle's point, its index left out where its pin has only one triangle."""
    base = step.name.partition("_")[0]
    same = [
        other
        for _, other, _ in desk.drawing.steps(Plane.MECHANISM)
        if other.part is Part.NORMAL and other.name.partition("_")[0] == base
    ]
    return base if len(same) == 1 else step.name


# --- poles and centres ---------------------------------------------------------------------------


def put_centre(desk: Desk, number: int, step: Step, value: Any) -> None:
    """An instantaneous centre or acceleration pole; one off its field by its way and distance."""
    point = place_of(value) if isinstance(value, Ratio) else value
    if point is not None and desk.field.holds(point, 2.0):
        at = desk.field(point)
        x, y = at
        desk.board.marks += (
            Circle(x, y, 1.3, f"centre {desk.colour}", step.name, number),
            Line(x - 2.2, y, x + 2.2, y, f"centre {desk.colour}", step.name, number),
            Line(x, y - 2.2, x, y + 2.2, f"centre {desk.colour}", step.name, number),
        )
        desk.board.labels.append(
            Label(
                symbol(step.name), desk.colour, at, 3.5, step.name, number, priority=2, radius=2.2
            )
        )
        return
    put_far_centre(desk, number, step, value)


def put_far_centre(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A centre off the field: name, direction and distance where a ray to it leaves the field."""
    endless = abs(value.size) * ENDLESS <= abs(value.shift) * desk.field.mm
    if step.part is Part.POLE and endless:
        words = desk.drawing.words
        name, link = symbol(step.name), step.says["k"]
        desk.board.notes.append(words("page.pole_at_infinity", name=name, k=link))
        return
    way = value.shift / value.size if value.size else value.shift
    if way == 0:
        return
    start, (u, v) = desk.field(value.start), desk.field.way(way)
    part = clipped(start, (start[0] + FAR * u, start[1] + FAR * v), above_foot(desk.field.rect))
    if part is None:
        return
    desk.board.marks.append(head(*part, desk.colour, step.name, number))
    if step.by_hand not in desk.drawing.trace.values:
        desk.board.marks.append(Line(*part[0], *part[1], "ray", step.name, number))
    text = far_words(desk, step, 0.0 if endless else abs(way), way)
    end = part[1]
    subject = ((end[0] - LAST * u, end[1] - LAST * v), end)
    desk.board.labels.append(Label(text, desk.colour, subject, 2.5, step.name, number, priority=2))


def far_words(desk: Desk, step: Step, distance: float, way: complex) -> str:
    """Words for where a centre lies that is not on the sheet; at infinity for distance nought."""
    words = desk.drawing.words
    angle = words.fixed(degrees(phase(way)) % 360, 1)
    fields = {"name": symbol(step.name), "p": symbol(step.says["p"]), "angle": angle}
    if not distance:
        return words("page.centre_at_infinity", **fields)
    fields["unit"] = desk.drawing.scene.units["length"]
    away = words.significant(desk.drawing.length(distance), 4)
    return words("page.far_centre", distance=away, **fields)


def above_foot(rect: Rect) -> Rect:
    """A field without its lowest part, which is for notes."""
    return rect[0] + 1, rect[1] + 1, rect[2] - 1, rect[3] - FOOT


def put_ray(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A ray that finds a centre or a pole."""
    ends = line_ends(desk, number, value)
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "ray", line_name(step), number))


def put_driver_ray(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The line at the driver's angle; guides are drawn with their symbols."""
    if "g" not in step.says:
        put_line(desk, number, step, value)


def put_crossing(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A crossing on the mechanism: b‴ of a triangle; the others have their own marks."""
    if step.part is Part.NORMAL:
        put_construction_point(desk, number, step, value)


PUTS: dict[
    tuple[Plane, str], Put
] = {  # the look of each action on the mechanism, and on a plan (NUMBERS)
    (Plane.MECHANISM, "meet"): put_crossing,
    (Plane.MECHANISM, "compass"): put_arc,
    (Plane.MECHANISM, "ray"): put_driver_ray,
    (Plane.MECHANISM, "set-velocity"): put_triangle_velocity,
    (Plane.MECHANISM, "square-at"): put_triangle_edge,
    (Plane.MECHANISM, "bar-line"): put_bar_line,
    (Plane.MECHANISM, "turn-over"): put_turned,
    (Plane.MECHANISM, "set-on"): put_arrow,
    (Plane.MECHANISM, "set-on-twice"): put_arrow,
    (Plane.MECHANISM, "velocity-normal"): put_ray,
    (Plane.MECHANISM, "pole-ray"): put_ray,
    (Plane.MECHANISM, "instant-centre"): put_centre,
    (Plane.MECHANISM, "acceleration-pole"): put_centre,
    (Plane.NUMBERS, "pole"): put_pole,
    (Plane.NUMBERS, "square-to"): put_line,
    (Plane.NUMBERS, "parallel-to"): put_line,
    (Plane.NUMBERS, "join"): put_arrow,
    (Plane.NUMBERS, "turned-velocity"): put_point,
    (Plane.NUMBERS, "meet"): put_point,
    (Plane.NUMBERS, "similar-point"): put_point,
    (Plane.NUMBERS, "centripetal"): put_point,
    (Plane.NUMBERS, "driven-tangential"): put_point,
}
