"""What is looked up once is what asking anew would find."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest

from graphkin.scene.model import FRAME
from graphkin.scene.read_scene import read_scene
from graphkin.structure.joints import Joints
from graphkin.structure.pairs import contacts_between, pairs_between

SCENES = sorted((Path(__file__).resolve().parents[2] / "examples" / "scenes").glob("*.toml"))


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_pairs_between_links_are_those_of_the_scene(path):
    """Whatever was asked before, and however large the set of others."""
    scene = read_scene(path)
    joints, names = Joints(scene), (FRAME, *scene.links)
    for count in (1, 2, len(names) - 1):
        for others in combinations(names, count):
            for link in set(names) - set(others):
                every = frozenset(others)
                plain = *pairs_between(scene, link, every), *contacts_between(scene, link, every)
                found = joints.between(link, others)
                assert sorted(map(repr, found)) == sorted(map(repr, plain))
                assert found == joints.between(link, set(others))
