"""Small pictures beside a drawing: its shortest vectors, and where much meets, enlarged."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count
from math import dist, hypot, sqrt
from typing import NamedTuple, TypeGuard

from msgspec.structs import replace

from graphkin.construction.core.layout import centre
from graphkin.construction.core.plan_marks import DOT
from graphkin.drawing.field import XY
from graphkin.drawing.free_space import FreeDisc, Space
from graphkin.drawing.label import Label, segment_of
from graphkin.drawing.labels import HELPERS, FieldContent, free_ones
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, moved, style_class
from graphkin.drawing.place_labels import finished
from graphkin.drawing.placement import Spot
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbols import SHORT, head

SHOWN = (*VECTORS, "construction", "link")
"""The classes of lines that a detail shows."""
CROWDED, ENLARGED = 5, (5, 10)
"""How many times a place where much meets is enlarged, and how many times a short vector."""
RADIUS = 16.0
"""Radius of a detail circle in mm."""
LETTERS = 2.5
"""Height of the letters of a detail in mm, whose indices are as high as the smallest lettering."""
SEEN = 5.0
"""Length in mm that a part of a vector must have in a detail to be named there."""
WHOLE = 6
"""Priority of the name of a vector that lies whole in a detail."""
TOO_SHORT = 0.5
"""Vectors shorter than this, in mm, are not worth a detail."""


def length_of(line: LineMark) -> float:
    """Length of a line in mm."""
    return hypot(line.x2 - line.x1, line.y2 - line.y1)


class Source(NamedTuple):
    """What is to be enlarged: the middle of a small circle, and how many times."""

    at: XY
    times: int

    def circle(self) -> CircleMark:
        """The small circle, which labels keep clear of."""
        return CircleMark(*self.at, RADIUS / self.times, "detail", "detail")


def sources(board: FieldContent) -> Iterator[Source]:
    """The place of a drawing's first short vector worth a detail, and where much meets apart."""
    for mark in board.marks:
        if is_vector(mark) and TOO_SHORT <= length_of(mark) < SHORT:
            times = ENLARGED[0] if length_of(mark) * ENLARGED[0] >= 4 else ENLARGED[1]
            at = (mark.x1 + mark.x2) / 2, (mark.y1 + mark.y2) / 2
            if all(dist(at, crowd) > RADIUS / CROWDED for crowd in board.crowds):
                yield Source(at, times)
            break
    yield from (Source(at, CROWDED) for at in board.crowds)


class FieldMarks(NamedTuple):
    """The marks of a finished field, apart from these its details, and how many times each of them
    enlarges.
    """

    marks: list[Mark]
    details: list[Mark]
    times: list[int]


class Detail(NamedTuple):
    """What a detail shows: the board that it belongs to, its source, and a board with the part
    enlarged, aside of the page.
    """

    of: FieldContent
    source: Source
    board: FieldContent


def with_detail(*boards: FieldContent) -> list[Mark]:
    """Finished fields, with detail circles for very short vectors where there is room for them."""
    return [mark for each in parted(*boards) for mark in (*each.marks, *each.details)]


def parted(*boards: FieldContent) -> list[FieldMarks]:
    """Finished fields, and apart from each its detail circles; no marks where there is none.

    The letters of points that find no place in a field are those of a detail about them, where
    there is room for it.
    """
    before = [copied(board) for board in boards]
    fields = enlarged(boards)
    lost = [[x for x in board.unplaced if segment_of(x) is None] for board in boards]
    if not any(lost):
        return fields
    for board, letters in zip(before, lost, strict=True):
        for point in (letter.point for letter in letters):
            if all(dist(point, crowd) > RADIUS / CROWDED - DOT for crowd in board.crowds):
                board.crowds.append(point)
    tried = enlarged(before, lost)
    shown = [{m.markup for m in each.details if isinstance(m, Text)} for each in tried]
    both = zip(lost, shown, strict=True)
    is_told = all(letter.markup in said for letters, said in both for letter in letters)
    return tried if is_told else fields


def copied(board: FieldContent) -> FieldContent:
    """The same field, to be finished by itself."""
    return replace(
        board, marks=[*board.marks], labels=[*board.labels], crowds=[*board.crowds], unplaced=[]
    )


def enlarged(
    boards: Sequence[FieldContent], lost: Sequence[Sequence[Label]] = ()
) -> list[FieldMarks]:
    """Finished fields and their details; the labels that are ``lost`` in each are its details'."""
    needed = [label for letters in lost for label in letters]
    found = [(board, source) for board in boards for source in sources(board)]
    details = [
        Detail(board, source, enlarged_part(board, source, at, needed))
        for (board, source), at in zip(found, aside(boards), strict=False)
    ]
    for board, source in found:
        board.marks.append(source.circle())
    for board, letters in zip(boards, lost, strict=bool(lost)):
        board.labels = [label for label in board.labels if label not in letters]
    every, places = finished(boards, [detail.board for detail in details])
    fields = [FieldMarks(marks, [], []) for marks in every]
    for detail, spots in zip(details, places, strict=True):
        marks, shown, times = fields[[board is detail.of for board in boards].index(True)]
        more = put_in_disc([*marks, *shown], detail, spots)
        shown += more
        if more:
            times.append(detail.source.times)
        else:
            marks.remove(detail.source.circle())
    return fields


def aside(boards: Sequence[FieldContent]) -> Iterator[XY]:
    """Places for details, one below another, where they overlap neither boards nor each other."""
    x, y = max(board.rect[2] for board in boards) + RADIUS, boards[0].rect[1] + RADIUS
    for nth in count():
        yield x + 1, y + nth * (2 * RADIUS + 1)


def put_in_disc(marks: Sequence[Mark], detail: Detail, spots: Sequence[Spot]) -> list[Mark]:
    """A detail where there is room for it among the marks of its field; else nothing."""
    disc = Space(marks, detail.of.rect).disc(detail.source.at, RADIUS + 4)
    if disc is None:
        return []
    x, y = centre(detail.board.rect)
    drawn = [*detail.board.marks, *free_ones(detail.board, spots)]
    shown = [moved(mark, disc.at[0] - x, disc.at[1] - y) for mark in drawn]
    return [*shown, *pointing(disc, detail.source)]


def pointing(disc: FreeDisc, source: Source) -> Iterator[Mark]:
    """The line from a small circle to its large one, and how many times that enlarges."""
    small, (x, y) = RADIUS / source.times, source.at
    far = dist(disc.at, source.at)
    u, v = (disc.at[0] - x) / far, (disc.at[1] - y) / far
    if disc.in_sight:
        end = disc.at[0] - RADIUS * u, disc.at[1] - RADIUS * v
        yield LineMark(x + small * u, y + small * v, *end, "detail")
    beneath = disc.at[1] + RADIUS + 3.6 if v > 0 else disc.at[1] - RADIUS - 1.1
    yield Text(disc.at[0], beneath, scale_words(source.times), "caption", 2.5, "middle")


def scale_words(times: int) -> str:
    """How many times a detail enlarges, as its scale."""
    return f"{times}:1"


def enlarged_part(
    board: FieldContent, source: Source, at: XY, needed: Sequence[Label] = ()
) -> FieldContent:
    """What lies in a small circle, drawn again in a large one with its middle at a place.

    Labels that are ``needed`` there take a leader where they have no place beside their point.
    """
    x, y = at
    part = FieldContent((x - RADIUS, y - RADIUS, x + RADIUS, y + RADIUS))
    part.marks.append(CircleMark(x, y, RADIUS, "detail"))
    for mark in board.marks:
        shown = style_class(mark) in SHOWN
        if isinstance(mark, LineMark) and shown and passes(mark, source.at, RADIUS / source.times):
            draw_part(part, mark, source, at)
    part.labels = [*named(board, source, at, needed)]
    part.marks += dots(part.labels)
    return part


def passes(line: LineMark, centre: XY, radius: float) -> bool:
    """True when a line's carrier passes through a circle."""
    dx, dy = line.x2 - line.x1, line.y2 - line.y1
    across = dx * (centre[1] - line.y1) - dy * (centre[0] - line.x1)
    return abs(across) <= radius * hypot(dx, dy)


def draw_part(board: FieldContent, line: LineMark, source: Source, at: XY) -> None:
    """The part of a line that lies in the small circle, enlarged, with its head if that is in."""
    found = within(line, source.at, RADIUS / source.times)
    if found is None:
        return
    (x0, y0), (x1, y1) = (larger(end, source, at) for end in found)
    style = style_class(line)
    board.marks.append(LineMark(x0, y0, x1, y1, f"{style} detail"))
    whole = found[1] == (line.x2, line.y2)
    if style in VECTORS and whole and hypot(x1 - x0, y1 - y0) >= SHORT:
        board.marks.append(head((x0, y0), (x1, y1), style))


def within(line: LineMark, centre: XY, radius: float) -> tuple[XY, XY] | None:
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


def larger(point: XY, source: Source, at: XY) -> XY:
    """Where a point of the small circle lies in the large one, which has its middle at a place."""
    (x, y), times = source
    return at[0] + times * (point[0] - x), at[1] + times * (point[1] - y)


def named(board: FieldContent, source: Source, at: XY, needed: Sequence[Label]) -> Iterator[Label]:
    """The names of the vectors and points of a small circle; those that lie whole in it come first.

    The others are left out where they find no place.
    """
    small = RADIUS / source.times
    drawn = {m.name: ((m.x1, m.y1), (m.x2, m.y2)) for m in board.marks if is_vector(m)}
    for label in board.labels:
        ends = segment_of(label) or drawn.get(label.name)
        bare = replace(label, height=LETTERS, name="", step=None)
        if ends is None:
            if label.cls not in HELPERS and dist(label.point, source.at) <= small:
                subject = larger(label.point, source, at)
                yield replace(bare, subject=subject, radius=DOT, optional=label not in needed)
        elif label.cls in VECTORS:
            part = within(LineMark(*ends[0], *ends[1], ""), source.at, small)
            if part is None:
                continue
            whole, (first, last) = part == ends, (larger(end, source, at) for end in part)
            if whole or dist(first, last) >= SEEN:
                bare = replace(bare, subject=(first, last), radius=0.0, led=False)
                yield replace(bare, priority=WHOLE if whole else 0, optional=not whole)


def dots(labels: Sequence[Label]) -> Iterator[Mark]:
    """The points of a detail whose letters are sought."""
    for label in labels:
        if segment_of(label) is None:
            yield CircleMark(*label.point, DOT, f"point {label.cls} detail".replace("  ", " "))


def is_vector(mark: Mark) -> TypeGuard[LineMark]:
    """True for the line of a vector."""
    return isinstance(mark, LineMark) and style_class(mark) in VECTORS
