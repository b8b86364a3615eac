"""What grading writes: marks, tolerances, feedback for each student, the report on the class."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from graphkin.errors import Problem
from graphkin.grading.book import Class
from graphkin.grading.feedback import feedback_html, feedback_pages
from graphkin.grading.model import Graded
from graphkin.grading.report import class_report
from graphkin.grading.tables import differences, differences_table, marks_table, tolerances_table
from graphkin.lab.model import Lab
from graphkin.paper.pdf import write_pdf
from graphkin.printing.names import stems
from graphkin.text import Words

MARKS, TOLERANCES, REPORT, CHANGES = (
    "marks.csv",
    "tolerances.csv",
    "class.html",
    "differences.csv",
)
FEEDBACK = "feedback"
"""The folder with a page for each student."""


@dataclass(frozen=True)
class Told:
    """What is told with the marks: the lab's title, its language, cells that cannot be read."""

    title: str
    words: Words
    unread: Sequence[Problem] = ()


def report_files(
    found: Class, lab: Lab, told: Told, formats: Sequence[str], before: bytes = b""
) -> dict[str, bytes]:
    """The files of a report by their names; with an earlier marks.csv also what changed."""
    graded = found.result.graded
    marks = marks_table(graded)
    files = {
        MARKS: marks,
        TOLERANCES: tolerances_table(graded, found.expected),
        REPORT: class_report(found.result, told.title, told.unread, told.words).encode("utf-8"),
    }
    if before:
        files[CHANGES] = differences_table(differences(before, marks))
    return files | feedback_files(graded, lab, told, formats)


def feedback_files(
    graded: Sequence[Graded], lab: Lab, told: Told, formats: Sequence[str]
) -> dict[str, bytes]:
    """A page for each student, named by the id as far as that is plain letters."""
    students = [each.taker.student.id for each in graded]
    names = stems(students, [each.taker.code for each in graded])
    files: dict[str, bytes] = {}
    for each, name in zip(graded, names, strict=True):
        if "html" in formats:
            text = feedback_html(each, told.title, lab.rubric, told.words)
            files[f"{FEEDBACK}/{name}.html"] = text.encode("utf-8")
        if "pdf" in formats:
            pages = feedback_pages(each, told.title, lab.rubric, told.words)
            files[f"{FEEDBACK}/{name}.pdf"] = write_pdf(pages, title=pages[0].title)
    return files


def gradebook_name(path: Path) -> str:
    """The name of a filled gradebook: that of the export."""
    return f"gradebook-{path.name}"


def points_by_id(found: Class) -> dict[str, Fraction]:
    """The points of those who handed in, for a gradebook."""
    return {each.taker.student.id: each.earned for each in found.result.graded if each.present}
