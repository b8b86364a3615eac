"""Fields of a page that do not overlap, finished together: all their labels placed in one go."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from graphkin.drawing.labels import FieldContent
from graphkin.drawing.leaders import strong_lines
from graphkin.drawing.marks import Mark
from graphkin.drawing.placement import Spot, place

KEPT = 2**24
"""Bytes of a block after whose release the C library of Linux keeps what it hands out."""


def finished(
    boards: Sequence[FieldContent], details: Sequence[FieldContent] = ()
) -> tuple[list[list[Mark]], list[list[Spot]]]:
    """The marks of boards, finished, and the places of the labels of details that lie elsewhere.

    The labels of all are placed in one go; none of the boards and details overlap.
    """
    feet = [board.footed(board.notes) for board in boards]
    found = spots_on([*boards, *details], [*feet, *([] for _ in details)])
    made = zip(feet, found[: len(boards)], strict=True)
    marks = [board.finish(each) for board, each in zip(boards, made, strict=True)]
    return marks, found[len(boards) :]


def spots_on(boards: Sequence[FieldContent], more: Sequence[Sequence[Mark]]) -> list[list[Spot]]:
    """The places of all labels of boards that do not overlap, sought in one go.

    ``more`` are marks for each board that its labels keep clear of, beside its own.
    """
    keep_memory()
    obstacles = [board.obstacles(marks) for board, marks in zip(boards, more, strict=True)]
    lines = np.concatenate([drawn for drawn, _ in obstacles])
    boxes = [box for _, taken in obstacles for box in taken]
    wishes = [label.wish() for board in boards for label in board.labels]
    fields = [board.lettering for board in boards for _ in board.labels]
    strong = np.concatenate([strong_lines(board.marks) for board in boards])
    found = iter(place(wishes, lines, boxes, fields, strong=strong))
    return [[next(found) for _ in board.labels] for board in boards]


@lru_cache(maxsize=1)
def keep_memory() -> None:
    """Keep the memory of arrays for the next ones: handed back, it takes a tenth of a page's time.

    Processor time of the layout and SVG of two pages with it and without, in ms: stephenson-3 30.2
    and 34.9, gears-ring 21.3 and 26.2.
    """
    np.empty(KEPT, dtype=np.uint8)
