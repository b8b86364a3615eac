"""The marks of a class as the desk shows them: one file, which ``grade`` writes into its report."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from math import inf, isfinite, nan
from pathlib import Path
from typing import Any

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answers import Unread
from graphkin.classroom.grading.graded import Graded, Result, Suspicion
from graphkin.classroom.lab.lab_model import Item
from graphkin.scene.file_limits import whole_file
from graphkin.text.errors import NO_WORDS, PageError, Problem, message
from graphkin.writers.shared_lines import exact

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
