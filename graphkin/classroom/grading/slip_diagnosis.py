"""Which slips explain a student's wrong answers better than chance does.

Most wrong answers lie near the right one, some far off: in logarithms they are spread as Cauchy's
curve, half of them within a factor of two. An answer that a slip's value hits within its tolerance
is so much likelier by the slip as its tolerance is narrow beside that; what is reckoned from an own
segment is held against that segment. The odds of a slip are its share among mistakes, times this
for each answer that it hits, less for each wrong or right answer that it should have changed
otherwise. The more wrong answers no slip explains, the likelier a single hit is chance: so much
better it must be to be named. Places are spread likewise, in millimetres.
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
"""Half of all wrong places lie within so many mm of the right one, along either axis."""
SHARE = 1 / 20
"""The share of each slip among mistakes."""
RARER = {"power_of_ten": 1 / 3, "wrong_scale": 1 / 2}
"""Slips that can be made in several ways: the part of a share that each way has."""
PARTLY = 1 / 2
"""The same for a unit that is taken wrong in some fields only."""
MISSED = 0.4
"""How much a wrong answer speaks against a slip of the construction that does not hit it."""
UNTOUCHED = 0.15
"""How much a right answer does that it should have made wrong."""
RECKONED = 2 * ROUNDED
"""Share by which what was reckoned from an own segment may be off."""
WIDEST = 0.9
"""No slip is told more roughly than this, in parts of what it tells."""
ELSEWISE = 0.3
"""How often a value is reckoned from something else than the segment that was handed in."""
LIKELY = 1.5
"""Odds from which a slip is named where nothing else is wrong."""
SENSE = 6.0
"""How much likelier a reversed sense is where a slip reverses it: else it seldom is wrong."""

AGAINST = 0.1
"""How likely a sense is that is contrary to what a slip tells."""
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
    """For each wrong field the likeliest slip that explains it, if one does better than chance.

    ``sources`` are the own values from which wrong fields are computed.
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
    """What is left of the slips when those go whose hits chance explains as well."""
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
    """The likelier first, then in the order of names."""
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
    """What a slip explains, and how well; what is computed from that, or from what is ``given``
    as explained, is no further evidence.
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
    """Whether the sense of a rate was stated contrary to what a slip leaves of it, or makes."""
    sense = standard.by_field[field].item.beside("sense")
    stated = answers[sense].value if sense in answers else None
    return bool(stated) and stated == -slip.values.get(sense, standard.key[sense])


def hit_ratio(answer: float, size: float, allowed: float, right: float) -> float:
    """How much denser answers lie at one that is meant to be a size than by chance."""
    if size <= allowed:
        return 0.0
    return hit_density(answer - size, allowed) * size / by_chance(size, right)


def hit_density(off: float, allowed: float) -> float:
    """How densely answers lie that are meant to hit a value; nought beyond what is allowed."""
    if abs(off) > allowed:
        return 0.0
    deviation = allowed / STRAIGHT
    return exp(-((off / deviation) ** 2) / 2) / (deviation * sqrt(2 * pi))


def own_length(standard: Standard, field: str, answers: Mapping[str, Answer]) -> float:
    """How many times as long as ours the own segment is from which a vector was reckoned; nought
    where none was handed in.
    """
    name = standard.by_field[field].item.segment
    segment = answers.get(name)
    if segment is None or not segment.value:
        return 0.0
    return abs(segment.value) / abs(standard.key[name])


def told_length(standard: Standard, slip: Slip, field: str) -> float:
    """How many times as long as ours a segment is by a slip of the construction."""
    name = standard.by_field[field].item.segment
    if not slip.whole or not slip.values.get(name):
        return 1.0
    return abs(slip.values[name]) / abs(standard.key[name])


def by_chance(size: float, right: float) -> float:
    """How densely wrong answers lie at a size, in parts of it."""
    apart = log(size / right) / HALF if right and size else 0.0
    return 1 / (pi * HALF * (1 + apart * apart))


def slip_error(standard: Standard, slip: Slip, field: str, told: float) -> float:
    """How far an answer may lie from what a slip tells."""
    item, right = standard.by_field[field].item, abs(standard.key[field])
    drawn = drawing_error(standard, field, told) if slip.whole else 0.0
    if item.unit == "mm" and slip.whole:
        return drawn
    if item.what == "place":
        return standard.tolerance[field].value
    part = standard.tolerance[field].value / right if right else ROUNDED
    return max(drawn, abs(told) * min(part, WIDEST))


# --- a scale of one's own -----------------------------------------------------------------------


def own_scales(
    standard: Standard,
    answers: Mapping[str, Answer],
    wrong: tuple[str, ...],
    right: tuple[str, ...],
    sources: Sources,
) -> Iterator[Found]:
    """Scales that nobody foresaw: several values off by the same factor, accelerations perhaps by
    its square. A value beside its own segment, which is right, gives the factor and speaks for
    nothing; others must hit.
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
    """Whether a field is a value that may have been read with a wrong scale off a right segment."""
    segment = standard.by_field[field].item.segment
    drawn = segment not in standard.key or segment in right
    return standard.by_field[field].item.what == "value" and drawn and standard.key[field] != 0


def factor_of(standard: Standard, field: str, answers: Mapping[str, Answer]) -> float:
    """How many times too large a value is beside the own segment; nought where it just follows from
    that, or none was handed in.
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
    """A value as many times too large; that of an acceleration by a power of the factor."""
    return abs(standard.key[field]) * factor ** (1 if is_velocity(standard, field) else power)
