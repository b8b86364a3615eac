"""The arc that a compass draws about one end of a bar: its other end lies on it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import drawn_amount
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Circle

if TYPE_CHECKING:
    from graphkin.construction.core.canvas import Canvas
    from graphkin.construction.core.drawn_scene import Drawing


@action("compass")
def compass(centre: Point, radius: Real) -> Circle:
    """The circle about a point with a given opening of the compass."""
    return Circle(centre, radius)


class CompassArc(Construction, frozen=True, kw_only=True):
    """The ``arc`` of a ``radius`` about the point ``centre``, on which a ``point`` lies."""

    gives: ClassVar[tuple[str, ...]] = ("arc",)
    lines: ClassVar[Mapping[str, str]] = {"arc": "the arc {centre}{point} about {centre}"}

    centre: str
    point: str
    radius: int
    arc: int

    @property
    def points(self) -> tuple[str, ...]:
        """Both ends of the bar."""
        return self.centre, self.point

    def laid_length(self, role: str) -> tuple[str, str]:
        """The opening of the compass."""
        return self.centre, self.point

    def marks(self, canvas: Canvas, role: str) -> None:
        """As much of the arc as finds the point."""
        canvas.arc(self.centre + self.point)

    def clause(self, drawing: Drawing, role: str) -> str:
        """By the bar."""
        opening = stated_bar(drawing, (self.centre, self.point), self.radius)
        return drawing.words("step.compass", p=symbol(self.centre), bar=opening)


def stated_bar(drawing: Drawing, ends: tuple[str, str], length: int) -> str:
    """A bar whose ``length`` the scene states; where it does not, with that on paper, in mm."""
    name = bar(*ends)
    if drawing.trace.program.steps[length].given is None:
        name += f" ({drawn_amount(drawing, float(drawing.trace.values[length]))})"
    return name


def draw_arc(pen: Pen, ends: tuple[str, str], centre: int, radius: int) -> int:
    """The arc about the first of two points on which the second lies."""
    arc = pen.draw(compass, centre, radius)
    pen.make(CompassArc(centre=ends[0], point=ends[1], radius=radius, arc=arc))
    return arc
