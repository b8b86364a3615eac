"""Cams on the mechanism: the profile about its pivot, and the tip of the follower on it."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import CircleMark, LineMark, polygon

BEYOND = 1.15
"""How far a flat face is drawn, in parts of what touches the cam in a turn."""


def draw_cams(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """The profiles of all cams whose place is known, and rollers and faces of their followers."""
    from graphkin.construction.core.cam_profiles import DRAWN, CamProfile

    scene, places = drawing.scene, drawing.positions
    for follower, cam in scene.cams.items():
        tip = scene.link(follower).points[0]
        axis = drawing.standing.axis(cam.on)
        if cam.pivot not in places or tip not in places or axis is None:
            continue
        profile = CamProfile(scene, follower, DRAWN)
        pivot = places[cam.pivot]
        outline = tuple(field(pivot + axis * complex(place)) for place in profile.outline)
        board.marks.append(polygon(outline, "profile", cam.on))
        if cam.tip == "roller":
            radius = profile.roller * field.mm
            board.marks.append(CircleMark(*field(places[tip]), radius, "profile", follower))
        elif cam.is_flat:
            along, aside = profile.guide
            foot = places[tip] - 1j * along * aside
            ends = (foot + 1j * along * side * BEYOND * profile.face for side in (-1, 1))
            (x1, y1), (x2, y2) = (field(end) for end in ends)
            board.marks.append(LineMark(x1, y1, x2, y2, "profile", follower))
