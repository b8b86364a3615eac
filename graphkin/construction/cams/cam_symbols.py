"""Cams on the mechanism: the profile about its pivot, and the tip of the follower on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import CircleMark, LineMark, polygon
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.scene.model import Link

if TYPE_CHECKING:
    from graphkin.construction.core.cam_profiles import CamProfile

BEYOND = 1.15
"""Drawn half-length of a flat face, as a multiple of the part that touches the cam in one turn."""


def draw_cams(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the profiles of all placed cams, and the rollers and faces of their followers."""
    from graphkin.construction.core.cam_profiles import DRAWN, profiles_of

    scene, places = drawing.scene, drawing.positions
    for follower, cam in scene.cams.items():
        tip = cam.point
        axis = drawing.standing.axis(cam.on)
        if cam.pivot not in places or tip not in places or axis is None:
            continue
        profile, *second = profiles_of(scene, follower, DRAWN)
        pivot = places[cam.pivot]
        for each in (profile, *second):
            outline = tuple(field(pivot + axis * complex(place)) for place in each.outline)
            board.marks.append(polygon(outline, "profile", cam.on))
        for each in second:
            assert cam.conjugate is not None
            at = field(places[cam.conjugate.at])
            board.marks.append(CircleMark(*at, each.roller * field.mm, "profile", follower))
        if cam.tip == "roller":
            radius = profile.roller * field.mm
            board.marks.append(CircleMark(*field(places[tip]), radius, "profile", follower))
        elif cam.is_flat:
            pin = places[cam.lever.pin] if cam.lever else None
            carrier = drawing.standing.axis(cam.carrier)
            seen = 1 + 0j if carrier is None else carrier
            (x1, y1), (x2, y2) = map(field, face_ends(profile, pin, places[tip], seen))
            board.marks.append(LineMark(x1, y1, x2, y2, "profile", follower))


def face_ends(
    profile: CamProfile, pin: complex | None, tip: complex, carrier: complex
) -> tuple[complex, complex]:
    """The ends of a flat face whose point, or whose lever's point, is at ``tip``.

    ``carrier`` is the axis of the link that carries the follower.
    """
    lever, far = profile.cam.lever, BEYOND * profile.face
    if lever is None or pin is None:
        along, aside = profile.guide[0] * carrier, profile.guide[1]
        foot = tip - 1j * along * aside
        return foot - 1j * along * far, foot + 1j * along * far
    way = (tip - pin) / abs(tip - pin)
    start = pin + 1j * way * lever.side * float(lever.face.si(profile.scene.values))
    return start, start + far * way


def face_words(drawing: Drawing, link: Link) -> str:
    """The sentence about a block that represents a flat face on its cam; empty for other links."""
    follower = drawing.scene.cam_links.get(link.name)
    if follower is None or not link.slides:
        return ""
    fields = {"k": escape(link.name), "f": escape(follower), "p": symbol(link.points[0])}
    return drawing.words("step.cam-face", **fields)
