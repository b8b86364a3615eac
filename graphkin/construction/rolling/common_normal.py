"""The common normal of a contact: along it alone rolling points may be accelerated apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import along_bar
from graphkin.drawing.symbol_markup import bar, symbol

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing


class CommonNormal(Construction, frozen=True, kw_only=True):
    """The ``line`` through the image ``start`` of one point of contact, for that of the other.

    It is parallel to the radius from ``p`` to ``q``, for links that are ``belted`` to the line of
    their centres.
    """

    gives: ClassVar[tuple[str, ...]] = ("line",)
    reasons: ClassVar[Mapping[str, str]] = {"line": "why.no_slip"}
    lines: ClassVar[Mapping[str, str]] = {"line": "∥ {p}{q}"}

    p: str
    q: str
    belted: bool = False
    start: int
    line: int

    @property
    def lies_along(self) -> str:
        """The radius."""
        return self.p + self.q

    def symbols(self) -> Mapping[str, str]:
        """The ends of the radius."""
        return {"p": symbol(self.p), "q": symbol(self.q), "bar": bar(self.p, self.q)}

    def clause(self, drawing: Drawing, role: str) -> str:
        """The parallel to the radius."""
        start = symbol(drawing.trace.program.steps[self.start].name)
        key = "common-normal-belt" if self.belted else "common-normal"
        return drawing.words(f"step.{key}", s=start, **self.symbols())

    def marks(self, canvas: Canvas, role: str) -> None:
        """The line, with the radius to which it is parallel."""
        canvas.locus(f"∥{self.p}{self.q}", f"∥ {bar(self.p, self.q)}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Where wheels touch their accelerations differ along the common normal only."""
        key = "belted" if self.belted else "touching"
        yield Relation(drawing.words(f"calculation.{key}", bar=bar(self.p, self.q)))


def common_normal(pen: Pen, start: int, ends: tuple[str, str], *, belted: bool = False) -> int:
    """The parallel to the radius between two points, through an image."""
    line = pen.draw(along_bar, start, *(pen.the("position", end) for end in ends))
    p, q = map(letter, ends)
    pen.make(CommonNormal(p=p, q=q, belted=belted, start=start, line=line))
    return line
