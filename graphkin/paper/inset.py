"""A small picture at a smaller scale for a centre or pole that lies off its field."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.paper.detail import free_place
from graphkin.paper.drawing import Drawing
from graphkin.paper.field import XY, Field
from graphkin.paper.labels import Board, Label
from graphkin.paper.marks import Circle, Line, Mark, Text, box
from graphkin.paper.scale import Scales, extent_of, preferred
from graphkin.paper.symbolic import symbol
from graphkin.plane import Ratio
from graphkin.steps.program import Part, Step

WIDTH, HEIGHT = 46.0, 30.0
"""Size of an inset in mm."""
EDGE = 8.0
"""Room inside an inset for names, in mm."""
FARTHEST = 200.0
"""A centre this many times farther than the field is wide is only named, not shown."""


def insets(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The insets of a mechanism's field, each where there is a free place for it."""
    found: list[Mark] = []
    for _, step, value in drawing.mechanism_steps():
        if step.part not in (Part.CENTRE, Part.POLE) or not isinstance(value, Ratio):
            continue
        point = drawing.place(value)
        if point is None or field.holds(point, 2.0):
            continue
        if abs(point - value.start) * field.mm > FARTHEST * (field.rect[2] - field.rect[0]):
            continue
        room = (WIDTH**2 + HEIGHT**2) ** 0.5 / 2 + 2
        place = free_place([*marks, *found], field.rect, field.at, room)
        if place is not None:
            found += inset(drawing, step, point, place)
    return found


def inset(drawing: Drawing, step: Step, centre: complex, at: XY) -> Iterator[Mark]:
    """The base of a link, its far centre, and the two rays that find it, at a preferred scale."""
    ends = [drawing.positions[step.says[key]] for key in ("p", "q")]
    extent = extent_of([*ends, centre])
    least = 1000 * max(extent.width / (WIDTH - 2 * EDGE), extent.height / (HEIGHT - 2 * EDGE))
    kL = next(preferred(least))
    rect = (at[0] - WIDTH / 2, at[1] - HEIGHT / 2, at[0] + WIDTH / 2, at[1] + HEIGHT / 2)
    field = Field(rect, 1000 / kL, extent.middle, at)
    board = Board(rect)
    (x0, y0), (x1, y1) = (field(end) for end in ends)
    far = field(centre)
    board.marks = [
        box(rect[0], rect[1], WIDTH, HEIGHT, "panel"),
        Line(x0, y0, x1, y1, "link inset"),
        *(Line(*field(end), *far, "ray inset") for end in ends),
        Circle(*far, 0.9, f"centre {drawing.kind} inset"),
        Text(rect[2] - 1.5, rect[3] - 1.5, Scales(kL, 1.0).words, "caption", 2.5, "end"),
    ]
    board.labels = [
        Label(symbol(step.says[key]), "", field(end), 2.5)
        for key, end in zip(("p", "q"), ends, strict=True)
    ]
    board.labels.append(Label(symbol(step.name), drawing.kind, far, 2.5, radius=0.9))
    yield from board.marks
    yield from board.placed()
