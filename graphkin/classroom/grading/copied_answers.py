"""Evidence for the lecturer: answers that fit another student's data better than the own.

Both are told by how closely the answers agree with either key, all of them together: by as much as
one pencil explains, or to the very digits. The own key is also that of a slip that goes through the
whole drawing: an angle laid off clockwise is another's angle. Whoever else is in the class matters
only by number.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from math import log
from typing import Any

from msgspec import Struct

from graphkin.classroom.grading.graded import Graded, Suspicion
from graphkin.classroom.grading.keys import Keys, distinct, read_of
from graphkin.classroom.grading.likelihood import FAR, fit, likelihood_if_drawn, told_odds
from graphkin.classroom.grading.own_ways import by_own_scales, by_slips, rightly
from graphkin.classroom.grading.slips import Slip
from graphkin.classroom.grading.standard import Expectation
from graphkin.numbers.arrays import np

FEW = 3
"""Fewer fields tell nothing."""
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
