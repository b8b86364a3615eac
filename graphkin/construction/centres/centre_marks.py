"""The marks of instantaneous centres, acceleration poles and inflection circles, near and far."""

from __future__ import annotations

from cmath import phase
from math import degrees
from typing import Any

from graphkin.construction.centres.centre_words import same_centre
from graphkin.construction.centres.parallel_velocities import put_tips
from graphkin.construction.core.curve_marks import clipped_path, ring
from graphkin.construction.core.plan_marks import line_name, name_point
from graphkin.construction.core.plot import Plot, above_foot, line_ends
from graphkin.construction.core.program import Part, Step
from graphkin.construction.core.too_short import TINY
from graphkin.drawing.field import clipped
from graphkin.drawing.label import Label
from graphkin.drawing.marks import CircleMark, LineMark
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import FIXED, head

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


def put_centre(plot: Plot, number: int, step: Step, value: Any) -> None:
    """An instantaneous centre or acceleration pole; one off its field by its way and distance.

    The crossing that only leads to one is marked with it, under its name.
    """
    if not step.name:
        return
    put_tips(plot, number, step)
    point = plot.drawing.place(value)
    if point is not None and plot.field.holds(point, 2.0):
        at = plot.field(point)
        (x, y), cls = at, f"centre {plot.colour}"
        radius = RING if is_under_pin(plot, point) else SMALL
        plot.board.marks += (
            CircleMark(x, y, radius, cls, step.name, number),
            LineMark(x - ARM, y, x + ARM, y, cls, step.name, number),
            LineMark(x, y - ARM, x, y + ARM, cls, step.name, number),
        )
        name_point(plot, number, step, at, ARM)
        return
    put_far_centre(plot, number, step, value)


def is_under_pin(plot: Plot, point: complex) -> bool:
    """Whether the pin of a point covers the middle of a centre."""
    places = plot.drawing.positions.values()
    return any(abs(place - point) * plot.field.mm < FIXED for place in places)


def put_named_centre(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A centre in a pin: a ring around it, and its name beside it."""
    at = plot.field(value.start)
    plot.board.marks.append(CircleMark(*at, RING, f"centre {plot.colour}", step.name, number))
    name_point(plot, number, step, at, RING)


def put_circle_point(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A point of the inflection circle on a ray, where the field has it."""
    if plot.field.holds(value, 2.0):
        at = plot.field(value)
        plot.board.marks.append(CircleMark(*at, 0.5, "point construction", step.name, number))
        name_point(plot, number, step, at, 0.5)


def put_inflection_circle(plot: Plot, number: int, step: Step, value: Any) -> None:
    """The inflection circle, as much of it as lies in the field."""
    if not TINY < value.radius * plot.field.mm < STRAIGHT:
        return
    around = [plot.field(point) for point in ring(value, plot.field.mm)]
    cls = f"inflection {plot.colour}"
    for mark in clipped_path(around, above_foot(plot.field.rect), cls, step.name, number):
        plot.board.marks.append(mark)


def put_far_centre(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A centre off the field: name, direction and distance where a ray to it leaves the field.

    Nothing where every point is one: the sentence of the link says so.
    """
    if plot.drawing.is_everywhere(value):
        return
    endless = plot.drawing.place(value) is None
    if step.part is Part.POLE and endless:
        words = plot.drawing.words
        name, link = symbol(step.name), step.says["k"]
        plot.board.notes.append(words("page.pole_at_infinity", name=name, k=link))
        return
    way = value.shift / value.size if value.size else value.shift
    if way == 0:
        return
    if step.action is not None and step.action.key == "inflection-pole":
        plot.board.notes.append(far_words(plot, step, 0.0 if endless else abs(way), way))
        return
    same = same_centre(plot.drawing, step)
    start, (u, v) = plot.field(value.start), plot.field.way(way)
    part = clipped(start, (start[0] + FAR * u, start[1] + FAR * v), above_foot(plot.field.rect))
    if part is None:
        return
    if same is None:
        plot.board.marks.append(head(*part, plot.colour, step.name, number))
    if step.by_hand not in plot.drawing.trace.values or "aside" in step.says:
        plot.board.marks.append(LineMark(*part[0], *part[1], "ray", step.name, number))
    if same is None:
        text = far_words(plot, step, 0.0 if endless else abs(way), way)
    else:
        text = f"{symbol(step.name)} = {symbol(same.name)}"
    end = part[1]
    subject = ((end[0] - LAST * u, end[1] - LAST * v), end)
    plot.board.labels.append(Label(text, plot.colour, subject, 2.5, step.name, number, priority=2))


def far_words(plot: Plot, step: Step, distance: float, way: complex) -> str:
    """Words for where a centre lies that is not on the sheet; at infinity for distance nought."""
    words = plot.drawing.words
    angle = words.fixed(degrees(phase(way)) % 360, 1)
    fields = {"name": symbol(step.name), "p": symbol(step.says["p"]), "angle": angle}
    if not distance:
        return words("page.centre_at_infinity", **fields)
    fields["unit"] = plot.drawing.scene.units["length"]
    away = words.significant(plot.drawing.length(distance), 4)
    return words("page.far_centre", distance=away, **fields)


def put_ray(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A ray that finds a centre or a pole."""
    ends = line_ends(plot, number, value)
    if ends:
        plot.board.marks.append(LineMark(*ends[0], *ends[1], "ray", line_name(step), number))
