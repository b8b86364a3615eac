"""R. S. Khurmi, J. K. Gupta, Theory of Machines, chapter 13: epicyclic trains, from tooth numbers.

Speeds in rev/min, counter-clockwise positive, as the arm sees them: (n - n_arm) of two wheels in
mesh stand as -T'/T outside and +T'/T inside a ring. The angles and the module are ours: no speed
depends on them.
"""

from __future__ import annotations

import pytest

from tests.scene_files import scene_text
from tests.textbook.book import RPM, answers, exactly, rounds_to


def speeds(text: str) -> dict[str, float]:
    """Speed of every link in rev/min; at constant speeds of the drivers nothing accelerates."""
    links = answers(text).links
    for link in links.values():
        assert exactly(link.epsilon, 0, largest=(500 * RPM) ** 2)
    return {name: link.omega / RPM for name, link in links.items()}


EPICYCLIC_13_4 = """
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
module = 4
[frame]
O = [0, 0]
[links.gearA]
O = [0, 0]
wheel = {{ centre = "O", teeth = 36 }}
[links.arm]
O-P = "4*(36 + 45)/2"
[links.gearB]
P = [0, 0]
wheel = {{ centre = "P", teeth = 45 }}
rolls = {{ on = "gearA" }}
[[drivers]]
turn = "arm"
angle = 20
speed = 150
[[drivers]]
turn = "gearA"
angle = 0
speed = {speed}
"""


@pytest.mark.parametrize(("speed", "printed"), [(0, "270"), (-300, "510")])
def test_khurmi_13_4_epicyclic(speed, printed):
    """Page 438: 36 and 45 teeth, the arm at 150 rev/min; gear A fixed, then 300 clockwise."""
    found = speeds(EPICYCLIC_13_4.format(speed=speed))["gearB"]
    assert rounds_to(found, printed)
    assert exactly(found, 150 - (speed - 150) * 36 / 45)


def test_khurmi_13_5_reverted_train():
    """Page 440: B of 75 teeth is fixed, C has 30, the compound gear 90 and 45 on the arm."""
    found = speeds(scene_text("textbook/reverted-13-5"))
    assert rounds_to(found["C"], "400")
    assert exactly(found["DE"], -100 * (1 + 75 / 45))
    assert exactly(found["C"], -100 - 90 / 30 * (found["DE"] + 100))


def test_khurmi_13_6_fixed_ring():
    """Page 443: the ring A of 72 teeth is fixed; B turns against the arm EF."""
    found = speeds(scene_text("textbook/ring-13-6"))
    assert rounds_to(found["C"], "58.5")
    assert rounds_to(found["B"], "-46.8")
    assert exactly(found["B"], 18 - 18 * 72 / 20)
    assert exactly(found["C"], 18 + 18 * 72 / 32)


SUN_AND_RING_13_7 = """
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
module = 4
[frame]
O = [0, 0]
[links.A]
O = [0, 0]
wheel = {{ centre = "O", teeth = 40 }}
[links.D]
O = [0, 0]
wheel = {{ centre = "O", teeth = 90, inside = true }}
[links.arm]
O-P = 130
[links.B]
P = [0, 0]
wheel = {{ centre = "P", teeth = 25 }}
rolls = [{{ on = "A" }}, {{ on = "D" }}]
[[drivers]]
turn = "A"
angle = 50
speed = -1
[[drivers]]
turn = "D"
angle = 10
speed = {ring}
"""


@pytest.mark.parametrize(
    ("ring", "printed", "recomputed"), [(0.5, "0.04", "0.038462"), (0, "-0.308", "-0.307692")]
)
def test_khurmi_13_7_sun_and_ring(ring, printed, recomputed):
    """Page 444: the arm between sun A, one turn clockwise, and ring D, half a turn or none."""
    found = speeds(SUN_AND_RING_13_7.format(ring=ring))
    assert rounds_to(found["arm"], printed)
    assert exactly(found["arm"], (90 * ring - 40) / 130, largest=1)
    assert exactly(found["B"], found["arm"] + (ring - found["arm"]) * 90 / 25)
    assert rounds_to(found["arm"], recomputed)


TWO_RINGS_13_8 = """
units = {{ length = "mm", angle = "deg", speed = "rev/min" }}
module = 4
[frame]
O = [0, 0]
[links.A]
O = [0, 0]
wheel = {{ centre = "O", teeth = 64, inside = true }}
[links.arm]
O-P = 92
O-Q = 88
P-O-Q = 120
[links.E]
P = [0, 0]
wheel = {{ centre = "P", teeth = 18 }}
rolls = {{ on = "A" }}
[links.CD]
O = [0, 0]
wheels = [{{ centre = "O", teeth = 28 }}, {{ centre = "O", teeth = 26 }}]
rolls = {{ on = "E" }}
[links.F]
Q = [0, 0]
wheel = {{ centre = "Q", teeth = 18 }}
rolls = {{ on = "CD" }}
[links.B]
O = [0, 0]
wheel = {{ centre = "O", teeth = 62, inside = true }}
rolls = {{ on = "F" }}
[[drivers]]
turn = "arm"
angle = 35
speed = -100
[[drivers]]
turn = "A"
angle = 0
speed = {ring}
"""


@pytest.mark.parametrize(("ring", "printed"), [(0, "-4.1"), (10, "5.4")])
def test_khurmi_13_8_two_rings(ring, printed):
    """Page 446: two trains in series, A 64, E 18, C 28 and D 26, F 18, B 62; the arm G at -100."""
    found = speeds(TWO_RINGS_13_8.format(ring=ring))
    assert rounds_to(found["B"], printed)
    assert exactly(found["CD"], -100 - (ring + 100) * 64 / 28)
    assert exactly(found["B"], -100 + (ring + 100) * (64 / 28) * (26 / 62), largest=100)
