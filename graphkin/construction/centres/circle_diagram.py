"""The circle diagram: which centres follow from which, by lines that cross as squarely as can be.

Links are the corners of a polygon and known centres its drawn sides. A missing side that closes
two triangles of known ones is the centre where the two lines of those triangles meet.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from itertools import combinations
from math import hypot, sqrt

Pair = tuple[str, str]
"""Two links, in the order of the scene."""
Route = tuple[str, str] | None
"""The two links over which a centre is found; None for one found by two normals."""
Spot = tuple[float, float, float]
"""A centre in homogeneous coordinates of length 1; the third is nought at infinity."""

GOOD, LEAST = 0.2, 1e-6
"""Sine of a crossing that is as good as any, and below which nothing crosses."""
MOST = 12
"""So many triangles on one side are tried at most."""


def routes(
    links: Sequence[str],
    known: Collection[Pair],
    centres: Mapping[Pair, Spot],
    normals: Collection[str],
) -> dict[Pair, Route]:
    """How each centre that is not known at once is found, each from those before it.

    ``links`` begin with the frame; ``normals`` are the links whose centre against the frame two
    normals can give, each used only where no two lines meet. What is not in the answer has no way.
    """
    found = dict.fromkeys(known)
    ways: dict[Pair, Route] = {}
    joined = {link: {a if b == link else b for a, b in found if link in (a, b)} for link in links}
    missing = [pair for pair in combinations(links, 2) if pair not in found]
    while missing:
        step = best(links, missing, joined, centres)
        if not step:
            stuck = [(links[0], link) for link in links[1:] if (links[0], link) in missing]
            step = {pair: None for pair in stuck if pair[1] in normals}
            step = dict(list(step.items())[:1])
        if not step:
            break
        for (a, b), way in step.items():
            ways[a, b] = way
            joined[a].add(b)
            joined[b].add(a)
        missing = [pair for pair in missing if pair not in step]
    return ways


def best(
    links: Sequence[str],
    missing: Sequence[Pair],
    joined: Mapping[str, set[str]],
    centres: Mapping[Pair, Spot],
) -> dict[Pair, Route]:
    """The missing centres found by good crossings, or else the one found by the best crossing."""
    tried = {
        pair: crossing
        for pair in missing
        if (crossing := squarest(links, pair, joined, centres)) is not None
    }
    if not tried:
        return {}
    good = {pair: way for pair, (sine, way) in tried.items() if sine >= GOOD}
    first = max(tried, key=lambda pair: tried[pair][0])
    return dict(good) or {first: tried[first][1]}


def squarest(
    links: Sequence[str],
    pair: Pair,
    joined: Mapping[str, set[str]],
    centres: Mapping[Pair, Spot],
) -> tuple[float, Pair] | None:
    """The two lines that cross most squarely in a centre; None where no two do."""
    over = [link for link in links if link in joined[pair[0]] and link in joined[pair[1]]][:MOST]
    lines = {link: line_over(links, pair, link, centres) for link in over}
    tried = [
        (min(first[1], second[1], sine(first[0], second[0])), (k, m))
        for k, m in combinations(over, 2)
        if (first := lines[k]) is not None and (second := lines[m]) is not None
    ]
    crossing = max(tried, key=lambda each: each[0], default=None)
    return crossing if crossing is not None and crossing[0] >= LEAST else None


def line_over(
    links: Sequence[str], pair: Pair, link: str, centres: Mapping[Pair, Spot]
) -> tuple[Spot, float] | None:
    """The line through the centres of a third link with each of two, and how far they are apart."""
    first, second = (centres.get(ordered(links, end, link)) for end in pair)
    if first is None or second is None:
        return None
    apart = sine(first, second)
    return (unit(*cross(first, second)), apart) if apart >= LEAST else None


def ordered(links: Sequence[str], a: str, b: str) -> Pair:
    """Two links in the order of the scene."""
    return (a, b) if links.index(a) < links.index(b) else (b, a)


def cross(a: Spot, b: Spot) -> Spot:
    """The line through two points, or the point on two lines, in homogeneous coordinates."""
    (x, y, z), (u, v, w) = a, b
    return y * w - z * v, z * u - x * w, x * v - y * u


def sine(a: Spot, b: Spot) -> float:
    """How far two points, or two lines, of length 1 are from being the same."""
    x, y, z = cross(a, b)
    return sqrt(x * x + y * y + z * z)


def unit(x: float, y: float, z: float) -> Spot:
    """Homogeneous coordinates of length 1."""
    size = hypot(x, y, z) or 1.0
    return x / size, y / size, z / size
