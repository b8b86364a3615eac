"""The marks of a plan's steps: lines with what they are square to, points, poles, arrows."""

from __future__ import annotations

from math import hypot
from typing import Any

from graphkin.construction.core.layout import BEYOND
from graphkin.construction.core.plan_vector import plan_vector, sign_of
from graphkin.construction.core.plot import Plot, line_part, middle, note_tiny
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.core.quantities import OnPaper
from graphkin.construction.core.segments import TINY
from graphkin.drawing.field import XY
from graphkin.drawing.label import Label
from graphkin.drawing.marks import CircleMark, LineMark, SharedLetter
from graphkin.drawing.style import BY_SIGN
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import PIN, SHORT, arrow

SAME = 0.01
"""How near to each other, in mm, points of a plan stand that are told to be the same."""
DOT = 0.7
"""Radius of a point of a plan in mm."""


def put_locus(plot: Plot, number: int, name: str, text: str, parts: tuple[int, int]) -> None:
    """A construction line as far as the layout says, with what it is drawn by along it.

    Between its first point and the one that was found on it an arrow lies; it is drawn beyond, in
    two ``parts``, the near one first.
    """
    ends = beyond(plot, number, plot.drawing.trace.values[number])
    drawn = [(end, part) for end, part in zip(ends, parts, strict=False) if end]
    for end, part in drawn:
        line = LineMark(*end[0], *end[1], "construction", name, number, part)
        plot.board.marks.append(line)
    if drawn:
        end, part = drawn[-1]
        own = name, number
        label = Label(text, "construction", end, 2.5, *own, priority=-1, part=part)
        plot.board.labels.append(label)


def beyond(plot: Plot, number: int, value: Any) -> list[tuple[XY, XY] | None]:
    """The parts of a line before its first point and after its last, in this order."""
    low, high = plot.layout.spans[number]
    if high - low <= 2 * BEYOND + TINY:
        return [line_part(plot, value, low, high)]
    first = line_part(plot, value, low, low + BEYOND)
    last = line_part(plot, value, high - BEYOND, high)
    return [first, last] if abs(low) < abs(high) else [last, first]


def put_point(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A named point of a plan."""
    if step.name:
        at = plot.field(value)
        plot.board.marks.append(CircleMark(*at, DOT, f"point {plot.colour}", step.name, number))
        name_point(plot, number, step.name, at, DOT)


def put_pole(plot: Plot, number: int, step: Step, value: Any) -> None:
    """The pole of a plan."""
    at = plot.field(value)
    plot.board.marks.append(CircleMark(*at, PIN, f"pole {plot.colour}", step.name, number))
    name_point(plot, number, step.name, at, PIN)


def name_point(
    plot: Plot, number: int, name: str, at: XY, radius: float, look: str = "", height: float = 3.5
) -> None:
    """The letter of a point; points that fall together share one label, o ≡ a or, nearly, o ≈ a."""
    board, look = plot.board, look or plot.colour
    for i, (x, y) in board.lettered.items():
        apart = hypot(x - at[0], y - at[1])
        if apart < TINY:
            label, joint = board.labels[i], "≡" if apart < SAME else "≈"
            letters = (*label.letters, SharedLetter(name, symbol(name), f" {joint} "))
            board.labels[i] = label.of_letters(letters)
            return
    board.lettered[len(board.labels)] = at
    letters = (SharedLetter(name, symbol(name)),)
    label = Label("", look, at, height, "", number, priority=2, radius=radius)
    board.labels.append(label.of_letters(letters))


def put_arrow(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A vector with its symbol; a very short one without head, named at the end of a leader."""
    tail, tip = plot.field(value.tail), plot.field(value.tip)
    length = hypot(tip[0] - tail[0], tip[1] - tail[1])
    cls = arrow_class(step, plot)
    if length > 0:
        plot.board.marks += arrow(tail, tip, cls, step.name, number)
    vector = plan_vector(step)
    assert vector is not None
    name, short = symbol(vector.symbol), length < SHORT
    if length < TINY:
        note_tiny(plot, name, OnPaper(length))
        return
    subject = middle(tail, tip) if short else (tail, tip)
    plot.board.labels.append(
        Label(name, cls, subject, 2.5, step.name, number, priority=1, led=short, spare=True)
    )


def arrow_class(step: Step, plot: Plot) -> str:
    """The look of a vector: normal and tangential components, relative and absolute ones."""
    kind = BY_SIGN.get(sign_of(step))
    if kind:
        return kind.look
    tail = plot.drawing.trace.program.steps[step.args[0]].name
    if step.plane is Plane.MECHANISM or tail == plot.drawing.pole:
        return plot.colour
    return f"relative-{plot.colour}"
