"""Small crosses in the fields of a task's drawing sheet, by which a photograph of it is flattened.

The frame carries the map to the paper's edges; between them paper ripples by more than pencil.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from msgspec.structs import replace

from graphkin.classroom.printing.qr_code import boxes, overlap
from graphkin.drawing.areas import AREA
from graphkin.drawing.marks import LineMark, Page, Point

REGISTER = "register"
"""The class of their lines."""
ARM, PITCH, CLEAR = 1.0, 20.0, 1.5
"""Half of a cross, how far apart they stand, and how far from what is printed, in mm."""
MIDDLE = (210.0, 148.5)
"""The sheet's middle, from which they are laid off as the divisions of its border are, in mm."""


def crossed(page: Page) -> Page:
    """The page with crosses in its fields, below all else, where nothing is printed."""
    full = [each for mark in page.marks for each in boxes(mark)]
    marks = []
    for x, y in places():
        near = (x - ARM - CLEAR, y - ARM - CLEAR, x + ARM + CLEAR, y + ARM + CLEAR)
        if not any(overlap(near, other) for other in full):
            marks.append(LineMark(x - ARM, y, x + ARM, y, REGISTER))
            marks.append(LineMark(x, y - ARM, x, y + ARM, REGISTER))
    return replace(page, marks=(*marks, *page.marks))


def without_crosses(page: Page) -> Page:
    """The page as it was printed before there were crosses."""
    return replace(page, marks=tuple(mark for mark in page.marks if mark.cls != REGISTER))


def crosses_of(page: Page) -> list[Point]:
    """Where a page has crosses, in mm."""
    level = (m for m in page.marks if isinstance(m, LineMark) and m.cls == REGISTER)
    return [((m.x1 + m.x2) / 2, m.y1) for m in level if m.y1 == m.y2]


def places() -> Iterator[Point]:
    """Where crosses may stand: on a square pitch about the sheet's middle, inside its fields."""
    left, top, right, bottom = AREA
    low, high = (int((m - edge) / PITCH) for m, edge in zip(MIDDLE, (left, top), strict=True))
    for i, j in product(range(-low, low + 1), range(-high, high + 1)):
        x, y = MIDDLE[0] + i * PITCH, MIDDLE[1] + j * PITCH
        if left + ARM < x < right - ARM and top + ARM < y < bottom - ARM:
            yield x, y
