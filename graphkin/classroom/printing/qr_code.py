"""A student's opaque code as a QR square of plain marks, where a page has room for it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import groupby

from msgspec.structs import replace

from graphkin.drawing.areas import A3_TITLE_BLOCK, A4_AREA, A4_SIZE, BELOW, Rect
from graphkin.drawing.marks import LineMark, Mark, Page, Polyline, box, reach

SIDE = 20.0
"""Side of the square in mm."""
QUIET = 4
"""Modules that stay white around it (ISO/IEC 18004)."""
STEP = 4.0
"""How far apart the places are that are tried, in mm."""


@lru_cache(maxsize=64)
def modules(text: str) -> tuple[tuple[bool, ...], ...]:
    """The square of a text, row by row, dark ones True; a quarter of them may be spoilt.

    Ten capitals and digits take 21 modules a side, the least that there is.
    """
    import segno

    code = segno.make_qr(text, error="q", boost_error=True)
    return tuple(tuple(bool(dark) for dark in row) for row in code.matrix)


def square(text: str, x: float, y: float, side: float = SIDE) -> tuple[Mark, ...]:
    """The square of a text as black rectangles, its top-left corner at (x, y), side in mm."""
    rows = modules(text)
    size = side / len(rows)
    return tuple(
        box(x + left * size, y + top * size, width * size, height * size, "qr")
        for left, top, width, height in rectangles(rows)
    )


def rectangles(rows: Sequence[Sequence[bool]]) -> Iterator[tuple[int, int, int, int]]:
    """Dark modules as rectangles (left, top, width, height): runs, joined where they are alike."""
    standing: dict[tuple[int, int], int] = {}  # (left, width) of a run, and where it began
    for top, row in enumerate([*rows, ()]):
        runs = dict.fromkeys(dark_runs(row), top)
        for run in [run for run in standing if run not in runs]:
            began = standing.pop(run)
            yield run[0], began, run[1], top - began
        standing = runs | standing


def dark_runs(row: Sequence[bool]) -> Iterator[tuple[int, int]]:
    """Where dark modules of a row begin, and how many there are side by side."""
    for dark, group in groupby(range(len(row)), key=row.__getitem__):
        run = list(group)
        if dark:
            yield run[0], len(run)


def stamped(page: Page, text: str) -> Page:
    """The page with the square of a text where there is room; as it was where there is none."""
    margin = SIDE / len(modules(text)) * QUIET
    full = [full_box for mark in page.marks for full_box in boxes(mark)]
    a4 = (page.width, page.height) == A4_SIZE
    for x, y in corners_of_a4(margin) if a4 else corners_of_a3(margin):
        needed = (x - margin, y - margin, x + SIDE + margin, y + SIDE + margin)
        if not any(overlap(needed, other) for other in full):
            marks = square(text, x, y)
            return replace(page, marks=(*page.marks, *marks))
    return page


def corners_of_a3(margin: float) -> Iterator[tuple[float, float]]:
    """Places below the drawings of an A3 sheet, from beside the title block to the left and up."""
    x, low = A3_TITLE_BLOCK[0] - SIDE - margin - 1, A3_TITLE_BLOCK[3] - SIDE - margin - 1
    while x > BELOW[0] + margin:
        y = low
        while y > BELOW[1] + margin:
            yield x, y
            y -= STEP
        x -= STEP


def corners_of_a4(margin: float) -> Iterator[tuple[float, float]]:
    """Places on an A4 page, from its right upper corner down, then further to the left."""
    x = A4_AREA[2] - SIDE - margin - 1
    while x > A4_AREA[0] + margin:
        y = A4_AREA[1] + margin + 1
        while y < A4_AREA[3] - SIDE - margin:
            yield x, y
            y += STEP
        x -= STEP


def boxes(mark: Mark) -> Iterator[Rect]:
    """The boxes that a mark takes up; of an outline those of its sides."""
    if isinstance(mark, Polyline):
        ends = (*mark.points[1:], mark.points[0]) if mark.closed else mark.points[1:]
        for (x1, y1), (x2, y2) in zip(mark.points, ends, strict=False):
            yield reach(LineMark(x1, y1, x2, y2, mark.cls))
    else:
        yield reach(mark)


def overlap(one: Rect, other: Rect) -> bool:
    """Whether two upright boxes share anything."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
