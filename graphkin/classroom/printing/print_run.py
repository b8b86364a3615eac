"""Print a class folder: keep finished files, make the others, move them into place, record them.

The finished parts: a line for each part of a student's sheets, with the hashes of its files.

A line is written before its files are moved into place, so that files found there are known to be
from this program. A part is finished if all its files exist with exactly these hashes.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial
from hashlib import file_digest, sha256
from math import ceil
from pathlib import Path
from threading import Lock

import msgspec
from msgspec import Struct, field
from msgspec.structs import replace

from graphkin import __version__
from graphkin.classroom.form_page import form, quantity_of, why
from graphkin.classroom.lab.items import asked_of, items
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.edition import Edition, in_the_way, inside, stems
from graphkin.classroom.printing.personal import (
    Owner,
    crossed,
    joined,
    lost,
    owned,
    owned_pages,
    owner,
    signed,
    with_owner,
)
from graphkin.classroom.printing.workers import ENDED, chunks, engine, results
from graphkin.classroom.roster.students import Student, Taker, unknown_lines
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import parameters
from graphkin.documents import MOTION_VIEWS
from graphkin.documents.calculation import calculation
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet import title_of
from graphkin.documents.sheet_documents import (
    SheetDocument,
    drawings_of,
    drawn_sheets,
    language_of,
    proved,
    with_forces,
)
from graphkin.drawing.field import paper_of, text_page
from graphkin.drawing.marks import Page
from graphkin.drawing.style import Ink
from graphkin.drawing.symbol_markup import escape
from graphkin.mechanism import Mechanism
from graphkin.scene.file_limits import whole_file
from graphkin.scene.read_scene import read_text
from graphkin.text import Words
from graphkin.text.errors import PageError, Problem, message, problems_of
from graphkin.writers.commit import held, put_in_place, reason_of, replacing
from graphkin.writers.pdf import PdfPart, join

ALONE = Lock()
"""Held while PDF files are made: the threads of a process share their fonts (Dask uses threads)."""
FORM = "form"
"""The kind of the A4 pages that go with a task."""


class PrintOrder(Struct, frozen=True):
    """What the sheets of a class share: the lab, the text of its scene, the ink.

    ``language`` is for students who have none of their own.
    """

    lab: Lab
    scene: str
    language: str
    ink: Ink


class StudentSheets(Struct, frozen=True):
    """The sheets to make for a student: pairs (view, format), and the stem of their files."""

    taker: Taker
    stem: str
    parts: tuple[tuple[str, str], ...]


class Made(Struct, frozen=True):
    """The result for a student: the files of each part by name, or the problems."""

    code: str
    files: Mapping[tuple[str, str], Mapping[str, bytes]]
    problems: tuple[Problem, ...] = ()


def make(order: PrintOrder, wanted: Sequence[StudentSheets]) -> list[Made]:
    """The files of some students; the problems of one student do not stop the others."""
    with ALONE:
        return [made(order, one) for one in wanted]


def made(order: PrintOrder, wanted: StudentSheets) -> Made:
    """The files of one student."""
    try:
        sheets = Sheets(order, wanted.taker)
        files = {
            part: dict(files_of(sheets, wanted.stem, *part, order.ink)) for part in wanted.parts
        }
    except Exception as error:
        return Made(wanted.taker.code, {}, problems_of(error))
    return Made(wanted.taker.code, files)


class Sheets:
    """A student's pages of every view, drawn on demand from one construction.

    Raises as handout does: for a mechanism that does not close or is not proved, and for a page
    that does not fit.
    """

    def __init__(self, order: PrintOrder, taker: Taker) -> None:
        self.lab, self.taker = order.lab, taker
        scene = read_text(
            order.scene, order.lab.name, settings=dict(taker.settings), house=order.lab.house
        )
        self.mechanism = Mechanism(scene).measured
        stated = self.mechanism.scene.sheet
        self.paper = paper_of(stated.paper, stated.frame)
        self.whose: Owner = owner(taker, self.paper)
        self.words: Words = language_of(self.mechanism, taker.spoken or order.language)
        verdict = proved(self.mechanism, sheet_motion(self.mechanism))
        drawings = drawings_of(self.mechanism, verdict, self.words)
        self.drawings = with_forces(self.mechanism, drawings)
        self.made: dict[str, list[SheetDocument]] = {}

    def of(self, view: str) -> list[SheetDocument]:
        """The sheets of a view: drawings, then A4 pages if the view has some."""
        if view not in self.made:
            self.made[view] = list(self.draw(view))
        return self.made[view]

    def draw(self, view: str) -> Iterator[SheetDocument]:
        """Draw the sheets of a view, each page with its student's name and code."""
        if view in MOTION_VIEWS:
            from graphkin.documents.motion_sheets import motion_sheets

            spoken = self.mechanism.spoken(self.words.language)
            scene = with_owner(spoken.scene, self.whose)
            for part in motion_sheets(Mechanism(scene), view, self.words):
                yield SheetDocument(*part)
            return
        yield from self.drawn(view)
        if view in ("task", "key"):
            pages = calculation(owned_pages(self.drawings, self.whose), view, self.computed)
            pages = tuple(signed(pages, view, self.whose, self.paper.leaf))
            kind = FORM if view == "task" else "calculation"
            yield SheetDocument(kind, (*pages, *self.answers()) if view == "task" else pages)

    def drawn(self, view: str) -> Iterator[SheetDocument]:
        """Draw only the drawings of a view."""
        own = [replace(owned(each, self.whose), computed=self.computed) for each in self.drawings]
        for sheet in drawn_sheets(own, view):
            pages = [*signed(sheet.pages, view, self.whose, self.paper.leaf)]
            if view == "task":
                count = self.paper.leaves
                pages[:count] = (crossed(page, self.paper.leaf) for page in pages[:count])
            yield SheetDocument(sheet.kind, tuple(pages))

    @cached_property
    def leaves(self) -> list[tuple[Page, ...]]:
        """The pages of each sheet to draw on: one, or two leaves."""
        return [sheet.pages[: self.paper.leaves] for sheet in self.drawn("task")]

    @cached_property
    def task_pages(self) -> dict[str, Page]:
        """The pages to draw on, by kind; both leaves of a sheet as one page."""
        kinds = (drawing.kind for drawing in self.drawings)
        return {kind: joined(pages) for kind, pages in zip(kinds, self.leaves, strict=True)}

    def page(self, view: str, stem: str, ink: Ink) -> str:
        """The page for a browser: the task with its form, the key step by step, or the motion."""
        from graphkin.classroom import form_page
        from graphkin.web.paper_page import paper_page
        from graphkin.web.step_page import step_page, task_page
        from graphkin.web.your_turn import TurnOwner

        taker, lab, language = self.taker, self.lab, self.words.language
        student = taker.student
        if view in MOTION_VIEWS:
            return paper_page([page for each in self.of(view) for page in each.pages], ink)
        if view != "task":
            return step_page(self.mechanism, language, ink, TurnOwner(stem, student.id, taker.code))
        name = ", ".join(part for part in (student.name, student.group) if part)
        whose = form_page.Identity(stem, f"{lab.name} {taker.code}", student.id, name)
        fields, points = self.asked()
        pivot = form_page.first_pivot(self.mechanism)
        form_arguments = (fields, points, taker.compute, self.words, whose, pivot)
        answers = form_page.form_fragment(*form_arguments, says_right=lab.rubric.says_right)
        return task_page(self.mechanism, language, ink, answers)

    def answers(self) -> tuple[Page, ...]:
        """The form for answers."""
        first: Drawing = self.drawings[0]
        settings = parameters(first.scene, self.words)
        title, name = (
            self.words.clauses([escape(title_of(first)), *settings]),
            self.words("form.title"),
        )
        fields, points = self.asked()
        whose, pivot = (self.whose.name, self.whose.code), next(iter(first.scene.frame.points), "")
        school = self.lab.house.header
        compute = self.taker.compute
        said = fields, points, compute, self.words, (title, name), whose, pivot, school
        return form(*said, text_page(first.paper.name))

    def asked(self) -> tuple[tuple[Item, ...], dict[str, Fraction]]:
        """The fields of the student's form, and the points of each."""
        form = items(self.mechanism, self.lab)
        return asked_of(form, self.lab.rubric.points, self.taker.compute)

    @cached_property
    def computed(self) -> dict[str, str]:
        """Why some quantities are computed instead of measured, by their symbols."""
        if not self.taker.compute:
            return {}
        fields = items(self.mechanism, self.lab)
        compute = self.taker.compute
        return {quantity_of(i): why(i, self.words) for i in fields if i.field in compute}


def files_of(
    sheets: Sheets, stem: str, view: str, kind: str, ink: Ink
) -> Iterator[tuple[str, bytes]]:
    """The files of a view in a format: a PDF of its drawings and one of its form, SVG, or HTML."""
    if kind == "html":
        yield f"{view}/{stem}-{view}.html", sheets.page(view, stem, ink).encode("utf-8")
        return
    title = f"{sheets.whose.code}, {view}"
    if kind == "pdf":
        from graphkin.writers.pdf import write_pdf

        found = sheets.of(view)
        pages = [page for sheet in found if sheet.kind != FORM for page in sheet.pages]
        yield f"{view}/{stem}-{view}.pdf", write_pdf(pages, ink, title=title)
        for sheet in found:
            if sheet.kind == FORM:
                data = write_pdf(sheet.pages, ink, title=f"{sheets.whose.code}, {FORM}")
                yield f"{view}/{stem}-{FORM}.pdf", data
        return
    from graphkin.writers.svg import write_svg

    for sheet in sheets.of(view):
        for number, page in enumerate(sheet.pages, 1):
            tail = f"-{number:02d}" if view == "steps" or number > 1 else ""
            name = f"{view}/{stem}-{view}-{sheet.kind}{tail}.svg"
            yield name, write_svg(page, ink).encode("utf-8")


JOURNAL = ".journal.jsonl"
LARGEST = 512 << 20
"""The largest journal, in bytes."""


class Entry(Struct, frozen=True):
    """A printed part: its name, a hash of everything that decides it, and the hashes of its files.

    ``settings`` are what goes into the first hash, by name, so that messages can say what differs.
    """

    part: str
    key: str
    files: Mapping[str, str]
    settings: Mapping[str, str] = field(default_factory=dict)

    def line(self) -> bytes:
        """The entry as a line of JSON."""
        entry = {"part": self.part, "key": self.key, "files": dict(self.files)}
        entry |= {"settings": dict(self.settings)} if self.settings else {}
        return json.dumps(entry, ensure_ascii=True).encode() + b"\n"


class Journal:
    """The journal of a folder: read whole, then extended line by line."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / JOURNAL
        self.entries: dict[str, Entry] = {}
        data = whole_file(self.path, LARGEST) if self.path.exists() else b""
        whole = data[: data.rfind(b"\n") + 1]
        if whole != data:  # the last write was interrupted
            with self.path.open("r+b") as stream:
                stream.truncate(len(whole))
        for line in whole.splitlines():
            entry = entry_of(line)
            if entry is not None:
                self.entries[entry.part] = entry

    def finished(self, part: str, key: str) -> bool:
        """Whether a part is finished with this key: all its files exist, byte for byte."""
        entry = self.entries.get(part)
        if entry is None or entry.key != key:
            return False
        return all(hash_of(self.folder / name) == found for name, found in entry.files.items())

    def otherwise(self, part: str, key: str) -> list[str]:
        """The existing files of a part that were made with other settings."""
        entry = self.entries.get(part)
        if entry is None or entry.key == key:
            return []
        return [name for name in entry.files if (self.folder / name).exists()]

    def ours(self, part: str, key: str) -> frozenset[str]:
        """The files recorded for a part with this key."""
        entry = self.entries.get(part)
        return frozenset(entry.files) if entry is not None and entry.key == key else frozenset()

    def write(self, entries: Sequence[Entry]) -> None:
        """Add lines; if the disk is full, leave no partial line."""
        start = self.path.stat().st_size if self.path.exists() else 0
        try:
            with self.path.open("ab") as stream:
                stream.write(b"".join(entry.line() for entry in entries))
        except OSError:
            if self.path.exists():
                os.truncate(self.path, start)
            raise
        self.entries |= {entry.part: entry for entry in entries}

    def settle(self, order: Iterable[str]) -> None:
        """Rewrite the journal with each part once, in the given order, then the other parts."""
        parts = dict.fromkeys(part for part in order if part in self.entries)
        parts |= dict.fromkeys(sorted(self.entries.keys() - parts))
        data = b"".join(self.entries[part].line() for part in parts)
        if not self.path.exists() or self.path.read_bytes() != data:
            put_in_place(self.folder, {self.path: data})


def entry_of(line: bytes) -> Entry | None:
    """The entry of a line; None for an invalid line, which is ignored."""
    try:
        return msgspec.json.decode(line, type=Entry)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        return None


def hash_of(path: Path) -> str:
    """The SHA-256 of a file; empty if it cannot be read."""
    try:
        with path.open("rb") as stream:
            return file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def key_of(*parts: object) -> str:
    """A hash of everything that decides the bytes of a part."""
    return sha256(json.dumps(parts, ensure_ascii=True, sort_keys=True).encode()).hexdigest()[:32]


FOLDER = "print"
"""The folder of the printed files, in the class folder."""
FEWEST = 4
"""The fewest students that justify a process of their own."""


UNLIKE = {
    "language": "printed in {stood}, now in {now} (--lang)",
    "ink": "printed with --ink {stood}, now {now}",
    "graphkin": "printed by graphkin {stood}, now {now}",
    "lab": "printed from another text of the lab",
    "student": "printed with other data, or another name or group",
}
"""The message for each setting that differs from the one used for existing files."""


class PrintRequest(Struct, frozen=True):
    """What to print of every student, and how."""

    views: tuple[str, ...] = ("task", "key")
    formats: tuple[str, ...] = ("pdf",)
    language: str | None = None
    ink: Ink = "colour"
    force: bool = False


class Means(Struct, frozen=True):
    """Where the work runs: in ``jobs`` processes (1: only this one), or on a cluster."""

    jobs: int = 1
    cluster: str = ""


class Outcome(Struct):
    """The result of a run: students, those printed now and those already finished, files, warnings.

    ``files`` are the merged files to print. ``refused`` are the students without files, with the
    problems. ``lost`` are the students whose names have signs that the font lacks. ``strange`` are
    lines on languages that no page has.
    """

    folder: Path
    students: int
    made: int = 0
    stood: int = 0
    files: list[Path] = field(default_factory=list)
    refused: list[tuple[Taker, tuple[Problem, ...]]] = field(default_factory=list)
    left: str = ""
    lost: list[Student] = field(default_factory=list)
    strange: list[str] = field(default_factory=list)


Tell = Callable[[int, int], None]
"""Called with the number of students finished, and the number of students in all."""


def print_class(edition: Edition, wishes: PrintRequest, means: Means, tell: Tell) -> Outcome:
    """Print a class into its folder; the same edition and wishes give the same bytes again.

    Raises PageError if another run holds the folder, or if files are in the way or cannot be
    written. Finished files are kept, and the next run continues from there.
    """
    folder = edition.folder / FOLDER
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with held(folder) as left:
            run = PrintRun(edition, wishes, Journal(folder))
            run.outcome.left = left
            run.refuse_others()
            run.make_all(means, tell)
            for view in wishes.views if "pdf" in wishes.formats else ():
                run.merge(view)
            run.journal.settle(run.keys)
            return run.outcome
    except OSError as error:
        raise stopped(folder, error) from error


def stopped(folder: Path, error: OSError) -> PageError:
    """The error of a run that could not write: a full disk, or a folder without permission."""
    found = message("cannot be written: {error}", error=reason_of(error))
    hint = message("finished files are kept: correct this, then run the same command to continue")
    return PageError.at(str(error.filename or folder), found, hint=hint)


class PrintRun:
    """One run over a class: its order, the name of each part, and the result."""

    def __init__(self, edition: Edition, wishes: PrintRequest, journal: Journal) -> None:
        self.edition, self.wishes, self.journal = edition, wishes, journal
        language = edition.words(wishes.language).language
        self.order = PrintOrder(edition.lab, edition.scene, language, wishes.ink)
        takers = edition.takers
        names = stems([one.student.id for one in takers], [one.code for one in takers])
        self.stems = dict(zip((one.code for one in takers), names, strict=True))
        self.keys, self.settings = dict[str, str](), dict[str, Mapping[str, str]]()
        self.note_parts()
        self.outcome = Outcome(journal.folder, len(takers))
        students = [one.student for one in takers]
        self.outcome.lost = [one for one in students if lost(one.name) or lost(one.group)]
        named = ((one.student.called, one.language) for one in takers)
        self.outcome.strange = list(unknown_lines(named))

    def note_parts(self) -> None:
        """Record the settings of each part, and a hash of everything that decides its bytes."""
        order = self.order
        stated = (order.scene.encode(), order.lab.text.encode(), *order.lab.house.files.values())
        texts = [sha256(data).hexdigest() for data in stated]
        for one in self.edition.takers:
            language = one.spoken or order.language
            shared = (__version__, order.lab.name, language, order.ink)
            who = one.student
            own = (who.name, who.group, who.id, one.code, dict(one.settings), one.compute)
            made = {"language": language, "ink": order.ink, "graphkin": __version__}
            made |= {"lab": key_of(order.lab.name, texts), "student": key_of(own)}
            for view, kind in self.parts():
                part = part_of(one.code, view, kind)
                self.keys[part] = key_of(shared, texts, own, self.stems[one.code], view, kind)
                self.settings[part] = made

    def parts(self) -> list[tuple[str, str]]:
        """The requested pairs of view and format, which every student gets."""
        return [(view, kind) for view in self.wishes.views for kind in self.wishes.formats]

    def refuse_others(self) -> None:
        """Raise PageError if files with other settings would be replaced without force."""
        if self.wishes.force:
            return
        ways = {part: self.journal.otherwise(part, key) for part, key in self.keys.items()}
        names = [name for way in ways.values() for name in way]
        if names:
            differences = [line for part, way in ways.items() if way for line in self.unlike(part)]
            raise PageError(
                in_the_way(self.journal.folder, names, list(dict.fromkeys(differences)))
            )

    def unlike(self, part: str) -> Iterator[str]:
        """The settings of an existing part that differ from the current ones."""
        stood, now = self.journal.entries[part].settings, self.settings[part]
        for name, said in UNLIKE.items():
            if name in stood and stood[name] != now[name]:
                yield said.format(stood=stood[name], now=now[name])

    def wanted(self) -> list[StudentSheets]:
        """The parts that are not finished, student by student."""
        found = []
        for one in self.edition.takers:
            missing = tuple(
                (view, kind)
                for view, kind in self.parts()
                if not self.journal.finished(part := part_of(one.code, view, kind), self.keys[part])
            )
            if missing:
                found.append(StudentSheets(one, self.stems[one.code], missing))
        return found

    def make_all(self, means: Means, tell: Tell) -> None:
        """Make the missing parts; each chunk is moved into place when it arrives."""
        wanted = self.wanted()
        total = self.outcome.students
        self.outcome.stood = done = total - len(wanted)
        tell(done, total)
        if not wanted:
            return
        students = {one.taker.code: one.taker for one in wanted}
        jobs = min(means.jobs, ceil(len(wanted) / FEWEST))
        with engine(jobs, means.cluster) as (executor, workers):
            work = partial(make, self.order)
            for found in results(executor, workers, work, chunks(wanted, workers), lost_sheets):
                self.put(found)
                for one in found:
                    if one.problems:
                        self.outcome.refused.append((students[one.code], one.problems))
                done += len(found)
                tell(done, total)
        places = {one.code: i for i, one in enumerate(self.edition.takers)}
        self.outcome.refused.sort(key=lambda refused: places[refused[0].code])
        self.outcome.made = len(wanted) - len(self.outcome.refused)

    def put(self, found: Sequence[Made]) -> None:
        """Record the files that arrived, then move them into place, all of them or none."""
        entries: list[Entry] = []
        targets: dict[Path, bytes] = {}
        for one in found:
            for (view, kind), files in one.files.items():
                part = part_of(one.code, view, kind)
                targets |= self.targets(part, files)
                hashes = {name: sha256(data).hexdigest() for name, data in files.items()}
                entries.append(Entry(part, self.keys[part], hashes, self.settings[part]))
        self.journal.write(entries)
        put_in_place(self.journal.folder, targets)

    def targets(self, part: str, files: Mapping[str, bytes]) -> dict[Path, bytes]:
        """The target paths of a part's files, without files that already exist with the same bytes.

        Raises PageError for existing files of another origin, unless they may be replaced.
        """
        folder = self.journal.folder
        ours = self.journal.ours(part, self.keys[part])
        paths = {name: inside(folder, name) for name in files}
        others = {
            name: files[name]
            for name, path in paths.items()
            if hash_of(path) != sha256(files[name]).hexdigest()
        }
        wrong = [name for name in others if name not in ours and os.path.lexists(paths[name])]
        if wrong and not self.wishes.force:
            raise PageError(in_the_way(folder, wrong))
        return {paths[name]: data for name, data in others.items()}

    def merge(self, view: str) -> None:
        """Write the merged file of a view to print, with a bookmark for each student.

        Nothing is written if the file is already finished or nobody has pages. Raises PageError if
        another file is in its way.
        """
        members = self.printed(view)
        if not members:
            return
        journal, language = self.journal, self.order.language
        name, title = f"class-{view}.pdf", f"{self.order.lab.name}, {view}"
        entries = {n: found for e in journal.entries.values() for n, found in e.files.items()}
        hashes = [[entries[name] for name in names] for _, names in members]
        marks = [bookmark(taker) for taker, _ in members]
        key = key_of(title, language, marks, hashes)
        path = inside(journal.folder, name)
        self.outcome.files.append(path)
        if journal.finished(name, key):
            return
        if os.path.lexists(path) and name not in journal.entries and not self.wishes.force:
            raise PageError(in_the_way(journal.folder, [name]))
        with replacing(journal.folder, path) as stream:
            join(parts(journal.folder, members), stream, title, language)
            stream.flush()
            journal.write([Entry(name, key, {name: hash_of(Path(stream.name))})])

    def printed(self, view: str) -> list[tuple[Taker, list[str]]]:
        """The finished PDF files of a view, student by student in the order of the roster."""
        refused = {taker.code for taker, _ in self.outcome.refused}
        return [
            (one, list(self.journal.entries[part_of(one.code, view, "pdf")].files))
            for one in self.edition.takers
            if one.code not in refused
        ]


def lost_sheets(wanted: StudentSheets) -> list[Made]:
    """The result for a student whose worker process ends."""
    hint = message("--jobs 1 needs the least")
    return [Made(wanted.taker.code, {}, (Problem("print", ENDED, hint=hint),))]


def part_of(code: str, view: str, kind: str) -> str:
    """The name of a part in the journal."""
    return f"{code} {view} {kind}"


Members = Sequence[tuple[Taker, Sequence[str]]]
"""Students in order, each with the names of the PDF files to include."""


def parts(folder: Path, members: Members) -> Iterator[PdfPart]:
    """The files of the students one after another, with a bookmark where each student begins."""
    for taker, names in members:
        for number, name in enumerate(names):
            yield PdfPart(folder / name, "" if number else bookmark(taker))


def bookmark(taker: Taker) -> str:
    """The bookmark of a student: name, or id, and group."""
    student = taker.student
    return f"{student.title}, {student.group}" if student.group else student.title
