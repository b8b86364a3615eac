"""A small picture beside a drawing: its shortest vectors enlarged in a circle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot
from typing import Any

from graphkin.paper.areas import Rect
from graphkin.paper.field import XY
from graphkin.paper.labels import Board, Label, segments
from graphkin.paper.marks import Circle, Line, Mark, Text, reach
from graphkin.paper.symbols import SHORT, head

VECTORS = ("velocity", "relative-velocity", "acceleration", "normal", "tangential", "coriolis")
ENLARGED = (5, 10)
"""How many times a detail is enlarged."""
RADIUS = 11.0
"""Radius of a detail circle in mm."""
TOO_SHORT = 0.2
"""Vectors shorter than this, in mm, are not worth a detail."""
GRID = 3.0
"""Distance of the places tried for a detail, in mm."""


TRIES = 60
"""Places among which one is sought whose line to the drawing crosses no text."""


def length_of(line: Line) -> float:
    """Length of a line in mm."""
    return hypot(line.x2 - line.x1, line.y2 - line.y1)


def enlarged(marks: Sequence[Mark], rect: Rect) -> list[Mark]:
    """A detail circle for the shortest vectors of a drawing, where there is a free place for it."""
    short = [
        mark
        for mark in marks
        if isinstance(mark, Line)
        and mark.cls.split()[0] in VECTORS
        and TOO_SHORT <= length_of(mark) < SHORT
    ]
    if not short:
        return []
    times = ENLARGED[0] if length_of(short[0]) * ENLARGED[0] >= 4 else ENLARGED[1]
    source = ((short[0].x1 + short[0].x2) / 2, (short[0].y1 + short[0].y2) / 2)
    place = free_place(marks, rect, source, RADIUS + 4)
    return [] if place is None else list(circled(marks, source, place, times))


def free_place(marks: Sequence[Mark], rect: Rect, near: XY, room: float) -> XY | None:
    """The middle of a free disc as near as possible to a place; None when there is none.

    Of the nearest, one is preferred whose line to the drawing crosses no text.
    """
    import numpy as np
    import shapely

    xs = np.arange(rect[0] + room, rect[2] - room, GRID)
    ys = np.arange(rect[1] + room, rect[3] - room, GRID)
    grid = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
    lines: Any = np.array([s for mark in marks for s in segments(mark)]).reshape(-1, 2, 2)
    texts = [shapely.box(*reach(mark)) for mark in marks if isinstance(mark, Text)]
    drawn: Any = shapely.linestrings(lines)
    taken = shapely.STRtree([*drawn, *texts])
    tries: Any = shapely.points(grid)
    crowded = taken.query(tries, predicate="dwithin", distance=room)[0]
    free = np.delete(grid, crowded, axis=0)
    if not len(free):
        return None
    nearest = free[np.hypot(*(free - near).T).argsort(kind="stable")][:TRIES]
    ways: Any = shapely.linestrings([[near, place] for place in nearest])
    crossed = shapely.STRtree(texts).query(ways, predicate="intersects")[0]
    clear = np.delete(nearest, crossed, axis=0)
    x, y = (clear if len(clear) else nearest)[0]
    return float(x), float(y)


def circled(marks: Sequence[Mark], source: XY, place: XY, times: int) -> Iterator[Mark]:
    """What lies in a small circle, drawn again in a large one."""
    small = RADIUS / times
    yield Circle(*source, small, "detail")
    yield Circle(*place, RADIUS, "detail")
    away = hypot(place[0] - source[0], place[1] - source[1])
    u, v = (place[0] - source[0]) / away, (place[1] - source[1]) / away
    yield Line(
        source[0] + small * u,
        source[1] + small * v,
        place[0] - RADIUS * u,
        place[1] - RADIUS * v,
        "leader",
    )
    beneath = place[1] + RADIUS + 3.6 if v > 0 else place[1] - RADIUS - 1.1
    yield Text(place[0], beneath, f"{times}:1", "caption", 2.5, "middle")
    board = Board((place[0] - RADIUS, place[1] - RADIUS, place[0] + RADIUS, place[1] + RADIUS))
    for mark in marks:
        if isinstance(mark, Line) and mark.cls.split()[0] in (*VECTORS, "construction"):
            draw_part(board, mark, source, place, times)
    board.marks.append(Circle(*place, RADIUS, "detail"))
    board.labels = named(board, marks, source, place, times)
    yield from board.marks[:-1]
    yield from board.placed()


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
