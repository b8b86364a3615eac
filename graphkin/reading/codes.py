"""The opaque code of a student in a picture, and the position of its square."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import cv2
import numpy as np
from msgspec import Struct

from graphkin.classroom.printing.personal import QUIET, SIDE, corners_of_a3, modules

AGREES, BEFORE = 0.85, 0.08
"""Conditions for an unreadable square to count as one of some: agreement, and lead over others.

AGREES is the share of its modules that must agree. BEFORE is the required lead over any other
square. Two squares have about three quarters of their modules in common.
"""


class FoundCode(Struct, frozen=True):
    """A code and the corners of its square in pixels, clockwise from its own upper left one."""

    text: str
    corners: Any


def codes_in(grey: Any) -> list[FoundCode]:
    """The codes in a grey picture; a faint or noisy code is searched for in several ways."""
    import zxingcpp

    square: Any = zxingcpp.BarcodeFormat.QRCode
    for picture, times in ways_to_look(grey):
        found = zxingcpp.read_barcodes(picture, formats=square)
        if found:
            return [FoundCode(each.text, corners_of(each.position) * times) for each in found]
    return []


def ways_to_look(grey: Any) -> Iterator[tuple[Any, float]]:
    """The picture itself, with even lighting, and smaller; each with the factor of reduction."""
    yield grey, 1.0
    yield cv2.createCLAHE(4.0, (16, 16)).apply(cv2.GaussianBlur(grey, (0, 0), 1.0)), 1.0
    yield cv2.resize(grey, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA), 2.0


def corners_of(position: Any) -> Any:
    order = position.top_left, position.top_right, position.bottom_right, position.bottom_left
    return np.array([(corner.x, corner.y) for corner in order], dtype=float)


def code_among(sheet: Any, density: float, codes: Sequence[str]) -> FoundCode | None:
    """The one of some codes whose partly hidden square is on a flattened sheet, or None.

    All codes have one length. ``density`` is in pixels per mm. None where the match is uncertain.
    """
    squares = np.array([modules(code) for code in codes], dtype=float)
    count = squares.shape[1]
    size = SIDE / count
    spread = max(1, round(size * density / 2))
    smooth = cv2.blur(sheet, (spread, spread))
    centres = (np.arange(count) + 0.5) * size
    best, most = None, -1.0
    for x, y in corners_of_a3(QUIET * size):
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
