"""Two guides of one block on one link: on one line the second is idle, else no block is on both."""

from __future__ import annotations

import pytest

from graphkin.structure.driver_count import impossible
from tests.mechanisms import scene_of

BLOCK = """
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
B = [1, 0]
slides = [
  {{ on = 0, through = "O", angle = 20, offset = {first} }},
  {{ on = 0, through = "O", angle = {angle}, offset = {second} }},
]
[[drivers]]
slide = 1
position = 10
speed = 4
"""


@pytest.mark.parametrize(
    ("angle", "first", "second", "hinders"),
    [
        (20, 4, 4, ""),
        (200, 4, -4, ""),  # the other way along the same line: its left is the first one's right
        (20, 4, 9, "are parallel, 5 mm apart"),
        (200, 4, 4, "are parallel, 8 mm apart"),
        (20, 0, 1e-7, ""),
        (20, 0, 1e-5, "are parallel, 1e-05 mm apart"),
        (21, 4, 4, "cross, so that the block is held fast"),
    ],
)
def test_guides_of_one_block_lie_on_one_line(angle, first, second, hinders):
    text = BLOCK.format(angle=angle, first=first / 1000, second=second / 1000)  # in metres
    found = impossible(scene_of(text))
    assert [each.place for each in found] == ["links.1.slides"] * bool(hinders)
    assert all(hinders in each.found for each in found)
