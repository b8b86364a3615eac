"""Figures that are changed on a page: it then draws what Python draws of the scene so changed."""

from __future__ import annotations

from typing import Any

import pytest
from msgspec.structs import replace

from graphkin.mechanism import Mechanism, load
from graphkin.scene.quantity import expression
from graphkin.web.page_driver import figures, of_drivers
from tests.documents.sheet_tools import FOLDER, mechanism_named
from tests.scene_files import FOLDER as SCENES
from tests.web.test_moving import LABS, compared, marks_of, named, page_of
from tests.web.written import ran

PARAMETERS = (
    ("pump", {"n": 12}),
    ("pump-collinear", {"r": 28}),
    ("offset-slider-crank", {"n": 9, "r": 55}),
    ("slotted-lever", {"n": 10, "r": 100}),
    ("crank-rocker", {"L": 95}),
    ("gears-planet", {"n": 20}),
    ("roller", {"v": 550, "a": 250}),
)
DRIVERS = ("five-bar", "excavator-relative", "excavator-absolute", "jumper", "gears-planet")
DRIVERS += ("belts-arm", "roller-plates")
LED = 4
"""Degrees, or parts of a hundred of its way, that a driver is led."""


def changed(name: str, settings: dict[str, Any]) -> Mechanism:
    """A mechanism with other parameters."""
    if name in LABS:
        return load(name, **settings)
    return load(str(FOLDER / f"{name}.toml"), **settings)


def led(mechanism: Mechanism, number: int, way: float) -> Mechanism:
    """A mechanism of which one driver stands farther by so much, in degrees or its unit."""
    scene = mechanism.scene
    drivers = list(scene.drivers)
    place = drivers[number].position
    one = 3.141592653589793 / 180 if place.unit == "rad" else 1
    farther = expression(f"({place.text}) + {way * one!r}", place.unit, place.place)
    drivers[number] = replace(drivers[number], position=farther)
    return Mechanism(replace(scene, drivers=tuple(drivers)))


def test_a_cylinder_is_dragged_by_steps_far_shorter_than_its_stroke():
    """All lengths together are 2.9 m: steps of 1 mm, where a stroke is 300 mm."""
    scene = load(SCENES / "motion/two-cylinders.toml").scene
    assert [each.step for each in of_drivers(scene)] == [1, 1]


@pytest.mark.parametrize(("name", "settings"), PARAMETERS)
def test_a_page_draws_other_parameters_as_python_does(page, name, settings):
    figures = {f"figure {parameter}": value for parameter, value in settings.items()}
    assert not list(differences(page, name, figures, changed(name, settings)))


def differences(page: Any, name: str, figures: dict[str, float], other: Mechanism) -> Any:
    """What a page with figures changed draws otherwise than Python draws another mechanism."""
    found = page_of(name)[1]
    start = found.driven.start
    (here,) = ran(page, found, [start], figures)
    return compared(name, start, marks_of(name, here), other)


@pytest.mark.parametrize("name", DRIVERS)
def test_each_of_several_drivers_is_led_alone(page, name):
    _, found = page_of(name)
    own = [each for each in found.driven.figures if each.driver is not None]
    assert len(own) == len(named(name).scene.drivers) > 1
    for number, figure in enumerate(own):
        way = LED if figure.unit == "deg" else (figure.high - figure.low) * LED / 100
        other = led(named(name), number, way)
        assert not list(differences(page, name, {figure.name: way}, other)), figure.name


@pytest.mark.parametrize("name", DRIVERS)
def test_every_driver_that_moves_a_pin_has_a_handle_of_its_own(name):
    _, found = page_of(name)
    drivers = {k for k, each in enumerate(found.driven.figures) if each.driver is not None}
    handles = {number for _, _, _, number in found.data["grips"][0] if number >= 0}
    assert handles <= drivers
    assert handles == drivers or name == "roller-plates"  # plates have no pins


def test_a_parameter_by_which_only_a_driver_stands_is_the_drivers_own_slider():
    assert [each.name for each in figures(named("pump"))] == ["figure n"]
    assert not figures(mechanism_named("stephenson-3"))


@pytest.mark.parametrize("name", [name for name, _ in PARAMETERS])
def test_a_figure_goes_over_the_range_of_its_parameter_by_its_step(name):
    """By a hundredth of the range where none is written; it starts at the value of the scene."""
    mechanism = changed(name, {"n": 7} if name in LABS else {})
    scene = mechanism.scene
    found = [each for each in figures(mechanism) if each.parameter]
    assert found
    for each in found:
        own = scene.parameters[each.parameter]
        low, high = (float(end.number({})) for end in (own.minimum, own.maximum))
        assert (each.low, each.high) == (low, high)
        assert each.start == pytest.approx(float(scene.values[each.parameter]))
        step = (high - low) / 100 if own.step is None else float(own.step.number({}))
        assert each.step == pytest.approx(step)
