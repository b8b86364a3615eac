"""The edition to print: the manifest of a class folder, checked against its copy of the lab.

File names from arbitrary ids: plain letters only, all different, all inside the folder.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Sequence, Set
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.roster.spreadsheets import columns, read_sheet
from graphkin.classroom.roster.students import EMAIL, HEADS, Signs, Student, Taker, signs
from graphkin.classroom.variants.assign import COPY, FORMAT, MANIFEST, TABLE, as_text
from graphkin.documents.sheet_documents import language_of
from graphkin.mechanism import Mechanism
from graphkin.scene.file_limits import whole_file
from graphkin.scene.house import PLAIN
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, Words
from graphkin.text.errors import NO_WORDS, PageError, Problem, SceneError, either, joined, message
from graphkin.text.tables import safe
from graphkin.writers.commit import reason_of, settle
from graphkin.writers.files import RESERVED, write_all

if TYPE_CHECKING:
    from graphkin.classroom.grading.class_marking import Book

FILES = ("scene.toml", "lab.toml")
"""The files of the lab whose hashes the manifest holds."""
COPIED = f"{COPY}/"
"""The beginning of the names of a school's files in the manifest."""
AGAIN = message("make the folder again with graphkin variants")


class Edition(Struct, frozen=True, dict=True):
    """A class folder: its lab, the text of its scene, and its students in roster order.

    ``language`` is for students who have none of their own, as given to variants or print; it is
    empty if that is the scene's language.
    """

    folder: Path
    lab: Lab
    scene: str
    takers: tuple[Taker, ...] = ()
    language: str = ""

    @cached_property
    def book(self) -> Book:
        """The marker of the class's variants."""
        from graphkin.classroom.grading.class_marking import Book

        return Book(self.lab, self.scene)

    @property
    def signs(self) -> Signs:
        """How other tables identify the students."""
        every = {taker.student.id: taker for taker in self.takers}
        return signs(
            every,
            {who: taker.code for who, taker in every.items()},
            {who: taker.email for who, taker in every.items()},
            {who: taker.student.name for who, taker in every.items()},
        )

    @property
    def owners(self) -> Signs:
        """How gradebooks identify the students of the class list, whose sheets may be several."""
        every = {taker.student.whose: taker for taker in self.takers}
        return signs(
            every,
            {who: taker.code for who, taker in every.items() if not taker.student.owner},
            {who: taker.email for who, taker in every.items()},
            {who: taker.student.name for who, taker in every.items()},
        )

    def words(self, language: str | None = None) -> Words:
        """The words of the pages: in the given language, else in that of the class or of its scene.

        Raises SceneError for a language that does not exist.
        """
        mechanism = Mechanism(read_text(self.scene, self.lab.name, house=self.lab.house))
        return language_of(mechanism, language or self.language or None)


def read_edition(folder: Path) -> Edition:
    """The class folder that ``graphkin variants`` wrote.

    Raises SceneError with what is wrong, RosterError if the folder's table cannot be read.
    """
    from graphkin.classroom.lab.read_lab import read_lab

    settle(folder)
    raw = tables(folder)
    refuse_changed(folder, raw.get("sha256"))
    problems: list[Problem] = []
    takers = [
        found
        for place, student in enumerate(raw["students"], 1)
        if (found := taker(student, place, problems)) is not None
    ]
    problems += twins(takers)
    language = raw.get("language", "")
    if language not in ("", *LANGUAGES):
        wrong = message('language: "{language}" is no language of the pages', language=language)
        problems.append(Problem(MANIFEST, wrong, either(LANGUAGES)))
    if problems:
        raise SceneError(problems)
    own = beside_ids(folder)
    takers = [replace(each, **own.get(safe(each.student.id), {})) for each in takers]
    house = None if house_files(raw.get("sha256")) else PLAIN
    lab = replace(read_lab(folder / COPY, house=house), name=str(raw.get("lab", COPY)))
    scene = (folder / COPY / FILES[0]).read_text(encoding="utf-8-sig")
    return Edition(folder, lab, scene, tuple(takers), language)


def keep_language(folder: Path, language: str) -> None:
    """Write the language of a class's pages into its manifest."""
    record = tables(folder)
    students = record.pop("students")
    text = as_text({**record, "language": language, "students": students})
    write_all(folder, {MANIFEST: text.encode()}, force=True)


def tables(folder: Path) -> dict[str, Any]:
    """The manifest, if it has a known format and a list of students; else raises SceneError."""
    path = folder / MANIFEST
    try:
        raw = json.loads(whole_file(path).decode("utf-8"))
    except OSError as error:
        reason = reason_of(error)
        hint = message("graphkin variants LAB ROSTER -o DIR makes one")
        found = message("cannot be read: {reason}", reason=reason)
        raise SceneError.at(str(path), found, message("a class folder"), hint) from error
    except (ValueError, RecursionError) as error:
        raise SceneError.at(
            str(path), message("is no JSON text"), message("a manifest"), AGAIN
        ) from error
    if not isinstance(raw, dict) or not isinstance(raw.get("students"), list):
        raise SceneError.at(
            str(path), message("has no list of students"), message("a manifest"), AGAIN
        )
    if raw.get("format") != FORMAT:
        found = message("has format {value!r}", value=raw.get("format"))
        raise SceneError.at(
            str(path), found, message("format {format}", format=FORMAT), message("update graphkin")
        )
    if not raw["students"]:
        raise SceneError.at(str(path), message("has no student"), message("one at least"), AGAIN)
    return raw


def house_files(hashes: object) -> list[str]:
    """The files of a school's conventions that the manifest records."""
    known = hashes if isinstance(hashes, dict) else {}
    return [name for name in known if name.startswith(COPIED)]


def refuse_changed(folder: Path, hashes: object) -> None:
    """Raise SceneError if the copied lab or the table is not the one recorded in the manifest.

    A run that was killed, or a person, changed one file and not the other.
    """
    problems = []
    for name in (*FILES, *house_files(hashes)):
        path = folder / (name if name.startswith(COPIED) else f"{COPIED}{name}")
        try:
            found = sha256(whole_file(path)).hexdigest()
        except OSError as error:
            reason = reason_of(error)
            problems.append(
                Problem(
                    str(path), message("cannot be read: {reason}", reason=reason), NO_WORDS, AGAIN
                )
            )
            continue
        if not isinstance(hashes, dict) or hashes.get(name) != found:
            expected = message("the very text from which the variants were made")
            problems.append(Problem(str(path), message("was changed since"), expected, AGAIN))
    table = folder / TABLE
    known = hashes.get(TABLE) if isinstance(hashes, dict) else None
    if known and table.exists() and digest_of(table) != known:
        expected = message("the table that was written with {manifest}", manifest=MANIFEST)
        problems.append(
            Problem(
                str(table),
                message("was changed since"),
                expected,
                message("make the folder again with graphkin variants --force"),
            )
        )
    if problems:
        raise SceneError(problems)


def digest_of(path: Path) -> str:
    """The SHA-256 of a file; empty if it cannot be read."""
    try:
        return sha256(whole_file(path)).hexdigest()
    except OSError:
        return ""


def taker(student: object, place: int, problems: list[Problem]) -> Taker | None:
    """One student of the manifest; None, with a problem recorded, if something is missing."""
    where = message("{manifest}, student {number}", manifest=MANIFEST, number=place)
    if not isinstance(student, dict):
        problems.append(
            Problem(where, message("is no table"), message("id, code and parameters"), AGAIN)
        )
        return None
    settings, compute = student.get("parameters"), student.get("compute", [])
    texts = {key: student.get(key, "") for key in ("id", "code", "name", "group")}
    wrong = [key for key, text in texts.items() if not isinstance(text, str)]
    wrong += [key for key in ("id", "code") if not texts[key]]
    if not isinstance(settings, dict) or not all(isinstance(v, str) for v in settings.values()):
        wrong.append("parameters")
    if not isinstance(compute, list) or not all(isinstance(name, str) for name in compute):
        wrong.append("compute")
    if wrong or not isinstance(settings, dict):
        found = message(
            "{wrong}: missing or of the wrong kind", wrong=", ".join(dict.fromkeys(wrong))
        )
        problems.append(Problem(where, found, message("text, and parameters as text"), AGAIN))
        return None
    row, number = (whole(student.get(key)) for key in ("row", "number"))
    owner, part = student.get("owner", ""), whole(student.get("part")) or 0
    who = Student(
        row or place,
        texts["id"],
        number,
        texts["name"],
        texts["group"],
        owner=owner if isinstance(owner, str) else "",
        part=part,
    )
    return Taker(who, settings, texts["code"], tuple(compute))


def whole(value: object) -> int | None:
    """The value if it is a whole number; else None."""
    return value if isinstance(value, int) and not isinstance(value, bool) else None


def twins(takers: Sequence[Taker]) -> Iterator[Problem]:
    """The problems of students with equal ids or codes."""
    ids, codes = [each.student.id for each in takers], [each.code for each in takers]
    for what, texts in (("id", ids), ("code", codes)):
        for text, times in Counter(texts).items():
            if times > 1:
                found = message(
                    '{times} students have the {what} "{text}"', times=times, what=what, text=text
                )
                yield Problem(MANIFEST, found, message("one of each"), AGAIN)


def beside_ids(folder: Path) -> dict[str, dict[str, str]]:
    """Each student's language and e-mail address in the table of a class folder.

    The keys are the ids as that table writes them. The result is empty if there are no such
    columns, or no table, which nothing else needs. Raises RosterError if the table cannot be read.
    """
    if not (folder / TABLE).exists():
        return {}
    sheet = read_sheet(folder / TABLE)
    where = columns(sheet, {"id": (), "language": HEADS, "email": EMAIL})
    if "id" not in where:
        return {}
    own = where.pop("id")
    return {
        row.cells[own]: {what: row.cells[column] for what, column in where.items()}
        for row in sheet.rows
    }


LONGEST = 48
"""The most characters of an id in a file name."""
SHOWN = 3
"""The most files in the way that a message names."""
STRANGE = r"[^A-Za-z0-9_-]+"


def stems(ids: Sequence[str], codes: Sequence[str]) -> list[str]:
    """The beginning of each student's file names: the id if it is plain letters and digits.

    Other signs become ``_``. The student's opaque code is appended to such an id, to one that a
    system reserves for a device, and to ids that differ only in case. All stems are different,
    regardless of case, whatever the ids and codes.
    """
    plain = [re.sub(STRANGE, "_", text)[:LONGEST] for text in ids]
    times = Counter(name.lower() for name in plain)
    kept = [
        name == text and times[name.lower()] == 1 and is_fit(name)
        for text, name in zip(ids, plain, strict=True)
    ]
    taken = {name.lower() for name, keep in zip(plain, kept, strict=True) if keep}
    found: list[str] = []
    for name, keep, code in zip(plain, kept, codes, strict=True):
        tail = re.sub(STRANGE, "_", code).lower()
        found.append(name if keep else unused(f"{name.strip('_-') or 'id'}-{tail}", taken))
        taken.add(found[-1].lower())
    return found


def is_fit(name: str) -> bool:
    """Whether a plain name can be a file name: not empty, no device, no leading hyphen."""
    return bool(name) and name.upper() not in RESERVED and name[0] != "-"


def unused(name: str, taken: Set[str]) -> str:
    """The name, or the name with the lowest number that makes it unused."""
    tried, number = name, 1
    while tried.lower() in taken:
        number += 1
        tried = f"{name}-{number}"
    return tried


def inside(folder: Path, name: str) -> Path:
    """The path of a file in a folder. Raises PageError if links lead out of the folder."""
    path = folder / name
    whole = folder.resolve()
    if not path.resolve().is_relative_to(whole):
        found = message("leads to {folder}", folder=path.resolve())
        raise PageError.at(
            str(path), found, message("a file in {whole}", whole=whole), message("remove the link")
        )
    return path


def in_the_way(folder: Path, names: Sequence[str], unlike: Sequence[str] = ()) -> Problem:
    """The problem of existing files where others are to go; ``unlike`` says what differs."""
    there, more = joined(", ", names[:SHOWN]), len(names) - SHOWN
    if more > 0:
        there = message("{names} and {count} more", names=there, count=more)
    why = joined("; ", unlike) or message("made from other data or settings")
    found = message("{names}: there already, {why}", names=there, why=why)
    return Problem(str(folder), found, hint=message("--force replaces what is in the way"))
