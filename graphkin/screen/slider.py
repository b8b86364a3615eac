"""The driver's slider of a step page, and why a page has none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

from graphkin.grading.html import marked_up
from graphkin.mechanism import Mechanism
from graphkin.screen.buttons import button
from graphkin.screen.moving import moving, still
from graphkin.screen.sheets import ScreenSheet
from graphkin.text import Words


@dataclass(frozen=True, slots=True)
class Slider:
    """The script that moves a mechanism and its plans by ``name``, markup of the driver's symbol.

    ``unit`` is that of its place. Without a script, ``why`` is the key of the sentence why they
    stand still.
    """

    source: str = ""
    name: str = ""
    unit: str = ""
    why: str = ""

    def controls(self, words: Words) -> Iterator[str]:
        """The slider with what stands beside it, or the sentence that says why there is none."""
        if self.source:
            yield '<div id="move"><label for="driver">'
            yield f"<span>{escape(words('screen.driver'))}</span> {marked_up(self.name)}</label>"
            yield '<input type="range" id="driver">'
            unit = words("unit.deg") if self.unit == "deg" else f" {self.unit}"
            yield f'<output id="driven" for="driver" data-unit="{escape(unit)}"></output>'
            yield button("back", words("screen.back")) + "</div>"
            yield '<p id="place" role="status"'
            yield f' data-open="{escape(words("screen.open"))}"'
            yield f' data-dead="{escape(words("screen.dead"))}"></p>'
            told = escape(words("screen.results"))
            yield f'<p id="values" role="group" tabindex="0" aria-label="{told}"></p>'
        elif self.why:
            yield f'<p id="still">{marked_up(words(self.why))}</p>'


def slider(mechanism: Mechanism, sheets: Sequence[ScreenSheet]) -> Slider:
    """What moves a mechanism, or why nothing does."""
    found = moving(mechanism, sheets)
    if found is None:
        return Slider(why=still(mechanism) or "")
    return Slider(found.source, found.driven.name, found.driven.unit)
