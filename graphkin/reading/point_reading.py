"""What was read of one lettered point, and what is right of it."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

ReadVerdict = Literal["right", "follows", "wrong", "missing", "unread"]
VERDICTS: tuple[ReadVerdict, ...] = ("right", "follows", "wrong", "missing", "unread")


class PointReading(Struct, frozen=True):
    """A lettered point: where it was read (mm of paper, y down), what is right of it, and whether a
    person is to look at it. ``key`` is where it should be, ``own`` where it follows from the own
    earlier points; ``off`` is how far it lies from that, ``error`` what the pencil explains (mm).
    ``tail`` is a known point from which it is drawn, with its letter.
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
    """A place as it is written, to the thousandth of a mm."""
    return round(place.real, 3), round(place.imag, 3)
