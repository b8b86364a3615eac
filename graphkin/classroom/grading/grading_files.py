"""The files that grading writes: marks, tolerances, feedback for students, the class report."""

from __future__ import annotations

import csv
import io
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from math import inf, isfinite, nan
from pathlib import Path
from typing import Any

import msgspec
from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.classroom.grading.answers import Sender, Unread, packed_feedback
from graphkin.classroom.grading.class_report import class_report
from graphkin.classroom.grading.feedback import DrawingBack, feedback_html, feedback_pages
from graphkin.classroom.grading.graded import (
    Decision,
    EarnedCause,
    Graded,
    Result,
    Status,
    Suspicion,
)
from graphkin.classroom.grading.standard import Expectation
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.edition import stems
from graphkin.scene.file_limits import whole_file
from graphkin.scene.model import Scene
from graphkin.text import Words
from graphkin.text.errors import NO_WORDS, PageError, Problem, Refusals, message
from graphkin.text.tables import csv_text
from graphkin.writers.pdf import write_pdf
from graphkin.writers.shared_lines import exact

# --- the marks of a class as the desk shows them: one file beside the report ----------------------


KEPT_MARKS = "desk.json"
FORMAT = 2
LEFT_OUT: Mapping[str, float] = {"expected": nan, "tolerance": inf}
"""The values of a mark that no number in a file represents."""


class KeptReport(Struct, frozen=True):
    """A marked class.

    ``readings`` is the folder of the drawings, relative to the report; empty where there is none.
    ``cells`` are those that wait, or that a person has read.

    In the file, each mark has the place of its item in the ``form``.
    """

    format: int
    form: tuple[Item, ...]
    graded: tuple[Graded, ...]
    wrong_variants: tuple[Suspicion, ...] = ()
    copies: tuple[Suspicion, ...] = ()
    cells: tuple[Unread, ...] = ()
    readings: str = ""


def kept_marks(
    found: Result, form: Sequence[Item], cells: Collection[Unread], readings: str
) -> bytes:
    """The file with the marks of a class."""
    places = {item.field: place for place, item in enumerate(form)}
    bare = tuple(replace(item, vector=None) for item in form)
    report = KeptReport(
        FORMAT, bare, (), found.wrong_variants, found.copies, tuple(cells), readings
    )
    students = [kept(each, places) for each in found.graded]
    return msgspec.json.encode(builtins(report) | {"graded": students}) + b"\n"


def kept(graded: Graded, places: Mapping[str, int]) -> msgspec.Raw:
    """A student with the places of the items, as it is in the file."""
    marks = []
    for mark in graded.marks:
        values = builtins(replace(mark, item=None)) | {"item": places[mark.item.field]}
        gone = [name for name in LEFT_OUT if not isfinite(values[name])]
        marks.append({name: value for name, value in values.items() if name not in gone})
    return msgspec.Raw(msgspec.json.encode(builtins(replace(graded, marks=())) | {"marks": marks}))


def builtins(record: Struct) -> dict[str, Any]:
    """A record as a dictionary, exact numbers and markup as text."""
    found: dict[str, Any] = msgspec.to_builtins(record, enc_hook=as_exact)
    return found


def as_exact(value: object) -> str:
    """A fraction or markup as text. Raises NotImplementedError for anything else."""
    if isinstance(value, Fraction | str):
        return str(value)
    raise NotImplementedError(type(value))


def restored(values: dict[str, Any]) -> KeptReport:
    """A report from the values of its file. Raises ValueError and LookupError for any other."""
    form = values["form"]
    for student in values["graded"]:
        student["marks"] = [
            LEFT_OUT | mark | {"item": form[mark["item"]]} for mark in student["marks"]
        ]
    return msgspec.convert(values, KeptReport, dec_hook=exact)


def read_kept_marks(report: Path) -> KeptReport | None:
    """The marks in a report's folder; None where there are none.

    Raises PageError for a file that another version wrote.
    """
    path = report / KEPT_MARKS
    if not path.is_file():
        return None
    try:
        values = msgspec.json.decode(whole_file(path))
        found = restored(values) if values["format"] == FORMAT else None
    except (msgspec.MsgspecError, ValueError, LookupError, TypeError):
        found = None
    if found is None:
        hint = message("mark the class again with graphkin grade --force")
        problem = Problem(str(path), message("cannot be read as marks"), NO_WORDS, hint)
        raise PageError(problem)
    return found


# --- tables of marks and tolerances ---------------------------------------------------------------


BEFORE = (
    *("row", "number", "id", "name", "group", "points", "of", "percent", "pending", "evidence"),
    *("decision", "causes", "deducted"),
)
WHY = " why"
FIRST = 5
"""The most changes shown on a terminal."""


def number(value: Fraction | float) -> str:
    """A number for a cell: a decimal point, and at most four decimals."""
    text = f"{float(value):.4f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def csv_bytes(lines: Iterable[Sequence[object]]) -> bytes:
    """Rows as CSV in UTF-8, with a byte order mark for spreadsheets."""
    return ("\ufeff" + csv_text(lines)).encode("utf-8")


def marks_table(result: Result) -> bytes:
    """A row for each student in the order of the class: the points of each field, and why.

    ``of`` and ``percent`` refer to the points that are decided; ``pending`` are those that wait.
    ``evidence`` names whose data the answers fit better, and who has the same values. ``causes``
    explain the sheet, and ``deducted`` is what they cost. ``decision``
    is the lecturer's on the whole form; those on fields follow the reasons.

    For a held student, points and percent are empty. The points of the fields stay, so that the
    lecturer can decide.
    """
    graded = result.graded
    fits: dict[str, list[str]] = defaultdict(list)
    for each in result.wrong_variants:
        fits[each.students[0]].append(f"fits {each.students[1]}")
    for each in result.copies:
        for who in each.students:
            fits[who] += [f"same as {other}" for other in each.students if other != who]
    fields = [mark.item.field for mark in graded[0].marks if mark.points] if graded else []
    head = [*BEFORE, *fields, *(f"{name}{WHY}" for name in fields)]
    return csv_bytes([head, *(marks_row(each, fields, fits) for each in graded)])


def marks_row(graded: Graded, fields: Sequence[str], fits: Mapping[str, list[str]]) -> list[str]:
    """One student's row; an answer that waits for a decision has no points."""
    student = graded.taker.student
    marks = {mark.item.field: mark for mark in graded.marks}
    share = None if graded.held else graded.share
    shown = {name for name in fields if graded.present or marks[name].decision is not None}
    return [
        str(student.row),
        "" if student.number is None else str(student.number),
        student.id,
        student.name,
        student.group,
        number(graded.earned) if graded.is_marked and not graded.held else "",
        number(graded.decided),
        f"{float(100 * share):.1f}" if share is not None else "",
        number(graded.pending) if graded.pending else "",
        "; ".join([*fits.get(student.id, ()), *(["held"] if graded.held else [])]),
        ruling(graded.decision) if graded.decision is not None else "",
        "; ".join(cause_text(cause) for cause in graded.causes),
        number(graded.cost) if graded.causes else "",
        *(
            number(marks[name].earned) if name in shown and not marks[name].waits else ""
            for name in fields
        ),
        *(reason(graded, name) if name in shown else "" for name in fields),
    ]


def cause_text(cause: EarnedCause) -> str:
    """A cause as text: its name, or two of which either may be meant, and whose data were drawn."""
    name = f"{cause.name} or {cause.either}" if cause.either else cause.name
    return f"{name} ({', '.join(cause.whose)})" if cause.whose else name


def ruling(decision: Decision) -> str:
    """The lecturer's decision as text: ``decided, was 0: …``, ``stands: …`` or ``asked: …``."""
    if decision.is_open:
        return f"asked: {decision.reason}"
    text = "stands"
    if decision.points is not None:
        before = "open" if decision.before is None else number(decision.before)
        text = f"decided, was {before}"
    text = f"{text}: {decision.reason}" if decision.reason else text
    return f"{text}; asked: {decision.asked}" if decision.asked else text


def reason(graded: Graded, name: str) -> str:
    """The result of a field as text: right, right from v_BA, follows v_BA_mm, cause rpm_as_rad."""
    mark = graded.mark(name)
    source = mark.source
    if mark.status is Status.RIGHT and source:
        source = f"from {source}"
    torn = "contradicts its sign" if mark.torn else ""
    alone = "without its value" if mark.alone else ""
    digits = f"too {mark.rounded} digits" if mark.rounded else ""
    parts = (mark.status.value, source, mark.cause, torn, alone, digits)
    found = " ".join(part for part in parts if part)
    return found if mark.decision is None else f"{found}; {ruling(mark.decision)}"


def tolerances_table(graded: Sequence[Graded], expected: Sequence[Expectation]) -> bytes:
    """For each student and field, the key, its tolerance and the parts of the tolerance."""
    head = ("id", "field", "unit", "key", "tolerance", "percent", "pencil", "ruler", "unsure")
    lines: list[Sequence[str]] = [head]
    for each, form in zip(graded, expected, strict=True):
        who = each.taker.student.id
        for name, allowed in form.tolerance.items():
            key, item = form.key[name], form.item[name]
            share = 100 * allowed.value / abs(key) if key and item.what != "place" else None
            amounts = (allowed.value, allowed.pencil, allowed.ruler)
            value, pencil, ruler = (f"{amount / item.one:.4g}" for amount in amounts)
            lines.append(
                (
                    who,
                    name,
                    item.unit,
                    f"{key / item.one:.6g}",
                    value,
                    "" if share is None else f"{share:.2f}",
                    pencil,
                    ruler,
                    "unsure" if allowed.unsure else "",
                )
            )
    return csv_bytes(lines)


def read_marks(data: bytes) -> dict[str, dict[str, str]]:
    """The cells of a marks.csv by student and column; empty for another file."""
    rows = list(csv.reader(io.StringIO(data.decode("utf-8-sig", "replace"), newline="")))
    if not rows or "id" not in rows[0]:
        return {}
    where = rows[0].index("id")
    return {
        row[where]: dict(zip(rows[0], row, strict=False)) for row in rows[1:] if len(row) > where
    }


def differences(before: bytes, after: bytes) -> list[tuple[str, str, str, str]]:
    """The changes of a new marking: student, column, before, after."""
    old, new = read_marks(before), read_marks(after)
    found: list[tuple[str, str, str, str]] = []
    for who in dict.fromkeys((*old, *new)):
        found += changed(who, old.get(who, {}), new.get(who, {}))
    return found


def changed(
    who: str, old: Mapping[str, str], new: Mapping[str, str]
) -> Iterable[tuple[str, str, str, str]]:
    """The changed cells of one student, except name, group and row."""
    for column in dict.fromkeys((*old, *new)):
        if column not in ("row", "name", "group") and old.get(column, "") != new.get(column, ""):
            yield who, column, old.get(column, ""), new.get(column, "")


def change_lines(table: bytes, words: Words) -> Iterable[str]:
    """The lines for a terminal: how many students and cells changed, and the first changes."""
    rows = list(csv.reader(io.StringIO(table.decode("utf-8-sig"), newline="")))[1:]
    if not rows:
        yield words("class.unchanged")
        return
    yield words("class.changes", count=len(rows), students=len({row[0] for row in rows}))
    for who, column, before, after in rows[:FIRST]:
        yield f"  {who}, {column}: {before or '–'} → {after or '–'}"
    if len(rows) > FIRST:
        yield f" {words('class.more', count=len(rows) - FIRST)}"


def differences_table(found: Iterable[tuple[str, str, str, str]]) -> bytes:
    lines: list[Any] = [("id", "column", "before", "after"), *found]
    return csv_bytes(lines)


# --- the files of a report ------------------------------------------------------------------------


MARKS, TOLERANCES, REPORT, CHANGES = (
    "marks.csv",
    "tolerances.csv",
    "class.html",
    "differences.csv",
)
STUDENTS = "students.csv"
"""The sums of students with several sheets."""
RETURNED = "feedback-moodle.zip"
"""The feedback file that Moodle takes back."""
FEEDBACK = "feedback"
"""The folder with a page for each student."""


class ReportSettings(Struct, frozen=True):
    """The settings of a report.

    ``words`` is the language of the report, and of students without a language of their own.
    ``titles`` are the lab's titles in other languages. ``scene`` says what the parameters mean.
    ``unread`` are cells that cannot be read, ``refused`` lines about what is not marked.
    ``refusals`` collects pages that cannot be made. ``drawings`` are those made on the task page,
    in green and red, by id.
    """

    title: str
    words: Words
    unread: Sequence[Unread] = ()
    titles: Mapping[str, str] = field(default_factory=dict)
    scene: Scene | None = None
    refused: Sequence[str] = ()
    refusals: Refusals = field(default_factory=Refusals)
    drawings: Mapping[str, DrawingBack] = field(default_factory=dict)

    def words_for(self, graded: Graded) -> Words:
        """The words of a student's own language."""
        own = graded.taker.spoken
        return self.words.in_language(own) if own else self.words

    def title_in(self, language: str) -> str:
        """The lab's title in a language."""
        return self.titles.get(language, self.title)


def report_files(
    found: Result, lab: Lab, settings: ReportSettings, formats: Sequence[str], before: bytes = b""
) -> dict[str, bytes]:
    """The files of a report by name; with an earlier marks.csv, also the differences."""
    graded = found.graded
    marks = marks_table(found)
    files = {
        MARKS: marks,
        TOLERANCES: tolerances_table(graded, found.expected),
        REPORT: class_report(
            found, settings.title, settings.unread, settings.words, settings.refused
        ).encode(),
    }
    if any(each.taker.student.owner for each in graded):
        files[STUDENTS] = students_table(found)
    if before:
        files[CHANGES] = differences_table(differences(before, marks))
    return files | feedback_files(graded, lab, settings, formats)


def feedback_files(
    graded: Sequence[Graded], lab: Lab, settings: ReportSettings, formats: Sequence[str]
) -> dict[str, bytes]:
    """A page for each student, named by the id as far as it is plain letters."""
    students = [each.taker.student.id for each in graded]
    names = stems(students, [each.taker.code for each in graded])
    files: dict[str, bytes] = {}
    for each, name in zip(graded, names, strict=True):
        spoken = settings.words_for(each)
        title = settings.title_in(spoken.language)
        with settings.refusals.alone(each.taker.student.called):
            drawing = settings.drawings.get(each.taker.student.id)
            if "html" in formats:
                text = feedback_html(each, title, lab.rubric, spoken, settings.scene, drawing)
                files[f"{FEEDBACK}/{name}.html"] = text.encode("utf-8")
            if "pdf" in formats:
                pages = feedback_pages(each, title, lab.rubric, spoken, settings.scene, drawing)
                files[f"{FEEDBACK}/{name}.pdf"] = write_pdf(pages, title=pages[0].title)
    return files


def gradebook_name(path: Path) -> str:
    """The file name of a filled gradebook."""
    return f"gradebook-{path.name}"


def returned(
    files: Mapping[str, bytes],
    graded: Sequence[Graded],
    senders: Mapping[str, Sender],
    formats: Sequence[str],
) -> dict[str, bytes]:
    """Moodle's ZIP file of feedback; empty where the answers did not come from Moodle."""
    kind = next((kind for kind in ("pdf", "html") if kind in formats), "")
    backs = {who: sender.back for who, sender in senders.items() if sender.back}
    if not kind or not backs:
        return {}
    students = [each.taker.student.id for each in graded]
    names = stems(students, [each.taker.code for each in graded])
    paths = {w: f"{FEEDBACK}/{name}.{kind}" for w, name in zip(students, names, strict=True)}
    pages = {who: files[path] for who, path in paths.items() if path in files}
    return {RETURNED: packed_feedback(backs, pages, kind)}


def of_one_student(found: Result) -> dict[str, list[Graded]]:
    """The marked sheets of each student of the class list: one, or one for each position."""
    sheets: dict[str, list[Graded]] = {}
    for each in found.graded:
        sheets.setdefault(each.taker.student.whose, []).append(each)
    return sheets


def students_table(found: Result) -> bytes:
    """A row for each student of the class list: the points of all sheets, and of each."""
    every = of_one_student(found)
    most = max(map(len, every.values()), default=0)
    head = ["id", "name", "group", "points", "of", "pending"]
    rows: list[Sequence[str]] = [[*head, *(f"sheet {i}" for i in range(1, most + 1))]]
    for who, sheets in every.items():
        student, known = sheets[0].taker.student, [each for each in sheets if is_known(each)]
        pending = sum((each.pending for each in sheets), Fraction())
        rows.append(
            [
                who,
                student.name,
                student.group,
                number(sum((each.earned for each in known), Fraction())) if known else "",
                number(sum((each.points for each in sheets), Fraction())),
                number(pending) if pending else "",
                *(number(each.earned) if is_known(each) else "" for each in sheets),
            ]
        )
    return csv_bytes(rows)


def is_known(graded: Graded) -> bool:
    """Whether a sheet has a mark, with nothing pending or held."""
    return graded.is_marked and not graded.pending and not graded.held


def points_by_id(found: Result, scale: Fraction | None = None) -> dict[str, Fraction]:
    """The points for a gradebook, of students with nothing pending or held.

    The points of a student with several sheets are added; a sheet that was not handed in has none.
    With a ``scale``, points are the earned share of all points, times the scale.
    """
    points: dict[str, Fraction] = {}
    for who, sheets in of_one_student(found).items():
        some = [each for each in sheets if each.is_marked]
        full = sum((each.points for each in sheets), Fraction())
        if some and all(map(is_known, some)) and (scale is None or full):
            earned = sum((each.earned for each in some), Fraction())
            points[who] = earned if scale is None else earned * scale / full
    return points
