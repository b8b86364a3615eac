"""Feedback as a student reads it: how far, why, what waits, in sensible words, on one page."""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import combinations

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.class_report import summary
from graphkin.classroom.grading.explanations import ways_of
from graphkin.classroom.grading.feedback import (
    COLUMNS,
    HEADS,
    columns,
    feedback_html,
    feedback_pages,
    rows,
)
from graphkin.classroom.grading.graded import Answer, Graded, Result, Status
from graphkin.classroom.grading.grading_files import marks_table, read_marks
from graphkin.drawing.marks import Page, Text, reach
from graphkin.drawing.richtext import plain
from graphkin.text import LANGUAGES, words
from tests.classroom.grading.students import book_of, given, key_answers, marker_of, taker


def graded(changes: dict[str, Answer], name: str = "pump", n: int = 7) -> Graded:
    """The marks of the key with some answers changed."""
    marker = marker_of(name, n)
    return marker.mark(taker(n), {**key_answers(marker.standard), **changes})


def why(found: Graded, field: str, language: str) -> str:
    """The reason that a student is given for a field."""
    marks = [mark.item.field for mark in found.marks if mark.points]
    return plain(rows(found, words(language))[marks.index(field)].why)


def key(field: str) -> float:
    """What is right for student 7."""
    return marker_of("pump", 7).standard.key[field]


# --- senses -------------------------------------------------------------------------------------


def test_a_sense_that_the_sign_of_its_value_contradicts_earns_nothing():
    """Whichever of the two is right; the value counts by its size. The right one is positive."""
    size = key("omega_3")
    assert size > 0
    for value, sense in (("-27,6", 1.0), ("+27,6", -1.0)):
        signed = Answer(value, -size if value.startswith("-") else size, signed=True)
        found = graded({"omega_3": signed, "omega_3_sense": Answer("x", sense, signed=True)})
        assert found.mark("omega_3").status is Status.RIGHT
        mark = found.mark("omega_3_sense")
        assert (mark.torn, mark.earned, mark.status) == (True, 0, Status.WRONG)
        for language in LANGUAGES:
            assert why(found, "omega_3_sense", language) == plain(words(language)("feedback.torn"))
        table = read_marks(marks_table(Result((found,))))
        assert table["s007"]["omega_3_sense why"] == "wrong contradicts its sign"


# --- what waits ---------------------------------------------------------------------------------


def waiting() -> Graded:
    """Two answers of the pump that cannot be read, worth 1 and 0.5 points."""
    return graded(
        {
            "v_D": Answer("3,8,2", problem="number"),
            "omega_2_sense": Answer("sus", problem="turning"),
        }
    )


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_follows_on_the_drawing_says_so(language):
    """Its share is on the page with its reason."""
    found, spoken = graded({"v_D_mm": Answer("82.5", 82.5, followed=True)}), words(language)
    assert plain(spoken("feedback.follows_drawn", share="80")) in why(found, "v_D_mm", language)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_key_of_what_waits_is_kept_back(language):
    """Neither the field itself, nor the segment from which it is reckoned, tells it."""
    far = Answer("99", 99.0)
    found = graded({"v_D": Answer("3,8,2", problem="number"), "v_D_mm": far})
    spoken = words(language)
    told = {
        mark.item.field: row for mark, row in zip(found.marks, rows(found, spoken), strict=True)
    }
    for field in ("v_D", "v_D_mm"):
        assert told[field].cells[2:5] == ("…", "", "")
        assert spoken.significant(abs(key(field))) not in " ".join(told[field].cells)
    assert plain(spoken("feedback.kept_back")) in why(found, "v_D_mm", language)
    assert told["a_D"].cells[2] == spoken.significant(abs(key("a_D")))


def test_the_table_and_the_summary_leave_out_what_waits():
    found = waiting()
    assert found.pending == Fraction(3, 2)
    assert found.share == 1
    assert found.earned == found.points - found.pending
    (row,) = read_marks(marks_table(Result((found,)))).values()
    assert row["pending"] == "1.5"
    assert row["percent"] == "100.0"
    assert row["v_D"] == row["omega_2_sense"] == ""
    assert row["v_D why"] == "unreadable"
    said = summary([found, graded({})], words("en"))
    assert "mean 100.0 %" in said
    assert "for 1 of them points are still open" in said


def test_a_form_of_which_nothing_can_be_read_has_no_share():
    marker = marker_of("pump", 7)
    answers = {field: Answer("x", problem="number") for field in marker.standard.key}
    found = marker.mark(taker(), answers)
    assert found.share is None
    assert found.pending == found.points
    assert summary([found], words("en")).startswith("1 of 1 students handed in; mean –")
    assert read_marks(marks_table(Result((found,))))["s007"]["percent"] == ""


# --- the page -----------------------------------------------------------------------------------


def mistaken(name: str, slip: str, n: int = 7) -> Graded:
    """The marks of one slip of the construction and its reasons."""
    marker = marker_of(name, n)
    ways = ways_of(marker.standard, key_answers(marker.standard), frozenset())
    values = next(way.values for way in ways if way.names == (slip,))
    return graded(given(dict(values)), name, n)


def test_who_handed_in_nothing_is_not_told_what_is_right():
    marker = marker_of("pump", 7)
    found = marker.mark(taker(), {}, present=False)
    (page,) = feedback_pages(found, "Lab", marker.standard.rubric, words("en"))
    told = " ".join(plain(mark.markup) for mark in page.marks if isinstance(mark, Text))
    assert "you handed in no answers" in told
    assert words("en").significant(key("v_D")) not in told


def test_points_of_a_segment_that_is_computed_stand_in_the_row_of_its_value():
    """One row, as on the form: a_D_mm is not asked where the segment is too small."""
    marker = marker_of("pump", 25)
    computing = replace(taker(25), compute=("a_D_mm", "a_D"))
    found = marker.mark(computing, key_answers(marker.standard))
    symbols = [row.cells[0] for row in rows(found, words("en"))]
    assert "*a*_{D}, m/s^2" in symbols
    assert "*a*_{D}, mm" not in symbols


def letters(page: Page) -> dict[str, list[Text]]:
    """What is written on a page, each with where and how large it stands."""
    found: dict[str, list[Text]] = {}
    for mark in page.marks:
        if isinstance(mark, Text):
            found.setdefault(plain(mark.markup), []).append(mark)
    return found


@pytest.mark.parametrize("language", LANGUAGES)
def test_right_stands_beside_the_points_of_each_row_on_full_pages_and_on_others(language):
    """As on the page for a browser; the senses of answer and key are one size."""
    rubric, spoken = marker_of("slotted-lever", 7).standard.rubric, words(language)
    for found in (graded({}, "slotted-lever"), mistaken("slotted-lever", "rpm_as_rad")):
        (page,) = feedback_pages(found, "Lab", rubric, spoken)
        told = letters(page)
        right = [row for row in rows(found, spoken) if row.why == spoken("feedback.right")]
        assert len(told[spoken("feedback.right")]) == len(right)
        for key in ("anticlockwise", "clockwise", "forward", "backward"):
            sense = told.get(plain(spoken(f"feedback.{key}")), [])
            assert {mark.height for mark in sense} <= {2.5}


def test_data_on_the_page_are_those_of_the_sheet():
    """The crank's length has the letter r in the scene alone."""
    scene = book_of("slotted-lever").mechanism({}).scene
    student = replace(taker(), settings={"n": "7", "r": "96"})
    found = replace(graded({}, "slotted-lever"), taker=student)
    rubric = marker_of("slotted-lever", 7).standard.rubric
    (page,) = feedback_pages(found, "Lab", rubric, words("en"), scene)
    assert "n = 7; O1A = 96 mm" in letters(page)
    assert "<i>n</i> = 7; <i>O</i><sub>1</sub><i>A</i> = 96 mm" in feedback_html(
        found, "Lab", rubric, words("en"), scene
    )


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_stands_after_a_number_and_is_no_unit_is_named(language):
    item = marker_of("pump", 7).standard.by_field["v_D"].item
    told = why(graded({"v_D": read_answer("8.4furlong", item)}), "v_D", language)
    assert "furlong" in told
    assert words(language).spelled("m/s") in told


# --- long names ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["A" * 120, "Wilhelmina " * 9 + "W" * 120, r"A\^_*{}" * 30])
def test_a_name_of_any_length_stays_on_the_page(name):
    """In full above the marks, in lines where it is longer than one; cut in the foot."""
    found = graded({})
    student = replace(found.taker.student, name=name)
    found = replace(found, taker=replace(found.taker, student=student))
    for page in feedback_pages(found, name, marker_of("pump", 7).standard.rubric, words("en")):
        page.check()
        written = "".join(plain(m.markup) for m in page.marks if isinstance(m, Text))
        assert "".join(name.split()) in "".join(written.split())


@pytest.mark.parametrize("lab", ["pump", "slotted-lever"])
def test_no_text_on_a_page_stands_on_another(lab):
    rubric = marker_of(lab, 7).standard.rubric
    for page in feedback_pages(graded({}, lab), "Lab", rubric, words("en")):
        boxes = [reach(mark) for mark in page.marks if isinstance(mark, Text)]
        for one, other in combinations(boxes, 2):
            wide, high = (min(one[i], other[i]) - max(one[i - 2], other[i - 2]) for i in (2, 3))
            assert min(wide, high) <= 1e-6, (one, other)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    "key",
    [
        *("feedback.one_mistake", "feedback.two_mistakes", "feedback.pending"),
        *("desk.undeducted", "desk.unexplained", "feedback.senses_lost"),
    ],
)
def test_one_point_is_not_called_one_points(key, language):
    """No number of points stands right before their name, for 1 would need another form."""
    spoken = words(language)
    said = spoken(key, **dict.fromkeys(spoken.gaps(key), "1"))
    assert not re.search(r"\b1 (points?|Punkte|punti|puntos|puncte|балл)", said)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_heads_of_the_columns_are_of_one_size(language):
    heads = [words(language)(HEADS[name]) for name in COLUMNS]
    sizes = {mark.height for mark in columns(heads, 0.0) if isinstance(mark, Text)}
    assert len(sizes) == 1


def test_a_value_follows_from_its_own_length_by_name():
    """Both have one symbol: "follows from v_D" would send the student in a circle."""
    marker = marker_of("pump", 7)
    key = key_answers(marker.standard)
    wrong = {name: 1.2 * key[name].value for name in ("v_D_mm", "v_D")}
    graded = marker.mark(taker(), key | given(wrong))
    told = {row.cells[0]: plain(row.why) for row in rows(graded, words("en"))}
    (why,) = (each for each in told.values() if "follows rightly" in each)
    assert "from the answer for vD (mm)" in why


@pytest.mark.parametrize("language", LANGUAGES)
def test_feedback_names_a_sense_as_the_form_asks_for_it(language):
    """The words for counter-clockwise and clockwise are those of the sheet's own sentence."""
    told = words(language)
    asked = plain(told("form.senses")).lower()
    for key in ("feedback.anticlockwise", "feedback.clockwise"):
        assert {*plain(told(key)).lower().split()} <= {*re.findall(r"[\w-]+", asked)}
