"""The data at the head of a sheet: a small table of values, and in words what is said besides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import Datum, data
from graphkin.drawing.areas import AREA
from graphkin.drawing.marks import LineMark, Mark, Text, box
from graphkin.drawing.richtext import are_clear, extent, flowed, words_of
from graphkin.text.errors import PageError, Problem

NAME = "data"
"""The name of the marks of the data."""
LETTERS, ROW, BASE, PAD = 2.5, 4.5, 3.1, 3.0
"""Of the table in mm: letters, rows, how far below its upper line these stand, room beside them."""
ABOVE = 2.6
"""How far the table begins above the first line's foot, in mm."""
GAP = 5.0
"""Distance of the words from the table in mm."""
BESIDE = {1: (ROW, 2.75), 2: (ROW, 0.5), 3: (3.6, -0.2)}
"""The distance in mm of so many lines beside the table, of which there are three at most, and how
far below the first line's foot they begin: amid the table, level with its rows, or as high."""
LINES = ((2.5, 4.2, 2, False), (2.5, 3.85, 3, True), (1.8, 3.2, 3, False), (1.8, 2.6, 4, False))
"""How data without a table may look: height of letters and distance of lines in mm, lines at most,
and whether these are so near that signs may touch."""
SHORTER = (0.0, *range(4, 49, 4))
"""By how much lines are made shorter, in mm, until no signs touch."""

LOWEST = AREA[1] - 7.4
"""The foot of the lowest line in mm: below it stand the captions, of two lines where they must."""


def data_heading(drawing: Drawing, view: str, x: float, y: float) -> list[Mark]:
    """The data from a point on, whose y is the foot of the first line.

    Raises PageError where they do not fit.
    """
    found = data(drawing, solved=view != "task")
    return in_table(found, x, y) or in_lines(drawing, found, x, y)


def in_table(found: Sequence[Datum], x: float, y: float) -> list[Mark]:
    """A table of the values with the rest beside it; nothing where there is no room for it."""
    valued = [datum for datum in found if datum.value]
    said = [datum.remark for datum in found if datum.remark]
    widths = [
        PAD + max(extent(markup, LETTERS)[0] for markup in (datum.name, datum.value))
        for datum in valued
    ]
    left = x + sum(widths) + GAP
    room = AREA[2] - 3 - left
    if not valued or room < max((extent(piece, LETTERS)[0] for piece in said), default=0.0):
        return []
    lines = flowed(said, "; ", room, LETTERS)
    leading, low = BESIDE.get(len(lines), (0.0, 0.0))
    if lines and not (leading and are_clear(lines, LETTERS, leading)):
        return []
    return [
        *ruled(valued, widths, x, y - ABOVE),
        *(
            Text(left, y + low + leading * i, line, "caption", LETTERS, name=NAME)
            for i, line in enumerate(lines)
        ),
    ]


def ruled(valued: Sequence[Datum], widths: Sequence[float], x: float, top: float) -> Iterator[Mark]:
    """The table: names over values."""
    low, right = top + 2 * ROW, x + sum(widths)
    yield box(x, top, right - x, ROW, "shade")
    for y in (top, top + ROW, low):
        yield LineMark(x, y, right, y, "panel")
    yield LineMark(x, top, x, low, "panel")
    for datum, width in zip(valued, widths, strict=True):
        for y, markup in ((top, datum.name), (top + ROW, datum.value)):
            yield Text(x + width / 2, y + BASE, markup, "table", LETTERS, "middle", NAME)
        x += width
        yield LineMark(x, top, x, low, "panel")


def in_lines(drawing: Drawing, found: Sequence[Datum], x: float, y: float) -> list[Mark]:
    """All data in two lines, or in three, of smaller lettering only where signs would touch.

    Three lines end where their signs are clear of each other. Lines end within a datum only where
    nothing else does: long data have room beside the drawings then.
    They stay clear of the fields' captions, also where a title of two lines moves them down.
    """
    first, *pieces = (datum.said for datum in found)
    pieces = [f"{drawing.words('page.data')}: {first}", *pieces]
    width = AREA[2] - x - 3
    parted = words_of("; ".join(pieces))
    for told, mark, (height, leading, room, near) in (
        *((pieces, "; ", look) for look in LINES),
        *((parted, " ", look) for look in LINES if look[0] < LETTERS),
    ):
        for less in SHORTER if near else SHORTER[:1]:
            lines = flowed(told, mark, width - less, height)
            fits = len(lines) <= room and y + (len(lines) - 1) * leading <= LOWEST
            if fits and (not near or are_clear(lines, height, leading)):
                return [
                    Text(x, y + i * leading, line, "caption", height, name=NAME)
                    for i, line in enumerate(lines)
                ]
    raise PageError(
        Problem(
            "data",
            f"does not fit: {len(lines)} lines of small lettering",
            "four lines above the drawing",
            "shorten names and notes, or split the scene",
        )
    )
