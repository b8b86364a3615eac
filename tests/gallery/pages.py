"""What is shown in the gallery: the labs and scenes, and the pages of each."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.style import Ink
from graphkin.mechanism import load
from graphkin.scene.scene_files import names
from graphkin.text import LANGUAGES
from graphkin.text.errors import GraphkinError
from tests.gallery.pixels import picture, side_by_side

if TYPE_CHECKING:
    import numpy as np

    from graphkin.drawing.marks import Page

__all__ = ["LANGUAGES", "VIEWS", "Subject", "pages_of", "row_of", "subjects"]

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
STUDENTS = (1, 10, 20, 30)
VIEWS = ("key", "task", "steps", "overlay", "calculation")
"""The views of the sheets, and the calculation pages of the key."""


@dataclass(frozen=True)
class Subject:
    """A lab for a student's number, or an example scene."""

    name: str
    n: int | None = None

    @property
    def title(self) -> str:
        """Its name with what is set: pump-n7."""
        return self.name if self.n is None else f"{self.name}-n{self.n}"


def subjects() -> list[Subject]:
    """Every lab with some students' numbers, then every example scene."""
    labs = [Subject(name, n) for name in names() for n in STUDENTS]
    return labs + [Subject(path.stem) for path in sorted(SCENES.glob("*.toml"))]


def pages_of(subject: Subject, view: str, language: str) -> dict[str, tuple[Page, ...]]:
    """The pages of each sheet of a subject by its kind; of pages that grow the last."""
    if subject.n is None:
        mechanism = load(str(SCENES / f"{subject.name}.toml"))
    else:
        mechanism = load(subject.name, n=subject.n)
    sheets = hand_out(mechanism, view if view != "calculation" else "key", language)
    if view == "calculation":
        return {sheet.kind: sheet.pages for sheet in sheets if sheet.kind == view}
    return {sheet.kind: sheet.pages[-1:] for sheet in sheets if sheet.kind != "calculation"}


def row_of(subject: Subject, view: str, language: str, ink: Ink, dpi: float) -> np.ndarray:
    """The pages of a subject side by side. Raises GraphkinError, which names the subject."""
    try:
        sheets = pages_of(subject, view, language)
    except GraphkinError as error:
        raise SystemExit(f"{subject.title}: {error}") from error
    pages = [page for pages in sheets.values() for page in pages]
    return side_by_side([picture(page, ink, dpi) for page in pages])
