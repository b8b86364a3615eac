"""The points of a link placed in its own axes, each by points placed before it."""

from __future__ import annotations

from graphkin.scene.findings import Table
from graphkin.scene.flat_triangles import TriangleLayout
from graphkin.scene.link_keys import LinkKeys, read_sketch
from graphkin.scene.measures import Measures
from graphkin.scene.misplaced import explain, spare
from graphkin.scene.model import Angled, Apart, At, OnLine, Placing, Side, Triangle
from graphkin.scene.phrases import OnWords
from graphkin.scene.quantity import Quantity, exact

MOST_POINTS = 500


def read_shape(table: Table, measures: Measures) -> tuple[tuple[str, ...], tuple[Placing, ...]]:
    """Points of a link in the order written and their placings; problems are noted."""
    sketch = read_sketch(table, measures)
    if len(sketch.points) > MOST_POINTS:
        found = f"{len(sketch.points)} points"
        measures.findings.add(table.place, found, f"at most {MOST_POINTS} on one link")
        return tuple(sketch.points), ()
    lay_end_to_end(sketch)
    begin_with_axis(sketch)
    return tuple(sketch.points), Placer(sketch, measures).place()


def lay_end_to_end(sketch: LinkKeys) -> None:
    """Read X ``on A-B``, written by the lengths A-X and X-B alone, as B beyond X on A-X.

    The axis of the link begins with one of the three, so that it runs along them.
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
        sketch.words[far] = OnWords(near, middle, middle)
        second = near if sketch.points[0] == middle else middle
        sketch.points.remove(second)
        sketch.points.insert(1, second)


def begin_with_axis(sketch: LinkKeys) -> None:
    """Put second the point at which the x axis ends: the same axis leads to a point on it."""
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
    """Finds, for each point of a sketch, a placing that uses only points before it."""

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
        """The placings in order; what stays unplaced or is left over is noted."""
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
        """The first point written is the origin, unless the link has coordinates of its own."""
        if not self.sketch.points or self.sketch.spots:
            return
        first, unit = self.sketch.points[0], self.layout.unit
        place = f"{self.sketch.place}.{first}"
        if first in self.sketch.words or first in self.sketch.polars:
            others = "the link begins with it, and its first point is the origin"
            self.findings.add(place, others, "a length or coordinates above it")
            self.sketch.broken = True
        nought = exact(0, unit, place)
        self.placings[first] = At(first, nought, nought)
        self.layout.add(self.placings[first], self.sketch.between)

    def placing(self, point: str) -> Placing | None:
        """The placing of a point by what is placed so far, None while it must wait."""
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
        """The length between a placed point and one to be placed, noted as used."""
        length = self.sketch.between(one, other)
        if length is not None:
            self.used.add(frozenset((one, other)))
        return length

    def triangle(self, point: str, side: Side) -> Placing | None:
        """Two lengths and a side."""
        ends = (side.first, side.second)
        lengths = [self.sketch.between(end, point) for end in ends]
        if None in lengths or any(end not in self.placings for end in ends):
            return None
        first, second = self.taken(ends[0], point), self.taken(ends[1], point)
        assert first is not None and second is not None
        return Triangle(point, *ends, first, second, side.side)

    def on_line(self, point: str, words: OnWords) -> Placing | None:
        """One length along a line; ``on`` steps towards the other end, ``beyond`` outwards."""
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
            return OnLine(point, *ends, start, length, sense)
        return None

    def apart(self, point: str) -> Placing | None:
        """The second point of a link lies on its x axis, at its length from the first."""
        first = self.sketch.points[0]
        if point != self.sketch.points[1] or first not in self.placings:
            return None
        length = self.taken(first, point)
        return Apart(point, first, length) if length is not None else None

    def angled(self, point: str) -> Placing | None:
        """An angle at a placed point, from the direction of another, with one length."""
        for (first, vertex, last), angle in self.turns.get(point, {}).items():
            arm, turned = (first, angle) if point == last else (last, angle.negative())
            if arm in self.placings and vertex in self.placings:
                length = self.taken(vertex, point)
                if length is not None:
                    self.used.add((first, vertex, last))
                    return Angled(point, vertex, arm, length, turned)
        return None

    def complain(self, waiting: list[str]) -> None:
        """Note each point that nothing places and each key that nothing needs."""
        if self.sketch.broken:
            return
        if waiting:
            explain(self.sketch, waiting, set(self.placings), self.findings)
        else:
            spare(self.sketch, self.used, self.findings)
