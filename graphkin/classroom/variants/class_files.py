"""The folder of a class: variants.csv, manifest.json and a copy of the lab, written as a whole."""

from __future__ import annotations

import json
import secrets
from collections import Counter
from collections.abc import Iterator, Sequence
from hashlib import sha256
from pathlib import Path

from graphkin.classroom.grading.neighbours import compared, unsure_fields
from graphkin.classroom.lab.lab_model import Lab, exact_text
from graphkin.classroom.lab.lab_trial import (
    apart_lines,
    data_words,
    limit_words,
    lines_of,
    rule_words,
    spread_table,
    spreads,
    unsure_lines,
)
from graphkin.classroom.roster.students import Student, counted
from graphkin.classroom.variants.assign import (
    COPY,
    MANIFEST,
    TABLE,
    Assigned,
    as_text,
    code,
    held_against,
    manifest,
)
from graphkin.scene.file_limits import whole_file
from graphkin.text import words
from graphkin.text.tables import csv_text, labelled, table
from graphkin.writers.commit import settle
from graphkin.writers.files import write_all

HEAD = ("row", "number", "id", "name", "group")
TAIL = ("flattest_deg", "shortest_mm", "status", "tries", "compute", "limits", "code")
SALT = 16
"""The length of the salt in bytes."""


def write_class(
    folder: Path,
    lab: Lab,
    students: Sequence[Assigned],
    roster: Path,
    *,
    force: bool,
    language: str | None = None,
) -> list[Path]:
    """Write the folder of a class; raises PageError before it changes anything.

    A class written again keeps its salt, so that printed codes stay valid, and its language unless
    another is given.
    """
    settle(folder)
    scene = lab.scene.read_bytes()
    rule = lab.text.encode("utf-8")
    salt = (kept(folder, "salt") if force else "") or secrets.token_hex(SALT)
    language = language or (kept(folder, "language") if force else "")
    table = csv_text(table_rows(students, salt)).encode("utf-8")
    hashes = {"scene.toml": digest(scene), "lab.toml": digest(rule), TABLE: digest(table)}
    hashes["roster"] = digest(whole_file(roster))
    house = {f"{COPY}/{name}": data for name, data in lab.house.files.items()}
    hashes |= {name: digest(data) for name, data in house.items()}
    record = manifest(lab, students, hashes, roster.name, salt, language)
    files = {
        TABLE: table,
        f"{COPY}/scene.toml": scene,
        f"{COPY}/lab.toml": rule,
        **house,
        MANIFEST: as_text(record).encode("utf-8"),
    }
    return write_all(folder, files, force)


def digest(data: bytes) -> str:
    return sha256(data).hexdigest()


def kept(folder: Path, name: str) -> str:
    """A text of the manifest in a folder; empty if it cannot be read."""
    try:
        text = json.loads(whole_file(folder / MANIFEST).decode("utf-8"))[name]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return ""
    return text if isinstance(text, str) else ""


def table_rows(students: Sequence[Assigned], salt: str) -> Iterator[list[object]]:
    """The rows of variants.csv: student, exact data, fairness, then the roster's other columns."""
    names = list(dict.fromkeys(name for each in students for name in each.settings))
    extra = list(dict.fromkeys(key for each in students for key in each.student.extra))
    own = {*HEAD, *names, *TAIL}
    heads = [f"roster {key}" if key in own else key for key in extra]
    yield [*HEAD, *names, *TAIL, *heads]
    for each in students:
        student = each.student
        yield [
            student.row,
            student.number,
            student.id,
            student.name,
            student.group,
            *(exact_text(each.settings[name]) for name in names),
            *(None if n is None else f"{n:.2f}" for n in (each.flattest, each.shortest)),
            each.status,
            each.attempt + 1,
            " ".join(each.computed),
            "; ".join(map(str, each.faults)),
            code(salt, student.id),
            *(student.extra.get(key, "") for key in extra),
        ]


# --- the report on a class with data: how fair they are, and for whom they are not ----------------


MOST = 40
"""The most rows of one list."""
COMPARED = 400
"""The most students whose data are compared; of a larger class an even sample is taken."""
WHO = ("row", "number", "id", "name")
"""The heads of the columns that identify a student in a list."""


def class_lines(lab: Lab, found: Sequence[Assigned]) -> Iterator[str]:
    """The whole report on a class."""
    yield from labelled("rule", [rule_words(lab)])
    yield from labelled("limits", [limit_words(lab.fair)])
    fair = sum(each.fair for each in found)
    what = counted(each.student for each in found)
    yield from labelled("fair", [f"{fair} of {len(found)} {what}"])
    unfair = [
        (*who(each.student), data_words(each.settings), "; ".join(map(str, each.faults)))
        for each in found
        if not each.fair
    ]
    yield from labelled("unfair", listed((*WHO, "data", "limits"), unfair))
    if lab.rule.is_drawn:
        again = [(*who(each.student), f"{each.attempt + 1}") for each in found if each.attempt]
        yield from labelled("again", listed((*WHO, "draws"), again))
    small = [(*who(each.student), " ".join(each.computed)) for each in found if each.computed]
    yield from labelled("compute", listed((*WHO, "computed instead of measured"), small))
    drawn = [each for each in found if each.flattest is not None]
    angles = [each.flattest for each in drawn if each.flattest is not None]
    lengths = [each.shortest for each in drawn if each.shortest is not None]
    rays = [each.rays for each in drawn if each.rays is not None]
    if len(drawn) > COMPARED:
        sample = f"{COMPARED} of {len(drawn)} {what}, evenly spaced in the list"
        yield from labelled("compared", [sample])
        drawn = [drawn[i * len(drawn) // COMPARED] for i in range(COMPARED)]
    names = [each.student.id for each in drawn]
    standards = held_against(lab, drawn)
    neighbours = compared(standards)
    found_spreads = spreads(angles, rays, lengths, neighbours)
    yield from labelled("spread", lines_of(spread_table(found_spreads, words("en"))))
    yield from labelled("apart", apart_lines(neighbours, names, "id"))
    unsure = list(zip(names, map(unsure_fields, standards), strict=True))
    yield from labelled("unsure", unsure_lines(lab, unsure, "id"))
    if not lab.rule.is_drawn:
        yield from labelled(
            "note", alike_lines([each.student for each in found if each.student.part < 2])
        )


def alike_lines(students: Sequence[Student]) -> list[str]:
    """The numbers that several students of a group share: these students get the same data."""
    shared = Counter((student.group, student.number) for student in students)
    found = [
        f"{count} students{f' of group {group}' if group else ''} have number {number}: "
        "they get the same data"
        for (group, number), count in shared.items()
        if count > 1
    ]
    return [*found[:MOST], *([f"… and {len(found) - MOST} more numbers"] if found[MOST:] else [])]


def who(student: Student) -> tuple[str, str, str, str]:
    """The cells that identify a student in a list."""
    number = "" if student.number is None else str(student.number)
    return str(student.row), number, student.id, student.name


def listed(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> list[str]:
    """A list with its head, cut if it is long; the line ``none`` if it is empty."""
    if not rows:
        return ["none"]
    more = [f"… and {len(rows) - MOST} more"] if len(rows) > MOST else []
    return [*table(head, list(rows[:MOST])), *more]
