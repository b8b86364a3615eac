"""The motion that a pair with a known link gives a point of the other link, in each drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

from msgspec import Struct

from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.guides.guides import axis, known_guide, local_line, path_of
from graphkin.construction.links.link_shapes import local_place
from graphkin.construction.plan import Plan
from graphkin.scene.model import Driver
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Leading, Sliding

if TYPE_CHECKING:
    from graphkin.construction.rolling.wheel_images import LedWheel
    from graphkin.structure.pairs import Contact


class LedBlock(Struct, frozen=True):
    """A block on the guide of a known link, or the link of a guide on a known block."""

    pair: Sliding

    def line(self, pen: Pen) -> int:
        return known_guide(pen, self.pair)

    def path(self, pen: Pen, link: str, point: str) -> int:
        """The line on which a point of the link moves."""
        return path_of(pen, self.pair, link, point)

    def direction(self, pen: Pen) -> int:
        """A line along which the link moves relative to the known one."""
        return known_guide(pen, self.pair)

    def driven(self, pen: Pen, driver: Driver, which: str) -> int:
        """The driver's position, speed or acceleration along the guide."""
        return int(getattr(pen.drive(driver), which))

    def set_at(self, pen: Pen, link: str, where: int) -> None:
        """Place the link, its guided point at a coordinate of the guide; set its axis."""
        from graphkin.construction.guides.guides import set_carrier, set_point

        pair, point = self.pair, pen.bases[link].start
        sides = link, partner(pair, link)
        pen.leads[link] = sides[1]
        line = path_of(pen, pair, link, point)
        with pen.on(Part.POSITION, Plane.MECHANISM):
            if pair.block == link:
                found = set_point(pen, point, sides, line, where)
            else:
                zero = known_guide(pen, pair, link)
                through = local_line(pen, pair.slide, link)[0]
                ends = local_place(pen, link, point), through, axis(pen, link)
                found = set_carrier(pen, point, sides, zero, where, *ends)
        pen.want("position", point, found)

    def finish(self, pen: Pen) -> None:
        """Do nothing: the link needs no more steps once its guided point is placed."""

    def touch(self, pen: Pen, plan: Plan) -> None:
        """Do nothing: a block has no rolling contact."""

    def rim(self, pen: Pen) -> int | None:
        """None: no radius relates its rotation to its coordinate."""
        return None


@overload
def led_by(pair: Contact) -> LedWheel: ...
@overload
def led_by(pair: Leading) -> LedBlock | LedWheel: ...
def led_by(pair: Leading) -> LedBlock | LedWheel:
    """The construction of a pair with a known link, in each drawing."""
    if isinstance(pair, Sliding):
        return LedBlock(pair)
    from graphkin.construction.rolling.wheel_images import LedWheel

    return LedWheel(pair)
