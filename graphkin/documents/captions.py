"""The captions above the two fields of a sheet: what is drawn there, and at which scale factor."""

from __future__ import annotations

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
HEIGHTS, LEADING = (3.5, 2.5, 1.8), 3.2
"""Heights of captions, and the distance of two lines of one, in mm."""


def headlines(drawing: Drawing, layout: Layout, view: str) -> tuple[list[Mark], list[Mark]]:
    """The captions of both fields, small or in two lines where one has no room for large ones.

    A field without a plan has none.
    """
    words, scales = drawing.words, drawing.scales
    factor = scale_of(drawing, drawing.plane) / 1000
    k = BLANK if view == "task" and scales.of_crank else figure(drawing, factor)
    kL = f"{length_scale(drawing)} m/mm"
    beside = beside_plan(drawing, drawing.kind) if has_plan(drawing) else ""
    kL += f"; {beside}" if beside else ""
    mechanism = words("page.mechanism_heading", scale=words.decimal(scales.words), kL=kL)
    plan = words(f"page.{drawing.kind}_heading", k=k)
    left, right = layout.mechanism.rect, layout.plan.rect
    both = [(mechanism, left), *([(plan, right)] if has_plan(drawing) else [])]
    fits = (h for h in HEIGHTS if all(extent(s, h)[0] <= r[2] - r[0] - 5 for s, r in both))
    height = next(fits, HEIGHTS[-1])
    above, *right_of = (caption(said, rect, height) for said, rect in both)
    return above, right_of[0] if right_of else []


def caption(said: str, rect: Rect, height: float) -> list[Mark]:
    """A field's caption above it, what stands in brackets in a second line if need be."""
    room = rect[2] - rect[0] - 5
    lines = [said] if extent(said, height)[0] <= room else said.split("  ")
    if max(extent(line, height)[0] for line in lines) > room:
        lines = flowed(words_of(" ".join(lines)), " ", room, height)
    low = rect[1] - (2.5 if len(lines) == 1 else 1.5)
    return [
        Text(rect[0] + 3, low - LEADING * (len(lines) - 1 - i), line, "caption", height)
        for i, line in enumerate(lines)
    ]
