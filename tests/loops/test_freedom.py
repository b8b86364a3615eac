"""True mobility: what the count by Grübler gets wrong, the rank gets right."""

from __future__ import annotations

import cmath
import math

import pytest

from graphkin.loops.assemble import true_mobility
from graphkin.text.errors import StructureError
from tests.scene_files import scene_text

CRANKS = scene_text("loops/cranks")
TRAMMEL = scene_text("loops/trammel-2")
WEDGES = scene_text("loops/wedges")


def on_circle(centre, radius, degrees):
    return centre + cmath.rect(radius, math.radians(degrees))


def test_third_parallel_crank(read, solved):
    scene = read(CRANKS)
    start = {"B": on_circle(0, 2, 60), "C": on_circle(3, 2, 60), "E": on_circle(1, 2, 60)}
    assert true_mobility(scene, start) == 1
    motion = solved(scene, **start).motion
    for link, omega in (("1", 3), ("2", 0), ("3", 3), ("4", 3)):
        assert motion.omega[0, motion.index[link]] == pytest.approx(omega, abs=1e-12)


def test_bar_to_the_middle_of_the_trammel(read):
    start = {"A": 1 + 0j, "B": 1j * math.sqrt(3), "M": 0.5 + 0.5j * math.sqrt(3)}
    scene = read(TRAMMEL)
    assert true_mobility(scene, start) == 1


def test_wedges(read, solved):
    scene = read(WEDGES)
    assert true_mobility(scene, {"P": 0j, "Q": 1 + 1j / math.sqrt(3)}) == 1
    motion = solved(scene, P=0j, Q=1 + 0.6j).motion
    assert motion.point("Q").velocity[0] == pytest.approx(-2j / math.sqrt(3))


def test_pump_five_bar_and_a_frame(sheet, read, pump_start):
    assert true_mobility(sheet("pump", n=7), pump_start) == 1
    chain = "[frame]\nO = [0, 0]\n[links.1]\nO-A = 2\n[links.2]\nA-B = 1\n"
    drivers = "[[drivers]]\nturn = 1\nangle = 0\nspeed = 1\n"
    assert true_mobility(read(chain + drivers), {"A": 2 + 0j, "B": 3 + 0j}) == 2
    truss = chain.replace("O = [0, 0]\n", "O = [0, 0]\nB = [2, 2]\n", 1)
    assert true_mobility(read(truss + drivers), {"A": 2 + 1j}) == 0


def test_an_angle_that_the_scene_does_not_say_is_named(read):
    """A cross on the slots of two turning discs: its second slot has no angle to the first."""
    scene = read(scene_text("loops/angle-not-said"))
    with pytest.raises(StructureError, match="write link 2 as the block that slides on 3"):
        true_mobility(scene, {"P": 0.75 + 0.43j})
