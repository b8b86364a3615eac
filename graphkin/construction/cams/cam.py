"""A follower set by its cam's law; its plans are those of the equivalent linkage."""

from __future__ import annotations

from graphkin.construction.cams.cam_centre import coordinate, height
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.guides.guides import turned_with
from graphkin.construction.links.leading import led_by
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.structure.groups import CamFollower
from graphkin.structure.pairs import Pin, Sliding


def place(pen: Pen, shapes: LinkShapes, group: CamFollower) -> None:
    """The follower at the coordinate that the law of its cam gives."""
    dyad = group.dyad
    follower = dyad.links[1]
    line = height(pen, shapes, follower)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        where = pen.draw(coordinate, *line)
    assert not isinstance(dyad.right, Pin)
    led_by(dyad.right).set_at(pen, shapes, follower, where)
    if isinstance(dyad.inner, Sliding):
        turned_with(pen, shapes, dyad.inner, follower)
