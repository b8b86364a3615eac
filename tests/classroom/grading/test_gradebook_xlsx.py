"""A gradebook as a workbook: marks go in as numbers, all else stays, the same bytes again."""

from __future__ import annotations

import io
import re
import zipfile
from fractions import Fraction
from pathlib import Path

import openpyxl
import openpyxl.styles
import pytest

from graphkin.classroom.grading.gradebook import GradebookError
from graphkin.classroom.grading.gradebook_xlsx import filled_gradebook
from graphkin.classroom.grading.sheet_xml import computed_anew, with_numbers

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


def parts(data: bytes) -> dict[str, bytes]:
    """The parts of a workbook by name."""
    with zipfile.ZipFile(io.BytesIO(data)) as packed:
        return {name: packed.read(name) for name in packed.namelist()}


def changed(path: Path, *pieces: tuple[str, str, str], **more: bytes) -> None:
    """Put other text for some of the parts of a workbook, and more parts into it."""
    found = parts(path.read_bytes())
    for name, old, new in pieces:
        assert old in found[name].decode()
        found[name] = found[name].decode().replace(old, new).encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, data in (found | more).items():
            packed.writestr(zipfile.ZipInfo(name, (2001, 2, 3, 4, 5, 6)), data)


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


SHEET, MAIN = "xl/worksheets/sheet1.xml", "xl/workbook.xml"
RICH = "<is><r><rPr><b/></rPr><t>An</t></r><r><t>a</t></r></is>"
SPARKS = (
    '<extLst><ext xmlns:x14="http://schemas.microsoft.com/office/spreadsheetml/2009/9/main"'
    ' uri="{05C60535-1F16-4fd2-B633-F4F36F0B64E0}"><x14:sparklineGroups/></ext></extLst>'
)
BESIDE = {
    "customXml/item1.xml": b"<course xmlns='urn:x'>mechanics</course>",
    "xl/vbaProject.bin": bytes(range(256)) * 4,
    "xl/media/image1.png": b"\x89PNG\r\n",
}


def test_rich_text_sparklines_custom_parts_and_macros_stay_byte_for_byte(tmp_path):
    path = saved(tmp_path, MOODLE)
    changed(
        path,
        (SHEET, "<is><t>Ana</t></is>", RICH),
        (SHEET, "</worksheet>", f"<!-- <c> -->{SPARKS}</worksheet>"),
        **BESIDE,
    )
    before = parts(path.read_bytes())
    after = parts(filled_gradebook(path, MARKS).data)
    assert {name for name in before if before[name] != after[name]} == {SHEET, MAIN}
    assert after.keys() == before.keys()
    marked = before[SHEET].decode()
    for place, number in (("D2", "8.5"), ("D3", "12")):
        cell = re.compile(rf'<c r="{place}"[^>]*>.*?</c>')
        assert cell.search(marked)
        marked = cell.sub(f'<c r="{place}"><v>{number}</v></c>', marked)
    assert after[SHEET].decode() == re.sub(r"(</f>)<v */>|(</f>)<v></v>", r"\1\2", marked)
    assert b'fullCalcOnLoad="1"' in after[MAIN]


def test_results_of_formulas_are_computed_anew_on_every_sheet(tmp_path):
    book = openpyxl.Workbook()
    for row in (MOODLE[0], MOODLE[1], MOODLE[3]):
        book.active.append(row)
    book.create_sheet("sums")["A1"] = "=Sheet!D2"
    book.save(tmp_path / "book.xlsx")
    path, other = tmp_path / "book.xlsx", "xl/worksheets/sheet2.xml"
    changed(path, (other, "</f>", "</f><!-- kept --><v>3</v><!--"), (other, "</c>", "--></c>"))
    after = parts(filled_gradebook(path, MARKS).data)
    assert b"<f>Sheet!D2</f><!-- kept --><!--" in after[other]
    assert b'fullCalcOnLoad="1"' in after[MAIN]


def test_no_mark_takes_the_place_of_a_formula(tmp_path):
    rows = [MOODLE[0], *((*row[:3], "=1+2", None) for row in MOODLE[1:])]
    with pytest.raises(GradebookError, match=r"holds a formula|no points"):
        filled_gradebook(saved(tmp_path, rows), MARKS, "Lab 3")
    rows = [MOODLE[0], (*MOODLE[1][:3], "=1+2", None), (*MOODLE[2][:3], 3, None)]
    with pytest.raises(GradebookError, match=r"row 2: .*holds a formula"):
        filled_gradebook(saved(tmp_path, rows), MARKS, "Lab 3")


HEAD = '<worksheet xmlns="u"><sheetData>'
TAIL = "</sheetData></worksheet>"


@pytest.mark.parametrize(
    ("row", "found"),
    [
        ('<row r="2"><c r="A2"/></row>', '<row r="2"><c r="A2"/><c r="C2"><v>7</v></c></row>'),
        ('<row r="2"><c r="C2" s="4"/></row>', '<row r="2"><c r="C2" s="4"><v>7</v></c></row>'),
        (
            '<row r="2"><c r="C2" t="inlineStr"><is><t>-</t></is></c></row>',
            '<row r="2"><c r="C2"><v>7</v></c></row>',
        ),
        (
            '<row r="2"><c r="A2"/><c r="AA2"/></row>',
            '<row r="2"><c r="A2"/><c r="C2"><v>7</v></c><c r="AA2"/></row>',
        ),
        (
            "<row/><row><c/><c/><c><v>1</v></c></row>",
            '<row/><row><c/><c/><c r="C2"><v>7</v></c></row>',
        ),
        (
            '<row r="2"><c r="A2" t="str"><f>B2</f><v>a</v></c><c r="C2"/></row>',
            '<row r="2"><c r="A2"><f>B2</f></c><c r="C2"><v>7</v></c></row>',
        ),
        (
            '<row r="2"><c r="A2"><f>B2</f><v/></c ><c r="C2"/></row>',
            '<row r="2"><c r="A2"><f>B2</f></c ><c r="C2"><v>7</v></c></row>',
        ),
    ],
)
def test_a_number_comes_into_its_cell_and_nowhere_else(row, found):
    """Worked out by hand; cells and rows may leave out their places, tags may have a prefix."""
    numbers = {(2, 3): "7"}
    assert with_numbers((HEAD + row + TAIL).encode(), numbers).decode() == HEAD + found + TAIL

    def prefixed(text: str) -> str:
        return re.sub(r"<(/?)", r"<\1x:", text)

    whole = with_numbers(prefixed(HEAD + row + TAIL).encode(), numbers).decode()
    assert whole == prefixed(HEAD + found + TAIL)


@pytest.mark.parametrize(
    ("xml", "found"),
    [
        ("<w><sheets></sheets></w>", '<w><sheets></sheets><calcPr fullCalcOnLoad="1"/></w>'),
        (
            "<w><sheets></sheets><definedNames>a</definedNames><pivotCaches/></w>",
            "<w><sheets></sheets><definedNames>a</definedNames>"
            '<calcPr fullCalcOnLoad="1"/><pivotCaches/></w>',
        ),
        (
            '<x:w><x:calcPr calcId="1" fullCalcOnLoad="0"/></x:w>',
            '<x:w><x:calcPr fullCalcOnLoad="1" calcId="1"/></x:w>',
        ),
    ],
)
def test_a_workbook_is_told_to_compute_anew(xml, found):
    assert computed_anew(xml.encode()).decode() == found


def test_a_declared_type_or_another_coding_is_refused():
    for xml in (b'<!DOCTYPE w [<!ENTITY a "b">]><w>&a;</w>', "<w/>".encode("utf-16")):
        with pytest.raises(ValueError):
            with_numbers(xml, {})


def test_ids_that_a_format_shows_with_zeros_are_found(tmp_path):
    rows = [MOODLE[0], *((a, b, int(c), *rest) for a, b, c, *rest in MOODLE[1:])]
    path = saved(tmp_path, rows)
    book = openpyxl.load_workbook(path)
    for row in range(2, 5):
        book.active.cell(row, 3).number_format = "0000"
    book.save(path)
    assert filled_gradebook(path, MARKS).count == 2


@pytest.mark.parametrize("column", ["Lab 3", None])
def test_an_average_below_the_students_is_no_mark_of_anybody(tmp_path, column):
    rows = [
        ("Nume", "Matricol", "Lab 3"),
        ("Ana", "0001", None),
        ("Ștefan", "0002", None),
        ("Media", None, "=AVERAGE(C2:C3)"),
    ]
    found = cells(filled_gradebook(saved(tmp_path, rows), MARKS, column).data)
    assert [found[place] for place in ("C2", "C3", "C4")] == [8.5, 12, "=AVERAGE(C2:C3)"]


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
        for _ in range(65):
            part.write(bytes(1 << 20))
    with pytest.raises(GradebookError, match="far larger unpacked"):
        filled_gradebook(path, MARKS)
