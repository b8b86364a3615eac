"""The field of a page that moves: the symbols of paper, drawn in it, are marks in traced numbers.

A symbol is laid off from a place along a way; what is laid off by constant lengths is carried by
this pose, so that a page holds the pose and the lengths, not each of its corners.
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
        """The place itself."""
        return self.pose.origin + self.pose.way * self.at if self.at else self.pose.origin


class MovingCoordinate(TracedNumber):
    """A coordinate of a place that a pose carries."""

    __slots__ = ("local",)

    def __init__(self, number: TracedNumber, local: Local) -> None:
        super().__init__(number.graph, number.node)
        self.local = local


class MovingPlace(Carried):
    """A place of a page that moves."""

    local: Local

    def __new__(cls, local: Local) -> MovingPlace:
        """Both coordinates of a place."""
        at = local.on_page
        found = super().__new__(
            cls, (MovingCoordinate(at.real, local), MovingCoordinate(at.imag, local))
        )
        found.local = local
        return found

    def toward(self, end: XY) -> tuple[Any, XY]:
        """How far another place of the page is, and the unit way to it."""
        assert isinstance(end, MovingPlace)
        way = self.local.pose.way
        across = end.local.on_page - self.local.on_page
        if not is_one(way, end.local.pose.way):
            return abs(across), MovingWay(across / abs(across))
        along = dot(across, way)
        return (along, MovingWay(way)) if along > 0 else (-along, MovingWay(way, -1))

    def across(self, way: XY, along: Any, aside: Any) -> XY:
        """The place so far along a unit way from this one and so far to its right."""
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
    """A unit way of a page that moves: a traced one, or the opposite of it."""

    way: TracedNumber
    sense: int

    def __new__(cls, way: TracedNumber, sense: int = 1) -> MovingWay:
        """Both parts of a way."""
        found = super().__new__(cls, (way.real * sense, way.imag * sense))
        found.way, found.sense = way, sense
        return found


class MovingField(Field, frozen=True):
    """A field while it moves."""

    binder: FieldBinder

    def __call__(self, point: Any) -> XY:
        """Where a traced point of the drawing falls on the page."""
        upright = self.binder.tape.lifted(1 + 0j)
        return MovingPlace(Local(BodyPose(self.binder.page(point), upright), 0j))

    def way(self, vector: Any) -> XY:
        """The unit way on the page of a direction of the drawing."""
        way = self.binder.tape.lifted(vector)
        return MovingWay((way / abs(way)).conjugate())
