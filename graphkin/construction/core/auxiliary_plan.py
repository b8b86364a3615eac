"""Plans that are drawn only to find the right one, and what sheets ask of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from graphkin.construction.core.program import PlanAside

if TYPE_CHECKING:
    from graphkin.construction.core.canvas import Canvas
    from graphkin.construction.core.drawn_scene import Drawing
    from graphkin.construction.core.sentence import Sentence


class AuxiliaryPlan(PlanAside):
    """A plan that is drawn only to find the right one."""

    @property
    def repeats(self) -> bool:
        """Whether it repeats the lines of another one, and follows no equation of its own."""
        return False

    def turned_by(self, rate: int) -> str:
        """The link whose rate it assumes at a step; nothing where it assumes none there."""
        return ""

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
