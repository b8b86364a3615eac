"""What was decided at the desk about a class's answers: lines of a file in the report's folder.

One line holds what was decided at once, for one field or for a whole cluster of like answers.

What students object to: a table in the report's folder, one row for each appeal.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.answers import FIELD
from graphkin.classroom.grading.decisions import Deciding
from graphkin.classroom.grading.graded import HANDWRITTEN, Answer, Decision
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.read_roster import NAMES
from graphkin.classroom.roster.spreadsheets import RowProblems, columns, folded, read_sheet
from graphkin.classroom.roster.students import Signs
from graphkin.scene.findings import nearest, shown
from graphkin.text.errors import NO_WORDS, Problem, message
from graphkin.writers.shared_lines import Said, SharedLine, SharedLines

APPEALS = "appeals.csv"
"""The file of a report folder that holds the appeals."""
HEADS: Mapping[str, Sequence[str]] = {
    "id": NAMES["id"],
    "field": FIELD,
    "text": (
        *("appeal", "contestație", "contestaţie", "ricorso", "testo", "einspruch", "einwand"),
        *("réclamation", "texte", "reclamación", "texto", "апелляция", "текст"),
    ),
}
"""The accepted names of its columns."""
WHOLE = ("", "total", "totale", "gesamt", "всего")
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


RULINGS = "decisions.jsonl"
"""The file of a report folder that holds the desk's decisions."""
Place = tuple[str, str]
"""A student's id and a field; no field for the whole form."""


class Ruling(Struct, frozen=True, omit_defaults=True, tag_field="does"):
    """A decision about one student's field, or about the whole form."""

    who: str
    field: str = ""

    @property
    def place(self) -> Place:
        """Whom and what it is about."""
        return self.who, self.field


class SetPoints(Ruling, frozen=True, tag="points"):
    """What a field earns; ``reason`` is for the student, ``asked`` is the appeal it answers."""

    points: Fraction = Fraction()
    reason: str = ""
    asked: str = ""


class LeaveMark(Ruling, frozen=True, tag="stays"):
    """The mark stays."""

    reason: str = ""
    asked: str = ""


class ReadAs(Ruling, frozen=True, tag="reads"):
    """The cell in which ``written`` is found is read as ``text``, and marked."""

    written: str = ""
    text: str = ""


class Remark(Ruling, frozen=True, tag="remarks"):
    """A remark for the student; an empty one takes back an earlier remark."""

    text: str = ""


AnyRuling = SetPoints | LeaveMark | ReadAs | Remark


class DeskAct(SharedLine, frozen=True):
    """What a marker decided at once."""

    rulings: tuple[AnyRuling, ...] = ()


class DeskRulings(SharedLines[DeskAct]):
    """The desk's decisions in a report's folder."""

    def __init__(self, report: Path) -> None:
        super().__init__(report / RULINGS, DeskAct, targets_of)

    def about(self, kind: type[Ruling], place: Place) -> tuple[Said[DeskAct], ...]:
        """What counts of one kind about a place: none, one, or those that disagree."""
        return self.decided.get((family(kind), *place), ())


def family(kind: type[Ruling]) -> type[Ruling]:
    """The kind under which rival decisions are found: points, and that the mark stays, are one."""
    return SetPoints if kind is LeaveMark else kind


def targets_of(line: DeskAct) -> Iterator[tuple[object, object]]:
    """What a line decides, each with what it says."""
    for each in line.rulings:
        yield (family(type(each)), *each.place), each


class DeskDecided(Struct):
    """What the desk decided about a class.

    ``strangers`` are decisions about students or fields that the class does not have, or about more
    points than a field has. ``rivals`` are decisions on which people disagree: they do not count.
    """

    decisions: list[Decision] = field(default_factory=list)
    readings: dict[Place, ReadAs] = field(default_factory=dict)
    remarks: dict[Place, str] = field(default_factory=dict)
    strangers: list[Ruling] = field(default_factory=list)
    rivals: list[tuple[Said[DeskAct], ...]] = field(default_factory=list)


def desk_decided(report: Path, on: Deciding) -> DeskDecided:
    """What the desk decided in a report's folder; nothing where there is no file."""
    found = DeskDecided()
    worths = {taker.student.id: on.worth_of(taker) for taker in on.takers}
    for rulings in DeskRulings(report).decided.values():
        ruling = rulings[-1].what
        points = worths.get(ruling.who)
        most = None
        if points is not None:
            most = points.get(ruling.field) if ruling.field else sum(points.values(), Fraction())
        if most is None or (isinstance(ruling, SetPoints) and not 0 <= ruling.points <= most):
            found.strangers.append(ruling)
        elif len(rulings) > 1:
            found.rivals.append(rulings)
        elif isinstance(ruling, ReadAs):
            found.readings[ruling.place] = ruling
        elif isinstance(ruling, Remark):
            if ruling.text:
                found.remarks[ruling.place] = ruling.text
        else:
            earned = ruling.points if isinstance(ruling, SetPoints) else None
            decision = Decision(ruling.who, ruling.field, earned, ruling.reason, at_desk=True)
            found.decisions.append(replace(decision, answers=ruling.asked))
    return found


def all_decisions(
    table: Sequence[Decision], desk: Sequence[Decision], appeals: Iterable[Appeal]
) -> tuple[Decision, ...]:
    """The decisions of the table, then those of the desk elsewhere, and what students asked.

    The table answers every appeal on its fields; the desk answers one by its text.
    """
    found: dict[Place, Decision] = {(each.who, each.field): each for each in desk}
    found |= {(each.who, each.field): each for each in table}
    for appeal in appeals:
        known = found.get(appeal.place)
        if known is None:
            found[appeal.place] = Decision(*appeal.place, None, appeal.text, is_open=True)
        elif known.at_desk and known.answers != appeal.text:
            found[appeal.place] = replace(known, asked=appeal.text, answers="")
        elif not known.is_open:
            found[appeal.place] = replace(known, answers=appeal.text)
    return tuple(found.values())


def read_as(
    answers: Mapping[str, Mapping[str, Answer]],
    readings: Mapping[Place, ReadAs],
    form: Sequence[Item],
) -> dict[str, dict[str, Answer]]:
    """The answers, with the cells that a person has read; a cell that was changed since is left."""
    items = {item.field: item for item in form}
    found = {who: dict(own) for who, own in answers.items()}
    for (who, name), reading in readings.items():
        own = found.get(who, {})
        cell = own.get(name)
        if cell is not None and cell.text == reading.written:
            read = replace(read_answer(reading.text, items[name]), grouped=None)
            typed = cell.problem == HANDWRITTEN
            own[name] = replace(read, written="" if typed else reading.written, typed=typed)
    return found
