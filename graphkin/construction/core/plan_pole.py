"""The pole of a plan: the image of everything that stands still."""

from __future__ import annotations

from typing import ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.kind import Construction


class PlanPole(Construction, frozen=True, kw_only=True):
    """The ``pole`` of a plan, chosen freely: o of the velocities, o′ of the accelerations."""

    gives: ClassVar[tuple[str, ...]] = ("pole",)
    unmarked: ClassVar[frozenset[str]] = frozenset({"pole"})

    pole: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """The point, larger than those of images."""
        canvas.pole()
