"""Every scene that is shipped: solved, proved by the second route, also at the ends of ranges."""

from __future__ import annotations

import pytest
from msgspec.structs import asdict

from graphkin.construction.core.solution import FAIR
from graphkin.scene.model import FRAME
from tests.chosen import CHOSEN, shared
from tests.examples.scenes import FILES, mechanism, motion


def ends(name: str) -> list[dict[str, object]]:
    """Settings that put one parameter of a scene to the least or the most of its range."""
    parameters = mechanism(name).scene.parameters.values()
    ranges = [(each.name, bound) for each in parameters for bound in (each.minimum, each.maximum)]
    return [{name: bound.number({})} for name, bound in ranges if bound is not None]


@pytest.mark.parametrize("name", FILES)
def test_a_scene_is_solved_and_the_witness_agrees(name: str) -> None:
    assert motion(name).margin > 0.05  # no crossing that a ruler would miss


@pytest.mark.parametrize("name", shared(FILES, 3))
def test_a_scene_closes_at_the_ends_of_its_parameters(name: str) -> None:
    for setting in ends(name):
        assert motion(name, **setting).margin > FAIR, setting


def traits(name: str) -> set[object]:
    """The actions of a scene's program, what its drivers move and against what, what it asks."""
    program, scene = mechanism(name).program, mechanism(name).scene
    actions = {step.action.key for step in program.steps if step.action}
    drivers = {(driver.kind, driver.against == FRAME) for driver in scene.drivers}
    return actions | drivers | {key for key, asked in asdict(scene.ask).items() if asked}


def test_the_pump_and_the_chosen_scenes_have_all_that_any_scene_has() -> None:
    every, chosen = (set().union(*map(traits, names)) for names in (FILES, ("pump", *CHOSEN)))
    assert every == chosen
