"""Auxiliary plans, drawn only to find the right plan, and what a sheet asks of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence
from graphkin.construction.core.program import PlanAside


class AuxiliaryPlan(PlanAside):
    """A plan drawn only to find the right plan."""

    @property
    def repeats(self) -> bool:
        """Whether this plan repeats the lines of another plan, without equations of its own."""
        return False

    def reason(self, name: str) -> str:
        """The key of the reason for this plan, for its opening sentence; otherwise empty."""
        return ""

    def turned_by(self, rate: int) -> str:
        """The link whose rate is assumed at a step; empty where no rate is assumed there."""
        return ""

    def is_idle(self, drawing: Drawing, number: int) -> bool:
        """Whether a line only finds points that coincide with the point where it begins."""
        return False

    def begins(self, drawing: Drawing, named: Sequence[int]) -> bool:
        """Whether these are the points with which this plan begins."""
        return False

    def parts_of_sentence(
        self, drawing: Drawing, named: Sequence[int]
    ) -> Iterator[tuple[int, int, str]]:
        """The points of this plan by line: step of the point, last step of the part, sentence."""
        yield from ()

    def introduced(self, drawing: Drawing, how: str, *, first: bool) -> str:
        """The sentence ``how`` of a part, after a phrase that names this plan.

        For the ``first`` part the phrase also states what the plan assumes.
        """
        return how

    def falls_on(self, drawing: Drawing, number: int) -> str:
        """The point that coincides with a point of this plan and all its sources; else empty."""
        return ""

    def sentences(self, drawing: Drawing, number: int) -> Iterator[Sentence]:
        """The sentences that go with one step of this plan."""
        yield from ()

    def marks(self, canvas: Canvas, number: int) -> None:
        """Draw one step of this plan."""


def auxiliary_plan(drawing: Drawing, number: int) -> AuxiliaryPlan | None:
    """The auxiliary plan that alone uses a step; None where there is no such plan."""
    plan = drawing.auxiliary.get(number)
    return plan if isinstance(plan, AuxiliaryPlan) else None


def falls_on_sources(drawing: Drawing, number: int) -> bool:
    """Whether a point of an auxiliary plan coincides with all the points that it is drawn from."""
    plan = auxiliary_plan(drawing, number)
    return plan is not None and bool(plan.falls_on(drawing, number))
