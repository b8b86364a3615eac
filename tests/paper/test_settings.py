"""What the data say of parameters: each once, with the unit that its use gives it."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphkin.mechanism import load
from graphkin.paper.data import given, of_driver
from graphkin.paper.settings import other_parameters, parameters
from graphkin.text import words
from tests.paper.sheet_tools import drawing_of

SCENES = Path(__file__).parents[2] / "examples" / "scenes"


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
    assert parameters(load(SCENES / f"{name}.toml").scene, words("en")) == wanted


def test_the_number_of_a_student_has_no_unit():
    assert parameters(load("pump", n=7).scene, words("ro")) == ["*n* = 7"]


def test_a_parameter_that_a_driver_or_a_length_shows_is_not_printed_again():
    scene = load(SCENES / "crank-slot.toml").scene
    assert other_parameters(scene, words("en")) == ["*c* = 200 mm", "*d* = 60 mm"]
    told = given(drawing_of("crank-slot", None, "velocity"))
    assert "*φ* = *angle* = 115°" in told
    assert "*A**B* = *a* = 80 mm" in told


def test_a_clockwise_speed_does_not_say_that_its_parameter_is_positive():
    """The sense stands in words, so the magnitude alone is printed, and the parameter apart."""
    scene = load(SCENES / "gears-planet.toml", n=-50).scene
    assert "*n* = −50 rev/min" in other_parameters(scene, words("en"))
    sun = next(driver for driver in scene.drivers if driver.speed.uses())
    assert any("= 50 rev/min" in piece for piece in of_driver(scene, words("en"), sun))


def test_a_wheel_whose_radius_is_called_r_says_so_once():
    told = " ".join(given(drawing_of("roller", None, "velocity")))
    assert "*r* = 90 mm" in told
    assert "*r* = *r*" not in told
