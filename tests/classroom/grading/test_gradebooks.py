"""A gradebook, as a table or a workbook: marks go in, all else stays, the same bytes again."""

from __future__ import annotations

import csv
import io
import time
import zipfile
from fractions import Fraction
from pathlib import Path

import openpyxl
import openpyxl.styles
import pytest

from graphkin.classroom.grading import gradebook
from graphkin.classroom.grading.gradebook import (
    GradebookError,
    read_gradebook,
    with_marks,
)
from graphkin.classroom.roster.spreadsheets import SEPARATORS
from graphkin.classroom.roster.students import signs

MARKS = {"0001": Fraction(17, 2), "0002": Fraction(12), "X9": Fraction(1)}
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


HALF = "ID number,Name,Grade\r\n0001,Ana,7\r\n0002,Pat"


@pytest.fixture
def book(tmp_path):
    """Read a table: book("id,mark\n")."""

    def read(text: str):
        (tmp_path / "book.csv").write_bytes(text.encode("utf-8"))
        return read_gradebook(tmp_path / "book.csv")

    return read


def test_moodle_and_canvas_keep_all_but_the_marks_their_quotes_and_row_of_points(book):
    found = with_marks(book(MOODLE), MARKS, "Lab 3 (Real)")
    expected = MOODLE.replace('UPB,-,,1700000000\r\n"Ș', 'UPB,8.5,,1700000000\r\n"Ș')
    assert found.data.decode("utf-8") == expected.replace('UPB,"-"', 'UPB,"12"')
    assert (found.count, found.absent) == (2, ("X9",))
    assert found.strangers == {4: "Guest X"}
    found = with_marks(book(CANVAS), MARKS)
    expected = CANVAS.replace("A,,88.5", "A,8.5,88.5").replace("stefan,A,,", "stefan,A,12,")
    assert found.data.decode("utf-8") == expected
    assert found.column == "Lab 3 (4711)"
    assert not found.strangers  # the row of points is no student's
    bare = CANVAS.replace("88.5", "")  # nothing is marked yet: what Canvas computes is empty, too
    assert with_marks(book(bare), MARKS).column == found.column


def test_the_row_of_points_is_nobodys_whatever_stands_in_it(book):
    """Neither by an address in it nor by an id, and nobody the class list lacks."""
    text = "Student,SIS User ID,Mail,Lab 3\n    Points Possible,{},{},24\nAna,01003,,\n,,,\n"
    for who in ("", "01004", "99"):
        for mail in ("", "pat@example.org"):
            found = with_marks(book(text.format(who, mail)), OWN, "Lab 3", SIGNS)
            expected = text.format(who, mail).replace("01003,,", "01003,,9")
            assert found.data.decode() == expected
            assert (found.absent, found.worth, dict(found.strangers)) == (("01004",), 24, {})


@pytest.mark.parametrize(
    ("mark", "same", "others"),
    [
        (Fraction(17, 2), ("8.5", "8,5", "8.50", "8,500"), ("8", "9", "8.51", "85", "8.5?")),
        (Fraction(12), ("12", "12.0", "12,00"), ("12.1", "11", "1" * 5000, "absent")),
        (Fraction(29, 4), ("7.25",), ("7.2", "7,3")),
        (Fraction(22, 3), ("7.33",), ("7.3", "7.333")),
    ],
)
def test_what_a_mark_takes_the_place_of_is_counted_unless_it_is_the_same_number(
    book, mark, same, others
):
    texts = {**dict.fromkeys(("", "-", *same), 0), **dict.fromkeys(others, 1)}
    for text, count in texts.items():
        table = book(f'id;name;mark\n0001;Ana;"{text}"\n0002;Pat;3\n')
        found = with_marks(table, {"0001": mark, "0002": Fraction(3)}, "mark")
        assert found.replaced == count, text


@pytest.mark.parametrize(
    ("text", "column", "words_found"),
    [
        (MOODLE, "Lab 9", "is no column"),
        (MOODLE.replace("0001", "a").replace("0002", "b"), None, "no column holds ids"),
        (CANVAS.replace("Section", "Lab 4"), "Lab", "several columns"),
        (CANVAS + '"Twin",79,0002,x,A,,\n', None, "is in the table twice"),
        ('id,"mark\n0001,\n', None, "never closed"),
        ("id,mark\n", None, "no row below"),
        *((MOODLE, name, "no points") for name in ("First name", "Surname", "ID number")),
        (MOODLE, "Institution", "no points"),
        (
            f"{HALF},\r\n",
            None,
            'no column is empty; expected one of "Grade"; name .* with --column',
        ),
        (f"{HALF},8\r\n", None, 'no column is empty; expected one of "ID number", "Name", "Grade"'),
    ],
)
def test_a_gradebook_that_cannot_be_filled_is_refused(book, text, column, words_found):
    """No mark is written over a name or an id."""
    with pytest.raises(GradebookError, match=words_found):
        with_marks(book(text), MARKS, column)


def test_cells_of_a_gradebook_are_those_that_a_spreadsheet_reads(book):
    """Against the csv module, on cells that hold quotes, separators and ends of lines."""
    table = [["id", "x"], ['a";b', 'c"'], ['""', "d\ne;"], ['";"', " f"]]
    for separator in SEPARATORS:
        file = io.StringIO(newline="")
        csv.writer(file, delimiter=separator).writerows(table)
        read = csv.reader(
            io.StringIO(file.getvalue(), newline=""), delimiter=separator, strict=True
        )
        assert [[cell.text for cell in row] for row in book(file.getvalue()).rows] == [
            [cell.strip() for cell in row] for row in read
        ]


def test_a_gradebook_of_too_many_cells_is_not_read_to_its_end(book, monkeypatch):
    seen, cell = [], gradebook.cell
    monkeypatch.setattr(gradebook, "MOST_CELLS", 50)
    monkeypatch.setattr(gradebook, "cell", lambda raw: seen.append(raw) or cell(raw))
    with pytest.raises(GradebookError, match="more than 50 cells"):
        book("id,mark\n" + "\n" * 1000)
    assert len(seen) == 50


# --- rows by addresses, and ids that lost their zeros -------------------------------------------

OWN = {"01003": Fraction(9), "01004": Fraction(15, 2)}
SIGNS = signs(
    ["01003", "01004"],
    emails={"01003": "ana.s@example.org", "01004": "Pat@Example.org"},
)
WORKSHEET = (
    "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Feedback comments\r\n"
    "Participant 12345,Ana,ana.s@example.org,Submitted,,10,\r\n"
    "Participant 12346,Pat,pat@example.org,Submitted,,10,\r\n"
)


def test_a_gradebook_without_ids_is_filled_by_addresses(book):
    found = with_marks(book(WORKSHEET), OWN, "Grade", SIGNS)
    assert b"org,Submitted,9,10," in found.data and b"org,Submitted,7.5,10," in found.data
    assert found.worth == 10 and not found.absent
    unnamed = with_marks(book(WORKSHEET.replace("Status,", "Last modified,")), OWN, None, SIGNS)
    assert unnamed.data == found.data.replace(b"Status,", b"Last modified,")
    with pytest.raises(GradebookError, match="no column holds ids of this class"):
        with_marks(book(WORKSHEET), OWN, "Grade", SIGNS, "id")
    with pytest.raises(GradebookError, match="the class list has no column e-mail"):
        with_marks(book(WORKSHEET), OWN, "Grade", signs(OWN))


def test_a_row_without_an_id_is_found_by_its_address(book):
    """Where that is one student's, who has no row with the id; a foreign id is nobody's."""
    text = "Row,ID number,Grade\r\n1,1003,\r\n2,1004,\r\n"
    found = with_marks(book(text), OWN, "Grade", SIGNS)
    assert found.data == b"Row,ID number,Grade\r\n1,1003,9\r\n2,1004,7.5\r\n"
    text = "ID,E-mail,Grade\r\n01003,,\r\n,PAT@example.org,\r\n,ana.s@example.org,\r\n"
    found = with_marks(book(text), OWN, "Grade", SIGNS)
    rows = found.data.decode().split("\r\n")
    assert rows[1:4] == ["01003,,9", ",PAT@example.org,7.5", ",ana.s@example.org,"]
    assert (found.count, found.absent) == (2, ())
    assert with_marks(book(text), OWN, "Grade", SIGNS, "id").absent == ("01004",)
    foreign = text.replace(",PAT", "77,PAT")
    assert with_marks(book(foreign), OWN, "Grade", SIGNS).absent == ("01004",)
    with pytest.raises(GradebookError, match='"01004" is in the table twice'):
        with_marks(book(text + ",pat@example.org,\r\n"), OWN, "Grade", SIGNS)


# --- workbooks ----------------------------------------------------------------------------------

PACKED = (
    ("Prenume", "Nume", "Număr de identificare", "Temă: Lab 3 (Valoare reală)", "Feedback: Lab 3"),
    ("Ana", "O'Neil, Jr.", "0001", "-", None),
    ("Ștefan", "=1+1", "0002", "-", None),
    ("Guest", "X", "9999", "-", None),
)
SCORED = (
    ("Student", "ID", "SIS User ID", "Section", "Lab 3 (4711)", "Final Score", None),
    ("    Points Possible", None, None, None, 24, "(read only)", None),
    ("O'Neil, Ana", 77, "0001", "A", None, 88.5, None),
    ("Ionescu, Ștefan", 78, "0002", "A", None, None, None),
)


@pytest.fixture
def saved(tmp_path):
    """A workbook with a bold head, a formula beside it, and a second sheet."""

    def written(rows) -> Path:
        book = openpyxl.Workbook()
        for row in rows:
            book.active.append(row)
        book.active["A1"].font = openpyxl.styles.Font(bold=True)
        book.active["J2"] = "=SUM(D2:D4)"
        book.create_sheet("other")["B2"] = "kept"
        book.save(tmp_path / "book.xlsx")
        return tmp_path / "book.xlsx"

    return written


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
        (PACKED, "Lab 3", {"D2": 8.5, "D3": 12}),
        (PACKED, None, {"D2": 8.5, "D3": 12}),
        (SCORED, None, {"E3": 8.5, "E4": 12}),
        (SCORED, "Lab 3 (4711)", {"E3": 8.5, "E4": 12}),
    ],
)
def test_only_the_marks_change(saved, rows, column, changed):
    path = saved(rows)
    found = with_marks(read_gradebook(path), MARKS, column)
    before, after = cells(path.read_bytes()), cells(found.data)
    assert {**before, **changed} == after
    assert found.count == 2
    assert found.absent == ("X9",)
    assert found.worth == (24 if rows is SCORED else None)
    book = openpyxl.load_workbook(io.BytesIO(found.data))
    assert book.worksheets[0]["A1"].font.bold
    assert book["other"]["B2"].value == "kept"


SHEET, MAIN = "xl/worksheets/sheet1.xml", "xl/workbook.xml"
RICH = "<is><r><rPr><b/></rPr><t>An</t></r><r><t>a</t></r></is>"
SPARKS = (
    '<extLst><ext xmlns:x14="http://schemas.microsoft.com/office/spreadsheetml/2009/9/main"'
    ' uri="{05C60535-1F16-4fd2-B633-F4F36F0B64E0}"><x14:sparklineGroups/></ext></extLst>'
)


def test_fonts_within_a_cell_and_macros_stay(saved):
    path, macros = saved(PACKED), bytes(range(256)) * 4
    more = {"xl/vbaProject.bin": macros, "customXml/item1.xml": b"<a/>"}
    changed(path, (SHEET, "<is><t>Ana</t></is>", RICH), **more)
    after = with_marks(read_gradebook(path), MARKS).data
    assert parts(after)["xl/vbaProject.bin"] == macros
    sheet = openpyxl.load_workbook(io.BytesIO(after), rich_text=True).worksheets[0]
    bold, rest = sheet["A2"].value
    assert (bold.font.b, bold.text, rest) == (True, "An", "a")


@pytest.mark.parametrize(
    ("pieces", "more", "words"),
    [
        ([(SHEET, "</worksheet>", f"{SPARKS}</worksheet>")], {}, "extLst of xl/worksheets/sheet1"),
        ([], {"xl/media/image1.png": b"\x89PNG\r\n"}, "xl/media/image1.png"),
        ([], {"xl/charts/chart1.xml": b"<c/>"}, "xl/charts/chart1.xml"),
    ],
)
def test_a_workbook_that_would_lose_something_is_refused(saved, pieces, more, words):
    path = saved(PACKED)
    changed(path, *pieces, **more)
    with pytest.raises(GradebookError, match=words):
        with_marks(read_gradebook(path), MARKS)
    assert with_marks(read_gradebook(path), {}, signs=signs(MARKS)).data == path.read_bytes()


def test_results_of_formulas_are_computed_anew_on_every_sheet(tmp_path):
    book = openpyxl.Workbook()
    for row in (PACKED[0], PACKED[1], PACKED[3]):
        book.active.append(row)
    book.create_sheet("sums")["A1"] = "=Sheet!D2"
    book.save(tmp_path / "book.xlsx")
    path, other = tmp_path / "book.xlsx", "xl/worksheets/sheet2.xml"
    changed(path, (other, "</f>", "</f><v>3</v><!--"), (other, "</c>", "--></c>"))
    after = with_marks(read_gradebook(path), MARKS).data
    values = openpyxl.load_workbook(io.BytesIO(after), data_only=True)["sums"]
    assert values["A1"].value is None
    assert b'fullCalcOnLoad="1"' in parts(after)[MAIN]


def test_the_same_marks_give_the_same_bytes_at_any_time(saved, monkeypatch):
    path = saved(PACKED)
    first = with_marks(read_gradebook(path), MARKS).data
    monkeypatch.setattr(time, "localtime", lambda *_: time.gmtime(2e9))
    monkeypatch.setattr(time, "time", lambda: 2e9)
    assert with_marks(read_gradebook(path), MARKS).data == first


def test_a_mark_in_merged_cells_is_refused(saved):
    path = saved(PACKED)
    book = openpyxl.load_workbook(path)
    book.active.merge_cells("D2:D3")
    book.save(path)
    with pytest.raises(GradebookError, match=r"row 3: .*merged cells"):
        with_marks(read_gradebook(path), MARKS)


def test_no_mark_takes_the_place_of_a_formula(saved):
    rows = [PACKED[0], *((*row[:3], "=1+2", None) for row in PACKED[1:])]
    with pytest.raises(GradebookError, match=r"holds a formula|no points"):
        with_marks(read_gradebook(saved(rows)), MARKS, "Lab 3")
    rows = [PACKED[0], (*PACKED[1][:3], "=1+2", None), (*PACKED[2][:3], 3, None)]
    with pytest.raises(GradebookError, match=r"row 2: .*holds a formula"):
        with_marks(read_gradebook(saved(rows)), MARKS, "Lab 3")


def test_ids_that_a_format_shows_with_zeros_are_found(saved):
    rows = [PACKED[0], *((a, b, int(c), *rest) for a, b, c, *rest in PACKED[1:])]
    path = saved(rows)
    book = openpyxl.load_workbook(path)
    for row in range(2, 5):
        book.active.cell(row, 3).number_format = "0000"
    book.save(path)
    assert with_marks(read_gradebook(path), MARKS).count == 2


@pytest.mark.parametrize("column", ["Lab 3", None])
def test_an_average_below_the_students_is_no_mark_of_anybody(saved, column):
    rows = [("Nume", "Matricol", "Lab 3"), ("Ana", "0001", None), ("Ștefan", "0002", None)]
    rows += [("Media", None, "=AVERAGE(C2:C3)")]
    found = cells(with_marks(read_gradebook(saved(rows)), MARKS, column).data)
    assert [found[place] for place in ("C2", "C3", "C4")] == [8.5, 12, "=AVERAGE(C2:C3)"]


@pytest.mark.parametrize(
    ("rows", "column", "words"),
    [
        (PACKED, "Lab 9", "is no column"),
        ([PACKED[0], *[PACKED[1]] * 2], None, "is in the table twice"),
        ([PACKED[0], ("A", "B", "7", "-", None)], None, "no column holds ids"),
    ],
)
def test_a_workbook_that_cannot_be_filled_is_refused(saved, rows, column, words):
    with pytest.raises(GradebookError, match=words):
        with_marks(read_gradebook(saved(rows)), MARKS, column)


def test_a_broken_workbook_is_refused(tmp_path):
    for data in (b"PK\x03\x04 no zip", b"PK\x03\x04"):
        (tmp_path / "book.xlsx").write_bytes(data)
        with pytest.raises(GradebookError, match="cannot be read as XLSX"):
            with_marks(read_gradebook(tmp_path / "book.xlsx"), MARKS)


def test_a_workbook_far_larger_unpacked_is_refused(tmp_path):
    path = tmp_path / "bomb.xlsx"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed, packed.open("a", "w") as part:
        for _ in range(65):
            part.write(bytes(1 << 20))
    with pytest.raises(GradebookError, match="far larger unpacked"):
        with_marks(read_gradebook(path), MARKS)
