"""Through the image of one end of a bar the perpendicular to it: the bar keeps its length."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.pen import Pen, against, image, letter
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import action
from graphkin.construction.velocity.about_pivot import AboutPivot
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line
from graphkin.structure.pairs import is_in_scene

if TYPE_CHECKING:
    from graphkin.construction.core.canvas import Canvas
    from graphkin.construction.core.drawn_scene import Drawing


@action("square-to")
def square_to(start: Point, p: Point, q: Point) -> Line:
    """Through a point the perpendicular to a bar."""
    return Line(start, 1j * (q - p))


class PerpendicularThrough(AboutPivot, frozen=True, kw_only=True):
    """The ``line`` through the image ``start`` of a pivot on which that of a pin must lie.

    Where the pivot is a point where links touch, ``touch`` is the name of its image.
    """

    gives: ClassVar[tuple[str, ...]] = ("line",)
    reasons: ClassVar[Mapping[str, str]] = {"line": "why.perpendicular"}
    lines: ClassVar[Mapping[str, str]] = {"line": "⊥ {p}{q}"}

    start: int
    line: int
    touch: str = ""

    @property
    def perpendicular_to(self) -> str:
        """The bar."""
        return self.p + self.q

    def reason(self, drawing: Drawing, role: str) -> str:
        """That the bar keeps its length; of a pivot at rest, that its image is the pole."""
        at_rest = self.index == self.whole and not self.touch
        return "why.perpendicular_at_rest" if at_rest else super().reason(drawing, role)

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """What ends where it begins."""
        return (self.start,)

    def clause(self, drawing: Drawing, role: str) -> str:
        """Through which point it is drawn; both points where links touch have one image."""
        start = drawing.trace.program.steps[self.start].name
        key = "square-to"
        if self.touch:
            key = "square-to-both" if self.touch == start else "square-to-touch"
        fields = {"s": symbol(start), "c": symbol(self.touch), **self.symbols()}
        return drawing.words(f"step.{key}", **fields)

    def marks(self, canvas: Canvas, role: str) -> None:
        """The line, with the bar to which it is perpendicular."""
        canvas.locus(f"⊥{self.perpendicular_to}", f"⊥ {self.bar}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem."""
        yield self.euler(drawing)


def perpendicular_through(pen: Pen, pivot: str, pin: str) -> int:
    """Through the velocity image of one end of a bar the perpendicular to the bar."""
    start, p, q = pen.the("velocity", pivot), letter(pivot), letter(pin)
    ends = pen.the("position", pivot), pen.the("position", pin)
    line = pen.draw(square_to, start, *ends)
    index, touch = q + ("" if p in pen.scene.frame.points else p), ""
    if not is_in_scene(pivot):
        index, touch = against(pen, pin, pivot), image(pivot)
    names = {"p": p, "q": q, "index": index, "whole": q, "base": p}
    pen.make(PerpendicularThrough(**names, start=start, line=line, touch=touch))
    return line
