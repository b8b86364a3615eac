"""There and back: what Moodle and Canvas deliver is read, and what they take is written."""

from __future__ import annotations

import csv
import io
import zipfile
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.classroom.grading.answers import read_answers
from graphkin.classroom.grading.gradebook import GradebookError, filled
from graphkin.classroom.grading.gradebook_xlsx import read_gradebook
from graphkin.classroom.grading.marks_tables import read_marks
from graphkin.classroom.grading.submissions import sender, submissions
from graphkin.classroom.roster.student_signs import signs
from graphkin.cli.main import app
from graphkin.text.errors import RosterError
from tests.classroom.grading.students import book_of, marker_of

ROSTER = (
    "nr;id;name;e-mail\n7;01003;Ștefănescu Ana;ana.s@example.org\n"
    "8;01004;O'Neil, Jr. Pat;Pat@Example.org\n9;01005;Popa Ion;ion@example.org\n"
)
SIGNS = signs(
    ["01003", "01004", "01005"],
    {"01003": "ABCDEFGHIJ"},
    {"01003": "ana.s@example.org", "01004": "Pat@Example.org"},
    {"01003": "Ștefănescu Ana", "01004": "O'Neil, Jr. Pat", "01005": "Popa Ion"},
)


def form(n: int, who: str = "") -> str:
    """What the page for the answers saves: a field in each row, perhaps with the id."""
    key = marker_of("pump", n).standard.key
    lines = ["field,value", *([f"id,{who}"] if who else [])]
    return "\n".join([*lines, *(f"{field},{value:.5g}" for field, value in key.items())])


def packed(path: Path, files: dict[str, str | bytes]) -> Path:
    with zipfile.ZipFile(path, "w") as made:
        for name, text in files.items():
            made.writestr(name, text)
    return path


def unpacked(folder: Path, files: dict[str, str | bytes]) -> Path:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return folder


MOODLE = {
    "Ana Ștefănescu_12345_assignsubmission_file_/answers.csv": form(7),
    "Pat O'Neil, Jr._12346_assignsubmission_file/photo.pdf": b"%PDF",
    "Pat O'Neil, Jr._12346_assignsubmission_file/my answers.csv": form(8, "01004"),
    "Ion Popa_777_assignsubmission_file_/drawing.jpg": b"\xff\xd8",
    "Ion Popa_777_assignsubmission_onlinetext_/onlinetext.html": "<p>hello</p>",
}


# --- whose a file is ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "who", "back"),
    [
        (
            "Ana Pop_12_assignsubmission_file_/a.csv",
            "Ana Pop",
            "Ana Pop_12_assignsubmission_file_/",
        ),
        (
            "Ana Pop_12_assignsubmission_file/x/a.csv",
            "Ana Pop",
            "Ana Pop_12_assignsubmission_file/",
        ),
        (
            "Ana Pop_12_assignsubmission_file_a_b.csv",
            "Ana Pop",
            "Ana Pop_12_assignsubmission_file_",
        ),
        ("popana_12345_67890_answers.csv", "popana", ""),
        ("popana_LATE_12345_67890_answers-1.csv", "popana", ""),
        ("answers/0042.csv", None, None),
        ("0042_answers.csv", None, None),
    ],
)
def test_platforms_say_whose_a_file_is(name, who, back):
    found = sender(name)
    assert (found and (found.name, found.back)) == (None if who is None else (who, back))


@pytest.mark.parametrize("make", [packed, unpacked])
def test_moodles_submissions_are_read_with_all_that_lies_beside(tmp_path, make):
    path = make(tmp_path / ("all.zip" if make is packed else "all"), MOODLE)
    found = read_answers(path, book_of("pump").form, SIGNS)
    assert set(found.of) == {"01003", "01004"}
    assert [each.name for each in found.empty] == ["Ion Popa"]
    assert found.senders["01003"].back == "Ana Ștefănescu_12345_assignsubmission_file_/"


@pytest.mark.parametrize("match", ["", "email"])
def test_a_row_without_an_id_is_that_of_the_folder_it_lies_in(tmp_path, match):
    """A table with one row, by whatever students are found in other tables."""
    key = marker_of("pump", 7).standard.key
    table = f"{';'.join(key)}\n{';'.join(f'{value:.5g}' for value in key.values())}\n"
    files = {
        "Ana Ștefănescu_12345_assignsubmission_file/answers.csv": table,
        "Ion Popa_777_assignsubmission_file/sub/x.csv": f"Matricol;v_D\n1005;{key['v_D']}\n"
        if not match
        else table,
    }
    found = read_answers(packed(tmp_path / "all.zip", files), book_of("pump").form, SIGNS, match)
    assert set(found.of) == {"01003", "01005"}
    assert found.of["01003"]["v_D"].value == pytest.approx(key["v_D"], rel=1e-4)
    assert {who: sender.back for who, sender in found.senders.items()} == {
        "01003": "Ana Ștefănescu_12345_assignsubmission_file/",
        "01005": "Ion Popa_777_assignsubmission_file/",
    }


def test_a_row_without_an_id_of_nobody_is_refused(tmp_path):
    files = {"Eva Nimeni_12345_assignsubmission_file/answers.csv": "v_D\n3.8\n"}
    with pytest.raises(RosterError, match="no column id"):
        read_answers(packed(tmp_path / "all.zip", files), book_of("pump").form, SIGNS)


def test_rows_of_several_without_ids_are_refused_in_a_folder_of_one(tmp_path):
    files = {"Ana Ștefănescu_12345_assignsubmission_file/answers.csv": "v_D\n3.8\n3.9\n"}
    with pytest.raises(RosterError, match="no column id"):
        read_answers(packed(tmp_path / "all.zip", files), book_of("pump").form, SIGNS)


def test_canvas_has_all_files_in_one_folder_by_names_run_together(tmp_path):
    files = {"stefanescuana_901_11_a.csv": form(7), "popaion_LATE_903_12_a.csv": form(9)}
    found = read_answers(packed(tmp_path / "s.zip", files), book_of("pump").form, SIGNS)
    assert set(found.of) == {"01003", "01005"}


def test_a_name_that_two_students_have_is_nobodys(tmp_path):
    twins = signs(["1", "2"], names={"1": "Popa Ion", "2": "Ion Popa"})
    files = {"Ion Popa_777_assignsubmission_file_/a.csv": form(7)}
    with pytest.raises(RosterError, match="no student of this class"):
        read_answers(packed(tmp_path / "s.zip", files), book_of("pump").form, twins)


def test_the_file_itself_says_whose_it_is_before_the_platform_does(tmp_path):
    files = {"Ion Popa_777_assignsubmission_file_/a.csv": form(7, "ABCDEFGHIJ")}
    found = read_answers(packed(tmp_path / "s.zip", files), book_of("pump").form, SIGNS)
    assert set(found.of) == {"01003"}


def test_what_is_no_zip_and_what_holds_too_much_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "a.zip"
    path.write_bytes(b"PK\x03\x04 nothing")
    with pytest.raises(RosterError, match="cannot be read as a ZIP file"):
        submissions(path)
    packed(path, {"readme.md": "no table", "__MACOSX/._a.csv": "x"})
    with pytest.raises(RosterError, match="without any table"):
        submissions(path)
    packed(path, {"a.csv": "x" * 200})
    monkeypatch.setattr("graphkin.classroom.grading.submissions.LARGEST", 100)
    with pytest.raises(RosterError, match=r"a.csv: is too large"):
        submissions(path)


# --- who a row is -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("sign", "who"),
    [
        ("01003", "01003"),
        ("1003", "01003"),
        ("ABCDEFGHIJ", "01003"),
        ("ANA.S@example.org", "01003"),
        ("13", None),
        ("", None),
        ("²", None),
    ],
)
def test_ids_codes_addresses_and_lost_zeros(sign, who):
    assert SIGNS.who(sign) == who


def test_lost_zeros_that_two_students_could_have_lost_are_nobodys():
    twins = signs(["041", "0041", "42", "042"])
    assert twins.who("41") is None
    assert twins.who("42") == "42"


def test_a_table_of_answers_may_be_signed_by_addresses(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Timestamp,Email Address,v_D_mm\nx,pat@example.org,12\n", encoding="utf-8")
    found = read_answers(path, book_of("pump").form, SIGNS)
    assert found.of["01004"]["v_D_mm"].value == 12
    with pytest.raises(RosterError, match="no column id"):
        read_answers(path, book_of("pump").form, SIGNS, "id")
    path.write_text("id,email,v_D_mm\n5,pat@example.org,12\n", encoding="utf-8")
    assert "01004" in read_answers(path, book_of("pump").form, SIGNS, "email").of


WORKSHEET = (
    "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Feedback comments\r\n"
    "Participant 12345,Ana,ana.s@example.org,Submitted,,10,\r\n"
    "Participant 12346,Pat,pat@example.org,Submitted,,10,\r\n"
)
MARKS = {"01003": Fraction(9), "01004": Fraction(15, 2)}


def book(tmp_path: Path, text: str):
    (tmp_path / "book.csv").write_bytes(text.encode("utf-8"))
    return read_gradebook(tmp_path / "book.csv")


def test_a_gradebook_without_ids_is_filled_by_addresses(tmp_path):
    found = filled(book(tmp_path, WORKSHEET), MARKS, "Grade", SIGNS)
    assert b"org,Submitted,9,10," in found.data and b"org,Submitted,7.5,10," in found.data
    assert found.worth == 10 and not found.absent
    unnamed = filled(
        book(tmp_path, WORKSHEET.replace("Status,", "Last modified,")), MARKS, None, SIGNS
    )
    assert unnamed.data == found.data.replace(b"Status,", b"Last modified,")
    with pytest.raises(GradebookError, match="no column holds ids of this class"):
        filled(book(tmp_path, WORKSHEET), MARKS, "Grade", SIGNS, "id")
    with pytest.raises(GradebookError, match="the class list has no column e-mail"):
        filled(book(tmp_path, WORKSHEET), MARKS, "Grade", signs(MARKS))


def test_ids_that_a_spreadsheet_made_numbers_are_found_in_a_gradebook(tmp_path):
    text = "Row,ID number,Grade\r\n1,1003,\r\n2,1004,\r\n"
    found = filled(book(tmp_path, text), MARKS, "Grade", SIGNS)
    assert found.data == b"Row,ID number,Grade\r\n1,1003,9\r\n2,1004,7.5\r\n"


def test_a_row_without_an_id_is_found_by_its_address(tmp_path):
    """Where that is one student's, who has no row with the id; a foreign id is nobody's."""
    text = "ID,E-mail,Grade\r\n01003,,\r\n,PAT@example.org,\r\n,ana.s@example.org,\r\n"
    found = filled(book(tmp_path, text), MARKS, "Grade", SIGNS)
    rows = found.data.decode().split("\r\n")
    assert rows[1:4] == ["01003,,9", ",PAT@example.org,7.5", ",ana.s@example.org,"]
    assert (found.count, found.absent) == (2, ())
    assert filled(book(tmp_path, text), MARKS, "Grade", SIGNS, "id").absent == ("01004",)
    foreign = text.replace(",PAT", "77,PAT")
    assert filled(book(tmp_path, foreign), MARKS, "Grade", SIGNS).absent == ("01004",)
    with pytest.raises(GradebookError, match='"01004" stands there twice'):
        filled(book(tmp_path, text + ",pat@example.org,\r\n"), MARKS, "Grade", SIGNS)


def test_a_gradebook_without_an_empty_column_is_told_with_those_that_lack_a_mark(tmp_path):
    text = "ID number,Name,Grade\r\n01003,Ana,7\r\n01004,Pat,\r\n"
    told = 'no column is empty; expected one of "Grade"; name the column with --column'
    with pytest.raises(GradebookError, match=told):
        filled(book(tmp_path, text), MARKS, None, SIGNS)
    full = text.replace("Pat,", "Pat,8")
    told = 'no column is empty; expected one of "ID number", "Name", "Grade"'
    with pytest.raises(GradebookError, match=told):
        filled(book(tmp_path, full), MARKS, None, SIGNS)


# --- the command --------------------------------------------------------------------------------


def grade(folder: Path, answers: Path, *more: str):
    args = ["grade", str(folder / "class"), str(answers), "-o", str(folder / "out"), *more]
    return CliRunner().invoke(app, args)


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "roster.csv").write_text(ROSTER, encoding="utf-8")
    args = ["variants", "pump", str(tmp_path / "roster.csv"), "-o", str(tmp_path / "class")]
    made = CliRunner().invoke(app, args)
    assert made.exit_code == 0, made.output
    return tmp_path


def test_from_moodles_zip_to_its_worksheet_and_its_feedback(folder):
    (folder / "moodle.csv").write_text(WORKSHEET, encoding="utf-8")
    answers = packed(folder / "submissions.zip", MOODLE)
    book = ("--gradebook", str(folder / "moodle.csv"), "--column", "Grade", "--lang", "en")
    found = grade(folder, answers, *book, "--format", "html")
    assert found.exit_code == 0, found.output
    assert "Ion Popa handed in no table of answers" in found.output
    assert "is worth 10 points there, full marks are 20.5; --scale 10" in found.output
    first = (folder / "out" / "feedback-moodle.zip").read_bytes()
    with zipfile.ZipFile(io.BytesIO(first)) as back:
        assert back.namelist() == [
            "Ana Ștefănescu_12345_assignsubmission_file_/feedback.html",
            "Pat O'Neil, Jr._12346_assignsubmission_file/feedback.html",
        ]
        for name, stem in zip(back.namelist(), ("01003", "01004"), strict=True):
            assert back.read(name) == (folder / f"out/feedback/{stem}.html").read_bytes()
    again = grade(folder, answers, *book, "--format", "html", "--scale", "10", "--force")
    assert "is worth" not in again.output
    text = (folder / "out" / "gradebook-moodle.csv").read_text(encoding="utf-8")
    assert [row["Grade"] for row in csv.DictReader(io.StringIO(text))] == ["10", "10"]
    assert (folder / "out" / "feedback-moodle.zip").read_bytes() == first
    assert read_marks((folder / "out" / "marks.csv").read_bytes())["01003"]["points"] == "20.5"


def test_a_scale_is_a_number_above_nought(folder):
    answers = packed(folder / "s.zip", MOODLE)
    for scale in ("0", "ten", "1e9"):
        found = grade(folder, answers, f"--scale={scale}")
        assert found.exit_code == 2 and "--scale" in found.output, scale
    assert not (folder / "out").exists()
