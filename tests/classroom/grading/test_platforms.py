"""There and back: what Moodle and Canvas deliver is read, and what they take is written."""

from __future__ import annotations

import csv
import io
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.classroom.grading.answers import read_answers, sender, submissions
from graphkin.classroom.grading.grading_files import read_marks
from graphkin.classroom.roster.students import signs
from graphkin.cli.main import app
from graphkin.text.errors import RosterError
from tests.classroom.grading.students import book_of, marker_of
from tests.classroom.grading.test_gradebooks import WORKSHEET

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


SENT = """Ana Pop_12_assignsubmission_file_/a.csv|Ana Pop|Ana Pop_12_assignsubmission_file_/
Ana Pop_12_assignsubmission_file/x/a.csv|Ana Pop|Ana Pop_12_assignsubmission_file/
Ana Pop_12_assignsubmission_file_a_b.csv|Ana Pop|Ana Pop_12_assignsubmission_file_
popana_12345_67890_answers.csv|popana|
popana_LATE_12345_67890_answers-1.csv|popana|
answers/0042.csv
0042_answers.csv"""
"""Files, by whom they are, and where feedback goes back to; two that say nothing of that."""


@pytest.mark.parametrize("line", SENT.splitlines())
def test_platforms_say_whose_a_file_is(line):
    name, *whose = line.split("|")
    found = sender(name)
    assert whose == ([] if found is None else [found.name, found.back])


def test_moodles_submissions_are_read_with_all_that_lies_beside(tmp_path):
    for path in (packed(tmp_path / "all.zip", MOODLE), unpacked(tmp_path / "all", MOODLE)):
        found = read_answers(path, book_of("pump").form, SIGNS)
        assert set(found.of) == {"01003", "01004"}
        assert [each.name for each in found.empty] == ["Ion Popa"]
        assert found.senders["01003"].back == "Ana Ștefănescu_12345_assignsubmission_file_/"


def test_an_empty_table_is_no_table_that_was_not_handed_in(tmp_path):
    """It is told by its name: its student may have saved it badly."""
    empty = "Ion Popa_777_assignsubmission_file_/answers.csv"
    files = MOODLE | {empty: ""}
    for path in (packed(tmp_path / "all.zip", files), unpacked(tmp_path / "all", files)):
        assert submissions(path).empty == ()
        found = read_answers(path, book_of("pump").form, SIGNS)
        assert found.withheld == ["01005"]
        assert f"{empty}: the table is empty" in str(found.refused[0].problem)


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


@pytest.mark.parametrize(
    ("names", "who"),
    [
        # all files in one folder by names run together, as Canvas has them
        ({"stefanescuana_901_11_a.csv": form(7), "popaion_LATE_903_12_a.csv": form(9)}, "35"),
        # the platform says whose a folder is, whatever the file in it says
        (
            {"Ion Popa_777_assignsubmission_file_/a.csv": form(7, "ABCDEFGHIJ")},
            "is the id of Ștefănescu Ana, and the file is in the folder of Ion Popa",
        ),
        ({"Eva Nimeni_12345_assignsubmission_file/answers.csv": "v_D\n3.8\n"}, "no column id"),
        ({"Ana Ștefănescu_1_assignsubmission_file/a.csv": "v_D\n3.8\n3.9\n"}, "no column id"),
        ({"Ion Popa_777_assignsubmission_file_/a.csv": form(7)}, "is missing"),
    ],
    ids=["canvas", "signed", "nobody", "several", "twins"],
)
def test_whose_a_file_is_or_why_it_is_nobody_s(tmp_path, names, who):
    """A name that two students have is nobody's, nor are rows of several in a folder of one."""
    path, fields = packed(tmp_path / "s.zip", names), book_of("pump").form
    if who.isdecimal():
        assert set(read_answers(path, fields, SIGNS).of) == {f"0100{last}" for last in who}
        return
    twins = signs(["1", "2"], names={"1": "Popa Ion", "2": "Ion Popa"})
    with pytest.raises(RosterError, match=who):
        read_answers(path, fields, twins if who == "is missing" else SIGNS)


def test_what_is_no_zip_and_what_holds_too_much_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "a.zip"
    path.write_bytes(b"PK\x03\x04 nothing")
    with pytest.raises(RosterError, match="cannot be read as a ZIP file"):
        submissions(path)
    packed(path, {"readme.md": "no table", "__MACOSX/._a.csv": "x"})
    with pytest.raises(RosterError, match="without any table"):
        submissions(path)
    packed(path, {"a.csv": "x" * 200})
    monkeypatch.setattr("graphkin.classroom.grading.answers.LARGEST", 100)
    with pytest.raises(RosterError, match=r"a.csv: is too large"):
        submissions(path).tables[0].read()
    monkeypatch.setattr("graphkin.classroom.grading.answers.MOST_BYTES", 100)
    with pytest.raises(RosterError, match=r"a.zip: is too large"):
        submissions(path)


# --- who a row is -------------------------------------------------------------------------------


def test_ids_codes_addresses_and_lost_zeros():
    """Zeros that two students could have lost are nobody's."""
    for sign in ("01003", "1003", "ABCDEFGHIJ", "ANA.S@example.org"):
        assert SIGNS.who(sign) == "01003"
    assert {SIGNS.who(sign) for sign in ("13", "", "²")} == {None}
    twins = signs(["041", "0041", "42", "042"])
    assert (twins.who("41"), twins.who("42")) == (None, "42")


def test_a_table_of_answers_may_be_signed_by_addresses(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Timestamp,Email Address,v_D_mm\nx,pat@example.org,12\n", encoding="utf-8")
    found = read_answers(path, book_of("pump").form, SIGNS)
    assert found.of["01004"]["v_D_mm"].value == 12
    with pytest.raises(RosterError, match="no column id"):
        read_answers(path, book_of("pump").form, SIGNS, "id")
    path.write_text("id,email,v_D_mm\n5,pat@example.org,12\n", encoding="utf-8")
    assert "01004" in read_answers(path, book_of("pump").form, SIGNS, "email").of


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


def test_a_scale_is_a_number_above_zero(folder):
    answers = packed(folder / "s.zip", MOODLE)
    for scale in ("0", "ten", "1e9"):
        found = grade(folder, answers, f"--scale={scale}")
        assert found.exit_code == 2 and "--scale" in found.output, scale
    assert not (folder / "out").exists()
