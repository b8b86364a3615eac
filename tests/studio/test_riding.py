"""While a slider moves every label keeps its distance to what it names; at rest all is settled."""

from __future__ import annotations

from math import hypot

import pytest
from msgspec.structs import replace

from graphkin.construction.core.layout import lay_out
from graphkin.documents.detail import with_detail
from graphkin.documents.scaling import shown
from graphkin.documents.sheet import left_board, right_board
from graphkin.documents.sheet_documents import drawings_of
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Mark, Text, reach
from graphkin.mechanism import Mechanism, load
from graphkin.studio.follow_labels import FollowLabels, keyed, middle_of, riding, seats_of
from graphkin.text import words
from tests.studio.pump import drawn, seen, svgs

FIELDS = [(kind, draw) for kind in (0, 1) for draw in (left_board, right_board)]


def board_of(mechanism: Mechanism, kind: int, draw) -> FieldContent:
    """A field with its labels still to be placed."""
    verdict = mechanism.witness(shown(mechanism))
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


@pytest.mark.parametrize("name", ["pump", "slotted-lever", "offset-slider-crank"])
@pytest.mark.parametrize(("kind", "draw"), FIELDS)
def test_where_nothing_moved_every_label_stands_where_it_stood(name, kind, draw):
    mechanism = load(name)
    seats, marks = settled(board_of(mechanism, kind, draw))
    again = riding(board_of(mechanism, kind, draw), seats)
    before = {(t.cls, t.name, t.step, t.markup): t for t in labels(marks)}
    kept = [t for t in labels(again) if (t.cls, t.name, t.step, t.markup) in before]
    assert len(kept) >= 0.9 * len(labels(again)) > 3
    for text in kept:
        old = before[text.cls, text.name, text.step, text.markup]
        assert text.height == old.height
        assert hypot(text.x - old.x, text.y - old.y) < 1e-9


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


def test_a_label_that_never_stood_anywhere_stands_beside_its_subject():
    board = board_of(load("pump"), 0, right_board)
    found = labels(riding(board, FollowLabels()))
    assert len(found) == len(board.labels)
    for label, text in zip(board.labels, found, strict=True):
        x, y = middle_of(label)
        assert hypot(text.x - x, text.y - y) < 20


def test_labels_that_were_left_out_stay_out_until_all_is_settled():
    board = board_of(load("pump"), 0, right_board)
    key, _ = next(keyed(board.labels))
    kept = riding(board, FollowLabels({}, frozenset([key])))
    assert len(labels(kept)) == len(board.labels) - 1


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


@pytest.mark.parametrize("n", ["1", "15", "30"])
@pytest.mark.parametrize("mechanism", ["velocity", "acceleration"])
def test_all_but_labels_is_drawn_alike_in_motion_and_at_rest(n, mechanism):
    rest = svgs(seen(settings={"n": n}, mechanism=mechanism))
    moving = svgs(seen(settings={"n": n}, mechanism=mechanism, quick=True))
    for name, svg in rest.items():
        assert set(drawn(moving[name])) <= set(drawn(svg))
        assert len(drawn(moving[name])) > 10
