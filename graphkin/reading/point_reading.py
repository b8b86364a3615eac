"""The reading of one lettered point and its verdict."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct
from msgspec.structs import replace

ReadVerdict = Literal["right", "follows", "wrong", "missing", "unread"]
VERDICTS: tuple[ReadVerdict, ...] = ("right", "follows", "wrong", "missing", "unread")
Doubt = Literal[
    "absent",
    "before",
    "elsewhere",
    "end",
    "far",
    "letter",
    "lines",
    "mistake",
    "off",
    "vague",
]
"""Why a person should check a point.

- ``absent``: nothing of it was found.
- ``before``: an earlier point is doubtful or wrong, and this point may follow from that.
- ``elsewhere``: another place suits the drawing about as well.
- ``end``: a vector or a bar does not surely end there.
- ``far``: it fits what is before it, but is far from the key.
- ``letter``: the letter of another point seems to be beside it.
- ``lines``: too few of its lines are drawn, or they do not reach it.
- ``mistake``: it is where neither the key nor the student's own points put it.
- ``off``: it is at the edge of what the pencil explains.
- ``vague``: the pencil explains too many places.
"""


class PointReading(Struct, frozen=True):
    """The reading of a lettered point.

    - ``at``: where it was read (mm of paper, y down).
    - ``verdict``: what is right of it; ``ask``: whether a person should check it, because of
      its ``doubts``.
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
    doubts: tuple[Doubt, ...] = ()

    def doubted(self, *doubts: Doubt) -> PointReading:
        """The same reading with more doubts, so that a person is asked."""
        return replace(self, ask=True, doubts=tuple(sorted({*self.doubts, *doubts})))


def pair(place: complex) -> tuple[float, float]:
    """A place rounded to a thousandth of a mm, as it is written to files."""
    return round(place.real, 3), round(place.imag, 3)
