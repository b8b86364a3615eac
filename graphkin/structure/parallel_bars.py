"""Idle bars in a parallel set: of three bars that stay parallel, two keep all the others so.

Two links joined by equal bars, at congruent figures of pins, translate along circles relative to
one another. Each bar beyond the second removes a freedom that the others have removed already.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from msgspec import Struct

from graphkin.scene.model import Link, Scene
from graphkin.structure.link_axes import body
from graphkin.structure.pairs import sharers

ALIKE = 1e-9
"""Relative difference of two lengths, or of two directions, that rounding leaves."""


class Bar(Struct, frozen=True):
    """A link by its pins on two others, with the vector between them on each of the three."""

    link: str
    length: float
    near: complex
    far: complex


def idle_bars(scene: Scene) -> tuple[str, ...]:
    """The bars that parallel ones make idle: in each set all but two, the later written first.

    Only a plain bar is left out: one that no driver moves, and that holds nothing else.
    """
    owners = sharers(scene)
    plain = [name for name in scene.links if is_plain(scene, owners, name)]
    found: list[str] = []
    for bars in parallel_sets(joining(scene, owners)):
        kept = [bar for bar in bars if bar.link not in found]
        spare = [bar.link for bar in reversed(kept) if bar.link in plain]
        found += spare[: max(0, len(kept) - 2)]
    return tuple(found)


def is_plain(scene: Scene, owners: dict[str, tuple[str, ...]], name: str) -> bool:
    """Whether a link has two pins and nothing else that holds, moves or guides another."""
    link = scene.links[name]
    driven = {end for driver in scene.drivers for end in (driver.link, driver.against)}
    carriers = {path.on for other in scene.links.values() for path in other.paths}
    pins = [point for point in link.points if len(owners[point]) > 1]
    return len(pins) == 2 and not (link.paths or link.wheels) and name not in driven | carriers


def joining(scene: Scene, owners: dict[str, tuple[str, ...]]) -> dict[tuple[str, str], list[Bar]]:
    """The links that join each two others by pins of their own, in written order."""
    found: dict[tuple[str, str], list[Bar]] = {}
    bodies = {link.name: body(scene, link.name) for link in scene.every_link}
    for link in (*scene.links.values(), scene.frame):
        own = bodies[link.name]
        for (first, p), (second, q) in combinations(pinned_to(link, owners), 2):
            if p == q or first == second:
                continue
            near, far = sorted(((first, p), (second, q)))
            ends = bodies[near[0]][near[1]], bodies[far[0]][far[1]]
            bar = Bar(link.name, abs(own[q] - own[p]), *ends)
            found.setdefault((near[0], far[0]), []).append(bar)
    return found


def pinned_to(link: Link, owners: dict[str, tuple[str, ...]]) -> Iterator[tuple[str, str]]:
    """The links that share a point with a link, each with that point."""
    for point in link.points:
        for other in owners[point]:
            if other != link.name:
                yield other, point


def parallel_sets(joined: dict[tuple[str, str], list[Bar]]) -> Iterator[list[Bar]]:
    """The sets of three or more bars between two links that stay parallel."""
    for bars in joined.values():
        left = bars
        while len(left) > 2:
            first, *others = left
            same = [bar for bar in others if abs(bar.length - first.length) <= ALIKE * first.length]
            for other in same:
                turn = turned(first, other)
                alike = [b for b in same if turn and is_turned(first, b, turn)]
                if len(alike) > 1:
                    yield [first, *alike]
                    break
            left = others


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
