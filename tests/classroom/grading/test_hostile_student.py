"""One hostile student in a good class: whatever is handed in, the others' marks stay as they are,
to the byte, and the student is named.
"""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from click.testing import CliRunner, Result
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from graphkin.classroom.grading import class_marking
from graphkin.classroom.grading.answers import Answers, read_answers
from graphkin.classroom.grading.class_marking import graded_class, mark_all
from graphkin.classroom.grading.class_report import open_cells
from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.grading.graded import Result as Marks
from graphkin.classroom.grading.grading_files import marks_table
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.roster.spreadsheets import RowProblems, sheet_in
from graphkin.classroom.roster.students import signs
from graphkin.cli.main import app
from graphkin.text.errors import PLAIN_TRACEBACK, RosterError
from tests.classroom.grading.students import book_of, drawn, marker_of, taker
from tests.classroom.grading.students import row as row_of

LAB = "pump"
NUMBERS = range(1, 6)
IDS = {n: f"000{n}" for n in NUMBERS}
NAMES = {
    "0001": "Ana Pop",
    "0002": "Dan Mos",
    "0003": "Eva Rus",
    "0004": "Ion Dan",
    "0005": "Mia Stan",
}
HOSTILE, VICTIM = "0003", "0004"
SIGNS = signs(IDS.values(), names=NAMES)
SENSES = {1.0: "+", -1.0: "-"}


@lru_cache
def cells_of(n: int) -> dict[str, str]:
    """What a careful student writes into the form."""
    standard = marker_of(LAB, n).standard
    answers = row_of(drawn(standard, 0.25, 1, n), 0)
    said = {f: SENSES.get(answers[f].value or 0.0, "") for f in answers if f.endswith("_sense")}
    return {field: said.get(field, answer.text) for field, answer in answers.items()}


FIELDS = tuple(cells_of(1))
GOOD = {who: cells_of(n) for n, who in IDS.items()}


def table(rows: Iterable[tuple[str, Mapping[str, str]]], separator: str = ",") -> bytes:
    """A table of answers as a form on the web exports it."""
    out = io.StringIO()
    writer = csv.writer(out, delimiter=separator)
    writer.writerow(["id", *FIELDS])
    writer.writerows([who, *(cells.get(field, "") for field in FIELDS)] for who, cells in rows)
    return out.getvalue().encode("utf-8", "surrogatepass")


def form(who: str = "", cells: Mapping[str, str] = GOOD[HOSTILE]) -> bytes:
    """What the page for the answers saves."""
    lines = [
        "field,value",
        *([f"id,{who}"] if who else []),
        *(f"{f},{v}" for f, v in cells.items()),
    ]
    return "\n".join(lines).encode()


def folder_of(who: str) -> str:
    return f"{NAMES[who]}_{int(who)}_assignsubmission_file_"


MOODLE = {f"{folder_of(who)}/answers.csv": form(who, cells) for who, cells in GOOD.items()}


def packed(path: Path, files: Mapping[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, data in files.items():
            made.writestr(name, data)
    return path


def marks_of(found: Answers) -> Marks:
    return graded_class(book_of(LAB), [taker(n, who) for n, who in IDS.items()], found.of)


def rows_of(marks: Marks) -> dict[str, bytes]:
    """The line of each student in marks.csv."""
    head, *lines = marks_table(marks).splitlines()
    where = head.split(b",").index(b"id")
    return {line.split(b",")[where].decode(): line for line in lines}


def lines_of(found: Answers, marks: Marks) -> list[str]:
    """Everything that names what is not marked as it was meant."""
    told = [str(each.problem) for each in found.refused] + list(marks.refused)
    cells = open_cells(marks, found.unread)
    return [*told, *found.withheld, *(f"{each.who}, {each.field}" for each in cells)]


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The marks of the class without the hostile student."""
    path = tmp_path_factory.mktemp("good") / "answers.csv"
    path.write_bytes(table((who, cells) for who, cells in GOOD.items() if who != HOSTILE))
    marks = rows_of(marks_of(read_answers(path, book_of(LAB).form, SIGNS)))
    assert marks.pop(HOSTILE)
    return marks


def held_to(others: Mapping[str, bytes], path: Path) -> tuple[Answers, Marks]:
    """What is read and marked, after the others were found to have the very same marks."""
    found = read_answers(path, book_of(LAB).form, SIGNS)
    marks = marks_of(found)
    lines = rows_of(marks)
    assert {who: lines[who] for who in others} == others
    return found, marks


# --- cells ---------------------------------------------------------------------------------------


WRITTEN = """
1e155 -1e155 1e308 1e400 1e-300 1e-12 999999999999 0 -0 nan NaN inf -inf 1e1e1 1,234,567 1.234.567
=1+1 @SUM(A1) +cmd|'/C'!A0 -2+3 \\x00 ../../etc/passwd 0x1F ٣ １２ ½ ∞ 1/0 [[[[[[ {"a":{}} ? ' true
<script>alert(1)</script> 5e999999999 --5 1e 0004 0004,1,2,3 ; " "" null %s {0}
"""
CELLS = WRITTEN.split()
CELLS += [
    "9" * 60,
    "9" * 5000,
    "[" * 3000,
    "a\nb",
    "0004\r\n0004,1,1",
    "\x1b[31m5",
    "5\u202e3",
    "\u200b",
]
CELLS += ["1" * 40 + "." + "1" * 19, "0." + "0" * 50 + "1", "1e12", "1e11", "-999999999999"]
written = st.one_of(
    st.sampled_from(CELLS),
    st.text(max_size=30),
    st.floats().map(repr),
    st.integers(-(10**400), 10**400).map(str),
    st.floats(-1e12, 1e12).map(lambda value: f"{value:.6g} mm"),
)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.dictionaries(st.sampled_from(FIELDS), written, min_size=1), st.booleans())
def test_cells_of_one_student_change_no_mark_of_another(others, tmp_path, cells, semicolons):
    path = tmp_path / "answers.csv"
    rows = [(who, GOOD[who] if who != HOSTILE else GOOD[who] | cells) for who in GOOD]
    path.write_bytes(table(rows, ";" if semicolons else ","))
    found, marks = held_to(others, path)
    told = lines_of(found, marks)
    assert not marks.refused, marks.refused
    assert all(HOSTILE in line or "row" in line for line in told)
    own = next(each for each in marks.graded if each.taker.student.id == HOSTILE)
    waits = {mark.item.field for mark in own.marks if mark.status is Status.UNREADABLE}
    assert bool(waits) <= bool(told)


@pytest.mark.parametrize("cell", CELLS)
def test_a_hostile_cell_in_every_field(others, tmp_path, cell):
    path = tmp_path / "answers.csv"
    rows = [(who, GOOD[who] if who != HOSTILE else dict.fromkeys(FIELDS, cell)) for who in GOOD]
    path.write_bytes(table(rows))
    found, marks = held_to(others, path)
    assert not marks.refused, marks.refused
    if not found.of[HOSTILE][FIELDS[0]].is_read and cell not in ("", "?"):
        assert any(HOSTILE in line for line in lines_of(found, marks))


def test_an_answer_beyond_all_sense_waits(others, tmp_path):
    """A square of it has no number; the cell is named, the other cells of its student count."""
    path = tmp_path / "answers.csv"
    rows = [(who, GOOD[who] | ({"v_D": "1e155"} if who == HOSTILE else {})) for who in GOOD]
    path.write_bytes(table(rows))
    found, marks = held_to(others, path)
    cells = open_cells(marks, found.unread)
    assert [(each.who, each.field, each.problem) for each in cells] == [(HOSTILE, "v_D", "large")]
    own = next(each for each in marks.graded if each.taker.student.id == HOSTILE)
    assert own.earned == own.decided


# --- rows of a table ------------------------------------------------------------------------------


ROWS = {
    "too many cells": (b"0003," + b"1," * 200, HOSTILE),
    "a quote that is never closed": (b'0003,"1', HOSTILE),
    "a quote within quotes": (b'0003,"1"2"', HOSTILE),
    "a cell of several lines": (b'0003,"1\n2\n3"', HOSTILE),
    "a row of another in a cell": (b'0003,"1\n0004,1,1,1\n"', HOSTILE),
    "a control character": (b"0003,\x07", HOSTILE),
    "an unknown id": (b"9999,1", "9999"),
    "an id with a path": (b"../../0004,1", "../../0004"),
    "no id": (b",1,2,3", "is missing"),
}


@pytest.mark.parametrize("name", ROWS)
def test_a_row_that_cannot_be_read_is_withheld_alone(others, tmp_path, name):
    line, named = ROWS[name]
    path = tmp_path / "answers.csv"
    head, *rows = table((w, c) for w, c in GOOD.items() if w != HOSTILE).splitlines(keepends=True)
    path.write_bytes(b"".join([head, *rows[:2], line + b"\r\n", *rows[2:]]))
    found, _ = held_to(others, path)
    assert found.refused
    told = [str(each.problem) for each in found.refused] + found.withheld
    assert any(named in each for each in told), told
    assert found.withheld == ([HOSTILE] if named == HOSTILE else [])


def test_of_two_rows_of_one_id_neither_counts(others, tmp_path):
    """Nobody can tell which of the two the student wrote."""
    path = tmp_path / "answers.csv"
    rows = [*GOOD.items(), (VICTIM, GOOD[HOSTILE])]
    path.write_bytes(table((who, cells) for who, cells in rows if who != HOSTILE))
    found = read_answers(path, book_of(LAB).form, SIGNS)
    assert found.withheld == [VICTIM]
    lines = rows_of(marks_of(found))
    assert all(lines[who] == row for who, row in others.items() if who != VICTIM)


def test_very_many_rows_of_nobody_are_told_in_a_few_lines(others, tmp_path):
    path = tmp_path / "answers.csv"
    good = table((who, cells) for who, cells in GOOD.items() if who != HOSTILE)
    path.write_bytes(good + b"".join(b"x%d,1\r\n" % i for i in range(2000)))
    found, _ = held_to(others, path)
    assert len(found.refused) == 2000


# --- files ---------------------------------------------------------------------------------------


def workbook(**cells: object) -> bytes:
    book, out = openpyxl.Workbook(), io.BytesIO()
    book.active.append(list(cells))
    book.active.append(list(cells.values()))
    book.save(out)
    return out.getvalue()


def nested(size: int) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr("xl/workbook.xml", b"<a>" * size)
    return out.getvalue()


FILES: dict[str, dict[str, bytes]] = {
    "Latin-1": {"answers.csv": "field,value\nid,0003\nv_D,é".encode("latin-1")},
    "empty": {"answers.csv": b""},
    "blanks": {"answers.csv": b" \r\n\r\n"},
    "a head of something else": {"answers.csv": b"colour,shape\nred,round\n"},
    "binary": {"answers.csv": bytes(range(256)) * 40},
    "NUL": {"answers.csv": b"field,value\nv_D,\0\n"},
    "an unknown id": {"answers.csv": form("9999")},
    "an id with a path": {"answers.csv": form("../0004")},
    "the id of another": {"answers.csv": form(VICTIM)},
    "the id of another as a name": {f"{VICTIM}.csv": form(VICTIM)},
    "the id of another in a row": {"answers.csv": table([(VICTIM, GOOD[HOSTILE])])},
    "rows for the whole class": {"answers.csv": table([(w, GOOD[HOSTILE]) for w in GOOD])},
    "a folder that looks like another's": {f"{folder_of(VICTIM)}/answers.csv": form(VICTIM)},
    "two tables": {"answers.csv": form(), "again.csv": form(HOSTILE, {"v_D": "1"})},
    "very many tables": {f"a{i}.csv": form() for i in range(60)},
    "a bomb": {"answers.csv": b"0" * (17 << 20)},
    "many large tables": {f"a{i}.csv": b"v_D\n" + b"1\n" * (4 << 20) for i in range(3)},
    "no workbook": {"answers.xlsx": b"PK\x03\x04 nothing"},
    "a workbook that is a bomb": {"answers.xlsx": nested(2_000_000)},
    "an old workbook": {"answers.xlsx": b"\xd0\xcf\x11\xe0" + b"0" * 100},
    "very many fields": {
        "answers.csv": b"field,value\n" + b"".join(b"f%d,1\n" % i for i in range(5000))
    },
    "a field twice": {"answers.csv": b"field,value\nv_D,1\nv_D,2\n"},
    "a quote": {"answers.csv": b'field,value\nv_D,"1\n'},
    "control characters": {"answers.csv": b"field,value\nv_D,\x1b[2J\n"},
    "an error of the spreadsheet": {"answers.xlsx": workbook(id="#REF!", v_D=1)},
    "deep": {"answers.csv": b"[" * 100_000},
}


@pytest.mark.parametrize("name", FILES)
def test_a_hostile_file_in_an_own_folder(others, tmp_path, name):
    """The platform says whose a folder is: nothing in it counts for another, or is told of one."""
    files = {path: data for path, data in MOODLE.items() if not path.startswith(NAMES[HOSTILE])}
    files |= {f"{folder_of(HOSTILE)}/{own}": data for own, data in FILES[name].items()}
    found, _ = held_to(others, packed(tmp_path / "all.zip", files))
    assert found.withheld == ([] if name == "rows for the whole class" else [HOSTILE])
    assert found.refused
    assert all(each.whose == (HOSTILE,) for each in found.refused)
    assert all(folder_of(who) in by.back for who, by in found.senders.items())


PLAIN = [each for each in FILES if not any(word in each for word in ("another", "class", "large"))]


@pytest.mark.parametrize("name", PLAIN)
def test_a_hostile_file_in_a_plain_folder(others, tmp_path, name):
    """What stands alone is named by its path; it is nobody's unless it says whose it is."""
    folder = good_folder(tmp_path)
    for own, data in FILES[name].items():
        (folder / f"!{own}").write_bytes(data)
    found, _ = held_to(others, folder)
    assert found.refused
    assert all("!" in str(each.problem) for each in found.refused)


def good_folder(tmp_path: Path) -> Path:
    """A folder with a file of each but the hostile student."""
    folder = tmp_path / "all"
    folder.mkdir()
    for who, cells in GOOD.items():
        if who != HOSTILE:
            (folder / f"{who}.csv").write_bytes(form("", cells))
    return folder


def test_a_file_named_by_one_id_and_signed_with_another_is_neither_s(others, tmp_path):
    folder = good_folder(tmp_path)
    (folder / f"{HOSTILE}.csv").write_bytes(form(VICTIM))
    found, _ = held_to(others, folder)
    assert found.withheld == [HOSTILE]
    assert "is the id of Ion Dan, and its file is named 0003" in str(found.refused[0].problem)
    (folder / f"{VICTIM}.csv").unlink()
    assert read_answers(folder, book_of(LAB).form, SIGNS).withheld == [HOSTILE, VICTIM]


def test_a_link_is_no_file_of_its_own(others, tmp_path):
    folder = good_folder(tmp_path)
    (folder / f"{HOSTILE}.csv").symlink_to(folder / f"{VICTIM}.csv")
    found, _ = held_to(others, folder)
    assert found.withheld == [HOSTILE]
    assert "is a link to another place" in str(found.refused[0].problem)


def test_who_is_not_in_the_class_list_signs_for_nobody_else(tmp_path):
    """A name that has nothing in common with that of the id is somebody else's."""
    files = {"Leo Nemo_9_assignsubmission_file_/a.csv": form(VICTIM)}
    with pytest.raises(RosterError, match="is the id of Ion Dan, and Leo Nemo handed it in"):
        read_answers(packed(tmp_path / "a.zip", files), book_of(LAB).form, SIGNS)
    files = {"Ion Marian Dan_9_assignsubmission_file_/a.csv": form(VICTIM)}
    found = read_answers(packed(tmp_path / "a.zip", files), book_of(LAB).form, SIGNS)
    assert list(found.of) == list(found.unlisted) == [VICTIM]


def test_a_file_that_two_of_a_name_may_have_handed_in_lets_wait_who_has_no_other(tmp_path):
    """Which name comes first nobody knows: Dan Ion may be Ion Dan."""
    twins = signs(IDS.values(), names=NAMES | {"0002": "Dan Ion"})
    files = {
        "Dan Ion_2_assignsubmission_file_/a.csv": b"",
        "Ion Dan_4_assignsubmission_file_/a.csv": form(VICTIM),
    }
    found = read_answers(packed(tmp_path / "a.zip", files), book_of(LAB).form, twins)
    assert found.withheld == ["0002"]
    assert list(found.senders) == [VICTIM]


def test_a_cell_of_several_lines_hides_nobody(tmp_path):
    """A stray quote swallows two rows: their students are named, not taken for absent."""
    path = tmp_path / "answers.csv"
    head, *rows = table(GOOD.items()).splitlines(keepends=True)
    rows[1], rows[3] = b'0002,"' + rows[1][5:], rows[3].replace(b"\r\n", b'"\r\n')
    path.write_bytes(b"".join([head, *rows]))
    found = read_answers(path, book_of(LAB).form, SIGNS)
    assert set(found.withheld) == {"0002", "0003", "0004"}
    assert set(found.of) == set(GOOD)


def test_rows_below_an_open_quote_are_read(tmp_path):
    found = sheet_in(b'id,v\n1,"2\n3,4\n5,6\n', "a.csv", faults=RowProblems("a.csv"))
    assert [row.cells for row in found.rows] == [("3", "4"), ("5", "6")]
    assert [row.cells for row in found.left_out] == [("1", "2")]


# --- faults --------------------------------------------------------------------------------------


@pytest.fixture
def no_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(PLAIN_TRACEBACK, raising=False)


def failing(of: Callable[..., object], is_theirs: Callable[..., bool]) -> Callable[..., object]:
    """A part of the marking that fails for one student."""

    def part(*given: Any) -> object:
        if is_theirs(*given):
            raise ZeroDivisionError("of a kind that nobody foresaw")
        return of(*given)

    return part


def is_hostile(answers: Mapping[str, Answer]) -> bool:
    """Whether the answers are the hostile student's, and have not been set to wait."""
    return all(answers[field].text == text for field, text in GOOD[HOSTILE].items() if text)


PARTS = {
    "first look": (Marker, "first_look", lambda marker, answers: is_hostile(answers)),
    "explanation": (
        class_marking,
        "explained",
        lambda sheets: any(is_hostile(first.given) for _, first in sheets),
    ),
    "marks": (Marker, "graded", lambda marker, taker, first, *more: is_hostile(first.given)),
}


@pytest.mark.parametrize("part", PARTS)
def test_a_fault_in_marking_one_student_is_told_of_that_one(
    others, tmp_path, monkeypatch, no_traceback, part
):
    where, name, is_theirs = PARTS[part]
    monkeypatch.setattr(where, name, failing(getattr(where, name), is_theirs))
    path = tmp_path / "answers.csv"
    path.write_bytes(table(GOOD.items()))
    _, marks = held_to(others, path)
    assert list(marks.refused) == [HOSTILE]
    assert "a fault in graphkin itself (ZeroDivisionError" in str(marks.refused[HOSTILE][0])
    own = next(each for each in marks.graded if each.taker.student.id == HOSTILE)
    assert own.pending == own.points


def test_a_variant_that_cannot_be_constructed_is_told_of_its_student():
    book, wrong = book_of(LAB), taker(1, "x")
    (found,) = mark_all(book, [(replace(wrong, settings={"n": "-1"}), None)])
    assert found.graded is None and found.problems


# --- the command ---------------------------------------------------------------------------------


def call(*words: object) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)


@pytest.fixture(scope="module")
def a_class(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("class")
    rows = "".join(f"{n};{who};{NAMES[who]}\n" for n, who in IDS.items())
    (folder / "roster.csv").write_text(f"nr;id;name\n{rows}", encoding="utf-8")
    made = call("variants", LAB, folder / "roster.csv", "-o", folder / "class")
    assert made.exit_code == 0, made.output
    return folder / "class"


def test_the_command_marks_the_others_and_names_who_waits(a_class, tmp_path):
    """Feedback goes back to whom a folder belongs; the status says that something was refused."""
    files = MOODLE | {f"{folder_of(HOSTILE)}/answers.csv": form(VICTIM)}
    book = tmp_path / "book.csv"
    book.write_text("id,points\n" + "".join(f"{who},\n" for who in GOOD), encoding="utf-8")
    answers, out = packed(tmp_path / "all.zip", files), tmp_path / "out"
    found = call(
        "grade", a_class, answers, "-o", out, "--format", "html", "--gradebook", book,
        "--lang", "en",
    )  # fmt: skip
    assert found.exit_code == 1, found.output
    assert '"0004" is the id of Ion Dan, and the file is in the folder of Eva Rus' in found.output
    assert "not marked, the points wait: Eva Rus (0003)" in found.output
    with zipfile.ZipFile(out / "feedback-moodle.zip") as back:
        for who in GOOD:
            page = (out / "feedback" / f"{who}.html").read_bytes()
            assert back.read(f"{folder_of(who)}/feedback.html") == page
            assert (b"was handed in and could not be read" in page) == (who == HOSTILE)
    points = dict(csv.reader((out / "gradebook-book.csv").read_text().splitlines()[1:]))
    assert points.pop(HOSTILE) == ""
    assert set(points.values()) == {"20.5"}
    report = (out / "class.html").read_text(encoding="utf-8")
    assert "Handed in and not marked" in report and "is the id of Ion Dan" in report


def test_nothing_is_written_where_nobody_can_be_marked(a_class, tmp_path):
    answers = packed(tmp_path / "all.zip", {"a.csv": b"", "b.csv": b"\xff", "c.csv": form("7777")})
    found = call("grade", a_class, answers, "-o", tmp_path / "out")
    assert found.exit_code == 2
    assert all(name in found.output for name in ("a.csv", "b.csv", "c.csv"))
    assert not (tmp_path / "out").exists()
