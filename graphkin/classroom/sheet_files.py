"""The files of a scene's sheets, in every format."""

from __future__ import annotations

from collections.abc import Collection

from graphkin.documents import MOTION_VIEWS
from graphkin.documents.sheet_documents import CALCULATED, calculation_text, language_of
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.text.errors import SceneError, message
from graphkin.web.step_page import Form, Tell, force_page, silent, step_page, task_page
from graphkin.web.your_turn import TurnOwner


def sheet_files(
    mechanism: Mechanism,
    name: str,
    stem: str,
    view: str,
    language: str | None,
    kinds: Collection[str],
    ink: Ink = "colour",
) -> tuple[dict[str, bytes], list[str]]:
    """The files by name, and notes on quantities that are asked for but cannot be read off.

    ``name`` is the name of the scene's lab or file; ``stem`` begins the names of the new files.
    ``kinds`` are svg, pdf, dxf, tikz, tex, html and pmks. Raises as hand_out, hand_out_page and
    pmks_file do.
    """
    files: dict[str, bytes] = {}
    notes: list[str] = []
    if "html" in kinds:
        page = hand_out_page(mechanism, name, stem, view, language, ink, notes.append)
        files[f"{stem}-{view}.html"] = page.encode("utf-8")
    if "pmks" in kinds:
        from graphkin.documents.program_files import pmks_file

        files[f"{stem}.pmks"] = pmks_file(mechanism, message("leave pmks out"))
    if "tex" in kinds and view in CALCULATED:
        text = calculation_text(mechanism, view, language)
        files[f"{stem}-calculation-{view}.tex"] = text.encode("utf-8")
    if {*kinds} - {"html", "pmks", "tex"}:
        from graphkin.documents.sheet_documents import hand_out
        from graphkin.writers.files import rendered

        notes.clear()  # the notes of the page, which hand_out repeats
        for part in hand_out(mechanism, view=view, language=language):
            notes += part.unread
            own, steps = f"{stem}-{part.kind}-{view}", view == "steps"
            files |= rendered(own, part.kind, part.pages, kinds, ink, steps=steps)
    given = mechanism.scene.forces
    if "html" in kinds and view not in MOTION_VIEWS and given is not None and given.asked:
        if view == "task":
            from graphkin.web.paper_page import force_task

            page = force_task(mechanism, language, ink)
        else:
            page = force_page(mechanism, language, ink, TurnOwner(f"{stem}-force"))
        files[f"{stem}-force-{view}.html"] = page.encode("utf-8")
    return files, notes


# --- the web page of a scene, by view: it draws itself, is a task, or shows the motion -----------


def hand_out_page(
    mechanism: Mechanism,
    name: str,
    stem: str,
    view: str = "key",
    language: str | None = None,
    ink: Ink = "colour",
    tell: Tell = silent,
) -> str:
    """The web page of a scene.

    ``name`` is the name of its lab or file, ``stem`` begins the names of its files. ``tell``
    receives notes on what is asked for but cannot be read off. The task of a lab contains the form
    for answers. Raises as hand_out does, and SceneError for an overlay, which is laid on paper.
    """
    if view == "overlay":
        raise SceneError.at(
            "--view overlay",
            message("is laid over a drawing on paper, and html is a page for a screen"),
            message("--format svg, pdf or dxf"),
            message("leave html out of --format, or write another --view; nothing is written"),
        )
    if view in MOTION_VIEWS:
        from graphkin.web.paper_page import motion_page

        return motion_page(mechanism, view, language, ink)
    if view != "task":
        return step_page(mechanism, language, ink, TurnOwner(stem), tell)
    return task_page(mechanism, language, ink, answer_form(mechanism, name, stem, language), tell)


def answer_form(mechanism: Mechanism, name: str, stem: str, language: str | None) -> Form | None:
    """The form of a lab with a scene's data; None for a scene that is not a lab."""
    folder = scene_files.folder(name)
    if folder is None:
        return None
    from graphkin.classroom import form_page
    from graphkin.classroom.lab.read_lab import read_lab

    lab = read_lab(folder, house=mechanism.scene.house)
    words = language_of(mechanism, language)
    whose = form_page.Identity(stem=stem, memory=f"{stem} {words.language}")
    return form_page.lab_form(mechanism, lab, words, whose)
