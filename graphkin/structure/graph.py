"""The kinematic pairs of a scene: what joins which links."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from graphkin.scene.model import FRAME, Scene, Slide


@dataclass(frozen=True, slots=True)
class Pin:
    """A turning pair: two links share a point."""

    point: str
    links: tuple[str, str]


@dataclass(frozen=True, slots=True)
class Sliding:
    """A sliding pair: a block on a guide of another link."""

    slide: Slide
    links: tuple[str, str]

    @property
    def block(self) -> str:
        """The link that slides."""
        return self.links[0]


Pair = Pin | Sliding


def pairs(scene: Scene) -> tuple[Pair, ...]:
    """All lower pairs; a pin shared by k links counts as k - 1 pairs (the multiple hinge)."""
    found: list[Pair] = []
    for point, links in sharers(scene).items():
        found += [Pin(point, joined) for joined in pairwise(links)]
    for link in scene.links.values():
        found += [Sliding(slide, (link.name, slide.on)) for slide in link.slides]
    return tuple(found)


def sharers(scene: Scene) -> dict[str, tuple[str, ...]]:
    """The links that own each point, the frame first, then as written."""
    owners: dict[str, list[str]] = {}
    for link in (scene.frame, *scene.links.values()):
        for point in link.points:
            owners.setdefault(point, []).append(link.name)
    return {point: tuple(links) for point, links in owners.items()}


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
