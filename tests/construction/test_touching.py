"""Variants in which two loci touch: in a batch none, for no digit of their velocities is right."""

from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.scene_files import scene_text

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


@pytest.mark.parametrize("count", [25, 5_000])
@pytest.mark.parametrize("kind", ["float64", "float32"])
def test_a_parallelogram_on_its_line_is_no_number(count, kind):
    """At half turns all four pins lie in line; everywhere else both cranks turn alike."""
    angles = np.resize(np.arange(0.0, 361.0, 15.0), count)
    found = moving(angles, kind)
    in_line = angles % 180 == 0
    assert np.isnan(found[in_line]).all()
    assert abs(found[~in_line] - 10) == pytest.approx(0, abs=1e-3 if kind == "float32" else 1e-11)


def moving(angles, kind):
    """The rate of the follower of a parallelogram for each angle of the driver in degrees."""
    text = scene_text("construction/parallelogram-on-its-line")
    upper = Mechanism(read_text(text, "parallelogram"))
    lower = Mechanism(read_text(text.replace("left of", "right of"), "parallelogram"))
    one, other = (m.batch(at=angles, kind=kind).links["3"].omega for m in (upper, lower))
    return np.where(angles % 360 < 180, one, other)
