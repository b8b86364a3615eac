"""After how many turns of the driver a mechanism with wheels stands as before."""

from __future__ import annotations

from fractions import Fraction
from math import lcm, pi

import numpy as np

from graphkin.arithmetic import phase
from graphkin.motion.course import Course
from graphkin.motion.driving import TURN
from graphkin.motion.pieces import BACK, Path, marched, misses

MOST = 24
"""Turns of the driver that are followed."""


def strangers(path: Path) -> tuple[str, ...]:
    """The links that stand otherwise after a whole turn of the driver, in the order written."""
    pieces = path.ranges[0]
    first, start = pieces[0].course, pieces[0].low.at
    missed = misses(pieces, start, start + TURN)
    return tuple(link for link in first.scene.links if missed.get(("axis", link), 0.0) > BACK)


def turns_to_return(path: Path) -> int | None:
    """How many whole turns of the driver bring every link back; None where no few do.

    The wheels' angles after one turn say how many it may be; the motion is followed so far.
    """
    if path.returns:
        return 1
    pieces = path.ranges[0]
    first, start = pieces[0].course, pieces[0].low.at
    count = lcm(*(gone(first, pieces[-1].course, link, start) for link in wheels(first)))
    if not 1 < count <= MOST:
        return None
    way = marched(first, start, start + count * TURN)
    if way[-1].high.kind != "window":
        return None
    missed = misses(way, start, start + count * TURN)
    return count if max(missed.values()) <= BACK else None


def wheels(course: Course) -> list[str]:
    """The links whose whole turns count."""
    return [of for what, of in course.program.targets if what == "turned"]


def gone(first: Course, last: Course, link: str, start: float) -> int:
    """The least number of turns of the driver after which a link would stand as before."""
    axes = [
        course.columns(np.array([at]), [("axis", link)])["axis", link][0]
        for course, at in ((first, start), (last, start + TURN))
    ]
    share = phase(complex(axes[1] / axes[0])) / (2 * pi)
    near = Fraction(share).limit_denominator(MOST)
    return near.denominator if abs(float(near) - share) < BACK else MOST + 1
