"""The misclosure of a trial plan at the last link or driver, and how it is measured.

The gap is measured across the line on which the plan's point should lie: perpendicular to the bar
that closes the group, or parallel to its guide. For a driver, the misclosure is the value in the
plan less the given value.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import component_ending_at, component_of, index_before
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
    """The error of a bar's trial images, along the bar."""
    bar = q - p
    return dot(bar, image_q - image_p - wanted) / abs(bar)


@action("lacks")
def lacks_across(line: Line, start: Point, image: Point) -> Real:
    """The error of a sliding point's trial image, across its guide."""
    return cross(line.along, image - start) / abs(line.along)


class Misclosure(Construction, frozen=True, kw_only=True):
    """The gap of a trial plan: the step of its ``size``, positive to one side.

    The gap is drawn unless a crossing, at the step ``settled``, shows how the right plan divides.
    """

    gives: ClassVar[tuple[str, ...]] = ("size",)

    size: int
    settled: int | None = None

    def amount(self, drawing: Drawing) -> float:
        """The size in the unit of the plan."""
        return float(drawing.settled(drawing.trace.values[self.size]))

    def point(self, drawing: Drawing) -> str:
        """Markup of the point, or the vector of the plan, at which the gap is measured."""
        raise NotImplementedError

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The key of the words for the line from which the gap is measured, and their fields."""
        return "given", {}

    def line(self, drawing: Drawing) -> str:
        """The words for the line on which the plan's point should lie."""
        key, fields = self.fields(drawing)
        return drawing.words(f"step.gap-{key}", **fields)

    def relation(self, drawing: Drawing, name: str) -> Relation:
        """The relation for the gap as read from the plan."""
        scale = scale_of(drawing, drawing.plane) / 1000
        size, (key, fields) = self.amount(drawing), self.fields(drawing)
        figures = f"{figure(drawing, scale)}·{within(drawing, size / scale)}"
        remark = drawing.words(f"calculation.gap-{key}", one=self.point(drawing), **fields)
        unit = drawing.vector.caret_unit
        return Relation(name, "", figures, answer(drawing, size), unit, remark)

    def draw_gap(self, canvas: Canvas, foot: Any, start: Any, tip: Any, across: Any) -> None:
        """Draw the part laid off, the line from its end for the point, and the gap."""
        end, along = tip - across * canvas.value(self.size), 1j * across
        reach, beyond = dot(along, end - start), BEYOND / 2 / canvas.mm
        low, high = smaller(reach, 0.0) - beyond, larger(reach, 0.0) + beyond
        canvas.leg("laid off", OWN_LINES, foot, start)
        canvas.stretch("locus of a trial", OWN_LINES, start, along, low, high)
        canvas.leg("gap", CHAIN_LINES, tip, end)

    def is_measured(self, drawing: Drawing) -> bool:
        """Whether the gap is drawn, and measured on a sheet."""
        return self.settled not in drawing.trace.values

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason why the gap is measured."""
        return "why.gaps" if self.is_measured(drawing) else ""


class DrawnMisclosure(Misclosure, frozen=True, kw_only=True):
    """A gap in the plan, at the image ``tip`` of the point that is found last."""

    tip: int

    def point(self, drawing: Drawing) -> str:
        return drawing.lettered(self.tip)

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the gap, where no crossing replaces it."""
        if self.is_measured(canvas.drawing):
            self.draw(canvas)

    @abstractmethod
    def draw(self, canvas: Canvas) -> None:
        """Draw the gap."""


class LineMisclosure(DrawnMisclosure, frozen=True, kw_only=True):
    """The gap across the line ``along`` through the image ``start``, where the image belongs."""

    along: int
    start: int

    def draw(self, canvas: Canvas) -> None:
        """Draw the gap from the line to the point."""
        along, start, tip = map(canvas.value, (self.along, self.start, self.tip))
        self.draw_gap(canvas, start, start, tip, 1j * along.along / abs(along.along))


class BarMisclosure(DrawnMisclosure, frozen=True, kw_only=True):
    """The gap along a bar between the images of its ends; ``wanted`` is the known part along it."""

    p: int
    q: int
    foot: int
    wanted: int

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The line perpendicular to the bar, from the end of the known component."""
        steps = drawing.trace.program.steps
        p, q = steps[self.p].name, steps[self.q].name
        fields = {"bar": bar(p, q), "s": drawing.lettered(self.foot), "p": symbol(p)}
        component = component_of(drawing.trace.program, self.wanted)
        if component is None:
            return "square", fields
        return "square-end", {**fields, "a": component.symbol(drawing)}

    def draw(self, canvas: Canvas) -> None:
        """Draw the gap from the end of the known component to the point."""
        ends = (self.p, self.q, self.foot, self.tip, self.wanted)
        p, q, foot, tip, wanted = map(canvas.value, ends)
        self.draw_gap(canvas, foot, foot + wanted, tip, (q - p) / abs(q - p))


class GuideMisclosure(LineMisclosure, frozen=True, kw_only=True):
    """The gap across the guide of a ``block``, from the known part to the image of its point."""

    block: str

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The line parallel to the guide, from the end of the part laid off."""
        fields = {"guide": way_of(drawing, self.block)}
        program = drawing.trace.program
        laid = component_ending_at(program, self.start)
        if laid is None:
            return "parallel", {**fields, "s": drawing.symbol(program.steps[self.start].name)}
        fields |= {
            "a": laid.component.symbol(drawing),
            "s": drawing.symbol(program.steps[laid.start].name),
        }
        return "parallel-end", fields


class DrivenMisclosure(Misclosure, frozen=True, kw_only=True):
    """The excess of a driver's rate in a plan over the given rate; ``found`` is the rate's step.

    For a sliding driver, the rate is measured between the images ``start`` and ``tip``.
    """

    driver: Driver
    found: int
    start: int | None = None
    tip: int | None = None

    def is_measured(self, drawing: Drawing) -> bool:
        """False: this misclosure is computed."""
        return False

    def has(self, drawing: Drawing) -> float:
        """The driver's rate in the plan."""
        return float(drawing.trace.values[self.found])

    def point(self, drawing: Drawing) -> str:
        """The vector along the guide; empty for a driver that turns."""
        if self.start is None or self.tip is None:
            return ""
        program = drawing.trace.program
        start, tip = program.steps[self.start], program.steps[self.tip]
        if not start.name:
            return drawing.symbol(f"a_{index_before(program, self.start)}^r")
        return drawing.symbol(start.name) + drawing.symbol(tip.name)

    def relation(self, drawing: Drawing, name: str) -> Relation:
        """The relation: the rate in the plan, less the given rate."""
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
