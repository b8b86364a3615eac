"""Drawings by the thousand, each with errors of its own: what a class would hand in."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import Any

from msgspec import Struct

from graphkin.accuracy.pencil.original import Original, original
from graphkin.accuracy.pencil.pencil import Pencil
from graphkin.accuracy.pencil.pencil_marks import PencilMark
from graphkin.accuracy.pencil.read_off import DrawnQuantity, answers
from graphkin.accuracy.pencil.redrawing import redrawn
from graphkin.construction.core.program import Target
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arrays import np

BLOCK = 4096
"""Drawings made at once: few enough that the values of a step stay in the processor's cache."""
COMMON = 95.0
"""Of a hundred drawings so many are to be no farther off."""


class Drawn(Struct, frozen=True, dict=True):
    """The answers of many drawings: for each target an array with an element for each drawing.

    Vectors and places are complex; NaN where a drawing does not close.
    """

    original: Original
    answers: tuple[DrawnQuantity, ...]
    values: tuple[Any, ...]

    def __getitem__(self, target: Target) -> Any:
        """The values of a target."""
        return self.values[self.index[target]]

    @cached_property
    def index(self) -> dict[Target, int]:
        """The place of each target."""
        return {answer.target: i for i, answer in enumerate(self.answers)}

    def error(self, target: Target, percent: float = COMMON) -> float:
        """How far off so many percent of the drawings are at most; infinite where they fail."""
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
    """So many drawings of what a scene asks, or of some targets, at the scales of its sheets.

    The same seed gives the same drawings, and the first of more drawings are those of fewer: each
    step has a stream of its own (PCG64 of the seed and the step's number).
    """
    return simulated(original(mechanism, scales, targets), pencil, count, seed)


def simulated(exact: Original, pencil: Pencil, count: int, seed: int = 0) -> Drawn:
    """So many drawings of an original."""
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
