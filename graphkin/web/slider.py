"""The driver's slider of a step page, and why a page has none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from math import floor, log10

from graphkin.construction.core.given_data import angle_symbol
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.web.buttons import button
from graphkin.web.moving import moving, still
from graphkin.web.page_driver import PageDriver, Reach, window
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.writers.html_markup import marked_up


@dataclass(frozen=True, slots=True)
class Slider:
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

    def controls(self, words: Words) -> Iterator[str]:
        """The slider with what stands beside it, or the sentence that says why there is none."""
        if self.source:
            low, high = (
                f'<span class="end">{escape(self.place(words, at))}</span>' for at in self.ends
            )
            yield '<div id="move"><label for="driver">'
            yield f"<span>{escape(words('screen.driver'))}</span> {marked_up(self.name)}</label>"
            yield f'{low}<input type="range" id="driver">{high}'
            unit = escape(self.place(words, None))
            yield f'<output id="driven" for="driver" data-unit="{unit}"'
            yield f' data-digits="{self.digits}"></output>'
            yield button("back", words("screen.back"), "", words("screen.back_short")) + "</div>"
            told, moved = escape(words("screen.results")), escape(words.sentences["screen.moved"])
            yield f'<div id="read" data-moved="{moved}"'
            yield f' data-name="{escape(marked_up(self.datum))}">'
            yield f'<p id="values" role="group" tabindex="0" aria-label="{told}"></p>'
            yield '<p id="place" role="status"'
            yield f' data-open="{escape(words("screen.open"))}"'
            yield f' data-dead="{escape(words("screen.dead"))}"></p></div>'
        elif self.why:
            yield f'<p id="still">{marked_up(words(self.why))}</p>'

    def place(self, words: Words, at: float | None) -> str:
        """A place of the driver in words, or its unit alone."""
        unit = words("unit.deg") if self.unit == "deg" else f" {self.unit}"
        return unit if at is None else words.fixed(at, self.digits) + unit

    def help(self, words: Words) -> Iterator[str]:
        """Which keys move the driver, and why it goes no farther, unless it turns freely or as far
        as is shown."""
        if self.source:
            yield f"<span>{escape(words('screen.help_driver'))}</span>"
        if not self.stops:
            return
        places = " / ".join(self.place(words, at) for at in self.stops)
        yield f'<span id="limits">{escape(words("screen.limits", list=places))}</span>'


def slider(mechanism: Mechanism, sheets: Sequence[ScreenSheet]) -> Slider:
    """What moves a mechanism, or why nothing does."""
    found = moving(mechanism, sheets)
    if found is None:
        return Slider(why=still(mechanism) or "")
    driven, reach = found.driven, found.reach
    datum = angle_symbol(driven.scene, driven.driver) if driven.driver else driven.name
    ends = (reach.low, reach.high)
    stops, digits = stopped(driven, reach), max(1, -floor(log10(reach.step)))
    return Slider(found.source, driven.name, datum, driven.unit, ends, stops, digits)


def stopped(driven: PageDriver, reach: Reach) -> tuple[float, ...]:
    """The ends of a range beyond which nothing closes, not those of what is looked at."""
    pairs = zip((reach.low, reach.high), window(driven), strict=True)
    return () if reach.whole else tuple(end for end, edge in pairs if abs(end - edge) > 1e-9)
