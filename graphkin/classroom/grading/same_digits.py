"""Evidence for the lecturer: two students who handed in the same digits.

How likely is it that either of them wrote just these digits alone? From the own drawing, with
any pencil, a crank laid off badly, lengths read to whole or half millimetres, mistakes; or by
computing all, or drawing with a computer, next to which any pencil is coarse; in fields where both
are wrong from a misunderstanding that both have, which is held certain. Which of the
fields agree is counted as a choice, and so is the pair among all pairs with the same data, or with
other data.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from math import comb, inf, log, pi
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.graded import Graded, Status, Suspicion
from graphkin.classroom.grading.keys import Keys, distinct, read_of
from graphkin.classroom.grading.likelihood import PENCILS, Key, fit, told_odds
from graphkin.classroom.grading.standard import Expectation

FEW = 3
"""Fewer fields tell nothing."""
STRONG = 100.0
"""Odds from which a copy is reported, all that was looked through counted."""
RARE = 0.01
"""How often two numbers agree by chance where nothing is known yet."""
KNOWN = 10.0
"""How many answers that is worth."""
ASTRAY = 0.02
"""The share of students who draw another's data."""
FINE = 1e-6
"""No number is written more finely than this part of it."""
COMPUTING, FINER = 0.1, 0.05
"""The share of students who compute or draw with a computer; how much finer that is than a hand."""
EXACT = 1 / 2
"""The share of what is right that is right to the digits, at least, where all is computed."""
CROWD = 12
"""So many with one value are no evidence of copies."""
Pair = tuple[int, int]


class AnswerSheet(Struct, frozen=True):
    """A student's numbers, how far each may be rounded, which are wrong, and the own variant."""

    answers: Any
    rounding: Any
    wrong: Any
    variant: int

    @property
    def is_read(self) -> Any:
        """The fields that hold a number."""
        import numpy as np

        return ~np.isnan(self.answers)


def copies(graded: Sequence[Graded], standards: Sequence[Expectation]) -> tuple[Suspicion, ...]:
    """Students who handed in the same digits: two, or more of whom any two did in all the fields
    that are named; the odds are those of the weakest two.
    """
    present = [i for i, each in enumerate(graded) if each.present]
    if len(present) < 2:
        return ()
    own, mine = distinct(standards)
    keys = Keys.of(own)
    sheets = {i: sheet(graded[i], keys, mine[id(standards[i])]) for i in present}
    alike = sum(comb(count, 2) for count in Counter(s.variant for s in sheets.values()).values())
    pairs = {True: alike, False: comb(len(present), 2) - alike}

    def needed(pair: Pair) -> float:
        """What counts for the choice of a pair: half of those who copy have the same data."""
        one, other = (sheets[who].variant for who in pair)
        return log(2 * pairs[one == other])

    def odds_of(pair: Pair, places: tuple[int, ...]) -> float:
        """The odds of two with the same digits in some fields, as a logarithm."""
        if len(places) < FEW:
            return -inf
        return told(pair, sheets, keys, places) - needed(pair)

    strong: dict[Pair, float] = {}
    fields: dict[Pair, tuple[int, ...]] = {}
    for pair, chances in agreeing(sheets, keys).items():
        if -sum(map(log, chances.values())) - needed(pair) >= log(STRONG):
            fields[pair] = tuple(chances)
            odds = odds_of(pair, fields[pair])
            if odds >= log(STRONG):
                strong[pair] = odds
    return tuple(
        Suspicion(
            tuple(graded[who].taker.student.id for who in group),
            tuple(keys.fields[place] for place in common),
            told_odds(odds),
        )
        for group, common, odds in named(strong, fields, odds_of)
    )


def sheet(graded: Graded, keys: Keys, variant: int) -> AnswerSheet:
    """What a student handed in, as numbers; each at least as coarse as lengths are read."""
    import numpy as np

    answers, digits = read_of(graded, keys)
    marks = {mark.item.field: mark for mark in graded.marks}
    wrong = np.array([marks[field].status is not Status.RIGHT for field in keys.fields])
    answers[~keys.known(variant)] = np.nan
    least = np.maximum(keys.reading(variant), FINE * np.nan_to_num(abs(answers)))
    return AnswerSheet(answers, np.maximum(digits, least), wrong, variant)


def agreeing(sheets: Mapping[int, AnswerSheet], keys: Keys) -> dict[Pair, dict[int, float]]:
    """The pairs with the same digits, in which fields, and how likely the class makes that."""
    found: dict[Pair, dict[int, float]] = defaultdict(dict)
    for place in range(len(keys.fields)):
        same: dict[float, list[int]] = defaultdict(list)
        for who, each in sheets.items():
            if each.answers[place] and each.is_read[place]:
                same[float(each.answers[place])].append(who)
        answered = sum(map(len, same.values()))
        for group in same.values():
            if 1 < len(group) <= CROWD:
                chance = (len(group) - 2 + KNOWN * RARE) / (answered - 2 + KNOWN)
                for pair in combinations(group, 2):
                    found[pair][place] = chance
    return found


def told(pair: Pair, sheets: Mapping[int, AnswerSheet], keys: Keys, places: Sequence[int]) -> float:
    """How much likelier the same digits in some fields are by a copy of just these fields than by
    chance, as a logarithm: by the chance of whoever is the less likely to have written them.
    """
    import numpy as np

    one, other = (sheets[who] for who in pair)
    agree = np.zeros(len(keys.fields), dtype=bool)
    agree[list(places)] = True
    shared = agree & one.wrong & other.wrong
    ways = ((one, other), (other, one))
    alone = min(by_oneself(*way, keys, agree & ~shared, ~agree) for way in ways)
    innocent = alone + misunderstood(one, other, keys, shared)
    if shared.any():
        innocent = float(np.logaddexp(innocent, both_computed(one, other, keys, agree)))
    measured = keys.beside == np.arange(len(keys.fields))
    both, taken = (int((each & measured).sum()) for each in (one.is_read & other.is_read, agree))
    choice = log(both + 1) + log(comb(both, taken))
    return -innocent - choice - log(2)


def both_computed(one: AnswerSheet, other: AnswerSheet, keys: Keys, agree: Any) -> float:
    """How likely two write the same digits who compute what they misunderstood alike, as a
    logarithm: what is right to the digits is so for both, all else follows from that, though some
    of it may be near enough to be right.
    """
    right = agree & ~(one.wrong & other.wrong)
    exact = agree.copy()
    for each in (one, other):
        exact &= abs(each.answers - keys.sizes[each.variant]) <= 1.01 * each.rounding
    if exact.sum() < max(FEW, EXACT * right.sum()):
        return -inf
    return log(COMPUTING) + misunderstood(one, other, keys, agree & ~exact, FINER * PENCILS[0])


def by_oneself(each: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, rest: Any) -> float:
    """How likely a student writes just these digits without the other's, as a logarithm: from the
    own drawing, or from a drawing of the other's data, which then the rest must fit as well.
    """
    import numpy as np

    if not read.any():
        return 0.0
    digits = float(np.log(2 * each.rounding[read]).sum())
    own = likelihood(each, keys, each.variant, read)
    if other.variant == each.variant:
        return min(0.0, own + digits)
    rest = rest & each.is_read & keys.known(other.variant)
    astray = likelihood(each, keys, other.variant, read | rest)
    astray -= likelihood(each, keys, each.variant, rest) + log(len(keys.sizes) / ASTRAY)
    return min(0.0, float(np.logaddexp(own, astray)) + digits)


def likelihood(each: AnswerSheet, keys: Keys, variant: int, read: Any) -> float:
    """How likely some of a student's answers are by the data of a variant, as a logarithm: drawn
    by hand, or computed.
    """
    import numpy as np

    if not read.any():
        return 0.0
    given = each.answers[read], each.rounding[read]
    by_hand, computed = (fit(*given, key).likelihood for key in tools(keys, variant, read))
    odds = (by_hand + log(1 - COMPUTING), computed + log(COMPUTING))
    return float(np.logaddexp(*odds))


def tools(keys: Keys, variant: int, read: Any) -> tuple[Key, Key]:
    """A key with the errors of a hand, and of a computer, by which no crank is laid off badly."""
    key = keys.key(variant, read)
    fine = replace(
        key, spread=FINER**2 * key.spread, computed=FINER * key.computed, cranks=0.0 * key.cranks
    )
    return key, fine


def misunderstood(
    one: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, pencil: float | None = None
) -> float:
    """How likely two write the same digits who misunderstood the same: as far as pencils like
    theirs do, or one that is stated, and their data, as a logarithm.
    """
    import numpy as np

    if not read.any():
        return 0.0
    finest = pencil or min(pencil_of(each, keys) for each in (one, other))
    apart = keys.sizes[one.variant][read] - keys.sizes[other.variant][read]
    rounding = np.maximum(one.rounding, other.rounding)[read]
    spread = 2 * finest**2 * keys.key(one.variant, read).spread
    spread = spread + np.diag(2 * rounding**2 / 3 + apart**2)
    density = -0.5 * np.linalg.slogdet(2 * pi * spread)[1]
    return min(0.0, float(density + np.log(2 * rounding).sum()))


def pencil_of(each: AnswerSheet, keys: Keys) -> float:
    """How coarse a student's pencil is by what is right, as fine as a computer's where that is as
    likely; the finest by hand where little is right.
    """
    read = each.is_read & ~each.wrong
    if read.sum() < FEW:
        return PENCILS[0]
    given = each.answers[read], each.rounding[read]
    drawn, computed = (fit(*given, key) for key in tools(keys, each.variant, read))
    is_finer = computed.likelihood + log(COMPUTING) > drawn.likelihood + log(1 - COMPUTING)
    return FINER * computed.pencil if is_finer else drawn.pencil


def named(
    strong: Mapping[Pair, float],
    fields: Mapping[Pair, tuple[int, ...]],
    odds_of: Callable[[Pair, tuple[int, ...]], float],
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...], float]]:
    """Who is named together, in which fields, with which odds as a logarithm: the strongest pair
    first, and whoever agrees as strongly with each of them in the fields of all.

    Who shares with one of them only what these share is not named: it was theirs already.
    """
    left = dict(sorted(strong.items(), key=lambda item: -item[1]))
    while left:
        pair, odds = next(iter(left.items()))
        group: tuple[int, ...] = pair
        common = fields[pair]
        for who in sorted({who for each in left for who in each}.difference(group)):
            joined = [(min(who, each), max(who, each)) for each in group]
            if all(each in left for each in joined):
                less = tuple(p for p in common if all(p in fields[each] for each in joined))
                grown = tuple(sorted((*group, who)))
                weakest = min(odds_of(each, less) for each in combinations(grown, 2))
                if weakest >= log(STRONG):
                    group, common, odds = grown, less, weakest
        within = {place for each in combinations(group, 2) for place in fields[each]}
        left = {
            each: value
            for each, value in left.items()
            if set(each).isdisjoint(group) or not within.issuperset(fields[each])
        }
        yield group, common, odds
