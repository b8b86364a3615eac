"""Evidence for the lecturer: answers that fit another student's data, or equal another's digits.

Both are judged by how closely all the answers together agree with either key: as closely as one
pencil explains, or to the last digit. A cause that runs through the whole drawing gives a further
key of the student's own: an angle laid off clockwise may be another student's angle. The other
students of the class matter only by their number.
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

from graphkin.accuracy.pencil import SCALES
from graphkin.classroom.grading.explanations import CauseWay
from graphkin.classroom.grading.graded import Graded, Status, Suspicion
from graphkin.classroom.grading.keys import (
    COMPUTED,
    FAR,
    PENCILS,
    Key,
    Keys,
    distinct,
    fit,
    likelihood_if_drawn,
    read_of,
    reported_odds,
)
from graphkin.classroom.grading.standard import Expectation
from graphkin.classroom.lab.lab_model import ANOTHER
from graphkin.numbers.arithmetic import np

FEW = 3
"""The fewest values that determine a scale."""
SHARE = 1 / 20
"""How frequent a cause is, or a scale of one's own."""
ODD = 1.25
"""The least factor, up or down, by which a student's scale differs from the right one."""


class OwnWay(Struct, frozen=True):
    """The answers of one way of working, and how frequent the way is, as a logarithm.

    ``sizes`` are the answers it gives. Their errors are ``times`` those of the key.
    """

    sizes: Any
    times: Any
    share: float = 0.0

    def key(self, keys: Keys, variant: int, read: Any) -> Key:
        """The key of a variant for a student who works this way, in the fields that are read."""
        key, times = keys.key(variant, read), self.times[read]
        return replace(
            key,
            sizes=self.sizes[read],
            spread=key.spread * np.outer(times, times),
            computed=key.computed * times,
            cranks=key.cranks * times,
        )


def rightly(keys: Keys, variant: int) -> OwnWay:
    """The way of the key."""
    return OwnWay(keys.sizes[variant], np.ones(len(keys.fields)))


def by_own_scales(answers: Any, keys: Keys, variant: int, read: Any) -> Iterator[OwnWay]:
    """The way in which all values of a plan are too large by one factor.

    The factor of each plan is the likeliest. Nothing is yielded where all are near 1.
    """
    sizes, times = keys.sizes[variant], np.ones(len(keys.fields))
    for plan in range(1, len(SCALES)):
        values = read & (keys.plans == plan) & (sizes > 0)
        ratio = np.median(answers[values] / sizes[values]) if values.sum() >= FEW else 1.0
        if ratio > 0 and abs(log(ratio)) >= log(ODD):
            times[keys.plans == plan] = ratio
    if (times != 1).any():
        yield OwnWay(sizes * times, times, log(SHARE))


def by_causes(ways: Iterable[CauseWay], keys: Keys) -> Iterator[OwnWay]:
    """The ways of some causes; the error of a value grows with the value that a cause makes."""
    for way in ways:
        values = np.array([way.values[field] for field in keys.fields])
        sizes = np.where(keys.places, values, abs(values))
        times = np.array([way.times[field] for field in keys.fields])
        if np.isfinite(sizes).all() and np.isfinite(times).all():
            yield OwnWay(sizes, times, len(way.names) * log(SHARE))


def from_own_values(graded: Graded, answers: Any, keys: Keys, variant: int) -> Iterator[OwnWay]:
    """The way in which answers follow from the student's earlier values, whatever these are."""
    marks = {mark.item.field: mark for mark in graded.marks}
    statuses = (Status.FOLLOWS, Status.RIGHT)
    follows = np.array([bool(marks[f].source) and marks[f].status in statuses for f in keys.fields])
    follows &= ~np.isnan(answers)
    if follows.any():
        sizes = np.where(follows, answers, keys.sizes[variant])
        yield OwnWay(sizes, np.ones(len(keys.fields)))


# --- answers that fit another student's data ------------------------------------------------------


STRONG = 1000.0
"""The least odds at which a wrong variant is reported, after correction for all comparisons."""
TRIED = 3
"""The number of variants compared closely: those nearest to the answers taken singly."""
WAYS = 8
"""The number of ways of working with a cause that are compared closely with some answers."""
CLOSE = 64
"""The number of variants of which the nearest are chosen, by the digits of the answers too."""


Ways = Callable[[Graded], Sequence[CauseWay]]
"""The ways of working with a student's data and one cause, or the causes that were found."""


Alone = Callable[[str], AbstractContextManager[None]]
"""A context manager by the name of a unit of work, which may fail without the others."""


def together(unit: str) -> AbstractContextManager[None]:
    """A context manager that lets errors pass."""
    return nullcontext()


def no_ways(graded: Graded) -> Sequence[CauseWay]:
    return ()


def wrong_variants(
    graded: Sequence[Graded],
    standards: Sequence[Expectation],
    ways: Ways = no_ways,
    alone: Alone = together,
) -> tuple[Suspicion, ...]:
    """Students whose answers fit another student's data.

    Each suspicion names the student and the owners of the data, the fields and the odds.
    ``standards`` holds the expectation of each student, in the same order, including students who
    handed in nothing. ``ways`` is called only for students who would be named without it.
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
            if best is not None and (known := ways(each)):
                best = best_other(each, keys, place, enough, known)
        if best is not None:
            ids = (each.taker.student.id, *theirs[best.other])
            found.append(Suspicion(ids, best.fields, reported_odds(best.odds - choices), best.of))
    return tuple(found)


class Best(Struct, frozen=True):
    """The other variant that some answers fit.

    ``fields`` are those that fit, of ``of`` answers. ``odds`` says how much likelier the other
    variant is than the student's own, as a logarithm.
    """

    other: int
    fields: tuple[str, ...]
    of: int
    odds: float


def best_other(
    graded: Graded, keys: Keys, mine: int, enough: float, known: Sequence[CauseWay] = ()
) -> Best | None:
    """The other variant that a student's answers fit best; None where none fits clearly better.

    The comparison is with the student's own variant, alone or by a known way. ``enough`` is
    the least odds, as a logarithm.
    """
    answers, digits = read_of(graded, keys)
    caused = likeliest(tuple(by_causes(known, keys)), answers, digits, keys, mine)
    marks = {mark.item.field: mark for mark in graded.marks}
    causes = [marks[field].cause.split("+") for field in keys.fields]
    explained = np.array([each != [""] and ANOTHER not in each for each in causes])
    found = None
    for other in nearest(answers, digits, keys, mine):
        agree = abs(answers - keys.sizes[other]) <= 1.01 * digits
        both = keys.known(mine) & keys.known(other)
        read = ~np.isnan(answers) & both & (~explained | agree)
        if read.sum() < FEW or not keys.tells(mine, other, read):
            continue
        given, rounded = answers[read], digits[read]
        theirs = fit(given, rounded, keys.key(other, read))
        plain = likelihood_if_drawn(given, rounded, keys.key(mine, read), theirs.fits)
        if theirs.likelihood - plain < enough:
            continue
        honest = (rightly(keys, mine), *by_own_scales(answers, keys, mine, read))
        tried = [(way, way.key(keys, mine, read)) for way in (*honest, *caused)]
        tried += [(way, as_drawn(way, keys, int(other), read)) for way in caused]
        own = max(way.share + fit(given, rounded, k, theirs.fits).likelihood for way, k in tried)
        odds = theirs.likelihood - own
        fitting = theirs.fits.sum() >= FEW and odds >= enough
        if fitting and (found is None or odds > found.odds):
            fits = np.flatnonzero(read)[theirs.fits]
            fields = tuple(keys.fields[place] for place in fits)
            found = Best(int(other), fields, int((~np.isnan(answers)).sum()), odds)
    return found


def likeliest(
    ways: Sequence[OwnWay], answers: Any, digits: Any, keys: Keys, mine: int
) -> Sequence[OwnWay]:
    """The ``WAYS`` whose values are nearest to the answers, each answer taken singly."""
    if len(ways) <= WAYS:
        return ways
    sizes, times = (np.array([getattr(w, name) for w in ways]) for name in ("sizes", "times"))
    with np.errstate(all="ignore"):
        spread = (keys.deviations[mine] * times) ** 2 + digits**2 / 3 + (COMPUTED * sizes) ** 2
        far = (answers - sizes) ** 2 / spread + np.log(spread / keys.deviations[mine] ** 2)
    order = np.argsort(np.nansum(np.minimum(far, FAR**2), axis=1), kind="stable")
    return [ways[i] for i in order[:WAYS].tolist()]


def as_drawn(way: OwnWay, keys: Keys, other: int, read: Any) -> Key:
    """The values of a way, with the errors of a drawing of other data, which looks the same."""
    return replace(keys.key(other, read), sizes=way.sizes[read])


def nearest(answers: Any, digits: Any, keys: Keys, mine: int) -> Any:
    """At most ``TRIED`` variants that are nearer to the answers than the student's own.

    Each answer counts by itself. Rounding is looked at only in the ``CLOSE`` nearest of all.
    """
    some = np.arange(len(keys.sizes))
    if len(some) > CLOSE:
        some = np.append(np.argpartition(keys.away(answers, FAR), CLOSE)[:CLOSE], mine)
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = (answers - keys.sizes[some]) ** 2 / (keys.deviations[some] ** 2 + digits**2 / 3)
    far = np.nansum(np.minimum(apart, FAR**2), axis=1)
    nearer = np.flatnonzero(far < far[some == mine][0])
    order = nearer[np.lexsort((some[nearer], far[nearer]))[:TRIED]]
    return [int(some[i]) for i in order]


# --- two students with the same digits ------------------------------------------------------------


INNOCENT = 0.001
"""The most innocent pairs expected to be named in a class."""
STRONG_COPY = 1 / INNOCENT
"""The least odds at which a copy is reported, after correction for all comparisons."""
PART = 0.1
"""How often only one is copied of a length and the value computed from it."""
RARE = 0.01
"""How often two numbers agree by chance where nothing else is known."""
KNOWN = 10.0
"""The weight of ``RARE``, in answers."""
ASTRAY = 0.02
"""The share of students who draw another student's data."""
FINE = 1e-6
"""The finest relative rounding of a number."""
COMPUTING, FINER = 0.1, 0.05
"""The share of students who use a computer; the error of a computer relative to a hand's."""
EXACT = 1 / 2
"""The least share of right answers that are right to the last digit, where all is computed."""
CROWD = 12
"""The largest group with one value that is evidence of copying."""
Pair = tuple[int, int]


class AnswerSheet(Struct, frozen=True):
    """A student's numbers, as arrays over the fields.

    ``digits`` are the rounding errors by the digits written, and ``least`` those of reading a
    length. ``wrong`` marks wrong answers. ``variant`` is the student's own, and ``ways`` are the
    ways of working with its data that may give the answers. ``strays`` are other variants, whose
    data may have been drawn.
    """

    answers: Any
    digits: Any
    least: Any
    wrong: Any
    variant: int
    ways: tuple[OwnWay, ...]
    strays: tuple[int, ...] = ()

    @property
    def rounding(self) -> Any:
        """The rounding error of each answer."""
        return np.maximum(self.digits, self.least)

    @property
    def is_read(self) -> Any:
        """The fields that hold a number."""
        return ~np.isnan(self.answers)


def copies(
    graded: Sequence[Graded],
    standards: Sequence[Expectation],
    ways: Ways = no_ways,
    alone: Alone = together,
) -> tuple[Suspicion, ...]:
    """Students who handed in the same digits: two, or a group.

    In a group, any two students share the digits of all named fields; the odds are those of the
    weakest pair. ``ways`` is called only for students who would be named without it.
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
        """The correction for the choice of a pair: half of the copiers have the same data."""
        one, other = (sheets[who].variant for who in pair)
        return log(2 * pairs[one == other])

    def odds_of(pair: Pair, places: tuple[int, ...]) -> float:
        """The odds that two students copied the same digits in some fields, as a logarithm."""
        if len(places) < FEW:
            return -inf
        enough = log(STRONG_COPY) + needed(pair)
        return copy_evidence(pair, sheets, keys, places, enough) - needed(pair)

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
                sheets |= {who: with_causes(sheets[who], graded[who], keys, ways) for who in new}
                asked.update(new)
                odds = odds_of(pair, tuple(chances))
            fields[pair] = tuple(chances)
            if odds >= log(STRONG_COPY):
                strong[pair] = odds
    return tuple(
        Suspicion(
            tuple(graded[who].taker.student.id for who in group),
            tuple(keys.fields[place] for place in common),
            reported_odds(odds),
        )
        for group, common, odds in named(strong, fields, odds_of)
    )


def sheet(graded: Graded, keys: Keys, variant: int) -> AnswerSheet:
    """A student's answers as numbers, with the ways of working that need no cause."""
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
    least = keys.reading(variant, whole=is_whole(answers[keys.lengths]))
    return AnswerSheet(answers, digits, least, wrong, variant, ways)


def is_whole(lengths: Any) -> bool:
    """Whether a student reads whole millimetres: all lengths are, and they are not too few."""
    known = lengths[~np.isnan(lengths)]
    return len(known) >= FEW and bool((known % 1 == 0).all())


def with_causes(each: AnswerSheet, graded: Graded, keys: Keys, ways: Ways) -> AnswerSheet:
    """A student's sheet with the ways of the causes that explain some of the answers.

    It has the variants that are nearest to the answers, too: two students may draw a third's data.
    """
    names = {cause.name for cause in graded.causes}
    made = [way for way in ways(graded) if names.intersection(way.names)] if names else ()
    strays = tuple(nearest(each.answers, each.digits, keys, each.variant))
    return replace(each, ways=(*each.ways, *by_causes(made, keys)), strays=strays)


def agreeing(sheets: Mapping[int, AnswerSheet], keys: Keys) -> dict[Pair, dict[int, float]]:
    """The pairs with the same digits, the fields, and how likely the class makes each agreement."""
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


def copy_evidence(
    pair: Pair,
    sheets: Mapping[int, AnswerSheet],
    keys: Keys,
    places: Sequence[int],
    enough: float = -inf,
) -> float:
    """How much likelier a copy of just these fields is than chance, as a logarithm.

    A result below ``enough`` is only an upper bound.
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
    """How likely two students write the same digits, by each innocent explanation, as a logarithm.

    The explanations are independent work, judged by the less likely of the two students, and a
    misunderstanding that both share. The first result, by the key alone, is the quickest to
    compute.
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
    """How likely it is to write these digits by the student's own key, as a logarithm.

    The result is that of the less likely of the two students.
    """
    both = (one, other)
    return min(0.0, *(likelihood(s, keys, s.variant, s.ways[0], read, True) for s in both))


def chosen(keys: Keys, both: Any, agree: Any) -> float:
    """How often exactly these fields are copied, of those that both have, as a negative logarithm.

    Any number of quantities may be copied, mostly with both the length and the value.
    """
    quantities, places = np.unique(keys.beside, return_inverse=True)
    there, taken = (np.bincount(places, each, len(quantities)) for each in (both, agree))
    count, some = int((there > 0).sum()), taken > 0
    parts, whole = int((some & (taken < there)).sum()), int((some & (taken > 1)).sum())
    choice = log(count + 1) + log(comb(count, int(some.sum())))
    return choice - parts * log(PART / 2) - whole * log(1 - PART)


def alone(one: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, agree: Any) -> float:
    """How likely it is to write these digits without the other student's, as a logarithm.

    The result is that of the less likely of the two students. The answers that do not agree count
    as the student's own.
    """
    return min(by_oneself(*way, keys, read, ~agree) for way in ((one, other), (other, one)))


def both_computed(one: AnswerSheet, other: AnswerSheet, keys: Keys, agree: Any) -> float:
    """How likely two students who compute write the same digits, as a logarithm.

    Both misunderstood the same. Right answers agree to the digit, and all others follow from the
    misunderstanding, even those near enough to be right. Minus infinity where too few answers are
    right to the digit.
    """
    right = agree & ~(one.wrong & other.wrong)
    exact = agree.copy()
    for each in (one, other):
        exact &= abs(each.answers - keys.sizes[each.variant]) <= 1.01 * each.rounding
    if exact.sum() < max(FEW, EXACT * right.sum()):
        return -inf
    return log(COMPUTING) + misunderstood(one, other, keys, agree & ~exact, FINER * PENCILS[0])


def by_oneself(each: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, rest: Any) -> float:
    """How likely a student writes just these digits without the other's, as a logarithm.

    The digits come from the student's own drawing, or from a drawing of other data: those of the
    other student, or of a third. The ``rest`` of the sheet weights these explanations; the
    student's own ways keep at least their prior share.
    """
    if not read.any():
        return 0.0
    sources = [(each.variant, way) for way in each.ways]
    rest = rest & each.is_read
    for variant in dict.fromkeys((other.variant, *each.strays)):
        if variant != each.variant:
            rest = rest & keys.known(variant)
            astray = replace(rightly(keys, variant), share=log(ASTRAY / len(keys.sizes)))
            sources.append((variant, astray))
    own = np.array([variant == each.variant for variant, _ in sources])
    shares = np.array([way.share for _, way in sources])
    posteriors = shares + [likelihood(each, keys, *source, rest) for source in sources]
    posteriors -= np.logaddexp.reduce(posteriors)
    shares = np.where(own, np.maximum(shares, posteriors), posteriors)
    digits = [likelihood(each, keys, *source, read, True) for source in sources]
    return min(0.0, float(np.logaddexp.reduce(shares + digits)))


def likelihood(
    each: AnswerSheet, keys: Keys, variant: int, way: OwnWay, read: Any, exactly: bool = False
) -> float:
    """How likely some of a student's answers are by one way of working, as a logarithm.

    The way uses the data of ``variant``, drawn by hand or computed. With ``exactly``, the result is
    the likelihood of the very digits.
    """
    if not read.any():
        return 0.0
    rounding = np.maximum(each.digits, each.least * way.times)[read]
    key = way.key(keys, variant, read)
    by_hand, computed = (fit(each.answers[read], rounding, k).likelihood for k in tools(key))
    found = np.logaddexp(by_hand + log(1 - COMPUTING), computed + log(COMPUTING))
    return float(found + np.log(2 * rounding).sum() if exactly else found)


def tools(key: Key) -> tuple[Key, Key]:
    """The key with the errors of a hand, and the key with those of a computer.

    A computer sets every crank exactly.
    """
    fine = replace(
        key, spread=FINER**2 * key.spread, computed=FINER * key.computed, cranks=0.0 * key.cranks
    )
    return key, fine


def misunderstood(
    one: AnswerSheet, other: AnswerSheet, keys: Keys, read: Any, pencil: float | None = None
) -> float:
    """How likely two students who misunderstood the same write the same digits, as a logarithm.

    The scatter is that of pencils like theirs, or of a given ``pencil``, and of the difference
    between their data. Answers many times too large are read as many times more coarsely; the
    errors of answers too small shrink in proportion.
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
    """The coarseness of a student's pencil, by the right answers; the finest by hand where few are.

    A computer's fineness is returned where a computer is the likelier tool.
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
    """The groups of students to name, with their fields and odds as a logarithm.

    Each group grows from the strongest pair, by students who agree as strongly with every member in
    the fields of all. A pair that touches a named group is dropped where its fields are all shared
    within the group.
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
