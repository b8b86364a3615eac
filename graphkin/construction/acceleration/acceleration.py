"""Accelerations of points on guides and tracks, and motions along a guide.

The acceleration of the point underneath is known and, on a turning guide, the Coriolis component.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from graphkin.construction.core.component import LaidOff
from graphkin.construction.core.pen import Pen, acceleration_arrow, slide_arrow
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.plan import ACCELERATION, VELOCITY
from graphkin.construction.velocity.image_of_link import image_under
from graphkin.construction.velocity.relative_motion import parallel_through
from graphkin.scene.link_points import is_under
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading

if TYPE_CHECKING:
    from graphkin.construction.coriolis import CoriolisComponent


class GuideAcceleration(Struct, frozen=True):
    """The line that a guiding pair gives for the acceleration of the point ``name`` of ``link``.

    The point lies at ``point``. The two differ where the unknown is the point of the guide's link
    under a block's point (name A@3, point A).
    """

    pair: Leading
    link: str
    name: str
    point: str

    @property
    def known(self) -> str:
        return partner(self.pair, self.link)

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> int | None:
        """The Coriolis component that a turning guide causes; None where the guide does not turn.

        For a point under a pin it uses the relative velocity of the pin. Otherwise it uses the
        velocity of the point relative to the link on which the point slides.
        """
        if not is_under(self.name) and not pen.turns(self.known):
            return None
        from graphkin.construction.coriolis import coriolis_of

        if is_under(self.name):
            link, tail = self.link, pen.the("velocity", self.name)
        else:
            link, tail = self.known, image_under(pen, self.known, self.point, VELOCITY)
        tip = pen.the("velocity", self.point)
        return coriolis_of(pen, link, tail, tip, self.point, self.pair.links[0])

    def end(self, pen: Pen, vector: int | None) -> int:
        """The end of the known part in the plan: the component laid off from the point underneath.

        If that point is unknown, the component is laid off backwards from the sliding point.
        """
        if vector is None:
            return image_under(pen, self.known, self.point, ACCELERATION)
        from graphkin.construction.coriolis import end_of

        if is_under(self.name):
            return end_of(pen, pen.the("acceleration", self.point), vector, back=True)
        return end_of(pen, image_under(pen, self.known, self.point, ACCELERATION), vector)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """The known end, and the line of the rest, parallel to the guide."""
        end = self.end(pen, vector)
        along = led_by(self.pair).direction(pen)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """Draw the arrow of the rest."""
        if is_under(self.name):
            slide_arrow(pen, found, end, self.link, self.point)
        else:
            slide_arrow(pen, end, found, self.known, self.point)

    def laid_beside(self, pen: Pen, vector: int, found: int) -> int:
        """The end of the component of a block whose image is known; draws the arrow of the rest."""
        pen.want("coriolis", self.link, vector)
        with ACCELERATION.drawn(pen):
            end = self.end(pen, vector)
            self.rest(pen, end, found)
        return end

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """Draw the arrow from the pole, and the contact point."""
        if not is_under(self.name):
            acceleration_arrow(pen, self.name)
        led_by(self.pair).touch(pen, ACCELERATION)


def end_on_driven(
    pen: Pen, link: str, images: tuple[int, int], point: str, block: str, index: str
) -> int:
    """The end of the known part for a link that a driver slides along another, from a known pin.

    ``images`` are the velocity images of the ``point`` and of the link's own point there.
    """
    from graphkin.construction.coriolis import coriolis_of, end_of

    vector = coriolis_of(pen, link, *images, point, block, index=index)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        return end_of(pen, pen.the("acceleration", point), vector)


def slid(step: Step) -> tuple[LaidOff, CoriolisComponent] | None:
    """The Coriolis component that a step lays off; None for other steps."""
    from graphkin.construction.coriolis import CoriolisComponent

    laid = step.of
    if not isinstance(laid, LaidOff) or not isinstance(laid.component, CoriolisComponent):
        return None
    return laid, laid.component
