"""Velocities of points that pairs join to known links, and motions along guides."""

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
    """The line on which a pair with a known link puts the image of a point."""

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> None:
        """None: no part of the velocity is known beforehand."""

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Nothing: the arrows follow once the image is found."""


class BarVelocity(BoundVelocity, frozen=True):
    """The line that a bar to a known ``pivot`` gives for the velocity of a ``point``."""

    pivot: str
    point: str

    def end(self, pen: Pen, vector: int | None) -> int:
        """The image of the pivot."""
        return pen.the("velocity", self.pivot)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The image of the pivot, and the perpendicular to the bar through it."""
        return self.end(pen, vector), perpendicular_through(pen, self.pivot, self.point)

    def finish(self, pen: Pen) -> None:
        """Draw the arrow from the pole, and the arrow from the pivot's image."""
        velocity_arrows(pen, self.point, self.pivot)


class GuideVelocity(BoundVelocity, frozen=True):
    """The line that a guiding pair gives for the velocity of the point ``name`` of ``link``.

    The point lies at ``point``. The two differ where the unknown is the point of the guide's link
    under a block's point.
    """

    pair: Leading
    link: str
    name: str
    point: str

    def end(self, pen: Pen, vector: int | None) -> int:
        """The image of the point underneath; if that one is unknown, of the point above it."""
        known, point = partner(self.pair, self.link), self.point
        own = known in pen.bases and pen.bases[known].start == point and pen.has("velocity", point)
        return pen.the("velocity", point) if own else image_under(pen, known, point, VELOCITY)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The known image, and the parallel to the guide through it."""
        along = led_by(self.pair).direction(pen)
        end = self.end(pen, vector)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """Draw the arrow from the pole, the arrow along the guide, and the contact point."""
        velocity_arrows(pen, self.name, ends_of(self.name)[0] if is_under(self.name) else None)
        if driven or (isinstance(self.pair, Sliding) and not is_under(self.name)):
            slide_arrow(pen, self.pair, self.link, self.name)
        led_by(self.pair).touch(pen, VELOCITY)


def slide_arrow(pen: Pen, pair: Joint, link: str, point: str) -> None:
    """Draw the arrow of a relative velocity along a moving guide.

    A translating guide causes no acceleration component. Then an arrow in the other direction, of
    the guide along the block, is enough.
    """
    known, o = partner(pair, link), pen.pole(Plane.VELOCITIES)
    start, tip = image_under(pen, known, point, VELOCITY), pen.the("velocity", point)
    is_seen = not pen.turns(known) and tip != o and arrow_joins(pen, tip, start)
    if start not in (o, tip) and not is_seen:
        arrow_between(pen, start, tip, point, letter(under(point, known)))


def arrow_joins(pen: Pen, tail: int, tip: int) -> bool:
    """Whether an arrow joins two images, or two images that coincide with them."""
    ends = source_of(pen, tail), source_of(pen, tip)
    arrows = (step.args for step in pen.steps if step.arrow and step.action is join)
    return any((source_of(pen, start), source_of(pen, end)) == ends for start, end in arrows)
