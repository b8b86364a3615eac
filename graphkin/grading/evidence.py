"""Evidence for the lecturer: answers that fit another student's data, and sets handed in twice.

Nothing here changes a mark. Odds say how much better the suspicion explains the answers than
chance does, chance being told by the class itself: how often such answers fit such other data.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

from graphkin.grading.model import Graded, Status, Suspicion
from graphkin.grading.standard import Expectation

FITS = 0.9
"""How often an answer fits the data from which it was drawn."""
LEAST_CHANCE = 0.01
FEW = 3
"""Fewer fields tell nothing."""
STRONG = 20.0
"""Odds from which a wrong variant is reported, after they are divided by the number of others."""
EXPLAINED = 1000.0
"""Odds of a slip from which an answer is its own, and no evidence."""
HALF = 0.5
"""Whoever has more than this share of the fields right worked with the own data."""
RARE = 0.01
"""How often two wrong numbers agree by chance where nothing is known yet."""
KNOWN = 10.0
"""How many answers that is worth."""
CROWD = 12
"""So many with one value make it a common mistake and no copy."""


def wrong_variants(
    graded: Sequence[Graded], standards: Sequence[Expectation]
) -> tuple[Suspicion, ...]:
    """Students whose answers fit another's data: (student, owner), the fields, the odds.

    ``standards`` holds what each was marked against, in the same order.
    """
    import numpy as np

    fields = numeric_fields(standards)
    if len(fields) < FEW:
        return ()
    own, owners = distinct(standards)
    keys = np.array([[each.key[f] for f in fields] for each in own])
    allowed = np.array([[each.tolerance[f].value for f in fields] for each in own])
    places = np.array([own[0].item[f].what == "place" for f in fields])
    sizes = np.where(places, keys, abs(keys))
    theirs = owners_of(standards, owners)
    found = []
    for who, each in enumerate(graded):
        answers = np.array([value_of(each, f) for f in fields])
        read = ~np.isnan(answers) & ~np.array([explained(each, f) for f in fields])
        mine = owners[id(standards[who])]
        own_fits = fitting(answers, sizes[mine], allowed[mine], places)
        if read.sum() < FEW or own_fits.sum() > HALF * read.sum():
            continue
        fits = fitting(answers, sizes, allowed, places)
        telling = read & (abs(sizes - sizes[mine]) > allowed + allowed[mine])
        best = best_other(fits, telling, mine)
        if best is not None:
            other, odds = best
            fitted = tuple(f for f, fit in zip(fields, fits[other] & read, strict=True) if fit)
            ids = (each, *(graded[owner] for owner in theirs[other]))
            names = tuple(one.taker.student.id for one in ids)
            found.append(Suspicion(names, fitted, odds, int(read.sum())))
    return tuple(found)


def numeric_fields(standards: Sequence[Expectation]) -> list[str]:
    """The fields that are numbers, those left out that only follow from a segment beside them."""
    if not standards:
        return []
    fields = standards[0].tolerance
    return [field for field in fields if f"{field}_mm" not in fields]


def distinct(standards: Sequence[Expectation]) -> tuple[list[Expectation], dict[int, int]]:
    """The standards without doubles, and the place of each among them."""
    places: dict[int, int] = {}
    own: list[Expectation] = []
    for each in standards:
        if id(each) not in places:
            places[id(each)] = len(own)
            own.append(each)
    return own, places


def owners_of(standards: Sequence[Expectation], places: Mapping[int, int]) -> dict[int, list[int]]:
    """The students of each variant."""
    found: dict[int, list[int]] = defaultdict(list)
    for who, each in enumerate(standards):
        found[places[id(each)]].append(who)
    return found


def value_of(graded: Graded, field: str) -> float:
    """An answer; not a number where there is none."""
    value = graded.mark(field).answer.value
    return float("nan") if value is None else value


def explained(graded: Graded, field: str) -> bool:
    """Whether a slip explains an answer so well that it tells nothing of other data."""
    return graded.mark(field).odds >= EXPLAINED


def fitting(answers: Any, sizes: Any, allowed: Any, places: Any) -> Any:
    """Which answers fit which variant's key: a row for each variant."""
    import numpy as np

    return abs(np.where(places, answers, abs(answers)) - sizes) <= allowed


def best_other(fits: Any, telling: Any, mine: int) -> tuple[int, float] | None:
    """The other variant that the answers fit best, and the odds, if these are strong.

    Only fields count that ``telling`` says differ from the own variant's by more than drawings do.
    """
    import numpy as np

    others = max(len(fits) - 1, 1)
    chance = np.clip((fits.sum(axis=0) - fits[mine]) / others, LEAST_CHANCE, 0.99)
    ratios = np.where(fits, FITS / chance, (1 - FITS) / (1 - chance))
    odds = np.where(telling, ratios, 1.0).prod(axis=1)
    odds[mine] = 0.0
    best = int(odds.argmax())
    strength = float(odds[best] / others)
    if strength < STRONG or (fits & telling)[best].sum() < FEW:
        return None
    return best, strength


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
