"""What a trial plan misses at the link or driver that comes last, and how it is measured.

The gap lies across the line on which the plan's point should be: perpendicular to the bar that
closes the group, or parallel to its guide. Of a driver it is what the plan has less what is given.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import component_of, index_before, laid_off
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.layout import BEYOND
from graphkin.construction.core.naming import scale_of, way_of
from graphkin.construction.core.relation import FINE, Relation, answer, figure, within
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.style import CHAIN_LINES, OWN_LINES
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real, larger, smaller
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.model import Driver


@action("lacks")
def lacks(p: Point, q: Point, image_p: Point, image_q: Point, wanted: Point) -> Real:
    """What a bar's trial images miss along the bar."""
    bar = q - p
    return dot(bar, image_q - image_p - wanted) / abs(bar)


@action("lacks")
def lacks_across(line: Line, start: Point, image: Point) -> Real:
    """What a sliding point's trial image misses across its guide."""
    return cross(line.along, image - start) / abs(line.along)


class Misclosure(Construction, frozen=True, kw_only=True):
    """The gap of a trial plan: the step of its ``size``, positive to one side.

    It is drawn unless a crossing tells how the right plan divides, at the step ``settled``.
    """

    gives: ClassVar[tuple[str, ...]] = ("size",)

    size: int
    settled: int | None = None

    def amount(self, drawing: Drawing) -> float:
        """Its size in the unit of the plan."""
        return float(drawing.settled(drawing.trace.values[self.size]))

    def point(self, drawing: Drawing) -> str:
        """Markup of the point, or the vector of the plan, at which it is measured."""
        raise NotImplementedError

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The key of the words for the line from which it is measured, and what fills them."""
        return "given", {}

    def line(self, drawing: Drawing) -> str:
        """The line on which the plan's point should be."""
        key, fields = self.fields(drawing)
        return drawing.words(f"step.gap-{key}", **fields)

    def relation(self, drawing: Drawing, name: str) -> Relation:
        """The gap as it is read off the plan."""
        scale = scale_of(drawing, drawing.plane) / 1000
        size, (key, fields) = self.amount(drawing), self.fields(drawing)
        figures = f"{figure(drawing, scale)}·{within(drawing, size / scale)}"
        remark = drawing.words(f"calculation.gap-{key}", one=self.point(drawing), **fields)
        unit = drawing.vector.caret_unit
        return Relation(name, "", figures, answer(drawing, size), unit, remark)

    def draw_gap(self, canvas: Canvas, foot: Any, start: Any, tip: Any, across: Any) -> None:
        """What is laid off, the line from its end on which the point should be, the way to it."""
        end, along = tip - across * canvas.value(self.size), 1j * across
        reach, beyond = dot(along, end - start), BEYOND / 2 / canvas.mm
        low, high = smaller(reach, 0.0) - beyond, larger(reach, 0.0) + beyond
        canvas.leg("laid off", OWN_LINES, foot, start)
        canvas.stretch("locus of a trial", OWN_LINES, start, along, low, high)
        canvas.leg("gap", CHAIN_LINES, tip, end)

    def is_measured(self, drawing: Drawing) -> bool:
        """Whether it is drawn, and measured on a sheet."""
        return self.settled not in drawing.trace.values

    def reason(self, drawing: Drawing, role: str) -> str:
        """Why it is measured."""
        return "why.gaps" if self.is_measured(drawing) else ""


class DrawnMisclosure(Misclosure, frozen=True, kw_only=True):
    """A gap in the plan, at the image ``tip`` of the point that is found last."""

    tip: int

    def point(self, drawing: Drawing) -> str:
        """Its letter."""
        return drawing.lettered(self.tip)

    def marks(self, canvas: Canvas, role: str) -> None:
        """The gap, where no crossing settles it."""
        if self.is_measured(canvas.drawing):
            self.draw(canvas)

    @abstractmethod
    def draw(self, canvas: Canvas) -> None:
        """Draw it."""


class LineMisclosure(DrawnMisclosure, frozen=True, kw_only=True):
    """The gap across a ``line`` on which the image should lie: that through an image ``start``."""

    along: int
    start: int

    def draw(self, canvas: Canvas) -> None:
        """From the line to the point."""
        along, start, tip = map(canvas.value, (self.along, self.start, self.tip))
        self.draw_gap(canvas, start, start, tip, 1j * along.along / abs(along.along))


class BarMisclosure(DrawnMisclosure, frozen=True, kw_only=True):
    """The gap along a bar between the images of its ends, ``wanted`` what is known along it."""

    p: int
    q: int
    foot: int
    wanted: int

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """Perpendicular to the bar, from the end of the component that is known."""
        steps = drawing.trace.program.steps
        p, q = steps[self.p].name, steps[self.q].name
        fields = {"bar": bar(p, q), "s": drawing.lettered(self.foot), "p": symbol(p)}
        component = component_of(drawing.trace.program, self.wanted)
        if component is None:
            return "square", fields
        return "square-end", {**fields, "a": component.symbol}

    def draw(self, canvas: Canvas) -> None:
        """From the end of what is known to the point."""
        ends = (self.p, self.q, self.foot, self.tip, self.wanted)
        p, q, foot, tip, wanted = map(canvas.value, ends)
        self.draw_gap(canvas, foot, foot + wanted, tip, (q - p) / abs(q - p))


class GuideMisclosure(LineMisclosure, frozen=True, kw_only=True):
    """The gap across the guide of a ``block``, of the image of its point from what is known."""

    block: str

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """Parallel to the guide, from the end of what is laid off."""
        fields = {"guide": way_of(drawing, self.block)}
        program = drawing.trace.program
        laid = laid_off(program, self.start)
        if laid is None:
            return "parallel", {**fields, "s": symbol(program.steps[self.start].name)}
        fields |= {"a": laid.component.symbol, "s": symbol(program.steps[laid.start].name)}
        return "parallel-end", fields


class DrivenMisclosure(Misclosure, frozen=True, kw_only=True):
    """What a plan has too much of a driver's given rate: the step that has it, ``found``.

    Of a sliding driver ``start`` and ``tip`` are the images between which it is measured.
    """

    driver: Driver
    found: int
    start: int | None = None
    tip: int | None = None

    def is_measured(self, drawing: Drawing) -> bool:
        """It is computed."""
        return False

    def has(self, drawing: Drawing) -> float:
        """What the plan has of it."""
        return float(drawing.trace.values[self.found])

    def point(self, drawing: Drawing) -> str:
        """The vector along the guide; nothing for a driver that turns."""
        if self.start is None or self.tip is None:
            return ""
        program = drawing.trace.program
        start, tip = program.steps[self.start], program.steps[self.tip]
        if not start.name:
            return symbol(f"a_{index_before(program, self.start)}^r")
        return symbol(start.name) + symbol(tip.name)

    def relation(self, drawing: Drawing, name: str) -> Relation:
        """What the plan has, less what is given."""
        found, size = self.has(drawing), self.amount(drawing)
        turns = self.driver.kind == "turn"
        if turns:
            figures, unit, remark = figure(drawing, found, FINE), drawing.rate.caret_unit, ""
        else:
            scale = scale_of(drawing, drawing.plane) / 1000
            figures = f"{figure(drawing, scale)}·{within(drawing, found / scale)}"
            unit, point = drawing.vector.caret_unit, self.point(drawing)
            remark = drawing.words("calculation.gap-given", one=point)
        figures += f" − {within(drawing, found - size)}"
        return Relation(name, "", figures, answer(drawing, size), unit, remark, turns=turns)
