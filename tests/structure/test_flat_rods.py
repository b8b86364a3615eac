"""Coupled wheels with a second rod a quarter ahead: where one lies flat the other is taken."""

import re

import pytest

from graphkin.construction.flat_rods import laid
from graphkin.mechanism import Mechanism
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


@pytest.mark.parametrize(("angle", "idle"), [(0, "3"), (40, "4"), (180, "3")])
def test_the_rod_that_lies_flat_is_the_idle_one(angle, idle):
    groups, _ = laid(standing(angle).scene, standing(angle).groups)
    assert [group.link for group in groups if isinstance(group, Tie)] == [idle]


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
