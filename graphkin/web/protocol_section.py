"""The construction of a step page in words: numbered sentences with their reasons and crossings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from math import degrees

from graphkin.construction.core.crossings import Crossing
from graphkin.text import Words
from graphkin.web.protocol import PageProtocol, ProtocolSentence
from graphkin.web.reasons import NO_STEP
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.writers.html_markup import marked_up

ANGLE, FACTOR = "\ue000", "\ue001"
"""Where the angle and the factor of a crossing stand in its sentence until it is marked up."""


def construction(sheets: Sequence[ScreenSheet], told: PageProtocol) -> Iterator[str]:
    """The numbered sentences, those of each sheet under its name, and the crossings of each."""
    words = sheets[0].drawing.words
    yield '<section id="steps" aria-labelledby="steps-name"><h2 id="steps-name">'
    yield f"{escape(words('page.construction'))}</h2>"
    for place, sheet in enumerate(sheets):
        first, last = told.bounds(place)
        yield f"<h3>{escape(words(f'sheet.{sheet.drawing.kind}'))}</h3>"
        yield f'<ol start="{first}">'
        for number_ in range(first, last + 1):
            yield sentence(words, number_, told.said[number_ - 1])
        yield "</ol>"
    yield "</section>"


def sentence(words: Words, place: int, said: ProtocolSentence) -> str:
    """A sentence, below it why, what is drawn aside, and the crossings of its lines."""
    named = zip(said.crossings, said.letters, strict=True)
    lines = "".join(crossing(words, found, name) for found, name in named)
    text = f'<span class="say">{marked_up(said.markup)}</span>'
    pairs = zip(said.why, said.of, strict=True)
    parts = [reason(why, step) for why, step in pairs]
    why = f'<small class="why">{"; ".join(parts)}</small>' if parts else ""
    aside = f'<small class="aside" data-aside>{marked_up(said.aside)}</small>' if said.aside else ""
    return f'<li id="step-{place}" value="{place}">{text}{why}{aside}{lines}</li>'


def reason(why: str, step: int) -> str:
    """A reason, with the step to which it belongs."""
    of = "" if step == NO_STEP else f' data-for="{step}"'
    return f"<span{of}>{marked_up(why)}</span>"


def crossing(words: Words, found: Crossing, name: str) -> str:
    """How flat two lines cross, and what a millimetre of pencil becomes there."""
    markup = words("page.crossing", name=name, angle=ANGLE, factor=FACTOR)
    angle, factor = words.fixed(degrees(found.angle), 0), words.significant(found.factor, 2)
    text = marked_up(markup)
    text = text.replace(ANGLE, f'<span class="angle">{angle}</span>')
    text = text.replace(FACTOR, f'<span class="factor">{factor}</span>')
    return f'<small class="crossing" data-of="{found.number}">{text}</small>'
