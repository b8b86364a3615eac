"""Extremes that textbooks tabulate, against closed forms that are derived here.

The exact values are derived in each function. The rounded ones are those that textbooks print; a
test holds each to its closed form, so that a slip in a table would show.
"""

from __future__ import annotations

from math import acos, asin, cos, degrees, pi, radians, sin, sqrt

import pytest

from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.motion.extremes import Extremes, all_extremes
from graphkin.motion.follower_limits import followers
from graphkin.scene.read_scene import read_text
from tests.motion.linkages import four_bar, slider_crank
from tests.scene_files import scene_text

LIFT, BETA, PACE = 0.025, radians(120), 20.0
"""Lift (m), angle of the rise and of the return, and speed (rad/s) of the cam."""


def laws() -> dict[str, tuple[float, float, float | None]]:
    """Peak factors of speed, acceleration and jerk of a rise of 1 over 1 between dwells.

    - harmonic, (1 - cos πx)/2: its derivatives at their largest.
    - parabolic, 2x² and its mirror image: the jerk is infinite.
    - cycloidal, x - sin(2πx)/2π.
    - 3-4-5, 10x³ - 15x⁴ + 6x⁵: s′ is largest at 1/2; s‴ = 0 at x = 1/2 - √3/6, s″ = 10/√3 there;
      s‴ = 60 at the ends.
    - 4-5-6-7, 35x⁴ - 84x⁵ + 70x⁶ - 20x⁷: s‴ = 840x(1 - x)(5x² - 5x + 1) vanishes at
      x = (5 - √5)/10, s″ = 84√5/25 there; s‴ = -52.5 at 1/2.
    - modified trapezoid, s″ = C sin 4πx up to 1/8, C up to 3/8, and so on: its speed rises by
      C(1/2π + 1/4) = 2 in the first half, so C = 8π/(2 + π); s‴ = 4πC at the start.
    - modified sine, s″ = C sin 4πx up to 1/8, C cos 4π(x - 1/8)/3 up to 7/8: the largest speed is
      C/π; a rise of 1 needs C = 4π²/(4 + π); s‴ = 4πC at the start.
    """
    trapezoid, sine = 8 * pi / (2 + pi), 4 * pi**2 / (4 + pi)
    return {
        "harmonic": (pi / 2, pi**2 / 2, pi**3 / 2),
        "parabolic": (2, 4, None),
        "cycloidal": (2, 2 * pi, 4 * pi**2),
        "3-4-5": (15 / 8, 10 / sqrt(3), 60),
        "4-5-6-7": (35 / 16, 84 * sqrt(5) / 25, 105 / 2),
        "modified trapezoid": (2, trapezoid, 4 * pi * trapezoid),
        "modified sine": (sine / pi, sine, 4 * pi * sine),
    }


PRINTED_LAWS = {
    "harmonic": (1.571, 4.935, 15.5),
    "cycloidal": (2.0, 6.283, 39.48),
    "3-4-5": (1.875, 5.7735, 60.0),
    "4-5-6-7": (2.1875, 7.5132, 52.5),
    "modified trapezoid": (2.0, 4.888, 61.43),
    "modified sine": (1.760, 5.528, 69.47),
}
"""The same factors as tables of cam laws print them."""


def geneva(slots: int) -> tuple[float, float]:
    """The largest ω and ε of a Geneva wheel for a crank at 1 rad/s.

    With λ = sin(π/n): tan β = λ sin φ/(1 - λ cos φ), so β′ = λ(cos φ - λ)/(1 + λ² - 2λ cos φ),
    which is largest at φ = 0, and β″ = -λ(1 - λ²) sin φ/(1 + λ² - 2λ cos φ)². Its derivative
    vanishes where 2λ cos² φ + (1 + λ²) cos φ - 4λ = 0.
    """
    ratio = sin(pi / slots)
    whole = 1 + ratio**2
    cosine = (sqrt(whole**2 + 32 * ratio**2) - whole) / (4 * ratio)
    twist = ratio * (1 - ratio**2) * sqrt(1 - cosine**2) / (whole - 2 * ratio * cosine) ** 2
    return ratio / (1 - ratio), twist


PRINTED_GENEVA = {
    3: (6.46, 31.4),
    4: (2.41, 5.41),
    5: (1.43, 2.30),
    6: (1.00, 1.35),
    8: (0.620, 0.700),
}
"""The same as tables of Geneva wheels print them."""


def extremes_of(mechanism: Mechanism) -> dict[str, Extremes]:
    """All extremes of a mechanism by their labels."""
    ((*found,),) = all_extremes(cycle(mechanism, steps=24))
    return {each.measure.label: each for each in found}


def found_in(text: str) -> dict[str, Extremes]:
    """All extremes of a scene by their labels."""
    return extremes_of(Mechanism(read_text(text, "published")))


@pytest.mark.parametrize("motion", laws())
def test_peak_factors_of_cam_laws(motion):
    text = scene_text("motion/knife-cam-after-a-dwell", base=60, motion=motion)
    text = text.replace('motion = "cycloidal"', f'motion = "{motion}"')
    factors = laws()[motion]
    found = found_in(text + ('jerk = ["B"]\n' if factors[2] is not None else ""))
    for order, factor in enumerate(factors, 1):
        if factor is not None:
            label = f"|{'vaj'[order - 1]}_B|"
            expected = factor * LIFT * (PACE / BETA) ** order
            assert found[label].largest.value == pytest.approx(expected, rel=1e-9), label


@pytest.mark.parametrize("motion", PRINTED_LAWS)
def test_printed_factors_are_the_exact_ones_rounded(motion):
    assert PRINTED_LAWS[motion] == pytest.approx(laws()[motion], rel=5e-4)


@pytest.mark.parametrize("slots", PRINTED_GENEVA)
def test_peaks_of_geneva_wheels(slots):
    crank = 120 * sin(pi / slots)
    found = found_in(scene_text("motion/lever-on-a-crank", crank=crank, apart=120))
    omega, epsilon = geneva(slots)
    assert -found["ω_3"].least.value == pytest.approx(omega, rel=1e-9)
    assert found["ε_3"].largest.value == pytest.approx(epsilon, rel=1e-9)
    assert [place.at for place in found["ω_3"].least.places] == pytest.approx([0], abs=1e-6)
    assert PRINTED_GENEVA[slots] == pytest.approx((omega, epsilon), rel=4e-3)


@pytest.mark.parametrize(("crank", "apart", "printed"), [(120, 300, 1.71), (120, 240, 2.0)])
def test_quick_returns_of_shapers(crank, apart, printed):
    """The lever is at its limits where the crank is square to it: cos(α/2) = r/d.

    The working stroke takes 360° - α, the return α. The lever swings by 2 asin(r/d).
    """
    text = scene_text("motion/lever-on-a-crank", crank=crank, apart=apart)
    moved = cycle(Mechanism(read_text(text, "shaper")), steps=24)
    (lever,) = [each for each in followers(moved) if each.name == "3"]
    back = 2 * degrees(acos(crank / apart))
    assert lever.time_ratio == pytest.approx((360 - back) / back, rel=1e-9)
    assert lever.extent == pytest.approx(2 * degrees(asin(crank / apart)), rel=1e-9)
    assert lever.time_ratio == pytest.approx(printed, abs=0.005)


@pytest.mark.parametrize(("crank", "rod", "offset"), [(50, 200, 0), (60, 200, 30), (40, 120, 25)])
def test_strokes_and_pressure_angles_of_slider_cranks(crank, rod, offset):
    """Crank and rod are in line at both limits: H = √((l + r)² - e²) - √((l - r)² - e²).

    The crank turns by 180° and the difference of both rods' slopes in one stroke. The pressure
    angle is largest where the crank is square to the guide: sin α = (r + |e|)/l.
    """
    moved = cycle(slider_crank(crank, rod, offset), steps=24)
    (block,) = [each for each in followers(moved) if each.name == "3"]
    lengths = [rod + crank, rod - crank]
    stroke = sqrt(lengths[0] ** 2 - offset**2) - sqrt(lengths[1] ** 2 - offset**2)
    assert block.extent == pytest.approx(stroke, rel=1e-9)
    slopes = [degrees(asin(offset / length)) for length in lengths]
    turned = 180 + slopes[1] - slopes[0]
    ratio = max(turned, 360 - turned) / min(turned, 360 - turned)
    assert block.time_ratio == pytest.approx(ratio, rel=1e-9)
    found = extremes_of(slider_crank(crank, rod, offset))["pressure angle of block 3"]
    assert found.largest.value == pytest.approx(degrees(asin((crank + offset) / rod)), rel=1e-9)


@pytest.mark.parametrize("bars", [(40, 90, 70, 100), (30, 80, 65, 70), (25, 60, 60, 60)])
def test_transmission_angles_and_time_ratios_of_crank_rockers(bars):
    """At φ = 0 and 180° the pins are d ∓ a apart: cos μ = (b² + c² - (d ∓ a)²)/2bc.

    The rocker reverses where crank and coupler are in line: b ± a, d and c form a triangle.
    """
    crank, coupler, rocker, frame = bars
    found = extremes_of(four_bar(*bars))["transmission angle at B of links 2 and 3"]
    angles = [
        acos((coupler**2 + rocker**2 - (frame + way * crank) ** 2) / (2 * coupler * rocker))
        for way in (-1, 1)
    ]
    least = min(min(degrees(angle), 180 - degrees(angle)) for angle in angles)
    assert found.least.value == pytest.approx(least, rel=1e-9)
    (swung,) = [each for each in followers(cycle(four_bar(*bars), steps=24)) if each.name == "3"]
    at = [
        degrees(acos((frame**2 + length**2 - rocker**2) / (2 * frame * length)))
        for length in (coupler + crank, coupler - crank)
    ]
    turned = 180 + at[1] - at[0]
    ratio = max(turned, 360 - turned) / min(turned, 360 - turned)
    assert swung.time_ratio == pytest.approx(ratio, rel=1e-9)


YOKE = """graphkin = 1
title = "Scotch yoke"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
[links.1]
O-A = 80
[links.2]
A = [0, 0]
slides = { on = 3, through = "Y", angle = 90 }
[links.3]
Y = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[[drivers]]
turn = 1
angle = 20
speed = 5
[ask]
velocity = ["Y"]
acceleration = ["Y"]
jerk = ["Y"]
"""


def test_a_scotch_yoke_is_harmonic():
    """x = r cos φ: its rates are rω, rω² and rω³ at the most, with their zeros between."""
    found = found_in(YOKE)
    for order, letter in enumerate("vaj", 1):
        own = found[f"|{letter}_Y|"]
        assert own.largest.value == pytest.approx(0.08 * 5**order, rel=1e-9)
        level, steep = ([0, 180], [90, 270]) if order % 2 else ([90, 270], [0, 180])
        assert own.least.value == 0
        assert [p.at for p in own.least.places] == pytest.approx(level, abs=1e-5)
        assert [p.at for p in own.largest.places] == pytest.approx(steep, abs=1e-4)


def test_all_places_of_equal_jerks_of_a_piston_are_listed():
    """x‴ = 0 at both dead centres, and where 1 + … of the rod turns its sign once on each way."""
    text = YOKE.replace('A = [0, 0]\nslides = { on = 3, through = "Y", angle = 90 }', "A-Y = 200")
    found = found_in(text + '[branches]\n3 = "forward"\n')["|j_Y|"]

    def jerk(angle: float) -> float:
        s, c = sin(radians(angle)), cos(radians(angle))
        rod = sqrt(0.2**2 - (0.08 * s) ** 2)
        first = -(0.08**2) * s * c / rod
        second = (-(0.08**2) * (c * c - s * s) - first**2) / rod
        third = (4 * 0.08**2 * s * c - 3 * first * second) / rod
        return 5**3 * (0.08 * s + third)

    places = [place.at for place in found.least.places]
    assert len(places) == 4
    assert all(abs(jerk(at)) < 1e-6 for at in places)
    grid = [0.05 + 0.1 * k for k in range(3600)]
    turns = sum(jerk(a) * jerk(b) < 0 for a, b in zip(grid, grid[1:] + grid[:1], strict=True))
    assert turns == len(places)
    assert len(found.largest.places) == 2
    assert sum(place.at for place in found.largest.places) == pytest.approx(360, abs=1e-4)
    assert found.largest.value == pytest.approx(max(map(abs, map(jerk, grid))), rel=1e-5)
