"""Every scene that is shipped: solved, proved by the second route, rigid; and the chosen few."""

from __future__ import annotations

import pytest

from graphkin.construction.core.solution import FAIR
from graphkin.scene.model import FRAME
from graphkin.text import LANGUAGES
from tests.chosen import CHOSEN
from tests.examples.scenes import FILES, is_rigid, mechanism, motion

ROWS = {
    "pump": 2,
    "roller": 2,
    "jumper": 1,
    "crank-slot": 1,
    "crank-fixed-slot": 1,
    "eight-link": 2,
    "centrodes": 4,
    "oscillating-slide": 1,
    "four-bar": 6,
    "slider-crank": 2,
    "lifter": 1,
    "toggle-press": 1,
    "rapid-return": 2,
    "five-bar": 1,
    "rod-and-wheel": 1,
    "two-loops": 1,
    "instant-centres": 1,
    "gears": 5,
    "excavator": 2,
    "oldham": 1,
    "trammel": 1,
    "watt": 4,
    "stephenson": 5,
    "mobility": 5,
}
"""The mechanisms of the courses, each with the number of its scenes."""


def ends(name: str) -> list[dict[str, object]]:
    """Settings that put one parameter of a scene to the least or the most of its range."""
    parameters = mechanism(name).scene.parameters.values()
    ranges = [(each.name, bound) for each in parameters for bound in (each.minimum, each.maximum)]
    return [{name: bound.number({})} for name, bound in ranges if bound is not None]


def test_every_mechanism_of_the_courses_has_its_scenes() -> None:
    for row, count in ROWS.items():
        assert sum(name == row or name.startswith(f"{row}-") for name in FILES) == count, row


@pytest.mark.parametrize("name", FILES)
def test_a_scene_is_solved_and_the_witness_agrees(name: str) -> None:
    assert motion(name).margin > 0.05  # no crossing that a ruler would miss


@pytest.mark.parametrize("name", FILES)
def test_a_scene_closes_at_the_ends_of_its_parameters(name: str) -> None:
    for setting in ends(name):
        assert motion(name, **setting).margin > FAIR, setting


@pytest.mark.parametrize("name", FILES)
def test_links_are_rigid(name: str) -> None:
    found = motion(name)
    for link in mechanism(name).scene.links.values():
        is_rigid(found, link.points)
    for point in mechanism(name).scene.link(FRAME).points:
        assert found.points[point].velocity == found.points[point].acceleration == 0


def test_a_title_is_given_in_every_language_or_in_one_for_all() -> None:
    for name in FILES:
        scene = mechanism(name).scene
        assert scene.titles.keys() in (set(), set(LANGUAGES)), name
        assert scene.titles.get("en", scene.title) == scene.title, name


def traits(name: str) -> set[object]:
    """The actions of a scene's program, what its drivers move and against what, what it asks."""
    program, scene = mechanism(name).program, mechanism(name).scene
    actions = {step.action.key for step in program.steps if step.action}
    drivers = {(driver.kind, driver.against == FRAME) for driver in scene.drivers}
    return actions | drivers | {key for key, asked in scene.ask._asdict().items() if asked}


def test_the_pump_and_the_chosen_scenes_have_all_that_any_scene_has() -> None:
    every, chosen = (set().union(*map(traits, names)) for names in (FILES, ("pump", *CHOSEN)))
    assert every == chosen
