"""Finds the slips that explain a student's wrong answers better than chance does.

Most wrong answers lie near the right one, some far off. Their logarithms follow a Cauchy
distribution, with half of them within a factor of two. Places are distributed likewise, in
millimetres.

The narrower the tolerance around a slip's value, the more an answer within it speaks for the
slip. A value computed from the student's segment is compared with that segment.

The odds of a slip are its share among mistakes, times a ratio for each answer that it hits: how
much likelier the slip makes the answer than chance does. The odds drop for each wrong or right
answer that the slip should have changed otherwise. The more wrong answers no slip explains, the
likelier a single hit is chance, and the better it must be to be named.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import exp, inf, log, pi, sqrt

from msgspec import Struct

from graphkin.accuracy.pencil.pencil import STRAIGHT
from graphkin.classroom.grading.answer_numbers import rounding
from graphkin.classroom.grading.follow_through import drawing_error
from graphkin.classroom.grading.form_relations import ROUNDED
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.slips import UNITS_TAKEN, Slip
from graphkin.classroom.grading.standard import Standard
from graphkin.classroom.lab.slip_names import NAMES
from graphkin.construction.core.program import Plane

HALF = log(2.0)
"""Half of all wrong answers lie within this of the right one, in natural logarithms."""
ASTRAY = 10.0
"""Half of all wrong places lie within this many mm of the right one, along either axis."""
SHARE = 1 / 20
"""The share of each slip among mistakes."""
RARER = {"power_of_ten": 1 / 3, "wrong_scale": 1 / 2}
"""The part of a share for each way of making a slip that can be made in several ways."""
PARTLY = 1 / 2
"""The part of a share for a wrong unit in some fields only."""
MISSED = 0.4
"""The factor on the odds for a wrong answer that a slip of the construction does not hit."""
UNTOUCHED = 0.15
"""The factor on the odds for a right answer that the slip should have made wrong."""
RECKONED = 2 * ROUNDED
"""The relative tolerance of a value computed from the student's segment."""
WIDEST = 0.9
"""The largest relative tolerance of a slip's value."""
ELSEWISE = 0.3
"""How often a value is computed from something else than the segment handed in."""
LIKELY = 1.5
"""The least odds at which a slip is named where nothing else is wrong."""
SENSE = 6.0
"""How much likelier a reversed sense is by a slip that reverses it.

Otherwise a sense is seldom wrong.
"""

AGAINST = 0.1
"""How likely a sense is that contradicts the slip."""
Sources = Mapping[str, tuple[str, ...]]
NOTHING: Sources = {}


class Found(Struct, frozen=True):
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
    sources: Sources = NOTHING,
) -> dict[str, Found]:
    """For each wrong field the likeliest slip that explains it, where one is better than chance.

    ``sources`` are the student's values from which wrong fields are computed.
    """
    tried = [judged(standard, slip, answers, wrong, right, sources) for slip in every]
    tried += own_scales(standard, answers, wrong, right, sources)
    best: dict[str, Found] = {}
    for found in tried:
        for field in found.fields if found.odds >= LIKELY else ():
            if field not in best or rank(found) > rank(best[field]):
                best[field] = found
    return without_chance(standard, best, wrong)


def without_chance(
    standard: Standard, best: Mapping[str, Found], wrong: tuple[str, ...]
) -> dict[str, Found]:
    """The slips whose hits chance does not explain as well."""
    numbers = [field for field in wrong if standard.by_field[field].item.what != "sense"]
    kept = dict(best)
    while True:
        lost = sum(field not in kept for field in numbers)
        weak = [
            field
            for field, found in kept.items()
            if found.odds < LIKELY * (1 + lost) and found.slip.name != "sense_reversed"
        ]
        if not weak:
            return kept
        kept = {field: found for field, found in kept.items() if field not in weak}


def rank(found: Found) -> tuple[float, int]:
    """A sort key: by odds, then by the order of names."""
    return found.odds, -NAMES.index(found.slip.name)


def judged(
    standard: Standard,
    slip: Slip,
    answers: Mapping[str, Answer],
    wrong: tuple[str, ...],
    right: tuple[str, ...],
    sources: Sources = NOTHING,
    given: tuple[str, ...] = (),
) -> Found:
    """The fields that a slip explains, and its odds.

    A field computed from these, or from a field in ``given``, is no further evidence.
    """
    if slip.name == "sense_reversed":
        fields = tuple(field for field in wrong if field in slip.values)
        return Found(slip, fields, LIKELY if fields else 0.0)
    told = [field for field in wrong if field in slip.values]
    ratios = {field: likelihood(standard, slip, field, answers) for field in told}
    hit = tuple(field for field, ratio in ratios.items() if ratio > 0)
    if not hit:
        return Found(slip, (), 0.0)
    odds, explained = share(slip), {*hit, *given}
    for field in hit:
        odds *= 1.0 if explained.intersection(sources.get(field, ())) else ratios[field]
    if slip.whole:
        odds *= MISSED ** (len(told) - len(hit))
        untouched = (f for f in right if f in slip.values)
        odds *= UNTOUCHED ** sum(not likelihood(standard, slip, f, answers) for f in untouched)
    return Found(slip, hit, min(odds, inf))


def share(slip: Slip) -> float:
    """How often a slip is made, among mistakes."""
    if slip.name in UNITS_TAKEN and not slip.whole:
        return SHARE * PARTLY
    return SHARE * RARER.get(slip.name, 1.0)


def likelihood(standard: Standard, slip: Slip, field: str, answers: Mapping[str, Answer]) -> float:
    """How much likelier an answer is by a slip than by chance; zero where the slip misses it."""
    told, answer = slip.values[field], float(answers[field].value or 0.0)
    item = standard.by_field[field].item
    if item.what == "sense":
        return SENSE if answer == told else 0.0
    allowed = slip_error(standard, slip, field, told)
    if item.what == "place":
        astray = (told - standard.key[field]) / ASTRAY
        scattered = 1 / (pi * ASTRAY * (1 + astray * astray))
        return hit_density(answer - told, allowed) / scattered
    size, right = abs(told), abs(standard.key[field])
    drawn = hit_ratio(abs(answer), size, allowed, right)
    if is_against(standard, slip, field, answers):
        drawn *= AGAINST
    own = own_length(standard, field, answers)
    if not own:
        return drawn
    near = RECKONED + rounding(answers[field])
    if abs(abs(answer) - own * right) <= near * own * right:
        return float(drawn > 0)
    size *= own / told_length(standard, slip, field)
    return max(hit_ratio(abs(answer), size, near * size, right), ELSEWISE * drawn)


def is_against(standard: Standard, slip: Slip, field: str, answers: Mapping[str, Answer]) -> bool:
    """Whether the stated sense of a rate contradicts the sense that a slip gives or keeps."""
    sense = standard.by_field[field].item.beside("sense")
    stated = answers[sense].value if sense in answers else None
    return bool(stated) and stated == -slip.values.get(sense, standard.key[sense])


def hit_ratio(answer: float, size: float, allowed: float, right: float) -> float:
    """The density of answers aimed at ``size``, over their density by chance."""
    if size <= allowed:
        return 0.0
    return hit_density(answer - size, allowed) * size / by_chance(size, right)


def hit_density(off: float, allowed: float) -> float:
    """The density of answers aimed at a value; zero beyond the tolerance."""
    if abs(off) > allowed:
        return 0.0
    deviation = allowed / STRAIGHT
    return exp(-((off / deviation) ** 2) / 2) / (deviation * sqrt(2 * pi))


def own_length(standard: Standard, field: str, answers: Mapping[str, Answer]) -> float:
    """The student's segment from which a vector was computed, over the right segment.

    Zero where no segment was handed in.
    """
    name = standard.by_field[field].item.segment
    segment = answers.get(name)
    if segment is None or not segment.value:
        return 0.0
    return abs(segment.value) / abs(standard.key[name])


def told_length(standard: Standard, slip: Slip, field: str) -> float:
    """The segment by a slip of the construction, over the right segment."""
    name = standard.by_field[field].item.segment
    if not slip.whole or not slip.values.get(name):
        return 1.0
    return abs(slip.values[name]) / abs(standard.key[name])


def by_chance(size: float, right: float) -> float:
    """The density of wrong answers at a size, relative to the size."""
    apart = log(size / right) / HALF if right and size else 0.0
    return 1 / (pi * HALF * (1 + apart * apart))


def slip_error(standard: Standard, slip: Slip, field: str, told: float) -> float:
    """The tolerance of an answer around the value of a slip."""
    item, right = standard.by_field[field].item, abs(standard.key[field])
    drawn = drawing_error(standard, field, told) if slip.whole else 0.0
    if item.unit == "mm" and slip.whole:
        return drawn
    if item.what == "place":
        return standard.tolerance[field].value
    part = standard.tolerance[field].value / right if right else ROUNDED
    return max(drawn, abs(told) * min(part, WIDEST))


# --- an unlisted scale --------------------------------------------------------------------------


def own_scales(
    standard: Standard,
    answers: Mapping[str, Answer],
    wrong: tuple[str, ...],
    right: tuple[str, ...],
    sources: Sources,
) -> Iterator[Found]:
    """Slips of a scale that is on no list: several values off by one factor.

    Accelerations may be off by its square. A value with a right segment sets the factor and is no
    evidence; the other values must agree.
    """
    values = [field for field in wrong if is_scaled(standard, field, right)]
    roots = [field for field in values if not set(values).intersection(sources.get(field, ()))]
    for first in roots if len(values) > 1 else ():
        factor = factor_of(standard, first, answers)
        if not factor:
            continue
        others = tuple(field for field in values if field != first)
        for power in (1, 2) if is_velocity(standard, first) else (1,):
            told = {f: scaled_by(standard, f, factor, power) for f in values}
            slip = Slip("wrong_scale", False, told)
            found = judged(standard, slip, answers, others, (), sources, (first,))
            if found.fields:
                yield Found(found.slip, (first, *found.fields), found.odds)


def is_scaled(standard: Standard, field: str, right: tuple[str, ...]) -> bool:
    """Whether a field is a value that may be read with a wrong scale off a right segment."""
    segment = standard.by_field[field].item.segment
    drawn = segment not in standard.key or segment in right
    return standard.by_field[field].item.what == "value" and drawn and standard.key[field] != 0


def factor_of(standard: Standard, field: str, answers: Mapping[str, Answer]) -> float:
    """The factor by which a value is too large for the student's segment.

    Zero where the value follows from the segment, or where no segment was handed in.
    """
    own = own_length(standard, field, answers)
    if not own:
        return 0.0
    factor = abs(float(answers[field].value or 0.0)) / (own * abs(standard.key[field]))
    return 0.0 if abs(factor - 1) <= RECKONED + rounding(answers[field]) else factor


def is_velocity(standard: Standard, field: str) -> bool:
    """Whether a value is read off the velocity plan."""
    return standard.by_field[field].plane is Plane.VELOCITIES


def scaled_by(standard: Standard, field: str, factor: float, power: int) -> float:
    """A right value times a factor; for an acceleration, times a power of the factor."""
    return abs(standard.key[field]) * factor ** (1 if is_velocity(standard, field) else power)
