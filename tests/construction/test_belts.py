"""Belts: the rims of both wheels run at one speed along the strands, seen from the arm."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import load
from graphkin.text.errors import StructureError
from tests.documents.sheet_tools import FOLDER
from tests.scene_files import scene_text
from tests.textbook.book import RPM, answers

TESTS = Path(__file__).parents[1]


def test_khurmi_11_1_engine_line_shaft_dynamo():
    found = load(FOLDER / "belts-dynamo.toml").solve()
    assert found.links["3"].omega / RPM == pytest.approx(1500)
    assert found.links["2"].omega / RPM == pytest.approx(250)


@pytest.mark.parametrize("name", ["belts-dynamo", "belts-crossed", "belts-arm"])
def test_the_closures_agree_over_the_turn(name):
    for angle in (0, 75, 210, 345):
        made = load(FOLDER / f"{name}.toml", angle=angle)
        assert made.witness(made.solve()).agrees


@pytest.mark.parametrize(("large", "small"), [(100, 70), (120, 70), (90, 70)])
def test_the_load_of_a_differential_hoist_moves_at_half_the_difference_of_the_rims(large, small):
    made = load(FOLDER / "hoist-differential.toml", R=large)
    found = made.solve()
    assert made.witness(found).agrees
    speed = 30 * RPM * (large - small) / 2000
    assert found.points["P"].velocity == pytest.approx(1j * speed)
    assert found.links["4"].omega == pytest.approx(30 * RPM)
    strands = [found.points[point].velocity.imag for point in "BC"]
    assert strands == pytest.approx([30 * RPM * large / 1000, -30 * RPM * small / 1000])


def test_a_moving_pulley_rises_at_half_the_speed_of_the_rope():
    found = answers(scene_text("construction/moving-pulley"))
    assert found.points["B"].velocity == pytest.approx(0.2j)
    assert found.points["P"].velocity == pytest.approx(0.1j)
    assert found.points["P"].acceleration == pytest.approx(0.15j)
    assert found.links["3"].omega == pytest.approx(-0.1 / 0.08)


def test_belts_in_series_on_a_free_arm():
    """From wheel 1 by 40/24 and -50/24, from the fixed wheel by 20/30: 24 ω2 = 125 (ω1 - ω2)."""
    links = answers(scene_text("construction/belts-in-series")).links
    assert links["2"].omega == pytest.approx(125)
    assert links["2"].epsilon == pytest.approx(4 * 125 / 149)
    assert links["3"].omega == pytest.approx(125 + 24 * 40 / 24)
    assert links["4"].omega == pytest.approx(125 - 125 * 20 / 30)


@pytest.mark.parametrize("crossed", [False, True])
def test_a_belt_from_a_crank_to_a_wheel_on_its_coupler(crossed):
    links = answers(scene_text("construction/belt-on-a-coupler", crossed=crossed)).links
    against = links["1"].omega - links["2"].omega
    ratio = -30 / 45 if crossed else 30 / 45
    assert links["4"].omega - links["2"].omega == pytest.approx(ratio * against)


def test_an_open_belt_on_equal_wheels_turns_them_alike():
    """On an arm too: v_Q = v_P + ω·PQ with the sun's ω, a_Q alike; no point of contact is drawn."""
    one = load(FOLDER / "belts-equal.toml")
    found = one.solve()
    sun, wheel = found.links["1"], found.links["3"]
    assert (wheel.omega, wheel.epsilon) == (sun.omega, sun.epsilon) == (-2, 5)
    p, q = found.points["P"], found.points["Q"]
    way = q.position - p.position
    assert q.velocity - p.velocity == pytest.approx(1j * -2 * way)
    assert q.acceleration - p.acceleration == pytest.approx((5j - 4) * way)
    assert way == pytest.approx(35e-3 * np.exp(1j * np.radians(90 + 20)))
    assert not any(of.startswith("T") for what, of in one.program.targets if what == "position")


def test_a_wheel_belted_to_a_fixed_one_of_its_size_only_shifts():
    """Ferguson: on its arm it keeps its direction; all its points move alike."""
    text = scene_text("construction/belt-on-an-arm").replace("radius = 24", "radius = 60")
    text = text.replace("[links.1]\nO-S = 45\nwheel", "wheel").replace("{ on = 1", "{ on = 0")
    text = text[: text.rindex("[[drivers]]")]
    found = answers(text)
    assert (found.links["3"].omega, found.links["3"].epsilon) == (0, 0)
    assert found.points["Q"].velocity == pytest.approx(found.points["P"].velocity)
    assert found.points["Q"].acceleration == pytest.approx(found.points["P"].acceleration)


def test_a_wheel_on_a_fixed_pin_is_accelerated_without_the_crossing_of_the_strands():
    """ε₂ = −ε₁·r₁/r₂ between gears, ε₃ = ε₂·r₂/r₃ by an open belt (Norton, Design of Machinery,
    9.3); the strands meet far off, and no acceleration is drawn there."""
    wheels = load(TESTS / "scenes/construction/wheels-that-speed-up.toml")
    found = wheels.solve()
    second, third = -50 / 100, -50 / 100 * 40 / 25
    for link, ratio in (("2", second), ("3", third)):
        assert found.links[link].omega == pytest.approx(6 * ratio)
        assert found.links[link].epsilon == pytest.approx(10 * ratio)
    for point, pin, ratio in (("B", "O2", second), ("C", "O3", third)):
        arm = found.points[point].position - found.points[pin].position
        assert found.points[point].acceleration == pytest.approx(
            (10j * ratio - (6 * ratio) ** 2) * arm
        )
    drawn = wheels.trace([("acceleration", "C")], by_hand=True)
    names = {wheels.program.steps[number].name for number in drawn.values}
    assert "c′" in names and not {name for name in names if name.startswith("t") and "′" in name}
    touching = ("acceleration", "T2@3")
    where = wheels.trace([touching, ("position", "T2")])
    reach = where.value("position", "T2") - found.points["O3"].position
    assert where.value(*touching) == pytest.approx((10j * third - (6 * third) ** 2) * reach)


@pytest.mark.parametrize(("size", "meets"), [(89, False), (90, True), (120, True)])
def test_a_belt_needs_wheels_that_stand_apart(size, meets):
    """Of 60 mm beside it, 150 mm from centre to centre."""
    text = scene_text("construction/belt-on-an-arm").replace("radius = 24", f"radius = {size}")
    if not meets:
        assert answers(text).links["3"].omega
        return
    with pytest.raises(StructureError) as caught:
        answers(text)
    (problem,) = caught.value.problems
    assert problem.found == (
        f"the wheels of radius {size} mm and 60 mm (on link 1) overlap or touch: "
        "link 2 keeps O-P = 150 mm"
    )
    assert problem.expected == f"more than the sum of the radii, {size + 60} mm"
