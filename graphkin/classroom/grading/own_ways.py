"""The ways in which a student comes to answers by the own data.

Rightly; with scales of one's own; with a slip; or from own earlier values. What goes wrong goes
wrong in many answers at once, so these are no mistakes of one answer each.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import log
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.follow_through import SPAN
from graphkin.classroom.grading.graded import Graded, Status
from graphkin.classroom.grading.keys import Keys
from graphkin.classroom.grading.likelihood import Key
from graphkin.classroom.grading.slip_diagnosis import SHARE, share
from graphkin.classroom.grading.slips import UNITS_TAKEN, Slip
from graphkin.numbers.arrays import np

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
