"""A reader's trials: links moved in steps until they close, and plans with a rate that is tried."""

from __future__ import annotations

import cmath
import copy
import math
import re
from collections.abc import Callable

from tests.documents.hand import Hand
from tests.documents.printed_sheet import LINK, NAME, NUMBER, WHEEL, canonical, number
from tests.documents.reader_rules import VECTOR, says
from tests.documents.ruler_and_compass import DefectError, Line, cross, dot

ANGLES = 720
"""At how many angles a link is drawn, where no sentence tells about which it closes."""
READ = 0.1
"""How far, in degrees, a printed angle may lie from the one that closes."""
TOLD = 0.15
"""How far, in mm, what is measured may lie from what the page tells of it."""
TRIED = r"[a-z]′?_\{(?:[^}]*,)?II?\}"
"""The name of a point of a trial plan."""


def of_trial(name: str, trial: str) -> str:
    """The image of a point in a trial plan, as it is printed: a_{I} of a, p_{2,I} of p_{2}."""
    match = re.fullmatch(r"(\w[′]*)(?:_\{(.*)\})?", name)
    assert match, name
    return f"{match[1]}_{{{match[2]},{trial}}}" if match[2] else f"{match[1]}_{{{trial}}}"


class Trials(Hand):
    """What a reader does by trials."""

    # a link that is moved in steps

    @says(
        "cut pin ⟨pin⟩: move link ⟨k:link⟩ in steps, draw links .*? each time and mark the locus "
        "of ⟨p2⟩; where it cuts the arc of radius ⟨p⟩⟨q⟩ about ⟨c⟩ they close: closure ⟨n:number⟩"
    )
    def cut_loop(self, pin: str, k: str, p: str, q: str, c: str, n: str, **_: str) -> None:
        self.close(k, n, lambda hand: abs(hand.at(pin) - hand.at(c)) - hand.length(p, q))

    @says(
        "take ⟨q⟩ off guide ⟨g:link⟩: move link ⟨k:link⟩ in steps, draw links .*? each time "
        "and mark the locus of ⟨q2⟩; where it cuts guide ⟨g2:link⟩ they close: closure ⟨n:number⟩"
    )
    def take_off(self, q: str, g: str, k: str, n: str, **_: str) -> None:
        def off(hand: Trials) -> float:
            line = hand.guide(g)
            return cross(line.along, hand.at(q) - line.point)

        self.close(k, n, off)

    @says(
        "take ⟨p⟩⟨q⟩ away: move link ⟨k:link⟩ in steps, draw links .*? each time and mark the "
        "loci of ⟨p2⟩ and ⟨q2⟩; where these are as far apart as the bar is long they close: "
        "closure ⟨n:number⟩"
    )
    def take_away(self, p: str, q: str, k: str, n: str, **_: str) -> None:
        self.close(k, n, lambda hand: abs(hand.at(q) - hand.at(p)) - hand.length(p, q))

    @says(
        r"leave (?P<s>s_\{[^}]*\}) free: move link ⟨k:link⟩ in steps and draw links .*? each "
        r"time; where s_\{[^}]*\} takes its given value they close: closure ⟨n:number⟩"
    )
    def leave_free(self, s: str, k: str, n: str) -> None:
        block, on = re.findall(r"\w+", s[3:-1])

        def off(hand: Trials) -> float:
            point, start = hand.moving_guide(block, on)
            told = re.match(rf"({NUMBER}) (mm|cm|m)", hand.given(s))
            assert told
            unit = {"mm": 1.0, "cm": 10.0, "m": 1000.0}[told[2]]
            given = abs(number(told[1])) * unit / hand.scale
            return abs(hand.at(point) - hand.at(start)) - given

        self.close(k, n, off)

    def moving_guide(self, block: str, on: str) -> tuple[str, str]:
        """The point of a block, and that of the link on which it slides, through which it does."""
        for item in self.items:
            told = rf"({NAME}) slides along the line of link {on} through ({NAME}) "
            if match := re.match(told, item):
                return match[1], match[2]
        raise DefectError(f"no guide of link {block} on link {on} is given")

    def close(self, k: str, n: str, off: Callable[[Trials], float]) -> None:
        """Finds the angle at which the link is drawn in the sentences that follow."""

        def gap(angle: float) -> float:
            hand = copy.deepcopy(self)
            hand.turn, hand.ahead = (k, angle), []
            for sentence in self.ahead:
                try:
                    return off(hand)
                except DefectError:
                    hand.follow(sentence)
            return off(hand)

        text = " ".join(self.ahead)
        found = re.search(rf" at ({NUMBER})° to the x axis, as was found", text)
        if found:
            near, most = math.radians(number(found[1])), math.radians(READ)
            self.turn = (k, root(gap, near - most, near + most))
        elif "the place that was found" not in text:
            self.turn = (k, self.counted(gap, int(n)))

    def counted(self, gap: Callable[[float], float], n: int) -> float:
        """The n-th angle from 0° on at which the links close."""
        angles, closed = [2 * math.pi * i / ANGLES for i in range(ANGLES + 1)], []
        last: float | None = None
        for before, angle in zip([0.0, *angles], angles, strict=False):
            try:
                now: float | None = gap(angle)
            except DefectError:
                now = None
            if last is not None and now is not None and last * now <= 0:
                closed.append((before, angle))
            last = now
        if len(closed) < n:
            raise DefectError(f"the links close at {len(closed)} angles")
        return root(gap, *closed[n - 1])

    @says(
        "on it ⟨far:number⟩ mm (?P<way>to the left|to the right) of ⟨p⟩ the place that was "
        "found: ⟨name⟩"
    )
    def place_that_was_found(self, far: str, way: str, p: str, name: str) -> None:
        ray = self.ray
        if ray is None:
            raise DefectError("no path is drawn")
        foot = ray.point + ray.along * dot(ray.along, self.at(p) - ray.point)
        along = ray.along if (ray.along.real > 0) == (way == "to the right") else -ray.along
        self.put(name, foot + along * number(far))
        for item in self.items:
            if wheel := re.match(rf"wheel ({WHEEL}): centre {re.escape(name)},", item):
                _, radius = self.wheel_about(name)
                self.rolled[wheel[1]] = number(far) / radius

    @says("through ⟨p⟩ draw guide ⟨k:link⟩ at (?P<angle>⟨n:number⟩°) to the x axis, as was found")
    def guide_found(self, p: str, k: str, n: str, **_: str) -> None:
        along = cmath.rect(1, self.turned(math.radians(number(n))))
        self.lies[k] = along
        self.ray = Line(self.at(p), along)
        self.loci.append(self.ray)

    def turned(self, told: float) -> float:
        """The angle that closes, where the page tells it to a tenth of a degree; else as told."""
        if self.turn is None:
            return told
        off = math.degrees(math.remainder(self.turn[1] - told, 2 * math.pi))
        return self.turn[1] if abs(off) <= 1.01 * READ else told

    # plans with a rate that is tried

    @says(rf"in the same way (?P<names>{TRIED}(?:, {TRIED})*)")
    def same_way(self, names: str) -> None:
        """As in the first trial plan."""
        for name in re.findall(TRIED, names):
            first = canonical(re.sub(r"II\}$", "I}", name))
            if first not in self.blocks:
                raise DefectError(f"the first trial plan has no {first}")
            text = re.sub(r"([{,])I\}", r"\1II}", self.blocks[first])
            self.read(text)
            self.at(name)

    @says(rf"(?P<names>{TRIED}(?:, {TRIED})*) fall on ⟨s⟩")
    def fall_on(self, names: str, s: str) -> None:
        for name in re.findall(TRIED, names):
            self.put(name, self.at(s))

    @says("⟨name⟩ is its end")
    def is_end(self, name: str) -> None:
        self.put(name, self.its_end())

    @says(
        "from ⟨s⟩ lay off ⟨a:vector⟩ as before, from its end ⟨t:vector⟩ ⊥ ⟨p⟩⟨q⟩, ⟨drawn:number⟩ "
        "mm, in the sense of ⟨w:turning⟩: ⟨name⟩"
    )
    def as_before(
        self, s: str, a: str, p: str, q: str, drawn: str, w: str, name: str, **_: str
    ) -> None:
        if a not in self.before:
            raise DefectError(f"{a} was not laid off before")
        bar = self.at(q) - self.at(p)
        way = bar / abs(bar) * 1j * self.sense(w)
        self.put(name, self.at(s) + self.before[a] + way * number(drawn))

    @says("the line ⟨x⟩⟨y⟩ of the trials")
    def line_of_trials(self, x: str, y: str) -> None:
        self.loci.append(Line.of(self.at(x), self.at(y) - self.at(x)))

    @says(
        "divide the line of the two trials of each (?:other point in the same ratio|point in the "
        "ratio of the gaps), ⟨x⟩⟨c⟩ : ⟨c2⟩⟨y⟩ = ⟨m:number⟩ : ⟨n:number⟩(?: as measured)?"
        "(?P<beyond>, on the line produced beyond ⟨z⟩)?: (?P<names>[^;]*)"
    )
    def divide(self, x, c, y, m, n, beyond, z, names, **_):
        first, second = self.at(x), self.at(y)
        if self.gaps is None:
            way = self.at(c) - first
            share = dot(way, second - first) / abs(second - first) ** 2
            told = abs(way), abs(self.at(c) - second)
        else:
            share = (self.gaps[0] / (self.gaps[0] - self.gaps[1])).real
            told = abs(self.gaps[0]), abs(self.gaps[1])
        self.gaps = None
        if max(abs(told[0] - number(m)), abs(told[1] - number(n))) > TOLD:
            raise DefectError(f"{m} : {n} are told of {told[0]:.2f} : {told[1]:.2f}")
        end = "" if 0 <= share <= 1 else y if share > 1 else x
        if (beyond and end != z) or (end and not beyond and min(told) > TOLD):
            raise DefectError("the line is not told to be produced beyond the right end")
        for name in names.split(", "):
            one, two = (self.at(of_trial(name, trial)) for trial in ("I", "II"))
            self.put(name, one + share * (two - one))

    @says(
        "measure the gaps of the trials: ⟨x⟩ lies ⟨m:number⟩ mm from (?P<one>[^;]*?), on which it "
        "should be, and ⟨y⟩ ⟨n:number⟩ mm (?P<side>on the other side|on the same side) from "
        "(?P<two>[^;]*)"
    )
    def measure(self, x: str, m: str, one: str, y: str, n: str, side: str, two: str) -> None:
        found = self.gap_from(x, one), self.gap_from(y, two)
        if any(abs(abs(g) - number(t)) > TOLD for g, t in zip(found, (m, n), strict=True)):
            raise DefectError(f"gaps of {m} and {n} are told of {found}")
        opposite = dot(*found) < 0
        if opposite is not (side == "on the other side") and min(map(abs, found)) > TOLD:
            raise DefectError("the gaps lie on other sides than is told")
        self.gaps = found

    def gap_from(self, point: str, words: str) -> complex:
        """How far a point lies from where it should, along a line or square to one."""
        if re.fullmatch(NAME, words):
            return complex(self.at(point) - self.at(words))
        match = re.fullmatch(
            rf"the (perpendicular|parallel) to (?:({NAME})({NAME})|(guide {LINK})) through (.*)",
            words,
        )
        if match is None:
            raise DefectError(f"no rule reads: {words}")
        along = self.direction(match[4] or f"{match[2]}{match[3]}")
        along *= 1j if match[1] == "perpendicular" else 1
        if re.fullmatch(NAME, match[5]):
            through = self.at(match[5])
        else:
            end = re.fullmatch(
                rf"the end of ({VECTOR}), laid off from ({NAME}) towards ({NAME})", match[5]
            )
            if end is None or match[4]:
                raise DefectError(f"no rule reads: {match[5]}")
            p, q = (match[2], match[3]) if end[3] == match[3] else (match[3], match[2])
            way = self.at(q) - self.at(p)
            size = self.lengths[end[1]]
            through = self.at(end[2]) + way / abs(way) * size
        return complex(cross(along / abs(along), self.at(point) - through))

    @says(
        "measure along guide ⟨k:link⟩, in its positive sense: (?:⟨x⟩⟨y⟩|⟨a:vector⟩) = ⟨m:number⟩ "
        "mm in the first trial plan, (?:⟨x2⟩⟨y2⟩|⟨a2:vector⟩) = ⟨n:number⟩ mm in the second; "
        "⟨given:number⟩ mm are given, so that the gaps of the trials are ⟨g:number⟩ mm and "
        "⟨h:number⟩ mm"
    )
    def measure_along(
        self, k: str, x: str, y: str, x2: str, y2: str, a: str, m: str, n: str, given: str, **_: str
    ) -> None:
        item = self.told_of_guide(k)
        line = self.positive(self.guide(k), item)
        if x:
            ways = [self.at(end) - self.at(start) for start, end in ((x, y), (x2, y2))]
        else:
            # from where the line along the guide was met to the tail of what was set on it
            ways = [self.tails[trial] - self.met[trial] for trial in ("I", "II")]
        found = [dot(line.along, way) for way in ways]
        if any(abs(f - number(t)) > TOLD for f, t in zip(found, (m, n), strict=True)):
            raise DefectError(f"{m} and {n} mm are told of {found}")
        one, two = (complex(each - number(given)) for each in found)
        self.gaps = one, two

    def told_of_guide(self, k: str) -> str:
        """What the data say of the guide of a block."""
        point = self.sliding_point(k)
        return str(self.told_of(rf"(?:pin )?{re.escape(point)} slides"))


def root(gap: Callable[[float], float], low: float, high: float) -> float:
    """Where a gap closes between two angles."""
    one, two = gap(low), gap(high)
    if one * two > 0:
        raise DefectError("the links do not close at the angle that is told")
    for _ in range(40):
        middle = (low + high) / 2
        now = gap(middle)
        if one * now <= 0:
            high = middle
        else:
            low, one = middle, now
    return (low + high) / 2
