"""A lab is made from a lecturer's own scene: the scene unchanged, a rule that is fair to all."""

from __future__ import annotations

import re

import pytest

from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.items import all_fields, asked_fields
from graphkin.classroom.lab.new_lab import lab_from
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.text.errors import SceneError
from tests.running import ran

FOUR_BAR = """\
graphkin = 1
title = "Four-bar"
units = { length = "mm", angle = "deg", speed = "rev/min" }
[parameters]
phi = { value = 60, min = 0, max = 170, step = 5 }
[frame]
O = [0, 0]
C = [120, 0]
[links.1]
O-A = 40
[links.2]
A-B = 100
[links.3]
B-C = 80
[[drivers]]
turn = 1
angle = "phi"
speed = 60
[branches]
B = "left of A-C"
[ask]
velocity = ["B"]
omega = [2]
"""


def test_the_scene_is_kept_and_every_drawn_variant_is_fair(tmp_path):
    own = tmp_path / "mine.toml"
    own.write_bytes(FOUR_BAR.replace("\n", "\r\n").encode())
    lab_from(own, "mine", tmp_path)
    lab = read_lab(tmp_path / "mine")
    assert lab.scene.read_bytes() == own.read_bytes()
    angles = lab.rule.draws["phi"]
    assert 1 < len(angles) < 35  # 35 are allowed; at some of them a crossing is too flat
    every = [{"phi": angles.value(k)} for k in range(len(angles))]
    assert judged(lab, every).fair.all()
    assert set(lab.rubric.points) == set(asked_fields(lab.mechanism))
    text = (tmp_path / "mine" / "lab.toml").read_text(encoding="utf-8")
    fields = all_fields(lab.mechanism)
    halves = {name for name in fields if f"{name} = 0.5" in text}
    assert all(f"{name} = 1" in text for name in fields if name not in halves)
    assert halves == {name for name in fields if name.endswith("_sense")}
    assert lab.fair.apart is not None


def test_a_scene_without_a_range_is_told_how_to_write_one(tmp_path):
    own = tmp_path / "mine.toml"
    own.write_text(FOUR_BAR.replace(", min = 0, max = 170, step = 5", ""), encoding="utf-8")
    with pytest.raises(SceneError, match=r"no parameter has min and max.*min = …, max = …"):
        lab_from(own, "mine", tmp_path)
    assert not (tmp_path / "mine").exists()


TURNED = FOUR_BAR.replace('"phi"', "61.5")
WITHOUT = re.sub(r"\[parameters\]\n.*\n", "", TURNED)
FIXED = TURNED.replace(", min = 0, max = 170, step = 5", "")
SLID = """\
graphkin = 1
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[links.2]
A-B = 100
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 90 }
[[drivers]]
slide = 1  # to the right
position = 45
speed = 30
[branches]
3 = "forward"
[ask]
velocity = ["B"]
"""


@pytest.mark.parametrize(
    ("text", "name", "old"),
    [
        (WITHOUT, "phi", 60),
        (WITHOUT.replace("\n", "\r\n"), "phi", 60),
        (FIXED, "phi_1", 60),
        (SLID, "s", 45),
    ],
)
def test_a_scene_without_a_parameter_gets_one_for_its_driver(tmp_path, text, name, old):
    """The other bytes stay; students then differ in the position of the driver."""
    own = tmp_path / "mine.toml"
    own.write_bytes(text.encode())
    made = ran("new", "lab", "mine", "--from", str(own), "-o", str(tmp_path))
    assert made.exit_code == 0, made.output
    assert name in made.output
    lab = read_lab(tmp_path / "mine")
    (own_name,) = lab.rule.draws
    assert own_name == name
    assert f"{name} = {{ value = {old}, " in lab.scene.read_text()
    assert len({float(lab.rule.draws[name].value(k)) for k in range(len(lab.rule.draws[name]))}) > 5
    kept = [line for line in text.splitlines() if not line.startswith(("angle", "position"))]
    assert [line for line in lab.scene.read_bytes().decode().splitlines() if line in kept] == kept


def test_the_command_makes_it_and_refuses_to_replace_it(tmp_path):
    own = tmp_path / "mine.toml"
    own.write_text(FOUR_BAR, encoding="utf-8")
    order = ("new", "lab", "mine", "--from", str(own), "-o", str(tmp_path))
    made, again = ran(*order), ran(*order)
    assert made.exit_code == 0 and "different data" in made.output
    assert again.exit_code == 2 and "--force" in again.output
