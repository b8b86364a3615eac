"""The data of a sheet state slides, wheels, drivers of every kind and the starts of rolling."""

from __future__ import annotations

import pytest

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
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
    "gears": (
        scene_text("documents/symbols-data-gears"),
        {"O": 0j, "P": 80 + 0j, "B": -40j},
    ),
}


def said(name: str, language: str = "en") -> list[str]:
    """The data of a scene as plain text."""
    drawing = made_up(*SCENES[name])
    spoken = Drawing(
        drawing.kind,
        drawing.scene,
        drawing.trace,
        drawing.scales,
        drawing.verdict,
        words(language),
    )
    return [plain(piece) for piece in given(spoken)]


def test_a_guide_on_a_moving_link_is_told_in_the_axes_of_that_link():
    found = said("slides on moving links")
    beside = "A slides parallel to QB, 5 mm to the right of it"
    assert f"{beside}, the farther of the two places along it" in found
    slot = "pin C slides in a slot along the line of link 3 through (20; 10) mm at 30° to QB"
    assert slot in found
    beside = "pin D slides in a slot parallel to QB, 8 mm to the left of it (positive from Q to B)"
    assert beside in found


def test_a_closure_is_counted_by_a_link_that_no_driver_holds():
    """The driven coupler is written first, yet its angle is the same in both closures."""
    text = scene_text("documents/counted-closure")
    clamp = Mechanism(read_text(HEAD + text, "clamp", None, {}))
    (drawing, *_) = drawings_of(clamp, proved(clamp, clamp.solve()), words("en"))
    closes = "of the ways in which links arm, handle, link close take number 1"
    found = [plain(piece) for piece in given(drawing)]
    assert f"{closes}, counted by the angle of AB from 0° to 360°" in found


def test_every_driver_has_its_position_speed_and_acceleration_with_units():
    found = said("drivers of every kind")
    for piece in (
        "φ1 = 30°",
        "φ2/1 = 40°",
        "ω2/1 = 3 rad/s, turning clockwise",
        "ε2/1 = 7 rad/s², turning counter-clockwise",
        "s3 = 25 mm",
        "v3 = 60 mm/s",
        "a3 = −80 mm/s²",
        "s4 = 12 mm",
        "v4 = 50 mm/s",
        "a4 = 5 mm/s²",
    ):
        assert piece in found, (piece, found)


def test_rolling_states_its_start_and_that_nothing_slips():
    found = said("drivers of every kind")
    assert "wheel 4: centre D, r = 20 mm" in found
    rolls = "wheel 4 rolls in T on the line through O at 10° to the x axis, on its right-hand side"
    start = "touching it at O when the x axis of link 4 is at 45° (positive from O to the right)"
    assert f"{rolls}, {start}" in found
    assert found.count("no slip is assumed: the position depends on the start") == 1


def test_gears_state_teeth_and_module_and_what_they_mesh_with():
    found = said("gears")
    assert "inner gear of the frame: centre O, z = 60, m = 4 mm" in found
    assert "gear planet: centre P, z = 20, m = 4 mm" in found
    meshes = "gear planet meshes in T1 with the fixed gear (starting position: OP is at 0°"
    assert f"{meshes}, the x axis of link planet is at 90°)" in found
    assert any(piece.startswith("gear sun meshes in T2 with gear planet") for piece in found)
    rack = "wheel pinion rolls in T3 on the line of link rack through B at 0° to the x axis"
    assert any(piece.startswith(rack) for piece in found)


def test_a_mechanism_without_wheels_does_not_speak_of_slip():
    assert not [piece for piece in said("slides on moving links") if "slip" in piece]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", SCENES)
def test_the_data_can_be_said_in_every_language(name, language):
    found = said(name, language)
    assert len(found) == len(said(name)) and not [piece for piece in found if "{" in piece]
