"""The diagrams of a motion as a hand draws them: differentiated and integrated by chords.

The place is taken from the positions. Chords and a pole give the speed, and again the
acceleration; crosses show what the plans give at the positions. The speed of the plans, summed by a
string polygon, gives the place again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from math import ceil, degrees, floor, hypot, isfinite, radians, sqrt, tau

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import STRAIGHT, Pencil
from graphkin.construction.core.paper_canvas import clipped_path
from graphkin.construction.core.quantities import BY_TARGET, JERK, SHEETS
from graphkin.construction.core.relation import figure
from graphkin.construction.diagram_steps import (
    CHORD,
    SECOND,
    SECOND_TANGENT,
    TANGENT,
    ChordRay,
    by_tangents,
    differentiated,
    integrated,
    smooth,
)
from graphkin.documents.diagram_numbers import FINE, FollowerMotion, calm
from graphkin.documents.positions import PositionSet, at_position, is_whole
from graphkin.documents.positions_sheet import (
    AIR,
    MANY,
    PROOF,
    field_on,
    foot_line,
    framed,
    heading,
    headline,
    places_table,
    proof,
)
from graphkin.documents.sheet import title_of
from graphkin.drawing.field import XY, Rect
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Page, Text, box
from graphkin.drawing.richtext import extent, flowed
from graphkin.drawing.scale import preferred
from graphkin.drawing.symbol_markup import escape
from graphkin.drawing.symbols import head
from graphkin.motion.course import Reals
from graphkin.motion.cycle import assigned, columns_at
from graphkin.motion.extremes import asked_measures
from graphkin.scene.link_points import lettered
from graphkin.text import Words

BEFORE, AFTER = 96 / 386, 12 / 386
"""The room before the axis of ordinates, where poles lie, and after the diagrams: parts of the
field's width."""
NAMED = 12.0
"""The least room after the diagrams, for the name of the axis, in mm."""
OVER, GAP = 6.0, 7.0
"""The room above the first diagram, and between two, in mm."""
NUMBERED = 4.0
"""The room above the zero line of a small diagram for the numbers of positions, in mm."""
ARROW = 5.0
"""Length of an axis beyond the diagram, in mm."""
LETTERS = 2.5
"""Height of letters in mm."""
POLES = (80.0, 60.0, 50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0)
"""Possible distances of a pole from its axis, in mm."""
FILLED = 0.92
"""The part of a diagram's height that its values fill."""
CROSS = 1.1
"""Half the size of a cross that shows a value of a plan, in mm."""
POINT = 0.7
"""Radius of a point in mm."""
GROWN = 4.0
"""The largest mechanical advantage that is drawn, in medians."""
ROUNDING = 1e-9
"""The share of its natural size below which a rate is zero."""
UNSEEN = 1e-5
"""The share of a diagram that no drawing shows: 4 µm of the widest."""
TICKS = 6
"""The most numbers along an axis of ordinates."""


class Axes(Struct, frozen=True):
    """A diagram's frame: its rectangle, the height of its zero line, and its scales.

    ``wide`` and ``high`` are mm for one unit of u and of the ordinate; ``start`` is u at the axis.
    ``wide`` is below zero where the driver runs backwards: the diagrams run with the time.
    """

    rect: Rect
    zero: float
    wide: float
    high: float
    start: float

    def on_page(self, at: XY) -> XY:
        """A place in mm from the diagram's own origin, y upwards, on the page."""
        return self.rect[0] + at[0], self.zero - at[1]

    def place(self, u: float, value: float) -> XY:
        """A point of the diagram in mm from its own origin, y upwards."""
        return (u - self.start) * self.wide, value * self.high


def axes_for(motion: FollowerMotion, top: float, low: float, values: Reals, most: float) -> Axes:
    """The frame of a diagram of the follower for some values, which may not exceed a size."""
    left, right = sides(motion)
    return fitted((left, top, right, low), motion.at, values, most)


def fitted(rect: Rect, at: Reals, values: Reals, most: float, above: float = 0.0) -> Axes:
    """The frame in a rectangle for some values, with some room above its zero line."""
    left, top, right, low = rect
    known = np.clip(values[np.isfinite(values)], -most, most)
    least, largest = min(float(known.min()), 0.0), max(float(known.max()), 0.0)
    share = FILLED / (largest - least or 1.0)
    upper = top + max(above - largest * share * (low - top), 0.0)
    high = share * (low - upper)
    zero = (upper + low) / 2 + (largest + least) / 2 * high
    return Axes(rect, zero, (right - left) / float(at[-1] - at[0]), high, float(at[0]))


def sides(motion: FollowerMotion) -> tuple[float, float]:
    """The left and right ends of the diagrams: room for poles before them."""
    left, _, right, _ = field_on(motion.found)
    return left + BEFORE * (right - left), right - max(AFTER * (right - left), NAMED)


def room_for_pole(motion: FollowerMotion) -> float:
    """The largest distance of a pole from its axis, in mm."""
    return sides(motion)[0] - field_on(motion.found)[0] - 8


# --- one diagram: axes, curves, points ------------------------------------------------------------


def frame_of(
    motion: FollowerMotion,
    axes: Axes,
    name: str,
    unit: str,
    factor: float,
    *,
    is_zero: bool = False,
) -> Iterator[Mark]:
    """The axes of a diagram, its numbers, and the lines at the positions.

    ``factor`` is the number of printed units in one SI unit. A quantity that ``is_zero`` all along
    has no numbers.
    """
    _, top, right, low = axes.rect
    words = motion.found.shown.alone.words
    yield from axis_lines(axes, name, f"*{name}*, {escape(words.unit(unit)).replace('²', '^2')}")
    at = right + ARROW + 1, axes.zero + 0.9
    sign = "−" if axes.wide < 0 else ""
    yield Text(*at, f"{sign}*{u_symbol(motion)}*", "caption", LETTERS, name="axis u")
    names = position_names(motion.found, motion.at)
    for i, u in enumerate(motion.at):
        x, _ = axes.on_page(axes.place(float(u), 0.0))
        yield LineMark(x, top, x, low, "register", f"position {i}")
        yield Text(x + 0.7, axes.zero + 3.2, names[i], "caption", LETTERS, name=f"position {i}")
    if not is_zero:
        yield from numbers_along(words, axes, name, factor, TICKS)


def axis_lines(axes: Axes, name: str, said: str) -> Iterator[Mark]:
    """The two axes of a diagram, the axis of ordinates with its symbol and unit."""
    left, top, right, low = axes.rect
    for start, end in (
        ((left, axes.zero), (right + ARROW, axes.zero)),
        ((left, low), (left, top - ARROW / 2)),
    ):
        yield LineMark(*start, *end, "dimension", f"axis {name}")
        yield head(start, end, "dimension", f"axis {name}")
    yield Text(left + 1.8, top - 0.6, said, "caption", LETTERS, name=f"axis {name}")


def numbers_along(words: Words, axes: Axes, name: str, factor: float, count: int) -> Iterator[Mark]:
    """The round numbers along an axis of ordinates: about ``count``, two beside zero at least."""
    left, top, _, low = axes.rect
    lowest, highest = ((axes.zero - y) / axes.high * factor for y in (low, top))
    for parts in (count, 2.5 * count):
        pace = next(preferred((highest - lowest) / parts))
        first, last = ceil(lowest / pace), floor(highest / pace)
        if last - first - (first <= 0 <= last) >= 1:
            break
    for k in range(first, last + 1):
        y = axes.zero - k * pace / factor * axes.high
        yield LineMark(left - 1.2, y, left + 1.2, y, "dimension", f"axis {name}")
        if k:
            number = words.decimal(f"{k * pace:.6g}")
            yield from cleared(Text(left - 2, y + 0.7, number, "caption", LETTERS, "end", "axis"))


def cleared(text: Text) -> Iterator[Mark]:
    """A text with the lines below it left out."""
    xs, ys = zip(*text.corners(), strict=True)
    left, top, wide, high = min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)
    yield box(left - AIR, top - AIR, wide + 2 * AIR, high + 2 * AIR, "white")
    yield text


def u_symbol(motion: FollowerMotion) -> str:
    """The letter of the driver's coordinate."""
    return {"phi": "φ"}.get(motion.found.cycle.sweep.symbol, motion.found.cycle.sweep.symbol)


def position_names(found: PositionSet, at: Reals) -> list[str]:
    """The numbers of the positions at some places; a whole turn ends at its first position."""
    if is_whole(found.cycle):
        return [found.numbered[i % len(found.numbered)].name for i in range(len(at))]
    places = [each.at for each in found.numbered]
    return [found.numbered[int(np.abs(np.array(places) - u).argmin())].name for u in at]


def curve(axes: Axes, points: Sequence[XY], cls: str, name: str) -> Iterator[Mark]:
    """A curve through points, as far as it lies in its diagram."""
    run: list[XY] = []
    for point in (*points, (float("nan"), 0.0)):
        if all(map(isfinite, point)):
            run.append(axes.on_page(point))
            continue
        yield from clipped_path(run, axes.rect, cls, name)
        run = []


def course(
    motion: FollowerMotion, axes: Axes, values: Reals, cls: str, name: str
) -> Iterator[Mark]:
    """An exact course over the fine places."""
    both = zip(motion.fine, values, strict=True)
    yield from curve(axes, [axes.place(float(u), float(v)) for u, v in both], cls, name)


def crosses(
    motion: FollowerMotion, axes: Axes, values: Reals, look: str, name: str
) -> Iterator[Mark]:
    """The values of the plans at the positions."""
    names = position_names(motion.found, motion.at)
    for i, (u, value) in enumerate(zip(motion.at, values, strict=True)):
        if isfinite(value):
            x, y = axes.on_page(axes.place(float(u), float(value)))
            if axes.rect[1] <= y <= axes.rect[3]:
                for way in (1, -1):
                    ends = (x - CROSS, y - way * CROSS, x + CROSS, y + way * CROSS)
                    yield LineMark(*ends, f"centre {look}", at_position(name, names[i]))


def dots(axes: Axes, points: Sequence[XY], look: str, name: str) -> Iterator[Mark]:
    """The points that the construction finds."""
    for i, point in enumerate(points):
        x, y = axes.on_page(point)
        if axes.rect[1] <= y <= axes.rect[3]:
            yield CircleMark(x, y, POINT, f"point {look}", f"{name}_{i}")


# --- the construction: chords, pole, rays ---------------------------------------------------------


class RateMethod(Struct, frozen=True):
    """A way to differentiate: its lines, and the shares of h² in the errors of both rates.

    ``signs``, ``said`` and ``cost`` are the keys of its sentences.
    """

    name: str
    first: float
    second: float
    signs: str
    said: str
    cost: str

    def steps(self, points: Sequence[XY], distance: float, *, closed: bool) -> list[ChordRay]:
        """The rates of a diagram, which is ``closed`` if it begins anew at its end."""
        if self is TANGENTS:
            return by_tangents(points, distance, closed=closed)
        return differentiated(points, distance)


CHORDS = RateMethod(
    *("chord", CHORD, SECOND),
    *("diagrams.chord_signs", "diagrams.chord_steps", "diagrams.chord_cost"),
)
TANGENTS = RateMethod(
    *("tangent", TANGENT, SECOND_TANGENT),
    *("diagrams.tangent_signs", "diagrams.tangent_steps", "diagrams.tangent_cost"),
)


class Derived(Struct, frozen=True):
    """A diagram differentiated: the steps, the frame of the result, and the pole's distance."""

    steps: list[ChordRay]
    axes: Axes
    distance: float
    name: str
    method: RateMethod = CHORDS

    @property
    def points(self) -> list[XY]:
        """The points that the construction finds."""
        return [each.found for each in self.steps]

    @property
    def places(self) -> Reals:
        """The places u of these points."""
        return np.array([x for x, _ in self.points]) / self.axes.wide + self.axes.start


def derive(
    motion: FollowerMotion,
    axes: Axes,
    points: Sequence[XY],
    top: float,
    low: float,
    name: str,
    exact: Reals,
    method: RateMethod = CHORDS,
) -> Derived:
    """The diagram of the rate, drawn from some points of another with the largest pole distance.

    The distance is a round number of mm at which these values and the ``exact`` course fit; the
    scale follows from it.
    """
    left, right = sides(motion)
    room = room_for_pole(motion)
    closed = is_whole(motion.found.cycle)
    unit = method.steps(points, 1.0, closed=closed)
    share = axes.high / axes.wide / motion.pace * motion.found.cycle.sweep.per_unit
    most, known = calm(motion.found, exact), exact[np.isfinite(exact)]
    drawn = smooth_round(motion, [each.found for each in unit], axes.wide, method)
    heights = np.concatenate([[y for _, y in drawn], known * share])
    heights = np.clip(heights, -most * share, most * share)
    least, largest = min(float(heights.min()), 0.0), max(float(heights.max()), 0.0)
    fits = [h for h in POLES if h <= room and h * (largest - least) <= FILLED * (low - top)]
    distance = fits[0] if fits else POLES[-1]
    high = distance * share
    middle = (top + low) / 2 + (largest + least) / 2 * distance
    own = Axes((left, top, right, low), middle, axes.wide, high, axes.start)
    return Derived(method.steps(points, distance, closed=closed), own, distance, name, method)


def construction(words: Words, before: Axes, found: Derived, look: str) -> Iterator[Mark]:
    """The chords in the first diagram, and in the second the pole, its rays and the points."""
    axes, name = found.axes, found.name
    foot = axes.rect[0]
    pole = foot - found.distance, axes.zero
    for i, each in enumerate(found.steps):
        start, end = before.on_page(each.first), before.on_page(each.last)
        yield LineMark(*start, *end, "construction", f"{found.method.name} {name}_{i}")
        height = axes.zero - each.end[1]
        x, y = axes.on_page(each.found)
        if axes.rect[1] <= height <= axes.rect[3]:
            yield LineMark(*pole, foot, height, "construction", f"ray {name}_{i}")
            yield LineMark(foot, height, x, y, "ray", f"carried {name}_{i}")
    yield LineMark(*pole, foot, axes.zero, "centre-line", f"pole distance {name}")
    yield CircleMark(*pole, 1.1, f"pole {look}", f"P_{name}")
    letter = f"*P*_{{*{name}*}}"
    yield Text(pole[0] - 2, pole[1] + 0.9, letter, f"label {look}", LETTERS, "end", f"P_{name}")
    yield from pole_caption(words, pole, found.distance, f"pole distance {name}")


def pole_caption(words: Words, pole: XY, distance: float, name: str) -> Iterator[Mark]:
    """The distance of a pole below its line; below its sign too where the line is short."""
    caption = f"*H* = {distance:g} {words.unit('mm')}"
    foot, zero = pole[0] + distance, pole[1]
    text = Text(foot - 1.5, zero + 5.2, caption, "caption", LETTERS, "end", name)
    if distance > extent(caption, LETTERS)[0] + 3:
        text = Text(foot - distance / 2, zero + 3.2, caption, "caption", LETTERS, "middle", name)
    yield from cleared(text)


# --- the sheet of differentiation -----------------------------------------------------------------


def units_of(
    motion: FollowerMotion,
) -> tuple[tuple[str, float], tuple[str, float], tuple[str, float]]:
    """The printed unit of place, speed and acceleration, with its number in one SI unit."""
    if motion.is_link:
        return ("°", degrees(1.0)), ("rad/s", 1.0), ("rad/s²", 1.0)
    drawing = motion.found.shown.alone
    unit = drawing.scene.units["length"]
    return (unit, drawing.length(1.0)), ("m/s", 1.0), ("m/s²", 1.0)


def differentiation_page(motion: FollowerMotion, method: RateMethod, number: str) -> Page:
    """The sheet of place, speed and acceleration, each from the one before by one method."""
    drawing, words = motion.found.shown.alone, motion.found.shown.alone.words
    _, top, _, foot = field_on(motion.found)
    height = (foot - top - OVER - 3 - 2 * GAP) / 3
    tops = [top + OVER + i * (height + GAP) for i in range(3)]
    where, speed, push = values_at(motion, motion.at)
    exact = values_at(motion, motion.fine)
    low = float(min(np.nanmin(exact[0]), np.nanmin(where)))
    units, kinds = units_of(motion), motion.kinds
    first = axes_for(motion, tops[0], tops[0] + height, exact[0] - low, np.inf)
    points = [first.place(float(u), float(v - low)) for u, v in zip(motion.at, where, strict=True)]
    rate, again = derived_twice(motion, method, first, points, tops, exact)
    marks: list[Mark] = [
        *heading(motion.found, drawing, words("sheet.differentiation")),
        *field_caption(motion, method.signs),
        *construction(words, first, rate, "velocity"),
        *construction(words, rate.axes, again, "acceleration"),
        *frame_of(motion, first, kinds[0], *units[0]),
        *frame_of(motion, rate.axes, kinds[1], *units[1], is_zero=is_zero(motion, 1)),
        *frame_of(motion, again.axes, kinds[2], *units[2], is_zero=is_zero(motion, 2)),
        *course(motion, first, exact[0] - low, "profile", kinds[0]),
        *course(motion, rate.axes, exact[1], "trajectory", f"exact {kinds[1]}"),
        *course(motion, again.axes, exact[2], "trajectory", f"exact {kinds[2]}"),
        *through(motion, rate, "velocity"),
        *through(motion, again, "acceleration"),
        *dots(first, points, "construction", kinds[0]),
        *dots(rate.axes, rate.points, "velocity", kinds[1]),
        *dots(again.axes, again.points, "acceleration", kinds[2]),
        *crosses(motion, rate.axes, speed, "velocity", kinds[1]),
        *crosses(motion, again.axes, push, "acceleration", kinds[2]),
        *foot_line(motion.found),
        *sentence_lines(
            motion.found, [*scales_said(motion, first, rate, again), *costs(motion, rate, again)]
        ),
        *proof(motion.found),
    ]
    title = f"{words('sheet.differentiation')} – {title_of(drawing)}"
    return framed(drawing, number, words("sheet.document_diagrams"), "–", marks, title)


def derived_twice(
    motion: FollowerMotion,
    method: RateMethod,
    first: Axes,
    points: Sequence[XY],
    tops: Sequence[float],
    exact: Sequence[Reals],
) -> tuple[Derived, Derived]:
    """The diagrams of the speed and of the acceleration, with room for their exact courses."""
    height, kinds = first.rect[3] - first.rect[1], motion.kinds
    room = [(top, top + height) for top in tops]
    rate = derive(motion, first, points, *room[1], kinds[1], exact[1], method)
    then = closed_round(motion, rate)
    return rate, derive(motion, rate.axes, then, *room[2], kinds[2], exact[2], method)


# --- the sheet of integration ---------------------------------------------------------------------


def integration_page(motion: FollowerMotion, number: str) -> Page:
    """The sheet of the speed from the plans, and of the place by a string polygon."""
    drawing, words = motion.found.shown.alone, motion.found.shown.alone.words
    _, top, _, foot = field_on(motion.found)
    height = (foot - top - OVER - 3 - GAP) / 2
    tops = [top + OVER, top + OVER + height + GAP]
    where, speed, _ = values_at(motion, motion.at)
    exact = values_at(motion, motion.fine)
    low = float(min(np.nanmin(exact[0]), np.nanmin(where)))
    units, kinds = units_of(motion), motion.kinds
    drawn = smooth([*zip(motion.at, speed, strict=True)])
    first = axes_for(motion, tops[0], tops[0] + height, np.array([v for _, v in drawn]), np.inf)
    last = axes_for(motion, tops[1], tops[1] + height, exact[0] - low, np.inf)
    distance, first, second = string_scale(motion, first, last)
    points = [first.place(float(u), float(v)) for u, v in zip(motion.at, speed, strict=True)]
    means = mean_ordinates(points, closed=is_whole(motion.found.cycle))
    begun = second.place(float(motion.at[0]), float(where[0] - low))[1]
    strings = integrated([x for x, _ in points], means, distance, begun)
    found = Derived(strings, second, distance, kinds[0])
    marks: list[Mark] = [
        *heading(motion.found, drawing, words("sheet.integration")),
        *field_caption(motion, "diagrams.strings"),
        *levels(words, first, found),
        *frame_of(motion, first, kinds[1], *units[1]),
        *frame_of(motion, second, kinds[0], *units[0]),
        *curve(first, smooth(points), "velocity", kinds[1]),
        *crosses(motion, first, speed, "velocity", kinds[1]),
        *course(motion, second, exact[0] - low, "trajectory", f"exact {kinds[0]}"),
        *curve(second, [strings[0].first, *(s.last for s in strings)], "profile", kinds[0]),
        *dots(second, [strings[0].first, *(s.last for s in strings)], "construction", kinds[0]),
        *crosses(motion, second, where - low, "construction", kinds[0]),
        *foot_line(motion.found),
        *sentence_lines(motion.found, strings_said(motion, first, found, where - low)),
        *proof(motion.found),
    ]
    title = f"{words('sheet.integration')} – {title_of(drawing)}"
    return framed(drawing, number, words("sheet.document_diagrams"), "–", marks, title)


def mean_ordinates(points: Sequence[XY], *, closed: bool) -> list[float]:
    """The level in each interval that leaves equal areas below and above the smooth curve."""
    turn = points[-1][0] - points[0][0]
    before = [(points[-2][0] - turn, points[-2][1])] if closed else points[:1]
    after = [(points[1][0] + turn, points[1][1])] if closed else points[-1:]
    around = [*before, *points, *after]
    slopes = [(v - y) / (u - x) for (x, y), (u, v) in zip(around, around[2:], strict=False)]
    return [
        (y + v) / 2 + (u - x) / 12 * (slopes[i] - slopes[i + 1])
        for i, ((x, y), (u, v)) in enumerate(pairwise(points))
    ]


def string_scale(motion: FollowerMotion, first: Axes, last: Axes) -> tuple[float, Axes, Axes]:
    """The pole distance with which the strings fill their diagram, and both frames at their scales.

    Where the strings of the largest distance rise too far, the speed is drawn smaller.
    """
    room = room_for_pole(motion)
    per_unit = motion.found.cycle.sweep.per_unit

    def high(distance: float) -> float:
        return motion.pace * first.wide * first.high / per_unit / distance

    possible = [h for h in reversed(POLES) if h <= room]
    distance = next((h for h in possible if high(h) <= last.high), possible[-1])
    factor = min(high(distance), last.high)
    return distance, scaled(first, factor / high(distance)), scaled(last, factor / last.high)


def scaled(axes: Axes, share: float) -> Axes:
    """A frame whose values are drawn smaller, with the foot of the values where it was."""
    _, _, _, low = axes.rect
    return replace(axes, zero=low - (low - axes.zero) * share, high=axes.high * share)


def levels(words: Words, first: Axes, found: Derived) -> Iterator[Mark]:
    """The level of each interval, its ray to the pole, and the string parallel to the ray."""
    foot = first.rect[0]
    pole = foot - found.distance, first.zero
    for i, each in enumerate(found.steps):
        height = first.zero - each.end[1]
        if not first.rect[1] <= height <= first.rect[3]:
            continue
        (x, _), (u, _) = first.on_page(each.first), first.on_page(each.last)
        yield LineMark(x, height, u, height, "construction", f"level {i}")
        yield LineMark(foot, height, x, height, "ray", f"carried {i}")
        yield LineMark(*pole, foot, height, "construction", f"ray {i}")
    yield LineMark(*pole, foot, first.zero, "centre-line", "pole distance")
    yield CircleMark(*pole, 1.1, "pole velocity", "P")
    yield Text(pole[0] - 2, pole[1] + 0.9, "*P*", "label velocity", LETTERS, "end", "P")
    yield from pole_caption(words, pole, found.distance, "pole distance")


def strings_said(motion: FollowerMotion, first: Axes, found: Derived, where: Reals) -> list[str]:
    """The steps of the integration, the scale that follows, and its errors."""
    drawing, words = motion.found.shown.alone, motion.found.shown.alone.words
    s, v, _ = motion.kinds
    sweep = motion.found.cycle.sweep
    unit = "rad" if motion.is_link else "m"
    pace = {"turn": "/*ω*", "slide": "/*v*"}.get(sweep.what, "")
    drawn = np.array([each.last[1] for each in found.steps]) / found.axes.high
    off = worst(drawn - where[1:]) / (float(np.ptp(where)) or 1.0)
    count = len(found.steps)
    interval = first.wide * float(motion.at[1] - motion.at[0])
    hand = mark() * sqrt(count) * interval / found.distance / found.axes.high
    per_mm = words.unit(f"{rates_units(motion)[0]}/mm")
    rule = f"*k*_{{*{s}*}} = *k*_{{*{v}*}}·*k*_{{*{u_symbol(motion)}*}}·*H*{pace}"
    said: list[str] = [
        words("diagrams.levels", v=v),
        words("diagrams.polygon", s=s),
        words.clauses(
            (
                f"{rule} = {figure(drawing, 1 / found.axes.high)} {words.unit(f'{unit}/mm')}",
                f"*k*_{{*{v}*}} = {figure(drawing, 1 / first.high)} {per_mm}.",
            )
        ),
        words(
            "diagrams.summed",
            s=s,
            off=percent(words, off),
            pencil=percent(words, hand / (float(np.ptp(where)) or 1.0)),
        ),
    ]
    if is_whole(motion.found.cycle):
        gap = abs(drawn[-1] - where[-1]) * found.axes.high
        missed = words.significant(float(gap), 2) if gap > 5e-3 else "0"
        turns = round((where[-1] - where[0]) / tau) if motion.is_link else 0
        turned = f"{words.decimal(str(360 * turns))}°"
        key = "diagrams.gap_turned" if turns else "diagrams.gap"
        said.append(words(key, s=s, turned=turned, gap=missed))
    return said


# --- values and points ----------------------------------------------------------------------------


def values_at(motion: FollowerMotion, at: Reals) -> list[Reals]:
    """The place, the speed, and what differentiating the speed by u gives, at places u."""
    speed, acceleration = motion.rates(at)
    return [motion.place(at), speed, acceleration - motion.push / motion.pace * speed]


def closed_round(motion: FollowerMotion, rate: Derived) -> list[XY]:
    """The points of a derived diagram; over a whole turn with the last of the turn before.

    Tangents find the points at both ends of a turn.
    """
    points = rate.points
    if not is_whole(motion.found.cycle) or rate.method is TANGENTS:
        return points
    turn = rate.axes.wide * float(motion.at[-1] - motion.at[0])
    (x, y), (u, v) = points[-1], points[0]
    return [(x - turn, y), *points, (u + turn, v)][: len(points) + 1]


def smooth_round(
    motion: FollowerMotion, points: Sequence[XY], wide: float, method: RateMethod
) -> list[XY]:
    """The smooth curve through the points of a derived diagram; over a whole turn it goes on."""
    if is_whole(motion.found.cycle):
        turn = wide * float(motion.at[-1] - motion.at[0])
        once = points[:-1] if method is TANGENTS else points
        before = [(x - turn, y) for x, y in once[-2:]]
        after = [(x + turn, y) for x, y in once[len(points) - len(once) :][:2]]
        points = [*before, *points, *after]
    return smooth(points) if len(points) > 2 else [*points]


def through(motion: FollowerMotion, found: Derived, look: str) -> Iterator[Mark]:
    """The smooth curve through the points that the chords give."""
    drawn = smooth_round(motion, found.points, found.axes.wide, found.method)
    if len(drawn) > 2:
        yield from curve(found.axes, drawn, look, found.name)


def field_caption(motion: FollowerMotion, signs: str) -> Iterator[Mark]:
    """The caption of the field: whose motion it is, and what the kinds of points are."""
    words = motion.found.shown.alone.words
    key = "diagrams.link" if motion.is_link else "diagrams.block"
    said = words(key, k=escape(motion.mover.name))
    text = f"{said};  {words(signs)}"
    yield from headline(motion.found, text)


SPACED = ((LETTERS, 4.3), (LETTERS, 3.6), (1.8, 3.0), (1.8, 2.6))
"""Heights of letters and distances of lines of the sentences, in mm: the first that has room."""


def sentence_lines(found: PositionSet, said: Sequence[str]) -> Iterator[Mark]:
    """Sentences below the field, left of the title block and above the residual check."""
    left, top, right, low = found.shown.alone.paper.leaf.notes
    for letters, leading in SPACED:
        lines = [
            (f"{number}." if not i else "", line)
            for number, sentence in enumerate(said, 1)
            for i, line in enumerate(flowed(sentence.split(" "), " ", right - left - 5, letters))
        ]
        if 4.2 + (len(lines) - 1) * leading <= low - PROOF - top:
            break
    for i, (number, line) in enumerate(lines):
        y = top + 4.2 + i * leading
        if number:
            yield Text(left, y, number, "caption", letters, name="sentence")
        yield Text(left + 5, y, line, "caption", letters, name="sentence")


# --- scales and errors ----------------------------------------------------------------------------


def scales_said(motion: FollowerMotion, first: Axes, rate: Derived, again: Derived) -> list[str]:
    """The scale factors, and how those of the derived diagrams follow from the pole distances."""
    drawing, words = motion.found.shown.alone, motion.found.shown.alone.words
    s, v, a = motion.kinds
    sweep = motion.found.cycle.sweep
    k_u = sweep.per_unit / abs(first.wide)
    unit_u = words.unit({"turn": "rad/mm", "slide": "m/mm", "time": "s/mm"}.get(sweep.what, "m/mm"))
    units = [
        words.unit(f"{unit}/mm")
        for unit in (("rad" if motion.is_link else "m"), *rates_units(motion))
    ]
    pace = "" if sweep.what == "time" else ("*ω*·" if sweep.what == "turn" else "*v*·")
    u = u_symbol(motion)
    return [
        words(
            "diagrams.scales",
            u=u,
            s=s,
            ku=f"{figure(drawing, k_u)} {unit_u}",
            ks=f"{figure(drawing, 1 / first.high)} {units[0]}",
        ),
        words(
            "diagrams.derived",
            rate=f"*k*_{{*{v}*}} = {pace}*k*_{{*{s}*}}/(*k*_{{*{u}*}}·*H*)",
            k=f"{figure(drawing, 1 / rate.axes.high)} {units[1]}",
            again=f"*k*_{{*{a}*}} = {pace}*k*_{{*{v}*}}/(*k*_{{*{u}*}}·*H*)",
            more=f"{figure(drawing, 1 / again.axes.high)} {units[2]}",
        ),
        words(rate.method.said, s=s, v=v),
    ]


def rates_units(motion: FollowerMotion) -> tuple[str, str]:
    """The units of speed and acceleration in brackets where they are fractions."""
    return ("(rad/s)", "(rad/s^2)") if motion.is_link else ("(m/s)", "(m/s^2)")


class Cost(Struct, frozen=True):
    """The errors of a derived diagram, as shares of its largest value.

    ``chord`` is that of the exact chords or tangents, ``forecast`` what the derivatives predict for
    it, and ``pencil`` what the marks of a hand add for 95 of 100 points.
    """

    chord: float
    forecast: float
    pencil: float


def cost_of_rate(motion: FollowerMotion, rate: Derived) -> Cost:
    """The error of the speed: a share of h² of the third derivative."""
    exact = values_at(motion, rate.places)[1]
    drawn = np.array([y for _, y in rate.points]) / rate.axes.high
    third = motion.derivatives(rate.places)[2]
    size = largest(motion, exact)
    forecast = rate.method.first * motion.step**2 * np.abs(motion.pace * third)
    hand = hand_of_rate(motion, rate) / rate.axes.high
    return Cost(worst(drawn - exact) / size, worst(forecast) / size, hand / size)


def cost_of_second(motion: FollowerMotion, rate: Derived, again: Derived) -> Cost:
    """The error of the acceleration: a share of h² of the fourth derivative."""
    exact = values_at(motion, again.places)[2]
    drawn = np.array([y for _, y in again.points]) / again.axes.high
    fourth = motion.derivatives(again.places)[3]
    size = largest(motion, exact)
    forecast = again.method.second * motion.step**2 * np.abs(motion.pace**2 * fourth)
    interval = interval_of(motion, rate)
    if again.method is TANGENTS:
        before = sqrt(2) * hand_of_rate(motion, rate) * again.distance / (2 * interval)
        hand = hypot(before, hand_of_rate(motion, again))
    else:
        hand = sqrt(6) * mark() * rate.distance * again.distance / interval**2
    hand /= again.axes.high
    return Cost(worst(drawn - exact) / size, worst(forecast) / size, hand / size)


def interval_of(motion: FollowerMotion, found: Derived) -> float:
    """The interval between two positions, in mm."""
    return found.axes.wide * float(motion.at[1] - motion.at[0])


def hand_of_rate(motion: FollowerMotion, rate: Derived) -> float:
    """What a hand adds to an ordinate, in mm: by two marks of a chord, or by a tangent's angle."""
    if rate.method is CHORDS:
        return sqrt(2) * mark() * rate.distance / interval_of(motion, rate)
    tangent = float(np.median([abs(y / rate.distance) for _, y in rate.points]))
    return rate.distance * (1 + tangent**2) * radians(Pencil().degrees)


def mark() -> float:
    """The error in mm of a mark along one axis that 95 of 100 marks keep."""
    return STRAIGHT * Pencil().mark


def largest(motion: FollowerMotion, values: Reals) -> float:
    return calm(motion.found, values) or 1.0


def worst(values: Reals) -> float:
    known = np.abs(values[np.isfinite(values)])
    return float(known.max(initial=0.0))


def is_zero(motion: FollowerMotion, order: int) -> bool:
    """Whether the speed (``order`` 1) or the acceleration (2) is zero all along, but for rounding.

    It is compared with a rate that would change the quantity before it by its own size.
    """
    before, own = values_at(motion, motion.fine)[order - 1 : order + 1]
    natural = worst(before) * abs(motion.pace / float(motion.at[-1] - motion.at[0]))
    return worst(own) <= ROUNDING * natural


def percent(words: Words, share: float) -> str:
    """A share of a diagram in percent; what no drawing shows is 0."""
    if share < UNSEEN:
        return "0"
    return words.significant(100 * share, 2) if share < 1 else ">100"


def costs(motion: FollowerMotion, rate: Derived, again: Derived) -> list[str]:
    """What the method costs in accuracy, against the exact course, and what the pencil adds."""
    words, found = motion.found.shown.alone.words, []
    for order, cost in ((1, cost_of_rate(motion, rate)), (2, cost_of_second(motion, rate, again))):
        name = motion.kinds[order]
        if is_zero(motion, order):
            found.append(words("diagrams.zero", v=name))
            continue
        shares = {
            key: percent(words, getattr(cost, key)) for key in ("chord", "forecast", "pencil")
        }
        found.append(words(rate.method.cost, v=name, **shares))
    limit = words.significant(mark(), 1)
    return [*found, words("diagrams.plans", mark=limit)]


# --- the sheets of everything asked over the positions --------------------------------------------


LOOKS = {kind: kind for kind in SHEETS} | {JERK: "acceleration"}
"""The look of the curve of each derivative."""
LEAST, ROWS = 85.0, 4
"""Least width in mm of a diagram, and the most diagrams one above the other, on a sheet."""


class Asked(Struct, frozen=True):
    """A motion or a force that the scene asks for: its symbol and unit, and its values."""

    symbol: str
    unit: str
    name: str
    kind: str
    at_positions: Reals
    fine: Reals
    most: float | None = None


def of_follower(motion: FollowerMotion, at: Reals, fine: Reals) -> list[Asked]:
    """The jerk of the follower, and its mechanical advantage, which grows at dead points."""
    k, driver = escape(motion.mover.name), motion.found.cycle.sweep.driver
    letter = "ε" if motion.is_link else "a"
    unit = "rad/s³" if motion.is_link else "m/s³"
    jerk = f"d*{letter}*_{{{k}}}/d*t*"
    nothing = np.full(len(at), np.nan)
    made = [Asked(jerk, unit, f"jerk {k}", "acceleration", nothing, motion.third(fine))]
    if driver is not None:
        rate = "ω" if driver.kind == "turn" else "v"
        ratio = f"|*{rate}*_{{{escape(driver.link)}}}/*{motion.kinds[1]}*_{{{k}}}|"
        per = {(False, "ω"): "1/m", (True, "v"): "m"}.get((motion.is_link, rate), "1")
        values = motion.advantage(at), motion.advantage(fine)
        most = GROWN * float(np.nanmedian(values[1]))
        made.append(Asked(ratio, per, f"advantage {k}", "velocity", *values, most))
    return made


def asked_courses(found: PositionSet, at: Reals, fine: Reals) -> list[Asked]:
    """What the scene asks for at the positions and between them."""
    measures = [*asked_measures(found.cycle)]
    targets = list(dict.fromkeys(target for each in measures for target in each.targets))
    cycle = found.cycle
    both = [columns_at(cycle.sweep, cycle.path, u, targets).columns for u in (at, fine)]
    made = []
    for each in measures:
        quantity = BY_TARGET[each.targets[0][0]]
        letter = found.shown.alone.symbol(f"{quantity.letter}_{lettered(each.of)}")
        size = quantity.sort == "vector"
        here, between = (each.value(columns) for columns in both)
        text = f"|{letter}|" if size else letter
        name = f"{quantity.letter}_{each.of}"
        if quantity.kind not in SHEETS:  # a jerk has no plan
            here = np.full(len(at), np.nan)
        made.append(Asked(text, each.unit, name, LOOKS[quantity.kind], here, between))
    return made


def force_courses(found: PositionSet, at: Reals, fine: Reals) -> list[Asked]:
    """The reactions and balances that the scene asks for, at the positions and between them."""
    cycle, given = found.cycle, found.cycle.scene.forces
    if given is None or not given.asked:
        return []
    from graphkin.motion.cycle import forces_along

    known = []
    for u in (at, fine):
        number, within = assigned(cycle.path, u, 0.0)
        forces = forces_along(cycle.pieces, number, within, given)
        if forces is None:
            return []
        known.append(forces.values)
    made = []
    for target in known[0]:
        quantity, (here, between) = BY_TARGET[target[0]], (some[target] for some in known)
        size = np.iscomplexobj(between)
        letter = found.shown.alone.symbol(target[1])
        values = (np.abs(here), np.abs(between)) if size else (here, between)
        text = f"|{letter}|" if size else letter
        made.append(Asked(text, quantity.unit, target[1], "reaction", *values))
    return made


def columns_on(found: PositionSet) -> int:
    """The most diagrams side by side on a sheet."""
    left, _, right, _ = field_on(found)
    return max(min(int((right - left) / LEAST), 3), 1)


def course_pages(found: PositionSet, motion: FollowerMotion | None) -> list[Callable[[str], Page]]:
    """The sheets of all that the scene asks for, each waiting for its number."""
    at = found.planned_places
    fine = np.linspace(at[0], at[-1], FINE + 1)
    every = asked_courses(found, at, fine)
    every += force_courses(found, at, fine)
    every += of_follower(motion, at, fine) if motion else []
    every = [each for each in every if np.isfinite(each.fine).any()]
    per = columns_on(found) * ROWS
    parts = [every[i : i + per] for i in range(0, len(every), per)]
    return [partial(course_page, found, at, fine, part) for part in parts]


def course_page(
    found: PositionSet, at: Reals, fine: Reals, some: Sequence[Asked], number: str
) -> Page:
    """A sheet of diagrams from the plans: crosses at the positions on the exact courses."""
    drawing, words = found.shown.alone, found.shown.alone.words
    left_of, top_of, right_of, foot = field_on(found)
    columns = min(columns_on(found), len(some))
    rows = ceil(len(some) / columns)
    begin = top_of + OVER
    wide, high = (right_of - left_of) / columns, (foot - begin) / rows
    marks: list[Mark] = []
    for index, each in enumerate(some):
        row, column = divmod(index, columns)
        left, top = left_of + column * wide + 16, begin + row * high + 3
        rect = left, top, left + wide - 28, top + high - 10
        marks += small_diagram(found, at, fine, each, rect)
    whole: list[Mark] = [
        *heading(found, drawing, words("sheet.courses")),
        *headline(found, words("diagrams.crosses")),
        *marks,
        *foot_line(found),
        *places_table(found, found.numbered, advantage_said(words, some)),
        *proof(found),
    ]
    title = f"{words('sheet.courses')} – {title_of(drawing)}"
    return framed(drawing, number, words("sheet.document_diagrams"), "–", whole, title)


def advantage_said(words: Words, some: Sequence[Asked]) -> list[str]:
    """The sentence on the mechanical advantage, if a sheet shows it."""
    shown = [each for each in some if each.most is not None]
    return [words("diagrams.advantage", ratio=each.symbol) for each in shown]


def small_diagram(
    found: PositionSet, at: Reals, fine: Reals, each: Asked, rect: Rect
) -> Iterator[Mark]:
    """One diagram: axes, the exact course, and the values of the plans."""
    _, top, _, low = rect
    most = each.most or calm(found, each.fine)
    axes = fitted(rect, at, each.fine, most, NUMBERED)
    zero = axes.zero
    words = found.shown.alone.words
    unit = words.unit(each.unit).replace("²", "^2").replace("³", "^3")
    yield from axis_lines(axes, each.name, f"{each.symbol}, {unit}")
    yield from numbers_along(words, axes, each.name, 1.0, 4)
    names = position_names(found, at)
    for name, u in zip(names, at, strict=True):
        x, _ = axes.on_page(axes.place(float(u), 0.0))
        yield LineMark(x, zero - 0.8, x, zero + 0.8, "dimension", f"position {name}")
        if len(names) <= MANY or int(name) % 2 == 0:
            below = not each.fine[int(np.abs(fine - u).argmin())] < 0  # away from the curve
            number = Text(
                x,
                zero + (3.2 if below else -1.4),
                name,
                "caption",
                LETTERS,
                "middle",
                f"position {name}",
            )
            yield from cleared(number)
    both = zip(fine, each.fine, strict=True)
    yield from curve(axes, [axes.place(float(u), float(v)) for u, v in both], each.kind, each.name)
    for name, u, value in zip(names, at, each.at_positions, strict=True):
        x, y = axes.on_page(axes.place(float(u), float(value)))
        if isfinite(y) and top <= y <= low:
            for way in (1, -1):
                ends = (x - CROSS, y - way * CROSS, x + CROSS, y + way * CROSS)
                yield LineMark(*ends, f"centre {each.kind}", at_position(each.name, name))
