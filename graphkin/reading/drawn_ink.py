"""The hand-drawn ink on a sheet: dark thin lines in its fields, in mm of paper."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import cv2
import numpy as np
from msgspec import Struct

from graphkin.drawing.field import A3, Rect, SheetPaper
from graphkin.drawing.marks import LineMark, Mark, Page, Polyline, Text, reach
from graphkin.drawing.style import style_of
from graphkin.reading.paper_map import PaperMap

DENSITY = 6.0
"""Pixels per mm of the flattened picture."""
OPEN = 4.0
"""Dark places broader than this, in mm, are shadow, not ink."""
FINE, COARSE = 0.12, 0.5
"""Blur radii of a line and of the paper around it, in mm: ink is darker than its surroundings."""
LINES = 98.0
"""The percentile of darkness that counts as a usual line."""
FAINT = 0.012
"""The least share of light that a usual line absorbs; anything less is paper grain."""
MASK = 0.35
"""Margin in mm around printed ink that is ignored."""
STEP = 0.12
"""Spacing in mm of the samples across a line."""
ROWS = 100
"""A line is looked for in about so many rows across it; all rows then say where it is."""
STRAYS = 0.3
"""A fitted line may leave its search window by this many mm; beyond that it is another line."""
ENDS = 1.6
"""Millimetres at both ends of a line that are ignored: arrowheads, circles, letters."""
LEAST_ERROR = 0.1
"""Least standard deviation across a line, in mm: a hand-drawn line is not quite straight."""
SEEN = 0.4
"""The least share of a line clear of printed ink for it to count as evidence."""
BOW = 5.0
"""Half the length of the examined part of a compass arc, in mm."""
ARRIVES = 0.35
"""Allowance for the last piece of a line, which letters, arrowheads and pale ends thin out."""
PAPER = 0.08
"""Least standard deviation of a read place, from the paper map, in mm."""
COVERED = 0.3
"""The darkness, relative to a usual line, from which a place counts as drawn."""

RUN, RUNS, GAP, PITCH = 6.0, 0.8, 1.4, 0.2
"""Where a line ends: after RUN mm of which the share RUNS is drawn, GAP mm are empty.

PITCH is the sampling interval in mm.
"""
SPECKS = 0.3
"""The share of a gap that may still be dark, because of a nearby letter or paper grain."""
MARKS = np.arange(0.45, 2.6, 0.15)
"""Radii in mm of the dots, rings and crosses that mark a point; the last ones lie outside a mark.
"""
OFF_LINE = 0.5
"""A mark whose centre is farther than this from a line, in mm, is not a point on the line."""
ASIDE = np.arange(0.3, 0.5, 0.05)
"""Distances in mm from a printed line at which strokes drawn over it are visible."""
BEYOND, MARKED, ALIKE = 6, 0.7, 0.1
"""How many radii farther out paper must appear again; the least share of a mark that is drawn.

Places that differ by less than the share ALIKE are marked alike.
"""
ASLANT, MOST_NODES = 12.0, 6
"""The least angle in degrees at which another line leaves a line; the most such places kept."""


class InkLine(Struct, frozen=True):
    """A straight line that was found, between two places (complex mm, y down).

    ``cover`` is the share of it that is drawn.
    """

    start: complex
    end: complex
    cover: float
    error: float
    """Standard deviation across the line, in mm."""

    @property
    def way(self) -> complex:
        """The unit direction."""
        return (self.end - self.start) / abs(self.end - self.start)

    def off(self, place: complex) -> float:
        """The signed distance of a place from the line, in mm."""
        return float(((place - self.start) * self.way.conjugate()).imag)


class InkStroke(Struct, frozen=True):
    """A line that arrives at a place: its end beyond the place, in mm; None if it goes on."""

    end: float | None


class DrawnInk(Struct, frozen=True):
    """The drawn lines of a sheet's fields: ``dark`` is 1 on a usual line and 0 on paper.

    ``known`` is 0 where printed ink hides what was drawn.
    """

    dark: Any
    known: Any
    sway: float = 0.0
    """The extra standard deviation of places, in mm, compared with flat paper."""
    paper: SheetPaper = A3

    def at(self, places: Any) -> tuple[Any, Any]:
        """Darkness at some places (complex mm), and whether it is known there."""
        left, top, *_ = self.paper.fields
        x = ((places.real - left) * DENSITY - 0.5).astype(np.float32)
        y = ((places.imag - top) * DENSITY - 0.5).astype(np.float32)
        shape = x.shape
        x, y = x.reshape(-1, shape[-1]), y.reshape(-1, shape[-1])
        dark = cv2.remap(self.dark, x, y, cv2.INTER_LINEAR, borderValue=0)
        known = cv2.remap(self.known, x, y, cv2.INTER_NEAREST, borderValue=0)
        return dark.reshape(shape), known.reshape(shape)

    def lines(
        self, start: complex, end: complex, beside: float, beyond: float, most: int = 3
    ) -> list[InkLine]:
        """Lines from near one place to near another.

        They pass within ``beside`` mm of the start and ``beyond`` mm of the end. At most ``most``
        lines.
        """
        long = abs(end - start)
        if not np.isfinite(long):
            return []
        inset = min(ENDS, 0.2 * long)
        count = int((long - 2 * inset) * 3)
        if count < 6:
            return []
        way = (end - start) / long
        along = np.linspace(inset, long - inset, count)
        across = offsets(max(beside, beyond))
        strip, known = self.at(start + way * (along[:, None] + 1j * across[None, :]))
        return [
            InkLine(start + 1j * way * near, end + 1j * way * distant, cover, error)
            for near, distant, cover, error in fitted(
                strip, known, across, along / long, (beside, beyond), most
            )
        ]

    def arcs(self, centre: complex, radius: float, place: complex, beside: float) -> list[InkLine]:
        """Compass arcs about a centre near a place, each as its tangent line there."""
        if not abs(place - centre) > BOW or not np.isfinite(radius):
            return []
        out = (place - centre) / abs(place - centre)
        along = np.linspace(-BOW, BOW, int(6 * BOW))
        across = offsets(beside)
        turned = out * np.exp(1j * along / radius)
        shift = abs(place - centre) - radius
        strip, known = self.at(centre + turned[:, None] * (radius + shift + across[None, :]))
        found = fitted(strip, known, across, (along + BOW) / (2 * BOW), (beside, beside), 3)
        lines = []
        for near, distant, cover, error in found:
            if abs(near - distant) < 0.12 * BOW:
                ends = (place + near * out - 1j * BOW * out, place + distant * out + 1j * BOW * out)
                lines.append(InkLine(*ends, cover, error))
        return lines

    def stroke(self, place: complex, way: complex, reach: float) -> InkStroke | None:
        """How a line along a direction continues near a place; None if it does not reach it."""
        along = np.arange(-reach - RUN, reach + GAP + PITCH, PITCH)
        across = np.arange(-0.3, 0.31, 0.15)
        dark, known = self.at(place + way * (along[:, None] + 1j * across[None, :]))
        drawn = (dark.max(axis=1) > COVERED) | (known[:, len(across) // 2] == 0)
        before, beyond = round(RUN / PITCH), round(GAP / PITCH)
        for i in range(before, len(along) - beyond):
            if drawn[i : i + beyond].mean() <= SPECKS:
                if drawn[i - before : i].mean() < RUNS:
                    return None
                return InkStroke(float(along[i - 1]))
        middle = round((reach + RUN) / PITCH)
        near = drawn[middle - before : middle + before]
        return InkStroke(None) if near.mean() >= RUNS else None

    def spot(self, places: Any, way: complex | None) -> complex | None:
        """The place, among those given, where a dot, ring or small cross marks a point.

        None where there is no mark.
        """
        marked = self.marked(places, way)
        best = int(marked.argmax())
        if marked[best] < MARKED:
            return None
        near = marked > marked[best] - ALIKE
        near &= abs(places - places[best]) < MARKS[-1] / 2
        return complex(places[near].mean())

    def marked(self, places: Any, way: complex | None) -> Any:
        """How much of a dot, a ring or a small cross is drawn about each place, from 0 to 1.

        A line through the places in direction ``way`` is not taken for a mark.
        """
        turns = np.exp(1j * np.radians(np.arange(0.0, 360.0, 15.0)))
        if way is not None:
            turns = turns[abs((turns / way).imag) > 0.5]
        rings = places[:, None, None] + MARKS[:, None] * turns
        dark, known = self.at(rings.reshape(len(places), -1))
        seen = (known > 0).reshape(rings.shape)
        drawn = (dark > COVERED).reshape(rings.shape) & seen
        full = drawn.sum(axis=2) / np.maximum(seen.sum(axis=2), 1) * (seen.mean(axis=2) > SEEN)
        round_it = (full[:, :-BEYOND] - full[:, BEYOND:]).max(axis=1)
        half = turns.size // 2
        inner = seen[:, :BEYOND]  # print may hide the middle of a cross
        arms = drawn[:, :BEYOND].sum(axis=1) / np.maximum(inner.sum(axis=1), 1)
        arms = arms * (inner.mean(axis=1) > SEEN) - drawn[:, -2:].mean(axis=1)
        across = np.minimum(arms[:, :half], arms[:, half:]).max(axis=1)
        return np.maximum(round_it, across)

    def is_marked_beside(self, place: complex, way: complex) -> bool:
        """Whether the mark seen at a place of a line is next to the line, not on it.

        The arms of a cross on the line are themselves marks beside it, and no better ones.
        """
        near = np.arange(-MARKS[-1] / 2, MARKS[-1] / 2 + PITCH / 2, PITCH)
        beside = near[:, None] + 1j * near[None, :]
        marked = self.marked((place + way * beside).ravel(), way)
        on_it = (abs(beside.imag) <= OFF_LINE).ravel()
        off = float(marked[~on_it].max())
        return off >= MARKED and off > float(marked[on_it].max()) + ALIKE

    def on_print(self, place: complex, way: complex, reach: float) -> float | None:
        """The position along a printed line, in mm from a place on it, of something drawn over it.

        That is the middle of a dot, ring or crossing stroke, or an end of a line drawn over the
        printed one. Both sides of the printed line are examined. None where nothing is found within
        ``reach``.
        """
        along = np.arange(-reach - RUN, reach + RUN + PITCH, PITCH)
        dark, _ = self.at(place + way * (along[:, None] + 1j * np.concatenate([-ASIDE, ASIDE])))
        sides = np.stack([dark[:, : len(ASIDE)].mean(axis=1), dark[:, len(ASIDE) :].mean(axis=1)])
        print_of = np.median(sides, axis=1)
        print_of = np.minimum(print_of, print_of.min() + COVERED)  # a vector may lie on one side
        drawn = (sides - print_of[:, None]).min(axis=0) > COVERED
        edges = np.flatnonzero(np.diff(np.concatenate([[0], drawn.astype(int), [0]])))
        found = []
        for first, last in edges.reshape(-1, 2):
            begin, end = float(along[first]), float(along[last - 1])
            if end - begin < MARKS[-1]:
                found.append((begin + end) / 2)
            elif last < len(along):
                found.append(end - ASIDE[-1])
            elif first > 0:
                found.append(begin + ASIDE[-1])
        near = [each for each in found if abs(each) <= reach]
        return min(near, key=abs) if near else None

    def node(self, place: complex, way: complex, reach: float) -> float | None:
        """The position along a line, in mm from a place on it, where the most other lines leave it.

        None where no line leaves.
        """
        along = np.arange(-reach, reach + PITCH, PITCH)
        leaving, rays = self.leaving(place + along * way, way, 3.0)
        strength = np.minimum(leaving.sum(axis=1) / 2, 3.0) - abs(along) / reach
        best = int(strength.argmax())
        if leaving[best].max() < RUNS:
            return None
        base, ray = place + float(along[best]) * way, complex(rays[int(leaving[best].argmax())])
        found = self.lines(base, base + (RUN + ENDS) * ray, 0.8, 0.8, most=1)
        if not found:
            return None
        other = found[0]
        back = other.off(base) / (way * other.way.conjugate()).imag
        return float(along[best]) - back if abs(back) < GAP else None

    def nodes(self, start: complex, way: complex, long: float) -> list[complex]:
        """The places along a line where other lines leave it, the strongest first."""
        along = np.arange(RUN, long, 3 * PITCH)
        leaving, _ = self.leaving(start + along * way, way, 6.0)
        strength = np.where(leaving.max(axis=1) >= RUNS, leaving.sum(axis=1), 0.0)
        found: list[float] = []
        for i in np.argsort(-strength):
            if strength[i] <= 0 or len(found) >= MOST_NODES:
                break
            if all(abs(along[i] - other) > 2 * GAP for other in found):
                found.append(float(along[i]))
        return [start + each * way for each in found]

    def leaving(self, places: Any, way: complex, turn: float) -> tuple[Any, Any]:
        """How surely lines leave a line at each place, by direction; also those unit directions."""
        turns = np.radians(np.arange(ASLANT, 360 - ASLANT, turn))
        rays = way * np.exp(1j * turns[abs(turns - np.pi) > np.radians(ASLANT)])
        radii = np.arange(ENDS, RUN + ENDS, 1.5 * PITCH)
        dark, known = self.at(places[:, None, None] + rays[:, None] * radii)
        drawn = ((dark > COVERED) | (known == 0)).mean(axis=2) * (known.mean(axis=2) > SEEN)
        return np.clip(drawn - RUNS, 0, None) / (1 - RUNS), rays

    def cover(
        self,
        start: complex,
        end: complex,
        beside: float = 0.3,
        hidden: float = 0.0,
        *,
        arrives: bool = False,
    ) -> float:
        """The drawn share of the straight line between two places, within ``beside`` mm of it.

        ``hidden`` is returned for a line most of which is under printed ink. With ``arrives``, the
        share cannot exceed that of the last piece by more than ARRIVES, so that a line that stops
        short counts less.
        """
        long = abs(end - start)
        if not long >= 2.5 * ENDS:  # also NaN, where an end is unknown
            return 0.0
        way = (end - start) / long
        along = np.linspace(ENDS, long - ENDS, max(8, int(long * 2)))
        across = np.arange(-beside, beside + 0.05, 0.15)
        dark, known = self.at(start + way * (along[:, None] + 1j * across[None, :]))
        drawn = dark.max(axis=1) > COVERED
        whole = known[:, len(across) // 2] > 0
        if whole.mean() < SEEN:
            return hidden
        found = float((drawn & whole).sum() / max(whole.sum(), 1))
        last = whole & (along > long - ENDS - RUN)
        if arrives and last.any():
            found = min(found, float((drawn & last).sum() / last.sum()) + ARRIVES)
        return found


def offsets(far: float) -> Any:
    """Sample distances across a line, to ``far`` mm on both sides."""
    half = int(far / STEP) + 2
    return np.arange(-half, half + 1) * STEP


Fitted = tuple[float, float, float, float]
"""Offsets of a line at both ends (mm), the share of it that is drawn, its deviation (mm)."""


def fitted(
    strip: Any, known: Any, across: Any, part: Any, windows: tuple[float, float], most: int
) -> list[Fitted]:
    """The lines along a strip that pass within windows at both ends, the best first.

    ``part`` is the position of each row, from 0 at one end to 1 at the other.
    """
    strip = np.clip(strip, 0, 1) * known
    middle, count = len(across) // 2, len(part)
    first, last = (np.arange(-round(w / STEP), round(w / STEP) + 1) for w in windows)
    seen = known[:, middle].sum()
    if seen < max(5, 0.3 * count):
        return []
    some = np.arange(0, count, max(1, count // ROWS))
    place = first[:, None, None] * (1 - part[some]) + last[None, :, None] * part[some]
    where = middle + np.rint(place).astype(np.int32)
    score = strip[some, where].sum(axis=2) / max(known[some, middle].sum(), 1)
    found: list[Fitted] = []
    for _ in range(most):
        i, j = np.unravel_index(score.argmax(), score.shape)
        if score[i, j] < 0.3:
            break
        line = refined(strip, known, across, part, float(first[i]) * STEP, float(last[j]) * STEP)
        if line is not None and all(
            abs(off) < window + STRAYS for off, window in zip(line, windows, strict=False)
        ):
            found.append(line)
        score[max(0, i - 3) : i + 4, max(0, j - 3) : j + 4] = 0
    return found


def refined(
    strip: Any, known: Any, across: Any, part: Any, near: float, distant: float
) -> Fitted | None:
    """The refined line of a strip, fitted by robust least squares; None with fewer than 5 rows."""
    for width in (0.5, 0.35):
        centre = near * (1 - part) + distant * part
        weight = strip * (abs(across[None, :] - centre[:, None]) < width)
        total = weight.sum(axis=1)
        there = (strip * (abs(across[None, :] - centre[:, None]) < 0.3)).max(axis=1) > COVERED
        use = (total > 0.2) & there
        if use.sum() < 5:
            return None
        spots = (weight * across).sum(axis=1)[use] / total[use]
        along, trust = part[use], np.ones(len(spots))
        for _ in range(3):
            near, distant = line_through(along, spots, trust**2)
            off = abs(spots - near - (distant - near) * along)
            usual = float(np.partition(off, len(off) // 2)[len(off) // 2])
            trust = 1 / (1 + (off / max(usual * 2, 0.05)) ** 2)
    whole = known[:, len(across) // 2] > 0
    cover = float((there & whole).sum() / max(whole.sum(), 1))
    return near, distant, cover, max(LEAST_ERROR, 1.5 * usual)


def line_through(along: Any, spots: Any, weights: Any) -> tuple[float, float]:
    """The weighted least-squares line through spots, by its values at 0 and at 1."""
    total = float(weights.sum())
    middle, height = float(weights @ along) / total, float(weights @ spots) / total
    off = along - middle
    slope = float((weights * off) @ spots) / max(float((weights * off) @ off), 1e-12)
    return height - slope * middle, height + slope * (1 - middle)


def drawn_ink(grey: Any, over: PaperMap, page: Page) -> DrawnInk:
    """The drawn lines in the fields of a photographed sheet."""
    fields = over.paper.fields
    flat = flattened(grey, over, fields, DENSITY)
    known = 1 - printed_mask(page, flat.shape, fields)
    known[~seen_in(grey.shape, over)] = 0
    deviation = 0.0 if over.ripple is None else over.ripple.deviation
    sway = float(np.sqrt(max(deviation**2 - PAPER**2, 0.0)))
    return DrawnInk(lines_of(flat, known), known.astype(np.float32), sway, over.paper)


def lines_of(flat: Any, known: Any) -> Any:
    """The darkness of lines in a flattened picture, 1 on a usual one, from what is ``known``."""
    flat = flat.astype(np.float32)
    small = cv2.resize(flat, None, fx=1 / 3, fy=1 / 3, interpolation=cv2.INTER_AREA)
    side = 2 * round(OPEN * DENSITY / 3 / 2) + 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
    paper = cv2.GaussianBlur(cv2.morphologyEx(small, cv2.MORPH_CLOSE, kernel), (0, 0), 4)
    paper = cv2.resize(paper, (flat.shape[1], flat.shape[0]), interpolation=cv2.INTER_LINEAR)
    dark = 1 - flat / np.maximum(paper, 8)
    lines = cv2.GaussianBlur(dark, (0, 0), FINE * DENSITY)
    lines -= cv2.GaussianBlur(dark, (0, 0), COARSE * DENSITY)
    usual = max(float(np.percentile(lines[known > 0], LINES)), FAINT)
    return np.clip(lines / usual, 0, 1.5).astype(np.float32)


def seen_in(shape: tuple[int, ...], over: PaperMap) -> Any:
    """Which pixels of the flattened fields are within a picture."""
    left, top, right, bottom = over.paper.fields
    inside = np.zeros(shape[:2], np.uint8)
    inside[1:-1, 1:-1] = 1
    edges = [
        (x, y)
        for x in np.linspace(left, right, 9)
        for y in np.linspace(top, bottom, 9)
        if x in (left, right) or y in (top, bottom)
    ]
    pixels = np.rint(over(np.array(edges))).astype(int)
    if ((pixels > 1) & (pixels < np.array(shape[1::-1]) - 2)).all():
        size = round((bottom - top) * DENSITY), round((right - left) * DENSITY)
        return np.ones(size, bool)
    return flattened(inside, over, over.paper.fields, DENSITY) > 0


def flattened(picture: Any, over: PaperMap, rect: Any, density: float) -> Any:
    """A part of the sheet as seen flat from above, at ``density`` pixels per mm."""
    left, top, right, bottom = rect
    width, height = round((right - left) * density), round((bottom - top) * density)
    coarse = 8
    xs = left + (np.arange(-1, width // coarse + 3) * coarse + 0.5) / density
    ys = top + (np.arange(-1, height // coarse + 3) * coarse + 0.5) / density
    pixels = over(np.stack(np.meshgrid(xs, ys), axis=-1)).astype(np.float32)
    finer = np.array([[1 / coarse, 0, 1], [0, 1 / coarse, 1]])
    how = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    x, y = cv2.split(cv2.warpAffine(pixels, finer, (width, height), flags=how))
    return cv2.remap(picture, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def printed_mask(page: Page, shape: Any, fields: Rect) -> Any:
    """A mask of the fields: 1 on a page's own ink and a margin around it."""
    mask = np.zeros(shape, np.uint8)
    for mark in page.marks:
        for outline, width in outlines(mark, fields):
            points = (np.array(outline) - fields[:2]) * DENSITY - 0.5
            fixed = np.round(points * 16).astype(np.int32)
            thick = max(1, round((width + 2 * MASK) * DENSITY))
            if isinstance(mark, Text):
                cv2.fillPoly(mask, [fixed], 1, shift=4)
            else:
                cv2.polylines(mask, [fixed], False, 1, thick, shift=4)
    return mask


def outlines(mark: Mark, fields: Rect) -> Iterator[tuple[list[tuple[float, float]], float]]:
    """The outline of a printed mark in the fields and its line width; a text gives its box."""
    left, top, right, bottom = reach(mark)
    if right < fields[0] or left > fields[2] or bottom < fields[1] or top > fields[3]:
        return
    width = style_of(mark.cls, "black").width
    if isinstance(mark, Text):
        yield list(mark.corners()), 0.0
    elif isinstance(mark, Polyline):
        yield [*mark.points, mark.points[0]], width
    elif isinstance(mark, LineMark):
        yield [(mark.x1, mark.y1), (mark.x2, mark.y2)], width
    else:
        turns = np.linspace(0, 2 * np.pi, 24)
        ring = np.stack([mark.cx + mark.r * np.cos(turns), mark.cy + mark.r * np.sin(turns)], 1)
        yield [(float(x), float(y)) for x, y in ring], width
