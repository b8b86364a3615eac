"""The image of a point where the two lines meet that leave it free."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.vocabulary import meet
from graphkin.drawing.symbol_markup import symbol

if TYPE_CHECKING:
    from graphkin.construction.core.canvas import Canvas
    from graphkin.construction.core.drawn_scene import Drawing


class CrossedImage(Construction, frozen=True, kw_only=True):
    """The ``image`` of a ``point`` where its lines ``first`` and ``second`` meet.

    Without a ``point`` it only shows by hand what similarity finds.
    """

    gives: ClassVar[tuple[str, ...]] = ("image",)
    reasons: ClassVar[Mapping[str, str]] = {"image": "why.meet"}

    point: str
    first: int
    second: int
    image: int

    @property
    def sought(self) -> str:
        """Its point."""
        return self.point

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """Both lines."""
        return self.first, self.second

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """Where they meet."""
        name = symbol(drawing.trace.program.steps[self.image].name)
        return drawing.words("step.meet", name=name)

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """Where both lines meet."""
        name = symbol(drawing.trace.program.steps[self.image].name)
        return drawing.words("step.meet-apart", name=name)

    def marks(self, canvas: Canvas, role: str) -> None:
        """The point, under its letter."""
        canvas.image()


def crossed_image(pen: Pen, first: int, second: int, *, name: str = "", of: str = "") -> int:
    """The image of a point where two lines meet, under its name in the plan."""
    image = pen.draw(meet, first, second, name=name)
    pen.make(CrossedImage(point=of, first=first, second=second, image=image))
    return image
