"""The class folder that ``graphkin variants`` wrote, as those who take part and what marks them."""

from __future__ import annotations

from pathlib import Path

from msgspec import Struct

from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.printing.edition import Edition, read_edition
from graphkin.classroom.roster.student_signs import Signs, signs
from graphkin.classroom.roster.taker import Taker
from graphkin.documents.sheet_documents import language_of
from graphkin.text import Words


class ClassFolder(Struct, frozen=True):
    """A class: its edition, with its students in roster order, and the book that marks it."""

    edition: Edition
    book: Book

    @property
    def takers(self) -> tuple[Taker, ...]:
        """Its students in roster order."""
        return self.edition.takers

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
    return ClassFolder(edition, Book(edition.lab, edition.scene))
