"""The key on transparent ground, to be laid over a drawing: nothing but what is drawn to scale."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import lay_out, lowered
from graphkin.construction.core.naming import name_of_sheet
from graphkin.construction.core.parameter_words import variant
from graphkin.documents.detail import with_detail
from graphkin.documents.sheet import boards, sheet_heading, title_of
from graphkin.drawing.areas import A3_AREA, Rect
from graphkin.drawing.frame import fitting
from graphkin.drawing.marks import LineMark, Mark, Page, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.style import BARE, TINTS, style_of

HALF, GAP, STROKE = 3.0, 2.0, 3.0
"""Half a cross, what is left free beyond it, and the stroke outside, in mm."""
FOOT = 10.0
"""How far above the frame's lower edge the title stands: where the task sheet has no words."""


def overlay(drawing: Drawing, number: str) -> Page:
    """Mechanism and plan of the key at the places and scale that they have on the task sheet.

    The letters of the task sheet are left to it, whose places need not be those of the key.
    Crosses stand on the corners of the task sheet's frame, crop marks outside them. The caption
    tells which variant of the mechanism it is.
    """
    layout = lowered(lay_out(drawing), sheet_heading(drawing, "task")[2])
    words = drawing.words
    tasks = boards(drawing, layout, "task")
    labels = (label for task in tasks for label in task.labels)
    known = {(label.name, cls) for label in labels for cls in (label.look, label.leader_look)}
    name = f"{title_of(drawing)} – {words('sheet.' + name_of_sheet(drawing))}"
    set_to = "".join(f", {each}" for each in variant(drawing.scene, words))
    rest = f"{set_to}, {words('sheet.overlay')} {number}, {words.decimal(drawing.scales.words)}"
    room = A3_AREA[2] - A3_AREA[0] - 24 - extent(rest, 2.5)[0]
    (first,), height = fitting("title", name, room, 2.5, 2.5)
    marks = (
        *(
            untinted(mark)
            for mark in with_detail(*boards(drawing, layout, "key"))
            if (mark.name, mark.cls) not in known
        ),
        *crop_marks(A3_AREA),
        Text(A3_AREA[0] + 12, A3_AREA[3] - FOOT, first + rest, "caption", height, name="title"),
    )
    return Page(420, 297, marks, name, words.language)


def untinted(mark: Mark) -> Mark:
    """A mark without the light tint that would lie over the drawing below."""
    if style_of(mark.cls).fill not in TINTS:
        return mark
    return replace(mark, cls=f"{mark.cls} {BARE}")


def crop_marks(rect: Rect) -> Iterator[Mark]:
    """A cross on each corner of a frame, and beyond it two strokes that a cut leaves behind."""
    for x, outward in ((rect[0], -1), (rect[2], 1)):
        for y, down in ((rect[1], -1), (rect[3], 1)):
            near, far = HALF + GAP, HALF + GAP + STROKE
            yield LineMark(x - HALF, y, x + HALF, y, "border", "corner")
            yield LineMark(x, y - HALF, x, y + HALF, "border", "corner")
            yield LineMark(x + outward * near, y, x + outward * far, y, "border", "crop")
            yield LineMark(x, y + down * near, x, y + down * far, "border", "crop")
