"""One who holds a page and a pencil: what is told and drawn, looked up; a sentence taken apart."""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import dataclass, field
from itertools import pairwise

from tests.documents.printed_sheet import NAME, NUMBER, RADIUS, WHEEL, canonical, number
from tests.documents.reader_rules import RULES, TURNING, VECTOR
from tests.documents.ruler_and_compass import APART, Circle, DefectError, Line, cross, dot

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0}

SIDES = {"to the right of": 1, "to the left of": -1, "above": 1j, "below": -1j}
WAYS = {"to the right": 1, "to the left": -1, "upwards": 1j, "downwards": -1j}
GLOSS = re.compile(rf" ?\(({NAME}) is the point of link [^)]* coincident with ({NAME})\)")
POLE_GLOSS = re.compile(rf" ?\(({NAME}) is the image of ({NAME}), for ({NAME}) is the pole\)")
PLAN = re.compile(
    rf"(first|second) trial plan, with (?:a (?:round )?number[^)]*\), )?({TURNING}) = "
    rf"(0|{NUMBER} rad/s(?:\^\{{2\}})? (counter-)?clockwise): "
)
LAST = {"first": "I", "second": "II"}


def by_angle(words: str) -> str:
    """A line of the frame by its angle, where the words say that it is horizontal or vertical."""
    for name, angle in (("horizontal", 0), ("vertical", 90)):
        told = rf"the {name} line through (\([^)]*\) (?:mm|cm|m)|[^,; ]*)"
        words = re.sub(told, rf"the line through \1 at {angle}° to the x axis", words)
    return words


def sliding(point: str, link: str) -> str:
    """The form of a sliding point's name: its own, or with the link where several share it."""
    own = rf"|{re.escape(point)}_\{{{re.escape(link)}\}}" if link else ""
    return rf"(?:{re.escape(point)}{own})"


@dataclass
class Hand:
    """One who draws from two sheets: the places reached, by their names."""

    data: str
    scale: float
    links: dict[str, str]
    place: dict[str, complex]
    velocity: dict[str, complex] = field(default_factory=dict)
    """The points of the velocity plan, while the accelerations are drawn."""
    loci: list[Line | Circle] = field(default_factory=list)
    lies: dict[str, complex] = field(default_factory=dict)
    """The directions of links that are found by their tangents."""
    tangent: complex | None = None
    """That of the last link so found, until another lies on a line of two points."""
    ray: Line | None = None
    end: complex | None = None
    tail: complex | None = None
    offset: complex = 0j
    """By how much the sentence shifts a guide that it draws when it is cut."""
    senses: dict[str, int] = field(default_factory=dict)
    """Senses of what turns, as sentences have told them by a velocity over a length."""
    coriolis_before: tuple[str, str, str] | None = None
    """The centre, the line and the turning of the Coriolis triangle drawn last."""
    shorter: float = 1.0
    """How many times shorter than in the plan velocities are set on the mechanism."""
    longer: float = 1.0
    """How many times longer than there what triangles give is laid off."""
    lengths: dict[str, float] = field(default_factory=dict)
    """Lengths of components found at the mechanism, by their symbols."""
    vectors: dict[str, complex] = field(default_factory=dict)
    glossed: bool = False
    """Whether the page has said of which link a point with an index is."""
    image_of: dict[str, str] = field(default_factory=dict)
    """Names of images that the page tells because they are not the small letter."""
    drawn: dict[str, dict[str, complex]] = field(default_factory=dict)
    """The points of links that were moved in steps until they closed."""
    frame: dict[str, complex] = field(default_factory=dict)
    """The fixed points of the data, in mm of the mechanism."""
    resting: set[str] = field(default_factory=set)
    """The points in which wheels touch fixed wheels: there is no slip, so they have no velocity."""
    own: dict[str, dict[str, complex]] = field(default_factory=dict)
    """The points of links in their own axes, as printed, in mm of the mechanism."""
    faces: dict[str, complex] = field(default_factory=dict)
    """The directions of faces of cams' followers, by the blocks that stand for contacts on them."""
    ahead: list[str] = field(default_factory=list)
    """The sentences that follow the one at hand."""
    turn: tuple[str, float] | None = None
    """The link that was moved in steps, and the angle at which all closes."""
    tracks: dict[tuple[str, str], Line] = field(default_factory=dict)
    """Tracks of wheels on links that move, as drawn."""
    square: list[Line] = field(default_factory=list)
    """The perpendiculars to velocities on which points were laid off."""
    normals: dict[str, complex] = field(default_factory=dict)
    """The directions of lines on which points were laid off, by these."""
    rolled: dict[str, float] = field(default_factory=dict)
    """By what angles, in radians, wheels have rolled to the places that were found."""
    trial: str = ""
    """The number of the trial plan at hand, I or II."""
    blocks: dict[str, str] = field(default_factory=dict)
    """What the first trial plan said, by the points that came of it."""
    begun: list[str] = field(default_factory=list)
    before: dict[str, complex] = field(default_factory=dict)
    """Components as they were laid off, by their symbols."""
    gaps: tuple[complex, complex] | None = None
    """The gaps of two trials, as measured last."""
    tails: dict[str, complex] = field(default_factory=dict)
    """The tails of the vectors set last with their tips at a point, by trials."""
    met: dict[str, complex] = field(default_factory=dict)
    """The points in which two lines met last, by trials."""

    def __post_init__(self) -> None:
        self.items = re.split(r"; (?![^(]*\))", self.data)
        given = {}
        for item in self.items:
            if match := re.fullmatch(rf"({NAME}) \(({NUMBER})[;,] ({NUMBER})\) (mm|cm|m)", item):
                unit = MILLIMETRES[match[4]]
                given[match[1]] = complex(number(match[2]), number(match[3])) * unit
        for item in self.items:
            if match := re.fullmatch(r"(.*): in the axes of link (\w+)", item):
                told = (each.split(" ≡ ") for each in match[1].split(", "))
                self.own[match[2]] = {names[-1]: given.pop(names[0]) for names in told}
        touches = rf"(?:gear|wheel) {WHEEL} (?:meshes|rolls) in ({NAME}) (?:with|on) the fixed "
        found = (re.match(touches, item) for item in self.items)
        self.resting = {canonical(match[1]) for match in found if match}
        self.frame = {canonical(name): where for name, where in given.items()}
        anchor = next((name for name in self.frame if name in self.place), None)
        if anchor:
            self.origin = self.place[anchor] - self.frame[anchor] / self.scale
            for name, where in self.frame.items():
                self.place.setdefault(name, self.origin + where / self.scale)

    # what is looked up

    def at(self, name: str) -> complex:
        """The place of a point, as the page names it."""
        name = canonical(name)
        if self.glossed and name not in self.place and name[0].isupper():
            name = next((n for n in (name[:-1], name[0]) if n in self.place), name)
        if name not in self.place:
            raise DefectError(f"{name} has no place yet")
        return self.place[name]

    def given(self, symbol: str) -> str:
        """What the data say of a symbol, without its unit of chained equals."""
        for item in self.items:
            parts = item.split(" = ")
            if symbol in parts[:-1]:
                return [part for part in parts if re.match(NUMBER, part)][-1]
        raise DefectError(f"{symbol} is not given")

    def length(self, p: str, q: str) -> float:
        """A length of the mechanism on paper: given, or measured where it is drawn."""
        for symbol in (p + q, q + p):
            try:
                value, unit = re.match(rf"({NUMBER}) (mm|cm|m)\b", self.given(symbol)).groups()
            except DefectError:
                continue
            return number(value) * MILLIMETRES[unit] / self.scale
        for own in self.own.values():
            if p in own and q in own:
                return abs(own[q] - own[p]) / self.scale
        return abs(self.at(q) - self.at(p))

    def angle(self, text: str) -> float:
        """An angle in radians: a number of degrees, or a symbol of the data."""
        if not re.match(NUMBER, text):
            text = self.given(text)
        if not text.endswith("°"):
            raise DefectError(f"the angle {text} has no degrees")
        return math.radians(number(text[:-1]))

    def sense(self, turning: str) -> int:
        """The sense of ω or ε: given with the data, or seen in the velocity plan."""
        name = turning.partition(" = ")[0]
        if quotient := re.search(rf" = ({VECTOR})/({NAME})({NAME})", turning):
            q, *others = re.findall(r"[A-Z]\d*", quotient[1][3:-1])
            ends = [canonical(quotient[2]), canonical(quotient[3])]
            p = others[0] if others else next(end for end in ends if end != q)
            turned = cross(self.at(q) - self.at(p), self.set_off(quotient[1]))
            self.senses[name] = 1 if turned > 0 else -1
        if name in self.senses:
            return self.senses[name]
        if same := re.search(r" = ([ωε]_\{[^}]*\})$", turning):
            return self.sense(same[1])
        if " = " in turning:
            told = re.findall(NUMBER, turning.rpartition(" = ")[2])
            if told:
                return 1 if number(told[0]) > 0 else -1
            turning = turning.rpartition(" = ")[2]
        index = turning[3:-1]
        symbols = (turning, f"n_{{{index}}}") if turning[0] == "ω" else (turning,)
        told = [item for item in self.items if re.split(" = |: ", item)[0] in symbols]
        if told:
            if not (way := re.search(r"(counter-)?clockwise", " ".join(told))):
                raise DefectError(f"{turning} is given without its sense")
            return 1 if way[1] else -1
        points = re.findall(NAME, self.links.get(index, "").split(" ")[-1])
        plan = self.velocity or self.place
        if turning[0] == "ε":  # as the tangential components say, for the normal ones turn nothing
            primed = re.compile(r"[a-z]′(_\w+)?")
            plan = {n.replace("′", ""): z for n, z in self.place.items() if primed.fullmatch(n)}
        for p, q in pairwise(points):
            if not {self.image(p), self.image(q)} <= plan.keys():
                continue
            turned = cross(self.at(q) - self.at(p), self.moved(q, plan) - self.moved(p, plan))
            if abs(turned) > APART:
                return 1 if turned > 0 else -1
        for under, image in plan.items():  # the link's own point under another's: a_2 under A
            if (own := re.fullmatch(rf"(\w+?)_{re.escape(index)}", under)) and points:
                p, q = points[0], own[1].upper()
                turned = cross(self.at(q) - self.at(p), image - self.moved(p, plan))
                if abs(turned) > APART:
                    return 1 if turned > 0 else -1
        raise DefectError(f"the sense of {turning} cannot be seen")

    def image(self, point: str) -> str:
        """The name of the image of a point in the velocity plan."""
        point = canonical(point)
        if point in self.image_of:
            return self.image_of[point]
        if point in self.frame or point in self.resting:
            return "o"
        return point[0].lower() + (f"_{point[1:]}" if point[1:] else "")

    def moved(self, point: str, plan: dict[str, complex]) -> complex:
        image = self.image(point)
        if image not in plan:
            raise DefectError(f"{image} is not in the velocity plan")
        return plan[image]

    def set_off(self, vector: str) -> complex:
        """A velocity as it is drawn: v_{B} from the pole, v_{BA} from a to b."""
        plan = self.velocity or self.place
        points = re.findall(r"[A-Z]\d*", vector[3:-1])
        from_ = self.moved(points[1], plan) if len(points) > 1 else plan["o"]
        return self.moved(points[0], plan) - from_

    def block(self, point: str, link: str = "") -> Line:
        """The guide of a point, as the data tell it, where they name its link by that."""
        for item in self.items:
            match = re.match(
                rf"(?:pin )?{sliding(point, link)} slides (?:in a slot )?(along|parallel to) (.*)",
                item,
            )
            if match:
                line = self.told_line(match[2], point)
                return line if match[1] == "along" else self.shifted_line(line, match[2])
        raise DefectError(f"no guide of {point} is given")

    def told_line(self, words: str, point: str) -> Line:
        """A line by its words; one of a moving link stands where its point or its block stands."""
        if bar := re.match(rf"({NAME})({NAME})\b", words):
            # the bar may be longer than what is drawn yet: it lies on the line to the point
            p, q = bar[1], bar[2]
            q = q if self.stands(q) else point
            return Line.of(self.at(p), self.at(q) - self.at(p))
        if match := re.match(rf"the line of link \w+ through the point .*? at ({NUMBER}°)", words):
            return Line.of(self.at(point), cmath.rect(1, self.angle(match[1])))
        if match := re.match(rf"the line of link \w+ through ({NAME}) \(positive", words):
            return Line.of(self.at(point), self.at(point) - self.at(match[1]))
        if (own := re.match(rf"the line of link (\w+) through ({NAME})(?:,|$)", words)) and (
            own[1] in self.lies
        ):
            return Line.of(self.at(own[2]), self.lies[own[1]])
        match = re.match(
            rf"the line (?:of link \w+ )?through (?:({NAME})|\(({NUMBER})[;,] ({NUMBER})\) "
            r"(mm|cm|m)) "
            rf"at ({NUMBER}°) to (?:the x axis(?: of link (\w+))?|({NAME})({NAME}))",
            by_angle(words),
        )
        if match is None:
            raise DefectError(f"no line is told: {words}")
        if match[1]:
            where = self.at(match[1] if self.stands(match[1]) else point)
        else:
            there = complex(number(match[2]), number(match[3])) * MILLIMETRES[match[4]]
            where = self.origin + there / self.scale
        along = cmath.rect(1, self.angle(match[5]))
        if match[6]:
            if match[6] not in self.lies:
                raise DefectError(f"the axes of link {match[6]} do not stand")
            along *= self.lies[match[6]]
        if match[7]:
            along *= self.at(match[8]) - self.at(match[7])
        return Line.of(where, along)

    def shifted_line(self, line: Line, words: str) -> Line:
        """The parallel to a line at the offset that its words tell, or the sentence before."""
        if self.offset:
            return Line(line.point + self.offset, line.along)
        sides = "|".join(SIDES)
        offset = re.search(rf", ({NUMBER}) (mm|cm|m) ({sides}) it", words)
        if offset is None:
            raise DefectError(f"no offset is told: {words}")
        away = line.along * 1j
        away *= math.copysign(1, dot(SIDES[offset[3]], away))
        size = number(offset[1]) * MILLIMETRES[offset[2]] / self.scale
        return Line(line.point + away * size, line.along)

    def positive(self, line: Line, words: str) -> Line:
        """A line with the sense that its words tell."""
        if way := re.search(
            r"\(positive from [^)]*?(to the right|to the left|upwards|downwards)\)", words
        ):
            side = WAYS[way[1]]
            return Line(line.point, line.along * math.copysign(1, dot(side, line.along)))
        if way := re.search(rf"\(positive from ({NAME}) to ({NAME})\)", words):
            return Line.of(line.point, self.at(way[2]) - self.at(way[1]))
        raise DefectError(f"no positive sense is told: {words}")

    def told_of(self, form: str) -> str:
        """The item of the data that begins with these words."""
        for item in self.items:
            if re.match(form, item):
                return item
        raise DefectError(f"nothing is given of {form}")

    def stands(self, name: str) -> bool:
        """Whether a point has its place already."""
        return canonical(name) in self.place

    def centre(self, link: str) -> complex:
        """The centre of a wheel."""
        item = self.told_of(rf"(?:internal )?(?:gear|wheel|ring) {link}: centre")
        return self.at(re.search(rf"centre ({NAME})", item)[1])

    def driven_way(self, of: str, symbol: str, said: str) -> complex:
        """The sense in which a block or wheel is driven along its guide or track.

        It is as it is ``said``, and so do the data tell it.
        """
        kind, _, link = of.partition(" ")
        if kind == "guide":
            point = self.sliding_point(link)
            item = self.told_of(rf"(?:pin )?{sliding(point, link)} slides")
            line = self.positive(self.block(point, link), item)
        else:
            item = self.told_of(rf"wheel {link} rolls")
            line = self.positive(self.track(link), item)
        of = re.escape(f"{symbol}_{{{link}") + r"(/\w+)?\} = "
        size = re.match(NUMBER, self.given(self.told_of(of).partition(" = ")[0]))
        assert size
        way = line.along * math.copysign(1, number(size[0]))
        if dot(WAYS[said], way) <= 0:
            raise DefectError(f"{of} is laid off {said}, against the data")
        return way

    def guide(self, link: str) -> Line:
        """The guide of a block by the number of its link."""
        return self.block(self.sliding_point(link), link)

    def sliding_point(self, link: str) -> str:
        """The point of a link that slides along its guide."""
        points: list[str] = re.findall(NAME, self.links.get(link, "").removeprefix("block "))
        for point in points:
            form = rf"(?:pin )?{sliding(point, link)} slides"
            if any(re.match(form, item) for item in self.items):
                return point
        raise DefectError(f"no point of link {link} slides along a guide")

    def track(self, link: str) -> Line:
        """The track of a wheel by the number of its link."""
        for item in self.items:
            match = re.match(
                rf"wheel {link} rolls in {NAME} on "
                rf"(the line (?:of link \w+ )?through ({NAME})[ ,].*)",
                by_angle(item),
            )
            if match:
                return self.told_line(match[1], match[2])
        raise DefectError(f"no track {link} is given")

    def direction(self, words: str) -> complex:
        """The direction of a bar, a guide or a track, by its name."""
        kind, _, link = words.partition(" ")
        if kind == "guide" and link in self.faces:
            return self.faces[link]
        if kind == "guide":
            return self.guide(link).along
        if kind == "track":
            return self.track(link).along
        p, q = re.findall(NAME, words)
        return self.at(q) - self.at(p)

    def put(self, name: str, where: complex) -> None:
        """Marks a point; one that is already there must fall on its place."""
        name = canonical(name)
        if name in self.place and abs(self.place[name] - where) > 0.3:
            raise DefectError(
                f"{name} falls on two places, {abs(self.place[name] - where):.2f} mm apart"
            )
        self.place.setdefault(name, where)

    def wheel_about(self, point: str) -> tuple[str, float]:
        """What wheel is about a point, and its radius on paper."""
        for item in self.items:
            told = rf"(.*): centre {re.escape(point)}, {RADIUS} = ({NUMBER}) (mm|cm|m)"
            if match := re.match(told, item):
                return match[1], number(match[2]) * MILLIMETRES[match[3]] / self.scale
        raise DefectError(f"no radius is told of a wheel about {point}")

    def its_end(self) -> complex:
        if self.end is None:
            raise DefectError("nothing was laid off whose end is meant")
        return self.end

    # how a sentence is read

    def follow(self, sentence: str) -> None:
        """Draws what one sentence says."""
        self.glossed = self.glossed or bool(GLOSS.search(sentence))
        for image, point, _ in POLE_GLOSS.findall(sentence):
            self.image_of[canonical(point)] = canonical(image).replace("′", "")
        known = dict(self.senses)
        rest = self.tried(POLE_GLOSS.sub("", GLOSS.sub("", sentence)))
        self.loci, self.ray, self.end, self.tail, self.offset = [], None, None, None, 0j
        self.read(rest)
        if self.trial:
            self.senses = known  # those of the rates that were tried say nothing of the true ones

    def read(self, rest: str) -> None:
        """Draws what the clauses of a sentence say."""
        while rest:
            for form, rule in RULES:
                match = form.match(rest)
                if match and re.match(r"; |, |$", rest[match.end() :]):
                    before = {*self.place}
                    rule(self, **match.groupdict())
                    self.noted(match[0], before)
                    rest = re.sub(r"^(; |, )", "", rest[match.end() :])
                    break
            else:
                raise DefectError(f"no rule reads: {rest}")

    # a sentence of a trial plan

    def tried(self, sentence: str) -> str:
        """What a sentence says in its trial plan, whose rate is known from then on."""
        self.trial, self.begun = "", []
        match = PLAN.match(sentence)
        if not match:
            return sentence
        self.trial = LAST[match[1]]
        if self.trial == "I":
            self.blocks = {}
        self.senses[match[2]] = 1 if match[4] else -1
        return sentence[match.end() :]

    def noted(self, clause: str, before: set[str]) -> None:
        """Keeps what was said in a first trial plan, by the points that came of it."""
        if self.trial != "I":
            return
        self.begun.append(clause)
        if new := self.place.keys() - before:
            for name in new:
                self.blocks[name] = "; ".join(self.begun)
            self.begun = []
