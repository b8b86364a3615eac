"""Bodies that three or more equal bars keep parallel, and the bars that are spare because of that.

Equal bars stay parallel where their pins form congruent figures on both bodies. Two such bars could
cross, but a third one does not fit then. Each bar beyond two removes no freedom, and a count with
it seems to determine bodies that still move.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from itertools import combinations
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.loops.rigid_bodies import Body
from graphkin.numbers.arithmetic import Point

SAME = 1e-9
"""Relative difference of two lengths that rounding leaves."""


class Parallel(Struct, frozen=True):
    """Two ``bodies`` kept parallel by ``bars``; ``along`` is the second's x axis from the first."""

    bodies: tuple[str, str]
    bars: tuple[str, ...]
    along: Point


class JoiningBar(Struct, frozen=True):
    """A link that joins two bodies: the vector between its pins, and these pins on each body."""

    link: str
    way: Any
    near: Any
    far: Any


def parallels(bodies: Mapping[str, Body]) -> Iterator[Parallel]:
    """The bodies that are kept parallel, in each setting of a batch."""
    joined: dict[tuple[str, str], list[JoiningBar]] = {}
    owners: dict[str, list[str]] = {}
    for name, body in bodies.items():
        for point in body:
            owners.setdefault(point, []).append(name)
    for link, body in bodies.items():
        pins = [(other, p) for p in body for other in owners[p] if other != link]
        for one, other in combinations(pins, 2):
            if one[0] != other[0] and one[1] != other[1]:
                (near, p), (far, q) = sorted((one, other))
                bar = JoiningBar(link, body[q] - body[p], bodies[near][p], bodies[far][q])
                joined.setdefault((near, far), []).append(bar)
    for pair, bars in joined.items():
        yield from parallel_sets(pair, bars)


def parallel_sets(pair: tuple[str, str], bars: list[JoiningBar]) -> Iterator[Parallel]:
    """The sets of parallel bars among the bars between two bodies."""
    while len(bars) > 2:
        one, *bars = bars
        for other in bars:
            alike = [bar for bar in bars if are_parallel(one, other, bar)]
            if len(alike) > 1:
                turn = (other.near - one.near) / (other.far - one.far)
                names = (one.link, *(bar.link for bar in alike))
                yield Parallel(pair, names, turn / abs(turn))
                bars = [bar for bar in bars if bar not in alike]
                break


def are_parallel(one: JoiningBar, other: JoiningBar, third: JoiningBar) -> bool:
    """Whether three bars are equal and their pins form congruent figures on both bodies.

    The third bar may be the second one itself.
    """
    near, far = other.near - one.near, other.far - one.far
    if not np.all(abs(near) * abs(far)):
        return False
    turn = far / near
    pairs = [(abs(bar.way), abs(one.way)) for bar in (other, third)]
    pairs += [(third.far - one.far, turn * (third.near - one.near)), (abs(far), abs(near))]
    apart = np.all(abs(third.near - one.near))
    return bool(apart) and all(np.all(abs(a - b) <= SAME * abs(b)) for a, b in pairs)


def spare_bars(bodies: Mapping[str, Body], busy: Collection[str]) -> frozenset[str]:
    """The plain bars beyond two in each set that stays parallel.

    A plain bar has two pins, each on one other body, and is not ``busy`` with anything else.
    """
    owners = [point for body in bodies.values() for point in body]
    plain = {
        link
        for link, body in bodies.items()
        if link not in busy and sorted(owners.count(point) for point in body)[-3:] == [2, 2]
    }
    sets = (each.bars for each in parallels(bodies))
    return frozenset(bar for bars in sets for bar in sparing(bars, plain))


def sparing(bars: tuple[str, ...], plain: Collection[str]) -> list[str]:
    """The bars that can be left out of a set, later ones first, so that two remain."""
    able = [bar for bar in reversed(bars) if bar in plain]
    return able[: max(0, len(bars) - 2)]
