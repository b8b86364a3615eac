"""What two loci, or two pins, determine: a point or a direction, and in what words that fails."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from graphkin.construction.core.kind import Construction
from graphkin.construction.core.program import Step

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing
    from graphkin.text.errors import Problem


class Determined(Construction, frozen=True):
    """A point or a direction that two loci determine.

    ``loci`` is what these are called, ``apart`` the words for two that miss each other.
    ``has_angle`` says that its margin is the sine of the angle at which they cross, ``has_mirror``
    that they cross a second time, on the other side.
    """

    loci: ClassVar[str] = "the loci"
    apart: ClassVar[str] = "the loci miss each other"
    has_angle: ClassVar[bool] = True
    has_mirror: ClassVar[bool] = False

    def in_line(self, steps: Sequence[Step], nearly: str) -> str:
        """What lies in line or perpendicular where it fails; ``nearly`` is put before, if flat."""
        return ""

    def failing(self) -> str:
        """Words for what hinders it where its loci do not meet; nothing where lines say it."""
        return ""

    def undetermined(self, args: Sequence[Any]) -> Problem | None:
        """The problem of loci that leave any place or direction open; None where they do not."""
        return None

    def at_end(self, steps: Sequence[Step], loci: Sequence[Any]) -> tuple[str, str] | None:
        """What cannot be found beyond the end of a range, and how the lines lie there."""
        return None


def which_side(drawing: Drawing, number: int) -> int:
    """Which of two crossings a step takes, by its sign: stated, or found with a group."""
    step = drawing.trace.program.steps[number]
    return round(step.extra[0] if step.extra else drawing.trace.values[step.args[2]])
