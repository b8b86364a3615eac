"""A field of a sheet as a picture of its own in a page, in inks that follow light and dark."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from msgspec.structs import replace

from graphkin.drawing.areas import Rect
from graphkin.drawing.glyphs import font_face
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.style import BRIEF, Ink, in_variables
from graphkin.web.protocol import Timed
from graphkin.writers.svg import LETTERING, element, number, parted_text, rules

WIDTH = re.compile(r"stroke-width:([\d.]+)")
THINNEST = 0.24
"""Lines no thinner than this, in mm, on a screen whose dots are coarser than paper's grain."""
BAR = 20
"""Millimetres of paper that the bar of a field's scale is long, until a script finds others."""


def field_picture(marks: Sequence[tuple[str, Timed]], rect: Rect, named_by: str) -> str:
    """The marks of a field, each under its id, as SVG whose units are millimetres of the page.

    ``named_by`` is the id of the words that tell what the picture is.
    """
    left, top, right, bottom = rect
    box = " ".join(map(number, (left, top, right - left, bottom - top)))
    drawn = "\n".join(placed(name, timed) for name, timed in marks)
    return f'<svg viewBox="{box}" role="img" aria-labelledby="{named_by}">\n{drawn}\n</svg>'


def bar_rules(fields: str, rects: Sequence[Rect]) -> Iterator[str]:
    """What of each of some fields side by side its bar is to know: how wide and high it is."""
    for place, (left, top, right, bottom) in enumerate(rects, 1):
        box = f"--bar:{BAR};--wide:{number(right - left)};--high:{number(bottom - top)}"
        yield f"{fields}>:nth-child({place}){{{box}}}"


def placed(name: str, timed: Timed) -> str:
    """A mark with its id, the sentence that draws it, and the step that it shows, written once.

    One without an id belongs to a picture within the picture.
    """
    own = f' id="{name}"' if name else " data-aside"
    of = f' data-of="{timed.step}"' if timed.step is not None else ""
    plain = replace(timed, mark=replace(timed.mark, step=None))
    written = drawn_mark(plain).replace(" ", f'{own} data-at="{timed.at}"{of} ', 1)
    return f'<g class="lettering">{written}</g>' if isinstance(timed.mark, Text) else written


def drawn_mark(timed: Timed) -> str:
    """A mark; of a label that several letters share each appears with its own sentence."""
    if not timed.letters or not isinstance(timed.mark, Text):
        return element(timed.mark)
    parts = zip(timed.mark.letters, timed.letters, strict=True)
    return parted_text(timed.mark, [(letter.joined, f'data-from="{at}"') for letter, at in parts])


def ink_sheet(marks: Iterable[Mark], ink: Ink) -> str:
    """The style sheet of some marks, with their faces; no shaft changes while a vector moves."""
    marks = [replace(mark, cls=mark.cls.removesuffix(f" {BRIEF}")) for mark in marks]
    return "\n".join(
        (font_face(False), font_face(True), LETTERING, *map(themed, rules(marks, ink)))
    )


def themed(rule: str) -> str:
    """A rule of the sheets in inks that follow light and dark, its lines as strong as told."""
    return WIDTH.sub(
        lambda found: f"stroke-width:calc({max(float(found[1]), THINNEST):g}px*var(--w))",
        in_variables(rule),
    )
