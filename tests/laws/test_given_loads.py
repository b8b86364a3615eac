"""Loads by a table of the driver's coordinate, by size and direction, along a motion; springs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.laws.force_routes import differences

SCENE = Path(__file__).parents[1] / "scenes" / "forces" / "gas-engine.toml"
TABLE = [4200, 7600, 4100, 2300, 1500, 900, 300, 120, 140, 260, 620, 1700]
"""The gas force (N) every 30 degrees."""
PLAIN = """
graphkin = 1
title = "Crank and block without masses"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[parameters]
phi = 50
[frame]
O = [0, 0]
Q = [500, 0]
[links.1]
O-A = 100
[links.2]
A-B = 300
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
LOAD
[[drivers]]
turn = 1
angle = "phi"
speed = 7
[branches]
3 = "forward"
[ask]
reactions = [3, "O"]
balance = true
"""


def plain(load: str, **values: float) -> Mechanism:
    """The crank and block with a load."""
    return Mechanism(read_text(PLAIN.replace("LOAD", load), "plain", None, values))


def balance(mechanism: Mechanism) -> float:
    """The balancing moment of the crank, once the routes agree."""
    found, verdict = mechanism.forces()
    assert verdict.agrees and verdict.constructed
    (only,) = found.balance
    return only.moment


def slope(mechanism: Mechanism) -> float:
    """The velocity of B per unit of the crank's rate, in m."""
    return mechanism.solve().points["B"].velocity.real / 7


@pytest.mark.parametrize("phi", [0, 15, 30, 105, 345])
def test_a_gas_force_lies_on_the_straight_lines_of_its_table(phi):
    """The lever and the equations agree, and the force is numpy's interpolation."""
    text = SCENE.read_text(encoding="utf-8")
    mechanism = Mechanism(read_text(text, "gas", None, {"phi": phi}))
    assert max(differences(mechanism)) < 1e-12
    points = ", ".join(f"[{30 * k}, {each}]" for k, each in enumerate(TABLE))
    given = plain(f'[[loads]]\nat = "B"\nforce = {{ size = [{points}], angle = 180 }}', phi=phi)
    force = np.interp(phi, range(0, 361, 30), [*TABLE, TABLE[0]])
    assert math.isclose(balance(given), force * slope(given), rel_tol=1e-9, abs_tol=1e-9)


@pytest.mark.parametrize(("phi", "force"), [(0, 10), (180, 20), (450, 35), (719.999999, 50)])
def test_a_table_up_to_720_degrees_begins_again_after_two_turns(phi, force):
    """As for a four-stroke engine; a number at the last place holds up to it."""
    table = "[[0, 10], [180, 20], [360, 30], [720, 50]]"
    given = plain(f"[[loads]]\nlink = 1\nmoment = {table}", phi=phi)
    assert math.isclose(balance(given), -force, rel_tol=1e-6)
    again = plain(f"[[loads]]\nlink = 1\nmoment = {table}", phi=phi + 720)
    assert math.isclose(balance(again), balance(given), rel_tol=1e-6)


@pytest.mark.parametrize("phi", [50, 130, 200, 310])
@pytest.mark.parametrize("word", ["along", "against"])
def test_a_force_along_or_against_a_motion_keeps_its_power(phi, word):
    load = f'[[loads]]\nat = "B"\nforce = {{ size = 500, motion = "{word}" }}'
    given = plain(load, phi=phi)
    sign = 1 if word == "against" else -1
    assert math.isclose(balance(given), sign * 500 * abs(slope(given)), rel_tol=1e-9)


def test_a_spring_pulls_by_its_elongation():
    """The balance is the derivative of the energy c·(l − l_0)²/2 by the crank's angle."""
    load = '[[springs]]\nbetween = "B-Q"\nstiffness = 2000\nfree = 90'

    def energy(phi: float) -> float:
        length = abs(plain(load, phi=phi).solve().points["B"].position - 0.5)
        return 1000 * (length - 0.09) ** 2

    step = math.radians(2e-3)
    found = (energy(50.001) - energy(49.999)) / step
    assert math.isclose(balance(plain(load)), found, rel_tol=1e-6)


def test_a_spring_between_two_moving_links_has_opposite_forces():
    load = '[[springs]]\nbetween = "A-B"\nlinks = [1, 3]\nstiffness = 100\nfree = 250'
    given = plain(load)
    assert abs(balance(given)) < 1e-12
    assert max(differences(plain(load.replace("A-B", "A-Q").replace("[1, 3]", "[1, 0]")))) < 1e-9


@pytest.mark.parametrize(
    ("load", "place", "said"),
    [
        ("[[loads]]\nlink = 1\nmoment = [[0, 1]]", "loads[0].moment", "two points"),
        ("[[loads]]\nlink = 1\nmoment = [[0, 1], [0, 2]]", "loads[0].moment", "each greater"),
        ("[[loads]]\nlink = 1\nmoment = [[0, 1], [9, 2]]\nover = 2", "loads[0].over", "a driver"),
        ('[[loads]]\nat = "B"\nforce = { size = 1, motion = "up" }', "loads[0].force.motion", "al"),
        ('[[springs]]\nbetween = "B"\nstiffness = 1\nfree = 1', "springs[0].between", "two points"),
        ('[[springs]]\nbetween = "B-X"\nstiffness = 1\nfree = 1', "springs[0].between", "X"),
        ("[[springs]]\nbetween = 3", "springs[0].stiffness", "nothing"),
    ],
)
def test_a_mistake_in_a_load_is_named_with_its_place(load, place, said):
    with pytest.raises(SceneError) as caught:
        plain(load)
    problem = next(each for each in caught.value.problems if each.place == place)
    assert said in str(problem)
