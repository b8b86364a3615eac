"""The vectors of the plans and of the mechanism: the owner and the kind of each."""

from __future__ import annotations

from typing import ClassVar

from graphkin.construction.core.program import Plane, Roles, Step


class PlanVector(Roles, frozen=True):
    """A velocity or acceleration, by ``letter`` and ``index``: of ``q``, about ``p`` if given.

    ``sign`` marks the components of an acceleration: ν, τ, c, r; it is empty for a whole vector.
    ``foot`` is the letter of the point where a component ends, or where it begins if it is laid
    ``back``. ``ends`` are the letters of both ends where no steps have them.
    """

    gives: ClassVar[tuple[str, ...]] = ("arrow",)

    letter: str
    index: str
    q: str = ""
    p: str = ""
    sign: str = ""
    foot: str = ""
    back: bool = False
    ends: tuple[str, str] = ("", "")
    arrow: int | None = None

    @property
    def symbol(self) -> str:
        """The name of its symbol: v_BA, a_BA^ν."""
        return f"{self.letter}_{self.index}" + (f"^{self.sign}" if self.sign else "")


FEET = {"ν": "n", "c": "k"}
"""The letters of the feet of components, by their signs."""


def foot_of(sign: str, index: str) -> str:
    """The letter of the foot of a component; empty for a component that has none."""
    return f"{FEET[sign]}_{index}" if sign in FEET else ""


def plan_vector(step: Step) -> PlanVector | None:
    """The vector that a step draws; None for a step that draws none."""
    return step.of if isinstance(step.of, PlanVector) else None


def sign_of(step: Step) -> str:
    """The sign of the component that a step draws; empty for whole vectors and other steps."""
    vector = plan_vector(step)
    return vector.sign if vector else ""


def is_set_on(step: Step) -> bool:
    """Whether a step sets a vector of a plan on the mechanism."""
    return step.plane is Plane.MECHANISM and plan_vector(step) is not None
