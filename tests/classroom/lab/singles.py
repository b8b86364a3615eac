"""The sheets of one variant at a time, against which the arrays are held."""

from __future__ import annotations

from pathlib import Path

from graphkin import load
from graphkin.classroom.lab.lab_model import Fair, Lab, LabRule, Range, Rubric, Settings
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.solution import Verdict
from graphkin.documents.sheet_documents import drawings_of
from graphkin.mechanism import Mechanism
from graphkin.text import words

ROOT = Path(__file__).resolve().parents[3]
SCENES = ROOT / "examples" / "scenes"
LABS = ("pump", "pump-collinear", "offset-slider-crank", "slotted-lever")
NOBODY = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)


def mechanism_of(name: str | Path, given: Settings) -> Mechanism:
    """One variant of a lab or a scene."""
    return load(name, **given)


def sheets_of(mechanism: Mechanism) -> list[Drawing]:
    """The drawings of one variant's sheets, at its own scales."""
    return drawings_of(mechanism, NOBODY, words("en"))


def lab_of(scene: Path, fair: Fair = Fair(), **draws: Range) -> Lab:  # noqa: B008
    """A lab that draws from ranges, beside any scene."""
    return Lab(scene.stem, scene.parent, scene, LabRule("a course", draws), fair, Rubric())


__all__ = ["LABS", "NOBODY", "ROOT", "SCENES", "lab_of", "mechanism_of", "sheets_of"]
