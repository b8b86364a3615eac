"""The work of one worker: the files of some students, as bytes, the same in every process."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from threading import Lock

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.form_page import form, quantity_of, why
from graphkin.classroom.lab.items import asked_of, items
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.personal import (
    Owner,
    crossed,
    joined,
    owned,
    owned_pages,
    owner,
    signed,
    with_owner,
)
from graphkin.classroom.roster.students import Taker
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
from graphkin.scene.read_scene import read_text
from graphkin.text import Words
from graphkin.text.errors import Problem, problems_of

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
        title, name = "; ".join([escape(title_of(first)), *settings]), self.words("form.title")
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
