"""Positions in which much falls together: a fair sheet all the same, and it says what it omits."""

from __future__ import annotations

from math import ceil

import pytest
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import lay_out
from graphkin.documents.detail import parted
from graphkin.documents.scaling import scales
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import boards, sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.labels import FieldContent, FootNote, Label, NoteLine, in_turn, segment_of
from graphkin.drawing.marks import LineMark, Page, Text, reach
from graphkin.drawing.richtext import plain
from graphkin.text import words
from graphkin.text.errors import PageError
from tests.documents.full_scenes import drawings_from
from tests.examples.scenes import mechanism
from tests.scene_files import scene_text

POINT = Label("*A*", "", (25.0, 10.0), 3.5, "A", priority=2)
VECTOR = Label("*v*_A", "velocity", ((5.0, 10.0), (45.0, 10.0)), 2.5, "oa", spare=True)
HELPER = Label("*a*″", "construction", (25.0, 10.0), 2.5, "a″")


def drawings(name: str, **settings: object) -> list[Drawing]:
    found = mechanism(name, **settings)
    return drawings_of(found, proved(found, found.solve()), words("en"))


def notes(page: Page) -> str:
    return " ".join(
        plain(mark.markup) for mark in page.marks if isinstance(mark, Text) and mark.name == "note"
    )


class Unfooted(FieldContent):
    """What a field holds, without its notes."""

    def footed(self, notes):
        return []


def test_letters_of_points_come_before_names_of_vectors_and_these_before_helping_letters():
    for width in (6.0, 9.0, 12.0, 16.0, 20.0, 30.0):
        board = Unfooted((25 - width / 2, 4.0, 25 + width / 2, 16.0))
        board.labels = [HELPER, VECTOR, POINT]
        board.unnamed = "without:"
        in_turn(board, [])
        kept = [label.name for label in board.labels]
        assert "A" in kept
    assert kept == ["a″", "oa", "A"]


def test_a_letter_without_room_is_refused():
    board = FieldContent((24.0, 9.0, 26.0, 11.0))
    board.labels = [replace(POINT, subject=(25.0, 10.0))]
    with pytest.raises(PageError, match="no free place for A"):
        in_turn(board, [])


def near_points(right: float) -> FieldContent:
    """Two points that nearly fall together amid lines too close for letters, in a wide field."""
    lines = [LineMark(x, 5.0, x, 95.0, "construction") for x in (5 + 1.6 * k for k in range(52))]
    board = FieldContent((0.0, 0.0, right, 100.0), lines, unnamed="no room for:")
    points = (("*o*′", (45.0, 50.0)), ("*p*_{19}′", (45.7, 50.3)))
    board.labels = [Label(name, "acceleration", at, 2.5, plain(name)) for name, at in points]
    return board


def test_letters_without_room_are_those_of_a_detail_about_their_points():
    (field,) = parted(near_points(150.0))
    said = [plain(mark.markup) for mark in field.details if isinstance(mark, Text)]
    assert {"o′", "p19′"} < {*said}
    assert not [mark for mark in field.marks if isinstance(mark, Text)]


def test_letters_are_noted_where_a_detail_has_no_room_either():
    (field,) = parted(near_points(90.0))
    assert not field.details
    note = " ".join(plain(mark.markup) for mark in field.marks if isinstance(mark, Text))
    assert note == "no room for: o′, p19′"


# --- plans too small at the scale of their crank -------------------------------------------------


# --- sentences -----------------------------------------------------------------------------------


def test_labels_stay_where_they_were_when_one_in_a_crowd_gets_a_key_number():
    board = FieldContent((0.0, 0.0, 90.0, 60.0))
    board.marks = [LineMark(5, 20, 30, 20, "velocity", "oa")]
    board.taken = [(54.0, 4.0, 66.0, 16.0), (60.0, 0.0, 90.0, 50.0), (45.0, 13.0, 90.0, 50.0)]
    wide = Label("*v*_{ABCDEFGHIJKLMNOPQRSTUVWXYZABCDEFGHIJKLMNOPQRSTUVWXYZ}", "", (62.0, 11.0))
    board.labels = [replace(POINT, subject=(25.0, 40.0)), VECTOR, wide]
    first = board.spots()
    assert [spot.free for spot in first] == [True, True, False]
    marks = board.finish()
    found = {mark.name: mark for mark in marks if isinstance(mark, Text)}
    for label, spot in zip(board.labels[:2], first, strict=False):
        assert found[label.name] == label.text(spot)


def test_points_of_a_plan_that_nearly_fall_together_are_not_told_to_be_one():
    """In watt-1, drawn as the lab draws it, the images c and e are 0.22 mm apart."""
    found = mechanism("watt-1")
    held = scales(found)
    held = replace(held, larger=1.0, larger_still=1.0)
    velocity, _ = drawings_of(found, proved(found, found.solve()), words("en"), held)
    (page,) = sheet(velocity, "key", "1/2")
    labels = [plain(mark.markup) for mark in page.marks if isinstance(mark, Text)]
    assert "c ≈ e" in labels
    assert not [label for label in labels if "≡" in label]


def test_notes_never_leave_their_field_and_say_that_more_are_left_out():
    """At most about a fifth of a field is for notes; key numbers are not given beyond it."""
    field = FieldContent((0.0, 0.0, 100.0, 100.0))
    foot = field.footed([FootNote(f"{i}) *O*_{i}") for i in range(500)])
    assert foot[-1].markup == "…" and foot[0].markup.startswith("0) ")
    assert min(mark.y for mark in foot) > 75
    few = field.footed([FootNote(f"{i}) *O*_{i}") for i in range(20)])
    assert "…" not in [mark.markup for mark in few]


@pytest.mark.parametrize("width", [40.0, 61.0, 200.0])
def test_a_note_that_would_cross_lines_is_tried_further_to_the_right_every_15_mm(width):
    """Its lines stand one above the other, the last 2.5 mm above the edge, all within the field."""
    board = FieldContent((10.0, 20.0, 10.0 + width, 90.0))
    lines = ["a note", "in two lines"]
    places = [*board.foot_places([*map(NoteLine, lines)])]
    lefts = [texts[0].x for texts in places]
    assert lefts == [13.0 + 15 * k for k in range(len(places))]
    for texts in places:
        assert [text.markup for text in texts] == lines
        assert {text.x for text in texts} == {texts[0].x}
        assert [text.y for text in texts] == pytest.approx([90 - 2.5 - 4.6, 90 - 2.5])
    widest = max(reach(text)[2] - reach(text)[0] for text in places[0])
    room = width - 6 - widest
    assert len(places) == max(1, ceil(int(room) / 15))
    assert max(reach(text)[2] for text in places[-1]) <= 10 + width - 3 + 0.1


def test_a_dispensable_letter_is_drawn_where_the_others_leave_room_near_its_point():
    """It moves none of them, and has no leader to a place far away."""
    alone = FieldContent((0.0, 0.0, 60.0, 30.0), labels=[POINT])
    both = FieldContent((0.0, 0.0, 60.0, 30.0), labels=[POINT], dispensable=[HELPER])
    assert [mark for mark in both.finish() if mark.name == "A"] == alone.finish()
    assert [mark for mark in both.finish() if mark.name == "a″"]
    walls = [LineMark(x, 0.0, x, 30.0, "link") for x in range(15, 36)]
    full = FieldContent((0.0, 0.0, 60.0, 30.0), walls, dispensable=[HELPER])
    assert full.finish() == walls
    assert len(FieldContent(full.rect, list(walls), labels=[POINT]).finish()) > len(walls)


@pytest.mark.parametrize(
    "name", ["stephenson-2-binary", "klein-engine", "oscillating-slide", "platform-six"]
)
def test_sentences_name_the_corners_that_stand_in_their_words(name):
    """Right triangles in full and likewise, Klein's construction, triangles of Coriolis."""
    _, drawing = drawings(name)
    left, _ = boards(drawing, lay_out(drawing), "key")
    said = " ".join(sentence.markup for sentence in sentences(drawing))
    corners = [x for x in left.labels if x.cls == "construction" and not segment_of(x)]
    assert corners
    assert all(label.markup in said for label in corners)
    assert not any(label.markup in said for label in left.dispensable)


def test_letters_that_no_sentence_says_give_way_to_the_others():
    """Few letters of likewise triangles are left of a Stephenson six-bar, all others are."""
    _, drawing = drawings("stephenson-2-binary")
    left, _ = boards(drawing, lay_out(drawing), "key")
    said = " ".join(sentence.markup for sentence in sentences(drawing))
    assert len(left.dispensable) > 15
    assert not any(label.markup in said for label in left.dispensable)
    named = {mark.markup for mark in left.finish() if isinstance(mark, Text)}
    assert {label.markup for label in left.labels} <= named


def test_eleven_links_close_together_have_a_sheet_that_names_every_point_and_link():
    """In the field, in a detail, by a key number, or in the note of what has no room there."""
    for drawing in drawings_from(scene_text("documents/eleven-links")):
        left, right = parted(*boards(drawing, lay_out(drawing), "key"))
        said = {plain(m.markup) for m in (*left.marks, *left.details) if isinstance(m, Text)}
        words_ = {word.strip(",;") for each in said for word in each.split()}
        assert {*drawing.scene.links} <= words_
        assert {f"P{n}" for n in range(16)} <= words_
        assert right.marks
