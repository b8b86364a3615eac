"""Where the steps of one drawing are put down, and what every kind of step needs there."""

from __future__ import annotations

from typing import Any

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.naming import scale_of
from graphkin.construction.core.quantities import OnPaper, in_mm
from graphkin.drawing.areas import Rect
from graphkin.drawing.field import XY, Field, clipped
from graphkin.drawing.labels import FieldContent, FootNote
from graphkin.drawing.marks import LineMark, Shown

EDGE = 3.0
"""How far from a field's edge lines end that would go on, in mm."""
FOOT = 6.5
"""The same at the foot of a field, which is for notes."""


class Plot(Struct, frozen=True):
    """Where steps of one drawing are put down: board, field, and the sheet's material."""

    board: FieldContent
    field: Field
    drawing: Drawing
    layout: Layout

    @property
    def colour(self) -> str:
        """The class that colours this sheet's plan."""
        return self.drawing.kind


def line_part(plot: Plot, value: Any, low: float, high: float) -> tuple[XY, XY] | None:
    """The part of a line between two distances in mm from its anchor, within its field."""
    unit = value.along / abs(value.along) / plot.field.mm
    start, end = plot.field(value.point + low * unit), plot.field(value.point + high * unit)
    return clipped(start, end, above_foot(plot.field.rect))


def inside(rect: Rect) -> Rect:
    """A field without its edges."""
    return rect[0] + EDGE, rect[1] + EDGE, rect[2] - EDGE, rect[3] - EDGE


def above_foot(rect: Rect) -> Rect:
    """A field without its edges and its lowest part, which is for notes."""
    return rect[0] + EDGE, rect[1] + EDGE, rect[2] - EDGE, rect[3] - FOOT


def middle(tail: XY, tip: XY) -> XY:
    """The middle of a vector."""
    return (tail[0] + tip[0]) / 2, (tail[1] + tip[1]) / 2


def note_tiny(plot: Plot, name: str, length: OnPaper) -> None:
    """Name a vector that is too short to be seen at the foot of its field."""
    words, drawing = plot.drawing.words, plot.drawing
    factor = scale_of(drawing, drawing.plane)
    key = "page.tiny" if drawing.settled(length * factor / 1000) else "page.nought"
    note = FootNote(words(key, name=name, length=in_mm(words, length)), name)
    if note not in plot.board.notes:
        plot.board.notes.append(note)


def draw_line(
    board: FieldContent,
    field: Field,
    line: tuple[complex, complex],
    name: str,
    shows: Shown | None = None,
) -> None:
    """A line across the field, chain-dotted."""
    start, along = line
    seen = start + along * (100 / (abs(along) * field.mm))  # of any size, 100 mm on paper
    part = clipped(*stretched(field(start), field(seen)), above_foot(field.rect))
    if part:
        board.marks.append(LineMark(*part[0], *part[1], "centre-line", name, shows=shows))


def stretched(start: XY, end: XY) -> tuple[XY, XY]:
    """A segment through two places, long enough to leave any page on both sides."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    far = 2000 / max(abs(dx), abs(dy))
    return (start[0] - far * dx, start[1] - far * dy), (start[0] + far * dx, start[1] + far * dy)
