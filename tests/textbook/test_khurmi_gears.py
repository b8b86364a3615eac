"""R. S. Khurmi, J. K. Gupta, Theory of Machines, chapter 13: epicyclic trains, from tooth numbers.

Speeds in rev/min, counter-clockwise positive, as the arm sees them: (n - n_arm) of two wheels in
mesh stand as -T'/T outside and +T'/T inside a ring. The angles and the module are ours: no speed
depends on them.
"""

from __future__ import annotations

import pytest

from graphkin.structure.driver_count import count
from graphkin.text.errors import SceneError, StructureError
from tests.scene_files import scene_text
from tests.textbook.book import RPM, answers, exactly, mechanism, rounds_to


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


# --- the same trains, of which the book states nothing but the teeth ------------------------------

BY_TEETH_13_4 = EPICYCLIC_13_4.replace("module = 4\n", "").replace('"4*(36 + 45)/2"', "70")
BY_TEETH_13_5 = """
units = { length = "mm", angle = "deg", speed = "rev/min" }
[frame]
O = [0, 0]
wheel = { centre = "O", teeth = 75 }
[links.DE]
P = [0, 0]
wheels = [{ centre = "P", teeth = 90 }, { centre = "P", teeth = 45 }]
rolls = { on = 0, wheels = [2, 1], link = "arm" }
[links.C]
O = [0, 0]
wheel = { centre = "O", teeth = 30 }
rolls = { on = "DE", wheels = [1, 1] }
[[drivers]]
turn = "arm"
angle = 40
speed = -100
"""
BY_TEETH_13_7 = """
units = { length = "in", angle = "deg", speed = "rev/min" }
[frame]
O = [0, 0]
[links.A]
O = [0, 0]
wheel = { centre = "O", teeth = 40 }
[links.D]
O = [0, 0]
wheel = { centre = "O", teeth = 90, inside = true }
[links.B]
P = [0, 0]
wheel = { centre = "P", teeth = 25 }
rolls = [{ on = "A", link = "arm" }, { on = "D" }]
[[drivers]]
turn = "A"
angle = 50
speed = -1
[[drivers]]
turn = "D"
angle = 10
speed = 0.5
"""


@pytest.mark.parametrize(("speed", "printed"), [(0, "270"), (-300, "510")])
def test_khurmi_13_4_by_its_teeth(speed, printed):
    """The arm has any length; the teeth divide it."""
    assert rounds_to(speeds(BY_TEETH_13_4.format(speed=speed))["gearB"], printed)


def test_khurmi_13_5_by_its_teeth():
    """No length at all; the second pair takes its module from the distance that the first keeps."""
    found = speeds(BY_TEETH_13_5)
    assert rounds_to(found["C"], "400")
    assert exactly(found["DE"], -100 * (1 + 75 / 45))
    scene = mechanism(BY_TEETH_13_5).scene
    radii = {
        (link.name, wheel.teeth.text): wheel.radius.number({})
        for link in scene.every_link
        for wheel in link.wheels
    }
    assert radii["0", "75"] + radii["DE", "45"] == radii["DE", "90"] + radii["C", "30"] == 120
    assert [wheel.sized for wheel in scene.links["C"].wheels] == ["distance"]


def test_khurmi_13_7_by_its_teeth():
    """Sun and ring fit one planet by their teeth, 40 + 2·25 = 90; the program adds the arm."""
    found = speeds(BY_TEETH_13_7)
    assert rounds_to(found["arm"], "0.04")
    assert exactly(found["arm"], (90 * 0.5 - 40) / 130, largest=1)
    assert count(mechanism(BY_TEETH_13_7).scene).mobility == 2


def test_a_ring_that_does_not_fit():
    """A planet of 25 on a sun of 40 reaches a ring of 90, not one of 88."""
    with pytest.raises(StructureError, match="90 teeth instead of 88 would touch there"):
        mechanism(BY_TEETH_13_7.replace("teeth = 90", "teeth = 88")).solve()


def test_compound_wheels_say_which_mesh():
    """Without the pair named, either wheel of the planet may touch the fixed one."""
    with pytest.raises(SceneError, match="several wheels known by their teeth alone"):
        mechanism(BY_TEETH_13_5.replace("wheels = [2, 1], ", ""))


def test_a_rack_needs_a_length():
    """The way of a rack in one turn of its pinion is no ratio of teeth."""
    rack = """
units = { length = "mm", angle = "deg", speed = "rev/min" }
[frame]
O = [0, 0]
[links.1]
O = [0, 0]
wheel = { centre = "O", teeth = 20 }
rolls = { on = 2, through = "B", angle = 0 }
[links.2]
B = [0, 0]
slides = { on = 0, through = [0, -50], angle = 0 }
[[drivers]]
turn = 1
angle = 20
speed = 60
"""
    with pytest.raises(SceneError, match="teeth without a module"):
        mechanism(rack)
    assert mechanism(rack.replace("teeth = 20", "teeth = 20, module = 5")).solve()


def test_a_chain_by_its_teeth():
    """48 teeth turn 16 three times; both sprockets fit between their axles."""
    chain = """
units = { length = "in", angle = "deg", speed = "rev/min" }
[frame]
A = [0, 0]
B = [17, 0]
[links.front]
A = [0, 0]
wheel = { centre = "A", teeth = 48 }
[links.rear]
B = [0, 0]
wheel = { centre = "B", teeth = 16 }
belt = { on = "front" }
[[drivers]]
turn = "front"
angle = 20
speed = 60
"""
    assert exactly(speeds(chain)["rear"], 180)
