"""The captions above the two fields of a sheet: what is drawn there, and at which scale factor."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.naming import has_plan, length_scale, scale_of
from graphkin.construction.core.quantities import ASKED, PLANES, SHEETS
from graphkin.construction.core.relation import beside_plan, figure
from graphkin.drawing.areas import Rect
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import extent, flowed, words_of

BLANK = ". . . . . . . . ."
"""Room to write in what a task does not give away."""
HEADING = "heading"
"""The name of the lines of captions."""
LOOKS = ((3.5, 1), (2.5, 1), (2.5, 2))
"""Heights of captions in mm with the lines that they may have, the first that does for both."""
LEAST = 1.8
"""Height in mm of the letters where nothing else does."""
LEADING = 1.4
"""Distance of the lines of a caption, in heights of its letters."""
FOOT = 2.2
"""How far above its field the first line of a caption stands, in mm: clear of three lines of data;
a second line of the lower letters ends above what begins 3 mm below the field's edge."""


def headlines(drawing: Drawing, layout: Layout, view: str) -> tuple[list[Mark], list[Mark]]:
    """The captions of both fields, of one height on both sheets of a mechanism.

    A task leaves the scale factors to be computed. A field without a plan has none.
    """
    own = said_above(drawing, drawing.kind if has_plan(drawing) else "", view)
    every = [*own, *(said for kind in others(drawing) for said in said_above(drawing, kind, view))]
    rects = layout.mechanism.rect, layout.plan.rect
    both = [(said, rects[i % 2]) for i, said in enumerate(every)]
    height = next((h for h, most in LOOKS if all(len(lines(*x, h)) <= most for x in both)), LEAST)
    above = [caption(said, rect, height) if said else [] for said, rect in both[:2]]
    return above[0], above[1]


def others(drawing: Drawing) -> list[str]:
    """The kinds of the other sheets of a mechanism: one with accelerations has both."""
    ask = drawing.scene.ask
    later = any(getattr(ask, q) for q, some in ASKED.items() if some[0].kind == SHEETS[1])
    return [kind for kind in SHEETS if later and kind != drawing.kind]


def said_above(drawing: Drawing, kind: str, view: str) -> tuple[str, str]:
    """What the captions of a mechanism say with a kind of plan beside it, or with none."""
    words, scales, task = drawing.words, drawing.scales, view == "task"
    beside = beside_plan(drawing, kind) if kind else ""
    kL = f"{BLANK if task else length_scale(drawing)} m/mm" + (f"; {beside}" if beside else "")
    mechanism = words("page.mechanism_heading", scale=words.decimal(scales.words), kL=kL)
    if not kind:
        return mechanism, ""
    k = BLANK if task else figure(drawing, scale_of(drawing, PLANES[kind]) / 1000)
    return mechanism, words(f"page.{kind}_heading", k=k)


def plan_enlarged(drawing: Drawing, rect: Rect, times: float) -> list[Mark]:
    """The caption of a plan that is drawn again, so many times as large, with auxiliary points."""
    words, factor = drawing.words, scale_of(drawing, drawing.plane) / 1000
    said = words(f"page.{drawing.kind}_heading", k=figure(drawing, factor / times))
    larger = "" if times == 1 else words("page.as_large", m=figure(drawing, times))
    return caption(f"{said}  {words('page.with_trials')}{larger}", rect, LOOKS[1][0])


def lines(said: str, rect: Rect, height: float) -> list[str]:
    """A field's caption, what stands in brackets in a second line if need be."""
    room = rect[2] - rect[0] - 5
    if extent(said, height)[0] <= room:
        return [said]
    parts = said.split("  ")
    if max(extent(part, height)[0] for part in parts) <= room:
        return parts
    return flowed(words_of(" ".join(parts)), " ", room, height)


def caption(said: str, rect: Rect, height: float) -> list[Mark]:
    """A field's caption in letters of a height; the first lines of both stand level."""
    first = rect[1] - FOOT
    return [
        Text(rect[0] + 3, first + LEADING * height * i, line, "caption", height, name=HEADING)
        for i, line in enumerate(lines(said, rect, height))
    ]


def apart(marks: Sequence[Mark]) -> tuple[str, list[Mark]]:
    """The markup of a field's caption, nothing where it has none, and the marks in the field."""
    lines = [mark.markup for mark in marks if isinstance(mark, Text) and mark.name == HEADING]
    return " ".join(lines), [mark for mark in marks if mark.name != HEADING]
