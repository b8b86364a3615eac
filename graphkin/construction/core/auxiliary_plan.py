"""Plans that are drawn only to find the right one, and what sheets ask of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence
from graphkin.construction.core.program import PlanAside


class AuxiliaryPlan(PlanAside):
    """A plan that is drawn only to find the right one."""

    @property
    def repeats(self) -> bool:
        """Whether it repeats the lines of another one, and follows no equation of its own."""
        return False

    def reason(self, name: str) -> str:
        """The key of why it is drawn, for the sentence that begins it; nothing for any other."""
        return ""

    def turned_by(self, rate: int) -> str:
        """The link whose rate it assumes at a step; nothing where it assumes none there."""
        return ""

    def is_idle(self, drawing: Drawing, number: int) -> bool:
        """Whether a line finds only points which fall on where it begins."""
        return False

    def begins(self, drawing: Drawing, named: Sequence[int]) -> bool:
        """Whether some points are those with which it begins."""
        return False

    def told_in_parts(
        self, drawing: Drawing, named: Sequence[int]
    ) -> Iterator[tuple[int, int, str]]:
        """Points of it line by line: the step of the point, that which ends a part, its words."""
        yield from ()

    def introduced(self, drawing: Drawing, how: str, *, first: bool) -> str:
        """A part of it after what it is; in the ``first`` one, after what it assumes too."""
        return how

    def falls_on(self, drawing: Drawing, number: int) -> str:
        """The point on which one of its own falls with all that it is drawn from; else nothing."""
        return ""

    def sentences(self, drawing: Drawing, number: int) -> Iterator[Sentence]:
        """What is said of it with one of its steps."""
        yield from ()

    def marks(self, canvas: Canvas, number: int) -> None:
        """Draw one of its steps."""


def auxiliary_plan(drawing: Drawing, number: int) -> AuxiliaryPlan | None:
    """The auxiliary plan that alone uses a step of the plan; None for any other step."""
    plan = drawing.auxiliary.get(number)
    return plan if isinstance(plan, AuxiliaryPlan) else None


def falls(drawing: Drawing, number: int) -> bool:
    """Whether a point of an auxiliary plan falls together with all that it is drawn from."""
    plan = auxiliary_plan(drawing, number)
    return plan is not None and bool(plan.falls_on(drawing, number))
