"""A batch of variants is drawn at the scales of their own sheets, each and every one."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from graphkin import load
from graphkin.classroom.lab.fairness import loader
from graphkin.classroom.lab.variant_scales import by_arrays, scaling
from graphkin.documents.scaling import scales
from graphkin.text.errors import GraphkinError
from tests.classroom.lab.singles import LABS, SCENES, lab_of

BY_ARRAYS = [(lab, "n", range(1, 31, 2)) for lab in LABS] + [
    (SCENES / "crank-slot.toml", "angle", range(0, 345, 30)),
    (SCENES / "oscillating-slide.toml", "angle", range(0, 345, 30)),
    (SCENES / "crank-rocker.toml", "n", range(0, 24, 2)),
]
ONE_BY_ONE = [
    (SCENES / "gears-planet.toml", "angle", range(0, 345, 90)),
    (SCENES / "rapid-return-slider.toml", "y", range(-116, -96, 8)),
]


def held(name: str | Path, parameter: str, values: range) -> None:
    """Hold the scales of a batch against those of each variant's own sheets."""
    mechanism = load(name)
    many = [{parameter: Fraction(value)} for value in values]
    arrays = {**mechanism.scene.values, parameter: np.array(values, dtype=float)}
    lab = lab_of(Path(mechanism.scene.source))
    found = scaling(mechanism, arrays, len(many), loader(lab, many))
    for i, given in enumerate(many):
        try:
            own = scales(load(name, **given))
        except GraphkinError:
            assert np.isnan(found.kL[i])
            continue
        assert (found.kL[i], bool(found.triangles[i])) == (own.kL, own.triangles)
        assert found.seconds[i] == pytest.approx(own.seconds, rel=1e-12)
        for kind in ("velocity", "acceleration"):
            stands = {"velocity": own.kv, "acceleration": own.ka}[kind]
            assert found.stands(kind)[i] == pytest.approx(stands, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "parameter", "values"), BY_ARRAYS[::2], ids=lambda v: str(v)[-22:]
)
def test_a_cranks_batch_has_the_scales_of_its_sheets(name, parameter, values):
    assert by_arrays(load(name))
    held(name, parameter, values)


@pytest.mark.parametrize(("name", "parameter", "values"), ONE_BY_ONE, ids=lambda v: str(v)[-22:])
def test_what_no_crank_scales_is_asked_one_by_one(name, parameter, values):
    assert not by_arrays(load(name))
    held(name, parameter, values)


def with_sheet(tmp_path: Path, line: str) -> Path:
    """A lab with one more line in its [sheet]."""
    text = Path(load("offset-slider-crank").scene.source).read_text(encoding="utf-8")
    path = tmp_path / "offset-slider-crank.toml"
    path.write_text(f"{text.rstrip()}\n{line}\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("line", ["scale = 10", "ka = 0.5", "enlarge = 2"])
def test_what_the_scene_states_holds_for_a_batch(tmp_path, line):
    held(with_sheet(tmp_path, line), "n", range(1, 31, 7))
