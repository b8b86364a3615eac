"""The driver's slider of a step page, and why a page has none."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, log10

from msgspec import Struct

from graphkin.mechanism import Mechanism
from graphkin.motion.driving import TURN
from graphkin.text import Words
from graphkin.web.moving import moving, still
from graphkin.web.page_driver import PageDriver, Reach, window
from graphkin.web.screen_sheets import ScreenSheet

SLACK = 0.5
"""Degrees that a whole turn may lack about a change point."""


class Slider(Struct, frozen=True):
    """The script that moves a mechanism and its plans by ``name``, markup of the driver's symbol.

    ``datum`` is that symbol as the data have it, ``unit`` that of its place, ``ends`` the least
    and the greatest, ``stops`` those of them beyond which nothing closes, ``digits`` the decimals
    that tell it. Without a script, ``why`` is the key of the sentence why they stand still.
    """

    source: str = ""
    name: str = ""
    datum: str = ""
    unit: str = ""
    ends: tuple[float, float] = (0.0, 0.0)
    stops: tuple[float, ...] = ()
    digits: int = 1
    why: str = ""

    def place(self, words: Words, at: float | None) -> str:
        """A place of the driver in words, or its unit alone."""
        unit = words("unit.deg") if self.unit == "deg" else f" {self.unit}"
        return unit if at is None else words.fixed(at, self.digits) + unit

    def limits(self, words: Words) -> str:
        """The places beyond which it does not go; empty where it turns freely."""
        return " / ".join(self.place(words, at) for at in self.stops)


def slider(mechanism: Mechanism, sheets: Sequence[ScreenSheet]) -> Slider:
    """What moves a mechanism, or why nothing does."""
    found = moving(mechanism, sheets)
    if found is None:
        return Slider(why=still(mechanism) or "")
    driven, reach = found.driven, found.reach
    ends = (reach.low, reach.high)
    stops, digits = stopped(driven, reach), max(1, -floor(log10(reach.step)))
    return Slider(found.source, driven.name, driven.datum, driven.unit, ends, stops, digits)


def stopped(driven: PageDriver, reach: Reach) -> tuple[float, ...]:
    """The ends of a range beyond which nothing closes, not those of what is looked at.

    A range of a whole turn ends where it begins, in a change point: beyond it goes on.
    """
    if driven.unit == "deg" and reach.high - reach.low > TURN - SLACK:
        return ()
    pairs = zip((reach.low, reach.high), window(driven), strict=True)
    return () if reach.whole else tuple(end for end, edge in pairs if abs(end - edge) > 1e-9)
