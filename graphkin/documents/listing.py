"""The numbered sentences of the construction below the drawings, in lettering that fits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sentences import sentences
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import are_clear, flowed, words_of
from graphkin.text.errors import Message, PageError, Problem, message

HEIGHT, MOST, LEAST = 2.5, 5.6, 3.6
"""Height of lettering, and the largest and the least distance of its lines, in mm."""
SHORTER = (0.0, 4.0, 8.0, 12.0, 16.0)
"""Reductions of line width tried in mm, until no characters touch."""
FINE = 0.05
"""Step in mm by which lines are set closer until they fit."""
PARTED = 4.6
"""Distance of the lines of a construction that continues on another sheet, in mm."""
INDENT = 7.0
"""Start of sentences after their numbers, in mm."""

Numbered = tuple[str, str]
"""The number of a sentence, and a line; the number is empty on continuation lines."""


def listed(drawing: Drawing, x: float, y: float, width: float, bottom: float) -> list[Mark]:
    """The sentences from a place on, with their lines as far apart as there is room.

    Where characters of neighbouring lines would touch, lines are shortened. Raises PageError where
    there are too many lines.
    """
    for less in SHORTER:
        flown = both_ways(drawing, x, width - less)
        for leading in distances():
            lines = lined(*flown, int((drawing.paper.marked[1] - y) / leading + 1))
            if y + (len(lines) - 1) * leading <= bottom:
                if are_clear([line for _, line in lines], HEIGHT, leading):
                    return written(lines, x, y, leading)
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
    return written(lines, x, y, leading), said


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


def written(lines: Sequence[Numbered], x: float, y: float, leading: float) -> list[Mark]:
    """Lines of sentences with their numbers before them, from a place on."""
    marks: list[Mark] = []
    for i, (number, line) in enumerate(lines):
        if number:
            marks.append(Text(x + 5, y + i * leading, number, "caption", HEIGHT, "end"))
        marks.append(Text(x + INDENT, y + i * leading, line, "caption", HEIGHT))
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
    place, y = 0, columns[0][1]
    for number in range(begun, len(sets[0])):
        while y + (len(sets[place][number]) - 1) * leading > columns[place][3]:
            place += 1
            if place == len(columns):
                return marks, number
            y = columns[place][1]
        x = columns[place][0]
        if number_text := numbers[number] if numbers else f"{number + 1}.":
            marks.append(Text(x + 5, y, number_text, "caption", HEIGHT, "end"))
        for line in sets[place][number]:
            marks.append(Text(x + INDENT, y, line, "caption", HEIGHT))
            y += leading
    return marks, len(sets[0])


def too_long(lines: int, hint: Message) -> PageError:
    """The problem of a construction with too many lines."""
    found, expected = (
        message("does not fit: {lines} lines", lines=lines),
        message("a shorter construction"),
    )
    return PageError(Problem("construction", found, expected, hint))


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
