"""The files for the printer: all students' pages of one view in the order of the roster."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from graphkin.classroom.printing.edition import Variant
from graphkin.classroom.printing.file_names import in_the_way, inside
from graphkin.classroom.printing.journal import Entry, Journal, hash_of, key_of
from graphkin.text.errors import PageError
from graphkin.writers.pdf_join import PdfPart, join

Members = Sequence[tuple[Variant, Sequence[str]]]
"""Students in order, each with the names of the PDF files that are put in."""


def merge(
    journal: Journal, lab: str, view: str, members: Members, language: str, force: bool
) -> Path | None:
    """Write the file of a view, if it does not stand already; None where nobody has pages.

    It has a bookmark for each student. Raises PageError when another file is in its way.
    """
    if not members:
        return None
    name, title = f"class-{view}.pdf", f"{lab}, {view}"
    entries = {n: found for e in journal.entries.values() for n, found in e.files.items()}
    hashes = [[entries[name] for name in names] for _, names in members]
    marks = [bookmark(variant) for variant, _ in members]
    key = key_of(title, language, marks, hashes)
    path = inside(journal.folder, name)
    if journal.finished(name, key):
        return path
    if os.path.lexists(path) and name not in journal.entries and not force:
        raise PageError(in_the_way(journal.folder, [name]))
    aside = path.with_name(f".graphkin-{os.getpid()}-{view}.part")
    try:
        with aside.open("wb") as stream:
            join(parts(journal.folder, members), stream, title, language)
        journal.write([Entry(name, key, {name: hash_of(aside)})])
        aside.replace(path)
    except BaseException:
        with suppress(OSError):
            aside.unlink()
        raise
    return path


def parts(folder: Path, members: Members) -> Iterator[PdfPart]:
    """The files of the students one after another, a bookmark where each student begins."""
    for variant, names in members:
        for number, name in enumerate(names):
            yield PdfPart(folder / name, "" if number else bookmark(variant))


def bookmark(variant: Variant) -> str:
    """What a student is called in the list beside the pages."""
    name = variant.name or variant.id
    return f"{name}, {variant.group}" if variant.group else name
