"""What a lecturer decides stands above the marking, is told everywhere, and survives it."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answers import Unread
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.class_report import open_cells
from graphkin.classroom.grading.decisions import EMPTY, Deciding, Releases, read_decisions
from graphkin.classroom.grading.feedback import feedback_html, feedback_pages
from graphkin.classroom.grading.graded import Answer, Decision, Status
from graphkin.classroom.grading.grading_files import (
    ReportSettings,
    points_by_id,
    read_marks,
    report_files,
)
from graphkin.classroom.roster.students import signs
from graphkin.text import words
from graphkin.text.errors import RosterError
from tests.chosen import SPOKEN
from tests.classroom.grading.students import book_of, key_answers, lab_of, marker_of, taker

LAB = "slotted-lever"
WHO = ("s007", "s008", "s009")
TAKERS = tuple(taker(n) for n in (7, 8, 9))


def deciding() -> Deciding:
    return Deciding(TAKERS, book_of(LAB).form, lab_of(LAB).rubric, signs(WHO))


def read(folder: Path, text: str) -> tuple[Decision, ...]:
    (folder / "decisions.csv").write_text(text, encoding="utf-8")
    return read_decisions(folder, deciding())


def answers():
    """One is right but for a wrong and an unreadable cell, one copies the next, one is absent."""
    right = key_answers(marker_of(LAB, 7).standard)
    spoilt = {"v_C_mm": Answer("999", 999.0), "a_C": Answer("12,3,4", problem="number")}
    copied = key_answers(marker_of(LAB, 20).standard)
    return {"s007": right | spoilt, "s008": copied}


def marked(decisions=(), hold=False):
    lab = lab_of(LAB)
    book = replace(book_of(LAB), lab=replace(lab, rubric=replace(lab.rubric, hold=hold)))
    takers = (*TAKERS, taker(20))
    given = answers() | {"s020": key_answers(marker_of(LAB, 20).standard)}
    return graded_class(book, takers, given, decisions=decisions)


def of(found, who):
    return next(g for g in found.graded if g.taker.student.id == who)


def test_a_table_of_any_separator_and_language_is_read(tmp_path):
    """No file and the empty one decide nothing."""
    assert read_decisions(tmp_path, deciding()) == ()
    rows = ["matricol;mărime;puncte;motiv", 's007;v_C_mm;"1,5";measured again', "s007;a_C;;stands"]
    text = "\n".join([*rows, "s008;total;?;asked"])
    for separator in ";,\t":
        assert read(tmp_path, text.replace(";", separator)) == (
            Decision("s007", "v_C_mm", Fraction(3, 2), "measured again"),
            Decision("s007", "a_C", None, "stands"),
            Decision("s008", "", None, "asked", is_open=True),
        )
    (tmp_path / "decisions.csv").write_bytes(EMPTY)
    assert read_decisions(tmp_path, deciding()) == ()


def test_all_that_is_wrong_is_told_by_its_line(tmp_path):
    text = (
        "id;field;points;reason\ns07;v_C_mm;1;why\ns007;v_D_mm;1;why\ns007;v_C_mm;99;why\n"
        "s007;v_C_mm;1;\ns007;;3;no field\ns007;total;100;too much\ns008;a_C;x;why\n"
        "s008;a_C_mm;1;why\ns008;a_C_mm;0;why\n"
    )
    with pytest.raises(RosterError) as caught:
        read(tmp_path, text)
    told = [str(problem) for problem in caught.value.problems]
    assert [int(line.split("row ")[1].partition(",")[0].partition(":")[0]) for line in told] == [
        *(2, 3, 4, 5, 6, 7, 8, 10)
    ]
    assert "no student of this class" in told[0] and "did you mean s007?" in told[0]
    assert "no field of this student's form" in told[1]
    assert '"99"; expected 0 to 2' in told[2]
    assert 'column "reason": is missing' in told[3]
    assert "decided in row 9 already" in told[7]
    with pytest.raises(RosterError, match="no column points, reason"):
        read(tmp_path, "id;field\ns007;v_C_mm\n")


def test_points_of_fields_and_of_the_whole_take_the_place_of_those_found():
    before = marked()
    points = Fraction(3, 2)
    after = marked(
        [
            Decision("s007", "v_C_mm", points, "measured again"),
            Decision("s007", "a_C", Fraction(0), "illegible"),
            Decision("s008", "", Fraction(1), "copied"),
            Decision("s009", "", Fraction(2), "handed in on paper"),
        ]
    )
    one, old = of(after, "s007"), of(before, "s007")
    assert old.pending and not one.pending
    assert one.earned - old.earned == points - old.mark("v_C_mm").earned
    assert one.mark("v_C_mm").decision.before == old.mark("v_C_mm").earned
    assert one.mark("a_C").decision.before is None
    assert of(after, "s008").earned == 1
    assert of(after, "s008").decision.before == of(before, "s008").earned
    assert not of(before, "s009").present and of(after, "s009").earned == 2
    assert {"s007", "s008", "s009"} <= set(points_by_id(after))
    assert after.wrong_variants == before.wrong_variants
    assert not of(after, "s009").present
    page = feedback_html(of(after, "s009"), "Lab", lab_of(LAB).rubric, words("en"))
    assert "handed in on paper" in page and "<table" not in page
    assert words("en")("feedback.absent") not in page
    assert one.mark("v_C_mm").status is Status.WRONG  # statistics stay those of the answers


def test_a_cell_that_was_decided_waits_no_more():
    cells = [Unread("a.csv", 2, "s007", field, "x", "number") for field in ("a_C", "v_C")]
    spoilt = {"v_C": Answer("x", problem="number")}
    given = {"s007": answers()["s007"] | spoilt}
    for decision, left in (
        (None, cells),
        (Decision("s007", "a_C", Fraction(0), "no"), cells[1:]),
        (Decision("s007", "a_C", None, "stays open"), cells),
        (Decision("s007", "", Fraction(3), "all in all"), []),
    ):
        made = graded_class(book_of(LAB), TAKERS, given, decisions=[decision] if decision else [])
        assert open_cells(made, cells) == left


def test_a_row_releases_who_is_held_and_an_open_request_does_not():
    for decision, held in (
        (None, True),
        (Decision("s008", "", None, "spoke with her"), False),
        (Decision("s008", "", Fraction(0), "copied"), False),
        (Decision("s008", "v_C_mm", None, "asked for it", is_open=True), True),
    ):
        found = marked([decision] if decision else [], hold=True)
        assert of(found, "s008").held == held
        assert ("s008" in points_by_id(found)) != held


def test_the_list_of_those_released_is_written_as_a_lecturer_reads_it():
    (text,) = Releases(("Șerban-7", "s008")).files().values()
    assert text.decode("utf-8") == '["Șerban-7", "s008"]\n'


@pytest.mark.parametrize("language", SPOKEN)
def test_reasons_stand_on_feedback_in_the_report_and_in_the_marks(language):
    reason = "măsurat <din nou> *pe* foaie"
    found = marked(
        [
            Decision("s007", "v_C_mm", Fraction(3, 2), reason),
            Decision("s007", "a_C", Fraction(1), "citit de mine"),
            Decision("s007", "", None, "văzut"),
            Decision("s008", "", Fraction(1), "copied"),
            Decision("s009", "v_C_mm", None, "please", is_open=True),
        ]
    )
    spoken = words(language)
    page = feedback_html(of(found, "s007"), "Lab", lab_of(LAB).rubric, spoken)
    escaped = "măsurat &lt;din nou&gt; *pe* foaie"
    assert spoken("feedback.decided", reason=escaped) in page
    assert spoken("feedback.decided", reason="citit de mine") in page
    assert spoken("feedback.kept", reason="văzut") in page
    assert spoken("feedback.held") not in page and ">?<" not in page
    assert feedback_pages(of(found, "s007"), "Lab", lab_of(LAB).rubric, spoken)
    files = report_files(found, lab_of(LAB), ReportSettings("Lab", spoken), ())
    report = files["class.html"].decode("utf-8")
    for key in ("decisions", "requests"):
        assert spoken(f"class.{key}") in report
    assert escaped in report and "please" in report
    before = {g.taker.student.id: g.earned for g in marked().graded}
    assert of(found, "s009").earned == before["s009"]  # what is asked changes no points
    rows = read_marks(files["marks.csv"])
    assert rows["s007"]["v_C_mm why"].endswith(f"; decided, was 0: {reason}")
    assert rows["s007"]["a_C why"] == "unreadable; decided, was open: citit de mine"
    assert rows["s007"]["decision"] == "stands: văzut"
    assert rows["s008"]["points"] == "1" and rows["s008"]["decision"].startswith("decided, was ")
