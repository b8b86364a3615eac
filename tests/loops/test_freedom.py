"""True mobility: what the count by Grübler gets wrong, the rank gets right."""

from __future__ import annotations

import cmath
import math

import pytest

from graphkin.loops.assemble import assemble
from graphkin.loops.freedom import idle, true_mobility
from graphkin.text.errors import StructureError, WitnessError
from tests.scene_files import scene_text

CRANKS = scene_text("loops/cranks")
SIDE = '[branches]\nC = "right of B-D"\n'
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


def test_any_of_three_parallel_cranks_is_idle_and_no_pin_alone(read):
    found = idle(read(CRANKS))
    assert found.links == ("1", "3", "4")
    assert set(found.joints.values()) == {1}
    assert len(found.joints) == 6
    four_bar = CRANKS.replace("[links.4]\nF-E = 2\n", "")
    assert idle(read(four_bar)) == ({}, ())


def test_a_third_crank_of_another_length_does_not_close(read):
    with pytest.raises(WitnessError, match="close"):
        assemble(read(CRANKS.replace("F-E = 2", "F-E = 2.01") + SIDE))


def test_where_no_position_is_given_one_is_found(read):
    assert true_mobility(read(CRANKS)) == 1
    assert true_mobility(read(TRAMMEL)) == 1
    assert true_mobility(read(WEDGES)) == 1


def test_bar_to_the_middle_of_the_trammel(read):
    start = {"A": 1 + 0j, "B": 1j * math.sqrt(3), "M": 0.5 + 0.5j * math.sqrt(3)}
    scene = read(TRAMMEL)
    assert true_mobility(scene, start) == 1
    assert "4" in idle(scene, start).links


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


def test_oldham_turns_alike_at_both_ends(read, solved):
    scene = read(scene_text("loops/oldham-2"))
    found = solved(scene, P=0.75 + 0.43j)
    omega = found.motion.omega[0]
    assert omega[2] == omega[3] == pytest.approx(5)
    sliding = max(abs(found.motion.slide(j).speed[0]) for j in (0, 1))
    assert sliding <= 5 * 1 + 1e-12
