"""A force whose line of action is known: its size by moments about a point.

The force of a cam acts along the common normal. The force in an outer pin of a group of class III
acts along its bar, once the part across the bar is known; moments are taken about the point in
which the lines of two other bars meet (Assur's point).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import action, meet
from graphkin.construction.forces.loads import force_amount, newtons
from graphkin.construction.forces.moments import (
    SEEN,
    Moments,
    arm,
    line_arm,
    moment_sum,
    of_moments,
)
from graphkin.construction.forces.polygon import SideDirection, links_words
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line, cross, crossing_sine

LETTERS = ("W", "Z", "N", "W0", "Z0", "N0")
"""The names of Assur's point, the first of which is free."""


@action("foot-on-line")
def foot_on_line(point: Point, line: Line) -> Point:
    """The foot of the perpendicular from a point to a line."""
    return arm.value(point, line.point, line.along)


@action("line-force")
def line_force(about: Point, foot: Point, line: Line, *rest: Any) -> Point:
    """The force along a line that balances the moments about a point with its foot on the line."""
    unit = line.along / abs(line.along)
    return -moment_sum(about, rest) / cross(foot - about, unit) * unit


class LineForce(Construction, frozen=True, kw_only=True):
    """The force ``name`` on some ``links`` along a line, with its arm and the arm's symbol.

    ``way`` is the line in words; ``through`` is a point on it at which the force acts. ``cam`` says
    that the line is the common normal of a cam and its follower.
    """

    gives: ClassVar[tuple[str, ...]] = ("foot", "force")
    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_line"}

    name: str
    number: str
    links: tuple[str, ...]
    way: SideDirection
    cam: bool
    moments: Moments
    through: int
    foot: int
    force: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line as far as the foot, and the arm with its dimension."""
        if role != "foot":
            return
        about, through, end = map(canvas.value, (self.moments.about, self.through, self.foot))
        if canvas.size(end - about) <= SEEN or not canvas.holds(about):
            return
        line_arm(canvas, (self.name, self.number), about, through, end)

    def symbols(self) -> Mapping[str, str]:
        """The point about which the moments are taken."""
        return {"b": symbol(self.moments.letter)}

    def size(self, drawing: Drawing) -> float:
        """The magnitude of the force in N; zero for rounding."""
        return drawing.settled(abs(drawing.trace.values[self.force]))

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The moment equation, and the size of the force."""
        if role != "force":
            return ""
        size = self.size(drawing)
        key = "step.force-normal" if self.cam else "step.force-line"
        return drawing.words(
            key if size else "step.force-line-none",
            k=links_words(drawing, self.links),
            b=symbol(self.moments.letter),
            r=symbol(self.name),
            way=self.way.words(drawing),
            h=symbol(self.number),
            below=self.below(drawing),
            sum=self.moments.positive(drawing),
            size=newtons(drawing, size),
            drawn=force_amount(drawing, size),
        )

    def below(self, drawing: Drawing) -> str:
        """The arm in symbols; in metres where there are couples."""
        below: str = symbol(self.number)
        return f"({below}·*k*_L)" if self.moments.in_metres(drawing) else below

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The sum of moments divided by the arm."""
        size, values = self.size(drawing), drawing.trace.values
        if role != "force" or not size:
            return
        put = figure(drawing, drawing.on_paper(abs(values[self.foot] - values[self.moments.about])))
        if self.moments.in_metres(drawing):
            put = f"({put}·{figure(drawing, drawing.scales.kL / 1000)})"
        yield of_moments(
            (symbol(self.name), answer(drawing, size), "N"),
            symbol(self.moments.letter),
            (self.moments.positive(drawing), self.moments.positive(drawing, figures=True)),
            (self.below(drawing), put),
            by=symbol(self.number),
        )


class AssurPoint(Construction, frozen=True, kw_only=True):
    """The point of a group of class III in which the lines of two of its arms meet."""

    gives: ClassVar[tuple[str, ...]] = ("point",)

    one: int
    other: int
    starts: tuple[int, int]
    point: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw both lines as far as the point."""
        point = canvas.value(self.point)
        if canvas.holds(point):
            for start in self.starts:
                canvas.leg("", "ray", canvas.value(start), point)
            canvas.image()


def in_order(pen: Pen, lines: Sequence[int]) -> tuple[int, int, int]:
    """The numbers of three lines, first the two that cross at the largest angle in the scene."""
    shown = [pen.peek(line) for line in lines]
    if any(line is None for line in shown):
        return 0, 1, 2
    both = max(combinations(range(3), 2), key=lambda e: crossing_sine(shown[e[0]], shown[e[1]]))
    (last,) = {0, 1, 2} - {*both}
    return both[0], both[1], last


def meeting(pen: Pen, one: int, other: int, starts: tuple[int, int]) -> int:
    """The point in which the lines of two arms meet."""
    name = next(letter for letter in LETTERS if letter not in pen.scene.points)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        point = pen.draw(meet, one, other, name=name)
    return pen.make(AssurPoint(one=one, other=other, starts=starts, point=point)).point


def along_line(
    pen: Pen,
    name: str,
    number: str,
    links: tuple[str, ...],
    line: int,
    through: int,
    moments: Moments,
    way: SideDirection,
    *,
    cam: bool = False,
) -> int:
    """The force along the step of a line that balances moments; its step."""
    with pen.on(Part.FORCE, Plane.MECHANISM):
        end = pen.draw(foot_on_line, moments.about, line)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        inputs = moments.about, end, line
        force = pen.draw(line_force, *inputs, *moments.steps, extra=moments.extra)
    found = LineForce(
        name=name,
        number=number,
        links=links,
        way=way,
        cam=cam,
        moments=moments,
        through=through,
        foot=end,
        force=force,
    )
    return pen.make(found).force
