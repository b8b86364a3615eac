"""Answer tables: one row for each student, or one file each, by the fields of the form.

A cell that cannot be read is no error of the table: it is reported, and does not count as wrong.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from itertools import groupby
from operator import itemgetter
from pathlib import Path, PurePosixPath

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer, with_unit
from graphkin.classroom.grading.graded import THOUSANDS, WAITING, Answer
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.read_roster import LONGEST_ID, NAMES
from graphkin.classroom.roster.spreadsheets import (
    LARGEST,
    RowProblems,
    SheetRow,
    Spreadsheet,
    TableProblems,
    bytes_of,
    columns,
    folded,
    place_of,
    row_of,
    sheet_in,
)
from graphkin.classroom.roster.students import EMAIL, Match, Signs
from graphkin.classroom.roster.students import HEADS as LANGUAGE
from graphkin.scene.file_limits import file_bytes
from graphkin.scene.findings import near_name, nearest, visible
from graphkin.text.errors import (
    NO_WORDS,
    Hint,
    InTable,
    Problem,
    RosterError,
    joined,
    message,
    problems_of,
    verbatim,
)

KINDS = (".csv", ".txt", ".tsv", ".xlsx")
PACKED = ".zip"
MOST_BYTES, MOST_FILES = 512 << 20, 100_000
"""The most bytes of a ZIP file, and the most files in it."""
MOST_OWN = 50
"""The most tables of one student. Together they may be no larger than one table."""
MOODLE = re.compile(r"(?P<name>[^_]+)_(?P<number>\d+)_assignsubmission_[a-z]+(?:_(?P<file>.*))?")
CANVAS = re.compile(r"(?P<name>[^_]+)_(?:LATE_)?(?P<number>\d+)_\d+_(?P<file>.+)")
DATE = (1980, 1, 1, 0, 0, 0)
"""A fixed time for files in our ZIP files, so that the same marks give the same bytes."""


class Sender(Struct, frozen=True):
    """The student to whom a learning platform assigns a file.

    ``name`` is the full name on the platform. ``back`` is the path prefix of a feedback file for
    this student, empty where the platform takes none.
    """

    name: str
    back: str = ""


class HandedIn(Struct, frozen=True):
    """A table that was handed in: its path among the submissions, its size, and its sender.

    ``read`` returns its bytes, and raises RosterError where they cannot be read.
    """

    name: str
    size: int
    read: Callable[[], bytes]
    sender: Sender | None = None

    @property
    def stem(self) -> str:
        """The file name without folder and suffix, which may be an id."""
        return PurePosixPath(self.name).stem


class Submissions(Struct, frozen=True):
    """Everything that was handed in.

    ``empty`` are senders without a table. ``others`` are the names of other files without a sender,
    which are not read. ``is_one`` says that the path is a single table.
    """

    tables: tuple[HandedIn, ...]
    empty: tuple[Sender, ...] = ()
    others: tuple[str, ...] = ()
    is_one: bool = False


def submissions(path: Path) -> Submissions:
    """The submissions at a path: a table, a folder with everything below it, or a ZIP file.

    Raises RosterError where there is no table.
    """
    if path.is_dir():
        found = list(in_folder(path))
    elif path.suffix.lower() == PACKED:
        found = in_zip(path)
    else:
        data = bytes_of(path)
        return Submissions((HandedIn(path.name, len(data), lambda: data),), is_one=True)
    tables = tuple(each for each in found if is_table(PurePosixPath(each.name)))
    if not tables:
        folder = path.is_dir()
        raise RosterError.at(
            str(path),
            message("a folder without any table" if folder else "a ZIP file without any table"),
            message("files {kinds}", kinds=", ".join(KINDS)),
        )
    senders_with_table = {each.sender.name for each in tables if each.sender is not None}
    every = [each.sender for each in found if each.sender is not None]
    empty = {each.name: each for each in every if each.name not in senders_with_table}
    others = [each for each in found if each.sender is None and each not in tables]
    names = (PurePosixPath(each.name) for each in others)
    left = tuple(str(name) for name in names if not is_beside(name))
    return Submissions(tables, tuple(empty.values()), left)


def is_hidden(path: PurePosixPath) -> bool:
    """Whether the file is hidden or left by an operating system or an editor."""
    return any(part.startswith((".", "~", "__MACOSX")) for part in path.parts)


def is_table(path: PurePosixPath) -> bool:
    """Whether the file is a table to read."""
    return path.suffix.lower() in KINDS and not is_hidden(path)


def is_beside(path: PurePosixPath) -> bool:
    """Whether a file that is no table goes unmentioned: a hidden file or a score sheet."""
    return is_hidden(path) or path.suffix.lower() == ".json"


def in_folder(folder: Path) -> Iterator[HandedIn]:
    """The files below a folder, by their paths in it."""
    for path in sorted(p for p in folder.rglob("*") if p.is_file() or p.is_symlink()):
        name = path.relative_to(folder).as_posix()
        size = path.lstat().st_size
        yield HandedIn(name, size, partial(own_bytes, path, name), sender(name))


def own_bytes(path: Path, name: str) -> bytes:
    """The bytes of a file. Raises RosterError for a symbolic link."""
    if path.is_symlink():
        found, hint = message("is a link to another place"), message("put the file itself there")
        raise RosterError.at(name, found, message("a file of its own"), hint)
    return bytes_of(path)


def in_zip(path: Path) -> list[HandedIn]:
    """The files of a ZIP file by their paths in it; nothing is unpacked to disk.

    Raises RosterError where it is no ZIP file, or holds too much.
    """
    expected = message(
        "at most {most_files} files, {most_bytes} MiB",
        most_files=MOST_FILES,
        most_bytes=MOST_BYTES >> 20,
    )
    try:
        data = file_bytes(path, MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise RosterError.at(path.name, message("is too large"), expected)
        packed = zipfile.ZipFile(io.BytesIO(data))  # in memory: nothing is left open
        parts = [part for part in packed.infolist() if not part.is_dir()]
    except OSError as error:
        reason = error.strerror or message("cannot be opened")
        raise RosterError.at(
            str(path), message("cannot be read: {reason}", reason=reason)
        ) from None
    except (zipfile.BadZipFile, ValueError, RuntimeError, NotImplementedError, EOFError) as error:
        hint = message("download it again, or unpack it and name the folder")
        raise RosterError.at(
            path.name, message("cannot be read as a ZIP file"), NO_WORDS, hint
        ) from error
    if len(parts) > MOST_FILES:
        raise RosterError.at(path.name, message("holds {count} files", count=len(parts)), expected)
    found = [
        HandedIn(
            part.filename, part.file_size, partial(unpacked, packed, part), sender(part.filename)
        )
        for part in parts
    ]
    return sorted(found, key=lambda each: each.name)


def unpacked(packed: zipfile.ZipFile, part: zipfile.ZipInfo) -> bytes:
    """The bytes of a file in a ZIP file. Raises RosterError where it cannot be unpacked."""
    if part.file_size > LARGEST:
        raise RosterError.at(
            part.filename,
            message("is too large"),
            message("at most {most} MiB", most=LARGEST >> 20),
        )
    try:
        return packed.read(part)
    except Exception as error:
        hint = message("is it encrypted or damaged? unpack it, or ask for it again")
        found = message("cannot be unpacked from the ZIP file")
        raise RosterError.at(part.filename, found, NO_WORDS, hint) from error


def sender(name: str) -> Sender | None:
    """The sender in a file's path, as a learning platform writes it; None where there is none."""
    parts = PurePosixPath(name).parts
    for i, part in enumerate(parts):
        found = MOODLE.fullmatch(part)
        if found:
            is_file = i == len(parts) - 1
            back = part[: found.start("file")] if is_file and found["file"] else f"{part}/"
            return Sender(found["name"], back)
    found = CANVAS.fullmatch(parts[-1])
    return Sender(found["name"]) if found else None


def packed_feedback(backs: Mapping[str, str], pages: Mapping[str, bytes], kind: str) -> bytes:
    """Moodle's ZIP file of feedback: a page of that kind for each student in ``backs``.

    ``backs`` are the path prefixes and ``pages`` the files, both by id.
    """
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as packed:
        known = sorted((backs[who], who) for who in pages if who in backs)
        for back, sheets in groupby(known, key=itemgetter(0)):
            for part, (_, who) in enumerate(sheets, 1):
                tail = f"-{part}" if part > 1 else ""
                name = f"{back}feedback{tail}.{kind}"
                packed.writestr(zipfile.ZipInfo(name, DATE), pages[who])
    return data.getvalue()


# --- answer tables --------------------------------------------------------------------------------


ABSENT = message(
    "leave that row out; or put the student into the class list, run graphkin variants "
    "with --force into the same folder, and grade again"
)
FIELD = (
    *("field", "câmp", "mărime", "campo", "quantity", "feld", "größe", "champ", "grandeur"),
    *("magnitud", "поле", "величина"),
)
VALUE = ("value", "valoare", "valore", "wert", "valeur", "valor", "значение")
"""Column heads of a file that holds one student's answers, a field in each row."""
MOST_FIELDS = 1000
"""The most rows of a file that holds one student's answers, a field in each row."""
MOST_NEAR = 100
"""The most unknown ids for which a similar known id is looked up."""
LEAST, SHOWN = 1 / 3, 12
"""The least share of the form's fields that a table of this lab has.

Below it, a table may belong to another lab; the error then names up to ``SHOWN`` columns.
"""
HEADS = {"id": NAMES["id"], "email": EMAIL}
BESIDE = {what: NAMES[what] for what in NAMES if what != "id"} | {"language": LANGUAGE}
"""Columns that a class list has too, and that are no fields of the form."""
DRAWING = "drawing"
"""The row or column with the moves that a student made on the board of the task page."""
IDS = {folded(name) for name in ("id", *HEADS["id"])}
OTHERS = {folded(n) for w, every in (BESIDE | {"email": EMAIL}).items() for n in (w, *every)}
"""The names of these columns, folded for comparison."""


class Unread(Struct, frozen=True):
    """A cell that cannot be read: its file and row, its student, its field and its text.

    ``problem`` is that of its :class:`Answer`; ``unit`` is that of its field. ``cut_out`` is the
    picture of a handwritten cell, a file among the readings.
    """

    file: str
    row: int
    who: str
    field: str
    text: str
    problem: str
    unit: str = ""
    cut_out: str = ""


class Stranger(Struct, frozen=True):
    """A column, or a row of one student's file, that is no field; ``near`` is a similar field."""

    file: str
    name: str
    near: str = ""


class Refused(Struct, frozen=True):
    """A submission that is not marked: why, and the ids of the students it may belong to."""

    problem: Problem
    whose: tuple[str, ...] = ()


class Claim(Struct, frozen=True):
    """The answers of a student at one place in the submissions.

    ``is_sure`` says that a learning platform confirms the student.
    """

    who: str
    sign: str
    place: InTable
    cells: Mapping[str, Answer]
    unread: Sequence[Unread] = ()
    sender: Sender | None = None
    is_sure: bool = False
    drawing: str = ""


class Answers(Struct):
    """The answers of each student by id, notes on cells, and columns that are no fields.

    ``unread`` are cells that cannot be read, or that can be read in two ways. ``refused`` is what
    is not marked. ``withheld`` are the students who wait for that: each of their answers is
    unreadable.

    ``drawings`` are the logs of drawings made on the page, by id.

    ``senders`` maps ids to senders on a learning platform. ``empty`` are senders without a table.
    ``unlisted`` are students known only by the id in their file, since the class list lacks the
    sender's name. ``others`` are files that are no tables.
    """

    of: dict[str, dict[str, Answer]] = field(default_factory=dict)
    unread: list[Unread] = field(default_factory=list)
    strangers: list[Stranger] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    refused: list[Refused] = field(default_factory=list)
    withheld: list[str] = field(default_factory=list)
    drawings: dict[str, str] = field(default_factory=dict)
    senders: dict[str, Sender] = field(default_factory=dict)
    empty: Sequence[Sender] = ()
    unlisted: dict[str, Sender] = field(default_factory=dict)
    others: Sequence[str] = ()

    def withhold(self, who: str, fields: Iterable[str]) -> None:
        """Replace all answers of a student by waiting ones."""
        self.withheld.append(who)
        self.of[who] = dict.fromkeys(fields, WAITING)


def read_answers(path: Path, items: Sequence[Item], signs: Signs, match: Match = "") -> Answers:
    """The answers in a table, or in each file of a folder or a ZIP file.

    ``match`` names the column by which students are found in a table. A file or row that cannot be
    read does not hold up other students. Raises RosterError, with every problem, where no answers
    can be read.
    """
    known = {item.field: item for item in items}
    given = submissions(path)
    reading = AnswerReading(known, signs, match, given.is_one)
    for file in within_budget(given.tables, reading):
        reading.file(file)
    answers = reading.settled()
    answers.empty, answers.others = given.empty, given.others
    if answers.refused and len(answers.withheld) == len(answers.of):
        raise RosterError(merged(path.name, answers.refused))
    refuse_other_lab(path.name, reading)
    answers.missing = [name for name in known if name not in reading.seen]
    return answers


def within_budget(tables: Sequence[HandedIn], reading: AnswerReading) -> Iterator[HandedIn]:
    """The tables, except those of senders who handed in too many or too much.

    The tables of these senders are refused.
    """
    own: dict[Sender, list[HandedIn]] = defaultdict(list)
    for file in tables:
        if file.sender is not None:
            own[file.sender].append(file)
    most = message(
        "at most {most_own} tables, {largest} MiB together",
        most_own=MOST_OWN,
        largest=LARGEST >> 20,
    )
    for sender, files in own.items():
        size = sum(file.size for file in files)
        if len(files) > MOST_OWN or size > LARGEST:
            found = message(
                "hands in {count} tables, {size:.1f} MiB", count=len(files), size=size / (1 << 20)
            )
            reading.refuse(files[0], Problem(sender.name, found, most))
            own[sender] = []
    for file in tables:
        if file.sender is None or own[file.sender]:
            yield file


def merged(name: str, refused: Iterable[Refused]) -> list[Problem]:
    """The problems of everything that is not marked; similar problems share a line."""
    problems = RowProblems(name)
    problems.extend(each.problem for each in refused)
    return problems.merged


def refuse_other_lab(name: str, reading: AnswerReading) -> None:
    """Raise RosterError where few columns are fields and more are not: another lab's table."""
    others = list(dict.fromkeys(each.name for each in reading.answers.strangers))
    if len(reading.seen) >= LEAST * len(reading.known) or len(others) <= len(reading.seen):
        return
    fields = list(reading.known)
    named = joined(", ", (*others[:SHOWN], *(["…"] if len(others) > SHOWN else [])))
    found = message(
        "only {count} of the form's {fields} fields are there, and no field of it is "
        "called {names}",
        count=len(reading.seen),
        fields=len(fields),
        names=named,
    )
    expected = message("fields such as {fields}", fields=", ".join(fields[:4]))
    raise RosterError.at(name, found, expected, message("are these the answers to another lab?"))


def is_form(sheet: Spreadsheet) -> bool:
    """Whether a table holds one student's answers, a field in each row."""
    heads = [folded(cell) for cell in sheet.head]
    return len(heads) >= 2 and heads[0] in map(folded, FIELD) and heads[1] in map(folded, VALUE)


class AnswerReading(Struct, dict=True):
    """The state of reading tables.

    ``known`` are the fields of the form, ``signs`` identify students, and ``match`` names the
    column to use. ``is_one`` says that there is one table only. ``seen`` are the fields found so
    far.
    """

    known: Mapping[str, Item]
    signs: Signs
    match: Match = ""
    is_one: bool = False
    answers: Answers = field(default_factory=Answers)
    claims: dict[str, list[Claim]] = field(default_factory=dict)
    seen: set[str] = field(default_factory=set)

    @cached_property
    def fields(self) -> dict[str, str]:
        """The fields by their names, folded for comparison."""
        return {folded(name): name for name in self.known}

    def file(self, file: HandedIn) -> None:
        """Read one table; its problems are noted and affect no other student."""
        heads = ["id", *HEADS["id"], *self.known, *FIELD, *VALUE]
        table_problems = RowProblems(file.name)
        try:
            sheet = sheet_in(file.read(), file.name, heads, table_problems)
            if is_form(sheet):
                self.form(sheet, file, table_problems)
            else:
                self.rows(sheet, file, table_problems)
        except Exception as error:
            self.refuse(file, *(in_file(each, file.name) for each in problems_of(error)))

    def rows(self, sheet: Spreadsheet, file: HandedIn, table_problems: TableProblems) -> None:
        """Read a table with a row for each student, or with one row of the file's owner."""
        where = columns(sheet, HEADS | BESIDE)
        named = ((i, self.fields.get(folded(name_of(cell)))) for i, cell in enumerate(sheet.head))
        own = {i: name for i, name in named if name is not None}
        meant = [what for what in HEADS if what in where and self.match in ("", what)]
        alone = len(sheet.rows) + len(sheet.left_out) == 1
        if not meant and not (alone and self.owners(file)):
            head = ", ".join(f'"{visible(cell)}"' for cell in sheet.head[:12])
            wanted = self.match or "id"
            found = message("no column {wanted}; the head is {head}", wanted=wanted, head=head)
            raise RosterError.at(
                sheet.name, found, message('a column named "{wanted}"', wanted=wanted)
            )
        if not own:
            expected = message("columns such as {known}", known=", ".join(list(self.known)[:4]))
            head = ", ".join(f'"{visible(cell)}"' for cell in sheet.head[:SHOWN])
            found = message("no column is a field of the form; the head is {head}", head=head)
            hint = message("are these the answers to another lab?")
            raise RosterError.at(sheet.name, found, expected, hint)
        column = where[meant[0]] if meant else None
        drawn = next(
            (i for i, cell in enumerate(sheet.head) if folded(cell) == folded(DRAWING)), None
        )
        every = (*sheet.rows, *sheet.left_out)
        used = {visible(sheet.head[i]) for i in (*own, column) if i is not None}
        wrong = wrong_rows(table_problems, used)
        lines = {row.broken or row.line for row in every}
        if whole := [each for line, some in wrong.items() if line not in lines for each in some]:
            raise RosterError(whole)
        for i, cell in enumerate(sheet.head):
            if i not in (*own, drawn) and cell and folded(cell) not in IDS | OTHERS:
                self.stranger(sheet, cell)
        for row in every:
            head, sign = ("", "") if column is None else (sheet.head[column], cell_at(row, column))
            if problems := wrong[row.broken or row.line]:
                self.refuse(file, *problems, who=self.signs.who(sign))
                continue
            place = sheet.place(row, head or "id")
            who = self.signed(place, sign, file, alone)
            if who is not None:
                unread: list[Unread] = []
                cells = {n: self.cell(sheet, row, i, who, n, unread) for i, n in own.items()}
                drawing = "" if drawn is None else cell_at(row, drawn)
                self.claim(who, sign, place, cells, unread, file, drawing)

    def form(self, sheet: Spreadsheet, file: HandedIn, table_problems: TableProblems) -> None:
        """Read one student's answers, a field in each row.

        The student is identified by a row with the id, by the file name, or by the learning
        platform's sender.
        """
        stated = [row for row in sheet.rows if folded(row.cells[0]) in IDS]
        stated = [row for row in stated if row.cells[1]] or stated
        sign = stated[0].cells[1] if stated else ""
        known = self.signs.who(sign)
        if len(sheet.rows) > MOST_FIELDS:
            found = message("{count} rows", count=len(sheet.rows))
            table_problems.add(
                sheet.name,
                found,
                message("at most {most}, one for each field", most=MOST_FIELDS),
            )
        cells: dict[str, Answer] = {}
        unread: list[Unread] = []
        strangers: list[str] = []
        drawing = ""
        for row in sheet.rows[:MOST_FIELDS]:
            if folded(row.cells[0]) == folded(DRAWING):
                drawing = row.cells[1]
                continue
            name = self.fields.get(folded(row.cells[0]))
            if name is None:
                if folded(row.cells[0]) not in IDS | OTHERS:
                    strangers.append(row.cells[0])
                continue
            if name in cells:
                table_problems.add(
                    sheet.place(row),
                    message("{name} is answered twice", name=name),
                    message("once"),
                )
            cells[name] = self.cell(sheet, row, 1, known or "", name, unread)
        wrong = wrong_rows(table_problems, set(map(visible, sheet.head[:2])))
        if wrong:
            self.refuse(file, *(each for some in wrong.values() for each in some), who=known)
            return
        place = sheet.place(stated[0] if stated else SheetRow(1, ()), "id")
        who = self.signed(place, sign or ("" if stated else self.by_stem(file)), file, True)
        if who is not None:
            for cell in strangers:
                self.stranger(sheet, cell)
            unread = [replace(each, who=who) for each in unread]
            self.claim(who, sign, place, cells, unread, file, drawing)

    def by_stem(self, file: HandedIn) -> str:
        """The file name in place of a missing id; empty where the file has an owner."""
        return "" if self.owners(file) else file.stem

    def owners(self, file: HandedIn) -> tuple[str, ...]:
        """The students who may own a file: those with the sender's name.

        Without a sender, the student whose id is the file name.
        """
        if file.sender is not None:
            return self.signs.named(file.sender.name)
        who = None if self.is_one else self.signs.who(file.stem)
        return (who,) if who is not None else ()

    def signed(self, place: InTable, sign: str, file: HandedIn, alone: bool) -> str | None:
        """The student whose id a row or a file states; None, with a note, where there is none.

        Where a platform names the sender, the id must agree.
        """
        owners = self.owners(file) if alone or file.sender is not None else ()
        if not sign and alone and len(owners) == 1:
            return owners[0]
        who, by = self.signs.who(sign), file.sender
        whose = self.signs.called.get(who or "") or who
        hint: Hint = NO_WORDS
        found, expected = NO_WORDS, NO_WORDS
        if not sign:
            found, expected = message("is missing"), message("the student's id")
        elif who is None:
            found = message('"{sign}" is no student of this class', sign=visible(sign))
            few = len(sign) <= LONGEST_ID and len(self.answers.refused) < MOST_NEAR
            hint = (nearest(sign, sorted(self.signs.ids)) if few else NO_WORDS) or ABSENT
            if own := self.signs.sheets(sign):
                hint = message("write a row for each sheet: {ids}", ids=", ".join(own))
        elif owners and who not in owners:
            expected = verbatim(owners[0]) if by else message("one id")
            found = message(
                '"{sign}" is the id of {whose}, and the file is in the folder of {place}'
                if by
                else '"{sign}" is the id of {whose}, and its file is named {place}',
                sign=visible(sign),
                whose=whose,
                place=visible(by.name) if by else file.stem,
            )
        elif by is not None and not owners and not self.signs.may_be(by.name, who):
            found = message(
                '"{sign}" is the id of {whose}, and {name} handed it in',
                sign=visible(sign),
                whose=whose,
                name=visible(by.name),
            )
            expected = message("the id of who handed it in")
        else:
            return who
        self.refuse(file, Problem(place.message, found, expected, hint, about=(place,)), who=who)
        return None

    def refuse(self, file: HandedIn, *problems: Problem, who: str | None = None) -> None:
        """Note what is not marked, and whose it may be.

        With a sender, these are the students of the sender's name. Otherwise they are the owner of
        the file and ``who``, whose id it states.
        """
        owners = self.owners(file)
        whose = tuple(dict.fromkeys(filter(None, (*owners, who))))
        if file.sender is not None:
            whose = owners
            if len(owners) == 1:
                self.answers.senders[owners[0]] = file.sender
        self.answers.refused += [Refused(each, whose) for each in problems]

    def claim(
        self,
        who: str,
        sign: str,
        place: InTable,
        cells: Mapping[str, Answer],
        unread: Sequence[Unread],
        file: HandedIn,
        drawing: str,
    ) -> None:
        """Note the answers of a student at one place, with the sender of the file."""
        is_sure = file.sender is not None and who in self.owners(file)
        found = Claim(who, sign or who, place, cells, unread, file.sender, is_sure, drawing.strip())
        self.claims.setdefault(who, []).append(found)

    def settled(self) -> Answers:
        """The answers of each student.

        A student with several sets of answers has to wait, unless a platform confirms one of them.
        """
        answers = self.answers
        for who, claims in self.claims.items():
            first, *rivals = [each for each in claims if each.is_sure] or claims
            for other in claims:
                if other is not first:
                    where = replace(first.place, column="")
                    found = message(
                        '"{sign}" has answers already, in {where}',
                        sign=visible(other.sign),
                        where=where.message,
                    )
                    problem = Problem(
                        other.place.message, found, message("one"), about=(other.place,)
                    )
                    answers.refused.append(Refused(problem, (who,) if other in rivals else ()))
            if first.is_sure and first.sender is not None:
                answers.senders[who] = first.sender
            if rivals:
                continue
            answers.of[who] = dict(first.cells)
            if first.drawing:
                answers.drawings[who] = first.drawing
            answers.unread += first.unread
            self.seen |= first.cells.keys()
            if first.sender is not None and not first.is_sure:
                answers.senders[who] = answers.unlisted[who] = first.sender
        for each in answers.refused:
            for who in each.whose:
                if who not in answers.of:
                    answers.withhold(who, self.known)
        return answers

    def stranger(self, sheet: Spreadsheet, cell: str) -> None:
        """Note a column that is no field; the first few with a similar field."""
        few = len(self.answers.strangers) < SHOWN
        near = near_name(cell, self.known) if few else ""
        self.answers.strangers.append(Stranger(sheet.name, visible(cell), near))

    def cell(
        self,
        sheet: Spreadsheet,
        row: SheetRow,
        column: int,
        who: str,
        name: str,
        unread: list[Unread],
    ) -> Answer:
        """The answer in one cell; it is noted where it cannot be read, or reads in two ways."""
        item = self.known[name]
        unit = unit_of(sheet.head[column]) if item.unit else ""
        answer = read_answer(with_unit(row.cells[column], unit), item)
        problem = answer.problem or (THOUSANDS if answer.grouped is not None else "")
        if problem:
            why = (answer.text, problem, item.unit)
            unread.append(Unread(sheet.name, row.line, who, name, *why))
        return answer


UNIT = re.compile(r"[\[(]\s*([^\[\]()]+?)\s*[\])]\s*$")
"""The unit after the name of a field in the head of its column, in brackets."""


def name_of(head: str) -> str:
    """The head of a column without its unit."""
    return UNIT.sub("", head)


def unit_of(head: str) -> str:
    """The unit in the head of a column; empty where there is none."""
    found = UNIT.search(head)
    return found[1] if found else ""


def wrong_rows(table_problems: TableProblems, used: Collection[str]) -> dict[int, list[Problem]]:
    """The problems by row, without those in columns that are not used."""
    found: dict[int, list[Problem]] = defaultdict(list)
    for problem in table_problems.every:
        place = place_of(problem)
        column = place.column if place is not None else ""
        if not column or isinstance(column, int) or column in used:
            found[row_of(problem)].append(problem)
    return found


def cell_at(row: SheetRow, column: int) -> str:
    """The text of a cell; empty where the row is too short."""
    return row.cells[column] if column < len(row.cells) else ""


def in_file(problem: Problem, name: str) -> Problem:
    """The problem, with its file's name where its place has none."""
    return problem if name in problem.place else replace(problem, file=name)
