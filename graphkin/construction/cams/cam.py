"""A follower placed by the law of its cam; its plans are those of the equivalent linkage."""

from __future__ import annotations

from graphkin.construction.cams.cam_centre import (
    coordinate,
    curvature_centre,
    height,
    over_plate,
    set_lever,
)
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.group_images import GroupImages, led_by
from graphkin.construction.guides.guides import turned_with
from graphkin.scene.model import FRAME
from graphkin.structure.groups import CamFollower
from graphkin.structure.pairs import Pin, Sliding


def place(pen: Pen, group: CamFollower) -> None:
    """Place the follower at the coordinate or angle that the law of its cam gives."""
    dyad = group.dyad
    follower = next(link for link in dyad.links if link in pen.scene.cams)
    cam = pen.scene.cams[follower]
    if cam.carrier != FRAME:
        pen.want("position", cam.centre, curvature_centre(pen, cam.centre))
    lever = cam.lever
    if lever:
        set_lever(pen, follower, lever)
        if isinstance(dyad.inner, Sliding):
            block_on(pen, dyad.inner, follower)
        return
    if cam.slides:
        *_, where = over_plate(pen, follower)
    else:
        line = height(pen, follower)
        with pen.on(Part.POSITION, Plane.NUMBERS):
            where = pen.draw(coordinate, *line)
    assert not isinstance(dyad.right, Pin)
    led_by(dyad.right).set_at(pen, follower, where)
    if isinstance(dyad.inner, Sliding):
        turned_with(pen, dyad.inner, follower)


def move(images: GroupImages, pen: Pen, group: CamFollower) -> None:
    """Draw a plan: that of the equivalent linkage."""
    images.dyad(pen, group.dyad)


def block_on(pen: Pen, pair: Sliding, lever: str) -> None:
    """Place the block that represents the contact on the face of a lever already placed."""
    turned_with(pen, pair, lever)
    under, block = pen.bases[lever].end, pen.bases[pair.block].start
    pen.want("position", under or "", pen.the("position", block))
