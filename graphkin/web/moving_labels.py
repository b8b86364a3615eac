"""Where letters lie in an animation: each keeps its place relative to its point.

A letter lies off its point in a fixed direction of the page, or in a direction that turns with
another point. The best direction is found once, from what the letter covers over the motion. So the
letter moves smoothly with its point and avoids bars, walls and other letters.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.drawing.field import XY
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Polyline, Text, style_class
from graphkin.drawing.richtext import extent
from graphkin.numbers.arithmetic import np

if TYPE_CHECKING:
    from graphkin.drawing.field import Rect

LETTER = 3.5
"""Height of letters, in mm."""
FAR = (4.2, 6.0, 8.0, 11.0)
"""Distances of a letter from its point, in mm; wide letters lie farther to the side."""
MOVING = 3
"""Number of the distances open to a letter that other points may guide.

Farther off, such a letter would seem to belong to none of the moving points.
"""
TURNS = 16
"""Number of directions that are tried."""
LEFT: XY = (-0.8, -0.6)
"""The direction of a letter whose own direction is undefined: up and to the left."""
GAP = 0.6
"""Clear distance between letters, in mm."""
ASIDE = 2.0
"""Clear distance between letters in a row, which would otherwise read as one segment's name."""
ROUND = 2.0
"""Largest radius of the circles that are pins and points, in mm."""
FAINT = ("ground", "centre-line", "construction", "pitch", "trajectory", "drive")
"""The classes of fine lines, which a letter covers in preference to others."""
COVERED = {"fine": 0.3, "line": 1.0, "point": 2.0, "letter": 4.0, "outside": 6.0}
"""The cost of covering an object at one moment."""
CROWDED = 3.0
"""The largest cost of the lines that a letter covers."""
DISTANT = 0.2
"""The cost of each step to a larger distance."""


class Rule(Struct, frozen=True):
    """The place of a letter: its distance ``far`` from its point, and its direction.

    The direction is away from ``others``, turned by ``turn``. Without others it is ``turn`` itself
    on the page (x to the right, y down).
    """

    others: tuple[str, ...] = ()
    turn: XY = LEFT
    far: float = FAR[0]

    def ways(self, at: XY, others: Sequence[XY]) -> list[XY]:
        """The direction of the letter, then its alternatives where another letter lies."""
        u, v = off(at, others) if self.others else (1.0, 0.0)
        c, s = self.turn
        u, v = (u * c - v * s, u * s + v * c) if u or v else LEFT
        return [(u, v), (-v, u), (v, -u), (-u, -v)]

    def spot(self, at: XY, way: XY, width: float) -> XY:
        """The middle of the letter."""
        return at[0] + way[0] * (self.far + width / 4), at[1] + way[1] * self.far


def off(at: XY, others: Sequence[XY]) -> XY:
    """The unit direction from some places to another, each with equal weight; zero if undefined."""
    ways = [(at[0] - x, at[1] - y) for x, y in others]
    ways = [(u / hypot(u, v), v / hypot(u, v)) for u, v in ways if hypot(u, v) > 1]
    u, v = sum(u for u, _ in ways), sum(v for _, v in ways)
    size = hypot(u, v)
    return (u / size, v / size) if size > 0.1 else (0.0, 0.0)


class PointLetter(Struct, frozen=True):
    """The letter of a point: markup, class, step, and the stroke that draws its point."""

    markup: str
    look: str = ""
    step: int | None = None
    part: int = 0

    @property
    def width(self) -> float:
        """The width of its ink in mm."""
        return extent(self.markup, LETTER)[0]

    def text(self, name: str, at: XY) -> Text:
        """The letter with the middle of its ink at a place."""
        width, top, bottom = extent(self.markup, LETTER)
        look = f"label {self.look}".strip()
        x, y = at[0] - width / 2, at[1] - (top + bottom) / 2
        own = name, self.step
        return Text(x, y, self.markup, look, LETTER, "start", *own, part=self.part)


class FrameView(Struct, frozen=True):
    """The content of a field at one moment: points with letters, and the marks around them.

    ``near`` are the points that may guide the letter of another point.
    """

    letters: Mapping[str, PointLetter]
    places: Mapping[str, XY]
    marks: Sequence[Mark]
    near: Mapping[str, tuple[str, ...]]


def lettering(seen: FrameView, rules: Mapping[str, Rule], rect: Rect) -> Iterator[Text]:
    """The letters of one moment; a letter without a free side is left out."""
    taken: list[tuple[XY, float]] = []
    left, top, right, bottom = rect
    for name, letter in seen.letters.items():
        rule, at, width = rules[name], seen.places[name], letter.width
        if not (left <= at[0] <= right and top <= at[1] <= bottom):
            continue
        ways = rule.ways(at, [seen.places[other] for other in rule.others])
        spots = (rule.spot(at, way, width) for way in ways)
        spot = next((s for s in spots if not any(meet(s, width, *t) for t in taken)), None)
        if spot is not None:
            taken.append((spot, width))
            yield letter.text(name, spot)


def meet(one: XY, width: float, other: XY, breadth: float) -> bool:
    """Whether two letters, given by their middles and widths, overlap."""
    across, down = abs(one[0] - other[0]), abs(one[1] - other[1])
    return across < (width + breadth) / 2 + ASIDE and down < LETTER + GAP


# --- finding the rules ----------------------------------------------------------------------------


def rules_over(moments: Sequence[FrameView], rect: Rect, fars: Sequence[float]) -> dict[str, Rule]:
    """The best rule for each letter over some moments, one letter after another.

    Letters should stay inside ``rect``; ``fars`` are their possible distances in mm.
    """
    found: dict[str, Rule] = {}
    covered = [obstacles(seen.marks) for seen in moments]
    boxes: list[list[tuple[XY, float]]] = [[] for _ in moments]
    for name, letter in moments[0].letters.items():
        near, width = moments[0].near[name], letter.width
        own = fars[:MOVING] if near else fars
        rules = list(rules_for(near, own))
        cost = np.array([DISTANT * len(moments) * FAR.index(rule.far) for rule in rules])
        spots = [spots_of(seen, name, near, own) for seen in moments]
        for here, lies, others in zip(spots, covered, boxes, strict=True):
            cost += price(here, width, lies, others, rect)
        best = int(np.argmin(np.round(cost, 9)))
        found[name] = rules[best]
        for here, others in zip(spots, boxes, strict=True):
            others.append(((float(here[best][0]), float(here[best][1])), width))
    return found


def rules_for(near: tuple[str, ...], fars: Sequence[float]) -> Iterator[Rule]:
    """The rules that a letter may follow."""
    for others in frames_of(near):
        for far in fars:
            for turn in turns():
                yield Rule(others, turn, far)


def frames_of(near: tuple[str, ...]) -> list[tuple[str, ...]]:
    """The points that may guide a letter: each by itself, all together, and none."""
    return [*((each,) for each in near), *([near] if len(near) > 1 else []), ()]


@lru_cache(maxsize=1)
def turns() -> tuple[XY, ...]:
    """Directions all round, starting with the angle zero."""
    angles = [2 * pi * k / TURNS for k in range(TURNS)]
    return tuple((round(cos(a), 6), round(sin(a), 6)) for a in angles)


def spots_of(seen: FrameView, name: str, near: tuple[str, ...], fars: Sequence[float]) -> Any:
    """The places that the rules give a letter at one moment, in their order (n by 2, mm)."""
    at, wide, found = seen.places[name], seen.letters[name].width / 4, []
    c, s = np.array(turns()).T
    for others in frames_of(near):
        u, v = off(at, [seen.places[other] for other in others]) if others else (1.0, 0.0)
        x, y = u * c - v * s, u * s + v * c
        if not (u or v):
            x, y = np.full_like(c, LEFT[0]), np.full_like(c, LEFT[1])
        found += [np.column_stack((x * (far + wide), y * far)) for far in fars]
    return np.array(at) + np.concatenate(found)


def obstacles(marks: Sequence[Mark]) -> tuple[Any, Any, Any]:
    """The lines of some marks (n by 4, mm) with their costs, and the centres of small circles."""
    lines: list[tuple[float, ...]] = []
    prices: list[float] = []
    points: list[XY] = []
    for mark in marks:
        if isinstance(mark, Text):
            continue
        if isinstance(mark, CircleMark) and mark.r <= ROUND:
            points.append((mark.cx, mark.cy))
            continue
        own = [*strokes(mark)]
        lines += own
        prices += [COVERED["fine" if style_class(mark) in FAINT else "line"]] * len(own)
    return np.array(lines).reshape(-1, 4), np.array(prices), np.array(points).reshape(-1, 2)


def strokes(mark: Mark) -> Iterator[tuple[float, ...]]:
    """The straight lines of a mark; round marks become polygons."""
    if isinstance(mark, LineMark):
        points: list[XY] = [(mark.x1, mark.y1), (mark.x2, mark.y2)]
    elif isinstance(mark, Polyline):
        points = [*mark.points, *mark.points[:1]] if mark.closed else [*mark.points]
    elif isinstance(mark, CircleMark):
        ring = [2 * pi * k / 24 for k in range(25)]
        points = [(mark.cx + mark.r * cos(a), mark.cy + mark.r * sin(a)) for a in ring]
    elif isinstance(mark, Arc):
        points = [mark.at(mark.start + (mark.end - mark.start) * k / 12) for k in range(13)]
    else:
        points = []
    for start, end in pairwise(points):
        yield *start, *end


def price(
    spots: Any,
    width: float,
    lies: tuple[Any, Any, Any],
    letters: Sequence[tuple[XY, float]],
    rect: Rect,
) -> Any:
    """The cost of a letter at each of some places (n by 2, mm) at one moment."""
    lines, prices, points = lies
    half = width / 2 + GAP / 2, LETTER / 2 + GAP / 2
    ends = lines.reshape(-1, 2, 2)
    near = (ends.max(axis=1) >= spots.min(axis=0) - half) & (
        ends.min(axis=1) <= spots.max(axis=0) + half
    )
    chosen = near.all(axis=1)
    cost = np.minimum(crossed(spots, half, lines[chosen]) @ prices[chosen], CROWDED)
    apart = np.abs(spots[:, None] - points[None])
    on = (apart[..., 0] < half[0] + 1) & (apart[..., 1] < half[1] + 1)
    cost += COVERED["point"] * on.sum(axis=1)
    for (x, y), breadth in letters:
        across, down = np.abs(spots[:, 0] - x), np.abs(spots[:, 1] - y)
        met = (across < (width + breadth) / 2 + ASIDE) & (down < LETTER + GAP)
        cost += COVERED["letter"] * met
    low, high = np.array(rect[:2]) + half, np.array(rect[2:]) - half
    return cost + COVERED["outside"] * ((spots < low) | (spots > high)).any(axis=1)


def crossed(spots: Any, half: XY, lines: Any) -> Any:
    """Which boxes around some places (n) each of some lines (m) crosses: n by m."""
    ends = lines.reshape(-1, 2, 2)
    middle, ways = ends.mean(axis=1), (ends[:, 1] - ends[:, 0]) / 2
    away = middle[None] - spots[:, None]
    u, v = np.abs(ways[:, 0]), np.abs(ways[:, 1])
    within = (np.abs(away[..., 0]) <= half[0] + u) & (np.abs(away[..., 1]) <= half[1] + v)
    turned = np.abs(away[..., 0] * ways[:, 1] - away[..., 1] * ways[:, 0])
    return within & (turned <= half[0] * v + half[1] * u)
