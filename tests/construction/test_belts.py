"""Belts: the rims of both wheels run at one speed along the strands, seen from the arm."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import load
from graphkin.text.errors import SceneError, StructureError
from tests.documents.sheet_tools import FOLDER
from tests.textbook.book import RPM, answers

TESTS = Path(__file__).parents[1]
OWN, OTHER, APART = 24.0, 60.0, 150.0
HEAD = """
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
ON_ARM = """
[frame]
O = [0, 0]
[links.1]
O-S = 45
wheel = {{ centre = "O", radius = 60 }}
[links.2]
O-P = 150
[links.3]
P-Q = 40
wheel = {{ centre = "P", radius = 24 }}
belt = {{ on = 1, crossed = {crossed} }}
[[drivers]]
turn = 2
angle = 40
speed = 7
acceleration = 11
[[drivers]]
turn = 1
angle = 110
speed = -3
acceleration = 5
"""


BOTH = pytest.mark.parametrize("crossed", [False, True])


def test_khurmi_11_1_engine_line_shaft_dynamo():
    found = load(FOLDER / "belts-dynamo.toml").solve()
    assert found.links["3"].omega / RPM == pytest.approx(1500)
    assert found.links["2"].omega / RPM == pytest.approx(250)


@pytest.mark.parametrize("name", ["belts-dynamo", "belts-crossed", "belts-arm"])
def test_the_closures_agree_over_the_turn(name):
    for angle in (0, 75, 210, 345):
        made = load(FOLDER / f"{name}.toml", angle=angle)
        assert made.witness(made.solve()).agrees


ON_FRAME = """
[frame]
O = [0, 0]
P = [{apart}, 0]
[links.1]
O-S = 45
wheel = {{ centre = "O", radius = 60 }}
[links.3]
P-Q = 40
wheel = {{ centre = "P", radius = {radius}{more} }}
belt = {{ on = 1{keys} }}
[[drivers]]
turn = 1
angle = 40
speed = 7
"""


@pytest.mark.parametrize(
    ("apart", "radius", "more", "keys", "said"),
    [
        (
            80,
            24,
            "",
            "",
            "overlap or touch: the frame keeps O-P = 80 mm; expected more than the sum",
        ),
        (
            150,
            24,
            "",
            ' }\n[links.4]\nO-T = 9\nwheel = { centre = "T", radius = 9 }\n[links.5]\nQ-U = 9\n'
            'wheel = { centre = "U", radius = 8 }\nbelt = { on = 4',
            "links.5.belt: no link carries both centres, T and U; expected an arm: a link with T-U",
        ),
        (84, 24, "", ", crossed = true", "expected more than the sum of the radii, 84 mm"),
        (150, 24, ", inside = true", "", "links.3.belt: the wheel of link 3 is a ring"),
        (150, 24, "", ", wheels = [2, 1]", "links.3.belt.wheels: wheel 2 of link 3, which has 1"),
        (150, 24, "", ", wheels = 2", "links.3.belt.wheels: 2; expected [1, 2]"),
        (150, 24, "", ", crossed = 1", "links.3.belt.crossed: 1; expected true or false"),
    ],
)
def test_what_no_belt_can_do_is_told(apart, radius, more, keys, said):
    text = HEAD + ON_FRAME.format(apart=apart, radius=radius, more=more, keys=keys)
    with pytest.raises((SceneError, StructureError)) as told:
        answers(text)
    assert said in str(told.value)


def test_a_belt_needs_an_arm():
    text = HEAD + ON_ARM.format(crossed="false").replace("O-P = 150", "O-R = 150")
    with pytest.raises((SceneError, StructureError), match="an arm: a link with O-P"):
        answers(text)


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


MOVING_PULLEY = """
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
[links.1]
O-A = 50
wheel = { centre = "O", radius = 50 }
rolls = { on = 2, through = "B", angle = 0 }
[links.2]
B = [0, 0]
slides = { on = 0, through = [50, -100], angle = 90 }
[links.3]
P = [0, 0]
wheel = { centre = "P", radius = 80 }
rolls = [
  { on = 2, through = [-200, 0], angle = 0, side = "right" },
  { on = 0, through = [210, -300], angle = 90 },
]
[[drivers]]
turn = 1
angle = 30
speed = 4
acceleration = 6
"""


def test_a_moving_pulley_rises_at_half_the_speed_of_the_rope():
    found = answers(MOVING_PULLEY)
    assert found.points["B"].velocity == pytest.approx(0.2j)
    assert found.points["P"].velocity == pytest.approx(0.1j)
    assert found.points["P"].acceleration == pytest.approx(0.15j)
    assert found.links["3"].omega == pytest.approx(-0.1 / 0.08)


IN_SERIES = """
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
wheel = { centre = "O", radius = 20 }
[links.1]
O-S = 45
wheel = { centre = "O", radius = 40 }
[links.2]
O-P = 150
P-R = 140
O-R = 200
R = "left of O-P"
[links.3]
P-Q = 40
wheels = [{ centre = "P", radius = 24 }, { centre = "P", radius = 50 }]
belt = { on = 1 }
[links.4]
R-V = 20
wheels = [{ centre = "R", radius = 24 }, { centre = "R", radius = 30 }]
belt = [
  { on = 3, wheels = [1, 2], crossed = true },
  { on = 0, wheels = [2, 1] },
]
[[drivers]]
turn = 1
angle = 20
speed = 149
acceleration = 4
"""


def test_belts_in_series_on_a_free_arm():
    """From wheel 1 by 40/24 and -50/24, from the fixed wheel by 20/30: 24 ω2 = 125 (ω1 - ω2)."""
    links = answers(IN_SERIES).links
    assert links["2"].omega == pytest.approx(125)
    assert links["2"].epsilon == pytest.approx(4 * 125 / 149)
    assert links["3"].omega == pytest.approx(125 + 24 * 40 / 24)
    assert links["4"].omega == pytest.approx(125 - 125 * 20 / 30)


ON_A_COUPLER = """
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
[frame]
O1 = [0, 0]
O2 = [300, 0]
[links.1]
O1-A = 80
wheel = {{ centre = "A", radius = 30 }}
[links.2]
A-B = 280
[links.3]
O2-B = 200
[links.4]
B-Q = 40
wheel = {{ centre = "B", radius = 45 }}
belt = {{ on = 1, crossed = {crossed}, start = {{ 1 = 60, 2 = 20 }} }}
[[drivers]]
turn = 1
angle = 50
speed = 10
[branches]
B = "left of A-O2"
"""


@BOTH
def test_a_belt_from_a_crank_to_a_wheel_on_its_coupler(crossed):
    links = answers(ON_A_COUPLER.format(crossed=str(crossed).lower())).links
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
    text = HEAD + ON_ARM.format(crossed="false").replace("radius = 24", "radius = 60")
    text = text.replace("[links.1]\nO-S = 45\nwheel", "wheel").replace("{ on = 1", "{ on = 0")
    text = text[: text.rindex("[[drivers]]")]
    found = answers(text)
    assert (found.links["3"].omega, found.links["3"].epsilon) == (0, 0)
    assert found.points["Q"].velocity == pytest.approx(found.points["P"].velocity)
    assert found.points["Q"].acceleration == pytest.approx(found.points["P"].acceleration)


def test_wheels_that_are_equal_by_chance_are_refused():
    """A variant would tear them apart: the same radius is written for both."""
    text = HEAD + "[parameters]\nr = 60\n" + ON_ARM.format(crossed="false")
    with pytest.raises(StructureError, match="of radius 60 mm by chance; expected wheels of"):
        answers(text.replace("radius = 24", 'radius = "r"'))


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
