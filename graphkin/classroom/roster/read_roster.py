"""A class list: one student a row, with columns named in any language of the pages.

A column of ids is required, and one of numbers if the lab's rule is a formula of the number. Name
and group are printed if given; every other column is kept unchanged.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from msgspec import Struct, field

from graphkin.classroom.roster.spreadsheets import (
    SheetRow,
    Spreadsheet,
    TableProblems,
    columns,
    folded,
    read_sheet,
)
from graphkin.classroom.roster.students import EMAIL, Student
from graphkin.classroom.roster.students import HEADS as LANGUAGE
from graphkin.scene.findings import nearest, shown, visible
from graphkin.text.errors import NO_WORDS, InTable, Message, Problem, either, joined, message

NAMES = {
    what: tuple(names.split("; "))
    for what, names in {
        "number": "no; nr; nr.; n; no.; n.; num; nr crt; nr. crt.; număr; număr de ordine; numero; "
        "numero d'ordine; student number; n°; nº; nummer; lfd. nr.; laufende nummer; numéro; "
        "numéro d'ordre; número; número de orden; №; № п/п; номер; порядковый номер",
        "id": "id number; student id; studentid; registration; registration number; sis user "
        "id; matricol; nr. matricol; număr matricol; cod; cod student; matricola; numero "
        "di matricola; n. matricola; codice; id student; id studente; identificator; "
        "identificativo; code; student code; codice studente; matrikelnummer; matrikel-nr.; "
        "matr.-nr.; matrikel; matrnummer; mat.-nr.; immatrikulationsnummer; numéro étudiant; "
        "n° étudiant; numéro d'étudiant; n° d'étudiant; num. étudiant; identifiant; matricule; "
        "número de matrícula; n.º de matrícula; matrícula; núm. de matrícula; expediente; "
        "número de expediente; n.º de expediente; número de estudiante; código; № зачётки; "
        "номер зачётки; зачётка; № зачётной книжки; номер зачётной книжки; "
        "№ студенческого билета; номер студенческого билета; студенческий билет; шифр; "
        "шифр студента; код; код студента",
        "name": "full name; student; student name; nume; numele; nume și prenume; nume prenume; "
        "numele și prenumele; nome; nome e cognome; cognome e nome; nominativo; studente; "
        "numele studentului; numele și prenumele studentului; numele complet; nume "
        "complet; nume student; nome completo; nome studente; nome dello studente; nome "
        "cognome; cognome nome; name and surname; surname and name; last name, first name; "
        "surname, first name; first name last name; name, vorname; name und vorname; nachname, "
        "vorname; vorname name; vorname nachname; vorname und name; vorname und nachname; "
        "vollständiger name; studierende; studierender; studierende(r); nom et prénom; nom, "
        "prénom; nom prénom; prénom nom; prénom et nom; nom complet; étudiant; étudiante; "
        "nombre y apellidos; apellidos y nombre; apellidos, nombre; nombre apellidos; nombre "
        "completo; estudiante; alumno; alumna; alumno/a; фио; ф.и.о.; фамилия, имя; фамилия и "
        "имя; имя и фамилия; фамилия имя; имя фамилия; фамилия имя отчество; фамилия, имя, "
        "отчество; студент",
        "first": "first name; first names; given name; given names; forename; prenume; prenumele; "
        "prenume student; prenumele studentului; vorname; vornamen; rufname; prénom; prénoms; "
        "nombre; nombres; имя",
        "last": "surname; last name; family name; nume de familie; numele de familie; cognome; "
        "cognome studente; cognome dello studente; nachname; familienname; zuname; nom; nom de "
        "famille; apellidos; apellido; primer apellido; фамилия",
        "group": "class; section; grupă; grupa; grupa/semigrupa; semigrupa; semigrupă; gruppo; "
        "classe; sezione; seria; gruppe; übungsgruppe; seminargruppe; studiengruppe; kurs; klasse; "
        "semestergruppe; groupe; groupe de td; groupe de tp; grupo; grupo de prácticas; clase; "
        "sección; группа; подгруппа; учебная группа; класс",
    }.items()
}
"""The names of each column, in every language of the pages."""
NAMED = {"name", "first", "last"}
"""Columns that together form a name.

*nume* is the full name in one list and the surname in another.
"""
Check = Callable[[Student], Iterable[Problem]]
"""Finds the problems of a student."""
MOST_DIGITS = 9
Tell = Callable[[str], object]
"""Reports a note that is not an error."""
LONGEST_ID, LONGEST_NAME = 100, 200
POSSIBLE = "Points Possible"
"""The first cell of the row with the points of each assignment in an export from Canvas."""
WHOLE = re.compile(r"[0-9]+")
DECIMAL_ZERO = re.compile(r"([0-9]+)[.,]0+")


def read_roster(
    path: str | Path,
    *,
    numbered: bool = False,
    check: Check | None = None,
    tell: Tell | None = None,
) -> list[Student]:
    """The students of a class list, in its order; raises RosterError with every problem by row.

    ``numbered`` requires a number for each student. ``check`` finds further problems of a student
    who has a number. ``tell`` receives notes: ids that may have lost their leading zeros, and
    columns that are not understood.
    """
    faults = TableProblems(Path(path).name)
    sheet = read_sheet(
        Path(path), [name for what, every in NAMES.items() for name in (what, *every)], faults
    )
    where = found_columns(sheet, faults, numbered)
    reading = RosterReading(sheet, where, faults, numbered)
    students: list[Student] = []
    for row in sheet.rows:
        if POSSIBLE in row.cells[:1]:
            continue
        one = reading.student(row)
        students.append(one)
        for problem in check(one) if check is not None and one.number is not None else ():
            faults.add(sheet.place(row), problem.found, problem.expected, problem.hint)
    if not sheet.rows and not faults.problems:
        faults.add(
            sheet.name, message("no student below the head"), message("a row for each student")
        )
    faults.stop()
    for note in (lost_zeros(sheet, where["id"]), not_understood(sheet, where)):
        if note and tell is not None:
            tell(note)
    return students


def not_understood(sheet: Spreadsheet, where: Mapping[str, int]) -> str:
    """A note on the columns that are not understood and kept unchanged; empty if none."""
    known = {folded(name) for name in ("email", *EMAIL, *LANGUAGE)}
    heads = [
        f'"{visible(head)}"'
        for i, head in enumerate(sheet.head)
        if head and i not in where.values() and folded(head) not in known
    ]
    if not heads:
        return ""
    nameless = "; none holds the names" if not NAMED & where.keys() else ""
    return f"{sheet.name}: columns not understood, kept as they are: {', '.join(heads)}{nameless}"


def lost_zeros(sheet: Spreadsheet, column: int) -> str:
    """A note on ids stored as numbers, which have no leading zeros in a workbook; empty if none."""
    bare = [row.cells[column] for row in sheet.rows if column in row.numbers]
    if not bare:
        return ""
    others = [row.cells[column] for row in sheet.rows if column not in row.numbers]
    padded = next((text for text in others if WHOLE.fullmatch(text) and text[0] == "0"), "")
    why = f", and others such as {padded} have some" if padded else ""
    return (
        f"{sheet.name}: {len(bare)} ids are numbers in the file, such as {bare[0]}: leading zeros"
        f" would be lost{why}; if the ids have any, format the column as text and type them again"
    )


def found_columns(sheet: Spreadsheet, faults: TableProblems, numbered: bool) -> dict[str, int]:
    """The column of each kind of data; a missing required column is recorded."""
    where = columns(sheet, NAMES)
    wanted: dict[str, tuple[str, ...]] = {
        "id": ("matricol", "matricola", "Matrikelnummer", "matricule", "matrícula")
    }
    wanted |= {"number": ("nr", "numero")} if numbered else {}
    for what, others in wanted.items():
        if what not in where:
            heads = joined(", ", (f'"{visible(cell)}"' for cell in sheet.head[:12]))
            heads = heads or message("nothing")
            is_head = not any(cell.isdecimal() for cell in sheet.head)
            free = [cell for i, cell in enumerate(sheet.head) if i not in where.values()]
            hints = (meant(cell, what) for cell in free if is_head)
            hint = next(filter(None, hints), message("the first row names the columns"))
            faults.add(
                sheet.name,
                message(
                    "no column {what}; the lab's formula needs the student's number; the head is "
                    "{heads}"
                    if what == "number"
                    else "no column {what}; the head is {heads}",
                    what=what,
                    heads=heads,
                ),
                message('a column named "{what}", {others}', what=what, others=either(others)),
                hint,
            )
    return where


def meant(head: str, what: str) -> Message:
    """A hint if a head is close to a name of the column; empty if it is not."""
    near = nearest(head, [what, *NAMES[what]])
    if not near:
        return NO_WORDS
    return message('is it "{head}"? then call that column "{what}"', head=visible(head), what=what)


class RosterReading(Struct, frozen=True):
    """A class list being read.

    ``where`` is the column of each kind of data, ``numbered`` whether each student needs a number,
    ``first`` the first student with each id.
    """

    sheet: Spreadsheet
    where: Mapping[str, int]
    faults: TableProblems
    numbered: bool
    first: dict[str, Student] = field(default_factory=dict)

    def cell(self, row: SheetRow, what: str) -> str:
        """The text of a row in a column; empty if there is no such column."""
        return row.cells[self.where[what]] if what in self.where else ""

    def place(self, row: SheetRow, what: str) -> InTable:
        """The place of a cell, with the name that the column has in this file."""
        head = self.sheet.head[self.where[what]] if what in self.where else what
        return self.sheet.place(row, head)

    def student(self, row: SheetRow) -> Student:
        """The student of a row; the problems of the row are recorded.

        An id that occurs in an earlier row is a problem, also if only its case differs.
        """
        named = sorted(NAMED & self.where.keys(), key=lambda what: self.where[what])
        full, own = full_name({what: self.cell(row, what) for what in named}), self.cell(row, "id")
        for what, text, most in (("id", own, LONGEST_ID), ("name", full, LONGEST_NAME)):
            if len(text) > most:
                found = message("{count} characters", count=len(text))
                self.faults.add(self.place(row, what), found, message("at most {most}", most=most))
        if not own and "id" in self.where:
            self.faults.add(
                self.place(row, "id"), message("is missing"), message("the student's id")
            )
        extra = {
            self.sheet.head[i] or f"column {i + 1}": text
            for i, text in enumerate(row.cells)
            if i not in self.where.values()
        }
        name, group = " ".join(full.split()), self.cell(row, "group")
        one = Student(row.line, own, self.number(row), name, group, extra)
        other = self.first.setdefault(own.casefold(), one)
        if own and other is not one:
            found = message(
                "{id} is in row {row} already"
                if other.id == own
                else "{id}, written {other}, is in row {row} already",
                id=shown(own),
                other=shown(other.id),
                row=other.row,
            )
            self.faults.add(
                self.place(row, "id"), found, message("an id of its own for each student")
            )
        return one

    def number(self, row: SheetRow) -> int | None:
        """The student's number, or None; if a number is required, its absence is recorded."""
        text, place = self.cell(row, "number"), self.place(row, "number")
        found = DECIMAL_ZERO.fullmatch(text)
        text = found[1] if found else text
        if WHOLE.fullmatch(text) and len(text) <= MOST_DIGITS:
            return int(text)
        if text and self.numbered:
            self.faults.add(
                place,
                message("{text} is no whole number from 0 on", text=shown(text)),
                message("a number such as 7"),
            )
        elif self.numbered and "number" in self.where:
            self.faults.add(
                place,
                message("is missing"),
                message("the student's number, which the lab's formula needs"),
            )
        return None


def full_name(parts: Mapping[str, str]) -> str:
    """The name of a student: the columns in the order of the file, without repeating a part."""
    whole = parts.get("name", "")
    rest = [part for what, part in parts.items() if what != "name" and part in whole.split()]
    named = [part for part in parts.values() if part and part not in rest]
    return " ".join(named)
