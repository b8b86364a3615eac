"""Small pictures next to a drawing: its shortest vectors and its crowded places, enlarged."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count, pairwise, takewhile
from math import dist, hypot, sqrt
from typing import NamedTuple, TypeGuard

from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import Centre, RelativeCentre
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import centre
from graphkin.construction.core.naming import TINY
from graphkin.construction.core.paper_canvas import DOT, WITHIN, ring
from graphkin.construction.links.link_shapes import corners_of, farthest, places_of
from graphkin.drawing.field import XY, Field
from graphkin.drawing.free_space import FreeDisc, Space
from graphkin.drawing.labels import (
    HELPERS,
    FieldContent,
    Label,
    finished,
    free_ones,
    segment_of,
    spots_on,
)
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, box, moved, style_class
from graphkin.drawing.placement import Spot
from graphkin.drawing.scale import Scales, extent_of, preferred
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbols import SHORT, head

SHOWN = (*VECTORS, "construction", "link")
"""The classes of lines that a detail shows."""
CROWDED, ENLARGED = 5, (5, 10)
"""Enlargement of a crowded place, and enlargements of a short vector."""
RADIUS = 16.0
"""Radius of a detail circle in mm."""
LETTERS = 2.5
"""Height of the letters of a detail in mm, with indices as high as the smallest lettering."""
SEEN = 5.0
"""Least length in mm of a part of a vector in a detail for it to be named there."""
WHOLE = 6
"""Priority of the name of a vector that lies entirely in a detail."""
TOO_SHORT = 0.5
"""Length in mm below which vectors are not worth a detail."""


def length_of(line: LineMark) -> float:
    """Length of a line in mm."""
    return hypot(line.x2 - line.x1, line.y2 - line.y1)


class Source(NamedTuple):
    """The source of a detail: the centre of a small circle, and the enlargement."""

    at: XY
    times: int

    def circle(self) -> CircleMark:
        """The small circle, which labels keep clear of."""
        return CircleMark(*self.at, RADIUS / self.times, "detail", "detail")


def sources(board: FieldContent) -> Iterator[Source]:
    """The sources of a drawing: its first short vector, and crowded places elsewhere."""
    if not board.detailed:
        return
    for mark in board.marks:
        if is_vector(mark) and TOO_SHORT <= length_of(mark) < SHORT:
            times = ENLARGED[0] if length_of(mark) * ENLARGED[0] >= 4 else ENLARGED[1]
            at = (mark.x1 + mark.x2) / 2, (mark.y1 + mark.y2) / 2
            if all(dist(at, crowd) > RADIUS / CROWDED for crowd in board.crowds):
                yield Source(at, times)
            break
    yield from (Source(at, CROWDED) for at in board.crowds)


class FieldMarks(NamedTuple):
    """The marks of a finished field, its details, and the enlargement of each detail."""

    marks: list[Mark]
    details: list[Mark]
    times: list[int]


class Detail(NamedTuple):
    """A detail: its field, its source, and a board with the enlarged part, off the page."""

    of: FieldContent
    source: Source
    board: FieldContent


def with_detail(*boards: FieldContent) -> list[Mark]:
    """Finished fields, with detail circles for very short vectors where there is room."""
    return [mark for each in parted(*boards) for mark in (*each.marks, *each.details)]


def parted(*boards: FieldContent) -> list[FieldMarks]:
    """Finished fields with their detail circles kept separate.

    The letters of points without a place in a field go into a detail around the points, where there
    is room for one.
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
    is_mentioned = all(letter.markup in said for letters, said in both for letter in letters)
    return tried if is_mentioned else fields


def copied(board: FieldContent) -> FieldContent:
    """A copy of a field that can be finished by itself."""
    return replace(
        board, marks=[*board.marks], labels=[*board.labels], crowds=[*board.crowds], unplaced=[]
    )


def enlarged(
    boards: Sequence[FieldContent], lost: Sequence[Sequence[Label]] = ()
) -> list[FieldMarks]:
    """Finished fields and their details; the ``lost`` labels of each field go into its details."""
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
    """Places for details, one below another, clear of the boards and of each other."""
    x, y = max(board.rect[2] for board in boards) + RADIUS, boards[0].rect[1] + RADIUS
    for nth in count():
        yield x + 1, y + nth * (2 * RADIUS + 1)


def put_in_disc(marks: Sequence[Mark], detail: Detail, spots: Sequence[Spot]) -> list[Mark]:
    """A detail where it has room among the marks of its field; otherwise empty."""
    disc = Space(marks, detail.of.rect).disc(detail.source.at, RADIUS + 4)
    if disc is None:
        return []
    x, y = centre(detail.board.rect)
    drawn = [*detail.board.marks, *free_ones(detail.board, spots)]
    shown = [moved(mark, disc.at[0] - x, disc.at[1] - y) for mark in drawn]
    return [*shown, *pointing(disc, detail.source)]


def pointing(disc: FreeDisc, source: Source) -> Iterator[Mark]:
    """The line from a small circle to its large one, and the enlargement."""
    small, (x, y) = RADIUS / source.times, source.at
    far = dist(disc.at, source.at)
    u, v = (disc.at[0] - x) / far, (disc.at[1] - y) / far
    if disc.in_sight:
        end = disc.at[0] - RADIUS * u, disc.at[1] - RADIUS * v
        yield LineMark(x + small * u, y + small * v, *end, "detail")
    beneath = disc.at[1] + RADIUS + 3.6 if v > 0 else disc.at[1] - RADIUS - 1.1
    yield Text(disc.at[0], beneath, scale_words(source.times), "caption", 2.5, "middle")


def scale_words(times: int) -> str:
    """The enlargement of a detail, written as its scale."""
    return f"{times}:1"


def enlarged_part(
    board: FieldContent, source: Source, at: XY, needed: Sequence[Label] = ()
) -> FieldContent:
    """The content of a small circle, drawn again in a large one centred at a place.

    Labels that are ``needed`` take a leader where they have no place next to their point.
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
    """Whether a line, extended at both ends, passes through a circle."""
    dx, dy = line.x2 - line.x1, line.y2 - line.y1
    across = dx * (centre[1] - line.y1) - dy * (centre[0] - line.x1)
    return abs(across) <= radius * hypot(dx, dy)


def draw_part(board: FieldContent, line: LineMark, source: Source, at: XY) -> None:
    """Draw the enlarged part of a line in the small circle, with its head if the head is inside."""
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
    """The part of a line that lies in a circle; None without one."""
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
    """The place in the large circle, centred at a place, of a point of the small circle."""
    (x, y), times = source
    return at[0] + times * (point[0] - x), at[1] + times * (point[1] - y)


def named(board: FieldContent, source: Source, at: XY, needed: Sequence[Label]) -> Iterator[Label]:
    """The names of the vectors and points of a small circle; those entirely in it come first.

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
    """The points of a detail whose letters are to be placed."""
    for label in labels:
        if segment_of(label) is None:
            yield CircleMark(*label.point, DOT, f"point {label.cls} detail".replace("  ", " "))


def is_vector(mark: Mark) -> TypeGuard[LineMark]:
    return isinstance(mark, LineMark) and style_class(mark) in VECTORS


# --- insets: a small picture at a smaller scale for a centre or pole off its field ----------------


LARGEST, SMALLEST = (80.0, 60.0), 26.0
"""Largest width and height of an inset, and least length of its longer side, in mm."""
EDGE = 8.0
"""Room inside an inset for names, in mm."""
FARTHEST = 200.0
"""Distance in widths of the field beyond which a centre is only named."""


def insets(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The insets of a mechanism's field, one for each far place, where there is room."""
    found: list[FieldContent] = []
    space: Space | None = None
    for kind, place in far_places(drawing, field):
        space = space or Space(marks, field.rect)
        board = inset(drawing, kind, place, field, space)
        if board:
            space.take(board.rect)
            found.append(board)
    spots = spots_on(found, [()] * len(found)) if found else []
    drawn = zip(found, spots, strict=True)
    return [mark for board, at in drawn for mark in (*board.marks, *free_ones(board, at))]


def far_places(drawing: Drawing, field: Field) -> Iterator[tuple[Centre, complex]]:
    """The centres and poles off a field but near enough to be shown, each place once."""
    shown: list[complex] = []
    for number, step, _ in drawing.on_mechanism:
        kind = construction(step)
        if not isinstance(kind, Centre) or kind.found != number:
            continue
        value = kind.value(drawing)
        point = drawing.place(value)
        if point is None or field.holds(point, WITHIN) or not kind.lines_to(drawing):
            continue
        if abs(point - value.start) * field.mm > FARTHEST * (field.rect[2] - field.rect[0]):
            continue
        if all(abs(point - other) * field.mm > TINY for other in shown):
            shown.append(point)
            yield kind, point


def inset(
    drawing: Drawing, kind: Centre, centre: complex, field: Field, space: Space
) -> FieldContent | None:
    """The mechanism and the lines that find a far centre, as large as possible."""
    around = ring(circle[1]) if (circle := kind.around(drawing)) else []
    extent = extent_of([*drawing.positions.values(), *spots_of(drawing, kind), centre, *around])
    inner = [size - 2 * EDGE for size in LARGEST]
    metre = drawing.scales.metre
    first = 1000 * max(extent.width / inner[0], extent.height / inner[1]) * metre
    scales = (kL / metre for kL in preferred(first))
    least = 1000 * max(extent.width, extent.height) / (SMALLEST - 2 * EDGE)
    for kL in takewhile(lambda kL: kL <= least, scales):
        width, height = (1000 * size / kL + 2 * EDGE for size in (extent.width, extent.height))
        disc = space.disc(field.at, hypot(width, height) / 2 + 2)
        if disc is not None:
            x, y = disc.at[0] - width / 2, disc.at[1] - height / 2
            rect = (x, y, x + width, y + height)
            return pictured(drawing, kind, centre, Field(rect, 1000 / kL, extent.middle, disc.at))
    return None


def pictured(drawing: Drawing, kind: Centre, centre: complex, field: Field) -> FieldContent:
    """The content of an inset: frame and scale, bars, rays, the centre, and their names."""
    left, top, right, bottom = field.rect
    lines, far = kind.lines_to(drawing), field(centre)
    firsts = [field(next(iter(line.values()))) for line in lines]
    scale = Scales(1000 / field.mm, 1.0, metre=drawing.scales.metre).words
    board = FieldContent(field.rect)
    board.marks = [
        box(left, top, right - left, bottom - top, "panel"),
        *bars_of(drawing, field),
        *(LineMark(*first, *far, "ray inset") for first in firsts),
        *around_of(drawing, kind, field),
        *(CircleMark(*field(end), 0.5, "point inset") for end in spots_of(drawing, kind)),
        CircleMark(*far, 0.9, f"centre {drawing.kind} inset"),
        Text(right - 1.5, bottom - 1.5, scale, "caption", 2.5, "end"),
    ]
    names = {name: end for line in lines for name, end in line.items()}
    board.labels = [Label(drawing.symbol(name), "", field(end), 2.5) for name, end in names.items()]
    name = " = ".join(drawing.symbol(each) for each in names_of(drawing, kind))
    board.labels.append(Label(name, drawing.kind, far, 2.5, radius=0.9))
    return board


def names_of(drawing: Drawing, kind: Centre) -> list[str]:
    """The name of a centre, and its name as the centre of its link and the frame."""
    others = (construction(step) for _, step, _ in drawing.on_mechanism)
    pairs = (each for each in others if isinstance(each, RelativeCentre))
    again = (each.name for each in pairs if each.same(drawing) == kind.found)
    return list(dict.fromkeys([kind.name, *again]))


def spots_of(drawing: Drawing, kind: Centre) -> list[complex]:
    """The places on the lines to a far centre."""
    return [place for line in kind.lines_to(drawing) for place in line.values()]


def bars_of(drawing: Drawing, field: Field) -> Iterator[Mark]:
    """The bars and the outlines of the plates of a mechanism."""
    for link in drawing.scene.links.values():
        places = places_of(drawing, link.name)
        corners = corners_of(drawing, link)
        if corners is None and len(places) > 1:
            corners = [*farthest(places)]
        for start, end in pairwise([*corners, corners[0]] if corners else ()):
            yield LineMark(*field(start), *field(end), "link inset")


def around_of(drawing: Drawing, kind: Centre, field: Field) -> Iterator[Mark]:
    """The circle on which a far centre lies."""
    if found := kind.around(drawing):
        look, circle = found
        place, radius = field(circle.centre), circle.radius * field.mm
        yield CircleMark(*place, radius, f"{look} {drawing.kind} inset")
