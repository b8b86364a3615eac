"""Which slips explain a student's wrong answers better than chance does.

Most wrong answers lie near the right one, some far off: in logarithms they are spread as Cauchy's
curve, half of them within a factor of two. An answer that a slip's value hits within its tolerance
is so much likelier by the slip as its tolerance is narrow beside that. The odds of a slip are its
share among mistakes, times this for each answer that it hits, less for each wrong or right answer
that it should have changed otherwise. Places are spread likewise, in millimetres.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import exp, inf, log, pi, sqrt

from graphkin.grading.follow import ROUNDED, drawing_error
from graphkin.grading.model import Answer
from graphkin.grading.slips import NAMES, Slip
from graphkin.grading.standard import Standard
from graphkin.pencil.pencil import STRAIGHT

HALF = log(2.0)
"""Half of all wrong answers lie within this of the right one, in natural logarithms."""
ASTRAY = 10.0
"""Half of all wrong places lie within so many mm of the right one, along either axis."""
SHARE = 1 / 20
"""The share of each slip among mistakes."""
MISSED = 0.4
"""How much a wrong answer speaks against a slip of the construction that does not hit it."""
UNTOUCHED = 0.15
"""How much a right answer does that it should have made wrong."""
RECKONED = 2 * ROUNDED
"""Share by which what was reckoned from an own segment may be off."""
LIKELY = 1.5
"""Odds from which a slip is named."""
SENSE = 6.0
"""How much likelier a reversed sense is where a slip reverses it: else it seldom is wrong."""


@dataclass(frozen=True, slots=True)
class Found:
    """A slip that explains some fields, and its odds against chance."""

    slip: Slip
    fields: tuple[str, ...]
    odds: float


def diagnosed(
    standard: Standard,
    every: tuple[Slip, ...],
    answers: Mapping[str, Answer],
    wrong: tuple[str, ...],
    right: tuple[str, ...],
) -> dict[str, Found]:
    """For each wrong field the likeliest slip that explains it, if one does better than chance."""
    best: dict[str, Found] = {}
    for slip in every:
        found = judged(standard, slip, answers, wrong, right)
        for field in found.fields if found.odds >= LIKELY else ():
            if field not in best or rank(found) > rank(best[field]):
                best[field] = found
    return best


def rank(found: Found) -> tuple[float, int]:
    """The likelier first, then in the order of names."""
    return found.odds, -NAMES.index(found.slip.name)


def judged(
    standard: Standard,
    slip: Slip,
    answers: Mapping[str, Answer],
    wrong: tuple[str, ...],
    right: tuple[str, ...],
) -> Found:
    """What a slip explains, and how well."""
    hit: list[str] = []
    odds = SHARE
    if slip.name == "sense_reversed":
        fields = tuple(field for field in wrong if field in slip.values)
        return Found(slip, fields, LIKELY if fields else 0.0)
    for field in wrong:
        if field not in slip.values:
            continue
        ratio = likelihood(standard, slip, field, answers)
        if ratio > 0:
            hit.append(field)
            odds *= ratio
        elif slip.whole:
            odds *= MISSED
    if not hit:
        return Found(slip, (), 0.0)
    if slip.whole:
        odds *= UNTOUCHED ** sum(field in slip.values for field in right)
    return Found(slip, tuple(hit), min(odds, inf))


def likelihood(standard: Standard, slip: Slip, field: str, answers: Mapping[str, Answer]) -> float:
    """How much likelier an answer is by a slip than by chance; nought where it is not hit."""
    told, answer = slip.values[field], float(answers[field].value or 0.0)
    item = standard.by_field[field].item
    if item.what == "sense":
        return SENSE if answer == told else 0.0
    allowed = slip_error(standard, slip, field, told)
    if item.what == "place":
        astray = (told - standard.key[field]) / ASTRAY
        scattered = 1 / (pi * ASTRAY * (1 + astray * astray))
        return hit_density(answer - told, allowed) / scattered
    size = abs(told)
    own = 1.0 if slip.whole else own_length(standard, field, answers)
    if own != 1.0:
        size, allowed = size * own, RECKONED * size * own
    off = abs(abs(answer) - size)
    if size <= allowed:
        return 0.0
    return hit_density(off, allowed) * size / by_chance(size, abs(standard.key[field]))


def hit_density(off: float, allowed: float) -> float:
    """How densely answers lie that are meant to hit a value; nought beyond what is allowed."""
    if abs(off) > allowed:
        return 0.0
    deviation = allowed / STRAIGHT
    return exp(-((off / deviation) ** 2) / 2) / (deviation * sqrt(2 * pi))


def own_length(standard: Standard, field: str, answers: Mapping[str, Answer]) -> float:
    """How many times as long as ours the own segment is, from which a vector was reckoned."""
    segment = answers.get(f"{field}_mm")
    if segment is None or not segment.value:
        return 1.0
    return abs(segment.value) / standard.key[f"{field}_mm"]


def by_chance(size: float, right: float) -> float:
    """How densely wrong answers lie at a size, in parts of it."""
    apart = log(size / right) / HALF if right and size else 0.0
    return 1 / (pi * HALF * (1 + apart * apart))


def slip_error(standard: Standard, slip: Slip, field: str, told: float) -> float:
    """How far an answer may lie from what a slip tells."""
    item, right = standard.by_field[field].item, abs(standard.key[field])
    if slip.whole and item.unit == "mm":
        return drawing_error(standard, field, told)
    if item.what == "place":
        return standard.tolerance[field].value
    part = standard.tolerance[field].value / right if right else ROUNDED
    return abs(told) * min(part, standard.rubric.cap)
