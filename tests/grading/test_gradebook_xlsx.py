"""A gradebook as a workbook: marks go in as numbers, all else stays, the same bytes again."""

from __future__ import annotations

import io
import zipfile
from fractions import Fraction
from pathlib import Path

import openpyxl
import openpyxl.styles
import pytest

from graphkin.grading.gradebook import GradebookError
from graphkin.grading.gradebook_xlsx import MODIFIED, filled_gradebook

MARKS = {"0001": Fraction(17, 2), "0002": Fraction(12), "X9": Fraction(1)}
MOODLE = (
    ("Prenume", "Nume", "Număr de identificare", "Temă: Lab 3 (Valoare reală)", "Feedback: Lab 3"),
    ("Ana", "O'Neil, Jr.", "0001", "-", None),
    ("Ștefan", "=1+1", "0002", "-", None),
    ("Guest", "X", "9999", "-", None),
)
CANVAS = (
    ("Student", "ID", "SIS User ID", "Section", "Lab 3 (4711)", "Final Score", None),
    ("    Points Possible", None, None, None, 24, "(read only)", None),
    ("O'Neil, Ana", 77, "0001", "A", None, 88.5, None),
    ("Ionescu, Ștefan", 78, "0002", "A", None, None, None),
)


def saved(folder: Path, rows, name: str = "book.xlsx") -> Path:
    """A workbook with a bold head, a formula beside it, and a second sheet."""
    book = openpyxl.Workbook()
    sheet = book.active
    for row in rows:
        sheet.append(row)
    sheet["A1"].font = openpyxl.styles.Font(bold=True)
    sheet["J2"] = "=SUM(D2:D4)"
    book.create_sheet("other")["B2"] = "kept"
    book.save(folder / name)
    return folder / name


def aged(path: Path) -> None:
    """Make a workbook one that was changed last in 2001."""
    with zipfile.ZipFile(path) as packed:
        parts = {name: packed.read(name) for name in packed.namelist()}
    with zipfile.ZipFile(path, "w") as packed:
        for name, data in parts.items():
            packed.writestr(name, MODIFIED.sub(rb"\g<1>2001-02-03T04:05:06Z", data))


def cells(data: bytes) -> dict[str, object]:
    """The cells of the first sheet that hold something."""
    sheet = openpyxl.load_workbook(io.BytesIO(data)).worksheets[0]
    return {cell.coordinate: cell.value for row in sheet for cell in row if cell.value is not None}


@pytest.mark.parametrize(
    ("rows", "column", "changed"),
    [
        (MOODLE, "Lab 3", {"D2": 8.5, "D3": 12}),
        (MOODLE, None, {"D2": 8.5, "D3": 12}),
        (CANVAS, None, {"E3": 8.5, "E4": 12}),
        (CANVAS, "Lab 3 (4711)", {"E3": 8.5, "E4": 12}),
    ],
)
def test_only_the_marks_change(tmp_path, rows, column, changed):
    path = saved(tmp_path, rows)
    found = filled_gradebook(path, MARKS, column)
    before, after = cells(path.read_bytes()), cells(found.data)
    assert {**before, **changed} == after
    assert found.count == 2
    assert found.absent == ("X9",)
    assert found.worth == (24 if rows is CANVAS else None)
    book = openpyxl.load_workbook(io.BytesIO(found.data))
    assert book.worksheets[0]["A1"].font.bold
    assert book["other"]["B2"].value == "kept"


def test_the_same_marks_give_the_same_bytes_and_the_time_of_the_export(tmp_path):
    path = saved(tmp_path, MOODLE)
    aged(path)
    first, second = (filled_gradebook(path, MARKS).data for _ in range(2))
    assert first == second
    with zipfile.ZipFile(path) as was, zipfile.ZipFile(io.BytesIO(first)) as now:
        core = "docProps/core.xml"
        times = [MODIFIED.search(each.read(core))[0] for each in (was, now)]
        assert times[0] == times[1]
        assert b"2001" in times[1]
        assert {each.date_time for each in now.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_ids_that_a_format_shows_with_zeros_are_found(tmp_path):
    rows = [MOODLE[0], *((a, b, int(c), *rest) for a, b, c, *rest in MOODLE[1:])]
    path = saved(tmp_path, rows)
    book = openpyxl.load_workbook(path)
    for row in range(2, 5):
        book.active.cell(row, 3).number_format = "0000"
    book.save(path)
    assert filled_gradebook(path, MARKS).count == 2


def test_a_class_of_whom_nobody_has_marks_yet_is_found_by_its_ids(tmp_path):
    path = saved(tmp_path, MOODLE)
    found = filled_gradebook(path, {}, None, ["0001", "0002"])
    assert found.count == 0
    assert cells(found.data) == cells(path.read_bytes())


@pytest.mark.parametrize(
    ("rows", "column", "words"),
    [
        (MOODLE, "Lab 9", "is no column"),
        (MOODLE[:1], None, "no row below"),
        ([MOODLE[0], *[MOODLE[1]] * 2], None, "stands there twice"),
        ([MOODLE[0], ("A", "B", "7", "-", None)], None, "no column holds ids"),
    ],
)
def test_a_workbook_that_cannot_be_filled_is_refused(tmp_path, rows, column, words):
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append(row)
    book.save(tmp_path / "book.xlsx")
    with pytest.raises(GradebookError, match=words):
        filled_gradebook(tmp_path / "book.xlsx", MARKS, column)


@pytest.mark.parametrize("data", [b"PK\x03\x04 no zip", b"PK\x03\x04"])
def test_a_broken_workbook_is_refused(tmp_path, data):
    (tmp_path / "book.xlsx").write_bytes(data)
    with pytest.raises(GradebookError, match="cannot be read as XLSX"):
        filled_gradebook(tmp_path / "book.xlsx", MARKS)


def test_a_workbook_far_larger_unpacked_is_refused(tmp_path):
    path = tmp_path / "bomb.xlsx"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed, packed.open("a", "w") as part:
        for _ in range(257):
            part.write(bytes(1 << 20))
    with pytest.raises(GradebookError, match="far larger unpacked"):
        filled_gradebook(path, MARKS)
