"""Relative centres of any two links, by Kennedy's lines or from the velocity plan.

The centres of three links lie on one line (Kennedy, Aronhold). Pins, guides and contact points are
centres at once. Every other centre is where two such lines meet. In groups of class III and higher
the circle diagram stops. There the normals to two velocities give a centre against the frame.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from math import hypot, sqrt

from graphkin.construction.centres.instant_centre import (
    GuideCentre,
    LineOfCentres,
    LineToCentre,
    PinCentre,
    RelativeCentre,
    guide_centre,
    kennedy_endless,
    kennedy_line,
    kennedy_meet,
    normals_at,
    normals_meet,
    pin_centre,
    relative_centre,
)
from graphkin.construction.core.pen import Pen, step_name
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.run import StepFailed, Trace, run
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import FRAME
from graphkin.text.errors import ClosureError

Pair = tuple[str, str]
"""Two links, in the order of the scene."""
Route = tuple[str, str] | None
"""The two links over which a centre is found; None for one found by two normals."""
Spot = tuple[float, float, float]
"""A centre in homogeneous coordinates of length 1; the third is zero at infinity."""

GOOD, LEAST = 0.2, 1e-6
"""Sine of a crossing that is as good as any, and sine below which nothing crosses."""
MOST = 12
"""The largest number of triangles tried on one side."""


def routes(
    links: Sequence[str],
    known: Collection[Pair],
    centres: Mapping[Pair, Spot],
    normals: Collection[str],
) -> dict[Pair, Route]:
    """How each unknown centre is found, each from known or earlier centres.

    ``links`` begin with the frame. ``normals`` are the links whose centre against the frame two
    normals can give; these are used only where no two lines meet. Centres missing in the result
    cannot be found.
    """
    found = dict.fromkeys(known)
    ways: dict[Pair, Route] = {}
    joined = {link: {a if b == link else b for a, b in found if link in (a, b)} for link in links}
    missing = [pair for pair in combinations(links, 2) if pair not in found]
    while missing:
        step = best(links, missing, joined, centres)
        if not step:
            stuck = [(links[0], link) for link in links[1:] if (links[0], link) in missing]
            step = {pair: None for pair in stuck if pair[1] in normals}
            step = dict(list(step.items())[:1])
        if not step:
            break
        for (a, b), way in step.items():
            ways[a, b] = way
            joined[a].add(b)
            joined[b].add(a)
        missing = [pair for pair in missing if pair not in step]
    return ways


def best(
    links: Sequence[str],
    missing: Sequence[Pair],
    joined: Mapping[str, set[str]],
    centres: Mapping[Pair, Spot],
) -> dict[Pair, Route]:
    """The missing centres found by good crossings, or else the one found by the best crossing."""
    tried = {
        pair: crossing
        for pair in missing
        if (crossing := squarest_lines(links, pair, joined, centres)) is not None
    }
    if not tried:
        return {}
    good = {pair: way for pair, (sine, way) in tried.items() if sine >= GOOD}
    first = max(tried, key=lambda pair: tried[pair][0])
    return dict(good) or {first: tried[first][1]}


def squarest_lines(
    links: Sequence[str], pair: Pair, joined: Mapping[str, set[str]], centres: Mapping[Pair, Spot]
) -> tuple[float, Pair] | None:
    """The two lines to a centre that cross closest to a right angle; None where no two cross."""
    over = [link for link in links if link in joined[pair[0]] and link in joined[pair[1]]][:MOST]
    lines = {link: line_over(links, pair, link, centres) for link in over}
    tried = [
        (min(first[1], second[1], sine(first[0], second[0])), (k, m))
        for k, m in combinations(over, 2)
        if (first := lines[k]) is not None and (second := lines[m]) is not None
    ]
    crossing = max(tried, key=lambda each: each[0], default=None)
    return crossing if crossing is not None and crossing[0] >= LEAST else None


def line_over(
    links: Sequence[str], pair: Pair, link: str, centres: Mapping[Pair, Spot]
) -> tuple[Spot, float] | None:
    """The line through the centres of a third link with each of two, and the distance of these."""
    first, second = (centres.get(ordered(links, end, link)) for end in pair)
    if first is None or second is None:
        return None
    apart = sine(first, second)
    return (unit(*cross(first, second)), apart) if apart >= LEAST else None


def ordered(links: Sequence[str], a: str, b: str) -> Pair:
    return (a, b) if links.index(a) < links.index(b) else (b, a)


def cross(a: Spot, b: Spot) -> Spot:
    """The line through two points, or the point on two lines, in homogeneous coordinates."""
    (x, y, z), (u, v, w) = a, b
    return y * w - z * v, z * u - x * w, x * v - y * u


def sine(a: Spot, b: Spot) -> float:
    """The sine of the angle between unit vectors of points or lines; zero if these are equal."""
    x, y, z = cross(a, b)
    return sqrt(x * x + y * y + z * z)


def unit(x: float, y: float, z: float) -> Spot:
    size = hypot(x, y, z) or 1.0
    return x / size, y / size, z / size


ENDLESS = 1e-9
"""A centre lies at infinity below this third coordinate, with the mechanism's breadth as unit."""
MANY = 40
"""Number of links above which no route over other links is searched: no sheet could hold it."""


def draw_relative(pen: Pen) -> None:
    """Draw the requested relative centres, and the centres from which they are found by hand."""
    finder = Finder(pen)
    for pair in pen.scene.ask.pairs:
        first, second = pair.split("-")
        if finder.moves(first) and finder.moves(second):
            pen.want("centre", pair, finder.centre((first, second)))


class Finder:
    """Draws relative centres, each once, after the centres from which it is found."""

    def __init__(self, pen: Pen) -> None:
        self.pen = pen
        self.links = (FRAME, *pen.scene.links)
        self.drawn: dict[Pair, int] = {}

    def moves(self, link: str) -> bool:
        """Whether a link is the frame, or has constructed velocities."""
        return link == FRAME or (self.pen.has(OMEGA, link) and bool(self.points(link)))

    def points(self, link: str) -> list[str]:
        """The points of a link whose velocities are constructed."""
        points = self.pen.scene.link(link).points
        return [p for p in points if self.pen.has("position", p) and self.pen.has("velocity", p)]

    @cached_property
    def pins(self) -> dict[Pair, str]:
        """The first pin that each two links share."""
        found: dict[Pair, str] = {}
        for a, b in combinations(self.links, 2):
            there = self.pen.scene.link(b).points
            shared = [p for p in self.pen.scene.link(a).points if p in there]
            if shared and self.pen.has("position", shared[0]):
                found[a, b] = shared[0]
        return found

    @cached_property
    def guides(self) -> dict[Pair, tuple[str, int]]:
        """Each block and its guide: the block's name and the step of the guide's line."""
        found: dict[Pair, tuple[str, int]] = {}
        for link in self.pen.scene.links.values():
            line = self.pen.targets.get(("guide", link.name))
            if len(link.slides) == 1 and line is not None and self.points(link.name):
                found[ordered(self.links, link.name, link.slides[0].on)] = link.name, line
        return found

    @cached_property
    def belted(self) -> frozenset[Pair]:
        return frozenset(ordered(self.links, *pair) for pair in self.pen.scene.belted)

    @cached_property
    def touching(self) -> frozenset[Pair]:
        """Each wheel and the link in contact with it: their centre is the contact point.

        Wheels that an open belt turns alike have no such centre.
        """
        return frozenset(ordered(self.links, *pair) for pair in self.pen.scene.in_touch)

    @cached_property
    def ways(self) -> dict[Pair, tuple[str, str] | None]:
        """How each centre is found that is not a pin, a guide or a contact point."""
        links = [link for link in self.links if self.moves(link)]
        if len(links) > MANY:
            return {}
        every = {*self.pins, *self.guides, *self.touching}
        known = {pair for pair in every if pair[0] in links and pair[1] in links}
        normals = [link for link in links[1:] if len(self.swift(link)) > 1]
        return routes(links, known, self.where, normals)

    @cached_property
    def here(self) -> Trace | None:
        """All velocities at the scene's own values; None where the mechanism does not close."""
        program = self.pen.program()
        wanted = [t for t in program.targets if t[0] in ("position", "velocity", OMEGA, "guide")]
        try:
            return run(program, program.needed(wanted), self.pen.scene.values, FLOAT)
        except (StepFailed, ClosureError):
            return None

    @cached_property
    def where(self) -> dict[Pair, Spot]:
        """The places of the centres at the scene's own values, in units of the mechanism's breadth.

        Links without relative motion that are not joined have no centre.
        """
        if self.here is None:
            return {}
        links = [link for link in self.links if self.moves(link)]
        spots = [self.here.value("position", p) for link in links for p in self.points(link)]
        middle = sum(spots) / len(spots)
        breadth = max(abs(spot - middle) for spot in spots) or 1.0
        fastest = max(abs(self.here.value(OMEGA, link)) for link in links[1:]) or 1.0
        found: dict[Pair, Spot] = {}
        for pair in combinations(links, 2):
            ratio = self.ratio(pair, self.here)
            way = (ratio.start - middle) / breadth * ratio.size + ratio.shift / breadth
            if hypot(abs(way), ratio.size) > (0 if pair in self.joined else ENDLESS * fastest):
                found[pair] = unit(way.real, way.imag, ratio.size)
        return found

    @cached_property
    def joined(self) -> frozenset[Pair]:
        """The links that a pin or a guide joins."""
        return frozenset({*self.pins, *self.guides})

    def ratio(self, pair: Pair, here: Trace) -> Ratio:
        """A centre at the scene's own values."""
        if pair in self.pins:
            return Ratio(here.value("position", self.pins[pair]), 0j, 1.0)
        if pair in self.guides:
            block, line = self.guides[pair]
            along = here.values[line].along
            start = here.value("position", self.points(block)[0])
            return Ratio(start, 1j * along / abs(along), 0.0)
        motions = (number for link in reversed(pair) for number in self.motion(link))
        return Ratio(*relative_centre(*(here.values.get(n, 0.0) for n in motions)))

    def swift(self, link: str) -> list[str]:
        """The points of a link that are not at rest, one for each place."""
        if self.here is None:
            return self.points(link)
        found: dict[complex, str] = {}
        for point in self.points(link):
            if self.here.value("velocity", point):
                found.setdefault(self.here.value("position", point), point)
        return list(found.values())

    def motion(self, link: str, point: str = "") -> tuple[int, int, int]:
        """The steps of place and velocity of a point of a link, and of its angular velocity."""
        o = self.pen.pole(Plane.VELOCITIES)
        if link == FRAME:
            return (self.pen.the("position", point) if point else o), o, self.pen.given("zero")
        point = point or self.points(link)[0]
        place, image = self.pen.the("position", point), self.pen.the("velocity", point)
        return place, image, self.pen.the(OMEGA, link)

    def centre(self, pair: Pair) -> int:
        """The step of the centre of two links."""
        if pair not in self.drawn:
            with self.pen.on(Part.CENTRE, Plane.MECHANISM):
                self.drawn[pair] = self.draw(pair)
        return self.drawn[pair]

    def draw(self, pair: Pair) -> int:
        """Draw a pin, a guide's centre at infinity, or the centre by velocities and by hand."""
        pen, first, second = self.pen, *pair
        name = pair_name(first, second)
        if pair in self.pins:
            pin = self.pins[pair]
            found = pen.draw(pin_centre, pen.the("position", pin), name=name)
            pen.make(PinCentre(name=name, first=first, link=second, point=pin, found=found))
            return found
        if pair in self.guides:
            block, line = self.guides[pair]
            point = self.points(block)[0]
            found = pen.draw(guide_centre, pen.the("position", point), line, name=name)
            pen.make(
                GuideCentre(
                    name=name, first=first, link=second, point=point, block=block, found=found
                )
            )
            return found
        start, point = self.start(pair)
        motions = *self.motion(start, point), *self.motion(first if start == second else second)
        ways, crossing = self.by_hand(pair) if pair in self.ways else ((), None)
        found = pen.draw(relative_centre, *motions, name=name, by_hand=crossing)
        pen.make(
            RelativeCentre(
                name=name,
                first=first,
                link=second,
                point=point,
                found=found,
                ways=ways,
                crossing=crossing,
                touching=pair in self.touching,
                belted=pair in self.belted,
                aside=crossing is not None and not self.on_line(pair, point),
            )
        )
        return found

    def start(self, pair: Pair) -> tuple[str, str]:
        """The link and the point from which a centre is computed, on a drawn line if there is one.

        The arrow to a centre off the sheet then lies on that line.
        """
        for over in self.ways.get(pair) or ():
            for end in reversed(pair):
                pin = self.pins.get(ordered(self.links, end, over))
                if pin is not None and self.pen.has("velocity", pin):
                    return end, pin
        return pair[1], (self.swift(pair[1]) or self.points(pair[1]))[0]

    def on_line(self, pair: Pair, point: str) -> bool:
        """Whether a line is drawn from a point to a centre."""
        over = self.ways.get(pair)
        joined = [self.pins.get(ordered(self.links, e, k)) for k in over or () for e in pair]
        return over is None or point in joined

    def by_hand(self, pair: Pair) -> tuple[tuple[LineToCentre, ...], int | None]:
        """The construction by hand: the lines that meet in a centre, and the step where they meet.

        The lines are two lines of centres, or the normals to the velocities of two points.
        """
        over = self.ways[pair]
        if over is None:
            with self.pen.hands_way():
                points = tuple(self.swift(pair[1])[:2])
                normals = normals_at(self.pen, points, self.pen.pole(Plane.VELOCITIES))
                return normals, self.pen.draw(normals_meet, *(line.line for line in normals))
        lines = tuple(line for each in over if (line := self.line(pair, each)) is not None)
        if not lines:
            return (), None
        with self.pen.hands_way():
            meeting = kennedy_meet if len(lines) == 2 else kennedy_endless
            return lines, self.pen.draw(meeting, *(line.line for line in lines))

    def line(self, pair: Pair, over: str) -> LineOfCentres | None:
        """The line of a third link's centres with two links; None where both are at infinity."""
        ends = [ordered(self.links, end, over) for end in pair]
        sizes = (self.where.get(end, (0.0, 0.0, 1.0))[2] for end in ends)
        if all(abs(size) <= ENDLESS for size in sizes):
            return None
        m, n = (self.centre(end) for end in ends)
        with self.pen.hands_way():
            line = self.pen.draw(kennedy_line, m, n)
        letters = step_name(self.pen, m), step_name(self.pen, n)
        return self.pen.make(LineOfCentres(letters=letters, ends=(m, n), line=line))


def pair_name(first: str, second: str) -> str:
    """The name of a centre: I24 for links 2 and 4; I_10,12 and I_arm,sun for longer names."""
    plain = all(link.isdigit() and len(link) == 1 for link in (first, second))
    return f"I{first}{second}" if plain else f"I_{first},{second}"
