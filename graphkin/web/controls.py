"""The controls of a step page: its sentence, its buttons and its sliders."""

from __future__ import annotations

from html import escape

from graphkin.construction.core.program import Part
from graphkin.text import Words
from graphkin.web.buttons import button
from graphkin.web.protocol import PageProtocol
from graphkin.web.slider import Slider

STOP_NAMES = {
    Part.POSITION: "screen.position",
    Part.VELOCITY: "screen.velocity",
    Part.CENTRE: "screen.centre",
    Part.NORMAL: "screen.normal",
    Part.ACCELERATION: "screen.acceleration",
    Part.POLE: "screen.pole",
}
"""What the buttons say that go to the parts of the work."""


def dock(words: Words, told: PageProtocol, moves: Slider) -> str:
    """The controls, in a template: a page without a script does not show them."""
    steps = len(told.said)
    stops = [
        f'<button type="button" data-stop="{first}" data-end="{last}"><kbd>{place}</kbd> '
        f"{escape(words(STOP_NAMES[stop]))}</button>"
        for place, (first, last, stop) in enumerate(told.stops(), 1)
    ]
    play = (
        f'data-play="{escape(words("screen.play"))}" data-pause="{escape(words("screen.pause"))}"'
    )
    return "\n".join(
        (
            '<template id="controls">',
            f'<div id="dock" role="group" aria-label="{escape(words("screen.controls"))}">',
            '<div id="told">',
            '<div id="say" aria-live="polite" aria-atomic="true"><p id="count"></p>'
            '<p id="sentence"></p></div>',
            f'<details id="because" open><summary>{escape(words("screen.because"))}</summary>'
            '<p id="reason"></p></details>',
            f'<p id="behind"><span id="new-key">{escape(words("screen.new"))}</span> '
            f'<span id="from-key">{escape(words("screen.from"))}</span> ',
            '<span id="from"></span></p>',
            '<p id="aside" data-aside></p>',
            '<p id="crossing"></p>',
            "</div>",
            '<div id="keys">',
            button("previous", words("screen.previous")),
            button("play", words("screen.play"), play),
            button("next", words("screen.next")),
            f'<input type="range" id="step" min="1" max="{steps}" step="1" value="1"'
            f' aria-label="{escape(words("screen.step"))}">',
            button(
                "follow",
                words("screen.follow"),
                'aria-pressed="false"',
                words("screen.follow_short"),
            ),
            "</div>",
            f'<div id="stops" role="group" aria-label="{escape(words("screen.stops"))}">',
            *stops,
            "</div>",
            *moves.controls(words),
            f'<p id="help"><span>{escape(words("screen.help"))}</span>',
            *moves.help(words),
            "</p>",
            "</div>",
            "</template>",
        )
    )
