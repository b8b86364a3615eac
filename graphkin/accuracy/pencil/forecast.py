"""The expected error of drawings, predicted from the single errors of each mark.

The rows of one batch are the sources: one error of one mark at a time, at plus and minus √3
standard deviations. With the exact drawing, these are the three points of Gauss and Hermite. They
give mean and variance of every answer, as long as errors of different marks do not interact. The
95th percentile follows from these by a scaled chi-square (Satterthwaite 1946) and its quantile by
the cube root (Wilson and Hilferty 1931).

If a pencil is so coarse that answers are not linear in single errors, marks do interact; and some
drawings close with one error but not with many. Therefore some joint drawings are always made. If
they disagree, the error is read from more of them, which are the same at every run.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from math import inf, isfinite, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil.pencil import DrawnQuantity, Original, Pencil, PencilMark, answers
from graphkin.accuracy.pencil.redrawing import Drawn, redrawn, simulated
from graphkin.construction.core.program import Target
from graphkin.numbers.arithmetic import np

NODE = sqrt(3)
"""The size of a trial error, in standard deviations."""
WEIGHT = 1 / 6
"""The weight of each of the two trial errors; the exact drawing has the rest."""
BENT = 0.1
"""The ratio of an answer's total drift to its deviation above which errors do not just add."""
TRIED = 500
"""The number of joint drawings that test every forecast."""
ALIKE = 1.25
"""The factor within which a forecast must agree with the joint drawings."""
JOINT = 4000
"""The number of joint drawings from which the error is read if the forecast fails."""
SEED = 95
"""The seed of the errors of joint drawings."""
NORMAL_95 = 1.6448536269514722
"""The 95th percentile of the standard normal distribution."""


class Expected(Struct, frozen=True):
    """The forecast for one answer; ``error`` is its 95th percentile in the answer's SI unit.

    ``sources`` are the shares of its variance, which add up to one, by the step whose mark errs.
    ``joint`` says that errors do not just add, so that joint drawings were made. The error is
    infinite if one drawing in twenty does not close.
    """

    answer: DrawnQuantity
    error: float
    sources: Mapping[int, float]
    joint: bool = False

    @property
    def relative(self) -> float | None:
        """The error over the answer's size; None for a place, infinite for a zero answer."""
        if self.answer.size is None:
            return None
        return self.error / self.answer.size if self.answer.size else inf

    @property
    def millimetres(self) -> float | None:
        """The error in mm of the plan in which the answer is measured; None if it is in none."""
        return self.error / self.answer.millimetre if self.answer.millimetre else None

    @property
    def heaviest(self) -> int | None:
        """The step whose mark contributes most to the error; None if no mark errs."""
        return max(self.sources, key=lambda number: self.sources[number], default=None)


class Forecast(Struct, frozen=True, dict=True):
    """The expected error of each answer of a drawing made with a pencil."""

    original: Original
    pencil: Pencil
    expected: tuple[Expected, ...]

    def __getitem__(self, target: Target) -> Expected:
        return self.index[target]

    @cached_property
    def index(self) -> Mapping[Target, Expected]:
        return {found.answer.target: found for found in self.expected}


def forecast(exact: Original, pencil: Pencil) -> Forecast:
    """The 95th percentile of the error of each answer, with few simulated drawings.

    A grid rounds some marks and leaves others in place, so that a pencil with one needs joint
    drawings.
    """
    owners, errors = sources(exact)
    found = redrawn(exact, replace(pencil, grid=0.0), errors)
    single = [expected(answer, found, owners) for answer in answers(exact)]
    few = simulated(exact, pencil, TRIED, SEED)
    judged = [
        replace(each, joint=each.joint or pencil.grid > 0 or not is_alike(each, few))
        for each in single
    ]
    if any(each.joint for each in judged):
        many = simulated(exact, pencil, JOINT, SEED)
        judged = [
            replace(each, error=many.error(each.answer.target)) if each.joint else each
            for each in judged
        ]
    return Forecast(exact, pencil, tuple(judged))


def is_alike(each: Expected, few: Drawn) -> bool:
    """Whether the joint drawings give about the forecast error; zero agrees with zero."""
    drawn = few.error(each.answer.target)
    return drawn / ALIKE <= each.error <= drawn * ALIKE


def sources(exact: Original) -> tuple[Any, Any]:
    """The step that owns each source, and the errors of each mark, two rows for each source."""
    first: dict[int, int] = {}
    owners: list[int] = []
    for number, mark in exact.marks.items():
        first[number] = len(owners)
        owners += [number] * mark.errors

    def errors(number: int, mark: PencilMark) -> Any:
        rows = np.zeros((len(owners), 2, mark.errors))
        for k in range(mark.errors):
            rows[first[number] + k, :, k] = NODE, -NODE
        return rows.reshape(-1, mark.errors)

    return np.array(owners, dtype=int), errors


def expected(answer: DrawnQuantity, found: Mapping[int, Any], owners: Any) -> Expected:
    """The forecast for one answer, from the drawings with one error each."""
    with np.errstate(all="ignore"):
        off = np.broadcast_to(answer.error(found), 2 * len(owners)).reshape(-1, 2)
        parts = np.stack([off.real, off.imag]) if np.iscomplexobj(off) else off[None]
        mean = WEIGHT * parts.sum(axis=2)
        own = np.einsum("is,js->sij", mean, mean)
        spread = WEIGHT * np.einsum("isk,jsk->sij", parts, parts) - own
        variances = np.einsum("sii->s", spread)
    drift = float(np.hypot(*mean).sum() if len(mean) > 1 else abs(mean).sum())
    bent = not drift <= BENT * sqrt(variances.sum())
    error = percentile(mean.sum(axis=1), spread.sum(axis=0))
    return Expected(answer, error, dict(shares(owners, variances)), bent)


def shares(owners: Any, variances: Any) -> Iterator[tuple[int, float]]:
    """The share of each step in a variance; the sources of a step are adjacent."""
    whole = float(variances.sum())
    if isfinite(whole) and whole > 0:
        first = np.flatnonzero(np.diff(owners, prepend=-1))
        parts = np.add.reduceat(variances, first) / whole
        yield from zip(owners[first].tolist(), parts.tolist(), strict=True)


def percentile(mean: Any, spread: Any) -> float:
    """The 95th percentile of the length of a Gaussian vector, or of the size of a number.

    The square of the length has the mean tr C + m·m and the variance 2 tr C² + 4 m·C·m. It is
    replaced by a scaled chi-square with the same mean and variance. Infinite if these are not
    finite.
    """
    size = float(np.trace(spread) + mean @ mean)
    if not isfinite(size):
        return inf
    if size == 0:
        return 0.0
    change = float(2 * np.trace(spread @ spread) + 4 * mean @ spread @ mean)
    freedoms = 2 * size**2 / change if change > 0 else inf
    return sqrt(size * chi_square_share(freedoms))


def chi_square_share(freedoms: float) -> float:
    """The 95th percentile of a chi-square over its mean (Wilson and Hilferty)."""
    lack = 2 / (9 * freedoms)
    return float((1 - lack + NORMAL_95 * sqrt(lack)) ** 3)
