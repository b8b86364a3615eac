"""The opaque code of a student in a picture, and where its square lies."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import cv2
import numpy as np
from msgspec import Struct


class FoundCode(Struct, frozen=True):
    """A code and the corners of its square in pixels, clockwise from its own upper left one."""

    text: str
    corners: Any


def codes_in(grey: Any) -> list[FoundCode]:
    """The codes in a grey picture; a faint or noisy one is looked for in several ways."""
    import zxingcpp

    square: Any = zxingcpp.BarcodeFormat.QRCode
    for picture, times in ways_to_look(grey):
        found = zxingcpp.read_barcodes(picture, formats=square)
        if found:
            return [FoundCode(each.text, corners_of(each.position) * times) for each in found]
    return []


def ways_to_look(grey: Any) -> Iterator[tuple[Any, float]]:
    """The picture as it is, with its light evened, and smaller; each with how much smaller."""
    yield grey, 1.0
    yield cv2.createCLAHE(4.0, (16, 16)).apply(cv2.GaussianBlur(grey, (0, 0), 1.0)), 1.0
    yield cv2.resize(grey, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA), 2.0


def corners_of(position: Any) -> Any:
    """The corners of a square as an array."""
    order = position.top_left, position.top_right, position.bottom_right, position.bottom_left
    return np.array([(corner.x, corner.y) for corner in order], dtype=float)
