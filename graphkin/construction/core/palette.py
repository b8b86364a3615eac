"""The palette of a page: the drawing actions for students, and the inputs of each recorded step."""

from __future__ import annotations

from cmath import rect
from collections.abc import Callable, Sequence
from math import isnan, radians, sqrt
from typing import Any, Literal, Protocol

from msgspec import Struct

from graphkin.numbers.plane import Circle, Line, cross, dot, line_meets_line

Slots = tuple[tuple[str, tuple[str, ...]], ...]
"""What an action is drawn from: the word for each thing and the kinds of picks that it may be."""
Shape = Literal["point", "line", "circle", "vector"]
"""The result of an action. A component of an acceleration is a point that lies in no drawing."""
MECHANISM, NUMBERS = 0, 3
"""The drawings of a page that an action may name; 1 and 2 are the plans."""
CURVE = ("locus", "guide", "circle")
FOUND = ("image", "centre")
POINTS = ("point", "image")
WAYS = ("bar", "guide", "locus", "arrow")
"""On a board: the points of every drawing, and all that has a direction."""
SAME = 1e-7
"""The parts of a drawing within which the script takes two values for equal."""


class PaletteAction(Struct, frozen=True):
    """One action of the palette, with its function in the script of the page.

    ``script`` takes the keys of the picks and returns a list of results, one of which is meant. The
    result has the given ``shape``. It lies in the drawing number ``plane``; where that is None, in
    the drawing of the input number ``lies_with``. ``named`` says that the script makes the name of
    the result from the names of the inputs. ``said_as`` is the action whose error messages this one
    shares. ``typed`` are the signs and ASCII words by which it is written on the keyboard.

    On the board of a task page the same action is drawn from the ``free`` kinds of things, by
    default those of ``slots``. ``draw`` computes there what ``script`` does; an action without it
    is not on the board.
    """

    key: str
    slots: Slots
    script: str
    shape: Shape = "point"
    plane: int | None = None
    lies_with: int = 0
    named: bool = False
    said_as: str = ""
    typed: tuple[str, ...] = ()
    free: Slots = ()
    draw: Callable[..., Sequence[Any]] | None = None


class DrawnThings(Protocol):
    """What is drawn on a board, by the keys of its picks; the numbers of ``script`` in Python."""

    def value_of(self, key: str) -> Any:
        """A point, line, circle, vector, length, angle in degrees or rate."""

    def way(self, key: str) -> complex:
        """The direction of a bar, a vector or a line."""

    def arm(self, point: str, bar: str) -> complex | None:
        """The vector along a bar from its other end to a point at one end; None elsewhere."""

    def reach(self, length: str, at: str) -> float:
        """A length in the drawing of another pick; typed lengths are millimetres of paper."""

    def places_of(self, image: str) -> Sequence[complex]:
        """The points of the mechanism whose image a pick is."""

    def ends_of(self, bar: str) -> tuple[complex, complex]:
        """The two ends of a bar."""


def curves_meet(m: Line | Circle, n: Line | Circle) -> list[complex]:
    """The crossings of two lines or circles, in the order of the page's script."""
    if isinstance(m, Line):
        if isinstance(n, Line):
            return [line_meets_line(m, n)] if cross(m.along, n.along) else []
        unit = m.along / abs(m.along)
        gap = (n.centre - m.point) * unit.conjugate()
        square = (n.radius - gap.imag) * (n.radius + gap.imag)
        half = sqrt(square) if square >= 0 else float("nan")
        start, ends = m.point, [(gap.real + step) * unit for step in (half, -half)]
    elif isinstance(n, Line):
        return curves_meet(n, m)
    else:
        axis = n.centre - m.centre
        size = abs(axis)
        if not size:
            return []
        along = ((m.radius - n.radius) * (m.radius + n.radius) / size + size) / 2
        square = (m.radius - along) * (m.radius + along)
        half = sqrt(square) if square >= 0 else float("nan")
        start, ends = m.centre, [complex(along, side) * (axis / size) for side in (half, -half)]
    return [] if isnan(half) else [start + end for end in ends]


def similar_images(things: DrawnThings, i: str, j: str, point: str) -> list[complex]:
    """The third corner of the figures on two images that are similar to those of the mechanism."""
    base = things.value_of(j) - things.value_of(i)
    return [
        things.value_of(i) + base * (things.value_of(point) - p) / (q - p)
        for p in things.places_of(i)
        for q in things.places_of(j)
        if q != p
    ]


def divided_alike(things: DrawnThings, p: str, q: str, m: str, n: str, point: str) -> list[complex]:
    """The point that divides the line of two points as another point divides a second line."""
    start, first = things.value_of(p), things.value_of(m)
    line, part = things.value_of(n) - first, things.value_of(point) - first
    return (
        [start + (things.value_of(q) - start) * dot(part, line) / dot(line, line)] if line else []
    )


def pole_on(things: DrawnThings, bar: str, i: str, j: str) -> list[complex]:
    """The points of rest of a link whose bar has two images, the ends taken either way."""
    p, q = things.ends_of(bar)
    image, other = things.value_of(i), things.value_of(j)
    return [one + (two - one) * -image / (other - image) for one, two in ((p, q), (q, p))]


def normal_towards(things: DrawnThings, point: str, bar: str, velocity: str) -> list[complex]:
    """v²/l of a point at the end of a bar, towards its other end; v is perpendicular to the bar."""
    reach, speed = things.arm(point, bar), things.value_of(velocity)
    if not reach or abs(dot(reach, speed)) > SAME * abs(reach) * abs(speed):
        return []
    return [reach * (-dot(speed, speed) / dot(reach, reach))]


class ErrorPicks(Protocol):
    """The things that known errors start from, by the steps that they lie on; None for others."""

    def point_or_line(self, number: int) -> str | None:
        """A point, line or arc."""

    def bar(self, p: int, q: int) -> str | None:
        """The bar between two points of the mechanism."""

    def pole_of(self, number: int) -> str | None:
        """The pole of the plan in which a step lies."""


class Picks(ErrorPicks, Protocol):
    """The things that can be picked on a page, by the steps that they lie on; None for others."""

    def arrow(self, tail: int, tip: int, name: str = "") -> str | None:
        """The vector between two points of a plan."""

    def rate(self, number: int) -> str | None:
        """The angular velocity of a link."""

    def length(self, number: int, length: int) -> str | None:
        """The length of a step that is laid off at another step."""

    def vector(self, number: int) -> str | None:
        """The vector that a step lays off; None for one without length."""

    def shown_vector(self, number: int) -> str | None:
        """The vector of a plan that a step sets on the mechanism."""

    def place_of(self, image: int) -> str | None:
        """The point of the mechanism whose image a step is."""

    def pole_of(self, number: int) -> str | None:
        """The pole of the plan in which a step lies."""


Picked = tuple[str | None, ...]


class Move(Struct, frozen=True):
    """How a student draws what a step records: the action, and its inputs among the picks.

    ``inputs`` takes the picks, the number of the step and the steps that it is drawn from. A move
    that is ``in_plan`` exists only in a plan of velocities or accelerations. A move ``at_once``
    draws its step together with the lines by which it is found on paper.
    """

    action: PaletteAction
    inputs: Callable[[Picks, int, tuple[int, ...]], Picked]
    in_plan: bool = False
    at_once: bool = False


class KnownError(Struct, frozen=True):
    """A wrong move that students make in place of the move that draws the step ``line``.

    ``key`` is that of the sentence that answers it. It is the ``action`` with its
    ``inputs`` among the picks; an error with an input that cannot be picked is left out.
    """

    key: str
    line: int
    action: PaletteAction
    inputs: Picked


PERPENDICULAR = PaletteAction(
    "perpendicular",
    (("through", ("point", "image")), ("square", ("bar", "arrow", "guide"))),
    "(p, to) => [[value_of(p), quarter(way(to))]]",
    "line",
    named=True,
    typed=("⊥", "perp", "_"),
    free=(("through", POINTS), ("square", WAYS)),
    draw=lambda things, p, to: [Line(things.value_of(p), 1j * things.way(to))],
)
PARALLEL = PaletteAction(
    "parallel",
    (("through", ("image",)), ("along", ("guide", "bar"))),
    "(p, to) => [[value_of(p), way(to)]]",
    "line",
    named=True,
    typed=("∥", "par", "//"),
    free=(("through", POINTS), ("along", WAYS)),
    draw=lambda things, p, to: [Line(things.value_of(p), things.way(to))],
)
RAY = PaletteAction(
    "ray",
    (("through", POINTS), ("angle", ("angle",))),
    """(p, angle) => {
      const turned = value_of(angle) * Math.PI / 180;
      return [[value_of(p), [Math.cos(turned), Math.sin(turned)]]];
    }""",
    "line",
    named=True,
    typed=("∠", "ray"),
    draw=lambda things, p, angle: [
        Line(things.value_of(p), rect(1, radians(things.value_of(angle))))
    ],
)
CUT = PaletteAction(
    "cut",
    (("line", CURVE), ("and", CURVE)),
    "(m, n) => m === n ? [] : cuts(value_of(m), value_of(n))",
    typed=("×", "cut", "x"),
    draw=lambda things, m, n: [] if m == n else curves_meet(things.value_of(m), things.value_of(n)),
)
SET_OFF = PaletteAction(
    "set_off",
    (("from", POINTS), ("on", ("locus", "guide")), ("length", ("length",))),
    """(p, on, length) => [1, -1].map(side =>
      plus(value_of(p), scaled(way(on), side * reach(length, p) / long(way(on)))))""",
    typed=("↦", "off"),
    draw=lambda things, p, on, length: [
        things.value_of(p) + things.way(on) * side * things.reach(length, p) / abs(things.way(on))
        for side in (1, -1)
    ],
)
LAY_OFF = PaletteAction(
    "lay_off",
    (("from", ("image",)), ("vector", ("vector",))),
    "(p, v) => [plus(value_of(p), value_of(v)), minus(value_of(p), value_of(v))]",
    typed=("→", "lay", "+"),
    draw=lambda things, p, v: [
        things.value_of(p) + things.value_of(v),
        things.value_of(p) - things.value_of(v),
    ],
)
COMPASS = PaletteAction(
    "compass",
    (("about", ("point",)), ("opening", ("length",))),
    "(p, opening) => [{ c: value_of(p), r: reach(opening, p) }]",
    "circle",
    named=True,
    typed=("arc",),
    free=(("about", POINTS), ("opening", ("length",))),
    draw=lambda things, p, opening: [Circle(things.value_of(p), things.reach(opening, p))],
)
MARK_OFF = PaletteAction(
    "mark_off",
    (("on", ("guide",)), ("length", ("length",))),
    """(line, length) => {
      const [point, along] = value_of(line);
      return [plus(point, scaled(along, value_of(length) / long(along)))];
    }""",
    typed=("len",),
)
SIMILAR = PaletteAction(
    "similar",
    (("image", ("image",)), ("and", ("image",)), ("point", ("point",))),
    """(i, j, point) => places_of(i).flatMap(p =>
      places_of(j).filter(q => long(minus(q, p))).map(q => plus(value_of(i), times(
        minus(value_of(j), value_of(i)), over(minus(value_of(point), p), minus(q, p))))))""",
    typed=("∼", "sim", "~"),
    draw=similar_images,
)
COINCIDE = PaletteAction(
    "coincide",
    (("point", ("point",)), ("image", ("image",))),
    "(point, image) => [value_of(image)]",
    lies_with=1,
    typed=("≡", "falls"),
)
JOIN = PaletteAction(
    "join",
    (("point", FOUND), ("and", FOUND)),
    "(p, q) => p === q ? [] : [[value_of(p), minus(value_of(q), value_of(p))]]",
    "line",
    named=True,
    typed=("join",),
    free=(("point", POINTS), ("and", POINTS)),
    draw=lambda things, p, q: (
        [] if p == q else [Line(things.value_of(p), things.value_of(q) - things.value_of(p))]
    ),
)
DIVIDE = PaletteAction(
    "divide",
    (("image", ("image",)), ("and", ("image",))),
    """(p, q, m, n, point) => {
      const part = end => minus(value_of(end), value_of(m)), parts = m
        ? [dot(part(point), part(n)) / dot(part(n), part(n))]
        : shares.filter(([plane,, needs]) => plane === picks[p].plane && all_done(needs))
          .map(([, share]) => share);
      return parts.map(one => plus(value_of(p), scaled(minus(value_of(q), value_of(p)), one)));
    }""",
    typed=("div",),
    free=(("from", POINTS), ("and", POINTS), ("as", POINTS), ("and", POINTS), ("and", POINTS)),
    draw=divided_alike,
)
POLE = PaletteAction(
    "pole",
    (("on", ("bar",)), ("image", ("image",)), ("and", ("image",))),
    """(bar, i, j) => [picks[bar].on, [...picks[bar].on].reverse()].map(ends => {
      const [p, q] = ends.map(value_of), image = value_of(i);
      return plus(p, times(minus(q, p), over(scaled(image, -1), minus(value_of(j), image))));
    })""",
    plane=MECHANISM,
    typed=("pole",),
    draw=pole_on,
)
TRANSFER = PaletteAction(
    "transfer",
    (("vector", ("arrow",)), ("at", ("point",))),
    """(arrow, point) => {
      const shrunk = seconds ** picks[arrow].plane;
      return [[value_of(point), plus(value_of(point), scaled(value_of(arrow), shrunk))]];
    }""",
    "vector",
    plane=MECHANISM,
    named=True,
    typed=("set", "@"),
)


def two(picks: ErrorPicks, number: int, args: tuple[int, ...]) -> Picked:
    """The first two inputs of a step."""
    return picks.point_or_line(args[0]), picks.point_or_line(args[1])


def point_and_bar(picks: ErrorPicks, number: int, args: tuple[int, ...]) -> Picked:
    """A point, and the bar between two other points."""
    return picks.point_or_line(args[0]), picks.bar(args[1], args[2])


def point_and_arrow(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """A point, and the vector between two images."""
    return picks.point_or_line(args[0]), picks.arrow(args[1], args[2])


def one_and_length(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """A point or line, and a length to be laid off."""
    return picks.point_or_line(args[0]), picks.length(number, args[1])


def start_and_vector(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """The point from which a vector is laid off, and the vector."""
    return picks.point_or_line(args[0]), picks.vector(number)


def images_and_place(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """Two images, and the point of the mechanism whose image is found."""
    return *two(picks, number, args), picks.place_of(number)


def place_and_image(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """A point of the mechanism, and the image with which its own coincides."""
    return picks.place_of(number), picks.point_or_line(args[0])


def bar_and_images(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """The bar of two points, and their images."""
    _, p, q, *images = args
    return picks.bar(p, q), *map(picks.point_or_line, images)


def vector_at_point(picks: Picks, number: int, args: tuple[int, ...]) -> Picked:
    """A vector of a plan, and the point of the mechanism at which it is set."""
    return picks.shown_vector(number), picks.point_or_line(args[0])


CUTS = Move(CUT, two)
LAYS_OFF = Move(LAY_OFF, start_and_vector, in_plan=True)
