"""The frame over a whole motion: guides, slots and tracks as long as its blocks need them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import Touch
from graphkin.construction.guides.slide_symbols import STROKE, draw_frame_guides, merged, within
from graphkin.construction.links.link_shapes import REACH, Rail, rails_of
from graphkin.construction.links.wheel_symbols import track, track_ends
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark
from graphkin.drawing.symbols import across, hatched, rails, slot, slot_ground
from graphkin.numbers.plane import dot
from graphkin.scene.model import FRAME

STILL = ("guide", "ground", "slot")
"""The classes of marks that are drawn once for a whole motion."""


def travelling(drawing: Drawing, field: Field) -> set[Mark]:
    """The marks of the frame that a sheet draws around a block or a wheel."""
    board = FieldContent(field.rect)
    draw_frame_guides(board, drawing, field)
    for touch in lines_of(drawing):
        board.marks += within(track(drawing, field, touch), field.rect)
    return {mark for mark in board.marks if mark.cls in STILL}


def standing(drawings: Sequence[Drawing], field: Field) -> Iterator[Mark]:
    """The guides, slots and tracks of the frame, as long as the whole motion needs them."""
    for rail, others in alike(drawings):
        yield from guide(rail, others, field)
    for place, touch in enumerate(lines_of(drawings[0])):
        yield from line(drawings, place, touch, field)


def alike(drawings: Sequence[Drawing]) -> Iterator[tuple[Rail, list[Rail]]]:
    """Each line of the frame on which blocks and pins slide, with the same line at all moments."""
    every = [[rail for rail in rails_of(each) if rail.owner == FRAME] for each in drawings]
    for place, rail in enumerate(every[0]):
        yield rail, [found[place] for found in every if len(found) == len(every[0])]


def guide(rail: Rail, others: Sequence[Rail], field: Field) -> Iterator[Mark]:
    """One guide with its slots, over the full travel of its blocks and pins."""
    at, way = field(rail.zero), field.way(rail.along)

    def span(places: list[complex], beyond: float) -> tuple[float, float]:
        along = [rail.along_of(place) * field.mm for place in places]
        return min(along) - beyond, max(along) + beyond

    parts = [
        span([other.at(other.marks[i]) for other in others], REACH) for i in range(len(rail.marks))
    ]
    for low, high in merged(parts):
        yield from within(rails(at, way, low, high), field.rect)
    for i, (_, name) in enumerate(rail.slots):
        low, high = span([other.at(other.slots[i][0]) for other in others], STROKE)
        yield from within(slot_ground(at, way, low, high), field.rect)
        yield slot(at, way, low, high, name)


def lines_of(drawing: Drawing) -> list[Touch]:
    """The contacts of toothless wheels with straight tracks of the frame."""
    touches = drawing.standing.touches
    return [t for t in touches if t.zero is not None and t.on == FRAME and not t.disc.module]


def line(drawings: Sequence[Drawing], place: int, touch: Touch, field: Field) -> Iterator[Mark]:
    """One track, over the full travel of its wheel."""
    ends: list[float] = []
    for drawing in drawings:
        here = lines_of(drawing)[place]
        moved = float(dot(here.at - touch.at, touch.along)) * field.mm
        ends += [moved + end for end in track_ends(drawing, field, here)]
    at, way = field(touch.at), field.way(touch.along)
    start, end = across(at, way, min(ends), 0), across(at, way, max(ends), 0)
    both = (start, end) if touch.side > 0 else (end, start)
    yield from within(hatched(*both), field.rect)
