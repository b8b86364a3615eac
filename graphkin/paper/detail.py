"""A small picture beside a drawing: its shortest vectors enlarged in a circle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot
from typing import Any, NamedTuple

from graphkin.paper.areas import Rect
from graphkin.paper.field import XY
from graphkin.paper.labels import Board, Label, segments
from graphkin.paper.marks import Circle, Line, Mark, Text, reach
from graphkin.paper.symbols import SHORT, VECTORS, head

SHOWN = (*VECTORS, "construction", "link")
"""The classes of lines that a detail shows."""
ENLARGED = (5, 10)
"""How many times a detail is enlarged."""
RADIUS = 11.0
"""Radius of a detail circle in mm."""
TOO_SHORT = 0.5
"""Vectors shorter than this, in mm, are not worth a detail."""
GRID = 5.0
"""Distance of the places tried for a detail, in mm."""


TRIES = 60
"""Places among which one is sought whose line to the drawing crosses no text."""


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
        if not isinstance(mark, Line) or mark.cls.split()[0] not in VECTORS:
            continue
        if TOO_SHORT <= length_of(mark) < SHORT:
            times = ENLARGED[0] if length_of(mark) * ENLARGED[0] >= 4 else ENLARGED[1]
            return Source(((mark.x1 + mark.x2) / 2, (mark.y1 + mark.y2) / 2), times)
    return None


def with_detail(board: Board) -> list[Mark]:
    """A finished field, with a detail circle for very short vectors where there is room for it."""
    marks, detail = parted(board)
    return [*marks, *detail]


def parted(board: Board) -> tuple[list[Mark], list[Mark]]:
    """A finished field, and apart from it the detail circle; no marks where there is none."""
    spot = source(board.marks)
    if spot is None:
        return board.finish(), []
    small = spot.circle()
    board.marks.append(small)
    marks = board.finish()
    place = free_place(marks, board.rect, spot.at, RADIUS + 4)
    if place is None:
        return [mark for mark in marks if mark is not small], []
    return marks, list(circled(marks, spot.at, place, spot.times))


def free_place(marks: Sequence[Mark], rect: Rect, near: XY, room: float) -> XY | None:
    """The middle of a free disc as near as possible to a place; None when there is none.

    One is preferred from which a line to the drawing crosses no text.
    """
    import numpy as np
    import shapely

    xs = np.arange(rect[0] + room, rect[2] - room, GRID)
    ys = np.arange(rect[1] + room, rect[3] - room, GRID)
    grid = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
    lines: Any = np.array([s for mark in marks for s in segments(mark)]).reshape(-1, 2, 2)
    texts = [shapely.box(*reach(mark)) for mark in marks if isinstance(mark, Text)]
    sides = [text.exterior for text in texts]
    drawn: Any = shapely.multilinestrings([*shapely.linestrings(lines), *sides])
    shapely.prepare(drawn)  # many times as fast as a tree
    free = grid[~shapely.dwithin(drawn, shapely.points(grid), room)]
    nearest = free[np.hypot(*(free - near).T).argsort(kind="stable")][:TRIES]
    ways: Any = shapely.linestrings(
        np.array([[near, place] for place in nearest]).reshape(-1, 2, 2)
    )
    crossed = shapely.STRtree(texts).query(ways, predicate="dwithin", distance=0.5)[0]
    clear = np.delete(nearest, crossed, axis=0)
    for x, y in (*clear, *nearest):
        return float(x), float(y)
    return None


def circled(marks: Sequence[Mark], source: XY, place: XY, times: int) -> Iterator[Mark]:
    """What lies in a small circle, drawn again in a large one."""
    small = RADIUS / times
    yield Circle(*place, RADIUS, "detail")
    away = hypot(place[0] - source[0], place[1] - source[1])
    u, v = (place[0] - source[0]) / away, (place[1] - source[1]) / away
    line = Line(
        source[0] + small * u,
        source[1] + small * v,
        place[0] - RADIUS * u,
        place[1] - RADIUS * v,
        "detail",
    )
    if not crosses_text(line, marks):
        yield line
    beneath = place[1] + RADIUS + 3.6 if v > 0 else place[1] - RADIUS - 1.1
    yield Text(place[0], beneath, f"{times}:1", "caption", 2.5, "middle")
    board = Board((place[0] - RADIUS, place[1] - RADIUS, place[0] + RADIUS, place[1] + RADIUS))
    for mark in marks:
        shown = mark.cls.split()[0] in SHOWN
        if isinstance(mark, Line) and shown and passes(mark, source, small):
            draw_part(board, mark, source, place, times)
    board.marks.append(Circle(*place, RADIUS, "detail"))
    board.labels = named(board, marks, source, place, times)
    yield from board.marks[:-1]
    yield from board.placed()


def crosses_text(line: Line, marks: Sequence[Mark]) -> bool:
    """True when a line would run through lettering."""
    import shapely

    way = shapely.LineString([(line.x1, line.y1), (line.x2, line.y2)])
    texts = [shapely.box(*reach(mark)) for mark in marks if isinstance(mark, Text)]
    return bool(shapely.dwithin(way, texts, 0.5).any()) if texts else False


def passes(line: Line, centre: XY, radius: float) -> bool:
    """True when a line's carrier passes through a circle."""
    dx, dy = line.x2 - line.x1, line.y2 - line.y1
    across = dx * (centre[1] - line.y1) - dy * (centre[0] - line.x1)
    return abs(across) <= radius * hypot(dx, dy)


def draw_part(board: Board, line: Line, source: XY, place: XY, times: int) -> None:
    """The part of a line that lies in the small circle, enlarged, with its head if that is in."""
    import shapely

    disc = shapely.Point(source).buffer(RADIUS / times)
    part = shapely.LineString([(line.x1, line.y1), (line.x2, line.y2)]).intersection(disc)
    if part.is_empty or part.geom_type != "LineString":
        return
    (x0, y0), (x1, y1) = (larger((x, y), source, place, times) for x, y in part.coords)
    style = line.cls.split()[0]
    board.marks.append(Line(x0, y0, x1, y1, f"{style} detail"))
    whole = disc.covers(shapely.Point(line.x2, line.y2))
    if style != "construction" and whole and hypot(x1 - x0, y1 - y0) >= SHORT:
        board.marks.append(head((x0, y0), (x1, y1), style))


def larger(point: XY, source: XY, place: XY, times: int) -> XY:
    """Where a point of the small circle lies in the large one."""
    return (
        place[0] + times * (point[0] - source[0]),
        place[1] + times * (point[1] - source[1]),
    )


def named(board: Board, marks: Sequence[Mark], source: XY, place: XY, times: int) -> list[Label]:
    """The names of the vectors that lie wholly in the small circle."""
    small = RADIUS / times
    texts = {mark.name: mark for mark in marks if isinstance(mark, Text) and mark.name}
    found = []
    for mark in marks:
        if not isinstance(mark, Line) or mark.name not in texts:
            continue
        ends = ((mark.x1, mark.y1), (mark.x2, mark.y2))
        if all(hypot(x - source[0], y - source[1]) <= small for x, y in ends):
            first, last = (larger(end, source, place, times) for end in ends)
            text = texts[mark.name]
            found.append(Label(text.markup, text.cls.partition(" ")[2], (first, last), 2.5))
    return found
