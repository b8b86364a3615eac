"""What is looked up once is what asking anew would find."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest

from graphkin.scene.model import FRAME, Scene
from graphkin.scene.read_scene import read_scene
from graphkin.structure.pairs import Contact, Joints, Pair, Pin, Sliding, contacts, sharers

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


def pairs_between(scene: Scene, link: str, others: frozenset[str]) -> tuple[Pair, ...]:
    """The pairs that join a link to a set of other links; a shared pin counts once."""
    owners = sharers(scene)
    pins = [
        Pin(point, (link, next(other for other in owners[point] if other in others)))
        for point in scene.link(link).points
        if any(other in others for other in owners[point] if other != link)
    ]
    guides = [Sliding(s, (link, s.on)) for s in scene.link(link).slides if s.on in others]
    carried = [
        Sliding(slide, (other, link))
        for other in others
        if other != FRAME
        for slide in scene.links[other].slides
        if slide.on == link
    ]
    return (*pins, *guides, *carried)


def contacts_between(scene: Scene, link: str, others: frozenset[str]) -> tuple[Contact, ...]:
    """The rolling pairs that join a link, by its wheel or by its track, to a set of others."""
    return tuple(
        contact
        for contact in contacts(scene)
        if link in contact.links and not others.isdisjoint(set(contact.links) - {link})
    )
