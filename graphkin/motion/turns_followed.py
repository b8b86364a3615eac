"""Links followed along a motion: the angles near which they count.

The number of driver turns after which a mechanism with wheels is back in its position.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import lcm, pi

import numpy as np

from graphkin.construction.core.program import Target
from graphkin.motion.course import Course, Reals
from graphkin.motion.driving import TURN
from graphkin.motion.sweep import Turned, name_of
from graphkin.text.errors import ClosureError, message

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
WITHIN, BESIDE = 16, 20_000
"""The most positions: so many times those of the grid, and so many more.

Where groups are closed at each of them, a tenth of the latter and a quarter of the former.
"""
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


class TooManyPositionsError(ClosureError):
    """A motion that would be followed through more positions of the driver than allowed."""


def following(course: Course, start: float, links: Iterable[str] | None = None) -> Followed:
    """The start of following some links, by default all counted ones, with the course's angles."""
    known = course.values(np.array([start]))
    some = course.counting if links is None else links
    near = {link: float(np.ravel(known[name_of(link)])[0]) for link in some}
    return Followed(start, near)


def led(
    course: Course, start: float, stop: float, step: float = 0.0, links: Sequence[str] | None = None
) -> Course:
    """The course with counted links, or some of them, followed from one u to another.

    At the start they count as the course states. Where nothing closes, they keep their angles. The
    grid is coarser with ``step``. Between two of its positions, a link must turn by less than a
    turn minus the largest step. Raises TooManyPositionsError.
    """
    if not (course.counting if links is None else links) or start == stop:
        return course
    way = abs(stop - start)
    count = max(int(np.ceil(way / max(abs(course.sweep.grid_step), step))), 1)
    ahead = np.linspace(start, stop, count + 1).tolist()[::-1]
    followed, passed = following(course, start, links), start
    last: dict[str, float] = {}
    size = FIRST
    is_dear = course.closing_work > 0
    most = WITHIN // 4 * count + BESIDE // 10 if is_dear else WITHIN * count + BESIDE
    left = most
    while ahead:
        if left < 0:
            raise too_many(course, most)
        places = np.array(ahead[: -size - 1 : -1])
        angles = angles_near(course, places, followed.now)
        done = as_far(angles, followed.now, last)
        left -= len(places) if is_dear else done + 1
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


def too_many(course: Course, positions: int) -> TooManyPositionsError:
    """The error for a motion that would be followed through more positions than allowed."""
    sweep = course.sweep
    found = message(
        "from {low:.10g} to {high:.10g} {unit} it has to be tried at more",
        low=sweep.low,
        high=sweep.high,
        unit=sweep.unit,
    )
    most = message("at most {most} positions of the driver", most=positions)
    return TooManyPositionsError.at(
        message("the cycle"), found, most, message("show less with --from and --to")
    )


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
