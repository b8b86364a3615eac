"""Class and order of an Assur group, told from how its links are joined.

Artobolevsky, "Theory of Mechanisms and Machines": the class is the number of sides of the largest
closed contour of the group, the order the number of pairs by which it hangs on what is known.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

Joined = tuple[str, str]


def assur_class(inner: Sequence[Joined], outer: Sequence[str]) -> tuple[int, int]:
    """Class and order of a group: its inner pairs as the two links each, its outer pairs as one.

    A link is a contour with as many sides as it has pairs, a loop of links one with as many sides
    as links. Bars and blocks alone make class II. A pin of k of the group's links is k - 1 inner
    pairs.
    """
    sides = Counter(outer)
    for pair in inner:
        sides.update(pair)
    return max(2, *sides.values(), *loop_sizes(inner)), len(outer)


def loop_sizes(joined: Sequence[Joined]) -> list[int]:
    """Numbers of links in the closed loops, as many as are independent, each as short as can be.

    Horton's minimum cycle basis: short loops through every node and edge, kept while independent.
    """
    kept: dict[int, int] = {}
    sizes = []
    for loop in sorted(set(short_loops(joined)), key=lambda loop: (loop.bit_count(), loop)):
        rest = reduced(loop, kept)
        if rest:
            kept[rest.bit_length()] = rest
            sizes.append(loop.bit_count())
    return sizes


def reduced(loop: int, kept: Mapping[int, int]) -> int:
    """What is left of a loop, a set of edges as bits, when those known are taken out of it."""
    while loop and loop.bit_length() in kept:
        loop ^= kept[loop.bit_length()]
    return loop


def short_loops(joined: Sequence[Joined]) -> Iterator[int]:
    """For each node and edge the loop of the shortest ways from the one to both ends of it."""
    for node in dict.fromkeys(link for pair in joined for link in pair):
        ways = shortest_ways(joined, node)
        for number, (one, other) in enumerate(joined):
            if one in ways and other in ways:
                yield ways[one] ^ ways[other] ^ (1 << number)


def shortest_ways(joined: Sequence[Joined], start: str) -> dict[str, int]:
    """The edges, as bits, of a shortest way from one link to each that it is joined to."""
    ways, waiting = {start: 0}, [start]
    for here in waiting:
        for number, pair in enumerate(joined):
            if here in pair:
                there = pair[1] if pair[0] == here else pair[0]
                if there not in ways:
                    ways[there] = ways[here] | (1 << number)
                    waiting.append(there)
    return ways
