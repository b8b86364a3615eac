"""The marks of a class as the desk shows them: one file, which ``grade`` writes into its report."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from fractions import Fraction
from math import inf, isfinite, nan
from pathlib import Path

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answers import Unread
from graphkin.classroom.grading.graded import (
    Answer,
    Decision,
    EarnedMark,
    Graded,
    Result,
    Status,
    Suspicion,
)
from graphkin.classroom.lab.lab_model import Item
from graphkin.scene.file_limits import whole_file
from graphkin.text.errors import NO_WORDS, PageError, Problem, message
from graphkin.writers.shared_lines import exact

KEPT_MARKS = "desk.json"
FORMAT = 1


class KeptMark(Struct, frozen=True, omit_defaults=True):
    """A mark with the place of its item in the form; None represents a value that is no number."""

    item: int
    answer: Answer
    status: Status
    points: Fraction
    earned: Fraction
    expected: float | None = None
    tolerance: float | None = None
    source: str = ""
    cause: str = ""
    by_cause: float | None = None
    torn: bool = False
    alone: bool = False
    rounded: str = ""
    decision: Decision | None = None


class KeptStudent(Struct, frozen=True):
    """A student's marks; ``graded`` holds all but these."""

    graded: Graded
    marks: tuple[KeptMark, ...]


class KeptReport(Struct, frozen=True, omit_defaults=True):
    """A marked class.

    ``readings`` is the folder of the drawings, relative to the report; empty where there is none.
    ``cells`` are those that wait, or that a person has read.
    """

    format: int
    form: tuple[Item, ...]
    students: tuple[KeptStudent, ...]
    wrong_variants: tuple[Suspicion, ...] = ()
    copies: tuple[Suspicion, ...] = ()
    cells: tuple[Unread, ...] = ()
    readings: str = ""

    @property
    def graded(self) -> tuple[Graded, ...]:
        """The students with their marks."""
        return tuple(
            replace(each.graded, marks=tuple(self.restored(mark) for mark in each.marks))
            for each in self.students
        )

    def restored(self, mark: KeptMark) -> EarnedMark:
        """A mark as it was kept."""
        values = {name: getattr(mark, name) for name in mark.__struct_fields__}
        expected = nan if mark.expected is None else mark.expected
        tolerance = inf if mark.tolerance is None else mark.tolerance
        own = {"item": self.form[mark.item], "expected": expected, "tolerance": tolerance}
        return EarnedMark(**(values | own))


def kept_marks(
    found: Result, form: Sequence[Item], cells: Collection[Unread], readings: str
) -> bytes:
    """The file with the marks of a class."""
    places = {item.field: place for place, item in enumerate(form)}
    bare = tuple(replace(item, vector=None) for item in form)
    students = tuple(
        KeptStudent(replace(each, marks=()), tuple(kept(mark, places) for mark in each.marks))
        for each in found.graded
    )
    report = KeptReport(
        FORMAT, bare, students, found.wrong_variants, found.copies, tuple(cells), readings
    )
    return msgspec.json.encode(report, enc_hook=as_exact) + b"\n"


def kept(mark: EarnedMark, places: dict[str, int]) -> KeptMark:
    """A mark with the place of its item."""
    values = {name: getattr(mark, name) for name in mark.__struct_fields__}
    numbers = {
        name: values[name] if isfinite(values[name]) else None for name in ("expected", "tolerance")
    }
    return KeptMark(**(values | numbers | {"item": places[mark.item.field]}))


def as_exact(value: object) -> str:
    """A fraction or markup as text. Raises NotImplementedError for anything else."""
    if isinstance(value, Fraction | str):
        return str(value)
    raise NotImplementedError(type(value))


def read_kept_marks(report: Path) -> KeptReport | None:
    """The marks in a report's folder; None where there are none.

    Raises PageError for a file that another version wrote.
    """
    path = report / KEPT_MARKS
    if not path.is_file():
        return None
    try:
        found = msgspec.json.decode(whole_file(path), type=KeptReport, dec_hook=exact)
    except (msgspec.MsgspecError, ValueError):
        found = None
    if found is None or found.format != FORMAT:
        hint = message("mark the class again with graphkin grade --force")
        problem = Problem(str(path), message("cannot be read as marks"), NO_WORDS, hint)
        raise PageError(problem)
    return found
