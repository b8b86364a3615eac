"""Charts of a cycle as marks of a page: panels over the driver's axis, and figures in the plane."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import pairwise
from math import ceil, floor, isfinite

import numpy as np
from msgspec import Struct

from graphkin.construction.core.paper_canvas import clipped_path
from graphkin.drawing.field import XY, Rect
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Page, Polyline, Text, box, polygon
from graphkin.drawing.richtext import extent, flowed, known
from graphkin.drawing.scale import preferred
from graphkin.drawing.style import CURVES, HUES
from graphkin.drawing.symbol_markup import escape

Reals = np.ndarray[tuple[int], np.dtype[np.float64]]

MARGIN = 4.0
"""Margin of a figure in mm."""
LEFT = 21.0
"""Room left of an axis for its numbers and its unit, in mm."""
TITLE, WORDS, SMALL = 3.2, 2.3, 1.8
"""Heights of titles, of words and numbers, and of notes, in mm."""
LINE = 4.2
"""Distance of lines of words, in mm."""
SAMPLE, GAP = 8.0, 1.5
"""Length of a curve's sample in a legend, and the gap behind it, in mm."""
INK = len(HUES) - 1
"""The hue of the ink."""
TICKS = 6
"""About the most numbers along an axis of values."""
SPARE = 0.05
"""Room above and below curves, as a share of their height."""


class ChartCurve(Struct, frozen=True, eq=False):
    """A curve of a chart: its label as markup, its values, its hue and its stroke by number.

    In the plane its values are complex. A ``dot`` has no line: its values are single places.
    """

    label: str
    values: np.ndarray
    hue: int = 0
    stroke: int = 0
    dot: float = 0.0

    @property
    def look(self) -> str:
        """The classes of its line."""
        return f"{CURVES[self.stroke % len(CURVES)]} {HUES[self.hue % len(HUES)]}"


class Upright(Struct, frozen=True):
    """A thin vertical line at a place of the axis: its class, and words along it in one panel."""

    at: float
    look: str
    words: str = ""


class ChartPanel(Struct, frozen=True, eq=False):
    """A panel: its heading and unit, its curves, and the limits of its axis if they are given."""

    words: str
    unit: str
    curves: Sequence[ChartCurve]
    bounds: tuple[float, float] | None = None


class AcrossAxis(Struct, frozen=True, eq=False):
    """The axis below panels: places of the rows, limits, what it shows, numbers, decimal mark."""

    at: Reals
    low: float
    high: float
    words: str
    ticks: Sequence[float] = ()
    uprights: Sequence[Upright] = ()
    mark: str = "."


def ticks_of(low: float, high: float, most: int = TICKS) -> list[float]:
    """The round numbers between two limits: steps of 1, 2 or 5 times a power of ten."""
    step = next(preferred((high - low) / most))
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return [k * step for k in range(first, last + 1)]


def numeral(value: float, mark: str = ".") -> str:
    """A number along an axis, with a true minus sign and a decimal mark."""
    return f"{value + 0.0:.6g}".replace("-", "−").replace(".", mark)


def limits_of(curves: Sequence[ChartCurve]) -> tuple[float, float]:
    """The limits of an axis that shows some curves whole, with room; a level one in the middle."""
    every = np.concatenate([curve.values[np.isfinite(curve.values)] for curve in curves])
    if not every.size:
        return -1.0, 1.0
    low, high = float(every.min()), float(every.max())
    size = max(abs(low), abs(high))
    spans = [np.ptp(own) for c in curves if (own := c.values[np.isfinite(c.values)]).size]
    if size == 0 or max(spans) < 1e-9 * size:
        room = 0.5 * size or 1.0
        return low - room, high + room
    room = SPARE * (high - low)
    return low - room, high + room


# --- legends and titles ---------------------------------------------------------------------------


def legend(curves: Sequence[ChartCurve], rect: Rect, *, right: bool) -> tuple[list[Mark], int]:
    """The samples of curves with their labels above a rectangle, and the lines that they take."""
    left, top, end, _ = rect
    named = [curve for curve in curves if curve.label]
    wide = [SAMPLE + GAP + extent(curve.label, WORDS)[0] for curve in named]
    rows: list[list[int]] = []
    for i, width in enumerate(wide):
        used = sum(wide[k] + 3 for k in rows[-1]) if rows else 0.0
        if rows and used + width <= end - left:
            rows[-1].append(i)
        else:
            rows.append([i])
    marks: list[Mark] = []
    for number, row in enumerate(rows):
        base = top - 1.6 - LINE * (len(rows) - 1 - number)
        x = end - sum(wide[k] + 3 for k in row) + 3 if right else left
        for k in row:
            middle = base - 0.8
            if named[k].dot:
                marks.append(CircleMark(x + SAMPLE / 2, middle, named[k].dot, dot_of(named[k])))
            else:
                marks.append(LineMark(x, middle, x + SAMPLE, middle, named[k].look, "legend"))
            marks.append(Text(x + SAMPLE + GAP, base, named[k].label, "caption", WORDS))
            x += wide[k] + 3
    return marks, len(rows)


def dot_of(curve: ChartCurve) -> str:
    """The classes of a curve's dots."""
    return f"dot {HUES[curve.hue % len(HUES)]}"


def title_lines(title: str, wide: float) -> list[Mark]:
    """The title of a figure in lines from its top, the words of a scene without markup."""
    words = escape(known(title)).split(" ")
    lines = flowed(words, " ", wide - 2 * MARGIN, TITLE)
    size = max((extent(line, TITLE)[0] for line in lines), default=0.0)
    height = TITLE * min(1.0, (wide - 2 * MARGIN) / size if size else 1.0)
    return [
        Text(MARGIN, MARGIN + 3.5 + 5 * i, line, "title", height) for i, line in enumerate(lines)
    ]


# --- panels over one axis -------------------------------------------------------------------------


WIDE, HIGH = 203.0, 42.0
"""Width of a figure, and height of the curves in a panel, in mm."""


def stacked(title: str, panels: Sequence[ChartPanel], axis: AcrossAxis) -> Page:
    """A figure of panels, one below another over one axis."""
    head = title_lines(title, WIDE)
    marks: list[Mark] = [*head]
    top = MARGIN + 5 * len(head) + 2
    for number, panel in enumerate(panels):
        rect = LEFT, top, WIDE - MARGIN, top + HIGH
        samples, rows = legend(panel.curves, rect, right=True)
        words = escape(panel.words)
        first = min((m.x1 for m in samples if isinstance(m, LineMark)), default=WIDE)
        beside = rows == 1 and LEFT + extent(words, WORDS)[0] + 4 < first
        down = LINE * (rows if beside else rows + 1) + 1
        rect = LEFT, top + down, WIDE - MARGIN, top + down + HIGH
        base = rect[1] - 1.6 - (0 if beside else LINE * rows)
        marks += legend(panel.curves, rect, right=True)[0]
        marks.append(Text(LEFT, base, words, "title", WORDS, name="panel"))
        marks += panel_marks(panel, axis, rect, number)
        top = rect[3] + 3
    marks += axis_below(axis, (LEFT, top, WIDE - MARGIN, top - 3))
    return Page(WIDE, top + 12, tuple(marks), title)


def axis_below(axis: AcrossAxis, rect: Rect) -> Iterator[Mark]:
    """The numbers of the axis below the lowest panel, and what it shows."""
    left, _, right, low = rect
    for value in axis.ticks or ticks_of(axis.low, axis.high, 12):
        x = left + (value - axis.low) / (axis.high - axis.low) * (right - left)
        yield Text(x, low + 4, numeral(value, axis.mark), "caption", WORDS, "middle", name="tick")
    yield Text((left + right) / 2, low + 9.5, escape(axis.words), "caption", WORDS, "middle")


def panel_marks(panel: ChartPanel, axis: AcrossAxis, rect: Rect, number: int) -> Iterator[Mark]:
    """The grid, the numbers, the vertical lines and the curves of a panel."""
    left, top, right, low = rect
    least, most = panel.bounds or limits_of(panel.curves)
    across, upright = (right - left) / (axis.high - axis.low), (low - top) / (most - least)

    def x_of(value: float) -> float:
        return left + (value - axis.low) * across

    def y_of(value: float) -> float:
        return low - (value - least) * upright

    for value in axis.ticks or ticks_of(axis.low, axis.high, 12):
        yield LineMark(x_of(value), top, x_of(value), low, "grid")
        yield LineMark(x_of(value), low, x_of(value), low + 1, "scale-line")
    for value in ticks_of(least, most):
        y = y_of(value)
        yield LineMark(left, y, right, y, "scale-line" if value == 0 else "grid")
        yield LineMark(left - 1, y, left, y, "scale-line")
        yield Text(
            left - 1.8, y + 0.8, numeral(value, axis.mark), "caption", WORDS, "end", name="tick"
        )
    yield LineMark(left, top, left, low, "scale-line")
    yield LineMark(left, low, right, low, "scale-line")
    unit = (top + low) / 2 + extent(panel.unit, WORDS)[0] / 2
    yield Text(MARGIN + 2, unit, panel.unit.replace("²", "^2").replace("³", "^3"), "caption", WORDS,
               name="unit", rotate=90)  # fmt: skip
    for each in axis.uprights:
        yield LineMark(x_of(each.at), top, x_of(each.at), low, each.look, each.words)
    for curve in panel.curves:
        values = np.asarray(curve.values, float)
        places = np.stack([left + (axis.at - axis.low) * across, low - (values - least) * upright])
        yield from in_parts(places, rect, curve)
    if number == 0:
        shares = [(np.asarray(c.values, float) - least) / (most - least) for c in panel.curves]
        yield from words_along(axis, shares, rect)


def in_parts(places: np.ndarray, rect: Rect, curve: ChartCurve) -> Iterator[Mark]:
    """The parts of a curve within a rectangle; a value that is no number interrupts it."""
    gaps = np.flatnonzero(~np.isfinite(places).all(axis=0))
    bounds = [-1, *gaps.tolist(), places.shape[1]]
    for first, last in pairwise(bounds):
        run = places[:, first + 1 : last].T.tolist()
        yield from clipped_path([(x, y) for x, y in run], rect, curve.look, curve.label)


NEAR, NARROW = 0.03, 0.01
"""Breadth of words along a line, as a share of the axis, and their clearance, of the height."""
TRIES = 24
"""Places tried for words along a line."""


def words_along(axis: AcrossAxis, shares: Sequence[Reals], rect: Rect) -> Iterator[Mark]:
    """The words of vertical lines, to their right, away from curves.

    ``shares`` are the heights of the curves, as shares of the panel's.
    """
    left, top, right, low = rect
    for each in axis.uprights:
        if not each.words:
            continue
        beside = (axis.at - each.at) / (axis.high - axis.low)
        near = (beside > -NARROW) & (beside < NEAR)
        heights = np.concatenate([share[near] for share in shares])
        heights = heights[np.isfinite(heights)]
        tall = extent(each.words, SMALL)[0] / (low - top)
        starts = sorted(np.linspace(0.02, max(0.98 - tall, 0.02), TRIES), key=lambda y: -y)
        clear = {y: np.abs(heights - y - tall / 2).min(initial=1) - tall / 2 for y in starts}
        free = [y for y in starts if clear[y] > NARROW]
        start = free[0] if free else max(starts, key=clear.__getitem__)
        x = left + (each.at - axis.low) / (axis.high - axis.low) * (right - left)
        x += SMALL + 0.8
        look = f"label {each.look}"
        y = low - float(start) * (low - top)
        yield Text(x, y, escape(each.words), look, SMALL, name="upright", rotate=90)


# --- figures in the plane -------------------------------------------------------------------------


LONG, LEAST = 180.0, 130.0
"""Longer side of the plane's part in mm, and the least width of a figure."""
Box = tuple[float, float, float, float]


class PlaneChart(Struct, frozen=True, dict=True):
    """A figure in the plane with equal scales: the box that it shows, and its part of the page."""

    title: str
    unit: str
    shown: Box
    curves: Sequence[ChartCurve]
    mark: str = "."

    @cached_property
    def mm(self) -> float:
        """Millimetres for one unit."""
        x0, x1, y0, y1 = self.shown
        return LONG / max(x1 - x0, y1 - y0)

    @property
    def wide(self) -> float:
        """The width of the page."""
        return max((self.shown[1] - self.shown[0]) * self.mm, LEAST) + LEFT + MARGIN

    @cached_property
    def rect(self) -> Rect:
        """The part of the page that shows the box."""
        x0, x1, y0, y1 = self.shown
        across = (x1 - x0) * self.mm
        room = LEFT, 0.0, self.wide - MARGIN, 0.0
        top = MARGIN + 5 * len(title_lines(self.title, self.wide)) + 3
        top += LINE * legend(self.curves, room, right=False)[1]
        left = LEFT + (self.wide - LEFT - MARGIN - across) / 2
        return left, top, left + across, top + (y1 - y0) * self.mm

    def __call__(self, place: complex) -> XY:
        """The place on the page."""
        left, _, _, low = self.rect
        return (
            left + (place.real - self.shown[0]) * self.mm,
            low - (place.imag - self.shown[2]) * self.mm,
        )


def plane_page(
    plane: PlaneChart, below: Sequence[Mark], above: Sequence[Mark] = (), note: str = ""
) -> Page:
    """The page of a figure in the plane: marks ``below`` its curves and ``above`` them."""
    left, top, right, low = rect = plane.rect
    x0, x1, y0, y1 = plane.shown
    marks: list[Mark] = [*title_lines(plane.title, plane.wide)]
    marks += legend(plane.curves, (LEFT, top, plane.wide - MARGIN, low), right=False)[0]
    most = max(2, round(12 * (x1 - x0) / max(x1 - x0, y1 - y0)))
    for value in ticks_of(x0, x1, most):
        x = plane(complex(value, y0))[0]
        marks.append(LineMark(x, top, x, low, "grid"))
        marks.append(
            Text(x, low + 4, numeral(value, plane.mark), "caption", WORDS, "middle", name="tick")
        )
    most = max(2, round(12 * (y1 - y0) / max(x1 - x0, y1 - y0)))
    for value in ticks_of(y0, y1, most):
        y = plane(complex(x0, value))[1]
        marks.append(LineMark(left, y, right, y, "grid"))
        text = numeral(value, plane.mark)
        marks.append(Text(left - 1.8, y + 0.8, text, "caption", WORDS, "end", name="tick"))
    marks += [LineMark(left, top, left, low, "scale-line")]
    marks += [LineMark(left, low, right, low, "scale-line")]
    middle = (left + right) / 2
    marks.append(Text(middle, low + 9, f"*x*, {plane.unit}", "caption", WORDS, "middle"))
    words = f"*y*, {plane.unit}"
    start = (top + low) / 2 + extent(words, WORDS)[0] / 2
    marks.append(Text(left - 13, start, words, "caption", WORDS, rotate=90))
    marks += below
    for curve in plane.curves:
        marks += curve_in(plane, rect, curve)
    marks += above
    high = low + 12
    if note:
        lines = flowed(escape(note).split(" "), " ", plane.wide - 2 * MARGIN, SMALL)
        marks += [
            Text(MARGIN, low + 14 + 3.2 * i, line, "caption", SMALL, name="note")
            for i, line in enumerate(lines)
        ]
        high = low + 13 + 3.2 * len(lines)
    return Page(plane.wide, high + MARGIN, tuple(marks), plane.title)


def curve_in(plane: PlaneChart, rect: Rect, curve: ChartCurve) -> Iterator[Mark]:
    """A curve in the plane, or its dots, within the figure."""
    left, top, right, low = rect
    z = np.asarray(curve.values, complex)
    x = left + (z.real - plane.shown[0]) * plane.mm
    y = low - (z.imag - plane.shown[2]) * plane.mm
    if not curve.dot:
        yield from in_parts(np.stack([x, y]), rect, curve)
        return
    for u, v in zip(x.tolist(), y.tolist(), strict=True):
        if isfinite(u) and isfinite(v) and left <= u <= right and top <= v <= low:
            yield CircleMark(u, v, curve.dot, dot_of(curve), curve.label)


def area_in(plane: PlaneChart, rim: np.ndarray, look: str) -> Iterator[Polyline]:
    """A filled area within the figure; the rim may run around a hole and back."""
    corners = [plane(complex(z)) for z in rim]
    left, top, right, low = plane.rect
    for side, sign, edge in ((0, 1, left), (0, -1, -right), (1, 1, top), (1, -1, -low)):
        corners = cut(corners, side, sign, edge)
    if len(corners) > 2:
        yield polygon(tuple(corners), look)


def cut(corners: Sequence[XY], side: int, sign: int, edge: float) -> list[XY]:
    """The corners of an area on one side of an upright or level edge (Sutherland and Hodgman)."""
    found: list[XY] = []
    for here, there in zip(corners, [*corners[1:], *corners[:1]], strict=True):
        a, b = sign * here[side] - edge, sign * there[side] - edge
        if a >= 0:
            found.append(here)
        if (a >= 0) != (b >= 0):
            t = a / (a - b)
            found.append((here[0] + t * (there[0] - here[0]), here[1] + t * (there[1] - here[1])))
    return found


def noted(plane: PlaneChart, place: complex, words: str, hue: int) -> Iterator[Mark]:
    """A diamond at a place, and words beside it on white, within the figure."""
    x, y = plane(place)
    left, _, right, _ = plane.rect
    look, size = f"dot {HUES[hue]}", 1.1
    yield polygon(((x - size, y), (x, y - size), (x + size, y), (x, y + size)), look, words)
    wide = extent(words, WORDS)[0]
    start = min(max(x + 2.2, left + 1), right - wide - 1)
    base = y - 2.4 if place.imag >= 0 else y + 4.4
    yield box(start - 0.4, base - 2.8, wide + 0.8, 3.6, "white")
    yield Text(start, base, words, f"label {HUES[hue]}", WORDS, name="dead")
