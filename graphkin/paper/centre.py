"""The marks of instantaneous centres, acceleration poles and inflection circles, near and far."""

from __future__ import annotations

from cmath import phase
from math import degrees
from typing import Any

from graphkin.paper.centre_words import same_centre
from graphkin.paper.desk import TINY, Desk, above_foot, line_ends
from graphkin.paper.field import clipped
from graphkin.paper.labels import Label
from graphkin.paper.marks import Circle, Line
from graphkin.paper.paths import clipped_path, ring
from graphkin.paper.plan import line_name, name_point
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import FIXED, head
from graphkin.paper.tips import put_tips
from graphkin.steps.program import Part, Step

LAST = 20.0
"""How much of a ray to a far centre its name belongs to, in mm."""
SMALL, ARM = 1.3, 2.2
"""Radius of the circle of a centre, and how far its cross reaches, in mm."""
RING = 1.9
"""The same radius around a pin that is a centre, in mm."""
STRAIGHT = 1e6
"""Radius in mm of a circle that is a straight line, or none at all, on any page."""
FAR = 2000.0
"""Longer than any way on a page, in mm."""


def put_centre(desk: Desk, number: int, step: Step, value: Any) -> None:
    """An instantaneous centre or acceleration pole; one off its field by its way and distance.

    The crossing that only leads to one is marked with it, under its name.
    """
    if not step.name:
        return
    put_tips(desk, number, step)
    point = desk.drawing.place(value)
    if point is not None and desk.field.holds(point, 2.0):
        at = desk.field(point)
        (x, y), cls = at, f"centre {desk.colour}"
        radius = RING if is_under_pin(desk, point) else SMALL
        desk.board.marks += (
            Circle(x, y, radius, cls, step.name, number),
            Line(x - ARM, y, x + ARM, y, cls, step.name, number),
            Line(x, y - ARM, x, y + ARM, cls, step.name, number),
        )
        name_point(desk, number, step, at, ARM)
        return
    put_far_centre(desk, number, step, value)


def is_under_pin(desk: Desk, point: complex) -> bool:
    """Whether the pin of a point covers the middle of a centre."""
    places = desk.drawing.positions.values()
    return any(abs(place - point) * desk.field.mm < FIXED for place in places)


def put_named_centre(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A centre in a pin: a ring around it, and its name beside it."""
    at = desk.field(value.start)
    desk.board.marks.append(Circle(*at, RING, f"centre {desk.colour}", step.name, number))
    name_point(desk, number, step, at, RING)


def put_circle_point(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A point of the inflection circle on a ray, where the field has it."""
    if desk.field.holds(value, 2.0):
        at = desk.field(value)
        desk.board.marks.append(Circle(*at, 0.5, "point construction", step.name, number))
        name_point(desk, number, step, at, 0.5)


def put_inflection_circle(desk: Desk, number: int, step: Step, value: Any) -> None:
    """The inflection circle, as much of it as lies in the field."""
    if not TINY < value.radius * desk.field.mm < STRAIGHT:
        return
    around = [desk.field(point) for point in ring(value, desk.field.mm)]
    cls = f"inflection {desk.colour}"
    for mark in clipped_path(around, above_foot(desk.field.rect), cls, step.name, number):
        desk.board.marks.append(mark)


def put_far_centre(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A centre off the field: name, direction and distance where a ray to it leaves the field.

    Nothing where every point is one: the sentence of the link says so.
    """
    if desk.drawing.is_everywhere(value):
        return
    endless = desk.drawing.place(value) is None
    if step.part is Part.POLE and endless:
        words = desk.drawing.words
        name, link = symbol(step.name), step.says["k"]
        desk.board.notes.append(words("page.pole_at_infinity", name=name, k=link))
        return
    way = value.shift / value.size if value.size else value.shift
    if way == 0:
        return
    if step.action is not None and step.action.key == "inflection-pole":
        desk.board.notes.append(far_words(desk, step, 0.0 if endless else abs(way), way))
        return
    same = same_centre(desk.drawing, step)
    start, (u, v) = desk.field(value.start), desk.field.way(way)
    part = clipped(start, (start[0] + FAR * u, start[1] + FAR * v), above_foot(desk.field.rect))
    if part is None:
        return
    if same is None:
        desk.board.marks.append(head(*part, desk.colour, step.name, number))
    if step.by_hand not in desk.drawing.trace.values or "aside" in step.says:
        desk.board.marks.append(Line(*part[0], *part[1], "ray", step.name, number))
    if same is None:
        text = far_words(desk, step, 0.0 if endless else abs(way), way)
    else:
        text = f"{symbol(step.name)} = {symbol(same.name)}"
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


def put_ray(desk: Desk, number: int, step: Step, value: Any) -> None:
    """A ray that finds a centre or a pole."""
    ends = line_ends(desk, number, value)
    if ends:
        desk.board.marks.append(Line(*ends[0], *ends[1], "ray", line_name(step), number))
