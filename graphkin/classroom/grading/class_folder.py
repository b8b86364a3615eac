"""The class folder that ``graphkin variants`` wrote, as those who take part and what marks them."""

from __future__ import annotations

from pathlib import Path

from msgspec import Struct

from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.grading.graded import Taker
from graphkin.classroom.printing.edition import Edition, read_edition, tables
from graphkin.classroom.roster.student import Student


class ClassFolder(Struct, frozen=True):
    """A class: its edition, the book that marks it, and its students in roster order."""

    edition: Edition
    book: Book
    takers: tuple[Taker, ...]


def open_class(folder: Path) -> ClassFolder:
    """The class in a folder. Raises SceneError with what is wrong with its manifest."""
    edition = read_edition(folder)
    rows = tables(folder)["students"]
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
        )
        for place, (variant, row) in enumerate(zip(edition.variants, rows, strict=True), 1)
    )
    return ClassFolder(edition, Book(edition.lab, edition.scene), takers)


def whole(value: object) -> int | None:
    """A whole number of the manifest; None where there is none."""
    return value if isinstance(value, int) and not isinstance(value, bool) else None
