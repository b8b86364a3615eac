"""Evidence for the lecturer: answers that fit another student's data better than the own.

Both are told by how closely the answers agree with either key, all of them together: by as much as
one pencil explains, or to the very digits. The own key is also that of a slip that goes through the
whole drawing: an angle laid off clockwise is another's angle. Whoever else is in the class matters
only by number.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from itertools import combinations
from math import comb, inf, log, pi
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.follow_through import SPAN
from graphkin.classroom.grading.graded import Graded, Status, Suspicion
from graphkin.classroom.grading.keys import Keys, distinct, read_of
from graphkin.classroom.grading.likelihood import (
    FAR,
    PENCILS,
    Key,
    fit,
    likelihood_if_drawn,
    told_odds,
)
from graphkin.classroom.grading.slip_diagnosis import SHARE, share
from graphkin.classroom.grading.slips import UNITS_TAKEN, Slip
from graphkin.classroom.grading.standard import Expectation
from graphkin.numbers.arithmetic import np

FEW = 3
"""Fewer values tell nothing of a scale."""
ODD = 1.25
"""A scale of one's own is at least so many times too large or too small."""


class OwnWay(Struct, frozen=True):
    """What each answer would be, ``times`` as far off as by the key, and how often that way is
    gone, as a logarithm.
    """

    sizes: Any
    times: Any
    share: float = 0.0

    def key(self, keys: Keys, variant: int, read: Any) -> Key:
        """The key of a variant, in the fields that are read, of whoever goes this way."""
        key, times = keys.key(variant, read), self.times[read]
        return replace(
            key,
            sizes=self.sizes[read],
            spread=key.spread * np.outer(times, times),
            computed=key.computed * times,
            cranks=key.cranks * times,
        )


def rightly(keys: Keys, variant: int) -> OwnWay:
    """As the key has it."""
    return OwnWay(keys.sizes[variant], np.ones(len(keys.fields)))


def by_own_scales(answers: Any, keys: Keys, variant: int, read: Any) -> Iterator[OwnWay]:
    """The values of either plan all as many times too large, by the likeliest factors, where they
    are by far.
    """
    sizes, times = keys.sizes[variant], np.ones(len(keys.fields))
    for plan in (1, 2):
        values = read & (keys.plans == plan) & (sizes > 0)
        ratio = np.median(answers[values] / sizes[values]) if values.sum() >= FEW else 1.0
        if ratio > 0 and abs(log(ratio)) >= log(ODD):
            times[keys.plans == plan] = ratio
    if (times != 1).any():
        yield OwnWay(sizes * times, times, log(SHARE))


def by_slips(slips: Iterable[Slip], keys: Keys, variant: int) -> Iterator[OwnWay]:
    """With each of some slips: what it makes larger is off by more, as what it makes smaller by
    less.
    """
    right = keys.standards[variant].key
    for slip in slips:
        told = np.array([slip.values.get(field, right[field]) for field in keys.fields])
        sizes = np.where(keys.places, told, abs(told))
        with np.errstate(divide="ignore", invalid="ignore"):
            times = np.nan_to_num(sizes / keys.sizes[variant], nan=1.0, posinf=1.0)
        if slip.whole and slip.name not in UNITS_TAKEN:
            times = np.clip(times, *SPAN)
        yield OwnWay(sizes, np.where(keys.places, 1.0, times), log(share(slip)))


def from_own_values(graded: Graded, answers: Any, keys: Keys, variant: int) -> Iterator[OwnWay]:
    """What follows from own earlier values as it was told, whatever these are."""
    marks = {mark.item.field: mark for mark in graded.marks}
    told = (Status.FOLLOWS, Status.RIGHT)
    follows = np.array([bool(marks[f].source) and marks[f].status in told for f in keys.fields])
    follows &= ~np.isnan(answers)
    if follows.any():
        sizes = np.where(follows, answers, keys.sizes[variant])
        yield OwnWay(sizes, np.ones(len(keys.fields)))


# --- evidence for the lecturer: answers that fit another student's data better than the own -------


STRONG = 1000.0
"""Odds from which a wrong variant is reported, all that was looked through counted."""
EXPLAINED = 1000.0
"""Odds of a slip from which an answer is its own, and no evidence but where digits agree."""
TRIED = 3
"""Variants that are looked at closely: those nearest to the answers, each answer by itself."""


Slips = Callable[[Graded], Sequence[Slip]]
"""The slips with a student's data."""


Alone = Callable[[str], AbstractContextManager[None]]
"""Lets work on one unit, by its name, fail alone."""


def together(unit: str) -> AbstractContextManager[None]:
    """What fails is raised."""
    return nullcontext()


def no_slips(graded: Graded) -> Sequence[Slip]:
    """None."""
    return ()


def wrong_variants(
    graded: Sequence[Graded],
    standards: Sequence[Expectation],
    slips: Slips = no_slips,
    alone: Alone = together,
) -> tuple[Suspicion, ...]:
    """Students whose answers fit another's data: (student, owners), the fields, the odds.

    ``standards`` holds what each was marked against, in the same order; those who handed in
    nothing have data, too. ``slips`` are asked only for whoever would be named without them.
    """
    if not standards or len(standards[0].tolerance) < FEW:
        return ()
    own, mine = distinct(standards)
    keys = Keys.of(own)
    theirs: dict[int, list[str]] = defaultdict(list)
    for each, standard in zip(graded, standards, strict=True):
        theirs[mine[id(standard)]].append(each.taker.student.id)
    choices = log(max(1, len(own) - 1) * max(1, sum(each.present for each in graded)))
    found = []
    for each, standard in zip(graded, standards, strict=True):
        tells = each.present and len(own) > 1
        enough = choices + log(STRONG)
        place = mine[id(standard)]
        best = None
        with alone(each.taker.student.id):
            best = best_other(each, keys, place, enough) if tells else None
            if best is not None and (known := [slip for slip in slips(each) if slip.whole]):
                best = best_other(each, keys, place, enough, known)
        if best is not None:
            ids = (each.taker.student.id, *theirs[best.other])
            found.append(Suspicion(ids, best.fields, told_odds(best.odds - choices), best.of))
    return tuple(found)


class Best(Struct, frozen=True):
    """The other variant that some answers fit, in which fields of how many, and how much likelier
    than the own, as a logarithm."""

    other: int
    fields: tuple[str, ...]
    of: int
    odds: float


def best_other(
    graded: Graded, keys: Keys, mine: int, enough: float, slips: Sequence[Slip] = ()
) -> Best | None:
    """The other variant that a student's answers fit best; None where none fits so much better than
    the own, or the own with one of some slips, as is ``enough``, a logarithm.
    """
    answers, digits = read_of(graded, keys)
    marks = {mark.item.field: mark for mark in graded.marks}
    explained = np.array([marks[field].odds >= EXPLAINED for field in keys.fields])
    found = None
    for other in nearest(answers, digits, keys, mine):
        agree = abs(answers - keys.sizes[other]) <= 1.01 * digits
        known = keys.known(mine) & keys.known(other)
        read = ~np.isnan(answers) & known & (~explained | agree)
        if read.sum() < FEW:
            continue
        given, rounded = answers[read], digits[read]
        theirs = fit(given, rounded, keys.key(other, read))
        plain = likelihood_if_drawn(given, rounded, keys.key(mine, read), theirs.fits)
        if theirs.likelihood - plain < enough:
            continue
        ways = (
            rightly(keys, mine),
            *by_own_scales(answers, keys, mine, read),
            *by_slips(slips, keys, mine),
        )
        own = max(
            way.share + fit(given, rounded, way.key(keys, mine, read), theirs.fits).likelihood
            for way in ways
        )
        odds = theirs.likelihood - own
        fitting = theirs.fits.sum() >= FEW and odds >= enough
        if fitting and (found is None or odds > found.odds):
            fits = np.flatnonzero(read)[theirs.fits]
            fields = tuple(keys.fields[place] for place in fits)
            found = Best(int(other), fields, int((~np.isnan(answers)).sum()), odds)
    return found


def nearest(answers: Any, digits: Any, keys: Keys, mine: int) -> Any:
    """The few variants nearer to the answers than the own, each answer taken by itself."""
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = (answers - keys.sizes) ** 2 / (keys.deviations**2 + digits**2 / 3)
    far = np.nansum(np.minimum(apart, FAR**2), axis=1)
    nearer = np.flatnonzero(far < far[mine])
    return [int(i) for i in nearer[np.argsort(far[nearer], kind="stable")[:TRIED]]]


# --- evidence for the lecturer: two students who handed in the same digits ------------------------


INNOCENT = 0.001
"""How many innocent pairs are expected to be named in a class, at most."""
STRONG_COPY = 1 / INNOCENT
"""Odds from which a copy is reported, all that was looked through counted."""
PART = 0.1
"""How often of a length and the value computed from it only one is copied."""
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
    """A student's numbers, how far each may be rounded by its ``digits``, and at ``least`` as
    lengths are read, which are wrong, the own variant, and the ways that lead there by its data.
    """

    answers: Any
    digits: Any
    least: Any
    wrong: Any
    variant: int
    ways: tuple[OwnWay, ...]

    @property
    def rounding(self) -> Any:
        """How far each may be rounded."""
        return np.maximum(self.digits, self.least)

    @property
    def is_read(self) -> Any:
        """The fields that hold a number."""
        return ~np.isnan(self.answers)


def copies(
    graded: Sequence[Graded],
    standards: Sequence[Expectation],
    slips: Slips = no_slips,
    alone: Alone = together,
) -> tuple[Suspicion, ...]:
    """Students who handed in the same digits: two, or more of whom any two did in all the fields
    that are named; the odds are those of the weakest two. ``slips`` are asked only for whoever
    would be named without them.
    """
    present = [i for i, each in enumerate(graded) if each.present]
    if len(present) < 2:
        return ()
    own, mine = distinct(standards)
    keys = Keys.of(own)
    ids = [each.taker.student.id for each in graded]
    sheets = dict[int, AnswerSheet]()
    for i in present:
        with alone(ids[i]):
            sheets[i] = sheet(graded[i], keys, mine[id(standards[i])])
    present = list(sheets)
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
        enough = log(STRONG_COPY) + needed(pair)
        return told(pair, sheets, keys, places, enough) - needed(pair)

    strong: dict[Pair, float] = {}
    fields: dict[Pair, tuple[int, ...]] = {}
    asked: set[int] = set()
    for pair, chances in agreeing(sheets, keys).items():
        if -sum(map(log, chances.values())) - needed(pair) < log(STRONG_COPY):
            continue
        with alone(", ".join(ids[who] for who in pair)):
            odds = odds_of(pair, tuple(chances))
            if odds >= log(STRONG_COPY) and not asked.issuperset(pair):
                new = [who for who in pair if who not in asked]
                sheets |= {who: with_slips(sheets[who], graded[who], keys, slips) for who in new}
                asked.update(new)
                odds = odds_of(pair, tuple(chances))
            fields[pair] = tuple(chances)
            if odds >= log(STRONG_COPY):
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
    answers, digits = read_of(graded, keys)
    marks = {mark.item.field: mark for mark in graded.marks}
    wrong = np.array([marks[field].status is not Status.RIGHT for field in keys.fields])
    answers[~keys.known(variant)] = np.nan
    digits = np.maximum(digits, FINE * np.nan_to_num(abs(answers)))
    ways = (
        rightly(keys, variant),
        *by_own_scales(answers, keys, variant, ~np.isnan(answers)),
        *from_own_values(graded, answers, keys, variant),
    )
    return AnswerSheet(answers, digits, keys.reading(variant), wrong, variant, ways)


def with_slips(each: AnswerSheet, graded: Graded, keys: Keys, slips: Slips) -> AnswerSheet:
    """A student's numbers, to which the slips that explain some of them may have led as well."""
    names = {mark.slip for mark in graded.marks if mark.slip}
    made = [slip for slip in slips(graded) if slip.name in names] if names else ()
    return replace(each, ways=(*each.ways, *by_slips(made, keys, each.variant)))


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


def told(
    pair: Pair,
    sheets: Mapping[int, AnswerSheet],
    keys: Keys,
    places: Sequence[int],
    enough: float = -inf,
) -> float:
    """How much likelier the same digits in some fields are by a copy of just these fields than by
    chance, as a logarithm; no more exactly than that it is less than ``enough``.
    """
    one, other = (sheets[who] for who in pair)
    agree = np.zeros(len(keys.fields), dtype=bool)
    agree[list(places)] = True
    choice = chosen(keys, one.is_read & other.is_read, agree) + log(2)
    innocent = -inf
    for each in by_chance(one, other, keys, agree):
        innocent = max(innocent, each)
        if -innocent - choice < enough:
            break
    return -innocent - choice


def by_chance(one: AnswerSheet, other: AnswerSheet, keys: Keys, agree: Any) -> Iterator[float]:
    """How likely two write the same digits, by each explanation, as a logarithm: by the chance of
    whoever is the less likely to have written them, and by what both misunderstood. At least so
    likely by what is quickly told, which is the key without the rest of the sheets.
    """
    shared = agree & one.wrong & other.wrong
    yield by_key(one, other, keys, agree)
    if shared.any():
        same = misunderstood(one, other, keys, shared)
        yield same + by_key(one, other, keys, agree & ~shared)
        yield both_computed(one, other, keys, agree)
        yield same + alone(one, other, keys, agree & ~shared, agree)
    yield alone(one, other, keys, agree, agree)


def by_key(one: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any) -> float:
    """How likely the one of two who is the less likely to write some digits does so by the own
    key, as a logarithm.
    """
    both = (one, other)
    return min(0.0, *(likelihood(s, keys, s.variant, s.ways[0], read, True) for s in both))


def chosen(keys: Keys, both: Any, agree: Any) -> float:
    """How often just these of the fields that both have are copied, as a logarithm, with its sign
    turned: any number of quantities, each mostly with its length and with its value.
    """
    quantities, places = np.unique(keys.beside, return_inverse=True)
    there, taken = (np.bincount(places, each, len(quantities)) for each in (both, agree))
    count, some = int((there > 0).sum()), taken > 0
    parts, whole = int((some & (taken < there)).sum()), int((some & (taken > 1)).sum())
    choice = log(count + 1) + log(comb(count, int(some.sum())))
    return choice - parts * log(PART / 2) - whole * log(1 - PART)


def alone(one: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, agree: Any) -> float:
    """How likely the one of two who is the less likely to write some digits does so without the
    other's, as a logarithm; what does not agree is the own.
    """
    return min(by_oneself(*way, keys, read, ~agree) for way in ((one, other), (other, one)))


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
    own drawing, by each way that the rest of the sheet was gone, as it tells, or may be gone in
    these answers alone; or from a drawing of the other's data, which then the rest tells as well.
    """
    if not read.any():
        return 0.0
    sources = [(each.variant, way) for way in each.ways]
    rest = rest & each.is_read
    if other.variant != each.variant:
        rest = rest & keys.known(other.variant)
        astray = replace(rightly(keys, other.variant), share=log(ASTRAY / len(keys.sizes)))
        sources.append((other.variant, astray))
    own = np.array([variant == each.variant for variant, _ in sources])
    shares = np.array([way.share for _, way in sources])
    told = shares + [likelihood(each, keys, *source, rest) for source in sources]
    told -= np.logaddexp.reduce(told)
    shares = np.where(own, np.maximum(shares, told), told)
    digits = [likelihood(each, keys, *source, read, True) for source in sources]
    return min(0.0, float(np.logaddexp.reduce(shares + digits)))


def likelihood(
    each: AnswerSheet, keys: Keys, variant: int, way: OwnWay, read: Any, exactly: bool = False
) -> float:
    """How likely some of a student's answers are, or ``exactly`` their digits, by a way that is
    gone with the data of a variant, as a logarithm: drawn by hand, or computed.
    """
    if not read.any():
        return 0.0
    rounding = np.maximum(each.digits, each.least * way.times)[read]
    key = way.key(keys, variant, read)
    by_hand, computed = (fit(each.answers[read], rounding, k).likelihood for k in tools(key))
    found = np.logaddexp(by_hand + log(1 - COMPUTING), computed + log(COMPUTING))
    return float(found + np.log(2 * rounding).sum() if exactly else found)


def tools(key: Key) -> tuple[Key, Key]:
    """A key with the errors of a hand, and of a computer, by which no crank is laid off badly."""
    fine = replace(
        key, spread=FINER**2 * key.spread, computed=FINER * key.computed, cranks=0.0 * key.cranks
    )
    return key, fine


def misunderstood(
    one: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, pencil: float | None = None
) -> float:
    """How likely two write the same digits who misunderstood the same: as far as pencils like
    theirs do, or one that is stated, and their data, as a logarithm. What they make many times as
    large is read as many times as coarsely; what smaller, off by less, and less apart.
    """
    if not read.any():
        return 0.0
    finest = pencil or min(pencil_of(each, keys) for each in (one, other))
    key, others = keys.key(one.variant, read), keys.sizes[other.variant][read]
    apart, mean = key.sizes - others, (key.sizes + others) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        times = np.nan_to_num(one.answers[read] / mean, nan=1.0, posinf=1.0)
    times = np.where(key.places, 1.0, times)
    coarse, smaller = np.maximum(1.0, times), np.minimum(1.0, times)
    least = np.maximum(one.least, other.least)[read] * coarse
    rounding = np.maximum(np.maximum(one.digits, other.digits)[read], least)
    spread = 2 * finest**2 * key.spread * np.outer(smaller, smaller)
    spread = spread + np.diag(2 * rounding**2 / 3 + (smaller * apart) ** 2)
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
    drawn, computed = (fit(*given, key) for key in tools(keys.key(each.variant, read)))
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
                if weakest >= log(STRONG_COPY):
                    group, common, odds = grown, less, weakest
        within = {place for each in combinations(group, 2) for place in fields[each]}
        left = {
            each: value
            for each, value in left.items()
            if set(each).isdisjoint(group) or not within.issuperset(fields[each])
        }
        yield group, common, odds
