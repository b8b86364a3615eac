"""The fixed and the moving centrode of a link: the curves of its instantaneous centre."""

from __future__ import annotations

import numpy as np
from msgspec import Struct

from graphkin.motion.cycle import Cycle
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME, Link, Scene

MOST = 2
"""The most couplers whose centrodes are drawn when the scene names none."""

Complexes = np.ndarray[tuple[int], np.dtype[np.complex128]]


class Centrodes(Struct, frozen=True, eq=False):
    """Instantaneous centres of a link at values u (N,): in the plane, and carried by the link.

    ``moving`` is in the link's own axes, with its origin at the first point and the x axis towards
    the second. ``origin`` and ``heading`` place it in the plane. Centres at infinity are NaN.
    """

    link: str
    fixed: Complexes
    moving: Complexes
    origin: Complexes
    heading: Complexes

    def placed(self, origin: complex, heading: complex) -> Complexes:
        """The moving centrode for a link with the given origin and direction."""
        return np.asarray(origin + heading * self.moving)


def centrodes(cycle: Cycle, link: str) -> Centrodes | None:
    """Both centrodes of a link through the rows of a cycle; None if it has no centres."""
    motion = cycle.solution.links.get(link)
    ends = base(cycle.scene.links[link])
    if motion is None or not isinstance(motion.instant_centre, Ratio) or ends is None:
        return None
    start, end = (np.asarray(cycle.solution.points[p].position) for p in ends)
    heading = (end - start) / np.abs(end - start)
    ratio = motion.instant_centre
    with np.errstate(all="ignore"):
        fixed = ratio.start + ratio.shift / ratio.size
    fixed = np.where(np.isfinite(fixed), fixed, complex(np.nan, np.nan))
    return Centrodes(link, fixed, (fixed - start) * heading.conj(), start, heading)


def base(link: Link) -> tuple[str, str] | None:
    """The first two points of a link."""
    return (link.points[0], link.points[1]) if len(link.points) > 1 else None


def links_with_centrodes(scene: Scene) -> tuple[str, ...]:
    """The requested links, else the first couplers: links that no pair joins to the frame."""
    if scene.ask.centrodes:
        return tuple(scene.ask.centrodes)
    fixed = set(scene.fixed_points)
    driven = {driver.link for driver in scene.drivers}
    couplers = [
        name
        for name, link in scene.links.items()
        if name not in driven
        and len(link.points) > 1
        and fixed.isdisjoint(link.points)
        and all(slide.on != FRAME for slide in link.slides)
    ]
    return tuple(couplers[:MOST])
