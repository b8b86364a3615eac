"""The files of a scene's sheets, in every form in which these are handed out."""

from __future__ import annotations

from collections.abc import Collection

from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism


def sheet_files(
    mechanism: Mechanism,
    name: str,
    stem: str,
    view: str,
    language: str | None,
    kinds: Collection[str],
    ink: Ink = "colour",
) -> tuple[dict[str, bytes], list[str]]:
    """The files by name, and notes of what is asked and cannot be read off.

    ``name`` is that of the scene's lab or file, ``stem`` begins the names of its files; ``kinds``
    are svg, pdf, dxf, html and pmks. Raises as hand_out, hand_out_page and pmks_file do.
    """
    files: dict[str, bytes] = {}
    notes: list[str] = []
    if "html" in kinds:
        from graphkin.classroom.page_documents import hand_out_page

        page = hand_out_page(mechanism, name, stem, view, language, ink, notes.append)
        files[f"{stem}-{view}.html"] = page.encode("utf-8")
    if "pmks" in kinds:
        from graphkin.documents.pmks_file import pmks_file

        files[f"{stem}.pmks"] = pmks_file(mechanism)
    if {*kinds} - {"html", "pmks"}:
        from graphkin.documents.sheet_documents import hand_out
        from graphkin.writers.files import rendered

        notes.clear()  # those of the paper are the same
        for part in hand_out(mechanism, view=view, language=language):
            notes += part.unread
            own, steps = f"{stem}-{part.kind}-{view}", view == "steps"
            files |= rendered(own, part.kind, part.pages, kinds, ink, steps=steps)
    return files, notes
