"""Positions in which much falls together: a fair sheet all the same, and it says what it omits."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, hand_out, proved
from graphkin.drawing.label import Label
from graphkin.drawing.labels import FieldContent, in_turn
from graphkin.drawing.marks import LineMark, Page, Text
from graphkin.drawing.richtext import plain
from graphkin.numbers.plane import Vector
from graphkin.text import words
from graphkin.text.errors import PageError
from tests.examples.scenes import mechanism, varied

PLAN = 210.0
"""Right of this, in mm, lies only the plan of a drawing that is very small."""
POINT = Label("*A*", "", (25.0, 10.0), 3.5, "A", priority=2)
VECTOR = Label("*v*_A", "velocity", ((5.0, 10.0), (45.0, 10.0)), 2.5, "oa", spare=True)
HELPER = Label("*a*″", "construction", (25.0, 10.0), 2.5, "a″")


def drawings(name: str, **settings: object) -> list[Drawing]:
    found = mechanism(name, **settings)
    return drawings_of(found, proved(found, found.solve()), words("en"))


def told(drawing: Drawing) -> str:
    return " | ".join(plain(sentence.markup) for sentence in sentences(drawing))


def notes(page: Page) -> str:
    return " ".join(
        plain(mark.markup) for mark in page.marks if isinstance(mark, Text) and mark.name == "note"
    )


@pytest.mark.parametrize(
    ("name", "setting"),
    [
        ("watt-1", {"angle": 170}),
        ("watt-1", {"angle": 220}),
        ("eight-link-2", {"v": 270}),
        ("gears-planet", {"n": 40}),
        ("roller", {"r": 120}),
        ("stephenson-1", {"angle": 35}),
        ("watt-1-ternary", {"angle": 90}),
    ],
)
def test_a_crowded_position_is_drawn_with_every_point_named(name, setting):
    for drawing, handed in zip(
        drawings(name, **setting), hand_out(mechanism(name, **setting), language="en"), strict=False
    ):
        labels = {mark.name for mark in handed.pages[0].marks if isinstance(mark, Text)}
        letters = {part for label in labels for part in label.split()}
        assert set(drawing.scene.links) <= labels
        assert set(drawing.standing.positions) <= letters


def is_label(mark: Text) -> bool:
    """True for a label beside what it names; those in a detail circle have no name of their own."""
    return mark.cls.startswith("label") and bool(mark.name)


def test_names_of_vectors_without_room_are_noted():
    small = varied("stephenson-1", ("[ask]", "[sheet]\nenlarge = 0.3\n[ask]"))
    page = hand_out(small, language="en")[1].pages[0]
    plan = Page(420, 297, tuple(m for m in page.marks if isinstance(m, Text) and m.x > PLAN))
    _, _, names = notes(plan).partition("no room for the names of: ")
    labels = {plain(mark.markup) for mark in plan.marks if is_label(mark)}
    assert names
    assert not set(names.split(", ")) & labels


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


@pytest.mark.parametrize("name", ["oscillating-slide", "oldham"])
def test_a_coriolis_component_of_nought_is_said_and_not_drawn(name):
    """At 270° the block stands on its guide, or the slot is square to the line of the shafts."""
    _, drawing = drawings(name, angle=270)
    assert "= 0, because" in told(drawing)
    assert len(hand_out(mechanism(name, angle=270))) == 3


# --- plans too small at the scale of their crank -------------------------------------------------


def longest(drawing: Drawing) -> float:
    """The longest vector of a plan, in mm."""
    scale = drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka
    vectors = [v for _, s, v in drawing.steps(drawing.plane) if s.arrow and isinstance(v, Vector)]
    return 1000 * max(abs(v.tip - v.tail) for v in vectors) / scale


@pytest.mark.parametrize("angle", [90, 170, 220, 270])
def test_a_plan_too_small_beside_its_crank_is_drawn_larger(angle):
    for drawing in drawings("watt-1", angle=angle):
        scales = drawing.scales
        assert not scales.from_driver
        assert longest(drawing) >= 20
        assert scales.ka == pytest.approx(scales.kv**2 / scales.kL, rel=1e-12)
        assert "as long as" not in told(drawing)


def test_the_lab_keeps_the_scale_of_its_crank():
    for n in (1, 10, 20, 30):
        for drawing in drawings("pump", n=n):
            assert drawing.scales.from_driver
            assert drawing.scales.seconds * float(
                drawing.scene.drivers[0].speed.si(drawing.scene.values)
            ) == pytest.approx(1, rel=1e-12)


# --- sentences -----------------------------------------------------------------------------------


def test_a_point_beyond_its_bar_is_laid_off_beyond_it():
    first, _ = drawings("lifter")
    assert "on AB produced beyond B lay off AE: E" in told(first)
    assert "on EF produced beyond E lay off EP: P" in told(first)
    between, _ = drawings("trammel")
    assert "on AB lay off AM: M" in told(between)


def test_turning_is_read_off_only_where_the_sheet_states_it():
    for name, stated in (("crank-fixed-slot", False), ("four-bar-crank-rocker", True)):
        _, drawing = drawings(name)
        assert ("tangential component" in told(drawing).rpartition("|")[2]) is stated


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
    """In watt-1 the images c and e are 0.22 mm apart."""
    velocity, _ = drawings("watt-1")
    page = sheet(velocity, "key", "1/2")
    labels = [plain(mark.markup) for mark in page.marks if isinstance(mark, Text)]
    assert "c ≈ e" in labels
    assert not [label for label in labels if "≡" in label]
