"""Whole turns of wheels in a group that is tried: both routes count them by one rule."""

from __future__ import annotations

import cmath
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

from graphkin.loops.newton import counted_freely
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import ClosureError
from tests.examples.scenes import FOLDER as SCENES
from tests.scene_files import FOLDER, scene_text

TRAINS = (
    (("G", "H"), 25, 80, ("M", "N")),
    (("A", "B"), 25, -30, ("Q", "R")),
)
"""Two points of the link that a sun is driven against, the angles of sun and arm, the planet."""


@pytest.mark.parametrize(
    ("name", "number"), [("two-gear-crank", 1), ("two-gear-crank-arm-last", 2)]
)
def test_a_wheel_that_its_arm_leads_may_turn_farther_than_half_round(name, number):
    """The arm stands at -128° from its start, the wheel on it then at -411°."""
    text = scene_text(name)
    found = Mechanism(read_text(text.replace("closure 1", f"closure {number}"), name))
    verdict = found.witness(found.solve())
    assert verdict.branches == ()
    assert verdict.agrees


def test_the_two_gear_crank_stands_alike_whichever_of_its_links_is_written_first():
    """Four-bar and Willis: 30 φ2 + 45 φ4 = 75 φ3, solved by hand to all digits of a double."""
    first, last = (load(FOLDER / f"two-gear-crank{end}.toml").solve() for end in ("", "-arm-last"))
    for point in "ABM":
        assert first.points[point].position == pytest.approx(last.points[point].position)
        assert first.points[point].velocity == pytest.approx(last.points[point].velocity)
    arm, rod = (first.links[link].omega for link in ("3", "2"))
    assert 30 * rod + 45 * 10 == pytest.approx(75 * arm)


def test_a_group_closes_alike_whichever_of_its_wheels_is_written_first():
    """Tried round the large wheel: round the small one only a third of its turn would be found."""
    text = scene_text("geared-five-bar-from-its-coupler")
    frame, one, two, rest = re.split(r"(?=\[links\.[123]\])", text)
    swapped = "".join([frame, two, one, rest])
    for each in (text, swapped):
        assert Mechanism(read_text(each, "made")).groups[1].tried.link == "2"
    with pytest.raises(ClosureError, match="close in 6 ways"):
        Mechanism(read_text(swapped.replace("closure 1", "closure 99"), "made")).solve()


def test_the_witness_counts_a_small_wheel_beyond_half_a_turn():
    found = load(FOLDER / "geared-five-bar-from-its-coupler.toml")
    assert found.witness(found.solve()).agrees


@pytest.mark.parametrize(("base", "drive", "arm", "planet"), TRAINS)
def test_a_rod_and_the_block_on_it_count_each_from_its_own_start(base, drive, arm, planet):
    """The block stands 170° ahead of the rod: at -174°, not at 186°, and its train by that.

    A planet has turned by φ_arm - (φ_sun - φ_arm)·12/20 (Willis).
    """
    name = "loops/trains-on-a-rod-and-its-block"
    one = Mechanism(read_text(scene_text(name), name))
    found = one.solve()
    assert one.witness(found).agrees
    start, end = base
    at = {p: found.points[p].position for p in {start, end, *planet}}
    standing = cmath.phase(at[end] - at[start])
    turned = math.radians(drive) + standing
    led = math.radians(arm) - (turned - math.radians(arm)) * 12 / 20
    off = cmath.phase(at[planet[1]] - at[planet[0]]) - led
    assert math.remainder(off, math.tau) == pytest.approx(0, abs=1e-9)


def test_a_stated_way_of_a_wheel_is_not_that_of_a_bar_that_lies_on_it():
    """The block of a swivelling guide carries a drum: its way says nothing of the bar there."""
    name = "loops/bar-on-a-swivelling-wheel"
    for way in ("forward", "backward"):
        text = scene_text(name).replace('3 = "forward"', f'3 = "{way}"')
        one = Mechanism(read_text(text, name))
        verdict = one.witness(one.solve())
        assert verdict.branches == ()
        assert verdict.agrees


def test_an_angle_that_no_linear_equation_ties_is_counted_by_itself():
    """Two angles two turns ahead, the first of them tied to the rest: that one is left as it is."""
    rows = np.array([[[1.0, 0.0, 0.5]]])
    slips = SimpleNamespace(counted={1: 0.0, 2: 0.0})
    loops = SimpleNamespace(linear_rows=rows, turning_count=2, slips=slips)
    values, turns = np.array([[0.3, -2.0, 1.0]]), 4 * np.pi * np.array([[1, 1, 0]])
    found = counted_freely(loops, values + turns, np.array([True, True, True]))
    assert found == pytest.approx(values + turns * [1, 0, 0])
    kept = counted_freely(loops, values + turns, np.array([True, False, True]))
    assert (kept == values + turns).all()


def test_a_track_that_a_driver_slides_counts_its_own_turns():
    """It lies on a planet that has rolled 0.4 of a turn and more; a ring is driven against it."""
    found = load(FOLDER / "loops/driven-against-a-slid-track.toml")
    assert found.witness(found.solve()).agrees


def test_nothing_closes_beside_a_driver_that_has_no_part_in_it():
    """A crank by itself is written before the driver of the bar on a drum: a fault it was."""
    text = (SCENES / "bar-on-drum-rod.toml").read_text(encoding="utf-8")
    text = text.replace("G = [0, 300]", "G = [0, 3000]\nN = [500, 0]")
    crank = "[links.5]\nN-M5 = 40\n[[drivers]]\nturn = 5\nangle = 20\nspeed = 3\n[[drivers]]"
    found = Mechanism(read_text(text.replace("[[drivers]]", crank, 1), "far"))
    with pytest.raises(ClosureError, match="links 6, 1, 2 do not close"):
        found.solve()
