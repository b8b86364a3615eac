"""A field of a sheet as a picture of its own in a page, in inks that follow light and dark."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from graphkin.paper.areas import Rect
from graphkin.paper.glyphs import font_face
from graphkin.paper.marks import Mark, Text
from graphkin.paper.style import (
    BLACK,
    BLUE,
    GREY,
    LIGHT,
    PALE,
    PURPLE,
    RED,
    TEAL,
    WHITE,
    Ink,
)
from graphkin.paper.svg import LETTERING, element, number, rules
from graphkin.screen.telling import Timed

INKS = {
    BLACK: "ink",
    GREY: "grey",
    BLUE: "blue",
    TEAL: "teal",
    RED: "red",
    PURPLE: "purple",
    LIGHT: "light",
    PALE: "pale",
    WHITE: "paper",
}
"""The variable of the page that holds each ink."""
COLOUR = re.compile("|".join(INKS))
WIDTH = re.compile(r"stroke-width:([\d.]+)")
THINNEST = 0.24
"""Lines no thinner than this, in mm, on a screen whose dots are coarser than paper's grain."""


def field_picture(marks: Sequence[tuple[str, Timed]], rect: Rect, named_by: str) -> str:
    """The marks of a field, each under its id, as SVG whose units are millimetres of the page.

    ``named_by`` is the id of the words that tell what the picture is.
    """
    left, top, right, bottom = rect
    box = " ".join(map(number, (left, top, right - left, bottom - top)))
    drawn = "\n".join(placed(name, timed) for name, timed in marks)
    return f'<svg viewBox="{box}" role="img" aria-labelledby="{named_by}">\n{drawn}\n</svg>'


def placed(name: str, timed: Timed) -> str:
    """A mark with its id, the sentence that draws it, and the step that it shows.

    One without an id belongs to a picture within the picture.
    """
    own = f' id="{name}"' if name else " data-aside"
    of = f' data-of="{timed.step}"' if timed.step is not None else ""
    written = element(timed.mark).replace(" ", f'{own} data-at="{timed.at}"{of} ', 1)
    return f'<g class="lettering">{written}</g>' if isinstance(timed.mark, Text) else written


def ink_sheet(marks: Iterable[Mark], ink: Ink) -> str:
    """The style sheet of some marks, with their faces."""
    marks = tuple(marks)
    return "\n".join((faces(), LETTERING, *map(themed, rules(marks, ink))))


def faces() -> str:
    """Both faces of the sheets' lettering."""
    return "\n".join((font_face(False), font_face(True)))


def themed(rule: str) -> str:
    """A rule of the sheets in inks that follow light and dark, its lines as strong as told."""
    rule = COLOUR.sub(lambda found: f"var(--{INKS[found[0]]})", rule)
    return WIDTH.sub(
        lambda found: f"stroke-width:calc({max(float(found[1]), THINNEST):g}px*var(--w))", rule
    )


def headline(marks: Sequence[Mark]) -> tuple[str, Sequence[Mark]]:
    """The markup of a field's caption, which stands above it, and the marks in the field."""
    first = marks[0]
    assert isinstance(first, Text)
    return first.markup, marks[1:]
