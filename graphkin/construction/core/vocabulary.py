"""The actions of every plan that can be drawn on paper, for any kind of number and any picture."""

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
from graphkin.numbers.plane import Line, Vector, crossing_sine, dot, line_meets_line


class Action(Struct, frozen=True):
    """One drawing action: the key of its sentence, its value, and the margin of a crossing.

    An action that can fail has ``reaches``, factors of a smooth function of its inputs; all of them
    are positive where the action succeeds. ``move`` is how a student draws it on a page; None for
    an action that comes along by itself.
    """

    key: str
    value: Callable[..., Any]
    margin: Callable[..., Real] | None = None
    reaches: Callable[..., tuple[Real, ...]] | None = None
    move: Move | None = None

    def __call__(self, *args: Any) -> Any:
        """The value of the action for given inputs."""
        return self.value(*args)


def action(
    key: str,
    margin: Callable[..., Real] | None = None,
    reaches: Callable[..., tuple[Real, ...]] | None = None,
    move: Move | None = None,
) -> Callable[..., Action]:
    """Make an action from a function, under the key of its sentence."""
    return lambda value: Action(key, value, margin, reaches, move)


# --- the mechanism, by compass and ruler ---------------------------------------------------------


@action("ray")
def ray(start: Point, direction: Point) -> Line:
    """The line from a point in a given direction."""
    return Line(start, direction)


@action("across")
def across(first: Point, point: Point) -> Real:
    """The distance of a block's point to the left of the line of the block's first point."""
    return (point - first).imag


@action("distance")
def distance(p: Point, q: Point) -> Real:
    """The distance of two points."""
    return abs(q - p)


@action("coordinate")
def coordinate(line: Line, point: Point) -> Real:
    """The coordinate of a point along a guide, from the guide's origin."""
    return dot(line.along, point - line.point) / abs(line.along)


@action("part-along")
def part_along(line: Line, o: Point, image: Point) -> Real:
    """The signed length of a vector of a plan along a guide."""
    return dot(line.along, image - o) / abs(line.along)


# --- the shape of a link, in its own axes --------------------------------------------------------


@action("in-proportion")
def in_proportion(base: Point, end: Point, point: Point) -> Point:
    """The ratio (C - A)/(B - A): the place of a point in the similar figures built on AB."""
    return (point - base) / (end - base)


@action("similar-point", move=Move(SIMILAR, images_and_place, in_plan=True))
def similar_point(base: Point, end: Point, ratio: Point) -> Point:
    """The third point of a figure similar to the link, on an existing base.

    Mehmke's similarity theorem; error at most 8·eps·(abs c + abs(b - a)·AC/AB), also for collinear
    points.
    """
    return base + (end - base) * ratio


@action("set-way")
def set_way(point: Point, tail: Point, tip: Point, seconds: Real) -> Point:
    """The tip of a velocity set at a point of the mechanism: its displacement in ``seconds``."""
    return point + (tip - tail) * seconds


@action("perpendicular-at")
def perpendicular_at(corner: Point, other: Point) -> Line:
    """The perpendicular at a point to the line from it to another point."""
    return Line(corner, 1j * (corner - other))


# --- the plans -----------------------------------------------------------------------------------


@action("pole")
def pole() -> Point:
    """The pole of a plan: the image of everything at rest."""
    return 0j


@action("along-bar", move=Move(PARALLEL, point_and_bar, in_plan=True))
def along_bar(start: Point, p: Point, q: Point) -> Line:
    """The parallel to a bar through a point."""
    return Line(start, q - p)


@action("meet", margin=crossing_sine, move=CUTS)
def meet(m: Line, n: Line) -> Point:
    """The point where two lines meet."""
    return line_meets_line(m, n)


@action("sum")
def sum_of(a: Real, b: Real) -> Real:
    """The rate of a link against the frame, from its rate against a link that turns too."""
    return a + b


@action("difference")
def difference(a: Real, b: Real) -> Real:
    """The difference of two numbers; of rates, the rate of the link against which another turns."""
    return a - b


@action("product")
def product(a: Real, b: Real) -> Real:
    """The product of two numbers."""
    return a * b


@action("speed-at-rim")
def speed_at_rim(rate: Real, radius: Real) -> Real:
    """The speed of a wheel's centre along the tangent that its rim follows, from its rate."""
    return -rate * radius


@action("lay-off", move=LAYS_OFF)
def lay_off(start: Point, vector: Point) -> Point:
    """The end of a vector laid off from a point."""
    return start + vector


@action("lay-back", move=LAYS_OFF)
def lay_back(start: Point, vector: Point) -> Point:
    """The start of a vector that ends at a point: laid off from that point against its sense."""
    return start - vector


@action("join")
def join(tail: Point, tip: Point) -> Vector:
    """The arrow from one point of a plan to another."""
    return Vector(tail, tip)
