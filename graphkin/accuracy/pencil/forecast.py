"""The error that drawings will have, without making them: each error of each mark on its own.

The rows of one batch are the sources: one error of one mark at a time, at plus and minus √3
standard deviations, which with the exact drawing are the three points of Gauss and Hermite. They
give mean and variance of every answer as far as errors of different marks do not work on each
other. The 95th percentile follows from these by a scaled chi-square (Satterthwaite 1946) and its
quantile by the cube root (Wilson and Hilferty 1931).

Where a pencil is so coarse that answers bend with single errors, marks do work on each other; and
some drawings close with one error but not with many. So some joint drawings are always made; where
they tell otherwise, the error is read from more of them, the same at every run.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from math import inf, isfinite, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil.original import Original
from graphkin.accuracy.pencil.pencil import Pencil, PencilMark
from graphkin.accuracy.pencil.read_off import DrawnQuantity, answers
from graphkin.accuracy.pencil.redrawing import Drawn, redrawn, simulated
from graphkin.construction.core.program import Target
from graphkin.numbers.arithmetic import np

NODE = sqrt(3)
"""Where an error is tried, in standard deviations."""
WEIGHT = 1 / 6
"""The weight of each of the two errors that are tried; the exact drawing has the rest."""
BENT = 0.1
"""The sum of all drifts of an answer, over its deviation, above which errors do not just add."""
TRIED = 500
"""Joint drawings on which every forecast is tried."""
ALIKE = 1.25
"""Within this factor of what they tell a forecast is believed."""
JOINT = 4000
"""Joint drawings from which the error is read where it is not."""
SEED = 95
"""The seed of their errors."""
NORMAL_95 = 1.6448536269514722
"""The number below which 95 of 100 standard normal numbers lie."""


class Expected(Struct, frozen=True):
    """What is expected of one answer: ``error`` is its 95th percentile in its own SI unit.

    ``sources`` are the shares of its variance by the step whose mark is off, which add up to one;
    ``joint`` tells that errors do not just add up, so that joint drawings were made. Where one in
    twenty does not close, the error is infinite.
    """

    answer: DrawnQuantity
    error: float
    sources: Mapping[int, float]
    joint: bool = False

    @property
    def relative(self) -> float | None:
        """The error beside the answer's size; None for a place, infinite for an answer nought."""
        if self.answer.size is None:
            return None
        return self.error / self.answer.size if self.answer.size else inf

    @property
    def millimetres(self) -> float | None:
        """The error in mm of the plan in which the answer is measured; None where it is in none."""
        return self.error / self.answer.millimetre if self.answer.millimetre else None

    @property
    def heaviest(self) -> int | None:
        """The step whose mark weighs most; None where no mark is off."""
        return max(self.sources, key=lambda number: self.sources[number], default=None)


class Forecast(Struct, frozen=True, dict=True):
    """What is expected of each answer of a drawing made with a pencil."""

    original: Original
    pencil: Pencil
    expected: tuple[Expected, ...]

    def __getitem__(self, target: Target) -> Expected:
        """What is expected of a target."""
        return self.index[target]

    @cached_property
    def index(self) -> Mapping[Target, Expected]:
        """What is expected of each target."""
        return {found.answer.target: found for found in self.expected}


def forecast(exact: Original, pencil: Pencil) -> Forecast:
    """The 95th percentile of the error of each answer of an original, without drawing it often.

    A grid rounds some marks and leaves others where they are: with one, joint drawings are made.
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
    """Whether joint drawings tell about the error that is foretold; nought is like nought."""
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
    """What is expected of one answer, from the drawings with one error each."""
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
    """The share of each step in a variance; the sources of a step stand side by side."""
    whole = float(variances.sum())
    if isfinite(whole) and whole > 0:
        first = np.flatnonzero(np.diff(owners, prepend=-1))
        parts = np.add.reduceat(variances, first) / whole
        yield from zip(owners[first].tolist(), parts.tolist(), strict=True)


def percentile(mean: Any, spread: Any) -> float:
    """The 95th percentile of the length of a Gaussian vector, or size of a number.

    Its square has the mean tr C + m·m and the variance 2 tr C² + 4 m·C·m; a scaled chi-square of
    the same two stands for it. Infinite where they are not known.
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
