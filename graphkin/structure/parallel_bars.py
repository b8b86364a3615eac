"""Sets of three or more bars that keep two links parallel to one another.

Two links joined by equal bars, at congruent figures of pins, translate along circles relative to
one another. Two of the bars could also cross; the third one does not fit then. Each bar beyond the
first removes a freedom that the common direction has removed already.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import combinations

from msgspec import Struct

from graphkin.scene.model import Link, Scene
from graphkin.structure.link_axes import body
from graphkin.structure.pairs import sharers

ALIKE = 1e-9
"""Relative difference of two lengths, or of two directions, that rounding leaves."""


class Bar(Struct, frozen=True):
    """A link by its length and its pins on two others, with their places on these."""

    link: str
    length: float
    pins: tuple[str, str]
    near: complex
    far: complex


class ParallelSet(Struct, frozen=True):
    """The ``bars`` that keep two ``links`` parallel, and the pins of each bar on the two."""

    links: tuple[str, str]
    bars: tuple[str, ...]
    pins: tuple[tuple[str, str], ...]

    def line_on(self, link: str) -> tuple[str, str]:
        """Two pins on one of the links: their line is parallel to that of the other two."""
        on = self.links.index(link)
        return self.pins[0][on], self.pins[1][on]


def parallel_sets(scene: Scene) -> tuple[ParallelSet, ...]:
    """The sets of three or more bars between two links that stay parallel, in written order."""
    return tuple(
        found
        for links, pins in joining(scene).items()
        if len(pins) > 2
        for found in alike(links, bars_between(scene, links, pins))
    )


def way_between(
    sets: Sequence[ParallelSet], link: str, known: Collection[str]
) -> tuple[str, tuple[ParallelSet, ...]] | None:
    """The nearest known link to which sets keep a link parallel, and the sets from there on."""
    ways: dict[str, tuple[ParallelSet, ...]] = {link: ()}
    waiting = [link]
    for here in waiting:
        if here in known:
            return here, ways[here]
        for each in sets:
            if here in each.links:
                there = each.links[1] if each.links[0] == here else each.links[0]
                if there not in ways:
                    ways[there] = each, *ways[here]
                    waiting.append(there)
    return None


def is_spare(sets: Sequence[ParallelSet], bar: str, known: Collection[str]) -> bool:
    """Whether a bar belongs to a set of which another bar is known."""
    return any(bar in each.bars and {*each.bars} & {*known} - {bar} for each in sets)


Pins = tuple[str, str, str]
"""A link that joins two others, and its pin on each."""


def joining(scene: Scene) -> Mapping[tuple[str, str], list[Pins]]:
    """The links that join each two others by pins of their own, in written order."""
    owners = sharers(scene)
    found: dict[tuple[str, str], list[Pins]] = {}
    for link in (*scene.links.values(), scene.frame):
        for one, other in combinations(pinned_to(link, owners), 2):
            if one[0] != other[0] and one[1] != other[1]:
                (near, p), (far, q) = sorted((one, other))
                found.setdefault((near, far), []).append((link.name, p, q))
    return found


def pinned_to(link: Link, owners: Mapping[str, tuple[str, ...]]) -> Iterator[tuple[str, str]]:
    """The links that share a point with a link, each with that point."""
    for point in link.points:
        for other in owners[point]:
            if other != link.name:
                yield other, point


def bars_between(scene: Scene, links: tuple[str, str], every: Sequence[Pins]) -> list[Bar]:
    """The bars between two links."""
    near, far = (body(scene, link) for link in links)
    return [
        Bar(link, abs(own[q] - own[p]), (p, q), near[p], far[q])
        for link, p, q in every
        for own in (body(scene, link),)
    ]


def alike(links: tuple[str, str], left: list[Bar]) -> Iterator[ParallelSet]:
    """The sets of three or more equal bars between two links, at congruent figures of pins."""
    while len(left) > 2:
        first, *others = left
        left = others
        same = [bar for bar in others if abs(bar.length - first.length) <= ALIKE * first.length]
        for other in same:
            turn = turned(first, other)
            found = [bar for bar in same if turn and is_turned(first, bar, turn)]
            if len(found) > 1:
                every = first, *found
                bars, pins = (bar.link for bar in every), (bar.pins for bar in every)
                yield ParallelSet(links, tuple(bars), tuple(pins))
                left = [bar for bar in others if bar not in found]
                break


def turned(one: Bar, other: Bar) -> complex:
    """The rotation of the vector between two pins from link to link; 0 if lengths differ."""
    near, far = other.near - one.near, other.far - one.far
    if not near or abs(abs(far) - abs(near)) > ALIKE * abs(near):
        return 0j
    return far / near


def is_turned(one: Bar, other: Bar, turn: complex) -> bool:
    """Whether the vector between two pins has a given rotation from one link to the other."""
    near, far = other.near - one.near, other.far - one.far
    return bool(near) and abs(far - turn * near) <= ALIKE * abs(near)
