"""The handwriting in the cells of a photographed sheet: whether there is any, and its cut-out."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np

from graphkin.drawing.field import Rect
from graphkin.drawing.marks import Page
from graphkin.reading.drawn_ink import COARSE, DENSITY, FAINT, FINE, flattened
from graphkin.reading.paper_map import PaperMap
from graphkin.reading.written_cells import WrittenCell, blank_cells

CUT, QUALITY = 10.0, 80
"""Pixels per mm and JPEG quality of a cut-out."""
AROUND = 1.5
"""Margin of a cut-out around its cell, in mm: digits run over the rules."""
INSET = 0.8
"""Margin in mm inside a cell that is ignored when ink is looked for: the rules are there."""
SHARE = 0.25
"""Ink is at least this part of the darkness of a cell's printed rules."""
STROKE, AREA = 1.2, 0.3
"""The least length (mm) of a stroke, and the least area (mm²) of all strokes, of a written cell."""
MOST = 80
"""The most cut-outs of a sheet."""


def written_cells(
    picture: Any, grey: Any, over: PaperMap, page: Page
) -> list[tuple[WrittenCell, bytes]]:
    """The cells of a photographed sheet that hold ink, with their cut-outs as JPEG."""
    found = []
    for cell, rect in blank_cells(page):
        if is_written(grey, over, rect):
            found.append((cell, cut_out(picture, over, rect)))
    return found[:MOST]


def is_written(grey: Any, over: PaperMap, rect: Rect) -> bool:
    """Whether a cell holds strokes that are as dark as its printed rules, or nearly so."""
    left, top, right, low = rect
    flat = flattened(grey, over, (left - 1, top - 1, right + 1, low + 1), DENSITY)
    flat = flat.astype(np.float32)
    dark = 1 - flat / max(float(np.percentile(flat, 80)), 8.0)
    lines = cv2.GaussianBlur(dark, (0, 0), FINE * DENSITY)
    lines -= cv2.GaussianBlur(dark, (0, 0), COARSE * DENSITY)
    edge, inset = round(DENSITY), round((1 + INSET) * DENSITY)
    across = slice(inset, -inset)
    rules = [lines[: 2 * edge, across].max(axis=0), lines[-2 * edge :, across].max(axis=0)]
    least = max(SHARE * float(np.median(np.concatenate(rules))), FAINT)
    inked = (lines[across, across] > least).astype(np.uint8)
    _, _, parts, _ = cv2.connectedComponentsWithStats(inked)
    strokes = [part for part in parts[1:] if max(part[2], part[3]) >= STROKE * DENSITY]
    return sum(int(part[4]) for part in strokes) >= AREA * DENSITY**2


def cut_out(picture: Any, over: PaperMap, rect: Rect) -> bytes:
    """A cell with a margin, seen flat and in the picture's colours, as JPEG without metadata."""
    left, top, right, low = rect
    around = left - AROUND, top - AROUND, right + AROUND, low + AROUND
    return as_jpeg(flattened(picture, over, around, CUT), QUALITY)


def as_jpeg(flat: Any, quality: int) -> bytes:
    """A flattened picture as JPEG without metadata, in its colours."""
    if flat.ndim == 3:
        flat = cv2.cvtColor(flat, cv2.COLOR_RGB2BGR)
    return bytes(cv2.imencode(".jpg", flat, [cv2.IMWRITE_JPEG_QUALITY, quality])[1])
