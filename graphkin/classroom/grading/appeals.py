"""What students object to: a table in the report's folder, one row for each appeal."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from graphkin.classroom.roster.read_roster import NAMES
from graphkin.classroom.roster.spreadsheets import RowProblems, columns, folded, read_sheet
from graphkin.classroom.roster.student_signs import Signs
from graphkin.scene.findings import nearest, shown
from graphkin.text.errors import NO_WORDS, Problem, message

APPEALS = "appeals.csv"
"""The file of a report folder that holds the appeals."""
HEADS: Mapping[str, Sequence[str]] = {
    "id": NAMES["id"],
    "field": ("câmp", "mărime", "campo", "quantity"),
    "text": ("appeal", "contestație", "contestaţie", "ricorso", "testo"),
}
"""The accepted names of its columns."""
WHOLE = ("", "total", "totale")
"""The fields of an appeal about the whole form."""
LONGEST = 1000
"""The most characters of an appeal."""


class Appeal(Struct, frozen=True):
    """What a student objects to in a field, or in the whole form (no field)."""

    who: str
    field: str
    text: str

    @property
    def place(self) -> tuple[str, str]:
        """The student and the field."""
        return self.who, self.field


class ReadAppeals(Struct, frozen=True):
    """The appeals of a table, and the problems of rows that are left out."""

    every: tuple[Appeal, ...] = ()
    problems: tuple[Problem, ...] = ()


def read_appeals(report: Path, signs: Signs, fields: Mapping[str, Collection[str]]) -> ReadAppeals:
    """The appeals in a report's folder; none where there is no file.

    ``fields`` are those of each student's form, by id. A row that cannot be understood is left out
    with its problem. If a student objects to a field twice, both texts are one appeal. Raises
    RosterError for a file that is no table.
    """
    path = report / APPEALS
    if not path.is_file():
        return ReadAppeals()
    problems = RowProblems(APPEALS)
    sheet = read_sheet(path, [name for w, every in HEADS.items() for name in (w, *every)], problems)
    where = columns(sheet, HEADS)
    if missing := [what for what in HEADS if what not in where]:
        found = message("no column {missing}", missing=", ".join(missing))
        problems.add(APPEALS, found, message("the head id;field;text"))
        return ReadAppeals(problems=tuple(problems.every))
    texts: dict[tuple[str, str], list[str]] = {}
    for row in sheet.rows:
        cells = {what: row.cells[column] for what, column in where.items()}
        places = {what: sheet.place(row, sheet.head[column]) for what, column in where.items()}
        who = signs.who(cells["id"])
        own = {folded(name): name for name in fields.get(who or "", ())}
        named = folded(cells["field"])
        if who is None:
            missing_id = message("{cells} is no student of this class", cells=shown(cells["id"]))
            hint = nearest(cells["id"], signs.ids)
            problems.add(places["id"], missing_id, message("an id of the class list"), hint)
        elif named not in (*own, *WHOLE):
            unknown = message(
                "{text} is no field of this student's form", text=shown(cells["field"])
            )
            hint = nearest(cells["field"], own.values()) if own else NO_WORDS
            problems.add(places["field"], unknown, message('a field, or "total"'), hint)
        elif not 0 < len(cells["text"]) <= LONGEST:
            count = message("{count} characters", count=len(cells["text"]))
            problems.add(places["text"], count, message("1 to {most}", most=LONGEST))
        else:
            place = who, own.get(named, "")
            texts.setdefault(place, []).append(cells["text"])
    every = tuple(Appeal(*place, "; ".join(dict.fromkeys(own))) for place, own in texts.items())
    return ReadAppeals(every, tuple(problems.every))
