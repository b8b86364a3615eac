"""Evidence for the lecturer: answers that fit another student's data better than the own.

Both are told by how closely the answers agree with either key, all of them together: by as much as
one pencil explains, or to the very digits. Whoever else is in the class matters only by number.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import exp, log
from typing import Any

from graphkin.grading.likeness import FAR, Key, fit
from graphkin.grading.model import Answer, Graded, Suspicion
from graphkin.grading.numbers import NUMBER, rounding
from graphkin.grading.standard import Expectation
from graphkin.pencil.pencil import STRAIGHT

FEW = 3
"""Fewer fields tell nothing."""
STRONG = 1000.0
"""Odds from which a wrong variant is reported, after they are divided by the number of others."""
EXPLAINED = 1000.0
"""Odds of a slip from which an answer is its own, and no evidence but where digits agree."""
TRIED = 3
"""Variants that are looked at closely: those nearest to the answers, each answer by itself."""
MOST = 600.0
"""The largest logarithm of odds that is told."""


def wrong_variants(
    graded: Sequence[Graded], standards: Sequence[Expectation]
) -> tuple[Suspicion, ...]:
    """Students whose answers fit another's data: (student, owners), the fields, the odds.

    ``standards`` holds what each was marked against, in the same order; those who handed in
    nothing have data, too.
    """
    if not standards or len(numeric_fields(standards[0])) < FEW:
        return ()
    own, mine = distinct(standards)
    keys = Keys.of(own)
    theirs: dict[int, list[str]] = defaultdict(list)
    for each, standard in zip(graded, standards, strict=True):
        theirs[mine[id(standard)]].append(each.taker.student.id)
    found = []
    for each, standard in zip(graded, standards, strict=True):
        tells = each.present and len(own) > 1
        best = best_other(each, keys, mine[id(standard)]) if tells else None
        if best is not None:
            ids = (each.taker.student.id, *theirs[best.other])
            found.append(Suspicion(ids, best.fields, best.odds, best.of))
    return tuple(found)


def numeric_fields(standard: Expectation) -> list[str]:
    """The fields that are numbers, those left out that only follow from a segment beside them."""
    fields = standard.tolerance
    return [field for field in fields if f"{field}_mm" not in fields]


def distinct(standards: Sequence[Expectation]) -> tuple[list[Expectation], Mapping[int, int]]:
    """The standards without doubles, and the place of each among them."""
    places: dict[int, int] = {}
    own: list[Expectation] = []
    for each in standards:
        if id(each) not in places:
            places[id(each)] = len(own)
            own.append(each)
    return own, places


@dataclass(frozen=True)
class Keys:
    """The keys of all variants, a row for each: sizes, deviations of a drawing, and covariances."""

    fields: tuple[str, ...]
    places: Any
    sizes: Any
    deviations: Any
    standards: Sequence[Expectation]

    @classmethod
    def of(cls, standards: Sequence[Expectation]) -> Keys:
        """Those of some variants."""
        import numpy as np

        fields = tuple(numeric_fields(standards[0]))
        places = np.array([standards[0].item[f].what == "place" for f in fields])
        keys = np.array([[each.key[f] for f in fields] for each in standards])
        sizes = np.where(places, keys, abs(keys))
        allowed = [[each.tolerance[f] for f in fields] for each in standards]
        deviations = np.array([[np.hypot(t.pencil, t.ruler) for t in row] for row in allowed])
        return cls(fields, places, sizes, deviations / STRAIGHT, standards)

    def key(self, variant: int, read: Any) -> Key:
        """The key of a variant in the fields that are read, with the errors of pencil and ruler."""
        import numpy as np

        standard = self.standards[variant]
        names = list(standard.tolerance)
        order = [names.index(f) for f, is_read in zip(self.fields, read, strict=True) if is_read]
        rulers = np.array([standard.tolerance[names[i]].ruler for i in order]) / STRAIGHT
        spread = standard.spread[np.ix_(order, order)] + np.diag(rulers**2)
        return Key(self.sizes[variant][read], spread, self.places[read])


@dataclass(frozen=True)
class Best:
    """The other variant that some answers fit, in which fields of how many, and the odds."""

    other: int
    fields: tuple[str, ...]
    of: int
    odds: float


def best_other(graded: Graded, keys: Keys, mine: int) -> Best | None:
    """The other variant that a student's answers fit far better than the own; None for most."""
    import numpy as np

    answers, digits = read_of(graded, keys)
    slipped = np.array([graded.mark(f).odds >= EXPLAINED for f in keys.fields])
    near, found = nearest(answers, digits, keys, mine), None
    others = len(keys.sizes) - 1
    for other in near:
        agree = abs(answers - keys.sizes[other]) <= 1.01 * digits
        known = np.isfinite(keys.deviations[mine]) & np.isfinite(keys.deviations[other])
        read = ~np.isnan(answers) & known & (~slipped | agree)
        if read.sum() < FEW:
            continue
        theirs = fit(answers[read], digits[read], keys.key(other, read))
        own = fit(answers[read], digits[read], keys.key(mine, read))
        odds = exp(min(theirs.likelihood - own.likelihood - log(others), MOST))
        if odds >= STRONG and theirs.fits.sum() >= FEW and (found is None or odds > found.odds):
            names = [f for f, is_read in zip(keys.fields, read, strict=True) if is_read]
            fields = tuple(f for f, fits in zip(names, theirs.fits, strict=True) if fits)
            found = Best(int(other), fields, int((~np.isnan(answers)).sum()), odds)
    return found


def read_of(graded: Graded, keys: Keys) -> tuple[Any, Any]:
    """A student's answers as sizes, places with their sign, and how far each may be rounded."""
    import numpy as np

    given = [graded.mark(field).answer for field in keys.fields]
    values = np.array([float("nan") if a.value is None else a.value for a in given])
    digits = np.array([0.0 if a.value is None else coarseness(a) * abs(a.value) for a in given])
    return np.where(keys.places, values, abs(values)), digits


def coarseness(answer: Answer) -> float:
    """How far a number may be rounded, in parts of it; noughts at the end of a whole one may be no
    digits of it: 50 may be 48.
    """
    found = NUMBER.match(answer.text.strip())
    digits = found["digits"] if found is not None else ""
    zeros = len(digits) - len(digits.rstrip("0")) if digits.isdigit() else 0
    return float(rounding(answer) * 10**zeros)


def nearest(answers: Any, digits: Any, keys: Keys, mine: int) -> Any:
    """The few variants nearer to the answers than the own, each answer taken by itself."""
    import numpy as np

    with np.errstate(invalid="ignore", divide="ignore"):
        apart = (answers - keys.sizes) ** 2 / (keys.deviations**2 + digits**2 / 3)
    far = np.nansum(np.minimum(apart, FAR**2), axis=1)
    nearer = np.flatnonzero(far < far[mine])
    return [int(i) for i in nearer[np.argsort(far[nearer], kind="stable")[:TRIED]]]
