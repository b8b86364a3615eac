"""What grading writes: marks, tolerances, feedback for each student, the report on the class."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from msgspec import Struct, field

from graphkin.classroom.grading.answers import Unread
from graphkin.classroom.grading.class_report import class_report
from graphkin.classroom.grading.feedback import feedback_html, feedback_pages
from graphkin.classroom.grading.graded import Graded, Result
from graphkin.classroom.grading.marks_tables import (
    differences,
    differences_table,
    marks_table,
    tolerances_table,
)
from graphkin.classroom.grading.submissions import Sender, packed_feedback
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.printing.file_names import stems
from graphkin.scene.model import Scene
from graphkin.text import Words, words
from graphkin.text.errors import Refusals
from graphkin.writers.pdf import write_pdf

MARKS, TOLERANCES, REPORT, CHANGES = (
    "marks.csv",
    "tolerances.csv",
    "class.html",
    "differences.csv",
)
RETURNED = "feedback-moodle.zip"
"""The feedback as Moodle takes it back."""
FEEDBACK = "feedback"
"""The folder with a page for each student."""


class ReportSettings(Struct, frozen=True):
    """What is told with the marks: the lab's title, the language of the report and of whoever has
    none of the own, cells that cannot be read; the title in other languages; the scene, which tells
    what the parameters are of; lines about what is not marked. ``refusals`` notes pages that cannot
    be made.
    """

    title: str
    words: Words
    unread: Sequence[Unread] = ()
    titles: Mapping[str, str] = field(default_factory=dict)
    scene: Scene | None = None
    refused: Sequence[str] = ()
    refusals: Refusals = field(default_factory=Refusals)

    def words_for(self, graded: Graded) -> Words:
        """The words of a student's own language."""
        own = graded.taker.spoken
        return words(own) if own else self.words

    def title_in(self, language: str) -> str:
        """The lab's title in a language."""
        return self.titles.get(language, self.title)


def report_files(
    found: Result, lab: Lab, told: ReportSettings, formats: Sequence[str], before: bytes = b""
) -> dict[str, bytes]:
    """The files of a report by their names; with an earlier marks.csv also what changed."""
    graded = found.graded
    marks = marks_table(found)
    files = {
        MARKS: marks,
        TOLERANCES: tolerances_table(graded, found.expected),
        REPORT: class_report(found, told.title, told.unread, told.words, told.refused).encode(),
    }
    if before:
        files[CHANGES] = differences_table(differences(before, marks))
    return files | feedback_files(graded, lab, told, formats)


def feedback_files(
    graded: Sequence[Graded], lab: Lab, told: ReportSettings, formats: Sequence[str]
) -> dict[str, bytes]:
    """A page for each student, named by the id as far as that is plain letters."""
    students = [each.taker.student.id for each in graded]
    names = stems(students, [each.taker.code for each in graded])
    files: dict[str, bytes] = {}
    for each, name in zip(graded, names, strict=True):
        spoken = told.words_for(each)
        title = told.title_in(spoken.language)
        with told.refusals.alone(each.taker.student.called):
            if "html" in formats:
                text = feedback_html(each, title, lab.rubric, spoken, told.scene)
                files[f"{FEEDBACK}/{name}.html"] = text.encode("utf-8")
            if "pdf" in formats:
                pages = feedback_pages(each, title, lab.rubric, spoken, told.scene)
                files[f"{FEEDBACK}/{name}.pdf"] = write_pdf(pages, title=pages[0].title)
    return files


def gradebook_name(path: Path) -> str:
    """The name of a filled gradebook: that of the export."""
    return f"gradebook-{path.name}"


def returned(
    files: Mapping[str, bytes],
    graded: Sequence[Graded],
    senders: Mapping[str, Sender],
    formats: Sequence[str],
) -> dict[str, bytes]:
    """The ZIP file in which Moodle takes feedback back, where it was Moodle that sent answers."""
    kind = next((kind for kind in ("pdf", "html") if kind in formats), "")
    backs = {who: sender.back for who, sender in senders.items() if sender.back}
    if not kind or not backs:
        return {}
    students = [each.taker.student.id for each in graded]
    names = stems(students, [each.taker.code for each in graded])
    paths = {w: f"{FEEDBACK}/{name}.{kind}" for w, name in zip(students, names, strict=True)}
    pages = {who: files[path] for who, path in paths.items() if path in files}
    return {RETURNED: packed_feedback(backs, pages, kind)}


def points_by_id(found: Result, scale: Fraction | None = None) -> dict[str, Fraction]:
    """The points of those who handed in and for whom nothing waits or is held, for a gradebook; on
    a scale the share of all points that they are.
    """
    return {
        each.taker.student.id: each.earned if scale is None else each.earned * scale / each.points
        for each in found.graded
        if each.is_marked and not each.pending and not each.held and (scale is None or each.points)
    }
