"""Strokes, time ratios and extremes that books print, against what ``cycle`` answers.

We have the printed answers from FOSSEE's Scilab Textbook Companions (book 213 is R. S. Khurmi,
J. K. Gupta: Theory of Machines; the other one is a book on the theory of machines whose chapters
count illustrations). Each is held to its own digits; the exact value is that of a closed form.
"""

from __future__ import annotations

from math import acos, asin, cos, degrees, pi, radians, sin, sqrt

import pytest
from msgspec.structs import replace

from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.motion.extremes import Extremes, all_extremes
from graphkin.motion.follower_limits import Follower, followers
from graphkin.scene.model import Ask
from tests.motion.linkages import slider_crank
from tests.scene_files import scene_text
from tests.textbook.book import RPM, mechanism, rounds_to, within

SHAPER = """
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
[frame]
C = [0, 0]
A = [0, {below}]
[links.crank]
C-B = {crank}
[links.die]
B = [0, 0]
slides = {{ on = "lever", along = "A-P" }}
[links.lever]
A-P = {lever}
[links.rod]
P-R = {rod}
[links.ram]
R = [0, 0]
slides = {{ on = 0, through = [0, {level}], angle = 0 }}
[[drivers]]
turn = "crank"
angle = 40
speed = 30
[branches]
die = "forward"
ram = "forward"
"""


def travels(found: Mechanism) -> dict[str, Follower]:
    """The travel of each follower of a mechanism, by its name."""
    return {each.name: each for each in followers(cycle(found, steps=24))}


def extremes(found: Mechanism) -> dict[str, Extremes]:
    """All extremes of a mechanism, by their labels."""
    ((*every,),) = all_extremes(cycle(found, steps=24))
    return {each.measure.label: each for each in every}


def shaper(crank: float, apart: float, lever: float) -> dict[str, Follower]:
    """A crank and slotted lever whose ram moves square to the line of centres."""
    level = 0.95 * lever - apart
    text = SHAPER.format(crank=crank, below=-apart, lever=lever, rod=2 * lever, level=level)
    return travels(mechanism(text))


@pytest.mark.parametrize(
    ("crank", "apart", "lever", "ratio", "stroke"),
    [
        pytest.param(120, 300, 500, "1.71", None, id="Khurmi 5.1"),
        pytest.param(120, 240, 450, "2", "450", id="Khurmi 5.2"),
        pytest.param(30, 75.7, 151.5, "1.7", "120", id="Khurmi 5.3, solved backwards"),
        pytest.param(100, 200, 400, "2", "400", id="illustration 1.1, page 15"),
        pytest.param(150, 300, 500, "2", None, id="illustration 1.2, page 16"),
    ],
)
def test_crank_and_slotted_lever(crank, apart, lever, ratio, stroke):
    """The crank is square to the lever at both ends: sin(ψ/2) = r/d; the tip moves 2·l·sin(ψ/2).

    5.3 asks for the lengths that give the ratio and the stroke, and prints them as 75.7 and 151.5.
    """
    found = shaper(crank, apart, lever)
    half = asin(crank / apart)
    assert rounds_to(found["ram"].time_ratio, ratio)
    assert found["lever"].extent == pytest.approx(2 * degrees(half), rel=1e-7)
    exact = (pi + 2 * half) / (pi - 2 * half)
    assert found["ram"].time_ratio == pytest.approx(exact, rel=1e-6)
    assert found["ram"].extent == pytest.approx(2 * lever * sin(half) / 1000, rel=1e-6)
    if stroke is not None:
        assert rounds_to(1000 * found["ram"].extent, stroke)


def test_khurmi_5_4_whitworth():
    """CD = 50, CA = 75: 2.735. The stroke of 87.5 mm, read off a drawing, is twice the tool's arm.

    The arm is inferred from it. The ram is at its ends where the lever lies along its path, so that
    cos(β/2) = CD/CA.
    """
    text = SHAPER.format(crank=75, below=-50, lever=43.75, rod=135, level=-50)
    found = travels(mechanism(text))
    back = 2 * acos(50 / 75)
    assert rounds_to(found["ram"].time_ratio, "2.735")
    assert found["ram"].time_ratio == pytest.approx((2 * pi - back) / back, rel=1e-7)
    assert rounds_to(1000 * found["ram"].extent, "87.5")
    assert found["lever"].full


def test_khurmi_15_3_largest_speed_of_a_piston():
    """r = 300 mm, l = 1 m, 200 rev/min: 75° and 6.54 m/s.

    Both are by v = ωr(sin θ + sin 2θ/2n), which is 0.4 % off here. The exact place is where the
    derivative of the exact speed vanishes.
    """
    r, rod, omega = 0.3, 1.0, 200 * RPM
    scene = replace(slider_crank(r, rod, 0.0, speed=omega).scene, ask=Ask(velocity=("B",)))
    found = extremes(Mechanism(scene))["|v_B|"].largest

    def speed(angle: float) -> float:
        s, c = sin(angle), cos(angle)
        return omega * (r * s + r * r * s * c / sqrt(rod * rod - r * r * s * s))

    first = min(place.at for place in found.places)
    assert round(first) == 75
    assert within(found.value, 6.54, share=0.005)
    step = radians(0.01)
    assert found.value == pytest.approx(speed(radians(first)), rel=1e-9)
    assert speed(radians(first)) > max(speed(radians(first) + way * step) for way in (-1, 1))


CAM = """
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
[frame]
O = [0, 0]
[links.1]
O = [0, 0]
[links.2]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 90 }}
[links.2.cam]
on = 1
tip = "knife"
base = 60
clockwise = true
law = [ {law} ]
[[drivers]]
turn = 1
angle = -20
speed = {speed}
[ask]
velocity = ["B"]
acceleration = ["B"]
"""


@pytest.mark.parametrize(
    ("lift", "out", "dwell", "back", "motion", "speed", "factors", "printed"),
    [
        pytest.param(
            *(40, 60, 45, 90, "harmonic", 300),
            *((pi / 2, pi**2 / 2), ("177.586", "78.927")),
            id="illustration 9.2, page 247",
        ),
        pytest.param(
            *(25, 120, 0, 90, "parabolic", 1000),
            *((2.0, 4.0), ("250.000", "444.444")),
            id="illustration 9.5, page 252",
        ),
    ],
)
def test_cams(lift, out, dwell, back, motion, speed, factors, printed):
    """The largest acceleration on the way out and back; the source takes π for 3.141.

    9.5 prints its numbers in cm/s², with m/s² behind them.
    """
    starts = [0, out, out + dwell, out + dwell + back]
    law = [f'{{ to = {starts[1]}, rise = {lift}, motion = "{motion}" }}']
    law += [f"{{ to = {starts[2]} }}"] if dwell else []
    law += [f'{{ to = {starts[3]}, rise = {-lift}, motion = "{motion}" }}', "{ to = 360 }"]
    text = CAM.format(law=", ".join(law), speed=-speed)
    windows = ((starts[0], starts[1]), (starts[2], starts[3]))
    for (low, high), way, shown in zip(windows, (out, back), printed, strict=True):
        moved = cycle(mechanism(text), steps=24, low=-high, high=-low)
        ((*every,),) = all_extremes(moved)
        own = {each.measure.label: each.largest.value for each in every}
        rate = speed * RPM / radians(way)
        assert own["|v_B|"] == pytest.approx(factors[0] * lift / 1000 * rate, rel=1e-7)
        assert own["|a_B|"] == pytest.approx(factors[1] * lift / 1000 * rate**2, rel=1e-7)
        assert within(own["|a_B|"], float(shown), share=0.001)


def test_geneva_wheel_of_four_slots():
    """The factors that tables of Geneva wheels print for four slots: 2.41 and 5.41."""
    crank = 120 * sin(pi / 4)
    text = scene_text("motion/lever-on-a-crank", crank=crank, apart=120)
    found = extremes(mechanism(text.partition("\n")[2].partition("\n")[2]))
    assert rounds_to(-found["ω_3"].least.value, "2.41")
    assert rounds_to(found["ε_3"].largest.value, "5.41")
