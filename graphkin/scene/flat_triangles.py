"""Where a link's points lie in its own axes, at the parameters as set: only to check triangles."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from graphkin.scene.measures import Measures
from graphkin.scene.model import Angled, Apart, At, OnLine, Placing, Polar, Triangle
from graphkin.scene.phrases import OnWords
from graphkin.scene.quantity import Quantity, shortest
from graphkin.text.errors import Mend

CLOSE = 1e-12
"""Relative difference below which lengths that are not exact count as equal."""
Size = Fraction | float
Between = Callable[[str, str], Quantity | None]


class TriangleLayout:
    """Float positions of a link's points; a triangle that is flat or impossible is noted.

    Nothing is judged where a number could not be read and another stands in for it.
    """

    def __init__(self, measures: Measures, place: str) -> None:
        self.findings = measures.findings
        self.sound = not self.findings.inside(place)
        self.values = measures.values
        self.unit = measures.units["length"]
        self.spots: dict[str, complex] = {}

    def add(self, placing: Placing, between: Between) -> None:
        """Lay one more point, from points laid before it."""
        if isinstance(placing, Triangle):
            self.spots[placing.point] = self.corner(placing, between)
        elif isinstance(placing, OnLine):
            self.spots[placing.point] = self.along(placing, between)
        else:
            self.spots[placing.point] = self.free(placing)

    def free(self, placing: At | Apart | Polar | Angled) -> complex:
        """A point that can always be laid."""
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
        """Distance of two points: exact where a length is written, else measured."""
        length = between(one, other)
        if length is not None:
            return self.value(length)
        return abs(self.spots[other] - self.spots[one])

    def corner(self, placing: Triangle, between: Between) -> complex:
        """The third corner of a triangle by its three lengths and its side."""
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
        """Note three lengths that make no triangle, or a flat one."""
        a, b, c = placing.first, placing.second, placing.point
        sides: list[tuple[Size, str]] = [(base, f"{a}-{b}"), (r, f"{a}-{c}"), (s, f"{b}-{c}")]
        longest, name = max(sides)
        rest = base + r + s - longest
        exactly = all(isinstance(side, Fraction) for side, _ in sides)
        flat = longest == rest if exactly else abs(float(longest - rest)) <= CLOSE * longest
        if not self.sound or (not flat and longest < rest):
            return
        lengths = ", ".join(f"{which} {shortest(side)}" for side, which in sides)
        found = f"{lengths} make {'a flat triangle' if flat else 'no triangle'}"
        expected = f"{name} shorter than the other two together, {shortest(rest)}"
        beyond = {f"{a}-{c}": f"beyond {b} on", f"{b}-{c}": f"beyond {a} on"}.get(name, "on")
        hint = f'if {c} lies on the line, write {c} = "{beyond} {a}-{b}" with one of its lengths'
        key = placing.from_second.place.rpartition(".")[0]
        self.findings.add(f"{key}.{c}", found, expected, hint)

    def along(self, placing: OnLine, between: Between) -> complex:
        """A point on a line, within its two points or beyond one of them."""
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
        """Note a point said to be on a line or beyond its end whose length says otherwise."""
        a, b = words.first, words.second
        base, far = self.distance(a, b, between), self.value(length)
        if not self.sound or base == 0:
            return
        sizes = f"{shortest(far)} from {start}, and {a}-{b} is {shortest(base)}"
        end = b if start == a else a
        if words.beyond is None and far > base:
            hint = instead(f"on {a}-{b}", f"beyond {end} on {a}-{b}")
            self.findings.add(length.place, f"{point} is {sizes}", f"at most {a}-{b}", hint)
        elif words.beyond == end and far < base:
            hint = instead(f"beyond {end} on {a}-{b}", f"on {a}-{b}")
            self.findings.add(length.place, f"{point} is {sizes}", f"more than {a}-{b}", hint)

    def coincide(self, place: str, one: str, other: str) -> None:
        """Note two points that are one, where a line through them is meant."""
        self.findings.add(place, f"{one} and {other} lie at one spot", "a line through two points")


def instead(old: str, new: str) -> Mend:
    """Another phrase in place of one."""
    return Mend(old, new, f'did you mean "{new}"?')
