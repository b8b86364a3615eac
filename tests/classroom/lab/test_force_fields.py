"""A form has no fields for forces, and none for motions that only forces need."""

from __future__ import annotations

from pathlib import Path

from graphkin.classroom.lab.items import asked_fields
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text

SCENES = Path(__file__).parents[2] / "scenes" / "forces"


def test_a_scene_that_asks_for_forces_alone_has_no_fields():
    assert asked_fields(load(SCENES / "four-bar.toml")) == {}


def test_a_scene_that_asks_for_nothing_has_a_field_for_every_motion():
    text = (SCENES / "four-bar.toml").read_text(encoding="utf-8").partition("[ask]")[0]
    fields = asked_fields(Mechanism(read_text(text, "all", None, {})))
    assert {"v_A", "a_B", "omega_3"} <= fields.keys()


def test_its_motions_are_those_of_masses_and_loads():
    targets = load(SCENES / "four-bar.toml").asked()
    assert set(targets) == {
        *(("velocity", each) for each in ("S2", "S3")),
        *(("acceleration", each) for each in ("S2", "S3")),
        *(("epsilon", each) for each in ("2", "3")),
        ("omega", "3"),
    }
