"""The search for points in a drawing: first near where they are expected, then after a mistake.

Near the expected place, a point is where the lines to it cross, where a single line ends, or where
others leave that line. After a mistake, the search follows rays from the known points. A place is
more likely the better its lines are drawn, end there and run as expected, and the better the steps
that follow from it are drawn.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.accuracy.pencil import Pencil, step_drawn
from graphkin.construction.core.program import Plane
from graphkin.drawing.field import Rect
from graphkin.numbers.plane import Line
from graphkin.reading.drawn_ink import COVERED, PAPER, PITCH, DrawnInk, InkLine
from graphkin.reading.lettered_points import AHEAD, LONGEST, SHORT, Leading, LetteredSheet
from graphkin.reading.vector_ends import RINGS, is_headed, is_marked

CROSSING = 0.12
"""Least sine of the angle between two lines whose crossing gives a point."""
PASSES = 0.45
"""A line passes through a point that is at most this many mm from it."""


class LinesCrossing(Struct, frozen=True):
    """A place where lines cross: its covariance, the number of lines, and the drawn share of them.

    ``ends``: a single line ends there.
    """

    place: complex
    error: Any
    count: int
    cover: float
    ends: bool = False


def met(one: InkLine, other: InkLine) -> complex | None:
    """Where two lines meet; None where they cross too flatly."""
    if abs(sine(one.way, other.way)) < CROSSING:
        return None
    along = ((other.start - one.start) * other.way.conjugate()).imag / (
        (one.way * other.way.conjugate()).imag
    )
    return one.start + along * one.way


def sine(one: complex, other: complex) -> float:
    """The sine of the angle between two directions."""
    return (one.conjugate() * other).imag / abs(one) / abs(other)


def are_crossing(ends: Sequence[complex], place: complex) -> bool:
    """Whether any two of the lines from some ends to a place cross there."""
    ways = [end - place for end in ends]
    return any(abs(sine(*both)) > CROSSING for both in combinations(ways, 2))


def along_way(way: complex, along: float, across: float) -> Any:
    """The covariance of a place with given deviations along and across a direction."""
    turned = np.array([[way.real, -way.imag], [way.imag, way.real]])
    return turned @ np.diag([along**2, across**2 + PAPER**2 / 2]) @ turned.T


def distinct(lines: list[list[InkLine]], place: complex) -> list[list[InkLine]]:
    """The groups of lines to a point, with each line that was found twice kept only once."""
    kept: list[list[InkLine]] = []
    seen: list[InkLine] = []
    for some in lines:
        fresh = [line for line in some if not any(is_same(line, other, place) for other in seen)]
        seen += fresh
        if fresh:
            kept.append(fresh)
    return kept


def is_same(one: InkLine, other: InkLine, place: complex) -> bool:
    """Whether two lines are the same stroke near a place."""
    turn = abs(np.angle(one.way / other.way))
    flat = min(turn, np.pi - turn) < np.radians(1.2)
    return bool(flat and abs(abs(one.off(place)) - abs(other.off(place))) < 0.3)


def through(
    place: complex, lines: Sequence[Sequence[InkLine]], within: float = PASSES
) -> LinesCrossing | None:
    """The place nearest to all lines that pass near a place, one per group; None if too few."""
    chosen = []
    for some in lines:
        near = [line for line in some if abs(line.off(place)) < within and line.cover >= 0.5]
        if near:
            chosen.append(max(near, key=lambda line: line.cover - abs(line.off(place))))
    if len(chosen) < 2:
        return None
    normals = np.array([[-line.way.imag, line.way.real] for line in chosen])
    offs = np.array([line.off(place) for line in chosen])
    trust = 1 / np.array([line.error for line in chosen]) ** 2
    normal_matrix = (normals * trust[:, None]).T @ normals
    if np.linalg.eigvalsh(normal_matrix)[0] < trust.min() * CROSSING**2 / 2:
        return None
    shift = np.linalg.solve(normal_matrix, -(normals * trust[:, None]).T @ offs)
    error = np.linalg.inv(normal_matrix) + np.eye(2) * PAPER**2 / 2
    cover = float(np.mean(sorted((line.cover for line in chosen), reverse=True)[:2]))
    return LinesCrossing(place + complex(*shift), error, len(chosen), cover)


# --- where a point is expected, from the cloud of its drawings ------------------------------------


CLOSE, ROOM, WIDEST = 0.7, 0.3, 10.0
"""Least half width of the search window, the margin added to the cloud's width, and the most; mm.
"""


class ExpectedPlace(Struct, frozen=True):
    """The expected place of a point: the middle of a cloud (complex mm), and its covariance."""

    middle: complex
    spread: Any

    @property
    def reach(self) -> float:
        """Half the width of the window in which the point is searched for, in mm."""
        wide = 3 * float(np.sqrt(max(np.linalg.eigvalsh(self.spread)[-1], 0.0)))
        return min(max(wide, CLOSE) + ROOM, WIDEST)

    @property
    def radius(self) -> float:
        """The radius in mm around the middle that holds 95 of 100 drawings."""
        return 2.4477 * float(np.sqrt(np.trace(self.spread) / 2))

    def away(self, place: complex, error: Any) -> float:
        """The squared distance of a place, in combined standard deviations of both."""
        off = np.array([(place - self.middle).real, (place - self.middle).imag])
        return float(off @ np.linalg.solve(self.spread + error, off))

    def weighed(self, found: LinesCrossing) -> complex:
        """A place that fits, moved towards the expected one as far as its lines are uncertain."""
        off = np.array([(found.place - self.middle).real, (found.place - self.middle).imag])
        share = np.linalg.solve(self.spread + found.error, off)
        return self.middle + complex(*(self.spread @ share))

    def narrowed(self, cloud: Any, found: LinesCrossing, errors: Any) -> Any:
        """A cloud that fits, each place moved towards the found one as ``weighed`` does.

        ``errors`` are standard normal numbers of shape (count, 2) for the uncertainty of the lines.
        """
        lines = np.linalg.cholesky(found.error) @ errors.T
        seen = np.array([[found.place.real], [found.place.imag]]) + lines
        off = seen - np.stack([cloud.real, cloud.imag])
        shift = self.spread @ np.linalg.solve(self.spread + found.error, off)
        return cloud + shift[0] + 1j * shift[1]


def expected(cloud: Any) -> ExpectedPlace:
    """The expected place that a cloud gives."""
    cloud = np.atleast_1d(np.asarray(cloud, dtype=complex))
    cloud = cloud[np.isfinite(cloud)]
    if not len(cloud):
        return ExpectedPlace(complex("nan"), np.eye(2))
    middle = complex(np.median(cloud.real), np.median(cloud.imag))
    off = cloud - middle
    near = off[abs(off) <= np.percentile(abs(off), 98)]
    if len(near) < 8:
        return ExpectedPlace(middle, np.eye(2) * PAPER**2)
    spread = np.cov(np.stack([near.real, near.imag])) * 1.08 + np.eye(2) * PAPER**2
    return ExpectedPlace(middle, spread)


# --- the search for points in a drawing -----------------------------------------------------------


DRAWINGS, SEED = 300, 23
"""Number of drawings in a cloud, and the seed of their errors."""
KNOWN, GUESSED = 0.6, 1.6
"""Half width in mm of the window at the far end of a line: a point that was read, or was not."""
FITS, SURE = 11.0, 6.5
"""Squared distance from the expected place, in deviations, up to which a place fits.

SURE is the distance up to which no person is asked.
"""
CLOSE_BY = 1.2
"""How close to its expected place, in mm, the end of a single line counts as the point.

A point whose place the pencil leaves vague counts as right within the same distance.
"""
DRAWN = 0.7
"""The least share of a line that must be drawn for the line to count."""
PRINTED = 0.3
"""Standard deviation of a hand-drawn mark across the printed line of a guide, in mm."""
END, NODE, SPOT = 0.8, 0.5, 0.2
"""Standard deviations in mm: of a line's end, of where others leave it, of a point's mark."""
TURN, PACE, BEGIN = 0.3, 0.5, 2.5
"""Steps of a fan of rays, in degrees and in mm, and the distance in mm at which rays begin."""
AGREED = 0.5
"""The least share of the lines from known ends to a point that must be drawn."""
RECENT = 8
"""The steps of a ray of which more than half must be drawn."""
RAY, MOST_RAYS, PARTED, BREAK = 7.0, 16, 0.8, 8
"""The shortest ray that counts, in mm, and the most rays of a place.

PARTED is the least angle between rays in degrees; BREAK is the number of empty steps that ends one.
"""
SHORTENED = 9.0
"""How far a line's end may be from its ray's end, in mm: a ray leaves a line where it turns."""
BROAD = 0.6
"""A ray that ends this close to a longer one, in mm, is part of that ray's broad stroke."""
EXPLAINED = 0.5
"""The weight of a line to a place that goes on from there to another known point."""
JOINS = 0.3
"""The bonus where another line leaves the single line to a place."""
SURELY, WAYS, ALONE = 0.9, 3, 0.75
"""A place to which WAYS lines are drawn to the share SURELY needs nothing to follow from it.

ALONE is the score of such a place.
"""
RINGED = 0.4
"""The bonus of a crossing at which a dot or a ring marks a point."""
STOPS, OVER = 0.4, 6.0
"""The score where vectors end at a place, and how far beyond it that is examined, in mm."""
KEPT, LEANS = 0.3, 0.02
"""The score where the expected lines pass through a place, and by how much they may turn."""
ENOUGH, AS_EXPECTED = 1.8, 0.3
"""The least total score of an unexpected place, and the advance of an expected one."""
APART = 1.5
"""Closer than this to a known point, in mm, another point cannot be distinguished from it."""
SAME = 0.7
"""Two points closer than this, in mm, are one on paper."""
LAST = 6.0
"""The last piece of a line up to a point, in mm."""
MOST_KEPT = 4096
"""So many lines and shares of lines are kept: about half of them are asked for again."""
TRIED = 10
"""The number of places that are also judged by what would follow from them."""


class PointSearch:
    """Searches for the points of one sheet, each from those that were read before it."""

    def __init__(self, sheet: LetteredSheet, ink: DrawnInk, pencil: Pencil) -> None:
        self.sheet, self.ink, self.pencil = sheet, ink, pencil
        self.lines, self.cover = lru_cache(MOST_KEPT)(ink.lines), lru_cache(MOST_KEPT)(ink.cover)
        self.own: dict[int, complex] = {}
        self.unread: set[int] = set()
        self.guessed: set[int] = set()
        self.next: Mapping[int, Any] = {}
        self.drawings: Mapping[int, Any] = {}
        self.fans: dict[complex, list[tuple[complex, float]]] = {}

    # --- what is expected -------------------------------------------------------------------------

    def drawn(self, number: int, found: Mapping[int, Any], count: int) -> Any:
        """The value of a step in ``count`` drawings; with a count of 1, without errors."""
        exact = self.sheet.exact
        mark = exact.marks.get(number)
        errors = None
        if mark is not None:
            size = (count, mark.errors)
            errors = np.zeros(size) if count == 1 else self.stream(number).standard_normal(size)
        return step_drawn(exact, number, found, errors, self.pencil)

    def stream(self, number: int, which: int = 0) -> np.random.Generator:
        """The random errors of a step: always the same, and independent of those of other steps."""
        return np.random.Generator(np.random.PCG64([SEED, number, which]))

    def clouds(self) -> dict[int, Any]:
        """The value of every step in many drawings of the key."""
        found = dict(self.sheet.exact.trace.values)
        with np.errstate(all="ignore"):
            for number in self.sheet.order:
                found[number] = self.drawn(number, found, DRAWINGS)
        return found

    def ahead(self) -> dict[int, Any]:
        """The value of every step as it follows from the student's points."""
        found = dict(self.sheet.exact.trace.values)
        with np.errstate(all="ignore"):
            for number in self.sheet.order:
                if number in self.own:
                    found[number] = self.sheet.value(number, self.own[number])
                else:
                    found[number] = self.drawn(number, found, 1)
        return found

    def after(self, number: int, place: complex) -> dict[int, Any]:
        """``ahead`` with one more point, from ``next``: only what depends on it is computed."""
        found, fresh = dict(self.next), {number}
        found[number] = self.sheet.value(number, place)
        with np.errstate(all="ignore"):
            for other in self.sheet.order:
                follows = not fresh.isdisjoint(self.sheet.sources[other])
                if follows and other != number and other not in self.own:
                    found[other] = self.drawn(other, found, 1)
                    fresh.add(other)
        return found

    def far_place(self, leading: Leading, values: Mapping[int, Any]) -> complex:
        """The place of the far end of a line."""
        if leading.far in self.own:
            return self.own[leading.far]
        value = values[leading.far]
        if leading.back:
            value = value.tail
        return complex(np.ravel(self.sheet.place(leading.far, value))[0])

    def is_known(self, leading: Leading) -> bool:
        """Whether the far end was read, is printed, or is a line from such a point."""
        steps = self.sheet.exact.program.steps
        step = steps[leading.far]
        if leading.after:
            return False
        if isinstance(self.sheet.exact.trace.values[leading.far], Line):
            first = step.args[0] if step.args else leading.far
            return first in self.own or not steps[first].args
        return leading.far in self.own or not step.args

    # --- how much is drawn ------------------------------------------------------------------------

    def holds(self, number: int, best: LinesCrossing | None, where: ExpectedPlace) -> bool:
        """Whether the found crossing fits a point and enough of its lines are drawn."""
        if best is None or where.away(best.place, best.error) > FITS:
            return False
        agreed = self.agreement(number, best.place, read=best.count > 1)
        return agreed >= AGREED or self.is_clear(number, best, where)

    def is_clear(self, number: int, best: LinesCrossing | None, where: ExpectedPlace) -> bool:
        """Whether lines cross so clearly at the expected place that one vector may be missing."""
        if best is None or best.count < 2 or best.cover < SURELY:
            return False
        near = abs(best.place - where.middle) <= CLOSE_BY
        near = near and where.away(best.place, best.error) <= SURE
        ways = [
            self.far_place(each, self.next)
            for each in self.sheet.leading[number]
            if (self.cover_of(number, each, best.place) or 0.0) >= SURELY
        ]
        near = near and are_crossing(ways, best.place)
        return near and self.agreement(number, best.place, lacking=1) >= SURELY

    def agreement(
        self, number: int, place: complex, *, read: bool = False, lacking: int = 0
    ) -> float:
        """The drawn share of the lines from known ends to a place.

        In a plan that is the worst of the arrows and lines, without the ``lacking`` worst. On a
        mechanism it is the mean of the best two bars, because nobody draws them all. With ``read``,
        only ends that were surely read count.
        """
        covers = sorted(self.covers(number, place, read), reverse=True)
        if not covers:
            return 1.0
        if self.sheet.field(number) is self.sheet.layout.mechanism:
            return float(np.mean(covers[:2]))
        return covers[max(min(1, len(covers) - 1), len(covers) - 1 - lacking)]

    def covers(self, number: int, place: complex, read: bool) -> list[float]:
        """The drawn share of each line to a place that gives evidence."""
        return [
            found
            for each in self.sheet.leading[number]
            if not (each.light or (read and self.is_unsure(each)))
            if (found := self.cover_of(number, each, place)) is not None
        ]

    def is_unsure(self, leading: Leading) -> bool:
        """Whether the far end, or the start of the far line, was not surely read."""
        return bool(self.begins(leading) & (self.unread | self.guessed))

    def begins(self, leading: Leading) -> set[int]:
        """The step at the far end, and the step at which a far line begins."""
        steps = {leading.far}
        if isinstance(self.sheet.exact.trace.values[leading.far], Line):
            steps |= set(self.sheet.exact.program.steps[leading.far].args[:1])
        return steps

    def is_vague(self, leading: Leading) -> bool:
        """Whether the start of a line is too uncertain to search for the line."""
        value = self.drawings.get(leading.far)
        if value is None:
            return False
        cloud = self.sheet.place(leading.far, value.tail if leading.back else value)
        return expected(cloud).radius > GUESSED

    def is_reached(self, number: int, place: complex) -> bool:
        """Whether lines cross at a place without those that only point at it and end before it.

        Lines that end before the place and start from unknown ends belong to another point.
        """
        ends, ending = list[complex](), False
        for each in self.sheet.leading[number]:
            far = self.far_place(each, self.next)
            if each.bow or each.given:
                return True
            found = self.lines(far, place, GUESSED, PASSES) if abs(far - place) > SHORT else []
            start = max(found, key=lambda line: line.cover).start if found else place
            if abs(start - place) > SHORT:
                way = (start - place) / abs(start - place)
                last = place + way * min(abs(start - place), LAST)
                if self.cover(last, place, 0.4, hidden=1.0) >= DRAWN:
                    ends.append(start)
                else:
                    ending = ending or not (each.after or self.is_known(each))
        return not ending or are_crossing(ends, place)

    def is_single(self, number: int, place: complex) -> bool:
        """Whether only one line from a known end leads to a point."""
        ends = self.known_ends(number)
        return not self.is_open(number) and not are_crossing(ends, place)

    def is_open(self, number: int) -> bool:
        """Whether a line by which a point is constructed begins at an unknown place."""
        later = self.sheet.exact.program.descendants(number)
        return any(
            not (each.after or each.given or each.bow or self.is_known(each))
            for each in self.sheet.leading[number]
            if each.far not in later
        )

    def cover_of(self, number: int, leading: Leading, place: complex) -> float | None:
        """The drawn share of a line to a place; None where the line gives no evidence."""
        far = self.far_place(leading, self.next)
        if leading.given or leading.bow or leading.after or abs(far - place) < 2 * SHORT:
            return None
        if self.begins(leading) & self.guessed:
            found = self.lines(far, place, GUESSED, 0.5)
            return max((line.cover for line in found), default=None)
        if leading.far in self.own or (self.is_known(leading) and leading.far not in self.unread):
            return self.cover(far, place, 0.4, hidden=1.0, arrives=True)
        value = self.sheet.exact.trace.values[leading.far]
        if not isinstance(value, Line) and leading.far not in self.unread:
            return None
        if self.is_vague(leading):
            return None
        found = self.lines(far, place, GUESSED, 0.5)
        return max((line.cover for line in found), default=0.0)

    # --- near the expected place ------------------------------------------------------------------

    def best_near(self, number: int, where: ExpectedPlace) -> LinesCrossing | None:
        """The best crossing of the lines to a point near its expected place."""
        lines = [
            some
            for leading in self.sheet.leading[number]
            if (some := self.lines_near(number, leading, where))
        ]
        lines = distinct(lines, where.middle)
        best, most = None, 0.0
        for one, other in combinations(range(len(lines)), 2):
            for first in lines[one]:
                for second in lines[other]:
                    place = met(first, second)
                    if place is None or abs(place - where.middle) > 1.6 * where.reach:
                        continue
                    found = through(place, lines)
                    if found is None:
                        continue
                    away = where.away(found.place, found.error)
                    score = found.cover * found.count - 0.03 * min(away, 40.0)
                    if score > most - RINGED and is_marked(self.ink, found.place, RINGS):
                        score += RINGED
                    if score > most:
                        best, most = found, score
        return best or self.end_near(number, lines, where)

    def end_near(
        self, number: int, lines: Sequence[Sequence[InkLine]], where: ExpectedPlace
    ) -> LinesCrossing | None:
        """The place of a point on a single line near where it is expected.

        It is where others leave the line, else its end. Where the line goes on, or other points are
        expected nearby, it is the expected place on the line. That place counts as an end if other
        lines run there too, too flatly to cross the line.
        """
        ends = [
            self.far_place(each, self.next)
            for each in self.sheet.leading[number]
            if self.is_known(each) and not (each.given or each.bow or each.after)
        ]
        flat = [
            some
            for some in lines
            if any(e.cover >= DRAWN and abs(e.off(where.middle)) < PASSES for e in some)
        ]
        for line in (line for some in lines for line in some):
            if line.cover < DRAWN or abs(line.off(where.middle)) > where.reach:
                continue
            straight = InkLine(line.start, where.middle, 1, 1)
            if any(abs(line.off(e)) < PASSES and abs(straight.off(e)) > 2 * PASSES for e in ends):
                continue  # a line to that other end
            foot = where.middle - 1j * line.way * line.off(where.middle)
            found = self.ink.stroke(foot, line.way, where.reach)
            if found is not None:
                shift, along, count = self.headed_end(number, line, foot, found.end), NODE, 2
                if shift is None:
                    shift = self.ink.node(foot, line.way, where.reach)
                if shift is None and line.error == PRINTED:
                    shift, along = self.marked_along(foot, line.way, where.reach), SPOT
                    if shift is None:
                        shift = self.ink.on_print(foot, line.way, where.reach)
                if shift is None:
                    shift, along, count = found.end, END, 1
                    mark = self.marked_along(foot, line.way, where.reach)
                    if mark is not None and (shift is None or abs(mark) < abs(shift) + SPOT):
                        shift, along = mark, SPOT
                        count = 1 if self.is_open(number) else 2
                stops = count == 1 and shift is not None
                place = foot + line.way * (shift or 0.0)
                if along == SPOT and self.ink.is_marked_beside(place, line.way):
                    count, stops = 1, False
                near = any(abs(place - e) < SHORT for e in ends)
                if shift is None or near or not self.is_own(number, place, where):
                    shift, along, count, stops = 0.0, where.reach, 1, len(flat) > 1
                place, error = foot + line.way * shift, along_way(line.way, along, line.error)
                return LinesCrossing(place, error, count, line.cover, stops)
        return None if any(lines) else self.marked(number, where)

    def headed_end(
        self, number: int, line: InkLine, foot: complex, end: float | None
    ) -> float | None:
        """The end of a line, in mm from a place on it, if the head of a vector to a point is there.

        The sides of that head are no lines that leave the line.
        """
        if end is None or all(each.tip != number for each in self.sheet.arrows):
            return None
        tip = foot + end * line.way
        if not is_headed(self.ink, line.start, tip):
            return None
        return end + self.ink.runs_on(tip, line.way)

    def marked_along(self, foot: complex, way: complex, reach: float) -> float | None:
        """The position along a line, in mm from a place on it, of a marked point, if any."""
        along = np.arange(-reach, reach + PITCH, PITCH)
        place = self.ink.spot(foot + along * way, way)
        return None if place is None else float(((place - foot) / way).real)

    def marked(self, number: int, where: ExpectedPlace) -> LinesCrossing | None:
        """The place of a marked point that no line leads to, such as a point on a printed guide."""
        side = np.arange(-where.reach, where.reach + PITCH, PITCH)
        places = (where.middle + side[:, None] + 1j * side[None, :]).ravel()
        place = self.ink.spot(places, None)
        if place is None or not self.is_own(number, place, where):
            return None
        return LinesCrossing(place, np.eye(2) * SPOT**2, 2, 1.0)

    def is_own(self, number: int, place: complex, where: ExpectedPlace) -> bool:
        """Whether a place belongs to a point, not to another point expected nearby."""
        steps = self.sheet.exact.program.steps
        far = abs(place - where.middle) + APART
        for other in {*self.sheet.points, *self.sheet.corners} - {number}:
            if steps[other].plane is steps[number].plane:
                there = self.own.get(other)
                if there is None:
                    there = complex(np.ravel(self.sheet.place(other, self.next[other]))[0])
                if abs(there - where.middle) > SAME and abs(there - place) < far:
                    return False
        return True

    def lines_near(self, number: int, leading: Leading, where: ExpectedPlace) -> list[InkLine]:
        """The drawn lines that may be the line to a point."""
        values = self.next
        if leading.given:
            return [self.printed_line(leading)]
        if leading.bow:
            return self.arcs_near(leading, where)
        far = self.far_place(leading, values)
        target, beside = where.middle, KNOWN if self.is_known(leading) else GUESSED
        value = values[leading.far]
        if isinstance(value, Line) and abs(far - target) < SHORT:
            way = complex(np.ravel(value.along)[0]).conjugate()
            far, beside = target - AHEAD * way / abs(way), GUESSED
        if not np.isfinite(far) or abs(far - target) < SHORT:
            return []
        return self.lines(far, target, beside, where.reach)

    def printed_line(self, leading: Leading) -> InkLine:
        """A printed guide, up to where it begins."""
        start = self.far_place(leading, self.next)
        way = complex(np.ravel(self.next[leading.far].along)[0]).conjugate()
        return InkLine(start - LONGEST * way / abs(way), start, 1.0, PRINTED)

    def arcs_near(self, leading: Leading, where: ExpectedPlace) -> list[InkLine]:
        """The compass arc near the expected place of a point, as its tangent lines there."""
        circle = self.next[leading.far]
        field = self.sheet.field(leading.far)
        centre = complex(np.ravel(self.sheet.place(leading.far, circle.centre))[0])
        radius = float(np.ravel(circle.radius)[0]) * field.mm
        return self.ink.arcs(centre, radius, where.middle, where.reach)

    # --- after a mistake --------------------------------------------------------------------------

    def best_far(
        self, number: int, where: ExpectedPlace, besides: complex = complex("inf")
    ) -> LinesCrossing | None:
        """The best place for a point that is not where it is expected; None without a good one.

        Candidates come from the rays that leave the known ends, and are judged by their lines and
        by what would follow from them. ``besides`` is a place to leave out.
        """
        ends = self.known_ends(number)
        crossed = are_crossing(ends, where.middle)
        places = self.candidates(number, ends, crossed)
        plane = self.sheet.exact.program.steps[number].plane
        tried = self.tried_points(plane).values()
        taken = [*self.own.values(), *ends, *tried, besides]
        plausible = [
            place
            for place in places
            if in_fields(place, self.ink.paper.fields)
            and all(abs(place - other) > 2 * APART for other in taken)
            and sum(abs(place - end) > 2 * SHORT for end in ends) >= min(2, len(ends))
        ]
        first = sorted(
            ((self.led_to(number, place, ends, crossed), place) for place in plausible),
            key=lambda each: -each[0] + 0.002 * abs(each[1] - where.middle),
        )
        scored: list[tuple[float, LinesCrossing]] = []
        for roughly, rough in first[:TRIED]:
            if roughly < DRAWN:
                break
            found = self.settled(number, rough)
            place = found.place
            if self.agreement(number, place, read=True) < AGREED:
                continue
            if any(abs(place - other) < 2 * APART for other in taken):
                continue
            led = self.led_to(number, place, ends, crossed)
            score = led + self.follows(number, place, ends) - 0.003 * abs(place - where.middle)
            if score > ENOUGH:
                scored.append((score, found))
        return max(scored, key=lambda each: each[0])[1] if scored else None

    def tried_points(self, plane: Plane) -> dict[int, complex]:
        """The expected places of lettered points of trial plans, by step; lines belong to them."""
        steps, values = self.sheet.exact.program.steps, self.sheet.exact.trace.values
        return {
            number: complex(np.ravel(self.sheet.place(number, self.next[number]))[0])
            for number, value in values.items()
            if steps[number].aside is not None
            and steps[number].name
            and isinstance(value, complex)
            and steps[number].plane is plane
        }

    def follows(self, number: int, place: complex, ends: Sequence[complex]) -> float:
        """How well what would follow from a place is drawn; ALONE or more if its lines are."""
        sure = len(ends) >= WAYS and self.agreement(number, place, read=True) >= SURELY
        return max(self.followed(number, place), ALONE * sure)

    def likely(self, number: int, place: complex, where: ExpectedPlace) -> float:
        """The score of a place: its lines, what would follow, and the lines from known ends."""
        ends = self.known_ends(number)
        led = self.led_to(number, place, ends, are_crossing(ends, where.middle))
        return led + self.follows(number, place, ends) + self.agreement(number, place)

    def led_to(self, number: int, place: complex, ends: Sequence[complex], crossed: bool) -> float:
        """How well the lines to a place are drawn, end there and run as expected."""
        printed = [self.far_place(e, self.next) for e in self.sheet.leading[number] if e.given]
        support = self.supported(place, ends, crossed, printed)
        return support + self.stopped(number, place) + self.on_lines(number, place)

    def known_ends(self, number: int) -> list[complex]:
        """The known ends of the lines to a point, no two of them close together."""
        found: list[complex] = []
        for each in self.sheet.leading[number]:
            if self.is_known(each) and not (each.bow or each.after or each.light):
                end = self.far_place(each, self.next)
                if np.isfinite(end) and all(abs(end - other) > SHORT for other in found):
                    found.append(end)
        return found

    def candidates(self, number: int, ends: Sequence[complex], crossed: bool) -> list[complex]:
        """Candidate places: where rays from some ends end, or cross each other or printed lines.

        Where all known rays have one direction, also where other lines leave them.
        """
        guides = [self.printed_line(each) for each in self.sheet.leading[number] if each.given]
        printed = {line.end for line in guides}
        rays = [[] if end in printed else self.rays(end) for end in ends]
        places: list[complex] = []
        for end, some in zip(ends, rays, strict=True):
            for way, long in some:
                places.append(end + way * long)
                if not crossed:
                    places += self.ink.nodes(end, way, long + GUESSED)
                for line in guides:
                    place = met(InkLine(end, end + way, 1, 1), line)
                    if place is not None and SHORT < ((place - end) / way).real < long + 1.5:
                        places.append(place)
        for (end, some), (other, more) in combinations(zip(ends, rays, strict=True), 2):
            for way, long in some:
                for way2, long2 in more:
                    line, line2 = InkLine(end, end + way, 1, 1), InkLine(other, other + way2, 1, 1)
                    place = met(line, line2)
                    if place is None:
                        continue
                    t, t2 = ((place - end) / way).real, ((place - other) / way2).real
                    if SHORT < t < long + 1.5 and SHORT < t2 < long2 + 1.5:
                        places.append(place)
        return places

    def rays(self, start: complex) -> list[tuple[complex, float]]:
        """The drawn lines that leave a place: unit direction, and length in mm."""
        if start not in self.fans:
            self.fans[start] = self.fan(start)
        return self.fans[start]

    def fan(self, start: complex) -> list[tuple[complex, float]]:
        """The directions around a place in which something is drawn, and its length in mm."""
        angles = np.radians(np.arange(0, 360, TURN))
        radii = np.arange(BEGIN, 230.0, PACE)
        ways = np.exp(1j * angles)
        places = start + ways[:, None] * radii[None, :]
        dark, known = self.ink.at(places)
        drawn = ((dark > COVERED) | (known == 0)) & in_fields(places, self.ink.paper.fields)
        share = np.cumsum(drawn, axis=1) / np.arange(1, len(radii) + 1)
        alive = (share > 0.85) & (recent(drawn) > RECENT / 2) & unbroken(drawn)
        lengths = np.where(alive.any(1), radii[alive.shape[1] - 1 - alive[:, ::-1].argmax(1)], 0.0)
        sums = np.cumsum(np.clip(dark, 0, 1) * known, axis=1)
        reach = np.clip(((lengths - BEGIN) / PACE).astype(int), 0, len(radii) - 1)
        strength = sums[np.arange(len(angles)), reach]
        found: list[tuple[complex, float]] = []
        for i in np.argsort(-strength):
            if lengths[i] < RAY or strength[i] < 5 or len(found) >= MOST_RAYS:
                break
            far = complex(ways[i]) * float(lengths[i])
            if all(is_parted(far, way, long) for way, long in found):
                found.append((complex(ways[i]), float(lengths[i])))
        return found

    def supported(
        self, place: complex, ends: Sequence[complex], crossed: bool, printed: Sequence[complex]
    ) -> float:
        """How well the lines from some ends to a place are drawn.

        That is the best two that cross there if a crossing is expected, else all of them, with a
        bonus where another line leaves. Ends in ``printed`` count as fully drawn if print hides
        their lines.
        """
        ways = [
            (
                self.cover(end, place, hidden=float(end in printed), arrives=True)
                * (EXPLAINED if self.goes_on(end, place) else 1.0),
                end - place,
            )
            for end in ends
        ]
        ways = sorted((each for each in ways if abs(each[1]) > SHORT), key=lambda each: -each[0])
        if not ways:
            return 0.0
        cover, way = ways[0]
        if not crossed:
            leaves, _ = self.ink.leaving(np.array([place]), way / abs(way), 6.0)
            return float(np.mean([each for each, _ in ways])) + JOINS * float(leaves.max())
        crossing = [other for other, way2 in ways[1:] if abs(sine(way, way2)) > CROSSING]
        return (cover + crossing[0]) / 2 if crossing else cover / 2

    def goes_on(self, end: complex, place: complex) -> bool:
        """Whether the line drawn from an end to a place goes on to another known point."""
        far = abs(place - end)
        for other in self.own.values():
            along, beside = (z := (other - end) * (place - end).conjugate() / far).real, z.imag
            if along > far + 2 * APART and abs(beside) < PASSES:
                return True
        return False

    def on_lines(self, number: int, place: complex) -> float:
        """The score for expected lines that pass through a place; a mistake turns only one."""
        kept = []
        for each in self.sheet.leading[number]:
            line = self.next[each.far]
            if isinstance(line, Line) and not each.after and self.is_known(each):
                start = self.far_place(each, self.next)
                way = complex(np.ravel(line.along)[0]).conjugate()
                off = abs(((place - start) * way.conjugate()).imag) / abs(way)
                kept.append(off < PASSES + LEANS * abs(place - start))
        return KEPT * float(np.mean(kept)) if kept else KEPT / 2

    def stopped(self, number: int, place: complex) -> float:
        """The score for vectors that end at a place."""
        beyond = self.beyond(number, place)
        return STOPS * (1 - float(np.mean(beyond))) if beyond else STOPS / 2

    def beyond(self, number: int, place: complex, to: complex | None = None) -> list[float]:
        """The drawn share beyond a place of each vector that comes to it from a known end.

        With ``to``, only of the vectors that run on to that other place.
        """
        found = []
        for each in self.sheet.leading[number]:
            if each.arrow and self.is_known(each):
                far = self.far_place(each, self.next)
                if to is not None and abs(sine(place - far, to - far)) > LEANS:
                    continue
                if abs(place - far) > 2 * SHORT:
                    way = (place - far) / abs(place - far)
                    first, last = place + OVER * way, place + 2 * OVER * way
                    found.append(self.cover(first, last, 0.3))
        return found

    def followed(self, number: int, place: complex) -> float:
        """How well the steps that would follow from a place are drawn."""
        values = self.after(number, place)
        covers = [
            self.cover_after(each, place, values)
            for each in self.sheet.leading[number]
            if each.after or not (self.is_known(each) or each.bow or self.is_unsure(each))
        ]
        if not covers:
            return 0.75
        return max(covers)

    def cover_after(self, leading: Leading, place: complex, values: Mapping[int, Any]) -> float:
        """The drawn share of a line from a place; of a line that begins there, the better way."""
        far, line = self.far_place(leading, values), values[leading.far]
        if not isinstance(line, Line) or abs(far - place) > SHORT:
            return self.cover(place, far, 0.8)
        way = complex(np.ravel(line.along)[0]).conjugate()
        ahead = AHEAD / 2 * way / abs(way)
        return max(self.cover(place, place + each, 0.8) for each in (ahead, -ahead))

    def settled(self, number: int, place: complex) -> LinesCrossing:
        """A found place, moved to where its lines cross exactly; else to where one of them ends."""
        values = self.after(number, place)
        lines = []
        for leading in self.sheet.leading[number]:
            far = self.far_place(leading, values)
            if not leading.bow and np.isfinite(far) and abs(far - place) > 2 * SHORT:
                some = self.lines(far, place, 0.8, GUESSED)
                lines += [some] if some else []
        found = through(place, distinct(lines, place), GUESSED)
        if found is not None:
            return found
        for line in sorted((e for some in lines for e in some), key=lambda e: -e.cover):
            foot = place - 1j * line.way * line.off(place)
            stroke = self.ink.stroke(foot, line.way, SHORTENED)
            if stroke is not None and stroke.end is not None:
                error = along_way(line.way, END, line.error)
                return LinesCrossing(foot + line.way * stroke.end, error, 1, DRAWN)
        return LinesCrossing(place, np.eye(2) * 0.25, 1, DRAWN)


def unbroken(drawn: Any) -> Any:
    """Which steps of each ray come before a gap of BREAK empty steps."""
    count = np.cumsum(drawn, axis=1)
    count[:, BREAK:] -= count[:, :-BREAK].copy()
    count[:, :BREAK] = 1
    return np.logical_and.accumulate(count > 0, axis=1)


def recent(drawn: Any) -> Any:
    """How many of the RECENT steps about each step of a ray are drawn."""
    before, after = RECENT // 2, RECENT - RECENT // 2 - 1
    count = np.cumsum(np.pad(drawn, ((0, 0), (before + 1, after))), axis=1)
    return count[:, RECENT:] - count[:, :-RECENT]


def is_parted(far: complex, way: complex, long: float) -> bool:
    """Whether a ray is a different line from one already found, not an edge of its broad stroke."""
    ratio = far / way
    same = abs(np.angle(ratio)) <= np.radians(PARTED)
    return not (same or (0 < ratio.real < long and abs(ratio.imag) < BROAD))


def in_fields(places: Any, fields: Rect) -> Any:
    """Whether places are inside the drawing fields."""
    x, y = np.real(places), np.imag(places)
    left, top, right, bottom = fields
    return (left < x) & (x < right) & (top < y) & (y < bottom)
