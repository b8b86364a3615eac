"""How far a field reaches while it moves: the room it can grow to, and what must be in sight."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphkin.drawing.areas import Rect
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Text, style_class
from graphkin.drawing.richtext import extent

GROWTH = 3.5
"""Times its width or height by which a field can grow on each side for what leaves it."""
UNSEEN = ("centre-line", "moving-centrode", "caption")
"""The classes of marks that go as far as they like, and of what a page tells elsewhere."""
DIGITS = 1
"""Decimals of millimetres of what is in sight."""


def room_of(rect: Rect) -> Rect:
    """The rectangle that a field can grow to; lines are cut to it."""
    left, top, right, bottom = rect
    across, down = GROWTH * (right - left), GROWTH * (bottom - top)
    return left - across, top - down, right + across, bottom + down


def must_be_seen(mark: Mark) -> bool:
    """Whether a mark is to be in sight as a whole."""
    return style_class(mark) not in UNSEEN


def half(mark: Mark) -> tuple[float, float]:
    """How far a mark reaches to the sides of the place, or of the places, that it is laid at."""
    if isinstance(mark, CircleMark):
        return round(mark.r, DIGITS), round(mark.r, DIGITS)
    if isinstance(mark, Text):
        width, top, bottom = extent(mark.markup, mark.height)
        return round(width / 2, DIGITS), round((bottom - top) / 2, DIGITS)
    return 0, 0


def box_of(marks: Iterable[Mark]) -> Rect | None:
    """The rectangle about marks that stand still; None where there are none."""
    corners = [corner for mark in marks if must_be_seen(mark) for corner in corners_of(mark)]
    if not corners:
        return None
    across, down = zip(*corners, strict=True)
    left, right = (round(end(across), DIGITS) for end in (min, max))
    top, bottom = (round(end(down), DIGITS) for end in (min, max))
    return left, top, right, bottom


def corners_of(mark: Mark) -> Iterator[tuple[float, float]]:
    """The points between which a mark lies."""
    match mark:
        case LineMark():
            yield from ((mark.x1, mark.y1), (mark.x2, mark.y2))
        case CircleMark() | Arc():
            x, y = (mark.cx, mark.cy)
            yield from ((x - mark.r, y - mark.r), (x + mark.r, y + mark.r))
        case Text():
            width, top, bottom = extent(mark.markup, mark.height)
            left = mark.x + mark.left()
            yield from ((left, mark.y + top), (left + width, mark.y + bottom))
        case _:
            yield from mark.points
