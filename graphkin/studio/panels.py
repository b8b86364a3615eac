"""The drawings of the studio: the mechanism and its plans, each by itself and cut to what it holds.

They are the fields of the sheets, by the same marks; only the words and tables around them are
the page's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from html import escape
from math import ceil, floor

from graphkin.errors import PageError, Problem
from graphkin.paper.areas import Rect
from graphkin.paper.detail import with_detail
from graphkin.paper.drawing import Drawing
from graphkin.paper.inset import insets
from graphkin.paper.labels import Board
from graphkin.paper.layout import Layout, lay_out
from graphkin.paper.marks import Mark, Text, reach
from graphkin.paper.sheet import left_board, right_board
from graphkin.paper.style import in_variables
from graphkin.paper.svg import element, rules
from graphkin.paper.tags import marked_up
from graphkin.studio.riding import Seats, riding, seats_of

MECHANISM = "mechanism"
AROUND = 3.0
"""Room around the marks of a drawing, in mm."""
GRID = 5.0
"""Edges of a drawing lie on such a grid, in mm, so that it keeps still while values move."""


class StaleError(Exception):
    """Something newer is asked for, and what is being drawn is not wanted any more."""


@dataclass
class Memory:
    """What stays from one answer to the next: seats of the labels and edges of each drawing."""

    seats: dict[tuple[str, str], Seats] = field(default_factory=dict)
    edges: dict[tuple[str, str], Rect] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Panel:
    """One drawing: which it is, its caption in tags, and its picture."""

    name: str
    caption: str
    svg: str
    marks: tuple[Mark, ...]


def panels(
    drawings: Sequence[Drawing], shown: str, memory: Memory, *, quick: bool
) -> Iterator[tuple[Panel, Sequence[Problem]]]:
    """The mechanism with the construction of one plan, then the plans; with what did not fit.

    ``shown`` is the kind whose construction stands on the mechanism. ``quick`` lets labels ride.
    """
    on_mechanism = next((d for d in drawings if d.kind == shown), drawings[0])
    places = {drawing.kind: lay_out(drawing) for drawing in drawings}
    for name, drawing in ((MECHANISM, on_mechanism), *((d.kind, d) for d in drawings)):
        own = (name, drawing.kind)
        board = board_of(name, drawing, places[drawing.kind])
        head, board.marks = board.marks[0], board.marks[1:]
        labels, marks = list(board.labels), None
        problems: tuple[Problem, ...] = ()
        try:
            marks = None if quick else finished(name, drawing, places[drawing.kind], board)
        except PageError as error:
            problems = error.problems
            board.labels = labels
        if marks is not None:
            memory.seats[own] = seats_of(labels, marks)
        else:
            marks = riding(board, memory.seats.get(own, Seats()))
        memory.edges[own] = edges_of(marks, memory.edges.get(own) if quick else None)
        svg = picture(name, marks, memory.edges[own], drawing)
        caption = marked_up(head.markup) if isinstance(head, Text) else ""
        yield Panel(name, caption, svg, tuple(marks)), problems


def board_of(name: str, drawing: Drawing, layout: Layout) -> Board:
    """The field of the mechanism, or that of the plan, its labels not yet placed."""
    draw = left_board if name == MECHANISM else right_board
    return draw(drawing, layout, "key")


def finished(name: str, drawing: Drawing, layout: Layout, board: Board) -> list[Mark]:
    """The marks of a field with every label at a free place. Raises PageError where one has none.

    Centres that lie far off the mechanism have their insets.
    """
    marks = with_detail(board)
    return [*marks, *insets(drawing, layout.mechanism, marks)] if name == MECHANISM else marks


def edges_of(marks: Iterable[Mark], before: Rect | None) -> Rect:
    """The box around some marks with a little room, on a grid; not within what it was before."""
    boxes = [reach(mark) for mark in marks]
    sides = [min(box[i] for box in boxes) - AROUND for i in (0, 1)]
    sides += [max(box[i] for box in boxes) + AROUND for i in (2, 3)]
    if before is not None:
        sides = [
            pick(pair) for pick, *pair in zip((min, min, max, max), sides, before, strict=True)
        ]
    left, top = (GRID * floor(side / GRID) for side in sides[:2])
    right, bottom = (GRID * ceil(side / GRID) for side in sides[2:])
    return left, top, right, bottom


def picture(name: str, marks: Iterable[Mark], edges: Rect, drawing: Drawing) -> str:
    """A drawing as SVG, named by its caption on the page."""
    left, top, right, bottom = edges
    view = f"{left:g} {top:g} {right - left:g} {bottom - top:g}"
    language = escape(drawing.words.language)
    head = f'<svg viewBox="{view}" role="img" aria-labelledby="caption-{name}" lang="{language}">'
    return "".join((head, *map(element, marks), "</svg>"))


def style(found: Iterable[Panel]) -> str:
    """The rules for the marks of some drawings, in the colours of the page."""
    marks = (mark for panel in found for mark in panel.marks)
    return in_variables("\n".join(rules(marks, "colour")))
