"""Feedback as a student reads it: how far, why, what waits, in sensible words, on one page."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.class_report import summary
from graphkin.classroom.grading.feedback import feedback_html, feedback_pages, notes, total
from graphkin.classroom.grading.feedback_rows import rows, times
from graphkin.classroom.grading.graded import Answer, EarnedMark, Graded, Result, Status
from graphkin.classroom.grading.marks_tables import marks_table, read_marks, reason
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.text import LANGUAGES, words
from tests.classroom.grading.students import LABS, given, key_answers, marker_of, taker


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


def tolerance(field: str) -> float:
    """How far it may be off."""
    return marker_of("pump", 7).standard.tolerance[field].value


# --- how far ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("language", "few", "score", "hundreds"),
    [
        ("ro", "3,9", "20 de", "1500 de"),
        ("en", "3.9", "20", "1500"),
        ("it", "3,9", "20", "1500"),
    ],
)
def test_times_are_said_as_a_language_says_them(language, few, score, hundreds):
    spoken = words(language)
    assert [times(each, spoken) for each in (3.91, 20.2, 1499)] == [few, score, hundreds]
    assert times(2.04, spoken) == "2"
    assert times(float("inf"), spoken)


@pytest.mark.parametrize(("language", "said"), [("ro", "puțin"), ("en", "just"), ("it", "di poco")])
def test_what_is_hardly_over_is_not_one_time_off(language, said):
    found = graded(given({"v_D_mm": key("v_D_mm") + 1.02 * tolerance("v_D_mm")}))
    assert found.mark("v_D_mm").earned == 0
    assert said in why(found, "v_D_mm", language)
    assert not re.search(r"\d", why(found, "v_D_mm", language))


@pytest.mark.parametrize(
    ("language", "said"), [("ro", "corect: urmează"), ("en", "right: it"), ("it", "giusto: segue")]
)
def test_what_is_right_by_an_own_right_value_says_by_which(language, said):
    """The piston's velocity at the edge of its tolerance, over a scale that is read roughly."""
    own = key("v_D_mm") + 0.99 * tolerance("v_D_mm")
    speed = 1.009 * own * key("v_D") / key("v_D_mm")
    assert speed > key("v_D") + tolerance("v_D")
    found = graded(given({"v_D_mm": own, "v_D": speed}))
    assert found.mark("v_D").earned == found.mark("v_D").points
    assert why(found, "v_D", language).startswith(said)
    assert reason(found, "v_D") == "right from v_D_mm"


def test_what_is_somewhat_over_is_told_beside_what_is_allowed():
    found = graded(given({"a_D_mm": key("a_D_mm") + 3 * tolerance("a_D_mm")}))
    assert why(found, "a_D_mm", "en").startswith("off by 3 times what is allowed")


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (137.0, "140 times the expected value"),
        (1 / 3.3, "3.3 times smaller than the expected value"),
        (0.0, "zero, which the expected value is not"),
        (1e-320, "times smaller"),
        (1e300, "times the expected value"),
    ],
)
def test_what_is_far_off_is_told_beside_the_expected_value(factor, said):
    found = graded(given({"omega_3": factor * key("omega_3")}))
    assert said in why(found, "omega_3", "en")


# --- senses -------------------------------------------------------------------------------------


def contradiction(value: str, sense: float) -> Graded:
    """Student 7 with a signed value of link 3 and a sense; the right one is positive."""
    assert key("omega_3") > 0
    size = abs(key("omega_3"))
    signed = Answer(value, -size if value.startswith("-") else size, signed=value[0] in "+-")
    return graded({"omega_3": signed, "omega_3_sense": Answer("x", sense, signed=True)})


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("value", "sense"), [("-27,6", 1.0), ("+27,6", -1.0)])
def test_a_sense_that_the_sign_of_its_value_contradicts_earns_nothing(value, sense, language):
    """Whichever of the two is right; the value counts by its size."""
    found = contradiction(value, sense)
    assert found.mark("omega_3").status is Status.RIGHT
    mark = found.mark("omega_3_sense")
    assert mark.torn
    assert mark.earned == 0
    assert mark.status is Status.WRONG
    assert why(found, "omega_3_sense", language) == words(language)("feedback.torn")
    table = read_marks(marks_table(Result((found,))))
    assert table["s007"]["omega_3_sense why"] == "wrong contradicts its sign"


@pytest.mark.parametrize(("value", "sense"), [("27,6", 1.0), ("+27,6", 1.0)])
def test_a_sign_and_a_sense_that_agree_are_right(value, sense):
    found = contradiction(value, sense)
    assert found.mark("omega_3_sense").status is Status.RIGHT
    assert found.earned == found.points


def test_a_negative_value_with_the_same_negative_sense_is_wrong_only_in_its_sense():
    found = contradiction("-27,6", -1.0)
    mark = found.mark("omega_3_sense")
    assert not mark.torn
    assert mark.slip == "sense_reversed"
    assert "shows which way it turns" in why(found, "omega_3_sense", "en")


def test_the_sense_of_a_sliding_block_is_not_told_by_its_bar():
    standard = marker_of("slotted-lever", 7).standard
    sense = -standard.key["v_slide_2_sense"]
    found = graded(given({"v_slide_2_sense": sense}), "slotted-lever")
    assert why(found, "v_slide_2_sense", "en") == words("en")("feedback.wrong_sense")


# --- what waits ---------------------------------------------------------------------------------


def waiting() -> Graded:
    """Two answers of the pump that cannot be read, worth 1 and 0.5 points."""
    return graded(
        {
            "v_D": Answer("3,8,2", problem="number"),
            "omega_2_sense": Answer("sus", problem="turning"),
        }
    )


def test_what_cannot_be_read_waits_and_is_not_nought():
    found = waiting()
    assert found.pending == Fraction(3, 2)
    assert found.share == 1
    assert found.earned == found.points - found.pending


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_student_is_told_what_waits_and_what_could_have_been_read(language):
    found, spoken = waiting(), words(language)
    (note,) = notes(found, spoken)
    assert spoken.decimal("1.5") in note
    assert "v" in plain(note)
    decided = spoken("feedback.total", earned="19", points="19")
    waits = spoken("feedback.waiting", pending=spoken.decimal("1.5"), all=spoken.decimal("20.5"))
    assert total(found, spoken) == f"{decided}, {waits}"
    assert plain(spoken("unread.turning")) in why(found, "omega_2_sense", language)
    cells = [row.cells[-1] for row in rows(found, spoken) if row.status is Status.UNREADABLE]
    assert [cell[0] for cell in cells] == ["?", "?"]
    text = feedback_html(found, "Pump", marker_of("pump", 7).standard.rubric, spoken)
    assert "sus" in text


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_slip_that_is_paid_once_says_so(language):
    """Both shares stand on the page with their reason: the slip's own, then what follows."""
    found, spoken = mistaken("pump", "rpm_as_rad"), words(language)
    numbers = [m for m in found.marks if m.slip == "rpm_as_rad" and m.status is Status.SLIP]
    first, second = (why(found, m.item.field, language) for m in numbers[:2])
    assert plain(spoken("feedback.share", share="50")) in first
    again = spoken("feedback.again", source=numbers[0].item.symbol, share="80")
    assert plain(again) in second


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


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_sense_is_told_in_the_language_of_the_page_whatever_was_written(language):
    found = graded({"omega_3_sense": Answer("trigonometric", 1.0, signed=True)})
    marks = [mark.item.field for mark in found.marks if mark.points]
    row = rows(found, words(language))[marks.index("omega_3_sense")]
    assert row.cells[1] == words(language)("feedback.anticlockwise")


def test_what_is_off_by_next_to_nothing_is_off_by_nought():
    found = graded({"v_D": Answer("x", key("v_D") + 1e-5 * tolerance("v_D"))})
    marks = [mark.item.field for mark in found.marks if mark.points]
    assert rows(found, words("en"))[marks.index("v_D")].cells[4] == "0"


def test_the_table_and_the_summary_leave_out_what_waits():
    found = waiting()
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
    values = next(each for each in marker.slips if each.whole and each.name == slip).values
    return graded(given(dict(values)), name, n)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", LABS)
def test_the_feedback_to_a_shipped_lab_is_one_page(name, language):
    rubric, spoken = marker_of(name, 7).standard.rubric, words(language)
    for found in (graded({}, name), mistaken(name, "rpm_as_rad"), mistaken(name, "normal_missing")):
        pages = feedback_pages(found, "Lab", rubric, spoken)
        assert len(pages) == 1
        for page in pages:
            page.check()


def test_every_reason_but_that_of_what_is_right_is_on_the_page():
    rubric, spoken = marker_of("pump", 7).standard.rubric, words("ro")
    found = mistaken("pump", "rpm_as_rad")
    (page,) = feedback_pages(found, "Lab", rubric, spoken)
    told = " ".join(plain(mark.markup) for mark in page.marks if isinstance(mark, Text))
    reasons = [plain(row.why) for row in rows(found, spoken) if row.status is not Status.RIGHT]
    assert reasons
    assert all(" ".join(reason.split()) in " ".join(told.split()) for reason in reasons)


def test_who_handed_in_nothing_is_not_told_what_is_right():
    marker = marker_of("pump", 7)
    found = marker.mark(taker(), {}, present=False)
    (page,) = feedback_pages(found, "Lab", marker.standard.rubric, words("en"))
    told = " ".join(plain(mark.markup) for mark in page.marks if isinstance(mark, Text))
    assert "you handed in no answers" in told
    assert words("en").significant(key("v_D")) not in told


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_cell_of_what_is_expected_is_cut(language):
    rubric, spoken = marker_of("slotted-lever", 7).standard.rubric, words(language)
    (page,) = feedback_pages(graded({}, "slotted-lever"), "Lab", rubric, spoken)
    assert not [mark for mark in page.marks if isinstance(mark, Text) and "…" in mark.markup]


def test_points_of_a_segment_that_is_computed_stand_in_the_row_of_its_value():
    """One row, as on the form: a_D_mm is not asked where the segment is too small."""
    marker = marker_of("pump", 25)
    computing = replace(taker(25), compute=("a_D_mm", "a_D"))
    found = marker.mark(computing, key_answers(marker.standard))
    symbols = [row.cells[0] for row in rows(found, words("en"))]
    assert "*a*_{D}, m/s^2" in symbols
    assert "*a*_{D}, mm" not in symbols


def test_a_mark_tells_no_share_of_nothing():
    item = marker_of("pump", 7).standard.by_field["v_D"].item
    mark = EarnedMark(item, Answer("1", 1.0), Status.WRONG, Fraction(0), Fraction(0), 3.8, 0.1)
    assert Graded(taker(), (mark,)).share is None
