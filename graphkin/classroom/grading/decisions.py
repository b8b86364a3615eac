"""The lecturer's decisions on marks: a table in the report's folder, never overwritten."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from pathlib import Path

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answers import FIELD
from graphkin.classroom.grading.graded import Decision, EarnedMark, Graded
from graphkin.classroom.lab.items import asked_of, worth
from graphkin.classroom.lab.lab_model import Item, Rubric
from graphkin.classroom.roster.read_roster import NAMES
from graphkin.classroom.roster.spreadsheets import (
    SheetRow,
    Spreadsheet,
    TableProblems,
    columns,
    folded,
    read_sheet,
)
from graphkin.classroom.roster.students import Signs, Taker
from graphkin.scene.findings import nearest, shown
from graphkin.text.errors import NO_WORDS, InTable, Problem, SceneError, message

DECISIONS = "decisions.csv"
"""The file of a report folder that holds the decisions."""
EMPTY = b"\xef\xbb\xbfid;field;points;reason\r\n"
"""The file without decisions."""
HEADS: Mapping[str, Sequence[str]] = {
    "id": NAMES["id"],
    "field": FIELD,
    "points": ("puncte", "punctaj", "punti", "punteggio", "punkte", "puntos", "баллы"),
    "reason": ("why", "motiv", "motivul", "motivo", "grund", "begründung", "motif", "причина"),
}
"""The accepted names of its columns."""
WHOLE = ("total", "totale", "gesamt", "всего")
"""The field names that mean the whole form."""
ASKED = "?"
"""The points of a request that is not decided yet."""
AMOUNT = re.compile(r"[0-9]{1,6}(?:[.,][0-9]{1,6})?", re.ASCII)
LONGEST = 400
"""The most characters of a reason."""


class Deciding(Struct, frozen=True):
    """The students and the form that decisions refer to."""

    takers: Sequence[Taker]
    form: Sequence[Item]
    rubric: Rubric
    signs: Signs

    def worth_of(self, taker: Taker) -> Mapping[str, Fraction]:
        """The points of each field of a student's form that is worth any."""
        items, _ = asked_of(self.form, self.rubric.points, taker.compute)
        found = {i.field: worth(i, self.rubric.points, taker.compute) for i in items}
        return {field: points for field, points in found.items() if points}


def read_decisions(report: Path, on: Deciding) -> tuple[Decision, ...]:
    """The decisions in a report's folder; none where there is no file.

    Raises RosterError with every problem, row by row.
    """
    path = report / DECISIONS
    if not path.is_file():
        return ()
    table_problems = TableProblems(DECISIONS)
    sheet = read_sheet(
        path, [name for w, every in HEADS.items() for name in (w, *every)], table_problems
    )
    where = columns(sheet, HEADS)
    missing = [what for what in HEADS if what not in where]
    if missing:
        found = message("no column {missing}", missing=", ".join(missing))
        table_problems.add(DECISIONS, found, message("the head id;field;points;reason"))
        table_problems.stop()
    read = [decision(sheet, row, where, on, table_problems) for row in sheet.rows]
    seen: dict[tuple[str, str], int] = {}
    for row, each in zip(sheet.rows, read, strict=True):
        first = seen.setdefault((each.who, each.field), row.line) if each else row.line
        if each and first != row.line:
            found = message(
                "{who}, {value} is decided in row {first} already",
                who=each.who,
                value=each.field or "total",
                first=first,
            )
            table_problems.add(sheet.place(row), found, message("one row for each"))
    table_problems.stop()
    return tuple(each for each in read if each is not None)


def decision(
    sheet: Spreadsheet,
    row: SheetRow,
    where: Mapping[str, int],
    on: Deciding,
    table_problems: TableProblems,
) -> Decision | None:
    """The decision in one row; None, with its problems noted, where the row is wrong."""
    cells = {what: row.cells[column] for what, column in where.items()}
    places = {what: sheet.place(row, sheet.head[column]) for what, column in where.items()}
    before = len(table_problems.problems)
    who = on.signs.who(cells["id"])
    taker = next((each for each in on.takers if each.student.id == who), None)
    if taker is None:
        found = (
            message("{cells} is no student of this class", cells=shown(cells["id"]))
            if cells["id"]
            else message("is missing")
        )
        table_problems.add(
            places["id"],
            found,
            message("an id of the class list"),
            nearest(cells["id"], on.signs.ids),
        )
    worths = on.worth_of(taker) if taker is not None else {}
    field, most = field_in(cells, places["field"], worths, table_problems, taker is not None)
    points = points_in(cells["points"], places["points"], most, table_problems)
    if not cells["reason"] or len(cells["reason"]) > LONGEST:
        found = (
            message("{count} characters", count=len(cells["reason"]))
            if cells["reason"]
            else message("is missing")
        )
        table_problems.add(
            places["reason"],
            found,
            message("a reason of at most {most} characters", most=LONGEST),
        )
    if len(table_problems.problems) > before or taker is None:
        return None
    is_open = cells["points"] == ASKED
    return Decision(taker.student.id, field, points, cells["reason"], is_open)


def field_in(
    cells: Mapping[str, str],
    place: InTable,
    worths: Mapping[str, Fraction],
    table_problems: TableProblems,
    known: bool,
) -> tuple[str, Fraction | None]:
    """The field of a row, empty for the whole form, and the most points it can earn."""
    text = cells["field"]
    if folded(text) in WHOLE or (not text and not AMOUNT.fullmatch(cells["points"])):
        return "", sum(worths.values(), Fraction()) if known else None
    names = {folded(name): name for name in worths}
    field = names.get(folded(text), "")
    if known and not field:
        found = (
            message("{text} is no field of this student's form", text=shown(text))
            if text
            else message("is missing")
        )
        expected = message(
            '"total", or a field such as {worths}', worths=", ".join(list(worths)[:3])
        )
        table_problems.add(place, found, expected, nearest(text, worths) if text else NO_WORDS)
    return field, worths.get(field)


def points_in(
    text: str, place: InTable, most: Fraction | None, table_problems: TableProblems
) -> Fraction | None:
    """The points of a row; None where the mark stays."""
    if text in ("", "-", ASKED):
        return None
    points = Fraction(text.replace(",", ".")) if AMOUNT.fullmatch(text) else None
    if points is None or (most is not None and points > most):
        limit = (
            message("0 to {most:g}", most=float(most)) if most is not None else message("points")
        )
        expected = message(
            '{limit}; nothing where the mark stays, "?" while that is open', limit=limit
        )
        table_problems.add(place, shown(text), expected)
    return points


def settled(decisions: Iterable[Decision]) -> set[str]:
    """The ids of students with a decision, whose marks are no longer held."""
    return {each.who for each in decisions if not each.is_open}


def by_student(decisions: Iterable[Decision]) -> Mapping[str, Sequence[Decision]]:
    """The decisions of each student, by id."""
    found: dict[str, list[Decision]] = defaultdict(list)
    for each in decisions:
        found[each.who].append(each)
    return found


def with_decisions(graded: Graded, decisions: Sequence[Decision]) -> Graded:
    """A student's marks with the decisions applied: fields first, then the whole form."""
    if not decisions:
        return graded
    own = {each.field: each for each in decisions}
    marks = tuple(ruled(mark, own.get(mark.item.field)) for mark in graded.marks)
    found = replace(graded, marks=marks)
    whole = own.get("")
    if whole is None:
        return found
    return replace(found, decision=replace(whole, before=found.earned if graded.present else None))


def ruled(mark: EarnedMark, decision: Decision | None) -> EarnedMark:
    """A mark with its decision applied, if there is one."""
    if decision is None:
        return mark
    earned = mark.earned if decision.points is None else decision.points
    before = None if mark.waits else mark.earned
    return replace(mark, earned=earned, decision=replace(decision, before=before))


# --- released marks: kept in the report's folder until they are held again ------------------------


RELEASED = "released.json"
"""The file of a report folder that keeps the ids."""
MOST = 1 << 20
"""The most bytes of it that are read."""


class Releases(Struct, frozen=True):
    """The ids of students whose marks are released, in the order of the class.

    ``earlier`` says that a previous run kept a list.
    """

    ids: tuple[str, ...] = ()
    earlier: bool = False

    def files(self) -> dict[str, bytes]:
        """The file that keeps the ids; none where marks were never released."""
        if not self.ids and not self.earlier:
            return {}
        return {RELEASED: (json.dumps(self.ids, ensure_ascii=False) + "\n").encode("utf-8")}


def releases(
    report: Path, students: Sequence[str], released: Collection[str], held: Collection[str]
) -> Releases:
    """The students released before and now, without those who are held again.

    Raises SceneError for a file that holds no list of ids.
    """
    path = report / RELEASED
    earlier = path.is_file()
    every = {*(kept(path) if earlier else ()), *released}.difference(held)
    return Releases(tuple(who for who in students if who in every), earlier)


def kept(path: Path) -> list[str]:
    """The ids in a file. Raises SceneError where it holds no list of ids."""
    try:
        with path.open("rb") as file:
            return msgspec.json.decode(file.read(MOST), type=list[str])
    except (OSError, msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        hint = message("remove it, and release again whom you decide to")
        problem = Problem(
            str(path), message("is no list of ids"), message('["0042", "0057"]'), hint
        )
        raise SceneError(problem) from None
