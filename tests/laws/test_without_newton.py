"""The constructions stand on their own: the loops' Newton method may fail, they do not use it."""

import sys
from pathlib import Path

import pytest

from graphkin.loops.newton import newton
from graphkin.mechanism import load
from graphkin.scene.model import Closure
from graphkin.structure.groups import Higher
from tests.chance.checking import case

SCENES = sorted(Path(__file__).parents[2].glob("examples/scenes/*.toml"))
HIGHER = (8, 9, 10, 11, 12, 16, 52, 53, 78, 690)
"""Seeds of random mechanisms with groups of class III, IV, closed by drivers, or with a wheel."""


class ForbiddenError(Exception):
    """Newton's method on the loop equations was called."""


@pytest.fixture
def no_newton(monkeypatch):
    """Newton's method raises, under whatever name a module knows it."""

    def forbidden(*_, **__):
        raise ForbiddenError

    known = [
        (module, name)
        for title, module in list(sys.modules.items())
        if title.startswith("graphkin")
        for name, value in list(vars(module).items())
        if value is newton
    ]
    assert known
    for module, name in known:
        monkeypatch.setattr(module, name, forbidden)


def assert_stands(mechanism):
    """Everything is constructed, from the groups on, and only then the loops are refused."""
    solution = mechanism.solve()
    own = [point for name, point in solution.points.items() if "@" not in name]
    assert all(point.position is not None and point.velocity is not None for point in own)
    with pytest.raises(ForbiddenError):
        mechanism.witness(solution)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_every_scene_is_constructed_without_newton(path, no_newton):
    assert_stands(load(path))


@pytest.mark.parametrize("seed", HIGHER)
def test_random_groups_of_higher_class_are_constructed_without_newton(seed, no_newton):
    made = case(seed)
    assert any(isinstance(group, Higher) for group in made.mechanism.groups)
    assert_stands(made.mechanism)


def test_groups_of_higher_class_are_among_the_scenes():
    """Else the law above would say little."""
    closed = [
        path.stem
        for path in SCENES
        if any(isinstance(branch, Closure) for branch in load(path).scene.branches.values())
    ]
    assert len(closed) >= 5
