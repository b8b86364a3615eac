"""The folder of a class: variants.csv, manifest.json and a copy of the lab, written as a whole."""

from __future__ import annotations

import json
import secrets
from collections.abc import Iterator, Sequence
from hashlib import sha256
from pathlib import Path

from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.lab.rules import exact_text
from graphkin.classroom.roster.csv_text import csv_text
from graphkin.classroom.variants.assign import Assigned
from graphkin.classroom.variants.manifest import COPY, MANIFEST, TABLE, as_text, code, manifest
from graphkin.scene.file_limits import whole_file
from graphkin.writers.commit import settle
from graphkin.writers.files import write_all

HEAD = ("row", "number", "id", "name", "group")
TAIL = ("flattest_deg", "shortest_mm", "status", "tries", "compute", "limits", "code")
SALT = 16
"""Bytes of the salt."""


def write_class(
    folder: Path,
    lab: Lab,
    students: Sequence[Assigned],
    roster: Path,
    *,
    force: bool,
    language: str | None = None,
) -> list[Path]:
    """Write the folder of a class; raises PageError before anything is touched.

    A class that is written again keeps its salt, so that codes that were printed stay true, and its
    language unless another is named.
    """
    settle(folder)
    scene = lab.scene.read_bytes()
    rule = lab.text.encode("utf-8")
    salt = (kept(folder, "salt") if force else "") or secrets.token_hex(SALT)
    language = language or (kept(folder, "language") if force else "")
    table = csv_text(table_rows(students, salt)).encode("utf-8")
    hashes = {"scene.toml": digest(scene), "lab.toml": digest(rule), TABLE: digest(table)}
    hashes["roster"] = digest(whole_file(roster))
    record = manifest(lab, students, hashes, roster.name, salt, language)
    files = {
        TABLE: table,
        f"{COPY}/scene.toml": scene,
        f"{COPY}/lab.toml": rule,
        MANIFEST: as_text(record).encode("utf-8"),
    }
    return write_all(folder, files, force)


def digest(data: bytes) -> str:
    """The SHA-256 of some bytes."""
    return sha256(data).hexdigest()


def kept(folder: Path, name: str) -> str:
    """A text of the manifest that stands in a folder; empty where none can be read."""
    try:
        text = json.loads(whole_file(folder / MANIFEST).decode("utf-8"))[name]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return ""
    return text if isinstance(text, str) else ""


def table_rows(students: Sequence[Assigned], salt: str) -> Iterator[list[object]]:
    """The rows of variants.csv: who, the exact data, how fair, then the roster's other columns."""
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
