"""The data of a sheet state slides, wheels, drivers of every kind and the starts of rolling."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.documents.made_up import HEAD, made_up
from tests.scene_files import scene_text

SCENES = {
    "slides on moving links": (
        scene_text("documents/slides-on-moving-links"),
        {"O": 0j, "Q": -100j, "A": 40 + 0j, "B": 100j, "C": 30j, "D": 50j},
    ),
    "drivers of every kind": (
        scene_text("documents/drivers-of-every-kind"),
        {"O": 0j, "A": 40 + 0j, "B": 40 + 30j, "C": 25 + 0j, "D": 20j},
    ),
    "gears": (scene_text("documents/symbols-data-gears"), {"O": 0j, "P": 80 + 0j, "B": -40j}),
}


def said(name: str, language: str = "en") -> list[str]:
    """The data of a scene as plain text."""
    drawing = made_up(*SCENES[name])
    spoken = Drawing(
        drawing.kind, drawing.scene, drawing.trace, drawing.scales, drawing.verdict, words(language)
    )
    return [plain(piece) for piece in given(spoken)]


def test_a_closure_is_counted_by_a_link_that_no_driver_holds():
    """The driven coupler is written first, yet its angle is the same in both closures."""
    text = scene_text("documents/counted-closure")
    clamp = Mechanism(read_text(HEAD + text, "clamp", None, {}))
    (drawing, *_) = drawings_of(clamp, proved(clamp, clamp.solve()), words("en"))
    closes = "of the possible assemblies of links arm, handle, link take number 1"
    found = [plain(piece) for piece in given(drawing)]
    assert f"{closes}, counted by the angle of AB from 0° to 360°" in found


def test_every_driver_has_its_position_speed_and_acceleration_with_units():
    found = said("drivers of every kind")
    for piece in (
        "φ1 = 30°",
        "φ2/1 = 40°",
        "ω2/1 = 3 rad/s, clockwise",
        "ε2/1 = 7 rad/s², counter-clockwise",
        "s3 = 25 mm",
        "v3 = 60 mm/s",
        "a3 = −80 mm/s²",
        "s4 = 12 mm",
        "v4 = 50 mm/s",
        "a4 = 5 mm/s²",
    ):
        assert piece in found, (piece, found)
