"""Evidence for the lecturer: sets that were handed in twice.

Nothing here changes a mark. Odds say how much better the suspicion explains the answers than
chance does, chance being told by the class itself: how often two of it agree.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

from graphkin.grading.model import Graded, Status, Suspicion

FEW = 3
"""Fewer fields tell nothing."""
STRONG = 20.0
"""Odds from which a copy is reported, after they are divided by the number of pairs."""
RARE = 0.01
"""How often two wrong numbers agree by chance where nothing is known yet."""
KNOWN = 10.0
"""How many answers that is worth."""
CROWD = 12
"""So many with one value make it a common mistake and no copy."""


def copies(graded: Sequence[Graded]) -> tuple[Suspicion, ...]:
    """Students with the same values in fields where at least one of them is wrong.

    Fields that only follow from a segment beside them count once, and common mistakes little.
    """
    if not graded:
        return ()
    shared: dict[tuple[int, int], dict[str, float]] = defaultdict(dict)
    for field in copied_fields(graded[0]):
        for pair, chance in agreeing(graded, field):
            shared[pair][field] = chance
    pairs = len(graded) * (len(graded) - 1) / 2
    found: dict[tuple[int, int], tuple[float, tuple[str, ...]]] = {}
    for pair, chances in shared.items():
        odds = 1 / pairs
        for chance in chances.values():
            odds /= chance
        if len(chances) >= FEW and odds >= STRONG:
            found[pair] = odds, tuple(chances)
    return tuple(
        Suspicion(
            tuple(graded[who].taker.student.id for who in group),
            *strongest(found, group),
        )
        for group in groups(found)
    )


def copied_fields(graded: Graded) -> list[str]:
    """The fields that tell of copies: numbers that do not follow from a segment beside them."""
    names = [mark.item.field for mark in graded.marks]
    return [
        mark.item.field
        for mark in graded.marks
        if mark.item.what != "sense" and f"{mark.item.field}_mm" not in names
    ]


def agreeing(graded: Sequence[Graded], field: str) -> list[tuple[tuple[int, int], float]]:
    """The pairs with the same value in a field, one of them wrong, and how likely that is."""
    same: dict[float, list[int]] = defaultdict(list)
    wrong = set()
    for who, each in enumerate(graded):
        mark = each.mark(field)
        if mark.answer.value is not None and mark.answer.value != 0:
            same[mark.answer.value].append(who)
            if mark.status is not Status.RIGHT:
                wrong.add(who)
    answered = sum(map(len, same.values()))
    found = []
    for group in same.values():
        if 1 < len(group) <= CROWD:
            chance = (len(group) - 2 + KNOWN * RARE) / (answered - 2 + KNOWN)
            found += [
                ((a, b), chance) for a, b in combinations(group, 2) if a in wrong or b in wrong
            ]
    return found


def groups(pairs: Mapping[tuple[int, int], Any]) -> list[tuple[int, ...]]:
    """The students whom pairs join, group by group."""
    leader: dict[int, int] = {}

    def lead(who: int) -> int:
        while leader.setdefault(who, who) != who:
            who = leader[who]
        return who

    for a, b in pairs:
        first, second = sorted((lead(a), lead(b)))
        leader[second] = first
    found: dict[int, list[int]] = defaultdict(list)
    for who in sorted(leader):
        found[lead(who)].append(who)
    return [tuple(group) for group in found.values()]


def strongest(
    pairs: Mapping[tuple[int, int], tuple[float, tuple[str, ...]]], group: tuple[int, ...]
) -> tuple[tuple[str, ...], float]:
    """The fields and the odds of the strongest pair of a group."""
    inside = [found for (a, b), found in pairs.items() if a in group and b in group]
    odds, fields = max(inside)
    return fields, odds
