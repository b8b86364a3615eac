"""The number of driver turns after which a mechanism with wheels is back in its position."""

from __future__ import annotations

from fractions import Fraction
from math import lcm, pi

import numpy as np

from graphkin.construction.core.program import Target
from graphkin.motion.course import Course, Reals
from graphkin.motion.driving import TURN
from graphkin.motion.turns_followed import led

BACK = 1e-6
"""Difference after a period, relative to the mechanism's size, that counts as none."""
MOST_TURNS = 24
"""The most driver turns, in both directions, over which a motion with wheels is followed."""
PLACES, FEWER = 64, 4
"""Positions per turn at which wheels are examined, and FEWER where each requires a search."""


def wheels(course: Course) -> list[str]:
    """The links whose whole turns count."""
    return [of for what, of in course.program.targets if what == "turned"]


def turns_back(course: Course, start: float) -> int:
    """The number of driver turns after which all wheels are back.

    A wheel turns by the same angle in each driver turn, even if the rest of the mechanism does not
    close on the way. Links that rotate between pins are followed through two turns. 0 for more
    turns than are followed, and where a group closed by trial counts such links.
    """
    links = wheels(course)
    if not links:
        return 1
    if course.counting and course.closing_work:
        return 0
    count = FEWER if course.closing_work else PLACES
    places = start + np.arange(count) * (TURN / count)
    course = led_round(course, start, start + 2 * TURN)
    return turns_between(course, places, course, 1)


def turns_after(first: Course, start: float, last: Course, turns: int) -> int:
    """How many times ``turns`` driver turns bring all wheels back, judged by one such run."""
    return turns_between(first, np.array([start]), last, turns)


def turns_between(first: Course, places: Reals, last: Course, turns: int) -> int:
    """How many times ``turns`` turns bring all wheels back, by their angles before and after."""
    targets = [("axis", link) for link in wheels(first)]
    before = first.columns(places, targets)
    after = last.columns(places + turns * TURN, targets)
    count = 1
    for target in targets:
        with np.errstate(invalid="ignore"):
            ratio = after[target] / before[target]
        known = ratio[np.isfinite(ratio)]
        if known.size:
            count = lcm(count, repeated(float(np.angle(known[0])) / (2 * pi)))
    return count if count * turns <= MOST_TURNS else 0


def repeated(share: float) -> int:
    """The least multiple of a share of a turn that makes whole turns."""
    near = Fraction(share).limit_denominator(MOST_TURNS)
    missed = abs(float(near) - share) * near.denominator * 2 * pi
    return near.denominator if missed < BACK else MOST_TURNS + 1


def led_round(course: Course, start: float, stop: float) -> Course:
    """The course with rotating links between pins followed, if these close in every turn.

    Otherwise no motion leads from turn to turn, and they count near the course's angles.
    """
    if not course.counting or course.closing_work:
        return course
    places = start + np.arange(PLACES) * (TURN / PLACES)
    found = course.counted(course.values(places), places)
    if not all(np.isfinite(row).all() for row in found.values()):
        return course
    return course.along(turned=led(course, start, stop).turned)


def misses(first: Course, start: float, last: Course, stop: float) -> dict[Target, float]:
    """The differences of points and links between two positions.

    Points count relative to the mechanism's size, links by the change of a unit axis.
    """
    targets = [t for t in first.program.targets if t[0] in ("position", "axis")]
    before = first.columns(np.array([start]), targets)
    after = last.columns(np.array([stop]), targets)
    places = np.array([before[t][0] for t in targets if t[0] == "position"])
    size = float(np.abs(places - places.mean()).max())
    units = {"position": size, "axis": 1.0}
    return {t: float(abs(before[t][0] - after[t][0])) / units[t[0]] for t in targets}
