"""Lines through the image of a known point on which the image of another point lies.

The line is perpendicular to a bar, which keeps its length, or parallel to a guide, along which the
slide moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import LaidOff, component_ending_at, end_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import FindsImage, Run, construction
from graphkin.construction.core.naming import letter_at
from graphkin.construction.core.palette import (
    PARALLEL,
    PERPENDICULAR,
    KnownError,
    Move,
    Picks,
    point_and_bar,
    two,
)
from graphkin.construction.core.pen import Pen, against, image, letter
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import action
from graphkin.construction.velocity.relative_motion import AboutPivot, AlongGuide
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line
from graphkin.structure.pairs import is_in_scene


@action("square-to", move=Move(PERPENDICULAR, point_and_bar))
def square_to(start: Point, p: Point, q: Point) -> Line:
    """The perpendicular to a bar through a point."""
    return Line(start, 1j * (q - p))


class PerpendicularThrough(AboutPivot, frozen=True, kw_only=True):
    """The ``line`` through the image ``start`` of a pivot on which the image of a pin lies.

    If the pivot is a contact point, ``touch`` is the name of its image.
    """

    gives: ClassVar[tuple[str, ...]] = ("line",)
    reasons: ClassVar[Mapping[str, str]] = {"line": "why.perpendicular"}
    lines: ClassVar[Mapping[str, str]] = {"line": "⊥ {p}{q}"}
    lines_before: ClassVar[tuple[str, ...]] = ("start",)
    along_bar: ClassVar[str] = "turn.wrong.along_bar"

    start: int
    line: int
    touch: str = ""

    @property
    def runs(self) -> Run:
        """Perpendicular to the bar."""
        return Run(self.p + self.q, square=True)

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason: a bar keeps its length; a pivot at rest has the pole as image."""
        at_rest = self.index == self.whole and not self.touch
        return "why.perpendicular_at_rest" if at_rest else super().reason(drawing, role)

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause with the point that the line passes through; contact points share one."""
        start = drawing.trace.program.steps[self.start].name
        key = "square-to"
        if self.touch:
            key = "square-to-both" if self.touch == start else "square-to-touch"
        fields = {"s": drawing.symbol(start), "c": symbol(self.touch), **self.symbols()}
        return drawing.words(f"step.{key}", **fields)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line, labelled with the bar to which it is perpendicular."""
        canvas.locus(f"⊥{self.runs.what}", f"⊥ {self.bar}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem."""
        yield self.euler(drawing)

    def errors(self, picks: Picks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line along the bar, and one from the pole, as if the moving pivot were at rest."""
        start, square = point_and_bar(picks, self.line, steps[self.line].args)
        yield KnownError(self.along_bar, self.line, PARALLEL, (start, square))
        yield KnownError(
            "turn.wrong.pole", self.line, PERPENDICULAR, (picks.pole_of(self.line), square)
        )


def perpendicular_through(pen: Pen, pivot: str, pin: str) -> int:
    """The perpendicular to a bar through the velocity image of one of its ends."""
    start, p, q = pen.the("velocity", pivot), letter(pivot), letter(pin)
    ends = pen.the("position", pivot), pen.the("position", pin)
    line = pen.draw(square_to, start, *ends)
    index, touch = q + ("" if p in pen.scene.frame.points else p), ""
    if not is_in_scene(pivot):
        index, touch = against(pen, pin, pivot), image(pivot)
    names = {"p": p, "q": q, "index": index, "whole": q, "base": p}
    pen.make(PerpendicularThrough(**names, start=start, line=line, touch=touch))
    return line


def forgotten(picks: Picks, steps: Sequence[Step], number: int) -> tuple[str, str | None] | None:
    """The component that ends at a step as one left out: its key, and the point before it."""
    laid = construction(steps[number])
    if not isinstance(laid, LaidOff) or not laid.component.forgotten:
        return None
    return laid.component.forgotten, picks.point_or_line(laid.start)


@action("parallel-to", move=Move(PARALLEL, two, in_plan=True))
def parallel_to(start: Point, line: Line) -> Line:
    """The parallel to a line, such as a guide, through a point."""
    return Line(start, line.along)


class ParallelThrough(AlongGuide, frozen=True, kw_only=True):
    """The ``line`` on which the image of a point that slides on a guide lies."""

    gives: ClassVar[tuple[str, ...]] = ("line",)
    lines: ClassVar[Mapping[str, str]] = {"line": "∥ guide {guide}"}
    lines_before: ClassVar[tuple[str, ...]] = ("start",)
    guided: ClassVar[str] = "guide"

    line: int

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason: relative to its guide, a block only moves along the guide."""
        velocity = drawing.trace.program.steps[self.line].plane is Plane.VELOCITIES
        return "why.along" if velocity else "why.along_acceleration"

    def symbols(self) -> Mapping[str, str]:
        """The guide by its block."""
        return {"g": escape(self.guide)}

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause with the point through which the line passes, or the end of a component."""
        steps, start = drawing.trace.program.steps, end_before(drawing, self.start)
        letter, key = letter_at(drawing, start), "parallel-to"
        if letter and not steps[start].name:
            key = "parallel-to-foot"
        elif not letter:
            laid = component_ending_at(drawing.trace.program, start)
            back = laid is not None and laid.back
            key = "parallel-to-tail" if back else "parallel-to-end"
        fields = {"guide": self.way(drawing), "vector": self.vector_along(drawing, self.line)}
        return drawing.words(f"step.{key}", s=drawing.symbol(letter), **fields)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line, labelled with the guide to which it is parallel."""
        canvas.locus(f"∥{self.guide}", f"∥ {self.way(canvas.drawing)}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The motion along the guide of the point that is found on the line."""
        if sought := self.found_on_it(drawing):
            yield self.motion_of(drawing, sought)

    def errors(self, picks: Picks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line across the guide, and one without the known component."""
        inputs = start, guide = two(picks, self.line, steps[self.line].args)
        yield KnownError("turn.wrong.across_guide", self.line, PERPENDICULAR, inputs)
        if before := forgotten(picks, steps, self.start):
            key, start = before
            yield KnownError(key, self.line, PARALLEL, (start, guide))

    def found_on_it(self, drawing: Drawing) -> str:
        """The point whose image is found on the line; empty where there is none."""
        steps = drawing.trace.program.steps
        for child in drawing.children.get(self.line, ()):
            user = steps[drawing.results.get(child, child)]
            kind = construction(user)
            if found := kind.sought if isinstance(kind, FindsImage) else "":
                return found
        return ""


def parallel_through(pen: Pen, start: int, along: int, guide: str) -> int:
    """The parallel to a line of the mechanism, such as a guide, through a point of a plan."""
    line = pen.draw(parallel_to, start, along)
    pen.make(ParallelThrough(guide=guide, start=start, line=line))
    return line
