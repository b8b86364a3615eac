"""Ranges: about zero, from either side of it, and where pins fall together beyond their end."""

from math import acos, degrees
from pathlib import Path

import pytest

import graphkin
from graphkin.diagnosis.ranges import closing
from graphkin.motion import pieces
from graphkin.motion.cycle import cycle
from graphkin.motion.pieces import reachable_ranges
from graphkin.motion.sweep import sweep_of
from tests.chosen import EVERY
from tests.mechanisms import mechanism_of
from tests.scene_files import FOLDER

SCENES = Path(__file__).parent / "scenes"

TRIPLE_ROCKER = """
[frame]
O = [0, 0]
Q = [0.06, 0]
[links.1]
Q-B = 0.06
[links.2]
O-A = 0.18
[links.4]
B-A = 0.08
[[drivers]]
turn = 1
angle = {angle}
speed = 3
[branches]
A = "left of O-B"
"""


@pytest.mark.parametrize("angle", [-60, -20, -5, 20, 340])
def test_a_rocker_that_swings_about_zero_is_followed_from_anywhere(angle):
    """B is 0.12·cos(φ/2) from O and at least 0.18 - 0.08: cos(φ/2) = 5/6 at the ends."""
    found = cycle(mechanism_of(TRIPLE_ROCKER.format(angle=angle)), steps=36)
    (low, high), *rest = found.ranges
    assert not rest
    assert (low, high) == pytest.approx((-67.11461952384143, 67.11461952384143), abs=1e-9)


@pytest.mark.parametrize("angle", [-33, 4, 41])
def test_where_two_pins_fall_together_nothing_more_is_found(angle):
    """Beyond |OA| = OD - AD the pin E would stand on D, and P anywhere about both.

    The range ends where |OA| = 2·OC·cos α = 100 mm with D on OA, and at D, A and C in line.
    """
    linkage = graphkin.load(SCENES / "peaucellier-led.toml", d=angle)
    ends = -degrees(acos(100 / 120)), degrees(acos((200**2 + 60**2 - 160**2) / (2 * 200 * 60)))
    (found,) = closing(linkage.scene).ranges
    assert found == pytest.approx(ends, abs=1e-3)
    (followed,) = cycle(linkage, steps=36).ranges
    assert followed == pytest.approx(ends, abs=1e-4)


def test_a_scissor_lift_closes_between_its_upright_positions():
    """Beyond them D stands on C, and all above them anywhere."""
    (found,) = closing(graphkin.load(SCENES / "scissor-lift.toml").scene).ranges
    assert found == pytest.approx((-90, 90), abs=1e-3)


@pytest.mark.parametrize("angle", [20, 200, 500] if EVERY else [20, 500])
def test_a_dead_point_turns_away_is_found_from_any_start(angle, tmp_path):
    """The plank is one with its other closure at 676.65°, in the second turn."""
    text = Path("examples/scenes/plank-axle.toml").read_text()
    text = text.replace("value = 20, min = -40, max = 80", f"value = {angle}, min = -40, max = 800")
    scene = tmp_path / "plank.toml"
    scene.write_text(text)
    mechanism = graphkin.load(scene)
    spans = reachable_ranges(sweep_of(mechanism.scene)).spans
    assert [high for _, high in spans] == [pytest.approx(676.6479473, abs=1e-6)]


def test_ranges_that_meet_where_loci_touch_are_one():
    """Rounding alone parts them: all bars of one lie on a line twice a turn, tongs shut at zero."""
    assert closing(graphkin.load(FOLDER / "motion/antiparallelogram.toml").scene).ranges == [
        (0, 360)
    ]
    tongs = graphkin.load(FOLDER / "motion/lazy-tongs.toml")
    (found,) = closing(tongs.scene).ranges
    assert found == pytest.approx((-0.12, 0.12), abs=1e-7)


GEARED_PARALLELOGRAM = """
[frame]
O1 = [0, 0]
O2 = [6, 0]
O3 = [-3, 0]
[links.1]
O1-A = 2
wheel = { centre = "O1", radius = 1 }
[links.2]
A-B = 6
[links.3]
O2-B = 2
[links.4]
O3-C = 1
wheel = { centre = "O3", radius = 2 }
rolls = { on = "1" }
[[drivers]]
turn = 1
angle = 30
speed = 1
[branches]
B = "left of A-O2"
"""


def test_a_range_with_too_many_change_points_is_not_said_to_close_nowhere(monkeypatch):
    """Without the bound it closes at every angle, by two change points in each turn."""
    assert closing(mechanism_of(GEARED_PARALLELOGRAM).scene).ranges == [(0.0, 360.0)]
    monkeypatch.setattr(pieces, "MOST_PIECES", 1)
    found = closing(mechanism_of(GEARED_PARALLELOGRAM).scene)
    assert found.dear and not found.ranges
