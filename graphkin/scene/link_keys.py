"""What the keys of a link say, in the order written, before its points are placed."""

from __future__ import annotations

from msgspec import Struct, field

from graphkin.scene.findings import Findings, Table, nearest, shown
from graphkin.scene.measures import Measures, Pair
from graphkin.scene.model import KEYWORDS, Polar, Side
from graphkin.scene.phrases import OnWords, key_points, on_words, point_name, side_words
from graphkin.scene.quantity import Quantity

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


def misspelt(key: str, raw: object, place: str, findings: Findings) -> bool:
    """Whether a key that looks like a point holds a guide, a track or a wheel; it is noted."""
    if "-" in key:
        return False
    held = raw[0] if isinstance(raw, list) and raw else raw
    if not isinstance(held, dict) or ("from" in held and held is raw):
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
            measures.findings.add(
                place, shown(raw), f"coordinates [x, y], {{from, length, angle}}, {PHRASES}"
            )
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
