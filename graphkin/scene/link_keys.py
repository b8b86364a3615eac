"""What the keys of a link say, before its points are placed, and why these cannot be placed."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from msgspec import Struct, field

from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.scene.measures import Measures, Pair
from graphkin.scene.model import KEYWORDS, Polar, Side
from graphkin.scene.phrases import (
    PLACES,
    OnWords,
    key_points,
    on_words,
    phrase_hint,
    point_name,
    side_words,
)
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import Hint

PHRASES = '"left of A-B", "right of A-B", "on A-B" or "beyond B on A-B"'


class LinkKeys(Struct):
    """What the keys of a link say, before its points are placed; broken when a key is lost."""

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
    """All keys of a link that speak of its points; problems are noted."""
    sketch = LinkKeys(table.place)
    for key, raw in table.raw.items():
        if key not in KEYWORDS:
            table.take(key)
            read_key(sketch, key, raw, table.at(key), measures)
    return sketch


def read_key(sketch: LinkKeys, key: str, raw: object, place: str, measures: Measures) -> None:
    """One key of a link: a point, a length or an angle."""
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
            measures.findings.add(place, f"the length {twin} is written above", "one of the two")
            sketch.broken = True
        sketch.lengths[pair] = measures.length(place, raw, positive=True)
    else:
        first, vertex, last = points
        if (last, vertex, first) in sketch.angles:
            twin = f"{last}-{vertex}-{first}"
            measures.findings.add(place, f"the angle {twin} is written above", "one of the two")
            sketch.broken = True
        sketch.angles[first, vertex, last] = measures.angle(place, raw)


POLAR = ("from", "length", "angle")
"""The keys of a point by its length and angle from another."""


def misspelt(key: str, raw: object, place: str, findings: Findings) -> bool:
    """Whether a key that looks like a point holds a guide, a track or a wheel; it is noted."""
    if "-" in key:
        return False
    held = raw[0] if isinstance(raw, list) and raw else raw
    if not isinstance(held, dict) or ("from" in held and held is raw):
        return False
    if held is raw and sum(bool(nearest(each, POLAR)) for each in raw) > 1:
        return False
    expected = f"a point by {{from, length, angle}}, or {', '.join(sorted(KEYWORDS))}"
    findings.add(place, "unknown table", expected, nearest(key, KEYWORDS))
    return True


def read_point(sketch: LinkKeys, point: str, raw: object, place: str, measures: Measures) -> None:
    """One point by coordinates, by a polar table or by a phrase."""
    if isinstance(raw, list):
        sketch.spots[point] = measures.point(place, raw)
        sketch.broken |= len(raw) != 2
    elif isinstance(raw, dict):
        read_polar(sketch, point, Table(place, raw, measures.findings), measures)
    else:
        words = (side_words(raw) or on_words(raw)) if isinstance(raw, str) else None
        if words is None:
            expected = f"coordinates [x, y], {{from, length, angle}}, {PHRASES}"
            measures.findings.add(place, shown(raw), expected, phrase_hint(raw, PLACES))
            sketch.broken = True
        else:
            sketch.words[point] = words


def read_polar(sketch: LinkKeys, point: str, table: Table, measures: Measures) -> None:
    """``{ from, length, angle }``: a point so far from another, at an angle to the x axis."""
    start = point_name(table.at("from"), table.take("from"), measures.findings)
    length = measures.length(table.at("length"), table.take("length"), positive=True)
    angle = measures.angle(table.at("angle"), table.take("angle"))
    table.finish()
    if start is None:
        sketch.broken = True
    else:
        sketch.polars[point] = Polar(point, start, length, angle)


def explain(sketch: LinkKeys, waiting: list[str], placed: set[str], findings: Findings) -> None:
    """Note, for each point left over, what it lacks; points that only wait for those are passed."""
    before = len(findings.problems)
    for point in waiting:
        found, expected, hint = missing(sketch, point, placed)
        if found:
            findings.add(f"{sketch.place}.{point}", found, expected, hint)
    if len(findings.problems) == before and not refuse_circle(sketch, waiting, findings):
        names = ", ".join(waiting)
        findings.add(
            sketch.place,
            f"nothing places {names}",
            "each point by points written before it",
            "give coordinates [x, y], or lengths and a side",
        )


def refuse_circle(sketch: LinkKeys, points: Iterable[str], findings: Findings) -> bool:
    """Note the first points that are laid off by lengths and angles from one another, if any."""
    for point in points:
        circle = [point]
        while (polar := sketch.polars.get(circle[-1])) and polar.start not in circle:
            circle.append(polar.start)
        if polar is not None and polar.start == point:
            found = f"{', '.join(circle)} are placed from one another, in a circle"
            if len(circle) == 1:
                found = f"{point} is placed from itself"
            expected = f"coordinates of one point, such as {point} = [0, 0]"
            findings.add(f"{sketch.place}.{point}", found, expected)
            return True
    return False


def missing(sketch: LinkKeys, point: str, placed: set[str]) -> tuple[str, str, Hint]:
    """What one point lacks: found, expected and hint; empty when it only waits for another."""
    polar, words = sketch.polars.get(point), sketch.words.get(point)
    if polar is not None:
        return unknown(sketch, "from", [polar.start], point)
    if words is not None:
        return missing_lengths(sketch, point, placed)
    bare = bare_turn(sketch, point, placed) or bare_base(sketch, point, placed)
    if bare:
        return (f"the length {bare} is missing", f"{bare} = …", "")
    ends = [end for end in sketch.points if end in placed and sketch.between(end, point)]
    if len(ends) >= 2:
        a, b = ends[:2]
        return (
            f"{point} has the lengths {a}-{point} and {b}-{point} but no side",
            f'{point} = "left of {a}-{b}" or "right of {a}-{b}"',
            "",
        )
    if len(ends) == 1:
        bar = f"{ends[0]}-{point}"
        base = any({ends[0], point} == {on.first, on.second} for on in sketch.words.values())
        hint = f"write {bar} above the other lengths, for they begin with it" if base else ""
        lines = [
            f"{p}-{q}"
            for p, q in combinations(sketch.points, 2)
            if {p, q} <= placed and sketch.between(p, q) and ends[0] in (p, q)
        ]
        if len(lines) == 1 and not hint:
            said = f"on {lines[0]}"
            hint = f'if {point} lies on the line, write {point} = "{said}" with one of its lengths'
        return (
            f"one length, {bar}, does not place {point}",
            "a second length and a side, an angle, or coordinates [x, y]",
            hint,
        )
    return ("", "", "")


def bare_turn(sketch: LinkKeys, point: str, placed: set[str]) -> str:
    """The length that an angle of this point wants, where it is not written."""
    for first, vertex, last in sketch.angles:
        ready = point in (first, last) and {first, vertex, last} - {point} <= placed
        if ready and sketch.between(vertex, point) is None:
            return f"{vertex}-{point}"
    return ""


def bare_base(sketch: LinkKeys, point: str, placed: set[str]) -> str:
    """The length of the first two points, on which other points are built, where it is missing."""
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


def missing_lengths(sketch: LinkKeys, point: str, placed: set[str]) -> tuple[str, str, Hint]:
    """What a point with a side or a line lacks."""
    words = sketch.words[point]
    ends = (words.first, words.second)
    lost = unknown(sketch, f"{words.first}-{words.second}", ends)
    if lost[0]:
        return lost
    if any(end not in placed for end in ends):
        return ("", "", "")
    bare = [f"{end}-{point}" for end in ends if sketch.between(end, point) is None]
    if isinstance(words, Side):
        return (f"{point} has a side but not the length {' and '.join(bare)}", "both lengths", "")
    return (f"{point} is on a line but nothing says how far", f"the length {' or '.join(bare)}", "")


def unknown(
    sketch: LinkKeys, what: str, ends: tuple[str, ...] | list[str], itself: str = ""
) -> tuple[str, str, Hint]:
    """A point named in a placing that this link does not have; none is placed by ``itself``."""
    others = [point for point in sketch.points if point != itself]
    for end in ends:
        if end not in sketch.points:
            hint = nearest(end, others)
            return (f"{what} names {end}, no point of this link", listed(others), hint)
    return ("", "", "")


def spare(
    sketch: LinkKeys, used: set[frozenset[str] | tuple[str, str, str]], findings: Findings
) -> None:
    """Note each length and angle that no placing needs: what it says is settled already."""
    left = [(pair, quantity) for pair, quantity in sketch.lengths.items() if pair not in used]
    turns = [(three, quantity) for three, quantity in sketch.angles.items() if three not in used]
    for _, quantity in (*left, *turns):
        findings.add(
            quantity.place,
            "one measure too many: its points are placed without it",
            "as many measures as place each point once",
            "leave it out, or leave out another",
        )
