"""Laws of forces: three routes agree, and what must hold of every equilibrium holds."""

from __future__ import annotations

import math
import random

import pytest

from graphkin.construction.core.solution import by_name
from graphkin.text.errors import SceneError, StructureError
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

FOUR_BAR = """
gravity = [0.3, -9.81]
[frame]
O = [0, 0]
C = [{d}, {e}]
[links.1]
O-A = {a}
mass = 1.5
centre = "O"
inertia = 0.4
[links.2]
A-B = {b}
A-S = {s}
S-B = {r}
S = "left of A-B"
mass = 2.5
centre = "S"
inertia = 0.3
[links.3]
C-B = {c}
mass = 1.2
centre = "B"
[[loads]]
at = "S"
link = 2
force = [{fx}, {fy}]
[[loads]]
link = 3
moment = {m}
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
acceleration = {rate}
[branches]
B = "left of A-C"
"""
SLIDER = """
gravity = true
[frame]
O = [0, 0]
[links.1]
O-A = 0.1
[links.2]
A-B = 0.35
A-S = 0.15
S = "on A-B"
mass = 2
centre = "S"
inertia = 0.05
[links.3]
B = [0, 0]
S4 = [0.1, 0.03]
mass = 3
centre = "S4"
slides = { on = 0, through = [0, 0.02], angle = 10 }
[[loads]]
at = "S4"
force = [-500, 40]
[[drivers]]
turn = 1
angle = 50
speed = 20
[branches]
3 = "forward"
"""
SWINGING = """
gravity = true
[frame]
O = [0, 0]
C = [0, -0.3]
[links.1]
O-A = 0.1
[links.2]
A = [0, 0]
S2 = [0.05, 0.02]
mass = 1.5
centre = "S2"
inertia = 0.01
slides = { on = 3, through = "C", angle = 0 }
[links.3]
C = [0, 0]
S3 = [0.25, 0.01]
mass = 4
centre = "S3"
inertia = 0.1
[[loads]]
at = "S3"
force = [100, -30]
[[drivers]]
turn = 1
angle = 25
speed = 12
acceleration = 5
[branches]
2 = "forward"
"""
CROSSED = """
gravity = true
[frame]
O = [0, 0]
G = [0.3, 0]
[links.1]
O-A = 0.08
[links.2]
A = [0, 0]
mass = 1
slides = { on = 3, through = "E", angle = 115 }
[links.3]
E = [0, 0]
S = [0.02, 0.1]
mass = 2
centre = "S"
inertia = 0.03
slides = { on = 0, through = "G", angle = 90 }
[[loads]]
at = "S"
force = [30, -60]
[[loads]]
moment = 4
link = 2
[[drivers]]
turn = 1
angle = 50
speed = 10
"""
TWO_BLOCKS = """
gravity = true
[frame]
O = [0, 0]
[links.1]
D = [0, 0]
mass = 2
slides = { on = 0, through = "O", angle = 20 }
[links.2]
D-E = 0.5
D-S = 0.2
S = "on D-E"
mass = 3
centre = "S"
inertia = 0.1
[links.3]
E = [0, 0]
mass = 1
slides = { on = 0, through = "O", angle = 100 }
[[loads]]
at = "E"
force = [-40, 25]
[[drivers]]
slide = 1
position = 0.3
speed = 0.7
acceleration = 2
[branches]
3 = "forward"
"""


def three_links(on: int) -> str:
    """Three links on a pin with two loads: one on link 4, the other on one of the three."""
    return scene_text("laws/three-links-on-a-pin", first=on, second=4)


def solved(text: str):
    """The forces of a text; both other routes agree."""
    found, verdict = mechanism_of(text).forces()
    assert verdict.agrees, verdict
    return found


def four_bar(rng: random.Random) -> str:
    """A crank-rocker with masses, loads, and a driver that speeds up."""
    u = rng.uniform
    values = {"a": u(0.08, 0.15), "b": u(0.45, 0.55), "c": u(0.35, 0.45), "d": u(0.5, 0.58)}
    values |= {"e": u(-0.05, 0.05), "s": u(0.3, 0.4), "r": u(0.3, 0.4), "m": u(-50, 50)}
    values |= {"fx": u(-900, 900), "fy": u(-900, 900), "angle": u(0, 360)}
    return FOUR_BAR.format(**values, speed=u(-30, 30), rate=u(-200, 200))


@pytest.mark.parametrize("seed", range(12))
def test_three_routes_agree_for_random_four_bars(seed):
    solved(four_bar(random.Random(seed)))


@pytest.mark.parametrize(
    "text", [SLIDER, SWINGING, CROSSED, TWO_BLOCKS], ids=["RRP", "RPR", "RPP", "PRP"]
)
def test_three_routes_agree_for_each_dyad_with_slides(text):
    solved(text)


@pytest.mark.parametrize("on", [2, 3, 4])
def test_a_load_on_a_pin_of_three_links_acts_alike_on_the_rest(on):
    """The link that takes the load changes only its own force in that pin."""
    found = solved(three_links(on))
    load = 70 - 120j
    pin = {each.link: each.force for each in by_name(found, "B")["B"]}
    assert abs(sum(pin.values())) < 1e-9 * abs(load)
    pin[str(on)] += load
    other = solved(three_links(2))
    expected = {each.link: each.force for each in by_name(other, "B")["B"]}
    expected["2"] += load
    for link, force in pin.items():
        assert abs(force - expected[link]) < 1e-9 * abs(load)


def test_a_pin_of_a_massless_bar_carries_along_the_bar():
    bar = by_name(solved(three_links(3)), "A")["A"]
    mechanism = mechanism_of(three_links(3))
    places = {name: each.position for name, each in mechanism.solve().points.items()}
    along = places["B"] - places["A"]
    for each in bar:
        assert abs((each.force.conjugate() * along).imag) < 1e-9 * abs(each.force * along)


def test_without_loads_and_masses_every_reaction_is_zero():
    text = SWINGING.replace("mass = 1.5", "mass = 0").replace("mass = 4", "mass = 0")
    text = text.replace("inertia = 0.01", "").replace("inertia = 0.1", "")
    found = solved(text.replace("[100, -30]", "[0, 0]"))
    assert all(abs(each.force) == 0 for each in found.reactions)
    assert [each.moment for each in found.balance] == [0]


def test_reversed_motion_leaves_reactions_as_they_are():
    """Inertia forces depend on the squares of velocities and on the driver's acceleration."""
    forward, back = (solved(SLIDER.replace("speed = 20", f"speed = {n}")) for n in (20, -20))
    for one, other in zip(forward.reactions, back.reactions, strict=True):
        assert abs(one.force - other.force) < 1e-9 * (1 + abs(one.force))


def test_a_balanced_crank_turns_by_its_inertia_alone():
    """J·ε of a crank whose centre of mass is its pivot: the balance is that moment."""
    text = """
[frame]
O = [0, 0]
[links.1]
O-A = 0.2
mass = 3
centre = "O"
inertia = 0.7
[[drivers]]
turn = 1
angle = 30
speed = 9
acceleration = 4
"""
    (balance,) = solved(text).balance
    assert math.isclose(balance.moment, 0.7 * 4, rel_tol=1e-12)


def test_reactions_grow_as_one_over_the_distance_from_a_dead_point():
    """A slider pushed, with its own force as the driver, near the crank's dead point."""
    text = """
[frame]
O = [0, 0]
[links.1]
O-A = 0.1
[links.2]
A-B = 0.3
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[loads]]
moment = 5
link = 1
[[drivers]]
slide = 3
position = {at}
speed = 1
[branches]
A = "left of O-B"
"""
    forces = [
        max(abs(each.force) for each in solved(text.format(at=0.4 - gap)).reactions)
        for gap in (1e-4, 1e-6)
    ]
    assert math.isclose(forces[1] / forces[0], 10, rel_tol=0.01)


PARALLEL = """
[frame]
A = [0, 0]
B = [0.3, 0]
C = [0.6, 0]
[links.1]
A-D = 0.1
[links.2]
D-E = 0.3
D-F = 0.6
E = "on D-F"
[links.3]
B-E = 0.1
[links.4]
C-F = 0.1
[[loads]]
at = "E"
link = 2
force = [0, -10]
[[drivers]]
turn = 1
angle = 70
speed = 3
"""


def test_a_redundant_bar_is_refused_by_rank():
    with pytest.raises(StructureError, match="1 redundant constraints among A, B, C, D, F, E"):
        mechanism_of(PARALLEL).forces()


def test_every_mistake_of_forces_is_listed():
    wrong = SLIDER.replace("gravity = true", "gravity = 9.81")
    wrong = wrong.replace('centre = "S"', 'centre = "T"').replace("inertia = 0.05", "inertia = -1")
    wrong = wrong.replace('at = "S4"', 'at = "Z"').replace("[-500, 40]", '["-500*k", 40]')
    wrong += '[ask]\nreactions = ["Q"]\nbalance = 1\n'
    with pytest.raises(SceneError) as caught:
        mechanism_of(wrong)
    assert {each.place for each in caught.value.problems} >= {
        "gravity",
        "links.2.centre",
        "links.2.inertia",
        "loads[0].at",
        "loads[0].force[0]",
        "ask.reactions[0]",
        "ask.balance",
    }


def test_a_scene_without_forces_has_none():
    text = SWINGING.partition("[[loads]]")[0].replace("gravity = true", "")
    for key in ("mass", "centre", "inertia"):
        text = "\n".join(line for line in text.splitlines() if not line.startswith(key))
    text += '\n[[drivers]]\nturn = 1\nangle = 25\nspeed = 12\n[branches]\n2 = "forward"\n'
    assert mechanism_of(text).forces() is None
