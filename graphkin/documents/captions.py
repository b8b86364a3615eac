"""The captions above the two fields of a sheet: what is drawn there, and at which scale factor."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.naming import has_plan, length_scale, scale_of
from graphkin.construction.core.relation import figure
from graphkin.construction.core.set_lengths import beside_plan
from graphkin.drawing.areas import Rect
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import extent, flowed, words_of

BLANK = ". . . . . . . . ."
"""Room to write in what a task does not give away."""
HEADING = "heading"
"""The name of the lines of captions."""
HEIGHTS = (3.5, 2.5, 1.8)
"""Heights of captions in mm; all but the least stand in two lines at most."""
LEADING = 1.4
"""Distance of the lines of a caption, in heights of its letters."""
FOOT = 3.2
"""How far above its field the first line of a caption stands, in mm."""


def headlines(drawing: Drawing, layout: Layout, view: str) -> tuple[list[Mark], list[Mark]]:
    """The captions of both fields; a task leaves the scale factors to be computed.

    A field without a plan has none.
    """
    words, scales = drawing.words, drawing.scales
    factor = scale_of(drawing, drawing.plane) / 1000
    task = view == "task"
    k = BLANK if task else figure(drawing, factor)
    kL = f"{BLANK if task else length_scale(drawing)} m/mm"
    beside = beside_plan(drawing, drawing.kind) if has_plan(drawing) else ""
    kL += f"; {beside}" if beside else ""
    mechanism = words("page.mechanism_heading", scale=words.decimal(scales.words), kL=kL)
    plan = words(f"page.{drawing.kind}_heading", k=k)
    left, right = layout.mechanism.rect, layout.plan.rect
    above = caption(mechanism, left)
    return above, caption(plan, right) if has_plan(drawing) else []


def caption(said: str, rect: Rect) -> list[Mark]:
    """A field's caption, what stands in brackets in a second line if need be.

    The first lines of both captions stand level, clear of the data above; a second
    in the field, above what begins 3 mm below its edge.
    """
    room = rect[2] - rect[0] - 5
    for height in HEIGHTS:
        lines = [said] if extent(said, height)[0] <= room else said.split("  ")
        if max(extent(line, height)[0] for line in lines) > room:
            lines = flowed(words_of(" ".join(lines)), " ", room, height)
        if len(lines) <= 2:
            break
    first = rect[1] - FOOT
    return [
        Text(rect[0] + 3, first + LEADING * height * i, line, "caption", height, name=HEADING)
        for i, line in enumerate(lines)
    ]


def apart(marks: Sequence[Mark]) -> tuple[str, list[Mark]]:
    """The markup of a field's caption, nothing where it has none, and the marks in the field."""
    lines = [mark.markup for mark in marks if isinstance(mark, Text) and mark.name == HEADING]
    return " ".join(lines), [mark for mark in marks if mark.name != HEADING]
