"""What a hand can draw on paper: every action of every plan, number-blind and picture-blind.

An action knows how its value follows from the values before it and how well it can be drawn (its
margin, the sine of the angle of a crossing). Its ``key`` is the key of its sentence in text/.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import (
    Line,
    Vector,
    cross,
    crossing_sine,
    dot,
    line_meets_line,
)


@dataclass(frozen=True, slots=True)
class Action:
    """One thing a hand can do: its sentence's key, its value, and the margin of a crossing."""

    key: str
    value: Callable[..., Any]
    margin: Callable[..., Real] | None = None

    def __call__(self, *args: Any) -> Any:
        """The value of the action on given values."""
        return self.value(*args)


def action(key: str, margin: Callable[..., Real] | None = None) -> Callable[..., Action]:
    """Make an action of a function, under the key of its sentence."""
    return lambda value: Action(key, value, margin)


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


@action("similar-point")
def similar_point(base: Point, end: Point, ratio: Point) -> Point:
    """The third point of a figure similar to the link, on a base that is already there.

    Mehmke's similarity theorem; error at most 8·eps·(abs c + abs(b - a)·AC/AB), also in line.
    """
    return base + (end - base) * ratio


# --- the plans -----------------------------------------------------------------------------------


@action("pole")
def pole() -> Point:
    """The pole of a plan: the image of everything that stands still."""
    return 0j


@action("alike")
def alike(image: Point) -> Point:
    """The image of a point that moves as another does: a block does not turn."""
    return image


@action("turned-velocity")
def turned_velocity(start: Point, pivot: Point, pin: Point, omega: Real) -> Point:
    """Image of a pin turning about a pivot: omega times the bar, turned a quarter (Galileo)."""
    return start + 1j * (pin - pivot) * omega


@action("square-to")
def square_to(start: Point, p: Point, q: Point) -> Line:
    """Through a point the perpendicular to a bar."""
    return Line(start, 1j * (q - p))


@action("along-bar")
def along_bar(start: Point, p: Point, q: Point) -> Line:
    """Through a point the parallel to a bar."""
    return Line(start, q - p)


@action("parallel-to")
def parallel_to(start: Point, line: Line) -> Line:
    """Through a point the parallel to a line, such as a guide."""
    return Line(start, line.along)


@action("meet", margin=crossing_sine)
def meet(m: Line, n: Line) -> Point:
    """Where two lines meet."""
    return line_meets_line(m, n)


@action("sum")
def sum_of(a: Real, b: Real) -> Real:
    """The rate of a link against the frame from its rate against one that turns too."""
    return a + b


@action("difference")
def difference(a: Real, b: Real) -> Real:
    """The rate of the link against which another turns at a given rate."""
    return a - b


@action("omega")
def omega(p: Point, q: Point, image_p: Point, image_q: Point) -> Real:
    """Angular velocity of a link from the relative velocity of two of its points."""
    bar = q - p
    return cross(bar, image_q - image_p) / dot(bar, bar)


@action("centripetal")
def centripetal(start: Point, pivot: Point, pin: Point, omega: Real) -> Point:
    """End of the normal component of a driven bar: omega squared times the bar, pin to pivot."""
    return start + omega * omega * (pivot - pin)


@action("driven-tangential")
def driven_tangential(start: Point, pivot: Point, pin: Point, epsilon: Real) -> Point:
    """End of the tangential component of a driven bar: epsilon times the bar, turned a quarter."""
    return start + 1j * (pin - pivot) * epsilon


@action("lay-off")
def lay_off(start: Point, vector: Point) -> Point:
    """The end of a vector laid off from a point."""
    return start + vector


@action("epsilon")
def epsilon(p: Point, q: Point, image_p: Point, image_q: Point) -> Real:
    """Angular acceleration from the tangential part of a relative acceleration, with its sense."""
    bar = q - p
    return cross(bar, image_q - image_p) / dot(bar, bar)


@action("join")
def join(tail: Point, tip: Point) -> Vector:
    """The arrow from one point of a plan to another."""
    return Vector(tail, tip)


@action("set-on")
def set_on(point: Point, o: Point, image: Point, seconds: Real) -> Vector:
    """A velocity of the plan set on the mechanism at its point."""
    return Vector(point, point + (image - o) * seconds)


@action("set-on-twice")
def set_on_twice(point: Point, o: Point, image: Point, seconds: Real) -> Vector:
    """An acceleration of the plan set on the mechanism at its point."""
    return Vector(point, point + (image - o) * (seconds * seconds))


# --- the right triangle on the mechanism (lab, figure 4) -----------------------------------------


@action("set-velocity")
def set_velocity(pin: Point, image_pivot: Point, image_pin: Point, seconds: Real) -> Point:
    """The relative velocity set at the pin of the bar; ``seconds`` is kL/kv, the plan's scale."""
    return pin + (image_pin - image_pivot) * seconds


@action("square-at")
def square_at(corner: Point, pivot: Point) -> Line:
    """At the tip of the velocity the perpendicular to the line that joins it with the pivot."""
    return Line(corner, 1j * (corner - pivot))
