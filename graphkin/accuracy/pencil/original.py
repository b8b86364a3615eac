"""The exact drawing: its values and scales, and the steps that a pencil gets wrong.

The answers read off a drawing: vectors, rates and places, their errors and scales.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import isfinite
from typing import Any

from msgspec import Struct

from graphkin.accuracy.pencil.pencil import Paper, PencilMark, mark_of
from graphkin.construction.core.component import component_of, has_many_triangles
from graphkin.construction.core.program import Program, Step, Target, sign_of
from graphkin.construction.core.quantities import (
    BALANCING_MOMENT,
    BY_TARGET,
    EPSILON,
    RATES,
    MotionQuantity,
)
from graphkin.construction.core.run import Trace
from graphkin.construction.velocity.turning_of_link import TurningOfLink
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.numbers.plane import Ratio, by_parts, cross

SAME = 1e-9
"""The share by which an arrow may differ from the vector that is read and count as the same."""


class Original(Struct, frozen=True, dict=True):
    """One construction by hand without errors: its trace at some scales, and its targets."""

    trace: Trace
    paper: Paper
    targets: tuple[Target, ...]
    triangles: bool = True

    @property
    def program(self) -> Program:
        return self.trace.program

    @cached_property
    def marks(self) -> Mapping[int, PencilMark]:
        """The mark of each step that puts one on paper, in the order of the drawing."""
        steps = self.program.steps
        found = {
            number: mark_of(steps[number], value) for number, value in self.trace.values.items()
        }
        return {
            number: mark
            for number, mark in found.items()
            if mark is not None and number not in self.skipped
        }

    @cached_property
    def crowded(self) -> bool:
        """Whether there are so many triangles that all of them are computed, not drawn."""
        return has_many_triangles(self.trace)

    @cached_property
    def order(self) -> tuple[int, ...]:
        """The steps whose values a pencil changes, each after the steps that it depends on."""
        moved: list[int] = []
        known: set[int] = set()
        for number in self.trace.values:
            step = self.program.steps[number]
            hand = {step.by_hand} if self.by_hand(number) is not None else set()
            if number not in self.skipped and (
                number in self.marks or known.intersection((*step.args, *hand))
            ):
                moved.append(number)
                known.add(number)
        return tuple(moved)

    @cached_property
    def skipped(self) -> frozenset[int]:
        """Arrows, which only join existing points."""
        return frozenset(n for n in self.trace.values if self.program.steps[n].arrow)

    def by_hand(self, number: int) -> int | None:
        """The drawn step that replaces a composite one; None if the drawing has no such step."""
        component, hand = component_of(self.program, number), self.program.steps[number].by_hand
        if component and (self.crowded or (component.gives_way and not self.triangles)):
            return None
        return hand if hand is not None and hand in self.trace.values else None

    @cached_property
    def tails(self) -> Mapping[int, int]:
        """For each angular acceleration the step at which its tangential component begins.

        A hand reads the arrow of that component, which is a part of the relative vector.
        """
        found = {}
        for number, value in self.trace.values.items():
            step = self.program.steps[number]
            if isinstance(step.of, TurningOfLink) and step.of.quantity == EPSILON:
                for tail in self.tangential_tails(step.args[3]):
                    if self.reads_alike(number, tail, value):
                        found[number] = tail
        return found

    def tangential_tails(self, tip: int) -> Iterable[int]:
        """The steps at which tangential components begin that end at a point of the plan."""
        for number in self.skipped:
            step = self.program.steps[number]
            if sign_of(step) == "τ" and step.args[1] == tip:
                yield step.args[0]

    def reads_alike(self, number: int, tail: int, value: float) -> bool:
        """Whether an arrow to the end of a bar's image gives the same rate."""
        p, q, _, tip = (self.trace.values[arg] for arg in self.program.steps[number].args)
        read = cross(q - p, tip - self.trace.values[tail]) / abs(q - p) ** 2
        return bool(abs(read - value) <= SAME * max(abs(value), abs(tip) / abs(q - p)))


class Originals(Original, frozen=True, kw_only=True, dict=True):
    """The constructions of several variants with the same drawing steps.

    Each value has a row for each variant, or is a single one that all share. ``like`` is the first
    variant.
    """

    like: Original

    @cached_property
    def marks(self) -> Mapping[int, PencilMark]:
        return self.like.marks

    @cached_property
    def order(self) -> tuple[int, ...]:
        return self.like.order

    @cached_property
    def tails(self) -> Mapping[int, int]:
        return self.like.tails


def together(every: Sequence[Original]) -> Original:
    """The constructions of several variants as one."""
    first = every[0]
    if len(every) == 1:
        return first
    values = {
        number: stacked([each.trace.values[number] for each in every])
        for number in first.trace.values
        if number not in first.skipped
    }
    paper = Paper(
        *(
            stacked([getattr(each.paper, name) for each in every])
            for name in Paper.__struct_fields__
        )
    )
    trace = Trace(first.program, values, {})
    return Originals(trace, paper, first.targets, first.triangles, like=first)


def stacked(values: Sequence[Any]) -> Any:
    """The values of all variants as a column, by the parts of a line or circle.

    A value that all variants share stays single.
    """
    first = values[0]
    if isinstance(first, tuple):
        return by_parts(lambda *part: stacked(part), *values)
    if all(value == first for value in values):
        return first
    return np.array(values)[:, None]


def original(
    mechanism: Mechanism, scales: Scales, targets: Iterable[Target] | None = None
) -> Original:
    """The drawing of what a scene asks, or of some targets, at the scales of its sheets."""
    wanted = tuple(mechanism.asked() if targets is None else targets)
    trace = mechanism.trace(wanted, by_hand=True, seconds=scales.seconds)
    paper = Paper.of(scales)
    return Original(trace, paper, wanted, scales.triangles)


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
