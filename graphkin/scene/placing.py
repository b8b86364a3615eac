"""Placement of a link's points in its own axes, each by earlier points, and the check of triangles.

Triangles are checked at the parameters as set.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from itertools import combinations

from msgspec import Struct, field

from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.scene.measures import Measures, Pair
from graphkin.scene.model import (
    KEYWORDS,
    TABLES,
    Angled,
    Apart,
    At,
    OnLine,
    Placing,
    Polar,
    Side,
    Triangle,
)
from graphkin.scene.phrases import (
    PLACES,
    OnWords,
    key_points,
    on_words,
    phrase_hint,
    point_name,
    side_words,
)
from graphkin.scene.quantity import Quantity, exact, shortest
from graphkin.text.errors import NO_WORDS, Hint, Mend, Message, both, either, message

PHRASES = message('"left of A-B", "right of A-B", "on A-B" or "beyond B on A-B"')


class LinkKeys(Struct):
    """The keys of a link before its points are placed; ``broken`` when a key is unreadable."""

    place: str
    points: list[str] = field(default_factory=list)
    spots: dict[str, Pair] = field(default_factory=dict)
    polars: dict[str, Polar] = field(default_factory=dict)
    words: dict[str, Side | OnWords] = field(default_factory=dict)
    lengths: dict[frozenset[str], Quantity] = field(default_factory=dict)
    angles: dict[tuple[str, str, str], Quantity] = field(default_factory=dict)
    broken: bool = False

    def between(self, one: str, other: str) -> Quantity | None:
        """The length written between two points, in either order."""
        return self.lengths.get(frozenset((one, other)))


def read_sketch(table: Table, measures: Measures) -> LinkKeys:
    """All keys of a link that concern its points; problems are recorded."""
    sketch = LinkKeys(table.place)
    for key, raw in table.raw.items():
        if key not in KEYWORDS:
            table.take(key)
            read_key(sketch, key, raw, table.at(key), measures)
    return sketch


def read_key(sketch: LinkKeys, key: str, raw: object, place: str, measures: Measures) -> None:
    """Read one key of a link: a point, a length or an angle."""
    points = key_points(place, key, measures.findings)
    if points is None or misspelt(key, raw, place, measures.findings):
        sketch.broken = True
        return
    for point in points:
        if point not in sketch.points:
            sketch.points.append(point)
    if len(points) == 1:
        read_point(sketch, points[0], raw, place, measures)
    elif len(points) == 2:
        pair = frozenset(points)
        if pair in sketch.lengths:
            twin = "-".join(reversed(points))
            measures.findings.add(
                place,
                message("the length {twin} is written above", twin=twin),
                message("one of the two"),
            )
            sketch.broken = True
        sketch.lengths[pair] = measures.length(place, raw, positive=True)
    else:
        first, vertex, last = points
        if (last, vertex, first) in sketch.angles:
            twin = f"{last}-{vertex}-{first}"
            measures.findings.add(
                place,
                message("the angle {twin} is written above", twin=twin),
                message("one of the two"),
            )
            sketch.broken = True
        sketch.angles[first, vertex, last] = measures.angle(place, raw)


POLAR = ("from", "length", "angle")
"""The keys of a point by its length and angle from another."""


def misspelt(key: str, raw: object, place: str, findings: Findings) -> bool:
    """Whether a key that looks like a point holds a guide, track or wheel; that is recorded."""
    if "-" in key:
        return False
    held = raw[0] if isinstance(raw, list) and raw else raw
    if not isinstance(held, dict) or ("from" in held and held is raw):
        return False
    if held is raw and sum(bool(nearest(each, POLAR)) for each in raw) > 1:
        return False
    expected = message(
        "a point by {{from, length, angle}}, or {keywords}", keywords=", ".join(sorted(TABLES))
    )
    findings.add(place, message("unknown table"), expected, nearest(key, TABLES))
    return True


def read_point(sketch: LinkKeys, point: str, raw: object, place: str, measures: Measures) -> None:
    """Read one point given by coordinates, a polar table or a phrase."""
    if isinstance(raw, list):
        sketch.spots[point] = measures.point(place, raw)
        sketch.broken |= len(raw) != 2
    elif isinstance(raw, dict):
        read_polar(sketch, point, Table(place, raw, measures.findings), measures)
    else:
        words = (side_words(raw) or on_words(raw)) if isinstance(raw, str) else None
        if words is None:
            expected = message(
                "coordinates [x, y], {{from, length, angle}}, {phrases}", phrases=PHRASES
            )
            hint = phrase_hint(raw, PLACES) or nearest(point, KEYWORDS)
            measures.findings.add(place, shown(raw), expected, hint)
            sketch.broken = True
        else:
            sketch.words[point] = words


def read_polar(sketch: LinkKeys, point: str, table: Table, measures: Measures) -> None:
    """Read ``{ from, length, angle }``: a distance from a point, at an angle to the x axis."""
    start = point_name(table.at("from"), table.take("from"), measures.findings)
    length = measures.length(table.at("length"), table.take("length"), positive=True)
    angle = measures.angle(table.at("angle"), table.take("angle"))
    table.finish()
    if start is None:
        sketch.broken = True
    else:
        sketch.polars[point] = Polar(point, start, length, angle)


def explain(sketch: LinkKeys, waiting: list[str], placed: set[str], findings: Findings) -> None:
    """Record what each unplaced point lacks, except points that only wait for others."""
    before = len(findings.problems)
    for point in waiting:
        found, expected, hint = missing(sketch, point, placed)
        if found:
            findings.add(f"{sketch.place}.{point}", found, expected, hint)
    if len(findings.problems) == before and not refuse_circle(sketch, waiting, findings):
        names = ", ".join(waiting)
        findings.add(
            sketch.place,
            message("nothing places {names}", names=names),
            message("each point by points written before it"),
            message("give coordinates [x, y], or lengths and a side"),
        )


def refuse_circle(sketch: LinkKeys, points: Iterable[str], findings: Findings) -> bool:
    """Record the first points that are placed from one another in a circle, if any."""
    for point in points:
        circle = [point]
        while (polar := sketch.polars.get(circle[-1])) and polar.start not in circle:
            circle.append(polar.start)
        if polar is not None and polar.start == point:
            found = message(
                "{circle} are placed from one another, in a circle", circle=", ".join(circle)
            )
            if len(circle) == 1:
                found = message("{point} is placed from itself", point=point)
            expected = message("coordinates of one point, such as {point} = [0, 0]", point=point)
            findings.add(f"{sketch.place}.{point}", found, expected)
            return True
    return False


def missing(sketch: LinkKeys, point: str, placed: set[str]) -> tuple[Message, Message, Hint]:
    """What one point lacks: found, expected and hint; empty if it only waits for another point."""
    polar, words = sketch.polars.get(point), sketch.words.get(point)
    if polar is not None:
        return unknown(sketch, "from", [polar.start], point)
    if words is not None:
        return missing_lengths(sketch, point, placed)
    bare = bare_turn(sketch, point, placed) or bare_base(sketch, point, placed)
    if bare:
        return (
            message("the length {bare} is missing", bare=bare),
            message("{bare} = …", bare=bare),
            NO_WORDS,
        )
    ends = [end for end in sketch.points if end in placed and sketch.between(end, point)]
    if len(ends) >= 2:
        a, b = ends[:2]
        return (
            message(
                "{point} has the lengths {a}-{point} and {b}-{point} but no side",
                point=point,
                a=a,
                b=b,
            ),
            message('{point} = "left of {a}-{b}" or "right of {a}-{b}"', point=point, a=a, b=b),
            NO_WORDS,
        )
    if len(ends) == 1:
        bar = f"{ends[0]}-{point}"
        base = any({ends[0], point} == {on.first, on.second} for on in sketch.words.values())
        hint = (
            message("write {bar} above the other lengths, for they begin with it", bar=bar)
            if base
            else NO_WORDS
        )
        lines = [
            f"{p}-{q}"
            for p, q in combinations(sketch.points, 2)
            if {p, q} <= placed and sketch.between(p, q) and ends[0] in (p, q)
        ]
        if len(lines) == 1 and not hint:
            said = f"on {lines[0]}"
            hint = message(
                'if {point} lies on the line, write {point} = "{said}" with one of its lengths',
                point=point,
                said=said,
            )
        return (
            message("one length, {bar}, does not place {point}", bar=bar, point=point),
            message("a second length and a side, an angle, or coordinates [x, y]"),
            hint,
        )
    return NO_WORDS, NO_WORDS, NO_WORDS


def bare_turn(sketch: LinkKeys, point: str, placed: set[str]) -> str:
    """The length that an angle at this point needs and that is not written."""
    for first, vertex, last in sketch.angles:
        ready = point in (first, last) and {first, vertex, last} - {point} <= placed
        if ready and sketch.between(vertex, point) is None:
            return f"{vertex}-{point}"
    return ""


def bare_base(sketch: LinkKeys, point: str, placed: set[str]) -> str:
    """The missing length of the first two points, on which other points are built."""
    for first, vertex, last in sketch.angles:
        for arm in (first, last):
            ends = {arm, vertex}
            if point in ends and ends & placed and sketch.between(arm, vertex) is None:
                return f"{vertex}-{arm}"
    for words in sketch.words.values():
        ends = {words.first, words.second}
        if point in ends and ends & placed and sketch.between(words.first, words.second) is None:
            return f"{words.first}-{words.second}"
    return ""


def missing_lengths(
    sketch: LinkKeys, point: str, placed: set[str]
) -> tuple[Message, Message, Hint]:
    """What a point with a side or a line lacks."""
    words = sketch.words[point]
    ends = (words.first, words.second)
    lost = unknown(sketch, f"{words.first}-{words.second}", ends)
    if lost[0]:
        return lost
    if any(end not in placed for end in ends):
        return NO_WORDS, NO_WORDS, NO_WORDS
    bare = [f"{end}-{point}" for end in ends if sketch.between(end, point) is None]
    if isinstance(words, Side):
        return (
            message("{point} has a side but not the length {bare}", point=point, bare=both(bare)),
            message("both lengths"),
            NO_WORDS,
        )
    return (
        message("{point} is on a line but nothing says how far", point=point),
        message("the length {bare}", bare=either(bare)),
        NO_WORDS,
    )


def unknown(
    sketch: LinkKeys, what: str, ends: tuple[str, ...] | list[str], itself: str = ""
) -> tuple[Message, Message, Hint]:
    """The problem of a placing that names no other point of this link; empty if it does."""
    others = [point for point in sketch.points if point != itself]
    for end in ends:
        if end not in sketch.points:
            hint = nearest(end, others)
            return (
                message("{what} names {end}, no point of this link", what=what, end=end),
                listed(others),
                hint,
            )
    return NO_WORDS, NO_WORDS, NO_WORDS


def spare(
    sketch: LinkKeys, used: set[frozenset[str] | tuple[str, str, str]], findings: Findings
) -> None:
    """Record each length and angle that no placing needs, because its points are already placed."""
    left = [(pair, quantity) for pair, quantity in sketch.lengths.items() if pair not in used]
    turns = [(three, quantity) for three, quantity in sketch.angles.items() if three not in used]
    for _, quantity in (*left, *turns):
        findings.add(
            quantity.place,
            message("one measure too many: its points are placed without it"),
            message("as many measures as place each point once"),
            message("leave it out, or leave out another"),
        )


# --- the points of a link in its own axes, and its triangles --------------------------------------


MOST_POINTS = 500


def read_shape(table: Table, measures: Measures) -> tuple[tuple[str, ...], tuple[Placing, ...]]:
    """The points of a link in the order written and their placings; problems are recorded."""
    sketch = read_sketch(table, measures)
    if len(sketch.points) > MOST_POINTS:
        found = message("{count} points", count=len(sketch.points))
        measures.findings.add(
            table.place, found, message("at most {most} on one link", most=MOST_POINTS)
        )
        return tuple(sketch.points), ()
    lay_end_to_end(sketch)
    begin_with_axis(sketch)
    return tuple(sketch.points), Placer(sketch, measures).place()


def lay_end_to_end(sketch: LinkKeys) -> None:
    """Read X ``on A-B``, with only the lengths A-X and X-B, as B beyond X on A-X.

    The link's axis starts at one of the three points, so that it runs along them.
    """
    if sketch.spots or sketch.polars:
        return
    for middle, words in [*sketch.words.items()]:
        if not isinstance(words, OnWords) or words.beyond:
            continue
        if not {words.first, words.second} <= {*sketch.points}:
            continue
        ends = sorted((words.first, words.second), key=sketch.points.index)
        near, far = ends
        parts = [sketch.between(end, middle) for end in ends]
        if None in parts or sketch.between(near, far) is not None or far in sketch.words:
            continue
        if sketch.points[0] not in (near, middle):
            continue
        del sketch.words[middle]
        sketch.words[far] = OnWords(near, middle, middle, by_parts=True)
        second = near if sketch.points[0] == middle else middle
        sketch.points.remove(second)
        sketch.points.insert(1, second)


def begin_with_axis(sketch: LinkKeys) -> None:
    """Make the end of the x axis the second point, where a point on the axis is second."""
    points, passed = sketch.points, set[str]()
    while len(points) > 1 and points[1] not in passed:
        passed.add(points[1])
        words = sketch.words.get(points[1])
        if not isinstance(words, OnWords) or words.beyond:
            return
        ends = [words.first, words.second]
        end = next((p for p in ends if p != points[0] and p in points), None)
        if points[0] in ends and end is not None and not sketch.spots and not sketch.polars:
            points.remove(end)
            points.insert(1, end)


class Placer:
    """Finds, for each point of a link, a placing that uses only earlier points."""

    def __init__(self, sketch: LinkKeys, measures: Measures) -> None:
        self.sketch = sketch
        self.findings = measures.findings
        self.layout = TriangleLayout(measures, sketch.place)
        self.placings: dict[str, Placing] = {}
        self.turns: dict[str, dict[tuple[str, str, str], Quantity]] = {}
        for (first, vertex, last), angle in sketch.angles.items():
            for end in (first, last):
                self.turns.setdefault(end, {})[first, vertex, last] = angle
        self.used: set[frozenset[str] | tuple[str, str, str]] = set()

    def place(self) -> tuple[Placing, ...]:
        """The placings in order; unplaced points and unneeded keys are recorded."""
        self.origin()
        waiting = [p for p in self.sketch.points if p not in self.placings]
        found = True
        while waiting and found:
            found = False
            for point in waiting:
                placing = self.placing(point)
                if placing is not None:
                    self.placings[point] = placing
                    self.layout.add(placing, self.sketch.between)
                    found = True
            waiting = [p for p in waiting if p not in self.placings]
        self.complain(waiting)
        return tuple(self.placings.values())

    def origin(self) -> None:
        """Make the first point the origin, unless the link has coordinates of its own."""
        if not self.sketch.points or self.sketch.spots:
            return
        first, unit = self.sketch.points[0], self.layout.unit
        place = f"{self.sketch.place}.{first}"
        if first in self.sketch.words or first in self.sketch.polars:
            if self.is_placed_by_itself(first):
                others = [point for point in self.sketch.points if point != first]
                line = (
                    message('"on {others}"', others="-".join(others[:2]))
                    if others[1:]
                    else message("a second point before it")
                )
                self.findings.add(place, message("{first} is placed by itself", first=first), line)
            elif not refuse_circle(self.sketch, [first], self.findings):
                found = message(
                    "the link's first key begins with {first}, which makes {first} its origin",
                    first=first,
                )
                self.findings.add(
                    place,
                    found,
                    message("a length or coordinates of other points above {first}", first=first),
                )
            self.sketch.broken = True
        zero = exact(0, unit, place)
        self.placings[first] = At(first, zero, zero)
        self.layout.add(self.placings[first], self.sketch.between)

    def is_placed_by_itself(self, point: str) -> bool:
        """Whether a point's own line or side begins or ends at that point."""
        words = self.sketch.words.get(point)
        return words is not None and point in (words.first, words.second)

    def placing(self, point: str) -> Placing | None:
        """The placing of a point by the points placed so far, or None while it must wait."""
        sketch = self.sketch
        if point in sketch.spots:
            return At(point, *sketch.spots[point])
        if point in sketch.polars:
            polar = sketch.polars[point]
            return polar if polar.start in self.placings else None
        words = sketch.words.get(point)
        if isinstance(words, Side):
            return self.triangle(point, words)
        if isinstance(words, OnWords):
            return self.on_line(point, words)
        return self.apart(point) or self.angled(point)

    def taken(self, one: str, other: str) -> Quantity | None:
        """The length between a placed point and a new one, marked as used."""
        length = self.sketch.between(one, other)
        if length is not None:
            self.used.add(frozenset((one, other)))
        return length

    def triangle(self, point: str, side: Side) -> Placing | None:
        """The placing by two lengths and a side."""
        ends = (side.first, side.second)
        lengths = [self.sketch.between(end, point) for end in ends]
        if None in lengths or any(end not in self.placings for end in ends):
            return None
        first, second = self.taken(ends[0], point), self.taken(ends[1], point)
        assert first is not None and second is not None
        return Triangle(point, *ends, first, second, side.side)

    def on_line(self, point: str, words: OnWords) -> Placing | None:
        """The placing by a length along a line: ``on`` towards the other end, else outwards."""
        ends = (words.first, words.second)
        if any(end not in self.placings for end in ends):
            return None
        for start, other in (ends, ends[::-1]):
            if self.sketch.between(start, point) is None:
                continue
            length = self.taken(start, point)
            assert length is not None
            self.layout.reach(point, words, start, length, self.sketch.between)
            sense = 1 if (words.beyond or other) == words.second else -1
            return OnLine(point, *ends, start, length, sense, words.by_parts)
        return None

    def apart(self, point: str) -> Placing | None:
        """The placing of a link's second point: on its x axis, at its length from the first."""
        first = self.sketch.points[0]
        if point != self.sketch.points[1] or first not in self.placings:
            return None
        length = self.taken(first, point)
        return Apart(point, first, length) if length is not None else None

    def angled(self, point: str) -> Placing | None:
        """The placing by an angle at a placed point, from another's direction, and a length."""
        for (first, vertex, last), angle in self.turns.get(point, {}).items():
            clockwise = point == first
            arm, turned = (last, angle.negative()) if clockwise else (first, angle)
            if arm in self.placings and vertex in self.placings:
                length = self.taken(vertex, point)
                if length is not None:
                    self.used.add((first, vertex, last))
                    return Angled(point, vertex, arm, length, turned, clockwise)
        return None

    def complain(self, waiting: list[str]) -> None:
        """Record each point that nothing places and each key that nothing needs."""
        if self.sketch.broken:
            return
        if waiting:
            explain(self.sketch, waiting, set(self.placings), self.findings)
        else:
            spare(self.sketch, self.used, self.findings)


CLOSE = 1e-12
"""Relative difference below which inexact lengths count as equal."""
Size = Fraction | float
Between = Callable[[str, str], Quantity | None]


class TriangleLayout:
    """Float positions of a link's points; flat and impossible triangles are recorded.

    Nothing is judged where a number could not be read and has a substitute.
    """

    def __init__(self, measures: Measures, place: str) -> None:
        self.findings = measures.findings
        self.sound = not self.findings.inside(place)
        self.values = measures.values
        self.unit = measures.units["length"]
        self.spots: dict[str, complex] = {}

    def add(self, placing: Placing, between: Between) -> None:
        """Add one more point, placed by earlier points."""
        if isinstance(placing, Triangle):
            self.spots[placing.point] = self.corner(placing, between)
        elif isinstance(placing, OnLine):
            self.spots[placing.point] = self.along(placing, between)
        else:
            self.spots[placing.point] = self.free(placing)

    def free(self, placing: At | Apart | Polar | Angled) -> complex:
        """The position of a point that always exists."""
        if isinstance(placing, At):
            return complex(self.value(placing.x), self.value(placing.y))
        length = self.value(placing.length)
        if isinstance(placing, Apart):
            return self.spots[placing.start] + float(length)
        turn = complex(placing.angle.direction(self.values))
        if isinstance(placing, Polar):
            return self.spots[placing.start] + float(length) * turn
        arm = self.spots[placing.arm] - self.spots[placing.vertex]
        if abs(arm) == 0:
            self.coincide(placing.angle.place, placing.vertex, placing.arm)
            return self.spots[placing.vertex]
        return self.spots[placing.vertex] + float(length) * turn * arm / abs(arm)

    def value(self, quantity: Quantity) -> Size:
        """Value of a quantity at the parameters as set, in its written unit."""
        number = quantity.number(self.values)
        return number if isinstance(number, Fraction) else float(number)

    def distance(self, one: str, other: str, between: Between) -> Size:
        """Distance of two points: exact where a length is written, otherwise measured."""
        length = between(one, other)
        if length is not None:
            return self.value(length)
        return abs(self.spots[other] - self.spots[one])

    def corner(self, placing: Triangle, between: Between) -> complex:
        """The third corner of a triangle, by its three lengths and its side."""
        a, b = placing.first, placing.second
        base = self.distance(a, b, between)
        if base == 0:
            self.coincide(placing.from_second.place, a, b)
            return self.spots[a]
        r, s = self.value(placing.from_first), self.value(placing.from_second)
        self.judge(placing, base, r, s)
        x = float((base * base + r * r - s * s) / (2 * base))
        y = max(float(r) ** 2 - x * x, 0.0) ** 0.5 * placing.side
        way = (self.spots[b] - self.spots[a]) / float(base)
        return self.spots[a] + complex(x, y) * way

    def judge(self, placing: Triangle, base: Size, r: Size, s: Size) -> None:
        """Record three lengths that form no triangle, or a flat one."""
        a, b, c = placing.first, placing.second, placing.point
        sides: list[tuple[Size, str]] = [(base, f"{a}-{b}"), (r, f"{a}-{c}"), (s, f"{b}-{c}")]
        longest, name = max(sides)
        rest = base + r + s - longest
        exactly = all(isinstance(side, Fraction) for side, _ in sides)
        flat = longest == rest if exactly else abs(float(longest - rest)) <= CLOSE * longest
        if not self.sound or (not flat and longest < rest):
            return
        lengths = ", ".join(f"{which} {shortest(side)}" for side, which in sides)
        found = message("{lengths} make no triangle", lengths=lengths)
        if flat:
            found = message("{lengths} make a flat triangle", lengths=lengths)
        expected = message(
            "{name} shorter than the other two together, {rest}", name=name, rest=shortest(rest)
        )
        beyond = {f"{a}-{c}": f"beyond {b} on", f"{b}-{c}": f"beyond {a} on"}.get(name, "on")
        hint = message(
            'if {c} lies on the line, write {c} = "{beyond} {a}-{b}" with one of its lengths',
            c=c,
            beyond=beyond,
            a=a,
            b=b,
        )
        key = placing.from_second.place.rpartition(".")[0]
        longest_key = (*key.split("."), name)
        self.findings.add(f"{key}.{c}", found, expected, hint, about=(longest_key,))

    def along(self, placing: OnLine, between: Between) -> complex:
        """A point on a line, between its two points or beyond one of them."""
        a, b, start = placing.first, placing.second, placing.start
        base = self.distance(a, b, between)
        if base == 0:
            self.coincide(placing.length.place, a, b)
            return self.spots[a]
        way = (self.spots[b] - self.spots[a]) / float(base)
        return self.spots[start] + float(self.value(placing.length)) * placing.sense * way

    def reach(
        self, point: str, words: OnWords, start: str, length: Quantity, between: Between
    ) -> None:
        """Record a point on a line, or beyond its end, whose length contradicts that."""
        a, b = words.first, words.second
        base, far = self.distance(a, b, between), self.value(length)
        if not self.sound or base == 0:
            return
        sizes = message(
            "{far} from {start}, and {a}-{b} is {base}",
            far=shortest(far),
            start=start,
            a=a,
            b=b,
            base=shortest(base),
        )
        end = b if start == a else a
        if words.beyond is None and far > base:
            hint = instead(f"on {a}-{b}", f"beyond {end} on {a}-{b}")
            self.findings.add(
                length.place,
                message("{text} is {found}", text=point, found=sizes),
                message("at most {a}-{b}", a=a, b=b),
                hint,
            )
        elif words.beyond == end and far < base:
            hint = instead(f"beyond {end} on {a}-{b}", f"on {a}-{b}")
            self.findings.add(
                length.place,
                message("{text} is {found}", text=point, found=sizes),
                message("more than {a}-{b}", a=a, b=b),
                hint,
            )

    def coincide(self, place: str, one: str, other: str) -> None:
        """Record two coinciding points where a line through them is needed."""
        self.findings.add(
            place,
            message("{one} and {other} lie at one spot", one=one, other=other),
            message("a line through two points"),
        )


def instead(old: str, new: str) -> Mend:
    """The replacement of one phrase by another."""
    return Mend(old, new, message('did you mean "{new}"?', new=new))
