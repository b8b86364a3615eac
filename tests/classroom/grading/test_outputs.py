"""What grading writes: marks, feedback, report, gradebooks as they were but for the marks."""

from __future__ import annotations

import csv
import errno
import io
import re
import shutil
import sys
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from graphkin.classroom.grading import class_report, gradebook_xlsx
from graphkin.classroom.grading.class_marking import Class, graded_class
from graphkin.classroom.grading.class_pictures import pictures
from graphkin.classroom.grading.decisions import EMPTY
from graphkin.classroom.grading.feedback import feedback_pages
from graphkin.classroom.grading.gradebook import GradebookError, filled
from graphkin.classroom.grading.gradebook_xlsx import read_gradebook
from graphkin.classroom.grading.graded import Answer, Taker
from graphkin.classroom.grading.grading_files import ReportSettings, points_by_id, report_files
from graphkin.classroom.grading.marks_tables import differences, marks_table, read_marks
from graphkin.classroom.roster.spreadsheets import SEPARATORS
from graphkin.classroom.roster.student import Student
from graphkin.cli.main import app
from graphkin.text import words
from tests.chosen import SPOKEN
from tests.classroom.grading.students import book_of, given, key_answers, lab_of, marker_of
from tests.running import killed_at

HOSTILE = '<script>alert("1")</script> O\'Neil, Jr. Ștefan _*^{} \u202eabc'
MARKS = {"0001": Fraction(17, 2), "0002": Fraction(12), "X9": Fraction(1)}


NO_PAGES = ("--format", "none")
"""Marks alone, without feedback and report."""


DRAWN: dict[str, dict[str, bytes]] = {}
"""The pictures of the first report in each language."""


@pytest.fixture(autouse=True)
def pictures_drawn_once(monkeypatch):
    """Pictures take most of the time of a report, and none of these tests looks into them."""

    def drawn(graded, words, *more):
        if words.language not in DRAWN:
            DRAWN[words.language] = pictures(graded, words, *more)
        return DRAWN[words.language]

    monkeypatch.setattr(class_report, "pictures", drawn)


@cache
def small_class(**changes: float) -> Class:
    """Two students of the pump, one with a hostile name and some answers changed, one absent."""
    marker = marker_of("pump", 7)
    answers = {"=1+1": {**key_answers(marker.standard), **given(changes)}}
    answers["=1+1"]["v_D"] = Answer("<b>3,8,2</b>", problem="number")
    takers = [
        Taker(Student(2, "=1+1", 7, HOSTILE, "=cmd"), {"n": "7"}, "ABCDEFGHIJ"),
        Taker(Student(3, "0002", 8, "Ana", "321"), {"n": "8"}, "KLMNOPQRST"),
    ]
    return graded_class(book_of("pump"), takers, answers)


def files(found: Class, language: str = "en", before: bytes = b"") -> dict[str, bytes]:
    """The files of a report."""
    told = ReportSettings(HOSTILE, words(language))
    return report_files(found, lab_of("pump"), told, ("html",), before)


@pytest.mark.parametrize("language", SPOKEN)
def test_every_page_is_whole_escaped_and_fetches_nothing(language):
    for name, data in files(small_class(omega_3=1.0, omega_2_sense=-1.0), language).items():
        if not name.endswith(".html"):
            continue
        text = data.decode("utf-8")
        assert f'lang="{language}"' in text
        assert "<script" not in text
        assert "<b>3" not in text
        assert not re.search(r"(?:src|href)=\"(?!data:image/png;base64,)", text)
        assert "http" not in text.replace("http-equiv", "")
        assert "{" not in re.sub(r"<style>.*?</style>", "", text).replace("_*^{}", "")


def test_marks_are_a_table_that_no_spreadsheet_runs():
    data = marks_table(small_class().result)
    table = list(csv.DictReader(io.StringIO(data.decode("utf-8-sig"))))
    assert [row["id"] for row in table] == ["'=1+1", "0002"]
    assert table[0]["group"] == "'=cmd"
    assert table[0]["v_D why"] == "unreadable"
    assert table[1]["points"] == ""
    assert table[0]["points"] == table[0]["of"]
    worth = lab_of("pump").rubric.points
    assert float(table[0]["of"]) == float(sum(worth.values()) - worth["v_D"])
    assert float(table[0]["pending"]) == float(worth["v_D"])


def test_a_new_marking_lists_what_changed_and_nothing_else():
    before = files(small_class(omega_3=1.0))["marks.csv"]
    after = files(small_class(), before=before)
    found = differences(before, after["marks.csv"])
    assert {column for _, column, *_ in found} == {"points", "percent", "omega_3", "omega_3 why"}
    assert "differences.csv" in after
    assert not differences(before, before)
    assert read_marks(b"nothing") == {}


# --- gradebooks ---------------------------------------------------------------------------------

MOODLE = (
    '\ufeff"First name",Surname,"ID number",Institution,"Assignment: Lab 3 (Real)",'
    '"Feedback: Lab 3","Last downloaded"\r\n'
    'Ana,"O\'Neil, Jr.",0001,UPB,-,,1700000000\r\n'
    '"Ștefan ""Fane""",Ionescu,"0002",UPB,"-",,1700000000\r\n'
    "Guest,X,9999,UPB,-,,1700000000\r\n"
)
CANVAS = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Lab 3 (4711),Final Score\n"
    "    Points Possible,,,,,24,(read only)\n"
    '"O\'Neil, Ana",77,0001,ana,A,,88.5\n'
    '"Ionescu, Ștefan",78,0002,stefan,A,,\n'
)


def book(tmp_path: Path, text: str, name: str = "book.csv"):
    path = tmp_path / name
    path.write_bytes(text.encode("utf-8"))
    return read_gradebook(path)


def test_moodle_keeps_all_but_the_marks(tmp_path):
    found = filled(book(tmp_path, MOODLE), MARKS, "Lab 3 (Real)")
    expected = MOODLE.replace('UPB,-,,1700000000\r\n"Ș', 'UPB,8.5,,1700000000\r\n"Ș')
    expected = expected.replace('UPB,"-"', 'UPB,"12"')
    assert found.data.decode("utf-8") == expected
    assert found.count == 2
    assert found.absent == ("X9",)
    assert found.strangers == {4: "Guest X"}


def test_canvas_keeps_its_row_of_points_and_its_quotes(tmp_path):
    found = filled(book(tmp_path, CANVAS), MARKS)
    expected = CANVAS.replace("A,,88.5", "A,8.5,88.5").replace("stefan,A,,", "stefan,A,12,")
    assert found.data.decode("utf-8") == expected
    assert found.column == "Lab 3 (4711)"
    assert not found.strangers  # the row of points is no student's
    bare = CANVAS.replace("88.5", "")  # nothing is marked yet: what Canvas computes is empty, too
    assert filled(book(tmp_path, bare), MARKS).column == found.column


@pytest.mark.parametrize(
    ("text", "column", "words_found"),
    [
        (MOODLE, "Lab 9", "is no column"),
        (MOODLE.replace("0001", "a").replace("0002", "b"), None, "no column holds ids"),
        (CANVAS.replace("Section", "Lab 4"), "Lab", "several columns"),
        (CANVAS + '"Twin",79,0002,x,A,,\n', None, "stands there twice"),
        ('id,"mark\n0001,\n', None, "never closed"),
        ("id,mark\n", None, "no row below"),
    ],
)
def test_a_gradebook_that_cannot_be_filled_is_refused(tmp_path, text, column, words_found):
    with pytest.raises(GradebookError, match=words_found):
        filled(book(tmp_path, text), MARKS, column)


def test_cells_of_a_gradebook_are_those_that_a_spreadsheet_reads(tmp_path):
    """Against the csv module, on cells that hold quotes, separators and ends of lines."""
    table = [["id", "x"], ['a";b', 'c"'], ['""', "d\ne;"], ['";"', " f"]]
    for separator in SEPARATORS:
        file = io.StringIO(newline="")
        csv.writer(file, delimiter=separator).writerows(table)
        text = file.getvalue()
        opened = book(tmp_path, text)
        read = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
        assert [[cell.text for cell in row] for row in opened.rows] == [
            [cell.strip() for cell in row] for row in read
        ]


def test_a_gradebook_of_too_many_cells_is_not_read_to_its_end(tmp_path, monkeypatch):
    seen = []
    cell = gradebook_xlsx.cell
    monkeypatch.setattr(gradebook_xlsx, "MOST_CELLS", 50)
    monkeypatch.setattr(gradebook_xlsx, "cell", lambda raw: seen.append(raw) or cell(raw))
    with pytest.raises(GradebookError, match="more than 50 cells"):
        book(tmp_path, "id,mark\n" + "\n" * 1000)
    assert len(seen) == 50


@pytest.mark.parametrize("column", ["First name", "Surname", "ID number", "Institution"])
def test_no_mark_is_written_over_a_name_or_an_id(tmp_path, column):
    with pytest.raises(GradebookError, match="no points"):
        filled(book(tmp_path, MOODLE), MARKS, column)


# --- marks that are held ------------------------------------------------------------------------


@cache
def held_class(*released: str) -> Class:
    """One of three hands in the data of another's number; the lab holds such marks."""
    lab = lab_of("pump")
    book = replace(book_of("pump"), lab=replace(lab, rubric=replace(lab.rubric, hold=True)))
    takers = [
        Taker(Student(n, f"{n:04d}", n, f"Name {n}"), {"n": str(n)}, "ABCDEFGHI" + "JKL"[n % 3])
        for n in (7, 13, 20)
    ]
    keys = {n: key_answers(marker_of("pump", n).standard) for n in (7, 20)}
    answers = {"0007": keys[7], "0013": keys[20]}
    return graded_class(book, takers, answers, released=released)


@pytest.mark.parametrize("language", ["it"])
def test_a_held_mark_is_nowhere_until_it_is_released(language):
    found, given_back = held_class(), held_class("0013")
    assert [each.held for each in found.result.graded] == [False, True, False]
    assert not any(each.held for each in given_back.result.graded)
    assert set(points_by_id(found)) == {"0007"}
    assert set(points_by_id(given_back)) == {"0007", "0013"}
    made, after = files(found, language), files(given_back, language)
    held, free = (read_marks(each["marks.csv"]) for each in (made, after))
    assert held["0007"] == free["0007"]
    assert held["0013"]["points"] == held["0013"]["percent"] == ""
    assert held["0013"]["evidence"] == "fits 0020; held"
    assert float(free["0013"]["points"]) > 0
    assert free["0013"]["evidence"] == "fits 0020"
    said = words(language)("feedback.held")
    pages = [each["feedback/0013.html"].decode("utf-8") for each in (made, after)]
    assert said in pages[0] and "<table" not in pages[0]
    assert said not in pages[1] and "<table" in pages[1]
    assert made["feedback/0007.html"] == after["feedback/0007.html"]
    rubric, spoken = lab_of("pump").rubric, words(language)
    drawn = [
        feedback_pages(each.result.graded[1], "", rubric, spoken) for each in (found, given_back)
    ]
    assert ["'table'" in repr(pages) for pages in drawn] == [False, True]
    report = made["class.html"].decode("utf-8")
    assert "--release" in report
    assert "--release" not in after["class.html"].decode("utf-8")


# --- the command --------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path) -> Path:
    roster = tmp_path / "roster.csv"
    roster.write_text("nr;id;name\n7;0001;O'Neil, Ana\n8;0002;Ștefan\n", encoding="utf-8-sig")
    made = CliRunner().invoke(app, ["variants", "pump", str(roster), "-o", str(tmp_path / "class")])
    assert made.exit_code == 0, made.output
    marker = marker_of("pump", 7)
    fields = list(marker.standard.key)
    cells = [f"{marker.standard.key[field]:.5g}" for field in fields]
    table = [["id", *fields], ["0001", *cells]]
    text = "\n".join(";".join(line).replace(".", ",") for line in table)
    (tmp_path / "answers.csv").write_text(text, encoding="utf-8")
    (tmp_path / "canvas.csv").write_text(CANVAS, encoding="utf-8")
    return tmp_path


def blotted(text: str) -> str:
    """Answers of which the first of the first student cannot be read."""
    return re.sub(r"\n0001;(\d)(\d),", r"\n0001;\1 \2_", text)


def run(folder: Path, *more: str):
    args = ["grade", str(folder / "class"), str(folder / "answers.csv"), "-o", str(folder / "out")]
    return CliRunner().invoke(app, [*args, *more])


def test_the_command_marks_a_class_and_fills_the_gradebook(folder):
    found = run(folder, "--gradebook", str(folder / "canvas.csv"))
    assert found.exit_code == 0, found.output
    table = read_marks((folder / "out" / "marks.csv").read_bytes())
    assert table["0001"]["percent"] == "100.0"
    assert table["0002"]["percent"] == ""
    for name in ("class.html", "tolerances.csv", "feedback/0001.html", "feedback/0002.pdf"):
        assert (folder / "out" / name).is_file()
    text = (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8")
    assert f"A,{table['0001']['points']},88.5" in text
    assert "“Lab 3 (4711)” is worth 24 points there, full marks are 20.5" in found.output
    assert "stefan,A,," in text


def test_a_refused_report_says_of_no_gradebook_that_marks_are_in_it(folder):
    assert run(folder, *NO_PAGES).exit_code == 0
    found = run(folder, "--gradebook", str(folder / "canvas.csv"), *NO_PAGES)
    assert found.exit_code == 2
    assert "Lab 3 (4711)" not in found.output
    assert not (folder / "out" / "gradebook-canvas.csv").exists()
    again = run(folder, "--gradebook", str(folder / "canvas.csv"), *NO_PAGES, "--force")
    assert "canvas.csv: marks in column “Lab 3 (4711)”: 1" in again.output


def test_rows_of_nobody_in_the_class_are_told_by_name(folder):
    lines = "".join(f'"Nobody, Zed {i}",{90 + i},90{i:02d},zed{i},A,,\n' for i in range(12))
    (folder / "canvas.csv").write_text(CANVAS + lines, encoding="utf-8")
    found = run(folder, "--gradebook", str(folder / "canvas.csv"), *NO_PAGES)
    (told,) = [line for line in found.output.splitlines() if "rows of nobody" in line]
    assert "5 (Nobody, Zed 0), 6 (Nobody, Zed 1)" in told
    assert told.endswith("14 (Nobody, Zed 9) and 2 more")
    text = (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8")
    assert lines in text


def test_a_new_marking_shows_the_first_changes_and_how_many_more(folder):
    run(folder, *NO_PAGES)
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    (folder / "answers.csv").write_text(re.sub(r"\n0001;.*", "\n0001;", text), encoding="utf-8")
    found = run(folder, *NO_PAGES, "--force").output.splitlines()
    rows = read_table(folder / "out" / "differences.csv")
    at = found.index(f"cells changed: {len(rows)}, students: 1 (differences.csv)")
    assert [line.split(",")[0] for line in found[at + 1 : at + 6]] == ["  0001"] * 5
    assert found[at + 6].strip() == f"and {len(rows) - 5} more"


def read_table(path: Path) -> list[list[str]]:
    """The rows of a table of the report below its head."""
    return list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()))[1:]


def test_cells_that_cannot_be_read_are_told_with_status_1(folder):
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    (folder / "answers.csv").write_text(blotted(text), encoding="utf-8")
    found = run(folder)
    assert found.exit_code == 1
    assert "answers.csv, row 2, O'Neil, Ana (0001), v_D_mm: “" in found.output
    assert "mark again with --force" in found.output
    table = read_marks((folder / "out" / "marks.csv").read_bytes())
    assert table["0001"]["v_D_mm"] == ""
    assert table["0001"]["pending"] == "2"
    assert table["0001"]["percent"] == "100.0"
    assert "rândul 2" in (folder / "out" / "class.html").read_text(encoding="utf-8")


def test_a_gradebook_waits_for_points_that_wait(folder):
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    (folder / "answers.csv").write_text(blotted(text), encoding="utf-8")
    found = run(folder, "--gradebook", str(folder / "canvas.csv"), "--lang", "en", *NO_PAGES)
    assert "canvas.csv: 0001 has points that wait" in found.output
    assert (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8") == CANVAS


def test_a_held_mark_goes_into_no_gradebook_until_it_is_released(folder):
    """0001 hands in the data of 0002."""
    lab = folder / "pump"
    shutil.copytree(lab_of("pump").folder, lab)
    with (lab / "lab.toml").open("a", encoding="utf-8") as text:
        text.write("\n[marking]\nhold = true\n")
    roster = str(folder / "roster.csv")
    args = ["variants", str(lab), roster, "-o", str(folder / "class"), "--force"]
    assert CliRunner().invoke(app, args).exit_code == 0
    cells = {f: f"{v:.5g}" for f, v in marker_of("pump", 8).standard.key.items()}
    table = [["id", *cells], ["0001", *cells.values()]]
    (folder / "answers.csv").write_text("\n".join(map(",".join, table)), encoding="utf-8")
    book = ("--gradebook", str(folder / "canvas.csv"), *NO_PAGES)
    found = run(folder, *book)
    assert found.exit_code == 0, found.output
    assert "the mark of 0001 is held" in found.output
    assert "O'Neil, Ana (0001)" in found.output and "--release ID" in found.output
    assert (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8") == CANVAS
    assert run(folder, "--release", "0003", *NO_PAGES).exit_code == 2
    given_back = run(folder, *book, "--force", "--release", "0001")
    assert given_back.exit_code == 0, given_back.output
    filled = (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8")
    assert filled != CANVAS
    # the decision stands when the class is marked again, and is said; until it is taken back
    again = run(folder, *book, "--force")
    assert again.exit_code == 0, again.output
    assert "every later marking of this report: 0001" in again.output
    assert "the mark of 0001 is held" not in again.output
    assert (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8") == filled
    taken = run(folder, *book, "--force", "--hold", "0001")
    assert "the mark of 0001 is held" in taken.output
    assert "every later marking" not in taken.output
    assert (folder / "out" / "gradebook-canvas.csv").read_text(encoding="utf-8") == CANVAS
    assert "the mark of 0001 is held" in run(folder, *book, "--force").output


def test_decisions_survive_a_new_marking_and_reach_the_gradebook(folder):
    assert run(folder, *NO_PAGES).exit_code == 0
    path = folder / "out" / "decisions.csv"
    assert path.read_bytes() == EMPTY
    path.write_text("id;field;points;reason\n0001;v_D_mm;0,5;drawn twice\n", encoding="utf-8")
    own = path.read_bytes()
    for _ in range(2):
        found = run(folder, "--force", "--gradebook", str(folder / "canvas.csv"), "--lang", "en")
        assert found.exit_code == 0, found.output
        assert "decisions.csv: 1 decided, 0 still open" in found.output
        assert path.read_bytes() == own
        assert "A,19,88.5" in (folder / "out" / "gradebook-canvas.csv").read_text("utf-8")
        assert "drawn twice" in (folder / "out/feedback/0001.html").read_text("utf-8")
    refused = run(folder, "--force", "--hold", "0001")
    assert refused.exit_code == 2 and "take the row out of it" in refused.output
    before = (folder / "out" / "marks.csv").read_bytes()
    path.write_text("id;field;points;reason\n0001;v_Q;9;\n9;total;2;why\n", encoding="utf-8")
    refused = run(folder, "--force")
    assert refused.exit_code == 2
    assert "row 2" in refused.output and "row 3" in refused.output
    assert (folder / "out" / "marks.csv").read_bytes() == before


def test_whom_to_release_is_said_clearly(folder):
    assert run(folder, *NO_PAGES).exit_code == 0
    assert not (folder / "out" / "released.json").exists()
    assert run(folder, "--force", "--hold", "0003").exit_code == 2
    assert run(folder, "--force", "--hold", "0001", "--release", "0001").exit_code == 2
    for text in ("{", '{"0001": 1}', "[1]", "[" * 100_000):
        (folder / "out" / "released.json").write_text(text, encoding="utf-8")
        refused = run(folder, "--force", *NO_PAGES)
        assert refused.exit_code == 2 or "is no list of ids" in str(refused.exception)


def test_a_blank_row_is_not_handed_in(folder):
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    width = text.partition("\n")[0].count(";")
    (folder / "answers.csv").write_text(f"{text}\n0002{';' * width}", encoding="utf-8")
    found = run(folder, "--lang", "en")
    assert found.exit_code == 0
    assert "1 of 2 students handed in" in found.output
    page = (folder / "out" / "class.html").read_text(encoding="utf-8")
    assert "Not handed in" in page
    assert "Ștefan (0002)" in page
    told = (folder / "out/feedback/0002.html").read_text("utf-8")
    assert "you handed in no answers" in told
    assert "<table" not in told, "who may still hand in is not told what is right"


def test_a_full_disk_leaves_the_earlier_report_and_nothing_half_written(folder, monkeypatch):
    assert run(folder).exit_code == 0
    out = folder / "out"
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    (folder / "answers.csv").write_text(text.replace("\n0001;19,", "\n0001;49,"), encoding="utf-8")
    whole, written = Path.write_bytes, []

    def full(path: Path, data: bytes) -> int:
        written.append(path)
        if len(written) > 3:
            raise OSError(errno.ENOSPC, "No space left on device")
        return whole(path, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    found = run(folder, "--force")
    assert found.exit_code == 2
    assert "no space left on device" in found.output
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL there")
def test_kill_9_in_the_middle_leaves_whole_files_and_the_next_run_ends_it(folder, monkeypatch):
    monkeypatch.setattr(class_report, "pictures", pictures)  # as another process draws them
    args = ["grade", str(folder / "class"), str(folder / "answers.csv"), "-o", str(folder / "cut")]
    killed_at(4, *args)
    assert run(folder).exit_code == 0
    whole = tree(folder / "out")
    cut = tree(folder / "cut")
    assert 0 < len(cut) < len(whole)
    assert all(whole[name] == data for name, data in cut.items())
    assert CliRunner().invoke(app, [*args, "--force"]).exit_code == 0
    assert tree(folder / "cut") == whole


def tree(folder: Path) -> dict[str, bytes]:
    """The files of a report, those left out that were put aside, and what changed."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name[0] != ".")
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}
    return {name: data for name, data in found.items() if name != "differences.csv"}


def test_the_language_of_the_class_is_that_of_the_feedback(folder):
    roster = str(folder / "roster.csv")
    args = ["variants", "pump", roster, "-o", str(folder / "class"), "--lang", "it", "--force"]
    assert CliRunner().invoke(app, args).exit_code == 0
    for lang, language in ((), "it"), (("--lang", "en"), "en"):
        found = run(folder, *lang, "--force", "--format", "html")
        assert found.exit_code == 0, found.output
        for name in ("class.html", "feedback/0001.html"):
            page = (folder / "out" / name).read_text(encoding="utf-8")
            assert f'lang="{language}"' in page


def test_a_language_of_the_class_list_is_that_of_the_feedback(tmp_path):
    roster = tmp_path / "roster.csv"
    text = "nr;id;name;Limba\n7;1;A;it\n8;2;B;English\n9;3;C;\n10;4;D;klingon\n11;=5;E;ro\n"
    roster.write_text(text, encoding="utf-8")
    made = CliRunner().invoke(app, ["variants", "pump", str(roster), "-o", str(tmp_path / "class")])
    assert made.exit_code == 0, made.output
    (tmp_path / "answers.csv").write_text("id,v_D,nr,lingua\n1,3,7,it\n", encoding="utf-8")
    for lang, third in ((), "ro"), (("--lang", "en"), "en"):
        found = run(tmp_path, "--force", *lang)
        assert found.exit_code == 0, found.output
        assert "D (4): “klingon” is no language" in found.output
        spoken = ("it", "en", third, third, "ro")
        for stem, language in zip(("1", "2", "3", "4"), spoken, strict=False):
            page = (tmp_path / "out/feedback" / f"{stem}.html").read_text(encoding="utf-8")
            assert f'lang="{language}"' in page, stem
        last = max((tmp_path / "out/feedback").glob("*5*.html"), key=lambda path: len(path.name))
        assert 'lang="ro"' in last.read_text(encoding="utf-8")
        title = (tmp_path / "out/feedback/1.html").read_text(encoding="utf-8")
        assert "Meccanismo di pompa" in title
