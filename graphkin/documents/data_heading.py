"""The data at the head of a sheet: a small table of values, and in words what is said besides."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import Datum, data
from graphkin.drawing.areas import AREA
from graphkin.drawing.marks import LineMark, Mark, Text, box
from graphkin.drawing.richtext import are_clear, extent, flowed, words_of
from graphkin.text.errors import PageError, Problem

NAME = "data"
"""The name of the marks of the data."""
LETTERS, ROW, BASE, PAD = 2.5, 4.5, 3.1, 3.0
"""Of the table in mm: letters, least rows, least depth of a baseline, room beside the letters."""
CLEAR = 0.3
"""How far signs of the table stay from its lines above and below, in mm."""
ABOVE = 2.6
"""How far the table begins above the first line's foot, in mm."""
GAP = 5.0
"""Distance of the words from the table in mm."""
BESIDE = {1: (ROW, 2.75), 2: (ROW, 0.5), 3: (3.6, -0.2)}
"""The distance in mm of so many lines beside the table, of which there are three at most, and how
far below the first line's foot they begin: amid the table, level with its rows, or as high."""
SPACED, CLOSE = 4.2, 3.85
"""Distance of two lines of data without a table, and of more, in mm."""
SMALL, NEAR = 2.0, (3.3, 2.8, 2.45)
"""Height of letters in mm where drawings leave no room for larger ones, and distances of lines."""
AIR = 1.0
"""How much farther from data of more lines the captions stand, in mm: both may be of large letters
then."""
SHORTER = (0.0, *range(4, 49, 4))
"""By how much lines are made shorter, in mm, until no signs touch."""

LOWEST = AREA[1] - 7.2
"""The foot of the lowest line in mm: below it stand the captions, of two lines where they must."""


def data_heading(
    drawing: Drawing, view: str, x: float, y: float, spare: Callable[[], float] = float
) -> list[Mark]:
    """The data from a point on, whose y is the foot of the first line.

    ``spare`` is the height in mm that the drawings leave free below the captions, into which data
    of many lines reach, and the captions with them. Raises PageError where they do not fit.
    """
    found = data(drawing, solved=view != "task", laws=True)
    return in_table(found, x, y) or in_lines(drawing, found, x, y, spare)


def in_table(found: Sequence[Datum], x: float, y: float) -> list[Mark]:
    """A table of the values with the rest beside it; nothing where there is no room for it."""
    valued = [datum for datum in found if datum.value]
    said = [datum.remark for datum in found if datum.remark]
    widths = [
        PAD + max(extent(markup, LETTERS)[0] for markup in (datum.name, datum.value))
        for datum in valued
    ]
    rows = [
        row_for([getattr(datum, part) for datum in valued]) for part in ("name", "value") if valued
    ]
    if y - ABOVE + sum(height for height, _ in rows) > LOWEST:
        return []
    left = x + sum(widths) + GAP
    room = AREA[2] - 3 - left
    if not valued or room < max((extent(piece, LETTERS)[0] for piece in said), default=0.0):
        return []
    lines = flowed(said, "; ", room, LETTERS)
    leading, low = BESIDE.get(len(lines), (0.0, 0.0))
    if lines and not (leading and are_clear(lines, LETTERS, leading)):
        return []
    return [
        *ruled(valued, widths, rows, x, y - ABOVE),
        *(
            Text(left, y + low + leading * i, line, "caption", LETTERS, name=NAME)
            for i, line in enumerate(lines)
        ),
    ]


def row_for(texts: Sequence[str]) -> tuple[float, float]:
    """The height of a row of texts, and how deep their baseline is in it, in mm."""
    _, tops, bottoms = zip(*(extent(text, LETTERS) for text in texts), strict=True)
    base = max(BASE, CLEAR - min(tops))
    return max(ROW, base + max(bottoms) + CLEAR), base


def ruled(
    valued: Sequence[Datum],
    widths: Sequence[float],
    rows: Sequence[tuple[float, float]],
    x: float,
    top: float,
) -> Iterator[Mark]:
    """The table: names over values, in rows of a height with their baselines."""
    (upper, named), (lower, told) = rows
    middle, low, right = top + upper, top + upper + lower, x + sum(widths)
    yield box(x, top, right - x, upper, "shade")
    for y in (top, middle, low):
        yield LineMark(x, y, right, y, "panel")
    yield LineMark(x, top, x, low, "panel")
    for datum, width in zip(valued, widths, strict=True):
        for y, markup in ((top + named, datum.name), (middle + told, datum.value)):
            yield Text(x + width / 2, y, markup, "table", LETTERS, "middle", NAME)
        x += width
        yield LineMark(x, top, x, low, "panel")


def in_lines(
    drawing: Drawing, found: Sequence[Datum], x: float, y: float, spare: Callable[[], float]
) -> list[Mark]:
    """All data in three lines, which end where their signs are clear of each other.

    Where they need more, these reach down as far as the drawings leave room; else they are of
    smaller lettering. Long data end within a line only there. All stay clear of the fields'
    captions, also where a title of two lines moves them down.
    """
    first, *pieces = (datum.said for datum in found)
    pieces = [f"{drawing.words('page.data')}: {first}", *pieces]
    width = AREA[2] - x - 3
    parted = words_of("; ".join(pieces))
    for i, (height, leading, room) in enumerate(looks(y, spare)):
        for told, mark in ((pieces, "; "), (parted, " "))[: 1 + (i > 1)]:
            lines = spread(told, mark, width, height, leading)
            if len(lines) <= room and all(extent(line, height)[0] <= width for line in lines):
                return [
                    Text(x, y + row * leading, line, "caption", height, name=NAME)
                    for row, line in enumerate(lines)
                ]
    raise PageError(
        Problem(
            "data",
            f"does not fit: {len(lines)} lines of small lettering",
            "fewer lines above the drawings",
            "shorten names and notes, or split the scene",
        )
    )


def spread(
    told: Sequence[str], mark: str, width: float, height: float, leading: float
) -> list[str]:
    """Pieces in lines no longer than a width, and so long that their signs are clear if they can
    be."""
    every = (flowed(told, mark, width - less, height) for less in SHORTER)
    first = next(every)
    return next((lines for lines in (first, *every) if are_clear(lines, height, leading)), first)


def looks(y: float, spare: Callable[[], float]) -> Iterator[tuple[float, float, int]]:
    """How lines from a foot on may look: their letters, their distance in mm, how many there are.

    First as they are wished, then down to the drawings, then of small lettering.
    """
    yield LETTERS, SPACED, 2
    yield LETTERS, CLOSE, rows(LOWEST - y, CLOSE)
    free = spare() - AIR
    yield LETTERS, CLOSE, rows(LOWEST + free - y, CLOSE)
    yield from ((SMALL, leading, rows(LOWEST - y, leading)) for leading in NEAR)
    yield SMALL, NEAR[1], rows(LOWEST + free - y, NEAR[1])


def height_beyond(marks: Sequence[Mark]) -> float:
    """How much more height data take up than stands above the fields, in mm."""
    low = max((mark.y for mark in marks if isinstance(mark, Text)), default=0.0)
    return low - LOWEST + AIR if low > LOWEST else 0.0


def rows(height: float, leading: float) -> int:
    """How many lines stand between the feet of the first and of the lowest."""
    return int(height / leading + 1e-9) + 1
