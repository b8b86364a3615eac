"""Many drawings at once: every step is drawn by hand, each mark with its own errors."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Struct

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
