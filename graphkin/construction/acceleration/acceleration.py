"""What pairs with known links say of the acceleration of a point: a part of it, and a line."""

from __future__ import annotations

from msgspec import Struct

from graphkin.construction.acceleration.tangential_direction import tangential_direction
from graphkin.construction.core.arrows import acceleration_arrow, component_arrow, slide_arrow
from graphkin.construction.core.pen import Pen
from graphkin.construction.guides.led_block import led_by
from graphkin.construction.guides.sliding import lay_off_component, turning_component
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.normal_component.normal_component import (
    lay_off_normal,
    normal_component,
)
from graphkin.construction.plans.plan import ACCELERATION
from graphkin.construction.velocity.lines_through import parallel_through
from graphkin.scene.link_points import is_under
from graphkin.scene.requests import KLEIN
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Joint, Leading


class BarAcceleration(Struct, frozen=True):
    """What a bar to a known ``pivot`` says of the acceleration of a ``point``."""

    pivot: str
    point: str

    def component(
        self, pen: Pen, shapes: LinkShapes, sides: list[tuple[Joint, str]] | None = None
    ) -> int:
        """The component that is known of it, drawn as the scene wants it among those ``sides``."""
        if sides is None or pen.scene.sheet.method != KLEIN:
            return normal_component(pen, self.pivot, self.point)
        from graphkin.construction.normal_component.klein import component_in_dyad

        return component_in_dyad(pen, shapes, sides, self.pivot, self.point)

    def end(self, pen: Pen, vector: int | None) -> int:
        """Where the known part ends in the plan."""
        assert vector is not None
        return lay_off_normal(pen, self.pivot, self.point, vector)

    def line(self, pen: Pen, shapes: LinkShapes, vector: int | None) -> tuple[int, int]:
        """That, and the line of the rest."""
        end = self.end(pen, vector)
        return end, tangential_direction(pen, self.pivot, self.point, end)

    def rest(self, pen: Pen, end: int, found: int) -> None:
        """The arrow of the rest."""
        component_arrow(pen, end, found, "τ", self.point, self.pivot)

    def finish(self, pen: Pen) -> None:
        """The arrow from the pole."""
        if not is_under(self.point):
            acceleration_arrow(pen, self.point)


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
