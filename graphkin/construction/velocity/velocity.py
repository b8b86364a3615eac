"""What pairs with known links say of the velocity of a point, and of the motion along a guide."""

from __future__ import annotations

from msgspec import Struct

from graphkin.construction.core.arrows import arrow_between, velocity_arrows
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import Plane
from graphkin.construction.core.vocabulary import join
from graphkin.construction.guides.coincident_points import image_under, source_of
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.plan import VELOCITY
from graphkin.construction.velocity.lines_through import parallel_through, perpendicular_through
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading, Sliding


class BoundVelocity(Struct, frozen=True):
    """What a pair says of the velocity of a point: a line on which its image lies."""

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> None:
        """No part of it is known."""

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Its arrows follow once it is found."""


class BarVelocity(BoundVelocity, frozen=True):
    """What a bar to a known ``pivot`` says of the velocity of a ``point``."""

    pivot: str
    point: str

    def end(self, pen: Pen, vector: int | None) -> int:
        """The image of the pivot."""
        return pen.the("velocity", self.pivot)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """That, and the perpendicular to the bar through it."""
        return self.end(pen, vector), perpendicular_through(pen, self.pivot, self.point)

    def finish(self, pen: Pen) -> None:
        """The arrow from the pole, and that about the pivot."""
        velocity_arrows(pen, self.point, self.pivot)


class GuideVelocity(BoundVelocity, frozen=True):
    """What a pair says of the velocity of the point ``name`` that it leads against ``link``.

    It lies at ``point``, which is another where that of a guide's link under a block's is sought.
    """

    pair: Leading
    link: str
    name: str
    point: str

    def end(self, pen: Pen, vector: int | None) -> int:
        """The image of the point beneath; where that is the one sought, of the point above."""
        known, point = partner(self.pair, self.link), self.point
        own = known in pen.bases and pen.bases[known].start == point and pen.has("velocity", point)
        return pen.the("velocity", point) if own else image_under(pen, known, point, VELOCITY)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """That, and the parallel to the guide through it."""
        along = led_by(self.pair).direction(pen)
        end = self.end(pen, vector)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """The arrow from the pole, that along the guide, and the point where it touches."""
        velocity_arrows(pen, self.name, ends_of(self.name)[0] if is_under(self.name) else None)
        if driven or (isinstance(self.pair, Sliding) and not is_under(self.name)):
            slide_arrow(pen, self.pair, self.link, self.name)
        led_by(self.pair).touch(pen, VELOCITY)


def slide_arrow(pen: Pen, pair: Joint, link: str, point: str) -> None:
    """The arrow of a relative velocity along a guide that moves.

    Of one that only shifts, so that no component of an acceleration comes of it, that of the guide
    along the block suffices.
    """
    known, o = partner(pair, link), pen.pole(Plane.VELOCITIES)
    start, tip = image_under(pen, known, point, VELOCITY), pen.the("velocity", point)
    told = not pen.turns(known) and tip != o and is_joined(pen, tip, start)
    if start not in (o, tip) and not told:
        arrow_between(pen, start, tip, point, letter(under(point, known)))


def is_joined(pen: Pen, tail: int, tip: int) -> bool:
    """Whether an arrow leads from one image to another, or between others on which they fall."""
    ends = source_of(pen, tail), source_of(pen, tip)
    arrows = (step.args for step in pen.steps if step.arrow and step.action is join)
    return any((source_of(pen, start), source_of(pen, end)) == ends for start, end in arrows)
