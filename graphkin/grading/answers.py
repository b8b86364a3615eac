"""Answer tables: one row for each student, or one file each, by the fields of the form.

A cell that cannot be read is no error of the table: it is told, and does not count as wrong.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from graphkin.errors import Problem
from graphkin.grading.model import Answer
from graphkin.grading.numbers import read_answer
from graphkin.lab.model import Item
from graphkin.roster.errors import RosterError
from graphkin.roster.read import NAMES
from graphkin.roster.tables import Row, Sheet, Told, columns, folded, read_sheet
from graphkin.scene.findings import nearest, visible

KINDS = (".csv", ".txt", ".tsv", ".xlsx")
"""Files of a folder that are read."""
FIELD, VALUE = ("field", "câmp", "mărime", "campo", "quantity"), ("value", "valoare", "valore")
"""The heads of a file that holds one student's answers line by line."""
HEADS = {"id": NAMES["id"]}


@dataclass
class Answers:
    """The answers of each student by id, the notes about cells, and columns that are no fields."""

    of: dict[str, dict[str, Answer]] = field(default_factory=dict)
    places: dict[str, str] = field(default_factory=dict)
    unread: list[Problem] = field(default_factory=list)
    strangers: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)


def read_answers(path: Path, items: Sequence[Item], ids: Iterable[str]) -> Answers:
    """The answers in a table, or in each file of a folder. Raises RosterError, all at once."""
    known = {item.field: item for item in items}
    heads = ["id", *HEADS["id"], *known, *FIELD, *VALUE]
    files = sorted(p for p in path.iterdir() if p.suffix.lower() in KINDS) if path.is_dir() else []
    if path.is_dir() and not files:
        found = "a folder without any table"
        raise RosterError(Problem(str(path), found, f"files {', '.join(KINDS)}"))
    answers = Answers()
    told = Told(path.name)
    seen: set[str] = set()
    for file in files or [path]:
        sheet = read_sheet(file, heads)
        if is_form(sheet):
            read_form(sheet, file.stem, known, set(ids), answers, told, seen)
        else:
            read_rows(sheet, known, set(ids), answers, told, seen)
    told.stop()
    answers.missing = [name for name in known if name not in seen]
    return answers


def is_form(sheet: Sheet) -> bool:
    """Whether a table holds one student's answers, a field in each row."""
    heads = [folded(cell) for cell in sheet.head]
    return len(heads) >= 2 and heads[0] in map(folded, FIELD) and heads[1] in map(folded, VALUE)


def read_rows(
    sheet: Sheet,
    known: Mapping[str, Item],
    ids: set[str],
    answers: Answers,
    told: Told,
    seen: set[str],
) -> None:
    """A table with a row for each student."""
    where = columns(sheet, HEADS)
    fields = {folded(name): name for name in known}
    own = {i: fields[folded(cell)] for i, cell in enumerate(sheet.head) if folded(cell) in fields}
    if "id" not in where:
        head = ", ".join(f'"{visible(cell)}"' for cell in sheet.head[:12])
        told.add(sheet.name, f"no column id; the head is {head}", 'a column named "id"')
        return
    if not own:
        expected = f"columns such as {', '.join(list(known)[:4])}"
        told.add(sheet.name, "no column is a field of the form", expected)
        return
    seen |= set(own.values())
    answers.strangers += [
        stranger(sheet, cell, known)
        for i, cell in enumerate(sheet.head)
        if i not in own and i != where["id"] and cell
    ]
    for row in sheet.rows:
        who = row.cells[where["id"]]
        if took(sheet, row, sheet.head[where["id"]], who, ids, answers, told):
            answers.of[who] = {
                name: read_cell(sheet.place(row, name), row.cells[i], known[name], answers)
                for i, name in own.items()
            }


def stranger(sheet: Sheet, cell: str, known: Mapping[str, Item]) -> str:
    """A column that is no field, with the field that may be meant."""
    near = nearest(cell, list(known))
    return f'{sheet.name}: column "{visible(cell)}" is no field of the form' + (
        f"; {near}" if near else ""
    )


def took(
    sheet: Sheet, row: Row, head: str, who: str, ids: set[str], answers: Answers, told: Told
) -> bool:
    """Whether a row is of a student of the class who has none yet; else it is noted."""
    place = sheet.place(row, head)
    if not who:
        told.add(place, "is missing", "the student's id")
    elif who not in ids:
        told.add(
            place, f'"{visible(who)}" is no student of this class', "", nearest(who, list(ids))
        )
    elif who in answers.of:
        told.add(place, f'"{visible(who)}" has answers already, in {answers.places[who]}', "one")
    else:
        answers.places[who] = sheet.place(row)
        return True
    return False


def read_form(
    sheet: Sheet,
    stem: str,
    known: Mapping[str, Item],
    ids: set[str],
    answers: Answers,
    told: Told,
    seen: set[str],
) -> None:
    """One student's answers, a field in each row; the id is in a row of its own, or the name."""
    fields = {folded(name): name for name in known}
    names = {folded(name) for name in ("id", *HEADS["id"])}
    stated = [row for row in sheet.rows if folded(row.cells[0]) in names]
    who = stated[0].cells[1] if stated else stem
    first = stated[0] if stated else Row(1, ())
    if not took(sheet, first, "id", who, ids, answers, told):
        return
    answers.of[who] = {}
    for row in sheet.rows:
        name = fields.get(folded(row.cells[0]))
        if name is None:
            if row not in stated:
                answers.strangers.append(stranger(sheet, row.cells[0], known))
            continue
        if name in answers.of[who]:
            told.add(sheet.place(row), f"{name} is answered twice", "once")
        seen.add(name)
        place = f"{sheet.name}, row {row.line}"
        answers.of[who][name] = read_cell(place, row.cells[1], known[name], answers)


def read_cell(place: str, text: str, item: Item, answers: Answers) -> Answer:
    """One cell; one that cannot be read is noted."""
    answer = read_answer(text, item)
    if answer.problem:
        answers.unread.append(Problem(place, answer.problem))
    return answer
