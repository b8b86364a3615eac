"""How paper draws the steps of constructions: each mark at once, in millimetres of its field."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, hypot
from typing import Any

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.layout import BEYOND, SWEEP
from graphkin.construction.core.plot import Plot, line_ends, middle
from graphkin.construction.core.program import Step
from graphkin.construction.core.too_short import TINY
from graphkin.drawing.field import XY
from graphkin.drawing.label import Label
from graphkin.drawing.marks import Arc, CircleMark, LineMark
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import SHORT, arrow, bearing, square_mark

SIDE = 6.0
"""Shortest side of a triangle, in mm, at whose corner a right angle is marked."""
LEG = "leg"
"""The part of a step's marks that is a line between two points, not the step's own line."""


def draw_part(plot: Plot, number: int, step: Step, kind: Construction) -> None:
    """Draw the step of a construction, unless the construction is too small for it."""
    if not kind.is_hidden(plot.drawing):
        kind.marks(PaperCanvas(plot, number), step.role)


@dataclass(frozen=True)
class PaperCanvas:
    """The marks of one step on a field of a sheet."""

    plot: Plot
    number: int

    @property
    def drawing(self) -> Drawing:
        """The sheet."""
        return self.plot.drawing

    @property
    def step(self) -> Step:
        """The step."""
        return self.drawing.trace.program.steps[self.number]

    def value(self, number: int) -> Any:
        """The value of a step."""
        return self.drawing.trace.values[number]

    def size(self, way: Any) -> Any:
        """How long a way of the mechanism is drawn, in mm."""
        return abs(way) * self.plot.field.mm

    def vector(self, name: str, look: str, tail: Any, tip: Any) -> None:
        """A vector set on the mechanism, with its symbol."""
        start, end = self.plot.field(tail), self.plot.field(tip)
        self.plot.board.marks += arrow(start, end, look, name, self.number)
        short = hypot(end[0] - start[0], end[1] - start[1]) < SHORT
        subject = middle(start, end) if short else (start, end)
        self.plot.board.labels.append(
            Label(symbol(name), look, subject, 2.5, name, self.number, led=short, spare=True)
        )

    def point(self, name: str, at: Any) -> None:
        """A small named point."""
        place, own = self.plot.field(at), self.step.name
        self.plot.board.marks.append(
            CircleMark(*place, 0.5, "point construction", own, self.number)
        )
        self.plot.board.labels.append(
            Label(symbol(name), "construction", place, 2.5, own, self.number, radius=0.5)
        )

    def segment(self, start: Any, end: Any) -> None:
        """A thin line between two points."""
        self.thin(self.plot.field(start), self.plot.field(end), LEG)

    def line(self) -> bool:
        """The step's own line as far as the layout says."""
        ends = line_ends(self.plot, self.number, self.value(self.number))
        if ends:
            self.thin(*ends)
        return ends is not None

    def line_beyond(self) -> None:
        """The same, where it leads farther than its own two points."""
        low, high = self.plot.layout.spans[self.number]
        if high - low >= 2 * BEYOND + TINY:
            self.line()

    def thin(self, start: XY, end: XY, part: str = "") -> None:
        """A construction line."""
        marks = self.plot.board.marks
        marks.append(LineMark(*start, *end, "construction", self.step.name, self.number, part))

    def right_angle(self, toward: Any) -> None:
        """The mark of a right angle where the step's line begins, if there is room for it."""
        line = self.value(self.number)
        corner, other = self.plot.field(line.point), self.plot.field(toward)
        back = hypot(other[0] - corner[0], other[1] - corner[1])
        if back > SIDE:
            first = ((other[0] - corner[0]) / back, (other[1] - corner[1]) / back)
            u, v = self.plot.field.way(line.along)
            low, high = self.plot.layout.spans[self.number]
            second = (-u, -v) if -low > high else (u, v)
            self.plot.board.marks.append(square_mark(corner, first, second, self.number))

    def swing(self, centre: Any, end: Any) -> None:
        """The arc by which a point was carried about a centre; none about a near one."""
        at, tip = self.plot.field(centre), self.plot.field(end)
        radius = hypot(tip[0] - at[0], tip[1] - at[1])
        if radius > SHORT:
            way = bearing((tip[0] - at[0], tip[1] - at[1]))
            half = min(degrees(SWEEP / radius / 2), 60.0)
            span = (way - half, way + half)
            marks = self.plot.board.marks
            marks.append(Arc(*at, radius, *span, "compass", self.step.name, self.number))
