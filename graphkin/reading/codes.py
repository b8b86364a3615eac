"""The student's code in a picture, and the corners of its square."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import cv2
import numpy as np
from msgspec import Struct

from graphkin.classroom.printing.personal import QUIET, SIDE, corners_on, modules
from graphkin.drawing.field import A3, SheetPaper

AGREES, BEFORE = 0.85, 0.08
"""The least share of matching modules for a partly hidden code, and its least lead over the next.

Two different codes match in about three quarters of their modules.
"""


class FoundCode(Struct, frozen=True):
    """A code and the corners of its square in pixels, clockwise from its own upper left corner."""

    text: str
    corners: Any


def codes_in(grey: Any) -> list[FoundCode]:
    """The codes in a grey picture, tried in several ways because a code may be faint or noisy."""
    import zxingcpp

    square: Any = zxingcpp.BarcodeFormat.QRCode
    for picture, times in ways_to_look(grey):
        found = zxingcpp.read_barcodes(picture, formats=square)
        if found:
            return [FoundCode(each.text, corners_of(each.position) * times) for each in found]
    return []


def ways_to_look(grey: Any) -> Iterator[tuple[Any, float]]:
    """The picture unchanged, then with even light, then halved; each with its reduction factor."""
    yield grey, 1.0
    yield cv2.createCLAHE(4.0, (16, 16)).apply(cv2.GaussianBlur(grey, (0, 0), 1.0)), 1.0
    yield cv2.resize(grey, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA), 2.0


def corners_of(position: Any) -> Any:
    order = position.top_left, position.top_right, position.bottom_right, position.bottom_left
    return np.array([(corner.x, corner.y) for corner in order], dtype=float)


def code_among(
    sheet: Any, density: float, codes: Sequence[str], paper: SheetPaper = A3
) -> FoundCode | None:
    """The code, among the given ones, whose square is on a flattened sheet; None if none is sure.

    For a square that is only partly visible. All codes have one length; ``density`` is in pixels
    per mm.
    """
    squares = np.array([modules(code) for code in codes], dtype=float)
    count = squares.shape[1]
    size = SIDE / count
    spread = max(1, round(size * density / 2))
    smooth = cv2.blur(sheet, (spread, spread))
    centres = (np.arange(count) + 0.5) * size
    best, most = None, -1.0
    for x, y in corners_on(paper, QUIET * size):
        across, down = (np.rint((a + centres) * density - 0.5).astype(int) for a in (x, y))
        seen = smooth[np.ix_(down, across)].astype(float)
        dark = seen < (seen.min() + seen.max()) / 2
        alike = (squares == dark).mean(axis=(1, 2))
        if alike.max() > most:
            first, second = int(alike.argmax()), np.sort([*alike, 0.0])[-2]
            most = float(alike[first])
            sure = most >= AGREES and most >= second + BEFORE
            right, low = x + SIDE, y + SIDE
            ring = np.array([[x, y], [right, y], [right, low], [x, low]])
            best = FoundCode(codes[first], ring * density - 0.5) if sure else None
    return best
