"""The arrays of a cycle: the same as one scene after the other, and true rates of change."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.mechanism import load
from graphkin.motion.centrodes import centrodes
from graphkin.motion.cycle import columns_at, cycle
from tests.motion.linkages import four_bar, slider_crank

SCENES = "examples/scenes"


def test_rows_are_what_the_scene_gives_at_that_angle():
    found = cycle(four_bar(40, 90, 70, 100, speed=3))
    for row in (0, 17, 200, 359):
        alone = four_bar(40, 90, 70, 100, angle=found.at[row], speed=3).solve()
        for name, point in alone.points.items():
            many = found.solution.points[name]
            assert many.position[row] == pytest.approx(point.position, rel=1e-13, abs=1e-12)
            assert many.velocity[row] == pytest.approx(point.velocity, rel=1e-12, abs=1e-11)
            assert many.acceleration[row] == pytest.approx(point.acceleration, rel=1e-11, abs=1e-10)
        assert found.solution.links["3"].omega[row] == pytest.approx(alone.links["3"].omega)


@pytest.mark.parametrize(
    "name",
    [
        "pump",
        "pump-collinear",
        f"{SCENES}/crank-rocker.toml",
        f"{SCENES}/engine.toml",
        f"{SCENES}/six-bar.toml",
        f"{SCENES}/offset-slider-crank.toml",
    ],
)
def test_the_witness_agrees_in_every_row(name):
    found = cycle(load(name))
    assert not found.witnessed.refused
    assert found.witnessed.agrees.all()
    assert found.witnessed.largest < 1e-10


def test_velocities_by_the_driver_are_derivatives_of_positions():
    found = cycle(load(f"{SCENES}/six-bar.toml"))
    step = 1e-3
    at = np.array([20.0, 100.0, 300.0])
    rates = columns_at(found.sweep, found.path, at, geometric=True).columns
    ahead, behind = (found.along(at + way * step).solution.points for way in (1, -1))
    for name in "BCD":
        slope = (ahead[name].position - behind[name].position) / np.radians(2 * step)
        assert np.allclose(rates["velocity", name], slope, atol=1e-9)


def test_positions_that_do_not_close_have_no_row():
    found = cycle(load("pump", n=7), steps=720)
    assert len(found.at) + len(found.left_out) == 720
    assert np.allclose(np.diff(found.at), 0.5)
    ((low, high),) = found.ranges
    assert low < found.at.min() < found.at.max() < high
    assert all(np.isfinite(point.velocity).all() for point in found.solution.points.values())


def test_a_large_cycle_runs_in_blocks_like_a_small_one():
    few, many = (cycle(four_bar(40, 90, 70, 100), steps=n) for n in (36, 36_000))
    same = many.solution.points["B"].acceleration[::1000]
    assert np.array_equal(few.solution.points["B"].acceleration, same)


@pytest.mark.parametrize(
    ("mechanism", "link", "low", "high"),
    [
        (four_bar(40, 90, 70, 100), "2", 10, 100),
        (slider_crank(2, 5, 0.3), "2", 20, 60),
        (load(f"{SCENES}/six-bar.toml"), "4", 20, 110),
    ],
)
def test_the_moving_centrode_rolls_on_the_fixed_one(mechanism, link, low, high):
    found = cycle(mechanism).along(np.linspace(low, high, 20_001))
    both = centrodes(found, link)
    assert both is not None
    fixed, moving = (np.abs(np.diff(curve)) for curve in (both.fixed, both.moving))
    assert np.allclose(fixed, moving, rtol=1e-5, atol=1e-9 * fixed.sum())
    assert fixed.sum() == pytest.approx(moving.sum(), rel=1e-9)
    # they touch: where the link stands, both pass the centre in the same direction
    middle = 10_000
    placed = both.placed(both.origin[middle], both.heading[middle])
    assert placed[middle] == pytest.approx(both.fixed[middle])
    ways = [curve[middle + 1] - curve[middle - 1] for curve in (both.fixed, placed)]
    assert abs(np.angle(ways[0] / ways[1])) < 1e-4


def test_centrodes_of_the_cardan_motion_are_circles_in_the_ratio_of_two_to_one():
    found = cycle(load(f"{SCENES}/centrodes-cardan.toml"))
    length = float(found.scene.values["l"]) / 1000
    (link,) = found.scene.ask.centrodes
    both = centrodes(found, link)
    assert both is not None
    crossing = 0
    assert np.allclose(np.abs(both.fixed - crossing), length, rtol=1e-9)
    assert np.allclose(np.abs(both.moving - length / 2), length / 2, rtol=1e-9)


def test_the_rolling_wheel_has_its_rail_and_its_rim_for_centrodes():
    found = cycle(load(f"{SCENES}/centrodes-roller.toml"))
    radius = float(found.scene.values["r"]) / 1000
    both = centrodes(found, found.scene.ask.centrodes[0])
    assert both is not None
    assert np.allclose(both.fixed.imag, both.fixed[0].imag, atol=1e-12)
    assert np.allclose(np.abs(both.moving), radius)
