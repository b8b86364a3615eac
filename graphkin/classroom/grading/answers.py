"""Answer tables: one row for each student, or one file each, by the fields of the form.

A cell that cannot be read is no error of the table: it is told, and does not count as wrong.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path

from msgspec import Struct, field

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.submissions import HandedIn, Sender, submissions
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.language_names import HEADS as LANGUAGE
from graphkin.classroom.roster.read_roster import NAMES
from graphkin.classroom.roster.sheet_rows import SheetRow
from graphkin.classroom.roster.spreadsheets import (
    Spreadsheet,
    TableProblems,
    columns,
    folded,
    sheet_in,
)
from graphkin.classroom.roster.student_signs import EMAIL, Match, Signs
from graphkin.scene.findings import near_name, nearest, visible
from graphkin.text.errors import Problem, RosterError

ABSENT = (
    "leave that row out; or put the student into the class list, run graphkin variants with"
    " --force into the same folder, and grade again"
)
FIELD, VALUE = ("field", "câmp", "mărime", "campo", "quantity"), ("value", "valoare", "valore")
"""The heads of a file that holds one student's answers line by line."""
LEAST, SHOWN = 1 / 3, 12
"""The share of the form below which a table may be another lab's; columns that are named then."""
HEADS = {"id": NAMES["id"], "email": EMAIL}
BESIDE = {what: NAMES[what] for what in NAMES if what != "id"} | {"language": LANGUAGE}
"""Columns that a class list has as well, and that are none of the form's."""
IDS = {folded(name) for name in ("id", *HEADS["id"])}
OTHERS = {folded(n) for w, every in (BESIDE | {"email": EMAIL}).items() for n in (w, *every)}
"""The same as they are compared."""


class Unread(Struct, frozen=True):
    """A cell that cannot be read: its file and row, whose it is, its field, what it says and why.

    ``problem`` is that of its answer; ``unit`` that of its field.
    """

    file: str
    row: int
    who: str
    field: str
    text: str
    problem: str
    unit: str = ""


class Stranger(Struct, frozen=True):
    """A column, or a row of one student's file, that is no field; ``near`` is the one meant."""

    file: str
    name: str
    near: str = ""


class Answers(Struct):
    """The answers of each student by id, the notes about cells, and columns that are no fields.

    ``senders`` is what a learning platform calls each, ``empty`` those who sent no table.
    """

    of: dict[str, dict[str, Answer]] = field(default_factory=dict)
    places: dict[str, str] = field(default_factory=dict)
    unread: list[Unread] = field(default_factory=list)
    strangers: list[Stranger] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    senders: dict[str, Sender] = field(default_factory=dict)
    empty: Sequence[Sender] = ()


def read_answers(path: Path, items: Sequence[Item], signs: Signs, match: Match = "") -> Answers:
    """The answers in a table, or in each file of a folder or a ZIP file.

    ``match`` is by what students are found in a table. Raises RosterError, all at once.
    """
    known = {item.field: item for item in items}
    heads = ["id", *HEADS["id"], *known, *FIELD, *VALUE]
    given = submissions(path)
    reading = AnswerReading(known, signs, TableProblems(path.name), match)
    for file in given.tables:
        try:
            told = reading.told if given.is_one else None
            sheet = sheet_in(file.data, file.name, heads, told)
        except RosterError as error:
            reading.told.extend(error.problems)
            continue
        reading.form(sheet, file) if is_form(sheet) else reading.rows(sheet, file)
    reading.told.stop()
    reading.answers.empty = given.empty
    refuse_other_lab(path.name, reading)
    reading.answers.missing = [name for name in known if name not in reading.seen]
    return reading.answers


def refuse_other_lab(name: str, reading: AnswerReading) -> None:
    """Raise RosterError where most that was handed in are no fields, and few are: another lab's."""
    others = list(dict.fromkeys(each.name for each in reading.answers.strangers))
    if len(reading.seen) >= LEAST * len(reading.known) or len(others) <= len(reading.seen):
        return
    fields, named = list(reading.known), ", ".join(others[:SHOWN])
    more = ", …" if len(others) > SHOWN else ""
    found = (
        f"only {len(reading.seen)} of the form's {len(fields)} fields are there, and no field of it"
        f" is called {named}{more}"
    )
    expected = f"fields such as {', '.join(fields[:4])}"
    raise RosterError(Problem(name, found, expected, "are these the answers to another lab?"))


def is_form(sheet: Spreadsheet) -> bool:
    """Whether a table holds one student's answers, a field in each row."""
    heads = [folded(cell) for cell in sheet.head]
    return len(heads) >= 2 and heads[0] in map(folded, FIELD) and heads[1] in map(folded, VALUE)


class AnswerReading(Struct, dict=True):
    """Tables being read: the fields that are ``known``, what students sign with, by which of it
    they are to be found, what was found, and which fields were ``seen``.
    """

    known: Mapping[str, Item]
    signs: Signs
    told: TableProblems
    match: Match = ""
    answers: Answers = field(default_factory=Answers)
    seen: set[str] = field(default_factory=set)

    @cached_property
    def fields(self) -> dict[str, str]:
        """The fields by their names as they are compared."""
        return {folded(name): name for name in self.known}

    def rows(self, sheet: Spreadsheet, file: HandedIn) -> None:
        """A table with a row for each student, or one row of the student whose file it is."""
        where = columns(sheet, HEADS | BESIDE)
        named = ((i, self.fields.get(folded(cell))) for i, cell in enumerate(sheet.head))
        own = {i: name for i, name in named if name is not None}
        meant = [what for what in HEADS if what in where and self.match in ("", what)]
        alone = self.by_file(file) if len(sheet.rows) == 1 else None
        if not meant and alone is None:
            head = ", ".join(f'"{visible(cell)}"' for cell in sheet.head[:12])
            wanted = self.match or "id"
            found = f"no column {wanted}; the head is {head}"
            self.told.add(sheet.name, found, f'a column named "{wanted}"')
            return
        if not own:
            expected = f"columns such as {', '.join(list(self.known)[:4])}"
            head = ", ".join(f'"{visible(cell)}"' for cell in sheet.head[:SHOWN])
            found = f"no column is a field of the form; the head is {head}"
            self.told.add(sheet.name, found, expected, "are these the answers to another lab?")
            return
        self.seen |= set(own.values())
        for i, cell in enumerate(sheet.head):
            if i not in own and cell and folded(cell) not in IDS | OTHERS:
                self.stranger(sheet, cell)
        for row in sheet.rows:
            column = where[meant[0]] if meant else None
            head, sign = ("", "") if column is None else (sheet.head[column], row.cells[column])
            who = self.signed(sheet, row, head or "id", sign or alone or "")
            if who is not None:
                if alone is not None and file.sender is not None:
                    self.answers.senders[who] = file.sender
                cells = {name: self.cell(sheet, row, i, who, name) for i, name in own.items()}
                self.answers.of[who] = cells

    def form(self, sheet: Spreadsheet, file: HandedIn) -> None:
        """One student's answers, a field in each row; the id is in a row of its own, or the name
        of the file, or the student's name is that under which a learning platform has the file.
        """
        stated = [row for row in sheet.rows if folded(row.cells[0]) in IDS]
        stated = [row for row in stated if row.cells[1]] or stated
        sign = stated[0].cells[1] if stated else ""
        sign = sign or self.by_file(file) or ("" if stated else file.stem)
        who = self.signed(sheet, stated[0] if stated else SheetRow(1, ()), "id", sign)
        if who is None:
            return
        if file.sender is not None:
            self.answers.senders[who] = file.sender
        self.answers.of[who] = {}
        for row in sheet.rows:
            name = self.fields.get(folded(row.cells[0]))
            if name is None:
                if folded(row.cells[0]) not in IDS | OTHERS:
                    self.stranger(sheet, row.cells[0])
                continue
            if name in self.answers.of[who]:
                self.told.add(sheet.place(row), f"{name} is answered twice", "once")
            self.seen.add(name)
            self.answers.of[who][name] = self.cell(sheet, row, 1, who, name)

    def by_file(self, file: HandedIn) -> str | None:
        """Whose a file is that does not tell: by its name, or as a learning platform names it."""
        if self.signs.who(file.stem) is not None:
            return file.stem
        return self.signs.named(file.sender.name) if file.sender is not None else None

    def signed(self, sheet: Spreadsheet, row: SheetRow, head: str, sign: str) -> str | None:
        """The student of the class who signs a row and has no answers yet; None, noted, if none."""
        place = sheet.place(row, head)
        who = self.signs.who(sign)
        if not sign:
            self.told.add(place, "is missing", "the student's id")
        elif who is None:
            found = f'"{visible(sign)}" is no student of this class'
            near = nearest(sign, sorted(self.signs.ids))
            self.told.add(place, found, "", near or ABSENT)
        elif who in self.answers.of:
            found = f'"{visible(sign)}" has answers already, in {self.answers.places[who]}'
            self.told.add(place, found, "one")
        else:
            self.answers.places[who] = str(sheet.place(row))
            return who
        return None

    def stranger(self, sheet: Spreadsheet, cell: str) -> None:
        """Note what is no field, with the field that may be meant."""
        near = near_name(cell, self.known)
        self.answers.strangers.append(Stranger(sheet.name, visible(cell), near))

    def cell(self, sheet: Spreadsheet, row: SheetRow, column: int, who: str, name: str) -> Answer:
        """One cell; one that cannot be read is noted."""
        item = self.known[name]
        answer = read_answer(row.cells[column], item)
        if answer.problem:
            why = (answer.text, answer.problem, item.unit)
            self.answers.unread.append(Unread(sheet.name, row.line, who, name, *why))
        return answer
