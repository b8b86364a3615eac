"""A class list may be hostile, or just saved by a spreadsheet: nothing is lost, all is told."""

from __future__ import annotations

import csv
import io
import os
import zipfile
from itertools import product
from pathlib import Path

import openpyxl
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster import spreadsheets
from graphkin.classroom.roster.read_roster import NAMES, read_roster
from graphkin.classroom.roster.spreadsheets import (
    MOST_CELLS,
    SEPARATORS,
    folded,
    xlsx_rows,
)
from graphkin.classroom.roster.students import NAMES as LANGUAGE_NAMES
from graphkin.classroom.roster.students import Student, language_in
from graphkin.classroom.variants.assign import check_of
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import InTable, RosterError
from graphkin.text.tables import NUMBER, csv_text, safe

PLAIN = "number,id,name,group\n1,0042,Ann Lee,A\n2,0043,Bob Roe,B\n"
READ = [
    Student(2, "0042", 1, "Ann Lee", "A"),
    Student(3, "0043", 2, "Bob Roe", "B"),
]


@pytest.fixture
def saved(tmp_path):
    def written(content, name="roster.csv"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        return path

    return written


def problems(path, numbered=True):
    with pytest.raises(RosterError) as caught:
        read_roster(path, numbered=numbered)
    return [str(problem) for problem in caught.value.problems]


# ------------------------------------------------------------------------------ what is read


def test_separator_line_ends_and_byte_order_mark_do_not_matter(saved):
    for separator, newline, encoding in product(
        SEPARATORS, ("\n", "\r\n", "\r"), ("utf-8", "utf-8-sig", "utf-16")
    ):
        text = PLAIN.replace(",", separator).replace("\n", newline)
        assert read_roster(saved(text.encode(encoding)), numbered=True) == READ


HEADS = """NUMBER,ID,NAME,GROUP
 Number , Student ID,Full name,Section
Nr.,Nr. matricol,Nume și prenume,Grupă
nr crt,MATRICOL,Numele și prenumele,Grupa
N.,Matricola,Nome e cognome,Gruppo
Numero,Numero di matricola,Nominativo,CLASSE
Nr.,Matrikelnummer,"Name, Vorname",Gruppe
lfd. Nr.,Matrikel-Nr.,Vorname Name,Übungsgruppe
Nummer,Matr.-Nr.,Name und Vorname,Kurs
N°,Numéro étudiant,"Nom, prénom",Groupe
Numéro,N° étudiant,Nom et prénom,Groupe de TD
Nº,Número de matrícula,"Apellidos, nombre",Grupo
Número,Expediente,Apellidos y nombre,Clase
№,№ зачётки,ФИО,Группа
№ п/п,Номер зачётной книжки,Фамилия и имя,группа
"number","id","name","group\""""


@pytest.mark.parametrize("head", HEADS.splitlines())
def test_heads_are_known_in_every_language_whatever_their_case(saved, head):
    assert read_roster(saved(PLAIN.replace("number,id,name,group", head)), numbered=True) == READ


@pytest.mark.parametrize("heads", ["Name;Vorname", "Nom;Prénom", "Apellidos;Nombre", "Фамилия;Имя"])
def test_a_name_in_two_columns_is_one_name(saved, heads):
    (one,) = read_roster(saved(f"id;{heads};E-Mail\n7;Lee;Ann;a@b.c\n"))
    assert one.name == "Lee Ann"


def test_a_name_with_a_comma_under_one_head_stays_one_name(saved):
    text = "Nr.;Matrikelnummer;Name, Vorname;Gruppe;E-Mail\n1;310001;Müller, Jörg;A;j@b.c\n"
    (one,) = read_roster(saved(text), numbered=True)
    assert (one.id, one.number, one.name, one.group) == ("310001", 1, "Müller, Jörg", "A")


HEADS_BESIDE = [
    ("E-Mail-Adresse", "Sprache"),
    ("Adresse e-mail", "Langue"),
    ("Correo electrónico", "Idioma"),
    ("Эл. почта", "Язык"),
]


@pytest.mark.parametrize("heads", HEADS_BESIDE)
def test_addresses_and_languages_are_understood_in_every_language(saved, heads):
    told = []
    read_roster(saved(f"id;name;{';'.join(heads)}\n7;Ann;a@b.c;de\n"), tell=told.append)
    assert not told


def test_no_name_of_a_column_means_two_things():
    meanings: dict[str, set[str]] = {}
    for what, names in NAMES.items():
        for name in (what, *names):
            meanings.setdefault(folded(name), set()).add(what)
    assert all(meanings)
    assert not {name: what for name, what in meanings.items() if len(what) > 1}


def test_other_columns_are_kept_as_they_are(saved):
    text = "id,e-mail,x,,x2\n07, a@b.c ,=1+1,first,-5\n"
    assert read_roster(saved(text))[0].extra == {
        "e-mail": "a@b.c",
        "x": "=1+1",
        "column 4": "first",
        "x2": "-5",
    }


def test_leading_zeros_diacritics_commas_and_apostrophes_stay(saved):
    text = 'number;id;name\n007;000123;"O\'Neil, Jr. ""Nan"" Ștefănescu-Țuțea"\n'
    (one,) = read_roster(saved(text), numbered=True)
    assert (one.id, one.number) == ("000123", 7)
    assert one.name == 'O\'Neil, Jr. "Nan" Ștefănescu-Țuțea'


def test_a_moodle_and_a_canvas_export_are_class_lists(saved):
    moodle = "First name,Surname,ID number,Email address\nAnn,Lee,0042,a@b.c\n"
    canvas = 'Student,ID,SIS User ID,Section\n    Points Possible,,,\n"Lee, Ann",9,0042,A\n'
    assert read_roster(saved(moodle))[0] == Student(
        2, "0042", None, "Ann Lee", "", {"Email address": "a@b.c"}
    )
    assert read_roster(saved(canvas))[0].name == "Lee, Ann"


TITLED = "Universitatea, Facultatea de Inginerie\nGrupa 321;;;\n\nNr.;Matricol;Nume;Grupa\n"


def test_the_head_is_found_below_titles(saved, book):
    for separator in SEPARATORS:
        text = TITLED.replace(";", separator) + separator.join(["7", "0042", "Ann Lee", "A"])
        found = read_roster(saved(text), numbered=True)
        assert found == [Student(5, "0042", 7, "Ann Lee", "A")]
    rows = [["Lista studenților 2026"], [], ["An II"], ["Nr.", "Matricol"], [1, 1], [2, 2]]
    assert [(s.row, s.id) for s in read_roster(book(rows), numbered=True)] == [(5, "1"), (6, "2")]


def test_a_head_with_one_known_name_stays_the_head_above_rows_that_look_like_one(saved):
    (one, two) = read_roster(saved("id,x\n7,id\n8,name\n"))
    assert (one.extra, two.extra) == ({"x": "id"}, {"x": "name"})


NAMED = """Nume,Prenume: Popa,Ana Maria
Numele studentului;Prenumele: Popa;Ana
Prenumele studentului,Nume de familie: Ana,Popa
First name,Surname: Ann,Lee
Family name,Given names: Lee,Ann
Cognome,Nome: Rossi,Anna
Nome,Cognome: Anna,De Rossi"""


@pytest.mark.parametrize("named", NAMED.splitlines())
def test_names_in_two_columns_are_joined_in_their_order(saved, named):
    separator = ";" if ";" in named else ","
    head, _, row = named.partition(": ")
    (one,) = read_roster(saved(f"id{separator}{head}\n1{separator}{row}\n"))
    assert one.name == row.replace(separator, " ") and not one.extra


def test_a_column_code_holds_ids_unless_another_is_called_id(saved):
    (one,) = read_roster(saved("Code,Name\nX1,Ann\n"))
    assert one.id == "X1"
    (one,) = read_roster(saved("Code,ID,Name\nX1,0042,Ann\n"))
    assert (one.id, one.extra) == ("0042", {"Code": "X1"})


def test_columns_that_are_not_understood_are_named(saved):
    said: list[str] = []
    read_roster(saved("id,Cine,Obs.,e-mail,limba\n1,Ana,x,a@b.c,ro\n"), tell=said.append)
    assert said == [
        'roster.csv: columns not understood, kept as they are: "Cine", "Obs."; none holds the names'
    ]
    read_roster(saved("id,name,Obs.\n1,Ana,x\n"), tell=said.append)
    assert said[1].endswith('as they are: "Obs."')
    read_roster(saved("id,name,e-mail\n1,Ana,a@b.c\n"), tell=said.append)
    assert len(said) == 2


# --------------------------------------------------------------------------- what is refused


@pytest.mark.parametrize("count", [4, 90])
def test_one_cause_is_one_line_however_many_rows(saved, count):
    (found,) = problems(saved("id\n" + "a,b,c\n" * count), numbered=False)
    assert found.startswith("roster.csv, row 2: 3 cells, and the head has 1")
    more = f" and {count - 5} more" if count > 5 else ""
    assert found.endswith(
        f"the same in rows {', '.join(map(str, range(3, 3 + min(4, count - 1))))}{more}"
    )
    found = problems(saved("nr,id\n" + "".join(f"x{i},{i}\n" for i in range(count)) + "5,\n"))
    assert len(found) == 2
    assert '"x0" is no whole number' in found[0] and f"row {count + 2}" in found[1]


def test_a_class_beyond_the_range_of_a_lab_is_one_line(saved):
    lab = read_lab("pump")
    text = "nr,id\n" + "".join(f"{n},s{n}\n" for n in range(1, 121))
    with pytest.raises(RosterError) as caught:
        read_roster(saved(text), numbered=True, check=check_of(lab))
    (found,) = map(str, caught.value.problems)
    assert found.startswith("roster.csv, row 32: number 31 gives")
    assert found.endswith("the same in rows 33, 34, 35, 36 and 85 more")


def test_one_mistake_in_two_columns_is_told_of_both():
    columns = ("id", "e-mail")
    told = spreadsheets.TableProblems("a.csv")
    places = [InTable("a.csv", row, column) for row in range(2, 12) for column in columns]
    for place in places:
        told.add(place, "nothing", "a text")
    with pytest.raises(RosterError) as raised:
        told.stop()
    found = [problem.place for problem in raised.value.problems]
    assert found == ['a.csv, row 2, column "id"', 'a.csv, row 2, column "e-mail"']


HOSTILE = {
    "": "the table is empty",
    "\ufeff\n\n": "the table is empty",
    "number,id,name,group\n": "no student below the head",
    "number,name\n1,Ann\n": 'no column id; the head is "number", "name"',
    "id,name\n1,Ann\n": "no column number; the lab's formula needs the student's number",
    "nunber,id\n1,1\n": 'is it "nunber"? then call that column "number"',
    "number,id\n1,7\n2,7\n": 'row 3, column "id": "7" is in row 2 already',
    "number,id\n1,ab\n2,AB\n": 'row 3, column "id": "AB", written "ab", is in row 2 already',
    "number,id\n,7\n": 'row 2, column "number": is missing',
    "Nr.,id\nx,7\n": 'row 2, column "Nr.": "x" is no whole number',
    "number,id\n-1,7\n": '"-1" is no whole number',
    "number,id\n1e3,7\n": '"1e3" is no whole number',
    "number,id\n１,7\n": '"１" is no whole number',
    "number,id\n1_000,7\n": '"1_000" is no whole number',
    "number,id\n1234567890,7\n": "is no whole number",
    "number,id\n1,\n": 'row 2, column "id": is missing',
    "number,id\n1,7\n2,8,9\n": "row 3: 3 cells, and the head has 2",
    "number,id,number\n1,7,2\n": 'two columns are called "number"',
    'number,id,name\n1,7,"Ann\n2,8,Bob\n': "row 2: a quote that is opened and never closed",
    'number,id,name\n1,7,"Ann\n2,8,Bob"\n3,9,Cy\n': "row 2: a cell goes on to row 3",
    'number,id,name\n1,7,"Ann" Lee\n': "row 2: a quote in the middle of a quoted cell",
    "number,id\n1,7\0\n": 'row 2, column "id": the control character',
    "n\0u\0m\0b\0e\0r\0,\0i\0d\0": "row 1: a NUL character",
    "number,id\n1,7\u202e\n": "the control character",
    "number,id\n1,a\x07b\n": "the control character",
    "number,id\n1," + "7" * 101 + "\n": "101 characters",
    "number,id,name\n1,7," + "x" * 5000 + "\n": "at most 4000",
}


@pytest.mark.parametrize(("text", "expected"), HOSTILE.items(), ids=lambda v: v[:40])
def test_what_is_wrong_is_told_by_row_and_column(saved, text, expected):
    found = problems(saved(text))
    assert any(expected in problem for problem in found), found
    assert all("roster.csv" in problem for problem in found)


def test_a_table_without_a_head_has_no_student_for_the_name_of_a_column(saved):
    """Ana is near to nr, but a row with a number is a student's."""
    for text in ("1;0042;Ana\n2;0043;Pat\n", "1,0042,nunber\n2,0043,Pat\n"):
        found = problems(saved(text))
        assert all(each.endswith("the first row names the columns") for each in found), found


def test_what_is_not_utf_8_is_told_with_its_row_and_the_way_out(saved):
    (found,) = problems(saved("number,id,name\n1,7,Ștefan\n".encode("utf-16-le")))
    assert "NUL" in found
    (found,) = problems(saved("number,id,name\n1,7,Ann\n2,8,é\n".encode("latin-1")))
    assert "row 3" in found and "CSV UTF-8" in found


def test_a_formula_cell_is_read_as_text_and_never_run(saved):
    (one,) = read_roster(saved('id,name\n1,"=HYPERLINK(""http://x"")"\n'))
    assert one.name == '=HYPERLINK("http://x")'


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    some.binary(max_size=300) | some.text(max_size=200).map(lambda t: ("id,number\n" + t).encode())
)
def test_no_bytes_are_more_than_told(saved, data):
    try:
        read_roster(saved(data), numbered=True)
    except RosterError as error:
        assert error.problems


# --------------------------------------------------------------------------------- what is written


SAFE = {
    "=HYPERLINK(1)": "'=HYPERLINK(1)", "+cmd": "'+cmd", "@SUM(1)": "'@SUM(1)", "-x": "'-x",
    "\t=1": "'\t'=1", "b;=1+1": "b;'=1+1", "b; @SUM(1)": "b; '@SUM(1)", "a\n+cmd": "a\n'+cmd",
    "＝1": "'＝1", " =1": "' =1", ";=1": ";'=1", 'a;"=1"': 'a;"\'=1"', -5: "-5",
}  # fmt: skip
PLAINLY = ("B-2; C", "x, -y", "-5", "+5.5", "-1,5", "-5e3", "Ann", "")


def test_formula_cells_are_escaped_and_numbers_stay():
    assert {cell: safe(cell) for cell in (*SAFE, *PLAINLY)} == {
        **SAFE,
        **{cell: cell for cell in PLAINLY},
    }


@given(
    some.lists(
        some.lists(some.text("ab,;\"' \n=é-5+@\t", min_size=1), min_size=2, max_size=3), min_size=1
    )
)
def test_what_is_written_reads_back(rows):
    """By any reader of CSV; and one that expects another separator finds no formula."""
    found = list(csv.reader(io.StringIO(csv_text(rows), newline=""), strict=True))
    assert found == [[safe(cell) for cell in row] for row in rows]
    for separator in ",;\t":
        for row in csv.reader(io.StringIO(csv_text(rows), newline=""), delimiter=separator):
            runs = [cell for cell in row if cell.lstrip().startswith(("=", "+", "@", "-"))]
            assert all(NUMBER.match(cell.lstrip()) for cell in runs), runs


# --------------------------------------------------------------------------------------- XLSX


@pytest.fixture
def book(tmp_path):
    def written(rows, formats=()):
        workbook = openpyxl.Workbook()
        for row in rows:
            workbook.active.append(row)
        for cell, form in formats:
            workbook.active[cell].number_format = form
        path = tmp_path / "roster.xlsx"
        workbook.save(path)
        return path

    return written


def test_a_workbook_is_a_class_list_with_the_zeros_that_a_format_shows(book):
    rows = [["Nr.", "Matricol", "Nume", "Grupa", "medie"], [1, "0042", "Ștefan", "A", 9.5]]
    (one,) = read_roster(book(rows), numbered=True)
    assert one == Student(2, "0042", 1, "Ștefan", "A", {"medie": "9.5"})
    path = book([["number", "id"], [7.0, 42]], [("B2", "0000")])
    assert [(s.number, s.id) for s in read_roster(path, numbered=True)] == [(7, "0042")]


def test_ids_that_are_numbers_of_a_workbook_may_have_lost_their_zeros(book):
    """0041 typed into a spreadsheet is 41; as text, or with a format that shows zeros, it stays."""
    said: list[str] = []
    read_roster(book([["id", "name"], [41, "A"], ["0042", "B"]]), tell=said.append)
    assert len(said) == 1
    assert "1 ids are numbers in the file, such as 41: leading zeros would be lost" in said[0]
    assert "0042" in said[0]
    read_roster(book([["id"], [4100], [4101]]), tell=said.append)
    assert "leading zeros would be lost; if" in said[1]
    read_roster(book([["id", "nr"], ["0041", 1]]), tell=said.append)
    read_roster(book([["id"], [41]], [("A2", "0000")]), tell=said.append)
    assert len(said) == 2


def test_problems_of_a_workbook_name_its_rows(book):
    found = problems(book([["number", "id"], [1, 7], [None, None], ["x", 7]]))
    assert 'roster.xlsx, row 4, column "number": "x" is no whole number' in found[0]
    assert 'row 4, column "id": "7" is in row 2 already' in found[1]


def test_a_broken_workbook_and_a_bomb_are_told(saved):
    assert "cannot be read as XLSX" in problems(saved(b"PK\x03\x04" + bytes(100), "r.xlsx"))[0]
    room = io.BytesIO()
    with zipfile.ZipFile(room, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("xl/workbook.xml", bytes(65 * 1024 * 1024))
    assert "far larger unpacked" in problems(saved(room.getvalue(), "r.xlsx"))[0]


SHEET = '<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
TITLES = "<row><c t='inlineStr'><is><t>nr</t></is></c><c t='inlineStr'><is><t>id</t></is></c></row>"


@pytest.fixture
def packed(book):
    """A workbook whose rows are given as XML, below a head with nr and id."""

    def written(rows):
        path = book([["a"]])
        with zipfile.ZipFile(path) as was:
            parts = {name: was.read(name) for name in was.namelist()}
        parts["xl/worksheets/sheet1.xml"] = (
            f"{SHEET}{TITLES}{rows}</sheetData></worksheet>".encode()
        )
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as now:
            for name, data in parts.items():
                now.writestr(name, data)
        return path

    return written


def test_a_stray_cell_far_below_costs_no_cells_between(packed):
    """The last row of a spreadsheet is the 1 048 576th; what is empty above it makes no rows."""
    rows = '<row r="2"><c/><c s="0"/></row><row r="1048576"><c><v>1</v></c><c><v>7</v></c></row>'
    found = list(xlsx_rows(packed(rows).read_bytes(), "roster.xlsx"))
    assert [(row.line, row.cells) for row in found] == [(1, ("nr", "id")), (1048576, ("1", "7"))]
    (refused,) = problems(packed('<row r="1048577"><c><v>1</v></c></row>'))
    assert "1048577 rows" in refused


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ('<row r="1001"><c><v>1</v></c></row>', "1001 rows"),
        ("<row><c><v>1</v></c><c r='XFD2'><v>1</v></c></row>" * 200, "124 rows, and 2015234 cells"),
        ("<row><c><v>1</v></c></row>" * 333_333, "XML elements"),
    ],
)
def test_a_workbook_far_too_large_is_not_read_to_its_end(packed, monkeypatch, rows, words):
    """No more than the cells that a table may have are looked at."""
    seen = []
    monkeypatch.setattr(spreadsheets, "LAST_ROW", 1000)
    monkeypatch.setattr(spreadsheets, "cell_text", lambda cell: seen.append(cell) or "")
    (found,) = problems(packed(rows))
    assert words in found
    assert len(seen) <= MOST_CELLS


def test_empty_cells_at_the_end_of_a_row_are_looked_at_once(saved, monkeypatch):
    seen, tidy = [], spreadsheets.tidy
    monkeypatch.setattr(spreadsheets, "tidy", lambda cell: seen.append(cell) or tidy(cell))
    (one,) = read_roster(saved("nr;id\n1;7" + ";" * 10_000 + "\n"), numbered=True)
    assert one.id == "7"
    assert len(seen) == 4 + 10_000


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders there")
def test_a_pipe_is_no_table_and_nobody_waits_for_it(tmp_path):
    os.mkfifo(tmp_path / "roster.csv")
    (found,) = problems(tmp_path / "roster.csv")
    assert "a pipe or a device is no file" in found
    assert "a pipe or a device is no file" in problems(Path(os.devnull))[0]


def test_mistakes_of_all_sorts_are_told_at_once_in_the_order_of_the_rows(saved):
    """A row too long, a number missing, none, an id twice, an id missing, a quote left open."""
    rows = ["Nr;id;nume", "1;2;x;1", ";3;a", ",5;4;b", "5;6;c", "6;6;d", '7;;"e f"', '8;9;"open']
    found = problems(saved("\n".join(rows)))
    expected = ["4 cells", "is missing", "no whole number", "is in row 5", "missing", "quote"]
    assert all(f"row {row}" in line for row, line in zip((2, 3, 4, 6, 7, 8), found, strict=True))
    assert all(word in line for word, line in zip(expected, found, strict=True)), found


def test_a_column_that_is_known_is_not_proposed_for_another(saved):
    """Nume is the name, however near to number."""
    (found,) = problems(saved("Matricol;Nume\n0042;Ana\n"))
    assert found.endswith("the first row names the columns")


def test_a_column_that_is_missing_hides_no_other_mistake(saved):
    found = problems(saved("Numer;id\n1;2;x\n3;\n4;5\n"))
    assert "no column number" in found[0]
    assert found[0].endswith('is it "Numer"? then call that column "number"')
    assert [line.split(":")[0] for line in found[1:]] == [
        "roster.csv, row 2",
        'roster.csv, row 3, column "id"',
    ]


def test_every_language_of_the_pages_has_names_in_class_lists():
    assert set(LANGUAGE_NAMES) == set(LANGUAGES)
    assert {language_in(words(code)("language")) for code in LANGUAGES} == set(LANGUAGES)
