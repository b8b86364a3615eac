"""What the data say of parameters: each once, with the unit that its use gives it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from graphkin.construction.core import given_data
from graphkin.construction.core.given_data import given
from graphkin.construction.core.parameter_words import other_parameters, parameter, parameters
from graphkin.construction.drivers.driver_relations import of_driver
from graphkin.drawing.richtext import escape
from graphkin.mechanism import load
from graphkin.text import words
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawing_of, drawings

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
FIELD_LETTERS = {"r", "z", "m", "s", "v", "a"}
"""Letters under which the data print radii, teeth and what drivers give, whatever the scene."""


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("crank-slot", ["*angle* = 115°", "*a* = 80 mm", "*c* = 200 mm", "*d* = 60 mm"]),
        ("eight-link-2", ["*l* = 18 mm", "*v* = 360 mm/s", "*k* = 6"]),
        ("roller", ["*r* = 90 mm", "*v* = 400 mm/s", "*a* = 1000 mm/s²"]),
        ("crank-rocker", ["*n* = 4", "*L* = 90 mm"]),
        ("crank-fixed-slot", ["*angle* = 50°", "*beta* = 25°", "*a* = 80 mm", "*e* = 200 mm"]),
        ("excavator-relative", ["*t* = 0.5 s"]),
    ],
)
def test_a_parameter_has_the_unit_of_what_grows_as_it_does(name, wanted):
    """A number of steps (15 degrees for each n) and a factor have none."""
    scene = load(SCENES / f"{name}.toml").scene
    assert [parameter(scene, words("en"), each) for each in scene.values] == wanted


def test_the_head_of_a_page_has_the_parameters_that_expressions_take():
    assert parameters(load(SCENES / "crank-slot.toml").scene, words("en")) == []
    scene = load(SCENES / "crank-rocker.toml").scene
    assert parameters(scene, words("en")) == ["*n* = 4"]


def test_the_number_of_a_student_has_no_unit():
    assert parameters(load("pump", n=7).scene, words("ro")) == ["*n* = 7"]


def test_a_parameter_that_no_expression_takes_is_not_named():
    scene = load(SCENES / "crank-slot.toml").scene
    assert other_parameters(scene, words("en")) == []
    told = given(drawing_of("crank-slot", None, "velocity"))
    assert "*φ* = 115°" in told
    assert "*A**B* = 80 mm" in told


def test_a_parameter_put_into_an_expression_is_named_once_with_its_unit():
    """s = l·cos(alpha): both are needed, and the rod shows one of them."""
    scene = load(SCENES / "centrodes-cardan.toml").scene
    assert other_parameters(scene, words("en")) == ["*alpha* = 45°"]
    assert "*B**A* = *l* = 100 mm" in given(drawing_of("centrodes-cardan", None, "velocity"))


@pytest.mark.parametrize("name", CHOSEN)
def test_no_name_of_a_parameter_is_printed_that_nothing_else_takes(name):
    """What is named among the data is put into an expression of the calculation, and told all."""
    (drawing, *_) = drawings(name)
    scene = drawing.scene
    calculated = " ".join(r.symbols for d in scene.drivers for r in of_driver(drawing, d))
    for each in scene.values:
        letter = f"*{escape(each)}*"
        shown = f" = {letter} = " if each in FIELD_LETTERS else f"{letter} = "
        named = any(shown in piece for piece in given(drawing))
        assert named is (re.search(rf"{re.escape(letter)}(?!_)", calculated) is not None), each


def test_a_clockwise_speed_says_its_magnitude_and_sense_alone():
    scene = load(SCENES / "gears-planet.toml", n=-50).scene
    sun = next(driver for driver in scene.drivers if driver.speed.text == "n")
    assert list(given_data.of_driver(scene, words("en"), sun))[-1].endswith(
        "= 50 rev/min = constant, turning clockwise"
    )


def test_a_wheel_whose_radius_is_called_r_says_so_once():
    told = " ".join(given(drawing_of("roller", None, "velocity")))
    assert "*r* = 90 mm" in told
    assert "*r* = *r*" not in told
