"""Points read as a marker reads them: in order, each expected from the points before it.

The expectation for a point is a cloud: many drawings of the construction, with pencil errors, from
the student's own earlier points. A place in that cloud is right, or follows from the student's own
mistake. All other places, and all doubtful ones, are left for a person to check.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from msgspec.structs import replace

from graphkin.accuracy.pencil import Pencil, unmarked
from graphkin.construction.core.program import Plane
from graphkin.numbers.plane import Line, Vector
from graphkin.reading.drawn_ink import DrawnInk
from graphkin.reading.lettered_points import SHORT, Arrow, Leading, LetteredSheet
from graphkin.reading.plan_causes import PlanCause, similarity_of
from graphkin.reading.point_letters import (
    ALPHABET,
    CLEARLY_EXCHANGED,
    WrittenPoint,
    exchanged,
)
from graphkin.reading.point_reading import Doubt, PointReading, ReadVerdict, pair
from graphkin.reading.point_search import (
    AGREED,
    AS_EXPECTED,
    CLOSE_BY,
    DRAWINGS,
    DRAWN,
    FITS,
    JOINS,
    PASSES,
    SAME,
    SURE,
    ExpectedPlace,
    LinesCrossing,
    PointSearch,
    are_crossing,
    expected,
    sine,
)
from graphkin.reading.vector_ends import VectorEnd, bar_runs_on, is_headed, vector_end

OUTSIDE, APART = 6.5, 3.0
"""Squared distance from the key, in deviations, beyond which the pencil does not explain a place.

95 of 100 places are within 6.0. APART is the distance in mm beyond which a place may follow from an
unseen mistake.
"""
RIVAL = 0.3
"""A person is asked if another place is likelier, or less likely by no more than this."""
OFF = 16.0
"""Squared distance from the key, in deviations, from which a place is clearly not at the key."""
VAGUE, MEET, BESIDE = 4.0, 3, 2.5
"""When a person still checks a point that fits: if the pencil explains more than VAGUE mm.

A vague point is not checked if at least MEET lines meet there, it is within BESIDE mm of the
expected place, and nothing before it on the sheet is wrong or missing. Where fewer lines meet, a
point farther than BESIDE is checked, and so is all that follows from it: another point's lines may
cross there.
"""
SLIGHT = 0.8
"""A place that fits and is no farther than this from where it is expected, in mm, is not off it."""
AT_KEY = 2.0
"""Squared distance from the key, in deviations, within which a point is at the key."""
ELSEWHERE = 0.6
"""How much likelier another place must be than one that fits, for the vectors to go there."""
NEARLY = 0.85
"""The drawn share of the lines to a point below which a person is asked."""
FULLY = 0.97
"""The drawn share of many lines that meet where a point was only vaguely expected."""
WHOLE = 0.9
"""The drawn share of a point's lines that is needed for it to count without a question."""
SHORTEST = 1e-3
"""Places closer than this, in mm, coincide."""
FLAT = 0.2
"""The most sine of the angle between a vector and a line whose ink may cover the vector's end."""
STRAYS = 4.0
"""How far from its expected place, in mm, the tail of a vector that was not read may be."""
LEVER = 15.0
"""Two points must be this many mm apart to give the direction of the line through them."""


class PointReader(PointSearch):
    """Reads one sheet by comparing what is drawn with what the construction expects."""

    def __init__(self, sheet: LetteredSheet, ink: DrawnInk, pencil: Pencil) -> None:
        super().__init__(sheet, ink, pencil)
        self.bad: set[int] = set()
        self.noted: set[int] = set()
        self.doubted: set[int] = set()
        self.vaguely: set[int] = set()
        self.strayed: set[int] = set()
        self.readings: dict[int, PointReading] = {}
        self.crossings: dict[int, LinesCrossing] = {}
        self.cause: PlanCause | None = None

    def read(self) -> tuple[PointReading, ...]:
        """The readings of all points of the sheet."""
        exact = self.sheet.exact
        keys = self.clouds()
        found = dict(exact.trace.values)
        self.next = self.drawings = found
        wanted, corners = set(self.sheet.points), set(self.sheet.corners)
        stale = True
        with np.errstate(all="ignore"):
            for number in self.sheet.order:
                found[number] = self.drawn(number, found, DRAWINGS)
                if number in self.sheet.short:
                    self.own[number] = expected(self.sheet.place(number, found[number])).middle
                if number not in wanted and number not in corners:
                    continue
                if stale:
                    self.next = self.ahead()
                cloud = np.atleast_1d(self.sheet.place(number, found[number]))
                own = expected(cloud)
                if number in corners:
                    best = self.read_corner(number, own)
                else:
                    key = expected(self.sheet.place(number, keys[number]))
                    reading = self.readings[number] = self.read_point(number, key, own)
                    if reading.at is not None:
                        self.own[number] = complex(*reading.at)
                    best = self.crossings.get(number)
                stale = best is not None
                if best is None:
                    continue
                place = self.places(number, cloud, own, best)
                found[number] = self.sheet.value(number, place)
                hand = exact.by_hand(number)
                if hand is not None:
                    found[hand] = self.sheet.value(hand, place)
                found.update(self.lines_through(number, found))
        for number in self.sheet.found_by.values():
            if number in self.own and not self.is_joined(number):
                self.readings[number] = self.readings[number].doubted("lines")
        self.next = self.ahead()
        for number in self.sheet.points:
            self.readings[number] = self.ended(number, self.readings[number])
        self.compare_letters()
        self.find_cause()
        return tuple(self.readings[number] for number in self.sheet.points)

    def find_cause(self) -> None:
        """Look for one cause of a plan with mistakes, and put its points where that puts them."""
        steps, exact = self.sheet.exact.program.steps, self.sheet.exact.trace.values
        plane = self.sheet.drawing.plane
        plan = [n for n in self.sheet.points if steps[n].plane is plane]
        poles = [n for n, v in exact.items() if steps[n].plane is plane and not steps[n].args]
        poles = [n for n in poles if isinstance(exact[n], complex)]
        if len(poles) != 1 or all(self.readings[n].verdict in ("right", "follows") for n in plan):
            return
        pole = complex(self.sheet.place(poles[0], exact[poles[0]]))
        shafts = [
            (self.exact_place(n, v.tail), self.exact_place(n, v.tip))
            for n, v in exact.items()
            if isinstance(v, Vector) and steps[n].arrow and steps[n].plane is plane
        ]
        read = [self.own[n] for n in plan if n in self.own]
        rays = [pole + way * long for way, long in self.rays(pole)]
        found = similarity_of(self.ink, shafts, pole, [*read, *rays])
        if found is None:
            return
        self.cause = found.cause
        first = True
        for number in plan:
            reading = self.readings[number]
            place = found(complex(*reading.key))
            if abs(place - complex(*reading.key)) < APART:
                continue
            if reading.at is None or abs(complex(*reading.at) - place) > BESIDE or first:
                verdict: ReadVerdict = "wrong" if first else "follows"
                off = round(abs(place - complex(*reading.own)), 3)
                reading = replace(reading, at=pair(place), off=off, verdict=verdict)
                self.readings[number] = reading.doubted("mistake" if first else "before")
            first = False

    def exact_place(self, number: int, value: complex) -> complex:
        """Where a value of a step's plane is on paper."""
        return complex(np.ravel(self.sheet.place(number, value))[0])

    def compare_letters(self) -> None:
        """Doubt points of the plan beside which the letters seem to be exchanged.

        *Wrong* is proposed, each at the other's place, where both letters are clearly read.
        """
        steps, plane = self.sheet.exact.program.steps, self.sheet.drawing.plane
        points = {
            number: WrittenPoint(reading.name[0], self.own[number])
            for number, reading in self.readings.items()
            if reading.verdict in ("right", "follows")
            and steps[number].plane is plane
            and steps[number].name
        }
        for number, place in self.tried_points(plane).items():
            points[number] = WrittenPoint(str(steps[number].name)[0], place, tried=True)
        written = {number: each for number, each in points.items() if each.letter in ALPHABET}
        for one, other, gain in exchanged(self.ink, written):
            for number, there in ((one, other), (other, one)):
                reading = self.readings.get(number)
                if reading is None:
                    continue
                place = written[there].place
                if gain > CLEARLY_EXCHANGED and reading.verdict != "wrong":
                    off = round(abs(place - complex(*reading.own)), 3)
                    reading = replace(reading, at=pair(place), off=off, verdict="wrong")
                self.readings[number] = reading.doubted("letter")

    def ended(self, number: int, reading: PointReading) -> PointReading:
        """A reading, asked where a vector or a bar does not surely end at its point.

        *Wrong* is proposed, at the arrowhead, where a head is clearly elsewhere.
        """
        if number not in self.own or reading.verdict not in ("right", "follows"):
            return reading
        for arrow, begin, _ in self.drawn_arrows:
            if arrow.tip != number or not np.isfinite(begin):
                continue
            end = self.end_of(arrow, begin)
            if end.is_wrong:
                at = reading.at if end.head is None else pair(end.head)
                off = reading.off
                if end.head is not None:
                    off = round(abs(end.head - complex(*reading.own)), 3)
                return replace(reading, at=at, off=off, verdict="wrong").doubted("end")
            if not end.is_there:
                reading = reading.doubted("end")
        return reading.doubted("end") if self.is_overdrawn(number) else reading

    @cached_property
    def drawn_arrows(self) -> tuple[tuple[Arrow, complex, complex], ...]:
        """The arrows of the plan with the places of their tails and tips, as far as read."""
        return tuple(
            (arrow, self.tail_of(arrow), self.far_place(Leading(arrow.tip), self.next))
            for arrow in self.sheet.arrows
        )

    def tail_of(self, arrow: Arrow) -> complex:
        """The place of an arrow's tail, as far as read."""
        if arrow.tail is not None:
            return self.far_place(Leading(arrow.tail), self.next)
        vector = unmarked(self.sheet.exact, arrow.step, self.next)
        return complex(np.ravel(self.sheet.place(arrow.tip, vector.tail))[0])

    def tails_of(self, arrow: Arrow, place: complex) -> list[complex]:
        """Where the tail of an arrow to a place is: as read, or where its stroke begins."""
        tail = self.tail_of(arrow)
        if arrow.tail is not None and self.is_known(Leading(arrow.tail)):
            return [tail]
        return [line.start for line in self.lines(tail, place, STRAYS, PASSES)]

    def is_met(self, number: int, best: LinesCrossing, weighed: complex) -> bool:
        """Whether a point is surely at a crossing, however vaguely it was expected.

        More than MEET lines cross there, or two vectors from points that were read end there.
        ``weighed`` is the place between the crossing and the expected place.
        """
        place = best.place
        wholly = min(best.cover, self.agreement(number, place)) >= FULLY
        if best.count > MEET and wholly:
            return True
        ways = [
            tail
            for arrow in self.sheet.arrows
            if arrow.tip == number and arrow.tail is not None and arrow.tail not in self.unread
            for tail in self.tails_of(arrow, place)
            if any(is_headed(self.ink, tail, each) for each in (place, weighed))
        ]
        return are_crossing(ways, place)

    def end_of(self, arrow: Arrow, begin: complex) -> VectorEnd:
        """What the end of an arrow to a point that was read says."""
        end = self.own[arrow.tip]
        others, along_line = self.others(arrow.tip, arrow.tail), self.is_on_line(arrow.tip, begin)
        arriving = [begin - start for _, start, tip in self.drawn_arrows if abs(tip - begin) < SAME]
        beside = [
            tip - start
            for other, start, tip in self.drawn_arrows
            if other.tip == arrow.tip and other.step != arrow.step
        ]
        return vector_end(
            self.ink, begin, end, others, arriving, along_line=along_line, beside=beside
        )

    def is_on_line(self, number: int, begin: complex) -> bool:
        """Whether a construction line runs along the line from a place to a point."""
        steps, end = self.sheet.exact.program.steps, self.own[number]
        for other, value in self.next.items():
            if steps[other].plane is steps[number].plane and isinstance(value, Line):
                start = complex(np.ravel(self.sheet.place(other, value))[0])
                way = complex(np.ravel(value.along)[0]).conjugate()
                on_it = abs(((end - start) * way.conjugate()).imag) / abs(way) < BESIDE
                if on_it and abs(sine(way, end - begin)) < FLAT:
                    return True
        return False

    def others(self, number: int, besides: int | None = None) -> list[complex]:
        """The places of the other points in a point's plan, as far as read."""
        steps, exact = self.sheet.exact.program.steps, self.sheet.exact.trace.values
        places = (
            self.far_place(Leading(other), self.next)
            for other, value in exact.items()
            if isinstance(value, complex)
            and steps[other].plane is steps[number].plane
            and other not in (number, besides)
        )
        end = self.own[number]
        return [each for each in places if np.isfinite(each) and abs(each - end) > SAME]

    def is_overdrawn(self, number: int) -> bool:
        """Whether a bar of the mechanism is drawn on beyond a point."""
        if self.sheet.exact.program.steps[number].plane is not Plane.MECHANISM:
            return False
        end, others = self.own[number], self.others(number)
        return any(
            bar_runs_on(self.ink, begin, end, others) and not self.is_on_line(number, begin)
            for far in self.sheet.bars.get(number, ())
            if self.is_known(Leading(far))
            and np.isfinite(begin := self.far_place(Leading(far), self.next))
        )

    def places(self, number: int, cloud: Any, own: ExpectedPlace, best: LinesCrossing) -> Any:
        """Where a point that was read may be: the cloud for the steps that follow from it."""
        errors = self.stream(number, 1).standard_normal((DRAWINGS, 2))
        if own.away(best.place, best.error) <= FITS:
            return own.narrowed(cloud, best, errors)
        return self.own[number] + (errors @ np.linalg.cholesky(best.error).T) @ [1, 1j]

    def is_joined(self, number: int) -> bool:
        """Whether the vectors that join a point with those read after it are drawn."""
        order = self.sheet.order
        later = (
            each
            for each in self.sheet.leading[number]
            if each.arrow and each.far in self.own and order.index(each.far) > order.index(number)
        )
        covers = (self.cover_of(number, each, self.own[number]) for each in later)
        return all(cover is None or cover >= AGREED for cover in covers)

    def lines_through(self, number: int, found: Mapping[int, Any]) -> dict[int, Line]:
        """The mechanism's drawn lines that lead to a point, with the directions as drawn.

        Each runs from its beginning to the point. Steps drawn along it use this direction, not the
        one from a shorter earlier bar.
        """
        drawn = dict[int, Line]()
        for each in self.sheet.leading[number]:
            line = found[each.far]
            plane = self.sheet.exact.program.steps[each.far].plane
            led = each.given or each.after or plane is not Plane.MECHANISM
            pivot = isinstance(found[number], complex)
            if not isinstance(line, Line) or led or not (pivot and self.is_known(each)):
                continue
            start, tip = self.far_place(each, found), self.own[number]
            if abs(tip - start) > LEVER:
                way = found[number] - line.point
                same = (np.conj(way) * line.along).real > 0
                drawn[each.far] = Line(line.point, np.where(same, way, -way))
        return drawn

    def read_corner(self, number: int, where: ExpectedPlace) -> LinesCrossing | None:
        """Read a corner without a letter where lines cross; a corner off its place is a mistake."""
        best = self.best_near(number, where) if np.isfinite(where.middle) else None
        away = np.inf if best is None else where.away(best.place, best.error)
        off = away > FITS and (
            best is None
            or best.count < 2
            or max(self.covers(number, best.place, False), default=0.0) < DRAWN
        )
        if best is None or best.cover < DRAWN or off:
            self.unread.add(number)
            return None
        if best.count < 2:
            self.guessed.add(number)
        if away > FITS:
            self.bad.add(number)
            self.noted.add(number)
            self.own[number] = best.place
        else:
            self.own[number] = where.weighed(best)
        return best

    def corners(self) -> dict[int, tuple[float, float]]:
        """The places of the corners without letters that were read, by step."""
        return {n: pair(self.own[n]) for n in self.sheet.corners if n in self.own}

    def read_point(self, number: int, key: ExpectedPlace, own: ExpectedPlace) -> PointReading:
        """Read a point: first where it is expected, then where a mistake may have put it.

        A far place must be likelier by a margin, unless all lines to it are drawn and those to the
        expected place are not.
        """
        if not np.isfinite(own.middle):
            return self.verdict_on(number, key, own, None)
        best = self.best_near(number, own)
        fits = self.holds(number, best, own)
        if not fits and abs(key.middle - own.middle) > 1.0 and np.isfinite(key.middle):
            other = self.best_near(number, key)
            if self.holds(number, other, key):
                best, fits = other, True
        clear = self.is_clear(number, best, own)
        led = best is not None and (self.agreement(number, best.place) >= DRAWN or clear)
        if best is not None and fits and led and (best.count > 1 or best.ends):
            other = self.elsewhere(number, best.place, own)
            rival = other or self.rival(number, best.place, own)
            if other is None and rival is not None and self.is_likelier(number, rival, best, own):
                other = rival
            return self.verdict_on(number, key, own, other or best, doubtful=rival is not None)
        if best is None and self.is_at_ends(number, own):
            return self.verdict_on(number, key, own, LinesCrossing(own.middle, own.spread, 1, 0.0))
        far = self.best_far(number, own)
        if far is not None:
            there = self.likely(number, far.place, own)
            here = self.likely(number, best.place, own) if best is not None else 0.0
            close = best is not None and own.away(best.place, best.error) <= SURE
            if best is not None and fits and close and abs(far.place - best.place) < 2 * SHORT:
                there = 0.0  # the same line runs on a little
            whole = far.count > 1 and self.agreement(number, far.place) >= WHOLE
            ahead = AS_EXPECTED * (fits + close + clear) if led or not whole else 0.0
            if there > here + ahead:
                best, fits = far, False
        return self.verdict_on(number, key, own, best, doubtful=not (fits and led))

    def is_at_ends(self, number: int, own: ExpectedPlace) -> bool:
        """Whether all known ends of a point's lines are too near it to see a line between.

        Lines that leave those ends are then those of other points, and a person is asked.
        """
        ends = self.known_ends(number)
        return bool(ends) and all(abs(end - own.middle) < SHORT for end in ends)

    def elsewhere(self, number: int, place: complex, own: ExpectedPlace) -> LinesCrossing | None:
        """The place to which vectors run on beyond a place that fits; None without one.

        The lines of the point cross at the place that fits, but the student may have used the other
        place.
        """
        if max(self.beyond(number, place), default=0.0) < DRAWN:
            return None
        far = self.best_far(number, own, place)
        if far is None or max(self.beyond(number, place, far.place), default=0.0) < DRAWN:
            return None
        there, here = (self.likely(number, each, own) for each in (far.place, place))
        return far if there > here + ELSEWHERE else None

    def rival(self, number: int, place: complex, own: ExpectedPlace) -> LinesCrossing | None:
        """A place that suits the plan's lines about as well as one that fits; None without one.

        Vectors that nothing else explains may be those of this point.
        """
        if self.sheet.field(number) is self.sheet.layout.mechanism:
            return None
        far = self.best_far(number, own, place)
        if far is None:
            return None
        there, here = (self.likely(number, each, own) for each in (far.place, place))
        if self.is_one_with_another(number, place):
            # the other point's lines join its own there
            return far if there > here - RIVAL - JOINS else None
        beyond = self.beyond(number, far.place)
        whole = far.count >= MEET or self.agreement(number, far.place) >= WHOLE
        if far.cover < WHOLE or not whole or len(beyond) < 2 or max(beyond) >= DRAWN:
            return None
        # two lines may cross by chance as well
        return far if there > here - (RIVAL if far.count >= MEET else 0.0) else None

    def is_likelier(
        self, number: int, rival: LinesCrossing, best: LinesCrossing, own: ExpectedPlace
    ) -> bool:
        """Whether a point is more likely at a rival place.

        All its vectors end there, or its first place belongs to another point.
        """
        if self.is_one_with_another(number, best.place):
            return True
        return self.likely(number, rival.place, own) > self.likely(number, best.place, own)

    def is_one_with_another(self, number: int, place: complex) -> bool:
        """Whether an earlier point was read at the same place; it explains the lines there."""
        steps = self.sheet.exact.program.steps
        return any(
            abs(self.own[other] - place) < SAME and steps[other].plane is steps[number].plane
            for other in self.readings.keys() & self.own.keys()
        )

    def verdict_on(
        self,
        number: int,
        key: ExpectedPlace,
        own: ExpectedPlace,
        best: LinesCrossing | None,
        *,
        doubtful: bool = False,
    ) -> PointReading:
        """The verdict on what was found of a point."""
        behind = self.behind(number)
        after, fresh = bool(self.bad & behind), bool(self.noted & behind)
        self.noted -= behind
        place = None if best is None else best.place
        verdict: ReadVerdict
        doubts: dict[Doubt, bool] = {"absent": best is None}
        if best is None:
            verdict = "missing" if np.isfinite(own.middle) else "unread"
        else:
            self.crossings[number] = best
            away = own.away(best.place, best.error)
            place = weighed = own.weighed(best) if away <= FITS else best.place
            from_key = key.away(best.place, best.error)
            apart = ExpectedPlace(key.middle, own.spread).away(own.middle, np.zeros((2, 2)))
            steps = self.sheet.exact.program.steps
            untried = any(steps[n].aside is not None for n in self.unread & behind)
            near = abs(best.place - own.middle) <= BESIDE
            close = abs(best.place - own.middle) <= CLOSE_BY
            met = ((best.count >= MEET and near) or close) and not self.bad
            there = self.is_there(number, best, key)
            stray = away <= FITS and not near and best.count < MEET
            # untried: depends on an auxiliary plan that was not read
            vague = not there and ((own.radius > VAGUE and not met) or untried)
            loose = (vague or stray) and (bool(self.bad) or not self.is_met(number, best, weighed))
            odd = any(e.far in self.bad - behind for e in self.sheet.leading[number] if not e.after)
            doubts |= {
                "off": self.is_off(away, abs(best.place - own.middle)),
                "lines": self.lacks_lines(number, best, own),
                "elsewhere": doubtful,
                "vague": loose,
                "before": fresh or odd or bool(self.strayed & behind),
            }
            if away <= FITS and fresh and from_key > FITS:
                verdict = "wrong"
            elif away <= FITS and not after:
                verdict = "right"
                far = abs(best.place - key.middle) > APART and not self.is_checked(behind)
                doubts["far"] = from_key > OUTSIDE or far
                doubts["before"] |= apart > FITS and bool(self.doubted & behind)
            elif away <= FITS:
                verdict = "follows" if from_key > FITS or apart > FITS else "right"
                doubts["off"] |= min(apart, from_key) < OFF
                # the mistake itself may be misread
                doubts["before"] |= bool(self.vaguely & behind) or not (
                    self.bad & behind & self.readings.keys()
                )
                if self.bad & self.doubted & behind:
                    doubts["before"] |= not self.is_crossed(number, best.place)
            else:
                verdict = "wrong"
                doubts["mistake"] = True
            self.strayed |= {number} if stray and loose else set()
        if doubtful:
            self.doubted.add(number)
        if verdict in ("wrong", "missing", "unread"):
            self.bad.add(number)
            if best is None or best.count < 2 or self.agreement(number, best.place) < DRAWN:
                self.vaguely.add(number)
        return PointReading(
            self.sheet.name(number),
            number,
            None if place is None else pair(place),
            verdict,
            any(doubts.values()),
            pair(key.middle),
            pair(own.middle),
            None if best is None else round(abs(best.place - own.middle), 3),
            round(own.radius, 3),
            *self.tail(number),
            tuple(sorted(doubt for doubt, holds in doubts.items() if holds)),
        )

    def lacks_lines(self, number: int, best: LinesCrossing, own: ExpectedPlace) -> bool:
        """Whether too few of the lines to a point that was found are drawn, or do not reach it."""
        if best.count < 2:
            close = abs(best.place - own.middle) <= CLOSE_BY
            if not (close and own.radius <= VAGUE and self.is_end(number, best)):
                return True
        agreed = self.agreement(number, best.place) >= NEARLY or self.is_clear(number, best, own)
        unled = best.count == 2 and not self.is_reached(number, best.place)
        return best.cover < WHOLE or not agreed or unled

    def is_off(self, away: float, off: float) -> bool:
        """Whether a place ``off`` mm away is at the edge of what the pencil explains.

        ``away`` is its squared distance in deviations, which the paper's sway enlarges.
        """
        swayed = away * (1 + self.ink.sway / max(off, SHORTEST)) ** 2
        return swayed > SURE and (off > SLIGHT or away > FITS)

    def is_end(self, number: int, best: LinesCrossing) -> bool:
        """Whether the only line that leads to a point ends there."""
        return best.ends and self.is_single(number, best.place)

    def is_crossed(self, number: int, place: complex) -> bool:
        """Whether the drawn lines to a place cross there and its vectors end there."""
        ways = [
            self.far_place(each, self.next)
            for each in self.sheet.leading[number]
            if (self.cover_of(number, each, place) or 0.0) >= DRAWN
        ]
        beyond = max(self.beyond(number, place), default=0.0)
        return are_crossing(ways, place) and beyond < DRAWN

    def is_checked(self, behind: frozenset[int]) -> bool:
        """Whether all points before one are read without a question to a person.

        No mistake is then unseen, however far the pencil errors take the point from the key.
        """
        points = behind.intersection(self.sheet.points)
        corners = behind.intersection(self.sheet.corners)
        return (
            all(n in self.readings and not self.readings[n].ask for n in points)
            and corners <= self.own.keys()
            and not corners & (self.unread | self.guessed)
        )

    def is_there(self, number: int, best: LinesCrossing, key: ExpectedPlace) -> bool:
        """Whether fully drawn lines cross at the key's place, on a sheet without mistakes so far.

        The point is then right, whatever was not seen of the construction before it.
        """
        near = abs(best.place - key.middle) <= BESIDE and key.away(best.place, best.error) <= AT_KEY
        whole = best.count > 1 and self.agreement(number, best.place) >= WHOLE
        return near and whole and not self.bad

    def tail(self, number: int) -> tuple[tuple[float, float] | None, str]:
        """A known point from which a point is drawn, and its letter."""
        steps = self.sheet.exact.program.steps
        for each in self.sheet.leading[number]:
            name = self.sheet.name(each.far)
            plain = not (each.given or each.bow or each.after) and steps[each.far].aside is None
            if plain and name and self.is_known(each):
                return pair(self.far_place(each, self.next)), name
        return None, ""

    def behind(self, number: int) -> frozenset[int]:
        """The steps from which a point is constructed by hand."""
        steps, values = self.sheet.exact.program.steps, self.sheet.exact.trace.values
        found, pending = set[int](), [number]
        while pending:
            for arg in steps[(step := pending.pop())].args + tuple(
                hand for hand in (steps[step].by_hand,) if hand is not None and hand in values
            ):
                if arg not in found:
                    found.add(arg)
                    pending.append(arg)
        by_hand = {self.sheet.found_by[arg] for arg in found & self.sheet.found_by.keys()}
        return frozenset(found | by_hand - {number})


def forecast_points(sheet: LetteredSheet, pencil: Pencil) -> tuple[PointReading, ...]:
    """The points of a sheet of which nothing is read, with the errors that the pencil explains."""
    empty = np.zeros((2, 2), np.float32)
    keys = PointReader(sheet, DrawnInk(empty, empty), pencil).clouds()
    found = []
    for number in sheet.points:
        key = expected(sheet.place(number, keys[number]))
        name, place = sheet.name(number), pair(key.middle)
        error = round(key.radius, 3)
        found.append(PointReading(name, number, None, "unread", True, place, place, error=error))
    return tuple(found)
