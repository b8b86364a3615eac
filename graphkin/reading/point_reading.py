"""The reading of one lettered point, and its verdict."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

ReadVerdict = Literal["right", "follows", "wrong", "missing", "unread"]
VERDICTS: tuple[ReadVerdict, ...] = ("right", "follows", "wrong", "missing", "unread")


class PointReading(Struct, frozen=True):
    """A lettered point: its position (mm of paper, y down), its verdict, and whether to ask.

    ``key`` is its correct position, and ``own`` the one that follows from the student's earlier
    points. ``off`` is the distance from the latter, and ``error`` the deviation that the pencil
    explains (mm). ``tail`` is a known point from which it is drawn, with its letter.
    """

    name: str
    step: int
    at: tuple[float, float] | None
    verdict: ReadVerdict
    ask: bool
    key: tuple[float, float]
    own: tuple[float, float]
    off: float | None = None
    error: float = 0.0
    tail: tuple[float, float] | None = None
    tail_name: str = ""


def pair(place: complex) -> tuple[float, float]:
    """A place as written, rounded to a thousandth of a mm."""
    return round(place.real, 3), round(place.imag, 3)
