"""While a slider moves every label keeps its distance to what it names; at rest all is settled."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from graphkin.construction.core.layout import lay_out
from graphkin.documents.detail import with_detail
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet import left_board, right_board
from graphkin.documents.sheet_documents import drawings_of
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark, Text, reach
from graphkin.mechanism import Mechanism, load
from graphkin.studio.panels import FollowLabels, keyed, middle_of, riding, seats_of
from graphkin.text import words

FIELDS = [(kind, draw) for kind in (0, 1) for draw in (left_board, right_board)]


def board_of(mechanism: Mechanism, kind: int, draw) -> FieldContent:
    """A field with its labels still to be placed."""
    verdict = mechanism.witness(sheet_motion(mechanism))
    drawing = drawings_of(mechanism, verdict, words("en"))[kind]
    return draw(drawing, lay_out(drawing), "key")


def labels(marks: list[Mark]) -> list[Text]:
    """The texts of labels."""
    return [m for m in marks if isinstance(m, Text) and m.cls.split()[0] == "label"]


def settled(board: FieldContent) -> tuple[FollowLabels, list[Mark]]:
    """A field with all labels at free places, and where they stand."""
    wished = list(board.labels)
    marks = with_detail(board)
    return seats_of(wished, marks), marks


@pytest.mark.parametrize(("kind", "draw"), FIELDS)
def test_a_label_goes_along_with_what_it_names(kind, draw):
    seats, _ = settled(board_of(load("pump", n=7), kind, draw))
    board = board_of(load("pump", n=9), kind, draw)
    texts = {(t.cls, t.name, t.step): t for t in labels(riding(board, seats))}
    left, top, right, bottom = board.rect
    checked = 0
    for key, label in keyed(board.labels):
        text, seat = texts.get(key[:3]), seats.of.get(key)
        if text is None or seat is None or key[3]:
            continue
        box = reach(text)
        inside = left < box[0] and top < box[1] and box[2] < right and box[3] < bottom
        x, y = middle_of(label)
        away = (box[0] + box[2]) / 2 - x, (box[1] + box[3]) / 2 - y
        if inside:
            assert away == pytest.approx((seat.x, seat.y), abs=0.05)
            checked += 1
    assert checked > 5


def test_labels_stay_within_their_field():
    board = board_of(load("pump"), 1, right_board)
    far = FollowLabels(
        {
            key: replace(next(iter(settled(board)[0].of.values())), x=500.0, y=-500.0)
            for key, _ in keyed(board.labels)
        }
    )
    board = board_of(load("pump"), 1, right_board)
    left, top, right, bottom = board.rect
    for text in labels(riding(board, far)):
        box = reach(text)
        assert left - 0.3 <= box[0] <= box[2] <= right + 0.3
        assert top - 0.3 <= box[1] <= box[3] <= bottom + 0.3
