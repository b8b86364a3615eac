"""The reading of one lettered point and its verdict."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

ReadVerdict = Literal["right", "follows", "wrong", "missing", "unread"]
VERDICTS: tuple[ReadVerdict, ...] = ("right", "follows", "wrong", "missing", "unread")


class PointReading(Struct, frozen=True):
    """The reading of a lettered point.

    - ``at``: where it was read (mm of paper, y down).
    - ``verdict``: what is right of it; ``ask``: whether a person should check it.
    - ``key``: where it should be; ``own``: where it follows from the student's own earlier points.
    - ``off``: its distance from ``own``; ``error``: the distance that the pencil explains (both
      mm).
    - ``tail``: a known point from which it is drawn; ``tail_name``: the letter of that point.
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
    """A place rounded to a thousandth of a mm, as it is written to files."""
    return round(place.real, 3), round(place.imag, 3)
