"""What pairs with known links say of the acceleration of a point: a part of it, and a line."""

from __future__ import annotations

from msgspec import Struct

from graphkin.construction.core.arrows import acceleration_arrow, slide_arrow
from graphkin.construction.core.pen import Pen
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.guides.sliding import lay_off_component, turning_component
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.plans.plan import ACCELERATION
from graphkin.construction.velocity.lines_through import parallel_through
from graphkin.scene.link_points import is_under
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading


class GuideAcceleration(Struct, frozen=True):
    """What a pair says of the acceleration of the point ``name`` that it leads against ``link``.

    It lies at ``point``, which is another where that of a guide's link under a block's is sought.
    """

    pair: Leading
    link: str
    name: str
    point: str

    def component(
        self, pen: Pen, shapes: LinkShapes, sides: list[tuple[Joint, str]] | None = None
    ) -> int | None:
        """The component that its guide's turning gives it; None where that does not turn."""
        return turning_component(pen, self.pair, self.link, self.name, self.point)

    def end(self, pen: Pen, vector: int | None) -> int:
        """Where the known part ends in the plan."""
        return lay_off_component(pen, self.pair, self.link, self.name, self.point, vector)

    def line(self, pen: Pen, shapes: LinkShapes, vector: int | None) -> tuple[int, int]:
        """That, and the line of the rest, parallel to the guide."""
        end = self.end(pen, vector)
        along = led_by(self.pair).direction(pen, shapes)
        return end, parallel_through(pen, end, along, self.pair.links[0])

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """The arrow of the rest."""
        if is_under(self.name):
            slide_arrow(pen, found, end, self.link, self.point)
        else:
            slide_arrow(pen, end, found, partner(self.pair, self.link), self.point)

    def finish(self, pen: Pen, *, driven: bool = False) -> None:
        """The arrow from the pole, and the point where it touches."""
        if not is_under(self.name):
            acceleration_arrow(pen, self.name)
        led_by(self.pair).touch(pen, ACCELERATION)
