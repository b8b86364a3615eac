"""What moving.js makes of its data, in Python: each mark's numbers at a place of the driver."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping
from math import atan2, degrees, hypot, isfinite
from typing import Any

import numpy as np

from graphkin.construction.core.layout import BEYOND
from graphkin.construction.core.segments import TINY
from graphkin.construction.tape.tape_outputs import runner
from graphkin.drawing.field import clipped
from graphkin.drawing.marks import Arc
from graphkin.drawing.symbols import SHORT, head
from graphkin.web.moving import Moving
from graphkin.web.page_driver import INPUT
from graphkin.web.traced_closings import State, solver
from tests.web.redrawn import arc_numbers

Laid = list[float] | None
"""The numbers of a mark as ``redrawn.numbers`` has them, a text's shift; None where hidden."""


def laid(
    moving: Moving, x: float, figures: Mapping[str, float] | None = None
) -> Mapping[str, Laid] | None:
    """The marks of a page at a place of the driver and with some figures changed; None where the
    mechanism does not close."""
    y = reckoned(moving, x, figures or {})
    if y is None or not all(isfinite(y[i]) for i in moving.data["closed"]):
        return None
    found: dict[str, Laid] = {}
    for name, kind, shown, *rest in moving.data["marks"]:
        numbers = Shapes(y, moving.data["rects"]).of(kind)(*rest)
        if kind == "o":
            as_drawn = abs(x - moving.data["start"]) < 1e-9 and not figures
            numbers = [] if as_drawn else None
        if numbers is not None and not all(map(isfinite, numbers)):
            numbers = None
        found[name] = numbers if shown < 0 or y[shown] > 0 else None
    return found


def reckoned(moving: Moving, x: float, figures: Mapping[str, float]) -> list[float] | None:
    """The outputs at a place of the driver; None where a group does not close."""
    tracing, course = moving.tracing, moving.data["course"]
    inputs: dict[str, Any] = {INPUT: np.array([x]), **tracing.fixed_inputs(np.array([x]))}
    if tracing.closings:
        size = moving.data["reach"]
        names = tuple(tracing.fixed_inputs(x))
        solve = solver(tracing.graph, INPUT, tracing.closings, names, tracing.fixed_inputs, size)
        found = (solve(x, near) for near in states_near(course, x))
        state = next((each for each in found if each is not None), None)
        if state is None:
            return None
        names = (name for each in tracing.closings for name in each.names)
        inputs |= {name: np.array([number]) for name, number in zip(names, state, strict=True)}
    inputs |= {name: np.array([value]) for name, value in figures.items()}
    outputs = runner(tracing.graph, tracing.tape.outputs)(inputs)
    return [float(np.ravel(value)[0]) for value in outputs]


def states_near(course: dict[str, Any], x: float) -> Iterator[State]:
    """The states near which groups are closed at a place: those between which it lies where a dyad
    is stretched there, else what lies between them."""
    at, turn = course["at"], course["turn"]
    place = at[0] + (x - at[0]) % turn if turn else x
    k = min(max(bisect_left(at, place), 1), len(at) - 1)
    part = (place - at[k - 1]) / (at[k] - at[k - 1])
    before, after = map(tuple, course["states"][k - 1 : k + 1])
    if any(a == -b for a, b in zip(before, after, strict=True)):
        yield from (before, after)
    else:
        yield tuple(a + part * (b - a) for a, b in zip(before, after, strict=True))


class Shapes:
    """The kinds of records."""

    def __init__(self, y: list[float], rects: list[Any]) -> None:
        self.y, self.rects = y, rects

    def of(self, kind: str) -> Callable[..., Laid]:
        """The shape of a kind."""
        found: Callable[..., Laid] = getattr(self, f"kind_{kind}")
        return found

    def point(self, i: int) -> tuple[float, float]:
        """A place among the outputs."""
        return self.y[i], self.y[i + 1]

    def at(self, o: int, d: int, a: float, b: float) -> tuple[float, float]:
        """A place that a pose carries along."""
        (x, y), (u, v) = self.point(o), self.point(d)
        return x + a * u - b * v, y + a * v + b * u

    def cut(self, p: tuple[float, float], q: tuple[float, float], rect: int) -> Laid:
        """A line, cut at the edge of its field."""
        if not all(map(isfinite, (*p, *q))) or hypot(q[0] - p[0], q[1] - p[1]) <= 1e-6:
            return None
        part = (p, q) if rect < 0 else clipped(p, q, self.rects[rect])
        return None if part is None else [*part[0], *part[1]]

    def kind_o(self) -> Laid:
        """What is only there where the scene stands."""
        return None

    def kind_l(self, p: int, q: int, rect: int) -> Laid:
        """A line between two places."""
        return self.cut(self.point(p), self.point(q), rect)

    def kind_f(self, o: int, d: int, a: float, b: float, e: float, f: float, rect: int) -> Laid:
        """A line that is carried along."""
        return self.cut(self.at(o, d, a, b), self.at(o, d, e, f), rect)

    def kind_r(self, o: int, d: int, *corners: float) -> Laid:
        """A polygon that is carried along."""
        pairs = zip(corners[::2], corners[1::2], strict=True)
        return [number for a, b in pairs for number in self.at(o, d, a, b)]

    def kind_x(self, *corners: Any) -> Laid:
        """A polygon of several poses."""
        parts = (corners[i : i + 4] for i in range(0, len(corners), 4))
        return [number for part in parts for number in self.at(*part)]

    def kind_g(self, *places: int) -> Laid:
        """A polygon between places."""
        return [number for place in places for number in self.point(place)]

    def kind_m(self, o: int, d: int, a: float, b: float) -> Laid:
        """A circle that is carried along."""
        return [*self.at(o, d, a, b)]

    def kind_e(
        self, o: int, d: int, a: float, b: float, r: float, start: float, end: float
    ) -> Laid:
        """An arc that is carried along."""
        turned = degrees(atan2(-self.y[d + 1], self.y[d]))
        return arc(self.at(o, d, a, b), r, start + turned, end + turned)

    def kind_a(self, c: int, r: int, start: int, end: int) -> Laid:
        """An arc."""
        low, high = self.y[start], self.y[end]
        return arc(self.point(c), self.y[r], low, high) if abs(high - low) > 0.5 else None

    def kind_h(self, tail: int, tip: int) -> Laid:
        """An arrowhead."""
        ends = self.point(tail), self.point(tip)
        if not hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]) >= SHORT:
            return None
        return [number for point in head(*ends, "x").points for number in point]

    def kind_s(self, o: int, d: int, low: int, high: int, which: int, rect: int) -> Laid:
        """A part of a construction line: all, near its point, far from it, or its end."""
        start, end = self.y[low], self.y[high]
        short = end - start <= 2 * BEYOND + TINY
        if which == 2 and short:
            return None
        if which == 3:
            start = end - 2 * BEYOND
        elif which and not short:
            is_low = (abs(start) < abs(end)) == (which == 1)
            start, end = (start, start + BEYOND) if is_low else (end - BEYOND, end)
        return self.cut(self.at(o, d, start, 0), self.at(o, d, end, 0), rect)

    def kind_i(self, c: int, r: int, _: int) -> Laid:
        """A circle as a broken line: its middle and a place on it."""
        return [*self.point(c), self.y[r]]

    def kind_t(self, o: int, d: int, a: float, b: float, x: float, y: float) -> Laid:
        """How far a text is shifted."""
        u, v = self.at(o, d, a, b)
        return [u - x, v - y]

    def kind_b(self, o: int, d: int, a: float, b: float, *box: float) -> Laid:
        """How far a text beside a segment is shifted."""
        x, y, width, height, room = box
        reach = abs(self.y[d + 1]) * width + abs(self.y[d]) * height
        side = (b > 0) - (b < 0)
        u, v = self.at(o, d, a, side * (room + reach))
        return [u - x, v - y]


def arc(centre: tuple[float, float], r: float, start: float, end: float) -> list[float]:
    """An arc as its path has it."""
    return arc_numbers(Arc(*centre, r, start, end, ""))
