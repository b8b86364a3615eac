"""Groups that no construction takes are refused, each by its own limit."""

import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import StructureError

HEAD = """
graphkin = 1
title = "limit"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
LEG = """
[links.{rod}]
A{n} = [0, 0]
[links.{block}]
B{n} = [0, 0]
slides = {{ on = {rod}, through = "A{n}", angle = 0 }}
[[drivers]]
slide = {block}
against = {rod}
position = 130
speed = 10
"""
CYLINDERS = (
    HEAD
    + "[frame]\nA1 = [0, 0]\nA2 = [300, 0]\nA3 = [150, 260]\n"
    + "".join(LEG.format(n=n, rod=2 * n - 1, block=2 * n) for n in (1, 2, 3))
    + '[links.7]\nB1-B2 = 100\nB1-B3 = 100\nB2-B3 = 100\nB3 = "left of B1-B2"\n'
)
ROLLER = """
[links.{n}]
{p} = [0, 0]
wheel = {{ centre = "{p}", radius = 20 }}
rolls = [{{ on = 0, through = "O", angle = 0 }}, {{ on = 3, through = "A", angle = 0 }}]
"""
PLANK = (
    HEAD
    + "[frame]\nO = [0, 0]\n"
    + ROLLER.format(n=1, p="P")
    + ROLLER.format(n=2, p="Q")
    + "[links.3]\nA = [0, 0]\n[[drivers]]\nroll = 1\nposition = 130\nspeed = 10\n"
)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (CYLINDERS, "close only with 3 drivers at once: link 2 on 1, link 4 on 3, link 6 on 5"),
        (PLANK, "hold link 3, a straight track, by wheels and pins alone"),
    ],
)
def test_a_limit_is_named(text, found):
    with pytest.raises(StructureError) as error:
        Mechanism(read_text(text, "limit")).solve()
    assert [problem.found for problem in error.value.problems] == [found]
