"""After how many turns of the driver a mechanism with wheels stands as before."""

from __future__ import annotations

from fractions import Fraction
from math import lcm, pi

import numpy as np

from graphkin.construction.core.program import Target
from graphkin.motion.course import Course, Reals
from graphkin.motion.driving import TURN
from graphkin.motion.turns_followed import led

BACK = 1e-6
"""Miss after a period, in parts of the mechanism's size, with which it has come back."""
MOST_TURNS = 24
"""Turns of the driver, forth and back, through which a motion that wheels carry on is followed."""
PLACES, FEWER = 64, 4
"""Places of a turn at which wheels are looked at, and where closing a group costs a search."""


def wheels(course: Course) -> list[str]:
    """The links whose whole turns count."""
    return [of for what, of in course.program.targets if what == "turned"]


def turns_back(course: Course, start: float) -> int:
    """After how many turns of the driver all wheels stand as before.

    A wheel turns in each turn of the driver by the same angle, whether or not the rest of the
    mechanism closes on the way; links that go round between pins are followed through two turns.
    0 for more turns than are followed, and where a group that is tried counts such links.
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
    """How many times some turns of the driver bring all wheels back, by where those have led."""
    return turns_between(first, np.array([start]), last, turns)


def turns_between(first: Course, places: Reals, last: Course, turns: int) -> int:
    """How many times so many turns bring all wheels back, by their angles before and after."""
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
    """The least number of times that a share of a turn must be added up to whole turns."""
    near = Fraction(share).limit_denominator(MOST_TURNS)
    missed = abs(float(near) - share) * near.denominator * 2 * pi
    return near.denominator if missed < BACK else MOST_TURNS + 1


def led_round(course: Course, start: float, stop: float) -> Course:
    """The course with links followed that go round between pins, where these close in every turn.

    Elsewhere no motion leads from turn to turn, and they count near what the course says.
    """
    if not course.counting or course.closing_work:
        return course
    places = start + np.arange(PLACES) * (TURN / PLACES)
    found = course.counted(course.values(places), places)
    if not all(np.isfinite(row).all() for row in found.values()):
        return course
    return course.along(turned=led(course, start, stop).turned)


def misses(first: Course, start: float, last: Course, stop: float) -> dict[Target, float]:
    """By how much points and links stand otherwise at one place than at another before.

    In parts of the mechanism's size, and as the size of the change of a unit axis.
    """
    targets = [t for t in first.program.targets if t[0] in ("position", "axis")]
    before = first.columns(np.array([start]), targets)
    after = last.columns(np.array([stop]), targets)
    places = np.array([before[t][0] for t in targets if t[0] == "position"])
    size = float(np.abs(places - places.mean()).max())
    units = {"position": size, "axis": 1.0}
    return {t: float(abs(before[t][0] - after[t][0])) / units[t[0]] for t in targets}
