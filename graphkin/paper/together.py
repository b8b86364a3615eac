"""Fields of a page that do not overlap, finished together: all their labels placed in one go."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphkin.paper.labels import Board
from graphkin.paper.marks import Mark
from graphkin.paper.place import Spot, place


def finished(boards: Sequence[Board]) -> list[list[Mark]]:
    """The marks of boards that do not overlap, finished: their labels are placed in one go."""
    feet = [board.footed(board.notes) for board in boards]
    found = spots_on(boards, feet)
    made = zip(feet, found, strict=True)
    return [board.finish(each) for board, each in zip(boards, made, strict=True)]


def spots_on(
    boards: Sequence[Board], more: Sequence[Sequence[Mark]] = (), *, thorough: bool = True
) -> list[list[Spot]]:
    """The places of all labels of boards that do not overlap, sought in one go.

    ``more`` are marks for each board that its labels keep clear of, beside its own. The search may
    give labels up early where it need not be ``thorough``.
    """
    if not boards:
        return []
    obstacles = [
        board.obstacles(marks)
        for board, marks in zip(boards, more or [()] * len(boards), strict=True)
    ]
    lines = np.concatenate([drawn for drawn, _ in obstacles])
    boxes = [box for _, taken in obstacles for box in taken]
    wishes = [label.wish() for board in boards for label in board.labels]
    fields = [board.rect for board in boards for _ in board.labels]
    found = iter(place(wishes, lines, boxes, fields, thorough=thorough))
    return [[next(found) for _ in board.labels] for board in boards]
