"""Two A4 scans of the halves of one A3 sheet, or two A4 leaves, joined into one picture.

The frame is the same on all sheets. The search looks for the upper corner of each half, in all four
rotations and at the density of a scanner, then follows the frame's lines from there. The code is
read from the joined picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import cv2
import numpy as np
from msgspec.structs import replace

from graphkin.drawing.field import A3, SheetPaper
from graphkin.drawing.marks import Page, style_class
from graphkin.drawing.style import style_of
from graphkin.reading.drawn_ink import flattened
from graphkin.reading.paper_map import PaperMap
from graphkin.reading.pictures import Unreadable, darkest
from graphkin.reading.registration import BENT_FROM, SHARED, SIDES, SheetSearch, segments

CUT, HIGH = A3.half, A3.height
"""Where the sheet is divided, and its height, in mm."""
DENSITY = 9.0
"""Pixels per mm of the joined sheet."""
CORNERS = {"left": (8.0, 4.0, 68.0, 64.0), "right": (352.0, 4.0, 412.0, 64.0)}
"""The corner searched for in each half, in mm."""
COARSE, ROOM = 3.0, 30.0
"""Pixels per mm in the corner search, and how far a half may be from its place on the glass, in mm.
"""
SCANNERS = (100, 150, 200, 240, 300, 400, 600)
"""Scanner resolutions, in pixels per inch."""
WHOLE = A3.whole


def put_together(left: Any, right: Any, page: Page) -> Any:
    """The sheet joined from the pictures of its halves; grey where one of them is grey.

    ``page`` gives the frame. Raises Unreadable where a half is not found.
    """
    frame = replace(page, marks=[m for m in page.marks if style_class(m) in SHARED])
    if left.ndim != right.ndim:
        left, right = darkest(left), darkest(right)
    first = half_found(darkest(left), frame, "left")
    second = half_found(darkest(right), frame, "right")
    ours, cut = seen(first, left), round(CUT * DENSITY)
    ours[:, cut:] &= ~seen(second, right)[:, cut:]
    parts = (
        flattened(half, over, WHOLE, DENSITY) for half, over in ((left, first), (right, second))
    )
    return np.where(ours if left.ndim == 2 else ours[..., None], *parts)


def laid_together(
    pictures: Sequence[Any],
    corners: Sequence[Any],
    leaves: Sequence[Sequence[Page]],
    paper: SheetPaper,
) -> Any:
    """The sheet of two A4 leaves joined from their pictures, each with the corners of its square.

    ``leaves`` are the pages of each sheet of a student. Raises Unreadable where a leaf is not
    found.
    """
    if pictures[0].ndim != pictures[1].ndim:
        pictures = [darkest(each) for each in pictures]
    parts = [
        flattened(
            picture, leaf_found(darkest(picture), corner, pages, paper), paper.leaf.whole, DENSITY
        )
        for picture, corner, pages in zip(pictures, corners, zip(*leaves, strict=True), strict=True)
    ]
    return np.hstack(parts)


def leaf_found(grey: Any, corners: Any, pages: Sequence[Page], paper: SheetPaper) -> PaperMap:
    """The map of one leaf in its picture: that of the page most of whose own lines are found."""
    search = SheetSearch(grey, corners, paper=paper.leaf)
    every = [found for page in pages if (found := search.registered(page)) is not None]
    best = max(every, key=lambda found: (not found.refused, found.own), default=None)
    if best is None or best.refused:
        raise Unreadable(best.refused if best else "its sheet has no square to begin with")
    return best.map


def half_found(grey: Any, frame: Page, half: str) -> PaperMap:
    """The paper map of one half in its picture. Raises Unreadable where it is not found."""
    x1, y1, x2, y2 = CORNERS[half]
    square = np.array([[x1, y1], [x2, y1], [x2, y2], [x1, y2]])
    sides = tuple(side for side in SIDES if side in (half, "upper", "lower"))
    corners = corners_in(grey, frame, CORNERS[half])
    for at, faint in (*product(corners, (False,)), *product(corners[:1], (True,))):
        search = SheetSearch(grey, at, square, sides)
        found = search.fitted(frame, BENT_FROM, faint=faint)
        if found is not None and not found.refused:
            return found.map
    raise Unreadable(f"the frame of the {half} half is not found")


def seen(over: PaperMap, picture: Any) -> Any:
    """Which pixels of the sheet are in the picture of a half."""
    inside = np.zeros(picture.shape[:2], np.uint8)
    inside[1:-1, 1:-1] = 255
    return flattened(inside, over, WHOLE, DENSITY) > 0


def corners_in(grey: Any, frame: Page, rect: tuple[float, float, float, float]) -> list[Any]:
    """Candidate corners of the frame in a scan, as pixels of the corners of ``rect``.

    One candidate for each rotation of the scan, the best match first.
    """
    high = max(grey.shape) / HIGH * 25.4
    shrink = COARSE * 25.4 / min(SCANNERS, key=lambda dpi: abs(dpi - high))
    small = cv2.resize(grey, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
    paper = cv2.morphologyEx(small, cv2.MORPH_CLOSE, np.ones((15, 15), np.uint8))
    dark = cv2.GaussianBlur(1 - small.astype(np.float32) / np.maximum(paper, 8), (0, 0), 1.5)
    pattern = cv2.GaussianBlur(printed_ink(frame, rect), (0, 0), 1.5)
    beside = cv2.dilate((pattern > 0.02).astype(np.float32), np.ones((7, 7), np.uint8))
    ring = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    side, size = np.array(pattern.shape[::-1]), np.array(dark.shape[::-1])
    room = side + round(ROOM * COARSE)
    if (size < room).any():
        return []
    found = []
    for turn in range(4):
        turned = np.roll(ring, turn, axis=0)
        low = turned[0 if rect[0] < CUT else 1] * (size - room)
        part = dark[low[1] : low[1] + room[1], low[0] : low[0] + room[0]]
        ink, mask = (np.ascontiguousarray(np.rot90(each, turn)) for each in (pattern, beside))
        likeness = cv2.matchTemplate(part, ink, cv2.TM_CCOEFF_NORMED, mask=mask)
        likeness[~np.isfinite(likeness)] = -1
        _, most, _, at = cv2.minMaxLoc(likeness)
        found.append((most, (turned * side + low + at) / shrink))
    return [at for _, at in sorted(found, key=lambda each: -each[0])]


def printed_ink(page: Page, rect: tuple[float, float, float, float]) -> Any:
    """The printed lines in a part of a page, drawn as an array: 1 where there is ink."""
    left, top, right, bottom = rect
    found = np.zeros((round((bottom - top) * COARSE), round((right - left) * COARSE)), np.uint8)
    for x1, y1, x2, y2, cls in segments(page):
        ends = ((np.array([[x1, y1], [x2, y2]]) - (left, top)) * COARSE - 0.5) * 16
        a, b = np.round(ends).astype(int).tolist()
        ink = min(255, round(255 * style_of(cls, "black").width * COARSE))
        cv2.line(found, a, b, ink, 1, cv2.LINE_AA, 4)
    return found.astype(np.float32) / 255
