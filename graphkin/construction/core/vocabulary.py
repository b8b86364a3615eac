"""What a hand can draw on paper: every action of every plan, number-blind and picture-blind.

An action knows how its value follows from the values before it and how well it can be drawn (its
margin, the sine of the angle of a crossing). Its ``key`` is the key of its sentence in text/.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from msgspec import Struct

from graphkin.construction.core.palette import (
    CUTS,
    LAYS_OFF,
    PARALLEL,
    SIMILAR,
    Move,
    images_and_place,
    point_and_bar,
)
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import (
    Line,
    Vector,
    crossing_sine,
    dot,
    line_meets_line,
)


class Action(Struct, frozen=True):
    """One thing a hand can do: its sentence's key, its value, and the margin of a crossing.

    What may fail by what it is drawn of has ``reaches``: factors of a smooth function of that, all
    of them positive where it succeeds. ``move`` is how a student draws it on a page; None for what
    comes along by itself.
    """

    key: str
    value: Callable[..., Any]
    margin: Callable[..., Real] | None = None
    reaches: Callable[..., tuple[Real, ...]] | None = None
    move: Move | None = None

    def __call__(self, *args: Any) -> Any:
        """The value of the action on given values."""
        return self.value(*args)


def action(
    key: str,
    margin: Callable[..., Real] | None = None,
    reaches: Callable[..., tuple[Real, ...]] | None = None,
    move: Move | None = None,
) -> Callable[..., Action]:
    """Make an action of a function, under the key of its sentence."""
    return lambda value: Action(key, value, margin, reaches, move)


# --- the mechanism, by compass and ruler ---------------------------------------------------------


@action("ray")
def ray(start: Point, direction: Point) -> Line:
    """The line from a point in a given direction."""
    return Line(start, direction)


@action("across")
def across(first: Point, point: Point) -> Real:
    """How far a point of a block lies to the left of the line that its first point keeps."""
    return (point - first).imag


@action("distance")
def distance(p: Point, q: Point) -> Real:
    """Distance of two points."""
    return abs(q - p)


@action("coordinate")
def coordinate(line: Line, point: Point) -> Real:
    """How far along a guide a point stands, from the guide's own zero."""
    return dot(line.along, point - line.point) / abs(line.along)


@action("part-along")
def part_along(line: Line, o: Point, image: Point) -> Real:
    """The signed length of a vector of a plan along a guide."""
    return dot(line.along, image - o) / abs(line.along)


# --- the shape of a link, in its own axes --------------------------------------------------------


@action("in-proportion")
def in_proportion(base: Point, end: Point, point: Point) -> Point:
    """The ratio (C - A)/(B - A): where a point lies in the similar figures built on AB."""
    return (point - base) / (end - base)


@action("similar-point", move=Move(SIMILAR, images_and_place, in_plan=True))
def similar_point(base: Point, end: Point, ratio: Point) -> Point:
    """The third point of a figure similar to the link, on a base that is already there.

    Mehmke's similarity theorem; error at most 8·eps·(abs c + abs(b - a)·AC/AB), also in line.
    """
    return base + (end - base) * ratio


@action("set-way")
def set_way(point: Point, tail: Point, tip: Point, seconds: Real) -> Point:
    """A velocity of the plan set at a point of the mechanism, as its way in so many ``seconds``."""
    return point + (tip - tail) * seconds


@action("perpendicular-at")
def perpendicular_at(corner: Point, other: Point) -> Line:
    """At a point the perpendicular to the line that joins it with another."""
    return Line(corner, 1j * (corner - other))


# --- the plans -----------------------------------------------------------------------------------


@action("pole")
def pole() -> Point:
    """The pole of a plan: the image of everything that stands still."""
    return 0j


@action("along-bar", move=Move(PARALLEL, point_and_bar, in_plan=True))
def along_bar(start: Point, p: Point, q: Point) -> Line:
    """Through a point the parallel to a bar."""
    return Line(start, q - p)


@action("meet", margin=crossing_sine, move=CUTS)
def meet(m: Line, n: Line) -> Point:
    """Where two lines meet."""
    return line_meets_line(m, n)


@action("sum")
def sum_of(a: Real, b: Real) -> Real:
    """The rate of a link against the frame from its rate against one that turns too."""
    return a + b


@action("difference")
def difference(a: Real, b: Real) -> Real:
    """What a number has too much; of rates, that of the link against which another turns."""
    return a - b


@action("product")
def product(a: Real, b: Real) -> Real:
    """The product of two numbers."""
    return a * b


@action("speed-at-rim")
def speed_at_rim(rate: Real, radius: Real) -> Real:
    """The speed of a wheel's centre along the line that its rim keeps to, as it turns at a rate."""
    return -rate * radius


@action("lay-off", move=LAYS_OFF)
def lay_off(start: Point, vector: Point) -> Point:
    """The end of a vector laid off from a point."""
    return start + vector


@action("lay-back", move=LAYS_OFF)
def lay_back(start: Point, vector: Point) -> Point:
    """The start of a vector whose end is a point: laid off from there against its sense."""
    return start - vector


@action("join")
def join(tail: Point, tip: Point) -> Vector:
    """The arrow from one point of a plan to another."""
    return Vector(tail, tip)
