"""A small picture beside a drawing: its shortest vectors enlarged in a circle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import dist, hypot, sqrt
from typing import NamedTuple, TypeGuard

from graphkin.paper.crowd import HELPERS
from graphkin.paper.doubt import segment_of
from graphkin.paper.field import XY
from graphkin.paper.free import Disc, free_disc
from graphkin.paper.labels import SMALL, Board, Label, free_ones
from graphkin.paper.marks import Circle, Line, Mark, Text
from graphkin.paper.plan import DOT
from graphkin.paper.symbols import SHORT, VECTORS, head
from graphkin.paper.together import finished, spots_on

SHOWN = (*VECTORS, "construction", "link")
"""The classes of lines that a detail shows."""
ENLARGED = (5, 10)
"""How many times a detail is enlarged."""
RADIUS = 14.0
"""Radius of a detail circle in mm."""
SEEN = 5.0
"""Length in mm that a part of a vector must have in a detail to be named there."""
WHOLE = 6
"""Priority of the name of a vector that lies whole in a detail."""
TOO_SHORT = 0.5
"""Vectors shorter than this, in mm, are not worth a detail."""


def length_of(line: Line) -> float:
    """Length of a line in mm."""
    return hypot(line.x2 - line.x1, line.y2 - line.y1)


class Source(NamedTuple):
    """What is to be enlarged: the middle of a small circle, and how many times."""

    at: XY
    times: int

    def circle(self) -> Circle:
        """The small circle, which labels keep clear of."""
        return Circle(*self.at, RADIUS / self.times, "detail", "detail")


def source(marks: Sequence[Mark]) -> Source | None:
    """The place of a drawing's shortest vector worth a detail; None where there is none."""
    for mark in marks:
        if is_vector(mark) and TOO_SHORT <= length_of(mark) < SHORT:
            times = ENLARGED[0] if length_of(mark) * ENLARGED[0] >= 4 else ENLARGED[1]
            return Source(((mark.x1 + mark.x2) / 2, (mark.y1 + mark.y2) / 2), times)
    return None


def with_detail(*boards: Board) -> list[Mark]:
    """Finished fields, with detail circles for very short vectors where there is room for them."""
    return [mark for marks, detail in parted(*boards) for mark in (*marks, *detail)]


def parted(*boards: Board) -> list[tuple[list[Mark], list[Mark]]]:
    """Finished fields, and apart from each its detail circle; no marks where there is none."""
    spots = [source(board.marks) for board in boards]
    for board, spot in zip(boards, spots, strict=True):
        board.marks += [spot.circle()] if spot else []
    found: list[tuple[list[Mark], list[Mark]]] = []
    enlarged: list[tuple[Board, list[Mark]]] = []
    wished = [list(board.labels) for board in boards]
    for board, labels, spot, marks in zip(boards, wished, spots, finished(boards), strict=True):
        detail: list[Mark] = []
        found.append((marks, detail))
        if spot is None:
            continue
        disc = free_disc(marks, board.rect, spot.at, RADIUS + 4)
        if disc is None:
            marks.remove(spot.circle())
            continue
        detail += circled(disc, spot.at, spot.times)
        part = enlarged_part(marks, spot.at, disc.at, spot.times)
        part.labels = [*named(labels, marks, spot.at, disc.at, spot.times)]
        part.marks[-1:-1] = dots(part.labels)
        detail += part.marks[:-1]
        enlarged.append((part, detail))
    places = spots_on([part for part, _ in enlarged], thorough=False)
    for (part, into), at in zip(enlarged, places, strict=True):
        into.extend(free_ones(part, at))
    return found


def circled(disc: Disc, source: XY, times: int) -> Iterator[Mark]:
    """A large circle, the line from the small one to it, and how many times it enlarges."""
    small, place = RADIUS / times, disc.at
    yield Circle(*place, RADIUS, "detail")
    away = hypot(place[0] - source[0], place[1] - source[1])
    u, v = (place[0] - source[0]) / away, (place[1] - source[1]) / away
    if disc.in_sight:
        yield Line(
            source[0] + small * u,
            source[1] + small * v,
            place[0] - RADIUS * u,
            place[1] - RADIUS * v,
            "detail",
        )
    beneath = place[1] + RADIUS + 3.6 if v > 0 else place[1] - RADIUS - 1.1
    yield Text(place[0], beneath, f"{times}:1", "caption", 2.5, "middle")


def enlarged_part(marks: Sequence[Mark], source: XY, place: XY, times: int) -> Board:
    """What lies in a small circle, drawn again in a large one, which is the last of its marks."""
    small = RADIUS / times
    board = Board((place[0] - RADIUS, place[1] - RADIUS, place[0] + RADIUS, place[1] + RADIUS))
    for mark in marks:
        shown = mark.cls.split()[0] in SHOWN
        if isinstance(mark, Line) and shown and passes(mark, source, small):
            draw_part(board, mark, source, place, times)
    board.marks.append(Circle(*place, RADIUS, "detail"))
    return board


def passes(line: Line, centre: XY, radius: float) -> bool:
    """True when a line's carrier passes through a circle."""
    dx, dy = line.x2 - line.x1, line.y2 - line.y1
    across = dx * (centre[1] - line.y1) - dy * (centre[0] - line.x1)
    return abs(across) <= radius * hypot(dx, dy)


def draw_part(board: Board, line: Line, source: XY, place: XY, times: int) -> None:
    """The part of a line that lies in the small circle, enlarged, with its head if that is in."""
    found = within(line, source, RADIUS / times)
    if found is None:
        return
    (x0, y0), (x1, y1) = (larger(end, source, place, times) for end in found)
    style = line.cls.split()[0]
    board.marks.append(Line(x0, y0, x1, y1, f"{style} detail"))
    whole = found[1] == (line.x2, line.y2)
    if style in VECTORS and whole and hypot(x1 - x0, y1 - y0) >= SHORT:
        board.marks.append(head((x0, y0), (x1, y1), style))


def within(line: Line, centre: XY, radius: float) -> tuple[XY, XY] | None:
    """The part of a line that lies in a circle; None where there is none."""
    dx, dy = line.x2 - line.x1, line.y2 - line.y1
    x, y = line.x1 - centre[0], line.y1 - centre[1]
    square, half = dx * dx + dy * dy, x * dx + y * dy
    under = half * half - square * (x * x + y * y - radius * radius)
    if under <= 0 or square <= 0:
        return None
    low, high = (-half - sqrt(under)) / square, (-half + sqrt(under)) / square
    if high <= 0 or low >= 1:
        return None
    start = (line.x1 + low * dx, line.y1 + low * dy) if low > 0 else (line.x1, line.y1)
    end = (line.x1 + high * dx, line.y1 + high * dy) if high < 1 else (line.x2, line.y2)
    return start, end


def larger(point: XY, source: XY, place: XY, times: int) -> XY:
    """Where a point of the small circle lies in the large one."""
    return (
        place[0] + times * (point[0] - source[0]),
        place[1] + times * (point[1] - source[1]),
    )


def named(
    labels: Sequence[Label], marks: Sequence[Mark], source: XY, place: XY, times: int
) -> Iterator[Label]:
    """The names of the vectors and points of a small circle, those that lie whole in it first."""
    small = RADIUS / times
    drawn = {m.name: ((m.x1, m.y1), (m.x2, m.y2)) for m in marks if is_vector(m)}
    for label in labels:
        ends = segment_of(label) or drawn.get(label.name)
        if ends is None:
            x, y = label.subject
            assert isinstance(x, float) and isinstance(y, float)
            if label.cls not in HELPERS and dist((x, y), source) <= small:
                at = larger((x, y), source, place, times)
                yield replace(label, subject=at, height=SMALL, radius=DOT, name="", step=None)
        elif label.cls in VECTORS and (part := within(Line(*ends[0], *ends[1], ""), source, small)):
            first, last = (larger(end, source, place, times) for end in part)
            if part == ends or dist(first, last) >= SEEN:
                rank = WHOLE if part == ends else 0
                yield Label(label.markup, label.cls, (first, last), SMALL, priority=rank)


def dots(labels: Sequence[Label]) -> Iterator[Mark]:
    """The points of a detail whose letters are sought."""
    for label in labels:
        if segment_of(label) is None:
            x, y = label.subject
            assert isinstance(x, float) and isinstance(y, float)
            yield Circle(x, y, DOT, f"point {label.cls} detail".replace("  ", " "))


def is_vector(mark: Mark) -> TypeGuard[Line]:
    """True for the line of a vector."""
    return isinstance(mark, Line) and mark.cls.split()[0] in VECTORS
