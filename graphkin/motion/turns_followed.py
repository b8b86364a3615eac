"""Links followed along a motion: the angles near which they count."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from graphkin.motion.course import Course
from graphkin.motion.turns_counted import Turned, name_of

Reals = np.ndarray[Any, np.dtype[Any]]
QUARTER = 90.0
"""Angles near which links count are whole quarter turns from the stated ones, in degrees."""
FAR, STEP = 135.0, 45.0
"""Degrees from such an angle beyond which another is taken, and the largest single step.

Together they are less than half a turn.
"""
FIRST, MOST = 64, 8192
"""Positions run at once, at first and at most, until a link counts near another angle."""
PARTS = 16
"""Parts into which an interval is cut where a link turns by a larger step."""
ENOUGH = 1e-9
"""Share of the interval below which it is not cut further: there a link jumps."""


class Followed:
    """Links followed along a sweep in one direction, with the angles near which they count."""

    def __init__(self, start: float, near: Mapping[str, float]) -> None:
        self.places, self.near = [start], [dict(near)]

    @property
    def now(self) -> Mapping[str, float]:
        """The angles near which they count from the last position on."""
        return self.near[-1]

    def counts_on(self, at: float, angles: Mapping[str, float]) -> bool:
        """Whether they count near other angles from a position on, given their angles there."""
        moved = {link: angle - self.now[link] for link, angle in angles.items()}
        if max(map(abs, moved.values()), default=0.0) <= FAR:
            return False
        quarters = {link: QUARTER * round(by / QUARTER) for link, by in moved.items()}
        self.places.append(at)
        self.near.append({link: near + quarters[link] for link, near in self.now.items()})
        return True

    def turned(self, stop: float) -> Turned:
        """The followed angles up to a given u."""
        places, near = self.places, self.near
        if stop < places[0]:
            places, near = [stop, *places[:0:-1]], near[::-1]
        return Turned(np.array(places), {m: np.array([row[m] for row in near]) for m in near[0]})


def following(course: Course, start: float, links: Iterable[str] | None = None) -> Followed:
    """The start of following some links, by default all counted ones, with the course's angles."""
    known = course.values(np.array([start]))
    some = course.counting if links is None else links
    near = {link: float(np.ravel(known[name_of(link)])[0]) for link in some}
    return Followed(start, near)


def led(
    course: Course,
    start: float,
    stop: float,
    step: float = 0.0,
    links: Sequence[str] | None = None,
) -> Course:
    """The course with counted links, or some of them, followed from one u to another.

    At the start they count as the course states. Where nothing closes, they keep their angles. The
    grid is coarser with ``step``. Between two of its positions, a link must turn by less than a
    turn minus the largest step.
    """
    if not (course.counting if links is None else links) or start == stop:
        return course
    way = abs(stop - start)
    count = max(int(np.ceil(way / max(abs(course.sweep.grid_step), step))), 1)
    ahead = np.linspace(start, stop, count + 1).tolist()[::-1]
    followed, passed = following(course, start, links), start
    last: dict[str, float] = {}
    size = FIRST
    while ahead:
        places = np.array(ahead[: -size - 1 : -1])
        angles = angles_near(course, places, followed.now)
        done = as_far(angles, followed.now, last)
        if done:
            passed, last = float(places[done - 1]), last_of(angles, done) or last
            del ahead[-done:]
            size = min(2 * size, MOST) if done == len(places) else FIRST
        elif followed.counts_on(passed, last):
            continue
        elif abs(places[0] - passed) > ENOUGH * way:
            ahead += np.linspace(places[0], passed, PARTS + 1)[1:-1].tolist()
        else:
            last = last_of(angles, 1)
    return course.along(turned=followed.turned(stop).beside(course.turned))


def led_both(course: Course, start: float, low: float, high: float, step: float = 0.0) -> Course:
    """The course with these angles followed from one u in both directions."""
    before, after = (led(course, start, end, step).turned for end in (low, high))
    turned = before.joined(after) if before is not None else after
    return course.along(turned=turned)


def angles_near(course: Course, at: Reals, near: Mapping[str, float]) -> dict[str, Reals]:
    """The angles of links (degrees) at some u, each within half a turn of a given one."""
    kept = {name_of(link): np.full(len(at), angle) for link, angle in near.items()}
    values = course.values(at) | kept
    rows = course.counted(values, at, near)
    return {link: np.degrees(row) for link, row in rows.items()}


def as_far(
    angles: Mapping[str, Reals], near: Mapping[str, float], last: Mapping[str, float]
) -> int:
    """The number of positions before a link turns too far from its angle, or by too large a step.

    Positions where nothing closes are skipped; ``last`` is empty before the first that closes.
    """
    good = np.isfinite(np.array([*angles.values()])).all(axis=0)
    places = np.flatnonzero(good)
    if not places.size:
        return len(good)
    over = np.zeros(len(places), dtype=bool)
    for link, row in angles.items():
        before = np.append(last.get(link, row[places[0]]), row[places])[:-1]
        away = np.abs(before - near[link]) > FAR
        away[0] &= bool(last)
        over |= away | (np.abs(row[places] - before) > STEP)
    return int(places[np.argmax(over)]) if over.any() else len(good)


def last_of(angles: Mapping[str, Reals], done: int) -> dict[str, float]:
    """The angles at the last position that closes; empty without one."""
    rows = np.array([row[:done] for row in angles.values()])
    good = np.flatnonzero(np.isfinite(rows).all(axis=0))
    return {} if not good.size else {link: float(row[good[-1]]) for link, row in angles.items()}
