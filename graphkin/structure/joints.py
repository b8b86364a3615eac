"""The pairs of each link and the links they join, found once for many queries.

Sets of three or more bars that keep two links parallel to one another.

Two links joined by equal bars, at congruent figures of pins, translate along circles relative to
one another. Two of the bars could also cross; the third one does not fit then. Each bar beyond the
first removes a freedom that the common direction has removed already.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any

from msgspec import Struct

from graphkin.scene.model import FRAME, Link, Scene
from graphkin.structure.pairs import Joint, Pin, all_pairs, refuse_loose, sharers
from graphkin.structure.turning import body

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


class Joints:
    """The pairs of a scene, by link."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.owners = sharers(scene)
        self.order = {name: i for i, name in enumerate((FRAME, *scene.links))}
        self.names: tuple[str, ...] = tuple(scene.links)
        self.others: dict[str, list[Joint]] = {name: [] for name in self.order}
        every = all_pairs(scene)
        refuse_loose(every)
        for pair in every:
            if not isinstance(pair, Pin):
                for link in pair.links:
                    self.others[link].append(pair)
        self.beside = {name: self._beside(name) for name in self.order}
        self.found: dict[tuple[str, frozenset[str]], tuple[Joint, ...]] = {}

    def _beside(self, link: str) -> frozenset[str]:
        found = {o for point in self.scene.link(link).points for o in self.owners[point]}
        return frozenset((found | {partner(pair, link) for pair in self.others[link]}) - {link})

    def between(self, link: str, others: Collection[str]) -> tuple[Joint, ...]:
        """The pairs that join a link to a set of others; a shared pin counts once."""
        near = self.beside[link].intersection(others)
        if (link, near) not in self.found:
            self.found[link, near] = tuple(self._joining(link, near))
        return self.found[link, near]

    def _joining(self, link: str, near: Collection[str]) -> Iterator[Joint]:
        for point in self.scene.link(link).points if near else ():
            other = next((o for o in self.owners[point] if o in near), None)
            if other is not None:
                yield Pin(point, (link, other))
        for pair in self.others[link]:
            if partner(pair, link) in near:
                yield pair

    def inner(self, first: str, second: str, known: Collection[str]) -> tuple[Joint, ...]:
        """The pairs between two links, except pins that are already located on known links."""
        return tuple(
            pair
            for pair in self.between(first, (second,))
            if not isinstance(pair, Pin) or not any(o in known for o in self.owners[pair.point])
        )

    def neighbours(self, link: str) -> list[str]:
        """The links joined to a link by any pair, in written order."""
        return sorted(self.beside[link], key=self.order.__getitem__)

    def unknown(self, known: Collection[str]) -> Iterator[str]:
        """The links that are not known, in written order."""
        return (name for name in self.names if name not in known)

    def part(self, links: Collection[str]) -> Joints:
        """The pairs, with only some links treated as unknown."""
        return self._but(names=tuple(name for name in self.names if name in links))

    @cached_property
    def parallel(self) -> tuple[ParallelSet, ...]:
        """The sets of bars that keep two links parallel."""
        return parallel_sets(self.scene)

    def with_pins(self, pins: Sequence[tuple[Joint, Pin]]) -> Joints:
        """The pairs, with pins in place of some of them."""
        others = {
            link: [next((pin for held, pin in pins if held == pair), pair) for pair in pairs]
            for link, pairs in self.others.items()
        }
        owners = self.owners | {pin.point: pin.links for _, pin in pins}
        return self._but(found={}, others=others, owners=owners)

    def without(self, pairs: Collection[Joint]) -> Joints:
        """The pairs without some of them."""
        others = {
            link: [pair for pair in own if pair not in pairs] for link, own in self.others.items()
        }
        return self._but(found={}, others=others)

    def _but(self, **parts: Any) -> Joints:
        """A copy with some attributes replaced."""
        other = object.__new__(Joints)
        vars(other).update(vars(self) | parts)
        return other

    def apart(self, known: Collection[str], tied: Iterable[set[str]]) -> Iterator[set[str]]:
        """The unknown links in parts not joined by pairs or the sets ``tied``, in written order."""
        left = set(self.unknown(known))
        for first in self.names:
            if first not in left:
                continue
            part, new = {first}, {first}
            while new:
                beside = {other for link in new for other in self.neighbours(link)}
                beside |= {link for each in tied if each & new for link in each}
                new = (beside & left) - part
                part |= new
            left -= part
            yield part


def partner(pair: Joint, link: str) -> str:
    """The other link of a pair."""
    return pair.links[1] if pair.links[0] == link else pair.links[0]
