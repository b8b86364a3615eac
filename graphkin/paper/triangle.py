"""The marks of the right triangle that gives a normal component on the mechanism."""

from __future__ import annotations

from math import degrees, hypot
from typing import Any

from graphkin.paper.desk import TINY, Desk, line_ends, middle
from graphkin.paper.labels import Label
from graphkin.paper.layout import BEYOND, SWEEP
from graphkin.paper.letters import letter_on, no_triangle
from graphkin.paper.marks import Arc, Circle, Line
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import SHORT, arrow, bearing, square_mark
from graphkin.steps.program import Part, Step


def put_triangle_velocity(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The relative velocity set at its pin, and b″ at its tip."""
    if no_triangle(desk.drawing, step, desk.field.mm):
        return
    pin = desk.drawing.standing.spot(step.says["q"])
    set_vector(desk, number, "v_" + step.says["v"], pin, value)
    put_construction_point(desk, number, step, value)


def set_vector(
    desk: Desk, number: int, name: str, start: complex, end: complex, look: str = ""
) -> None:
    """A vector set on the mechanism, with its symbol."""
    tail, tip, look = desk.field(start), desk.field(end), look or "relative-velocity"
    desk.board.marks += arrow(tail, tip, look, name, number)
    short = hypot(tip[0] - tail[0], tip[1] - tail[1]) < SHORT
    subject = middle(tail, tip) if short else (tail, tip)
    desk.board.labels.append(
        Label(symbol(name), look, subject, 2.5, name, number, led=short, spare=True)
    )


def put_triangle_edge(desk: Desk, number: int, step: Step, value: Any) -> None:
    """From the pivot to b″, and at b″ square to it as far as the bar's line."""
    if no_triangle(desk.drawing, step, desk.field.mm):
        return
    pivot = desk.field(desk.drawing.standing.spot(step.says["p"]))
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
    hidden = no_triangle(desk.drawing, step, desk.field.mm)
    if hidden or high - low < 2 * BEYOND + TINY:
        return
    ends = line_ends(desk, number, value)
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "construction", step.name, number))


def put_turned(desk: Desk, number: int, step: Step, value: Any) -> None:
    """b‴ turned over into b⁗, and the normal component from the pin to b⁗."""
    if no_triangle(desk.drawing, step, desk.field.mm):
        return
    pin = desk.drawing.standing.spot(step.says["q"])
    at, end = desk.field(pin), desk.field(value)
    radius = hypot(end[0] - at[0], end[1] - at[1])
    name = f"a_{step.says['i']}^ν"
    if radius > SHORT:
        way = bearing((end[0] - at[0], end[1] - at[1]))
        half = min(degrees(SWEEP / radius / 2), 60.0)
        span = (way - half, way + half)
        desk.board.marks.append(Arc(*at, radius, *span, "compass", step.name, number))
    desk.board.marks += arrow(at, end, "normal", name, number)
    short = radius < SHORT
    subject = middle(at, end) if short else (at, end)
    desk.board.labels.append(
        Label(symbol(name), "normal", subject, 2.5, name, number, led=short, spare=True)
    )
    put_construction_point(desk, number, step, value)


def put_crossing(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A crossing on the mechanism: b‴ of a triangle; the others have their own marks."""
    if step.part is Part.NORMAL:
        put_construction_point(desk, number, step, value)


def put_construction_point(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A small named point of the right triangle."""
    if no_triangle(desk.drawing, step, desk.field.mm):
        return
    at = desk.field(value)
    name = letter_on(desk.drawing, step, desk.field.mm)
    desk.board.marks.append(Circle(*at, 0.5, "point construction", step.name, number))
    desk.board.labels.append(
        Label(symbol(name), "construction", at, 2.5, step.name, number, radius=0.5)
    )
