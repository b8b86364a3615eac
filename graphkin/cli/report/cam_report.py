"""What check says of cams: their pressure angle, and the sharpest place of the profile."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.cam_profiles import CamProfile, profiles_of
from graphkin.construction.core.drawn_scene import METRES
from graphkin.scene.model import Scene

STEEP = 30.0
"""Pressure angle of a sliding follower that textbooks advise not to exceed, in degrees."""
STEEP_LEVER = 45.0
"""The same of one that swings."""


def cam_lines(scene: Scene) -> Iterator[str]:
    """For each cam its pressure angle and its least radius of curvature; undercutting is told."""
    unit = scene.units["length"]
    for follower, cam in scene.cams.items():
        moves = "swings" if cam.lever else "lifts"
        yield f"link {cam.on} {moves} link {follower} by a {cam.tip} follower"
        for profile in profiles_of(scene, follower):
            if profile.second:
                yield "  and its second roller on the conjugate profile"
            yield from profile_lines(profile, unit)


def profile_lines(profile: CamProfile, unit: str) -> Iterator[str]:
    """The pressure angle of one profile, and its least radius of curvature."""
    cam = profile.cam
    if cam.lever or not profile.is_flat:
        angle, at = profile.steepest
        steep = STEEP_LEVER if cam.lever else STEEP
        over = f", above the usual {steep:g}°" if angle > steep else ""
        yield f"  pressure angle at most {angle:.2f}° (at {at:.1f}° of the law){over}"
    radius, at = profile.sharpest
    size = f"{radius / METRES[unit]:.4g} {unit}"
    if radius <= 0:
        yield f"  undercut at {at:.1f}° of the law: radius {size}; {remedy(cam.tip)}"
    else:
        yield f"  convex profile's least radius {size} (at {at:.1f}° of the law)"


def remedy(tip: str) -> str:
    """What takes undercutting away."""
    smaller = " or a smaller roller" if tip == "roller" else ""
    return f"a larger base circle{smaller} mends it"
