"""The keys of a class's variants side by side, and how likely answers are by each of them.

The covariance of a variant's answers comes from the pencil in its construction, and from the ruler.
A value with a segment of its own is computed from the same reading, so both errors are correlated.
Errors in setting cranks are kept apart from the pencil's: a badly set crank moves every answer.

The coarseness of a student's pencil is unknown: several are taken as equally likely. An answer that
no drawing of the given data gives is a mistake, of any size.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from math import exp, log, pi
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import SCALES, STRAIGHT
from graphkin.classroom.grading.answer_numbers import NUMBER, rounding
from graphkin.classroom.grading.graded import SURE, Answer, Graded
from graphkin.classroom.grading.standard import Expectation
from graphkin.classroom.lab.items import motion_of
from graphkin.numbers.arithmetic import np

HALF = log(2.0)
"""Half of all mistakes lie within this of the right value, in natural logarithms."""
ASTRAY = 10.0
"""Half of all wrong places lie within this many mm of the right one, along either axis."""
MISTAKES = 0.1
"""The share of answers that are mistakes."""
FAR = 5.0
"""The number of deviations from the key at which an answer alone counts as a mistake."""
PENCILS = tuple(0.1 * 2.0**i for i in range(8))
"""The coarseness of pencils, relative to the one that is forgiven."""
SURELY = 1e-24
"""The least variance of an answer, however it is drawn and read."""
LAID_OFF = 5.0
"""The deviation, in degrees, of badly set cranks."""


class Key(Struct, frozen=True):
    """Right answers as sizes, and the errors of drawings of them; places keep their sign.

    ``spread`` is the covariance of the errors of the forgiven pencil and ruler. ``computed`` is the
    deviation of values computed from a reading. ``cranks`` is the change of the answers with each
    crank, per degree.
    """

    sizes: Any
    spread: Any
    computed: Any
    cranks: Any
    places: Any


class Fit(Struct, frozen=True):
    """How likely answers are by a key, as a logarithm.

    ``fits`` marks those that are no mistakes. ``pencil`` is the likeliest coarseness, relative to
    the forgiven pencil.
    """

    likelihood: float
    fits: Any
    pencil: float


def fit(answers: Any, rounding: Any, key: Key, *starts: Any) -> Fit:
    """The likeliest split of answers with rounding errors into drawn ones and mistakes.

    The answer that fits the others least is taken for a mistake as long as this is likelier. The
    search starts from all answers, from those near the key, and from each of ``starts``.
    """
    noise = noise_of(rounding, key)
    off = answers - key.sizes
    astray = log(MISTAKES) + scattered(answers, key)
    near = abs(off) <= FAR * np.sqrt(np.diag(key.spread + noise))
    seen: dict[bytes, tuple[Fit, int | None]] = {}

    def judge(fits: Any) -> tuple[Fit, int | None]:
        pattern = fits.tobytes()  # different starts often meet
        if pattern not in seen:
            seen[pattern] = judged(off, key.spread, noise, astray, fits)
        return seen[pattern]

    found = [cleared(judge, each) for each in (np.ones_like(near), near, *starts)]
    return max(found, key=lambda each: each.likelihood)


def noise_of(rounding: Any, key: Key) -> Any:
    """The covariance of errors other than the pencil's: rounding, computing, badly set cranks."""
    return np.diag(key.computed**2 + rounding**2 / 3) + LAID_OFF**2 * key.cranks.T @ key.cranks


def likelihood_if_drawn(answers: Any, rounding: Any, key: Key, fits: Any) -> float:
    """How likely answers are if exactly those of ``fits`` are drawn, as a logarithm."""
    astray = log(MISTAKES) + scattered(answers, key)
    noise = noise_of(rounding, key)
    return judged(answers - key.sizes, key.spread, noise, astray, fits)[0].likelihood


def cleared(judge: Callable[[Any], tuple[Fit, int | None]], fits: Any) -> Fit:
    """The fit after removing mistakes one by one."""
    best, worst = judge(fits)
    while worst is not None:
        fewer = best.fits.copy()
        fewer[worst] = False
        found, worst = judge(fewer)
        if found.likelihood <= best.likelihood:
            break
        best = found
    return best


def judged(off: Any, spread: Any, noise: Any, astray: Any, fits: Any) -> tuple[Fit, int | None]:
    """The fit if exactly these answers are drawn, and the answer that fits the others least."""
    places = np.flatnonzero(fits)
    lost = float(astray[~fits].sum())
    if not len(places):
        return Fit(lost, fits, PENCILS[0]), None
    own = places[:, None], places
    scale = np.sqrt(np.maximum((spread.diagonal() + noise.diagonal())[places], SURELY))
    square = scale[:, None] * scale
    regular = noise[own] / square
    regular.flat[:: len(places) + 1] += 1e-9
    lower = np.linalg.cholesky(regular)
    inverse = np.linalg.inv(lower)
    wide, axes = np.linalg.eigh(inverse @ (spread[own] / square) @ inverse.T)
    apart = axes.T @ inverse @ (off[places] / scale)
    variances = 1 + np.square(PENCILS)[:, None] * np.maximum(wide, 0.0)
    size = np.log(variances).sum(axis=1) + 2 * np.log(lower.diagonal() * scale).sum()
    each = -0.5 * ((apart**2 / variances).sum(axis=1) + len(places) * log(2 * pi) + size)
    likely = int(each.argmax())
    drawn = each[likely] + log(np.exp(each - each[likely]).sum() / len(PENCILS))
    back = (axes.T @ inverse).T
    pulled = back @ (apart / variances[likely])
    alone = (back**2 / variances[likely]).sum(axis=1)
    worst = int(places[(pulled**2 / alone).argmax()])
    whole = float(drawn) + len(places) * log(1 - MISTAKES) + lost
    return Fit(whole, fits, PENCILS[likely]), worst


def scattered(answers: Any, key: Key) -> Any:
    """The density of mistakes, as a logarithm: half of them lie within a factor of two."""
    sizes = np.maximum(abs(answers), 1e-12 + 1e-6 * abs(key.sizes))
    apart = np.log(sizes / np.maximum(abs(key.sizes), 1e-12)) / HALF
    size = -np.log(pi * HALF * sizes * (1 + apart**2))
    away = (answers - key.sizes) / ASTRAY
    return np.where(key.places, -np.log(pi * ASTRAY * (1 + away**2)), size)


def reported_odds(logarithm: float) -> float:
    """Odds as reported: at most ``SURE``."""
    return min(exp(min(logarithm, log(SURE))), SURE)


# --- the keys of a class's variants ---------------------------------------------------------------


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
