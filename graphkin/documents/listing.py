"""The numbered sentences of the construction below the drawings, in lettering that fits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import accumulate, chain, pairwise

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sentences import sentences
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import are_clear, flowed, words_of
from graphkin.text.errors import Message, PageError, message

HEIGHT, MOST, LEAST = 2.5, 5.6, 3.6
"""Height of lettering, and the largest and the least distance of its lines, in mm."""
SHORTER = (0.0, 4.0, 8.0, 12.0, 16.0)
"""Reductions of line width tried in mm, until no characters touch."""
FINE = 0.05
"""Step in mm by which lines are set closer until they fit."""
ROUNDING = 1e-6
"""Tolerance of baselines, in mm."""
PARTED = 4.6
"""Distance of the lines of a construction that continues on another sheet, in mm."""
INDENT = 7.0
"""Start of sentences after their numbers, in mm."""

Numbered = tuple[str, str]
"""The number of a sentence, and a line; the number is empty on continuation lines."""


def listed(drawing: Drawing, x: float, y: float, width: float, bottom: float) -> list[Mark]:
    """The sentences from a place on, with their lines as far apart as there is room.

    Where characters of neighbouring lines would touch, these lines are farther apart than others,
    or lines are shortened. Raises PageError where there are too many lines.
    """
    for less in SHORTER:
        flown = both_ways(drawing, x, width - less)
        for leading in distances():
            above = int((drawing.paper.marked[1] - y) / leading + 1)
            lines = lined(*flown, above)
            if y + (len(lines) - 1) * leading <= bottom:
                rows = clear_rows([line for _, line in lines], y, leading, bottom)
                held = [row <= drawing.paper.marked[1] for row in rows[:above]]
                if rows and all(held):
                    return written(lines, x, rows)
                break
    raise too_long(len(lines), message("ask for less on one sheet"))


def first_part(
    drawing: Drawing, x: float, y: float, width: float, bottom: float
) -> tuple[list[Mark], int]:
    """As many whole sentences as leave a line free below them, and their number.

    The free line says that the rest is on the continuation sheet.
    """
    leading = PARTED
    wide, narrow = both_ways(drawing, x, width)
    above = int((drawing.paper.marked[1] - y) / leading + 1)
    room = int((bottom - y) / leading)
    said = max(
        number
        for number in range(len(wide))
        if len(lined(wide[:number], narrow[:number], above)) <= room
    )
    lines = lined(wide[:said], narrow[:said], above)
    lines.append(("", drawing.words("page.goes_on" if said else "page.moved")))
    return written(lines, x, rows_of(y, leading, len(lines))), said


def around_tables(
    drawing: Drawing, left: Rect, below: Rect | None, part: tuple[list[Mark], int]
) -> tuple[list[Mark], int]:
    """The sentences in a column and on below the tables, and how many of them fit there.

    A line at the end of the column says where they go on. ``part`` are the sentences that the
    column holds by itself, which stay where the room below the tables is no help.
    """
    said = [words_of(sentence.markup) for sentence in sentences(drawing)]
    if below is None:
        return part
    sets = [
        [flowed(words, " ", end - start - INDENT, HEIGHT) for words in said]
        for start, _, end, _ in (left, below)
    ]

    def held(leading: float, low: float) -> tuple[list[Mark], int]:
        columns = [(*left[:3], left[3] - leading), (*below[:3], below[3] - low)]
        marks, after = filled(sets, columns, leading, 0)
        ends = (mark.y for mark in marks if isinstance(mark, Text) and mark.x < below[0])
        at = left[0] + INDENT, max(ends, default=left[1]) + leading
        return [*marks, Text(*at, drawing.words("page.goes_below"), "caption", HEIGHT)], after

    if held(LEAST, 0.0)[1] == len(said):
        every = (held(leading, 0.0) for leading in distances())
        return next((marks, after) for marks, after in every if after == len(said))
    marks, after = held(PARTED, PARTED)
    if after <= part[1]:
        return part
    ends = (mark.y for mark in marks if isinstance(mark, Text) and mark.x > below[0])
    at = below[0] + INDENT, max(ends, default=below[1] - PARTED) + PARTED
    return [*marks, Text(*at, drawing.words("page.goes_on"), "caption", HEIGHT)], after


def rows_of(y: float, leading: float, count: int) -> list[float]:
    """The baselines of some lines at one distance."""
    return [y + i * leading for i in range(count)]


def clear_rows(lines: Sequence[str], y: float, leading: float, bottom: float) -> list[float]:
    """The baselines of lines whose characters do not touch; empty where there is no room.

    The lines are at one distance if possible, else each as far below the one above as it must be.
    """
    if are_clear(lines, HEIGHT, leading):
        return rows_of(y, leading, len(lines))
    least = sorted(distances())
    gaps = [
        next((gap for gap in least if are_clear([*pair], HEIGHT, gap)), MOST)
        for pair in pairwise(lines)
    ]
    spare = bottom - y - sum(gaps)
    return [*accumulate((gap + spare / len(gaps) for gap in gaps), initial=y)] if spare >= 0 else []


def both_ways(drawing: Drawing, x: float, width: float) -> tuple[list[list[str]], list[list[str]]]:
    """The lines of each sentence at full width, and clear of the centring mark."""
    said = [words_of(sentence.markup) for sentence in sentences(drawing)]
    return (
        [flowed(words, " ", width - INDENT, HEIGHT) for words in said],
        [
            flowed(words, " ", min(width, drawing.paper.marked[0] - x) - INDENT, HEIGHT)
            for words in said
        ],
    )


def written(lines: Sequence[Numbered], x: float, rows: Sequence[float]) -> list[Mark]:
    """Lines of sentences with their numbers before them, at some baselines."""
    marks: list[Mark] = []
    for y, (number, line) in zip(rows, lines, strict=True):
        if number:
            marks.append(Text(x + 5, y, number, "caption", HEIGHT, "end"))
        marks.append(Text(x + INDENT, y, line, "caption", HEIGHT))
    return marks


def in_columns(drawing: Drawing, columns: Sequence[Rect], begun: int) -> list[Mark]:
    """The sentences of a continuation sheet, column by column, none of them divided.

    The first ``begun`` sentences are left out. Raises PageError where there are too many.
    """
    said = [words_of(sentence.markup) for sentence in sentences(drawing)]
    sets = [
        [flowed(words, " ", right - left - INDENT, HEIGHT) for words in said]
        for left, _, right, _ in columns
    ]
    for leading in distances():
        marks, after = filled(sets, columns, leading, begun)
        if after == len(said):
            return marks
    raise too_long(
        sum(map(len, sets[0])), message("view the steps, a sentence on each page: --view steps")
    )


def on_sheets(drawing: Drawing, columns: Sequence[Rect], begun: int) -> Iterator[list[Mark]]:
    """The sentences after the first ``begun``, on as many sheets of equal columns as they need.

    A sentence longer than a column is divided.
    """
    widths = [right - left - INDENT for left, _, right, _ in columns]
    room = int(min(low - top for _, top, _, low in columns) / MOST) + 1
    parts: list[tuple[str, list[str]]] = []
    for number, sentence in enumerate(sentences(drawing)[begun:], begun + 1):
        lines = flowed(words_of(sentence.markup), " ", min(widths), HEIGHT)
        starts = range(0, len(lines), room)
        parts += [(f"{number}." * (k == 0), lines[k : k + room]) for k in starts]
    numbers = [number for number, _ in parts]
    whole = [words_of(" ".join(lines)) for _, lines in parts]
    sets = [[flowed(words, " ", width, HEIGHT) for words in whole] for width in widths]
    after = 0
    while after < len(parts):
        marks, after = filled(sets, columns, MOST, after, numbers)
        yield marks


def filled(
    sets: Sequence[list[list[str]]],
    columns: Sequence[Rect],
    leading: float,
    begun: int,
    numbers: Sequence[str] = (),
) -> tuple[list[Mark], int]:
    """Columns filled with sentences from ``begun`` on, and the first sentence without room.

    ``numbers`` are the labels of the sentences where sentences are divided.
    """
    marks: list[Mark] = []
    place, last = 0, list[tuple[float, str]]()
    for number in range(begun, len(sets[0])):
        while True:
            lines, (left, top, _, low) = sets[place][number], columns[place]
            rows = rows_after(last, lines, top, leading)
            if rows[-1] <= low + ROUNDING:
                break
            place, last = place + 1, []
            if place == len(columns):
                return marks, number
        if number_text := numbers[number] if numbers else f"{number + 1}.":
            marks.append(Text(left + 5, rows[0], number_text, "caption", HEIGHT, "end"))
        for y, line in zip(rows, lines, strict=True):
            marks.append(Text(left + INDENT, y, line, "caption", HEIGHT))
        last = [(rows[-1], lines[-1])]
    return marks, len(sets[0])


def rows_after(
    last: Sequence[tuple[float, str]], lines: Sequence[str], top: float, leading: float
) -> list[float]:
    """The baselines of lines below the ``last`` line of their column, or from its top on."""
    rows: list[float] = []
    for line in lines:
        rows.append(last[0][0] + clear_gap(last[0][1], line, leading) if last else top)
        last = [(rows[-1], line)]
    return rows


@lru_cache(maxsize=4096)
def clear_gap(one: str, other: str, leading: float) -> float:
    """The distance of two lines: the leading, or as much more as keeps their characters apart."""
    wider = (gap for gap in sorted(distances()) if gap > leading)
    gaps = chain([leading], wider)
    return next((gap for gap in gaps if are_clear([one, other], HEIGHT, gap)), leading)


def too_long(lines: int, hint: Message) -> PageError:
    """The problem of a construction with too many lines."""
    found, expected = (
        message("does not fit: {lines} lines", lines=lines),
        message("a shorter construction"),
    )
    return PageError.at("construction", found, expected, hint)


def distances() -> Iterator[float]:
    """Distances of lines from the largest to the least."""
    for i in range(round((MOST - LEAST) / FINE) + 1):
        yield round(MOST - i * FINE, 3)


def lined(wide: list[list[str]], narrow: list[list[str]], above: int) -> list[Numbered]:
    """The lines of sentences; a sentence that extends below ``above`` lines takes its narrow form.

    The narrow form stays clear of the centring mark.
    """
    lines: list[Numbered] = []
    for number, (own, short) in enumerate(zip(wide, narrow, strict=True), 1):
        chosen = own if len(lines) + len(own) <= above else short
        lines += [(f"{number}." if i == 0 else "", line) for i, line in enumerate(chosen)]
    return lines
