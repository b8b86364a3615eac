"""A reader with ruler and compass: follows the printed sentences, in millimetres of paper.

It knows what a student knows: the words printed on the sheets (sentences, given data, scale, list
of links) and the fixed pins and poles drawn on the task sheet. It shares no code with graphkin: the
pages are read from their SVG files (``printed_sheet``), the geometry is ``ruler_and_compass``. What
it reaches is compared with the marks of the key by ``deviations``.

A sentence that does not carry enough raises ``DefectError``: a length that is nowhere given, a
point without a place, two crossings on the side that is named, words that no rule knows.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from tests.documents.hand import MILLIMETRES, SIDES, WAYS, sliding
from tests.documents.printed_sheet import (
    LINK,
    NAME,
    NUMBER,
    RADIUS,
    WHEEL,
    Printed,
    bare,
    canonical,
    number,
    printed_sheets,
)
from tests.documents.reader_rules import SET, agrees, factored, says, times
from tests.documents.ruler_and_compass import Circle, DefectError, Line, cross, crossings, dot
from tests.documents.trial_reader import Trials

STEPS = 14_400
"""At how many angles a link is drawn where a locus is sought: each fortieth of a degree."""


class Reader(Trials):
    """One who draws a scene from its two sheets."""

    # the mechanism

    @says(
        "draw the mechanism as on the velocity sheet",
        "transfer .* to the mechanism, (?:each )?to its point.*",
        "over the motion .*",
        "draw the path of .*",
        "nothing is set on the mechanism, because .*",
        "join ⟨p⟩⟨q⟩: link ⟨k:link⟩ is idle and fits by itself",
        "join ⟨p⟩⟨q⟩: link .*? replaces the contact at this instant",
        "the perpendiculars are parallel: .* is at infinity",
    )
    def nothing(self, **_: str) -> None:
        """Nothing that reaches a point."""

    @says(
        r"through ⟨p⟩ draw the line at (?:φ(?:_\{.*?\})? = )?(?P<angle>φ(?:_\{.*?\})?|⟨n:number⟩°)"
        "(?P<against> to ⟨a⟩⟨b⟩)?(?P<beyond> produced)?"
    )
    def draw_ray(self, p, angle, n, against, a, b, beyond):
        along = cmath.rect(1, self.angle(angle))
        if against:
            other = a if b == p else b
            along *= self.at(other) - self.at(p)
            along *= -1 if beyond else 1
        self.ray = Line.of(self.at(p), along)

    @says(
        "cut pin ⟨pin⟩: move link ⟨k:link⟩ in steps, draw it each time and mark the locus of "
        "⟨p2⟩; where it cuts the arc of radius ⟨p⟩⟨q⟩ about ⟨c⟩ they close: closure ⟨n:number⟩"
    )
    def cut(self, pin: str, k: str, p: str, q: str, c: str, n: str, **_: str) -> None:
        """The link is drawn at ten thousand angles; between two of them the locus cuts the arc."""
        drawn, low = self.moved_link(k), math.inf
        radius, about = self.length(p, q), self.at(c)
        found = []
        for step in range(STEPS + 1):
            angle = -math.pi + 2 * math.pi * step / STEPS
            places, counted = drawn(angle)
            off = abs(places[pin] - about) - radius
            if low * off <= 0 and math.isfinite(low):
                found.append((math.degrees(counted) % 360, angle))
            low = off
        if int(n) > len(found):
            raise DefectError(f"the locus of {pin} cuts the arc {len(found)} times")
        _, angle = sorted(found)[int(n) - 1]
        self.drawn[k], counted = drawn(angle)
        if self.told_of_rim(k):
            self.lies[k] = cmath.rect(1, counted)

    def told_of_rim(self, k: str) -> str | None:
        """What the data say of a straight link on the rim of a wheel, if it is one."""
        form = rf"wheel {WHEEL} rolls in {NAME} on the line of link {k} through"
        return next((item for item in self.items if re.match(form, item)), None)

    def moved_link(self, k: str) -> Callable[[float], tuple[dict[str, complex], float]]:
        """A link by how far it has turned since the start: its points, the angle that counts."""
        for form, move in (
            (rf"link {k} rolls in {NAME} on the fixed wheel by the line", self.on_drum),
            (rf"wheel {k} rolls in {NAME} on the fixed wheel", self.on_wheel),
        ):
            if item := next((item for item in self.items if re.match(form, item)), None):
                return move(k, item)
        if item := self.told_of_rim(k):
            return self.on_rim(k, item)
        raise DefectError(f"nothing tells how link {k} moves")

    def on_drum(self, k: str, item: str) -> Callable[[float], tuple[dict[str, complex], float]]:
        """A bar that rolls on a drum of the frame, along itself."""
        told = re.search(
            rf"through ({NAME}) at 0° to ({NAME})({NAME}), on its (left|right)-hand side, .* is at "
            rf"({NUMBER}°)",
            item,
        )
        assert told
        mark, p, q = told[1], told[2], told[3]
        drum = self.told_of("wheel of the frame: centre")
        about = re.search(rf"centre ({NAME})", drum)
        assert about
        centre, radius = self.at(about[1]), self.wheel_about(about[1])[1]
        left, start = (1 if told[4] == "left" else -1), self.angle(told[5])

        def drawn(turned: float) -> tuple[dict[str, complex], float]:
            along = cmath.rect(1, start + turned)
            where = centre - left * along * (1j * radius + turned * radius)
            own = self.length(p, mark) if mark != p else 0.0
            first = where - along * own
            return {mark: where, p: first, q: first + along * self.length(p, q)}, start + turned

        return drawn

    def on_wheel(self, k: str, item: str) -> Callable[[float], tuple[dict[str, complex], float]]:
        """A wheel that rolls on or in a wheel of the frame: its centre goes round that one's."""
        told = re.search(rf": ({NAME})({NAME}) is at ({NUMBER}°), .* is at ({NUMBER}°)\)", item)
        assert told
        p, q = told[1], told[2]
        fixed = re.search(rf"of the frame: centre ({NAME})", self.told_of(r"(?:ring|wheel) of the"))
        assert fixed
        (kind, large), (_, own) = self.wheel_about(fixed[1]), self.wheel_about(p)
        times = 1 - large / own if kind.startswith("ring") else 1 + large / own
        centre, apart = self.at(fixed[1]), self.apart(fixed[1], p)

        def drawn(turned: float) -> tuple[dict[str, complex], float]:
            where = centre + cmath.rect(apart, self.angle(told[4]) + turned)
            counted = self.angle(told[3]) + times * turned
            return {p: where, q: where + cmath.rect(self.length(p, q), counted)}, counted

        return drawn

    def on_rim(self, k: str, item: str) -> Callable[[float], tuple[dict[str, complex], float]]:
        """A straight link on the rim of a wheel that stands: as far along it as both turned."""
        told = re.search(
            rf"wheel ({WHEEL}) rolls .* through (?:({NAME})|\(({NUMBER})[;,] 0\) (mm|cm|m))"
            rf"(?: at 0° to .*?)?, on its (left|right)-hand side, touching it .* when .*? is at "
            rf"({NUMBER}°) to (?:the x axis of link {k}|({NAME})({NAME}))",
            item,
        )
        if told is None:
            raise DefectError(f"nothing tells where link {k} touched the wheel at the start")
        disc = self.told_of(rf"wheel {told[1]}: centre")
        about = re.search(rf"centre ({NAME})", disc)
        assert about
        centre, radius = self.at(about[1]), self.wheel_about(about[1])[1]
        left, start, wheel = (1 if told[5] == "left" else -1), self.angle(told[6]), self.angle("φ")
        p = told[7] or re.findall(NAME, self.links[k])[0]
        begun = re.search(rf", (?:the x axis of link {k}|{p}{NAME}) is at ({NUMBER}°)", item)
        stood = self.angle(begun[1]) if begun else 0.0
        ahead = number(told[3]) * MILLIMETRES[told[4]] / self.scale if told[3] else 0.0

        def drawn(turned: float) -> tuple[dict[str, complex], float]:
            bar = stood + turned
            along = cmath.rect(1, bar)
            way = ahead - left * radius * (wheel - bar - start)
            places = {p: centre - along * (left * 1j * radius + way)}
            if told[8]:
                places[told[8]] = places[p] + along * self.length(p, told[8])
            return places, bar

        return drawn

    @says("set link ⟨k:link⟩ at its angle about ⟨p⟩: (?P<names>[^;]*)")
    def set_link(self, k: str, p: str, names: str) -> None:
        """A plate whose own axes the data give: its x axis at the driver's angle."""
        self.lies[k] = turned = cmath.rect(1, self.angle("φ"))
        own = self.own_points(k)
        for name in names.split(", "):
            self.put(name, self.at(p) + turned * (own[name] - own[p]))

    def own_points(self, k: str) -> dict[str, complex]:
        """The points of a link in its own axes, as the data give them, in mm of paper."""
        if k not in self.own:
            raise DefectError(f"the points of link {k} are not given")
        return {name: where / self.scale for name, where in self.own[k].items()}

    @says("on it lay off ⟨p⟩⟨q⟩: ⟨name⟩")
    def mark_off(self, p: str, q: str, name: str) -> None:
        if self.ray is None:
            raise DefectError("no line is drawn")
        self.put(name, self.at(p) + self.ray.along * self.length(p, q))

    @says(
        "on ⟨p⟩⟨q⟩(?: produced beyond ⟨beyond⟩)? lay off ⟨s⟩⟨t⟩(?: \\(⟨drawn:number⟩ "
        "mm\\))?: ⟨name⟩"
    )
    def step_along(
        self, p: str, q: str, beyond: str | None, s: str, t: str, drawn: str | None, name: str
    ) -> None:
        towards = beyond or (q if s == p else p)
        away = p if towards == q else q
        along = self.at(towards) - self.at(away)
        size = number(drawn) if drawn else self.length(s, t)
        self.put(name, self.at(s) + along / abs(along) * size)

    @says("join ⟨p⟩ and ⟨q⟩: link ⟨k:link⟩ lies on this line")
    def join(self, p: str, q: str, k: str) -> None:
        self.ray = Line.of(self.at(p), self.at(q) - self.at(p))
        self.bearing, self.tangent = (p, q), None

    @says("on the line of the link lay off ⟨p⟩⟨q⟩: ⟨name⟩")
    def mark_off_lever(self, p: str, q: str, name: str) -> None:
        if self.tangent is not None:
            self.put(name, self.at(p) + self.tangent * self.length(p, q))
            return
        one, two = self.bearing
        other = two if one == p else one
        along = self.at(other) - self.at(p)
        side = f" along {p}{q}, on the same side of {p} as {q}"
        ways = f"{other} slides{side}", f"pin {other} slides in a slot{side}"
        if not any(item.startswith(ways) for item in self.items):
            raise DefectError(f"nothing tells on which side of {p} to lay off {p}{q}")
        self.put(name, self.at(p) + along / abs(along) * self.length(p, q))

    @says(r"arc of radius ⟨p⟩⟨q⟩(?: \(⟨drawn:number⟩ mm\))? about ⟨c⟩")
    def compass(self, p: str, q: str, drawn: str | None, c: str) -> None:
        self.loci.append(Circle(self.at(c), number(drawn) if drawn else self.length(p, q)))

    @says("they meet at ⟨name⟩, (?P<side>left|right) of ⟨p⟩→⟨q⟩")
    def arcs_meet(self, name: str, side: str, p: str, q: str) -> None:
        from_, to = self.at(p), self.at(q)
        wanted = 1 if side == "left" else -1
        found = [z for z in crossings(*self.loci) if wanted * cross(to - from_, z - from_) > 0]
        self.one_of(name, found)

    def one_of(self, name: str, found: list[complex]) -> None:
        if len(found) != 1:
            raise DefectError(f"{len(found)} crossings lie where {name} should be")
        self.put(name, found[0])

    @says(
        "circle of radius ⟨drawn:number⟩ mm about ⟨p⟩; Thales’ circle with ⟨m⟩⟨n⟩ as diameter "
        "meets it where the tangent from ⟨q⟩ touches: link ⟨k:link⟩ lies parallel to this tangent"
    )
    def tangent_from(self, drawn: str, p: str, m: str, n: str, q: str, k: str) -> None:
        """Of the two tangents that on which the pin lies where the data tell: side and place."""
        own, pinned = re.escape(p), re.escape(q)
        wheel = rf"wheel {WHEEL} rolls in {NAME} on the line of link {k} through {own}[ ,]"
        item = self.told_of(rf"{wheel}|{pinned} slides parallel to {own}{NAME}, ")
        side = re.search(rf"on its (left|right)-hand side| ({'|'.join(SIDES)}) it\b", item)
        place = re.search(r"the (farther|nearer) of the two places along it", item)
        if side is None or place is None:
            raise DefectError(f"nothing tells which tangent link {k} lies along")
        pivot, pin = self.at(p), self.at(q)
        thales = Circle((self.at(m) + self.at(n)) / 2, abs(self.at(n) - self.at(m)) / 2)
        ahead = 1 if place[1] == "farther" else -1
        found = []
        for foot in crossings(Circle(pivot, number(drawn)), thales):
            along = ahead * (pin - foot) / abs(pin - foot)
            its = 1j * along if side[1] == "left" else -1j * along
            beside = dot(SIDES[side[2]] if side[2] else its, foot - pivot)
            if beside > abs(foot - pivot) / 100:  # what lies square to a side is not on it
                found.append(along)
        if len(found) != 1:
            raise DefectError(f"{len(found)} tangents from {q} leave it where the data tell")
        self.lies[k] = self.tangent = found[0]

    @says(
        "guide ⟨k:link⟩ is the face of link ⟨f:link⟩, on which block ⟨k2:link⟩ in ⟨p⟩ "
        "replaces the contact at this instant"
    )
    def face(self, k: str, f: str, **_: str) -> None:
        """Square to the guide of a follower, or along the bar of a lever."""
        item = self.told_of(rf"cam {LINK} (?:lifts|swings) link {f},")
        if bar := re.search(rf"a flat face along ({NAME})({NAME})", item):
            self.faces[k] = self.at(bar[2]) - self.at(bar[1])
        elif "a flat face square to its guide" in item:
            self.faces[k] = 1j * self.guide(f).along
        else:
            raise DefectError(f"nothing tells how the face of link {f} lies")

    @says("draw the guide")
    def draw_the_guide(self) -> None:
        """Drawn when it is cut: the page names its point only then."""

    @says("(?:through ⟨p⟩ )?draw guide ⟨k:link⟩")
    def draw_guide(self, k: str, p: str | None) -> None:
        item = self.told_of(rf"(?:pin )?{sliding(self.sliding_point(k), k)} slides")
        told = re.search(rf"of link (\w+) through ({NAME}) at .* to the x axis of link", item)
        stands = told and told[1] in self.lies and self.stands(told[2])
        square = rf"of link \w+ through ({NAME}) at {NUMBER}° to ({NAME})({NAME})(?: |,|$)"
        bar = re.search(square, item)
        stands = stands or (bar and all(map(self.stands, bar.groups())))
        moved = rf"along the line of link {self.turn[0]} through ({NAME}) " if self.turn else "$^"
        if start := re.search(moved, item):
            assert self.turn
            self.ray = Line(self.at(start[1]), cmath.rect(1, self.turn[1]))
            self.loci.append(self.ray)
            return
        if p is None and "along the line of link" in item and not stands:
            raise DefectError(f"guide {k} moves: no point is told through which to draw it")
        self.loci.append(Line(self.at(p), self.direction(f"guide {k}")) if p else self.guide(k))

    @says("draw track ⟨k:link⟩")
    def draw_track(self, k: str) -> None:
        self.loci.append(self.track(k))

    @says("shift it by ⟨drawn:number⟩ mm (?P<way>to the right|to the left|upwards|downwards)")
    def shifted(self, drawn: str, way: str) -> None:
        """At once where the guide stands already, otherwise when it is cut."""
        if not self.loci:
            self.offset = WAYS[way] * number(drawn)
            return
        line = self.loci[-1]
        assert isinstance(line, Line)
        away = line.along * 1j
        away *= math.copysign(1, dot(WAYS[way], away))
        self.loci[-1] = Line(line.point + away * number(drawn), line.along)

    @says(
        "parallel to it, on the wheel’s side, the path of the centre at the radius of wheel "
        "⟨k:link⟩"
    )
    def radius_along(self, k: str) -> None:
        rolls = self.told_of(rf"wheel {k} rolls")
        disc = self.told_of(rf"wheel {k}: centre")
        size = re.search(rf"{RADIUS} = ({NUMBER}) (mm|cm|m)", disc)
        assert size
        side = re.search(r"on its (right|left)-hand side", rolls)
        if side is None:
            raise DefectError(f"nothing tells on which side of its track wheel {k} lies")
        drawn = [line for line in self.loci[-1:] if isinstance(line, Line)]
        track = drawn[0] if drawn else self.track(k)  # that of a link that moves was drawn just now
        track = self.positive(track, rolls) if "(positive" in rolls else track
        on = re.search(rf"horizontal|(vertical)|at ({NUMBER}°) to", rolls)
        assert on
        way = self.angle(on[2]) if on[2] else math.pi / 2 if on[1] else 0.0
        laid = Line.of(track.point, cmath.rect(1, way))
        away = laid.along * (1j if side[1] == "left" else -1j)
        radius = number(size[1]) * MILLIMETRES[size[2]] / self.scale
        self.ray = Line(track.point + away * radius, track.along)

    @says(
        "on it, halfway between the points at which both tracks were touched at the start, for it "
        "has rolled as far on the one as on the other: ⟨name⟩"
    )
    def halfway(self, name: str) -> None:
        """Between where each track was touched, as far along as the wheel's centre lies."""
        wheel = next(
            match[1]
            for item in self.items
            if (match := re.match(rf"wheel ({WHEEL}): centre {re.escape(name)},", item))
        )
        touched = []
        for item in self.items:
            if re.match(rf"wheel {wheel} rolls", item):
                place = re.search(
                    rf"(?:through the point \(({NUMBER})[;,] ({NUMBER})\) (mm|cm|m) from ({NAME})"
                    " at .*)?"
                    rf"touching it at (?:that point|({NAME}))",
                    item,
                )
                assert place
                if place[5]:
                    touched.append(self.at(place[5]))
                else:
                    way = complex(number(place[1]), number(place[2])) * MILLIMETRES[place[3]]
                    touched.append(self.at(place[4]) + way / self.scale)
        if len(touched) != 2 or self.ray is None:
            raise DefectError(f"nothing tells where the tracks of wheel {wheel} were touched")
        middle = sum(touched) / 2 - self.ray.point
        self.put(name, self.ray.point + self.ray.along * dot(self.ray.along, middle))

    @says(r"on it lay off (?:s(?:_\{.*?\})? \()?⟨drawn:number⟩ mm\)? from its zero: ⟨name⟩")
    def set_at(self, drawn: str, name: str) -> None:
        if self.ray is None:
            item = self.told_of(rf"(?:pin )?{re.escape(name)} slides")
            self.ray = self.positive(self.block(name), item)
        self.put(name, self.ray.point + self.ray.along * number(drawn))

    @says(
        "from the centre of wheel ⟨k:wheel⟩ the perpendicular to its track(?: on link "
        "⟨g:link⟩)?; it meets it in the point of contact ⟨name⟩"
    )
    def contact(self, k: str, g: str | None, name: str) -> None:
        if g and (k, g) not in self.tracks:
            raise DefectError(f"the track of wheel {k} on link {g} was not drawn")
        track, centre = self.tracks[k, g] if g else self.track(k), self.centre(k)
        self.put(name, track.point + track.along * dot(track.along, centre - track.point))

    @says("draw the track of wheel ⟨k:wheel⟩ on link ⟨g:link⟩: (?P<line>the line .*?)(?=;)")
    def draw_track_of(self, k: str, g: str, line: str) -> None:
        self.put_track(g, line)
        drawn = self.loci[-1]
        assert isinstance(drawn, Line)
        self.tracks[k, g] = drawn

    def put_track(self, g: str, line: str) -> None:
        own = re.search(rf"through \(({NUMBER})[;,] ({NUMBER})\) mm", line)
        if own and g in self.lies and (through := re.findall(NAME, self.links[g])):
            way = self.lies[g] * complex(number(own[1]), number(own[2]))
            self.loci.append(Line(self.at(through[0]) + way, self.lies[g]))
            return
        beside = re.search(
            rf"through the point \(({NUMBER})[;,] ({NUMBER})\) mm from ({NAME}) at", line
        )
        if beside:
            way = complex(number(beside[1]), number(beside[2]))
            self.loci.append(Line.of(self.at(beside[3]) + way, self.guide(g).along))
            return
        through = re.search(rf"through ({NAME})", line)
        assert through
        drawn = self.told_line(line, through[1])
        if g in self.lies:
            off = math.degrees(cmath.phase(drawn.along / self.lies[g]))
            if abs(off) > 0.1:  # the angle of its bar is told to a tenth of a degree
                raise DefectError(f"link {g} was found {off:.2f}° from where it is laid off")
        self.loci.append(drawn)

    @says("link ⟨k:link⟩ is placed as at the start: from ⟨p⟩ lay off (?P<names>[^;]*) as given")
    def as_at_start(self, k: str, p: str, names: str) -> None:
        rolls = self.told_of(rf"wheel {k} rolls")
        start = re.search(rf"when the x axis of link {k} is at ({NUMBER}°)", rolls)
        if start is None:
            raise DefectError(f"the axes of link {k} have no start")
        turned = cmath.rect(1, self.angle(start[1]))
        own = {one: turned * where for one, where in self.own_points(k).items()}
        for name in names.split(", "):
            self.put(name, self.at(p) + own[name] - own[p])

    @says("it cuts the guide in ⟨name⟩, (?P<side>to the right of|to the left of|above|below) ⟨p⟩")
    def arc_cuts_guide(self, name: str, side: str, p: str) -> None:
        led = self.ray if self.ray is not None else self.block(name)
        found = crossings(led, self.loci[-1])
        self.one_of(name, [z for z in found if dot(SIDES[side], z - self.at(p)) > 0])

    @says(
        r"(?:with block \w+ on its guide, )?from ⟨p⟩ lay off ⟨s⟩⟨t⟩ at ⟨angle:number⟩° "
        r"to the x axis"
        r"(?:, for link ⟨k:link⟩ has turned by ⟨since:number⟩° since the start"
        r"|, as (?P<why>[^:;]*))?: ⟨name⟩"
    )
    def at_angle(self, p, s, t, angle, name, k, since, why):
        along = cmath.rect(1, math.radians(number(angle)))
        if why == "was found" or (why and "has turned" in why):
            along = cmath.rect(1, self.turned(cmath.phase(along)))
        if since and k in self.rolled:
            told = math.radians(number(since))
            along *= cmath.rect(1, math.copysign(self.rolled[k], told) - told)
        if found := next((each for each in self.drawn.values() if name in each), None):
            self.put(name, found[name])  # as it was found; the page tells its angle to a tenth
            self.drawn_at(p, along, name)
            return
        self.put(name, self.at(p) + along * self.length(s, t))

    @says("from ⟨p⟩ lay off ⟨s⟩⟨t⟩ along the guide of block ⟨k:link⟩, (?P<way>[^,;:]*): ⟨name⟩")
    def along_guide(self, p: str, s: str, t: str, k: str, way: str, name: str) -> None:
        along = self.guide(k).along
        along = math.copysign(1, dot(WAYS[way], along)) * along / abs(along)
        self.put(name, self.at(p) + along * self.length(s, t))

    def drawn_at(self, p: str, along: complex, name: str) -> None:
        """Raises DefectError where a bar that was found does not lie as the page tells."""
        off = math.degrees(cmath.phase((self.at(name) - self.at(p)) / along))
        if abs(off) > 0.1:
            raise DefectError(f"{p}{name} was found {off:.2f}° from where it is told to be")

    @says(
        "link ⟨k:link⟩ has rolled on the fixed wheel, from where it touched it at the start, by "
        "the angle that it has turned through times the radius, ⟨arc:number⟩ mm: ⟨name⟩"
    )
    def rolled_bar(self, k: str, arc: str, name: str) -> None:
        """A bar turned about a drum touches it at its side, the arc from where it did at first."""
        if k in self.drawn:
            self.put(name, self.drawn[k][name])
            return
        item = self.told_of(rf"link {k} rolls in {NAME} on the fixed wheel by the line of link {k}")
        told = re.search(
            rf"through ({NAME}) at ({NUMBER}°) to {NAME}{NAME}, on its (left|right)-hand side, "
            rf"touching it at ({NAME}) when {NAME}{NAME} is at ({NUMBER}°)",
            item,
        )
        if told is None or not told[1] == told[4] == name:
            raise DefectError(f"nothing tells where link {k} touched the wheel at the start")
        drum = next(item for item in self.items if item.startswith("wheel of the frame: centre"))
        about = re.search(rf"centre ({NAME})", drum)
        assert about
        left = 1 if told[3] == "left" else -1
        bar = self.angle("φ")
        along = cmath.rect(1, bar + self.angle(told[2]))
        touched = self.at(about[1]) - left * 1j * along * self.wheel_about(about[1])[1]
        turned = math.copysign(1, bar - self.angle(told[5]))
        self.put(name, touched - left * turned * along * number(arc))

    @says(
        "link ⟨k:link⟩ has moved with the rim, from where it touched the wheel at the start, by "
        "the arc that the wheel has turned through since, ⟨arc:number⟩ mm: ⟨name⟩"
    )
    def moved_with_rim(self, k: str, name: str, arc: str) -> None:
        if k not in self.drawn:
            self.moved_along(k, name, number(arc))
            return
        self.put(name, self.drawn[k][name])

    def moved_along(self, k: str, name: str, arc: float) -> None:
        """A strand or rack that a guide leads past a driven wheel, with the rim of this."""
        own = re.escape(name)
        item = self.told_of(
            rf"wheel {WHEEL} rolls in {NAME} on the line of link {k} through {own} at"
        )
        told = re.match(
            rf"wheel ({WHEEL}) .*, touching it at {own} when ({NAME}){NAME} is at ({NUMBER}°) to "
            rf"guide {k}$",
            item,
        )
        if told is None:
            raise DefectError(f"nothing tells where link {k} lies")
        guide, centre = self.block(name), self.at(told[2])
        touched = guide.point + guide.along * dot(guide.along, centre - guide.point)
        start = self.angle(told[3]) + cmath.phase(guide.along)
        turned = math.remainder(self.angle("φ") - start, 2 * math.pi)
        way = (touched - centre) * 1j * math.copysign(1, turned)
        self.put(name, touched + way / abs(way) * arc)

    @says(
        "draw the rolling line of link ⟨g:link⟩: (?P<line>the line .*?); from the centre of the "
        "fixed wheel the perpendicular to link ⟨h:link⟩; it meets it in the point of contact "
        "⟨name⟩"
    )
    def contact_on_bar(self, line: str, name: str, **_: str) -> None:
        through = re.search(rf"through ({NAME})", line)
        drum = self.told_of("wheel of the frame: centre")
        about = re.search(rf"centre ({NAME})", drum)
        assert through and about
        rolls = self.told_line(line, through[1])
        away = dot(rolls.along, self.at(about[1]) - rolls.point)
        self.put(name, rolls.point + rolls.along * away)

    @says(
        "from ⟨o⟩ lay off ⟨s⟩⟨t⟩ at ⟨angle:number⟩° to the x axis, where wheel ⟨k:link⟩ has come "
        "by rolling: ⟨name⟩"
    )
    def rolled_to(self, o: str, s: str, t: str, angle: str, k: str, name: str) -> None:
        """The centres of a wheel and of what it rolls on are as far apart as their radii say."""
        try:
            apart = self.length(s, t)
        except DefectError:
            apart = self.apart(o, name)
        self.put(name, self.at(o) + cmath.rect(apart, math.radians(number(angle))))

    def apart(self, o: str, p: str) -> float:
        """The distance of the centres of two wheels that touch: R + r, in a ring R − r."""
        (fixed, r), (rolling, own) = (self.wheel_about(point) for point in (o, p))
        rings = [kind.startswith(("ring", "internal")) for kind in (fixed, rolling)]
        return abs(r - own) if any(rings) else r + own

    @says(
        r"by the law [sψ][^=]* = [^;]*; from ⟨p⟩ lay off ⟨s⟩⟨t⟩ = ⟨size:number⟩ mm "
        r"at ⟨angle:number⟩° to the x axis: ⟨name⟩, the centre of curvature of cam ⟨g:link⟩"
    )
    def centre_of_curvature(self, p: str, size: str, angle: str, name: str, **_: str) -> None:
        along = cmath.rect(number(size), math.radians(number(angle)))
        self.put(name, self.at(p) + along)

    @says(
        r"by the law s[^;]*; from ⟨p⟩ lay off ⟨size:number⟩ mm (?P<way>[a-z ]+), along guide "
        r"⟨k:link⟩, then ⟨aside:number⟩ mm (?P<side>[a-z ]+), square to it: ⟨name⟩, "
        r"the centre of curvature of cam ⟨g:link⟩"
    )
    def centre_under_a_face(
        self, p: str, size: str, way: str, k: str, aside: str, side: str, name: str, **_: str
    ) -> None:
        along = self.direction(f"guide {k}")
        steps = ((size, way, along), (aside, side, along * 1j))
        off = (number(mm) * on * math.copysign(1, dot(WAYS[to], on)) for mm, to, on in steps)
        self.put(name, self.at(p) + sum(off))

    @says(
        rf"wheels ⟨g:wheel⟩ and ⟨k:wheel⟩ touch in ⟨name⟩ on their line of centres, "
        rf"{RADIUS}(?: = m·z_\{{[^}}]*\}}/2)? \(⟨r:number⟩ mm\) from ⟨o⟩"
    )
    def wheels_touch(self, g: str, k: str, name: str, r: str, o: str) -> None:
        away, centres = 1, {}
        for item in self.items:
            form = rf"(internal )?(?:gear|wheel|ring) ({WHEEL}|of the frame): centre ({NAME})"
            if match := re.match(form, item):
                link = match[2].replace("of the frame", "0")
                centres[link] = match[3]
                if match[1] and link in (g, k) and match[3] != o:
                    away = -1  # seen from the wheel within, beyond its own centre
        other = next((c for link, c in centres.items() if c != o and link in (g, k)), None)
        if other is None:
            raise DefectError(f"no centre is told of wheel {g} or {k} but {o}")
        along = away * (self.at(other) - self.at(o))
        self.put(name, self.at(o) + along / abs(along) * number(r))

    @says(
        r"the strands of the (?P<kind>open|crossed) belt(?:, produced,)? meet the line of centres "
        r"⟨p⟩⟨q⟩ in ⟨name⟩: there links ⟨g:link⟩ and ⟨k:link⟩ have one velocity"
    )
    def strands_meet(self, kind: str, p: str, q: str, name: str, g: str, k: str) -> None:
        first, second = (self.belted_radius(name, link) for link in (g, k))
        share = first / (first + second) if kind == "crossed" else first / (first - second)
        self.put(name, self.at(p) + (self.at(q) - self.at(p)) * share)

    def belted_radius(self, name: str, link: str) -> float:
        """The radius of the wheel of a link round which the belt of a point runs."""
        told = rf"wheel ({link}[′″‴]*)(?:;| |$)"
        for belt, strands in pairwise(self.items):
            its = re.search(rf"centres in {re.escape(name)}(?: |$)", strands)
            if "belt runs" in belt and its and (match := re.search(told, belt)):
                link = match[1]
        own = rf"wheel {link}: centre .*, {RADIUS} = ({NUMBER})"
        sizes = [re.match(own, item) for item in self.items]
        (size,) = (number(found[1]) for found in sizes if found)
        return size

    # velocities

    @says(
        "from ⟨s⟩ lay off ⟨s2⟩⟨name⟩ = ⟨v:vector⟩ ⊥ ⟨p⟩⟨q⟩ in the sense of ⟨w:turning⟩, "
        "(?:⟨m:number⟩ times )?as long as ⟨p2⟩⟨q2⟩ is drawn(?:: ⟨same:number⟩ mm)?",
        "from ⟨s⟩ lay off ⟨s2⟩⟨name⟩ = ⟨v:vector⟩ ⊥ ⟨p⟩⟨q⟩, ⟨drawn:number⟩ mm, in the sense "
        "of ⟨w:turning⟩",
    )
    def turned_velocity(self, s, s2, name, v, p, q, w, drawn=None, p2="", q2="", m=None, same=None):
        bar = self.at(q) - self.at(p)
        size = number(drawn) if drawn else number(m or "1") * abs(self.at(q2) - self.at(p2))
        agrees(size, same)
        self.put(name, self.at(s) + bar / abs(bar) * 1j * self.sense(w) * size)

    @says(
        r"through ⟨s⟩(?: \(= ⟨c⟩, since there is no slip\)| \(⟨d⟩ has one velocity on both links, "
        r"since there is no slip\))? the perpendicular to ⟨p⟩⟨q⟩"
    )
    def square_to(self, s: str, p: str, q: str, c: str | None, d: str | None) -> None:
        if c and not self.trial:
            self.place.setdefault(canonical(c), self.at(s))
        bar = self.normals.get(canonical(q), self.at(q) - self.at(p))
        self.loci.append(Line.of(self.at(s), bar * 1j))

    @says(
        "through ⟨s⟩ the parallel to (?P<of>(?:guide|track) ⟨k:link⟩|⟨p⟩⟨q⟩)(?:, the "
        "normal of the contact|, the line of centres)?"
    )
    def parallel_to(self, s: str, of: str, **_: str) -> None:
        self.loci.append(Line.of(self.at(s), self.direction(of)))

    @says("at ⟨p⟩ the perpendicular to ⟨v:vector⟩")
    def velocity_normal(self, p: str, v: str) -> None:
        self.loci.append(Line.of(self.at(p), self.set_off(v) * 1j))

    @says(r"pins are the centres of their links: (?P<pairs>[^;]*)")
    def pins(self, pairs: str) -> None:
        for name, point in re.findall(rf"({NAME}) = ({NAME})", pairs):
            self.put(name, self.at(point))

    @says(
        "⟨name⟩, the centre of links ⟨g:link⟩ and ⟨k:link⟩, is where the strands of their belt "
        "meet the line of centres"
    )
    def centre_on_belt(self, name: str, g: str, k: str) -> None:
        told = rf"wheel (?:{g}.* to wheel {k}|{k}.* to wheel {g})(?: |$)"
        for belt, strands in pairwise(self.items):
            if "belt runs" in belt and re.search(told, belt):
                point = re.search(rf"centres in ({NAME})", strands)
                assert point is not None
                self.put(name, self.at(point[1]))

    @says("join ⟨m⟩ and ⟨n⟩")
    def kennedy_line(self, m: str, n: str) -> None:
        self.loci.append(Line.of(self.at(m), self.at(n) - self.at(m)))

    @says("they meet at ⟨name⟩, which is ⟨same⟩ again: a check")
    def kennedy_check(self, name: str, same: str) -> None:
        self.put(name, self.at(same))
        self.meet(name, None)

    @says(
        "they meet at ⟨name⟩(?:, the instantaneous centre of link ⟨k:link⟩"
        "|, the centre of links [^;]*)?"
    )
    def meet(self, name: str, k: str | None) -> None:
        if len(self.loci) != 2:
            raise DefectError(f"{len(self.loci)} lines are drawn, of which two should meet")
        self.one_of(name, crossings(*self.loci))
        self.met[self.trial] = self.at(name)
        self.loci = []

    @says(
        "⟨name⟩ by similarity: it lies on line ⟨a⟩⟨b⟩(?: \\((?:= ⟨t⟩⟨u⟩, )?.*?\\))? as "
        "⟨r⟩ lies on line ⟨p⟩⟨q⟩"
    )
    def similar_in_line(
        self, name: str, a: str, b: str, r: str, p: str, q: str, t: str | None, u: str | None
    ) -> None:
        for image, other in ((t, a), (u, b)):
            if image:
                self.place.setdefault(canonical(image), self.at(other))
        self.similar(name, (a, b), r, (p, q))

    @says("⟨name⟩ by similarity: triangle ⟨x⟩⟨y⟩⟨z⟩ similar to ⟨p⟩⟨q⟩⟨r⟩, in the same sense")
    def similar_point(self, name: str, x: str, y: str, z: str, p: str, q: str, r: str) -> None:
        images, figure = [x, y, z], [p, q, r]
        where = images.index(name)
        third = figure.pop(where)
        images.pop(where)
        self.similar(name, (images[0], images[1]), third, (figure[0], figure[1]))

    def similar(self, name: str, images: tuple[str, str], point: str, bar: tuple[str, str]) -> None:
        a, b = (self.at(image) for image in images)
        p, q = (self.at(end) for end in bar)
        self.put(name, a + (b - a) * (self.at(point) - p) / (q - p))

    @says("⟨q⟩ moves as ⟨p⟩ does: ⟨name⟩ falls on the same point")
    def alike(self, q: str, p: str, name: str) -> None:
        small = canonical(name)
        primes = "′" if "′" in small else ""
        self.put(name, self.at(p[0].lower() + primes + p[1:]))

    @says(
        "rack ⟨k:link⟩ has moved with the rim, from where it touched the wheel at the start, by "
        "the arc that the wheel has turned through since, ⟨arc:number⟩ mm: ⟨name⟩"
    )
    def rack(self, k: str, arc: str, name: str) -> None:
        item = self.told_of(rf"gear {LINK} meshes in {NAME} with a rack along the line of link {k}")
        gear = re.match(rf"gear ({LINK})", item)[1]
        start = re.search(
            rf"touching it at {re.escape(name)} when {NAME}{NAME} is at ({NUMBER}°)", item
        )
        if start is None:
            raise DefectError(f"nothing tells when the rack stood at the wheel in {name}")
        guide, centre = self.block(name), self.centre(gear)
        touched = guide.point + guide.along * dot(guide.along, centre - guide.point)
        turned = self.angle("φ") - self.angle(start[1])
        way = (touched - centre) * 1j * math.copysign(1, turned)
        self.put(name, touched + way / abs(way) * number(arc))

    @says("join the places of ⟨name⟩ in further positions of the mechanism: its path")
    def path(self, name: str) -> None:
        self.at(name)  # the other positions are drawn on other sheets

    @says("⟨name⟩ falls on ⟨s⟩(?:, (?:for|because) .*? is (?:constant|zero))?")
    def falls(self, name: str, s: str) -> None:
        self.put(name, self.at(s))

    @says(
        "from ⟨s⟩ lay off ⟨s2⟩⟨name⟩ = (?P<kind>[av])_\\{[^}]*\\}(?:\\^\\{r\\})? ∥ "
        "(?P<of>(?:guide|track) [^,]*), ⟨drawn:number⟩ mm (?P<way>[^,;]*)"
    )
    def driven_slide(self, s: str, name: str, kind: str, of: str, drawn: str, way: str, **_: str):
        self.put(name, self.at(s) + self.driven_way(of, kind, way) * number(drawn))

    @says(
        "from its end lay off (?P<kind>[av])_\\{[^}]*\\}(?:\\^\\{r\\})? ∥ "
        "(?P<of>guide [^,]*), ⟨drawn:number⟩ mm (?P<way>[^,;:]*): ⟨name⟩"
    )
    def driven_slide_on(self, kind: str, of: str, drawn: str, way: str, name: str) -> None:
        self.put(name, self.its_end() + self.driven_way(of, kind, way) * number(drawn))

    @says(
        "⟨name⟩, the instantaneous centre of link ⟨k:link⟩, is (?:its fixed pin )?⟨p⟩(?:, "
        "whose velocity is zero)?"
    )
    def centre_still(self, name: str, k: str, p: str) -> None:
        self.put(name, self.at(p))

    # accelerations

    @says(
        r"from ⟨s⟩ lay off ⟨s2⟩⟨name⟩ = ⟨v:vector⟩(?: = ω_\{.*?\}\^\{2\}·.*?)? ∥ ⟨p⟩⟨q⟩, "
        "from ⟨q2⟩ to ⟨p2⟩, "
        "(?:(?:⟨times:number⟩ times )?as long as ⟨m⟩⟨n⟩ is drawn(?:: ⟨same:number⟩ mm)?|"
        "⟨drawn:number⟩ mm)"
    )
    def centripetal(self, s, s2, name, v, p, q, q2, p2, m, n, drawn, times, same):
        inward = self.at(p2) - self.at(q2)
        bar = abs(self.at(n) - self.at(m)) if m and n else 0.0
        size = number(drawn) if drawn else number(times or "1") * bar
        agrees(size, same)
        self.put(name, self.at(s) + inward / abs(inward) * size)

    @says(
        r"from ⟨s⟩ lay off (?:⟨s2⟩⟨foot⟩ = )?⟨a:vector⟩"
        r"(?: = (?:⟨w:turning⟩|\([^)]*\))\^\{2\}·⟨m⟩⟨n⟩(?:·⟨far⟩⟨far2⟩/⟨near⟩⟨near2⟩)?)? ∥ ⟨p⟩⟨q⟩, "
        r"from ⟨from_⟩ towards ⟨to⟩(?:, ⟨drawn:number⟩ mm)?"
        r"(?:, for rolling gives the point of contact no other acceleration relative to [^,;(]*)?"
    )
    def lay_off(
        self, s: str, foot: str | None, a: str, from_: str, to: str, drawn: str | None, **_: str
    ) -> None:
        inward = self.at(to) - self.at(from_)
        if drawn is None and a not in self.lengths:
            raise DefectError(f"{a} has no length")
        size = number(drawn) if drawn else self.lengths[a]
        self.before[a] = inward / abs(inward) * size
        self.end = self.at(s) + self.before[a]
        if foot:
            self.put(foot, self.end)

    @says(
        "from (?:its end|⟨s⟩) lay off the tangential component ⟨a:vector⟩ ⊥ ⟨p⟩⟨q⟩, "
        "⟨drawn:number⟩ mm, in the sense of ⟨w:turning⟩: ⟨name⟩"
    )
    def driven_tangential(
        self, s: str | None, a: str, p: str, q: str, drawn: str, w: str, name: str
    ) -> None:
        bar, start = self.at(q) - self.at(p), self.at(s) if s else self.its_end()
        self.put(name, start + bar / abs(bar) * 1j * self.sense(w) * number(drawn))

    @says("through (?:its end|⟨s⟩) ⊥ ⟨p⟩⟨q⟩, the direction of ⟨a:vector⟩")
    def square_to_end(self, s: str | None, p: str, q: str, a: str) -> None:
        start = self.at(s) if s else self.its_end()
        self.loci.append(Line.of(start, (self.at(q) - self.at(p)) * 1j))

    @says(
        "through (?:its end|⟨s⟩) ∥ (?P<of>(?:guide|track) ⟨k:link⟩|⟨p⟩⟨q⟩), the direction of "
        "⟨a:vector⟩"
    )
    def parallel_to_end(self, s: str | None, of: str, **_: str) -> None:
        self.loci.append(Line.of(self.at(s) if s else self.its_end(), self.direction(of)))

    @says("from ⟨s⟩ ⟨a:vector⟩ leads to ⟨name⟩, along (?P<of>guide ⟨k:link⟩)")
    def leads_along(self, s: str, name: str, of: str, **_: str) -> None:
        """A check: both are known."""
        way, along = self.at(name) - self.at(s), self.direction(of)
        if (off := abs(cross(along / abs(along), way))) > 0.3:
            raise DefectError(f"{name} lies {off:.2f} mm beside the line along {of}")

    @says(
        "the velocities of ⟨p⟩ and ⟨q⟩ are parallel: set at these points, the line through their "
        "tips meets ⟨m⟩⟨n⟩ in ⟨name⟩, the instantaneous centre of link ⟨k:link⟩"
    )
    def centre_of_parallels(self, p: str, q: str, name: str, **_: str) -> None:
        one, two = (self.set_off(f"v_{{{point}}}") for point in (p, q))
        tips = Line.of(self.at(p) + one, self.at(q) + two - self.at(p) - one)
        self.one_of(name, crossings(tips, Line.of(self.at(p), self.at(q) - self.at(p))))

    @says(
        "normal component ⟨a:vector⟩ by Klein’s construction: the perpendicular to the guide at "
        "⟨o⟩ cuts ⟨c⟩⟨p⟩ in ⟨tip⟩, so that .*?; the circle about ⟨c2⟩ through ⟨tip2⟩, and the "
        "circle on ⟨c3⟩⟨p2⟩ as diameter; their common chord cuts ⟨c4⟩⟨p3⟩ in ⟨cut⟩ and the "
        r"parallel to the guide through ⟨o2⟩ in ⟨end⟩; ⟨c5⟩⟨cut2⟩ = ⟨a2:vector⟩/ω_\{.*?\}\^\{2\}, "
        "and ⟨end2⟩⟨o3⟩ is the whole acceleration of ⟨p4⟩, divided by .*? too(?:; the plan draws "
        "both ⟨times:number⟩ times as long)?"
    )
    def klein(
        self, a: str, o: str, c: str, p: str, tip: str, cut: str, end: str, times: str, **_: str
    ) -> None:
        guide, rod = self.block(p).along, Line.of(self.at(c), self.at(p) - self.at(c))
        (foot,) = crossings(Line.of(self.at(o), 1j * guide), rod)
        middle, length = (self.at(c) + self.at(p)) / 2, abs(self.at(p) - self.at(c))
        ends = crossings(Circle(self.at(c), abs(foot - self.at(c))), Circle(middle, length / 2))
        chord = Line.of(ends[0], ends[1] - ends[0])
        index = "_" + re.match(r"a_\{(.*?)\}", a)[1]
        (meets,), (far,) = crossings(chord, rod), crossings(chord, Line.of(self.at(o), guide))
        for name, where in ((tip, foot), (cut, meets), (end, far)):
            self.put_triangle(canonical(name) + index, where)
        self.lengths[a] = number(times or "1") * abs(meets - self.at(c))

    @says(
        r"on it lay off ⟨p⟩⟨name⟩ = \(component of ⟨a:vector⟩ along it\)/ω_\{.*?\}\^\{2\} "
        r"\((?:< )?⟨drawn:number⟩ mm\)"
    )
    def inflection_of(self, p: str, name: str, drawn: str, **_: str) -> None:
        """Nothing to lay off where that is less than a ruler shows."""
        normal = self.loci.pop()
        assert isinstance(normal, Line)
        if number(drawn) > 0.01:
            raise DefectError(f"nothing tells to which side of {p} {name} lies")
        self.put(name, self.at(p))
        self.normals[canonical(name)] = normal.along
        self.square.append(normal)

    @says("⟨name⟩ is where the perpendiculars to the velocities meet")
    def where_normals_meet(self, name: str) -> None:
        self.one_of(name, crossings(*self.square))

    @says("(?:and )?the circle with ⟨i⟩⟨w⟩ as diameter is the inflection circle of link ⟨k:link⟩.*")
    def inflection_circle(self, w: str, **_: str) -> None:
        self.at(w)

    @says("set (?:⟨foot⟩⟨s2⟩ = )?⟨a:vector⟩ with its tip at ⟨s⟩")
    def lay_back(self, foot: str | None, a: str, s: str, **_: str) -> None:
        if a not in self.vectors:
            raise DefectError(f"{a} has no direction")
        self.tail = self.at(s) - self.vectors[a]
        self.tails[self.trial] = self.tail
        if foot:
            self.put(foot, self.tail)

    @says("from ⟨s⟩ lay off (?:⟨s2⟩⟨foot⟩ = )?⟨a:vector⟩")
    def lay_off_vector(self, s: str, foot: str | None, a: str, **_: str) -> None:
        if a not in self.vectors:
            raise DefectError(f"{a} has no direction")
        self.end = self.at(s) + self.vectors[a]
        if foot:
            self.put(foot, self.end)

    @says("through its tail ∥ (?P<of>(?:guide|track) ⟨k:link⟩|⟨p⟩⟨q⟩), the direction of ⟨a:vector⟩")
    def parallel_to_tail(self, of: str, **_: str) -> None:
        if self.tail is None:
            raise DefectError("nothing was set whose tail is meant")
        self.loci.append(Line.of(self.tail, self.direction(of)))

    @says(
        "normal component ⟨a:vector⟩ by the right triangle: at ⟨q⟩ set ⟨v:set⟩ of the "
        "velocity plan, its tip is ⟨tip⟩; at ⟨tip2⟩ the perpendicular to ⟨p⟩⟨tip3⟩ cuts "
        "⟨m⟩⟨n⟩ in ⟨cut⟩; turned by 180° about ⟨q2⟩ this gives ⟨end⟩; "
        "⟨more:times⟩⟨q3⟩⟨end2⟩ = ⟨a2:vector⟩"
    )
    def normal(self, a: str, q: str, v: str, tip: str, p: str, more: str, **_: str) -> None:
        factor, v = factored(v)
        self.shorter, self.longer = 1 / factor, times(more)
        self.triangle(a, v, p, q, tip[0])

    def triangle(self, a: str, v: str, p: str, q: str, letter: str) -> None:
        """The right triangle: its height on the bar is the velocity."""
        centre, point = self.at(p), self.at(q)
        index = "_" + re.match(r"a_\{(.*?)\}", a)[1]
        tip = point + self.set_off(v) / self.shorter
        bar = Line.of(centre, point - centre)
        (cut,) = crossings(Line.of(tip, (tip - centre) * 1j), bar)
        end = 2 * point - cut
        for primes, where in (("″", tip), ("‴", cut), ("⁗", end)):
            self.put_triangle(letter + primes + index, where)
        self.lengths[a] = self.longer * abs(end - point)

    def put_triangle(self, name: str, where: complex) -> None:
        self.place[name] = where
        self.place[name.split("_", maxsplit=1)[0]] = where

    @says("(?:in the same way )?⟨a:vector⟩ at ⟨q⟩ on ⟨m⟩⟨n⟩ from ⟨v:vector⟩")
    def normal_again(self, a: str, q: str, m: str, n: str, v: str) -> None:
        self.triangle(a, v, n if m == q else m, q, q[0])

    @says(
        r"⟨a:vector⟩ = ⟨v:vector⟩\^\{2\}/⟨m⟩⟨n⟩ at ⟨q⟩ on ⟨p⟩⟨r⟩, towards ⟨c⟩, computed: "
        "⟨drawn:number⟩ mm"
    )
    def normal_computed(self, a: str, drawn: str, **_: str) -> None:
        self.lengths[a] = number(drawn)

    @says("what is too short to be drawn is left out: .*")
    def too_short(self) -> None:
        """Left out, as the page says."""

    @says("⟨a:vector⟩ = 0, because (?:⟨v:vector⟩|⟨w:turning⟩) is zero")
    def none(self, a: str, **_: str) -> None:
        self.lengths[a], self.vectors[a] = 0.0, 0j

    @says("⟨a:vector⟩ = 0, because (?:⟨v:vector⟩|⟨w:turning⟩) = 0(?:, ⟨w2:turning⟩ = 0)?")
    def coriolis_none(self, a: str, v: str | None, **_: str) -> None:
        if v is not None and abs(self.set_off(v)) > 1e-6:
            raise DefectError(f"{v} is not zero")
        self.none(a)

    @says(
        r"Coriolis component ⟨a:vector⟩ by similar triangles: at ⟨p⟩ set ⟨v:set⟩ = ⟨xy:segment⟩"
        r"(?: \(velocities are set at (?:1/⟨m:number⟩ of|⟨n:number⟩ times)"
        r" the velocity plan’s scale\))?"
        r", tip ⟨e⟩; at ⟨e2⟩ the perpendicular; it is cut in ⟨f⟩ by (?P<line>.*?); "
        r"⟨more:times⟩⟨e3⟩⟨f3⟩ = ⟨a2:vector⟩, as ⟨v2:vector⟩ turned by 90° in the sense of "
        "⟨w:turning⟩"
    )
    def coriolis(
        self, a: str, p: str, xy: str, e: str, f: str, line: str, w: str, more: str, **_: str
    ) -> None:
        self.coriolis_before = p, line, w
        self.longer = times(more)
        plan = self.velocity
        factor, ends = factored(xy)
        x, y = re.fullmatch(rf"({NAME})({NAME})", ends).groups()
        slide = factor * (plan[canonical(y)] - plan[canonical(x)])
        foot = self.at(p)
        tip = foot + slide
        (cut,) = crossings(Line.of(tip, slide * 1j), Line.of(foot, self.line_of(line, p, tip)))
        index = "_" + re.match(r"a_\{(.*?)\}", a)[1]
        e, f = e[0], f[0]
        self.place[canonical(e) + index], self.place[canonical(f) + index] = tip, cut
        self.vectors[a] = slide / abs(slide) * 1j * self.sense(w) * self.longer * abs(cut - tip)

    @says("in the same way ⟨a:vector⟩ from ⟨v:set⟩ = ⟨xy:segment⟩")
    def coriolis_again(self, a: str, xy: str, **_: str) -> None:
        if self.coriolis_before is None:
            raise DefectError("no Coriolis component came before")
        p, line, w = self.coriolis_before
        self.coriolis(a, p, xy, "e", "f", line, w, f"{self.longer}·")

    @says(
        r"compute ⟨a:vector⟩ = 2⟨w:turning⟩·⟨v:vector⟩(?: \(its triangles would .*?\))?: "
        "⟨drawn:number⟩ mm in the plan, as ⟨v2:vector⟩ turned by 90° in the sense of ⟨w2:turning⟩"
    )
    def coriolis_computed(self, a: str, v: str, drawn: str, w2: str, **_: str) -> None:
        slide = self.set_off(v)
        self.vectors[a] = slide / abs(slide) * 1j * self.sense(w2) * number(drawn)

    def line_of(self, words: str, p: str, tip: complex) -> complex:
        """The direction from a point of the line that a Coriolis triangle is cut by."""
        if match := re.fullmatch(rf"the line ({NAME})({NAME})", words):
            return self.at(match[2]) - self.at(match[1])
        if match := re.fullmatch(
            rf"the line from ({NAME}) to the tip of ({SET}), set at ({NAME})", words
        ):
            factor, v = factored(match[2])
            return self.at(match[3]) + factor * self.set_off(v) - self.at(match[1])
        if match := re.fullmatch(
            rf"the line from {NAME} that makes with {NAME}{NAME} the angle which "
            rf"({NAME})({NAME}) makes"
            rf" with the line from ({NAME}) to the tip of ({SET}), set at ({NAME})",
            words,
        ):
            bar = self.at(match[2]) - self.at(match[1])
            factor, v = factored(match[4])
            to = self.at(match[5]) + factor * self.set_off(v) - self.at(match[3])
            return (tip - self.at(p)) * to / bar
        raise DefectError(f"no rule reads: {words}")

    @says(
        r"acceleration pole ⟨name⟩ of link ⟨k:link⟩: triangle ⟨j⟩⟨p⟩⟨q⟩ similar to "
        r"⟨o⟩⟨a⟩⟨b⟩, same sense \(.*?\)"
    )
    def acceleration_pole(
        self, name: str, p: str, q: str, o: str, a: str, b: str, **_: str
    ) -> None:
        self.similar(name, (p, q), o, (a, b))


# -- reading a pair of sheets ---------------------------------------------------------------------


@dataclass(frozen=True)
class Followed:
    """What came of one sheet: where the points fell, the key, the step that stopped the hand."""

    reached: dict[str, complex]
    key: dict[str, complex]
    step: int | None
    defect: str
    tried: bool = False
    """Whether trial plans were drawn: ends of components are told in them alone."""

    def deviations(self) -> dict[str, float]:
        """How far each point of the key is from where the sentences lead, in mm; not reached: ∞."""
        reached = {bare(name): where for name, where in self.reached.items()}
        return {
            name: abs(reached[bare(name)] - where) if bare(name) in reached else math.inf
            for name, where in self.key.items()
        }


def sheets(folder: Path, name: str, sheet: str) -> tuple[Printed, Printed]:
    """The key and the task of one sheet."""
    names = (folder / f"{name}-{sheet}-{view}.svg" for view in ("key", "task"))
    key, task = map(printed_sheets, names)
    return key, task


def moved_key(key: Printed, task: Printed, pole: str) -> dict[str, complex]:
    """The marks of a key, moved to where the task has the same pins and pole."""
    pins = [name for name in task.marks if name in key.marks and name[0].isupper()]
    shift = task.marks[pins[0]] - key.marks[pins[0]] if pins else 0
    of_plan = task.marks[pole] - key.marks[pole]
    plan = re.compile(r"[a-z]′?(_.*)?" if pole == "o" else r"[a-z]′(_.*)?|[nk]_.*")
    return {
        name: where + (of_plan if plan.fullmatch(name) else shift)
        for name, where in key.marks.items()
    }


def follow(folder: Path, name: str) -> Iterator[tuple[str, Followed]]:
    """Follows the velocity sheet, then the acceleration sheet, of a scene drawn into a folder."""
    plan: dict[str, complex] = {}
    first: list[str] = []
    for sheet, pole in (("velocity", "o"), ("acceleration", "o′")):
        if not (folder / f"{name}-{sheet}-key.svg").exists():
            continue
        key, task = sheets(folder, name, sheet)
        reader = Reader(key.data, key.scale, task.links, dict(task.marks))
        step, defect = None, ""
        try:
            if plan:
                reader.place["o"] = 0j
                for after, sentence in enumerate(first, 1):
                    reader.ahead = first[after:]
                    reader.follow(sentence)
                reader.velocity = plan
                reader.place = {n: z for n, z in reader.place.items() if n[0].isupper() or "′" in n}
            for number_, sentence in enumerate(key.sentences, 1):
                step, reader.ahead = number_, key.sentences[number_:]
                reader.follow(sentence)
            step = None
        except DefectError as told:
            defect = str(told)
        moved, tried = moved_key(key, task, pole), bool(reader.blocks)
        yield sheet, Followed(reader.place, moved, step, defect, tried)
        if sheet == "velocity":
            first = key.sentences
            plan = {n: z for n, z in reader.place.items() if n[0].islower()}
