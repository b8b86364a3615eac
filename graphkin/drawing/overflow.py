"""Labels of a field that is too full for all of them: what must be named comes first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from graphkin.drawing.marks import Mark
from graphkin.drawing.placement import Spot
from graphkin.drawing.richtext import plain
from graphkin.text.errors import PageError, Problem

if TYPE_CHECKING:
    from graphkin.drawing.labels import FieldContent, Label

HELPERS = ("construction", "trial")
"""Classes of letters that a drawing can do without where there is no room for them."""


def by_need(
    board: FieldContent, wished: Sequence[Label], meanings: Sequence[str]
) -> tuple[list[Mark], list[Spot]]:
    """Place letters of points and numbers first, then names of vectors, helping letters last.

    First the labels as they were wished, then as they stand, with what their key numbers mean.
    The foot of the field is returned with the places. Raises PageError where a letter or a number
    of a link finds no place even so.
    """
    shortened = board.labels
    try:
        board.labels = list(wished)
        return in_turn(board, board.notes)
    except PageError:
        board.labels = shortened
        return in_turn(board, [*board.notes, *meanings])


def in_turn(board: FieldContent, notes: Sequence[str]) -> tuple[list[Mark], list[Spot]]:
    """Place what must be named before what may be left out.

    What finds no place is taken off the board; vectors that stay without a name are noted at the
    foot. Raises PageError where a letter or a number finds none.
    """
    labels = board.labels
    vectors = [i for i, label in enumerate(labels) if label.spare]
    helpers = [i for i, label in enumerate(labels) if label.cls in HELPERS]
    first = [i for i in range(len(labels)) if i not in {*vectors, *helpers}]
    left_out: list[int] = []
    while True:
        names = ", ".join(dict.fromkeys(labels[i].markup for i in left_out))
        foot = board.footed([*notes, *([f"{board.unnamed} {names}"] if names else [])])
        found: dict[int, Spot] = {}
        for which in (first, [i for i in vectors if i not in left_out], helpers):
            found |= placed_after(board, foot, found, which)
        refuse_crowds([labels[i] for i in first], [found[i] for i in first])
        crowded = [i for i in vectors if i in found and not found[i].free]
        if not crowded:
            break
        left_out = sorted([*left_out, *crowded])
    kept = [i for i in sorted(found) if found[i].free]
    board.labels = [labels[i] for i in kept]
    return foot, [found[i] for i in kept]


def placed_after(
    board: FieldContent, foot: Sequence[Mark], found: Mapping[int, Spot], which: Sequence[int]
) -> dict[int, Spot]:
    """The places of some labels, clear of those that have theirs."""
    taken = [m for i, spot in found.items() if spot.free for m in board.labels[i].marks(spot)]
    spots = board.spots([*foot, *taken], [board.labels[i] for i in which])
    return dict(zip(which, spots, strict=True))


def refuse_crowds(labels: Sequence[Label], spots: Sequence[Spot]) -> None:
    """Raise PageError naming every label for which there was no free place."""
    crowded = [
        label.name or plain(label.markup)
        for label, spot in zip(labels, spots, strict=True)
        if not spot.free
    ]
    if crowded:
        raise PageError(
            Problem(
                "labels",
                "does not fit: no free place for " + ", ".join(crowded),
                "room for every name",
                "ask for less on one sheet, or choose a position in which less falls together",
            )
        )
