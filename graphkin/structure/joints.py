"""The pairs of each link and the links they join, found once for many queries."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property
from typing import Any

from graphkin.scene.model import FRAME, Scene
from graphkin.structure.pairs import Joint, Pin, all_pairs, refuse_loose, sharers
from graphkin.structure.parallel_bars import ParallelSet, parallel_sets


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
