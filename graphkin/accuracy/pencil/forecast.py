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

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import inf, isfinite, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil.pencil import (
    DrawnQuantity,
    Original,
    Pencil,
    PencilMark,
    answers,
    marked,
    original,
)
from graphkin.construction.cams.cam_centre import CurvatureCentre
from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import Target
from graphkin.construction.higher_class.closure_solver import ClosureSolver, closer_of
from graphkin.construction.velocity.turning_of_link import TurningOfLink
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.numbers.common_roots import solutions
from graphkin.numbers.plane import cross

Errors = Callable[[int, PencilMark], Any]
"""The errors of a step's mark: a row for each drawing, in standard deviations."""


def redrawn(original: Original, pencil: Pencil, errors: Errors) -> dict[int, Any]:
    """Every value of the drawing with the pencil's errors, an array element for each drawing.

    A value that no error affects stays the single exact value; a value that cannot be drawn is NaN.
    """
    found = dict(original.trace.values)
    with np.errstate(all="ignore"):
        for number in original.order:
            mark = original.marks.get(number)
            row = None if mark is None else errors(number, mark)
            found[number] = step_drawn(original, number, found, row, pencil)
    return found


def step_drawn(
    original: Original, number: int, found: Mapping[int, Any], errors: Any, pencil: Pencil
) -> Any:
    """The value of one step from the values before it, with the errors of its mark."""
    step, mark = original.program.steps[number], original.marks.get(number)
    mm = original.paper.millimetre(step.plane)
    if mark is PencilMark.CLOSING:
        return closed(original, number, found, pencil.mark * mm * errors[:, 0])
    value = unmarked(original, number, found)
    if mark is None:
        return value
    start, kind = value, construction(step)
    if mark is PencilMark.ARROW and kind is not None:
        start = found[kind.pivot if isinstance(kind, CurvatureCentre) else step.args[0]]
    return marked(mark, value, start, errors, pencil, mm)


def unmarked(original: Original, number: int, found: Mapping[int, Any]) -> Any:
    """The value of a step from earlier values: given, drawn by hand, read off, or computed."""
    step, hand = original.program.steps[number], original.by_hand(number)
    if hand is not None:
        return found[hand]
    if step.given is not None:
        return original.trace.values[number]
    assert step.action is not None
    if isinstance(step.of, TurningOfLink):
        return read_off(original, number, found)
    return step.action.value(*(found[arg] for arg in step.args), *step.extra)


def read_off(original: Original, number: int, found: Mapping[int, Any]) -> Any:
    """An angular rate as read by hand: a length in the plan over the known length of the bar.

    For an acceleration the hand reads the tangential component, if it is drawn.
    """
    step = original.program.steps[number]
    p, q, start, tip = step.args
    exact = original.trace.values
    bar = found[q] - found[p]
    tail = original.tails.get(number, start)
    return cross(bar, found[tip] - found[tail]) / (abs(bar) * abs(exact[q] - exact[p]))


def closed(original: Original, number: int, found: Mapping[int, Any], shift: Any) -> Any:
    """The closing value of a group of higher class in each drawing."""
    step = original.program.steps[number]
    known = [found[arg] for arg in step.args]
    exact = original.trace.values[number]
    closer = closer_of(step)
    assert closer is not None
    return followed(closer, exact, known, shift)


ROUNDS = 6
"""The number of Newton steps; three would do, because errors of a drawing are small."""
SMALL = 1e-6
"""Half the step of the difference quotient, in radians or as a share of the reach."""


def followed(
    closer: ClosureSolver, exact: Any, known: Sequence[Any], shift: Any
) -> tuple[Any, ...]:
    """The closure (tried value, signs, sine) for drawn known values, one for each drawing.

    ``shift`` (m) is the error of the mark at the crossing, by which the locus is missed.
    """
    trying = closer.trying
    count = len(trying.unknowns)
    signs, sine = exact[count:-1], exact[-1]
    rows = np.broadcast_to(np.array(signs, dtype=float), (len(shift), len(signs)))
    args = [np.broadcast_to(value, len(shift)) for value in known]
    start = np.array([*map(float, trying.numbers(exact))])
    turned = [one.turns for one in trying.unknowns]
    sizes = np.where(turned, 1.0, np.maximum(abs(start), 1e-3))
    tried, steps = np.tile(start, (len(shift), 1)), SMALL * sizes
    missed = np.column_stack([shift] * count)
    for _ in range(ROUNDS):
        slopes = np.empty((len(shift), count, count))
        for k in range(count):
            away = np.where(np.arange(count) == k, steps, 0.0)
            low, high = (trying.misfits(args, tried + way * away, rows) for way in (-1, 1))
            slopes[:, :, k] = (high - low) / (2 * steps[k])
        left = trying.misfits(args, tried, rows) - missed
        with np.errstate(all="ignore"):
            tried = tried - (left / slopes[:, 0] if count == 1 else solutions(slopes, left))
    return (*trying.placed(tried.T), *signs, sine)


# --- thousands of drawings with random errors, as a class would hand them in ----------------------


BLOCK = 4096
"""Drawings made at once: few enough that the values of a step fit the processor's cache."""
COMMON = 95.0
"""The percentile of drawings that an error covers."""


class Drawn(Struct, frozen=True, dict=True):
    """The answers of many drawings: for each target an array with an element for each drawing.

    Vectors and places are complex; NaN where a drawing does not close.
    """

    original: Original
    answers: tuple[DrawnQuantity, ...]
    values: tuple[Any, ...]

    def __getitem__(self, target: Target) -> Any:
        return self.values[self.index[target]]

    @cached_property
    def index(self) -> dict[Target, int]:
        return {answer.target: i for i, answer in enumerate(self.answers)}

    def error(self, target: Target, percent: float = COMMON) -> float:
        """The largest error of ``percent`` percent of the drawings; infinite if too many fail."""
        off = abs(self[target] - self.answers[self.index[target]].value)
        return float(np.percentile(np.where(np.isnan(off), np.inf, off), percent, method="lower"))


def pencil_drawings(
    mechanism: Mechanism,
    scales: Scales,
    pencil: Pencil,
    count: int,
    seed: int = 0,
    targets: Iterable[Target] | None = None,
) -> Drawn:
    """``count`` drawings of what a scene asks, or of some targets, at the scales of its sheets.

    The same seed gives the same drawings, and a larger ``count`` begins with the same drawings:
    each step has its own random stream (PCG64 of the seed and the step's number).
    """
    return simulated(original(mechanism, scales, targets), pencil, count, seed)


def simulated(exact: Original, pencil: Pencil, count: int, seed: int = 0) -> Drawn:
    """``count`` drawings of an original."""
    wanted = tuple(answers(exact))
    values = [np.empty(count, dtype=np.result_type(type(answer.value))) for answer in wanted]
    streams = {
        number: np.random.Generator(np.random.PCG64([seed, number])) for number in exact.marks
    }
    for start in range(0, count, BLOCK):
        size = min(BLOCK, count - start)

        def errors(number: int, mark: PencilMark, size: int = size) -> Any:
            return streams[number].standard_normal((size, mark.errors))

        found = redrawn(exact, pencil, errors)
        with np.errstate(all="ignore"):
            for answer, array in zip(wanted, values, strict=True):
                array[start : start + size] = answer.of(found)
    return Drawn(exact, wanted, tuple(values))


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
