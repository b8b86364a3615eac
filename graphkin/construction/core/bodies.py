"""What stands in the plane beside points: guides and wheels."""

from __future__ import annotations

from msgspec import Struct

from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import dot
from graphkin.scene.model import Slide, Wheel


class Guideway(Struct, frozen=True):
    """The straight guide of a block: its zero, its unit direction, and the block's first point.

    ``offset`` is how far the block's first point stands to the left of the guide.
    """

    block: str
    slide: Slide
    zero: complex
    along: complex
    at: complex
    offset: float

    @property
    def coordinate(self) -> Real:
        """Where the block stands, along the guide from its zero."""
        return dot(self.at - self.zero, self.along)

    @property
    def foot(self) -> Point:
        """The place on the guide beside the block's first point."""
        return self.zero + self.coordinate * self.along


class Disc(Struct, frozen=True):
    """A wheel of a link in the plane; ``module`` is nought where it has no teeth."""

    link: str
    wheel: Wheel
    centre: complex
    radius: float
    module: float

    @property
    def outer(self) -> float:
        """Radius of the circle that holds all of the wheel."""
        thick = 3 * self.module if self.wheel.inside else self.module
        return self.radius + thick
