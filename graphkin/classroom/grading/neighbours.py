"""How far apart variants are: what right values of one variant earn on another's sheet.

A neighbour's values are the exact key, or a careful drawing with its scatter. Only answers right by
the key count. Follow-through and causes do not, since copied answers do not build on one another.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.class_marking import standards
from graphkin.classroom.grading.keys import Keys
from graphkin.classroom.grading.marking import is_one_drawing
from graphkin.classroom.grading.standard import Standard, sense_is_open
from graphkin.classroom.lab.fairness import Fault
from graphkin.classroom.lab.items import items, worth
from graphkin.classroom.lab.lab_model import Lab, exact_text
from graphkin.numbers.arithmetic import np

Array = Any
Asked = tuple[Mapping[str, Fraction], tuple[str, ...]]
"""The exact data of a variant, and its computed fields."""


class Neighbours(Struct, frozen=True):
    """The shares of all points that a neighbour's right values earn, a row for each sheet.

    ``exact`` is for the neighbour's key; ``drawn`` is the mean for the neighbour's careful drawing.
    Both are NaN for a sheet compared with itself. ``pencil`` is the largest pencil error on each
    sheet among fields that earn points, relative to the value.
    """

    exact: Array
    drawn: Array
    pencil: Array

    def closest(self) -> list[tuple[int, int]]:
        """The sheets on which a neighbour's key earns most, each with that neighbour.

        Where both keys of a pair earn so much, only the first sheet is listed.
        """
        rounded = np.round(self.exact, 9)
        most = np.argwhere(rounded == np.nanmax(rounded)).tolist()
        both = {(own, other) for own, other in most}
        return [(i, j) for i, j in most if i < j or (j, i) not in both]


def standards_of(lab: Lab, many: Sequence[Asked]) -> list[Standard]:
    """The standards of some variants; variants with the same data share one."""
    text = lab.scene.read_text(encoding="utf-8")
    every = [
        ({name: exact_text(value) for name, value in settings.items()}, computed)
        for settings, computed in many
    ]
    names = [(*settings.items(), computed) for settings, computed in every]
    different = dict(zip(names, every, strict=True))
    form = items(lab.mechanism, lab)
    found = standards(lab.mechanism, text, form, lab.rubric, list(different.values()))
    own = dict(zip(different, found, strict=True))
    return [own[name] for name in names]


def compared(found: Sequence[Standard]) -> Neighbours | None:
    """The shares that right values earn on other sheets, for variants that can be drawn.

    None for fewer than two variants, or where nothing earns points.
    """
    if len(found) < 2 or not any(found[0].rubric.points.values()):
        return None
    return neighbours(found)


class RightValues(Struct, frozen=True):
    """The right values of some variants, a row for each, and their shares of all points.

    A size is right within ``allowed``, or within ``most`` where all sizes together are one drawing
    by the ``keys``. ``senses`` are signs; those that no drawing determines are ``unclear``. A sense
    earns nothing without the size at its place of ``sized``, if that size has points.
    ``points`` and ``sense_points`` are shares of all points.
    """

    keys: Keys
    allowed: Array
    most: Array
    points: Array
    senses: Array
    unclear: Array
    sense_points: Array
    sized: tuple[int, ...]

    @classmethod
    def of(cls, found: Sequence[Standard]) -> RightValues:
        """The right values of some standards of one form."""
        keys = Keys.of([each.expectation for each in found])
        signed = {item.field: item.sized for item in found[0].items if item.what == "sense"}
        senses = list(signed)
        total = np.array([[sum(points_of(each, f) for f in each.key)] for each in found])

        def table(read: Callable[[Standard, str], Any], fields: Sequence[str]) -> Array:
            return np.array([[read(each, f) for f in fields] for each in found])

        return cls(
            keys,
            table(lambda each, f: each.tolerance[f].value, keys.fields),
            table(lambda each, f: each.tolerance[f].most, keys.fields),
            table(points_of, keys.fields) / total,
            table(lambda each, f: each.key[f], senses),
            table(sense_is_open, senses).astype(bool),
            table(points_of, senses) / total,
            tuple(keys.fields.index(size) for size in signed.values()),
        )

    def rows(self, which: Sequence[int]) -> RightValues:
        """The right values of some of the variants."""
        parts = ("allowed", "most", "points", "senses", "unclear", "sense_points")
        own = {name: getattr(self, name)[list(which)] for name in parts}
        return replace(self, keys=self.keys.rows(which), **own)

    def by_key(self, other: RightValues) -> Array:
        """The shares that exact values of others earn, a row for each sheet."""
        shares = self.earned(other, is_within)
        for i, points in enumerate(self.points):
            away, read = other.keys.sizes - self.keys.sizes[i], self.keys.known(i)
            more = (abs(away) <= self.most[i]) & (abs(away) > self.allowed[i])
            one = np.flatnonzero(more @ points > 0)
            key, rounded = self.keys.key(i, read), self.keys.reading(i)[read]
            one = one[is_one_drawing(away[one][:, read], rounded, key)]
            shares[i, one] += more[one] @ points
            senses = self.senses_right(other)[i, one] & more[one][:, self.sized]
            shares[i, one] += senses @ self.sense_points[i]
        return shares

    def earned(self, other: RightValues, chance: Callable[[Array, Array, Array], Array]) -> Array:
        """The shares that right values of others earn, a row for each sheet.

        ``chance`` maps differences of values, tolerances and deviations to the probability of being
        right.
        """
        shares = np.zeros((len(self.keys.sizes), len(other.keys.sizes)))
        sizes = []
        for k in range(self.keys.sizes.shape[1]):
            away = other.keys.sizes[None, :, k] - self.keys.sizes[:, None, k]
            sizes.append(chance(away, self.allowed[:, None, k], other.keys.deviations[None, :, k]))
            shares += self.points[:, None, k] * sizes[k]
        senses = self.senses_right(other)
        for k, size in enumerate(self.sized):
            with_size = np.where(self.points[:, None, size] > 0, sizes[size], 1.0)
            shares += self.sense_points[:, None, k] * senses[:, :, k] * with_size
        return shares

    def senses_right(self, other: RightValues) -> Array:
        """Whether each sense of others is right on each sheet: (sheets, others, senses)."""
        same = self.senses[:, None] == other.senses[None]
        right: Array = same | self.unclear[:, None]
        return right


def neighbours(found: Sequence[Standard]) -> Neighbours:
    """The shares that each variant's right values earn on every other sheet."""
    different, row_of = without_doubles(found)
    own = RightValues.of(different)
    rows = np.ix_(row_of, row_of)
    itself = np.eye(len(found), dtype=bool)
    shares = own.by_key(own), own.earned(own, comes_within)
    exact, drawn = (np.where(itself, np.nan, each[rows]) for each in shares)
    pencil = np.array([worst_drawn(each)[1] for each in different])
    return Neighbours(exact, drawn, pencil[row_of])


def without_doubles(found: Sequence[Standard]) -> tuple[list[Standard], list[int]]:
    """The distinct standards, and the index of each standard among them."""
    different = {id(each): each for each in found}
    places = {own: place for place, own in enumerate(different)}
    return list(different.values()), [places[id(each)] for each in found]


def worst_drawn(standard: Standard) -> tuple[str, float]:
    """The field that earns points with the largest pencil error, relative to its value.

    Places have no size, and zero values no relative error; computed fields are not drawn.
    """
    errors = {
        field: allowed.pencil / abs(standard.key[field])
        for field, allowed in standard.tolerance.items()
        if standard.by_field[field].item.what != "place" and points_of(standard, field)
        if standard.key[field] and field not in standard.computed
    }
    return max(errors.items(), key=lambda each: each[1], default=("", 0.0))


def unsure_fields(standard: Standard) -> tuple[str, ...]:
    """The fields that earn points and that hardly any drawing determines.

    Their error in a careful drawing exceeds the rubric's cap. Computed fields are not drawn.
    """
    return tuple(
        field
        for field, allowed in standard.tolerance.items()
        if allowed.unsure and points_of(standard, field) and field not in standard.computed
    )


def pencil_fault(lab: Lab, standard: Standard) -> Fault | None:
    """The fault where a variant exceeds the limit of the pencil's error.

    None where the variant keeps the limit, or where the lab has none.
    """
    field, error = worst_drawn(standard)
    limit = lab.fair.pencil
    return Fault("pencil", field, error, limit) if limit is not None and error > limit else None


def pencil_faults(lab: Lab, many: Sequence[Asked]) -> list[Fault | None]:
    """The pencil fault of each of some variants that can be drawn."""
    found = standards_of(lab, many) if many else []
    return [pencil_fault(lab, standard) for standard in found]


def is_within(away: Array, limit: Array, spread: Array) -> Array:
    """Whether an exact value lies within a limit."""
    return abs(away) <= limit


def points_of(standard: Standard, field: str) -> float:
    """The points of a field on a sheet."""
    item = standard.by_field[field].item
    return float(worth(item, standard.rubric.points, standard.computed) or 0)


def comes_within(away: Array, limit: Array, spread: Array) -> Array:
    """The probability that a value with normal errors lies within a limit.

    ``away`` is the distance of its mean, ``spread`` its deviation.
    """
    import math

    normal = np.vectorize(lambda x: 0.5 * (1.0 + math.erf(x / math.sqrt(2.0))), otypes=[float])
    wide = np.maximum(np.broadcast_to(np.nan_to_num(spread, posinf=0.0), away.shape), 1e-300)
    with np.errstate(all="ignore"):
        ends = [np.clip(np.nan_to_num((side - away) / wide), -9, 9) for side in (limit, -limit)]
    found = np.zeros(away.shape)
    open_ones = ends[0] != ends[1]  # equal ends enclose nothing
    found[open_ones] = normal(ends[0][open_ones]) - normal(ends[1][open_ones])
    return found
