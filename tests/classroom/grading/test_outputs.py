"""What grading writes: marks, feedback, report, gradebooks as they were but for the marks."""

from __future__ import annotations

import csv
import errno
import io
import re
import shutil
from fractions import Fraction
from functools import cache
from math import inf, nan
from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from graphkin.classroom.grading import class_report
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.class_report import pictures
from graphkin.classroom.grading.decisions import EMPTY
from graphkin.classroom.grading.feedback import feedback_pages
from graphkin.classroom.grading.graded import Answer, Decision, EarnedCause, Result, Suspicion
from graphkin.classroom.grading.grading_files import (
    KEPT_MARKS,
    ReportSettings,
    differences,
    kept_marks,
    marks_table,
    points_by_id,
    read_kept_marks,
    read_marks,
    report_files,
)
from graphkin.classroom.roster.students import Student, Taker
from graphkin.cli.main import app
from graphkin.text import words
from tests.chosen import SPOKEN
from tests.classroom.grading.students import book_of, given, key_answers, lab_of, marker_of
from tests.classroom.grading.test_gradebooks import CANVAS

HOSTILE = '<script>alert("1")</script> O\'Neil, Jr. Ștefan _*^{} \u202eabc'


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
def small_class(**changes: float) -> Result:
    """Two students of the pump, one with a hostile name and some answers changed, one absent."""
    marker = marker_of("pump", 7)
    answers = {"=1+1": {**key_answers(marker.standard), **given(changes)}}
    answers["=1+1"]["v_D"] = Answer("<b>3,8,2</b>", problem="number")
    takers = [
        Taker(Student(2, "=1+1", 7, HOSTILE, "=cmd"), {"n": "7"}, "ABCDEFGHIJ"),
        Taker(Student(3, "0002", 8, "Ana", "321"), {"n": "8"}, "KLMNOPQRST"),
    ]
    return graded_class(book_of("pump"), takers, answers)


def files(found: Result, language: str = "en", before: bytes = b"") -> dict[str, bytes]:
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
    data = marks_table(small_class())
    table = list(csv.DictReader(io.StringIO(data.decode("utf-8-sig"))))
    assert [row["id"] for row in table] == ["'=1+1", "0002"]
    assert table[0]["group"] == "'=cmd"
    assert table[0]["v_D why"] == "unreadable"
    assert table[1]["points"] == ""
    assert table[0]["points"] == table[0]["of"]
    worth = lab_of("pump").rubric.points
    assert float(table[0]["of"]) == float(sum(worth.values()) - worth["v_D"])
    assert float(table[0]["pending"]) == float(worth["v_D"])


def test_the_same_digits_are_evidence_with_whose_they_are():
    found = small_class()
    both = Suspicion(("=1+1", "0002"), ("v_D", "omega_3"), 5432.0)
    made = files(replace(found, copies=(both,)))
    marks = read_marks(made["marks.csv"])
    assert [marks[who]["evidence"] for who in ("'=1+1", "0002")] == ["same as 0002", "same as =1+1"]
    (line,) = (each for each in made["class.html"].decode("utf-8").splitlines() if "5000" in each)
    assert "Ana (0002)" in line and "v_D, omega_3" in line


def test_a_new_marking_lists_what_changed_and_nothing_else():
    before = files(small_class(omega_3=1.0))["marks.csv"]
    after = files(small_class(), before=before)
    found = differences(before, after["marks.csv"])
    fields = {"omega_3", "omega_3_sense"}  # a sense counts only together with its value
    whys = {f"{field} why" for field in fields}
    assert {column for _, column, *_ in found} == {"points", "percent", *fields, *whys}
    assert "differences.csv" in after
    assert not differences(before, before)
    assert read_marks(b"nothing") == {}


# --- marks that are held ------------------------------------------------------------------------


@cache
def held_class(*released: str) -> Result:
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


def test_a_held_mark_is_nowhere_until_it_is_released():
    language = "it"
    found, given_back = held_class(), held_class("0013")
    assert [each.held for each in found.graded] == [False, True, False]
    assert not any(each.held for each in given_back.graded)
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
    drawn = [feedback_pages(each.graded[1], "", rubric, spoken) for each in (found, given_back)]
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
    (tmp_path / "answers.csv").write_text(answers_of(7), encoding="utf-8")
    (tmp_path / "canvas.csv").write_text(CANVAS, encoding="utf-8")
    return tmp_path


def answers_of(n: int) -> str:
    """The key of a number, handed in by the first student."""
    key = marker_of("pump", n).standard.key
    table = [["id", *key], ["0001", *(f"{value:.5g}" for value in key.values())]]
    return "\n".join(";".join(line).replace(".", ",") for line in table)


def run(folder: Path, *more: str):
    args = ["grade", str(folder / "class"), str(folder / "answers.csv"), "-o", str(folder / "out")]
    return CliRunner().invoke(app, [*args, *more])


def text_in(folder: Path, name: str = "gradebook-canvas.csv") -> str:
    return (folder / "out" / name).read_text(encoding="utf-8")


def test_the_command_marks_a_class_and_fills_the_gradebook(folder):
    """A blank row is not handed in; who may still hand in is not told what is right."""
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    width = text.partition("\n")[0].count(";")
    (folder / "answers.csv").write_text(f"{text}\n0002{';' * width}", encoding="utf-8")
    found = run(folder, "--gradebook", str(folder / "canvas.csv"), "--lang", "en")
    assert found.exit_code == 0, found.output
    table = read_marks((folder / "out" / "marks.csv").read_bytes())
    assert [table[who]["percent"] for who in ("0001", "0002")] == ["100.0", ""]
    for name in ("class.html", "tolerances.csv", "feedback/0001.html", "feedback/0002.pdf"):
        assert (folder / "out" / name).is_file()
    assert f"A,{table['0001']['points']},88.5" in text_in(folder)
    assert "stefan,A,," in text_in(folder)
    assert "“Lab 3 (4711)” is worth 24 points there, full marks are 20.5" in found.output
    assert "1 of 2 students handed in" in found.output
    assert "Not handed in" in text_in(folder, "class.html")
    assert "Ștefan (0002)" in text_in(folder, "class.html")
    told = text_in(folder, "feedback/0002.html")
    assert "you handed in no answers" in told
    assert "<table" not in told


def test_cells_that_cannot_be_read_are_told_with_status_1_and_no_gradebook_is_filled(folder):
    text = (folder / "answers.csv").read_text(encoding="utf-8")
    blotted = re.sub(r"\n0001;(\d)(\d),", r"\n0001;\1 \2_", text)
    (folder / "answers.csv").write_text(blotted, encoding="utf-8")
    found = run(folder, "--gradebook", str(folder / "canvas.csv"))
    assert found.exit_code == 1
    assert "answers.csv, row 2, O'Neil, Ana (0001), v_D_mm: “" in found.output
    own = read_marks((folder / "out" / "marks.csv").read_bytes())["0001"]
    assert (own["v_D_mm"], own["pending"], own["percent"]) == ("", "2", "100.0")
    assert "rândul 2" in text_in(folder, "class.html")
    found = run(folder, "--gradebook", str(folder / "canvas.csv"), *NO_PAGES, "--force")
    assert "canvas.csv: 0001 are puncte" in found.output or "canvas.csv: 0001" in found.output
    assert text_in(folder) == CANVAS


def test_a_held_mark_goes_into_no_gradebook_until_it_is_released(folder):
    """0001 hands in the data of 0002."""
    lab = folder / "pump"
    shutil.copytree(lab_of("pump").folder, lab)
    with (lab / "lab.toml").open("a", encoding="utf-8") as text:
        text.write("\n[marking]\nhold = true\n")
    roster = str(folder / "roster.csv")
    args = ["variants", str(lab), roster, "-o", str(folder / "class"), "--force"]
    assert CliRunner().invoke(app, args).exit_code == 0
    (folder / "answers.csv").write_text(answers_of(8), encoding="utf-8")
    book = ("--gradebook", str(folder / "canvas.csv"), *NO_PAGES)
    held, stands = "the mark of 0001 is held", "every later marking of this report: 0001"
    found = run(folder, *book)
    assert found.exit_code == 0, found.output
    assert held in found.output
    assert "O'Neil, Ana (0001)" in found.output and "--release ID" in found.output
    assert text_in(folder) == CANVAS
    assert run(folder, "--release", "0003", *NO_PAGES).exit_code == 2
    given_back = run(folder, *book, "--force", "--release", "0001")
    assert given_back.exit_code == 0, given_back.output
    filled = text_in(folder)
    assert filled != CANVAS
    # the decision stands when the class is marked again, and is said; until it is taken back
    again = run(folder, *book, "--force")
    assert again.exit_code == 0, again.output
    assert stands in again.output and held not in again.output
    assert text_in(folder) == filled
    for more in (("--hold", "0001"), ()):
        taken = run(folder, *book, "--force", *more).output
        assert held in taken and stands not in taken
        assert text_in(folder) == CANVAS


def test_decisions_survive_a_new_marking_and_reach_the_gradebook(folder):
    assert run(folder, *NO_PAGES).exit_code == 0
    path = folder / "out" / "decisions.csv"
    assert path.read_bytes() == EMPTY
    path.write_text("id;field;points;reason\n0001;v_D_mm;0,5;drawn twice\n", encoding="utf-8")
    own = path.read_bytes()
    for _ in range(2):
        found = run(folder, "--force", "--gradebook", str(folder / "canvas.csv"), "--lang", "en")
        assert found.exit_code == 0, found.output
        assert "decisions: 1 decided, 0 still open" in found.output
        assert path.read_bytes() == own
        assert "A,19,88.5" in text_in(folder)
        assert "drawn twice" in text_in(folder, "feedback/0001.html")
    refused = run(folder, "--force", "--hold", "0001")
    assert refused.exit_code == 2 and "take the row out of decisions.csv" in refused.output
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


def test_a_full_disk_leaves_the_earlier_report_and_nothing_half_written(folder, monkeypatch):
    assert run(folder).exit_code == 0
    before = tree(folder / "out")
    (folder / "answers.csv").write_text(answers_of(9), encoding="utf-8")
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
    assert tree(folder / "out") == before


def tree(folder: Path) -> dict[str, bytes]:
    """The files of a report, but for those that were put aside, and for what changed."""
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


def test_the_desk_reads_all_that_was_marked(tmp_path):
    """Values that are no number, exact points, causes and decisions, and hostile names."""
    found = small_class(v_C=1.0)
    decided = Decision("=1+1", "v_D", Fraction(1, 3), HOSTILE, before=Fraction(2))
    first, *others = found.graded[0].marks
    first = replace(first, expected=nan, tolerance=inf, decision=decided, by_cause=-2.5, torn=True)
    bare = tuple(replace(m, item=replace(m.item, vector=None)) for m in (first, *others))
    cause = EarnedCause("other_side", Fraction(7, 3), 12.5, ("0002",), {"en": HOSTILE})
    one = replace(found.graded[0], marks=bare, causes=(cause,), remarks={"v_D": HOSTILE})
    result = replace(found, graded=(one,), copies=(Suspicion(("a", "b"), ("v_D",), 1e3, 7),))
    (tmp_path / KEPT_MARKS).write_bytes(
        kept_marks(result, marker_of("pump", 7).standard.items, [], "")
    )
    again = read_kept_marks(tmp_path)
    assert again is not None
    assert repr(again.graded) == repr(result.graded)
    assert again.copies == result.copies
