"""The velocity of a pin about a pivot by a known turning: ω times the bar, perpendicular to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import has_no_length, rate_symbol, vector_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import action
from graphkin.construction.velocity.laid_off_by_rate import (
    LaidOffAboutPivot,
    by_bar,
    falls,
    length_drawn,
    rate_words,
)
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real

if TYPE_CHECKING:
    from graphkin.construction.core.canvas import Canvas


@action("turned-velocity")
def turned_velocity(start: Point, pivot: Point, pin: Point, omega: Real) -> Point:
    """Image of a pin turning about a pivot: omega times the bar, turned a quarter (Galileo)."""
    return start + 1j * (pin - pivot) * omega


class TurnedVelocity(LaidOffAboutPivot, frozen=True, kw_only=True):
    """ω·l laid off in the velocity plan from the image ``start`` of a pivot to that of a pin.

    ``omega`` is how fast the ``link`` of both turns.
    """

    gives: ClassVar[tuple[str, ...]] = ("image",)
    reasons: ClassVar[Mapping[str, str]] = {"image": "why.turned"}
    laid_off: ClassVar[frozenset[str]] = frozenset({"image"})

    start: int
    omega: int
    image: int

    def tried_rate(self, role: str) -> int:
        """The angular velocity."""
        return self.omega

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """What ends where it begins."""
        return (self.start,)

    def fields(self, drawing: Drawing, role: str) -> dict[str, str]:
        """Its ends, its bar, its rate and its drawn length."""
        steps = drawing.trace.program.steps
        default = symbol(f"v_{self.index}")
        return {
            **self.symbols(),
            "s": symbol(steps[self.start].name),
            "name": symbol(steps[self.image].name),
            "vector": vector_of(drawing, self.start, self.image, default),
            "omega": rate_words(drawing, self.image, self.omega, self.link, "ω"),
            "rate": rate_symbol(drawing, self.omega),
            "drawn": length_drawn(drawing, self.start, self.image),
        }

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How it is laid off: as long as the bar is drawn where the driver sets the scale."""
        fields = self.fields(drawing, role)
        if has_no_length(drawing, self.image):
            return drawing.words(falls(drawing, self.image, fields["s"]), **fields)
        return drawing.words(f"step.turned-velocity{by_bar(drawing, self.omega, fields)}", **fields)

    def marks(self, canvas: Canvas, role: str) -> None:
        """The point at its end."""
        canvas.image()

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem, and its size; a driver's crank has relations of its own."""
        if not self.is_of_driver(drawing, self.omega):
            yield self.euler(drawing, omega=rate_symbol(drawing, self.omega))
            if self.image not in drawing.auxiliary:
                yield self.by_turning(drawing, self.omega, "")

    def known_by(self, drawing: Drawing) -> str:
        """Square to its bar, by the rate of a driver."""
        rate = rate_symbol(drawing, self.omega)
        driven = self.is_of_driver(drawing, self.omega)
        return f"⊥ {self.bar}, {rate}·{self.bar}" if driven else ""

    def rate_taken(self, drawing: Drawing, role: str) -> str:
        """The angular velocity."""
        return rate_symbol(drawing, self.omega)


def turned_image(
    pen: Pen,
    link: str,
    letters: tuple[str, str],
    start: int,
    places: tuple[int, int],
    *,
    name: str,
    omega: int | None = None,
    index: str = "",
) -> int:
    """The image of a pin of a turning link, from the image ``start`` of its pivot.

    ``letters`` and ``places`` are those of pivot and pin; the link's own ``omega`` turns it, unless
    another step is told.
    """
    p, q = letters
    rate = pen.the(OMEGA, link) if omega is None else omega
    image = pen.draw(turned_velocity, start, *places, rate, name=name)
    index = index or q + ("" if p in pen.scene.frame.points else p)
    names = {"p": p, "q": q, "index": index, "whole": q, "base": p}
    pen.make(TurnedVelocity(**names, link=link, start=start, omega=rate, image=image))
    return image
