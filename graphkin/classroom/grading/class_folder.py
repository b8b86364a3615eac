"""The class folder that ``graphkin variants`` wrote, as those who take part and what marks them."""

from __future__ import annotations

from pathlib import Path

from msgspec import Struct

from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.grading.graded import Taker
from graphkin.classroom.printing.edition import Edition, read_edition, tables
from graphkin.classroom.roster.csv_text import safe
from graphkin.classroom.roster.spreadsheets import columns, read_sheet
from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.student_signs import EMAIL, Signs, signs
from graphkin.classroom.variants.manifest import TABLE
from graphkin.documents.sheet_documents import language_of
from graphkin.text import Words


class ClassFolder(Struct, frozen=True):
    """A class: its edition, the book that marks it, and its students in roster order."""

    edition: Edition
    book: Book
    takers: tuple[Taker, ...]

    @property
    def signs(self) -> Signs:
        """By what its students are known in other tables."""
        every = {taker.student.id: taker for taker in self.takers}
        return signs(
            every,
            {who: taker.code for who, taker in every.items()},
            {who: taker.email for who, taker in every.items()},
            {who: taker.student.name for who, taker in every.items()},
        )

    def words(self, language: str | None = None) -> Words:
        """The words of its pages: in a language, else in that of the class, or of its scene."""
        return language_of(self.book.mechanism({}), language or self.edition.language or None)


def open_class(folder: Path) -> ClassFolder:
    """The class in a folder. Raises SceneError with what is wrong with its manifest."""
    edition = read_edition(folder)
    rows = tables(folder)["students"]
    mails = emails(folder)
    takers = tuple(
        Taker(
            Student(
                whole(row.get("row")) or place,
                variant.id,
                whole(row.get("number")),
                variant.name,
                variant.group,
            ),
            variant.settings,
            variant.code,
            variant.compute,
            variant.language,
            mails.get(safe(variant.id), ""),
        )
        for place, (variant, row) in enumerate(zip(edition.variants, rows, strict=True), 1)
    )
    return ClassFolder(edition, Book(edition.lab, edition.scene), takers)


def emails(folder: Path) -> dict[str, str]:
    """The e-mail addresses that the table of a class folder has, by id as it is written there."""
    if not (folder / TABLE).exists():
        return {}
    sheet = read_sheet(folder / TABLE)
    where = columns(sheet, {"id": (), "email": EMAIL})
    if len(where) < 2:
        return {}
    return {row.cells[where["id"]]: row.cells[where["email"]] for row in sheet.rows}


def whole(value: object) -> int | None:
    """A whole number of the manifest; None where there is none."""
    return value if isinstance(value, int) and not isinstance(value, bool) else None
