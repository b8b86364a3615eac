"""What the data say of parameters: each once, with the unit that its use gives it."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphkin.construction.core.given_data import (
    given,
    law,
    other_parameters,
    parameter,
    variant,
)
from graphkin.mechanism import load
from graphkin.text import words
from tests.documents.sheet_tools import drawing_of

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
NUMBERED = """
graphkin = 1
title = "Crank"
units = { length = "mm", angle = "deg", speed = "rev/min" }
[parameters]
n = { value = 5, min = 1, max = 9, step = 1 }
[frame]
O = [0, 0]
[links.1]
O-A = "70 + n"
[[drivers]]
turn = 1
angle = "20 + 10*n"
speed = "-(60 + 2*n)"
[ask]
velocity = ["A"]
"""


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("crank-slot", ["*angle* = 115°", "*a* = 80 mm", "*c* = 200 mm", "*d* = 60 mm"]),
        ("eight-link-2", ["*l* = 18 mm", "*v* = 360 mm/s", "*k* = 6"]),
        ("roller", ["*r* = 90 mm", "*v* = 400 mm/s", "*a* = 1000 mm/s²"]),
        ("crank-rocker", ["*n* = 4", "*L* = 90 mm"]),
        ("crank-fixed-slot", ["*angle* = 50°", "*β* = 25°", "*a* = 80 mm", "*e* = 200 mm"]),
        ("excavator-relative", ["*t* = 0.5 s"]),
    ],
)
def test_a_parameter_has_the_unit_of_what_grows_as_it_does(name, wanted):
    """A number of steps (15 degrees for each n) and a factor have none."""
    scene = load(SCENES / f"{name}.toml").scene
    assert [parameter(scene, words("en"), each) for each in scene.values] == wanted


def test_a_number_that_moves_lengths_and_angles_has_no_unit(tmp_path):
    """The crank is 70 + n long and stands at 20 + 10n degrees: n is a student's number."""
    path = tmp_path / "scene.toml"
    path.write_text(NUMBERED)
    scene = load(path).scene
    assert parameter(scene, words("en"), "n") == "*n* = 5"
    (driver,) = scene.drivers
    assert law(scene, words("en"), driver.position) == "(20 + 10·*n*)°"
    assert law(scene, words("en"), driver.speed) == "−(60 + 2·*n*) rev/min"


def test_a_parameter_that_no_expression_takes_is_not_named():
    scene = load(SCENES / "crank-slot.toml").scene
    assert other_parameters(scene, words("en")) == []
    told = given(drawing_of("crank-slot", None, "velocity"))
    assert "*φ* = 115°" in told
    assert "*A**B* = 80 mm" in told


def test_a_parameter_put_into_an_expression_is_named_once_with_its_unit():
    """s = l·cos(alpha): both are needed, and the rod shows one of them."""
    scene = load(SCENES / "centrodes-cardan.toml").scene
    assert other_parameters(scene, words("en")) == [("alpha", "*α*", "45°")]
    assert "*B**A* = *l* = 100 mm" in given(drawing_of("centrodes-cardan", None, "velocity"))


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("cam-plate", ["*s* = 30 mm"]),  # its parameter is x
        ("plank-rollers", ["*v*_{3} = 200 mm/s"]),
        ("gears-planet", ["*φ*_{2} = 40°", "*n*_{1} = −50 rev/min"]),
        ("centrodes-cardan", ["*α* = 45°", "*l* = 100 mm"]),  # others hang on them
        ("pump", ["*n* = 1"]),
    ],
)
def test_what_tells_a_variant_has_the_letters_of_its_sheet(name, wanted):
    path = SCENES / f"{name}.toml"
    mechanism = load(path) if path.exists() else load(name, n=1)
    assert variant(mechanism.scene, words("en")) == wanted
    n = None if path.exists() else 1
    told = " ".join(given(drawing_of(name, n, "velocity")))
    assert all(f"{each.partition(' ')[0]} = " in told for each in wanted)
