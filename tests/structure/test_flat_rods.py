"""Coupled wheels with a second rod a quarter ahead: where one lies flat the other is taken."""

import re

import pytest

from graphkin.construction.compile import laid
from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Tie
from tests.scene_files import scene_text

TEXT = scene_text("structure/coupled-wheels-in-line")
FIRST, SECOND = "[links.3]\nA-B = 160\n", "[links.4]\nC-D = 160\n"


def standing(angle, text=TEXT):
    text = re.sub(r"angle = 0\n", f"angle = {angle}\n", text)
    return Mechanism(read_text(text, "scene", None, {}))


def written_last_first():
    assert FIRST in TEXT and SECOND in TEXT
    text = TEXT.replace(FIRST, "@").replace(SECOND, FIRST).replace("@", SECOND)
    return text.replace('B = "left of A-O2"', 'D = "left of C-O2"')


THREE = """
graphkin = 1
title = "Three equal cranks under one rod"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O1 = [0, 0]
O2 = [110, 0]
O3 = [200, 0]
[links.1]
O1-A = 60
[links.2]
O2-B = 60
[links.3]
O3-C = 60
[links.4]
A-B = 110
B-C = 90
C = "beyond B on A-B"
[[drivers]]
turn = 1
angle = ANGLE
speed = 10
acceleration = 3
[branches]
B = "left of A-O2"
"""


@pytest.mark.parametrize(("angle", "idle"), [(0, "34"), (40, "4"), (180, "34")])
def test_a_flat_rod_is_idle_and_the_direction_of_its_wheel_known(angle, idle):
    groups, _ = laid(standing(angle).scene, standing(angle).groups)
    assert "".join(group.link for group in groups if isinstance(group, Tie)) == idle


@pytest.mark.parametrize("angle", [0, 50, 180])
@pytest.mark.parametrize("stated", [True, False])
def test_a_rod_on_three_cranks_shifts_in_every_position(angle, stated):
    """With all pins in line, too, and whether or not the side is written."""
    text = THREE if stated else THREE[: THREE.index("[branches]")]
    mechanism = Mechanism(read_text(text.replace("ANGLE", str(angle)), "scene", None, {}))
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    assert solution.links["4"].omega == pytest.approx(0, abs=1e-12)
    assert solution.links["3"].omega == pytest.approx(10)
    assert solution.links["3"].epsilon == pytest.approx(3)


@pytest.mark.parametrize("text", [TEXT, THREE.replace("ANGLE", "50")])
def test_a_turn_has_all_rows(text):
    """No row is left out where the rods are in line, and the check is sure of them."""
    found = cycle(Mechanism(read_text(text, "scene", None, {})), steps=8)
    assert list(found.at) == [*range(0, 360, 45)]
    assert found.path.returns and not found.singulars
    assert found.witnessed.agrees.all() and not found.witnessed.unsure


@pytest.mark.parametrize("angle", [0, 180])
def test_both_wheels_turn_alike_with_a_rod_flat(angle):
    mechanism = standing(angle)
    solution = mechanism.solve()
    assert mechanism.witness(solution).agrees
    assert solution.links["2"].omega == pytest.approx(12)
    assert solution.links["2"].epsilon == pytest.approx(5)


def test_it_does_not_matter_which_rod_is_written_first():
    one = standing(0).solve().points
    other = standing(0, written_last_first()).solve().points
    for point in "ABCD":
        assert one[point].velocity == pytest.approx(other[point].velocity)
        assert one[point].acceleration == pytest.approx(other[point].acceleration)
