"""What guides and tracks say of the acceleration of a point, and of the motion along a guide.

Known is the acceleration of the point under it, and where the guide turns the component for that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from graphkin.construction.core.arrows import acceleration_arrow, slide_arrow
from graphkin.construction.core.component import LaidOff
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.guides.coincident_points import image_under
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.plan import ACCELERATION, VELOCITY
from graphkin.construction.velocity.lines_through import parallel_through
from graphkin.scene.link_points import is_under
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading

if TYPE_CHECKING:
    from graphkin.construction.coriolis import CoriolisComponent


class GuideAcceleration(Struct, frozen=True):
    """What a pair says of the acceleration of the point ``name`` that it leads against ``link``.

    It lies at ``point``, which is another where that of a guide's link under a block's is sought
    (name A@3, point A).
    """

    pair: Leading
    link: str
    name: str
    point: str

    @property
    def known(self) -> str:
        """The link against which the pair leads the point."""
        return partner(self.pair, self.link)

    def component(self, pen: Pen, sides: list[tuple[Joint, str]] | None = None) -> int | None:
        """The component that its guide's turning gives it; None where that does not turn.

        Of a point under a pin the pin's relative velocity counts, else that of the point against
        what it slides on.
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
        """Where the known part ends in the plan: the component laid off from the point under it.

        Where that is the one that is sought, it is laid off backwards from the sliding one.
        """
        if vector is None:
            return image_under(pen, self.known, self.point, ACCELERATION)
        from graphkin.construction.coriolis import end_of

        if is_under(self.name):
            return end_of(pen, pen.the("acceleration", self.point), vector, back=True)
        return end_of(pen, image_under(pen, self.known, self.point, ACCELERATION), vector)

    def line(self, pen: Pen, vector: int | None) -> tuple[int, int]:
        """That, and the line of the rest, parallel to the guide."""
        end = self.end(pen, vector)
        along = led_by(self.pair).direction(pen)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """The arrow of the rest."""
        if is_under(self.name):
            slide_arrow(pen, found, end, self.link, self.point)
        else:
            slide_arrow(pen, end, found, self.known, self.point)

    def laid_beside(self, pen: Pen, vector: int, found: int) -> int:
        """Where the component ends of a block whose image is found, with the arrow of the rest."""
        pen.want("coriolis", self.link, vector)
        with ACCELERATION.drawn(pen):
            end = self.end(pen, vector)
            self.rest(pen, end, found)
        return end

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """The arrow from the pole, and the point where it touches."""
        if not is_under(self.name):
            acceleration_arrow(pen, self.name)
        led_by(self.pair).touch(pen, ACCELERATION)


def end_on_driven(
    pen: Pen, link: str, images: tuple[int, int], point: str, block: str, index: str
) -> int:
    """The same for a link that a driver slides against another, as its pin on ``point`` is known.

    The ``images`` of the velocity plan are those of that point and of the link's own point there.
    """
    from graphkin.construction.coriolis import coriolis_of, end_of

    vector = coriolis_of(pen, link, *images, point, block, index=index)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        return end_of(pen, pen.the("acceleration", point), vector)


def slid(step: Step) -> tuple[LaidOff, CoriolisComponent] | None:
    """The component of what slides that a step lays off; None for other steps."""
    from graphkin.construction.coriolis import CoriolisComponent

    laid = step.of
    if not isinstance(laid, LaidOff) or not isinstance(laid.component, CoriolisComponent):
        return None
    return laid, laid.component
