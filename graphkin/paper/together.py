"""Fields of a page that do not overlap, finished together: all their labels placed in one go."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.paper.labels import Board
from graphkin.paper.marks import Mark
from graphkin.paper.place import Spot, place


def finished(boards: Sequence[Board]) -> list[list[Mark]]:
    """The marks of boards that do not overlap, finished: their labels are placed in one go."""
    feet = [board.footed(board.notes) for board in boards]
    found = spots_on(boards, feet)
    return [board.finish(spots) for board, spots in zip(boards, found, strict=True)]


def spots_on(boards: Sequence[Board], more: Sequence[Sequence[Mark]] = ()) -> list[list[Spot]]:
    """The places of all labels of boards that do not overlap, sought in one go.

    ``more`` are marks for each board that its labels keep clear of, beside its own.
    """
    obstacles = [
        board.obstacles(marks)
        for board, marks in zip(boards, more or [()] * len(boards), strict=True)
    ]
    lines, boxes = ([box for kinds in obstacles for box in kinds[k]] for k in (0, 1))
    wishes = [label.wish() for board in boards for label in board.labels]
    fields = [board.rect for board in boards for _ in board.labels]
    found = iter(place(wishes, lines, boxes, fields))
    return [[next(found) for _ in board.labels] for board in boards]
