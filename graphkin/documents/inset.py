"""A small picture at a smaller scale for a centre or pole that lies off its field."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, takewhile
from math import hypot

from graphkin.construction.centres.centre import Centre
from graphkin.construction.centres.relative_centre import RelativeCentre
from graphkin.construction.core.curve_marks import ring
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.paper_canvas import WITHIN
from graphkin.construction.core.segments import TINY
from graphkin.construction.guides.rails import places_of
from graphkin.construction.links.plates import corners_of, farthest
from graphkin.drawing.field import Field
from graphkin.drawing.free_space import Space
from graphkin.drawing.label import Label
from graphkin.drawing.labels import FieldContent, free_ones
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, box
from graphkin.drawing.place_labels import spots_on
from graphkin.drawing.scale import Scales, extent_of, preferred
from graphkin.drawing.symbol_markup import symbol

LARGEST, SMALLEST = (80.0, 60.0), 26.0
"""Width and height of an inset at most, and the longer of both at least, in mm."""
EDGE = 8.0
"""Room inside an inset for names, in mm."""
FARTHEST = 200.0
"""A centre this many times farther than the field is wide is only named, not shown."""


def insets(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The insets of a mechanism's field, one for each far place, where there is room for it."""
    found: list[FieldContent] = []
    space: Space | None = None
    for kind, centre in far_places(drawing, field):
        space = space or Space(marks, field.rect)
        board = inset(drawing, kind, centre, field, space)
        if board:
            space.take(board.rect)
            found.append(board)
    spots = spots_on(found, [()] * len(found)) if found else []
    drawn = zip(found, spots, strict=True)
    return [mark for board, at in drawn for mark in (*board.marks, *free_ones(board, at))]


def far_places(drawing: Drawing, field: Field) -> Iterator[tuple[Centre, complex]]:
    """The centres and poles that lie off a field, but not too far to be shown, each place once."""
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
    """The mechanism and the lines that find a far centre, as large as there is room for."""
    around = ring(circle[1]) if (circle := kind.around(drawing)) else []
    extent = extent_of([*drawing.positions.values(), *spots_of(drawing, kind), centre, *around])
    inner = [size - 2 * EDGE for size in LARGEST]
    scales = preferred(1000 * max(extent.width / inner[0], extent.height / inner[1]))
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
    """What an inset shows: its frame and scale, bars, rays, the centre, and their names."""
    left, top, right, bottom = field.rect
    lines, far = kind.lines_to(drawing), field(centre)
    firsts = [field(next(iter(line.values()))) for line in lines]
    scale = Scales(1000 / field.mm, 1.0).words
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
    board.labels = [Label(symbol(name), "", field(end), 2.5) for name, end in names.items()]
    name = " = ".join(symbol(each) for each in names_of(drawing, kind))
    board.labels.append(Label(name, drawing.kind, far, 2.5, radius=0.9))
    return board


def names_of(drawing: Drawing, kind: Centre) -> list[str]:
    """The name of a centre, and that which it has as the centre of its link and the frame."""
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
