"""The keys of a class's variants side by side, and answers to compare with them.

The covariance of a variant's answers comes from the pencil in its construction, and from the ruler.
A value with a segment of its own is computed from the same reading, so both errors are correlated.
Errors in setting cranks are kept apart from the pencil's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import SCALES, STRAIGHT
from graphkin.classroom.grading.answer_numbers import NUMBER, rounding
from graphkin.classroom.grading.graded import Answer, Graded
from graphkin.classroom.grading.likelihood import Key
from graphkin.classroom.grading.standard import Expectation
from graphkin.classroom.lab.items import motion_of
from graphkin.numbers.arithmetic import np

COMPUTED = 0.005
"""The relative error of a value computed from a length as it was read."""

ALIKE = 0.1
"""The largest difference of a value that no drawing tells, in deviations."""


class Keys(Struct, frozen=True, dict=True):
    """The keys of all variants, a row for each: sizes, deviations of a drawing, covariances.

    ``rulers`` are the deviations of a reading. ``beside`` is the index of each field's segment, or
    of the field itself. ``plans`` says by which plan's scale a value is computed: 1 for velocities,
    2 for accelerations, 3 for forces, 0 for what is measured.
    """

    fields: tuple[str, ...]
    plans: Any
    places: Any
    beside: Any
    sizes: Any
    deviations: Any
    rulers: Any
    standards: Sequence[Expectation]

    @classmethod
    def of(cls, standards: Sequence[Expectation]) -> Keys:
        """The keys of some variants."""
        fields = tuple(standards[0].tolerance)
        places = np.array([standards[0].item[f].what == "place" for f in fields])
        at = {field: place for place, field in enumerate(fields)}
        beside = np.array([at.get(standards[0].item[f].segment, place) for f, place in at.items()])
        items = [standards[0].item[f] for f in fields]
        plans = np.array([0 if i.unit == "mm" else SCALES.index(motion_of(i).plane) for i in items])
        keys = np.array([[each.key[f] for f in fields] for each in standards])
        allowed = [[each.tolerance[f] for f in fields] for each in standards]
        deviations = np.array([[np.hypot(t.pencil, t.ruler) for t in row] for row in allowed])
        rulers = np.array([[t.ruler for t in row] for row in allowed])
        sizes = np.where(places, keys, abs(keys))
        deviations, rulers = deviations / STRAIGHT, rulers / STRAIGHT
        return cls(fields, plans, places, beside, sizes, deviations, rulers, standards)

    def rows(self, which: Sequence[int]) -> Keys:
        """The keys of some of the variants."""
        rows = list(which)
        return replace(
            self,
            sizes=self.sizes[rows],
            deviations=self.deviations[rows],
            rulers=self.rulers[rows],
            standards=[self.standards[i] for i in rows],
        )

    def key(self, variant: int, read: Any) -> Key:
        """The key of a variant in the fields that are read, with the errors of pencil and ruler."""
        standard, rulers = self.standards[variant], self.rulers[variant][read]
        beside, sizes = self.beside[read], self.sizes[variant][read]
        shared = np.where(beside[:, None] == beside, np.outer(rulers, rulers), 0.0)
        spread = standard.spread[np.ix_(read, read)] + shared
        computed = np.where(beside != np.flatnonzero(read), COMPUTED * sizes, 0.0)
        return Key(sizes, spread, computed, standard.cranks[:, read], self.places[read])

    def reading(self, variant: int, *, whole: bool = False) -> Any:
        """The rounding allowed to readings, in the fields' units.

        Lengths are rounded to half a millimetre, the finest that a ruler shows, or to ``whole``
        ones. A length from which a value is computed is rounded to a whole one.
        """
        coarse = 2.0 if whole else 1.0
        return self.rulers[variant] * STRAIGHT * np.where(self.lengths, coarse, 2.0)

    @cached_property
    def lengths(self) -> Any:
        """The fields that are measured with a ruler."""
        items = self.standards[0].item
        return np.array([items[f].what in ("segment", "place") for f in self.fields])

    def tells(self, one: int, other: int, read: Any) -> bool:
        """Whether a fine drawing tells two variants apart by some fields."""
        apart = abs(self.sizes[one] - self.sizes[other])[read]
        return bool((apart > ALIKE * self.deviations[one][read]).any())

    def away(self, answers: Any, most: float) -> Any:
        """How far each variant is from some answers: the sum of squares, in deviations.

        No answer counts for more than ``most`` deviations.
        """
        found = np.zeros(len(self.sizes), dtype=np.float32)
        for place in np.flatnonzero(~np.isnan(answers)).tolist():
            sizes, weights = self.by_field[0][place], self.by_field[1][place]
            apart = np.float32(answers[place]) - sizes
            apart *= weights
            apart *= apart
            found += np.minimum(apart, np.float32(most**2), out=apart)
        return found

    @cached_property
    def by_field(self) -> tuple[Any, Any]:
        """The sizes and the inverse deviations, a row for each field; zero where unknown."""
        with np.errstate(all="ignore"):
            weights = np.nan_to_num(1 / self.deviations, posinf=0.0)
        sizes = np.nan_to_num(self.sizes, posinf=0.0, neginf=0.0)
        weights = np.where(np.isfinite(self.sizes), weights, 0.0)
        one, other = (np.ascontiguousarray(each.T, np.float32) for each in (sizes, weights))
        return one, other

    def known(self, variant: int) -> Any:
        """The fields whose error in a drawing of a variant is known."""
        return np.isfinite(self.deviations[variant]) & np.isfinite(self.sizes[variant])


def distinct(standards: Sequence[Expectation]) -> tuple[list[Expectation], Mapping[int, int]]:
    """The standards without duplicates, and the index of each among them."""
    places: dict[int, int] = {}
    own: list[Expectation] = []
    for each in standards:
        if id(each) not in places:
            places[id(each)] = len(own)
            own.append(each)
    return own, places


def read_of(graded: Graded, keys: Keys) -> tuple[Any, Any]:
    """A student's answers as sizes, and the rounding error of each; places keep their sign."""
    marks = {mark.item.field: mark for mark in graded.marks}
    given = [marks[field].answer for field in keys.fields]
    values = np.array([float("nan") if a.value is None else a.value for a in given])
    digits = np.array([0.0 if a.value is None else coarseness(a) * abs(a.value) for a in given])
    return np.where(keys.places, values, abs(values)), digits


def coarseness(answer: Answer) -> float:
    """The relative rounding error of a number.

    Trailing zeros of a whole number may not be significant: 50 may be 48.
    """
    found = NUMBER.match(answer.text.strip())
    digits = found["digits"] if found is not None else ""
    zeros = len(digits) - len(digits.rstrip("0")) if digits.isdigit() else 0
    return float(rounding(answer) * 10**zeros)
