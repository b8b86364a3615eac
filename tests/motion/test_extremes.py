"""Extremes of a motion against closed forms, textbooks, and golden sections of other closures."""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Callable
from math import acos, asin, atan, atan2, cos, degrees, inf, pi, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.motion.extremes import Extremes, asked_measures, extremes
from graphkin.motion.transmission import all_extremes, ratio_measures
from graphkin.scene.read_scene import read_text
from tests.scene_files import FOLDER

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
GOLDEN = (sqrt(5) - 1) / 2


def found_in(mechanism: Mechanism, **window) -> dict[str, Extremes]:
    """The extremes of what a scene asks for, by their labels, in its first range."""
    moved = cycle(mechanism, steps=12, **window)
    return {each.measure.label: each for each in extremes(moved, [*asked_measures(moved)])}


def golden(value: Callable[[float], float], sign: int) -> tuple[float, float]:
    """The place (degrees) and size of an extreme: samples at 0.25 degrees, then golden section."""
    grid = np.arange(0, 360, 0.25)
    best = max(grid, key=lambda at: sign * value(at))
    low, high = best - 0.25, best + 0.25
    while high - low > 1e-7:
        one, two = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        if sign * value(one) > sign * value(two):
            high = two
        else:
            low = one
    return (low + high) / 2 % 360, value((low + high) / 2)


def differences(place: Callable[[float], float | complex], rank: int) -> Callable[[float], float]:
    """The size or value of a derivative by the angle (radians): Richardson's differences."""

    def plain(at: float, h: float):
        ahead, back = place(at + degrees(h)), place(at - degrees(h))
        return (ahead - back) / (2 * h) if rank == 1 else (ahead - 2 * place(at) + back) / h**2

    def value(at: float) -> float:
        found = (4 * plain(at, 1e-3) - plain(at, 2e-3)) / 3
        return abs(found) if isinstance(found, complex) else found

    return value


def piston(at: float) -> complex:
    """A crank of 70 and a rod of 200 whose guide lies 30 above the pivot."""
    q = radians(at)
    return complex(0.07 * cos(q) + sqrt(0.2**2 - (0.07 * sin(q) - 0.03) ** 2), 0.03)


def rocker(at: float) -> float:
    """The angle of DC for AB = 50, BC = 120, DC = 90, AD = 130, by the law of cosines."""
    span = 50 * exp(1j * radians(at)) - 130
    inner = acos((90**2 + abs(span) ** 2 - 120**2) / (2 * 90 * abs(span)))
    return np.unwrap([pi, phase(span) % (2 * pi)])[1] - inner


def lever(at: float) -> float:
    """The angle of the slotted lever of a Whitworth shaper: crank of 120, pivot 300 below."""
    return atan2(300 + 120 * sin(radians(at)), 120 * cos(radians(at)))


def ram(at: float) -> complex:
    """Its ram: a lever of 550, a rod of 200, on a line 560 above the lever's pivot."""
    end = 0.55 * exp(1j * lever(at))
    return complex(end.real - sqrt(0.2**2 - (0.56 - end.imag) ** 2), 0.0)


@pytest.mark.parametrize(
    ("name", "label", "place", "rank", "speed"),
    [
        ("slider-crank", "|v_B|", piston, 1, 4 * pi),
        ("slider-crank", "|a_B|", piston, 2, (4 * pi) ** 2),
        ("four-bar-crank-rocker", "ω_3", rocker, 1, 10.0),
        ("shaper", "ω_3", lever, 1, 2 * pi),
        ("shaper", "ε_3", lever, 2, 4 * pi**2),
        ("shaper", "|v_C|", ram, 1, 2 * pi),
        ("shaper", "|a_C|", ram, 2, 4 * pi**2),
    ],
)
def test_an_extreme_is_that_of_a_golden_section_in_another_closure(name, label, place, rank, speed):
    found = found_in(load(f"{SCENES}/{name}.toml"))[label]
    for sign, extreme in ((-1, found.least), (1, found.largest)):
        at, size = golden(differences(place, rank), sign)
        if abs(size) < 1e-6:
            assert extreme.value == 0
            continue
        assert extreme.value == pytest.approx(size * speed, rel=1e-7)
        assert min(abs((each.at - at + 180) % 360 - 180) for each in extreme.places) < 0.01


@pytest.mark.parametrize(
    ("window", "velocity", "acceleration"),
    [((0, 120), 2.0, 2 * pi), ((180, 300), 1.875, 10 / sqrt(3))],
)
def test_a_cam_has_the_published_peaks_of_its_laws(window, velocity, acceleration):
    """Norton, Cam Design, table 2-1: cycloid 2 h/β and 2π h/β², polynomial 3-4-5 1.875 and 5.77."""
    low, high = window
    found = found_in(load(f"{SCENES}/cam-roller.toml"), low=low, high=high)
    rate = 0.02 / radians(120) * (10 * pi)
    assert found["|v_B|"].largest.value == pytest.approx(velocity * rate, rel=1e-9)
    assert [each.at for each in found["|v_B|"].largest.places] == pytest.approx([low + 60])
    push = acceleration * 0.02 / radians(120) ** 2 * (10 * pi) ** 2
    assert found["|a_B|"].largest.value == pytest.approx(push, rel=1e-9)
    assert len(found["|a_B|"].largest.places) == 2


def test_a_dwell_is_one_place_from_end_to_end():
    least = found_in(load(f"{SCENES}/cam-roller.toml"))["|v_B|"].least
    assert least.value == 0
    ends = [(each.at, each.until) for each in least.places]
    assert np.ravel(ends) == pytest.approx([120, 180, 300, 360], abs=1e-5)


def test_what_grows_without_bound_has_no_largest_value():
    """The pump's rod stands square to its guide at both ends of the driver's range."""
    found = found_in(load("pump", n=7))
    ends = [-32.618, 186.944]
    assert found["|v_D|"].largest.value == inf
    assert [each.at for each in found["|v_D|"].largest.places] == pytest.approx(ends, abs=1e-3)
    assert (found["ω_4"].least.value, found["ω_4"].largest.value) == (-inf, inf)
    assert found["ω_2"].largest.value < 42  # the rocker does not depend on the rod
    assert [each.end for each in found["ω_2"].largest.places] == ["dead"]


def test_a_parallelogram_turns_evenly_through_its_change_points():
    found = found_in(load(f"{SCENES}/four-bar-change-point.toml"))
    constant = {label: each.least.value for label, each in found.items() if each.is_constant}
    assert constant == pytest.approx(
        {"|v_C|": 0.7, "|a_C|": 7, "ω_2": 0, "ω_3": 10, "ε_2": 0, "ε_3": 0}, rel=1e-6
    )


def test_the_jaws_of_a_gripper_keep_their_acceleration_through_change_points():
    """They move on circles of 80 mm at 40/30 rad/s: 0.08 · (4/3)² m/s²."""
    found = found_in(load(FOLDER / "motion/gripper-on-a-rack.toml"))
    assert found["|a_E|"].is_constant
    assert found["|a_E|"].least.value == pytest.approx(0.08 * 16 / 9, rel=1e-6)


def test_extremes_at_change_points_are_single_places_counted_from_zero():
    """An antiparallelogram's ratio is (a ∓ r)/(a ± r) where all its bars lie on one line."""
    found = found_in(load(FOLDER / "motion/antiparallelogram.toml"))
    for label in ("|v_B|", "ω_2", "ω_3"):
        every = [*found[label].least.places, *found[label].largest.places]
        assert [each.at for each in every] == [each.until for each in every]
        assert sorted(each.at for each in every) == pytest.approx([0, 180], abs=1e-6)
    assert found["ω_3"].least.value == pytest.approx(-10 * 140 / 60)
    assert found["ω_3"].largest.value == pytest.approx(-10 * 60 / 140)


def test_a_kite_turns_slowest_and_fastest_where_it_folds():
    """Galloway's kite mirrors Q in OB: the short crank turns by twice the angle of OB.

    OB turns with 8 rad/s times 90/120 where the kite is longest, and 90/60 where it is shortest.
    """
    found = found_in(load(FOLDER / "motion/galloway-kite.toml"))
    for label, least, largest in (("ω_1", 12, 24), ("ω_2", 4, 16), ("|v_A|", 0.36, 0.72)):
        assert found[label].least.value == pytest.approx(least)
        assert found[label].largest.value == pytest.approx(largest)
        assert [each.at for each in found[label].least.places] == [0]
        assert [each.at for each in found[label].largest.places] == [pytest.approx(180)]


def test_a_driver_that_runs_backwards_changes_signs_not_places():
    text = (SCENES / "slider-crank.toml").read_text()
    ahead, back = (
        found_in(Mechanism(read_text(text.replace("speed = 120", f"speed = {speed}"), "back")))
        for speed in (120, -120)
    )
    for one, other in ((ahead["ω_2"].least, back["ω_2"].largest),):
        assert one.value == pytest.approx(-other.value, rel=1e-9)
        assert one.places[0].at == pytest.approx(other.places[0].at, abs=1e-6)


def angles_in(mechanism: Mechanism) -> dict[str, Extremes]:
    """The transmission and pressure angles of the first range, by their owners."""
    found = all_extremes(cycle(mechanism, steps=12))[0]
    return {each.measure.of: each for each in found if each.limit is not None}


def test_a_four_bar_passes_on_least_where_its_crank_lies_along_the_frame():
    """Law of cosines: cos μ = (b² + c² - (d ± a)²)/2bc, the smaller at d - a here."""
    a, b, c, d = 50, 120, 90, 130
    found = angles_in(load(f"{SCENES}/four-bar-crank-rocker.toml"))["C"]
    one, other = (degrees(acos((b * b + c * c - span**2) / (2 * b * c))) for span in (d - a, d + a))
    assert found.least.value == pytest.approx(min(one, 180 - other), abs=1e-9)
    assert [each.at for each in found.least.places] == pytest.approx([0], abs=1e-6)
    assert found.largest.value == pytest.approx(90, abs=1e-6)
    assert found.keeps_limit  # 41.8° against 40°


def test_a_transmission_angle_is_zero_at_a_dead_point():
    found = angles_in(load(f"{SCENES}/four-bar-double-rocker.toml"))["C"]
    assert found.least.value == pytest.approx(0, abs=1e-5)
    assert found.least.places[0].end == "dead"
    assert not found.keeps_limit


def test_the_rod_of_a_slider_crank_presses_most_with_its_crank_square_to_the_guide():
    """The sine of the pressure angle is (r sin φ - e)/l: 100/200 below, 40/200 above."""
    found = angles_in(load(f"{SCENES}/slider-crank.toml"))["3"]
    assert found.largest.value == pytest.approx(30, abs=1e-9)
    assert [each.at for each in found.largest.places] == pytest.approx([270], abs=1e-6)
    assert found.least.value == pytest.approx(0, abs=1e-6)
    zero = degrees(asin(30 / 70))
    assert [each.at for each in found.least.places] == pytest.approx([zero, 180 - zero], abs=1e-6)


def test_a_cam_presses_most_where_its_formula_says():
    """Falling by 3-4-5: tan α = (s' - e)/(s + √(50² - e²)), e = 10; the prime circle is of 50."""

    def pressure(at: float) -> float:
        x, beta = (at - 180) / 120, radians(120)
        if not 0 <= x <= 1:
            return 0.0
        fall = 20 * (1 - 10 * x**3 + 15 * x**4 - 6 * x**5)
        slope = -20 * (30 * x**2 - 60 * x**3 + 30 * x**4) / beta
        return abs(degrees(atan((slope - 10) / (fall + sqrt(50**2 - 10**2)))))

    at, most = golden(pressure, 1)
    found = angles_in(load(f"{SCENES}/cam-roller.toml"))["2"]
    assert found.largest.value == pytest.approx(most, abs=1e-9)
    assert found.largest.places[0].at == pytest.approx(at, abs=1e-4)


@pytest.mark.parametrize("label", ["|v_B|", "ω_3", "ε_4", "a of block 2"])
def test_a_place_has_more_digits_than_its_value_can_show(label):
    """A lever is fastest with its crank in line; values alone leave half of the digits there.

    The samples start at the scene's position, so that none is at 270 degrees.
    """
    text = (SCENES / "shaper.toml").read_text().replace('angle = "angle"', "angle = 50.1234")
    found = found_in(Mechanism(read_text(text, "shaper")))[label]
    every = [each.at for each in (*found.least.places, *found.largest.places)]
    assert min(abs(at - 270) for at in every) < 1e-9


def test_an_extreme_at_a_change_point_is_found_there():
    """An isosceles slider-crank moves as x = 2 r cos: its extremes lie where crank and rod fold."""
    scene = """graphkin = 1
title = "Isosceles"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 60
A-P = 60
P = "beyond A on B-A"
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[[drivers]]
turn = 1
angle = 40
speed = 4
[branches]
3 = "forward"
[ask]
velocity = ["P", "B"]
acceleration = ["P", "B"]
"""
    found = found_in(Mechanism(read_text(scene, "isosceles.toml")))
    for label, size, turned in (
        ("|v_B|", 0.48, True),
        ("|v_P|", 0.48, False),
        ("|a_B|", 1.92, False),
        ("|a_P|", 1.92, True),
    ):
        across, along = (90.0, 270.0), (0.0, 180.0)
        most, least = (across, along) if turned else (along, across)
        assert found[label].largest.value == pytest.approx(size, rel=1e-9)
        assert found[label].least.value == pytest.approx(0, abs=1e-9)
        assert [each.at for each in found[label].largest.places] == pytest.approx(most, abs=1e-4)
        assert [each.at for each in found[label].least.places] == pytest.approx(least, abs=1e-4)


# --- mechanical advantage -------------------------------------------------------------------------


def test_the_least_mechanical_advantage_is_where_the_piston_is_fastest():
    """|v_3/ω_1| is the first derivative of the place by the crank's angle, and 0 at both ends."""
    moved = cycle(load(str(SCENES / "offset-slider-crank.toml"), n=1), steps=12)
    measures = [*ratio_measures(moved)]
    (found,) = extremes(moved, measures)
    r, rod, off = 0.06, 0.2, 0.02

    def place(at: float) -> float:
        q = radians(at)
        return r * cos(q) + sqrt(rod**2 - (off - r * sin(q)) ** 2)

    first = differences(place, 1)
    at, most = golden(lambda u: abs(first(u)), 1)
    assert found.largest.value == pytest.approx(most, rel=1e-8)
    assert found.largest.places[0].at % 360 == pytest.approx(at, abs=1e-4)
    assert found.least.value == pytest.approx(0, abs=1e-9)
    assert len(found.least.places) == 2
    assert found.measure.unit == "m"


def test_a_driver_at_rest_and_several_drivers_have_no_mechanical_advantage():
    assert not [*ratio_measures(cycle(load(str(SCENES / "five-bar.toml")), steps=4))]
