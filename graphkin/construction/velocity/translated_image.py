"""The image of a point of a link that only shifts: all its points move as one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vector_equation import Term, VectorEquation
from graphkin.construction.core.vocabulary import action
from graphkin.construction.velocity.known_vector import known, stated
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point

if TYPE_CHECKING:
    from graphkin.construction.core.canvas import Canvas
    from graphkin.construction.core.drawn_scene import Drawing


@action("alike")
def alike(image: Point) -> Point:
    """The image of a point that moves as another does: a block does not turn."""
    return image


class TranslatedImage(Construction, frozen=True, kw_only=True):
    """The ``image`` of a point ``q``, on the image ``start`` of ``p``, for it moves as that."""

    gives: ClassVar[tuple[str, ...]] = ("image",)
    reasons: ClassVar[Mapping[str, str]] = {"image": "why.alike"}
    unmarked: ClassVar[frozenset[str]] = frozenset({"image"})

    p: str
    q: str
    start: int
    image: int

    @property
    def falls_on(self) -> int:
        """The other image."""
        return self.start

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """It falls on the same point."""
        name = symbol(drawing.trace.program.steps[self.image].name)
        return drawing.words("step.alike", name=name, p=symbol(self.p), q=symbol(self.q))

    def marks(self, canvas: Canvas, role: str) -> None:
        """The point, under its letter too."""
        canvas.image()

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Its vector is that of the other point."""
        whole = Term(symbol(f"{drawing.vector.letter}_{self.q}"))
        yield stated(VectorEquation(whole, ((known(drawing, self.p),),)))


def translated_image(pen: Pen, start: int, ends: tuple[str, str], name: str) -> int:
    """The image of the second of two points, on that of the first, under its name in the plan."""
    image = pen.draw(alike, start, name=name)
    pen.make(TranslatedImage(p=ends[0], q=ends[1], start=start, image=image))
    return image
