"""Every field and every cause has a meaning, also in a new lab's rubric."""

from __future__ import annotations

import re

import pytest

from graphkin.classroom.lab.items import all_fields
from graphkin.classroom.lab.lab_model import NAMES
from graphkin.classroom.lab.new_lab import causes, causes_of, meaning, new_lab
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.mechanism import load
from graphkin.text import words
from tests.classroom.lab.singles import LABS


def test_every_cause_has_one():
    assert tuple(causes()) == NAMES
    assert all(told and "*" not in told for told in causes().values())
    assert set(NAMES) == {
        key.removeprefix("cause.") for key in words("en").sentences if key.startswith("cause.")
    }


@pytest.mark.parametrize("name", LABS)
def test_every_field_of_a_lab_is_of_a_kind_that_has_one(name):
    assert all(map(meaning, all_fields(load(name)).values()))


def test_the_rubric_of_a_new_lab_has_every_field_and_the_causes_that_can_occur(tmp_path):
    """With all of them taken in the rubric is read, and none is missing."""
    new_lab("mine", tmp_path)
    path = tmp_path / "mine" / "lab.toml"
    text = path.read_text(encoding="utf-8")
    before = read_lab(tmp_path / "mine")
    path.write_text(re.sub(r'(?m)^# (\w+ = (?:[\d.]+|"\w+") )', r"\1", text), encoding="utf-8")
    lab = read_lab(tmp_path / "mine")
    fields = {name: meaning(item) for name, item in all_fields(load(lab.scene)).items()}
    assert set(lab.rubric.points) == set(fields)
    own = causes_of(load(lab.scene))
    assert set(lab.rubric.causes) == set(own)
    assert {"rpm_as_rad", "own_scale", "data_of_another"} <= set(own)
    never = {"driver_acceleration_missing", "curvature_reversed", "rad_as_rpm"}
    assert never.isdisjoint(own)
    assert before.rubric.causes == {}
    for name, told in (fields | own).items():
        assert re.search(rf'(?m)^(# )?{name} = ([\d.]+|"\w+") +# {re.escape(told)}$', text), name
