"""Points read as a marker reads them: one after the other, each expected from those before it.

What is expected of a point is a cloud: drawings of the construction with this pencil from the
student's own earlier points. Dark lines are fitted near what leads to it, and the point is where
they cross. Where nothing is found there, or what is found does not fit, lines are looked for in all
directions from the points that are known.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.accuracy.pencil.pencil import Pencil
from graphkin.accuracy.pencil.redrawing import step_drawn
from graphkin.drawing.areas import AREA
from graphkin.numbers.plane import Line
from graphkin.reading.drawn_ink import COVERED, DrawnInk, InkLine
from graphkin.reading.lettered_points import AHEAD, SHORT, Leading, LetteredSheet
from graphkin.reading.point_reading import PointReading, ReadVerdict, pair

DRAWINGS, SEED = 300, 23
"""Drawings in a cloud, and the seed of their errors."""
CLOSE, ROOM, WIDEST = 0.7, 0.3, 5.0
"""Least half width of the window for a point, what is added to its cloud's, and the most, in mm."""
KNOWN, GUESSED = 0.6, 1.6
"""Half width of the window at the other end of a line: a point that was read, one that was not."""
CROSSING = 0.12
"""Least sine of the angle at which lines cross that give a point."""
PASSES = 0.45
"""A line passes through a point that lies so many mm beside it at most."""
SURE, FITS, OFF = 6.5, 11.0, 16.0
"""Squared distances from what is expected, in deviations: below the first nobody is asked, up to
the second it fits, and above the third of what is not expected it does not."""
DRAWN = 0.7
"""The share of a line that must be there for it to count."""
PRINTED = 0.3
"""Standard deviation of a hand's mark across the printed line of a guide, in mm."""
END, NODE = 0.8, 0.5
"""The same of the end of a line, and of where others leave it."""
VAGUE = 4.0
"""Where the pencil explains so many mm, a point that fits is looked at all the same."""
PAPER = 0.08
"""Standard deviation of a place that is read, whatever the lines say: the map's, in mm."""
TURN, PACE, BEGIN = 0.3, 0.5, 2.5
"""Steps of a fan of rays in degrees and mm, and where rays begin."""
AGREED = 0.5
"""The share of the ways from known ends to a point that is drawn at least."""
RAY = 7.0
"""The shortest ray that counts, in mm."""
STOPS, OVER = 0.4, 6.0
"""What it counts for a place that vectors end there, and how far beyond it, in mm, that is seen."""
KEPT, LEANS = 0.3, 0.02
"""What it counts that the lines pass through it that should, and by how much these may turn."""
ENOUGH, AS_EXPECTED = 1.8, 0.3
"""What all that must come to for a place that is not expected, and what one has in advance that is.
"""
APART = 1.5
"""Nearer to a known point, in mm, another cannot be told from it."""
TRIED = 24
"""Places that are tried with what would follow from them."""


class ExpectedPlace(Struct, frozen=True):
    """Where a point is expected: the middle of a cloud (complex mm), and its covariance."""

    middle: complex
    spread: Any

    @property
    def reach(self) -> float:
        """Half the width of the window in which it is looked for."""
        wide = 3 * float(np.sqrt(max(np.linalg.eigvalsh(self.spread)[-1], 0.0)))
        return min(max(wide, CLOSE) + ROOM, WIDEST)

    @property
    def radius(self) -> float:
        """Within so many mm of the middle 95 of 100 drawings have it."""
        return 2.4477 * float(np.sqrt(np.trace(self.spread) / 2))

    def away(self, place: complex, error: Any) -> float:
        """The squared distance of a place in deviations of both."""
        off = np.array([(place - self.middle).real, (place - self.middle).imag])
        return float(off @ np.linalg.solve(self.spread + error, off))

    def weighed(self, found: LinesCrossing) -> complex:
        """A place that fits, drawn to what is expected as far as its lines leave it open."""
        off = np.array([(found.place - self.middle).real, (found.place - self.middle).imag])
        share = np.linalg.solve(self.spread + found.error, off)
        return self.middle + complex(*(self.spread @ share))


class LinesCrossing(Struct, frozen=True):
    """A place where lines cross: its covariance, and how many lines and how well they are there."""

    place: complex
    error: Any
    count: int
    cover: float


def expected(cloud: Any) -> ExpectedPlace:
    """What a cloud expects."""
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


class PointReader:
    """Reads one sheet: what is drawn against what the construction expects."""

    def __init__(self, sheet: LetteredSheet, ink: DrawnInk, pencil: Pencil) -> None:
        self.sheet, self.ink, self.pencil = sheet, ink, pencil
        self.own: dict[int, complex] = {}
        self.bad: set[int] = set()
        self.noted: set[int] = set()
        self.unread: set[int] = set()
        self.guessed: set[int] = set()
        self.readings: dict[int, PointReading] = {}
        self.next: Mapping[int, Any] = {}

    def read(self) -> tuple[PointReading, ...]:
        """All points of the sheet."""
        exact = self.sheet.exact
        keys = self.clouds()
        found = dict(exact.trace.values)
        self.next = found
        wanted, corners = set(self.sheet.points), set(self.sheet.corners)
        stale = True
        with np.errstate(all="ignore"):
            for number in exact.order:
                found[number] = self.drawn(number, found, DRAWINGS)
                if number not in wanted and number not in corners:
                    continue
                if stale:
                    self.next = self.ahead({})
                if number in corners:
                    stale = self.read_corner(
                        number, expected(self.sheet.place(number, found[number]))
                    )
                    if number in self.own:
                        found[number] = self.sheet.value(number, self.own[number])
                    continue
                key = expected(self.sheet.place(number, keys[number]))
                own = expected(self.sheet.place(number, found[number]))
                reading = self.read_point(number, key, own)
                self.readings[number] = reading
                stale = reading.at is not None
                if reading.at is not None:
                    self.own[number] = complex(*reading.at)
                    found[number] = self.sheet.value(number, self.own[number])
        return tuple(self.readings.values())

    def read_corner(self, number: int, where: ExpectedPlace) -> bool:
        """A corner without a letter: taken where lines cross there; what is off is a mistake."""
        best = self.best_near(number, where) if np.isfinite(where.middle) else None
        if best is None or best.cover < DRAWN:
            self.unread.add(number)
            return False
        if best.count < 2:
            self.guessed.add(number)
        if where.away(best.place, best.error) > FITS:
            self.bad.add(number)
            self.noted.add(number)
            self.own[number] = best.place
        else:
            self.own[number] = where.weighed(best)
        return True

    def corners(self) -> dict[int, tuple[float, float]]:
        """Where the corners without letters were read, by their steps."""
        return {n: pair(self.own[n]) for n in self.sheet.corners if n in self.own}

    # --- what is expected -----------------------------------------------------------------------

    def drawn(self, number: int, found: Mapping[int, Any], count: int) -> Any:
        """The value of a step in so many drawings; in a single one, without errors."""
        exact = self.sheet.exact
        mark = exact.marks.get(number)
        errors = None
        if mark is not None:
            stream = np.random.Generator(np.random.PCG64([SEED, number]))
            size = (count, mark.errors)
            errors = np.zeros(size) if count == 1 else stream.standard_normal(size)
        return step_drawn(exact, number, found, errors, self.pencil)

    def clouds(self) -> dict[int, Any]:
        """Every value in many drawings of the key."""
        found = dict(self.sheet.exact.trace.values)
        with np.errstate(all="ignore"):
            for number in self.sheet.exact.order:
                found[number] = self.drawn(number, found, DRAWINGS)
        return found

    def ahead(self, more: Mapping[int, complex]) -> dict[int, Any]:
        """Every value as it follows from the own points, and some more."""
        found = dict(self.sheet.exact.trace.values)
        own = {**self.own, **more}
        with np.errstate(all="ignore"):
            for number in self.sheet.exact.order:
                if number in own:
                    found[number] = self.sheet.value(number, own[number])
                else:
                    found[number] = self.drawn(number, found, 1)
        return found

    def far_place(self, leading: Leading, values: Mapping[int, Any]) -> complex:
        """The other end of what leads to a point."""
        if leading.far in self.own:
            return self.own[leading.far]
        value = values[leading.far]
        if leading.back:
            value = value.tail
        return complex(np.ravel(self.sheet.place(leading.far, value))[0])

    def is_known(self, leading: Leading) -> bool:
        """Whether the other end was read, or is printed, or a line from a point that is."""
        steps = self.sheet.exact.program.steps
        step = steps[leading.far]
        if leading.after:
            return False
        if isinstance(self.sheet.exact.trace.values[leading.far], Line):
            first = step.args[0] if step.args else leading.far
            return first in self.own or not steps[first].args
        return leading.far in self.own or not step.args

    # --- one point ------------------------------------------------------------------------------

    def read_point(self, number: int, key: ExpectedPlace, own: ExpectedPlace) -> PointReading:
        """A point, looked for where it is expected, then where it may be after a mistake."""
        if not np.isfinite(own.middle):
            return self.told(number, key, own, None)
        best = self.best_near(number, own)
        fits = self.holds(number, best, own)
        if not fits and abs(key.middle - own.middle) > 1.0 and np.isfinite(key.middle):
            other = self.best_near(number, key)
            if self.holds(number, other, key):
                best, fits = other, True
        if best is not None and fits and best.count > 1:
            return self.told(number, key, own, best)
        far = self.best_far(number, own)
        if far is not None:
            there = self.likely(number, far.place, own)
            here = self.likely(number, best.place, own) if best is not None else 0.0
            if there > here + (AS_EXPECTED if fits else 0.0):
                best, fits = far, False
        return self.told(number, key, own, best, doubtful=not fits)

    def holds(self, number: int, best: LinesCrossing | None, where: ExpectedPlace) -> bool:
        """Whether what was found of a point fits, and all is there that leads to it."""
        if best is None or where.away(best.place, best.error) > FITS:
            return False
        return self.agreement(number, best.place) >= AGREED

    def agreement(self, number: int, place: complex, *, read: bool = False) -> float:
        """How much of the ways from known ends to a place is drawn: the worst of a plan's arrows
        and lines, the best two of a mechanism's bars, which nobody draws all. ``read``: only of
        those whose ends were surely read.
        """
        covers = [
            found
            for each in self.sheet.leading[number]
            if not (read and self.is_unsure(each))
            if (found := self.cover_of(number, each, place)) is not None
        ]
        if not covers:
            return 1.0
        if self.sheet.field(number) is self.sheet.layout.mechanism:
            return float(np.mean(sorted(covers, reverse=True)[:2]))
        return min(covers)

    def is_unsure(self, leading: Leading) -> bool:
        """Whether the other end, or that of a line where it begins, was not surely read."""
        steps = {leading.far}
        if isinstance(self.sheet.exact.trace.values[leading.far], Line):
            steps |= set(self.sheet.exact.program.steps[leading.far].args[:1])
        return bool(steps & (self.unread | self.guessed))

    def cover_of(self, number: int, leading: Leading, place: complex) -> float | None:
        """How much of what leads to a place is drawn; None where that tells nothing."""
        far = self.far_place(leading, self.next)
        if leading.given or leading.bow or leading.after or abs(far - place) < 2 * SHORT:
            return None
        if leading.far in self.guessed:
            found = self.ink.lines(far, place, GUESSED, 0.5)
            return max((line.cover for line in found), default=0.0)
        if leading.far in self.own or (self.is_known(leading) and leading.far not in self.unread):
            return self.ink.cover(far, place, 0.4, hidden=1.0)
        value = self.sheet.exact.trace.values[leading.far]
        if not isinstance(value, Line) and leading.far not in self.unread:
            return None
        found = self.ink.lines(far, place, GUESSED, 0.5)
        return max((line.cover for line in found), default=0.0)

    def told(
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
        if best is None:
            verdict, ask = ("missing" if np.isfinite(own.middle) else "unread"), True
        else:
            away = own.away(best.place, best.error)
            if away <= FITS:
                place = own.weighed(best)
            from_key = key.away(best.place, best.error)
            apart = ExpectedPlace(key.middle, own.spread).away(own.middle, np.zeros((2, 2)))
            steps = self.sheet.exact.program.steps
            untried = any(steps[n].aside is not None for n in self.unread & behind)
            vague = own.radius > VAGUE or untried  # nobody saw from which trial plan it comes
            odd = any(e.far in self.bad - behind for e in self.sheet.leading[number] if not e.after)
            ask = away > SURE or best.count < 2 or best.cover < DRAWN or fresh or doubtful
            ask = ask or vague or odd
            if away <= FITS and fresh and from_key > FITS:
                verdict = "wrong"
            elif away <= FITS and not after:
                verdict = "right"
                ask = ask or from_key > OFF
            elif away <= FITS:
                verdict = "follows" if from_key > FITS or apart > FITS else "right"
                ask = ask or apart < OFF or not self.bad & behind & self.readings.keys()
            else:
                verdict, ask = "wrong", True
        if verdict in ("wrong", "missing", "unread"):
            self.bad.add(number)
        return PointReading(
            self.sheet.exact.program.steps[number].name,
            number,
            None if place is None else pair(place),
            verdict,
            ask,
            pair(key.middle),
            pair(own.middle),
            None if best is None else round(abs(best.place - own.middle), 3),
            round(own.radius, 3),
            *self.tail(number),
        )

    def tail(self, number: int) -> tuple[tuple[float, float] | None, str]:
        """A known point from which a point is drawn, and its letter."""
        steps = self.sheet.exact.program.steps
        for each in self.sheet.leading[number]:
            name = steps[each.far].name
            plain = not (each.given or each.bow or each.after) and steps[each.far].aside is None
            if plain and name and self.is_known(each):
                return pair(self.far_place(each, self.next)), name
        return None, ""

    def behind(self, number: int) -> frozenset[int]:
        """The steps from which a hand draws a point."""
        steps, values = self.sheet.exact.program.steps, self.sheet.exact.trace.values
        found, pending = set[int](), [number]
        while pending:
            for arg in steps[(step := pending.pop())].args + tuple(
                hand for hand in (steps[step].by_hand,) if hand is not None and hand in values
            ):
                if arg not in found:
                    found.add(arg)
                    pending.append(arg)
        return frozenset(found)

    # --- near what is expected ------------------------------------------------------------------

    def best_near(self, number: int, where: ExpectedPlace) -> LinesCrossing | None:
        """The best crossing of what leads to a point near where it is expected."""
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
                    if score > most:
                        best, most = found, score
        return best or self.end_near(lines, where, self.known_ends(number))

    def end_near(
        self, lines: Sequence[Sequence[InkLine]], where: ExpectedPlace, ends: Sequence[complex]
    ) -> LinesCrossing | None:
        """Where a single line ends that leads to a point; where it goes on, where others leave it;
        and where none does, the place on it that is expected.
        """
        for line in (line for some in lines for line in some):
            if line.cover < DRAWN or abs(line.off(where.middle)) > where.reach:
                continue
            straight = InkLine(line.start, where.middle, 1, 1)
            if any(abs(line.off(e)) < PASSES and abs(straight.off(e)) > 2 * PASSES for e in ends):
                continue  # what goes to that end
            foot = where.middle - 1j * line.way * line.off(where.middle)
            found = self.ink.stroke(foot, line.way, where.reach)
            if found is not None:
                shift, along = self.ink.node(foot, line.way, where.reach), NODE
                if shift is None:
                    shift, along = found.end, END
                if shift is None or any(abs(foot + line.way * shift - e) < SHORT for e in ends):
                    shift, along = 0.0, where.reach
                place = foot + line.way * shift
                return LinesCrossing(place, along_way(line.way, along, line.error), 1, line.cover)
        return None

    def lines_near(self, number: int, leading: Leading, where: ExpectedPlace) -> list[InkLine]:
        """The drawn lines that may be what leads to a point."""
        values = self.next
        if leading.given:
            line = values[leading.far]
            start = self.far_place(leading, values)
            way = complex(np.ravel(line.along)[0]).conjugate()
            return [InkLine(start, start + 100 * way / abs(way), 1.0, PRINTED)]
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
        return self.ink.lines(far, target, beside, where.reach)

    def arcs_near(self, leading: Leading, where: ExpectedPlace) -> list[InkLine]:
        """The arc of a compass near where a point is expected, as the line touching it there."""
        circle = self.next[leading.far]
        field = self.sheet.field(leading.far)
        centre = complex(np.ravel(self.sheet.place(leading.far, circle.centre))[0])
        radius = float(np.ravel(circle.radius)[0]) * field.mm
        return self.ink.arcs(centre, radius, where.middle, where.reach)

    # --- after a mistake ------------------------------------------------------------------------

    def best_far(self, number: int, where: ExpectedPlace) -> LinesCrossing | None:
        """The best place of a point that is not where it is expected, by the rays that leave the
        known ends of what leads to it, and by what would follow from it.
        """
        ends = self.known_ends(number)
        crossed = are_crossing(ends, where.middle)
        places = self.candidates(ends, crossed)
        taken = list(self.own.values())
        plausible = [
            place
            for place in places
            if in_fields(place) and all(abs(place - other) > APART for other in taken)
        ]
        first = sorted(
            ((self.led_to(number, place, ends, crossed), place) for place in plausible),
            key=lambda each: -each[0] + 0.002 * abs(each[1] - where.middle),
        )
        best, most = None, ENOUGH
        for led, place in first[:TRIED]:
            if led < DRAWN:
                break
            if self.agreement(number, place, read=True) < AGREED:
                continue
            score = led + self.followed(number, place) - 0.003 * abs(place - where.middle)
            if score > most:
                best, most = place, score
        return None if best is None else self.settled(number, best)

    def likely(self, number: int, place: complex, where: ExpectedPlace) -> float:
        """How much of what leads to a place and of what would follow from it is drawn."""
        ends = self.known_ends(number)
        led = self.led_to(number, place, ends, are_crossing(ends, where.middle))
        return led + self.followed(number, place)

    def led_to(self, number: int, place: complex, ends: Sequence[complex], crossed: bool) -> float:
        """How well what leads to a place is drawn, ends there, and runs as it should."""
        support = self.supported(place, ends, crossed)
        return support + self.stopped(number, place) + self.on_lines(number, place)

    def known_ends(self, number: int) -> list[complex]:
        """The known ends of what leads to a point, apart from one another."""
        found: list[complex] = []
        for each in self.sheet.leading[number]:
            if self.is_known(each) and not (each.bow or each.after):
                end = self.far_place(each, self.next)
                if np.isfinite(end) and all(abs(end - other) > SHORT for other in found):
                    found.append(end)
        return found

    def candidates(self, ends: Sequence[complex], crossed: bool) -> list[complex]:
        """Where the rays that leave some ends end and cross; where rays of one direction are all
        that is known, also where other lines leave them.
        """
        rays = [self.rays(end) for end in ends]
        places: list[complex] = []
        for end, some in zip(ends, rays, strict=True):
            for way, long in some:
                places.append(end + way * long)
                if not crossed:
                    places += self.ink.nodes(end, way, long + GUESSED)
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
        """The drawn lines that leave a place: unit direction, and how far each goes."""
        angles = np.radians(np.arange(0, 360, TURN))
        radii = np.arange(BEGIN, 230.0, PACE)
        ways = np.exp(1j * angles)
        dark, known = self.ink.at(start + ways[:, None] * radii[None, :])
        drawn = (dark > COVERED) | (known == 0)
        share = np.cumsum(drawn, axis=1) / np.arange(1, len(radii) + 1)
        recent = np.apply_along_axis(np.convolve, 1, drawn.astype(float), np.ones(8) / 8, "same")
        alive = (share > 0.85) & (recent > 0.5)
        lengths = np.where(alive.any(1), radii[alive.shape[1] - 1 - alive[:, ::-1].argmax(1)], 0.0)
        sums = np.cumsum(np.clip(dark, 0, 1) * known, axis=1)
        reach = np.clip(((lengths - BEGIN) / PACE).astype(int), 0, len(radii) - 1)
        strength = sums[np.arange(len(angles)), reach]
        found: list[tuple[complex, float]] = []
        for i in np.argsort(-strength):
            if lengths[i] < RAY or strength[i] < 5 or len(found) >= 10:
                break
            if all(abs(np.angle(ways[i] / way)) > np.radians(1.5) for way, _ in found):
                found.append((complex(ways[i]), float(lengths[i])))
        return found

    def supported(self, place: complex, ends: Sequence[complex], crossed: bool) -> float:
        """How well the ways from some ends to a place are drawn: the best two that cross there,
        where such are expected, or all that lie in one line.
        """
        ways = [(self.ink.cover(end, place), end - place) for end in ends]
        ways = sorted((each for each in ways if abs(each[1]) > SHORT), key=lambda each: -each[0])
        if not ways:
            return 0.0
        cover, way = ways[0]
        if not crossed:
            return float(np.mean([each for each, _ in ways]))
        crossing = [other for other, way2 in ways[1:] if abs(sine(way, way2)) > CROSSING]
        return (cover + crossing[0]) / 2 if crossing else cover / 2

    def on_lines(self, number: int, place: complex) -> float:
        """How many of the lines that lead to a point pass through a place: a mistake turns one."""
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
        """How well the vectors that come to a place end there."""
        beyond = []
        for each in self.sheet.leading[number]:
            if each.arrow and self.is_known(each):
                far = self.far_place(each, self.next)
                if abs(place - far) > 2 * SHORT:
                    way = (place - far) / abs(place - far)
                    first, last = place + OVER * way, place + 2 * OVER * way
                    beyond.append(self.ink.cover(first, last, 0.3))
        return STOPS * (1 - float(np.mean(beyond))) if beyond else STOPS / 2

    def followed(self, number: int, place: complex) -> float:
        """How well what would follow from a place is drawn."""
        values = self.ahead({number: place})
        covers = [
            self.ink.cover(place, self.far_place(each, values), 0.8)
            for each in self.sheet.leading[number]
            if each.after or not (self.is_known(each) or each.bow or self.is_unsure(each))
        ]
        if not covers:
            return 0.75
        return max(covers)

    def settled(self, number: int, place: complex) -> LinesCrossing | None:
        """A place that was found, where the lines that lead to it cross exactly."""
        values = self.ahead({number: place})
        lines = []
        for leading in self.sheet.leading[number]:
            far = self.far_place(leading, values)
            if not leading.bow and np.isfinite(far) and abs(far - place) > 2 * SHORT:
                some = self.ink.lines(far, place, 0.8, 1.2)
                lines += [some] if some else []
        found = through(place, distinct(lines, place), 1.2)
        return found or LinesCrossing(place, np.eye(2) * 0.25, 1, DRAWN)


def forecast_points(sheet: LetteredSheet, pencil: Pencil) -> tuple[PointReading, ...]:
    """The points of a sheet of which nothing is read, with what the pencil explains."""
    empty = np.zeros((2, 2), np.float32)
    keys = PointReader(sheet, DrawnInk(empty, empty), pencil).clouds()
    found = []
    for number in sheet.points:
        key = expected(sheet.place(number, keys[number]))
        name, place = sheet.exact.program.steps[number].name, pair(key.middle)
        error = round(key.radius, 3)
        found.append(PointReading(name, number, None, "unread", True, place, place, error=error))
    return tuple(found)


def in_fields(place: complex) -> bool:
    """Whether a place lies where is drawn."""
    return bool(AREA[0] < place.real < AREA[2] and AREA[1] < place.imag < AREA[3])


def are_crossing(ends: Sequence[complex], place: complex) -> bool:
    """Whether some of the ways from some ends to a place cross there."""
    ways = [end - place for end in ends]
    return any(abs(sine(*both)) > CROSSING for both in combinations(ways, 2))


def sine(one: complex, other: complex) -> float:
    """The sine of the angle between two ways."""
    return (one.conjugate() * other).imag / abs(one) / abs(other)


def along_way(way: complex, along: float, across: float) -> Any:
    """The covariance of a place that is known so well along a direction, and so well across it."""
    turned = np.array([[way.real, -way.imag], [way.imag, way.real]])
    return turned @ np.diag([along**2, across**2 + PAPER**2 / 2]) @ turned.T


def met(one: InkLine, other: InkLine) -> complex | None:
    """Where two lines meet; None where they cross too flatly."""
    if abs(sine(one.way, other.way)) < CROSSING:
        return None
    along = ((other.start - one.start) * other.way.conjugate()).imag / (
        (one.way * other.way.conjugate()).imag
    )
    return one.start + along * one.way


def distinct(lines: list[list[InkLine]], place: complex) -> list[list[InkLine]]:
    """The lines of what leads to a point, those that were found twice only once."""
    kept: list[list[InkLine]] = []
    seen: list[InkLine] = []
    for some in lines:
        fresh = [line for line in some if not any(is_same(line, other, place) for other in seen)]
        seen += fresh
        if fresh:
            kept.append(fresh)
    return kept


def is_same(one: InkLine, other: InkLine, place: complex) -> bool:
    """Whether two lines are the same stroke about a place."""
    turn = abs(np.angle(one.way / other.way))
    flat = min(turn, np.pi - turn) < np.radians(1.2)
    return bool(flat and abs(abs(one.off(place)) - abs(other.off(place))) < 0.3)


def through(
    place: complex, lines: Sequence[Sequence[InkLine]], within: float = PASSES
) -> LinesCrossing | None:
    """The place nearest to all lines that pass through about a place, one of each."""
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
