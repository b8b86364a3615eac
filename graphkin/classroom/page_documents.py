"""The page of a scene that is handed out, by view: as it draws itself, or as a task."""

from __future__ import annotations

from graphkin.documents.sheet_documents import language_of
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.text.errors import Problem, SceneError
from graphkin.web.step_page import Form, Tell, silent, step_page, task_page
from graphkin.web.your_turn import TurnOwner


def hand_out_page(
    mechanism: Mechanism,
    name: str,
    stem: str,
    view: str = "key",
    language: str | None = None,
    ink: Ink = "colour",
    tell: Tell = silent,
) -> str:
    """The page of a scene; ``name`` is that of its lab or file, ``stem`` begins that of its files.

    ``tell`` hears what is asked and cannot be read off. The task of a lab holds the form for
    answers. Raises as hand_out does, and SceneError for an overlay, which is laid on paper.
    """
    if view == "overlay":
        raise SceneError(
            Problem(
                "--view overlay",
                "is laid over a drawing on paper, and html is a page for a screen",
                "--format svg, pdf or dxf",
                "leave html out of --format, or write another --view; nothing is written",
            )
        )
    if view != "task":
        return step_page(mechanism, language, ink, TurnOwner(stem), tell)
    return task_page(mechanism, language, ink, answer_form(mechanism, name, stem, language), tell)


def answer_form(mechanism: Mechanism, name: str, stem: str, language: str | None) -> Form | None:
    """The form of a lab with a scene's data; None for a scene that is no lab."""
    folder = scene_files.folder(name)
    if folder is None:
        return None
    from graphkin.classroom import form_page
    from graphkin.classroom.lab.read_lab import read_lab

    words = language_of(mechanism, language)
    whose = form_page.Identity(stem=stem, memory=f"{stem} {words.language}")
    return form_page.lab_form(mechanism, read_lab(folder), words, whose)
