"""The marks of one moment of a motion: the mechanism and its plans with their letters.

Nothing of the construction is among them, and nothing that is placed by what stands around it:
letters go smoothly with their points.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import hypot

from graphkin.paper.construct import draw_plan_steps
from graphkin.paper.desk import Desk
from graphkin.paper.drawing import TAGS, Drawing
from graphkin.paper.field import XY, Field
from graphkin.paper.labels import Board
from graphkin.paper.layout import Layout
from graphkin.paper.marks import Mark, Text
from graphkin.paper.mechanism import draw_bars, draw_ground, draw_pins, draw_plates, outward
from graphkin.paper.richtext import extent
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import VECTORS
from graphkin.screen.grounds import travelling

LETTER = 3.5
"""Height of letters, in mm."""
ASIDE = 4.2
"""How far a letter stands from what it names, in mm."""
LEFT: XY = (-0.8, -0.6)
"""Where it stands when nothing else says so: to the left, above."""
NEAR = 4.0
"""Letters keep so far from one another, in mm."""
SHOWN = (*VECTORS, "relative-acceleration", "arrowhead", "point", "pole")
"""The first class of the marks of a plan that are shown, without what constructs them."""


def mechanism_marks(drawing: Drawing, field: Field) -> list[Mark]:
    """Bars, plates, pins and ground, with the letters of the points."""
    board, away_with = Board(field.rect), travelling(drawing, field)
    draw_plates(board, drawing, field)
    draw_ground(board, drawing, field)
    draw_bars(board, drawing, field)
    draw_pins(board, drawing, field)
    marks: list[Mark] = [mark for mark in board.marks if mark not in away_with]
    taken: list[XY] = []
    for name, place in drawing.positions.items():
        fixed = name in drawing.scene.frame.points
        away = LEFT if fixed else outward(drawing, field, name) or LEFT
        marks += letter(Letter(name, symbol(name), field(place), away), taken)
    return marks


def plan_marks(drawing: Drawing, field: Field) -> list[Mark]:
    """The vectors and points of a plan with their letters, without what constructs them."""
    board = Board(field.rect)
    draw_plan_steps(Desk(board, field, drawing, Layout(field, field, Free())))
    marks = [mark for mark in board.marks if is_shown(mark)]
    places = {
        number: field(value)
        for number, step, value in drawing.steps(drawing.plane)
        if step.name and step.name[-1] not in TAGS and isinstance(value, complex)
    }
    taken: list[XY] = []
    pole = field(0j)
    for number, at in places.items():
        name = drawing.trace.program.steps[number].name
        away = off(at, list(places.values()) if name == drawing.pole else [pole])
        own = Letter(name, symbol(name), at, away, drawing.kind, number)
        marks += letter(own, taken)
    return marks


def off(at: XY, others: Sequence[XY]) -> XY:
    """The way from some places to another, all of them alike; to the left where none tells it."""
    ways = [(at[0] - x, at[1] - y) for x, y in others]
    ways = [(u / hypot(u, v), v / hypot(u, v)) for u, v in ways if hypot(u, v) > 1]
    u, v = sum(u for u, _ in ways), sum(v for _, v in ways)
    size = hypot(u, v)
    return (u / size, v / size) if size > 0.1 else LEFT


class Free(dict[int, tuple[float, float]]):
    """Spans of construction lines that are not shown."""

    def __missing__(self, number: int) -> tuple[float, float]:
        return 0.0, 0.0


def is_shown(mark: Mark) -> bool:
    """Whether a mark of a plan is a vector or a point of the plan itself."""
    first = mark.cls.split()[0]
    return first in SHOWN and not (mark.name and mark.name[-1] in TAGS)


@dataclass(frozen=True, slots=True)
class Letter:
    """The letter of a point at a place of the picture, which way it stands off, and its look."""

    name: str
    markup: str
    at: XY
    away: XY
    look: str = ""
    step: int | None = None

    def text(self, x: float, y: float) -> Text:
        """The letter with the middle of its ink at a place."""
        width, top, bottom = extent(self.markup, LETTER)
        look = f"label {self.look}".strip()
        x, y = x - width / 2, y - (top + bottom) / 2
        return Text(x, y, self.markup, look, LETTER, "start", self.name, self.step)


def letter(own: Letter, taken: list[XY]) -> Iterator[Text]:
    """A letter beside its point; on another side where one stands there.

    Where letters stand on all sides it is left out.
    """
    far = ASIDE + extent(own.markup, LETTER)[0] / 4
    u, v = own.away
    for way in ((u, v), (-v, u), (v, -u), (-u, -v)):
        x, y = own.at[0] + way[0] * far, own.at[1] + way[1] * ASIDE
        if all(hypot(x - other[0], y - other[1]) > NEAR for other in taken):
            taken.append((x, y))
            yield own.text(x, y)
            return
