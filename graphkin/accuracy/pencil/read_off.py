"""The answers read off a drawing: vectors, rates and places, their errors and scales."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Any

from msgspec import Struct

from graphkin.accuracy.pencil.original import Original
from graphkin.construction.core.program import Step, Target
from graphkin.construction.core.quantities import BALANCING_MOMENT, BY_TARGET, RATES, MotionQuantity
from graphkin.numbers.plane import Ratio

FAR = 10.0
"""Metres of paper beyond which a centre counts as at infinity, because no hand draws it."""


class DrawnQuantity(Struct, frozen=True):
    """One answer: its target, the step that gives it, its exact value and its scale.

    ``unit`` is the answer's SI unit. ``millimetre`` is the amount of it that a millimetre of paper
    represents, zero if the answer is not drawn.
    """

    target: Target
    number: int
    is_place: bool
    value: Any
    unit: str
    millimetre: float

    @property
    def size(self) -> float | None:
        """The size that a relative error refers to; None for a place, whose size has no meaning."""
        return None if self.is_place else abs(self.value)

    def of(self, found: Mapping[int, Any]) -> Any:
        """The answer in some drawings, an element for each."""
        value = found[self.number]
        return placed(value) if self.is_place else value

    def error(self, found: Mapping[int, Any]) -> Any:
        """The difference of the answer from the exact one in some drawings."""
        return self.of(found) - self.value


def answers(original: Original) -> Iterator[DrawnQuantity]:
    """The answers that depend on the drawing, in the order asked, without places at infinity.

    A rate that is given, or zero because nothing turns, is not an answer of the drawing. Nor is an
    auxiliary result, such as the angle through which a wheel has turned.
    """
    moved = frozenset(original.order)
    for target in original.targets:
        number = original.program.targets[target]
        quantity = BY_TARGET.get(target[0])
        if number not in moved or quantity is None or not quantity.words:
            continue
        found = answer(original, target, quantity, number)
        if found is not None:
            yield found


def answer(
    original: Original, target: Target, quantity: MotionQuantity, number: int
) -> DrawnQuantity | None:
    """One answer; None for a place that no drawing shows."""
    value = original.trace.values[number]
    mm = original.paper.millimetre(quantity.plane)
    if quantity.is_place:
        value = placed(value)
        if value is None or not isfinite(abs(value)) or abs(value) > FAR * 1000 * mm:
            return None
    elif quantity is BALANCING_MOMENT:
        mm = 0.0
    elif quantity in RATES:
        mm = mm / bar_of(original, original.program.steps[number])
    return DrawnQuantity(target, number, quantity.is_place, value, quantity.unit, mm)


def bar_of(original: Original, step: Step) -> float:
    """The length of the bar from whose relative vector a rate is read; infinite without a bar."""
    if len(step.args) == 4:
        p, q = (original.trace.values[arg] for arg in step.args[:2])
        return abs(q - p) if isinstance(p, complex) and isinstance(q, complex) else float("inf")
    return float("inf")


def placed(value: Any) -> Any:
    """The point of a centre, by construction or by hand; None for one at infinity."""
    if not isinstance(value, Ratio):
        return value
    if not hasattr(value.size, "shape") and value.size == 0:
        return None
    return value.start + value.shift / value.size
