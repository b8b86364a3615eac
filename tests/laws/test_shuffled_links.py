"""The order in which a scene writes its links and drivers changes no motion."""

import random

import pytest
from msgspec.structs import replace

from graphkin.mechanism import Mechanism
from graphkin.scene.model import Closure
from tests.chosen import shared
from tests.examples.scenes import FILES, mechanism

KINDS = ("position", "velocity", "acceleration")
ALIKE, ZERO = 1e-9, 1e-12
"""Largest difference over the largest magnitude of its kind, and that of what is zero."""


def shuffled(scene, seed):
    """A scene with its links and drivers in another order; numbers of closures count by the links
    as written, so that these stay where such a number is stated."""
    chance = random.Random(seed)
    links, drivers = [*scene.links.items()], [*scene.drivers]
    if not any(isinstance(branch, Closure) for branch in scene.branches.values()):
        chance.shuffle(links)
    chance.shuffle(drivers)
    return replace(scene, links=dict(links), drivers=tuple(drivers))


def values(solution, kind):
    """What a solution has of a kind, by point, link and block."""
    turning = {"position": "omega", "velocity": "omega", "acceleration": "epsilon"}[kind]
    sliding = {"position": "position", "velocity": "speed", "acceleration": "acceleration"}[kind]
    every = (solution.points, kind), (solution.links, turning), (solution.slides, sliding)
    return [{key: getattr(each, what) for key, each in some.items()} for some, what in every]


@pytest.mark.parametrize("name", shared(FILES, 2))
def test_links_and_drivers_in_another_order_move_alike(name):
    scene = mechanism(name).scene
    expected, found = (Mechanism(each).solve() for each in (scene, shuffled(scene, len(name))))
    for kind in KINDS:
        for one, other in zip(values(expected, kind), values(found, kind), strict=True):
            shared = [key for key in one if None not in (one[key], other.get(key))]
            largest = max((abs(one[key]) for key in shared), default=0.0)
            off = {key: abs(one[key] - other[key]) for key in shared}
            assert max(off.values(), default=0.0) <= ALIKE * largest + ZERO, kind
