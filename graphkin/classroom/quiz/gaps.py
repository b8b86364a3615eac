"""The gaps of a question: what each field of a form takes for right, and what slips would give."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import isnan

from msgspec import Struct

from graphkin.classroom.grading.feedback_rows import SENSES, SLIPS
from graphkin.classroom.grading.marking import Marker, sense_is_open
from graphkin.classroom.grading.slip_diagnosis import slip_error
from graphkin.classroom.grading.slips import differs
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.quantities import TURNING
from graphkin.drawing.richtext import plain
from graphkin.text import Words

WHOLE = Fraction(1)


class Taken(Struct, frozen=True):
    """What a gap takes, of several the first that fits: an answer, as text or as a number with how
    far it may be off, the share of the points that it earns, and what is said of it.
    """

    answer: str | float
    allowed: float
    share: Fraction
    told: str


class Gap(Struct, frozen=True):
    """One field of a question: its points, and what it takes, the right answer first."""

    item: Item
    points: Fraction
    takes: tuple[Taken, ...]


def gaps(marker: Marker, points: Mapping[str, Fraction], words: Words) -> tuple[Gap, ...]:
    """The gaps of a variant: its fields that earn points and that have a value.

    A slip earns its share at the first field that it explains, and at all others what follows
    from an own value where that is more, as in marking; what it gives is looked for only where it
    is not right by the key.
    """
    paid: set[str] = set()
    found = []
    for item in marker.standard.items:
        worth = points.get(item.field)
        if worth and not isnan(marker.standard.key[item.field]):
            takes = sensed(marker, item, words) if item.what == "sense" else ()
            takes = takes or (*keyed(marker, item, words), *slipped(marker, item, paid, words))
            found.append(Gap(item, worth, tuple(takes)))
    return tuple(found)


def keyed(marker: Marker, item: Item, words: Words) -> Iterator[Taken]:
    """The right value; of a rate its negative, too, whose sense has a gap of its own."""
    standard = marker.standard
    right, allowed = standard.key[item.field], standard.tolerance[item.field].value
    told = words("feedback.right")
    size = item.size(right)
    yield Taken(size, allowed, WHOLE, told)
    if item.beside("sense") in standard.key and size:
        yield Taken(-size, allowed, WHOLE, told)


def sensed(marker: Marker, item: Item, words: Words) -> tuple[Taken, ...]:
    """Both senses; where no drawing tells it, each is right."""
    standard, turning = marker.standard, item.quantity in TURNING
    is_open = sense_is_open(standard, item.field)
    right, wrong = words("feedback.right"), plain(words("feedback.wrong_sense"))
    found = []
    for positive in (True, False):
        good = is_open or (standard.key[item.field] > 0) == positive
        share, told = (WHOLE, right) if good else (Fraction(), wrong)
        found.append(Taken(words(SENSES[turning, positive]), 0.0, share, told))
    return tuple(found)


def slipped(marker: Marker, item: Item, paid: set[str], words: Words) -> Iterator[Taken]:
    """What slips make of a value, those with a share first, of two that make the same the first.

    ``paid`` gathers those that have earned their share.
    """
    standard, field = marker.standard, item.field
    rubric, seen = standard.rubric, list[tuple[float, float]]()
    for slip in sorted(marker.slips, key=lambda slip: slip.name not in rubric.slips):
        value = slip.values.get(field)
        if value is None or not differs(standard, field, value):
            continue
        size, allowed = item.size(value), slip_error(standard, slip, field, value)
        is_nought = item.what != "place" and size <= allowed
        if is_nought or any(abs(size - other) <= near for other, near in seen):
            continue
        seen.append((size, allowed))
        share = rubric.slips.get(slip.name, 0.0)
        if share and slip.name in paid:
            share = max(share, rubric.follow)
        told = plain(words("feedback.guess", slip=words(SLIPS[slip.name])))
        yield Taken(size, allowed, Fraction(str(share)), told)
    paid.update(slip.name for slip in marker.slips if field in slip.values)
