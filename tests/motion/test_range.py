"""The range of the driver: dead points to the last digits, by name, and never one too many."""

from __future__ import annotations

from math import acos, degrees, sqrt

import numpy as np
import pytest

from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import ClosureError, SceneError
from tests.motion.linkages import cosine_rule, five_bar, four_bar, slider_crank
from tests.scene_files import scene_text

EXACT = 6e-11
"""Degrees: 1e-12 of a radian."""


@pytest.mark.parametrize(
    ("lengths", "low", "high"),
    [
        # coupler and rocker stretched, at an equal angle on either side of the frame
        ((4, 3, 2.5, 3), *(sign * cosine_rule(4, 3, 5.5) for sign in (-1, 1))),
        ((3, 2, 2.5, 4), *(sign * cosine_rule(3, 4, 4.5) for sign in (-1, 1))),
        ((4, 2, 3.9999, 2), *(sign * cosine_rule(4, 2, 5.9999) for sign in (-1, 1))),
        # coupler and rocker folded at the near end of the crank's circle
        ((3, 8, 4, 6), cosine_rule(3, 6, 4), 360 - cosine_rule(3, 6, 4)),
        ((2, 4.001, 2, 4), cosine_rule(2, 4, 2.001), 360 - cosine_rule(2, 4, 2.001)),
    ],
)
def test_dead_points_of_a_four_bar_follow_from_the_cosine_rule(lengths, low, high):
    crank, coupler, rocker, frame = lengths
    stated = (low + high) / 2 + 0.3 * (high - low)
    found = cycle(four_bar(crank, coupler, rocker, frame, angle=stated % 360))
    ((first, last),) = found.ranges
    assert first == pytest.approx(low, abs=EXACT)
    assert last == pytest.approx(high, abs=EXACT)
    dead = found.singulars
    assert [each.kind for each in dead] == ["dead", "dead"]
    assert {each.lines for each in dead} == {"A, B and O2 in line"}
    assert {each.pin for each in dead} == {"B"}


def test_a_gap_narrower_than_the_grid_is_still_seen():
    crank, frame, coupler, rocker = 2.0, 4.0, 4.00000001, 2.0
    edge = degrees(acos((crank**2 + frame**2 - (coupler - rocker) ** 2) / (2 * crank * frame)))
    found = cycle(four_bar(crank, coupler, rocker, frame, angle=30))
    assert edge < 0.005
    assert found.ranges[0] == pytest.approx((edge, 360 - edge), abs=1e-8)


def test_a_gap_that_closes_by_a_hair_is_none():
    found = cycle(four_bar(2, 3.999999, 2, 4, angle=30))
    assert not found.path.whole
    assert cycle(four_bar(2, 3.999, 2.002, 4, angle=30)).path.whole


def test_dead_points_of_a_crank_that_the_rod_cannot_follow():
    # the rod stands square to the guide: r sin(phi) - d = ± c
    r, c, d = 3.0, 2.0, 0.5
    found = cycle(slider_crank(r, c, d, angle=0))
    low, high = (degrees(np.arcsin((d + sign * c) / r)) for sign in (-1, 1))
    assert found.ranges[0] == pytest.approx((low, high), abs=EXACT)
    # the other range, in which the crank points away, is found and told apart
    assert found.ranges[1] == pytest.approx((180 - high, 180 - low), abs=EXACT)
    assert {each.lines for each in found.singulars} == {"A-B square to the guide of 3"}


def test_the_pump_ends_where_its_rod_is_square_to_the_guide():
    found = cycle(load("pump", n=7))
    ((low, high),) = found.ranges
    for end, inside in ((low, low + 1e-5), (high, high - 1e-5)):
        row = found.along([inside])
        c, d = (row.solution.points[name].position[0] for name in "CD")
        assert abs((d - c).real) < 1e-3 * abs(d - c)
        assert not len(found.along([end + (end - inside)]).at)
    assert [each.pin for each in found.singulars] == ["D", "D"]


def test_where_nothing_closes_is_an_error_that_says_so():
    with pytest.raises(ClosureError, match="closes for no position"):
        cycle(four_bar(1, 2, 2, 20))


def test_a_driver_that_there_is_not_is_refused():
    with pytest.raises(SceneError, match="there is no driver 3; expected 1 to 2"):
        cycle(five_bar(), driver=3)
    with pytest.raises(SceneError, match="there is no driver 9; expected 1, the only driver"):
        cycle(four_bar(1, 2, 2, 20), driver=9)
    with pytest.raises(SceneError, match="a window that grows"):
        cycle(five_bar(), low=2, high=1)


def test_a_window_shows_what_is_asked_and_ends_at_dead_points():
    mechanism = four_bar(3, 2, 2.5, 4, angle=0)
    edge = cosine_rule(3, 4, 4.5)
    found = cycle(mechanism, low=-10, high=200, steps=21)
    assert found.at[0] == -10
    assert found.at[-1] < edge < found.left_out[0]
    assert len(found.at) + len(found.left_out) == 22


def test_one_of_several_drivers_may_be_moved_while_the_others_stand():
    found = cycle(five_bar(), driver=2)
    assert found.sweep.what == "turn"
    assert np.ptp(found.solution.points["A"].position) == 0
    assert np.all(found.solution.links["1"].omega == 0)
    assert np.allclose(found.solution.links["4"].omega, -1)
    assert found.witnessed.agrees.all()


def test_limits_of_a_range_are_where_a_square_root_ends():
    # beside a dead point the margin falls as the root of the distance: ratio 10 for a hundredth
    found = cycle(four_bar(3, 2, 2.5, 4, angle=0))
    ((_, high),) = found.ranges
    near = found.along([high - 1e-2, high - 1e-4]).margins["B"]
    assert near[0] / near[1] == pytest.approx(sqrt(100), rel=1e-3)


@pytest.mark.parametrize(
    ("base", "motion"), [(29, "harmonic"), (34, "harmonic"), (25, "parabolic")]
)
def test_a_cam_turns_fully_though_its_curvature_jumps_where_a_dwell_ends(base, motion):
    text = scene_text("motion/knife-cam-after-a-dwell", base=base, motion=motion)
    found = cycle(Mechanism(read_text(text, "cam")), steps=36)
    assert found.path.whole
    assert found.singulars == ()
