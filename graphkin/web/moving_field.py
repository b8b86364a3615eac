"""The field of a moving page, in which paper's symbols are drawn as marks in traced numbers.

A symbol starts at a place and extends along a direction. A pose carries the parts at constant
distances, so that a page holds the pose and the distances rather than each corner.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from graphkin.construction.tape.traced import TracedNumber
from graphkin.drawing.field import XY, Carried, Field
from graphkin.numbers.plane import dot
from graphkin.web.body_pose import BodyPose, is_one
from graphkin.web.field_binder import FieldBinder


class Local(NamedTuple):
    """A place of the page in the axes of the pose that carries it."""

    pose: BodyPose
    at: complex

    @property
    def on_page(self) -> Any:
        return self.pose.origin + self.pose.way * self.at if self.at else self.pose.origin


class MovingCoordinate(TracedNumber):
    """A coordinate of a place that a pose carries."""

    __slots__ = ("local",)

    def __init__(self, number: TracedNumber, local: Local) -> None:
        super().__init__(number.graph, number.node)
        self.local = local


class MovingPlace(Carried):
    """A place on a moving page."""

    local: Local

    def __new__(cls, local: Local) -> MovingPlace:
        """The place with both its coordinates."""
        at = local.on_page
        found = super().__new__(
            cls, (MovingCoordinate(at.real, local), MovingCoordinate(at.imag, local))
        )
        found.local = local
        return found

    def toward(self, end: XY) -> tuple[Any, XY]:
        """The distance to another place of the page, and the unit direction towards it."""
        assert isinstance(end, MovingPlace)
        way = self.local.pose.way
        across = end.local.on_page - self.local.on_page
        if not is_one(way, end.local.pose.way):
            return abs(across), MovingWay(across / abs(across))
        along = dot(across, way)
        return (along, MovingWay(way)) if along > 0 else (-along, MovingWay(way, -1))

    def across(self, way: XY, along: Any, aside: Any) -> XY:
        """The place ``along`` a unit direction from this one and ``aside`` to its right."""
        pose, here = self.local
        way = (
            way
            if isinstance(way, MovingWay)
            else MovingWay(pose.way.of_constant(1.0) * complex(*way))
        )
        if not is_one(pose.way, way.way):
            pose, here = BodyPose(self.local.on_page, way.way), 0j
        if isinstance(along, TracedNumber):
            pose, along = BodyPose(pose.origin + way.way * (along * way.sense), way.way), 0.0
        if isinstance(aside, TracedNumber):
            pose, aside = BodyPose(pose.origin + way.way * (aside * (1j * way.sense)), way.way), 0.0
        return MovingPlace(Local(pose, here + way.sense * complex(along, aside)))


class MovingWay(tuple[Any, Any]):
    """A unit direction of a moving page: a traced direction or its opposite."""

    way: TracedNumber
    sense: int

    def __new__(cls, way: TracedNumber, sense: int = 1) -> MovingWay:
        """The direction with both its components."""
        found = super().__new__(cls, (way.real * sense, way.imag * sense))
        found.way, found.sense = way, sense
        return found


class MovingField(Field, frozen=True):
    """A field of a moving page."""

    binder: FieldBinder

    def __call__(self, point: Any) -> XY:
        """The place on the page of a traced point of the drawing."""
        upright = self.binder.tape.lifted(1 + 0j)
        return MovingPlace(Local(BodyPose(self.binder.page(point), upright), 0j))

    def way(self, vector: Any) -> XY:
        """The unit direction on the page of a direction of the drawing."""
        way = self.binder.tape.lifted(vector)
        return MovingWay((way / abs(way)).conjugate())
