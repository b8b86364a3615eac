"""The position of a printed sheet in a picture, found by its printed lines.

The square with the code gives a rough position. From there the printed lines are followed outwards,
ring by ring: each is searched for where the current map puts it, and the map is fitted again to all
lines found. Perspective, lens and bending are fitted together.

The crosses of a printed sheet in its picture: the offset of each from where the map puts it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

import cv2
import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.printing.personal import ARM, crosses_of
from graphkin.drawing.field import A3, SheetPaper
from graphkin.drawing.marks import LineMark, Page, Polyline, style_class
from graphkin.drawing.style import style_of
from graphkin.reading.paper_map import (
    ACROSS,
    COUNT,
    CREASED,
    CROSSED,
    LENS,
    PLAIN,
    Offsets,
    PaperMap,
    bendings,
    creasings,
    prior,
    ripple_of,
    seen_at,
    units,
)

CROSS_REACH, CROSS_SIDE, CROSS_BLUR = 1.5, 1.6, 0.16
"""The search distance for a cross, half the side of its template, and its blur, in mm."""
CROSS_ALIKE, LEAST_CROSSES = 0.7, 0.3
"""The least match of a cross with its template.

Also the least share of crosses found on a sheet printed with them: drawings cover some.
"""


def crosses_off(smooth: Any, over: PaperMap, places: Any) -> tuple[Offsets, float]:
    """Offsets of the clearly visible crosses, right and down, and the share found.

    The share is of the crosses within the picture.
    """
    near = np.arange(-CROSS_REACH - CROSS_SIDE, CROSS_REACH + CROSS_SIDE + STEP / 2, STEP)
    window = np.stack(np.meshgrid(near, near), axis=-1)
    right, down = (way[:, None, None] for way in over.ways(places))
    pixels = over(places)[:, None, None] + window[..., :1] * right + window[..., 1:] * down
    height, width = smooth.shape
    inside = (pixels > 1).all((1, 2, 3)) & (pixels < [width - 2, height - 2]).all((1, 2, 3))
    looked = np.flatnonzero(inside)
    model = cross_model()
    found, off = np.zeros(len(places), bool), np.zeros((len(places), 2))
    for i in looked:
        x, y = np.moveaxis(pixels[i].astype(np.float32), -1, 0)
        light = cv2.remap(smooth, x, y, cv2.INTER_LINEAR).astype(np.float32)
        alike = cv2.matchTemplate(light, model, cv2.TM_CCOEFF_NORMED)
        row, column = np.unravel_index(int(alike.argmax()), alike.shape)
        if alike[row, column] < CROSS_ALIKE or not 0 < row < len(alike) - 1 > column > 0:
            continue
        found[i] = True
        off[i] = (
            STEP * (column + vertex(alike[row, column - 1 : column + 2])) - CROSS_REACH,
            STEP * (row + vertex(alike[row - 1 : row + 2, column])) - CROSS_REACH,
        )
    both = np.repeat(places[found], 2, axis=0)
    ways = np.tile(np.eye(2), (int(found.sum()), 1))
    offsets = Offsets(both, ways, off[found].ravel(), np.full(len(both), CROSSED))
    return offsets, float(found.sum() / max(len(looked), 1))


def cross_model() -> Any:
    """The template of a blurred cross, as lightness around its middle."""
    near = np.arange(-CROSS_SIDE, CROSS_SIDE + STEP / 2, STEP)
    along = np.clip((ARM + CROSS_BLUR / 2 - abs(near)) / CROSS_BLUR, 0, 1)
    across = np.exp(-((near / CROSS_BLUR) ** 2) / 2)
    dark = np.maximum(np.outer(across, along), np.outer(along, across))
    return (255 * (1 - dark)).astype(np.float32)


def vertex(three: Any) -> float:
    """The vertex of a parabola through three values one step apart, from the middle one."""
    first, middle, last = (float(each) for each in three)
    return (first - last) / 2 / min(first - 2 * middle + last, -1e-9)


LINES = ("frame", "border", "panel")
"""The classes of the printed lines that are followed."""
SHARED = ("frame", "border")
"""The classes that all sheets of a student share."""
SHORTEST, SPACING, INSET = 4.5, 3.0, 0.8
"""Least length of a followed line, spacing of its measurements, margin at its ends; in mm."""
LEAST = 4
"""Measurements per tick: far from long lines, only ticks hold the map."""
RINGS = (40.0, 52.0, 68.0, 88.0, 114.0, 148.0, 180.0, 215.0, 250.0, 290.0, 335.0, 380.0, 430.0)
"""Distances from the square, in mm, to which lines are followed ring by ring."""
LENS_FROM, BENT_FROM = 80.0, 100.0
"""The rings from which lens and bending are fitted."""
REACH, NEAR = 2.0, 1.1
"""How far to both sides a line is searched for while rings grow, and at the end, in mm."""
INSIDE = 4.0
"""Distance from the frame, in mm, outside which are frame and border, 5 mm apart and alike."""
FAR, CLEARLY, LEAST_ALONG = 9.0, 1.05, 20
"""How far off a whole side is searched for, in mm, and how much better it must fit there.

LEAST_ALONG is the least number of measurements.
"""
TRUSTED, LAST = 0.4, 0.15
"""The largest offset of a line that is trusted: while rings grow, and in the last fits, in mm."""
FLATNESS, ALIKE = 0.4, 10.0
"""Lines with larger offsets than FLATNESS, in deviations, show rippled paper.

ALIKE neighbouring measurements then count as one.
"""
STEP = 0.1
"""Spacing in mm of the points of a profile across a line."""
ALONG = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
"""Offsets in mm along a line of the profiles that are averaged."""
DARK, FULL = 0.10, 0.5
"""The least share of the paper's light that a printed line absorbs.

In a blurred picture, a line narrower than FULL mm absorbs proportionally less.
"""
NOISE, CORNER = 0.05, 0.25
"""Standard deviation of a measured line, and of a corner of the square, in mm."""
BENT, STIFF = 3.0, 1.0
"""Expected size of the simplest bending, in mm: of a sheet, and of one folded in four."""
ROUNDS, NUDGE = 2, 1e-6
"""Gauss-Newton steps per fit, and the step of the finite differences."""
UNEVEN, LESS = 0.16, 0.8
"""The residual in mm from which a sheet is also read as one that was folded in four.

The folded sheet counts with less than LESS of the residual.
"""
LEAST_FOUND, WORST = 0.45, 0.5
"""The least share of lines within the picture that must be found, and their largest residual in mm.
"""
SIDES = ("left", "right", "upper", "lower")
UPPER, LOWER = 60.0, 67.0
"""The heights in mm of the upper and lower sides of a sheet."""
LEAST_SIDE, SEEN = 0.25, 0.5
"""The least share that must be found on each side of the sheet.

Where less than SEEN of one side's lines is in the picture, that side is cut off.
"""
STRETCH, LEAST_STRETCH = 100.0, 0.35
"""The least share of frame and border that must be found along each stretch of STRETCH mm.

A thumb covers less than that; a map that goes astray at a corner of the sheet loses more.
"""
LOST = 0.8
"""The share of a stretch below which the search looks farther away."""
LEAST_TICKS, FEW = 0.4, 12
"""The least share of a side's ticks that must be found, if there are at least FEW measurements.

If frame and border, or the paper's edge and one of them, were confused, the ticks are missing.
"""
BETWEEN = 5.0
"""The distance from the frame to the border, in mm."""


class PrintedLines(Struct, frozen=True):
    """Where printed lines are measured.

    ``places`` and ``normals`` are in mm, ``shared`` marks lines that all sheets have, and ``dark``
    is the least share of light that each line absorbs.
    """

    places: Any
    normals: Any
    widths: Any
    shared: Any
    dark: Any
    paper: SheetPaper = A3

    def some(self, which: Any) -> PrintedLines:
        places, normals = self.places[which], self.normals[which]
        widths, shared, dark = (each[which] for each in (self.widths, self.shared, self.dark))
        return PrintedLines(places, normals, widths, shared, dark, self.paper)

    def beside(self, others: PrintedLines) -> PrintedLines:
        """The lines without a nearby parallel line among others."""
        ours, theirs = self.places - self.paper.middle, others.places - self.paper.middle
        squares = (ours**2).sum(1)[:, None] + (theirs**2).sum(1) - 2 * ours @ theirs.T
        alike = abs(self.normals @ others.normals.T) > 0.5
        return self.some(~(alike & (squares < SPACING**2)).any(axis=1))


class Registration(Struct, frozen=True):
    """The map of a sheet, and the share of its lines found.

    ``residual`` is the 95th percentile of the offsets of frame and border, in mm. ``crossed``: the
    crosses in its fields were found; older prints have none.
    """

    map: PaperMap
    found: float
    residual: float
    own: float
    """The share found of the lines that only this sheet has."""
    refused: str = ""
    crossed: bool = False


def printed_lines(page: Page, *, faint: bool = False, paper: SheetPaper = A3) -> PrintedLines:
    """The lines of a printed page that are followed in a picture of it.

    With ``faint``, narrow lines may be paler.
    """
    rows: list[tuple[float, ...]] = []
    for x1, y1, x2, y2, cls in segments(page):
        long = float(np.hypot(x2 - x1, y2 - y1))
        if long < SHORTEST:
            continue
        count = max(LEAST, int((long - 2 * INSET) / SPACING))
        width = style_of(cls, "black").width
        way = (x2 - x1) / long, (y2 - y1) / long
        for i in range(count):
            at = INSET + (i + 0.5) * (long - 2 * INSET) / count
            x, y = x1 + at * way[0], y1 + at * way[1]
            rows.append((x, y, -way[1], way[0], width, cls.split()[0] in SHARED))
    table = np.array(rows)
    dark = DARK * np.minimum(table[:, 4] / FULL, 1.0) if faint else np.full(len(table), DARK)
    return PrintedLines(table[:, :2], table[:, 2:4], table[:, 4], table[:, 5] > 0, dark, paper)


def segments(page: Page) -> Iterator[tuple[float, float, float, float, str]]:
    """The straight printed lines of a page that are followed, with their classes."""
    for mark in page.marks:
        if style_class(mark) not in LINES or "scheme" in mark.cls:
            continue
        if isinstance(mark, LineMark):
            yield mark.x1, mark.y1, mark.x2, mark.y2, mark.cls
        elif isinstance(mark, Polyline):
            ends = (*mark.points, mark.points[0]) if mark.closed else mark.points
            for (x1, y1), (x2, y2) in pairwise(ends):
                yield x1, y1, x2, y2, mark.cls


def square_of(page: Page) -> Any:
    """The corners of the square with the code on a page, in mm; None where the page has none."""
    points = [
        point
        for mark in page.marks
        if isinstance(mark, Polyline) and mark.cls == "qr"
        for point in mark.points
    ]
    if not points:
        return None
    (left, top), (right, bottom) = np.min(points, axis=0), np.max(points, axis=0)
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])


class SheetSearch:
    """The search for the sheets of a student in a grey picture, given the square's corner pixels.

    The frame, which all sheets share, is followed only once. ``square`` replaces the code's square
    by another of the paper (mm). ``sides`` are the sides on which the frame must be visible.
    """

    def __init__(
        self,
        grey: Any,
        corners: Any,
        square: Any = None,
        sides: tuple[str, ...] = SIDES,
        paper: SheetPaper = A3,
    ) -> None:
        self.smooth = cv2.GaussianBlur(grey, (0, 0), 0.7)
        self.corners, self.square, self.sides, self.paper = corners, square, sides, paper
        self.frames: dict[tuple[bytes, float, bool, bool], PaperMap] = {}

    def registered(self, page: Page) -> Registration | None:
        """The registration of a page; None where the page has no square to begin with."""
        first = self.fitted(page, BENT_FROM)
        if first is None or not (first.refused or first.residual > UNEVEN):
            return first
        folded = self.fitted(page, BENT_FROM, creased=True)
        if folded is not None and not folded.refused:
            return folded if first.refused or folded.residual < LESS * first.residual else first
        if not first.refused:
            return first
        late = max(RINGS), False, False
        for bent, faint, creased in (late, (BENT_FROM, True, False), (BENT_FROM, True, True)):
            other = self.fitted(page, bent, faint=faint, creased=creased)
            if other is not None and not other.refused:
                return other
        return first

    def fitted(
        self, page: Page, bent: float, *, faint: bool = False, creased: bool = False
    ) -> Registration | None:
        """The registration of a page by all its lines, starting from the map of its frame."""
        over = self.frame(page, bent, faint=faint, creased=creased)
        lines = printed_lines(page, faint=faint, paper=self.paper)
        if over is None:
            return None
        crosses = np.array(crosses_of(page)).reshape(-1, 2) if creased else None
        fit = MapFit(over, self.square_of(page), self.corners, crosses)
        fit.refine(self.smooth, lines)
        last = measure(self.smooth, fit.map, lines, NEAR)
        found = judged(fit.map, last, lines, self.sides)
        if self.square is not None:  # a scanned half lies flat on the glass
            return found
        cut = side_cut_off(last, lines)
        if found.refused and cut:
            found = judged(fit.map, last, lines, tuple(side for side in SIDES if side != cut))
        if found.refused:
            return found
        whole = rippled(found, last, self.smooth, page)
        if cut and not whole.crossed:  # nothing but crosses says where the fields are there
            return judged(fit.map, last, lines, self.sides)
        return whole

    def square_of(self, page: Page) -> Any:
        """The square from which a page is followed."""
        return square_of(page) if self.square is None else self.square

    def frame(
        self, page: Page, bent: float, *, faint: bool = False, creased: bool = False
    ) -> PaperMap | None:
        """The map by the lines that all sheets share; bending is fitted from ring ``bent`` on."""
        square = self.square_of(page)
        if square is None:
            return None
        key = square.tobytes(), bent, faint, creased
        if key not in self.frames:
            lines = printed_lines(page, faint=faint, paper=self.paper)
            lines = lines.some(lines.shared)
            crosses = np.array(crosses_of(page)).reshape(-1, 2) if creased else None
            over = followed(self.smooth, lines, square, self.corners, bent, crosses)
            self.frames[key] = held_by_ticks(self.smooth, over, lines, square, self.corners)
        return self.frames[key]

    def likeness(self, page: Page, others: Iterable[Page]) -> float:
        """The share found of the lines that only this page has, less another page's largest."""
        over, ours = self.frame(page, BENT_FROM), printed_lines(page, paper=self.paper)
        if over is None:
            return -1.0
        own = self.share(over, ours.some(~ours.shared))
        theirs = (printed_lines(other, paper=self.paper) for other in others)
        foreign = (self.share(over, each.some(~each.shared).beside(ours)) for each in theirs)
        return own - max(foreign, default=0.0)

    def share(self, over: PaperMap, lines: PrintedLines) -> float:
        """The share found of some lines within the picture."""
        if len(lines.places) < LEAST_ALONG:
            return 0.0
        measured = measure(self.smooth, over, lines, REACH)
        return float((measured.found & measured.seen).sum() / max(measured.seen.sum(), 1))


def followed(
    smooth: Any, lines: PrintedLines, square: Any, corners: Any, bent: float, crosses: Any = None
) -> PaperMap:
    """The map fitted to printed lines, ring by ring; bending is fitted from ring ``bent`` on.

    With ``crosses``, their places in mm, the sheet was folded in four, and they are followed too.
    """
    height, width = smooth.shape
    first = start(width, height, square, np.asarray(corners, dtype=float), lines.paper)
    fit = MapFit(first, square, corners, crosses)
    far = np.hypot(*(lines.places - square.mean(axis=0)).T)
    for ring in RINGS:
        near = lines.some(far < ring)
        if not len(near.places):
            continue
        measured = measure(smooth, fit.map, near, REACH)
        about = sides_off(smooth, fit.map, measured)
        if about.any():  # avoid taking the frame for the border, which looks like it
            measured = measure(smooth, fit.map, near, REACH, about)
            fit.to(measured, float(abs(about).max()), lens=True, bent=True)
            measured = measure(smooth, fit.map, near, REACH)
        measured = fit.with_crosses(smooth, measured, ring)
        fit.to(measured, TRUSTED, lens=ring > LENS_FROM, bent=ring > bent)
    return fit.map


def held_by_ticks(
    smooth: Any, over: PaperMap, lines: PrintedLines, square: Any, corners: Any
) -> PaperMap:
    """A map checked by the ticks of each side.

    Where ticks are missing, frame and border may have been confused. The map is then fitted again
    with the side shifted by BETWEEN either way, and the map with the most ticks is kept.
    """
    for along, ticks in edges(lines):
        most = ticks_found(measure(smooth, over, lines, NEAR), ticks)
        if most >= LEAST_TICKS:
            continue
        for shift in (BETWEEN, -BETWEEN):
            fit = MapFit(over, square, corners)
            about = np.where(along, shift, 0.0)
            fit.to(measure(smooth, over, lines, REACH, about), BETWEEN, lens=True, bent=True)
            fit.refine(smooth, lines)
            found = ticks_found(measure(smooth, fit.map, lines, NEAR), ticks)
            if found > most:
                over, most = fit.map, found
    return over


class MeasuredLines(Struct, frozen=True):
    """The measurements of some lines.

    ``off`` is each line's offset along its normal (mm), ``found`` whether it was found,
    ``seen`` whether it is within the picture.
    """

    lines: PrintedLines
    off: Any
    found: Any
    seen: Any


def measure(
    grey: Any, over: PaperMap, lines: PrintedLines, reach: float, about: Any = 0.0
) -> MeasuredLines:
    """Measure lines on both sides of where a map puts them, plus the offset ``about`` (mm)."""
    across = np.arange(-reach - 1.0, reach + 1.0 + STEP / 2, STEP)
    dark, inside = profiles(grey, over, lines, across, about)
    off, found = np.zeros(len(dark)), np.zeros(len(dark), bool)
    for width_of in np.unique(lines.widths):
        rows = lines.widths == width_of
        off[rows], most = peaks(dark[rows], across, float(width_of), reach)
        found[rows] = most > lines.dark[rows]
    return MeasuredLines(lines, off + about, found & inside, inside)


def profiles(
    grey: Any, over: PaperMap, lines: PrintedLines, across: Any, about: Any = 0.0
) -> tuple[Any, Any]:
    """The darkness across lines, and whether the picture holds all of each profile."""
    right, down = over.ways(lines.places)
    normal = lines.normals[:, :1] * right + lines.normals[:, 1:] * down
    tangent = lines.normals[:, :1] * down - lines.normals[:, 1:] * right
    middle = over(lines.places) + np.broadcast_to(about, len(normal))[:, None] * normal
    middles = middle[:, None] + across[None, :, None] * normal[:, None]
    beside = ALONG[:, None, None] * tangent
    pixels = np.empty((2, len(ALONG), *middles.shape[:2]), np.float32)
    for k in range(2):
        np.add(middles[None, ..., k], beside[..., None, k], out=pixels[k], casting="same_kind")
    height, width = grey.shape
    spots = pixels[..., :: len(across) - 1]
    far = np.array([width - 2, height - 2])[:, None, None, None]
    inside = ((spots > 1) & (spots < far)).all((0, 1, 3))
    if not np.isfinite(pixels).all():
        pixels = np.nan_to_num(pixels)
    x, y = pixels.reshape(2, -1, len(across))
    light = cv2.remap(grey, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    profile = light.reshape(pixels.shape[1:]).mean(axis=0, dtype=np.float64)
    tenth = len(across) - 1 - len(across) // 10
    white = np.maximum(np.partition(profile, tenth, axis=1)[:, tenth], 20.0)
    return 1 - profile / white[:, None], inside


def sides_off(grey: Any, over: PaperMap, measured: MeasuredLines) -> Any:
    """The offset in mm of the lines along each side of the sheet, and along each lost stretch.

    All lines of a side or a stretch of which little was found are searched for at once, frame and
    border together. Zero where the offset is within the usual search range.
    """
    lines = measured.lines
    about = np.zeros(len(lines.places))
    every = (*(side for side, _ in edges(lines)), *stretches(lines))
    lost = [each for each in every if held_along(measured, each) < LOST]
    across = np.arange(-FAR - 1.0, FAR + 1.0 + STEP / 2, STEP)
    for side in lost:
        some = lines.some(side)
        widths = np.unique(some.widths)
        if len(widths) < 2 or min(np.sum(some.widths == w) for w in widths) < LEAST_ALONG:
            continue  # frame or border alone would be ambiguous
        dark, _ = profiles(grey, over, some, across)
        likely = np.zeros(len(across))
        for width in widths:
            found = standing(dark[some.widths == width], float(width))
            near = cv2.dilate(np.clip(found, 0, 3 * DARK), np.ones((1, round(1 / STEP))))
            likely += near.sum(axis=0)
        likely[abs(across) > FAR] = 0.0
        best = likely.argmax()
        near = likely[abs(across) < REACH].max()
        if abs(across[best]) > REACH and likely[best] > CLEARLY * near:
            about[side] = across[best]
    return about


def stretches(lines: PrintedLines) -> Iterator[Any]:
    """Which lines run along each stretch of the sheet's sides.

    Stretches overlap by half, so that any part that is off or covered fills one of them.
    """
    x, y = lines.places.T
    for (side, _), along in zip(edges(lines), (y, y, x, x), strict=True):
        for begin in np.arange(0.0, along.max(), STRETCH / 2):
            yield side & (along >= begin) & (along < begin + STRETCH)


def edges(lines: PrintedLines) -> list[tuple[Any, Any]]:
    """Which lines run along each side of the sheet, and which are its ticks, as in SIDES."""
    (x, y), (left, top, right, bottom) = lines.places.T, lines.paper.area
    left, top, right, bottom = left + INSIDE, top + INSIDE, right - INSIDE, bottom - INSIDE
    level = abs(lines.normals[:, 1]) > abs(lines.normals[:, 0])
    return [
        (lines.shared & beyond & ~across, lines.shared & beyond & across)
        for beyond, across in (
            (x < left, level),
            (x > right, level),
            (y < top, ~level),
            (y > bottom, ~level),
        )
    ]


def ticks_found(measured: MeasuredLines, ticks: Any) -> float:
    """The share found of a side's ticks within the picture; 1 where there are too few."""
    seen = measured.seen & ticks
    return float((measured.found & seen).sum() / seen.sum()) if seen.sum() >= FEW else 1.0


def standing(dark: Any, width: float) -> Any:
    """The contrast of a dark line of a given width at each place of profiles."""
    half = max(round(width / 2 / STEP), 1)
    core, flank = 2 * half + 1, 4
    kernel = np.zeros(core + 2 * (flank + 2))
    kernel[flank + 2 : flank + 2 + core] = 1 / core
    kernel[:flank] = kernel[-flank:] = -0.5 / flank
    return cv2.filter2D(dark, -1, kernel[None, :], borderType=cv2.BORDER_REPLICATE)


def peaks(dark: Any, across: Any, width: float, reach: float) -> tuple[Any, Any]:
    """The position and contrast of the darkest line in each profile; contrast 0 at the ends."""
    half = max(round(width / 2 / STEP), 1)
    contrast = standing(dark, width)
    contrast[:, abs(across) > reach + STEP / 2] = -1.0
    best = contrast.argmax(axis=1)
    rows = np.arange(len(dark))
    window = np.clip(best[:, None] + np.arange(-half - 4, half + 5), 0, len(across) - 1)
    part = dark[rows[:, None], window]
    base = np.minimum(part[:, :2].mean(1), part[:, -2:].mean(1))
    weight = np.clip(part - base[:, None] - 0.15 * part.max(1, keepdims=True), 0, None)
    total = weight.sum(axis=1)
    centre = (weight * across[window]).sum(axis=1) / np.maximum(total, 1e-9)
    edge = abs(across[best]) > reach - STEP / 2
    return centre, np.where((total > 0) & ~edge, contrast[rows, best], 0.0)


class MapFit:
    """A map that is fitted repeatedly to measurements made with it."""

    def __init__(self, over: PaperMap, square: Any, corners: Any, crosses: Any = None) -> None:
        self.crosses = crosses
        self.most = CREASED if crosses is None else COUNT
        self.width, self.height, self.parameters = over.width, over.height, over.array.copy()
        self.square, self.corners = square, np.asarray(corners, dtype=float)
        self.paper = over.paper
        self.expected = prior(BENT if crosses is None else STIFF, self.paper.half)
        self.expected[:6] = np.inf

    @property
    def map(self) -> PaperMap:
        return PaperMap(self.width, self.height, tuple(self.parameters.tolist()), paper=self.paper)

    def refine(self, smooth: Any, lines: PrintedLines) -> None:
        """Fit the map to lines near where it puts them, in ever narrower searches."""
        for reach, trusted in ((REACH, TRUSTED), (NEAR, TRUSTED), (NEAR, LAST), (NEAR, LAST)):
            measured = self.with_crosses(smooth, measure(smooth, self.map, lines, reach))
            self.to(measured, trusted, lens=True, bent=True)

    def with_crosses(
        self, smooth: Any, measured: MeasuredLines, ring: float = np.inf
    ) -> MeasuredLines:
        """Measurements with those of the crosses of a folded sheet, up to a distance in mm."""
        if self.crosses is None:
            return measured
        near = np.hypot(*(self.crosses - self.square.mean(axis=0)).T) < ring
        offs, _ = crosses_off(smooth, self.map, self.crosses[near])
        more, lines = np.zeros(len(offs.off)), measured.lines
        every = replace(
            lines,
            places=np.concatenate([lines.places, offs.places]),
            normals=np.concatenate([lines.normals, offs.ways]),
            widths=np.concatenate([lines.widths, more]),
            shared=np.concatenate([lines.shared, more]),
            dark=np.concatenate([lines.dark, more]),
        )
        off = np.concatenate([measured.off, offs.off])
        found, seen = (np.concatenate([own, more == 0]) for own in (measured.found, measured.seen))
        return MeasuredLines(every, off, found, seen)

    def to(self, measured: MeasuredLines, trusted: float, *, lens: bool, bent: bool) -> None:
        """Fit the map to measurements made with it, by robust least squares."""
        known = measured.found
        lines = measured.lines.some(known)
        there = lines.places + measured.off[known, None] * lines.normals
        pixels = self.map(there)
        right, down = self.map.ways(there)
        way = lines.normals[:, :1] * down - lines.normals[:, 1:] * right
        scale = np.hypot(*way.T)
        normal = np.stack([-way[:, 1], way[:, 0]], axis=1) / scale[:, None]
        places = np.concatenate([lines.places, self.square])
        (u, v), flat = units(places, self.paper), self.paper.middle[1] / self.paper.half
        bends = bendings(u, v, flat)
        if self.most == COUNT:
            bends = np.concatenate([bends, creasings(u, v, flat)], axis=-1)
        kinds = bends.shape[-1]
        rows = np.concatenate([bends[: len(pixels)], np.repeat(bends[len(pixels) :], 2, axis=0)])
        size = self.map.scale(self.square.mean(axis=0))
        count = self.most if bent else PLAIN if lens else LENS

        def errors(found: Any) -> Any:
            by_lines = (found[: len(pixels)] * normal).sum(1) / scale / NOISE
            return np.concatenate([by_lines, found[len(pixels) :].ravel() / size / CORNER])

        def pixels_with(parameters: Any, across: Any, along: Any) -> Any:
            return seen_at(parameters, across, along, self.width, self.height)

        goal = errors(np.concatenate([pixels, self.corners]))
        for _ in range(ROUNDS):
            shift = bends @ self.parameters[PLAIN : self.most].reshape(kinds, 2)
            at = u + shift[:, 0], v + shift[:, 1]
            seen = pixels_with(self.parameters, *at)
            here = errors(seen)
            columns = []
            for number in range(min(count, PLAIN)):
                nudged = self.parameters.copy()
                nudged[number] += NUDGE
                columns.append((errors(pixels_with(nudged, *at)) - here) / NUDGE)
            if bent:
                across = (pixels_with(self.parameters, at[0] + NUDGE, at[1]) - seen) / NUDGE
                along = (pixels_with(self.parameters, at[0], at[1] + NUDGE) - seen) / NUDGE
                both = np.stack([errors(across), errors(along)], axis=1)
                columns.append((rows[:, :, None] * both[:, None]).reshape(len(rows), -1))
            off, jacobian = here - goal, np.column_stack(columns)
            spread = max(1.5 * float(np.median(abs(off))), trusted / NOISE / 3)
            weights = np.ones(len(off))
            weights[: len(pixels)] = 1 / (1 + (off[: len(pixels)] / (3 * spread)) ** 2) ** 2
            weighted = jacobian * weights[:, None]
            rippled = 1.4826 * float(np.median(abs(off[: len(pixels)]))) if len(pixels) else 0
            held = max(1.0, ALIKE * ((rippled / FLATNESS) ** 2 - 1)) / self.expected[:count] ** 2
            normal_matrix = weighted.T @ jacobian + np.diag(held)
            pull = -weighted.T @ off - held * self.parameters[:count]
            self.parameters[:count] += np.linalg.solve(normal_matrix, pull)


def start(width: int, height: int, square: Any, corners: Any, paper: SheetPaper) -> PaperMap:
    """The plain affine map that takes the square's corners to given pixels."""
    half = np.hypot(width, height) / 2
    goal = (corners - [(width - 1) / 2, (height - 1) / 2]) / half
    places = np.stack(units(square, paper), axis=-1)
    rows = np.concatenate([places, np.ones((4, 1))], axis=1)
    across, *_ = np.linalg.lstsq(rows, goal, rcond=None)
    found = np.zeros(COUNT)
    found[:3], found[3:6] = across[:, 0], across[:, 1]
    return PaperMap(width, height, tuple(found.tolist()), paper=paper)


def rippled(found: Registration, last: MeasuredLines, smooth: Any, page: Page) -> Registration:
    """The registration with ripples measured by the lines, and by the crosses if found."""
    over = found.map
    crosses, share = crosses_off(smooth, over, np.array(crosses_of(page)).reshape(-1, 2))
    there = share >= LEAST_CROSSES
    # crosses measure the fields better than lines of tables, which letters stand close to
    known = last.found & last.lines.shared if there else last.found
    lines = last.lines.some(known)
    across = Offsets(lines.places, lines.normals, last.off[known], np.full(known.sum(), ACROSS))
    ripple = ripple_of(across, crosses if there else crosses.some(slice(0)), over.paper)
    rippled_map = PaperMap(over.width, over.height, over.parameters, ripple, over.paper)
    return replace(found, map=rippled_map, crossed=there)


def judged(
    over: PaperMap, last: MeasuredLines, lines: PrintedLines, wanted: tuple[str, ...]
) -> Registration:
    """A map with its quality, and a reason for refusal where lines are missing or off."""
    seen, found = last.seen, last.found
    share = float(found.sum() / max(seen.sum(), 1))
    off = abs(last.off[found & lines.shared])  # letters stand close to the lines of tables
    residual = float(np.percentile(off, 95)) if len(off) else float("inf")
    own = seen & ~lines.shared
    own_share = float((found & own).sum() / max(own.sum(), 1))
    refused = ""
    parts = parts_of(lines)
    held = {side: float((found & parts[side]).sum() / parts[side].sum()) for side in wanted}
    side = min(held, key=lambda each: held[each])
    stretch = least_stretch(last, lines)
    ticks = [ticks_found(last, some) for _, some in edges(lines)]
    worst_side = SIDES[int(np.argmin(ticks))]
    if held[side] < LEAST_SIDE:
        refused = f"too little of the frame is seen on the {side} side of the sheet"
    elif share < LEAST_FOUND:
        refused = f"only {share:.0%} of the printed lines are found: too blurred, dark or covered"
    elif stretch < LEAST_STRETCH:
        refused = (
            f"only {stretch:.0%} of the frame is found along a part of it: covered, or rippled"
        )
    elif min(ticks) < LEAST_TICKS:
        refused = f"the frame cannot be told from the border on the {worst_side} side of the sheet"
    elif residual > WORST:
        refused = f"the paper lies too unevenly: printed lines are {residual:.1f} mm off"
    return Registration(over, share, residual, own_share, refused)


def parts_of(lines: PrintedLines) -> dict[str, Any]:
    """Which lines are on each side of the sheet."""
    (x, y), paper = lines.places.T, lines.paper
    half, low = paper.half, paper.height - LOWER
    return dict(zip(SIDES, (x < half, x >= half, y < UPPER, y > low), strict=True))


def side_cut_off(last: MeasuredLines, lines: PrintedLines) -> str:
    """The only side of the sheet whose lines are mostly outside the picture; "" without one."""
    cut = [side for side, some in parts_of(lines).items() if last.seen[some].mean() < SEEN]
    return cut[0] if len(cut) == 1 else ""


def least_stretch(last: MeasuredLines, lines: PrintedLines) -> float:
    """The smallest share of frame and border found along a stretch of the sheet's edge."""
    return min((held_along(last, stretch) for stretch in stretches(lines)), default=1.0)


def held_along(measured: MeasuredLines, stretch: Any) -> float:
    """The share found of a stretch within the picture; 1 where too little of it is visible."""
    seen = measured.seen & stretch
    return float(measured.found[seen].mean()) if seen.sum() >= LEAST_ALONG else 1.0
