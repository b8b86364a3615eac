"""The drawing as it should be: exact values, scales, and which of its steps a pencil gets wrong."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, Protocol

from msgspec import Struct

from graphkin.accuracy.pencil.pencil_marks import Paper, PencilMark, mark_of
from graphkin.construction.core.component import TriangleChoice, component_of
from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.run import Trace
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import cross

READ = {"omega", "epsilon"}
"""Actions by which a hand divides a length that it reads off a plan by the length of a bar."""
SAME = 1e-9
"""Share by which an arrow may differ from the vector that is read and still be it."""


class DrawingScales(Protocol):
    """The scale factors of a drawing: real over drawn, and the same for both plans."""

    @property
    def kL(self) -> float: ...  # noqa: D102
    @property
    def kv(self) -> float: ...  # noqa: D102
    @property
    def ka(self) -> float: ...  # noqa: D102
    @property
    def seconds(self) -> float: ...  # noqa: D102
    @property
    def triangles(self) -> bool: ...  # noqa: D102
    @property
    def apart(self) -> float: ...  # noqa: D102


class Original(Struct, frozen=True, dict=True):
    """One construction by hand without errors: its trace at some scales, and what is read off."""

    trace: Trace
    paper: Paper
    targets: tuple[Target, ...]
    triangles: bool = True
    apart: bool = False

    @property
    def program(self) -> Program:
        """The steps of the construction."""
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
    def order(self) -> tuple[int, ...]:
        """The steps whose values a pencil changes, in an order in which each finds its own."""
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
        """Arrows, which only join what is there."""
        return frozenset(n for n in self.trace.values if self.program.steps[n].arrow)

    def by_hand(self, number: int) -> int | None:
        """The step that gives a composite one by hand, where the drawing has it."""
        component, hand = component_of(self.program, number), self.program.steps[number].by_hand
        choice = TriangleChoice(self.triangles, self.apart)
        if component is not None and component.is_computed(choice):
            return None
        return hand if hand is not None and hand in self.trace.values else None

    @cached_property
    def tails(self) -> Mapping[int, int]:
        """For each angular acceleration the step from which its tangential component is laid off.

        A hand reads that arrow, not the whole relative vector, of which it is a part.
        """
        found = {}
        for number, value in self.trace.values.items():
            step = self.program.steps[number]
            if step.action is not None and step.action.key == "epsilon" and step.args:
                for tail in self.tangential_tails(step.args[3]):
                    if self.reads_alike(number, tail, value):
                        found[number] = tail
        return found

    def tangential_tails(self, tip: int) -> Iterable[int]:
        """Where the tangential components begin that end in a point of the plan."""
        for number in self.skipped:
            step = self.program.steps[number]
            if sign_of(step) == "τ" and step.args[1] == tip:
                yield step.args[0]

    def reads_alike(self, number: int, tail: int, value: float) -> bool:
        """Whether an arrow to the end of a bar's image tells the same rate."""
        p, q, _, tip = (self.trace.values[arg] for arg in self.program.steps[number].args)
        read = cross(q - p, tip - self.trace.values[tail]) / abs(q - p) ** 2
        return bool(abs(read - value) <= SAME * max(abs(value), abs(tip) / abs(q - p)))


def original(
    mechanism: Mechanism, scales: DrawingScales, targets: Iterable[Target] | None = None
) -> Original:
    """The drawing of what a scene asks, or of some targets, at the scales of its sheets."""
    wanted = tuple(mechanism.asked() if targets is None else targets)
    trace = mechanism.trace(wanted, by_hand=True, seconds=scales.seconds)
    paper = Paper(scales.kL, scales.kv, scales.ka)
    return Original(trace, paper, wanted, scales.triangles, scales.apart > 0)


def is_read(action: Any) -> bool:
    """Whether an action divides a read length by a bar."""
    return action is not None and action.key in READ
